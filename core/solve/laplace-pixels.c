/* The finest level of the Laplacian solver: passes over the pixels, by strips of rows on the host's threads.
 *
 * Red-black reduction: black pixels have edges to red ones alone, so they are eliminated.  The conjugate gradient runs
 * over the red pixels, on the Schur complement S of the black ones, and the value of a black pixel is computed from its
 * neighbours whenever it is needed.  The preconditioner relaxes red and black pixels, adds the coarse correction, and
 * relaxes black and red ones.  Sums are kept row by row, so that the result does not depend on threads.
 *
 * Vectors are float.  S z is summed over differences from a neighbour, so that constant parts give next to nothing;
 * rounding errors that gather in r go when r is computed anew from x in double (laplace-residual.c).
 *
 * Cost: nine passes a round, about 60 operations a pixel and lane, and the cycle (laplace-cycle.c).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "solve/laplace-rows.h"

#include <math.h>

#define STRETCH 1.2f /* factor of the coarse correction, too short as it is constant on aggregates; by the bench */
#define SUMS    4    /* kept of each row */

/* A pass under way. */
typedef struct
{
  CeldSolution        *s;
  const CeldGridLevel *level;
  float                alpha[CELD_LANES], beta[CELD_LANES];
} PixelPass;

/* ------------------------------------------------------------------ memory */

static int
strips (const CeldLaplace *l)
{
  return (l->height + CELD_STRIP - 1) / CELD_STRIP;
}

CeldStatus
celd_solution_new (const CeldLaplace *laplace, int lanes, const float *b, float *x, const CeldHost *host,
                   CeldSolution *s)
{
  const CeldGridLevel *level = &laplace->hierarchy.level[0];
  float              **vector[] = { &s->x, &s->r, &s->p, &s->q, &s->z, &s->t, &s->black };

  *s = (CeldSolution) { .laplace = laplace, .host = host, .lanes = lanes, .b = b, .user = x };
  for (size_t v = 0; v < sizeof vector / sizeof *vector; v++)
    if (!(*vector[v] = celd_alloc0 (level->plane, (size_t) lanes * sizeof (float))))
      return CELD_NO_MEMORY;
  s->row     = celd_alloc ((size_t) laplace->height, SUMS * CELD_LANES * sizeof *s->row);
  s->scratch = celd_alloc0 ((size_t) strips (laplace) * 3 * level->stride, (size_t) lanes * sizeof *s->scratch);
  s->side    = celd_alloc ((size_t) strips (laplace) * level->stride, (size_t) lanes * sizeof *s->side);
  return s->row && s->scratch && s->side ? celd_kcycle_new (&laplace->hierarchy, lanes, host, &s->cycle)
                                         : CELD_NO_MEMORY;
}

void
celd_solution_free (CeldSolution *s)
{
  celd_free (s->x);
  celd_free (s->r);
  celd_free (s->p);
  celd_free (s->q);
  celd_free (s->z);
  celd_free (s->t);
  celd_free (s->black);
  celd_free (s->row);
  celd_free (s->scratch);
  celd_free (s->side);
  celd_kcycle_free (&s->cycle);
}

/* ------------------------------------------------------------------ down: a step, and the first half of the cycle */

/* Keeps the largest of a row: of every lane, or of all eight. */
CELD_INLINE void
keep_largest (double *largest, const float *of, int lanes)
{
  for (int k = 0; k < 8; k++)
    if (lanes > 1 || k == 0)
      largest[k] = (double) of[k];
    else
      largest[0] = fmax (largest[0], (double) of[k]);
}

/* p = z + beta p, q = t + beta q, x += alpha p, r -= alpha q */
CELD_INLINE void
step_row (const PixelPass *pass, int y, int lanes)
{
  const CeldSolution  *s = pass->s;
  const CeldGridLevel *level = pass->level;
  CeldEight            alpha = LANES (pass->alpha), beta = LANES (pass->beta);
  float                low[8], high[8];
  double              *row = s->row + (size_t) y * SUMS * CELD_LANES;

  for (int k = 0; k < 8; k++)
    low[k] = high[k] = -INFINITY;
  for (EACH_PLACE (level, y, i))
    {
      CeldEight p = EIGHT (s->z, i) + beta * EIGHT (s->p, i), q = EIGHT (s->t, i) + beta * EIGHT (s->q, i);
      CeldEight x = EIGHT (s->x, i) + alpha * p, inverse = WEIGHT (level->inverse, i);

      PUT (s->p, i, p);
      PUT (s->q, i, q);
      PUT (s->x, i, x);
      PUT (s->r, i, EIGHT (s->r, i) - alpha * q);
      for (int k = 0; k < 8; k++)
        {
          float up = inverse[k] > 0 ? x[k] : -INFINITY, down = inverse[k] > 0 ? -x[k] : -INFINITY;

          high[k] = up > high[k] ? up : high[k];
          low[k]  = down > low[k] ? down : low[k];
        }
    }
  keep_largest (row, low, lanes);
  keep_largest (row + CELD_LANES, high, lanes);
}

/* black = relaxed from red pixels that are relaxed from 0 */
CELD_INLINE void
guess_row (const PixelPass *pass, int y, int lanes)
{
  const CeldGridLevel *level = pass->level;
  const float         *r = pass->s->r, *inverse = level->inverse;

  for (EACH_PLACE (level, y, i))
    {
      size_t beside = i + (y & 1 ? -(size_t) 1 : 1), above = i - level->stride, below = i + level->stride;

      PUT (pass->s->black, i,
           WEIGHT (inverse + level->plane, i) *
             (WEIGHT (level->near, i) * (WEIGHT (inverse, i) * EIGHT (r, i)) +
              WEIGHT (level->far, beside) * (WEIGHT (inverse, beside) * EIGHT (r, beside)) +
              WEIGHT (level->south, above) * (WEIGHT (inverse, above) * EIGHT (r, above)) +
              WEIGHT (level->north, below) * (WEIGHT (inverse, below) * EIGHT (r, below))));
    }
}

/* Black pixels were relaxed last, so only red ones have a residual: the sum of weight times value of their black
 * neighbours. */
CELD_INLINE void
restrict_row (const PixelPass *pass, int y, int lanes)
{
  const CeldGridLevel *level = pass->level;
  float               *coarse = pass->s->cycle.vectors[1].b;

  for (EACH_PLACE (level, y, i))
    {
      CeldEight pull = PULL_RED (level, y, i, pass->s->black);

      RESTRICT (level, i, pull, coarse);
    }
}

ROW_PASS (PixelPass, pixels_step, step_row)
ROW_PASS (PixelPass, pixels_guess, guess_row)
ROW_PASS (PixelPass, pixels_restrict, restrict_row)

/* ------------------------------------------------------------------ up: the second half, and S z */

/* z = red pixels relaxed from 0, plus the coarse correction */
CELD_INLINE void
correct_row (const PixelPass *pass, int y, int lanes)
{
  const CeldGridLevel    *level = pass->level;
  const CeldLevelVectors *next = &pass->s->cycle.vectors[1];
  const uint32_t         *coarser = level->coarser;
  const float            *r = pass->s->r;
  float                  *z = pass->s->z, a = STRETCH * next->a[0], c = STRETCH * next->c[0];
  CeldEight               many_a = STRETCH * LANES (next->a), many_c = STRETCH * LANES (next->c);

  for (size_t i = level->row[y].first; i < level->row[y].end; i++)
    if (lanes == 1)
      z[i] = level->inverse[i] * r[i] + a * next->x[coarser[i]] + c * next->step[coarser[i]];
    else
      PUT (z, i, SPLAT (level->inverse[i]) * EIGHT (r, i) + many_a * EIGHT (next->x, coarser[i]) +
                   many_c * EIGHT (next->step, coarser[i]));
}

CELD_INLINE void
relax_black_row (const PixelPass *pass, int y, int lanes)
{
  const CeldGridLevel *level = pass->level;

  for (EACH_PLACE (level, y, i))
    PUT (pass->s->black, i, WEIGHT (level->inverse + level->plane, i) * PULL_BLACK (level, y, i, pass->s->z));
}

CELD_INLINE void
relax_red_row (const PixelPass *pass, int y, int lanes)
{
  const CeldGridLevel *level = pass->level;

  for (EACH_PLACE (level, y, i))
    PUT (pass->s->z, i,
         WEIGHT (level->inverse, i) * (EIGHT (pass->s->r, i) + PULL_RED (level, y, i, pass->s->black)));
}

/* black = relaxed black pixels less the red one of the same place: differences, for S z */
CELD_INLINE void
rise_row (const PixelPass *pass, int y, int lanes)
{
  const CeldGridLevel *level = pass->level;
  const float         *z = pass->s->z;

  for (EACH_PLACE (level, y, i))
    {
      size_t    beside = i + (y & 1 ? -(size_t) 1 : 1), above = i - level->stride, below = i + level->stride;
      CeldEight here = EIGHT (z, i);

      PUT (pass->s->black, i,
           WEIGHT (level->inverse + level->plane, i) *
             (WEIGHT (level->far, beside) * (EIGHT (z, beside) - here) +
              WEIGHT (level->south, above) * (EIGHT (z, above) - here) +
              WEIGHT (level->north, below) * (EIGHT (z, below) - here) -
              WEIGHT (level->diagonal + level->plane, i) * here));
    }
}

/* t = S z, and sums */
CELD_INLINE void
apply_row (const PixelPass *pass, int y, int lanes)
{
  const CeldGridLevel *level = pass->level;
  const float         *z = pass->s->z, *black = pass->s->black;
  CeldEight            zr = SPLAT (0), zq = SPLAT (0), zt = SPLAT (0);
  float                largest[8] = { 0 };
  double              *row = pass->s->row + (size_t) y * SUMS * CELD_LANES;

  for (EACH_PLACE (level, y, i))
    {
      size_t    beside = i - (y & 1 ? -(size_t) 1 : 1), above = i - level->stride, below = i + level->stride;
      CeldEight here = EIGHT (z, i);
      CeldEight t = WEIGHT (level->diagonal, i) * here - WEIGHT (level->near, i) * EIGHT (black, i) +
                    WEIGHT (level->far, i) * ((here - EIGHT (z, beside)) - EIGHT (black, beside)) +
                    WEIGHT (level->north, i) * ((here - EIGHT (z, above)) - EIGHT (black, above)) +
                    WEIGHT (level->south, i) * ((here - EIGHT (z, below)) - EIGHT (black, below));

      PUT (pass->s->t, i, t);
      zr += here * EIGHT (pass->s->r, i);
      zq += here * EIGHT (pass->s->q, i);
      zt += here * t;
      for (int k = 0; k < 8; k++)
        {
          float size = here[k] < 0 ? -here[k] : here[k];

          largest[k] = size > largest[k] ? size : largest[k];
        }
    }
  celd_keep_sum (row, &zr, lanes);
  celd_keep_sum (row + CELD_LANES, &zq, lanes);
  celd_keep_sum (row + 2 * CELD_LANES, &zt, lanes);
  keep_largest (row + 3 * CELD_LANES, largest, lanes);
}

ROW_PASS (PixelPass, pixels_correct, correct_row)
ROW_PASS (PixelPass, pixels_relax_black, relax_black_row)
ROW_PASS (PixelPass, pixels_relax_red, relax_red_row)
ROW_PASS (PixelPass, pixels_rise, rise_row)
ROW_PASS (PixelPass, pixels_apply, apply_row)

/* ------------------------------------------------------------------ the passes */

/* A pass with these coefficients of a step, or without one. */
static PixelPass
pass_of (CeldSolution *s, const double *alpha, const double *beta)
{
  PixelPass pass = { .s = s, .level = &s->laplace->hierarchy.level[0] };

  for (int k = 0; k < s->lanes && alpha; k++)
    {
      pass.alpha[k] = (float) alpha[k];
      pass.beta[k]  = (float) beta[k];
    }
  return pass;
}

/* Sums, or the largest, of what rows have kept. */
static void
gather (const CeldSolution *s, int which, bool largest, double *result)
{
  for (int k = 0; k < s->lanes; k++)
    {
      result[k] = largest ? -INFINITY : 0;
      for (int y = 0; y < s->laplace->height; y++)
        {
          double row = s->row[((size_t) y * SUMS + (size_t) which) * CELD_LANES + (size_t) k];

          result[k] = largest ? fmax (result[k], row) : result[k] + row;
        }
    }
}

void
celd_pixels_round (CeldSolution *s, const double *alpha, const double *beta, bool fresh, CeldRoundMeasures *m)
{
  PixelPass         pass = pass_of (s, alpha, beta);
  CeldLevelVectors *coarse = &s->cycle.vectors[1];
  const CeldHost   *host = s->host;

  if (alpha)
    {
      RUN_PASS (&pass, host, s->lanes, pixels_step);
      gather (s, 0, true, m->low);
      gather (s, 1, true, m->high);
      for (int k = 0; k < s->lanes; k++)
        m->low[k] = -m->low[k];
    }
  if (fresh)
    celd_pixels_refresh (s);
  memset (coarse->b, 0, (size_t) pass.level[1].n * (size_t) s->lanes * sizeof *coarse->b);
  RUN_PASS (&pass, host, s->lanes, pixels_guess);
  RUN_PASS (&pass, celd_strips_share (pass.level) ? NULL : host, s->lanes, pixels_restrict);
  celd_kcycle_solve (&s->cycle);
  RUN_PASS (&pass, host, s->lanes, pixels_correct);
  RUN_PASS (&pass, host, s->lanes, pixels_relax_black);
  RUN_PASS (&pass, host, s->lanes, pixels_relax_red);
  RUN_PASS (&pass, host, s->lanes, pixels_rise);
  RUN_PASS (&pass, host, s->lanes, pixels_apply);
  gather (s, 0, false, m->zr);
  gather (s, 1, false, m->zq);
  gather (s, 2, false, m->zt);
  gather (s, 3, true, m->largest);
}
