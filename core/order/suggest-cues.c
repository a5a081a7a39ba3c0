/* What a drawing says of each pair of regions that touch: cues that one of them is in front.
 *
 * Two regions touch where the outline of one faces the other through the ink of their contour, or across paper where
 * the segmentation closed a gap.  A border that is shorter than the strokes are wide is none.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/vector.h"
#include "order/suggest.h"

#include <math.h>
#include <stdlib.h>

#define STRAIGHT  0.25          /* radians: how far the bar of a T may seem to turn */
#define DOUBT     0.03          /* of what a clear junction says */
#define DOUBT_UNCLEAR 0.2       /* and of any other */
#define SHORTEST_SIDE 1.0 /* stroke widths of a border */
#define ROUND     0.3           /* radians: a border that trials as much as this is hardly straight */
#define STEP      1.5           /* stroke widths between places at which a border's turning is measured */
#define PLACES    5             /* along a run of border, at which a place for an arrow's end is looked for */
#define DEEP      3.0           /* stroke widths that such an end lies inside, at most */

/* A pair as it is gathered: [0] is the outline of a, [1] that of b. */
typedef struct { CeldPairCues cues; double facing[2], turn[2], marks[2], bar, depth; } Pair;

typedef struct
{
  const CeldRegionOutlines    *outlines;
  const CeldPalette *palette;
  Pair              *pair;
  size_t             n;
  uint32_t          *slot;      /* a table of pairs by their labels: index + 1; 0 = free */
  size_t             n_slots;   /* a power of 2, more than twice n */
  double            *rim;       /* of label l: length of its outlines that face something, rim[l] */
  double            *whole;     /* and of all its outlines */
  double            *frame;     /* and of those along the frame */
  size_t             pair_capacity;
} Gathering;

/* ------------------------------------------------------------------ pairs by their labels */

static size_t
slot_of (const Gathering *g, uint32_t a, uint32_t b)
{
  uint64_t mixed = (a * UINT64_C (0x9e3779b97f4a7c15) + b) * UINT64_C (0xff51afd7ed558ccd);
  size_t   k = (size_t) (mixed >> 32) & (g->n_slots - 1);

  while (g->slot[k] && (g->pair[g->slot[k] - 1].cues.a != a || g->pair[g->slot[k] - 1].cues.b != b))
    k = (k + 1) & (g->n_slots - 1);
  return k;
}

static CeldStatus
grow_slots (Gathering *g)
{
  uint32_t *slot = celd_alloc0 (2 * g->n_slots, sizeof *slot);

  if (!slot)
    return CELD_NO_MEMORY;
  celd_free (g->slot);
  g->slot     = slot;
  g->n_slots *= 2;
  for (size_t i = 0; i < g->n; i++)
    slot[slot_of (g, g->pair[i].cues.a, g->pair[i].cues.b)] = (uint32_t) i + 1;
  return CELD_OK;
}

/* The pair of two labels, made if need be; *side is that of the label given first. */
static CeldStatus
find_pair (Gathering *g, uint32_t one, uint32_t other, Pair **pair, int *side)
{
  uint32_t a = one < other ? one : other, b = one < other ? other : one;
  size_t   k = slot_of (g, a, b);

  *side = one > other;
  if (!g->slot[k])
    {
      if (celd_append (g->pair, g->n, g->pair_capacity, (Pair) { .cues = { .a = a, .b = b } }) != CELD_OK)
        return CELD_NO_MEMORY;
      g->slot[k] = (uint32_t) g->n;
      if (2 * g->n >= g->n_slots && grow_slots (g) != CELD_OK)
        return CELD_NO_MEMORY;
      k = slot_of (g, a, b);
    }
  *pair = &g->pair[g->slot[k] - 1];
  return CELD_OK;
}

/* ------------------------------------------------------------------ along the outlines */

/* Places of a loop from `first` on, which may run over its end: point (loop, first + k). */
typedef struct { size_t first, n; uint32_t faces; double length; } Run;

static const CeldOutlinePoint *
point_of (const CeldRegionOutlines *outlines, const CeldOutlineLoop *loop, size_t i)
{
  return &outlines->point[loop->first + i % loop->n];
}

static double
between (const CeldOutlinePoint *p, const CeldOutlinePoint *q)
{
  return hypot ((double) (q->x - p->x), (double) (q->y - p->y));
}

/* The run that begins at place i. */
static Run
next_run (const CeldRegionOutlines *outlines, const CeldOutlineLoop *loop, size_t i, size_t end)
{
  Run run = { .first = i, .faces = point_of (outlines, loop, i)->faces };

  for (; i < end && point_of (outlines, loop, i)->faces == run.faces; i++, run.n++)
    run.length += between (point_of (outlines, loop, i), point_of (outlines, loop, i + 1));
  return run;
}

/* How much a run trials, without its ends: they are rounded by the contours that end there. */
static double
turning (const CeldRegionOutlines *outlines, const CeldOutlineLoop *loop, const Run *run)
{
  double              step = fmax (3, STEP * outlines->stroke), at = 0, next = run->n == loop->n ? 0 : step / 2, sum = 0;
  double              dx = 0, dy = 0;
  const CeldOutlinePoint *last = NULL;

  if (run->n == loop->n)
    {
      double area = 0; /* a closed outline trials once, inwards or outwards */

      for (size_t k = 0; k < run->n; k++)
        {
          const CeldOutlinePoint *p = point_of (outlines, loop, k), *q = point_of (outlines, loop, k + 1);

          area += (double) p->x * (double) q->y - (double) q->x * (double) p->y;
        }
      return area > 0 ? 2 * CELD_PI : -2 * CELD_PI;
    }
  for (size_t k = 0; k < run->n && at <= run->length - step / 2; k++)
    {
      const CeldOutlinePoint *p = point_of (outlines, loop, run->first + k);

      if (at >= next)
        {
          if (last)
            {
              double x = (double) (p->x - last->x), y = (double) (p->y - last->y);

              if (dx != 0 || dy != 0)
                sum += atan2 (dx * y - dy * x, dx * x + dy * y);
              dx = x;
              dy = y;
            }
          last = p;
          next = at + step;
        }
      at += between (p, point_of (outlines, loop, run->first + k + 1));
    }
  return sum;
}

/* ------------------------------------------------------------------ places for the ends of an arrow */

/* Half the way through a region from (*x,*y) on, as deep as arrows need; that place.  Starts in ink, if need be. */
static double
go_inside (const CeldRegionOutlines *outlines, uint32_t label, double dx, double dy, double *x, double *y)
{
  double most = DEEP * outlines->stroke + 4, way = 0;
  double u = *x, v = *y;

  for (int k = 0; k < 3 * outlines->stroke + 4 && celd_surface_at (outlines, (int) floor (u), (int) floor (v)) != label; k++)
    {
      u += dx;
      v += dy;
    }
  while (way < 2 * most && celd_surface_at (outlines, (int) floor (u + way * dx), (int) floor (v + way * dy)) == label)
    way++;
  *x = u + way / 2 * dx;
  *y = v + way / 2 * dy;
  return celd_surface_at (outlines, (int) floor (*x), (int) floor (*y)) == label ? way / 2 : 0;
}

/* Keeps the places at which both ends lie deepest. */
static void
try_place (const Gathering *g, const CeldOutlineLoop *loop, const Run *run, size_t i, int side, Pair *pair)
{
  const CeldRegionOutlines     *r = g->outlines;
  size_t              arm = (size_t) r->stroke + 2;
  const CeldOutlinePoint *p = point_of (r, loop, i), *q = point_of (r, loop, i + arm);
  const CeldOutlinePoint *o = point_of (r, loop, i + loop->n - arm % loop->n);
  double              dx = (double) (q->x - o->x), dy = (double) (q->y - o->y), length = hypot (dx, dy), depth;
  double              x[2] = { (double) p->x, (double) p->x }, y[2] = { (double) p->y, (double) p->y };

  if (!(length > 0))
    return;
  depth = fmin (go_inside (r, loop->label, -dy / length, dx / length, &x[0], &y[0]),
                go_inside (r, run->faces, dy / length, -dx / length, &x[1], &y[1]));
  if (depth <= pair->depth)
    return;
  pair->depth   = depth;
  pair->cues.ax = x[side];
  pair->cues.ay = y[side];
  pair->cues.bx = x[!side];
  pair->cues.by = y[!side];
}

/* ------------------------------------------------------------------ the cues */

/* A run of outline that faces another region. */
static CeldStatus
gather_run (Gathering *g, const CeldOutlineLoop *loop, const Run *run)
{
  Pair      *pair;
  int        side;
  CeldStatus status = find_pair (g, loop->label, run->faces, &pair, &side);

  if (status != CELD_OK)
    return status;
  pair->facing[side] += run->length;
  pair->turn[side]   += turning (g->outlines, loop, run);
  if (run->length >= SHORTEST_SIDE * g->outlines->stroke)
    for (size_t k = 0; k < PLACES; k++)
      try_place (g, loop, run, run->first + (2 * k + 1) * run->n / (2 * PLACES), side, pair);
  return CELD_OK;
}

/* A line inside a region that ends at its border: the outline runs along ink and back, and faces the same on both sides
 * of it. */
static CeldStatus
gather_mark (Gathering *g, const CeldOutlineLoop *loop, const Run *before, const Run *run, const Run *after)
{
  double stroke = g->outlines->stroke;
  Pair  *pair;
  int    side;

  if (run->faces || before->faces != after->faces || !before->faces || before->faces == CELD_FACES_FRAME ||
      run->length < CELD_SHORTEST_MARK * stroke || between (point_of (g->outlines, loop, run->first),
                                           point_of (g->outlines, loop, run->first + run->n)) > 4 * stroke)
    return CELD_OK;
  if (find_pair (g, loop->label, before->faces, &pair, &side) != CELD_OK)
    return CELD_NO_MEMORY;
  pair->marks[side]++;
  return CELD_OK;
}

static CeldStatus
gather_loop (Gathering *g, const CeldOutlineLoop *loop)
{
  const CeldRegionOutlines *r = g->outlines;
  size_t          start = 0, end;
  Run             run[3] = { { 0 } };
  CeldStatus      status = CELD_OK;

  while (start < loop->n && point_of (r, loop, start)->faces == point_of (r, loop, start + loop->n - 1)->faces)
    start++;
  start %= loop->n;
  end    = start + loop->n;
  for (size_t i = start; i < end && status == CELD_OK; i += run[2].n)
    {
      run[0] = run[1];
      run[1] = run[2];
      run[2] = next_run (r, loop, i, end);
      g->whole[loop->label] += run[2].length;
      if (run[2].faces)
        g->rim[loop->label] += run[2].length;
      if (run[2].faces == CELD_FACES_FRAME)
        g->frame[loop->label] += run[2].length;
      else if (run[2].faces)
        status = gather_run (g, loop, &run[2]);
      if (status == CELD_OK && run[0].n)
        status = gather_mark (g, loop, &run[0], &run[1], &run[2]);
    }
  return status;
}

/* Do the outlines of three regions turn as they do at a T?  One of them runs on, both others have a corner, and all
 * trials together make half a circle. */
static bool
is_clear (const CeldJunction *corner)
{
  double sum = 0;
  int    corners = 0;

  for (int k = 0; k < 3; k++)
    {
      sum     += (double) corner->turn[k]; /* NaN is not clear */
      corners += corner->turn[k] > (float) STRAIGHT;
    }
  return fabs (sum - CELD_PI) < 2 * STRAIGHT && corners >= 2;
}

/* How likely it is that an outline that trials so much at a junction is the bar of a T, not to scale. */
static double
straightness (float turn, bool clear)
{
  double bends = (double) turn / STRAIGHT;

  return (clear ? DOUBT : DOUBT_UNCLEAR) + (isnan (turn) ? 0 : exp (-0.5 * bends * bends));
}

static CeldStatus
gather_corners (Gathering *g, const CeldJunction *corners, size_t n)
{
  for (size_t i = 0; i < 3 * n; i++)
    {
      const CeldJunction *c = &corners[i / 3];
      size_t               k = i % 3, other = (k + 1) % 3;
      bool                 clear = is_clear (c);
      double               odds = log (straightness (c->turn[k], clear) / straightness (c->turn[other], clear));
      Pair                *pair;
      int                  side;

      if (find_pair (g, c->label[k], c->label[other], &pair, &side) != CELD_OK)
        return CELD_NO_MEMORY;
      pair->bar += side ? -odds : odds;
    }
  return CELD_OK;
}

/* ------------------------------------------------------------------ the whole */

/* Of a disc 1, of anything else less; solid regions and those without an outline count as one. */
static double
compactness (const Gathering *g, uint32_t label)
{
  double whole = g->whole[label];

  return whole > 0 ? fmin (1, 4 * CELD_PI * (double) g->palette->item[label - 1].area / (whole * whole)) : 1;
}

/* How far a region is all along the frame, as a background is: 0 if it has no more than half of it. */
static double
backing (const Gathering *g, uint32_t label)
{
  return fmax (0, g->frame[label] / (g->outlines->width + g->outlines->height) - 1);
}

static void
finish_pair (const Gathering *g, Pair *pair)
{
  CeldPairCues *c = &pair->cues;

  c->length = fmax (pair->facing[0], pair->facing[1]);
  c->cue[CELD_CUE_BAR]      = pair->bar;
  c->cue[CELD_CUE_ENCLOSED] = pair->facing[0] / fmax (1, g->rim[c->a]) -
                              pair->facing[1] / fmax (1, g->rim[c->b]);
  c->cue[CELD_CUE_CONVEX]   = tanh ((pair->turn[0] - pair->turn[1]) / (2 * ROUND));
  c->cue[CELD_CUE_COMPACT]  = compactness (g, c->a) - compactness (g, c->b);
  c->cue[CELD_CUE_MARKS]    = pair->marks[1] - pair->marks[0];
  c->cue[CELD_CUE_FRAME]    = backing (g, c->b) - backing (g, c->a);
}

static int
compare_pairs (const void *one, const void *two)
{
  const CeldPairCues *p = one, *q = two;

  return p->a != q->a ? (p->a < q->a ? -1 : 1) : p->b < q->b ? -1 : p->b > q->b;
}

/* Those that touch, in order. */
static CeldStatus
list_pairs (Gathering *g, CeldPairCues **pairs, size_t *n)
{
  CeldPairCues *list = celd_alloc (g->n, sizeof *list);
  size_t        found = 0;

  if (!list)
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < g->n; i++)
    {
      finish_pair (g, &g->pair[i]);
      if (g->pair[i].depth > 0 && g->pair[i].cues.length >= SHORTEST_SIDE * g->outlines->stroke)
        list[found++] = g->pair[i].cues;
    }
  qsort (list, found, sizeof *list, compare_pairs);
  *pairs = list;
  *n     = found;
  return CELD_OK;
}

static CeldStatus
gathering_new (const CeldPalette *palette, const CeldRegionOutlines *outlines, Gathering *g)
{
  *g = (Gathering) { .outlines = outlines, .palette = palette, .n_slots = 64 };
  g->slot  = celd_alloc0 (g->n_slots, sizeof *g->slot);
  g->rim   = celd_alloc0 (palette->n + 1, sizeof *g->rim);
  g->whole = celd_alloc0 (palette->n + 1, sizeof *g->whole);
  g->frame = celd_alloc0 (palette->n + 1, sizeof *g->frame);
  return g->slot && g->rim && g->whole && g->frame ? CELD_OK : CELD_NO_MEMORY;
}

static void
gathering_clear (Gathering *g)
{
  celd_free (g->pair);
  celd_free (g->slot);
  celd_free (g->rim);
  celd_free (g->whole);
  celd_free (g->frame);
}

CeldStatus
celd_cues_gather (const CeldLabels *labels, const CeldPalette *palette, const CeldPlane *ink, const CeldHost *host,
                  CeldPairCues **pairs, size_t *n)
{
  CeldHostPart       part[2];
  CeldHost       first = celd_host_part (&part[0], host, 0, 0.5), second = celd_host_part (&part[1], host, 0.5, 1);
  CeldRegionOutlines       outlines = { 0 };
  Gathering      g = { 0 };
  CeldJunction *corner = NULL;
  size_t         n_corners = 0;
  CeldStatus     status = celd_region_outlines_new (labels, palette->n, ink, &first, &outlines);

  if (status == CELD_OK)
    status = gathering_new (palette, &outlines, &g);
  for (size_t k = 0; k < outlines.n_loops && status == CELD_OK; k++)
    status = gather_loop (&g, &outlines.loop[k]);
  if (status == CELD_OK)
    status = celd_junctions_find (labels, palette->n, &outlines, &second, &corner, &n_corners);
  if (status == CELD_OK)
    status = gather_corners (&g, corner, n_corners);
  if (status == CELD_OK)
    status = list_pairs (&g, pairs, n);
  celd_free (corner);
  gathering_clear (&g);
  celd_region_outlines_clear (&outlines);
  return status;
}
