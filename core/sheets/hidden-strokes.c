/* Strokes by which the artist says what is hidden: in a region's colour they add to its sheet, and an eraser takes away
 * from all.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "sheets/sheets.h"

#define ROOM 32 /* round strokes in a window there is at least its size divided by this, several cells; chosen */

CeldStatus
celd_hidden_strokes_find (const CeldLabels *hints, size_t n, CeldSheetShape *shape)
{
  for (int y = 0; y < hints->height; y++)
    for (int x = 0, end; x < hints->width; x = end)
      {
        uint32_t hint = CELD_AT (hints, x, y);

        for (end = x + 1; end < hints->width && CELD_AT (hints, end, y) == hint;)
          end++;
        if (!hint || hint == CELD_HIDDEN_ERASE)
          continue;
        if (hint > n)
          return CELD_BAD_VALUE;
        shape[hint - 1].painted = celd_rect_union (shape[hint - 1].painted, (CeldRect) { x, y, end - x, 1 });
      }
  return CELD_OK;
}

CeldRect
celd_hidden_strokes_window (const CeldSheetView *view, CeldRect window)
{
  CeldRect all = celd_rect_union (window, view->painted);
  int      side = (all.width > all.height ? all.width : all.height) / ROOM + 2;
  CeldRect strokes = { view->painted.x - side, view->painted.y - side, view->painted.width + 2 * side,
                       view->painted.height + 2 * side };
  int      right, below;

  if (!view->painted.width)
    return window;
  all   = celd_rect_union (window, strokes);
  right = all.x + all.width;
  below = all.y + all.height;
  right = right < view->own->owner.width ? right : view->own->owner.width;
  below = below < view->own->owner.height ? below : view->own->owner.height;
  all.x = all.x > 0 ? all.x : 0;
  all.y = all.y > 0 ? all.y : 0;
  return (CeldRect) { all.x, all.y, right - all.x, below - all.y };
}

uint32_t
celd_hidden_stroke_at (const CeldSheetView *view, const CeldDiffusion *d, int x, int y)
{
  int      left = x * d->cell, top = y * d->cell, right = left + d->cell, below = top + d->cell;
  uint32_t found = 0;

  if (!view->hints)
    return 0;
  right = right < d->window.width ? right : d->window.width;
  below = below < d->window.height ? below : d->window.height;
  for (int v = top; v < below; v++)
    for (int u = left; u < right; u++)
      {
        uint32_t hint = CELD_AT (view->hints, d->window.x + u, d->window.y + v);

        if (hint == view->label)
          return hint;
        found = hint == CELD_HIDDEN_ERASE ? hint : found;
      }
  return found;
}
