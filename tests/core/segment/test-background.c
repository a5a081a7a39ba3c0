/* Who gets the paper along the frame.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "random-sketch.h"
#include "segment/basins.h"
#include "segment/task.h"

/* Seeds after celd_background_seed; returns the number of the background's label, 0 if none is marked. */
static uint32_t
seed (Sketch *s, const char *const *wanted)
{
  uint32_t marked = 0;

  CHECK (celd_background_seed (NULL, NULL, &s->task) == CELD_OK);
  NEAR (seeds_differing (&s->task.seeds, wanted), 0, 0);
  for (size_t k = 0; k < s->task.palette.n; k++)
    if (s->task.palette.item[k].background)
      {
        CHECK (!marked);
        marked = (uint32_t) k + 1;
      }
  return marked;
}

/* Of `n` labels painted, the background gets `label` and the seeds `wanted`; then there are `after` labels. */
static void
check_background (const char *const *paper, const char *const *painted, size_t n, const char *const *wanted,
                  uint32_t label, size_t after)
{
  Sketch s;

  sketch_open (&s, paper, painted, n);
  NEAR (seed (&s, wanted), label, 0);
  NEAR (s.task.palette.n, after, 0);
  sketch_close (&s);
}

static const char *const ring[] = { "1111111", "1#####1", "1#222#1", "1#222#1", "1#####1", "1111111", NULL };
static const char *const figure_only[] = { ".......", ".......", "...A...", "...A...", ".......", ".......", NULL };
static const char *const framed[] = { "BBBBBBB", "B.....B", "B..A..B", "B..A..B", "B.....B", "BBBBBBB", NULL };

static void
a_frame_without_owner_gets_a_transparent_label (void)
{
  Sketch s;

  sketch_open (&s, ring, figure_only, 1);
  NEAR (seed (&s, framed), 2, 0);
  NEAR (s.task.palette.n, 2, 0);
  if (s.task.palette.n == 2)
    {
      CHECK (s.task.palette.item[1].origin == CELD_FROM_BACKGROUND && s.task.palette.item[1].hard);
      NEAR (s.task.palette.item[1].colour[3], 0, 0);
    }
  sketch_close (&s);
}

static void
a_painted_frame_stays_as_it_is (void)
{
  static const char *const painted[] = { ".......", ".......", "...A...", ".......", ".......", ".BB....", NULL };

  check_background (ring, painted, 2, painted, 2, 2);
}

static void
settings_name_the_background_or_turn_it_off (void)
{
  Sketch s;

  sketch_open (&s, ring, figure_only, 1);
  s.settings.background = CELD_BACKGROUND_NONE;
  NEAR (seed (&s, figure_only), 0, 0);
  sketch_close (&s);

  sketch_open (&s, ring, figure_only, 2);
  s.settings.background = CELD_BACKGROUND_COLOUR;
  memcpy (s.settings.background_colour, s.task.palette.item[1].colour, 3);
  NEAR (seed (&s, framed), 2, 0);
  NEAR (s.task.palette.n, 2, 0);
  sketch_close (&s);

  sketch_open (&s, ring, figure_only, 1);
  s.settings.background = CELD_BACKGROUND_COLOUR;
  memset (s.settings.background_colour, 99, 3);
  NEAR (seed (&s, framed), 2, 0);
  NEAR (s.task.palette.n == 2 ? s.task.palette.item[1].colour[1] : 0, 99, 0);
  sketch_close (&s);
}

/* A holds most of the frame; the corner that the figure cuts off belongs to it as well. */
static void
a_corner_cut_off_joins_the_background (void)
{
  static const char *const paper[] = { "1111#22", "11111#2", "111111#", "1111111", NULL };
  static const char *const painted[] = { ".......", ".AA....", ".......", ".......", NULL };
  static const char *const wanted[] = { ".....AA", ".AA...A", ".......", ".......", NULL };

  check_background (paper, painted, 1, wanted, 1, 1);
}

/* Only a painted background may be in a room that the artist has forgotten; an unpainted page is one by intent. */
static void
what_a_painted_background_gets_is_remembered (void)
{
  static const char *const paper[] = { "1111#22", "11111#2", "111111#", "1111111", NULL };
  static const char *const painted[] = { ".......", ".AA....", ".......", ".......", NULL };
  static const char *const wanted[] = { ".....AA", ".AA...A", ".......", ".......", NULL };
  Sketch                   s;

  sketch_open (&s, paper, painted, 1);
  NEAR (seed (&s, wanted), 1, 0);
  CHECK (s.task.unpainted && !s.task.unpainted[1] && s.task.unpainted[2]);
  sketch_close (&s);
  sketch_open (&s, ring, figure_only, 1);
  NEAR (seed (&s, framed), 2, 0);
  CHECK (!s.task.unpainted);
  sketch_close (&s);
}

/* The frame cuts off a figure; with a fifth of the frame it is not the background. */
static void
a_figure_that_the_frame_cuts_off_is_not_the_background (void)
{
  static const char *const paper[] = { "11111111", "11111111", "1######1", "1#2222#1", NULL };
  static const char *const painted[] = { "........", "........", "........", "...A....", NULL };
  static const char *const wanted[] = { "BBBBBBBB", "B......B", "B......B", "B..A...B", NULL };

  check_background (paper, painted, 1, wanted, 2, 2);
}

/* A runs on out of the figure.  A soft stroke is at home where most of it is, and loses what lies in an
 * enclosure without owner; an obeyed one holds the frame. */
static void
a_stroke_that_runs_out_does_not_hold_the_frame (void)
{
  static const char *const paper[] = { "1111111", "11#####", "11#2222", "11#####", "1111111", NULL };
  static const char *const painted[] = { ".......", ".......", ".AAAAA.", ".......", ".......", NULL };
  static const char *const wanted[] = { "BBBBBBB", "B......", "B.AAAA.", "B......", "BBBBBBB", NULL };
  Sketch                   s;

  sketch_open (&s, paper, painted, 1);
  NEAR (seed (&s, wanted), 2, 0);
  sketch_close (&s);
  sketch_open (&s, paper, painted, 1);
  s.settings.hardness = 1;
  CHECK (celd_background_seed (NULL, NULL, &s.task) == CELD_OK);
  CHECK (s.task.palette.n == 1 && s.task.palette.item[0].background);
  sketch_close (&s);
}

/* Lines from edge to edge cut the page into strips.  A runs over three of them, and is at home in none of them. */
static void
a_stroke_over_hatching_holds_the_frame (void)
{
  static const char *const paper[] = {
    "1111111#2#3#4#5555555", "1111111#2#3#4#5555555", "1111111#2#3#4#5555555", NULL
  };
  static const char *const painted[] = {
    ".....................", "........AAAAA........", ".....................", NULL
  };
  static const char *const wanted[] = {
    "AAAAAAA.......AAAAAAA", "A.......AAAAA.......A", "AAAAAAA.......AAAAAAA", NULL
  };

  check_background (paper, painted, 1, wanted, 1, 1);
}

/* A stroke runs on into another part of the figure, which the frame cuts off.  It counts there if no other label has paint
 * there. */
static void
a_part_that_only_one_label_reaches_is_its_own (void)
{
  static const char *const paper[] = {
    "1111111111", "1111111111", "1####11111", "1#33######", "1#33#22222", "1#########", "1111111111", NULL
  };
  static const char *const painted[] = {
    "..........", "..........", "..........", "..AA......", "..AAAA....", "..........", "..........", NULL
  };
  static const char *const wanted[] = {
    "BBBBBBBBBB", "B........B", "B........B", "B.AA......", "B.AAAA....", "B.........", "BBBBBBBBBB", NULL
  };

  check_background (paper, painted, 1, wanted, 2, 2);
}

/* The page is seen between two figures; a stroke that was led out there onto the page round them, without running over a
 * line, holds the frame, too. */
static void
a_stroke_led_out_between_lines_holds_the_frame (void)
{
  static const char *const paper[] = { "1111111", "11#####", "1122222", "11#####", "1111111", NULL };
  static const char *const painted[] = { ".......", ".......", ".AAAAA.", ".......", ".......", NULL };

  check_background (paper, painted, 1, painted, 1, 1);
}

/* A small enclosure behind a gap goes to the owner of its component, and gets no seeds. */
static void
behind_a_gap_the_component_counts (void)
{
  static const char *const enclosures[] = { "1111#22", "1111122", "1111#22", "1111111", NULL };
  static const char *const painted[] = { ".......", ".AA....", ".......", ".......", NULL };
  Sketch                   s;

  sketch_open (&s, enclosures, painted, 1);
  s.basins.component[1] = 1;
  NEAR (seed (&s, painted), 1, 0);
  sketch_close (&s);
}

/* Flecks of paper in a solid area that the frame cuts off, some of them painted: they are in no enclosure, so that
 * none takes the paint away from another. */
static void
flecks_in_solid_ink_are_left_alone (void)
{
  static const char *const solid[] = { "111#000", "111#000", "111#000", "111#000", NULL };
  static const char *const painted[] = { ".......", ".A..B..", "......B", ".......", NULL };
  Sketch                   s;

  sketch_open (&s, solid, painted, 2);
  s.ink.data[1 * 7 + 4] = s.ink.data[2 * 7 + 6] = s.ink.data[3 * 7 + 6] = 1;
  celd_free (s.basins.paper);
  CHECK (celd_paper_new (&s.ink, NULL, &s.basins.paper) == CELD_OK);
  NEAR (seed (&s, painted), 1, 0);
  sketch_close (&s);
}

/* B lies on paper that a bridge hides, in a corner that has no other owner. */
static void
an_obeyed_stroke_under_a_bridge_stays (void)
{
  static const char *const corner[] = { "1111#22", "1111#22", "11111##", "1111111", NULL };
  static const char *const painted[] = { "......B", ".AA....", ".......", ".......", NULL };
  static const char *const wanted[] = { ".....AB", ".AA...A", ".......", ".......", NULL };
  Sketch                   s;

  sketch_open (&s, corner, painted, 2);
  s.settings.hardness = 1;
  s.ink.data[6] = 0;
  celd_free (s.basins.paper);
  CHECK (celd_paper_new (&s.ink, NULL, &s.basins.paper) == CELD_OK);
  s.ink.data[6] = 1;
  NEAR (seed (&s, wanted), 1, 0);
  sketch_close (&s);
}

/* A close-up: the figure A owns most of the frame, but is in front of B, so the page beside it is none of A's. */
static void
a_label_in_front_of_another_is_no_background (void)
{
  static const char *const paper[] = { "111#22222222", "111#22222222", "111#22222222", "111#2222####", "111#2222#333",
                                       "111#2222#333", NULL };
  static const char *const painted[] = { "............", "......AAA...", "............", "............",
                                         "..........B.", "............", NULL };
  static const char *const as_own[] = { "AAA.........", "A.....AAA...", "A...........", "A...........",
                                        "A.........B.", "AAA.........", NULL };
  static const char *const as_page[] = { "CCC.........", "C.....AAA...", "C...........", "C...........",
                                         "C.........B.", "CCC.........", NULL };
  CeldRelation             relation = { .nearer = { .x = 5, .y = 4 }, .farther = { .x = 10, .y = 4 } };
  CeldRelations            relations = { &relation, 1 };
  Sketch                   s;

  check_background (paper, painted, 2, as_own, 1, 2);
  for (int round = 0; round < 2; round++)
    {
      sketch_open (&s, paper, painted, 2);
      relation.equal = round;
      CHECK (celd_background_seed (&relations, NULL, &s.task) == CELD_OK);
      NEAR (seeds_differing (&s.task.seeds, round ? as_own : as_page), 0, 0);
      NEAR (s.task.palette.n, round ? 2 : 3, 0);
      NEAR (s.task.n_effective, !round, 0);
      sketch_close (&s);
    }
}

/* ------------------------------------------------------------------ the same by pixels */

/* What the slow version knows of each pixel. */
typedef struct
{
  CeldLabels painted, enclosure;
  uint32_t   stroke[W * H], component[W * H];
  bool       ink[W * H], all_count;
  int        n_frame;
} Pixels;

/* Does the stroke of pixel p count in its part?  *across: because it runs on along the frame.  along: frame pixels of
 * each part. */
static bool
slow_at_home (const Pixels *s, const uint32_t part[W * H], const int along[5], int p, bool *across)
{
  int  in[5] = { 0 }, total = 0, in_frame = 0, here = (int) part[p];
  bool home = false, crosses = false, alone = true;

  for (int q = 0; q < W * H; q++)
    {
      bool same = s->stroke[q] == s->stroke[p];

      crosses |= same && s->ink[q];
      alone &= (int) part[q] != here || !s->painted.data[q] || s->painted.data[q] == s->painted.data[p];
      if (same && s->enclosure.data[q])
        {
          total++;
          in[part[q]]++;
          in_frame += along[part[q]] > 0;
        }
    }
  for (int k = 1; k < 5; k++)
    home |= 2 * in[k] >= total;
  *across = !home && along[here] && 2 * in_frame >= total;
  return *across || 2 * in[here] >= total ||
         (along[here] && (!crosses || (alone && 4 * along[here] < s->n_frame)) && 8 * in[here] >= total);
}

static uint32_t
slow_holder (const Pixels *s, const uint32_t part[W * H], const int along[5], uint32_t which, bool across[5])
{
  int      most = 0, all = 0, labels = 0;
  uint32_t holder = 0;

  for (uint32_t l = 1; l <= 3; l++)
    {
      int paint = 0, paint_here = 0;

      for (int p = 0; p < W * H; p++)
        if (part[p] == which && s->painted.data[p] == l)
          {
            bool runs_on;

            labels += !paint_here++;
            all++;
            paint += slow_at_home (s, part, along, p, &runs_on) || s->all_count;
            across[l] |= runs_on;
          }
      if (paint > most)
        {
          most   = paint;
          holder = l;
        }
    }
  return part == s->component && labels * most < all ? 0 : holder;
}

/* Leaves the wanted seeds in s->painted; returns the background's label. */
static uint32_t
slow_background (Pixels *s, const CeldPlane *ink)
{
  size_t  *frame, n;
  uint32_t holder[4 * (W + H)], of_room[5], of_piece[5], label = 0;
  int      along[5] = { 0 }, along_piece[5] = { 0 }, held[5] = { 0 };
  bool     lost[5] = { false }, across[5] = { false };

  CHECK (celd_frame (ink, W, H, 1, &frame, &n) == CELD_OK);
  s->n_frame = (int) n;
  for (size_t i = 0; i < n; i++)
    {
      along[s->enclosure.data[frame[i]]]++;
      along_piece[s->component[frame[i]]]++;
    }
  for (uint32_t k = 1; k <= 4; k++)
    {
      of_room[k]  = slow_holder (s, s->enclosure.data, along, k, across);
      of_piece[k] = slow_holder (s, s->component, along_piece, k, across);
    }
  for (size_t i = 0; i < n; i++)
    {
      uint32_t enclosure = s->enclosure.data[frame[i]];

      holder[i] = of_room[enclosure] || 4 * along[enclosure] >= (int) n ? of_room[enclosure] :
      of_piece[s->component[frame[i]]];
      held[holder[i]]++;
    }
  for (uint32_t l = 1; l <= 3; l++)
    if (held[l] > (label ? held[label] : 0))
      label = l;
  if (label && 4 * held[label] < (int) n && held[0] > held[label])
    {
      label = 0;
      for (uint32_t l = 1; l <= 3; l++)
        if (across[l] && held[l] > (label ? held[label] : 0))
          label = l;
    }
  if (!label && held[0])
    label = 4;
  for (size_t i = 0; i < n; i++)
    lost[s->enclosure.data[frame[i]]] |= !holder[i];
  for (int p = 0; p < W * H; p++)
    if (s->enclosure.data[p] && lost[s->enclosure.data[p]])
      s->painted.data[p] = 0;
  for (size_t i = 0; i < n; i++)
    if (!holder[i])
      s->painted.data[frame[i]] = label;
  celd_free (frame);
  return label;
}

static void
seeds_are_those_of_the_pixels (void)
{
  uint32_t state = 4;
  int      own = 0, spilled = 0;

  for (int round = 0; round < 300; round++)
    {
      char        paper[H][W + 1] = { { 0 } }, painted[H][W + 1] = { { 0 } };
      const char *paper_rows[H + 1] = { NULL }, *painted_rows[H + 1] = { NULL };
      uint32_t    label, joined = check_random (&state, 3);
      Pixels      pixels;
      Sketch      s;
      int         wrong = 0;

      random_sketch (&state, 1 + (int) check_random (&state, 4), paper, painted);
      for (int y = 0; y < H; y++)
        {
          paper_rows[y]   = paper[y];
          painted_rows[y] = painted[y];
        }
      sketch_open (&s, paper_rows, painted_rows, 3);
      s.settings.hardness = round % 4 ? 0.05f : 1;
      pixels = (Pixels) { .painted = art_labels (painted_rows), .enclosure = art_labels (paper_rows),
                          .all_count = round % 4 == 0 };
      s.task.brush = 1;
      flood (&pixels.painted, pixels.stroke);
      if (joined) /* an enclosure behind a gap */
        s.basins.component[joined] = 1;
      for (int p = 0; p < W * H; p++)
        {
          pixels.component[p] = pixels.enclosure.data[p] == joined + 1 ? 1 : pixels.enclosure.data[p];
          pixels.ink[p] = !celd_is_paper (s.ink.data[p]);
        }
      if (round % 2) /* as in a segmentation: what is left of spills counts, and strokes that they have cut in two */
        {
          CHECK (celd_spills_remove (NULL, &s.task) == CELD_OK);
          celd_seed_rows_write (&s.task.seeds, &pixels.painted);
          flood (&pixels.painted, pixels.stroke);
          spilled += s.task.spilled;
        }
      if (!pixels.all_count)
        join_severed (&pixels.painted, &s.ink, pixels.stroke);
      label = slow_background (&pixels, &s.ink);
      CHECK (celd_background_seed (NULL, NULL, &s.task) == CELD_OK);
      for (int p = 0; p < W * H; p++)
        wrong += celd_seed_rows_at (&s.task.seeds, p % W, p / W) != pixels.painted.data[p];
      NEAR (wrong, 0, 0);
      CHECK (s.task.palette.n == (label == 4 ? 4 : 3));
      CHECK (!label || s.task.palette.item[label - 1].background);
      own += label == 4;
      sketch_close (&s);
      free (pixels.painted.data);
      free (pixels.enclosure.data);
    }
  CHECK (own > 20 && own < 280 && spilled > 10);
}

int
main (void)
{
  RUN (a_frame_without_owner_gets_a_transparent_label);
  RUN (a_painted_frame_stays_as_it_is);
  RUN (settings_name_the_background_or_turn_it_off);
  RUN (a_corner_cut_off_joins_the_background);
  RUN (what_a_painted_background_gets_is_remembered);
  RUN (a_figure_that_the_frame_cuts_off_is_not_the_background);
  RUN (a_stroke_that_runs_out_does_not_hold_the_frame);
  RUN (a_label_in_front_of_another_is_no_background);
  RUN (a_stroke_over_hatching_holds_the_frame);
  RUN (a_part_that_only_one_label_reaches_is_its_own);
  RUN (a_stroke_led_out_between_lines_holds_the_frame);
  RUN (behind_a_gap_the_component_counts);
  RUN (flecks_in_solid_ink_are_left_alone);
  RUN (an_obeyed_stroke_under_a_bridge_stays);
  RUN (seeds_are_those_of_the_pixels);
  return DONE;
}
