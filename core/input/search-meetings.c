/* How chosen arrows meet: where they end near others, pass them, or lie on them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/arrow-search.h"

/* All chosen; lengths are widths of the paint. */
#define ARROW_APART     3.5 /* between ends of arrows that are not at one place, at least */
#define PASS_APART      2   /* from a line to a place where others end, at least, ... */
#define PASS_APART_FROM 3   /* ... so far from the ends of the line */
#define THROUGH         0.8 /* from a line to a place that it leads through ... */
#define THROUGH_FROM    6   /* ... so far from its ends */
#define ON_ANOTHER      0.5 /* between lines that lie on each other, ... */
#define MOST_ON_ANOTHER 6   /* ... for at most so long */

bool
celd_search_is_apart (const CeldArrowSearch *s, size_t place)
{
  for (size_t p = 0; p < s->n_places; p++)
    {
      double d = celd_points_apart (s->place[p], s->place[place]);

      if (s->arrows_at[p] && d >= CELD_ONE_PLACE * s->width && d < ARROW_APART * s->width)
        return false;
    }
  return true;
}

/* Does an arrow lead through a place, up to a distance, so far from its ends? */
static bool
leads_through (const CeldArrowSearch *s, size_t k, size_t place, double distance, double from)
{
  const CeldShaft *shaft = celd_chosen_shaft (s, k);

  for (int end = 0; end < 2; end++)
    if (celd_points_apart (s->place[shaft->place[end]], s->place[place]) < from * s->width)
      return false;
  return celd_distance_to_shaft (shaft, s->place[place]) < distance * s->width;
}

bool
celd_chosen_passes_end (const CeldArrowSearch *s, size_t i)
{
  for (size_t p = 0; p < s->n_places; p++)
    if (s->arrows_at[p] && leads_through (s, i, p, PASS_APART, PASS_APART_FROM))
      return true;
  return false;
}

bool
celd_chosen_is_crossed_twice (const CeldArrowSearch *s, size_t i)
{
  for (size_t p = 0; p < s->n_places; p++)
    {
      int n = 0;

      for (size_t k = 0; k < s->choice.n && leads_through (s, i, p, THROUGH, THROUGH_FROM); k++)
        n += k != i && leads_through (s, k, p, THROUGH, THROUGH_FROM);
      if (n > 1)
        return true;
    }
  return false;
}

bool
celd_chosen_is_on_another (const CeldArrowSearch *s, size_t i)
{
  const CeldShaft *a = celd_chosen_shaft (s, i);

  for (size_t k = 0; k < s->choice.n; k++)
    {
      const CeldShaft *b = celd_chosen_shaft (s, k);
      size_t           n = 0;

      for (size_t j = 0; j < a->n && k != i; j++)
        n += celd_distance_to_shaft (b, a->at[j]) < ON_ANOTHER * s->width;
      if (n > 1 && (double) (n - 1) * a->length / (double) (a->n - 1) > MOST_ON_ANOTHER * s->width)
        return true;
    }
  return false;
}
