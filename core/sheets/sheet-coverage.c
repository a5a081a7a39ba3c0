/* The coverage of pixels by a whole sheet: what ownership says where it is visible, and its hidden pixels.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "sheets/sheets.h"

void
celd_sheet_coverage (const CeldSheets *sheets, const CeldOwnership *own, size_t k, CeldRect box, float *coverage)
{
  const CeldSheet *sheet = &sheets->item[k];
  float           *to = coverage;

  for (int y = box.y; y < box.y + box.height; y++)
    for (int x = box.x; x < box.x + box.width; x++, to++)
      {
        uint32_t owner = CELD_AT (&own->owner, x, y), under = CELD_AT (&own->under, x, y);
        float    share = CELD_AT (&own->coverage, x, y);

        under = share < 1 ? under : owner;
        *to = sheet->page && k < sheets->of_label[owner - 1] && k < sheets->of_label[under - 1];
        if (owner == sheet->label)
          *to = owner != under && k > sheets->of_label[under - 1] ? share : 1;
        else if (under == sheet->label)
          *to = k > sheets->of_label[owner - 1] ? 1 - share : 1;
      }
  for (size_t i = 0; i < sheet->n_runs; i++)
    {
      const CeldSheetRun *run = &sheet->run[i];
      int                 first = run->x > box.x ? run->x : box.x, end = run->x + run->n;

      if (run->y < box.y || run->y >= box.y + box.height)
        continue;
      end = end < box.x + box.width ? end : box.x + box.width;
      for (int x = first; x < end; x++)
        coverage[(size_t) (run->y - box.y) * (size_t) box.width + (size_t) (x - box.x)]
          = (float) sheet->coverage[run->first + (size_t) (x - run->x)] / 255;
    }
}
