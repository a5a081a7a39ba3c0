/* Which of the chosen arrows are clear.
 *
 * An arrow is clear if every other choice that lacks it is clearly worse (search-margins.c), the paint round it is
 * explained, and something shows that it ends where it does.  What people would not be sure of is left out: two lines
 * that may be one, places close to each other, and lines that lie on each other.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/arrow-search.h"

#include <math.h>

/* All chosen; lengths are widths of the paint, areas square widths. */
#define ARROW_CLEAR_MARGIN 1    /* cost by which an arrow must be better than others */
#define ARROW_MOST_REST    0.5  /* area of unexplained paint round an arrow with a head, ... */
#define DOT_MOST_REST      0.25 /* ... or a dot, which is no wider: */
#define REST_ROOM          0.22 /* so far from the edge of the paint, because the width of lines varies, ... */
#define REST_REACH         1.5  /* ... so near the line, ... */
#define REST_ENDS          3.5  /* ... or so near its ends */
#define ARROW_LEAST_OWN    0.8  /* area of the paint of a head that no line explains */
#define ARROW_STRAIGHT     0.6  /* radians by which arrows turn that may go on */
#define ARROW_PASS_TURN    0.45 /* the same where one of several arrows may pass */
#define WAY_FROM           5    /* from the end of a line to where its direction is measured */
#define ARROW_APART        3.5  /* between places where arrows end, at least */
#define THROUGH            0.8  /* from a line to a place that it leads through ... */
#define THROUGH_FROM       6    /* ... so far from its ends */
#define ON_ANOTHER         0.5  /* between lines that lie on each other, ... */
#define MOST_ON_ANOTHER    6    /* ... for at most so long */
#define SHORTEST           6    /* length of an arrow */
#define MOST_OF_ARROW      8    /* cost of an arrow that is clear, ... */
#define MOST_OF_HEAD       1.2  /* ... of its head, ... */
#define MOST_OF_DOT        0.5  /* ... and of its dot */

/* The chosen arrows, and of each: its margin, and the area of its head or dot that no line explains (seen), and of that
 * what no other head does (own). */
typedef struct
{
  CeldArrowSearch       *s;
  const CeldJoinedLines *lines;
  const double          *margin;
  double                 own[CELD_MOST_CHOSEN], seen[CELD_MOST_CHOSEN];
} Clearness;

/* Finds what of heads and dots is seen, and their own; arrows share dots. */
static CeldStatus
find_own (Clearness *r)
{
  CeldArrowSearch *s = r->s;
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
                r->seen[i] += area;
                r->own[i] += s->dot || marks[c] == 1 ? area : 0;
              }
          }
      }
  celd_free (marks);
  return CELD_OK;
}

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

static double
rest_round (CeldArrowSearch *s, const CeldShaft *shaft)
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

/* Is one of the arrows that end at a place about straight on from arrow i? */
static bool
has_partner (const Clearness *r, size_t place, size_t i, CeldPoint way)
{
  const CeldArrowSearch *s = r->s;

  for (size_t k = 0; k < s->choice.n; k++)
    {
      const CeldShaft *shaft = celd_chosen_shaft (s, k);

      for (int end = 0; end < 2; end++)
        if (k != i && shaft->place[end] == place)
          {
            CeldPoint other = celd_shaft_way (shaft, end, WAY_FROM * s->width);

            if (way.x * other.x + way.y * other.y < -cos (ARROW_STRAIGHT))
              return true;
          }
    }
  return false;
}

/* Does something show that arrows end at a place: a head or dot, or one that cannot go on straight? */
static bool
is_shown (const Clearness *r, size_t place)
{
  const CeldArrowSearch *s = r->s;

  for (size_t k = 0; k < s->choice.n; k++)
    {
      const CeldArrowOption *o = &s->option[s->choice.item[k]];
      const CeldShaft       *shaft = &s->shaft[o->shaft];

      for (int end = 0; end < 2; end++)
        if (shaft->place[end] == place &&
            ((o->end == end && r->own[k] >= ARROW_LEAST_OWN) ||
             !has_partner (r, place, k, celd_shaft_way (shaft, end, WAY_FROM * s->width))))
          return true;
    }
  return false;
}

/* Is another place near where arrows end? */
static bool
is_apart (const CeldArrowSearch *s, size_t place)
{
  for (size_t p = 0; p < s->n_places; p++)
    if (p != place && s->arrows_at[p] && celd_points_apart (s->place[p], s->place[place]) < ARROW_APART * s->width)
      return false;
  return true;
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

/* Does an arrow lead through a place, far from its ends? */
static bool
leads_through (const CeldArrowSearch *s, size_t k, size_t place)
{
  const CeldShaft *shaft = celd_chosen_shaft (s, k);

  for (int end = 0; end < 2; end++)
    if (celd_points_apart (s->place[shaft->place[end]], s->place[place]) < THROUGH_FROM * s->width)
      return false;
  for (size_t i = 1; i < shaft->n; i++)
    if (celd_distance_to_part (s->place[place], shaft->at[i - 1], shaft->at[i]) < THROUGH * s->width)
      return true;
  return false;
}

/* Does an arrow lead through a place where two others do, too?  Three that cross in one place more likely end
 * there. */
static bool
is_crossed_twice (const Clearness *r, size_t i)
{
  for (size_t p = 0; p < r->s->n_places; p++)
    {
      int n = 0;

      for (size_t k = 0; k < r->s->choice.n && leads_through (r->s, i, p); k++)
        n += k != i && leads_through (r->s, k, p);
      if (n > 1)
        return true;
    }
  return false;
}

/* Do two arrows lie on each other for long?  Then one of them may be part of the other. */
static bool
is_on_another (const Clearness *r, size_t i)
{
  const CeldArrowSearch *s = r->s;
  const CeldShaft       *a = celd_chosen_shaft (s, i);

  for (size_t k = 0; k < s->choice.n; k++)
    {
      const CeldShaft *b = celd_chosen_shaft (s, k);
      size_t           n = 0;

      for (size_t j = 0; j < a->n && k != i; j++)
        {
          bool on = false;

          for (size_t l = 1; l < b->n && !on; l++)
            on = celd_distance_to_part (a->at[j], b->at[l - 1], b->at[l]) < ON_ANOTHER * s->width;
          n += on;
        }
      if (n > 1 && (double) (n - 1) * a->length / (double) (a->n - 1) > MOST_ON_ANOTHER * s->width)
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

  for (size_t m = 0; m < s->choice.n && s->dot; m++)
    {
      const CeldArrowOption *q = &s->option[s->choice.item[m]];

      if (m != k && s->shaft[q->shaft].place[q->end] == s->shaft[o->shaft].place[o->end])
        return true;
    }
  return r->own[k] < ARROW_LEAST_OWN;
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

static CeldArrowReason
why_unclear (const Clearness *r, size_t i)
{
  CeldArrowSearch       *s = r->s;
  const CeldArrowOption *o = &s->option[s->choice.item[i]];
  const CeldShaft       *shaft = &s->shaft[o->shaft];
  size_t                 tail = shaft->place[1 - o->end];

  if (shaft->length < SHORTEST * s->width)
    return CELD_REASON_SHORT;
  if (is_double (r, i) || r->seen[i] < ARROW_LEAST_OWN || o->mark_cost > (s->dot ? MOST_OF_DOT : MOST_OF_HEAD))
    return CELD_REASON_ALIKE;
  if (r->margin[i] < ARROW_CLEAR_MARGIN || s->passed[o->shaft] || o->cost > MOST_OF_ARROW ||
      rest_round (s, shaft) > (s->dot ? DOT_MOST_REST : ARROW_MOST_REST))
    return CELD_REASON_MEETING;
  for (int end = 0; end < 2; end++)
    if (!is_shown (r, shaft->place[end]) || !is_apart (s, shaft->place[end]))
      return CELD_REASON_MEETING;
  if (may_pass (r, i) || is_crossed_twice (r, i) || is_on_another (r, i))
    return CELD_REASON_MEETING;
  return s->arrows_at[tail] == 1 && celd_joined_is_at_frame (r->lines, s->place[tail]) ? CELD_REASON_FRAME
                                                                                       : CELD_REASON_NONE;
}

CeldStatus
celd_search_clear_find (CeldArrowSearch *search, const CeldJoinedLines *lines, const double *margin,
                        CeldArrowReason *unclear)
{
  Clearness  r = { .s = search, .lines = lines, .margin = margin };
  CeldStatus status = find_own (&r);

  for (size_t i = 0; i < search->choice.n && status == CELD_OK; i++)
    unclear[i] = why_unclear (&r, i);
  return status;
}
