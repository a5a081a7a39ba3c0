/* The basin graph of a drawing, built step by step or updated where the drawing has changed.
 *
 * An update assigns the pixels of the affected basins (basin-change.c) again, to maxima among them or to basins that
 * are kept.  The boundaries between kept basins are taken over, and all pairs with a pixel of an affected basin are
 * counted again.
 *
 * Cost of an update: the box of the affected basins; the list of runs is copied.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "segment/basin-steps.h"
#include "segment/basins.h"

typedef struct
{
  const CeldPlane  *ink;
  const CeldBasins *old;
  CeldBasinChange   change;
  int32_t          *squared;  /* signed squared distance in the window */
  uint8_t          *rebuilt;  /* of each pixel of the box: is it in an affected basin? */
} Update;

/* ------------------------------------------------------------------ all of a drawing */

/* Fills in all but stroke width and costs. */
static CeldStatus
build (const CeldPlane *ink, const CeldHost *host, CeldBasins *basins)
{
  CeldHostPart    parts[3];
  CeldHost        measuring = celd_host_part (&parts[0], host, 0, 0.4);
  CeldHost        ascending = celd_host_part (&parts[1], host, 0.4, 0.9);
  CeldHost        touching = celd_host_part (&parts[2], host, 0.9, 1);
  int32_t        *squared = celd_alloc ((size_t) ink->width * (size_t) ink->height, sizeof *squared);
  CeldBasinExtent extent = { { 0, 0, ink->width, ink->height }, squared, (size_t) ink->width, basins->stroke, NULL,
                             NULL };
  CeldStatus      status = squared ? celd_signed_distance (ink, &measuring, squared) : CELD_NO_MEMORY;

  if (status == CELD_OK)
    status = celd_basins_ascend (&extent, &ascending, basins);
  if (status == CELD_OK)
    {
      celd_basins_count_areas (basins);
      status = celd_basins_find_boundaries (ink, &extent, basins, &touching, &basins->boundary, &basins->n_boundaries);
    }
  if (status == CELD_OK)
    status = celd_basins_merge (basins);
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
  celd_smoothness_costs_new (ink->width, ink->height, threshold, &found.costs);
  status = build (ink, host, &found);
  if (status == CELD_OK)
    *basins = found;
  else
    celd_basins_clear (&found);
  return status;
}

/* ------------------------------------------------------------------ an update: new basins among kept ones */

static void
mark_rebuilt (Update *u)
{
  const CeldBasins *old = u->old;
  uint8_t          *rebuilt = u->rebuilt;

  for (int y = u->change.box.y; y < u->change.box.y + u->change.box.height; y++)
    {
      const CeldBasinRun *run = old->run + old->row[y], *end = old->run + old->row[y + 1];

      for (int x = u->change.box.x; x < u->change.box.x + u->change.box.width; x++)
        {
          while (run + 1 < end && run[1].x <= x)
            run++;
          *rebuilt++ = u->change.affected[run->basin];
        }
    }
}

/* Merges old and new basins in reading order of their maxima. to[k] becomes the number of new basin k, kept[k] that of
 * old basin k. */
static CeldStatus
merge_basins (const Update *u, const CeldBasins *made, uint32_t *to, uint32_t *kept, CeldBasins *found)
{
  const CeldBasins *old = u->old;
  size_t            n = 0;

  found->basin = celd_alloc (old->n + made->n, sizeof *found->basin);
  if (!found->basin)
    return CELD_NO_MEMORY;
  for (size_t i = 0, j = 0; i < old->n || j < made->n; n++)
    {
      const CeldBasin *p = &old->basin[i], *q = &made->basin[j];

      if (i < old->n && u->change.affected[i])
        {
          i++;
          n--;
        }
      else if (j == made->n || (i < old->n && (p->y < q->y || (p->y == q->y && p->x < q->x))))
        {
          kept[i++] = (uint32_t) n;
          found->basin[n] = *p;
          found->basin[n].area = 0;
        }
      else
        {
          to[j++] = (uint32_t) n;
          found->basin[n] = *q;
        }
    }
  found->n = n;
  return CELD_OK;
}

/* Appends the runs of row y of a graph, clipped to the columns from .. end - 1 and renumbered; the graph's first column
 * is `left`. */
static void
copy_runs (const CeldBasins *from_graph, int y, int left, int from, int end, const uint32_t *to, const uint32_t *kept,
           size_t start, CeldBasins *found, size_t *n)
{
  const CeldBasinRun *run = from_graph->run + from_graph->row[y], *last = from_graph->run + from_graph->row[y + 1];

  for (; run < last && left + run->x < end && from < end; run++)
    {
      int      x = left + run->x > from ? left + run->x : from;
      uint32_t basin = run->basin & CELD_OLD_BASIN ? kept[run->basin - CELD_OLD_BASIN] : to[run->basin];

      if ((run + 1 < last && left + run[1].x <= from) || (*n > start && found->run[*n - 1].basin == basin))
        continue;
      found->run[(*n)++] = (CeldBasinRun) { x, basin };
    }
}

/* The old runs, and those of `made` in the box. */
static CeldStatus
merge_runs (const Update *u, const CeldBasins *made, const uint32_t *to, const uint32_t *kept, CeldBasins *found)
{
  const CeldBasins *old = u->old;
  CeldRect          box = u->change.box;
  size_t            n = 0, most = old->row[old->height] + made->row[made->height] + 2 * (size_t) box.height;

  found->row = celd_alloc ((size_t) old->height + 1, sizeof *found->row);
  found->run = celd_alloc (most, sizeof *found->run);
  if (!found->row || !found->run)
    return CELD_NO_MEMORY;
  for (int y = 0; y < old->height; y++)
    {
      bool   crosses = y >= box.y && y < box.y + box.height;
      size_t start = found->row[y] = n;

      copy_runs (old, y, 0, 0, crosses ? box.x : old->width, kept, kept, start, found, &n);
      if (!crosses)
        continue;
      copy_runs (made, y - box.y, box.x, box.x, box.x + box.width, to, kept, start, found, &n);
      copy_runs (old, y, 0, box.x + box.width, old->width, kept, kept, start, found, &n);
    }
  found->row[old->height] = n;
  return CELD_OK;
}

/* ------------------------------------------------------------------ boundaries */

/* The boundaries between kept basins joined with the recounted ones. */
static CeldStatus
merge_boundaries (const Update *u, const uint32_t *kept, const CeldBasinBoundary *more, size_t n_more,
                  CeldBasins *found)
{
  const CeldBasins *old = u->old;
  size_t            n = 0, j = 0;

  found->boundary = celd_alloc (old->n_boundaries + n_more, sizeof *found->boundary);
  if (!found->boundary)
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < old->n_boundaries; i++)
    {
      CeldBasinBoundary boundary = old->boundary[i];

      if (u->change.affected[boundary.a] || u->change.affected[boundary.b])
        continue;
      boundary.a = kept[boundary.a];
      boundary.b = kept[boundary.b];
      while (j < n_more && celd_basin_boundary_compare (&more[j], &boundary) < 0)
        found->boundary[n++] = more[j++];
      if (j < n_more && celd_basin_boundary_compare (&more[j], &boundary) == 0)
        celd_basin_boundary_add (&boundary, &more[j++]);
      found->boundary[n++] = boundary;
    }
  while (j < n_more)
    found->boundary[n++] = more[j++];
  found->n_boundaries = n;
  return CELD_OK;
}

/* ------------------------------------------------------------------ the whole */

/* Finds the basins of the affected pixels, and makes the graph of these and the kept basins. */
static CeldStatus
rebuild (Update *u, const CeldHost *host, CeldBasins *found)
{
  CeldRect           box = u->change.box, window = u->change.window;
  CeldPlane          view = { window.width, window.height, u->ink->stride, &CELD_AT (u->ink, window.x, window.y) };
  CeldBasinExtent    extent = { box, u->squared + (size_t) (box.y - window.y) * (size_t) window.width +
                                (box.x - window.x),
                       (size_t) window.width, u->old->stroke, u->rebuilt, u->old };
  CeldBasins         made = { 0 };
  CeldBasinBoundary *boundary = NULL;
  uint32_t          *to = NULL, *kept = celd_alloc (u->old->n, sizeof *kept);
  size_t             n_boundaries = 0;
  CeldStatus         status = kept ? celd_signed_distance (&view, host, u->squared) : CELD_NO_MEMORY;

  made.width = box.width;
  made.height = box.height;
  mark_rebuilt (u);
  if (status == CELD_OK)
    status = celd_basins_ascend (&extent, host, &made);
  if (status == CELD_OK && !(to = celd_alloc (made.n, sizeof *to)))
    status = CELD_NO_MEMORY;
  if (status == CELD_OK)
    status = merge_basins (u, &made, to, kept, found);
  if (status == CELD_OK)
    status = merge_runs (u, &made, to, kept, found);
  if (status == CELD_OK)
    {
      celd_basins_count_areas (found);
      status = celd_basins_find_boundaries (u->ink, &extent, found, host, &boundary, &n_boundaries);
    }
  if (status == CELD_OK)
    status = merge_boundaries (u, kept, boundary, n_boundaries, found);
  if (status == CELD_OK)
    status = celd_basins_merge (found);
  celd_free (boundary);
  celd_free (to);
  celd_free (kept);
  celd_basins_clear (&made);
  return status;
}

/* Makes *found, except for its paper bits, from the graph before the change.  *found stays empty where building all of
 * it is faster. */
static CeldStatus
update (const CeldPlane *ink, const CeldRect *changed, const CeldBasins *old, const CeldHost *host, CeldBasins *found)
{
  CeldHostPart part;
  CeldHost     quiet = celd_host_part (&part, host, 0, 0);
  Update       u = { .ink = ink, .old = old };
  CeldStatus   status = celd_basins_find_change (ink, old, changed, &quiet, &u.change);

  if (status == CELD_OK && u.change.worthwhile)
    {
      CeldRect window = u.change.window, box = u.change.box;

      u.squared = celd_alloc ((size_t) window.width * (size_t) window.height, sizeof *u.squared);
      u.rebuilt = celd_alloc ((size_t) box.width * (size_t) box.height, 1);
      status = u.squared && u.rebuilt ? rebuild (&u, &quiet, found) : CELD_NO_MEMORY;
    }
  celd_free (u.squared);
  celd_free (u.rebuilt);
  celd_free (u.change.affected);
  return status;
}

CeldStatus
celd_basins_update (const CeldPlane *ink, const CeldRect *changed, const CeldHost *host, CeldBasins *basins)
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
  status = found.stroke == basins->stroke ? update (ink, &inside, basins, host, &found) : CELD_OK;
  if (status == CELD_OK && found.basin)
    {
      found.paper = basins->paper;
      basins->paper = NULL;
      celd_paper_update (ink, &inside, host, found.paper);
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

CeldStatus
celd_basins_make (const CeldPlane *ink, const CeldRect *changed, float threshold, const CeldHost *host,
                  CeldBasins *basins)
{
  CeldBasins made = { 0 };
  CeldStatus status;

  if (changed)
    return celd_basins_update (ink, changed, host, basins);
  status = celd_basins_new (ink, threshold, host, &made);
  if (status != CELD_OK)
    return status;
  celd_basins_clear (basins);
  *basins = made;
  return CELD_OK;
}
