/* Painted pictures: labels as colours and back, marks at problems, colours under transparent pixels.
 *
 * Distinct colours are counted in a hash table.  A mark is a red ring with a white rim, which is visible on ink, paper
 * and colours, and a dot at the place itself.  An unclear arrow is its own mark: its paint in red.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MARK_RADIUS     5.0     /* pixels, at least; chosen */
#define MARK_SIDE_RATIO 60.0    /* the shorter side of the picture divided by the radius; chosen */
#define MARK_LINE       0.3     /* width of the ring's line in radii; chosen */
#define MARK_RIM        0.2     /* width of the white on either side in radii; chosen */
#define MARK_DOT        0.2     /* radius of the dot in radii; chosen */
#define MOST_BLACK      2       /* of 255, in each channel of a black stroke: colour management may shift it; chosen */
#define SOLID_ALPHA     0.5f    /* from which a pixel's colour is used for transparent ones; chosen */

/* ------------------------------------------------------------------ labels to colours */

CeldStatus
celd_labels_paint (const CeldLabels *labels, const CeldPalette *palette, CeldPaint *paint)
{
  const uint8_t none[4] = { 0 };

  if (!CELD_SAME_SIZE (labels, paint))
    return CELD_BAD_SIZE;
  for (int y = 0; y < labels->height; y++)
    for (int x = 0; x < labels->width; x++)
      {
        uint32_t l = CELD_AT (labels, x, y);

        memcpy (CELD_RGBA (paint, x, y), l >= 1 && l <= palette->n ? palette->item[l - 1].colour : none, 4);
      }
  return CELD_OK;
}

/* ------------------------------------------------------------------ colours to labels */

/* The distinct colours of a picture: a hash table with open addressing. */
typedef struct { uint32_t key, label; size_t area; } PaintColour; /* key: 0xAARRGGBB; label 0: the slot is free */
typedef struct { PaintColour *slot; size_t room, n; } PaintColours;

static uint32_t
colour_key (const uint8_t *rgba)
{
  if (rgba[3] < 128)
    return 0;
  return UINT32_C (0xff000000) | (uint32_t) rgba[0] << 16 | (uint32_t) rgba[1] << 8 | rgba[2];
}

static PaintColour *
find_slot (const PaintColours *colours, uint32_t key)
{
  uint32_t hash = key * UINT32_C (2654435769); /* its high bits depend on all bits of the key, its low bits do not */
  size_t   i = (hash ^ hash >> 16) & (colours->room - 1);

  while (colours->slot[i].label && colours->slot[i].key != key)
    i = (i + 1) & (colours->room - 1);
  return &colours->slot[i];
}

/* Grows the table, so that with one more colour it is at most half full. */
static CeldStatus
make_room (PaintColours *colours)
{
  PaintColours more = { NULL, colours->room ? 2 * colours->room : 256, colours->n };

  if (colours->room > 2 * colours->n)
    return CELD_OK;
  more.slot = celd_alloc0 (more.room, sizeof *more.slot);
  if (!more.slot)
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < colours->room; i++)
    if (colours->slot[i].label)
      *find_slot (&more, colours->slot[i].key) = colours->slot[i];
  celd_free (colours->slot);
  *colours = more;
  return CELD_OK;
}

/* Numbers the colours in the order of their first pixels. */
static CeldStatus
read_colours (const CeldPaint *paint, PaintColours *colours, uint32_t *label)
{
  for (int y = 0; y < paint->height; y++)
    for (int x = 0; x < paint->width; x++)
      {
        uint32_t     key = colour_key (CELD_RGBA (paint, x, y));
        PaintColour *colour;

        if (make_room (colours) != CELD_OK)
          return CELD_NO_MEMORY;
        colour = find_slot (colours, key);
        if (!colour->label)
          *colour = (PaintColour) { key, (uint32_t) ++colours->n, 0 };
        colour->area++;
        *label++ = colour->label;
      }
  return CELD_OK;
}

/* Orders by falling area, then by first pixel; the transparent background comes last. */
static int
compare_colours (const void *a, const void *b)
{
  const PaintColour *p = a, *q = b;

  if (!p->key != !q->key)
    return p->key ? -1 : 1;
  if (p->area != q->area)
    return p->area > q->area ? -1 : 1;
  return p->label < q->label ? -1 : 1;
}

/* Makes a palette of sorted colours; number[l] becomes the final label of the colour with the preliminary label l. */
static void
name_colours (const PaintColour *colour, size_t n, CeldRegion *item, uint32_t *number)
{
  for (size_t i = 0; i < n; i++)
    {
      uint32_t key = colour[i].key;

      number[colour[i].label] = (uint32_t) i + 1;
      item[i] = (CeldRegion) {
        .colour     = { (uint8_t) (key >> 16), (uint8_t) (key >> 8), (uint8_t) key, (uint8_t) (key >> 24) },
        .origin     = key ? CELD_FROM_SCRIBBLE : CELD_FROM_BACKGROUND,
        .background = !key,
      };
    }
}

/* Moves the slots in use to the front. */
static void
pack (PaintColours *colours)
{
  size_t n = 0;

  for (size_t i = 0; i < colours->room; i++)
    if (colours->slot[i].label)
      colours->slot[n++] = colours->slot[i];
}

CeldStatus
celd_labels_read (const CeldPaint *paint, CeldLabels *labels, CeldPalette *palette)
{
  PaintColours colours = { 0 };
  CeldLabels   made = { 0 };
  CeldPalette  named = { 0 };
  uint32_t    *number = NULL;
  CeldStatus   status;

  if (!CELD_SAME_SIZE (paint, labels))
    return CELD_BAD_SIZE;
  status = celd_labels_new (paint->width, paint->height, &made);
  if (status == CELD_OK)
    status = read_colours (paint, &colours, made.data);
  if (status != CELD_OK)
    goto done;
  pack (&colours);
  qsort (colours.slot, colours.n, sizeof *colours.slot, compare_colours);
  status = CELD_NO_MEMORY;
  number = celd_alloc (colours.n + 1, sizeof *number);
  named  = (CeldPalette) { celd_alloc (colours.n, sizeof *named.item), colours.n };
  if (!number || !named.item)
    goto done;
  name_colours (colours.slot, colours.n, named.item, number);
  for (size_t p = 0; p < (size_t) made.width * (size_t) made.height; p++)
    made.data[p] = number[made.data[p]];
  status = celd_palette_measure (&made, NULL, NULL, &named);
  if (status != CELD_OK)
    goto done;
  for (int y = 0; y < labels->height; y++)
    memcpy (&CELD_AT (labels, 0, y), &CELD_AT (&made, 0, y), (size_t) labels->width * sizeof *labels->data);
  celd_palette_clear (palette);
  *palette = named;
  named    = (CeldPalette) { 0 };

done:
  celd_free (colours.slot);
  celd_free (made.data);
  celd_free (number);
  celd_palette_clear (&named);
  return status;
}

static bool
is_black (const uint8_t *colour)
{
  return colour[0] <= MOST_BLACK && colour[1] <= MOST_BLACK && colour[2] <= MOST_BLACK;
}

/* Writes the label of each opaque pixel's colour; 0 for others, and *black (NULL: the same) for black ones. */
static CeldStatus
read_strokes (const CeldPaint *paint, const CeldPalette *palette, const uint32_t *black, CeldLabels *labels)
{
  uint8_t  last[4] = { 0 };
  uint32_t label = 0;

  if (!CELD_SAME_SIZE (paint, labels))
    return CELD_BAD_SIZE;
  for (int y = 0; y < paint->height; y++)
    for (int x = 0; x < paint->width; x++)
      {
        const uint8_t *pixel = CELD_RGBA (paint, x, y);

        if (memcmp (pixel, last, 4))
          {
            memcpy (last, pixel, 4);
            label = pixel[3] < 128 ? 0 : black && is_black (pixel) ? *black : celd_palette_find (palette, pixel);
          }
        CELD_AT (labels, x, y) = label;
      }
  return CELD_OK;
}

CeldStatus
celd_corrections_read (const CeldPaint *paint, const CeldPalette *palette, CeldLabels *labels)
{
  return read_strokes (paint, palette, NULL, labels);
}

CeldStatus
celd_hidden_read (const CeldPaint *paint, const CeldPalette *palette, CeldLabels *labels)
{
  const uint32_t erase = CELD_HIDDEN_ERASE;

  return read_strokes (paint, palette, &erase, labels);
}

/* ------------------------------------------------------------------ marks at problems */

/* Coverage of a pixel whose centre is `outside` pixels beyond the edge of a shape. */
static double
cover (double outside)
{
  return fmax (0, fmin (1, 0.5 - outside));
}

void
celd_blend (uint8_t *rgba, const double colour[3], double opacity)
{
  double below = rgba[3] / 255.0 * (1 - opacity), alpha = opacity + below;

  if (opacity <= 0)
    return;
  for (int c = 0; c < 3; c++)
    rgba[c] = (uint8_t) lround ((opacity * colour[c] + below * rgba[c]) / alpha);
  rgba[3] = (uint8_t) lround (255 * alpha);
}

static const double red[3] = { 230, 0, 0 }, white[3] = { 255, 255, 255 };

static void
paint_run (CeldPaint *paint, const CeldPaintRun *run)
{
  for (int x = run->x; x < run->x + run->n; x++)
    if (x >= 0 && run->y >= 0 && x < paint->width && run->y < paint->height)
      celd_blend (CELD_RGBA (paint, x, run->y), red, 1);
}

static void
paint_mark (CeldPaint *paint, int x, int y, double radius)
{
  double              line = fmax (1, MARK_LINE * radius) / 2, rim = line + fmax (1, MARK_RIM * radius);
  double              dot = MARK_DOT * radius;
  int                 half = (int) ceil (radius + rim) + 1;

  for (int v = y - half; v <= y + half; v++)
    for (int u = x - half; u <= x + half; u++)
      {
        double away = hypot (u - x, v - y), off = fabs (away - radius);

        if (u < 0 || v < 0 || u >= paint->width || v >= paint->height)
          continue;
        celd_blend (CELD_RGBA (paint, u, v), white, fmax (cover (off - rim), cover (away - dot - (rim - line))));
        celd_blend (CELD_RGBA (paint, u, v), red, fmax (cover (off - line), cover (away - dot)));
      }
}

void
celd_problems_paint (const CeldProblems *problems, CeldPaint *paint)
{
  int    side = paint->width < paint->height ? paint->width : paint->height;
  double radius = fmax (MARK_RADIUS, side / MARK_SIDE_RATIO);

  for (size_t i = 0; i < problems->n_runs; i++)
    paint_run (paint, &problems->run[i]);
  for (size_t i = 0; i < problems->n; i++)
    if (!problems->item[i].runs && problems->item[i].x >= 0 && problems->item[i].y >= 0)
      paint_mark (paint, problems->item[i].x, problems->item[i].y, radius);
}

/* ------------------------------------------------------------------ colours under transparent pixels */

/* Gives an almost transparent pixel the colour of the nearest solid one, or `blank` if there is none near. */
static void
pad_pixel (const CeldColours *picture, int64_t most, const float blank[3], int32_t squared, int32_t nearest,
           float *rgba)
{
  const float *from = CELD_RGBA (picture, nearest < 0 ? 0 : nearest % picture->width,
                                 nearest < 0 ? 0 : nearest / picture->width);

  if (rgba[3] >= SOLID_ALPHA)
    return;
  if (nearest >= 0 && squared <= most)
    memcpy (rgba, from, 3 * sizeof *rgba);
  else if (!(rgba[3] > 0))
    memcpy (rgba, blank, 3 * sizeof *rgba);
}

CeldStatus
celd_pad_colours (int radius, const float blank[3], const CeldHost *host, CeldColours *picture)
{
  if (!CELD_SAME_SIZE (picture, picture))
    return CELD_BAD_SIZE;
  if (radius < 0)
    return CELD_BAD_VALUE;

  size_t     n = (size_t) picture->width * (size_t) picture->height, i = 0;
  uint8_t   *solid = celd_alloc (n, sizeof *solid);
  int32_t   *squared = celd_alloc (n, sizeof *squared), *nearest = celd_alloc (n, sizeof *nearest);
  CeldStatus status = solid && squared && nearest ? CELD_OK : CELD_NO_MEMORY;

  if (status == CELD_OK)
    {
      for (int y = 0; y < picture->height; y++)
        for (int x = 0; x < picture->width; x++)
          solid[i++] = CELD_RGBA (picture, x, y)[3] >= SOLID_ALPHA;
      status = celd_nearest (picture->width, picture->height, solid, host, squared, nearest);
    }
  i = 0;
  for (int y = 0; y < picture->height && status == CELD_OK; y++)
    for (int x = 0; x < picture->width; x++, i++)
      pad_pixel (picture, (int64_t) radius * radius, blank, squared[i], nearest[i], CELD_RGBA (picture, x, y));
  celd_free (solid);
  celd_free (squared);
  celd_free (nearest);
  return status;
}
