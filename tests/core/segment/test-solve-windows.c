/* Windows: hard paint obeyed to the pixel, the energy never above that of the basins' labels, and equal to that of the
 * whole picture's cut where a window can see all there is.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "image/image.h"
#include "segment/basins.h"
#include "segment/task.h"
#include "solve/maxflow.h"



typedef struct
{
  CeldPlane       ink;
  CeldSettings    settings;
  CeldBasins      basins;
  CeldSegmentTask task;
  uint32_t       *label;        /* of each basin */
  CeldPatches     patches;
  CeldLabels      result;
} Scene;

/* ------------------------------------------------------------------ scenes */

/* Borders of basins that touch, with paper on both sides or not: all that windows want to know. */
static void
join_basins (const char *const *art, CeldBasins *basins)
{
  basins->boundary = calloc (basins->n * basins->n, sizeof *basins->boundary);
  for (uint32_t a = 0; a < basins->n; a++)
    for (uint32_t b = a + 1; b < basins->n; b++)
      {
        CeldBasinBoundary boundary = { .a = a, .b = b };

        for (int y = 0; y < basins->height; y++)
          for (int x = 0; x < basins->width; x++)
            for (int south = 0; south < 2; south++)
              if (x + !south < basins->width && y + south < basins->height)
                {
                  uint32_t p = (uint32_t) (art[y][x] - 'a'), q = (uint32_t) (art[y + south][x + !south] - 'a');

                  boundary.opening += (p == a && q == b) || (p == b && q == a);
                }
        if (boundary.opening)
          basins->boundary[basins->n_boundaries++] = boundary;
      }
}

/* Basins as the art draws them: 'a' is number 0. */
static void
draw_basins (const char *const *art, float threshold, CeldBasins *basins)
{
  int    w = art_width (art), h = art_height (art);
  size_t n = 0;

  *basins = (CeldBasins) { .width = w, .height = h, .stroke = 1 };
  celd_smoothness_costs_new (w, h, threshold, &basins->costs);
  basins->row = malloc (((size_t) h + 1) * sizeof *basins->row);
  basins->run = malloc ((size_t) w * (size_t) h * sizeof *basins->run);
  for (int y = 0; y < h; y++)
    {
      basins->row[y] = n;
      for (int x = 0; x < w; x++)
        {
          uint32_t k = (uint32_t) (art[y][x] - 'a');

          if (x == 0 || art[y][x] != art[y][x - 1])
            basins->run[n++] = (CeldBasinRun) { x, k };
          basins->n = k + 1 > basins->n ? k + 1 : basins->n;
        }
    }
  basins->row[h] = n;
  join_basins (art, basins);
}

/* `labels`: of basin k the letter labels[k]; `painted`: 'A' is paint of label 1 and so on, of n labels. */
static void
scene_open (Scene *s, CeldPlane ink, const CeldLabels *painted, const char *const *basins, const char *labels,
            size_t n, float hardness)
{
  uint32_t label;

  *s = (Scene) { .ink = ink, .settings = celd_settings () };
  s->settings.hardness = hardness;
  draw_basins (basins, s->settings.ink_threshold, &s->basins);
  s->label = calloc (s->basins.n, sizeof *s->label);
  for (size_t k = 0; k < s->basins.n; k++)
    s->label[k] = (uint32_t) (labels[k] - 'A' + 1);
  s->task = (CeldSegmentTask) { .settings = &s->settings, .ink = &s->ink, .basins = &s->basins };
  celd_seed_rows_read (painted, &s->task.seeds);
  for (size_t k = 0; k < n; k++)
    celd_task_add_label (&s->task, (CeldRegion) { .colour = { (uint8_t) (40 * k), 0, 200, 255 } }, &label);
  celd_task_set_soft_cost (&s->task);
}

static void
scene_close (Scene *s)
{
  free (s->ink.data);
  free (s->basins.row);
  free (s->basins.run);
  free (s->basins.boundary);
  free (s->label);
  celd_seed_rows_clear (&s->task.seeds);
  celd_palette_clear (&s->task.palette);
  celd_patches_clear (&s->patches);
  free (s->result.data);
}

static void
art_scene (Scene *s, const char *const *ink, const char *const *basins, const char *labels, const char *const *painted,
           size_t n, float hardness)
{
  CeldLabels paint = art_labels (painted);

  scene_open (s, art_plane (ink), &paint, basins, labels, n, hardness);
  free (paint.data);
}

/* The labels of the basins as a picture, tight. */
static CeldLabels
basin_labels (const Scene *s)
{
  int        w = s->basins.width, h = s->basins.height;
  CeldLabels l = { w, h, (size_t) w, malloc ((size_t) w * (size_t) h * sizeof (uint32_t)) };

  for (int y = 0; y < h; y++)
    for (size_t i = s->basins.row[y]; i < s->basins.row[y + 1]; i++)
      {
        int end = i + 1 < s->basins.row[y + 1] ? s->basins.run[i + 1].x : w;

        for (int x = s->basins.run[i].x; x < end; x++)
          CELD_AT (&l, x, y) = s->label[s->basins.run[i].basin];
      }
  return l;
}

/* Solves; what basins and patches make is the result.  Patches say what differs, and no pixel twice. */
static void
solve (Scene *s)
{
  int   w = s->basins.width, twice = 0, same = 0;
  bool *seen = calloc ((size_t) w * (size_t) s->basins.height, 1);

  CHECK (celd_windows_solve (&s->task, s->label, NULL, &s->patches) == CELD_OK);
  s->result = basin_labels (s);
  for (size_t i = 0; i < s->patches.n; i++)
    for (int x = s->patches.item[i].x; x < s->patches.item[i].end; x++)
      {
        const CeldPatch *patch = &s->patches.item[i];

        twice += seen[patch->y * w + x];
        seen[patch->y * w + x] = true;
        same += CELD_AT (&s->result, x, patch->y) == patch->label;
        CELD_AT (&s->result, x, patch->y) = patch->label;
      }
  CHECK (!twice && !same);
  free (seen);
}

/* ------------------------------------------------------------------ what labels cost */

static int
disobeyed (const Scene *s, const CeldLabels *labels)
{
  int n = 0;

  for (int y = 0; y < s->task.seeds.height; y++)
    for (size_t i = 0; i < s->task.seeds.row[y].n; i++)
      {
        const CeldSeedRun *run = &s->task.seeds.row[y].run[i];

        for (int x = run->x; x < run->end; x++)
          n += celd_task_data_cost (&s->task, run->label) == CELD_HARD && CELD_AT (labels, x, y) != run->label;
      }
  return n;
}

static int64_t
energy (const Scene *s, const CeldLabels *labels)
{
  int      w = s->ink.width, h = s->ink.height;
  size_t   n = (size_t) w * (size_t) h;
  uint8_t *paper = malloc (n);
  int32_t *depth = malloc (n * sizeof *depth);
  int64_t  sum = 0;

  for (size_t p = 0; p < n; p++)
    paper[p] = celd_is_paper (s->ink.data[p]);
  celd_distance (w, h, paper, NULL, depth);
  for (int y = 0; y < h; y++)
    for (int x = 0; x < w; x++)
      for (int south = 0; south < 2; south++)
        {
          int  p = y * w + x, q = p + (south ? w : 1);
          bool frame = south ? x == 0 || x + 1 == w : y == 0 || y + 1 == h;

          if ((south ? y + 1 < h : x + 1 < w) && labels->data[p] != labels->data[q])
            sum += celd_smoothness_cost (&s->basins.costs, s->ink.data[p], s->ink.data[q], depth[p], depth[q], frame);
        }
  for (int y = 0; y < h; y++)
    for (size_t i = 0; i < s->task.seeds.row[y].n; i++)
      {
        const CeldSeedRun *run = &s->task.seeds.row[y].run[i];

        for (int x = run->x; x < run->end; x++)
          if (CELD_AT (labels, x, y) != run->label && celd_task_data_cost (&s->task, run->label) != CELD_HARD)
            sum += celd_task_data_cost (&s->task, run->label);
      }
  free (paper);
  free (depth);
  return sum;
}

/* Of what the cut of all pixels of the picture makes. */
static int64_t
exact_energy (const Scene *s)
{
  CeldLabels l;
  int64_t    sum;

  celd_labels_new (s->ink.width, s->ink.height, &l);
  CHECK (celd_lazybrush_solve (&s->task, NULL, &l) == CELD_OK);
  sum = energy (s, &l);
  free (l.data);
  return sum;
}

static bool
is_like (const CeldLabels *labels, const char *const *art)
{
  CeldLabels wanted = art_labels (art);
  bool       like = !memcmp (labels->data, wanted.data, (size_t) wanted.width * (size_t) wanted.height * 4);

  free (wanted.data);
  return like;
}

/* ------------------------------------------------------------------ hard strokes */

static const char *const enclosure[] = {
  "####################", "#..................#", "#..................#", "#..................#",
  "#..................#", "#..................#", "#..................#", "#..................#",
  "####################", NULL
};
static const char *const one_basin[] = {
  "aaaaaaaaaaaaaaaaaaaa", "aaaaaaaaaaaaaaaaaaaa", "aaaaaaaaaaaaaaaaaaaa", "aaaaaaaaaaaaaaaaaaaa",
  "aaaaaaaaaaaaaaaaaaaa", "aaaaaaaaaaaaaaaaaaaa", "aaaaaaaaaaaaaaaaaaaa", "aaaaaaaaaaaaaaaaaaaa",
  "aaaaaaaaaaaaaaaaaaaa", NULL
};

static void
two_hard_strokes_share_an_enclosure (void)
{
  static const char *const painted[] = {
    "....................", "..AAAAA.............", "..AAAAA.............", "....................",
    "....................", "....................", "..............BBB...", "..............BBB...",
    "....................", NULL
  };
  Scene                    s;

  art_scene (&s, enclosure, one_basin, "A", painted, 2, 1);
  solve (&s);
  CHECK (!disobeyed (&s, &s.result));
  CHECK (s.patches.n > 0);
  CHECK (energy (&s, &s.result) == exact_energy (&s));
  scene_close (&s);
}

/* The tail of a stroke in the next enclosure is kept, and nothing else of that enclosure. */
static void
a_hard_stroke_through_a_contour_keeps_its_pixels (void)
{
  static const char *const ink[] = {
    "###################", "#.....#...........#", "#.....#...........#", "#.....#...........#",
    "#.....#...........#", "#.....#...........#", "#.....#...........#", "#.....#...........#",
    "#.....#...........#", "#.....#...........#", "###################", NULL
  };
  static const char *const basins[] = {
    "aaaaaaabbbbbbbbbbbb", "aaaaaaabbbbbbbbbbbb", "aaaaaaabbbbbbbbbbbb", "aaaaaaabbbbbbbbbbbb",
    "aaaaaaabbbbbbbbbbbb", "aaaaaaabbbbbbbbbbbb", "aaaaaaabbbbbbbbbbbb", "aaaaaaabbbbbbbbbbbb",
    "aaaaaaabbbbbbbbbbbb", "aaaaaaabbbbbbbbbbbb", "aaaaaaabbbbbbbbbbbb", NULL
  };
  static const char *const painted[] = {
    "...................", "...................", "...................", "...................",
    ".AAAAAAAA..........", "...................", "...........BBBBB...", "...........BBBBB...",
    "...................", "...................", "...................", NULL
  };
  static const char *const wanted[] = {
    "AAAAAAABBBBBBBBBBBB", "AAAAAAABBBBBBBBBBBB", "AAAAAAABBBBBBBBBBBB", "AAAAAAABBBBBBBBBBBB",
    "AAAAAAAAABBBBBBBBBB", "AAAAAAABBBBBBBBBBBB", "AAAAAAABBBBBBBBBBBB", "AAAAAAABBBBBBBBBBBB",
    "AAAAAAABBBBBBBBBBBB", "AAAAAAABBBBBBBBBBBB", "AAAAAAABBBBBBBBBBBB", NULL
  };
  Scene                    s;

  art_scene (&s, ink, basins, "AB", painted, 2, 1);
  solve (&s);
  CHECK (is_like (&s.result, wanted));
  scene_close (&s);
}

static void
hard_strokes_on_ink_and_at_the_frame (void)
{
  static const char *const ink[] = {
    "......######", "......######", "......######", "......######", "......######", "......######", NULL
  };
  static const char *const basins[] = {
    "aaaaaaaabbbb", "aaaaaaaabbbb", "aaaaaaaabbbb", "aaaaaaaabbbb", "aaaaaaaabbbb", "aaaaaaaabbbb", NULL
  };
  static const char *const painted[] = {
    "BB........A.", "B...........", "....A.......", "....A.......", "..........B.", "..........BA", NULL
  };
  Scene                    s;

  art_scene (&s, ink, basins, "AB", painted, 2, 1);
  solve (&s);
  CHECK (!disobeyed (&s, &s.result));
  CHECK (s.result.data[0] == 2 && s.result.data[10] == 1 && s.result.data[5 * 12 + 11] == 1);
  CHECK (energy (&s, &s.result) <= exact_energy (&s));
  scene_close (&s);
}

/* ------------------------------------------------------------------ soft strokes */

static void
a_soft_minority_in_an_open_region_changes_nothing (void)
{
  static const char *const painted[] = {
    "....................", "..AAAAAAA...........", "..AAAAAAA...........", "....................",
    "....................", "....................", "..............BBB...", "..............BBB...",
    "....................", NULL
  };
  Scene                    s;

  art_scene (&s, enclosure, one_basin, "A", painted, 2, 0.05f);
  solve (&s);
  CHECK (s.patches.n == 0);
  scene_close (&s);
}

/* A dead end of one basin, whose paint pays for a cut across its mouth. */
static void
a_soft_stroke_gets_the_dead_end_it_lies_in (void)
{
  static const char *const ink[] = {
    "################", "#......#########", "#......#########", "#..............#", "#......#########",
    "#......#########", "################", NULL
  };
  static const char *const basins[] = {
    "aaaaaaaaaaaaaaaa", "aaaaaaaaaaaaaaaa", "aaaaaaaaaaaaaaaa", "aaaaaaaaaaaaaaaa", "aaaaaaaaaaaaaaaa",
    "aaaaaaaaaaaaaaaa", "aaaaaaaaaaaaaaaa", NULL
  };
  static const char *const painted[] = {
    "................", "..AA............", "..AA............", "..AA.....BBBBB..", "..AA............",
    "................", "................", NULL
  };
  Scene                    s;

  art_scene (&s, ink, basins, "A", painted, 2, 0.1f);
  solve (&s);
  for (int x = 9; x < 14; x++)
    CHECK (CELD_AT (&s.result, x, 3) == 2);
  CHECK (CELD_AT (&s.result, 2, 3) == 1);
  CHECK (energy (&s, &s.result) == exact_energy (&s));
  scene_close (&s);
}

/* ------------------------------------------------------------------ many */

/* A page of enclosures of 60 x 60 pixels, one basin each, with label A; in some of them hard strokes of B and C. */
static void
windows_far_apart_are_solved_independently (void)
{
  enum { ROOMS = 5, SIDE = 60, ALL = ROOMS * SIDE };
  CeldPlane       ink = { ALL, ALL, ALL, malloc (ALL * ALL * sizeof (float)) };
  static uint32_t seed[ALL * ALL];
  CeldLabels      painted = { ALL, ALL, ALL, seed };
  static char     art[ALL][ALL + 1];
  const char     *rows[ALL + 1] = { NULL };
  char            labels[ROOMS * ROOMS + 1];
  Scene           s;
  int             kept = 0, other = 0;

  for (int y = 0; y < ALL; y++)
    {
      for (int x = 0; x < ALL; x++)
        {
          art[y][x] = (char) ('a' + y / SIDE * ROOMS + x / SIDE);
          ink.data[y * ALL + x] = x % SIDE > 1 && y % SIDE > 1;
        }
      rows[y] = art[y];
    }
  memset (labels, 'A', sizeof labels - 1);
  for (int k = 0; k < ROOMS * ROOMS; k += 4)
    for (int i = 0; i < 10; i++)
      for (int j = 0; j < 3; j++)
        seed[(k / ROOMS * SIDE + 30 + j) * ALL + k % ROOMS * SIDE + 20 + i] = 2 + (uint32_t) k / 4 % 2;
  seed[5 * ALL + 5] = 1;
  scene_open (&s, ink, &painted, rows, labels, 3, 1);
  solve (&s);
  CHECK (!disobeyed (&s, &s.result));
  for (int p = 0; p < ALL * ALL; p++)
    {
      kept += seed[p] > 1 && s.result.data[p] == seed[p];
      other += seed[p] <= 1 && s.result.data[p] != 1;
    }
  CHECK (kept == 7 * 30);
  CHECK (other == 0);
  scene_close (&s);
}

/* Blots of ink and grey, of paint and of basins. */
static void
random_scene (Scene *s, uint32_t *state, int w, int h, size_t n_labels, float hardness)
{
  size_t       n = (size_t) w * (size_t) h, n_basins = 1 + check_random (state, 6);
  CeldPlane    ink = { w, h, (size_t) w, malloc (n * sizeof (float)) };
  CeldLabels   painted = { w, h, (size_t) w, calloc (n, sizeof (uint32_t)) };
  char        *art = calloc (n + (size_t) h, 1), labels[8] = "";
  const char **rows = calloc ((size_t) h + 1, sizeof *rows);

  for (size_t p = 0; p < n; p++)
    ink.data[p] = 1;
  for (int k = 0; k < 6; k++)
    {
      int   x = (int) check_random (state, (uint32_t) w), y = (int) check_random (state, (uint32_t) h);
      bool  down = check_random (state, 2);
      float grey = check_random (state, 3) ? 0 : (float) check_random (state, 10) / 10;

      for (int i = 0; i < 2 * w; i++)
        for (int j = 0; j < 2; j++)
          {
            int px = x + (down ? j : i / 2), py = y + (down ? i / 2 : j);

            if (px < w && py < h)
              ink.data[py * w + px] = fminf (ink.data[py * w + px], grey);
          }
    }
  for (int k = 0; k < 7; k++)
    {
      int      x = (int) check_random (state, (uint32_t) w), y = (int) check_random (state, (uint32_t) h);
      int      pw = 1 + (int) check_random (state, 8), ph = 1 + (int) check_random (state, 8);
      uint32_t l = 1 + check_random (state, (uint32_t) n_labels);

      for (int j = y; j < y + ph && j < h; j++)
        for (int i = x; i < x + pw && i < w; i++)
          painted.data[j * w + i] = l;
    }
  for (size_t k = 0; k < n_basins; k++)
    labels[k] = (char) ('A' + check_random (state, (uint32_t) n_labels));
  for (int y = 0; y < h; y++)
    {
      rows[y] = art + y * (w + 1);
      for (int x = 0; x < w; x++)
        art[y * (w + 1) + x] = (char) ('a' + (size_t) (x + y / 3) * n_basins / (size_t) (w + h / 3));
    }
  scene_open (s, ink, &painted, rows, labels, n_labels, hardness);
  free (painted.data);
  free (art);
  free (rows);
}

static void
random_windows_obey_hard_seeds_and_never_raise_the_energy (void)
{
  static const float hardness[] = { 0.05f, 0.3f, 0.9f, 1 };
  uint32_t           state = 23;

  for (int i = 0; i < 200; i++)
    {
      int        w = 20 + (int) check_random (&state, 100), h = 20 + (int) check_random (&state, 100);
      Scene      s;
      CeldLabels before;

      random_scene (&s, &state, w, h, 2 + check_random (&state, 4), hardness[i % 4]);
      before = basin_labels (&s);
      solve (&s);
      CHECK (!disobeyed (&s, &s.result));
      if (!disobeyed (&s, &before))
        CHECK (energy (&s, &s.result) <= energy (&s, &before));
      free (before.data);
      scene_close (&s);
    }
}

/* One connected stroke of another label along two sides, through all basins: the window is the picture. */
static void
overrule_all (Scene *s)
{
  int w = s->ink.width, h = s->ink.height;

  for (size_t k = 0; k < s->basins.n; k++)
    s->label[k] = 2;
  for (int y = 0; y < h; y++)
    celd_seed_rows_paint (&s->task.seeds, y, 0, y + 1 < h ? 1 : w, 1);
  for (int x = 0; x < w; x++)
    CELD_AT (&s->ink, x, h - 1) = 1;
}

/* Small windows are cut on pixels. */
static void
small_windows_are_cut_exactly (void)
{
  uint32_t state = 5;

  for (int i = 0; i < 200; i++)
    {
      int   w = 12 + (int) check_random (&state, 12), h = 12 + (int) check_random (&state, 12);
      Scene s;

      random_scene (&s, &state, w, h, 2, i % 2 ? 1 : 0.5f);
      overrule_all (&s);
      solve (&s);
      CHECK (!disobeyed (&s, &s.result));
      CHECK (energy (&s, &s.result) == exact_energy (&s));
      scene_close (&s);
    }
}

/* Larger ones are cut in blocks first: within a percent of exact. */
static void
large_windows_cost_at_most_a_percent_more_than_exact_cuts (void)
{
  uint32_t state = 17;
  double   sum = 0, sum_exact = 0;

  for (int i = 0; i < 40; i++)
    {
      int     w = 90 + (int) check_random (&state, 120), h = 90 + (int) check_random (&state, 120);
      int64_t exact;
      Scene   s;

      random_scene (&s, &state, w, h, 2, i % 2 ? 1 : 0.5f);
      overrule_all (&s);
      solve (&s);
      exact = exact_energy (&s);
      CHECK (!disobeyed (&s, &s.result));
      CHECK (energy (&s, &s.result) >= exact);
      sum += (double) energy (&s, &s.result);
      sum_exact += (double) exact;
      scene_close (&s);
    }
  CHECK (sum <= 1.01 * sum_exact);
}

/* ------------------------------------------------------------------ hosts */

static void
after_a_cancel_the_patches_are_as_before (void)
{
  static const char *const painted[] = {
    "....................", "..AAAAAAA...........", "..AAAAAAA...........", "....................",
    "....................", "....................", "..............BBB...", "..............BBB...",
    "....................", NULL
  };
  CeldHost                 host = { check_refuse, NULL, NULL };
  Scene                    s;

  art_scene (&s, enclosure, one_basin, "A", painted, 2, 1);
  CHECK (celd_windows_solve (&s.task, s.label, &host, &s.patches) == CELD_CANCELLED);
  CHECK (s.patches.n == 0);
  scene_close (&s);
}

int
main (void)
{
  RUN (two_hard_strokes_share_an_enclosure);
  RUN (a_hard_stroke_through_a_contour_keeps_its_pixels);
  RUN (hard_strokes_on_ink_and_at_the_frame);
  RUN (a_soft_minority_in_an_open_region_changes_nothing);
  RUN (a_soft_stroke_gets_the_dead_end_it_lies_in);
  RUN (windows_far_apart_are_solved_independently);
  RUN (random_windows_obey_hard_seeds_and_never_raise_the_energy);
  RUN (small_windows_are_cut_exactly);
  RUN (large_windows_cost_at_most_a_percent_more_than_exact_cuts);
  RUN (after_a_cancel_the_patches_are_as_before);
  return DONE;
}
