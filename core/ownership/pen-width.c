/* Widths of pens.
 *
 * Between two regions the thickness of the ink is the width of the nearer one's pen, unless other lines run into it,
 * which only makes it thicker.  So the width is taken from the thinner points, each a median over about a pen's width
 * of the line.  It changes slowly along the line; how much larger than typical it may become depends on how much it
 * varies in all.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "ownership/ownership.h"

#include <math.h>

#define TYPICAL_QUANTILE   0.35  /* quantile of thickness that is the typical width; chosen */
#define THIN_QUANTILE      0.125 /* quantile that tells how much the width varies; chosen */
#define SPREAD_FACTOR      3.f   /* the pen may be thicker than typical by so many times what it is thinner in other
                                  * places; chosen */
#define SUBPIXELS          16.f  /* widths are rounded to 1/16 pixel, the precision of edges */
#define MIN_SWELL          1.04f /* ratio to the typical width that is allowed in any case; chosen */
#define MAX_SWELL          1.25f /* ratio to the typical width that is never exceeded; chosen */
#define MAX_SLOPE          0.05f /* pixels of width per pixel along the line, at most; chosen */
#define MEDIAN_RADIUS      4     /* samples to either side of a median */
#define MAX_LINE_THICKNESS 2.5f  /* pen widths; thicker ink is not one line; chosen */

/* The value at index k in sorted order, by quickselect [Hoare 1961]; reorders the array. */
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

/* Rounded to the precision of edges, so that a distant edit does not change every width by a tiny amount. */
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

/* Sorts thickness by label and takes quantiles. */
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

/* Median thickness round point i, over about a pen's width to either side, of points with the same front label. */
static float
smooth_thickness (const CeldContourPens *pens, const CeldEdgeLoop *loop, size_t i)
{
  const CeldEdgePoint *point = &pens->edges->point[loop->first];
  const CeldEdgePen   *pen = &pens->pen[loop->first];
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

/* Half the thickness, for a line inside a region or between regions of one level, unless the normal runs along
 * another line. */
static float
shared_width (const CeldContourPens *pens, const CeldEdgePoint *p, const CeldEdgePen *pen)
{
  float typical = pens->typical_width[pen->near - 1];

  return pen->far && !(typical > 0 && p->thickness > MAX_LINE_THICKNESS * typical) ? p->thickness / 2 : typical;
}

/* Limits the change of width from point a to b. */
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
  CeldEdgePen         *pen = &pens->pen[loop->first];
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
