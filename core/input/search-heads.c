/* Heads and dots that fit the paint near the end of a line.
 *
 * A head is two barbs (open), or the triangle of their ends and the tip (filled).  Each barb may have any direction
 * and length that heads have; what is not painted costs, and what is painted beside the shaft is worth something.  A
 * barb that hardly leaves the paint of its shaft is not seen, and costs as much as if it were not painted.  The tip may
 * be a little off the place where the line should end.
 *
 * Where lines meet, barbs fit shafts and barbs of others better than their own paint.  So there are several open heads
 * of an end, and which of them it is shows in the choice of all arrows: one that takes the paint of others leaves its
 * own unexplained.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/arrow-search.h"

#include <math.h>
#include <stdlib.h>

/* All chosen; lengths are widths of the paint. */
#define FIT_TIP_STEP  0.35 /* between places that are tried for a tip, ... */
#define TIP_BEHIND    3    /* ... of which so many are behind where the line should end, ... */
#define TIP_AHEAD     2    /* ... and so many ahead; one on either side; ... */
#define TIP_TURN      0.1  /* ... and radians by which the head may be turned either way */
#define OPEN_OFF      0.15 /* cost of each such step, of an open head, ... */
#define FILLED_OFF    0.1  /* ... and of a filled one */
#define OPEN_LEAST    0.36 /* radians from the shaft to a barb, at least, ... */
#define OPEN_TURN     0.08 /* ... in such steps, ... */
#define OPEN_TURNS    6    /* ... of which there are so many */
#define OPEN_USUAL    2.6  /* of those steps; ... */
#define OPEN_UNUSUAL  0.02 /* ... and what each step costs */
#define OPEN_STEP     0.25 /* along a barb, ... */
#define OPEN_STEPS    19   /* ... of which there are at most so many */
#define OPEN_LENGTH   3    /* of a barb, at least, ... */
#define OPEN_BESIDE   2    /* ... and of what of it is beside the shaft */
#define OPEN_UNLIKE   0.06 /* cost of barbs that turn by different steps, by the square of that, ... */
#define OPEN_LONGER   0.15 /* ... and of those of different lengths, by the square of what is more than ... */
#define OPEN_ALIKE    0.5  /* ... this; ... */
#define OPEN_MORE     1    /* ... what is more than this is no part of the longer one */
#define OPEN_TURNED   0.15 /* cost of a head that is turned */
#define OPEN_WORSE    2.5  /* costs by which other heads of an end may be worse than the best one */
#define OPEN_ROOM     0.22 /* from a barb to the edge of its paint, and a third of a pixel less */
#define OPEN_WORTH    0.5  /* of a barb beside the shaft, by its length */
#define FILLED_LEAST  0.42 /* as for open heads */
#define FILLED_TURN   0.09
#define FILLED_TURNS  4
#define FILLED_LENGTH 2.9  /* of the sides, at least, ... */
#define FILLED_LONGER 0.6  /* ... and in such steps, ... */
#define FILLED_STEPS  4    /* ... of which there are so many */
#define FILLED_BESIDE 0.8  /* area of a half that is beside the shaft, at least */
#define FILLED_AHEAD  0.4  /* from where a line ends to the tip of the triangle */
#define FILLED_BARE   2    /* cost of what is not painted while heads are compared */
#define FILLED_MOST   6.5  /* that half a head is worth, for its area */
#define FIT_SAMPLES   8    /* of a side of a triangle, ... */
#define ALL_SAMPLES   (FIT_SAMPLES * (FIT_SAMPLES + 1) / 2) /* ... and of all of it */
#define BARE          1.5  /* cost of what is not painted, by area */
#define FIT_OFF       0.2  /* cost of a tip that is off its place, by the distance */
#define DOT_STEP      0.25 /* between places that are tried for the centre of a dot, ... */
#define DOT_STEPS     2    /* ... of which so many are on either side */
#define FIT_DOT_LEAST 1.1  /* radius of a dot, at least, without soft edges, ... */
#define DOT_MOST      1.9  /* ... and at most */
#define FIT_DOT_MORE  0.2  /* ... and more that its paint has */
#define DOT_OFF       0.05

static bool
is_beside (const CeldArrowSearch *s, CeldPoint p, const uint8_t *shaft)
{
  size_t cell = celd_search_cell (s, p);

  return !shaft || (cell != SIZE_MAX && !shaft[cell]);
}

static CeldPoint
direction (double angle)
{
  return (CeldPoint) { cos (angle), sin (angle) };
}

/* How far a barb is painted, in widths, and how much of that is beside the shaft. */
static double
painted_length (const CeldArrowSearch *s, CeldPoint tip, CeldPoint way, const uint8_t *shaft, double *beside)
{
  double run = 0;
  int    gap = 0;

  *beside = 0;
  for (int i = 1; i <= OPEN_STEPS; i++)
    {
      CeldPoint p = celd_moved (tip, way, i * OPEN_STEP * s->width);

      if (celd_search_room (s, p) < OPEN_ROOM * s->width - 0.3)
        {
          if (++gap > 1)
            break;
          continue;
        }
      gap      = 0;
      run      = i * OPEN_STEP;
      *beside += is_beside (s, p, shaft) ? OPEN_STEP : 0;
    }
  return run;
}

/* The directions of a head that are tried: of its axis, backwards, and of the barbs on either side. */
typedef struct { CeldPoint back, way[2][OPEN_TURNS]; } HeadWays;

/* A barb that may be: what it costs, how far it is painted, and what of it is missing, in widths. */
typedef struct { double cost, run, missing; } BarbFit;

static BarbFit
fit_barb (const CeldArrowSearch *s, CeldPoint tip, CeldPoint way, int k, const uint8_t *shaft)
{
  double beside, run = painted_length (s, tip, way, shaft, &beside);
  double missing = fmax (0, fmax (OPEN_LENGTH - run, shaft ? OPEN_BESIDE - beside : 0));

  return (BarbFit) {
    .cost    = BARE * missing - OPEN_WORTH * beside + OPEN_UNUSUAL * fabs (k - OPEN_USUAL),
    .run     = run,
    .missing = missing,
  };
}

/* Which of CELD_MOST_HEADS open heads those are whose barbs turn by so many steps: each is narrow or wide on either
 * side. */
static int
number_of (int one, int other)
{
  return (one >= OPEN_TURNS / 2) + 2 * (other >= OPEN_TURNS / 2);
}

/* What two barbs cost that are not alike, as those of a head are. */
static double
unlike_cost (const BarbFit *a, const BarbFit *b, int turn)
{
  double longer = fmax (0, fabs (a->run - b->run) - OPEN_ALIKE);

  return OPEN_UNLIKE * turn * turn + OPEN_LONGER * longer * longer;
}

/* Replaces the open heads that cost more than some with a certain tip.  cost: of this tip while heads are compared;
 * off: what stays of that later. */
static void
fit_open (const CeldArrowSearch *s, CeldPoint tip, const HeadWays *ways, const uint8_t *shaft, double cost, double off,
          CeldHeadOutline *heads, double *least)
{
  BarbFit fit[2][OPEN_TURNS];

  for (int side = 0; side < 2; side++)
    for (int k = 0; k < OPEN_TURNS; k++)
      fit[side][k] = fit_barb (s, tip, ways->way[side][k], k, shaft);
  for (int i = 0; i < OPEN_TURNS; i++)
    for (int k = 0; k < OPEN_TURNS; k++)
      {
        const BarbFit *a = &fit[0][i], *b = &fit[1][k];
        int            n = number_of (i, k);
        double         unlike = unlike_cost (a, b, i - k), all = cost + a->cost + b->cost + unlike, w = s->width;

        if (all >= least[n])
          continue;
        least[n] = all;
        heads[n] = (CeldHeadOutline) {
          .kind = CELD_OUTLINE_OPEN,
          .tip  = tip,
          .barb = { celd_moved (tip, ways->way[0][i], fmin (a->run, b->run + OPEN_MORE) * w),
                    celd_moved (tip, ways->way[1][k], fmin (b->run, a->run + OPEN_MORE) * w) },
          .cost = BARE * (a->missing + b->missing) + unlike + off,
        };
      }
}

/* Counts samples of a triangle: those that are not painted (*bare), and those that are beside the shaft.  Returns false
 * as soon as bare ones, and half as many others on the shaft, are more than `most`: corner b is the first, where most
 * triangles are seen not to fit. */
static bool
sample_triangle (const CeldArrowSearch *s, CeldPoint a, CeldPoint b, CeldPoint c, const uint8_t *shaft, double most,
                 int *bare, int *beside)
{
  int on = 0;

  *bare = *beside = 0;
  for (int i = FIT_SAMPLES - 1; i >= 0; i--)
    {
      for (int k = 0; k < FIT_SAMPLES - i; k++)
        {
          double    u = (i + 0.33) / FIT_SAMPLES, v = (k + 0.33) / FIT_SAMPLES;
          CeldPoint p = { a.x + u * (b.x - a.x) + v * (c.x - a.x), a.y + u * (b.y - a.y) + v * (c.y - a.y) };

          if (celd_search_room (s, p) <= 0)
            ++*bare;
          else if (is_beside (s, p, shaft))
            ++*beside;
          else
            on++;
        }
      if ((FILLED_BARE + 1) * *bare + on > most)
        return false;
    }
  return true;
}

/* The same for the half of a filled head on one side of its axis, `back`.  INFINITY: it costs at least `most`. */
static double
fit_filled (const CeldArrowSearch *s, CeldPoint tip, CeldPoint ahead, CeldPoint back, const CeldPoint *way,
            const uint8_t *shaft, double most, CeldPoint *end, double *bare)
{
  double best = INFINITY, w = s->width;

  for (int k = 0; k < FILLED_TURNS; k++)
    for (int l = 0; l < FILLED_STEPS; l++)
      {
        double    length = (FILLED_LENGTH + FILLED_LONGER * l) * w;
        CeldPoint corner = celd_moved (tip, way[k], length);
        CeldPoint foot = celd_moved (tip, back, length * cos (FILLED_LEAST + FILLED_TURN * k));
        double    area = fabs ((corner.x - ahead.x) * (foot.y - ahead.y) - (corner.y - ahead.y) * (foot.x - ahead.x));
        double    cost, missing, beside;
        int       n_bare, n_beside;

        area /= 2 * w * w;
        if (!sample_triangle (s, ahead, corner, foot, shaft,
                              ALL_SAMPLES * (1 + fmin (best, most) / area) + 1e-6, &n_bare, &n_beside))
          continue;
        beside  = area * n_beside / ALL_SAMPLES;
        missing = fmax (area * n_bare / ALL_SAMPLES, shaft ? FILLED_BESIDE - beside : 0);
        cost    = FILLED_BARE * missing - beside;
        if (cost < best)
          {
            best  = cost;
            *bare = missing;
            *end  = corner;
          }
      }
  return best;
}

static HeadWays
ways_of (bool filled, double angle)
{
  HeadWays ways = { .back = direction (angle + CELD_PI) };

  for (int k = 0; k < (filled ? FILLED_TURNS : OPEN_TURNS); k++)
    for (int side = 0; side < 2; side++)
      {
        double turn = filled ? FILLED_LEAST + FILLED_TURN * k : OPEN_LEAST + OPEN_TURN * k;

        ways.way[side][k] = direction (angle + CELD_PI + (1 - 2 * side) * turn);
      }
  return ways;
}

/* Replaces a filled head that costs more than the best one with a certain tip, in the same way. */
static void
fit_both (const CeldArrowSearch *s, CeldPoint tip, CeldPoint ahead, const HeadWays *ways, const uint8_t *shaft,
          double cost, double off, CeldHeadOutline *head, double *least)
{
  CeldPoint end[2];
  double    bare[2];

  for (int k = 0; k < 2 && cost - (2 - k) * FILLED_MOST < *least; k++)
    cost += fit_filled (s, tip, ahead, ways->back, ways->way[k], shaft, *least - cost + (1 - k) * FILLED_MOST, &end[k],
                        &bare[k]);
  if (cost >= *least)
    return;
  *least = cost;
  *head  = (CeldHeadOutline) { CELD_OUTLINE_FILLED, tip, { end[0], end[1] }, 0, BARE * (bare[0] + bare[1] + off) };
}

/* Keeps the heads that are not much worse than the best one, that one first.  Returns their number. */
static int
keep_good (CeldHeadOutline *heads, double *least)
{
  CeldHeadOutline first = heads[0];
  double          most;
  int             best = 0, n = 1;

  for (int k = 1; k < CELD_MOST_HEADS; k++)
    best = least[k] < least[best] ? k : best;
  most        = least[best] + OPEN_WORSE;
  heads[0]    = heads[best];
  heads[best] = first;
  least[best] = least[0];
  for (int k = 1; k < CELD_MOST_HEADS; k++)
    if (least[k] < most)
      heads[n++] = heads[k];
  return n;
}

int
celd_search_heads_fit (const CeldArrowSearch *s, CeldOutlineKind kind, CeldPoint place, CeldPoint way,
                       const uint8_t *shaft, CeldHeadOutline *heads)
{
  bool      filled = kind == CELD_OUTLINE_FILLED;
  double    w = s->width, angle = atan2 (way.y, way.x), least[CELD_MOST_HEADS];
  CeldPoint across = { -way.y, way.x };

  for (int k = 0; k < CELD_MOST_HEADS; k++)
    least[k] = INFINITY;
  for (int turn = -1; turn <= 1; turn++)
    {
      HeadWays ways = ways_of (filled, angle + turn * TIP_TURN);

      for (int on = -TIP_BEHIND; on <= TIP_AHEAD; on++)
        for (int off = -1; off <= 1; off++)
          {
            CeldPoint on_axis = celd_moved (place, way, on * FIT_TIP_STEP * w);
            CeldPoint tip = celd_moved (on_axis, across, off * FIT_TIP_STEP * w);
            double    cost = (filled ? FILLED_OFF : OPEN_OFF) * (abs (turn) + abs (on) + abs (off));
            double    apart = FIT_OFF * celd_points_apart (tip, place) / w;

            if (filled)
              fit_both (s, tip, celd_moved (tip, way, FILLED_AHEAD * w), &ways, shaft, cost, apart, heads, least);
            else
              fit_open (s, tip, &ways, shaft, cost, apart + OPEN_TURNED * abs (turn), heads, least);
          }
    }
  return keep_good (heads, least);
}

/* The part of a disc that is not painted. */
static double
bare_disc (const CeldArrowSearch *s, CeldPoint centre, double radius)
{
  int all = 0, bare = 0, n = 6;

  for (int y = -n; y <= n; y++)
    for (int x = -n; x <= n; x++)
      if (x * x + y * y <= n * n)
        {
          all++;
          bare += celd_search_room (s, (CeldPoint) { centre.x + x * radius / n, centre.y + y * radius / n }) <= 0;
        }
  return (double) bare / all;
}

/* Is most of a circle painted? */
static bool
is_circle_painted (const CeldArrowSearch *s, CeldPoint centre, double radius)
{
  int bare = 0, n = 24;

  for (int i = 0; i < n; i++)
    bare += celd_search_room (s, celd_moved (centre, direction (2 * CELD_PI * i / n), radius)) <= 0;
  return bare <= n / 3;
}

CeldHeadOutline
celd_search_dot_fit (const CeldArrowSearch *s, CeldPoint place)
{
  double          w = s->width, best = INFINITY, least = celd_search_dot_radius (s, FIT_DOT_LEAST) / w, radius = least;
  CeldHeadOutline dot = { .kind = CELD_OUTLINE_DOT, .tip = place };

  for (int x = -DOT_STEPS; x <= DOT_STEPS; x++)
    for (int y = -DOT_STEPS; y <= DOT_STEPS; y++)
      {
        CeldPoint centre = { place.x + x * DOT_STEP * w, place.y + y * DOT_STEP * w };
        double    cost = CELD_PI * least * least * bare_disc (s, centre, least * w) + DOT_OFF * hypot (x, y);

        if (cost < best)
          {
            best    = cost;
            dot.tip = centre;
          }
      }
  while (radius < DOT_MOST && is_circle_painted (s, dot.tip, radius * w))
    radius += 0.1;
  dot.radius = (radius + FIT_DOT_MORE) * w;
  dot.cost   = BARE * best;
  return dot;
}
