/* Normals of whole sheets: what is half hidden is as round as what is not.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "discs.h"
#include "light/light.h"

enum { SIDE = 240 };

/* In degrees, between the normals of a pixel in two pictures. */
static double
difference (const Picture *p, const Picture *q, int x, int y)
{
  const float *n = CELD_XYZ (&q->normals, x, y);

  return angle (p, x, y, (double) n[0], (double) n[1], (double) n[2]);
}

/* A small disc in front of a large one leaves no trace in it: both have the normals of whole discs. */
static void
what_is_in_front_leaves_no_trace (void)
{
  Disc    large = { 90, 90, 80 }, small = { 120, 90, 30 };
  Picture p = picture (SIDE, SIDE), alone = picture (SIDE, SIDE);
  double  largest, worst = 0;

  put_disc (&p, large, 3, 1);
  put_disc (&alone, large, 3, 1);
  put_disc (&p, small, 3, 2);
  make (&p, 1);
  make (&alone, 1);
  NEAR (compare_disc (&p, small, &largest), 0, 1.5);
  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      if (hypot (x + 0.5 - small.x, y + 0.5 - small.y) > small.radius + 1)
        worst = fmax (worst, difference (&p, &alone, x, y));
  NEAR (worst, 0, 0.5);
  picture_free (&p);
  picture_free (&alone);
}

/* A bar across half of a disc, with outlines of 3 pixels. */
static Picture
picture_of_half_a_disc (Disc d)
{
  Picture p = picture (SIDE, SIDE);

  put_disc (&p, d, 3, 1);
  for (int y = (int) d.y; y < SIDE - 15; y++)
    for (int x = 0; x < SIDE; x++)
      {
        p.levels.data[y * SIDE + x] = 2;
        p.ink.data[y * SIDE + x]    = y > d.y + 2 && y < SIDE - 18;
      }
  return p;
}

/* Compares what is seen of the disc with a disc that nothing hides; mean and largest angle between normals. */
static double
compare_half (const Picture *p, Disc d, double *largest)
{
  Picture alone = picture (SIDE, SIDE);
  double  sum = 0;
  int     n = 0;

  put_disc (&alone, d, 3, 1);
  make (&alone, 1);
  *largest = 0;
  for (int y = 0; y < (int) d.y - 1; y++)
    for (int x = 0; x < SIDE; x++)
      if (hypot (x + 0.5 - d.x, y + 0.5 - d.y) < d.radius - 1.5)
        {
          double a = difference (p, &alone, x, y);

          sum += a;
          *largest = fmax (*largest, a);
          n++;
        }
  picture_free (&alone);
  return sum / n;
}

/* Given that its sheet is a whole disc. */
static void
what_is_half_hidden_has_the_normals_of_the_whole (void)
{
  Disc               d = { 120, 120, 90 };
  Picture            p = picture_of_half_a_disc (d);
  CeldSettings       settings = celd_settings ();
  CeldSheetRun       run[SIDE];
  uint8_t           *sure = malloc (SIDE * SIDE);
  CeldSheet          sheet[3] = { { .label = 1, .page = true }, { .label = 2, .run = run }, { .label = 3 } };
  CeldSheets         sheets = { .width = SIDE, .height = SIDE, .item = sheet, .n = 3,
                                .of_label = (uint32_t[3]) { 0, 1, 2 }, .n_labels = 3 };
  CeldLevelOwnership made;
  double             largest;

  memset (sure, 255, SIDE * SIDE);
  sheet[1].coverage = sheet[1].confidence = sure;
  for (int y = (int) d.y; y < (int) (d.y + d.radius); y++)
    {
      int half = (int) sqrt (d.radius * d.radius - (y + 0.5 - d.y) * (y + 0.5 - d.y));

      run[sheet[1].n_runs++] = (CeldSheetRun) { (int) d.x - half, y, 2 * half, sheet[1].n_hidden };
      sheet[1].n_hidden += (size_t) (2 * half);
    }
  CHECK (celd_expanded_ownership_new (&p.ink, &p.levels, &made) == CELD_OK);
  CHECK (celd_normals_of_sheets (&p.ink, NULL, &p.levels, &made.own, &sheets, NULL, NULL, &settings, NULL,
                                 &p.normals) == CELD_OK);
  NEAR (compare_half (&p, d, &largest), 0, 0.5);
  CHECK (largest < 5); /* where the outline vanishes */
  celd_level_ownership_clear (&made);
  free (sure);
  picture_free (&p);
}

/* The sheet is a guess here. */
static void
what_is_half_hidden_is_nearly_as_round_as_the_whole (void)
{
  Disc    d = { 120, 120, 90 };
  Picture p = picture_of_half_a_disc (d);
  double  largest;

  make (&p, 1);
  NEAR (compare_half (&p, d, &largest), 0, 8);
  CHECK (largest < 20);
  picture_free (&p);
}

/* A disc in two pieces, behind a bar: both pieces are of one surface. */
static void
pieces_of_a_sheet_are_one_surface (void)
{
  Disc    d = { 100, 100, 80 };
  Picture p = picture (SIDE, SIDE);
  double  largest;

  put_disc (&p, d, 3, 1);
  for (int y = 0; y < SIDE; y++)
    for (int x = 85; x < 115; x++)
      {
        p.levels.data[y * SIDE + x] = 2;
        p.ink.data[y * SIDE + x]    = x > 87 && x < 112;
      }
  make (&p, 1);
  for (int y = 0; y < SIDE; y++) /* the bar itself is not compared */
    for (int x = 84; x < 116; x++)
      {
        double u = (x + 0.5 - d.x) / d.radius, v = (d.y - y - 0.5) / d.radius, r = hypot (u, v);

        if (r < 1)
          memcpy (CELD_XYZ (&p.normals, x, y), (float[3]) { (float) u, (float) v, (float) sqrt (1 - r * r) },
                  3 * sizeof (float));
      }
  NEAR (compare_disc (&p, d, &largest), 0, 1.5);
  CHECK (largest < 5);
  picture_free (&p);
}

/* A patch that nearer discs surround has no outline of its own in sight, but is round all the same. */
static void
what_shows_no_outline_is_round (void)
{
  Picture p = picture (200, 200);

  put_disc (&p, (Disc) { 100, 100, 60 }, 3, 1);
  for (int k = 0; k < 12; k++)
    put_disc (&p, (Disc) { 100 + 62 * cos (k * CELD_PI / 6), 100 + 62 * sin (k * CELD_PI / 6), 26 }, 3, 2 + (float) k);
  make (&p, 1);
  NEAR (angle (&p, 100, 100, 0, 0, 1), 0, 6);
  CHECK (CELD_XYZ (&p.normals, 124, 100)[0] > 0.15f && CELD_XYZ (&p.normals, 76, 100)[0] < -0.15f);
  CHECK (CELD_XYZ (&p.normals, 100, 76)[1] > 0.15f && CELD_XYZ (&p.normals, 100, 124)[1] < -0.15f);
  picture_free (&p);
}

int
main (void)
{
  RUN (what_is_in_front_leaves_no_trace);
  RUN (what_is_half_hidden_has_the_normals_of_the_whole);
  RUN (what_is_half_hidden_is_nearly_as_round_as_the_whole);
  RUN (pieces_of_a_sheet_are_one_surface);
  RUN (what_shows_no_outline_is_round);
  return DONE;
}
