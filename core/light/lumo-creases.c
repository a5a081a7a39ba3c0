/* Creases: strokes inside a region, such as wrinkles and folds, along which its surface may bend.
 *
 * By default they do not.  With settings->creases both sides of the stroke's middle bend away from it, like a seam of a
 * quilt, or only the higher side if smooth depth differs there; flat regions stay flat.  Painted hints take precedence,
 * as in [Joh02], also at outlines: white beside a line makes that side bend ("over"), black lets it continue ("under"),
 * grey bends both sides.
 *
 * The middle of a stroke is its medial axis: where the nearest paper changes from one side to the other.  Its direction
 * comes from the second moments of the ink under a Gaussian.  Ink wider than two strokes is an area and has none.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "image/image.h"
#include "light/light.h"

#define STROKE_RADIUS     5     /* pixels around an edge whose ink gives the direction (chosen) */
#define STROKE_DEVIATION    2.0   /* of the Gaussian, in pixels (chosen) */
#define LARGEST_COSINE      0.25  /* between the directions to the paper of both sides (chosen) */
#define SLIGHT    0.005f /* difference of depth that is ignored, as a share of its range (chosen) */
#define NEAR_LINE 3     /* pixels beyond the stroke within which hints count (chosen) */

typedef struct { CeldLumo *lumo; int32_t *nearest; float slight; } Creases;

/* A pixel of a stroke, or beside it, with the vector to its nearest paper and that pixel's index. */
typedef struct { int x, y, dx, dy; size_t paper; } Flank;

/* ------------------------------------------------------------------ hints */

CeldLumoHint
celd_lumo_hint (const CeldLumo *l, double x, double y, double dx, double dy)
{
  double reach = 1.5 * l->stroke + NEAR_LINE;

  for (double t = 0.5; t <= reach; t++)
    {
      double u = floor (x + t * dx), v = floor (y + t * dy);

      if (u < 0 || v < 0 || u >= l->width || v >= l->height)
        break;

      const uint8_t *rgba = CELD_RGBA (l->hints, (int) u, (int) v);
      int            sum = rgba[0] + rgba[1] + rgba[2];

      if (rgba[3] >= 128)
        return sum < 3 * 64 ? CELD_UNDER : sum < 3 * 192 ? CELD_BOTH : CELD_OVER;
    }
  return CELD_UNPAINTED;
}

/* ------------------------------------------------------------------ the middle of a stroke */

static Flank
flank_of (const Creases *s, int x, int y)
{
  const CeldLumo *l = s->lumo;
  size_t          paper = (size_t) s->nearest[celd_lumo_pixel (l, x, y)];

  return (Flank) { x, y, (int) (paper % (size_t) l->width) - x, (int) (paper / (size_t) l->width) - y, paper };
}

/* Whether two neighbours are on different sides of a stroke's middle.  If the stroke is one pixel wide, one of the two
 * may be paper. */
static bool
is_middle (const Creases *s, const Flank *p, const Flank *q)
{
  double a = hypot (p->dx, p->dy), b = hypot (q->dx, q->dy);
  size_t i = celd_lumo_pixel (s->lumo, p->x, p->y);

  if (!celd_lumo_same_level (s->lumo, i, p->paper) || !celd_lumo_same_level (s->lumo, i, q->paper) ||
      a > s->lumo->stroke + 1 || b > s->lumo->stroke + 1)
    return false;
  if (!(a > 0) && !(b > 0))
    return false;
  if (a > 0 && b > 0)
    return p->dx * q->dx + p->dy * q->dy < LARGEST_COSINE * a * b;
  return a > 0 ? p->dx * (q->x - p->x) + p->dy * (q->y - p->y) < 0 : q->dx * (p->x - q->x) + q->dy * (p->y - q->y) < 0;
}

/* The unit vector across the stroke midway between two pixels, towards the second one's side; y down. */
static void
across (const CeldLumo *l, const Flank *p, const Flank *q, double *nx, double *ny)
{
  double cx = 0.5 * (p->x + q->x), cy = 0.5 * (p->y + q->y), sum = 0, mx = 0, my = 0, xx = 0, xy = 0, yy = 0;
  double rx = q->x + q->dx - p->x - p->dx, ry = q->y + q->dy - p->y - p->dy, r = hypot (rx, ry), angle, dot;

  for (int y = p->y - STROKE_RADIUS; y <= p->y + STROKE_RADIUS; y++)
    for (int x = p->x - STROKE_RADIUS; x <= p->x + STROKE_RADIUS; x++)
      if (x >= 0 && y >= 0 && x < l->width && y < l->height && CELD_AT (l->ink, x, y) < 1)
        {
          double dx = x - cx, dy = y - cy;
          double weight = (1 - fmax (0, (double) CELD_AT (l->ink, x, y))) *
                          exp (-0.5 * (dx * dx + dy * dy) / (STROKE_DEVIATION * STROKE_DEVIATION));

          sum += weight;
          mx += weight * dx;
          my += weight * dy;
          xx += weight * dx * dx;
          xy += weight * dx * dy;
          yy += weight * dy * dy;
        }
  *nx = rx / r;
  *ny = ry / r;
  if (!(sum > 0))
    return;
  angle = 0.5 * atan2 (2 * (xy - mx * my / sum), xx - yy - (mx * mx - my * my) / sum); /* along the stroke */
  dot   = (-sin (angle) * rx + cos (angle) * ry) / r;
  if (fabs (dot) > 0.7)
    {
      *nx = dot > 0 ? -sin (angle) : sin (angle);
      *ny = dot > 0 ? cos (angle) : -cos (angle);
    }
}

/* ------------------------------------------------------------------ how much the sides bend */

/* Sets how much both sides bend; returns whether hints say so. */
static bool
strengths (const Creases *s, const Flank *p, const Flank *q, double nx, double ny, float strength[2])
{
  const CeldLumo *l = s->lumo;
  CeldLumoHint    side[2] = { CELD_UNPAINTED, CELD_UNPAINTED };
  double          mx = 0.5 * (p->x + q->x) + 0.5, my = 0.5 * (p->y + q->y) + 0.5;

  if (l->hints)
    {
      side[0] = celd_lumo_hint (l, mx, my, -nx, -ny);
      side[1] = celd_lumo_hint (l, mx, my, nx, ny);
    }
  if (side[0] != CELD_UNPAINTED || side[1] != CELD_UNPAINTED)
    {
      bool both = side[0] == CELD_BOTH || side[1] == CELD_BOTH;

      strength[0] = both || side[0] == CELD_OVER ? 1 : 0;
      strength[1] = both || side[1] == CELD_OVER ? 1 : 0;
      return true;
    }
  strength[0] = strength[1] = l->settings->creases;
  if (l->depth)
    {
      int   w = l->width;
      float a = CELD_AT (l->depth, (int) (p->paper % (size_t) w), (int) (p->paper / (size_t) w));
      float b = CELD_AT (l->depth, (int) (q->paper % (size_t) w), (int) (q->paper / (size_t) w));

      if (b - a > s->slight)
        strength[0] = 0;
      if (a - b > s->slight)
        strength[1] = 0;
    }
  return false;
}

static CeldStatus
look_at_edge (Creases *s, int x, int y, bool down)
{
  CeldLumo  *l = s->lumo;
  size_t     i = celd_lumo_pixel (l, x, y);
  Flank      p = flank_of (s, x, y), q = flank_of (s, x + !down, y + down);
  CeldCrease crease = { (uint32_t) i, down, false, 0, 0, { 0, 0 } };
  double     nx, ny;

  if (!is_middle (s, &p, &q))
    return CELD_OK;
  across (l, &p, &q, &nx, &ny);
  crease.painted = strengths (s, &p, &q, nx, ny, crease.strength);
  if (!(crease.strength[0] > 0) && !(crease.strength[1] > 0))
    return CELD_OK;
  crease.x  = (float) nx;
  crease.y  = (float) ny;
  return celd_append (l->crease, l->n_creases, l->crease_capacity, crease);
}

/* Considers all edges within one level that have ink at one end at least. */
static CeldStatus
find_creases (Creases *s, const CeldHost *host)
{
  CeldLumo  *l = s->lumo;
  CeldStatus status = CELD_OK;
  size_t     i = 0;

  for (int y = 0; y < l->height && status == CELD_OK; y++)
    {
      status = y % 64 ? CELD_OK : celd_progress (host, (double) y / l->height);
      for (int x = 0; x < l->width && status == CELD_OK; x++, i++)
        {
          bool ink = !celd_is_paper (CELD_AT (l->ink, x, y));

          if (x + 1 < l->width && (ink || !celd_is_paper (CELD_AT (l->ink, x + 1, y))) &&
              celd_lumo_same_level (l, i, i + 1))
            status = look_at_edge (s, x, y, false);
          if (status == CELD_OK && y + 1 < l->height && (ink || !celd_is_paper (CELD_AT (l->ink, x, y + 1))) &&
              celd_lumo_same_level (l, i, i + (size_t) l->width))
            status = look_at_edge (s, x, y, true);
        }
    }
  return status;
}

static void
cut (CeldLumo *l)
{
  for (size_t i = 0; i < l->n_creases; i++)
    (l->crease[i].down ? l->south : l->east)[l->crease[i].pixel] = 0;
}

static float
slight_difference (const CeldPlane *depth)
{
  float least, most;

  celd_level_range (depth, &least, &most);
  return SLIGHT * (most - least);
}

CeldStatus
celd_lumo_creases (CeldLumo *l, const CeldHost *host)
{
  size_t       n = (size_t) l->width * (size_t) l->height, i = 0;
  Creases      s = { .lumo = l };
  CeldHostPart part[2];
  CeldHost     measuring = celd_host_part (&part[0], host, 0, 0.5), finding = celd_host_part (&part[1], host, 0.5, 1);
  uint8_t     *paper = NULL;
  int32_t     *squared = NULL;
  bool         any = false;
  CeldStatus   status;

  if (!(l->settings->creases > 0) && !l->hints)
    return CELD_OK;
  paper     = celd_alloc (n, sizeof *paper);
  squared   = celd_alloc (n, sizeof *squared);
  s.nearest = celd_alloc (n, sizeof *s.nearest);
  status    = paper && squared && s.nearest ? CELD_OK : CELD_NO_MEMORY;
  if (status != CELD_OK)
    goto done;
  for (int y = 0; y < l->height; y++)
    for (int x = 0; x < l->width; x++)
      any = (paper[i++] = celd_is_paper (CELD_AT (l->ink, x, y))) || any;
  if (!any)
    goto done;
  s.slight = l->depth ? slight_difference (l->depth) : 0;
  status   = celd_nearest (l->width, l->height, paper, &measuring, squared, s.nearest);
  if (status == CELD_OK)
    status = find_creases (&s, &finding);
  if (status == CELD_OK)
    cut (l);

done:
  celd_free (paper);
  celd_free (squared);
  celd_free (s.nearest);
  return status;
}
