/* Similarities: where a placement takes the points of a drawing.
 *
 * Turns by multiples of 90 degrees are exact, and round a corner of pixels, so that they move whole pixels to whole
 * pixels.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/compose.h"

static void
turn_to (double degrees, double *cosine, double *sine)
{
  static const int exact[4][2] = { { 1, 0 }, { 0, 1 }, { -1, 0 }, { 0, -1 } };
  double           quarters = fmod (degrees, 360) / 90;

  *cosine = cos (quarters * CELD_PI / 2);
  *sine   = sin (quarters * CELD_PI / 2);
  if (quarters == rint (quarters))
    {
      int k = ((int) quarters + 4) % 4;

      *cosine = exact[k][0];
      *sine   = exact[k][1];
    }
}

static bool
is_near (double value)
{
  return fabs (value) <= CELD_FARTHEST_PLACE; /* chosen: rounding errors grow; false for NaN */
}

CeldStatus
celd_placement_read (const CeldPlacement *p, int width, int height, CeldSimilarity *there, CeldSimilarity *back)
{
  double cosine, sine, middle[2] = { width / 2, height / 2 }, k = p->flip ? -1 : 1, s = p->scale;

  if (!is_near (p->x) || !is_near (p->y) || !is_near (p->turn) || !(s >= CELD_LEAST_SCALE && s <= CELD_LARGEST_SCALE))
    return CELD_BAD_VALUE;
  turn_to (p->turn, &cosine, &sine);
  /* q = middle + R (p' - middle) before scaling and moving, with p' = the mirrored point. */
  *there = (CeldSimilarity) { .xx = s * cosine * k, .xy = -s * sine, .yx = s * sine * k, .yy = s * cosine };
  there->x0 = p->x + s * middle[0] + s * (cosine * ((p->flip ? width : 0) - middle[0]) + sine * middle[1]);
  there->y0 = p->y + s * middle[1] + s * (sine * ((p->flip ? width : 0) - middle[0]) - cosine * middle[1]);
  *back = (CeldSimilarity) { .xx = k * cosine / s, .xy = k * sine / s, .yx = -sine / s, .yy = cosine / s };
  back->x0 = -(back->xx * there->x0 + back->xy * there->y0);
  back->y0 = -(back->yx * there->x0 + back->yy * there->y0);
  return CELD_OK;
}

/* The pixels whose centres lie strictly between two places, within 0 .. size - 1. */
static void
pixels_between (double least, double most, int size, int *first, int *n)
{
  double from = fmax (floor (least - 0.5) + 1, 0), to = fmin (ceil (most - 0.5) - 1, size - 1);

  *first = from <= to ? (int) from : 0;
  *n     = from <= to ? (int) (to - from) + 1 : 0;
}

CeldRect
celd_similarity_box (const CeldSimilarity *there, double reach, CeldRect box, int width, int height)
{
  double   least[2] = { INFINITY, INFINITY }, most[2] = { -INFINITY, -INFINITY }, place[2];
  CeldRect pixels;

  if (!box.width)
    return (CeldRect) { 0 };
  for (int corner = 0; corner < 4; corner++)
    {
      celd_similarity_map (there, corner % 2 ? box.x + box.width + reach : box.x - reach,
                           corner / 2 ? box.y + box.height + reach : box.y - reach, place);
      for (int i = 0; i < 2; i++)
        {
          least[i] = fmin (least[i], place[i]);
          most[i]  = fmax (most[i], place[i]);
        }
    }
  pixels_between (least[0], most[0], width, &pixels.x, &pixels.width);
  pixels_between (least[1], most[1], height, &pixels.y, &pixels.height);
  return pixels.width && pixels.height ? pixels : (CeldRect) { 0 };
}
