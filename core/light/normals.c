/* Normals of a blobby surface, Lumo [Joh02], with depth discontinuities (section 5).
 *
 * At an outline the normal lies in the picture and points outward.  n_x and n_y are harmonic in between, each by
 * itself, and n_z follows from unit length; on a disc that is exactly a hemisphere, and on an ellipse nearly an
 * ellipsoid whose third half axis is the harmonic mean of the others.
 *
 *   [Joh02]  S. F. Johnston: Lumo: Illumination for Cel Animation.  NPAR 2002.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "depth/depth.h"
#include "image/image.h"
#include "light/lumo.h"

#include <math.h>

/* n_z from unit length; the slope n_xy / n_z is scaled by the bulge. */
static void
deliver (const float *tilt, double bulge, CeldVectors *normals)
{
  for (int y = 0; y < normals->height; y++)
    {
      float *out = CELD_XYZ (normals, 0, y);

      for (int x = 0; x < normals->width; x++, out += 3, tilt += 2)
        {
          double u = (double) tilt[0], v = (double) tilt[1], z = sqrt (fmax (0, 1 - u * u - v * v)), length;

          u *= bulge;
          v *= bulge;
          length = sqrt (u * u + v * v + z * z);
          out[0] = length > 0 ? (float) (u / length) : 0;
          out[1] = length > 0 ? (float) (v / length) : 0;
          out[2] = length > 0 ? (float) (z / length) : 1;
        }
    }
}

/* Levels, and where they are cut. */
static CeldStatus
weigh (CeldLumo *l, const CeldPlane *levels, const CeldHost *host)
{
  float  threshold = l->settings->ink_threshold;
  size_t n = (size_t) l->width * (size_t) l->height;

  l->level = celd_alloc (n, sizeof *l->level);
  l->east  = celd_alloc (n, sizeof *l->east);
  l->south = celd_alloc (n, sizeof *l->south);
  if (!l->level || !l->east || !l->south)
    return CELD_NO_MEMORY;
  l->stroke = celd_stroke_width (l->ink);
  l->edges  = (CeldEdges) { l->ink, threshold, celd_edge_reach (l->stroke) };
  celd_depth_levels (levels, l->level);
  return celd_depth_weights (l->ink, l->level, threshold, host, l->east, l->south);
}

static bool
is_view (const void *data, int width, int height, const CeldPlane *ink)
{
  return data && width == ink->width && height == ink->height;
}

CeldStatus
celd_normals_hinted (const CeldPlane *ink, const CeldPlane *levels, const CeldPlane *depth, const CeldPaint *hints,
                     const CeldSettings *settings, const CeldHost *host, CeldVectors *normals)
{
  if (!CELD_SAME_SIZE (ink, levels) || !CELD_SAME_SIZE (ink, normals) ||
      (depth && !is_view (depth->data, depth->width, depth->height, ink)) ||
      (hints && !is_view (hints->data, hints->width, hints->height, ink)))
    return CELD_BAD_SIZE;
  if (celd_settings_check (settings) != CELD_OK)
    return CELD_BAD_VALUE;

  CeldLumo   l = { .ink = ink, .depth = depth, .hints = hints, .settings = settings,
                   .width = ink->width, .height = ink->height };
  CeldHostPart   part[5];
  CeldHost   weighing = celd_host_part (&part[0], host, 0, 0.1), cutting = celd_host_part (&part[1], host, 0.1, 0.2);
  CeldHost   holding = celd_host_part (&part[2], host, 0.2, 0.3), solving = celd_host_part (&part[3], host, 0.3, 0.9);
  CeldHost   bevelling = celd_host_part (&part[4], host, 0.9, 1);
  CeldStatus status = weigh (&l, levels, &weighing);

  if (status == CELD_OK)
    status = celd_lumo_seams (&l, &cutting);
  if (status == CELD_OK)
    status = celd_lumo_outlines (&l, &holding);
  if (status == CELD_OK)
    status = celd_lumo_solve (&l, &solving);
  if (status == CELD_OK)
    status = celd_lumo_bevel (&l, &bevelling);
  if (status == CELD_OK)
    deliver (l.tilt, (double) settings->bulge, normals);
  celd_parts_clear (&l.regions);
  celd_free (l.level);
  celd_free (l.east);
  celd_free (l.south);
  celd_free (l.seam);
  celd_free (l.flat);
  celd_free (l.hold);
  celd_free (l.tilt);
  return status;
}

CeldStatus
celd_normals (const CeldPlane *ink, const CeldPlane *levels, const CeldSettings *settings, const CeldHost *host,
              CeldVectors *normals)
{
  return celd_normals_hinted (ink, levels, NULL, NULL, settings, host, normals);
}
