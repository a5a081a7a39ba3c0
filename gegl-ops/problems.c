/* Problems as lines of a message.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "problems.h"

#define MOST_PROBLEMS 8 /* in one message (chosen) */

void
celd_problems_append (GString *message, const CeldProblems *problems, const CeldPalette *palette,
                      const CeldRelations *relations, const CeldOrder *order)
{
  for (size_t i = 0; problems && i < MIN (problems->n, MOST_PROBLEMS); i++)
    {
      const CeldProblem *problem = &problems->item[i];
      char               text[400];

      celd_problem_text (problem, palette, relations, text, sizeof text);
      g_string_append_printf (message, "%s%s", message->len ? "\n" : "", text);
      if (problem->kind == CELD_PROBLEM_CONTRADICTION && order && problem->other < order->n_cycles)
        {
          celd_cycle_text (&order->cycle[problem->other], relations, text, sizeof text);
          g_string_append_printf (message, " %s", text);
        }
    }
  if (problems && problems->n > MOST_PROBLEMS)
    g_string_append_printf (message, "\nThere are %" G_GSIZE_FORMAT " more messages.", problems->n - MOST_PROBLEMS);
}
