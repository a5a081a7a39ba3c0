/* Cycles that there are only because regions of one colour have one depth (same_colour = one).
 *
 * A cycle passes a label from the end of one relation to the end of the next.  If these are points in two regions of
 * the label that do not touch, the cycle takes both to have one depth, which the artist may not have meant.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "order/order.h"

#include <string.h>

typedef struct
{
  const CeldLabels *labels;
  const CeldPlane  *ink;        /* may be NULL */
  const CeldGraph  *graph;
  CeldLabels        part;       /* connected regions; data NULL: not found yet */
  int               stroke;     /* width in pixels; 0: not measured yet */
} LabelledPicture;

/* One end of a relation: its label, and a pixel of that label. */
typedef struct { uint32_t label; int x, y; } Place;

/* False if the end is no point of the drawing. */
static bool
find_place (LabelledPicture *picture, size_t link, CeldSide side, Place *place)
{
  const CeldGraph    *g = picture->graph;
  const CeldRelation *relation = &g->relations->item[link];
  const CeldTerm     *term = side == CELD_NEARER ? &relation->nearer : &relation->farther;

  if (term->by_colour)
    return false;
  *place = (Place) { g->end[g->first[2 * link + side]] + 1, (int) term->x, (int) term->y };
  if (CELD_AT (picture->labels, place->x, place->y) != place->label && picture->ink)
    {
      if (!picture->stroke)
        picture->stroke = celd_stroke_width (picture->ink);
      celd_paper_near (picture->ink, picture->stroke, &place->x, &place->y);
    }
  return CELD_AT (picture->labels, place->x, place->y) == place->label;
}

static CeldStatus
find_parts (LabelledPicture *picture)
{
  CeldComponent *list = NULL;
  size_t         n;
  CeldStatus     status = celd_labels_new (picture->labels->width, picture->labels->height, &picture->part);

  if (status == CELD_OK)
    status = celd_components (picture->labels, UINT32_MAX, false, NULL, &picture->part, &list, &n);
  celd_free (list);
  return status;
}

/* Do the relations i and j meet in two regions of a label that do not touch?  Tells of it in `cycle`. */
static CeldStatus
look_between (LabelledPicture *picture, size_t i, size_t j, CeldCycle *cycle)
{
  const CeldGraph *g = picture->graph;
  CeldStatus       status = CELD_OK;

  for (int from = CELD_FARTHER; from <= (celd_graph_equal (g, i) ? CELD_NEARER : CELD_FARTHER); from++)
    for (int to = celd_graph_equal (g, j) ? CELD_FARTHER : CELD_NEARER; to <= CELD_NEARER; to++)
      {
        Place a, b;

        if (status != CELD_OK || cycle->label || !find_place (picture, i, (CeldSide) from, &a) ||
            !find_place (picture, j, (CeldSide) to, &b) || a.label != b.label || (a.x == b.x && a.y == b.y))
          continue;
        if (!picture->part.data)
          status = find_parts (picture);
        if (status != CELD_OK ||
            CELD_AT (&picture->part, a.x, a.y) == CELD_AT (&picture->part, b.x, b.y))
          continue;
        cycle->label = a.label;
        cycle->x[0] = a.x;
        cycle->y[0] = a.y;
        cycle->x[1] = b.x;
        cycle->y[1] = b.y;
      }
  return status;
}

CeldStatus
celd_cycles_explain (const CeldLabels *labels, const CeldPalette *palette, const CeldPlane *ink,
                     const CeldGraph *graph, CeldOrder *order)
{
  LabelledPicture    picture = { .labels = labels, .ink = ink, .graph = graph };
  CeldStatus status = CELD_OK;

  for (size_t k = 0; k < order->n_cycles && status == CELD_OK; k++)
    {
      CeldCycle *cycle = &order->cycle[k];

      for (size_t i = 0; i < cycle->n && status == CELD_OK; i++)
        status = look_between (&picture, cycle->item[i], cycle->item[(i + 1) % cycle->n], cycle);
      if (cycle->label)
        memcpy (cycle->colour, palette->item[cycle->label - 1].colour, sizeof cycle->colour);
    }
  celd_free (picture.part.data);
  return status;
}
