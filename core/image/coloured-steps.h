/* The steps from a coloured drawing to its lines, shared by the files that find these.  All masks of a call have one
 * size.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_COLOURED_STEPS_H
#define CELD_COLOURED_STEPS_H

#include "image/ink-steps.h"

#define CELD_DARKEST_FILL 64  /* of 255: contrast against anything darker is against this; chosen */
#define CELD_MIDDLE_FILL  128 /* of 255: of a fill that is lighter than lines, which grain hides more; chosen */

/* ------------------------------------------------------------------ coloured.c, grey-fills.c: is it coloured? */

/* Whether red, green and blue of an opaque drawing have fills of several hues. */
bool celd_is_coloured (const CeldMask channel[3]);

/* Whether they have flat fills in greys or pale colours, beside paper and what is darkest and lightest. */
bool celd_has_grey_fills (const CeldMask channel[3]);

/* ------------------------------------------------------------------ sprite-lines.c */

/* If a picture is pixel art in a few exact colours, with lines, sets `lines` to 255 at them and to 0 elsewhere; returns
 * whether it is.  With `only_coloured` it has fills with hues as well.  `work` is for radius 2, `spare` is overwritten,
 * and so is `lines`. */
bool celd_sprite_lines (const CeldMask channel[3], bool only_coloured, void *work, CeldMask *spare, CeldMask *lines);

/* ------------------------------------------------------------------ line-width.c */

/* The radius of the window by which the lines of a drawing are found, in the closing of its channels.  If lines are
 * lighter than fills, inverts the channels.  Sets `lightness` to that of the channels, inverted as well.  `broadest`
 * limits the radius; `work` is for twice that, `closed` and `clear` are overwritten. */
CeldStatus celd_line_window (CeldMask channel[3], int broadest, const CeldHost *host, void *work, CeldMask *closed,
                             CeldMask *clear, CeldMask *lightness, int *radius);

/* ------------------------------------------------------------------ line-contrast.c */

/* Whether one of n bytes is as large as this. */
bool celd_any_byte_reaches (const uint8_t *value, size_t n, int least);

/* Raises contrasts, 0 .. 255, to those of values against their closing, as far as it is larger. */
void celd_raise_contrast (const uint8_t *value, const uint8_t *closed, size_t n, uint8_t *contrast);

/* Replaces the contrast of the core of the line at each pixel by the strength of the line there, 0 .. 255.  Where there
 * is no core (0), pale contrast is what narrow fills leave along their ends, not a pale line. */
void celd_line_strengths (const uint8_t *contrast, int faintest, size_t n, uint8_t *level);

/* ------------------------------------------------------------------ line-tones.c */

#define CELD_LINE_TONES 16 /* per channel; chosen */

typedef struct
{
  uint32_t count[CELD_LINE_TONES * CELD_LINE_TONES * CELD_LINE_TONES]; /* of cores, by red, green and blue */
  uint32_t cores;
} CeldLineTones;

/* Counts the pixel with this index, which is the core of a line.  All counts are 0 at first. */
void celd_line_tone_count (CeldLineTones *tones, const CeldMask channel[3], size_t pixel);

/* Sets `tone` to the colour that most cores have; returns whether there is one. */
bool celd_main_line_tone (const CeldLineTones *tones, uint8_t tone[3]);

/* The distance of n pixels from a tone: the largest of the channels', less that of colours of one tone. */
void celd_tone_distance (const CeldMask channel[3], const uint8_t tone[3], size_t n, uint8_t *distance);

/* Adds to each count those of the 26 colours around; whether enough cores then have the colour of a pixel. */
void celd_line_tones_blur (CeldLineTones *tones);
bool celd_is_line_tone (const CeldLineTones *tones, const CeldMask channel[3], size_t pixel);

/* ------------------------------------------------------------------ narrow-fills.c */

/* Sets `contrast` to 0 where a fill is narrow between lines: lighter than its opening by `radius`, by a contrast of
 * `faintest` at least.  `lightness`, `light` and `fill` are overwritten; `work` is for this radius. */
void celd_clear_narrow_fills (CeldMask *lightness, int radius, int faintest, void *work, CeldMask *light, CeldMask *fill,
                              CeldMask *contrast);

/* ------------------------------------------------------------------ thick-lines.c */

/* Sets `thick` to 1 where some channel, or the distance from the colour of lines (NULL: they have several), has at
 * least half of the contrast of black against its closing by `radius`, and no channel is lighter than its opening, by a
 * contrast of `faintest`, 1 .. 254; else to 0.  `work` is for this radius, `spare` is overwritten. */
CeldStatus celd_thick_lines (const CeldMask channel[3], const CeldMask *distance, int radius, int faintest,
                             const CeldHost *host, void *work, CeldMask *spare, CeldMask *thick);

/* ------------------------------------------------------------------ solid-areas.c */

/* Of `thick`, which is 1 in thick strokes and else 0, sets what has not the tone of lines to 0, and what hangs on areas
 * in its colour that are no lines.  `strength` is that of thin lines. */
void celd_leave_solid_areas (const CeldMask channel[3], const CeldLineTones *tones, const CeldMask *strength,
                             CeldMask *thick);

/* ------------------------------------------------------------------ fill-edges.c */

/* Sets `luma`, which has the lines, to 0 along edges between fills that meet without a line.  `strength` is 0 where
 * there is no line, `faintest` is the least contrast of one; `step` is overwritten. */
void celd_draw_fill_edges (const CeldMask channel[3], const CeldMask *strength, int faintest, CeldMask *step,
                           CeldPlane *luma);

#endif
