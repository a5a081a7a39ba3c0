/* The regions of several drawings, and all that says how they lie over each other, as one graph.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/compose.h"

/* ------------------------------------------------------------------ nodes */

static size_t
labels_of (const CeldFragmentGraph *all, size_t fragment)
{
  return all->fragment[fragment].order->n;
}

/* Labels without a layer first, then the others in the order of their layers. */
static void
number_labels (CeldFragmentGraph *all, size_t f, uint32_t *next)
{
  const CeldLayers *layers = all->fragment[f].layers;
  uint32_t         *node = all->node + all->before[f];

  for (size_t l = 0; l < labels_of (all, f); l++)
    node[l] = UINT32_MAX;
  for (size_t k = 0; k < layers->n; k++)
    node[layers->item[k].label - 1] = 0;
  for (size_t l = 0; l < labels_of (all, f); l++)
    if (node[l])
      node[l] = (*next)++;
  for (size_t k = 0; k < layers->n; k++)
    node[layers->item[k].label - 1] = (*next)++;
}

static CeldStatus
make_nodes (CeldFragmentGraph *all)
{
  const CeldComposition *c = all->composition;
  size_t                 n = 0;
  uint32_t               next = 0;

  all->before = celd_alloc (c->n, sizeof *all->before);
  for (size_t f = 0; f < c->n && all->before; f++)
    {
      all->before[f] = n;
      n += labels_of (all, f);
    }
  all->node    = celd_alloc (n, sizeof *all->node);
  all->node_of = celd_alloc (c->n_items, sizeof *all->node_of);
  if (!all->before || !all->node || !all->node_of)
    return CELD_NO_MEMORY;
  if (n >= UINT32_MAX / 2)
    return CELD_BAD_SIZE;
  for (size_t f = 0; f < c->n; f++)
    number_labels (all, f, &next);
  for (size_t i = 0; i < c->n_items; i++)
    all->node_of[i] = all->node[all->before[c->item[i].fragment] + c->item[i].label - 1];
  all->graph.n_labels = n;
  return CELD_OK;
}

/* ------------------------------------------------------------------ links */

/* Every region of a drawing but its page. */
static CeldStatus
add_whole (CeldFragmentGraph *all, size_t f)
{
  CeldStatus status = CELD_OK;

  for (uint32_t l = 1; l <= labels_of (all, f) && status == CELD_OK; l++)
    if (l != all->fragment[f].page)
      status = celd_graph_add (&all->graph, (uint32_t) all->before[f] + l);
  return status;
}

/* Appends the labels of a term; none if it names nothing. */
static CeldStatus
add_term (CeldFragmentGraph *all, CeldTermPicture *picture, const CeldTerm *term)
{
  const CeldFragment *fragment = &all->fragment[term->fragment];

  if (term->fragment >= all->composition->n)
    return CELD_BAD_VALUE;
  if (term->whole)
    return add_whole (all, term->fragment);
  if (!fragment->labels || !fragment->palette)
    return CELD_OK;
  picture += term->fragment;
  *picture = (CeldTermPicture) { fragment->labels, fragment->palette, fragment->ink, picture->stroke };
  return celd_graph_add_term (picture, term, all->before[term->fragment], &all->graph);
}

static void
begin_link (CeldGraph *g, size_t link, bool equal)
{
  g->equal[link]         = equal;
  g->first[2 * link]     = g->n_ends;
  g->first[2 * link + 1] = g->first[2 * link + 2] = g->n_ends;
}

/* Fills in the link of a relation; *good says whether it joins anything. */
static CeldStatus
add_relation (CeldFragmentGraph *all, CeldTermPicture *picture, size_t i, CeldProblems *problems, bool *good)
{
  const CeldRelation *relation = &all->relations->item[i];
  const CeldTerm     *term[2] = { &relation->farther, &relation->nearer };
  CeldProblem         problem = { .x = -1, .y = -1, .relation = i };
  CeldGraph          *g = &all->graph;
  CeldStatus          status = CELD_OK;

  *good = true;
  begin_link (g, i, relation->equal);
  for (size_t side = 0; side < 2 && status == CELD_OK; side++)
    {
      size_t before = g->n_ends;

      status = add_term (all, picture, term[side]);
      g->first[2 * i + side + 1] = g->n_ends;
      if (status != CELD_OK || g->n_ends > before)
        continue;
      problem.kind = term[side]->by_colour ? CELD_PROBLEM_UNKNOWN_COLOUR : CELD_PROBLEM_OUTSIDE;
      *good        = false;
    }
  if (status == CELD_OK && *good && !relation->equal && celd_graph_common_label (g, i))
    {
      problem.kind = CELD_PROBLEM_SAME_REGION;
      *good        = false;
    }
  return status != CELD_OK || *good ? status : celd_problem_add (problems, problem);
}

/* Adds the relations between drawings; those that join nothing have links without ends. */
static CeldStatus
add_relations (CeldFragmentGraph *all, CeldProblems *problems)
{
  CeldTermPicture *picture = celd_alloc0 (all->composition->n, sizeof *picture);
  CeldStatus       status = picture ? CELD_OK : CELD_NO_MEMORY;

  for (size_t i = 0; i < all->n_relations && status == CELD_OK; i++)
    {
      bool good;

      status = add_relation (all, picture, i, problems, &good);
      if (!good)
        all->graph.n_ends = all->graph.first[2 * i];
      if (!good)
        begin_link (&all->graph, i, false);
    }
  celd_free (picture);
  return status;
}

/* Adds the relations within a drawing. */
static CeldStatus
add_own_links (CeldFragmentGraph *all, size_t f, size_t *link)
{
  const CeldOrderLinks *links = &all->fragment[f].order->links;
  CeldGraph            *g = &all->graph;
  CeldStatus            status = CELD_OK;

  for (size_t i = 0; i < links->n; i++, ++*link)
    {
      begin_link (g, *link, links->equal[i]);
      for (size_t e = links->first[2 * i]; e < links->first[2 * i + 2] && status == CELD_OK; e++)
        {
          status = celd_graph_add (g, (uint32_t) all->before[f] + links->end[e] + 1);
          if (e + 1 == links->first[2 * i + 1])
            g->first[2 * *link + 1] = g->n_ends;
        }
      g->first[2 * *link + 2] = g->n_ends;
    }
  return status;
}

static CeldStatus
add_level (CeldFragmentGraph *all, size_t f, uint32_t level)
{
  CeldStatus status = CELD_OK;

  for (uint32_t l = 0; l < labels_of (all, f) && status == CELD_OK; l++)
    if (all->fragment[f].order->level[l] == level)
      status = celd_graph_add (&all->graph, (uint32_t) all->before[f] + l + 1);
  return status;
}

/* The number of links between the levels of a drawing of which only these are known. */
static size_t
count_steps (const CeldOrder *order)
{
  return order->links.n || order->levels < 2 ? 0 : order->levels - 1;
}

static CeldStatus
add_steps (CeldFragmentGraph *all, size_t f, size_t *link)
{
  CeldStatus status = CELD_OK;

  for (size_t i = 0; i < count_steps (all->fragment[f].order) && status == CELD_OK; i++, ++*link)
    {
      begin_link (&all->graph, *link, false);
      status = add_level (all, f, (uint32_t) i);
      all->graph.first[2 * *link + 1] = all->graph.n_ends;
      if (status == CELD_OK)
        status = add_level (all, f, (uint32_t) i + 1);
      all->graph.first[2 * *link + 2] = all->graph.n_ends;
    }
  return status;
}

static CeldStatus
add_wishes (CeldFragmentGraph *all, const CeldOverlaps *overlaps, size_t link)
{
  CeldStatus status = CELD_OK;

  for (size_t i = 0; i < overlaps->n && status == CELD_OK; i++, link++)
    {
      begin_link (&all->graph, link, false);
      status = celd_append (all->graph.end, all->graph.n_ends, all->graph.end_capacity,
                            all->node_of[overlaps->item[i].farther]);
      all->graph.first[2 * link + 1] = all->graph.n_ends;
      if (status == CELD_OK)
        status = celd_append (all->graph.end, all->graph.n_ends, all->graph.end_capacity,
                              all->node_of[overlaps->item[i].nearer]);
      all->graph.first[2 * link + 2] = all->graph.n_ends;
    }
  return status;
}

/* All links.  Those of relations are made of labels first, whose numbers rise, and then turned into nodes. */
static CeldStatus
make_links (CeldFragmentGraph *all, const CeldOverlaps *overlaps, CeldProblems *problems)
{
  CeldGraph *g = &all->graph;
  size_t     link;
  CeldStatus status;

  all->n_relations = all->relations ? all->relations->n : 0;
  for (size_t f = 0; f < all->composition->n; f++)
    all->n_own += all->fragment[f].order->links.n + count_steps (all->fragment[f].order);
  g->n_links = all->n_relations + all->n_own + overlaps->n;
  g->first   = celd_alloc0 (2 * g->n_links + 1, sizeof *g->first);
  g->equal   = celd_alloc0 (g->n_links, sizeof *g->equal);
  status     = g->first && g->equal ? add_relations (all, problems) : CELD_NO_MEMORY;
  link       = all->n_relations;
  for (size_t f = 0; f < all->composition->n && status == CELD_OK; f++)
    {
      status = add_own_links (all, f, &link);
      if (status == CELD_OK)
        status = add_steps (all, f, &link);
    }
  for (size_t e = 0; e < g->n_ends; e++)
    g->end[e] = all->node[g->end[e]];
  return status == CELD_OK ? add_wishes (all, overlaps, link) : status;
}

CeldStatus
celd_fragment_graph_new (const CeldFragment *fragment, const CeldRelations *relations, const CeldOverlaps *overlaps,
                         const CeldComposition *composition, CeldProblems *problems, CeldFragmentGraph *graph)
{
  CeldStatus status;

  *graph = (CeldFragmentGraph) { .fragment = fragment, .relations = relations, .composition = composition };
  status = make_nodes (graph);
  return status == CELD_OK ? make_links (graph, overlaps, problems) : status;
}

void
celd_fragment_graph_clear (CeldFragmentGraph *graph)
{
  celd_graph_clear (&graph->graph);
  celd_free (graph->before);
  celd_free (graph->node);
  celd_free (graph->node_of);
}
