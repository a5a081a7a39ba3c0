/* Label pictures as colours and back, separate regions, measures, and the background by the frame.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "image/image.h"

static CeldPalette
palette_of (size_t n)
{
  CeldPalette p = { calloc (n, sizeof (CeldRegion)), n };

  for (size_t k = 0; k < n; k++)
    p.item[k] = (CeldRegion) { .colour = { (uint8_t) (10 * k + 5), (uint8_t) (200 - k), 77, 255 }, .seeds = 9 };
  return p;
}

static CeldPaint
new_paint (int width, int height)
{
  return (CeldPaint) { width, height, (size_t) width + 3, calloc (4 * (size_t) (width + 3) * (size_t) height, 1) };
}

/* ------------------------------------------------------------------ colours */

static void
painting_and_reading_back (void)
{
  const char *const rows[] = { "AABBB", "AACCC", "0ACCC", NULL };
  CeldLabels  labels = art_labels (rows), back = art_labels (rows);
  CeldPalette palette = palette_of (3), read = { 0 };
  CeldPaint   paint = new_paint (5, 3);

  CHECK (celd_labels_paint (&labels, &palette, &paint) == CELD_OK);
  CHECK (CELD_RGBA (&paint, 3, 1)[0] == 25 && CELD_RGBA (&paint, 3, 1)[1] == 198 && CELD_RGBA (&paint, 3, 1)[3] == 255);
  CHECK (CELD_RGBA (&paint, 0, 2)[3] == 0);
  CHECK (celd_labels_read (&paint, &back, &read) == CELD_OK);
  CHECK (read.n == 4);
  CHECK (read.item[0].area == 6 && read.item[0].colour[0] == 25);          /* C is largest */
  CHECK (read.item[1].area == 5 && read.item[1].colour[0] == 5);
  CHECK (read.item[2].area == 3 && read.item[2].colour[0] == 15);
  CHECK (read.item[3].origin == CELD_FROM_BACKGROUND && read.item[3].background && read.item[3].colour[3] == 0);
  CHECK (CELD_AT (&back, 4, 2) == 1 && CELD_AT (&back, 0, 0) == 2);
  CHECK (CELD_AT (&back, 4, 0) == 3 && CELD_AT (&back, 0, 2) == 4);
  celd_palette_clear (&read);
  celd_palette_clear (&palette);
  free (paint.data), free (labels.data), free (back.data);
}

static void
thousands_of_colours (void)
{
  CeldPaint   paint = new_paint (100, 50);
  CeldLabels  labels = { 100, 50, 100, calloc (5000, sizeof (uint32_t)) };
  CeldPalette palette = { 0 };
  int         bad = 0;

  for (int y = 0; y < 50; y++)
    for (int x = 0; x < 100; x++)
      {
        const uint8_t c[4] = { (uint8_t) x, (uint8_t) (y / 2), 9, 255 };

        memcpy (CELD_RGBA (&paint, x, y), c, 4);
      }
  CHECK (celd_labels_read (&paint, &labels, &palette) == CELD_OK);
  CHECK (palette.n == 2500);
  for (int y = 0; y < 50; y++)
    for (int x = 0; x < 100; x++)
      {
        const CeldRegion *region = &palette.item[CELD_AT (&labels, x, y) - 1];

        bad += region->colour[0] != x || region->area != 2;
      }
  CHECK (bad == 0);
  celd_palette_clear (&palette);
  free (paint.data), free (labels.data);
}

static void
the_nearest_colour_counts (void)
{
  CeldRegion    region[3] = {
    { .colour = { 0, 0, 0, 0 } }, { .colour = { 2, 1, 0, 255 } }, { .colour = { 1, 0, 0, 255 } }
  };
  CeldPalette   palette = { region, 3 };
  const uint8_t exact[3] = { 2, 1, 0 }, black[3] = { 0 }, far[3] = { 0, 4, 0 };

  CHECK (celd_palette_find (&palette, exact) == 2);
  CHECK (celd_palette_find (&palette, black) == 3); /* neither the transparent one nor the first that would do */
  CHECK (celd_palette_find (&palette, far) == 0);
}

/* ------------------------------------------------------------------ regions */

static void
measures (void)
{
  const char *const rows[] = {
    "AAAAAAAAA",
    "AAAAAAAAA",
    "AABBBBBAA",
    "AABBBBBAA",
    "AABBBBBAA",
    "AABBBBBAA",
    "AABBBBBAA",
    "AAAAAAAAA",
    "AAAAAAAAA", NULL };
  CeldLabels  labels = art_labels (rows);
  CeldPalette palette = palette_of (3);

  CHECK (celd_palette_measure (&labels, NULL, NULL, &palette) == CELD_OK);
  CHECK (palette.item[1].area == 25 && palette.item[1].x == 4 && palette.item[1].y == 4);
  CHECK (palette.item[0].area == 56 && CELD_AT (&labels, palette.item[0].x, palette.item[0].y) == 1);
  CHECK (palette.item[2].area == 0 && palette.item[2].x == -1 && palette.item[2].y == -1);
  celd_palette_clear (&palette);
  free (labels.data);
}

static void
separate_regions (void)
{
  const char *const rows[] = {
    "AAAAAABBBBBBBAAAAA",
    "AAAAAABBBBBBBAAAAA",
    "AAAAAABBABBBBAAAAA",
    "AAAAAABBBBBBBAAAAA", NULL };
  CeldLabels  labels = art_labels (rows);
  CeldPalette palette = palette_of (2);

  CHECK (celd_separate (NULL, &labels, &palette) == CELD_OK);
  CHECK (palette.n == 3);
  CHECK (CELD_AT (&labels, 0, 0) == 1);          /* the largest A keeps its number */
  CHECK (CELD_AT (&labels, 17, 3) == 3);
  CHECK (CELD_AT (&labels, 8, 2) == 1);          /* a speck stays with it */
  CHECK (CELD_AT (&labels, 7, 1) == 2);
  CHECK (!memcmp (palette.item[2].colour, palette.item[0].colour, 4));
  CHECK (palette.item[0].area == 25 && palette.item[1].area == 27 && palette.item[2].area == 20);
  CHECK (CELD_AT (&labels, palette.item[2].x, palette.item[2].y) == 3);
  celd_palette_clear (&palette);
  free (labels.data);
}

/* ------------------------------------------------------------------ background */

static const char *const figure[] = {
  "AAAAAAAA",
  "AABBBBBB",
  "AABBBBBB",
  "AAAAAAAA", NULL };

static uint32_t
marked (CeldSettings settings, const CeldPlane *ink, CeldPalette *palette)
{
  CeldLabels labels = art_labels (figure);
  uint32_t   label = 0;

  CHECK (celd_background_mark (&labels, ink, &settings, palette) == CELD_OK);
  for (size_t k = 0; k < palette->n; k++)
    if (palette->item[k].background)
      label = label ? 99 : (uint32_t) k + 1;
  free (labels.data);
  return label;
}

static void
background_by_the_frame (void)
{
  const char *const inked[] = { "######..", "######..", "######..", "######..", NULL };
  CeldSettings settings = celd_settings ();
  CeldPalette  palette = palette_of (2);
  CeldPlane    ink = art_plane (inked);

  CHECK (marked (settings, NULL, &palette) == 1);
  CHECK (marked (settings, &ink, &palette) == 1); /* 4 of its pixels are paper, and 4 corners count twice */
  settings.background = CELD_BACKGROUND_NONE;
  CHECK (marked (settings, NULL, &palette) == 0);
  settings.background = CELD_BACKGROUND_COLOUR;
  settings.background_colour[0] = 16, settings.background_colour[1] = 198, settings.background_colour[2] = 77;
  CHECK (marked (settings, NULL, &palette) == 2); /* off by one of 255 */
  settings.background = CELD_BACKGROUND_AUTO;
  palette.item[1].origin = CELD_FROM_BACKGROUND;
  CHECK (marked (settings, NULL, &palette) == 2);
  celd_palette_clear (&palette);
  free (ink.data);
}

static size_t
frame_pixels (const char *const *rows)
{
  CeldPlane ink = art_plane (rows);
  size_t   *pixel = NULL, n = 0;
  int       bad = 0;

  CHECK (celd_frame (&ink, ink.width, ink.height, 0, &pixel, &n) == CELD_OK);
  for (size_t i = 0; i < n; i++)
    bad += !celd_is_paper (ink.data[pixel[i]]);
  CHECK (!bad);
  celd_free (pixel);
  free (ink.data);
  return n;
}

static void
paper_along_the_frame (void)
{
  const char *const open[] = { ".....", ".###.", ".....", NULL };
  const char *const drawn[] = { "######", "#....#", "#....#", "######", NULL };
  const char *const dark[] = { "##", "##", NULL };

  CHECK (frame_pixels (open) == 16);   /* two rows of 5, two columns of 3 */
  CHECK (frame_pixels (drawn) == 12);  /* behind the frame: two rows of 4, two columns of 2 */
  CHECK (frame_pixels (dark) == 0);
}

static void
bad_sizes (void)
{
  CeldLabels   labels = art_labels (figure), none = { 0 };
  CeldPaint    paint = new_paint (7, 4);
  CeldPalette  palette = palette_of (2);
  CeldSettings settings = celd_settings ();

  CHECK (celd_labels_paint (&labels, &palette, &paint) == CELD_BAD_SIZE);
  CHECK (celd_labels_read (&paint, &labels, &palette) == CELD_BAD_SIZE);
  CHECK (celd_separate (NULL, &none, &palette) == CELD_BAD_SIZE);
  CHECK (celd_background_mark (&none, NULL, &settings, &palette) == CELD_BAD_SIZE);
  CHECK (palette.n == 2 && palette.item[0].seeds == 9);
  celd_palette_clear (&palette);
  free (labels.data), free (paint.data);
}

int
main (void)
{
  RUN (painting_and_reading_back);
  RUN (thousands_of_colours);
  RUN (the_nearest_colour_counts);
  RUN (measures);
  RUN (separate_regions);
  RUN (background_by_the_frame);
  RUN (paper_along_the_frame);
  RUN (bad_sizes);
  return DONE;
}
