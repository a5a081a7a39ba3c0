/* What paint weighs, in which order labels are separated, and which paint of a flat colouring counts.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "segment/basins.h"
#include "segment/task.h"
#include "sketch.h"
#include "solve/maxflow.h"

enum { W = 19, H = 13 };

/* Boxes of paint in five labels, and of ink. */
static void
random_sketch (uint32_t *state, char paper[H][W + 1], char painted[H][W + 1])
{
  memset (paper, 0, H * (W + 1));
  memset (painted, 0, H * (W + 1));
  for (int y = 0; y < H; y++)
    {
      memset (paper[y], '1', W);
      memset (painted[y], '.', W);
    }
  for (int k = 0; k < 12; k++)
    {
      int  left = (int) check_random (state, W), top = (int) check_random (state, H);
      int  w = 1 + (int) check_random (state, 9), h = 1 + (int) check_random (state, 5);
      bool inked = k % 3 == 2;

      for (int y = top; y < top + h && y < H; y++)
        for (int x = left; x < left + w && x < W; x++)
          if (inked)
            paper[y][x] = '#';
          else
            painted[y][x] = (char) (k % 2 ? 'B' + check_random (state, 4) : 'A');
    }
}

static void
open_random (uint32_t *state, Sketch *s)
{
  char        paper[H][W + 1], painted[H][W + 1];
  const char *paper_rows[H + 1] = { NULL }, *painted_rows[H + 1] = { NULL };

  random_sketch (state, paper, painted);
  for (int y = 0; y < H; y++)
    {
      paper_rows[y] = paper[y];
      painted_rows[y] = painted[y];
    }
  sketch_open (s, paper_rows, painted_rows, 6);
}

/* ------------------------------------------------------------------ weight */

/* Twice the painted area over the number of neighbouring pixels of different labels. */
static double
slow_brush (const CeldLabels *seeds)
{
  size_t area = 0, outline = 0;

  for (int y = 0; y < seeds->height; y++)
    for (int x = 0; x < seeds->width; x++)
      {
        uint32_t l = CELD_AT (seeds, x, y);

        area    += l != 0;
        outline += x + 1 < seeds->width && l != CELD_AT (seeds, x + 1, y);
        outline += y + 1 < seeds->height && l != CELD_AT (seeds, x, y + 1);
      }
  return outline ? fmax (1, 2.0 * (double) area / (double) outline) : 20;
}

static void
check_weight (Sketch *s)
{
  CeldLabels seeds = { s->ink.width, s->ink.height, (size_t) s->ink.width, NULL };

  seeds.data = malloc ((size_t) (seeds.width * seeds.height) * sizeof *seeds.data);
  celd_seed_rows_write (&s->task.seeds, &seeds);
  s->basins.costs.paper_cost = 5e5; /* so that data costs differ well between widths */
  s->settings.hardness  = 1;
  celd_task_set_soft_cost (&s->task);
  NEAR (s->task.soft_cost, floor (CELD_COST_UNIT * 5e5 * 20 / slow_brush (&seeds)), 0);
  free (seeds.data);
}

static void
paint_weighs_by_the_width_of_its_strokes (void)
{
  static const char *const all[] = { "AAA", "AAA", NULL }, *const none[] = { "...", "...", NULL };
  static const char *const two[] = { "ABB", "A.B", NULL }, *const paper[] = { "111", "111", NULL };
  uint32_t                 state = 3;
  Sketch                   s;

  for (int round = 0; round < 300; round++)
    {
      open_random (&state, &s);
      check_weight (&s);
      sketch_close (&s);
    }
  sketch_open (&s, paper, all, 1);
  check_weight (&s);
  sketch_close (&s);
  sketch_open (&s, paper, none, 1);
  check_weight (&s);
  sketch_close (&s);
  sketch_open (&s, paper, two, 2);
  check_weight (&s);
  sketch_close (&s);
}

/* A data cost is at least 1, and small enough for sums to be exact. */
static void
data_costs_keep_their_bounds (void)
{
  static const char *const paper[] = { "1111", "1111", NULL }, *const painted[] = { "A...", "BB..", NULL };
  Sketch                   s;

  sketch_open (&s, paper, painted, 2);
  s.basins.costs.paper_cost = 1e12;
  celd_task_set_soft_cost (&s.task);
  NEAR (s.task.soft_cost, 1 << 28, 0);
  s.basins.costs.paper_cost = 1e-12;
  celd_task_set_soft_cost (&s.task);
  NEAR (s.task.soft_cost, 1, 0);
  NEAR (celd_task_data_cost (&s.task, 1), 1, 0);
  s.task.palette.item[1].hard = true;
  NEAR (celd_task_data_cost (&s.task, 1), 1, 0);
  NEAR (celd_task_data_cost (&s.task, 2), CELD_HARD, 0);
  s.settings.hardness = 1;
  NEAR (celd_task_data_cost (&s.task, 1), CELD_HARD, 0);
  s.settings.hardness = 0.05f;
  s.settings.flats    = true;
  NEAR (celd_task_data_cost (&s.task, 1), CELD_HARD, 0);
  sketch_close (&s);
}

static void
labels_are_cut_in_the_order_of_falling_paint (void)
{
  static const char *const paper[] = { "1111", "1111", NULL }, *const painted[] = { "ABBB", "C.DD", NULL };
  uint32_t                 order[5] = { 0 };
  Sketch                   s;

  sketch_open (&s, paper, painted, 5);
  CHECK (celd_task_label_order (&s.task, order) == CELD_OK);
  CHECK (order[0] == 2 && order[1] == 4 && order[2] == 1 && order[3] == 3 && order[4] == 5);
  sketch_close (&s);
}

/* ------------------------------------------------------------------ flat colourings */

static void
check_kept (const char *const *paper, const char *const *painted, int stroke, const char *const *kept)
{
  Sketch s;

  sketch_open (&s, paper, painted, 3);
  s.basins.stroke = stroke;
  CHECK (celd_task_drop_ink_seeds (&s.task) == CELD_OK);
  NEAR (seeds_differing (&s.task.seeds, kept), 0, 0);
  sketch_close (&s);
}

/* A goes over a line and counts beside it; B is nothing but a line; C is a dark area, but only for thin strokes. */
static void
paint_on_lines_of_a_flat_colouring_is_dropped (void)
{
  static const char *const paper[] = { "111##111##########", "1111#111##########", "1#11##############", NULL };
  static const char *const painted[] = { "AAAAAAA.BB.CCCCCCC", "AAAAA....B.CCCCCCC", "AAAA......CCCCCCCC", NULL };
  static const char *const kept[] = { "AAA..AA....CCCCCCC", "AAAA.......CCCCCCC", "A.AA......CCCCCCCC", NULL };
  static const char *const none[] = { "AAA..AA...........", "AAAA..............", "A.AA..............", NULL };

  check_kept (paper, painted, 2, kept);
  check_kept (paper, painted, 3, none);
}

/* One pixel of twenty on paper is too much for a dark area. */
static void
dark_areas_are_on_ink (void)
{
  static const char *const paper[] = { "#####1####", "##########", NULL };
  static const char *const nearly[] = { ".....A....", "..........", NULL };
  static const char *const twenty[] = { "AAAAAAAAAA", "AAAAAAAAAA", NULL };
  static const char *const black[] = { "##########", "##########", NULL };

  check_kept (paper, twenty, 1, nearly);
  check_kept (black, twenty, 1, twenty);
}

static void
kept_seeds_are_those_of_the_pixels (void)
{
  uint32_t state = 9;

  for (int round = 0; round < 300; round++)
    {
      size_t       pixels[7] = { 0 }, on_paper[7] = { 0 }, sides[7] = { 0 };
      CeldSeedRows before;
      int          wrong = 0;
      Sketch       s;

      open_random (&state, &s);
      CHECK (celd_seed_rows_copy (&s.task.seeds, &before) == CELD_OK);
      CHECK (celd_task_drop_ink_seeds (&s.task) == CELD_OK);
      for (int p = 0; p < W * H; p++)
        {
          uint32_t l = celd_seed_rows_at (&before, p % W, p / W);

          pixels[l]++;
          on_paper[l] += s.ink.data[p] > 0;
          sides[l]    += p % W == 0 || celd_seed_rows_at (&before, p % W - 1, p / W) != l;
        }
      for (int p = 0; p < W * H; p++)
        {
          uint32_t l = celd_seed_rows_at (&before, p % W, p / W);
          bool     stays = s.ink.data[p] > 0 || (20 * on_paper[l] < pixels[l] && pixels[l] > 3 * sides[l]);

          wrong += celd_seed_rows_at (&s.task.seeds, p % W, p / W) != (stays ? l : 0);
        }
      NEAR (wrong, 0, 0);
      celd_seed_rows_clear (&before);
      sketch_close (&s);
    }
}

int
main (void)
{
  RUN (paint_weighs_by_the_width_of_its_strokes);
  RUN (data_costs_keep_their_bounds);
  RUN (labels_are_cut_in_the_order_of_falling_paint);
  RUN (paint_on_lines_of_a_flat_colouring_is_dropped);
  RUN (dark_areas_are_on_ink);
  RUN (kept_seeds_are_those_of_the_pixels);
  return DONE;
}
