/* Grey morphology of bytes with square windows: erosion along rows and then along columns.
 *
 * Along a row the least of windows of 1, 2, 4, ... values is taken in turn, and that of any other window is the lesser
 * of two of these that overlap.  Along columns rows are taken in blocks as high as the window, as van Herk (1992) and
 * Gil and Werman (1993) do: a window is the end of one block and the beginning of the next, so that each row is
 * compared three times, whatever the radius.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"

#include <string.h>

size_t
celd_erosion_work (int width, int radius)
{
  return (4 * (size_t) radius + 4) * ((size_t) width + 2 * (size_t) radius);
}

/* Replaces values by the least of two that are `step` apart. */
static inline void
take_lesser (uint8_t *value, size_t step, size_t n)
{
  for (size_t i = 0; i + step < n; i++)
    value[i] = value[i] < value[i + step] ? value[i] : value[i + step];
}

/* The erosion along a row; `invert` has the bits that are inverted first.  `line` has room for width + 2 radius. */
CELD_CLONES static void
erode_row (const uint8_t *row, size_t width, size_t radius, uint8_t invert, uint8_t *restrict line,
           uint8_t *restrict eroded)
{
  size_t window = 2 * radius + 1, span;

  memset (line, UINT8_MAX, radius);
  for (size_t x = 0; x < width; x++)
    line[radius + x] = row[x] ^ invert;
  memset (line + radius + width, UINT8_MAX, radius);
  for (span = 1; 2 * span <= window; span *= 2)
    take_lesser (line, span, width + 2 * radius);
  for (size_t x = 0; x < width; x++)
    eroded[x] = line[x] < line[x + window - span] ? line[x] : line[x + window - span];
}

CELD_CLONES static void
least_of_rows (const uint8_t *restrict other, size_t width, uint8_t *restrict row)
{
  for (size_t x = 0; x < width; x++)
    row[x] = row[x] < other[x] ? row[x] : other[x];
}

CELD_CLONES static void
write_least (const uint8_t *restrict a, const uint8_t *restrict b, size_t width, uint8_t invert, uint8_t *restrict row)
{
  for (size_t x = 0; x < width; x++)
    row[x] = (a[x] < b[x] ? a[x] : b[x]) ^ invert;
}

/* The erosion along its row of a row, which may lie outside of the picture. */
static void
take_row (const CeldMask *mask, int y, int radius, uint8_t invert, uint8_t *line, uint8_t *row)
{
  if (y < 0 || y >= mask->height)
    memset (row, UINT8_MAX, (size_t) mask->width);
  else
    erode_row (&CELD_AT (mask, 0, y), (size_t) mask->width, (size_t) radius, invert, line, row);
}

/* Erosion, or dilation with `invert` UINT8_MAX.  `to` may be `from`: each row is read before it is written. */
static void
erode (const CeldMask *from, int radius, uint8_t invert, uint8_t *work, CeldMask *to)
{
  size_t   width = (size_t) from->width, block = (2 * (size_t) radius + 1) * width;
  uint8_t *ends = work, *next = ends + block, *least = next + block, *line = least + width;
  int      window = 2 * radius + 1;

  for (int i = 0; i < window; i++)
    take_row (from, i - radius, radius, invert, line, next + (size_t) i * width);
  for (int top = 0; top < to->height; top += window)
    {
      uint8_t *spare = ends;

      ends = next;
      next = spare;
      for (int i = window - 2; i >= 0; i--)
        least_of_rows (ends + (size_t) (i + 1) * width, width, ends + (size_t) i * width);
      memset (least, UINT8_MAX, width);
      for (int i = 0; i < window && top + i < to->height; i++)
        {
          if (i > 0)
            least_of_rows (next + (size_t) (i - 1) * width, width, least);
          write_least (least, ends + (size_t) i * width, width, invert, &CELD_AT (to, 0, top + i));
          take_row (from, top + window + i - radius, radius, invert, line, next + (size_t) i * width);
        }
    }
}

void
celd_erode_bytes (CeldMask *mask, int radius, void *work)
{
  erode (mask, radius, 0, work, mask);
}

void
celd_dilate_bytes (CeldMask *mask, int radius, void *work)
{
  erode (mask, radius, UINT8_MAX, work, mask);
}

void
celd_close_bytes (const CeldMask *mask, int radius, void *work, CeldMask *closed)
{
  erode (mask, radius, UINT8_MAX, work, closed);
  erode (closed, radius, 0, work, closed);
}

void
celd_invert_bytes (CeldMask *mask)
{
  size_t   n = (size_t) mask->width * (size_t) mask->height;
  uint8_t *value = mask->data; /* not read anew for each byte, which could have changed it */

  for (size_t i = 0; i < n; i++)
    value[i] = (uint8_t) ~value[i];
}
