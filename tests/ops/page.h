/* A small page for the tests of the operations, as pictures of core and as buffers of GEGL; and calls of operations.
 *
 * Two discs with antialiased outlines, the left one (red) in front of the right one (green), before a background
 * (blue): a stroke of each colour, one arrow from the left disc to the right one, and one contour of each kind.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef PAGE_H
#define PAGE_H

#include "check.h"

#include <gegl.h>

#define WIDTH 120
#define HEIGHT 80
#define PIXELS (WIDTH * HEIGHT)

/* Pads in their order: input, aux, aux2, ...; NULL where nothing is connected. */
typedef struct { GeglBuffer *pad[7]; } Pads;

static float   page_luma[PIXELS];
static uint8_t page_scribbles[4 * PIXELS], page_arrows[4 * PIXELS], page_contours[4 * PIXELS];

static const CeldDrawing page_drawing = { .luma = { WIDTH, HEIGHT, WIDTH, page_luma } };
static const CeldPaint scribbles_paint = { WIDTH, HEIGHT, WIDTH, page_scribbles };
static const CeldPaint arrows_paint = { WIDTH, HEIGHT, WIDTH, page_arrows };
static const CeldPaint contours_paint = { WIDTH, HEIGHT, WIDTH, page_contours };

static GeglBuffer *drawing, *scribbles, *arrows, *contours;

/* ------------------------------------------------------------------ drawing the page */

static inline float
outline (float x, float y, float centre_x, float radius)
{
  return fabsf (hypotf (x - centre_x, y - 40) - radius) - 1;
}

static inline float
page_value (int x, int y)
{
  float px = (float) x + 0.5f, py = (float) y + 0.5f;
  float left = outline (px, py, 45, 24), right = outline (px, py, 80, 22);
  float away = hypotf (px - 45, py - 40) < 24 ? left : fminf (left, right); /* the left disc hides the right one */

  return roundf (255 * fmaxf (0, fminf (1, away))) / 255;
}

/* Levels of pixel i: three parts on a black page. */
static inline float
level_at (int i)
{
  int x = i % WIDTH, y = i / WIDTH;

  return x < 12 || x >= 108 || y < 10 || y >= 70 ? 0 : x < 40 ? 0.35f : x < 80 ? 0.7f : 1;
}

/* A surface in all greys, other ones in other channels. */
static inline float
surface_at (int i, int channel)
{
  double x = i % WIDTH, y = i / WIDTH, sum = 0;

  for (int k = 1; k <= 24; k++)
    sum += sin (0.2 * k * (x * cos (2.4 * k) + y * sin (2.4 * k)) + (1 + channel) * k * k) / sqrt (k);
  return (float) (0.5 + 0.12 * sum);
}

/* The page as a faint drawing in strong grain, which may be a photograph. */
static inline float
faint_at (int i)
{
  uint32_t hash = (uint32_t) i;
  float    grain = 0;

  for (int k = 0; k < 3; k++)
    {
      hash = (hash ^ hash >> 15) * 2246822519u + 2654435769u;
      grain += (float) (hash >> 24) / 255 - 0.5f;
    }
  return 0.8f - 0.2f * (1 - page_luma[i]) + 0.11f * grain;
}

static inline void
paint_line (uint8_t *paint, int x0, int y0, int x1, int y1, int thickness, uint32_t rgb)
{
  int steps = MAX (ABS (x1 - x0), ABS (y1 - y0));

  for (int i = 0; i <= steps; i++)
    for (int dy = 0; dy < thickness; dy++)
      for (int dx = 0; dx < thickness; dx++)
        {
          uint8_t *p = paint + 4 * ((y0 + (y1 - y0) * i / steps + dy) * WIDTH + x0 + (x1 - x0) * i / steps + dx);

          p[0] = (uint8_t) (rgb >> 16);
          p[1] = (uint8_t) (rgb >> 8);
          p[2] = (uint8_t) rgb;
          p[3] = 255;
        }
}

/* The page with a fill in each disc, R'G'B'. */
static inline void
colour_page (float *pixels)
{
  static const float fill[3][3] = { { 1, 0.9f, 0.5f }, { 0.6f, 0.9f, 0.7f }, { 0.9f, 0.95f, 1 } };

  for (int i = 0; i < PIXELS; i++)
    {
      float x = (float) (i % WIDTH) + 0.5f, y = (float) (i / WIDTH) + 0.5f;
      int   disc = hypotf (x - 45, y - 40) < 24 ? 0 : hypotf (x - 80, y - 40) < 22 ? 1 : 2;

      for (int c = 0; c < 3; c++)
        pixels[3 * i + c] = page_luma[i] * fill[disc][c];
    }
}

/* A buffer of the page's size that holds pixels of one format, kept in another. */
static inline GeglBuffer *
page_buffer (const char *kept, const char *format, const void *pixels)
{
  GeglBuffer *buffer = gegl_buffer_new (GEGL_RECTANGLE (0, 0, WIDTH, HEIGHT), babl_format (kept));

  gegl_buffer_set (buffer, NULL, 0, babl_format (format), pixels, GEGL_AUTO_ROWSTRIDE);
  return buffer;
}

static inline void
make_page (void)
{
  for (int i = 0; i < PIXELS; i++)
    page_luma[i] = page_value (i % WIDTH, i / WIDTH);
  paint_line (page_scribbles, 35, 40, 55, 40, 3, 0xff0000);
  paint_line (page_scribbles, 80, 30, 90, 50, 3, 0x00ff00);
  paint_line (page_scribbles, 5, 5, 110, 5, 3, 0x0000ff);
  paint_line (page_arrows, 45, 48, 90, 48, 2, 0x000000);
  paint_line (page_arrows, 84, 42, 90, 48, 2, 0x000000);
  paint_line (page_arrows, 84, 54, 90, 48, 2, 0x000000);
  paint_line (page_contours, 30, 40, 38, 40, 2, 0xff0000);
  paint_line (page_contours, 85, 40, 95, 40, 2, 0x0000ff);
  paint_line (page_contours, 80, 60, 84, 60, 3, 0x00ff00);
  drawing   = page_buffer ("Y' u8", "Y' float", page_luma);
  scribbles = page_buffer ("R'G'B'A u8", "R'G'B'A u8", page_scribbles);
  arrows    = page_buffer ("R'G'B'A u8", "R'G'B'A u8", page_arrows);
  contours  = page_buffer ("R'G'B'A u8", "R'G'B'A u8", page_contours);
}

static inline void
drop_page (void)
{
  g_object_unref (drawing);
  g_object_unref (scribbles);
  g_object_unref (arrows);
  g_object_unref (contours);
}

/* ------------------------------------------------------------------ through GEGL */

/* GEGL 0.4.46 knows a new name, and warns of the only one of 0.4.42. */
static inline void
join (GeglNode *source, GeglNode *sink, const char *pad)
{
#if GEGL_MICRO_VERSION >= 46
  gegl_node_connect (source, "output", sink, pad);
#else
  gegl_node_connect_to (source, "output", sink, pad);
#endif
}

static inline GeglNode *
add_operation (GeglNode *graph, const char *operation, Pads pads)
{
  static const char *const names[] = { "input", "aux", "aux2", "aux3", "aux4", "aux5", "aux6" };
  GeglNode                *node = gegl_node_new_child (graph, "operation", operation, NULL);
  GeglNode                *source;

  for (int i = 0; i < 7; i++)
    if (pads.pad[i])
      {
        source = gegl_node_new_child (graph, "operation", "gegl:buffer-source", "buffer", pads.pad[i], NULL);
        join (source, node, names[i]);
      }
  return node;
}

static inline void
get_output (GeglNode *node, const char *format, void *pixels)
{
  gegl_node_blit (node, 1.0, GEGL_RECTANGLE (0, 0, WIDTH, HEIGHT), babl_format (format), pixels,
                  GEGL_AUTO_ROWSTRIDE, GEGL_BLIT_DEFAULT);
}

/* One call: properties as names and values, ended by NULL. */
static inline void
operate (const char *operation, Pads pads, const char *format, void *pixels, const char *property, ...)
{
  GeglNode *graph = gegl_node_new (), *node = add_operation (graph, operation, pads);
  va_list   properties;

  va_start (properties, property);
  if (property)
    gegl_node_set_valist (node, property, properties);
  va_end (properties);
  get_output (node, format, pixels);
  g_object_unref (graph);
}

/* The largest difference of two pictures; NaN counts as huge. */
static inline double
difference (const float *a, const float *b, size_t n)
{
  double most = 0;

  for (size_t i = 0; i < n; i++)
    {
      double d = fabs ((double) a[i] - (double) b[i]);

      if (!(d <= most))
        most = d == d ? d : 1e30;
    }
  return most;
}

static inline double
range (const float *a, size_t n)
{
  float least = a[0], most = a[0];

  for (size_t i = 1; i < n; i++)
    {
      least = fminf (least, a[i]);
      most  = fmaxf (most, a[i]);
    }
  return (double) (most - least);
}

#endif
