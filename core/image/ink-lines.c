/* A filter against grain that smooths along lines and edges, not across them, so that neither a faint line grows
 * fainter nor do two lines side by side become one.
 *
 * The direction of lines is that of least change by the structure tensor (Bigün and Granlund, 1987): products of
 * slopes, averaged over the pixels around.  Where change stands out from noise and has one direction, each pixel
 * becomes the mean along it, with more weight near by.  Where lines meet or turn there is no such direction; there a
 * line is at least as dark as it was.
 *
 * Cost: O(pixels); 4 bytes a pixel.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/ink-steps.h"

#include <math.h>
#include <stdlib.h>

#define CELL      2     /* pixels, a side, with one tensor */
#define SPREADS   2     /* binomial filters over tensors, each by about 1.4 pixels; chosen */
#define TAP_REACH 4     /* pixels along a line to either side; chosen */
#define CHANGE    2     /* of a line, at least: its squared slope in squares of the noise; chosen */
#define ONE_WAY   0.3f  /* how much of the change along a line has one direction, 0 .. 1, at least; chosen */

/* Means of products of the slopes in x and y. */
typedef struct { CeldPlane xx, xy, yy, spare; } Tensors;

/* The pixels of a mean along a line, as differences from the one in the middle. */
typedef struct { int x[4 * TAP_REACH + 2], y[4 * TAP_REACH + 2], n; float weight[4 * TAP_REACH + 2]; } Taps;

static int
inside (int i, int n)
{
  return i < 0 ? 0 : i < n ? i : n - 1;
}

/* ------------------------------------------------------------------ directions */

static CeldStatus
tensors_new (const CeldPlane *smooth, Tensors *t)
{
  int width = (smooth->width + CELL - 1) / CELL, height = (smooth->height + CELL - 1) / CELL;

  *t = (Tensors) { 0 };
  if (celd_plane_new (width, height, &t->xx) != CELD_OK || celd_plane_new (width, height, &t->xy) != CELD_OK ||
      celd_plane_new (width, height, &t->yy) != CELD_OK)
    return CELD_NO_MEMORY;
  return celd_plane_new (width, height, &t->spare);
}

static void
tensors_clear (Tensors *t)
{
  celd_free (t->xx.data);
  celd_free (t->xy.data);
  celd_free (t->yy.data);
  celd_free (t->spare.data);
}

static void
measure_tensors (const CeldPlane *smooth, Tensors *t)
{
  for (int j = 0; j < t->xx.height; j++)
    {
      const float *row = &CELD_AT (smooth, 0, CELL * j);
      const float *above = &CELD_AT (smooth, 0, inside (CELL * j - 1, smooth->height));
      const float *below = &CELD_AT (smooth, 0, inside (CELL * j + 1, smooth->height));

      for (int i = 0; i < t->xx.width; i++)
        {
          int   x = CELL * i;
          float across = row[inside (x + 1, smooth->width)] - row[inside (x - 1, smooth->width)];
          float down = below[x] - above[x];

          CELD_AT (&t->xx, i, j) = across * across;
          CELD_AT (&t->xy, i, j) = across * down;
          CELD_AT (&t->yy, i, j) = down * down;
        }
    }
  for (int k = 0; k < SPREADS; k++)
    {
      celd_ink_smooth (&t->xx, &t->spare);
      celd_ink_smooth (&t->xy, &t->spare);
      celd_ink_smooth (&t->yy, &t->spare);
    }
}

/* ------------------------------------------------------------------ means along lines */

static void
add_tap (Taps *taps, bool steep, int along, int aside, float weight)
{
  taps->x[taps->n] = steep ? aside : along;
  taps->y[taps->n] = steep ? along : aside;
  taps->weight[taps->n++] = weight;
}

/* The taps along the direction (dx,dy) of length 1, with linear interpolation between pixels side by side. */
static Taps
taps_along (float dx, float dy)
{
  bool  steep = fabsf (dy) > fabsf (dx);
  float slope = steep ? dx / dy : dy / dx;
  int   reach = (int) (TAP_REACH * fmaxf (fabsf (dx), fabsf (dy)) + 0.5f);
  Taps  taps = { .n = 0 };

  for (int k = -reach; k <= reach; k++)
    {
      float weight = (float) (reach + 1 - abs (k)) / (float) ((reach + 1) * (reach + 1));
      float aside = slope * (float) k, lower = floorf (aside), share = aside - lower;

      add_tap (&taps, steep, k, (int) lower, weight * (1 - share));
      add_tap (&taps, steep, k, (int) lower + 1, weight * share);
    }
  return taps;
}

static float
mean_of_taps (const CeldPlane *plane, int x, int y, const Taps *taps)
{
  float sum = 0;

  for (int k = 0; k < taps->n; k++)
    sum += taps->weight[k] *
           CELD_AT (plane, inside (x + taps->x[k], plane->width), inside (y + taps->y[k], plane->height));
  return sum;
}

/* Sets mean[] to the means of the pixels of cell (i,j), row by row. */
static void
means_of_cell (const CeldPlane *plane, int i, int j, const Taps *taps, float mean[CELL * CELL])
{
  int  x = CELL * i, y = CELL * j;
  bool far_inside = x > TAP_REACH && y > TAP_REACH && x < plane->width - TAP_REACH - CELL &&
                    y < plane->height - TAP_REACH - CELL;

  for (int p = 0; p < CELL * CELL; p++)
    mean[p] = far_inside ? 0 : mean_of_taps (plane, x + p % CELL, y + p / CELL, taps);
  if (far_inside)
    for (int k = 0; k < taps->n; k++)
      {
        const float *tap = &CELD_AT (plane, x + taps->x[k], y + taps->y[k]);

        for (int p = 0; p < CELL * CELL; p++)
          mean[p] += taps->weight[k] * tap[(size_t) (p % CELL) + (size_t) (p / CELL) * plane->stride];
      }
}

/* Where a value lies between two others: 0 up to `low`, 1 from `high` on. */
static float
part_between (float value, float low, float high)
{
  return celd_least (celd_most ((value - low) / (high - low), 0), 1);
}

/* Smooths the pixels of cell (i,j) if something changes there by at least `least`. */
static void
smooth_cell (const CeldPlane *contrast, const Tensors *t, int i, int j, float least, CeldPlane *smooth)
{
  float xx = CELD_AT (&t->xx, i, j), xy = CELD_AT (&t->xy, i, j), yy = CELD_AT (&t->yy, i, j);
  float change = xx + yy, clear, one_way, line, mean[CELL * CELL] = { 0 };

  if (change <= least)
    return;
  clear = part_between (change, least, 2 * least);
  one_way = sqrtf ((xx - yy) * (xx - yy) + 4 * xy * xy);
  line = part_between (one_way / change, 0, ONE_WAY);
  if (line > 0)
    {
      float dx = sqrtf (0.5f * celd_most (1 - (xx - yy) / one_way, 0)); /* at right angles to the change */
      Taps  taps = taps_along (dx, copysignf (sqrtf (celd_most (1 - dx * dx, 0)), -xy));

      means_of_cell (contrast, i, j, &taps, mean);
    }
  for (int y = CELL * j; y < CELL * (j + 1) && y < smooth->height; y++)
    for (int x = CELL * i; x < CELL * (i + 1) && x < smooth->width; x++)
      {
        float *s = &CELD_AT (smooth, x, y), value = celd_most (CELD_AT (contrast, x, y), *s);

        if (line > 0)
          value += line * (mean[x % CELL + CELL * (y % CELL)] - value);
        *s += clear * (value - *s);
      }
}

CeldStatus
celd_ink_smooth_lines (const CeldPlane *contrast, float noise, CeldPlane *smooth)
{
  Tensors    t;
  CeldStatus status = tensors_new (smooth, &t);

  if (status == CELD_OK)
    {
      measure_tensors (smooth, &t);
      for (int j = 0; j < t.xx.height; j++)
        for (int i = 0; i < t.xx.width; i++)
          smooth_cell (contrast, &t, i, j, CHANGE * noise * noise, smooth);
    }
  tensors_clear (&t);
  return status;
}
