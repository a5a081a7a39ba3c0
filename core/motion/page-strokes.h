/* Strokes on the page that go with parts: page-strokes.c.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_PAGE_STROKES_H
#define CELD_PAGE_STROKES_H

#include "layers/layers.h"

typedef struct
{
  CeldLabels component;         /* of each pixel: its stroke, from 1; 0: none */
  size_t     n;
  uint32_t  *layer;             /* of each stroke: the layer that it goes with, + 1; 0: it stays */
  float     *colour, *paper;    /* r, g, b, a of each pixel of a stroke that goes, and of the paper below it */
} CeldPageStrokes;

/* Finds the strokes on the layer `page`.  `several`: also what hangs on several parts goes, with the one that it
 * touches most.  To be cleared by the caller; zeroed after errors. */
CeldStatus celd_page_strokes_find (const CeldLayers *layers, uint32_t page, const CeldPlane *ink, bool several,
                                   const CeldHost *host, CeldPageStrokes *strokes);
void       celd_page_strokes_clear (CeldPageStrokes *strokes);  /* accepts a zeroed record */

/* The layer that a pixel goes with, + 1; 0: none. */
static inline uint32_t
celd_page_strokes_at (const CeldPageStrokes *strokes, size_t pixel)
{
  uint32_t stroke = strokes->component.data ? strokes->component.data[pixel] : 0;

  return stroke ? strokes->layer[stroke - 1] : 0;
}

#endif
