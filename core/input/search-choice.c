/* What a choice of arrows costs, and how it changes.
 *
 * Each arrow costs something, by how it bends, and what of its head or dot is not painted; so does each place where
 * arrows end, more if others are near or if an arrow passes it; and all paint that nothing explains.
 *
 * Each piece of paint keeps how many of its cells are bare, so that most options are seen not to pay without a look
 * at their cells.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/arrow-search.h"

#include <math.h>

/* All chosen; lengths are widths of the paint. */
#define PLACE_COST     1.2  /* of a place where arrows end */
#define NEAR_COST      2    /* of two such places that are near each other */
#define CHOICE_NEAR    3
#define PASS_COST      3    /* of an arrow that passes such a place */
#define PASS           1.3  /* from the line of an arrow to a place that it passes ... */
#define PASS_MARGIN    3    /* ... so far from its ends */
#define CHOICE_SMALLER 1e-6 /* a cost that is smaller by less is as good */

static bool
passes (const CeldArrowSearch *s, const CeldShaft *shaft, CeldPoint place)
{
  for (int end = 0; end < 2; end++)
    if (celd_points_apart (place, s->place[shaft->place[end]]) < PASS_MARGIN * s->width)
      return false;
  for (size_t i = 1; i < shaft->n; i++)
    if (celd_distance_to_part (place, shaft->at[i - 1], shaft->at[i]) < PASS * s->width)
      return true;
  return false;
}

CeldStatus
celd_search_choice_new (CeldArrowSearch *s)
{
  size_t n = celd_search_cells (s);

  s->chosen     = celd_alloc0 (s->n_options + 1, sizeof *s->chosen);
  s->banned     = celd_alloc0 (s->n_options + 1, sizeof *s->banned);
  s->passes     = celd_alloc0 (s->n_shafts * s->n_places + 1, sizeof *s->passes);
  s->arrows_at  = celd_alloc0 (s->n_places + 1, sizeof *s->arrows_at);
  s->place_cost = celd_alloc0 (s->n_places + 1, sizeof *s->place_cost);
  s->passed     = celd_alloc0 (s->n_shafts + 1, sizeof *s->passed);
  s->uses       = celd_alloc0 (s->n_shafts + 1, sizeof *s->uses);
  if (!s->chosen || !s->banned || !s->passes || !s->arrows_at || !s->place_cost || !s->passed || !s->uses)
    return CELD_NO_MEMORY;
  for (size_t k = 0; k < s->n_shafts; k++)
    for (size_t p = 0; p < s->n_places; p++)
      s->passes[k * s->n_places + p] = passes (s, &s->shaft[k], s->place[p]);
  for (size_t p = 0; p < s->n_places; p++)
    s->place_cost[p] = PLACE_COST;
  for (size_t c = 0; c < n; c++)
    s->choice.cost += s->painted[c] ? s->area : 0;
  return CELD_OK;
}

/* ------------------------------------------------------------------ changes */

static void
cover (CeldArrowSearch *s, size_t k)
{
  for (size_t i = 0; i < s->piece[k].n; i++)
    {
      size_t c = s->piece[k].cell[i];

      if (s->covers[c]++ == 0)
        for (uint32_t j = s->first[c]; j < s->first[c + 1]; j++)
          s->bare[s->piece_at[j]]--;
    }
}

static void
uncover (CeldArrowSearch *s, size_t k)
{
  for (size_t i = 0; i < s->piece[k].n; i++)
    {
      size_t c = s->piece[k].cell[i];

      if (--s->covers[c] == 0)
        for (uint32_t j = s->first[c]; j < s->first[c + 1]; j++)
          s->bare[s->piece_at[j]]++;
    }
}

/* Whether arrows end at a place has changed. */
static void
change_place (CeldArrowSearch *s, size_t p, bool used)
{
  for (size_t k = 0; k < s->n_shafts; k++)
    if (celd_shaft_passes (s, k, p))
      s->passed[k] += used ? 1 : SIZE_MAX;
  for (size_t q = 0; q < s->n_places; q++)
    if (q != p && celd_points_apart (s->place[p], s->place[q]) < CHOICE_NEAR * s->width)
      s->place_cost[q] += used ? NEAR_COST : -NEAR_COST;
}

/* What an option costs without what it explains. */
static double
own_cost (const CeldArrowSearch *s, const CeldArrowOption *o)
{
  const CeldShaft *shaft = &s->shaft[o->shaft];
  double           cost = o->cost + PASS_COST * (double) s->passed[o->shaft] + (s->uses[o->shaft] ? CELD_SAME_COST : 0);

  for (int end = 0; end < 2; end++)
    if (!s->arrows_at[shaft->place[end]])
      cost += s->place_cost[shaft->place[end]];
  return cost;
}

/* How many bare cells an option has. */
static size_t
bare_cells (CeldArrowSearch *s, const CeldArrowOption *o)
{
  const CeldPaintPiece *body = &s->piece[o->body], *mark = &s->piece[o->mark];
  size_t                n = s->bare[o->body];

  if (!s->bare[o->mark])
    return n;
  s->tick++;
  for (size_t i = 0; i < body->n; i++)
    s->stamp[body->cell[i]] = s->tick;
  for (size_t i = 0; i < mark->n; i++)
    n += !s->covers[mark->cell[i]] && s->stamp[mark->cell[i]] != s->tick;
  return n;
}

double
celd_search_change (CeldArrowSearch *s, size_t option)
{
  const CeldArrowOption *o = &s->option[option];

  return own_cost (s, o) - s->area * (double) bare_cells (s, o);
}

void
celd_search_choose (CeldArrowSearch *s, size_t option)
{
  const CeldArrowOption *o = &s->option[option];
  const CeldShaft       *shaft = &s->shaft[o->shaft];

  s->choice.cost += celd_search_change (s, option);
  s->choice.item[s->choice.n++] = option;
  s->chosen[option] = true;
  s->uses[o->shaft]++;
  for (size_t p = 0; p < s->n_places; p++)
    if (celd_shaft_passes (s, o->shaft, p))
      s->place_cost[p] += PASS_COST;
  for (int end = 0; end < 2; end++)
    if (s->arrows_at[shaft->place[end]]++ == 0)
      change_place (s, shaft->place[end], true);
  cover (s, o->body);
  cover (s, o->mark);
}

void
celd_search_leave (CeldArrowSearch *s, size_t option)
{
  const CeldArrowOption *o = &s->option[option];
  const CeldShaft       *shaft = &s->shaft[o->shaft];

  for (size_t i = 0; i < s->choice.n; i++)
    if (s->choice.item[i] == option)
      s->choice.item[i] = s->choice.item[--s->choice.n];
  s->chosen[option] = false;
  s->uses[o->shaft]--;
  for (size_t p = 0; p < s->n_places; p++)
    if (celd_shaft_passes (s, o->shaft, p))
      s->place_cost[p] -= PASS_COST;
  for (int end = 0; end < 2; end++)
    if (--s->arrows_at[shaft->place[end]] == 0)
      change_place (s, shaft->place[end], false);
  uncover (s, o->body);
  uncover (s, o->mark);
  s->choice.cost -= celd_search_change (s, option);
}

void
celd_search_restore (CeldArrowSearch *s, const CeldArrowChoice *choice)
{
  for (size_t i = s->choice.n; i-- > 0;)
    {
      bool kept = false;

      for (size_t k = 0; k < choice->n && !kept; k++)
        kept = choice->item[k] == s->choice.item[i];
      if (!kept)
        celd_search_leave (s, s->choice.item[i]);
    }
  for (size_t k = 0; k < choice->n; k++)
    if (!s->chosen[choice->item[k]])
      celd_search_choose (s, choice->item[k]);
  s->choice = *choice;
}

void
celd_search_add (CeldArrowSearch *s, size_t most)
{
  for (size_t added = 0; added < most && s->choice.n < CELD_MOST_CHOSEN; added++)
    {
      size_t best = SIZE_MAX;
      double least = -CHOICE_SMALLER;

      for (size_t k = 0; k < s->n_options; k++)
        {
          const CeldArrowOption *o = &s->option[k];
          double                 gain = s->area * (double) (s->bare[o->body] + s->bare[o->mark]), change;

          if (s->chosen[k] || s->banned[k] || o->cost - gain >= least || own_cost (s, o) - gain >= least)
            continue;
          change = celd_search_change (s, k);
          if (change < least)
            {
              least = change;
              best  = k;
            }
        }
      if (best == SIZE_MAX)
        return;
      celd_search_choose (s, best);
    }
}
