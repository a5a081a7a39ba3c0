/* Smooth depth: contours cut, gaps do not, anchors hold, bad input does no harm.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "celdepth.h"

/* A drawn shape: how far (x,y) lies outside its outline, negative inside. */
typedef struct { int kind; double x, y, size, turn; } Shape;

enum { DISC, SQUARE, STAR };

static double
outside (const Shape *s, double x, double y)
{
  double u = cos (s->turn) * (x - s->x) + sin (s->turn) * (y - s->y);
  double v = cos (s->turn) * (y - s->y) - sin (s->turn) * (x - s->x);

  if (s->kind == SQUARE)
    {
      double du = fabs (u) - s->size, dv = fabs (v) - s->size;

      return du > 0 && dv > 0 ? hypot (du, dv) : fmax (du, dv);
    }
  if (s->kind == STAR)
    return (hypot (u, v) - s->size * (1 + 0.15 * sin (5 * atan2 (v, u)))) * 0.85;
  return hypot (u, v) - s->size;
}

static CeldPlane
plane (int w, int h, float value)
{
  CeldPlane p = { w, h, (size_t) w, malloc ((size_t) w * (size_t) h * sizeof (float)) };

  for (int i = 0; i < w * h; i++)
    p.data[i] = value;
  return p;
}

/* The outline as an antialiased line. */
static CeldPlane
draw (const Shape *s, int w, int h, double width)
{
  CeldPlane ink = plane (w, h, 1);

  for (int y = 0; y < h; y++)
    for (int x = 0; x < w; x++)
      {
        int covered = 0;

        for (int k = 0; k < 64; k++)
          covered += fabs (outside (s, x + (k % 8 + 0.5) / 8, y + (double) (2 * (k / 8) + 1) / 16)) < width / 2;
        ink.data[y * w + x] = 1 - (float) covered / 64;
      }
  return ink;
}

/* Level 3 for pixels less than `reach` outside the shape, 1 elsewhere. */
static CeldPlane
fill (const Shape *s, int w, int h, double reach)
{
  CeldPlane levels = plane (w, h, 1);

  for (int y = 0; y < h; y++)
    for (int x = 0; x < w; x++)
      if (outside (s, x + 0.5, y + 0.5) < reach)
        levels.data[y * w + x] = 3;
  return levels;
}

static double
largest_change (const CeldPlane *a, const CeldPlane *b)
{
  double most = 0;

  for (int i = 0; i < a->width * a->height; i++)
    most = fmax (most, fabs ((double) a->data[i] - (double) b->data[i]));
  return most;
}

/* Smooths and returns the largest change as a share of the range of levels, 2. */
static double
leak (const CeldPlane *ink, const CeldPlane *levels, const CeldMask *anchors)
{
  CeldSettings settings = celd_settings ();
  CeldPlane    depth = plane (ink->width, ink->height, -7);
  CeldSolve    how = { 0 };
  double       share;

  CHECK (celd_smooth (ink, NULL, levels, anchors, &settings, NULL, &depth, &how) == CELD_OK);
  CHECK (how.converged);
  share = largest_change (&depth, levels) / 2;
  free (depth.data);
  return share;
}

static void
a_closed_contour_does_not_leak (void)
{
  enum { W = 96, H = 90 };
  uint32_t seed = 1;
  CeldMask anchors = { W, H, W, calloc (W * H, 1) };

  anchors.data[45 * W + 48] = anchors.data[2 * W + 2] = 1;
  for (int round = 0; round < 60; round++)
    {
      double    width = 2 + round % 5;
      Shape     s = { round % 3, 48 + check_random (&seed, 100) / 100., 45 + check_random (&seed, 100) / 100.,
                      26 + check_random (&seed, 100) / 50.,
                      round % 2 ? check_random (&seed, 1000) / 500. : round * 0.7853981634 };
      CeldPlane ink = draw (&s, W, H, width);

      for (int border = -1; border <= 1; border++) /* at the inner edge, in the middle, expanded */
        {
          CeldPlane levels = fill (&s, W, H, border * width / 2);

          NEAR (leak (&ink, &levels, NULL), 0, 1e-4);
          NEAR (leak (&ink, &levels, &anchors), 0, 1e-4);
          free (levels.data);
        }
      free (ink.data);
    }
  free (anchors.data);
}

static void
a_line_thinner_than_a_pixel_does_not_leak (void)
{
  enum { W = 96, H = 90 };
  uint32_t seed = 3;

  for (int round = 0; round < 60; round++)
    {
      double    width = 0.7 + 0.1 * (round % 8);
      Shape     s = { round % 3, 48 + check_random (&seed, 100) / 100., 45 + check_random (&seed, 100) / 100.,
                      26 + check_random (&seed, 100) / 50., check_random (&seed, 1000) / 500. };
      CeldPlane ink = draw (&s, W, H, width);

      for (int border = -1; border <= 1; border++)
        {
          CeldPlane levels = fill (&s, W, H, border * width / 2);

          NEAR (leak (&ink, &levels, NULL), 0, 1e-4);
          free (levels.data);
        }
      free (ink.data);
    }
}

/* Flat grey that spreads on both sides of the outline is no line. */
static void
depth_is_smooth_across_grey (void)
{
  enum { W = 96, H = 90 };
  Shape     s = { DISC, 48, 45, 26, 0 };
  CeldPlane ink = draw (&s, W, H, 16), levels = fill (&s, W, H, 0);

  for (int i = 0; i < W * H; i++)
    ink.data[i] = 1 - 0.3f * (1 - ink.data[i]);
  CHECK (leak (&ink, &levels, NULL) > 0.05);
  free (ink.data);
  free (levels.data);
}

static void
a_hard_line_of_one_pixel_does_not_leak (void)
{
  const char *art[] = { "....................",
                        "......#######.......",
                        ".....#.......#......",
                        "....#.........#.....",
                        "....#..........##...",
                        "...#.............#..",
                        "...#.............#..",
                        "....#...........#...",
                        "....#..........#....",
                        ".....#........#.....",
                        "......#######.#.....",
                        ".............#......",
                        "....................", NULL };
  CeldPlane   ink = art_plane (art);

  for (int own = 0; own < 2; own++) /* does the line belong to the inside? */
    {
      CeldPlane levels = plane (ink.width, ink.height, 1);

      for (int y = 0; y < ink.height; y++)
        {
          const char *left = strchr (art[y], '#'), *right = strrchr (art[y], '#');

          for (int x = 0; left && x < ink.width; x++)
            if (x > left - art[y] && x < right - art[y] && (own || art[y][x] != '#') && y > 1 && y < 10)
              levels.data[y * ink.width + x] = 3;
            else if (own && art[y][x] == '#')
              levels.data[y * ink.width + x] = 3;
        }
      NEAR (leak (&ink, &levels, NULL), 0, 1e-4);
      free (levels.data);
    }
  free (ink.data);
}

/* A wall from top to bottom with a gap in the middle; left is level 0, right level 1. */
static void
gap_picture (int gap, CeldPlane *ink, CeldPlane *levels)
{
  *ink    = plane (200, 120, 1);
  *levels = plane (200, 120, 0);
  for (int y = 0; y < 120; y++)
    for (int x = 98; x < 200; x++)
      {
        if (x < 102 && 2 * abs (y - 60) > gap)
          ink->data[y * 200 + x] = 0;
        if (x >= 100)
          levels->data[y * 200 + x] = 1;
      }
}

static void
a_gap_gives_a_smooth_monotone_transition (void)
{
  CeldSettings settings = celd_settings ();

  settings.hold_gaps = false;
  for (int gap = 12; gap <= 60; gap *= 2)
    {
      CeldPlane ink, levels, depth = plane (200, 120, 0);

      gap_picture (gap, &ink, &levels);
      CHECK (celd_smooth (&ink, NULL, &levels, NULL, &settings, NULL, &depth, NULL) == CELD_OK);
      for (int x = 1; x < 200; x++)
        {
          double step = (double) depth.data[60 * 200 + x] - (double) depth.data[60 * 200 + x - 1];

          CHECK (step >= -1e-4 && step < 1.5 / gap);
        }
      NEAR ((depth.data[60 * 200 + 99] + depth.data[60 * 200 + 100]) / 2, 0.5, 2e-3);
      NEAR (depth.data[60 * 200 + 25], 0, 0.02);
      NEAR (depth.data[60 * 200 + 175], 1, 0.02);
      CHECK (depth.data[5 * 200 + 103] - depth.data[5 * 200 + 96] > 0.3f); /* the wall still cuts */
      free (ink.data);
      free (levels.data);
      free (depth.data);
    }
}

/* A nick that is no wider than the stroke does not open a contour, however finely it was drawn. */
static void
a_nick_does_not_leak (void)
{
  for (int scale = 1; scale <= 4; scale++)
    {
      CeldPlane ink = plane (60 * scale, 40 * scale, 1), levels = plane (60 * scale, 40 * scale, 0);

      for (int y = 0; y < 40 * scale; y++)
        for (int x = 28 * scale; x < 60 * scale; x++)
          {
            if (x < 32 * scale && (y < 18 * scale || y >= 22 * scale))
              ink.data[y * 60 * scale + x] = 0;
            levels.data[y * 60 * scale + x] = x < 30 * scale ? 0 : 2;
          }
      NEAR (leak (&ink, &levels, NULL), 0, 1e-4);
      free (ink.data);
      free (levels.data);
    }
}

static void
anchors_keep_their_level_and_the_rest_is_harmonic (void)
{
  CeldSettings settings = celd_settings ();
  CeldPlane    ink = plane (120, 110, 1), levels = plane (120, 110, 0), depth = plane (120, 110, 0);
  CeldMask     anchors = { 120, 110, 120, calloc (120 * 110, 1) };

  for (int y = 0; y < 110; y++)
    for (int x = 0; x < 120; x++)
      {
        levels.data[y * 120 + x]  = x < 30 ? 0 : 2;
        anchors.data[y * 120 + x] = x == 10 || x == 110;
      }
  CHECK (celd_smooth (&ink, NULL, &levels, &anchors, &settings, NULL, &depth, NULL) == CELD_OK);
  for (int x = 0; x < 120; x++)
    NEAR (depth.data[55 * 120 + x], x < 10 ? 0 : x > 110 ? 2 : 2 * (x - 10) / 100., 4e-4);
  CHECK (celd_smooth (&ink, NULL, &levels, &anchors, &settings, NULL, &levels, NULL) == CELD_OK); /* in place */
  NEAR (largest_change (&levels, &depth), 0, 0);
  free (ink.data);
  free (levels.data);
  free (depth.data);
  free (anchors.data);
}

/* A page behind a figure, joined to it by a small gap: its depth is its own, unless it is let float. */
static void
regions_without_an_anchor_are_held_by_their_core (void)
{
  CeldSettings settings = celd_settings ();
  CeldMask     anchors = { 200, 120, 200, calloc (200 * 120, 1) };
  CeldPlane    ink, levels, depth = plane (200, 120, 0);

  gap_picture (8, &ink, &levels);
  anchors.data[60 * 200 + 190] = 1;
  settings.hold_gaps = false;
  CHECK (celd_smooth (&ink, NULL, &levels, &anchors, &settings, NULL, &depth, NULL) == CELD_OK);
  NEAR (depth.data[60 * 200 + 190], levels.data[60 * 200 + 190], 0);
  NEAR (depth.data[60 * 200 + 20], levels.data[60 * 200 + 20], 1e-3);
  settings.hold_rest = false;
  CHECK (celd_smooth (&ink, NULL, &levels, &anchors, &settings, NULL, &depth, NULL) == CELD_OK);
  NEAR (depth.data[60 * 200 + 20], levels.data[60 * 200 + 190], 1e-3);
  free (ink.data);
  free (levels.data);
  free (depth.data);
  free (anchors.data);
}

static void
what_no_anchor_reaches_keeps_its_level (void)
{
  CeldSettings settings = celd_settings ();
  CeldPlane    ink, levels, depth = plane (200, 120, 0);
  CeldMask     none = { 200, 120, 200, calloc (200 * 120, 1) };

  settings.hold_rest = settings.hold_gaps = false;
  gap_picture (-1, &ink, &levels); /* closed: two components */
  CHECK (celd_smooth (&ink, NULL, &levels, &none, &settings, NULL, &depth, NULL) == CELD_OK);
  NEAR (largest_change (&depth, &levels), 0, 0);
  free (ink.data);
  free (levels.data);
  gap_picture (20, &ink, &levels); /* open: one component of two levels */
  CHECK (celd_smooth (&ink, NULL, &levels, &none, &settings, NULL, &depth, NULL) == CELD_OK);
  for (int i = 0; i < 200 * 120; i += 77)
    NEAR (depth.data[i], 0.5, 1e-4);
  free (ink.data);
  free (levels.data);
  free (depth.data);
  free (none.data);
}

static void
a_speck_is_no_spike (void)
{
  CeldPlane    ink = plane (60, 50, 1), levels = plane (60, 50, 1), depth = plane (60, 50, 0);
  CeldSettings settings = celd_settings ();

  levels.data[25 * 60 + 30] = levels.data[25 * 60 + 31] = 3;
  CHECK (celd_smooth (&ink, NULL, &levels, NULL, &settings, NULL, &depth, NULL) == CELD_OK);
  for (int i = 0; i < 60 * 50; i++)
    NEAR (depth.data[i], 1, 1e-3);
  free (ink.data);
  free (levels.data);
  free (depth.data);
}

static void
pale_ink_cuts_as_far_as_the_threshold (void)
{
  Shape     s = { DISC, 48, 45, 28, 0 };
  CeldPlane ink = draw (&s, 96, 90, 4), levels = fill (&s, 96, 90, 0);

  for (int i = 0; i < 96 * 90; i++)
    ink.data[i] = 1 - 0.78f * (1 - ink.data[i]);
  NEAR (leak (&ink, &levels, NULL), 0, 1e-4);
  for (int i = 0; i < 96 * 90; i++)
    ink.data[i] = 1 - 0.9f * (1 - ink.data[i]);
  CHECK (leak (&ink, &levels, NULL) > 0.1); /* ink 0.3 is none */
  free (ink.data);
  free (levels.data);
}

static void
bad_input_does_no_harm (void)
{
  CeldSettings settings = celd_settings ();
  CeldPlane    one = plane (1, 1, 1), level = plane (1, 1, 4), ink = plane (6, 5, 1), levels = plane (6, 5, 2);
  CeldPlane    wide = { 4, 5, 6, ink.data }, narrow = { 4, 5, 6, levels.data }, depth = plane (4, 5, 0);

  CHECK (celd_smooth (&one, NULL, &levels, NULL, &settings, NULL, &levels, NULL) == CELD_BAD_SIZE);
  CHECK (celd_smooth (&one, NULL, &level, NULL, &settings, NULL, &level, NULL) == CELD_OK);
  NEAR (level.data[0], 4, 0);
  settings.tolerance = NAN;
  CHECK (celd_smooth (&one, NULL, &level, NULL, &settings, NULL, &level, NULL) == CELD_BAD_VALUE);
  settings.tolerance = 1e-4f;

  for (int y = 0; y < 5; y++) /* beyond the width lies what must not be read */
    ink.data[y * 6 + 4] = levels.data[y * 6 + 5] = NAN;
  levels.data[8] = NAN;
  levels.data[9] = INFINITY;
  levels.data[13] = 1;
  ink.data[7] = NAN;
  CHECK (celd_smooth (&wide, NULL, &narrow, NULL, &settings, NULL, &depth, NULL) == CELD_OK);
  for (int i = 0; i < 20; i++)
    CHECK (depth.data[i] >= 1 && depth.data[i] <= 2);
  for (int i = 0; i < 30; i++)
    levels.data[i] = NAN;
  CHECK (celd_smooth (&ink, NULL, &levels, NULL, &settings, NULL, &levels, NULL) == CELD_OK);
  NEAR (levels.data[0], 0, 0);
  free (one.data);
  free (level.data);
  free (ink.data);
  free (levels.data);
  free (depth.data);
}

int
main (void)
{
  RUN (a_closed_contour_does_not_leak);
  RUN (a_line_thinner_than_a_pixel_does_not_leak);
  RUN (depth_is_smooth_across_grey);
  RUN (a_hard_line_of_one_pixel_does_not_leak);
  RUN (a_gap_gives_a_smooth_monotone_transition);
  RUN (a_nick_does_not_leak);
  RUN (anchors_keep_their_level_and_the_rest_is_harmonic);
  RUN (regions_without_an_anchor_are_held_by_their_core);
  RUN (what_no_anchor_reaches_keeps_its_level);
  RUN (a_speck_is_no_spike);
  RUN (pale_ink_cuts_as_far_as_the_threshold);
  RUN (bad_input_does_no_harm);
  return DONE;
}
