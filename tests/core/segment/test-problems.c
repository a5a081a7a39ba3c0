/* What a segmentation is reported to have done with strokes, colours and regions.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "segment/basins.h"
#include "segment/task.h"
#include "sketch.h"

/* The labels as basins that have the label of their maximum, and patches where that is not all of it. */
static void
paint (const CeldBasins *b, const CeldLabels *labels, CeldLabelling *labelling)
{
  *labelling = (CeldLabelling) { .label = calloc (b->n, sizeof *labelling->label) };
  for (size_t k = 0; k < b->n; k++)
    labelling->label[k] = CELD_AT (labels, b->basin[k].x, b->basin[k].y);
  for (int y = 0; y < b->height; y++)
    for (int x = 0; x < b->width; x++)
      {
        uint32_t l = CELD_AT (labels, x, y);

        if (l != labelling->label[celd_basin_at (b, x, y)])
          CHECK (celd_patch_add (&labelling->patches, (CeldPatch) { y, x, x + 1, l }) == CELD_OK);
      }
}

/* A task whose labels are `labels`, with their areas counted, and what is reported of it. */
typedef struct { Sketch sketch; CeldLabels labels; CeldLabelling labelling; CeldProblems problems; } Case;

static void
open_case (Case *c, const char *const *paper, const char *const *painted, size_t n)
{
  sketch_open (&c->sketch, paper, painted, n);
  c->sketch.task.brush = 1;
  c->problems = (CeldProblems) { 0 };
}

static void
report_on (Case *c, const char *const *labels)
{
  CeldSegmentTask *task = &c->sketch.task;

  c->labels = art_labels (labels);
  for (int p = 0; p < c->labels.width * c->labels.height; p++)
    if (c->labels.data[p])
      task->palette.item[c->labels.data[p] - 1].area++;
  paint (&c->sketch.basins, &c->labels, &c->labelling);
  CHECK (celd_segment_report (task, &task->seeds, &c->labelling, &c->labels, NULL, &c->problems) == CELD_OK);
}

static void
report (Case *c, const char *const *paper, const char *const *painted, const char *const *labels, size_t n, bool flats)
{
  open_case (c, paper, painted, n);
  c->sketch.settings.flats = flats;
  report_on (c, labels);
}

static void
case_close (Case *c)
{
  celd_problems_clear (&c->problems);
  free (c->labels.data);
  celd_labelling_clear (&c->labelling);
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
  Case                     c;

  report (&c, paper, painted, labels, 3, false);
  NEAR (c.problems.n, 1, 0);
  if (c.problems.n == 1)
    check_problem (&c, 0, (CeldProblem) { .kind = CELD_PROBLEM_STROKE_OVERRULED, .x = 3, .y = 2, .label = 2, .other = 3,
                                          .relation = CELD_NO_INDEX });
  case_close (&c);
}

/* Less than an eighth of the colour's paint is a scrap. */
static void
half_a_stroke_and_specks_are_not_reported (void)
{
  static const char *const half[] = { "AAAA....", "........", "BBBB....", NULL };
  static const char *const ninth[] = { "AAAAAAAA", "........", "B......A", NULL };
  static const char *const eighth[] = { "AAAAAAA.", "........", "B......A", NULL };
  static const char *const labels[] = { "AAAAAAAA", "AAAAAAAA", "BBAAAAAB", NULL };
  Case                     c;

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

/* A stroke five brushes long is no scrap, however much paint of its colour there is elsewhere. */
static void
a_long_stroke_is_reported_whatever_its_share (void)
{
  static const char *const page[] = { "111111111111111", "111111111111111", "111111111111111", "111111111111111", NULL };
  static const char *const four[] = { "AAAAAAAAAAAAAAA", "AAAAAAAAAAAAAAA", "AAAAAAAAAA.....", "BB.........AAAA", NULL };
  static const char *const five[] = { "AAAAAAAAAAAAAAA", "AAAAAAAAAAAAAAA", "AAAAAAAAA......", "BB........AAAAA", NULL };
  static const char *const labels[] = { "AAAAAAAAAAAAAAA", "AAAAAAAAAAAAAAA", "AAAAAAAAAABBBBB", "BBBBBBBBBBBBBBB", NULL };
  Case                     c;

  report (&c, page, four, labels, 2, false);
  NEAR (c.problems.n, 0, 0);
  case_close (&c);
  report (&c, page, five, labels, 2, false);
  NEAR (c.problems.n, 1, 0);
  case_close (&c);
}

/* Most of a stroke is a spill, and what is not has its label: it is not overruled. */
static void
spills_are_not_reported (void)
{
  static const char *const halves[] = { "1111#22222", "1111#22222", "1111#22222", NULL };
  static const char *const painted[] = { "..AAAAAAA.", ".....BBBBB", ".....BBBBB", NULL };
  static const char *const labels[] = { "AAAAABBBBB", "AAAAABBBBB", "AAAAABBBBB", NULL };
  Case                     c;

  for (int spilled = 0; spilled < 2; spilled++)
    {
      open_case (&c, halves, painted, 2);
      if (spilled)
        CHECK (celd_spills_remove (NULL, &c.sketch.task) == CELD_OK);
      CHECK (c.sketch.task.spilled == spilled);
      report_on (&c, labels);
      NEAR (c.problems.n, !spilled, 0);
      case_close (&c);
    }
}

/* The same across a bold contour: what is left of the stroke is less than what lies on that. */
static void
spills_in_solid_areas_are_not_reported (void)
{
  static const char *const bold[] = { "1111000222222", "1111000222222", "1111000222222", "1111000222222", NULL };
  static const char *const painted[] = { "..AAAAAAAAAA.", ".......BBBBBB", ".......BBBBBB", ".......BBBBBB", NULL };
  static const char *const labels[] = { "AAAABBBBBBBBB", "AAAABBBBBBBBB", "AAAABBBBBBBBB", "AAAABBBBBBBBB", NULL };
  Case                     c;

  open_case (&c, bold, painted, 2);
  CHECK (celd_spills_remove (NULL, &c.sketch.task) == CELD_OK);
  report_on (&c, labels);
  NEAR (c.problems.n, 0, 0);
  case_close (&c);
}

static void
a_lost_colour_is_reported_once (void)
{
  static const char *const painted[] = { "AAAA....", "....B..B", "BBBB....", NULL };
  static const char *const labels[] = { "AAAAAAAA", "AAAAAAAA", "AAAAAAAA", NULL };
  Case                     c;

  report (&c, paper, painted, labels, 2, true);
  NEAR (c.problems.n, 1, 0);
  if (c.problems.n == 1)
    check_problem (&c, 0, (CeldProblem) { .kind = CELD_PROBLEM_COLOUR_LOST, .x = 4, .y = 1, .label = 2,
                                          .relation = CELD_NO_INDEX });
  case_close (&c);
}

/* The colour of outlines in a flat colouring. */
static void
a_lost_colour_of_outlines_is_not_reported (void)
{
  static const char *const lines[] = { "1111####", "1111#222", "1111#222", NULL };
  static const char *const painted[] = { "AAAABBBB", "AAAABCCC", "AAAABCCC", NULL };
  static const char *const labels[] = { "AAAACCCC", "AAAACCCC", "AAAACCCC", NULL };
  Case                     c;

  report (&c, lines, painted, labels, 3, true);
  NEAR (c.problems.n, 0, 0);
  case_close (&c);
}

/* Nine pixels, the square of three stroke widths, are worth a word, six are not; in flats none is. */
static void
closed_regions_without_a_stroke_are_unreached (void)
{
  static const char *const enclosures[] = { "111111111111", "1#####1####1", "1#222#1#33#1", "1#222#1#33#1",
                                            "1#222#1#33#1",
                                       "1#####1####1", NULL };
  static const char *const painted[] = { "AAAA........", "............", "............", "............",
                                         "............", "............", NULL };
  static const char *const labels[] = { "AAAAAAAAAAAA", "AAAAAAAAAAAA", "AAABBAAAAAAA", "AABBBAAAAAAA",
                                        "AABBBAAAAAAA", "AAAAAAAAAAAA", NULL };
  Case                     c;

  report (&c, enclosures, painted, labels, 2, false);
  NEAR (c.problems.n, 1, 0);
  if (c.problems.n == 1)
    check_problem (&c, 0, (CeldProblem) { .kind = CELD_PROBLEM_REGION_UNREACHED, .x = 3, .y = 3, .label = 2,
                                          .relation = CELD_NO_INDEX });
  case_close (&c);
  report (&c, enclosures, painted, labels, 2, true);
  NEAR (c.problems.n, 0, 0);
  case_close (&c);
}

/* The same paper is one component, but a bridge parts it; with a thick pen, too, what is large on the page counts. */
static void
regions_open_through_a_gap_are_unreached (void)
{
  static const char *const rows[] = { "111111222222", "111111222222", "111111222222", NULL };
  static const char *const painted[] = { "AAAA........", "............", "............", NULL };
  static const char *const labels[] = { "AAAAAAAAAAAA", "AAAAAAAAAAAA", "AAAAAAAAAAAA", NULL };
  const uint32_t           joined[] = { 1, 1 }, bridged[] = { 1, 2 };

  for (int round = 0; round < 3; round++)
    {
      Case c;

      report (&c, rows, painted, labels, 1, false);
      celd_problems_clear (&c.problems);
      c.problems = (CeldProblems) { 0 };
      memcpy (c.sketch.basins.component, joined, sizeof joined);
      c.sketch.task.bridged_component = round ? bridged : NULL;
      c.sketch.basins.stroke = round == 2 ? 10 : 1;
      CHECK (celd_segment_report (&c.sketch.task, &c.sketch.task.seeds, &c.labelling, &c.labels, NULL, &c.problems)
             == CELD_OK);
      NEAR (c.problems.n, round > 0, 0);
      CHECK (!c.problems.n || (c.problems.item[0].kind == CELD_PROBLEM_REGION_UNREACHED && c.problems.item[0].x > 5));
      case_close (&c);
    }
}

/* Seeds of the background alone, in the second of two enclosures, are no stroke of the artist. */
static void
what_the_background_got_is_unreached (void)
{
  static const char *const rows[] = { "11111#222222", "11111#222222", "11111#222222", NULL };
  static const char *const painted[] = { "AAA...AAAAAA", "...........A", "......AAAAAA", NULL };
  static const char *const labels[] = { "AAAAAAAAAAAA", "AAAAAAAAAAAA", "AAAAAAAAAAAA", NULL };
  bool                     unpainted[] = { false, false, true };

  for (int round = 0; round < 2; round++)
    {
      Case c;

      report (&c, rows, painted, labels, 1, false);
      NEAR (c.problems.n, 0, 0);
      unpainted[1] = round;
      c.sketch.task.unpainted = unpainted;
      CHECK (celd_segment_report (&c.sketch.task, &c.sketch.task.seeds, &c.labelling, &c.labels, NULL, &c.problems)
             == CELD_OK);
      NEAR (c.problems.n, 1 + round, 0);
      CHECK (!c.problems.n || (c.problems.item[round].kind == CELD_PROBLEM_REGION_UNREACHED &&
                               c.problems.item[round].x > 5));
      c.sketch.task.unpainted = NULL;
      case_close (&c);
    }
}

/* Paint of labels that the palette does not know was left out before. */
static void
unknown_labels_are_ignored (void)
{
  static const char *const painted[] = { "AAAA....", "........", "........", NULL };
  static const char *const labels[] = { "AAAAAAAA", "AAAAAAAA", "AAAAAAAA", NULL };
  CeldSegmentTask         *task;
  Case                     c;

  report (&c, paper, painted, labels, 1, false);
  task = &c.sketch.task;
  CHECK (celd_seed_rows_paint (&task->seeds, 2, 4, 5, 7) == CELD_OK);
  CHECK (celd_seed_rows_paint (&task->seeds, 2, 5, 6, UINT32_MAX) == CELD_OK);
  CHECK (celd_segment_report (task, &task->seeds, &c.labelling, &c.labels, NULL, &c.problems) == CELD_OK);
  CHECK (celd_segment_report (task, &task->seeds, &c.labelling, &c.labels, NULL, NULL) == CELD_OK);
  NEAR (c.problems.n, 0, 0);
  case_close (&c);
}

/* ------------------------------------------------------------------ the same by pixels */

enum { W = 17, H = 11 };

/* Random paint and labels, blurred so that there is something in common; basins in stripes. */
static void
random_case (uint32_t *state, char paper_row[H][W + 1], char painted[H][W + 1], char labels[H][W + 1])
{
  memset (paper_row, 0, H * (W + 1));
  memset (painted, 0, H * (W + 1));
  memset (labels, 0, H * (W + 1));
  for (int y = 0; y < H; y++)
    for (int x = 0; x < W; x++)
      {
        paper_row[y][x] = (char) ('1' + x / 5);
        painted[y][x] = x && check_random (state, 3) ? painted[y][x - 1] : (char) ('A' + check_random (state, 4));
        labels[y][x]  = y && check_random (state, 4) ? labels[y - 1][x] : (char) ('A' + check_random (state, 3));
      }
  for (int y = 0; y < H; y++)
    for (int x = 0; x < W; x++)
      if (painted[y][x] == 'D')
        painted[y][x] = '.';
}

/* Gathers the stroke round pixel p: how many of its pixels are there, and how many of these have another label. */
static void
gather (const CeldSeedRows *seeds, const CeldLabels *labels, int p, bool seen[W * H], int *area, int *overruled)
{
  uint32_t l = celd_seed_rows_at (seeds, p % W, p / W);

  if (seen[p])
    return;
  seen[p] = true;
  *area      += 1;
  *overruled += labels->data[p] != l;
  for (int v = p / W - 1; v <= p / W + 1; v++)
    for (int u = p % W - 1; u <= p % W + 1; u++)
      if (u >= 0 && v >= 0 && u < W && v < H && celd_seed_rows_at (seeds, u, v) == l)
        gather (seeds, labels, v * W + u, seen, area, overruled);
}

/* An exact answer has no basins with a label: the pixels alone must tell the same. */
static void
check_without_basins (Case *c)
{
  CeldProblems     again = { 0 };
  CeldSegmentTask *task = &c->sketch.task;
  CeldLabelling    none = { .label = calloc (c->sketch.basins.n, sizeof *none.label) };

  CHECK (celd_segment_report (task, &task->seeds, &none, &c->labels, NULL, &again) == CELD_OK);
  NEAR (again.n, c->problems.n, 0);
  for (size_t i = 0; i < again.n && again.n == c->problems.n; i++)
    CHECK (again.item[i].kind == c->problems.item[i].kind && again.item[i].label == c->problems.item[i].label);
  celd_problems_clear (&again);
  free (none.label);
}

static void
overruled_strokes_are_those_of_the_pixels (void)
{
  uint32_t state = 8;
  size_t   told = 0;

  for (int round = 0; round < 200; round++)
    {
      char        row[3][H][W + 1];
      const char *art[3][H + 1] = { { NULL } };
      bool        seen[W * H] = { false };
      size_t      n = 0, lost = 0;
      Case        c;

      random_case (&state, row[0], row[1], row[2]);
      for (int k = 0; k < 3; k++)
        for (int y = 0; y < H; y++)
          art[k][y] = row[k][y];
      report (&c, art[0], art[1], art[2], 3, false);
      while (lost < c.problems.n && c.problems.item[lost].kind == CELD_PROBLEM_STROKE_OVERRULED)
        lost++;
      for (int p = 0; p < W * H; p++)
        {
          const CeldProblem *problem = n < lost ? &c.problems.item[n] : NULL;
          uint32_t           l = celd_seed_rows_at (&c.sketch.task.seeds, p % W, p / W);
          int                area = 0, overruled = 0;

          if (!l || seen[p])
            continue;
          gather (&c.sketch.task.seeds, &c.labels, p, seen, &area, &overruled);
          if (2 * overruled <= area || (area < 5 && 8 * (size_t) area < c.sketch.task.palette.item[l - 1].seeds))
            continue;
          CHECK (problem && problem->label == l && problem->other && problem->other != l &&
                 seen[problem->y * W + problem->x] && CELD_AT (&c.labels, problem->x, problem->y) != l &&
                 celd_seed_rows_at (&c.sketch.task.seeds, problem->x, problem->y) == l);
          n++;
        }
      NEAR (lost, n, 0);
      told += n;
      check_without_basins (&c);
      case_close (&c);
    }
  CHECK (told > 100);
}

int
main (void)
{
  RUN (a_stroke_that_lost_its_majority_is_overruled);
  RUN (half_a_stroke_and_specks_are_not_reported);
  RUN (a_long_stroke_is_reported_whatever_its_share);
  RUN (spills_are_not_reported);
  RUN (spills_in_solid_areas_are_not_reported);
  RUN (a_lost_colour_is_reported_once);
  RUN (a_lost_colour_of_outlines_is_not_reported);
  RUN (closed_regions_without_a_stroke_are_unreached);
  RUN (regions_open_through_a_gap_are_unreached);
  RUN (what_the_background_got_is_unreached);
  RUN (unknown_labels_are_ignored);
  RUN (overruled_strokes_are_those_of_the_pixels);
  return DONE;
}
