/* Components and enclosures joined over bridges.
 *
 * Bridges cut paper that is one: what is one part of the drawing without them stays one component, and enclosures are
 * joined over all but the bridges of narrow gaps (basins.c).  A bridge from a single end to the ink ahead is a mere
 * guess, so it parts nothing but basins.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "segment/basins.h"
#include "segment/bridges.h"

#include <math.h>
#include <string.h>

#define GAP 2.0 /* stroke widths: over shorter bridges enclosures are not joined */

/* Joins the parts on both sides of bridges that are longer than `length` pixels or have one end only: those hold no
 * paint back. */
static void
join (const CeldBridges *bridges, double length, const CeldPlane *ink, const CeldBasins *basins, const uint32_t *part,
      uint32_t *parent)
{
  for (size_t i = 0; i < bridges->n; i++)
    for (size_t k = 0; k < bridges->item[i].n && (bridges->item[i].ahead || bridges->item[i].length > length); k++)
      {
        CeldBridgePixel p = bridges->pixel[bridges->item[i].first + k];
        uint32_t        mine = part[celd_basin_at (basins, p.x, p.y)];

        for (int y = p.y > 0 ? p.y - 1 : 0; y <= p.y + 1 && y < ink->height; y++)
          for (int x = p.x > 0 ? p.x - 1 : 0; x <= p.x + 1 && x < ink->width; x++)
            if ((x == p.x) != (y == p.y) && celd_is_paper (CELD_AT (ink, x, y)))
              {
                uint32_t other = part[celd_basin_at (basins, x, y)];

                if (mine && other)
                  celd_join (parent, mine, other);
              }
      }
}

/* Renumbers the parts by their first basins. */
static void
renumber (uint32_t *parent, uint32_t *number, size_t n, uint32_t *part, size_t *n_parts)
{
  *n_parts = 0;
  for (size_t k = 0; k < n; k++)
    if (part[k])
      {
        uint32_t root = celd_root (parent, part[k]);

        if (!number[root])
          number[root] = (uint32_t) ++*n_parts;
        part[k] = number[root];
      }
}

static CeldStatus
join_parts (const CeldBridges *bridges, double length, const CeldPlane *ink, const CeldBasins *basins, uint32_t *part,
            size_t *n_parts)
{
  uint32_t *parent = celd_alloc (*n_parts + 1, sizeof *parent), *number = celd_alloc0 (*n_parts + 1, sizeof *number);
  bool      enough = parent && number;

  if (enough)
    {
      celd_roots (parent, *n_parts + 1);
      join (bridges, length, ink, basins, part, parent);
      renumber (parent, number, basins->n, part, n_parts);
    }
  celd_free (parent);
  celd_free (number);
  return enough ? CELD_OK : CELD_NO_MEMORY;
}

CeldStatus
celd_bridges_join (const CeldBridges *bridges, const CeldPlane *ink, CeldBasins *basins, uint32_t **bridged_component)
{
  uint32_t  *bridged = celd_alloc (basins->n, sizeof *bridged);
  size_t     n = basins->n_components;
  CeldStatus status = bridged ? CELD_OK : CELD_NO_MEMORY;

  if (bridged)
    memcpy (bridged, basins->component, basins->n * sizeof *bridged);
  if (status == CELD_OK)
    status = join_parts (bridges, INFINITY, ink, basins, bridged, &n);
  if (status == CELD_OK)
    status = join_parts (bridges, 0, ink, basins, basins->component, &basins->n_components);
  if (status == CELD_OK)
    status = join_parts (bridges, GAP * basins->stroke, ink, basins, basins->enclosure, &basins->n_enclosures);
  if (status == CELD_OK)
    *bridged_component = bridged;
  else
    celd_free (bridged);
  return status;
}
