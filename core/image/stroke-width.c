/* The width of a drawing's strokes, and the paper nearest to a point on a stroke.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"

#include <string.h>

#define LONGEST_RUN   256  /* pixels; longer runs count as this long (chosen) */
#define STRIP_COLUMNS       4096

/* A strip of columns, processed row by row, so that the drawing is read once for runs along rows and columns. */
typedef struct
{
  const CeldPlane *ink;
  int              left, width;
  uint8_t          inked[2][STRIP_COLUMNS + 1];   /* the current row and the one above; the last element is paper */
  int              begin[STRIP_COLUMNS];          /* of each column: the row in which its last run began */
  size_t          *runs;                  /* the number of runs of each length */
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

bool
celd_paper_near (const CeldPlane *ink, int reach, int *x, int *y)
{
  int  px = *x, py = *y, least = reach * reach + 1;
  bool found = false;

  for (int v = py - reach < 0 ? 0 : py - reach; v <= py + reach && v < ink->height; v++)
    for (int u = px - reach < 0 ? 0 : px - reach; u <= px + reach && u < ink->width; u++)
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
