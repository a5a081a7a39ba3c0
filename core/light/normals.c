/* Normals of a rounded surface: Lumo [Joh02], with depth discontinuities (section 5 of the paper).
 *
 * At an outline the normal lies in the picture plane and points outward.  In between n_x and n_y are harmonic, each by
 * itself, and n_z follows from unit length.  On a disc that gives exactly a hemisphere, and on an ellipse nearly an
 * ellipsoid whose third half axis is the harmonic mean of the other two.
 *
 * That holds on whole sheets: what something nearer hides of a part is as round as what is seen of it.
 *
 *   1. weights: where levels, with ink or at a gap in it, cut the surface (depth/discontinuities.c, held-gaps.c)
 *   2. strokes inside a region, where they bend it (lumo-creases.c)
 *   3. bodies: surfaces of seen and hidden pixels (lumo-bodies.c)
 *   4. of each body, what its outline constrains the normal to (lumo-outlines.c), and normals in between (lumo-solve.c)
 *   5. with a bevel: flat again farther away from outlines than its width (lumo-bevel.c)
 *
 *   [Joh02]  S. F. Johnston: Lumo: Illumination for Cel Animation.  NPAR 2002.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "light/light.h"

/* ------------------------------------------------------------------ weights */

static CeldStatus
weigh (CeldLumo *l, const CeldPlane *borders, const CeldPlane *levels, const CeldHost *host)
{
  CeldHostPart part[2];
  CeldHost     holding = celd_host_part (&part[0], host, 0, 0.5), weighing = celd_host_part (&part[1], host, 0.5, 1);
  size_t       n = (size_t) l->width * (size_t) l->height;
  CeldStatus   status;

  l->level = celd_alloc (n, sizeof *l->level);
  l->east  = celd_alloc (n, sizeof *l->east);
  l->south = celd_alloc (n, sizeof *l->south);
  if (!l->level || !l->east || !l->south)
    return CELD_NO_MEMORY;
  l->stroke = celd_stroke_width (l->ink);
  celd_depth_levels (levels, l->level);
  status = celd_depth_edges (l->ink, borders, l->level, l->stroke, l->settings, &holding, &l->edges, &l->cut);
  return status == CELD_OK ? celd_depth_weights (&l->edges, l->level, &weighing, l->east, l->south) : status;
}

/* ------------------------------------------------------------------ the step */

/* Unit normals: n_z follows from unit length, and then the slope n_xy / n_z is scaled by the bulge. */
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

static bool
is_view (const void *data, int width, int height, const CeldPlane *ink)
{
  return data && width == ink->width && height == ink->height;
}

static void
lumo_clear (CeldLumo *l)
{
  celd_run_components_clear (&l->components);
  celd_lumo_bodies_clear (&l->bodies);
  celd_pixel_links_clear (&l->links);
  celd_free (l->level);
  celd_free (l->cut);
  celd_free (l->east);
  celd_free (l->south);
  celd_free (l->crease);
  celd_free (l->constraints.item);
  celd_free (l->tilt);
}

/* The label of the background, if anything else is there. */
static uint32_t
page_of (const CeldSheets *sheets)
{
  for (size_t k = 0; k < sheets->n; k++)
    if (sheets->item[k].page)
      return sheets->n > 1 ? sheets->item[k].label : 0;
  return 0;
}

CeldStatus
celd_normals_of_sheets (const CeldPlane *ink, const CeldPlane *borders, const CeldPlane *levels,
                        const CeldOwnership *own, const CeldSheets *sheets, const CeldPlane *depth,
                        const CeldPaint *hints, const CeldSettings *settings, const CeldHost *host,
                        CeldVectors *normals)
{
  CeldLumo     l = { .ink = ink, .own = own, .sheets = sheets, .depth = depth, .hints = hints, .settings = settings,
                     .width = ink->width, .height = ink->height, .page = page_of (sheets) };
  CeldHostPart part[5];
  CeldHost     weighing = celd_host_part (&part[0], host, 0, 0.1), cutting = celd_host_part (&part[1], host, 0.1, 0.2);
  CeldHost     joining = celd_host_part (&part[2], host, 0.2, 0.3), solving = celd_host_part (&part[3], host, 0.3, 0.9);
  CeldHost     bevelling = celd_host_part (&part[4], host, 0.9, 1);
  CeldStatus   status = weigh (&l, borders, levels, &weighing);

  if (status == CELD_OK)
    status = celd_lumo_creases (&l, &cutting);
  if (status == CELD_OK)
    status = celd_lumo_bodies (&l, &joining);
  if (status == CELD_OK)
    status = celd_lumo_solve (&l, &solving);
  if (status == CELD_OK)
    status = celd_lumo_bevel (&l, &bevelling);
  if (status == CELD_OK)
    deliver (l.tilt, (double) settings->bulge, normals);
  lumo_clear (&l);
  return status;
}

CeldStatus
celd_normals_hinted (const CeldPlane *ink, const CeldPlane *borders, const CeldPlane *levels, const CeldPlane *depth,
                     const CeldPaint *hints, const CeldSettings *settings, const CeldHost *host, CeldVectors *normals)
{
  if (!CELD_SAME_SIZE (ink, levels) || !CELD_SAME_SIZE (ink, normals) ||
      (borders && !is_view (borders->data, borders->width, borders->height, ink)) ||
      (depth && !is_view (depth->data, depth->width, depth->height, ink)) ||
      (hints && !is_view (hints->data, hints->width, hints->height, ink)))
    return CELD_BAD_SIZE;
  if (celd_settings_check (settings) != CELD_OK)
    return CELD_BAD_VALUE;

  CeldLevelOwnership made;
  CeldSheets        *sheets = NULL;
  CeldHostPart       part[2];
  CeldHost           first = celd_host_part (&part[0], host, 0, 0.3), second = celd_host_part (&part[1], host, 0.3, 1);
  CeldStatus         status = celd_expanded_ownership_new (ink, levels, &made);

  if (status == CELD_OK)
    status = celd_level_sheets (&made, ink, settings, &first, &sheets);
  if (status == CELD_OK)
    status = celd_normals_of_sheets (ink, borders, levels, &made.own, sheets, depth, hints, settings, &second,
                                     normals);
  celd_sheets_free (sheets);
  celd_level_ownership_clear (&made);
  return status;
}

CeldStatus
celd_normals (const CeldPlane *ink, const CeldPlane *levels, const CeldSettings *settings, const CeldHost *host,
              CeldVectors *normals)
{
  return celd_normals_hinted (ink, NULL, levels, NULL, NULL, settings, host, normals);
}
