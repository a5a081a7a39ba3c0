/* What keeps a boundary from being redrawn: ink, other labels, seeds, faint lines.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "scene.h"
#include "segment/task.h"

/* Puts something on the straight line between two tips, while the old boundary makes a detour below it. */
static void
draw_detour (Scene *s)
{
  scene_open (100, 60, s);
  scene_line (s, (CeldPlace) { -5, 30.5 }, (CeldPlace) { 28, 30.5 }, 3);
  scene_line (s, (CeldPlace) { 72, 30.5 }, (CeldPlace) { 105, 30.5 }, 3);
  for (int y = 0; y < 60; y++)
    for (int x = 0; x < 100; x++)
      CELD_AT (&s->labels, x, y) = y > 30 + (x > 32 && x < 68 ? 8 : 0) ? 2 : 1;
}

static void
check_old_boundary (Scene *s)
{
  CHECK (scene_find (s, NULL) == CELD_OK);
  NEAR (s->patches.n, 0, 0);
  NEAR (s->closures.n, 1, 0);
  for (size_t i = 0; s->closures.n && i < s->closures.item[0].n; i++)
    CHECK (s->closures.item[0].place[i].y == 31 || s->closures.item[0].place[i].y == 39);
  scene_close (s);
}

static void
without_obstacles_the_detour_is_cut_short (void)
{
  Scene s;

  draw_detour (&s);
  CHECK (scene_find (&s, NULL) == CELD_OK);
  scene_apply (&s);
  NEAR (CELD_AT (&s.labels, 50, 35), 2, 0);
  scene_close (&s);
}

static void
ink_of_others_is_never_crossed_or_enclosed (void)
{
  static const double ink[] = { 0, 0.4, 0.6 }; /* the last is so thin that it counts as paper */

  for (int k = 0; k < 6; k++)
    {
      Scene s;

      draw_detour (&s);
      for (int x = 48; x < 50; x++)
        for (int y = k % 2 ? 34 : 26; y < 36; y++)
          CELD_AT (&s.ink, x, y) = (float) ink[k / 2];
      check_old_boundary (&s);
    }
}

static void
a_third_label_is_never_enclosed (void)
{
  Scene s;

  draw_detour (&s);
  for (int x = 48; x < 52; x++)
    CELD_AT (&s.labels, x, 35) = 3;
  check_old_boundary (&s);
}

static void
seeds_keep_their_label (void)
{
  Scene s;

  draw_detour (&s);
  CHECK (celd_seed_rows_paint (&s.task.seeds, 34, 50, 51, 1) == CELD_OK);
  check_old_boundary (&s);
  draw_detour (&s);
  CHECK (celd_seed_rows_paint (&s.task.seeds, 34, 50, 51, 2) == CELD_OK); /* it was overruled; now it is obeyed */
  CHECK (scene_find (&s, NULL) == CELD_OK);
  scene_apply (&s);
  NEAR (CELD_AT (&s.labels, 50, 34), 2, 0);
  scene_close (&s);
}

/* A boundary along a line that is too faint to be ink is no gap. */
static void
faint_lines_are_followed (void)
{
  Scene s;

  draw_detour (&s);
  for (int x = 29; x < 71; x++)
    for (int y = 30; y < 40; y++)
      if (CELD_AT (&s.labels, x, y) == 1 && (CELD_AT (&s.labels, x, y + 1) == 2 || CELD_AT (&s.labels, x + 1, y) == 2 ||
                                             CELD_AT (&s.labels, x - 1, y) == 2))
        CELD_AT (&s.ink, x, y) = fminf (CELD_AT (&s.ink, x, y), 0.6f);
  CHECK (scene_find (&s, NULL) == CELD_OK);
  NEAR (s.patches.n, 0, 0);
  NEAR (s.closures.n, 0, 0);
  scene_close (&s);
}

/* A stroke that a window gave back to its label, and nothing else: its boundary is a closed loop. */
static void
the_loop_round_a_patch_stays_and_a_gap_at_its_side_is_closed (void)
{
  static CeldPatch island[] = { { 20, 20, 30, 2 }, { 21, 20, 30, 2 } }, side[] = { { 31, 33, 67, 1 } };
  CeldPatches      windows = { island, 2, 0 };
  Scene            s;

  scene_open (60, 60, &s);
  scene_line (&s, (CeldPlace) { 10, 40 }, (CeldPlace) { 50, 40 }, 3);
  for (int x = 20; x < 30; x++)
    CELD_AT (&s.labels, x, 20) = CELD_AT (&s.labels, x, 21) = 2;
  CHECK (scene_find (&s, &windows) == CELD_OK);
  NEAR (s.closures.n, 0, 0);
  NEAR (s.patches.n, 0, 0);
  scene_close (&s);

  draw_detour (&s); /* basins of one label on both sides: only the patch says that there is a boundary */
  windows = (CeldPatches) { side, 1, 0 };
  CHECK (scene_find (&s, &windows) == CELD_OK);
  NEAR (s.closures.n, 1, 0);
  scene_close (&s);
}

static void
a_cancelled_call_makes_nothing (void)
{
  static const CeldPatches none = { 0 };
  CeldHost                 host = { .progress = check_refuse };
  Scene                    s;

  draw_detour (&s);
  scene_basins (&s);
  CHECK (celd_closures_find (&s.task, s.label, &s.labels, &none, &host, &s.closures, &s.patches) == CELD_CANCELLED);
  CHECK (!s.closures.item && !s.closures.n && !s.patches.item && !s.patches.n);
  scene_close (&s);
}

int
main (void)
{
  RUN (without_obstacles_the_detour_is_cut_short);
  RUN (ink_of_others_is_never_crossed_or_enclosed);
  RUN (a_third_label_is_never_enclosed);
  RUN (seeds_keep_their_label);
  RUN (faint_lines_are_followed);
  RUN (the_loop_round_a_patch_stays_and_a_gap_at_its_side_is_closed);
  RUN (a_cancelled_call_makes_nothing);
  return DONE;
}
