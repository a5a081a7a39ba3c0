/* The quadratic program against every active set of small ones, against its conditions of optimality on large ones, and
 * where the answer is plain.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "solve/quadratic.h"

enum { N = 60, M = 400 };

typedef struct { size_t n, m; double k[N * N]; CeldInequality one[M]; } Problem;
typedef struct { double u[N], y[M]; CeldCertificate c; } Answer;

static Problem p; /* of the test that runs */
static Answer  answer, other;

static void
start (size_t n)
{
  p.n = n;
  p.m = 0;
  memset (p.k, 0, sizeof p.k);
}

static void
spring (size_t i, size_t j, double w)
{
  p.k[i * p.n + j] -= w;
  p.k[j * p.n + i] -= w;
  p.k[i * p.n + i] += w;
  p.k[j * p.n + j] += w;
}

static void
ask (uint32_t a, uint32_t b, double gap)
{
  p.one[p.m++] = (CeldInequality) { a, b, gap };
}

static CeldStatus
solve (Answer *to)
{
  return celd_quadratic (p.n, p.k, p.m, p.one, to->u, to->y, &to->c);
}

/* A program without an answer leaves what was there. */
static void
is_refused (void)
{
  Answer before;

  memset (&answer, 7, sizeof answer);
  before = answer;
  CHECK (solve (&answer) == CELD_BAD_VALUE);
  CHECK (!memcmp (&before, &answer, sizeof answer));
}

static double
random_unit (uint32_t *state)
{
  return check_random (state, 1 << 24) / (double) (1 << 24);
}

/* Inequalities that a hidden order of the nodes obeys, some of them twice, chained or implied by others. */
static void
ask_at_random (uint32_t *state, size_t m, bool even)
{
  uint32_t rank[N];

  for (uint32_t i = 0; i < p.n; i++)
    {
      uint32_t j = check_random (state, i + 1);

      rank[i] = rank[j];
      rank[j] = i;
    }
  while (p.m < m)
    {
      uint32_t i = check_random (state, (uint32_t) p.n), j = check_random (state, (uint32_t) p.n);

      if (rank[i] > rank[j])
        ask (i, j, even ? 1 + check_random (state, 3) : 0.1 + random_unit (state));
    }
}

/* ------------------------------------------------------------------ plain answers */

static void
springs_in_a_row (void)
{
  start (3);
  spring (0, 1, 1);
  spring (1, 2, 2);
  ask (0, 2, 3); /* a force of 3 / (1/1 + 1/2) */
  CHECK (solve (&answer) == CELD_OK);
  NEAR (answer.u[0], 3, 1e-15);
  NEAR (answer.u[1], 1, 1e-15);
  NEAR (answer.u[2], 0, 0);
  NEAR (answer.y[0], 2, 1e-15);
  NEAR (answer.c.energy, 3, 1e-14);
  NEAR (answer.c.gap, 0, 1e-14);
  CHECK (answer.c.active == 1 && answer.c.violation <= 0);
}

/* A third sheet that must be in front of two others, which a strong spring holds together. */
static void
only_binding_inequalities_are_active (void)
{
  start (3);
  spring (0, 1, 100);
  spring (0, 2, 1);
  ask (2, 0, 1);
  ask (2, 1, 0.5);
  CHECK (solve (&answer) == CELD_OK);
  NEAR (answer.u[0], 0, 1e-15);
  NEAR (answer.u[1], 0, 1e-15);
  NEAR (answer.u[2], 1, 1e-15);
  NEAR (answer.y[0], 1, 1e-14);
  NEAR (answer.y[1], 0, 0);
  CHECK (answer.c.active == 1);
}

/* Where nothing pulls, things are at their longest-path levels. */
static void
without_springs_nodes_have_longest_path_levels (void)
{
  start (6);
  ask (0, 1, 1);
  ask (1, 2, 2);
  ask (0, 2, 1);
  ask (3, 2, 1);
  ask (0, 3, 4);
  ask (4, 5, 0.25);
  CHECK (solve (&answer) == CELD_OK);
  for (size_t i = 0; i < 6; i++)
    NEAR (answer.u[i], ((const double[]) { 5, 2, 0, 1, 0.25, 0 })[i], 0);
  CHECK (answer.c.energy <= 0 && answer.c.active == 0);
}

/* Two springs, the upper one's lower end in front of the lower one's upper end: it moves, and costs nothing. */
static void
components_move_freely (void)
{
  start (4);
  spring (0, 1, 5);
  spring (2, 3, 1e-6);
  ask (0, 1, 1);
  ask (2, 3, 2);
  ask (3, 0, 0.5);
  CHECK (solve (&answer) == CELD_OK);
  for (size_t i = 0; i < 4; i++)
    NEAR (answer.u[i], ((const double[]) { 1, 0, 3.5, 1.5 })[i], 1e-14);
  NEAR (answer.c.energy, 2.5 + 2e-6, 1e-14);
  p.one[2] = (CeldInequality) { 2, 1, 0.5 }; /* holds without anything moving */
  CHECK (solve (&answer) == CELD_OK);
  for (size_t i = 0; i < 4; i++)
    NEAR (answer.u[i], ((const double[]) { 1, 0, 2, 0 })[i], 1e-14);
}

/* Two components that hold each other: neither can move, and both bend. */
static void
components_hold_each_other (void)
{
  start (4);
  spring (0, 1, 1);
  spring (2, 3, 1);
  ask (0, 2, 1);
  ask (3, 1, 1); /* u0 - u1 + u3 - u2 >= 2 */
  CHECK (solve (&answer) == CELD_OK);
  NEAR (answer.c.energy, 1, 1e-14);
  NEAR (answer.u[0] - answer.u[1], 1, 1e-14);
  NEAR (answer.u[3] - answer.u[2], 1, 1e-14);
  CHECK (answer.c.active == 2);
}

static void
empty_and_tiny_programs_are_solved (void)
{
  start (0);
  CHECK (solve (&answer) == CELD_OK && answer.c.energy <= 0 && answer.c.active == 0);
  CHECK (celd_quadratic (0, NULL, 0, NULL, NULL, NULL, &answer.c) == CELD_OK);
  start (1);
  CHECK (solve (&answer) == CELD_OK);
  NEAR (answer.u[0], 0, 0);
  start (3);
  spring (0, 2, 4);
  answer.u[0] = answer.u[1] = answer.u[2] = 9;
  CHECK (celd_quadratic (p.n, p.k, 0, NULL, answer.u, NULL, &answer.c) == CELD_OK);
  for (size_t i = 0; i < 3; i++)
    NEAR (answer.u[i], 0, 0);
}

/* ------------------------------------------------------------------ what has no answer */

static void
loops_are_refused (void)
{
  start (5);
  spring (0, 1, 1);
  ask (1, 1, 1);
  is_refused ();
  p.m = 0;
  ask (0, 1, 1);
  ask (1, 0, 1);
  is_refused ();
  for (uint32_t length = 3; length <= 5; length++)
    {
      p.m = 0;
      for (uint32_t i = 0; i < length; i++)
        ask (i, (i + 1) % length, 0.5);
      is_refused ();
      p.m--;
      CHECK (solve (&answer) == CELD_OK);
    }
}

static void
bad_numbers_are_refused (void)
{
  const double bad[] = { NAN, INFINITY, -INFINITY, 0, -1 };

  start (2);
  spring (0, 1, 1);
  for (size_t i = 0; i < 5; i++)
    {
      p.m = 0;
      ask (0, 1, bad[i]);
      is_refused ();
    }
  p.m = 0;
  ask (0, 2, 1);
  is_refused ();
  p.m = 0;
  for (size_t i = 0; i < 3; i++)
    for (size_t at = 0; at < 4; at++)
      {
        start (2);
        ask (0, 1, 1);
        p.k[at] = bad[i];
        is_refused ();
      }
  start (3);
  spring (0, 1, -1); /* pushes: no least energy */
  spring (1, 2, 0.1);
  ask (0, 1, 1);
  is_refused ();
}

/* ------------------------------------------------------------------ all active sets */

/* Solves the t x t system whose rows have t + 1 entries; unknowns that it leaves open are 0.  False: no answer. */
static bool
eliminate (size_t t, double *row, double *x)
{
  size_t column[2 * N], rank = 0;

  for (size_t i = 0; i < t; i++)
    column[i] = i;
  for (; rank < t; rank++)
    {
      size_t r = rank, c = rank;

      for (size_t i = rank; i < t; i++)
        for (size_t j = rank; j < t; j++)
          if (fabs (row[i * (t + 1) + column[j]]) > fabs (row[r * (t + 1) + column[c]]))
            r = i, c = j;
      if (fabs (row[r * (t + 1) + column[c]]) < 1e-9)
        break;
      for (size_t j = 0; j <= t; j++)
        {
          double kept = row[r * (t + 1) + j];

          row[r * (t + 1) + j] = row[rank * (t + 1) + j];
          row[rank * (t + 1) + j] = kept;
        }
      r = column[c], column[c] = column[rank], column[rank] = r;
      for (size_t i = 0; i < t; i++)
        if (i != rank)
          {
            double part = row[i * (t + 1) + column[rank]] / row[rank * (t + 1) + column[rank]];

            for (size_t j = 0; j <= t; j++)
              row[i * (t + 1) + j] -= part * row[rank * (t + 1) + j];
          }
    }
  for (size_t i = 0; i < t; i++)
    {
      x[column[i]] = i < rank ? row[i * (t + 1) + t] / row[i * (t + 1) + column[i]] : 0;
      if (i >= rank && fabs (row[i * (t + 1) + t]) > 1e-7)
        return false;
    }
  return true;
}

/* The least energy with the inequalities of `set` as equations; infinite if the others then do not hold. */
static double
energy_of_set (uint32_t set)
{
  static double row[2 * N * (2 * N + 1)];
  double        x[2 * N], energy = 0;
  size_t        t = p.n, all = p.n;

  for (size_t i = 0; i < p.m; i++)
    all += set >> i & 1;
  memset (row, 0, all * (all + 1) * sizeof *row);
  for (size_t i = 0; i < p.n; i++)
    for (size_t j = 0; j < p.n; j++)
      row[i * (all + 1) + j] = p.k[i * p.n + j];
  for (size_t i = 0; i < p.m; i++)
    if (set >> i & 1)
      {
        row[t * (all + 1) + p.one[i].a] = row[p.one[i].a * (all + 1) + t] = 1;
        row[t * (all + 1) + p.one[i].b] = row[p.one[i].b * (all + 1) + t] = -1;
        row[t++ * (all + 1) + all] = p.one[i].gap;
      }
  if (!eliminate (all, row, x))
    return INFINITY;
  for (size_t i = 0; i < p.m; i++)
    if (x[p.one[i].a] - x[p.one[i].b] < p.one[i].gap - 1e-8)
      return INFINITY;
  for (size_t i = 0; i < p.n; i++)
    for (size_t j = 0; j < i; j++)
      energy -= p.k[i * p.n + j] * (x[i] - x[j]) * (x[i] - x[j]) / 2;
  return energy;
}

static void
as_good_as_the_best_active_set (void)
{
  uint32_t state = 5;

  for (int trial = 0; trial < 600; trial++)
    {
      double least = INFINITY;
      bool   even = trial % 2;

      start (2 + check_random (&state, 5));
      for (size_t i = 0; i < p.n; i++)
        for (size_t j = 0; j < i; j++)
          if (check_random (&state, 3) < (uint32_t) trial % 4)
            spring (i, j, even ? 1 + check_random (&state, 2) : 0.05 + random_unit (&state));
      ask_at_random (&state, 1 + check_random (&state, 7), even);
      for (uint32_t set = 0; set < UINT32_C (1) << p.m; set++)
        least = fmin (least, energy_of_set (set));
      CHECK (solve (&answer) == CELD_OK);
      NEAR (answer.c.energy, least, 1e-9 * (1 + least));
      CHECK (answer.c.violation <= 1e-14);
    }
}

/* ------------------------------------------------------------------ conditions of optimality */

/* Multipliers >= 0, 0 where an inequality is slack; forces balance; inequalities hold; the certificate is right. */
static void
is_optimal (const Answer *x)
{
  double force[N] = { 0 }, pull = 0, energy = 0, loose = 0, least = INFINITY;
  size_t active = 0;

  for (size_t i = 0; i < p.n; i++)
    {
      least = fmin (least, x->u[i]);
      for (size_t j = 0; j < p.n; j++)
        if (i != j)
          {
            double w = -(p.k[i * p.n + j] + p.k[j * p.n + i]) / 2;

            force[i] += w * (x->u[i] - x->u[j]);
            pull      = fmax (pull, fabs (w) * fmax (x->u[i], x->u[j])); /* u is rounded */
            energy   += w * (x->u[i] - x->u[j]) * (x->u[i] - x->u[j]) / 4;
          }
    }
  for (size_t i = 0; i < p.m; i++)
    {
      double slack = x->u[p.one[i].a] - x->u[p.one[i].b] - p.one[i].gap;

      CHECK (slack >= -1e-12 * p.one[i].gap);
      CHECK (x->y[i] >= 0);
      active += x->y[i] > 0;
      loose += x->y[i] * fabs (slack);
      force[p.one[i].a] -= x->y[i];
      force[p.one[i].b] += x->y[i];
    }
  for (size_t i = 0; i < p.n; i++)
    NEAR (force[i], 0, 1e-14 * pull);
  NEAR (loose, 0, 1e-11 * energy);
  NEAR (x->c.energy, energy, 1e-12 * energy);
  NEAR (x->c.gap, 0, 1e-11 * energy);
  CHECK (x->c.violation <= 1e-12 && x->c.active == active && least <= 0);
}

/* Dense, with a floor under few springs, or in pieces; weights that spread over nine powers of ten. */
static void
draw_springs (uint32_t *state, int kind)
{
  for (size_t i = 0; i < p.n; i++)
    for (size_t j = 0; j < i; j++)
      {
        double wide = pow (10, -6 + 9 * random_unit (state));
        bool   few = !check_random (state, (uint32_t) p.n / 4);

        if (kind == 0)
          spring (i, j, wide);
        else if (kind == 1)
          spring (i, j, few ? wide : 1e-6 * random_unit (state));
        else if (few && i / 9 == j / 9)
          spring (i, j, wide);
      }
}

static void
large_ones_are_optimal (void)
{
  uint32_t state = 11;

  for (int trial = 0; trial < 150; trial++)
    {
      start (4 + check_random (&state, N - 3));
      draw_springs (&state, trial % 3);
      ask_at_random (&state, 1 + check_random (&state, M - 1), trial % 2);
      CHECK (solve (&answer) == CELD_OK);
      is_optimal (&answer);
    }
}

/* ------------------------------------------------------------------ rounding of K */

static void
rounding_of_k_does_no_harm (void)
{
  uint32_t state = 29;

  for (int trial = 0; trial < 20; trial++)
    {
      start (25);
      draw_springs (&state, 0);
      ask_at_random (&state, 60, false);
      CHECK (solve (&answer) == CELD_OK);
      for (size_t i = 0; i < p.n; i++)
        for (size_t j = 0; j < p.n; j++)
          p.k[i * p.n + j] = i == j ? -7 : p.k[i * p.n + j] * (1 + 1e-9 * (random_unit (&state) - 0.5));
      CHECK (solve (&other) == CELD_OK);
      is_optimal (&other);
      NEAR (other.c.energy, answer.c.energy, 1e-8 * answer.c.energy);
    }
}

/* K may have entries > 0 beside its diagonal as long as it has no eigenvalue < 0: inexact bases make such. */
static void
negative_weights_are_allowed_without_negative_eigenvalues (void)
{
  uint32_t state = 31;

  for (int trial = 0; trial < 40; trial++)
    {
      double row[N];

      start (4 + check_random (&state, 30));
      for (size_t square = 0; square < 2 * p.n; square++)
        {
          row[p.n - 1] = 0;
          for (size_t i = 0; i + 1 < p.n; i++)
            {
              row[i] = random_unit (&state) - 0.5;
              row[p.n - 1] -= row[i];
            }
          for (size_t i = 0; i < p.n; i++)
            for (size_t j = 0; j < p.n; j++)
              p.k[i * p.n + j] += row[i] * row[j];
        }
      ask_at_random (&state, 1 + check_random (&state, 100), trial % 2);
      CHECK (solve (&answer) == CELD_OK);
      is_optimal (&answer);
    }
}

int
main (void)
{
  RUN (springs_in_a_row);
  RUN (only_binding_inequalities_are_active);
  RUN (without_springs_nodes_have_longest_path_levels);
  RUN (components_move_freely);
  RUN (components_hold_each_other);
  RUN (empty_and_tiny_programs_are_solved);
  RUN (loops_are_refused);
  RUN (bad_numbers_are_refused);
  RUN (as_good_as_the_best_active_set);
  RUN (large_ones_are_optimal);
  RUN (rounding_of_k_does_no_harm);
  RUN (negative_weights_are_allowed_without_negative_eigenvalues);
  return DONE;
}
