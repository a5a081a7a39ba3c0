/* What a segmentation is reported to have done with strokes, colours and regions.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "canvas.h"

/* A canvas whose labels are `labels`, with their areas counted, and what is reported of it. */
typedef struct { Sketch sketch; CeldLabels labels; CeldProblems problems; } Case;

static void
report (Case *c, const char *const *paper, const char *const *painted, const char *const *labels, size_t n, bool flats)
{
  CeldCanvas *canvas = &c->sketch.canvas;

  sketch_open (&c->sketch, paper, painted, n);
  c->problems = (CeldProblems) { 0 };
  c->sketch.settings.flats = flats;
  c->labels = art_labels (labels);
  for (int p = 0; p < c->labels.width * c->labels.height; p++)
    if (c->labels.data[p])
      canvas->palette.item[c->labels.data[p] - 1].area++;
  CHECK (celd_segment_report (canvas, &canvas->seeds, &c->labels, NULL, &c->problems) == CELD_OK);
}

static void
case_close (Case *c)
{
  celd_problems_clear (&c->problems);
  free (c->labels.data);
  sketch_close (&c->sketch);
}

static void
check_problem (const Case *c, size_t i, CeldProblem wanted)
{
  const CeldProblem *found = &c->problems.item[i];

  CHECK (found->kind == wanted.kind && found->label == wanted.label && found->other == wanted.other);
  CHECK (found->relation == CELD_NO_INDEX);
  NEAR (found->x, wanted.x, 0);
  NEAR (found->y, wanted.y, 0);
}

static const char *const paper[] = { "11111111", "11111111", "11111111", NULL };

/* Five of eight pixels of B went elsewhere, three of them to C.  The longest row of those is where to look. */
static void
a_stroke_that_lost_its_majority_is_overruled (void)
{
  static const char *const painted[] = { "AAAA....", "..BBB...", "BBBBB..C", NULL };
  static const char *const labels[] = { "AAAAAAAA", "AABAAAAA", "BBCCCCCC", NULL };
  Case c;

  report (&c, paper, painted, labels, 3, false);
  NEAR (c.problems.n, 1, 0);
  if (c.problems.n == 1)
    check_problem (&c, 0, (CeldProblem) { CELD_PROBLEM_STROKE_OVERRULED, 3, 2, 2, 3, CELD_NO_INDEX });
  case_close (&c);
}

/* Less than an eighth of the colour's paint is a scrap. */
static void
half_a_stroke_and_scraps_are_not_worth_a_word (void)
{
  static const char *const half[] = { "AAAA....", "........", "BBBB....", NULL };
  static const char *const ninth[] = { "AAAAAAAA", "........", "B......A", NULL };
  static const char *const eighth[] = { "AAAAAAA.", "........", "B......A", NULL };
  static const char *const labels[] = { "AAAAAAAA", "AAAAAAAA", "BBAAAAAB", NULL };
  Case c;

  report (&c, paper, half, labels, 2, false);
  NEAR (c.problems.n, 0, 0);
  case_close (&c);
  report (&c, paper, ninth, labels, 2, false);
  NEAR (c.problems.n, 0, 0);
  case_close (&c);
  report (&c, paper, eighth, labels, 2, false);
  NEAR (c.problems.n, 1, 0);
  case_close (&c);
}

static void
a_lost_colour_is_told_once (void)
{
  static const char *const painted[] = { "AAAA....", "....B..B", "BBBB....", NULL };
  static const char *const labels[] = { "AAAAAAAA", "AAAAAAAA", "AAAAAAAA", NULL };
  Case c;

  report (&c, paper, painted, labels, 2, true);
  NEAR (c.problems.n, 1, 0);
  if (c.problems.n == 1)
    check_problem (&c, 0, (CeldProblem) { CELD_PROBLEM_COLOUR_LOST, 4, 1, 2, 0, CELD_NO_INDEX });
  case_close (&c);
}

/* Nine pixels, the square of three stroke widths, are worth a word, six are not; in flats none is. */
static void
closed_regions_without_a_stroke_are_unreached (void)
{
  static const char *const rooms[] = { "111111111111", "1#####1####1", "1#222#1#33#1", "1#222#1#33#1", "1#222#1#33#1",
                                       "1#####1####1", NULL };
  static const char *const painted[] = { "AAAA........", "............", "............", "............",
                                         "............", "............", NULL };
  static const char *const labels[] = { "AAAAAAAAAAAA", "AAAAAAAAAAAA", "AAABBAAAAAAA", "AABBBAAAAAAA",
                                        "AABBBAAAAAAA", "AAAAAAAAAAAA", NULL };
  Case c;

  report (&c, rooms, painted, labels, 2, false);
  NEAR (c.problems.n, 1, 0);
  if (c.problems.n == 1)
    check_problem (&c, 0, (CeldProblem) { CELD_PROBLEM_REGION_UNREACHED, 3, 3, 2, 0, CELD_NO_INDEX });
  case_close (&c);
  report (&c, rooms, painted, labels, 2, true);
  NEAR (c.problems.n, 0, 0);
  case_close (&c);
}

/* Paint of labels that the palette does not know was left out before. */
static void
unknown_labels_are_passed_over (void)
{
  static const char *const painted[] = { "AAAA....", "........", "........", NULL };
  static const char *const labels[] = { "AAAAAAAA", "AAAAAAAA", "AAAAAAAA", NULL };
  Case c;

  report (&c, paper, painted, labels, 1, false);
  CHECK (celd_seed_rows_paint (&c.sketch.canvas.seeds, 2, 4, 5, 7) == CELD_OK);
  CHECK (celd_seed_rows_paint (&c.sketch.canvas.seeds, 2, 5, 6, UINT32_MAX) == CELD_OK);
  CHECK (celd_segment_report (&c.sketch.canvas, &c.sketch.canvas.seeds, &c.labels, NULL, &c.problems) == CELD_OK);
  CHECK (celd_segment_report (&c.sketch.canvas, &c.sketch.canvas.seeds, &c.labels, NULL, NULL) == CELD_OK);
  NEAR (c.problems.n, 0, 0);
  case_close (&c);
}

int
main (void)
{
  RUN (a_stroke_that_lost_its_majority_is_overruled);
  RUN (half_a_stroke_and_scraps_are_not_worth_a_word);
  RUN (a_lost_colour_is_told_once);
  RUN (closed_regions_without_a_stroke_are_unreached);
  RUN (unknown_labels_are_passed_over);
  return DONE;
}
