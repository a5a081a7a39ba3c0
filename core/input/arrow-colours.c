/* Separates a connected component of arrows into its colours.
 *
 * Arrows of different colours may share ends and lie on each other.  The colours are the commonest ones of the solid
 * paint that differ clearly.  In a layer without alpha, edges are mixed with the paper: there, a pixel is compared with
 * the nearest mixture of a colour and the paper, and the pixels around it have a say, because near the paper all
 * mixtures are alike.  Where a stroke passes below another one, its paint is continued through the other one's, as far
 * as a morphological closing fills that.
 *
 * Cost: a pass over the component for each colour, and distance transforms of its box.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/arrows.h"

#include <math.h>

/* All chosen. */
#define MOST_COLOURS   16
#define KEY_BITS       4    /* of each channel in the histogram */
#define SOLID_SHARE    0.75 /* of the largest opacity: paint of less is an edge */
#define LEAST_CONTRAST 55   /* of 255, between colours of different strokes; ... */
#define MOST_CONTRAST  40   /* ... and from its stroke's colour to a pixel */
#define MOST_ON_PAPER  65   /* the same in a layer without alpha, which may have been stored with loss */
#define AROUND         0.05 /* of what a pixel counts: each of those around it, in a layer without alpha */
#define LEAST_PAINT    20   /* pixels of a colour, ... */
#define LEAST_PALETTE  0.01 /* ... which is at least this share of the solid paint */
#define LARGER         2.5  /* times the area of a part: another part that it may have belonged to */
#define MOST_BESIDE    0.55 /* of the edge of a stroke, beside other paint */
#define CLOSING        7    /* pixels: half the width of a stroke below which another one continues */

typedef struct { double red, green, blue; } StrokeColour;

static double
distance_between (StrokeColour a, StrokeColour b)
{
  return hypot (hypot (a.red - b.red, a.green - b.green), a.blue - b.blue);
}

static StrokeColour
colour_at (const CeldArrowLayer *layer, int x, int y)
{
  const uint8_t *c = CELD_RGBA (layer->paint, x, y);

  return (StrokeColour) { c[0], c[1], c[2] };
}

/* The distance of a pixel from paint; without alpha from the nearest mixture of that with the paper. */
static double
distance_from_paint (const CeldArrowLayer *layer, StrokeColour paint, StrokeColour pixel)
{
  StrokeColour paper = { layer->paper[0], layer->paper[1], layer->paper[2] };
  double       red = paint.red - paper.red, green = paint.green - paper.green, blue = paint.blue - paper.blue, share;

  if (!layer->opaque)
    return distance_between (paint, pixel);
  share = (red * (pixel.red - paper.red) + green * (pixel.green - paper.green) + blue * (pixel.blue - paper.blue)) /
          fmax (1, red * red + green * green + blue * blue);
  share = fmax (0, fmin (share, 1));
  return distance_between (
    (StrokeColour) { paper.red + share * red, paper.green + share * green, paper.blue + share * blue }, pixel);
}

static size_t
key_of (StrokeColour c)
{
  return (size_t) (((int) c.red >> (8 - KEY_BITS) << KEY_BITS | (int) c.green >> (8 - KEY_BITS)) << KEY_BITS |
                   (int) c.blue >> (8 - KEY_BITS));
}

typedef struct { double red, green, blue, n; } Bin;

/* The colours of the solid paint, commonest first; *n is their number. */
static CeldStatus
find_palette (const CeldArrowStroke *stroke, const CeldArrowLayer *layer, StrokeColour *palette, int *n)
{
  Bin   *bins  = celd_alloc0 ((size_t) 1 << 3 * KEY_BITS, sizeof *bins);
  double solid = 0;
  int    most = 0;

  *n = 0;
  if (!bins)
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < stroke->n; i++)
    most = (int) fmax (most, celd_arrow_opacity (layer, celd_stroke_x (stroke, stroke->pixel[i]),
                                                celd_stroke_y (stroke, stroke->pixel[i])));
  for (size_t i = 0; i < stroke->n; i++)
    {
      int          x = celd_stroke_x (stroke, stroke->pixel[i]), y = celd_stroke_y (stroke, stroke->pixel[i]);
      StrokeColour c;
      Bin         *bin;

      if (celd_arrow_opacity (layer, x, y) < SOLID_SHARE * most)
        continue;
      c   = colour_at (layer, x, y);
      bin = &bins[key_of (c)];
      bin->red += c.red;
      bin->green += c.green;
      bin->blue += c.blue;
      bin->n++;
      solid++;
    }
  while (*n < MOST_COLOURS)
    {
      Bin *best  = bins;
      bool other = true;

      for (size_t i = 0; i < (size_t) 1 << 3 * KEY_BITS; i++)
        best = bins[i].n > best->n ? &bins[i] : best;
      if (best->n < fmax (LEAST_PAINT, LEAST_PALETTE * solid))
        break;
      palette[*n] = (StrokeColour) { best->red / best->n, best->green / best->n, best->blue / best->n };
      for (int k = 0; k < *n; k++)
        other &= distance_from_paint (layer, palette[k], palette[*n]) > LEAST_CONTRAST;
      *n += other;
      best->n = 0;
    }
  celd_free (bins);
  return CELD_OK;
}

/* Work space in the box of the component. */
typedef struct
{
  CeldStrokeMask mask;
  uint8_t       *index; /* the colour of each painted pixel */
  uint8_t       *seed;
  int32_t       *squared;
  CeldLabels     parts;
  CeldComponent *part;
  size_t         n_parts;
} ColourSplit;

static void
colour_split_clear (ColourSplit *s)
{
  celd_stroke_mask_clear (&s->mask);
  celd_free (s->index);
  celd_free (s->seed);
  celd_free (s->squared);
  celd_free (s->parts.data);
  celd_free (s->part);
}

/* Sets `parts` to the paint of one colour, closed across that of others. */
static CeldStatus
close_colour (ColourSplit *s, int colour)
{
  size_t     n = (size_t) s->mask.width * (size_t) s->mask.height;
  CeldStatus status;

  for (size_t i = 0; i < n; i++)
    s->seed[i] = s->mask.painted[i] && s->index[i] == colour;
  status = celd_distance (s->mask.width, s->mask.height, s->seed, NULL, s->squared);
  for (size_t i = 0; i < n && status == CELD_OK; i++)
    {
      s->parts.data[i] = s->seed[i];
      s->seed[i]       = s->squared[i] > CLOSING * CLOSING;
    }
  if (status == CELD_OK)
    status = celd_distance (s->mask.width, s->mask.height, s->seed, NULL, s->squared);
  for (size_t i = 0; i < n && status == CELD_OK; i++)
    if (s->mask.painted[i] && s->squared[i] > CLOSING * CLOSING)
      s->parts.data[i] = 1;
  return status;
}

/* Appends the pixels of one part of a colour. */
static CeldStatus
add_part (const ColourSplit *s, const CeldArrowStroke *stroke, int colour, uint32_t part, CeldColourStrokes *all)
{
  const CeldComponent *box = &s->part[part - 1];
  CeldCrossingStrokes *to = &all->strokes;
  size_t               row = (size_t) stroke->width + 2, n = to->first[to->n], n_seen = n;

  for (int y = box->top; y <= box->bottom; y++)
    for (int x = box->left; x <= box->right; x++)
      {
        size_t p = (size_t) y * (size_t) s->mask.width + (size_t) x;

        if (CELD_AT (&s->parts, x, y) != part)
          continue;
        if (celd_append (all->seen, n_seen, all->seen_capacity, s->index[p] == colour) != CELD_OK ||
            celd_append (to->pixel, n, to->pixel_capacity,
                         (uint32_t) ((size_t) (y + s->mask.top + 1) * row + (size_t) (x + s->mask.left + 1))) !=
              CELD_OK)
          return CELD_NO_MEMORY;
      }
  to->first[++to->n] = n;
  return CELD_OK;
}

/* Is a much larger part of the same colour so close that this one may be what others leave of its head or side? */
static CeldStatus
is_remnant (ColourSplit *s, uint32_t part, bool *remnant)
{
  const CeldComponent *own = &s->part[part - 1];
  int                  left = own->left > CELD_MOST_BREAK ? own->left - CELD_MOST_BREAK : 0;
  int                  top = own->top > CELD_MOST_BREAK ? own->top - CELD_MOST_BREAK : 0;
  int                  width = (int) fmin (own->right + CELD_MOST_BREAK + 1, s->mask.width) - left;
  int                  height = (int) fmin (own->bottom + CELD_MOST_BREAK + 1, s->mask.height) - top;
  CeldStatus           status;

  for (int y = 0; y < height; y++)
    for (int x = 0; x < width; x++)
      {
        uint32_t there = CELD_AT (&s->parts, left + x, top + y);

        s->seed[(size_t) y * (size_t) width + (size_t) x] =
          there && (double) s->part[there - 1].area >= LARGER * (double) own->area;
      }
  status = celd_distance (width, height, s->seed, NULL, s->squared);
  for (int y = 0; y < height && status == CELD_OK; y++)
    for (int x = 0; x < width; x++)
      *remnant |= CELD_AT (&s->parts, left + x, top + y) == part &&
                  s->squared[(size_t) y * (size_t) width + (size_t) x] < CELD_MOST_BREAK * CELD_MOST_BREAK;
  return status;
}

/* Is most of the edge of a part beside other paint, which may hide a side or an end of it? */
static bool
is_covered (const ColourSplit *s, int colour, uint32_t part)
{
  const CeldComponent *box = &s->part[part - 1];
  size_t               w = (size_t) s->mask.width, beside = 0, all = 0;

  for (int y = box->top; y <= box->bottom; y++)
    for (int x = box->left; x <= box->right; x++)
      {
        size_t p = (size_t) y * w + (size_t) x, around[4] = { p - w, p + 1, p + w, p - 1 }; /* the border is not painted */

        for (int i = 0; i < 4 && s->parts.data[p] == part && s->index[p] == colour; i++)
          if (s->parts.data[around[i]] != part || s->index[around[i]] != colour)
            {
              all++;
              beside += s->mask.painted[around[i]];
            }
      }
  return (double) beside > MOST_BESIDE * (double) all;
}

/* Appends the connected parts of one colour, each a stroke, and whether it is a remnant or covered. */
static CeldStatus
add_parts (ColourSplit *s, const CeldArrowStroke *stroke, int colour, CeldColourStrokes *to)
{
  CeldStatus status = celd_components (&s->parts, 0, true, NULL, &s->parts, &s->part, &s->n_parts);

  for (size_t k = 0; k < s->n_parts && status == CELD_OK; k++)
    {
      size_t n = to->strokes.n, n_covered = n, n_colour = n, n_first = n + 1;
      bool   remnant = false;

      if (s->part[k].area < LEAST_PAINT)
        continue;
      if (s->n_parts > 1 && s->part[k].area >= CELD_LEAST_PART)
        status = is_remnant (s, (uint32_t) k + 1, &remnant);
      if (status == CELD_OK)
        status = celd_append (to->remnant, n, to->remnant_capacity, remnant);
      if (status == CELD_OK)
        status = celd_append (to->covered, n_covered, to->covered_capacity, is_covered (s, colour, (uint32_t) k + 1));
      if (status == CELD_OK)
        status = celd_append (to->colour, n_colour, to->colour_capacity, colour);
      if (status == CELD_OK)
        status = celd_append (to->strokes.first, n_first, to->first_capacity, 0);
      if (status == CELD_OK)
        status = add_part (s, stroke, colour, (uint32_t) k + 1, to);
    }
  celd_free (s->part);
  s->part = NULL;
  return status;
}

/* How badly a colour fits a pixel of the component; without alpha those around it have a say. */
static double
misfit (const ColourSplit *s, const CeldArrowLayer *layer, StrokeColour paint, int x, int y)
{
  double sum = distance_from_paint (layer, paint, colour_at (layer, x, y));

  for (int j = y - 1; j <= y + 1 && layer->opaque; j++)
    for (int i = x - 1; i <= x + 1; i++)
      if (s->mask.painted[(size_t) (j - s->mask.top) * (size_t) s->mask.width + (size_t) (i - s->mask.left)])
        sum += AROUND * distance_from_paint (layer, paint, colour_at (layer, i, j));
  return sum;
}

/* The index of the colour of a pixel; `n` if it is none of them. */
static int
nearest_colour (const ColourSplit *s, const CeldArrowLayer *layer, const StrokeColour *palette, int n, int x, int y)
{
  double most = layer->opaque ? MOST_ON_PAPER : MOST_CONTRAST, least = misfit (s, layer, palette[0], x, y);
  int    nearest = 0;

  for (int k = 1; k < n; k++)
    {
      double other = misfit (s, layer, palette[k], x, y);

      if (other < least)
        {
          nearest = k;
          least   = other;
        }
    }
  return distance_from_paint (layer, palette[nearest], colour_at (layer, x, y)) <= most ? nearest : n;
}

/* Makes room, and finds the colour of each pixel of a component, one of n. */
static CeldStatus
colour_split_new (const CeldArrowStroke *component, const CeldArrowLayer *layer, const StrokeColour *palette, int n,
                  ColourSplit *s)
{
  size_t     area;
  CeldStatus status = celd_stroke_mask_new (component, &s->mask);

  if (status != CELD_OK)
    return status;
  area       = (size_t) s->mask.width * (size_t) s->mask.height;
  s->index   = celd_alloc0 (area, 1);
  s->seed    = celd_alloc (area, 1);
  s->squared = celd_alloc (area, sizeof *s->squared);
  if (!s->index || !s->seed || !s->squared)
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < component->n; i++)
    {
      int    x = celd_stroke_x (component, component->pixel[i]), y = celd_stroke_y (component, component->pixel[i]);
      size_t p = (size_t) (y - s->mask.top) * (size_t) s->mask.width + (size_t) (x - s->mask.left);

      s->index[p] = (uint8_t) nearest_colour (s, layer, palette, n, x, y);
    }
  return celd_labels_new (s->mask.width, s->mask.height, &s->parts);
}

CeldStatus
celd_arrow_colours_split (const CeldArrowStroke *component, const CeldArrowLayer *layer, CeldColourStrokes *strokes)
{
  ColourSplit       s = { 0 };
  CeldColourStrokes made = { 0 };
  StrokeColour      palette[MOST_COLOURS];
  int               n = 0;
  size_t            n_first = 0;
  CeldStatus        status = find_palette (component, layer, palette, &n);

  if (status == CELD_OK && n > 1)
    status = celd_append (made.strokes.first, n_first, made.first_capacity, 0);
  if (status == CELD_OK && n > 1)
    status = colour_split_new (component, layer, palette, n, &s);
  for (int k = 0; k < n && n > 1 && status == CELD_OK; k++)
    {
      status = close_colour (&s, k);
      if (status == CELD_OK)
        status = add_parts (&s, component, k, &made);
    }
  colour_split_clear (&s);
  if (status == CELD_OK)
    *strokes = made;
  else
    celd_colour_strokes_clear (&made);
  return status;
}

void
celd_colour_strokes_clear (CeldColourStrokes *s)
{
  celd_crossing_strokes_clear (&s->strokes);
  celd_free (s->remnant);
  celd_free (s->covered);
  celd_free (s->colour);
  celd_free (s->seen);
  *s = (CeldColourStrokes) { 0 };
}
