/* Geodesic distances along a bent stroke, its mean width and centroid, and where it is painted.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "input/arrows.h"

/* A stroke of the '#' in `rows`; ends with forget. */
static CeldArrowStroke
stroke_of (const char *const *rows, uint32_t **pixels)
{
  int             w = art_width (rows), h = art_height (rows);
  CeldArrowStroke t = { .width = w, .height = h };
  size_t          plane = (size_t) (w + 2) * (size_t) (h + 2);

  *pixels    = malloc (plane * sizeof **pixels);
  t.distance = malloc (plane * sizeof *t.distance);
  for (size_t i = 0; i < plane; i++)
    t.distance[i] = INFINITY;
  for (int y = 0; y < h; y++)
    for (int x = 0; x < w; x++)
      if (rows[y][x] == '#')
        (*pixels)[t.n++] = (uint32_t) ((y + 1) * (w + 2) + x + 1);
  t.pixel = *pixels;
  t.sums  = malloc ((3 * t.n / 2 + 4) * sizeof *t.sums);
  t.rings = malloc (3 * t.n * sizeof *t.rings);
  return t;
}

static void
forget (CeldArrowStroke *t, uint32_t *pixels)
{
  free (t->distance);
  free (t->sums);
  free (t->rings);
  free (pixels);
}

static double
distance_at (const CeldArrowStroke *t, int x, int y)
{
  return t->distance[(y + 1) * (t->width + 2) + x + 1];
}

static void
distances_follow_the_stroke (void)
{
  static const char *const rows[] = {
    "######.",
    ".....#.",
    "######.",
    "#......",
    "######.",
    NULL
  };
  uint32_t       *pixels;
  CeldArrowStroke t = stroke_of (rows, &pixels);
  uint32_t        end = celd_stroke_follow (&t, t.pixel, 1);

  CHECK (celd_stroke_x (&t, t.pixel[0]) == 0 && celd_stroke_y (&t, t.pixel[0]) == 0);
  NEAR (distance_at (&t, 5, 0), 5, 1e-5);
  NEAR (distance_at (&t, 5, 1), 4 + sqrt (2), 1e-5);          /* the corner is cut */
  NEAR (distance_at (&t, 0, 2), 8 + 2 * sqrt (2), 1e-5);
  NEAR (distance_at (&t, 5, 4), 11 + 4 * sqrt (2), 1e-5);
  CHECK (celd_stroke_x (&t, end) == 5 && celd_stroke_y (&t, end) == 4);
  CHECK (isinf (distance_at (&t, 0, 1)));
  forget (&t, pixels);
}

static void
several_starts (void)
{
  static const char *const rows[] = { "#########", NULL };
  uint32_t       *pixels, start[2];
  CeldArrowStroke t = stroke_of (rows, &pixels);
  uint32_t        end;

  start[0] = t.pixel[0];
  start[1] = t.pixel[8];
  end      = celd_stroke_follow (&t, start, 2);
  CHECK (celd_stroke_x (&t, end) == 4);
  NEAR (distance_at (&t, 6, 0), 2, 0);
  forget (&t, pixels);
}

static void
widths_and_centres (void)
{
  static const char *const rows[] = {
    "....................",
    "..........#########.",
    "###################.",
    "###################.",
    "..........#########.",
    NULL
  };
  uint32_t       *pixels;
  CeldArrowStroke t = stroke_of (rows, &pixels);
  uint32_t        start = t.pixel[9]; /* the left end of row 2 */

  CHECK (celd_stroke_x (&t, start) == 0 && celd_stroke_y (&t, start) == 2);
  celd_stroke_follow (&t, &start, 1);
  NEAR (celd_stroke_length (&t), 19, 0); /* the farthest pixel is at 16 + 2 sqrt 2 */
  NEAR (celd_stroke_mean_width (&t, 2, 8), 2, 1e-9);
  NEAR (celd_stroke_mean_width (&t, 12, 18), 4, 1e-9);
  NEAR (celd_stroke_centroid (&t, 2, 8).x, 5, 1e-9); /* columns 2 to 7 */
  NEAR (celd_stroke_centroid (&t, 2, 8).y, 3, 1e-9);
  /* Beyond the end: of all pixels. */
  NEAR (celd_stroke_centroid (&t, 100, 200).x, (2 * 9 * 14.5 + 2 * 19 * 9.5) / 56, 1e-9);
  NEAR (celd_stroke_centroid (&t, 100, 200).y, 3, 1e-9);
  forget (&t, pixels);
}

static void
painted (void)
{
  static const char *const rows[] = { ".....", "..#..", ".....", NULL };
  uint32_t       *pixels;
  CeldArrowStroke t = stroke_of (rows, &pixels);

  celd_stroke_follow (&t, t.pixel, 1);
  CHECK (celd_stroke_painted (&t, celd_stroke_point (&t, t.pixel[0])));
  CHECK (celd_stroke_painted (&t, (CeldPoint) { 1.5, 1.5 }) && celd_stroke_painted (&t, (CeldPoint) { 2.5, 2.9 }));
  CHECK (!celd_stroke_painted (&t, (CeldPoint) { 1.5, 0.5 }));
  CHECK (!celd_stroke_painted (&t, (CeldPoint) { -3, 1 }) && !celd_stroke_painted (&t, (CeldPoint) { 2, 3 }));
  CHECK (!celd_stroke_painted (&t, (CeldPoint) { NAN, 1 }));
  forget (&t, pixels);
}

/* Random paint: distances are those that repeated steps between all neighbours settle on. */
static void
distances_are_least (void)
{
  uint32_t state = 5;

  for (int round = 0; round < 40; round++)
    {
      char            text[24][33], *rows[25];
      uint32_t       *pixels, starts[3];
      CeldArrowStroke t;
      float          *least;
      size_t          n = 0;

      for (int y = 0; y < 24; y++)
        {
          for (int x = 0; x < 32; x++) /* the first row connects all columns, which have gaps on one side */
            text[y][x] = y == 0 || x % 2 == 0 || check_random (&state, 3) ? '#' : '.';
          text[y][32] = 0;
          rows[y] = text[y];
        }
      rows[24] = NULL;
      t = stroke_of ((const char *const *) rows, &pixels);
      for (int i = 0; i < 3; i++)
        starts[i] = pixels[check_random (&state, (uint32_t) t.n)];
      celd_stroke_follow (&t, starts, 3);
      least = malloc (26 * 34 * sizeof *least);
      for (int p = 0; p < 26 * 34; p++)
        least[p] = INFINITY;
      for (int i = 0; i < 3; i++)
        least[starts[i]] = 0;
      for (bool changed = true; changed;)
        {
          changed = false;
          for (n = 0; n < t.n; n++)
            for (int step = 0; step < 9; step++)
              {
                float there = least[(int) pixels[n] + (step / 3 - 1) * 34 + step % 3 - 1] + (step % 2 ? 1 : 1.41421356f);

                if (step != 4 && there < least[pixels[n]])
                  {
                    least[pixels[n]] = there;
                    changed = true;
                  }
              }
        }
      for (n = 0; n < t.n; n++)
        NEAR (t.distance[pixels[n]], least[pixels[n]], 1e-5);
      free (least);
      forget (&t, pixels);
    }
}

int
main (void)
{
  RUN (distances_are_least);
  RUN (distances_follow_the_stroke);
  RUN (several_starts);
  RUN (widths_and_centres);
  RUN (painted);
  return DONE;
}
