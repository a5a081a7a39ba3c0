/* How wide a pen is.
 *
 * Between two regions the ink is as thick as the nearer one's pen is wide, unless other lines run into it: these only
 * make it thicker.  So a pen is as wide as its thinner places say, each a median over a pen's width of the line; it
 * changes slowly along the line, and the less it varies in all, the less it may swell.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "ownership/contours.h"

#include <math.h>

#define TYPICAL_QUANTILE    0.35    /* share of a pen's places that are thinner than its usual width */
#define THIN_QUANTILE     0.125   /* and of those that tell how much it varies */
#define SPREAD_FACTOR   3.f     /* a pen may be thicker in places by so much of what it is thinner in others */
#define SUBPIXELS    16.f    /* parts of a pixel */
#define MIN_SWELL   1.04f   /* and by so much in any case; */
#define MAX_SWELL    1.25f   /* but by no more than this */
#define MAX_SLOPE    0.05f   /* how fast its width changes along the line */
#define MEDIAN_RADIUS  4       /* places to either side that a width is the median of */
#define MAX_LINE_THICKNESS    2.5f    /* pen widths that a line may be thick */

/* What would stand at place k if the widths were sorted; orders them around it [Hoare 1961]. */
static float
select_quantile (float *width, size_t n, size_t k)
{
  size_t from = 0, end = n;

  while (end - from > 1)
    {
      float  pivot = width[from + (end - from) / 2];
      size_t low = from, same = from, high = end;

      while (same < high)
        {
          float here = width[same];

          if (here < pivot)
            {
              width[same++] = width[low];
              width[low++]  = here;
            }
          else if (here > pivot)
            {
              width[same]   = width[--high];
              width[high]   = here;
            }
          else
            same++;
        }
      if (k < low)
        end = low;
      else if (k >= high)
        from = high;
      else
        return pivot;
    }
  return width[k];
}

/* Rounded to what edges are found to, so that an edit far off does not change every width by a hair. */
static float
quantile (float *width, size_t n, double fraction)
{
  return roundf (SUBPIXELS * select_quantile (width, n, (size_t) (fraction * (double) n))) / SUBPIXELS;
}

static void
set_pen_widths (float *width, size_t n, float *typical, float *max)
{
  float thin = quantile (width, n, THIN_QUANTILE);

  *typical = quantile (width, n, TYPICAL_QUANTILE);
  *max  = fminf (SPREAD_FACTOR * (*typical - thin) + MIN_SWELL * *typical, MAX_SWELL * *typical);
}

/* Lists the widths by label. */
CeldStatus
celd_pen_widths_measure (CeldContourPens *pens)
{
  size_t     points = pens->edges->n_points;
  size_t    *from = celd_alloc0 (pens->n + 2, sizeof *from);
  float     *width = celd_alloc (points + 1, sizeof *width);
  CeldStatus status = from && width ? CELD_OK : CELD_NO_MEMORY;

  if (status == CELD_OK)
    {
      for (size_t i = 0; i < points; i++)
        from[celd_pen_front (pens, &pens->pen[i])]++;
      for (size_t k = 1; k <= pens->n + 1; k++)
        from[k] += from[k - 1];
      for (size_t i = points; i-- > 0;)
        width[--from[celd_pen_front (pens, &pens->pen[i])]] = pens->edges->point[i].thickness;
    }
  for (size_t k = 1; k <= pens->n && status == CELD_OK; k++)
    {
      size_t n = from[k + 1] - from[k];

      if (n)
        set_pen_widths (width + from[k], n, &pens->typical_width[k - 1], &pens->max_width[k - 1]);
    }
  celd_free (from);
  celd_free (width);
  return status;
}

/* ------------------------------------------------------------------ along the line */

/* The median of some places round place i, about a pen's width to either side, that have the same front. */
static float
smooth_thickness (const CeldContourPens *pens, const CeldEdgeLoop *loop, size_t i)
{
  const CeldEdgePoint *point = &pens->edges->point[loop->first];
  const CeldEdgePen       *pen = &pens->pen[loop->first];
  uint32_t             front = celd_pen_front (pens, &pen[i]);
  float                found[2 * MEDIAN_RADIUS + 1];
  size_t               stride = 1 + (size_t) (pens->typical_width[front - 1] / MEDIAN_RADIUS), n = 0;
  size_t               at = (i + loop->n - MEDIAN_RADIUS * stride % loop->n) % loop->n;

  for (int k = -MEDIAN_RADIUS; k <= MEDIAN_RADIUS; k++, at = (at + stride) % loop->n)
    if (!point[at].skewed && celd_pen_front (pens, &pen[at]) == front)
      {
        size_t slot = n++;

        for (; slot > 0 && found[slot - 1] > point[at].thickness; slot--)
          found[slot] = found[slot - 1];
        found[slot] = point[at].thickness;
      }
  return n ? found[n / 2] : INFINITY;
}

/* Of a line inside a region, or between regions of one level, each side has half; but the normal must not go along
 * another line. */
static float
shared_width (const CeldContourPens *pens, const CeldEdgePoint *p, const CeldEdgePen *pen)
{
  float typical = pens->typical_width[pen->near - 1];

  return pen->far && !(typical > 0 && p->thickness > MAX_LINE_THICKNESS * typical) ? p->thickness / 2 : typical;
}

/* No steeper than a pen, from place a to b. */
static void
limit_slope (const CeldContourPens *pens, float step, size_t a, size_t b, CeldEdgePen *pen)
{
  uint32_t front = celd_pen_front (pens, &pen[a]);

  if (front && front == celd_pen_front (pens, &pen[b]))
    {
      float most = pen[a].width + MAX_SLOPE * step;

      pen[b].width = most < pen[b].width ? most : pen[b].width;
    }
}

void
celd_pen_widths_smooth (const CeldEdgeLoop *loop, CeldContourPens *pens)
{
  const CeldEdgePoint *point = &pens->edges->point[loop->first];
  CeldEdgePen             *pen = &pens->pen[loop->first];
  size_t               n = loop->n;

  for (size_t i = 0; i < n; i++)
    {
      uint32_t front = celd_pen_front (pens, &pen[i]);

      if (front)
        pen[i].width = fminf (smooth_thickness (pens, loop, i), pens->max_width[front - 1]);
      else
        pen[i].width = pen[i].near ? shared_width (pens, &point[i], &pen[i]) : 0;
    }
  for (size_t i = 1; i < 2 * n; i++)
    limit_slope (pens, point[(i - 1) % n].step, (i - 1) % n, i % n, pen);
  for (size_t i = 2 * n; i-- > 1;)
    limit_slope (pens, point[(i - 1) % n].step, i % n, (i - 1) % n, pen);
}
