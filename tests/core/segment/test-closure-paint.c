/* Closures as a picture.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"

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
its_rim_is_antialiased (void)
{
  CeldPlace place[] = { { 4, 5.5 }, { 15, 5.5 } };
  uint8_t   picture[4 * W * H];

  paint (place, 2, 2, (const uint8_t[]) { 0, 100, 200, 255 }, picture);
  check_pixel (picture, 9, 5, 255, 0, 0, 255);
  check_pixel (picture, 9, 4, 128, 50, 100, 255);
  check_pixel (picture, 9, 6, 128, 50, 100, 255);
}

static void
over_nothing_only_opacity_is_painted (void)
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
segments_do_not_show (void)
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
what_lies_outside_is_cut_off (void)
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
  RUN (a_line_covers_its_width);
  RUN (its_rim_is_antialiased);
  RUN (over_nothing_only_opacity_is_painted);
  RUN (segments_do_not_show);
  RUN (what_lies_outside_is_cut_off);
  return DONE;
}
