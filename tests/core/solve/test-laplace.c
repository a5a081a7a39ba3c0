/* The Laplacian solver against an oracle of its own (banded Cholesky) and against known answers.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "systems.h"
#include "solve/laplace.h"

#include <float.h>

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
      System    s = random_system (135 + (int) check_random (&seed, 40), 140 + (int) check_random (&seed, 60), &seed);
      CeldSolve how = solve (&s, 1e-4);

      CHECK (how.converged);
      NEAR (error_of (&s), 0, 1e-4);
      system_free (&s);
    }
}

/* Blobs of ink whose outlines have the least weight, a fixed stroke one pixel away from each: that pixel is held by the
 * stroke far more than by the ink, and must not hold the ink so. */
static System
inked_system (float least, uint32_t *seed)
{
  System   s = system_new (150, 140, 1, 0.7f + (float) check_random (seed, 3) / 10);
  uint8_t *fixed = calloc (pixels (&s), 1);
  float   *value = calloc (pixels (&s), sizeof *value);

  for (int blob = 0; blob < 8; blob++)
    {
      int x0 = 3 + (int) check_random (seed, 100), x1 = x0 + 8 + (int) check_random (seed, 30);
      int y0 = 3 + (int) check_random (seed, 90), y1 = y0 + 8 + (int) check_random (seed, 30);
      int rim = 1 + (int) check_random (seed, 4);

      for (int y = y0 - 1; y <= y1; y++)
        for (int x = x0 - 1; x <= x1; x++)
          if (x < x0 + rim || x > x1 - rim || y < y0 + rim || y > y1 - rim)
            s.east[y * s.w + x] = s.south[y * s.w + x] = least;
      for (int x = x0; x <= x1; x++)
        {
          fixed[(y0 - 2) * s.w + x] = 1;
          value[(y0 - 2) * s.w + x] = (float) blob;
        }
    }
  pin (&s, fixed, value);
  free (fixed);
  free (value);
  return s;
}

static void
ink_behind_a_fixed_stroke_agrees_with_the_oracle (void)
{
  static const float least[] = { 1e-6f, 1e-5f, 1e-4f, 1e-2f, 1 };
  uint32_t           seed = 13;

  for (size_t k = 0; k < 10; k++)
    {
      System    s = inked_system (least[k % 5], &seed);
      CeldSolve how = solve (&s, 1e-4);

      CHECK (how.converged && how.iterations < 40);
      NEAR (error_of (&s), 0, 1e-4);
      system_free (&s);
    }
}

/* Islands of strong links in a band of weak ones, as noise makes them within a line, many of them across cells. */
static void
islands_in_ink_agree_with_the_oracle (void)
{
  uint32_t seed = 17;

  for (int round = 0; round < 3; round++)
    {
      System   s = system_new (150, 140, 1, 1);
      uint8_t *fixed = calloc (pixels (&s), 1);
      float   *value = calloc (pixels (&s), sizeof *value);

      for (int i = 40 * s.w; i < 100 * s.w; i++)
        s.east[i] = s.south[i] = 1e-6f;
      for (int k = 0; k < 400; k++)
        {
          int x0 = (int) check_random (&seed, 140), y0 = 42 + (int) check_random (&seed, 50);

          for (int x = x0; x < x0 + 5; x++)
            s.east[y0 * s.w + x] = s.south[y0 * s.w + x] = s.east[(y0 + 1) * s.w + x] = 1;
        }
      for (int x = 0; x < s.w; x++)
        {
          fixed[x] = fixed[139 * s.w + x] = 1;
          value[x] = x < 75;
        }
      pin (&s, fixed, value);
      CHECK (solve (&s, 1e-4).converged);
      NEAR (error_of (&s), 0, 1e-4);
      free (fixed);
      free (value);
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

/* Harmonic bases: fixed strokes, one lane each, against the same by pin one by one. */
static void
lanes_equal_single_solutions (void)
{
  static const int size[][2] = { { 30, 20 }, { 150, 130 } };

  for (size_t round = 0; round < 2; round++)
    {
      System       s = system_new (size[round][0], size[round][1], 1, 1);
      size_t       n = pixels (&s);
      uint8_t     *stroke = calloc (n, 1), *fixed = calloc (n, 1);
      float       *x = calloc (n * CELD_LANES, sizeof *x), *value = calloc (n, sizeof *value);
      CeldLaplace *l = NULL;
      CeldSolve    how = { 0 };
      uint32_t     seed = 5;

      for (size_t i = 0; i < n; i++)
        {
          s.east[i]  = check_random (&seed, 5) ? 1 : 1e-3f;
          s.south[i] = check_random (&seed, 5) ? 1 : 1e-3f;
          stroke[i]  = check_random (&seed, 40) ? 0 : (uint8_t) (1 + check_random (&seed, 7));
          fixed[i]   = stroke[i] != 0;
          if (fixed[i])
            x[i * CELD_LANES + stroke[i] - 1] = 1;
        }
      CHECK (celd_lap_setup (s.w, s.h, s.east, s.south, NULL, fixed, NULL, &l) == CELD_OK);
      CHECK (celd_lap_solve_lanes (l, NULL, x, 1e-5, NULL, &how) == CELD_OK && how.converged);
      celd_lap_free (l);
      for (size_t k = 0; k < CELD_LANES; k++)
        {
          System one = system_new (s.w, s.h, 1, 1);
          double worst = 0;

          memcpy (one.east, s.east, n * sizeof *s.east);
          memcpy (one.south, s.south, n * sizeof *s.south);
          for (size_t i = 0; i < n; i++)
            value[i] = stroke[i] == k + 1;
          pin (&one, fixed, value);
          solve (&one, 1e-6);
          for (size_t i = 0; i < n; i++)
            worst = fmax (worst, fabs ((double) x[i * CELD_LANES + k] - (double) one.x[i]));
          NEAR (worst, 0, 2e-5);
          system_free (&one);
        }
      free (stroke);
      free (fixed);
      free (value);
      free (x);
      system_free (&s);
    }
}

/* A page of rings drawn with a line of `thickness`, through the middle of which go gaps; weights fall from 1 on paper
 * to `least` under ink.  Some dots are fixed. */
static System
rings (int w, int h, double thickness, float least, uint8_t *fixed)
{
  System s = system_new (w, h, 1, 1);

  for (int y = 0; y < h; y++)
    for (int x = 0; x < w; x++)
      for (int k = 0; k < 2; k++)
        {
          double u = fmod (x + (k ? 0 : 0.5), 34) - 17, v = fmod (y + (k ? 0.5 : 0), 34) - 17;
          double ink = fmin (fmax (thickness / 2 + 0.5 - fabs (hypot (u, v) - 12), 0), 1);

          if (fabs (v) < 1.5 && u > 0 && x % 3)
            ink *= 0.5;
          *(k ? &s.south[y * w + x] : &s.east[y * w + x]) = (float) pow ((double) least, ink);
        }
  for (int i = 0; i < w * h; i++)
    fixed[i] = (i % w) % 51 == 17 && (i / w) % 34 == 17;
  return s;
}

static void
the_tolerance_holds_for_every_weight_floor (void)
{
  static const float  floor[]     = { 1, 0.1f, 1e-3f, 1e-6f };
  static const double tolerance[] = { 1e-3, 1. / 65535 };

  for (int k = 0; k < 12; k++)
    for (int fine = 0; fine < 2; fine++)
      {
        int      side = k % 3 == 0 ? 64 : k % 3 == 1 ? 128 : 150;
        uint8_t *fixed = calloc (150 * 150, 1);
        float   *value = calloc (150 * 150, sizeof *value);
        System   s = rings (side, side, 1.5, floor[k / 3], fixed);

        for (int i = 0; i < side * side; i++)
          s.x[i] = value[i] = fixed[i] ? (float) (i % 7) : 0;
        if (fine)
          pin (&s, fixed, value);
        else
          {
            CeldLaplace *l = NULL;

            CHECK (celd_lap_setup (s.w, s.h, s.east, s.south, NULL, fixed, NULL, &l) == CELD_OK);
            CHECK (celd_lap_solve (l, 1, NULL, s.x, tolerance[0], NULL, NULL) == CELD_OK);
            celd_lap_free (l);
            pin (&s, fixed, value); /* for the oracle */
          }
        if (fine)
          CHECK (solve (&s, tolerance[1]).converged);
        NEAR (error_of (&s), 0, tolerance[fine]);
        free (fixed);
        free (value);
        system_free (&s);
      }
}

static void
a_start_near_the_solution_saves_rounds (void)
{
  uint8_t     *fixed = calloc (200 * 190, 1);
  System       s = rings (200, 190, 3, 0.01f, fixed);
  CeldLaplace *l = NULL;
  CeldSolve    cold, warm, again;

  for (size_t i = 0; i < pixels (&s); i++)
    s.x[i] = fixed[i] ? (float) (i % 5) : 0;
  CHECK (celd_lap_setup (s.w, s.h, s.east, s.south, NULL, fixed, NULL, &l) == CELD_OK);
  CHECK (celd_lap_solve (l, 1, NULL, s.x, 1e-5, NULL, &cold) == CELD_OK && cold.converged);
  CHECK (celd_lap_solve (l, 1, NULL, s.x, 1e-4, NULL, &again) == CELD_OK && again.converged);
  CHECK (again.iterations <= 1);
  for (size_t i = 0; i < pixels (&s); i++)
    s.x[i] += fixed[i] ? 0 : (float) (i % 200 < 40 ? 0.01 : 0);
  CHECK (celd_lap_solve (l, 1, NULL, s.x, 1e-4, NULL, &warm) == CELD_OK && warm.converged);
  CHECK (warm.iterations < cold.iterations);
  celd_lap_free (l);
  free (fixed);
  system_free (&s);
}

static void
what_is_not_a_positive_number_is_no_weight (void)
{
  System s = system_new (140, 100, 1, 1), t = system_new (140, 100, 1, 1);

  for (int y = 0; y < s.h; y++)
    {
      s.east[y * s.w + 70] = y % 2 ? NAN : -1;
      t.east[y * s.w + 70] = 0;
      s.diagonal[y * s.w + 3] = NAN;
    }
  pin_columns (&s, 0, 1, s.w - 1, 5);
  pin_columns (&t, 0, 1, s.w - 1, 5);
  solve (&s, 1e-5);
  solve (&t, 1e-5);
  CHECK (memcmp (s.x, t.x, pixels (&s) * sizeof *s.x) == 0);
  system_free (&s);
  system_free (&t);
}

int
main (void)
{
  RUN (random_systems_agree_with_the_oracle);
  RUN (large_random_systems_agree_with_the_oracle);
  RUN (ink_behind_a_fixed_stroke_agrees_with_the_oracle);
  RUN (islands_in_ink_agree_with_the_oracle);
  RUN (between_two_columns_it_is_a_ramp);
  RUN (a_closed_wall_of_one_pixel_keeps_both_sides_apart);
  RUN (a_gap_in_a_wall_lets_depth_through_smoothly);
  RUN (several_right_hand_sides_equal_single_ones);
  RUN (the_tolerance_holds_for_every_weight_floor);
  RUN (a_start_near_the_solution_saves_rounds);
  RUN (what_is_not_a_positive_number_is_no_weight);
  RUN (lanes_equal_single_solutions);
  return DONE;
}
