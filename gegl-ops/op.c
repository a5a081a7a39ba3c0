/* A call of an operation: checks of its pads, `render`, and the message to the artist.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "op-parts.h"

static void
pass_through (GeglOperationContext *context)
{
  GObject *input = gegl_operation_context_dup_object (context, "input");

  if (input)
    gegl_operation_context_take_object (context, "output", input);
  else
    gegl_operation_context_get_target (context, "output");
}

static void
render_or_pass (CeldOperation *self, GeglOperationContext *context)
{
  CeldOp op = {
    .operation = self,
    .context   = context,
    .picture   = celd_operation_input (GEGL_OPERATION (self)),
    .settings  = self->settings,
    .own       = self->own,
    .scratch   = g_ptr_array_new_with_free_func (g_free),
    .message   = g_string_new (NULL),
  };

  celd_op_set_host (&op);
  if (celd_op_check_pads (&op) && CELD_OPERATION_CLASS_OF (self)->info->render (&op))
    op.host.progress (&op, 1);
  else
    pass_through (context);
  celd_op_show_message (&op);
  celd_palette_clear (&op.palette);
  celd_relations_clear (&op.relations);
  celd_problems_clear (&op.problems);
  celd_order_clear (&op.order);
  g_ptr_array_unref (op.scratch);
  g_string_free (op.message, TRUE);
}

/* A host that handles events while it shows progress may call the operation from within render: it gets the input. */
gboolean
celd_operation_process (GeglOperation *operation, GeglOperationContext *context, const gchar *output_pad,
                        const GeglRectangle *roi, gint level)
{
  CeldOperation *self = (CeldOperation *) operation;

  g_rec_mutex_lock (&self->busy);
  if (self->rendering)
    pass_through (context);
  else
    {
      self->rendering = TRUE;
      render_or_pass (self, context);
      self->rendering = FALSE;
    }
  g_rec_mutex_unlock (&self->busy);
  return TRUE;
}
