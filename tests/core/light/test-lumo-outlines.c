/* Normals at outlines: which side bends, gaps and virtual contours, the frame, painted hints.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "discs.h"

static void
a_virtual_contour_neither_cuts_nor_bends (void)
{
  Picture p = picture (120, 100), q = picture (120, 100);
  Disc    d = { 60, 50, 40 };

  put_disc (&p, d, 3, 1);
  put_disc (&q, d, 3, 1);
  for (int i = 0; i < 120 * 100; i++) /* half of the disc is nearer, but no ink says so inside */
    if (q.levels.data[i] > 0 && i % 120 >= 60)
      q.levels.data[i] = 2;
  make (&p, 1);
  make (&q, 1);
  for (int y = 20; y < 80; y += 3)
    for (int x = 30; x < 90; x += 3)
      {
        const float *n = CELD_XYZ (&p.normals, x, y);

        NEAR (angle (&q, x, y, (double) n[0], (double) n[1], (double) n[2]), 0, 6);
      }
  picture_free (&p);
  picture_free (&q);
}

/* Normals where gaps in contours do not hold. */
static void
make_open (Picture *p)
{
  CeldSettings settings = celd_settings ();

  settings.hold_gaps = false;
  CHECK (celd_normals (&p->ink, &p->levels, &settings, NULL, &p->normals) == CELD_OK);
}

/* A contour with a gap: the disc still bends, the paper that it is joined with stays flat. */
static void
paper_stays_flat_behind_a_gap (void)
{
  Disc    d = { 60, 60, 40 };
  Picture p = picture (120, 120);
  double  largest;

  put_disc (&p, d, 3, 1);
  for (int y = 50; y < 70; y++)
    for (int x = 90; x < 110; x++)
      p.ink.data[y * 120 + x] = 1;
  make_open (&p);
  CHECK (compare_disc (&p, d, &largest) < 10);
  CHECK (angle (&p, 93, 60, 0, 0, 1) < angle (&p, 26, 60, 0, 0, 1) - 30); /* it flattens towards the gap */
  for (int i = 0; i < 120 * 120; i += 7)
    if (hypot (i % 120 - 60, i / 120 - 60) > 44)
      NEAR (angle (&p, i % 120, i / 120, 0, 0, 1), 0, 2);
  picture_free (&p);
}

/* Where gaps hold, the disc bends as if its contour were whole; but not where only the ink for segmentation is. */
static void
a_gap_that_holds_bends_like_ink (void)
{
  Disc         d = { 60, 60, 40 };
  Picture      whole = picture (120, 120), gap = picture (120, 120);
  CeldSettings settings = celd_settings ();

  put_disc (&whole, d, 3, 1);
  put_disc (&gap, d, 3, 1);
  for (int y = 54; y < 66; y++)
    for (int x = 90; x < 110; x++)
      gap.ink.data[y * 120 + x] = 1;
  make (&whole, 1);
  make (&gap, 1);
  for (int i = 0; i < 120 * 120; i++)
    {
      const float *n = CELD_XYZ (&whole.normals, i % 120, i / 120);

      NEAR (angle (&gap, i % 120, i / 120, (double) n[0], (double) n[1], (double) n[2]), 0, 1);
    }
  CHECK (celd_normals_hinted (&gap.ink, &whole.ink, &gap.levels, NULL, NULL, &settings, NULL, &gap.normals) == CELD_OK);
  CHECK (angle (&gap, 98, 60, 0, 0, 1) < 60 && angle (&whole, 98, 60, 0, 0, 1) > 70);
  picture_free (&whole);
  picture_free (&gap);
}

/* A contour is closed or not, wherever it lies and however wide the picture is: cut ends are looked for in words of
 * 64 pixels. */
static void
closed_contours_are_told_from_open_ones_anywhere (void)
{
  double wanted[2] = { 0, 0 };

  for (int width = 60; width < 200; width += width < 70 || width > 124 ? 1 : 27)
    for (int gap = 0; gap < 2; gap++)
      {
        Disc    d = { width - 26, 26, 20 };
        Picture p = picture (width, 52);
        double  sum = 0;

        put_disc (&p, d, 3, 1);
        for (int y = 22; gap && y < 30; y++)
          for (int x = width - 12; x < width; x++)
            p.ink.data[y * width + x] = 1;
        make_open (&p);
        for (int y = 0; y < 52; y++)
          for (int x = width - 52; x < width; x++)
            sum += (double) CELD_XYZ (&p.normals, x, y)[2];
        wanted[gap] = width == 60 ? sum : wanted[gap];
        NEAR (sum, wanted[gap], 0.002 * wanted[gap]);
        picture_free (&p);
      }
  CHECK (wanted[1] - wanted[0] > 20);
}

static void
the_frame_is_an_outline_if_asked_for (void)
{
  Picture      p = picture (100, 100);
  CeldSettings settings = celd_settings ();

  put_disc (&p, (Disc) { 100, 50, 40 }, 3, 1);
  make (&p, 1);
  CHECK (CELD_XYZ (&p.normals, 99, 50)[0] < 0.3f);
  settings.frame_outline = true;
  CHECK (celd_normals (&p.ink, &p.levels, &settings, NULL, &p.normals) == CELD_OK);
  CHECK (CELD_XYZ (&p.normals, 99, 50)[0] > 0.9f);
  CHECK (CELD_XYZ (&p.normals, 61, 50)[0] < -0.9f);
  NEAR (angle (&p, 0, 50, 0, 0, 1), 0, 0); /* not the paper */
  memset (p.levels.data, 0, 100 * 100 * sizeof (float));
  CHECK (celd_normals (&p.ink, &p.levels, &settings, NULL, &p.normals) == CELD_OK);
  CHECK (CELD_XYZ (&p.normals, 0, 50)[0] < -0.9f && CELD_XYZ (&p.normals, 50, 99)[1] < -0.9f); /* a cushion */
  picture_free (&p);
}

/* Of an outline, too: the paper bends where it is painted white, the disc does not where it is painted black. */
static void
hints_decide_which_side_of_an_outline_bends (void)
{
  Disc         d = { 60, 60, 40 };
  Picture      p = picture (120, 120);
  CeldPaint    hints = { 120, 120, 120, calloc (4, 120 * 120) };
  CeldSettings settings = celd_settings ();

  put_disc (&p, d, 3, 1);
  for (int y = 0; y < 120; y++)
    for (int x = 60; x < 120; x++)
      {
        bool inside = hypot (x + 0.5 - d.x, y + 0.5 - d.y) < d.radius;

        memset (CELD_RGBA (&hints, x, y), inside ? 0 : 255, 3);
        CELD_RGBA (&hints, x, y)[3] = 255;
      }
  CHECK (celd_normals_hinted (&p.ink, NULL, &p.levels, NULL, &hints, &settings, NULL, &p.normals) == CELD_OK);
  CHECK (CELD_XYZ (&p.normals, 20, 60)[0] < -0.9f);  /* left: as ever */
  CHECK (CELD_XYZ (&p.normals, 98, 60)[2] > 0.9f);   /* right: the disc runs under */
  CHECK (CELD_XYZ (&p.normals, 101, 60)[0] < -0.8f); /* the paper falls towards it */
  free (hints.data);
  picture_free (&p);
}

int
main (void)
{
  RUN (a_virtual_contour_neither_cuts_nor_bends);
  RUN (paper_stays_flat_behind_a_gap);
  RUN (a_gap_that_holds_bends_like_ink);
  RUN (closed_contours_are_told_from_open_ones_anywhere);
  RUN (the_frame_is_an_outline_if_asked_for);
  RUN (hints_decide_which_side_of_an_outline_bends);
  return DONE;
}
