/* Layers of arrows: how opaque the pixels of one are, and relations painted as one.
 *
 * The opacity of a layer with transparency is its alpha, divided by that of the most opaque pixel, because the brush may
 * have been translucent.  In an opaque layer the commonest colour is taken for paper,
 * and a pixel's opacity is its largest difference from that colour in any channel.
 *
 * A relation is painted as an artist would paint it: a shaft, and a filled head at the farther end, green where it is
 * certain, orange where it is a guess.  Of arrows that would touch, which would be read as one stroke, the heaviest is
 * painted.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/input.h"

#include <math.h>
#include <stdlib.h>

#define KEPT_BITS   5   /* of each channel; colours that differ in lower bits are counted together; chosen */
#define HEAD_LENGTH 4.0 /* widths of the shaft; chosen */
#define HEAD_HALF   2.0 /* widths of the shaft, half the width of the head; chosen */
#define SLIM_ARROW  9.0 /* least length of an arrow in widths of the shaft; shorter ones are painted thinner; chosen */
#define THIN_ARROW  1.5 /* pixels, the thinnest shaft; chosen */

int
celd_arrow_opacity (const CeldArrowLayer *layer, int x, int y)
{
  const uint8_t *c = CELD_RGBA (layer->paint, x, y);
  int            contrast = 0;

  if (!layer->opaque)
    return c[3] * 255 / layer->strongest;
  for (int i = 0; i < 3; i++)
    if (abs (c[i] - layer->paper[i]) > contrast)
      contrast = abs (c[i] - layer->paper[i]);
  return contrast;
}

static int
strongest_alpha (const CeldPaint *paint)
{
  int strongest = 0;

  for (int y = 0; y < paint->height; y++)
    for (int x = 0; x < paint->width; x++)
      if (CELD_RGBA (paint, x, y)[3] > strongest)
        strongest = CELD_RGBA (paint, x, y)[3];
  return strongest >= CELD_VISIBLE_ALPHA ? strongest : 255;
}

CeldStatus
celd_arrow_layer_new (const CeldPaint *paint, CeldArrowLayer *layer)
{
  uint32_t *count = celd_alloc0 (1 << 3 * KEPT_BITS, sizeof *count), most = 0;

  if (!count)
    return CELD_NO_MEMORY;
  *layer = (CeldArrowLayer) { .paint = paint, .opaque = true, .strongest = 255 };
  for (int y = 0; y < paint->height && layer->opaque; y++)
    for (int x = 0; x < paint->width; x++)
      {
        const uint8_t *c   = CELD_RGBA (paint, x, y);
        uint32_t       key = 0;

        for (int i = 0; i < 3; i++)
          key = key << KEPT_BITS | (uint32_t) (c[i] >> (8 - KEPT_BITS));
        layer->opaque &= c[3] == 255;
        if (++count[key] > most)
          {
            most = count[key];
            for (int i = 0; i < 3; i++)
              layer->paper[i] = c[i];
          }
      }
  celd_free (count);
  if (!layer->opaque)
    layer->strongest = strongest_alpha (paint);
  return CELD_OK;
}

/* ------------------------------------------------------------------ relations painted as arrows */

typedef struct { double x, y, dx, dy, length, width; } Arrow; /* from its tail, in a direction of length 1 */

static const double guess[3] = { 245, 150, 0 }, certain[3] = { 0, 130, 60 };

/* Distance from the arrow's edge, negative inside, of a point `along` its axis and `off` it. */
static double
outside (const Arrow *a, double along, double off)
{
  double head = HEAD_LENGTH * a->width, neck = a->length - head, slope = hypot (head, HEAD_HALF * a->width);
  double shaft = hypot (fmax (0, fmax (-along, along - neck)), off) - a->width / 2;
  /* From the head's two long sides. */
  double flank = ((along - a->length) * HEAD_HALF * a->width + fabs (off) * head) / slope;

  return fmin (shaft, fmax (flank, neck - along));
}

static void
paint_arrow (const Arrow *a, double confidence, CeldPaint *paint)
{
  double away = HEAD_HALF * a->width + 1, end_x = a->x + a->length * a->dx, end_y = a->y + a->length * a->dy, colour[3];
  int    left = (int) fmax (floor (fmin (a->x, end_x) - away), 0);
  int    top = (int) fmax (floor (fmin (a->y, end_y) - away), 0);
  int    right = (int) fmin (ceil (fmax (a->x, end_x) + away), paint->width);
  int    bottom = (int) fmin (ceil (fmax (a->y, end_y) + away), paint->height);

  for (int k = 0; k < 3; k++)
    colour[k] = guess[k] + confidence * (certain[k] - guess[k]);
  for (int y = top; y < bottom; y++)
    for (int x = left; x < right; x++)
      {
        double u = x + 0.5 - a->x, v = y + 0.5 - a->y;
        double opacity = 0.5 - outside (a, u * a->dx + v * a->dy, u * a->dy - v * a->dx);

        if (opacity > 0)
          celd_blend (CELD_RGBA (paint, x, y), colour, fmin (1, opacity));
      }
}

/* The arrow of a relation; length 0 if it has none. */
static Arrow
arrow_of (const CeldRelation *r, double width)
{
  double dx = r->farther.x - r->nearer.x, dy = r->farther.y - r->nearer.y, length = hypot (dx, dy);

  if (r->equal || r->nearer.by_colour || r->farther.by_colour || !(length >= 1) || !(length <= 4 * CELD_MAX_SIDE))
    return (Arrow) { 0 };
  return (Arrow) {
    r->nearer.x + 0.5, r->nearer.y + 0.5, dx / length, dy / length, length,
    fmax (THIN_ARROW, fmin (width, length / SLIM_ARROW))
  };
}

/* The least distance between the axes of two arrows, taken in steps of a shaft's width. */
static double
axis_distance (const Arrow *a, const Arrow *b)
{
  double least = INFINITY, step = fmin (a->width, b->width);

  for (double t = 0; t < a->length + step; t += step)
    {
      double at = fmin (t, a->length), u = a->x + at * a->dx - b->x, v = a->y + at * a->dy - b->y;
      double along = fmax (0, fmin (b->length, u * b->dx + v * b->dy));

      least = fmin (least, hypot (u - along * b->dx, v - along * b->dy));
    }
  return least;
}

static bool
is_free (const Arrow *a, const Arrow *painted, size_t n)
{
  for (size_t i = 0; i < n; i++)
    {
      const Arrow *b = &painted[i];
      double       far = HEAD_HALF * (a->width + b->width) + 2; /* heads side by side, and a pixel on either side */

      if (hypot (a->x - b->x, a->y - b->y) < a->length + b->length + far && axis_distance (a, b) < far)
        return false;
    }
  return true;
}

typedef struct { double weight; size_t relation; } RankedRelation;

/* By falling weight, then in the order given. */
static int
compare_ranked (const void *one, const void *two)
{
  const RankedRelation *a = one, *b = two;

  if (a->weight != b->weight)
    return a->weight > b->weight ? -1 : 1;
  return a->relation < b->relation ? -1 : 1;
}

CeldStatus
celd_relations_paint (const CeldRelations *relations, double width, CeldPaint *paint)
{
  RankedRelation *ranked = celd_alloc (relations->n, sizeof *ranked);
  Arrow          *painted = celd_alloc (relations->n, sizeof *painted);
  size_t          n = 0;

  if (ranked && painted)
    {
      for (size_t i = 0; i < relations->n; i++)
        ranked[i] = (RankedRelation) { relations->item[i].weight > 0 ? relations->item[i].weight : 0, i };
      qsort (ranked, relations->n, sizeof *ranked, compare_ranked);
      for (size_t i = 0; i < relations->n; i++)
        {
          Arrow a = arrow_of (&relations->item[ranked[i].relation], width);

          if (!(a.length > 0) || !is_free (&a, painted, n))
            continue;
          painted[n++] = a;
          paint_arrow (&a, fmin (1, ranked[i].weight), paint);
        }
    }
  celd_free (ranked);
  celd_free (painted);
  return ranked && painted ? CELD_OK : CELD_NO_MEMORY;
}
