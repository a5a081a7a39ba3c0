/* Which of the chosen arrows are clear.
 *
 * An arrow is clear if every other choice that lacks it is worse by a margin (search-margins.c), the paint round it is
 * explained, and something shows that it ends where it does.  How large a margin is asked for depends on what else
 * speaks against the arrow, or for it: a head that others hide, a line that may go on, others that end where it does.
 * Where the graph of the lines gives the same arrow (joined-heads.c), hardly any margin is needed: both are seldom
 * wrong in the same way.  Arrows that fade or taper have no heads that others hide, so that less is asked for.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/arrow-search.h"

#include <math.h>

/* All chosen; lengths are widths of the paint, areas square widths, margins costs. */
#define CLEAR_MARGIN       1    /* of an arrow, ... */
#define CROWD_MARGIN       0.5  /* ... if others that are clear end at its tip, ... */
#define CROWD              2    /* ... so many at least: heads on each other have small margins; ... */
#define DOT_MARGIN         0.5  /* ... or if it has a dot, ... */
#define DOUBT_MARGIN       1    /* ... and more for each doubt */
#define AS_GOOD_MARGIN     0.02 /* of choices that are as good */
#define ARROW_MOST_REST    0.35 /* area of unexplained paint that is next to an arrow with a head, ... */
#define CERTAIN_MOST_REST  1    /* ... to one that is certain, ... */
#define CERTAIN_MARGIN     6    /* ... for it has so much of a margin, ... */
#define DOT_MOST_REST      0.25 /* ... or to one with a dot, which is no wider; ... */
#define TAIL_MOST_REST     0.5  /* ... and where one with a head begins, even if it is next to others, ... */
#define DOT_ROUND_REST     0.4  /* ... or all round one with a dot */
#define ARROW_LEAST_OWN    0.8  /* area of the paint of a head that no line explains */
#define ARROW_STRAIGHT     0.75 /* radians by which arrows with heads turn that may go on, measured; ... */
#define DOT_STRAIGHT       0.6  /* ... those with dots, ... */
#define FOUR_TURN          0.8  /* ... and where four ends may be two lines that cross */
#define ARROW_PASS_TURN    0.45 /* the same where one of several arrows may pass */
#define WAY_FROM           5    /* from the end of a line to where its direction is measured */
#define SHORTEST           7    /* length of an arrow */
#define PROFILE_MARGIN     2    /* of an arrow that fades or tapers, ... */
#define PROFILE_MOST_REST  1.5  /* ... and area of unexplained paint next to it */
#define MOST_OF_VALUES     0.8  /* cost of its values at its ends */
#define MOST_OF_ARROW      8    /* cost of an arrow that is clear, ... */
#define MOST_OF_HEAD       1.2  /* ... of its head, ... */
#define MOST_OF_DOT        0.5  /* ... and of its dot */

/* The chosen arrows, and of each: its margin, whether the graph gives it, too, and whether it is clear if others do not
 * count. */
typedef struct
{
  CeldArrowSearch       *s;
  const CeldJoinedLines *lines;
  const double          *margin;
  CeldChoicePaint        paint;
  bool                   agreed[CELD_MOST_CHOSEN], clear[CELD_MOST_CHOSEN];
} Clearness;

/* Finds which arrows the graph gives, too.  Where another choice is as good, it is unclear even so. */
static void
compare_with_graph (Clearness *r, CeldLineArrow *other)
{
  const CeldArrowSearch *s = r->s;
  double                 near = CELD_ONE_PLACE * s->width + 2;

  for (size_t i = 0; i < s->choice.n; i++)
    for (size_t k = 0; k < r->lines->graph.n_lines; k++)
      {
        const CeldArrowOption *o = &s->option[s->choice.item[i]];

        if (other[k].first != k || other[k].unclear ||
            celd_points_apart (other[k].nearer, celd_option_place (s, o, s->style == CELD_ARROW_DOT)) >= near ||
            celd_points_apart (other[k].farther, celd_option_place (s, o, s->style != CELD_ARROW_DOT)) >= near)
          continue;
        if (r->margin[i] < AS_GOOD_MARGIN)
          other[k].unclear = CELD_REASON_ALIKE;
        else
          r->agreed[i] = true;
      }
}

/* Is one of the arrows that end at a place straight on from arrow i, but for a turn? */
static bool
has_partner (const Clearness *r, size_t place, size_t i, CeldPoint way, double turn)
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
is_marked (const Clearness *r, size_t place)
{
  const CeldArrowSearch *s = r->s;

  for (size_t k = 0; k < s->choice.n; k++)
    {
      const CeldArrowOption *o = &s->option[s->choice.item[k]];

      if (s->shaft[o->shaft].place[o->end] == place && r->paint.of_place[k] >= ARROW_LEAST_OWN)
        return true;
    }
  return false;
}

/* Does something show that arrows end at a place: a head or dot, or that none of them can go on straight there?  Of
 * arrows with dots, one that cannot is enough. */
static bool
is_shown (const Clearness *r, size_t place)
{
  const CeldArrowSearch *s = r->s;
  bool                   straight = false, bent = false;
  double                 turn = s->style == CELD_ARROW_DOT ? DOT_STRAIGHT : ARROW_STRAIGHT;

  if (is_marked (r, place))
    return true;
  for (size_t k = 0; k < s->choice.n; k++)
    {
      const CeldArrowOption *o = &s->option[s->choice.item[k]];
      const CeldShaft       *shaft = &s->shaft[o->shaft];

      for (int end = 0; end < 2; end++)
        if (shaft->place[end] == place)
          {
            if (has_partner (r, place, k, celd_shaft_way (shaft, end, WAY_FROM * s->width), turn))
              straight = true;
            else
              bent = true;
          }
    }
  return s->style == CELD_ARROW_DOT ? bent : !straight;
}

/* Does another arrow lead from one of the places of arrow i to the other?  Then it may be one with two heads. */
static bool
is_double (const Clearness *r, size_t i)
{
  const CeldArrowSearch *s = r->s;
  const CeldShaft       *a = celd_chosen_shaft (s, i);
  double                 most = CELD_NEAR_ENDS * s->width + 1;

  for (size_t k = 0; k < s->choice.n; k++)
    for (int end = 0; end < 2 && k != i; end++)
      {
        const CeldShaft *b = celd_chosen_shaft (s, k);

        if (celd_points_apart (s->place[a->place[0]], s->place[b->place[end]]) < most &&
            celd_points_apart (s->place[a->place[1]], s->place[b->place[1 - end]]) < most)
          return true;
      }
  return false;
}

/* Would the head or dot of arrow k be explained without it? */
static bool
is_mark_needless (const Clearness *r, size_t k)
{
  const CeldArrowSearch *s = r->s;
  const CeldArrowOption *o = &s->option[s->choice.item[k]];

  for (size_t m = 0; m < s->choice.n && s->style == CELD_ARROW_DOT; m++)
    {
      const CeldArrowOption *q = &s->option[s->choice.item[m]];

      if (m != k && s->shaft[q->shaft].place[q->end] == s->shaft[o->shaft].place[o->end])
        return true;
    }
  return r->paint.own[k] < ARROW_LEAST_OWN;
}

/* May arrow i, which ends at a place with its end a, and arrow k with its end b be one that passes there?  It would
 * have just one head or dot, so that of the other one must be needless; there is none if both have them at the
 * place. */
static bool
may_be_one (const Clearness *r, size_t i, int a, size_t k, int b)
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

/* May arrow i and another one be one arrow that passes the place between them? */
static bool
may_pass (const Clearness *r, size_t i)
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
is_crossing (const Clearness *r, size_t place)
{
  const CeldArrowSearch *s = r->s;

  for (size_t k = 0; k < s->choice.n; k++)
    for (int end = 0; end < 2; end++)
      if (celd_chosen_shaft (s, k)->place[end] == place &&
          !has_partner (r, place, k, celd_shaft_way (celd_chosen_shaft (s, k), end, WAY_FROM * s->width), FOUR_TURN))
        return false;
  return s->arrows_at[place] == 4;
}

/* Does arrow i end with others, without a head or dot, where a third one passes, or where four ends look like a
 * crossing?  Then it may be part of one that crosses there. */
static bool
may_cross (const Clearness *r, size_t i)
{
  const CeldArrowSearch *s = r->s;
  const size_t          *place = celd_chosen_shaft (s, i)->place;

  for (int end = 0; end < 2; end++)
    if (!is_marked (r, place[end]) && s->arrows_at[place[end]] > 1 &&
        (celd_search_is_passed (s, place[end]) || is_crossing (r, place[end])))
      return true;
  return false;
}

/* ------------------------------------------------------------------ what is asked for */

/* Do other clear arrows end at the tip of arrow i? */
static bool
is_in_crowd (const Clearness *r, size_t i)
{
  const CeldArrowSearch *s = r->s;
  CeldPoint              tip = celd_option_place (s, &s->option[s->choice.item[i]], true);
  int                    n = 0;

  for (size_t k = 0; k < s->choice.n; k++)
    if (k != i && r->clear[k])
      {
        const size_t *place = celd_chosen_shaft (s, k)->place;

        n += fmin (celd_points_apart (s->place[place[0]], tip), celd_points_apart (s->place[place[1]], tip)) <
             CELD_ONE_PLACE * s->width;
      }
  return n >= CROWD;
}

/* Is a head or dot seen where arrow i has its own, be it that of another arrow?  If not, strokes without any may meet
 * there. */
static bool
is_any_seen (const Clearness *r, size_t i)
{
  const CeldArrowSearch *s = r->s;
  CeldPoint              tip = celd_option_place (s, &s->option[s->choice.item[i]], true);
  bool                   any = false;

  for (size_t k = 0; k < s->choice.n; k++)
    any |= r->paint.seen[k] >= ARROW_LEAST_OWN &&
           celd_points_apart (celd_option_place (s, &s->option[s->choice.item[k]], true), tip) < CELD_ONE_PLACE * s->width;
  return any;
}

/* The margin that an arrow needs to be clear; INFINITY: none would do. */
static double
margin_needed (const Clearness *r, size_t i)
{
  int doubts = (r->paint.seen[i] < ARROW_LEAST_OWN) + may_pass (r, i) + celd_chosen_is_on_another (r->s, i);

  if (!is_any_seen (r, i))
    return INFINITY;
  if (doubts)
    return CLEAR_MARGIN + doubts * DOUBT_MARGIN;
  return r->s->style == CELD_ARROW_DOT ? DOT_MARGIN : is_in_crowd (r, i) ? CROWD_MARGIN : CLEAR_MARGIN;
}

/* Does nothing round an arrow speak against it, whatever its margin? */
static bool
is_explained (const Clearness *r, size_t i)
{
  const CeldArrowSearch *s = r->s;
  const CeldShaft       *shaft = celd_chosen_shaft (s, i);
  double                 most = s->style == CELD_ARROW_DOT ? DOT_MOST_REST
                                : r->margin[i] < CERTAIN_MARGIN ? ARROW_MOST_REST
                                : CERTAIN_MOST_REST;

  return r->paint.rest[i] <= most && celd_search_is_apart (s, shaft->place[0]) &&
         celd_search_is_apart (s, shaft->place[1]) && !celd_chosen_is_crossed_twice (s, i);
}

/* The same for an arrow that fades or tapers. */
static CeldArrowReason
why_profile_unclear (const Clearness *r, size_t i)
{
  const CeldArrowSearch *s = r->s;
  const CeldArrowOption *o = &s->option[s->choice.item[i]];
  const CeldShaft       *shaft = &s->shaft[o->shaft];

  if (is_double (r, i))
    return CELD_REASON_ALIKE;
  if (r->paint.rest[i] > PROFILE_MOST_REST || s->passed[o->shaft] || !celd_search_is_apart (s, shaft->place[0]) ||
      !celd_search_is_apart (s, shaft->place[1]))
    return CELD_REASON_MEETING;
  if (r->agreed[i])
    return CELD_REASON_NONE;
  if (o->mark_cost > MOST_OF_VALUES)
    return CELD_REASON_ALIKE;
  if (shaft->length < SHORTEST * s->width)
    return CELD_REASON_SHORT;
  return !celd_search_shows_end (s, shaft->place[0]) || !celd_search_shows_end (s, shaft->place[1]) ||
         celd_chosen_is_crossed_twice (s, i) || celd_chosen_passes_end (s, i) || celd_chosen_is_on_another (s, i) ||
         r->margin[i] < PROFILE_MARGIN ? CELD_REASON_MEETING : CELD_REASON_NONE;
}

static CeldArrowReason
why_unclear (const Clearness *r, size_t i)
{
  const CeldArrowSearch *s = r->s;
  const CeldArrowOption *o = &s->option[s->choice.item[i]];
  const CeldShaft       *shaft = &s->shaft[o->shaft];
  size_t                 tail = shaft->place[1 - o->end];
  bool                   dot = s->style == CELD_ARROW_DOT;

  if (celd_search_has_profiles (s))
    return why_profile_unclear (r, i);
  if (is_double (r, i))
    return CELD_REASON_ALIKE;
  if (!(dot && r->agreed[i]) && (!is_shown (r, shaft->place[0]) || !is_shown (r, shaft->place[1])))
    return CELD_REASON_MEETING;
  if (may_cross (r, i))
    return CELD_REASON_MEETING;
  if (r->agreed[i])
    return is_explained (r, i) && !celd_chosen_is_on_another (s, i) ? CELD_REASON_NONE : CELD_REASON_MEETING;
  if (shaft->length < SHORTEST * s->width)
    return CELD_REASON_SHORT;
  if (o->mark_cost > (dot ? MOST_OF_DOT : MOST_OF_HEAD))
    return CELD_REASON_ALIKE;
  if (o->cost > MOST_OF_ARROW || s->passed[o->shaft] || celd_chosen_passes_end (s, i) || !is_explained (r, i) ||
      (dot ? celd_rest_round (r->s, shaft) > DOT_ROUND_REST : celd_rest_near (r->s, tail) > TAIL_MOST_REST))
    return CELD_REASON_MEETING;
  if (r->margin[i] < margin_needed (r, i))
    return r->paint.seen[i] < ARROW_LEAST_OWN ? CELD_REASON_ALIKE : CELD_REASON_MEETING;
  return s->arrows_at[tail] == 1 && celd_joined_is_at_frame (r->lines, s->place[tail]) ? CELD_REASON_FRAME
                                                                                       : CELD_REASON_NONE;
}

CeldStatus
celd_search_clear_find (CeldArrowSearch *search, const CeldJoinedLines *lines, CeldLineArrow *other,
                        const double *margin, CeldArrowReason *unclear)
{
  Clearness  r = { .s = search, .lines = lines, .margin = margin };
  CeldStatus status = celd_choice_paint_measure (search, &r.paint);

  if (status != CELD_OK)
    return status;
  compare_with_graph (&r, other);
  for (size_t i = 0; i < search->choice.n; i++)
    unclear[i] = why_unclear (&r, i);
  for (size_t i = 0; i < search->choice.n; i++)
    r.clear[i] = !unclear[i];
  for (size_t i = 0; i < search->choice.n; i++)
    unclear[i] = why_unclear (&r, i);
  return CELD_OK;
}
