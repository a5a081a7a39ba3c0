/* Segmentation of small drawings with known regions: gaps, majorities, background, problems, bad input.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "base/base.h"

/* A drawing and its scribbles as text art, segmented. */
typedef struct
{
  CeldPlane    ink;
  CeldLabels   seeds, labels;
  CeldPalette  palette;
  CeldProblems problems;
  CeldStatus   status;
} Case;

static CeldPalette
letters (size_t n)
{
  CeldPalette p = { calloc (n ? n : 1, sizeof (CeldRegion)), n };

  for (size_t k = 0; k < n; k++)
    p.item[k] = (CeldRegion) { .colour = { (uint8_t) (40 * k), 0, 200, 255 } };
  return p;
}

static Case
segment (const char *const *drawing, const char *const *scribbles, size_t n, CeldSettings settings)
{
  Case c = {
    .ink = art_plane (drawing), .seeds = art_labels (scribbles), .labels = art_labels (drawing), .palette = letters (n)
  };

  c.status = celd_segment (&c.ink, &c.seeds, NULL, &settings, NULL, &c.labels, &c.palette, &c.problems);
  return c;
}

static void
case_clear (Case *c)
{
  free (c->ink.data), free (c->seeds.data), free (c->labels.data);
  celd_palette_clear (&c->palette);
  celd_problems_clear (&c->problems);
}

/* Pixels whose label is not that of the art; '#' and '.' in the art may be anything. */
static int
differing (const Case *c, const char *const *wanted)
{
  CeldLabels w = art_labels (wanted);
  int        n = 0;

  for (int i = 0; i < w.width * w.height; i++)
    n += w.data[i] && c->labels.data[i] != w.data[i];
  free (w.data);
  return n;
}

static size_t
count_problems (const Case *c, CeldProblemKind kind)
{
  size_t n = 0;

  for (size_t i = 0; i < c->problems.n; i++)
    n += c->problems.item[i].kind == kind;
  return n;
}

/* ------------------------------------------------------------------ regions */

static const char *const two_rooms[] = {
  "....................",
  ".##################.",
  ".#.......#........#.",
  ".#.......#........#.",
  ".#.......#........#.",
  ".#.......#........#.",
  ".#.......#........#.",
  ".##################.",
  "....................", NULL };

static const char *const two_scribbles[] = {
  "AAAAAAA.............",
  "....................",
  "....................",
  "...BBB..............",
  "...............C....",
  "...............C....",
  "....................",
  "....................",
  "....................", NULL };

static const char *const two_regions[] = {
  "AAAAAAAAAAAAAAAAAAAA",
  "A..................A",
  "A.BBBBBBB.CCCCCCCC.A",
  "A.BBBBBBB.CCCCCCCC.A",
  "A.BBBBBBB.CCCCCCCC.A",
  "A.BBBBBBB.CCCCCCCC.A",
  "A.BBBBBBB.CCCCCCCC.A",
  "A..................A",
  "AAAAAAAAAAAAAAAAAAAA", NULL };

static void
closed_regions_get_the_label_of_their_stroke (void)
{
  Case c = segment (two_rooms, two_scribbles, 3, celd_settings ());

  CHECK (c.status == CELD_OK && c.problems.n == 0 && c.palette.n == 3);
  CHECK (differing (&c, two_regions) == 0);
  CHECK (c.palette.item[0].background && !c.palette.item[1].background && !c.palette.item[2].background);
  CHECK (c.palette.item[1].seeds == 3 && c.palette.item[1].area >= 35);
  CHECK (c.palette.item[0].area + c.palette.item[1].area + c.palette.item[2].area == 180);
  for (uint32_t k = 0; k < 3; k++)
    CHECK (CELD_AT (&c.labels, c.palette.item[k].x, c.palette.item[k].y) == k + 1 &&
           CELD_AT (&c.ink, c.palette.item[k].x, c.palette.item[k].y) == 1);
  case_clear (&c);
}

/* A gap of two pixels between B and C, which have three pixels of paint each. */
static void
a_stroke_closes_gaps_of_its_length (void)
{
  const char *const gappy[] = {
    "....................",
    ".##################.",
    ".#.......#........#.",
    ".#.......#........#.",
    ".#................#.",
    ".#................#.",
    ".#.......#........#.",
    ".##################.",
    "....................", NULL };
  const char *const scribbles[] = {
    "AAAAAAA.............",
    "....................",
    "....................",
    "...BBB..............",
    "...............C....",
    "...............C....",
    "...............C....",
    "....................",
    "....................", NULL };
  Case              c = segment (gappy, scribbles, 3, celd_settings ());

  CHECK (c.status == CELD_OK);
  CHECK (differing (&c, two_regions) == 0);
  case_clear (&c);
}

/* The stroke of C runs on through the contour into the enclosure of B. */
static const char *const sloppy[] = {
  "AAAAAAA.............",
  "....................",
  "..BBBBBBB...........",
  "....................",
  ".......CCCCCCCCC....",
  "....................",
  "....................",
  "....................",
  "....................", NULL };

static void
a_majority_of_paint_wins (void)
{
  Case c = segment (two_rooms, sloppy, 3, celd_settings ());

  CHECK (c.status == CELD_OK && count_problems (&c, CELD_PROBLEM_STROKE_OVERRULED) == 0);
  CHECK (differing (&c, two_regions) == 0);
  case_clear (&c);
}

static void
hard_strokes_are_obeyed (void)
{
  CeldSettings settings = celd_settings ();
  int          lost = 0;

  settings.hardness = 1;
  Case c = segment (two_rooms, sloppy, 3, settings);
  CHECK (c.status == CELD_OK);
  for (int i = 0; i < 180; i++)
    lost += c.seeds.data[i] && c.seeds.data[i] != c.labels.data[i];
  CHECK (lost == 0);
  case_clear (&c);
}

/* Paint of both in one enclosure: the smaller stroke loses, and that is reported. */
static void
overruled_strokes_and_lost_colours_are_reported (void)
{
  const char *const scribbles[] = {
    "AAAAAAA.............",
    "....................",
    "..BBBBBBB...........",
    "..BBBBBBB...........",
    "..BBCBBBB...........",
    "..BBBBBBB...........",
    "....................",
    "....................",
    "....................", NULL };
  Case              c = segment (two_rooms, scribbles, 3, celd_settings ());

  CHECK (c.status == CELD_OK);
  CHECK (count_problems (&c, CELD_PROBLEM_COLOUR_LOST) == 1);
  CHECK (count_problems (&c, CELD_PROBLEM_REGION_UNREACHED) == 1);
  for (size_t i = 0; i < c.problems.n; i++)
    if (c.problems.item[i].kind == CELD_PROBLEM_COLOUR_LOST)
      CHECK (c.problems.item[i].label == 3 && c.problems.item[i].x == 4 && c.problems.item[i].y == 4);
    else if (c.problems.item[i].kind == CELD_PROBLEM_REGION_UNREACHED)
      CHECK (c.problems.item[i].x > 9 && c.problems.item[i].x < 18);
  case_clear (&c);
}

/* Antialiased and faint lines, from a tenth up to a half of ink. */
static void
thin_grey_lines_close (void)
{
  const char *const grey[] = {
    "....................",
    ".444444444444444444.",
    ".4.......3........4.",
    ".4.......4........4.",
    ".4.......2........4.",
    ".4.......1........4.",
    ".4.......4........4.",
    ".444444444444444444.",
    "....................", NULL };
  Case              c = segment (grey, two_scribbles, 3, celd_settings ());

  CHECK (differing (&c, two_regions) == 0);
  case_clear (&c);
}

static void
a_flat_colouring_gives_each_region_its_colour (void)
{
  const char *const flats[] = {
    "AAAAAAAAAAAAAAAAAAAA",
    "AADDDDDDDDDDDDDDDDDA",
    "ADBBBBBBBDCCCCCCCCDA",
    "ADBBBBBBBDCCCCCCCCDA",
    "ADBBBBBBBDCCCCEECCDA",
    "ADBBBBBBBDCCCCEECCDA",
    "ADBBBBBBBDCCCCCCCCDA",
    "ADDDDDDDDDDDDDDDDDDA",
    "AAAAAAAAAAAAAAAAAAAA", NULL };
  CeldSettings      settings = celd_settings ();
  Case              c;

  settings.flats = true;
  c = segment (two_rooms, flats, 5, settings);
  CHECK (c.status == CELD_OK);
  CHECK (c.palette.item[3].area == 0);                            /* the lines are no region */
  CHECK (c.palette.item[4].area == 4 && CELD_AT (&c.labels, 14, 4) == 5);
  CHECK (c.palette.item[1].area >= 35 && c.palette.item[2].area >= 36);
  CHECK (c.palette.item[0].background);
  case_clear (&c);
}

/* ------------------------------------------------------------------ background */

static const char *const inside_only[] = {
  "....................",
  "....................",
  "....................",
  "...AAA..............",
  "...............B....",
  "...............B....",
  "....................",
  "....................",
  "....................", NULL };

static void
paper_along_the_frame_becomes_background (void)
{
  const char *const wanted[] = {
    "CCCCCCCCCCCCCCCCCCCC",
    "C..................C",
    "C.AAAAAAA.BBBBBBBB.C",
    "C.AAAAAAA.BBBBBBBB.C",
    "C.AAAAAAA.BBBBBBBB.C",
    "C.AAAAAAA.BBBBBBBB.C",
    "C.AAAAAAA.BBBBBBBB.C",
    "C..................C",
    "CCCCCCCCCCCCCCCCCCCC", NULL };
  CeldSettings      settings = celd_settings ();
  Case              c = segment (two_rooms, inside_only, 2, settings);

  CHECK (c.palette.n == 3 && c.palette.item[2].background && c.palette.item[2].origin == CELD_FROM_BACKGROUND);
  CHECK (c.palette.item[2].colour[3] == 0 && c.palette.item[2].seeds == 0);
  CHECK (differing (&c, wanted) == 0);
  case_clear (&c);
  settings.background = CELD_BACKGROUND_NONE;
  c = segment (two_rooms, inside_only, 2, settings);
  CHECK (c.palette.n == 2 && !c.palette.item[0].background && !c.palette.item[1].background);
  case_clear (&c);
  settings.background = CELD_BACKGROUND_COLOUR;
  settings.background_colour[0] = 255, settings.background_colour[1] = settings.background_colour[2] = 0;
  c = segment (two_rooms, inside_only, 2, settings);
  CHECK (c.palette.n == 3 && c.palette.item[2].background);
  CHECK (c.palette.item[2].colour[0] == 255 && c.palette.item[2].colour[3] == 255);
  CHECK (differing (&c, wanted) == 0);
  case_clear (&c);
  settings.background_colour[0] = 41, settings.background_colour[2] = 200; /* B, off by one */
  c = segment (two_rooms, inside_only, 2, settings);
  CHECK (c.palette.n == 2 && c.palette.item[1].background && CELD_AT (&c.labels, 0, 0) == 2);
  case_clear (&c);
}

/* The part behind a figure that spans the page has no stroke: it is background too. */
static void
background_on_both_sides_is_one_label (void)
{
  const char *const spanning[] = { "....#....#....", "....#....#....", "....#....#....", "....#....#....", NULL };
  const char *const scribbles[] = { "..............", ".AAA..BB......", "..............", "..............", NULL };
  const char *const wanted[] = { "AAAA.BBBB.AAAA", "AAAA.BBBB.AAAA", "AAAA.BBBB.AAAA", "AAAA.BBBB.AAAA", NULL };
  Case              c = segment (spanning, scribbles, 2, celd_settings ());

  CHECK (c.palette.n == 2 && c.palette.item[0].background);
  CHECK (differing (&c, wanted) == 0);
  case_clear (&c);
}

/* ------------------------------------------------------------------ bad input */

static void
without_seed_or_relation_there_is_nothing_to_go_by (void)
{
  const char *const none[] = { "....", "....", NULL };
  Case              c = segment (none, none, 0, celd_settings ());

  CHECK (c.status == CELD_NOTHING_TO_GO_BY && c.palette.n == 0 && c.problems.n == 0);
  case_clear (&c);
}

static void
pictures_of_a_pixel_or_a_row_are_labelled (void)
{
  const char *const ink[] = { ".", NULL }, *const black[] = { "#", NULL }, *const seed[] = { "A", NULL };
  const char *const row[] = { "...#...", NULL }, *const ends[] = { "A.....B", NULL };
  Case              c = segment (ink, seed, 1, celd_settings ());

  CHECK (c.status == CELD_OK && c.labels.data[0] == 1 && c.palette.item[0].area == 1);
  case_clear (&c);
  c = segment (black, seed, 1, celd_settings ());
  CHECK (c.status == CELD_OK && c.labels.data[0] == 1);
  case_clear (&c);
  c = segment (row, ends, 2, celd_settings ());
  CHECK (c.status == CELD_OK && c.labels.data[2] == 1 && c.labels.data[4] == 2);
  case_clear (&c);
}

static void
cancel_at_any_time_leaves_results (void)
{
  CeldSettings settings = celd_settings ();
  bool         finished = false;

  for (int n = 0; !finished && n < 1000; n++)
    {
      int          left = n, changed = 0;
      CeldHost     host = { check_count_down, NULL, &left };
      CeldPlane    ink = art_plane (two_rooms);
      CeldLabels   seeds = art_labels (two_scribbles), labels = art_labels (two_rooms);
      CeldPalette  palette = letters (3);
      CeldProblems problems = { 0 };
      CeldStatus   status = celd_segment (&ink, &seeds, NULL, &settings, &host, &labels, &palette, &problems);

      for (int i = 0; i < 180; i++)
        changed += labels.data[i] != 0;
      CHECK (status == CELD_OK || status == CELD_CANCELLED);
      CHECK (status == CELD_OK || (!changed && palette.item[1].area == 0 && problems.n == 0));
      celd_palette_clear (&palette);
      celd_problems_clear (&problems);
      free (ink.data), free (seeds.data), free (labels.data);
      finished = status == CELD_OK;
      CHECK (!finished || n > 3); /* there were places to stop at */
    }
  CHECK (finished);
}

/* Rows farther apart than their width, seeds in place, NaN for paper, seeds without a colour. */
static void
strides_aliases_nan_and_unknown_seeds_are_allowed (void)
{
  CeldPlane    tight = art_plane (two_rooms), ink = { 20, 9, 23, malloc (9 * 23 * sizeof (float)) };
  CeldLabels   art = art_labels (two_scribbles), labels = { 20, 9, 31, malloc (9 * 31 * sizeof (uint32_t)) };
  CeldLabels   tight_labels = art_labels (two_rooms);
  CeldPalette  palette = letters (3), other = letters (3);
  CeldSettings settings = celd_settings ();
  int          bad = 0;

  for (int i = 0; i < 9 * 23; i++)
    ink.data[i] = NAN;
  for (int i = 0; i < 9 * 31; i++)
    labels.data[i] = 2;
  for (int y = 0; y < 9; y++)
    for (int x = 0; x < 20; x++)
      {
        CELD_AT (&ink, x, y)    = CELD_AT (&tight, x, y) < 1 ? 0 : NAN;
        CELD_AT (&labels, x, y) = CELD_AT (&art, x, y);
      }
  CELD_AT (&labels, 19, 8) = 4000000000u;
  CHECK (celd_segment (&ink, &labels, NULL, &settings, NULL, &labels, &palette, NULL) == CELD_OK);
  CHECK (celd_segment (&tight, &art, NULL, &settings, NULL, &tight_labels, &other, NULL) == CELD_OK);
  for (int y = 0; y < 9; y++)
    for (int x = 0; x < 31; x++)
      bad += x < 20 ? CELD_AT (&labels, x, y) != CELD_AT (&tight_labels, x, y) : labels.data[31 * y + x] != 2;
  CHECK (bad == 0);
  labels.width = 19;
  CHECK (celd_segment (&tight, &art, NULL, &settings, NULL, &labels, &palette, NULL) == CELD_BAD_SIZE);
  labels.width = 20;
  settings.hardness = NAN;
  CHECK (celd_segment (&tight, &art, NULL, &settings, NULL, &labels, &palette, NULL) == CELD_BAD_VALUE);
  celd_palette_clear (&palette);
  celd_palette_clear (&other);
  free (tight.data), free (ink.data), free (art.data), free (labels.data), free (tight_labels.data);
}

/* A circle of radius 120, its line 6 wide, with a gap of 60 pixels between the tips, at any angle; a stroke inside and
 * one outside.  The boundary in the gap is at most 3 pixels off the chord. */
static void
a_gap_in_a_circle_is_closed_near_its_chord (void)
{
  enum { SIDE = 300 };
  const double pi = 3.14159265358979, half = asin ((60 + 6) / 2. / 120); /* the tips are round */

  for (int degrees = 0; degrees < 360; degrees += 15)
    {
      double       at = degrees * pi / 180, chord = 120 * cos (asin (30. / 120)), worst = 0;
      CeldPlane    ink = { SIDE, SIDE, SIDE, malloc (SIDE * SIDE * sizeof (float)) };
      CeldLabels   labels = { SIDE, SIDE, SIDE, calloc (SIDE * SIDE, sizeof (uint32_t)) };
      CeldPalette  palette = letters (2);
      CeldSettings settings = celd_settings ();
      int          boundaries = 0;

      for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
          {
            double dx = x + 0.5 - SIDE / 2, dy = y + 0.5 - SIDE / 2, angle = remainder (atan2 (dy, dx) - at, 2 * pi);
            double off = fabs (hypot (dx, dy) - 120), tip = fabs (angle) < half ? copysign (half, angle) : angle;

            if (fabs (angle) < half)
              off = hypot (dx - 120 * cos (at + tip), dy - 120 * sin (at + tip));
            CELD_AT (&ink, x, y) = (float) fmin (fmax (off - 2.5, 0), 1);
            if (abs (y - SIDE / 2) < 4 && abs (x - SIDE / 2) < 15)
              CELD_AT (&labels, x, y) = 1;
            else if (y < 6)
              CELD_AT (&labels, x, y) = 2;
          }
      CHECK (celd_segment (&ink, &labels, NULL, &settings, NULL, &labels, &palette, NULL) == CELD_OK);
      for (int y = 0; y < SIDE - 1; y++)
        for (int x = 0; x < SIDE - 1; x++)
          for (int south = 0; south < 2; south++)
            {
              int u = x + !south, v = y + south;

              if (CELD_AT (&labels, x, y) == CELD_AT (&labels, u, v) || CELD_AT (&ink, x, y) < 0.5f ||
                  CELD_AT (&ink, u, v) < 0.5f)
                continue;
              worst = fmax (worst, fabs (((x + u + 1) * 0.5 - SIDE / 2) * cos (at) +
                                         ((y + v + 1) * 0.5 - SIDE / 2) * sin (at) - chord));
              boundaries++;
            }
      CHECK (boundaries >= 40 && boundaries <= 120);
      CHECK (worst <= 3);
      CHECK (CELD_AT (&labels, SIDE / 2, SIDE / 2 + 60) == 1 && CELD_AT (&labels, 2, SIDE - 3) == 2);
      celd_palette_clear (&palette);
      free (ink.data), free (labels.data);
    }
}

int
main (void)
{
  RUN (closed_regions_get_the_label_of_their_stroke);
  RUN (a_gap_in_a_circle_is_closed_near_its_chord);
  RUN (a_stroke_closes_gaps_of_its_length);
  RUN (a_majority_of_paint_wins);
  RUN (hard_strokes_are_obeyed);
  RUN (overruled_strokes_and_lost_colours_are_reported);
  RUN (thin_grey_lines_close);
  RUN (a_flat_colouring_gives_each_region_its_colour);
  RUN (paper_along_the_frame_becomes_background);
  RUN (background_on_both_sides_is_one_label);
  RUN (without_seed_or_relation_there_is_nothing_to_go_by);
  RUN (pictures_of_a_pixel_or_a_row_are_labelled);
  RUN (cancel_at_any_time_leaves_results);
  RUN (strides_aliases_nan_and_unknown_seeds_are_allowed);
  return DONE;
}
