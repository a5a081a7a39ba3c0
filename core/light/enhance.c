/* Depth enhancement (section 5, Figures 1d and 5c): near regions stand out against those behind them, either by the
 * shadows of a stack of regions (shadows.c) or by unsharp masking of the depth buffer [LCD06]: with D the distance from
 * the viewer and G a Gaussian, brightness changes by strength (G D - D), which darkens the farther side of a depth
 * discontinuity and lightens the nearer one.
 *
 *   [LCD06]  T. Luft, C. Colditz, O. Deussen: Image Enhancement by Unsharp Masking the Depth Buffer.  SIGGRAPH 2006.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "light/light.h"

#define FAR_GREY 0.3f /* encoded grey of the farthest level in a view: darker paper would hide shadows on it (chosen) */

/* ------------------------------------------------------------------ unsharp masking */

typedef struct
{
  const CeldPlane *depth;
  CeldPlane       *change;
  CeldBlurGrid     cells;
  CeldBetween     *column, *row;
  float           *mean;           /* mean depth of each cell, blurred */
  float            least, range;   /* of depth */
  float            strength;
  bool             darken;         /* never lighten */
} Unsharp;

static void
measure_range (Unsharp *u)
{
  float most;

  celd_level_range (u->depth, &u->least, &most);
  u->range = most > u->least ? most - u->least : 1;
}

static void
average_cells (void *data, int row)
{
  const Unsharp *u = data;
  int            side = u->cells.side, width = u->depth->width, height = u->depth->height;
  int            bottom = (row + 1) * side < height ? (row + 1) * side : height;

  for (int column = 0; column < u->cells.width; column++)
    {
      int   right = (column + 1) * side < width ? (column + 1) * side : width;
      float sum = 0;

      for (int y = row * side; y < bottom; y++)
        for (int x = column * side; x < right; x++)
          sum += (celd_level_at (u->depth, x, y) - u->least) / u->range;
      u->mean[(size_t) row * (size_t) u->cells.width + (size_t) column]
        = sum / (float) ((right - column * side) * (bottom - row * side));
    }
}

static void
change_row (void *data, int y)
{
  const Unsharp *u = data;
  CeldBetween    row = u->row[y];
  const float   *above = u->mean + (size_t) row.one * (size_t) u->cells.width;
  const float   *below = u->mean + (size_t) row.other * (size_t) u->cells.width;

  for (int x = 0; x < u->depth->width; x++)
    {
      CeldBetween column = u->column[x];
      float       left = (1 - row.share) * above[column.one] + row.share * below[column.one];
      float       right = (1 - row.share) * above[column.other] + row.share * below[column.other];
      float       mean = (1 - column.share) * left + column.share * right;
      float       change = u->strength * ((celd_level_at (u->depth, x, y) - u->least) / u->range - mean);

      CELD_AT (u->change, x, y) = u->darken && change > 0 ? 0 : fmaxf (-1, fminf (change, 1));
    }
}

static CeldStatus
blur_depth (Unsharp *u, double deviation, const CeldHost *host)
{
  size_t     cells = (size_t) u->cells.width * (size_t) u->cells.height;
  float     *scratch = celd_alloc (cells, sizeof *scratch);
  CeldKernel kernel = { 0, 0, NULL };
  CeldStatus status = scratch ? celd_kernel_new (&u->cells, deviation, 0, &kernel) : CELD_NO_MEMORY;

  if (status == CELD_OK)
    {
      celd_parallel_for (host, u->cells.height, average_cells, u);
      celd_blur (&kernel, &kernel, u->cells.width, u->cells.height, u->mean, scratch);
    }
  celd_free (scratch);
  celd_free (kernel.weight);
  return status == CELD_OK ? celd_progress (host, 0.5) : status;
}

static CeldStatus
unsharp_mask (const CeldPlane *depth, double deviation, const CeldSettings *settings, const CeldHost *host,
              CeldPlane *change)
{
  Unsharp    u = { .depth = depth, .change = change, .cells = celd_cells (depth->width, depth->height, deviation),
                   .strength = settings->shadow_strength, .darken = settings->enhance == CELD_ENHANCE_DARKEN };
  CeldStatus status;

  u.column = celd_between_columns (&u.cells);
  u.row    = celd_between_rows (&u.cells);
  u.mean   = celd_alloc ((size_t) u.cells.width * (size_t) u.cells.height, sizeof *u.mean);
  status   = u.column && u.row && u.mean ? CELD_OK : CELD_NO_MEMORY;
  if (status == CELD_OK)
    {
      measure_range (&u);
      status = blur_depth (&u, deviation, host);
    }
  if (status == CELD_OK)
    celd_parallel_for (host, depth->height, change_row, &u);
  celd_free (u.column);
  celd_free (u.row);
  celd_free (u.mean);
  return status;
}

/* ------------------------------------------------------------------ */

CeldStatus
celd_enhance (const CeldPlane *levels, const CeldSettings *settings, const CeldHost *host, CeldPlane *change)
{
  double deviation;

  if (!CELD_SAME_SIZE (levels, change))
    return CELD_BAD_SIZE;
  if (celd_settings_check (settings) != CELD_OK)
    return CELD_BAD_VALUE;
  deviation = fmax (0.25, (double) settings->shadow_size * hypot (levels->width, levels->height));
  return settings->enhance == CELD_ENHANCE_STACK ? celd_shadows (levels, deviation, settings, host, change)
                                                 : unsharp_mask (levels, deviation, settings, host, change);
}

CeldStatus
celd_occlusion (const CeldPlane *levels, const CeldSettings *settings, const CeldHost *host, CeldPlane *occlusion)
{
  CeldSettings even = *settings;
  CeldStatus   status;

  even.enhance       = CELD_ENHANCE_STACK;
  even.shadow_offset = 0;
  status             = celd_enhance (levels, &even, host, occlusion);
  for (int y = 0; y < occlusion->height && status == CELD_OK; y++)
    for (int x = 0; x < occlusion->width; x++)
      CELD_AT (occlusion, x, y) += 1;
  return status;
}

/* ------------------------------------------------------------------ the change on colours */

/* Scales the value, so that black ink stays black; it becomes no brighter than white. */
static float
changed (float value, float change)
{
  return change < 0 || value >= 1 ? value * fminf (1 + change, 1) : fminf (value * (1 + change), 1);
}

CeldStatus
celd_enhance_colours (const CeldPlane *change, CeldColours *colours)
{
  if (!CELD_SAME_SIZE (change, colours))
    return CELD_BAD_SIZE;
  for (int y = 0; y < change->height; y++)
    for (int x = 0; x < change->width; x++)
      for (int c = 0; c < 3; c++)
        CELD_RGBA (colours, x, y)[c] = changed (CELD_RGBA (colours, x, y)[c], CELD_AT (change, x, y));
  return CELD_OK;
}

CeldStatus
celd_enhance_layer (const CeldPlane *change, CeldColours *layer)
{
  if (!CELD_SAME_SIZE (change, layer))
    return CELD_BAD_SIZE;
  for (int y = 0; y < change->height; y++)
    for (int x = 0; x < change->width; x++)
      {
        float *rgba = CELD_RGBA (layer, x, y);

        rgba[0] = rgba[1] = rgba[2] = 0;
        rgba[3] = fmaxf (0, -CELD_AT (change, x, y));
      }
  return CELD_OK;
}

CeldStatus
celd_enhance_view (const CeldPlane *levels, const CeldPlane *change, CeldPlane *view)
{
  float least, most;

  if (!CELD_SAME_SIZE (levels, change) || !CELD_SAME_SIZE (levels, view))
    return CELD_BAD_SIZE;
  celd_level_range (levels, &least, &most);
  for (int y = 0; y < levels->height; y++)
    for (int x = 0; x < levels->width; x++)
      {
        float near = most > least ? (celd_level_at (levels, x, y) - least) / (most - least) : 1;
        float grey = powf (FAR_GREY + (1 - FAR_GREY) * near, 2.2f);

        CELD_AT (view, x, y) = changed (grey, CELD_AT (change, x, y));
      }
  return CELD_OK;
}
