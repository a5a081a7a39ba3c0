/* Progress of GEGL, and memory that is freed after a call.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "op-parts.h"

#include "buffers.h"

#define LEAST_STEP 0.01 /* of the progress, since hosts redraw at each report (chosen) */

static bool
report_progress (void *host, double done)
{
  CeldOp *op = host;

  if (done >= op->progress + LEAST_STEP)
    {
      op->progress = done;
      gegl_operation_progress (GEGL_OPERATION (op->operation), done, (gchar *) "");
    }
  return true; /* operations of GEGL cannot be cancelled */
}

void
celd_op_set_host (CeldOp *op)
{
  op->host  = (CeldHost) { report_progress, celd_gegl_each, op };
  op->quiet = (CeldHost) { NULL, celd_gegl_each, op };
}

gpointer
celd_op_alloc (CeldOp *op, gsize size)
{
  gpointer memory = g_try_malloc (size);

  if (memory)
    g_ptr_array_add (op->scratch, memory);
  else
    celd_op_try (op, CELD_NO_MEMORY);
  return memory;
}
