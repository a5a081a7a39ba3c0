/* Normals at strokes inside a region: quilting, depth on both sides, painted hints.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "discs.h"

/* A disc with a stroke down its middle, of which both ends lie inside it, and one on the paper. */
static Picture
disc_with_stroke (void)
{
  Picture p = picture (200, 160);

  put_disc (&p, (Disc) { 80, 80, 70 }, 3, 1);
  for (int y = 40; y < 120; y++)
    for (int x = 78; x < 82; x++)
      p.ink.data[y * 200 + x] = p.ink.data[y * 200 + x + 100] = 0;
  return p;
}

/* How steep both sides of the stroke fall towards it: n_x of the left one, -n_x of the right one. */
static void
folds (const Picture *p, double fold[2])
{
  fold[0] = (double) CELD_XYZ (&p->normals, 79, 80)[0];
  fold[1] = -(double) CELD_XYZ (&p->normals, 80, 80)[0];
}

static void
quilting_bends_both_sides_of_a_stroke (void)
{
  Picture      p = disc_with_stroke ();
  CeldSettings settings = celd_settings ();
  double       fold[2];

  make (&p, 1);
  folds (&p, fold);
  NEAR (fold[0], 0, 0.03);
  for (int half = 1; half < 3; half++)
    {
      settings.creases = 0.4f * (float) half;
      CHECK (celd_normals (&p.ink, &p.levels, &settings, NULL, &p.normals) == CELD_OK);
      folds (&p, fold);
      CHECK (fold[0] > 0.3 * half && fold[0] < 0.4 * half + 0.01);
      NEAR (fold[0], fold[1], 0.02);
      NEAR (CELD_XYZ (&p.normals, 79, 80)[1], 0, 0.05);
      NEAR (angle (&p, 179, 80, 0, 0, 1), 0, 0); /* nothing on the paper */
      CHECK (CELD_XYZ (&p.normals, 80, 130)[2] > 0.6f); /* nor beyond the end */
    }
  picture_free (&p);
}

static void
with_depth_only_the_higher_side_bends (void)
{
  Picture      p = disc_with_stroke ();
  CeldPlane    depth = { 200, 160, 200, malloc (200 * 160 * sizeof (float)) };
  CeldSettings settings = celd_settings ();
  double       fold[2];

  settings.creases = 1;
  for (int right = 0; right < 2; right++)
    {
      for (int i = 0; i < 200 * 160; i++)
        depth.data[i] = (i % 200 >= 80) == right ? 0.6f : 0.4f;
      CHECK (celd_normals_hinted (&p.ink, NULL, &p.levels, &depth, NULL, &settings, NULL, &p.normals) == CELD_OK);
      folds (&p, fold);
      CHECK (fold[right] > 0.8 && fold[!right] < 0.2);
    }
  free (depth.data);
  picture_free (&p);
}

/* Paints a column of pixels. */
static void
paint (CeldPaint *hints, int left, int right, uint8_t grey)
{
  for (int y = 0; y < hints->height; y++)
    for (int x = left; x < right; x++)
      {
        memset (CELD_RGBA (hints, x, y), grey, 3);
        CELD_RGBA (hints, x, y)[3] = 255;
      }
}

static void
hints_decide_which_side_of_a_stroke_bends (void)
{
  static const struct { int left, right; bool folds[2]; } cases[] = { /* -1: nothing is painted */
    { 255, -1, { true, false } }, { -1, 255, { false, true } }, { 255, 0, { true, false } },
    { 128, -1, { true, true } }, { -1, 128, { true, true } }, { 255, 255, { true, true } },
    { 0, -1, { false, false } }, { -1, -1, { false, false } },
  };
  Picture      p = disc_with_stroke ();
  CeldPaint    hints = { 200, 160, 200, malloc (4 * 200 * 160) };
  CeldSettings settings = celd_settings ();
  double       fold[2];

  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
    {
      memset (hints.data, 0, 4 * 200 * 160);
      if (cases[i].left >= 0)
        paint (&hints, 74, 79, (uint8_t) cases[i].left);
      if (cases[i].right >= 0)
        paint (&hints, 81, 86, (uint8_t) cases[i].right);
      CHECK (celd_normals_hinted (&p.ink, NULL, &p.levels, NULL, &hints, &settings, NULL, &p.normals) == CELD_OK);
      folds (&p, fold);
      for (int side = 0; side < 2; side++)
        CHECK ((fold[side] > 0.8) == cases[i].folds[side] && (fold[side] < 0.2) == !cases[i].folds[side]);
    }
  free (hints.data);
  picture_free (&p);
}

int
main (void)
{
  RUN (quilting_bends_both_sides_of_a_stroke);
  RUN (with_depth_only_the_higher_side_bends);
  RUN (hints_decide_which_side_of_a_stroke_bends);
  return DONE;
}
