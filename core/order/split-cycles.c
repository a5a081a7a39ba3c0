/* Contradictions resolved by splitting a region, which the paper leaves open (section 4): "it is not able to decide
 * where to put a new scribble in order to resolve the conflict".
 *
 * Where a cycle passes a region, one relation ends at a point of it and the next begins at another, its two anchors.
 * For each region of the cycle the minimum cut between its anchors is found, on pixels and with LazyBrush's costs (low
 * along ink, high across paper), and the cheapest of these cuts is made: it separates the ends of the relations, so
 * that the cycle is gone.  This is repeated until no contradiction is left that a cut can resolve.
 *
 * The new boundary is not a contour: celd_splits_erase takes the ink along it for paper where smooth depth is made, so
 * that depth is continuous across it.  Pixels at most a quarter of the distance between the anchors away from one of
 * them, measured within the region, always stay on its side, which excludes cuts that merely encircle an anchor.
 * Regions are not cut between anchors that are less than two stroke widths apart, on ink, in different connected
 * components of the label, or in the background: such contradictions are left to feedback-arc-set.c.
 *
 * Cost: a minimum cut on the region's box for each region of a cycle, and all relations anew after each split.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "image/image.h"
#include "order/order.h"
#include "segment/segment.h"
#include "solve/maxflow.h"

#include <math.h>

#define ANCHORS_APART       2         /* stroke widths, the least distance of two anchors; chosen */
#define ANCHORS_APART_THIN  4         /* pixels, the same for thin strokes; chosen */
#define HELD_DIVISOR        4         /* an anchor holds a quarter of the distance to the other; chosen */
#define HELD_CAPACITY       (1 << 28) /* of a pixel that an anchor holds: more than any cut costs */
#define UNREACHED           UINT32_MAX

typedef struct
{
  const CeldRelations *relations;
  const CeldPlane     *ink;
  CeldLabels          *labels;
  CeldPalette         *palette;
  CeldSmoothnessCosts  costs;
  double               apart;   /* least distance of two anchors, pixels */
  CeldGraph            graph;
} Work;

/* A region with two anchors, in its bounding box, and the minimum cut between them. */
typedef struct
{
  uint32_t  label;
  int       x[2], y[2];         /* the anchors */
  CeldRect  box;
  uint32_t *steps[2];           /* within the region from each anchor; UNREACHED outside */
  uint8_t  *side;               /* 1: of the first anchor */
  int64_t   cost;
} RegionCut;

static void
region_cut_clear (RegionCut *cut)
{
  celd_free (cut->steps[0]);
  celd_free (cut->steps[1]);
  celd_free (cut->side);
  *cut = (RegionCut) { 0 };
}

/* The number of anchor k's pixel in the box. */
static size_t
anchor_pixel (const RegionCut *cut, int k)
{
  return (size_t) (cut->y[k] - cut->box.y) * (size_t) cut->box.width + (size_t) (cut->x[k] - cut->box.x);
}

static size_t
box_pixels (const RegionCut *cut)
{
  return (size_t) cut->box.width * (size_t) cut->box.height;
}

/* ------------------------------------------------------------------ anchors */

/* The region and the anchors at which consecutive relations i and j of a cycle meet; false if it may not be cut there.
 * Equalities have no place in the region. */
static bool
find_anchors (const Work *w, size_t i, size_t j, RegionCut *cut)
{
  uint32_t other;

  return !celd_graph_equal (&w->graph, i) && !celd_graph_equal (&w->graph, j) &&
         celd_graph_point (&w->graph, i, CELD_FARTHER, &cut->label, &cut->x[0], &cut->y[0]) &&
         celd_graph_point (&w->graph, j, CELD_NEARER, &other, &cut->x[1], &cut->y[1]) &&
         other == cut->label && !w->palette->item[other - 1].background &&
         CELD_AT (w->labels, cut->x[0], cut->y[0]) == other && CELD_AT (w->labels, cut->x[1], cut->y[1]) == other &&
         hypot (cut->x[0] - cut->x[1], cut->y[0] - cut->y[1]) >= w->apart;
}

/* ------------------------------------------------------------------ the cut */

static void
find_box (const Work *w, RegionCut *cut)
{
  int left = w->labels->width, right = -1, top = w->labels->height, bottom = -1;

  for (int y = 0; y < w->labels->height; y++)
    for (int x = 0; x < w->labels->width; x++)
      if (CELD_AT (w->labels, x, y) == cut->label)
        {
          left   = x < left ? x : left;
          right  = x > right ? x : right;
          top    = y < top ? y : top;
          bottom = y;
        }
  cut->box = (CeldRect) { left, top, right - left + 1, bottom - top + 1 };
}

/* Breadth-first search within the label from a pixel of the box, through pixels that `steps` has as UNREACHED.  Sets
 * their numbers of steps, lists them in `queue` (room for the box), and returns how many there are. */
static size_t
search_region (const Work *w, const RegionCut *cut, size_t start, uint32_t *steps, uint32_t *queue)
{
  CeldRect box = cut->box;
  size_t   bw = (size_t) box.width, n = 0;

  queue[n++]   = (uint32_t) start;
  steps[start] = 0;
  for (size_t i = 0; i < n; i++)
    {
      int x = (int) (queue[i] % bw), y = (int) (queue[i] / bw);

      for (int k = 0; k < 4; k++)
        {
          int    u = x + (k == 0) - (k == 1), v = y + (k == 2) - (k == 3);
          size_t q = (size_t) v * bw + (size_t) u;

          if (u < 0 || v < 0 || u >= box.width || v >= box.height || steps[q] != UNREACHED ||
              CELD_AT (w->labels, box.x + u, box.y + v) != cut->label)
            continue;
          steps[q]   = steps[queue[i]] + 1;
          queue[n++] = (uint32_t) q;
        }
    }
  return n;
}

/* Steps from both anchors; cut->steps[0] is UNREACHED at the second anchor if no path within the label joins them. */
static CeldStatus
count_steps (const Work *w, RegionCut *cut)
{
  size_t    n = box_pixels (cut);
  uint32_t *queue = celd_alloc (n, sizeof *queue);
  bool      good = queue != NULL;

  for (int k = 0; k < 2 && good; k++)
    {
      cut->steps[k] = celd_alloc (n, sizeof (uint32_t));
      good          = cut->steps[k] != NULL;
      for (size_t p = 0; p < n && good; p++)
        cut->steps[k][p] = UNREACHED;
      if (good)
        search_region (w, cut, anchor_pixel (cut, k), cut->steps[k], queue);
    }
  celd_free (queue);
  return good ? CELD_OK : CELD_NO_MEMORY;
}

/* V_pq between a pixel of the box and its right or lower neighbour (u,v), 0 where one is not in the region. */
static int32_t
edge_cost (const Work *w, const RegionCut *cut, int x, int y, int u, int v)
{
  CeldRect box = cut->box;
  float    a, b;

  if (u >= box.width || v >= box.height || cut->steps[0][(size_t) y * (size_t) box.width + (size_t) x] == UNREACHED ||
      cut->steps[0][(size_t) v * (size_t) box.width + (size_t) u] == UNREACHED)
    return 0;
  a = CELD_AT (w->ink, box.x + x, box.y + y);
  b = CELD_AT (w->ink, box.x + u, box.y + v);
  return celd_smoothness_cost (&w->costs, a, b, !celd_is_paper (a), !celd_is_paper (b), false);
}

/* Finds the minimum cut: fills in `side` and `cost`. */
static CeldStatus
cut_region (const Work *w, const CeldHost *host, RegionCut *cut)
{
  CeldRect   box = cut->box;
  size_t     n = box_pixels (cut), p = 0;
  uint32_t   held = cut->steps[0][anchor_pixel (cut, 1)] / HELD_DIVISOR;
  int32_t   *east = celd_alloc (n, 3 * sizeof *east), *south, *bound;
  CeldStatus status = CELD_NO_MEMORY;

  cut->side = celd_alloc (n, 1);
  if (east && cut->side)
    {
      south = east + n;
      bound = south + n;
      for (int y = 0; y < box.height; y++)
        for (int x = 0; x < box.width; x++, p++)
          {
            east[p]  = edge_cost (w, cut, x, y, x + 1, y);
            south[p] = edge_cost (w, cut, x, y, x, y + 1);
            bound[p] = cut->steps[0][p] <= held ? HELD_CAPACITY : cut->steps[1][p] <= held ? -HELD_CAPACITY : 0;
          }
      status = celd_maxflow (box.width, box.height, east, south, bound, host, cut->side, &cut->cost);
    }
  celd_free (east);
  return status;
}

/* The cheapest cut of a cycle; best->label stays 0 if there is none. */
static CeldStatus
find_cut (const Work *w, const CeldCycle *cycle, const CeldHost *host, RegionCut *best)
{
  CeldStatus status = CELD_OK;

  for (size_t k = 0; k < cycle->n && status == CELD_OK; k++)
    {
      RegionCut cut = { 0 };

      if (!find_anchors (w, cycle->item[k], cycle->item[(k + 1) % cycle->n], &cut))
        continue;
      find_box (w, &cut);
      status = count_steps (w, &cut);
      if (status == CELD_OK && cut.steps[0][anchor_pixel (&cut, 1)] != UNREACHED)
        {
          status = cut_region (w, host, &cut);
          if (status == CELD_OK && (!best->label || cut.cost < best->cost))
            {
              RegionCut other = *best;

              *best = cut;
              cut   = other;
            }
        }
      region_cut_clear (&cut);
    }
  return status;
}

/* ------------------------------------------------------------------ the split */

/* Assigns every other connected component of the label to the side of the nearer anchor: it shows the same thing beyond
 * something in front. */
static CeldStatus
assign_components (const Work *w, RegionCut *cut)
{
  CeldRect  box = cut->box;
  size_t    bw = (size_t) box.width;
  uint32_t *queue = celd_alloc (box_pixels (cut), sizeof *queue);

  if (!queue)
    return CELD_NO_MEMORY;
  for (size_t p = 0; p < box_pixels (cut); p++)
    if (cut->steps[0][p] == UNREACHED &&
        CELD_AT (w->labels, box.x + (int) (p % bw), box.y + (int) (p / bw)) == cut->label)
      {
        size_t n = search_region (w, cut, p, cut->steps[0], queue);
        double nearest[2] = { INFINITY, INFINITY };

        for (size_t i = 0; i < n; i++)
          for (int k = 0; k < 2; k++)
            nearest[k] = fmin (nearest[k], hypot (box.x + (int) (queue[i] % bw) - cut->x[k],
                                                  box.y + (int) (queue[i] / bw) - cut->y[k]));
        for (size_t i = 0; i < n; i++)
          cut->side[queue[i]] = nearest[0] <= nearest[1];
      }
  celd_free (queue);
  return CELD_OK;
}

/* The smaller side becomes a label of its own, of the same colour. */
static CeldStatus
split_label (Work *w, const RegionCut *cut, CeldSplits *splits)
{
  CeldRegion region = w->palette->item[cut->label - 1], *rest;
  size_t     n[2] = { 0 }, p = 0;
  int        moves;

  for (size_t q = 0; q < box_pixels (cut); q++)
    if (cut->steps[0][q] != UNREACHED)
      n[!cut->side[q]]++;
  moves        = n[1] <= n[0];
  region.area  = n[moves];
  region.seeds = 0;
  region.x     = cut->x[moves];
  region.y     = cut->y[moves];
  if (!celd_reserve_one (splits->item, splits->n, splits->item_capacity) ||
      celd_append_uncounted (w->palette->item, w->palette->n, region) != CELD_OK)
    return CELD_NO_MEMORY;
  rest        = &w->palette->item[cut->label - 1];
  rest->area -= n[moves];
  for (int y = 0; y < cut->box.height; y++)
    for (int x = 0; x < cut->box.width; x++, p++)
      if (cut->steps[0][p] != UNREACHED && cut->side[p] == !moves)
        CELD_AT (w->labels, cut->box.x + x, cut->box.y + y) = (uint32_t) w->palette->n;
  if (CELD_AT (w->labels, rest->x, rest->y) != cut->label)
    {
      rest->x = cut->x[!moves];
      rest->y = cut->y[!moves];
    }
  splits->item[splits->n++] = (CeldSplit) { cut->label, (uint32_t) w->palette->n, { cut->x[!moves], cut->x[moves] },
                                            { cut->y[!moves], cut->y[moves] } };
  return CELD_OK;
}

/* Looks for contradictions, and resolves the first that a cut can resolve; *done if there is none. */
static CeldStatus
split_once (Work *w, const CeldHost *host, CeldSplits *splits, bool *done)
{
  CeldOrder  order = { 0 };
  RegionCut  best = { 0 };
  CeldStatus status = celd_graph_new (w->labels, w->palette, w->relations, w->ink, &w->graph, NULL);

  if (status == CELD_OK)
    status = celd_graph_resolve (&w->graph, CELD_ON_CYCLE_REPORT, NULL, &order);
  for (size_t i = 0; i < order.n_cycles && status == CELD_OK && !best.label; i++)
    status = find_cut (w, &order.cycle[i], host, &best);
  *done = !best.label;
  if (status == CELD_OK && best.label)
    status = assign_components (w, &best);
  if (status == CELD_OK && best.label)
    status = split_label (w, &best, splits);
  region_cut_clear (&best);
  celd_order_clear (&order);
  celd_graph_clear (&w->graph);
  return status;
}

CeldStatus
celd_cycles_split (const CeldRelations *relations, const CeldPlane *ink, const CeldSettings *settings,
                   const CeldHost *host, CeldLabels *labels, CeldPalette *palette, CeldSplits *splits)
{
  Work       w = { .relations = relations, .ink = ink, .labels = labels, .palette = palette };
  CeldHost   quiet = host ? *host : (CeldHost) { 0 };
  CeldStatus status = CELD_OK;
  bool       done = !relations->n;

  quiet.progress = NULL; /* the number of cuts is not known in advance */
  celd_smoothness_costs_new (labels->width, labels->height, settings->ink_threshold, &w.costs);
  w.apart = fmax (ANCHORS_APART_THIN, ANCHORS_APART * celd_stroke_width (ink));
  while (!done && status == CELD_OK && splits->n < 2 * relations->n) /* each cut separates two ends of relations */
    {
      status = split_once (&w, &quiet, splits, &done);
      status = status == CELD_OK ? celd_progress (host, 1 - 1 / (double) (splits->n + 1)) : status;
    }
  return status;
}

/* ------------------------------------------------------------------ the new boundaries */

/* The label that a label was split from first; itself if it was not split off. */
static uint32_t
origin_of (const CeldSplits *splits, uint32_t label)
{
  for (size_t i = splits->n; i-- > 0; ) /* later ones split what earlier ones made */
    if (splits->item[i].other == label)
      label = splits->item[i].label;
  return label;
}

/* Does the square of this radius round (x,y) have pixels of regions that were not split from `origin`? */
static bool
is_near_others (const CeldSplits *splits, const CeldLabels *labels, uint32_t origin, int x, int y, int radius)
{
  for (int v = y - radius; v <= y + radius; v++)
    for (int u = x - radius; u <= x + radius; u++)
      if (u >= 0 && v >= 0 && u < labels->width && v < labels->height &&
          origin_of (splits, CELD_AT (labels, u, v)) != origin)
        return true;
  return false;
}

/* Turns the ink within twice the radius of a pixel at a new boundary into paper, except that of the outline of the
 * region before its splits. */
static void
erase_near (const CeldSplits *splits, const CeldLabels *labels, int x, int y, int radius, CeldPlane *ink)
{
  uint32_t origin = origin_of (splits, CELD_AT (labels, x, y));

  for (int v = y - 2 * radius; v <= y + 2 * radius; v++)
    for (int u = x - 2 * radius; u <= x + 2 * radius; u++)
      if (u >= 0 && v >= 0 && u < labels->width && v < labels->height && CELD_AT (ink, u, v) < 1 &&
          origin_of (splits, CELD_AT (labels, u, v)) == origin &&
          !is_near_others (splits, labels, origin, u, v, radius))
        CELD_AT (ink, u, v) = 1;
}

/* Is the pixel's right (down 0) or lower edge part of a boundary that a split made? */
static bool
on_split (const CeldSplits *splits, const CeldLabels *labels, int x, int y, int down)
{
  int      u = x + !down, v = y + down;
  uint32_t here = CELD_AT (labels, x, y), there;

  return u < labels->width && v < labels->height && (there = CELD_AT (labels, u, v)) != here &&
         origin_of (splits, here) == origin_of (splits, there);
}

void
celd_splits_erase (const CeldSplits *splits, const CeldLabels *labels, int stroke, CeldPlane *ink)
{
  int radius = stroke < 1 ? 1 : stroke;

  for (int y = 0; y < labels->height; y++)
    for (int x = 0; x < labels->width; x++)
      for (int down = 0; down < 2; down++)
        if (on_split (splits, labels, x, y, down))
          erase_near (splits, labels, x, y, radius, ink);
}

void
celd_splits_draw (const CeldSplits *splits, const CeldLabels *labels, CeldPlane *ink)
{
  for (int y = 0; y < labels->height; y++)
    for (int x = 0; x < labels->width; x++)
      if (on_split (splits, labels, x, y, 0) || on_split (splits, labels, x, y, 1))
        CELD_AT (ink, x, y) = 0;
}
