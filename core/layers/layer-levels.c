/* Layers from a picture of levels, as the steps of a graph have it: who has neither labels nor an order at hand.
 *
 * The background is the farthest label if it has more of the frame than any other.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "ownership/expand.h"

/* The first label, if no other has as much of the frame; else 0. */
static CeldStatus
find_background (const CeldOwnLevels *made, uint32_t *background)
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
celd_own_levels_cut (const CeldOwnLevels *made, const CeldPlane *ink, const CeldColours *art, CeldStore store,
                     bool complete, const CeldHost *host, CeldLayers **layers)
{
  uint32_t   background = 0;
  CeldStatus status = find_background (made, &background);

  return status ? status : celd_layers_cut (ink, &made->own, made->order, made->n, art, background, store, complete, host,
                                            layers);
}

CeldStatus
celd_layers_of_levels (const CeldPlane *ink, const CeldPlane *levels, const CeldLabels *regions,
                       const CeldLabels *corrections, const CeldColours *art, CeldExpansion method, CeldStore store,
                       bool complete, const CeldHost *host, CeldLayers **layers)
{
  CeldOwnLevels made;
  CeldHostPart      part[2];
  CeldHost      first = celd_host_part (&part[0], host, 0, 0.6), second = celd_host_part (&part[1], host, 0.6, 1);
  CeldStatus    status = celd_own_levels_new (ink, levels, regions, corrections, method, &first, &made);

  if (!status)
    status = celd_own_levels_cut (&made, ink, art, store, complete, &second, layers);
  celd_own_levels_clear (&made);
  return status;
}
