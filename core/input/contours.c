/* Virtual contours (section 4): strokes that the artist paints over a drawing where a contour is missing or is none.
 *
 * Red becomes ink for every purpose, green paper.  Blue becomes ink for segmentation.  For depth, where the border that
 * it makes has to stay smooth, it is no ink, and ink along which it runs becomes paper; ink that it only crosses, as
 * where a stroke is carried on over a contour, is left alone.
 *
 * A stroke is a contour only if nothing leaks past it: one pixel wide, it is widened to two, and its open ends are
 * joined to what is near (contour-ends.c).  Colours are told by their hue, other hues are ignored.
 * Cost: O(pixels), about that of celd_ink; 24 bytes a pixel.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "input/contours.h"

#include <math.h>
#include <stdlib.h>

#define VIVID_CONTOUR 0.3f /* least difference of the largest and the smallest channel of a stroke's colour */
#define ALONG 3         /* a stroke runs along ink that it covers for so many of its widths */

/* ------------------------------------------------------------------ strokes */

static Kind
kind_of_colour (const uint8_t *rgba)
{
  int   r = rgba[0], g = rgba[1], b = rgba[2];
  int   high = r > g ? (r > b ? r : b) : g > b ? g : b, low = r < g ? (r < b ? r : b) : g < b ? g : b;
  float range = (float) (high - low), hue;

  if (range < VIVID_CONTOUR * 255)
    return NOTHING;
  if (high == r)
    hue = 60 * (float) (g - b) / range;
  else if (high == g)
    hue = 120 + 60 * (float) (b - r) / range;
  else
    hue = 240 + 60 * (float) (r - g) / range;
  if (hue > -25 && hue < 25)
    return HARD;
  if (hue > 80 && hue < 165)
    return ERASE;
  return hue > 195 && hue < 270 ? SOFT : NOTHING;
}

/* The commonest colour of a picture without alpha, which means that nothing is painted; false if it has alpha. */
static bool
opaque_paper (const CeldPaint *paint, uint8_t colour[3], CeldStatus *status)
{
  enum { BITS = 12, CELLS = 1 << BITS };
  size_t *of = celd_alloc0 (CELLS, sizeof *of), most = 0;
  bool    opaque = true;

  *status = of ? CELD_OK : CELD_NO_MEMORY;
  for (int y = 0; y < paint->height && of && opaque; y++)
    for (int x = 0; x < paint->width && opaque; x++)
      {
        const uint8_t *p = CELD_RGBA (paint, x, y);

        opaque = p[3] == 255;
        of[(p[0] >> 4) << 8 | (p[1] >> 4) << 4 | p[2] >> 4]++;
      }
  for (int i = 0; i < CELLS && of && opaque; i++)
    if (of[i] > most)
      {
        most = of[i];
        colour[0] = (uint8_t) ((i >> 8) << 4 | 8);
        colour[1] = (uint8_t) ((i >> 4 & 15) << 4 | 8);
        colour[2] = (uint8_t) ((i & 15) << 4 | 8);
      }
  celd_free (of);
  return *status == CELD_OK && opaque;
}

/* Kind and cover of each pixel; false if nothing is painted. */
static CeldStatus
read_strokes (Bake *b, const CeldPaint *paint, size_t *painted)
{
  uint8_t    none[3] = { 0 };
  CeldStatus status;
  bool       opaque = opaque_paper (paint, none, &status);

  *painted = 0;
  for (int y = 0; y < b->height && status == CELD_OK; y++)
    for (int x = 0; x < b->width; x++)
      {
        const uint8_t *p = CELD_RGBA (paint, x, y);
        Kind           kind = p[3] ? kind_of_colour (p) : NOTHING;

        if (opaque && abs (p[0] - none[0]) < 32 && abs (p[1] - none[1]) < 32 && abs (p[2] - none[2]) < 32)
          kind = NOTHING;
        CELD_AT (&b->kind, x, y) = (uint8_t) kind;
        CELD_AT (&b->cover, x, y) = kind == NOTHING ? 0 : p[3];
        *painted += kind != NOTHING;
      }
  return status;
}

/* Are the four pixels from (x,y) to (x+1,y+1) all walls? */
static bool
is_block (const CeldMask *wall, int x, int y)
{
  return x >= 0 && y >= 0 && x < wall->width - 1 && y < wall->height - 1 && CELD_AT (wall, x, y) & 1 &&
         CELD_AT (wall, x + 1, y) & 1 && CELD_AT (wall, x, y + 1) & 1 && CELD_AT (wall, x + 1, y + 1) & 1;
}

/* Walls of this purpose, nowhere less than two pixels wide. */
static void
raise_walls (Bake *b, CeldPurpose purpose)
{
  for (int y = 0; y < b->height; y++)
    for (int x = 0; x < b->width; x++)
      {
        Kind kind = CELD_AT (&b->kind, x, y);
        bool wanted = kind == HARD || (kind == SOFT && purpose == CELD_FOR_SEGMENTATION);

        CELD_AT (&b->wall, x, y) = wanted && CELD_AT (&b->cover, x, y) >= 128;
      }
  for (int y = 0; y < b->height; y++)
    for (int x = 0; x < b->width; x++)
      if (CELD_AT (&b->wall, x, y) & 1 && !is_block (&b->wall, x, y) && !is_block (&b->wall, x - 1, y) &&
          !is_block (&b->wall, x, y - 1) && !is_block (&b->wall, x - 1, y - 1))
        celd_contour_stamp (&b->wall, x, y, 2);
  for (int y = 0; y < b->height; y++)
    for (int x = 0; x < b->width; x++)
      CELD_AT (&b->wall, x, y) = CELD_AT (&b->wall, x, y) != 0;
}

/* Fills in part, list and breadth for the strokes of `mark`: twice the area by the length of the rim. */
static CeldStatus
find_strokes (Bake *b, const CeldHost *host)
{
  CeldStatus status;

  celd_free (b->list);
  celd_free (b->breadth);
  b->list = NULL;
  b->breadth = NULL;
  status = celd_components (&b->mark, 0, true, host, &b->part, &b->list, &b->n);
  if (status != CELD_OK)
    return status;
  b->breadth = celd_alloc0 (b->n + 1, sizeof *b->breadth);
  if (!b->breadth)
    return CELD_NO_MEMORY;
  for (int y = 0; y < b->height; y++)
    for (int x = 0; x < b->width; x++)
      {
        uint32_t k = CELD_AT (&b->part, x, y);

        b->breadth[k] += x == 0 || CELD_AT (&b->part, x - 1, y) != k;
        b->breadth[k] += y == 0 || CELD_AT (&b->part, x, y - 1) != k;
        b->breadth[k] += x == b->width - 1 || CELD_AT (&b->part, x + 1, y) != k;
        b->breadth[k] += y == b->height - 1 || CELD_AT (&b->part, x, y + 1) != k;
      }
  for (size_t k = 1; k <= b->n; k++)
    b->breadth[k] = 2 * (float) b->list[k - 1].area / b->breadth[k];
  return CELD_OK;
}

/* ------------------------------------------------------------------ blue strokes for depth */

/* Half the thickness of the ink that each overlap of `part` lies in: the largest distance to paper. */
static CeldStatus
measure_ink (const Bake *b, const CeldHost *host, float *half)
{
  uint8_t   *paper = celd_alloc (b->pixels, 1);
  int32_t   *squared = celd_alloc (b->pixels, sizeof *squared);
  CeldStatus status = paper && squared ? CELD_OK : CELD_NO_MEMORY;

  for (size_t i = 0; i < b->pixels && status == CELD_OK; i++)
    paper[i] = b->ink.data[i] > 0.5f;
  if (status == CELD_OK)
    status = celd_distance (b->width, b->height, paper, host, squared);
  for (size_t i = 0; i < b->pixels && status == CELD_OK; i++)
    half[b->part.data[i]] = fmaxf (half[b->part.data[i]], sqrtf ((float) squared[i]));
  celd_free (squared);
  celd_free (paper);
  return status;
}

/* Does the overlap run along, or only cross? */
static bool
runs_along (const CeldComponent *overlap, float breadth, float half)
{
  int across = overlap->right - overlap->left, down = overlap->bottom - overlap->top;

  return (float) (across > down ? across : down) > ALONG * fmaxf (breadth, 2 * half);
}

/* Blue strokes erase the ink that they run along: that they overlap for longer than both are thick. */
static CeldStatus
soften (Bake *b, const CeldHost *host)
{
  float     *breadth_at = celd_alloc (b->pixels, sizeof *breadth_at); /* of the blue stroke at each pixel */
  float     *half = NULL, *breadth = NULL;                            /* by overlap */
  CeldStatus status = breadth_at ? CELD_OK : CELD_NO_MEMORY;

  for (size_t i = 0; i < b->pixels; i++)
    b->mark.data[i] = b->kind.data[i] == SOFT && b->cover.data[i] >= 128;
  if (status == CELD_OK)
    status = find_strokes (b, host);
  for (size_t i = 0; i < b->pixels && status == CELD_OK; i++)
    {
      breadth_at[i] = b->breadth[b->part.data[i]];
      b->mark.data[i] = b->mark.data[i] && b->ink.data[i] < 0.95f;
    }
  if (status == CELD_OK)
    status = find_strokes (b, host);
  if (status == CELD_OK)
    {
      half = celd_alloc0 (b->n + 1, sizeof *half);
      breadth = celd_alloc0 (b->n + 1, sizeof *breadth);
      status = half && breadth ? measure_ink (b, host, half) : CELD_NO_MEMORY;
    }
  for (size_t i = 0; i < b->pixels && status == CELD_OK; i++)
    breadth[b->part.data[i]] = breadth_at[i];
  for (size_t i = 0; i < b->pixels && status == CELD_OK; i++)
    {
      uint32_t k = b->part.data[i];

      if (k && runs_along (&b->list[k - 1], breadth[k], half[k]))
        b->kind.data[i] = ERASE;
    }
  celd_free (breadth);
  celd_free (half);
  celd_free (breadth_at);
  return status;
}

/* ------------------------------------------------------------------ the drawing, painted over */

/* The value that the darkest thousandth of the drawing reaches, if that is dark at all. */
static float
ink_value (const CeldPlane *value)
{
  enum { BINS = 256 };
  size_t of[BINS] = { 0 }, all = (size_t) value->width * (size_t) value->height, below = 0;
  int    bin = 0;

  for (size_t i = 0; i < all; i++)
    of[(int) (value->data[i] * (BINS - 1))]++;
  while (1000 * (below += of[bin]) < all)
    bin++;
  return bin < BINS / 2 ? (float) bin / (BINS - 1) : 0;
}

/* The value of a pixel once it is painted over; NAN if it stays as it is. */
static float
painted_value (const Bake *b, int x, int y, CeldPurpose purpose)
{
  Kind  kind = CELD_AT (&b->kind, x, y);
  float value = CELD_AT (&b->value, x, y), paper = fminf (CELD_AT (&b->paper, x, y), 1);
  float share = CELD_AT (&b->cover, x, y) >= 128 ? 1 : (float) CELD_AT (&b->cover, x, y) / 255;

  if (CELD_AT (&b->wall, x, y))
    return b->dark;
  if (kind == ERASE)
    return fmaxf (value, value + share * (paper - value));
  if (kind == HARD || (kind == SOFT && purpose == CELD_FOR_SEGMENTATION))
    return fminf (value, value + share * (b->dark - value));
  return NAN;
}

/* Gives a pixel of the drawing a value in its mode; its alpha stays unless the ink needs more. */
static void
set_value (const CeldDrawing *drawing, CeldInkMode mode, int x, int y, float value, CeldDrawing *out)
{
  float alpha = drawing->alpha.data ? CELD_AT (&drawing->alpha, x, y) : 1, strength = 1 - value;

  if (mode == CELD_INK_ALPHA && drawing->alpha.data)
    {
      CELD_AT (&out->alpha, x, y) = strength;
      return;
    }
  if (!(alpha >= strength))
    CELD_AT (&out->alpha, x, y) = alpha = strength;
  strength = alpha > 0 ? strength / alpha : 0;
  CELD_AT (&out->luma, x, y) = mode == CELD_INK_LIGHT ? strength : 1 - strength;
}

static void
paint_drawing (const Bake *b, const CeldDrawing *drawing, CeldInkMode mode, CeldPurpose purpose, CeldDrawing *out)
{
  for (int y = 0; y < b->height; y++)
    for (int x = 0; x < b->width; x++)
      {
        float value = b->value.data ? painted_value (b, x, y, purpose) : NAN;

        CELD_AT (&out->luma, x, y) = CELD_AT (&drawing->luma, x, y);
        if (drawing->alpha.data)
          CELD_AT (&out->alpha, x, y) = CELD_AT (&drawing->alpha, x, y);
        if (!isnan (value))
          set_value (drawing, mode, x, y, value, out);
      }
}

/* ------------------------------------------------------------------ the whole baking */

/* What is needed once something is painted. */
static CeldStatus
study_drawing (Bake *b, const CeldDrawing *drawing, CeldInkMode mode, const CeldHost *host)
{
  CeldStatus status = CELD_NO_MEMORY;

  if (celd_plane_new (b->width, b->height, &b->ink) == CELD_OK &&
      celd_plane_new (b->width, b->height, &b->value) == CELD_OK &&
      celd_plane_new (b->width, b->height, &b->paper) == CELD_OK &&
      celd_mask_new (b->width, b->height, &b->wall) == CELD_OK &&
      celd_labels_new (b->width, b->height, &b->mark) == CELD_OK &&
      celd_labels_new (b->width, b->height, &b->part) == CELD_OK)
    status = celd_ink (drawing, mode, host, &b->ink);
  if (status != CELD_OK)
    return status;
  celd_ink_values (drawing, mode, &b->value);
  b->dark = ink_value (&b->value);
  return celd_paper_levels (&b->value, &b->paper);
}

static void
end_bake (Bake *b)
{
  celd_free (b->ink.data);
  celd_free (b->value.data);
  celd_free (b->paper.data);
  celd_free (b->kind.data);
  celd_free (b->cover.data);
  celd_free (b->wall.data);
  celd_free (b->mark.data);
  celd_free (b->part.data);
  celd_free (b->list);
  celd_free (b->breadth);
}

/* Walls, their open ends joined, and what blue strokes erase. */
static CeldStatus
build (Bake *b, CeldPurpose purpose, const CeldHost *host)
{
  CeldHostPart   part;
  CeldHost   half = celd_host_part (&part, host, 0.5, 1);
  CeldStatus status;

  raise_walls (b, purpose);
  for (size_t i = 0; i < b->pixels; i++)
    b->mark.data[i] = b->wall.data[i];
  status = find_strokes (b, NULL);
  if (status == CELD_OK)
    status = celd_contour_join (b, &half);
  if (status == CELD_OK && purpose == CELD_FOR_DEPTH)
    status = soften (b, NULL);
  return status;
}

CeldStatus
celd_contours_bake (const CeldDrawing *drawing, const CeldPaint *contours, CeldPurpose purpose, CeldInkMode mode,
                    const CeldHost *host, CeldDrawing *out)
{
  Bake       b = { .width = contours->width, .height = contours->height };
  CeldHostPart   part;
  CeldHost   half = celd_host_part (&part, host, 0, 0.5);
  size_t     painted;
  CeldStatus status = CELD_NO_MEMORY;

  if (!CELD_SAME_SIZE (&drawing->luma, contours) || !CELD_SAME_SIZE (&out->luma, contours) ||
      (drawing->alpha.data && (!CELD_SAME_SIZE (&drawing->alpha, contours) || !CELD_SAME_SIZE (&out->alpha, contours))))
    return CELD_BAD_SIZE;
  b.pixels = (size_t) b.width * (size_t) b.height;
  mode = celd_ink_mode (drawing, mode);
  if (celd_mask_new (b.width, b.height, &b.kind) == CELD_OK && celd_mask_new (b.width, b.height, &b.cover) == CELD_OK)
    status = read_strokes (&b, contours, &painted);
  if (status == CELD_OK && painted)
    {
      status = study_drawing (&b, drawing, mode, &half);
      if (status == CELD_OK)
        status = build (&b, purpose, host);
    }
  if (status == CELD_OK)
    paint_drawing (&b, drawing, mode, purpose, out);
  end_bake (&b);
  return status;
}
