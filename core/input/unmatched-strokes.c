/* Strokes of corrections, or of what is hidden, none of which has the colour of a region: they change nothing.
 *
 * That is a layer in wrong colours, stored with loss, or another picture.  Paint is what is opaque; in a layer without
 * transparency, where its first pixel is paper, what differs from that.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/input.h"

#include <string.h>

#define MATCHED_SHARE 100 /* 1 / this of the paint has a region's colour, at least, or it is there by chance; chosen */

static bool
is_paint (const uint8_t *pixel, const uint8_t *first)
{
  return pixel[3] >= 128 && (first[3] < 128 || memcmp (pixel, first, 3));
}

CeldStatus
celd_unmatched_strokes_find (const CeldPaint *layer, const CeldLabels *read, CeldProblems *problems)
{
  size_t painted = 0, matched = 0;
  int    left = 0, top = 0;

  for (int y = 0; y < layer->height; y++)
    for (int x = 0; x < layer->width; x++)
      if (is_paint (CELD_RGBA (layer, x, y), layer->data))
        {
          left = painted ? left : x;
          top  = painted ? top : y;
          painted++;
          matched += CELD_AT (read, x, y) != 0;
        }
  if (!painted || MATCHED_SHARE * matched >= painted)
    return CELD_OK;
  return celd_problem_add (problems, (CeldProblem) {
    .kind = CELD_PROBLEM_STROKE_UNMATCHED, .x = left, .y = top, .relation = CELD_NO_INDEX });
}
