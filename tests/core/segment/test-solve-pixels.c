/* Random walker segmentation: known boundaries, and the bases of the exact program.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "depth/depth.h"
#include "image/image.h"
#include "segment/task.h"
#include "solve/laplace.h"

/* Labels of a picture in which capitals are seeds on paper and '#' is ink. */
static CeldLabels
walk (const char *const *rows, size_t n_labels)
{
  CeldPlane       ink = art_plane (rows);
  CeldLabels      labels = art_labels (rows);
  CeldSettings    settings = celd_settings ();
  CeldSegmentTask task = { .settings = &settings, .ink = &ink,
                          .palette = { calloc (n_labels, sizeof (CeldRegion)), n_labels } };

  CHECK (celd_seed_rows_read (&labels, &task.seeds) == CELD_OK);
  CHECK (celd_random_walker_solve (&task, NULL, &labels) == CELD_OK);
  celd_seed_rows_clear (&task.seeds);
  celd_palette_clear (&task.palette);
  free (ink.data);
  return labels;
}

static void
the_boundary_is_half_way (void)
{
  CeldLabels labels = walk ((const char *[]) { "A.......B", NULL }, 2);

  for (int x = 0; x < 9; x++)
    CHECK (labels.data[x] == (x < 5 ? 1u : 2u)); /* the first of two that are alike */
  free (labels.data);
}

static void
walkers_stay_within_contours (void)
{
  CeldLabels labels = walk ((const char *[]) {
    "B.......#.......",
    "........#.....A.",
    "........#.......",
    "........#.......",
    NULL }, 3); /* a label without a seed gets nothing */

  for (int y = 0; y < 4; y++)
    for (int x = 0; x < 16; x++)
      if (x != 8)
        CHECK (CELD_AT (&labels, x, y) == (x < 8 ? 2u : 1u));
  free (labels.data);
}

static void
a_single_label_gets_every_pixel (void)
{
  CeldLabels labels = walk ((const char *[]) { "...#.B..#", NULL }, 2);

  for (int x = 0; x < 9; x++)
    CHECK (labels.data[x] == 2);
  free (labels.data);
}

/* More labels than lanes: each pixel has one of the largest bases. */
static void
the_likeliest_label_wins (void)
{
  uint32_t seed = 6;

  for (int trial = 0; trial < 12; trial++)
    {
      enum { W = 30, H = 24, MOST = 21 };
      static float    value[W * H], east[W * H], south[W * H];
      static uint32_t painted[W * H], found[W * H];
      CeldPlane       ink = { W, H, W, value };
      CeldLabels      seeds = { W, H, W, painted }, labels = { W, H, W, found };
      CeldSettings    settings = celd_settings ();
      CeldSegmentTask   task = { .settings = &settings, .ink = &ink };
      CeldHarmonicBases bases = { .width = W, .height = H, .east = east, .south = south };
      CeldSolve       solve;
      double          mean;
      uint32_t        n = 2 + check_random (&seed, MOST - 1);

      task.palette = (CeldPalette) { calloc (n, sizeof (CeldRegion)), n };
      for (int i = 0; i < W * H; i++)
        {
          value[i]   = check_random (&seed, 5) ? 1 : (float) check_random (&seed, 10) / 10;
          painted[i] = 0;
        }
      for (uint32_t k = 0; k < n; k++)
        painted[k * (W * H / n) + check_random (&seed, W * H / n)] = k + 1;
      CHECK (celd_seed_rows_read (&seeds, &task.seeds) == CELD_OK);
      CHECK (celd_random_walker_solve (&task, NULL, &labels) == CELD_OK);
      CHECK (celd_affinities (&ink, settings.contrast, settings.weight_floor, NULL, east, south, &mean) == CELD_OK);
      CHECK (celd_bases_make (&bases, painted, n, NULL, 0, 1e-6, NULL, &solve) == CELD_OK);
      for (size_t i = 0; i < W * H; i++)
        {
          double likely[MOST + 1], best = 0;

          likely[0] = 1;
          for (size_t k = 1; k < n; k++)
            {
              likely[k]  = (double) bases.group[(k - 1) / CELD_LANES][i * CELD_LANES + (k - 1) % CELD_LANES];
              likely[0] -= likely[k];
            }
          for (size_t k = 0; k < n; k++)
            best = fmax (best, likely[k]);
          CHECK (found[i] >= 1 && found[i] <= n && likely[found[i] - 1] >= best - 0.005);
          CHECK (!painted[i] || found[i] == painted[i]);
        }
      celd_bases_clear (&bases);
      celd_seed_rows_clear (&task.seeds);
      celd_palette_clear (&task.palette);
    }
}

/* Through the whole step: the frame's background and arrows' regions come as with the other methods. */
static void
the_segmentation_step_offers_the_random_walker (void)
{
  const char *const rows[] = {
    "....................",
    "..##########........",
    "..#........#........",
    "..#.AAA....#........",
    "..#........#........",
    "..##########........",
    "....................",
    NULL
  };
  CeldPlane         ink = art_plane (rows);
  CeldLabels        labels = art_labels (rows);
  CeldSettings      settings = celd_settings ();
  CeldPalette       palette = { calloc (1, sizeof (CeldRegion)), 1 };

  palette.item[0].colour[3] = 255;
  settings.method = CELD_METHOD_WALKER;
  CHECK (celd_segment (&ink, &labels, NULL, &settings, NULL, &labels, &palette, NULL) == CELD_OK);
  CHECK (palette.n == 2 && palette.item[1].background);
  CHECK (CELD_AT (&labels, 8, 3) == 1 && CELD_AT (&labels, 0, 0) == 2 && CELD_AT (&labels, 18, 4) == 2);
  celd_palette_clear (&palette);
  free (ink.data);
  free (labels.data);
}

int
main (void)
{
  RUN (the_boundary_is_half_way);
  RUN (walkers_stay_within_contours);
  RUN (a_single_label_gets_every_pixel);
  RUN (the_likeliest_label_wins);
  RUN (the_segmentation_step_offers_the_random_walker);
  return DONE;
}
