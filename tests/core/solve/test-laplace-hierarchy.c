/* The coarse levels: aggregates respect walls and cells, weights are sums, levels become small.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "level-edges.h"
#include "solve/laplace-private.h"

enum { W = 150, H = 130 };

/* Unit weights, a wall of weight `wall` right of column 70, all held weakly. */
static CeldWeightedGraph
walled (float wall)
{
  CeldWeightedGraph g = random_graph (W, H, 1);

  for (int i = 0; i < W * H; i++)
    {
      g.east[i]  = i % W == W - 1 ? 0 : i % W == 70 ? wall : 1;
      g.south[i] = i / W == H - 1 ? 0 : 1;
    }
  return g;
}

static void
levels_of (CeldWeightedGraph graph, CeldHierarchy *levels)
{
  CHECK (celd_hierarchy_new (&graph, NULL, levels) == CELD_OK);
  celd_weighted_graph_clear (&graph);
}

static void
no_aggregate_reaches_over_a_wall_or_its_cell (void)
{
  CeldWeightedGraph graph = walled (1e-3f), coarse;
  uint32_t         *node = NULL;
  int              *first = malloc (W * H * sizeof *first);

  CHECK (celd_coarsen (&graph, NULL, &coarse, &node) == CELD_OK);
  CHECK (coarse.width == W / 2 && coarse.height == H / 2 && coarse.n_extra == H / 2);
  for (int c = 0; c < W * H; c++)
    first[c] = -1;
  for (int i = 0; i < W * H; i++)
    {
      int *f = &first[node[i]];

      if (*f < 0)
        *f = i;
      CHECK (i % W / 2 == *f % W / 2 && i / W / 2 == *f / W / 2);
      CHECK ((i % W > 70) == (*f % W > 70));
    }
  celd_weighted_graph_clear (&graph);
  celd_weighted_graph_clear (&coarse);
  free (node);
  free (first);
}

/* A cell in which a pixel hangs weakly between two parts that no edge joins: it goes with the one that holds it more,
 * and the parts stay apart.  `first` and `second` are the weights of its edges to them. */
static void
check_leaf (float first, float second)
{
  enum { SIDE = 20, UPPER = 10 * SIDE + 10, WEAK = UPPER + 1, BELOW = UPPER + SIDE, OTHER = BELOW + 1,
         LONE = 8 * SIDE + 8 };
  CeldWeightedGraph graph = random_graph (SIDE, SIDE, 1), coarse;
  uint32_t         *node = NULL;

  for (int i = 0; i < SIDE * SIDE; i++)
    {
      graph.east[i]  = i % SIDE < SIDE - 1;
      graph.south[i] = i / SIDE < SIDE - 1;
      graph.diagonal[i]  = 1e-6f;
    }
  graph.east[UPPER]  = first;
  graph.south[WEAK]  = second;
  graph.east[WEAK] = graph.south[WEAK - SIDE] = graph.east[BELOW] = 0;
  graph.east[LONE] = graph.east[LONE - 1] = graph.south[LONE] = graph.south[LONE - SIDE] = 0;
  CHECK (celd_coarsen (&graph, NULL, &coarse, &node) == CELD_OK);
  CHECK (coarse.width == SIDE / 2 && coarse.n_extra == 1); /* no pairs; only that cell has two nodes */
  CHECK (node[UPPER] == node[BELOW] && node[UPPER] != node[OTHER]);
  CHECK (node[WEAK] == node[first > second ? UPPER : OTHER]);
  CHECK (node[LONE] == CELD_NO_NODE && node[LONE + 1] == node[LONE + 1 + SIDE]);
  celd_weighted_graph_clear (&graph);
  celd_weighted_graph_clear (&coarse);
  free (node);
}

static void
a_weakly_attached_node_joins_its_strongest_neighbour (void)
{
  check_leaf (0.02f, 0.01f);
  check_leaf (0.01f, 0.02f);
}

/* Nothing is lost or made up between the pixels and the levels: sums over what crosses aggregates. */
static void
weights_and_diagonals_are_sums (void)
{
  static const float wall[] = { 0, 0.25f, 1 };

  for (size_t k = 0; k < 4; k++)
    {
      CeldWeightedGraph graph = k < 3 ? walled (wall[k]) : random_graph (W, H, 3), coarse;
      CeldHierarchy     levels;
      uint32_t         *node = NULL;
      double            diagonal = 0, crossing = 0, edges = 0;
      LevelEdge        *edge;

      CHECK (celd_coarsen (&graph, NULL, &coarse, &node) == CELD_OK);
      for (int i = 0; i < W * H; i++)
        {
          diagonal += (double) graph.diagonal[i];
          if (i % W + 1 < W && node[i] != node[i + 1])
            crossing += (double) graph.east[i];
          if (i + W < W * H && node[i] != node[i + W])
            crossing += (double) graph.south[i];
        }
      levels_of (graph, &levels);
      edge = level_edges (&levels.level[1]);
      for (const LevelEdge *e = edge; e->weight > 0; e++)
        edges += e->weight;
      for (uint32_t i = 0; i < levels.level[1].n; i++)
        diagonal -= (double) levels.level[1].diagonal[i];
      NEAR (diagonal, 0, 1e-5);
      NEAR (edges, crossing, 1e-2);
      for (uint32_t i = 0; i < levels.level[1].n_extra; i++)
        for (uint32_t e = levels.level[1].start[i]; e < levels.level[1].start[i + 1]; e++)
          CHECK ((levels.level[1].neighbour[e] > 2 * levels.level[1].plane + i) == (e >= levels.level[1].middle[i]));
      free (edge);
      free (node);
      celd_weighted_graph_clear (&coarse);
      celd_hierarchy_clear (&levels);
    }
}

/* Every edge of the pixels is in its place, and the diagonal is the sum of a node's edges and diagonal. */
static void
the_layout_keeps_the_graph (void)
{
  CeldWeightedGraph graph = random_graph (37, 23, 8);
  CeldHierarchy     levels;
  float            *east = malloc (37 * 23 * sizeof *east), *south = malloc (37 * 23 * sizeof *south);
  double           *whole;
  LevelEdge        *edge;
  uint32_t          found = 0;

  memcpy (east, graph.east, 37 * 23 * sizeof *east);
  memcpy (south, graph.south, 37 * 23 * sizeof *south);
  levels_of (graph, &levels);
  edge  = level_edges (&levels.level[0]);
  whole = calloc (levels.level[0].n, sizeof *whole);
  for (const LevelEdge *e = edge; e->weight > 0; e++)
    {
      whole[e->from] += e->weight;
      whole[e->to] += e->weight;
      found++;
    }
  CHECK (found == 36 * 23 + 37 * 22);
  for (int y = 0; y < 23; y++)
    for (int x = 0; x < 37; x++)
      {
        size_t place = celd_grid_place (&levels.level[0], x, y);
        int    i = y * 37 + x;
        double sum = (double) (x ? east[i - 1] : 0) + (double) (x < 36 ? east[i] : 0) +
                     (double) (y ? south[i - 37] : 0) + (double) (y < 22 ? south[i] : 0);

        NEAR (whole[place], sum, 1e-5);
        NEAR ((double) levels.level[0].inverse[place] * (sum + 1e-3), 1, 1e-5);
      }
  free (east);
  free (south);
  free (whole);
  free (edge);
  celd_hierarchy_clear (&levels);
}

static uint32_t
count_nodes (const CeldGridLevel *level)
{
  uint32_t n = 0;

  for (uint32_t i = 0; i < level->n; i++)
    n += level->inverse[i] > 0;
  return n;
}

/* A slanted band: the picture is empty on both sides of it, at one end of every row and in the rows above and below. */
static void
spans_hold_what_is_not_empty (void)
{
  CeldWeightedGraph graph = random_graph (W, H, 1);
  CeldHierarchy     levels;

  for (int i = 0; i < W * H; i++)
    if (abs (i % W - i / W) > 20 || i / W < 11 || i / W > 90)
      {
        graph.diagonal[i] = graph.east[i] = graph.south[i] = 0;
        if (i % W)
          graph.east[i - 1] = 0;
        if (i >= W)
          graph.south[i - W] = 0;
      }
  levels_of (graph, &levels);
  for (int l = 0; l < levels.n; l++)
    for (int y = 0; y < levels.level[l].height; y++)
      {
        const CeldGridLevel *level = &levels.level[l];
        CeldPlaceSpan        span = level->row[y];
        size_t               start = (size_t) (y + 1) * level->stride + 1, least = SIZE_MAX, most = 0;

        for (size_t i = start; i < start + (size_t) level->half; i++)
          if (level->inverse[i] > 0 || level->inverse[level->plane + i] > 0)
            {
              least = least < i ? least : i;
              most  = i;
            }
        CHECK (most ? span.first <= least && span.first + 8 > least && (span.first - start) % 8 == 0
                      && span.end == most + 1 : span.first >= span.end);
      }
  CHECK (levels.level[0].row[10].first >= levels.level[0].row[10].end);
  CHECK (levels.level[0].row[80].first - 81 * levels.level[0].stride > 16);
  celd_hierarchy_clear (&levels);
}

static void
levels_become_small_quickly (void)
{
  CeldHierarchy levels;

  levels_of (walled (0), &levels);
  CHECK (levels.n >= 3);
  for (int l = 1; l < levels.n; l++)
    CHECK (count_nodes (&levels.level[l]) <= 0.6 * count_nodes (&levels.level[l - 1]));
  CHECK (levels.coarsest.n == count_nodes (&levels.level[levels.n - 1]) && levels.coarsest.n <= 150);
  celd_hierarchy_clear (&levels);
}

static void
pixels_without_an_edge_are_left_out (void)
{
  CeldWeightedGraph graph = random_graph (W, H, 1);
  CeldHierarchy     levels;

  memset (graph.east, 0, W * H * sizeof (float));
  memset (graph.south, 0, W * H * sizeof (float));
  levels_of (graph, &levels);
  CHECK (levels.n == 2 && levels.coarsest.n == 0);
  for (int i = 0; i < W * H; i += 11)
    if ((i % W + i / W) % 2 == 0)
      CHECK (levels.level[0].coarser[celd_grid_place (&levels.level[0], i % W, i / W)] == 0);
  celd_hierarchy_clear (&levels);
}

int
main (void)
{
  RUN (no_aggregate_reaches_over_a_wall_or_its_cell);
  RUN (a_weakly_attached_node_joins_its_strongest_neighbour);
  RUN (weights_and_diagonals_are_sums);
  RUN (the_layout_keeps_the_graph);
  RUN (spans_hold_what_is_not_empty);
  RUN (levels_become_small_quickly);
  RUN (pixels_without_an_edge_are_left_out);
  return DONE;
}
