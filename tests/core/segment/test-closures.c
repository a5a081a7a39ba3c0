/* Gaps closed by lines and curves: where the new boundary runs, and that nothing else changes.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "scene.h"
#include "segment/task.h"

#define SIZE 161

static const double pi = 3.14159265358979;

/* A line through the middle of the picture with a gap, at an angle; labels on its sides meet where `wanders` says. */
static void
draw_line (double angle, double gap, double width, double wander, Scene *s)
{
  double    x = cos (angle), y = sin (angle), m = SIZE / 2.0, end = (gap + width) / 2;
  CeldPlace from[2] = { { m + end * x, m + end * y }, { m - end * x, m - end * y } };

  scene_open (SIZE, SIZE, s);
  for (int k = 0; k < 2; k++)
    scene_line (s, from[k], (CeldPlace) { m + (k ? -200 : 200) * x, m + (k ? -200 : 200) * y }, width);
  for (int v = 0; v < SIZE; v++)
    for (int u = 0; u < SIZE; u++)
      {
        double along = (u + 0.5 - m) * x + (v + 0.5 - m) * y, across = (v + 0.5 - m) * x - (u + 0.5 - m) * y;
        double off = fabs (along) < gap / 2 ? wander * sin (along * 2 * pi / gap) + wander / 2 : 0;

        CELD_AT (&s->labels, u, v) = across > off ? 2 : 1;
      }
}

/* Paper that is not on its side of the line through the middle, farther than `slack` from it. */
static int
wrong_sides (const Scene *s, double angle, double slack)
{
  int n = 0;

  for (int v = 0; v < SIZE; v++)
    for (int u = 0; u < SIZE; u++)
      {
        double across = (v + 0.5 - SIZE / 2.0) * cos (angle) - (u + 0.5 - SIZE / 2.0) * sin (angle);

        n += CELD_AT (&s->ink, u, v) >= 0.5f && fabs (across) > slack &&
             (CELD_AT (&s->labels, u, v) == 2) != (across > 0);
      }
  return n;
}

static void
gaps_in_straight_lines_are_closed_straight (void)
{
  static const double gaps[] = { 8, 24, 60 }, widths[] = { 1.5, 4, 9 };

  for (int k = 0; k < 24; k++)
    for (int i = 0; i < 9; i++)
      {
        double angle = k * pi / 24, gap = gaps[i / 3];
        Scene  s;

        draw_line (angle, gap, widths[i % 3], gap / 8 + 1, &s);
        CHECK (scene_find (&s, NULL) == CELD_OK);
        NEAR (s.closures.n, 1, 0);
        CHECK (wrong_sides (&s, angle, 1) > 0);
        scene_apply (&s);
        NEAR (wrong_sides (&s, angle, 1), 0, 0);
        scene_close (&s);
      }
}

/* ------------------------------------------------------------------ arcs */

typedef struct { double x, y, radius, at, half; } Ring;

/* How far an angle is from the middle of the gap. */
static double
off_gap (const Ring *ring, double angle)
{
  return fabs (remainder (angle - ring->at, 2 * pi));
}

static void
draw_ring (const Ring *ring, double width, Scene *s)
{
  for (int v = 0; v < s->ink.height; v++)
    for (int u = 0; u < s->ink.width; u++)
      {
        double dx = u + 0.5 - ring->x, dy = v + 0.5 - ring->y, off = fabs (hypot (dx, dy) - ring->radius);

        if (off_gap (ring, atan2 (dy, dx)) < ring->half)
          for (int k = -1; k <= 1; k += 2)
            {
              double x = ring->radius * cos (ring->at + k * ring->half) - dx;
              double y = ring->radius * sin (ring->at + k * ring->half) - dy;

              off = k < 0 ? hypot (x, y) : fmin (off, hypot (x, y));
            }
        CELD_AT (&s->ink, u, v) = fminf (CELD_AT (&s->ink, u, v), (float) fmin (fmax (off - width / 2 + 0.5, 0), 1));
      }
}

/* Pixels of paper whose label is not that of the whole disc. */
static int
wrong_of_disc (const Scene *s, const Ring *ring)
{
  int n = 0;

  for (int v = 0; v < s->ink.height; v++)
    for (int u = 0; u < s->ink.width; u++)
      n += CELD_AT (&s->ink, u, v) >= 0.5f &&
           (CELD_AT (&s->labels, u, v) == 2) != (hypot (u + 0.5 - ring->x, v + 0.5 - ring->y) < ring->radius);
  return n;
}

/* Labels as basins and cuts make them: 0 a chord aslant, 1 the corner of a box, 2 stairs. */
static void
label_disc (const Ring *ring, int manner, Scene *s)
{
  double x = cos (ring->at), y = sin (ring->at);
  double low = ring->radius * cos (ring->half), high = ring->radius * sin (ring->half);
  double left = fmin (low * x - high * y, low * x + high * y), right = fmax (low * x - high * y, low * x + high * y);
  double top = fmin (low * y - high * x, low * y + high * x), bottom = fmax (low * y - high * x, low * y + high * x);

  for (int v = 0; v < s->ink.height; v++)
    for (int u = 0; u < s->ink.width; u++)
      {
        double dx = u + 0.5 - ring->x, dy = v + 0.5 - ring->y, along = dx * x + dy * y, across = dy * x - dx * y;
        bool   inside = hypot (dx, dy) < ring->radius;

        if (off_gap (ring, atan2 (dy, dx)) < ring->half)
          inside = manner == 0 ? along < low + 0.08 * across
                 : manner == 1 ? along < low || (dx > left && dx < right && dy > top && dy < bottom)
                 : along < low + 2 * ((int) floor ((across + high) / 9) % 2);
        CELD_AT (&s->labels, u, v) = inside ? 2 : 1;
      }
}

/* The drawing of the acceptance test: radius 120, line 6, gap 60. */
static void
a_circle_is_closed_near_its_chord_on_the_side_of_the_arc (void)
{
  for (int k = 0; k < 24; k++)
    for (int manner = 0; manner < 3; manner++)
      {
        Ring         ring = { 150.2, 149.7, 120, k * pi / 12 + 0.05, asin (33 / 120.0) };
        Scene        s;
        CeldClosure *closure;
        int          before;

        scene_open (300, 300, &s);
        draw_ring (&ring, 6, &s);
        label_disc (&ring, manner, &s);
        before = wrong_of_disc (&s, &ring);
        CHECK (scene_find (&s, NULL) == CELD_OK);
        NEAR (s.closures.n, 1, 0);
        closure = s.closures.item;
        CHECK (scene_deviation (closure, closure->place[0], closure->place[closure->n - 1]) <= 3);
        NEAR (hypot (closure->place[0].x - closure->place[closure->n - 1].x,
                     closure->place[0].y - closure->place[closure->n - 1].y), 60, 2);
        scene_apply (&s);
        CHECK (wrong_of_disc (&s, &ring) < 100);
        CHECK (wrong_of_disc (&s, &ring) < before);
        scene_close (&s);
      }
}

/* Where the arc is no guess any more it is followed: much nearer to the circle than the chord is. */
static void
long_arcs_are_continued (void)
{
  for (int k = 0; k < 12; k++)
    {
      Ring   ring = { 100, 100, 70, k * pi / 6, asin (0.6) };
      Scene  s;
      double most = 0;

      scene_open (200, 200, &s);
      draw_ring (&ring, 5, &s);
      label_disc (&ring, 0, &s);
      CHECK (scene_find (&s, NULL) == CELD_OK);
      NEAR (s.closures.n, 1, 0);
      for (size_t i = 0; s.closures.n && i < s.closures.item[0].n; i++)
        most = fmax (most, fabs (hypot (s.closures.item[0].place[i].x - 100,
                                        s.closures.item[0].place[i].y - 100) - 70));
      CHECK (most < 0.5 * 70 * (1 - 0.8));
      scene_apply (&s);
      scene_close (&s);
    }
}

/* ------------------------------------------------------------------ several ends */

/* The chain of the second gap is one with that of the first as a boundary of basins. */
static void
two_gaps_between_two_regions_are_both_closed (void)
{
  Scene s;

  scene_open (120, 90, &s);
  scene_line (&s, (CeldPlace) { -5, 45.5 }, (CeldPlace) { 20, 45.5 }, 4);
  scene_line (&s, (CeldPlace) { 40, 45.5 }, (CeldPlace) { 70, 45.5 }, 4);
  scene_line (&s, (CeldPlace) { 90, 45.5 }, (CeldPlace) { 125, 45.5 }, 4);
  for (int y = 0; y < 90; y++)
    for (int x = 0; x < 120; x++)
      CELD_AT (&s.labels, x, y) = y > 45 + (x > 22 && x < 38 ? 4 : x > 72 && x < 88 ? -4 : 0) ? 2 : 1;
  CHECK (scene_find (&s, NULL) == CELD_OK);
  NEAR (s.closures.n, 2, 0);
  for (size_t k = 0; k < s.closures.n; k++)
    {
      CHECK (s.closures.item[k].label == 1 && s.closures.item[k].other == 2);
      CHECK (scene_deviation (&s.closures.item[k], (CeldPlace) { 0, 45.5 }, (CeldPlace) { 1, 45.5 }) <= 0.6);
    }
  scene_apply (&s);
  for (int x = 24; x < 88; x++)
    if (x < 36 || x > 74)
      CHECK (CELD_AT (&s.labels, x, 44) == 1 && CELD_AT (&s.labels, x, 47) == 2);
  scene_close (&s);
}

/* The boundary from a line's end to the frame starts in the middle of the tip and ends where it did. */
static void
a_gap_at_the_frame_ends_there (void)
{
  Scene s;

  scene_open (60, 60, &s);
  scene_line (&s, (CeldPlace) { -5, 30.5 }, (CeldPlace) { 36, 30.5 }, 5);
  for (int y = 0; y < 60; y++)
    for (int x = 0; x < 60; x++)
      CELD_AT (&s.labels, x, y) = y >= 31 + (x > 40 && x < 52 ? 5 : 0) ? 2 : 1;
  CHECK (scene_find (&s, NULL) == CELD_OK);
  NEAR (s.closures.n, 1, 0);
  if (s.closures.n == 1)
    {
      const CeldClosure *c = &s.closures.item[0];

      NEAR (c->place[0].x, 37.25, 1.25); /* between the line's last place and the rim of its round tip */
      NEAR (c->place[0].y, 30.5, 0.1);
      NEAR (c->place[c->n - 1].x, 60, 0.1);
      NEAR (c->place[c->n - 1].y, 31, 0.1);
    }
  scene_apply (&s);
  for (int x = 40; x < 60; x++)
    CHECK (CELD_AT (&s.labels, x, 29) == 1 && CELD_AT (&s.labels, x, 32) == 2);
  scene_close (&s);
}

/* Three lines that point at a place where three labels meet: the third label is left alone. */
static void
a_junction_stays_where_it_is (void)
{
  Scene s;
  int   third = 0;

  scene_open (90, 90, &s);
  scene_line (&s, (CeldPlace) { 45, -5 }, (CeldPlace) { 45, 25 }, 4);
  scene_line (&s, (CeldPlace) { -5, 75 }, (CeldPlace) { 25, 60 }, 4);
  scene_line (&s, (CeldPlace) { 95, 75 }, (CeldPlace) { 65, 60 }, 4);
  for (int y = 0; y < 90; y++)
    for (int x = 0; x < 90; x++)
      CELD_AT (&s.labels, x, y) = y > 47 + abs (x - 45) / 2 ? 3 : x < 45 + (y > 30 && y < 42 ? 3 : 0) ? 1 : 2;
  CHECK (scene_find (&s, NULL) == CELD_OK);
  NEAR (s.closures.n, 3, 0);
  scene_apply (&s);
  for (int y = 50; y < 90; y++)
    third += CELD_AT (&s.labels, 45, y) == 3;
  NEAR (third, 40, 0);
  for (int y = 32; y < 44; y++)
    CHECK (CELD_AT (&s.labels, 42, y) == 1 && CELD_AT (&s.labels, 48, y) == 2);
  scene_close (&s);
}

static void
a_gap_one_pixel_wide_is_a_closure (void)
{
  static const char *const art[] = { "AAAAAAAAAAA", "AAAAAAAAAAA", "#####A#####", "BBBBBBBBBBB", "BBBBBBBBBBB", NULL };
  Scene                    s;

  scene_read (art, &s);
  CHECK (scene_find (&s, NULL) == CELD_OK);
  NEAR (s.closures.n, 1, 0);
  if (s.closures.n)
    CHECK (scene_deviation (s.closures.item, (CeldPlace) { 0, 2.5 }, (CeldPlace) { 1, 2.5 }) <= 0.5);
  scene_apply (&s);
  scene_close (&s);
}

/* ------------------------------------------------------------------ anything at all */

static void
random_pictures_give_the_same_closures_twice_and_lose_no_label (void)
{
  uint32_t state = 7;
  size_t   patches = 0;

  for (int round = 0; round < 300; round++)
    {
      Scene  s, twin;
      int    w = 20 + (int) check_random (&state, 60), h = 20 + (int) check_random (&state, 60), lost = 0;
      double site[6][2];

      scene_open (w, h, &s);
      for (uint32_t k = 0; k < 2 + check_random (&state, 6); k++)
        scene_line (&s, (CeldPlace) { check_random (&state, (uint32_t) w), check_random (&state, (uint32_t) h) },
                    (CeldPlace) { check_random (&state, (uint32_t) w) + 0.5, check_random (&state, (uint32_t) h) },
                    0.5 + check_random (&state, 12) / 2.0);
      for (int k = 0; k < 6; k++)
        {
          site[k][0] = check_random (&state, (uint32_t) w);
          site[k][1] = check_random (&state, (uint32_t) h);
        }
      for (int y = 0; y < h; y++)
        for (int x = 0; x < w; x++)
          {
            int nearest = 0;

            for (int k = 1; k < 6; k++)
              if (hypot (x - site[k][0], y - site[k][1]) < hypot (x - site[nearest][0], y - site[nearest][1]))
                nearest = k;
            CELD_AT (&s.labels, x, y) = (uint32_t) nearest / 2 + 1;
            if (!check_random (&state, 50))
              CELD_AT (&s.labels, x, y) = 1 + check_random (&state, 4);
            if (!check_random (&state, 200))
              CHECK (celd_seed_rows_paint (&s.task.seeds, y, x, x + 1, CELD_AT (&s.labels, x, y)) == CELD_OK);
          }
      twin = s;
      CHECK (scene_find (&s, NULL) == CELD_OK);
      CHECK (scene_find (&twin, NULL) == CELD_OK);
      CHECK (s.patches.n == twin.patches.n && s.closures.n == twin.closures.n);
      CHECK (!s.patches.n || !memcmp (s.patches.item, twin.patches.item, s.patches.n * sizeof *s.patches.item));
      scene_apply (&s);
      patches += s.patches.n;
      for (int p = 0; p < w * h; p++)
        lost += !s.labels.data[p];
      NEAR (lost, 0, 0);
      celd_closures_clear (&twin.closures);
      celd_patches_clear (&twin.patches);
      free (twin.basins.row);
      free (twin.basins.run);
      free (twin.basins.boundary);
      scene_close (&s);
    }
  CHECK (patches > 300);
}

/* ------------------------------------------------------------------ closures as a picture */

#define W 20
#define H 12

static void
paint (CeldPlace *place, size_t n, double width, const uint8_t below[4], uint8_t picture[4 * W * H])
{
  CeldClosure  item = { place, n, 1, 2 };
  CeldClosures closures = { &item, 1 };
  CeldPaint    view = { W, H, W, picture };

  for (int p = 0; p < 4 * W * H; p++)
    picture[p] = below[p % 4];
  celd_closures_paint (&closures, width, &view);
}

static void
check_pixel (const uint8_t picture[4 * W * H], int x, int y, int r, int g, int b, int a)
{
  const uint8_t *rgba = &picture[4 * (y * W + x)];

  NEAR (rgba[0], r, 1);
  NEAR (rgba[1], g, 1);
  NEAR (rgba[2], b, 1);
  NEAR (rgba[3], a, 1);
}

static void
a_line_covers_its_width (void)
{
  CeldPlace place[] = { { 4, 5 }, { 15, 5 } };
  uint8_t   picture[4 * W * H];

  paint (place, 2, 2, (const uint8_t[]) { 40, 80, 120, 255 }, picture);
  for (int y = 0; y < H; y++)
    if (y == 4 || y == 5)
      check_pixel (picture, 9, y, 255, 0, 0, 255);
    else
      check_pixel (picture, 9, y, 40, 80, 120, 255);
  check_pixel (picture, 1, 5, 40, 80, 120, 255);
  check_pixel (picture, 18, 5, 40, 80, 120, 255);
}

static void
the_edge_of_a_line_is_antialiased (void)
{
  CeldPlace place[] = { { 4, 5.5 }, { 15, 5.5 } };
  uint8_t   picture[4 * W * H];

  paint (place, 2, 2, (const uint8_t[]) { 0, 100, 200, 255 }, picture);
  check_pixel (picture, 9, 5, 255, 0, 0, 255);
  check_pixel (picture, 9, 4, 128, 50, 100, 255);
  check_pixel (picture, 9, 6, 128, 50, 100, 255);
}

static void
over_a_transparent_pixel_the_line_keeps_its_colour (void)
{
  CeldPlace place[] = { { 4, 5.5 }, { 15, 5.5 } };
  uint8_t   picture[4 * W * H];

  paint (place, 2, 2, (const uint8_t[]) { 9, 9, 9, 0 }, picture);
  check_pixel (picture, 9, 5, 255, 0, 0, 255);
  check_pixel (picture, 9, 4, 255, 0, 0, 128);
  check_pixel (picture, 9, 1, 9, 9, 9, 0);
}

/* A line of many segments looks like that of one segment. */
static void
joints_of_segments_are_painted_once (void)
{
  CeldPlace one[] = { { 3, 3.3 }, { 17, 8.3 } }, many[15];
  uint8_t   picture[2][4 * W * H];
  int       differ = 0;

  for (int i = 0; i < 15; i++)
    many[i] = (CeldPlace) { 3 + i, 3.3 + i * 5 / 14.0 };
  paint (one, 2, 1.5, (const uint8_t[]) { 255, 255, 255, 255 }, picture[0]);
  paint (many, 15, 1.5, (const uint8_t[]) { 255, 255, 255, 255 }, picture[1]);
  for (int p = 0; p < 4 * W * H; p++)
    differ += abs (picture[0][p] - picture[1][p]) > 1;
  NEAR (differ, 0, 0);
}

static void
a_line_is_clipped_by_the_picture (void)
{
  CeldPlace place[] = { { -50, -3 }, { 8, 6 }, { 70, 40 } };
  uint8_t   picture[4 * W * H];

  paint (place, 3, 3, (const uint8_t[]) { 0, 0, 0, 255 }, picture);
  check_pixel (picture, 7, 5, 255, 0, 0, 255);
  check_pixel (picture, 19, 0, 0, 0, 0, 255);
}

int
main (void)
{
  RUN (gaps_in_straight_lines_are_closed_straight);
  RUN (a_circle_is_closed_near_its_chord_on_the_side_of_the_arc);
  RUN (long_arcs_are_continued);
  RUN (two_gaps_between_two_regions_are_both_closed);
  RUN (a_gap_at_the_frame_ends_there);
  RUN (a_junction_stays_where_it_is);
  RUN (a_gap_one_pixel_wide_is_a_closure);
  RUN (random_pictures_give_the_same_closures_twice_and_lose_no_label);
  RUN (a_line_covers_its_width);
  RUN (the_edge_of_a_line_is_antialiased);
  RUN (over_a_transparent_pixel_the_line_keeps_its_colour);
  RUN (joints_of_segments_are_painted_once);
  RUN (a_line_is_clipped_by_the_picture);
  return DONE;
}
