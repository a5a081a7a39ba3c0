/* How unlike two places of arrows are in colour.
 *
 * Where a layer has alpha a stroke has one straight colour, however faint it is.  Where it has none paint is seen by
 * its difference from the paper, and what fades keeps the direction of that alone.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/arrow-colours.h"
#include "input/arrows.h"

#include <math.h>

#define OTHER_COLOUR 60    /* of 255: two strokes differ by more, */
#define OTHER_SINE   0.209 /* or the directions of their differences from the paper do: 12 degrees */
#define ROUNDING     1.5   /* steps of 8 bits in premultiplied colours */

static double
product (const CeldTint *a, const CeldTint *b)
{
  return (double) a->c[0] * b->c[0] + (double) a->c[1] * b->c[1] + (double) a->c[2] * b->c[2];
}

CeldTint
celd_tint_at (const CeldArrowLayer *layer, int x, int y)
{
  const uint8_t *c = celd_arrow_pixel (layer, x, y);
  CeldTint       t = { .strength = (float) celd_arrow_opacity (layer, x, y) };

  for (int i = 0; i < 3; i++)
    t.c[i] = (float) (layer->opaque ? c[i] - layer->paper[i] : c[i]);
  return t;
}

CeldTint
celd_tint_between (const CeldTint *a, const CeldTint *b, double t)
{
  CeldTint  m;
  double    share = fmax (0, fmin (1, t));

  for (int i = 0; i < 3; i++)
    m.c[i] = (float) (a->c[i] + share * ((double) b->c[i] - a->c[i]));
  m.strength = (float) (a->strength + share * ((double) b->strength - a->strength));
  return m;
}

double
celd_tints_differ (const CeldArrowLayer *layer, const CeldTint *a, const CeldTint *b, double noise)
{
  double weak = fmax (1, fmin (a->strength, b->strength));

  if (layer->opaque)
    {
      double one = sqrt (product (a, a)), two = sqrt (product (b, b)), dot = product (a, b), sine;

      if (!(one > 0 && two > 0))
        return 0;
      dot /= one * two;
      sine = dot > 0 ? sqrt (fmax (0, 1 - dot * dot)) : 1;
      return fmax (0, sine - noise / fmin (one, two)) / OTHER_SINE;
    }
  else
    {
      double r = (double) a->c[0] - b->c[0], g = (double) a->c[1] - b->c[1], u = (double) a->c[2] - b->c[2];

      return fmax (0, sqrt (r * r + g * g + u * u) - ROUNDING * 255 / weak) / OTHER_COLOUR;
    }
}

void
celd_tint_paint (const CeldArrowLayer *layer, const CeldTint *t, uint8_t rgba[4])
{
  double most = fmax (1, fmax (fabs (t->c[0]), fmax (fabs (t->c[1]), fabs (t->c[2]))));

  for (int i = 0; i < 3; i++)
    {
      double v = layer->opaque ? layer->paper[i] + t->c[i] * (t->strength / most) : t->c[i];

      rgba[i] = (uint8_t) (fmax (0, fmin (255, v)) + 0.5);
    }
  rgba[3] = layer->opaque ? 255 : (uint8_t) (fmax (0, fmin (255, t->strength)) + 0.5);
}
