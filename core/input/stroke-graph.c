/* The long lines of connected paint, and the nodes where they meet or end.
 *
 * Of the lines of the thinned paint (stroke-trace.c) short branches are rough edges or parts of arrowheads; they are
 * left out, but their directions show where lines meet.  Nodes near each other are one, because thinned strokes rarely
 * meet in one pixel.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/arrows.h"

#include <math.h>
#include <string.h>

/* All chosen; lengths are widths of the paint. */
#define ROUGH         1.2  /* radii of the paint where a branch begins: one no longer than that is a rough edge; ... */
#define ROUGH_MORE    1    /* ... and pixels more */
#define BRANCH        7    /* length of a branch that is no stroke, ... */
#define LONGER        1.5  /* ... and how many times as long another line of its node is */
#define BRANCH_WEIGHT 0.5  /* of a branch where lines should meet; of lines: 1 */
#define STRAIGHT_ON   0.35 /* radians by which a branch turns that leads on a line beyond another one */
#define FILLED        0.95 /* radius of the paint where branches are of a filled head, and do not meet at its tip */
#define NEAR          5.5  /* between nodes that are one if there are heads; ... */
#define NEAREST       2    /* ... if there are none; ... */
#define FORK_LENGTH   8    /* ... and if lines part at one of the nodes, which lie on each other from the other one */
#define FORK_TURN     0.25 /* radians by which lines turn that part, and more if they part soon, ... */
#define DIRECTION     6    /* ... from so far */
#define LOOP          14   /* length of a line that returns to its node and is no stroke */
#define WIDE          1.4  /* width of a place where a line is divided, ... */
#define WIDE_MARGIN   4    /* ... at least so far from its ends */
#define MOST_TRACED   2000 /* lines before branches are removed: more are a drawing, or noise */

typedef struct { const CeldStrokeMask *mask; bool heads; CeldStrokeGraph graph; } Build;

static void
remove_line (CeldStrokeGraph *g, size_t k)
{
  celd_free (g->line[k].at);
  g->line[k] = g->line[--g->n_lines];
}

static int
degree (const CeldStrokeGraph *g, int node)
{
  int n = 0;

  for (size_t k = 0; k < g->n_lines; k++)
    n += (g->line[k].node[0] == node) + (g->line[k].node[1] == node);
  return n;
}

static double
radius_at (const Build *b, CeldPoint p)
{
  return sqrt (b->mask->squared[(size_t) p.y * (size_t) b->mask->width + (size_t) p.x]);
}

static double
longest_at (const CeldStrokeGraph *g, int node)
{
  double longest = 0;

  for (size_t k = 0; k < g->n_lines; k++)
    if (g->line[k].node[0] == node || g->line[k].node[1] == node)
      longest = fmax (longest, celd_stroke_line_length (&g->line[k]));
  return longest;
}

/* Adds the direction of the outer half of a branch to its node. */
static void
add_branch (CeldStrokeGraph *g, const CeldStrokeLine *line, int free_end)
{
  CeldPoint a = line->at[free_end ? line->n - 1 : 0], b = line->at[line->n / 2];
  double    length = hypot (a.x - b.x, a.y - b.y);

  if (length > 0)
    celd_line_sums_add (&g->node[line->node[!free_end]].branches, a,
                        (CeldPoint) { (a.x - b.x) / length, (a.y - b.y) / length }, BRANCH_WEIGHT);
}

/* The free end of a line that is a short branch of a node: 0 or 1; -1 = it is none. */
static int
branch_end (const CeldStrokeGraph *g, const CeldStrokeLine *line, const int *ends)
{
  int    free_end = ends[line->node[0]] == 1 ? 0 : 1, hub = line->node[!free_end];
  double length = celd_stroke_line_length (line);

  return ends[line->node[free_end]] == 1 && ends[hub] > 2 && length <= BRANCH * g->width &&
         LONGER * length <= longest_at (g, hub) ? free_end : -1;
}

static bool
is_rough (const Build *b, const CeldStrokeLine *line, int hub)
{
  return celd_stroke_line_length (line) <= ROUGH * radius_at (b, b->graph.node[hub].at) + ROUGH_MORE;
}

/* The direction of a line from one of its ends. */
static CeldPoint
direction (const CeldStrokeGraph *g, const CeldStrokeLine *line, int end)
{
  size_t    last = line->n - 1, reach = (size_t) fmin (DIRECTION * g->width, (double) last);
  CeldPoint a = line->at[end ? last : 0], b = line->at[end ? last - reach : reach];

  return (CeldPoint) { b.x - a.x, b.y - a.y };
}

/* Does a branch lead on another line of its node?  Then it may be the end of a stroke that crosses others there. */
static bool
leads_on (const CeldStrokeGraph *g, size_t k, int hub)
{
  CeldPoint on = direction (g, &g->line[k], g->line[k].node[1] == hub);

  for (size_t i = 0; i < 2 * g->n_lines; i++)
    if (i / 2 != k && g->line[i / 2].node[i % 2] == hub)
      {
        CeldPoint into = direction (g, &g->line[i / 2], i % 2);

        if (fabs (atan2 (into.y * on.x - into.x * on.y, -into.x * on.x - into.y * on.y)) < STRAIGHT_ON)
          return true;
      }
  return false;
}

/* Removes branches with a free end that are no longer than rough edges or the lines of arrowheads, but for one beside a
 * rough edge, or beyond a line: that is the end of a stroke. */
static CeldStatus
remove_branches (Build *b)
{
  CeldStrokeGraph *g = &b->graph;
  int             *ends = celd_alloc0 (3 * g->n_nodes + 1, sizeof *ends);
  int             *left; /* lines that stay */
  int             *real; /* branches that are not rough */

  if (!ends)
    return CELD_NO_MEMORY;
  left = ends + g->n_nodes;
  real = left + g->n_nodes;
  for (size_t k = 0; k < 2 * g->n_lines; k++)
    ends[g->line[k / 2].node[k % 2]]++;
  memcpy (left, ends, g->n_nodes * sizeof *left);
  for (size_t k = 0; k < g->n_lines; k++)
    {
      int end = branch_end (g, &g->line[k], ends), hub = end < 0 ? 0 : g->line[k].node[!end];

      left[hub] -= end >= 0;
      real[hub] += end >= 0 && !is_rough (b, &g->line[k], hub);
    }
  for (size_t k = g->n_lines; k-- > 0;)
    {
      CeldStrokeLine *line = &g->line[k];
      int             end = branch_end (g, line, ends), hub = end < 0 ? 0 : line->node[!end];
      bool            rough = end >= 0 && is_rough (b, line, hub);
      bool            single = end >= 0 && real[hub] == 1 && (left[hub] == 1 || (left[hub] == 3 && leads_on (g, k, hub)));

      if (end < 0 || (!rough && (!b->heads || single)))
        continue;
      if (!rough && radius_at (b, g->node[hub].at) < FILLED * g->width)
        add_branch (g, line, end);
      g->node[hub].branched |= !rough;
      remove_line (g, k);
    }
  celd_free (ends);
  return CELD_OK;
}

static void
reverse (CeldStrokeLine *line)
{
  int node = line->node[0];

  line->node[0] = line->node[1];
  line->node[1] = node;
  for (size_t i = 0; i < line->n / 2; i++)
    {
      CeldPoint p = line->at[i];

      line->at[i] = line->at[line->n - 1 - i];
      line->at[line->n - 1 - i] = p;
    }
}

CeldStatus
celd_stroke_graph_join (CeldStrokeGraph *g, int node)
{
  size_t     with[2] = { 0, 0 };
  int        n = 0;
  CeldStatus status = CELD_OK;

  for (size_t k = 0; k < g->n_lines; k++)
    for (int end = 0; end < 2; end++)
      if (g->line[k].node[end] == node && n++ < 2)
        with[n - 1] = k;
  if (n != 2 || with[0] == with[1])
    return CELD_OK;
  if (g->line[with[0]].node[1] != node)
    reverse (&g->line[with[0]]);
  if (g->line[with[1]].node[0] != node)
    reverse (&g->line[with[1]]);
  for (size_t i = 0; i < g->line[with[1]].n && status == CELD_OK; i++)
    status = celd_stroke_line_append (&g->line[with[0]], g->line[with[1]].at[i]);
  g->line[with[0]].node[1] = g->line[with[1]].node[1];
  remove_line (g, with[1]);
  return status;
}

/* Joins the two lines of each node that has no more and had no longer branches: those may be of a head. */
static CeldStatus
join_lines (CeldStrokeGraph *g)
{
  CeldStatus status = CELD_OK;

  for (size_t node = 0; node < g->n_nodes && status == CELD_OK; node++)
    if (!g->node[node].branched)
      status = celd_stroke_graph_join (g, (int) node);
  return status;
}

static void
add_node (CeldStrokeNode *a, const CeldStrokeNode *b)
{
  a->at        = (CeldPoint) { (a->at.x + b->at.x) / 2, (a->at.y + b->at.y) / 2 };
  a->branched |= b->branched;
  a->branches  = (CeldLineSums) {
    a->branches.xx + b->branches.xx, a->branches.xy + b->branches.xy, a->branches.yy + b->branches.yy,
    a->branches.x + b->branches.x, a->branches.y + b->branches.y,
  };
}

/* Do at least two other lines of a node of line k go about straight on from there?  Then they lie on each other along it:
 * the longer, the less they turn. */
static bool
parts_there (const CeldStrokeGraph *g, size_t k, int end)
{
  CeldPoint into = direction (g, &g->line[k], end);
  double    turn = FORK_TURN + g->width / fmax (1, celd_stroke_line_length (&g->line[k]));
  int       n = 0;

  for (size_t i = 0; i < 2 * g->n_lines; i++)
    if (i / 2 != k && g->line[i / 2].node[i % 2] == g->line[k].node[end])
      {
        CeldPoint on = direction (g, &g->line[i / 2], i % 2);

        if (fabs (atan2 (into.y * on.x - into.x * on.y, -into.x * on.x - into.y * on.y)) > turn)
          return false;
        n++;
      }
  return n > 1;
}

/* Does a line lead between two nodes that are one? */
static bool
is_between (const Build *b, size_t k)
{
  const CeldStrokeLine *line = &b->graph.line[k];
  double                length = celd_stroke_line_length (line) / b->graph.width;

  if (line->node[0] == line->node[1])
    return length <= LOOP;
  if (b->heads)
    return length <= NEAR;
  return length <= NEAREST ||
         (length <= FORK_LENGTH && (parts_there (&b->graph, k, 0) || parts_there (&b->graph, k, 1)));
}

/* If lines part at one end of a line, they come from its other end: gives both ends that place. */
static void
leave_parting (CeldStrokeGraph *g, size_t k)
{
  const int *node = g->line[k].node;
  bool       first = parts_there (g, k, 0), last = parts_there (g, k, 1);

  if (first != last)
    g->node[node[last]].at = g->node[node[first]].at;
}

/* Makes nodes one that a short line connects, and removes that line. */
static void
merge_nodes (Build *b)
{
  CeldStrokeGraph *g = &b->graph;

  for (size_t k = g->n_lines; k-- > 0;)
    {
      int one = g->line[k].node[0], other = g->line[k].node[1];

      if (degree (g, one) < 2 || degree (g, other) < 2 || !is_between (b, k))
        continue;
      if (!b->heads)
        leave_parting (g, k);
      for (size_t i = 0; i < g->n_lines; i++)
        for (int end = 0; end < 2; end++)
          if (g->line[i].node[end] == other)
            g->line[i].node[end] = one;
      if (one != other)
        add_node (&g->node[one], &g->node[other]);
      remove_line (g, k);
    }
}

CeldStatus
celd_stroke_graph_divide (CeldStrokeGraph *g, size_t k, size_t at)
{
  CeldStrokeLine rest = { .node = { (int) g->n_nodes, g->line[k].node[1] } };
  CeldStrokeNode node = { .at = g->line[k].at[at], .branched = true };
  CeldStatus     status = celd_append (g->node, g->n_nodes, g->node_capacity, node);

  for (size_t i = at; i < g->line[k].n && status == CELD_OK; i++)
    status = celd_append (rest.at, rest.n, rest.capacity, g->line[k].at[i]);
  if (status == CELD_OK)
    status = celd_append (g->line, g->n_lines, g->capacity, rest);
  if (status != CELD_OK)
    {
      celd_free (rest.at);
      return status;
    }
  g->line[k].n       = at + 1;
  g->line[k].node[1] = rest.node[0];
  return CELD_OK;
}

/* Divides lines where the paint is much wider, as it is at filled heads and dots. */
static CeldStatus
divide_where_wide (Build *b)
{
  CeldStrokeGraph *g = &b->graph;
  size_t           margin = (size_t) (WIDE_MARGIN * g->width);
  CeldStatus       status = CELD_OK;

  for (size_t k = 0; k < g->n_lines && status == CELD_OK; k++)
    {
      size_t widest = 0;
      double most = 0.5 * WIDE * g->width;

      for (size_t i = margin; i + margin < g->line[k].n; i++)
        if (radius_at (b, g->line[k].at[i]) - 0.5 > most)
          {
            most   = radius_at (b, g->line[k].at[i]) - 0.5;
            widest = i;
          }
      if (widest)
        {
          status = celd_stroke_graph_divide (g, k, widest);
          k -= status == CELD_OK;
        }
    }
  return status;
}

/* Divides lines at their corners, where an arrow may begin or end. */
static CeldStatus
divide_at_corners (CeldStrokeGraph *g)
{
  CeldStatus status = CELD_OK;
  CeldPoint  corner;

  for (size_t k = 0; k < g->n_lines && status == CELD_OK; k++)
    if (celd_stroke_line_corner (g, k, &corner))
      {
        status = celd_stroke_graph_divide (g, k, celd_stroke_line_nearest (&g->line[k], corner));
        k -= status == CELD_OK;
      }
  return status;
}

CeldStatus
celd_stroke_graph_new (const CeldStrokeMask *mask, bool heads, CeldStrokeGraph *graph)
{
  Build      b = { .mask = mask, .heads = heads };
  CeldStatus status = celd_stroke_trace (mask, &b.graph);

  if (status == CELD_OK && b.graph.n_lines > MOST_TRACED)
    celd_stroke_graph_clear (&b.graph);
  if (status == CELD_OK)
    status = join_lines (&b.graph);
  if (status == CELD_OK)
    {
      merge_nodes (&b);
      status = remove_branches (&b);
    }
  if (status == CELD_OK)
    status = join_lines (&b.graph);
  if (status == CELD_OK)
    merge_nodes (&b);
  if (status == CELD_OK && heads)
    status = divide_where_wide (&b);
  if (status == CELD_OK && heads)
    merge_nodes (&b);
  if (status == CELD_OK && heads)
    status = divide_at_corners (&b.graph);
  if (status != CELD_OK)
    celd_stroke_graph_clear (&b.graph);
  *graph = b.graph;
  return status;
}
