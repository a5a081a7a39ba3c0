/* The coarse levels: aggregates respect walls and cells, weights are sums, the cycle is a good approximation.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "laplace.h"

enum { W = 150, H = 130 };

typedef struct { float east[W * H], south[W * H], sink[W * H]; CeldLevels levels; } Grid;

/* Unit weights, a wall of weight `wall` round the pixels left of column 71, all held weakly. */
static Grid *
grid_new (float wall)
{
  Grid *g = calloc (1, sizeof *g);

  for (int i = 0; i < W * H; i++)
    {
      g->east[i]  = i % W == W - 1 ? 0 : i % W == 70 ? wall : 1;
      g->south[i] = i / W == H - 1 ? 0 : 1;
      g->sink[i]  = 1e-3f;
    }
  CHECK (celd_levels_new (W, H, g->east, g->south, g->sink, NULL, &g->levels) == CELD_OK);
  return g;
}

static void
grid_free (Grid *g)
{
  celd_levels_clear (&g->levels);
  free (g);
}

static void
no_aggregate_reaches_over_a_wall_or_its_cell (void)
{
  Grid           *g = grid_new (1e-3f);
  const uint32_t *node = g->levels.coarser;
  int            *first = malloc (g->levels.level[0].n * sizeof *first);

  for (uint32_t c = 0; c < g->levels.level[0].n; c++)
    first[c] = -1;
  for (int i = 0; i < W * H; i++)
    {
      int *f = &first[node[i]];

      if (*f < 0)
        *f = i;
      CHECK (i % W / 2 == *f % W / 2 && i / W / 2 == *f / W / 2);
      CHECK ((i % W > 70) == (*f % W > 70));
    }
  free (first);
  grid_free (g);
}

/* Nothing is lost or made up between levels. */
static void
weights_and_sinks_are_sums (void)
{
  Grid            *g = grid_new (0.25f);
  const CeldLevel *l = &g->levels.level[0];
  double           sink = 0, crossing = 0, edges = 0;

  for (int i = 0; i < W * H; i++)
    {
      sink += (double) g->sink[i];
      if (g->levels.coarser[i] != g->levels.coarser[i + 1 < W * H ? i + 1 : i])
        crossing += 2 * (double) g->east[i];
      if (i + W < W * H && g->levels.coarser[i] != g->levels.coarser[i + W])
        crossing += 2 * (double) g->south[i];
    }
  for (uint32_t c = 0; c < l->n; c++)
    {
      sink -= (double) l->sink[c];
      for (uint32_t e = l->start[c]; e < l->start[c + 1]; e++)
        {
          edges += (double) l->weight[e];
          CHECK (l->neighbour[e] != c && (l->neighbour[e] < c) == (e < l->middle[c]));
        }
    }
  NEAR (sink, 0, 1e-6);
  NEAR (edges, crossing, 1e-3);
  grid_free (g);
}

static void
levels_become_small_quickly (void)
{
  Grid *g = grid_new (0);

  for (int l = 1; l < g->levels.n; l++)
    CHECK (g->levels.level[l].n <= 0.6 * g->levels.level[l - 1].n);
  CHECK (g->levels.level[g->levels.n - 1].n <= 150);
  CHECK (g->levels.n >= 2);
  grid_free (g);
}

/* One cycle takes most of a smooth error away. */
static void
the_cycle_solves_approximately (void)
{
  Grid      *g = grid_new (1e-3f);
  CeldLevel *l = &g->levels.level[0];
  double     error = 0, size = 0;

  for (uint32_t c = 0; c < l->n; c++) /* A x for x = 1 everywhere */
    l->b[c] = l->sink[c];
  celd_levels_cycle (&g->levels);
  for (uint32_t c = 0; c < l->n; c++)
    {
      error += (l->x[c] - 1.) * (l->x[c] - 1.);
      size  += 1;
    }
  NEAR (sqrt (error / size), 0, 0.25);
  grid_free (g);
}

static void
pixels_without_an_edge_are_left_out (void)
{
  Grid *g = calloc (1, sizeof *g);

  CHECK (celd_levels_new (W, H, g->east, g->south, g->sink, NULL, &g->levels) == CELD_OK);
  CHECK (g->levels.n == 1 && g->levels.level[0].n == 0);
  for (int i = 0; i < W * H; i += 11)
    CHECK (g->levels.coarser[i] == CELD_NO_NODE);
  celd_levels_cycle (&g->levels);
  grid_free (g);
}

int
main (void)
{
  RUN (no_aggregate_reaches_over_a_wall_or_its_cell);
  RUN (weights_and_sinks_are_sums);
  RUN (levels_become_small_quickly);
  RUN (the_cycle_solves_approximately);
  RUN (pixels_without_an_edge_are_left_out);
  return DONE;
}
