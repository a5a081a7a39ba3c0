/* Coverage inside directed edges, compared with areas known from geometry.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "layers/layers.h"

#define SIDE 24

static CeldCoverage
cover_of (int n, const double (*corner)[2])
{
  CeldCoverage cover;

  CHECK (celd_coverage_new ((CeldRect) { -2, 3, SIDE, SIDE }, &cover) == CELD_OK);
  for (int i = 0; i < n; i++)
    celd_coverage_edge (&cover, corner[i][0], corner[i][1], corner[(i + 1) % n][0], corner[(i + 1) % n][1]);
  celd_coverage_finish (&cover);
  return cover;
}

static double
at (const CeldCoverage *cover, int x, int y)
{
  return (double) cover->sum[(y - cover->box.y) * SIDE + x - cover->box.x];
}

static void
a_box_covers_its_pixels (void)
{
  const double corner[4][2] = { { 1.5, 5 }, { 6, 5 }, { 6, 8.25 }, { 1.5, 8.25 } };
  CeldCoverage cover = cover_of (4, corner);

  for (int y = 3; y < 3 + SIDE; y++)
    for (int x = -2; x < -2 + SIDE; x++)
      NEAR (at (&cover, x, y),
            fmax (fmin (x + 1, 6) - fmax (x, 1.5), 0) * fmax (fmin (y + 1, 8.25) - fmax (y, 5), 0), 1e-6);
  celd_free (cover.sum);
}

static void
a_triangle_halves_the_pixels_of_its_slope (void)
{
  const double corner[3][2] = { { 0, 4 }, { 10, 14 }, { 0, 14 } };
  CeldCoverage cover = cover_of (3, corner);

  for (int i = 0; i < 10; i++)
    {
      NEAR (at (&cover, i, 4 + i), 0.5, 1e-6);
      NEAR (at (&cover, i, 5 + i), i < 9 ? 1 : 0, 1e-6);
      NEAR (at (&cover, i + 1, 4 + i), 0, 1e-6);
    }
  celd_free (cover.sum);
}

static void
what_is_outside_the_picture_is_cut_off (void)
{
  const double corner[4][2] = { { -50, -50 }, { 10, -50 }, { 10, 90 }, { -50, 90 } };
  CeldCoverage cover = cover_of (4, corner);

  for (int y = 3; y < 3 + SIDE; y++)
    for (int x = -2; x < -2 + SIDE; x++)
      NEAR (at (&cover, x, y), x < 10, 1e-5);
  celd_free (cover.sum);
}

static void
holes_are_empty_and_overlaps_count_once (void)
{
  CeldCoverage cover;
  double       box[3][3] = { { 0, 20, 1 }, { 5, 9, -1 }, { 12, 25, 1 } }; /* from, to, the way round */

  CHECK (celd_coverage_new ((CeldRect) { 0, 0, 30, 30 }, &cover) == CELD_OK);
  for (int i = 0; i < 3; i++)
    {
      double a = box[i][0], b = box[i][1], c = box[i][2] > 0 ? b : a, d = box[i][2] > 0 ? a : b;

      celd_coverage_edge (&cover, a, a, c, d);
      celd_coverage_edge (&cover, c, d, b, b);
      celd_coverage_edge (&cover, b, b, d, c);
      celd_coverage_edge (&cover, d, c, a, a);
    }
  celd_coverage_finish (&cover);
  NEAR (cover.sum[30 * 2 + 2], 1, 1e-6);
  NEAR (cover.sum[30 * 6 + 6], 0, 1e-6);
  NEAR (cover.sum[30 * 15 + 15], 1, 1e-6);
  NEAR (cover.sum[30 * 23 + 23], 1, 1e-6);
  NEAR (cover.sum[30 * 23 + 3], 0, 1e-6);
  celd_free (cover.sum);
}

/* The total coverage of a star-shaped polygon equals its area. */
static void
areas_add_up (void)
{
  uint32_t state = 7;

  for (int round = 0; round < 100; round++)
    {
      double       corner[12][2], area = 0, sum = 0;
      CeldCoverage cover;

      for (int i = 0; i < 12; i++)
        {
          double radius = 1 + check_random (&state, 900) / 100.0, angle = i * 3.14159265358979 / 6;

          corner[i][0] = 9.7 + radius * cos (angle);
          corner[i][1] = 14.6 + radius * sin (angle);
        }
      for (int i = 0; i < 12; i++)
        {
          const double *a = corner[i], *b = corner[(i + 1) % 12];

          area += (a[0] * b[1] - b[0] * a[1]) / 2;
        }
      cover = cover_of (12, corner);
      for (int p = 0; p < SIDE * SIDE; p++)
        sum += (double) cover.sum[p];
      NEAR (sum, area, 1e-3);
      celd_free (cover.sum);
    }
}

int
main (void)
{
  RUN (a_box_covers_its_pixels);
  RUN (a_triangle_halves_the_pixels_of_its_slope);
  RUN (what_is_outside_the_picture_is_cut_off);
  RUN (holes_are_empty_and_overlaps_count_once);
  RUN (areas_add_up);
  return DONE;
}
