/* Problems as lines of a message.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "problems.h"

#include "translate.h"

#define MOST_PROBLEMS 8 /* in one message (chosen) */

const char *
celd_in_language (const char *text)
{
  return _ (text);
}

char *
celd_problem_line (const CeldProblem *problem, const CeldPalette *palette, const CeldRelations *relations,
                   const CeldOrder *order)
{
  char text[800], cycle[1000];

  celd_problem_text (problem, palette, relations, celd_in_language, text, sizeof text);
  if (problem->kind != CELD_PROBLEM_CONTRADICTION || !order || problem->other >= order->n_cycles)
    return g_strdup (text);
  celd_cycle_text (&order->cycle[problem->other], relations, celd_in_language, cycle, sizeof cycle);
  return g_strconcat (text, " ", cycle, NULL);
}

void
celd_problems_append (GString *message, const CeldProblems *problems, const CeldPalette *palette,
                      const CeldRelations *relations, const CeldOrder *order)
{
  for (size_t i = 0; problems && i < MIN (problems->n, MOST_PROBLEMS); i++)
    {
      char *line = celd_problem_line (&problems->item[i], palette, relations, order);

      g_string_append_printf (message, "%s%s", message->len ? "\n" : "", line);
      g_free (line);
    }
  if (problems && problems->n > MOST_PROBLEMS)
    {
      guint more = (guint) problems->n - MOST_PROBLEMS;

      g_string_append_c (message, '\n');
      g_string_append_printf (message, g_dngettext (CELD_DOMAIN, "There is %u more message.",
                                                    "There are %u more messages.", more), more);
    }
}

const char *
celd_unsure_lines_text (void)
{
  return _ ("The drawing hardly has clear lines: if it is a photograph, draw its outlines on another layer, and choose that "
            "one as the drawing.");
}
