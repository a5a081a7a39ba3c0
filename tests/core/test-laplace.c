/* The Laplacian solver against an oracle of its own (banded Cholesky) and against known answers.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "private.h"

#include <float.h>

/* A system of the test, its start and its right-hand sides. */
typedef struct
{
  int    w, h, nrhs;
  float *east, *south, *diagonal, *b, *x;
} System;

static size_t
pixels (const System *s)
{
  return (size_t) s->w * (size_t) s->h;
}

static System
system_new (int w, int h, int nrhs, float weight)
{
  size_t n = (size_t) w * (size_t) h;
  System s = { w, h, nrhs, malloc (n * sizeof (float)), malloc (n * sizeof (float)), calloc (n, sizeof (float)),
               calloc (n * (size_t) nrhs, sizeof (float)), calloc (n * (size_t) nrhs, sizeof (float)) };

  for (size_t i = 0; i < n; i++)
    s.east[i] = s.south[i] = weight;
  return s;
}

static void
system_free (System *s)
{
  free (s->east);
  free (s->south);
  free (s->diagonal);
  free (s->b);
  free (s->x);
}

static void
pin (System *s, const uint8_t *fixed, const float *value)
{
  celd_lap_pin (s->w, s->h, fixed, s->nrhs, value, s->east, s->south, s->diagonal, s->b);
}

static CeldSolve
solve (System *s, double tolerance)
{
  CeldLaplace *l = NULL;
  CeldSolve    how = { 0 };

  CHECK (celd_lap_setup (s->w, s->h, s->east, s->south, s->diagonal, NULL, &l) == CELD_OK);
  if (l)
    CHECK (celd_lap_solve (l, s->nrhs, s->b, s->x, tolerance, NULL, &how) == CELD_OK);
  celd_lap_free (l);
  return how;
}

/* Exact solution by Cholesky in a band, for systems without floating components. */
static double *
oracle (const System *s)
{
  size_t  n = pixels (s), w = (size_t) s->w;
  double *a = calloc (n * (w + 1), sizeof *a), *x = malloc (n * sizeof *x);

#define A(i, j) a[(i) * (w + 1) + (i) - (j)] /* j <= i <= j + w */
  for (size_t i = 0; i < n; i++)
    {
      A (i, i) += (double) s->diagonal[i];
      x[i] = (double) s->b[i];
      for (int k = 0; k < 2; k++)
        {
          size_t j = k ? i + w : i + 1;
          double v = (double) (k ? s->south[i] : s->east[i]);

          if (k ? j >= n : j % w == 0)
            continue;
          A (i, i) += v;
          A (j, j) += v;
          A (j, i) -= v;
        }
    }
  for (size_t i = 0; i < n; i++)
    {
      size_t from = i > w ? i - w : 0;

      for (size_t j = from; j <= i; j++)
        {
          double sum = A (i, j);

          for (size_t k = j > w && j - w > from ? j - w : from; k < j; k++)
            sum -= A (i, k) * A (j, k);
          A (i, j) = j < i ? sum / A (j, j) : sqrt (sum);
        }
    }
  for (size_t i = 0; i < n; i++)
    {
      for (size_t k = i > w ? i - w : 0; k < i; k++)
        x[i] -= A (i, k) * x[k];
      x[i] /= A (i, i);
    }
  for (size_t i = n; i-- > 0;)
    {
      for (size_t k = i + 1; k < n && k <= i + w; k++)
        x[i] -= A (k, i) * x[k];
      x[i] /= A (i, i);
    }
#undef A
  free (a);
  return x;
}

/* Largest difference of the solution from the oracle, as a share of the oracle's range. */
static double
error_of (const System *s)
{
  double *x = oracle (s), worst = 0, low = DBL_MAX, high = -DBL_MAX;

  for (size_t i = 0; i < pixels (s); i++)
    {
      worst = fmax (worst, fabs (x[i] - (double) s->x[i]));
      low   = fmin (low, x[i]);
      high  = fmax (high, x[i]);
    }
  free (x);
  return worst / fmax (high - low, 1e-3 * fabs (high));
}

/* Weights from nothing over 1e-6 to 1, walls of one pixel, and pins; every component is held by a small diagonal. */
static System
random_system (int w, int h, uint32_t *seed)
{
  static const float choice[] = { 0, 1e-6f, 1e-3f, 0.1f, 0.5f, 1, 1, 1 };
  System             s = system_new (w, h, 1, 1);
  uint8_t           *fixed = calloc (pixels (&s), 1);
  float             *value = calloc (pixels (&s), sizeof *value);
  int                kind = (int) check_random (seed, 3);

  for (size_t i = 0; i < pixels (&s); i++)
    {
      int x = (int) i % w, y = (int) i / w, wall = (x + y * 2) % 23 == 0 || (kind == 1 && y % 17 == 0);

      if (kind == 0)
        {
          s.east[i]  = choice[check_random (seed, 8)];
          s.south[i] = choice[check_random (seed, 8)];
        }
      else if (wall)
        s.east[i] = s.south[i] = check_random (seed, 40) ? 1e-6f : 0.3f;
      fixed[i]      = check_random (seed, 400) == 0;
      value[i]      = (float) check_random (seed, 5);
      s.diagonal[i] = kind == 0 ? 1e-5f : 0;
    }
  fixed[0] = fixed[pixels (&s) - 1] = 1;
  pin (&s, fixed, value);
  free (fixed);
  free (value);
  return s;
}

static void
random_systems_agree_with_the_oracle (void)
{
  uint32_t seed = 7;

  for (int round = 0; round < 24; round++)
    {
      System    s = random_system (1 + (int) check_random (&seed, 40), 1 + (int) check_random (&seed, 40), &seed);
      CeldSolve how = solve (&s, 1e-5);

      CHECK (how.converged);
      NEAR (error_of (&s), 0, 2e-5);
      system_free (&s);
    }
}

/* Too large to be eliminated: these go through the levels. */
static void
large_random_systems_agree_with_the_oracle (void)
{
  uint32_t seed = 11;

  for (int round = 0; round < 8; round++)
    {
      System    s = random_system (101 + (int) check_random (&seed, 60), 110 + (int) check_random (&seed, 90), &seed);
      CeldSolve how = solve (&s, 1e-4);

      CHECK (how.converged);
      NEAR (error_of (&s), 0, 1e-4);
      system_free (&s);
    }
}

/* Pins column x to a value. */
static void
pin_columns (System *s, int x0, float value0, int x1, float value1)
{
  uint8_t *fixed = calloc (pixels (s), 1);
  float   *value = calloc (pixels (s), sizeof *value);

  for (int y = 0; y < s->h; y++)
    {
      fixed[y * s->w + x0] = fixed[y * s->w + x1] = 1;
      value[y * s->w + x0] = value0;
      value[y * s->w + x1] = value1;
    }
  pin (s, fixed, value);
  free (fixed);
  free (value);
}

static void
between_two_columns_it_is_a_ramp (void)
{
  static const int size[][2] = { { 2, 1 }, { 9, 1 }, { 40, 30 }, { 300, 200 } };

  for (size_t k = 0; k < sizeof size / sizeof *size; k++)
    {
      System s = system_new (size[k][0], size[k][1], 1, 1);

      pin_columns (&s, 0, 10, s.w - 1, 20);
      CHECK (solve (&s, 1e-5).converged);
      for (int y = 0; y < s.h; y += 7)
        for (int x = 0; x < s.w; x++)
          NEAR (s.x[y * s.w + x], 10 + 10. * x / (s.w - 1), 2e-4);
      system_free (&s);
    }
}

static void
a_closed_wall_of_one_pixel_keeps_both_sides_apart (void)
{
  System s = system_new (220, 180, 1, 1);

  for (int y = 0; y < s.h; y++)
    s.east[y * s.w + 100] = s.east[y * s.w + 101] = 0;
  pin_columns (&s, 0, 1, s.w - 1, 5);
  CHECK (solve (&s, 1e-5).converged);
  for (int y = 0; y < s.h; y++)
    {
      NEAR (s.x[y * s.w + 100], 1, 1e-4);
      NEAR (s.x[y * s.w + 101], 0, 0); /* the wall itself floats and keeps its start */
      NEAR (s.x[y * s.w + 102], 5, 1e-4);
    }
  system_free (&s);
}

static void
a_gap_in_a_wall_lets_depth_through_smoothly (void)
{
  System s = system_new (160, 120, 1, 1);

  for (int y = 0; y < s.h; y++)
    if (y < 60 || y > 64)
      s.east[y * s.w + 80] = 0;
  pin_columns (&s, 0, 0, s.w - 1, 1);
  CHECK (solve (&s, 1e-5).converged);
  NEAR (error_of (&s), 0, 1e-5);
  for (int x = 1; x < s.w; x++)
    CHECK (s.x[62 * s.w + x] > s.x[62 * s.w + x - 1]);
  NEAR (s.x[62 * s.w + 80] + s.x[62 * s.w + 81], 1, 0.05);
  system_free (&s);
}

static void
a_floating_component_keeps_the_mean_of_its_start (void)
{
  static const int size[][2] = { { 1, 1 }, { 1, 50 }, { 30, 20 }, { 250, 220 } };

  for (size_t k = 0; k < sizeof size / sizeof *size; k++)
    {
      System   s = system_new (size[k][0], size[k][1], 1, 1);
      uint32_t seed = 5;
      double   left = 0, n = 0;
      int      wall = s.w / 2;

      for (int y = 0; y < s.h; y++)
        for (int x = 0; x < s.w; x++)
          {
            s.x[y * s.w + x] = 3 + (float) check_random (&seed, 100) / 100;
            if (x == wall)
              s.east[y * s.w + x] = 0;
            left += x <= wall ? (double) s.x[y * s.w + x] : 0;
            n    += x <= wall;
          }
      CHECK (solve (&s, 1e-5).converged);
      for (int y = 0; y < s.h; y++)
        for (int x = 0; x <= wall; x++)
          NEAR (s.x[y * s.w + x], left / n, 1e-4);
      system_free (&s);
    }
}

static void
a_floating_component_bends_under_its_right_hand_side (void)
{
  System s = system_new (130, 110, 1, 1);

  s.b[0] = 1;
  s.b[129] = -1;
  CHECK (solve (&s, 1e-6).converged);
  for (int y = 0; y < s.h; y++)
    NEAR (s.x[y * s.w] + s.x[y * s.w + 129], 0, 2e-5);
  NEAR ((double) s.x[0] * 2 - (double) s.x[1] - (double) s.x[130], 1, 1e-3);
  system_free (&s);
}

static void
several_right_hand_sides_equal_single_ones (void)
{
  System   s = system_new (140, 120, 3, 1);
  size_t   n = pixels (&s);
  uint8_t *fixed = calloc (n, 1);
  float   *value = calloc (3 * n, sizeof *value);
  float   *x = malloc (3 * n * sizeof *x);
  uint32_t seed = 3;

  for (size_t i = 0; i < n; i += 501)
    {
      fixed[i] = 1;
      for (size_t k = 0; k < 3; k++)
        value[k * n + i] = (float) check_random (&seed, 9);
    }
  pin (&s, fixed, value);
  CHECK (solve (&s, 1e-4).converged);
  memcpy (x, s.x, 3 * n * sizeof *x);
  for (size_t k = 0; k < 3; k++)
    {
      System one = s;

      one.nrhs = 1;
      one.b    = s.b + k * n;
      memset (s.x, 0, n * sizeof *x);
      solve (&one, 1e-4);
      CHECK (memcmp (s.x, x + k * n, n * sizeof *x) == 0);
    }
  free (fixed);
  free (value);
  free (x);
  system_free (&s);
}

/* A host that runs the pieces backwards, and one that cancels. */
static void
backwards (void *host, int n, void (*body) (void *data, int i), void *data)
{
  (void) host;
  while (n-- > 0)
    body (data, n);
}

typedef struct { int left; double last; bool fell; } Patience;

static bool
impatient (void *host, double done)
{
  Patience *p = host;

  p->fell = p->fell || done < p->last || done > 1;
  p->last = done;
  return p->left-- > 0;
}

static void
threads_change_nothing_and_cancelling_works (void)
{
  uint32_t     seed = 23;
  System       s = random_system (150, 170, &seed);
  size_t       n = pixels (&s);
  float       *x = calloc (n, sizeof *x);
  Patience     patience = { 1000, 0, false };
  CeldRun      run = { impatient, backwards, &patience };
  CeldLaplace *l = NULL;

  solve (&s, 1e-4);
  CHECK (celd_lap_setup (s.w, s.h, s.east, s.south, s.diagonal, NULL, &l) == CELD_OK);
  CHECK (celd_lap_solve (l, 1, s.b, x, 1e-4, &run, NULL) == CELD_OK);
  CHECK (memcmp (x, s.x, n * sizeof *x) == 0);
  CHECK (!patience.fell);
  patience = (Patience) { 2, 0, false };
  memset (x, 0, n * sizeof *x);
  CHECK (celd_lap_solve (l, 1, s.b, x, 1e-4, &run, NULL) == CELD_CANCELLED);
  celd_lap_free (l);
  patience = (Patience) { 1, 0, false };
  l = NULL;
  CHECK (celd_lap_setup (s.w, s.h, s.east, s.south, s.diagonal, &run, &l) == CELD_CANCELLED && !l);
  free (x);
  system_free (&s);
}

int
main (void)
{
  RUN (random_systems_agree_with_the_oracle);
  RUN (large_random_systems_agree_with_the_oracle);
  RUN (between_two_columns_it_is_a_ramp);
  RUN (a_closed_wall_of_one_pixel_keeps_both_sides_apart);
  RUN (a_gap_in_a_wall_lets_depth_through_smoothly);
  RUN (a_floating_component_keeps_the_mean_of_its_start);
  RUN (a_floating_component_bends_under_its_right_hand_side);
  RUN (several_right_hand_sides_equal_single_ones);
  RUN (threads_change_nothing_and_cancelling_works);
  return DONE;
}
