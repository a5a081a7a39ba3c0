/* Links that come and go: what is updated is what would be computed anew.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "solve/quadratic-private.h"
#include "solve/quadratic.h"

enum { N = 14, M = 60 };

static CeldInequality one[M];
static uint32_t       active[N], order[N], parent[N], hooked[N], tree[N], component[N], body[N], entry[4 * N + 4];
static double         offset[N], weight[N * N], pull[N], inverse[N * N], work[N * N], row[N];

static CeldForest
new_forest (void)
{
  return (CeldForest) {
    .n = N, .m = M, .inequality = one, .active = active, .order = order, .parent = parent, .link = hooked,
    .tree = tree, .offset = offset, .component = component, .body = body, .weight = weight, .pull = pull,
    .inverse = inverse, .work = work, .row = row, .entry = entry,
  };
}

static double
random_unit (uint32_t *state)
{
  return check_random (state, 1 << 24) / (double) (1 << 24);
}

/* Nodes in `pieces` components, joined inside by springs of middling strength; any inequalities. */
static void
draw (uint32_t *state, CeldForest *f, uint32_t pieces)
{
  double k[N * N] = { 0 };

  for (uint32_t i = 0; i < N; i++)
    for (uint32_t j = 0; j < i; j++)
      if (i % pieces == j % pieces && (i == j + pieces || check_random (state, 2)))
        k[i * N + j] = k[j * N + i] = -0.1 - random_unit (state);
  for (size_t i = 0; i < M; i++)
    {
      uint32_t a = check_random (state, N);

      one[i] = (CeldInequality) { a, (a + 1 + check_random (state, N - 1)) % N, 0.5 + random_unit (state) };
    }
  celd_forest_read (f, k);
  celd_forest_walk (f);
  CHECK (f->n_components == pieces && celd_forest_set_up (f));
}

static uint32_t
body_of (const CeldForest *f, uint32_t i)
{
  return f->body[f->component[i]];
}

/* A link between two trees, whether of one body or of two; false if p is in one tree. */
static bool
add_link (CeldForest *f, uint32_t p)
{
  uint32_t a = one[p].a, b = one[p].b;
  double   z[N];

  if (f->tree[a] == f->tree[b])
    return false;
  for (size_t i = 0; i < N; i++)
    z[i] = f->inverse[a * N + i] - f->inverse[b * N + i];
  if (body_of (f, a) != body_of (f, b))
    celd_forest_join (f, p);
  else
    celd_forest_add (f, p, z, z[a] - z[b]);
  return true;
}

/* H moves bodies as one computed anew does, wherever they are held, for forces that balance on each. */
static void
same_as_anew (CeldForest *f)
{
  static double updated[N * N];

  memcpy (updated, f->inverse, sizeof updated);
  CHECK (celd_forest_set_up (f));
  for (uint32_t a = 0; a < N; a++)
    for (uint32_t b = 0; b < N; b++)
      for (uint32_t i = 0; i < N && body_of (f, a) == body_of (f, b); i++)
        {
          double now = updated[a * N + i] - updated[b * N + i] - (updated[a * N + a] - updated[b * N + a]);
          double anew = inverse[a * N + i] - inverse[b * N + i] - (inverse[a * N + a] - inverse[b * N + a]);

          if (body_of (f, i) == body_of (f, a))
            NEAR (now, anew, 1e-9);
          else
            NEAR (updated[a * N + i], 0, 0);
        }
  memcpy (f->inverse, updated, sizeof updated);
}

/* Links keep their ends at their gaps, and join trees to what they say. */
static void
trees_are_right (const CeldForest *f)
{
  CHECK (f->n_trees == N - f->n_active);
  for (size_t l = 0; l < f->n_active; l++)
    {
      const CeldInequality *link = &one[f->active[l]];

      CHECK (f->tree[link->a] == f->tree[link->b]);
      NEAR (f->offset[link->a] - f->offset[link->b], link->gap, 1e-14);
    }
}

static void
added_and_dropped_links_keep_h_exact (void)
{
  uint32_t state = 3;

  for (int trial = 0; trial < 60; trial++)
    {
      CeldForest f = new_forest ();

      draw (&state, &f, 1 + (uint32_t) trial % 4);
      for (int step = 0; step < 25; step++)
        {
          double way[N], force[N], curvature;

          if (f.n_active && !check_random (&state, 3))
            CHECK (celd_forest_drop (&f, check_random (&state, (uint32_t) f.n_active), way, force, &curvature));
          else
            add_link (&f, check_random (&state, M));
          trees_are_right (&f);
          same_as_anew (&f);
        }
    }
}

/* A link that is let go lets its ends part: by 1 along `way`, all else staying rigid, at the cost that is told. */
static void
dropping_a_link_gives_the_cheapest_motion (void)
{
  uint32_t state = 7;

  for (int trial = 0; trial < 60; trial++)
    {
      CeldForest f = new_forest ();
      double     way[N], force[N], curvature, cost = 0;
      uint32_t   gone;

      draw (&state, &f, 1);
      for (uint32_t p = 0; p < M && f.n_active < 8; p++)
        add_link (&f, p);
      gone = f.active[trial % 8];
      CHECK (celd_forest_drop (&f, (size_t) trial % 8, way, force, &curvature) && curvature > 0);
      NEAR (fabs (way[one[gone].a] - way[one[gone].b]), 1, 1e-9);
      for (size_t l = 0; l < f.n_active; l++)
        NEAR (way[one[f.active[l]].a], way[one[f.active[l]].b], 1e-9);
      for (size_t i = 0; i < N; i++)
        for (size_t j = 0; j < i; j++)
          cost += weight[i * N + j] * (way[i] - way[j]) * (way[i] - way[j]);
      NEAR (curvature, cost, 1e-9);
    }
}

/* Forces that the links carry flow through them: sum of r (e_a - e_b) is what they were. */
static void
flows_balance (void)
{
  uint32_t state = 13;

  for (int trial = 0; trial < 60; trial++)
    {
      CeldForest f = new_forest ();
      double     r[N], wanted[N], force[N] = { 0 };

      draw (&state, &f, 1 + (uint32_t) trial % 3);
      for (uint32_t p = 0; p < M && f.n_active < 10; p++)
        add_link (&f, p);
      for (size_t l = 0; l < f.n_active; l++)
        {
          wanted[l] = random_unit (&state) - 0.5;
          force[one[f.active[l]].a] += wanted[l];
          force[one[f.active[l]].b] -= wanted[l];
        }
      celd_forest_flow (&f, force, r);
      for (size_t l = 0; l < f.n_active; l++)
        NEAR (r[l], wanted[l], 1e-14);
    }
}

int
main (void)
{
  RUN (added_and_dropped_links_keep_h_exact);
  RUN (dropping_a_link_gives_the_cheapest_motion);
  RUN (flows_balance);
  return DONE;
}
