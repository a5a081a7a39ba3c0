/* A stack of regions with blurred boundaries, back to front (section 5, Figures 1d and 5c).
 *
 * Each level k is drawn opaque over those behind it, and first takes the fraction  strength s(k,j) A_k  of the light of
 * each level j behind it.  A_k is the level's matte blurred by a Gaussian and moved away from the light; s grows with
 * the distance in depth between k and j.  So a pixel of level j keeps the product of  1 - strength s A_k  over all
 * nearer k, and no picture has to be drawn over another.
 *
 * Mattes are blurred on cells (image/blur.c), each within its own bounding box.  Each cell then lists the few levels
 * near it, and the light of a pixel is interpolated between four cells.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/vector.h"
#include "image/image.h"
#include "light/shadows.h"

#include <stdlib.h>

#define FAINT_MATTE       (1.0f / 1024)    /* a smaller matte is ignored (chosen) */

/* A level's matte in one cell. */
typedef struct { uint32_t cell; uint8_t level; float matte; } LevelShare;

typedef struct { LevelShare *item; size_t n, item_capacity; } LevelShares;

typedef struct
{
  const CeldPlane    *levels;
  const CeldSettings *settings;
  CeldPlane          *change;
  CeldLevelNumbers    number;
  float               full;                /* difference of levels from which shadows are full */

  CeldBlurGrid cells;
  CeldKernel   along, down;
  CeldBetween *column, *row;
  LevelShares  cover;               /* before the blur, by cell */
  LevelShares  blurred[CELD_MOST_LEVELS];
  CeldStatus   status[CELD_MOST_LEVELS];
  size_t      *first;               /* of each cell, and one more: its first share; ordered by rising level */
  LevelShare  *share;
} Stack;

/* ------------------------------------------------------------------ mattes on cells */

/* Appends the levels within one cell, each with the fraction of the cell's pixels that have it. */
static CeldStatus
cover_cell (Stack *s, int column, int row, uint32_t *count)
{
  int     width = s->levels->width, side = s->cells.side;
  int     right = (column + 1) * side < width ? (column + 1) * side : width;
  int     bottom = (row + 1) * side < s->levels->height ? (row + 1) * side : s->levels->height;
  float   area = (float) ((right - column * side) * (bottom - row * side));
  uint8_t met[CELD_MOST_LEVELS];
  int     n = 0;

  for (int y = row * side; y < bottom; y++)
    for (int x = column * side; x < right; x++)
      {
        uint8_t level = s->number.level[(size_t) y * (size_t) width + (size_t) x];

        if (!count[level]++)
          met[n++] = level;
      }
  for (int i = 0; i < n; i++)
    {
      if (celd_append (s->cover.item, s->cover.n, s->cover.item_capacity,
                       (LevelShare) { (uint32_t) row * (uint32_t) s->cells.width + (uint32_t) column, met[i],
                                     (float) count[met[i]] / area }) != CELD_OK)
        return CELD_NO_MEMORY;
      count[met[i]] = 0;
    }
  return CELD_OK;
}

static CeldStatus
cover_cells (Stack *s)
{
  uint32_t   count[CELD_MOST_LEVELS] = { 0 };
  CeldStatus status = CELD_OK;

  for (int row = 0; row < s->cells.height; row++)
    for (int column = 0; column < s->cells.width && status == CELD_OK; column++)
      status = cover_cell (s, column, row, count);
  return status;
}

/* Stable counting sort by cell or by level; the shares of key i become to[first[i]] .. to[first[i + 1] - 1]. */
static void
sort_shares (const LevelShares *from, bool by_cell, size_t keys, size_t *first, LevelShare *to)
{
  memset (first, 0, (keys + 1) * sizeof *first);
  for (size_t i = 0; i < from->n; i++)
    first[(by_cell ? from->item[i].cell : from->item[i].level) + 1]++;
  for (size_t k = 0; k < keys; k++)
    first[k + 1] += first[k];
  for (size_t i = 0; i < from->n; i++)
    to[first[by_cell ? from->item[i].cell : from->item[i].level]++] = from->item[i];
  memmove (first + 1, first, keys * sizeof *first);
  first[0] = 0;
}

/* ------------------------------------------------------------------ mattes, blurred */

typedef struct { Stack *stack; const LevelShare *share; const size_t *first; } Blurring;

/* Extends low .. high on both sides by the number of cells that the kernel reaches, within the picture. */
static void
widen (const CeldKernel *kernel, int cells, int *low, int *high)
{
  int last = kernel->first + kernel->n - 1, reach = last > -kernel->first ? last : -kernel->first;

  *low  = *low > reach ? *low - reach : 0;
  *high = *high < cells - reach ? *high + reach : cells - 1;
  *high = *high < cells ? *high : cells - 1;
}

/* The bounding box, in cells, of a level and its shadow: the blur reads only empty cells outside it. */
static CeldRect
shadow_bounds (const Stack *s, const LevelShare *share, size_t n)
{
  int left = s->cells.width, right = -1, top = s->cells.height, bottom = -1;

  for (size_t i = 0; i < n; i++)
    {
      int x = (int) (share[i].cell % (uint32_t) s->cells.width), y = (int) (share[i].cell / (uint32_t) s->cells.width);

      left   = x < left ? x : left;
      right  = x > right ? x : right;
      top    = y < top ? y : top;
      bottom = y > bottom ? y : bottom;
    }
  widen (&s->along, s->cells.width, &left, &right);
  widen (&s->down, s->cells.height, &top, &bottom);
  return (CeldRect) { left, top, right - left + 1, bottom - top + 1 };
}

/* Lists the cells of a blurred matte that are not faint. */
static CeldStatus
gather_matte (const Stack *s, CeldRect bounds, const float *matte, uint8_t level, LevelShares *shares)
{
  for (int y = 0; y < bounds.height; y++)
    for (int x = 0; x < bounds.width; x++)
      {
        float  value = matte[(size_t) y * (size_t) bounds.width + (size_t) x];

        if (value < FAINT_MATTE)
          continue;
        if (celd_append (shares->item, shares->n, shares->item_capacity,
                         (LevelShare) { (uint32_t) (bounds.y + y) * (uint32_t) s->cells.width + (uint32_t) (bounds.x + x),
                                      level, value }) != CELD_OK)
          return CELD_NO_MEMORY;
      }
  return CELD_OK;
}

/* Blurs level i + 1: the farthest level, 0, casts no shadow. */
static void
blur_level (void *data, int i)
{
  const Blurring   *b = data;
  Stack            *s = b->stack;
  int               level = i + 1;
  const LevelShare *share = b->share + b->first[level];
  size_t            n = b->first[level + 1] - b->first[level];
  CeldRect          bounds = shadow_bounds (s, share, n);
  size_t            area = (size_t) bounds.width * (size_t) bounds.height;
  float            *matte = celd_alloc0 (area, sizeof *matte), *scratch = celd_alloc (area, sizeof *scratch);

  s->status[level] = matte && scratch ? CELD_OK : CELD_NO_MEMORY;
  for (size_t k = 0; s->status[level] == CELD_OK && k < n; k++)
    {
      uint32_t x = share[k].cell % (uint32_t) s->cells.width, y = share[k].cell / (uint32_t) s->cells.width;

      matte[(y - (size_t) bounds.y) * (size_t) bounds.width + x - (size_t) bounds.x] = share[k].matte;
    }
  if (s->status[level] == CELD_OK)
    {
      celd_blur (&s->along, &s->down, bounds.width, bounds.height, matte, scratch);
      s->status[level] = gather_matte (s, bounds, matte, (uint8_t) level, &s->blurred[level]);
    }
  celd_free (matte);
  celd_free (scratch);
}

/* Makes one list of all blurred mattes, by cell and then by level. */
static CeldStatus
join_levels (Stack *s)
{
  size_t cells = (size_t) s->cells.width * (size_t) s->cells.height;
  LevelShares all = { 0 };

  for (int k = 1; k < s->number.n; k++)
    all.n += s->blurred[k].n;
  all.item = celd_alloc (all.n, sizeof *all.item);
  s->first = celd_alloc (cells + 1, sizeof *s->first);
  s->share = celd_alloc (all.n, sizeof *s->share);
  if (!all.item || !s->first || !s->share)
    {
      celd_free (all.item);
      return CELD_NO_MEMORY;
    }
  all.n = 0;
  for (int k = 1; k < s->number.n; k++)
    {
      if (s->blurred[k].n)
        memcpy (all.item + all.n, s->blurred[k].item, s->blurred[k].n * sizeof *all.item);
      all.n += s->blurred[k].n;
      celd_free (s->blurred[k].item);
      s->blurred[k] = (LevelShares) { 0 };
    }
  sort_shares (&all, true, cells, s->first, s->share);
  celd_free (all.item);
  return CELD_OK;
}

static CeldStatus
blur_mattes (Stack *s, const CeldHost *host)
{
  size_t      first[CELD_MOST_LEVELS + 1];
  LevelShare *share = celd_alloc (s->cover.n, sizeof *share);
  Blurring    blurring = { s, share, first };
  CeldStatus  status;

  if (!share)
    return CELD_NO_MEMORY;
  sort_shares (&s->cover, false, CELD_MOST_LEVELS, first, share);
  celd_parallel_for (host, s->number.n - 1, blur_level, &blurring);
  celd_free (share);
  status = celd_progress (host, 0.5);
  for (int k = 1; k < s->number.n && status == CELD_OK; k++)
    status = s->status[k];
  return status == CELD_OK ? join_levels (s) : status;
}

/* ------------------------------------------------------------------ light */

/* The fraction of its light that a level keeps in a cell. */
static float
light_in_cell (const Stack *s, size_t cell, uint8_t level)
{
  float light = 1;

  for (size_t i = s->first[cell + 1]; i-- > s->first[cell] && s->share[i].level > level;)
    {
      float before = s->number.value[s->share[i].level] - s->number.value[level];
      float falling = before < s->full ? before / s->full : 1;

      light *= 1 - s->settings->shadow_strength * falling * s->share[i].matte;
    }
  return light;
}

/* One row of pixels; lights are made anew where the cells or the level change. */
static void
light_row (void *data, int y)
{
  const Stack *s = data;
  int          width = s->levels->width, last_column = -1, last_level = -1;
  CeldBetween  row = s->row[y];
  size_t       above = (size_t) row.one * (size_t) s->cells.width, below = (size_t) row.other * (size_t) s->cells.width;
  float        left = 1, right = 1;

  for (int x = 0; x < width; x++)
    {
      CeldBetween column = s->column[x];
      uint8_t     level = s->number.level[(size_t) y * (size_t) width + (size_t) x];

      if (column.one != last_column || level != last_level)
        {
          size_t one = (size_t) column.one, other = (size_t) column.other;

          left  = (1 - row.share) * light_in_cell (s, above + one, level)
                  + row.share * light_in_cell (s, below + one, level);
          right = (1 - row.share) * light_in_cell (s, above + other, level)
                  + row.share * light_in_cell (s, below + other, level);
          last_column = column.one;
          last_level  = level;
        }
      CELD_AT (s->change, x, y) = (1 - column.share) * left + column.share * right - 1;
    }
}

/* ------------------------------------------------------------------ */

static CeldStatus
prepare (Stack *s, double deviation)
{
  int    width = s->levels->width, height = s->levels->height;
  double azimuth = (double) s->settings->light_azimuth * CELD_RADIANS;
  double distance = (double) s->settings->shadow_offset * hypot (width, height);

  s->cells  = celd_cells (width, height, deviation);
  s->column = celd_between_columns (&s->cells);
  s->row    = celd_between_rows (&s->cells);
  /* A shadow reads the matte towards the light: to the right of it, and above. */
  if (!s->column || !s->row ||
      celd_kernel_new (&s->cells, deviation, distance * cos (azimuth), &s->along) != CELD_OK ||
      celd_kernel_new (&s->cells, deviation, -distance * sin (azimuth), &s->down) != CELD_OK)
    return CELD_NO_MEMORY;
  return celd_level_numbers (s->levels, &s->number);
}

static void
clear (Stack *s)
{
  for (int k = 0; k < CELD_MOST_LEVELS; k++)
    celd_free (s->blurred[k].item);
  celd_free (s->number.level);
  celd_free (s->along.weight);
  celd_free (s->down.weight);
  celd_free (s->column);
  celd_free (s->row);
  celd_free (s->cover.item);
  celd_free (s->first);
  celd_free (s->share);
}

CeldStatus
celd_shadows (const CeldPlane *levels, double deviation, const CeldSettings *settings, const CeldHost *host,
              CeldPlane *change)
{
  Stack     *s = celd_alloc0 (1, sizeof *s);
  CeldStatus status;

  if (!s)
    return CELD_NO_MEMORY;
  s->levels   = levels;
  s->settings = settings;
  s->change   = change;
  status = prepare (s, deviation);
  s->full = settings->shadow_range * (s->number.value[s->number.n ? s->number.n - 1 : 0] - s->number.value[0]);
  if (status == CELD_OK)
    status = celd_progress (host, 0.2);
  if (status == CELD_OK)
    status = cover_cells (s);
  if (status == CELD_OK)
    status = blur_mattes (s, host);
  if (status == CELD_OK)
    status = celd_progress (host, 0.6);
  if (status == CELD_OK)
    celd_parallel_for (host, levels->height, light_row, s);
  clear (s);
  celd_free (s);
  return status;
}
