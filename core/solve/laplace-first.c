/* Passes of the Laplacian solver over the first nodes of a coarse level's cells.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "solve/laplace-coarse.h"
#include "solve/laplace-private.h"
#include "solve/laplace-rows.h"
#include "solve/laplace.h"

#define SMALL 16384 /* numbers in a vector that is not worth other threads */

typedef CeldPass Pass;

/* Black numbers of a vector. */
#define BLACK(v) ((v) + p->level->plane * (size_t) lanes)

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

CELD_INLINE void
correct_row (const Pass *p, int y, int lanes)
{
  size_t first = (size_t) (y + 1) * p->level->stride + 1;

  celd_correct (p, first, first + (size_t) p->level->half, lanes);
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
  double          *sum = p->sum + (size_t) y * CELD_COARSE_SUMS * CELD_LANES;
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
  double          *sum = p->sum + (size_t) y * CELD_COARSE_SUMS * CELD_LANES;

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

ROW_PASS (first_guess, guess_row)
ROW_PASS (first_restrict, restrict_row)
ROW_PASS (first_correct, correct_row)
ROW_PASS (first_relax_black, relax_black_row)
ROW_PASS (first_relax_red, relax_red_row)
ROW_PASS (first_apply, apply_row)
ROW_PASS (first_reduce, reduce_row)

/* The threads that a pass is worth. */
static const CeldHost *
threads_of (const CeldCoarse *cycle, const Pass *p)
{
  return (size_t) p->level->n * (size_t) cycle->lanes < SMALL ? NULL : cycle->host;
}

#define RUN_PASS(cycle, p, host, name) \
  celd_row_pass (host, (p)->level->height, (cycle)->lanes == 1 ? name##_single : name##_lanes, p)

void
celd_first_down (const CeldCoarse *cycle, CeldPass *p)
{
  const CeldHost *host = threads_of (cycle, p);

  RUN_PASS (cycle, p, host, first_guess);
  RUN_PASS (cycle, p, celd_strips_share (p->level) ? NULL : host, first_restrict);
}

void
celd_first_correct (const CeldCoarse *cycle, CeldPass *p)
{
  RUN_PASS (cycle, p, threads_of (cycle, p), first_correct);
}

void
celd_first_up (const CeldCoarse *cycle, CeldPass *p)
{
  const CeldHost *host = threads_of (cycle, p);

  RUN_PASS (cycle, p, host, first_relax_black);
  RUN_PASS (cycle, p, host, first_relax_red);
  RUN_PASS (cycle, p, host, first_apply);
}

void
celd_first_reduce (const CeldCoarse *cycle, CeldPass *p)
{
  RUN_PASS (cycle, p, threads_of (cycle, p), first_reduce);
}
