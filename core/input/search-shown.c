/* What shows that arrows end where they do.
 *
 * An arrow that ends at a place without a head may be part of one that goes on straight from there, unless that would
 * have two heads.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/arrow-search.h"

#include <math.h>

/* All chosen. */
#define ARROW_STRAIGHT  0.75 /* radians by which arrows with heads turn that may go on, measured; ... */
#define DOT_STRAIGHT    0.6  /* ... those with dots, ... */
#define SHOWN_TURN      0.35 /* ... two whose place shows by that, if their line has two heads, ... */
#define FOUR_TURN       0.8  /* ... those of which four ends may be two lines that cross, ... */
#define ARROW_PASS_TURN 0.45 /* ... and those of which one may pass */
#define WAY_FROM        5    /* widths from the end of a line to where its direction is measured */

/* Is one of the arrows that end at a place straight on from arrow i, but for a turn? */
static bool
has_partner (const CeldClearness *r, size_t place, size_t i, CeldPoint way, double turn)
{
  const CeldArrowSearch *s = r->s;

  for (size_t k = 0; k < s->choice.n; k++)
    {
      const CeldShaft *shaft = celd_chosen_shaft (s, k);

      for (int end = 0; end < 2; end++)
        if (k != i && shaft->place[end] == place)
          {
            CeldPoint other = celd_shaft_way (shaft, end, WAY_FROM * s->width);

            if (way.x * other.x + way.y * other.y < -cos (turn))
              return true;
          }
    }
  return false;
}

/* Is the head or dot of an arrow seen at a place? */
static bool
is_marked (const CeldClearness *r, size_t place)
{
  const CeldArrowSearch *s = r->s;

  for (size_t k = 0; k < s->choice.n; k++)
    {
      const CeldArrowOption *o = &s->option[s->choice.item[k]];

      if (s->shaft[o->shaft].place[o->end] == place && r->paint.of_place[k] >= CELD_LEAST_OWN)
        return true;
    }
  return false;
}

/* Would the head or dot of arrow k be explained without it? */
static bool
is_mark_needless (const CeldClearness *r, size_t k)
{
  const CeldArrowSearch *s = r->s;
  const CeldArrowOption *o = &s->option[s->choice.item[k]];

  for (size_t m = 0; m < s->choice.n && s->style == CELD_ARROW_DOT; m++)
    {
      const CeldArrowOption *q = &s->option[s->choice.item[m]];

      if (m != k && s->shaft[q->shaft].place[q->end] == s->shaft[o->shaft].place[o->end])
        return true;
    }
  return r->paint.own[k] < CELD_LEAST_OWN;
}

/* May arrow i, which ends at a place with its end a, go on straight to another one that ends there?  An arrow has just
 * one head: a line with one at either end is two arrows that begin somewhere between, at this place if a third one
 * ends there or the line has a corner. */
static bool
may_go_on (const CeldClearness *r, size_t place, size_t i, int a, double turn)
{
  const CeldArrowSearch *s = r->s;
  CeldPoint              way = celd_shaft_way (celd_chosen_shaft (s, i), a, WAY_FROM * s->width);
  bool                   headed = s->style == CELD_ARROW_HEAD && s->option[s->choice.item[i]].end != a &&
                                  !is_mark_needless (r, i);

  for (size_t k = 0; k < s->choice.n; k++)
    for (int end = 0; end < 2; end++)
      {
        const CeldShaft *shaft = celd_chosen_shaft (s, k);
        bool             two = headed && s->option[s->choice.item[k]].end != end && !is_mark_needless (r, k);
        CeldPoint        other;
        double           cosine;

        if (k == i || shaft->place[end] != place)
          continue;
        other  = celd_shaft_way (shaft, end, WAY_FROM * s->width);
        cosine = way.x * other.x + way.y * other.y;
        if (cosine < -cos (turn) &&
            !(two && (s->arrows_at[place] > 2 || place >= s->n_undivided || cosine > -cos (SHOWN_TURN))))
          return true;
      }
  return false;
}

bool
celd_clear_is_shown (const CeldClearness *r, size_t place)
{
  const CeldArrowSearch *s = r->s;
  bool                   straight = false, bent = false;
  double                 turn = s->style == CELD_ARROW_DOT ? DOT_STRAIGHT : ARROW_STRAIGHT;

  if (is_marked (r, place))
    return true;
  for (size_t k = 0; k < s->choice.n; k++)
    {
      const CeldShaft *shaft = celd_chosen_shaft (s, k);

      for (int end = 0; end < 2; end++)
        if (shaft->place[end] == place)
          {
            if (may_go_on (r, place, k, end, turn))
              straight = true;
            else
              bent = true;
          }
    }
  return s->style == CELD_ARROW_DOT ? bent : !straight;
}

/* May arrow i, which ends at a place with its end a, and arrow k with its end b be one that passes there?  It would
 * have just one head or dot, so that of the other one must be needless; there is none if both have them at the
 * place. */
static bool
may_be_one (const CeldClearness *r, size_t i, int a, size_t k, int b)
{
  const CeldArrowSearch *s = r->s;
  const CeldArrowOption *o = &s->option[s->choice.item[i]], *q = &s->option[s->choice.item[k]];
  CeldPoint              u = celd_shaft_way (&s->shaft[o->shaft], a, WAY_FROM * s->width);
  CeldPoint              v = celd_shaft_way (&s->shaft[q->shaft], b, WAY_FROM * s->width);

  if (u.x * v.x + u.y * v.y >= -cos (ARROW_PASS_TURN) || (o->end == a && q->end == b))
    return false;
  if (o->end != a && q->end != b)
    return is_mark_needless (r, i) || is_mark_needless (r, k);
  return is_mark_needless (r, o->end == a ? i : k);
}

bool
celd_clear_may_pass (const CeldClearness *r, size_t i)
{
  const CeldArrowSearch *s = r->s;
  const CeldShaft       *a = celd_chosen_shaft (s, i);

  for (size_t k = 0; k < s->choice.n; k++)
    for (int ends = 0; ends < 4 && k != i; ends++)
      if (celd_chosen_shaft (s, k)->place[ends % 2] == a->place[ends / 2] &&
          may_be_one (r, i, ends / 2, k, ends % 2))
        return true;
  return false;
}

/* Do four arrows end at a place, each about straight on from another? */
static bool
is_crossing (const CeldClearness *r, size_t place)
{
  const CeldArrowSearch *s = r->s;

  for (size_t k = 0; k < s->choice.n; k++)
    for (int end = 0; end < 2; end++)
      if (celd_chosen_shaft (s, k)->place[end] == place &&
          !has_partner (r, place, k, celd_shaft_way (celd_chosen_shaft (s, k), end, WAY_FROM * s->width), FOUR_TURN))
        return false;
  return s->arrows_at[place] == 4;
}

bool
celd_clear_may_cross (const CeldClearness *r, size_t i)
{
  const CeldArrowSearch *s = r->s;
  const size_t          *place = celd_chosen_shaft (s, i)->place;

  for (int end = 0; end < 2; end++)
    if (!is_marked (r, place[end]) && s->arrows_at[place[end]] > 1 &&
        (celd_search_is_passed (s, place[end]) || is_crossing (r, place[end])))
      return true;
  return false;
}
