/* The kind of drawing (dark lines, chalk, or lines on a transparent layer), its luma, and how light its paper is.
 *
 * Automatic detection: a layer of which little is opaque, and that little is thin and of one tone, has lines on a
 * transparent layer; a picture that is mostly dark, along its edge as well, is chalk.  Everything else is dark on
 * light, so solid black areas stay ink as long as most of the edge is paper.
 *
 * The paper level is a high quantile in each tile; tiles without paper (solid ink) are filled in from their neighbours;
 * between tiles it is interpolated bilinearly.  White paper has a level of exactly 1.  Cost: O(pixels).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"

#include <math.h>
#include <string.h>

#define DARKEST 1e-3f /* least paper level, because values are divided by it; chosen */

/* ------------------------------------------------------------------ one value a pixel */

/* Luma of encoded colours, with the weights of Rec. 709.  All hosts use this function, because their own greys differ:
 * babl's Y' is encoded luminance, which is much lighter for saturated colours. */
void
celd_luma (const float *rgba, size_t n, float *luma, float *alpha)
{
  for (size_t i = 0; i < n; i++, rgba += 4)
    {
      luma[i] = 0.2126f * rgba[0] + 0.7152f * rgba[1] + 0.0722f * rgba[2];
      if (alpha)
        alpha[i] = rgba[3];
    }
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

static bool
has_transparency (const CeldDrawing *drawing)
{
  if (drawing->alpha.data)
    for (int y = 0; y < drawing->alpha.height; y++)
      for (int x = 0; x < drawing->alpha.width; x++)
        if (opacity (drawing, x, y) < 1)
          return true;
  return false;
}

/* Lines on a transparent layer: most of it is transparent, the rest is thin, and there is no contrast inside it as
 * there is between the outline and the fill of a sprite. */
bool
celd_is_line_layer (const CeldDrawing *drawing)
{
  int    width = drawing->luma.width, height = drawing->luma.height, side = width < height ? width : height;
  double opaque = 0, outline = 0, inside = 0;

  if (!has_transparency (drawing))
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
                inside += fminf (alpha, beyond) * fabsf (luma - in_unit (CELD_AT (&drawing->luma, u, v), 1));
              }
          }
      }
  return opaque < 0.6 * width * height && inside < 0.15 * outline && 2 * opaque < 0.06 * side * outline;
}

/* Chalk on dark paper: most of the picture, and most of its edge, is darker than the middle between the darkest and the
 * lightest half per cent. */
static bool
is_chalk (const CeldDrawing *drawing)
{
  int    width = drawing->luma.width, height = drawing->luma.height, band = 1 + (width < height ? width : height) / 50;
  size_t of[CELD_INK_BINS] = { 0 }, frame[CELD_INK_BINS] = { 0 }, all = (size_t) width * (size_t) height, framed = 0;
  size_t below = 0, dark = 0, dark_frame = 0, tail = all / 200;
  int    low = 0, high = CELD_INK_BINS - 1;

  for (int y = 0; y < height; y++)
    for (int x = 0; x < width; x++)
      {
        int  bin = (int) (paper_value (drawing, CELD_INK_DARK, x, y) * (CELD_INK_BINS - 1) + 0.5f);
        bool on_frame = x < band || y < band || x >= width - band || y >= height - band;

        of[bin]++;
        frame[bin] += on_frame;
        framed += on_frame;
      }
  for (below = of[0]; below <= tail && low < CELD_INK_BINS - 1; below += of[++low])
    ;
  for (below = of[CELD_INK_BINS - 1]; below <= tail && high > 0; below += of[--high])
    ;
  if (high - low < CELD_INK_BINS / 16)
    return low + high < CELD_INK_BINS - 1;
  for (int i = 0; 2 * i <= low + high; i++)
    {
      dark += of[i];
      dark_frame += frame[i];
    }
  return 2 * dark > all && 2 * dark_frame > framed;
}

/* An opaque picture has no lines in its alpha, so CELD_INK_ALPHA is treated as CELD_INK_AUTO then. */
CeldInkMode
celd_ink_mode (const CeldDrawing *drawing, CeldInkMode mode)
{
  if (mode == CELD_INK_DARK || mode == CELD_INK_LIGHT)
    return mode;
  if (mode == CELD_INK_LINES)
    return CELD_INK_DARK; /* as celd_coloured_lines draws them */
  if (mode == CELD_INK_ALPHA ? has_transparency (drawing) : celd_is_line_layer (drawing))
    return CELD_INK_ALPHA;
  return is_chalk (drawing) ? CELD_INK_LIGHT : CELD_INK_DARK;
}

void
celd_ink_values (const CeldDrawing *drawing, CeldInkMode mode, CeldPlane *value)
{
  for (int y = 0; y < value->height; y++)
    for (int x = 0; x < value->width; x++)
      CELD_AT (value, x, y) = paper_value (drawing, mode, x, y);
}

/* ------------------------------------------------------------------ paper levels */

typedef struct { int side, width, height; float *level, *spare; } Tiles;

/* The most frequent value among the lightest fifth of a tile's pixels, without edges; 0 if there are only edges. */
static float
upper_value (const CeldPlane *value, int left, int top, int side)
{
  unsigned of[CELD_INK_BANKS][CELD_INK_BINS] = { { 0 } }, all = 0, above = 0;
  double sum[CELD_INK_BANKS][CELD_INK_BINS] = { { 0 } };
  int    bin = CELD_INK_BINS - 1, fullest;

  for (int y = top; y < top + side && y < value->height; y++)
    for (int x = left; x < left + side && x < value->width; x++)
      {
        float v = CELD_AT (value, x, y);
        int   i = (int) (v * (CELD_INK_BINS - 1) + 0.5f);

        if (fabsf (v - CELD_AT (value, x > 0 ? x - 1 : 0, y)) > 0.06f)
          continue;
        of[x % CELD_INK_BANKS][i]++;
        sum[x % CELD_INK_BANKS][i] += v;
        all++;
      }
  for (int k = 1; k < CELD_INK_BANKS; k++)
    for (int i = 0; i < CELD_INK_BINS; i++)
      {
        of[0][i] += of[k][i];
        sum[0][i] += sum[k][i];
      }
  if (!all)
    return 0;
  for (fullest = bin; 5 * (above += of[0][bin]) < all; bin--)
    if (of[0][bin] > of[0][fullest])
      fullest = bin;
  if (of[0][bin] > of[0][fullest])
    fullest = bin;
  return (float) (sum[0][fullest] / of[0][fullest]);
}

/* Keeps the tiles whose level can be reached from the brightest tiles in small steps, as in shadows and vignettes; sets
 * the others, which are inside solid ink, to 0. */
static void
drop_inked_tiles (Tiles *t)
{
  float brightest = 0;
  bool  moved = true;

  for (int i = 0; i < t->width * t->height; i++)
    brightest = fmaxf (brightest, t->level[i]);
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
            around = fmaxf (around, x > 0 ? t->spare[i - 1] : 0);
            around = fmaxf (around, x < t->width - 1 ? t->spare[i + 1] : 0);
            around = fmaxf (around, y > 0 ? t->spare[i - t->width] : 0);
            around = fmaxf (around, y < t->height - 1 ? t->spare[i + t->width] : 0);
            if (around > 0 && t->level[i] >= 0.8f * around)
              {
                t->spare[i] = t->level[i];
                moved = true;
              }
          }
    }
  memcpy (t->level, t->spare, (size_t) t->width * (size_t) t->height * sizeof *t->level);
}

/* Mean of the known tiles among the 3x3 around (x,y); 0 if none is known. */
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

/* Fills in unknown tiles from known neighbours until none is left. */
static void
fill_tiles (Tiles *t)
{
  size_t bytes = (size_t) t->width * (size_t) t->height * sizeof *t->level;
  bool   unknown = true;

  while (unknown)
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
}

/* Smooths the tiles' levels; linear slopes stay as they are, also at the picture's edge. */
static void
smooth_tiles (Tiles *t)
{
  for (int y = 0; y < t->height; y++)
    for (int x = 0; x < t->width; x++)
      {
        const float *l = t->level + y * t->width + x;

        t->spare[y * t->width + x] = x > 0 && x < t->width - 1 ? 0.25f * (l[-1] + l[1]) + 0.5f * l[0] : l[0];
      }
  for (int y = 0; y < t->height; y++)
    for (int x = 0; x < t->width; x++)
      {
        const float *l = t->spare + y * t->width + x;
        bool         inside = y > 0 && y < t->height - 1;

        t->level[y * t->width + x] = inside ? 0.25f * (l[-t->width] + l[t->width]) + 0.5f * l[0] : l[0];
      }
}

/* The first of the two tiles, of `n` in a row, between whose middles a pixel lies; *share is the weight of the second,
 * outside [0,1] beyond the middles of the outermost tiles: there the slope continues. */
static int
tile_before (int pixel, int side, int n, float *share)
{
  float place = ((float) pixel + 0.5f) / (float) side - 0.5f;
  int   tile = place > 0 ? (int) place : 0;

  if (tile > n - 2)
    tile = n > 1 ? n - 2 : 0;
  *share = n > 1 ? place - (float) tile : 0;
  return tile;
}

/* Interpolates bilinearly between the middles of tiles; the levels of one row of pixels are kept in t->spare. */
static void
interpolate_tiles (const Tiles *t, CeldPlane *paper)
{
  float inverse = 1 / (float) t->side;

  for (int y = 0; y < paper->height; y++)
    {
      float        v;
      const float *l = t->level + tile_before (y, t->side, t->height, &v) * t->width;
      const float *below = t->height > 1 ? l + t->width : l;
      float       *level = t->spare, *row = &CELD_AT (paper, 0, y);

      for (int i = 0; i < t->width; i++)
        level[i] = l[i] + v * (below[i] - l[i]);
      for (int i = 0, x = 0; x < paper->width; i++)
        {
          bool  last = i >= t->width - 2;
          int   end = last ? paper->width : (2 * i + 3) * t->side / 2;
          float rise = t->width > 1 ? (level[i + 1] - level[i]) * inverse : 0;
          float middle = ((float) i + 0.5f) * (float) t->side - 0.5f;

          for (; x < end; x++)
            {
              float value = level[i] + ((float) x - middle) * rise;

              row[x] = value > DARKEST ? value : DARKEST;
            }
        }
    }
}

CeldStatus
celd_paper_levels (const CeldPlane *value, CeldPlane *paper)
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
      t.level[y * t.width + x] = fmaxf (upper_value (value, x * t.side, y * t.side, t.side), DARKEST);
  drop_inked_tiles (&t);
  fill_tiles (&t);
  smooth_tiles (&t);
  interpolate_tiles (&t, paper);
  status = CELD_OK;

done:
  celd_free (t.level);
  celd_free (t.spare);
  return status;
}
