/* Line art of a drawing: ink 0, paper 1, whatever the drawing was made with.
 *
 * 1. One value a pixel, 1 = paper: composited on paper, polarity resolved (`auto` below).
 * 2. Paper: a high quantile in each tile; tiles without paper (solid black) are filled in from those around; bilinear.
 * 3. Noise: the median second difference.  A drawing without noise is not smoothed, and clean black on white comes out
 *    as it went in: its antialiasing says where between two pixels a contour lies.
 * 4. Ink: contrast against the paper, divided by that of the drawing's dark strokes, or of the stroke itself where this
 *    is pale: LazyBrush [SDC09b] takes the response of a LoG filter for the same end, so that a faint contour is one.
 *    Here a stroke is what a grey opening removes, so that flat grey areas stay as grey as they are.
 * Cost: O(pixels), 20 bytes a pixel.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "private.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define BINS 256
#define FAINTEST 0.05f        /* least contrast of a stroke; yellow on white has 0.07 */
#define NOISELESS 0.003f      /* noise below this is rounding to 8 bits */

/* ------------------------------------------------------------------ one value a pixel */

/* fminf and fmaxf, but for numbers only and not through a call. */
static inline float
least (float a, float b)
{
  return a < b ? a : b;
}

static inline float
most (float a, float b)
{
  return a > b ? a : b;
}

static float
in_unit (float value, float otherwise)
{
  return value >= 0 ? (value < 1 ? value : 1) : value < 0 ? 0 : otherwise;
}

static float
opacity (const CeldDrawing *drawing, int x, int y)
{
  return drawing->alpha.data ? in_unit (CELD_AT (&drawing->alpha, x, y), 0) : 1;
}

/* The value of a pixel on paper that is white, or black for chalk. */
static float
paper_value (const CeldDrawing *drawing, CeldInkMode mode, int x, int y)
{
  float luma = CELD_AT (&drawing->luma, x, y), alpha = opacity (drawing, x, y);

  if (isnan (luma))
    return 1;
  luma = in_unit (luma, 1);
  return mode == CELD_INK_ALPHA ? 1 - alpha : mode == CELD_INK_LIGHT ? 1 - luma * alpha : 1 - (1 - luma) * alpha;
}

/* Lines on a transparent layer: most of it is transparent, what is not is thin, and inside a line there is no contrast
 * as there is between the outline and the fill of a sprite. */
static bool
is_line_layer (const CeldDrawing *drawing)
{
  int    width = drawing->luma.width, height = drawing->luma.height, side = width < height ? width : height;
  double opaque = 0, outline = 0, inside = 0;

  if (!drawing->alpha.data)
    return false;
  for (int y = 0; y < height; y++)
    for (int x = 0; x < width; x++)
      {
        float alpha = opacity (drawing, x, y), luma = in_unit (CELD_AT (&drawing->luma, x, y), 1);

        opaque += alpha;
        for (int k = 0; k < 2; k++)
          {
            int u = x + !k, v = y + k;

            if (u < width && v < height)
              {
                float beyond = opacity (drawing, u, v);

                outline += fabsf (alpha - beyond);
                inside += least (alpha, beyond) * fabsf (luma - in_unit (CELD_AT (&drawing->luma, u, v), 1));
              }
          }
      }
  return opaque < 0.6 * width * height && inside < 0.15 * outline && 2 * opaque < 0.06 * side * outline;
}

/* Chalk on dark paper: dark is the frame, and dark is most of the picture; dark and light part half way between the
 * darkest and the lightest that there is. */
static bool
is_chalk (const CeldDrawing *drawing)
{
  int    width = drawing->luma.width, height = drawing->luma.height, band = 1 + (width < height ? width : height) / 50;
  size_t of[BINS] = { 0 }, frame[BINS] = { 0 }, all = (size_t) width * (size_t) height, framed = 0;
  size_t below = 0, dark = 0, dark_frame = 0, tail = all / 200;
  int    low = 0, high = BINS - 1;

  for (int y = 0; y < height; y++)
    for (int x = 0; x < width; x++)
      {
        int  bin = (int) (paper_value (drawing, CELD_INK_DARK, x, y) * (BINS - 1) + 0.5f);
        bool on_frame = x < band || y < band || x >= width - band || y >= height - band;

        of[bin]++;
        frame[bin] += on_frame;
        framed += on_frame;
      }
  for (below = of[0]; below <= tail && low < BINS - 1; below += of[++low])
    ;
  for (below = of[BINS - 1]; below <= tail && high > 0; below += of[--high])
    ;
  if (high - low < BINS / 16)
    return low + high < BINS - 1;
  for (int i = 0; 2 * i <= low + high; i++)
    {
      dark += of[i];
      dark_frame += frame[i];
    }
  return 2 * dark > all && 2 * dark_frame > framed;
}

static CeldInkMode
resolve_mode (const CeldDrawing *drawing, CeldInkMode mode)
{
  if (mode != CELD_INK_AUTO)
    return mode;
  return is_line_layer (drawing) ? CELD_INK_ALPHA : is_chalk (drawing) ? CELD_INK_LIGHT : CELD_INK_DARK;
}

/* ------------------------------------------------------------------ paper */

typedef struct { int side, width, height; float *level, *spare; } Tiles;

/* The commonest value among the lightest fifth of a tile's pixels, edges left out; 0 if all of it is edges. */
static float
upper_value (const CeldPlane *value, int left, int top, int side)
{
  unsigned of[BINS] = { 0 }, all = 0, above = 0;
  double   sum[BINS] = { 0 };
  int      bin = BINS - 1, fullest;

  for (int y = top; y < top + side && y < value->height; y++)
    for (int x = left; x < left + side && x < value->width; x++)
      {
        float v = CELD_AT (value, x, y);
        int   i = (int) (v * (BINS - 1) + 0.5f);

        if (fabsf (v - CELD_AT (value, x > 0 ? x - 1 : 0, y)) > 0.06f)
          continue;
        of[i]++;
        sum[i] += v;
        all++;
      }
  if (!all)
    return 0;
  for (fullest = bin; 5 * (above += of[bin]) < all; bin--)
    if (of[bin] > of[fullest])
      fullest = bin;
  if (of[bin] > of[fullest])
    fullest = bin;
  return (float) (sum[fullest] / of[fullest]);
}

/* Keeps the tiles whose level can be reached from the brightest in small steps, as shadows and vignettes can; sets the
 * others, inside solid ink, to 0. */
static void
drop_inked_tiles (Tiles *t)
{
  float brightest = 0;
  bool  moved = true;

  for (int i = 0; i < t->width * t->height; i++)
    brightest = most (brightest, t->level[i]);
  for (int i = 0; i < t->width * t->height; i++)
    t->spare[i] = t->level[i] >= 0.9f * brightest ? t->level[i] : 0;
  while (moved)
    {
      moved = false;
      for (int y = 0; y < t->height; y++)
        for (int x = 0; x < t->width; x++)
          {
            int   i = y * t->width + x;
            float around = 0;

            if (t->spare[i] > 0)
              continue;
            around = most (around, x > 0 ? t->spare[i - 1] : 0);
            around = most (around, x < t->width - 1 ? t->spare[i + 1] : 0);
            around = most (around, y > 0 ? t->spare[i - t->width] : 0);
            around = most (around, y < t->height - 1 ? t->spare[i + t->width] : 0);
            if (around > 0 && t->level[i] >= 0.8f * around)
              {
                t->spare[i] = t->level[i];
                moved = true;
              }
          }
    }
  memcpy (t->level, t->spare, (size_t) t->width * (size_t) t->height * sizeof *t->level);
}

/* Mean of the known tiles among the 3x3 round (x,y), 0 if none is known. */
static float
mean_around (const Tiles *t, int x, int y)
{
  float sum = 0, n = 0;

  for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < t->height; v++)
    for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < t->width; u++)
      if (t->level[v * t->width + u] > 0)
        {
          sum += t->level[v * t->width + u];
          n++;
        }
  return n > 0 ? sum / n : 0;
}

/* Fills unknown tiles ring by ring, then evens out the whole. */
static void
fill_tiles (Tiles *t)
{
  size_t bytes = (size_t) t->width * (size_t) t->height * sizeof *t->level;
  bool   unknown = true;

  for (int round = 0; unknown; round++)
    {
      unknown = false;
      for (int y = 0; y < t->height; y++)
        for (int x = 0; x < t->width; x++)
          {
            int i = y * t->width + x;

            t->spare[i] = t->level[i] > 0 ? t->level[i] : mean_around (t, x, y);
            unknown = unknown || t->spare[i] <= 0;
          }
      memcpy (t->level, t->spare, bytes);
    }
  for (int y = 0; y < t->height; y++)
    for (int x = 0; x < t->width; x++)
      t->spare[y * t->width + x] = mean_around (t, x, y);
  memcpy (t->level, t->spare, bytes);
}

/* The bilinear paper level at a pixel. */
static float
paper_at (const Tiles *t, int x, int y)
{
  float u = least (most (((float) x + 0.5f) / (float) t->side - 0.5f, 0), (float) (t->width - 1));
  float v = least (most (((float) y + 0.5f) / (float) t->side - 0.5f, 0), (float) (t->height - 1));
  int   i = (int) u, j = (int) v, right = i + 1 < t->width, below = j + 1 < t->height ? t->width : 0;
  const float *l = t->level + j * t->width + i;

  u -= (float) i;
  v -= (float) j;
  return (1 - v) * ((1 - u) * l[0] + u * l[right]) + v * ((1 - u) * l[below] + u * l[below + right]);
}

/* Values become contrasts: 0 on paper, 1 where nothing of its light is left. */
static CeldStatus
flatten_paper (CeldPlane *value)
{
  int        smaller = value->width < value->height ? value->width : value->height;
  Tiles      t = { .side = smaller / 24 < 16 ? 16 : smaller / 24 };
  CeldStatus status = CELD_NO_MEMORY;

  t.width = (value->width + t.side - 1) / t.side;
  t.height = (value->height + t.side - 1) / t.side;
  t.level = celd_alloc ((size_t) t.width * (size_t) t.height, sizeof *t.level);
  t.spare = celd_alloc ((size_t) t.width * (size_t) t.height, sizeof *t.spare);
  if (!t.level || !t.spare)
    goto done;
  for (int y = 0; y < t.height; y++)
    for (int x = 0; x < t.width; x++)
      t.level[y * t.width + x] = most (upper_value (value, x * t.side, y * t.side, t.side), 1e-3f);
  drop_inked_tiles (&t);
  fill_tiles (&t);
  for (int y = 0; y < value->height; y++)
    for (int x = 0; x < value->width; x++)
      CELD_AT (value, x, y) = most (1 - CELD_AT (value, x, y) / paper_at (&t, x, y), 0);
  status = CELD_OK;

done:
  celd_free (t.level);
  celd_free (t.spare);
  return status;
}

/* ------------------------------------------------------------------ noise */

/* The standard deviation of the grain of the paper at one scale: median second difference along rows, where no ink is. */
static float
noise_at (const CeldPlane *contrast, int step)
{
  size_t of[BINS] = { 0 }, all = 0, below = 0;
  int    bin = 0;

  for (int y = 0; y < contrast->height; y++)
    for (int x = step; x < contrast->width - step; x++)
      {
        const float *c = &CELD_AT (contrast, x, y);

        if (c[-step] < 0.25f && c[0] < 0.25f && c[step] < 0.25f)
          {
            of[(int) least (fabsf (c[-step] - 2 * c[0] + c[step]) * 1024, BINS - 1)]++;
            all++;
          }
      }
  while (bin < BINS - 1 && 2 * (below += of[bin]) < all)
    bin++;
  return (float) bin / 1024 / (0.6745f * 2.4495f); /* median to deviation; the three taps have root of squares sqrt 6 */
}

/* The ripple that one of a hundred paper pixels near dark ink exceeds: the echoes of a lossy picture; 0 in a clean one.
 * `around` is the largest contrast in some neighbourhood. */
static float
echo_level (const CeldPlane *contrast, const CeldPlane *around, float dark)
{
  size_t of[BINS] = { 0 }, all = 0, above = 0;
  int    bin = BINS - 1;

  for (int y = 1; y < contrast->height - 1; y++)
    for (int x = 1; x < contrast->width - 1; x++)
      {
        const float *c = &CELD_AT (contrast, x, y), *up = c - contrast->stride, *down = c + contrast->stride;
        float        beside = most (most (up[-1], up[0]), most (up[1], c[-1]));

        beside = most (beside, most (most (c[1], down[-1]), most (down[0], down[1])));
        if (CELD_AT (around, x, y) < 0.7f * dark || most (beside, c[0]) > 0.25f * dark)
          continue;
        of[(int) (0.5f * fabsf (c[-1] - 2 * c[0] + c[1]) * (BINS - 1))]++;
        all++;
      }
  while (bin > 0 && 100 * (above += of[bin]) < all)
    bin--;
  return (float) bin / (BINS - 1);
}

/* One pass of the binomial filter (1 2 1)/4 in both directions; `spare` is overwritten. */
static void
smooth (CeldPlane *plane, CeldPlane *spare)
{
  int width = plane->width, height = plane->height;

  for (int y = 0; y < height; y++)
    for (int x = 0; x < width; x++)
      {
        float left = CELD_AT (plane, x > 0 ? x - 1 : 0, y), right = CELD_AT (plane, x < width - 1 ? x + 1 : x, y);

        CELD_AT (spare, x, y) = 0.25f * (left + right) + 0.5f * CELD_AT (plane, x, y);
      }
  for (int y = 0; y < height; y++)
    for (int x = 0; x < width; x++)
      {
        float above = CELD_AT (spare, x, y > 0 ? y - 1 : 0), below = CELD_AT (spare, x, y < height - 1 ? y + 1 : y);

        CELD_AT (plane, x, y) = 0.25f * (above + below) + 0.5f * CELD_AT (spare, x, y);
      }
}

/* ------------------------------------------------------------------ grey morphology with square windows */

/* Each element becomes the least of those at most `radius` away along its row; `line` has room for width + 2 radius. */
static void
least_along_rows (CeldPlane *plane, int radius, float *line)
{
  int n = plane->width + 2 * radius, window = 2 * radius + 1, span = 1;

  for (int y = 0; y < plane->height; y++)
    {
      float *row = &CELD_AT (plane, 0, y);

      for (int i = 0; i < radius; i++)
        line[i] = line[n - 1 - i] = INFINITY;
      memcpy (line + radius, row, (size_t) plane->width * sizeof *row);
      for (span = 1; 2 * span <= window; span *= 2)
        for (int i = 0; i < n - span; i++)
          line[i] = least (line[i], line[i + span]);
      for (int x = 0; x < plane->width; x++)
        row[x] = least (line[x], line[x + window - span]);
    }
}

static void
transpose (const CeldPlane *from, CeldPlane *to)
{
  enum { BLOCK = 32 };

  *to = (CeldPlane) { from->height, from->width, (size_t) from->height, to->data };
  for (int top = 0; top < from->height; top += BLOCK)
    for (int left = 0; left < from->width; left += BLOCK)
      for (int y = top; y < from->height && y < top + BLOCK; y++)
        for (int x = left; x < from->width && x < left + BLOCK; x++)
          CELD_AT (to, y, x) = CELD_AT (from, x, y);
}

static void
erode (CeldPlane *plane, int radius, CeldPlane *spare, float *line)
{
  least_along_rows (plane, radius, line);
  transpose (plane, spare);
  least_along_rows (spare, radius, line);
  transpose (spare, plane);
}

static void
negate (CeldPlane *plane)
{
  size_t n = (size_t) plane->width * (size_t) plane->height;

  for (size_t i = 0; i < n; i++)
    plane->data[i] = -plane->data[i];
}

static void
dilate (CeldPlane *plane, int radius, CeldPlane *spare, float *line)
{
  negate (plane);
  erode (plane, radius, spare, line);
  negate (plane);
}

/* ------------------------------------------------------------------ ink */

/* The contrast that a fiftieth of the inked pixels exceed, exact where these have one value; 1 if there is no ink. */
static float
dark_level (const CeldPlane *contrast, float faintest)
{
  size_t of[BINS] = { 0 }, all = 0, above = 0;
  double sum[BINS] = { 0 };
  int    bin = BINS - 1;

  for (int y = 0; y < contrast->height; y++)
    for (int x = 0; x < contrast->width; x++)
      {
        float c = CELD_AT (contrast, x, y);
        int   i = (int) (c * (BINS - 1) + 0.5f);

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

/* What is known of a drawing's contrast before its strokes are looked at one by one. */
typedef struct
{
  float noise;      /* of the paper */
  float faintest;   /* least contrast of a stroke */
  float dark;       /* contrast of the dark strokes */
  bool  noisy;
} Measure;

/* Is the pixel inside a stroke, not on its antialiased rim: do the 3x3 pixels round it differ by a tenth at most? */
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

/* Where a pixel shows how dark its stroke is, `level` becomes this, else 0.  In: `level` holds the largest contrast of
 * the 5x5 round about.  A grey pixel without noise may be the rim of a black stroke unless it is inside a grey one, or
 * fainter than any rim whose stroke is that near. */
static bool
find_pale (const CeldPlane *contrast, const Measure *m, CeldPlane *level)
{
  bool found = false;

  for (int y = 0; y < contrast->height; y++)
    for (int x = 0; x < contrast->width; x++)
      {
        float c = CELD_AT (contrast, x, y), *l = &CELD_AT (level, x, y);
        bool  shows = c >= m->faintest && (m->noisy || *l < 0.45f * m->dark || (c < 0.75f * m->dark && is_solid (contrast, x, y)));

        *l = shows ? c : 0;
        found = found || (shows && c < 0.95f * m->dark);
      }
  return found;
}

CeldStatus
celd_ink (const CeldDrawing *drawing, CeldInkMode mode, const CeldRun *run, CeldPlane *ink)
{
  int        width = ink->width, height = ink->height;
  CeldPlane  contrast = { 0 }, area = { 0 }, level = { 0 }, spare = { 0 };
  float     *line = NULL;
  Measure    m;
  bool       pale;
  CeldStatus status = CELD_BAD_SIZE;
  int        widest;

  if (!CELD_SAME_SIZE (&drawing->luma, ink) || (drawing->alpha.data && !CELD_SAME_SIZE (&drawing->alpha, ink)))
    return CELD_BAD_SIZE;
  widest = (width < height ? width : height) / 32 > 12 ? (width < height ? width : height) / 32 : 12;
  line = celd_alloc ((size_t) (width > height ? width : height) + 2 * (size_t) widest, sizeof *line);
  if (!line || celd_plane_new (width, height, &contrast) != CELD_OK || celd_plane_new (width, height, &area) != CELD_OK ||
      celd_plane_new (width, height, &level) != CELD_OK || celd_plane_new (width, height, &spare) != CELD_OK)
    {
      status = CELD_NO_MEMORY;
      goto done;
    }

  mode = resolve_mode (drawing, mode);
  for (int y = 0; y < height; y++)
    for (int x = 0; x < width; x++)
      CELD_AT (&contrast, x, y) = paper_value (drawing, mode, x, y);
  status = flatten_paper (&contrast);
  if (status == CELD_OK)
    status = celd_step (run, 0.3);
  if (status != CELD_OK)
    goto done;

  m.noise = most (most (noise_at (&contrast, 1), noise_at (&contrast, 4)), noise_at (&contrast, 16));
  m.noisy = m.noise > NOISELESS;
  if (m.noisy)
    {
      float zero = 2 * m.noise;

      smooth (&contrast, &spare);
      smooth (&contrast, &spare);
      for (size_t i = 0; i < (size_t) width * (size_t) height; i++)
        contrast.data[i] = most (contrast.data[i] - zero, 0) / (1 - zero);
    }
  m.faintest = most (FAINTEST, 8 * m.noise);
  m.dark = dark_level (&contrast, m.faintest);
  if (m.noisy)
    {
      m.dark = most (m.dark, 16 * m.noise);
      m.faintest = most (m.faintest, 0.2f * m.dark);
    }
  status = celd_step (run, 0.5);
  if (status != CELD_OK)
    goto done;

  memcpy (level.data, contrast.data, (size_t) width * (size_t) height * sizeof (float));
  dilate (&level, m.noisy ? 2 : 5, &spare, line);
  if (!m.noisy)
    m.faintest = most (m.faintest, 4 * echo_level (&contrast, &level, m.dark));
  pale = find_pale (&contrast, &m, &level);
  if (pale)
    {
      memcpy (area.data, contrast.data, (size_t) width * (size_t) height * sizeof (float));
      erode (&area, widest, &spare, line);
      dilate (&area, widest, &spare, line);
      for (size_t i = 0; i < (size_t) width * (size_t) height; i++)
        if (contrast.data[i] - area.data[i] < most (m.faintest, 0.5f * contrast.data[i]))
          level.data[i] = 0;
      dilate (&level, m.noisy ? 2 : 5, &spare, line);
    }
  status = celd_step (run, 0.9);
  if (status != CELD_OK)
    goto done;
  for (int y = 0; y < height; y++)
    for (int x = 0; x < width; x++)
      {
        size_t i = (size_t) y * (size_t) width + (size_t) x;
        float  c = contrast.data[i] / m.dark;

        if (pale && level.data[i] > 0 && contrast.data[i] <= 1.05f * level.data[i])
          c = most (c, (contrast.data[i] - area.data[i]) / (level.data[i] * (m.noisy ? 0.8f : 1)));
        CELD_AT (ink, x, y) = 1 - least (c, 1);
      }

done:
  celd_free (line);
  celd_free (contrast.data);
  celd_free (area.data);
  celd_free (level.data);
  celd_free (spare.data);
  return status;
}
