/* The cycle over the coarse levels of the Laplacian solver.
 *
 * Plain aggregation needs help: each level is solved by up to two steps of a flexible conjugate gradient round the next
 * cycle (K-cycle; Y. Notay and P. S. Vassilevski, "Recursive Krylov-based multigrid cycles", 2008).  Relaxation is
 * Gauss-Seidel, red, black and extra nodes before the correction and the other way round after it, so that the cycle is
 * symmetric.  Lanes have coefficients of their own.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "laplace-rows.h"

#define ENOUGH 0.25 /* of the residual left after one inner step: no second one */
#define STRIP  16   /* rows in one piece of work */
#define SMALL  8192 /* numbers in a vector that is not worth other threads */

/* What the strips of a pass need. */
typedef struct
{
  const CeldLevel *level;
  float           *b, *x, *y, *image;
  float           *coarse;      /* vector of the next level */
  float            a[CELD_LANES], c[CELD_LANES];
  double          *sum;
} Pass;

typedef void Body (void *pass, int strip);

/* ------------------------------------------------------------------ vectors */

CeldStatus
celd_coarse_new (const CeldLevels *levels, int lanes, const CeldRun *run, CeldCoarse *cycle)
{
  *cycle = (CeldCoarse) { .levels = levels, .run = run, .lanes = lanes };
  cycle->bottom = celd_alloc (levels->bottom.n, (size_t) lanes * sizeof *cycle->bottom);
  if (!cycle->bottom)
    return CELD_NO_MEMORY;
  for (int l = 1; l < levels->n; l++)
    {
      const CeldLevel  *level  = &levels->level[l];
      CeldLevelVectors *v      = &cycle->vectors[l];
      float           **part[] = { &v->b, &v->x, &v->step, &v->image, &v->image2 };

      for (size_t k = 0; k < sizeof part / sizeof *part; k++)
        if (!(*part[k] = celd_alloc0 ((size_t) level->n + 8, (size_t) lanes * sizeof (float))))
          return CELD_NO_MEMORY;
      if (!(v->sum = celd_alloc (2 * ((size_t) level->height + 1), CELD_LANES * sizeof *v->sum)))
        return CELD_NO_MEMORY;
    }
  return CELD_OK;
}

void
celd_coarse_free (CeldCoarse *cycle)
{
  for (int l = 1; l < CELD_MAX_LEVELS; l++)
    {
      CeldLevelVectors *v = &cycle->vectors[l];

      celd_free (v->b);
      celd_free (v->x);
      celd_free (v->step);
      celd_free (v->image);
      celd_free (v->image2);
      celd_free (v->sum);
    }
  celd_free (cycle->bottom);
}

/* ------------------------------------------------------------------ passes over the first nodes, and extra ones */

#define ROWS(pass, strip, y) \
  int y = (strip) * STRIP; y < (pass)->level->height && y < ((strip) + 1) * STRIP; y++

/* Red ones from x = 0. */
CELD_INLINE void
guess (void *data, int strip, int lanes)
{
  const Pass      *p = data;
  const CeldLevel *level = p->level;

  for (ROWS (p, strip, y))
    for (EACH_PLACE (level, y, i))
      PUT (p->x, i, WEIGHT (level->inverse, i) * EIGHT (p->b, i));
}

CELD_INLINE void
relax_black (void *data, int strip, int lanes)
{
  const Pass      *p = data;
  const CeldLevel *level = p->level;
  size_t           plane = level->plane, other = plane * (size_t) lanes;

  for (ROWS (p, strip, y))
    for (EACH_PLACE (level, y, i))
      PUT (p->x + other, i,
           WEIGHT (level->inverse + plane, i) * (EIGHT (p->b + other, i) + PULL_BLACK (level, y, i, p->x)));
}

CELD_INLINE void
relax_red (void *data, int strip, int lanes)
{
  const Pass      *p = data;
  const CeldLevel *level = p->level;
  size_t           other = level->plane * (size_t) lanes;

  for (ROWS (p, strip, y))
    for (EACH_PLACE (level, y, i))
      PUT (p->x, i, WEIGHT (level->inverse, i) * (EIGHT (p->b, i) + PULL_RED (level, y, i, p->x + other)));
}

/* What black nodes, relaxed after red ones, pull is the residual of these. */
CELD_INLINE void
restrict_red (void *data, int strip, int lanes)
{
  const Pass      *p = data;
  const CeldLevel *level = p->level;
  size_t           other = level->plane * (size_t) lanes;

  for (ROWS (p, strip, y))
    for (EACH_PLACE (level, y, i))
      {
        CeldEight pull = PULL_RED (level, y, i, p->x + other);

        RESTRICT (level, i, pull, p->coarse);
      }
}

CELD_INLINE void
correct (const Pass *p, size_t from, size_t to, int lanes)
{
  const uint32_t *coarser = p->level->coarser;

  for (size_t i = from; i < to; i++)
    ADD (p->x, i, 1.f, p->coarse, coarser[i]);
}

/* Both colours. */
CELD_INLINE void
correct_rows (void *data, int strip, int lanes)
{
  const Pass *p = data;

  for (ROWS (p, strip, y))
    {
      size_t first = (size_t) (y + 1) * p->level->stride + 1, end = first + (size_t) p->level->half;

      correct (p, first, end, lanes);
      correct (p, p->level->plane + first, p->level->plane + end, lanes);
    }
}

/* image = A x.  Red nodes are relaxed last, so that theirs is b; differences first, so that flat parts give exactly
 * nothing. */
CELD_INLINE void
apply (void *data, int strip, int lanes)
{
  const Pass      *p = data;
  const CeldLevel *level = p->level;
  size_t           plane = level->plane, other = plane * (size_t) lanes;

  for (ROWS (p, strip, y))
    for (EACH_PLACE (level, y, i))
      {
        size_t    beside = i + (y & 1 ? -(size_t) 1 : 1);
        CeldEight x = EIGHT (p->x + other, i);

        PUT (p->image, i, EIGHT (p->b, i));
        PUT (p->image + other, i,
             WEIGHT (level->sink + plane, i) * x + WEIGHT (level->near, i) * (x - EIGHT (p->x, i)) +
               WEIGHT (level->far, beside) * (x - EIGHT (p->x, beside)) +
               WEIGHT (level->south, i - level->stride) * (x - EIGHT (p->x, i - level->stride)) +
               WEIGHT (level->north, i + level->stride) * (x - EIGHT (p->x, i + level->stride)));
      }
}

/* Keeps the sums of a row. */
CELD_INLINE void
keep_sum (double *sum, CeldEight of, int lanes)
{
  if (lanes > 1)
    for (int k = 0; k < 8; k++)
      sum[k] = (double) of[k];
  else
    sum[0] = (((double) of[0] + (double) of[1]) + ((double) of[2] + (double) of[3])) +
             (((double) of[4] + (double) of[5]) + ((double) of[6] + (double) of[7]));
}

/* sum: of x y, and of x image. */
CELD_INLINE void
dot (void *data, int strip, int lanes)
{
  const Pass      *p = data;
  const CeldLevel *level = p->level;
  size_t           other = level->plane * (size_t) lanes;

  for (ROWS (p, strip, y))
    {
      CeldEight xy = SPLAT (0), xi = SPLAT (0);

      for (EACH_PLACE (level, y, i))
        {
          CeldEight red = EIGHT (p->x, i), black = EIGHT (p->x + other, i);

          xy += red * EIGHT (p->y, i) + black * EIGHT (p->y + other, i);
          xi += red * EIGHT (p->image, i) + black * EIGHT (p->image + other, i);
        }
      keep_sum (p->sum + (size_t) y * 2 * CELD_LANES, xy, lanes);
      keep_sum (p->sum + (size_t) y * 2 * CELD_LANES + CELD_LANES, xi, lanes);
    }
}

/* b -= a image; sum: of b b before and after. */
CELD_INLINE void
reduce (void *data, int strip, int lanes)
{
  const Pass      *p = data;
  const CeldLevel *level = p->level;
  CeldEight        a = lanes == 1 ? SPLAT (p->a[0]) : (CeldEight) *(const CeldLoose *) p->a;

  for (ROWS (p, strip, y))
    {
      CeldEight before = SPLAT (0), after = SPLAT (0);

      for (size_t colour = 0; colour < 2; colour++)
        {
          size_t other = colour * level->plane * (size_t) lanes;
          float *b = p->b + other, *image = p->image + other;

          for (EACH_PLACE (level, y, i))
            {
              CeldEight now = EIGHT (b, i), then = now - a * EIGHT (image, i);

              PUT (b, i, then);
              before += now * now;
              after += then * then;
            }
        }
      keep_sum (p->sum + (size_t) y * 2 * CELD_LANES, before, lanes);
      keep_sum (p->sum + (size_t) y * 2 * CELD_LANES + CELD_LANES, after, lanes);
    }
}

/* x = a x + c y */
CELD_INLINE void
combine (void *data, int strip, int lanes)
{
  const Pass      *p = data;
  const CeldLevel *level = p->level;
  CeldEight        a = lanes == 1 ? SPLAT (p->a[0]) : (CeldEight) *(const CeldLoose *) p->a;
  CeldEight        c = lanes == 1 ? SPLAT (p->c[0]) : (CeldEight) *(const CeldLoose *) p->c;

  for (ROWS (p, strip, y))
    for (size_t colour = 0; colour < 2; colour++)
      {
        float *x = p->x + colour * level->plane * (size_t) lanes;

        for (EACH_PLACE (level, y, i))
          PUT (x, i, p->y ? a * EIGHT (x, i) + c * EIGHT (p->y + colour * level->plane * (size_t) lanes, i)
                          : a * EIGHT (x, i));
      }
}

/* Each pass for both numbers of lanes. */
#define PASS(name) \
  CELD_CLONES static void name##_single (void *data, int strip) { name (data, strip, 1); } \
  CELD_CLONES static void name##_lanes (void *data, int strip) { name (data, strip, CELD_LANES); } \
  static void name##_pass (const CeldCoarse *cycle, Pass *p) \
  { \
    each_strip (cycle, p, cycle->lanes == 1 ? name##_single : name##_lanes); \
  }

static void
each_strip (const CeldCoarse *cycle, Pass *p, Body *body)
{
  int strips = (p->level->height + STRIP - 1) / STRIP;

  if ((size_t) p->level->n * (size_t) cycle->lanes < SMALL)
    for (int strip = 0; strip < strips; strip++)
      body (p, strip);
  else
    celd_each (cycle->run, strips, body, p);
}

PASS (guess)
PASS (relax_black)
PASS (relax_red)
PASS (restrict_red)
PASS (correct_rows)
PASS (apply)
PASS (dot)
PASS (reduce)
PASS (combine)

/* ------------------------------------------------------------------ extra nodes, one after the other */

/* x of extra node e from b and its edges from .. to-1. */
CELD_INLINE void
relax_extra (const Pass *p, size_t e, uint32_t from, uint32_t to, int lanes)
{
  const CeldLevel *level = p->level;
  size_t           at = 2 * level->plane + e;

  if (lanes == 1)
    {
      float sum = p->b[at];

      for (uint32_t n = from; n < to; n++)
        sum += level->weight[n] * p->x[level->neighbour[n]];
      p->x[at] = level->inverse[at] * sum;
    }
  else
    {
      CeldEight sum = EIGHT (p->b, at);

      for (uint32_t n = from; n < to; n++)
        sum += SPLAT (level->weight[n]) * EIGHT (p->x, level->neighbour[n]);
      PUT (p->x, at, SPLAT (level->inverse[at]) * sum);
    }
}

CELD_INLINE void
extra_down (const Pass *p, int lanes)
{
  const CeldLevel *level = p->level;
  const uint32_t  *extra = level->coarser + 2 * level->plane;

  for (size_t e = 0; e < level->n_extra; e++)
    relax_extra (p, e, level->start[e], level->middle[e], lanes);
  for (uint32_t n = 0; n < level->links; n++)
    ADD (p->coarse, level->coarser[level->link_first[n]], level->link_weight[n], p->x, level->link_extra[n]);
  for (size_t e = 0; e < level->n_extra; e++)
    for (uint32_t n = level->middle[e]; n < level->start[e + 1]; n++)
      ADD (p->coarse, extra[e], level->weight[n], p->x, level->neighbour[n]);
}

CELD_INLINE void
extra_up (const Pass *p, int lanes)
{
  const CeldLevel *level = p->level;

  correct (p, 2 * level->plane, level->n, lanes);
  for (size_t e = level->n_extra; e-- > 0;)
    relax_extra (p, e, level->start[e], level->start[e + 1], lanes);
}

/* What extra nodes add to relaxed first ones. */
CELD_INLINE void
add_links (const Pass *p, uint32_t from, uint32_t to, int lanes)
{
  const CeldLevel *level = p->level;

  for (uint32_t n = from; n < to; n++)
    ADD (p->x, level->link_first[n], level->inverse[level->link_first[n]] * level->link_weight[n], p->x,
         level->link_extra[n]);
}

/* image of extra nodes, and what they add to black ones. */
CELD_INLINE void
extra_apply (const Pass *p, int lanes)
{
  const CeldLevel *level = p->level;
  const float     *x = p->x;

  for (uint32_t n = level->red_links; n < level->links; n++)
    {
      uint32_t i = level->link_first[n], j = level->link_extra[n];

      if (lanes == 1)
        p->image[i] += level->link_weight[n] * (x[i] - x[j]);
      else
        PUT (p->image, i, EIGHT (p->image, i) + SPLAT (level->link_weight[n]) * (EIGHT (x, i) - EIGHT (x, j)));
    }
  for (size_t at = 2 * level->plane, e = 0; at < level->n; at++, e++)
    if (lanes == 1)
      {
        float sum = level->sink[at] * x[at];

        for (uint32_t n = level->start[e]; n < level->start[e + 1]; n++)
          sum += level->weight[n] * (x[at] - x[level->neighbour[n]]);
        p->image[at] = sum;
      }
    else
      {
        CeldEight here = EIGHT (x, at), sum = SPLAT (level->sink[at]) * here;

        for (uint32_t n = level->start[e]; n < level->start[e + 1]; n++)
          sum += SPLAT (level->weight[n]) * (here - EIGHT (x, level->neighbour[n]));
        PUT (p->image, at, sum);
      }
}

/* Adds products of the extra nodes to a sum. */
CELD_INLINE void
extra_dot (const CeldLevel *level, const float *a, const float *b, double *sum, int lanes)
{
  CeldEight all = SPLAT (0);
  float     one = 0;

  for (size_t i = 2 * level->plane; i < level->n; i++)
    if (lanes == 1)
      one += a[i] * b[i];
    else
      all += EIGHT (a, i) * EIGHT (b, i);
  for (int k = 0; k < lanes; k++)
    sum[k] += (double) (lanes == 1 ? one : all[k]);
}

/* b -= a image */
CELD_INLINE void
extra_reduce (const Pass *p, int lanes)
{
  CeldEight a = lanes == 1 ? SPLAT (p->a[0]) : (CeldEight) *(const CeldLoose *) p->a;

  for (size_t i = 2 * p->level->plane; i < p->level->n; i++)
    if (lanes == 1)
      p->b[i] -= p->a[0] * p->image[i];
    else
      PUT (p->b, i, EIGHT (p->b, i) - a * EIGHT (p->image, i));
}

/* x = a x + c y */
CELD_INLINE void
extra_combine (const Pass *p, int lanes)
{
  CeldEight a = lanes == 1 ? SPLAT (p->a[0]) : (CeldEight) *(const CeldLoose *) p->a;
  CeldEight c = lanes == 1 ? SPLAT (p->c[0]) : (CeldEight) *(const CeldLoose *) p->c;

  for (size_t i = 2 * p->level->plane; i < p->level->n; i++)
    if (lanes == 1)
      p->x[i] = p->a[0] * p->x[i] + (p->y ? p->c[0] * p->y[i] : 0);
    else
      PUT (p->x, i, p->y ? a * EIGHT (p->x, i) + c * EIGHT (p->y, i) : a * EIGHT (p->x, i));
}

#define BOTH(call) \
  do \
    if (lanes_ == 1) \
      { enum { lanes = 1 }; call; } \
    else \
      { enum { lanes = CELD_LANES }; call; } \
  while (0)

#define EXTRA(name, arguments, call) \
  CELD_CLONES static void name##_all arguments \
  { \
    BOTH (call); \
  }

EXTRA (extra_down, (const Pass *p, int lanes_), extra_down (p, lanes))
EXTRA (extra_up, (const Pass *p, int lanes_), extra_up (p, lanes))
EXTRA (add_links, (const Pass *p, uint32_t from, uint32_t to, int lanes_), add_links (p, from, to, lanes))
EXTRA (extra_apply, (const Pass *p, int lanes_), extra_apply (p, lanes))
EXTRA (extra_dot, (const CeldLevel *level, const float *a, const float *b, double *sum, int lanes_),
       extra_dot (level, a, b, sum, lanes))
EXTRA (extra_reduce, (const Pass *p, int lanes_), extra_reduce (p, lanes))
EXTRA (extra_combine, (const Pass *p, int lanes_), extra_combine (p, lanes))

/* ------------------------------------------------------------------ the cycle */

static void krylov (CeldCoarse *cycle, int l);

/* One cycle of level l, not the last: x becomes approximately the solution for b. */
static void
descend (CeldCoarse *cycle, int l, float *x)
{
  const CeldLevel        *level = &cycle->levels->level[l];
  const CeldLevelVectors *next = &cycle->vectors[l + 1];
  Pass                    p = { .level = level, .b = cycle->vectors[l].b, .x = x, .coarse = next->b };

  guess_pass (cycle, &p);
  relax_black_pass (cycle, &p);
  memset (next->b, 0, (size_t) level[1].n * (size_t) cycle->lanes * sizeof *next->b);
  restrict_red_pass (cycle, &p);
  extra_down_all (&p, cycle->lanes);
  krylov (cycle, l + 1);
  p.coarse = next->x;
  correct_rows_pass (cycle, &p);
  extra_up_all (&p, cycle->lanes);
  relax_black_pass (cycle, &p);
  add_links_all (&p, level->red_links, level->links, cycle->lanes);
  relax_red_pass (cycle, &p);
  add_links_all (&p, 0, level->red_links, cycle->lanes);
}

static void
solve_last (CeldCoarse *cycle)
{
  const CeldLevels       *levels = cycle->levels;
  const CeldLevelVectors *v = &cycle->vectors[levels->n - 1];
  size_t                  many = (size_t) cycle->lanes;

  for (uint32_t i = 0; i < levels->bottom.n; i++)
    for (size_t k = 0; k < many; k++)
      cycle->bottom[i * many + k] = (double) v->b[levels->bottom_node[i] * many + k];
  celd_band_solve (&levels->bottom, cycle->lanes, cycle->bottom);
  for (uint32_t i = 0; i < levels->bottom.n; i++)
    for (size_t k = 0; k < many; k++)
      v->x[levels->bottom_node[i] * many + k] = (float) cycle->bottom[i * many + k];
}

/* Adds up what a pass has summed row by row. */
static void
sum_rows (const Pass *p, int which, double *sum)
{
  for (int k = 0; k < CELD_LANES; k++)
    sum[k] = 0;
  for (int y = 0; y < p->level->height; y++)
    for (int k = 0; k < CELD_LANES; k++)
      sum[k] += p->sum[((size_t) y * 2 + (size_t) which) * CELD_LANES + (size_t) k];
}

/* image = A x, xy = x y, xi = x image */
static void
measure (const CeldCoarse *cycle, Pass *p, double *xy, double *xi)
{
  apply_pass (cycle, p);
  extra_apply_all (p, cycle->lanes);
  dot_pass (cycle, p);
  sum_rows (p, 0, xy);
  sum_rows (p, 1, xi);
  extra_dot_all (p->level, p->x, p->y, xy, cycle->lanes);
  extra_dot_all (p->level, p->x, p->image, xi, cycle->lanes);
}

/* Level l: x becomes approximately the solution for b, which is used up. */
static void
krylov (CeldCoarse *cycle, int l)
{
  CeldLevelVectors *v = &cycle->vectors[l];
  int               lanes = cycle->lanes;
  double            before[CELD_LANES], after[CELD_LANES], xb[CELD_LANES], rho[CELD_LANES], gamma[CELD_LANES],
                    yb[CELD_LANES], beta[CELD_LANES], first[CELD_LANES];
  bool              again = false;
  Pass              p = { .level = &cycle->levels->level[l], .b = v->b, .x = v->x, .image = v->image, .sum = v->sum };

  if (l == cycle->levels->n - 1)
    {
      solve_last (cycle);
      return;
    }
  descend (cycle, l, v->x);
  p.y = v->b;
  measure (cycle, &p, xb, rho);
  for (int k = 0; k < lanes; k++)
    {
      first[k] = rho[k] > 0 ? xb[k] / rho[k] : 0;
      p.a[k]   = (float) first[k];
    }
  reduce_pass (cycle, &p);
  sum_rows (&p, 0, before);
  sum_rows (&p, 1, after);
  extra_dot_all (p.level, v->b, v->b, before, lanes);
  extra_reduce_all (&p, lanes);
  extra_dot_all (p.level, v->b, v->b, after, lanes);
  for (int k = 0; k < lanes; k++)
    again = again || after[k] > ENOUGH * ENOUGH * before[k];

  if (again)
    {
      descend (cycle, l, v->step);
      p.x     = v->step;
      p.image = v->image2;
      measure (cycle, &p, yb, beta);
      p.image = v->image;
      dot_pass (cycle, &p);
      sum_rows (&p, 1, gamma);
      extra_dot_all (p.level, v->step, v->image, gamma, lanes);
      for (int k = 0; k < lanes; k++)
        {
          double left = rho[k] > 0 ? beta[k] - gamma[k] * gamma[k] / rho[k] : 0, second = left > 0 ? yb[k] / left : 0;

          p.a[k] = (float) (second != 0 ? first[k] - second * gamma[k] / rho[k] : first[k]);
          p.c[k] = (float) second;
        }
    }
  p.x = v->x;
  p.y = again ? v->step : NULL;
  combine_pass (cycle, &p);
  extra_combine_all (&p, lanes);
}

void
celd_coarse_solve (CeldCoarse *cycle)
{
  if (cycle->levels->n > 1)
    krylov (cycle, 1);
}
