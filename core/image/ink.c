/* Line art of a drawing: ink 0, paper 1, whatever the drawing was made with.
 *
 * 1. One value a pixel, and its contrast against the paper around (paper.c).
 * 2. Noise: median second differences at three scales (ink-noise.c).  It is smoothed, along lines and edges where there
 *    are any (ink-lines.c).  A drawing without noise is not smoothed, and
 *    clean black on white comes out as it went in: its antialiasing says where between two pixels a contour lies.
 * 3. Ink: the contrast, divided by that of the drawing's dark strokes, or of the stroke itself where that is pale:
 *    LazyBrush [SDC09b] uses the response of a LoG filter for the same purpose, to keep faint contours.  Here a stroke
 *    is what a grey opening removes, so that flat grey areas keep their grey.
 * 4. In a noisy drawing, bands of paper between lines are opened (ink-bands.c), and holes of grain in ink are filled
 *    (ink-grain.c); in one without noise, lines of one pixel that lie between two rows of pixels are closed
 *    (ink-hairlines.c).
 *
 * Cost: O(pixels), independent of the width of strokes; 6 bytes a pixel, 13 if there is noise, 14 if there are bands.
 * What is taken from windows (levels, areas) is kept in bytes, in 255ths: finer steps would not be seen.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/ink-steps.h"

#include <math.h>
#include <string.h>

#define FAINTEST      0.05f   /* least contrast of a stroke; chosen: yellow on white has 0.07 */
#define NOISELESS     0.003f  /* noise below this comes from rounding to 8 bits */
#define NEAR_CLEAN    5       /* pixels: a pale line so near to a dark one may be its antialiased tip; chosen */
#define NEAR_NOISY    2       /* pixels from the core of a pencil line to its edge; chosen */
#define ROW_PART      1024    /* pixels of a row that are written at a time; chosen */
#define DRAWN         0.25f   /* of the contrast of dark strokes, by which broad strokes are measured; chosen */
#define BROAD_STEP    4       /* every so many pixels are enough for that */
#define INK_PASSES    13      /* over the picture in the longest case, of about the same duration: for progress */

typedef struct
{
  const CeldHost *host;
  int             passes;        /* finished so far */
  size_t          pixels;
  int             widest;        /* half width of the widest stroke */
  CeldPlane       contrast;      /* against the paper: 0 .. 1 */
  CeldMask        area;          /* contrast without strokes, 0 .. 255: its grey opening; made if some are pale */
  CeldMask        level;         /* contrast of the dark core of the stroke at the pixel, 0 .. 255; 0: unknown */
  void           *lines;         /* work space of celd_erode_bytes */
  float           noise;         /* of the paper */
  bool            noisy;         /* by more than rounding */
  float           faintest;      /* least contrast of a stroke */
  float           dark;          /* contrast of the dark strokes */
} InkWork;

/* Reports that one more pass over the picture is finished. */
static CeldStatus
pass_done (InkWork *w)
{
  return celd_progress (w->host, (double) ++w->passes / INK_PASSES);
}

/* ------------------------------------------------------------------ ink */

CELD_CLONES static bool
any_reaches (const float *value, int n, float least)
{
  int any = 0;

  for (int i = 0; i < n; i++)
    any |= value[i] >= least;
  return any;
}

/* The contrast that 2 % of the inked pixels exceed, exact if these have one value; 1 if there is no ink. */
static float
dark_level (const InkWork *w)
{
  size_t of[CELD_INK_BINS] = { 0 }, all = 0, above = 0;
  double sum[CELD_INK_BINS] = { 0 };
  int    bin = CELD_INK_BINS - 1;

  for (int y = 0; y < w->contrast.height; y++)
    for (int left = 0, n; left < w->contrast.width; left += n)
      {
        const float *contrast = &CELD_AT (&w->contrast, left, y);

        n = celd_piece_at (left, w->contrast.width);
        if (any_reaches (contrast, n, w->faintest)) /* few do */
          for (int k = 0; k < n; k++)
            if (contrast[k] >= w->faintest)
              {
                int i = (int) (contrast[k] * (CELD_INK_BINS - 1) + 0.5f);

                of[i]++;
                sum[i] += contrast[k];
                all++;
              }
      }
  if (!all)
    return 1;
  while (50 * (above += of[bin]) < all)
    bin--;
  return (float) (sum[bin] / (double) of[bin]);
}

static CeldStatus
start_work (int width, int height, InkWork *w)
{
  int shorter = width < height ? width : height;

  w->pixels = (size_t) width * (size_t) height;
  w->widest = shorter / 32 > 12 ? shorter / 32 : 12;
  w->lines = celd_alloc (celd_erosion_work (width, w->widest), 1);
  w->level = (CeldMask) { width, height, (size_t) width, celd_alloc (w->pixels, 1) };
  if (!w->lines || !w->level.data)
    return CELD_NO_MEMORY;
  return celd_plane_new (width, height, &w->contrast);
}

static void
end_work (InkWork *w)
{
  celd_free (w->contrast.data);
  celd_free (w->area.data);
  celd_free (w->level.data);
  celd_free (w->lines);
}

/* 1 - reflectance relative to the paper. */
static CeldStatus
measure_contrast (InkWork *w, const CeldDrawing *drawing, CeldInkMode mode)
{
  CeldStatus status;

  celd_ink_values (drawing, celd_ink_mode (drawing, mode), &w->contrast);
  status = pass_done (w);
  if (status == CELD_OK)
    status = celd_paper_contrast (&w->contrast);
  return status == CELD_OK ? pass_done (w) : status;
}

/* Sets w->noise to the largest at the scales step, 4 step, ... up to 16 pixels. */
static CeldStatus
measure_noise (InkWork *w, int step)
{
  CeldStatus status = CELD_OK;

  for (w->noise = 0; step <= 16 && status == CELD_OK; step *= 4)
    {
      w->noise = celd_most (w->noise, celd_ink_noise (&w->contrast, step));
      status = pass_done (w);
    }
  return status;
}

static CeldStatus
smooth (InkWork *w)
{
  int        width = w->contrast.width, height = w->contrast.height;
  CeldPlane  grainy = { 0 }, spare = { 0 };
  CeldStatus status = celd_plane_new (width, height, &grainy);

  if (status == CELD_OK)
    status = celd_plane_new (width, height, &spare);
  if (status == CELD_OK)
    {
      memcpy (grainy.data, w->contrast.data, w->pixels * sizeof (float));
      celd_ink_smooth (&w->contrast, &spare);
      celd_ink_smooth (&w->contrast, &spare);
    }
  celd_free (spare.data);
  if (status == CELD_OK)
    status = celd_ink_smooth_lines (&grainy, w->noise, &w->contrast);
  celd_free (grainy.data);
  return status == CELD_OK ? pass_done (w) : status;
}

/* Smooths grain and subtracts the noise from the contrast, because the paper level is that of light grain, so that
 * paper has a contrast of about the noise.  Afterwards w->noise is the noise that smoothing leaves: a quarter of fine
 * grain, all of stains up to 16 pixels across. */
static CeldStatus
remove_noise (InkWork *w)
{
  CeldStatus status = measure_noise (w, 1);
  float      zero;

  w->noisy = w->noise > NOISELESS;
  if (status != CELD_OK || !w->noisy)
    return status;
  zero = celd_least (2 * w->noise, 0.5f);
  status = smooth (w);
  if (status == CELD_OK)
    status = measure_noise (w, 4); /* at scales wider than the filter, which reduces differences at its own scale */
  for (size_t i = 0; i < w->pixels && status == CELD_OK; i++)
    w->contrast.data[i] = celd_most (w->contrast.data[i] - zero, 0) / (1 - zero);
  return status == CELD_OK ? pass_done (w) : status;
}

static int
near_lines (const InkWork *w)
{
  return w->noisy ? NEAR_NOISY : NEAR_CLEAN;
}

CELD_CLONES static void
round_to_bytes (const float *restrict contrast, size_t n, uint8_t *restrict byte)
{
  for (size_t i = 0; i < n; i++)
    byte[i] = (uint8_t) (255 * contrast[i] + 0.5f);
}

/* Sets w->faintest and w->dark, and w->level to the largest contrast nearby.  In a noisy drawing the contrast of ink
 * must be well above the noise, so that empty paper stays empty. */
static CeldStatus
measure_ink (InkWork *w)
{
  CeldStatus status;

  w->faintest = celd_most (FAINTEST, 8 * w->noise);
  w->dark = dark_level (w);
  round_to_bytes (w->contrast.data, w->pixels, w->level.data);
  celd_dilate_bytes (&w->level, near_lines (w), w->lines);
  status = pass_done (w);
  if (status != CELD_OK)
    return status;
  if (w->noisy)
    {
      w->dark = celd_most (w->dark, 16 * w->noise);
      w->faintest = celd_most (w->faintest, 0.14f * w->dark);
    }
  else
    w->faintest = celd_most (w->faintest, 6 * celd_ink_echo (&w->contrast, &w->level, w->dark));
  if (w->dark > 0.9f && !w->noisy)
    w->dark = 1; /* black lines a pixel wide or less are not quite black anywhere */
  return CELD_OK;
}

/* Where nearly all that is drawn is dark, strokes may be much broader than usual: a broad pencil is pale in places, which
 * are no areas for that.  Grey areas would be paler than most. */
static CeldStatus
measure_widest (InkWork *w)
{
  int        shorter = w->contrast.width < w->contrast.height ? w->contrast.width : w->contrast.height;
  float      drawn = celd_most (w->faintest, DRAWN * w->dark);
  size_t     all = 0, dark = 0;
  CeldPlane  ink;
  CeldStatus status = celd_plane_new ((w->contrast.width + BROAD_STEP - 1) / BROAD_STEP,
                                      (w->contrast.height + BROAD_STEP - 1) / BROAD_STEP, &ink);
  int        stroke;

  if (status != CELD_OK)
    return status;
  for (int y = 0; y < ink.height; y++)
    for (int x = 0; x < ink.width; x++)
      {
        float contrast = CELD_AT (&w->contrast, BROAD_STEP * x, BROAD_STEP * y);

        CELD_AT (&ink, x, y) = contrast < drawn;
        all += contrast >= drawn;
        dark += contrast >= 0.5f * w->dark;
      }
  stroke = BROAD_STEP * celd_stroke_width (&ink);
  stroke = stroke < shorter / 4 ? stroke : shorter / 4;
  celd_free (ink.data);
  if (4 * dark < 3 * all || stroke <= w->widest)
    return CELD_OK;
  w->widest = stroke;
  celd_free (w->lines);
  w->lines = celd_alloc (celd_erosion_work (w->contrast.width, w->widest), 1);
  return w->lines ? CELD_OK : CELD_NO_MEMORY;
}

/* Whether a pixel shows how dark its stroke is.  Without noise a grey one may be the antialiased edge of a black
 * stroke, unless it is inside a grey stroke, on a line thinner than a pixel, or nothing dark is near.  `around` is the
 * largest contrast near it. */
static bool
shows_level (const InkWork *w, int x, int y, float around)
{
  float c = CELD_AT (&w->contrast, x, y);

  if (c < w->faintest || w->noisy)
    return c >= w->faintest;
  return around < 0.45f * w->dark ||
         (c < 0.75f * w->dark && celd_ink_shows_level (&w->contrast, x, y, w->dark));
}

/* Keeps in w->level those of n pixels from (left,y) on that show how dark their stroke is; returns whether some strokes
 * are pale. */
static bool
find_levels_of_piece (InkWork *w, int left, int y, int n)
{
  bool pale = false;

  for (int x = left; x < left + n; x++)
    {
      float    c = CELD_AT (&w->contrast, x, y);
      uint8_t *level = &CELD_AT (&w->level, x, y);
      bool     shown = shows_level (w, x, y, *level / 255.0f);

      *level = shown ? (uint8_t) (255 * c + 0.5f) : 0;
      pale = pale || (shown && c < 0.95f * w->dark);
    }
  return pale;
}

/* The same for all pixels. */
static bool
find_levels (InkWork *w)
{
  bool pale = false;

  for (int y = 0; y < w->level.height; y++)
    for (int left = 0, n; left < w->level.width; left += n)
      {
        n = celd_piece_at (left, w->level.width);
        if (any_reaches (&CELD_AT (&w->contrast, left, y), n, w->faintest)) /* few do */
          pale = find_levels_of_piece (w, left, y, n) || pale;
        else
          memset (&CELD_AT (&w->level, left, y), 0, (size_t) n);
      }
  return pale;
}

/* Forgets levels that are an area's. */
CELD_CLONES static void
keep_strokes (const float *restrict contrast, const uint8_t *restrict area, float faintest, size_t n,
              uint8_t *restrict level)
{
  for (size_t i = 0; i < n; i++)
    {
      bool stroke = contrast[i] - area[i] * (1 / 255.0f) >= celd_most (faintest, 0.5f * contrast[i]);

      level[i] = stroke ? level[i] : 0;
    }
}

/* Makes w->area, and extends w->level over the full width of each stroke. */
static CeldStatus
spread_levels (InkWork *w)
{
  CeldStatus status;

  w->area = (CeldMask) { w->level.width, w->level.height, w->level.stride, celd_alloc (w->pixels, 1) };
  if (!w->area.data)
    return CELD_NO_MEMORY;
  round_to_bytes (w->contrast.data, w->pixels, w->area.data);
  celd_erode_bytes (&w->area, w->widest, w->lines);
  status = pass_done (w);
  if (status != CELD_OK)
    return status;
  celd_dilate_bytes (&w->area, w->widest, w->lines);
  status = pass_done (w);
  if (status != CELD_OK)
    return status;
  keep_strokes (w->contrast.data, w->area.data, w->faintest, w->pixels, w->level.data);
  celd_dilate_bytes (&w->level, near_lines (w), w->lines);
  return pass_done (w);
}

/* Ink by the contrast of the drawing's dark strokes. */
CELD_CLONES static void
write_dark (const float *restrict contrast, float dark, int n, float *restrict ink)
{
  for (int x = 0; x < n; x++)
    ink[x] = 1 - celd_least (contrast[x] / dark, 1);
}

/* Darkens ink where a stroke is pale, to what its own level makes of it; where there is no level, it stays.  `full` is
 * the fraction of its level from which a stroke is full ink. */
CELD_CLONES static void
darken_pale (const float *restrict contrast, const uint8_t *restrict area, const uint8_t *restrict level, float full,
            int n, float *restrict ink)
{
  for (int x = 0; x < n; x++)
    {
      float own = level[x] * (1 / 255.0f), most = full * celd_most (own, 1e-3f);
      float share = (contrast[x] - area[x] * (1 / 255.0f)) / most;
      bool  edge = contrast[x] > 1.05f * own; /* of a darker stroke, or not near a pale one */

      ink[x] = edge ? ink[x] : celd_least (ink[x], 1 - celd_least (share, 1));
    }
}

/* Darkens the ink of n pixels from (left,y) on, of a drawing with pale strokes. */
static void
write_pale (const InkWork *w, int left, int y, int n, float *ink)
{
  static const uint8_t unknown[CELD_PIECE] = { 0 };
  float                full = w->noisy ? 0.8f : 1; /* because of grain */

  for (int i = 0, m; i < n; i += m)
    {
      int            x = left + i;
      const uint8_t *level = &CELD_AT (&w->level, x, y);

      m = celd_piece_at (i, n);
      if (memcmp (level, unknown, (size_t) m)) /* most are */
        darken_pale (&CELD_AT (&w->contrast, x, y), &CELD_AT (&w->area, x, y), level, full, m, ink + i);
    }
}

/* `ink` may be the plane of the contrast. */
static void
write_ink (const InkWork *w, bool pale, CeldPlane *ink)
{
  float part[ROW_PART];

  for (int y = 0; y < ink->height; y++)
    for (int x = 0, n; x < ink->width; x += n)
      {
        n = ink->width - x < ROW_PART ? ink->width - x : ROW_PART;
        write_dark (&CELD_AT (&w->contrast, x, y), w->dark, n, part);
        if (pale)
          write_pale (w, x, y, n, part);
        memcpy (&CELD_AT (ink, x, y), part, (size_t) n * sizeof *part);
      }
}

/* The ink of a noisy drawing, with bands and grain mended.  It takes the place of the contrast first, so that the
 * result stays as it was if memory fails. */
static CeldStatus
write_noisy_ink (InkWork *w, bool pale, CeldPlane *ink)
{
  CeldStatus status;

  write_ink (w, pale, &w->contrast);
  status = celd_ink_part_lines (&w->contrast, &w->level);
  if (status != CELD_OK)
    return status;
  celd_ink_fill_grain (&w->contrast, &w->level);
  for (int y = 0; y < ink->height; y++)
    memcpy (&CELD_AT (ink, 0, y), &CELD_AT (&w->contrast, 0, y), (size_t) ink->width * sizeof *ink->data);
  return CELD_OK;
}

CeldStatus
celd_ink (const CeldDrawing *drawing, CeldInkMode mode, const CeldHost *host, CeldPlane *ink)
{
  InkWork    w = { .host = host };
  bool       pale = false;
  CeldStatus status;

  if (!CELD_SAME_SIZE (&drawing->luma, ink) || (drawing->alpha.data && !CELD_SAME_SIZE (&drawing->alpha, ink)))
    return CELD_BAD_SIZE;
  status = start_work (ink->width, ink->height, &w);
  if (status == CELD_OK)
    status = measure_contrast (&w, drawing, mode);
  if (status == CELD_OK)
    status = remove_noise (&w);
  if (status == CELD_OK)
    status = measure_ink (&w);
  if (status == CELD_OK && w.noisy)
    status = measure_widest (&w);
  if (status == CELD_OK)
    {
      pale = find_levels (&w);
      status = pale ? spread_levels (&w) : CELD_OK;
    }
  if (status == CELD_OK && w.noisy)
    status = write_noisy_ink (&w, pale, ink);
  else if (status == CELD_OK)
    {
      write_ink (&w, pale, ink);
      celd_ink_join_hairlines (ink);
    }
  end_work (&w);
  return status;
}

bool
celd_ink_has_lines (const CeldPlane *ink)
{
  bool lines = false, paper = false;

  for (int y = 0; y < ink->height && !(lines && paper); y++)
    for (int x = 0; x < ink->width; x++)
      {
        bool dark = CELD_AT (ink, x, y) < 0.5f;

        lines = lines || dark;
        paper = paper || !dark;
      }
  return lines && paper;
}
