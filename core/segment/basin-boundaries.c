/* The boundaries between basins: the smoothness cost along each, and the widest place of its opening in paper.
 *
 * Only ends of runs are visited, and columns where the basins of two rows differ.  Pairs of basins are found in a hash
 * table with a small cache in front.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "segment/basin-steps.h"
#include "segment/basins.h"

#include <stdlib.h>
#include <string.h>

#define ROWS_PER_REPORT 256 /* rows between two reports of progress */
#define RECENT_SLOTS    512 /* of the cache; a power of two (chosen) */

typedef struct { uint32_t a, b; size_t boundary; } Slot; /* a = b: empty */

typedef struct
{
  const CeldPlane       *ink;
  const CeldBasinExtent *extent;
  const CeldBasins      *basins;
  CeldBasinBoundary     *boundary;
  size_t                 n;
  Slot                  *slot;                 /* hash table by the two basins, open addressing */
  size_t                 n_slots;              /* a power of two, more than twice n */
  Slot                   recent[RECENT_SLOTS]; /* cache of slots used lately */
  size_t                 boundary_capacity;
} Boundaries;

static Slot *
find_slot (const Boundaries *b, uint32_t first, uint32_t second)
{
  uint64_t key = ((uint64_t) first << 32 | second) * 0x9e3779b97f4a7c15u;
  size_t   i = (size_t) (key ^ key >> 32) & (b->n_slots - 1);

  while (b->slot[i].a != b->slot[i].b && (b->slot[i].a != first || b->slot[i].b != second))
    i = (i + 1) & (b->n_slots - 1);
  return &b->slot[i];
}

static bool
grow_slots (Boundaries *b)
{
  size_t n_slots = b->n_slots ? 2 * b->n_slots : 1024;
  Slot  *slot = celd_alloc0 (n_slots, sizeof *slot);

  if (!slot)
    return false;
  celd_free (b->slot);
  b->slot = slot;
  b->n_slots = n_slots;
  for (size_t i = 0; i < b->n; i++)
    *find_slot (b, b->boundary[i].a, b->boundary[i].b) = (Slot) { b->boundary[i].a, b->boundary[i].b, i };
  return true;
}

/* The boundary of two basins, added if it is new; NULL: no memory. */
static CeldBasinBoundary *
find_boundary (Boundaries *b, uint32_t first, uint32_t second)
{
  uint32_t           least = first < second ? first : second, most = first < second ? second : first;
  Slot              *slot, *recent = &b->recent[(most ^ least * 37) % RECENT_SLOTS];
  CeldBasinBoundary *boundary;

  if (recent->a == least && recent->b == most)
    return &b->boundary[recent->boundary];
  if (2 * (b->n + 1) >= b->n_slots && !grow_slots (b))
    return NULL;
  slot = find_slot (b, least, most);
  if (slot->a != slot->b)
    {
      *recent = *slot;
      return &b->boundary[slot->boundary];
    }
  if (!celd_reserve_one (b->boundary, b->n, b->boundary_capacity))
    return NULL;
  *slot = *recent = (Slot) { least, most, b->n };
  boundary = &b->boundary[b->n++];
  *boundary = (CeldBasinBoundary) { .a = least, .b = most, .saddle = -1 };
  return boundary;
}

static bool
is_outermost (const CeldPlane *ink, int x, int y)
{
  return x == 0 || y == 0 || x == ink->width - 1 || y == ink->height - 1;
}

/* Does this pair replace the saddle?  Ties go to the first pair in reading order, east before south. */
static bool
comes_first (const CeldBasinBoundary *boundary, int32_t least, int x, int y, bool south)
{
  if (least != boundary->saddle)
    return least > boundary->saddle;
  if (y != boundary->y)
    return y < boundary->y;
  return x < boundary->x || (x == boundary->x && !south && boundary->south);
}

void
celd_basin_boundary_add (CeldBasinBoundary *boundary, const CeldBasinBoundary *more)
{
  boundary->cost += more->cost;
  boundary->weakness += more->weakness;
  boundary->opening += more->opening;
  boundary->frame = boundary->frame || more->frame;
  if (!comes_first (boundary, more->saddle, more->x, more->y, more->south))
    return;
  boundary->saddle = more->saddle;
  boundary->x = more->x;
  boundary->y = more->y;
  boundary->south = more->south;
}

/* The signed squared distance of pixel (x,y). */
static inline const int32_t *
squared_at (const CeldBasinExtent *extent, int x, int y)
{
  return extent->squared + (ptrdiff_t) (y - extent->box.y) * (ptrdiff_t) extent->stride + (x - extent->box.x);
}

/* Adds the pair of (x,y) and the pixel below it (south) or to its right. */
static void
add_pair (const Boundaries *b, CeldBasinBoundary *boundary, int x, int y, bool south)
{
  const CeldPlane  *ink = b->ink;
  int               qx = x + !south, qy = y + south;
  int32_t           p = *squared_at (b->extent, x, y), q = *squared_at (b->extent, qx, qy);
  bool              solid = b->basins->basin[boundary->a].solid && b->basins->basin[boundary->b].solid;
  bool              opening = p > 0 && q > 0;
  int32_t           cost;
  bool              along = south ? x == 0 || x == ink->width - 1 : y == 0 || y == ink->height - 1;
  CeldBasinBoundary pair = { .opening = opening, .x = x, .y = y, .south = south };

  cost = celd_smoothness_cost (&b->basins->costs, CELD_AT (ink, x, y), CELD_AT (ink, qx, qy), -p, -q, along);
  pair.cost = cost;
  pair.weakness = celd_barrier_weakness (&b->basins->costs, cost, -p < -q ? -p : -q);
  pair.saddle = opening ? (p < q ? p : q) : solid ? (-p < -q ? -p : -q) : 0;
  pair.frame = opening && is_outermost (ink, x, y) && is_outermost (ink, qx, qy);
  celd_basin_boundary_add (boundary, &pair);
}

static inline bool
is_rebuilt (const CeldBasinExtent *extent, int x, int y)
{
  int u = x - extent->box.x, v = y - extent->box.y;

  if (!extent->rebuilt)
    return true;
  return u >= 0 && v >= 0 && u < extent->box.width && v < extent->box.height &&
         extent->rebuilt[(size_t) v * (size_t) extent->box.width + (size_t) u];
}

/* Prefetches what the boundaries of a row read. */
static void
fetch_row (const Boundaries *b, int y)
{
  const CeldBasins *basins = b->basins;

  for (size_t i = basins->row[y]; i < basins->row[y + 1]; i++)
    {
      CELD_PREFETCH (squared_at (b->extent, basins->run[i].x, y));
      CELD_PREFETCH (&CELD_AT (b->ink, basins->run[i].x, y));
    }
}

static CeldStatus
add_row (Boundaries *b, int y)
{
  const CeldBasins   *basins = b->basins;
  const CeldBasinRun *run = basins->run + basins->row[y], *end = basins->run + basins->row[y + 1];
  const CeldBasinRun *below = end, *below_end = y + 1 < basins->height ? basins->run + basins->row[y + 2] : end;

  for (const CeldBasinRun *r = run + 1; r < end; r++)
    {
      CeldBasinBoundary *boundary;

      if (!is_rebuilt (b->extent, r->x - 1, y) && !is_rebuilt (b->extent, r->x, y))
        continue;
      boundary = find_boundary (b, r[-1].basin, r->basin);
      if (!boundary)
        return CELD_NO_MEMORY;
      add_pair (b, boundary, r->x - 1, y, false);
    }
  for (int x = 0, next; x < basins->width && below < below_end; x = next)
    {
      int                run_end = run + 1 < end ? run[1].x : basins->width;
      int                stop = below + 1 < below_end ? below[1].x : basins->width;
      CeldBasinBoundary *boundary;

      next = run_end < stop ? run_end : stop;
      boundary = NULL;
      for (x = run->basin == below->basin ? next : x; x < next; x++)
        if (is_rebuilt (b->extent, x, y) || is_rebuilt (b->extent, x, y + 1))
          {
            boundary = boundary ? boundary : find_boundary (b, run->basin, below->basin);
            if (!boundary)
              return CELD_NO_MEMORY;
            add_pair (b, boundary, x, y, true);
          }
      run += run_end == next;
      below += stop == next;
    }
  return CELD_OK;
}

int
celd_basin_boundary_compare (const void *a, const void *b)
{
  const CeldBasinBoundary *p = a, *q = b;

  if (p->a != q->a)
    return p->a < q->a ? -1 : 1;
  return p->b < q->b ? -1 : p->b > q->b;
}

CeldStatus
celd_basins_find_boundaries (const CeldPlane *ink, const CeldBasinExtent *extent, const CeldBasins *basins,
                             const CeldHost *host, CeldBasinBoundary **boundary, size_t *n)
{
  Boundaries b = { .ink = ink, .extent = extent, .basins = basins };
  int        top = extent->box.y, end = top + extent->box.height;
  CeldStatus status = CELD_OK;

  for (int y = top; y < end && status == CELD_OK; y++)
    {
      if (y + 2 < end)
        fetch_row (&b, y + 2);
      status = add_row (&b, y);
      if (status == CELD_OK && y % ROWS_PER_REPORT == 0)
        status = celd_progress (host, (double) (y - top) / (end - top));
    }
  celd_free (b.slot);
  if (status != CELD_OK)
    {
      celd_free (b.boundary);
      return status;
    }
  if (b.n)
    qsort (b.boundary, b.n, sizeof *b.boundary, celd_basin_boundary_compare);
  *boundary = b.boundary;
  *n = b.n;
  return CELD_OK;
}
