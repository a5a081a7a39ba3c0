/* Progress, cancel and threads, as far as the host lends them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"

static bool
part_progress (void *host, double done)
{
  const CeldPart *part = host;

  return celd_step (part->whole, part->from + (part->to - part->from) * done) == CELD_OK;
}

static void
part_each (void *host, int n, void (*body) (void *data, int i), void *data)
{
  const CeldPart *part = host;

  celd_each (part->whole, n, body, data);
}

CeldRun
celd_run_part (CeldPart *part, const CeldRun *whole, double from, double to)
{
  *part = (CeldPart) { whole, from, to };
  return (CeldRun) { part_progress, part_each, part };
}

CeldStatus
celd_step (const CeldRun *run, double done)
{
  return run && run->progress && !run->progress (run->host, done) ? CELD_CANCELLED : CELD_OK;
}

void
celd_each (const CeldRun *run, int n, void (*body) (void *data, int i), void *data)
{
  if (run && run->each)
    run->each (run->host, n, body, data);
  else
    for (int i = 0; i < n; i++)
      body (data, i);
}

CeldStatus
celd_rounds (const CeldRun *run, int n, int at_once, void (*body) (void *data, int i), void *data, int *first,
             double from, double to)
{
  CeldStatus status = CELD_OK;

  for (*first = 0; *first < n && status == CELD_OK; *first += at_once)
    {
      celd_each (run, n - *first < at_once ? n - *first : at_once, body, data);
      status = celd_step (run, from + (to - from) * (*first + at_once < n ? (double) (*first + at_once) / n : 1));
    }
  return status;
}
