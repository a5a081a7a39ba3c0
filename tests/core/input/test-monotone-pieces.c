/* Values that only fall or rise, and the best division of others: against trying everything.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "input/joined-arrows.h"

#define MOST 10

static double
mean (const double *value, int from, int to)
{
  double sum = 0;

  for (int i = from; i <= to; i++)
    sum += value[i];
  return sum / (to - from + 1);
}

/* The error of values from those that only rise, times `sign`: the nearest to value i is the largest, over all a <= i, of
 * the smallest, over all b >= i, mean from a to b (Robertson, Wright and Dykstra 1988, theorem 1.4.4). */
static double
error_of (const double *value, int n, double sign)
{
  double signed_value[MOST], error = 0;

  for (int i = 0; i < n; i++)
    signed_value[i] = sign * value[i];
  for (int i = 0; i < n; i++)
    {
      double largest = -INFINITY;

      for (int a = 0; a <= i; a++)
        {
          double smallest = INFINITY;

          for (int b = i; b < n; b++)
            smallest = fmin (smallest, mean (signed_value, a, b));
          largest = fmax (largest, smallest);
        }
      error += (signed_value[i] - largest) * (signed_value[i] - largest);
    }
  return error;
}

static double
least_error_of (const double *value, int n)
{
  return fmin (error_of (value, n, 1), error_of (value, n, -1));
}

/* The least error of n values in so many pieces of at least `part` values, by trying all. */
static double
error_in_pieces (const double *value, int n, int part, int pieces)
{
  double least = INFINITY;

  if (pieces == 1)
    return n >= part ? least_error_of (value, n) : INFINITY;
  for (int i = part; i + part <= n; i++)
    least = fmin (least, least_error_of (value, i) + error_in_pieces (value + i, n - i, part, pieces - 1));
  return least;
}

static void
fill (double *value, uint32_t *state)
{
  for (int i = 0; i < MOST; i++)
    value[i] = check_random (state, 6);
}

static void
errors (void)
{
  uint32_t state = 3;

  for (int trial = 0; trial < 400; trial++)
    {
      double value[MOST], error;
      int    n = 1 + (int) check_random (&state, MOST);
      bool   rises;

      fill (value, &state);
      CHECK (celd_monotone_error (value, (size_t) n, &rises, &error) == CELD_OK);
      CHECK (fabs (error - least_error_of (value, n)) < 1e-9);
      CHECK (fabs (error - error_of (value, n, rises ? 1 : -1)) < 1e-9);
    }
}

static void
divisions (void)
{
  uint32_t state = 5;

  for (int trial = 0; trial < 200; trial++)
    {
      double value[MOST], most = check_random (&state, 5), error = 0;
      int    part = 1 + (int) check_random (&state, 2), fewest = 1;
      size_t cut[CELD_MOST_PIECES + 1], n;

      fill (value, &state);
      while (fewest <= CELD_MOST_PIECES && error_in_pieces (value, MOST, part, fewest) > most + 1e-9)
        fewest++;
      CHECK (celd_monotone_divide (value, MOST, (size_t) part, most + 1e-9, cut, &n) == CELD_OK);
      CHECK (n == (fewest <= CELD_MOST_PIECES ? (size_t) fewest : 0));
      for (size_t i = 0; i < n; i++)
        {
          CHECK (cut[i + 1] >= cut[i] + (size_t) part);
          error += least_error_of (value + cut[i], (int) (cut[i + 1] - cut[i]));
        }
      CHECK (!n || (cut[0] == 0 && cut[n] == MOST && error <= most + 1e-6));
    }
}

static void
ranges (void)
{
  uint32_t state = 7;

  for (int trial = 0; trial < 200; trial++)
    {
      double value[MOST], least = INFINITY, slack = check_random (&state, 3), error[MOST];
      size_t range[2], first = MOST, last = 0;

      fill (value, &state);
      for (int i = 2; i + 2 <= MOST; i++)
        {
          error[i] = least_error_of (value, i) + least_error_of (value + i, MOST - i);
          least    = fmin (least, error[i]);
        }
      for (size_t i = 2; i + 2 <= MOST; i++)
        if (error[i] <= least + slack + 1e-9)
          {
            first = first < i ? first : i;
            last  = i;
          }
      CHECK (celd_monotone_range (value, MOST, 2, slack + 1e-9, range) == CELD_OK);
      CHECK (range[0] == first && range[1] == last);
    }
}

/* A jump from weak to strong, and a turn: the shape of two arrows head to tail, and of two that meet at their tips. */
static void
two_arrows (void)
{
  const double jump[8] = { 1, 0.8, 0.6, 0.4, 1, 0.8, 0.6, 0.4 }, valley[7] = { 1, 0.7, 0.4, 0.1, 0.4, 0.7, 1 };
  size_t       cut[CELD_MOST_PIECES + 1], n;

  CHECK (celd_monotone_divide (jump, 8, 2, 1e-9, cut, &n) == CELD_OK && n == 2 && cut[1] == 4);
  CHECK (celd_monotone_divide (valley, 7, 2, 1e-9, cut, &n) == CELD_OK && n == 2 && (cut[1] == 3 || cut[1] == 4));
}

int
main (void)
{
  RUN (errors);
  RUN (divisions);
  RUN (ranges);
  RUN (two_arrows);
  return DONE;
}
