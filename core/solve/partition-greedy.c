/* The labels told apart in turn by exact cuts, as in multiway.c: in each connected piece of undecided nodes the first
 * label that reaches it from all others, and so on with the connected pieces of both sides.  A piece that only one
 * label reaches is that label's without a cut.  Many labels are first told apart in halves.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "solve/flow.h"
#include "solve/partition-graph.h"

#include <string.h>

#define MANY_LABELS 24 /* from here on a piece is cut between two halves of its labels */

/* A connected piece: the nodes item[begin] .. item[end - 1], for which piece[p] == id.  Labels of rank from .. to - 1
 * may get it; the next cut is between those below mid and the others. */
typedef struct { uint32_t id; uint32_t begin, end; uint32_t from, mid, to; } Piece;

typedef struct
{
  CeldPartitionGraph *graph;
  uint32_t *piece;
  uint32_t *item, *found;   /* nodes by piece; while pieces are looked for, the new ones */
  uint32_t *seen;           /* by rank: the last piece that this label reaches */
  uint32_t  last_id;
  Piece    *todo;           /* a piece has a node at least, so that there are never more than nodes */
  size_t    n_todo, decided;
} Greedy;

/* ------------------------------------------------------------------ pieces */

/* Counts the labels that reach p, of those that may get the piece and have not been seen in it. */
static uint32_t
see (Greedy *g, const Piece *piece, uint32_t p)
{
  uint32_t reached = 0;

  for (size_t i = g->graph->of_node[p]; i < g->graph->of_node[p + 1]; i++)
    {
      uint32_t rank = g->graph->ballot[i].rank;

      if (rank < piece->from || rank >= piece->to || g->seen[rank] == piece->id)
        continue;
      g->seen[rank] = piece->id;
      reached++;
    }
  return reached;
}

/* Makes the nodes that hang together with `start` and are of piece `old` the new piece, from piece->begin on.  Returns
 * the number of labels that reach it. */
static uint32_t
fill (Greedy *g, uint32_t start, uint32_t old, Piece *piece)
{
  const CeldNetwork *network = &g->graph->network;
  uint32_t           reached = 0;

  piece->end = piece->begin;
  g->piece[start] = piece->id;
  g->found[piece->end++] = start;
  for (uint32_t i = piece->begin; i < piece->end; i++)
    {
      uint32_t p = g->found[i];

      reached += see (g, piece, p);
      for (uint32_t a = network->node[p].arc; a < network->node[p + 1].arc; a++)
        {
          uint32_t q = network->arc[a].to;

          if (g->piece[q] != old)
            continue;
          g->piece[q] = piece->id;
          g->found[piece->end++] = q;
        }
    }
  return reached;
}

/* The piece belongs to the only label that reaches it, or to the first one if none does. */
static void
decide (Greedy *g, const Piece *piece)
{
  uint32_t rank = piece->from;

  while (rank < piece->to && g->seen[rank] != piece->id)
    rank++;
  for (uint32_t i = piece->begin; i < piece->end; i++)
    g->graph->rank[g->found[i]] = rank < piece->to ? rank : piece->from;
  g->decided += piece->end - piece->begin;
}

/* The first label against the others; or the first half of them if they are many. */
static uint32_t
middle_rank (const Greedy *g, const Piece *piece, uint32_t reached)
{
  uint32_t left = reached < MANY_LABELS ? 1 : reached / 2;
  uint32_t rank = piece->from;

  for (; left; rank++)
    left -= g->seen[rank] == piece->id;
  return rank;
}

/* Finds the connected pieces among the items of `first` and `others`, which lie mixed.  Those that one label reaches
 * are decided, the others noted. */
static void
find_pieces (Greedy *g, const Piece *first, const Piece *others)
{
  uint32_t begin = others->begin;

  for (uint32_t i = others->begin; i < others->end; i++)
    {
      uint32_t     p = g->item[i], reached;
      const Piece *old = g->piece[p] == first->id ? first : others;
      Piece        piece = *old;

      if (g->piece[p] != old->id)
        continue;
      piece.id    = ++g->last_id;
      piece.begin = begin;
      reached = fill (g, p, old->id, &piece);
      begin   = piece.end;
      if (reached < 2)
        decide (g, &piece);
      else
        {
          piece.mid = middle_rank (g, &piece, reached);
          g->todo[g->n_todo++] = piece;
        }
    }
  memcpy (g->item + others->begin, g->found + others->begin, (others->end - others->begin) * sizeof *g->item);
}

/* ------------------------------------------------------------------ one cut */

/* What pulls p to the labels below mid (> 0) or to the others (< 0). */
static int64_t
pull (const Greedy *g, const Piece *piece, uint32_t p)
{
  int64_t sum = 0;

  for (size_t i = g->graph->of_node[p]; i < g->graph->of_node[p + 1]; i++)
    {
      const CeldBallot *ballot = &g->graph->ballot[i];

      if (ballot->rank >= piece->from && ballot->rank < piece->to)
        sum += ballot->rank < piece->mid ? ballot->cost : -ballot->cost;
    }
  return sum;
}

/* Arcs only within the piece. */
static void
lay_out (Greedy *g, const Piece *piece)
{
  CeldNetwork *network = &g->graph->network;

  celd_network_begin (network);
  for (uint32_t i = piece->begin; i < piece->end; i++)
    {
      uint32_t p = g->item[i];

      for (uint32_t a = network->node[p].arc; a < network->node[p + 1].arc; a++)
        {
          CeldFlowArc *arc = &network->arc[a];

          arc->left[0] = arc->left[1] = g->piece[arc->to] == piece->id ? g->graph->cost[a] : 0;
        }
      network->node[p].excess = pull (g, piece, p);
      if (network->node[p].excess)
        celd_network_root (network, p);
    }
}

static CeldStatus
cut (Greedy *g, const Piece *piece, const CeldHost *host)
{
  CeldNetwork *network = &g->graph->network;
  Piece        first = *piece, others = *piece;
  double       done = (double) g->decided / (double) g->graph->n;
  CeldHostPart     part;
  CeldHost     still = celd_host_part (&part, host, done, done);
  CeldStatus   status = celd_progress (host, done);

  if (status != CELD_OK)
    return status;
  lay_out (g, piece);
  status = celd_network_drain (network, &still);
  if (status != CELD_OK)
    return status;
  first.id = ++g->last_id;
  first.to = others.from = piece->mid;
  for (size_t i = 0; i < network->n_reached; i++)
    g->piece[network->reached[i]] = first.id;
  find_pieces (g, &first, &others);
  return CELD_OK;
}

/* ------------------------------------------------------------------ the whole */

CeldStatus
celd_partition_greedy (CeldPartitionGraph *graph, const CeldHost *host)
{
  size_t     n = graph->n;
  Greedy     g = { .graph = graph, .last_id = 1 };
  Piece      all = { 1, 0, (uint32_t) n, 0, 0, (uint32_t) graph->n_ranks }, none = { 0 };
  CeldStatus status = CELD_NO_MEMORY;

  g.piece = celd_alloc (n, sizeof *g.piece);
  g.item  = celd_alloc (n, sizeof *g.item);
  g.found = celd_alloc (n, sizeof *g.found);
  g.seen  = celd_alloc0 (graph->n_ranks, sizeof *g.seen);
  g.todo  = celd_alloc (n, sizeof *g.todo);
  if (!g.piece || !g.item || !g.found || !g.seen || !g.todo)
    goto done;
  for (uint32_t p = 0; p < n; p++)
    {
      g.piece[p] = 1;
      g.item[p]  = p;
    }
  find_pieces (&g, &none, &all);
  status = celd_progress (host, 0);
  while (status == CELD_OK && g.n_todo)
    {
      Piece piece = g.todo[--g.n_todo];

      status = cut (&g, &piece, host);
    }

done:
  celd_free (g.piece);
  celd_free (g.item);
  celd_free (g.found);
  celd_free (g.seen);
  celd_free (g.todo);
  return status;
}
