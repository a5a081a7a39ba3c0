/* Levels of labels in a picture of levels: what most pixels of a label have.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "celdepth.h"

#include <math.h>

static void
most_pixels_decide (void)
{
  uint32_t   label[] = { 1, 1, 1, 2, 2, 3, 0, 3, 2, 0 };
  float      picture[] = { 0.5f, 9, 0.5f, -2, -2, 7, 9, 7, 9, 9 };
  CeldLabels labels = { 5, 2, 5, label };
  CeldPlane  levels = { 5, 2, 5, picture };
  float      value[4];
  uint32_t   level[4];

  CHECK (celd_label_levels (&labels, 4, &levels, value, level) == CELD_OK);
  CHECK (value[0] == 0.5f && value[1] == -2 && value[2] == 7);
  CHECK (value[3] == -2);                        /* no pixels: the farthest */
  CHECK (level[0] == 1 && level[1] == 0 && level[2] == 2 && level[3] == 0);
}

static void
equal_levels_have_one_number (void)
{
  uint32_t   label[] = { 3, 2, 1, 0 };
  float      picture[] = { 4, NAN, 4, 8 };
  CeldLabels labels = { 2, 2, 2, label };
  CeldPlane  levels = { 2, 2, 2, picture };
  float      value[3];
  uint32_t   level[3];

  CHECK (celd_label_levels (&labels, 3, &levels, value, level) == CELD_OK);
  CHECK (value[0] == 4 && value[1] == 0 && value[2] == 4);
  CHECK (level[0] == 1 && level[1] == 0 && level[2] == 1);
}

/* Of random pictures, by counting. */
static void
random_pictures_agree_with_counting (void)
{
  enum { N = 5, LEVELS = 4, SIDE = 9 };
  uint32_t   label[SIDE * SIDE], level[N], seed = 1;
  float      picture[SIDE * SIDE], value[N];
  CeldLabels labels = { SIDE, SIDE, SIDE, label };
  CeldPlane  levels = { SIDE, SIDE, SIDE, picture };

  for (int round = 0; round < 50; round++)
    {
      size_t count[N][LEVELS] = { { 0 } };

      for (int i = 0; i < SIDE * SIDE; i++)
        {
          seed       = seed * 1664525 + 1013904223;
          label[i]   = 1 + (seed >> 16) % N;
          seed       = seed * 1664525 + 1013904223;
          picture[i] = (float) ((seed >> 16) % LEVELS);
          count[label[i] - 1][(int) picture[i]]++;
        }
      CHECK (celd_label_levels (&labels, N, &levels, value, level) == CELD_OK);
      for (int k = 0; k < N; k++)
        for (int l = 0; l < LEVELS; l++)
          CHECK (count[k][(int) value[k]] >= count[k][l]);
      for (int k = 0; k < N; k++)
        for (int j = 0; j < N; j++)
          CHECK ((value[k] < value[j]) == (level[k] < level[j]));
    }
}

static void
wrong_input_is_refused (void)
{
  uint32_t   label[] = { 1, 2, 1, 1 }, level[2] = { 77, 77 };
  float      picture[4] = { 0 }, value[2] = { 77, 77 };
  CeldLabels labels = { 2, 2, 2, label };
  CeldPlane  levels = { 2, 2, 2, picture }, wide = { 4, 1, 4, picture };

  CHECK (celd_label_levels (&labels, 1, &levels, value, level) == CELD_BAD_VALUE);
  CHECK (celd_label_levels (&labels, 2, &wide, value, level) == CELD_BAD_SIZE);
  CHECK (level[0] == 77 && value[0] == 77);
}

int
main (void)
{
  RUN (most_pixels_decide);
  RUN (equal_levels_have_one_number);
  RUN (random_pictures_agree_with_counting);
  RUN (wrong_input_is_refused);
  return DONE;
}
