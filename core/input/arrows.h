/* What the files that read painted arrows share.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_ARROWS_H
#define CELD_ARROWS_H

#include "input/trail.h"

#define CELD_PAPER_CONTRAST 32 /* least difference of paint from the paper's colour, in a layer without alpha */

/* Opacity of a layer's pixels: its alpha, or the contrast to the commonest colour of a layer without.  `other` is
 * looked at instead of `paint` where it lies, from (left,top) on; it may be empty. */
typedef struct
{
  const CeldPaint *paint;
  bool             opaque;
  uint8_t          paper[3];
  CeldPaint        other;
  int              left, top;
} CeldArrowLayer;

const uint8_t *celd_arrow_pixel (const CeldArrowLayer *layer, int x, int y);

int celd_arrow_opacity (const CeldArrowLayer *layer, int x, int y); /* 0 .. 255 */

/* arrow-slope.c: the opaque or the thick end of a stroke is the tail, the other one the tip; false if it is not clear.
 * `style` is CELD_ARROW_FADE or CELD_ARROW_TAPER. */
bool celd_arrow_slope (CeldTrail *trail, const CeldArrowLayer *layer, CeldArrowStyle style, CeldEnds *ends);

/* Where two strokes cross: arms 0 and 2 are one of them, 1 and 3 the other, on a circle round the crossing. */
typedef struct { CeldPoint centre, arm[4]; double radius, breadth[4]; } CeldCrossing;

/* A component cut out of its picture, with a border of one pixel that is not painted. */
typedef struct { int left, top, width, height; uint8_t *painted; int32_t *squared; } CeldCutting;

/* strands.c: the box round a component, and how deep in the paint each pixel lies. */
CeldStatus celd_cutting_new (const CeldTrail *trail, CeldCutting *cutting);
void       celd_cutting_clear (CeldCutting *cutting);

/* crossings.c: the crossings of a component; *list is the caller's to free.  squared: from celd_distance. */
CeldStatus celd_crossings_find (const CeldCutting *cutting, CeldCrossing **list, size_t *n);

/* Strand k of a component are the pixels from first[k] to first[k + 1], as in a trail. */
typedef struct { uint32_t *pixel; size_t *first, n; } CeldStrands;

/* strands.c: takes a component apart where strokes cross; n = 0 if none do. */
CeldStatus celd_strands_find (const CeldTrail *trail, CeldStrands *strands);
void       celd_strands_clear (CeldStrands *strands);

/* arrow-strokes.c: appends the arrows of a component, and its unclear strokes; problems may be NULL. */
CeldStatus celd_arrow_strokes_read (CeldTrail *trail, CeldArrowLayer *layer, CeldArrowStyle style,
                                    CeldRelations *relations, CeldProblems *problems);

#endif
