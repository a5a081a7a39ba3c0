/* The steps from a signed distance to the basin graph, shared by the files that make one.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_BASIN_STEPS_H
#define CELD_BASIN_STEPS_H

#include "segment/basins.h"

#define CELD_OLD_BASIN (1u << 30) /* in place of a basin number: the rest is a number in the old graph */

/* The part of a drawing in which basins are found: all of it, or a box in which some pixels are assigned again. */
typedef struct
{
  CeldRect          box;
  const int32_t    *squared;  /* signed squared distance, from the first pixel of the box on */
  size_t            stride;   /* of squared */
  int               stroke;
  const uint8_t    *rebuilt;  /* of each pixel of the box: is it assigned again?  NULL: all are */
  const CeldBasins *old;      /* the basins that the other pixels keep */
} CeldBasinExtent;

/* watershed.c: fills in basin, n, row and run of a graph of the size of the box; areas are 0.  Pixels that are not
 * assigned again belong to CELD_OLD_BASIN | their old basin; none outside the box may be assigned again. */
CeldStatus celd_basins_ascend (const CeldBasinExtent *extent, const CeldHost *host, CeldBasins *basins);

/* basin-boundaries.c: the boundaries of the basins that width, height, basin, row and run describe, counting only pairs
 * with a pixel that is assigned again.  The caller frees *boundary with celd_free. */
CeldStatus celd_basins_find_boundaries (const CeldPlane *ink, const CeldBasinExtent *extent, const CeldBasins *basins,
                                        const CeldHost *host, CeldBasinBoundary **boundary, size_t *n);

/* Adds to a boundary another part of it. */
void celd_basin_boundary_add (CeldBasinBoundary *boundary, const CeldBasinBoundary *more);

/* basins.c: fills in merged, enclosure and component, and their numbers. */
CeldStatus celd_basins_merge (CeldBasins *basins);

/* basins.c: fills in the areas. */
void celd_basins_count_areas (CeldBasins *basins);

/* basin-change.c: the basins that a change of the drawing inside a rectangle can reach. */
typedef struct
{
  CeldRect box;        /* of the affected basins, and a pixel more */
  CeldRect window;     /* the box, and as far round it as its distances are long */
  uint8_t *affected;   /* by old basin; end with celd_free, also after a failure */
  bool     worthwhile; /* is an update less work than building all?  If not, box and window may be unset */
} CeldBasinChange;

CeldStatus celd_basins_find_change (const CeldPlane *ink, const CeldBasins *old, const CeldRect *changed,
                                    const CeldHost *host, CeldBasinChange *change);

/* ------------------------------------------------------------------ watershed.c, watershed-bands.c: bands of rows */

#define CELD_WATERSHED_BAND 32 /* rows of a band (chosen) */
#define CELD_WATERSHED_JOBS 8  /* bands at a time, with threads (chosen) */

/* Flag of a lead: the rest is twice the number of a maximum in its band, or with CELD_OLD_BASIN of an old basin.  A
 * lead without the flag is an index into `edge`. */
#define CELD_LEAD_MAXIMUM (1u << 31)

/* Pixels of a row, up to the next stretch.  Either all lead to the same place, or each to the place after the previous
 * one's. */
typedef struct { int32_t x; bool moves; uint32_t lead; } CeldLeadStretch;

/* What is found in a band. */
typedef struct
{
  uint32_t        *maximum; /* pixels in reading order */
  size_t           n;
  size_t           first;   /* basin of its first maximum */
  CeldLeadStretch *stretch;
  size_t           row[CELD_WATERSHED_BAND + 1];
  CeldBasinRun    *run;
  size_t           n_runs;
  bool             failed;  /* no memory */
  size_t           maximum_capacity, stretch_capacity, run_capacity;
} CeldWatershedBand;

/* Workspace of one job. */
typedef struct
{
  int32_t  *relief;         /* 3 rows with a pixel more at both ends */
  uint32_t *lead;           /* of the band and one row above and below it, likewise */
  uint8_t  *step;
  uint8_t  *begins;         /* a row */
} CeldWatershedScratch;

typedef struct
{
  const CeldBasinExtent *extent;
  int                    width, height;
  int32_t                core;  /* squared distance to paper from which on the relief of ink rises again */
  uint32_t              *edge;  /* first and last row of each band: their leads, then their basins */
  uint32_t              *until; /* of an index into edge: the next one with another basin or in another row */
  CeldWatershedScratch   scratch[CELD_WATERSHED_JOBS];
  int                    n_jobs;
  CeldWatershedBand     *band;
  int                    n_bands;
  int                    first; /* first band of the present round of jobs */
  CeldBasins            *basins;
} CeldWatershed;

static inline int
celd_watershed_band_top (int band)
{
  return band * CELD_WATERSHED_BAND;
}

static inline int
celd_watershed_band_end (const CeldWatershed *a, int band)
{
  return (band + 1) * CELD_WATERSHED_BAND < a->height ? (band + 1) * CELD_WATERSHED_BAND : a->height;
}

/* watershed-bands.c: finds the maxima and stretches of band first + job of a CeldWatershed (`data`), and where its
 * first and last row lead. */
void celd_watershed_lead_band (void *data, int job);

#endif
