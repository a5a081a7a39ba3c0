/* Inflation: the height of a surface above its outline (section 5; from normals as in Johnston's Lumo).
 *
 * Inflation solves  laplacian f = -4  with f = 0 where a region ends in front of another, and with insulated boundaries
 * where it continues: behind something nearer, behind the frame, or across a virtual contour.  The height is sqrt f: a
 * disc becomes a hemisphere and an ellipse an ellipsoid, smooth across virtual contours.
 *
 * From normals: the height whose slopes are closest to -n_x / n_z and n_y / n_z, with 0 at the same outlines.
 *
 * Flat regions are fixed at 0.  Outlines run along pixel edges, half a pixel from the nearest centres.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "relief/relief.h"
#include "solve/laplace.h"

#include <math.h>

#define OUTLINE_WEIGHT      2.f  /* of a pixel to its outline: 1 / distance */
#define MIN_NZ              0.1f /* of the sum of two normals, limits slopes; chosen */
#define INFLATION_TOLERANCE 1e-5 /* relative to the largest f; heights are square roots, and small parts matter as
                                  * much as large ones; chosen */

/* The linear system; normals NULL: inflation. */
typedef struct
{
  const CeldSurface *surface;
  const CeldVectors *normals;
  float             *diagonal, *b;
} Inflation;

/* Slope between two neighbours with normals p and q.  On a circle, the chord of two points is perpendicular to the
 * sum of their normals. */
static float
slope_of (const float *p, const float *q, bool right)
{
  float nz = fmaxf (p[2] + q[2], MIN_NZ);

  return right ? -(p[0] + q[0]) / nz : (p[1] + q[1]) / nz;
}

static const float *
normal_at (const Inflation *r, size_t i)
{
  size_t w = (size_t) r->normals->width;

  return CELD_XYZ (r->normals, i % w, i / w);
}

/* Ties the nearer side to its outline, at height 0 and half a pixel away, where the normal lies in the picture
 * plane. */
static void
hold_outline (void *data, size_t near, size_t far, bool right)
{
  Inflation *r = data;

  if (r->surface->flat[near])
    return;
  r->diagonal[near] += OUTLINE_WEIGHT;
  if (r->normals)
    {
      const float *n = normal_at (r, near);
      float        flat = hypotf (n[0], n[1]), end[3] = { 0, 0, 0 };

      for (int k = 0; k < 2 && flat > 0; k++)
        end[k] = n[k] / flat;
      r->b[near] += OUTLINE_WEIGHT * 0.5f * slope_of (n, end, right) * (near < far ? -1.f : 1.f);
    }
}

/* Adds the slope between the neighbours p and q to the right-hand side. */
static void
add_slope (Inflation *r, size_t p, size_t q, bool right)
{
  float rise = slope_of (normal_at (r, p), normal_at (r, q), right);

  r->b[p] -= rise;
  r->b[q] += rise;
}

static void
add_slopes (Inflation *r)
{
  const CeldSurface *s = r->surface;
  size_t             w = (size_t) s->width, n = w * (size_t) s->height;

  for (size_t p = 0; p < n; p++)
    {
      if (s->east[p] > 0)
        add_slope (r, p, p + 1, true);
      if (s->south[p] > 0)
        add_slope (r, p, p + w, false);
    }
}

/* Solves for the height, or for f. */
static CeldStatus
solve (Inflation *r, double tolerance, const CeldHost *host, float *x)
{
  const CeldSurface *s = r->surface;
  size_t             n = (size_t) s->width * (size_t) s->height;
  CeldHostPart       part[2];
  CeldHost           setting_up = celd_host_part (&part[0], host, 0, 0.3);
  CeldHost           solving = celd_host_part (&part[1], host, 0.3, 1);
  CeldLaplace       *laplace = NULL;
  CeldStatus         status = CELD_NO_MEMORY;

  r->diagonal = celd_alloc0 (n, sizeof *r->diagonal);
  r->b        = celd_alloc0 (n, sizeof *r->b);
  if (!r->diagonal || !r->b)
    goto done;
  celd_surface_cuts (s, hold_outline, r);
  if (r->normals)
    add_slopes (r);
  for (size_t p = 0; p < n; p++)
    {
      if (!r->normals)
        r->b[p] = 4;
      x[p] = 0;
    }
  status = celd_lap_setup (s->width, s->height, s->east, s->south, r->diagonal, s->flat, &setting_up, &laplace);
  if (status == CELD_OK)
    status = celd_lap_solve (laplace, 1, r->b, x, tolerance, &solving, NULL);

done:
  celd_lap_free (laplace);
  celd_free (r->diagonal);
  celd_free (r->b);
  return status;
}

CeldStatus
celd_relief_inflate (const CeldSurface *surface, double tolerance, const CeldHost *host, float *height)
{
  Inflation  r = { .surface = surface };
  size_t     n = (size_t) surface->width * (size_t) surface->height;
  CeldStatus status = solve (&r, fmin (tolerance, INFLATION_TOLERANCE), host, height);

  for (size_t p = 0; p < n; p++)
    height[p] = sqrtf (fmaxf (height[p], 0));
  return status;
}

CeldStatus
celd_relief_integrate (const CeldSurface *surface, const CeldVectors *normals, double tolerance, const CeldHost *host,
                       float *height)
{
  Inflation r = { .surface = surface, .normals = normals };

  return solve (&r, tolerance, host, height);
}
