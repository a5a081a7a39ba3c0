/* Which narrow places between basins are gaps in a contour, and which are necks of one region.
 *
 * The energy of LazyBrush [SDC09b] charges both by their width alone.  A person looks at the lines: at a gap a line ends
 * and points across to where it goes on, at a neck two lines pass each other.  So the ink next to the narrowest place
 * is looked at on both sides.  In a disc of a few stroke widths round the end of a line the ink hangs together, lies on
 * the far side of that end, and is thin seen from the gap; beside a line its centre is close to the disc's, and a corner
 * or a solid area is broad.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "segment.h"

#include <math.h>
#include <string.h>

#define RAYS     96             /* in which the ink round a narrow place is looked for */
#define REACH    3              /* radius of the disc, in stroke widths */
#define CELLS    12             /* of the disc's radius, at most: larger ones are looked at in steps */
#define BEHIND   0.3            /* of the radius: so far behind its end lies a line's centre at least */
#define BROAD    0.25           /* of the radius: a line's deviation across is less */
#define ASIDE    0.64           /* cosine of the angle between a line and its continuation at most */
#define OPPOSITE -0.17          /* cosine of the angle from which on the ink beyond is on the other side */

/* The first ink from (x,y) in a direction, at a distance of at most `reach`; false if there is none. */
static bool
look (const CeldPlane *ink, int x, int y, double dx, double dy, double reach, double *distance)
{
  for (double d = 1; d <= reach; d++)
    {
      int u = (int) floor (x + 0.5 + d * dx), v = (int) floor (y + 0.5 + d * dy);

      if (u < 0 || v < 0 || u >= ink->width || v >= ink->height)
        return false;
      if (celd_is_paper (CELD_AT (ink, u, v)))
        continue;
      *distance = d;
      return true;
    }
  return false;
}

typedef struct { double x, y, distance; } Bank; /* the ink on one side of a narrow place */

/* The nearest ink round a pixel of paper, and the nearest on the other side; false if one side has none within `reach`. */
static bool
find_banks (const CeldPlane *ink, int x, int y, double reach, Bank bank[2])
{
  double distance[RAYS], dx[RAYS], dy[RAYS];
  int    first = -1, second = -1;

  for (int i = 0; i < RAYS; i++)
    {
      double angle = 2 * 3.14159265358979 * i / RAYS;

      dx[i] = cos (angle);
      dy[i] = sin (angle);
      if (!look (ink, x, y, dx[i], dy[i], reach, &distance[i]))
        distance[i] = INFINITY;
      if (distance[i] < INFINITY && (first < 0 || distance[i] < distance[first]))
        first = i;
    }
  for (int i = 0; i < RAYS && first >= 0; i++)
    if (distance[i] < INFINITY && dx[i] * dx[first] + dy[i] * dy[first] < OPPOSITE &&
        (second < 0 || distance[i] < distance[second]))
      second = i;
  if (second < 0)
    return false;
  bank[0] = (Bank) { x + 0.5 + distance[first] * dx[first], y + 0.5 + distance[first] * dy[first], distance[first] };
  bank[1] = (Bank) { x + 0.5 + distance[second] * dx[second], y + 0.5 + distance[second] * dy[second], distance[second] };
  return true;
}

/* The ink that hangs together round a bank, as far as the disc goes, on a grid of cells. */
typedef struct { int radius; double step; bool inked[(2 * CELLS + 1) * (2 * CELLS + 1)]; } Disc;

static void
fill_disc (const CeldPlane *ink, Bank bank, double radius, Disc *disc)
{
  int  side, n = 0;
  int  queue[(2 * CELLS + 1) * (2 * CELLS + 1)];
  bool seen[(2 * CELLS + 1) * (2 * CELLS + 1)] = { false };

  disc->radius = radius < CELLS ? (int) radius : CELLS;
  disc->step   = radius / disc->radius;
  side         = 2 * disc->radius + 1;
  memset (disc->inked, 0, sizeof disc->inked);
  queue[n++] = disc->radius * side + disc->radius;
  seen[queue[0]] = true;
  for (int i = 0; i < n; i++)
    {
      int a = queue[i] % side, b = queue[i] / side;
      int x = (int) floor (bank.x + (a - disc->radius) * disc->step);
      int y = (int) floor (bank.y + (b - disc->radius) * disc->step);

      if (x < 0 || y < 0 || x >= ink->width || y >= ink->height || celd_is_paper (CELD_AT (ink, x, y)))
        continue;
      disc->inked[queue[i]] = true;
      for (int v = b > 0 ? b - 1 : 0; v <= b + 1 && v < side; v++)
        for (int u = a > 0 ? a - 1 : 0; u <= a + 1 && u < side; u++)
          {
            int du = u - disc->radius, dv = v - disc->radius;

            if (seen[v * side + u] || du * du + dv * dv > disc->radius * disc->radius)
              continue;
            seen[v * side + u] = true;
            queue[n++] = v * side + u;
          }
    }
}

/* Does a line end at the bank, and point to `to`? */
static bool
is_line_end (const CeldPlane *ink, Bank bank, Bank to, double radius)
{
  Disc   disc;
  double n = 0, mx = 0, my = 0, across = 0, length, towards = hypot (to.x - bank.x, to.y - bank.y);
  int    side;

  fill_disc (ink, bank, radius, &disc);
  side = 2 * disc.radius + 1;
  for (int i = 0; i < side * side; i++)
    if (disc.inked[i])
      {
        n++;
        mx += i % side - disc.radius;
        my += i / side - disc.radius;
      }
  mx /= n;
  my /= n;
  length = hypot (mx, my);
  if (length < BEHIND * disc.radius || (to.x - bank.x) * -mx + (to.y - bank.y) * -my < ASIDE * length * towards)
    return false;
  for (int i = 0; i < side * side; i++)
    if (disc.inked[i])
      {
        double off = ((i % side - disc.radius) * my - (i / side - disc.radius) * mx) / length;

        across += off * off;
      }
  return sqrt (across / n) < BROAD * disc.radius;
}

bool
celd_is_gap (const CeldPlane *ink, const CeldBasins *basins, const CeldBorder *border)
{
  double radius = fmax (REACH * basins->stroke, 6), reach = 1.5 * sqrt (border->saddle) + 2;
  Bank   bank[2];

  return border->passes && find_banks (ink, border->x, border->y, reach, bank) &&
         (is_line_end (ink, bank[0], bank[1], radius) || is_line_end (ink, bank[1], bank[0], radius));
}
