/* Closures as a picture, so that an artist sees what was guessed.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "segment/closures.h"

#include <math.h>

/* How far a place is from the piece of a line between two others. */
static double
distance_to_piece (CeldPlace place, CeldPlace p, CeldPlace q)
{
  double x = q.x - p.x, y = q.y - p.y, square = x * x + y * y;
  double t = square > 0 ? ((place.x - p.x) * x + (place.y - p.y) * y) / square : 0;

  t = t < 0 ? 0 : t > 1 ? 1 : t;
  return celd_distance_between (place, (CeldPlace) { p.x + t * x, p.y + t * y });
}

/* Lays red of this opacity over a pixel. */
static void
blend (uint8_t *rgba, double opacity)
{
  static const double red[3] = { 255, 0, 0 };
  double              below = rgba[3] / 255.0 * (1 - opacity), alpha = opacity + below;

  for (int k = 0; k < 3; k++)
    rgba[k] = (uint8_t) lround ((opacity * red[k] + below * rgba[k]) / alpha);
  rgba[3] = (uint8_t) lround (255 * alpha);
}

/* A pixel belongs to the piece that is nearest, so that it is painted once where two pieces meet. */
static void
paint_piece (const CeldClosure *closure, size_t i, double width, CeldPaint *paint)
{
  const CeldPlace *place = closure->place;
  double           reach = width / 2 + 0.5;
  int              left = (int) fmax (floor (fmin (place[i].x, place[i + 1].x) - reach), 0);
  int              top = (int) fmax (floor (fmin (place[i].y, place[i + 1].y) - reach), 0);
  int              right = (int) fmin (ceil (fmax (place[i].x, place[i + 1].x) + reach), paint->width);
  int              bottom = (int) fmin (ceil (fmax (place[i].y, place[i + 1].y) + reach), paint->height);

  for (int y = top; y < bottom; y++)
    for (int x = left; x < right; x++)
      {
        CeldPlace centre = { x + 0.5, y + 0.5 };
        double    off = distance_to_piece (centre, place[i], place[i + 1]);
        double    opacity = fmin (reach - off, fmin (width, 1));

        if (opacity <= 0 || (i && distance_to_piece (centre, place[i - 1], place[i]) <= off) ||
            (i + 2 < closure->n && distance_to_piece (centre, place[i + 1], place[i + 2]) < off))
          continue;
        blend (CELD_RGBA (paint, x, y), opacity);
      }
}

void
celd_closures_paint (const CeldClosures *closures, double width, CeldPaint *paint)
{
  for (size_t k = 0; k < closures->n; k++)
    for (size_t i = 0; i + 1 < closures->item[k].n; i++)
      paint_piece (&closures->item[k], i, width, paint);
}
