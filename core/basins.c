/* The basin graph of a drawing, step by step.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "basin-steps.h"

CeldStatus
celd_basins_new (const CeldPlane *ink, float threshold, const CeldRun *run, CeldBasins *basins)
{
  CeldBasins found = { .width = ink->width, .height = ink->height };
  CeldPart   parts[3];
  CeldRun    measuring = celd_run_part (&parts[0], run, 0, 0.4), ascending = celd_run_part (&parts[1], run, 0.4, 0.9);
  CeldRun    touching = celd_run_part (&parts[2], run, 0.9, 1);
  int32_t   *squared;
  CeldStatus status;

  if (!CELD_SAME_SIZE (ink, ink))
    return CELD_BAD_SIZE;
  squared = celd_alloc ((size_t) ink->width * (size_t) ink->height, sizeof *squared);
  if (!squared)
    return CELD_NO_MEMORY;
  found.stroke = celd_stroke_width (ink);
  celd_costs_new (ink->width, ink->height, threshold, &found.costs);
  status = celd_signed_distance (ink, &measuring, squared);
  if (status == CELD_OK)
    status = celd_basins_ascend (squared, &ascending, &found);
  if (status == CELD_OK)
    status = celd_basins_touch (ink, squared, &touching, &found);
  if (status == CELD_OK)
    status = celd_basins_unite (&found);
  if (status == CELD_OK)
    status = celd_paper_new (ink, run, &found.paper);
  celd_free (squared);
  if (status == CELD_OK)
    *basins = found;
  else
    celd_basins_clear (&found);
  return status;
}

void
celd_basins_clear (CeldBasins *basins)
{
  celd_free (basins->basin);
  celd_free (basins->border);
  celd_free (basins->row);
  celd_free (basins->run);
  celd_free (basins->paper);
  celd_free (basins->block);
  celd_free (basins->room);
  celd_free (basins->piece);
  *basins = (CeldBasins) { 0 };
}

uint32_t
celd_basin_at (const CeldBasins *basins, int x, int y)
{
  const CeldBasinRun *first = basins->run + basins->row[y];
  size_t              n = basins->row[y + 1] - basins->row[y];

  while (n > 1) /* the run is first .. first + n - 1 */
    if (first[n / 2].x <= x)
      {
        first += n / 2;
        n -= n / 2;
      }
    else
      n /= 2;
  return first->basin;
}
