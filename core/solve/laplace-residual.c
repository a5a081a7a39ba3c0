/* The finest level of the Laplacian solver in double: the residual r = b - A x, and the caller's solution.
 *
 * The right-hand side is the caller's plus weight times value of fixed neighbours, less its mean over floating
 * components. Black pixels are computed from red ones as they are needed; each strip computes the black rows beside it
 * itself.
 *
 * Cost: about 40 operations a pixel and lane.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "solve/laplace-rows.h"

typedef double Eight __attribute__ ((vector_size (64)));
typedef double Loose __attribute__ ((vector_size (64), aligned (8), may_alias));

typedef struct
{
  CeldSolution        *s;
  const CeldGridLevel *level;
  bool                 deliver; /* the result, rather than the residual */
} ResidualPass;

/* ------------------------------------------------------------------ right-hand sides */

/* The right-hand side of the pixels of one colour in row y. */
CELD_INLINE void
place_rhs_row (const CeldSolution *s, int y, int colour, float *out, int lanes)
{
  const CeldLaplace   *l = s->laplace;
  const CeldGridLevel *level = &l->hierarchy.level[0];
  size_t               many = (size_t) lanes, first = (size_t) y * (size_t) l->width;
  size_t               start = (size_t) (y + 1) * level->stride, odd = (size_t) (y + colour) & 1;
  const float         *inverse = level->inverse + (colour ? level->plane : 0) + start;

  memset (out, 0, level->stride * many * sizeof *out);
  for (size_t at = level->row[y].first - start; at < level->row[y].end - start && s->b; at++)
    for (size_t k = 0; k < many && inverse[at] > 0; k++)
      out[at * many + k] = s->b[(first + 2 * (at - 1) + odd) * many + k];
  for (size_t f = s->b_mean ? l->floating_row[y] : 0; s->b_mean && f < l->floating_row[y + 1]; f++)
    for (size_t x = l->floating[f].first - first; x < l->floating[f].end - first; x++)
      for (size_t k = 0; k < many && (int) ((x + (size_t) y) & 1) == colour; k++)
        out[(x / 2 + 1) * many + k] = (float) ((double) s->b[(first + x) * many + k] -
                                               s->b_mean[l->floating[f].component * many + k]);
  for (size_t h = l->held_row[y]; h < l->held_row[y + 1]; h++)
    {
      size_t x = l->held[h].free - first;

      for (size_t k = 0; k < many && (int) ((x + (size_t) y) & 1) == colour; k++)
        out[(x / 2 + 1) * many + k] += l->held[h].weight * s->user[l->held[h].fixed * many + k];
    }
}

/* ------------------------------------------------------------------ rows */

#define WIDE_EIGHT(v, i) __builtin_convertvector (EIGHT (v, i), Eight)
#define WIDE_WEIGHT(w, i) __builtin_convertvector (WEIGHT (w, i), Eight)

/* The numbers of the black pixels of row y; nothing outside the picture.  b: workspace for their right-hand side. */
CELD_INLINE void
solve_black_row (const ResidualPass *pass, int y, float *b, double *out, int lanes)
{
  const CeldGridLevel *level = pass->level;
  const float         *x = pass->s->x, *diagonal = level->diagonal + level->plane;
  size_t               first = (size_t) (y + 1) * level->stride;

  if (y < 0 || y >= level->height)
    {
      memset (out, 0, level->stride * (size_t) lanes * sizeof *out);
      return;
    }
  place_rhs_row (pass->s, y, 1, b, lanes);
  for (EACH_PLACE (level, y, i))
    {
      size_t beside = i + (y & 1 ? -(size_t) 1 : 1), above = i - level->stride, below = i + level->stride;
      Eight  near = WIDE_WEIGHT (level->near, i), far = WIDE_WEIGHT (level->far, beside);
      Eight  south = WIDE_WEIGHT (level->south, above), north = WIDE_WEIGHT (level->north, below);
      Eight  whole = WIDE_WEIGHT (diagonal, i) + near + far + south + north;
      Eight  sum = WIDE_EIGHT (b, i - first) + near * WIDE_EIGHT (x, i) + far * WIDE_EIGHT (x, beside) +
                   south * WIDE_EIGHT (x, above) +
                   north * WIDE_EIGHT (x, below);

      for (int k = 0; k < 8; k++)
        whole[k] = whole[k] > 0 ? whole[k] : 1; /* the sum is 0 then */
      *(Loose *) (out + (i - first) * (size_t) lanes) = sum / whole;
    }
}

/* r of row y, from the black rows round it. */
CELD_INLINE void
residual_row (const ResidualPass *pass, int y, const double *above, const double *here, const double *below, int lanes)
{
  const CeldGridLevel *level = pass->level;
  const float         *x = pass->s->x;
  float               *r = pass->s->r;
  size_t               first = (size_t) (y + 1) * level->stride, many = (size_t) lanes;

  place_rhs_row (pass->s, y, 0, r + first * many, lanes);
  for (EACH_PLACE (level, y, i))
    {
      size_t at = i - first;
      Eight  red = WIDE_EIGHT (x, i);
      Eight  sum = WIDE_EIGHT (r, i) - WIDE_WEIGHT (level->diagonal, i) * red;

      sum += WIDE_WEIGHT (level->near, i) * (*(const Loose *) (here + at * many) - red);
      sum += WIDE_WEIGHT (level->far, i) * (*(const Loose *) (here + (at - (y & 1 ? -(size_t) 1 : 1)) * many) - red);
      sum += WIDE_WEIGHT (level->north, i) * (*(const Loose *) (above + at * many) - red);
      sum += WIDE_WEIGHT (level->south, i) * (*(const Loose *) (below + at * many) - red);
      PUT (r, i, __builtin_convertvector (sum, CeldEight));
    }
}

/* The caller's row y. */
CELD_INLINE void
deliver_row (const ResidualPass *pass, int y, const double *black, int lanes)
{
  const CeldGridLevel *level = pass->level;
  size_t               first = (size_t) (y + 1) * level->stride, many = (size_t) lanes, odd = (size_t) y & 1;
  float               *out = pass->s->user + (size_t) y * (size_t) level->width * many;

  for (size_t i = level->row[y].first; i < level->row[y].end; i++)
    for (size_t k = 0; k < many; k++)
      {
        size_t x = 2 * (i - first - 1);

        if (level->inverse[i] > 0)
          out[(x + odd) * many + k] = pass->s->x[i * many + k];
        if (level->inverse[level->plane + i] > 0)
          out[(x + !odd) * many + k] = (float) black[(i - first) * many + k];
      }
}

CELD_INLINE void
residual (void *data, int strip, int lanes)
{
  const ResidualPass  *pass = data;
  const CeldGridLevel *level = pass->level;
  size_t               size = level->stride * (size_t) lanes;
  double              *ring = pass->s->scratch + (size_t) strip * 3 * size;
  float               *side = pass->s->side + (size_t) strip * size;
  int                  from = strip * CELD_STRIP, end = from + CELD_STRIP;
  int                  to = end < level->height ? end : level->height;

  for (int y = from - 1; y <= to; y++)
    {
      double *row[3];

      for (int k = 0; k < 3; k++) /* rows y-2, y-1, y */
        row[k] = ring + (size_t) ((y + 4 + k) % 3) * size;
      solve_black_row (pass, y, side, row[2], lanes);
      if (pass->deliver && y >= from && y < to)
        deliver_row (pass, y, row[2], lanes);
      if (!pass->deliver && y > from)
        residual_row (pass, y - 1, row[0], row[1], row[2], lanes);
    }
}

/* The red pixels of a strip, from the caller's. */
CELD_INLINE void
read_strip (void *data, int strip, int lanes)
{
  const ResidualPass  *pass = data;
  const CeldGridLevel *level = pass->level;
  size_t               many = (size_t) lanes, w = (size_t) level->width;
  int                  from = strip * CELD_STRIP, end = from + CELD_STRIP;
  int                  to = end < level->height ? end : level->height;

  for (int y = from; y < to; y++)
    {
      const float *in = pass->s->user + ((size_t) y * w + ((size_t) y & 1)) * many;
      size_t       first = (size_t) (y + 1) * level->stride;

      for (size_t i = level->row[y].first; i < level->row[y].end; i++)
        for (size_t k = 0; k < many && level->inverse[i] > 0; k++)
          pass->s->x[i * many + k] = in[2 * (i - first - 1) * many + k];
    }
}

STRIP_PASS (pixels_read, read_strip)
STRIP_PASS (pixels_residual, residual)

static inline bool
has_edge (const CeldGridLevel *level, size_t i)
{
  return level->near[i] > 0 || level->far[i] > 0 || level->north[i] > 0 || level->south[i] > 0;
}

/* Pixels of row y without an edge: their residual goes at once.  Others have no coarser node either. */
static void
settle_row (const ResidualPass *pass, int y)
{
  const CeldGridLevel *level = pass->level;
  float               *x = pass->s->x, *r = pass->s->r;
  size_t               many = (size_t) pass->s->lanes;

  for (size_t i = level->row[y].first; i < level->row[y].end; i++)
    for (size_t k = i * many; k < (i + 1) * many && !level->coarser[i] && !has_edge (level, i); k++)
      {
        x[k] += level->inverse[i] * r[k];
        r[k] = 0;
      }
}

/* A pass of its own, after the residual: for that the strips beside this one read its x. */
static void
settle_strip (void *data, int strip)
{
  const ResidualPass *pass = data;
  int                 from = strip * CELD_STRIP, end = from + CELD_STRIP;

  for (int y = from; y < end && y < pass->level->height; y++)
    settle_row (pass, y);
}

/* ------------------------------------------------------------------ the passes */

void
celd_pixels_refresh (CeldSolution *s)
{
  ResidualPass pass = { .s = s, .level = &s->laplace->hierarchy.level[0] };

  RUN_PASS (&pass, s->host, s->lanes, pixels_residual);
}

void
celd_pixels_begin (CeldSolution *s)
{
  ResidualPass pass = { .s = s, .level = &s->laplace->hierarchy.level[0] };

  RUN_PASS (&pass, s->host, s->lanes, pixels_read);
  RUN_PASS (&pass, s->host, s->lanes, pixels_residual);
  celd_row_pass (s->host, pass.level->height, settle_strip, &pass);
}

void
celd_pixels_deliver (CeldSolution *s)
{
  ResidualPass pass = { .s = s, .level = &s->laplace->hierarchy.level[0], .deliver = true };

  RUN_PASS (&pass, s->host, s->lanes, pixels_residual);
}
