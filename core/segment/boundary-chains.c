/* Chains of boundary edges across paper, found without a pass over the picture.
 *
 * The boundary of two basins with different labels crosses paper where it has an opening, and the pair at its saddle is
 * part of that.  From there the edges between the two labels are followed both ways.  If two basins meet in several
 * openings, the boundary names only one of them, and fewer edges are found than the openings have; then the region's
 * outline is followed all round: basins are connected, so all places where two of them meet lie on one such loop.
 *
 * Cost: the length of the chains, and of the loops where edges are missing.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "image/image.h"
#include "segment/basins.h"
#include "segment/bridges.h"
#include "segment/closures.h"
#include "segment/task.h"

#include <stdlib.h>
#include <string.h>

typedef struct
{
  const CeldPlane  *ink;
  const CeldLabels *labels;
  CeldChains       *chains;
  uint32_t         *known;       /* hash set of edges found so far, 0: empty */
  size_t            capacity, n; /* a power of two */
} ChainTracer;

/* ------------------------------------------------------------------ edges found so far */

/* The number, from 1, of the edge that leaves a corner with this heading. */
static uint32_t
edge_number (const ChainTracer *t, CeldCorner corner, int heading)
{
  uint32_t x = (uint32_t) (corner.x - (heading == 2)), y = (uint32_t) (corner.y - (heading == 3));

  return 2 * (y * ((uint32_t) t->labels->width + 1) + x) + (uint32_t) (heading & 1) + 1;
}

/* The slot of an edge in the table, or where it would be inserted. */
static size_t
edge_place (const uint32_t *known, size_t capacity, uint32_t edge)
{
  size_t i = (size_t) ((uint64_t) (uint32_t) (edge * 2654435769u) * capacity >> 32); /* by the golden ratio [Knu73] */

  while (known[i] && known[i] != edge)
    i = (i + 1) & (capacity - 1);
  return i;
}

static CeldStatus
add_edge (ChainTracer *t, uint32_t edge)
{
  if (2 * t->n >= t->capacity)
    {
      size_t    capacity = t->capacity ? 2 * t->capacity : 1024;
      uint32_t *known = celd_alloc0 (capacity, sizeof *known);

      if (!known)
        return CELD_NO_MEMORY;
      for (size_t i = 0; i < t->capacity; i++)
        if (t->known[i])
          known[edge_place (known, capacity, t->known[i])] = t->known[i];
      celd_free (t->known);
      t->known = known;
      t->capacity  = capacity;
    }
  t->known[edge_place (t->known, t->capacity, edge)] = edge;
  t->n++;
  return CELD_OK;
}

static bool
is_known (const ChainTracer *t, uint32_t edge)
{
  return t->capacity && t->known[edge_place (t->known, t->capacity, edge)];
}

/* ------------------------------------------------------------------ pixels round a corner */

/* The pixel ahead to the left; that to the right is the one for the next heading. */
static CeldCorner
pixel_ahead (CeldCorner corner, int heading)
{
  return (CeldCorner) { corner.x - ((heading & 3) >= 2), corner.y - ((heading & 3) == 0 || (heading & 3) == 3) };
}

static bool
is_inside (const ChainTracer *t, CeldCorner pixel)
{
  return pixel.x >= 0 && pixel.y >= 0 && pixel.x < t->labels->width && pixel.y < t->labels->height;
}

/* The label of the pixel ahead to the left; 0 outside. */
static uint32_t
label_ahead (const ChainTracer *t, CeldCorner corner, int heading)
{
  CeldCorner pixel = pixel_ahead (corner, heading);

  return is_inside (t, pixel) ? CELD_AT (t->labels, pixel.x, pixel.y) : 0;
}

/* The label of the pixel ahead to the left; 0 outside and on ink. */
static uint32_t
paper_ahead (const ChainTracer *t, CeldCorner corner, int heading)
{
  CeldCorner pixel = pixel_ahead (corner, heading);

  return is_inside (t, pixel) && celd_is_paper (CELD_AT (t->ink, pixel.x, pixel.y)) ?
         CELD_AT (t->labels, pixel.x, pixel.y) : 0;
}

/* ------------------------------------------------------------------ one chain */

/* The heading with which the edges between two labels continue, or -1.  Where four pixels meet crosswise the smaller
 * label stays connected, in either direction. */
static int
next_heading (const ChainTracer *t, CeldCorner corner, int heading, uint32_t left, uint32_t right)
{
  uint32_t l = paper_ahead (t, corner, heading), r = paper_ahead (t, corner, heading + 1);

  if ((l && l != left && l != right) || (r && r != left && r != right))
    return -1;
  if (l == left && r == right)
    return heading;
  if (l == right && (r != left || right < left))
    return (heading + 3) & 3;
  return r == left ? (heading + 1) & 3 : -1;
}

static CeldStatus
add_corner (CeldChains *chains, CeldCorner corner)
{
  return celd_append (chains->corner, chains->n_corners, chains->corner_capacity, corner);
}

/* What a chain ends at in this corner. */
static CeldChainEnd
end_of_chain (const ChainTracer *t, CeldCorner corner, int heading, CeldCorner *ink)
{
  for (int i = 0; i < 2; i++)
    {
      *ink = pixel_ahead (corner, heading + i);
      if (!is_inside (t, *ink))
        return CELD_CHAIN_FRAME;
      if (!celd_is_paper (CELD_AT (t->ink, ink->x, ink->y)))
        return CELD_CHAIN_INK;
    }
  return CELD_CHAIN_JUNCTION;
}

/* Adds a corner, reached with this heading, and all that follow, up to the chain's end or the edge `first`. */
static CeldStatus
follow (ChainTracer *t, CeldCorner corner, int heading, uint32_t left, uint32_t right, uint32_t first,
        CeldChainEnd *end, CeldCorner *ink)
{
  CeldStatus status = add_corner (t->chains, corner);

  while (status == CELD_OK)
    {
      int      next = next_heading (t, corner, heading, left, right);
      uint32_t edge = next < 0 ? 0 : edge_number (t, corner, next);

      if (next < 0 || edge == first)
        {
          *end = next < 0 ? end_of_chain (t, corner, heading, ink) : CELD_CHAIN_LOOP;
          break;
        }
      corner.x += celd_step_x[next];
      corner.y += celd_step_y[next];
      heading   = next;
      status    = add_edge (t, edge);
      if (status == CELD_OK)
        status = add_corner (t->chains, corner);
    }
  return status;
}

/* Adds the chain through the edge between a pixel and the one below (south) or to its right, if it is a boundary on
 * paper and new. */
static CeldStatus
trace (ChainTracer *t, int x, int y, bool south)
{
  CeldChains *chains = t->chains;
  CeldChain   chain = { .first = chains->n_corners };
  CeldCorner  from = { x + !south, y + south }, to = { x + 1, y + 1 };
  int         heading = south ? 0 : 1;
  uint32_t    left, right, edge;
  CeldStatus  status;

  if (x < 0 || y < 0 || x + !south >= t->labels->width || y + south >= t->labels->height)
    return CELD_OK;
  left  = paper_ahead (t, from, heading);
  right = paper_ahead (t, from, heading + 1);
  edge  = edge_number (t, from, heading);
  if (!left || !right || left == right || is_known (t, edge))
    return CELD_OK;
  if (left > right)
    {
      CeldCorner c = from;
      uint32_t   l = left;

      from    = to;
      to      = c;
      left    = right;
      right   = l;
      heading = heading ^ 2;
    }
  chain.left  = left;
  chain.right = right;
  status = add_edge (t, edge);
  if (status == CELD_OK)
    status = follow (t, from, heading ^ 2, right, left, edge, &chain.end[0], &chain.ink[0]);
  for (size_t i = chain.first, j = chains->n_corners; status == CELD_OK && i + 1 < j; i++)
    {
      CeldCorner c = chains->corner[i];

      chains->corner[i] = chains->corner[--j];
      chains->corner[j] = c;
    }
  chain.end[1] = CELD_CHAIN_LOOP;
  if (status == CELD_OK && chain.end[0] != CELD_CHAIN_LOOP)
    status = follow (t, to, heading, left, right, edge, &chain.end[1], &chain.ink[1]);
  if (status != CELD_OK)
    return CELD_NO_MEMORY;
  chain.n = chains->n_corners - chain.first;
  return celd_append (chains->item, chains->n, chains->item_capacity, chain);
}

/* ------------------------------------------------------------------ where to look for chains */

static CeldStatus
trace_patches (ChainTracer *t, const CeldPatches *windows)
{
  CeldStatus status = CELD_OK;

  for (size_t i = 0; i < windows->n && status == CELD_OK; i++)
    {
      const CeldPatch *patch = &windows->item[i];

      status = trace (t, patch->x - 1, patch->y, false);
      for (int x = patch->x; x < patch->end && status == CELD_OK; x++)
        {
          status = trace (t, x, patch->y, true);
          if (status == CELD_OK)
            status = trace (t, x, patch->y - 1, true);
        }
      if (status == CELD_OK)
        status = trace (t, patch->end - 1, patch->y, false);
    }
  return status;
}

/* Counts the edges of the chains from number `first` on by the boundary of basins that they belong to. */
static void
count_passes (const CeldBasins *basins, const CeldChains *chains, size_t first, uint32_t *opening)
{
  for (size_t k = first; k < chains->n; k++)
    for (size_t i = chains->item[k].first; i + 1 < chains->item[k].first + chains->item[k].n; i++)
      {
        CeldCorner        p = chains->corner[i], q = chains->corner[i + 1];
        bool              south = p.y == q.y;
        int               x = (p.x < q.x ? p.x : q.x) - !south, y = (p.y < q.y ? p.y : q.y) - south;
        uint32_t          a = celd_basin_at (basins, x, y), b = celd_basin_at (basins, x + !south, y + south);
        CeldBasinBoundary key = { .a = a < b ? a : b, .b = a < b ? b : a }, *boundary;

        boundary = bsearch (&key, basins->boundary, basins->n_boundaries, sizeof key, celd_basin_boundary_compare);
        if (boundary)
          opening[boundary - basins->boundary]++;
      }
}

/* Follows the outline of the region to the left of an edge once round, and adds all chains on it. */
static CeldStatus
walk_around (ChainTracer *t, CeldCorner start, int first)
{
  CeldCorner corner = start;
  int        heading = first;
  uint32_t   label = label_ahead (t, start, first);
  CeldStatus status = CELD_OK;

  do
    {
      if (paper_ahead (t, corner, heading) && paper_ahead (t, corner, heading + 1))
        {
          CeldCorner p = pixel_ahead (corner, heading), q = pixel_ahead (corner, heading + 1);

          status = trace (t, p.x < q.x ? p.x : q.x, p.y < q.y ? p.y : q.y, p.x == q.x);
        }
      corner.x += celd_step_x[heading];
      corner.y += celd_step_y[heading];
      if (label_ahead (t, corner, heading) != label)
        heading = (heading + 3) & 3;
      else if (label_ahead (t, corner, heading + 1) == label)
        heading = (heading + 1) & 3;
    }
  while (status == CELD_OK && (corner.x != start.x || corner.y != start.y || heading != first));
  return status;
}

/* Finds chains on boundaries whose openings have more edges than were found. */
static CeldStatus
trace_missing (ChainTracer *t, const CeldBasins *basins, const uint32_t *label)
{
  uint32_t  *opening = celd_alloc0 (basins->n_boundaries, sizeof *opening);
  size_t     counted = 0;
  CeldStatus status = opening ? CELD_OK : CELD_NO_MEMORY;

  for (size_t i = 0; i < basins->n_boundaries && status == CELD_OK; i++)
    {
      const CeldBasinBoundary *boundary = &basins->boundary[i];
      CeldCorner               start = { boundary->x + !boundary->south, boundary->y + boundary->south };

      count_passes (basins, t->chains, counted, opening);
      counted = t->chains->n;
      if (opening[i] >= boundary->opening || label[boundary->a] == label[boundary->b])
        continue;
      if (label_ahead (t, start, boundary->south ? 0 : 1) != label_ahead (t, start, boundary->south ? 1 : 2))
        status = walk_around (t, start, boundary->south ? 0 : 1);
    }
  celd_free (opening);
  return status;
}

void
celd_chains_clear (CeldChains *chains)
{
  celd_free (chains->item);
  celd_free (chains->corner);
  *chains = (CeldChains) { 0 };
}

/* Adds chains along bridges, whose pixels are no openings. */
static CeldStatus
trace_bridges (ChainTracer *t, const CeldBridges *bridges)
{
  CeldStatus status = CELD_OK;

  for (size_t i = 0; i < bridges->n_pixels && status == CELD_OK; i++)
    {
      int x = bridges->pixel[i].x, y = bridges->pixel[i].y;

      for (int k = 0; k < 4 && status == CELD_OK; k++)
        {
          int u = x - (k == 1), v = y - (k == 3), south = k >= 2;

          if (u >= 0 && v >= 0 && u + !south < t->labels->width && v + south < t->labels->height &&
              CELD_AT (t->labels, u, v) != CELD_AT (t->labels, u + !south, v + south) &&
              celd_is_paper (CELD_AT (t->ink, u, v)) && celd_is_paper (CELD_AT (t->ink, u + !south, v + south)))
            status = trace (t, u, v, south);
        }
    }
  return status;
}

CeldStatus
celd_chains_find (const CeldSegmentTask *task, const uint32_t *label, const CeldLabels *labels,
                  const CeldPatches *windows, CeldChains *chains)
{
  const CeldBasins *basins = task->basins;
  ChainTracer       t = { .ink = task->ink, .labels = labels, .chains = chains };
  size_t            wanted = 0, found = 0;
  CeldStatus        status = CELD_OK;

  *chains = (CeldChains) { 0 };
  for (size_t i = 0; i < basins->n_boundaries && status == CELD_OK; i++)
    {
      const CeldBasinBoundary *boundary = &basins->boundary[i];

      if (!boundary->opening || label[boundary->a] == label[boundary->b])
        continue;
      wanted += boundary->opening;
      status  = trace (&t, boundary->x, boundary->y, boundary->south);
    }
  if (status == CELD_OK && task->bridges)
    status = trace_bridges (&t, task->bridges);
  if (status == CELD_OK)
    status = trace_patches (&t, windows);
  for (size_t k = 0; k < chains->n; k++)
    found += chains->item[k].n - 1;
  if (status == CELD_OK && (found < wanted || windows->n))
    status = trace_missing (&t, basins, label);
  celd_free (t.known);
  if (status != CELD_OK)
    celd_chains_clear (chains);
  return status;
}
