/* The paint of the chosen arrows: what they leave unexplained, and what is seen of their heads and dots.
 *
 * Paint near an edge does not count as unexplained, because the width of lines varies.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/arrow-search.h"

#include <math.h>

/* Widths of the paint; all chosen. */
#define REST_ROOM  0.22 /* from the edge of the paint to what counts as unexplained */
#define REST_REACH 1.5  /* from a line to unexplained paint round it, ... */
#define REST_ENDS  3.5  /* ... and from its ends */

/* Finds what of heads and dots is seen, and their own; arrows share dots. */
static CeldStatus
find_own (CeldArrowSearch *s, CeldChoicePaint *paint)
{
  uint16_t        *marks = celd_alloc0 ((size_t) s->columns * (size_t) s->rows, sizeof *marks);
  double           area = s->step * s->step / (s->width * s->width);

  if (!marks)
    return CELD_NO_MEMORY;
  for (int pass = 0; pass < 2; pass++)
    for (size_t i = 0; i < s->choice.n; i++)
      {
        const CeldPaintPiece *mark = &s->piece[s->option[s->choice.item[i]].mark];

        for (size_t k = 0; k < mark->n; k++)
          {
            size_t c = mark->cell[k];

            if (!pass)
              marks[c]++;
            else if (s->covers[c] == marks[c])
              {
                paint->seen[i] += area;
                paint->own[i] += s->dot || marks[c] == 1 ? area : 0;
              }
          }
      }
  celd_free (marks);
  return CELD_OK;
}

/* Finds the unexplained paint that is nearer to each arrow than to others. */
static void
find_rest (CeldArrowSearch *s, CeldChoicePaint *paint)
{
  for (int y = 0; y < s->rows; y++)
    for (int x = 0; x < s->columns; x++)
      {
        size_t    c = (size_t) y * (size_t) s->columns + (size_t) x, nearest = 0;
        CeldPoint p = { (x + 0.5) * s->step, (y + 0.5) * s->step };
        double    least = INFINITY;

        if (!s->painted[c] || s->covers[c] || celd_search_room (s, p) <= REST_ROOM * s->width)
          continue;
        for (size_t k = 0; k < s->choice.n; k++)
          {
            double d = celd_distance_to_shaft (celd_chosen_shaft (s, k), p);

            if (d < least)
              {
                least   = d;
                nearest = k;
              }
          }
        paint->rest[nearest] += s->step * s->step / (s->width * s->width);
      }
}

/* ------------------------------------------------------------------ round one arrow */

/* The area of unexplained paint within a distance of a point that is not counted yet. */
static double
rest_at (CeldArrowSearch *s, CeldPoint p, double reach)
{
  double rest = 0;

  for (double y = p.y - reach; y <= p.y + reach; y += s->step)
    for (double x = p.x - reach; x <= p.x + reach; x += s->step)
      {
        size_t    c = celd_search_cell (s, (CeldPoint) { x, y });
        CeldPoint centre;

        if (c == SIZE_MAX || !s->painted[c] || s->covers[c] || s->stamp[c] == s->tick ||
            hypot (x - p.x, y - p.y) > reach)
          continue;
        s->stamp[c] = s->tick;
        centre = (CeldPoint) { ((double) (c % (size_t) s->columns) + 0.5) * s->step,
                               ((double) (c / (size_t) s->columns) + 0.5) * s->step };
        if (celd_search_room (s, centre) > REST_ROOM * s->width)
          rest += s->step * s->step / (s->width * s->width);
      }
  return rest;
}

double
celd_rest_round (CeldArrowSearch *s, const CeldShaft *shaft)
{
  double rest = 0;

  s->tick++;
  for (int end = 0; end < 2; end++)
    rest += rest_at (s, s->place[shaft->place[end]], REST_ENDS * s->width);
  for (size_t i = 1; i < shaft->n; i++)
    for (int k = 0; k < 4; k++)
      rest += rest_at (s, celd_search_between (shaft->at[i - 1], shaft->at[i], 0.25 * k), REST_REACH * s->width);
  return rest;
}

/* ------------------------------------------------------------------ of all */

CeldStatus
celd_choice_paint_measure (CeldArrowSearch *s, CeldChoicePaint *paint)
{
  *paint = (CeldChoicePaint) { 0 };
  find_rest (s, paint);
  return find_own (s, paint);
}
