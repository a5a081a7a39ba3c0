/* Harmonic bases and their stiffness: known answers on strips, and a dense direct solution of random small systems.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "depth/depth.h"
#include "solve/laplace.h"

#define MOST 400 /* pixels of a test's picture */

typedef struct { int w, h; float east[MOST], south[MOST]; uint32_t node[MOST]; CeldHarmonicBases bases; } Picture;

static void
start (Picture *p, int w, int h)
{
  *p = (Picture) { .w = w, .h = h, .bases = { .width = w, .height = h } };
  p->bases.east  = p->east;
  p->bases.south = p->south;
  for (int i = 0; i < w * h; i++)
    p->east[i] = p->south[i] = 1;
}

static CeldStatus
make (Picture *p, uint32_t n_sets, const size_t *point, size_t n_points)
{
  CeldSolve  solve = { 0 };
  CeldStatus status = celd_bases_make (&p->bases, p->node, n_sets, point, n_points, 1e-6, NULL, &solve);

  CHECK (status != CELD_OK || solve.converged);
  return status;
}

/* h_k of pixel i. */
static double
basis (const CeldHarmonicBases *b, uint32_t k, size_t i)
{
  double rest = 1;

  if (k > 1)
    return (double) b->group[(k - 2) / CELD_LANES][i * CELD_LANES + (k - 2) % CELD_LANES];
  for (k = 2; k <= b->n; k++)
    rest -= basis (b, k, i);
  return rest;
}

/* ------------------------------------------------------------------ the oracle: dense elimination */

/* The Laplacian, dense. */
static void
laplacian (const Picture *p, double *a)
{
  int n = p->w * p->h;

  memset (a, 0, (size_t) (n * n) * sizeof *a);
  for (int i = 0; i < n; i++)
    for (int south = 0; south < 2; south++)
      {
        int    j = south ? i + p->w : i + 1;
        double w = (double) (south ? p->south[i] : p->east[i]);

        if (south ? j >= n : j % p->w == 0)
          continue;
        a[i * n + i] += w;
        a[j * n + j] += w;
        a[i * n + j] -= w;
        a[j * n + i] -= w;
      }
}

/* Bases of all nodes of p->bases.node, n x pixels, by elimination without pivots (the matrix is definite). */
static void
oracle_bases (const Picture *p, double *h)
{
  const CeldHarmonicBases *b = &p->bases;
  int                      n = p->w * p->h;
  double                  *a = malloc ((size_t) (n * n) * sizeof *a);

  laplacian (p, a);
  for (int i = 0; i < n; i++)
    {
      for (uint32_t k = 0; k < b->n; k++)
        h[(int) k * n + i] = b->node[i] == k + 1;
      if (b->node[i])
        for (int j = 0; j < n; j++)
          a[i * n + j] = i == j;
    }
  for (int i = 0; i < n; i++)
    for (int r = i + 1; r < n; r++)
      if (a[r * n + i] != 0)
        {
          double f = a[r * n + i] / a[i * n + i];

          for (int c = i; c < n; c++)
            a[r * n + c] -= f * a[i * n + c];
          for (uint32_t k = 0; k < b->n; k++)
            h[(int) k * n + r] -= f * h[(int) k * n + i];
        }
  for (int i = n; i-- > 0;)
    for (uint32_t k = 0; k < b->n; k++)
      {
        for (int c = i + 1; c < n; c++)
          h[(int) k * n + i] -= a[i * n + c] * h[(int) k * n + c];
        h[(int) k * n + i] /= a[i * n + i];
      }
  free (a);
}

/* Bases and stiffness agree with the oracle's; nodes are exact. */
static void
check_bases (const Picture *p, double error)
{
  const CeldHarmonicBases *b = &p->bases;
  int                      n = p->w * p->h;
  double                  *h = malloc ((size_t) n * b->n * sizeof *h), *a = malloc ((size_t) (n * n) * sizeof *a);

  oracle_bases (p, h);
  laplacian (p, a);
  for (uint32_t k = 1; k <= b->n; k++)
    for (int i = 0; i < n; i++)
      {
        double value = basis (b, k, (size_t) i);

        NEAR (value, h[(int) (k - 1) * n + i], error);
        if (b->node[i])
          CHECK (value == (b->node[i] == k));
      }
  for (uint32_t k = 0; k < b->n; k++)
    for (uint32_t l = 0; l < b->n; l++)
      {
        double sum = 0;

        for (int i = 0; i < n; i++)
          for (int j = 0; j < n; j++)
            sum += h[(int) k * n + i] * a[i * n + j] * h[(int) l * n + j];
        NEAR (b->stiffness[k * b->n + l], sum, error);
      }
  free (h);
  free (a);
}

/* ------------------------------------------------------------------ known answers */

static void
an_even_strip_is_a_straight_line (void)
{
  Picture p;

  start (&p, 9, 1);
  p.node[0] = 1;
  p.node[8] = 2;
  CHECK (make (&p, 2, NULL, 0) == CELD_OK);
  for (size_t x = 0; x < 9; x++)
    NEAR (basis (&p.bases, 2, x), (double) x / 8, 1e-6);
  NEAR (p.bases.stiffness[3], 1.0 / 8, 1e-7);
  NEAR (p.bases.stiffness[1], -1.0 / 8, 1e-7);
  celd_bases_clear (&p.bases);
}

/* Springs in a row: values divide as the inverses of the weights do. */
static void
an_uneven_strip_divides_by_resistance (void)
{
  Picture p;
  double  total = 0, sum = 0;

  start (&p, 1, 12);
  for (int y = 0; y < 12; y++)
    p.south[y] = 1 / (float) (1 + y * y);
  p.node[0]  = 2;
  p.node[11] = 1;
  for (int y = 0; y < 11; y++)
    total += 1 + y * y;
  CHECK (make (&p, 2, NULL, 0) == CELD_OK);
  for (int y = 0; y < 12; y++)
    {
      NEAR (basis (&p.bases, 2, (size_t) y), 1 - sum / total, 1e-5);
      sum += 1 + y * y;
    }
  NEAR (p.bases.stiffness[0], 1 / total, 1e-8);
  celd_bases_clear (&p.bases);
}

/* ------------------------------------------------------------------ random pictures */

/* Weights from a floor to 1, and some pixels of each of n nodes. */
static void
draw_random (Picture *p, uint32_t n, uint32_t *seed)
{
  start (p, 2 + (int) check_random (seed, 11), 2 + (int) check_random (seed, 11));
  for (int i = 0; i < p->w * p->h; i++)
    {
      p->east[i]  = check_random (seed, 3) ? 1 : powf (10, -(float) check_random (seed, 4));
      p->south[i] = check_random (seed, 3) ? 1 : powf (10, -(float) check_random (seed, 4));
    }
  for (uint32_t k = 0; k < 2 * n; k++)
    p->node[check_random (seed, (uint32_t) (p->w * p->h))] = k % n + 1;
}

static bool
has_all (const Picture *p, uint32_t n)
{
  uint32_t found = 0;

  for (uint32_t k = 1; k <= n; k++)
    for (int i = 0; i < p->w * p->h; i++)
      if (p->node[i] == k)
        {
          found++;
          break;
        }
  return found == n;
}

/* Pixels in no node, no two alike; how many. */
static size_t
pick_points (const Picture *p, size_t most, size_t *point, uint32_t *seed)
{
  size_t n = 0;

  for (size_t t = 0; t < most; t++)
    {
      size_t i = check_random (seed, (uint32_t) (p->w * p->h));
      bool   used = p->node[i] != 0;

      for (size_t k = 0; k < n; k++)
        used = used || point[k] == i;
      if (!used)
        point[n++] = i;
    }
  return n;
}

static void
bases_are_those_of_a_direct_solution (void)
{
  uint32_t seed = 5;

  for (int trial = 0; trial < 40; trial++)
    {
      uint32_t n = 1 + check_random (&seed, 12);
      size_t   point[6];
      Picture  p;

      draw_random (&p, n, &seed);
      if (!has_all (&p, n))
        continue;
      CHECK (make (&p, n, point, pick_points (&p, trial % 7, point, &seed)) == CELD_OK);
      check_bases (&p, 2e-5);
      celd_bases_clear (&p.bases);
    }
}

static void
points_are_added_and_dropped (void)
{
  uint32_t seed = 77;

  for (int trial = 0; trial < 40; trial++)
    {
      uint32_t  n = 1 + check_random (&seed, 9);
      size_t    point[10], n_points, first;
      Picture   p;
      CeldSolve solve = { 0 };

      draw_random (&p, n, &seed);
      if (!has_all (&p, n))
        continue;
      n_points = pick_points (&p, 10, point, &seed);
      first = n_points / 3;
      CHECK (make (&p, n, point, first) == CELD_OK);
      CHECK (celd_bases_add (&p.bases, point + first, n_points - first, 1e-6, NULL, &solve) == CELD_OK);
      CHECK (p.bases.n == n + n_points && solve.converged);
      for (size_t i = 0; i < n_points; i++)
        CHECK (p.bases.node[point[i]] > n && p.bases.pixel[p.bases.node[point[i]] - n - 1] == point[i]);
      check_bases (&p, 3e-5);
      for (size_t left = n_points; left > 0; left--)
        {
          size_t gone = check_random (&seed, (uint32_t) left);

          celd_bases_drop (&p.bases, n + 1 + (uint32_t) gone);
          CHECK (p.bases.n == n + left - 1);
          check_bases (&p, 4e-5);
        }
      for (int i = 0; i < p.w * p.h; i++)
        CHECK (p.bases.node[i] == p.node[i]);
      celd_bases_clear (&p.bases);
    }
}

/* Other nodes, some of them where others were, start from the bases that there are. */
static void
bases_can_be_made_from_earlier_ones (void)
{
  uint32_t seed = 3;

  for (int trial = 0; trial < 20; trial++)
    {
      Picture  p, q;
      uint32_t n = 1 + check_random (&seed, 14), m = 1 + check_random (&seed, 14);
      size_t   point[4];

      draw_random (&p, n, &seed);
      q = p;
      memset (q.node, 0, sizeof q.node);
      for (uint32_t k = 0; k < 3 * m; k++)
        q.node[check_random (&seed, (uint32_t) (p.w * p.h))] = k % m + 1;
      if (!has_all (&p, n) || !has_all (&q, m))
        continue;
      CHECK (make (&p, n, NULL, 0) == CELD_OK);
      memcpy (p.node, q.node, sizeof p.node);
      CHECK (make (&p, m, point, pick_points (&p, 4, point, &seed)) == CELD_OK);
      check_bases (&p, 2e-5);
      celd_bases_clear (&p.bases);
    }
}

static void
depth_is_the_sum_of_bases (void)
{
  uint32_t seed = 13;
  Picture  p;
  double   u[11];
  float    value[MOST];

  do
    draw_random (&p, 11, &seed);
  while (!has_all (&p, 11));
  CHECK (make (&p, 11, NULL, 0) == CELD_OK);
  for (int k = 0; k < 11; k++)
    u[k] = (double) check_random (&seed, 100) / 7 - 5;

  CeldPlane depth = { p.w, p.h, (size_t) p.w, value };

  CHECK (celd_bases_compose (&p.bases, u, NULL, &depth) == CELD_OK);
  for (int i = 0; i < p.w * p.h; i++)
    {
      double sum = 0;

      for (uint32_t k = 1; k <= 11; k++)
        sum += u[k - 1] * basis (&p.bases, k, (size_t) i);
      NEAR (value[i], p.node[i] ? u[p.node[i] - 1] : sum, 1e-5);
    }
  celd_bases_clear (&p.bases);
}

/* ------------------------------------------------------------------ hosts */

static void
threads_change_nothing (void)
{
  uint32_t seed = 21;
  Picture  p, q;
  CeldHost backwards = { NULL, check_backwards, NULL };
  size_t   point[2] = { 0 };

  do
    draw_random (&p, 10, &seed);
  while (!has_all (&p, 10) || pick_points (&p, 2, point, &seed) < 2);
  q = p;
  q.bases.east  = q.east;
  q.bases.south = q.south;

  CeldSolve solve;

  CHECK (make (&p, 10, point, 1) == CELD_OK);
  CHECK (celd_bases_add (&p.bases, point + 1, 1, 1e-6, NULL, &solve) == CELD_OK);
  CHECK (celd_bases_make (&q.bases, q.node, 10, point, 1, 1e-6, &backwards, &solve) == CELD_OK);
  CHECK (celd_bases_add (&q.bases, point + 1, 1, 1e-6, &backwards, &solve) == CELD_OK);
  CHECK (!memcmp (p.bases.stiffness, q.bases.stiffness, 144 * sizeof (double)));
  for (size_t g = 0; g < 2; g++)
    CHECK (!memcmp (p.bases.group[g], q.bases.group[g], (size_t) (p.w * p.h) * CELD_LANES * sizeof (float)));
  celd_bases_clear (&p.bases);
  celd_bases_clear (&q.bases);
}

static void
a_cancel_leaves_no_nodes (void)
{
  uint32_t  seed = 8;
  Picture   p;
  CeldSolve solve;
  int       left, reports = 0;

  do
    draw_random (&p, 10, &seed);
  while (!has_all (&p, 10));
  for (int answer = 0; answer < 100; answer++)
    {
      CeldHost   host = { check_count_down, NULL, &left };
      CeldStatus status;

      left   = answer;
      status = celd_bases_make (&p.bases, p.node, 10, NULL, 0, 1e-6, &host, &solve);
      if (status == CELD_OK)
        break;
      CHECK (status == CELD_CANCELLED && p.bases.n == 0 && !p.bases.node && !p.bases.n_groups);
      reports++;
    }
  CHECK (reports > 1 && p.bases.n == 10);
  check_bases (&p, 2e-5);
  celd_bases_clear (&p.bases);
}

int
main (void)
{
  RUN (an_even_strip_is_a_straight_line);
  RUN (an_uneven_strip_divides_by_resistance);
  RUN (bases_are_those_of_a_direct_solution);
  RUN (points_are_added_and_dropped);
  RUN (bases_can_be_made_from_earlier_ones);
  RUN (depth_is_the_sum_of_bases);
  RUN (threads_change_nothing);
  RUN (a_cancel_leaves_no_nodes);
  return DONE;
}
