/* Seeds by row: what painting splits and joins, and that they are the pixels that were painted.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "image/image.h"

/* The seeds must be these pixels: in runs that do not touch, but for those of another label; and no empty ones. */
static void
check_seeds (const CeldSeedRows *seeds, const CeldLabels *wanted)
{
  CeldLabels written = { wanted->width, wanted->height, (size_t) wanted->width + 3, NULL };
  int        wrong = 0;

  written.data = malloc (written.stride * (size_t) wanted->height * sizeof *written.data);
  memset (written.data, 0xff, written.stride * (size_t) wanted->height * sizeof *written.data);
  celd_seed_rows_write (seeds, &written);
  for (int y = 0; y < wanted->height; y++)
    {
      const CeldSeedRow *row = &seeds->row[y];

      for (int x = 0; x < wanted->width; x++)
        {
          wrong += CELD_AT (&written, x, y) != CELD_AT (wanted, x, y);
          wrong += celd_seed_rows_at (seeds, x, y) != CELD_AT (wanted, x, y);
        }
      for (int x = wanted->width; x < (int) written.stride; x++)
        wrong += CELD_AT (&written, x, y) != UINT32_MAX;
      for (size_t i = 0; i < row->n; i++)
        {
          wrong += row->run[i].x < 0 || row->run[i].end > wanted->width || row->run[i].x >= row->run[i].end;
          wrong += i && row->run[i - 1].end > row->run[i].x;
          wrong += i && row->run[i - 1].end == row->run[i].x && row->run[i - 1].label == row->run[i].label;
        }
    }
  NEAR (wrong, 0, 0);
  free (written.data);
}

/* One row, a run of a label painted over it, and what it is then. */
static void
paint (const char *before, int x, int end, uint32_t label, const char *after, size_t runs)
{
  const char  *rows[] = { before, NULL }, *wanted_rows[] = { after, NULL };
  CeldLabels   labels = art_labels (rows), wanted = art_labels (wanted_rows);
  CeldSeedRows seeds = { 0 };

  CHECK (celd_seed_rows_read (&labels, &seeds) == CELD_OK);
  check_seeds (&seeds, &labels);
  CHECK (celd_seed_rows_paint (&seeds, 0, x, end, label) == CELD_OK);
  check_seeds (&seeds, &wanted);
  NEAR (seeds.row[0].n, runs, 0);
  celd_seed_rows_clear (&seeds);
  free (labels.data);
  free (wanted.data);
}

static void
paint_splits_what_it_covers (void)
{
  paint ("........", 2, 5, 1, "..AAA...", 1);
  paint (".AAAAAA.", 3, 5, 2, ".AABBAA.", 3);
  paint (".AAAAAA.", 3, 5, 0, ".AA..AA.", 2);
  paint (".AABBCC.", 2, 6, 4, ".ADDDDC.", 3);
  paint (".AABBCC.", 1, 7, 4, ".DDDDDD.", 1);
  paint ("A.B.C.DD", 0, 8, 0, "........", 0);
}

static void
runs_of_one_label_that_touch_are_one (void)
{
  paint (".AA..AA.", 3, 5, 1, ".AAAAAA.", 1);
  paint (".AA..BB.", 3, 5, 1, ".AAAABB.", 2);
  paint (".AA..BB.", 3, 5, 2, ".AABBBB.", 2);
  paint (".AABBAA.", 3, 5, 1, ".AAAAAA.", 1);
  paint (".AABBAA.", 2, 4, 1, ".AAABAA.", 3);
  paint (".AAAAAA.", 3, 5, 1, ".AAAAAA.", 1);
  paint (".AAAAAA.", 0, 8, 1, "AAAAAAAA", 1);
}

static void
paint_is_cut_to_the_picture (void)
{
  CeldSeedRows seeds = { 0 };

  paint (".A......", -5, 1, 1, "AA......", 1);
  paint ("......A.", 7, 99, 2, "......AB", 2);
  paint (".A......", 3, 3, 2, ".A......", 1);
  paint (".A......", 5, 2, 2, ".A......", 1);
  paint (".A......", 8, 12, 2, ".A......", 1);
  CHECK (celd_seed_rows_new (4, 2, &seeds) == CELD_OK);
  CHECK (celd_seed_rows_paint (&seeds, -1, 0, 4, 1) == CELD_OK);
  CHECK (celd_seed_rows_paint (&seeds, 2, 0, 4, 1) == CELD_OK);
  CHECK (!seeds.row[0].n && !seeds.row[1].n);
  celd_seed_rows_clear (&seeds);
  celd_seed_rows_clear (&seeds);
}

/* Random paint on pixels and on rows is the same, and so is a copy, which goes its own way from then on. */
static void
rows_are_the_pixels_that_were_painted (void)
{
  uint32_t state = 11, pixel[3 * 40];

  for (int round = 0; round < 100; round++)
    {
      CeldLabels   labels = { 40, 3, 40, pixel };
      CeldSeedRows seeds = { 0 }, copy = { 0 };

      memset (pixel, 0, sizeof pixel);
      CHECK (celd_seed_rows_new (40, 3, &seeds) == CELD_OK);
      for (int k = 0; k < 60; k++)
        {
          int      y = (int) check_random (&state, 3), x = (int) check_random (&state, 44) - 2;
          int      end = x + (int) check_random (&state, k % 4 ? 5 : 20);
          uint32_t label = check_random (&state, 4);

          CHECK (celd_seed_rows_paint (&seeds, y, x, end, label) == CELD_OK);
          for (int i = x < 0 ? 0 : x; i < end && i < 40; i++)
            CELD_AT (&labels, i, y) = label;
        }
      check_seeds (&seeds, &labels);
      CHECK (celd_seed_rows_copy (&seeds, &copy) == CELD_OK);
      for (int x = 0; x < 40; x += 2)
        CHECK (celd_seed_rows_paint (&seeds, 1, x, x + 1, 9) == CELD_OK);
      check_seeds (&copy, &labels);
      for (int x = 0; x < 40; x += 2)
        {
          CHECK (celd_seed_rows_paint (&copy, 1, x, x + 1, 7) == CELD_OK);
          CELD_AT (&labels, x, 1) = 7;
        }
      check_seeds (&copy, &labels);
      celd_seed_rows_clear (&seeds);
      celd_seed_rows_clear (&copy);
    }
}

/* A copy has no room to spare: fewer runs than before must not make it lose the last ones. */
static void
a_copy_keeps_what_lies_behind_a_long_stroke (void)
{
  const char  *rows[] = { "ABABABABABABABABABABABABABABABABABABABAB", NULL };
  const char  *wanted_rows[] = { "CCCCCCCCCCCCCCCCCCCCCCCCCCCCCCCCCBABABAB", NULL };
  CeldLabels   labels = art_labels (rows), wanted = art_labels (wanted_rows);
  CeldSeedRows seeds = { 0 }, copy = { 0 };

  CHECK (celd_seed_rows_read (&labels, &seeds) == CELD_OK);
  CHECK (celd_seed_rows_copy (&seeds, &copy) == CELD_OK);
  CHECK (celd_seed_rows_paint (&copy, 0, 0, 33, 3) == CELD_OK);
  check_seeds (&copy, &wanted);
  check_seeds (&seeds, &labels);
  celd_seed_rows_clear (&seeds);
  celd_seed_rows_clear (&copy);
  free (labels.data);
  free (wanted.data);
}

int
main (void)
{
  RUN (paint_splits_what_it_covers);
  RUN (runs_of_one_label_that_touch_are_one);
  RUN (paint_is_cut_to_the_picture);
  RUN (rows_are_the_pixels_that_were_painted);
  RUN (a_copy_keeps_what_lies_behind_a_long_stroke);
  return DONE;
}
