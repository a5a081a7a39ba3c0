/* The puppet of a picture of levels, for callers that have neither labels nor an order.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/puppet.h"

/* Notes the values of levels in the picture. */
static CeldStatus
note_values (const CeldLevelOwnership *made, CeldPuppet *puppet)
{
  puppet->n_values = made->order[made->n - 1] + 1;
  puppet->value    = celd_alloc (puppet->n_values, sizeof *puppet->value);
  for (size_t k = 0; k < made->n && puppet->value; k++)
    puppet->value[made->order[k]] = made->level[k];
  return puppet->value ? CELD_OK : CELD_NO_MEMORY;
}

CeldStatus
celd_puppet_of_levels (const CeldPlane *ink, const CeldPlane *levels, const CeldColours *art,
                       const CeldSettings *settings, const CeldHost *host, CeldPuppet **result)
{
  CeldHostPart       part[3];
  CeldHost           first = celd_host_part (&part[0], host, 0, 0.2);
  CeldHost           second = celd_host_part (&part[1], host, 0.2, 0.8);
  CeldHost           third = celd_host_part (&part[2], host, 0.8, 1);
  CeldSettings       whole = *settings;
  CeldLevelOwnership made;
  CeldLayers        *layers = NULL;
  CeldPuppet        *puppet = NULL;
  uint32_t           background = 0;
  CeldStatus         status;

  if (celd_settings_check (settings) != CELD_OK)
    return CELD_BAD_VALUE;
  whole.complete = true;
  status = celd_level_ownership_new (ink, NULL, levels, NULL, NULL, settings->expansion, &first, &made);
  if (status == CELD_OK)
    status = celd_level_background (&made, &background);
  if (status == CELD_OK)
    status = celd_level_layers_cut (&made, ink, art, CELD_STORE_FLOAT, &whole, &second, &layers);
  if (status == CELD_OK)
    status = celd_puppet_new (layers, ink, NULL, background, NULL, settings, &third, &puppet);
  if (status == CELD_OK)
    status = note_values (&made, puppet);
  celd_layers_free (layers);
  celd_level_ownership_clear (&made);
  if (status == CELD_OK)
    *result = puppet;
  else
    celd_puppet_free (puppet);
  return status;
}
