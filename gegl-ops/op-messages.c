/* Messages to the artist: one for each call, of all lines that are added during it.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "op-parts.h"

#include "problems.h"

void
celd_op_add_line (CeldOp *op, const char *text)
{
  if (strstr (op->message->str, text)) /* of another drawing */
    return;
  if (op->message->len)
    g_string_append_c (op->message, '\n');
  g_string_append (op->message, text);
}

gboolean
celd_op_fail (CeldOp *op, const char *format, ...)
{
  va_list arguments;
  char   *text;

  va_start (arguments, format);
  text = g_strdup_vprintf (format, arguments);
  va_end (arguments);
  celd_op_add_line (op, text);
  g_free (text);
  return FALSE;
}

/* While the artist is still choosing or painting layers, missing scribbles and arrows are not reported. */
gboolean
celd_op_try (CeldOp *op, CeldStatus status)
{
  if (status == CELD_NOTHING_TO_GO_BY && op->choosing)
    return FALSE;
  return status == CELD_OK || celd_op_fail (op, "%s", _ (celd_status_text (status)));
}

/* As celd_op_try, for a text; `format` says where it cannot be read, and gives an example. */
static gboolean
try_text (CeldOp *op, CeldStatus status, const CeldTextError *error, const char *format)
{
  if (status != CELD_BAD_RELATION)
    return celd_op_try (op, status);
  return celd_op_fail (op, format, error->line, error->column, _ (error->found), _ (error->expected));
}

gboolean
celd_op_try_text (CeldOp *op, CeldStatus status, const CeldTextError *error)
{
  return try_text (op, status, error,
                   _ ("The relations cannot be read: line %d, column %d has %s where %s was expected. An example of a "
                      "relation is: 120,80 > 300,95"));
}

gboolean
celd_op_try_path (CeldOp *op, CeldStatus status, const CeldTextError *error)
{
  return try_text (op, status, error,
                   _ ("The arrow path cannot be read: line %d, column %d has %s where %s was expected. An example of "
                      "an arrow is: M 120,80 L 300,95"));
}

gboolean
celd_op_try_handles (CeldOp *op, CeldStatus status, const CeldTextError *error)
{
  return try_text (op, status, error,
                   _ ("The handles cannot be read: line %d, column %d has %s where %s was expected. An example of a "
                      "handle is: 120,80 -> 200,60"));
}

gboolean
celd_op_report (CeldOp *op, const CeldProblems *problems, const CeldPalette *palette, const CeldRelations *relations,
              const CeldOrder *order)
{
  celd_problems_append (op->message, problems, palette, relations, order);
  return TRUE;
}

gboolean
celd_op_report_text (CeldOp *op, const char *text)
{
  celd_op_add_line (op, text);
  return TRUE;
}

gboolean
celd_op_report_solve (CeldOp *op, const CeldSolve *solve)
{
  CeldProblem  problem = { .kind = CELD_PROBLEM_NOT_CONVERGED, .x = -1, .y = -1, .relation = CELD_NO_INDEX };
  CeldProblems problems = { .item = &problem, .n = 1 };

  return solve->converged || celd_op_report (op, &problems, NULL, NULL, NULL);
}

void
celd_op_show_message (CeldOp *op)
{
  CeldOperation *self = op->operation;
  const char    *text = op->message->len ? op->message->str : NULL;

  if (text && g_strcmp0 (text, self->last_message))
    g_message ("%s: %s", gegl_operation_class_get_key (GEGL_OPERATION_GET_CLASS (self), "title"), text);
  g_free (self->last_message);
  self->last_message = g_strdup (text);
}
