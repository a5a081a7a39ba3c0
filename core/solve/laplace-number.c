/* The numbers of aggregates in a graph of the Laplacian solver (laplace-graph.c): the first one of a coarse cell takes
 * the number of the cell, others follow behind the cells, row by row.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/unions.h"
#include "solve/laplace-graph.h"
#include "solve/laplace-private.h"

/* Numbers the aggregate of node i, which lies in a coarse cell; *count is the next number of an extra one. */
static inline void
number_node (CeldAggregation *a, uint32_t i, uint32_t cell, uint32_t *count)
{
  uint32_t root = celd_root (a->parent, i);

  if (!(a->best[i] > 0))
    a->link[i] = CELD_NO_NODE;
  else if (root != i)
    a->link[i] = a->link[root]; /* a root comes before its members */
  else if (!a->taken[cell])
    {
      a->taken[cell] = 1;
      a->link[i]  = cell;
    }
  else
    a->link[i] = (*count)++;
}

/* The nodes of a row of coarse cells.  Extra aggregates count from the first one of the row. */
static void
number_row (void *data, int row)
{
  CeldAggregation   *a = data;
  const CeldWeights *g = a->graph;
  CeldWeights       *coarse = a->coarse;
  CeldNodes          nodes = celd_weights_nodes (g, coarse, row);
  uint32_t           w = (uint32_t) g->width, n = celd_weights_cells (g), cells = celd_weights_cells (coarse);
  uint32_t           cell = (uint32_t) row * (uint32_t) coarse->width, side = 1u << coarse->doublings, count = cells;

  for (uint32_t x0 = 0, c = cell; x0 < w; x0 += side, c++)
    for (uint32_t y = nodes.from; y < nodes.to; y++)
      for (uint32_t x = x0; x < x0 + side && x < w; x++)
        number_node (a, y * w + x, c, &count);
  for (uint32_t k = nodes.extra; k < nodes.extra_end; k++)
    number_node (a, n + k, celd_weights_above (g, g->cell[k], coarse), &count);
  a->row_count[row] = count - cells;
}

/* Extra aggregates of a row come after those of the rows before. */
static void
shift_row (void *data, int row)
{
  CeldAggregation   *a = data;
  const CeldWeights *g = a->graph;
  CeldNodes          nodes = celd_weights_nodes (g, a->coarse, row);
  uint32_t           w = (uint32_t) g->width, n = celd_weights_cells (g), cells = celd_weights_cells (a->coarse);
  uint32_t           before = a->coarse->row_extra[row];

  if (!before || before == a->coarse->row_extra[row + 1])
    return;
  for (uint32_t i = nodes.from * w; i < nodes.to * w; i++)
    a->link[i] += a->link[i] >= cells && a->link[i] != CELD_NO_NODE ? before : 0;
  for (uint32_t i = n + nodes.extra; i < n + nodes.extra_end; i++)
    a->link[i] += a->link[i] >= cells && a->link[i] != CELD_NO_NODE ? before : 0;
}

/* What is not whole yet has parts on the coarse level, too. */
static void
carry_row (void *data, int row)
{
  CeldAggregation *a = data;
  CeldNodes        nodes = celd_weights_nodes (a->graph, a->coarse, row);
  uint32_t         w = (uint32_t) a->graph->width, n = celd_weights_cells (a->graph);

  for (uint32_t i = nodes.from * w; i < nodes.to * w; i++)
    if (a->open[i] && a->link[i] != CELD_NO_NODE)
      a->coarse->part[a->link[i]] = 1;
  for (uint32_t i = n + nodes.extra; i < n + nodes.extra_end; i++)
    if (a->open[i] && a->link[i] != CELD_NO_NODE)
      a->coarse->part[a->link[i]] = 1;
}

CeldStatus
celd_weights_number (CeldAggregation *a)
{
  CeldWeights *coarse = a->coarse;

  if (!(a->taken = celd_alloc0 (celd_weights_cells (coarse), 1)))
    return CELD_NO_MEMORY;
  celd_parallel_for (a->host, coarse->height, number_row, a);
  celd_free (a->taken);
  for (int row = 0; row < coarse->height; row++)
    coarse->row_extra[row + 1] = coarse->row_extra[row] + a->row_count[row];
  coarse->n_extra = coarse->row_extra[coarse->height];
  celd_parallel_for (a->host, coarse->height, shift_row, a);
  if (!a->graph->part)
    return CELD_OK;
  if (!(coarse->part = celd_alloc0 ((size_t) celd_weights_cells (coarse) + coarse->n_extra, 1)))
    return CELD_NO_MEMORY;
  celd_parallel_for (a->host, coarse->height, carry_row, a);
  return CELD_OK;
}
