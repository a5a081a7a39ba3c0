/* Contour ownership: drawings with known owners, known answers on small pictures, and properties of any picture.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "blobs.h"
#include "base/base.h"

/* One drawing; pages are larger where pens are thicker. */
static double
own_blobs (uint32_t seed, double pen, double vary, CeldExpansion method)
{
  int           side = 180 + (int) (10 * pen);
  Blobs         b;
  CeldOwnership own;
  double        score;

  blobs_new (side, side, &b);
  for (int k = 0; k < 7; k++)
    blobs_add (&b, &seed, pen, vary);
  CHECK (celd_ownership_new (side, side, &own) == CELD_OK);
  CHECK (celd_own (&b.ink, NULL, &b.labels, b.level, b.n, NULL, method, NULL, &own) == CELD_OK);
  score = blobs_score (&b, &own);
  celd_ownership_clear (&own);
  blobs_free (&b);
  return score;
}

/* The mean over some drawings. */
static double
mean_score (double pen, double vary, CeldExpansion method)
{
  enum { DRAWINGS = 3 };
  double sum = 0;

  for (uint32_t seed = 1; seed <= DRAWINGS; seed++)
    sum += own_blobs (seed * 7919, pen, vary, method);
  return sum / DRAWINGS;
}

static void
pens_are_told_apart (void)
{
  static const double pens[] = { 2, 4, 9, 16, 24 };

  for (size_t i = 0; i < sizeof pens / sizeof *pens; i++)
    CHECK (mean_score (pens[i], 0, CELD_EXPANSION_OUTLINES) >= 0.985);
}

static void
hair_lines_and_brushes_are_told_apart (void)
{
  CHECK (mean_score (1, 0, CELD_EXPANSION_OUTLINES) >= 0.98);
  CHECK (mean_score (6, 0.3, CELD_EXPANSION_OUTLINES) >= 0.975);
  CHECK (mean_score (9, 0.3, CELD_EXPANSION_OUTLINES) >= 0.975);
  CHECK (mean_score (16, 0.2, CELD_EXPANSION_OUTLINES) >= 0.98);
}

static void
pens_beat_thickness (void)
{
  CHECK (1 - mean_score (8, 0, CELD_EXPANSION_OUTLINES) <= 0.5 * (1 - mean_score (8, 0, CELD_EXPANSION_THICKNESS)));
}

/* ------------------------------------------------------------------ sheets that lie on each other's outlines */

/* A rectangle on a page that is turned a little, so that its sides cross the grid. */
static void
add_sheet (Blobs *b, double left, double top, double right, double bottom, double pen)
{
  enum { SIDE = BLOB_CORNERS / 4 };
  const double corner[5][2] = { { left, top }, { right, top }, { right, bottom }, { left, bottom }, { left, top } };
  Blob         blob;

  for (int i = 0; i < BLOB_CORNERS; i++)
    {
      const double *from = corner[i / SIDE], *to = corner[i / SIDE + 1];
      double        t = (double) (i % SIDE) / SIDE, x = from[0] + t * (to[0] - from[0]) - 130;
      double        y = from[1] + t * (to[1] - from[1]) - 130;

      blob.x[i]     = 130 + 0.97 * x - 0.24 * y;
      blob.y[i]     = 130 + 0.24 * x + 0.97 * y;
      blob.width[i] = pen;
    }
  blobs_draw (b, &blob);
}

/* The share of ink that gets its owner; frees b. */
static double
score_sheets (Blobs *b)
{
  CeldOwnership own;
  double        score;

  CHECK (celd_ownership_new (b->ink.width, b->ink.height, &own) == CELD_OK);
  CHECK (celd_own (&b->ink, NULL, &b->labels, b->level, b->n, NULL, CELD_EXPANSION_OUTLINES, NULL, &own) == CELD_OK);
  score = blobs_score (b, &own);
  celd_ownership_clear (&own);
  blobs_free (b);
  return score;
}

/* A cover of pen 3 ends where its block of pages, drawn with a thick pen, begins: what is left of the thick line beside
 * the thin one belongs to the pages, whose own line goes on round the corners. */
static void
a_thin_sheet_leaves_the_outline_below_it (void)
{
  static const double pens[] = { 12, 8 };

  for (size_t i = 0; i < sizeof pens / sizeof *pens; i++)
    {
      Blobs b;

      blobs_new (260, 260, &b);
      add_sheet (&b, 70, 130, 190, 180, pens[i]);
      add_sheet (&b, 70, 60, 190, 130, 3);
      CHECK (score_sheets (&b) >= 0.98);
    }
}

/* Three sides of a pane of pen 3 lie on a frame of a thick pen, so that most of its outline is thicker than its pen. */
static void
a_pen_is_measured_where_it_is_alone (void)
{
  static const double pens[] = { 12, 8 };

  for (size_t i = 0; i < sizeof pens / sizeof *pens; i++)
    {
      Blobs b;

      blobs_new (260, 260, &b);
      add_sheet (&b, 90, 40, 160, 220, pens[i]);
      add_sheet (&b, 90, 80, 160, 220, 3);
      CHECK (score_sheets (&b) >= 0.98);
    }
}

/* Two sheets side by side.  The outline of the farther one is seen along the edge of the nearer one, all of it or what
 * is left beyond `covered` pixels: each has its own line, however much wider one pen is than the other. */
static void
side_by_side_each_has_its_line (void)
{
  static const double pens[][2] = { { 6, 10 }, { 10, 6 }, { 8, 8 } };

  for (size_t i = 0; i < sizeof pens / sizeof *pens; i++)
    for (double covered = 0; covered <= 1.5; covered += 0.75)
      {
        double far = pens[i][0], near = pens[i][1];
        Blobs  b;

        blobs_new (260, 260, &b);
        add_sheet (&b, 130 + (far + near) / 2 - covered, 90, 200, 170, far);
        add_sheet (&b, 60, 60, 130, 200, near);
        CHECK (score_sheets (&b) >= 0.99);
      }
}

/* ------------------------------------------------------------------ tips */

/* The end of a leaf lies on the outline of a disc behind it.  Its path is curved and turns within less than the pen's
 * width, so that its paper has a sharp corner there, whose sides as a whole meet far beyond the line. */
static void
a_tip_ends_where_its_line_turns (void)
{
  static const double exponents[] = { 0.2, 0.4, 0.8 };

  for (size_t k = 0; k < sizeof exponents / sizeof *exponents; k++)
    {
      Blobs b;
      Blob  disc, leaf;

      blobs_new (260, 260, &b);
      for (int i = 0; i < BLOB_CORNERS; i++)
        {
          double turn = 8 * atan (1) * i / BLOB_CORNERS;

          disc.x[i]     = 130.3 + 50 * sin (turn);
          disc.y[i]     = 70.2 - 50 * cos (turn);
          leaf.x[i]     = 130.3 + 34 * sin (turn) * pow (fabs (sin (turn / 2)), exponents[k]);
          leaf.y[i]     = 192.2 - 50 * cos (turn);
          disc.width[i] = leaf.width[i] = 24;
        }
      blobs_draw (&b, &disc);
      blobs_draw (&b, &leaf);
      CHECK (score_sheets (&b) >= 0.985);
    }
}

/* A line of the head, 2, leaves the outline of the hair, 3, at an angle of 20 degrees: one side of the outline runs on
 * into it as if it were the tip of the hair.  But the hair's paper has no corner there, and the line is the head's. */
static void
a_line_that_leaves_an_outline_is_no_tip (void)
{
  const uint32_t level[3] = { 0, 1, 2 };
  const double   c = cos (20 * atan (1) / 45), s = sin (20 * atan (1) / 45);
  CeldPlane      ink;
  CeldLabels     labels;
  CeldOwnership  own;
  int            wrong = 0;

  CHECK (celd_plane_new (180, 200, &ink) == CELD_OK && celd_labels_new (180, 200, &labels) == CELD_OK);
  CHECK (celd_ownership_new (180, 200, &own) == CELD_OK);
  for (int y = 0; y < 200; y++)
    for (int x = 0; x < 180; x++)
      {
        double across = (x + 0.5 - 68) * c - (y + 0.5 - 70) * s;
        bool   head = x >= 20 && x < 160 && y >= 20 && y < 180;
        bool   line = x < 28 || x >= 152 || y < 28 || y >= 172 || (x >= 64 && x < 72) || (y >= 70 && fabs (across) < 4);

        CELD_AT (&ink, x, y)    = !(head && line);
        CELD_AT (&labels, x, y) = !head ? 1 : x < 68 ? 3 : 2;
      }
  CHECK (celd_own (&ink, NULL, &labels, level, 3, NULL, CELD_EXPANSION_OUTLINES, NULL, &own) == CELD_OK);
  for (int y = 96; y < 170; y++) /* they part at 93 */
    for (int x = 28; x < 150; x++)
      wrong += CELD_AT (&own.owner, x, y) != (x < 72 ? 3 : 2);
  CHECK (wrong == 0);
  celd_ownership_clear (&own);
  celd_free (ink.data);
  celd_free (labels.data);
}

/* ------------------------------------------------------------------ known answers */

/* '#' is ink, letters are paper of that label; labels in alphabetical order are from back to front. */
static void
expect (const char *const *rows, const char *const *wanted, CeldExpansion method)
{
  CeldPlane     ink = art_plane (rows);
  CeldLabels    labels = art_labels (rows), owners = art_labels (wanted);
  uint32_t      level[26];
  CeldOwnership own;

  for (uint32_t k = 0; k < 26; k++)
    level[k] = k;
  for (int p = 0; p < ink.width * ink.height; p++)
    {
      ink.data[p]    = labels.data[p] ? 1 : 0;
      labels.data[p] = labels.data[p] ? labels.data[p] : 1;
    }
  CHECK (celd_ownership_new (ink.width, ink.height, &own) == CELD_OK);
  CHECK (celd_own (&ink, NULL, &labels, level, 26, NULL, method, NULL, &own) == CELD_OK);
  CHECK (!memcmp (own.owner.data, owners.data, (size_t) (ink.width * ink.height) * sizeof (uint32_t)));
  for (int p = 0; p < ink.width * ink.height; p++)
    CHECK (own.under.data[p] == own.owner.data[p] && own.coverage.data[p] == 1);
  celd_ownership_clear (&own);
  free (ink.data);
  free (labels.data);
  free (owners.data);
}

static void
a_contour_is_the_nearer_regions (void)
{
  static const char *const rows[] = { "AAA##BBB", "AAA##BBB", "AAA##BBB", "AAA##BBB", "AAA##BBB", "AAA##BBB", NULL };
  static const char *const wanted[] = { "AAABBBBB", "AAABBBBB", "AAABBBBB", "AAABBBBB", "AAABBBBB", "AAABBBBB", NULL };

  expect (rows, wanted, CELD_EXPANSION_OUTLINES);
  expect (rows, wanted, CELD_EXPANSION_THICKNESS);
}

static void
ink_within_a_region_is_its_own (void)
{
  static const char *const rows[] = { "AAAAAAAA", "AAAAAAAA", "AA####AA", "AAAAAAAA", "AAAAA#AA", NULL };
  static const char *const wanted[] = { "AAAAAAAA", "AAAAAAAA", "AAAAAAAA", "AAAAAAAA", "AAAAAAAA", NULL };

  expect (rows, wanted, CELD_EXPANSION_OUTLINES);
  expect (rows, wanted, CELD_EXPANSION_THICKNESS);
}

/* A head, 2, on a page, 1, with an eye whose ring touches the outline of the hair, 3, or lies on a part of it: pens are
 * 8 wide, `covered` of them at most.  The ring is the head's, and the outline goes on straight beside it, but for a few
 * pixels where they part. */
static void
a_line_inside_keeps_its_ink_beside_an_outline (void)
{
  const uint32_t level[3] = { 0, 1, 2 };

  for (int covered = 0; covered <= 3; covered++)
    {
      CeldPlane     ink;
      CeldLabels    labels;
      CeldOwnership own;
      double        eye = 72 + 20 - covered; /* the line of the hair is 64 .. 72 */
      int           wrong = 0;

      CHECK (celd_plane_new (180, 160, &ink) == CELD_OK && celd_labels_new (180, 160, &labels) == CELD_OK);
      CHECK (celd_ownership_new (180, 160, &own) == CELD_OK);
      for (int y = 0; y < 160; y++)
        for (int x = 0; x < 180; x++)
          {
            double ring = hypot (x + 0.5 - eye, y + 0.5 - 80);
            bool   head = x >= 20 && x < 160 && y >= 20 && y < 140;
            bool   line = x < 28 || x >= 152 || y < 28 || y >= 132 || (x >= 64 && x < 72) || (ring >= 12 && ring < 20);

            CELD_AT (&ink, x, y)    = !(head && line);
            CELD_AT (&labels, x, y) = !head ? 1 : x < 68 ? 3 : 2;
          }
      CHECK (celd_own (&ink, NULL, &labels, level, 3, NULL, CELD_EXPANSION_OUTLINES, NULL, &own) == CELD_OK);
      for (int y = 40; y < 120; y++)
        for (int x = 28; x < 150; x++)
          wrong += CELD_AT (&own.owner, x, y) != (x < 72 ? 3 : 2);
      CHECK (wrong <= 8);
      celd_ownership_clear (&own);
      celd_free (ink.data);
      celd_free (labels.data);
    }
}

/* A label without paper keeps its ink. */
static void
a_black_patch_keeps_its_ink (void)
{
  CeldPlane      ink;
  CeldLabels     labels;
  CeldOwnership  own;
  const uint32_t level[3] = { 0, 2, 1 };

  CHECK (celd_plane_new (30, 20, &ink) == CELD_OK && celd_labels_new (30, 20, &labels) == CELD_OK);
  CHECK (celd_ownership_new (30, 20, &own) == CELD_OK);
  for (int y = 0; y < 20; y++)
    for (int x = 0; x < 30; x++)
      {
        CELD_AT (&labels, x, y) = x < 10 ? 1 : x < 20 ? 3 : 2;
        CELD_AT (&ink, x, y)    = x < 8 || x >= 22;
      }
  for (int method = 0; method < 2; method++)
    {
      CHECK (celd_own (&ink, NULL, &labels, level, 3, NULL, (CeldExpansion) method, NULL, &own) == CELD_OK);
      CHECK (CELD_AT (&own.owner, 12, 9) == 3 && CELD_AT (&own.owner, 18, 9) == 3 && CELD_AT (&own.owner, 26, 9) == 2);
    }
  celd_ownership_clear (&own);
  celd_free (ink.data);
  celd_free (labels.data);
}

/* A speck of paper that is left where one line meets another, as by antialiasing in an acute corner, claims nothing for
 * the nearer region. */
static void
specks_of_paper_claim_no_ink (void)
{
  CeldPlane      ink;
  CeldLabels     labels;
  CeldOwnership  own;
  const uint32_t level[3] = { 0, 1, 2 };

  CHECK (celd_plane_new (60, 50, &ink) == CELD_OK && celd_labels_new (60, 50, &labels) == CELD_OK);
  CHECK (celd_ownership_new (60, 50, &own) == CELD_OK);
  for (int size = 1; size <= 2; size++)
    {
      for (int y = 0; y < 50; y++)
        for (int x = 0; x < 60; x++)
          {
            bool speck = x < 30 && x >= 30 - size && y == 24;

            CELD_AT (&labels, x, y) = x >= 35 ? 3 : y < 24 ? 1 : 2;
            CELD_AT (&ink, x, y)    = !((y >= 20 && y < 30 && x < 30) || (x >= 30 && x < 40)) || speck;
          }
      CHECK (celd_own (&ink, NULL, &labels, level, 3, NULL, CELD_EXPANSION_OUTLINES, NULL, &own) == CELD_OK);
      for (int y = 0; y < 50; y++)
        for (int x = 0; x < 60; x++)
          CHECK (x == 29 || CELD_AT (&own.owner, x, y) == (x >= 30 ? 3 : y < 20 ? 1 : 2)); /* 29: beside the crossing */
    }
  celd_ownership_clear (&own);
  celd_free (ink.data);
  celd_free (labels.data);
}

/* A line with three quarters of a pixel of ink on a bright page: the coverage of the nearer label is the ink's. */
static void
antialiased_pixels_have_two_labels (void)
{
  CeldPlane      ink;
  CeldLabels     labels;
  CeldOwnership  own;
  const uint32_t level[2] = { 0, 1 };

  CHECK (celd_plane_new (12, 9, &ink) == CELD_OK && celd_labels_new (12, 9, &labels) == CELD_OK);
  CHECK (celd_ownership_new (12, 9, &own) == CELD_OK);
  for (int y = 0; y < 9; y++)
    for (int x = 0; x < 12; x++)
      {
        CELD_AT (&ink, x, y)    = x == 4 ? 0.75f : x == 5 || x == 6 ? 0 : x == 7 ? 0.25f : 1;
        CELD_AT (&labels, x, y) = x < 6 ? 1 : 2;
      }
  CHECK (celd_own (&ink, NULL, &labels, level, 2, NULL, CELD_EXPANSION_OUTLINES, NULL, &own) == CELD_OK);
  CHECK (CELD_AT (&own.owner, 3, 4) == 1 && CELD_AT (&own.coverage, 3, 4) == 1);
  CHECK (CELD_AT (&own.owner, 4, 4) == 2 && CELD_AT (&own.under, 4, 4) == 1);
  NEAR (CELD_AT (&own.coverage, 4, 4), 0.25, 1e-6);
  CHECK (CELD_AT (&own.owner, 5, 4) == 2 && CELD_AT (&own.coverage, 5, 4) == 1);
  CHECK (CELD_AT (&own.owner, 7, 4) == 2 && CELD_AT (&own.under, 7, 4) == 2 && CELD_AT (&own.coverage, 7, 4) == 1);
  celd_ownership_clear (&own);
  celd_free (ink.data);
  celd_free (labels.data);
}

/* A bar of ink between two regions meets another line: a dot of the farther region's colour takes the bar alone. */
static void
corrections_reassign_a_piece_of_line (void)
{
  CeldPlane      ink;
  CeldLabels     labels, dots;
  CeldOwnership  own;
  const uint32_t level[3] = { 0, 1, 2 };

  CHECK (celd_plane_new (60, 40, &ink) == CELD_OK && celd_labels_new (60, 40, &labels) == CELD_OK);
  CHECK (celd_labels_new (60, 40, &dots) == CELD_OK && celd_ownership_new (60, 40, &own) == CELD_OK);
  for (int y = 0; y < 40; y++)
    for (int x = 0; x < 60; x++)
      {
        CELD_AT (&labels, x, y) = x >= 30 ? 3 : y < 20 ? 1 : 2; /* the right half lies in front of both */
        CELD_AT (&ink, x, y)    = !((y >= 18 && y < 22 && x < 30) || (x >= 28 && x < 32));
      }
  CELD_AT (&dots, 8, 19) = 1;
  for (int method = 0; method < 2; method++)
    {
      CHECK (celd_own (&ink, NULL, &labels, level, 3, &dots, (CeldExpansion) method, NULL, &own) == CELD_OK);
      CHECK (CELD_AT (&own.owner, 3, 20) == 1 && CELD_AT (&own.owner, 20, 19) == 1);
      CHECK (CELD_AT (&own.owner, 20, 20) == 1 && CELD_AT (&own.owner, 29, 5) == 3);
      CHECK (CELD_AT (&own.owner, 29, 35) == 3 && CELD_AT (&own.owner, 30, 20) == 3);
      CHECK (CELD_AT (&own.owner, 10, 30) == 2 && CELD_AT (&own.owner, 10, 10) == 1);
    }
  celd_ownership_clear (&own);
  celd_free (ink.data);
  celd_free (labels.data);
  celd_free (dots.data);
}

/* ------------------------------------------------------------------ any picture */

/* Blocks of ink and labels, where a level sometimes gets ink that is not connected with its labels: the result in
 * place is the same. */
static void
the_result_may_alias_the_labels (void)
{
  enum { SIDE = 40, BLOCK = 5 };
  CeldPlane     ink;
  CeldLabels    labels;
  CeldOwnership own, place;

  CHECK (celd_plane_new (SIDE, SIDE, &ink) == CELD_OK && celd_labels_new (SIDE, SIDE, &labels) == CELD_OK);
  CHECK (celd_ownership_new (SIDE, SIDE, &own) == CELD_OK && celd_ownership_new (SIDE, SIDE, &place) == CELD_OK);
  for (uint32_t seed = 1; seed <= 500 && !check_bad; seed++)
    {
      uint32_t       r = seed;
      const uint32_t level[4] = { check_random (&r, 3), check_random (&r, 3), check_random (&r, 3), 1 };
      size_t         bytes = SIDE * SIDE * sizeof (uint32_t);

      for (int p = 0; p < SIDE * SIDE; p++)
        {
          bool first = p % SIDE % BLOCK == 0, top = p / SIDE % BLOCK == 0;

          labels.data[p] = !first ? labels.data[p - 1] : !top ? labels.data[p - SIDE] : 1 + check_random (&r, 4);
          ink.data[p]    = !first ? ink.data[p - 1] : !top ? ink.data[p - SIDE] : (float) check_random (&r, 2);
          ink.data[p]   *= first && !check_random (&r, 9) ? 0 : 1;
        }
      memcpy (place.owner.data, labels.data, bytes);
      CHECK (celd_own (&ink, NULL, &labels, level, 4, NULL, (CeldExpansion) (seed % 2), NULL, &own) == CELD_OK);
      CHECK (celd_own (&ink, NULL, &place.owner, level, 4, NULL, (CeldExpansion) (seed % 2), NULL, &place) == CELD_OK);
      CHECK (!memcmp (place.owner.data, own.owner.data, bytes) && !memcmp (place.under.data, own.under.data, bytes));
    }
  celd_ownership_clear (&own);
  celd_ownership_clear (&place);
  celd_free (ink.data);
  celd_free (labels.data);
}

/* Paper keeps its label, ink gets an existing one, and coverage is within (0,1]. */
static void
paper_keeps_its_label (void)
{
  for (uint32_t seed = 1; seed <= 60 && !check_bad; seed++)
    {
      uint32_t       r = seed;
      int            w = 1 + (int) check_random (&r, 40), h = 1 + (int) check_random (&r, 40);
      const uint32_t level[4] = { check_random (&r, 3), check_random (&r, 3), check_random (&r, 3), 1 };
      CeldPlane      ink;
      CeldLabels     labels;
      CeldOwnership  own;

      CHECK (celd_plane_new (w, h, &ink) == CELD_OK && celd_labels_new (w, h, &labels) == CELD_OK);
      CHECK (celd_ownership_new (w, h, &own) == CELD_OK);
      for (int p = 0; p < w * h; p++)
        {
          ink.data[p]    = 0.01f * (float) check_random (&r, 101);
          labels.data[p] = 1 + (p && check_random (&r, 4) ? labels.data[p - 1] - 1 : check_random (&r, 4));
        }
      CHECK (celd_own (&ink, NULL, &labels, level, 4, NULL, (CeldExpansion) (seed % 2), NULL, &own) == CELD_OK);
      for (int p = 0; p < w * h; p++)
        {
          uint32_t more = own.coverage.data[p] >= 0.5f ? own.owner.data[p] : own.under.data[p];

          CHECK (own.owner.data[p] >= 1 && own.owner.data[p] <= 4 && own.under.data[p] >= 1 && own.under.data[p] <= 4);
          CHECK (own.coverage.data[p] > 0 && own.coverage.data[p] <= 1);
          CHECK (level[own.owner.data[p] - 1] >= level[own.under.data[p] - 1]);
          CHECK (ink.data[p] <= 0.5f || more == labels.data[p]);
        }
      celd_ownership_clear (&own);
      celd_free (ink.data);
      celd_free (labels.data);
    }
}

static void
bad_input_does_no_harm (void)
{
  CeldPlane      ink;
  CeldLabels     labels, other;
  CeldOwnership  own;
  const uint32_t level[1] = { 0 };

  CHECK (celd_plane_new (5, 4, &ink) == CELD_OK && celd_labels_new (5, 4, &labels) == CELD_OK);
  CHECK (celd_labels_new (4, 5, &other) == CELD_OK && celd_ownership_new (5, 4, &own) == CELD_OK);
  for (int p = 0; p < 20; p++)
    ink.data[p] = 0;
  CHECK (celd_own (&ink, NULL, &labels, level, 1, NULL, CELD_EXPANSION_OUTLINES, NULL, &own) == CELD_BAD_VALUE);
  CHECK (celd_own (&ink, NULL, &other, level, 1, NULL, CELD_EXPANSION_OUTLINES, NULL, &own) == CELD_BAD_SIZE);
  for (int p = 0; p < 20; p++)
    labels.data[p] = 1;
  CHECK (celd_own (&ink, NULL, &labels, level, 1, NULL, CELD_EXPANSION_OUTLINES, NULL, &own) == CELD_OK);
  CHECK (own.owner.data[7] == 1 && own.under.data[7] == 1 && own.coverage.data[7] == 1); /* ink alone */
  celd_ownership_clear (&own);
  celd_free (ink.data);
  celd_free (labels.data);
  celd_free (other.data);
}

int
main (void)
{
  RUN (pens_are_told_apart);
  RUN (hair_lines_and_brushes_are_told_apart);
  RUN (pens_beat_thickness);
  RUN (a_thin_sheet_leaves_the_outline_below_it);
  RUN (a_pen_is_measured_where_it_is_alone);
  RUN (side_by_side_each_has_its_line);
  RUN (a_tip_ends_where_its_line_turns);
  RUN (a_line_that_leaves_an_outline_is_no_tip);
  RUN (a_contour_is_the_nearer_regions);
  RUN (ink_within_a_region_is_its_own);
  RUN (a_line_inside_keeps_its_ink_beside_an_outline);
  RUN (a_black_patch_keeps_its_ink);
  RUN (specks_of_paper_claim_no_ink);
  RUN (antialiased_pixels_have_two_labels);
  RUN (corrections_reassign_a_piece_of_line);
  RUN (the_result_may_alias_the_labels);
  RUN (paper_keeps_its_label);
  RUN (bad_input_does_no_harm);
  return DONE;
}
