/* Passes of the Laplacian solver over the pixels, a strip of rows at a time, on the host's threads.
 *
 * Black pixels touch red ones alone, so they are eliminated: the conjugate gradient runs over the red half, on the
 * Schur complement S, and a black value is made from its neighbours whenever it is needed.  The cycle relaxes red,
 * black, coarse correction, black, red.  What a pass sums up it sums row by row, so that the result does not depend on
 * threads.
 *
 * Vectors are float.  S z is summed over differences from a neighbour, so that flat parts give next to nothing; what
 * rounding leaves in r all the same goes when r is made anew from x in double.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "laplace-rows.h"

#include <math.h>

#define STRETCH 1.2f /* of the coarse correction, which is too short where it is constant on aggregates */
#define SUMS    4    /* kept of a row */

typedef double Eight __attribute__ ((vector_size (64)));
typedef double Loose __attribute__ ((vector_size (64), aligned (8), may_alias));

/* What the rows of a pass need. */
typedef struct
{
  CeldSolution    *s;
  const CeldLevel *level;
  float            alpha[CELD_LANES], beta[CELD_LANES];
  bool             step;        /* is there a step to take? */
  bool             deliver;
  int              phase;
} Pass;

/* ------------------------------------------------------------------ memory */

static int
strips (const CeldLaplace *l)
{
  return (l->height + CELD_STRIP - 1) / CELD_STRIP;
}

CeldStatus
celd_solution_new (const CeldLaplace *laplace, int lanes, const float *b, float *x, const CeldRun *run, CeldSolution *s)
{
  const CeldLevel *level = &laplace->levels.level[0];
  float          **vector[] = { &s->x, &s->r, &s->p, &s->q, &s->z, &s->t, &s->black };

  *s = (CeldSolution) { .laplace = laplace, .run = run, .lanes = lanes, .b = b, .user = x };
  for (size_t v = 0; v < sizeof vector / sizeof *vector; v++)
    if (!(*vector[v] = celd_alloc0 (level->plane, (size_t) lanes * sizeof (float))))
      return CELD_NO_MEMORY;
  s->row     = celd_alloc ((size_t) laplace->height, SUMS * CELD_LANES * sizeof *s->row);
  s->scratch = celd_alloc0 ((size_t) strips (laplace) * 3 * level->stride, (size_t) lanes * sizeof *s->scratch);
  return s->row && s->scratch ? celd_coarse_new (&laplace->levels, lanes, run, &s->cycle) : CELD_NO_MEMORY;
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
  celd_coarse_free (&s->cycle);
}

/* ------------------------------------------------------------------ residual and result, in double */

#define WIDE(v, i) __builtin_convertvector (EIGHT (v, i), Eight)
#define WIDE_WEIGHT(w, i) __builtin_convertvector (WEIGHT (w, i), Eight)

/* The numbers of the black pixels of row y, from `black`, their right-hand side; nothing outside the picture. */
CELD_INLINE void
solve_black_row (const Pass *pass, int y, double *out, int lanes)
{
  const CeldLevel *level = pass->level;
  const float     *x = pass->s->x, *b = pass->s->black, *sink = level->sink + level->plane;
  size_t           first = (size_t) (y + 1) * level->stride;

  if (y < 0 || y >= level->height)
    {
      memset (out, 0, level->stride * (size_t) lanes * sizeof *out);
      return;
    }
  for (EACH_PLACE (level, y, i))
    {
      size_t beside = i + (y & 1 ? -(size_t) 1 : 1), above = i - level->stride, below = i + level->stride;
      Eight  near = WIDE_WEIGHT (level->near, i), far = WIDE_WEIGHT (level->far, beside);
      Eight  south = WIDE_WEIGHT (level->south, above), north = WIDE_WEIGHT (level->north, below);
      Eight  whole = WIDE_WEIGHT (sink, i) + near + far + south + north;
      Eight  sum = WIDE (b, i) + near * WIDE (x, i) + far * WIDE (x, beside) + south * WIDE (x, above) +
                  north * WIDE (x, below);

      for (int k = 0; k < 8; k++)
        sum[k] = whole[k] > 0 ? sum[k] / whole[k] : 0;
      *(Loose *) (out + (i - first) * (size_t) lanes) = sum;
    }
}

/* r of row y, in which its right-hand side is, from the black rows round it. */
CELD_INLINE void
residual_row (const Pass *pass, int y, const double *above, const double *here, const double *below, int lanes)
{
  const CeldLevel *level = pass->level;
  const float     *x = pass->s->x;
  float           *r = pass->s->r;
  size_t           first = (size_t) (y + 1) * level->stride, many = (size_t) lanes;

  for (EACH_PLACE (level, y, i))
    {
      size_t at = i - first;
      Eight  red = WIDE (x, i);
      Eight  sum = WIDE (r, i) - WIDE_WEIGHT (level->sink, i) * red;

      sum += WIDE_WEIGHT (level->near, i) * (*(const Loose *) (here + at * many) - red);
      sum += WIDE_WEIGHT (level->far, i) * (*(const Loose *) (here + (at - (y & 1 ? -(size_t) 1 : 1)) * many) - red);
      sum += WIDE_WEIGHT (level->north, i) * (*(const Loose *) (above + at * many) - red);
      sum += WIDE_WEIGHT (level->south, i) * (*(const Loose *) (below + at * many) - red);
      PUT (r, i, __builtin_convertvector (sum, CeldEight));
    }
}

/* The caller's row y. */
CELD_INLINE void
deliver_row (const Pass *pass, int y, const double *black, int lanes)
{
  const CeldLevel *level = pass->level;
  size_t           first = (size_t) (y + 1) * level->stride, many = (size_t) lanes;
  float           *out = pass->s->user + (size_t) y * (size_t) level->width * many;

  for (int x = 0; x < level->width; x++)
    {
      size_t at = (size_t) x / 2 + 1;

      if ((x + y) & 1 ? level->inverse[level->plane + first + at] > 0 : level->inverse[first + at] > 0)
        for (size_t k = 0; k < many; k++)
          out[(size_t) x * many + k] =
            (x + y) & 1 ? (float) black[at * many + k] : pass->s->x[(first + at) * many + k];
    }
}

CELD_INLINE void
residual (void *data, int strip, int lanes)
{
  const Pass      *pass = data;
  const CeldLevel *level = pass->level;
  size_t           size = level->stride * (size_t) lanes;
  double          *ring = pass->s->scratch + (size_t) strip * 3 * size;
  int              from = strip * CELD_STRIP, end = from + CELD_STRIP, to = end < level->height ? end : level->height;

  for (int y = from - 1; y <= to; y++)
    {
      double *row[3];

      for (int k = 0; k < 3; k++) /* rows y-2, y-1, y */
        row[k] = ring + (size_t) ((y + 4 + k) % 3) * size;
      solve_black_row (pass, y, row[2], lanes);
      if (pass->deliver && y >= from && y < to)
        deliver_row (pass, y, row[2], lanes);
      if (!pass->deliver && y > from)
        residual_row (pass, y - 1, row[0], row[1], row[2], lanes);
    }
}

CELD_CLONES static void
residual_single (void *data, int strip)
{
  residual (data, strip, 1);
}

CELD_CLONES static void
residual_lanes (void *data, int strip)
{
  residual (data, strip, CELD_LANES);
}

/* ------------------------------------------------------------------ down: a step, and the first half of the cycle */

CELD_INLINE void
nothing (const Pass *pass, int y, int lanes)
{
  (void) pass;
  (void) y;
  (void) lanes;
}

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
step_row (const Pass *pass, int y, int lanes)
{
  const CeldSolution *s = pass->s;
  const CeldLevel    *level = pass->level;
  CeldEight           alpha = LANES (pass->alpha), beta = LANES (pass->beta);
  float               low[8], high[8];
  double             *row = s->row + (size_t) y * SUMS * CELD_LANES;

  if (!pass->step)
    return;
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

/* black = from red ones that are relaxed from 0 */
CELD_INLINE void
guess_row (const Pass *pass, int y, int lanes)
{
  const CeldLevel *level = pass->level;
  const float     *r = pass->s->r, *inverse = level->inverse;

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

/* After black pixels only red ones have a residual, and that is what their neighbours pull. */
CELD_INLINE void
restrict_row (const Pass *pass, int y, int lanes)
{
  const CeldLevel *level = pass->level;
  float           *coarse = pass->s->cycle.vectors[1].b;

  for (EACH_PLACE (level, y, i))
    {
      CeldEight pull = PULL_RED (level, y, i, pass->s->black);

      RESTRICT (level, i, pull, coarse);
    }
}

SWEEP (down, 3, step_row, guess_row, restrict_row, nothing)

/* ------------------------------------------------------------------ up: the second half, and S z */

/* z = red ones relaxed from 0, and the coarse correction */
CELD_INLINE void
correct_row (const Pass *pass, int y, int lanes)
{
  const CeldLevel        *level = pass->level;
  const CeldLevelVectors *next = &pass->s->cycle.vectors[1];
  const uint32_t         *coarser = level->coarser;
  const float            *r = pass->s->r;
  float                  *z = pass->s->z, a = STRETCH * next->a[0], c = STRETCH * next->c[0];
  CeldEight               many_a = STRETCH * LANES (next->a), many_c = STRETCH * LANES (next->c);

  for (size_t i = (size_t) (y + 1) * level->stride + 1, end = i + (size_t) level->half; i < end; i++)
    if (lanes == 1)
      z[i] = level->inverse[i] * r[i] + a * next->x[coarser[i]] + c * next->step[coarser[i]];
    else
      PUT (z, i, SPLAT (level->inverse[i]) * EIGHT (r, i) + many_a * EIGHT (next->x, coarser[i]) +
                   many_c * EIGHT (next->step, coarser[i]));
}

CELD_INLINE void
relax_black_row (const Pass *pass, int y, int lanes)
{
  const CeldLevel *level = pass->level;

  for (EACH_PLACE (level, y, i))
    PUT (pass->s->black, i, WEIGHT (level->inverse + level->plane, i) * PULL_BLACK (level, y, i, pass->s->z));
}

CELD_INLINE void
relax_red_row (const Pass *pass, int y, int lanes)
{
  const CeldLevel *level = pass->level;

  for (EACH_PLACE (level, y, i))
    PUT (pass->s->z, i,
         WEIGHT (level->inverse, i) * (EIGHT (pass->s->r, i) + PULL_RED (level, y, i, pass->s->black)));
}

/* black = what black pixels have more than the red one of the same place */
CELD_INLINE void
rise_row (const Pass *pass, int y, int lanes)
{
  const CeldLevel *level = pass->level;
  const float     *z = pass->s->z;

  for (EACH_PLACE (level, y, i))
    {
      size_t    beside = i + (y & 1 ? -(size_t) 1 : 1), above = i - level->stride, below = i + level->stride;
      CeldEight here = EIGHT (z, i);

      PUT (pass->s->black, i,
           WEIGHT (level->inverse + level->plane, i) *
             (WEIGHT (level->far, beside) * (EIGHT (z, beside) - here) +
              WEIGHT (level->south, above) * (EIGHT (z, above) - here) +
              WEIGHT (level->north, below) * (EIGHT (z, below) - here) -
              WEIGHT (level->sink + level->plane, i) * here));
    }
}

/* t = S z, and sums */
CELD_INLINE void
apply_row (const Pass *pass, int y, int lanes)
{
  const CeldLevel *level = pass->level;
  const float     *z = pass->s->z, *black = pass->s->black;
  CeldEight        zr = SPLAT (0), zq = SPLAT (0), zt = SPLAT (0);
  float            largest[8] = { 0 };
  double          *row = pass->s->row + (size_t) y * SUMS * CELD_LANES;

  for (EACH_PLACE (level, y, i))
    {
      size_t    beside = i - (y & 1 ? -(size_t) 1 : 1), above = i - level->stride, below = i + level->stride;
      CeldEight here = EIGHT (z, i);
      CeldEight t = WEIGHT (level->sink, i) * here - WEIGHT (level->near, i) * EIGHT (black, i) +
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

SWEEP (correct, 1, correct_row, nothing, nothing, nothing)
SWEEP (up, 4, relax_black_row, relax_red_row, rise_row, apply_row)

/* ------------------------------------------------------------------ the passes */

#define RUN_SWEEP(pass, stages, name) \
  celd_sweep ((pass)->s->run, (pass)->level->height, stages, \
              (pass)->s->lanes == 1 ? name##_single : name##_lanes, pass, &(pass)->phase)

static Pass
pass_of (CeldSolution *s)
{
  return (Pass) { .s = s, .level = &s->laplace->levels.level[0] };
}

/* Row y of the caller's right-hand side, of one colour. */
CELD_INLINE void
place_rhs_row (CeldSolution *s, int y, int colour, int lanes)
{
  const CeldLaplace *l = s->laplace;
  const CeldLevel   *level = &l->levels.level[0];
  size_t             many = (size_t) lanes, place = (size_t) (y + 1) * level->stride + 1;
  const float       *inverse = level->inverse + (colour ? level->plane : 0);
  float             *out = colour ? s->black : s->r;

  for (int x = (y + colour) & 1; x < l->width; x += 2, place++)
    {
      size_t pixel = (size_t) y * (size_t) l->width + (size_t) x;

      for (size_t k = 0; k < many && inverse[place] > 0; k++)
        out[place * many + k] = s->b_mean ? (float) ((double) s->b[pixel * many + k] -
                                                     s->b_mean[l->floating[pixel] * many + k])
                                          : s->b[pixel * many + k];
    }
}

/* Right-hand sides: those of red pixels to r, of black ones to `black`. */
static void
place_rhs (CeldSolution *s)
{
  const CeldLaplace *l = s->laplace;
  const CeldLevel   *level = &l->levels.level[0];
  size_t             many = (size_t) s->lanes;

  memset (s->r, 0, level->plane * many * sizeof *s->r);
  memset (s->black, 0, level->plane * many * sizeof *s->black);
  for (int y = 0; y < l->height && s->b; y++)
    for (int colour = 0; colour < 2; colour++)
      if (s->lanes == 1)
        place_rhs_row (s, y, colour, 1);
      else
        place_rhs_row (s, y, colour, CELD_LANES);
  for (size_t h = 0; h < l->n_held; h++)
    {
      uint32_t w = (uint32_t) l->width, pixel = l->held[h].free;
      uint32_t place = celd_level_place (level, (int) (pixel % w), (int) (pixel / w));
      float   *out = place < level->plane ? s->r + place * many : s->black + (place - level->plane) * many;

      for (size_t k = 0; k < many; k++)
        out[k] += l->held[h].weight * s->user[l->held[h].fixed * many + k];
    }
}

/* r = b - A x anew */
static void
refresh (CeldSolution *s)
{
  Pass pass = pass_of (s);

  place_rhs (s);
  RUN_SWEEP (&pass, 1, residual);
}

void
celd_pixels_begin (CeldSolution *s)
{
  const CeldLaplace *l = s->laplace;
  const CeldLevel   *level = &l->levels.level[0];
  size_t             many = (size_t) s->lanes;

  for (int y = 0; y < l->height; y++)
    for (int x = y & 1; x < l->width; x += 2)
      {
        size_t place = celd_level_place (level, x, y);

        for (size_t k = 0; k < many && level->inverse[place] > 0; k++)
          s->x[place * many + k] = s->user[((size_t) y * (size_t) l->width + (size_t) x) * many + k];
      }
  refresh (s);
  for (size_t i = 0; i < level->plane; i++) /* what has no edge is done */
    if (!level->coarser[i])
      for (size_t k = 0; k < many; k++)
        {
          s->x[i * many + k] += level->inverse[i] * s->r[i * many + k];
          s->r[i * many + k] = 0;
        }
}

void
celd_pixels_deliver (CeldSolution *s)
{
  Pass pass = pass_of (s);

  place_rhs (s);
  pass.deliver = true;
  RUN_SWEEP (&pass, 1, residual);
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
celd_pixels_round (CeldSolution *s, const double *alpha, const double *beta, bool fresh, CeldMeasure *m)
{
  Pass              pass = pass_of (s);
  CeldLevelVectors *coarse = &s->cycle.vectors[1];

  pass.step = alpha != NULL;
  for (int k = 0; k < s->lanes && alpha; k++)
    {
      pass.alpha[k] = (float) alpha[k];
      pass.beta[k]  = (float) beta[k];
    }
  memset (coarse->b, 0, (size_t) pass.level[1].n * (size_t) s->lanes * sizeof *coarse->b);
  RUN_SWEEP (&pass, 3, down);
  if (alpha)
    {
      gather (s, 0, true, m->low);
      gather (s, 1, true, m->high);
      for (int k = 0; k < s->lanes; k++)
        m->low[k] = -m->low[k];
    }
  if (fresh)
    {
      refresh (s);
      pass.step = false;
      memset (coarse->b, 0, (size_t) pass.level[1].n * (size_t) s->lanes * sizeof *coarse->b);
      RUN_SWEEP (&pass, 3, down);
    }
  celd_coarse_solve (&s->cycle);
  RUN_SWEEP (&pass, 1, correct);
  RUN_SWEEP (&pass, 4, up);
  gather (s, 0, false, m->zr);
  gather (s, 1, false, m->zq);
  gather (s, 2, false, m->zt);
  gather (s, 3, true, m->largest);
}
