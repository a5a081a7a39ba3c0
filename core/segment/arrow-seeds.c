/* Arrows as strokes: the expert gesture of section 4 ("generate scribbles with a newly added depth inequality") and
 * Figure 2, which has two arrows and nothing else.
 *
 * An end in an enclosure without seeds gets seeds of a new label.  Equalities never separate their ends: both share one
 * label.  The cost is that of the seeds and discs, not of the picture.  If both ends of an inequality end up in one
 * region, split.c divides it.
 *
 * A seed of one pixel would have no effect: a cut round it is cheaper than any cut across.  So an end is seeded with
 * discs that touch the contours beside it: one round the end, one on the peak of the distance to ink above it.  Where
 * both ends of a relation lie in one region, all discs of an end are nearer to it than half the way to the other end,
 * so that a cut between the ends is cheaper across a gap than round a disc.  The distance to ink is searched in the
 * drawing row by row outwards; at the maximum of a basin it is known.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "segment/basins.h"
#include "segment/splits.h"
#include "segment/task.h"

#include <math.h>

#define RADII_PER_SIDE    8  /* discs have a radius of at most 1/8 of the shorter side (chosen) */
#define MOST_END_RADIUS   64 /* pixels: largest radius round an end; the disc on the peak may be larger (chosen) */
#define MOST_BASIN_RADIUS 12 /* pixels: largest radius on basins, where a cut round a disc would take in its whole basin
                              * (chosen) */

/* ------------------------------------------------------------------ ends of relations */

CeldRelationEnd
celd_relation_end_find (const CeldSegmentTask *task, const CeldTerm *term)
{
  const CeldBasins *basins = task->basins;
  CeldRelationEnd   end = { 0 };

  if (term->by_colour || !(term->x >= 0 && term->y >= 0 && term->x < basins->width && term->y < basins->height))
    return end;
  end.x     = (int) term->x;
  end.y     = (int) term->y;
  end.there = celd_is_paper (CELD_AT (task->ink, end.x, end.y)) ||
              celd_paper_near (task->ink, basins->stroke, &end.x, &end.y);
  return end;
}

double
celd_relation_end_distance (CeldRelationEnd a, CeldRelationEnd b)
{
  return hypot (a.x - b.x, a.y - b.y);
}

/* ------------------------------------------------------------------ distance to ink */

static bool
has_ink (const float *ink, int n)
{
  int found = 0;

  for (int i = 0; i < n; i++)
    found |= ink[i] < 0.5f;
  return found;
}

/* The squared distance from (x,y) to ink in row v, if less than `least`; else `least`. */
static int32_t
nearest_in_row (const CeldPlane *ink, int x, int y, int v, int32_t least)
{
  int32_t down = (v - y) * (v - y);
  int     half = (int) sqrt ((double) (least - 1 - down));
  int     from = x - half < 0 ? 0 : x - half, to = x + half < ink->width ? x + half : ink->width - 1;

  if (!has_ink (&CELD_AT (ink, from, v), to - from + 1))
    return least;
  for (int u = from; u <= to; u++)
    if (!celd_is_paper (CELD_AT (ink, u, v)) && (u - x) * (u - x) + down < least)
      least = (u - x) * (u - x) + down;
  return least;
}

/* The squared distance from (x,y) to the nearest ink, at most the square of `limit`. */
static int32_t
to_ink (const CeldPlane *ink, int x, int y, double limit)
{
  int     most = (int) ceil (fmin (limit, 20000));
  int32_t least = most * most;

  for (int k = 0; k * k < least; k++)
    {
      if (y - k >= 0)
        least = nearest_in_row (ink, x, y, y - k, least);
      if (k > 0 && k * k < least && y + k < ink->height)
        least = nearest_in_row (ink, x, y, y + k, least);
    }
  return least;
}

/* ------------------------------------------------------------------ discs */

typedef struct { const CeldSegmentTask *task; CeldRelationEnd end; double farthest, widest; } DiscSearch;

static double
shorter_side (const CeldSegmentTask *task)
{
  return task->basins->width < task->basins->height ? task->basins->width : task->basins->height;
}

/* The largest disc round (x,y) that touches no ink, which is this squared distance away. */
static CeldSeedDisc
disc_of (const DiscSearch *search, int x, int y, int32_t squared)
{
  double radius = fmin (sqrt (squared) - 0.5, search->widest);

  radius = fmin (radius, search->farthest - hypot (x - search->end.x, y - search->end.y));
  return (CeldSeedDisc) { x, y, fmax (0, radius) };
}

static CeldSeedDisc
disc_at (const DiscSearch *search, int x, int y, double most)
{
  double limit = fmin (most, search->farthest - hypot (x - search->end.x, y - search->end.y));

  return disc_of (search, x, y, to_ink (search->task->ink, x, y, fmax (0, limit) + 1));
}

/* Moves a disc one step to where it is largest, without leaving the paper that it covers; false on a peak. */
static bool
climb (const DiscSearch *search, int step, CeldSeedDisc *disc)
{
  const CeldPlane *ink = search->task->ink;
  CeldSeedDisc     best = *disc;

  for (int v = -1; v <= 1; v++)
    for (int u = -1; u <= 1; u++)
      {
        int          x = disc->x + u * step, y = disc->y + v * step;
        CeldSeedDisc other;

        if (x < 0 || y < 0 || x >= ink->width || y >= ink->height || !celd_is_paper (CELD_AT (ink, x, y)))
          continue;
        other = disc_at (search, x, y, search->widest);
        if (other.radius > best.radius + 1e-9)
          best = other;
      }
  if (best.radius <= disc->radius)
    return false;
  *disc = best;
  return true;
}

/* Climbs in ever shorter steps, each smaller than the disc's radius, so that no line is stepped over. */
static CeldSeedDisc
climb_to_peak (const DiscSearch *search, CeldSeedDisc disc)
{
  for (int step = (int) (disc.radius / 2); ; step /= 2)
    {
      step = step < 1 ? 1 : step;
      while (climb (search, step, &disc))
        ;
      if (step == 1)
        return disc;
    }
}

CeldSeedDiscs
celd_seed_discs_find (const CeldSegmentTask *task, CeldRelationEnd end, double farthest, double widest)
{
  const CeldBasin *basin = &task->basins->basin[celd_basin_at (task->basins, end.x, end.y)];
  DiscSearch       search = { task, end, farthest, fmin (widest, fmax (1, shorter_side (task) / RADII_PER_SIDE)) };
  CeldSeedDiscs    discs = { .disc = { disc_at (&search, end.x, end.y, fmin (search.widest, MOST_END_RADIUS)) } };
  CeldSeedDisc     peak = discs.disc[0];

  if (!basin->solid)
    peak = disc_of (&search, basin->x, basin->y, basin->squared);
  if (peak.radius < discs.disc[0].radius)
    peak = discs.disc[0];
  if (farthest < INFINITY)
    {
      peak = climb_to_peak (&search, peak);
      discs.clearance = to_ink (task->ink, peak.x, peak.y, 2 * search.widest);
    }
  discs.disc[1] = peak;
  return discs;
}

bool
celd_seed_disc_row (const CeldSeedDisc *disc, int y, int *x, int *end)
{
  double left = disc->radius * disc->radius - (y - disc->y) * (y - disc->y);
  int    half = left >= 0 ? (int) sqrt (left) : 0;

  *x   = disc->x - half;
  *end = disc->x + half + 1;
  return left >= 0;
}

/* ------------------------------------------------------------------ enclosures with seeds */

static bool
has_paper (const CeldPlane *ink, int y, int x, int end)
{
  for (; x < end; x++)
    if (celd_is_paper (CELD_AT (ink, x, y)))
      return true;
  return false;
}

/* Marks the enclosures on whose paper the seeds of row y lie; seeds and basins are runs from left to right. */
static void
mark_seeded (const CeldSegmentTask *task, int y)
{
  const CeldBasins  *basins = task->basins;
  const CeldSeedRow *row = &task->seeds.row[y];
  size_t             k = basins->row[y], last = basins->row[y + 1] - 1;

  for (size_t i = 0; i < row->n; i++)
    for (int x = row->run[i].x, end; x < row->run[i].end; x = end)
      {
        uint32_t enclosure;

        while (k < last && basins->run[k + 1].x <= x)
          k++;
        end  = k < last && basins->run[k + 1].x < row->run[i].end ? basins->run[k + 1].x : row->run[i].end;
        enclosure = basins->enclosure[basins->run[k].basin];
        if (!task->seeded[enclosure])
          task->seeded[enclosure] = has_paper (task->ink, y, x, end);
      }
}

bool
celd_seed_discs_contain (const CeldSeedDiscs *discs, int x, int y)
{
  int from, end;

  for (int k = 0; k < 2; k++)
    if (celd_seed_disc_row (&discs->disc[k], y, &from, &end) && x >= from && x < end)
      return true;
  return false;
}

/* ------------------------------------------------------------------ adding seeds */

/* Adds seeds in the pixels x .. end - 1 of row y that lie in the enclosure. */
static CeldStatus
paint_in_enclosure (CeldSegmentTask *task, int y, int x, int end, uint32_t enclosure, uint32_t label)
{
  const CeldBasins *basins = task->basins;
  CeldStatus        status = CELD_OK;

  x   = x < 0 ? 0 : x;
  end = end > basins->width ? basins->width : end;
  for (size_t k = celd_basin_run (basins, x, y); x < end && status == CELD_OK; k++)
    {
      int next = celd_basin_run_end (basins, k, y);

      next = next < end ? next : end;
      if (basins->enclosure[basins->run[k].basin] == enclosure)
        status = celd_seed_rows_paint (&task->seeds, y, x, next, label);
      x = next;
    }
  return status;
}

/* Adds the seeds of a disc.  The enclosure has no seeds on its paper, and a disc has no ink, so no seed is overwritten.
 */
static CeldStatus
add_disc (CeldSegmentTask *task, const CeldSeedDisc *disc, uint32_t enclosure, uint32_t label)
{
  int        r = (int) disc->radius, top = disc->y - r, bottom = disc->y + r, x, end;
  CeldStatus status = CELD_OK;

  bottom = bottom < task->basins->height ? bottom : task->basins->height - 1;
  for (int y = top < 0 ? 0 : top; y <= bottom && status == CELD_OK; y++)
    if (celd_seed_disc_row (disc, y, &x, &end))
      status = paint_in_enclosure (task, y, x, end, enclosure, label);
  return status;
}

static uint32_t
enclosure_of (const CeldBasins *basins, CeldRelationEnd end)
{
  return end.there ? basins->enclosure[celd_basin_at (basins, end.x, end.y)] : 0;
}

static CeldStatus
add_relation (const CeldRelation *relation, CeldSegmentTask *task)
{
  CeldRelationEnd end[2] = { celd_relation_end_find (task, &relation->nearer),
                             celd_relation_end_find (task, &relation->farther) };
  uint32_t        enclosure[2] = { enclosure_of (task->basins, end[0]), enclosure_of (task->basins, end[1]) };
  uint32_t        label = 0;
  double          widest = task->settings->method != CELD_METHOD_BASINS ? INFINITY : MOST_BASIN_RADIUS;
  bool            same = enclosure[0] == enclosure[1];
  double          farthest = same ? CELD_DISC_RANGE * celd_relation_end_distance (end[0], end[1]) : INFINITY;
  CeldStatus      status = CELD_OK;

  for (int i = 0; i < 2 && status == CELD_OK; i++)
    {
      CeldSeedDiscs discs;

      if (!enclosure[i] || task->seeded[enclosure[i]])
        continue;
      if (!label || !relation->equal)
        status = celd_task_add_arrow_label (task, &label);
      discs = celd_seed_discs_find (task, end[i], farthest, widest);
      for (int k = 0; k < 2 && status == CELD_OK; k++)
        status = add_disc (task, &discs.disc[k], enclosure[i], label);
      task->seeded[enclosure[i]] = true;
    }
  return status;
}

bool
celd_arrow_seeds_needed (const CeldSegmentTask *task, const CeldRelation *relation)
{
  uint32_t enclosure[2] = { enclosure_of (task->basins, celd_relation_end_find (task, &relation->nearer)),
                       enclosure_of (task->basins, celd_relation_end_find (task, &relation->farther)) };

  return (enclosure[0] && !task->seeded[enclosure[0]]) || (enclosure[1] && !task->seeded[enclosure[1]]);
}

CeldStatus
celd_arrow_seeds_add (const CeldRelations *relations, const CeldHost *host, CeldSegmentTask *task)
{
  CeldStatus status = CELD_OK;

  if (!relations->n)
    return CELD_OK;
  task->seeded = celd_alloc0 (task->basins->n_enclosures + 1, sizeof *task->seeded);
  if (!task->seeded)
    return CELD_NO_MEMORY;
  for (int y = 0; y < task->basins->height; y++)
    mark_seeded (task, y);
  for (size_t i = 0; i < relations->n && status == CELD_OK; i++)
    {
      if (celd_arrow_seeds_needed (task, &relations->item[i]))
        {
          task->n_effective = i + 1;
          status = add_relation (&relations->item[i], task);
        }
      if (status == CELD_OK && i % 256 == 0)
        status = celd_progress (host, (double) i / (double) relations->n);
    }
  return status;
}

/* ------------------------------------------------------------------ ends that are separate already */

static bool
lies_on (const CeldPatches *patches, CeldRelationEnd end)
{
  for (size_t i = 0; i < patches->n; i++)
    if (patches->item[i].y == end.y && patches->item[i].x <= end.x && patches->item[i].end > end.x)
      return true;
  return false;
}

bool
celd_regions_are_separate (const CeldSegmentTask *task, const CeldRelation *relation, const CeldLabels *labels,
                           const CeldPatches *patches)
{
  CeldRelationEnd a = celd_relation_end_find (task, &relation->nearer);
  CeldRelationEnd b = celd_relation_end_find (task, &relation->farther);

  if (relation->equal || !a.there || !b.there)
    return true;
  return CELD_AT (labels, a.x, a.y) != CELD_AT (labels, b.x, b.y) && !lies_on (patches, a) && !lies_on (patches, b);
}
