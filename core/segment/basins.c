/* The basin graph of a drawing, step by step.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "segment/basin-steps.h"
#include "segment/basins.h"
#include "segment/costs.h"

void
celd_basins_measure (CeldBasins *basins)
{
  for (int y = 0; y < basins->height; y++)
    for (size_t i = basins->row[y], end = basins->row[y + 1]; i < end; i++)
      basins->basin[basins->run[i].basin].area +=
        (uint32_t) ((i + 1 < end ? basins->run[i + 1].x : basins->width) - basins->run[i].x);
}

/* Everything but stroke and costs. */
static CeldStatus
build (const CeldPlane *ink, const CeldHost *host, CeldBasins *basins)
{
  CeldHostPart   parts[3];
  CeldHost   measuring = celd_host_part (&parts[0], host, 0, 0.4), ascending = celd_host_part (&parts[1], host, 0.4, 0.9);
  CeldHost   touching = celd_host_part (&parts[2], host, 0.9, 1);
  int32_t   *squared = celd_alloc ((size_t) ink->width * (size_t) ink->height, sizeof *squared);
  CeldPlot   plot = { { 0, 0, ink->width, ink->height }, squared, (size_t) ink->width, basins->stroke, NULL, NULL };
  CeldStatus status = squared ? celd_signed_distance (ink, &measuring, squared) : CELD_NO_MEMORY;

  if (status == CELD_OK)
    status = celd_basins_ascend (&plot, &ascending, basins);
  if (status == CELD_OK)
    {
      celd_basins_measure (basins);
      status = celd_basins_touch (ink, &plot, basins, &touching, &basins->border, &basins->n_borders);
    }
  if (status == CELD_OK)
    status = celd_basins_unite (basins);
  if (status == CELD_OK)
    status = celd_paper_new (ink, host, &basins->paper);
  celd_free (squared);
  return status;
}

CeldStatus
celd_basins_new (const CeldPlane *ink, float threshold, const CeldHost *host, CeldBasins *basins)
{
  CeldBasins found = { .width = ink->width, .height = ink->height };
  CeldStatus status;

  if (!CELD_SAME_SIZE (ink, ink))
    return CELD_BAD_SIZE;
  found.stroke = celd_stroke_width (ink);
  celd_costs_new (ink->width, ink->height, threshold, &found.costs);
  status = build (ink, host, &found);
  if (status == CELD_OK)
    *basins = found;
  else
    celd_basins_clear (&found);
  return status;
}

CeldStatus
celd_basins_renew (const CeldPlane *ink, const CeldRect *changed, const CeldHost *host, CeldBasins *basins)
{
  CeldBasins found = { .width = ink->width, .height = ink->height, .costs = basins->costs };
  int        left = changed->x > 0 ? changed->x : 0, right = changed->x + changed->width;
  int        top = changed->y > 0 ? changed->y : 0, bottom = changed->y + changed->height;
  CeldRect   inside = { left, top, (right < ink->width ? right : ink->width) - left,
                        (bottom < ink->height ? bottom : ink->height) - top };
  CeldStatus status;

  if (!CELD_SAME_SIZE (ink, ink) || ink->width != basins->width || ink->height != basins->height)
    return CELD_BAD_SIZE;
  if (inside.width < 1 || inside.height < 1)
    return CELD_OK;
  found.stroke = celd_stroke_width (ink);
  status = found.stroke == basins->stroke ? celd_basins_revise (ink, &inside, basins, host, &found) : CELD_OK;
  if (status == CELD_OK && found.basin)
    {
      found.paper = basins->paper;
      basins->paper = NULL;
      celd_paper_renew (ink, &inside, host, found.paper);
    }
  else if (status == CELD_OK)
    status = build (ink, host, &found);
  if (status == CELD_OK)
    celd_basins_clear (basins);
  else
    celd_basins_clear (&found);
  if (status == CELD_OK)
    *basins = found;
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
