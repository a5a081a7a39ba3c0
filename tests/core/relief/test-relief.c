/* Relief: discs and ellipses become spheres and ellipsoids, smooth where depth is smooth, and the depth order holds.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "celdepth.h"

typedef struct { int width, height; CeldPlane ink, levels; CeldRelief relief; } Picture;

static Picture
picture (int w, int h)
{
  size_t  n = (size_t) w * (size_t) h;
  Picture p = { w, h, { w, h, (size_t) w, malloc (n * sizeof (float)) },
                { w, h, (size_t) w, calloc (n, sizeof (float)) }, { 0 } };

  for (size_t i = 0; i < n; i++)
    p.ink.data[i] = 1;
  return p;
}

static void
picture_free (Picture *p)
{
  free (p->ink.data);
  free (p->levels.data);
  celd_relief_clear (&p->relief);
}

/* An ellipse in front of everything else, with a contour of its own. */
static void
put_ellipse (Picture *p, double x0, double y0, double a, double b, float level)
{
  for (int y = 0; y < p->height; y++)
    for (int x = 0; x < p->width; x++)
      {
        double u = (x + 0.5 - x0) / a, v = (y + 0.5 - y0) / b, r = hypot (u, v), inside = (1 - r) * fmin (a, b);
        size_t i = (size_t) y * (size_t) p->width + (size_t) x;

        if (r < 1)
          {
            p->levels.data[i] = level;
            p->ink.data[i]    = inside < 3 ? 0 : 1;
          }
      }
}

static void
make (Picture *p, const CeldSettings *settings, const CeldPlane *depth)
{
  CHECK (celd_relief (&p->ink, NULL, &p->levels, depth, settings, NULL, &p->relief) == CELD_OK);
}

static double
z_at (const Picture *p, int x, int y)
{
  return (double) p->relief.z[(size_t) y * (size_t) p->width + (size_t) x];
}

/* With a bulge and depth for which heights are known. */
static CeldSettings
known_settings (void)
{
  CeldSettings s = celd_settings ();

  s.relief_bulge = 1;
  s.relief_depth = 0.1f;
  return s;
}

/* Mean difference from the ellipsoid of inflation, and the difference of the tops, relative to its height, which is
 * `top` for bulge 1. */
static void
compare_ellipsoid (const Picture *p, double x0, double y0, double a, double b, double base, double bulge, double mean,
                   double tops)
{
  double top = bulge * sqrt (2 * a * a * b * b / (a * a + b * b)), sum = 0, n = 0, highest = 0;

  for (int y = 0; y < p->height; y++)
    for (int x = 0; x < p->width; x++)
      {
        double u = (x + 0.5 - x0) / a, v = (y + 0.5 - y0) / b, r = u * u + v * v, z = z_at (p, x, y) - base;

        if (r >= 1)
          continue;
        sum    += fabs (z - top * sqrt (1 - r));
        n      += 1;
        highest = fmax (highest, z);
      }
  NEAR (sum / n / top, 0, mean);
  NEAR (highest / top, 1, tops);
}

/* ------------------------------------------------------------------ known shapes */

static void
a_disc_is_a_sphere (void)
{
  static const double radius[] = { 20, 27.3, 40, 91.7, 200, 400 };

  for (int i = 0; i < 6; i++)
    for (int k = 0; k < 3; k++)
      {
        double       r = radius[i], x = r + 8 + 0.37 * k, y = r + 9 + 0.21 * k;
        Picture      p = picture ((int) (2 * r) + 18, (int) (2 * r) + 18);
        CeldSettings s = known_settings ();

        if (r > 100 && k)
          {
            picture_free (&p);
            continue;
          }
        s.relief_bulge = k == 1 ? 0.5f : 1.f;
        put_ellipse (&p, x, y, r, r, 1);
        make (&p, &s, NULL);
        compare_ellipsoid (&p, x, y, r, r, 0.1 * hypot (p.width, p.height), (double) s.relief_bulge, 0.015, 0.015);
        NEAR (z_at (&p, 0, 0), 0, 1e-3); /* the paper stays flat */
        picture_free (&p);
      }
}

static void
an_ellipse_is_an_ellipsoid (void)
{
  for (int k = 0; k < 4; k++)
    {
      double       a = 40 + 30 * k, b = 70 - 14 * k, x = a + 8.3, y = b + 9.1;
      Picture      p = picture ((int) (2 * a) + 18, (int) (2 * b) + 18);
      CeldSettings s = known_settings ();

      put_ellipse (&p, x, y, a, b, 1);
      make (&p, &s, NULL);
      compare_ellipsoid (&p, x, y, a, b, 0.1 * hypot (p.width, p.height), 1, 0.015, 0.015);
      picture_free (&p);
    }
}

/* From normals, whose slopes have to end at the outline. */
static void
normals_make_a_sphere_too (void)
{
  for (int r = 24; r <= 96; r *= 2)
    {
      Picture      p = picture (2 * r + 18, 2 * r + 18);
      CeldSettings s = known_settings ();

      s.relief_from = CELD_RELIEF_NORMALS;
      put_ellipse (&p, r + 8.5, r + 8.5, r, r, 1);
      make (&p, &s, NULL);
      compare_ellipsoid (&p, r + 8.5, r + 8.5, r, r, 0.1 * hypot (p.width, p.height), 1, 0.06, 0.06);
      picture_free (&p);
    }
}

static void
without_bulge_there_are_the_steps_of_depth (void)
{
  Picture      p = picture (120, 90);
  CeldSettings s = known_settings ();

  s.relief_bulge = 0;
  s.relief_depth = 0.2f;
  put_ellipse (&p, 50, 45, 40, 30, 0.5f);
  put_ellipse (&p, 70, 45, 20, 20, 1);
  make (&p, &s, &p.levels);
  for (int i = 0; i < 120 * 90; i++)
    NEAR (p.relief.z[i], 0.2 * 150 * (double) p.levels.data[i], 1e-3);
  picture_free (&p);
}

/* Levels 0, 1, 2 are the same as 0, 1/2, 1. */
static void
ranks_are_as_good_as_levels (void)
{
  Picture      p = picture (160, 100), q = picture (160, 100);
  CeldSettings s = known_settings ();

  put_ellipse (&p, 60, 50, 40, 30, 0.5f);
  put_ellipse (&p, 90, 50, 30, 25, 1);
  put_ellipse (&q, 60, 50, 40, 30, 1);
  put_ellipse (&q, 90, 50, 30, 25, 2);
  make (&p, &s, NULL);
  make (&q, &s, NULL);
  for (int i = 0; i < 160 * 100; i++)
    NEAR (p.relief.z[i], q.relief.z[i], 0.05);
  picture_free (&p);
  picture_free (&q);
}

/* ------------------------------------------------------------------ boundaries */

/* A pillow of two levels, with ink between them above y = 60 only. */
static Picture
half_parted (void)
{
  Picture p = picture (160, 120);

  put_ellipse (&p, 80, 60, 70, 50, 1);
  for (int y = 0; y < 120; y++)
    for (int x = 80; x < 160; x++)
      if (p.levels.data[y * 160 + x] > 0)
        p.levels.data[y * 160 + x] = 2;
  for (int y = 0; y < 60; y++)
    for (int x = 78; x < 81; x++)
      p.ink.data[y * 160 + x] = 0;
  return p;
}

static void
there_is_no_seam_where_depth_goes_on (void)
{
  Picture      p = half_parted ();
  CeldSettings s = known_settings ();

  make (&p, &s, NULL);
  for (int y = 70; y < 100; y++)
    {
      double before = z_at (&p, 79, y) - z_at (&p, 78, y), across = z_at (&p, 80, y) - z_at (&p, 79, y);
      double behind = z_at (&p, 81, y) - z_at (&p, 80, y);

      CHECK (!(p.relief.cut[y * 160 + 79] & CELD_CUT_RIGHT));
      NEAR (across, (before + behind) / 2, 0.02); /* the slope on both sides is 0.3 to 0.6 */
    }
  for (int y = 20; y < 50; y++)
    {
      CHECK (p.relief.cut[y * 160 + 79] & CELD_CUT_RIGHT);
      CHECK (!(p.relief.cut[y * 160 + 79] & CELD_NEAR_RIGHT)); /* the right side is in front */
      CHECK (z_at (&p, 80, y) > z_at (&p, 79, y) + 1);
    }
  picture_free (&p);
}

/* The farther side continues behind the nearer one: inflated, but without a slope across the boundary. */
static void
only_the_nearer_side_bends (void)
{
  Picture      p = picture (200, 120);
  CeldSettings s = known_settings ();

  put_ellipse (&p, 80, 60, 70, 50, 1);
  for (int y = 0; y < 120; y++) /* a wall before the right half of it */
    for (int x = 80; x < 200; x++)
      {
        p.levels.data[y * 200 + x] = 2;
        p.ink.data[y * 200 + x]    = x < 83 ? 0 : 1;
      }
  s.relief_depth = 1;
  make (&p, &s, &p.levels);
  for (int y = 40; y < 80; y++)
    {
      NEAR (z_at (&p, 79, y) - z_at (&p, 78, y), 0, 0.05);
      CHECK (z_at (&p, 81, y) - z_at (&p, 80, y) > 0.5);
    }
  picture_free (&p);
}

/* How far the nearer side of a cut is behind the other at worst, in pixels. */
static double
worst_order (const Picture *p)
{
  size_t w = (size_t) p->width;
  double worst = 0;

  for (size_t i = 0; i < w * (size_t) p->height; i++)
    for (int down = 0; down < 2; down++)
      {
        uint8_t cut = p->relief.cut[i] & (down ? CELD_CUT_BELOW : CELD_CUT_RIGHT);
        uint8_t near = p->relief.cut[i] & (down ? CELD_NEAR_BELOW : CELD_NEAR_RIGHT);
        size_t  j = i + (down ? w : 1);

        if (!cut)
          continue;
        CHECK ((near != 0) == (p->levels.data[i] > p->levels.data[j]));
        worst = fmax (worst, (double) (near ? p->relief.z[j] - p->relief.z[i] : p->relief.z[i] - p->relief.z[j]));
      }
  return worst;
}

static void
what_is_nearer_stays_in_front (void)
{
  uint32_t seed = 3;

  for (int round = 0; round < 12; round++)
    {
      Picture      p = picture (220, 160);
      CeldSettings s = known_settings ();

      for (int k = 1; k <= 7; k++)
        put_ellipse (&p, check_random (&seed, 220), check_random (&seed, 160), 12 + check_random (&seed, 60),
                     12 + check_random (&seed, 60), (float) k);
      s.relief_depth = round % 2 ? 0.1f : 0.05f;
      make (&p, &s, NULL);
      NEAR (worst_order (&p), 0, 0.5);
      picture_free (&p);
    }
}

/* Where nothing intersects, nothing is shifted. */
static void
what_is_out_of_the_way_keeps_its_place (void)
{
  Picture      p = picture (240, 120);
  CeldSettings s = known_settings ();

  put_ellipse (&p, 60, 60, 50, 50, 0.5f);
  put_ellipse (&p, 180, 60, 50, 50, 1);
  make (&p, &s, NULL);
  compare_ellipsoid (&p, 60, 60, 50, 50, 0.05 * hypot (240, 120), 1, 0.015, 0.015);
  compare_ellipsoid (&p, 180, 60, 50, 50, 0.1 * hypot (240, 120), 1, 0.015, 0.015);
  picture_free (&p);
}

/* ------------------------------------------------------------------ hosts and bad input */

static void
nan_does_no_harm (void)
{
  uint32_t seed = 11;

  for (int from = 0; from < 2; from++)
    {
      Picture      p = half_parted ();
      CeldSettings s = known_settings ();

      s.relief_from = (CeldReliefFrom) from;
      for (int k = 0; k < 400; k++)
        {
          static const float odd[4] = { NAN, INFINITY, -INFINITY, -3 };

          p.levels.data[check_random (&seed, 160 * 120)] = odd[k % 4];
          p.ink.data[check_random (&seed, 160 * 120)]    = odd[k % 4];
        }
      make (&p, &s, NULL);
      for (int i = 0; i < 160 * 120; i++)
        CHECK (isfinite (p.relief.z[i]) && isfinite (p.relief.outline[i]));
      picture_free (&p);
    }
}

/* Depth that is finite makes heights that are, and a mesh of them, however large it is. */
static void
huge_depth_stays_finite (void)
{
  static const float huge[] = { 1e10f, 1e20f, -1e30f, 3.4e38f, -3.4e38f };

  for (size_t k = 0; k < 4 * sizeof huge / sizeof *huge; k++)
    {
      Picture        p = picture (40, 30), depth = picture (40, 30);
      CeldSettings   s = known_settings ();
      CeldReliefMesh mesh = { 0 };
      float          value = huge[k / 4];

      s.relief_from = k % 2 ? CELD_RELIEF_NORMALS : CELD_RELIEF_INFLATION;
      s.relief_depth = 1;
      put_ellipse (&p, 20, 15, 12, 9, k % 4 < 2 ? 1 : value);
      put_ellipse (&depth, 20, 15, 12, 9, value);
      make (&p, &s, &depth.levels);
      for (int i = 0; i < 40 * 30; i++)
        CHECK (fabsf (p.relief.z[i]) <= CELD_MOST_HEIGHT && fabsf (p.relief.outline[i]) <= CELD_MOST_HEIGHT);
      CHECK (celd_relief_mesh (&p.relief, &s, NULL, &mesh) == CELD_OK);
      for (size_t i = 0; i < 3 * mesh.vertices; i++)
        CHECK (isfinite (mesh.place[i]) && isfinite (mesh.normal[i]));
      celd_relief_mesh_clear (&mesh);
      picture_free (&p);
      picture_free (&depth);
    }
}

static void
one_pixel_will_do (void)
{
  float        level = 3, ink = 0;
  CeldPlane    levels = { 1, 1, 1, &level }, drawing = { 1, 1, 1, &ink };
  CeldSettings s = known_settings ();
  CeldRelief   relief = { 0 };

  CHECK (celd_relief (&drawing, NULL, &levels, NULL, &s, NULL, &relief) == CELD_OK);
  CHECK (relief.cut[0] == 0);
  celd_relief_clear (&relief);
}

static void
hosts_can_cancel_and_bad_input_is_refused (void)
{
  Picture      p = half_parted ();
  CeldPlane    small = { 159, 120, 160, p.levels.data };
  CeldHost     host = { check_refuse, NULL, NULL };
  CeldSettings s = known_settings ();

  CHECK (celd_relief (&p.ink, NULL, &p.levels, NULL, &s, &host, &p.relief) == CELD_CANCELLED);
  CHECK (celd_relief (&p.ink, NULL, &small, NULL, &s, NULL, &p.relief) == CELD_BAD_SIZE);
  CHECK (celd_relief (&p.ink, NULL, &p.levels, &small, &s, NULL, &p.relief) == CELD_BAD_SIZE);
  s.relief_depth = -1;
  CHECK (celd_relief (&p.ink, NULL, &p.levels, NULL, &s, NULL, &p.relief) == CELD_BAD_VALUE);
  CHECK (!p.relief.z);
  picture_free (&p);
}

/* ------------------------------------------------------------------ gaps */

/* The difference of height between both sides of a line where it is broken for 12 pixels; `bordered`: only in the ink
 * for depth. */
static double
step_at_gap (bool hold, bool bordered)
{
  Picture      p = picture (120, 120), whole = picture (120, 120);
  CeldSettings s = known_settings ();
  double       step;

  s.relief_bulge = 0;
  s.hold_gaps    = hold;
  for (int i = 0; i < 120 * 120; i++)
    {
      int x = i % 120, y = i / 120;

      p.levels.data[i]   = x >= 60;
      whole.ink.data[i]  = x < 59 || x > 61;
      p.ink.data[i]      = whole.ink.data[i] > 0 || (y >= 54 && y < 66);
    }
  CHECK (celd_relief (&p.ink, bordered ? &whole.ink : NULL, &p.levels, NULL, &s, NULL, &p.relief) == CELD_OK);
  CHECK (!(p.relief.cut[60 * 120 + 59] & CELD_CUT_RIGHT) == !(hold && !bordered));
  step = z_at (&p, 60, 60) - z_at (&p, 59, 60);
  picture_free (&p);
  picture_free (&whole);
  return step;
}

static void
a_gap_that_holds_is_cut (void)
{
  double whole = 0.1 * hypot (120, 120);

  NEAR (step_at_gap (true, false), whole, 1e-3 * whole);
  CHECK (step_at_gap (false, false) < 0.5 * whole);
  CHECK (step_at_gap (true, true) < 0.5 * whole);
}

int
main (void)
{
  RUN (a_disc_is_a_sphere);
  RUN (an_ellipse_is_an_ellipsoid);
  RUN (normals_make_a_sphere_too);
  RUN (without_bulge_there_are_the_steps_of_depth);
  RUN (ranks_are_as_good_as_levels);
  RUN (there_is_no_seam_where_depth_goes_on);
  RUN (only_the_nearer_side_bends);
  RUN (what_is_nearer_stays_in_front);
  RUN (what_is_out_of_the_way_keeps_its_place);
  RUN (a_gap_that_holds_is_cut);
  RUN (nan_does_no_harm);
  RUN (huge_depth_stays_finite);
  RUN (one_pixel_will_do);
  RUN (hosts_can_cancel_and_bad_input_is_refused);
  return DONE;
}
