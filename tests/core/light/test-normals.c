/* Normals: a disc is a hemisphere, an ellipse an ellipsoid; bulge, bevel, bad input.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "discs.h"

static void
a_disc_is_a_hemisphere (void)
{
  for (int radius = 20; radius <= 400; radius += radius < 100 ? 16 : 144)
    {
      Disc    d = { radius + 12.3, radius + 11.6, radius };
      Picture p = picture (2 * radius + 24, 2 * radius + 24);
      double  largest;

      put_disc (&p, d, 3, 1);
      make (&p, 1);
      NEAR (compare_disc (&p, d, &largest), 0, 1.5);
      NEAR (largest, 0, 6);
      NEAR (angle (&p, 1, 1, 0, 0, 1), 0, 0); /* the paper behind stays flat */
      picture_free (&p);
    }
}

/* With the harmonic mean of the half axes a and b as the third one; farther from round Lumo's surface is another. */
static void
an_ellipse_is_an_ellipsoid (void)
{
  for (double b = 25; b <= 200; b *= 2)
    for (double ratio = 1.2; ratio < 1.5; ratio += 0.2)
      {
        double  a = ratio * b, c = 2 * a * b / (a + b), cx = a + 10.4, cy = b + 10.7, sum = 0, count = 0;
        Picture p = picture ((int) (2 * a) + 20, (int) (2 * b) + 20);

        for (int y = 0; y < p.ink.height; y++)
          for (int x = 0; x < p.ink.width; x++)
            {
              double u = (x + 0.5 - cx) / a, v = (y + 0.5 - cy) / b, r = hypot (u, v);
              double edge = r > 0 ? (r - 1) * r / hypot (u / a, v / b) : -b; /* pixels, nearly */

              CELD_AT (&p.levels, x, y) = edge < 0;
              CELD_AT (&p.ink, x, y)    = (float) fmin (1, fmax (0, fmax (edge, -edge - 3)));
            }
        make (&p, 1);
        for (int y = 0; y < p.ink.height; y++)
          for (int x = 0; x < p.ink.width; x++)
            {
              double u = (x + 0.5 - cx) / a, v = (cy - y - 0.5) / b, r = u * u + v * v, nx, ny, nz, length;

              if (r >= 1)
                continue;
              nx     = u / a;
              ny     = v / b;
              nz     = sqrt (1 - r) / c;
              length = sqrt (nx * nx + ny * ny + nz * nz);
              sum += angle (&p, x, y, nx / length, ny / length, nz / length);
              count++;
            }
        NEAR (sum / count, 0, 2);
        picture_free (&p);
      }
}

static void
normals_of_outlines_point_outward_with_y_up (void)
{
  Disc    d = { 40, 40, 30 };
  Picture p = picture (80, 80);

  put_disc (&p, d, 3, 1);
  make (&p, 1);
  CHECK (CELD_XYZ (&p.normals, 67, 40)[0] > 0.9f);  /* right */
  CHECK (CELD_XYZ (&p.normals, 12, 40)[0] < -0.9f);
  CHECK (CELD_XYZ (&p.normals, 40, 12)[1] > 0.9f);  /* top: y is up */
  CHECK (CELD_XYZ (&p.normals, 40, 67)[1] < -0.9f);
  picture_free (&p);
}

static void
all_normals_have_unit_length (void)
{
  for (int bulge = 0; bulge <= 4; bulge++)
    {
      Picture p = picture (90, 70);

      put_disc (&p, (Disc) { 30, 30, 25 }, 3, 1);
      put_disc (&p, (Disc) { 50, 40, 20 }, 2, 2);
      make (&p, (float) bulge);
      for (int i = 0; i < 90 * 70; i++)
        {
          const float *n = p.normals.data + 3 * i;

          NEAR (n[0] * n[0] + n[1] * n[1] + n[2] * n[2], 1, 1e-5);
          CHECK (n[2] >= 0);
        }
      picture_free (&p);
    }
}

static void
bulge_scales_the_slope (void)
{
  Picture p = picture (100, 100);
  float   slope[3];

  put_disc (&p, (Disc) { 50, 50, 40 }, 3, 1);
  for (int i = 0; i < 3; i++)
    {
      make (&p, (float) i);
      slope[i] = CELD_XYZ (&p.normals, 70, 50)[0] / CELD_XYZ (&p.normals, 70, 50)[2];
    }
  NEAR (slope[0], 0, 0);
  CHECK (slope[1] > 0.4f);
  NEAR (slope[2], 2 * slope[1], 1e-3);
  picture_free (&p);
}

/* The slope goes on to a bevel's width from the outline, and ends there. */
static void
a_bevel_leaves_the_middle_flat (void)
{
  Picture      p = picture (200, 200);
  Disc         disc = { 100, 100, 80 };
  CeldSettings settings = celd_settings ();

  put_disc (&p, disc, 3, 1);
  put_disc (&p, (Disc) { 100, 40, 12 }, 3, 2); /* in front: no outline of the large one */
  settings.bevel = (float) (20 / hypot (200, 200));
  CHECK (celd_normals (&p.ink, &p.levels, &settings, NULL, &p.normals) == CELD_OK);
  for (int y = 0; y < 200; y++)
    for (int x = 0; x < 200; x++)
      {
        double from = disc.radius - hypot (x + 0.5 - disc.x, y + 0.5 - disc.y);

        if (from > 21 && hypot (x + 0.5 - 100, y + 0.5 - 40) > 12)
          NEAR (angle (&p, x, y, 0, 0, 1), 0, 0.01);
        if (from > 0 && from < 2)
          CHECK (CELD_XYZ (&p.normals, x, y)[2] < 0.35f);
        if (from > 9 && from < 11 && y > 100)
          CHECK (CELD_XYZ (&p.normals, x, y)[2] < 0.98f);
      }
  picture_free (&p);
}

static void
bad_input_is_refused_or_read_as_flat (void)
{
  Picture      p = picture (7, 5), one = picture (1, 1), row = picture (40, 1);
  CeldPlane    narrow = { 6, 5, 7, p.ink.data }, levels = { 6, 5, 7, p.levels.data };
  CeldVectors  normals = { 6, 5, 7, p.normals.data };
  CeldSettings settings = celd_settings ();

  CHECK (celd_normals (&p.ink, &one.levels, &settings, NULL, &p.normals) == CELD_BAD_SIZE);
  CHECK (celd_normals_hinted (&p.ink, NULL, &p.levels, &one.ink, NULL, &settings, NULL, &p.normals) == CELD_BAD_SIZE);
  CHECK (celd_normals_hinted (&p.ink, NULL, &p.levels, NULL, &(CeldPaint) { 7, 5, 7, NULL }, &settings, NULL,
                              &p.normals) == CELD_BAD_SIZE);
  make (&one, 1);
  NEAR (one.normals.data[2], 1, 0);
  for (int x = 10; x < 30; x++)
    {
      row.levels.data[x] = 1;
      row.ink.data[x]    = x < 12 || x >= 28 ? 0 : 1;
    }
  make (&row, 1);
  CHECK (row.normals.data[3 * 29] > 0.9f && row.normals.data[3 * 10] < -0.9f);
  p.ink.data[3]    = NAN;
  p.levels.data[9] = NAN;
  for (int y = 0; y < 5; y++)
    p.ink.data[7 * y + 6] = p.levels.data[7 * y + 6] = p.normals.data[3 * (7 * y + 6)] = NAN;
  CHECK (celd_normals (&narrow, &levels, &settings, NULL, &normals) == CELD_OK);
  for (int i = 0; i < 30; i++)
    NEAR (CELD_XYZ (&normals, i % 6, i / 6)[2], 1, 0);
  CHECK (isnan (p.normals.data[3 * 6])); /* not ours to write */
  settings.creases         = 1;
  settings.bevel         = 0.5f;
  settings.frame_outline = true;
  for (int i = 0; i < 35; i++)
    p.ink.data[i] = i % 3 ? NAN : (float) (i % 2);
  CHECK (celd_normals_hinted (&narrow, NULL, &levels, &levels, NULL, &settings, NULL, &normals) == CELD_OK);
  for (int i = 0; i < 30; i++)
    CHECK (CELD_XYZ (&normals, i % 6, i / 6)[2] >= 0);
  memset (p.ink.data, 0, 35 * sizeof (float)); /* no paper */
  CHECK (celd_normals (&narrow, &levels, &settings, NULL, &normals) == CELD_OK);
  settings.creases = NAN;
  CHECK (celd_normals (&narrow, &levels, &settings, NULL, &normals) == CELD_BAD_VALUE);
  picture_free (&p);
  picture_free (&one);
  picture_free (&row);
}

int
main (void)
{
  RUN (a_disc_is_a_hemisphere);
  RUN (an_ellipse_is_an_ellipsoid);
  RUN (normals_of_outlines_point_outward_with_y_up);
  RUN (all_normals_have_unit_length);
  RUN (bulge_scales_the_slope);
  RUN (a_bevel_leaves_the_middle_flat);
  RUN (bad_input_is_refused_or_read_as_flat);
  return DONE;
}
