/* Pens under a labelling: the labels on both sides of each point of an edge, the widths of their pens (pen-width.c) and
 * the owner of the ink (contour-owners.c), from scratch or updated after a change.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "ownership/ownership.h"

static uint32_t
label_at (const CeldLabels *labels, int32_t pixel)
{
  return pixel < 0 ? 0 : CELD_AT (labels, pixel % labels->width, pixel / labels->width);
}

/* Reads labels within the changed rows only. */
static void
read_labels (const CeldLabels *labels, CeldRect changed, CeldContourPens *pens)
{
  int32_t first = (int32_t) (changed.y * labels->width), end = first + (int32_t) (changed.height * labels->width);

  for (size_t i = 0; i < pens->edges->n_points; i++)
    {
      const CeldEdgePoint *p = &pens->edges->point[i];

      if (p->paper >= first && p->paper < end)
        pens->pen[i].near = label_at (labels, p->paper);
      if (p->across >= first && p->across < end)
        pens->pen[i].far = label_at (labels, p->across);
    }
}

/* ------------------------------------------------------------------ updates */

/* Marks labels whose pens have changed their width; to be freed. */
static bool *
find_changed_widths (const CeldContourPens *old, const CeldContourPens *new)
{
  bool *changed = celd_alloc (new->n + 1, sizeof *changed);

  for (size_t k = 1; changed && k <= new->n; k++)
    changed[k] = k > old->n || new->typical_width[k - 1] != old->typical_width[k - 1]
                 || new->max_width[k - 1] != old->max_width[k - 1];
  if (changed)
    changed[0] = false;
  return changed;
}

void
celd_label_list_add (uint32_t label, CeldLabelList *list)
{
  for (uint32_t i = 0; i < list->n && i < CELD_LISTED_LABELS; i++)
    if (list->label[i] == label)
      return;
  if (list->n < CELD_LISTED_LABELS)
    list->label[list->n] = label;
  list->n++;
}

static int
compare_levels (const CeldContourPens *pens, uint32_t a, uint32_t b)
{
  return (pens->level[a - 1] > pens->level[b - 1]) - (pens->level[a - 1] < pens->level[b - 1]);
}

bool
celd_label_order_changed (const CeldLabelList *list, const CeldContourPens *old, const CeldContourPens *new)
{
  if (list->n > CELD_LISTED_LABELS)
    return true;
  for (uint32_t i = 0; i < list->n; i++)
    for (uint32_t j = 0; j < i; j++)
      if (list->label[i] > old->n || list->label[j] > old->n ||
          compare_levels (old, list->label[i], list->label[j]) != compare_levels (new, list->label[i], list->label[j]))
        return true;
  return false;
}

/* Do all labels of a loop, each of which may own ink anywhere on it, have the same order as before? */
static bool
same_order (const CeldEdgeLoop *loop, const CeldContourPens *old, const CeldContourPens *new)
{
  CeldLabelList list = { .n = 0 };

  for (size_t i = loop->first; i < loop->first + loop->n; i++)
    {
      if (new->pen[i].near)
        celd_label_list_add (new->pen[i].near, &list);
      if (new->pen[i].far)
        celd_label_list_add (new->pen[i].far, &list);
    }
  return !celd_label_order_changed (&list, old, new);
}

/* Are labels, widths and order the same as before at all points of a loop?  Of the farther label, too, whose line a
 * thickened point may show. */
static bool
same_loop (const CeldEdgeLoop *loop, const CeldContourPens *old, const CeldContourPens *new, const bool *changed)
{
  for (size_t i = loop->first; i < loop->first + loop->n; i++)
    {
      const CeldEdgePen *a = &old->pen[i], *b = &new->pen[i];

      if (a->near != b->near || a->far != b->far || a->thickened != b->thickened || changed[b->near] ||
          changed[b->far])
        return false;
    }
  return same_order (loop, old, new);
}

/* Computes widths and owners of loops that have changed, and copies the others. */
static CeldStatus
update_owners (const CeldContourPens *old, CeldContourPens *pens)
{
  bool      *changed = find_changed_widths (old, pens);
  float     *distance = celd_alloc (pens->edges->n_points + 1, sizeof *distance);
  CeldStatus status = changed && distance ? CELD_OK : CELD_NO_MEMORY;

  for (size_t k = 0; status == CELD_OK && k < pens->edges->n_loops; k++)
    {
      const CeldEdgeLoop *loop = &pens->edges->loop[k];

      if (old->pen && same_loop (loop, old, pens, changed))
        memcpy (pens->pen + loop->first, old->pen + loop->first, loop->n * sizeof *pens->pen);
      else
        {
          celd_pen_widths_smooth (loop, pens);
          celd_contour_owners_find (loop, pens, distance);
        }
    }
  celd_free (changed);
  celd_free (distance);
  return status;
}

CeldStatus
celd_contour_pens_update (const CeldContourPens *old, const CeldLabels *labels, CeldRect changed, const uint32_t *level,
                          size_t n, CeldContourPens *pens)
{
  const CeldContourEdges *edges = old->edges;
  CeldContourPens         made = { .edges = edges, .level = level, .n = n };
  CeldStatus              status;

  made.pen   = celd_alloc0 (edges->n_points + 1, sizeof *made.pen);
  made.typical_width = celd_alloc0 (n, sizeof *made.typical_width);
  made.max_width  = celd_alloc0 (n, sizeof *made.max_width);
  status     = made.pen && made.typical_width && made.max_width ? CELD_OK : CELD_NO_MEMORY;
  for (size_t i = 0; old->pen && i < edges->n_points && status == CELD_OK; i++)
    {
      made.pen[i].near = old->pen[i].near;
      made.pen[i].far  = old->pen[i].far;
    }
  if (status == CELD_OK)
    {
      read_labels (labels, changed, &made);
      status = celd_pen_widths_measure (&made);
    }
  if (status == CELD_OK)
    status = update_owners (old, &made);
  if (status == CELD_OK)
    *pens = made;
  else
    celd_contour_pens_clear (&made);
  return status;
}

CeldStatus
celd_contour_pens_new (const CeldContourEdges *edges, const CeldLabels *labels, const uint32_t *level, size_t n,
                       CeldContourPens *pens)
{
  CeldContourPens none = { .edges = edges };

  return celd_contour_pens_update (&none, labels, (CeldRect) { 0, 0, labels->width, labels->height }, level, n, pens);
}

void
celd_contour_pens_clear (CeldContourPens *pens)
{
  celd_free (pens->pen);
  celd_free (pens->typical_width);
  celd_free (pens->max_width);
  *pens = (CeldContourPens) { 0 };
}
