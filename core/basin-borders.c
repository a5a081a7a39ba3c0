/* Borders between basins: what the paper's energy charges along each, and the widest place where paper goes through.
 *
 * Only ends of runs, and columns where a row's basin differs from the next row's, are looked at.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "basin-steps.h"

#include <stdlib.h>
#include <string.h>

#define ROWS   256 /* between two reports of progress */
#define RECENT 512

typedef struct { uint32_t a, b; size_t border; } Slot; /* a = b: empty */

typedef struct
{
  const CeldPlane  *ink;
  const int32_t    *squared;
  const CeldBasins *basins;
  CeldBorder       *border;
  size_t            n;
  Slot             *slot;     /* open hash by the two basins */
  size_t            n_slots;  /* a power of two, more than twice n */
  Slot              recent[RECENT]; /* the same, as far as the last rows touch it: small enough to stay at hand */
} Borders;

static Slot *
find_slot (const Borders *b, uint32_t first, uint32_t second)
{
  uint64_t key = ((uint64_t) first << 32 | second) * 0x9e3779b97f4a7c15u;
  size_t   i = (size_t) (key ^ key >> 32) & (b->n_slots - 1);

  while (b->slot[i].a != b->slot[i].b && (b->slot[i].a != first || b->slot[i].b != second))
    i = (i + 1) & (b->n_slots - 1);
  return &b->slot[i];
}

static bool
grow_slots (Borders *b)
{
  size_t n_slots = b->n_slots ? 2 * b->n_slots : 1024;
  Slot  *slot = celd_alloc0 (n_slots, sizeof *slot);

  if (!slot)
    return false;
  celd_free (b->slot);
  b->slot = slot;
  b->n_slots = n_slots;
  for (size_t i = 0; i < b->n; i++)
    *find_slot (b, b->border[i].a, b->border[i].b) = (Slot) { b->border[i].a, b->border[i].b, i };
  return true;
}

/* The border of two basins; NULL: no memory. */
static CeldBorder *
find_border (Borders *b, uint32_t first, uint32_t second)
{
  uint32_t    least = first < second ? first : second, most = first < second ? second : first;
  Slot       *slot, *recent = &b->recent[(most ^ least * 37) % RECENT];
  CeldBorder *border;

  if (recent->a == least && recent->b == most)
    return &b->border[recent->border];
  if (2 * (b->n + 1) >= b->n_slots && !grow_slots (b))
    return NULL;
  slot = find_slot (b, least, most);
  if (slot->a != slot->b)
    {
      *recent = *slot;
      return &b->border[slot->border];
    }
  border = celd_grow (b->border, b->n + 1, sizeof *border);
  if (!border)
    return NULL;
  *slot = *recent = (Slot) { least, most, b->n };
  b->border = border;
  border += b->n++;
  *border = (CeldBorder) { .a = least, .b = most, .saddle = -1 };
  return border;
}

static bool
is_outermost (const CeldPlane *ink, int x, int y)
{
  return x == 0 || y == 0 || x == ink->width - 1 || y == ink->height - 1;
}

/* Counts in the pair of (x,y) and the pixel below it, or to the right. */
static void
add_pair (const Borders *b, CeldBorder *border, int x, int y, bool south)
{
  const CeldPlane *ink = b->ink;
  int              qx = x + !south, qy = y + south;
  int32_t          p = b->squared[(size_t) y * (size_t) ink->width + (size_t) x];
  int32_t          q = b->squared[(size_t) qy * (size_t) ink->width + (size_t) qx], least;
  bool             solid = b->basins->basin[border->a].solid && b->basins->basin[border->b].solid;
  bool             passes = p > 0 && q > 0;
  bool             along = south ? x == 0 || x == ink->width - 1 : y == 0 || y == ink->height - 1;

  border->cost += celd_cost (&b->basins->costs, CELD_AT (ink, x, y), CELD_AT (ink, qx, qy), -p, -q, along);
  if (passes)
    {
      border->passes++;
      border->frame = border->frame || (is_outermost (ink, x, y) && is_outermost (ink, qx, qy));
    }
  least = passes ? (p < q ? p : q) : solid ? (-p < -q ? -p : -q) : 0;
  if (least < border->saddle ||
      (least == border->saddle && (y > border->y || (y == border->y && (x > border->x || (x == border->x && south))))))
    return;
  border->saddle = least;
  border->x = x;
  border->y = y;
  border->south = south;
}

/* What the borders of a row will read. */
static void
fetch_row (const Borders *b, int y)
{
  const CeldBasins *basins = b->basins;
  const int32_t    *squared = b->squared + (size_t) y * (size_t) basins->width;

  for (size_t i = basins->row[y]; i < basins->row[y + 1]; i++)
    {
      CELD_PREFETCH (squared + basins->run[i].x);
      CELD_PREFETCH (&CELD_AT (b->ink, basins->run[i].x, y));
    }
}

static CeldStatus
add_row (Borders *b, int y)
{
  const CeldBasins   *basins = b->basins;
  const CeldBasinRun *run = basins->run + basins->row[y], *end = basins->run + basins->row[y + 1];
  const CeldBasinRun *below = end, *below_end = y + 1 < basins->height ? basins->run + basins->row[y + 2] : end;

  for (const CeldBasinRun *r = run + 1; r < end; r++)
    {
      CeldBorder *border = find_border (b, r[-1].basin, r->basin);

      if (!border)
        return CELD_NO_MEMORY;
      add_pair (b, border, r->x - 1, y, false);
    }
  for (int x = 0, next; x < basins->width && below < below_end; x = next)
    {
      int         run_end = run + 1 < end ? run[1].x : basins->width;
      int         stop = below + 1 < below_end ? below[1].x : basins->width;
      CeldBorder *border;

      next = run_end < stop ? run_end : stop;
      if (run->basin != below->basin)
        {
          border = find_border (b, run->basin, below->basin);
          if (!border)
            return CELD_NO_MEMORY;
          for (; x < next; x++)
            add_pair (b, border, x, y, true);
        }
      run += run_end == next;
      below += stop == next;
    }
  return CELD_OK;
}

static int
compare (const void *a, const void *b)
{
  const CeldBorder *p = a, *q = b;

  if (p->a != q->a)
    return p->a < q->a ? -1 : 1;
  return p->b < q->b ? -1 : p->b > q->b;
}

CeldStatus
celd_basins_touch (const CeldPlane *ink, const int32_t *squared, const CeldRun *run, CeldBasins *basins)
{
  Borders    b = { .ink = ink, .squared = squared, .basins = basins };
  CeldStatus status = CELD_OK;

  for (int y = 0; y < basins->height && status == CELD_OK; y++)
    {
      if (y + 2 < basins->height)
        fetch_row (&b, y + 2);
      status = add_row (&b, y);
      if (status == CELD_OK && y % ROWS == 0)
        status = celd_step (run, (double) y / basins->height);
    }
  celd_free (b.slot);
  if (status != CELD_OK)
    {
      celd_free (b.border);
      return status;
    }
  if (b.n)
    qsort (b.border, b.n, sizeof *b.border, compare);
  basins->border = b.border;
  basins->n_borders = b.n;
  return CELD_OK;
}
