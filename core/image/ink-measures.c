/* What steps need to know about the ink of a drawing: the width of its strokes, the paper nearest to a point, and the
 * paper along the edge of the picture, by which the background is recognised.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"

#include <string.h>

#define LONGEST_RUN   256         /* pixels; longer runs count as this long; chosen */
#define STRIP_COLUMNS 4096        /* of a strip, whose rows fit into the cache; chosen */
#define INWARDS       4           /* stroke widths, to where paper inside a drawn frame is looked for; chosen */

/* ------------------------------------------------------------------ the width of strokes */

/* A strip of columns, processed row by row, so that the drawing is read once for runs along rows and columns. */
typedef struct
{
  const CeldPlane *ink;
  int              left, width;
  uint8_t          inked[2][STRIP_COLUMNS + 1]; /* the current row and the one above; the last element is paper */
  int              begin[STRIP_COLUMNS];        /* of each column: the row in which its last run began */
  size_t          *runs;                        /* the number of runs of each length */
} Strip;

CELD_CLONES static void
read_row (const float *restrict ink, int n, uint8_t *restrict inked)
{
  for (int x = 0; x < n; x++)
    inked[x] = !celd_is_paper (ink[x]);
}

/* The first index from x on where two rows differ; n if they do not. */
static inline int
next_difference (const uint8_t *a, const uint8_t *b, int x, int n)
{
  uint64_t p, q;

  for (; x + 8 <= n; x += 8)
    {
      memcpy (&p, a + x, sizeof p);
      memcpy (&q, b + x, sizeof q);
      if (p != q)
        break;
    }
  while (x < n && a[x] == b[x])
    x++;
  return x;
}

static void
count_run (const Strip *s, int length)
{
  s->runs[length < LONGEST_RUN ? length : LONGEST_RUN]++;
}

/* How many pixels a run of row y continues beyond the end of the strip, at most LONGEST_RUN. */
static int
length_beyond (const Strip *s, int y)
{
  int n = 0, x = s->left + s->width;

  while (n < LONGEST_RUN && x + n < s->ink->width && !celd_is_paper (CELD_AT (s->ink, x + n, y)))
    n++;
  return n;
}

/* Counts the runs of row y that begin in the strip. */
static void
count_along_row (const Strip *s, int y, const uint8_t *inked)
{
  bool goes_on = s->left > 0 && !celd_is_paper (CELD_AT (s->ink, s->left - 1, y));

  for (int x = 0, end; x < s->width; x = end)
    {
      end = next_difference (inked, inked + 1, x, s->width) + 1;
      if (inked[x] && (x > 0 || !goes_on))
        count_run (s, end - x + (end == s->width ? length_beyond (s, y) : 0));
    }
}

/* Counts the vertical runs that end above row y, and notes those that begin in it. */
static void
count_down_columns (Strip *s, int y, const uint8_t *inked, const uint8_t *above)
{
  for (int x = next_difference (inked, above, 0, s->width); x < s->width;
       x = next_difference (inked, above, x + 1, s->width))
    if (inked[x])
      s->begin[x] = y;
    else
      count_run (s, y - s->begin[x]);
}

static void
count_strip (const CeldPlane *ink, int left, size_t runs[LONGEST_RUN + 1])
{
  int   width = ink->width - left < STRIP_COLUMNS ? ink->width - left : STRIP_COLUMNS;
  Strip s = { .ink = ink, .left = left, .width = width, .runs = runs };

  for (int y = 0; y < ink->height; y++)
    {
      read_row (&CELD_AT (ink, left, y), s.width, s.inked[y & 1]);
      count_along_row (&s, y, s.inked[y & 1]);
      count_down_columns (&s, y, s.inked[y & 1], s.inked[~y & 1]);
    }
  memset (s.inked[ink->height & 1], 0, STRIP_COLUMNS);
  count_down_columns (&s, ink->height, s.inked[ink->height & 1], s.inked[~ink->height & 1]);
}

int
celd_stroke_width (const CeldPlane *ink)
{
  size_t runs[LONGEST_RUN + 1] = { 0 }, all = 0, below = 0;
  int    width = 0;

  for (int left = 0; left < ink->width; left += STRIP_COLUMNS)
    count_strip (ink, left, runs);
  for (int i = 1; i <= LONGEST_RUN; i++)
    all += runs[i];
  while (width < LONGEST_RUN && 2 * below < all)
    below += runs[++width];
  return width;
}

/* ------------------------------------------------------------------ paper near a point, and along the edge */

bool
celd_paper_near (const CeldPlane *ink, int radius, int *x, int *y)
{
  int  px = *x, py = *y, least = radius * radius + 1;
  bool found = false;

  for (int v = py - radius < 0 ? 0 : py - radius; v <= py + radius && v < ink->height; v++)
    for (int u = px - radius < 0 ? 0 : px - radius; u <= px + radius && u < ink->width; u++)
      {
        int squared = (u - px) * (u - px) + (v - py) * (v - py);

        if (squared >= least || !celd_is_paper (CELD_AT (ink, u, v)))
          continue;
        least = squared;
        found = true;
        *x    = u;
        *y    = v;
      }
  return found;
}

/* An outermost pixel, and the direction inwards. */
typedef struct { int x, y, dx, dy; } EdgePixel;

static EdgePixel
outermost (int width, int height, size_t i)
{
  size_t w = (size_t) width, h = (size_t) height;

  if (i < w)
    return (EdgePixel) { (int) i, 0, 0, 1 };
  if (i < 2 * w)
    return (EdgePixel) { (int) (i - w), height - 1, 0, -1 };
  if (i < 2 * w + h)
    return (EdgePixel) { 0, (int) (i - 2 * w), 1, 0 };
  return (EdgePixel) { width - 1, (int) (i - 2 * w - h), -1, 0 };
}

/* Lists the first paper inwards from each outermost pixel, at most `most` pixels away; returns how many there are. */
static size_t
look_inwards (const CeldPlane *ink, int width, int height, int most, size_t *pixel)
{
  size_t n = 0, all = 2 * ((size_t) width + (size_t) height);

  for (size_t i = 0; i < all; i++)
    {
      EdgePixel s = outermost (width, height, i);

      for (int k = 0; k <= most && s.x >= 0 && s.y >= 0 && s.x < width && s.y < height; k++, s.x += s.dx, s.y += s.dy)
        if (!ink || celd_is_paper (CELD_AT (ink, s.x, s.y)))
          {
            pixel[n++] = (size_t) s.y * (size_t) width + (size_t) s.x;
            break;
          }
    }
  return n;
}

CeldStatus
celd_frame (const CeldPlane *ink, int width, int height, int stroke, size_t **pixel, size_t *n)
{
  size_t all = 2 * ((size_t) width + (size_t) height);

  *pixel = celd_alloc (all, sizeof **pixel);
  if (!*pixel)
    return CELD_NO_MEMORY;
  *n = look_inwards (ink, width, height, 0, *pixel);
  if (ink && *n < all / 10)
    *n = look_inwards (ink, width, height, INWARDS * (stroke ? stroke : celd_stroke_width (ink)) + 2, *pixel);
  return CELD_OK;
}
