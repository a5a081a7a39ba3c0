/* How wide the lines of a coloured drawing are, and whether they are darker or lighter than fills.
 *
 * Lines are at nearly all borders of what is to be seen in a drawing.  So the closing by the right window finds lines
 * at nearly all borders at which one twice as wide finds any.  In the inverted picture fills pass for lines, but most
 * of them are wider.  Borders are counted, not the pixels of lines: one fill may have as many as all the thin lines.
 *
 * Of a large picture only bands of rows are looked at.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"

#define NEARLY_ALL   0.95f              /* of the borders at which there are lines; chosen */
#define MOST         0.5f               /* of borders; chosen */
#define CLEAR        4                  /* of 255: contrast of a clear line, beyond an eighth of its paper; chosen */
#define COUNTED      128                /* pixels whose number fits into a byte; chosen */
#define ROWS_APART   2                  /* of those along which borders are counted; chosen */
#define BAND         128                /* rows that are closed together, so that they stay in the cache; chosen */
#define ENOUGH_LINES ((size_t) 1 << 19) /* pixels that are looked at; chosen */

/* ------------------------------------------------------------------ borders */

typedef struct { uint32_t all, at_lines; } Borders;

/* How much darker a clear line is than what is beside it; lower contrast in what is dark may be noise. */
static inline uint8_t
clear_contrast (uint8_t paper)
{
  uint8_t least = CELD_DARKEST_FILL / 8, part = paper / 8;

  return (uint8_t) ((part > least ? part : least) + CLEAR);
}

/* Replaces closed values by 1 where a value is clearly darker, else by 0; none is lighter than its closing. */
CELD_CLONES static void
find_clear (const uint8_t *restrict value, size_t n, uint8_t *restrict closed)
{
  for (size_t i = 0; i < n; i++)
    closed[i] = (uint8_t) (closed[i] - value[i]) > clear_contrast (closed[i]);
}

/* Counts the borders across n pixels, from those `apart` before to those `apart` after each: there lightness changes
 * clearly.  There is a line at a border if one of the three is clearly darker than what is on both sides. */
CELD_CLONES static Borders
count_borders (const uint8_t *value, const uint8_t *clear, size_t apart, size_t n)
{
  const uint8_t *before = value - apart, *after = value + apart;
  const uint8_t *clear_before = clear - apart, *clear_after = clear + apart;
  Borders        borders = { 0, 0 };

  for (size_t i = 0; i < n; i += COUNTED)
    {
      size_t  end = n - i < COUNTED ? n : i + COUNTED;
      uint8_t all = 0, at_lines = 0;

      for (size_t k = i; k < end; k++)
        {
          uint8_t lighter = before[k] > after[k] ? before[k] : after[k];
          uint8_t darker = before[k] > after[k] ? after[k] : before[k];
          uint8_t border = (uint8_t) (lighter - darker) > clear_contrast (lighter);

          all = (uint8_t) (all + border);
          at_lines = (uint8_t) (at_lines + (border & (clear_before[k] | clear[k] | clear_after[k])));
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

/* The share of the borders in a drawing, where lightness changes from one pixel to the second next, at which there are
 * dark lines that the closing by this radius finds.  `closed` is overwritten. */
static float
lines_at_borders (const CeldMask *lightness, int radius, void *work, CeldMask *closed)
{
  size_t  width = (size_t) lightness->width;
  Borders borders = { 0, 0 };

  for (int top = 0; top < lightness->height && width > 2; top += BAND * bands_apart (lightness))
    {
      int      height = band_height (lightness, top);
      CeldMask band = { lightness->width, height, width, &CELD_AT (lightness, 0, top) };
      CeldMask clear = { lightness->width, height, width, closed->data };

      celd_close_bytes (&band, radius, work, &clear);
      find_clear (band.data, width * (size_t) height, clear.data);
      for (int y = 1; y < height - 1; y += ROWS_APART)
        {
          Borders across = count_borders (&CELD_AT (&band, 1, y), &CELD_AT (&clear, 1, y), 1, width - 2);
          Borders down = count_borders (&CELD_AT (&band, 0, y), &CELD_AT (&clear, 0, y), width, width);

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
  const CeldMask *lightness;
  const CeldHost *host;
  void           *work;
  CeldMask       *closed;
  float           share[SIZES]; /* -1: not measured yet */
  int             measured;     /* how many are */
} Windows;

static CeldStatus
measure (Windows *w, int size)
{
  if (w->share[size] >= 0)
    return CELD_OK;
  w->share[size] = lines_at_borders (w->lightness, sizes[size], w->work, w->closed);
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

/* The radius of the smallest closing that finds dark lines at nearly all borders at which one of about twice the radius
 * finds some, and at nearly half of those at which the widest finds some; if there is none, of the one that comes
 * closest to that.  *share says how close, 0 .. 1.  `widest` limits the radius. */
static CeldStatus
find_radius (const CeldMask *lightness, int widest, const CeldHost *host, void *work, CeldMask *closed, int *radius,
             float *share)
{
  Windows    w = { .lightness = lightness, .host = host, .work = work, .closed = closed };
  int        last = 2, size = 0;
  float      most;
  CeldStatus status;

  while (last < SIZES - 1 && sizes[last + 1] <= 2 * widest)
    last++;
  for (int i = 0; i < SIZES; i++)
    w.share[i] = -1;
  *radius = 1;
  *share = 0;
  status = measure (&w, last);
  most = MOST * w.share[last];
  if (status == CELD_OK)
    status = find_size (&w, last - 2, NEARLY_ALL * most, &size);
  for (; size <= last - 2 && status == CELD_OK && *share < NEARLY_ALL; size++)
    {
      float of;

      status = measure (&w, size);
      if (status == CELD_OK)
        status = measure (&w, size + 2);
      of = celd_most (w.share[size + 2], most);
      if (status == CELD_OK && w.share[size] > *share * of)
        {
          *share  = w.share[size] / of;
          *radius = sizes[size];
        }
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

/* Whether lines are lighter than fills, by the inverted lightness.  If lines that are darker are at nearly all borders
 * (`dark` says how nearly), lighter ones would have to be narrower.  Sets *radius if they are. */
static CeldStatus
find_light_lines (const CeldMask *inverted, int broadest, const CeldHost *host, void *work, CeldMask *closed,
                  float dark, int *radius, bool *found)
{
  bool       clear = dark >= NEARLY_ALL;
  int        other;
  float      light;
  CeldStatus status;

  *found = false;
  if (clear && lines_at_borders (inverted, *radius, work, closed) < MOST)
    return celd_progress (host, 1);
  status = find_radius (inverted, clear ? *radius : broadest, host, work, closed, &other, &light);
  *found = clear ? light >= NEARLY_ALL && other < *radius : light > dark;
  if (*found)
    *radius = other;
  return status;
}

CeldStatus
celd_line_window (CeldMask channel[3], int broadest, const CeldHost *host, void *work, CeldMask *closed,
                  CeldMask *lightness, int *radius)
{
  CeldHostPart part[2];
  CeldHost     first = celd_host_part (&part[0], host, 0, 0.5), second = celd_host_part (&part[1], host, 0.5, 1);
  size_t       n = (size_t) lightness->width * (size_t) lightness->height;
  float        dark;
  bool         lighter;
  CeldStatus   status;

  take_lightness (channel[0].data, channel[1].data, channel[2].data, n, lightness->data);
  status = find_radius (lightness, broadest, &first, work, closed, radius, &dark);
  if (status != CELD_OK)
    return status;
  celd_invert_bytes (lightness);
  status = find_light_lines (lightness, broadest, &second, work, closed, dark, radius, &lighter);
  if (!lighter)
    celd_invert_bytes (lightness);
  for (int c = 0; c < 3 && lighter; c++)
    celd_invert_bytes (&channel[c]);
  return status;
}
