/* Strokes whose opacity or width shows which end is nearer.
 *
 * The stroke is followed from one end to the other.  It must be a single line: pixels beside the path between the ends
 * belong to another stroke that touches this one.  The difference between the first and the last third decides.  Values
 * along the path must then fall about steadily from the strong end to the weak one, because two strokes that touch at
 * their ends look like one.  For the same reason a stroke must have one colour and no sharp corner, and no corner at
 * all where it gets stronger again.  The width of a stroke along the edge of the picture is unknown.
 *
 * Cost: a few passes over the pixels of the stroke.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/arrows.h"

#include <math.h>

/* All chosen. */
#define SHORTEST_PROFILE 6     /* pixels */
#define MOST_PIECES      12    /* into which the path is divided */
#define LEAST_SIGNAL     0.2   /* least difference of the outer thirds, as a fraction of the larger value */
#define SLACK            0.1   /* the middle third may leave their range by this fraction: ends are round and soft */
#define MOST_RISE        0.25  /* of a later piece above an earlier one, as a fraction of the range of values, ... */
#define LAST_RISE        0.12  /* ... and of the last two pieces above the weakest one, ... */
#define NOISE            0.05  /* ... each with this fraction of the largest value added */
#define FINE_PIECES      48    /* at most, as long as the stroke is wide, ... */
#define BUMP             2     /* ... of which so many to either side may be of a crossing, ... */
#define FINE_RISE        0.4   /* ... and the others may rise by this fraction of the range */
#define CORNER_RISE      0.3   /* fraction of the allowed rise that is too much at a corner */
#define CORNER           0.8   /* largest cosine of the turn at a corner */
#define SHARP_CORNER     0.6   /* and at one that is not drawn in a single stroke */
#define COLOUR_OPACITY   64    /* of 255, least opacity of pieces whose colour is compared */
#define OTHER_COLOUR     60    /* of 255, between colours of one stroke, at most; ... */
#define OTHER_COSINE     0.978 /* ... on opaque paper between their differences from the paper, at least */

/* Mean opacity of a stroke between two distances, weighted by opacity, so that soft edges count little. */
static double
strength (const CeldArrowStroke *stroke, const CeldArrowLayer *layer, double from, double to)
{
  double sum = 0, weights = 0;

  for (size_t i = 0; i < stroke->n; i++)
    {
      uint32_t p = stroke->pixel[i];
      double   a;

      if (stroke->distance[p] < from || stroke->distance[p] > to)
        continue;
      a = celd_arrow_opacity (layer, celd_stroke_x (stroke, p), celd_stroke_y (stroke, p));
      sum     += a * a;
      weights += a;
    }
  return weights > 0 ? sum / weights : 0;
}

/* Opacity or width of n pieces of the path, equally long, without a margin at the ends, which are round. */
static void
measure (const CeldArrowStroke *stroke, const CeldArrowLayer *layer, CeldArrowStyle style, double margin, int n,
         double *value)
{
  double piece = (celd_stroke_length (stroke) - 2 * margin) / n;

  for (int i = 0; i < n; i++)
    {
      double from = margin + i * piece, to = from + piece;

      value[i] = style == CELD_ARROW_FADE ? strength (stroke, layer, from, to)
                                          : celd_stroke_mean_width (stroke, from, to);
    }
}

void
celd_paint_colour_add (CeldPaintColour *sum, const CeldArrowLayer *layer, int x, int y)
{
  const uint8_t *p = CELD_RGBA (layer->paint, x, y);
  double         a = celd_arrow_opacity (layer, x, y);

  sum->red     += a * (p[0] - layer->paper[0]);
  sum->green   += a * (p[1] - layer->paper[1]);
  sum->blue    += a * (p[2] - layer->paper[2]);
  sum->opacity += a * a;
  sum->weights += a;
}

static CeldPaintColour
mean_colour (CeldPaintColour sum)
{
  double n = sum.weights > 0 ? sum.weights : 1;

  return (CeldPaintColour) { sum.red / n, sum.green / n, sum.blue / n, sum.opacity / n, 1 };
}

bool
celd_paint_colour_known (CeldPaintColour sum)
{
  return mean_colour (sum).opacity >= COLOUR_OPACITY;
}

bool
celd_same_paint (const CeldArrowLayer *layer, CeldPaintColour one, CeldPaintColour other)
{
  CeldPaintColour a = mean_colour (one), b = mean_colour (other);
  double          dot = a.red * b.red + a.green * b.green + a.blue * b.blue;
  double          length = sqrt ((a.red * a.red + a.green * a.green + a.blue * a.blue) *
                                 (b.red * b.red + b.green * b.green + b.blue * b.blue));

  if (layer->opaque)
    return dot >= OTHER_COSINE * length;
  return hypot (hypot (a.red - b.red, a.green - b.green), a.blue - b.blue) <= OTHER_COLOUR;
}

/* The colour of a stroke between two distances. */
static CeldPaintColour
colour_between (const CeldArrowStroke *stroke, const CeldArrowLayer *layer, double from, double to)
{
  CeldPaintColour sum = { 0 };

  for (size_t i = 0; i < stroke->n; i++)
    if (stroke->distance[stroke->pixel[i]] >= from && stroke->distance[stroke->pixel[i]] <= to)
      celd_paint_colour_add (&sum, layer, celd_stroke_x (stroke, stroke->pixel[i]),
                             celd_stroke_y (stroke, stroke->pixel[i]));
  return sum;
}

/* A single piece of another colour may be where another stroke crosses. */
bool
celd_stroke_changes_colour (const CeldArrowStroke *stroke, const CeldArrowLayer *layer)
{
  double          piece = celd_stroke_length (stroke) / MOST_PIECES;
  CeldPaintColour colour[MOST_PIECES];
  int             n = 0;

  for (int i = 0; i < MOST_PIECES; i++)
    {
      colour[n] = colour_between (stroke, layer, i * piece, (i + 1) * piece);
      n += celd_paint_colour_known (colour[n]);
    }
  return n >= 4 && !celd_same_paint (layer, colour[0], colour[n - 1]) && !celd_same_paint (layer, colour[0], colour[n - 2]) &&
         !celd_same_paint (layer, colour[1], colour[n - 1]) && !celd_same_paint (layer, colour[1], colour[n - 2]);
}

/* Does more of a stroke than its ends lie on the edge of the picture? */
static bool
runs_along_frame (const CeldArrowStroke *stroke, double widest)
{
  size_t n = 0;

  for (size_t i = 0; i < stroke->n; i++)
    {
      int x = celd_stroke_x (stroke, stroke->pixel[i]), y = celd_stroke_y (stroke, stroke->pixel[i]);

      n += x == 0 || y == 0 || x == stroke->width - 1 || y == stroke->height - 1;
    }
  return (double) n > 2 * widest + 4;
}

/* The cosine of the angle by which the path turns at a distance, measured over two stroke widths on either side; 1 near
 * the ends. */
static double
turn_cosine (const CeldArrowStroke *stroke, double distance, double widest)
{
  double    far = fmax (8, 2 * widest), near = far / 2;
  CeldPoint a = celd_stroke_centroid (stroke, distance - far, distance - near);
  CeldPoint b = celd_stroke_centroid (stroke, distance - 1, distance + 1);
  CeldPoint c = celd_stroke_centroid (stroke, distance + near, distance + far);
  double    length = hypot (b.x - a.x, b.y - a.y) * hypot (c.x - b.x, c.y - b.y);

  if (distance < far || distance + far > celd_stroke_length (stroke))
    return 1;
  return length > 0 ? ((b.x - a.x) * (c.x - b.x) + (b.y - a.y) * (c.y - b.y)) / length : 1;
}

/* The largest rise of a value above an earlier one, or with `back` above a later one; *from is the index of the lower
 * value. */
static double
largest_rise (const double *value, int n, bool back, int *from)
{
  double rise = 0;
  int    least = back ? n - 1 : 0;

  *from = least;
  for (int i = 0; i < n; i++)
    {
      int k = back ? n - 1 - i : i;

      least = value[k] < value[least] ? k : least;
      if (value[k] - value[least] > rise)
        {
          rise  = value[k] - value[least];
          *from = least;
        }
    }
  return rise;
}

/* Do the values fall about steadily?  Less rise is allowed at corners, where one stroke may end at another. */
static bool
falls (const CeldArrowStroke *stroke, const double *value, int n, bool back, double margin, double widest)
{
  double most = value[0], least = value[0], piece = (celd_stroke_length (stroke) - 2 * margin) / n, rise, allowed;
  int    from;

  for (int i = 1; i < n; i++)
    {
      most  = fmax (most, value[i]);
      least = fmin (least, value[i]);
    }
  if (fmin (value[back ? 0 : n - 1], value[back ? 1 : n - 2]) - least > LAST_RISE * (most - least) + NOISE * most)
    return false;
  allowed = MOST_RISE * (most - least) + NOISE * most;
  rise    = largest_rise (value, n, back, &from);
  for (int side = -1; side <= 1 && rise > CORNER_RISE * allowed; side++)
    if (turn_cosine (stroke, margin + (from + 0.5 + 0.5 * side) * piece, widest) < CORNER)
      return false;
  return rise <= allowed;
}

/* The least, or largest, of each value and those up to BUMP before and behind it. */
static void
filter (const double *value, int n, double sign, double *filtered)
{
  for (int i = 0; i < n; i++)
    {
      filtered[i] = value[i];
      for (int k = i > BUMP ? i - BUMP : 0; k <= i + BUMP && k < n; k++)
        filtered[i] = sign * fmax (sign * filtered[i], sign * value[k]);
    }
}

/* Do short pieces fall, too, but for bumps where other strokes cross?  A short arrow may lead to a long one. */
static bool
falls_closely (const CeldArrowStroke *stroke, const CeldArrowLayer *layer, CeldArrowStyle style, bool back,
               double margin, double widest)
{
  double value[FINE_PIECES], low[FINE_PIECES], most = 0, least = INFINITY;
  int    n = (int) fmin (FINE_PIECES, (celd_stroke_length (stroke) - 2 * margin) / fmax (3, widest)), from;

  if (n < MOST_PIECES)
    return true;
  measure (stroke, layer, style, margin, n, value);
  filter (value, n, -1, low);
  filter (low, n, 1, value);
  for (int i = 0; i < n; i++)
    {
      most  = fmax (most, value[i]);
      least = fmin (least, value[i]);
    }
  return largest_rise (value, n, back, &from) <= FINE_RISE * (most - least) + NOISE * most;
}

static bool
has_sharp_corner (const CeldArrowStroke *stroke, double widest)
{
  for (double d = 0; d < celd_stroke_length (stroke); d += 2)
    if (turn_cosine (stroke, d, widest) < SHARP_CORNER)
      return true;
  return false;
}

/* Is all paint but a fiftieth on the path between the two ends?  On return the stroke is followed from `start`. */
static bool
is_single (CeldArrowStroke *stroke, uint32_t start, uint32_t last, double widest)
{
  double length = celd_stroke_length (stroke);
  size_t off = 0;

  for (size_t i = 0; i < stroke->n; i++)
    stroke->earlier[i] = stroke->distance[stroke->pixel[i]];
  celd_stroke_follow (stroke, &last, 1);
  for (size_t i = 0; i < stroke->n; i++)
    off += stroke->earlier[i] + stroke->distance[stroke->pixel[i]] > length + 2 * widest + 4;
  celd_stroke_follow (stroke, &start, 1);
  for (size_t i = 0; i < stroke->n; i++)
    {
      double    d = stroke->distance[stroke->pixel[i]];
      CeldPoint p = celd_stroke_point (stroke, stroke->pixel[i]), c = celd_stroke_centroid (stroke, d - 1, d + 1);

      off += hypot (p.x - c.x, p.y - c.y) > 0.8 * widest + 2;
    }
  return 50 * off < stroke->n;
}

CeldArrowReason
celd_arrow_profile (CeldArrowStroke *stroke, const CeldArrowLayer *layer, CeldArrowStyle style, CeldArrowEnds *ends)
{
  uint32_t  start = celd_stroke_follow (stroke, stroke->pixel, 1), last = celd_stroke_follow (stroke, &start, 1);
  double    length = celd_stroke_length (stroke), value[MOST_PIECES], widths[MOST_PIECES] = { 0 }, third[3];
  double    most, least, w, margin;
  int       n = (int) fmax (4, fmin (MOST_PIECES, length / 4));
  CeldPoint first, end;

  if (length < SHORTEST_PROFILE)
    return CELD_REASON_SHORT;
  measure (stroke, layer, CELD_ARROW_TAPER, 0, n, widths);
  for (int i = 0; i < n; i++)
    widths[0] = fmax (widths[0], widths[i]);
  if (length < 1.5 * widths[0])
    return CELD_REASON_SHORT;
  if (!is_single (stroke, start, last, widths[0]))
    return CELD_REASON_MEETING;
  if (celd_stroke_changes_colour (stroke, layer) || has_sharp_corner (stroke, widths[0]))
    return CELD_REASON_UNEVEN;
  if (style == CELD_ARROW_TAPER && runs_along_frame (stroke, widths[0]))
    return CELD_REASON_FRAME;
  margin = fmin (0.3 * widths[0], length / 8);
  measure (stroke, layer, style, 0, 3, third);
  measure (stroke, layer, style, margin, n, value);
  most  = fmax (third[0], third[2]);
  least = fmin (third[0], third[2]);
  if (most - least < LEAST_SIGNAL * most)
    return CELD_REASON_ALIKE;
  if (third[1] < least - SLACK * most || third[1] > most + SLACK * most ||
      !falls (stroke, value, n, third[0] < third[2], margin, widths[0]) ||
      !falls_closely (stroke, layer, style, third[0] < third[2], margin, widths[0]))
    return CELD_REASON_UNEVEN;
  w     = fmax (1, fmin (celd_stroke_mean_width (stroke, 0, length), length / 3));
  first = celd_stroke_centroid (stroke, 0, w);
  end   = celd_stroke_centroid (stroke, length - w, length);
  *ends = third[0] > third[2] ? (CeldArrowEnds) { first, end } : (CeldArrowEnds) { end, first };
  return CELD_REASON_NONE;
}
