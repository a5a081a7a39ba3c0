/* Line art of a drawing: ink 0, paper 1, whatever the drawing was made with.
 *
 * 1. One value a pixel, and its contrast against the paper around (paper.c).
 * 2. Noise: median second differences at three scales (ink-noise.c).  It is smoothed, along lines and edges where there
 *    are any (ink-lines.c).  A drawing without noise is not smoothed, and
 *    clean black on white comes out as it went in: its antialiasing says where between two pixels a contour lies.
 * 3. Ink: the contrast, divided by that of the drawing's dark strokes, or of the stroke itself where that is pale:
 *    LazyBrush [SDC09b] uses the response of a LoG filter for the same purpose, to keep faint contours.  Here a stroke
 *    is what a grey opening removes, so that flat grey areas keep their grey.
 *
 * Cost: O(pixels), independent of the width of strokes; 16 bytes a pixel, 20 if there is noise.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"

#include <math.h>
#include <string.h>

#define FAINTEST      0.05f   /* least contrast of a stroke; chosen: yellow on white has 0.07 */
#define NOISELESS     0.003f  /* noise below this comes from rounding to 8 bits */
#define NEAR_CLEAN    5       /* pixels: a pale line so near to a dark one may be its antialiased tip; chosen */
#define NEAR_NOISY    2       /* pixels from the core of a pencil line to its edge; chosen */
#define INK_PASSES    17      /* over the picture in the longest case, of about the same duration: for progress */

typedef struct
{
  const CeldHost *host;
  int             passes;        /* finished so far */
  size_t          pixels;
  int             widest;        /* half width of the widest stroke */
  CeldPlane       contrast;      /* against the paper: 0 .. 1 */
  CeldPlane       area;          /* contrast without strokes: its grey opening */
  CeldPlane       level;         /* contrast of the dark core of the stroke at the pixel; 0: unknown */
  CeldPlane       spare;
  void           *lines;         /* work space of celd_erode */
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

/* ------------------------------------------------------------------ grey morphology with square windows */

static CeldStatus
erode (InkWork *w, CeldPlane *plane, int radius)
{
  celd_erode (plane, radius, w->lines);
  w->passes++; /* it takes as long as two others */
  return pass_done (w);
}

static void
negate (CeldPlane *plane)
{
  size_t n = (size_t) plane->width * (size_t) plane->height;

  for (size_t i = 0; i < n; i++)
    plane->data[i] = -plane->data[i];
}

static CeldStatus
dilate (InkWork *w, CeldPlane *plane, int radius)
{
  CeldStatus status;

  negate (plane);
  status = erode (w, plane, radius);
  negate (plane);
  return status;
}

/* ------------------------------------------------------------------ ink */

/* The contrast that 2 % of the inked pixels exceed, exact if these have one value; 1 if there is no ink. */
static float
dark_level (const CeldPlane *contrast, float faintest)
{
  size_t of[CELD_INK_BINS] = { 0 }, all = 0, above = 0;
  double sum[CELD_INK_BINS] = { 0 };
  int    bin = CELD_INK_BINS - 1;

  for (int y = 0; y < contrast->height; y++)
    for (int x = 0; x < contrast->width; x++)
      {
        float c = CELD_AT (contrast, x, y);
        int   i = (int) (c * (CELD_INK_BINS - 1) + 0.5f);

        if (c < faintest)
          continue;
        of[i]++;
        sum[i] += c;
        all++;
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
  w->lines = celd_alloc (celd_erosion_work (width, height, w->widest), 1);
  if (!w->lines || celd_plane_new (width, height, &w->contrast) != CELD_OK ||
      celd_plane_new (width, height, &w->area) != CELD_OK || celd_plane_new (width, height, &w->level) != CELD_OK)
    return CELD_NO_MEMORY;
  return celd_plane_new (width, height, &w->spare);
}

static void
end_work (InkWork *w)
{
  celd_free (w->contrast.data);
  celd_free (w->area.data);
  celd_free (w->level.data);
  celd_free (w->spare.data);
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
    status = celd_paper_levels (&w->contrast, &w->level);
  for (size_t i = 0; i < w->pixels && status == CELD_OK; i++)
    w->contrast.data[i] = celd_most (1 - w->contrast.data[i] / w->level.data[i], 0);
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
  memcpy (w->area.data, w->contrast.data, w->pixels * sizeof (float));
  celd_ink_smooth (&w->contrast, &w->spare);
  celd_ink_smooth (&w->contrast, &w->spare);
  status = celd_ink_smooth_lines (&w->area, w->noise, &w->contrast);
  if (status == CELD_OK)
    status = pass_done (w);
  if (status != CELD_OK)
    return status;
  zero = celd_least (2 * w->noise, 0.5f);
  status = measure_noise (w, 4); /* at scales wider than the filter, which reduces differences at its own scale */
  for (size_t i = 0; i < w->pixels && status == CELD_OK; i++)
    w->contrast.data[i] = celd_most (w->contrast.data[i] - zero, 0) / (1 - zero);
  return status == CELD_OK ? pass_done (w) : status;
}

/* Sets w->faintest and w->dark, and w->level to the largest contrast nearby.  In a noisy drawing the contrast of ink
 * must be well above the noise, so that empty paper stays empty. */
static CeldStatus
measure_ink (InkWork *w)
{
  CeldStatus status;

  w->faintest = celd_most (FAINTEST, 8 * w->noise);
  w->dark = dark_level (&w->contrast, w->faintest);
  memcpy (w->level.data, w->contrast.data, w->pixels * sizeof (float));
  status = dilate (w, &w->level, w->noisy ? NEAR_NOISY : NEAR_CLEAN);
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

/* Whether the pixel is inside a stroke, not on its antialiased edge: its 3x3 neighbours differ by a tenth at most. */
static bool
is_solid (const CeldPlane *contrast, int x, int y)
{
  float c = CELD_AT (contrast, x, y);

  for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < contrast->height; v++)
    for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < contrast->width; u++)
      if (fabsf (CELD_AT (contrast, u, v) - c) > 0.1f * c)
        return false;
  return true;
}

/* The contrast at a pixel, or at the one nearest to it in the picture. */
static float
nearest_contrast (const CeldPlane *contrast, int x, int y)
{
  x = x < 0 ? 0 : x < contrast->width ? x : contrast->width - 1;
  y = y < 0 ? 0 : y < contrast->height ? y : contrast->height - 1;
  return CELD_AT (contrast, x, y);
}

/* Whether the pixel is on a line thinner than a pixel, which is pale because it covers its pixels in part: there is paper
 * on both sides, what lies between them has less ink than a black line a pixel wide, and nothing around is much darker,
 * so that it is not at the end or the corner of a dark stroke. */
static bool
is_hairline (const CeldPlane *contrast, int x, int y, float dark)
{
  static const struct { int x, y; float apart; } across[] = { { 1, 0, 1 }, { 0, 1, 1 },
                                                              { 1, 1, 1.414f }, { 1, -1, 1.414f } };
  float c = CELD_AT (contrast, x, y);

  for (int v = -2; v <= 2; v++)
    for (int u = -2; u <= 2; u++)
      if (c < 0.6f * nearest_contrast (contrast, x + u, y + v))
        return false;
  for (int i = 0; i < 4; i++)
    {
      int   u = across[i].x, v = across[i].y;
      float before = nearest_contrast (contrast, x - u, y - v), after = nearest_contrast (contrast, x + u, y + v);

      if (celd_most (before, after) <= c && across[i].apart * (before + c + after) < 0.8f * dark &&
          nearest_contrast (contrast, x - 2 * u, y - 2 * v) < 0.25f * c &&
          nearest_contrast (contrast, x + 2 * u, y + 2 * v) < 0.25f * c)
        return true;
    }
  return false;
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
         (c < 0.75f * w->dark && (is_solid (&w->contrast, x, y) || is_hairline (&w->contrast, x, y, w->dark)));
}

/* Keeps in w->level the pixels that show how dark their stroke is; returns whether some strokes are pale. */
static bool
find_levels (InkWork *w)
{
  bool pale = false;

  for (int y = 0; y < w->level.height; y++)
    for (int x = 0; x < w->level.width; x++)
      {
        float c = CELD_AT (&w->contrast, x, y), *level = &CELD_AT (&w->level, x, y);

        *level = shows_level (w, x, y, *level) ? c : 0;
        pale = pale || (*level > 0 && c < 0.95f * w->dark);
      }
  return pale;
}

/* Fills in w->area, and extends w->level over the full width of each stroke. */
static CeldStatus
spread_levels (InkWork *w)
{
  CeldStatus status;

  memcpy (w->area.data, w->contrast.data, w->pixels * sizeof (float));
  status = erode (w, &w->area, w->widest);
  if (status == CELD_OK)
    status = dilate (w, &w->area, w->widest);
  for (size_t i = 0; i < w->pixels; i++)
    if (w->contrast.data[i] - w->area.data[i] < celd_most (w->faintest, 0.5f * w->contrast.data[i]))
      w->level.data[i] = 0;
  return status == CELD_OK ? dilate (w, &w->level, w->noisy ? NEAR_NOISY : NEAR_CLEAN) : status;
}

static void
write_ink (const InkWork *w, bool pale, CeldPlane *ink)
{
  float full = w->noisy ? 0.8f : 1; /* fraction of its level from which a stroke is full ink in spite of grain */

  for (int y = 0; y < ink->height; y++)
    for (int x = 0; x < ink->width; x++)
      {
        size_t i = (size_t) y * (size_t) ink->width + (size_t) x;
        float  c = w->contrast.data[i], share = c / w->dark;

        if (pale && w->level.data[i] > 0 && c <= 1.05f * w->level.data[i]) /* not the edge of a darker stroke */
          share = celd_most (share, (c - w->area.data[i]) / (full * w->level.data[i]));
        CELD_AT (ink, x, y) = 1 - celd_least (share, 1);
      }
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
  if (status == CELD_OK)
    {
      pale = find_levels (&w);
      status = pale ? spread_levels (&w) : CELD_OK;
    }
  if (status == CELD_OK)
    write_ink (&w, pale, ink);
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
