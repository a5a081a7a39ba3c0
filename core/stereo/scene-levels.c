/* A scene of completed layers from pictures of levels and depth, as the steps of a graph have them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "ownership/expand.h"

CeldStatus
celd_scene_of_levels (const CeldPlane *ink, const CeldPlane *levels, const CeldPlane *depth, const CeldColours *art,
                      CeldExpansion method, const CeldHost *host, CeldScene **scene)
{
  CeldOwnLevels made;
  CeldLayers   *layers = NULL;
  CeldHostPart      part[3];
  CeldHost      first = celd_host_part (&part[0], host, 0, 0.3), second = celd_host_part (&part[1], host, 0.3, 0.9);
  CeldHost      third = celd_host_part (&part[2], host, 0.9, 1);
  CeldStatus    status = celd_own_levels_new (ink, levels, NULL, NULL, method, &first, &made);

  if (!status)
    status = celd_own_levels_cut (&made, ink, art, CELD_STORE_FLOAT, true, &second, &layers);
  if (!status)
    status = celd_scene_of_layers (layers, &made.own, depth, &third, scene);
  celd_layers_free (layers);
  celd_own_levels_clear (&made);
  return status;
}
