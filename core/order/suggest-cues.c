/* Cues in a drawing that one of two touching regions is in front.
 *
 * Two regions touch where the outline of one faces the other through the ink of their contour, or across paper where
 * the segmentation closed a gap.  Boundaries shorter than the stroke width are ignored.
 * Cost: that of the outlines and junctions, and a look-up in a hash table for each stretch of outline.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "order/order.h"

#include <math.h>
#include <stdlib.h>

#define BAR_DEVIATION      0.25  /* radians: standard deviation of the measured turn of a straight bar; chosen */
#define JUNCTION_DOUBT     0.03  /* likelihood of any turn at a clear junction, relative to a straight bar's; chosen */
#define OTHER_DOUBT        0.2   /* the same at other junctions; chosen */
#define SHORTEST_BOUNDARY  1.0   /* stroke widths; chosen */
#define BOUNDARY_TURN      0.3   /* radians: a boundary that turns by this is about half convex; chosen */
#define TURN_STEP          1.5   /* stroke widths between points where the direction of a boundary is taken; chosen */
#define ARROW_PLACES       5     /* points on a stretch of boundary that are tried for an arrow; chosen */
#define ARROW_INSIDE       3.0   /* stroke widths that its ends lie inside the regions, at most; chosen */

/* A pair while its cues are summed: [0] is of the outline of a, [1] of that of b. */
typedef struct
{
  CeldPairCues cues;
  double       facing[2];       /* length of the outline that faces the other region */
  double       turn[2];         /* how much that turns, radians */
  double       marks[2];        /* lines inside the region that end there */
  double       bar;             /* log-odds of a being the bar of junctions */
  double       inside;          /* how far inside the regions the ends of the best arrow lie, pixels */
  size_t       next;            /* pair with the same hash value: index + 1; 0 = none */
} Pair;

/* Lengths of a label's outlines: of those that face something, of all, and of those along the frame. */
typedef struct { double facing, all, frame; } OutlineLengths;

typedef struct
{
  const CeldRegionOutlines *outlines;
  const CeldPalette        *palette;
  Pair                     *pair;
  size_t                    n, pair_capacity;
  size_t                   *head;    /* of each hash value, as many as labels: its last pair, index + 1; 0 = none */
  OutlineLengths           *lengths; /* by label */
} Gathering;

/* The pair of two labels, added if it is new; *side is 0 if `one` is its a, 1 if it is its b. */
static CeldStatus
find_pair (Gathering *g, uint32_t one, uint32_t other, Pair **pair, int *side)
{
  uint32_t a = one < other ? one : other, b = one < other ? other : one;
  uint64_t mixed = (a * UINT64_C (0x9e3779b97f4a7c15) + b) * UINT64_C (0xff51afd7ed558ccd);
  size_t  *head = &g->head[(mixed >> 32) % (g->palette->n + 1)], k = *head;

  while (k && (g->pair[k - 1].cues.a != a || g->pair[k - 1].cues.b != b))
    k = g->pair[k - 1].next;
  if (!k)
    {
      Pair new = { .cues = { .a = a, .b = b }, .next = *head };

      if (celd_append (g->pair, g->n, g->pair_capacity, new) != CELD_OK)
        return CELD_NO_MEMORY;
      k = *head = g->n;
    }
  *pair = &g->pair[k - 1];
  *side = one > other;
  return CELD_OK;
}

/* ------------------------------------------------------------------ along the outlines */

/* Consecutive points of a loop that face the same; indices beyond the end of the loop continue at its start. */
typedef struct { size_t first, n; uint32_t faces; double length; } Stretch;

static const CeldOutlinePoint *
point_of (const CeldRegionOutlines *outlines, const CeldOutlineLoop *loop, size_t i)
{
  return &outlines->point[loop->first + i % loop->n];
}

static double
distance (const CeldOutlinePoint *p, const CeldOutlinePoint *q)
{
  return hypot ((double) (q->x - p->x), (double) (q->y - p->y));
}

/* The stretch that begins at point i. */
static Stretch
next_stretch (const CeldRegionOutlines *outlines, const CeldOutlineLoop *loop, size_t i, size_t end)
{
  Stretch stretch = { .first = i, .faces = point_of (outlines, loop, i)->faces };

  for (; i < end && point_of (outlines, loop, i)->faces == stretch.faces; i++, stretch.n++)
    stretch.length += distance (point_of (outlines, loop, i), point_of (outlines, loop, i + 1));
  return stretch;
}

/* The angle in radians by which a stretch turns, without its ends, which are rounded by the contours that end there. */
static double
turning (const CeldRegionOutlines *outlines, const CeldOutlineLoop *loop, const Stretch *stretch)
{
  double                  step = fmax (3, TURN_STEP * outlines->stroke), at = 0, next = step / 2, sum = 0;
  double                  dx = 0, dy = 0;
  const CeldOutlinePoint *last = NULL;

  if (stretch->n == loop->n)
    {
      double area = 0; /* a closed outline makes one full turn, inwards or outwards */

      for (size_t k = 0; k < stretch->n; k++)
        {
          const CeldOutlinePoint *p = point_of (outlines, loop, k), *q = point_of (outlines, loop, k + 1);

          area += (double) p->x * (double) q->y - (double) q->x * (double) p->y;
        }
      return area > 0 ? 2 * CELD_PI : -2 * CELD_PI;
    }
  for (size_t k = 0; k < stretch->n && at <= stretch->length - step / 2; k++)
    {
      const CeldOutlinePoint *p = point_of (outlines, loop, stretch->first + k);

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
      at += distance (p, point_of (outlines, loop, stretch->first + k + 1));
    }
  return sum;
}

/* ------------------------------------------------------------------ places for the ends of an arrow */

static uint32_t
surface_at (const CeldRegionOutlines *r, double x, double y)
{
  return celd_surface_at (r, (int) floor (x), (int) floor (y));
}

/* Moves (*x,*y), on the ink of an outline, half way through the region along (dx,dy), but no farther than an arrow
 * needs.  Returns how far inside the region that is, 0 if it is not inside. */
static double
go_inside (const CeldRegionOutlines *outlines, uint32_t label, double dx, double dy, double *x, double *y)
{
  double most = ARROW_INSIDE * outlines->stroke + 4, through = 0, u = *x, v = *y;

  for (int k = 0; k < 3 * outlines->stroke + 4 && surface_at (outlines, u, v) != label; k++, u += dx)
    v += dy;
  while (through < 2 * most && surface_at (outlines, u + through * dx, v + through * dy) == label)
    through++;
  *x = u + through / 2 * dx;
  *y = v + through / 2 * dy;
  return surface_at (outlines, *x, *y) == label ? through / 2 : 0;
}

/* Tries an arrow across the boundary at point i of a stretch; the pair keeps the one whose ends lie farthest inside. */
static void
try_arrow (const Gathering *g, const CeldOutlineLoop *loop, const Stretch *stretch, size_t i, int side, Pair *pair)
{
  const CeldRegionOutlines *r = g->outlines;
  size_t                    arm = (size_t) r->stroke + 2;
  const CeldOutlinePoint   *p = point_of (r, loop, i), *q = point_of (r, loop, i + arm);
  const CeldOutlinePoint   *o = point_of (r, loop, i + loop->n - arm % loop->n);
  double                    dx = (double) (q->x - o->x), dy = (double) (q->y - o->y), length = hypot (dx, dy), inside;
  double                    x[2] = { (double) p->x, (double) p->x }, y[2] = { (double) p->y, (double) p->y };

  if (!(length > 0))
    return;
  inside = fmin (go_inside (r, loop->label, -dy / length, dx / length, &x[0], &y[0]),
                 go_inside (r, stretch->faces, dy / length, -dx / length, &x[1], &y[1]));
  if (inside <= pair->inside)
    return;
  pair->inside  = inside;
  pair->cues.ax = x[side];
  pair->cues.ay = y[side];
  pair->cues.bx = x[!side];
  pair->cues.by = y[!side];
}

/* ------------------------------------------------------------------ the cues */

/* A stretch of outline that faces another region. */
static CeldStatus
gather_stretch (Gathering *g, const CeldOutlineLoop *loop, const Stretch *stretch)
{
  Pair *pair;
  int   side;

  if (find_pair (g, loop->label, stretch->faces, &pair, &side) != CELD_OK)
    return CELD_NO_MEMORY;
  pair->facing[side] += stretch->length;
  pair->turn[side]   += turning (g->outlines, loop, stretch);
  if (stretch->length >= SHORTEST_BOUNDARY * g->outlines->stroke)
    for (size_t k = 0; k < ARROW_PLACES; k++)
      try_arrow (g, loop, stretch, stretch->first + (2 * k + 1) * stretch->n / (2 * ARROW_PLACES), side, pair);
  return CELD_OK;
}

/* A line inside a region that ends at its boundary: the outline follows one side of the ink and comes back along the
 * other, and faces the same region before and after. */
static CeldStatus
gather_mark (Gathering *g, const CeldOutlineLoop *loop, const Stretch *before, const Stretch *line,
             const Stretch *after)
{
  double stroke = g->outlines->stroke;
  Pair  *pair;
  int    side;

  if (line->faces || before->faces != after->faces || !before->faces || before->faces == CELD_FACES_FRAME ||
      line->length < CELD_SHORTEST_MARK * stroke ||
      distance (point_of (g->outlines, loop, line->first), point_of (g->outlines, loop, line->first + line->n)) >
      4 * stroke)
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
  OutlineLengths           *lengths = &g->lengths[loop->label];
  size_t                    start = 0, end;
  Stretch                   last[3] = { { 0 } };
  CeldStatus                status = CELD_OK;

  while (start < loop->n && point_of (r, loop, start)->faces == point_of (r, loop, start + loop->n - 1)->faces)
    start++;
  start %= loop->n;
  end    = start + loop->n;
  for (size_t i = start; i < end && status == CELD_OK; i += last[2].n)
    {
      last[0] = last[1];
      last[1] = last[2];
      last[2] = next_stretch (r, loop, i, end);
      lengths->all += last[2].length;
      if (last[2].faces)
        lengths->facing += last[2].length;
      if (last[2].faces == CELD_FACES_FRAME)
        lengths->frame += last[2].length;
      else if (last[2].faces)
        status = gather_stretch (g, loop, &last[2]);
      if (status == CELD_OK && last[0].n)
        status = gather_mark (g, loop, &last[0], &last[1], &last[2]);
    }
  return status;
}

/* Do the outlines of three regions turn as they do at a T?  One of them is straight, the others have a corner, and all
 * turns together make half a circle. */
static bool
is_clear (const CeldJunction *junction)
{
  double sum = 0;
  int    corners = 0;

  for (int k = 0; k < 3; k++)
    {
      sum     += (double) junction->turn[k]; /* NaN is not clear */
      corners += junction->turn[k] > (float) BAR_DEVIATION;
    }
  return fabs (sum - CELD_PI) < 2 * BAR_DEVIATION && corners >= 2;
}

/* The likelihood, up to a factor, of the bar of a T turning so much. */
static double
bar_likelihood (float turn, bool clear)
{
  double deviations = (double) turn / BAR_DEVIATION;

  return (clear ? JUNCTION_DOUBT : OTHER_DOUBT) +
         (isnan (turn) ? 0 : exp (-0.5 * deviations * deviations));
}

static CeldStatus
gather_junctions (Gathering *g, const CeldJunction *junctions, size_t n)
{
  for (size_t i = 0; i < 3 * n; i++)
    {
      const CeldJunction *j = &junctions[i / 3];
      size_t              k = i % 3, other = (k + 1) % 3;
      bool                clear = is_clear (j);
      double              odds = log (bar_likelihood (j->turn[k], clear) / bar_likelihood (j->turn[other], clear));
      Pair               *pair;
      int                 side;

      if (find_pair (g, j->label[k], j->label[other], &pair, &side) != CELD_OK)
        return CELD_NO_MEMORY;
      pair->bar += side ? -odds : odds;
    }
  return CELD_OK;
}

/* ------------------------------------------------------------------ the whole */

/* 4 pi area / outline^2: 1 for a disc, less for anything else; 1 without an outline. */
static double
compactness (const Gathering *g, uint32_t label)
{
  double all = g->lengths[label].all;

  return all > 0 ? fmin (1, 4 * CELD_PI * (double) g->palette->item[label - 1].area / (all * all)) : 1;
}

/* 1 for a region that has all of the frame, as a background does, 0 for one that has no more than half of it. */
static double
frame_cue (const Gathering *g, uint32_t label)
{
  return fmax (0, g->lengths[label].frame / (g->outlines->width + g->outlines->height) - 1);
}

static void
finish_pair (const Gathering *g, Pair *pair)
{
  CeldPairCues *c = &pair->cues;

  c->length                 = fmax (pair->facing[0], pair->facing[1]);
  c->cue[CELD_CUE_BAR]      = pair->bar;
  c->cue[CELD_CUE_ENCLOSED] = pair->facing[0] / fmax (1, g->lengths[c->a].facing) -
                              pair->facing[1] / fmax (1, g->lengths[c->b].facing);
  c->cue[CELD_CUE_CONVEX]   = tanh ((pair->turn[0] - pair->turn[1]) / (2 * BOUNDARY_TURN));
  c->cue[CELD_CUE_COMPACT]  = compactness (g, c->a) - compactness (g, c->b);
  c->cue[CELD_CUE_MARKS]    = pair->marks[1] - pair->marks[0];
  c->cue[CELD_CUE_FRAME]    = frame_cue (g, c->b) - frame_cue (g, c->a);
}

static int
compare_pairs (const void *one, const void *two)
{
  const CeldPairCues *p = one, *q = two;

  return p->a != q->a ? (p->a < q->a ? -1 : 1) : p->b < q->b ? -1 : p->b > q->b;
}

/* Lists the pairs that touch, sorted by labels. */
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
      if (g->pair[i].inside > 0 && g->pair[i].cues.length >= SHORTEST_BOUNDARY * g->outlines->stroke)
        list[found++] = g->pair[i].cues;
    }
  qsort (list, found, sizeof *list, compare_pairs);
  *pairs = list;
  *n     = found;
  return CELD_OK;
}

CeldStatus
celd_cues_gather (const CeldLabels *labels, const CeldPalette *palette, const CeldPlane *ink, const CeldHost *host,
                  CeldPairCues **pairs, size_t *n)
{
  CeldHostPart       part[2];
  CeldHost           first = celd_host_part (&part[0], host, 0, 0.5), second = celd_host_part (&part[1], host, 0.5, 1);
  CeldRegionOutlines outlines = { 0 };
  Gathering          g = { .outlines = &outlines, .palette = palette };
  CeldJunction      *junctions = NULL;
  size_t             n_junctions = 0;
  CeldStatus         status = celd_region_outlines_new (labels, palette->n, ink, &first, &outlines);

  g.head    = celd_alloc0 (palette->n + 1, sizeof *g.head);
  g.lengths = celd_alloc0 (palette->n + 1, sizeof *g.lengths);
  if (status == CELD_OK && (!g.head || !g.lengths))
    status = CELD_NO_MEMORY;
  for (size_t k = 0; k < outlines.n_loops && status == CELD_OK; k++)
    status = gather_loop (&g, &outlines.loop[k]);
  if (status == CELD_OK)
    status = celd_junctions_find (labels, palette->n, &outlines, &second, &junctions, &n_junctions);
  if (status == CELD_OK)
    status = gather_junctions (&g, junctions, n_junctions);
  if (status == CELD_OK)
    status = list_pairs (&g, pairs, n);
  celd_free (junctions);
  celd_free (g.pair);
  celd_free (g.head);
  celd_free (g.lengths);
  celd_region_outlines_clear (&outlines);
  return status;
}
