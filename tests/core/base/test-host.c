/* Progress in parts, cancel, and threads that are lent or not.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "base/base.h"

typedef struct { double last; int calls; bool stop; } Host;

static bool
listen (void *data, double done)
{
  Host *host = data;

  host->last = done;
  host->calls++;
  return !host->stop;
}

static void
mark (void *data, int i)
{
  ((int *) data)[i]++;
}

static void
calls_without_a_host_succeed (void)
{
  CeldHost silent = { 0 };

  CHECK (celd_progress (NULL, 0.5) == CELD_OK);
  CHECK (celd_progress (&silent, 0.5) == CELD_OK);
}

static void
nested_parts_map_progress (void)
{
  Host         host = { 0 };
  CeldHost     whole = { listen, NULL, &host };
  CeldHostPart outer, inner;
  CeldHost     half = celd_host_part (&outer, &whole, 0.5, 1), quarter = celd_host_part (&inner, &half, 0, 0.5);

  CHECK (celd_progress (&quarter, 0) == CELD_OK);
  NEAR (host.last, 0.5, 1e-12);
  CHECK (celd_progress (&quarter, 1) == CELD_OK);
  NEAR (host.last, 0.75, 1e-12);
  CHECK (celd_progress (&half, 1) == CELD_OK);
  NEAR (host.last, 1, 1e-12);
  CHECK (host.calls == 3);
}

static void
cancel_reaches_the_caller (void)
{
  Host         host = { .stop = true };
  CeldHost     whole = { listen, NULL, &host };
  CeldHostPart part;
  CeldHost     inner = celd_host_part (&part, &whole, 0, 0.5);

  CHECK (celd_progress (&inner, 0.1) == CELD_CANCELLED);
}

static void
parallel_for_calls_each_index_once (void)
{
  CeldHost     lent = { .each = check_backwards };
  CeldHostPart part;
  CeldHost     inner = celd_host_part (&part, &lent, 0, 1);
  int          count[9] = { 0 };

  celd_parallel_for (NULL, 9, mark, count);
  celd_parallel_for (&lent, 9, mark, count);
  celd_parallel_for (&inner, 9, mark, count);
  celd_parallel_for (&inner, 0, mark, count);
  for (int i = 0; i < 9; i++)
    CHECK (count[i] == 3);
}

int
main (void)
{
  RUN (calls_without_a_host_succeed);
  RUN (nested_parts_map_progress);
  RUN (cancel_reaches_the_caller);
  RUN (parallel_for_calls_each_index_once);
  return DONE;
}
