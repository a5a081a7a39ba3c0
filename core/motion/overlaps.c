/* Which regions of different drawings lie over each other in a composition, and how much.
 *
 * A task has a list of its own and always the same bands of rows, so that the sums do not depend on threads.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/compose.h"

#include <stdlib.h>

typedef struct
{
  const CeldComposition *composition;
  int                    first;         /* band of this round */
  struct { CeldShares shares; CeldOverlaps pairs; CeldStatus status; } job[CELD_COMPOSE_TASKS];
} OverlapSearch;

static int
compare_pairs (const void *a, const void *b)
{
  const CeldOverlap *one = a, *other = b;

  if (one->nearer != other->nearer)
    return one->nearer < other->nearer ? -1 : 1;
  return one->farther < other->farther ? -1 : one->farther > other->farther;
}

/* The largest first. */
static int
compare_areas (const void *a, const void *b)
{
  const CeldOverlap *one = a, *other = b;

  if (one->area < other->area || one->area > other->area)
    return one->area > other->area ? -1 : 1;
  return compare_pairs (a, b);
}

/* Makes one of each pair. */
static void
add_up (CeldOverlaps *pairs)
{
  size_t n = 0;

  if (pairs->n)
    qsort (pairs->item, pairs->n, sizeof *pairs->item, compare_pairs);
  for (size_t i = 0; i < pairs->n; i++)
    if (n && !compare_pairs (&pairs->item[n - 1], &pairs->item[i]))
      pairs->item[n - 1].area += pairs->item[i].area;
    else
      pairs->item[n++] = pairs->item[i];
  pairs->n = n;
}

/* Adds the pairs of one pixel; a run of pixels with the same pair makes one item. */
static CeldStatus
add_pixel (const CeldShares *shares, CeldOverlaps *pairs)
{
  CeldStatus status = CELD_OK;

  for (size_t i = 0; i < shares->n; i++)
    for (size_t k = i + 1; k < shares->n && status == CELD_OK; k++)
      {
        const CeldShare *a = &shares->share[i], *b = &shares->share[k];
        CeldOverlap      pair = { a->item > b->item ? a->item : b->item, a->item > b->item ? b->item : a->item,
                                  (double) a->colour[3] * (double) b->colour[3] };

        if (a->fragment == b->fragment)
          continue;
        if (pairs->n && !compare_pairs (&pairs->item[pairs->n - 1], &pair))
          pairs->item[pairs->n - 1].area += pair.area;
        else
          status = celd_append (pairs->item, pairs->n, pairs->capacity, pair);
      }
  return status;
}

static void
search_band (void *data, int i)
{
  OverlapSearch                *s = data;
  const CeldComposition *c = s->composition;
  int                    y = (s->first + i) * CELD_COMPOSE_BAND;

  for (int end = y + CELD_COMPOSE_BAND; y < end && y < c->height; y++)
    {
      for (int x = 0; x < c->width && s->job[i].status == CELD_OK; x++)
        {
          celd_shares_gather (c, x, y, &s->job[i].shares);
          s->job[i].status = add_pixel (&s->job[i].shares, &s->job[i].pairs);
        }
      add_up (&s->job[i].pairs);
    }
}

static CeldStatus
collect (const OverlapSearch *s, CeldOverlaps *overlaps)
{
  CeldStatus status = CELD_OK;

  for (int i = 0; i < CELD_COMPOSE_TASKS && status == CELD_OK; i++)
    {
      status = s->job[i].status;
      for (size_t k = 0; k < s->job[i].pairs.n && status == CELD_OK; k++)
        status = celd_append (overlaps->item, overlaps->n, overlaps->capacity, s->job[i].pairs.item[k]);
    }
  add_up (overlaps);
  if (overlaps->n)
    qsort (overlaps->item, overlaps->n, sizeof *overlaps->item, compare_areas);
  return status;
}

CeldStatus
celd_overlaps_find (const CeldComposition *c, const CeldHost *host, CeldOverlaps *overlaps)
{
  OverlapSearch    *s = celd_alloc0 (1, sizeof *s);
  int        bands = (c->height + CELD_COMPOSE_BAND - 1) / CELD_COMPOSE_BAND;
  CeldStatus status = CELD_OK;

  *overlaps = (CeldOverlaps) { 0 };
  if (!s)
    return CELD_NO_MEMORY;
  s->composition = c;
  for (int i = 0; i < CELD_COMPOSE_TASKS && status == CELD_OK; i++)
    status = celd_shares_new (c, &s->job[i].shares);
  if (status == CELD_OK)
    status = celd_parallel_rounds (host, bands, CELD_COMPOSE_TASKS, search_band, s, &s->first, 0, 1);
  if (status == CELD_OK)
    status = collect (s, overlaps);
  for (int i = 0; i < CELD_COMPOSE_TASKS; i++)
    {
      celd_shares_clear (&s->job[i].shares);
      celd_free (s->job[i].pairs.item);
    }
  celd_free (s);
  return status;
}
