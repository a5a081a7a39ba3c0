/* Traces thinned paint: its lines, and the nodes where they end or meet.
 *
 * A pixel of a line has two neighbours.  Connected pixels with one or more than two are a node.
 *
 * Cost: a pass over the box of the paint.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/arrows.h"

#include <math.h>
#include <stdlib.h>

typedef struct
{
  const CeldStrokeMask *mask;
  uint8_t              *on;     /* the thinned paint; 2 = followed */
  CeldLabels            node;   /* of pixels: from 1; 0 = on a line, or not painted */
  CeldComponent        *nodes;
  size_t                n_nodes;
  CeldStrokeGraph       graph;
} Trace;

static CeldStatus
find_nodes (Trace *b)
{
  const CeldStrokeMask *m = b->mask;
  CeldStatus            status = celd_labels_new (m->width, m->height, &b->node);

  if (status != CELD_OK)
    return status;
  for (int y = 1; y + 1 < m->height; y++)
    for (int x = 1; x + 1 < m->width; x++)
      {
        size_t p = (size_t) y * (size_t) m->width + (size_t) x;
        bool   a[8];
        int    n = 0;

        celd_thin_neighbours (b->on, (size_t) m->width, p, a);
        for (int i = 0; i < 8; i++)
          n += a[i];
        CELD_AT (&b->node, x, y) = b->on[p] && n != 2;
      }
  status = celd_components (&b->node, 0, true, NULL, &b->node, &b->nodes, &b->n_nodes);
  if (status == CELD_OK && !(b->graph.node = celd_alloc0 (b->n_nodes, sizeof *b->graph.node)))
    status = CELD_NO_MEMORY;
  if (status != CELD_OK)
    return status;
  b->graph.n_nodes = b->graph.node_capacity = b->n_nodes;
  for (int y = 0; y < m->height; y++)
    for (int x = 0; x < m->width; x++)
      if (CELD_AT (&b->node, x, y))
        {
          uint32_t k = CELD_AT (&b->node, x, y) - 1;

          b->graph.node[k].at.x += (x + 0.5) / (double) b->nodes[k].area;
          b->graph.node[k].at.y += (y + 0.5) / (double) b->nodes[k].area;
        }
  return CELD_OK;
}

static CeldPoint
point_of (const Trace *b, size_t p)
{
  return (CeldPoint) { (double) (p % (size_t) b->mask->width) + 0.5, (double) (p / (size_t) b->mask->width) + 0.5 };
}

/* Follows a line from a pixel of a node over its neighbour. */
static CeldStatus
follow (Trace *b, size_t from, size_t next)
{
  size_t         width = (size_t) b->mask->width;
  CeldStrokeLine line = { .node = { (int) b->node.data[from] - 1, -1 } };
  CeldStatus     status = celd_stroke_line_append (&line, b->graph.node[line.node[0]].at);

  while (status == CELD_OK && !b->node.data[next])
    {
      size_t around[8] = { next - width, next + 1, next + width, next - 1, next - width + 1, next + width + 1,
                           next + width - 1, next - width - 1 };
      size_t on = next;

      b->on[next] = 2;
      status = celd_stroke_line_append (&line, point_of (b, next));
      for (int i = 7; i >= 0; i--)
        if (b->on[around[i]] && around[i] != from)
          on = around[i];
      from = next;
      next = on;
    }
  if (status == CELD_OK)
    {
      line.node[1] = (int) b->node.data[next] - 1;
      status = celd_stroke_line_append (&line, b->graph.node[line.node[1]].at);
    }
  if (status == CELD_OK)
    status = celd_append (b->graph.line, b->graph.n_lines, b->graph.capacity, line);
  if (status != CELD_OK)
    celd_free (line.at);
  return status;
}

static CeldStatus
find_lines (Trace *b)
{
  const CeldStrokeMask *m = b->mask;
  size_t                w = (size_t) m->width;
  CeldStatus            status = CELD_OK;

  for (int y = 1; y + 1 < m->height; y++)
    for (int x = 1; x + 1 < m->width; x++)
      {
        size_t p = (size_t) y * w + (size_t) x;
        size_t around[8] = { p - w, p - w + 1, p + 1, p + w + 1, p + w, p + w - 1, p - 1, p - w - 1 };

        for (int i = 0; i < 8 && b->node.data[p] && status == CELD_OK; i++)
          if (b->on[around[i]] == 1 && !b->node.data[around[i]])
            status = follow (b, p, around[i]);
      }
  return status;
}

static int
compare_numbers (const void *a, const void *b)
{
  const double *x = a, *y = b;

  return (*x > *y) - (*x < *y);
}

/* The width of the lines: the area of the paint by their length, but no more than twice the median distance of their
 * pixels from the edge, because dots and filled heads have area and no length. */
static CeldStatus
measure_width (Trace *b)
{
  size_t  n = 0, all = (size_t) b->mask->width * (size_t) b->mask->height;
  double  length = 0, area = 0, *width = celd_alloc (all, sizeof *width);

  if (!width)
    return CELD_NO_MEMORY;
  for (size_t k = 0; k < b->graph.n_lines; k++)
    length += celd_stroke_line_length (&b->graph.line[k]);
  for (size_t p = 0; p < all; p++)
    {
      area += b->mask->painted[p];
      if (b->on[p])
        width[n++] = 2 * sqrt (b->mask->squared[p]);
    }
  qsort (width, n, sizeof *width, compare_numbers);
  b->graph.width = fmax (1, fmin (area / fmax (1, length), n ? width[n / 2] : 1));
  celd_free (width);
  return CELD_OK;
}

CeldStatus
celd_stroke_trace (const CeldStrokeMask *mask, CeldStrokeGraph *graph)
{
  size_t     n = (size_t) mask->width * (size_t) mask->height;
  Trace      b = { .mask = mask, .on = celd_alloc (n, 1) };
  CeldStatus status = b.on ? CELD_OK : CELD_NO_MEMORY;

  if (status == CELD_OK)
    {
      memcpy (b.on, mask->painted, n);
      status = celd_thin (b.on, mask->width, mask->height);
    }
  if (status == CELD_OK)
    status = find_nodes (&b);
  if (status == CELD_OK)
    status = find_lines (&b);
  if (status == CELD_OK)
    status = measure_width (&b);
  celd_free (b.on);
  celd_free (b.node.data);
  celd_free (b.nodes);
  if (status != CELD_OK)
    celd_stroke_graph_clear (&b.graph);
  *graph = b.graph;
  return status;
}

void
celd_stroke_graph_clear (CeldStrokeGraph *graph)
{
  for (size_t k = 0; k < graph->n_lines; k++)
    celd_free (graph->line[k].at);
  celd_free (graph->line);
  celd_free (graph->node);
  *graph = (CeldStrokeGraph) { 0 };
}
