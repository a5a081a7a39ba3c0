/* Contradictions and levels on random graphs, against a checker that knows nothing of graphs: levels as the least
 * solution of inequalities, found by raising them until nothing changes.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"


#define MOST_LABELS 8
#define MOST_RELATIONS 20

/* One row of pixels, region k at pixel k; label numbers from 0 here. */
typedef struct
{
  int          n_labels, n;
  int          near[MOST_RELATIONS], far[MOST_RELATIONS];
  int          gap[MOST_RELATIONS];
  CeldRelation item[MOST_RELATIONS];
  CeldRegion   region[MOST_LABELS];
  uint32_t     pixel[MOST_LABELS];
  CeldOrder    order;
  CeldProblems problems;
  bool         kept[MOST_RELATIONS];
} Case;

static void
make_case (Case *c, uint32_t *state)
{
  *c = (Case) { 0 };
  c->n_labels = 2 + (int) check_random (state, MOST_LABELS - 1);
  c->n        = (int) check_random (state, MOST_RELATIONS + 1);
  for (int k = 0; k < c->n_labels; k++)
    {
      c->region[k].colour[0] = (uint8_t) (20 * k + 5);
      c->region[k].colour[3] = 255;
      c->pixel[k]            = (uint32_t) k + 1;
    }
  c->region[0].background = check_random (state, 2);
  for (int i = 0; i < c->n; i++)
    {
      c->near[i] = (int) check_random (state, (uint32_t) c->n_labels);
      c->far[i]  = (c->near[i] + 1 + (int) check_random (state, (uint32_t) c->n_labels - 1)) % c->n_labels;
      c->gap[i]  = check_random (state, 4) ? 1 : 3;
      c->item[i] = (CeldRelation) {
        .nearer = { .x = c->near[i] }, .farther = { .x = c->far[i] }, .equal = check_random (state, 3) == 0,
        .weight = 1 + check_random (state, 3), .gap = c->gap[i],
      };
    }
}

static void
solve (Case *c)
{
  CeldLabels    labels    = { c->n_labels, 1, (size_t) c->n_labels, c->pixel };
  CeldPalette   palette   = { c->region, (size_t) c->n_labels };
  CeldRelations relations = { c->item, (size_t) c->n };

  CHECK (celd_order (&labels, &palette, &relations, NULL, NULL, NULL, &c->order, &c->problems) == CELD_OK);
  for (int i = 0; i < c->n; i++)
    c->kept[i] = true;
  for (size_t i = 0; i < c->order.n_cycles; i++)
    c->kept[c->order.cycle[i].item[0]] = false;
}

/* Raises levels until all relations marked in `use` hold and the background (if behind[] is given, where it is false)
 * is behind; false if they cannot hold. */
static bool
least_levels (const Case *c, const bool *use, const bool *behind, int level[MOST_LABELS])
{
  for (int k = 0; k < c->n_labels; k++)
    level[k] = 0;
  for (int round = 0; round < 3 * MOST_LABELS; round++) /* without a cycle every round settles a label */
    {
      bool changed = false;

      for (int i = 0; i < c->n; i++)
        if (use[i])
          {
            int least = level[c->far[i]] + (c->item[i].equal ? 0 : c->gap[i]);

            changed |= level[c->near[i]] < least || (c->item[i].equal && level[c->near[i]] != least);
            if (level[c->near[i]] < least)
              level[c->near[i]] = least;
            if (c->item[i].equal)
              level[c->far[i]] = level[c->near[i]];
          }
      for (int k = 1; behind && k < c->n_labels; k++)
        if (!behind[k] && level[k] < level[0] + 1)
          {
            level[k] = level[0] + 1;
            changed  = true;
          }
      if (!changed)
        return true;
    }
  return false;
}

/* The labels that the background is in front of, or equal to. */
static void
find_behind (const Case *c, bool behind[MOST_LABELS])
{
  for (int k = 0; k < c->n_labels; k++)
    behind[k] = k == 0;
  for (int round = 0; round < MOST_LABELS; round++)
    for (int i = 0; i < c->n; i++)
      if (c->kept[i])
        {
          behind[c->far[i]] |= behind[c->near[i]];
          if (c->item[i].equal)
            behind[c->near[i]] |= behind[c->far[i]];
        }
}

/* Does relation j come before relation i when they are tried? */
static bool
comes_before (const Case *c, int j, int i)
{
  return c->item[j].weight > c->item[i].weight || (c->item[j].weight == c->item[i].weight && j < i);
}

/* Walks a cycle from one end of its first relation and must come back at the other. */
static bool
is_cycle_from (const Case *c, const CeldCycle *cycle, int at, int home)
{
  bool strict = !c->item[cycle->item[0]].equal;

  for (size_t k = 1; k < cycle->n; k++)
    {
      size_t i = cycle->item[k];

      if (!c->kept[i])
        return false;
      if (c->near[i] == at)
        at = c->far[i];
      else if (c->item[i].equal && c->far[i] == at)
        at = c->near[i];
      else
        return false;
      strict |= !c->item[i].equal;
    }
  return strict && at == home;
}

/* Relations on a shortest path that relation i contradicts, over those marked in `use`; 0: there is none.  Distances
 * of labels without and behind an inequality are lowered until nothing changes. */
static int
shortest_path (const Case *c, const bool *use, int i)
{
  enum { FAR_AWAY = 1000 };
  int way[MOST_LABELS][2], shortest = 0;

  for (int start = 0; start < (c->item[i].equal ? 2 : 1); start++)
    {
      int from = start ? c->near[i] : c->far[i], to = start ? c->far[i] : c->near[i];

      for (int k = 0; k < c->n_labels; k++)
        way[k][0] = way[k][1] = FAR_AWAY;
      way[from][!c->item[i].equal] = 0;
      for (int round = 0; round < 2 * MOST_LABELS; round++)
        for (int j = 0; j < c->n; j++)
          for (int turned = 0; use[j] && turned < (c->item[j].equal ? 2 : 1); turned++)
            for (int strict = 0; strict < 2; strict++)
              {
                int *goal = &way[turned ? c->near[j] : c->far[j]][strict || !c->item[j].equal];
                int  length = way[turned ? c->far[j] : c->near[j]][strict] + 1;

                *goal = length < *goal ? length : *goal;
              }
      if (way[to][1] < FAR_AWAY && (!shortest || way[to][1] < shortest))
        shortest = way[to][1];
    }
  return shortest;
}

static void
check_case (Case *c)
{
  bool behind[MOST_LABELS], use[MOST_RELATIONS];
  int  level[MOST_LABELS];

  find_behind (c, behind);
  CHECK (least_levels (c, c->kept, c->region[0].background ? behind : NULL, level));
  for (int k = 0; k < c->n_labels; k++)
    CHECK (c->order.level[k] == (uint32_t) level[k]);
  CHECK (c->problems.n == c->order.n_cycles);
  for (size_t k = 0; k < c->order.n_cycles; k++)
    {
      const CeldCycle *cycle = &c->order.cycle[k];
      int              i     = (int) cycle->item[0];

      for (int j = 0; j < c->n; j++)
        use[j] = j == i || (c->kept[j] && comes_before (c, j, i));
      CHECK (!least_levels (c, use, NULL, level));
      use[i] = false;
      CHECK (cycle->n == (size_t) shortest_path (c, use, i) + 1);
      CHECK (is_cycle_from (c, cycle, c->far[i], c->near[i]) ||
             (c->item[i].equal && is_cycle_from (c, cycle, c->near[i], c->far[i])));
    }
}

static void
random_graphs (void)
{
  uint32_t state = 3, contradictions = 0;

  for (int round = 0; round < 3000; round++)
    {
      Case c;

      make_case (&c, &state);
      solve (&c);
      check_case (&c);
      contradictions += (uint32_t) c.order.n_cycles;
      celd_order_clear (&c.order);
      celd_problems_clear (&c.problems);
    }
  CHECK (contradictions > 3000); /* else the test would say little */
}

/* 2,000 regions and 10,000 relations, the given share of them at random, the others from a hidden order. */
static void
large_graph (uint32_t random_of_100)
{
  enum { N = 2000, M = 10000 };
  uint32_t     *pixel = malloc (N * sizeof *pixel), state = 5;
  CeldRegion   *region = calloc (N, sizeof *region);
  CeldRelation *item   = calloc (M, sizeof *item);
  CeldLabels    labels    = { N, 1, N, pixel };
  CeldPalette   palette   = { region, N };
  CeldRelations relations = { item, M };
  CeldOrder     order     = { 0 };
  bool         *kept      = malloc (M);

  for (uint32_t k = 0; k < N; k++)
    pixel[k] = k + 1;
  for (int i = 0; i < M; i++)
    {
      uint32_t a = check_random (&state, N), b = (a + 1 + check_random (&state, N - 1)) % N;
      bool     swap = check_random (&state, 100) >= random_of_100 && a < b;

      item[i] = (CeldRelation) { .weight = 1, .gap = 1 };
      item[i].nearer.x  = swap ? b : a;
      item[i].farther.x = swap ? a : b;
      kept[i] = true;
    }
  CHECK (celd_order (&labels, &palette, &relations, NULL, NULL, NULL, &order, NULL) == CELD_OK);
  CHECK ((order.n_cycles > 0) == (random_of_100 > 0));
  for (size_t i = 0; i < order.n_cycles; i++)
    kept[order.cycle[i].item[0]] = false;
  for (int i = 0; i < M; i++)
    CHECK (!kept[i] || order.level[(int) item[i].nearer.x] > order.level[(int) item[i].farther.x]);
  celd_order_clear (&order);
  free (pixel);
  free (region);
  free (item);
  free (kept);
}

static void
large_graphs (void)
{
  large_graph (0);
  large_graph (1);
  large_graph (100);
}

static bool
refuse (void *host, double done)
{
  int *calls = host;

  CHECK (done >= 0 && done <= 1);
  return --*calls > 0;
}

static void
cancelled (void)
{
  uint32_t     state = 1;
  Case         c;
  CeldPalette  palette;
  int          calls = 1;
  CeldHost     host   = { refuse, NULL, &calls };
  CeldOrder    order = { 0 };
  CeldProblems problems = { 0 };

  do
    make_case (&c, &state);
  while (c.n < 15);
  palette = (CeldPalette) { c.region, (size_t) c.n_labels };
  CHECK (celd_order (&(CeldLabels) { c.n_labels, 1, (size_t) c.n_labels, c.pixel }, &palette,
                     &(CeldRelations) { c.item, (size_t) c.n }, NULL, NULL, &host, &order, &problems) ==
         CELD_CANCELLED);
  CHECK (!order.level && !order.cycle && problems.n == 0);
  calls = 2;
  CHECK (celd_order (&(CeldLabels) { c.n_labels, 1, (size_t) c.n_labels, c.pixel }, &palette,
                     &(CeldRelations) { c.item, (size_t) c.n }, NULL, NULL, &host, &order, &problems) ==
         CELD_CANCELLED);
  CHECK (!order.level && !order.cycle && problems.n == 0);
  celd_problems_clear (&problems);
}

int
main (void)
{
  RUN (random_graphs);
  RUN (large_graphs);
  RUN (cancelled);
  return DONE;
}
