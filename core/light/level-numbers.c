/* The range of levels, and numbers for the distinct ones.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "light/shadows.h"

void
celd_level_range (const CeldPlane *levels, float *least, float *most)
{
  *least = *most = celd_level_at (levels, 0, 0);
  for (int y = 0; y < levels->height; y++)
    for (int x = 0; x < levels->width; x++)
      {
        *least = fminf (*least, celd_level_at (levels, x, y));
        *most  = fmaxf (*most, celd_level_at (levels, x, y));
      }
}

/* ------------------------------------------------------------------ numbers */

/* The index of a value in the sorted list, or where to insert it. */
static int
find_value (const CeldLevelNumbers *numbers, float value)
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
list_values (const CeldPlane *levels, CeldLevelNumbers *numbers)
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
        if (numbers->n == CELD_MOST_LEVELS)
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
spread_values (const CeldPlane *levels, CeldLevelNumbers *numbers)
{
  float most;

  celd_level_range (levels, &numbers->least, &most);
  numbers->step = most / (CELD_MOST_LEVELS - 1) - numbers->least / (CELD_MOST_LEVELS - 1);
  numbers->n    = CELD_MOST_LEVELS;
  for (int k = 0; k < CELD_MOST_LEVELS; k++)
    numbers->value[k] = numbers->least + (float) k * numbers->step;
}

CeldStatus
celd_level_numbers (const CeldPlane *levels, CeldLevelNumbers *numbers)
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

        if (numbers->step > 0)
          numbers->level[n++] = (uint8_t) fminf ((value - numbers->least) / numbers->step + 0.5f, CELD_MOST_LEVELS - 1);
        else
          numbers->level[n++] = (uint8_t) find_value (numbers, value);
      }
  return CELD_OK;
}
