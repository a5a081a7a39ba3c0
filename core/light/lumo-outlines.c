/* Outlines: the constraints on normals.
 *
 * At a depth discontinuity the nearer region ends, so its normal lies in the picture plane and points outward.  The
 * farther region continues behind it and is not constrained, unless a painted hint says so.  Virtual contours neither
 * cut the surface nor constrain normals; nor do their ends, where they meet the ink of another contour: a discontinuity
 * counts only if no short detour leads around it.  A region without an outline of its own faces the viewer, so that the
 * paper stays flat behind a figure, even where a gap in the figure's contour connects the two.
 *
 * The direction of an outline comes from the first moment, under a Gaussian around the middle of the edge, of the
 * pixels that are at least as near: this averages out pixel steps, and continues the outline straight where it is
 * hidden.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "light/light.h"

#include <stdlib.h>

#define OUTLINE_RADIUS  7      /* pixels around an edge that give its direction (chosen) */
#define OUTLINE_DEVIATION 2.75   /* of the Gaussian, in pixels (chosen) */

typedef struct
{
  CeldLumo      *lumo;
  CeldPixelLinks links;
  uint8_t       *front, *behind;    /* of each region: whether it has an outline; whether it is behind one */
  double         gauss[2 * OUTLINE_RADIUS + 2][2 * OUTLINE_RADIUS + 2]; /* at distances of half pixels: [i] is i/2 */
} Outlines;

/* ------------------------------------------------------------------ directions */

static int
clamp (int x, int size)
{
  return x < 0 ? 0 : x < size ? x : size - 1;
}

/* The unit vector, y down, that points out of the region of level `near` at the edge from (x,y) to (x+east,y+south). */
static void
outward (const Outlines *o, float near, int x, int y, int east, int south, double *nx, double *ny)
{
  const CeldLumo *l = o->lumo;
  double          mx = 0, my = 0, length;

  for (int v = y - OUTLINE_RADIUS + south; v <= y + OUTLINE_RADIUS; v++)
    {
      const float *row = l->level + celd_lumo_pixel (l, 0, clamp (v, l->height));

      for (int u = x - OUTLINE_RADIUS + east; u <= x + OUTLINE_RADIUS; u++)
        if (row[clamp (u, l->width)] >= near)
          {
            int    du = 2 * (u - x) - east, dv = 2 * (v - y) - south; /* half pixels from the edge's middle */
            double weight = o->gauss[abs (du)][abs (dv)];

            mx += weight * du;
            my += weight * dv;
          }
    }
  length = hypot (mx, my);
  *nx    = length > 0 ? -mx / length : 0;
  *ny    = length > 0 ? -my / length : 0;
}

/* ------------------------------------------------------------------ constraints */

static CeldStatus
add_constraint (CeldLumo *l, size_t pixel, double x, double y)
{
  return celd_append (l->constraint, l->n_constraints, l->constraint_capacity,
                      (CeldNormalConstraint) { pixel, (float) x, (float) y });
}

static uint32_t
region_of (const CeldLumo *l, size_t pixel)
{
  return celd_lumo_component (l, &l->regions, pixel);
}

/* A depth discontinuity: constrains its nearer side, unless hints say otherwise. */
static CeldStatus
constrain_edge (Outlines *o, int x, int y, bool down)
{
  CeldLumo    *l = o->lumo;
  size_t       p = celd_lumo_pixel (l, x, y), q = p + (down ? (size_t) l->width : 1);
  size_t       near = l->level[p] > l->level[q] ? p : q, far = near == p ? q : p;
  CeldLumoHint over = CELD_UNPAINTED, under = CELD_UNPAINTED;
  double       nx, ny;
  CeldStatus   status = CELD_OK;

  if (celd_has_detour (&o->links, x, y, down))
    return CELD_OK;
  outward (o, l->level[near], x, y, !down, down, &nx, &ny);
  if (l->hints)
    {
      double mx = x + (down ? 0.5 : 1), my = y + (down ? 1 : 0.5);

      over  = celd_lumo_hint (l, mx, my, -nx, -ny);
      under = celd_lumo_hint (l, mx, my, nx, ny);
    }
  o->behind[region_of (l, far)] = 1;
  if (over != CELD_UNDER || under == CELD_BOTH)
    {
      o->front[region_of (l, near)] = 1;
      status = add_constraint (l, near, nx, -ny);
    }
  if (status == CELD_OK && (under == CELD_OVER || under == CELD_BOTH || over == CELD_BOTH))
    {
      o->front[region_of (l, far)] = 1;
      status = add_constraint (l, far, -nx, ny);
    }
  return status;
}

static CeldStatus
constrain_edges (Outlines *o, const CeldHost *host)
{
  CeldLumo  *l = o->lumo;
  CeldStatus status = CELD_OK;
  size_t     i = 0;

  for (int y = 0; y < l->height && status == CELD_OK; y++)
    {
      status = y % 16 ? CELD_OK : celd_progress (host, (double) y / l->height);
      for (int x = 0; x < l->width && status == CELD_OK; x++, i++)
        {
          if (x + 1 < l->width && l->east[i] <= 0 && !celd_lumo_same_level (l, i, i + 1))
            status = constrain_edge (o, x, y, false);
          if (status == CELD_OK && y + 1 < l->height && l->south[i] <= 0 &&
              !celd_lumo_same_level (l, i, i + (size_t) l->width))
            status = constrain_edge (o, x, y, true);
        }
    }
  return status;
}

static bool
is_open (const Outlines *o, const CeldCrease *crease)
{
  size_t w = (size_t) o->lumo->width;

  return celd_has_detour (&o->links, (int) (crease->pixel % w), (int) (crease->pixel / w), crease->down);
}

/* Creases that were painted count as outlines of their region. */
static void
mark_painted_creases (Outlines *o)
{
  for (size_t i = 0; i < o->lumo->n_creases; i++)
    if (o->lumo->crease[i].painted && !is_open (o, &o->lumo->crease[i]))
      o->front[region_of (o->lumo, o->lumo->crease[i].pixel)] = 1;
}

/* Constrains both sides of creases. */
static CeldStatus
constrain_creases (Outlines *o)
{
  CeldLumo  *l = o->lumo;
  CeldStatus status = CELD_OK;

  for (size_t i = 0; i < l->n_creases && status == CELD_OK; i++)
    {
      const CeldCrease *crease = &l->crease[i];
      size_t            p = crease->pixel, q = p + (crease->down ? (size_t) l->width : 1);

      if (l->flat[region_of (l, p)] || is_open (o, crease))
        continue;
      for (int side = 0; side < 2 && status == CELD_OK; side++)
        {
          float s = side ? -crease->strength[1] : crease->strength[0];

          if (crease->strength[side] > 0)
            status = add_constraint (l, side ? q : p, (double) (s * crease->x), (double) (-s * crease->y));
        }
    }
  return status;
}

/* Constrains the regions that are not flat along the edge of the picture. */
static CeldStatus
constrain_frame (CeldLumo *l)
{
  CeldStatus status = CELD_OK;

  for (int y = 0; y < l->height; y++)
    for (int x = 0; x < l->width; x += y > 0 && y + 1 < l->height && x == 0 && l->width > 1 ? l->width - 1 : 1)
      {
        size_t p = celd_lumo_pixel (l, x, y);

        if (l->flat[region_of (l, p)])
          continue;
        if (status == CELD_OK && (x == 0 || x + 1 == l->width))
          status = add_constraint (l, p, (x + 1 == l->width) - (x == 0), 0);
        if (status == CELD_OK && (y == 0 || y + 1 == l->height))
          status = add_constraint (l, p, 0, (y == 0) - (y + 1 == l->height));
      }
  return status;
}

/* ------------------------------------------------------------------ */

static CeldStatus
outlines_new (CeldLumo *l, Outlines *o)
{
  *o = (Outlines) { .lumo = l };
  o->front  = celd_alloc0 (l->regions.n + 1, 1);
  o->behind = celd_alloc0 (l->regions.n + 1, 1);
  if (!o->front || !o->behind || celd_pixel_links_new (l->width, l->height, l->east, l->south, &o->links) != CELD_OK)
    return CELD_NO_MEMORY;
  for (int i = 0; i < 2 * OUTLINE_RADIUS + 2; i++)
    for (int j = 0; j < 2 * OUTLINE_RADIUS + 2; j++)
      o->gauss[i][j] = exp (-0.125 * (i * i + j * j) / (OUTLINE_DEVIATION * OUTLINE_DEVIATION));
  return CELD_OK;
}

CeldStatus
celd_lumo_outlines (CeldLumo *l, const CeldHost *host)
{
  Outlines     o = { 0 };
  CeldHostPart part[2];
  CeldHost     finding = celd_host_part (&part[0], host, 0, 0.3), holding = celd_host_part (&part[1], host, 0.3, 1);
  CeldStatus   status = celd_run_components_find (l->width, l->height, l->level, NULL, NULL, &finding, &l->regions);

  if (status != CELD_OK)
    return status;
  l->flat = celd_alloc0 (l->regions.n + 1, 1);
  status  = l->flat ? outlines_new (l, &o) : CELD_NO_MEMORY;
  if (status == CELD_OK)
    status = constrain_edges (&o, &holding);
  if (status == CELD_OK)
    {
      mark_painted_creases (&o);
      for (size_t k = 0; k < l->regions.n; k++)
        l->flat[k] = o.behind[k] && !o.front[k];
      status = constrain_creases (&o);
    }
  if (status == CELD_OK && l->settings->frame_outline)
    status = constrain_frame (l);
  celd_pixel_links_clear (&o.links);
  celd_free (o.front);
  celd_free (o.behind);
  return status;
}
