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

/* Adds `more` to the count of each cell that heads or dots have which are where that of arrow i is. */
static void
count_marks (const CeldArrowSearch *s, size_t i, uint16_t *count, int more)
{
  const CeldArrowOption *o = &s->option[s->choice.item[i]];

  for (size_t k = 0; k < s->choice.n; k++)
    {
      const CeldArrowOption *q = &s->option[s->choice.item[k]];

      if (s->shaft[q->shaft].place[q->end] == s->shaft[o->shaft].place[o->end])
        for (size_t c = 0; c < s->piece[q->mark].n; c++)
          count[s->piece[q->mark].cell[c]] = (uint16_t) (count[s->piece[q->mark].cell[c]] + more);
    }
}

/* Finds what of heads and dots is seen, their own, and what is of them and others at the same place; arrows share
 * dots. */
static CeldStatus
find_own (CeldArrowSearch *s, CeldChoicePaint *paint)
{
  size_t    n = celd_search_cells (s);
  uint16_t *all = celd_alloc0 (n, sizeof *all), *here = celd_alloc0 (n, sizeof *here);
  double    area = s->cell;

  for (size_t i = 0; all && here && i < s->choice.n; i++)
    for (size_t k = 0; k < s->piece[s->option[s->choice.item[i]].mark].n; k++)
      all[s->piece[s->option[s->choice.item[i]].mark].cell[k]]++;
  for (size_t i = 0; all && here && i < s->choice.n; i++)
    {
      const CeldPaintPiece *mark = &s->piece[s->option[s->choice.item[i]].mark];

      count_marks (s, i, here, 1);
      for (size_t k = 0; k < mark->n; k++)
        {
          size_t c = mark->cell[k];

          if (s->covers[c] != all[c])
            continue;
          paint->of_place[i] += all[c] == here[c] ? area : 0;
          if (c >= celd_search_plane (s)) /* where many lines meet, their paint is as wide as a dot */
            continue;
          paint->seen[i] += area;
          paint->own[i] += s->style == CELD_ARROW_DOT || all[c] == 1 ? area : 0;
        }
      count_marks (s, i, here, -1);
    }
  celd_free (all);
  celd_free (here);
  return all && here ? CELD_OK : CELD_NO_MEMORY;
}

/* In how many levels of a cell there is paint that nothing explains. */
static int
bare_levels (const CeldArrowSearch *s, size_t c)
{
  int n = 0;

  for (; c < celd_search_cells (s); c += celd_search_plane (s))
    n += s->painted[c] && !s->covers[c];
  return n;
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

        if (!bare_levels (s, c) || celd_search_room (s, p) <= REST_ROOM * s->width)
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
        paint->rest[nearest] += bare_levels (s, c) * s->cell;
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
