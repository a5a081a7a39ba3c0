/* Random scenes with contradictions, against a checker that tries everything: which relations are on a circle, what is
 * left out, and that no lighter choice would do.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"

#define MOST_LABELS    12
#define MOST_RELATIONS 26

/* One row of pixels, region k at pixel k; labels count from 0 here.  A colour may name two regions, so relations have
 * sets of labels on both sides. */
typedef struct
{
  int          n_labels, n;
  uint32_t     near[MOST_RELATIONS], far[MOST_RELATIONS];
  CeldRelation item[MOST_RELATIONS];
  CeldRegion   region[MOST_LABELS];
  uint32_t     pixel[MOST_LABELS];
  CeldOrder    order;
  CeldProblems problems;
  bool         kept[MOST_RELATIONS];
} Scene;

/* ------------------------------------------------------------------ scenes */

/* A random end that shares no label with `other`. */
static uint32_t
make_end (const Scene *s, uint32_t other, uint32_t *state, CeldTerm *term)
{
  for (;;)
    {
      uint32_t k = check_random (state, (uint32_t) s->n_labels), set = 1u << k;

      *term = (CeldTerm) { .x = k };
      if (check_random (state, 8) == 0)
        {
          *term = (CeldTerm) { .by_colour = true };
          memcpy (term->colour, s->region[k].colour, 3);
          for (int i = 0; i < s->n_labels; i++)
            if (!memcmp (s->region[i].colour, s->region[k].colour, 3))
              set |= 1u << i;
        }
      if (!(set & other))
        return set;
    }
}

static void
make_scene (Scene *s, int n_labels, int n, uint32_t *state)
{
  *s = (Scene) { .n_labels = n_labels, .n = n };
  for (int k = 0; k < n_labels; k++)
    {
      /* the last two share a colour, now and then; never all of them */
      int hue = k == n_labels - 1 && k > 2 ? k - 1 : k;

      s->region[k] = (CeldRegion) { .colour = { (uint8_t) (20 * hue), 0, 0, 255 } };
      s->pixel[k]  = (uint32_t) k + 1;
    }
  for (int i = 0; i < n; i++)
    {
      CeldRelation *r = &s->item[i];

      *r = (CeldRelation) { .weight = 0.25 * (1 + check_random (state, 12)), .gap = 1,
                            .equal = check_random (state, 5) == 0 };
      s->near[i] = make_end (s, 0, state, &r->nearer);
      s->far[i]  = make_end (s, s->near[i], state, &r->farther);
    }
}

static void
solve (Scene *s, CeldOnCycle on_cycle)
{
  CeldLabels    labels    = { s->n_labels, 1, (size_t) s->n_labels, s->pixel };
  CeldPalette   palette   = { s->region, (size_t) s->n_labels };
  CeldRelations relations = { s->item, (size_t) s->n };
  CeldSettings  settings  = celd_settings ();

  settings.on_cycle = on_cycle;
  CHECK (celd_order (&labels, &palette, &relations, NULL, &settings, NULL, &s->order, &s->problems) == CELD_OK);
  for (int i = 0; i < s->n; i++)
    s->kept[i] = true;
  for (size_t i = 0; i < s->order.n_cycles; i++)
    s->kept[s->order.cycle[i].item[0]] = false;
}

static void
forget (Scene *s)
{
  celd_order_clear (&s->order);
  celd_problems_clear (&s->problems);
}

/* ------------------------------------------------------------------ the checker */

/* Where steps down from label k lead by relation i: both ways for an equality. */
static uint32_t
steps (const Scene *s, int i, int k)
{
  uint32_t all = s->near[i] | s->far[i];

  if (s->item[i].equal)
    return all >> k & 1 ? all : 0;
  return s->near[i] >> k & 1 ? s->far[i] : 0;
}

/* Labels that steps down by relations in `use` reach from a set: any[0] by equalities alone, or not at all; any[1]
 * with an inequality among them. */
static void
reach (const Scene *s, const bool *use, uint32_t from, uint32_t any[2])
{
  bool changed = true;

  any[0] = from;
  any[1] = 0;
  while (changed)
    {
      uint32_t before[2] = { any[0], any[1] };

      for (int i = 0; i < s->n; i++)
        for (int k = 0; k < s->n_labels && use[i]; k++)
          {
            if (any[0] >> k & 1)
              any[!s->item[i].equal] |= steps (s, i, k);
            if (any[1] >> k & 1)
              any[1] |= steps (s, i, k);
          }
      changed = any[0] != before[0] || any[1] != before[1];
    }
}

static bool
consistent (const Scene *s, const bool *use)
{
  for (int k = 0; k < s->n_labels; k++)
    {
      uint32_t any[2];

      reach (s, use, 1u << k, any);
      if (any[1] >> k & 1)
        return false;
    }
  return true;
}

/* A way from a set of labels down to another one, as relations in `use`, an inequality among them unless `strict` from
 * the start; as few as possible; their number, or 0. */
static int
shortest_way (const Scene *s, const bool *use, uint32_t from, uint32_t to, bool strict, int way[MOST_RELATIONS])
{
  int  came[2 * MOST_LABELS], by[2 * MOST_LABELS], queue[2 * MOST_LABELS], n = 0;
  bool seen[2 * MOST_LABELS] = { false };

  for (int k = 0; k < s->n_labels; k++)
    if (from >> k & 1)
      {
        queue[n++] = 2 * k + strict;
        seen[2 * k + strict] = true;
        came[2 * k + strict] = -1;
      }
  for (int q = 0; q < n; q++)
    for (int i = 0; i < s->n; i++)
      for (int k = 0; k < s->n_labels && use[i]; k++)
        {
          int next = 2 * k + (queue[q] % 2 || !s->item[i].equal), length = 0;

          if (!(steps (s, i, queue[q] / 2) >> k & 1) || seen[next])
            continue;
          seen[next] = true;
          came[next] = queue[q];
          by[next]   = i;
          queue[n++] = next;
          if (!(next % 2) || !(to >> k & 1))
            continue;
          for (int at = next; came[at] >= 0; at = came[at])
            way[length++] = by[at];
          return length;
        }
  return 0;
}

static double
weight_of (const Scene *s, const bool *use)
{
  double sum = 0;

  for (int i = 0; i < s->n; i++)
    sum += use[i] ? 0 : s->item[i].weight;
  return sum;
}

/* The least weight below `best` that has to go from `use`: one relation of every circle must go; tries each. */
static double
least_weight (const Scene *s, bool *use, double best)
{
  int    way[MOST_RELATIONS], length = 0;
  double here = weight_of (s, use);

  if (here >= best)
    return best;
  for (int k = 0; k < s->n_labels && !length; k++)
    length = shortest_way (s, use, 1u << k, 1u << k, false, way);
  if (!length)
    return here;
  for (int i = 0; i < length; i++)
    {
      use[way[i]] = false;
      best = least_weight (s, use, best);
      use[way[i]] = true;
    }
  return best;
}

/* ------------------------------------------------------------------ what is checked */

/* Each relation leads on from the one before it, and the last one back to the first. */
static bool
is_cycle (const Scene *s, const CeldCycle *cycle)
{
  for (int k = 0; k < s->n_labels; k++)
    {
      uint32_t at[2] = { 1u << k, 0 };

      for (size_t j = 0; j < cycle->n; j++)
        {
          uint32_t next[2] = { 0, 0 };
          int      i = (int) cycle->item[j];

          for (int l = 0; l < s->n_labels; l++)
            for (int strict = 0; strict < 2; strict++)
              if (at[strict] >> l & 1)
                next[strict || !s->item[i].equal] |= steps (s, i, l);
          at[0] = next[0];
          at[1] = next[1];
        }
      if (at[1] >> k & 1)
        return true;
    }
  return false;
}

/* Contradictions are circles of what is kept and one that is not. */
static void
check_cycles (const Scene *s)
{
  CHECK (s->problems.n == s->order.n_cycles);
  for (size_t j = 0; j < s->order.n_cycles; j++)
    {
      const CeldCycle *cycle = &s->order.cycle[j];
      bool             in_scc = false;

      CHECK (is_cycle (s, cycle));
      CHECK (cycle->scc < s->order.n_sccs);
      for (size_t k = 0; k < cycle->n; k++)
        CHECK (s->kept[cycle->item[k]] == (k > 0));
      for (size_t k = 0; k < s->order.scc[cycle->scc].n; k++)
        in_scc |= s->order.scc[cycle->scc].item[k] == cycle->item[0];
      CHECK (in_scc);
    }
}

static void
check_levels (const Scene *s)
{
  for (int i = 0; i < s->n; i++)
    for (int a = 0; a < s->n_labels; a++)
      for (int b = 0; b < s->n_labels; b++)
        if (s->kept[i] && s->near[i] >> a & 1 && s->far[i] >> b & 1)
          CHECK (s->item[i].equal ? s->order.level[a] == s->order.level[b] : s->order.level[a] > s->order.level[b]);
}

/* Strong components have exactly the relations that lie on a cycle with an inequality, each in one component; and their
 * newest cycle is a shortest one. */
static void
check_sccs (const Scene *s)
{
  bool all[MOST_RELATIONS], listed[MOST_RELATIONS] = { false };
  int  way[MOST_RELATIONS];

  for (int i = 0; i < s->n; i++)
    all[i] = true;
  for (size_t j = 0; j < s->order.n_sccs; j++)
    {
      const CeldScc *scc = &s->order.scc[j];
      int            newest = (int) scc->newest.item[0];

      for (size_t k = 0; k < scc->n; k++)
        {
          CHECK (!listed[scc->item[k]] && (k == 0 || scc->item[k] > scc->item[k - 1]));
          listed[scc->item[k]] = true;
        }
      CHECK (is_cycle (s, &scc->newest));
      for (size_t k = 0; k < scc->n; k++) /* all later ones are equalities, led round but on no circle */
        CHECK ((int) scc->item[k] <= newest || s->item[scc->item[k]].equal);
      if (!s->item[newest].equal)
        CHECK ((int) scc->newest.n == 1 + shortest_way (s, all, s->far[newest], s->near[newest], true, way));
    }
  for (int i = 0; i < s->n; i++)
    {
      uint32_t any[2];

      reach (s, all, s->item[i].equal ? s->near[i] | s->far[i] : s->far[i], any);
      CHECK (listed[i] == ((s->item[i].equal ? any[1] & (s->near[i] | s->far[i])
                                             : (any[0] | any[1]) & s->near[i]) != 0));
    }
}

static void
check_scene (Scene *s, bool least, size_t *contradictions)
{
  bool all[MOST_RELATIONS];

  CHECK (consistent (s, s->kept));
  check_levels (s);
  check_cycles (s);
  check_sccs (s);
  for (int i = 0; i < s->n; i++)
    all[i] = true;
  if (least)
    NEAR (weight_of (s, s->kept), least_weight (s, all, weight_of (s, s->kept) + 1), 1e-9);
  *contradictions += s->order.n_cycles;
}

/* ------------------------------------------------------------------ tests */

static void
random_scenes (void)
{
  uint32_t state = 11;
  size_t   reported = 0, dropped = 0;

  for (int round = 0; round < 1000; round++)
    {
      int   n_labels = 3 + (int) check_random (&state, MOST_LABELS - 2);
      Scene s;

      make_scene (&s, n_labels, (int) check_random (&state, (uint32_t) (2 * n_labels + 3)), &state);
      solve (&s, CELD_ON_CYCLE_REPORT);
      check_scene (&s, false, &reported);
      forget (&s);
      solve (&s, CELD_ON_CYCLE_DROP_WEAKEST);
      check_scene (&s, true, &dropped);
      forget (&s);
    }
  CHECK (reported > 1000 && dropped > 500 && dropped < reported); /* else the test would say little */
}

/* All of twelve labels in one component: the largest that is promised to be exact, and dense. */
static void
full_components (void)
{
  uint32_t state = 5;
  size_t   n = 0;

  for (int round = 0; round < 20; round++)
    {
      Scene s;

      make_scene (&s, MOST_LABELS, MOST_RELATIONS, &state);
      solve (&s, CELD_ON_CYCLE_DROP_WEAKEST);
      check_scene (&s, true, &n);
      forget (&s);
    }
  CHECK (n > 40);
}

/* A heavy circle through one light arrow: greedy would leave out the latest of equals, but one light arrow is cheaper;
 * of equally cheap ones the newest goes. */
static void
known_choices (void)
{
  Scene s = { .n_labels = 4, .n = 4 };

  for (int k = 0; k < 4; k++)
    {
      s.region[k] = (CeldRegion) { .colour = { (uint8_t) (20 * k), 0, 0, 255 } };
      s.pixel[k]  = (uint32_t) k + 1;
      s.item[k]   = (CeldRelation) { .nearer = { .x = k }, .farther = { .x = (k + 1) % 4 }, .weight = 1, .gap = 1 };
    }
  solve (&s, CELD_ON_CYCLE_DROP_WEAKEST);
  CHECK (s.order.n_cycles == 1 && s.order.cycle[0].n == 4 && s.order.cycle[0].item[0] == 3);
  CHECK (s.order.n_sccs == 1 && s.order.scc[0].n == 4 && s.order.scc[0].newest.item[0] == 3);
  forget (&s);
  /* 0>1 (weight 2) closes circles with 1>2>0 and 1>3>0 of weights 1.5: greedy keeps it and loses 3, best loses 2 */
  s.item[0].weight = 2;
  s.item[1] = (CeldRelation) { .nearer = { .x = 1 }, .farther = { .x = 2 }, .weight = 1.5, .gap = 1 };
  s.item[2] = (CeldRelation) { .nearer = { .x = 2 }, .farther = { .x = 0 }, .weight = 9, .gap = 1 };
  s.item[3] = (CeldRelation) { .nearer = { .x = 1 }, .farther = { .x = 0 }, .weight = 1.5, .gap = 1 };
  solve (&s, CELD_ON_CYCLE_REPORT);
  CHECK (s.order.n_cycles == 2);
  forget (&s);
  solve (&s, CELD_ON_CYCLE_DROP_WEAKEST);
  CHECK (s.order.n_cycles == 1 && s.order.cycle[0].item[0] == 0);
  forget (&s);
}

int
main (void)
{
  RUN (random_scenes);
  RUN (full_components);
  RUN (known_choices);
  return DONE;
}
