/* Operations on pictures: ink and paper, label pictures, distances, connected components, seeds, blur.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_IMAGE_H
#define CELD_IMAGE_H

#include "base/base.h"

#include <math.h>

#define CELD_SPECK 16 /* pixels: smaller regions do not stand on their own (chosen) */

/* ------------------------------------------------------------------ the lesser and the larger of two values */

/* fminf and fmaxf without a call; not for NaN. */
static inline float
celd_least (float a, float b)
{
  return a < b ? a : b;
}

static inline float
celd_most (float a, float b)
{
  return a > b ? a : b;
}

/* ------------------------------------------------------------------ hues */

/* Counts of colours by the shares of red and green in them. */
#define CELD_HUE_SHARES 32 /* chosen */
typedef uint32_t CeldHueCounts[CELD_HUE_SHARES][CELD_HUE_SHARES];

/* The count of a colour, 0 .. 255. */
static inline uint32_t *
celd_hue_count (CeldHueCounts of, float red, float green, float blue)
{
  float whole = (red + green + blue) * (1 + 1e-6f) + 1e-3f; /* shares are less than 1 */

  return &of[(int) (red / whole * CELD_HUE_SHARES)][(int) (green / whole * CELD_HUE_SHARES)];
}

/* ------------------------------------------------------------------ paper.c: the kind of drawing, and its values */

/* The mode to use for a drawing: never CELD_INK_AUTO, and CELD_INK_ALPHA only if the drawing has transparency. */
CeldInkMode celd_ink_mode (const CeldDrawing *drawing, CeldInkMode mode);

/* Brightness of each pixel as if drawn dark on white, 1 = white paper, 0 = full ink.  `mode` as returned by
 * celd_ink_mode; `value` has the drawing's size. */
void celd_ink_values (const CeldDrawing *drawing, CeldInkMode mode, CeldPlane *value);

/* paper-levels.c: the brightness of the paper around each pixel, > 0; `paper` has the size of `value`. */
CeldStatus celd_paper_levels (const CeldPlane *value, CeldPlane *paper);

/* ------------------------------------------------------------------ ink and paper */

/* Whether a value of ink (0 = ink, 1 = paper) is paper; NaN is. */
static inline bool
celd_is_paper (float ink)
{
  return !(ink < 0.5f);
}

/* ink-measures.c: the median length of the runs of ink along rows and columns, in pixels: 1 .. 256, or 0 without ink.
 * Solid areas have few runs and hardly influence it. */
int celd_stroke_width (const CeldPlane *ink);

/* ink-measures.c: moves (*x,*y) to the nearest paper, at most `radius` pixels away; it stays if it is paper.  False,
 * and unchanged, if there is none. */
bool celd_paper_near (const CeldPlane *ink, int radius, int *x, int *y);

/* ink-measures.c: lists the paper pixels along the edge of the picture, as y * width + x (ink NULL: all outermost
 * pixels); corners may be listed twice.  `stroke` is the width of the drawing's strokes; 0: it is measured if needed.
 * The caller frees *pixel with celd_free. */
CeldStatus celd_frame (const CeldPlane *ink, int width, int height, int stroke, size_t **pixel, size_t *n);

/* ------------------------------------------------------------------ levels and depth */

/* The level or depth of a pixel; NaN and infinity read as 0. */
static inline float
celd_level_at (const CeldPlane *levels, int x, int y)
{
  float level = CELD_AT (levels, x, y);

  return isfinite (level) ? level : 0;
}

/* The least and largest of these levels. */
static inline void
celd_level_range (const CeldPlane *levels, float *least, float *most)
{
  *least = *most = celd_level_at (levels, 0, 0);
  for (int y = 0; y < levels->height; y++)
    for (int x = 0; x < levels->width; x++)
      {
        *least = fminf (*least, celd_level_at (levels, x, y));
        *most  = fmaxf (*most, celd_level_at (levels, x, y));
      }
}

/* ------------------------------------------------------------------ paint.c */

/* Paints a colour, 0 .. 255, over a pixel with straight alpha; an opacity of 0 or less changes nothing. */
void celd_blend (uint8_t *rgba, const double colour[3], double opacity);

/* ------------------------------------------------------------------ labels.c */

/* Sets area and (x,y) of each label in the palette: its number of pixels, and the pixel farthest from ink (may be NULL)
 * and other labels; -1,-1 for labels without a pixel. */
CeldStatus celd_palette_measure (const CeldLabels *labels, const CeldPlane *ink, const CeldHost *host,
                                 CeldPalette *palette);

/* Is a label larger than n? */
bool celd_labels_beyond (const CeldLabels *labels, size_t n);

/* Makes a copy; `copy` is overwritten. */
CeldStatus celd_palette_copy (const CeldPalette *palette, CeldPalette *copy);

/* The label with this colour; if there is none, the one with the nearest colour that differs by at most 2 of 255 per
 * channel, as after colour management; 0 if there is none.  Ignores transparent colours. */
uint32_t celd_palette_find (const CeldPalette *palette, const uint8_t colour[3]);

/* The label with the nearest colour, however far; 0 if all are transparent. */
uint32_t celd_palette_nearest (const CeldPalette *palette, const uint8_t colour[3]);

/* ------------------------------------------------------------------ distance.c: exact Euclidean distance transform */

/* squared[p] = squared distance, in pixels, between the centres of p and of the nearest pixel q with inside[q] != 0;
 * INT32_MAX if there is none.  Tight planes of width x height; after a failure `squared` is undefined. */
CeldStatus celd_distance (int width, int height, const uint8_t *inside, const CeldHost *host, int32_t *squared);
/* Also sets nearest[p] to the index y * width + x of that pixel; -1 if there is none.  Ties are resolved in the same
 * way every time. */
CeldStatus celd_nearest (int width, int height, const uint8_t *inside, const CeldHost *host, int32_t *squared,
                         int32_t *nearest);
/* signed-distance.c: for paper the squared distance to the nearest ink, for ink minus that to the nearest paper, as
 * celd_is_paper tells them apart; INT32_MAX and -INT32_MAX where there is none.  A tight plane of the size of the
 * ink. */
CeldStatus celd_signed_distance (const CeldPlane *ink, const CeldHost *host, int32_t *squared);

/* ------------------------------------------------------------------ extension.c: smooth extension of values */

/* Extends the values of pixels with known[i] != 0 over all others; `lanes` numbers a pixel, at most 4.  Tight planes;
 * if nothing is known, all becomes 0. */
CeldStatus celd_extend (int width, int height, int lanes, uint8_t *known, float *value);

/* ------------------------------------------------------------------ flat-pictures.c */

/* Whether a picture has the lines of a drawing, its ink or its brightness: whether it is darker there than on both
 * sides, by a tenth of a range from `least` on. */
CeldStatus celd_find_lines (const CeldPlane *plane, float least, float range, const CeldPlane *drawing, bool *have);

/* ------------------------------------------------------------------ morphology.c: with square windows */

/* How many bytes of work space the functions below need for this radius, and for smaller ones. */
size_t celd_erosion_work (int width, int radius);

/* Replaces each value by the least (dilation: largest) of those in the picture at most `radius` away in x and in y.
 * Masks are tight planes. */
void celd_erode_bytes  (CeldMask *mask, int radius, void *work);
void celd_dilate_bytes (CeldMask *mask, int radius, void *work);
/* Dilation and then erosion; `closed` must not alias `mask`. */
void celd_close_bytes  (const CeldMask *mask, int radius, void *work, CeldMask *closed);
void celd_invert_bytes (CeldMask *mask);

/* ------------------------------------------------------------------ borders between pixels */

/* Headings: 0 to the right, 1 down, 2 to the left, 3 up.  From a corner of pixels, (x,y) being the upper left corner of
 * pixel (x,y), to the next one; and from it to the pixels that lie ahead on the left and on the right. */
static const int celd_step_x[4] = { 1, 0, -1, 0 }, celd_step_y[4] = { 0, 1, 0, -1 };
static const int celd_left_x[4] = { 0, 0, -1, -1 }, celd_left_y[4] = { -1, 0, 0, -1 };
static const int celd_right_x[4] = { 0, -1, -1, 0 }, celd_right_y[4] = { 0, 0, -1, -1 };

/* ------------------------------------------------------------------ components.c: connected components */

typedef struct
{
  uint32_t label;                    /* of its pixels in the input */
  int      x, y;                     /* its first pixel in reading order */
  int      left, top, right, bottom; /* inclusive */
  size_t   area;
} CeldComponent;

/* Finds the 4-connected (with `diagonal` 8-connected) components of equal labels.  Pixels of label `none` get component
 * 0, others 1 .. n in reading order of the component's first pixel; with UINT32_MAX, which no region has, all pixels of
 * regions get one.  *list has n items, item k-1 for component k; the caller frees it with celd_free.  `components` may
 * alias `labels`. */
CeldStatus celd_components (const CeldLabels *labels, uint32_t none, bool diagonal, const CeldHost *host,
                            CeldLabels *components, CeldComponent **list, size_t *n);

/* ------------------------------------------------------------------ affinity.c: edge weights of eq. (1) */

/* The weights w_pq = exp (-(I_p - I_q)^2 / sigma) of eq. (1), at least `floor`, for celd_lap_setup: tight planes of the
 * size of the ink, 0 where the picture ends.  I_p - I_q is here the contrast within 3 x 3 pixels around p or q,
 * whichever is less.  sigma is `contrast` times *mean, the mean of the squared differences of neighbouring pixels. */
CeldStatus celd_affinities (const CeldPlane *ink, float contrast, float floor, const CeldHost *host,
                            float *east, float *south, double *mean);

/* ------------------------------------------------------------------ seed-rows.c */

typedef struct { int x, end; uint32_t label; } CeldSeedRun;               /* pixels x .. end - 1; label > 0 */
typedef struct { CeldSeedRun *run; size_t n, run_capacity; } CeldSeedRow; /* sorted; touching runs differ in label */
typedef struct { int width, height; CeldSeedRow *row; } CeldSeedRows;

CeldStatus celd_seed_rows_new (int width, int height, CeldSeedRows *seeds);      /* without seeds */
void       celd_seed_rows_clear (CeldSeedRows *seeds);                           /* accepts a zeroed record */

CeldStatus celd_seed_rows_read (const CeldLabels *labels, CeldSeedRows *seeds);  /* makes the record */
CeldStatus celd_seed_rows_copy (const CeldSeedRows *from, CeldSeedRows *seeds);  /* makes the record */
void       celd_seed_rows_write (const CeldSeedRows *seeds, CeldLabels *labels); /* of equal size; 0 elsewhere */

/* Gives the pixels x .. end - 1 of row y, as far as they are in the picture, a label; label 0 erases. */
CeldStatus celd_seed_rows_paint (CeldSeedRows *seeds, int y, int x, int end, uint32_t label);

/* The label of a pixel in the picture; 0 if it is no seed. */
uint32_t celd_seed_rows_at (const CeldSeedRows *seeds, int x, int y);

/* ------------------------------------------------------------------ blur.c: wide Gaussians on a grid of cells */

typedef struct
{
  int picture_width, picture_height;
  int side;                        /* of a cell in pixels, a power of two; cells at the right and bottom may be cut */
  int width, height;               /* in cells */
} CeldBlurGrid;

/* Weights of the cells at the offsets first .. first + n - 1; they add up to 1. */
typedef struct { int first, n; float *weight; } CeldKernel;

/* Linear interpolation of a column (or row) of pixels between cells: (1 - share) of `one` plus share of `other`. */
typedef struct { int one, other; float share; } CeldBetween;

/* The grid for a Gaussian of this standard deviation in pixels, > 0. */
CeldBlurGrid celd_cells (int width, int height, double deviation);

/* A Gaussian centred `shift` pixels to the right (or below); `weight` is freed by the caller with celd_free. */
CeldStatus celd_kernel_new (const CeldBlurGrid *cells, double deviation, double shift, CeldKernel *kernel);

/* How each column, or row, of the picture is interpolated; freed by the caller with celd_free; NULL: no memory. */
CeldBetween *celd_between_columns (const CeldBlurGrid *cells);
CeldBetween *celd_between_rows    (const CeldBlurGrid *cells);

/* Blurs width x height values in place, with one kernel along rows and one along columns, mirrored at the edges;
 * `scratch` has room for as many. */
void celd_blur (const CeldKernel *along, const CeldKernel *down, int width, int height, float *value, float *scratch);

#endif
