/* What several key drawings of a clip have in common: one palette, and relations that hold in all of them.
 *
 * A region is known by the colour of its scribbles, which is the same in each key.  The background is one region,
 * whatever its colour, since it is scribbled in some keys and left to the segmentation in others.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"

#include <string.h>

/* ------------------------------------------------------------------ labels */

/* The label of a region in a palette; 0: it is not there. */
static uint32_t
find (const CeldPalette *palette, const CeldRegion *region)
{
  for (size_t k = 0; k < palette->n; k++)
    if (region->background ? palette->item[k].background : !memcmp (palette->item[k].colour, region->colour, 4))
      return (uint32_t) k + 1;
  return 0;
}

CeldStatus
celd_join_labels (const CeldLabels *labels, const CeldPalette *palette, CeldPalette *all, CeldLabels *joined)
{
  uint32_t  *number; /* of each label, in the palette of all */
  size_t     before = all->n;
  CeldStatus status = CELD_OK;

  if (!CELD_SAME_SIZE (labels, joined))
    return CELD_BAD_SIZE;
  if (celd_labels_beyond (labels, palette->n))
    return CELD_BAD_VALUE;
  number = celd_alloc0 (palette->n + 1, sizeof *number);
  if (!number)
    return CELD_NO_MEMORY;
  for (size_t k = 0; k < palette->n && status == CELD_OK; k++)
    {
      number[k + 1] = find (all, &palette->item[k]);
      if (number[k + 1])
        continue;
      status        = celd_append_uncounted (all->item, all->n, palette->item[k]);
      number[k + 1] = (uint32_t) all->n;
    }
  for (int y = 0; y < labels->height && status == CELD_OK; y++)
    for (int x = 0; x < labels->width; x++)
      CELD_AT (joined, x, y) = number[CELD_AT (labels, x, y)];
  if (status != CELD_OK)
    all->n = before;
  celd_free (number);
  return status;
}

/* ------------------------------------------------------------------ relations */

/* Names an end by the colour of the region at its place; false if there is none. */
static bool
name_term (const CeldLabels *labels, const CeldPalette *palette, CeldTerm *term)
{
  const CeldRegion *region;
  uint32_t          label;

  if (term->by_colour)
    return true;
  if (!(term->x >= 0 && term->y >= 0 && term->x < labels->width && term->y < labels->height)) /* also NaN */
    return false;
  label = CELD_AT (labels, (int) term->x, (int) term->y);
  if (!label || label > palette->n)
    return false;
  region          = &palette->item[label - 1];
  term->by_colour = true;
  memcpy (term->colour, region->colour, 3);
  return region->colour[3] > 0;
}

bool
celd_relation_by_colour (const CeldLabels *labels, const CeldPalette *palette, CeldRelation *relation)
{
  CeldRelation named = *relation;

  if (!name_term (labels, palette, &named.nearer) || !name_term (labels, palette, &named.farther) ||
      !memcmp (named.nearer.colour, named.farther.colour, 3))
    return false;
  *relation = named;
  return true;
}
