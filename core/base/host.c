/* Progress, cancel and threads: calls of the functions that the host lends, or substitutes without a host.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"

static bool
part_progress (void *data, double done)
{
  const CeldHostPart *part = data;
  double              whole = part->from + (part->to - part->from) * done;

  /* The sum is rounded, and may be beyond the end. */
  return celd_progress (part->whole, whole < part->to ? whole : part->to) == CELD_OK;
}

static void
part_each (void *data, int n, void (*body) (void *body_data, int i), void *body_data)
{
  const CeldHostPart *part = data;

  celd_parallel_for (part->whole, n, body, body_data);
}

CeldHost
celd_host_part (CeldHostPart *part, const CeldHost *whole, double from, double to)
{
  *part = (CeldHostPart) { whole, from, to };
  return (CeldHost) { part_progress, part_each, part };
}

CeldStatus
celd_progress (const CeldHost *host, double done)
{
  return host && host->progress && !host->progress (host->data, done) ? CELD_CANCELLED : CELD_OK;
}

void
celd_parallel_for (const CeldHost *host, int n, void (*body) (void *data, int i), void *data)
{
  if (host && host->each)
    host->each (host->data, n, body, data);
  else
    for (int i = 0; i < n; i++)
      body (data, i);
}

CeldStatus
celd_parallel_rounds (const CeldHost *host, int n, int at_once, void (*body) (void *data, int i), void *data,
                      int *first, double from, double to)
{
  CeldStatus status = CELD_OK;

  for (*first = 0; *first < n && status == CELD_OK; *first += at_once)
    {
      celd_parallel_for (host, n - *first < at_once ? n - *first : at_once, body, data);
      status = celd_progress (host, from + (to - from) * (*first + at_once < n ? (double) (*first + at_once) / n : 1));
    }
  return status;
}
