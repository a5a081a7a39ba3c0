/* Where a boundary crosses paper, the LazyBrush energy [SDC09b] is minimised on pixels: in a window that has room for
 * the line ends on both sides, with everything outside fixed.  A result is accepted if its energy is lower.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/vector.h"
#include "image/image.h"
#include "segment/basins.h"
#include "segment/pixel-graph.h"
#include "segment/refinement.h"
#include "segment/task.h"
#include "segment/windows.h"

#define GAP_DISTANCE    3         /* pixels between boundaries across paper that share a window (chosen) */
#define GAP_MARGIN      6         /* pixels round a gap, besides a stroke width and half the gap (chosen) */
#define MOST_GAP_PIXELS (1 << 18) /* pixels of a window: larger ones are no gaps (chosen) */

typedef struct { int left, top, right, bottom; } GapBox;  /* inclusive */
typedef struct { GapBox *item; size_t n, item_capacity; } GapBoxes;

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

/* The window of a gap, with the pixels around it that stay as they are. */
static CeldRect
widen (const CeldBoundaryRefinement *s, GapBox b)
{
  int margin = GAP_MARGIN + s->task->basins->stroke + most (b.right - b.left, b.bottom - b.top) / 2 + 1;
  int left = most (b.left - margin, 0), top = most (b.top - margin, 0);

  return (CeldRect) { left, top, least (b.right + margin, s->labels->width - 1) - left + 1,
                      least (b.bottom + margin, s->labels->height - 1) - top + 1 };
}

/* ------------------------------------------------------------------ the cuts */

static CeldStatus
solve (CeldBoundaryRefinement *s, CeldWindowCutter *cutter, CeldRect box)
{
  CeldPresentLabels present = { .picture = s->labels, .to_paper = s->to_paper };
  CeldPixelGraph    graph;
  uint32_t         *label = NULL, *part;
  bool              better = false;
  CeldStatus        status = celd_window_graph_new (s->task, &present, box, 0, &graph);

  if (status == CELD_OK && graph.n)
    status = celd_window_cut (cutter, &graph, 1, &label, &better);
  part = graph.part;
  for (int y = box.y; y < box.y + box.height && better; y++)
    for (int x = box.x; x < box.x + box.width && status == CELD_OK; x++, part++)
      if (!(*part & CELD_PART_FIXED) && label[*part] != graph.node[*part].value)
        status = celd_refinement_set_label (s, x, y, label[*part]);
  celd_free (label);
  celd_pixel_graph_clear (&graph);
  return status;
}

CeldStatus
celd_refine_gaps (CeldBoundaryRefinement *s)
{
  GapBoxes         boxes = { 0 };
  CeldWindowCutter cutter;
  CeldStatus       status = celd_window_cutter_new (s->task, s->host, &cutter);

  if (status == CELD_OK)
    status = find_gaps (s, &boxes);
  for (size_t i = 0; i < boxes.n && status == CELD_OK; i++)
    {
      CeldRect box = widen (s, boxes.item[i]);

      if ((int64_t) box.width * box.height <= MOST_GAP_PIXELS)
        status = solve (s, &cutter, box);
    }
  celd_free (boxes.item);
  celd_window_cutter_clear (&cutter);
  return status;
}
