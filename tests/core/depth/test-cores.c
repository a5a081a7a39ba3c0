/* Cores against their definition, pixel by pixel; and what is taken over against what is found anew.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "random-levels.h"
#include "depth/depth.h"

#define SPECK 6

static Picture picture;

static void
find_regions (int region[N])
{
  static float weight[N][4];
  int          near[4];

  for (int i = 0; i < N; i++)
    for (int k = 0, n = neighbours (i, near); k < n; k++)
      weight[i][k] = picture.level[i] == picture.level[near[k]];
  flood_parts (NULL, weight, region);
}

static bool
beside_another (const int region[N], int i)
{
  int near[4];

  for (int k = 0, n = neighbours (i, near); k < n; k++)
    if (region[near[k]] != region[i])
      return true;
  return false;
}

/* Squared distance to the region's border, and of the deepest pixel of each region. */
static void
measure (const int region[N], int squared[N], int deepest[N + 1])
{
  for (int i = 0; i <= N; i++)
    deepest[i] = 0;
  for (int i = 0; i < N; i++)
    {
      squared[i] = INT32_MAX;
      for (int k = 0; k < N; k++)
        if (region[k] == region[i] && beside_another (region, k))
          {
            int d = (k % W - i % W) * (k % W - i % W) + (k / W - i / W) * (k / W - i / W);

            squared[i] = d < squared[i] ? d : squared[i];
          }
      deepest[region[i]] = squared[i] > deepest[region[i]] ? squared[i] : deepest[region[i]];
    }
}

static void
cores_are_the_deeper_half (void)
{
  for (uint32_t round = 0, r = 31; round < 25; round++)
    {
      static int region[N], squared[N], deepest[N + 1], area[N + 1], held[N + 1];
      uint8_t    fixed[N];

      random_picture (&r, &picture);
      find_regions (region);
      measure (region, squared, deepest);
      memset (area, 0, sizeof area);
      memset (held, 0, sizeof held);
      for (int i = 0; i < N; i++)
        {
          area[region[i]]++;
          held[region[i]] += picture.fixed[i];
        }
      memcpy (fixed, picture.fixed, N);
      CHECK (celd_cores_mark (W, H, picture.level, SPECK, NULL, NULL, NULL, fixed) == CELD_OK);
      for (int i = 0; i < N; i++)
        {
          bool core = !held[region[i]] && area[region[i]] >= SPECK && 4.0 * squared[i] >= deepest[region[i]] - 3.0 &&
                      squared[i] >= deepest[region[i]] / 4;

          CHECK (fixed[i] == (picture.fixed[i] ? CELD_ANCHOR : core ? CELD_CORE : CELD_FREE));
        }
    }
}

/* Marks the pixels whose level or whose neighbour's level differs. */
static void
mark_changed (const float before[N], uint8_t changed[N])
{
  int near[4];

  for (int i = 0; i < N; i++)
    {
      changed[i] = picture.level[i] != before[i];
      for (int k = 0, n = neighbours (i, near); k < n; k++)
        changed[i] = changed[i] || picture.level[near[k]] != before[near[k]];
    }
}

static void
what_did_not_change_is_taken_over (void)
{
  for (uint32_t round = 0, r = 77; round < 40; round++)
    {
      uint8_t last[N], fixed[N], anew[N], changed[N];
      float   before[N];
      int     box[4];

      random_picture (&r, &picture);
      memcpy (last, picture.fixed, N);
      CHECK (celd_cores_mark (W, H, picture.level, SPECK, NULL, NULL, NULL, last) == CELD_OK);
      for (int edit = 0; edit < 12; edit++)
        {
          memcpy (before, picture.level, sizeof before);
          random_box (&r, 6, box);
          FOR_BOX (box, x, y)
            if (edit % 3)
              picture.level[y * W + x] = (float) (edit % 4);
            else
              picture.fixed[y * W + x] = edit % 2 ? CELD_ANCHOR : CELD_FREE;
          mark_changed (before, changed);
          memcpy (fixed, picture.fixed, N);
          memcpy (anew, picture.fixed, N);
          CHECK (celd_cores_mark (W, H, picture.level, SPECK, changed, last, NULL, fixed) == CELD_OK);
          CHECK (celd_cores_mark (W, H, picture.level, SPECK, NULL, NULL, NULL, anew) == CELD_OK);
          CHECK (!memcmp (fixed, anew, N));
          memcpy (last, fixed, N);
        }
    }
}

/* The core of what does not change is not looked for: whatever `last` says is believed. */
static void
only_what_changed_is_measured (void)
{
  uint8_t last[N] = { 0 }, changed[N] = { 0 }, fixed[N] = { 0 };

  for (int i = 0; i < N; i++)
    picture.level[i] = i % W < 15;
  last[3] = CELD_CORE;  /* left, where nothing changes: a place that is no core */
  changed[N - 1] = 1;   /* right, something does */
  CHECK (celd_cores_mark (W, H, picture.level, SPECK, changed, last, NULL, fixed) == CELD_OK);
  CHECK (fixed[3] == CELD_CORE && fixed[0] == CELD_FREE);
  CHECK (fixed[N - 1] == CELD_CORE && fixed[16] == CELD_FREE);
}

int
main (void)
{
  RUN (cores_are_the_deeper_half);
  RUN (what_did_not_change_is_taken_over);
  RUN (only_what_changed_is_measured);
  return DONE;
}
