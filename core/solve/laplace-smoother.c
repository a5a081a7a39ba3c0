/* The smoother on a coarse level of the Laplacian solver, and the ways to and from the next coarser level.
 *
 * Red-black Gauss-Seidel: red nodes, black nodes, extra nodes before the coarse correction, and in the opposite order
 * after it, so that the cycle is symmetric.  Aggregation makes restriction a plain sum over each aggregate and
 * prolongation constant on it.  After the first sweep black nodes have no residual but for what extra nodes changed, so
 * that restriction adds up only what the last relaxed nodes pull at the others.
 *
 * Grid nodes are taken row by row on the host's threads, extra nodes, which are few, one after the other.  Sums are
 * kept row by row, so that the result does not depend on threads.
 *
 * Cost: about a dozen operations a node and edge.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "solve/laplace-rows.h"

/* The numbers of the black nodes of a vector. */
#define BLACK(v) ((v) + p->level->plane * (size_t) lanes)

/* ------------------------------------------------------------------ rows of grid nodes */

/* Relaxes red nodes from x = 0, and black nodes from these. */
CELD_INLINE void
guess_row (const CeldSmootherPass *p, int y, int lanes)
{
  const CeldGridLevel *level = p->level;

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

/* Black nodes were relaxed last, so the residual of a red node is the sum of weight times x of its black neighbours. */
CELD_INLINE void
restrict_row (const CeldSmootherPass *p, int y, int lanes)
{
  const CeldGridLevel *level = p->level;

  for (EACH_PLACE (level, y, i))
    {
      CeldEight pull = PULL_RED (level, y, i, BLACK (p->x));

      RESTRICT (level, i, pull, p->next->b);
    }
}

/* x += prolongation of the next level's solution, at the places from .. to - 1 */
CELD_INLINE void
prolong (const CeldSmootherPass *p, size_t from, size_t to, int lanes)
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
prolong_row (const CeldSmootherPass *p, int y, int lanes)
{
  prolong (p, p->level->row[y].first, p->level->row[y].end, lanes);
}

/* What extra nodes add to the relaxed grid nodes of a row; from, to: links. */
CELD_INLINE void
add_links (const CeldSmootherPass *p, uint32_t from, uint32_t to, int lanes)
{
  const CeldGridLevel *level = p->level;

  for (uint32_t n = from; n < to; n++)
    ADD (p->x, level->link_first[n], level->inverse[level->link_first[n]] * level->link_weight[n], p->x,
         level->link_extra[n]);
}

CELD_INLINE void
relax_black_row (const CeldSmootherPass *p, int y, int lanes)
{
  const CeldGridLevel *level = p->level;
  size_t               row = (size_t) (level->height + y);

  for (EACH_PLACE (level, y, i))
    PUT (BLACK (p->x), i,
         WEIGHT (level->inverse + level->plane, i) * (EIGHT (BLACK (p->b), i) + PULL_BLACK (level, y, i, p->x)));
  if (level->links)
    add_links (p, level->link_row[row], level->link_row[row + 1], lanes);
}

CELD_INLINE void
relax_red_row (const CeldSmootherPass *p, int y, int lanes)
{
  const CeldGridLevel *level = p->level;

  for (EACH_PLACE (level, y, i))
    PUT (p->x, i, WEIGHT (level->inverse, i) * (EIGHT (p->b, i) + PULL_RED (level, y, i, BLACK (p->x))));
  if (level->links)
    add_links (p, level->link_row[y], level->link_row[y + 1], lanes);
}

/* image = A x of the black nodes; that of red nodes is b, since they were relaxed last.  Differences are taken first,
 * so that a constant x gives exactly 0.  Sums: x b, x A x, other A x. */
CELD_INLINE void
apply_row (const CeldSmootherPass *p, int y, int lanes)
{
  const CeldGridLevel *level = p->level;
  CeldEight            xb = SPLAT (0), xi = SPLAT (0), oi = SPLAT (0);
  double              *sum = p->sum + (size_t) y * CELD_SMOOTHER_SUMS * CELD_LANES;
  size_t               row = (size_t) (level->height + y);

  for (EACH_PLACE (level, y, i))
    {
      size_t    beside = i + (y & 1 ? -(size_t) 1 : 1);
      CeldEight x = EIGHT (BLACK (p->x), i), red = EIGHT (p->x, i) * EIGHT (p->b, i);
      CeldEight image = WEIGHT (level->diagonal + level->plane, i) * x +
                        WEIGHT (level->near, i) * (x - EIGHT (p->x, i)) +
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

/* b -= a A x; sums: b b before and after. */
CELD_INLINE void
reduce_row (const CeldSmootherPass *p, int y, int lanes)
{
  const CeldGridLevel *level = p->level;
  CeldEight            a = LANES (p->a), rest = SPLAT (1) - a, before = SPLAT (0), after = SPLAT (0);
  double              *sum = p->sum + (size_t) y * CELD_SMOOTHER_SUMS * CELD_LANES;

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

ROW_PASS (CeldSmootherPass, smooth_guess, guess_row)
ROW_PASS (CeldSmootherPass, smooth_restrict, restrict_row)
ROW_PASS (CeldSmootherPass, smooth_prolong, prolong_row)
ROW_PASS (CeldSmootherPass, smooth_relax_black, relax_black_row)
ROW_PASS (CeldSmootherPass, smooth_relax_red, relax_red_row)
ROW_PASS (CeldSmootherPass, smooth_apply, apply_row)
ROW_PASS (CeldSmootherPass, smooth_reduce, reduce_row)

/* ------------------------------------------------------------------ extra nodes */

/* Relaxes extra node e, of its edges from .. to - 1. */
CELD_INLINE void
relax_extra (const CeldSmootherPass *p, size_t e, uint32_t from, uint32_t to, int lanes)
{
  const CeldGridLevel *level = p->level;
  size_t               at = 2 * level->plane + e;

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

/* Relaxes extra nodes from 0, each after those before it, and restricts what they pull at nodes that were relaxed
 * before them. */
CELD_INLINE void
extra_down (const CeldSmootherPass *p, int lanes)
{
  const CeldGridLevel *level = p->level;
  const uint32_t      *extra = level->coarser + 2 * level->plane;
  float               *coarse = p->next->b;

  for (size_t e = 0; e < level->n_extra; e++)
    relax_extra (p, e, level->start[e], level->middle[e], lanes);
  for (uint32_t n = 0; n < level->links; n++)
    ADD (coarse, level->coarser[level->link_first[n]], level->link_weight[n], p->x, level->link_extra[n]);
  for (size_t e = 0; e < level->n_extra; e++)
    for (uint32_t n = level->middle[e]; n < level->start[e + 1]; n++)
      ADD (coarse, extra[e], level->weight[n], p->x, level->neighbour[n]);
}

/* Corrects extra nodes and the black nodes that they have edges to, and relaxes extra nodes. */
CELD_INLINE void
extra_up (const CeldSmootherPass *p, int lanes)
{
  const CeldGridLevel *level = p->level;

  for (uint32_t n = level->red_links; n < level->links; n++)
    if (n == level->red_links || level->link_first[n] != level->link_first[n - 1])
      prolong (p, level->link_first[n], (size_t) level->link_first[n] + 1, lanes);
  prolong (p, 2 * level->plane, level->n, lanes);
  for (size_t e = level->n_extra; e-- > 0;)
    relax_extra (p, e, level->start[e], level->start[e + 1], lanes);
}

/* image = A x of the extra nodes */
CELD_INLINE void
extra_apply (const CeldSmootherPass *p, float *image, int lanes)
{
  const CeldGridLevel *level = p->level;
  const float         *x = p->x;

  for (size_t at = 2 * level->plane, e = 0; at < level->n; at++, e++)
    if (lanes == 1)
      {
        float sum = level->diagonal[at] * x[at];

        for (uint32_t n = level->start[e]; n < level->start[e + 1]; n++)
          sum += level->weight[n] * (x[at] - x[level->neighbour[n]]);
        image[at] = sum;
      }
    else
      {
        CeldEight here = EIGHT (x, at), sum = SPLAT (level->diagonal[at]) * here;

        for (uint32_t n = level->start[e]; n < level->start[e + 1]; n++)
          sum += SPLAT (level->weight[n]) * (here - EIGHT (x, level->neighbour[n]));
        PUT (image, at, sum);
      }
}

/* sum += a b of the extra nodes, of every lane */
CELD_INLINE void
extra_dot (const CeldGridLevel *level, const float *a, const float *b, double *sum, int lanes)
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

/* b -= a image of the extra nodes */
CELD_INLINE void
extra_reduce (const CeldSmootherPass *p, int lanes)
{
  CeldEight a = LANES (p->a);

  for (size_t i = 2 * p->level->plane; i < p->level->n; i++)
    if (lanes == 1)
      p->b[i] -= p->a[0] * p->image[i];
    else
      PUT (p->b, i, EIGHT (p->b, i) - a * EIGHT (p->image, i));
}

/* Each for both numbers of lanes. */
#define BOTH_LANES(name, parameters, ...) \
  CELD_CLONES static void smooth_##name parameters \
  { \
    if (lanes == 1) \
      name (__VA_ARGS__, 1); \
    else \
      name (__VA_ARGS__, CELD_LANES); \
  }

BOTH_LANES (extra_down, (const CeldSmootherPass *p, int lanes), p)
BOTH_LANES (extra_up, (const CeldSmootherPass *p, int lanes), p)
BOTH_LANES (extra_apply, (const CeldSmootherPass *p, float *image, int lanes), p, image)
BOTH_LANES (extra_reduce, (const CeldSmootherPass *p, int lanes), p)
BOTH_LANES (extra_dot, (const CeldGridLevel *level, const float *a, const float *b, double *sum, int lanes),
            level, a, b, sum)

/* ------------------------------------------------------------------ the visit of a cycle */

/* Adds up what a pass has summed of each row. */
static void
sum_rows (const CeldSmootherPass *p, int which, double *sum)
{
  for (int k = 0; k < CELD_LANES; k++)
    sum[k] = 0;
  for (int y = 0; y < p->level->height; y++)
    for (int k = 0; k < CELD_LANES; k++)
      sum[k] += p->sum[((size_t) y * CELD_SMOOTHER_SUMS + (size_t) which) * CELD_LANES + (size_t) k];
}

void
celd_smooth_down (CeldSmootherPass *p)
{
  memset (p->next->b, 0, (size_t) p->level[1].n * (size_t) p->lanes * sizeof *p->next->b);
  RUN_PASS (p, p->host, p->lanes, smooth_guess);
  RUN_PASS (p, celd_strips_share (p->level) ? NULL : p->host, p->lanes, smooth_restrict);
  smooth_extra_down (p, p->lanes);
}

void
celd_smooth_up (CeldSmootherPass *p, float *image, double *xb, double *xi, double *oi)
{
  RUN_PASS (p, p->host, p->lanes, smooth_prolong);
  smooth_extra_up (p, p->lanes);
  RUN_PASS (p, p->host, p->lanes, smooth_relax_black);
  RUN_PASS (p, p->host, p->lanes, smooth_relax_red);
  RUN_PASS (p, p->host, p->lanes, smooth_apply);
  sum_rows (p, 0, xb);
  sum_rows (p, 1, xi);
  sum_rows (p, 2, oi);
  if (!p->level->n_extra)
    return;
  smooth_extra_apply (p, image, p->lanes);
  smooth_extra_dot (p->level, p->x, p->b, xb, p->lanes);
  smooth_extra_dot (p->level, p->x, image, xi, p->lanes);
  if (p->other)
    smooth_extra_dot (p->level, p->other, image, oi, p->lanes);
}

void
celd_smooth_reduce (CeldSmootherPass *p, double *before, double *after)
{
  RUN_PASS (p, p->host, p->lanes, smooth_reduce);
  sum_rows (p, 0, before);
  sum_rows (p, 1, after);
  smooth_extra_dot (p->level, p->b, p->b, before, p->lanes);
  smooth_extra_reduce (p, p->lanes);
  smooth_extra_dot (p->level, p->b, p->b, after, p->lanes);
}
