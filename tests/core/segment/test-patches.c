/* Patches: runs that continue one another are one.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "segment/labelling.h"

static void
runs_that_continue_one_another_are_one (void)
{
  CeldPatches patches = { 0 };

  for (int k = 0; k < 30; k++)
    for (int x = 0; x < 4; x++)
      CHECK (celd_patch_add (&patches, (CeldPatch) { k, x, x + 1, x < 3 ? 1 : 2 }) == CELD_OK);
  NEAR (patches.n, 60, 0);
  for (int k = 0; k < 30 && patches.n == 60; k++)
    {
      CeldPatch three = patches.item[2 * k], one = patches.item[2 * k + 1];

      CHECK (three.y == k && three.x == 0 && three.end == 3 && three.label == 1);
      CHECK (one.y == k && one.x == 3 && one.end == 4 && one.label == 2);
    }
  celd_patches_clear (&patches);
  CHECK (!patches.item && !patches.n);
  celd_patches_clear (&patches);
}

/* The same row, label or end alone makes no neighbour. */
static void
others_are_apart (void)
{
  CeldPatches patches = { 0 };

  CHECK (celd_patch_add (&patches, (CeldPatch) { 3, 0, 2, 1 }) == CELD_OK);
  CHECK (celd_patch_add (&patches, (CeldPatch) { 3, 3, 5, 1 }) == CELD_OK);
  CHECK (celd_patch_add (&patches, (CeldPatch) { 4, 5, 6, 1 }) == CELD_OK);
  CHECK (celd_patch_add (&patches, (CeldPatch) { 4, 6, 7, 2 }) == CELD_OK);
  NEAR (patches.n, 4, 0);
  celd_patches_clear (&patches);
}

int
main (void)
{
  RUN (runs_that_continue_one_another_are_one);
  RUN (others_are_apart);
  return DONE;
}
