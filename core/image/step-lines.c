/* Whether levels belong to a drawing: parts end at its lines.
 *
 * Of the steps of levels of 28 drawings, also of grainy ones and of such with wide gaps, at least 0.85 are at lines of
 * their own drawing; at those of other drawings, in the same size, at most 0.34, and at strokes of their scribbles,
 * which keep away from lines, at most 0.05.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"

#include <math.h>

#define LEVEL_STEP       32    /* of the range of levels; what differs by less is a slope, or loss in a file; chosen */
#define STEP_REACH       300   /* the diagonal divided by how far from a line a step is at it (chosen) */
#define LEAST_STEP_REACH 2     /* pixels; chosen */
#define LINE_VALUE       0.5f  /* what is darker is a line; chosen */
#define FEW_STEPS        4     /* width and height divided by the number of steps that tell too little; chosen */
#define MOST_SAMPLES     20000 /* steps that are looked at; chosen */

static bool
is_step (const CeldPlane *levels, int x, int y, float least)
{
  float value = CELD_AT (levels, x, y);

  return (x + 1 < levels->width && fabsf (CELD_AT (levels, x + 1, y) - value) > least) ||
         (y + 1 < levels->height && fabsf (CELD_AT (levels, x, y + 1) - value) > least);
}

static size_t
count_steps (const CeldPlane *levels, float least)
{
  size_t steps = 0;

  for (int y = 0; y < levels->height; y++)
    for (int x = 0; x < levels->width; x++)
      steps += is_step (levels, x, y, least);
  return steps;
}

static bool
is_at_line (const CeldPlane *lines, int x, int y, int reach)
{
  int left = x > reach ? x - reach : 0, top = y > reach ? y - reach : 0;

  for (int v = top; v <= y + reach && v < lines->height; v++)
    for (int u = left; u <= x + reach && u < lines->width; u++)
      if (CELD_AT (lines, u, v) < LINE_VALUE)
        return true;
  return false;
}

double
celd_steps_on_lines (const CeldPlane *levels, const CeldPlane *lines)
{
  int    reach = (int) (hypot (levels->width, levels->height) / STEP_REACH);
  size_t all, seen = 0, found = 0, stride, number = 0;
  float  least, most, step;

  reach = reach > LEAST_STEP_REACH ? reach : LEAST_STEP_REACH;
  celd_level_range (levels, &least, &most);
  step = (most - least) / LEVEL_STEP;
  all  = count_steps (levels, step);
  if (FEW_STEPS * all < (size_t) levels->width + (size_t) levels->height)
    return 1;
  stride = 1 + all / MOST_SAMPLES;
  for (int y = 0; y < levels->height; y++)
    for (int x = 0; x < levels->width; x++)
      if (is_step (levels, x, y, step) && number++ % stride == 0)
        {
          seen++;
          found += is_at_line (lines, x, y, reach);
        }
  return (double) found / (double) seen;
}
