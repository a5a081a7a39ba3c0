/* Colours of labels that have no scribble: opaque, and far from those of all other labels.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "seeds.h"

#include <math.h>
#include <stdlib.h>

#define HUES     360  /* colours to choose from, in the order of the golden angle */
#define FAR      150  /* distance that is aimed at, a sum over three channels of 0 .. 255 */
#define FARTHEST 765

static void
from_hue (double hue, double saturation, double value, uint8_t colour[4])
{
  for (int i = 0; i < 3; i++)
    {
      double t = fmod (hue + (3 - i) / 3.0, 1) * 6; /* 0 at this channel's own hue */
      double distance = fmin (t, 6 - t);            /* 0 .. 3 */
      double share = fmax (0, fmin (1, 2 - distance));

      colour[i] = (uint8_t) lround (255 * value * (1 - saturation + saturation * share));
    }
  colour[3] = 255;
}

/* The colour number i of the fixed row. */
static void
colour_of (int i, uint8_t colour[4])
{
  from_hue (fmod (0.33 + i * 0.6180339887, 1), i % 3 == 1 ? 0.55 : 0.8, i % 3 == 2 ? 0.65 : 0.95, colour);
}

static int
colour_distance (const uint8_t a[4], const uint8_t b[4])
{
  return abs (a[0] - b[0]) + abs (a[1] - b[1]) + abs (a[2] - b[2]);
}

/* How far a colour is from the nearest label. */
static int
distance_to_labels (const CeldPalette *palette, const uint8_t colour[4])
{
  int least = FARTHEST;

  for (size_t k = 0; k < palette->n; k++)
    {
      int distance = palette->item[k].colour[3] ? colour_distance (palette->item[k].colour, colour) : FARTHEST;

      least = distance < least ? distance : least;
    }
  return least;
}

/* The first of the row that is far from all labels; the farther, the fewer labels there are. */
static void
new_colour (const CeldPalette *palette, uint8_t colour[4])
{
  int distance[HUES], n = 0;

  for (int least = FAR; ; least = least * 2 / 3)
    for (int i = 0; i < HUES; i++)
      {
        if (i == n)
          {
            colour_of (i, colour);
            distance[n++] = distance_to_labels (palette, colour);
          }
        if (distance[i] >= least)
          {
            colour_of (i, colour);
            return;
          }
      }
}

CeldStatus
celd_hue_add (CeldCanvas *canvas, uint32_t *label)
{
  CeldRegion region = { .origin = CELD_FROM_ARROW, .hard = true };

  new_colour (&canvas->palette, region.colour);
  return celd_canvas_add (canvas, region, label);
}
