/* Virtual contours (section 4): strokes over a drawing that add a missing contour or remove a line.
 *
 * Red strokes become ink for every purpose, green ones paper.  Blue strokes become ink for segmentation.  For depth,
 * which has to be smooth across the boundary that they make, they are no ink, and ink that they run along becomes
 * paper; ink that they only cross, where a stroke ends beyond a contour, stays.
 *
 * A stroke one pixel wide would leak diagonally, so that it is widened to two pixels; open ends are joined to what is
 * near (contour-ends.c).  Colours are recognised by hue; other hues are ignored.
 *
 * Cost: O(pixels), about that of celd_ink; 24 bytes a pixel.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/input.h"

#include <math.h>
#include <stdlib.h>

#define VIVID_CONTOUR  0.3f /* least chroma of a stroke: its largest channel less its smallest, 0 .. 1; chosen */
#define STROKE_OPACITY 128  /* of 255, from which a pixel counts as painted; chosen */
#define PAPER_ERROR    32   /* of 255 in each channel, within which a pixel of an opaque layer is paper; chosen */
#define ALONG_INK      3    /* widths of a stroke or of the ink below: longer overlaps run along the ink; chosen */

/* ------------------------------------------------------------------ strokes */

static CeldContourKind
kind_of_colour (const uint8_t *rgba)
{
  int   r = rgba[0], g = rgba[1], b = rgba[2];
  int   high = r > g ? (r > b ? r : b) : g > b ? g : b, low = r < g ? (r < b ? r : b) : g < b ? g : b;
  float range = (float) (high - low), hue;

  if (range < VIVID_CONTOUR * 255)
    return CELD_CONTOUR_NONE;
  if (high == r)
    hue = 60 * (float) (g - b) / range;
  else if (high == g)
    hue = 120 + 60 * (float) (b - r) / range;
  else
    hue = 240 + 60 * (float) (r - g) / range;
  if (hue > -25 && hue < 25)
    return CELD_CONTOUR_HARD;
  if (hue > 80 && hue < 165)
    return CELD_CONTOUR_ERASE;
  return hue > 195 && hue < 270 ? CELD_CONTOUR_SOFT : CELD_CONTOUR_NONE;
}

/* Finds the commonest colour of an opaque layer, which is its paper; false if the layer has alpha. */
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

/* Fills in kind and opacity; *painted is the number of painted pixels. */
static CeldStatus
read_strokes (CeldContourBake *b, const CeldPaint *paint, size_t *painted)
{
  uint8_t    none[3] = { 0 };
  CeldStatus status;
  bool       opaque = opaque_paper (paint, none, &status);

  *painted = 0;
  for (int y = 0; y < b->height && status == CELD_OK; y++)
    for (int x = 0; x < b->width; x++)
      {
        const uint8_t  *p = CELD_RGBA (paint, x, y);
        CeldContourKind kind = p[3] ? kind_of_colour (p) : CELD_CONTOUR_NONE;

        if (opaque && abs (p[0] - none[0]) < PAPER_ERROR && abs (p[1] - none[1]) < PAPER_ERROR &&
            abs (p[2] - none[2]) < PAPER_ERROR)
          kind = CELD_CONTOUR_NONE;
        CELD_AT (&b->kind, x, y) = (uint8_t) kind;
        CELD_AT (&b->opacity, x, y) = kind == CELD_CONTOUR_NONE ? 0 : p[3];
        *painted += kind != CELD_CONTOUR_NONE;
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

/* Fills in the walls for a purpose, at least two pixels wide everywhere. */
static void
set_walls (CeldContourBake *b, CeldPurpose purpose)
{
  for (int y = 0; y < b->height; y++)
    for (int x = 0; x < b->width; x++)
      {
        CeldContourKind kind = CELD_AT (&b->kind, x, y);
        bool            soft = kind == CELD_CONTOUR_SOFT && purpose == CELD_FOR_SEGMENTATION;

        CELD_AT (&b->wall, x, y) = (kind == CELD_CONTOUR_HARD || soft) && CELD_AT (&b->opacity, x, y) >= STROKE_OPACITY;
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

/* Finds the strokes: the connected components of `mark`.  Their breadth is twice the area divided by the length of the
 * outline. */
static CeldStatus
find_strokes (CeldContourBake *b, const CeldHost *host)
{
  CeldStatus status;

  celd_free (b->list);
  celd_free (b->breadth);
  b->list = NULL;
  b->breadth = NULL;
  status = celd_components (&b->mark, 0, true, host, &b->component, &b->list, &b->n);
  if (status != CELD_OK)
    return status;
  b->breadth = celd_alloc0 (b->n + 1, sizeof *b->breadth);
  if (!b->breadth)
    return CELD_NO_MEMORY;
  for (int y = 0; y < b->height; y++)
    for (int x = 0; x < b->width; x++)
      {
        uint32_t k = CELD_AT (&b->component, x, y);

        b->breadth[k] += x == 0 || CELD_AT (&b->component, x - 1, y) != k;
        b->breadth[k] += y == 0 || CELD_AT (&b->component, x, y - 1) != k;
        b->breadth[k] += x == b->width - 1 || CELD_AT (&b->component, x + 1, y) != k;
        b->breadth[k] += y == b->height - 1 || CELD_AT (&b->component, x, y + 1) != k;
      }
  for (size_t k = 1; k <= b->n; k++)
    b->breadth[k] = 2 * (float) b->list[k - 1].area / b->breadth[k];
  return CELD_OK;
}

/* ------------------------------------------------------------------ blue strokes for depth */

/* half[k]: half the thickness of the ink below overlap k, which is the largest distance to paper. */
static CeldStatus
measure_ink (const CeldContourBake *b, const CeldHost *host, float *half)
{
  uint8_t   *paper = celd_alloc (b->pixels, 1);
  int32_t   *squared = celd_alloc (b->pixels, sizeof *squared);
  CeldStatus status = paper && squared ? CELD_OK : CELD_NO_MEMORY;

  for (size_t i = 0; i < b->pixels && status == CELD_OK; i++)
    paper[i] = b->ink.data[i] > 0.5f;
  if (status == CELD_OK)
    status = celd_distance (b->width, b->height, paper, host, squared);
  for (size_t i = 0; i < b->pixels && status == CELD_OK; i++)
    half[b->component.data[i]] = fmaxf (half[b->component.data[i]], sqrtf ((float) squared[i]));
  celd_free (squared);
  celd_free (paper);
  return status;
}

/* Does an overlap of a stroke and ink run along the ink, rather than cross it? */
static bool
runs_along (const CeldComponent *overlap, float breadth, float half)
{
  int across = overlap->right - overlap->left, down = overlap->bottom - overlap->top;

  return (float) (across > down ? across : down) > ALONG_INK * fmaxf (breadth, 2 * half);
}

/* Marks the ink that blue strokes run along as erased. */
static CeldStatus
erase_below_soft_strokes (CeldContourBake *b, const CeldHost *host)
{
  float     *breadth_at = celd_alloc (b->pixels, sizeof *breadth_at); /* of the blue stroke at each pixel */
  float     *half = NULL, *breadth = NULL;                            /* by overlap */
  CeldStatus status = breadth_at ? CELD_OK : CELD_NO_MEMORY;

  for (size_t i = 0; i < b->pixels; i++)
    b->mark.data[i] = b->kind.data[i] == CELD_CONTOUR_SOFT && b->opacity.data[i] >= STROKE_OPACITY;
  if (status == CELD_OK)
    status = find_strokes (b, host);
  for (size_t i = 0; i < b->pixels && status == CELD_OK; i++)
    {
      breadth_at[i] = b->breadth[b->component.data[i]];
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
    breadth[b->component.data[i]] = breadth_at[i];
  for (size_t i = 0; i < b->pixels && status == CELD_OK; i++)
    {
      uint32_t k = b->component.data[i];

      if (k && runs_along (&b->list[k - 1], breadth[k], half[k]))
        b->kind.data[i] = CELD_CONTOUR_ERASE;
    }
  celd_free (breadth);
  celd_free (half);
  celd_free (breadth_at);
  return status;
}

/* ------------------------------------------------------------------ writing to the drawing */

/* The value that the darkest thousandth of the pixels does not exceed; 0 if that is above one half. */
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

/* The new value of a pixel; NAN if it does not change. */
static float
painted_value (const CeldContourBake *b, int x, int y, CeldPurpose purpose)
{
  CeldContourKind kind = CELD_AT (&b->kind, x, y);
  float           value = CELD_AT (&b->value, x, y), paper = fminf (CELD_AT (&b->paper, x, y), 1);
  uint8_t         alpha = CELD_AT (&b->opacity, x, y);
  float           opacity = alpha >= STROKE_OPACITY ? 1 : (float) alpha / 255;

  if (CELD_AT (&b->wall, x, y))
    return b->dark;
  if (kind == CELD_CONTOUR_ERASE)
    return fmaxf (value, value + opacity * (paper - value));
  if (kind == CELD_CONTOUR_HARD || (kind == CELD_CONTOUR_SOFT && purpose == CELD_FOR_SEGMENTATION))
    return fminf (value, value + opacity * (b->dark - value));
  return NAN;
}

/* Sets a pixel of the drawing so that it has a value in this mode.  Its alpha is raised if the ink needs more. */
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
paint_drawing (const CeldContourBake *b, const CeldDrawing *drawing, CeldInkMode mode, CeldPurpose purpose,
               CeldDrawing *out)
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

/* ------------------------------------------------------------------ all steps */

/* Allocates all work space, and fills in ink, value, paper and dark. */
static CeldStatus
measure_drawing (CeldContourBake *b, const CeldDrawing *drawing, CeldInkMode mode, const CeldHost *host)
{
  CeldStatus status = CELD_NO_MEMORY;

  if (celd_plane_new (b->width, b->height, &b->ink) == CELD_OK &&
      celd_plane_new (b->width, b->height, &b->value) == CELD_OK &&
      celd_plane_new (b->width, b->height, &b->paper) == CELD_OK &&
      celd_mask_new (b->width, b->height, &b->wall) == CELD_OK &&
      celd_labels_new (b->width, b->height, &b->mark) == CELD_OK &&
      celd_labels_new (b->width, b->height, &b->component) == CELD_OK)
    status = celd_ink (drawing, mode, host, &b->ink);
  if (status != CELD_OK)
    return status;
  celd_ink_values (drawing, mode, &b->value);
  b->dark = ink_value (&b->value);
  return celd_paper_levels (&b->value, &b->paper);
}

static void
end_bake (CeldContourBake *b)
{
  celd_free (b->ink.data);
  celd_free (b->value.data);
  celd_free (b->paper.data);
  celd_free (b->kind.data);
  celd_free (b->opacity.data);
  celd_free (b->wall.data);
  celd_free (b->mark.data);
  celd_free (b->component.data);
  celd_free (b->list);
  celd_free (b->breadth);
}

/* Makes walls, joins their open ends, and finds what blue strokes erase. */
static CeldStatus
make_contours (CeldContourBake *b, CeldPurpose purpose, const CeldHost *host)
{
  CeldHostPart part;
  CeldHost     half = celd_host_part (&part, host, 0.5, 1);
  CeldStatus   status;

  set_walls (b, purpose);
  for (size_t i = 0; i < b->pixels; i++)
    b->mark.data[i] = b->wall.data[i];
  status = find_strokes (b, NULL);
  if (status == CELD_OK)
    status = celd_contour_join (b, &half);
  if (status == CELD_OK && purpose == CELD_FOR_DEPTH)
    status = erase_below_soft_strokes (b, NULL);
  return status;
}

CeldStatus
celd_contours_bake (const CeldDrawing *drawing, const CeldPaint *contours, CeldPurpose purpose, CeldInkMode mode,
                    const CeldHost *host, CeldDrawing *out)
{
  CeldContourBake b = { .width = contours->width, .height = contours->height };
  CeldHostPart    part;
  CeldHost        half = celd_host_part (&part, host, 0, 0.5);
  size_t          painted;
  CeldStatus      status = CELD_NO_MEMORY;

  if (!CELD_SAME_SIZE (&drawing->luma, contours) || !CELD_SAME_SIZE (&out->luma, contours) ||
      (drawing->alpha.data && (!CELD_SAME_SIZE (&drawing->alpha, contours) || !CELD_SAME_SIZE (&out->alpha, contours))))
    return CELD_BAD_SIZE;
  b.pixels = (size_t) b.width * (size_t) b.height;
  mode = celd_ink_mode (drawing, mode);
  if (celd_mask_new (b.width, b.height, &b.kind) == CELD_OK && celd_mask_new (b.width, b.height, &b.opacity) == CELD_OK)
    status = read_strokes (&b, contours, &painted);
  if (status == CELD_OK && painted)
    {
      status = measure_drawing (&b, drawing, mode, &half);
      if (status == CELD_OK)
        status = make_contours (&b, purpose, host);
    }
  if (status == CELD_OK)
    paint_drawing (&b, drawing, mode, purpose, out);
  end_bake (&b);
  return status;
}
