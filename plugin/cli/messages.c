/* Messages on stderr.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

#include <glib/gi18n.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#define MOST_PROBLEMS 12 /* that are printed (chosen) */

static GString *kept; /* messages that may be discarded; NULL: they are printed at once */

void
cli_say_keep (void)
{
  if (!kept)
    kept = g_string_new (NULL);
}

void
cli_say_kept (bool show)
{
  if (kept && show)
    fputs (kept->str, stderr);
  if (kept)
    g_string_free (kept, TRUE);
  kept = NULL;
}

static const char *hidden_folder; /* of the files that stand for standard input and output */

void
cli_say_without (const char *folder)
{
  hidden_folder = folder;
}

/* Leaves out the folder of a file that stands for standard input or output, and the ending of its name, which a message
 * has in quotes. */
static char *
without_folder (const char *text)
{
  char  *prefix = g_strconcat (hidden_folder, G_DIR_SEPARATOR_S, NULL), *whole;
  char **pieces = g_strsplit (text, prefix, 0);

  for (char **name = pieces; *name && *++name;)
    {
      char *end = strchr (*name, '"'), *dot = strchr (*name, '.');

      if (end && dot && dot < end)
        memmove (dot, end, strlen (end) + 1);
    }
  whole = g_strjoinv ("", pieces);
  g_strfreev (pieces);
  g_free (prefix);
  return whole;
}

static const char *place; /* what messages are about; NULL: they say it themselves */

void
cli_say_about (const char *what)
{
  place = what;
}

static void
say (const char *format, va_list arguments)
{
  char *plain = g_strdup_vprintf (format, arguments), *text = place ? g_strconcat (place, ": ", plain, NULL) : plain;

  if (place)
    g_free (plain);
  if (hidden_folder)
    {
      char *whole = without_folder (text);

      g_free (text);
      text = whole;
    }
  cli_bar_hide ();
  if (kept)
    g_string_append_printf (kept, "celdepth: %s\n", text);
  else
    fprintf (stderr, "celdepth: %s\n", text);
  g_free (text);
}

void
cli_say (const char *format, ...)
{
  va_list arguments;

  va_start (arguments, format);
  say (format, arguments);
  va_end (arguments);
}

bool
cli_error (const char *format, ...)
{
  va_list arguments;

  va_start (arguments, format);
  say (format, arguments);
  va_end (arguments);
  return false;
}

const char *
cli_in_language (const char *text)
{
  return _ (text);
}

bool
cli_check (CeldStatus status)
{
  return status == CELD_OK || cli_error ("%s", _ (celd_status_text (status)));
}

void
cli_say_cycles (const CliOptions *options, const CeldOrder *order, const CeldRelations *relations)
{
  for (size_t i = 0; i < order->n_cycles; i++)
    {
      const CeldCycle *cycle = &order->cycle[i];

      cli_say ("%s", _ ("These relations contradict each other; the first of them was left out:"));
      for (size_t k = 0; k < cycle->n; k++)
        {
          const CeldRelation *relation = &relations->item[cycle->item[k]];
          char               *text = cli_relation_text (relation, NULL);
          int                 line = relation->line;
          const char         *from = relation->source == CELD_SOURCE_PATH ? "--arrow-path"
                                                                          : cli_relations_place (options, &line);

          if (relation->source == CELD_SOURCE_ARROW)
            fprintf (stderr, _ ("    %s  (painted arrow)\n"), text);
          else
            fprintf (stderr, _ ("    %s  (%s, line %d, column %d)\n"), text, from, line, relation->column);
          g_free (text);
        }
      if (cycle->label)
        fprintf (stderr, _ ("    The reason is that #%02x%02x%02x has one depth at (%d, %d) and at (%d, %d); "
                            "--same-colour separate lets them differ.\n"),
                 cycle->colour[0], cycle->colour[1], cycle->colour[2], cycle->x[0], cycle->y[0], cycle->x[1], cycle->y[1]);
      if (order->scc[cycle->scc].n > cycle->n)
        fprintf (stderr, _ ("    Other cycles share regions with this one: %u relations in all.\n"),
                 (unsigned) order->scc[cycle->scc].n);
    }
}

/* Prints one problem.  A relation is in a line of --relations or of a file, and not of both together. */
static void
say_problem (const CliOptions *options, const CeldProblem *problem, const CeldPalette *palette,
             const CeldRelations *relations)
{
  char          text[800];
  CeldProblem   about = *problem;
  CeldRelation  relation;
  CeldRelations one = { &relation, 1 };
  const char   *from = NULL;

  if (options && relations && problem->relation < relations->n)
    {
      relation = relations->item[problem->relation];
      if (relation.source == CELD_SOURCE_TEXT)
        from = cli_relations_place (options, &relation.line);
      relations      = &one;
      about.relation = 0;
    }
  celd_problem_text (&about, palette, relations, cli_in_language, text, sizeof text);
  cli_say ("%s%s%s%s", from ? from : "", from ? ": " : "", text,
           problem->kind == CELD_PROBLEM_HIDDEN_UNSURE ? _ (" Give it by --hidden.") : "");
}

void
cli_say_problems (const CliOptions *options, const CeldProblems *problems, const CeldPalette *palette,
                  const CeldRelations *relations)
{
  size_t n = 0;

  for (size_t i = 0; problems && i < problems->n; i++)
    if (problems->item[i].kind != CELD_PROBLEM_CONTRADICTION && n++ < MOST_PROBLEMS)
      say_problem (options, &problems->item[i], palette, relations);
  if (n > MOST_PROBLEMS)
    {
      unsigned more = (unsigned) n - MOST_PROBLEMS;

      cli_say (ngettext ("There is %u more message; --report writes all of them.",
                         "There are %u more messages; --report writes all of them.", more), more);
    }
}

/* Tells that depth goes beyond the scale of encoding=fixed, where most files end. */
static void
say_beyond_scale (const CeldOrder *order, const CeldSettings *settings)
{
  double far = (double) settings->far_level, range = (double) settings->near_level - far;
  double last = order->levels ? (double) celd_order_value (order, order->levels - 1, settings) : 0;

  if (settings->encoding == CELD_ENCODING_FIXED && last > 1 + 1e-6)
    cli_say (_ ("Parts at levels above %g are alike in files of 8 and 16 bits, which end there: set --near-level to %g."),
             (double) settings->near_level, far + last * range);
}

int
cli_finish (const CliOptions *options, const CliReport *report)
{
  if (options->report && !cli_report_write (options->report, report))
    return CLI_FAILED;
  if (report->order)
    cli_say_cycles (options, report->order, report->relations);
  if (!options->quiet && report->order)
    say_beyond_scale (report->order, &options->settings);
  if (!options->quiet)
    cli_say_problems (options, report->problems, report->palette, report->relations);
  return report->order && report->order->n_cycles ? CLI_CONTRADICTED : CLI_DONE;
}
