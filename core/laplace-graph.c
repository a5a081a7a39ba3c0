/* The graphs of the Laplacian solver: component-split quadtree aggregation.
 *
 * A node of level l is one strongly connected component of pixels inside one cell of 2^l x 2^l pixels: no wall, however
 * thin, is averaged over.  A node whose links are all weak beside those of its strongest neighbour hangs on that
 * neighbour's aggregate as a leaf and joins nothing else.  Prolongation is constant on aggregates, so that coarse
 * weights are plain sums, never differences.  Nodes without an edge have no coarser node: relaxation solves them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "laplace.h"
#include "unions.h"

#define STRONG      0.5f /* of the strongest link of either end: a strong link */
#define FEWER       0.45 /* share of nodes that a new level may keep at most */
#define WHOLE       15   /* doublings after which every cell is the whole picture: 2^15 > CELD_MAX_SIDE */

static uint32_t
cells (const CeldWeights *g)
{
  return (uint32_t) g->width * (uint32_t) g->height;
}

void
celd_weights_clear (CeldWeights *g)
{
  celd_free (g->east);
  celd_free (g->south);
  celd_free (g->sink);
  celd_free (g->cell);
  celd_free (g->start);
  celd_free (g->neighbour);
  celd_free (g->weight);
  *g = (CeldWeights) { 0 };
}

/* ------------------------------------------------------------------ aggregation */

/* What aggregation knows of the nodes. */
typedef struct
{
  const CeldWeights *graph;
  int              doublings;
  float            strong;
  float            most;        /* weight of the strongest link of all */
  float           *best;        /* weight of the strongest link */
  uint32_t        *link;        /* the node at its other end */
  uint32_t        *parent;
} Aggregation;

static inline void
see_edge (Aggregation *a, uint32_t i, uint32_t j, float w)
{
  if (w > a->best[i])
    {
      a->best[i] = w;
      a->link[i] = j;
    }
  if (w > a->best[j])
    {
      a->best[j] = w;
      a->link[j] = i;
    }
}

/* Are all links of node i weak beside those of its strongest neighbour? */
static inline bool
is_leaf (const Aggregation *a, uint32_t i)
{
  return a->best[i] < a->strong * a->best[a->link[i]];
}

static inline void
join_edge (Aggregation *a, uint32_t i, uint32_t j, float w)
{
  bool leaf_i, leaf_j;

  if (!(w > 0))
    return;
  if (w >= a->strong * a->most) /* strong for whomever */
    {
      celd_join (a->parent, i, j);
      return;
    }
  leaf_i = is_leaf (a, i);
  leaf_j = is_leaf (a, j);
  if (leaf_i || leaf_j ? (leaf_i && a->link[i] == j) || (leaf_j && a->link[j] == i)
                       : w >= a->strong * a->best[i] && w >= a->strong * a->best[j])
    celd_join (a->parent, i, j);
}

/* The strongest of the four edges of each first node of a row; `north` is NULL above the first row.  The edges that
 * lead out of the grid have weight 0. */
CELD_CLONES static void
see_row (uint32_t first, uint32_t w, const float *north, const float *south, const float *east, float *best,
         uint32_t *link)
{
  for (uint32_t x = 0; x < w; x++)
    {
      float    up = north ? north[x] : 0, left = x ? east[x - 1] : 0, most = east[x];
      uint32_t i = first + x, j = i + 1;

      j    = south[x] > most ? i + w : j;
      most = south[x] > most ? south[x] : most;
      j    = left > most ? i - 1 : j;
      most = left > most ? left : most;
      j    = up > most ? i - w : j;
      most = up > most ? up : most;
      best[x] = most;
      link[x] = j;
    }
}

static void
see_edges (Aggregation *a)
{
  const CeldWeights *g = a->graph;
  uint32_t           w = (uint32_t) g->width, n = cells (g);

  for (uint32_t i = 0; i < n; i += w)
    see_row (i, w, i ? g->south + i - w : NULL, g->south + i, g->east + i, a->best + i, a->link + i);
  for (uint32_t k = 0; k < g->n_extra; k++)
    for (uint32_t e = g->start[k]; e < g->start[k + 1]; e++)
      see_edge (a, n + k, g->neighbour[e], g->weight[e]);
  for (uint32_t i = 0; i < n + g->n_extra; i++)
    a->most = a->best[i] > a->most ? a->best[i] : a->most;
}

static void
join_edges (Aggregation *a)
{
  const CeldWeights *g = a->graph;
  uint32_t         w = (uint32_t) g->width, n = cells (g), i = 0, side = 1u << a->doublings;

  for (uint32_t y = 0; y < (uint32_t) g->height; y++)
    for (uint32_t x = 0; x < w; x++, i++)
      {
        if ((x + 1) % side && x + 1 < w)
          join_edge (a, i, i + 1, g->east[i]);
        if ((y + 1) % side && i + w < n)
          join_edge (a, i, i + w, g->south[i]);
      }
  for (uint32_t k = 0; k < g->n_extra; k++)
    for (uint32_t e = g->start[k]; e < g->start[k + 1]; e++)
      {
        uint32_t j = g->neighbour[e], c = g->cell[k], d = j < n ? j : g->cell[j - n];

        if (c % w >> a->doublings == d % w >> a->doublings && c / w >> a->doublings == d / w >> a->doublings)
          join_edge (a, n + k, j, g->weight[e]);
      }
}

/* The coarse cell in which a cell lies. */
static uint32_t
cell_above (const CeldWeights *g, uint32_t cell, int doublings, const CeldWeights *coarse)
{
  uint32_t w = (uint32_t) g->width;

  return (cell / w >> doublings) * (uint32_t) coarse->width + (cell % w >> doublings);
}

/* Numbers the aggregate of node i, which lies in a coarse cell; *count is the next number of an extra one. */
static inline void
number_node (Aggregation *a, uint32_t i, uint32_t cell, uint8_t *taken, uint32_t *count)
{
  uint32_t root = celd_root (a->parent, i);

  if (!(a->best[i] > 0))
    a->link[i] = CELD_NO_NODE;
  else if (root != i)
    a->link[i] = a->link[root]; /* a root comes before its members */
  else if (!taken[cell])
    {
      taken[cell] = 1;
      a->link[i]  = cell;
    }
  else
    a->link[i] = (*count)++;
}

/* Turns a->link into the number of each node's aggregate: the first one of a coarse cell takes the number of the cell,
 * others follow behind the cells.  Fills in the size of `coarse`. */
static CeldStatus
number_aggregates (Aggregation *a, CeldWeights *coarse)
{
  const CeldWeights *g = a->graph;
  uint32_t         n = cells (g), w = (uint32_t) g->width, count = cells (coarse);
  uint8_t         *taken = celd_alloc0 (count, 1);

  if (!taken)
    return CELD_NO_MEMORY;
  for (uint32_t y = 0, i = 0; y < (uint32_t) g->height; y++)
    for (uint32_t x = 0; x < w; x++, i++)
      number_node (a, i, (y >> a->doublings) * (uint32_t) coarse->width + (x >> a->doublings), taken, &count);
  for (uint32_t k = 0; k < g->n_extra; k++)
    number_node (a, n + k, cell_above (g, g->cell[k], a->doublings, coarse), taken, &count);
  coarse->n_extra = count - cells (coarse);
  celd_free (taken);
  return CELD_OK;
}

/* ------------------------------------------------------------------ the coarse graph */

/* An edge from an extra node. */
typedef struct { uint32_t from, to; float weight; } Edge;

typedef struct
{
  CeldWeights *coarse;
  Edge      *edge;
  size_t     n;
} Contraction;

static CeldStatus
push_edge (Contraction *c, uint32_t from, uint32_t to, float w)
{
  Edge *edge = celd_grow (c->edge, c->n + 1, sizeof *edge);

  if (!edge)
    return CELD_NO_MEMORY;
  c->edge         = edge;
  c->edge[c->n++] = (Edge) { from, to, w };
  return CELD_OK;
}

/* The edge of weight w between what have become nodes i and j. */
static inline CeldStatus
add_edge (Contraction *c, uint32_t i, uint32_t j, float w)
{
  CeldWeights *g = c->coarse;
  uint32_t   n = cells (g), low = i < j ? i : j, high = i < j ? j : i;
  CeldStatus status = CELD_OK;

  if (i == j || !(w > 0))
    return CELD_OK;
  if (high < n)
    {
      if (high == low + 1 && g->width > 1)
        g->east[low] += w;
      else
        g->south[low] += w;
      return CELD_OK;
    }
  if (i >= n)
    status = push_edge (c, i - n, j, w);
  if (j >= n && status == CELD_OK)
    status = push_edge (c, j - n, i, w);
  return status;
}

static CeldStatus
add_edges (const CeldWeights *fine, const uint32_t *coarser, Contraction *c)
{
  uint32_t   w = (uint32_t) fine->width, n = cells (fine), i = 0;
  CeldStatus status = CELD_OK;

  for (int y = 0; y < fine->height && status == CELD_OK; y++)
    for (uint32_t x = 0; x < w && status == CELD_OK; x++, i++)
      {
        if (x + 1 < w)
          status = add_edge (c, coarser[i], coarser[i + 1], fine->east[i]);
        if (i + w < n && status == CELD_OK)
          status = add_edge (c, coarser[i], coarser[i + w], fine->south[i]);
      }
  for (uint32_t k = 0; k < fine->n_extra; k++)
    for (uint32_t e = fine->start[k]; e < fine->start[k + 1] && status == CELD_OK; e++)
      if (fine->neighbour[e] < n + k) /* each edge once */
        status = add_edge (c, coarser[n + k], coarser[fine->neighbour[e]], fine->weight[e]);
  return status;
}

/* Sorts the edges of extra nodes by their node, equal ones summed up.  place: workspace, one for each coarse node. */
static CeldStatus
list_edges (const Contraction *c, uint32_t *place)
{
  CeldWeights *g = c->coarse;
  uint32_t   kept = 0, from = 0;

  g->start     = celd_alloc0 ((size_t) g->n_extra + 2, sizeof *g->start);
  g->neighbour = celd_alloc (c->n, sizeof *g->neighbour);
  g->weight    = celd_alloc (c->n, sizeof *g->weight);
  if (!g->start || !g->neighbour || !g->weight)
    return CELD_NO_MEMORY;
  for (size_t e = 0; e < c->n; e++)
    g->start[c->edge[e].from + 2]++;
  for (uint32_t k = 0; k < g->n_extra; k++)
    g->start[k + 2] += g->start[k + 1];
  for (size_t e = 0; e < c->n; e++)
    {
      uint32_t at = g->start[c->edge[e].from + 1]++;

      g->neighbour[at] = c->edge[e].to;
      g->weight[at]    = c->edge[e].weight;
    }
  for (uint32_t i = 0; i < cells (g) + g->n_extra; i++)
    place[i] = CELD_NO_NODE;
  for (uint32_t k = 0; k < g->n_extra; k++)
    {
      uint32_t end = g->start[k + 1], first = kept;

      for (uint32_t e = from; e < end; e++)
        {
          uint32_t *at = &place[g->neighbour[e]];

          if (*at == CELD_NO_NODE || *at < first)
            {
              *at = kept;
              g->neighbour[kept] = g->neighbour[e];
              g->weight[kept++]  = g->weight[e];
            }
          else
            g->weight[*at] += g->weight[e];
        }
      from = end;
      g->start[k + 1] = kept;
    }
  return CELD_OK;
}

/* Nodes, edges and sinks of the coarse graph, whose size is known. */
static CeldStatus
contract (const CeldWeights *fine, const uint32_t *coarser, int doublings, CeldWeights *coarse)
{
  uint32_t    n = cells (coarse), fine_n = cells (fine);
  uint32_t   *place = celd_alloc ((size_t) n + coarse->n_extra, sizeof *place);
  Contraction c = { .coarse = coarse };
  CeldStatus  status = CELD_NO_MEMORY;

  coarse->east  = celd_alloc0 (n, sizeof *coarse->east);
  coarse->south = celd_alloc0 (n, sizeof *coarse->south);
  coarse->sink  = celd_alloc0 ((size_t) n + coarse->n_extra, sizeof *coarse->sink);
  coarse->cell  = celd_alloc (coarse->n_extra, sizeof *coarse->cell);
  if (place && coarse->east && coarse->south && coarse->sink && coarse->cell)
    status = add_edges (fine, coarser, &c);
  if (status == CELD_OK)
    status = list_edges (&c, place);
  for (uint32_t i = 0; i < fine_n + fine->n_extra && status == CELD_OK; i++)
    if (coarser[i] != CELD_NO_NODE)
      {
        coarse->sink[coarser[i]] += fine->sink[i];
        if (coarser[i] >= n)
          coarse->cell[coarser[i] - n] = cell_above (fine, i < fine_n ? i : fine->cell[i - fine_n], doublings, coarse);
      }
  celd_free (place);
  celd_free (c.edge);
  return status;
}

/* ------------------------------------------------------------------ coarsening */

static int
halved (int size, int doublings)
{
  return (int) (((uint32_t) size + (1u << doublings) - 1) >> doublings);
}

/* Nodes that have an edge. */
static uint32_t
count_linked (const Aggregation *a, uint32_t n)
{
  uint32_t count = 0;

  for (uint32_t i = 0; i < n; i++)
    count += a->best[i] > 0;
  return count;
}

/* Aggregates with edges among them; their number is known by the roots. */
static uint32_t
aggregate (Aggregation *a, uint32_t n)
{
  uint32_t count = 0;

  for (uint32_t i = 0; i < n; i++)
    a->parent[i] = i;
  join_edges (a);
  for (uint32_t i = 0; i < n; i++)
    count += a->parent[i] == i && a->best[i] > 0;
  return count;
}

CeldStatus
celd_weights_coarsen (const CeldWeights *fine, int *doubled, CeldWeights *coarse, uint32_t **coarser)
{
  uint32_t    n = cells (fine) + fine->n_extra;
  Aggregation a = {
    .graph = fine, .doublings = 1, .strong = STRONG,
    .best = celd_alloc0 (n, sizeof *a.best),
    .link = celd_alloc0 (n, sizeof *a.link),
    .parent = celd_alloc (n, sizeof *a.parent),
  };
  CeldStatus  status = a.best && a.link && a.parent ? CELD_OK : CELD_NO_MEMORY;
  double      most = 0;

  *coarse = (CeldWeights) { 0 };
  if (status != CELD_OK)
    goto done;
  see_edges (&a);
  most = FEWER * count_linked (&a, n);
  while (aggregate (&a, n) > most)
    if (*doubled + a.doublings < WHOLE)
      a.doublings++;
    else if (a.strong > 0)
      a.strong = a.strong > 1e-9f ? 0.1f * a.strong : 0;
    else
      break;
  *doubled += a.doublings;
  if (*doubled > WHOLE)
    *doubled = WHOLE;
  coarse->width  = halved (fine->width, a.doublings);
  coarse->height = halved (fine->height, a.doublings);
  status         = number_aggregates (&a, coarse);
  if (status == CELD_OK)
    status = contract (fine, a.link, a.doublings, coarse);

done:
  if (status == CELD_OK)
    *coarser = a.link;
  else
    {
      celd_free (a.link);
      celd_weights_clear (coarse);
    }
  celd_free (a.best);
  celd_free (a.parent);
  return status;
}
