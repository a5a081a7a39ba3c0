/* The sheets of a picture of levels, which tells nothing but levels: the background is found by the frame.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "sheets/sheets.h"

CeldStatus
celd_level_background (const CeldLevelOwnership *made, uint32_t *background)
{
  const CeldLabels *label = &made->own.owner;
  size_t           *count = celd_alloc0 (made->n, sizeof *count);
  bool              most = true;

  if (!count)
    return CELD_NO_MEMORY;
  for (int x = 0; x < label->width; x++)
    {
      count[CELD_AT (label, x, 0) - 1]++;
      count[CELD_AT (label, x, label->height - 1) - 1]++;
    }
  for (int y = 0; y < label->height; y++)
    {
      count[CELD_AT (label, 0, y) - 1]++;
      count[CELD_AT (label, label->width - 1, y) - 1]++;
    }
  for (size_t k = 1; k < made->n; k++)
    most = most && count[k] < count[0];
  celd_free (count);
  *background = most;
  return CELD_OK;
}

CeldStatus
celd_level_sheets (const CeldLevelOwnership *made, const CeldPlane *ink, const CeldSettings *settings,
                   const CeldHost *host, CeldSheets **sheets)
{
  CeldOrder  order = { .level = made->order, .n = made->n };
  uint32_t   background = 0;
  CeldStatus status = celd_level_background (made, &background);

  return status == CELD_OK ? celd_sheets (ink, &made->own, NULL, &order, background, settings, host, sheets) : status;
}
