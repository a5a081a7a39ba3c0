/* Components and enclosures joined over bridges.
 *
 * Bridges cut paper that is one: what is one part of the drawing without them stays one component, and enclosures are
 * joined over all but the bridges of narrow gaps (basins.c).  A bridge from a single end to the ink ahead is a mere
 * guess, so it parts nothing but basins; but where a line stops short of another one, and the parts on both sides are
 * wider than that gap, the page with bridges as lines has two rooms there.
 *
 * Nobody drew a bridge: paint that is missing on one side comes over it rather than through ink.  So what it parts is
 * listed as passages.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "segment/basins.h"
#include "segment/bridges.h"

#include <math.h>
#include <string.h>

#define GAP          2.0       /* stroke widths: over shorter bridges enclosures are not joined */
#define BEYOND_FRAME INT32_MAX /* wider than the page */

/* Parts of the drawing, and which of them are joined.  `widest`: of the largest disc in each, by root, the squared
 * radius; BEYOND_FRAME if the part is cut off by the frame. */
typedef struct
{
  const CeldBridges *bridges;
  const CeldPlane   *ink;
  const CeldBasins  *basins;
  const uint32_t    *part;
  uint32_t          *parent;
  int32_t           *widest;
} PartsJoin;

/* The part on the paper beside a pixel: right, below, left, above; 0: none. */
static uint32_t
part_beside (const PartsJoin *s, CeldBridgePixel p, int side)
{
  int x = p.x + celd_step_x[side], y = p.y + celd_step_y[side];

  if (x < 0 || y < 0 || x >= s->ink->width || y >= s->ink->height || !celd_is_paper (CELD_AT (s->ink, x, y)))
    return 0;
  return s->part[celd_basin_at (s->basins, x, y)];
}

static void
join_over (PartsJoin *s, const CeldBridge *bridge)
{
  for (size_t k = bridge->first; k < bridge->first + bridge->n; k++)
    {
      CeldBridgePixel p = s->bridges->pixel[k];
      uint32_t        mine = s->part[celd_basin_at (s->basins, p.x, p.y)];

      for (int side = 0; side < 4; side++)
        {
          uint32_t other = part_beside (s, p, side), a = celd_root (s->parent, mine), b = celd_root (s->parent, other);

          if (!mine || !other || a == b)
            continue;
          s->widest[a] = s->widest[b] = s->widest[a] > s->widest[b] ? s->widest[a] : s->widest[b];
          celd_join (s->parent, a, b);
        }
    }
}

/* Does the end of a line nearly shut a room?  Then the gap is clearly narrower than the parts on both sides, while an
 * open mouth is about as wide as what is behind it; and one of them is enclosed by ink, not by the frame. */
static bool
shuts (const PartsJoin *s, const CeldBridge *bridge)
{
  int32_t narrower = BEYOND_FRAME;

  for (size_t k = bridge->first; k < bridge->first + bridge->n; k++)
    for (int side = 0; side < 4; side++)
      {
        uint32_t part = part_beside (s, s->bridges->pixel[k], side);
        int32_t  widest = part ? s->widest[celd_root (s->parent, part)] : BEYOND_FRAME;

        narrower = widest < narrower ? widest : narrower;
      }
  return bridge->line && narrower < BEYOND_FRAME && celd_is_clearly_wider (sqrt (narrower), bridge->length / 2);
}

/* Does the bridge hold no paint back?  Such are longer than `length` pixels or have one end only. */
static bool
holds_nothing_back (const CeldBridge *bridge, double length)
{
  return bridge->ahead || bridge->length > length;
}

/* Joins over bridges that hold no paint back.  `rooms`: not over those of a single end that nearly shut a room. */
static void
join (PartsJoin *s, double length, bool rooms)
{
  for (size_t i = 0; i < s->bridges->n; i++)
    {
      const CeldBridge *bridge = &s->bridges->item[i];

      if (holds_nothing_back (bridge, length) && !(rooms && bridge->ahead && shuts (s, bridge)))
        join_over (s, bridge);
    }
}

static void
mark_beyond (PartsJoin *s, int x, int y)
{
  if (celd_is_paper (CELD_AT (s->ink, x, y)))
    s->widest[s->part[celd_basin_at (s->basins, x, y)]] = BEYOND_FRAME;
}

static void
measure (PartsJoin *s)
{
  int width = s->ink->width, height = s->ink->height;

  for (size_t k = 0; k < s->basins->n; k++)
    {
      int32_t *widest = &s->widest[s->part[k]];

      *widest = *widest > s->basins->basin[k].squared ? *widest : s->basins->basin[k].squared;
    }
  for (int x = 0; x < width; x++)
    {
      mark_beyond (s, x, 0);
      mark_beyond (s, x, height - 1);
    }
  for (int y = 0; y < height; y++)
    {
      mark_beyond (s, 0, y);
      mark_beyond (s, width - 1, y);
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
join_parts (const CeldBridges *bridges, double length, bool rooms, const CeldPlane *ink, const CeldBasins *basins,
            uint32_t *part, size_t *n_parts)
{
  PartsJoin s = { bridges, ink, basins, part, celd_alloc (*n_parts + 1, sizeof *s.parent),
                  celd_alloc0 (*n_parts + 1, sizeof *s.widest) };
  uint32_t *number = celd_alloc0 (*n_parts + 1, sizeof *number);
  bool      enough = s.parent && s.widest && number;

  if (enough)
    {
      celd_roots (s.parent, *n_parts + 1);
      if (rooms)
        measure (&s);
      join (&s, length, rooms);
      renumber (s.parent, number, basins->n, part, n_parts);
    }
  celd_free (s.parent);
  celd_free (s.widest);
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
    status = join_parts (bridges, INFINITY, true, ink, basins, bridged, &n);
  if (status == CELD_OK)
    status = join_parts (bridges, 0, false, ink, basins, basins->component, &basins->n_components);
  if (status == CELD_OK)
    status = join_parts (bridges, GAP * basins->stroke, false, ink, basins, basins->enclosure,
                         &basins->n_enclosures);
  if (status == CELD_OK)
    *bridged_component = bridged;
  else
    celd_free (bridged);
  return status;
}

/* ------------------------------------------------------------------ passages */

/* The basin of the paper at (x,y); false if there is none. */
static bool
paper_basin (const CeldPlane *ink, const CeldBasins *basins, int x, int y, uint32_t *basin)
{
  if (x < 0 || y < 0 || x >= ink->width || y >= ink->height || !celd_is_paper (CELD_AT (ink, x, y)))
    return false;
  *basin = celd_basin_at (basins, x, y);
  return true;
}

/* Of the largest disc in each merged basin, the squared radius; NULL: no memory. */
static int32_t *
find_widest (const CeldBasins *basins)
{
  int32_t *widest = celd_alloc0 (basins->n_merged + 1, sizeof *widest);

  for (size_t k = 0; k < basins->n && widest; k++)
    if (widest[basins->merged[k]] < basins->basin[k].squared)
      widest[basins->merged[k]] = basins->basin[k].squared;
  return widest;
}

/* Is a bridge a mere guess about where a bay opens? */
static bool
is_mouth (const CeldBridge *bridge, const CeldBasins *basins, const int32_t *widest, const CeldPassage *pair)
{
  int32_t a = widest[basins->merged[pair->a]], b = widest[basins->merged[pair->b]];

  return bridge->ahead && !celd_is_clearly_wider (sqrt (a < b ? a : b), bridge->length / 2);
}

CeldStatus
celd_bridges_find_passages (const CeldBridges *bridges, const CeldPlane *ink, const CeldBasins *basins,
                            CeldPassage **passage, size_t *n)
{
  static const int step[4][2] = { { 1, 0 }, { 0, 1 }, { -1, 0 }, { 0, -1 } };
  CeldPassage     *found = NULL;
  size_t           n_found = 0, capacity = 0;
  int32_t         *widest = find_widest (basins);
  CeldStatus       status = widest ? CELD_OK : CELD_NO_MEMORY;

  for (size_t i = 0; i < bridges->n; i++)
    for (size_t k = bridges->item[i].first; k < bridges->item[i].first + bridges->item[i].n; k++)
      {
        CeldBridgePixel p = bridges->pixel[k];
        CeldPassage     pair = { .a = celd_basin_at (basins, p.x, p.y),
                                 .narrow = !holds_nothing_back (&bridges->item[i], GAP * basins->stroke) };

        for (int side = 0; side < 4 && status == CELD_OK; side++)
          if (paper_basin (ink, basins, p.x + step[side][0], p.y + step[side][1], &pair.b) && pair.b != pair.a)
            {
              pair.mouth = is_mouth (&bridges->item[i], basins, widest, &pair);
              status     = celd_append (found, n_found, capacity, pair);
            }
      }
  celd_free (widest);
  if (status != CELD_OK)
    {
      celd_free (found);
      return status;
    }
  *passage = found;
  *n       = n_found;
  return CELD_OK;
}
