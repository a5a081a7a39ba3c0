/* How far pixels are from the middle of the line near them, by which a line keeps its width when a puppet is stretched.
 *
 * Ink is deepest along the middle of a line.  Ink that is deeper than lines are is an area, and stretched with its
 * part.  The offset from the nearest pixel of the middle changes in steps from one of these to the next; its mean over
 * a few pixels has no steps, and is the same across the line.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/puppet.h"

#define MOST_DEPTH 1.5 /* of ink in a line, in stroke widths; chosen */
#define LINE_REACH 1.5 /* half widths of a line, from its middle up to where it has an effect; chosen */
#define MEAN_REACH 2   /* pixels on each side that the mean is taken over; chosen */

/* Marks ink that is not less deep than that around it, if that is a line. */
static void
mark_middles (int width, int height, const int32_t *squared, int32_t least, uint8_t *middle)
{
  for (int y = 0; y < height; y++)
    for (int x = 0; x < width; x++)
      {
        size_t p = (size_t) y * (size_t) width + (size_t) x;
        bool   deepest = squared[p] < 0 && squared[p] >= least;

        for (int v = y > 0 ? y - 1 : 0; deepest && v <= y + 1 && v < height; v++)
          for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < width; u++)
            deepest &= squared[(size_t) v * (size_t) width + (size_t) u] >= squared[p];
        middle[p] = deepest;
      }
}

/* The offsets from the nearest middle; 0,0 beyond reach. */
static void
measure_offsets (int width, int height, const int32_t *depth, const int32_t *nearest, float *offset)
{
  for (int y = 0; y < height; y++)
    for (int x = 0; x < width; x++)
      {
        size_t  p = (size_t) y * (size_t) width + (size_t) x;
        int32_t middle = nearest[p];
        int     dx = middle < 0 ? 0 : x - middle % width, dy = middle < 0 ? 0 : y - middle / width;
        double  reach = middle < 0 ? 0 : LINE_REACH * (sqrt (-(double) depth[middle]) + 1);
        bool    near = hypot (dx, dy) <= reach;

        offset[2 * p]     = near ? (float) dx : 0;
        offset[2 * p + 1] = near ? (float) dy : 0;
      }
}

/* Takes the mean of pairs of numbers along n rows of `length` pairs; steps are in pairs. */
static void
smooth_rows (const float *from, size_t n, size_t length, size_t row, size_t step, float *to)
{
  for (size_t i = 0; i < n; i++)
    for (size_t k = 0; k < length; k++)
      {
        size_t first = k > MEAN_REACH ? k - MEAN_REACH : 0;
        size_t end = k + MEAN_REACH + 1 < length ? k + MEAN_REACH + 1 : length;
        float  sum[2] = { 0, 0 };

        for (size_t j = first; j < end; j++)
          for (size_t c = 0; c < 2; c++)
            sum[c] += from[2 * (i * row + j * step) + c];
        for (size_t c = 0; c < 2; c++)
          to[2 * (i * row + k * step) + c] = sum[c] / (float) (end - first);
      }
}

CeldStatus
celd_puppet_measure_lines (CeldPuppet *puppet, const CeldPlane *ink, const CeldHost *host)
{
  size_t     w = (size_t) ink->width, h = (size_t) ink->height;
  double     most = MOST_DEPTH * celd_stroke_width (ink);
  int32_t   *depth = celd_alloc (w * h, sizeof *depth), *distance = celd_alloc (w * h, sizeof *distance);
  int32_t   *nearest = celd_alloc (w * h, sizeof *nearest);
  uint8_t   *middle = celd_alloc (w * h, 1);
  float     *rows = celd_alloc (w * h, 2 * sizeof *rows);
  CeldStatus status;

  puppet->line = celd_alloc (w * h, 2 * sizeof *puppet->line);
  status = depth && distance && nearest && middle && rows && puppet->line ? celd_signed_distance (ink, host, depth)
                                                                          : CELD_NO_MEMORY;
  if (status == CELD_OK)
    {
      mark_middles (ink->width, ink->height, depth, (int32_t) -(most * most), middle);
      status = celd_nearest (ink->width, ink->height, middle, host, distance, nearest);
    }
  if (status == CELD_OK)
    {
      measure_offsets (ink->width, ink->height, depth, nearest, puppet->line);
      smooth_rows (puppet->line, h, w, w, 1, rows);
      smooth_rows (rows, w, h, 1, w, puppet->line);
    }
  celd_free (depth);
  celd_free (distance);
  celd_free (nearest);
  celd_free (middle);
  celd_free (rows);
  return status;
}
