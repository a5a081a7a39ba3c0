/* Depth expansion (section 3.3): ink is assigned to the region that drew it.
 *
 * Ranks are expanded from front to back, all paper of a rank at once, so that ink between equal ranks stays at that
 * rank.  Each takes its part of the free ink (expansion-region.c) and is then excluded.  The last rank has no farther
 * one to share ink with: what is left goes to the nearest region, pixel by pixel.
 *
 * Contour is ink below one half, so that an antialiased pixel goes with its larger part.  A connected component of a
 * rank that is wholly ink, like a black shoe with a scribble of its own, is treated as paper.  Paper never changes.  A
 * picture of one rank, of ink alone or of paper alone is returned unchanged.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "image/image.h"
#include "ownership/ownership.h"

#include <stdlib.h>

#define MIN_PATCH 16 /* pixels; smaller components of ink are free whatever their rank; chosen */

static int
compare_ranks (const void *a, const void *b)
{
  uint32_t p = *(const uint32_t *) a, q = *(const uint32_t *) b;

  return (p > q) - (p < q);
}

/* The distinct ranks: collects the first rank of each run in a row, then sorts and removes duplicates. */
static CeldStatus
list_ranks (const CeldLabels *ranks, uint32_t **list, size_t *n)
{
  uint32_t *rank = NULL;
  size_t    found = 0, kept = 0, capacity = 0;

  for (int y = 0; y < ranks->height; y++)
    for (int x = 0; x < ranks->width; x++)
      if (x == 0 || CELD_AT (ranks, x, y) != CELD_AT (ranks, x - 1, y))
        if (celd_append (rank, found, capacity, CELD_AT (ranks, x, y)) != CELD_OK)
          {
            celd_free (rank);
            return CELD_NO_MEMORY;
          }
  qsort (rank, found, sizeof *rank, compare_ranks);
  for (size_t i = 0; i < found; i++)
    if (i == 0 || rank[i] != rank[i - 1])
      rank[kept++] = rank[i];
  *list = rank;
  *n    = kept;
  return CELD_OK;
}

CeldStatus
celd_number_ranks (CeldLabels *picture, uint32_t **list, size_t *n)
{
  size_t     pixels = (size_t) picture->width * (size_t) picture->height;
  uint32_t  *rank = NULL, last = 0;
  CeldStatus status = list_ranks (picture, &rank, n);

  for (size_t p = 0; p < pixels && status == CELD_OK; p++)
    {
      uint32_t        here = picture->data[p];
      const uint32_t *found = p && here == last ? NULL : bsearch (&here, rank, *n, sizeof here, compare_ranks);

      picture->data[p] = found ? (uint32_t) (found - rank) + 1 : picture->data[p - 1];
      last = here;
    }
  if (list && status == CELD_OK)
    *list = rank;
  else
    celd_free (rank);
  return status;
}

/* Copies ranks as levels, and keeps the list. */
static CeldStatus
number_pixels (const CeldLabels *ranks, CeldExpansionState *state)
{
  CeldLabels level = { state->width, state->height, (size_t) state->width, state->level };

  for (int y = 0; y < ranks->height; y++)
    memcpy (&CELD_AT (&level, 0, y), &CELD_AT (ranks, 0, y), (size_t) ranks->width * sizeof *level.data);
  return celd_number_ranks (&level, &state->rank, &state->n);
}

/* Frees the ink of all components that have paper, and of those that are too small. */
static CeldStatus
free_ink (const CeldPlane *ink, const CeldHost *host, CeldExpansionState *state)
{
  CeldLabels     level = { state->width, state->height, (size_t) state->width, state->level }, patch = { 0 };
  CeldComponent *list = NULL;
  size_t         n = 0, p;
  CeldStatus     status = celd_labels_new (state->width, state->height, &patch);

  if (status == CELD_OK)
    status = celd_components (&level, 0, false, host, &patch, &list, &n);
  if (status != CELD_OK)
    goto done;
  for (p = 0; p < n; p++)
    if (list[p].area < MIN_PATCH)
      list[p].label = 0; /* its ink is free */
  for (int y = 0; y < state->height; y++)
    for (int x = 0; x < state->width; x++)
      if (celd_is_paper (CELD_AT (ink, x, y)))
        list[CELD_AT (&patch, x, y) - 1].label = 0;
  for (int y = 0; y < state->height; y++)
    for (int x = 0; x < state->width; x++)
      if (!celd_is_paper (CELD_AT (ink, x, y)) && !list[CELD_AT (&patch, x, y) - 1].label)
        CELD_AT (&level, x, y) = 0;
done:
  celd_free (patch.data);
  celd_free (list);
  return status;
}

/* Computes distance_in_ink, and the box of each level. */
static CeldStatus
measure_state (const CeldHost *host, CeldExpansionState *state)
{
  uint8_t   *settled = celd_alloc (state->pixels, 1);
  CeldStatus status = settled ? CELD_OK : CELD_NO_MEMORY;
  size_t     p;

  for (p = 0; p < state->pixels && status == CELD_OK; p++)
    settled[p] = state->level[p] != 0;
  if (status == CELD_OK)
    status = celd_distance (state->width, state->height, settled, host, state->distance_in_ink);
  celd_free (settled);
  for (p = 0; p < state->pixels && status == CELD_OK; p++)
    if (state->level[p])
      {
        int       x = (int) (p % (size_t) state->width), y = (int) (p / (size_t) state->width);
        CeldRect *box = &state->box[state->level[p] - 1];
        int       left = box->width && box->x < x ? box->x : x;
        int       right = box->width && box->x + box->width > x ? box->x + box->width : x + 1;
        int       top = box->width ? box->y : y;

        *box = (CeldRect) { left, top, right - left, y + 1 - top };
      }
  return status;
}

/* Front to back; assign_rest handles the last level. */
static CeldStatus
expand_regions (const CeldHost *host, CeldExpansionState *state)
{
  CeldStatus status = CELD_OK;

  for (size_t k = state->n; k > 1 && status == CELD_OK; k--)
    {
      CeldHostPart part;
      CeldHost     turn = celd_host_part (&part, host, (double) (state->n - k) / (double) state->n,
                                         (double) (state->n - k + 1) / (double) state->n);

      status = celd_expand_region (state, (uint32_t) k, &turn);
    }
  return status;
}

/* Assigns free ink to the nearest pixel that is not free; without any such pixel it stays free. */
static CeldStatus
assign_rest (const CeldHost *host, CeldExpansionState *state)
{
  uint8_t   *settled = celd_alloc (state->pixels, 1);
  int32_t   *nearest = celd_alloc (state->pixels, sizeof *nearest);
  CeldStatus status = settled && nearest ? CELD_OK : CELD_NO_MEMORY;

  for (size_t p = 0; p < state->pixels && status == CELD_OK; p++)
    settled[p] = state->level[p] != 0;
  if (status == CELD_OK)
    status = celd_nearest (state->width, state->height, settled, host, state->distance_in_ink, nearest);
  for (size_t p = 0; p < state->pixels && status == CELD_OK; p++)
    if (!settled[p] && nearest[p] >= 0)
      state->level[p] = state->level[nearest[p]];
  celd_free (settled);
  celd_free (nearest);
  return status;
}

static void
write_ranks (const CeldExpansionState *state, const CeldLabels *ranks, CeldLabels *expanded)
{
  const uint32_t *level = state->level;

  for (int y = 0; y < state->height; y++)
    for (int x = 0; x < state->width; x++, level++)
      CELD_AT (expanded, x, y) = *level ? state->rank[*level - 1] : CELD_AT (ranks, x, y);
}

CeldStatus
celd_expand (const CeldPlane *ink, const CeldLabels *ranks, const CeldHost *host, CeldLabels *expanded)
{
  CeldExpansionState  state = { 0 };
  CeldHostPart   part[4];
  CeldHost   first = celd_host_part (&part[0], host, 0, 0.05), second = celd_host_part (&part[1], host, 0.05, 0.1);
  CeldHost   third = celd_host_part (&part[2], host, 0.1, 0.9), fourth = celd_host_part (&part[3], host, 0.9, 1);
  CeldStatus status;

  if (!CELD_SAME_SIZE (ink, ranks) || !CELD_SAME_SIZE (ranks, expanded))
    return CELD_BAD_SIZE;
  state.width = ranks->width;
  state.height = ranks->height;
  state.pixels = (size_t) ranks->width * (size_t) ranks->height;
  state.level = celd_alloc (state.pixels, sizeof *state.level);
  state.distance_in_ink = celd_alloc (state.pixels, sizeof *state.distance_in_ink);
  status = state.level && state.distance_in_ink ? CELD_OK : CELD_NO_MEMORY;
  if (status == CELD_OK)
    status = number_pixels (ranks, &state);
  if (status != CELD_OK)
    goto done;
  state.box = celd_alloc0 (state.n, sizeof *state.box);
  status = state.box ? CELD_OK : CELD_NO_MEMORY;
  if (status != CELD_OK)
    goto done;
  if ((status = free_ink (ink, &first, &state)) == CELD_OK &&
      (status = measure_state (&second, &state)) == CELD_OK &&
      (status = expand_regions (&third, &state)) == CELD_OK)
    status = assign_rest (&fourth, &state);
  if (status == CELD_OK)
    write_ranks (&state, ranks, expanded);
done:
  celd_free (state.level);
  celd_free (state.distance_in_ink);
  celd_free (state.rank);
  celd_free (state.box);
  return status;
}
