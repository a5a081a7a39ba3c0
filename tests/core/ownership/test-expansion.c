/* Depth expansion: known answers on small pictures, and properties of any picture.
 *
 * In the pictures '#' is ink; letters and digits are the paper of that rank.  Before expansion ink has the rank of the
 * paper to its left (or above), as if the segmentation had cut at its far side.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "image/image.h"

typedef struct
{
  CeldPlane  ink;
  CeldLabels ranks, expanded;
} Picture;

static Picture
picture_of (const char *const *rows)
{
  Picture p = { art_plane (rows), art_labels (rows), art_labels (rows) };

  for (int y = 0; y < p.ink.height; y++)
    for (int x = 0; x < p.ink.width; x++)
      {
        bool is_ink = rows[y][x] == '#';

        CELD_AT (&p.ink, x, y) = is_ink ? 0.f : 1.f;
        if (is_ink && x > 0)
          CELD_AT (&p.ranks, x, y) = CELD_AT (&p.ranks, x - 1, y);
        else if (is_ink && y > 0)
          CELD_AT (&p.ranks, x, y) = CELD_AT (&p.ranks, x, y - 1);
      }
  return p;
}

static void
picture_free (Picture *p)
{
  free (p->ink.data);
  free (p->ranks.data);
  free (p->expanded.data);
}

/* Expansion of `rows` must give `wanted`. */
static void
expect (const char *const *rows, const char *const *wanted)
{
  Picture    p = picture_of (rows);
  CeldLabels w = art_labels (wanted);
  size_t     n = w.stride * (size_t) w.height;

  CHECK (celd_expand (&p.ink, &p.ranks, NULL, &p.expanded) == CELD_OK);
  CHECK (memcmp (p.expanded.data, w.data, n * sizeof *w.data) == 0);
  for (int y = 0; check_bad && y < w.height; y++, fputc ('\n', stderr))
    for (int x = 0; x < w.width; x++)
      fputc ("0ABCDEFGHIJ"[CELD_AT (&p.expanded, x, y) % 11], stderr);

  /* Expanding again changes nothing. */
  CHECK (celd_expand (&p.ink, &p.expanded, NULL, &p.expanded) == CELD_OK);
  CHECK (memcmp (p.expanded.data, w.data, n * sizeof *w.data) == 0);
  picture_free (&p);
  free (w.data);
}

static void
ring_goes_to_the_nearer_side (void)
{
  static const char *const disc[] = {
    "AAAAAAAAA", "AA#####AA", "A##BBB##A", "A#BBBBB#A", "A##BBB##A", "AA#####AA", "AAAAAAAAA", NULL };
  static const char *const hole[] = {
    "BBBBBBBBB", "BB#####BB", "B##AAA##B", "B#AAAAA#B", "B##AAA##B", "BB#####BB", "BBBBBBBBB", NULL };
  static const char *const disc_wanted[] = {
    "AAAAAAAAA", "AABBBBBAA", "ABBBBBBBA", "ABBBBBBBA", "ABBBBBBBA", "AABBBBBAA", "AAAAAAAAA", NULL };
  static const char *const hole_wanted[] = {
    "BBBBBBBBB", "BBBBBBBBB", "BBBAAABBB", "BBAAAAABB", "BBBAAABBB", "BBBBBBBBB", "BBBBBBBBB", NULL };

  expect (disc, disc_wanted);
  expect (hole, hole_wanted);
}

static void
thick_line_goes_over_whole (void)
{
  static const char *const rows[] = { "AAAAAA#########BBBB", "AAAAAA#########BBBB", "AAAAAA#########BBBB", NULL };
  static const char *const wanted[] = { "AAAAAABBBBBBBBBBBBB", "AAAAAABBBBBBBBBBBBB", "AAAAAABBBBBBBBBBBBB", NULL };

  expect (rows, wanted);
}

/* The line between B and C ends at E's outline, which keeps its width; the stem goes to C. */
static void
stem_ends_at_the_front_outline (void)
{
  static const char *const rows[] = {
    "EEEEEEEEEEEEEEEEEEEEEEEEE",
    "EEEEEEEEEEEEEEEEEEEEEEEEE",
    "#########################",
    "#########################",
    "#########################",
    "BBBBBBBBBBB###CCCCCCCCCCC",
    "BBBBBBBBBBB###CCCCCCCCCCC",
    "BBBBBBBBBBB###CCCCCCCCCCC",
    "BBBBBBBBBBB###CCCCCCCCCCC",
    NULL };
  static const char *const wanted[] = {
    "EEEEEEEEEEEEEEEEEEEEEEEEE",
    "EEEEEEEEEEEEEEEEEEEEEEEEE",
    "EEEEEEEEEEEEEEEEEEEEEEEEE",
    "EEEEEEEEEEEEEEEEEEEEEEEEE",
    "EEEEEEEEEEEEEEEEEEEEEEEEE",
    "BBBBBBBBBBBCCCCCCCCCCCCCC",
    "BBBBBBBBBBBCCCCCCCCCCCCCC",
    "BBBBBBBBBBBCCCCCCCCCCCCCC",
    "BBBBBBBBBBBCCCCCCCCCCCCCC",
    NULL };

  expect (rows, wanted);
}

static void
details_stay_inside (void)
{
  static const char *const rows[] = {
    "AAAAAAAAAAAAAA",
    "A############A",
    "A#BBBBBBBBBB#A",
    "A#BB####BBBB#A",
    "A#BBBBBBB####A",
    "A#BBBBBBBBBB#A",
    "A############A",
    "AAAAA#AAAAAAAA",
    "AAAAA#AAA##AAA",
    "AAAAAAAAAAAAAA",
    NULL };
  static const char *const wanted[] = {
    "AAAAAAAAAAAAAA",
    "ABBBBBBBBBBBBA",
    "ABBBBBBBBBBBBA",
    "ABBBBBBBBBBBBA",
    "ABBBBBBBBBBBBA",
    "ABBBBBBBBBBBBA",
    "ABBBBBBBBBBBBA",
    "AAAAAAAAAAAAAA",
    "AAAAAAAAAAAAAA",
    "AAAAAAAAAAAAAA",
    NULL };

  expect (rows, wanted);
}

/* Ink between equal ranks keeps its rank; boundaries on paper do not move. */
static void
equal_ranks_and_virtual_borders (void)
{
  static const char *const equal[] = {
    "AAAAAAAAA", "A#######A", "A#BB#BB#A", "A#BB#BB#A", "A#######A", "AAAAAAAAA", NULL };
  static const char *const equal_wanted[] = {
    "AAAAAAAAA", "ABBBBBBBA", "ABBBBBBBA", "ABBBBBBBA", "ABBBBBBBA", "AAAAAAAAA", NULL };
  static const char *const border[] = { "AAAAABBBBB", "A##AABB##B", "AAAAABBBBB", NULL };
  static const char *const border_wanted[] = { "AAAAABBBBB", "AAAAABBBBB", "AAAAABBBBB", NULL };

  expect (equal, equal_wanted);
  expect (border, border_wanted);
}

static void
paper_alone_and_ink_alone (void)
{
  static const char *const paper[] = { "AABBC", "CABBA", NULL };
  static const char *const dot[] = { "B", NULL };
  static const char *const column[] = { "A", "#", "#", "B", "#", NULL };
  static const char *const column_wanted[] = { "A", "B", "B", "B", "B", NULL };
  uint32_t   data[6] = { 5, 5, 5, 9, 9, 9 }, result[6] = { 0 };
  float      black[6] = { 0 };
  CeldLabels ranks = { 6, 1, 6, data }, expanded = { 6, 1, 6, result };
  CeldPlane  ink = { 6, 1, 6, black };

  expect (paper, paper);
  expect (dot, dot);
  expect (column, column_wanted);
  CHECK (celd_expand (&ink, &ranks, NULL, &expanded) == CELD_OK);
  CHECK (memcmp (data, result, sizeof data) == 0);
}

/* A black patch with a rank of its own is a region, behind or in front of the paper round it. */
static void
black_region_keeps_its_ink (void)
{
  float      black[9 * 9];
  uint32_t   data[9 * 9], result[9 * 9];
  CeldPlane  ink = { 9, 9, 9, black };
  CeldLabels ranks = { 9, 9, 9, data }, expanded = { 9, 9, 9, result };

  for (uint32_t rank = 0; rank <= 8; rank += 4)
    {
      for (int p = 0; p < 81; p++)
        {
          bool patch = p % 9 >= 2 && p % 9 <= 6 && p / 9 >= 2 && p / 9 <= 6;

          black[p] = patch ? 0.f : 1.f;
          data[p] = patch ? rank : 4;
        }
      CHECK (celd_expand (&ink, &ranks, NULL, &expanded) == CELD_OK);
      CHECK (memcmp (data, result, sizeof data) == 0);
    }
}

/* Coarse cells of paper of five ranks with lines and dots of ink; the stride exceeds the width, and some ink is NaN. */
#define SIDE 40

static void
draw_at_random (uint32_t *state, CeldPlane *ink, CeldLabels *ranks)
{
  uint32_t cell[25];

  for (int i = 0; i < 25; i++)
    cell[i] = 7 * check_random (state, 5);
  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      {
        bool line = x % 8 < (int) (cell[y / 8 * 5 + x / 8] / 7) || y % 8 < 2 || check_random (state, 60) == 0;

        CELD_AT (ink, x, y) = line && check_random (state, 30) ? 0.1f : check_random (state, 9) ? 0.9f : NAN;
        CELD_AT (ranks, x, y) = cell[y / 8 * 5 + x / 8];
      }
}

/* Does the 8-connected ink of component k touch paper of another rank than `rank`? */
static bool
touches_other_rank (const CeldPlane *ink, const CeldLabels *ranks, const CeldLabels *component, uint32_t k,
                    uint32_t rank)
{
  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      for (int i = 0; CELD_AT (component, x, y) == k && i < 9; i++)
        {
          int qx = x + i % 3 - 1, qy = y + i / 3 - 1;

          if (qx >= 0 && qy >= 0 && qx < SIDE && qy < SIDE && !(CELD_AT (ink, qx, qy) < 0.5f) &&
              CELD_AT (ranks, qx, qy) != rank)
            return true;
        }
  return false;
}

/* Ink that touches paper of one rank only gets that rank. */
static void
check_lonely_ink (const CeldPlane *ink, const CeldLabels *ranks, const CeldLabels *expanded)
{
  uint32_t       data[SIDE * SIDE];
  CeldLabels     component = { SIDE, SIDE, SIDE, data };
  CeldComponent *list = NULL;
  size_t         n = 0;

  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      CELD_AT (&component, x, y) = CELD_AT (ink, x, y) < 0.5f;
  CHECK (celd_components (&component, 0, true, NULL, &component, &list, &n) == CELD_OK);
  for (int y = 0; y < SIDE; y++)
    for (int x = 1; x < SIDE; x++)
      {
        uint32_t k = CELD_AT (&component, x, y), rank = CELD_AT (ranks, x - 1, y);

        if (k && !CELD_AT (&component, x - 1, y) && !touches_other_rank (ink, ranks, &component, k, rank))
          CHECK (CELD_AT (expanded, x, y) == rank);
      }
  free (list);
}

static void
facts_of_random_pictures (void)
{
  static float    lines[SIDE * (SIDE + 3)];
  static uint32_t before[SIDE * (SIDE + 5)], after[SIDE * SIDE], shifted[SIDE * SIDE];
  CeldPlane       ink = { SIDE, SIDE, SIDE + 3, lines };
  CeldLabels      ranks = { SIDE, SIDE, SIDE + 5, before }, expanded = { SIDE, SIDE, SIDE, after };
  CeldLabels      other = { SIDE, SIDE, SIDE, shifted };
  uint32_t        state = 11;

  for (int round = 0; round < 60; round++)
    {
      int paper_changed = 0, unknown = 0, not_shifted = 0;

      draw_at_random (&state, &ink, &ranks);
      CHECK (celd_expand (&ink, &ranks, NULL, &expanded) == CELD_OK);
      check_lonely_ink (&ink, &ranks, &expanded);
      for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
          CELD_AT (&other, x, y) = UINT32_MAX - 100 + 2 * CELD_AT (&ranks, x, y); /* the same order */
      CHECK (celd_expand (&ink, &other, NULL, &other) == CELD_OK);             /* in place */
      for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
          {
            uint32_t rank = CELD_AT (&expanded, x, y);

            paper_changed += !(CELD_AT (&ink, x, y) < 0.5f) && rank != CELD_AT (&ranks, x, y);
            unknown += rank % 7 != 0 || rank > 28;
            not_shifted += CELD_AT (&other, x, y) != UINT32_MAX - 100 + 2 * rank;
          }
      CHECK (paper_changed == 0);
      CHECK (unknown == 0);
      CHECK (not_shifted == 0);
    }
}

static bool
count_down (void *host, double done)
{
  double *state = host; /* calls left, last progress */

  CHECK (done >= state[1] && done <= 1);
  state[1] = done;
  return state[0]-- > 0;
}

static void
progress_rises_and_cancel_changes_nothing (void)
{
  static const char *const rows[] = {
    "AAAAAAAAA", "AA#####AA", "A##BBB##A", "A#BBBBB#A", "A##BBB##A", "AA#####AA", "AAAAAAAAA", NULL };
  Picture  p = picture_of (rows);
  double   state[2] = { 1e9, 0 };
  CeldHost host = { count_down, NULL, state };
  int      calls;

  CHECK (celd_expand (&p.ink, &p.ranks, &host, &p.expanded) == CELD_OK);
  CHECK (state[1] > 0.9);
  calls = (int) (1e9 - state[0]);
  for (int k = 0; k < calls; k++)
    {
      state[0] = k;
      state[1] = 0;
      memset (p.expanded.data, 77, p.expanded.stride * (size_t) p.expanded.height * sizeof (uint32_t));
      CHECK (celd_expand (&p.ink, &p.ranks, &host, &p.expanded) == CELD_CANCELLED);
      CHECK (p.expanded.data[0] == 0x4d4d4d4d && p.expanded.data[31] == 0x4d4d4d4d);
    }
  picture_free (&p);
}

/* Levels of any sign and size are expanded like ranks in the same order. */
static void
levels_are_expanded_as_ranks (void)
{
  const char *const drawing[] = { "..##..##..", "..##..##..", "..##..##..", NULL };
  const float level[3] = { -2.5f, 0, 1e-9f }, odd[3] = { -2.5f, NAN, 1e-9f };
  CeldPlane   ink = art_plane (drawing), levels = art_plane (drawing), expanded = art_plane (drawing);
  CeldLabels  ranks = art_labels (drawing);

  for (int i = 0; i < 30; i++)
    {
      ranks.data[i]  = i % 10 < 3 ? 1 : i % 10 < 7 ? 0 : 2; /* both boundaries lie in ink */
      levels.data[i] = odd[ranks.data[i]];
    }
  CHECK (celd_expand (&ink, &ranks, NULL, &ranks) == CELD_OK);
  CHECK (celd_expand_levels (&ink, NULL, &levels, NULL, NULL, CELD_EXPANSION_THICKNESS, NULL, &expanded) == CELD_OK);
  for (int i = 0; i < 30; i++)
    CHECK (expanded.data[i] == level[ranks.data[i]]);
  /* in place, too */
  CHECK (celd_expand_levels (&ink, NULL, &levels, NULL, NULL, CELD_EXPANSION_THICKNESS, NULL, &levels) == CELD_OK);
  CHECK (!memcmp (levels.data, expanded.data, 30 * sizeof (float)));
  levels.width = 9;
  CHECK (celd_expand_levels (&ink, NULL, &levels, NULL, NULL, CELD_EXPANSION_THICKNESS, NULL, &expanded) == CELD_BAD_SIZE);
  free (ink.data), free (levels.data), free (expanded.data), free (ranks.data);
}

static void
bad_sizes_are_refused (void)
{
  uint32_t   data[2] = { 1, 2 }, result[2] = { 7, 7 };
  float      white[2] = { 1, 1 };
  CeldPlane  ink = { 2, 1, 2, white };
  CeldLabels ranks = { 1, 2, 1, data }, expanded = { 2, 1, 2, result };

  CHECK (celd_expand (&ink, &ranks, NULL, &expanded) == CELD_BAD_SIZE);
  ink.width = 0;
  CHECK (celd_expand (&ink, &expanded, NULL, &expanded) == CELD_BAD_SIZE);
  CHECK (result[0] == 7 && result[1] == 7);
}

int
main (void)
{
  RUN (ring_goes_to_the_nearer_side);
  RUN (thick_line_goes_over_whole);
  RUN (stem_ends_at_the_front_outline);
  RUN (details_stay_inside);
  RUN (equal_ranks_and_virtual_borders);
  RUN (paper_alone_and_ink_alone);
  RUN (black_region_keeps_its_ink);
  RUN (facts_of_random_pictures);
  RUN (progress_rises_and_cancel_changes_nothing);
  RUN (levels_are_expanded_as_ranks);
  RUN (bad_sizes_are_refused);
  return DONE;
}
