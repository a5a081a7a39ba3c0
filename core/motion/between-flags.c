/* Which pixels of a layer are known from which key.
 *
 * Of a part a key shows what nothing hides there; the rest of its layer is a guess.  Where the other key shows the
 * place it knows better.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/inbetween.h"

/* Whether a place is hidden in the other key, or outside of its frame. */
static bool
is_unknown (const CeldPuppet *other, size_t layer, const float place[2])
{
  int x = (int) floorf (place[0]), y = (int) floorf (place[1]);

  return x < 0 || y < 0 || x >= other->width || y >= other->height ||
         other->front[(size_t) y * (size_t) other->width + (size_t) x] > layer;
}

/* Where a pixel of a layer is in the other key; the lattice has its places of that key. */
static void
find_place (const CeldPuppet *puppet, const CeldPuppetLayer *layer, int x, int y, float place[2])
{
  uint32_t cell = layer->cell ? layer->cell[celd_puppet_pixel (layer, x, y)] : 0;

  place[0] = (float) x + 0.5f;
  place[1] = (float) y + 0.5f;
  if (cell)
    celd_cell_map (&puppet->lattice, cell - 1, place[0], place[1], place);
}

static CeldStatus
flag_layer (CeldInbetween *between, CeldBetweenPart *part, int s)
{
  const CeldPuppet      *puppet = between->key[s];
  const CeldPuppetLayer *layer = &puppet->layer[part->layer[s]];
  int                    rows = layer->box.height + 2 * CELD_PUPPET_PAD;
  float                 *flags = celd_alloc0 (celd_puppet_stride (layer) * (size_t) rows, 4 * sizeof *flags);

  between->flags[s][part->layer[s]] = flags;
  if (!flags)
    return CELD_NO_MEMORY;
  for (int y = layer->box.y; y < layer->box.y + layer->box.height; y++)
    for (int x = layer->box.x; x < layer->box.x + layer->box.width; x++)
      {
        size_t at = 4 * celd_puppet_pixel (layer, x, y);
        float  alpha = layer->rgba[at + 3], place[2];
        bool   seen = puppet->front[(size_t) y * (size_t) puppet->width + (size_t) x] == part->layer[s], unknown;

        if (!(alpha > 0))
          continue;
        find_place (puppet, layer, x, y, place);
        unknown = is_unknown (between->key[!s], part->layer[!s], place);
        flags[at + CELD_KEY_SEEN]    = seen ? alpha : 0;
        flags[at + CELD_KEY_UNKNOWN] = unknown ? alpha : 0;
        flags[at + 3]            = alpha;
        part->mixed[s]  |= !seen;
        part->mixed[!s] |= seen && unknown;
      }
  return CELD_OK;
}

CeldStatus
celd_between_flags (CeldInbetween *between)
{
  CeldStatus status = CELD_OK;

  for (int s = 0; s < 2; s++)
    {
      CeldLattice *lattice = &between->key[s]->lattice;

      memcpy (lattice->place, between->end[s], 2 * lattice->n_vertices * sizeof *lattice->place);
      for (size_t p = 0; p < between->n && status == CELD_OK; p++)
        if (between->part[p].layer[0] != CELD_NO_INDEX && between->part[p].layer[1] != CELD_NO_INDEX)
          status = flag_layer (between, &between->part[p], s);
    }
  return status;
}
