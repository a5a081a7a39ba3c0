/* The cycle over the coarse levels as a preconditioner: how near it comes, and what a preconditioner must not do.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "level-edges.h"
#include "solve/laplace-private.h"
#include "solve/laplace.h"

typedef struct { CeldHierarchy levels; CeldKCycle cycle; LevelEdge *edge; const CeldGridLevel *level; float *b; } Grid;

/* What is solved is the first coarse level. */
static Grid *
grid_new (int width, int height, int lanes)
{
  Grid             *g = calloc (1, sizeof *g);
  CeldWeightedGraph graph = random_graph (width, height, 5);

  CHECK (celd_hierarchy_new (&graph, NULL, &g->levels) == CELD_OK);
  celd_weighted_graph_clear (&graph);
  CHECK (celd_kcycle_new (&g->levels, lanes, NULL, &g->cycle) == CELD_OK);
  g->level = &g->levels.level[1];
  g->edge  = level_edges (g->level);
  g->b     = g->cycle.vectors[1].b;
  return g;
}

static void
grid_free (Grid *g)
{
  celd_kcycle_free (&g->cycle);
  celd_hierarchy_clear (&g->levels);
  free (g->edge);
  free (g);
}

static bool
is_node (const Grid *g, size_t i)
{
  return g->level->inverse[i] > 0;
}

/* b = A wanted, of lane k */
static void
ask_for (Grid *g, const double *wanted, size_t k)
{
  size_t  lanes = (size_t) g->cycle.lanes;
  double *sum = calloc (g->level->n, sizeof *sum);

  for (const LevelEdge *e = g->edge; e->weight > 0; e++)
    {
      sum[e->from] += e->weight * (wanted[e->from] - wanted[e->to]);
      sum[e->to] += e->weight * (wanted[e->to] - wanted[e->from]);
    }
  for (size_t i = 0; i < g->level->n; i++)
    g->b[i * lanes + k] = (float) (sum[i] + (double) g->level->diagonal[i] * wanted[i]);
  free (sum);
}

/* What the cycle has found. */
static double
found (const Grid *g, size_t i, size_t k)
{
  const CeldLevelVectors *v = &g->cycle.vectors[1];
  size_t                  at = i * (size_t) g->cycle.lanes + k;

  return (double) v->a[k] * (double) v->x[at] + (double) v->c[k] * (double) v->step[at];
}

/* The error x - wanted in the norm of A, as a share of wanted. */
static double
error_share (const Grid *g, const double *wanted, size_t k)
{
  double error = 0, whole = 0;

#define ERROR(i) (found (g, i, k) - wanted[i])
  for (const LevelEdge *e = g->edge; e->weight > 0; e++)
    {
      error += e->weight * pow (ERROR (e->from) - ERROR (e->to), 2);
      whole += e->weight * pow (wanted[e->from] - wanted[e->to], 2);
    }
  for (size_t i = 0; i < g->level->n; i++)
    {
      error += (double) g->level->diagonal[i] * pow (ERROR (i), 2);
      whole += (double) g->level->diagonal[i] * pow (wanted[i], 2);
    }
#undef ERROR
  return sqrt (error / whole);
}

static void
rough_and_smooth_errors_shrink_in_every_lane (void)
{
  for (int lanes = 1; lanes <= CELD_LANES; lanes += CELD_LANES - 1)
    {
      Grid    *g = grid_new (160, 120, lanes);
      double  *wanted = calloc ((size_t) g->level->n * CELD_LANES, sizeof *wanted);
      uint32_t state = 9;

      CHECK (g->levels.n > 3);
      for (int rough = 0; rough < 2; rough++)
        {
          for (size_t k = 0; k < (size_t) lanes; k++)
            {
              double *w = wanted + k * g->level->n;

              for (size_t i = 0; i < g->level->n; i++)
                w[i] = !is_node (g, i) ? 0 : rough ? check_random (&state, 1000) / 1e3 : cos ((double) (k + i) / 3e3);
              ask_for (g, w, k);
            }
          celd_kcycle_solve (&g->cycle);
          for (size_t k = 0; k < (size_t) lanes; k++)
            CHECK (error_share (g, wanted + k * g->level->n, k) < 0.5);
        }
      free (wanted);
      grid_free (g);
    }
}

/* With one coarse level there is nothing to approximate. */
static void
a_small_grid_is_solved (void)
{
  Grid   *g = grid_new (12, 9, 1);
  double *wanted = calloc (g->level->n, sizeof *wanted);

  CHECK (g->levels.n == 2);
  for (size_t i = 0; i < g->level->n; i++)
    wanted[i] = is_node (g, i) ? (double) (i * i % 7) : 0;
  ask_for (g, wanted, 0);
  celd_kcycle_solve (&g->cycle);
  NEAR (error_share (g, wanted, 0), 0, 1e-4);
  free (wanted);
  grid_free (g);
}

/* Nothing in, nothing out; twice as much in, twice as much out; and never against the residual. */
static void
the_cycle_is_homogeneous_and_positive (void)
{
  Grid    *g = grid_new (160, 120, 1);
  size_t   n = g->level->n;
  float   *b = calloc (n, sizeof *b), *once = malloc (n * sizeof *once);
  uint32_t state = 11, wrong = 0;
  double   along = 0;

  celd_kcycle_solve (&g->cycle);
  for (size_t i = 0; i < n; i++)
    {
      wrong += found (g, i, 0) != 0;
      if (is_node (g, i))
        g->b[i] = b[i] = (float) check_random (&state, 2001) / 1000 - 1;
    }
  celd_kcycle_solve (&g->cycle);
  for (size_t i = 0; i < n; i++)
    once[i] = (float) found (g, i, 0);
  for (size_t i = 0; i < n; i++)
    {
      along += (double) b[i] * (double) once[i];
      g->b[i] = 2 * b[i];
    }
  celd_kcycle_solve (&g->cycle);
  for (size_t i = 0; i < n; i++)
    wrong += fabs (found (g, i, 0) - 2 * (double) once[i]) > 1e-4 * fabs ((double) once[i]) + 1e-6;
  NEAR (wrong, 0, 0);
  CHECK (along > 0);
  free (b);
  free (once);
  grid_free (g);
}

int
main (void)
{
  RUN (rough_and_smooth_errors_shrink_in_every_lane);
  RUN (a_small_grid_is_solved);
  RUN (the_cycle_is_homogeneous_and_positive);
  return DONE;
}
