/* What basin graphs say of known drawings, to any host, and of bad input.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "basin-drawings.h"
#include "image/image.h"
#include "segment/basins.h"

/* ------------------------------------------------------------------ known drawings */

static void
find (const char *const *rows, CeldPlane *ink, CeldBasins *basins)
{
  *ink = art_plane (rows);
  *basins = (CeldBasins) { 0 };
  CHECK (celd_basins_new (ink, THRESHOLD, NULL, basins) == CELD_OK);
}

/* The numbers of components, enclosures and merged basins must be these. */
static void
count (const char *const *rows, int stroke, size_t pieces, size_t enclosures, size_t blocks)
{
  CeldPlane  ink;
  CeldBasins basins;

  find (rows, &ink, &basins);
  NEAR (basins.stroke, stroke, 0);
  NEAR (basins.n_components, pieces, 0);
  NEAR (basins.n_enclosures, enclosures, 0);
  NEAR (basins.n_merged, blocks, 0);
  celd_basins_clear (&basins);
  free (ink.data);
}

static void
a_wall_separates_components_and_a_gap_enclosures (void)
{
  static const char *const walled[] = {
    ".......#.......", ".......#.......", ".......#.......", ".......#.......", ".......#.......", NULL
  };
  static const char *const gap[] = {
    ".......#.......", ".......#.......", "...............", ".......#.......", ".......#.......", NULL
  };
  static const char *const door[] = {
    ".......#.......", "...............", "...............", "...............", ".......#.......", NULL
  };
  static const char *const door_in_thick_walls[] = {
    "..........###..........", "..........###..........", "..........###..........", ".......................",
    ".......................", ".......................", "..........###..........", "..........###..........",
    "..........###..........", NULL
  };
  static const char *const gap_at_frame[] = {
    "...............", ".......#.......", ".......#.......", ".......#.......", ".......#.......", NULL
  };

  count (walled, 1, 2, 2, 2);
  count (gap, 1, 1, 2, 2);
  count (door, 1, 1, 1, 2);
  count (door_in_thick_walls, 3, 1, 2, 2);
  count (gap_at_frame, 1, 1, 1, 1);
}

/* Nothing is wider there than the passage that leads to it. */
static void
a_corridor_and_a_corner_stay_with_their_enclosure (void)
{
  static const char *const corridor[] = {
    "####################", "#........###########", "#........###########", "#........###########",
    "#................###", "#................###", "#........###########", "#........###########",
    "####################", NULL
  };
  static const char *const corner[] = {
    "................##", "..............####", "............######", "..........########", NULL
  };
  CeldPlane                ink;
  CeldBasins               basins;

  find (corridor, &ink, &basins);
  CHECK (basins.n_enclosures == 1);
  for (int x = 1; x < 17; x++)
    CHECK (basins.merged[celd_basin_at (&basins, x, 5)] == basins.merged[celd_basin_at (&basins, 4, 2)]);
  celd_basins_clear (&basins);
  free (ink.data);
  find (corner, &ink, &basins);
  CHECK (basins.n_enclosures == 1);
  celd_basins_clear (&basins);
  free (ink.data);
}

/* 8-connected ink parts paper: nothing ascends between two pixels of it. */
static void
a_diagonal_line_of_one_pixel_separates (void)
{
  CeldPlane  ink = { 60, 40, 60, malloc (60 * 40 * sizeof (float)) };
  CeldBasins basins = { 0 };
  int        wrong = 0;

  for (int p = 0; p < 60 * 40; p++)
    ink.data[p] = p % 60 != p / 60 + 5;
  CHECK (celd_basins_new (&ink, THRESHOLD, NULL, &basins) == CELD_OK);
  CHECK (basins.n_components == 2 && basins.n_enclosures == 2 && basins.n_merged == 2);
  for (int p = 0; p < 60 * 40; p++)
    if (p % 60 != p / 60 + 5)
      wrong += (basins.component[celd_basin_at (&basins, p % 60, p / 60)] == basins.component[celd_basin_at (&basins, 0,
                                                                                                             39)])
               != (p % 60 < p / 60 + 5);
  CHECK (wrong == 0);
  celd_basins_clear (&basins);
  free (ink.data);
}

/* Its core is a region of its own among strokes 3 pixels wide; crossings of strokes are not. */
static void
a_black_disc_is_solid (void)
{
  CeldPlane  ink = { 120, 90, 120, malloc (120 * 90 * sizeof (float)) };
  CeldBasins basins = { 0 };
  uint32_t   core;

  for (int y = 0; y < 90; y++)
    for (int x = 0; x < 120; x++)
      CELD_AT (&ink, x, y) = !((x - 40) * (x - 40) + (y - 45) * (y - 45) < 20 * 20 || (x >= 80 && x < 83) ||
                               (y >= 10 && y < 13) || abs (x - y - 40) < 2);
  CHECK (celd_basins_new (&ink, THRESHOLD, NULL, &basins) == CELD_OK);
  CHECK (basins.stroke == 3);
  core = celd_basin_at (&basins, 40, 45);
  CHECK (basins.basin[core].solid && basins.component[core] == 0 && basins.enclosure[core] == 0 &&
         basins.merged[core] > 0);
  for (size_t k = 0; k < basins.n; k++)
    {
      const CeldBasin *basin = &basins.basin[k];

      CHECK (basin->solid == (basins.merged[k] == basins.merged[core]));
      CHECK (!basin->solid || (basin->x - 40) * (basin->x - 40) + (basin->y - 45) * (basin->y - 45) < 20 * 20);
    }
  CHECK (celd_basin_at (&basins, 40, 27) != core);      /* its rim goes with the paper */
  celd_basins_clear (&basins);
  free (ink.data);
}

static void
pictures_without_paper_or_ink_have_basins (void)
{
  static const char *const black[] = { "###", "###", NULL };
  static const char *const paper_cost[] = { "...", "...", NULL };
  static const char *const dot[] = { ".", NULL };
  static const char *const *const all[] = { black, paper_cost, dot };
  CeldPlane  ink;
  CeldBasins basins;

  for (int i = 0; i < 3; i++)
    {
      find (all[i], &ink, &basins);
      CHECK (basins.n == 1 && basins.n_merged == 1 && basins.n_boundaries == 0 && basins.basin[0].squared == INT32_MAX);
      CHECK (basins.basin[0].solid == (i == 0) && basins.n_components == (i > 0) && basins.n_enclosures == (i > 0));
      CHECK (basins.basin[0].area == (uint32_t) (ink.width * ink.height));
      celd_basins_clear (&basins);
      free (ink.data);
    }
}

/* ------------------------------------------------------------------ hosts, and bad input */

/* Jobs in another order make the same; a cancelled call leaves what there was. */
static void
threads_change_nothing_and_a_cancelled_update_keeps_the_old_graph (void)
{
  CeldPlane  ink = { 300, 200, 300, malloc (300 * 200 * sizeof (float)) };
  CeldHost   backwards = { NULL, check_backwards, NULL };
  CeldBasins serial = { 0 }, other = { 0 };
  uint32_t   state = 5;
  int        left = 0, round = 0;
  CeldHost   cancel = { check_count_down, NULL, &left };
  CeldRect   changed = { 140, 90, 20, 20 };

  draw_cells (&state, 25, 2, &ink);
  CHECK (celd_basins_new (&ink, THRESHOLD, NULL, &serial) == CELD_OK);
  CHECK (celd_basins_new (&ink, THRESHOLD, &backwards, &other) == CELD_OK);
  CHECK (differences (&serial, &other) == 0);
  celd_basins_clear (&other);
  while (celd_basins_new (&ink, THRESHOLD, &cancel, &other) == CELD_CANCELLED && round < 1000)
    {
      CHECK (!other.basin && !other.run && !other.n);
      left = ++round;
    }
  CHECK (round > 3 && round < 1000 && differences (&serial, &other) == 0);
  for (int y = 90; y < 110; y++)
    for (int x = 140; x < 160; x++)
      CELD_AT (&ink, x, y) = 1;
  left = round = 0;
  while (celd_basins_update (&ink, &changed, &cancel, &other) == CELD_CANCELLED && round < 1000)
    {
      CHECK (differences (&serial, &other) == 0);
      left = ++round;
    }
  celd_basins_clear (&serial);
  CHECK (round > 1 && round < 1000 && celd_basins_new (&ink, THRESHOLD, NULL, &serial) == CELD_OK);
  CHECK (differences (&serial, &other) == 0);
  celd_basins_clear (&serial);
  celd_basins_clear (&other);
  free (ink.data);
}

static void
other_sizes_are_refused (void)
{
  float      value[4] = { 0, 1, 1, 0 };
  CeldPlane  none = { 0, 2, 2, value }, missing = { 2, 2, 2, NULL }, wide = { CELD_MAX_SIDE + 1, 1, 4, value };
  CeldPlane  good = { 2, 2, 2, value }, smaller = { 2, 1, 2, value };
  CeldBasins basins = { 0 }, made = { 0 };
  CeldRect   all = { 0, 0, 2, 2 }, outside = { 2, 0, 4, 4 };

  CHECK (celd_basins_new (&none, THRESHOLD, NULL, &basins) == CELD_BAD_SIZE);
  CHECK (celd_basins_new (&missing, THRESHOLD, NULL, &basins) == CELD_BAD_SIZE);
  CHECK (celd_basins_new (&wide, THRESHOLD, NULL, &basins) == CELD_BAD_SIZE && !basins.n);
  CHECK (celd_basins_new (&good, THRESHOLD, NULL, &basins) == CELD_OK);
  CHECK (celd_basins_new (&good, THRESHOLD, NULL, &made) == CELD_OK);
  CHECK (celd_basins_update (&smaller, &all, NULL, &basins) == CELD_BAD_SIZE);
  CHECK (celd_basins_update (&good, &outside, NULL, &basins) == CELD_OK);
  CHECK (differences (&basins, &made) == 0);
  celd_basins_clear (&basins);
  celd_basins_clear (&made);
}

/* ------------------------------------------------------------------ paper as bits */

enum { W = 45, H = 21 };

/* All runs of all rows against the drawing's pixels. */
static void
check_counts (const CeldPlane *ink, const CeldBasins *basins)
{
  int wrong = 0;

  for (int y = 0; y < ink->height; y++)
    for (int x = 0; x < ink->width; x++)
      {
        uint32_t n = 0;

        wrong += celd_paper_count (basins, y, x, x) != 0;
        for (int end = x + 1; end <= ink->width; end++)
          {
            n += celd_is_paper (CELD_AT (ink, end - 1, y));
            wrong += celd_paper_count (basins, y, x, end) != n;
          }
      }
  NEAR (wrong, 0, 0);
}

static void
counts_of_paper_are_those_of_the_drawing (void)
{
  uint32_t state = 3;

  for (int round = 0; round < 40; round++)
    {
      float      pixel[(W + 2) * H];
      int        w = W - round % 17, h = H - round % 9;
      CeldPlane  ink = { w, h, W + 2, pixel };
      CeldRect   changed = { .x = (int) check_random (&state, (uint32_t) w) };
      CeldBasins basins = { .width = w, .height = h };

      changed.y = (int) check_random (&state, (uint32_t) h);
      for (int p = 0; p < (W + 2) * H; p++)
        pixel[p] = check_random (&state, 7) ? (float) check_random (&state, 21) / 20 : NAN;
      CHECK (celd_paper_new (&ink, NULL, &basins.paper) == CELD_OK);
      check_counts (&ink, &basins);
      celd_paper_update (&ink, &changed, NULL, basins.paper); /* nothing has changed */
      check_counts (&ink, &basins);
      changed.width  = 1 + (int) check_random (&state, (uint32_t) (w - changed.x));
      changed.height = 1 + (int) check_random (&state, (uint32_t) (h - changed.y));
      for (int y = changed.y; y < changed.y + changed.height; y++)
        for (int x = changed.x; x < changed.x + changed.width; x++)
          CELD_AT (&ink, x, y) = (float) check_random (&state, 2);
      celd_paper_update (&ink, &changed, NULL, basins.paper);
      check_counts (&ink, &basins);
      celd_free (basins.paper);
    }
}

int
main (void)
{
  RUN (a_wall_separates_components_and_a_gap_enclosures);
  RUN (a_corridor_and_a_corner_stay_with_their_enclosure);
  RUN (a_diagonal_line_of_one_pixel_separates);
  RUN (a_black_disc_is_solid);
  RUN (pictures_without_paper_or_ink_have_basins);
  RUN (threads_change_nothing_and_a_cancelled_update_keeps_the_old_graph);
  RUN (other_sizes_are_refused);
  RUN (counts_of_paper_are_those_of_the_drawing);
  return DONE;
}
