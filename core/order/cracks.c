/* Cracks: pairs of labels whose relations say that registration may tear between them (the blue arrows of section 3.4).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "order/order.h"

/* Appends all pairs of labels of relation i. */
static CeldStatus
add_cracks (const CeldGraph *graph, size_t i, CeldCrack **crack, size_t *n, size_t *capacity)
{
  const size_t *first = graph->first + 2 * i;
  CeldStatus    status = CELD_OK;

  for (size_t far = first[0]; far < first[1]; far++)
    for (size_t near = first[1]; near < first[2] && status == CELD_OK; near++)
      status = celd_append (*crack, *n, *capacity, (CeldCrack) { graph->end[near] + 1, graph->end[far] + 1 });
  return status;
}

CeldStatus
celd_cracks_find (const CeldLabels *labels, const CeldPalette *palette, const CeldRelations *relations,
                  const CeldPlane *ink, CeldCracks *result)
{
  CeldGraph  graph = { 0 };
  CeldCracks cracks = { 0 };
  size_t     capacity = 0;
  CeldStatus status;

  if (!CELD_SAME_SIZE (labels, labels) || (ink && !CELD_SAME_SIZE (labels, ink)))
    return CELD_BAD_SIZE;
  status = celd_graph_new (labels, palette, relations, ink, &graph, NULL);
  for (size_t i = 0; i < relations->n && status == CELD_OK; i++)
    if (graph.kept[i] && relations->item[i].crack)
      status = add_cracks (&graph, i, &cracks.item, &cracks.n, &capacity);
  celd_graph_clear (&graph);
  if (status == CELD_OK)
    {
      celd_cracks_clear (result);
      *result = cracks;
    }
  else
    celd_cracks_clear (&cracks);
  return status;
}

void
celd_cracks_clear (CeldCracks *cracks)
{
  celd_free (cracks->item);
  *cracks = (CeldCracks) { 0 };
}
