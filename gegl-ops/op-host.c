/* Progress and threads of GEGL, and memory that is freed after a call.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "op-parts.h"

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

typedef struct { void (*body) (void *data, int i); void *data; } Work;

static void
call_range (gsize first, gsize n, gpointer user_data)
{
  const Work *work = user_data;

  for (gsize i = first; i < first + n; i++)
    work->body (work->data, (int) i);
}

static void
distribute (void *host, int n, void (*body) (void *data, int i), void *data)
{
  Work work = { body, data };

  gegl_parallel_distribute_range ((gsize) n, 1.0, call_range, &work);
}

void
celd_op_set_host (CeldOp *op)
{
  op->host  = (CeldHost) { report_progress, distribute, op };
  op->quiet = (CeldHost) { NULL, distribute, op };
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
