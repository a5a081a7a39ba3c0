/* Rows of a level's vectors, eight numbers at a time: eight places of one vector, or one place of CELD_LANES vectors.
 * Every function that uses them is compiled for both, `lanes` being a constant.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_LAPLACE_ROWS_H
#define CELD_LAPLACE_ROWS_H

#include "solve/laplace-private.h"
#include "solve/laplace.h"

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
  size_t i = (size_t) ((y) + 1) * (level)->stride + 1, end_ = i + (size_t) (level)->half; i < end_; \
  i += 8 / (size_t) lanes

/* What the neighbours of the black places from i on pull, red ones being `red`, in row y. */
#define PULL_BLACK(level, y, i, red) \
  (WEIGHT ((level)->near, i) * EIGHT (red, i) + \
   WEIGHT ((level)->far, (i) + ((y) & 1 ? -(size_t) 1 : 1)) * EIGHT (red, (i) + ((y) & 1 ? -(size_t) 1 : 1)) + \
   WEIGHT ((level)->south, (i) - (level)->stride) * EIGHT (red, (i) - (level)->stride) + \
   WEIGHT ((level)->north, (i) + (level)->stride) * EIGHT (red, (i) + (level)->stride))

/* The same for red ones. */
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

/* Adds `pull`, of the places from i on, to where they go on the coarser level. */
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

/* ------------------------------------------------------------------ sweeps
 *
 * A sweep takes the rows through several stages, of which each needs its rows y-1 .. y+1 from the stage before and may
 * overwrite what that one has read there.  One strip of rows runs through all stages while it is in the cache, as far
 * as its own rows allow; the rows beside borders of strips follow in rounds of their own.  So threads share strips, and
 * none can change the result. */

/* May stage `stage` take this row of the strip from .. to-1 before the other strips are done? */
static inline bool
celd_row_ready (int row, int from, int to, int height, int stage)
{
  return row >= (from ? from + stage : 0) && row < (to < height ? to - stage : height);
}

/* Runs `stages` rounds of a sweep's body; `phase` is the body's. */
static inline void
celd_sweep (const CeldHost *host, int height, int stages, void (*body) (void *pass, int i), void *pass, int *phase)
{
  int strips = (height + CELD_STRIP - 1) / CELD_STRIP;

  for (*phase = 0; *phase < stages; ++*phase)
    celd_parallel_for (host, *phase ? strips - 1 : strips, body, pass);
}

/* Defines the bodies name_single and name_lanes of a sweep over Pass, whose stages are stage (pass, row, lanes).  Names
 * are unique in core: clang makes what chooses between clones global. */
#define SWEEP(name, stages, first, second, third, fourth) \
  CELD_INLINE void name (void *data, int i, int lanes) \
  { \
    Pass *p = data; \
    int   height = p->level->height, from = i * CELD_STRIP, end = from + CELD_STRIP, to = end < height ? end : height; \
\
    if (p->phase) \
      for (int y = to - p->phase; y < to + p->phase && y < height; y++) \
        { \
          if (p->phase == 1) \
            second (p, y, lanes); \
          if (p->phase == 2) \
            third (p, y, lanes); \
          if (p->phase == 3) \
            fourth (p, y, lanes); \
        } \
    else \
      for (int y = from; y < to + (stages) - 1; y++) \
        { \
          if (y < to) \
            first (p, y, lanes); \
          if ((stages) > 1 && celd_row_ready (y - 1, from, to, height, 1)) \
            second (p, y - 1, lanes); \
          if ((stages) > 2 && celd_row_ready (y - 2, from, to, height, 2)) \
            third (p, y - 2, lanes); \
          if ((stages) > 3 && celd_row_ready (y - 3, from, to, height, 3)) \
            fourth (p, y - 3, lanes); \
        } \
  } \
  CELD_CLONES static void name##_single (void *data, int strip) { name (data, strip, 1); } \
  CELD_CLONES static void name##_lanes (void *data, int strip) { name (data, strip, CELD_LANES); }

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
