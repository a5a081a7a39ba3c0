/* Relief: the picture as a surface to print, to light or to turn (section 5, Figure 1h).
 *
 * Each part is inflated above its outline, placed at its smooth depth, and shifted so that the depth order holds
 * (order.c).  The surface is cut only at depth discontinuities (surface.c).
 *
 * Inflation solves  laplacian f = -4  with f = 0 where a region ends in front of another, and with insulated boundaries
 * where it continues: behind something nearer, behind the frame, or across a virtual contour.  The height is sqrt f: a
 * disc becomes a hemisphere and an ellipse an ellipsoid, smooth across virtual contours.  From normals: the height
 * whose slopes are closest to -n_x / n_z and n_y / n_z, with 0 at the same outlines.  Flat regions are fixed at 0.
 * Outlines run along pixel edges, half a pixel from the nearest centres.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "depth/depth.h"
#include "relief/relief.h"
#include "solve/laplace.h"

#include <math.h>

#define MIN_STEP       0.5  /* fraction of the difference of depth that is kept at a cut, at least; chosen */
#define MAX_DEPTH      1e6  /* as a multiple of all levels; chosen: heights stay within CELD_MOST_HEIGHT */
#define OUTLINE_WEIGHT 2.f  /* of a pixel to its outline: 1 / distance */
#define MIN_NZ         0.1f /* of the sum of two normals, limits slopes; chosen */

/* ------------------------------------------------------------------ inflation */

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

/* Computes the height above the outline, in pixels, for bulge 1. */
static CeldStatus
inflate (const CeldSurface *surface, double tolerance, const CeldHost *host, float *height)
{
  Inflation  r = { .surface = surface };
  size_t     n = (size_t) surface->width * (size_t) surface->height;
  CeldStatus status = solve (&r, fmin (tolerance, CELD_INFLATION_TOLERANCE), host, height);

  for (size_t p = 0; p < n; p++)
    height[p] = sqrtf (fmaxf (height[p], 0));
  return status;
}

/* Computes the height by integrating normals, which include their bulge. */
static CeldStatus
integrate (const CeldSurface *surface, const CeldVectors *normals, double tolerance, const CeldHost *host,
           float *height)
{
  Inflation r = { .surface = surface, .normals = normals };

  return solve (&r, tolerance, host, height);
}

/* ------------------------------------------------------------------ the step */

typedef struct { float *z, *depth, *shift; CeldVectors normals; } ReliefPlanes;

/* One unit of depth in pixels.  Levels have no scale of their own: their whole range is settings.relief_depth.  Given
 * depth beyond MAX_DEPTH times that range is scaled down to it. */
static double
depth_scale (const CeldSurface *surface, const float *depth, const CeldSettings *settings)
{
  size_t n = (size_t) surface->width * (size_t) surface->height;
  double most = 1;

  for (size_t p = 0; p < n; p++)
    most = fmax (most, fmax (fabs ((double) surface->level[p]), fabs ((double) depth[p]) / MAX_DEPTH));
  return (double) settings->relief_depth * hypot (surface->width, surface->height) / most;
}

/* Depth without padding: the given depth, or else smooth depth. */
static CeldStatus
read_depth (const CeldPlane *ink, const CeldPlane *borders, const CeldPlane *levels, const CeldPlane *given,
            const CeldSettings *settings, const CeldHost *host, float *depth)
{
  CeldPlane made = { ink->width, ink->height, (size_t) ink->width, depth };

  if (!given)
    return celd_smooth (ink, borders, levels, NULL, settings, host, &made, NULL);
  celd_depth_levels (given, depth);
  return CELD_OK;
}

/* Computes the height above the outline, in pixels. */
static CeldStatus
make_round (const CeldSurface *surface, const CeldPlane *ink, const CeldPlane *borders, const CeldPlane *levels,
            const CeldSettings *settings, const CeldHost *host, ReliefPlanes *p)
{
  size_t       n = (size_t) surface->width * (size_t) surface->height;
  CeldHostPart part[2];
  CeldHost     first = celd_host_part (&part[0], host, 0, 0.6), second = celd_host_part (&part[1], host, 0.6, 1);
  CeldStatus   status;

  if (settings->relief_from == CELD_RELIEF_NORMALS)
    {
      CeldSettings of_normals = *settings;

      of_normals.bulge = settings->relief_bulge;
      p->normals = (CeldVectors) { ink->width, ink->height, (size_t) ink->width, celd_alloc (n, 3 * sizeof (float)) };
      status     = p->normals.data ? celd_normals_hinted (ink, borders, levels, NULL, NULL, &of_normals, &first,
                                                          &p->normals)
                                   : CELD_NO_MEMORY;
      if (status != CELD_OK)
        return status;
      return integrate (surface, &p->normals, (double) settings->tolerance, &second, p->z);
    }
  status = inflate (surface, (double) settings->tolerance, host, p->z);
  for (size_t i = 0; i < n; i++)
    p->z[i] *= settings->relief_bulge;
  return status;
}

static void
mark_cut (void *data, size_t near, size_t far, bool right)
{
  CeldRelief *relief = data;
  uint8_t    *cut = &relief->cut[near < far ? near : far];

  *cut = (uint8_t) (*cut | (right ? CELD_CUT_RIGHT : CELD_CUT_BELOW) |
                    (near > far ? 0 : right ? CELD_NEAR_RIGHT : CELD_NEAR_BELOW));
}

/* Fills in a relief whose planes are allocated. */
static CeldStatus
make_relief (const CeldSurface *surface, const CeldPlane *ink, const CeldPlane *borders, const CeldPlane *levels,
             const CeldSettings *settings, const CeldHost *host, ReliefPlanes *p, CeldRelief *relief)
{
  size_t       n = (size_t) surface->width * (size_t) surface->height;
  double       scale = depth_scale (surface, p->depth, settings);
  CeldHostPart part[2];
  CeldHost     rounding = celd_host_part (&part[0], host, 0, 0.4), ordering = celd_host_part (&part[1], host, 0.4, 1);
  CeldStatus   status = make_round (surface, ink, borders, levels, settings, &rounding, p);

  for (size_t i = 0; i < n; i++)
    {
      relief->outline[i] = (float) (scale * (double) p->depth[i]);
      relief->z[i]       = p->z[i] + relief->outline[i];
      relief->cut[i]     = 0;
    }
  celd_surface_cuts (surface, mark_cut, relief);
  if (status == CELD_OK)
    status = celd_relief_keep_order (surface, relief->z, p->depth, MIN_STEP * scale, &ordering, p->shift);
  for (size_t i = 0; i < n; i++)
    {
      relief->outline[i] += p->shift[i];
      relief->z[i]       += p->shift[i];
    }
  return status;
}

static CeldStatus
relief_new (int width, int height, CeldRelief *relief)
{
  size_t n = (size_t) width * (size_t) height;

  *relief = (CeldRelief) { .width = width, .height = height };
  relief->z       = celd_alloc (n, sizeof *relief->z);
  relief->outline = celd_alloc (n, sizeof *relief->outline);
  relief->cut     = celd_alloc (n, 1);
  return relief->z && relief->outline && relief->cut ? CELD_OK : CELD_NO_MEMORY;
}

CeldStatus
celd_relief (const CeldPlane *ink, const CeldPlane *borders, const CeldPlane *levels, const CeldPlane *depth,
             const CeldSettings *settings, const CeldHost *host, CeldRelief *relief)
{
  if (!CELD_SAME_SIZE (ink, levels) || (depth && !CELD_SAME_SIZE (ink, depth)) ||
      (borders && !CELD_SAME_SIZE (ink, borders)))
    return CELD_BAD_SIZE;
  if (celd_settings_check (settings) != CELD_OK)
    return CELD_BAD_VALUE;

  size_t       n = (size_t) ink->width * (size_t) ink->height;
  CeldSurface  surface = { .width = 0 };
  ReliefPlanes p = { celd_alloc (n, sizeof *p.z), celd_alloc (n, sizeof *p.depth), celd_alloc (n, sizeof *p.shift),
                     { .data = NULL } };
  CeldRelief   made = { .width = 0 };
  CeldHostPart part[3];
  CeldHost     smoothing = celd_host_part (&part[0], host, 0, 0.2), cutting = celd_host_part (&part[1], host, 0.2, 0.3);
  CeldHost     making = celd_host_part (&part[2], host, 0.3, 1);
  CeldStatus   status = p.z && p.depth && p.shift ? relief_new (ink->width, ink->height, &made) : CELD_NO_MEMORY;

  if (status == CELD_OK)
    status = read_depth (ink, borders, levels, depth, settings, &smoothing, p.depth);
  if (status == CELD_OK)
    status = celd_surface_new (ink, borders, levels, settings, &cutting, &surface);
  if (status == CELD_OK)
    status = make_relief (&surface, ink, borders, levels, settings, &making, &p, &made);
  if (status == CELD_OK)
    {
      celd_relief_clear (relief);
      *relief = made;
    }
  else
    celd_relief_clear (&made);
  celd_surface_clear (&surface);
  celd_free (p.z);
  celd_free (p.depth);
  celd_free (p.shift);
  celd_free (p.normals.data);
  return status;
}

void
celd_relief_clear (CeldRelief *relief)
{
  celd_free (relief->z);
  celd_free (relief->outline);
  celd_free (relief->cut);
  *relief = (CeldRelief) { .width = 0 };
}
