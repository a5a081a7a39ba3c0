/* The steps from a signed distance to the basin graph.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_BASIN_STEPS_H
#define CELD_BASIN_STEPS_H

#include "segment/basins.h"

#define CELD_OLD_BASIN (1u << 30) /* in place of a basin: the rest is a basin of the old graph */

/* The part of a drawing that basins are made of: all of it, or a box in which some pixels are made anew. */
typedef struct
{
  CeldRect          box;
  const int32_t    *squared;  /* signed distance, from the first pixel of the box on */
  size_t            stride;   /* of squared */
  int               stroke;
  const uint8_t    *rebuilt;  /* of each pixel of the box: is it made anew?  NULL: all are */
  const CeldBasins *old;      /* what the others keep */
} CeldBasinExtent;

/* basin-ascent.c: fills in basin, n, row and run of a graph of the size of the box, areas left out.  Pixels that are
 * not made anew belong to CELD_OLD_BASIN | their old basin; outside the box nothing may be made anew. */
CeldStatus celd_basins_ascend (const CeldBasinExtent *extent, const CeldHost *host, CeldBasins *basins);

/* basin-borders.c: the borders of the basins that width, height, basin, row and run describe, as far as a pixel of each
 * pair is made anew.  End with celd_free. */
CeldStatus celd_basins_find_boundaries (const CeldPlane *ink, const CeldBasinExtent *extent, const CeldBasins *basins,
                                        const CeldHost *host,
                                        CeldBasinBoundary **boundary, size_t *n);

/* One border where both are, of the same basins. */
void celd_basin_boundary_add (CeldBasinBoundary *boundary, const CeldBasinBoundary *more);

/* basin-unions.c: fills in block, room and piece. */
CeldStatus celd_basins_merge (CeldBasins *basins);

/* basins.c: fills in the areas. */
void celd_basins_count_areas (CeldBasins *basins);

/* basin-change.c: what of a graph a change of the drawing inside a rectangle reaches. */
typedef struct
{
  CeldRect box;        /* of the touched basins, and a pixel more */
  CeldRect window;     /* box and as much as its distances are long */
  uint8_t *affected;   /* by old basin; end with celd_free, also after a failure */
  bool     worthwhile; /* is it less work than all of the drawing?  If not, box and window may be missing */
} CeldBasinChange;

CeldStatus celd_basins_find_change (const CeldPlane *ink, const CeldBasins *old, const CeldRect *changed,
                                    const CeldHost *host, CeldBasinChange *change);

/* ------------------------------------------------------------------ bands of rows in which pixels are led up */

#define CELD_WATERSHED_BAND    32         /* rows of a band */
#define CELD_WATERSHED_JOBS   8          /* bands at once, with threads */
#define CELD_LEAD_MAXIMUM (1u << 31) /* of a lead: the rest is twice the number of a maximum in its band, or with CELD_OLD_BASIN
                                 * of an old basin; else it is a place in `edge` */

/* Pixels of a row, up to the next stretch: all lead to the same, or each to the place after the last one's. */
typedef struct { int32_t x; bool moves; uint32_t lead; } CeldLeadStretch;

/* What a band finds. */
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
} CeldWatershedBand;

/* What a job works with. */
typedef struct
{
  int32_t  *relief;         /* 3 rows with a pixel more at both ends */
  uint32_t *lead;           /* of the band and a row above and below it, likewise */
  uint8_t  *step;
  uint8_t  *begins;         /* a row */
} CeldWatershedScratch;

typedef struct
{
  const CeldBasinExtent *extent;
  int                    width, height;
  int32_t                core;  /* of ink that is deeper the relief rises again */
  uint32_t              *edge;  /* the first and the last row of each band: where they lead, then their basins */
  uint32_t              *until; /* of a place in edge: the next one that has another basin, or is another row's */
  CeldWatershedScratch   scratch[CELD_WATERSHED_JOBS];
  int                    n_jobs;
  CeldWatershedBand     *band;
  int                    n_bands;
  int                    first; /* the first band of this round of jobs */
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

/* basin-bands.c: the maxima and stretches of band first + job of a CeldWatershed, and where its edges lead. */
void celd_watershed_lead_band (void *data, int job);

#endif
