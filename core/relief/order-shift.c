/* Order-preserving shifts of surface tiles.
 *
 * The shift is smooth over the surface, so it has one value for each tile: a block of pixels, divided further where the
 * surface is cut.  It minimizes over u
 *
 *     sum over links  edges/side (u_a - u_b)^2  +  sum over pixels  u^2 / range^2, or u^2 in flat regions,
 *       +  CUT_STIFFNESS sum over cuts  edges max (0, minimum - (u_a - u_b))^2,
 *
 * which is convex and differentiable, by Newton's method with an exact line search: each step solves the quadratic
 * problem of the violated cuts by conjugate gradients with diagonal preconditioning.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "relief/relief.h"

#include <math.h>

#define TILES_ON_DIAGONAL  96   /* chosen */
#define MIN_TILE_SIDE      4    /* pixels; chosen */
#define CUT_STIFFNESS      4.0  /* of a cut, for each of its edges; the surface has 1 for each pixel; chosen */
#define MAX_NEWTON_STEPS   40
#define MAX_CG_ITERATIONS  60   /* of conjugate gradients, in one Newton step */
#define CG_TOLERANCE       0.05 /* relative to the residual at the beginning of a Newton step; chosen */
#define GRADIENT_TOLERANCE 3e-4 /* relative to the first gradient; chosen */

static int
end_of (int from, int side, int size)
{
  return from + side < size ? from + side : size;
}

/* ------------------------------------------------------------------ tiles */

/* Joins the connected pixels of a block; `parent` is indexed by pixels. */
static void
join_block (const CeldSurface *s, int x, int y, int end_x, int end_y, uint32_t *parent)
{
  uint32_t w = (uint32_t) s->width;

  for (int v = y; v < end_y; v++)
    for (int u = x; u < end_x; u++)
      {
        uint32_t p = (uint32_t) v * w + (uint32_t) u;

        if (u + 1 < end_x && s->east[p] > 0)
          celd_join (parent, p, p + 1);
        if (v + 1 < end_y && s->south[p] > 0)
          celd_join (parent, p, p + w);
      }
}

static void
number_tiles (const CeldSurface *s, CeldReliefTiles *tiles)
{
  size_t    n = (size_t) s->width * (size_t) s->height;
  uint32_t *tile = tiles->tile;

  celd_roots (tile, n);
  for (int y = 0; y < s->height; y += tiles->side)
    for (int x = 0; x < s->width; x += tiles->side)
      join_block (s, x, y, end_of (x, tiles->side, s->width), end_of (y, tiles->side, s->height), tile);
  for (size_t p = 0; p < n; p++) /* the parent comes first and has its number already */
    tile[p] = tile[p] == p ? tiles->n++ : tile[tile[p]];
}

static CeldStatus
measure_tiles (const CeldSurface *s, CeldReliefTiles *tiles)
{
  const uint32_t *tile = tiles->tile;

  tiles->area = celd_alloc0 (tiles->n, sizeof *tiles->area);
  tiles->flat = celd_alloc0 (tiles->n, sizeof *tiles->flat);
  tiles->x    = celd_alloc0 (tiles->n, sizeof *tiles->x);
  tiles->y    = celd_alloc0 (tiles->n, sizeof *tiles->y);
  if (!tiles->area || !tiles->flat || !tiles->x || !tiles->y)
    return CELD_NO_MEMORY;
  for (int y = 0; y < s->height; y++)
    for (int x = 0; x < s->width; x++, tile++)
      {
        tiles->area[*tile] += 1;
        tiles->flat[*tile] += s->flat[tile - tiles->tile];
        tiles->x[*tile]    += (float) x;
        tiles->y[*tile]    += (float) y;
      }
  for (uint32_t k = 0; k < tiles->n; k++)
    {
      tiles->x[k] /= tiles->area[k];
      tiles->y[k] /= tiles->area[k];
    }
  return CELD_OK;
}

/* ------------------------------------------------------------------ links between tiles */

/* Adds an edge between two tiles, to the last pair if that is the same. */
static CeldStatus
add_edge (CeldReliefTiles *tiles, uint32_t a, uint32_t b)
{
  CeldReliefTilePair *last = tiles->links ? &tiles->link[tiles->links - 1] : NULL;

  if (!last || last->a != a || last->b != b)
    return celd_append (tiles->link, tiles->links, tiles->link_capacity,
                        (CeldReliefTilePair) { .a = a, .b = b, .edges = 1 });
  last->edges += 1;
  return CELD_OK;
}

/* Links the tiles of the block x .. end_x - 1, y .. end_y - 1 with those to the right and below. */
static CeldStatus
link_block (const CeldSurface *s, int x, int y, int end_x, int end_y, CeldReliefTiles *tiles)
{
  size_t     w = (size_t) s->width;
  CeldStatus status = CELD_OK;

  for (int v = y; v < end_y && end_x < s->width && status == CELD_OK; v++)
    {
      size_t p = (size_t) v * w + (size_t) end_x - 1;

      if (s->east[p] > 0)
        status = add_edge (tiles, tiles->tile[p], tiles->tile[p + 1]);
    }
  for (int u = x; u < end_x && end_y < s->height && status == CELD_OK; u++)
    {
      size_t p = (size_t) (end_y - 1) * w + (size_t) u;

      if (s->south[p] > 0)
        status = add_edge (tiles, tiles->tile[p], tiles->tile[p + w]);
    }
  return status;
}

CeldStatus
celd_relief_tiles_new (const CeldSurface *s, CeldReliefTiles *tiles)
{
  double     side = hypot (s->width, s->height) / TILES_ON_DIAGONAL;
  CeldStatus status;

  *tiles      = (CeldReliefTiles) { .side = side > MIN_TILE_SIDE ? (int) side : MIN_TILE_SIDE };
  tiles->tile = celd_alloc ((size_t) s->width * (size_t) s->height, sizeof *tiles->tile);
  if (!tiles->tile)
    return CELD_NO_MEMORY;
  number_tiles (s, tiles);
  status = measure_tiles (s, tiles);
  for (int y = 0; y < s->height && status == CELD_OK; y += tiles->side)
    for (int x = 0; x < s->width && status == CELD_OK; x += tiles->side)
      status = link_block (s, x, y, end_of (x, tiles->side, s->width), end_of (y, tiles->side, s->height), tiles);
  return status;
}

void
celd_relief_tiles_clear (CeldReliefTiles *tiles)
{
  celd_free (tiles->tile);
  celd_free (tiles->area);
  celd_free (tiles->flat);
  celd_free (tiles->x);
  celd_free (tiles->y);
  celd_free (tiles->link);
  *tiles = (CeldReliefTiles) { .side = 0 };
}

typedef struct
{
  const CeldReliefTiles    *tiles;
  const CeldReliefTilePair *cut;
  size_t                    cuts;
  double                    hold;   /* weight of u^2 for a pixel that is not flat */
  uint8_t                  *active; /* of each cut: is it violated? */
  double                   *u, *gradient, *step, *r, *p, *q, *diagonal;
} Shift;

static double
violation (const Shift *s, const double *u, size_t i)
{
  return (double) s->cut[i].minimum - (u[s->cut[i].a] - u[s->cut[i].b]);
}

/* Weight of u^2 for a tile. */
static double
hold_of (const Shift *s, uint32_t k)
{
  return s->hold * (double) s->tiles->area[k] + (double) s->tiles->flat[k];
}

/* to = A v, the quadratic form of links and weights, and with `with_cuts` of the violated cuts. */
static void
multiply (const Shift *s, const double *v, bool with_cuts, double *to)
{
  const CeldReliefTiles *c = s->tiles;

  for (uint32_t k = 0; k < c->n; k++)
    to[k] = hold_of (s, k) * v[k];
  for (size_t i = 0; i < c->links; i++)
    {
      double flow = (double) c->link[i].edges / c->side * (v[c->link[i].a] - v[c->link[i].b]);

      to[c->link[i].a] += flow;
      to[c->link[i].b] -= flow;
    }
  for (size_t i = 0; i < s->cuts && with_cuts; i++)
    if (s->active[i])
      {
        double flow = CUT_STIFFNESS * (double) s->cut[i].edges * (v[s->cut[i].a] - v[s->cut[i].b]);

        to[s->cut[i].a] += flow;
        to[s->cut[i].b] -= flow;
      }
}

/* Computes the gradient at u, the violated cuts, and the diagonal of the quadratic form. */
static void
evaluate (Shift *s)
{
  const CeldReliefTiles *c = s->tiles;

  multiply (s, s->u, false, s->gradient);
  for (uint32_t k = 0; k < c->n; k++)
    s->diagonal[k] = hold_of (s, k);
  for (size_t i = 0; i < c->links; i++)
    {
      s->diagonal[c->link[i].a] += (double) c->link[i].edges / c->side;
      s->diagonal[c->link[i].b] += (double) c->link[i].edges / c->side;
    }
  for (size_t i = 0; i < s->cuts; i++)
    {
      double violated = violation (s, s->u, i), stiff = CUT_STIFFNESS * (double) s->cut[i].edges;

      s->active[i] = violated > 0;
      if (violated <= 0)
        continue;
      s->gradient[s->cut[i].a] -= stiff * violated;
      s->gradient[s->cut[i].b] += stiff * violated;
      s->diagonal[s->cut[i].a] += stiff;
      s->diagonal[s->cut[i].b] += stiff;
    }
}

/* The Newton step, approximately. */
static void
newton_step (Shift *s)
{
  size_t n = s->tiles->n;
  double left = 0, first;

  for (size_t k = 0; k < n; k++)
    {
      s->step[k] = 0;
      s->r[k]    = -s->gradient[k];
      s->p[k]    = s->r[k] / s->diagonal[k];
      left      += s->r[k] * s->p[k];
    }
  first = left;
  for (int round = 0; round < MAX_CG_ITERATIONS && left > CG_TOLERANCE * CG_TOLERANCE * first; round++)
    {
      double alpha, next = 0;

      multiply (s, s->p, true, s->q);
      alpha = left / celd_dot (s->p, s->q, n);
      for (size_t k = 0; k < n; k++)
        {
          s->step[k] += alpha * s->p[k];
          s->r[k]    -= alpha * s->q[k];
          next       += s->r[k] * s->r[k] / s->diagonal[k];
        }
      for (size_t k = 0; k < n; k++)
        s->p[k] = s->r[k] / s->diagonal[k] + next / left * s->p[k];
      left = next;
    }
}

/* The derivative of the objective at u + t step along the step; rising in t. */
static double
derivative_at (const Shift *s, double t, double slope, double curvature)
{
  double sum = slope + t * curvature;

  for (size_t i = 0; i < s->cuts; i++)
    {
      double away = s->step[s->cut[i].a] - s->step[s->cut[i].b], violated = violation (s, s->u, i) - t * away;

      if (violated > 0)
        sum -= CUT_STIFFNESS * (double) s->cut[i].edges * violated * away;
    }
  return sum;
}

/* The t that minimizes the objective along the step. */
static double
line_search (Shift *s)
{
  size_t n = s->tiles->n;
  double low = 0, high = 1, slope, curvature;

  multiply (s, s->u, false, s->q);
  slope = celd_dot (s->q, s->step, n);
  multiply (s, s->step, false, s->q);
  curvature = celd_dot (s->q, s->step, n);
  while (high < 64 && derivative_at (s, high, slope, curvature) < 0)
    {
      low   = high;
      high *= 2;
    }
  for (int i = 0; i < 12; i++)
    {
      double middle = (low + high) / 2;

      if (derivative_at (s, middle, slope, curvature) < 0)
        low = middle;
      else
        high = middle;
    }
  return low;
}

static CeldStatus
minimize (Shift *s, const CeldHost *host)
{
  size_t n = s->tiles->n;
  double first = 0;

  for (int i = 0; i < MAX_NEWTON_STEPS; i++)
    {
      double size, length;

      if (celd_progress (host, (double) i / MAX_NEWTON_STEPS) != CELD_OK)
        return CELD_CANCELLED;
      evaluate (s);
      size  = sqrt (celd_dot (s->gradient, s->gradient, n));
      first = i ? first : size;
      if (size <= GRADIENT_TOLERANCE * first)
        break;
      newton_step (s);
      length = line_search (s);
      if (length <= 0)
        break;
      for (size_t k = 0; k < n; k++)
        s->u[k] += length * s->step[k];
    }
  return CELD_OK;
}

CeldStatus
celd_relief_shift_tiles (const CeldReliefTiles *tiles, const CeldReliefTilePair *cut, size_t cuts, double range,
                         const CeldHost *host, double *shift)
{
  size_t     n = tiles->n;
  double    *space = celd_alloc0 (n, 6 * sizeof *space);
  Shift      s = { .tiles = tiles, .cut = cut, .cuts = cuts, .hold = 1 / (range * range), .u = shift };
  CeldStatus status = CELD_NO_MEMORY;

  s.active = celd_alloc0 (cuts, 1);
  if (!space || !s.active)
    goto done;
  s.gradient = space, s.step = space + n, s.r = space + 2 * n;
  s.p = space + 3 * n, s.q = space + 4 * n, s.diagonal = space + 5 * n;
  for (size_t k = 0; k < n; k++)
    shift[k] = 0;
  status = minimize (&s, host);

done:
  celd_free (space);
  celd_free (s.active);
  return status;
}
