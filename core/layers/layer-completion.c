/* Completion of the hidden part of a layer: what the outline with its closed gaps encloses, where an opaque nearer
 * layer occludes it.  Holes that a nearer layer covers are closed; the background extends over the whole picture.
 *
 * The colour is inpainted by Laplace's equation from the layer's visible paper; ink is excluded, because lines would
 * smear.  Along a closed gap the layer's own line continues, with the width and the colour that it has at the two ends,
 * interpolated.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "layers/layers.h"
#include "solve/laplace.h"

#include <math.h>

#define MIN_LINE_WIDTH    0.7   /* pixels; a thinner line does not count as one; chosen */
#define INPAINT_PAPER     0.97f /* ink above this is certainly paper; chosen */
#define FLAT_TOLERANCE    (2.5f / 255)
#define INPAINT_TOLERANCE 4e-3  /* relative to the range of colours */
#define MARGIN_STROKES    4     /* stroke widths round the hidden part from which colours are taken; chosen */

/* A layer under completion; planes have the size of the box. */
typedef struct
{
  CeldLayers      *layers;
  size_t           layer;
  const CeldPlane *ink;
  CeldGapCurve    *curve;
  size_t           n_curves;
  CeldRect         box;
  float           *coverage;   /* coverage of each pixel by the shape; 0 where the layer is not occluded */
  float           *line;       /* coverage by the line */
  float           *line_place; /* the line's curve and parameter, as index + t */
  size_t           n_hidden;
} Completion;

static size_t
index_of (const Completion *part, int x, int y)
{
  return (size_t) (y - part->box.y) * (size_t) part->box.width + (size_t) (x - part->box.x);
}

/* ------------------------------------------------------------------ shape */

static CeldRect
clip (const CeldLayers *layers, CeldRect box, int margin)
{
  int left = box.x - margin > 0 ? box.x - margin : 0, top = box.y - margin > 0 ? box.y - margin : 0;
  int right = box.x + box.width + margin, bottom = box.y + box.height + margin;

  right  = right < layers->width ? right : layers->width;
  bottom = bottom < layers->height ? bottom : layers->height;
  return left < right && top < bottom ? (CeldRect) { left, top, right - left, bottom - top } : (CeldRect) { 0 };
}

/* Bounding box of the visible part and of the curves' control polygons. */
static CeldRect
whole_box (const Completion *part)
{
  CeldRect box = part->layers->seen[part->layer];

  for (size_t i = 0; i < part->n_curves; i++)
    for (int k = 0; k < 4; k++)
      box = celd_rect_union (box, (CeldRect) { (int) floor (part->curve[i].x[k]), (int) floor (part->curve[i].y[k]),
                                               1, 1 });
  return clip (part->layers, box, 1);
}

/* Clears the coverage of pixels that are not occluded, and counts the others. */
static void
keep_hidden (Completion *part)
{
  for (int y = part->box.y; y < part->box.y + part->box.height; y++)
    for (int x = part->box.x; x < part->box.x + part->box.width; x++)
      {
        float *coverage = &part->coverage[index_of (part, x, y)];

        if (*coverage > 0 && celd_layer_visibility (part->layers, part->layer, x, y) != CELD_LAYER_OCCLUDED)
          *coverage = 0;
        part->n_hidden += *coverage > 0;
      }
}

static CeldStatus
cover_everything (Completion *part)
{
  size_t pixels;

  part->box   = clip (part->layers, (CeldRect) { 0, 0, part->layers->width, part->layers->height }, 0);
  pixels      = (size_t) part->box.width * (size_t) part->box.height;
  part->coverage = celd_alloc (pixels, sizeof *part->coverage);
  if (!part->coverage)
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < pixels; i++)
    part->coverage[i] = 1;
  return CELD_OK;
}

/* ------------------------------------------------------------------ line along closed gaps */

/* An end in a corner between lines has no measurable width; it takes that of the other end. */
static void
copy_missing_line (CeldGapCurve *curve)
{
  for (int i = 0; i < 2; i++)
    if (curve->width[i] < MIN_LINE_WIDTH)
      {
        curve->width[i] = curve->width[1 - i];
        memcpy (curve->colour[i], curve->colour[1 - i], sizeof curve->colour[i]);
      }
}

static double
line_width_at (const CeldGapCurve *curve, double t)
{
  return curve->width[0] + t * (curve->width[1] - curve->width[0]);
}

/* Draws the line round its point at parameter t. */
static void
draw_dot (const Completion *part, size_t curve, double t)
{
  double x, y, width = line_width_at (&part->curve[curve], t);
  int    radius = (int) ceil (width + 0.5);

  celd_curve_at (&part->curve[curve], t, &x, &y);
  for (int py = (int) floor (y) - radius; py <= (int) floor (y) + radius; py++)
    for (int px = (int) floor (x) - radius; px <= (int) floor (x) + radius; px++)
      if (px >= part->box.x && px < part->box.x + part->box.width && py >= part->box.y &&
          py < part->box.y + part->box.height)
        {
          size_t p = index_of (part, px, py);
          double dx = px + 0.5 - x, dy = py + 0.5 - y;
          float  coverage = (float) fmin (fmax (width + 0.5 - sqrt (dx * dx + dy * dy), 0), 1);

          if (part->coverage[p] > 0 && coverage > part->line[p])
            {
              part->line[p]       = coverage;
              part->line_place[p] = (float) ((double) curve + fmin (t, 0.999));
            }
        }
}

static CeldStatus
draw_lines (Completion *part)
{
  size_t pixels = (size_t) part->box.width * (size_t) part->box.height;

  part->line       = celd_alloc0 (pixels, sizeof *part->line);
  part->line_place = celd_alloc (pixels, sizeof *part->line_place);
  if (!part->line || !part->line_place)
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < part->n_curves; i++)
    {
      int steps = celd_curve_steps (&part->curve[i]);

      copy_missing_line (&part->curve[i]);
      if (part->curve[i].width[0] >= MIN_LINE_WIDTH)
        for (int k = 0; k <= 2 * steps; k++)
          draw_dot (part, i, (double) k / (2 * steps));
    }
  return CELD_OK;
}

/* ------------------------------------------------------------------ inpainting */

/* The pixels that provide colours, and those that are inpainted. */
typedef struct
{
  CeldRect box;
  uint8_t *kind;               /* FILL_ value of each pixel */
  float   *value;              /* CELD_LANES numbers a pixel: premultiplied r, g, b and alpha; the rest is unused */
  size_t   n_known;
} Inpainting;

enum { FILL_NONE, FILL_KNOWN, FILL_FREE };

static CeldRect
hidden_box (const Completion *part)
{
  CeldRect box = { 0 };

  for (int y = part->box.y; y < part->box.y + part->box.height; y++)
    for (int x = part->box.x; x < part->box.x + part->box.width; x++)
      if (part->coverage[index_of (part, x, y)] > 0)
        box = celd_rect_union (box, (CeldRect) { x, y, 1, 1 });
  return box;
}

static bool
is_hidden (const Completion *part, int x, int y)
{
  return x >= part->box.x && x < part->box.x + part->box.width && y >= part->box.y &&
         y < part->box.y + part->box.height && part->coverage[index_of (part, x, y)] > 0;
}

/* Known pixels are paper of this layer alone, with `ink_too` also ink; its other pixels and hidden ones are free. */
static void
sort_pixels (const Completion *part, bool ink_too, Inpainting *fill)
{
  const CeldLayers *layers = part->layers;
  size_t            p = 0;

  fill->n_known = 0;
  for (int y = fill->box.y; y < fill->box.y + fill->box.height; y++)
    for (int x = fill->box.x; x < fill->box.x + fill->box.width; x++, p++)
      {
        size_t       at = (size_t) y * (size_t) layers->width + (size_t) x;
        const float *art = layers->art + 4 * at;
        bool         own = layers->place[at] == part->layer;

        fill->kind[p] = is_hidden (part, x, y) ? FILL_FREE : FILL_NONE;
        if (own && (ink_too || !(CELD_AT (part->ink, x, y) < INPAINT_PAPER)))
          fill->kind[p] = FILL_KNOWN;
        else if (celd_layer_visibility (layers, part->layer, x, y) == CELD_LAYER_VISIBLE)
          fill->kind[p] = FILL_FREE;
        if (fill->kind[p] != FILL_KNOWN)
          continue;
        fill->n_known++;
        for (int c = 0; c < 4; c++)
          fill->value[p * CELD_LANES + (size_t) c] = c < 3 ? art[c] * art[3] : art[3];
      }
}

/* Sets free pixels to the mean of the known ones.  True if nearly all known pixels have that colour. */
static bool
fill_with_mean (Inpainting *fill)
{
  size_t pixels = (size_t) fill->box.width * (size_t) fill->box.height, others = 0;

  for (size_t c = 0; c < 4; c++)
    {
      double sum = 0;
      float  mean;

      for (size_t p = 0; p < pixels; p++)
        sum += fill->kind[p] == FILL_KNOWN ? (double) fill->value[p * CELD_LANES + c] : 0;
      mean = (float) (sum / (double) fill->n_known);
      for (size_t p = 0; p < pixels; p++)
        if (fill->kind[p] != FILL_KNOWN)
          fill->value[p * CELD_LANES + c] = mean;
        else
          others += fabsf (fill->value[p * CELD_LANES + c] - mean) > FLAT_TOLERANCE;
    }
  return others <= fill->n_known / 100;
}

/* Solves Laplace's equation on the free pixels, with insulated boundaries towards pixels of neither kind. */
static CeldStatus
solve_laplace (const CeldHost *host, Inpainting *fill)
{
  size_t       w = (size_t) fill->box.width, pixels = w * (size_t) fill->box.height;
  float       *east = celd_alloc0 (pixels, sizeof *east), *south = celd_alloc0 (pixels, sizeof *south);
  uint8_t     *fixed = celd_alloc0 (pixels, 1);
  CeldLaplace *laplace = NULL;
  CeldStatus   status = east && south && fixed ? CELD_OK : CELD_NO_MEMORY;

  for (size_t p = 0; p < pixels && status == CELD_OK; p++)
    {
      fixed[p] = fill->kind[p] != FILL_FREE;
      if (fill->kind[p] && (p + 1) % w && fill->kind[p + 1])
        east[p] = 1;
      if (fill->kind[p] && p + w < pixels && fill->kind[p + w])
        south[p] = 1;
    }
  if (status == CELD_OK)
    status = celd_lap_setup (fill->box.width, fill->box.height, east, south, NULL, fixed, host, &laplace);
  if (status == CELD_OK)
    status = celd_lap_solve_lanes (laplace, NULL, fill->value, INPAINT_TOLERANCE, host, NULL);
  celd_lap_free (laplace);
  celd_free (east);
  celd_free (south);
  celd_free (fixed);
  return status;
}

static CeldStatus
inpaint (const Completion *part, int stroke, const CeldHost *host, Inpainting *fill)
{
  CeldRect hidden = hidden_box (part);
  size_t   pixels;

  fill->box = clip (part->layers, hidden, MARGIN_STROKES * stroke + 4);
  pixels = (size_t) fill->box.width * (size_t) fill->box.height;
  fill->kind = celd_alloc (pixels, 1);
  fill->value = celd_alloc0 (pixels, CELD_LANES * sizeof *fill->value);
  if (!fill->kind || !fill->value)
    return CELD_NO_MEMORY;
  sort_pixels (part, false, fill);
  if (!fill->n_known)
    sort_pixels (part, true, fill);
  if (!fill->n_known)
    return CELD_OK; /* no pixel belongs to the layer alone: no hidden part is made */
  return fill_with_mean (fill) ? CELD_OK : solve_laplace (host, fill);
}

/* ------------------------------------------------------------------ result */

/* The line over the inpainted colour, with straight alpha. */
static void
hidden_colour (const Completion *part, const Inpainting *fill, int x, int y, float colour[4])
{
  size_t       p = index_of (part, x, y);
  size_t       at = (size_t) (y - fill->box.y) * (size_t) fill->box.width + (size_t) (x - fill->box.x);
  const float *value = fill->value + at * CELD_LANES;
  float        line = part->line[p], alpha = value[3];

  for (int c = 0; c < 3; c++)
    colour[c] = alpha > 0 ? fminf (fmaxf (value[c] / alpha, 0), 1) : 0;
  if (line > 0)
    {
      const CeldGapCurve *curve = &part->curve[(size_t) part->line_place[p]];
      float               t = part->line_place[p] - floorf (part->line_place[p]);

      for (int c = 0; c < 3; c++)
        colour[c] += line * (curve->colour[0][c] + t * (curve->colour[1][c] - curve->colour[0][c]) - colour[c]);
      alpha = alpha + line * (1 - alpha);
    }
  colour[3] = fminf (fmaxf (alpha * part->coverage[p], 0), 1);
  for (int c = 0; c < 4; c++)
    colour[c] = c < 3 ? celd_quantize_colour (part->layers, colour[c]) : celd_quantize_alpha (part->layers, colour[c]);
}

static CeldStatus
keep_pixels (const Completion *part, const Inpainting *fill)
{
  CeldHiddenPixel *hidden = celd_alloc (part->n_hidden, sizeof *hidden);
  size_t           n = 0;

  if (!hidden)
    return CELD_NO_MEMORY;
  for (int y = part->box.y; y < part->box.y + part->box.height; y++)
    for (int x = part->box.x; x < part->box.x + part->box.width; x++)
      if (part->coverage[index_of (part, x, y)] > 0)
        {
          CeldHiddenPixel pixel = { x, y, { 0 } };

          hidden_colour (part, fill, x, y, pixel.colour);
          if (pixel.colour[3] > 0)
            hidden[n++] = pixel;
        }
  part->layers->hidden[part->layer]   = hidden;
  part->layers->n_hidden[part->layer] = n;
  return CELD_OK;
}

CeldStatus
celd_layer_complete (CeldLayers *layers, size_t layer, bool everything, const CeldPlane *ink, int stroke,
                     const CeldHost *host)
{
  Completion  part = { .layers = layers, .layer = layer, .ink = ink };
  Inpainting  fill = { 0 };
  CeldOutline outline = { 0 };
  CeldStatus  status = everything ? CELD_OK : celd_layer_outline (layers, layer, ink, stroke, &outline);

  if (status != CELD_OK)
    return status;
  part.n_curves = outline.n_gaps;
  part.curve    = celd_alloc (part.n_curves, sizeof *part.curve);
  status        = part.curve ? CELD_OK : CELD_NO_MEMORY;
  if (status == CELD_OK && everything)
    status = cover_everything (&part);
  else if (status == CELD_OK)
    {
      celd_layer_curves (layers, layer, &outline, part.curve);
      part.box = whole_box (&part);
      status = celd_coverage_of_outline (part.box, &outline, part.curve, &part.coverage);
    }
  if (status == CELD_OK)
    keep_hidden (&part);
  if (status == CELD_OK && part.n_hidden && (status = draw_lines (&part)) == CELD_OK &&
      (status = inpaint (&part, stroke, host, &fill)) == CELD_OK && fill.n_known)
    status = keep_pixels (&part, &fill);
  celd_outline_clear (&outline);
  celd_free (part.curve);
  celd_free (part.coverage);
  celd_free (part.line);
  celd_free (part.line_place);
  celd_free (fill.kind);
  celd_free (fill.value);
  return status;
}
