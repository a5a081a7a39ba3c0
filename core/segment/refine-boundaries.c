/* Boundaries of lower energy.  Those of the basins follow the middle of lines and the shortest path across a gap; the
 * energy of LazyBrush [SDC09b] (section 3.2), a sum over pairs of pixels, is often slightly lower beside them.
 *
 * A segment is a straight piece of a boundary along which the labels on its sides are the same.  It is moved by a pixel
 * to the side where the energy is lower, data costs included, until no segment of the picture gains.  Across paper,
 * where an edge costs a thousand times as much as in a line, boundaries are then cut again in windows
 * (solve-windows.c).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "image/image.h"
#include "segment/basins.h"
#include "segment/task.h"
#include "solve/maxflow.h"

#include <stdlib.h>

#define DISOBEYED (INT64_C (1) << 50) /* cost of another label on a hard seed */

typedef struct
{
  const CeldSegmentTask *task;
  const CeldHost        *host;
  CeldLabels            *labels;
  int32_t               *to_paper; /* of each pixel: squared distance to paper */
  uint32_t              *changed;  /* indices of changed pixels, in any order and number */
  size_t                 n_changed, changed_capacity;
} Refinement;

/* ------------------------------------------------------------------ pixels */

/* V_pq of (x,y) and the pixel below (south) or to the right. */
static int32_t
edge_cost (const Refinement *s, int x, int y, bool south)
{
  const CeldPlane *ink = s->task->ink;
  size_t           w = (size_t) ink->width, p = (size_t) y * w + (size_t) x;
  bool             frame = south ? x == 0 || x + 1 == ink->width : y == 0 || y + 1 == ink->height;

  return celd_smoothness_cost (&s->task->basins->costs, CELD_AT (ink, x, y), CELD_AT (ink, x + !south, y + south),
                               s->to_paper[p], s->to_paper[south ? p + w : p + 1], frame);
}

/* The energy of a pixel with this label: its edges, and its seed. */
static int64_t
cost_of (const Refinement *s, int x, int y, uint32_t label)
{
  const CeldLabels *l = s->labels;
  uint32_t          seed = celd_seed_rows_at (&s->task->seeds, x, y);
  int64_t           cost = 0;

  if (seed && seed != label)
    {
      int32_t vote = celd_task_data_cost (s->task, seed);

      cost = vote == CELD_HARD ? DISOBEYED : vote;
    }
  if (x > 0 && CELD_AT (l, x - 1, y) != label)
    cost += edge_cost (s, x - 1, y, false);
  if (x + 1 < l->width && CELD_AT (l, x + 1, y) != label)
    cost += edge_cost (s, x, y, false);
  if (y > 0 && CELD_AT (l, x, y - 1) != label)
    cost += edge_cost (s, x, y - 1, true);
  if (y + 1 < l->height && CELD_AT (l, x, y + 1) != label)
    cost += edge_cost (s, x, y, true);
  return cost;
}

/* Sets the label of a pixel and notes the change. */
static CeldStatus
set_label (Refinement *s, int x, int y, uint32_t label)
{
  if (celd_append (s->changed, s->n_changed, s->changed_capacity,
                   (uint32_t) y * (uint32_t) s->labels->width + (uint32_t) x) != CELD_OK)
    return CELD_NO_MEMORY;
  CELD_AT (s->labels, x, y) = label;
  return CELD_OK;
}

/* ------------------------------------------------------------------ segments */

/* The first edge of a segment: between (x,y) and the pixel below, the segment going right; or between (x,y) and the
 * pixel to the right, the segment going down. */
typedef struct { int x, y; bool south; } BoundarySegment;
typedef struct { BoundarySegment *item; size_t n, item_capacity; } BoundarySegments;

static bool
is_edge (const CeldLabels *l, int x, int y, bool south)
{
  return x >= 0 && y >= 0 && x + !south < l->width && y + south < l->height &&
         CELD_AT (l, x, y) != CELD_AT (l, x + !south, y + south);
}

/* Do two neighbouring edges of the same direction belong to one segment? */
static bool
same_segment (const CeldLabels *l, int x, int y, int x2, int y2, bool south)
{
  return is_edge (l, x2, y2, south) && CELD_AT (l, x, y) == CELD_AT (l, x2, y2) &&
         CELD_AT (l, x + !south, y + south) == CELD_AT (l, x2 + !south, y2 + south);
}

/* Appends the segment that an edge is part of, unless it is the last one appended. */
static CeldStatus
add_segment (const CeldLabels *l, int x, int y, bool south, BoundarySegments *edges)
{
  if (!is_edge (l, x, y, south))
    return CELD_OK;
  while (same_segment (l, x, y, x - south, y - !south, south))
    {
      x -= south;
      y -= !south;
    }
  if (edges->n)
    {
      const BoundarySegment *last = &edges->item[edges->n - 1];

      if (last->x == x && last->y == y && last->south == south)
        return CELD_OK;
    }
  return celd_append (edges->item, edges->n, edges->item_capacity, (BoundarySegment) { x, y, south });
}

/* All runs of the picture. */
static CeldStatus
find_segments (const CeldLabels *l, BoundarySegments *edges)
{
  CeldStatus status = CELD_OK;

  for (int y = 0; y < l->height && status == CELD_OK; y++)
    for (int x = 0; x < l->width && status == CELD_OK; x++)
      {
        if (is_edge (l, x, y, true) && !same_segment (l, x, y, x - 1, y, true))
          status = add_segment (l, x, y, true, edges);
        if (is_edge (l, x, y, false) && !same_segment (l, x, y, x, y - 1, false) && status == CELD_OK)
          status = add_segment (l, x, y, false, edges);
      }
  return status;
}

/* Gives the n pixels from (x,y) on to a label, if that lowers the energy. */
static CeldStatus
try_move (Refinement *s, int x, int y, bool south, int n, uint32_t label, bool *moved)
{
  uint32_t   old = CELD_AT (s->labels, x, y);
  size_t     before = s->n_changed;
  int64_t    gain = 0;
  CeldStatus status = CELD_OK;

  for (int i = 0; i < n && status == CELD_OK; i++)
    {
      int px = x + i * south, py = y + i * !south;

      gain  += cost_of (s, px, py, old) - cost_of (s, px, py, label);
      status = set_label (s, px, py, label);
    }
  *moved = status == CELD_OK && gain > 0;
  if (*moved)
    return CELD_OK;
  while (s->n_changed > before)
    {
      uint32_t p = s->changed[--s->n_changed], w = (uint32_t) s->labels->width;

      CELD_AT (s->labels, p % w, p / w) = old;
    }
  return status;
}

/* Appends the segments that touch pixels which have changed. */
static CeldStatus
add_segments_around (const CeldLabels *l, int x, int y, bool south, int n, BoundarySegments *edges)
{
  CeldStatus status = CELD_OK;

  for (int turned = 0; turned < 2; turned++)
    for (int across = -1; across <= 1; across++)
      for (int i = -1; i <= n && status == CELD_OK; i++)
        status = add_segment (l, x + (south ? i : across), y + (south ? across : i), south != turned, edges);
  return status;
}

/* Moves a segment to one side or the other. */
static CeldStatus
try_segment (Refinement *s, BoundarySegment edge, BoundarySegments *next)
{
  const CeldLabels *l = s->labels;
  bool              south = edge.south, moved;
  int               x = edge.x, y = edge.y, n = 1;
  uint32_t          one, other;
  CeldStatus        status;

  if (!is_edge (l, x, y, south))
    return CELD_OK;
  while (same_segment (l, x, y, x + n * south, y + n * !south, south))
    n++;
  one    = CELD_AT (l, x, y);
  other  = CELD_AT (l, x + !south, y + south);
  status = try_move (s, x, y, south, n, other, &moved);
  if (status == CELD_OK && !moved)
    {
      x += !south;
      y += south;
      status = try_move (s, x, y, south, n, one, &moved);
    }
  return status == CELD_OK && moved ? add_segments_around (l, x, y, south, n, next) : status;
}

static CeldStatus
refine_segments (Refinement *s)
{
  BoundarySegments edges = { 0 };
  CeldStatus       status = find_segments (s->labels, &edges);

  while (edges.n && status == CELD_OK)
    {
      BoundarySegments next = { 0 };

      for (size_t i = 0; i < edges.n && status == CELD_OK; i++)
        status = try_segment (s, edges.item[i], &next);
      celd_free (edges.item);
      edges = next;
      if (status == CELD_OK)
        status = celd_progress (s->host, 0);
    }
  celd_free (edges.item);
  return status;
}

/* ------------------------------------------------------------------ seeds */

/* On lines a boundary round a single seed may cost less than the seed's data cost. */
static CeldStatus
refine_seeds (Refinement *s)
{
  const CeldSeedRows *seeds = &s->task->seeds;
  CeldStatus          status = CELD_OK;

  for (int y = 0; y < seeds->height; y++)
    for (size_t i = 0; i < seeds->row[y].n; i++)
      {
        const CeldSeedRun *run = &seeds->row[y].run[i];

        for (int x = run->x; x < run->end && status == CELD_OK; x++)
          {
            uint32_t label = CELD_AT (s->labels, x, y);

            if (label != run->label && cost_of (s, x, y, run->label) < cost_of (s, x, y, label))
              status = set_label (s, x, y, run->label);
          }
      }
  return status;
}

/* ------------------------------------------------------------------ gaps */

static CeldStatus
refine_gaps (Refinement *s)
{
  CeldPatches patches = { 0 };
  CeldStatus  status = celd_gaps_solve (s->task, s->to_paper, s->host, s->labels, &patches);

  for (size_t i = 0; i < patches.n; i++)
    for (int x = patches.item[i].x; x < patches.item[i].end && status == CELD_OK; x++)
      status = set_label (s, x, patches.item[i].y, patches.item[i].label);
  celd_patches_clear (&patches);
  return status;
}

/* ------------------------------------------------------------------ the whole */

static int
compare_pixels (const void *a, const void *b)
{
  uint32_t p = *(const uint32_t *) a, q = *(const uint32_t *) b;

  return p < q ? -1 : p > q;
}

/* Appends the changed pixels as patches. */
static CeldStatus
list_changes (Refinement *s, CeldPatches *patches)
{
  uint32_t   w = (uint32_t) s->labels->width;
  CeldStatus status = CELD_OK;

  if (s->n_changed)
    qsort (s->changed, s->n_changed, sizeof *s->changed, compare_pixels);
  for (size_t i = 0; i < s->n_changed && status == CELD_OK; i++)
    {
      int x = (int) (s->changed[i] % w), y = (int) (s->changed[i] / w);

      if (!i || s->changed[i] != s->changed[i - 1])
        status = celd_patch_add (patches, (CeldPatch) { y, x, x + 1, CELD_AT (s->labels, x, y) });
    }
  return status;
}

CeldStatus
celd_boundaries_refine (const CeldSegmentTask *task, const CeldHost *host, CeldLabels *labels, CeldPatches *patches)
{
  size_t       n = (size_t) labels->width * (size_t) labels->height;
  CeldHostPart part;
  CeldHost     brief = celd_host_part (&part, host, 0, 0);
  Refinement   s = {
    .task = task, .host = &brief, .labels = labels, .to_paper = celd_alloc (n, sizeof *s.to_paper)
  };
  CeldStatus   status = s.to_paper ? celd_distance_to_paper (task->ink, &brief, s.to_paper) : CELD_NO_MEMORY;

  if (status == CELD_OK)
    status = refine_seeds (&s);

  if (status == CELD_OK)
    status = refine_segments (&s);
  if (status == CELD_OK)
    status = refine_gaps (&s);
  if (status == CELD_OK)
    status = refine_segments (&s);
  if (status == CELD_OK)
    status = list_changes (&s, patches);
  celd_free (s.to_paper);
  celd_free (s.changed);
  return status;
}
