/* The steps from a drawing to its ink, shared by the files that find ink and lines.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_INK_STEPS_H
#define CELD_INK_STEPS_H

#include "image/image.h"

#define CELD_RUN   256 /* pixels of a row that are looked at together; chosen */
#define CELD_PIECE 32  /* pixels that are passed over together where there are no lines, as in most places; chosen */

/* How many pixels the piece of a row from x on has. */
static inline int
celd_piece_at (int x, int width)
{
  return width - x < CELD_PIECE ? width - x : CELD_PIECE;
}

/* ------------------------------------------------------------------ paper */

/* paper.c: whether a drawing is lines on a transparent layer. */
bool celd_is_line_layer (const CeldDrawing *drawing);

/* paper-levels.c: replaces each value by its contrast against that paper, 1 - value / paper or 0 where it is lighter.
 * After a failure the values are as they were. */
CeldStatus celd_paper_contrast (CeldPlane *value);

/* ------------------------------------------------------------------ ink-noise.c */

#define CELD_INK_BINS  256 /* of a histogram of values in [0,1]; chosen */
#define CELD_INK_BANKS 4   /* histograms filled in turn, so that an addition need not wait for the one before; chosen */

/* `contrast` planes hold the contrast of each pixel against the paper, 0 .. 1. */

/* How many rows lie between those by which noise and echo are measured, the first of which is row rows_apart / 2; 1 in
 * a small picture. */
int celd_ink_rows_apart (int width, int height);

/* The standard deviation of the paper's grain at the scale of `step` pixels, from the median second difference along
 * rows where there is no ink. */
float celd_ink_noise (const CeldPlane *contrast, int step);

/* The strength of compression artefacts: the ripple that one of ten paper pixels near dark ink exceeds; 0 in a clean
 * picture, or if there are too few such pixels.  `around` holds the largest contrast near each pixel, 0 .. 255, `dark`
 * the contrast of dark strokes. */
float celd_ink_echo (const CeldPlane *contrast, const CeldMask *around, float dark);

/* One pass of the binomial filter (1 2 1)/4 in both directions, in place; `spare`, of the same size, is overwritten. */
void celd_ink_smooth (CeldPlane *plane, CeldPlane *spare);

/* ------------------------------------------------------------------ ink-levels.c */

/* Whether a grey pixel of a clean drawing shows how dark its stroke is: inside a grey stroke, or on a line thinner than
 * a pixel.  `dark` is the contrast of dark strokes. */
bool celd_ink_shows_level (const CeldPlane *contrast, int x, int y, float dark);

/* ------------------------------------------------------------------ ink-lines.c */

/* Where there is a line or an edge in `contrast`, replaces the values of `smooth`, which has the same size and holds it
 * after two passes of celd_ink_smooth, by means along the line.  `noise` is the standard deviation of the grain.
 * CELD_NO_MEMORY is the only failure; then `smooth` is as it was. */
CeldStatus celd_ink_smooth_lines (const CeldPlane *contrast, float noise, CeldPlane *smooth);

/* ------------------------------------------------------------------ ink-bands.c */

/* Makes paper of long bands of grey ink that are lighter than the lines on both sides.  `between`, a tight mask of the
 * same size, is overwritten.  CELD_NO_MEMORY is the only failure; then `ink` is as it was. */
CeldStatus celd_ink_part_lines (CeldPlane *ink, CeldMask *between);

/* ------------------------------------------------------------------ ink-grain.c */

/* Fills small holes in the ink of a noisy drawing.  `known`, a tight mask of the same size, is overwritten. */
void celd_ink_fill_grain (CeldPlane *ink, CeldMask *known);

/* ------------------------------------------------------------------ ink-hairlines.c */

/* Joins the ink of the two pixels across an antialiased line of one pixel in the darker one, where both are paper. */
void celd_ink_join_hairlines (CeldPlane *ink);

#endif
