/* What the files that read painted arrows share.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_ARROWS_H
#define CELD_ARROWS_H

#include "trail.h"

/* Opacity of a layer's pixels: its alpha, or the contrast to the commonest colour of a layer without. */
typedef struct
{
  const CeldPaint *paint;
  bool             opaque;
  uint8_t          paper[3];
} CeldArrowLayer;

int celd_arrow_opacity (const CeldArrowLayer *layer, int x, int y); /* 0 .. 255 */

/* arrow-slope.c: the opaque or the thick end of a stroke is the tail, the other one the tip; false if it is not clear.
 * `style` is CELD_ARROW_FADE or CELD_ARROW_TAPER. */
bool celd_arrow_slope (CeldTrail *trail, const CeldArrowLayer *layer, CeldArrowStyle style, CeldEnds *ends);

/* Where two strokes cross: arms 0 and 2 are one of them, 1 and 3 the other, on a circle round the crossing. */
typedef struct { CeldPoint centre, arm[4]; double radius, breadth[4]; } CeldCrossing;

/* A component cut out of its picture, with a border of one pixel that is not painted. */
typedef struct { int left, top, width, height; uint8_t *painted; int32_t *squared; } CeldCutting;

/* crossings.c: the crossings of a component; *list is the caller's to free.  squared: from celd_distance. */
CeldStatus celd_crossings_find (const CeldCutting *cutting, CeldCrossing **list, size_t *n);

/* Strand k of a component are the pixels from first[k] to first[k + 1], as in a trail. */
typedef struct { uint32_t *pixel; size_t *first, n; } CeldStrands;

/* strands.c: takes a component apart where strokes cross; n = 0 if none do. */
CeldStatus celd_strands_find (const CeldTrail *trail, CeldStrands *strands);
void       celd_strands_clear (CeldStrands *strands);

#endif
