/* Widths of pens.
 *
 * Between two regions the thickness of the ink is the width of the nearer one's pen, unless other lines run into it,
 * which only makes it thicker.  A region may lie on the outline of another one along all of their contact, like a sheet
 * of paper on a thick cover.  So the width is taken from the neighbours where the ink is thinnest, and there from the
 * thinner points, each a median over about a pen's width of the line.  It changes slowly along the line; how much
 * larger than typical it may become depends on how much it varies in all.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "ownership/ownership.h"

#include <math.h>
#include <stdlib.h>

#define TYPICAL_QUANTILE   0.35  /* quantile of thickness that is the typical width; chosen */
#define THIN_QUANTILE      0.125 /* quantile that tells how much the width varies; chosen */
#define SPREAD_FACTOR      3.f   /* the pen may be thicker than typical by so many times what it is thinner in other
                                  * places; chosen */
#define MIN_POINTS         24    /* points of the edges of a contact that shows the width of a pen; chosen */
#define MIN_CONTACT        0.05f /* share of such a contact in the outline, at least; chosen */
#define DISTINCT_SPREADS   3.f   /* a contact is thickened if it is thicker than the thinnest one by so many times what
                                  * that one varies, */
#define DISTINCT_PIXELS    0.5f  /* and so many pixels; chosen */
#define MIN_WIDER          1.4f  /* ratio of two pens that are not one brush; chosen */
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

/* ------------------------------------------------------------------ by neighbours */

typedef struct { uint32_t level, label; } PlacedLabel;

/* Work space: points sorted by front label, those of label k at from[k] .. from[k + 1] - 1, and among these by the
 * label behind; widths of some of them; labels from back to front. */
typedef struct { uint32_t *point, *spare; size_t *from; float *width; PlacedLabel *place; } PenSort;

/* The label behind the front label; any of both if there is no front label. */
static uint32_t
pen_back (const CeldContourPens *pens, const CeldEdgePen *pen)
{
  return celd_pen_front (pens, pen) == pen->near ? pen->far : pen->near;
}

/* Stable counting sort of all points, in the order of `in` (NULL: that of the edges), by the label in front or
 * behind. */
static void
sort_points (const CeldContourPens *pens, bool front, const uint32_t *in, PenSort *s, uint32_t *out)
{
  uint32_t (*label_of) (const CeldContourPens *, const CeldEdgePen *) = front ? celd_pen_front : pen_back;
  size_t n = pens->edges->n_points;

  memset (s->from, 0, (pens->n + 2) * sizeof *s->from);
  for (size_t i = 0; i < n; i++)
    s->from[label_of (pens, &pens->pen[i])]++;
  for (size_t k = 1; k <= pens->n + 1; k++)
    s->from[k] += s->from[k - 1];
  for (size_t i = n; i-- > 0;)
    {
      uint32_t point = in ? in[i] : (uint32_t) i;

      out[--s->from[label_of (pens, &pens->pen[point])]] = point;
    }
}

/* Reads the thickness at the contact with a label behind that begins at point `first`; returns where the next one
 * begins. */
static size_t
read_contact (const CeldContourPens *pens, const PenSort *s, size_t first, size_t end, float *width)
{
  uint32_t back = pen_back (pens, &pens->pen[s->point[first]]);
  size_t   i = first;

  for (; i < end && pen_back (pens, &pens->pen[s->point[i]]) == back; i++)
    width[i - first] = pens->edges->point[s->point[i]].thickness;
  return i;
}

/* Typical thickness of contacts that shows another line beside the pen's: more than `least`, at most `most`. */
typedef struct { float least, most; } Thickened;

/* Such a contact is clearly thicker than the one where the ink is thinnest, but not thicker than the widest pen of a
 * label behind, or than both pens side by side if that one is clearly wider.  Otherwise the pen itself varies, as
 * brushes do. */
static Thickened
find_thickened (const CeldContourPens *pens, const PenSort *s, size_t first, size_t end)
{
  size_t    least = (size_t) fmaxf (MIN_POINTS, MIN_CONTACT * (float) (end - first));
  float     thinnest = INFINITY, widest = 0;
  Thickened range = { INFINITY, 0 };

  for (size_t i = first, next; i < end; i = next)
    {
      float typical;

      widest = fmaxf (widest, pens->typical_width[pen_back (pens, &pens->pen[s->point[i]]) - 1]);
      next   = read_contact (pens, s, i, end, s->width);
      if (next - i < least)
        continue;
      typical = quantile (s->width, next - i, TYPICAL_QUANTILE);
      if (typical < thinnest)
        {
          thinnest    = typical;
          range.least = typical + DISTINCT_PIXELS +
                        DISTINCT_SPREADS * (quantile (s->width, next - i, 1 - TYPICAL_QUANTILE) - typical);
        }
    }
  range.most = DISTINCT_PIXELS + widest + (widest >= MIN_WIDER * thinnest ? thinnest : 0);
  return range;
}

/* Measures the pen of a label at the contacts where the ink shows it alone, and marks the points of the others; the
 * pens of all labels behind have to be measured before. */
static void
measure_label (uint32_t label, PenSort *s, CeldContourPens *pens)
{
  size_t    first = s->from[label], end = s->from[label + 1], n = 0;
  Thickened range = find_thickened (pens, s, first, end);

  for (size_t i = first, next; i < end; i = next)
    {
      float typical = 0;

      next = read_contact (pens, s, i, end, s->width + n);
      if (range.least < range.most)
        typical = quantile (s->width + n, next - i, TYPICAL_QUANTILE);
      if (!(typical > range.least && typical <= range.most))
        n += next - i;
      else
        for (size_t k = i; k < next; k++)
          pens->pen[s->point[k]].thickened = 1;
    }
  if (n)
    set_pen_widths (s->width, n, &pens->typical_width[label - 1], &pens->max_width[label - 1]);
}

static int
compare_places (const void *a, const void *b)
{
  const PlacedLabel *p = a, *q = b;

  return (p->level > q->level) - (p->level < q->level);
}

CeldStatus
celd_pen_widths_measure (CeldContourPens *pens)
{
  size_t     points = pens->edges->n_points;
  PenSort    s = { celd_alloc (points + 1, sizeof *s.point), celd_alloc (points + 1, sizeof *s.spare),
                   celd_alloc (pens->n + 2, sizeof *s.from), celd_alloc (points + 1, sizeof *s.width),
                   celd_alloc (pens->n + 1, sizeof *s.place) };
  CeldStatus status = s.point && s.spare && s.from && s.width && s.place ? CELD_OK : CELD_NO_MEMORY;

  if (status == CELD_OK)
    {
      sort_points (pens, false, NULL, &s, s.spare);
      sort_points (pens, true, s.spare, &s, s.point);
      for (uint32_t k = 1; k <= pens->n; k++)
        s.place[k - 1] = (PlacedLabel) { pens->level[k - 1], k };
      qsort (s.place, pens->n, sizeof *s.place, compare_places);
      for (size_t k = 0; k < pens->n; k++)
        measure_label (s.place[k].label, &s, pens);
    }
  celd_free (s.point);
  celd_free (s.spare);
  celd_free (s.from);
  celd_free (s.width);
  celd_free (s.place);
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
