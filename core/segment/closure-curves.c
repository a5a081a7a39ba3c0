/* The curve that closes a gap: a cubic Hermite segment between two tips.
 *
 * An arc of a circle over a chord that it meets at the angle a has tangents of length chord / cos^2 (a/2) there, as
 * Hermite segments count it.  Hands flatten what they have to guess, and small angles are as likely a wobble of the
 * line as its course; so the tangents are shortened.  Lines that leave the chord by more than a person would
 * follow, or that bend it into an S, are no continuation of each other: then the curve becomes straight, and so it is
 * between ends that point nowhere.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "segment/closures.h"

#include <math.h>

#define DAMPING    0.7         /* of the length of tangents */
#define WOBBLE     0.28         /* radians: an angle of this size counts half */
#define TRUSTED    0.7          /* radians off the chord: up to here an angle is followed */
#define MOST_ANGLE 1.05         /* from here on it is not; 60 degrees */
#define MOST_S     0.5          /* radians: of two angles that make an S the smaller one may be as large */
#define SPACING    3.0          /* pixels between places */

/* 1 up to `trusted`, 0 from `most` on. */
static double
fade (double value, double trusted, double most)
{
  return value <= trusted ? 1 : value >= most ? 0 : (most - value) / (most - trusted);
}

/* How far to the right the way on from a tip turns off the chord, in radians; 0 where no line ends. */
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
  double    a = angle_off (from, x, y), b = angle_off (to, -x, -y), trust, m, n, px, py, qx, qy;
  size_t    last = (size_t) fmin (CELD_CURVE_PLACES - 1, ceil (length / SPACING));

  trust = fade (fmax (fabs (a), fabs (b)), TRUSTED, MOST_ANGLE);
  if (a * b > 0)
    trust *= fade (fmin (fabs (a), fabs (b)), 0, MOST_S); /* seen from both ends, a bow turns off to different sides */
  m  = trust * tangent_length (a, length);
  n  = trust * tangent_length (b, length);
  px = m * from->dx;
  py = m * from->dy;
  qx = -n * to->dx;
  qy = -n * to->dy;
  if (trust <= 0 || last < 2 || (!from->tip && !to->tip))
    {
      place[0] = p;
      place[1] = q;
      return 2;
    }
  if (!from->tip) /* no bend where the curve meets the side of a line */
    {
      px = 1.5 * x - 0.5 * qx;
      py = 1.5 * y - 0.5 * qy;
    }
  if (!to->tip)
    {
      qx = 1.5 * x - 0.5 * px;
      qy = 1.5 * y - 0.5 * py;
    }
  for (size_t i = 0; i <= last; i++)
    {
      double t = (double) i / (double) last, s = 1 - t;
      double h = t * t * (3 - 2 * t), g = t * s * s, k = -t * t * s;

      place[i] = (CeldPlace) { p.x + h * x + g * px + k * qx, p.y + h * y + g * py + k * qy };
    }
  return last + 1;
}
