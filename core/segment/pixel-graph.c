/* Nodes, links and data costs of a graph of pixels.
 *
 * Cost: a pass over the states of each square, and over the edges between different parts.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "segment/pixel-graph.h"

#define MEASURED (-CELD_MOST_TO_PAPER) /* the true distance to paper is measured */

CeldStatus
celd_pixel_graph_new (const CeldSegmentTask *task, CeldRect box, CeldPixelGraph *graph)
{
  *graph = (CeldPixelGraph) {
    .task   = task,
    .box    = box,
    .part   = celd_alloc ((size_t) box.width * (size_t) box.height, sizeof *graph->part),
    .parent = celd_alloc (CELD_LARGEST_SQUARE * CELD_LARGEST_SQUARE, sizeof *graph->parent),
  };
  return graph->part && graph->parent ? CELD_OK : CELD_NO_MEMORY;
}

void
celd_pixel_graph_clear (CeldPixelGraph *graph)
{
  celd_free (graph->part);
  celd_free (graph->node);
  celd_free (graph->link);
  celd_free (graph->vote);
  celd_free (graph->parent);
  *graph = (CeldPixelGraph) { .task = NULL };
}

void
celd_pixel_graph_empty (CeldPixelGraph *graph)
{
  graph->n = graph->n_links = graph->n_votes = 0;
}

/* Adds the cost of a node without this label. */
static CeldStatus
add_data_cost (CeldPixelGraph *graph, uint32_t node, uint32_t label, int64_t cost)
{
  CeldVote *last = graph->n_votes ? &graph->vote[graph->n_votes - 1] : NULL;

  if (last && last->node == node && last->label == label)
    {
      last->cost += cost;
      return CELD_OK;
    }
  return celd_append (graph->vote, graph->n_votes, graph->vote_capacity, (CeldVote) { node, label, cost });
}

/* ------------------------------------------------------------------ nodes */

/* The states of a square's w x h pixels. */
typedef struct { const uint64_t *state; size_t stride; int w, h, cell; } Square;

/* Is (x,y) connected to its neighbour (u,v), which is in the square or not? */
static inline bool
is_joined (const Square *square, int x, int y, int u, int v)
{
  const uint64_t *state = square->state + (size_t) y * square->stride + (size_t) x;

  return u >= 0 && u < square->w && v >= 0 && *state == square->state[(size_t) v * square->stride + (size_t) u]
         && (*state & CELD_STATE_WIDE || (x >> square->cell == u >> square->cell
                                          && y >> square->cell == v >> square->cell));
}

/* Joins connected pixels of equal state, but not those again that are joined through the row above. */
static void
join_pixels (const Square *square, uint32_t *parent)
{
  uint32_t w = (uint32_t) square->w, k = 0;

  for (int y = 0; y < square->h; y++)
    for (int x = 0; x < square->w; x++, k++)
      {
        uint64_t state = square->state[(size_t) y * square->stride + (size_t) x];
        bool     west = is_joined (square, x, y, x - 1, y), north = is_joined (square, x, y, x, y - 1);
        bool     north_west = is_joined (square, x, y, x - 1, y - 1);

        parent[k] = west ? parent[k - 1] : k;
        if (north && !(west && north_west))
          celd_join (parent, k, k - w);
        if (!(state & CELD_STATE_DIAGONAL) || north)
          continue;
        if (north_west && !west)
          celd_join (parent, k, k - w - 1);
        if (is_joined (square, x, y, x + 1, y - 1))
          celd_join (parent, k, k - w + 1);
      }
}

/* The bits that all states of a square have; *uniform: are all states equal? */
static uint64_t
common_state (const Square *square, bool *uniform)
{
  uint64_t different = 0, common = *square->state;

  for (int y = 0; y < square->h; y++)
    for (int x = 0; x < square->w; x++)
      {
        uint64_t state = square->state[(size_t) y * square->stride + (size_t) x];

        different |= state ^ *square->state;
        common    &= state;
      }
  *uniform = !different;
  return common;
}

static CeldStatus
add_node (CeldPixelGraph *graph, int x, int y, int size, bool whole, uint64_t state)
{
  return celd_append (graph->node, graph->n, graph->node_capacity,
                      (CeldPixelNode) { x, y, size, whole, (uint32_t) (state & CELD_STATE_VALUE) });
}

CeldStatus
celd_pixel_graph_add_whole (CeldPixelGraph *graph, int x, int y, int size, uint64_t state)
{
  uint32_t node = (uint32_t) graph->n;
  int      right = celd_pixel_graph_right (graph, x, size);

  for (int v = y; v < celd_pixel_graph_bottom (graph, y, size); v++)
    for (uint32_t *part = celd_pixel_graph_part (graph, x, v), *end = part + (right - x); part < end; part++)
      *part = node;
  return add_node (graph, x, y, size, true, state);
}

CeldStatus
celd_pixel_graph_add_square (CeldPixelGraph *graph, int x, int y, int size, const uint64_t *state, size_t stride,
                             int cell)
{
  Square     square = { state, stride, celd_pixel_graph_right (graph, x, size) - x,
                        celd_pixel_graph_bottom (graph, y, size) - y, cell };
  bool       uniform;
  uint64_t   common = common_state (&square, &uniform);
  CeldStatus status = CELD_OK;

  if (uniform && size >> cell <= 1 && !(common & CELD_STATE_FIXED) && !(common >> CELD_STATE_SEED))
    return celd_pixel_graph_add_whole (graph, x, y, size, common);
  if (!(common & CELD_STATE_FIXED))
    join_pixels (&square, graph->parent);
  for (int v = 0, k = 0; v < square.h; v++)
    for (int u = 0; u < square.w && status == CELD_OK; u++, k++)
      {
        uint64_t  own = state[(size_t) v * stride + (size_t) u];
        uint32_t *part = celd_pixel_graph_part (graph, x + u, y + v), root;

        if (own & CELD_STATE_FIXED)
          {
            *part = CELD_PART_FIXED | (uint32_t) (own & CELD_STATE_VALUE);
            continue;
          }
        root  = celd_root (graph->parent, (uint32_t) k);
        *part = (uint32_t) graph->n;
        if (root == (uint32_t) k)
          status = add_node (graph, x, y, size, false, own);
        else
          *part = *celd_pixel_graph_part (graph, x + (int) root % square.w, y + (int) root / square.w);
        if (own >> CELD_STATE_SEED && status == CELD_OK)
          status = add_data_cost (graph, *part, (uint32_t) (own >> CELD_STATE_SEED), graph->task->soft_cost);
      }
  return status;
}

/* ------------------------------------------------------------------ links */

/* V_pq between (x,y) of part a and the pixel below (south) or to the right, of part b. */
static int32_t
edge_cost (const CeldPixelGraph *graph, uint32_t a, uint32_t b, int x, int y, bool south)
{
  const CeldPlane *ink = graph->task->ink;
  float            here = CELD_AT (ink, x, y), there = CELD_AT (ink, x + !south, y + south);
  bool             frame = south ? x == 0 || x + 1 == ink->width : y == 0 || y + 1 == ink->height;
  int32_t          to_paper = 0;

  if (!celd_is_paper (here) && !celd_is_paper (there))
    {
      to_paper = graph->to_paper ? graph->to_paper (graph, a, b) : MEASURED;
      if (to_paper < 0 && graph->distance)
        {
          size_t p = (size_t) y * (size_t) ink->width + (size_t) x, q = p + (south ? (size_t) ink->width : 1);

          to_paper = graph->distance[p] < graph->distance[q] ? graph->distance[p] : graph->distance[q];
        }
      else if (to_paper < 0)
        {
          to_paper = celd_squared_to_paper (ink, x, y, -to_paper);
          to_paper = celd_squared_to_paper (ink, x + !south, y + south, to_paper);
        }
    }
  return celd_smoothness_cost (&graph->task->basins->costs, here, there, to_paper, to_paper, frame);
}

/* Adds the edge between (x,y) and the pixel below (south) or to the right: to a link, or to a data cost if one of them
 * is fixed.  `part` is that of (x,y). */
static inline CeldStatus
add_edge (CeldPixelGraph *graph, const uint32_t *part, int x, int y, bool south)
{
  uint32_t  a = part[0], b = part[south ? graph->box.width : 1];
  uint32_t  least = a < b ? a : b, most = a < b ? b : a; /* a fixed part is larger than all nodes */
  CeldLink *last = graph->n_links ? &graph->link[graph->n_links - 1] : NULL;
  int32_t   cost;

  if (a == b || least & CELD_PART_FIXED || most == CELD_PART_FIXED)
    return CELD_OK;
  cost = edge_cost (graph, a, b, x, y, south);
  if (most & CELD_PART_FIXED)
    return add_data_cost (graph, least, most & ~CELD_PART_FIXED, cost);
  if (last && last->a == least && last->b == most)
    {
      last->cost += cost;
      return CELD_OK;
    }
  return celd_append (graph->link, graph->n_links, graph->link_capacity, (CeldLink) { least, most, cost });
}

/* Adds all edges inside the square of a node, and those that leave it: between two nodes from the square on the left or
 * above, between a node and a fixed pixel from the square of the node. */
static CeldStatus
link_square (CeldPixelGraph *graph, const CeldPixelNode *node)
{
  int        left = node->x, right = celd_pixel_graph_right (graph, left, node->size);
  int        top = node->y, bottom = celd_pixel_graph_bottom (graph, top, node->size);
  int        last_x = graph->box.x + graph->box.width - 1, last_y = graph->box.y + graph->box.height - 1;
  CeldStatus status = CELD_OK;

  for (int y = top > graph->box.y ? top - 1 : top; y < bottom; y++)
    {
      const uint32_t *part = celd_pixel_graph_part (graph, left, y);

      if (left > graph->box.x && y >= top && part[-1] & CELD_PART_FIXED)
        status = add_edge (graph, part - 1, left - 1, y, false);
      for (int x = left; x < right && status == CELD_OK; x++, part++)
        {
          bool fixed = *part & CELD_PART_FIXED;

          if (node->whole && x == left && y >= top && y + 1 < bottom)
            {
              part += right - 1 - x; /* no edges inside */
              x = right - 1;
            }
          if (y >= top && x < last_x && (x + 1 < right || !fixed))
            status = add_edge (graph, part, x, y, false);
          if (y < last_y && (y < top ? fixed : y + 1 < bottom || !fixed) && status == CELD_OK)
            status = add_edge (graph, part, x, y, true);
        }
    }
  return status;
}

/* Sums up the links of the same two nodes, sorted by the lesser node; no node has many. */
static CeldStatus
sum_links (CeldPixelGraph *graph)
{
  size_t   *first = celd_alloc0 (graph->n + 1, sizeof *first);
  CeldLink *sorted = celd_alloc (graph->n_links, sizeof *sorted);
  size_t    begin = 0, n = 0;

  if (!first || !sorted)
    {
      celd_free (first);
      celd_free (sorted);
      return CELD_NO_MEMORY;
    }
  for (size_t i = 0; i < graph->n_links; i++)
    first[graph->link[i].a + 1]++;
  for (size_t k = 1; k <= graph->n; k++)
    first[k] += first[k - 1];
  for (size_t i = 0; i < graph->n_links; i++)
    sorted[first[graph->link[i].a]++] = graph->link[i];
  for (size_t i = 0; i < graph->n_links; i++)
    {
      size_t j;

      if (i && sorted[i].a != sorted[i - 1].a)
        begin = n;
      for (j = begin; j < n && graph->link[j].b != sorted[i].b; j++)
        ;
      if (j == n)
        graph->link[n++] = sorted[i];
      else
        graph->link[j].cost += sorted[i].cost;
    }
  graph->n_links = n;
  celd_free (first);
  celd_free (sorted);
  return CELD_OK;
}

CeldStatus
celd_pixel_graph_connect (CeldPixelGraph *graph)
{
  CeldStatus status = CELD_OK;

  for (size_t k = 0; k < graph->n && status == CELD_OK; k++)
    if (!k || graph->node[k].x != graph->node[k - 1].x || graph->node[k].y != graph->node[k - 1].y)
      status = link_square (graph, &graph->node[k]);
  return status == CELD_OK ? sum_links (graph) : status;
}
