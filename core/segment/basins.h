/* The basin graph of a drawing: the regions that a person sees in the line art alone, before any scribble.
 *
 * The relief is the squared Euclidean distance to ink on paper, and minus the squared distance to paper in ink; in
 * solid areas, deeper than strokes are, it rises again.  A basin is the catchment basin of one maximum of the relief:
 * the pixels that ascend to it.  Basins meet in the middle of lines and at the narrowest place of a gap.  The
 * smoothness cost along the boundary of two basins is summed up exactly.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_BASINS_H
#define CELD_BASINS_H

#include "segment/segment.h"

typedef struct
{
  int32_t  x, y;      /* the maximum that it ascends to */
  int32_t  squared;   /* there: squared distance to ink; in a solid area, to paper */
  bool     solid;     /* the maximum is ink: the core of a solid area */
  uint32_t area;      /* pixels, paper and ink */
} CeldBasin;

/* The boundary of two basins, a < b: its pairs of neighbouring pixels, one in each. */
typedef struct
{
  uint32_t a, b;
  uint32_t opening;   /* pairs that are both paper: the width of the opening */
  int32_t  saddle;    /* the largest, over these pairs, of the smaller squared distance to ink; 0 without an opening.
                       * Between two solid basins: the same with the squared distance to paper, over all pairs. */
  bool     frame;     /* part of the opening lies along the frame: the page continues there */
  bool     south;     /* the pair of the saddle is (x,y) and the pixel below, not the one to the right */
  int32_t  x, y;
  int64_t  cost;      /* sum of V_pq over all pairs */
  int64_t  weakness;  /* sum of celd_barrier_weakness over all pairs */
} CeldBasinBoundary;

/* Row y is run[row[y]] .. run[row[y + 1] - 1], each from its x up to the next one's, the last to the frame. */
typedef struct { int32_t x; uint32_t basin; } CeldBasinRun;

typedef struct
{
  int                 width, height;
  int                 stroke;   /* stroke width of the drawing, in pixels: celd_stroke_width */
  CeldSmoothnessCosts costs;
  size_t              n, n_boundaries;
  CeldBasin          *basin;    /* 0 .. n - 1, in reading order of their maxima */
  CeldBasinBoundary  *boundary; /* by a, then b */
  size_t             *row;      /* height + 1 */
  CeldBasinRun       *run;
  uint8_t            *paper;    /* which pixels are paper, for celd_paper_count */
  /* Coarser and coarser unions of basins, numbered from 1, by basin: */
  uint32_t *merged;              /* joined over all but narrow openings; solid basins among themselves */
  uint32_t *enclosure;           /* merged basins joined over all but gaps in contours; 0: solid */
  uint32_t *component;           /* connected paper; 0: solid */
  size_t    n_merged, n_enclosures, n_components;
} CeldBasins;

/* Makes the record.  `threshold` is settings->ink_threshold.  CELD_NO_MEMORY, CELD_CANCELLED, CELD_BAD_SIZE. */
CeldStatus celd_basins_new (const CeldPlane *ink, float threshold, const CeldHost *host, CeldBasins *basins);

/* Updates *basins after the ink has changed inside `changed`.  The result equals that of celd_basins_new, but only
 * basins that the change can reach are rebuilt.  After a failure *basins is as before. */
CeldStatus celd_basins_update (const CeldPlane *ink, const CeldRect *changed, const CeldHost *host, CeldBasins *basins);

/* Replaces *basins by those of this ink: updates them inside `changed`, or makes all of them if that is NULL. After a
 * failure *basins is as before. */
CeldStatus celd_basins_make (const CeldPlane *ink, const CeldRect *changed, float threshold, const CeldHost *host,
                             CeldBasins *basins);

void celd_basins_clear (CeldBasins *basins);

/* How many of the pixels x .. end - 1 of row y are paper.  The bits that it counts are made by celd_paper_new (free
 * them with celd_free), and updated inside `changed` by celd_paper_update. */
uint32_t   celd_paper_count (const CeldBasins *basins, int y, int x, int end);
CeldStatus celd_paper_new (const CeldPlane *ink, const CeldHost *host, uint8_t **bits);
void       celd_paper_update (const CeldPlane *ink, const CeldRect *changed, const CeldHost *host, uint8_t *bits);

/* basin-boundaries.c: the order of boundaries, by a, then b, for qsort and bsearch. */
int celd_basin_boundary_compare (const void *a, const void *b);

/* The index of the run that contains the pixel (x,y). */
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

/* The x after the last pixel of a run of row y. */
static inline int
celd_basin_run_end (const CeldBasins *basins, size_t run, int y)
{
  return run + 1 < basins->row[y + 1] ? basins->run[run + 1].x : basins->width;
}

/* Is a space clearly wider than the passage to it, by a quarter and two pixels (chosen)?  Half widths in pixels. */
static inline bool
celd_is_clearly_wider (double space, double passage)
{
  return space > 1.25 * passage + 1;
}

/* The basin of a pixel. */
static inline uint32_t
celd_basin_at (const CeldBasins *basins, int x, int y)
{
  return basins->run[celd_basin_run (basins, x, y)].basin;
}

#endif
