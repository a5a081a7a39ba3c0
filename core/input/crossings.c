/* Where painted strokes cross.
 *
 * A circle around a crossing meets four arms, which are opposite each other in pairs, and paint joins each arm to the
 * centre and continues beyond the circle.  That distinguishes a crossing from an arrowhead, whose barbs point in one
 * direction and end.  Circles of several sizes are tried around pixels that are farther from the edge of the paint than
 * their neighbours; strokes that cross at a small angle need large ones.  Of candidates that overlap the one with the
 * straightest strokes is the crossing.
 *
 * Cost: some hundred samples for each pixel on the middle of a stroke.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/arrows.h"

#include <math.h>

#define ARMS          4
#define SAMPLES       256  /* on a circle, at most; chosen */
#define MOST_TURN     0.6  /* radians that a stroke may turn at a crossing; chosen */
#define BREADTH_RATIO 2.2  /* of the two arms of a stroke, at most; chosen */
#define BLOB          0.75 /* breadths of the wider stroke: radius of a circle that only a dot or filled head has room for; ... */
#define BLOB_MORE     1.5  /* ... and pixels more; 1 / sqrt (2) is the largest if the strokes are even; chosen */
#define BEYOND        1.5  /* radii from the centre up to which an arm must continue; chosen */

/* A possible crossing, and the larger angle by which one of its strokes turns, in radians. */
typedef struct { CeldStrokeCrossing crossing; double turn; } CrossingCandidate;

/* Points of the circle of radius 1. */
typedef struct { double x[SAMPLES], y[SAMPLES]; } Circle;

static bool
is_painted (const CeldStrokeMask *c, double x, double y)
{
  return x >= 0 && y >= 0 && x < c->width && y < c->height && c->painted[(size_t) y * (size_t) c->width + (size_t) x];
}

/* Is the straight line from `start` to `end` pixels away from a point painted? */
static bool
is_painted_line (const CeldStrokeMask *c, CeldPoint from, double angle, double start, double end)
{
  for (double s = start; s <= end; s += 0.5)
    if (!is_painted (c, from.x + s * cos (angle), from.y + s * sin (angle)))
      return false;
  return true;
}

/* Does the arm continue beyond the circle, turning by at most 0.4 radians? */
static bool
continues (const CeldStrokeMask *c, CeldPoint centre, double angle, double radius)
{
  double    turn[] = { 0, 0.2, -0.2, 0.4, -0.4 };
  CeldPoint arm = { centre.x + radius * cos (angle), centre.y + radius * sin (angle) };

  for (size_t i = 0; i < sizeof turn / sizeof *turn; i++)
    if (is_painted_line (c, arm, angle + turn[i], 0, (BEYOND - 1) * radius + 1))
      return true;
  return false;
}

/* The middles and widths, in radians, of the four painted arcs of a circle; false if there are not four. */
static bool
find_arcs (const CeldStrokeMask *c, const Circle *circle, CeldPoint centre, double radius, double middle[ARMS],
           double wide[ARMS])
{
  int  step = radius < 6 ? 4 : radius < 12 ? 2 : 1, n = SAMPLES / step, first = 0, arcs = 0, start = 0;
  bool on[SAMPLES];

  for (int i = 0; i < n; i++)
    on[i] = is_painted (c, centre.x + radius * circle->x[i * step], centre.y + radius * circle->y[i * step]);
  while (first < n && on[first])
    first++;
  if (first == n)
    return false;
  for (int i = first + 1; i <= first + n; i++)
    {
      bool here = on[i % n], before = on[(i - 1) % n];

      if (here && !before)
        start = i;
      if (here || !before)
        continue;
      if (arcs == ARMS)
        return false;
      middle[arcs] = CELD_PI * (start + i - 1) / n;
      wide[arcs++] = 2 * CELD_PI * (i - start) / n;
    }
  return arcs == ARMS;
}

/* The angle by which a stroke with these two arms turns. */
static double
turn_between (double a, double b)
{
  return fabs (CELD_PI - fmod (fabs (b - a), 2 * CELD_PI));
}

/* Does the circle show a crossing? */
static bool
try_circle (const CeldStrokeMask *c, const Circle *circle, CeldPoint centre, double radius, CrossingCandidate *found)
{
  double              middle[ARMS], wide[ARMS];
  CeldStrokeCrossing *x = &found->crossing;

  if (!find_arcs (c, circle, centre, radius, middle, wide))
    return false;
  found->turn = fmax (turn_between (middle[0], middle[2]), turn_between (middle[1], middle[3]));
  if (found->turn > MOST_TURN)
    return false;
  *x = (CeldStrokeCrossing) { .centre = centre, .radius = radius };
  for (int i = 0; i < ARMS; i++)
    {
      x->arm[i]     = (CeldPoint) { centre.x + radius * cos (middle[i]), centre.y + radius * sin (middle[i]) };
      x->breadth[i] = 2 * radius * sin (fmin (CELD_PI, wide[i]) / 2);
      if (!is_painted_line (c, centre, middle[i], 0, radius) || !continues (c, centre, middle[i], radius))
        return false;
    }
  for (int i = 0; i < 2; i++)
    if (fmax (x->breadth[i], x->breadth[i + 2]) > BREADTH_RATIO * fmin (x->breadth[i], x->breadth[i + 2]) + 1)
      return false;
  return true;
}

/* Is there a dot or filled head in the inner half of a crossing?  Then several arrows end there. */
static bool
has_blob (const CeldStrokeMask *c, const CeldStrokeCrossing *x)
{
  double r = 0.5 * x->radius, widest = 0, most;

  for (int i = 0; i < ARMS / 2; i++)
    widest = fmax (widest, fmin (x->breadth[i], x->breadth[i + 2])); /* the other arm may be the dot */
  most = BLOB * widest + BLOB_MORE;
  for (int y = (int) fmax (0, x->centre.y - r); y <= x->centre.y + r && y < c->height; y++)
    for (int u = (int) fmax (0, x->centre.x - r); u <= x->centre.x + r && u < c->width; u++)
      if (c->squared[(size_t) y * (size_t) c->width + (size_t) u] > most * most)
        return true;
  return false;
}

/* Are at most two of the eight neighbours farther from the edge of the paint? */
static bool
is_medial (const CeldStrokeMask *c, size_t p)
{
  size_t w = (size_t) c->width, beside[] = { p - w - 1, p - w, p - w + 1, p - 1, p + 1, p + w - 1, p + w, p + w + 1 };
  int    farther = 0;

  for (int i = 0; i < 8; i++)
    farther += c->squared[beside[i]] > c->squared[p];
  return farther <= 2;
}

/* Appends a candidate for each pixel around which a circle shows a crossing: the straightest. */
static CeldStatus
find_candidates (const CeldStrokeMask *c, CrossingCandidate **list, size_t *n)
{
  static const double radii[] = { 1.6, 2, 2.5, 3.2, 4 }; /* of the largest circle inside the paint */
  Circle              circle;
  size_t              capacity = 0;

  for (int i = 0; i < SAMPLES; i++)
    {
      circle.x[i] = cos (2 * CELD_PI * i / SAMPLES);
      circle.y[i] = sin (2 * CELD_PI * i / SAMPLES);
    }

  for (int y = 1; y + 1 < c->height; y++)
    for (int x = 1; x + 1 < c->width; x++)
      {
        size_t            p = (size_t) y * (size_t) c->width + (size_t) x;
        CrossingCandidate best = { .turn = INFINITY }, one;

        if (!c->painted[p] || !is_medial (c, p))
          continue;
        for (size_t i = 0; i < sizeof radii / sizeof *radii; i++)
          if (try_circle (c, &circle, (CeldPoint) { x + 0.5, y + 0.5 }, radii[i] * sqrt (c->squared[p]) + 1, &one) &&
              one.turn < best.turn)
            best = one;
        if (best.turn < INFINITY && !has_blob (c, &best.crossing) && celd_append (*list, *n, capacity, best) != CELD_OK)
          return CELD_NO_MEMORY;
      }
  return CELD_OK;
}

/* Takes the straightest candidate from the list, and drops those that overlap it. */
static CeldStrokeCrossing
take_best (CrossingCandidate *list, size_t *n)
{
  size_t             best = 0, kept = 0;
  CeldStrokeCrossing x;

  for (size_t i = 1; i < *n; i++)
    if (list[i].turn < list[best].turn)
      best = i;
  x = list[best].crossing;
  for (size_t i = 0; i < *n; i++)
    {
      const CeldStrokeCrossing *other = &list[i].crossing;

      if (hypot (other->centre.x - x.centre.x, other->centre.y - x.centre.y) > x.radius + other->radius)
        list[kept++] = list[i];
    }
  *n = kept;
  return x;
}

CeldStatus
celd_stroke_crossings_find (const CeldStrokeMask *mask, CeldStrokeCrossing **list, size_t *n)
{
  CrossingCandidate  *candidates = NULL;
  CeldStrokeCrossing *found = NULL;
  size_t              left = 0, taken = 0, capacity = 0;
  CeldStatus          status = find_candidates (mask, &candidates, &left);

  while (left && status == CELD_OK)
    {
      CeldStrokeCrossing best = take_best (candidates, &left);

      status = celd_append (found, taken, capacity, best);
    }
  celd_free (candidates);
  if (status != CELD_OK)
    {
      celd_free (found);
      return status;
    }
  *list = found;
  *n    = taken;
  return CELD_OK;
}
