/* How wide the lines of a coloured drawing are, and whether they are darker or lighter than fills.
 *
 * Lines are at nearly all borders of what is to be seen in a drawing.  So the closing by the right window finds lines
 * at nearly all borders at which one twice as wide finds any, in some channel: bright lines differ from strong fills in
 * one channel here and in another there.  In the inverted picture fills pass for lines, but most of them are wider.
 * Borders are counted, not the pixels of lines: one fill may have as many as all the thin lines.
 *
 * Of a large picture only bands of rows are looked at.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/coloured-steps.h"

#include <string.h>

#define NEARLY_ALL   0.95f              /* of the borders at which there are lines; chosen */
#define MOST         0.5f               /* of borders; chosen */
#define CLEAR        4                  /* of 255: contrast of a clear line, beyond an eighth of its paper; chosen */
#define COUNTED      128                /* pixels whose number fits into a byte; chosen */
#define ROWS_APART   2                  /* of those along which borders are counted; chosen */
#define BAND         128                /* rows that are closed together, so that they stay in the cache; chosen */
#define ENOUGH_LINES ((size_t) 1 << 18) /* pixels that are looked at; chosen */

/* ------------------------------------------------------------------ borders */

enum { ALONG_ROW = 1, ALONG_COLUMN = 2 }; /* marks of borders */

typedef struct { uint32_t all, at_lines; } Borders;

/* A drawing, and planes of its size that are overwritten. */
typedef struct
{
  CeldMask *channel;         /* red, green, blue */
  CeldMask *border;          /* marks of borders, in the rows that are looked at */
  CeldMask *closed, *clear;
  void     *work;            /* of celd_erode_bytes */
} Planes;

/* How much darker a clear line is than what is beside it; lower contrast in what is dark may be noise. */
static inline uint8_t
clear_contrast (uint8_t paper)
{
  uint8_t least = CELD_DARKEST_FILL / 8, part = paper / 8;

  return (uint8_t) ((part > least ? part : least) + CLEAR);
}

/* Sets `clear` to 1 where a value is clearly darker than its closed one; none is lighter than that. */
CELD_CLONES static void
find_clear (const uint8_t *restrict value, const uint8_t *restrict closed, size_t n, uint8_t *restrict clear)
{
  for (size_t i = 0; i < n; i++)
    clear[i] |= (uint8_t) (closed[i] - value[i]) > clear_contrast (closed[i]);
}

/* Adds a mark where there is a border across a pixel, from the one before to the one after: a value changes clearly. */
CELD_CLONES static void
mark_borders (const uint8_t *before, const uint8_t *after, size_t n, uint8_t mark, uint8_t *restrict border)
{
  for (size_t i = 0; i < n; i++)
    {
      uint8_t lighter = before[i] > after[i] ? before[i] : after[i];
      uint8_t darker = before[i] > after[i] ? after[i] : before[i];

      border[i] |= (uint8_t) (lighter - darker) > clear_contrast (lighter) ? mark : 0;
    }
}

/* Counts the borders with a mark across n pixels.  There is a line at one if the pixel, or the one `apart` before or
 * after it, is of a line. */
CELD_CLONES static Borders
count_borders (const uint8_t *border, uint8_t mark, const uint8_t *clear, size_t apart, size_t n)
{
  const uint8_t *before = clear - apart, *after = clear + apart;
  Borders        borders = { 0, 0 };

  for (size_t i = 0; i < n; i += COUNTED)
    {
      size_t  end = n - i < COUNTED ? n : i + COUNTED;
      uint8_t all = 0, at_lines = 0;

      for (size_t k = i; k < end; k++)
        {
          uint8_t marked = (border[k] & mark) != 0;

          all = (uint8_t) (all + marked);
          at_lines = (uint8_t) (at_lines + (marked & (before[k] | clear[k] | after[k])));
        }
      borders.all += all;
      borders.at_lines += at_lines;
    }
  return borders;
}

static int
band_height (const CeldMask *lightness, int top)
{
  return lightness->height - top < BAND ? lightness->height - top : BAND;
}

/* Of a large picture bands of rows are looked at, the first of each as many as this. */
static int
bands_apart (const CeldMask *lightness)
{
  size_t all = (size_t) lightness->width * (size_t) lightness->height;

  return all > ENOUGH_LINES ? (int) ((all + ENOUGH_LINES / 2) / ENOUGH_LINES) : 1;
}

/* Where the borders are in the bands that are looked at, by the changes of all channels. */
static void
find_borders (const Planes *p)
{
  int width = p->border->width;

  for (int top = 0; top < p->border->height && width > 2; top += BAND * bands_apart (p->border))
    for (int y = top + 1; y < top + band_height (p->border, top) - 1; y += ROWS_APART)
      {
        uint8_t *border = &CELD_AT (p->border, 0, y);

        memset (border, 0, (size_t) width);
        for (int c = 0; c < 3; c++)
          {
            const uint8_t *row = &CELD_AT (&p->channel[c], 0, y);

            mark_borders (row, row + 2, (size_t) width - 2, ALONG_ROW, border + 1);
            mark_borders (row - width, row + width, (size_t) width, ALONG_COLUMN, border);
          }
      }
}

/* The share of the borders at which there are dark lines that the closing of a channel by this radius finds. */
static float
lines_at_borders (const Planes *p, int radius)
{
  size_t  width = (size_t) p->border->width;
  Borders borders = { 0, 0 };

  for (int top = 0; top < p->border->height && width > 2; top += BAND * bands_apart (p->border))
    {
      int      height = band_height (p->border, top);
      size_t   n = width * (size_t) height;
      CeldMask closed = { p->border->width, height, width, p->closed->data };
      CeldMask clear = { p->border->width, height, width, p->clear->data };

      memset (clear.data, 0, n);
      for (int c = 0; c < 3; c++)
        {
          CeldMask band = { p->border->width, height, width, &CELD_AT (&p->channel[c], 0, top) };

          celd_close_bytes (&band, radius, p->work, &closed);
          find_clear (band.data, closed.data, n, clear.data);
        }
      for (int y = 1; y < height - 1; y += ROWS_APART)
        {
          const uint8_t *border = &CELD_AT (p->border, 0, top + y);
          Borders        across = count_borders (border + 1, ALONG_ROW, &CELD_AT (&clear, 1, y), 1, width - 2);
          Borders        down = count_borders (border, ALONG_COLUMN, &CELD_AT (&clear, 0, y), width, width);

          borders.all += across.all + down.all;
          borders.at_lines += across.at_lines + down.at_lines;
        }
    }
  return borders.all ? (float) borders.at_lines / (float) borders.all : 0;
}

/* ------------------------------------------------------------------ the right window */

static const int sizes[] = { 1, 2, 3, 4, 6, 8, 11, 16, 22, 32, 45, 64, 91, 128 }; /* radii, two to an octave */
enum { SIZES = sizeof sizes / sizeof *sizes, COMMON = 3 /* the first that is tried: most lines are narrower */ };

/* The share of borders that are at lines, by the size of the window; it grows with that. */
typedef struct
{
  const Planes   *planes;
  const CeldHost *host;
  float           share[SIZES]; /* -1: not measured yet */
  int             measured;     /* how many are */
} Windows;

static CeldStatus
measure (Windows *w, int size)
{
  if (w->share[size] >= 0)
    return CELD_OK;
  w->share[size] = lines_at_borders (w->planes, sizes[size]);
  return celd_progress (w->host, (double) ++w->measured / SIZES);
}

/* The smallest of the sizes up to `last` at which the share is as large as this, by bisection. */
static CeldStatus
find_size (Windows *w, int last, float least, int *size)
{
  int        low = 0, high = last, middle = COMMON;
  CeldStatus status = CELD_OK;

  while (low < high && status == CELD_OK)
    {
      middle = middle >= high ? (low + high) / 2 : middle;
      status = measure (w, middle);
      if (w->share[middle] < least)
        low = middle + 1;
      else
        high = middle;
      middle = (low + high) / 2;
    }
  *size = low;
  return status;
}

/* The right window for lines. */
typedef struct
{
  int   radius;
  float nearly;   /* how close it comes to finding lines at all borders that it should, 0 .. 1 */
  float at_lines; /* the share of borders at which it finds lines */
} LineWindow;

/* The radius of the smallest closing that finds dark lines at nearly all borders at which one of about twice the radius
 * finds some, and at nearly half of those at which the widest finds some; if there is none, of the one that comes
 * closest to that.  `widest` limits the radius. */
static CeldStatus
find_window (const Planes *planes, int widest, const CeldHost *host, LineWindow *window)
{
  Windows    w = { .planes = planes, .host = host };
  int        last = 2, size = 0;
  float      most;
  CeldStatus status;

  while (last < SIZES - 1 && sizes[last + 1] <= 2 * widest)
    last++;
  for (int i = 0; i < SIZES; i++)
    w.share[i] = -1;
  *window = (LineWindow) { .radius = 1 };
  find_borders (planes);
  status = measure (&w, last);
  most = MOST * w.share[last];
  if (status == CELD_OK)
    status = find_size (&w, last - 2, NEARLY_ALL * most, &size);
  for (; size <= last - 2 && status == CELD_OK && window->nearly < NEARLY_ALL; size++)
    {
      float of;

      status = measure (&w, size);
      if (status == CELD_OK)
        status = measure (&w, size + 2);
      of = celd_most (w.share[size + 2], most);
      if (status == CELD_OK && w.share[size] > window->nearly * of)
        *window = (LineWindow) { sizes[size], w.share[size] / of, w.share[size] };
    }
  return status;
}

/* ------------------------------------------------------------------ dark or light */

/* The lightness of the HSL model, halfway between the largest and the least channel: unlike luma it tells lines from
 * fills in strong colours, which are dark in luma, and lines that differ from fills in blue only. */
CELD_CLONES static void
take_lightness (const uint8_t *restrict red, const uint8_t *restrict green, const uint8_t *restrict blue, size_t n,
                uint8_t *restrict lightness)
{
  for (size_t i = 0; i < n; i++)
    {
      uint8_t largest = red[i] > green[i] ? red[i] : green[i], least = red[i] > green[i] ? green[i] : red[i];

      largest = largest > blue[i] ? largest : blue[i];
      least = least > blue[i] ? blue[i] : least;
      lightness[i] = (uint8_t) ((largest + least + 1) / 2);
    }
}

static void
invert (const Planes *planes)
{
  for (int c = 0; c < 3; c++)
    celd_invert_bytes (&planes->channel[c]);
}

/* Whether lines are lighter than fills: darker in the inverted drawing.  If lines that are darker are at nearly all
 * borders, lighter ones would have to be narrower; else at more borders.  `window` is that for darker lines, and that
 * for lighter ones after that. */
static CeldStatus
find_light_lines (const Planes *inverted, int broadest, const CeldHost *host, LineWindow *window, bool *found)
{
  bool       clear = window->nearly >= NEARLY_ALL;
  LineWindow light;
  CeldStatus status;

  *found = false;
  if (clear && lines_at_borders (inverted, window->radius) < MOST)
    return celd_progress (host, 1);
  status = find_window (inverted, clear ? window->radius : broadest, host, &light);
  *found = clear ? light.nearly >= NEARLY_ALL && light.radius < window->radius
                 : light.nearly * light.at_lines > window->nearly * window->at_lines;
  if (*found)
    *window = light;
  return status;
}

CeldStatus
celd_line_window (CeldMask channel[3], int broadest, const CeldHost *host, void *work, CeldMask *closed,
                  CeldMask *clear, CeldMask *lightness, int *radius)
{
  CeldHostPart part[2];
  CeldHost     first = celd_host_part (&part[0], host, 0, 0.5), second = celd_host_part (&part[1], host, 0.5, 1);
  Planes       planes = { channel, lightness, closed, clear, work };
  LineWindow   window;
  bool         lighter;
  CeldStatus   status = find_window (&planes, broadest, &first, &window);

  if (status != CELD_OK)
    return status;
  invert (&planes);
  status = find_light_lines (&planes, broadest, &second, &window, &lighter);
  if (!lighter)
    invert (&planes);
  take_lightness (channel[0].data, channel[1].data, channel[2].data,
                  (size_t) lightness->width * (size_t) lightness->height, lightness->data);
  *radius = window.radius;
  return status;
}
