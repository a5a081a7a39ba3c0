/* Strokes of a layer with alpha that are too faint to be read, although they can be seen.
 *
 * A stroke is connected paint; only what an eraser leaves is fainter than what is looked for here.
 *
 * Cost: O(pixels), a pass over alpha if there is none.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "image/image.h"
#include "input/input.h"

#define LEAST_STROKE 30 /* pixels; smaller pieces are no strokes; chosen */
#define RIM_WIDTH    2  /* pixels from opaque paint to faint paint that belongs to its rim; chosen */

/* The strongest pixel of connected paint. */
typedef struct { int x, y, alpha; } StrongestPixel;

static int
alpha_at (const CeldPaint *layer, int x, int y)
{
  return x >= 0 && y >= 0 && x < layer->width && y < layer->height ? CELD_RGBA (layer, x, y)[3] : 0;
}

bool
celd_paint_is_faint (const CeldPaint *layer, int visible, int opaque, int x, int y)
{
  int alpha = alpha_at (layer, x, y);

  if (alpha < visible || alpha >= opaque)
    return false;
  for (int k = 1; k <= RIM_WIDTH; k++)
    if (alpha_at (layer, x - k, y) >= opaque || alpha_at (layer, x + k, y) >= opaque ||
        alpha_at (layer, x, y - k) >= opaque || alpha_at (layer, x, y + k) >= opaque)
      return false;
  return true;
}

static bool
has_faint_pixel (const CeldPaint *layer, int least)
{
  for (int y = 0; y < layer->height; y++)
    for (int x = 0; x < layer->width; x++)
      if (celd_paint_is_faint (layer, CELD_VISIBLE_ALPHA, least, x, y))
        return true;
  return false;
}

/* Fills in the strongest pixel of each component k, counted from 1. */
static void
find_strongest (const CeldPaint *layer, const CeldLabels *component, StrongestPixel *strongest)
{
  for (int y = 0; y < layer->height; y++)
    for (int x = 0; x < layer->width; x++)
      {
        StrongestPixel *of = &strongest[CELD_AT (component, x, y)];

        if (alpha_at (layer, x, y) > of->alpha)
          *of = (StrongestPixel) { x, y, alpha_at (layer, x, y) };
      }
}

CeldStatus
celd_faint_strokes_find (const CeldPaint *layer, int least, CeldProblems *problems)
{
  CeldLabels      component = { 0 };
  CeldComponent  *list = NULL;
  StrongestPixel *strongest = NULL;
  size_t          n = 0;
  CeldStatus      status;

  if (!has_faint_pixel (layer, least))
    return CELD_OK;
  status = celd_labels_new (layer->width, layer->height, &component);
  for (int y = 0; y < layer->height && status == CELD_OK; y++)
    for (int x = 0; x < layer->width; x++)
      CELD_AT (&component, x, y) = alpha_at (layer, x, y) >= CELD_CONNECTED_ALPHA;
  if (status == CELD_OK)
    status = celd_components (&component, 0, true, NULL, &component, &list, &n);
  if (status == CELD_OK && !(strongest = celd_alloc0 (n + 1, sizeof *strongest)))
    status = CELD_NO_MEMORY;
  if (status == CELD_OK)
    find_strongest (layer, &component, strongest);
  for (size_t k = 1; k <= n && status == CELD_OK; k++)
    if (list[k - 1].area >= LEAST_STROKE && strongest[k].alpha >= CELD_VISIBLE_ALPHA && strongest[k].alpha < least)
      status = celd_problem_add (problems, (CeldProblem) {
        .kind = CELD_PROBLEM_STROKE_FAINT, .x = strongest[k].x, .y = strongest[k].y, .relation = CELD_NO_INDEX });
  celd_free (strongest);
  celd_free (list);
  celd_free (component.data);
  return status;
}
