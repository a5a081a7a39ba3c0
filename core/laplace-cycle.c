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

#define ENOUGH 0.25  /* of the residual left after one inner step: no second one */
#define SMALL  16384 /* numbers in a vector that is not worth other threads */
#define SUMS   3     /* kept of a row */

/* What the rows of a pass need. */
typedef struct
{
  const CeldLevel        *level;
  float                  *b, *x, *image; /* image: NULL where it is not needed */
  const float            *other;         /* NULL, or the x of the first step */
  CeldLevelVectors       *next;
  float                   a[CELD_LANES];
  double                 *sum;
  int                     phase;
} Pass;

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
      float           **part[] = { &v->b, &v->x, &v->step, &v->image };

      for (size_t k = 0; k < sizeof part / sizeof *part; k++)
        if (!(*part[k] = celd_alloc0 ((size_t) level->n + 8, (size_t) lanes * sizeof (float))))
          return CELD_NO_MEMORY;
      if (!(v->sum = celd_alloc ((size_t) level->height, SUMS * CELD_LANES * sizeof *v->sum)))
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
      celd_free (v->sum);
    }
  celd_free (cycle->bottom);
}

/* ------------------------------------------------------------------ rows of first nodes */

/* Black numbers of a vector. */
#define BLACK(v) ((v) + p->level->plane * (size_t) lanes)

CELD_INLINE void
nothing (const Pass *p, int y, int lanes)
{
  (void) p;
  (void) y;
  (void) lanes;
}

/* Red ones from x = 0, and black ones from these. */
CELD_INLINE void
guess_row (const Pass *p, int y, int lanes)
{
  const CeldLevel *level = p->level;

  for (EACH_PLACE (level, y, i))
    {
      size_t beside = i + (y & 1 ? -(size_t) 1 : 1);

      PUT (p->x, i, WEIGHT (level->inverse, i) * EIGHT (p->b, i));
      PUT (BLACK (p->x), i, WEIGHT (level->inverse + level->plane, i) *
                              (EIGHT (BLACK (p->b), i) + WEIGHT (level->near, i) * EIGHT (p->x, i) +
                               WEIGHT (level->far, beside) * (WEIGHT (level->inverse, beside) * EIGHT (p->b, beside)) +
                               WEIGHT (level->south, i - level->stride) *
                                 (WEIGHT (level->inverse, i - level->stride) * EIGHT (p->b, i - level->stride)) +
                               WEIGHT (level->north, i + level->stride) *
                                 (WEIGHT (level->inverse, i + level->stride) * EIGHT (p->b, i + level->stride))));
    }
}

/* What black nodes, relaxed after red ones, pull is the residual of these. */
CELD_INLINE void
restrict_row (const Pass *p, int y, int lanes)
{
  const CeldLevel *level = p->level;

  for (EACH_PLACE (level, y, i))
    {
      CeldEight pull = PULL_RED (level, y, i, BLACK (p->x));

      RESTRICT (level, i, pull, p->next->b);
    }
}

/* x += the next level's solution, at the places from .. to-1 */
CELD_INLINE void
correct (const Pass *p, size_t from, size_t to, int lanes)
{
  const CeldLevelVectors *next = p->next;
  const uint32_t         *coarser = p->level->coarser;
  CeldEight               a = LANES (next->a), c = LANES (next->c);

  for (size_t i = from; i < to; i++)
    if (lanes == 1)
      p->x[i] += next->a[0] * next->x[coarser[i]] + next->c[0] * next->step[coarser[i]];
    else
      PUT (p->x, i, EIGHT (p->x, i) + a * EIGHT (next->x, coarser[i]) + c * EIGHT (next->step, coarser[i]));
}

CELD_INLINE void
correct_row (const Pass *p, int y, int lanes)
{
  size_t first = (size_t) (y + 1) * p->level->stride + 1;

  correct (p, first, first + (size_t) p->level->half, lanes);
}

/* What extra nodes add to the relaxed first ones of a row; from, to: links. */
CELD_INLINE void
add_links (const Pass *p, uint32_t from, uint32_t to, int lanes)
{
  const CeldLevel *level = p->level;

  for (uint32_t n = from; n < to; n++)
    ADD (p->x, level->link_first[n], level->inverse[level->link_first[n]] * level->link_weight[n], p->x,
         level->link_extra[n]);
}

CELD_INLINE void
relax_black_row (const Pass *p, int y, int lanes)
{
  const CeldLevel *level = p->level;
  size_t           row = (size_t) (level->height + y);

  for (EACH_PLACE (level, y, i))
    PUT (BLACK (p->x), i,
         WEIGHT (level->inverse + level->plane, i) * (EIGHT (BLACK (p->b), i) + PULL_BLACK (level, y, i, p->x)));
  if (level->links)
    add_links (p, level->link_row[row], level->link_row[row + 1], lanes);
}

CELD_INLINE void
relax_red_row (const Pass *p, int y, int lanes)
{
  const CeldLevel *level = p->level;

  for (EACH_PLACE (level, y, i))
    PUT (p->x, i, WEIGHT (level->inverse, i) * (EIGHT (p->b, i) + PULL_RED (level, y, i, BLACK (p->x))));
  if (level->links)
    add_links (p, level->link_row[y], level->link_row[y + 1], lanes);
}

/* image = A x of the black nodes, red ones being relaxed last, so that theirs is b; differences first, so that flat
 * parts give exactly nothing.  Sums: of x b, of x A x, and of other A x. */
CELD_INLINE void
apply_row (const Pass *p, int y, int lanes)
{
  const CeldLevel *level = p->level;
  CeldEight        xb = SPLAT (0), xi = SPLAT (0), oi = SPLAT (0);
  double          *sum = p->sum + (size_t) y * SUMS * CELD_LANES;
  size_t           row = (size_t) (level->height + y);

  for (EACH_PLACE (level, y, i))
    {
      size_t    beside = i + (y & 1 ? -(size_t) 1 : 1);
      CeldEight x = EIGHT (BLACK (p->x), i), red = EIGHT (p->x, i) * EIGHT (p->b, i);
      CeldEight image = WEIGHT (level->sink + level->plane, i) * x + WEIGHT (level->near, i) * (x - EIGHT (p->x, i)) +
                        WEIGHT (level->far, beside) * (x - EIGHT (p->x, beside)) +
                        WEIGHT (level->south, i - level->stride) * (x - EIGHT (p->x, i - level->stride)) +
                        WEIGHT (level->north, i + level->stride) * (x - EIGHT (p->x, i + level->stride));

      if (p->image)
        PUT (BLACK (p->image), i, image);
      xb += red + x * EIGHT (BLACK (p->b), i);
      xi += red + x * image;
      if (p->other)
        oi += EIGHT (p->other, i) * EIGHT (p->b, i) + EIGHT (BLACK (p->other), i) * image;
    }
  celd_keep_sum (sum, &xb, lanes);
  celd_keep_sum (sum + CELD_LANES, &xi, lanes);
  celd_keep_sum (sum + 2 * CELD_LANES, &oi, lanes);
  for (uint32_t n = level->links ? level->link_row[row] : 0; level->links && n < level->link_row[row + 1]; n++)
    for (size_t k = 0; k < (size_t) lanes; k++)
      {
        size_t i = level->link_first[n] * (size_t) lanes + k, j = level->link_extra[n] * (size_t) lanes + k;
        float  more = level->link_weight[n] * (p->x[i] - p->x[j]);

        if (p->image)
          p->image[i] += more;
        sum[CELD_LANES + k] += (double) (p->x[i] * more);
        if (p->other)
          sum[2 * CELD_LANES + k] += (double) (p->other[i] * more);
      }
}

/* b -= a A x; sums: of b b before and after. */
CELD_INLINE void
reduce_row (const Pass *p, int y, int lanes)
{
  const CeldLevel *level = p->level;
  CeldEight        a = LANES (p->a), rest = SPLAT (1) - a, before = SPLAT (0), after = SPLAT (0);
  double          *sum = p->sum + (size_t) y * SUMS * CELD_LANES;

  for (EACH_PLACE (level, y, i))
    {
      CeldEight red = EIGHT (p->b, i), black = EIGHT (BLACK (p->b), i);
      CeldEight new_red = rest * red, new_black = black - a * EIGHT (BLACK (p->image), i);

      PUT (p->b, i, new_red);
      PUT (BLACK (p->b), i, new_black);
      before += red * red + black * black;
      after += new_red * new_red + new_black * new_black;
    }
  celd_keep_sum (sum, &before, lanes);
  celd_keep_sum (sum + CELD_LANES, &after, lanes);
}

SWEEP (down, 2, guess_row, restrict_row, nothing, nothing)
SWEEP (add, 1, correct_row, nothing, nothing, nothing)
SWEEP (up, 3, relax_black_row, relax_red_row, apply_row, nothing)
SWEEP (reduce, 1, reduce_row, nothing, nothing, nothing)

static void
sweep (const CeldCoarse *cycle, Pass *p, int stages, void (*body) (void *pass, int i))
{
  const CeldLevel *level = p->level;
  bool             small = (size_t) level->n * (size_t) cycle->lanes < SMALL;
  bool             shared = level[1].height * (CELD_STRIP / 2) < level->height; /* a cell may lie in several strips */

  celd_sweep (small || shared ? NULL : cycle->run, level->height, stages, body, p, &p->phase);
}

#define RUN_SWEEP(cycle, p, stages, name) \
  sweep (cycle, p, stages, (cycle)->lanes == 1 ? name##_single : name##_lanes)

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
  float           *coarse = p->next->b;

  for (size_t e = 0; e < level->n_extra; e++)
    relax_extra (p, e, level->start[e], level->middle[e], lanes);
  for (uint32_t n = 0; n < level->links; n++)
    ADD (coarse, level->coarser[level->link_first[n]], level->link_weight[n], p->x, level->link_extra[n]);
  for (size_t e = 0; e < level->n_extra; e++)
    for (uint32_t n = level->middle[e]; n < level->start[e + 1]; n++)
      ADD (coarse, extra[e], level->weight[n], p->x, level->neighbour[n]);
}

/* Corrects them, and the black nodes that they see. */
CELD_INLINE void
extra_up (const Pass *p, int lanes)
{
  const CeldLevel *level = p->level;

  for (uint32_t n = level->red_links; n < level->links; n++)
    if (n == level->red_links || level->link_first[n] != level->link_first[n - 1])
      correct (p, level->link_first[n], (size_t) level->link_first[n] + 1, lanes);
  correct (p, 2 * level->plane, level->n, lanes);
  for (size_t e = level->n_extra; e-- > 0;)
    relax_extra (p, e, level->start[e], level->start[e + 1], lanes);
}

/* image of extra nodes */
CELD_INLINE void
extra_apply (const Pass *p, float *image, int lanes)
{
  const CeldLevel *level = p->level;
  const float     *x = p->x;

  for (size_t at = 2 * level->plane, e = 0; at < level->n; at++, e++)
    if (lanes == 1)
      {
        float sum = level->sink[at] * x[at];

        for (uint32_t n = level->start[e]; n < level->start[e + 1]; n++)
          sum += level->weight[n] * (x[at] - x[level->neighbour[n]]);
        image[at] = sum;
      }
    else
      {
        CeldEight here = EIGHT (x, at), sum = SPLAT (level->sink[at]) * here;

        for (uint32_t n = level->start[e]; n < level->start[e + 1]; n++)
          sum += SPLAT (level->weight[n]) * (here - EIGHT (x, level->neighbour[n]));
        PUT (image, at, sum);
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
  CeldEight a = LANES (p->a);

  for (size_t i = 2 * p->level->plane; i < p->level->n; i++)
    if (lanes == 1)
      p->b[i] -= p->a[0] * p->image[i];
    else
      PUT (p->b, i, EIGHT (p->b, i) - a * EIGHT (p->image, i));
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
EXTRA (extra_apply, (const Pass *p, float *image, int lanes_), extra_apply (p, image, lanes))
EXTRA (extra_dot, (const CeldLevel *level, const float *a, const float *b, double *sum, int lanes_),
       extra_dot (level, a, b, sum, lanes))
EXTRA (extra_reduce, (const Pass *p, int lanes_), extra_reduce (p, lanes))

/* ------------------------------------------------------------------ the cycle */

static void krylov (CeldCoarse *cycle, int l);

/* Adds up what a pass has summed row by row. */
static void
sum_rows (const Pass *p, int which, double *sum)
{
  for (int k = 0; k < CELD_LANES; k++)
    sum[k] = 0;
  for (int y = 0; y < p->level->height; y++)
    for (int k = 0; k < CELD_LANES; k++)
      sum[k] += p->sum[((size_t) y * SUMS + (size_t) which) * CELD_LANES + (size_t) k];
}

/* One cycle of level l, not the last: x becomes approximately the solution for b; xb = x b, xi = x A x, oi = other A x.
 * image: for A x; of the extra nodes even if p->image is NULL. */
static void
descend (CeldCoarse *cycle, int l, Pass *p, float *image, double *xb, double *xi, double *oi)
{
  const CeldLevel *level = p->level;
  int              lanes = cycle->lanes;

  p->next = &cycle->vectors[l + 1];
  memset (p->next->b, 0, (size_t) level[1].n * (size_t) lanes * sizeof *p->next->b);
  RUN_SWEEP (cycle, p, 2, down);
  extra_down_all (p, lanes);
  krylov (cycle, l + 1);
  RUN_SWEEP (cycle, p, 1, add);
  extra_up_all (p, lanes);
  RUN_SWEEP (cycle, p, 3, up);
  sum_rows (p, 0, xb);
  sum_rows (p, 1, xi);
  sum_rows (p, 2, oi);
  if (!level->n_extra)
    return;
  extra_apply_all (p, image, lanes);
  extra_dot_all (level, p->x, p->b, xb, lanes);
  extra_dot_all (level, p->x, image, xi, lanes);
  if (p->other)
    extra_dot_all (level, p->other, image, oi, lanes);
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

/* b -= a A x; is so much of it left, in any lane, that a second step is worth while? */
static bool
reduce_all (CeldCoarse *cycle, Pass *p)
{
  double before[CELD_LANES], after[CELD_LANES];
  bool   again = false;

  RUN_SWEEP (cycle, p, 1, reduce);
  sum_rows (p, 0, before);
  sum_rows (p, 1, after);
  extra_dot_all (p->level, p->b, p->b, before, cycle->lanes);
  extra_reduce_all (p, cycle->lanes);
  extra_dot_all (p->level, p->b, p->b, after, cycle->lanes);
  for (int k = 0; k < cycle->lanes; k++)
    again = again || after[k] > ENOUGH * ENOUGH * before[k];
  return again;
}

/* Level l: a x + c step becomes approximately the solution for b, which is used up. */
static void
krylov (CeldCoarse *cycle, int l)
{
  CeldLevelVectors *v = &cycle->vectors[l];
  double            xb[CELD_LANES], rho[CELD_LANES], yb[CELD_LANES], beta[CELD_LANES], gamma[CELD_LANES];
  Pass              p = { .level = &cycle->levels->level[l], .b = v->b, .x = v->x, .image = v->image, .sum = v->sum };

  for (int k = 0; k < CELD_LANES; k++)
    {
      v->a[k] = 1;
      v->c[k] = 0;
    }
  if (l == cycle->levels->n - 1)
    {
      solve_last (cycle);
      return;
    }
  descend (cycle, l, &p, v->image, xb, rho, gamma);
  for (int k = 0; k < cycle->lanes; k++)
    p.a[k] = v->a[k] = (float) (rho[k] > 0 ? xb[k] / rho[k] : 0);
  if (!reduce_all (cycle, &p))
    return;

  p.x     = v->step;
  p.other = v->x;
  p.image = NULL;
  descend (cycle, l, &p, v->image, yb, beta, gamma);
  for (int k = 0; k < cycle->lanes; k++)
    {
      double left = rho[k] > 0 ? beta[k] - gamma[k] * gamma[k] / rho[k] : 0, second = left > 0 ? yb[k] / left : 0;

      v->c[k] = (float) second;
      if (second > 0 || second < 0)
        v->a[k] -= (float) (second * gamma[k] / rho[k]);
    }
}

void
celd_coarse_solve (CeldCoarse *cycle)
{
  if (cycle->levels->n > 1)
    krylov (cycle, 1);
}
