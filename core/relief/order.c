/* Depth order of inflated surfaces, which would otherwise intersect each other.
 *
 * Finds the smallest and smoothest shift u of the surface z that keeps at each cut, p in front of q,
 *
 *     (z + u)_p - (z + u)_q  >=  step max (0, d_p - d_q),
 *
 * minimizing  sum (u_p - u_q)^2 over uncut edges  +  sum u^2 / range^2.  Parts move as a whole where nothing holds
 * them, bend where they are connected with others, and stay in place where the order holds already.
 *
 * The shift is found for tiles of the surface (order-shift.c), interpolated and smoothed.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "relief/relief.h"

#include <math.h>
#include <stdlib.h>

#define SHIFT_RANGE      0.5   /* range of a shift relative to the diagonal; chosen */
#define SMOOTHING_SIDES  0.75  /* standard deviation of the smoothing, in sides of a tile; chosen */
#define SMOOTHING_PASSES 3
#define ORDER_TOLERANCE  0.25f /* pixels by which the order may be violated after smoothing; chosen */
#define MAX_ITERATIONS   6

typedef struct
{
  const CeldSurface  *surface;
  const float        *z, *depth;
  double              step;
  CeldReliefTiles     tiles;
  CeldReliefTilePair *cut;            /* sorted by a and b once they are merged */
  size_t              cuts, cut_capacity;
  const float        *shift;
  bool                holds;
  CeldStatus          status;
} Order;

/* ------------------------------------------------------------------ cuts between tiles */

static void
add_cut (void *data, size_t near, size_t far, bool right)
{
  Order   *o = data;
  double   ahead = fmax (0, (double) o->depth[near] - (double) o->depth[far]) * o->step;
  uint32_t a = o->tiles.tile[near], b = o->tiles.tile[far];

  (void) right;
  if (a != b && o->status == CELD_OK)
    o->status = celd_append (o->cut, o->cuts, o->cut_capacity, (CeldReliefTilePair) {
                               .a = a, .b = b, .edges = 1,
                               .minimum = (float) (ahead - ((double) o->z[near] - (double) o->z[far])) });
}

static int
compare_cuts (const void *first, const void *second)
{
  const CeldReliefTilePair *p = first, *q = second;

  if (p->a != q->a)
    return p->a < q->a ? -1 : 1;
  return (p->b > q->b) - (p->b < q->b);
}

/* Merges the cuts of each pair of tiles; the largest minimum counts. */
static void
merge_cuts (Order *o)
{
  size_t n = 0;

  if (o->cuts)
    qsort (o->cut, o->cuts, sizeof *o->cut, compare_cuts);
  for (size_t i = 0; i < o->cuts; i++)
    if (n && !compare_cuts (&o->cut[n - 1], &o->cut[i]))
      {
        o->cut[n - 1].edges += 1;
        o->cut[n - 1].minimum = fmaxf (o->cut[n - 1].minimum, o->cut[i].minimum);
      }
    else
      o->cut[n++] = o->cut[i];
  o->cuts = n;
}

/* ------------------------------------------------------------------ interpolation */

/* Sums over the links of a tile for a least-squares fit of the slope. */
typedef struct { double xx, xy, yy, xu, yu; } Slope;

static void
add_slope (Slope *s, double weight, double x, double y, double u)
{
  s->xx += weight * x * x;
  s->xy += weight * x * y;
  s->yy += weight * y * y;
  s->xu += weight * x * u;
  s->yu += weight * y * u;
}

/* Fits the slope of the shift in each tile to the shifts of linked tiles; the result is in xu and yu. */
static void
find_slopes (const CeldReliefTiles *c, const double *shift, Slope *slope)
{
  for (size_t i = 0; i < c->links; i++)
    {
      uint32_t a = c->link[i].a, b = c->link[i].b;
      double   x = (double) (c->x[b] - c->x[a]), y = (double) (c->y[b] - c->y[a]), weight = (double) c->link[i].edges;

      add_slope (&slope[a], weight, x, y, shift[b] - shift[a]);
      add_slope (&slope[b], weight, x, y, shift[b] - shift[a]);
    }
  for (uint32_t k = 0; k < c->n; k++)
    {
      Slope *s = &slope[k];
      double minimum = 0.01 * (s->xx + s->yy) + 1e-9; /* regularisation: tiles in a row do not determine the slope
                                                       * across */
      double xx = s->xx + minimum, yy = s->yy + minimum, by = xx * yy - s->xy * s->xy, x = s->xu;

      s->xu = (yy * x - s->xy * s->yu) / by;
      s->yu = (xx * s->yu - s->xy * x) / by;
    }
}

/* The shift of each pixel from that of its tile and the slope there. */
static void
interpolate_shift (const CeldSurface *s, const CeldReliefTiles *c, const double *of_tile, const Slope *slope,
                   float *shift)
{
  size_t n = (size_t) s->width * (size_t) s->height, w = (size_t) s->width;

  for (size_t p = 0; p < n; p++)
    {
      uint32_t k = c->tile[p];

      shift[p] = (float) (of_tile[k] + slope[k].xu * ((double) (p % w) - (double) c->x[k]) +
                          slope[k].yu * ((double) (p / w) - (double) c->y[k]));
    }
}

/* Recursive filter along a row, forwards and backwards: each pixel is mixed with the one before, unless the surface
 * is cut between them. */
static void
smooth_row (const float *east, int n, float weight_of_last, float *v)
{
  for (int x = 1; x < n; x++)
    v[x] += weight_of_last * east[x - 1] * (v[x - 1] - v[x]);
  for (int x = n - 2; x >= 0; x--)
    v[x] += weight_of_last * east[x] * (v[x + 1] - v[x]);
}

/* One step of the recursive filter from row to row. */
CELD_CLONES static void
mix_rows (const float *restrict from, const float *restrict weight, int n, float weight_of_last, float *restrict v)
{
  for (int x = 0; x < n; x++)
    v[x] += weight_of_last * weight[x] * (from[x] - v[x]);
}

/* Approximates a Gaussian within the surface by recursive filters along rows and columns, with half the width in
 * each pass, that do not cross cuts [Gastal and Oliveira: Domain Transform for Edge-Aware Image and Video
 * Processing, 2011]. */
static void
smooth_shift (const CeldSurface *s, double deviation, float *shift)
{
  size_t w = (size_t) s->width;
  float *end = shift + w * (size_t) s->height;

  for (int i = 0; i < SMOOTHING_PASSES; i++)
    {
      double width = deviation * sqrt (3 / (pow (4, SMOOTHING_PASSES) - 1)) * pow (2, SMOOTHING_PASSES - 1 - i);
      float  weight_of_last = (float) exp (-sqrt (2) / width);

      for (int y = 0; y < s->height; y++)
        smooth_row (s->east + (size_t) y * w, s->width, weight_of_last, shift + (size_t) y * w);
      for (float *v = shift; v + w < end; v += w)
        mix_rows (v, s->south + (v - shift), s->width, weight_of_last, v + w);
      for (float *v = end - w; v > shift; v -= w)
        mix_rows (v, s->south + (v - shift) - w, s->width, weight_of_last, v - w);
    }
}

/* Finds the shifts of tiles, and from them those of pixels. */
static CeldStatus
find_shift (const Order *o, double range, const CeldHost *host, float *shift)
{
  size_t     n = o->tiles.n;
  double    *of_tile = celd_alloc (n, sizeof *of_tile);
  Slope     *slope = celd_alloc0 (n, sizeof *slope);
  CeldStatus status = of_tile && slope ? celd_relief_shift_tiles (&o->tiles, o->cut, o->cuts, range, host, of_tile)
                                       : CELD_NO_MEMORY;

  if (status == CELD_OK)
    {
      find_slopes (&o->tiles, of_tile, slope);
      interpolate_shift (o->surface, &o->tiles, of_tile, slope, shift);
      smooth_shift (o->surface, SMOOTHING_SIDES * o->tiles.side, shift);
    }
  celd_free (of_tile);
  celd_free (slope);
  return status;
}

/* ------------------------------------------------------------------ */

static bool
order_holds (const Order *o)
{
  for (size_t i = 0; i < o->cuts; i++)
    if (o->cut[i].minimum > 0)
      return false;
  return true;
}

/* Raises the minimum of cuts whose order smoothing has violated. */
static void
raise_minimum (void *data, size_t near, size_t far, bool right)
{
  Order             *o = data;
  float              behind = o->z[far] + o->shift[far] - (o->z[near] + o->shift[near]);
  CeldReliefTilePair pair = { .a = o->tiles.tile[near], .b = o->tiles.tile[far] }, *found;

  (void) right;
  if (behind <= ORDER_TOLERANCE || pair.a == pair.b)
    return;
  found        = bsearch (&pair, o->cut, o->cuts, sizeof pair, compare_cuts);
  found->increase  = fmaxf (found->increase, behind);
  o->holds      = false;
}

/* Repeats until the order holds. */
static CeldStatus
keep_cuts (Order *o, const CeldHost *host, float *shift)
{
  double     range = SHIFT_RANGE * hypot (o->surface->width, o->surface->height);
  CeldStatus status = CELD_OK;

  o->holds  = order_holds (o);
  o->shift = shift;
  for (int i = 0; i < MAX_ITERATIONS && !o->holds && status == CELD_OK; i++)
    {
      CeldHostPart part;
      CeldHost     turn = celd_host_part (&part, host, (double) i / MAX_ITERATIONS, (double) (i + 1) / MAX_ITERATIONS);

      status  = find_shift (o, range, &turn, shift);
      o->holds = true;
      celd_surface_cuts (o->surface, raise_minimum, o);
      for (size_t k = 0; k < o->cuts; k++)
        {
          o->cut[k].minimum += o->cut[k].increase;
          o->cut[k].increase = 0;
        }
    }
  return status;
}

CeldStatus
celd_relief_keep_order (const CeldSurface *surface, const float *z, const float *depth, double step,
                        const CeldHost *host, float *shift)
{
  Order o = { .surface = surface, .z = z, .depth = depth, .step = step };

  memset (shift, 0, (size_t) surface->width * (size_t) surface->height * sizeof *shift);
  o.status = celd_relief_tiles_new (surface, &o.tiles);
  if (o.status == CELD_OK)
    celd_surface_cuts (surface, add_cut, &o);
  if (o.status == CELD_OK)
    {
      merge_cuts (&o);
      o.status = keep_cuts (&o, host, shift);
    }
  celd_relief_tiles_clear (&o.tiles);
  celd_free (o.cut);
  return o.status;
}
