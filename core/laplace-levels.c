/* The coarse levels of the Laplacian solver: component-split quadtree aggregation.
 *
 * A node of level l is one strongly connected component of pixels inside one cell of 2^l x 2^l pixels: no wall, however
 * thin, is averaged over.  A node whose links are all weak beside those of its strongest neighbour hangs on that
 * neighbour's aggregate as a leaf and joins nothing else.  Prolongation is constant on aggregates, so that coarse
 * weights are plain sums, never differences.  Nodes without an edge have no coarser node: relaxation solves them.
 *
 * Cost: O(pixels); about 25 bytes a pixel.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "laplace.h"
#include "unions.h"

#include <string.h>

#define STRONG      0.5f /* of the strongest link of either end: a strong link */
#define BOTTOM      150  /* nodes that are eliminated directly */
#define FEWER       0.6  /* share of nodes that a new level may keep at most */
#define WHOLE       15   /* doublings after which every cell is the whole picture: 2^15 > CELD_MAX_SIDE */

/* ------------------------------------------------------------------ the graph of a level */

static void
level_clear (CeldLevel *level)
{
  void *part[] = { level->start, level->neighbour, level->middle, level->weight, level->sink, level->inverse,
                   level->coarser, level->cell, level->b, level->x, level->step, level->image, level->image2 };

  for (size_t i = 0; i < sizeof part / sizeof *part; i++)
    celd_free (part[i]);
  *level = (CeldLevel) { 0 };
}

/* What every level has before its edges are known. */
static CeldStatus
level_new (uint32_t n, CeldLevel *level)
{
  *level = (CeldLevel) {
    .n       = n,
    .start   = celd_alloc0 ((size_t) n + 1, sizeof (uint32_t)),
    .sink    = celd_alloc0 (n, sizeof (float)),
    .coarser = celd_alloc (n, sizeof (uint32_t)),
    .cell    = celd_alloc (2 * (size_t) n, sizeof (uint16_t)),
  };
  return level->start && level->sink && level->coarser && level->cell ? CELD_OK : CELD_NO_MEMORY;
}

static CeldStatus
level_edges (CeldLevel *level, uint32_t edges)
{
  level->neighbour = celd_alloc (edges, sizeof (uint32_t));
  level->weight    = celd_alloc (edges, sizeof (float));
  return level->neighbour && level->weight ? CELD_OK : CELD_NO_MEMORY;
}

static void
add_edge (CeldLevel *level, uint32_t *at, uint32_t j, float w)
{
  if (w > 0)
    {
      level->neighbour[*at] = j;
      level->weight[*at]    = w;
      (*at)++;
    }
}

/* The pixels as a graph. */
static CeldStatus
pixel_graph (int width, int height, const float *east, const float *south, const float *diagonal, CeldLevel *level)
{
  uint32_t   w = (uint32_t) width, h = (uint32_t) height, edges = 0;
  CeldStatus status = level_new (w * h, level);

  for (uint32_t i = 0; i < w * h; i++)
    edges += (i % w < w - 1 && east[i] > 0 ? 2u : 0u) + (i / w < h - 1 && south[i] > 0 ? 2u : 0u);
  if (status == CELD_OK)
    status = level_edges (level, edges);
  if (status != CELD_OK)
    return status;
  memcpy (level->sink, diagonal, (size_t) w * h * sizeof (float));
  edges = 0;
  for (uint32_t y = 0, i = 0; y < h; y++)
    for (uint32_t x = 0; x < w; x++, i++)
      {
        if (y > 0)
          add_edge (level, &edges, i - w, south[i - w]);
        if (x > 0)
          add_edge (level, &edges, i - 1, east[i - 1]);
        if (x < w - 1)
          add_edge (level, &edges, i + 1, east[i]);
        if (y < h - 1)
          add_edge (level, &edges, i + w, south[i]);
        level->start[i + 1]    = edges;
        level->cell[2 * i]     = (uint16_t) x;
        level->cell[2 * i + 1] = (uint16_t) y;
      }
  return CELD_OK;
}

/* ------------------------------------------------------------------ aggregation */

static bool
same_cell (const CeldLevel *level, uint32_t i, uint32_t j, int doublings)
{
  const uint16_t *c = level->cell;

  return c[2 * i] >> doublings == c[2 * j] >> doublings && c[2 * i + 1] >> doublings == c[2 * j + 1] >> doublings;
}

/* Position of the strongest link of node i, which has at least one. */
static uint32_t
strongest_link (const CeldLevel *level, uint32_t i)
{
  uint32_t best = level->start[i];

  for (uint32_t e = best + 1; e < level->start[i + 1]; e++)
    if (level->weight[e] > level->weight[best])
      best = e;
  return best;
}

/* Are all links of node i weak beside those of its strongest neighbour?  link: the strongest link of each node. */
static bool
is_leaf (const CeldLevel *level, const uint32_t *link, float strong, uint32_t i)
{
  return level->weight[link[i]] < strong * level->weight[link[level->neighbour[link[i]]]];
}

/* Joins node i with those of its neighbours that belong to its aggregate. */
static void
join_node (CeldLevel *level, const uint32_t *link, int doublings, float strong, uint32_t i)
{
  uint32_t *parent = level->coarser;
  uint32_t  best   = level->neighbour[link[i]];
  float     own    = level->weight[link[i]];

  if (is_leaf (level, link, strong, i))
    {
      if (same_cell (level, i, best, doublings))
        celd_join (parent, i, best);
      return;
    }
  for (uint32_t e = level->start[i]; e < level->start[i + 1]; e++)
    {
      uint32_t j = level->neighbour[e];

      if (j > i && same_cell (level, i, j, doublings) && level->weight[e] >= strong * own &&
          level->weight[e] >= strong * level->weight[link[j]] && !is_leaf (level, link, strong, j))
        celd_join (parent, i, j);
    }
}

/* Fills level->coarser with the aggregates inside cells that are 2^doublings times larger; returns their number.
 * link: workspace of n. */
static uint32_t
aggregate (CeldLevel *level, int doublings, float strong, uint32_t *link)
{
  uint32_t *parent = level->coarser, count = 0;

  for (uint32_t i = 0; i < level->n; i++)
    {
      parent[i] = i;
      link[i]   = level->start[i] < level->start[i + 1] ? strongest_link (level, i) : CELD_NO_NODE;
    }
  for (uint32_t i = 0; i < level->n; i++)
    if (link[i] != CELD_NO_NODE)
      join_node (level, link, doublings, strong, i);
  for (uint32_t i = 0; i < level->n; i++) /* numbers go to roots first, which come before their members */
    if (link[i] != CELD_NO_NODE)
      link[i] = parent[i] == i ? count++ : link[celd_root (parent, i)];
  for (uint32_t i = 0; i < level->n; i++)
    parent[i] = link[i];
  return count;
}

/* The nodes of `fine` by aggregate: those of aggregate c are member[first[c]] .. member[first[c+1]-1]. */
static void
list_members (const CeldLevel *fine, uint32_t n, uint32_t *first, uint32_t *member)
{
  memset (first, 0, ((size_t) n + 1) * sizeof *first);
  for (uint32_t i = 0; i < fine->n; i++)
    if (fine->coarser[i] != CELD_NO_NODE)
      first[fine->coarser[i]]++;
  for (uint32_t c = 1; c <= n; c++)
    first[c] += first[c - 1];
  for (uint32_t i = fine->n; i-- > 0;)
    if (fine->coarser[i] != CELD_NO_NODE)
      member[--first[fine->coarser[i]]] = i;
}

/* Adds the edges of one node of `fine` to those of its aggregate c, the last row of `coarse` so far; returns how many
 * edges there are now.  place: see sum_edges. */
static uint32_t
sum_node (const CeldLevel *fine, uint32_t i, uint32_t c, uint32_t edges, uint32_t *place, CeldLevel *coarse)
{
  for (uint32_t e = fine->start[i]; e < fine->start[i + 1]; e++)
    {
      uint32_t d = fine->coarser[fine->neighbour[e]];

      if (d == c)
        continue;
      if (place[d] == CELD_NO_NODE || place[d] < coarse->start[c])
        {
          place[d] = edges++;
          if (coarse->neighbour)
            {
              coarse->neighbour[place[d]] = d;
              coarse->weight[place[d]]    = 0;
            }
        }
      if (coarse->neighbour)
        coarse->weight[place[d]] += fine->weight[e];
    }
  return edges;
}

/* Edges between aggregates: sums of the weights of the edges between their members; returns how many there are.  With
 * coarse->neighbour NULL they are only counted.  place: workspace of n, where the edge to each aggregate stands. */
static uint32_t
sum_edges (const CeldLevel *fine, const uint32_t *first, const uint32_t *member, uint32_t *place, CeldLevel *coarse)
{
  uint32_t edges = 0;

  for (uint32_t c = 0; c < coarse->n; c++)
    place[c] = CELD_NO_NODE;
  for (uint32_t c = 0; c < coarse->n; c++)
    {
      for (uint32_t m = first[c]; m < first[c + 1]; m++)
        edges = sum_node (fine, member[m], c, edges, place, coarse);
      coarse->start[c + 1] = edges;
    }
  return edges;
}

/* The next level from the aggregates of `fine`. */
static CeldStatus
contract (const CeldLevel *fine, uint32_t n, int doublings, CeldLevel *coarse)
{
  uint32_t  *first  = celd_alloc ((size_t) n + 1, sizeof *first);
  uint32_t  *member = celd_alloc (fine->n, sizeof *member);
  uint32_t  *place  = celd_alloc (n, sizeof *place);
  CeldStatus status = first && member && place ? level_new (n, coarse) : CELD_NO_MEMORY;

  if (status == CELD_OK)
    {
      list_members (fine, n, first, member);
      status = level_edges (coarse, sum_edges (fine, first, member, place, coarse));
    }
  if (status == CELD_OK)
    {
      sum_edges (fine, first, member, place, coarse);
      for (uint32_t c = 0; c < n; c++)
        {
          for (uint32_t m = first[c]; m < first[c + 1]; m++)
            coarse->sink[c] += fine->sink[member[m]];
          coarse->cell[2 * c]     = (uint16_t) (fine->cell[2 * member[first[c]]] >> doublings);
          coarse->cell[2 * c + 1] = (uint16_t) (fine->cell[2 * member[first[c]] + 1] >> doublings);
        }
    }
  celd_free (first);
  celd_free (member);
  celd_free (place);
  return status;
}

/* Aggregates `fine` until few enough nodes are left: cells are doubled once, more often where walls keep too many
 * nodes apart; once a cell is the whole picture, weaker and weaker links count as strong. */
static CeldStatus
coarsen (CeldLevel *fine, int *doubled, CeldLevel *coarse)
{
  uint32_t *link      = celd_alloc (fine->n, sizeof *link);
  int       doublings = 1;
  float     strong    = STRONG;
  uint32_t  n;

  if (!link)
    return CELD_NO_MEMORY;
  while ((n = aggregate (fine, doublings, strong, link)) > FEWER * (double) fine->n)
    if (*doubled + doublings < WHOLE)
      doublings++;
    else if (strong > 0)
      strong = strong > 1e-9f ? 0.1f * strong : 0;
    else
      break;
  celd_free (link);
  *doubled += doublings;
  if (*doubled > WHOLE)
    *doubled = WHOLE;
  return contract (fine, n, doublings, coarse);
}

/* ------------------------------------------------------------------ set-up */

/* Moves the neighbours < i of node i to the front. */
static void
part_neighbours (CeldLevel *level, uint32_t i)
{
  uint32_t middle = level->start[i];

  for (uint32_t e = level->start[i]; e < level->start[i + 1]; e++)
    if (level->neighbour[e] < i)
      {
        uint32_t j = level->neighbour[e];
        float    w = level->weight[e];

        level->neighbour[e]      = level->neighbour[middle];
        level->weight[e]         = level->weight[middle];
        level->neighbour[middle] = j;
        level->weight[middle++]  = w;
      }
  level->middle[i] = middle;
}

/* What the cycle needs beside the edges. */
static CeldStatus
ready_cycle (CeldLevel *level)
{
  float **vector[] = { &level->inverse, &level->b, &level->x, &level->step, &level->image, &level->image2 };

  for (size_t v = 0; v < sizeof vector / sizeof *vector; v++)
    if (!(*vector[v] = celd_alloc0 (level->n, sizeof (float))))
      return CELD_NO_MEMORY;
  if (!(level->middle = celd_alloc (level->n, sizeof *level->middle)))
    return CELD_NO_MEMORY;
  for (uint32_t i = 0; i < level->n; i++)
    {
      float diagonal = level->sink[i];

      for (uint32_t e = level->start[i]; e < level->start[i + 1]; e++)
        diagonal += level->weight[e];
      level->inverse[i] = diagonal > 0 ? 1 / diagonal : 0;
      part_neighbours (level, i);
    }
  return CELD_OK;
}

static CeldStatus
eliminate_last (const CeldLevel *last, CeldBand *bottom)
{
  uint32_t   band   = last->n > 1 ? last->n - 1 : 1;
  CeldStatus status = celd_band_new (last->n, band, bottom);

  if (status != CELD_OK)
    return status;
  for (uint32_t i = 0; i < last->n; i++)
    {
      bottom->sink[i] = (double) last->sink[i];
      for (uint32_t e = last->start[i]; e < last->start[i + 1]; e++)
        if (last->neighbour[e] > i)
          bottom->weight[(size_t) i * band + last->neighbour[e] - i - 1] = (double) last->weight[e];
    }
  celd_band_eliminate (bottom);
  return CELD_OK;
}

CeldStatus
celd_levels_new (int width, int height, const float *east, const float *south, const float *diagonal,
                 const CeldRun *run, CeldLevels *levels)
{
  CeldLevel  pixels  = { 0 };
  CeldLevel *fine    = &pixels;
  int        doubled = 0;
  CeldStatus status;

  *levels = (CeldLevels) { 0 };
  status = pixel_graph (width, height, east, south, diagonal, &pixels);
  while (status == CELD_OK && (fine == &pixels || fine->n > BOTTOM) && levels->n < CELD_MAX_LEVELS)
    {
      CeldLevel *coarse = &levels->level[levels->n++];

      status = celd_step (run, doubled / (double) WHOLE);
      if (status == CELD_OK)
        status = coarsen (fine, &doubled, coarse);
      if (status == CELD_OK)
        status = ready_cycle (coarse);
      celd_free (fine->cell);
      fine->cell = NULL;
      fine = coarse;
    }
  if (status == CELD_OK)
    status = eliminate_last (fine, &levels->bottom);
  levels->coarser = pixels.coarser;
  pixels.coarser  = NULL;
  level_clear (&pixels);
  if (status != CELD_OK)
    celd_levels_clear (levels);
  return status;
}

void
celd_levels_clear (CeldLevels *levels)
{
  for (int l = 0; l < levels->n; l++)
    level_clear (&levels->level[l]);
  celd_band_clear (&levels->bottom);
  celd_free (levels->coarser);
  *levels = (CeldLevels) { 0 };
}
