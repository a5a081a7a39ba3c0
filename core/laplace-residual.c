/* The pixels of the Laplacian solver in double: the residual anew, and the result.
 *
 * Right-hand sides are the caller's, with what fixed pixels pull.  Each strip makes the black rows it needs itself.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "laplace-rows.h"

typedef double Eight __attribute__ ((vector_size (64)));
typedef double Loose __attribute__ ((vector_size (64), aligned (8), may_alias));

typedef struct
{
  CeldSolution    *s;
  const CeldLevel *level;
  bool             deliver;     /* the result, rather than the residual */
  int              phase;
} Pass;

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

/* ------------------------------------------------------------------ the passes */

static void
run (Pass *pass)
{
  celd_sweep (pass->s->run, pass->level->height, 1, pass->s->lanes == 1 ? residual_single : residual_lanes, pass,
              &pass->phase);
}

void
celd_pixels_refresh (CeldSolution *s)
{
  Pass pass = { .s = s, .level = &s->laplace->levels.level[0] };

  place_rhs (s);
  run (&pass);
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
  celd_pixels_refresh (s);
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
  Pass pass = { .s = s, .level = &s->laplace->levels.level[0] };

  place_rhs (s);
  pass.deliver = true;
  run (&pass);
}
