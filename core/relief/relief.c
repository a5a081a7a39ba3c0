/* Relief: the picture as a surface to print, to light or to turn (section 5, Figure 1h).
 *
 * Each part is inflated above its outline (inflation.c), placed at its smooth depth, and shifted so that the depth
 * order holds (order.c).  The surface is cut only at depth discontinuities (surface.c).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "depth/depth.h"
#include "relief/relief.h"

#include <math.h>

#define MIN_STEP  0.5 /* fraction of the difference of depth that is kept at a cut, at least; chosen */
#define MAX_DEPTH 1e6 /* as a multiple of all levels; chosen: heights stay within CELD_MOST_HEIGHT */

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
read_depth (const CeldPlane *ink, const CeldPlane *levels, const CeldPlane *given, const CeldSettings *settings,
            const CeldHost *host, float *depth)
{
  CeldPlane made = { ink->width, ink->height, (size_t) ink->width, depth };

  if (!given)
    return celd_smooth (ink, levels, NULL, settings, host, &made, NULL);
  celd_depth_levels (given, depth);
  return CELD_OK;
}

/* Computes the height above the outline, in pixels. */
static CeldStatus
make_round (const CeldSurface *surface, const CeldPlane *ink, const CeldPlane *levels, const CeldSettings *settings,
            const CeldHost *host, ReliefPlanes *p)
{
  size_t       n = (size_t) surface->width * (size_t) surface->height;
  CeldHostPart part[2];
  CeldHost     first = celd_host_part (&part[0], host, 0, 0.6), second = celd_host_part (&part[1], host, 0.6, 1);
  CeldStatus   status;

  if (settings->relief_from == CELD_RELIEF_NORMALS)
    {
      p->normals = (CeldVectors) { ink->width, ink->height, (size_t) ink->width, celd_alloc (n, 3 * sizeof (float)) };
      status     = p->normals.data ? celd_normals (ink, levels, settings, &first, &p->normals) : CELD_NO_MEMORY;
      if (status != CELD_OK)
        return status;
      return celd_relief_integrate (surface, &p->normals, (double) settings->tolerance, &second, p->z);
    }
  status = celd_relief_inflate (surface, (double) settings->tolerance, host, p->z);
  for (size_t i = 0; i < n; i++)
    p->z[i] *= settings->bulge;
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
make_relief (const CeldSurface *surface, const CeldPlane *ink, const CeldPlane *levels, const CeldSettings *settings,
             const CeldHost *host, ReliefPlanes *p, CeldRelief *relief)
{
  size_t       n = (size_t) surface->width * (size_t) surface->height;
  double       scale = depth_scale (surface, p->depth, settings);
  CeldHostPart part[2];
  CeldHost     rounding = celd_host_part (&part[0], host, 0, 0.4), ordering = celd_host_part (&part[1], host, 0.4, 1);
  CeldStatus   status = make_round (surface, ink, levels, settings, &rounding, p);

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
celd_relief (const CeldPlane *ink, const CeldPlane *levels, const CeldPlane *depth, const CeldSettings *settings,
             const CeldHost *host, CeldRelief *relief)
{
  if (!CELD_SAME_SIZE (ink, levels) || (depth && !CELD_SAME_SIZE (ink, depth)))
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
    status = read_depth (ink, levels, depth, settings, &smoothing, p.depth);
  if (status == CELD_OK)
    status = celd_surface_new (ink, levels, settings->ink_threshold, &cutting, &surface);
  if (status == CELD_OK)
    status = make_relief (&surface, ink, levels, settings, &making, &p, &made);
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
