/* Shafts: smooth lines inside the paint between places where arrows may end.
 *
 * Between two places a line goes forward along their chord in equal steps, and moves across by up to SHAFT_TURNS
 * units in each.  Of all such lines the cheapest is found by dynamic programming over where it is and how it moved
 * there; it costs most where it bends, or leaves the middle of the paint.  Almost all pairs of places end after a few
 * steps, because nothing is painted between them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/arrow-search.h"

#include <math.h>
#include <stdlib.h>

/* All chosen; lengths are widths of the paint. */
#define STEP            2    /* along the chord */
#define SHAFT_TURNS     7    /* units across in a step, at most, ... */
#define UNITS           12   /* ... of which so many are a step */
#define WAYS            (2 * SHAFT_TURNS + 1)
#define SHAFT_LEAST     5.5  /* length of a shaft */
#define MOST_BOW        0.16 /* distance from the chord, by its length, ... */
#define MORE_BOW        0.8  /* ... and more */
#define END_OFF         0.6  /* from a place to where the line ends, at most, ... */
#define END_COST        0.4  /* ... and what its square costs */
#define BEND_COST       6    /* of the square of a turn in radians, by the length of a step */
#define BARE_COST       1.2  /* of what is not painted, by its length */
#define SHAFT_ROOM      0.36 /* to the edge of the paint; less of it, ... */
#define THIN_ROOM       0.15 /* ... or of arrows that taper, ... */
#define LESS_ROOM       0.6  /* ... and so many pixels less, costs something: */
#define ROOM_COST       6    /* the square of what is missing, by length */
#define SAMPLE          0.34 /* between samples of the paint */
#define SHAFT_MOST_COST 0.8  /* of a shaft */

/* The cheapest line to a point that comes there in a certain way: what it costs, and where and how it came before. */
typedef struct { float cost; int16_t before, way; } State;

typedef struct
{
  const CeldArrowSearch *s;
  CeldPoint              from, along, across; /* directions of length 1 */
  double                 length, step, unit;
  int                    steps, half;         /* of units on either side of the chord */
  int                    low, high;           /* units that the last column has */
  int                    end;                 /* units that a line may be off at its ends */
  double                 bend[2 * WAYS];      /* what it costs to turn by so many units, from 1 - WAYS on */
  State                 *state;
  size_t                 capacity;
} Chord;

static State *
state_at (const Chord *c, int column, int unit, int way)
{
  return &c->state[((size_t) column * (size_t) (2 * c->half + 1) + (size_t) (unit + c->half)) * WAYS + (size_t) way];
}

static CeldPoint
point_at (const Chord *c, int column, int unit)
{
  return celd_moved (celd_moved (c->from, c->along, column * c->step), c->across, unit * c->unit);
}

/* What a straight part of a line costs for the paint that it leaves. */
static double
paint_cost (const CeldArrowSearch *s, CeldPoint a, CeldPoint b)
{
  double w = s->width, length = celd_points_apart (a, b) / w, cost = 0;
  int    n = (int) fmax (1, ceil (length / SAMPLE));

  for (int i = 0; i < n; i++)
    {
      double room = celd_search_room (s, celd_search_between (a, b, (i + 0.5) / n));
      double missing = (s->style != CELD_ARROW_TAPER ? SHAFT_ROOM : THIN_ROOM) - (room + LESS_ROOM) / w;

      if (room <= 0)
        cost += BARE_COST * length / n;
      else if (missing > 0)
        cost += ROOM_COST * missing * missing * length / n;
    }
  return cost;
}

static double
end_cost (const Chord *c, int unit)
{
  double off = unit * c->unit / c->s->width;

  return END_COST * off * off;
}

/* The cheapest way to come to (column - 1, unit) and then go on by `way`: how it came. */
static int
cheapest_before (const Chord *c, int column, int unit, int way, double *cost)
{
  const State *from = state_at (c, column - 1, unit, 0);
  int          best = 0;

  *cost = INFINITY;
  for (int e = 0; e < WAYS; e++)
    {
      double before = from[e].cost;

      if (before >= *cost)
        continue;
      if (column > 1)
        before += c->bend[way - e + WAYS - 1];
      if (before < *cost)
        {
          *cost = before;
          best  = e;
        }
    }
  return best;
}

/* Goes on from a point of the last column in all ways. */
static void
go_on (Chord *c, int column, int unit, int *low, int *high)
{
  double most = (MOST_BOW * c->length * sin (CELD_PI * column / c->steps) + MORE_BOW * c->s->width) / c->unit;
  bool   here = false;

  for (int way = 0; way < WAYS; way++)
    here |= state_at (c, column - 1, unit, way)->cost <= SHAFT_MOST_COST;
  if (!here)
    return;
  for (int way = 0; way < WAYS; way++)
    {
      int    to = unit + way - SHAFT_TURNS, before;
      double cost;

      if (abs (to) > fmin (most, c->half) || (column == c->steps && abs (to) > c->end))
        continue;
      before = cheapest_before (c, column, unit, way, &cost);
      if (cost <= SHAFT_MOST_COST)
        cost += paint_cost (c->s, point_at (c, column - 1, unit), point_at (c, column, to));
      if (column == c->steps)
        cost += end_cost (c, to);
      if (cost > SHAFT_MOST_COST || cost >= state_at (c, column, to, way)->cost)
        continue;
      *state_at (c, column, to, way) = (State) { (float) cost, (int16_t) unit, (int16_t) before };
      *low  = to < *low ? to : *low;
      *high = to > *high ? to : *high;
    }
}

static void
clear_column (Chord *c, int column, int low, int high)
{
  for (int unit = low; unit <= high; unit++)
    for (int way = 0; way < WAYS; way++)
      state_at (c, column, unit, way)->cost = INFINITY;
}

/* Follows all lines along the chord; false if none gets to its end. */
static bool
follow (Chord *c)
{
  clear_column (c, 0, -c->end, c->end);
  for (int unit = -c->end; unit <= c->end; unit++)
    *state_at (c, 0, unit, SHAFT_TURNS) = (State) { (float) end_cost (c, unit), 0, 0 };
  c->low  = -c->end;
  c->high = c->end;
  for (int column = 1; column <= c->steps; column++)
    {
      int low = c->half + 1, high = -c->half - 1;

      clear_column (c, column, c->low - SHAFT_TURNS < -c->half ? -c->half : c->low - SHAFT_TURNS,
                    c->high + SHAFT_TURNS > c->half ? c->half : c->high + SHAFT_TURNS);
      for (int unit = c->low; unit <= c->high; unit++)
        go_on (c, column, unit, &low, &high);
      if (low > high)
        return false;
      c->low  = low;
      c->high = high;
    }
  return true;
}

/* Traces the cheapest line back. */
static CeldStatus
add_shaft (CeldArrowSearch *s, const Chord *c, size_t a, size_t b)
{
  CeldShaft  shaft = {
    .place = { a, b }, .n = (size_t) c->steps + 1, .length = c->length, .whole = CELD_NO_SHAFT,
  };
  int        unit = c->low, way = 0;
  CeldStatus status;

  for (int u = c->low; u <= c->high; u++)
    for (int k = 0; k < WAYS; k++)
      if (state_at (c, c->steps, u, k)->cost < state_at (c, c->steps, unit, way)->cost)
        {
          unit = u;
          way  = k;
        }
  shaft.cost = (double) state_at (c, c->steps, unit, way)->cost;
  shaft.at   = celd_alloc (shaft.n, sizeof *shaft.at);
  if (!shaft.at)
    return CELD_NO_MEMORY;
  for (int column = c->steps; column >= 0; column--)
    {
      State state = *state_at (c, column, unit, way);

      shaft.at[column] = point_at (c, column, unit);
      shaft.bow        = fmax (shaft.bow, abs (unit) * c->unit / c->length);
      unit             = state.before;
      way              = state.way;
    }
  status = celd_append (s->shaft, s->n_shafts, s->shaft_capacity, shaft);
  if (status != CELD_OK)
    celd_free (shaft.at);
  return status;
}

static CeldStatus
try_pair (CeldArrowSearch *s, Chord *c, size_t a, size_t b)
{
  CeldPoint p = s->place[a], q = s->place[b];
  size_t    n;

  c->length = celd_points_apart (p, q);
  if (c->length < SHAFT_LEAST * s->width)
    return CELD_OK;
  c->from   = p;
  c->along  = (CeldPoint) { (q.x - p.x) / c->length, (q.y - p.y) / c->length };
  c->across = (CeldPoint) { -c->along.y, c->along.x };
  c->steps  = (int) fmax (4, round (c->length / (STEP * s->width)));
  c->step   = c->length / c->steps;
  c->unit   = c->step / UNITS;
  c->half   = (int) ceil ((MOST_BOW * c->length + MORE_BOW * s->width) / c->unit);
  c->end    = (int) (END_OFF * s->width / c->unit);
  for (int k = 0; k < 2 * WAYS; k++)
    {
      double turn = (double) (k + 1 - WAYS) / UNITS;

      c->bend[k] = BEND_COST * turn * turn * s->width / c->step;
    }
  n         = (size_t) (c->steps + 1) * (size_t) (2 * c->half + 1) * WAYS;
  if (n > c->capacity)
    {
      celd_free (c->state);
      c->capacity = 0;
      c->state    = celd_alloc (n, sizeof *c->state);
      if (!c->state)
        return CELD_NO_MEMORY;
      c->capacity = n;
    }
  return follow (c) ? add_shaft (s, c, a, b) : CELD_OK;
}

CeldStatus
celd_search_shafts_find (CeldArrowSearch *search)
{
  Chord      c = { .s = search };
  CeldStatus status = CELD_OK;

  for (size_t a = 0; a < search->n_places; a++)
    for (size_t b = a + 1; b < search->n_places && status == CELD_OK; b++)
      status = try_pair (search, &c, a, b);
  celd_free (c.state);
  return status;
}

CeldPoint
celd_shaft_way (const CeldShaft *shaft, int end, double from)
{
  CeldPoint tip = shaft->at[end ? shaft->n - 1 : 0], p = tip;
  double    d = 0;

  for (size_t i = 1; i < shaft->n && d < from; i++)
    {
      p = shaft->at[end ? shaft->n - 1 - i : i];
      d = celd_points_apart (p, tip);
    }
  return (CeldPoint) { (tip.x - p.x) / d, (tip.y - p.y) / d };
}

double
celd_distance_to_shaft (const CeldShaft *shaft, CeldPoint p)
{
  double d = INFINITY;

  for (size_t i = 1; i < shaft->n; i++)
    d = fmin (d, celd_distance_to_part (p, shaft->at[i - 1], shaft->at[i]));
  return d;
}
