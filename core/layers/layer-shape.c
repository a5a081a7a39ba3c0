/* The shape of a layer: where it is visible, absent or occluded, the curves that complete its outline where a nearer
 * layer occludes it, and the coverage of pixels by what the closed outline encloses.
 *
 * Two edges that disappear behind a shape are seen as one if a smooth curve without an inflection can join them (P. J.
 * Kellman and T. F. Shipley, A theory of visual interpolation in object perception, Cognitive Psychology 23, 1991).
 * Each gap is closed by a cubic Bezier curve from the point where the outline disappears to the point where it
 * reappears, with the directions measured there.  Its handles have the length of those of a circular arc, 2/3 d / (1 +
 * cos), so that equal turns give an arc and no curve extends far beyond its ends.  Ends that no such curve can join are
 * joined by a straight line.  Where a curve would leave the occluding layer, its handles are shortened until it does
 * not.  An unreliable direction is replaced by the mirror image of the other end's, as on an arc.
 *
 * The two sides of a limb that passes behind something reappear on its other side: two gaps exchange their ends if both
 * outlines become straighter, and the new curves stay occluded.
 *
 * Coverage is the exact area to the right of directed edges, accumulated along rows.  An edge that goes up by h through
 * a pixel adds h to everything beyond it in the row, and one that goes down subtracts h, so that the sum along a row is
 * the winding number.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "layers/layers.h"

#include <math.h>

#define MAX_END_TURN        (2 * CELD_PI / 3) /* largest turn at one end; larger ones count as errors of measurement;
                                               * chosen */
#define MAX_INFLECTION      (CELD_PI / 6)     /* largest turns to both sides that count as errors of measurement, not
                                               * as an inflection; chosen */
#define MAX_EXCHANGE_TURN   (CELD_PI / 4)     /* largest turn at the ends of a curve between two gaps; chosen */
#define MAX_EXCHANGE_LENGTH 5                 /* largest length of such a curve, in lengths of the longer gap; chosen */
#define CURVE_SAMPLES       64                /* places where a curve is tested; chosen */
#define TENSIONS            8                 /* lengths of handles that are tried; chosen */

/* ------------------------------------------------------------------ visibility */

CeldVisibility
celd_layer_visibility (const CeldLayers *layers, size_t layer, int x, int y)
{
  size_t           p = (size_t) y * (size_t) layers->width + (size_t) x, place;
  const CeldBlend *blend;

  if (x < 0 || y < 0 || x >= layers->width || y >= layers->height)
    return CELD_LAYER_ABSENT;
  place = layers->place[p];
  if (place == layer)
    return CELD_LAYER_VISIBLE;
  if (place < layers->n)
    return layers->item[place].level > layers->item[layer].level && layers->art[4 * p + 3] >= 1 ? CELD_LAYER_OCCLUDED
                                                                                                 : CELD_LAYER_ABSENT;
  blend = &layers->blend[place - layers->n];
  if (blend->layer[1] == layer || (blend->layer[0] == layer && blend->coverage >= 0.5f))
    return CELD_LAYER_VISIBLE;
  return layers->item[blend->layer[1]].level > layers->item[layer].level && blend->colour[1][3] >= 1
           ? CELD_LAYER_OCCLUDED : CELD_LAYER_ABSENT;
}

/* ------------------------------------------------------------------ one curve */

void
celd_curve_at (const CeldGapCurve *curve, double t, double *x, double *y)
{
  double s = 1 - t, b[4] = { s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t };

  *x = *y = 0;
  for (int i = 0; i < 4; i++)
    {
      *x += b[i] * curve->x[i];
      *y += b[i] * curve->y[i];
    }
}

int
celd_curve_steps (const CeldGapCurve *curve)
{
  double length = 0;

  for (int i = 1; i < 4; i++)
    length += hypot (curve->x[i] - curve->x[i - 1], curve->y[i] - curve->y[i - 1]);
  return 2 + (int) (1.5 * length); /* a cubic is at most 3/2 as fast as its control polygon is long */
}

/* Angle from the first direction to the second, in (-pi,pi]. */
static double
turn (double ax, double ay, double bx, double by)
{
  return atan2 (ax * by - ay * bx, ax * bx + ay * by);
}

/* Measures the turns from the direction at the first end to the chord, and from there to the direction at the second
 * end; false if there is no chord. */
static bool
measure_turns (const CeldGapEnd *in, const CeldGapEnd *out, double *first, double *second)
{
  double dx = out->x - in->x, dy = out->y - in->y;

  *first  = turn (in->tx, in->ty, dx, dy);
  *second = turn (dx, dy, out->tx, out->ty);
  return dx != 0 || dy != 0;
}

static bool
are_relatable (double first, double second)
{
  if (fabs (first) > MAX_END_TURN || fabs (second) > MAX_END_TURN)
    return false;
  return first * second >= 0 || (fabs (first) < MAX_INFLECTION && fabs (second) < MAX_INFLECTION);
}

/* Mirrors an end's direction at the perpendicular bisector of the chord (dx,dy) of length d. */
static void
mirror (const CeldGapEnd *end, double dx, double dy, double d, CeldGapEnd *other)
{
  double along = (end->tx * dx + end->ty * dy) / d, across = (dx * end->ty - dy * end->tx) / d;

  other->tx = (along * dx + across * dy) / d;
  other->ty = (along * dy - across * dx) / d;
}

/* The curve between two ends, with handles of `tension` times the usual length. */
static CeldGapCurve
join_ends (const CeldGapEnd *in, const CeldGapEnd *out, double tension)
{
  double       dx = out->x - in->x, dy = out->y - in->y, d = hypot (dx, dy), first = 0, second = 0, mean, handle;
  CeldGapEnd   a = *in, b = *out;
  CeldGapCurve curve = { .width = { in->width, out->width } };

  if (d > 0 && in->reliable != out->reliable)
    mirror (in->reliable ? in : out, dx, dy, d, in->reliable ? &b : &a);
  if (measure_turns (&a, &b, &first, &second) && !are_relatable (first, second))
    {
      a.tx = b.tx = dx / d;
      a.ty = b.ty = dy / d;
      first = second = 0;
    }
  mean   = (fabs (first) + fabs (second)) / 2;
  handle = tension * d * 2 / 3 / (1 + fmax (cos (mean), 0));
  for (int i = 0; i < 2; i++)
    memcpy (curve.colour[i], i ? out->colour : in->colour, sizeof curve.colour[i]);
  curve.x[0] = a.x;
  curve.y[0] = a.y;
  curve.x[1] = a.x + handle * a.tx;
  curve.y[1] = a.y + handle * a.ty;
  curve.x[2] = b.x - handle * b.tx;
  curve.y[2] = b.y - handle * b.ty;
  curve.x[3] = b.x;
  curve.y[3] = b.y;
  return curve;
}

/* ------------------------------------------------------------------ choice of ends */

/* Does the curve lie where the layer is visible or occluded?  Small deviations are allowed near the ends, because of
 * antialiasing. */
static bool
is_possible (const CeldLayers *layers, size_t layer, const CeldGapCurve *curve)
{
  int outside = 0;

  for (int i = 1; i < CURVE_SAMPLES; i++)
    {
      double x, y;

      celd_curve_at (curve, (double) i / CURVE_SAMPLES, &x, &y);
      outside += celd_layer_visibility (layers, layer, (int) floor (x), (int) floor (y)) == CELD_LAYER_ABSENT;
    }
  return outside <= CURVE_SAMPLES / 16;
}

static double
chord (const CeldOutlineGap *gap)
{
  return hypot (gap->out.x - gap->in.x, gap->out.y - gap->in.y);
}

/* The cost of joining two ends: the sum of the squared turns.  For ends of different gaps, which have longest >= 0,
 * INFINITY if a limit is exceeded. */
static double
turning_cost (const CeldGapEnd *in, const CeldGapEnd *out, double longest)
{
  double first, second, length = hypot (out->x - in->x, out->y - in->y);

  if (!measure_turns (in, out, &first, &second))
    return INFINITY;
  if (longest >= 0 && (length > MAX_EXCHANGE_LENGTH * longest || fabs (first) > MAX_EXCHANGE_TURN ||
                       fabs (second) > MAX_EXCHANGE_TURN))
    return INFINITY;
  return first * first + second * second;
}

/* Exchanges the ends of two gaps if that at least halves their cost. */
static bool
exchange_ends (const CeldLayers *layers, size_t layer, CeldOutlineGap *one, CeldOutlineGap *other)
{
  double       longest = fmax (chord (one), chord (other));
  double       now = turning_cost (&one->in, &one->out, -1) + turning_cost (&other->in, &other->out, -1);
  double       then = turning_cost (&one->in, &other->out, longest) + turning_cost (&other->in, &one->out, longest);
  CeldGapCurve curve[2];
  CeldGapEnd   out;

  if (!(then < now / 2))
    return false;
  curve[0] = join_ends (&one->in, &other->out, 1);
  curve[1] = join_ends (&other->in, &one->out, 1);
  if (!is_possible (layers, layer, &curve[0]) || !is_possible (layers, layer, &curve[1]))
    return false;
  out        = one->out;
  one->out   = other->out;
  other->out = out;
  return true;
}

void
celd_layer_curves (const CeldLayers *layers, size_t layer, const CeldOutline *outline, CeldGapCurve *curve)
{
  /* Each exchange at least halves the cost of two gaps, so that a gap changes only a few times. */
  for (size_t i = 0; i < outline->n_gaps; i++)
    for (size_t k = i + 1; k < outline->n_gaps; k++)
      exchange_ends (layers, layer, &outline->gap[i], &outline->gap[k]);
  for (size_t i = 0; i < outline->n_gaps; i++)
    for (int tension = TENSIONS; tension >= 0; tension--)
      {
        curve[i] = join_ends (&outline->gap[i].in, &outline->gap[i].out, (double) tension / TENSIONS);
        if (is_possible (layers, layer, &curve[i]))
          break;
      }
}

/* ------------------------------------------------------------------ coverage */

CeldStatus
celd_coverage_new (CeldRect box, CeldCoverage *coverage)
{
  /* rows have one more number, for what lies beyond their end */
  *coverage = (CeldCoverage) { box, celd_alloc0 ((size_t) (box.width + 1) * (size_t) box.height,
                                                 sizeof *coverage->sum) };
  return coverage->sum ? CELD_OK : CELD_NO_MEMORY;
}

/* Adds a piece of height h within one row and one column, whose middle is at x. */
static void
add_piece (CeldCoverage *coverage, int row, double x, double h)
{
  float *sum    = coverage->sum + (size_t) row * (size_t) (coverage->box.width + 1);
  int    column = (int) floor (x);

  if (column < 0)
    sum[0] -= (float) h;
  else if (column < coverage->box.width)
    {
      double left = x - column;

      sum[column]     -= (float) (h * (1 - left));
      sum[column + 1] -= (float) (h * left);
    }
}

/* Adds a piece within one row, cut at the boundaries of columns. */
static void
add_row (CeldCoverage *coverage, int row, double x, double y, double to_x, double to_y)
{
  while (y != to_y)
    {
      double next_column = to_x > x ? floor (x) + 1 : ceil (x) - 1, next_y = to_y, next_x = to_x;

      if (to_x > x ? next_column < to_x : to_x < x && next_column > to_x)
        {
          next_x = next_column;
          next_y = y + (to_y - y) * (next_column - x) / (to_x - x);
        }
      add_piece (coverage, row, (x + next_x) / 2, next_y - y);
      x = next_x;
      y = next_y;
    }
}

void
celd_coverage_edge (CeldCoverage *coverage, double x, double y, double to_x, double to_y)
{
  double slope = to_y != y ? (to_x - x) / (to_y - y) : 0;
  double first = fmin (y, to_y) - coverage->box.y, last = fmax (y, to_y) - coverage->box.y;

  for (int row = (int) fmax (floor (first), 0); row < coverage->box.height && row < last; row++)
    {
      double top = fmax (first, row), bottom = fmin (last, row + 1);
      double a = y < to_y ? top : bottom, b = y < to_y ? bottom : top; /* in the edge's direction */

      add_row (coverage, row, x + slope * (a + coverage->box.y - y) - coverage->box.x, a,
               x + slope * (b + coverage->box.y - y) - coverage->box.x, b);
    }
}

void
celd_coverage_finish (CeldCoverage *coverage)
{
  const float *from = coverage->sum;
  float       *to = coverage->sum;

  for (int y = 0; y < coverage->box.height; y++, from++)
    {
      double winding = 0;

      for (int x = 0; x < coverage->box.width; x++)
        {
          winding += (double) *from++;
          *to++ = (float) fmin (fmax (winding, 0), 1);
        }
    }
}

static void
cover_outline (const CeldOutline *outline, CeldCoverage *sum)
{
  for (size_t l = 0; l < outline->n_loops; l++)
    for (size_t i = outline->loop[l]; i < outline->loop[l + 1]; i++)
      if (!outline->crack[i].hidden)
        {
          const CeldCrackEdge *from = &outline->crack[i];
          const CeldCrackEdge *to = &outline->crack[i + 1 < outline->loop[l + 1] ? i + 1 : outline->loop[l]];

          celd_coverage_edge (sum, from->x, from->y, to->x, to->y);
        }
}

static void
cover_curve (const CeldGapCurve *curve, CeldCoverage *sum)
{
  int    steps = celd_curve_steps (curve);
  double x = curve->x[0], y = curve->y[0], to_x, to_y;

  for (int k = 1; k <= steps; k++, x = to_x, y = to_y)
    {
      celd_curve_at (curve, (double) k / steps, &to_x, &to_y);
      celd_coverage_edge (sum, x, y, to_x, to_y);
    }
}

CeldStatus
celd_coverage_of_outline (CeldRect box, const CeldOutline *outline, const CeldGapCurve *curve, float **coverage)
{
  CeldCoverage sum;
  CeldStatus   status = celd_coverage_new (box, &sum);

  if (status != CELD_OK)
    return status;
  cover_outline (outline, &sum);
  for (size_t i = 0; i < outline->n_gaps; i++)
    cover_curve (&curve[i], &sum);
  celd_coverage_finish (&sum);
  *coverage = sum.sum;
  return CELD_OK;
}
