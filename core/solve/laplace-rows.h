/* Rows of a level's vectors, eight numbers at a time: eight places of one vector (lanes == 1), or one place of
 * CELD_LANES vectors.  Every function that uses these macros is compiled for both, `lanes` being a constant in it.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_LAPLACE_ROWS_H
#define CELD_LAPLACE_ROWS_H

#include "solve/laplace-private.h"

#define CELD_INLINE static inline __attribute__ ((always_inline))

typedef float CeldEight __attribute__ ((vector_size (32)));
typedef float CeldLoose __attribute__ ((vector_size (32), aligned (4), may_alias)); /* anywhere in memory */

/* Numbers of a vector from place i on. */
#define EIGHT(v, i) ((CeldEight) *(const CeldLoose *) ((v) + (size_t) (i) * (size_t) lanes))
#define PUT(v, i, value) (*(CeldLoose *) ((v) + (size_t) (i) * (size_t) lanes) = (value))
/* Weights of the same places. */
#define WEIGHT(w, i) (lanes == 1 ? (CeldEight) *(const CeldLoose *) ((w) + (i)) : SPLAT ((w)[i]))
#define SPLAT(s) ((CeldEight) { (s), (s), (s), (s), (s), (s), (s), (s) })

/* A coefficient of every lane. */
#define LANES(v) (lanes == 1 ? SPLAT ((v)[0]) : (CeldEight) *(const CeldLoose *) (v))

/* Places i of row y: for (EACH_PLACE (level, y, i)). */
#define EACH_PLACE(level, y, i) \
  size_t i = (level)->row[y].first, end_ = (level)->row[y].end; i < end_; \
  i += 8 / (size_t) lanes

/* Sum of weight times value over the red neighbours of the black places from i on, in row y. */
#define PULL_BLACK(level, y, i, red) \
  (WEIGHT ((level)->near, i) * EIGHT (red, i) + \
   WEIGHT ((level)->far, (i) + ((y) & 1 ? -(size_t) 1 : 1)) * EIGHT (red, (i) + ((y) & 1 ? -(size_t) 1 : 1)) + \
   WEIGHT ((level)->south, (i) - (level)->stride) * EIGHT (red, (i) - (level)->stride) + \
   WEIGHT ((level)->north, (i) + (level)->stride) * EIGHT (red, (i) + (level)->stride))

/* Sum of weight times value over the black neighbours of the red places from i on, in row y. */
#define PULL_RED(level, y, i, black) \
  (WEIGHT ((level)->near, i) * EIGHT (black, i) + \
   WEIGHT ((level)->far, i) * EIGHT (black, (i) - ((y) & 1 ? -(size_t) 1 : 1)) + \
   WEIGHT ((level)->north, i) * EIGHT (black, (i) - (level)->stride) + \
   WEIGHT ((level)->south, i) * EIGHT (black, (i) + (level)->stride))

/* out += w in, every lane of a place. */
#define ADD(out, i, w, in, j) \
  do \
    if (lanes == 1) \
      (out)[i] += (w) * (in)[j]; \
    else \
      PUT (out, i, EIGHT (out, i) + SPLAT (w) * EIGHT (in, j)); \
  while (0)

/* Restriction: adds `pull` of the places from i on to their aggregates on the coarser level. */
#define RESTRICT(level, i, pull, coarse) \
  do \
    if (lanes > 1) \
      { \
        if ((level)->coarser[i]) \
          PUT (coarse, (level)->coarser[i], EIGHT (coarse, (level)->coarser[i]) + (pull)); \
      } \
    else \
      for (size_t k_ = 0; k_ < 8; k_++) \
        if ((level)->coarser[(i) + k_]) \
          (coarse)[(level)->coarser[(i) + k_]] += (pull)[k_]; \
  while (0)

/* ------------------------------------------------------------------ passes
 *
 * A pass takes every row once; its rows are independent of each other, so that strips of them go to the host's threads
 * and none can change the result. */

/* Defines name_single and name_lanes, which process a strip: body (data, strip, lanes).  Names are unique in core,
 * since clang makes the function that chooses between clones global. */
#define STRIP_PASS(name, body) \
  CELD_CLONES static void name##_single (void *data, int strip) { body (data, strip, 1); } \
  CELD_CLONES static void name##_lanes (void *data, int strip) { body (data, strip, CELD_LANES); }

/* Does so by the rows of a strip of a Pass: row (pass, y, lanes). */
#define ROW_PASS(Pass, name, row) \
  CELD_INLINE void name (void *data, int strip, int lanes) \
  { \
    Pass *p = data; \
    int   from = strip * CELD_STRIP, end = from + CELD_STRIP, to = end < p->level->height ? end : p->level->height; \
\
    for (int y = from; y < to; y++) \
      row (p, y, lanes); \
  } \
  STRIP_PASS (name, name)

/* Runs a pass for all strips. */
#define RUN_PASS(pass, host, lanes, name) \
  celd_row_pass (host, (pass)->level->height, (lanes) == 1 ? name##_single : name##_lanes, pass)

/* Runs the body of a pass for all strips. */
static inline void
celd_row_pass (const CeldHost *host, int height, void (*body) (void *pass, int strip), void *pass)
{
  celd_parallel_for (host, (height + CELD_STRIP - 1) / CELD_STRIP, body, pass);
}

/* Do strips of the level share coarse nodes?  Only if its cells join more rows than a strip has. */
static inline bool
celd_strips_share (const CeldGridLevel *level)
{
  return level[1].height * (CELD_STRIP / 2) < level->height;
}

/* Keeps the sums of a row: of every lane, or of all eight. */
CELD_INLINE void
celd_keep_sum (double *sum, const CeldEight *of, int lanes)
{
  const CeldEight v = *of;

  if (lanes > 1)
    for (int k = 0; k < 8; k++)
      sum[k] = (double) v[k];
  else
    sum[0] = (((double) v[0] + (double) v[1]) + ((double) v[2] + (double) v[3])) +
             (((double) v[4] + (double) v[5]) + ((double) v[6] + (double) v[7]));
}

#endif
