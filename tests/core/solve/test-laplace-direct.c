/* Elimination without subtraction: against plain Gauss, with floating nodes and weights of extreme range.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "solve/laplace-private.h"

enum { N = 30, BAND = 7 };

/* A x = b by Gauss elimination; a is N x N. */
static void
gauss (double a[N][N], double *b)
{
  for (int i = 0; i < N; i++)
    for (int j = i + 1; j < N; j++)
      {
        double share = a[j][i] / a[i][i];

        for (int k = i; k < N; k++)
          a[j][k] -= share * a[i][k];
        b[j] -= share * b[i];
      }
  for (int i = N - 1; i >= 0; i--)
    {
      for (int k = i + 1; k < N; k++)
        b[i] -= a[i][k] * b[k];
      b[i] /= a[i][i];
    }
}

static void
random_graphs_agree_with_gauss (void)
{
  uint32_t seed = 9;

  for (int round = 0; round < 20; round++)
    {
      double         a[N][N] = { { 0 } }, b[N], x[N];
      CeldBandMatrix matrix;

      CHECK (celd_band_new (N, BAND, &matrix) == CELD_OK);
      for (int i = 0; i < N; i++)
        {
          for (int k = 1; k <= BAND && i + k < N; k++)
            {
              double w = check_random (&seed, 3) ? check_random (&seed, 100) / 50. : 0;

              matrix.weight[i * BAND + k - 1] = w;
              a[i][i] += w;
              a[i + k][i + k] += w;
              a[i][i + k] -= w;
              a[i + k][i] -= w;
            }
          matrix.diagonal[i] = 0.01 + check_random (&seed, 5);
          a[i][i] += matrix.diagonal[i];
          x[i] = b[i] = check_random (&seed, 100) - 50.;
        }
      celd_band_eliminate (&matrix);
      celd_band_solve (&matrix, 1, x);
      gauss (a, b);
      for (int i = 0; i < N; i++)
        NEAR (x[i], b[i], 1e-9);
      celd_band_clear (&matrix);
    }
}

/* A chain whose links differ by a factor of 1e12 each: the ends still tell exactly. */
static void
weights_of_any_range_keep_their_precision (void)
{
  CeldBandMatrix matrix;
  double         drop = 0, x[6] = { 0 };

  CHECK (celd_band_new (6, 1, &matrix) == CELD_OK);
  matrix.diagonal[0] = 1;
  for (int i = 0; i < 5; i++)
    matrix.weight[i] = pow (10, i % 2 ? -6 * i : 6 * i);
  x[5] = 1; /* a unit current from the end to the held start */
  celd_band_eliminate (&matrix);
  celd_band_solve (&matrix, 1, x);
  NEAR (x[0], 1, 1e-12);
  for (int i = 0; i < 5; i++)
    {
      drop = pow (10, i % 2 ? 6 * i : -6 * i);
      CHECK (fabs (x[i + 1] - x[i] - drop) <= 1e-12 * x[i + 1]);
    }
  celd_band_clear (&matrix);
}

static void
a_floating_component_is_solved_with_its_last_node_at_zero (void)
{
  CeldBandMatrix matrix;
  double         x[5] = { 0 };

  CHECK (celd_band_new (5, 2, &matrix) == CELD_OK);
  matrix.weight[0 * 2 + 1] = 1; /* 0 - 2 - 4 float, 1 - 3 is held at 3 */
  matrix.weight[2 * 2 + 1] = 0.5;
  matrix.weight[1 * 2 + 1] = 2;
  matrix.diagonal[3] = 1;
  x[0] = 1;
  x[4] = -1;
  x[1] = 4;
  celd_band_eliminate (&matrix);
  celd_band_solve (&matrix, 1, x);
  NEAR (x[4], 0, 0);
  NEAR (x[2], 2, 1e-12);
  NEAR (x[0], 3, 1e-12);
  NEAR (x[3], 4, 1e-12);
  NEAR (x[1], 6, 1e-12);
  celd_band_clear (&matrix);
}

int
main (void)
{
  RUN (random_graphs_agree_with_gauss);
  RUN (weights_of_any_range_keep_their_precision);
  RUN (a_floating_component_is_solved_with_its_last_node_at_zero);
  return DONE;
}
