/* Joints of layers: parents and pivots of small pictures, whose contacts can be counted.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "layer-scene.h"

/* Finds the joints of a picture of labels, '1' being the page. */
static size_t
joints_of (const char *text, int width, int height, uint32_t page, CeldJoint *joint, uint32_t *of_label)
{
  LayerScene  s = layer_scene (width, height);
  CeldLayers *layers;
  size_t      n;

  for (int p = 0; p < width * height; p++)
    s.own.owner.data[p] = s.own.under.data[p] = (uint32_t) (text[p] - '0');
  layers = layer_scene_cut (&s, MOST_LABELS, CELD_STORE_8_BIT, false);
  n = celd_layers_count (layers);
  for (size_t k = 0; k < n; k++)
    of_label[celd_layers_item (layers, k)->label] = (uint32_t) k;
  CHECK (celd_layers_joints (layers, page, joint) == CELD_OK);
  celd_layers_free (layers);
  layer_scene_close (&s);
  return n;
}

/* A body (3) with a leg (2) behind it, an arm (4) before it, and the eye (5) of a head (6) on it. */
static void
limbs_hang_on_the_body_whatever_is_in_front (void)
{
  CeldJoint joint[MOST_LABELS];
  uint32_t  of[MOST_LABELS + 1];

  CHECK (joints_of ("1166611111"
                    "1165611111"
                    "1166611111"
                    "1333333441"
                    "1333333441"
                    "1333333111"
                    "1122111111"
                    "1122111111", 10, 8, 1, joint, of) == 6);
  CHECK (joint[of[1]].parent == CELD_NO_INDEX && joint[of[3]].parent == CELD_NO_INDEX);
  CHECK (joint[of[2]].parent == of[3] && joint[of[4]].parent == of[3] && joint[of[6]].parent == of[3]);
  CHECK (joint[of[5]].parent == of[6]);
  NEAR (joint[of[2]].x, 3, 1e-9);
  NEAR (joint[of[2]].y, 6, 1e-9);
  NEAR (joint[of[4]].x, 7, 1e-9);
  NEAR (joint[of[4]].y, 4, 1e-9);
  NEAR (joint[of[6]].x, 3.5, 1e-9);
  NEAR (joint[of[6]].y, 3, 1e-9);
  NEAR (joint[of[5]].x, 3.5, 1e-9); /* round it */
  NEAR (joint[of[5]].y, 1.5, 1e-9);
  NEAR (joint[of[3]].x, 4, 1e-9);   /* its own middle */
  NEAR (joint[of[3]].y, 4.5, 1e-9);
}

/* Between a large part (2) and one that it touches along more sides (3), a part (4) hangs on the latter; parts that
 * nothing touches, and the page, on nothing. */
static void
the_longest_contact_wins (void)
{
  CeldJoint joint[MOST_LABELS];
  uint32_t  of[MOST_LABELS + 1];

  joints_of ("2222115"
             "2222115"
             "2243111"
             "2233111", 7, 4, 1, joint, of);
  CHECK (joint[of[3]].parent == of[2] && joint[of[2]].parent == CELD_NO_INDEX);
  CHECK (joint[of[4]].parent == of[2] || joint[of[4]].parent == of[3]); /* two sides each */
  joints_of ("2222115"
             "2243111"
             "2243111"
             "2233111", 7, 4, 1, joint, of);
  CHECK (joint[of[4]].parent == of[2] && joint[of[3]].parent == of[4]);
  NEAR (joint[of[3]].x, (3 + 3 + 2.5) / 3, 1e-9);
  NEAR (joint[of[3]].y, (1.5 + 2.5 + 3) / 3, 1e-9);
  CHECK (joint[of[5]].parent == CELD_NO_INDEX);
  NEAR (joint[of[5]].x, 6.5, 1e-9);
  NEAR (joint[of[5]].y, 0.5, 1e-9);
}

/* Without a page its label is a part like others. */
static void
no_page_is_a_part (void)
{
  CeldJoint joint[MOST_LABELS];
  uint32_t  of[MOST_LABELS + 1];

  joints_of ("111213"
             "111113", 6, 2, 0, joint, of);
  CHECK (joint[of[1]].parent == CELD_NO_INDEX && joint[of[2]].parent == of[1] && joint[of[3]].parent == of[1]);
  joints_of ("111213"
             "111113", 6, 2, 1, joint, of);
  CHECK (joint[of[2]].parent == CELD_NO_INDEX && joint[of[3]].parent == CELD_NO_INDEX);
}

/* An antialiased pixel belongs to the layer that covers more of it. */
static void
shared_pixels_count_for_the_larger_share (void)
{
  for (int wide = 0; wide < 2; wide++)
    {
      LayerScene  s = layer_scene (6, 1);
      CeldLayers *layers;
      CeldJoint   joint[2];

      for (int x = 0; x < 6; x++)
        {
          CELD_AT (&s.own.owner, x, 0) = x < 3 ? 1 : 2;
          CELD_AT (&s.own.under, x, 0) = x <= 3 ? 1 : 2;
        }
      CELD_AT (&s.own.coverage, 3, 0) = wide ? 0.75f : 0.25f;
      layers = layer_scene_cut (&s, 2, CELD_STORE_FLOAT, false);
      CHECK (celd_layers_joints (layers, 0, joint) == CELD_OK);
      NEAR (joint[1].x, wide ? 3 : 4, 1e-9);
      celd_layers_free (layers);
      layer_scene_close (&s);
    }
}

/* In random pictures every way up ends at a root, the joints are between layers that touch, and there are as many roots
 * as groups of touching layers, each with the most pixels of its group. */
static void
joints_are_a_spanning_forest (void)
{
  enum { W = 9, H = 7 };
  unsigned state = 1;

  for (int turn = 0; turn < 300; turn++)
    {
      char      text[W * H + 1] = { 0 };
      CeldJoint joint[MOST_LABELS];
      uint32_t  of[MOST_LABELS + 1], group[MOST_LABELS + 1], pixels[MOST_LABELS + 1] = { 0 };
      bool      there[MOST_LABELS + 1] = { false };

      for (int p = 0; p < W * H; p++)
        {
          state = state * 1664525u + 1013904223u;
          text[p] = (char) (state >> 24 < 150 ? '1' : '1' + (int) (state >> 16) % MOST_LABELS);
          there[text[p] - '0'] = true;
          pixels[text[p] - '0']++;
        }
      joints_of (text, W, H, 1, joint, of);
      for (uint32_t l = 2; l <= MOST_LABELS; l++)
        group[l] = l;
      for (int again = 0; again < MOST_LABELS; again++)
        for (int p = 0; p < W * H; p++)
          for (int side = 0; side < 2; side++)
            {
              int q = side ? p + W : p + 1, a = text[p] - '0', b;

              if (side ? q >= W * H : q % W == 0)
                continue;
              b = text[q] - '0';
              if (a != 1 && b != 1)
                group[a] = group[b] = group[a] < group[b] ? group[a] : group[b];
            }
      for (uint32_t l = 2; l <= MOST_LABELS; l++)
        {
          size_t k = there[l] ? of[l] : 0, steps = 0, best = 0;

          if (!there[l])
            continue;
          for (; joint[k].parent != CELD_NO_INDEX && steps < MOST_LABELS; steps++)
            k = joint[k].parent;
          CHECK (steps < MOST_LABELS);
          for (uint32_t m = 2; m <= MOST_LABELS; m++)
            if (there[m] && group[m] == group[l])
              {
                best = pixels[m] > best ? pixels[m] : best;
                CHECK (m == l || joint[of[m]].parent != CELD_NO_INDEX || of[m] == k);
              }
          for (uint32_t m = 2; m <= MOST_LABELS; m++)
            if (there[m] && of[m] == k)
              CHECK (group[m] == group[l] && pixels[m] == best);
        }
    }
}

int
main (void)
{
  RUN (limbs_hang_on_the_body_whatever_is_in_front);
  RUN (the_longest_contact_wins);
  RUN (no_page_is_a_part);
  RUN (shared_pixels_count_for_the_larger_share);
  RUN (joints_are_a_spanning_forest);
  return DONE;
}
