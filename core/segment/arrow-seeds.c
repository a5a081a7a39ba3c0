/* Arrows as strokes: the expert gesture of section 4 ("generate scribbles with a newly added depth inequality")
 * and Figure 2, which has two arrows and nothing else.
 *
 * An end in a room that nothing reaches makes that room a label.  Equalities never part their ends: both share one
 * label.  What this costs goes by the seeds and the size of the discs, not by the picture.  Where both ends of an
 * inequality end up in one region, split.c goes on.
 *
 * A seed of one pixel would collapse: to wrap it is cheaper than any cut across.  So an end is seeded with discs that
 * touch the contours beside it: one round the end, one on the summit of the distance to ink above it.  Where both ends
 * of a relation lie in one region, all discs of an end are nearer to it than half the way to the other end; a cut
 * between the ends is then cheaper across a gap than round a disc.  The distance to ink is looked for in the drawing,
 * row by row outwards; at the maximum of a basin it is known.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "segment/basins.h"
#include "segment/canvas.h"
#include "segment/splits.h"

#include <math.h>

#define WIDEST 8    /* discs are at most 1/8 of the shorter side */
#define ROUND  64   /* pixels; the disc round an end is no larger: the one on the summit is */
#define ON_BASINS 12 /* pixels: the radius of discs where no cut could run round one, as it would take in its basin */

/* ------------------------------------------------------------------ ends of relations */

CeldRelationEnd
celd_end_find (const CeldCanvas *canvas, const CeldTerm *term)
{
  const CeldBasins *basins = canvas->basins;
  CeldRelationEnd           end = { 0 };

  if (term->by_colour || !(term->x >= 0 && term->y >= 0 && term->x < basins->width && term->y < basins->height))
    return end;
  end.x     = (int) term->x;
  end.y     = (int) term->y;
  end.there = celd_is_paper (CELD_AT (canvas->ink, end.x, end.y)) ||
              celd_paper_near (canvas->ink, basins->stroke, &end.x, &end.y);
  return end;
}

double
celd_ends_apart (CeldRelationEnd a, CeldRelationEnd b)
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

/* The squared distance from (x,y) to ink in row v, if it is less than `least`. */
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

/* The squared distance from (x,y) to the nearest ink, at most that of `limit`. */
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

typedef struct { const CeldCanvas *canvas; CeldRelationEnd end; double reach, widest; } Search;

static double
shorter_side (const CeldCanvas *canvas)
{
  return canvas->basins->width < canvas->basins->height ? canvas->basins->width : canvas->basins->height;
}

/* The largest disc round (x,y) that touches no ink, this squared distance away. */
static CeldDisc
disc_of (const Search *search, int x, int y, int32_t squared)
{
  double radius = fmin (sqrt (squared) - 0.5, search->widest);

  radius = fmin (radius, search->reach - hypot (x - search->end.x, y - search->end.y));
  return (CeldDisc) { x, y, fmax (0, radius) };
}

static CeldDisc
disc_at (const Search *search, int x, int y, double most)
{
  double limit = fmin (most, search->reach - hypot (x - search->end.x, y - search->end.y));

  return disc_of (search, x, y, to_ink (search->canvas->ink, x, y, fmax (0, limit) + 1));
}

/* One step to where the disc is larger, without leaving the paper that the disc covers; false on a summit. */
static bool
climb (const Search *search, int step, CeldDisc *disc)
{
  const CeldPlane *ink = search->canvas->ink;
  CeldDisc         best = *disc;

  for (int v = -1; v <= 1; v++)
    for (int u = -1; u <= 1; u++)
      {
        int      x = disc->x + u * step, y = disc->y + v * step;
        CeldDisc other;

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

/* Climbs in ever shorter steps, each less than the disc is wide: no line of ink is stepped over. */
static CeldDisc
climb_to_summit (const Search *search, CeldDisc disc)
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

CeldDiscs
celd_discs_find (const CeldCanvas *canvas, CeldRelationEnd end, double reach, double widest)
{
  const CeldBasin *basin = &canvas->basins->basin[celd_basin_at (canvas->basins, end.x, end.y)];
  Search           search = { canvas, end, reach, fmin (widest, fmax (1, shorter_side (canvas) / WIDEST)) };
  CeldDiscs        discs = { .disc = { disc_at (&search, end.x, end.y, fmin (search.widest, ROUND)) } };
  CeldDisc         summit = discs.disc[0];

  if (!basin->solid)
    summit = disc_of (&search, basin->x, basin->y, basin->squared);
  if (summit.radius < discs.disc[0].radius)
    summit = discs.disc[0];
  if (reach < INFINITY)
    {
      summit = climb_to_summit (&search, summit);
      discs.room = to_ink (canvas->ink, summit.x, summit.y, 2 * search.widest);
    }
  discs.disc[1] = summit;
  return discs;
}

bool
celd_disc_row (const CeldDisc *disc, int y, int *x, int *end)
{
  double left = disc->radius * disc->radius - (y - disc->y) * (y - disc->y);
  int    half = left >= 0 ? (int) sqrt (left) : 0;

  *x   = disc->x - half;
  *end = disc->x + half + 1;
  return left >= 0;
}

/* ------------------------------------------------------------------ what seeds reach */

static bool
has_paper (const CeldPlane *ink, int y, int x, int end)
{
  for (; x < end; x++)
    if (celd_is_paper (CELD_AT (ink, x, y)))
      return true;
  return false;
}

/* The rooms on whose paper the seeds of row y lie; both are runs from left to right. */
static void
reach_along (const CeldCanvas *canvas, int y)
{
  const CeldBasins  *basins = canvas->basins;
  const CeldSeedRow *row = &canvas->seeds.row[y];
  size_t             k = basins->row[y], last = basins->row[y + 1] - 1;

  for (size_t i = 0; i < row->n; i++)
    for (int x = row->run[i].x, end; x < row->run[i].end; x = end)
      {
        uint32_t room;

        while (k < last && basins->run[k + 1].x <= x)
          k++;
        end  = k < last && basins->run[k + 1].x < row->run[i].end ? basins->run[k + 1].x : row->run[i].end;
        room = basins->room[basins->run[k].basin];
        if (!canvas->reached[room])
          canvas->reached[room] = has_paper (canvas->ink, y, x, end);
      }
}

/* ------------------------------------------------------------------ planting */

/* Paints those pixels x .. end - 1 of row y that lie in the room and have no seed. */
static CeldStatus
paint_in_room (CeldCanvas *canvas, int y, int x, int end, uint32_t room, uint32_t label)
{
  const CeldBasins *basins = canvas->basins;
  CeldStatus        status = CELD_OK;

  x   = x < 0 ? 0 : x;
  end = end > basins->width ? basins->width : end;
  for (size_t k = celd_basin_run (basins, x, y); x < end && status == CELD_OK; k++)
    {
      int next = celd_basin_run_end (basins, k, y);

      next = next < end ? next : end;
      if (basins->room[basins->run[k].basin] == room)
        status = celd_seed_rows_paint (&canvas->seeds, y, x, next, label);
      x = next;
    }
  return status;
}

/* A room that nothing reaches has no seed on its paper, and a disc holds no ink: there is nothing to spare. */
static CeldStatus
plant_disc (CeldCanvas *canvas, const CeldDisc *disc, uint32_t room, uint32_t label)
{
  int        r = (int) disc->radius, top = disc->y - r, bottom = disc->y + r, x, end;
  CeldStatus status = CELD_OK;

  bottom = bottom < canvas->basins->height ? bottom : canvas->basins->height - 1;
  for (int y = top < 0 ? 0 : top; y <= bottom && status == CELD_OK; y++)
    if (celd_disc_row (disc, y, &x, &end))
      status = paint_in_room (canvas, y, x, end, room, label);
  return status;
}

static uint32_t
room_of (const CeldBasins *basins, CeldRelationEnd end)
{
  return end.there ? basins->room[celd_basin_at (basins, end.x, end.y)] : 0;
}

static CeldStatus
plant_relation (const CeldRelation *relation, CeldCanvas *canvas)
{
  CeldRelationEnd    end[2] = { celd_end_find (canvas, &relation->nearer), celd_end_find (canvas, &relation->farther) };
  uint32_t   room[2] = { room_of (canvas->basins, end[0]), room_of (canvas->basins, end[1]) }, label = 0;
  double     widest = canvas->settings->method != CELD_METHOD_BASINS ? INFINITY : ON_BASINS;
  double     reach = room[0] == room[1] ? CELD_REACH * celd_ends_apart (end[0], end[1]) : INFINITY;
  CeldStatus status = CELD_OK;

  for (int i = 0; i < 2 && status == CELD_OK; i++)
    {
      CeldDiscs discs;

      if (!room[i] || canvas->reached[room[i]])
        continue;
      if (!label || !relation->equal)
        status = celd_hue_add (canvas, &label);
      discs = celd_discs_find (canvas, end[i], reach, widest);
      for (int k = 0; k < 2 && status == CELD_OK; k++)
        status = plant_disc (canvas, &discs.disc[k], room[i], label);
      canvas->reached[room[i]] = true;
    }
  return status;
}

bool
celd_seeds_wanted (const CeldCanvas *canvas, const CeldRelation *relation)
{
  uint32_t room[2] = { room_of (canvas->basins, celd_end_find (canvas, &relation->nearer)),
                       room_of (canvas->basins, celd_end_find (canvas, &relation->farther)) };

  return (room[0] && !canvas->reached[room[0]]) || (room[1] && !canvas->reached[room[1]]);
}

CeldStatus
celd_seeds_plant (const CeldRelations *relations, const CeldHost *host, CeldCanvas *canvas)
{
  CeldStatus status = CELD_OK;

  if (!relations->n)
    return CELD_OK;
  canvas->reached = celd_alloc0 (canvas->basins->n_rooms + 1, sizeof *canvas->reached);
  if (!canvas->reached)
    return CELD_NO_MEMORY;
  for (int y = 0; y < canvas->basins->height; y++)
    reach_along (canvas, y);
  for (size_t i = 0; i < relations->n && status == CELD_OK; i++)
    {
      if (celd_seeds_wanted (canvas, &relations->item[i]))
        {
          canvas->acting = i + 1;
          status = plant_relation (&relations->item[i], canvas);
        }
      if (status == CELD_OK && i % 256 == 0)
        status = celd_progress (host, (double) i / (double) relations->n);
    }
  return status;
}
