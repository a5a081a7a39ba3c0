/* Graphs of pixels: nodes are the connected pixels of equal state in a cell, and any labelling of the nodes costs what
 * it costs on the pixels.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "image/image.h"
#include "segment/basins.h"
#include "segment/pixel-graph.h"
#include "segment/task.h"

enum { W = 29, H = 23, SIZE = 8, LABELS = 3 };

typedef struct
{
  CeldPlane       ink;
  CeldBasins      basins; /* only its costs */
  CeldSegmentTask task;
  CeldRect        box;
  uint64_t        state[H][W];
  int32_t         to_paper[W * H];
  CeldPixelGraph  graph;
} Page;

/* Random ink and states, in a box that leaves out some rows and columns; `cell` as in celd_pixel_graph_add_square. */
static void
page_open (Page *page, uint32_t *random, int cell)
{
  static const float ink[4] = { 0, 0.2f, 0.8f, 1 };
  CeldRect           box = { 2, 1, W - 3, H - 1 };

  *page = (Page) { .ink = { W, H, W, malloc (W * H * sizeof (float)) }, .box = box };
  celd_smoothness_costs_new (W, H, 0.25f, &page->basins.costs);
  page->task = (CeldSegmentTask) { .ink = &page->ink, .basins = &page->basins, .soft_cost = 1000 };
  for (int p = 0; p < W * H; p++)
    {
      uint64_t value = 1 + check_random (random, LABELS), seed = check_random (random, 40) ? 0 : value % LABELS + 1;

      page->ink.data[p] = ink[check_random (random, 4)];
      page->state[p / W][p % W] = value | (value == 2 ? CELD_STATE_DIAGONAL : 0) |
                                  (check_random (random, 6) ? seed << CELD_STATE_SEED : CELD_STATE_FIXED);
    }
  CHECK (celd_distance_to_paper (&page->ink, NULL, page->to_paper) == CELD_OK);
  CHECK (celd_pixel_graph_new (&page->task, box, &page->graph) == CELD_OK);
  for (int y = box.y; y < box.y + box.height; y += SIZE)
    for (int x = box.x; x < box.x + box.width; x += SIZE)
      CHECK (celd_pixel_graph_add_square (&page->graph, x, y, SIZE, &page->state[y][x], W, cell) == CELD_OK);
  CHECK (celd_pixel_graph_connect (&page->graph) == CELD_OK);
}

static void
page_close (Page *page)
{
  celd_pixel_graph_clear (&page->graph);
  free (page->ink.data);
}

/* Must the pixels be of one node, as neighbours?  Both are in the box. */
static bool
is_joined (const Page *page, int cell, int x, int y, int u, int v)
{
  int left = page->box.x, top = page->box.y;

  return page->state[y][x] == page->state[v][u] && !(page->state[y][x] & CELD_STATE_FIXED) &&
         (x - left) >> cell == (u - left) >> cell && (y - top) >> cell == (v - top) >> cell &&
         (x == u || y == v || page->state[y][x] & CELD_STATE_DIAGONAL);
}

/* Number of the node of each pixel by repeated passes: the smallest index that it is connected with. */
static void
slow_nodes (const Page *page, int cell, int node[H][W])
{
  CeldRect box = page->box;
  bool     changed = true;

  for (int p = 0; p < W * H; p++)
    node[p / W][p % W] = p;
  while (changed)
    {
      changed = false;
      for (int y = box.y; y < box.y + box.height; y++)
        for (int x = box.x; x < box.x + box.width; x++)
          for (int v = y - 1; v <= y + 1; v++)
            for (int u = x - 1; u <= x + 1; u++)
              if (u >= box.x && v >= box.y && u < box.x + box.width && v < box.y + box.height &&
                  is_joined (page, cell, x, y, u, v) && node[v][u] < node[y][x])
                {
                  node[y][x] = node[v][u];
                  changed = true;
                }
    }
}

static void
nodes_are_connected_pixels_of_equal_state_in_a_cell (void)
{
  static Page page;
  static int  node[H][W];
  uint32_t    random = 11;

  for (int round = 0; round < 60; round++)
    {
      uint32_t of[W * H];
      size_t   n = 0;
      int      wrong = 0;

      page_open (&page, &random, round % 4);
      slow_nodes (&page, round % 4, node);
      memset (of, 0xff, sizeof of);
      for (int y = page.box.y; y < page.box.y + page.box.height; y++)
        for (int x = page.box.x; x < page.box.x + page.box.width; x++)
          {
            uint32_t part = *celd_pixel_graph_part (&page.graph, x, y), value = page.state[y][x] & CELD_STATE_VALUE;

            if (page.state[y][x] & CELD_STATE_FIXED)
              wrong += part != (CELD_PART_FIXED | value);
            else if (node[y][x] == y * W + x)
              {
                of[y * W + x] = part;
                n++;
                wrong += part >= page.graph.n || page.graph.node[part].value != value;
              }
            else
              wrong += part != of[node[y][x]];
          }
      NEAR (wrong, 0, 0);
      NEAR (n, page.graph.n, 0);
      page_close (&page);
    }
}

static uint32_t
label_at (const Page *page, const uint32_t *label, int x, int y)
{
  uint32_t part = *celd_pixel_graph_part (&page->graph, x, y);

  return part & CELD_PART_FIXED ? part & ~CELD_PART_FIXED : label[part];
}

/* What the pixel and the one below (south) or to the right cost with their labels. */
static int64_t
slow_cost (const Page *page, const uint32_t *label, int x, int y, bool south)
{
  int  u = x + !south, v = y + south;
  bool frame = south ? x == 0 || x + 1 == W : y == 0 || y + 1 == H;

  if (u >= page->box.x + page->box.width || v >= page->box.y + page->box.height ||
      label_at (page, label, x, y) == label_at (page, label, u, v) ||
      (page->state[y][x] & page->state[v][u] & CELD_STATE_FIXED))
    return 0;
  return celd_smoothness_cost (&page->basins.costs, CELD_AT (&page->ink, x, y), CELD_AT (&page->ink, u, v),
                               page->to_paper[y * W + x], page->to_paper[v * W + u], frame);
}

static void
a_labelling_costs_what_it_costs_on_pixels (void)
{
  static Page page;
  uint32_t    random = 5;

  for (int round = 0; round < 60; round++)
    {
      uint32_t label[W * H];
      int64_t  sum = 0, wanted = 0;

      page_open (&page, &random, round % 4);
      for (size_t k = 0; k < page.graph.n; k++)
        label[k] = 1 + check_random (&random, LABELS);
      for (int y = page.box.y; y < page.box.y + page.box.height; y++)
        for (int x = page.box.x; x < page.box.x + page.box.width; x++)
          {
            uint64_t state = page.state[y][x], seed = state >> CELD_STATE_SEED;

            wanted += slow_cost (&page, label, x, y, false) + slow_cost (&page, label, x, y, true);
            if (seed && !(state & CELD_STATE_FIXED) && seed != label_at (&page, label, x, y))
              wanted += page.task.soft_cost;
          }
      for (size_t i = 0; i < page.graph.n_links; i++)
        {
          const CeldLink *link = &page.graph.link[i];

          CHECK (link->a < link->b && link->b < page.graph.n);
          sum += label[link->a] != label[link->b] ? link->cost : 0;
        }
      for (size_t i = 0; i < page.graph.n_votes; i++)
        sum += label[page.graph.vote[i].node] != page.graph.vote[i].label ? page.graph.vote[i].cost : 0;
      CHECK (sum == wanted);
      page_close (&page);
    }
}

int
main (void)
{
  RUN (nodes_are_connected_pixels_of_equal_state_in_a_cell);
  RUN (a_labelling_costs_what_it_costs_on_pixels);
  return DONE;
}
