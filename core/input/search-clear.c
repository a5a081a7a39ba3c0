/* Which of the chosen arrows are clear.
 *
 * An arrow is clear if every other choice that lacks it is worse by a margin (search-margins.c), the paint round it is
 * explained, and something shows that it ends where it does (search-shown.c).  How large a margin is asked for depends
 * on what else speaks against the arrow, or for it: a head that others hide, a line that may go on, others that end
 * where it does.  Where the graph of the lines gives the same arrow (joined-heads.c), hardly any margin is needed: both
 * are seldom wrong in the same way.  Arrows that fade or taper have no heads that others hide, so that less is asked for.
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
#define DOUBT_MARGIN       1    /* ... and more for each doubt, ... */
#define MAY_PASS_MARGIN    0.5  /* ... or for one that may pass, because its end is marked by others */
#define SHORT_MARGIN       2    /* of a short arrow with a head, ... */
#define NEAR_MARGIN        2    /* ... or of one with a head or dot that ends near others, but not where they do */
#define AS_GOOD_MARGIN     0.02 /* of choices that are as good */
#define ARROW_MOST_REST    0.35 /* area of unexplained paint that is next to an arrow with a head, ... */
#define CERTAIN_MOST_REST  1    /* ... to one that is certain, ... */
#define CERTAIN_MARGIN     6    /* ... for it has so much of a margin, ... */
#define DOT_MOST_REST      0.25 /* ... or to one with a dot, which is no wider; ... */
#define DOT_ROUND_REST     0.4  /* ... or all round one with a dot, ... */
#define HEAD_ROUND_REST    0.3  /* ... or with a head, unless its margin ... */
#define ROUND_MARGIN       3    /* ... is so large */
#define SHORTEST           7    /* length of an arrow */
#define PROFILE_MARGIN     2    /* of an arrow that fades or tapers, ... */
#define PROFILE_MOST_REST  1.5  /* ... and area of unexplained paint next to it, ... */
#define PROFILE_MORE_REST  3    /* ... or next to one that is certain */
#define MOST_OF_VALUES     0.8  /* cost of its values at its ends */
#define MOST_OF_ARROW      8    /* cost of an arrow that is clear, ... */
#define MOST_OF_HEAD       1.6  /* ... of its head, ... */
#define MOST_OF_DOT        0.5  /* ... and of its dot */

/* Finds which arrows the graph gives, too.  Where another choice is as good, it is unclear even so. */
static void
compare_with_graph (CeldClearness *r, CeldLineArrow *other)
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

/* Does another arrow lead from one of the places of arrow i to the other?  Then it may be one with two heads. */
static bool
is_double (const CeldClearness *r, size_t i)
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

/* ------------------------------------------------------------------ what is asked for */

/* Do other clear arrows end at the tip of arrow i? */
static bool
is_in_crowd (const CeldClearness *r, size_t i)
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
is_any_seen (const CeldClearness *r, size_t i)
{
  const CeldArrowSearch *s = r->s;
  CeldPoint              tip = celd_option_place (s, &s->option[s->choice.item[i]], true);
  bool                   any = false;

  for (size_t k = 0; k < s->choice.n; k++)
    any |= r->paint.seen[k] >= CELD_LEAST_OWN &&
           celd_points_apart (celd_option_place (s, &s->option[s->choice.item[k]], true), tip) < CELD_ONE_PLACE * s->width;
  return any;
}

/* The margin that an arrow needs to be clear; INFINITY: none would do. */
static double
margin_needed (const CeldClearness *r, size_t i)
{
  bool   hidden = r->paint.seen[i] < CELD_LEAST_OWN, pass = celd_clear_may_pass (r, i);
  double more = (hidden ? DOUBT_MARGIN : 0) +
                (pass ? r->s->style == CELD_ARROW_HEAD ? MAY_PASS_MARGIN : DOUBT_MARGIN : 0);

  if (!is_any_seen (r, i))
    return INFINITY;
  if (more > 0)
    return CLEAR_MARGIN + more;
  return r->s->style == CELD_ARROW_DOT ? DOT_MARGIN : is_in_crowd (r, i) ? CROWD_MARGIN : CLEAR_MARGIN;
}

/* May arrow i end where others do that are near its ends?  Those that fade or taper do so less plainly. */
static bool
may_end_near (const CeldClearness *r, size_t i)
{
  const size_t *place = celd_chosen_shaft (r->s, i)->place;

  return r->margin[i] < (celd_search_has_profiles (r->s) ? CERTAIN_MARGIN : NEAR_MARGIN) &&
         !(celd_search_is_apart (r->s, place[0]) && celd_search_is_apart (r->s, place[1]));
}

/* Does nothing round an arrow speak against it, whatever its margin? */
static bool
is_explained (const CeldClearness *r, size_t i)
{
  const CeldArrowSearch *s = r->s;
  double                 most = s->style == CELD_ARROW_DOT ? DOT_MOST_REST
                                : r->margin[i] < CERTAIN_MARGIN ? ARROW_MOST_REST
                                : CERTAIN_MOST_REST;

  return r->paint.rest[i] <= most && !may_end_near (r, i) && !celd_chosen_is_crossed_twice (s, i);
}

/* Why an arrow that fades or tapers is unclear. */
static CeldArrowReason
why_profile_unclear (const CeldClearness *r, size_t i)
{
  const CeldArrowSearch *s = r->s;
  const CeldArrowOption *o = &s->option[s->choice.item[i]];
  const CeldShaft       *shaft = &s->shaft[o->shaft];
  bool                   certain = r->margin[i] >= CERTAIN_MARGIN;

  if (is_double (r, i))
    return CELD_REASON_ALIKE;
  if (r->paint.rest[i] > (certain ? PROFILE_MORE_REST : PROFILE_MOST_REST) || s->passed[o->shaft] ||
      may_end_near (r, i))
    return CELD_REASON_MEETING;
  if (r->agreed[i])
    return CELD_REASON_NONE;
  if (o->mark_cost > MOST_OF_VALUES)
    return CELD_REASON_ALIKE;
  if (shaft->length < SHORTEST * s->width)
    return CELD_REASON_SHORT;
  return !celd_search_shows_end (s, shaft->place[0]) || !celd_search_shows_end (s, shaft->place[1]) ||
         (celd_chosen_is_crossed_twice (s, i) && !certain) || celd_chosen_passes_end (s, i) ||
         r->margin[i] < PROFILE_MARGIN ? CELD_REASON_MEETING : CELD_REASON_NONE;
}

static CeldArrowReason
why_unclear (const CeldClearness *r, size_t i)
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
  if (!(dot && r->agreed[i]) && (!celd_clear_is_shown (r, shaft->place[0]) || !celd_clear_is_shown (r, shaft->place[1])))
    return CELD_REASON_MEETING;
  if (celd_clear_may_cross (r, i))
    return CELD_REASON_MEETING;
  if (r->agreed[i])
    return is_explained (r, i) ? CELD_REASON_NONE : CELD_REASON_MEETING;
  if (shaft->length < SHORTEST * s->width && (dot || r->margin[i] < SHORT_MARGIN))
    return CELD_REASON_SHORT;
  if (o->mark_cost > (dot ? MOST_OF_DOT : MOST_OF_HEAD))
    return CELD_REASON_ALIKE;
  if (o->cost > MOST_OF_ARROW || s->passed[o->shaft] || celd_chosen_passes_end (s, i) || !is_explained (r, i) ||
      ((dot || r->margin[i] < ROUND_MARGIN) &&
       celd_rest_round (r->s, shaft) > (dot ? DOT_ROUND_REST : HEAD_ROUND_REST)))
    return CELD_REASON_MEETING;
  if (r->margin[i] < margin_needed (r, i))
    return r->paint.seen[i] < CELD_LEAST_OWN ? CELD_REASON_ALIKE : CELD_REASON_MEETING;
  return s->arrows_at[tail] == 1 && celd_joined_is_at_frame (r->lines, s->place[tail]) ? CELD_REASON_FRAME
                                                                                       : CELD_REASON_NONE;
}

CeldStatus
celd_search_clear_find (CeldArrowSearch *search, const CeldJoinedLines *lines, CeldLineArrow *other,
                        const double *margin, CeldArrowReason *unclear)
{
  CeldClearness r = { .s = search, .lines = lines, .margin = margin };
  CeldStatus    status = celd_choice_paint_measure (search, &r.paint);

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
