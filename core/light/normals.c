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
 *   5. with a bevel: flat again farther away from outlines than its width (here).  Each pixel takes the nearest
 *      constraint of its neighbours [Dan80], but not across cuts, so that outlines of nearer regions do not bend what
 *      continues behind them.  Rows are swept down and up until nothing changes.
 *
 *   [Dan80]  P.-E. Danielsson: Euclidean Distance Mapping.  Computer Graphics and Image Processing 14, 1980.
 *   [Joh02]  S. F. Johnston: Lumo: Illumination for Cel Animation.  NPAR 2002.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "light/light.h"

#define NORMAL_AT_OUTLINE 2.f  /* weight between a pixel and its outline: 1 / distance, half a pixel */
#define FLAT_WEIGHT       1.f  /* weight that draws a pixel of a flat region towards the viewer (chosen) */
#define NORMALS_TOLERANCE 2e-3 /* largest error of n_x and n_y as a share of their range: less than a step of 8 bits */
#define MOST_SWEEPS       16   /* down and up (chosen: only spirals of more turns need more) */
#define NO_CONSTRAINT     UINT32_MAX

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

/* ------------------------------------------------------------------ bevels */

typedef struct { CeldLumo *lumo; uint32_t *nearest; int64_t far; bool changed; } Bevel;

static int64_t
squared (const Bevel *b, size_t pixel, uint32_t constraint)
{
  size_t  w = (size_t) b->lumo->width;
  int64_t dx = (int64_t) (pixel % w) - (int64_t) (constraint % w);
  int64_t dy = (int64_t) (pixel / w) - (int64_t) (constraint / w);

  return dx * dx + dy * dy;
}

/* Takes over the constraint of the neighbour `from` if it is nearer than the present one, and near enough to matter. */
static void
take (Bevel *b, size_t pixel, size_t from, float weight)
{
  uint32_t constraint = b->nearest[from];
  int64_t  distance;

  if (!(weight > 0) || constraint == NO_CONSTRAINT || constraint == b->nearest[pixel])
    return;
  distance = squared (b, pixel, constraint);
  if (distance > b->far || (b->nearest[pixel] != NO_CONSTRAINT && distance >= squared (b, pixel, b->nearest[pixel])))
    return;
  b->nearest[pixel] = constraint;
  b->changed        = true;
}

static void
pass_row (Bevel *b, int y, int from)
{
  const CeldLumo *l = b->lumo;
  size_t          w = (size_t) l->width, row = (size_t) y * w;

  if (from >= 0 && from < l->height)
    for (size_t x = 0; x < w; x++)
      take (b, row + x, (size_t) from * w + x, l->south[(size_t) (from < y ? from : y) * w + x]);
  for (size_t x = 1; x < w; x++)
    take (b, row + x, row + x - 1, l->east[row + x - 1]);
  for (size_t x = w - 1; x > 0; x--)
    take (b, row + x - 1, row + x, l->east[row + x - 1]);
}

static CeldStatus
spread (Bevel *b, const CeldHost *host)
{
  int        height = b->lumo->height;
  CeldStatus status = CELD_OK;

  b->changed = true;
  for (int round = 0; b->changed && round < MOST_SWEEPS && status == CELD_OK; round++)
    {
      b->changed = false;
      for (int y = 0; y < height; y++)
        pass_row (b, y, y - 1);
      for (int y = height - 1; y >= 0; y--)
        pass_row (b, y, y + 1);
      status = celd_progress (host, 1 - 1. / (round + 2));
    }
  return status;
}

static void
flatten (const Bevel *b, double width)
{
  size_t n = (size_t) b->lumo->width * (size_t) b->lumo->height;

  for (size_t i = 0; i < n; i++)
    {
      double t = 1, tilt;

      if (b->nearest[i] != NO_CONSTRAINT)
        t = fmin (1, (sqrt ((double) squared (b, i, b->nearest[i])) + 0.5) / width);
      tilt = 1 - t * t * (3 - 2 * t);
      b->lumo->tilt[2 * i]     *= (float) tilt;
      b->lumo->tilt[2 * i + 1] *= (float) tilt;
    }
}

/* Fades the tilt out with the distance from a region's own outlines, to nothing at settings->bevel times the picture's
 * diagonal; does nothing for a bevel of 0. */
static CeldStatus
flatten_inside (CeldLumo *l, const CeldHost *host)
{
  double     width = (double) l->settings->bevel * hypot (l->width, l->height);
  size_t     n = (size_t) l->width * (size_t) l->height;
  Bevel      b = { .lumo = l };
  CeldStatus status;

  if (!(l->settings->bevel > 0))
    return CELD_OK;
  b.nearest = celd_alloc (n, sizeof *b.nearest);
  if (!b.nearest)
    return CELD_NO_MEMORY;
  width = fmax (width, 1);
  b.far = (int64_t) (width * width) + 1;
  for (size_t i = 0; i < n; i++)
    b.nearest[i] = NO_CONSTRAINT;
  for (size_t k = 0; k < l->n_constraints; k++)
    b.nearest[l->constraint[k].pixel] = (uint32_t) l->constraint[k].pixel;
  status = spread (&b, host);
  if (status == CELD_OK)
    flatten (&b, width);
  celd_free (b.nearest);
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
    status = flatten_inside (&l, &bevelling);
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
