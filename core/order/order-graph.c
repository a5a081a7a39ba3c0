/* Which labels a relation joins.
 *
 * A point means the label of its pixel.  A point on ink (I < 1/2) means the label of the nearest paper within one
 * stroke width, because labels meet somewhere inside the ink.  Ink farther from paper than that is a black area with a
 * label of its own.  A colour means every label that has it, or else the nearest colour that differs by at most 2 of
 * 255, as after colour management.  An equality inside one region always holds; an inequality there is reported as a
 * problem.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "image/image.h"
#include "order/order.h"

#include <string.h>

static bool
on_ink (const CeldPlane *ink, int x, int y)
{
  return ink && !celd_is_paper (CELD_AT (ink, x, y));
}

static uint32_t
label_at (const CeldTermPicture *picture, int x, int y)
{
  uint32_t label = CELD_AT (picture->labels, x, y);

  return label <= picture->palette->n ? label : 0;
}

/* The label of the nearest paper within one stroke width of a pixel on ink; else the pixel's own. */
static uint32_t
label_near (CeldTermPicture *picture, int x, int y)
{
  if (!picture->stroke)
    picture->stroke = celd_stroke_width (picture->ink);
  celd_paper_near (picture->ink, picture->stroke, &x, &y);
  return label_at (picture, x, y);
}

static bool
inside (const CeldLabels *labels, const CeldTerm *term)
{
  return term->x >= 0 && term->y >= 0 && term->x < labels->width && term->y < labels->height; /* false for NaN */
}

/* The label that celd_palette_find finds, and all others of the same colour. */
static CeldStatus
add_colour (const CeldPalette *palette, const uint8_t colour[3], size_t before, CeldGraph *graph)
{
  uint32_t   first  = celd_palette_find (palette, colour);
  CeldStatus status = CELD_OK;

  for (size_t k = first; first && k <= palette->n && status == CELD_OK; k++)
    if (!memcmp (palette->item[k - 1].colour, palette->item[first - 1].colour, 4))
      status = celd_graph_add (graph, (uint32_t) (before + k));
  return status;
}

CeldStatus
celd_graph_add_term (CeldTermPicture *picture, const CeldTerm *term, size_t before, CeldGraph *graph)
{
  uint32_t label;
  int      x, y;

  if (term->by_colour)
    return add_colour (picture->palette, term->colour, before, graph);
  if (!inside (picture->labels, term))
    return CELD_OK;
  x     = (int) term->x;
  y     = (int) term->y;
  label = on_ink (picture->ink, x, y) ? label_near (picture, x, y) : label_at (picture, x, y);
  return label ? celd_graph_add (graph, (uint32_t) (before + label)) : CELD_OK;
}

void
celd_relation_place (const CeldLabels *labels, const CeldPalette *palette, const CeldRelation *relation, int *x, int *y)
{
  const CeldTerm *term = relation->nearer.by_colour || inside (labels, &relation->nearer) ? &relation->nearer
                                                                                          : &relation->farther;
  uint32_t        label = term->by_colour ? celd_palette_find (palette, term->colour) : 0;

  *x = *y = -1;
  if (!term->by_colour && inside (labels, term))
    {
      *x = (int) term->x;
      *y = (int) term->y;
    }
  if (label)
    {
      *x = palette->item[label - 1].x;
      *y = palette->item[label - 1].y;
    }
}

uint32_t
celd_graph_common_label (const CeldGraph *graph, size_t link)
{
  size_t a = graph->first[2 * link], b = graph->first[2 * link + 1], middle = b, last = graph->first[2 * link + 2];

  while (a < middle && b < last)
    if (graph->end[a] == graph->end[b])
      return graph->end[a] + 1;
    else if (graph->end[a] < graph->end[b])
      a++;
    else
      b++;
  return 0;
}

/* Fills in link i.  It is not kept, but reported as a problem, if an end names no label or both name the same one. */
static CeldStatus
add_link (CeldTermPicture *picture, size_t i, CeldGraph *graph, CeldProblems *problems)
{
  const CeldRelation *relation = &graph->relations->item[i];
  const CeldTerm     *term[2]  = { &relation->farther, &relation->nearer };
  CeldProblem         problem  = { .relation = i };
  CeldStatus          status;

  graph->kept[i]  = true;
  graph->equal[i] = relation->equal;
  for (size_t side = 0; side < 2; side++)
    {
      graph->first[2 * i + side] = graph->n_ends;
      if ((status = celd_graph_add_term (picture, term[side], 0, graph)) != CELD_OK)
        return status;
      if (graph->n_ends == graph->first[2 * i + side])
        {
          problem.kind   = term[side]->by_colour ? CELD_PROBLEM_UNKNOWN_COLOUR : CELD_PROBLEM_OUTSIDE;
          problem.label  = term[side]->by_colour ? celd_palette_nearest (picture->palette, term[side]->colour) : 0;
          graph->kept[i] = false;
        }
    }
  graph->first[2 * i + 2] = graph->n_ends;
  if (graph->kept[i] && !relation->equal && (problem.label = celd_graph_common_label (graph, i)) != 0)
    {
      problem.kind   = CELD_PROBLEM_SAME_REGION;
      graph->kept[i] = false;
    }
  if (graph->kept[i])
    return CELD_OK;
  celd_relation_place (picture->labels, picture->palette, relation, &problem.x, &problem.y);
  return celd_problem_add (problems, problem);
}

/* The last link: the background is its farther end. */
static CeldStatus
add_background (const CeldPalette *palette, CeldGraph *graph)
{
  size_t     i      = graph->n_links - 1;
  CeldStatus status = CELD_OK;

  graph->first[2 * i] = graph->n_ends;
  for (size_t k = 0; k < palette->n && status == CELD_OK; k++)
    if (palette->item[k].background)
      status = celd_graph_add (graph, (uint32_t) k + 1);
  graph->first[2 * i + 1] = graph->first[2 * i + 2] = graph->n_ends;
  return status;
}

CeldStatus
celd_graph_add (CeldGraph *graph, uint32_t label)
{
  return celd_append (graph->end, graph->n_ends, graph->end_capacity, label - 1);
}

void
celd_arc_index_clear (CeldArcIndex *index)
{
  celd_free (index->first);
  celd_free (index->arc);
  *index = (CeldArcIndex) { 0 };
}

CeldLinkArc
celd_graph_arc (const CeldGraph *graph, size_t link, CeldSide to)
{
  const size_t *f = &graph->first[2 * link + to];

  return (CeldLinkArc) { (uint32_t) link, !graph->equal[link] && f[1] - f[0] == 1 ? graph->end[f[0]] : CELD_MANY_ENDS };
}

bool
celd_graph_point (const CeldGraph *graph, size_t i, CeldSide side, uint32_t *label, int *x, int *y)
{
  const CeldRelation *relation = &graph->relations->item[i];
  const CeldTerm     *term = side == CELD_NEARER ? &relation->nearer : &relation->farther;

  if (term->by_colour)
    return false;
  *label = graph->end[graph->first[2 * i + side]] + 1;
  *x     = (int) term->x;
  *y     = (int) term->y;
  return true;
}

CeldStatus
celd_graph_index (const CeldGraph *graph, CeldSide side, const bool *use, CeldArcIndex *index)
{
  size_t      *first = celd_alloc0 (graph->n_labels + 2, sizeof *first);
  CeldLinkArc *arc = celd_alloc (graph->n_ends, sizeof *arc);

  *index = (CeldArcIndex) { first, arc };
  if (!first || !arc)
    {
      celd_arc_index_clear (index);
      return CELD_NO_MEMORY;
    }
  /* Count into first[k + 2], add up, then place: each place moves first[k + 1] on to where label k ends. */
  for (int pass = 0; pass < 2; pass++)
    {
      for (size_t i = 0; i < graph->n_links; i++)
        {
          const size_t *f    = &graph->first[2 * i];
          bool          both = graph->equal[i];

          if (use && !use[i])
            continue;
          for (size_t e = both ? f[0] : f[side]; e < (both ? f[2] : f[side + 1]); e++)
            if (pass == 0)
              first[graph->end[e] + 2]++;
            else
              arc[first[graph->end[e] + 1]++] = celd_graph_arc (graph, i, side == CELD_NEARER ? CELD_FARTHER
                                                                                              : CELD_NEARER);
        }
      for (size_t k = 2; pass == 0 && k < graph->n_labels + 2; k++)
        first[k] += first[k - 1];
    }
  return CELD_OK;
}

CeldStatus
celd_graph_new (const CeldLabels *labels, const CeldPalette *palette, const CeldRelations *relations,
                const CeldPlane *ink, CeldGraph *graph, CeldProblems *problems)
{
  CeldTermPicture picture = { labels, palette, ink, 0 };
  size_t          n_links = relations->n + 1;
  CeldStatus      status  = CELD_OK;

  *graph = (CeldGraph) {
    .relations = relations, .n_labels = palette->n, .n_links = n_links,
    .first = celd_alloc0 (2 * n_links + 1, sizeof (size_t)), .kept = celd_alloc0 (n_links, sizeof (bool)),
    .equal = celd_alloc0 (n_links, sizeof (bool)),
  };
  if (!graph->first || !graph->kept || !graph->equal)
    status = CELD_NO_MEMORY;
  for (size_t i = 0; i < relations->n && status == CELD_OK; i++)
    status = add_link (&picture, i, graph, problems);
  if (status == CELD_OK)
    status = add_background (palette, graph);
  if (status != CELD_OK)
    celd_graph_clear (graph);
  return status;
}

void
celd_graph_clear (CeldGraph *graph)
{
  celd_free (graph->first);
  celd_free (graph->end);
  celd_free (graph->kept);
  celd_free (graph->equal);
  *graph = (CeldGraph) { 0 };
}

/* ------------------------------------------------------------------ classes of labels of equal depth */

CeldStatus
celd_equivalence_new (size_t n, CeldEquivalence *classes)
{
  *classes = (CeldEquivalence) { celd_alloc (n, sizeof (uint32_t)), celd_alloc (n, sizeof (uint32_t)) };
  if (!classes->parent || !classes->next)
    return CELD_NO_MEMORY;
  celd_roots (classes->parent, n);
  celd_roots (classes->next, n);
  return CELD_OK;
}

void
celd_equivalence_clear (CeldEquivalence *classes)
{
  celd_free (classes->parent);
  celd_free (classes->next);
  *classes = (CeldEquivalence) { 0 };
}

void
celd_equivalence_join (CeldEquivalence *classes, uint32_t a, uint32_t b)
{
  uint32_t next;

  a = celd_class_of (classes, a);
  b = celd_class_of (classes, b);
  if (a == b)
    return;
  celd_join (classes->parent, a, b);
  next             = classes->next[a]; /* joins the two rings */
  classes->next[a] = classes->next[b];
  classes->next[b] = next;
}
