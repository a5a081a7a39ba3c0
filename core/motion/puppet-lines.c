/* Lines of a puppet below nearer layers.
 *
 * A line of one layer that runs into a line of a nearer layer goes on below it a little, so that no paper shows between
 * the two when these move slightly apart.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/puppet.h"

#define INNER_INK  0.25f /* what is darker is the inside of a line; chosen */
#define LEAST_LINE 0.25  /* of a square as wide as a line that a layer's own line fills where it goes on: half of what
                         * it fills where it ends, so that lines do not spread sideways */

/* Ink of a layer; ink of a nearer layer where this one may go on; where it does. */
enum { OWN_LINE = 1, LINE_ABOVE, GOES_ON };

static bool
is_opaque (const CeldPuppet *puppet, uint32_t layer, int x, int y)
{
  const CeldPuppetLayer *one = &puppet->layer[layer];

  return one->rgba[4 * celd_puppet_pixel (one, x, y) + 3] >= 1;
}

/* Marks the ink of a layer and that of nearer layers over it. */
static void
mark_lines (const CeldPuppet *puppet, uint32_t k, const CeldPlane *ink, uint8_t *mark)
{
  const CeldPuppetLayer *layer = &puppet->layer[k];
  CeldRect               box = layer->box;

  memset (mark, 0, celd_puppet_stride (layer) * ((size_t) box.height + 2 * CELD_PUPPET_PAD));
  for (int y = box.y; y < box.y + box.height; y++)
    for (int x = box.x; x < box.x + box.width; x++)
      {
        size_t   p = celd_puppet_pixel (layer, x, y);
        uint32_t front = puppet->front[(size_t) y * (size_t) puppet->width + (size_t) x];

        if (front == k && CELD_AT (ink, x, y) < INNER_INK)
          mark[p] = OWN_LINE;
        else if (front > k && !celd_is_paper (CELD_AT (ink, x, y)) && layer->rgba[4 * p + 3] > 0 &&
                 is_opaque (puppet, front, x, y))
          mark[p] = LINE_ABOVE;
      }
}

/* Whether the layer's own line fills enough of the square around pixel p. */
static bool
goes_on (const CeldPuppetLayer *layer, const uint8_t *mark, size_t p, int line)
{
  int stride = (int) celd_puppet_stride (layer), height = layer->box.height + 2 * CELD_PUPPET_PAD;
  int x = (int) p % stride, y = (int) p / stride, own = 0;

  for (int v = y - line / 2 < 0 ? 0 : y - line / 2; v <= y + line / 2 && v < height; v++)
    for (int u = x - line / 2 < 0 ? 0 : x - line / 2; u <= x + line / 2 && u < stride; u++)
      own += mark[(size_t) v * (size_t) stride + (size_t) u] == OWN_LINE;
  return own > LEAST_LINE * (line / 2 * 2 + 1) * (line / 2 * 2 + 1);
}

static CeldStatus
continue_layer (const CeldPuppetLayer *layer, int line, uint8_t *mark)
{
  size_t     stride = celd_puppet_stride (layer), pixels = stride * ((size_t) layer->box.height + 2 * CELD_PUPPET_PAD);
  size_t    *edge = NULL, n = 0, capacity = 0;
  CeldStatus status = CELD_OK;

  for (size_t p = 0; p < pixels && status == CELD_OK; p++)
    if (mark[p] == OWN_LINE && (mark[p - 1] == LINE_ABOVE || mark[p + 1] == LINE_ABOVE ||
                                mark[p - stride] == LINE_ABOVE || mark[p + stride] == LINE_ABOVE))
      status = celd_append (edge, n, capacity, p);
  for (size_t i = 0; i < 4 * n && status == CELD_OK; i++)
    {
      size_t p = edge[i / 4], beside = i % 4 == 0 ? p - 1 : i % 4 == 1 ? p + 1 : i % 4 == 2 ? p - stride : p + stride;

      if (mark[beside] == LINE_ABOVE && goes_on (layer, mark, beside, line))
        {
          mark[beside] = GOES_ON;
          memcpy (layer->rgba + 4 * beside, layer->rgba + 4 * p, 4 * sizeof *layer->rgba);
          status = celd_append (edge, n, capacity, beside);
        }
    }
  celd_free (edge);
  return status;
}

CeldStatus
celd_puppet_continue_lines (CeldPuppet *puppet, const CeldPlane *ink)
{
  size_t     width = (size_t) puppet->width + (size_t) puppet->lattice.side + 2 * CELD_PUPPET_PAD;
  size_t     height = (size_t) puppet->height + (size_t) puppet->lattice.side + 2 * CELD_PUPPET_PAD;
  uint8_t   *mark = celd_alloc (width * height, 1);
  int        line = celd_stroke_width (ink);
  CeldStatus status = mark ? CELD_OK : CELD_NO_MEMORY;

  for (uint32_t k = 0; k < puppet->n && status == CELD_OK; k++)
    if (puppet->layer[k].cell)
      {
        mark_lines (puppet, k, ink, mark);
        status = continue_layer (&puppet->layer[k], line, mark);
      }
  celd_free (mark);
  return status;
}
