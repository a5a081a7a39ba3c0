/* How chosen arrows meet: whether something shows that they end, and where they end near others or pass them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/arrow-search.h"

#include <math.h>

/* All chosen; lengths are widths of the paint. */
#define END_FROM        5   /* from the end of a line to where its direction is measured */
#define ON_FROM_END     0.6 /* radians by which an arrow may turn that fades or tapers and goes on, ... */
#define IN_LINE_TURN    0.45 /* ... and those by which two turn that meet in a line */
#define AHEAD           1.5 /* from the end of a line to where paint is looked for straight on, ... */
#define AHEAD_MORE      1   /* ... and so much farther */
#define END_JUMP        0.35 /* by which a tail is stronger than a tip beside it, at least */
#define WEAK_END        0.3 /* strength of two tips that meet, at most */
#define ARROW_APART     3.5 /* between ends of arrows that are not at one place, at least */
#define PASS_APART      2   /* from a line to a place where others end, at least, ... */
#define PASS_APART_FROM 3   /* ... so far from the ends of the line */
#define THROUGH         0.8 /* from a line to a place that it leads through ... */
#define THROUGH_FROM    6   /* ... so far from its ends */

/* An end of a chosen arrow; tip: is it the weak one? */
typedef struct { CeldPoint way; double value; bool tip; } ChosenEnd;

/* Fills in end number k of the chosen arrows; false if it is not at a place. */
static bool
is_end_at (const CeldArrowSearch *s, size_t k, size_t place, ChosenEnd *end)
{
  const CeldArrowOption *o = &s->option[s->choice.item[k / 2]];
  int                    side = (int) (k % 2);

  *end = (ChosenEnd) { .tip = o->end == side, .value = o->value[o->end == side] };
  if (s->shaft[o->shaft].place[side] != place)
    return false;
  end->way = celd_shaft_way (&s->shaft[o->shaft], side, END_FROM * s->width);
  return true;
}

/* Do an end and one straight on from it show by their values that both end there? */
static bool
show_ends (const ChosenEnd *one, const ChosenEnd *other)
{
  if (one->tip && other->tip)
    return fmax (one->value, other->value) < WEAK_END;
  return one->tip && other->value - one->value >= END_JUMP;
}

/* Does paint go on straight beyond an end? */
static bool
is_paint_ahead (const CeldArrowSearch *s, size_t place, const ChosenEnd *end)
{
  for (int k = 0; k < 2; k++)
    if (celd_search_room (s, celd_moved (s->place[place], end->way, (AHEAD + k * AHEAD_MORE) * s->width)) <= 0)
      return false;
  return true;
}

/* Does end number k of the chosen arrows, which is at a place, show that arrows end there? */
static bool
shows_end (const CeldArrowSearch *s, size_t k, size_t place, const ChosenEnd *end)
{
  bool straight = false;

  for (size_t m = 0; m < 2 * s->choice.n; m++)
    {
      ChosenEnd other;
      double    cosine;

      if (m / 2 == k / 2 || !is_end_at (s, m, place, &other))
        continue;
      cosine   = -(end->way.x * other.way.x + end->way.y * other.way.y);
      straight = straight || cosine > cos (ON_FROM_END);
      if (cosine > cos (IN_LINE_TURN) && show_ends (end, &other))
        return true;
    }
  return !straight && !is_paint_ahead (s, place, end);
}

bool
celd_search_shows_end (const CeldArrowSearch *s, size_t place)
{
  ChosenEnd end;

  for (size_t k = 0; k < 2 * s->choice.n; k++)
    if (is_end_at (s, k, place, &end) && shows_end (s, k, place, &end))
      return true;
  return false;
}

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
celd_search_is_passed (const CeldArrowSearch *s, size_t place)
{
  for (size_t k = 0; k < s->choice.n; k++)
    if (leads_through (s, k, place, PASS_APART, PASS_APART_FROM))
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
