/* Arrowheads: which end of a stroke is the tail, and which the tip?
 *
 * A stroke is followed from each of its extremities.  One of them is the tail if the stroke keeps the width w of its
 * shaft up to a head: a part that is wider on both sides, with lines from its tip back to both barbs and no paint
 * beside them.  What is between the lines does not matter, so that open and filled heads are found alike.  The
 * tolerances allow for antialiasing, unsteady hands and curved shafts.  If two extremities look like tails of different
 * arrows, or none does, the stroke has no clear arrowhead.  A dot at the end of a shaft is found in the same way, with
 * a filled disc in place of the lines.
 *
 * Ratios without a unit were chosen so that painted and random arrows are read and other strokes are not.
 *
 * Cost: four passes over the pixels of a stroke, and some twenty for each of its ends.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/arrows.h"

#include <math.h>

#define EXTREMITIES    4   /* tail, tip and two barbs */
#define LEAST_COSINE   0.7 /* of the angle between the shaft's end and the head's axis; chosen */
#define EVEN_WIDTH     2.2 /* largest ratio of widths along a shaft, because pens start thin; chosen */
#define THICK_START    1.4 /* largest ratio of the width near the tail to that in the middle: more is a head; chosen */
#define SHORTEST_SHAFT 6   /* pixels; chosen */
#define LEAST_SHAFT    1.5 /* widths; chosen */
#define AXIS_ROUNDS    3   /* iterations in which the axis is turned towards the tip; chosen */
#define LARGE_HEAD     10  /* widths of the shaft: barbs that are longer, ... */
#define MOST_HEAD      0.6 /* ... and longer than this part of the arrow, are arrows that meet at its tip; chosen */

/* The pixels of a stroke at a distance of `from` or more, in coordinates along an axis: s forwards, v sideways (left of
 * the axis is positive). */
typedef struct { CeldPoint origin, axis; double from; } View;

/* The extent of pixels in a view: range of s; largest and least v, and s of the pixels that have them; their number. */
typedef struct { double least_s, most_s, left, right, left_s, right_s; size_t n; } Extent;

static CeldPoint
direction (CeldPoint from, CeldPoint to)
{
  double length = hypot (to.x - from.x, to.y - from.y);

  return length > 0 ? (CeldPoint) { (to.x - from.x) / length, (to.y - from.y) / length } : (CeldPoint) { 0, 0 };
}

static double
forwards (const View *view, CeldPoint p)
{
  return (p.x - view->origin.x) * view->axis.x + (p.y - view->origin.y) * view->axis.y;
}

static double
sideways (const View *view, CeldPoint p)
{
  return (p.y - view->origin.y) * view->axis.x - (p.x - view->origin.x) * view->axis.y;
}

/* The point s forwards and v sideways. */
static CeldPoint
view_point (const View *view, double s, double v)
{
  CeldPoint o = view->origin, a = view->axis;

  return (CeldPoint) { o.x + s * a.x - v * a.y, o.y + s * a.y + v * a.x };
}

/* The extent between two values of s. */
static Extent
extent_between (const CeldArrowStroke *stroke, const View *view, double from, double to)
{
  Extent e = { .least_s = INFINITY, .most_s = -INFINITY, .left = -INFINITY, .right = INFINITY };

  for (size_t i = 0; i < stroke->n; i++)
    {
      CeldPoint p = celd_stroke_point (stroke, stroke->pixel[i]);
      double    s = forwards (view, p), v = sideways (view, p);

      if (stroke->distance[stroke->pixel[i]] < view->from || s < from || s > to)
        continue;
      e.n++;
      e.least_s = fmin (e.least_s, s);
      e.most_s  = fmax (e.most_s, s);
      if (v > e.left)
        {
          e.left   = v;
          e.left_s = s;
        }
      if (v < e.right)
        {
          e.right   = v;
          e.right_s = s;
        }
    }
  return e;
}

static double
breadth_at (const CeldArrowStroke *stroke, const View *view, double s)
{
  Extent e = extent_between (stroke, view, s - 0.75, s + 0.75);

  return e.n ? e.left - e.right + 1 : 0;
}

/* The centroid of the pixels within half a pixel of most_s. */
static CeldPoint
foremost (const CeldArrowStroke *stroke, const View *view, double most_s)
{
  CeldPoint sum = { 0, 0 };
  double    n   = 0;

  for (size_t i = 0; i < stroke->n; i++)
    {
      CeldPoint p = celd_stroke_point (stroke, stroke->pixel[i]);

      if (stroke->distance[stroke->pixel[i]] < view->from || forwards (view, p) < most_s - 0.5)
        continue;
      sum.x += p.x;
      sum.y += p.y;
      n++;
    }
  return (CeldPoint) { sum.x / n, sum.y / n };
}

/* Width of the last part before a distance, four widths long; at least 3/4 of w, and 9/10 in the first half of the
 * stroke, because pens start thin. */
static double
width_before (const CeldArrowStroke *stroke, double w, double distance)
{
  double least = distance < 0.5 * celd_stroke_length (stroke) ? 0.9 : 0.75;

  return fmax (least * w, celd_stroke_mean_width (stroke, fmax (0, distance - 4 * w), distance));
}

/* The length for which a stroke must be wider than its shaft. */
static double
least_head (double w)
{
  return fmax (w, 4);
}

/* The distance at which the stroke gets wider than just before, and stays wider; its length if it does not. */
static double
shaft_end (const CeldArrowStroke *stroke, double w)
{
  double length = celd_stroke_length (stroke), ahead = least_head (w), d = w;

  for (; d + ahead < length; d += 0.5)
    {
      double wide = 1.3 * width_before (stroke, w, d) + 0.8;

      if (celd_stroke_mean_width (stroke, d, d + ahead) > wide &&
          celd_stroke_mean_width (stroke, d, d + 0.5 * ahead) > wide)
        return d;
    }
  return length;
}

/* Does the shaft have about the same width everywhere, and no head at its start? */
static bool
is_even (const CeldArrowStroke *stroke, double w, double end)
{
  double a = celd_stroke_mean_width (stroke, 0, end / 3), b = celd_stroke_mean_width (stroke, end / 3, 2 * end / 3);
  double c = celd_stroke_mean_width (stroke, 2 * end / 3, end), part = fmax (w, 4);

  for (double d = 0; d < fmin (end - part, 8 * w); d += 0.5)
    if (celd_stroke_mean_width (stroke, d, d + part) > THICK_START * b + 0.8)
      return false;
  return fmax (a, fmax (b, c)) < EVEN_WIDTH * fmin (a, fmin (b, c));
}

/* Is the part beyond the shaft wider than it on both sides, and does the shaft enter it between the barbs? */
static bool
is_wider (const View *view, const Extent *e, double w, const View *shaft)
{
  double    least = 0.5 * w + fmax (0.25 * w, 0.75);
  double    cosine = shaft->axis.x * view->axis.x + shaft->axis.y * view->axis.y, along;
  CeldPoint entry;

  if (cosine < LEAST_COSINE || e->left < least || -e->right < least)
    return false;
  along = (0.5 * (e->left_s + e->right_s) - forwards (view, shaft->origin)) / cosine;
  entry = view_point (shaft, along, 0);
  return fabs (sideways (view, entry)) < 0.35 * (e->left - e->right) + 0.25 * w;
}

/* Are both barbs behind the tip, at similar distances, and does the head end there? */
static bool
barbs_are_behind (const Extent *e, double w)
{
  double left = e->most_s - e->left_s, right = e->most_s - e->right_s;

  return left > 0.25 * e->left && right > -0.25 * e->right && fmin (left, right) > 0.3 * fmax (left, right) &&
         e->most_s - e->least_s < 1.2 * fmax (left, right) + w + 2;
}

/* Are at least four fifths of the straight line painted? */
static bool
is_line (const CeldArrowStroke *stroke, CeldPoint from, CeldPoint to)
{
  double dx = to.x - from.x, dy = to.y - from.y;
  int    n  = (int) hypot (dx, dy) + 1, painted = 0;

  for (int i = 0; i <= n; i++)
    painted += celd_stroke_painted (stroke, (CeldPoint) { from.x + dx * i / n, from.y + dy * i / n });
  return 5 * painted >= 4 * (n + 1);
}

/* Are there lines from the tip to both barbs, does the breadth increase from the tip backwards, and is less than a
 * twentieth of the pixels outside of the triangle?  That holds for open and for filled heads. */
static bool
is_arrowhead (const CeldArrowStroke *stroke, const View *view, const Extent *e, double w)
{
  double    breadth = e->left - e->right + 1, length = e->most_s - 0.5 * (e->left_s + e->right_s);
  double    s = e->most_s - fmin (0.6 * w, 0.3 * length), slope = 0.5 * breadth / length;
  CeldPoint tip = view_point (view, s, 0);
  size_t    outside = 0;

  if (breadth_at (stroke, view, e->most_s - 0.25 * length) > 0.68 * breadth ||
      breadth_at (stroke, view, e->most_s - 0.5 * length) > 0.82 * breadth ||
      breadth_at (stroke, view, e->most_s - 0.5 * length) < 0.35 * breadth)
    return false;
  if (!is_line (stroke, tip, view_point (view, e->left_s, e->left - 0.4 * w)) ||
      !is_line (stroke, tip, view_point (view, e->right_s, e->right + 0.4 * w)))
    return false;
  for (size_t i = 0; i < stroke->n; i++)
    {
      CeldPoint p = celd_stroke_point (stroke, stroke->pixel[i]);

      outside += stroke->distance[stroke->pixel[i]] >= view->from &&
                 fabs (sideways (view, p)) > slope * (e->most_s - forwards (view, p)) + 0.7 * w + 1;
    }
  return 20 * outside < e->n;
}

/* Is it a filled disc, about as long as broad?  It fills more of its box than a triangle does, or somewhat more and is
 * broadest near the middle. */
static bool
is_dot (const Extent *e)
{
  double breadth = e->left - e->right + 1, length = e->most_s - e->least_s + 1;
  double filled = (double) e->n / (breadth * length);
  double middle = (0.5 * (e->left_s + e->right_s) - e->least_s) / fmax (1, e->most_s - e->least_s);

  return length > 0.6 * breadth && length < 1.6 * breadth &&
         (filled > 0.65 || (filled > 0.56 && middle > 0.35 && middle < 0.75));
}

/* Turns the axis until it runs from between the barbs to the tip, since the shaft may be curved.  Returns the extent in
 * that view. */
static Extent
turn_to_tip (const CeldArrowStroke *stroke, View *view)
{
  Extent e = extent_between (stroke, view, -INFINITY, INFINITY);

  for (int i = 0; i < AXIS_ROUNDS && e.left > 0 && e.right < 0; i++)
    {
      CeldPoint tip = foremost (stroke, view, e.most_s);

      view->origin = view_point (view, 0.5 * (e.left_s + e.right_s), 0.5 * (e.left + e.right));
      view->axis   = direction (view->origin, tip);
      e = extent_between (stroke, view, -INFINITY, INFINITY);
    }
  return e;
}

static uint32_t
nearest_pixel (const CeldArrowStroke *stroke, CeldPoint p)
{
  uint32_t nearest = stroke->pixel[0];
  double   least   = INFINITY;

  for (size_t i = 0; i < stroke->n; i++)
    {
      CeldPoint q = celd_stroke_point (stroke, stroke->pixel[i]);
      double    d = hypot (p.x - q.x, p.y - q.y);

      if (d < least)
        {
          least   = d;
          nearest = stroke->pixel[i];
        }
    }
  return nearest;
}

/* A view of the part beyond a shaft of width w that ends at a distance, along the direction of the shaft there. */
static View
view_beyond (const CeldArrowStroke *stroke, double w, double end)
{
  double    back = fmin (fmax (2 * w, 6), 0.6 * end);
  CeldPoint last = celd_stroke_centroid (stroke, end - 0.4 * back, end - 0.15 * back);

  return (View) { last, direction (celd_stroke_centroid (stroke, end - back, end - 0.75 * back), last), end };
}

/* Distance from the tip to the end of the longer barb. */
static double
barb_length (const Extent *e)
{
  return fmax (hypot (e->most_s - e->left_s, e->left), hypot (e->most_s - e->right_s, e->right));
}

/* Are the barbs of a head as long as arrows that meet there? */
static bool
barbs_are_arrows (const Extent *e, double w, const CeldArrowEnds *ends)
{
  return barb_length (e) > fmax (LARGE_HEAD * w, MOST_HEAD * celd_points_apart (ends->tail, ends->tip));
}

/* Do two lines of a loop meet at the farthest place from where a stroke was followed?  Then their paint just before
 * it is on two sides.  That says nothing if it is no farther than the barbs of a head where the stroke was followed
 * from. */
static bool
two_meet_at_end (const CeldArrowStroke *stroke, double w, double barb)
{
  double    to = celd_stroke_length (stroke) - 2 * w, from = to - fmax (1, w);
  CeldPoint c = celd_stroke_centroid (stroke, from, to);

  for (size_t i = 0; i < stroke->n && from > barb + w; i++)
    {
      double    d = stroke->distance[stroke->pixel[i]];
      CeldPoint p = celd_stroke_point (stroke, stroke->pixel[i]);

      if (d >= from && d <= to && hypot (p.x - c.x, p.y - c.y) > 1.2 * w + 2)
        return true;
    }
  return false;
}

/* Follows the stroke from `tail`.  If it ends in a head, or with `dot` in a dot: its tail, and its tip or the dot's
 * centre. */
static bool
read_from_tail (CeldArrowStroke *stroke, uint32_t tail, bool dot, CeldArrowEnds *ends)
{
  View      view, shaft;
  Extent    e;
  double    length, w, end;
  CeldPoint tip, last;

  celd_stroke_follow (stroke, &tail, 1);
  length = celd_stroke_length (stroke);
  if (length < SHORTEST_SHAFT)
    return false;
  w   = celd_stroke_mean_width (stroke, 1, 0.5 * length);
  end = shaft_end (stroke, w);
  if (end >= length || end < LEAST_SHAFT * w || !is_even (stroke, w, end))
    return false;
  w     = width_before (stroke, w, end);
  view  = view_beyond (stroke, w, end);
  shaft = view;
  e     = turn_to_tip (stroke, &view);
  if (!is_wider (&view, &e, w, &shaft) || is_dot (&e) != dot ||
      (!dot && (!barbs_are_behind (&e, w) || !is_arrowhead (stroke, &view, &e, w))))
    return false;
  tip   = foremost (stroke, &view, e.most_s);
  *ends = (CeldArrowEnds) { celd_stroke_centroid (stroke, 0, fmax (1, w)), dot ? view.origin : tip };
  if (!dot && barbs_are_arrows (&e, w, ends))
    return false;

  /* The tail must be farthest from the tip; else the stroke was followed from the middle of the shaft, or of a loop. */
  tail = nearest_pixel (stroke, tip);
  last = celd_stroke_point (stroke, celd_stroke_follow (stroke, &tail, 1));
  return hypot (last.x - ends->tail.x, last.y - ends->tail.y) < w + 2 && !two_meet_at_end (stroke, w, barb_length (&e));
}

/* Is a stroke so short, seen from an end, that there is no room for a shaft and the least head? */
static bool
is_short (CeldArrowStroke *stroke, uint32_t end)
{
  double length, w;

  celd_stroke_follow (stroke, &end, 1);
  length = celd_stroke_length (stroke);
  w      = celd_stroke_mean_width (stroke, 1, 0.5 * length);
  return length < SHORTEST_SHAFT || length <= LEAST_SHAFT * w + least_head (w);
}

CeldArrowReason
celd_arrowhead (CeldArrowStroke *stroke, bool dot, CeldArrowEnds *ends)
{
  uint32_t extremity[EXTREMITIES];
  bool     found = false;

  extremity[0] = celd_stroke_follow (stroke, stroke->pixel, 1);
  for (size_t i = 1; i < EXTREMITIES; i++)
    extremity[i] = celd_stroke_follow (stroke, extremity, i);
  for (size_t i = 0; i < EXTREMITIES; i++)
    {
      CeldArrowEnds one;

      if (!read_from_tail (stroke, extremity[i], dot, &one))
        continue;
      if (found && hypot (one.tip.x - ends->tip.x, one.tip.y - ends->tip.y) > 3)
        return CELD_REASON_ALIKE;
      found = true;
      *ends = one;
    }
  return found ? CELD_REASON_NONE : is_short (stroke, extremity[0]) ? CELD_REASON_SHORT : CELD_REASON_ALIKE;
}
