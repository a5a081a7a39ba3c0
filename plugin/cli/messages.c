/* What the artist is told, on stderr.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

#include <stdarg.h>
#include <stdio.h>

#define MOST_PROBLEMS 12 /* that are said */

static void
say (const char *format, va_list arguments)
{
  fputs ("celdepth: ", stderr);
  vfprintf (stderr, format, arguments);
  fputc ('\n', stderr);
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

bool
cli_check (CeldStatus status)
{
  return status == CELD_OK || cli_error ("%s", celd_status_text (status));
}

static void
append_number (GString *text, const char *before, double value)
{
  char number[G_ASCII_DTOSTR_BUF_SIZE];

  g_string_append (text, before);
  g_string_append (text, g_ascii_formatd (number, sizeof number, "%.6g", value));
}

static void
append_term (GString *text, const CeldTerm *term)
{
  if (term->by_colour)
    g_string_append_printf (text, "#%02x%02x%02x", term->colour[0], term->colour[1], term->colour[2]);
  else
    {
      append_number (text, "", term->x);
      append_number (text, ",", term->y);
    }
}

char *
cli_relation_text (const CeldRelation *relation)
{
  GString *text = g_string_new (NULL);

  append_term (text, &relation->nearer);
  g_string_append (text, relation->equal ? " = " : " > ");
  append_term (text, &relation->farther);
  if (relation->weight < 1 || relation->weight > 1)
    append_number (text, " @", relation->weight);
  if (relation->gap < 1 || relation->gap > 1)
    append_number (text, " +", relation->gap);
  if (relation->crack)
    g_string_append (text, " !crack");
  if (relation->anchor)
    g_string_append (text, " !anchor");
  return g_string_free (text, FALSE);
}

static void
say_cycles (const CeldOrder *order, const CeldRelations *relations)
{
  for (size_t i = 0; i < order->n_cycles; i++)
    {
      const CeldCycle *cycle = &order->cycle[i];

      cli_say ("These relations contradict each other; the first of them was left out:");
      for (size_t k = 0; k < cycle->n; k++)
        {
          const CeldRelation *relation = &relations->item[cycle->item[k]];
          char               *text = cli_relation_text (relation);

          if (relation->source == CELD_SOURCE_ARROW)
            fprintf (stderr, "    %s  (painted arrow)\n", text);
          else
            fprintf (stderr, "    %s  (%sline %d, column %d)\n", text,
                     relation->source == CELD_SOURCE_PATH ? "arrow path, " : "", relation->line, relation->column);
          g_free (text);
        }
      if (cycle->label)
        fprintf (stderr, "    That is so because #%02x%02x%02x has one depth at (%d, %d) and at (%d, %d); "
                 "--same-colour separate gives each its own.\n", cycle->colour[0], cycle->colour[1], cycle->colour[2],
                 cycle->x[0], cycle->y[0], cycle->x[1], cycle->y[1]);
      if (order->scc[cycle->scc].n > cycle->n)
        fprintf (stderr, "    Other circles go through these, too: %" G_GSIZE_FORMAT " relations in all.\n",
                 order->scc[cycle->scc].n);
    }
}

void
cli_say_problems (const CeldProblems *problems, const CeldPalette *palette, const CeldRelations *relations)
{
  size_t n = 0;

  for (size_t i = 0; problems && i < problems->n; i++)
    if (problems->item[i].kind != CELD_PROBLEM_CONTRADICTION && n++ < MOST_PROBLEMS)
      {
        char text[400];

        celd_problem_text (&problems->item[i], palette, relations, text, sizeof text);
        cli_say ("%s", text);
      }
  if (n > MOST_PROBLEMS)
    cli_say ("There are %" G_GSIZE_FORMAT " more messages; --report writes them all.", n - MOST_PROBLEMS);
}

int
cli_tell (const CliOptions *options, const CliReport *report)
{
  if (options->report && !cli_report_write (options->report, report))
    return CLI_FAILED;
  if (report->order)
    say_cycles (report->order, report->relations);
  if (!options->quiet)
    cli_say_problems (report->problems, report->palette, report->relations);
  return report->order && report->order->n_cycles ? CLI_CONTRADICTED : CLI_DONE;
}
