/* What is noted of the regions of a frame: those that are unsure, vanish or appear, and where to look.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"

enum { W = 40, H = 30, N = 5, BACKGROUND = 5 };

/* Two frames in columns of ten: labels 1, 2, 3 and the background.  A region that counts has a pixel or more. */
typedef struct { uint32_t before[W * H], after[W * H]; float ink[W * H], certainty[W * H]; double sure[N + 1]; } Clip;

static void
fill (Clip *c)
{
  for (int i = 0; i < W * H; i++)
    {
      c->before[i] = c->after[i] = i % W < 30 ? (uint32_t) (i % W / 10 + 1) : BACKGROUND;
      c->ink[i] = c->certainty[i] = 1;
    }
  for (int l = 0; l <= N; l++)
    c->sure[l] = 1;
}

/* Pixels of a column from a row on. */
static void
set_certainty (Clip *c, int left, int width, int top, int height, float certainty)
{
  for (int y = top; y < top + height; y++)
    for (int x = left; x < left + width; x++)
      c->certainty[y * W + x] = certainty;
}

static size_t
note (Clip *c, CeldRegionNote *notes, double *mean)
{
  CeldPlane  ink = { W, H, W, c->ink }, certainty = { W, H, W, c->certainty };
  CeldLabels before = { W, H, W, c->before }, after = { W, H, W, c->after };
  size_t     n = 99;

  CHECK (celd_note_regions (&ink, &before, &after, &certainty, N, BACKGROUND, c->sure, notes, &n, mean) == CELD_OK);
  return n;
}

static void
nothing_is_noted_of_sure_regions (void)
{
  Clip           c;
  CeldRegionNote notes[N];
  double         mean;

  fill (&c);
  set_certainty (&c, 0, 10, 0, 7, 0.5f); /* seven of thirty rows are less than a quarter */
  CHECK (note (&c, notes, &mean) == 0);
  NEAR (mean, 1 - 0.5 * 70 / (W * H), 1e-6);
}

static void
unsure_ones_are_noted_where_they_are (void)
{
  Clip           c;
  CeldRegionNote notes[N];
  double         mean;

  fill (&c);
  set_certainty (&c, 10, 10, 20, 8, 0.5f);
  set_certainty (&c, 35, 1, 3, 1, 0.2f); /* of the background a single pixel counts */
  CHECK (note (&c, notes, &mean) == 2);
  CHECK (notes[0].label == 2 && notes[0].change == CELD_REGION_UNSURE);
  NEAR (notes[0].certainty, 1 - 0.5 * 8 / 30, 1e-6);
  CHECK (notes[0].x >= 14 && notes[0].x <= 15 && notes[0].y >= 23 && notes[0].y <= 24);
  CHECK (notes[1].label == BACKGROUND && notes[1].x == 35 && notes[1].y == 3);
}

/* Ink has no certainty, which makes nothing unsure. */
static void
ink_does_not_count (void)
{
  Clip           c;
  CeldRegionNote notes[N];
  double         mean;

  fill (&c);
  for (int i = 0; i < W * H; i++)
    if (i % 10 < 5)
      c.ink[i] = c.certainty[i] = 0;
  CHECK (note (&c, notes, &mean) == 0);
  NEAR (mean, 0.5, 1e-6);
}

static void
what_vanishes_or_appears_is_noted (void)
{
  Clip           c;
  CeldRegionNote notes[N];
  double         mean;

  fill (&c);
  for (int i = 0; i < W * H; i++)
    c.after[i] = c.before[i] == 1 ? 4 : c.before[i];
  set_certainty (&c, 0, 10, 0, 30, 0.4f);
  CHECK (note (&c, notes, &mean) == 2);
  CHECK (notes[0].label == 1 && notes[0].change == CELD_REGION_GONE && notes[0].certainty == 0);
  CHECK (notes[0].x >= 4 && notes[0].x <= 5 && notes[0].y >= 14 && notes[0].y <= 15); /* where it was */
  CHECK (notes[1].label == 4 && notes[1].change == CELD_REGION_NEW);
  NEAR (notes[1].certainty, 0.4, 1e-6);
}

/* What did not come back is noted, however small, but for the background. */
static void
doubtful_ones_are_noted (void)
{
  Clip           c;
  CeldRegionNote notes[N];
  double         mean;

  fill (&c);
  c.sure[3] = c.sure[BACKGROUND] = 0.6;
  CHECK (note (&c, notes, &mean) == 1);
  CHECK (notes[0].label == 3 && notes[0].change == CELD_REGION_UNSURE && notes[0].certainty == 0.6);
  CHECK (notes[0].x >= 24 && notes[0].x <= 25 && notes[0].y >= 14 && notes[0].y <= 15);
}

static void
unsure_regions_and_frames_want_a_review (void)
{
  CeldRegionNote note[2] = { { .certainty = 1 }, { .certainty = 0.7 } };

  CHECK (!celd_wants_review (NULL, 0, 0.9) && celd_wants_review (NULL, 0, 0.899));
  CHECK (!celd_wants_review (note, 2, 0.9) && celd_wants_review (note, 2, 0.5));
  note[1].certainty = 0.699;
  CHECK (celd_wants_review (note, 2, 1) && !celd_wants_review (note, 1, 1));
}

static void
bad_input (void)
{
  static Clip    c;
  CeldRegionNote notes[N];
  CeldPlane      ink = { W, H, W, c.ink }, low = { W, H - 1, W, c.ink };
  CeldLabels     labels = { W, H, W, c.before };
  double         mean;
  size_t         n;

  fill (&c);
  CHECK (celd_note_regions (&low, &labels, &labels, &ink, N, 0, NULL, notes, &n, &mean) == CELD_BAD_SIZE && n == 0);
  CHECK (celd_note_regions (&ink, &labels, &labels, &low, N, 0, NULL, notes, &n, &mean) == CELD_BAD_SIZE);
  CHECK (celd_note_regions (&ink, &labels, &labels, &ink, N - 1, 0, NULL, notes, &n, &mean) == CELD_BAD_VALUE);
  CHECK (celd_note_regions (&ink, &labels, &labels, &ink, N, 0, NULL, notes, &n, &mean) == CELD_OK && n == 0);
  NEAR (mean, 1, 1e-9);
}

int
main (void)
{
  RUN (nothing_is_noted_of_sure_regions);
  RUN (unsure_ones_are_noted_where_they_are);
  RUN (ink_does_not_count);
  RUN (what_vanishes_or_appears_is_noted);
  RUN (doubtful_ones_are_noted);
  RUN (unsure_regions_and_frames_want_a_review);
  RUN (bad_input);
  return DONE;
}
