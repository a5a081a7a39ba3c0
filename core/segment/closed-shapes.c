/* The closed shapes of a drawing that no one has painted yet: its basins, joined over all but narrow openings.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "segment/basins.h"

CeldStatus
celd_closed_shapes (const CeldPlane *ink, float threshold, const CeldHost *host, CeldLabels *shape,
                    CeldLabels *component)
{
  CeldBasins basins = { 0 };
  CeldStatus status = celd_basins_new (ink, threshold, host, &basins);

  for (int y = 0; y < ink->height && status == CELD_OK; y++)
    for (size_t r = basins.row[y]; r < basins.row[y + 1]; r++)
      for (int x = basins.run[r].x; x < celd_basin_run_end (&basins, r, y); x++)
        {
          uint32_t basin = basins.run[r].basin;
          bool     paper = celd_is_paper (CELD_AT (ink, x, y));

          CELD_AT (shape, x, y)     = paper ? basins.merged[basin] : 0;
          CELD_AT (component, x, y) = paper ? basins.component[basin] : 0;
        }
  celd_basins_clear (&basins);
  return status;
}
