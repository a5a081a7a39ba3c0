/* Labels on the basin graph: parts behind necks, gaps, majorities, and the energy against exact cuts on pixels.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "image/image.h"
#include "scene.h"
#include "segment/basins.h"
#include "segment/task.h"

typedef struct
{
  CeldPlane       ink;
  CeldSettings    settings;
  CeldBasins      basins;
  CeldSegmentTask task;
  uint32_t       *label;
} Page;

/* `painted`: 'A' is a seed of label 1 and so on, of n labels. */
static void
page_open (Page *p, const char *const *drawing, const char *const *painted, size_t n)
{
  CeldLabels seeds = art_labels (painted);
  uint32_t   label;

  *p = (Page) { .ink = art_plane (drawing), .settings = celd_settings () };
  CHECK (celd_basins_new (&p->ink, p->settings.ink_threshold, NULL, &p->basins) == CELD_OK);
  p->task = (CeldSegmentTask) { .settings = &p->settings, .ink = &p->ink, .basins = &p->basins };
  CHECK (celd_seed_rows_read (&seeds, &p->task.seeds) == CELD_OK);
  for (size_t k = 0; k < n; k++)
    {
      CeldRegion region = { .colour = { (uint8_t) (40 * k), 0, 0, 255 } };

      CHECK (celd_task_add_label (&p->task, region, &label) == CELD_OK);
    }
  celd_task_set_soft_cost (&p->task);
  p->label = calloc (p->basins.n, sizeof *p->label);
  free (seeds.data);
}

static void
page_close (Page *p)
{
  free (p->ink.data);
  free (p->label);
  celd_task_clear (&p->task);
  celd_basins_clear (&p->basins);
}

static uint32_t
label_at (const Page *p, int x, int y)
{
  return p->label[celd_basin_at (&p->basins, x, y)];
}

static void
solve (Page *p)
{
  CHECK (celd_basin_graph_solve (&p->task, NULL, p->label) == CELD_OK);
  for (size_t k = 0; k < p->basins.n; k++)
    CHECK (p->label[k] >= 1 && p->label[k] <= p->task.palette.n);
}

/* An enclosure on the left, joined to an enclosure on the right by a neck of two pixels; all else is outside. */
static const char *const neck[] = {
  "..............................",
  "..############..############..",
  "..#..........#..#..........#..",
  "..#..........####..........#..",
  "..#........................#..",
  "..#........................#..",
  "..#..........####..........#..",
  "..#..........#..#..........#..",
  "..############..############..",
  "..............................", NULL };

static void
a_part_behind_a_neck_follows_its_enclosure (void)
{
  static const char *const painted[] = {
    "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAA",
    "..............................", "..............................", "..............................",
    ".....BBB......................",
    "..............................", "..............................", "..............................",
    "..............................", "..............................", NULL };
  Page                     p;

  page_open (&p, neck, painted, 2);
  solve (&p);
  CHECK (label_at (&p, 5, 5) == 2 && label_at (&p, 14, 4) == 2 && label_at (&p, 22, 5) == 2);
  CHECK (label_at (&p, 14, 0) == 1 && label_at (&p, 14, 9) == 1);
  page_close (&p);
}

/* A speck of paint against the whole page: a cut of two pixels of paper would save the speck's data costs, and more. */
static void
a_part_with_paint_of_its_own_keeps_it (void)
{
  static const char *const painted[] = {
    "..............................",
    "..............................",
    "...AAAAAAAAAA.................",
    "...AAAAAAAAAA.................",
    "...AAAAAAAAAA.......B.........",
    "...AAAAAAAAAA.................",
    "...AAAAAAAAAA.................",
    "...AAAAAAAAAA.................",
    "..............................", "..............................", NULL };
  Page                     p;

  page_open (&p, neck, painted, 2);
  solve (&p);
  CHECK (label_at (&p, 5, 5) == 1 && label_at (&p, 22, 5) == 2);
  p.settings.keep_necks = false;
  solve (&p);
  CHECK (label_at (&p, 5, 5) == 1 && label_at (&p, 22, 5) == 1);
  page_close (&p);
}

static void
hard_labels_are_obeyed_and_the_greater_wins_a_basin (void)
{
  static const char *const drawing[] = { "............", "............", "............", "............", NULL };
  static const char *const painted[] = { "............", ".AA....BBBB.", "............", "............", NULL };
  Page                     p;

  page_open (&p, drawing, painted, 2);
  p.settings.hardness = 1;
  solve (&p);
  CHECK (p.basins.n > 1 ? label_at (&p, 8, 1) == 2 : label_at (&p, 0, 0) == 2);
  page_close (&p);
}

/* Paint on the ink between two enclosures says nothing of either. */
static void
paint_on_a_line_does_not_count (void)
{
  static const char *const drawing[] = {
    "..........####..........", "..........####..........", "..........####..........", "..........####..........",
    "..........####..........", NULL };
  static const char *const painted[] = {
    "........................", ".AAAAAAAAAAAAA..........", ".AAAAAAAAAAAAA..........", "..................BB....",
    "........................", NULL };
  Page                     p;

  page_open (&p, drawing, painted, 2);
  solve (&p);
  CHECK (label_at (&p, 4, 2) == 1 && label_at (&p, 20, 2) == 2);
  page_close (&p);
}

/* Closed enclosures of random size, each with its stroke: the same labels on paper as by exact cuts. */
static void
closed_enclosures_get_the_labels_of_exact_cuts (void)
{
  enum { WIDTH = 64, HEIGHT = 48 };
  uint32_t state = 5;

  for (int round = 0; round < 40; round++)
    {
      char        drawing[HEIGHT][WIDTH + 1], painted[HEIGHT][WIDTH + 1];
      const char *rows[HEIGHT + 1] = { NULL }, *paint[HEIGHT + 1] = { NULL };
      int         left = 20 + (int) check_random (&state, 24), top = 14 + (int) check_random (&state, 20), bad = 0;
      CeldLabels  exact;
      Page        p;

      for (int y = 0; y < HEIGHT; y++)
        {
          for (int x = 0; x < WIDTH; x++)
            {
              bool wall = (x >= left && x < left + 3) || (y >= top && y < top + 2);

              drawing[y][x] = wall ? '#' : '.';
              painted[y][x] = '.';
            }
          drawing[y][WIDTH] = painted[y][WIDTH] = 0;
          rows[y]  = drawing[y];
          paint[y] = painted[y];
        }
      for (int k = 0; k < 4; k++)
        for (int i = 0; i < 6; i++)
          {
            int y = k < 2 ? 3 + (int) check_random (&state, 8) : HEIGHT - 4;

            painted[y][k & 1 ? WIDTH - 2 - i : 2 + i] = (char) ('A' + k);
          }
      page_open (&p, rows, paint, 4);
      CHECK (celd_labels_new (WIDTH, HEIGHT, &exact) == CELD_OK);
      p.settings.keep_necks = round & 1;
      solve (&p);
      CHECK (celd_lazybrush_solve (&p.task, NULL, &exact) == CELD_OK);
      for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
          bad += drawing[y][x] == '.' && label_at (&p, x, y) != CELD_AT (&exact, x, y);
      NEAR (bad, 0, 0);
      celd_free (exact.data);
      page_close (&p);
    }
}

/* The enclosure in the middle has a long border with the outside, but a fine line, or a faint place in it, between it
 * and the enclosure on the left: no person would think that it belongs to the outside. */
static void
unpainted_enclosures_go_over_the_weakest_barrier (void)
{
  static const char *const fine[] = {
    "..............................",
    "..########################....",
    "..########################....",
    "..########################....",
    "..########################....",
    "..####.....#..........####....",
    "..####.....#..........####....",
    "..####.....#..........####....",
    "..####.....#..........####....",
    "..########################....",
    "..########################....",
    "..########################....",
    "..########################....",
    "..............................", NULL };
  static const char *const painted[] = {
    "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAA",
    "..............................", "..............................", "..............................",
    "..............................", "..............................",
    ".......BBB....................", ".......BBB....................",
    "..............................", "..............................", "..............................",
    "..............................", "..............................", "..............................", NULL };
  const char              *faint[15] = { NULL };
  Page                     p;

  for (int y = 0; y < 14; y++)
    faint[y] = fine[y][11] == '#' && y > 4 && y < 9 ? "..####.....####.......####...." : fine[y];
  faint[6] = "..####.....4444.......####....";
  page_open (&p, fine, painted, 2);
  solve (&p);
  CHECK (label_at (&p, 8, 6) == 2 && label_at (&p, 16, 6) == 2 && label_at (&p, 28, 6) == 1);
  page_close (&p);
  page_open (&p, faint, painted, 2);
  solve (&p);
  CHECK (label_at (&p, 8, 6) == 2 && label_at (&p, 18, 6) == 2 && label_at (&p, 28, 6) == 1);
  page_close (&p);
}

/* A foot without paint, on nearly all of its outline against the background; and a loop of a rope, with nothing but the
 * background about it. */
static void
unpainted_parts_of_a_figure_are_no_background (void)
{
  static const char *const drawing[] = {
    "..............................",
    "....##########................",
    "....##########......########..",
    "....##......##......#......#..",
    "....##......##......#......#..",
    "....##......##......#......#..",
    "....##......##......########..",
    "....##################........",
    "....##################........",
    "....##..............##........",
    "....##..............##........",
    "....##..............##........",
    "....##################........",
    "....##################........",
    "..............................", NULL };
  static const char *const painted[] = {
    "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAA",
    "..............................", "..............................", "..............................",
    ".......BBB....................", ".......BBB....................",
    "..............................", "..............................", "..............................",
    "..............................", "..............................", "..............................",
    "..............................", "..............................", "..............................", NULL };
  Page p;

  page_open (&p, drawing, painted, 2);
  p.task.palette.item[0].background = true;
  solve (&p);
  CHECK (label_at (&p, 8, 4) == 2 && label_at (&p, 12, 10) == 2 && label_at (&p, 26, 12) == 1);
  CHECK (label_at (&p, 24, 4) == 1);
  page_close (&p);
}

/* ------------------------------------------------------------------ over bridges */

#define SIDE 320
#define PI   3.14159265358979

static void
draw_arc (Scene *s, double radius, double from, double to)
{
  for (double a = from; a < to - 1e-9; a += 0.05)
    {
      double b = fmin (a + 0.05, to);

      scene_line (s, (CeldPlace) { SIDE / 2 + radius * cos (a), SIDE / 2 + radius * sin (a) },
                  (CeldPlace) { SIDE / 2 + radius * cos (b), SIDE / 2 + radius * sin (b) }, 4);
    }
}

/* A stroke of label k at (x,y). */
static void
paint (CeldLabels *seeds, uint32_t k, int x, int y)
{
  for (int i = -10; i <= 10; i++)
    CELD_AT (seeds, x + i, y) = k;
}

/* The label of a pixel; `n` strokes of labels 1, 2 .. at x and y. */
static uint32_t
label_of (const Scene *s, const int (*at)[2], uint32_t n, int x, int y)
{
  CeldSettings settings = celd_settings ();
  CeldPalette  palette = { calloc (n, sizeof (CeldRegion)), n };
  CeldProblems problems = { 0 };
  CeldLabels   seeds, labels;
  uint32_t     label;

  CHECK (celd_labels_new (SIDE, SIDE, &seeds) == CELD_OK && celd_labels_new (SIDE, SIDE, &labels) == CELD_OK);
  for (uint32_t k = 0; k < n; k++)
    {
      palette.item[k] = (CeldRegion) { .colour = { (uint8_t) (40 * k), 0, 200, 255 } };
      paint (&seeds, k + 1, at[k][0], at[k][1]);
    }
  CHECK (celd_segment (&s->ink, &seeds, NULL, &settings, NULL, &labels, &palette, &problems) == CELD_OK);
  label = CELD_AT (&labels, x, y);
  celd_free (seeds.data);
  celd_free (labels.data);
  celd_palette_clear (&palette);
  celd_problems_clear (&problems);
  return label;
}

/* A tube whose left half has paint; from both sides of its middle spikes point to each other.  Its right half touches
 * the room above it along a thin line that is much longer than the way between the spikes. */
static void
missing_paint_comes_over_a_bridge_rather_than_through_a_line (void)
{
  static const int at[2][2] = { { 90, 160 }, { 220, 80 } };
  Scene            s;

  scene_open (SIDE, SIDE, &s);
  scene_line (&s, (CeldPlace) { 40, 120 }, (CeldPlace) { 160, 120 }, 4);
  scene_line (&s, (CeldPlace) { 160, 120 }, (CeldPlace) { 280, 120 }, 2);
  scene_line (&s, (CeldPlace) { 40, 200 }, (CeldPlace) { 280, 200 }, 4);
  scene_line (&s, (CeldPlace) { 40, 120 }, (CeldPlace) { 40, 200 }, 4);
  scene_line (&s, (CeldPlace) { 280, 40 }, (CeldPlace) { 280, 200 }, 4);
  scene_line (&s, (CeldPlace) { 160, 40 }, (CeldPlace) { 280, 40 }, 4);
  scene_line (&s, (CeldPlace) { 160, 40 }, (CeldPlace) { 160, 152 }, 4);
  scene_line (&s, (CeldPlace) { 160, 168 }, (CeldPlace) { 160, 200 }, 4);
  CHECK (label_of (&s, at, 2, 90, 180) == 1 && label_of (&s, at, 2, 220, 60) == 2);
  CHECK (label_of (&s, at, 2, 220, 180) == 1);
  scene_close (&s);
}

/* The space between a disc and a circle round it, which is open over so many stroke widths, belongs to what is outside;
 * but if that is a gap in a line, to the disc. */
static void
a_bay_is_background_and_a_part_inside_a_gap_is_not (void)
{
  static const int at[2][2] = { { 160, 160 }, { 160, 20 } };
  Scene            s;

  scene_open (SIDE, SIDE, &s);
  draw_arc (&s, 40, 0, 2 * PI);
  draw_arc (&s, 80, 0.15, 2 * PI - 0.15);
  CHECK (label_of (&s, at, 2, 160, 300) == 2 && label_of (&s, at, 2, 160, 100) == 2);
  scene_close (&s);
  scene_open (SIDE, SIDE, &s);
  draw_arc (&s, 40, 0, 2 * PI);
  draw_arc (&s, 80, 0.06, 2 * PI - 0.06);
  CHECK (label_of (&s, at, 2, 160, 300) == 2 && label_of (&s, at, 2, 160, 100) == 1);
  scene_close (&s);
}

int
main (void)
{
  RUN (a_part_behind_a_neck_follows_its_enclosure);
  RUN (a_part_with_paint_of_its_own_keeps_it);
  RUN (hard_labels_are_obeyed_and_the_greater_wins_a_basin);
  RUN (paint_on_a_line_does_not_count);
  RUN (unpainted_enclosures_go_over_the_weakest_barrier);
  RUN (unpainted_parts_of_a_figure_are_no_background);
  RUN (missing_paint_comes_over_a_bridge_rather_than_through_a_line);
  RUN (a_bay_is_background_and_a_part_inside_a_gap_is_not);
  RUN (closed_enclosures_get_the_labels_of_exact_cuts);
  return DONE;
}
