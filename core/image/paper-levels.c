/* How light the paper of a drawing is.
 *
 * The paper level is a high quantile in each tile; tiles without paper (solid ink) are filled in from their neighbours;
 * between tiles it is interpolated bilinearly.  White paper has a level of exactly 1.  Cost: O(pixels); no memory but
 * for the tiles and the values of one.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/ink-steps.h"

#include <math.h>
#include <string.h>

#define DARKEST  1e-3f         /* least paper level, because values are divided by it; chosen */
#define ABREAST  8             /* sums that are formed side by side; chosen */

enum { WHITE_BIN = CELD_INK_BINS - 1, EDGE_BIN /* of values beside which there is an edge */ };

typedef struct
{
  int       side;          /* in pixels */
  int       width, height; /* in tiles */
  float    *level, *spare;
  uint16_t *bin;           /* of the values of a tile */
} Tiles;

/* The bins of values that differ little from the one to the left of them, EDGE_BIN for others. */
CELD_CLONES static void
find_flat_bins (const float *restrict value, const float *restrict before, int n, uint16_t *restrict bin)
{
  for (int x = 0; x < n; x++)
    bin[x] = fabsf (value[x] - before[x]) > 0.06f ? EDGE_BIN : (uint16_t) (value[x] * (CELD_INK_BINS - 1) + 0.5f);
}

CELD_CLONES static void
keep_bin (const float *restrict value, const uint16_t *restrict bin, int n, uint16_t which, float *restrict kept)
{
  for (int x = 0; x < n; x++)
    kept[x] = bin[x] == which ? value[x] : 0;
}

/* The sum of the values of a piece, at most CELD_RUN, that are in a bin. */
static float
sum_of_bin (const float *value, const uint16_t *bin, int n, uint16_t which)
{
  float kept[CELD_RUN] = { 0 }, sum[ABREAST] = { 0 };

  keep_bin (value, bin, n, which, kept);
  for (int x = 0; x < n; x += ABREAST)
    for (int k = 0; k < ABREAST; k++)
      sum[k] += kept[x + k];
  return (sum[0] + sum[1]) + (sum[2] + sum[3]) + ((sum[4] + sum[5]) + (sum[6] + sum[7]));
}

/* Whether n values are white. */
CELD_CLONES static bool
all_white (const float *value, int n)
{
  int others = 0;

  for (int x = 0; x < n; x++)
    others |= value[x] != 1;
  return !others;
}

/* Finds the bins of a row of a tile, n values from (x,y) on, and counts them. */
static void
count_row (const CeldPlane *value, int x, int y, int n, uint16_t *bin, unsigned of[CELD_INK_BANKS][EDGE_BIN + 1])
{
  const float *v = &CELD_AT (value, x, y);
  int          before = x > 0;

  if (all_white (v - before, n + before)) /* many are */
    {
      for (int i = 0; i < n; i++)
        bin[i] = WHITE_BIN;
      of[0][WHITE_BIN] += (unsigned) n;
      return;
    }
  find_flat_bins (v, v - before, 1, bin);
  find_flat_bins (v + 1, v, n - 1, bin + 1);
  for (int i = 0; i < n; i++)
    of[i % CELD_INK_BANKS][bin[i]]++;
}

/* The most frequent value among the lightest fifth of a tile's pixels, without edges; 0 if there are only edges. */
static float
upper_value (const Tiles *t, const CeldPlane *value, int left, int top)
{
  unsigned of[CELD_INK_BANKS][EDGE_BIN + 1] = { { 0 } }, all = 0, above = 0;
  int      width = left + t->side < value->width ? t->side : value->width - left, bin = WHITE_BIN, fullest;
  int      height = top + t->side < value->height ? t->side : value->height - top;
  double   sum = 0;

  for (int y = 0; y < height; y++)
    count_row (value, left, top + y, width, t->bin + y * width, of);
  for (int i = 0; i < CELD_INK_BINS; i++)
    {
      for (int k = 1; k < CELD_INK_BANKS; k++)
        of[0][i] += of[k][i];
      all += of[0][i];
    }
  if (!all)
    return 0;
  for (fullest = bin; 5 * (above += of[0][bin]) < all; bin--)
    if (of[0][bin] > of[0][fullest])
      fullest = bin;
  if (of[0][bin] > of[0][fullest])
    fullest = bin;
  for (int y = 0; y < height; y++)
    for (int x = 0; x < width; x += CELD_RUN)
      sum += (double) sum_of_bin (&CELD_AT (value, left + x, top + y), t->bin + y * width + x,
                                  width - x < CELD_RUN ? width - x : CELD_RUN, (uint16_t) fullest);
  return (float) (sum / of[0][fullest]);
}

/* Keeps the tiles whose level can be reached from the brightest tiles in small steps, as in shadows and vignettes; sets
 * the others, which are inside solid ink, to 0. */
static void
drop_inked_tiles (Tiles *t)
{
  float brightest = 0;
  bool  moved = true;

  for (int i = 0; i < t->width * t->height; i++)
    brightest = fmaxf (brightest, t->level[i]);
  for (int i = 0; i < t->width * t->height; i++)
    t->spare[i] = t->level[i] >= 0.9f * brightest ? t->level[i] : 0;
  while (moved)
    {
      moved = false;
      for (int y = 0; y < t->height; y++)
        for (int x = 0; x < t->width; x++)
          {
            int   i = y * t->width + x;
            float around = 0;

            if (t->spare[i] > 0)
              continue;
            around = fmaxf (around, x > 0 ? t->spare[i - 1] : 0);
            around = fmaxf (around, x < t->width - 1 ? t->spare[i + 1] : 0);
            around = fmaxf (around, y > 0 ? t->spare[i - t->width] : 0);
            around = fmaxf (around, y < t->height - 1 ? t->spare[i + t->width] : 0);
            if (around > 0 && t->level[i] >= 0.8f * around)
              {
                t->spare[i] = t->level[i];
                moved = true;
              }
          }
    }
  memcpy (t->level, t->spare, (size_t) t->width * (size_t) t->height * sizeof *t->level);
}

/* Mean of the known tiles among the 3x3 around (x,y); 0 if none is known. */
static float
mean_around (const Tiles *t, int x, int y)
{
  float sum = 0, n = 0;

  for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < t->height; v++)
    for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < t->width; u++)
      if (t->level[v * t->width + u] > 0)
        {
          sum += t->level[v * t->width + u];
          n++;
        }
  return n > 0 ? sum / n : 0;
}

/* Fills in unknown tiles from known neighbours until none is left. */
static void
fill_tiles (Tiles *t)
{
  size_t bytes = (size_t) t->width * (size_t) t->height * sizeof *t->level;
  bool   unknown = true;

  while (unknown)
    {
      unknown = false;
      for (int y = 0; y < t->height; y++)
        for (int x = 0; x < t->width; x++)
          {
            int i = y * t->width + x;

            t->spare[i] = t->level[i] > 0 ? t->level[i] : mean_around (t, x, y);
            unknown = unknown || t->spare[i] <= 0;
          }
      memcpy (t->level, t->spare, bytes);
    }
}

/* The first of the two tiles, of `n` in a row, between whose middles a pixel lies; *share is the weight of the second,
 * outside [0,1] beyond the middles of the outermost tiles: there the slope continues. */
static int
tile_before (int pixel, int side, int n, float *share)
{
  float place = ((float) pixel + 0.5f) / (float) side - 0.5f;
  int   tile = place > 0 ? (int) place : 0;

  if (tile > n - 2)
    tile = n > 1 ? n - 2 : 0;
  *share = n > 1 ? place - (float) tile : 0;
  return tile;
}

/* The levels of row y of the picture, interpolated bilinearly between the middles of tiles; t->spare is overwritten. */
static void
interpolate_row (const Tiles *t, int y, int width, float *row)
{
  float        v, inverse = 1 / (float) t->side, *level = t->spare;
  const float *l = t->level + tile_before (y, t->side, t->height, &v) * t->width;
  const float *below = t->height > 1 ? l + t->width : l;

  for (int i = 0; i < t->width; i++)
    level[i] = l[i] + v * (below[i] - l[i]);
  for (int i = 0, x = 0; x < width; i++)
    {
      bool  last = i >= t->width - 2;
      int   end = last ? width : (2 * i + 3) * t->side / 2;
      float rise = t->width > 1 ? (level[i + 1] - level[i]) * inverse : 0;
      float middle = ((float) i + 0.5f) * (float) t->side - 0.5f;

      for (; x < end; x++)
        {
          float value = level[i] + ((float) x - middle) * rise;

          row[x] = value > DARKEST ? value : DARKEST;
        }
    }
}

/* Fills in *t; the caller calls tiles_clear also after a failure. */
static CeldStatus
measure_tiles (const CeldPlane *value, Tiles *t)
{
  int    smaller = value->width < value->height ? value->width : value->height;
  size_t n;

  *t = (Tiles) { .side = smaller / 24 < 16 ? 16 : smaller / 24 };
  t->width = (value->width + t->side - 1) / t->side;
  t->height = (value->height + t->side - 1) / t->side;
  n = (size_t) t->width * (size_t) t->height;
  t->level = celd_alloc (n, sizeof *t->level);
  t->spare = celd_alloc (n, sizeof *t->spare);
  t->bin = celd_alloc ((size_t) t->side * (size_t) t->side, sizeof *t->bin);
  if (!t->level || !t->spare || !t->bin)
    return CELD_NO_MEMORY;
  for (int y = 0; y < t->height; y++)
    for (int x = 0; x < t->width; x++)
      t->level[y * t->width + x] = fmaxf (upper_value (t, value, x * t->side, y * t->side), DARKEST);
  drop_inked_tiles (t);
  fill_tiles (t);
  return CELD_OK;
}

static void
tiles_clear (Tiles *t)
{
  celd_free (t->level);
  celd_free (t->spare);
  celd_free (t->bin);
}

CeldStatus
celd_paper_levels (const CeldPlane *value, CeldPlane *paper)
{
  Tiles      t;
  CeldStatus status = measure_tiles (value, &t);

  for (int y = 0; y < paper->height && status == CELD_OK; y++)
    interpolate_row (&t, y, paper->width, &CELD_AT (paper, 0, y));
  tiles_clear (&t);
  return status;
}

CELD_CLONES static void
compare_with_paper (const float *restrict paper, int n, float *restrict value)
{
  for (int x = 0; x < n; x++)
    value[x] = celd_most (1 - value[x] / paper[x], 0);
}

CeldStatus
celd_paper_contrast (CeldPlane *value)
{
  Tiles      t;
  CeldStatus status = measure_tiles (value, &t);
  float     *row = celd_alloc ((size_t) value->width, sizeof *row);

  if (!row)
    status = CELD_NO_MEMORY;
  for (int y = 0; y < value->height && status == CELD_OK; y++)
    {
      interpolate_row (&t, y, value->width, row);
      compare_with_paper (row, value->width, &CELD_AT (value, 0, y));
    }
  celd_free (row);
  tiles_clear (&t);
  return status;
}
