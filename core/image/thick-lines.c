/* Thick strokes of a coloured drawing: what is much darker than what lies on both sides of it, within a wide window,
 * and not lighter than that: then it is a fill between lines.  Between two fills each channel may be dark in one of them;
 * the distance from the colour of lines, if they have one, is not.
 *
 * Of each channel, each pixel is compared with the closing and the opening of squares of 2 x 2 pixels: for a wide
 * window they are as good as those of pixels, at a quarter of the cost.  For the closing a square is as light as its
 * lightest pixel, so squares at the edge of a dark area count as light; therefore it is eroded by one square more.  For
 * the opening it is the other way round: it is the inverted closing of the inverted channel.
 *
 * Cost: O(pixels).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/coloured-steps.h"

#include <string.h>

#define MUCH_DARKER   1 /* much darker than the closing in some channel */
#define BETWEEN_LINES 2 /* lighter than the opening in some channel */

/* How pixels are compared with closed squares. */
typedef struct
{
  uint8_t invert;         /* bits of all values that are inverted first: all of them or none */
  uint8_t mark;           /* of a pixel that is darker than its limit, of inverted values */
  uint8_t limit[256];     /* by the value of the closed square */
} Comparison;

/* A pixel of value v is much darker than its closing, c, if 2 (c - v) >= max (c, CELD_DARKEST_FILL). */
static Comparison
with_closing (void)
{
  Comparison comparison = { .mark = MUCH_DARKER };

  for (int closed = 0; closed < 256; closed++)
    {
      int paper = closed > CELD_DARKEST_FILL ? closed : CELD_DARKEST_FILL, least = (paper + 1) / 2;

      comparison.limit[closed] = (uint8_t) (closed >= least ? closed - least + 1 : 0);
    }
  return comparison;
}

/* A pixel is lighter than its opening if their difference is at least faintest / 255 max (v, CELD_MIDDLE_FILL). */
static Comparison
with_opening (int faintest)
{
  Comparison comparison = { .invert = 255, .mark = BETWEEN_LINES };
  int        limit = 0; /* it grows with the closing */

  for (int closed = 0; closed < 256; closed++)
    {
      for (; limit < 255; limit++)
        {
          int value = 255 - limit, paper = value > CELD_MIDDLE_FILL ? value : CELD_MIDDLE_FILL;

          if (255 * (closed - limit) < faintest * paper)
            break;
        }
      comparison.limit[closed] = (uint8_t) limit;
    }
  return comparison;
}

/* The lightest pixel of each square in two rows. */
CELD_CLONES static void
halve_rows (const uint8_t *restrict upper, const uint8_t *restrict lower, int width, uint8_t invert,
            uint8_t *restrict half)
{
  for (int i = 0; i < width / 2; i++)
    {
      uint8_t a = upper[2 * i] ^ invert, b = lower[2 * i] ^ invert, left = a > b ? a : b;
      uint8_t c = upper[2 * i + 1] ^ invert, d = lower[2 * i + 1] ^ invert, right = c > d ? c : d;

      half[i] = left > right ? left : right;
    }
  if (width & 1)
    {
      uint8_t a = upper[width - 1] ^ invert, b = lower[width - 1] ^ invert;

      half[width / 2] = a > b ? a : b;
    }
}

/* The closing of the squares of a channel. */
static void
close_squares (const CeldMask *value, int radius, uint8_t invert, void *work, CeldMask *half)
{
  for (int y = 0; y < half->height; y++)
    {
      int lower = 2 * y + 1 < value->height ? 2 * y + 1 : 2 * y;

      halve_rows (&CELD_AT (value, 0, 2 * y), &CELD_AT (value, 0, lower), value->width, invert,
                  &CELD_AT (half, 0, y));
    }
  celd_dilate_bytes (half, radius / 2, work);
  celd_erode_bytes (half, radius / 2 + 1, work);
}

/* The limit of each pixel of two rows of pixels. */
static void
find_limits (const Comparison *comparison, const uint8_t *restrict half, int width, uint8_t *restrict limit)
{
  for (int i = 0; i < width / 2; i++)
    limit[2 * i] = limit[2 * i + 1] = comparison->limit[half[i]];
  if (width & 1)
    limit[width - 1] = comparison->limit[half[width / 2]];
}

CELD_CLONES static void
mark_darker (const uint8_t *restrict value, const uint8_t *restrict limit, int width, uint8_t invert, uint8_t mark,
             uint8_t *restrict thick)
{
  for (int x = 0; x < width; x++)
    thick[x] |= (uint8_t) (value[x] ^ invert) < limit[x] ? mark : 0;
}

static void
compare (const CeldMask *value, const Comparison *comparison, int radius, void *work, CeldMask *half, CeldMask *thick)
{
  uint8_t *limit = work;

  close_squares (value, radius, comparison->invert, work, half);
  for (int y = 0; y < thick->height; y++)
    {
      if (y % 2 == 0)
        find_limits (comparison, &CELD_AT (half, 0, y / 2), thick->width, limit);
      mark_darker (&CELD_AT (value, 0, y), limit, thick->width, comparison->invert, comparison->mark,
                   &CELD_AT (thick, 0, y));
    }
}

/* Keeps what is much darker, and no fill between lines; what has the colour of lines is none, although dark fills may be
 * darker than that in some channel. */
static void
keep_thick (const CeldMask *distance, CeldMask *thick)
{
  for (size_t i = 0; i < (size_t) thick->width * (size_t) thick->height; i++)
    thick->data[i] = thick->data[i] == MUCH_DARKER ||
                     (thick->data[i] && thick->data[i] != BETWEEN_LINES && distance && !distance->data[i]);
}

CeldStatus
celd_thick_lines (const CeldMask channel[3], const CeldMask *distance, int radius, int faintest, const CeldHost *host,
                  void *work, CeldMask *spare, CeldMask *thick)
{
  int        width = (thick->width + 1) / 2, height = (thick->height + 1) / 2;
  CeldMask   half = { width, height, (size_t) width, spare->data };
  Comparison closing = with_closing (), opening = with_opening (faintest);
  CeldStatus status = CELD_OK;

  memset (thick->data, 0, (size_t) thick->width * (size_t) thick->height);
  for (int c = 0; c < 3 && status == CELD_OK; c++)
    {
      compare (&channel[c], &closing, radius, work, &half, thick);
      compare (&channel[c], &opening, radius, work, &half, thick);
      status = celd_progress (host, (c + 1) / 3.0);
    }
  if (distance)
    compare (distance, &closing, radius, work, &half, thick);
  keep_thick (distance, thick);
  return status;
}
