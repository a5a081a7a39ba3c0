/* Set-up of the multigrid hierarchy of the Laplacian solver: graphs are coarsened until few nodes are left, and each is
 * laid out for red-black Gauss-Seidel.
 *
 * Nearly all nodes are grid nodes, so that relaxation is plain loops over rows; extra nodes, along walls, are few.
 *
 * Cost: O(pixels).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "solve/laplace-private.h"

#define COARSEST 60 /* nodes of the level that is eliminated at most; chosen */
#define UNIT     8  /* numbers in a vector register: places in a row are a multiple, and as many are empty */

static void
level_clear (CeldGridLevel *level)
{
  void *part[] = { level->row, level->near, level->far, level->north, level->south, level->diagonal, level->inverse, level->coarser,
                   level->start, level->middle, level->neighbour, level->weight, level->link_row,
                   level->link_first, level->link_extra, level->link_weight };

  for (size_t i = 0; i < sizeof part / sizeof *part; i++)
    celd_free (part[i]);
  *level = (CeldGridLevel) { 0 };
}

void
celd_hierarchy_clear (CeldHierarchy *hierarchy)
{
  for (int l = 0; l < hierarchy->n; l++)
    level_clear (&hierarchy->level[l]);
  celd_band_clear (&hierarchy->coarsest);
  celd_free (hierarchy->coarsest_node);
  *hierarchy = (CeldHierarchy) { 0 };
}

/* ------------------------------------------------------------------ one level */

/* A level of the graph's size, still without arrays. */
static CeldGridLevel
level_shape (const CeldWeightedGraph *g)
{
  CeldGridLevel level = { .width = g->width, .height = g->height, .half = (g->width + 1) / 2, .n_extra = g->n_extra };

  level.stride = (size_t) (level.half + UNIT - 1) / UNIT * UNIT + UNIT;
  level.plane  = level.stride * (size_t) (level.height + 2) + UNIT;
  level.n      = (uint32_t) (2 * level.plane) + level.n_extra;
  return level;
}

static CeldStatus
level_new (const CeldWeightedGraph *g, CeldGridLevel *level)
{
  *level         = level_shape (g);
  level->row     = celd_alloc ((size_t) level->height, sizeof *level->row);
  level->near    = celd_alloc0 (level->plane, sizeof *level->near);
  level->far     = celd_alloc0 (level->plane, sizeof *level->far);
  level->north   = celd_alloc0 (level->plane, sizeof *level->north);
  level->south   = celd_alloc0 (level->plane, sizeof *level->south);
  level->diagonal    = celd_alloc0 (level->n, sizeof *level->diagonal);
  level->inverse = celd_alloc0 (level->n, sizeof *level->inverse);
  return level->row && level->near && level->far && level->north && level->south && level->diagonal && level->inverse
           ? CELD_OK : CELD_NO_MEMORY;
}

/* What the rows of a layout need. */
typedef struct
{
  const CeldWeightedGraph *graph;
  const uint32_t          *coarser;   /* of each node of the graph */
  const CeldGridLevel     *next;
  CeldGridLevel           *level;
  int                      doublings; /* to the next level */
  bool                     pixels;
  uint32_t                *count;     /* of each row */
} Layout;

/* Nodes x = odd, odd + 2, ... of a row go to places 1, 2, ...: those whose sums they get in `inverse`. */
CELD_CLONES static void
lay_out_places (size_t w, size_t odd, const float *east, const float *south, const float *above, const float *diagonal,
                float *inverse, float *held, float *to_east, float *to_west, float *to_south, float *to_north)
{
  for (size_t x = odd, at = 0; x < w; x += 2, at++)
    {
      float right = east[x], left = x ? east[x - 1] : 0, down = south[x], up = above ? above[x] : 0;

      held[at]    = diagonal[x];
      inverse[at] = (up + left) + (right + down);
      if (!to_east)
        continue;
      to_east[at]  = right;
      to_west[at]  = left;
      to_south[at] = down;
      to_north[at] = up;
    }
}

/* The edges between grid nodes, and their sum at each node in `inverse`. */
static void
lay_out_row (void *data, int y)
{
  const Layout            *o = data;
  const CeldWeightedGraph *g = o->graph;
  CeldGridLevel           *level = o->level;
  size_t                   w = (size_t) g->width, i = (size_t) y * w, odd = y & 1;
  size_t                   at = (size_t) (y + 1) * level->stride + 1;
  const float             *above = y ? g->south + i - w : NULL;

  lay_out_places (w, odd, g->east + i, g->south + i, above, g->diagonal + i, level->inverse + at, level->diagonal + at,
                  (odd ? level->far : level->near) + at, (odd ? level->near : level->far) + at, level->south + at,
                  level->north + at);
  lay_out_places (w, !odd, g->east + i, g->south + i, above, g->diagonal + i, level->inverse + level->plane + at,
                  level->diagonal + level->plane + at, NULL, NULL, NULL, NULL);
}

/* Sorts the edges of an extra node k: those to extra nodes after it go to the end. */
static void
part_neighbours (CeldGridLevel *level, uint32_t k)
{
  uint32_t middle = level->start[k], self = (uint32_t) (2 * level->plane) + k;

  for (uint32_t e = level->start[k]; e < level->start[k + 1]; e++)
    if (level->neighbour[e] < self)
      {
        uint32_t j = level->neighbour[e];
        float    w = level->weight[e];

        level->neighbour[e]      = level->neighbour[middle];
        level->weight[e]         = level->weight[middle];
        level->neighbour[middle] = j;
        level->weight[middle++]  = w;
      }
  level->middle[k] = middle;
}

/* Lists the edges between grid and extra nodes in the order of the grid nodes. */
static CeldStatus
list_links (CeldGridLevel *level)
{
  uint32_t  first = (uint32_t) (2 * level->plane), rows = 2 * (uint32_t) level->height;
  uint32_t *begin = celd_alloc0 ((size_t) first + 1, sizeof *begin);

  level->link_row    = celd_alloc ((size_t) rows + 1, sizeof *level->link_row);
  level->link_first  = celd_alloc (level->links, sizeof *level->link_first);
  level->link_extra  = celd_alloc (level->links, sizeof *level->link_extra);
  level->link_weight = celd_alloc (level->links, sizeof *level->link_weight);
  if (!begin || !level->link_row || !level->link_first || !level->link_extra || !level->link_weight)
    {
      celd_free (begin);
      return CELD_NO_MEMORY;
    }
  for (uint32_t e = 0; e < level->start[level->n_extra]; e++)
    if (level->neighbour[e] < first)
      begin[level->neighbour[e] + 1]++;
  for (uint32_t i = 0; i < first; i++)
    begin[i + 1] += begin[i];
  for (uint32_t row = 0; row <= rows; row++) /* a row begins after those above it, an empty one among them */
    {
      size_t colour = row < (uint32_t) level->height ? 0 : 1, y = row - colour * (size_t) level->height;

      level->link_row[row] = begin[colour * level->plane + (y + 1) * level->stride];
    }
  for (uint32_t k = 0; k < level->n_extra; k++)
    for (uint32_t e = level->start[k]; e < level->start[k + 1]; e++)
      {
        uint32_t i = level->neighbour[e], at;

        if (i >= first)
          continue;
        at = begin[i]++;
        level->inverse[i] += level->weight[e];
        level->link_first[at]  = i;
        level->link_extra[at]  = first + k;
        level->link_weight[at] = level->weight[e];
      }
  celd_free (begin);
  return CELD_OK;
}

static void *
copy (const void *items, size_t n, size_t size)
{
  void *result = celd_alloc (n, size);

  if (result && n)
    memcpy (result, items, n * size);
  return result;
}

static CeldStatus
lay_out_extra (const CeldWeightedGraph *g, CeldGridLevel *level)
{
  uint32_t first = (uint32_t) (2 * level->plane), edges;

  if (!g->n_extra)
    return CELD_OK;
  edges            = g->start[g->n_extra];
  level->start     = copy (g->start, (size_t) g->n_extra + 1, sizeof *g->start);
  level->neighbour = copy (g->neighbour, edges, sizeof *g->neighbour);
  level->weight    = copy (g->weight, edges, sizeof *g->weight);
  level->middle    = celd_alloc (g->n_extra, sizeof *level->middle);
  if (!level->start || !level->neighbour || !level->weight || !level->middle)
    return CELD_NO_MEMORY;
  for (uint32_t e = 0; e < edges; e++)
    {
      level->neighbour[e] = celd_node_place (level, level->neighbour[e]);
      level->red_links += level->neighbour[e] < level->plane;
      level->links += level->neighbour[e] < first;
    }
  for (uint32_t k = 0; k < g->n_extra; k++)
    {
      level->diagonal[first + k] = g->diagonal[(size_t) g->width * (size_t) g->height + k];
      for (uint32_t e = level->start[k]; e < level->start[k + 1]; e++)
        level->inverse[first + k] += level->weight[e];
      part_neighbours (level, k);
    }
  return list_links (level);
}

/* Sums of edges become inverse diagonals; returns how many nodes have an edge. */
CELD_CLONES static uint32_t
invert (size_t n, const float *diagonal, float *inverse)
{
  uint32_t linked = 0;

  for (size_t i = 0; i < n; i++)
    {
      float full = inverse[i] + diagonal[i];

      linked    += inverse[i] > 0;
      inverse[i] = full > 0 ? 1 / full : 0;
    }
  return linked;
}

/* The span of a row, from its first node with an edge or a diagonal to its last one. */
static CeldPlaceSpan
span_of_row (const CeldGridLevel *level, int y)
{
  size_t       start = (size_t) (y + 1) * level->stride + 1, first = start, end = start + (size_t) level->half;
  const float *red = level->inverse, *black = red + level->plane;

  while (end > start && !(red[end - 1] > 0) && !(black[end - 1] > 0))
    end--;
  while (first < end && !(red[first] > 0) && !(black[first] > 0))
    first++;
  return (CeldPlaceSpan) { first - (first - start) % UNIT, end };
}

static void
invert_row (void *data, int y)
{
  const Layout  *o = data;
  CeldGridLevel *level = o->level;
  size_t         at = (size_t) (y + 1) * level->stride, black = level->plane + at;

  o->count[y] = invert (level->stride, level->diagonal + at, level->inverse + at) +
                invert (level->stride, level->diagonal + black, level->inverse + black);
  level->row[y] = span_of_row (level, y);
}

/* *linked: nodes that have an edge. */
static CeldStatus
lay_out (const CeldWeightedGraph *g, const CeldHost *host, CeldGridLevel *level, uint32_t *linked)
{
  Layout     o = { .graph = g, .level = level, .count = celd_alloc ((size_t) g->height, sizeof *o.count) };
  CeldStatus status = level_new (g, level);

  if (!o.count)
    status = CELD_NO_MEMORY;
  if (status == CELD_OK)
    {
      celd_parallel_for (host, g->height, lay_out_row, &o);
      status = lay_out_extra (g, level);
    }
  if (status == CELD_OK)
    {
      celd_parallel_for (host, g->height, invert_row, &o);
      *linked = invert (level->n_extra, level->diagonal + 2 * level->plane, level->inverse + 2 * level->plane);
      for (int y = 0; y < g->height; y++)
        *linked += o.count[y];
    }
  celd_free (o.count);
  return status;
}

/* The aggregates of the grid nodes of a row; on the finest level of the red ones only. */
static void
lay_out_coarser_row (void *data, int y)
{
  const Layout        *o = data;
  const CeldGridLevel *next = o->next;
  uint32_t             w = (uint32_t) o->graph->width, cells = (uint32_t) next->width * (uint32_t) next->height;
  uint32_t             first = (uint32_t) (y >> o->doublings) * (uint32_t) next->width;
  const uint32_t      *coarser = o->coarser + (size_t) y * w;

  for (uint32_t x = o->pixels ? y & 1 : 0; x < w; x += o->pixels ? 2 : 1)
    {
      uint32_t to = coarser[x] == CELD_NO_NODE ? 0
                    : coarser[x] < cells ? celd_grid_place (next, (int) (coarser[x] - first), y >> o->doublings)
                                         : (uint32_t) (2 * next->plane) + coarser[x] - cells;

      o->level->coarser[celd_grid_place (o->level, (int) x, y)] = to;
    }
}

static CeldStatus
lay_out_coarser (const CeldWeightedGraph *g, const uint32_t *coarser, int doublings, const CeldHost *host,
                 const CeldGridLevel *next, CeldGridLevel *level)
{
  uint32_t n = (uint32_t) g->width * (uint32_t) g->height;
  bool     pixels = !g->row_extra;
  Layout   o = {
    .graph = g, .level = level, .coarser = coarser, .next = next, .doublings = doublings, .pixels = pixels
  };

  if (!(level->coarser = celd_alloc0 (pixels ? level->plane : level->n, sizeof *level->coarser)))
    return CELD_NO_MEMORY;
  celd_parallel_for (host, g->height, lay_out_coarser_row, &o);
  for (uint32_t k = 0; k < g->n_extra; k++)
    level->coarser[2 * level->plane + k] = celd_node_place (next, coarser[n + k]);
  return CELD_OK;
}

/* ------------------------------------------------------------------ all levels */

/* The next coarser graph takes the place of `graph`, whose layout gets its aggregates. */
static CeldStatus
coarsen (CeldWeightedGraph *graph, const CeldHost *host, CeldGridLevel *level)
{
  CeldWeightedGraph coarse;
  CeldGridLevel     next;
  uint32_t         *coarser = NULL;
  CeldStatus        status  = celd_coarsen (graph, host, &coarse, &coarser);

  if (status != CELD_OK)
    return status;
  next   = level_shape (&coarse);
  status = lay_out_coarser (graph, coarser, coarse.doublings, host, &next, level);
  celd_free (coarser);
  celd_weighted_graph_clear (graph);
  *graph = coarse;
  return status;
}

CeldStatus
celd_hierarchy_new (CeldWeightedGraph *graph, const CeldHost *host, CeldHierarchy *hierarchy)
{
  bool       last = false;
  double     left = 1;          /* each level is about half of what is left */
  uint32_t   linked;
  CeldStatus status = CELD_OK;

  *hierarchy = (CeldHierarchy) { 0 };
  while (status == CELD_OK && !last)
    {
      CeldGridLevel *level = &hierarchy->level[hierarchy->n++];

      status = celd_progress (host, 1 - left);
      left  /= 2;
      if (status == CELD_OK)
        status = lay_out (graph, host, level, &linked);
      if (status != CELD_OK)
        break;
      last   = hierarchy->n == CELD_MAX_LEVELS || (hierarchy->n > 1 && linked <= COARSEST);
      status = last ? celd_eliminate_coarsest (graph, level, &hierarchy->coarsest, &hierarchy->coarsest_node)
                    : coarsen (graph, host, level);
    }
  if (status != CELD_OK)
    celd_hierarchy_clear (hierarchy);
  return status;
}
