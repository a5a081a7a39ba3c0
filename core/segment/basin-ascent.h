/* Bands of rows in which pixels are led up, and what they find.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_BASIN_ASCENT_H
#define CELD_BASIN_ASCENT_H

#include "segment/basin-steps.h"
#include "segment/basins.h"

#define CELD_BAND    32         /* rows of a band */
#define CELD_DESKS   8          /* bands at once, with threads */
#define CELD_MAXIMUM (1u << 31) /* of a lead: the rest is twice the number of a maximum in its band, or with CELD_KEPT
                                 * of an old basin; else it is a place in `edge` */

/* Pixels of a row, up to the next stretch: all lead to the same, or each to the place after the last one's. */
typedef struct { int32_t x; bool moves; uint32_t lead; } CeldAscentRun;

/* What a band finds. */
typedef struct
{
  uint32_t     *maximum;    /* pixels in reading order */
  size_t        n;
  size_t        first;      /* basin of its first maximum */
  CeldAscentRun  *stretch;
  size_t        row[CELD_BAND + 1];
  CeldBasinRun *run;
  size_t        n_runs;
  bool          failed;     /* no memory */
} CeldAscentBand;

/* What a job works with. */
typedef struct
{
  int32_t  *relief;         /* 3 rows with a pixel more at both ends */
  uint32_t *lead;           /* of the band and a row above and below it, likewise */
  uint8_t  *step;
  uint8_t  *begins;         /* a row */
} CeldDesk;

typedef struct
{
  const CeldPlot *plot;
  int             width, height;
  int32_t         core;     /* of ink that is deeper the relief rises again */
  uint32_t       *edge;     /* the first and the last row of each band: where they lead, then their basins */
  uint32_t       *until;    /* of a place in edge: the next one that has another basin, or is another row's */
  CeldDesk        desk[CELD_DESKS];
  int             n_desks;
  CeldAscentBand       *band;
  int             n_bands;
  int             first;    /* the first band of this round of jobs */
  CeldBasins     *basins;
} CeldAscent;

static inline int
celd_band_top (int band)
{
  return band * CELD_BAND;
}

static inline int
celd_band_end (const CeldAscent *a, int band)
{
  return (band + 1) * CELD_BAND < a->height ? (band + 1) * CELD_BAND : a->height;
}

/* basin-bands.c: the maxima and stretches of band first + job of a CeldAscent, and where its edges lead. */
void celd_band_lead (void *data, int job);

#endif
