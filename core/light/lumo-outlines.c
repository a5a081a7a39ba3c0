/* Outlines: the weights and constraints of a body.
 *
 * Along its outline, seen or hidden, the normal of a body lies in the picture plane and points outward.  Where
 * something nearer hides how a body goes on, its seen and hidden pixels are connected.  The background has no outline:
 * it faces the viewer, also where a gap in a contour connects it with a figure.  Painted hints say otherwise, as in
 * [Joh02].
 *
 * Where a body meets itself at a depth discontinuity, as a spiral does, only its nearer side bends.  Virtual contours
 * neither cut the surface nor constrain normals; nor do their ends, where they meet the ink of another contour: a
 * discontinuity counts only if no short detour leads around it.
 *
 * The direction of an outline comes from the first moment, under a Gaussian around the middle of the edge, of the
 * pixels of the body: this averages out pixel steps.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "light/light.h"

#include <stdlib.h>

#define OUTLINE_RADIUS    7    /* pixels around an edge that give its direction (chosen) */
#define OUTLINE_DEVIATION 2.75 /* of the Gaussian, in pixels (chosen) */

typedef struct
{
  CeldBody              *body;
  CeldNormalConstraints *seen, *hidden;
  double                 gauss[2 * OUTLINE_RADIUS + 2][2 * OUTLINE_RADIUS + 2]; /* at distances of half pixels: [i] is
                                                                                 * i/2 */
} Outlines;

/* A pixel of the body, and a neighbour of it. */
typedef struct { int x, y, dx, dy; } Edge;

typedef struct { double x, y; } Direction;

/* ------------------------------------------------------------------ directions */

static int
clamp (int x, int size)
{
  return x < 0 ? 0 : x < size ? x : size - 1;
}

/* The unit vector, y down, that points out of the body at the edge; with `near` out of its pixels of that level or
 * nearer ones. */
static Direction
outward (const Outlines *o, Edge e, const float *near)
{
  const CeldLumo *l = o->body->lumo;
  int             x = e.dx < 0 ? e.x - 1 : e.x, y = e.dy < 0 ? e.y - 1 : e.y, east = e.dx != 0, south = e.dy != 0;
  double          mx = 0, my = 0, length;

  for (int v = y - OUTLINE_RADIUS + south; v <= y + OUTLINE_RADIUS; v++)
    for (int u = x - OUTLINE_RADIUS + east, py = clamp (v, l->height); u <= x + OUTLINE_RADIUS; u++)
      {
        int px = clamp (u, l->width);

        if (near ? l->level[celd_lumo_pixel (l, px, py)] >= *near : celd_body_kind (o->body, px, py) != CELD_ELSEWHERE)
          {
            int    du = 2 * (u - x) - east, dv = 2 * (v - y) - south; /* half pixels from the edge's middle */
            double weight = o->gauss[abs (du)][abs (dv)];

            mx += weight * du;
            my += weight * dv;
          }
      }
  length = hypot (mx, my);
  return length > 0 ? (Direction) { -mx / length, -my / length } : (Direction) { 0, 0 };
}

/* ------------------------------------------------------------------ edges */

static uint8_t
kind_across (const Outlines *o, Edge e)
{
  return celd_body_kind (o->body, e.x + e.dx, e.y + e.dy);
}

/* Draws the normal of the edge's pixel in a direction, y down. */
static CeldStatus
constrain (const Outlines *o, Edge e, Direction d)
{
  bool                   seen = celd_body_kind (o->body, e.x, e.y) == CELD_SEEN;
  CeldNormalConstraints *list = seen ? o->seen : o->hidden;

  return celd_append (list->item, list->n, list->capacity,
                      (CeldNormalConstraint) { celd_lumo_pixel (o->body->lumo, e.x, e.y), (float) d.x, (float) -d.y });
}

static bool
is_page (const CeldLumo *l, int x, int y)
{
  return celd_larger_label (l->own, x, y) == l->page;
}

/* The weight of depth between two pixels of the picture. */
static float
weight_of (const CeldLumo *l, Edge e)
{
  size_t first = celd_lumo_pixel (l, e.dx < 0 ? e.x - 1 : e.x, e.dy < 0 ? e.y - 1 : e.y);

  return e.dx ? l->east[first] : l->south[first];
}

static bool
has_detour (const CeldLumo *l, Edge e)
{
  return celd_has_detour (&l->links, e.dx < 0 ? e.x - 1 : e.x, e.dy < 0 ? e.y - 1 : e.y, e.dy != 0);
}

/* What hints make of an outline between a seen pixel and another level: whether they say anything, and whether the
 * pixel bends. */
static bool
is_hinted (const Outlines *o, Edge e, Direction out, bool *bends)
{
  const CeldLumo *l = o->body->lumo;
  double          mx = e.x + 0.5 + 0.5 * e.dx, my = e.y + 0.5 + 0.5 * e.dy;
  CeldLumoHint    here = celd_lumo_hint (l, mx, my, -out.x, -out.y), across = celd_lumo_hint (l, mx, my, out.x, out.y);

  if (here == CELD_UNPAINTED && across == CELD_UNPAINTED)
    return false;
  *bends = here == CELD_OVER || here == CELD_BOTH || across == CELD_BOTH;
  if (here == CELD_UNPAINTED && across != CELD_BOTH) /* the other side does as it is told, this one as ever */
    return false;
  return true;
}

/* A seen pixel beside another level. */
static CeldStatus
meet_level (Outlines *o, Edge e, float *weight)
{
  const CeldLumo *l = o->body->lumo;
  size_t          p = celd_lumo_pixel (l, e.x, e.y), q = celd_lumo_pixel (l, e.x + e.dx, e.y + e.dy);
  bool            near = l->level[p] > l->level[q], bends;
  uint8_t         across = kind_across (o, e);
  Direction       out;

  if (l->hints)
    {
      out = outward (o, e, near ? &l->level[p] : &l->level[q]);
      out = near ? out : (Direction) { -out.x, -out.y };
      if (is_hinted (o, e, out, &bends))
        {
          *weight = 0;
          o->body->page_bends = o->body->page_bends || (bends && is_page (l, e.x, e.y));
          return bends ? constrain (o, e, out) : CELD_OK;
        }
    }
  *weight = across == CELD_HIDDEN_PART;
  if (across == CELD_HIDDEN_PART || (across == CELD_SEEN && !near) || is_page (l, e.x, e.y))
    return CELD_OK;
  return constrain (o, e, outward (o, e, across == CELD_SEEN ? &l->level[p] : NULL));
}

/* Looks at an edge from one of its pixels, which is of the body; sets its weight. */
static CeldStatus
look_at_edge (Outlines *o, Edge e, float *weight)
{
  const CeldLumo *l = o->body->lumo;
  uint8_t         here = celd_body_kind (o->body, e.x, e.y), across = kind_across (o, e);
  int             x = e.x + e.dx, y = e.y + e.dy;

  *weight = 0;
  if (x < 0 || y < 0 || x >= l->width || y >= l->height)
    return l->settings->frame_outline && !(here == CELD_SEEN && is_page (l, e.x, e.y))
             ? constrain (o, e, (Direction) { e.dx, e.dy }) : CELD_OK;
  if (here == CELD_SEEN && weight_of (l, e) > 0)
    *weight = weight_of (l, e);
  else if (here == CELD_SEEN && celd_lumo_same_level (l, celd_lumo_pixel (l, e.x, e.y), celd_lumo_pixel (l, x, y)))
    return CELD_OK; /* a crease */
  else if (here == CELD_SEEN)
    return has_detour (l, e) ? CELD_OK : meet_level (o, e, weight);
  else if (across == CELD_ELSEWHERE)
    return constrain (o, e, outward (o, e, NULL));
  else
    *weight = 1;
  return CELD_OK;
}

/* ------------------------------------------------------------------ */

/* An edge between a seen and a hidden pixel has the weight that the seen one gives it. */
static void
set_weight (const Outlines *o, Edge e, float weight)
{
  const CeldBody *b = o->body;
  size_t          first = (size_t) (e.y - b->box.y - (e.dy < 0)) * b->stride +
                          (size_t) (e.x - b->box.x - (e.dx < 0));
  float          *plane = e.dx ? b->east : b->south;

  if (kind_across (o, e) == CELD_ELSEWHERE)
    return;
  if (celd_body_kind (b, e.x, e.y) == CELD_SEEN || kind_across (o, e) == CELD_HIDDEN_PART)
    plane[first] = weight;
}

/* Gives a pixel of the body that is cut on no side the weights of its edges; false for any other one. */
static bool
is_smooth (const Outlines *o, int x, int y)
{
  const CeldBody *b = o->body;
  const CeldLumo *l = b->lumo;
  size_t          p = celd_lumo_pixel (l, x, y), w = (size_t) l->width;
  size_t          i = (size_t) (y - b->box.y) * b->stride + (size_t) (x - b->box.x);
  const uint8_t  *kind = b->kind + i;

  if (x == b->box.x || y == b->box.y || x + 1 == b->box.x + b->box.width || y + 1 == b->box.y + b->box.height)
    return false;
  if (*kind == CELD_SEEN)
    {
      if (!(l->east[p] > 0 && l->east[p - 1] > 0 && l->south[p] > 0 && l->south[p - w] > 0))
        return false;
      b->east[i]  = l->east[p];
      b->south[i] = l->south[p];
      return true;
    }
  if (kind[1] != CELD_HIDDEN_PART || kind[-1] != CELD_HIDDEN_PART || kind[b->stride] != CELD_HIDDEN_PART ||
      *(kind - b->stride) != CELD_HIDDEN_PART)
    return false;
  b->east[i] = b->south[i] = 1;
  return true;
}

/* Looks at all edges of a pixel of the body. */
static CeldStatus
look_at_pixel (Outlines *o, int x, int y)
{
  static const int step[4][2] = { { 1, 0 }, { 0, 1 }, { -1, 0 }, { 0, -1 } };
  CeldStatus       status = CELD_OK;

  for (int k = 0; k < 4 && status == CELD_OK; k++)
    {
      Edge  e = { x, y, step[k][0], step[k][1] };
      float weight;

      status = look_at_edge (o, e, &weight);
      set_weight (o, e, weight);
    }
  return status;
}

CeldStatus
celd_body_outlines (CeldBody *body, CeldNormalConstraints *seen, CeldNormalConstraints *hidden)
{
  CeldRect       box = body->box;
  Outlines       o = { .body = body, .seen = seen, .hidden = hidden };
  CeldStatus     status = CELD_OK;

  for (int i = 0; i < 2 * OUTLINE_RADIUS + 2; i++)
    for (int j = 0; j < 2 * OUTLINE_RADIUS + 2; j++)
      o.gauss[i][j] = exp (-0.125 * (i * i + j * j) / (OUTLINE_DEVIATION * OUTLINE_DEVIATION));
  for (int y = box.y; y < box.y + box.height && status == CELD_OK; y++)
    {
      const uint8_t *kind = body->kind + (size_t) (y - box.y) * body->stride;

      for (int x = box.x; x < box.x + box.width && status == CELD_OK; x++, kind++)
        if (*kind != CELD_ELSEWHERE && !is_smooth (&o, x, y))
          status = look_at_pixel (&o, x, y);
    }
  return status;
}
