/* The record of a basin graph: unions of its basins, and its paper as bits.
 *
 * The region that a person sees has many maxima, so it is many basins.  Passages between basins are visited from the
 * widest on.  Basins are merged over a passage unless both sides are clearly wider than it: corners and corridors join
 * their region, while a small region behind a gap stays separate, however large the picture.  A passage along the frame
 * separates nothing, as the page continues there.  Enclosures are merged basins joined over every passage wider than
 * two stroke widths, which is no gap in a contour.  Components are joined over any passage: connected paper.
 *
 * How many pixels of a run are paper is asked for every seed run after every stroke.  The drawing itself takes 32 times
 * as much memory as bits, and strokes lie all over it, so nearly every access to it misses the cache.  A byte holds 8
 * pixels of a row, and the bytes of 8 rows are stored together, so that 64 x 8 pixels share a cache line.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "image/image.h"
#include "segment/basin-steps.h"
#include "segment/basins.h"

#include <math.h>
#include <stdlib.h>

#define PACK 64 /* bytes converted at a time (chosen) */

void
celd_basins_count_areas (CeldBasins *basins)
{
  for (int y = 0; y < basins->height; y++)
    for (size_t i = basins->row[y], end = basins->row[y + 1]; i < end; i++)
      basins->basin[basins->run[i].basin].area +=
        (uint32_t) ((i + 1 < end ? basins->run[i + 1].x : basins->width) - basins->run[i].x);
}

void
celd_basins_clear (CeldBasins *basins)
{
  celd_free (basins->basin);
  celd_free (basins->boundary);
  celd_free (basins->row);
  celd_free (basins->run);
  celd_free (basins->paper);
  celd_free (basins->merged);
  celd_free (basins->enclosure);
  celd_free (basins->component);
  *basins = (CeldBasins) { 0 };
}

/* ------------------------------------------------------------------ unions of basins */

/* The unions so far (base/base.h), and the largest squared distance in each, by root. */
typedef struct { uint32_t *parent; int32_t *widest; } Unions;

static void
join (Unions *unions, uint32_t a, uint32_t b)
{
  int32_t *widest = unions->widest;

  a = celd_root (unions->parent, a);
  b = celd_root (unions->parent, b);
  widest[a] = widest[b] = widest[a] > widest[b] ? widest[a] : widest[b];
  celd_join (unions->parent, a, b);
}

static int32_t
width_of (const CeldBasinBoundary *boundary)
{
  return boundary->frame ? INT32_MAX : boundary->saddle;
}

/* The widest first; ties by number. */
static int
compare_widths (const void *a, const void *b)
{
  const CeldBasinBoundary *p = *(const CeldBasinBoundary *const *) a, *q = *(const CeldBasinBoundary *const *) b;

  if (width_of (p) != width_of (q))
    return width_of (p) > width_of (q) ? -1 : 1;
  if (p->a != q->a)
    return p->a < q->a ? -1 : 1;
  return p->b < q->b ? -1 : p->b > q->b;
}

static bool
separates (Unions *unions, const CeldBasinBoundary *boundary)
{
  int32_t a = unions->widest[celd_root (unions->parent, boundary->a)];
  int32_t b = unions->widest[celd_root (unions->parent, boundary->b)];

  return !boundary->frame && celd_is_clearly_wider (sqrt (a < b ? a : b), sqrt (boundary->saddle));
}

/* Numbers the unions from 1 by their first basins; unless `all`, solid ones get 0.  Returns how many there are. */
static size_t
number_unions (const CeldBasins *basins, Unions *unions, bool all, uint32_t *number)
{
  uint32_t n = 0;

  for (uint32_t k = 0; k < basins->n; k++)
    {
      uint32_t first = celd_root (unions->parent, k);

      number[k] = !all && basins->basin[k].solid ? 0 : first == k ? ++n : number[first];
    }
  return n;
}

/* Lists the boundaries over which basins may be merged, the widest first; returns their number. */
static size_t
find_passages (const CeldBasins *basins, const CeldBasinBoundary **passage)
{
  size_t n = 0;

  for (size_t i = 0; i < basins->n_boundaries; i++)
    {
      const CeldBasinBoundary *boundary = &basins->boundary[i];

      if (boundary->opening || (basins->basin[boundary->a].solid && basins->basin[boundary->b].solid))
        passage[n++] = boundary;
    }
  if (n)
    qsort (passage, n, sizeof *passage, compare_widths);
  return n;
}

CeldStatus
celd_basins_merge (CeldBasins *basins)
{
  Unions                    unions = { celd_alloc (basins->n, sizeof (uint32_t)),
                                       celd_alloc (basins->n, sizeof (int32_t)) };
  const CeldBasinBoundary **passage = celd_alloc (basins->n_boundaries, sizeof *passage);
  int32_t                   open = basins->stroke * basins->stroke;
  CeldStatus                status = CELD_NO_MEMORY;
  size_t                    n;

  basins->merged = celd_alloc (basins->n, sizeof *basins->merged);
  basins->enclosure = celd_alloc (basins->n, sizeof *basins->enclosure);
  basins->component = celd_alloc (basins->n, sizeof *basins->component);
  if (!unions.parent || !unions.widest || !passage || !basins->merged || !basins->enclosure || !basins->component)
    goto done;
  celd_roots (unions.parent, basins->n);
  for (uint32_t k = 0; k < basins->n; k++)
    unions.widest[k] = basins->basin[k].squared;
  n = find_passages (basins, passage);
  for (size_t i = 0; i < n; i++)
    if (!separates (&unions, passage[i]))
      join (&unions, passage[i]->a, passage[i]->b);
  basins->n_merged = number_unions (basins, &unions, true, basins->merged);
  for (size_t i = 0; i < n; i++)
    if (passage[i]->opening && width_of (passage[i]) > open)
      join (&unions, passage[i]->a, passage[i]->b);
  basins->n_enclosures = number_unions (basins, &unions, false, basins->enclosure);
  for (size_t i = 0; i < n; i++)
    if (passage[i]->opening)
      join (&unions, passage[i]->a, passage[i]->b);
  basins->n_components = number_unions (basins, &unions, false, basins->component);
  status = CELD_OK;

done:
  celd_free (unions.parent);
  celd_free (unions.widest);
  celd_free (passage);
  return status;
}

/* ------------------------------------------------------------------ paper as bits */

/* The index of the byte with the pixels 8 column .. 8 column + 7 of row y. */
static inline size_t
byte_of (int width, int column, int y)
{
  return ((size_t) (y >> 3) * (size_t) ((width + 7) >> 3) + (size_t) column) << 3 | (size_t) (y & 7);
}

typedef struct { const CeldPlane *ink; uint8_t *bits; CeldRect rect; } PaperBits;

/* Sets n bytes to 1 for paper and 0 for ink, and pads with 0 to a multiple of 8. */
static void
find_paper (const float *restrict ink, int n, uint8_t *restrict paper)
{
  for (int i = 0; i < n; i++)
    paper[i] = celd_is_paper (ink[i]);
  for (int i = n; i & 7; i++)
    paper[i] = 0;
}

/* Packs eight such bytes into the bits of one, by a multiplication that moves them side by side. */
static uint8_t
pack (const uint8_t *paper)
{
  uint64_t b = paper[0] | (uint64_t) paper[1] << 8 | (uint64_t) paper[2] << 16 | (uint64_t) paper[3] << 24 |
               (uint64_t) paper[4] << 32 | (uint64_t) paper[5] << 40 | (uint64_t) paper[6] << 48 |
               (uint64_t) paper[7] << 56;

  return (uint8_t) (b * 0x0102040810204080 >> 56);
}

/* Reads a band of 8 rows: jobs share no cache line. */
static void
read_band (void *data, int band)
{
  const PaperBits *job = data;
  int              w = job->ink->width, first = job->rect.x >> 3, end = (job->rect.x + job->rect.width + 7) >> 3;
  int              top = (job->rect.y & ~7) + 8 * band, bottom = job->rect.y + job->rect.height;
  uint8_t          paper[8 * PACK];

  for (int y = top; y < top + 8 && y < bottom; y++)
    for (int column = first; column < end; column += PACK)
      {
        int      columns = end - column < PACK ? end - column : PACK;
        int      pixels = w - 8 * column < 8 * columns ? w - 8 * column : 8 * columns;
        uint8_t *bits = job->bits + byte_of (w, column, y);

        find_paper (&CELD_AT (job->ink, 8 * column, y), pixels, paper);
        for (int k = 0; k < columns; k++)
          bits[8 * k] = pack (paper + 8 * k);
      }
}

void
celd_paper_update (const CeldPlane *ink, const CeldRect *changed, const CeldHost *host, uint8_t *bits)
{
  PaperBits job = { ink, bits, *changed };

  if (changed->width > 0 && changed->height > 0)
    celd_parallel_for (host, ((changed->y + changed->height + 7) >> 3) - (changed->y >> 3), read_band, &job);
}

CeldStatus
celd_paper_new (const CeldPlane *ink, const CeldHost *host, uint8_t **bits)
{
  CeldRect all = { 0, 0, ink->width, ink->height };
  uint8_t *made = celd_alloc0 ((size_t) ((ink->width + 7) >> 3) * (size_t) ((ink->height + 7) >> 3), 8);

  if (!made)
    return CELD_NO_MEMORY;
  celd_paper_update (ink, &all, host, made);
  *bits = made;
  return CELD_OK;
}

static inline uint32_t
count_bits (unsigned byte)
{
  static const uint8_t of_half[16] = { 0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4 };

  return (uint32_t) of_half[byte & 15] + of_half[byte >> 4];
}

uint32_t
celd_paper_count (const CeldBasins *basins, int y, int x, int end)
{
  int            first = x >> 3, last = (end - 1) >> 3;
  const uint8_t *byte = basins->paper + byte_of (basins->width, first, y);
  unsigned       from_x = 0xffu << (x & 7) & 0xffu, to_end = 0xffu >> (7 - ((end - 1) & 7));
  uint32_t       n;

  if (x >= end)
    return 0;
  if (first == last)
    return count_bits (*byte & from_x & to_end);
  n = count_bits (*byte & from_x);
  for (byte += 8; ++first < last; byte += 8)
    n += count_bits (*byte);
  return n + count_bits (*byte & to_end);
}
