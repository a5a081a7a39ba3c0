/* Labels of a drawing that moves: a body, an arm that swings across it, a disc behind it, and a pocket of the page.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "base/base.h"

#include <math.h>
#include <stdlib.h>

#define SIDE 320
#define PIXELS (SIDE * SIDE)

enum { PAGE = 1, BALL, BODY, ARM, LABELS = ARM };

static const uint32_t level[LABELS] = { 0, 1, 2, 3 };

/* Where the parts are in a frame: the arm's turn in degrees about its shoulder, the shift of all, and that of the
 * ball. */
typedef struct { double arm, x, y, ball; } Pose;

typedef struct { CeldPlane ink; CeldLabels labels; } Frame;

static double
capsule (double x, double y, double x0, double y0, double x1, double y1)
{
  double along = ((x - x0) * (x1 - x0) + (y - y0) * (y1 - y0)) / ((x1 - x0) * (x1 - x0) + (y1 - y0) * (y1 - y0));

  along = fmin (1, fmax (0, along));
  return hypot (x - x0 - along * (x1 - x0), y - y0 - along * (y1 - y0));
}

static uint32_t
label_at (const Pose *pose, double x, double y)
{
  double turn = pose->arm * CELD_PI / 180, sx = 160 + pose->x, sy = 110 + pose->y;

  if (capsule (x, y, sx, sy, sx + 90 * sin (turn), sy + 90 * cos (turn)) < 15)
    return ARM;
  if (hypot ((x - 160 - pose->x) / 45, (y - 165 - pose->y) / 80) < 1)
    return BODY;
  if (hypot (x - 205 - pose->x - pose->ball, y - 215 - pose->y) < 30)
    return BALL;
  return PAGE;
}

/* The frame: lines where labels meet, two pixels wide. */
static Frame
draw (const Pose *pose)
{
  Frame f = { { SIDE, SIDE, SIDE, malloc (PIXELS * sizeof (float)) },
              { SIDE, SIDE, SIDE, malloc (PIXELS * sizeof (uint32_t)) } };

  for (int i = 0; i < PIXELS; i++)
    f.labels.data[i] = label_at (pose, i % SIDE + 0.5, i / SIDE + 0.5);
  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      {
        uint32_t here = f.labels.data[y * SIDE + x];
        bool     line = false;

        for (int v = -1; v <= 1; v++)
          for (int u = -1; u <= 1; u++)
            if (x + u >= 0 && y + v >= 0 && x + u < SIDE && y + v < SIDE)
              line |= f.labels.data[(y + v) * SIDE + x + u] != here;
        f.ink.data[y * SIDE + x] = line ? 0 : 1;
      }
  return f;
}

static void
drop (Frame *f)
{
  free (f->ink.data);
  free (f->labels.data);
}

/* Carries labels, and returns the share of seeds that are right; `found` counts the seeds of each label. */
static double
carry (const Frame *from, const Frame *to, const uint32_t *levels, const CeldHost *host, uint32_t *seeds, double *sure,
       int found[LABELS + 1])
{
  CeldLabels labels = { SIDE, SIDE, SIDE, seeds };
  CeldPlane  certainty = { SIDE, SIDE, SIDE, malloc (PIXELS * sizeof (float)) };
  int        n = 0, right = 0, paper = 0;

  CHECK (celd_propagate (&from->ink, &from->labels, levels, PAGE, &to->ink, host, &labels, &certainty) == CELD_OK);
  memset (found, 0, (LABELS + 1) * sizeof *found);
  *sure = 0;
  for (int i = 0; i < PIXELS; i++)
    {
      CHECK (seeds[i] <= LABELS && certainty.data[i] >= 0 && certainty.data[i] <= 1);
      CHECK (to->ink.data[i] > 0 || !seeds[i]);
      paper += to->ink.data[i] > 0;
      *sure += (double) certainty.data[i];
      n     += seeds[i] > 0;
      right += seeds[i] == to->labels.data[i];
      found[seeds[i]]++;
    }
  *sure /= paper;
  free (certainty.data);
  return n ? (double) right / n : 0;
}

static uint32_t seeds[PIXELS], again[PIXELS];

/* Nothing moves: each label stays, with full certainty. */
static void
still_frames_keep_their_labels (void)
{
  Frame  f = draw (&(Pose) { 40, 0, 0, 0 });
  double sure;
  int    found[LABELS + 1];

  NEAR (carry (&f, &f, level, NULL, seeds, &sure, found), 1, 0);
  CHECK (sure > 0.98);
  for (int l = 1; l <= LABELS; l++)
    CHECK (found[l] > 100);
  drop (&f);
}

/* The arm swings by up to 35 degrees, and all of the drawing shifts; with and without levels. */
static void
parts_are_followed (void)
{
  static const Pose to[] = { { 75, 0, 0, 0 }, { 20, 12, -8, 0 }, { 40, 25, 10, 20 }, { 60, -20, 15, -15 } };
  Frame             from = draw (&(Pose) { 40, 0, 0, 0 });

  for (size_t i = 0; i < sizeof to / sizeof *to; i++)
    for (int deep = 0; deep < 2; deep++)
      {
        Frame  next = draw (&to[i]);
        double sure;
        int    found[LABELS + 1];

        CHECK (carry (&from, &next, deep ? level : NULL, NULL, seeds, &sure, found) > 0.99);
        for (int l = 1; l <= LABELS; l++)
          CHECK (found[l] > 100);
        CHECK (sure > 0.9);
        drop (&next);
      }
  drop (&from);
}

/* A drawing of something else: certainty says so. */
static void
strangers_are_uncertain (void)
{
  Frame  from = draw (&(Pose) { 40, 0, 0, 0 }), next = draw (&(Pose) { 40, 0, 0, 0 });
  double sure;
  int    found[LABELS + 1];

  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      next.ink.data[y * SIDE + x] = x % 53 < 2 || y % 61 < 2 ? 0 : 1;
  carry (&from, &next, level, NULL, seeds, &sure, found);
  CHECK (sure < 0.8);
  drop (&from);
  drop (&next);
}

/* Blends two rows of labels with certainties of tenths, and compares labels and certainties, which are percent. */
static void
check_blend (const char *one, const char *sure_one, const char *other, const char *sure_other, double nearness,
             const char *wanted, const int *percent)
{
  enum { LENGTH = 12 };
  uint32_t       label[2][LENGTH], found[LENGTH];
  float          sure[2][LENGTH], found_sure[LENGTH];
  CeldLabels     labels[3] = { { LENGTH, 1, LENGTH, label[0] }, { LENGTH, 1, LENGTH, label[1] },
                               { LENGTH, 1, LENGTH, found } };
  CeldPlane      certainty[3] = { { LENGTH, 1, LENGTH, sure[0] }, { LENGTH, 1, LENGTH, sure[1] },
                                  { LENGTH, 1, LENGTH, found_sure } };
  CeldPropagated side[2] = { { &labels[0], &certainty[0], nearness }, { &labels[1], &certainty[1], 1 - nearness } };

  for (int i = 0; i < LENGTH; i++)
    {
      label[0][i] = (uint32_t) (one[i] - '0');
      label[1][i] = (uint32_t) (other[i] - '0');
      sure[0][i]  = (float) (sure_one[i] - '0') / 9;
      sure[1][i]  = (float) (sure_other[i] - '0') / 9;
    }
  CHECK (celd_blend_propagated (side, NULL, &labels[2], &certainty[2]) == CELD_OK);
  for (int i = 0; i < LENGTH; i++)
    {
      CHECK (found[i] == (uint32_t) (wanted[i] - '0'));
      NEAR (found_sure[i], percent[i] / 100., 0.005);
    }
}

/* A part that only the second key knows, 3: the first one has unexplained background there.  Ink is between them. */
static void
a_part_that_one_key_knows_is_taken_from_it (void)
{
  static const int part[] = { 100, 100, 0, 100, 100, 100, 0, 100, 100, 0, 100, 100 };

  for (int nearer = 1; nearer <= 9; nearer++)
    check_blend ("111111112222", "990000099099", "111333312222", "990999099099", nearer / 10., "111333312222", part);
}

/* One side is wrong on the left, the other on the right, each less certain there than the other one. */
static void
each_area_takes_the_more_certain_side (void)
{
  static const int sure[] = { 75, 75, 75, 75, 0, 100, 100, 0, 75, 75, 75, 75 };
  static const int even[] = { 50, 50, 50, 50, 0, 100, 100, 0, 50, 50, 50, 50 };
  static const int near[] = { 80, 80, 80, 80, 0, 100, 100, 0, 80, 80, 80, 80 };

  check_blend ("222211114444", "333309909999", "333311115555", "999909903333", 0.5, "333311114444", sure);
  /* As certain: the nearer key's, or the first one's. */
  check_blend ("222211114444", "999909909999", "333311115555", "999909909999", 0.5, "222211114444", even);
  check_blend ("222211114444", "999909909999", "333311115555", "999909909999", 0.2, "333311115555", near);
}

/* Labels of a frame, of the next one, and what came back, as digits; `percent` is that of labels 1, 2, ... */
static CeldStatus
check_returned (const char *before, const char *after, const char *back, size_t n, const int *percent)
{
  enum { LENGTH = 8, MOST = 5 };
  const char *text[3] = { before, after, back };
  uint32_t    label[3][LENGTH];
  CeldLabels  labels[3];
  double      sure[MOST + 1] = { -1 };
  CeldStatus  status;

  for (int k = 0; k < 3; k++)
    {
      labels[k] = (CeldLabels) { LENGTH / 2, 2, LENGTH / 2, label[k] };
      for (int i = 0; i < LENGTH; i++)
        label[k][i] = (uint32_t) (text[k][i] - '0');
    }
  status = celd_rate_returned (&labels[0], &labels[1], &labels[2], n, sure);
  for (size_t l = 1; status == CELD_OK && l <= n; l++)
    NEAR (sure[l], percent[l - 1] / 100., 1e-9);
  CHECK (sure[0] == -1);
  labels[2].height = 1;
  CHECK (celd_rate_returned (&labels[0], &labels[1], &labels[2], n, sure) == CELD_BAD_SIZE);
  return status;
}

static void
labels_that_do_not_come_back_are_unsure (void)
{
  static const int all[] = { 100, 100, 100 }, lost[] = { 50, 0, 100 }, shrunk[] = { 60, 25 }, moved[] = { 60, 60 };

  /* All came back; ink does not count, and neither frame has a third label. */
  CHECK (check_returned ("11112222", "11112222", "11012022", 3, all) == CELD_OK);
  /* The second one is gone, and the first one, twice as large, came back in its place, too. */
  CHECK (check_returned ("11112222", "11111111", "11111111", 3, lost) == CELD_OK);
  /* What came back lies right, but areas have changed: 3 to 5, and 4 to 1. */
  CHECK (check_returned ("11122220", "11111200", "11122220", 2, shrunk) == CELD_OK);
  /* A quarter of each came back as the other: 3 of 5 pixels agree. */
  CHECK (check_returned ("11112222", "11112222", "11121222", 2, moved) == CELD_OK);
  CHECK (check_returned ("11112222", "11112222", "11112223", 2, all) == CELD_BAD_VALUE);
  CHECK (check_returned ("11112222", "11112232", "11112222", 2, all) == CELD_BAD_VALUE);
  CHECK (check_returned ("31112222", "11112222", "11112222", 2, all) == CELD_BAD_VALUE);
}

/* What a frame has, and what its sides have, as digits; `sure` is that of labels 1, 2, ... on both sides, and `percent`
 * what they get. */
static CeldStatus
check_rating (const char *frame, const char *first, const char *second, const double *sure[2], size_t n,
              const int *percent)
{
  enum { LENGTH = 8, MOST = 5 };
  const char       *text[3] = { frame, first, second };
  uint32_t          label[3][LENGTH];
  CeldLabels        labels[3];
  const CeldLabels *side[2] = { &labels[1], &labels[2] };
  double            rated[MOST + 1] = { -1 };
  CeldStatus        status;

  for (int k = 0; k < 3; k++)
    {
      labels[k] = (CeldLabels) { LENGTH / 2, 2, LENGTH / 2, label[k] };
      for (int i = 0; i < LENGTH; i++)
        label[k][i] = (uint32_t) (text[k][i] - '0');
    }
  status = celd_rate_blended (side, sure, &labels[0], n, rated);
  for (size_t l = 1; status == CELD_OK && l <= n; l++)
    NEAR (rated[l], percent[l - 1] / 100., 1e-9);
  CHECK (rated[0] == -1);
  labels[2].height = 1;
  CHECK (celd_rate_blended (side, sure, &labels[0], n, rated) == CELD_BAD_SIZE);
  return status;
}

static void
blended_labels_are_as_sure_as_their_better_side (void)
{
  static const double of_first[] = { 0, 0.6, 1, 0.3 }, of_second[] = { 0, 0.8, 0.5, 0.9 };
  const double       *sure[2] = { of_first, of_second };
  static const int    same[] = { 80, 100, 90 }, apart[] = { 75, 80, 90 }, part[] = { 80, 0, 45 };

  /* Both say the same, and neither has a third label. */
  CHECK (check_rating ("11112222", "11112222", "11112222", sure, 3, same) == CELD_OK);
  /* They agree in 3 of 4 pixels of the first label, and in 4 of 5 of the second one. */
  CHECK (check_rating ("11122222", "11122222", "11112222", sure, 3, apart) == CELD_OK);
  /* The side that is surer of the third label has half of it, and has the second one where the frame has it not. */
  CHECK (check_rating ("33333333", "33333333", "33332222", sure, 3, part) == CELD_OK);
  CHECK (check_rating ("11112222", "11112222", "11112223", sure, 2, same) == CELD_BAD_VALUE);
  CHECK (check_rating ("11112222", "11112232", "11112222", sure, 2, same) == CELD_BAD_VALUE);
  CHECK (check_rating ("11112223", "11112222", "11112222", sure, 2, same) == CELD_BAD_VALUE);
}

static void
blends_of_other_sizes_are_refused (void)
{
  static float   sure[4];
  static uint32_t label[4] = { 1, 1, 70000, 2 }, many[4] = { 2, 2, 1, 70000 };
  CeldLabels     one = { 2, 2, 2, label }, other = { 2, 2, 2, many }, low = { 2, 1, 2, label };
  CeldPlane      certainty = { 2, 2, 2, sure };
  CeldPropagated side[2] = { { &one, &certainty, 0.5 }, { &low, &certainty, 0.5 } };

  CHECK (celd_blend_propagated (side, NULL, &one, &certainty) == CELD_BAD_SIZE);
  side[1].labels = &other;
  CHECK (celd_blend_propagated (side, NULL, &one, &certainty) == CELD_BAD_VALUE);
}

/* In the opposite order, as threads would. */
static void
backwards (void *data, int n, void (*body) (void *data, int i), void *body_data)
{
  (void) data;
  for (int i = n - 1; i >= 0; i--)
    body (body_data, i);
}

static void
order_of_work_does_not_matter (void)
{
  Frame    from = draw (&(Pose) { 40, 0, 0, 0 }), next = draw (&(Pose) { 60, 10, 5, 10 });
  CeldHost host = { NULL, backwards, NULL };
  double   sure;
  int      found[LABELS + 1];

  carry (&from, &next, level, NULL, seeds, &sure, found);
  carry (&from, &next, level, &host, again, &sure, found);
  CHECK (!memcmp (seeds, again, sizeof seeds));
  drop (&from);
  drop (&next);
}

static bool
stop (void *data, double done)
{
  (void) data;
  (void) done;
  return false;
}

static void
bad_input_is_refused (void)
{
  Frame      f = draw (&(Pose) { 40, 0, 0, 0 });
  CeldLabels labels = { SIDE, SIDE, SIDE, seeds }, small = { SIDE, SIDE - 1, SIDE, seeds };
  CeldPlane  certainty = { SIDE, SIDE, SIDE, malloc (PIXELS * sizeof (float)) }, blank = f.ink;
  CeldHost   host = { stop, NULL, NULL };

  CHECK (celd_propagate (&f.ink, &f.labels, level, PAGE, &f.ink, NULL, &small, &certainty) == CELD_BAD_SIZE);
  CHECK (celd_propagate (&f.ink, &small, level, PAGE, &f.ink, NULL, &labels, &certainty) == CELD_BAD_SIZE);
  CHECK (celd_propagate (&f.ink, &f.labels, level, PAGE, &f.ink, &host, &labels, &certainty) == CELD_CANCELLED);
  blank.data = malloc (PIXELS * sizeof (float));
  for (int value = 0; value < 3; value++) /* ink only, paper only, no numbers */
    {
      for (int i = 0; i < PIXELS; i++)
        blank.data[i] = value < 2 ? (float) value : NAN;
      CHECK (celd_propagate (&f.ink, &f.labels, level, PAGE, &blank, NULL, &labels, &certainty) == CELD_OK);
      CHECK (celd_propagate (&blank, &f.labels, level, PAGE, &f.ink, NULL, &labels, &certainty) == CELD_OK);
    }
  free (blank.data);
  free (certainty.data);
  drop (&f);
}

int
main (void)
{
  RUN (still_frames_keep_their_labels);
  RUN (parts_are_followed);
  RUN (strangers_are_uncertain);
  RUN (a_part_that_one_key_knows_is_taken_from_it);
  RUN (each_area_takes_the_more_certain_side);
  RUN (labels_that_do_not_come_back_are_unsure);
  RUN (blended_labels_are_as_sure_as_their_better_side);
  RUN (blends_of_other_sizes_are_refused);
  RUN (order_of_work_does_not_matter);
  RUN (bad_input_is_refused);
  return DONE;
}
