/* Label pictures: measuring labels, separating the connected components of a label, finding the background.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "image/image.h"

#include <stdlib.h>
#include <string.h>

#define COLOUR_ERROR 2 /* of 255 in each channel, what colour management may change an opaque colour by; chosen */

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
  int32_t   *squared = celd_alloc (n, sizeof *squared), *farthest = celd_alloc (palette->n, sizeof *farthest);
  CeldStatus status = CELD_NO_MEMORY;

  if (!border || !squared || !farthest)
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
      farthest[k] = -1;
    }
  for (int y = 0; y < h; y++)
    for (int x = 0; x < w; x++)
      {
        uint32_t    l = CELD_AT (labels, x, y);
        int32_t     away = squared[(size_t) y * (size_t) w + (size_t) x];
        CeldRegion *region;

        if (l < 1 || l > palette->n)
          continue;
        region = &palette->item[l - 1];
        region->area++;
        if (away <= farthest[l - 1])
          continue;
        farthest[l - 1] = away;
        region->x      = x;
        region->y      = y;
      }

done:
  celd_free (border);
  celd_free (squared);
  celd_free (farthest);
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

bool
celd_labels_beyond (const CeldLabels *labels, size_t n)
{
  for (int y = 0; y < labels->height; y++)
    for (int x = 0; x < labels->width; x++)
      if (CELD_AT (labels, x, y) > n)
        return true;
  return false;
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

/* The first label whose colour is nearest, if no channel differs by more than `most`; 0: there is none. */
static uint32_t
nearest_label (const CeldPalette *palette, const uint8_t colour[3], int most)
{
  uint32_t label = 0;
  int      least = most + 1;

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

uint32_t
celd_palette_find (const CeldPalette *palette, const uint8_t colour[3])
{
  return nearest_label (palette, colour, COLOUR_ERROR);
}

uint32_t
celd_palette_nearest (const CeldPalette *palette, const uint8_t colour[3])
{
  return nearest_label (palette, colour, 255);
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
