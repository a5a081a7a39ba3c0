/* Sheets: the whole silhouette of each region, visible and hidden.  What lies behind something is answered here, once,
 * for light, layers, stereo and models.
 *
 *   hiding.c           which regions may hide which, and the order of the sheets
 *   sheet-outline.c    traces the outline of what is visible of a region, and where it vanishes under others
 *   hidden-strokes.c   where the artist says what is hidden
 *   sheet-diffusion.c  how likely each hidden place is inside: diffusion, guided by these ends of the outline
 *   sheet-pixels.c     hidden pixels with their coverage
 *   sheets.c           the step, and updates
 *   sheet-problems.c   sheets whose hidden part is hardly more than a guess
 *   sheet-coverage.c   coverage by a whole sheet
 *   level-sheets.c     sheets of a picture of levels
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_SHEETS_H
#define CELD_SHEETS_H

#include "order/order.h"
#include "ownership/ownership.h"

/* Hidden pixels x .. x + n - 1 of row y; their values are from index `first` on. */
typedef struct { int x, y, n; size_t first; } CeldSheetRun;

/* Appends a pixel, whose value has the index `value`, to runs in reading order. */
static inline CeldStatus
celd_sheet_run_add (CeldSheetRun **run, size_t *n, size_t *capacity, int x, int y, size_t value)
{
  CeldSheetRun *last = *n ? &(*run)[*n - 1] : NULL;

  if (!last || last->y != y || last->x + last->n != x)
    return celd_append (*run, *n, *capacity, (CeldSheetRun) { x, y, 1, value });
  last->n++;
  return CELD_OK;
}

/* A sheet is visible where CeldOwnership has its label as owner, or as `under` with an owner that does not cover the
 * pixel. */
typedef struct
{
  uint32_t      label, level;
  bool          page;           /* the background: the sheet covers the picture, and has no runs */
  double        pen;            /* width in pixels of the line along its visible outline; 0: none */
  CeldRect      seen, box;      /* bounding boxes of what is visible of it, and of the sheet with its margin */
  CeldSheetRun *run;            /* its hidden pixels, in reading order; nearer sheets alone cover them */
  size_t        n_runs, n_hidden;
  uint8_t      *coverage;       /* of each hidden pixel by the sheet, in 1/255; 0: the pixel is in the margin, which is
                                 * not part of the silhouette, but what a view shows rather than a crack */
  uint8_t      *confidence;     /* of each hidden pixel's coverage, in 1/255 */
} CeldSheet;

/* The likelihood that a place is inside the sheet, on square cells of a window.  What is visible of the region is 1,
 * what is behind it is 0. */
typedef struct
{
  CeldRect window;              /* in pixels */
  int      cell, across, down;  /* pixels a side of a cell; numbers of cells */
  float   *inside;              /* of each cell */
  int32_t *distance;            /* of each cell that may be hidden, squared, in cells, to the visible part; -1 for all
                                 * others */
  double   pen;                 /* see CeldSheet */
} CeldDiffusion;

/* That one sheet goes on under another, and how large that part would be in pixels. */
typedef struct { uint32_t nearer, farther; double area; } CeldHidden;

/* What an update needs of each label. */
typedef struct
{
  CeldRect      seen;            /* bounding box; width 0: the label has no pixel */
  CeldRect      painted;         /* bounding box of the artist's strokes for it; width 0: none */
  uint64_t      standing, front; /* hashes of how others stand to it, and of which sheets are in front of it */
  CeldDiffusion diffusion;
  CeldHidden   *wish;            /* under which labels it would go on */
  size_t        n_wishes;
  CeldSheet     sheet;           /* while it is made */
  CeldStatus    status;
  bool          kept, kept_pixels; /* are the diffusion and the wishes, and the pixels, those of what is updated? */
} CeldSheetShape;

struct CeldSheets
{
  int        width, height;
  CeldSheet *item;              /* from back to front: each hides what is before it, consistent with all relations;
                                 * levels need not rise, since not all regions are related */
  size_t     n;
  uint32_t  *of_label;          /* index of label l's sheet, or CELD_NO_SHEET: of_label[l - 1] */
  size_t     n_labels;
  float      margin;
  CeldSheetShape *shape;        /* of each label, for updates; NULL: not kept */
};

#define CELD_NO_SHEET UINT32_MAX

/* ------------------------------------------------------------------ sheets.c */

/* Replaces *sheets (NULL: none yet), which an earlier update made, by those of a new state, of which the ownership
 * and the hints differ only within `changed`, and the ink not at all. */
CeldStatus celd_sheets_update (const CeldPlane *ink, const CeldOwnership *own, const CeldLabels *hints,
                               CeldRect changed, const CeldOrder *order, uint32_t background,
                               const CeldSettings *settings, const CeldHost *host, CeldSheets **sheets);

/* ------------------------------------------------------------------ sheet-problems.c */

/* Appends CELD_PROBLEM_HIDDEN_UNSURE for each sheet of which that can be said, from back to front. */
CeldStatus celd_sheet_problems (const CeldSheets *sheets, CeldProblems *problems);

/* ------------------------------------------------------------------ sheet-coverage.c */

/* The coverage of each pixel of the box by the sheet, [0,1], as a plane without padding.  A pixel that the sheet shares
 * with a nearer one is covered wholly. */
void celd_sheet_coverage (const CeldSheets *sheets, const CeldOwnership *own, size_t k, CeldRect box, float *coverage);

/* ------------------------------------------------------------------ level-sheets.c */

/* The farthest label if it covers more of the frame than any other; else 0. */
CeldStatus celd_level_background (const CeldLevelOwnership *made, uint32_t *background);

/* The sheets of a picture of levels.  The background is the farthest label, if it covers more of the frame than any
 * other. */
CeldStatus celd_level_sheets (const CeldLevelOwnership *made, const CeldPlane *ink, const CeldSettings *settings,
                              const CeldHost *host, CeldSheets **sheets);

/* ------------------------------------------------------------------ hiding.c */

/* How another region stands to a region. */
typedef enum { CELD_HIDING, CELD_LEVEL, CELD_BEHIND } CeldStanding;

/* The relations of an order as a graph of labels. */
typedef struct { const CeldOrder *order; CeldGraph graph; CeldArcIndex down; } CeldHiding;

CeldStatus celd_hiding_new (const CeldOrder *order, CeldHiding *hiding);
void       celd_hiding_clear (CeldHiding *hiding);            /* accepts a partly built record */

/* Writes the CeldStanding of label l at standing[l - 1]: behind `label` if that follows from the relations, level with
 * it if they say so, and otherwise it may hide it.  `queue` is work space for all labels. */
void celd_hiding_of (const CeldHiding *hiding, uint32_t label, uint8_t *standing, uint32_t *queue);

/* Ranks all labels from back to front, rank[l - 1] from 0, consistent with the relations; labels that are level share
 * the rank of the first of them, and as many ranks after it as they are more are not used.  Of the wishes, which are
 * sorted, the largest are fulfilled first. */
CeldStatus celd_hiding_rank (const CeldHiding *hiding, CeldHidden *wish, size_t n, uint32_t *rank);

/* ------------------------------------------------------------------ sheet-outline.c */

/* A region, and how the others stand to it. */
typedef struct
{
  const CeldPlane     *ink;
  const CeldOwnership *own;
  const CeldLabels    *hints;    /* see celd_sheets */
  uint32_t             label;
  CeldRect             seen, painted; /* as in CeldSheetShape */
  const uint8_t       *standing; /* of label l: standing[l - 1] */
} CeldSheetView;

/* Where the outline of what is visible of a region vanishes: the place, the direction and the curvature (turn in
 * radians a pixel, clockwise as seen) with which it goes on, and the distance to the place where it reappears. */
typedef struct { double x, y, direction, curvature, gap; } CeldOutlineEnd;

typedef struct { CeldOutlineEnd *item; size_t n, capacity; } CeldOutlineEnds;


/* Also measures the width of the line along the outline, as CeldSheet.pen. */
CeldStatus celd_outline_ends_find (const CeldSheetView *view, CeldOutlineEnds *ends, double *pen);

/* ------------------------------------------------------------------ hidden-strokes.c */

/* Sets the boxes of the strokes of labels 1 .. n.  CELD_BAD_VALUE for labels beyond n. */
CeldStatus celd_hidden_strokes_find (const CeldLabels *hints, size_t n, CeldSheetShape *shape);

/* A window with the strokes for its region, and some room around them. */
CeldRect   celd_hidden_strokes_window (const CeldSheetView *view, CeldRect window);

/* What the artist says of a cell: the region's label if any stroke of it touches the cell, else CELD_HIDDEN_ERASE if an
 * eraser does, else 0.  A stroke thinner than a cell is not lost so. */
uint32_t   celd_hidden_stroke_at (const CeldSheetView *view, const CeldDiffusion *diffusion, int x, int y);

/* ------------------------------------------------------------------ sheet-diffusion.c */

CeldStatus celd_diffusion_new (const CeldSheetView *view, const CeldHost *host, CeldDiffusion *diffusion);
void       celd_diffusion_clear (CeldDiffusion *diffusion);   /* accepts a zeroed record */

/* ------------------------------------------------------------------ sheet-pixels.c */

/* Lists the hidden pixels of a sheet, under sheets of higher rank, with a margin in pixels. */
CeldStatus celd_sheet_pixels (const CeldSheetView *view, const CeldDiffusion *diffusion, const uint32_t *rank,
                              double margin, CeldSheet *sheet);

#endif
