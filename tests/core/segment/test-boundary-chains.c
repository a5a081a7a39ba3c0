/* Boundaries across paper as chains of edges: where they run, what stops them, and that none is missed.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "scene.h"
#include "segment/closures.h"
#include "segment/task.h"

static void
find (const char *const *art, const CeldPatches *windows, Scene *s, CeldChains *chains)
{
  static const CeldPatches none = { 0 };

  scene_read (art, s);
  scene_basins (s);
  CHECK (celd_chains_find (&s->task, s->label, &s->labels, windows ? windows : &none, chains) == CELD_OK);
}

static void
a_gap_in_a_line_is_one_chain (void)
{
  static const char *const art[] = { "AAAAAAAA", "##AAAA##", "BBBABBBB", "BBBBBBBB", NULL };
  static const CeldCorner  way[] = { { 2, 2 }, { 3, 2 }, { 3, 3 }, { 4, 3 }, { 4, 2 }, { 5, 2 }, { 6, 2 } };
  Scene                    s;
  CeldChains               chains;

  find (art, NULL, &s, &chains);
  NEAR (chains.n, 1, 0);
  if (chains.n)
    {
      const CeldChain *c = &chains.item[0];

      CHECK (c->left == 1 && c->right == 2);
      CHECK (c->end[0] == CELD_CHAIN_INK && c->end[1] == CELD_CHAIN_INK);
      CHECK (c->ink[0].x == 1 && c->ink[0].y == 1 && c->ink[1].x == 6 && c->ink[1].y == 1);
      NEAR (c->n, 7, 0);
      CHECK (c->n != 7 || !memcmp (&chains.corner[c->first], way, sizeof way));
    }
  celd_chains_clear (&chains);
  scene_close (&s);
}

static void
chains_stop_at_the_frame_and_at_third_labels (void)
{
  static const char *const art[] = { "AAAABBBB", "AAAABBBB", "AAAABBBB", "CCCCCCCC", "CCCCCCCC", NULL };
  Scene                    s;
  CeldChains               chains;
  int                      ends[4] = { 0 };

  find (art, NULL, &s, &chains);
  NEAR (chains.n, 3, 0);
  for (size_t k = 0; k < chains.n; k++)
    {
      ends[chains.item[k].end[0]]++;
      ends[chains.item[k].end[1]]++;
      NEAR (chains.item[k].n, chains.item[k].left == 1 && chains.item[k].right == 2 ? 4 : 5, 0);
    }
  NEAR (ends[CELD_CHAIN_FRAME], 3, 0);
  NEAR (ends[CELD_CHAIN_JUNCTION], 3, 0);
  celd_chains_clear (&chains);
  scene_close (&s);
}

/* The only pair of labels meets in three gaps, on both sides of a hole in the line. */
static void
gaps_that_no_boundary_names_are_found (void)
{
  static const char *const art[] = { "BBBBBBBBBB", "BB##AA##BB", "BB#AAAA#BB", "BBAAAAAABB", "BB#AAAA#BB", "BB######BB",
                                     "BBBBBBBBBB", NULL };
  Scene                    s;
  CeldChains               chains;
  size_t                   edges = 0;

  find (art, NULL, &s, &chains);
  NEAR (s.basins.n_boundaries, 1, 0);
  NEAR (chains.n, 3, 0);
  for (size_t k = 0; k < chains.n; k++)
    edges += chains.item[k].n - 1;
  NEAR (edges, s.basins.boundary[0].opening, 0);
  celd_chains_clear (&chains);
  scene_close (&s);
}

/* Where four pixels meet crosswise, both ways through agree. */
static void
crossings_are_passed_one_way (void)
{
  static const char *const art[] = { "AAAAAA", "AAABBB", "AAABBB", "BBBAAA", "BBBAAA", "BBBAAA", NULL };
  Scene                    s;
  CeldChains               chains;
  size_t                   edges = 0;

  find (art, NULL, &s, &chains);
  NEAR (chains.n, 2, 0);
  for (size_t k = 0; k < chains.n; k++)
    {
      edges += chains.item[k].n - 1;
      CHECK (chains.item[k].end[0] == CELD_CHAIN_FRAME && chains.item[k].end[1] == CELD_CHAIN_FRAME);
    }
  NEAR (edges, s.basins.boundary[0].opening, 0);
  celd_chains_clear (&chains);
  scene_close (&s);
}

static void
an_island_of_a_patch_is_a_loop (void)
{
  static const char *const art[] = { "AAAAAA", "AABBAA", "AABBAA", "AAAAAA", NULL };
  static CeldPatch         item[] = { { 1, 2, 4, 2 }, { 2, 2, 4, 2 } };
  CeldPatches              windows = { item, 2, 0 };
  Scene                    s;
  CeldChains               chains;

  find (art, &windows, &s, &chains);
  NEAR (chains.n, 1, 0);
  if (chains.n)
    {
      CHECK (chains.item[0].end[0] == CELD_CHAIN_LOOP && chains.item[0].end[1] == CELD_CHAIN_LOOP);
      NEAR (chains.item[0].n, 8, 0);
    }
  celd_chains_clear (&chains);
  scene_close (&s);
}

/* Every edge between two labels on paper lies on one chain, and on one only. */
static void
each_boundary_edge_on_paper_lies_on_one_chain (void)
{
  uint32_t state = 3;

  for (int round = 0; round < 400; round++)
    {
      static const CeldPatches none = { 0 };
      int                      w = 2 + (int) check_random (&state, 30), h = 2 + (int) check_random (&state, 30);
      size_t                   edges = 0, wanted = 0;
      Scene                    s;
      CeldChains               chains;

      scene_open (w, h, &s);
      for (int y = 0; y < h; y++)
        for (int x = 0; x < w; x++)
          {
            CELD_AT (&s.labels, x, y) = (uint32_t) (2 * x / w + 2 * (2 * y / h)) + 1; /* basins are connected */
            CELD_AT (&s.ink, x, y) = check_random (&state, 4) ? 1.f : 0.f;
          }
      scene_basins (&s);
      CHECK (celd_chains_find (&s.task, s.label, &s.labels, &none, &chains) == CELD_OK);
      for (size_t k = 0; k < s.basins.n_boundaries; k++)
        wanted += s.basins.boundary[k].opening;
      for (size_t k = 0; k < chains.n; k++)
        edges += chains.item[k].n - 1;
      NEAR (edges, wanted, 0);
      celd_chains_clear (&chains);
      scene_close (&s);
    }
}

int
main (void)
{
  RUN (a_gap_in_a_line_is_one_chain);
  RUN (chains_stop_at_the_frame_and_at_third_labels);
  RUN (gaps_that_no_boundary_names_are_found);
  RUN (crossings_are_passed_one_way);
  RUN (an_island_of_a_patch_is_a_loop);
  RUN (each_boundary_edge_on_paper_lies_on_one_chain);
  return DONE;
}
