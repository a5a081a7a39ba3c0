/* A page of scribbles for tests: laid pixel by pixel, then read.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef SCRIBBLE_PAGE_H
#define SCRIBBLE_PAGE_H

#include "check.h"
#include "image/image.h"

enum { WIDTH = 400, HEIGHT = 300 };

static uint8_t      paint_of[4 * WIDTH * HEIGHT];
static uint32_t     seed_of[WIDTH * HEIGHT];
static CeldPalette  palette;
static CeldSettings settings;

static inline CeldStatus
read_size (int width, int height)
{
  CeldPaint  paint = { width, height, WIDTH, paint_of };
  CeldLabels seeds = { width, height, WIDTH, seed_of };

  return celd_scribbles_read (&paint, &settings, NULL, &seeds, &palette);
}

/* Transparent, or white and opaque. */
static inline void
clear_paint (bool white)
{
  settings = celd_settings ();
  memset (paint_of, white ? 255 : 0, sizeof paint_of);
}

/* Lays a colour over a pixel, as painting programs do. */
static inline void
lay (int x, int y, const uint8_t colour[3], double cover)
{
  uint8_t *p = paint_of + 4 * (y * WIDTH + x);
  double   below = p[3] / 255. * (1 - cover), all = cover + below;

  if (cover <= 0)
    return;
  for (int i = 0; i < 3; i++)
    p[i] = (uint8_t) floor ((cover * colour[i] + below * p[i]) / all + 0.5);
  p[3] = (uint8_t) floor (255 * all + 0.5);
}

/* A stroke from (ax,ay) to (bx,by): full up to `radius`, none from `radius` + `soft` on. */
static inline void
stroke (double ax, double ay, double bx, double by, double radius, double soft, const uint8_t colour[3])
{
  double u = bx - ax, v = by - ay, length = u * u + v * v;

  for (int y = 0; y < HEIGHT; y++)
    for (int x = 0; x < WIDTH; x++)
      {
        double t = length > 0 ? fmin (fmax (((x - ax) * u + (y - ay) * v) / length, 0), 1) : 0;
        double distance = hypot (x - ax - t * u, y - ay - t * v);

        lay (x, y, colour, fmin (fmax ((radius + soft - distance) / soft, 0), 1));
      }
}

/* A stroke of a brush of this opacity, full up to `hardness` of its radius, from there on less and less. */
static inline void
spray (double ax, double ay, double bx, double by, double radius, double hardness, double opacity,
       const uint8_t colour[3])
{
  double u = bx - ax, v = by - ay, length = u * u + v * v;

  for (int y = 0; y < HEIGHT; y++)
    for (int x = 0; x < WIDTH; x++)
      {
        double t = fmin (fmax (((x - ax) * u + (y - ay) * v) / length, 0), 1);
        double away = hypot (x - ax - t * u, y - ay - t * v) / radius;

        lay (x, y, colour, opacity * fmin (fmax ((1 - away) / fmax (1 - hardness, 1 / radius), 0), 1));
      }
}

static inline void
block (int left, int top, int width, int height, const uint8_t colour[3])
{
  for (int y = top; y < top + height; y++)
    for (int x = left; x < left + width; x++)
      lay (x, y, colour, 1);
}

static inline bool
in_palette (const uint8_t colour[3], int error)
{
  for (size_t i = 0; i < palette.n; i++)
    {
      const uint8_t *c = palette.item[i].colour;

      if (abs (c[0] - colour[0]) <= error && abs (c[1] - colour[1]) <= error && abs (c[2] - colour[2]) <= error)
        return true;
    }
  return false;
}

static const uint8_t red[3] = { 200, 30, 40 }, blue[3] = { 30, 60, 220 }, green[3] = { 20, 160, 60 };

#endif
