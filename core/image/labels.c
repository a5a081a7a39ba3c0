/* Label pictures: to colours and back, separating regions of one label, measuring labels, finding the background.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/vector.h"
#include "image/image.h"

#include <stdlib.h>
#include <string.h>

#define COLOUR_ERROR 2 /* of 255 per channel: how far colour management may change an opaque colour */

/* ------------------------------------------------------------------ area and position of each label */

/* Whether a pixel is ink, beside another label, or outermost in the picture. */
static bool
on_border (const CeldLabels *labels, const CeldPlane *ink, int x, int y)
{
  uint32_t l = CELD_AT (labels, x, y);

  return (ink && !celd_is_paper (CELD_AT (ink, x, y))) ||
         x == 0 || x + 1 == labels->width || y == 0 || y + 1 == labels->height ||
         CELD_AT (labels, x - 1, y) != l || CELD_AT (labels, x + 1, y) != l ||
         CELD_AT (labels, x, y - 1) != l || CELD_AT (labels, x, y + 1) != l;
}

CeldStatus
celd_palette_measure (const CeldLabels *labels, const CeldPlane *ink, const CeldHost *host, CeldPalette *palette)
{
  int        w = labels->width, h = labels->height;
  size_t     n = (size_t) w * (size_t) h;
  uint8_t   *border = celd_alloc (n, 1);
  int32_t   *squared = celd_alloc (n, sizeof *squared), *deepest = celd_alloc (palette->n, sizeof *deepest);
  CeldStatus status = CELD_NO_MEMORY;

  if (!border || !squared || !deepest)
    goto done;
  for (int y = 0; y < h; y++)
    for (int x = 0; x < w; x++)
      border[(size_t) y * (size_t) w + (size_t) x] = on_border (labels, ink, x, y);
  status = celd_distance (w, h, border, host, squared);
  if (status != CELD_OK)
    goto done;
  for (size_t k = 0; k < palette->n; k++)
    {
      palette->item[k].area = 0;
      palette->item[k].x = palette->item[k].y = -1;
      deepest[k] = -1;
    }
  for (int y = 0; y < h; y++)
    for (int x = 0; x < w; x++)
      {
        uint32_t    l = CELD_AT (labels, x, y);
        int32_t     depth = squared[(size_t) y * (size_t) w + (size_t) x];
        CeldRegion *region;

        if (l < 1 || l > palette->n)
          continue;
        region = &palette->item[l - 1];
        region->area++;
        if (depth <= deepest[l - 1])
          continue;
        deepest[l - 1] = depth;
        region->x      = x;
        region->y      = y;
      }

done:
  celd_free (border);
  celd_free (squared);
  celd_free (deepest);
  return status;
}

/* ------------------------------------------------------------------ separating the regions of a label */

/* Chooses the label of each component: the largest one of a label, and specks, keep it; others get new labels. */
static CeldStatus
number_regions (const CeldComponent *component, size_t n, CeldPalette *palette, uint32_t *number)
{
  size_t *largest = celd_alloc (palette->n, sizeof *largest), n_old = palette->n;

  if (!largest)
    return CELD_NO_MEMORY;
  for (size_t k = 0; k < n_old; k++)
    largest[k] = n;
  for (size_t i = 0; i < n; i++)
    {
      size_t k = component[i].label - 1;

      if (k < n_old && (largest[k] == n || component[i].area > component[largest[k]].area))
        largest[k] = i;
    }
  for (size_t i = 0; i < n; i++)
    {
      size_t     k = component[i].label - 1;
      CeldRegion region;

      number[i] = component[i].label;
      if (k >= n_old || i == largest[k] || component[i].area < CELD_SPECK)
        continue;
      region       = palette->item[k];
      region.seeds = 0;
      if (celd_append_uncounted (palette->item, palette->n, region) != CELD_OK)
        {
          celd_free (largest);
          return CELD_NO_MEMORY;
        }
      number[i] = (uint32_t) palette->n;
    }
  celd_free (largest);
  return CELD_OK;
}

CeldStatus
celd_palette_copy (const CeldPalette *palette, CeldPalette *copy)
{
  *copy = (CeldPalette) { 0 };
  copy->item = celd_alloc (palette->n, sizeof *copy->item);
  if (!copy->item)
    return CELD_NO_MEMORY;
  if (palette->n)
    memcpy (copy->item, palette->item, palette->n * sizeof *copy->item);
  copy->n = palette->n;
  return CELD_OK;
}

CeldStatus
celd_separate (const CeldHost *host, CeldLabels *labels, CeldPalette *palette)
{
  CeldLabels     regions = { 0 };
  CeldComponent *component = NULL;
  uint32_t      *number = NULL;
  CeldPalette    made = { 0 };
  size_t         n = 0;
  CeldHostPart   part[2];
  CeldHost       first = celd_host_part (&part[0], host, 0, 0.5), second = celd_host_part (&part[1], host, 0.5, 1);
  CeldStatus     status;

  if (!CELD_SAME_SIZE (labels, labels))
    return CELD_BAD_SIZE;
  status = celd_labels_new (labels->width, labels->height, &regions);
  if (status == CELD_OK)
    status = celd_components (labels, 0, false, &first, &regions, &component, &n);
  if (status == CELD_OK)
    status = celd_palette_copy (palette, &made);
  if (status != CELD_OK)
    goto done;
  status = CELD_NO_MEMORY;
  number = celd_alloc (n, sizeof *number);
  if (!number)
    goto done;
  status = number_regions (component, n, &made, number);
  if (status != CELD_OK)
    goto done;
  for (size_t p = 0; p < (size_t) regions.width * (size_t) regions.height; p++)
    regions.data[p] = regions.data[p] ? number[regions.data[p] - 1] : 0;
  status = celd_palette_measure (&regions, NULL, &second, &made);
  if (status == CELD_OK)
    status = celd_progress (host, 1);
  if (status != CELD_OK)
    goto done;
  for (int y = 0; y < labels->height; y++)
    memcpy (&CELD_AT (labels, 0, y), &CELD_AT (&regions, 0, y), (size_t) labels->width * sizeof *labels->data);
  celd_palette_clear (palette);
  *palette = made;
  made     = (CeldPalette) { 0 };

done:
  celd_free (regions.data);
  celd_free (component);
  celd_free (number);
  celd_palette_clear (&made);
  return status;
}

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

/* ------------------------------------------------------------------ the background */

/* The largest difference of any channel. */
static int
colour_error (const uint8_t a[3], const uint8_t b[3])
{
  int error = 0;

  for (int i = 0; i < 3; i++)
    if (abs (a[i] - b[i]) > error)
      error = abs (a[i] - b[i]);
  return error;
}

uint32_t
celd_palette_find (const CeldPalette *palette, const uint8_t colour[3])
{
  uint32_t label = 0;
  int      least = COLOUR_ERROR + 1;

  for (size_t k = 0; k < palette->n; k++)
    {
      const uint8_t *c = palette->item[k].colour;

      if (c[3] && colour_error (c, colour) < least)
        {
          least = colour_error (c, colour);
          label = (uint32_t) k + 1;
        }
    }
  return label;
}

/* The most frequent label of the paper along the picture's edge. */
static CeldStatus
frame_label (const CeldLabels *labels, const CeldPlane *ink, size_t n_labels, uint32_t *label)
{
  size_t    *pixel = NULL, n = 0, most = 0, *count = celd_alloc0 (n_labels + 1, sizeof *count);
  CeldStatus status = count ? celd_frame (ink, labels->width, labels->height, 0, &pixel, &n) : CELD_NO_MEMORY;

  if (status != CELD_OK)
    goto done;
  for (size_t i = 0; i < n; i++)
    {
      uint32_t l = CELD_AT (labels, pixel[i] % (size_t) labels->width, pixel[i] / (size_t) labels->width);

      if (l >= 1 && l <= n_labels && ++count[l] > most)
        {
          most   = count[l];
          *label = l;
        }
    }

done:
  celd_free (count);
  celd_free (pixel);
  return status;
}

CeldStatus
celd_background_mark (const CeldLabels *labels, const CeldPlane *ink, const CeldSettings *settings,
                      CeldPalette *palette)
{
  uint32_t   label = 0;
  CeldStatus status = CELD_OK;

  if (!CELD_SAME_SIZE (labels, labels) || (ink && !CELD_SAME_SIZE (labels, ink)))
    return CELD_BAD_SIZE;
  for (size_t k = 0; k < palette->n && !label; k++)
    if (palette->item[k].origin == CELD_FROM_BACKGROUND)
      label = (uint32_t) k + 1;
  if (!label && settings->background == CELD_BACKGROUND_AUTO)
    status = frame_label (labels, ink, palette->n, &label);
  if (settings->background == CELD_BACKGROUND_COLOUR)
    label = celd_palette_find (palette, settings->background_colour);
  if (status != CELD_OK)
    return status;
  for (size_t k = 0; k < palette->n; k++)
    palette->item[k].background = k + 1 == label && settings->background != CELD_BACKGROUND_NONE;
  return CELD_OK;
}
