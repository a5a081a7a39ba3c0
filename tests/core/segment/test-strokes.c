/* Where strokes lie, and which of their overlaps are spills.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "random-sketch.h"
#include "segment/task.h"

static void
check_share (const CeldStrokes *strokes, size_t i, CeldStrokeOverlap wanted)
{
  const CeldStrokeOverlap *overlap = &strokes->overlap[i];

  CHECK (overlap->part == wanted.part && overlap->label == wanted.label && overlap->stroke == wanted.stroke);
  NEAR (overlap->pixels, wanted.pixels, 0);
}

/* A runs through the contour and back, in runs that add up; paint on ink is no share.  B touches only by a corner. */
static void
overlaps_count_the_paper_of_strokes_by_part (void)
{
  static const char *const paper[] = { "111#222", "111#222", "111#222", "111#222", NULL };
  static const char *const painted[] = { ".AAAAA.", ".....A.", ".AAAAAB", "B.....B", NULL };
  CeldStrokes              strokes;
  Sketch                   s;

  sketch_open (&s, paper, painted, 2);
  CHECK (celd_strokes_new (&s.task, s.basins.component, &strokes) == CELD_OK);
  NEAR (strokes.n, 4, 0);
  if (strokes.n == 4)
    {
      check_share (&strokes, 0, (CeldStrokeOverlap) { 1, 1, 0, 4, 0, false });
      check_share (&strokes, 1, (CeldStrokeOverlap) { 1, 2, 2, 1, 0, false });
      check_share (&strokes, 2, (CeldStrokeOverlap) { 2, 1, 0, 5, 0, false });
      check_share (&strokes, 3, (CeldStrokeOverlap) { 2, 2, 1, 2, 0, false });
    }
  NEAR (strokes.n_strokes, 3, 0);
  if (strokes.n_strokes == 3)
    {
      NEAR (strokes.total[0], 9, 0);
      NEAR (strokes.total[1], 2, 0);
      NEAR (strokes.total[2], 1, 0);
    }
  celd_strokes_clear (&strokes);
  sketch_close (&s);
}

static void
pixels_that_touch_by_a_corner_are_one_stroke (void)
{
  static const char *const paper[] = { "111", "111", NULL }, *const painted[] = { "A.A", ".A.", NULL };
  CeldStrokes              strokes;
  Sketch                   s;

  sketch_open (&s, paper, painted, 1);
  CHECK (celd_strokes_new (&s.task, s.basins.component, &strokes) == CELD_OK);
  NEAR (strokes.n, 1, 0);
  NEAR (strokes.n ? strokes.overlap[0].pixels : 0, 3, 0);
  celd_strokes_clear (&strokes);
  sketch_close (&s);
}

/* Where basins meet a run of seeds is cut; a solid area is a part of its own, without a share. */
static void
runs_are_cut_where_basins_meet (void)
{
  static const char     *const paper[] = { "11#2233#", "#0000#33", NULL };
  static const char     *const painted[] = { ".AAAAAAB", "BBBB..B.", NULL };
  static const CeldStrokePiece wanted[] = {
    { 0, 1, 3, 1, 0, 0, 1 }, { 0, 3, 5, 1, 1, 0, 2 }, { 0, 5, 7, 1, 2, 0, 2 }, { 0, 7, 8, 2, 2, 1, 0 },
    { 1, 0, 4, 2, 3, 2, 0 }, { 1, 6, 7, 2, 2, 1, 1 },
  };
  CeldStrokes                  strokes;
  Sketch                       s;

  sketch_open (&s, paper, painted, 2);
  CHECK (celd_strokes_new (&s.task, s.basins.component, &strokes) == CELD_OK);
  NEAR (strokes.n_pieces, 6, 0);
  for (size_t i = 0; i < 6 && strokes.n_pieces == 6; i++)
    CHECK (!memcmp (&strokes.piece[i], &wanted[i], sizeof *wanted));
  NEAR (strokes.n, 4, 0);
  NEAR (strokes.n_strokes == 3 ? strokes.total[2] : 1, 0, 0);
  celd_strokes_clear (&strokes);
  sketch_close (&s);
}

/* ------------------------------------------------------------------ the same by pixels */

/* The odds that a stroke is meant for a component in which it has paint, as multiples of the least; spills speak for no
 * label. */
static double
slow_odds (const CeldLabels *painted, const CeldLabels *component, const uint32_t stroke[W * H],
           const bool spill[W * H], int p)
{
  double here = 0, elsewhere = 0, mine = 0, others = 0;

  for (int q = 0; q < W * H; q++)
    if (painted->data[q] && component->data[q] == component->data[p])
      {
        here   += stroke[q] == stroke[p];
        mine   += !spill[q] && painted->data[q] == painted->data[p];
        others += !spill[q] && painted->data[q] != painted->data[p];
      }
    else
      elsewhere += component->data[q] && stroke[q] == stroke[p];
  return elsewhere * others > 0 ? here * mine / (elsewhere * others) / (mine < others ? 1 : 0.5) : INFINITY;
}

/* Is pixel p a spill, if those are that are known?  By the definition, pixel by pixel. */
static bool
slow_stain (const CeldLabels *painted, const CeldLabels *component, const uint32_t stroke[W * H],
            const bool spill[W * H], int p)
{
  bool   best = true;
  double odds;

  if (!painted->data[p] || !component->data[p] || spill[p])
    return false;
  odds = slow_odds (painted, component, stroke, spill, p);
  for (int q = 0; q < W * H && odds < 1; q++)
    if (painted->data[q] && component->data[q] && stroke[q] == stroke[p] && !spill[q])
      best &= slow_odds (painted, component, stroke, spill, q) <= odds;
  return odds < 1 && !best;
}

static void
slow_spills (const CeldLabels *painted, const CeldLabels *component, const uint32_t stroke[W * H], bool spill[W * H])
{
  bool more[W * H];
  int  found;

  memset (spill, 0, W * H * sizeof *spill);
  do
    {
      found = 0;
      for (int p = 0; p < W * H; p++)
        found += more[p] = slow_stain (painted, component, stroke, spill, p);
      for (int p = 0; p < W * H; p++)
        spill[p] |= more[p];
    }
  while (found);
}

/* With what other seeds on the same drawing left behind, stroke pieces must be the same. */
static void
check_kept (Sketch *s, const CeldStrokes *wanted, uint32_t *state)
{
  CeldSegmentTask other = s->task;
  CeldStrokes     kept = { 0 }, strokes;

  CHECK (celd_seed_rows_copy (&s->task.seeds, &other.seeds) == CELD_OK);
  other.kept = s->task.kept = &kept;
  for (int round = 0; round < 4; round++)
    {
      CHECK (celd_strokes_new (&s->task, s->basins.component, &strokes) == CELD_OK);
      CHECK (strokes.n_pieces == wanted->n_pieces && strokes.n == wanted->n && strokes.n_strokes == wanted->n_strokes);
      CHECK (!memcmp (strokes.piece, wanted->piece, wanted->n_pieces * sizeof *wanted->piece));
      CHECK (!memcmp (strokes.total, wanted->total, wanted->n_strokes * sizeof *wanted->total));
      celd_strokes_clear (&strokes);
      for (int k = 0; k < 8; k++)
        {
          int x = (int) check_random (state, W), end = x + (int) check_random (state, 9);

          CHECK (celd_seed_rows_paint (&other.seeds, (int) check_random (state, H), x, end, check_random (state, 4))
                 == CELD_OK);
        }
      CHECK (celd_strokes_new (&other, NULL, &strokes) == CELD_OK && strokes.n == 0);
      celd_strokes_keep (&other, &strokes);
      CHECK (!strokes.piece && kept.n_pieces);
    }
  s->task.kept = NULL;
  celd_strokes_clear (&kept);
  celd_seed_rows_clear (&other.seeds);
}

static void
stroke_pieces_overlaps_and_spills_are_those_of_the_pixels (void)
{
  uint32_t state = 5, stroke[W * H];
  int      stains = 0;

  for (int round = 0; round < 200; round++)
    {
      char        paper[H][W + 1] = { { 0 } }, painted[H][W + 1] = { { 0 } };
      const char *paper_rows[H + 1] = { NULL }, *painted_rows[H + 1] = { NULL };
      CeldLabels  component, paint;
      CeldStrokes strokes;
      Sketch      s;
      uint32_t    n;
      size_t      pixels = 0, dabbed = 0, paper_pixels = 0;
      int         wrong = 0;
      bool        spill[W * H];

      random_sketch (&state, 9, paper, painted);
      for (int y = 0; y < H; y++)
        {
          paper_rows[y] = paper[y];
          painted_rows[y] = painted[y];
        }
      component = art_labels (paper_rows);
      paint = art_labels (painted_rows);
      n = flood (&paint, stroke);
      sketch_open (&s, paper_rows, painted_rows, 3);
      CHECK (celd_strokes_new (&s.task, s.basins.component, &strokes) == CELD_OK);
      NEAR (strokes.n_strokes, n, 0);
      for (size_t i = 0; i < strokes.n_pieces; i++)
        {
          const CeldStrokePiece *d = &strokes.piece[i];
          uint32_t               on_paper = 0;

          for (int x = d->x; x < d->end; x++)
            {
              wrong += paint.data[d->y * W + x] != d->label || stroke[d->y * W + x] != d->stroke + 1;
              wrong += sketch_basin (paper[d->y], x, 4) != d->basin;
              on_paper += component.data[d->y * W + x] > 0;
            }
          wrong += on_paper != d->paper || d->x >= d->end;
          wrong += i && (d[-1].y > d->y || (d[-1].y == d->y && d[-1].end > d->x));
          dabbed += (size_t) (d->end - d->x);
        }
      for (size_t i = 0; i < strokes.n; i++)
        {
          size_t overlap = 0;

          for (int p = 0; p < W * H; p++)
            overlap += component.data[p] == strokes.overlap[i].part && stroke[p] == strokes.overlap[i].stroke + 1;
          wrong += !overlap || overlap != strokes.overlap[i].pixels;
          pixels += overlap;
        }
      for (int p = 0; p < W * H; p++)
        {
          paper_pixels += paint.data[p] && component.data[p];
          dabbed -= paint.data[p] > 0;
        }
      wrong += dabbed != 0 || pixels != paper_pixels;
      check_kept (&s, &strokes, &state);
      celd_strokes_clear (&strokes);
      s.task.brush = 1;
      CHECK (celd_spills_remove (NULL, &s.task) == CELD_OK);
      join_severed (&paint, &s.ink, stroke);
      slow_spills (&paint, &component, stroke, spill);
      for (int p = 0; p < W * H; p++)
        {
          wrong += celd_seed_rows_at (&s.task.seeds, p % W, p / W) != (spill[p] ? 0 : paint.data[p]);
          stains += spill[p];
        }
      NEAR (wrong, 0, 0);
      sketch_close (&s);
      free (component.data);
      free (paint.data);
    }
  CHECK (stains > 500);
}

/* ------------------------------------------------------------------ spills */

/* The seeds that are left of the painted ones. */
static void
check_left (const char *const *paper, const char *const *painted, float hardness, const char *const *left)
{
  Sketch s;

  sketch_open (&s, paper, painted, 2);
  s.settings.hardness = hardness;
  CHECK (celd_spills_remove (NULL, &s.task) == CELD_OK);
  NEAR (seeds_differing (&s.task.seeds, left), 0, 0);
  sketch_close (&s);
}

static const char *const halves[] = { "111111#2222", "111111#2222", NULL };

static void
paint_behind_a_contour_is_a_spill (void)
{
  static const char *const painted[] = { "AAAAAAAAA..", ".......BBBB", NULL };
  static const char *const left[] = { "AAAAAAA....", ".......BBBB", NULL };

  check_left (halves, painted, 0.05f, left);
  check_left (halves, painted, 1, painted);
}

static void
at_home_or_alone_paint_is_none (void)
{
  static const char *const within[] = { ".......A...", ".......BBBB", NULL };
  static const char *const alone[] = { "AAAAAAAA...", "...........", NULL };

  check_left (halves, within, 0.05f, within);
  check_left (halves, alone, 0.05f, alone);
}

/* A stroke with 2 of its 5 pixels elsewhere: 4 pixels of B do not outweigh the other 3, 5 do. */
static void
a_lesser_spill_has_odds_below_one (void)
{
  static const char *const paper[] = { "1#22222", "1#22222", NULL };
  static const char *const four[] = { "AAAAA..", "A..BBBB", NULL };
  static const char *const five[] = { "AAAAA..", "A.BBBBB", NULL };
  static const char *const left[] = { "AA.....", "A.BBBBB", NULL };

  check_left (paper, four, 0.05f, four);
  check_left (paper, five, 0.05f, left);
}

/* As much paint of A as of B: 6 pixels of the stroke elsewhere do not outweigh the 3 here, 7 do. */
static void
a_spill_has_odds_below_one_half (void)
{
  static const char *const paper[] = { "11111#22222", "11111#22222", NULL };
  static const char *const six[] = { "AAAAAAAAA..", "...A....BBB", NULL };
  static const char *const seven[] = { "AAAAAAAAA..", "..AA....BBB", NULL };
  static const char *const left[] = { "AAAAAA.....", "..AA....BBB", NULL };

  check_left (paper, six, 0.05f, six);
  check_left (paper, seven, 0.05f, left);
}

/* Of two parts in which others have more paint, the stroke is meant for that where it has most. */
static void
where_a_stroke_is_most_likely_meant_it_is_none (void)
{
  static const char *const painted[] = { "..AAAAAA...", "BBBBB.BBBBB", NULL };
  static const char *const paper[] = { "11111#22222", "11111#22222", NULL };
  static const char *const left[] = { "..AAAA.....", "BBBBB.BBBBB", NULL };

  check_left (paper, painted, 0.05f, left);
}

/* Once the lower end is known to be a spill, what is left of A behind the contour does not outweigh B. */
static void
spills_speak_for_no_label (void)
{
  static const char *const paper[] = { "111#2222222", "111#2222222", "111#2222222", "111#2222222", "111#2222222", NULL };
  static const char *const painted[] = {
    "AAAAAAA....", "...........", "......BBBBB", "AAA........", "AAAAAA.....", NULL };
  static const char *const left[] = { "AAAA.......", "...........", "......BBBBB", "AAA........", "AAAA.......", NULL };

  check_left (paper, painted, 0.05f, left);
}

/* Nobody paints the bold contour into which strokes run.  Half as many pixels there as on paper mean it. */
static void
paint_in_a_solid_area_is_a_spill_unless_a_third_is_there (void)
{
  static const char *const paper[] = { "111111#000000", "111111#000000", "111111#000000", NULL };
  static const char *const ends[] = { "AAAAAAAAA....", ".............", "BBBBBBBBB....", NULL };
  static const char *const left[] = { "AAAAAAA......", ".............", "BBBBBBB......", NULL };
  static const char *const meant[] = { "AAAAAAAAAA...", ".............", "......BBBB...", NULL };

  check_left (paper, ends, 0.05f, left);
  check_left (paper, ends, 1, ends);
  check_left (paper, meant, 0.05f, meant);
}

/* ------------------------------------------------------------------ strokes cut in two */

/* How many strokes there are once those that were cut in two are joined; the brush is a pixel wide. */
static size_t
count_joined (const char *const *paper, const char *const *painted)
{
  CeldStrokes strokes;
  Sketch      s;
  size_t      n;

  sketch_open (&s, paper, painted, 2);
  s.task.brush = 1;
  CHECK (celd_strokes_new (&s.task, NULL, &strokes) == CELD_OK);
  CHECK (celd_strokes_join_severed (&s.task, &strokes) == CELD_OK);
  n = strokes.n_strokes;
  for (size_t i = 0; i < strokes.n_pieces; i++)
    CHECK (strokes.piece[i].stroke < n);
  celd_strokes_clear (&strokes);
  sketch_close (&s);
  return n;
}

static void
a_stroke_cut_by_other_paint_or_ink_is_one (void)
{
  static const char *const paper[] = { "1111111", "1111111", "1111111", NULL };
  static const char *const line[] = { "111##11", "111##11", "1##1111", NULL };
  static const char *const across[] = { "AAABAAA", "...B...", "...B...", NULL };
  static const char *const aslant[] = { "A......", "BBBBBBB", "..A....", NULL };
  static const char *const trimmed[] = { "AAA..AA", ".......", ".......", NULL };
  static const char *const apart[] = { "AAA.AAA", ".......", "BBB....", NULL };
  static const char *const thick[] = { "ABBBBA.", ".......", ".......", NULL };

  NEAR (count_joined (paper, across), 2, 0);
  NEAR (count_joined (paper, aslant), 2, 0);
  NEAR (count_joined (line, trimmed), 1, 0);
  NEAR (count_joined (paper, trimmed), 2, 0);
  NEAR (count_joined (paper, apart), 3, 0);
  NEAR (count_joined (paper, thick), 3, 0);
}

/* B was painted later and cuts off the end of A's spill, which alone would look like a stroke at home there. */
static void
the_cut_off_end_of_a_spill_is_a_spill (void)
{
  static const char *const paper[] = { "1111#2222222", "1111#2222222", "1111#2222222", NULL };
  static const char *const painted[] = { "AAAA..B.....", "AAAAAABAA...", "AAAA..BBBBBB", NULL };
  static const char *const left[] = { "AAAA..B.....", "AAAAA.B.....", "AAAA..BBBBBB", NULL };
  Sketch                   s;

  sketch_open (&s, paper, painted, 2);
  s.task.brush = 1;
  CHECK (celd_spills_remove (NULL, &s.task) == CELD_OK);
  NEAR (seeds_differing (&s.task.seeds, left), 0, 0);
  sketch_close (&s);
}

int
main (void)
{
  RUN (overlaps_count_the_paper_of_strokes_by_part);
  RUN (pixels_that_touch_by_a_corner_are_one_stroke);
  RUN (runs_are_cut_where_basins_meet);
  RUN (stroke_pieces_overlaps_and_spills_are_those_of_the_pixels);
  RUN (paint_behind_a_contour_is_a_spill);
  RUN (at_home_or_alone_paint_is_none);
  RUN (a_lesser_spill_has_odds_below_one);
  RUN (a_spill_has_odds_below_one_half);
  RUN (where_a_stroke_is_most_likely_meant_it_is_none);
  RUN (spills_speak_for_no_label);
  RUN (paint_in_a_solid_area_is_a_spill_unless_a_third_is_there);
  RUN (a_stroke_cut_by_other_paint_or_ink_is_one);
  RUN (the_cut_off_end_of_a_spill_is_a_spill);
  return DONE;
}
