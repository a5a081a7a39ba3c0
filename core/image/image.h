/* Pictures: ink and paper, label pictures, distances, connected components, blur.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_IMAGE_H
#define CELD_IMAGE_H

#include "base/base.h"

/* ------------------------------------------------------------------ paper.c: what a drawing was made with */

/* The mode that CELD_INK_AUTO stands for; any other mode itself, but for CELD_INK_ALPHA of an opaque picture. */
CeldInkMode celd_ink_mode (const CeldDrawing *drawing, CeldInkMode mode);

/* One value a pixel, 1 = bright paper, 0 = full ink, in a mode that is not CELD_INK_AUTO; of the drawing's size. */
void celd_ink_values (const CeldDrawing *drawing, CeldInkMode mode, CeldPlane *value);

/* The level of the paper round each pixel, on the scale of the values, > 0. */
CeldStatus celd_paper_levels (const CeldPlane *value, CeldPlane *paper);

/* ------------------------------------------------------------------ ink as the regions see it */

/* Is this value of ink paper rather than ink?  NaN is. */
static inline bool
celd_is_paper (float ink)
{
  return !(ink < 0.5f);
}

/* stroke-width.c: the median length of the runs of ink along rows and columns, in pixels; 0 without ink, at most 256.
 * Solid black areas hardly count. */
int celd_stroke_width (const CeldPlane *ink);

/* Moves (*x,*y) to the nearest paper, itself if it is paper; false if there is none within `reach` pixels. */
bool celd_paper_near (const CeldPlane *ink, int reach, int *x, int *y);

/* frame.c: the paper pixels along the frame, as y * width + x (ink NULL: all outermost pixels); corners may come twice.
 * `stroke` is the width of the drawing's strokes; 0: it is measured if need be.  End with celd_free. */
CeldStatus celd_frame (const CeldPlane *ink, int width, int height, int stroke, size_t **pixel, size_t *n);

/* ------------------------------------------------------------------ labels.c */

/* Fills in the area of each label and a pixel of it as far as can be from ink (may be NULL) and other labels; -1,-1 for
 * labels without a pixel. */
CeldStatus celd_palette_measure (const CeldLabels *labels, const CeldPlane *ink, const CeldHost *host,
                                 CeldPalette *palette);

/* Makes a copy; `copy` is overwritten. */
CeldStatus celd_palette_copy (const CeldPalette *palette, CeldPalette *copy);

/* The first opaque label of this colour, or of the nearest one that colour management may have made of it (2 of 255 a
 * channel); 0 if there is none. */
uint32_t celd_palette_find (const CeldPalette *palette, const uint8_t colour[3]);

/* ------------------------------------------------------------------ distance.c: exact Euclidean distance transform */

/* squared[p] = squared distance from the centre of p to the centre of the nearest pixel q with inside (q) != 0;
 * INT32_MAX if there is none.  Tight planes of width x height; their content is undefined after a cancel. */
CeldStatus celd_distance (int width, int height, const uint8_t *inside, const CeldHost *host, int32_t *squared);
/* The same, and the index y * width + x of that nearest pixel (ties: any, but always the same one); -1 if none. */
CeldStatus celd_nearest (int width, int height, const uint8_t *inside, const CeldHost *host, int32_t *squared,
                         int32_t *nearest);
/* signed-distance.c: of paper the squared distance to the nearest ink, of ink minus that to the nearest paper.  One
 * tight plane of the size of the ink, which decides by celd_is_paper; INT32_MAX and -INT32_MAX where there is none. */
CeldStatus celd_signed_distance (const CeldPlane *ink, const CeldHost *host, int32_t *squared);

/* ------------------------------------------------------------------ components.c: connected components */

typedef struct
{
  uint32_t label;                    /* of its pixels in the input */
  int      x, y;                     /* its first pixel in reading order */
  int      left, top, right, bottom; /* inclusive */
  size_t   area;
} CeldComponent;

/* 4- or 8-connected components of equal labels.  Pixels of label `none` (pass UINT32_MAX for no such label) get
 * component 0; others 1 .. n in reading order of their first pixel.  *list has n items, item k-1 is component k;
 * end it with celd_free.  `components` may alias `labels`. */
CeldStatus celd_components (const CeldLabels *labels, uint32_t none, bool diagonal, const CeldHost *host,
                            CeldLabels *components, CeldComponent **list, size_t *n);

/* ------------------------------------------------------------------ affinity.c: the weights of edges */

/* The weights w_pq of eq. (1), least `floor`, for celd_lap_setup: tight planes of the size of the ink, zero where the
 * picture ends.  I_p - I_q is the contrast round p or round q, 3 x 3 pixels, whichever is less; sigma is `contrast`
 * times the mean of the plain (I_p - I_q)^2 over all pairs of neighbours, as *mean tells. */
CeldStatus celd_affinities (const CeldPlane *ink, float contrast, float floor, const CeldHost *host,
                            float *east, float *south, double *mean);

/* ------------------------------------------------------------------ seed-rows.c */

typedef struct { int x, end; uint32_t label; } CeldSeedRun;       /* pixels x .. end - 1; label > 0 */
typedef struct { CeldSeedRun *run; size_t n, run_capacity; } CeldSeedRow;       /* from left to right, apart or of other labels */
typedef struct { int width, height; CeldSeedRow *row; } CeldSeedRows;

CeldStatus celd_seed_rows_new (int width, int height, CeldSeedRows *seeds);      /* without a seed */
void       celd_seed_rows_clear (CeldSeedRows *seeds);                           /* accepts a zeroed record */

CeldStatus celd_seed_rows_read (const CeldLabels *labels, CeldSeedRows *seeds);  /* makes the record */
CeldStatus celd_seed_rows_copy (const CeldSeedRows *from, CeldSeedRows *seeds);     /* makes the record */
void       celd_seed_rows_write (const CeldSeedRows *seeds, CeldLabels *labels); /* of the same size; 0 elsewhere */

/* The pixels x .. end - 1 of row y, cut to the picture, take a label; label 0 takes them back. */
CeldStatus celd_seed_rows_paint (CeldSeedRows *seeds, int y, int x, int end, uint32_t label);

/* The label of a pixel, 0 without a seed. */
uint32_t celd_seed_rows_at (const CeldSeedRows *seeds, int x, int y);

/* ------------------------------------------------------------------ blur.c */

typedef struct
{
  int picture_width, picture_height;
  int side;                        /* of a cell in pixels, a power of two; those at the right and bottom are cut off */
  int width, height;               /* in cells */
} CeldBlurGrid;

/* Weights of the cells first .. first + n - 1 to the right of one; they add up to 1. */
typedef struct { int first, n; float *weight; } CeldKernel;

/* Where a column (or row) of pixels lies between cells: (1 - share) of one and share of the other. */
typedef struct { int one, other; float share; } CeldBetween;

/* Cells for a Gaussian of this deviation in pixels, > 0. */
CeldBlurGrid celd_cells (int width, int height, double deviation);

/* Centred `shift` pixels to the right; end with celd_free (weight). */
CeldStatus celd_kernel_new (const CeldBlurGrid *cells, double deviation, double shift, CeldKernel *kernel);

/* The picture's columns between the cells' columns, and the same for rows; NULL: no memory. */
CeldBetween *celd_between_columns (const CeldBlurGrid *cells);
CeldBetween *celd_between_rows    (const CeldBlurGrid *cells);

/* width x height values by one kernel along rows and one along columns, mirrored at the edges; `scratch` is as
 * large. */
void celd_blur (const CeldKernel *along, const CeldKernel *down, int width, int height, float *value, float *scratch);

#endif
