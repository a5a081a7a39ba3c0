/* Depth expansion of levels in any encoding, and the owners behind it.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "ownership/expand.h"

/* The level of the label that has more of each pixel. */
static void
write_levels (const CeldOwnLevels *made, CeldPlane *expanded)
{
  const CeldOwnership *own = &made->own;

  for (int y = 0; y < expanded->height; y++)
    for (int x = 0; x < expanded->width; x++)
      {
        const CeldLabels *label = CELD_AT (&own->share, x, y) >= 0.5f ? &own->owner : &own->under;

        CELD_AT (expanded, x, y) = made->level[CELD_AT (label, x, y) - 1];
      }
}

CeldStatus
celd_expand_levels (const CeldPlane *ink, const CeldPlane *levels, const CeldLabels *regions,
                    const CeldLabels *corrections, CeldExpansion method, const CeldHost *host, CeldPlane *expanded)
{
  CeldOwnLevels made;
  CeldStatus    status;

  if (!CELD_SAME_SIZE (levels, expanded))
    return CELD_BAD_SIZE;
  status = celd_own_levels_new (ink, levels, regions, corrections, method, host, &made);
  if (!status)
    write_levels (&made, expanded);
  celd_own_levels_clear (&made);
  return status;
}

CeldStatus
celd_matte_of_levels (const CeldPlane *ink, const CeldPlane *levels, const CeldLabels *regions,
                      const CeldLabels *corrections, CeldExpansion method, const CeldHost *host, CeldPlane *level,
                      CeldLabels *region, CeldPlane *share)
{
  CeldOwnLevels made;
  CeldStatus    status;

  if (!CELD_SAME_SIZE (levels, level) || !CELD_SAME_SIZE (levels, share) ||
      (region && !CELD_SAME_SIZE (levels, region)))
    return CELD_BAD_SIZE;
  status = celd_own_levels_new (ink, levels, regions, corrections, method, host, &made);
  for (int y = 0; y < levels->height && !status; y++)
    for (int x = 0; x < levels->width; x++)
      {
        uint32_t owner = CELD_AT (&made.own.owner, x, y);

        CELD_AT (share, x, y) = CELD_AT (&made.own.share, x, y);
        CELD_AT (level, x, y) = made.level[owner - 1];
        if (region)
          CELD_AT (region, x, y) = made.region[owner - 1];
      }
  celd_own_levels_clear (&made);
  return status;
}
