/* LazyBrush [SDC09b] (section 3.2) on the basin graph of a drawing.
 *
 * A merged basin in which at most one label has paint is one node; a merged basin that several labels share becomes one
 * node per basin, so that the cut can find the narrowest place between their strokes.  Links are the sums of smoothness
 * costs along boundaries, data costs are those of the paint, as on pixels.  The labels are those of the lowest energy
 * that greedy cuts and alpha-expansion find (partition.c).
 *
 * Cutting a part off at a neck of two pixels can cost less than the part's outline.  With keep_necks a merged basin
 * with paint of one label keeps that label, whatever a cut would save.
 *
 * Nodes without paint are cut once more, with the labels of all others given (unpainted-basins.c).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "segment/basins.h"
#include "segment/task.h"
#include "solve/maxflow.h"
#include "solve/partition.h"

#define SHARED UINT32_MAX /* value of sole_label: several labels have paint there */

typedef struct
{
  const CeldSegmentTask *task;
  CeldStrokes            strokes;
  uint32_t              *sole_label; /* of each merged basin: the only label with paint in it, 0, or SHARED */
  uint32_t              *node;       /* of basin k */
  size_t                 n;          /* nodes */
  uint32_t              *fixed;      /* of node k: its label if that is given, or 0 */
  uint32_t              *label;      /* of node k: the result */
  uint32_t              *order;
  CeldLink              *link;
  CeldVote              *vote;
  size_t                 n_links, n_votes, vote_capacity;
} Graph;

static CeldStatus
graph_new (const CeldSegmentTask *task, Graph *g)
{
  const CeldBasins *basins = task->basins;

  *g = (Graph) {
    .task = task,
    .sole_label = celd_alloc0 (basins->n_merged + 1, sizeof *g->sole_label),
    .node   = celd_alloc (basins->n, sizeof *g->node),
    .fixed  = celd_alloc0 (basins->n, sizeof *g->fixed),
    .label  = celd_alloc (basins->n, sizeof *g->label),
    .order  = celd_alloc (task->palette.n, sizeof *g->order),
    .link   = celd_alloc (basins->n_boundaries, sizeof *g->link),
  };
  if (!g->sole_label || !g->node || !g->fixed || !g->label || !g->order || !g->link)
    return CELD_NO_MEMORY;
  return celd_strokes_new (task, NULL, &g->strokes);
}

static void
graph_clear (Graph *g)
{
  celd_strokes_keep (g->task, &g->strokes);
  celd_free (g->sole_label);
  celd_free (g->node);
  celd_free (g->fixed);
  celd_free (g->label);
  celd_free (g->order);
  celd_free (g->link);
  celd_free (g->vote);
}

/* ------------------------------------------------------------------ nodes */

/* The pixels of a piece that say something about its basin: paint on the outer half of a contour says nothing about the
 * region behind it. */
static size_t
informative_pixels (const CeldBasins *basins, const CeldStrokePiece *piece)
{
  return basins->basin[piece->basin].solid ? (size_t) (piece->end - piece->x) : piece->paper;
}

static void
find_sole_labels (Graph *g)
{
  const CeldBasins *basins = g->task->basins;

  for (size_t i = 0; i < g->strokes.n_pieces; i++)
    {
      const CeldStrokePiece *piece = &g->strokes.piece[i];
      uint32_t              *sole_label = &g->sole_label[basins->merged[piece->basin]];

      if (informative_pixels (basins, piece))
        *sole_label = !*sole_label || *sole_label == piece->label ? piece->label : SHARED;
    }
}

static CeldStatus
make_nodes (Graph *g)
{
  const CeldBasins *basins = g->task->basins;
  uint32_t         *node = celd_alloc0 (basins->n_merged + 1, sizeof *node); /* of a merged basin, from 1 */

  if (!node)
    return CELD_NO_MEMORY;
  for (size_t k = 0; k < basins->n; k++)
    {
      uint32_t merged = basins->merged[k];

      if (g->sole_label[merged] == SHARED)
        g->node[k] = (uint32_t) g->n++;
      else
        {
          if (!node[merged])
            node[merged] = (uint32_t) ++g->n;
          g->node[k] = node[merged] - 1;
        }
    }
  celd_free (node);
  return CELD_OK;
}

/* ------------------------------------------------------------------ data costs */

/* Fixes nodes to the hard label with most informative pixels; solve-windows.c deals with the others. */
static CeldStatus
fix_hard_labels (Graph *g)
{
  const CeldBasins *basins = g->task->basins;
  size_t           *most = celd_alloc0 (g->n, sizeof *most), *sum = celd_alloc0 (g->task->palette.n + 1, sizeof *sum);
  size_t           *first = celd_alloc0 (g->n + 2, sizeof *first);
  size_t           *piece = celd_alloc (g->strokes.n_pieces, sizeof *piece);
  CeldStatus        status = most && sum && first && piece ? CELD_OK : CELD_NO_MEMORY;

  if (status != CELD_OK)
    goto done;
  for (size_t i = 0; i < g->strokes.n_pieces; i++)
    first[g->node[g->strokes.piece[i].basin] + 2]++;
  for (size_t k = 2; k < g->n + 2; k++)
    first[k] += first[k - 1];
  for (size_t i = 0; i < g->strokes.n_pieces; i++)
    piece[first[g->node[g->strokes.piece[i].basin] + 1]++] = i;
  for (size_t k = 0; k < g->n; k++)
    {
      for (size_t i = first[k]; i < first[k + 1]; i++)
        {
          const CeldStrokePiece *d = &g->strokes.piece[piece[i]];

          if (celd_task_data_cost (g->task, d->label) == CELD_HARD)
            sum[d->label] += informative_pixels (basins, d);
          if (sum[d->label] > most[k])
            {
              most[k]     = sum[d->label];
              g->fixed[k] = d->label;
            }
        }
      for (size_t i = first[k]; i < first[k + 1]; i++)
        sum[g->strokes.piece[piece[i]].label] = 0;
    }

done:
  celd_free (most);
  celd_free (sum);
  celd_free (first);
  celd_free (piece);
  return status;
}

/* With keep_necks: a merged basin keeps the only label that has paint there. */
static void
fix_sole_labels (Graph *g)
{
  const CeldBasins *basins = g->task->basins;

  for (size_t k = 0; k < basins->n; k++)
    {
      uint32_t sole_label = g->sole_label[basins->merged[k]];

      if (sole_label && sole_label != SHARED && !g->fixed[g->node[k]])
        g->fixed[g->node[k]] = sole_label;
    }
}

static CeldStatus
gather_data_costs (Graph *g)
{
  const CeldBasins *basins = g->task->basins;

  for (size_t i = 0; i < g->strokes.n_pieces; i++)
    {
      const CeldStrokePiece *piece = &g->strokes.piece[i];
      int32_t                vote = celd_task_data_cost (g->task, piece->label);
      uint32_t               node = g->node[piece->basin];
      int64_t                cost = (int64_t) vote * (int64_t) informative_pixels (basins, piece);

      if (vote == CELD_HARD || !cost)
        continue;
      if (g->n_votes && g->vote[g->n_votes - 1].node == node && g->vote[g->n_votes - 1].label == piece->label)
        {
          g->vote[g->n_votes - 1].cost += cost;
          continue;
        }
      if (celd_append (g->vote, g->n_votes, g->vote_capacity, (CeldVote) { node, piece->label, cost }) != CELD_OK)
        return CELD_NO_MEMORY;
    }
  return CELD_OK;
}

/* Sums up the smoothness costs between each two nodes. */
static CeldStatus
gather_links (Graph *g)
{
  const CeldBasins *basins = g->task->basins;
  CeldLink         *listed = celd_alloc (basins->n_boundaries, sizeof *listed);
  CeldStatus        status = CELD_NO_MEMORY;

  for (size_t i = 0; i < basins->n_boundaries && listed; i++)
    {
      const CeldBasinBoundary *b = &basins->boundary[i];

      listed[i] = (CeldLink) { g->node[b->a], g->node[b->b], b->cost };
    }
  if (listed)
    status = celd_links_sum (g->n, listed, basins->n_boundaries, g->link, &g->n_links);
  celd_free (listed);
  return status;
}

/* ------------------------------------------------------------------ nodes without paint */

/* Fixes nodes with paint to their labels; returns how many have none. */
static size_t
fix_painted (Graph *g, bool *painted)
{
  const CeldBasins *basins = g->task->basins;
  size_t            unpainted = g->n;

  for (size_t i = 0; i < g->strokes.n_pieces; i++)
    if (informative_pixels (basins, &g->strokes.piece[i]))
      painted[g->node[g->strokes.piece[i].basin]] = true;
  for (size_t k = 0; k < g->n; k++)
    {
      g->fixed[k] = painted[k] ? g->label[k] : 0;
      unpainted -= painted[k];
    }
  return unpainted;
}

/* Nodes with paint keep their labels, and all others get the label behind the weakest barrier. */
static CeldStatus
label_unpainted (Graph *g, const CeldHost *host)
{
  bool      *painted = celd_alloc0 (g->n, sizeof *painted);
  size_t     unpainted = painted ? fix_painted (g, painted) : 0;
  CeldStatus status = painted ? CELD_OK : CELD_NO_MEMORY;

  celd_free (painted);
  if (status == CELD_OK && unpainted && unpainted < g->n)
    status = celd_unpainted_solve (g->task, g->node, g->n, g->fixed, g->order, host, g->label);
  return status;
}

/* ------------------------------------------------------------------ the whole */

CeldStatus
celd_basin_graph_solve (const CeldSegmentTask *task, const CeldHost *host, uint32_t *label)
{
  CeldHostPart part[2];
  CeldHost     energy = celd_host_part (&part[0], host, 0, 0.8), rest = celd_host_part (&part[1], host, 0.8, 1);
  Graph        g;
  CeldStatus   status = graph_new (task, &g);

  if (status == CELD_OK)
    {
      find_sole_labels (&g);
      status = make_nodes (&g);
    }
  if (status == CELD_OK)
    status = fix_hard_labels (&g);
  if (status == CELD_OK && task->settings->keep_necks)
    fix_sole_labels (&g);
  if (status == CELD_OK)
    status = gather_data_costs (&g);
  if (status == CELD_OK)
    status = gather_links (&g);
  if (status == CELD_OK)
    status = celd_task_label_order (task, g.order);
  if (status == CELD_OK)
    {
      CeldPartition problem = {
        g.n, g.link, g.n_links, g.vote, g.n_votes, g.fixed, g.order, task->palette.n
      };

      status = celd_partition (&problem, &energy, g.label, NULL, NULL);
    }
  if (status == CELD_OK)
    status = label_unpainted (&g, &rest);
  for (size_t k = 0; k < task->basins->n && status == CELD_OK; k++)
    label[k] = g.label[g.node[k]];
  graph_clear (&g);
  return status;
}
