/* Normals: a disc is a hemisphere, only the nearer side bends, bulge and bad input.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "private.h"

/* Paper with discs of level 1, 2, ... drawn over it one after the other, each in its contour of `width` pixels. */
typedef struct { double x, y, radius; } Disc;

typedef struct { CeldPlane ink, levels; CeldVectors normals; } Picture;

static Picture
picture (int w, int h)
{
  size_t  n = (size_t) w * (size_t) h;
  Picture p = { { w, h, (size_t) w, malloc (n * sizeof (float)) }, { w, h, (size_t) w, calloc (n, sizeof (float)) },
                { w, h, (size_t) w, calloc (n, 3 * sizeof (float)) } };

  for (size_t i = 0; i < n; i++)
    p.ink.data[i] = 1;
  return p;
}

static void
picture_free (Picture *p)
{
  free (p->ink.data);
  free (p->levels.data);
  free (p->normals.data);
}

/* The contour lies inside the radius, and belongs to the disc. */
static void
put_disc (Picture *p, Disc d, double width, float level)
{
  for (int y = 0; y < p->ink.height; y++)
    for (int x = 0; x < p->ink.width; x++)
      {
        double r = hypot (x + 0.5 - d.x, y + 0.5 - d.y) - d.radius;
        size_t i = (size_t) y * p->ink.stride + (size_t) x;

        if (r < 0)
          {
            p->levels.data[i] = level;
            p->ink.data[i]    = (float) fmin (1, fmax (0, -r - width));
          }
        else if (r < 1)
          p->ink.data[i] = fminf (p->ink.data[i], (float) r);
      }
}

static void
make (Picture *p, float bulge)
{
  CeldSettings settings = celd_settings ();

  settings.bulge = bulge;
  CHECK (celd_normals (&p->ink, &p->levels, &settings, NULL, &p->normals) == CELD_OK);
}

/* Angle in degrees between the normal of a pixel and (x,y,z). */
static double
angle (const Picture *p, int px, int py, double x, double y, double z)
{
  const float *n = CELD_XYZ (&p->normals, px, py);

  return acos (fmax (-1, fmin (1, (double) n[0] * x + (double) n[1] * y + (double) n[2] * z))) * 57.29577951;
}

/* Mean and largest angle between the normals of a disc and the hemisphere's, up to 1.5 pixels from its edge. */
static double
compare_disc (const Picture *p, Disc d, double *largest)
{
  double sum = 0, count = 0;

  *largest = 0;
  for (int y = 0; y < p->ink.height; y++)
    for (int x = 0; x < p->ink.width; x++)
      {
        double u = (x + 0.5 - d.x) / d.radius, v = (d.y - y - 0.5) / d.radius, r = hypot (u, v);

        if (r >= 1)
          continue;

        double error = angle (p, x, y, u, v, sqrt (1 - r * r));

        sum += error;
        count++;
        if ((1 - r) * d.radius > 1.5)
          *largest = fmax (*largest, error);
      }
  return sum / count;
}

static void
a_disc_is_a_hemisphere (void)
{
  for (int radius = 20; radius <= 100; radius += 16)
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

static void
outlines_point_the_right_way (void)
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

/* A small disc in front of a large one: the large one does not bend along it. */
static void
only_the_nearer_side_bends (void)
{
  Disc    large = { 90, 90, 80 }, small = { 120, 90, 30 };
  Picture p = picture (180, 180), alone = picture (180, 180);
  double  largest;

  put_disc (&p, large, 3, 1);
  put_disc (&alone, large, 3, 1);
  put_disc (&p, small, 3, 2);
  make (&p, 1);
  make (&alone, 1);
  NEAR (compare_disc (&p, small, &largest), 0, 1.5);
  for (int y = 40; y < 140; y++) /* left of the small disc the large one is nearly what it was */
    {
      const float *n = CELD_XYZ (&alone.normals, 86, y);

      NEAR (angle (&p, 86, y, (double) n[0], (double) n[1], (double) n[2]), 0, 22);
      CHECK (CELD_XYZ (&p.normals, 86, y)[2] > 0.7f);
    }
  picture_free (&p);
  picture_free (&alone);
}

static void
a_virtual_border_neither_cuts_nor_bends (void)
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
  make (&p, 1);
  CHECK (compare_disc (&p, d, &largest) < 10);
  CHECK (angle (&p, 93, 60, 0, 0, 1) < angle (&p, 26, 60, 0, 0, 1) - 30); /* it flattens towards the gap */
  for (int i = 0; i < 120 * 120; i += 7)
    if (hypot (i % 120 - 60, i / 120 - 60) > 44)
      NEAR (angle (&p, i % 120, i / 120, 0, 0, 1), 0, 2);
  picture_free (&p);
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

static void
bad_input_does_no_harm (void)
{
  Picture      p = picture (7, 5), one = picture (1, 1), row = picture (40, 1);
  CeldPlane    narrow = { 6, 5, 7, p.ink.data }, levels = { 6, 5, 7, p.levels.data };
  CeldVectors  normals = { 6, 5, 7, p.normals.data };
  CeldSettings settings = celd_settings ();

  CHECK (celd_normals (&p.ink, &one.levels, &settings, NULL, &p.normals) == CELD_BAD_SIZE);
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
  picture_free (&p);
  picture_free (&one);
  picture_free (&row);
}

int
main (void)
{
  RUN (a_disc_is_a_hemisphere);
  RUN (outlines_point_the_right_way);
  RUN (all_normals_have_unit_length);
  RUN (only_the_nearer_side_bends);
  RUN (a_virtual_border_neither_cuts_nor_bends);
  RUN (paper_stays_flat_behind_a_gap);
  RUN (bulge_scales_the_slope);
  RUN (bad_input_does_no_harm);
  return DONE;
}
