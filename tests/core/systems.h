/* Systems for the tests of the Laplacian solver.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef SYSTEMS_H
#define SYSTEMS_H

#include "solve/laplace.h"
#include "check.h"

/* A system of the test, its start and its right-hand sides. */
typedef struct
{
  int    w, h, nrhs;
  float *east, *south, *diagonal, *b, *x;
} System;

static inline size_t
pixels (const System *s)
{
  return (size_t) s->w * (size_t) s->h;
}

static inline System
system_new (int w, int h, int nrhs, float weight)
{
  size_t n = (size_t) w * (size_t) h;
  System s = { w, h, nrhs, malloc (n * sizeof (float)), malloc (n * sizeof (float)), calloc (n, sizeof (float)),
               calloc (n * (size_t) nrhs, sizeof (float)), calloc (n * (size_t) nrhs, sizeof (float)) };

  for (size_t i = 0; i < n; i++)
    s.east[i] = s.south[i] = weight;
  return s;
}

static inline void
system_free (System *s)
{
  free (s->east);
  free (s->south);
  free (s->diagonal);
  free (s->b);
  free (s->x);
}

/* Cuts the edge of weight *w between pixels i and j if one is fixed: it holds the other at that one's value. */
static inline void
pin_edge (System *s, const uint8_t *fixed, const float *value, size_t i, size_t j, float *w)
{
  size_t held = fixed[i] ? i : j, other = fixed[i] ? j : i;

  if (!fixed[held])
    return;
  if (!fixed[other])
    {
      s->diagonal[other] += *w;
      s->b[other] += *w * value[held];
    }
  *w = 0;
}

/* Prescribes x = value where fixed, without the solver's help: folded into diagonal and b. */
static inline void
pin (System *s, const uint8_t *fixed, const float *value)
{
  size_t w = (size_t) s->w;

  for (size_t i = 0; i < pixels (s); i++)
    {
      if (i % w + 1 < w)
        pin_edge (s, fixed, value, i, i + 1, &s->east[i]);
      if (i + w < pixels (s))
        pin_edge (s, fixed, value, i, i + w, &s->south[i]);
    }
  for (size_t i = 0; i < pixels (s); i++)
    if (fixed[i])
      {
        s->diagonal[i] = 1;
        s->b[i] = value[i];
      }
}

static inline CeldSolve
solve (System *s, double tolerance)
{
  CeldLaplace *l = NULL;
  CeldSolve    how = { 0 };

  CHECK (celd_lap_setup (s->w, s->h, s->east, s->south, s->diagonal, NULL, NULL, &l) == CELD_OK);
  if (l)
    CHECK (celd_lap_solve (l, s->nrhs, s->b, s->x, tolerance, NULL, &how) == CELD_OK);
  celd_lap_free (l);
  return how;
}

/* Weights from nothing over 1e-6 to 1, walls of one pixel, and pins; every component is held by a small diagonal. */
static inline System
random_system (int w, int h, uint32_t *seed)
{
  static const float choice[] = { 0, 1e-6f, 1e-3f, 0.1f, 0.5f, 1, 1, 1 };
  System   s = system_new (w, h, 1, 1);
  uint8_t *fixed = calloc (pixels (&s), 1);
  float   *value = calloc (pixels (&s), sizeof *value);
  int      kind = (int) check_random (seed, 3);

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

#endif
