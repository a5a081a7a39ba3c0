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
#include "base/base.h"
#include "image/image.h"
#include "light/light.h"

#define MOST_LEVELS 256           /* distinct levels, to fit a byte; more are rounded to so many evenly spaced ones */
#define FAINT_MATTE (1.0f / 1024) /* a smaller matte is ignored (chosen) */

/* The distinct levels of a picture, numbered from the farthest. */
typedef struct
{
  int      n;
  float    value[MOST_LEVELS];  /* of each level, rising */
  float    least, step;         /* of evenly spaced levels; step 0: values are exact */
  uint8_t *level;               /* number of each pixel, tight */
} LevelNumbers;

/* A level's matte in one cell. */
typedef struct { uint32_t cell; uint8_t level; float matte; } LevelShare;

typedef struct { LevelShare *item; size_t n, item_capacity; } LevelShares;

typedef struct
{
  const CeldPlane    *levels;
  const CeldSettings *settings;
  CeldPlane          *change;
  LevelNumbers        number;
  float               full;         /* difference of levels from which shadows are full */

  CeldBlurGrid cells;
  CeldKernel   along, down;
  CeldBetween *column, *row;
  LevelShares  matte[MOST_LEVELS];  /* of each level, by cell; blurred in the end */
  CeldStatus   status[MOST_LEVELS]; /* of the blur of each level */
  size_t      *first;               /* of each cell: its first share, ordered by rising level; and the ends */
  LevelShare  *share;
} Stack;

/* ------------------------------------------------------------------ numbers of levels */

/* The index of a value in the sorted list, or where to insert it. */
static int
find_value (const LevelNumbers *numbers, float value)
{
  int low = 0, high = numbers->n;

  while (low < high)
    {
      int middle = (low + high) / 2;

      if (numbers->value[middle] < value)
        low = middle + 1;
      else
        high = middle;
    }
  return low;
}

/* Lists all distinct values; false if there are too many. */
static bool
list_values (const CeldPlane *levels, LevelNumbers *numbers)
{
  float last = NAN;

  numbers->n = 0;
  for (int y = 0; y < levels->height; y++)
    for (int x = 0; x < levels->width; x++)
      {
        float value = celd_level_at (levels, x, y);
        int   place;

        if (value == last)
          continue;
        last  = value;
        place = find_value (numbers, value);
        if (place < numbers->n && numbers->value[place] == value)
          continue;
        if (numbers->n == MOST_LEVELS)
          return false;
        memmove (numbers->value + place + 1, numbers->value + place,
                 (size_t) (numbers->n - place) * sizeof *numbers->value);
        numbers->value[place] = value;
        numbers->n++;
      }
  return true;
}

/* Replaces too many values by evenly spaced ones. */
static void
spread_values (const CeldPlane *levels, LevelNumbers *numbers)
{
  float most;

  celd_level_range (levels, &numbers->least, &most);
  numbers->step = most / (MOST_LEVELS - 1) - numbers->least / (MOST_LEVELS - 1);
  numbers->n    = MOST_LEVELS;
  for (int k = 0; k < MOST_LEVELS; k++)
    numbers->value[k] = numbers->least + (float) k * numbers->step;
}

/* Fills in a zeroed record. */
static CeldStatus
number_levels (const CeldPlane *levels, LevelNumbers *numbers)
{
  size_t n = 0;

  numbers->level = celd_alloc ((size_t) levels->width * (size_t) levels->height, 1);
  if (!numbers->level)
    return CELD_NO_MEMORY;
  if (!list_values (levels, numbers))
    spread_values (levels, numbers);
  for (int y = 0; y < levels->height; y++)
    for (int x = 0; x < levels->width; x++)
      {
        float value = celd_level_at (levels, x, y);

        numbers->level[n++] = numbers->step > 0
          ? (uint8_t) fminf ((value - numbers->least) / numbers->step + 0.5f, MOST_LEVELS - 1)
          : (uint8_t) find_value (numbers, value);
      }
  return CELD_OK;
}

/* ------------------------------------------------------------------ mattes on cells */

/* Adds a cell to the mattes of the levels within it, each with the fraction of the cell's pixels that have it. */
static CeldStatus
cover_cell (Stack *s, int column, int row, uint32_t *count)
{
  int     width = s->levels->width, side = s->cells.side;
  int     right = (column + 1) * side < width ? (column + 1) * side : width;
  int     bottom = (row + 1) * side < s->levels->height ? (row + 1) * side : s->levels->height;
  float   area = (float) ((right - column * side) * (bottom - row * side));
  uint8_t met[MOST_LEVELS];
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
      LevelShares *matte = &s->matte[met[i]];

      if (celd_append (matte->item, matte->n, matte->item_capacity,
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
  uint32_t   count[MOST_LEVELS] = { 0 };
  CeldStatus status = CELD_OK;

  for (int row = 0; row < s->cells.height; row++)
    for (int column = 0; column < s->cells.width && status == CELD_OK; column++)
      status = cover_cell (s, column, row, count);
  return status;
}

/* ------------------------------------------------------------------ mattes, blurred */

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
shadow_bounds (const Stack *s, const LevelShares *shares)
{
  CeldRect box = { 0 };

  for (size_t i = 0; i < shares->n; i++)
    box = celd_rect_union (box, (CeldRect) { (int) (shares->item[i].cell % (uint32_t) s->cells.width),
                                             (int) (shares->item[i].cell / (uint32_t) s->cells.width), 1, 1 });

  int left = box.x, right = box.x + box.width - 1, top = box.y, bottom = box.y + box.height - 1;

  widen (&s->along, s->cells.width, &left, &right);
  widen (&s->down, s->cells.height, &top, &bottom);
  return (CeldRect) { left, top, right - left + 1, bottom - top + 1 };
}

/* Lists the cells of a blurred matte that are not faint. */
static CeldStatus
gather_matte (const Stack *s, CeldRect bounds, const float *matte, uint8_t level, LevelShares *shares)
{
  shares->n = 0;
  for (int y = 0; y < bounds.height; y++)
    for (int x = 0; x < bounds.width; x++)
      {
        float      value = matte[(size_t) y * (size_t) bounds.width + (size_t) x];
        uint32_t   cell = (uint32_t) (bounds.y + y) * (uint32_t) s->cells.width + (uint32_t) (bounds.x + x);
        LevelShare share = { cell, level, value };

        if (value >= FAINT_MATTE && celd_append (shares->item, shares->n, shares->item_capacity, share) != CELD_OK)
          return CELD_NO_MEMORY;
      }
  return CELD_OK;
}

/* Blurs level i + 1, if it has pixels: the farthest level, 0, casts no shadow. */
static void
blur_level (void *data, int i)
{
  Stack       *s = data;
  int          level = i + 1;
  LevelShares *shares = &s->matte[level];
  CeldRect     bounds = shadow_bounds (s, shares);
  size_t       area = shares->n ? (size_t) bounds.width * (size_t) bounds.height : 0;
  float       *matte = celd_alloc0 (area, sizeof *matte), *scratch = celd_alloc (area, sizeof *scratch);

  s->status[level] = matte && scratch ? CELD_OK : CELD_NO_MEMORY;
  for (size_t k = 0; s->status[level] == CELD_OK && k < shares->n; k++)
    {
      uint32_t cell = shares->item[k].cell, x = cell % (uint32_t) s->cells.width, y = cell / (uint32_t) s->cells.width;

      matte[(y - (size_t) bounds.y) * (size_t) bounds.width + x - (size_t) bounds.x] = shares->item[k].matte;
    }
  if (s->status[level] == CELD_OK && shares->n)
    {
      celd_blur (&s->along, &s->down, bounds.width, bounds.height, matte, scratch);
      s->status[level] = gather_matte (s, bounds, matte, (uint8_t) level, shares);
    }
  celd_free (matte);
  celd_free (scratch);
}

/* Makes one list of all blurred mattes, by cell and then by level: a counting sort. */
static CeldStatus
join_levels (Stack *s)
{
  size_t cells = (size_t) s->cells.width * (size_t) s->cells.height, n = 0;

  for (int k = 1; k < s->number.n; k++)
    n += s->matte[k].n;
  s->first = celd_alloc0 (cells + 2, sizeof *s->first);
  s->share = celd_alloc (n, sizeof *s->share);
  if (!s->first || !s->share)
    return CELD_NO_MEMORY;
  for (int k = 1; k < s->number.n; k++)
    for (size_t i = 0; i < s->matte[k].n; i++)
      s->first[s->matte[k].item[i].cell + 2]++;
  for (size_t cell = 0; cell < cells; cell++)
    s->first[cell + 2] += s->first[cell + 1];
  for (int k = 1; k < s->number.n; k++)
    for (size_t i = 0; i < s->matte[k].n; i++)
      s->share[s->first[s->matte[k].item[i].cell + 1]++] = s->matte[k].item[i];
  return CELD_OK;
}

static CeldStatus
blur_mattes (Stack *s, const CeldHost *host)
{
  CeldStatus status;

  celd_parallel_for (host, s->number.n - 1, blur_level, s);
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
  return number_levels (s->levels, &s->number);
}

static void
clear (Stack *s)
{
  for (int k = 0; k < MOST_LEVELS; k++)
    celd_free (s->matte[k].item);
  celd_free (s->number.level);
  celd_free (s->along.weight);
  celd_free (s->down.weight);
  celd_free (s->column);
  celd_free (s->row);
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
