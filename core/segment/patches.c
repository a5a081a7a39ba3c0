/* Patches: a list that grows.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "segment/patches.h"

CeldStatus
celd_patch_add (CeldPatches *patches, CeldPatch patch)
{
  CeldPatch *item = patches->n ? &patches->item[patches->n - 1] : NULL;

  if (item && item->y == patch.y && item->end == patch.x && item->label == patch.label)
    {
      item->end = patch.end; /* added pixel by pixel, they are one run all the same */
      return CELD_OK;
    }
  item = celd_grow (patches->item, patches->n + 1, sizeof *item);
  if (!item)
    return CELD_NO_MEMORY;
  patches->item = item;
  item[patches->n++] = patch;
  return CELD_OK;
}

void
celd_patches_clear (CeldPatches *patches)
{
  celd_free (patches->item);
  *patches = (CeldPatches) { 0 };
}
