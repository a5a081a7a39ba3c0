/* Widths of pens.
 *
 * Between two regions the thickness of the ink is the width of the nearer one's pen, unless other lines run into it,
 * which only makes it thicker.  A region may lie on the outline of another one, or beside it, along all of their
 * contact, like a sheet of paper on a thick cover, or two sides of a box.  Such a second line shows where the ink is
 * thicker than at the thinnest contacts, by more than the pen varies there and than pens of this drawing vary.  The
 * width is taken from the other contacts, and there from the thinner points, each a median over about a pen's width of
 * the line.  It changes slowly along the line; how much larger than typical it may become depends on how much it varies
 * in all.
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
#define MIN_POINTS         24    /* points of the edges of a contact, at least, that shows the width of a pen; chosen */
#define SAMPLE_SHARE       0.25f /* share of the outline over which a pen's variation is measured, at least; chosen */
#define MIN_SAMPLE         0.1f  /* the same if the other contacts are far thicker; chosen */
#define THICK_QUANTILE     0.9   /* quantile of thickness where a pen is widest, but for junctions; chosen */
#define MAX_SPREAD         0.7f  /* ratio to the typical width by which a pen is thicker where it is widest, at most;
                                  * chosen */
#define MIN_WIDER          1.4f  /* ratio of thickness at two contacts that are not one pen's alone; chosen */
#define DISTINCT_SPREADS   1.5f  /* a contact is thickened if it is thicker than the pen's sample by so many times what
                                  * pens vary, */
#define DISTINCT_PIXELS    0.5f  /* and so many pixels; chosen */
#define SUBPIXELS          16.f  /* widths are rounded to 1/16 pixel, the precision of edges */
#define MIN_SWELL          1.04f /* ratio to the typical width that is allowed in any case; chosen */
#define MAX_SWELL          1.4f  /* ratio to the typical width that is never exceeded; chosen */
#define MIN_STROKES        4     /* widths of the drawing's lines; a shorter outline does not show how a pen varies;
                                  * chosen */
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

/* Sets typical and largest width of a pen.  A shorter outline is mostly junctions. */
static void
set_pen_widths (float *width, size_t n, int stroke, float *typical, float *max)
{
  float thin = quantile (width, n, THIN_QUANTILE);

  *typical = quantile (width, n, TYPICAL_QUANTILE);
  *max  = MIN_SWELL * *typical;
  if (n >= MIN_STROKES * (size_t) stroke)
    *max = fminf (*max + SPREAD_FACTOR * (*typical - thin), MAX_SWELL * *typical);
}

/* ------------------------------------------------------------------ by neighbours */

typedef struct { uint32_t level, label; } PlacedLabel;

/* The contact of a label with one label behind it: the points first .. end - 1 of PenSort, and their typical
 * thickness. */
typedef struct { size_t first, end; float typical; } PenContact;

/* What a label's thinnest contacts show of its pen: typical thickness, how much that varies, both in pixels, and the
 * number of their points; 0: nothing. */
typedef struct { float typical, spread; size_t points; } PenSample;

/* Work space: points sorted by front label, those of label k at from[k] .. from[k + 1] - 1, and among these by the
 * label behind; widths of some of them; labels from back to front; samples of labels, at k - 1; contacts of one
 * label. */
typedef struct
{
  uint32_t    *point, *spare;
  size_t      *from;
  float       *width;
  PlacedLabel *place;
  PenSample   *sample;
  PenContact  *contact;
} PenSort;

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

static int
compare_contacts (const void *a, const void *b)
{
  const PenContact *p = a, *q = b;

  return p->typical != q->typical ? (p->typical > q->typical) - (p->typical < q->typical)
                                  : (p->first > q->first) - (p->first < q->first);
}

/* Lists the contacts of a label, the thinnest first; returns their number. */
static size_t
list_contacts (const CeldContourPens *pens, const PenSort *s, uint32_t label)
{
  size_t n = 0;

  for (size_t i = s->from[label], next; i < s->from[label + 1]; i = next, n++)
    {
      next          = read_contact (pens, s, i, s->from[label + 1], s->width);
      s->contact[n] = (PenContact) { i, next, quantile (s->width, next - i, TYPICAL_QUANTILE) };
    }
  qsort (s->contact, n, sizeof *s->contact, compare_contacts);
  return n;
}

/* Samples the pen of a label at its thinnest contacts, as many as make up a good part of its outline, or less if the
 * others are far thicker. */
static PenSample
sample_pen (const CeldContourPens *pens, const PenSort *s, uint32_t label)
{
  size_t contacts = list_contacts (pens, s, label), points = s->from[label + 1] - s->from[label], n = 0;
  float  thinnest = 0, typical;

  for (size_t k = 0; k < contacts && (float) n < SAMPLE_SHARE * (float) points; k++)
    {
      const PenContact *c = &s->contact[k];

      if (c->end - c->first < MIN_POINTS)
        continue;
      if ((float) n > MIN_SAMPLE * (float) points && c->typical > MIN_WIDER * thinnest)
        break;
      thinnest = n ? thinnest : c->typical;
      n       += read_contact (pens, s, c->first, c->end, s->width + n) - c->first;
    }
  if (!n)
    return (PenSample) { 0 };
  typical = quantile (s->width, n, TYPICAL_QUANTILE);
  return (PenSample) { typical, fminf (quantile (s->width, n, THICK_QUANTILE) - typical, MAX_SPREAD * typical), n };
}

typedef struct { float variation; size_t points; } Variation;

static int
compare_variations (const void *a, const void *b)
{
  const Variation *p = a, *q = b;

  return (p->variation > q->variation) - (p->variation < q->variation);
}

/* How much the pens of the drawing vary, as a share of their width: the median over all outlines. */
static CeldStatus
find_variation (const PenSort *s, size_t labels, float *variation)
{
  Variation *list = celd_alloc (labels, sizeof *list);
  size_t     n = 0, points = 0, below = 0;

  if (!list)
    return CELD_NO_MEMORY;
  for (size_t k = 0; k < labels; k++)
    if (s->sample[k].typical > 0)
      {
        points   += s->sample[k].points;
        list[n++] = (Variation) { s->sample[k].spread / s->sample[k].typical, s->sample[k].points };
      }
  qsort (list, n, sizeof *list, compare_variations);
  *variation = 0;
  for (size_t k = 0; k < n && 2 * below < points; below += list[k++].points)
    *variation = list[k].variation;
  celd_free (list);
  return CELD_OK;
}

/* The typical thickness beyond which a contact shows another line beside the pen's: it is clearly thicker than the pen
 * is where it is thinnest.  Up to there the pen itself varies, as brushes do: as much as in its sample, or as others of
 * the drawing. */
static float
most_of_pen (PenSample sample, float variation)
{
  return sample.points ? sample.typical + DISTINCT_PIXELS +
                         DISTINCT_SPREADS * fmaxf (sample.spread, variation * sample.typical)
                       : INFINITY;
}

/* Measures the pen of a label at the contacts where the ink shows it alone, and marks the points of the others; the
 * pens of all labels behind have to be measured before. */
static void
measure_label (uint32_t label, float variation, PenSort *s, CeldContourPens *pens)
{
  size_t n = 0, contacts = list_contacts (pens, s, label);
  float  most = most_of_pen (s->sample[label - 1], variation);

  for (size_t k = 0; k < contacts; k++)
    {
      const PenContact *c = &s->contact[k];

      if (c->typical <= most)
        n += read_contact (pens, s, c->first, c->end, s->width + n) - c->first;
      else
        for (size_t i = c->first; i < c->end; i++)
          pens->pen[s->point[i]].thickened = 1;
    }
  if (n)
    set_pen_widths (s->width, n, pens->edges->stroke, &pens->typical_width[label - 1], &pens->max_width[label - 1]);
}

static int
compare_places (const void *a, const void *b)
{
  const PlacedLabel *p = a, *q = b;

  return (p->level > q->level) - (p->level < q->level);
}

/* Samples the pens, and then measures them from back to front. */
static CeldStatus
measure_labels (PenSort *s, CeldContourPens *pens)
{
  float      variation;
  CeldStatus status;

  for (uint32_t k = 1; k <= pens->n; k++)
    {
      s->place[k - 1]  = (PlacedLabel) { pens->level[k - 1], k };
      s->sample[k - 1] = sample_pen (pens, s, k);
    }
  qsort (s->place, pens->n, sizeof *s->place, compare_places);
  status = find_variation (s, pens->n, &variation);
  for (size_t k = 0; k < pens->n && status == CELD_OK; k++)
    measure_label (s->place[k].label, variation, s, pens);
  return status;
}

CeldStatus
celd_pen_widths_measure (CeldContourPens *pens)
{
  size_t     points = pens->edges->n_points;
  PenSort    s = { celd_alloc (points + 1, sizeof *s.point), celd_alloc (points + 1, sizeof *s.spare),
                   celd_alloc (pens->n + 2, sizeof *s.from), celd_alloc (points + 1, sizeof *s.width),
                   celd_alloc (pens->n, sizeof *s.place), celd_alloc (pens->n, sizeof *s.sample),
                   celd_alloc (pens->n, sizeof *s.contact) };
  CeldStatus status = s.point && s.spare && s.from && s.width && s.place && s.sample && s.contact ? CELD_OK
                                                                                                   : CELD_NO_MEMORY;

  if (status == CELD_OK)
    {
      sort_points (pens, false, NULL, &s, s.spare);
      sort_points (pens, true, s.spare, &s, s.point);
      status = measure_labels (&s, pens);
    }
  celd_free (s.point);
  celd_free (s.spare);
  celd_free (s.from);
  celd_free (s.width);
  celd_free (s.place);
  celd_free (s.sample);
  celd_free (s.contact);
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

      if (front) /* beside another line the ink does not tell how much the pen varies */
        pen[i].width = fminf (smooth_thickness (pens, loop, i),
                              (pen[i].thickened ? pens->typical_width : pens->max_width)[front - 1]);
      else
        pen[i].width = pen[i].near ? shared_width (pens, &point[i], &pen[i]) : 0;
    }
  for (size_t i = 1; i < 2 * n; i++)
    limit_slope (pens, point[(i - 1) % n].step, (i - 1) % n, i % n, pen);
  for (size_t i = 2 * n; i-- > 1;)
    limit_slope (pens, point[(i - 1) % n].step, i % n, (i - 1) % n, pen);
}
