/* How an outline runs on where something nearer hides it.
 *
 * Two edges that vanish behind a shape look like one when a smooth curve without an inflection joins them
 * (P. J. Kellman and T. F. Shipley, A theory of visual interpolation in object perception, Cognitive Psychology
 * 23, 1991).  Each gap
 * is closed by a cubic from where the outline goes in to where it comes out, with its directions there; its handles are
 * those of a circle's arc, 2/3 d / (1 + cos), so that equal turns give an arc and no curve runs far beyond its ends.
 * Ends that no such curve joins are joined by a straight line.  Where the curve would come out from behind what hides
 * it, its handles are drawn in until it does not.  A direction that was hard to measure is the mirror image of the
 * other end's, as on an arc.
 *
 * The two sides of a limb that passes behind something come out again elsewhere: two gaps change partners where the
 * outlines run on straighter that way, and nothing that is seen contradicts it.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "layers/layers.h"

#include <math.h>

#define PI 3.14159265358979323846
#define MAX_END_TURN   (2 * PI / 3)  /* turn at one end; beyond, the directions are not believed */
#define MAX_INFLECTION (PI / 6)      /* to both sides: an inflection that is taken for an error of measurement */
#define MAX_EXCHANGE_TURN   (PI / 4)      /* at either end of a curve between two gaps */
#define MAX_EXCHANGE_LENGTH   5             /* such a curve's length in lengths of the longer gap */
#define SAMPLES    64
#define TENSIONS   8

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
  return 2 + (int) (1.5 * length); /* the middle of a cubic is at most 3/2 as fast as its polygon */
}

/* ------------------------------------------------------------------ from one end to another */

/* From the first direction to the second, in (-PI,PI]. */
static double
turn (double ax, double ay, double bx, double by)
{
  return atan2 (ax * by - ay * bx, ax * bx + ay * by);
}

/* Turns from the direction at the one end to the chord, and from there to that at the other; false without a chord. */
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

/* With handles of `tension` times the usual length. */
static CeldGapCurve
join_ends (const CeldGapEnd *in, const CeldGapEnd *out, double tension)
{
  double    dx = out->x - in->x, dy = out->y - in->y, d = hypot (dx, dy), first = 0, second = 0, mean, handle;
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

/* ------------------------------------------------------------------ partners */

/* Does the curve lie where the layer is seen, or may be?  Its ends may stick out by the roundings of antialiasing. */
static bool
is_possible (const CeldLayers *layers, size_t layer, const CeldGapCurve *curve)
{
  int outside = 0;

  for (int i = 1; i < SAMPLES; i++)
    {
      double x, y;

      celd_curve_at (curve, (double) i / SAMPLES, &x, &y);
      outside += celd_layer_visibility (layers, layer, (int) floor (x), (int) floor (y)) == CELD_LAYER_ABSENT;
    }
  return outside <= SAMPLES / 16;
}

static double
chord (const CeldOutlineGap *gap)
{
  return hypot (gap->out.x - gap->in.x, gap->out.y - gap->in.y);
}

/* What it costs to join the ends, by the turns; infinite if another gap's end is out of the question. */
static double
turning_cost (const CeldGapEnd *in, const CeldGapEnd *out, double longest)
{
  double first, second, length = hypot (out->x - in->x, out->y - in->y);

  if (!measure_turns (in, out, &first, &second))
    return INFINITY;
  if (longest >= 0 && (length > MAX_EXCHANGE_LENGTH * longest || fabs (first) > MAX_EXCHANGE_TURN || fabs (second) > MAX_EXCHANGE_TURN))
    return INFINITY;
  return first * first + second * second;
}

/* Exchanges the partners of two gaps if both run on straighter. */
static bool
exchange_ends (const CeldLayers *layers, size_t layer, CeldOutlineGap *one, CeldOutlineGap *other)
{
  double    longest = fmax (chord (one), chord (other));
  double    now = turning_cost (&one->in, &one->out, -1) + turning_cost (&other->in, &other->out, -1);
  double    then = turning_cost (&one->in, &other->out, longest) + turning_cost (&other->in, &one->out, longest);
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
  /* An exchange halves the cost of two gaps at least, so that a gap changes a few times at most. */
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
