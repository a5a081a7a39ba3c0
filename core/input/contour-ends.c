/* Open ends of virtual contours: a stroke that stops a few pixels short of a contour would leak.
 *
 * A pixel on the outline of a stroke is at an end if a square around it, a little wider than the stroke, meets the
 * stroke in one place only.  If they do not meet, the pixel belongs to a dab, which may close a gap on both sides.
 * Ends are joined in the order of their distance to what they are joined to, by a line two pixels wide, unless a line
 * made before joins the same end.
 *
 * Cost: O(distance^2) for each pixel of an outline, and 28 bytes for each that is at an end.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/input.h"

#include <math.h>
#include <stdlib.h>

#define JOIN_DISTANCE 5   /* pixels over which ends are joined, ...; chosen */
#define JOIN_DIVISOR  256 /* ... plus this part of the shorter side of the picture; chosen */
#define END_MARGIN    3   /* pixels by which half the square round an end is larger than the stroke is wide; chosen */

/* A pixel on the outline of a stroke near its end, and the nearest pixel that the stroke may be joined to. */
typedef struct { int x, y, to_x, to_y, squared; uint32_t stroke; bool dab; } End;

/* In how many places does the outline of the square with half side `radius` round (x,y) meet the stroke? */
static int
crossings (const CeldContourBake *b, int x, int y, int radius, uint32_t stroke)
{
  int  n = 0;
  bool first = false, before = false;

  for (int i = 0; i < 8 * radius; i++)
    {
      int  along = i % (2 * radius) - radius;
      int  u = i < 2 * radius ? x + along : i < 4 * radius ? x + radius : i < 6 * radius ? x - along : x - radius;
      int  v = i < 2 * radius ? y - radius : i < 4 * radius ? y + along : i < 6 * radius ? y + radius : y - along;
      bool here = u >= 0 && v >= 0 && u < b->width && v < b->height && CELD_AT (&b->component, u, v) == stroke;

      n += here && !before;
      first = i == 0 ? here : first;
      before = here;
    }
  return n - (n > 1 && first && before);
}

/* Finds the nearest ink, other stroke or edge of the picture; false if it is more than `most` pixels away. */
static bool
find_target (const CeldContourBake *b, int most, End *end)
{
  end->squared = most * most + 1;
  for (int v = end->y - most; v <= end->y + most; v++)
    for (int u = end->x - most; u <= end->x + most; u++)
      {
        int  squared = (u - end->x) * (u - end->x) + (v - end->y) * (v - end->y);
        bool inside = u >= 0 && v >= 0 && u < b->width && v < b->height;

        if (squared >= end->squared)
          continue;
        if (inside && CELD_AT (&b->ink, u, v) > 0.5f &&
            (!CELD_AT (&b->component, u, v) || CELD_AT (&b->component, u, v) == end->stroke))
          continue;
        end->squared = squared;
        end->to_x = u;
        end->to_y = v;
      }
  return end->squared <= most * most;
}

static int
by_squared_distance (const void *a, const void *b)
{
  const End *p = a, *q = b;

  if (p->squared != q->squared)
    return p->squared - q->squared;
  return p->y != q->y ? p->y - q->y : p->x - q->x;
}

/* Does one of the joints made before join this end, too?  A stroke that touches ink near this end needs no other joint
 * there; a dab may be joined on several sides. */
static bool
is_joined (const CeldContourBake *b, const End *end, const End *joint, size_t n)
{
  int size = (int) b->breadth[end->stroke] + END_MARGIN;

  for (size_t i = 0; i < n; i++)
    {
      const End *j = &joint[i];
      int        dot = (end->to_x - end->x) * (j->to_x - j->x) + (end->to_y - end->y) * (j->to_y - j->y);
      int        far = abs (j->x - end->x) > abs (j->y - end->y) ? abs (j->x - end->x) : abs (j->y - end->y);

      if (j->stroke == end->stroke && ((dot > 0 && far <= 2 * size) || (j->squared <= 2 && !end->dab && far <= size)))
        return true;
    }
  return false;
}

/* Does a pixel have a neighbour that is not of its stroke? */
static bool
on_outline (const CeldContourBake *b, int x, int y)
{
  const CeldLabels *c = &b->component;
  uint32_t          k = CELD_AT (c, x, y);

  return (x > 0 && CELD_AT (c, x - 1, y) != k) || (x < b->width - 1 && CELD_AT (c, x + 1, y) != k) ||
         (y > 0 && CELD_AT (c, x, y - 1) != k) || (y < b->height - 1 && CELD_AT (c, x, y + 1) != k);
}

static CeldStatus
find_ends (const CeldContourBake *b, int most, const CeldHost *host, End **ends, size_t *n)
{
  size_t capacity = 0;

  for (int y = 0; y < b->height; y++)
    {
      if (celd_progress (host, (double) y / b->height) != CELD_OK)
        return CELD_CANCELLED;
      for (int x = 0; x < b->width; x++)
        {
          End end = { .x = x, .y = y, .stroke = CELD_AT (&b->component, x, y) };
          int met;

          if (!end.stroke || !on_outline (b, x, y) || !find_target (b, most, &end))
            continue;
          met = crossings (b, x, y, (int) b->breadth[end.stroke] + END_MARGIN, end.stroke);
          if (met > 1)
            continue;
          end.dab = met == 0;
          if (celd_append (*ends, *n, capacity, end) != CELD_OK)
            return CELD_NO_MEMORY;
        }
    }
  return CELD_OK;
}

CeldStatus
celd_contour_join (CeldContourBake *b, const CeldHost *host)
{
  End       *end = NULL;
  size_t     n = 0, joints = 0; /* the joints made so far are at the front of the list of ends */
  int        most = JOIN_DISTANCE + (b->width < b->height ? b->width : b->height) / JOIN_DIVISOR;
  CeldStatus status = find_ends (b, most, host, &end, &n);

  if (status == CELD_OK && n)
    qsort (end, n, sizeof *end, by_squared_distance);
  for (size_t i = 0; i < n && status == CELD_OK; i++)
    {
      End e = end[i];
      int steps = abs (e.to_x - e.x) > abs (e.to_y - e.y) ? abs (e.to_x - e.x) : abs (e.to_y - e.y);

      if (is_joined (b, &e, end, joints))
        continue;
      end[joints++] = e;
      for (int s = 1; s <= steps; s++)
        {
          int x = e.x + (int) lround ((double) s * (e.to_x - e.x) / steps);
          int y = e.y + (int) lround ((double) s * (e.to_y - e.y) / steps);

          celd_contour_stamp (&b->wall, x, y, 1);
        }
    }
  celd_free (end);
  return status;
}
