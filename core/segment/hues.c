/* Colours of labels that have no scribble: opaque, and far from those of all other labels.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "segment/canvas.h"
#include "segment/seeds.h"

#include <stdlib.h>

#define HUES   360                   /* colours to choose from */
#define FIRST  ((uint32_t) 1417339208)  /* hues are shares of 2^32, round the circle: 0.33 */
#define GOLDEN ((uint32_t) 2654435769)  /* from one to the next: the golden section */
#define THIRD  ((uint32_t) 1431655765)
#define FAR    150                   /* distance that is aimed at, a sum over three channels of 0 .. 255 */

static void
from_hue (uint32_t hue, double saturation, double value, uint8_t colour[4])
{
  for (uint32_t i = 0; i < 3; i++)
    {
      double t = (hue - i * THIRD) * (6 / 4294967296.0); /* 0 at this channel's own hue */
      double distance = t < 3 ? t : 6 - t;               /* 0 .. 3 */
      double share = distance < 1 ? 1 : distance < 2 ? 2 - distance : 0;

      colour[i] = (uint8_t) (255 * value * (1 - saturation + saturation * share) + 0.5);
    }
  colour[3] = 255;
}

static int
colour_distance (const uint8_t a[4], const uint8_t b[4])
{
  return abs (a[0] - b[0]) + abs (a[1] - b[1]) + abs (a[2] - b[2]);
}

/* The first of a fixed row of colours that is far from all labels; the farther, the fewer labels there are. */
static void
new_colour (const CeldPalette *palette, uint8_t colour[4])
{
  for (int least = FAR; ; least = least * 2 / 3)
    for (uint32_t i = 0; i < HUES; i++)
      {
        bool far = true;

        from_hue (FIRST + i * GOLDEN, i % 3 == 1 ? 0.55 : 0.8, i % 3 == 2 ? 0.65 : 0.95, colour);
        for (size_t k = 0; k < palette->n && far; k++)
          far = !palette->item[k].colour[3] || colour_distance (palette->item[k].colour, colour) >= least;
        if (far)
          return;
      }
}

CeldStatus
celd_hue_add (CeldCanvas *canvas, uint32_t *label)
{
  CeldRegion region = { .origin = CELD_FROM_ARROW, .hard = true };

  new_colour (&canvas->palette, region.colour);
  return celd_canvas_add (canvas, region, label);
}
