/* The cycle over the coarse levels as a preconditioner: how near it comes, and what a preconditioner must not do.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "laplace.h"

#define MOST_PIXELS (160 * 120)

typedef struct { float east[MOST_PIXELS], south[MOST_PIXELS], sink[MOST_PIXELS]; CeldLevels levels; } Grid;

/* Weights from 1e-3 to 1, held weakly. */
static Grid *
grid_new (int width, int height)
{
  Grid    *g = calloc (1, sizeof *g);
  uint32_t state = 5;

  for (int i = 0; i < width * height; i++)
    {
      g->east[i] = i % width == width - 1 ? 0 : check_random (&state, 4) ? 1 : 1e-3f;
      g->south[i] = i / width == height - 1 ? 0 : check_random (&state, 4) ? 1 : 1e-3f;
      g->sink[i] = 1e-3f;
    }
  CHECK (celd_levels_new (width, height, g->east, g->south, g->sink, NULL, &g->levels) == CELD_OK);
  return g;
}

static void
grid_free (Grid *g)
{
  celd_levels_clear (&g->levels);
  free (g);
}

/* b = A wanted, on the first level. */
static void
ask_for (CeldLevel *level, const float *wanted)
{
  for (uint32_t i = 0; i < level->n; i++)
    {
      double sum = (double) level->sink[i] * (double) wanted[i];

      for (uint32_t e = level->start[i]; e < level->start[i + 1]; e++)
        sum += (double) level->weight[e] * ((double) wanted[i] - (double) wanted[level->neighbour[e]]);
      level->b[i] = (float) sum;
    }
}

/* The error x - wanted in the norm of A, as a share of wanted. */
static double
error_share (const CeldLevel *level, const float *wanted)
{
  double error = 0, whole = 0;

  for (uint32_t i = 0; i < level->n; i++)
    {
      double d = (double) level->x[i] - (double) wanted[i];

      error += (double) level->sink[i] * d * d;
      whole += (double) level->sink[i] * (double) wanted[i] * (double) wanted[i];
      for (uint32_t e = level->start[i]; e < level->start[i + 1]; e++)
        {
          uint32_t j = level->neighbour[e];
          double   across = d - ((double) level->x[j] - (double) wanted[j]);
          double   slope = (double) wanted[i] - (double) wanted[j];

          error += (double) level->weight[e] * across * across / 2;
          whole += (double) level->weight[e] * slope * slope / 2;
        }
    }
  return sqrt (error / whole);
}

static void
rough_and_smooth_errors_shrink (void)
{
  Grid      *g = grid_new (160, 120);
  CeldLevel *level = &g->levels.level[0];
  float     *wanted = malloc (level->n * sizeof *wanted);
  uint32_t   state = 9;

  CHECK (g->levels.n > 1);
  for (int rough = 0; rough < 2; rough++)
    {
      for (uint32_t i = 0; i < level->n; i++)
        wanted[i] = rough ? (float) check_random (&state, 1000) / 1000 : (float) i / (float) level->n;
      ask_for (level, wanted);
      celd_levels_cycle (&g->levels);
      CHECK (error_share (level, wanted) < 0.5);
    }
  free (wanted);
  grid_free (g);
}

/* With one level there is nothing to approximate. */
static void
a_small_grid_is_solved (void)
{
  Grid      *g = grid_new (6, 5);
  CeldLevel *level = &g->levels.level[0];
  float      wanted[30];

  CHECK (g->levels.n == 1);
  for (uint32_t i = 0; i < level->n; i++)
    wanted[i] = (float) (i * i % 7);
  ask_for (level, wanted);
  celd_levels_cycle (&g->levels);
  NEAR (error_share (level, wanted), 0, 1e-4);
  grid_free (g);
}

/* Nothing in, nothing out; twice as much in, twice as much out; and never against the residual. */
static void
the_cycle_is_homogeneous_and_positive (void)
{
  Grid      *g = grid_new (160, 120);
  CeldLevel *level = &g->levels.level[0];
  float     *b = malloc (level->n * sizeof *b), *once = malloc (level->n * sizeof *once);
  uint32_t   state = 11, wrong = 0;
  double     along = 0;

  memset (level->b, 0, level->n * sizeof *level->b);
  celd_levels_cycle (&g->levels);
  for (uint32_t i = 0; i < level->n; i++)
    {
      wrong += level->x[i] != 0;
      level->b[i] = b[i] = (float) check_random (&state, 2001) / 1000 - 1;
    }
  celd_levels_cycle (&g->levels);
  memcpy (once, level->x, level->n * sizeof *once);
  for (uint32_t i = 0; i < level->n; i++)
    {
      along += (double) b[i] * (double) once[i];
      level->b[i] = 2 * b[i];
    }
  celd_levels_cycle (&g->levels);
  for (uint32_t i = 0; i < level->n; i++)
    wrong += fabsf (level->x[i] - 2 * once[i]) > 1e-4f * fabsf (once[i]) + 1e-6f;
  NEAR (wrong, 0, 0);
  CHECK (along > 0);
  free (b);
  free (once);
  grid_free (g);
}

int
main (void)
{
  RUN (rough_and_smooth_errors_shrink);
  RUN (a_small_grid_is_solved);
  RUN (the_cycle_is_homogeneous_and_positive);
  return DONE;
}
