/* Passes of the Laplacian solver over the extra nodes of a coarse level, one after the other.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "solve/laplace-coarse.h"
#include "solve/laplace-private.h"
#include "solve/laplace-rows.h"
#include "solve/laplace.h"

/* x of extra node e from b and its edges from .. to-1. */
CELD_INLINE void
relax_extra (const CeldPass *p, size_t e, uint32_t from, uint32_t to, int lanes)
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
down (const CeldPass *p, int lanes)
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
up (const CeldPass *p, int lanes)
{
  const CeldLevel *level = p->level;

  for (uint32_t n = level->red_links; n < level->links; n++)
    if (n == level->red_links || level->link_first[n] != level->link_first[n - 1])
      celd_correct (p, level->link_first[n], (size_t) level->link_first[n] + 1, lanes);
  celd_correct (p, 2 * level->plane, level->n, lanes);
  for (size_t e = level->n_extra; e-- > 0;)
    relax_extra (p, e, level->start[e], level->start[e + 1], lanes);
}

/* image of extra nodes */
CELD_INLINE void
apply (const CeldPass *p, float *image, int lanes)
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
dot (const CeldLevel *level, const float *a, const float *b, double *sum, int lanes)
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
reduce (const CeldPass *p, int lanes)
{
  CeldEight a = LANES (p->a);

  for (size_t i = 2 * p->level->plane; i < p->level->n; i++)
    if (lanes == 1)
      p->b[i] -= p->a[0] * p->image[i];
    else
      PUT (p->b, i, EIGHT (p->b, i) - a * EIGHT (p->image, i));
}

/* Each for both numbers of lanes. */
#define BOTH(name, arguments, ...) \
  CELD_CLONES static void extra_##name arguments \
  { \
    if (lanes == 1) \
      name (__VA_ARGS__, 1); \
    else \
      name (__VA_ARGS__, CELD_LANES); \
  } \
\
  void celd_extra_##name arguments \
  { \
    extra_##name (__VA_ARGS__, lanes); \
  }

BOTH (down, (const CeldPass *p, int lanes), p)
BOTH (up, (const CeldPass *p, int lanes), p)
BOTH (apply, (const CeldPass *p, float *image, int lanes), p, image)
BOTH (reduce, (const CeldPass *p, int lanes), p)
BOTH (dot, (const CeldLevel *level, const float *a, const float *b, double *sum, int lanes), level, a, b, sum)
