/* The solver on the host's threads, and under a host that cancels.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "systems.h"
#include "solve/laplace.h"

/* A host that cancels after so many steps. */
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
threads_change_nothing (void)
{
  uint32_t     seed = 23;
  System       s = random_system (150, 170, &seed);
  float       *x = calloc (pixels (&s), sizeof *x);
  Patience     patience = { 1000, 0, false };
  CeldHost     host = { impatient, check_backwards, &patience }, setting_up = { NULL, check_backwards, NULL };
  CeldLaplace *l = NULL;

  solve (&s, 1e-4);
  CHECK (celd_lap_setup (s.w, s.h, s.east, s.south, s.diagonal, NULL, &setting_up, &l) == CELD_OK);
  CHECK (celd_lap_solve (l, 1, s.b, x, 1e-4, &host, NULL) == CELD_OK);
  CHECK (memcmp (x, s.x, pixels (&s) * sizeof *x) == 0);
  CHECK (!patience.fell);
  celd_lap_free (l);
  free (x);
  system_free (&s);
}

/* Fixed pixels, walls, islands, and parts that nothing holds. */
static void
threads_change_nothing_round_fixed_pixels (void)
{
  uint32_t seed = 31;
  System   s = random_system (230, 270, &seed);
  size_t   n = pixels (&s);
  uint8_t *fixed = calloc (n, 1);
  float   *one = calloc (n, sizeof *one), *two = calloc (n, sizeof *two);
  CeldHost host = { NULL, check_backwards, NULL };

  for (size_t i = 0; i < n; i++)
    {
      fixed[i]   = check_random (&seed, 50) == 0;
      one[i]     = two[i] = fixed[i] ? (float) check_random (&seed, 9) : 0;
      s.east[i]  = i % 230 == 100 ? 0 : s.east[i];
      s.south[i] = i / 230 == 100 ? 0 : s.south[i];
      fixed[i]   = fixed[i] && (i % 230 < 101 || i / 230 < 101);
    }
  for (int k = 0; k < 2; k++)
    {
      CeldLaplace *l = NULL;

      CHECK (celd_lap_setup (s.w, s.h, s.east, s.south, NULL, fixed, k ? &host : NULL, &l) == CELD_OK);
      CHECK (celd_lap_solve (l, 1, NULL, k ? two : one, 1e-5, k ? &host : NULL, NULL) == CELD_OK);
      celd_lap_free (l);
    }
  CHECK (memcmp (one, two, n * sizeof *one) == 0);
  free (fixed);
  free (one);
  free (two);
  system_free (&s);
}

static void
threads_change_nothing_in_lanes (void)
{
  uint32_t     seed = 29;
  System       s = random_system (210, 190, &seed);
  size_t       n = pixels (&s) * CELD_LANES;
  float       *b = malloc (n * sizeof *b), *x = calloc (n, sizeof *x), *other = calloc (n, sizeof *other);
  CeldHost     host = { NULL, check_backwards, NULL };
  CeldLaplace *l = NULL;

  for (size_t i = 0; i < n; i++)
    b[i] = s.b[i / CELD_LANES] * (float) (i % CELD_LANES);
  CHECK (celd_lap_setup (s.w, s.h, s.east, s.south, s.diagonal, NULL, NULL, &l) == CELD_OK);
  CHECK (celd_lap_solve_lanes (l, b, x, 1e-4, NULL, NULL) == CELD_OK);
  CHECK (celd_lap_solve_lanes (l, b, other, 1e-4, &host, NULL) == CELD_OK);
  CHECK (memcmp (x, other, n * sizeof *x) == 0);
  celd_lap_free (l);
  free (b);
  free (x);
  free (other);
  system_free (&s);
}

static void
a_host_can_cancel (void)
{
  uint32_t     seed = 23;
  System       s = random_system (150, 170, &seed);
  Patience     patience = { 2, 0, false };
  CeldHost     host = { impatient, NULL, &patience };
  CeldLaplace *l = NULL;

  CHECK (celd_lap_setup (s.w, s.h, s.east, s.south, s.diagonal, NULL, NULL, &l) == CELD_OK);
  CHECK (celd_lap_solve (l, 1, s.b, s.x, 1e-9, &host, NULL) == CELD_CANCELLED);
  CHECK (isfinite (s.x[0]));
  celd_lap_free (l);
  patience = (Patience) { 1, 0, false };
  l = NULL;
  CHECK (celd_lap_setup (s.w, s.h, s.east, s.south, s.diagonal, NULL, &host, &l) == CELD_CANCELLED && !l);
  system_free (&s);
}

int
main (void)
{
  RUN (threads_change_nothing);
  RUN (threads_change_nothing_round_fixed_pixels);
  RUN (threads_change_nothing_in_lanes);
  RUN (a_host_can_cancel);
  return DONE;
}
