/* Normals of a rounded surface: Lumo [Joh02], with depth discontinuities (section 5 of the paper).
 *
 * At an outline the normal lies in the picture plane and points outward.  In between n_x and n_y are harmonic, each by
 * itself, and n_z follows from unit length.  On a disc that gives exactly a hemisphere, and on an ellipse nearly an
 * ellipsoid whose third half axis is the harmonic mean of the other two.
 *
 *   1. weights: where levels and ink cut the surface (depth/discontinuities.c)
 *   2. strokes inside a region, where they bend it (lumo-creases.c)
 *   3. what outlines constrain the normal to (lumo-outlines.c)
 *   4. normals in between, component by component (here, by depth/boxed-solver.c)
 *   5. flat again away from outlines, if a bevel is asked for (lumo-bevel.c)
 *
 *   [Joh02]  S. F. Johnston: Lumo: Illumination for Cel Animation.  NPAR 2002.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "depth/depth.h"
#include "image/image.h"
#include "light/lumo.h"

#include <math.h>

#define NORMAL_AT_OUTLINE  2.f  /* weight between a pixel and its outline: 1 / distance, half a pixel */
#define FLAT_WEIGHT      1.f  /* weight that draws a pixel of a flat region towards the viewer (chosen) */
#define NORMALS_TOLERANCE 2e-3 /* largest error of n_x and n_y as a share of their range: less than a step of 8 bits */

/* ------------------------------------------------------------------ weights */

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
  l->edges  = (CeldDepthEdges) { l->ink, threshold, celd_edge_radius (l->stroke) };
  celd_depth_levels (levels, l->level);
  return celd_depth_weights (l->ink, l->level, threshold, host, l->east, l->south);
}

/* ------------------------------------------------------------------ between outlines */

typedef struct
{
  CeldLumo         *lumo;
  CeldRunComponents components;  /* of what the weights connect */
  CeldRect         *bounds;      /* of each component that has a constraint; width 0 for the others */
} NormalsWork;

static bool
is_inside (const CeldRect *rect, int x, int y)
{
  return x >= rect->x && y >= rect->y && x < rect->x + rect->width && y < rect->y + rect->height;
}

/* Masked pixels of the box have no edges, so what is written for them does not matter. */
static double
write_box (const void *data, CeldBox *box)
{
  const CeldLumo *l = ((const NormalsWork *) data)->lumo;
  CeldRect        rect = box->rect;

  CELD_EACH_BOX_RUN (box, y, s)
    {
      size_t p = celd_lumo_pixel (l, s->x, y), i = celd_box_pixel (box, s->x, y), n = (size_t) (s->end - s->x);

      memcpy (box->east + i, l->east + p, n * sizeof *l->east);
      memcpy (box->south + i, l->south + p, n * sizeof *l->south);
    }
  CELD_EACH_RUN (&l->regions, rect.y, rect.y + rect.height, y, s)
    if (l->flat[s->component])
      for (int x = s->x > rect.x ? s->x : rect.x; x < s->end && x < rect.x + rect.width; x++)
        box->diagonal[celd_box_pixel (box, x, y)] = FLAT_WEIGHT;
  for (size_t k = 0; k < l->n_constraints; k++)
    {
      const CeldNormalConstraint *c = &l->constraint[k];
      int                         x = (int) (c->pixel % (size_t) l->width), y = (int) (c->pixel / (size_t) l->width);
      size_t                      i;

      if (!is_inside (&rect, x, y))
        continue;
      i = celd_box_pixel (box, x, y);
      box->diagonal[i]   += NORMAL_AT_OUTLINE;
      box->b[i]          += NORMAL_AT_OUTLINE * c->x;
      box->b[box->n + i] += NORMAL_AT_OUTLINE * c->y;
    }
  return NORMALS_TOLERANCE;
}

static void
read_box (void *data, const CeldBox *box, CeldSolve *solve)
{
  const CeldLumo *l = ((const NormalsWork *) data)->lumo;

  (void) solve;
  CELD_EACH_BOX_RUN (box, y, s)
    {
      float *tilt = l->tilt + 2 * celd_lumo_pixel (l, s->x, y);
      size_t i = celd_box_pixel (box, s->x, y);

      for (int x = s->x; x < s->end; x++, i++)
        {
          *tilt++ = box->x[i];
          *tilt++ = box->x[box->n + i];
        }
    }
}

static CeldStatus
find_bounds (NormalsWork *work)
{
  const CeldLumo          *l = work->lumo;
  const CeldRunComponents *c = &work->components;
  uint8_t                 *constrained = celd_alloc0 (c->n, 1);

  work->bounds = celd_alloc0 (c->n, sizeof *work->bounds);
  if (!constrained || !work->bounds)
    {
      celd_free (constrained);
      return CELD_NO_MEMORY;
    }
  for (size_t k = 0; k < l->n_constraints; k++)
    constrained[celd_lumo_component (l, c, l->constraint[k].pixel)] = 1;
  CELD_EACH_RUN (c, 0, l->height, y, s)
    if (constrained[s->component])
      celd_box_add_run (&work->bounds[s->component], s, y);
  celd_free (constrained);
  return CELD_OK;
}

/* Makes l->tilt.  Components without a constraint face the viewer. */
static CeldStatus
interpolate (CeldLumo *l, const CeldHost *host)
{
  NormalsWork  work = { .lumo = l };
  CeldSolve    solve;
  CeldHostPart part[2];
  CeldHost     finding = celd_host_part (&part[0], host, 0, 0.1), solving = celd_host_part (&part[1], host, 0.1, 1);
  CeldStatus   status = celd_run_components_find (l->width, l->height, l->level, NULL, &l->edges, &finding,
                                                  &work.components);

  if (status != CELD_OK)
    return status;
  l->tilt = celd_alloc0 ((size_t) l->width * (size_t) l->height, 2 * sizeof *l->tilt);
  status  = l->tilt ? find_bounds (&work) : CELD_NO_MEMORY;
  if (status == CELD_OK)
    {
      CeldBoxedSystem system = { &work.components, work.bounds, 2, write_box, read_box, &work };

      status = celd_boxed_solve (&system, &solving, &solve);
    }
  celd_run_components_clear (&work.components);
  celd_free (work.bounds);
  return status;
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

  CeldLumo     l = { .ink = ink, .depth = depth, .hints = hints, .settings = settings,
                     .width = ink->width, .height = ink->height };
  CeldHostPart part[5];
  CeldHost     weighing = celd_host_part (&part[0], host, 0, 0.1), cutting = celd_host_part (&part[1], host, 0.1, 0.2);
  CeldHost     holding = celd_host_part (&part[2], host, 0.2, 0.3), solving = celd_host_part (&part[3], host, 0.3, 0.9);
  CeldHost     bevelling = celd_host_part (&part[4], host, 0.9, 1);
  CeldStatus   status = weigh (&l, levels, &weighing);

  if (status == CELD_OK)
    status = celd_lumo_creases (&l, &cutting);
  if (status == CELD_OK)
    status = celd_lumo_outlines (&l, &holding);
  if (status == CELD_OK)
    status = interpolate (&l, &solving);
  if (status == CELD_OK)
    status = celd_lumo_bevel (&l, &bevelling);
  if (status == CELD_OK)
    deliver (l.tilt, (double) settings->bulge, normals);
  celd_run_components_clear (&l.regions);
  celd_free (l.level);
  celd_free (l.east);
  celd_free (l.south);
  celd_free (l.crease);
  celd_free (l.flat);
  celd_free (l.constraint);
  celd_free (l.tilt);
  return status;
}

CeldStatus
celd_normals (const CeldPlane *ink, const CeldPlane *levels, const CeldSettings *settings, const CeldHost *host,
              CeldVectors *normals)
{
  return celd_normals_hinted (ink, levels, NULL, NULL, settings, host, normals);
}
