/* The lattice of a picture of levels, for callers that have neither labels nor an order.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/motion.h"
#include "ownership/ownership.h"
#include "sheets/sheets.h"

CeldStatus
celd_lattice_of_levels (const CeldPlane *ink, const CeldPlane *levels, const CeldLabels *regions,
                        const CeldSettings *settings, const CeldHost *host, CeldLattice **lattice)
{
  CeldLevelOwnership made;
  CeldHostPart       part[2];
  CeldHost           first = celd_host_part (&part[0], host, 0, 0.7), second = celd_host_part (&part[1], host, 0.7, 1);
  CeldMovingParts    parts = { .labels = &made.own.owner };
  CeldStatus         status;

  if (celd_settings_check (settings) != CELD_OK)
    return CELD_BAD_VALUE;
  status = celd_level_ownership_new (ink, NULL, levels, regions, NULL, settings->expansion, &first, &made);
  if (status == CELD_OK)
    status = celd_level_background (&made, &parts.background);
  if (status == CELD_OK)
    {
      parts.level = made.order;
      parts.n     = made.n;
      status      = celd_lattice_new (ink, &parts, settings, &second, lattice);
    }
  celd_level_ownership_clear (&made);
  return status;
}
