/* The exact program on scenes that can be checked by hand; random ones are in test-exact-program.py.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "exact-scene.h"

/* ------------------------------------------------------------------ known answers */

static void
paper_bends_evenly_between_two_ends (void)
{
  Scene s = scene_new ((const char *[]) { "A.........B", NULL }, "#010000 > #020000");

  CHECK (scene_solve (&s, NULL) == CELD_OK);
  for (int x = 0; x <= 10; x++)
    NEAR (depth_at (&s, x, 0), 1 - x / 10.0, 1e-6);
  NEAR (s.exact.energy, 0.05, 1e-9);
  CHECK (s.exact.n == 2 && s.exact.inequalities == 1 && s.exact.active == 1 && s.exact.violation == 0);
  NEAR (s.exact.node[0].depth, 1, 1e-12);
  NEAR (s.exact.node[1].depth, 0, 0);
  CHECK (s.exact.node[0].label == 1 && s.exact.node[0].x == 0 && s.exact.node[1].x == 10);
  scene_free (&s);
}

/* Two ends of springs: the middle one stands where the forces are equal. */
static void
what_is_free_finds_its_place (void)
{
  Scene s = scene_new ((const char *[]) { "A...B...........C", NULL }, "#010000 > #030000 +2");

  CHECK (scene_solve (&s, NULL) == CELD_OK);
  NEAR (depth_at (&s, 4, 0), 1.5, 1e-6);
  scene_free (&s);
}

static const char *const two_rooms[] = {
  "...........#...........",
  ".AAAA......#.....BBB...",
  "...........#...........",
  "...........#...........",
  "...........#...........",
  NULL
};

static void
depth_steps_at_contours (void)
{
  Scene s = scene_new (two_rooms, "#020000 > #010000");

  CHECK (scene_solve (&s, NULL) == CELD_OK);
  NEAR (depth_at (&s, 10, 4), 0, 1e-3);
  NEAR (depth_at (&s, 12, 4), 1, 1e-3);
  NEAR (depth_at (&s, 1, 1), 0, 0);
  NEAR (depth_at (&s, 17, 1), 1, 0);
  scene_free (&s);
}

/* The same room is in front of itself at the other side: it bends. */
static void
a_circle_of_regions_bends (void)
{
  Scene s = scene_new (two_rooms, "1,4 > 22,0; 12,4 > 9,0");

  s.seeds.data[23 + 1] = 0;
  CHECK (scene_solve (&s, NULL) == CELD_OK);
  CHECK (s.exact.n_cycles == 0 && s.problems.n == 0 && s.exact.n == 6);
  CHECK (depth_at (&s, 1, 4) - depth_at (&s, 22, 0) > 1 - 1e-6);
  CHECK (depth_at (&s, 12, 4) - depth_at (&s, 9, 0) > 1 - 1e-6);
  scene_free (&s);
}

static void
a_circle_of_scribbles_is_named (void)
{
  Scene s = scene_new (two_rooms, "#010000 > #020000 @2; #020000 > #010000; 4,4 > #020000");

  CHECK (scene_solve (&s, NULL) == CELD_OK);
  CHECK (s.exact.n_cycles == 1 && s.exact.cycle[0].n == 2);
  CHECK (s.exact.cycle[0].item[0] == 1 && s.exact.cycle[0].item[1] == 0);
  CHECK (s.problems.n == 1 && s.problems.item[0].kind == CELD_PROBLEM_CONTRADICTION &&
         s.problems.item[0].relation == 1);
  CHECK (depth_at (&s, 1, 1) - depth_at (&s, 18, 1) >= 1);
  scene_free (&s);
}

static void
equal_scribbles_are_one (void)
{
  const char *const rows[] = {
    "A....#.....#....C",
    ".....#..B..#.....",
    ".....#.....#..D..",
    NULL
  };
  Scene s = scene_new (rows, "#010000 = #030000; #030000 > #020000; #040000 = 0,2"), t = scene_new (rows, "");

  CHECK (scene_solve (&s, NULL) == CELD_OK);
  /* Asked for as one scribble from the beginning, and one that has the pixel. */
  t.seeds.data[16] = 1;
  t.seeds.data[2 * 17] = 4;
  scene_relate (&t, "#010000 > #020000");
  CHECK (scene_solve (&t, NULL) == CELD_OK);
  for (int i = 0; i < 3 * 17; i++)
    NEAR (s.depth.data[i], t.depth.data[i], 1e-5);
  NEAR (s.exact.energy, t.exact.energy, 1e-9 * t.exact.energy);
  NEAR (depth_at (&s, 0, 0), depth_at (&s, 16, 0), 0);
  NEAR (depth_at (&s, 0, 2), depth_at (&s, 14, 2), 0);
  scene_free (&s);
  scene_free (&t);
}

static void
strokes_of_a_colour_can_be_apart (void)
{
  const char *const rows[] = {
    "AAAA.#.....#.AAAA",
    "AAAA.#..B..#.AAAA",
    "AAAA.#.....#.AAAA",
    "AAAA.#.....#.AAAA",
    NULL
  };
  Scene s = scene_new (rows, "#020000 > 1,1; 14,1 > #020000");

  CHECK (scene_solve (&s, NULL) == CELD_OK);
  CHECK (s.exact.n_cycles == 1 && s.exact.n == 2);
  s.settings.same_colour = CELD_SAME_COLOUR_SEPARATE;
  CHECK (scene_solve (&s, NULL) == CELD_OK);
  CHECK (s.exact.n_cycles == 0 && s.exact.n == 3);
  NEAR (depth_at (&s, 0, 0), 0, 0);
  NEAR (depth_at (&s, 16, 0), 2, 1e-6);
  for (int k = 0; k < 3; k++)
    CHECK (s.exact.node[k].label == (s.exact.node[k].x == 8 ? 2u : 1u));
  scene_relate (&s, "#010000 > #020000"); /* every stroke of the colour */
  CHECK (scene_solve (&s, NULL) == CELD_OK);
  CHECK (s.exact.inequalities == 2);
  CHECK (depth_at (&s, 0, 0) >= 1 && depth_at (&s, 16, 0) >= 1);
  scene_free (&s);
}

static void
the_background_gives_way (void)
{
  const char *const rows[] = { "A...#...B...#...C", NULL };
  Scene s = scene_new (rows, "#010000 > #020000; 13,0 > #020000");

  s.palette.item[0].background = true;
  CHECK (scene_solve (&s, NULL) == CELD_OK);
  CHECK (depth_at (&s, 0, 0) - depth_at (&s, 8, 0) >= 1 && depth_at (&s, 16, 0) - depth_at (&s, 0, 0) >= 1);
  scene_relate (&s, "#030000 > #020000; 2,0 = #030000");
  s.palette.item[0].background = false;
  s.palette.item[1].background = true;
  CHECK (scene_solve (&s, NULL) == CELD_OK);
  CHECK (depth_at (&s, 0, 0) >= 1 && depth_at (&s, 16, 0) >= 1);
  NEAR (depth_at (&s, 8, 0), 0, 0);
  scene_free (&s);
}

/* ------------------------------------------------------------------ encodings */

static void
depth_has_the_encoding_asked_for (void)
{
  Scene s = scene_new ((const char *[]) { "A....B....C", NULL }, "#010000 > #020000 > #030000 +3");

  CHECK (scene_solve (&s, NULL) == CELD_OK);
  NEAR (depth_at (&s, 0, 0), 6, 1e-6);
  NEAR (depth_at (&s, 5, 0), 3, 1e-6);
  s.settings.encoding = CELD_ENCODING_NORMALIZED;
  CHECK (scene_solve (&s, NULL) == CELD_OK);
  NEAR (depth_at (&s, 0, 0), 1, 0);
  NEAR (depth_at (&s, 5, 0), 0.5, 1e-6);
  NEAR (depth_at (&s, 10, 0), 0, 0);
  s.settings.encoding = CELD_ENCODING_FIXED;
  s.settings.near_level = 11;
  s.settings.far_level = 1;
  CHECK (scene_solve (&s, NULL) == CELD_OK);
  NEAR (depth_at (&s, 0, 0), 0.5, 1e-6);
  NEAR (depth_at (&s, 10, 0), -0.1, 1e-6);
  scene_free (&s);
}

/* ------------------------------------------------------------------ input of every kind */

static void
without_relations_all_is_level (void)
{
  Scene s = scene_new ((const char *[]) { "A...#...B", NULL }, "");

  CHECK (scene_solve (&s, NULL) == CELD_OK);
  for (int x = 0; x < 9; x++)
    NEAR (depth_at (&s, x, 0), 0, 0);
  CHECK (celd_depth_exact (&s.ink, &s.seeds, &s.palette, NULL, &s.settings, NULL, &s.depth, NULL, NULL) == CELD_OK);
  scene_free (&s);
  s = scene_new ((const char *[]) { "A...#....", NULL }, ""); /* one scribble */
  s.settings.encoding = CELD_ENCODING_NORMALIZED;
  CHECK (scene_solve (&s, NULL) == CELD_OK && depth_at (&s, 8, 0) == 0 && s.exact.n == 1);
  scene_free (&s);
}

static void
without_scribbles_relations_are_enough (void)
{
  Scene s = scene_new (two_rooms, "3,3 > 20,3");

  memset (s.seeds.data, 0, 5 * 23 * sizeof (uint32_t));
  scene_palette (&s, 0);
  CHECK (scene_solve (&s, NULL) == CELD_OK);
  NEAR (depth_at (&s, 3, 3), 1, 0);
  NEAR (depth_at (&s, 3, 1), 1, 1e-3);
  NEAR (depth_at (&s, 20, 1), 0, 1e-3);
  CHECK (s.exact.n == 2 && s.exact.node[0].label == 0 && s.exact.node[0].x == 3);
  scene_relate (&s, "");
  CHECK (scene_solve (&s, NULL) == CELD_NOTHING_TO_GO_BY);
  scene_relate (&s, "1,1 > 99,1; #010000 > 3,3");
  CHECK (scene_solve (&s, NULL) == CELD_NOTHING_TO_GO_BY && s.problems.n == 0);
  scene_free (&s);
}

static void
scribbles_may_cover_everything (void)
{
  Scene s = scene_new ((const char *[]) { "AAABBB", "AAABBB", NULL }, "#020000 > #010000; 0,1 = #010000");

  CHECK (scene_solve (&s, NULL) == CELD_OK);
  for (int x = 0; x < 6; x++)
    NEAR (depth_at (&s, x, 1), x > 2, 0);
  scene_free (&s);
}

/* A colour of the palette that other paint hides. */
static void
a_hidden_scribble_does_not_count (void)
{
  Scene s = scene_new ((const char *[]) { "B...#...C", NULL }, "#010000 > #020000 +5; #030000 > #020000");

  CHECK (scene_solve (&s, NULL) == CELD_OK);
  NEAR (depth_at (&s, 0, 0), 0, 0);
  NEAR (depth_at (&s, 8, 0), 1, 1e-6);
  CHECK (s.exact.n == 3 && s.exact.node[0].x == -1);
  scene_free (&s);
}

static void
points_are_found (void)
{
  Scene s = scene_new (two_rooms, "22,4 > 0,4; 23,4 > 0,0; 11,0 > 1,1; 3,1 > 1,1; #090000 > 1,1");

  CHECK (scene_solve (&s, NULL) == CELD_OK);
  /* In the corners; outside; on ink, hence beside it; within one scribble; of no colour. */
  CHECK (s.problems.n == 3);
  CHECK (s.problems.item[0].kind == CELD_PROBLEM_OUTSIDE && s.problems.item[0].relation == 1);
  CHECK (s.problems.item[1].kind == CELD_PROBLEM_SAME_REGION && s.problems.item[1].label == 1);
  CHECK (s.problems.item[2].kind == CELD_PROBLEM_UNKNOWN_COLOUR);
  CHECK (s.exact.n == 5 && s.exact.inequalities == 2);
  CHECK (s.exact.node[4].y == 0 && abs (s.exact.node[4].x - 11) == 1);
  scene_free (&s);
}

static void
a_point_in_front_of_itself_is_reported (void)
{
  Scene s = scene_new (two_rooms, "9,4 > 9.5,4.5");

  CHECK (scene_solve (&s, NULL) == CELD_OK);
  CHECK (s.problems.n == 1 && s.problems.item[0].kind == CELD_PROBLEM_SAME_REGION && s.problems.item[0].label == 0);
  scene_free (&s);
}

static void
ink_may_be_anything (void)
{
  Scene s = scene_new (two_rooms, "#020000 > #010000; 21,3 > 0,0");

  s.ink.data[30] = NAN;
  s.ink.data[40] = INFINITY;
  s.ink.data[50] = -3;
  CHECK (scene_solve (&s, NULL) == CELD_OK);
  for (int i = 0; i < 5 * 23; i++)
    CHECK (isfinite (s.depth.data[i]));
  scene_free (&s);
}

static void
sizes_and_settings_are_checked (void)
{
  Scene      s = scene_new (two_rooms, "");
  CeldLabels small = { 22, 5, 23, s.seeds.data };
  CeldPlane  none = { 23, 5, 23, NULL };

  CHECK (celd_depth_exact (&s.ink, &small, &s.palette, NULL, &s.settings, NULL, &s.depth, NULL, NULL) == CELD_BAD_SIZE);
  CHECK (celd_depth_exact (&none, &s.seeds, &s.palette, NULL, &s.settings, NULL, &s.depth, NULL, NULL)
         == CELD_BAD_SIZE);
  s.settings.weight_floor = 0;
  CHECK (scene_solve (&s, NULL) == CELD_BAD_VALUE);
  s.settings.weight_floor = 1;
  s.settings.contrast = NAN;
  CHECK (scene_solve (&s, NULL) == CELD_BAD_VALUE);
  scene_free (&s);
}

static void
every_report_cancels (void)
{
  Scene s = scene_new (two_rooms, "#020000 > #010000; 21,3 > 0,0; #010000 > #020000");
  int   left, reports = 0;

  for (int answer = 0; answer < 100; answer++)
    {
      CeldHost   host = { check_count_down, NULL, &left };
      CeldStatus status;

      left = answer;
      s.depth.data[0] = -7;
      status = scene_solve (&s, &host);
      if (status == CELD_OK)
        break;
      CHECK (status == CELD_CANCELLED && s.problems.n == 0 && !s.exact.node && s.depth.data[0] == -7);
      reports++;
    }
  CHECK (reports > 3 && s.problems.n == 1 && s.exact.n == 4);
  scene_free (&s);
}

int
main (void)
{
  RUN (paper_bends_evenly_between_two_ends);
  RUN (what_is_free_finds_its_place);
  RUN (depth_steps_at_contours);
  RUN (a_circle_of_regions_bends);
  RUN (a_circle_of_scribbles_is_named);
  RUN (equal_scribbles_are_one);
  RUN (strokes_of_a_colour_can_be_apart);
  RUN (the_background_gives_way);
  RUN (depth_has_the_encoding_asked_for);
  RUN (without_relations_all_is_level);
  RUN (without_scribbles_relations_are_enough);
  RUN (scribbles_may_cover_everything);
  RUN (a_hidden_scribble_does_not_count);
  RUN (points_are_found);
  RUN (a_point_in_front_of_itself_is_reported);
  RUN (ink_may_be_anything);
  RUN (sizes_and_settings_are_checked);
  RUN (every_report_cancels);
  return DONE;
}
