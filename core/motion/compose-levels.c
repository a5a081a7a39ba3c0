/* Composition of two pictures of which levels are known: one put between the levels of the other.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/compose.h"
#include "ownership/ownership.h"

/* A picture as a fragment. */
typedef struct
{
  CeldLevelOwnership made;
  CeldOrder          order;
  CeldPalette        palette;     /* as many labels as there are; without items, since no term names a colour */
  CeldLayers        *layers;
} LevelLayers;

static void
level_layers_clear (LevelLayers *l)
{
  celd_layers_free (l->layers);
  celd_level_ownership_clear (&l->made);
}

/* One layer for each level. */
static CeldStatus
cut_levels (const CeldLevelArt *piece, const CeldHost *host, LevelLayers *l)
{
  CeldStatus status = CELD_SAME_SIZE (piece->levels, piece->ink)
                    ? celd_expanded_ownership_new (piece->ink, piece->levels, &l->made) : CELD_BAD_SIZE;

  if (status != CELD_OK)
    return status;
  l->order   = (CeldOrder) { .level = l->made.order, .n = l->made.n };
  l->palette = (CeldPalette) { NULL, l->made.n };
  for (size_t k = 0; k < l->made.n; k++)
    l->order.levels = l->made.order[k] + 1 > l->order.levels ? l->made.order[k] + 1 : l->order.levels;
  return celd_layers_cut (piece->ink, &l->made.own, l->made.order, l->made.n, piece->art, NULL, CELD_STORE_FLOAT, host,
                          &l->layers);
}

/* A pixel of the farthest level above a limit; false if there is none. */
static bool
find_level_above (const LevelLayers *l, float limit, CeldTerm *term)
{
  const CeldLabels *label = &l->made.own.owner;
  size_t            k = 0;

  while (k < l->made.n && !(l->made.level[k] > limit))
    k++;
  for (int y = 0; y < label->height; y++)
    for (int x = 0; x < label->width; x++)
      if (CELD_AT (label, x, y) == k + 1)
        {
          *term = (CeldTerm) { .x = x, .y = y };
          return true;
        }
  return false;
}

static CeldStatus
compose (const LevelLayers l[2], const CeldPlacement *placement, float between, const CeldHost *host,
         CeldComposition **composition)
{
  CeldFragment  fragment[2];
  CeldRelation  behind = { .farther = { .fragment = 1, .whole = true }, .weight = 1, .gap = 1 };
  CeldRelations relations = { &behind, find_level_above (&l[0], between, &behind.nearer) };

  for (int i = 0; i < 2; i++)
    fragment[i] = (CeldFragment) { l[i].layers, &l[i].order, l[i].made.n > 1, { .scale = 1 }, &l[i].made.own.owner,
                                   &l[i].palette, NULL };
  fragment[1].placement = *placement;
  return celd_compose (fragment, 2, &relations, l[0].layers->width, l[0].layers->height, host, NULL, composition);
}

CeldStatus
celd_compose_levels (const CeldLevelArt piece[2], const CeldPlacement *placement, float between, const CeldHost *host,
                     CeldColours *picture, CeldPlane *levels)
{
  LevelLayers      l[2] = { 0 };
  CeldComposition *composition = NULL;
  CeldHostPart     part[5];
  CeldHost         step[5];
  CeldStatus       status = CELD_OK;

  for (int i = 0; i < 5; i++)
    step[i] = celd_host_part (&part[i], host, i / 5.0, (i + 1) / 5.0);
  for (int i = 0; i < 2 && status == CELD_OK; i++)
    status = cut_levels (&piece[i], &step[i], &l[i]);
  if (status == CELD_OK)
    status = compose (l, placement, between, &step[2], &composition);
  if (status == CELD_OK && levels)
    status = celd_composition_levels (composition, &step[3], levels);
  for (int y = 0; status == CELD_OK && levels && y < levels->height; y++)
    for (int x = 0; x < levels->width && composition->levels > 1; x++)
      CELD_AT (levels, x, y) /= (float) (composition->levels - 1);
  if (status == CELD_OK && picture)
    status = celd_composition_flatten (composition, &step[4], picture);
  celd_composition_free (composition);
  level_layers_clear (&l[0]);
  level_layers_clear (&l[1]);
  return status;
}
