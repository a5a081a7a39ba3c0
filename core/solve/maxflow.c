/* Exact minimum cut of a 4-connected grid by augmenting paths between two search trees: Y. Boykov and V. Kolmogorov,
 * "An Experimental Comparison of Min-Cut/Max-Flow Algorithms for Energy Minimization in Vision", PAMI 2004.
 *
 * One tree grows from the source, one from the sink, along edges with residual capacity.  Where they meet, flow is
 * pushed along the path; edges that it saturates make orphans, which look for a new parent in their tree or leave it.
 * In the end the source tree holds all that the source still reaches: the smallest source side of a minimum cut.
 *
 * The grid is implicit: neighbours are found by index, and one column and two rows of nodes without capacity round it
 * spare tests for the frame.  So it is 2.4 to 13 times as fast on all pixels as the general network of flow.c.
 * Capacities, and terminals by absolute value, are at most 2^30 - 1.
 *
 * Cost: O(n) in practice, some 0.3 s a megapixel of line art; 40 bytes a pixel.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "solve/maxflow.h"
#include "solve/partition.h"

/* The four directions, of which d ^ 1 is the opposite; a parent is a direction, or one of the others. */
enum { TO_EAST, TO_WEST, TO_SOUTH, TO_NORTH, DIRECTIONS, TO_TERMINAL = DIRECTIONS, ORPHANED, PARENTLESS };
enum { FREE, SOURCE, SINK };

typedef struct
{
  int32_t  residual[DIRECTIONS]; /* capacity left to the neighbour there */
  int32_t  terminal;             /* capacity left from the source (> 0) or to the sink (< 0) */
  uint32_t stamp;                /* the augmentation after which `distance` was last found right */
  uint32_t distance;             /* edges to the terminal, along the parents */
  uint8_t  tree, parent;
  bool     active;               /* waits in the queue of active nodes */
} Node;

typedef struct
{
  int           width, height;
  size_t        stride;          /* nodes from row to row: one more than the width */
  ptrdiff_t     offset[DIRECTIONS];
  size_t        n;
  Node         *node;
  CeldFlowQueue actives, orphans;
  uint32_t      augmentations;
  int64_t       flow;
} Grid;

static size_t
neighbour (const Grid *grid, size_t p, int d)
{
  return (size_t) ((ptrdiff_t) p + grid->offset[d]);
}

static void
activate (Grid *grid, size_t p)
{
  if (grid->node[p].active)
    return;
  grid->node[p].active = true;
  celd_queue_put (&grid->actives, (uint32_t) p);
}

static void
make_orphan (Grid *grid, size_t p)
{
  grid->node[p].parent = ORPHANED;
  celd_queue_put (&grid->orphans, (uint32_t) p);
}

/* ------------------------------------------------------------------ set-up */

static CeldStatus
grid_new (int width, int height, Grid *grid)
{
  size_t stride = (size_t) width + 1;
  size_t n      = stride * ((size_t) height + 2) + 1;

  *grid = (Grid) { .width = width, .height = height, .stride = stride, .n = n };
  grid->offset[TO_EAST]  = 1;
  grid->offset[TO_WEST]  = -1;
  grid->offset[TO_SOUTH] = (ptrdiff_t) stride;
  grid->offset[TO_NORTH] = -(ptrdiff_t) stride;
  grid->node          = celd_alloc0 (n, sizeof *grid->node);
  grid->actives       = (CeldFlowQueue) { celd_alloc (n, sizeof (uint32_t)), 0, 0, n };
  grid->orphans       = (CeldFlowQueue) { celd_alloc (n, sizeof (uint32_t)), 0, 0, n };
  return grid->node && grid->actives.item && grid->orphans.item ? CELD_OK : CELD_NO_MEMORY;
}

static void
grid_free (Grid *grid)
{
  celd_free (grid->node);
  celd_free (grid->actives.item);
  celd_free (grid->orphans.item);
}

/* The nodes with a terminal are the roots of the two trees. */
static void
plant (Grid *grid, const int32_t *east, const int32_t *south, const int32_t *terminal)
{
  for (int y = 0; y < grid->height; y++)
    for (int x = 0; x < grid->width; x++)
      {
        size_t i = (size_t) y * (size_t) grid->width + (size_t) x;
        size_t p = ((size_t) y + 1) * grid->stride + (size_t) x;
        Node  *node = &grid->node[p];

        if (x + 1 < grid->width)
          node->residual[TO_EAST] = node[1].residual[TO_WEST] = east[i];
        if (y + 1 < grid->height)
          node->residual[TO_SOUTH] = node[grid->stride].residual[TO_NORTH] = south[i];
        node->parent   = PARENTLESS;
        node->terminal = terminal[i];
        if (!terminal[i])
          continue;
        node->tree     = terminal[i] > 0 ? SOURCE : SINK;
        node->parent   = TO_TERMINAL;
        node->distance = 1;
        activate (grid, p);
      }
}

/* ------------------------------------------------------------------ growth */

/* Grows the tree of p to its free neighbours.  Returns the direction in which it meets the other tree, or
 * PARENTLESS. */
static int
grow (Grid *grid, size_t p)
{
  Node *node = &grid->node[p];

  for (int d = 0; d < DIRECTIONS; d++)
    {
      size_t  q     = neighbour (grid, p, d);
      Node   *other = &grid->node[q];
      int32_t left  = node->tree == SOURCE ? node->residual[d] : other->residual[d ^ 1];

      if (!left)
        continue;
      if (other->tree == FREE)
        {
          other->tree = node->tree;
          activate (grid, q);
        }
      else if (other->tree != node->tree)
        return d;
      else if (other->stamp > node->stamp || other->distance <= node->distance)
        continue; /* the path of `other` to the terminal is no longer than the one through p, as far as known */
      other->parent   = (uint8_t) (d ^ 1);
      other->stamp    = node->stamp;
      other->distance = node->distance + 1;
    }
  return PARENTLESS;
}

/* ------------------------------------------------------------------ augmentation */

/* The capacity left between p and its parent, in the direction of the flow. */
static int32_t *
to_parent (Grid *grid, size_t p)
{
  Node *node = &grid->node[p];

  if (node->tree == SINK)
    return &node->residual[node->parent];
  return &grid->node[neighbour (grid, p, node->parent)].residual[node->parent ^ 1];
}

static int32_t
least_to_root (Grid *grid, size_t p, int32_t least)
{
  for (; grid->node[p].parent != TO_TERMINAL; p = neighbour (grid, p, grid->node[p].parent))
    if (*to_parent (grid, p) < least)
      least = *to_parent (grid, p);
  return grid->node[p].terminal < -least || grid->node[p].terminal > least ? least
       : grid->node[p].terminal < 0 ? -grid->node[p].terminal : grid->node[p].terminal;
}

static void
push_to_root (Grid *grid, size_t p, int32_t amount)
{
  Node *node = &grid->node[p];

  while (node->parent != TO_TERMINAL)
    {
      size_t   q    = neighbour (grid, p, node->parent);
      int32_t *left = to_parent (grid, p);
      int32_t *back = node->tree == SINK ? &grid->node[q].residual[node->parent ^ 1] : &node->residual[node->parent];

      *left -= amount;
      *back += amount;
      if (!*left)
        make_orphan (grid, p);
      p    = q;
      node = &grid->node[p];
    }
  node->terminal += node->tree == SOURCE ? -amount : amount;
  if (!node->terminal)
    make_orphan (grid, p);
}

/* Saturates the path through the edge from p in direction d, which joins the two trees. */
static void
augment (Grid *grid, size_t p, int d)
{
  size_t  q = neighbour (grid, p, d);
  Node   *node, *other;
  int32_t amount;

  if (grid->node[p].tree == SINK)
    {
      size_t swap = p;

      p = q;
      q = swap;
      d ^= 1;
    }
  node  = &grid->node[p];
  other = &grid->node[q];
  amount = least_to_root (grid, q, least_to_root (grid, p, node->residual[d]));
  node->residual[d] -= amount;
  other->residual[d ^ 1] += amount;
  push_to_root (grid, p, amount);
  push_to_root (grid, q, amount);
  grid->flow += amount;
  grid->augmentations++;
}

/* ------------------------------------------------------------------ adoption */

/* Edges from p to its terminal, or 0 if its parents end at an orphan.  The path is stamped, so that later calls are
 * short. */
static uint32_t
distance_to_root (Grid *grid, size_t p)
{
  uint32_t now = grid->augmentations, distance = 0;
  size_t   q   = p;

  for (;; q = neighbour (grid, q, grid->node[q].parent), distance++)
    {
      Node *node = &grid->node[q];

      if (node->stamp == now)
        break;
      if (node->parent >= ORPHANED)
        return 0;
      if (node->parent == TO_TERMINAL)
        {
          node->stamp    = now;
          node->distance = 1;
          break;
        }
    }
  distance += grid->node[q].distance;
  for (uint32_t left = distance; grid->node[p].stamp != now; p = neighbour (grid, p, grid->node[p].parent))
    {
      grid->node[p].stamp    = now;
      grid->node[p].distance = left--;
    }
  return distance;
}

/* The orphan p had no new parent: it leaves its tree, its children become orphans, and neighbours that could take it
 * up again are active. */
static void
release (Grid *grid, size_t p)
{
  Node *node = &grid->node[p];

  for (int d = 0; d < DIRECTIONS; d++)
    {
      size_t q     = neighbour (grid, p, d);
      Node  *other = &grid->node[q];

      if (other->tree != node->tree)
        continue;
      if (node->tree == SOURCE ? other->residual[d ^ 1] : node->residual[d])
        activate (grid, q);
      if (other->parent == (d ^ 1))
        make_orphan (grid, q);
    }
  node->tree   = FREE;
  node->parent = PARENTLESS;
}

/* Gives the orphan p the neighbour of its tree that is nearest to the terminal for a parent. */
static void
adopt (Grid *grid, size_t p)
{
  Node    *node = &grid->node[p];
  uint32_t nearest = UINT32_MAX;

  for (int d = 0; d < DIRECTIONS; d++)
    {
      size_t   q     = neighbour (grid, p, d);
      Node    *other = &grid->node[q];
      uint32_t distance;

      if (other->tree != node->tree || !(node->tree == SOURCE ? other->residual[d ^ 1] : node->residual[d]))
        continue;
      distance = distance_to_root (grid, q);
      if (distance && distance < nearest)
        {
          nearest      = distance;
          node->parent = (uint8_t) d;
        }
    }
  if (nearest == UINT32_MAX)
    {
      release (grid, p);
      return;
    }
  node->stamp    = grid->augmentations;
  node->distance = nearest + 1;
}

/* ------------------------------------------------------------------ the cut */

static CeldStatus
solve (Grid *grid, const CeldHost *host)
{
  for (size_t steps = 1; grid->actives.n; steps++)
    {
      size_t p = celd_queue_take (&grid->actives);
      int    d;

      grid->node[p].active = false;
      while (grid->node[p].tree != FREE && (d = grow (grid, p)) != PARENTLESS)
        {
          augment (grid, p, d);
          while (grid->orphans.n)
            adopt (grid, celd_queue_take (&grid->orphans));
        }
      if (steps % 65536 == 0 && celd_progress (host, 0) != CELD_OK) /* how much is left to do cannot be told */
        return CELD_CANCELLED;
    }
  return celd_progress (host, 1);
}

CeldStatus
celd_maxflow (int width, int height, const int32_t *east, const int32_t *south, const int32_t *terminal,
              const CeldHost *host, uint8_t *side, int64_t *flow)
{
  Grid       grid = { 0 };
  CeldStatus status;

  if (width < 1 || height < 1 || width > CELD_MAX_SIDE || height > CELD_MAX_SIDE)
    return CELD_BAD_SIZE;
  status = grid_new (width, height, &grid);
  if (status != CELD_OK)
    goto done;
  plant (&grid, east, south, terminal);
  status = solve (&grid, host);
  if (status != CELD_OK)
    goto done;
  for (int y = 0; y < height; y++)
    for (int x = 0; x < width; x++)
      side[(size_t) y * (size_t) width + (size_t) x] =
        grid.node[((size_t) y + 1) * grid.stride + (size_t) x].tree == SOURCE;
  if (flow)
    *flow = grid.flow;

done:
  grid_free (&grid);
  return status;
}
