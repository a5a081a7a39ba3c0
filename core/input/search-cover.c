/* What of the paint each arrow that may be chosen explains.
 *
 * The paint is divided into square cells of a fifth of its width.  A shaft explains those near its line; a head
 * those near its barbs, or in its triangle; a dot those in a disc.  A shaft that tapers explains those that are as near
 * its line as it is wide there; of paint that fades there are cells in several levels, of which a shaft explains those
 * up to its opacity.
 *
 * Where arrows have dots, there are more levels of paint that is as wide as one, for whoever paints a dot means that an
 * arrow begins there: a line that passes a dot must cost more than two that end and begin there.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/arrow-search.h"

#include <math.h>

/* All chosen; lengths are widths of the paint, costs square widths of it. */
#define COVER_CELLS  5    /* in a width; none is smaller than a pixel */
#define UNEXPLAINED  1.5  /* cost of paint that nothing explains, by area */
#define BODY         0.58 /* from the middle of a line to the edge of its paint, ... */
#define MORE_BODY    0.6  /* ... and pixels more */
#define COVER_MARGIN 0.3  /* from the edge of a triangle to that of its paint, and as much more */
#define ARROW_COST   1.5  /* of each arrow */
#define SHAFT_COST   16   /* of what a shaft costs */
#define BOW_COST     0.3  /* of a bow of this part of the length; of others by their square: */
#define USUAL_BOW    0.06
#define COVER_LEVELS 4    /* of opacity, ... */
#define LEVEL_MORE   0.1  /* ... and opacity more that a shaft explains */
#define WIDE_ROOM    0.9  /* distance from the edge in the middle of the smallest dot; ... */
#define WIDE_LEVELS  3    /* ... and levels of paint that is so wide */
#define THICK        1.12 /* distance from the middle of a line of strength 1 to the edge of its paint */
#define LEAST_TAIL   0.7  /* strength of a tail, at least, ... */
#define TAIL_FROM    4    /* ... so many samples from its end, where others may lie on it, ... */
#define TIP_OF_TAIL  0.4  /* ... and of a tip, as a part of that of the tail, at most; ... */
#define VALUE_COST   10   /* ... and what the difference costs */
#define OPEN_BACK    3.2  /* from the tip to where the direction of a head is measured, if it is open, ... */
#define FILLED_BACK  4    /* ... and if it is filled */

/* Cells that are gathered for a piece, up to a level.  own: of each cell, is it of the shaft whose heads are looked
 * for? */
typedef struct { CeldArrowSearch *s; uint32_t *cell; size_t n; int levels; uint8_t *own; } Gather;

static CeldPoint
centre_of (const CeldArrowSearch *s, int x, int y)
{
  return (CeldPoint) { (x + 0.5) * s->step, (y + 0.5) * s->step };
}

/* Is there paint of a level of opacity at a point? */
static bool
is_painted (const CeldArrowSearch *s, CeldPoint p, int level)
{
  return celd_search_room (s, p) > 0 && (!level || celd_search_strength (s, p) >= (double) level / s->levels);
}

/* Paints the levels of a wide disc round a cell. */
static void
paint_wide (CeldArrowSearch *s, int column, int row, double radius)
{
  int    reach = (int) (radius / s->step);
  size_t plane = celd_search_plane (s);

  for (int y = row > reach ? row - reach : 0; y <= row + reach && y < s->rows; y++)
    for (int x = column > reach ? column - reach : 0; x <= column + reach && x < s->columns; x++)
      {
        size_t c = (size_t) y * (size_t) s->columns + (size_t) x;

        if (s->painted[c] && hypot (x - column, y - row) * s->step <= radius)
          for (int level = 1; level < s->levels; level++)
            s->painted[(size_t) level * plane + c] = 1;
      }
}

/* Paints the levels of paint in which a disc fits that is as wide as a dot: no line is, nor is a crossing of two. */
static void
find_wide (CeldArrowSearch *s)
{
  double radius = celd_search_dot_radius (s, WIDE_ROOM);

  for (int y = 0; y < s->rows; y++)
    for (int x = 0; x < s->columns; x++)
      if (celd_search_room (s, centre_of (s, x, y)) >= radius)
        paint_wide (s, x, y, radius);
}

CeldStatus
celd_search_cells_new (CeldArrowSearch *s)
{
  bool   fade = s->style == CELD_ARROW_FADE;
  size_t n;

  s->step    = fmax (1, s->width / COVER_CELLS);
  s->per_pixel = 1 / s->step;
  s->levels  = fade ? COVER_LEVELS : s->style == CELD_ARROW_DOT ? WIDE_LEVELS : 1;
  s->cell    = s->step * s->step / (s->width * s->width) / (fade ? s->levels : 1);
  s->area    = UNEXPLAINED * s->cell;
  s->columns = (int) (s->mask->width / s->step) + 1;
  s->rows    = (int) (s->mask->height / s->step) + 1;
  n          = celd_search_cells (s);
  s->painted = celd_alloc0 (n, sizeof *s->painted);
  s->covers  = celd_alloc0 (n, sizeof *s->covers);
  s->stamp   = celd_alloc0 (n, sizeof *s->stamp);
  if (!s->painted || !s->covers || !s->stamp)
    return CELD_NO_MEMORY;
  for (int level = 0; level < (fade ? s->levels : 1); level++)
    for (int y = 0; y < s->rows; y++)
      for (int x = 0; x < s->columns; x++)
        s->painted[(size_t) level * celd_search_plane (s) + (size_t) y * (size_t) s->columns + (size_t) x] =
          is_painted (s, centre_of (s, x, y), level);
  if (s->style == CELD_ARROW_DOT)
    find_wide (s);
  return CELD_OK;
}

/* ------------------------------------------------------------------ outlines */

/* How far a point is outside a triangle. */
static double
outside_triangle (CeldPoint p, const CeldPoint *corner)
{
  double area = (corner[1].x - corner[0].x) * (corner[2].y - corner[0].y) -
                (corner[1].y - corner[0].y) * (corner[2].x - corner[0].x);
  double nearest = INFINITY;
  bool   inside = true;

  for (int k = 0; k < 3; k++)
    {
      CeldPoint a = corner[k], b = corner[(k + 1) % 3];

      inside &= ((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)) * area >= 0;
      nearest = fmin (nearest, celd_distance_to_part (p, a, b));
    }
  return inside ? 0 : nearest;
}

/* Gathers the painted cells within a distance of the triangle of three corners, of the line of two, or of a point. */
static void
gather (Gather *g, const CeldPoint *corner, int n, double reach)
{
  CeldArrowSearch *s = g->s;
  CeldPoint        low = corner[0], high = corner[0];

  for (int k = 1; k < n; k++)
    {
      low  = (CeldPoint) { fmin (low.x, corner[k].x), fmin (low.y, corner[k].y) };
      high = (CeldPoint) { fmax (high.x, corner[k].x), fmax (high.y, corner[k].y) };
    }
  for (int y = (int) fmax (0, (low.y - reach) / s->step); y <= fmin (s->rows - 1, (high.y + reach) / s->step); y++)
    for (int x = (int) fmax (0, (low.x - reach) / s->step); x <= fmin (s->columns - 1, (high.x + reach) / s->step); x++)
      {
        size_t    c = (size_t) y * (size_t) s->columns + (size_t) x, end = (size_t) g->levels * celd_search_plane (s);
        CeldPoint p = centre_of (s, x, y);

        if (s->painted[c] &&
            (n == 3 ? outside_triangle (p, corner) : celd_distance_to_part (p, corner[0], corner[n - 1])) <= reach)
          for (; c < end && s->painted[c]; c += celd_search_plane (s))
            if (s->stamp[c] != s->tick)
              {
                s->stamp[c]     = s->tick;
                g->cell[g->n++] = (uint32_t) c;
              }
      }
}

static CeldStatus
piece_from (Gather *g, size_t *number)
{
  CeldPaintPiece  piece = { .cell = celd_alloc (g->n + 1, sizeof *piece.cell), .n = g->n };
  CeldStatus status;

  if (!piece.cell)
    return CELD_NO_MEMORY;
  memcpy (piece.cell, g->cell, g->n * sizeof *piece.cell);
  *number = g->s->n_pieces;
  status  = celd_append (g->s->piece, g->s->n_pieces, g->s->piece_capacity, piece);
  if (status != CELD_OK)
    celd_free (piece.cell);
  return status;
}

static void
start (Gather *g)
{
  g->s->tick++;
  g->n = 0;
}

static CeldStatus
shaft_piece (Gather *g, const CeldShaft *shaft, size_t *number)
{
  start (g);
  for (size_t i = 1; i < shaft->n; i++)
    gather (g, &shaft->at[i - 1], 2, BODY * g->s->width + MORE_BODY);
  return piece_from (g, number);
}

CeldStatus
celd_search_shaft_piece (CeldArrowSearch *s, const CeldShaft *shaft, size_t *piece)
{
  Gather     g = { .s = s, .cell = celd_alloc (celd_search_cells (s), sizeof *g.cell), .levels = 1 };
  CeldStatus status = g.cell ? shaft_piece (&g, shaft, piece) : CELD_NO_MEMORY;

  celd_free (g.cell);
  return status;
}

static void
gather_mark (Gather *g, const CeldHeadOutline *head, CeldPoint way)
{
  double w = g->s->width;

  start (g);
  if (head->kind == CELD_OUTLINE_DOT)
    gather (g, &head->tip, 1, head->radius);
  else if (head->kind == CELD_OUTLINE_FILLED)
    gather (g, (CeldPoint[]) { celd_moved (head->tip, way, 0.4 * w), head->barb[0], head->barb[1] }, 3,
            COVER_MARGIN * w + MORE_BODY);
  else
    for (int k = 0; k < 2; k++)
      gather (g, (CeldPoint[]) { head->tip, head->barb[k] }, 2, BODY * w + MORE_BODY);
}

/* ------------------------------------------------------------------ options */

static double
shaft_cost (const CeldShaft *shaft)
{
  double bow = shaft->bow / USUAL_BOW;

  return ARROW_COST + SHAFT_COST * shaft->cost + BOW_COST * bow * bow;
}

CeldStatus
celd_search_option_add (CeldArrowSearch *s, CeldArrowOption option)
{
  option.cost = shaft_cost (&s->shaft[option.shaft]) + option.mark_cost;
  return celd_append (s->option, s->n_options, s->option_capacity, option);
}

static void
mark_own (Gather *g, size_t body, bool own)
{
  for (size_t i = 0; body < g->s->n_pieces && i < g->s->piece[body].n; i++)
    g->own[g->s->piece[body].cell[i]] = own;
}

/* The options of a shaft with heads of a kind at one of its ends. */
static CeldStatus
add_heads_at (Gather *g, size_t k, int end, CeldOutlineKind kind, size_t body)
{
  CeldArrowSearch *s = g->s;
  const CeldShaft *shaft = &s->shaft[k];
  bool             filled = kind == CELD_OUTLINE_FILLED;
  CeldPoint        way = celd_shaft_way (shaft, end, (filled ? FILLED_BACK : OPEN_BACK) * s->width);
  CeldHeadOutline  head[CELD_MOST_HEADS];
  int              n = celd_search_heads_fit (s, kind, shaft->at[end ? shaft->n - 1 : 0], way, g->own, head);
  size_t           mark = 0;
  CeldStatus       status = CELD_OK;

  for (int i = 0; i < n && status == CELD_OK; i++)
    {
      gather_mark (g, &head[i], way);
      status = piece_from (g, &mark);
      if (status == CELD_OK)
        status = celd_search_option_add (s, (CeldArrowOption) { .shaft = k, .end = end, .filled = filled,
                                                                .mark_cost = head[i].cost, .body = body,
                                                                .mark = mark });
    }
  return status;
}

/* The options of a shaft with heads of both kinds at either end. */
static CeldStatus
add_heads (Gather *g, size_t k)
{
  size_t     body = 0;
  CeldStatus status = shaft_piece (g, &g->s->shaft[k], &body);

  mark_own (g, body, status == CELD_OK);
  for (int i = 0; i < 4 && status == CELD_OK; i++)
    status = add_heads_at (g, k, i / 2, i % 2 ? CELD_OUTLINE_FILLED : CELD_OUTLINE_OPEN, body);
  mark_own (g, body, false);
  return status;
}

/* The options of all shafts with dots: that of place p is piece p, at a cost of cost[p]. */
static CeldStatus
add_dots (Gather *g, double *cost)
{
  CeldArrowSearch *s = g->s;
  CeldStatus       status = CELD_OK;
  size_t           body = 0;

  for (size_t p = 0; p < s->n_places && status == CELD_OK; p++)
    {
      CeldHeadOutline dot = celd_search_dot_fit (s, s->place[p]);

      cost[p] = dot.cost;
      gather_mark (g, &dot, (CeldPoint) { 0, 0 });
      status = piece_from (g, &body);
    }
  for (size_t k = 0; k < s->n_shafts && status == CELD_OK; k++)
    {
      status = shaft_piece (g, &s->shaft[k], &body);
      for (int end = 0; end < 2 && status == CELD_OK; end++)
        {
          size_t place = s->shaft[k].place[end];

          status = celd_search_option_add (s, (CeldArrowOption) { .shaft = k, .end = end, .mark_cost = cost[place],
                                                                  .body = body, .mark = place });
        }
    }
  return status;
}

/* Gathers what a shaft explains that gets weaker towards one of its ends. */
static void
gather_profile (Gather *g, const CeldShaft *shaft, const CeldShaftSample *sample, int n, int end)
{
  CeldArrowSearch *s = g->s;
  bool             fade = s->style == CELD_ARROW_FADE;

  start (g);
  for (int i = 0; i <= n; i++)
    {
      double    fall = sample[i < n ? i : n - 1].fall[end];
      CeldPoint from = i ? sample[i - 1].at : shaft->at[0], to = i < n ? sample[i].at : shaft->at[shaft->n - 1];

      g->levels = fade ? (int) fmin (s->levels, 1 + floor ((fall + LEVEL_MORE) * s->levels)) : 1;
      gather (g, (CeldPoint[]) { from, to }, 2, (fade ? BODY : THICK * fall) * s->width + MORE_BODY);
    }
  g->levels = 1;
}

/* The options of a shaft that fades or tapers towards either end.  nothing: a piece without paint. */
static CeldStatus
add_profiles (Gather *g, size_t k, size_t nothing)
{
  CeldArrowSearch *s = g->s;
  CeldShaftSample *sample;
  int              n;
  CeldStatus       status = celd_shaft_samples_new (s, &s->shaft[k], &sample, &n);

  for (int end = 0; end < 2 && status == CELD_OK; end++)
    {
      int             off = (int) fmin (TAIL_FROM, 0.25 * n);
      double          tail = sample[end ? off : n - 1 - off].fall[end], tip = sample[end ? n - 1 : 0].fall[end];
      CeldArrowOption option = { .shaft = k, .end = end, .mark = nothing, .value = { tail, tip } };

      option.mark_cost = VALUE_COST * (fmax (0, LEAST_TAIL - tail) + fmax (0, tip - TIP_OF_TAIL * tail));
      gather_profile (g, &s->shaft[k], sample, n, end);
      status = piece_from (g, &option.body);
      if (status == CELD_OK)
        status = celd_search_option_add (s, option);
    }
  celd_free (sample);
  return status;
}

CeldStatus
celd_search_pieces_index (CeldArrowSearch *s)
{
  size_t n = celd_search_cells (s), all = 0;

  s->first = celd_alloc0 (n + 2, sizeof *s->first);
  for (size_t k = 0; k < s->n_pieces; k++)
    all += s->piece[k].n;
  s->piece_at = celd_alloc (all + 1, sizeof *s->piece_at);
  s->bare     = celd_alloc (s->n_pieces + 1, sizeof *s->bare);
  if (!s->first || !s->piece_at || !s->bare)
    return CELD_NO_MEMORY;
  for (size_t k = 0; k < s->n_pieces; k++)
    s->bare[k] = (uint32_t) s->piece[k].n;
  for (size_t k = 0; k < s->n_pieces; k++)
    for (size_t i = 0; i < s->piece[k].n; i++)
      s->first[s->piece[k].cell[i] + 2]++;
  for (size_t c = 2; c < n + 2; c++)
    s->first[c] += s->first[c - 1];
  for (size_t k = 0; k < s->n_pieces; k++)
    for (size_t i = 0; i < s->piece[k].n; i++)
      s->piece_at[s->first[s->piece[k].cell[i] + 1]++] = (uint32_t) k;
  return CELD_OK;
}

CeldStatus
celd_search_options_new (CeldArrowSearch *s)
{
  size_t     n = celd_search_cells (s), nothing = 0;
  int        levels = s->style == CELD_ARROW_DOT ? s->levels : 1;
  Gather     g = { .s = s, .levels = levels };
  double    *cost = celd_alloc (s->n_places + 1, sizeof *cost);
  CeldStatus status;

  g.cell = celd_alloc (n, sizeof *g.cell);
  g.own  = celd_alloc0 (n, sizeof *g.own);
  status = g.cell && g.own && cost ? CELD_OK : CELD_NO_MEMORY;
  if (status == CELD_OK && s->style == CELD_ARROW_DOT)
    status = add_dots (&g, cost);
  for (size_t k = 0; k < s->n_shafts && status == CELD_OK && s->style == CELD_ARROW_HEAD; k++)
    status = add_heads (&g, k);
  if (status == CELD_OK && celd_search_has_profiles (s))
    status = piece_from (&g, &nothing);
  for (size_t k = 0; k < s->n_shafts && status == CELD_OK && celd_search_has_profiles (s); k++)
    status = add_profiles (&g, k, nothing);
  celd_free (g.cell);
  celd_free (g.own);
  celd_free (cost);
  return status;
}
