/* Gaps closed as a person would close them.
 *
 * Where labels meet on paper, the cut of a 4-connected grid is a staircase, and boundaries of basins wobble.  Each such
 * boundary is redrawn as a curve from line end to line end; if something stands in the way, as a straight line; else it
 * stays as it is.
 *
 * The curve is a cubic Hermite segment between two tips.  A circular arc that meets its chord at the angle a has
 * tangents of length chord / cos^2 (a/2) in Hermite form.  People draw such guesses flatter, and small angles are as
 * likely an irregularity of the line as its direction, so the tangents are shortened.  Lines that leave the chord at a
 * large angle, or that would bend the curve into an S, do not continue each other: then the curve becomes straight, as
 * it is between ends without a direction.
 *
 * Cost: the length of the boundaries, and the ink a few stroke widths round their ends.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "segment/closures.h"
#include "segment/task.h"

#include <math.h>
#include <stdlib.h>

#define DAMPING          0.7  /* factor of the length of tangents (chosen, as all of these) */
#define WOBBLE           0.28 /* radians: an angle of this size counts half */
#define TRUSTED          1.05 /* radians off the chord: up to here, 60 degrees, an angle is followed */
#define MOST_ANGLE       1.4  /* from here on it is not: 80 degrees */
#define MOST_S           0.5  /* radians: the smaller of two angles that make an S may be this large */
#define SPACING          3.0  /* pixels between places of the polyline */
#define BRIDGE_MARGIN    3    /* pixels between the end of a bridge and that of a boundary along it, at most */
#define SHORTEST_CLOSURE 0.75 /* pixels: shorter closures are not listed */

/* ------------------------------------------------------------------ the curve */

/* 1 up to `trusted`, falling to 0 at `most`. */
static double
fade (double value, double trusted, double most)
{
  return value <= trusted ? 1 : value >= most ? 0 : (most - value) / (most - trusted);
}

/* The angle by which the line's direction at a tip turns right off the chord, in radians; 0 without a tip. */
static double
angle_off (const CeldLineEnd *end, double chord_x, double chord_y)
{
  return end->tip ? atan2 (chord_x * end->dy - chord_y * end->dx, chord_x * end->dx + chord_y * end->dy) : 0;
}

static double
tangent_length (double angle, double length)
{
  return DAMPING * angle * angle / (angle * angle + WOBBLE * WOBBLE) * length / pow (cos (angle / 2), 2);
}

size_t
celd_curve_draw (const CeldLineEnd *from, const CeldLineEnd *to, CeldPlace place[CELD_CURVE_PLACES])
{
  CeldPlace p = from->at, q = to->at;
  double    x = q.x - p.x, y = q.y - p.y, length = sqrt (x * x + y * y);
  double    a = angle_off (from, x, y), b = angle_off (to, -x, -y), trust, m, n;
  size_t    last = (size_t) fmin (CELD_CURVE_PLACES - 1, ceil (length / SPACING));

  trust = fade (fmax (fabs (a), fabs (b)), TRUSTED, MOST_ANGLE);
  if (a * b > 0) /* in an S both ends turn to the same side as seen from them */
    trust *= fade (fmin (fabs (a), fabs (b)), 0, MOST_S);
  if (trust <= 0 || last < 2 || (!from->tip && !to->tip))
    {
      place[0] = p;
      place[1] = q;
      return 2;
    }
  m = trust * tangent_length (a, length);
  n = trust * tangent_length (b, length);
  for (size_t i = 0; i <= last; i++)
    {
      double t = (double) i / (double) last, s = 1 - t;
      double h = t * t * (3 - 2 * t), g = t * s * s * m, k = t * t * s * n;

      place[i] = (CeldPlace) { p.x + h * x + g * from->dx + k * to->dx, p.y + h * y + g * from->dy + k * to->dy };
    }
  return last + 1;
}

/* ------------------------------------------------------------------ gaps of a labelling */

static CeldStatus
add_closure (const CeldChain *chain, const CeldPlace *place, size_t n, CeldClosures *closures)
{
  CeldPlace *copy = celd_alloc (n, sizeof *copy);
  CeldStatus status;

  if (!copy)
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < n; i++)
    copy[i] = place[i];
  status = celd_append_uncounted (closures->item, closures->n, (CeldClosure) { copy, n, chain->left, chain->right });
  if (status != CELD_OK)
    celd_free (copy);
  return status;
}

/* Adds the old boundary, reduced to its bends. */
static CeldStatus
add_old (const CeldChain *chain, const CeldCorner *corner, CeldClosures *closures)
{
  CeldPlace *place = celd_alloc (chain->n, sizeof *place);
  size_t     n = 0;
  CeldStatus status = place ? CELD_OK : CELD_NO_MEMORY;

  for (size_t i = 0; i < chain->n && place; i++)
    if (i == 0 || i + 1 == chain->n || corner[i + 1].x - corner[i].x != corner[i].x - corner[i - 1].x ||
        corner[i + 1].y - corner[i].y != corner[i].y - corner[i - 1].y)
      place[n++] = (CeldPlace) { corner[i].x, corner[i].y };
  if (status == CELD_OK)
    status = add_closure (chain, place, n, closures);
  celd_free (place);
  return status;
}

static bool
begins_at (CeldCorner corner, CeldBridgePixel pixel)
{
  return abs (pixel.x - corner.x) <= BRIDGE_MARGIN && abs (pixel.y - corner.y) <= BRIDGE_MARGIN;
}

/* A boundary along a bridge ends where that does.  Stubs that are shorter than they are wide have no direction of their
 * own in the ink around them. */
static void
take_bridge_ends (CeldRedrawing *r, CeldCorner first, CeldCorner last)
{
  const CeldBridges *all = r->task->bridges;

  for (size_t i = 0; all && i < all->n; i++)
    {
      const CeldBridge *bridge = &all->item[i];
      CeldBridgePixel   p = all->pixel[bridge->first], q = all->pixel[bridge->first + bridge->n - 1];
      bool              along = begins_at (first, p) && begins_at (last, q);

      if (bridge->ahead || (!along && !(begins_at (first, q) && begins_at (last, p))))
        continue;
      for (int k = 0; k < 2; k++)
        if (!r->end[k].tip)
          celd_line_end_set_tip (&bridge->end[along ? k : 1 - k], &r->end[k]);
      break;
    }
}

/* Examines both ends of a chain, and sets where the curve starts and ends. */
static void
find_ends (CeldRedrawing *r, const CeldChain *chain, const CeldCorner *corner)
{
  CeldLineEnd *a = &r->end[0], *b = &r->end[1];

  for (int k = 0; k < 2; k++)
    if (chain->end[k] == CELD_CHAIN_INK)
      celd_line_end_fit (r->task->ink, chain->ink[k], &r->end[k]);
    else
      celd_line_end_set_corner (corner[k ? chain->n - 1 : 0], &r->end[k]);
  if (a->n && b->n && (!a->tip || !b->tip))
    take_bridge_ends (r, corner[0], corner[chain->n - 1]);
  if (b->n && !b->tip)
    celd_line_end_aim (r->task->ink, a, b);
  if (a->n && !a->tip)
    celd_line_end_aim (r->task->ink, b, a);
  if (!a->n || !b->n)
    a->tip = b->tip = false;   /* a boundary may meet the frame or another one in any direction */
}

/* Does the boundary cross white paper, rather than follow a faint line? */
static bool
is_white (const CeldPlane *ink, const CeldChain *chain, const CeldCorner *corner)
{
  for (size_t i = 0; i + 1 < chain->n; i++)
    {
      int  x = corner[i].x < corner[i + 1].x ? corner[i].x : corner[i + 1].x;
      int  y = corner[i].y < corner[i + 1].y ? corner[i].y : corner[i + 1].y;
      bool south = corner[i].y == corner[i + 1].y;

      if (!(CELD_AT (ink, x, y) < CELD_FAINT_INK) && !(CELD_AT (ink, x - !south, y - south) < CELD_FAINT_INK))
        return true;
    }
  return false;
}

/* Tries the curve, a straight line between the same ends, and a straight line between the ends of the chain. */
static CeldStatus
close_chain (CeldRedrawing *r, const CeldChain *chain, CeldClosures *closures)
{
  const CeldCorner *corner = &r->chains->corner[chain->first];
  CeldClosureCurve  curve = { .n = 0 };
  bool              done = false;
  CeldStatus        status = CELD_OK;

  if (chain->end[0] == CELD_CHAIN_LOOP || !is_white (r->task->ink, chain, corner))
    return CELD_OK;
  find_ends (r, chain, corner);
  curve.n = celd_curve_draw (&r->end[0], &r->end[1], curve.place);
  for (int attempt = 0; attempt < 3 && !done && status == CELD_OK; attempt++)
    {
      if (attempt)
        {
          curve.place[1] = curve.place[curve.n - 1];
          curve.n        = 2;
          curve.straight = attempt == 2;
        }
      for (int k = 0; k < 2 && curve.straight; k++)
        {
          CeldCorner end = corner[k ? chain->n - 1 : 0];

          curve.place[k] = (CeldPlace) { end.x, end.y };
        }
      status = celd_boundary_redraw (r, chain, &curve, &done);
    }
  if (status != CELD_OK)
    return status;
  if (!done)
    return add_old (chain, corner, closures);
  if (celd_distance_between (curve.place[0], curve.place[curve.n - 1]) < SHORTEST_CLOSURE)
    return CELD_OK; /* from a tip to itself */
  return add_closure (chain, curve.place, curve.n, closures);
}

CeldStatus
celd_closures_find (const CeldSegmentTask *task, const uint32_t *label, const CeldLabels *labels,
                    const CeldPatches *windows, const CeldHost *host, CeldClosures *closures, CeldPatches *patches)
{
  CeldChains    chains;
  CeldRedrawing redrawing = { .task = task, .labels = labels, .chains = &chains };
  CeldClosures  found = { 0 };
  CeldStatus    status = celd_chains_find (task, label, labels, windows, &chains);

  for (int k = 0; k < 2 && status == CELD_OK; k++)
    status = celd_line_end_new (task->basins->stroke, &redrawing.end[k]);
  for (size_t i = 0; i < chains.n && status == CELD_OK; i++)
    {
      status = celd_progress (host, (double) i / (double) chains.n);
      if (status == CELD_OK)
        status = close_chain (&redrawing, &chains.item[i], &found);
    }
  if (status == CELD_OK)
    {
      *closures = found;
      *patches  = redrawing.patches;
      redrawing.patches = (CeldPatches) { 0 };
    }
  else
    celd_closures_clear (&found);
  celd_redrawing_clear (&redrawing);
  celd_chains_clear (&chains);
  return status;
}

/* ------------------------------------------------------------------ closures as a picture, to be looked at */

/* The distance of a place from the line segment between two others. */
static double
distance_to_segment (CeldPlace place, CeldPlace p, CeldPlace q)
{
  double x = q.x - p.x, y = q.y - p.y, square = x * x + y * y;
  double t = square > 0 ? ((place.x - p.x) * x + (place.y - p.y) * y) / square : 0;

  t = t < 0 ? 0 : t > 1 ? 1 : t;
  return celd_distance_between (place, (CeldPlace) { p.x + t * x, p.y + t * y });
}

/* Blends red of this opacity over a pixel. */
static void
blend (uint8_t *rgba, double opacity)
{
  static const double red[3] = { 255, 0, 0 };
  double              below = rgba[3] / 255.0 * (1 - opacity), alpha = opacity + below;

  for (int k = 0; k < 3; k++)
    rgba[k] = (uint8_t) lround ((opacity * red[k] + below * rgba[k]) / alpha);
  rgba[3] = (uint8_t) lround (255 * alpha);
}

/* Paints a segment.  A pixel belongs to the nearest segment, so it is painted once where two meet. */
static void
paint_segment (const CeldClosure *closure, size_t i, double width, CeldPaint *paint)
{
  const CeldPlace *place = closure->place;
  double           radius = width / 2 + 0.5;
  int              left = (int) fmax (floor (fmin (place[i].x, place[i + 1].x) - radius), 0);
  int              top = (int) fmax (floor (fmin (place[i].y, place[i + 1].y) - radius), 0);
  int              right = (int) fmin (ceil (fmax (place[i].x, place[i + 1].x) + radius), paint->width);
  int              bottom = (int) fmin (ceil (fmax (place[i].y, place[i + 1].y) + radius), paint->height);

  for (int y = top; y < bottom; y++)
    for (int x = left; x < right; x++)
      {
        CeldPlace centre = { x + 0.5, y + 0.5 };
        double    off = distance_to_segment (centre, place[i], place[i + 1]);
        double    opacity = fmin (radius - off, fmin (width, 1));

        if (opacity <= 0 || (i && distance_to_segment (centre, place[i - 1], place[i]) <= off) ||
            (i + 2 < closure->n && distance_to_segment (centre, place[i + 1], place[i + 2]) < off))
          continue;
        blend (CELD_RGBA (paint, x, y), opacity);
      }
}

void
celd_closures_paint (const CeldClosures *closures, double width, CeldPaint *paint)
{
  for (size_t k = 0; k < closures->n; k++)
    for (size_t i = 0; i + 1 < closures->item[k].n; i++)
      paint_segment (&closures->item[k], i, width, paint);
}
