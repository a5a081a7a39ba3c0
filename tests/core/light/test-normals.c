/* Normals: a disc is a hemisphere, only the nearer side bends, bulge, bevel, strokes inside parts, hints, bad input.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "base/base.h"

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

/* n_x and n_y of a disc with a round hole: harmonic, those of the outline on the disc's edge, without slope across the
 * hole's.  Gauss-Seidel with over-relaxation on the pixels, two planes of `side` x `side`. */
static double *
solve_disc_with_hole (int side, Disc disc, Disc hole)
{
  double *plane = calloc ((size_t) (2 * side * side), sizeof *plane);

  for (int pass = 0; pass <= 600; pass++)
    for (int y = 1; y < side - 1; y++)
      for (int x = 1; x < side - 1; x++)
        {
          double  u = x + 0.5 - disc.x, v = disc.y - y - 0.5, r = hypot (u, v);
          double *at = plane + 2 * (y * side + x);

          if (r >= disc.radius)
            {
              at[0] = u / r;
              at[1] = v / r;
            }
          else if (hypot (x + 0.5 - hole.x, y + 0.5 - hole.y) >= hole.radius)
            for (int c = 0; c < 2; c++)
              {
                double sum = 0, n = 0;

                for (int k = 0; k < 4; k++)
                  {
                    int dx = k < 2 ? 2 * k - 1 : 0, dy = k < 2 ? 0 : 2 * k - 5;

                    if (hypot (x + dx + 0.5 - hole.x, y + dy + 0.5 - hole.y) < hole.radius)
                      continue;
                    sum += at[2 * (dy * side + dx) + c];
                    n++;
                  }
                at[c] += 1.95 * (sum / n - at[c]);
              }
        }
  return plane;
}

/* A small disc in front of a large one: the large one does not bend along it, but goes on as if cut out. */
static void
only_the_nearer_side_bends (void)
{
  enum { SIDE = 180 };
  Disc    large = { 90, 90, 80 }, small = { 120, 90, 30 };
  Picture p = picture (SIDE, SIDE);
  double *wanted = solve_disc_with_hole (SIDE, large, small), largest, sum = 0, count = 0, worst = 0;

  put_disc (&p, large, 3, 1);
  put_disc (&p, small, 3, 2);
  make (&p, 1);
  NEAR (compare_disc (&p, small, &largest), 0, 1.5);
  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      {
        const double *n = wanted + 2 * (y * SIDE + x);
        double        from_edge = large.radius - hypot (x + 0.5 - large.x, y + 0.5 - large.y);
        double        from_hole = hypot (x + 0.5 - small.x, y + 0.5 - small.y) - small.radius;

        if (from_edge > 4 && from_hole > 4)
          {
            double a = angle (&p, x, y, n[0], n[1], sqrt (fmax (0, 1 - n[0] * n[0] - n[1] * n[1])));

            worst = fmax (worst, a);
            sum += a;
            count++;
          }
      }
  NEAR (sum / count, 0, 0.5);
  NEAR (worst, 0, 2);
  free (wanted);
  picture_free (&p);
}

/* Along a border the normal of the farther side does not change across it; that of the nearer side does. */
static void
the_farther_side_runs_under (void)
{
  Disc    large = { 150, 150, 140 }, small = { 190, 150, 50 };
  Picture p = picture (300, 300);
  double  far = 0, near = 0;
  int     n = 0;

  put_disc (&p, large, 3, 1);
  put_disc (&p, small, 3, 2);
  make (&p, 1);
  for (double turn = 0; turn < 6.28; turn += 0.05, n++)
    {
      double       c = cos (turn), s = sin (turn);
      const float *at[4];

      for (int k = 0; k < 4; k++) /* 1 and 6 pixels outside, 1 and 6 inside */
        {
          double r = small.radius + (k < 2 ? 1 + 5 * k : -1 - 5 * (k - 2));

          at[k] = CELD_XYZ (&p.normals, (int) (small.x + r * c), (int) (small.y + r * s));
        }
      far += fabs ((double) (at[1][0] - at[0][0]) * c - (double) (at[1][1] - at[0][1]) * s) / 5;
      near += fabs ((double) (at[3][0] - at[2][0]) * c - (double) (at[3][1] - at[2][1]) * s) / 5;
      CHECK (at[0][2] > 0.3f && at[2][2] < 0.35f);
    }
  CHECK (near / n > 0.015); /* 1 / radius, and of n_z more */
  CHECK (far / n < 0.0025);
  picture_free (&p);
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

/* A contour is closed or not, wherever it lies and however wide the picture is: cut ends are looked for in words of
 * 64 pixels. */
static void
places_do_not_matter (void)
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
        make (&p, 1);
        for (int y = 0; y < 52; y++)
          for (int x = width - 52; x < width; x++)
            sum += (double) CELD_XYZ (&p.normals, x, y)[2];
        wanted[gap] = width == 60 ? sum : wanted[gap];
        NEAR (sum, wanted[gap], 0.002 * wanted[gap]);
        picture_free (&p);
      }
  CHECK (wanted[1] - wanted[0] > 20);
}

/* ------------------------------------------------------------------ strokes inside a part */

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
quilting_folds_both_sides (void)
{
  Picture      p = disc_with_stroke ();
  CeldSettings settings = celd_settings ();
  double       fold[2];

  make (&p, 1);
  folds (&p, fold);
  NEAR (fold[0], 0, 0.03);
  for (int half = 1; half < 3; half++)
    {
      settings.quilt = 0.4f * (float) half;
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
the_side_that_is_higher_folds (void)
{
  Picture      p = disc_with_stroke ();
  CeldPlane    depth = { 200, 160, 200, malloc (200 * 160 * sizeof (float)) };
  CeldSettings settings = celd_settings ();
  double       fold[2];

  settings.quilt = 1;
  for (int right = 0; right < 2; right++)
    {
      for (int i = 0; i < 200 * 160; i++)
        depth.data[i] = (i % 200 >= 80) == right ? 0.6f : 0.4f;
      CHECK (celd_normals_hinted (&p.ink, &p.levels, &depth, NULL, &settings, NULL, &p.normals) == CELD_OK);
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
hints_say_which_side_folds (void)
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
      CHECK (celd_normals_hinted (&p.ink, &p.levels, NULL, &hints, &settings, NULL, &p.normals) == CELD_OK);
      folds (&p, fold);
      for (int side = 0; side < 2; side++)
        CHECK ((fold[side] > 0.8) == cases[i].folds[side] && (fold[side] < 0.2) == !cases[i].folds[side]);
    }
  free (hints.data);
  picture_free (&p);
}

/* Of an outline, too: the paper bends where it is painted white, the disc does not where it is painted black. */
static void
hints_turn_outlines_over (void)
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
  CHECK (celd_normals_hinted (&p.ink, &p.levels, NULL, &hints, &settings, NULL, &p.normals) == CELD_OK);
  CHECK (CELD_XYZ (&p.normals, 20, 60)[0] < -0.9f);  /* left: as ever */
  CHECK (CELD_XYZ (&p.normals, 98, 60)[2] > 0.9f);   /* right: the disc runs under */
  CHECK (CELD_XYZ (&p.normals, 101, 60)[0] < -0.8f); /* the paper falls towards it */
  free (hints.data);
  picture_free (&p);
}

static void
the_frame_may_be_an_outline (void)
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

static void
bad_input_does_no_harm (void)
{
  Picture      p = picture (7, 5), one = picture (1, 1), row = picture (40, 1);
  CeldPlane    narrow = { 6, 5, 7, p.ink.data }, levels = { 6, 5, 7, p.levels.data };
  CeldVectors  normals = { 6, 5, 7, p.normals.data };
  CeldSettings settings = celd_settings ();

  CHECK (celd_normals (&p.ink, &one.levels, &settings, NULL, &p.normals) == CELD_BAD_SIZE);
  CHECK (celd_normals_hinted (&p.ink, &p.levels, &one.ink, NULL, &settings, NULL, &p.normals) == CELD_BAD_SIZE);
  CHECK (celd_normals_hinted (&p.ink, &p.levels, NULL, &(CeldPaint) { 7, 5, 7, NULL }, &settings, NULL, &p.normals) ==
         CELD_BAD_SIZE);
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
  settings.quilt         = 1;
  settings.bevel         = 0.5f;
  settings.frame_outline = true;
  for (int i = 0; i < 35; i++)
    p.ink.data[i] = i % 3 ? NAN : (float) (i % 2);
  CHECK (celd_normals_hinted (&narrow, &levels, &levels, NULL, &settings, NULL, &normals) == CELD_OK);
  for (int i = 0; i < 30; i++)
    CHECK (CELD_XYZ (&normals, i % 6, i / 6)[2] >= 0);
  memset (p.ink.data, 0, 35 * sizeof (float)); /* no paper */
  CHECK (celd_normals (&narrow, &levels, &settings, NULL, &normals) == CELD_OK);
  settings.quilt = NAN;
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
  RUN (outlines_point_the_right_way);
  RUN (all_normals_have_unit_length);
  RUN (only_the_nearer_side_bends);
  RUN (the_farther_side_runs_under);
  RUN (a_virtual_border_neither_cuts_nor_bends);
  RUN (paper_stays_flat_behind_a_gap);
  RUN (places_do_not_matter);
  RUN (bulge_scales_the_slope);
  RUN (a_bevel_leaves_the_middle_flat);
  RUN (quilting_folds_both_sides);
  RUN (the_side_that_is_higher_folds);
  RUN (hints_say_which_side_folds);
  RUN (hints_turn_outlines_over);
  RUN (the_frame_may_be_an_outline);
  RUN (bad_input_does_no_harm);
  return DONE;
}
