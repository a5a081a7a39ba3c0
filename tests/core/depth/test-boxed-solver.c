/* Stretches and parts against flooding, boxes against what groups promise.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "random-levels.h"
#include "depth/depth.h"

static Picture picture;
static float   weight[N][4];

static void
weigh (bool levels_alone)
{
  int near[4];

  for (int i = 0; i < N; i++)
    for (int k = 0, n = neighbours (i, near); k < n; k++)
      weight[i][k] = levels_alone ? picture.level[i] == picture.level[near[k]]
                                  : plain_weight (&picture, 25, 1, i, near[k]);
}

static void
components_are_those_of_a_flood_fill (void)
{
  for (uint32_t round = 0, r = 5; round < 60; round++)
    {
      CeldPlane         ink = ink_of (&picture);
      CeldDepthEdges    edges = { &ink, 0.25f, 1, NULL };
      CeldRunComponents parts = { 0 };
      bool              regions = round % 2;
      int               part[N], n, covered = 0;

      random_picture (&r, &picture);
      weigh (regions);
      n = flood_parts (regions ? NULL : picture.fixed, weight, part);
      CHECK (celd_run_components_find (W, H, picture.level, regions ? NULL : picture.fixed, regions ? NULL : &edges,
                                       NULL, &parts) == CELD_OK);
      CHECK (parts.n == (size_t) n);
      for (int y = 0; y < H; y++)
        for (size_t i = parts.row[y]; i < parts.row[y + 1]; i++)
          for (int x = parts.run[i].x; x < parts.run[i].end; x++, covered++)
            CHECK (part[y * W + x] == (int) parts.run[i].component + 1);
      for (int i = 0; i < N; i++)
        covered -= part[i] != 0;
      CHECK (covered == 0);
      celd_run_components_clear (&parts);
    }
}

static void
groups_hold_their_boxes (void)
{
  for (uint32_t round = 0, r = 9; round < 50; round++)
    {
      CeldRect box[200], bounds[CELD_MOST_GROUPS];
      uint32_t group[200];
      size_t   n = check_random (&r, 200), groups;
      int      side = round % 2 ? 4000 : 90;

      for (size_t k = 0; k < n; k++)
        box[k] = (CeldRect) { (int) check_random (&r, (uint32_t) side), (int) check_random (&r, (uint32_t) side),
                              (int) check_random (&r, 60), 1 + (int) check_random (&r, 60) };
      groups = celd_boxes_group (box, n, group, bounds);
      CHECK (groups <= CELD_MOST_GROUPS);
      for (size_t k = 0; k < n; k++)
        {
          CHECK ((group[k] == CELD_NO_GROUP) == !box[k].width);
          if (!box[k].width)
            continue;
          CHECK (group[k] < groups);
          CHECK (box[k].x >= bounds[group[k]].x && box[k].y >= bounds[group[k]].y);
          CHECK (box[k].x + box[k].width <= bounds[group[k]].x + bounds[group[k]].width);
          CHECK (box[k].y + box[k].height <= bounds[group[k]].y + bounds[group[k]].height);
        }
    }
}

static void
boxes_far_apart_stay_apart (void)
{
  CeldRect box[3] = { { 0, 0, 100, 100 }, { 3000, 3000, 100, 100 }, { 50, 50, 90, 90 } }, bounds[CELD_MOST_GROUPS];
  uint32_t group[3];

  CHECK (celd_boxes_group (box, 3, group, bounds) == 2);
  CHECK (group[0] == group[2] && group[0] != group[1]);
}

int
main (void)
{
  RUN (components_are_those_of_a_flood_fill);
  RUN (groups_hold_their_boxes);
  RUN (boxes_far_apart_stay_apart);
  return DONE;
}
