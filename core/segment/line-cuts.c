/* The ends of broad lines that were cut off, or rubbed out: two corners, and smooth sides that lead to them.
 *
 * The ink of such an end may be shorter than it is wide, hollow or aslant, so that its axis has nothing to do with the
 * direction of the line.  But what is left of its sides still has it: at their corners, if they bend, as the horns of a
 * crescent do that is left of a ring.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "image/image.h"
#include "segment/bridges.h"
#include "segment/closures.h"

#include <math.h>

#define CUT_REACH     0.4  /* stroke widths along the outline to either side of a corner (chosen, as all of these) */
#define LEAST_REACH   6    /* pixels of it; less cannot tell a corner from steps of pixels */
#define SHARP_BEND    0.64 /* cosine of the least turn at a corner: 50 degrees; a round end has 45 */
#define BLUNT_END     0.1  /* stroke widths: so near to its corner a side may be bent */
#define LONGEST_SIDE  0.6  /* stroke widths of a side that are looked at */
#define SHORTEST_SIDE 0.4
#define MOST_BENT     0.07 /* of that length, and a pixel: an arc of 1.8 times its radius */
#define LEAST_BENT    1    /* pixel in the middle of a side; less may be steps of pixels */
#define SIDES_AGREE   0.77 /* cosine of the angle between both sides: 40 degrees */
#define RIGHT_ANGLE   0.94 /* sine of the angle between a single side and the way from corner to corner: 70 degrees */
#define NARROWEST_CUT 0.5  /* stroke widths: of the line */
#define WIDEST_CUT    1.5
#define INK_BEHIND    0.75 /* line widths behind the end there is ink */

static CeldPlace
place_at (const CeldOutline *outline, ptrdiff_t i)
{
  ptrdiff_t  n = (ptrdiff_t) outline->n;
  CeldCorner corner = outline->corner[(i % n + n) % n];

  return (CeldPlace) { corner.x, corner.y };
}

/* The cosine of the angle by which the outline turns to its ink at a place; 1 if it turns the other way. */
static double
turn_at (const CeldOutline *outline, ptrdiff_t i, ptrdiff_t reach)
{
  CeldPlace at = place_at (outline, i), from = place_at (outline, i - reach), to = place_at (outline, i + reach);
  double    x = at.x - from.x, y = at.y - from.y, next_x = to.x - at.x, next_y = to.y - at.y;

  return x * next_y - y * next_x > 0 ? (x * next_x + y * next_y) / (hypot (x, y) * hypot (next_x, next_y)) : 1;
}

/* The next corner from place i on, where a turn is sharpest; `end`: there is none before it. */
static ptrdiff_t
next_corner (const CeldOutline *outline, ptrdiff_t i, ptrdiff_t end, ptrdiff_t reach)
{
  ptrdiff_t best = end;
  double    least = SHARP_BEND;

  for (; i < end && (best == end || i < best + reach); i++)
    {
      double turn = turn_at (outline, i, reach);

      if (reach >= 2 * LEAST_REACH) /* between hollow sides a corner is sharper nearby */
        turn = fmin (turn, turn_at (outline, i, reach / 2));
      if (turn >= least)
        continue;
      least = turn;
      best = i;
    }
  return best;
}

/* The unit direction in which a side reaches its corner, `blunt` pixels from its end: bent on as it bends from its far to
 * its near half, or along its chord if it is straight as far as pixels show. */
static CeldPlace
bend_on (CeldPlace end, CeldPlace half, CeldPlace back, double blunt)
{
  double length = celd_distance_between (end, back), x = (end.x - back.x) / length, y = (end.y - back.y) / length;
  double on = 0.5 + 2 * blunt / length;

  if (fabs ((half.x - back.x) * y - (half.y - back.y) * x) < LEAST_BENT)
    return (CeldPlace) { x, y };
  x      = end.x - half.x + on * (end.x - 2 * half.x + back.x);
  y      = end.y - half.y + on * (end.y - 2 * half.y + back.y);
  length = hypot (x, y);
  return (CeldPlace) { x / length, y / length };
}

/* The direction of the side that leads to a corner, which may be blunt, if it bends evenly over that length.  `sign`:
 * whether it lies along the outline or against it from there. */
static bool
is_side (const CeldOutline *outline, ptrdiff_t corner, ptrdiff_t sign, double blunt, double length,
             CeldPlace *towards)
{
  ptrdiff_t first = corner + sign * (ptrdiff_t) blunt, i = first, most = (ptrdiff_t) (2 * length);
  CeldPlace end = place_at (outline, first), back;
  double    measured;

  do
    {
      i       += sign;
      back     = place_at (outline, i);
      measured = celd_distance_between (end, back);
    }
  while (measured < length && (i - first) * sign < most);
  if (measured < length)
    return false;
  *towards = (CeldPlace) { (end.x - back.x) / measured, (end.y - back.y) / measured };
  for (ptrdiff_t k = first + sign; k != i; k += sign)
    {
      CeldPlace place = place_at (outline, k);

      if (fabs ((place.x - back.x) * towards->y - (place.y - back.y) * towards->x) > MOST_BENT * measured + 1)
        return false;
    }
  *towards = bend_on (end, place_at (outline, (first + i) / 2), back, blunt);
  return true;
}

static bool
find_side (const CeldOutline *outline, ptrdiff_t corner, ptrdiff_t sign, double stroke, CeldPlace *towards)
{
  for (double length = LONGEST_SIDE * stroke; length >= SHORTEST_SIDE * stroke; length *= 0.7)
    if (is_side (outline, corner, sign, BLUNT_END * stroke, length, towards))
      return true;
  return false;
}

static bool
is_ink (const CeldPlane *ink, CeldPlace place)
{
  int x = (int) floor (place.x), y = (int) floor (place.y);

  return x >= 0 && y >= 0 && x < ink->width && y < ink->height && !celd_is_paper (CELD_AT (ink, x, y));
}

/* The middle of the line between its corners, or behind them where the end is hollow.  In the middle of a limb that is
 * only outlined there is paper; it does not end there. */
static bool
find_tip (const CeldPlane *ink, CeldPlace p, CeldPlace q, CeldTip *tip)
{
  double back = -1, most = tip->width;

  do
    {
      tip->x = 0.5 * (p.x + q.x) - ++back * tip->dx;
      tip->y = 0.5 * (p.y + q.y) - back * tip->dy;
    }
  while (back < most && !is_ink (ink, (CeldPlace) { tip->x, tip->y }));
  for (double d = 0; d < INK_BEHIND * tip->width; d++)
    if (!is_ink (ink, (CeldPlace) { tip->x - d * tip->dx, tip->y - d * tip->dy }))
      return false;
  return true;
}

/* The direction of a line with two sides, or with one that is at right angles to the way from corner to corner. */
static bool
find_direction (const CeldOutline *outline, ptrdiff_t first, ptrdiff_t last, CeldTip *tip)
{
  CeldPlace p = place_at (outline, first), q = place_at (outline, last), a = { 0, 0 }, b = a;
  bool      has_a = find_side (outline, first, -1, tip->stroke, &a);
  bool      has_b = find_side (outline, last, 1, tip->stroke, &b);
  double    x = (has_a ? a.x : 0) + (has_b ? b.x : 0), y = (has_a ? a.y : 0) + (has_b ? b.y : 0);
  double    length = hypot (x, y);

  if (length == 0 || (has_a && has_b && a.x * b.x + a.y * b.y < SIDES_AGREE))
    return false;
  tip->dx    = x / length;
  tip->dy    = y / length;
  tip->width = fabs ((q.x - p.x) * tip->dy - (q.y - p.y) * tip->dx);
  return (has_a && has_b) || tip->width >= RIGHT_ANGLE * celd_distance_between (p, q);
}

/* Is it the frame of the picture that cuts a line off? */
static bool
is_on_frame (const CeldPlane *ink, CeldPlace p, CeldPlace q)
{
  return (p.x == q.x && (p.x == 0 || p.x == ink->width)) || (p.y == q.y && (p.y == 0 || p.y == ink->height));
}

/* Is there an end of a line between two corners? */
static bool
is_cut (const CeldPlane *ink, const CeldOutline *outline, ptrdiff_t first, ptrdiff_t last, CeldTip *tip)
{
  CeldPlace p = place_at (outline, first), q = place_at (outline, last);

  return !is_on_frame (ink, p, q) && find_direction (outline, first, last, tip) &&
         tip->width >= NARROWEST_CUT * tip->stroke && tip->width <= WIDEST_CUT * tip->stroke &&
         find_tip (ink, p, q, tip);
}

bool
celd_line_cut_next (const CeldPlane *ink, const CeldOutline *outline, int stroke, size_t *from, CeldTip *tip)
{
  ptrdiff_t reach = (ptrdiff_t) (1.2 * CUT_REACH * stroke), n = (ptrdiff_t) outline->n, first;

  if (n < 8 * reach)
    return false;
  *tip = (CeldTip) { .stroke = stroke };
  for (first = next_corner (outline, (ptrdiff_t) *from, n, reach); first < n;)
    {
      ptrdiff_t last = next_corner (outline, first + reach, first + n, reach);
      bool      cut = last < first + n && is_cut (ink, outline, first, last, tip);

      *from = (size_t) last;
      if (cut)
        return true;
      first = last;
    }
  return false;
}
