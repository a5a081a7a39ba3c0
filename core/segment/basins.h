/* The basin graph of a drawing: the regions that a person sees in the line art alone, before any scribble.
 *
 * The relief is the squared Euclidean distance to ink on paper, and minus the squared distance to paper in ink; in the
 * core of a solid area, deeper than strokes are, it rises again.  A basin is the pixels that ascend to one maximum of
 * the relief, so that basins meet in the middle of lines and at the narrowest place of a gap.  What the paper's energy
 * charges between two basins is summed up exactly in their border.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_BASINS_H
#define CELD_BASINS_H

#include "base/base.h"

/* ------------------------------------------------------------------ costs.c */

#define CELD_COST_UNIT 16       /* of an edge inside ink: energies are integers */
#define CELD_INK_STEPS 1024     /* of the table by ink */
#define CELD_MOST_TO_PAPER   1024     /* squared pixels: from here on ink costs no less */

typedef struct
{
  int     width, height;
  double  paper_cost;                       /* K: what an edge of paper costs more than one of ink */
  int32_t by_ink[CELD_INK_STEPS + 1];       /* from ink to paper */
  int32_t discount[CELD_MOST_TO_PAPER + 1]; /* taken off by the squared distance to paper */
  int32_t margin;                           /* edges of paper along the frame stand for so many */
} CeldSmoothnessCosts;

/* `threshold` is settings->ink_threshold. */
void celd_smoothness_costs_new (int width, int height, float threshold, CeldSmoothnessCosts *costs);

/* V between two neighbouring pixels: their ink, their squared distances to paper (0 or less for paper), and whether
 * both are outermost pixels on one side of the picture. */
int32_t celd_smoothness_cost (const CeldSmoothnessCosts *costs, float ink, float other_ink, int32_t to_paper,
                              int32_t other_to_paper,
                              bool along_frame);

/* The squared distance of every pixel to the nearest paper, 0 on paper: a tight plane of the picture's size. */
CeldStatus celd_distance_to_paper (const CeldPlane *ink, const CeldHost *host, int32_t *to_paper);

/* ------------------------------------------------------------------ basins */

typedef struct
{
  int32_t  x, y;      /* its maximum */
  int32_t  squared;   /* there: squared distance to ink; in a solid area, to paper */
  bool     solid;     /* the maximum is ink: the core of a solid area */
  uint32_t area;      /* pixels, paper and ink */
} CeldBasin;

/* Where two basins touch, a < b.  A pair is two neighbouring pixels, one in each. */
typedef struct
{
  uint32_t a, b;
  uint32_t opening;   /* pairs that are both paper: the width of the opening between the two */
  int32_t  saddle;    /* the greatest over these pairs of the lesser squared distance to ink; 0 without passes.
                       * Between two solid basins: the same with the squared distance to paper, over all pairs. */
  bool     frame;     /* some pass lies along the frame: the page goes on behind it */
  bool     south;     /* the pair of the saddle is (x,y) and the pixel below, not the one to the right */
  int32_t  x, y;
  int64_t  cost;      /* sum of V over all pairs */
} CeldBasinBoundary;

/* Row y is run[row[y]] .. run[row[y + 1] - 1], each from its x up to the next one's, the last up to the frame. */
typedef struct { int32_t x; uint32_t basin; } CeldBasinRun;

typedef struct
{
  int                 width, height;
  int                 stroke;   /* width of the drawing's strokes: celd_stroke_width */
  CeldSmoothnessCosts costs;
  size_t              n, n_boundaries;
  CeldBasin          *basin;    /* 0 .. n - 1, in reading order of their maxima */
  CeldBasinBoundary  *boundary; /* by a, then b */
  size_t             *row;      /* height + 1 */
  CeldBasinRun       *run;
  uint8_t            *paper;    /* which pixels are paper: ask celd_paper_count */
  /* Coarser and coarser unions of basins, by basin, from 1: */
  uint32_t *merged;              /* basins that no narrow place parts, however wide; solid ones among themselves */
  uint32_t *enclosure;           /* blocks that no gap in a contour parts; 0 for solid ones */
  uint32_t *component;           /* connected paper; 0 for solid ones */
  size_t    n_merged, n_enclosures, n_components;
} CeldBasins;

/* `threshold` is settings->ink_threshold.  A zeroed record may be cleared. */
CeldStatus celd_basins_new (const CeldPlane *ink, float threshold, const CeldHost *host, CeldBasins *basins);

/* The same after the ink has changed inside `changed`: the result is that of celd_basins_new, but only what the change
 * can reach is made again. */
CeldStatus celd_basins_update (const CeldPlane *ink, const CeldRect *changed, const CeldHost *host, CeldBasins *basins);

/* Puts the basins of this ink in place of those of *basins: with `changed` as celd_basins_update, else as
 * celd_basins_new.  After a failure *basins is as before. */
CeldStatus celd_basins_make (const CeldPlane *ink, const CeldRect *changed, float threshold, const CeldHost *host,
                             CeldBasins *basins);

void celd_basins_clear (CeldBasins *basins);

/* How many of the pixels x .. end - 1 of row y are paper.  What it needs to know of the drawing is made
 * by celd_paper_new, and again inside `changed` by celd_paper_update. */
uint32_t   celd_paper_count (const CeldBasins *basins, int y, int x, int end);
CeldStatus celd_paper_new (const CeldPlane *ink, const CeldHost *host, uint8_t **bits);
void       celd_paper_update (const CeldPlane *ink, const CeldRect *changed, const CeldHost *host, uint8_t *bits);

/* The basin run that holds the pixel (x,y). */
static inline size_t
celd_basin_run (const CeldBasins *basins, int x, int y)
{
  size_t low = basins->row[y], high = basins->row[y + 1];

  while (high - low > 1)
    {
      size_t middle = (low + high) / 2;

      if (basins->run[middle].x <= x)
        low = middle;
      else
        high = middle;
    }
  return low;
}

/* Where that run ends: the x behind its last pixel. */
static inline int
celd_basin_run_end (const CeldBasins *basins, size_t run, int y)
{
  return run + 1 < basins->row[y + 1] ? basins->run[run + 1].x : basins->width;
}

/* The basin of a pixel. */
static inline uint32_t
celd_basin_at (const CeldBasins *basins, int x, int y)
{
  return basins->run[celd_basin_run (basins, x, y)].basin;
}

#endif
