/* Where a boundary crosses paper, the LazyBrush energy [SDC09b] is minimised on pixels: in a window that has room for
 * the line ends on both sides, with everything outside fixed.  A result is accepted if its energy is lower.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/vector.h"
#include "image/image.h"
#include "segment/basins.h"
#include "segment/refinement.h"
#include "segment/task.h"
#include "solve/maxflow.h"
#include "solve/partition.h"

#define GAP_DISTANCE    3         /* pixels between boundaries across paper that share a window (chosen) */
#define GAP_MARGIN      6         /* pixels round a gap, besides a stroke width and half the gap (chosen) */
#define MOST_GAP_PIXELS (1 << 18) /* pixels of a window: larger ones are no gaps (chosen) */

typedef struct { int left, top, right, bottom; } GapBox;  /* inclusive */
typedef struct { GapBox *item; size_t n, item_capacity; } GapBoxes;

/* A window as a graph: a node per pixel; neighbours outside become data costs. */
typedef struct
{
  GapBox    box;
  size_t    n, n_links, n_votes;
  CeldLink *link;
  CeldVote *vote;
  uint32_t *fixed, *present, *label;
  uint32_t *global, *local;     /* label of the picture by number in the window, from 0; and the inverse, from 1 */
  uint32_t *order;
  size_t    n_labels;
} GapWindow;

static int
least (int a, int b)
{
  return a < b ? a : b;
}

static int
most (int a, int b)
{
  return a > b ? a : b;
}

/* ------------------------------------------------------------------ pixels */

int32_t
celd_refinement_cost (const CeldBoundaryRefinement *s, int x, int y, bool south)
{
  const CeldPlane *ink = s->task->ink;
  size_t           w = (size_t) ink->width, p = (size_t) y * w + (size_t) x;
  bool             frame = south ? x == 0 || x + 1 == ink->width : y == 0 || y + 1 == ink->height;

  return celd_smoothness_cost (&s->task->basins->costs, CELD_AT (ink, x, y), CELD_AT (ink, x + !south, y + south),
                               s->to_paper[p],
                               s->to_paper[south ? p + w : p + 1], frame);
}

CeldStatus
celd_refinement_set_label (CeldBoundaryRefinement *s, int x, int y, uint32_t label)
{
  if (celd_append (s->changed, s->n_changed, s->changed_capacity,
                   (uint32_t) y * (uint32_t) s->labels->width + (uint32_t) x) != CELD_OK)
    return CELD_NO_MEMORY;
  CELD_AT (s->labels, x, y) = label;
  return CELD_OK;
}

/* ------------------------------------------------------------------ gaps */

/* Adds a pixel to a box nearby, or to a new one. */
static CeldStatus
add_gap (int x, int y, GapBoxes *boxes)
{
  for (size_t i = 0; i < boxes->n; i++)
    {
      GapBox *b = &boxes->item[i];

      if (x < b->left - GAP_DISTANCE || x > b->right + GAP_DISTANCE || y < b->top - GAP_DISTANCE || y > b->bottom +
          GAP_DISTANCE)
        continue;
      *b = (GapBox) { least (b->left, x), least (b->top, y), most (b->right, x), most (b->bottom, y) };
      return CELD_OK;
    }
  return celd_append (boxes->item, boxes->n, boxes->item_capacity, (GapBox) { x, y, x, y });
}

/* Is the edge a boundary across paper? */
static bool
is_gap (const CeldBoundaryRefinement *s, int x, int y, bool south)
{
  int x2 = x + !south, y2 = y + south;

  return x2 < s->labels->width && y2 < s->labels->height && CELD_AT (s->labels, x, y) != CELD_AT (s->labels, x2, y2) &&
         celd_is_paper (CELD_AT (s->task->ink, x, y)) && celd_is_paper (CELD_AT (s->task->ink, x2, y2));
}

static CeldStatus
find_gaps (const CeldBoundaryRefinement *s, GapBoxes *boxes)
{
  CeldStatus status = CELD_OK;

  for (int y = 0; y < s->labels->height && status == CELD_OK; y++)
    for (int x = 0; x < s->labels->width && status == CELD_OK; x++)
      if (is_gap (s, x, y, false) || is_gap (s, x, y, true))
        status = add_gap (x, y, boxes);
  return status;
}

/* The window of a gap. */
static GapBox
widen (const CeldBoundaryRefinement *s, GapBox b)
{
  int margin = GAP_MARGIN + s->task->basins->stroke + most (b.right - b.left, b.bottom - b.top) / 2;

  return (GapBox) { most (b.left - margin, 0), most (b.top - margin, 0),
                 least (b.right + margin, s->labels->width - 1), least (b.bottom + margin, s->labels->height - 1) };
}

/* ------------------------------------------------------------------ the graph of a window */

static bool
inside (const GapBox *b, int x, int y)
{
  return x >= b->left && x <= b->right && y >= b->top && y <= b->bottom;
}

/* The number of a label in the window. */
static uint32_t
local_label (GapWindow *window, uint32_t label)
{
  if (!window->local[label])
    {
      window->global[window->n_labels] = label;
      window->local[label] = (uint32_t) ++window->n_labels;
    }
  return window->local[label];
}

static void
add_edge (const CeldBoundaryRefinement *s, GapWindow *window, uint32_t node, int x, int y, int x2, int y2)
{
  int     w = window->box.right - window->box.left + 1;
  bool    south = x == x2;
  int32_t cost;

  if (x2 < 0 || y2 < 0 || x2 >= s->labels->width || y2 >= s->labels->height)
    return;
  if (!inside (&window->box, x2, y2))
    {
      cost = celd_refinement_cost (s, least (x, x2), least (y, y2), south);
      window->vote[window->n_votes++] = (CeldVote) { node, local_label (window, CELD_AT (s->labels, x2, y2)), cost };
    }
  else if (x2 > x || y2 > y)
    {
      cost = celd_refinement_cost (s, x, y, south);
      window->link[window->n_links++] = (CeldLink) { node, node + (uint32_t) (south ? w : 1), cost };
    }
}

static void
add_pixel (const CeldBoundaryRefinement *s, GapWindow *window, uint32_t node, int x, int y)
{
  uint32_t seed = celd_seed_rows_at (&s->task->seeds, x, y);
  int32_t  vote = seed ? celd_task_data_cost (s->task, seed) : 0;

  window->present[node] = local_label (window, CELD_AT (s->labels, x, y));
  window->fixed[node]   = vote == CELD_HARD ? local_label (window, seed) : 0;
  if (seed && vote != CELD_HARD)
    window->vote[window->n_votes++] = (CeldVote) { node, local_label (window, seed), vote };
  add_edge (s, window, node, x, y, x + 1, y);
  add_edge (s, window, node, x, y, x, y + 1);
  add_edge (s, window, node, x, y, x - 1, y);
  add_edge (s, window, node, x, y, x, y - 1);
}

static CeldStatus
window_new (const CeldBoundaryRefinement *s, GapBox box, GapWindow *window)
{
  size_t   w = (size_t) (box.right - box.left + 1), h = (size_t) (box.bottom - box.top + 1), n = w * h;
  size_t   n_labels = s->task->palette.n;
  uint32_t node = 0;

  *window = (GapWindow) {
    .box     = box,
    .n       = n,
    .link    = celd_alloc (2 * n, sizeof *window->link),
    .vote    = celd_alloc (n + 2 * (w + h), sizeof *window->vote),
    .fixed   = celd_alloc (n, sizeof *window->fixed),
    .present = celd_alloc (n, sizeof *window->present),
    .label   = celd_alloc (n, sizeof *window->label),
    .global  = celd_alloc (n_labels, sizeof *window->global),
    .local   = celd_alloc0 (n_labels + 1, sizeof *window->local),
    .order   = celd_alloc (n_labels, sizeof *window->order),
  };
  if (!window->link || !window->vote || !window->fixed || !window->present || !window->label || !window->global ||
      !window->local || !window->order)
    return CELD_NO_MEMORY;
  for (int y = box.top; y <= box.bottom; y++)
    for (int x = box.left; x <= box.right; x++)
      add_pixel (s, window, node++, x, y);
  return CELD_OK;
}

static void
window_clear (GapWindow *window)
{
  celd_free (window->link);
  celd_free (window->vote);
  celd_free (window->fixed);
  celd_free (window->present);
  celd_free (window->label);
  celd_free (window->global);
  celd_free (window->local);
  celd_free (window->order);
}

/* ------------------------------------------------------------------ the cuts */

/* Labels are cut in the order of the whole picture. */
static CeldStatus
order_labels (const CeldBoundaryRefinement *s, GapWindow *window)
{
  uint32_t  *order = celd_alloc (s->task->palette.n, sizeof *order);
  size_t     n = 0;
  CeldStatus status = order ? celd_task_label_order (s->task, order) : CELD_NO_MEMORY;

  for (size_t i = 0; i < s->task->palette.n && status == CELD_OK; i++)
    if (window->local[order[i]])
      window->order[n++] = window->local[order[i]];
  celd_free (order);
  return status;
}

static CeldStatus
solve (CeldBoundaryRefinement *s, GapWindow *window)
{
  CeldPartition problem = {
    window->n, window->link, window->n_links, window->vote, window->n_votes, window->fixed, window->order,
    window->n_labels
  };
  size_t        node = 0;
  int64_t       energy;
  CeldStatus    status = celd_partition (&problem, s->host, window->label, &energy, NULL);

  if (status != CELD_OK || energy >= celd_partition_energy (&problem, window->present))
    return status;
  for (int y = window->box.top; y <= window->box.bottom; y++)
    for (int x = window->box.left; x <= window->box.right && status == CELD_OK; x++, node++)
      if (window->label[node] != window->present[node])
        status = celd_refinement_set_label (s, x, y, window->global[window->label[node] - 1]);
  return status;
}

CeldStatus
celd_refine_gaps (CeldBoundaryRefinement *s)
{
  GapBoxes   boxes = { 0 };
  CeldStatus status = find_gaps (s, &boxes);

  for (size_t i = 0; i < boxes.n && status == CELD_OK; i++)
    {
      GapBox    box = widen (s, boxes.item[i]);
      GapWindow window;

      if ((int64_t) (box.right - box.left + 1) * (box.bottom - box.top + 1) > MOST_GAP_PIXELS)
        continue;
      status = window_new (s, box, &window);
      if (status == CELD_OK)
        status = order_labels (s, &window);
      if (status == CELD_OK)
        status = solve (s, &window);
      window_clear (&window);
    }
  celd_free (boxes.item);
  return status;
}
