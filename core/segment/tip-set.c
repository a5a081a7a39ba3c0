/* Line ends that were found, by place.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "segment/tip-set.h"

#include <math.h>

#define END_CELL 16 /* pixels: side of the cells in which found ends are looked up */
#define NO_TIP   UINT32_MAX

CeldStatus
celd_tip_set_open (int width, int height, CeldTipSet *set)
{
  size_t n;

  *set = (CeldTipSet) { .columns = (width + END_CELL - 1) / END_CELL, .rows = (height + END_CELL - 1) / END_CELL };
  n           = (size_t) set->columns * (size_t) set->rows;
  set->latest = celd_alloc (n, sizeof *set->latest);
  for (size_t k = 0; k < n && set->latest; k++)
    set->latest[k] = NO_TIP;
  return set->latest ? CELD_OK : CELD_NO_MEMORY;
}

void
celd_tip_set_close (CeldTipSet *set)
{
  celd_free (set->before);
  celd_free (set->latest);
  celd_free (set->tip);
  *set = (CeldTipSet) { 0 };
}

/* The column or row of cells of a coordinate, clamped to the picture. */
static int
cell_along (double at, int n)
{
  return at < END_CELL ? 0 : at < (double) END_CELL * n ? (int) (at / END_CELL) : n - 1;
}

bool
celd_tip_set_has (const CeldTipSet *set, CeldTip end, double distance)
{
  int right = cell_along (end.x + distance, set->columns), bottom = cell_along (end.y + distance, set->rows);

  for (int row = cell_along (end.y - distance, set->rows); row <= bottom; row++)
    for (int column = cell_along (end.x - distance, set->columns); column <= right; column++)
      for (uint32_t i = set->latest[(size_t) row * (size_t) set->columns + (size_t) column]; i != NO_TIP;
           i = set->before[i])
        if (hypot (set->tip[i].x - end.x, set->tip[i].y - end.y) < distance &&
            set->tip[i].dx * end.dx + set->tip[i].dy * end.dy > 0)
          return true;
  return false;
}

CeldStatus
celd_tip_set_add (CeldTipSet *set, CeldTip end)
{
  size_t    row = (size_t) cell_along (end.y, set->rows), column = (size_t) cell_along (end.x, set->columns);
  uint32_t *latest = &set->latest[row * (size_t) set->columns + column];

  if (!celd_reserve_one (set->before, set->n, set->before_capacity) ||
      !celd_reserve_one (set->tip, set->n, set->tip_capacity))
    return CELD_NO_MEMORY;
  set->before[set->n] = *latest;
  set->tip[set->n]    = end;
  *latest             = (uint32_t) set->n++;
  return CELD_OK;
}
