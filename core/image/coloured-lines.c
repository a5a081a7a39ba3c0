/* The lines of a coloured drawing, black on white, whatever colours they and the fills between them have.
 *
 * A line is darker in some channel than what lies on both sides of it (or lighter: then the picture is inverted first);
 * a fill is not.
 * 1. The width of lines, and whether they are darker or lighter than fills (line-width.c).
 * 2. Contrast: of each channel against its closing by a window a little wider than lines, which is the paper or the
 *    fill around; the largest of the three.
 * 3. Fills that are narrow between lines are told apart from wide lines (narrow-fills.c), by the distance from the
 *    colour of lines if most have one.
 * 4. Strength: the contrast, divided by that of the core of the line.
 * 5. Where lines meet, and where strokes are thicker than most, they are wider than the window.  There, what has the
 *    colour of lines (line-tones.c) and fits into the widest window is a line as well (thick-lines.c).  If most lines
 *    have one colour, the distance from it finds them between dark fills, too.
 * 6. Where two fills meet without a line, one is drawn (fill-edges.c).
 * Large areas in the colour of lines remain fills, with their narrow parts (solid-areas.c): an artist can scribble on
 * them.  Sprites have lines that need no windows (sprite-lines.c).
 *
 * Cost: O(pixels), whatever the width of lines; 15 bytes a pixel.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/coloured-steps.h"

#include <stdlib.h>
#include <string.h>

#define GRAINLESS     2      /* noise up to this, of 255, comes from rounding; chosen */
#define FAINTEST_LINE 20     /* of 255: least contrast of the core of a line; chosen */
#define COMPRESSED    8      /* pixels: a block of JPEG */
#define TONE_ROWS     4      /* of which one is looked at for tones; chosen */
#define EDGE          2      /* pixels from the core of a line to its antialiased edge */

typedef struct
{
  const CeldHost *host;
  CeldMask        channel[3];
  CeldMask        closed, contrast, level;
  void           *work;        /* of celd_erode_bytes */
  int             widest;      /* radius of the widest window for thick strokes among thinner lines */
  int             broadest;    /* radius of the window for lines that are all broad */
  CeldLineTones   tones;
  bool            one_tone;    /* have most lines one colour, tone? */
  uint8_t         tone[3];
} Lines;

/* ------------------------------------------------------------------ work space */

static bool
new_mask (int width, int height, CeldMask *mask)
{
  *mask = (CeldMask) { width, height, (size_t) width, celd_alloc ((size_t) width * (size_t) height, 1) };
  return mask->data;
}

static CeldStatus
start_work (Lines *l, int width, int height)
{
  int shorter = width < height ? width : height;

  l->widest = shorter / 32 > 12 ? shorter / 32 : 12;
  l->broadest = shorter / 16 > 12 ? shorter / 16 : 12;
  l->work = celd_alloc (celd_erosion_work (width, 2 * l->broadest), 1);
  for (int c = 0; c < 3; c++)
    if (!new_mask (width, height, &l->channel[c]))
      return CELD_NO_MEMORY;
  return l->work && new_mask (width, height, &l->closed) && new_mask (width, height, &l->contrast) &&
         new_mask (width, height, &l->level) ? CELD_OK : CELD_NO_MEMORY;
}

static void
end_work (Lines *l)
{
  for (int c = 0; c < 3; c++)
    celd_free (l->channel[c].data);
  celd_free (l->closed.data);
  celd_free (l->contrast.data);
  celd_free (l->level.data);
  celd_free (l->work);
}

static CeldStatus
new_planes (const Lines *l, CeldPlane *a, CeldPlane *b)
{
  CeldStatus status = celd_plane_new (l->closed.width, l->closed.height, a);

  return status == CELD_OK ? celd_plane_new (l->closed.width, l->closed.height, b) : status;
}

static size_t
pixels (const Lines *l)
{
  return (size_t) l->closed.width * (size_t) l->closed.height;
}

CELD_CLONES static void
take_row (const uint8_t *restrict rgba, int n, uint8_t *restrict red, uint8_t *restrict green, uint8_t *restrict blue)
{
  for (int x = 0; x < n; x++)
    {
      unsigned alpha = rgba[4 * x + 3];

      red[x]   = (uint8_t) (255 - (255u - rgba[4 * x]) * alpha / 255);
      green[x] = (uint8_t) (255 - (255u - rgba[4 * x + 1]) * alpha / 255);
      blue[x]  = (uint8_t) (255 - (255u - rgba[4 * x + 2]) * alpha / 255);
    }
}

/* Composites the drawing on white. */
static void
take_channels (Lines *l, const CeldPaint *art)
{
  for (int y = 0; y < art->height; y++)
    take_row (CELD_RGBA (art, 0, y), art->width, &CELD_AT (&l->channel[0], 0, y), &CELD_AT (&l->channel[1], 0, y),
              &CELD_AT (&l->channel[2], 0, y));
}

/* ------------------------------------------------------------------ noise */

/* The standard deviation of grain, of 255: from the median second difference along rows of the green channel. */
static float
measure_noise (const Lines *l)
{
  size_t of[2 * 255 + 1] = { 0 }, all = 0, below = 0;
  int    difference = 0, apart = celd_ink_rows_apart (l->closed.width, l->closed.height);

  for (int y = apart / 2; y < l->closed.height; y += apart)
    for (int x = 1; x < l->closed.width - 1; x++)
      {
        const uint8_t *v = &CELD_AT (&l->channel[1], x, y);

        of[abs (v[-1] - 2 * v[0] + v[1])]++;
        all++;
      }
  while (2 * (below += of[difference]) < all)
    difference++;
  return (float) difference / (0.6745f * 2.4495f); /* as in celd_ink_noise */
}

/* Smooths grain in all channels. */
static CeldStatus
remove_noise (Lines *l)
{
  CeldPlane  smooth = { 0 }, spare = { 0 };
  CeldStatus status = new_planes (l, &smooth, &spare);

  for (int c = 0; c < 3 && status == CELD_OK; c++)
    {
      for (size_t i = 0; i < pixels (l); i++)
        smooth.data[i] = l->channel[c].data[i];
      celd_ink_smooth (&smooth, &spare);
      celd_ink_smooth (&smooth, &spare);
      for (size_t i = 0; i < pixels (l); i++)
        l->channel[c].data[i] = (uint8_t) (smooth.data[i] + 0.5f);
    }
  celd_free (smooth.data);
  celd_free (spare.data);
  return status;
}

/* ------------------------------------------------------------------ contrast */

/* Sets l->contrast for lines up to 2 radius + 1 wide. */
static CeldStatus
measure_contrast (Lines *l, int radius)
{
  CeldStatus status = CELD_OK;

  memset (l->contrast.data, 0, pixels (l));
  for (int c = 0; c < 3 && status == CELD_OK; c++)
    {
      celd_close_bytes (&l->channel[c], radius, l->work, &l->closed);
      celd_raise_contrast (l->channel[c].data, l->closed.data, pixels (l), l->contrast.data);
      status = celd_progress (l->host, 0.6 + 0.2 * (c + 1) / 3);
    }
  return status;
}

/* The least contrast of the core of a line: well above the grain, and above what compression leaves beside lines. */
static CeldStatus
find_faintest (Lines *l, int *faintest)
{
  CeldPlane  contrast;
  CeldStatus status = celd_plane_new (l->contrast.width, l->contrast.height, &contrast);
  float      least;
  int        apart = celd_ink_rows_apart (l->closed.width, l->closed.height);

  if (status != CELD_OK)
    return status;
  memcpy (l->closed.data, l->contrast.data, pixels (l));
  celd_dilate_bytes (&l->closed, COMPRESSED / 2, l->work);
  for (int y = 0; y < contrast.height; y++)
    if (abs (y % apart - apart / 2) <= 1) /* others are not looked at */
      for (int x = 0; x < contrast.width; x++)
        CELD_AT (&contrast, x, y) = CELD_AT (&l->contrast, x, y) / 255.0f;
  least     = celd_most (8 * celd_ink_noise (&contrast, 1), 6 * celd_ink_echo (&contrast, &l->closed, 1));
  *faintest = (int) celd_least (celd_most (255 * least, FAINTEST_LINE), 128);
  celd_free (contrast.data);
  return CELD_OK;
}

/* The largest contrast of a pixel and those around it. */
static int
most_around (const Lines *l, int x, int y)
{
  int most = 0;

  for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < l->contrast.height; v++)
    for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < l->contrast.width; u++)
      most = CELD_AT (&l->contrast, u, v) > most ? CELD_AT (&l->contrast, u, v) : most;
  return most;
}

/* Counts the tones of pixels with more contrast than those around: most of them are in lines. */
static void
count_tones (Lines *l, int faintest)
{
  for (int y = 0; y < l->contrast.height; y += TONE_ROWS)
    for (int left = 0; left < l->contrast.width; left += CELD_PIECE)
      {
        int right = left + celd_piece_at (left, l->contrast.width);

        if (celd_any_byte_reaches (&CELD_AT (&l->contrast, left, y), (size_t) (right - left), faintest)) /* few do */
          for (int x = left; x < right; x++)
            if (CELD_AT (&l->contrast, x, y) >= faintest && CELD_AT (&l->contrast, x, y) == most_around (l, x, y))
              celd_line_tone_count (&l->tones, l->channel, (size_t) y * l->contrast.stride + (size_t) x);
      }
}

/* If most lines have one colour, l->level, which holds the lightness, gets the distance from that colour: in it all
 * fills are lighter than lines. */
static void
measure_distance_from_lines (Lines *l, int faintest)
{
  count_tones (l, faintest);
  l->one_tone = celd_main_line_tone (&l->tones, l->tone);
  if (l->one_tone)
    celd_tone_distance (l->channel, l->tone, pixels (l), l->level.data);
  memset (&l->tones, 0, sizeof l->tones);
}

/* Takes what lies narrow between lines out of the contrast.  l->level holds the lightness, or the distance from lines,
 * and is overwritten. */
static CeldStatus
clear_narrow_fills (Lines *l, int radius, int faintest)
{
  CeldMask fill;

  if (!new_mask (l->closed.width, l->closed.height, &fill))
    return CELD_NO_MEMORY;
  celd_clear_narrow_fills (&l->level, radius, faintest, l->work, &l->closed, &fill, &l->contrast);
  celd_free (fill.data);
  return CELD_OK;
}

/* ------------------------------------------------------------------ strength */

/* If the pixel is in the middle of a line, sets l->level to its contrast, and counts its tone where that is of the line
 * alone.  None around has much more contrast (lines under a pixel wide are paler where they lie between two rows of
 * pixels), and none within the window has very much more. */
static void
take_core (Lines *l, int x, int y, int faintest)
{
  int c = CELD_AT (&l->contrast, x, y), most;

  if (c < faintest || 5 * c < 3 * CELD_AT (&l->closed, x, y))
    return;
  most = most_around (l, x, y);
  if (5 * c < 4 * most)
    return;
  CELD_AT (&l->level, x, y) = (uint8_t) c;
  if (c == most)
    celd_line_tone_count (&l->tones, l->channel, (size_t) y * l->level.stride + (size_t) x);
}

/* Sets l->level to the contrast of the core of a line at each pixel next to one, and counts the tones of cores. */
static void
find_cores (Lines *l, int radius, int faintest)
{
  memcpy (l->closed.data, l->contrast.data, pixels (l));
  celd_dilate_bytes (&l->closed, radius, l->work);
  memset (l->level.data, 0, pixels (l));
  for (int y = 0; y < l->level.height; y++)
    for (int left = 0; left < l->level.width; left += CELD_PIECE)
      {
        int right = left + celd_piece_at (left, l->level.width);

        if (celd_any_byte_reaches (&CELD_AT (&l->contrast, left, y), (size_t) (right - left), faintest)) /* few do */
          for (int x = left; x < right; x++)
            take_core (l, x, y, faintest);
      }
  celd_dilate_bytes (&l->level, 1, l->work);
}

CELD_CLONES static void
keep_where_level (const uint8_t *restrict level, const uint8_t *restrict value, size_t n, uint8_t *restrict raised)
{
  for (size_t i = 0; i < n; i++)
    {
      uint8_t keep = level[i] ? 255 : 0;

      raised[i] = (uint8_t) ((raised[i] & keep) | (value[i] & ~keep));
    }
}

/* Between fills that differ, closing finds the darker one.  For antialiased pixels on the lighter side, which may be
 * lighter than that, the paper is the lightest pixel next to them. */
static void
raise_edges (Lines *l)
{
  for (int c = 0; c < 3; c++)
    {
      memcpy (l->closed.data, l->channel[c].data, pixels (l));
      celd_dilate_bytes (&l->closed, 1, l->work);
      for (size_t i = 0, n; i < pixels (l); i += n)
        {
          n = pixels (l) - i < CELD_PIECE ? pixels (l) - i : CELD_PIECE;
          if (celd_any_byte_reaches (l->level.data + i, n, 1)) /* few do */
            {
              keep_where_level (l->level.data + i, l->channel[c].data + i, n, l->closed.data + i);
              celd_raise_contrast (l->channel[c].data + i, l->closed.data + i, n, l->contrast.data + i);
            }
        }
    }
  celd_dilate_bytes (&l->level, EDGE - 1, l->work);
}

CELD_CLONES static void
write_strengths (const uint8_t *restrict strength, int n, float *restrict luma)
{
  for (int x = 0; x < n; x++)
    luma[x] = 1 - strength[x] / 255.0f;
}

/* Sets l->contrast to where thick strokes are, and what is as wide where lines meet. */
static CeldStatus
find_thick_lines (Lines *l, int radius, int faintest, const CeldHost *host)
{
  CeldMask   distance = { 0 };
  CeldStatus status = !l->one_tone || new_mask (l->closed.width, l->closed.height, &distance) ? CELD_OK
                                                                                            : CELD_NO_MEMORY;

  if (status == CELD_OK && l->one_tone)
    celd_tone_distance (l->channel, l->tone, pixels (l), distance.data);
  if (status == CELD_OK)
    status = celd_thick_lines (l->channel, l->one_tone ? &distance : NULL,
                               radius > l->widest / 2 ? 2 * radius : l->widest, faintest, host, l->work, &l->closed,
                               &l->contrast);
  celd_free (distance.data);
  return status;
}

/* Writes thick strokes: n pixels from (x,y) on. */
static void
write_thick (const Lines *l, int x, int y, int n, float *luma)
{
  const uint8_t *thick = &CELD_AT (&l->contrast, x, y);

  if (celd_any_byte_reaches (thick, (size_t) n, 1))
    for (int i = 0; i < n; i++)
      luma[i] = thick[i] ? 0 : luma[i];
}

/* Writes the lines by their strengths, and thick strokes. */
static void
write_lines (Lines *l, CeldDrawing *drawing)
{
  int width = drawing->luma.width;

  for (int y = 0; y < drawing->luma.height; y++)
    {
      write_strengths (&CELD_AT (&l->level, 0, y), width, &CELD_AT (&drawing->luma, 0, y));
      for (int x = 0; x < width; x += CELD_PIECE)
        write_thick (l, x, y, celd_piece_at (x, width), &CELD_AT (&drawing->luma, x, y));
      if (drawing->alpha.data)
        for (int x = 0; x < width; x++)
          CELD_AT (&drawing->alpha, x, y) = 1;
    }
}

static CeldStatus
find_lines (Lines *l, CeldDrawing *drawing)
{
  CeldHostPart part[2];
  CeldHost     first = celd_host_part (&part[0], l->host, 0, 0.6), last = celd_host_part (&part[1], l->host, 0.8, 1);
  int          radius, faintest;
  CeldStatus   status = measure_noise (l) > GRAINLESS ? remove_noise (l) : CELD_OK;

  if (status == CELD_OK)
    status = celd_line_window (l->channel, l->broadest, &first, l->work, &l->closed, &l->contrast, &l->level,
                               &radius);
  if (status == CELD_OK)
    status = measure_contrast (l, radius);
  if (status == CELD_OK)
    status = find_faintest (l, &faintest);
  if (status != CELD_OK)
    return status;
  measure_distance_from_lines (l, faintest);
  status = clear_narrow_fills (l, radius, faintest);
  if (status != CELD_OK)
    return status;
  find_cores (l, radius, faintest);
  celd_line_tones_blur (&l->tones);
  raise_edges (l);
  celd_line_strengths (l->contrast.data, faintest, pixels (l), l->level.data);
  status = find_thick_lines (l, radius, faintest, &last);
  if (status == CELD_OK)
    {
      celd_leave_solid_areas (l->channel, &l->tones, &l->level, &l->contrast);
      write_lines (l, drawing);
      celd_draw_fill_edges (l->channel, &l->level, faintest, &l->closed, &drawing->luma);
    }
  return status;
}

CeldStatus
celd_coloured_lines (const CeldPaint *art, CeldInkMode mode, const CeldHost *host, CeldDrawing *drawing)
{
  Lines     *l;
  CeldStatus status;

  if (!CELD_SAME_SIZE (art, &drawing->luma))
    return CELD_BAD_SIZE;
  if (mode != CELD_INK_LINES && mode != CELD_INK_AUTO)
    return CELD_OK;
  if (mode == CELD_INK_AUTO && celd_is_line_layer (drawing))
    return CELD_OK;
  l = celd_alloc (1, sizeof *l);
  if (!l)
    return CELD_NO_MEMORY;
  *l     = (Lines) { .host = host };
  status = start_work (l, art->width, art->height);
  if (status == CELD_OK)
    {
      take_channels (l, art);
      if (celd_sprite_lines (l->channel, mode == CELD_INK_AUTO, l->work, &l->closed, &l->level))
        {
          memset (l->contrast.data, 0, pixels (l)); /* there are no thick strokes besides */
          status = celd_progress (host, 0.9);
          if (status == CELD_OK)
            write_lines (l, drawing);
        }
      else if (mode == CELD_INK_LINES || celd_is_coloured (l->channel) || celd_has_grey_fills (l->channel))
        status = find_lines (l, drawing);
    }
  end_work (l);
  celd_free (l);
  return status;
}
