/* How much better chosen arrows are than others in their place.
 *
 * Other choices are looked for on purpose: without each arrow, with each turned round and what that entails, with
 * arrows that end at each place, and without any that do.  An arrow's margin is what the best of those costs more that
 * does not have it.  Should one cost less than the choice itself, it is taken instead.
 *
 * Where several lines meet, their paint is nearly as wide as a dot.  A dot that is neither all painted nor leaves the
 * paint of the lines is not there: arrows that begin in such a place are not looked for.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/arrow-search.h"

#include <math.h>

#define RESTARTS       4  /* times that a better choice is taken, at most; chosen */
#define TURNED         7  /* arrows that are turned round one after another; chosen */
#define DOUBLED        3  /* the same for an arrow with two heads; chosen */
#define HOPELESS       14 /* cost by which a choice is too much worse to go on from; chosen */
#define NO_DOT_BARE    0.1 /* cost of what is not painted of a dot that is not there, at least, and ... */
#define NO_DOT_OWN     0.4 /* ... its area that no line explains, at most, in square widths; measured: so it was at no
                            * dot of 900, and at most places without one */
#define MARGIN_LEAST   99 /* margin of an arrow that is in all choices */
#define MARGIN_SMALLER 1e-3

typedef struct { CeldArrowSearch *s; CeldArrowChoice best, better; double *margin; } Margins;

/* Does the choice have an arrow like an option? */
static bool
has (const CeldArrowSearch *s, size_t option)
{
  bool found = s->chosen[option];

  for (size_t k = 0; k < s->choice.n && !found; k++)
    found = celd_options_alike (s, option, s->choice.item[k]);
  return found;
}

/* Compares the choice with the best one. */
static void
note (Margins *m)
{
  double more = m->s->choice.cost - m->best.cost;

  for (size_t i = 0; i < m->best.n; i++)
    if (more < m->margin[i] && !has (m->s, m->best.item[i]))
      m->margin[i] = more;
  if (m->s->choice.cost < m->better.cost - MARGIN_SMALLER)
    m->better = m->s->choice;
}

/* The best choice without an arrow. */
static void
leave_out (Margins *m, size_t option)
{
  CeldArrowSearch *s = m->s;

  for (int on = 1; on >= 0; on--)
    {
      for (size_t k = 0; k < s->n_options; k++)
        if (celd_options_alike (s, k, option))
          s->banned[k] = (uint16_t) (s->banned[k] + (on ? 1 : -1));
      if (!on)
        break;
      for (size_t i = s->choice.n; i-- > 0;)
        if (s->banned[s->choice.item[i]])
          celd_search_leave (s, s->choice.item[i]);
      celd_search_add (s, 4);
      note (m);
      celd_search_improve_near (s, option);
      note (m);
    }
  celd_search_restore (s, &m->best);
}

/* The cheapest option along the same shaft in the other direction; the option itself is not chosen now. */
static size_t
turned_round (CeldArrowSearch *s, size_t option, double *change)
{
  size_t best = SIZE_MAX;

  *change = INFINITY;
  for (size_t k = 0; k < s->n_options; k++)
    if (s->option[k].shaft == s->option[option].shaft && s->option[k].end != s->option[option].end && !s->chosen[k] &&
        !s->banned[k] && s->option[k].filled == s->option[option].filled && celd_search_change (s, k) < *change)
      {
        *change = celd_search_change (s, k);
        best    = k;
      }
  return best;
}

static bool
share_place (const CeldArrowSearch *s, size_t a, size_t b)
{
  const size_t *p = s->shaft[s->option[a].shaft].place, *q = s->shaft[s->option[b].shaft].place;

  return p[0] == q[0] || p[0] == q[1] || p[1] == q[0] || p[1] == q[1];
}

/* Of the arrows that end where turned ones do, the one that is best turned next; SIZE_MAX = there is none. */
static size_t
next_to_turn (CeldArrowSearch *s, const size_t *turned, int n)
{
  CeldArrowChoice now = s->choice;
  size_t          best = SIZE_MAX;
  double          least = INFINITY;

  for (size_t i = 0; i < now.n; i++)
    {
      size_t k = now.item[i];
      bool   near = false, done = false;
      double change, left;

      for (int q = 0; q < n; q++)
        {
          done |= s->option[turned[q]].shaft == s->option[k].shaft;
          near |= share_place (s, turned[q], k);
        }
      if (done || !near)
        continue;
      celd_search_leave (s, k);
      left = s->choice.cost;
      turned_round (s, k, &change);
      celd_search_choose (s, k);
      if (left + change < least)
        {
          least = left + change;
          best  = k;
        }
    }
  s->choice = now;
  return best;
}

/* Turns an arrow round, and then others that are turned best. */
static void
turn (Margins *m, size_t option)
{
  CeldArrowSearch *s = m->s;
  size_t           turned[TURNED];
  double           change;

  for (int n = 0; n < TURNED && option != SIZE_MAX; n++)
    {
      size_t other;

      celd_search_leave (s, option);
      other = turned_round (s, option, &change);
      if (other == SIZE_MAX)
        break;
      celd_search_choose (s, other);
      turned[n] = other;
      note (m);
      if (s->choice.cost > m->best.cost + HOPELESS)
        break;
      option = next_to_turn (s, turned, n + 1);
    }
  celd_search_restore (s, &m->best);
}

/* Gives an arrow a second head, at its other end, and turns round what had that head before.  Should that cost little
 * more, the line may be two arrows that begin somewhere along it. */
static void
give_two_heads (Margins *m, size_t i)
{
  CeldArrowSearch       *s = m->s;
  size_t                 option = m->best.item[i], turned[DOUBLED];
  const CeldArrowOption *o = &s->option[option];
  double                 change, shaft = o->cost - o->mark_cost + CELD_SAME_COST;

  for (int n = 0; n < DOUBLED; n++)
    {
      if (n)
        celd_search_leave (s, option);
      turned[n] = turned_round (s, option, &change);
      if (turned[n] == SIZE_MAX)
        break;
      celd_search_choose (s, turned[n]);
      if (n)
        m->margin[i] = fmin (m->margin[i], s->choice.cost - shaft - m->best.cost);
      option       = next_to_turn (s, turned, n + 1);
      if (option == SIZE_MAX)
        break;
    }
  celd_search_restore (s, &m->best);
}

static void
force (Margins *m, size_t place, bool drop)
{
  if ((drop && !m->s->arrows_at[place]) || !celd_search_force (m->s, place, drop))
    return;
  note (m);
  celd_search_restore (m->s, &m->best);
}

/* Is no dot seen where an option has its dot?  No chosen arrow has one there. */
static bool
lacks_dot (const CeldArrowSearch *s, const CeldArrowOption *o)
{
  const CeldPaintPiece *dot = &s->piece[o->mark];
  double                own = 0;

  if (o->mark_cost < NO_DOT_BARE)
    return false;
  for (size_t i = 0; i < s->choice.n; i++)
    if (s->option[s->choice.item[i]].mark == o->mark)
      return false;
  for (size_t i = 0; i < dot->n; i++)
    own += dot->cell[i] < celd_search_plane (s) && !s->covers[dot->cell[i]] ? s->cell : 0;
  return own <= NO_DOT_OWN;
}

/* Bans the options whose dots are not there, or lifts those bans, with the same choice. */
static void
ban_absent_dots (CeldArrowSearch *s, bool on)
{
  for (size_t k = 0; k < s->n_options && s->style == CELD_ARROW_DOT; k++)
    if (lacks_dot (s, &s->option[k]))
      s->banned[k] = (uint16_t) (s->banned[k] + (on ? 1 : -1));
}

void
celd_search_margins_find (CeldArrowSearch *s, double *margin)
{
  Margins m = { .s = s, .margin = margin };

  for (int again = 0; again <= RESTARTS; again++)
    {
      m.best = m.better = s->choice;
      for (size_t i = 0; i < m.best.n; i++)
        margin[i] = MARGIN_LEAST;
      ban_absent_dots (s, true);
      for (size_t i = 0; i < m.best.n; i++)
        leave_out (&m, m.best.item[i]);
      for (size_t i = 0; i < m.best.n; i++)
        turn (&m, m.best.item[i]);
      for (size_t i = 0; i < m.best.n && s->style == CELD_ARROW_HEAD; i++)
        give_two_heads (&m, i);
      for (size_t p = 0; p < s->n_places; p++)
        {
          force (&m, p, false);
          force (&m, p, true);
        }
      ban_absent_dots (s, false);
      if (m.better.cost >= m.best.cost)
        return;
      celd_search_restore (s, &m.better);
    }
  for (size_t i = 0; i < s->choice.n; i++)
    margin[i] = 0; /* it may still get better */
}
