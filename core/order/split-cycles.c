/* Contradictions resolved by splitting a region, which the paper leaves open (section 4): "it is not able to decide
 * where to put a new scribble in order to resolve the conflict".
 *
 * A cycle passes a region from the end of one relation to the end of the next, its two anchors there.  Each region that
 * it passes is cut between them, pixel by pixel, at the least cost (LazyBrush's: along ink it is cheap, across paper
 * every pixel counts); the cheapest of these cuts is made, and the cycle is gone, as relations have their points on one
 * side of the cut or the other.  Then the next contradiction is looked at, until none is left that a cut can resolve.
 *
 * The new border is no contour: ink along it is taken for paper where smooth depth is made, so that the sheet bends.
 * What the anchors' sides of the region hold whatever the cut costs: everything nearer to one of them, within the
 * region, than a quarter of the way between both; so no cut wraps a point.  Anchors less than two line widths apart, on
 * ink, in parts of a colour that do not touch, or on the background are not parted: such a contradiction stays for
 * feedback-arc-set.c.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/vector.h"
#include "image/image.h"
#include "order/order.h"
#include "segment/segment.h"
#include "solve/maxflow.h"

#include <math.h>
#include <string.h>

#define FAR_APART 2         /* line widths between two anchors */
#define NEAREST   4         /* pixels, however thin the lines are */
#define HELD      4         /* an anchor holds a quarter of the way to the other */
#define BOUND     (1 << 28) /* of what an anchor holds: more than any cut costs */
#define NOT_YET   UINT32_MAX

typedef struct
{
  const CeldRelations *relations;
  const CeldPlane     *ink;
  CeldLabels          *labels;
  CeldPalette         *palette;
  CeldSmoothnessCosts  costs;
  double               apart;   /* least distance of two anchors */
  CeldGraph            graph;
} Work;

/* A region between two anchors, in the box round it, and its cut. */
typedef struct
{
  uint32_t  label;
  int       x[2], y[2];
  CeldRect  box;
  uint32_t *way[2];             /* steps within the region from each anchor; NOT_YET outside */
  uint8_t  *side;               /* 1: of the first anchor */
  int64_t   cost;
} Sheet;

static void
sheet_clear (Sheet *sheet)
{
  celd_free (sheet->way[0]);
  celd_free (sheet->way[1]);
  celd_free (sheet->side);
  *sheet = (Sheet) { 0 };
}

/* ------------------------------------------------------------------ anchors */

/* The point at which relation i ends on this side; false if it is none, or on ink of another label. */
static bool
find_anchor (const Work *w, size_t i, CeldSide side, uint32_t *label, int *x, int *y)
{
  const CeldRelation *r = &w->relations->item[i];
  const CeldTerm     *term = side == CELD_NEARER ? &r->nearer : &r->farther;

  if (term->by_colour)
    return false;
  *label = w->graph.end[w->graph.first[2 * i + side]] + 1;
  *x     = (int) term->x;
  *y     = (int) term->y;
  return CELD_AT (w->labels, *x, *y) == *label;
}

/* Do relations i and j of a cycle meet in a region that may be cut?  Only inequalities hold it there. */
static bool
find_meeting (const Work *w, size_t i, size_t j, Sheet *sheet)
{
  uint32_t other;

  return !celd_graph_equal (&w->graph, i) && !celd_graph_equal (&w->graph, j) &&
         find_anchor (w, i, CELD_FARTHER, &sheet->label, &sheet->x[0], &sheet->y[0]) &&
         find_anchor (w, j, CELD_NEARER, &other, &sheet->x[1], &sheet->y[1]) && other == sheet->label &&
         !w->palette->item[other - 1].background &&
         hypot (sheet->x[0] - sheet->x[1], sheet->y[0] - sheet->y[1]) >= w->apart;
}

/* ------------------------------------------------------------------ the cut */

static void
find_box (const Work *w, Sheet *sheet)
{
  int left = w->labels->width, right = -1, top = w->labels->height, bottom = -1;

  for (int y = 0; y < w->labels->height; y++)
    for (int x = 0; x < w->labels->width; x++)
      if (CELD_AT (w->labels, x, y) == sheet->label)
        {
          left   = x < left ? x : left;
          right  = x > right ? x : right;
          top    = y < top ? y : top;
          bottom = y;
        }
  sheet->box = (CeldRect) { left, top, right - left + 1, bottom - top + 1 };
}

/* Steps from an anchor to all of the region, breadth first. */
static CeldStatus
measure_ways (const Work *w, Sheet *sheet, int anchor)
{
  CeldRect  box = sheet->box;
  size_t    bw = (size_t) box.width, n = bw * (size_t) box.height, n_queue = 0;
  uint32_t *way = celd_alloc (n, sizeof *way), *queue = celd_alloc (n, sizeof *queue);

  sheet->way[anchor] = way;
  if (!way || !queue)
    {
      celd_free (queue);
      return CELD_NO_MEMORY;
    }
  for (size_t p = 0; p < n; p++)
    way[p] = NOT_YET;
  queue[n_queue] = (uint32_t) ((size_t) (sheet->y[anchor] - box.y) * bw + (size_t) (sheet->x[anchor] - box.x));
  way[queue[n_queue++]] = 0;
  for (size_t i = 0; i < n_queue; i++)
    {
      int x = (int) (queue[i] % bw), y = (int) (queue[i] / bw);

      for (int k = 0; k < 4; k++)
        {
          int    u = x + (k == 0) - (k == 1), v = y + (k == 2) - (k == 3);
          size_t q = (size_t) v * bw + (size_t) u;

          if (u < 0 || v < 0 || u >= box.width || v >= box.height || way[q] != NOT_YET ||
              CELD_AT (w->labels, box.x + u, box.y + v) != sheet->label)
            continue;
          way[q] = way[queue[i]] + 1;
          queue[n_queue++] = (uint32_t) q;
        }
    }
  celd_free (queue);
  return CELD_OK;
}

/* V_pq between a pixel of the box and its right or lower neighbour, 0 where one is not in the region. */
static int32_t
edge_cost (const Work *w, const Sheet *sheet, int x, int y, int u, int v)
{
  CeldRect box = sheet->box;
  float    a, b;

  if (u >= box.width || v >= box.height || sheet->way[0][(size_t) y * (size_t) box.width + (size_t) x] == NOT_YET ||
      sheet->way[0][(size_t) v * (size_t) box.width + (size_t) u] == NOT_YET)
    return 0;
  a = CELD_AT (w->ink, box.x + x, box.y + y);
  b = CELD_AT (w->ink, box.x + u, box.y + v);
  return celd_smoothness_cost (&w->costs, a, b, !celd_is_paper (a), !celd_is_paper (b), false);
}

static CeldStatus
cut_sheet (const Work *w, const CeldHost *host, Sheet *sheet)
{
  CeldRect   box = sheet->box;
  size_t     n = (size_t) box.width * (size_t) box.height, p = 0;
  size_t     end = (size_t) (sheet->y[1] - box.y) * (size_t) box.width + (size_t) (sheet->x[1] - box.x);
  uint32_t   held = sheet->way[0][end] / HELD;
  int32_t   *east = celd_alloc (n, sizeof *east), *south = celd_alloc (n, sizeof *south);
  int32_t   *bound = celd_alloc (n, sizeof *bound);
  CeldStatus status = CELD_NO_MEMORY;

  sheet->side = celd_alloc (n, 1);
  if (east && south && bound && sheet->side)
    {
      for (int y = 0; y < box.height; y++)
        for (int x = 0; x < box.width; x++, p++)
          {
            east[p]  = edge_cost (w, sheet, x, y, x + 1, y);
            south[p] = edge_cost (w, sheet, x, y, x, y + 1);
            bound[p] = sheet->way[0][p] <= held ? BOUND : sheet->way[1][p] <= held ? -BOUND : 0;
          }
      status = celd_maxflow (box.width, box.height, east, south, bound, host, sheet->side, &sheet->cost);
    }
  celd_free (east);
  celd_free (south);
  celd_free (bound);
  return status;
}

/* The cheapest cut of a cycle; *best keeps label 0 if there is none. */
static CeldStatus
find_cut (const Work *w, const CeldCycle *cycle, const CeldHost *host, Sheet *best)
{
  CeldStatus status = CELD_OK;

  for (size_t k = 0; k < cycle->n && status == CELD_OK; k++)
    {
      Sheet sheet = { 0 };
      bool  joined = false;

      if (!find_meeting (w, cycle->item[k], cycle->item[(k + 1) % cycle->n], &sheet))
        continue;
      find_box (w, &sheet);
      status = measure_ways (w, &sheet, 0);
      if (status == CELD_OK)
        joined = sheet.way[0][(size_t) (sheet.y[1] - sheet.box.y) * (size_t) sheet.box.width +
                              (size_t) (sheet.x[1] - sheet.box.x)] != NOT_YET;
      if (joined)
        status = measure_ways (w, &sheet, 1);
      if (joined && status == CELD_OK)
        status = cut_sheet (w, host, &sheet);
      if (joined && status == CELD_OK && (!best->label || sheet.cost < best->cost))
        {
          Sheet other = *best;

          *best = sheet;
          sheet = other;
        }
      sheet_clear (&sheet);
    }
  return status;
}

/* ------------------------------------------------------------------ taking over */

/* A part of the label that does not touch the sheet goes with the anchor that is nearer to it: it is what shows of the
 * same sheet beyond something in front.  Marks it as reached. */
static void
join_part (const Work *w, Sheet *sheet, size_t first, uint32_t *queue)
{
  CeldRect box = sheet->box;
  size_t   bw = (size_t) box.width, n = 0;
  double   nearest[2] = { INFINITY, INFINITY };

  queue[n++] = (uint32_t) first;
  sheet->way[0][first] = 0;
  for (size_t i = 0; i < n; i++)
    {
      int x = (int) (queue[i] % bw), y = (int) (queue[i] / bw);

      for (int k = 0; k < 2; k++)
        nearest[k] = fmin (nearest[k], hypot (box.x + x - sheet->x[k], box.y + y - sheet->y[k]));
      for (int k = 0; k < 4; k++)
        {
          int    u = x + (k == 0) - (k == 1), v = y + (k == 2) - (k == 3);
          size_t q = (size_t) v * bw + (size_t) u;

          if (u < 0 || v < 0 || u >= box.width || v >= box.height || sheet->way[0][q] != NOT_YET ||
              CELD_AT (w->labels, box.x + u, box.y + v) != sheet->label)
            continue;
          sheet->way[0][q] = 0;
          queue[n++] = (uint32_t) q;
        }
    }
  for (size_t i = 0; i < n; i++)
    sheet->side[queue[i]] = nearest[0] <= nearest[1];
}

static CeldStatus
join_parts (const Work *w, Sheet *sheet)
{
  CeldRect  box = sheet->box;
  uint32_t *queue = celd_alloc ((size_t) box.width * (size_t) box.height, sizeof *queue);
  size_t    p = 0;

  if (!queue)
    return CELD_NO_MEMORY;
  for (int y = 0; y < box.height; y++)
    for (int x = 0; x < box.width; x++, p++)
      if (sheet->way[0][p] == NOT_YET && CELD_AT (w->labels, box.x + x, box.y + y) == sheet->label)
        join_part (w, sheet, p, queue);
  celd_free (queue);
  return CELD_OK;
}

static size_t
count_side (const Sheet *sheet, uint8_t side)
{
  size_t n = 0;

  for (size_t p = 0; p < (size_t) sheet->box.width * (size_t) sheet->box.height; p++)
    n += sheet->way[0][p] != NOT_YET && sheet->side[p] == side;
  return n;
}

/* The smaller side becomes a label of its own, of the same colour. */
static CeldStatus
take_side (Work *w, const Sheet *sheet, CeldSplits *splits)
{
  size_t      n[2] = { count_side (sheet, 1), count_side (sheet, 0) };
  int         moves = n[1] <= n[0];
  CeldRegion  region = w->palette->item[sheet->label - 1], *rest;
  size_t      p = 0;

  region.area  = n[moves];
  region.seeds = 0;
  region.x     = sheet->x[moves];
  region.y     = sheet->y[moves];
  if (!celd_reserve_one (splits->item, splits->n, splits->item_capacity) ||
      celd_append_uncounted (w->palette->item, w->palette->n, region) != CELD_OK)
    return CELD_NO_MEMORY;
  rest        = &w->palette->item[sheet->label - 1];
  rest->area -= n[moves];
  for (int y = 0; y < sheet->box.height; y++)
    for (int x = 0; x < sheet->box.width; x++, p++)
      if (sheet->way[0][p] != NOT_YET && sheet->side[p] == !moves)
        CELD_AT (w->labels, sheet->box.x + x, sheet->box.y + y) = (uint32_t) w->palette->n;
  if (CELD_AT (w->labels, rest->x, rest->y) != sheet->label)
    {
      rest->x = sheet->x[!moves];
      rest->y = sheet->y[!moves];
    }
  splits->item[splits->n++] = (CeldSplit) { sheet->label, (uint32_t) w->palette->n, { sheet->x[!moves], sheet->x[moves] },
                                     { sheet->y[!moves], sheet->y[moves] } };
  return CELD_OK;
}

/* Looks for contradictions, and resolves the first that a cut can resolve; *done if there is none. */
static CeldStatus
split_once (Work *w, const CeldHost *host, CeldSplits *splits, bool *done)
{
  CeldOrder  order = { 0 };
  Sheet      best = { 0 };
  CeldStatus status = celd_graph_new (w->labels, w->palette, w->relations, w->ink, &w->graph, NULL);

  if (status != CELD_OK)
    return status;
  status = celd_graph_resolve (&w->graph, CELD_ON_CYCLE_REPORT, NULL, &order);
  for (size_t i = 0; i < order.n_cycles && status == CELD_OK && !best.label; i++)
    status = find_cut (w, &order.cycle[i], host, &best);
  *done = !best.label;
  if (status == CELD_OK && best.label)
    status = join_parts (w, &best);
  if (status == CELD_OK && best.label)
    status = take_side (w, &best, splits);
  sheet_clear (&best);
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

  quiet.progress = NULL; /* nobody knows how many cuts there will be */
  celd_smoothness_costs_new (labels->width, labels->height, settings->ink_threshold, &w.costs);
  w.apart = fmax (NEAREST, FAR_APART * celd_stroke_width (ink));
  while (!done && status == CELD_OK && splits->n < 2 * relations->n) /* each cut parts two of their ends */
    {
      status = split_once (&w, &quiet, splits, &done);
      if (status == CELD_OK)
        status = celd_progress (host, 1 - 1 / (double) (splits->n + 1));
    }
  return status;
}

/* ------------------------------------------------------------------ the new borders */

/* The label that a label was split from, and the label itself. */
static uint32_t
origin_of (const CeldSplits *splits, uint32_t label)
{
  for (size_t i = splits->n; i-- > 0; ) /* later ones split what earlier ones made */
    if (splits->item[i].other == label)
      label = splits->item[i].label;
  return label;
}

bool
celd_splits_have (const CeldSplits *splits, uint32_t label)
{
  for (size_t i = 0; i < splits->n; i++)
    if (splits->item[i].label == label || splits->item[i].other == label)
      return true;
  return false;
}

/* Is any pixel round (x,y) of another region than that? */
static bool
is_near_others (const CeldSplits *splits, const CeldLabels *labels, uint32_t origin, int x, int y, int reach)
{
  for (int v = y - reach; v <= y + reach; v++)
    for (int u = x - reach; u <= x + reach; u++)
      if (u >= 0 && v >= 0 && u < labels->width && v < labels->height &&
          origin_of (splits, CELD_AT (labels, u, v)) != origin)
        return true;
  return false;
}

/* Ink round a pixel at a new border becomes paper, but not that of the region's outline. */
static void
erase_round (const CeldSplits *splits, const CeldLabels *labels, int x, int y, int reach, CeldPlane *ink)
{
  uint32_t origin = origin_of (splits, CELD_AT (labels, x, y));

  for (int v = y - 2 * reach; v <= y + 2 * reach; v++)
    for (int u = x - 2 * reach; u <= x + 2 * reach; u++)
      if (u >= 0 && v >= 0 && u < labels->width && v < labels->height && CELD_AT (ink, u, v) < 1 &&
          origin_of (splits, CELD_AT (labels, u, v)) == origin &&
          !is_near_others (splits, labels, origin, u, v, reach))
        CELD_AT (ink, u, v) = 1;
}

void
celd_splits_erase (const CeldSplits *splits, const CeldLabels *labels, int stroke, CeldPlane *ink)
{
  int reach = stroke < 1 ? 1 : stroke;

  for (int y = 0; y < labels->height; y++)
    for (int x = 0; x < labels->width; x++)
      for (int k = 0; k < 2; k++)
        {
          int      u = x + (k == 0), v = y + (k == 1);
          uint32_t here = CELD_AT (labels, x, y), there;

          if (u >= labels->width || v >= labels->height || (there = CELD_AT (labels, u, v)) == here ||
              origin_of (splits, here) != origin_of (splits, there))
            continue;
          erase_round (splits, labels, x, y, reach, ink);
        }
}
