/* Painted arrows: which end of a stroke is nearer.
 *
 * Each connected stroke is followed from its extremities (trail.c); every style asks the same question of each of them:
 * is this the tail of an arrow?  One answer makes a relation.  None, or answers that differ, make a problem: nothing is
 * guessed.  Geometry decides, colour only marks blue strokes (crack).
 *
 *   head   the stroke keeps the width w of its shaft up to a part that reaches out on both sides, falls back from the
 *          tip and narrows towards it: an open or a filled arrowhead
 *   dot    the same, but the part is round: it does not narrow; its centre is the nearer end
 *   fade   the mean opacity of the first third differs from that of the last one
 *   taper  the same of the mean width, with the middle third between
 *
 * Costs a few sweeps over the pixels of each stroke.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "trail.h"

#include <math.h>
#include <stdlib.h>

#define LEAST_STROKE  6    /* pixels; fewer are a speck */
#define LEAST_SIGNAL  0.2  /* fade and taper: least difference, as a share of the larger value */
#define LEAST_OPACITY 128  /* of paint; a fading stroke reaches on to FADED_OPACITY */
#define FADED_OPACITY 16
#define CONTRAST      32   /* least difference from the paper's colour, in a layer without alpha */
#define LEAST_COSINE  0.7  /* of the angle between the shaft's end and the head's axis */
#define EXTREMITIES   4    /* tail, tip and two barbs */

/* The two ends of an arrow. */
typedef struct { CeldPoint nearer, farther; } Ends;

/* Part of a stroke seen along an axis: s forwards, v sideways, from an origin. */
typedef struct { CeldPoint origin, axis; double from; } View; /* pixels at this distance and beyond */
typedef struct { double least_s, most_s, left, right, left_s, right_s; size_t n; } Extent;

static CeldPoint
direction (CeldPoint from, CeldPoint to)
{
  double length = hypot (to.x - from.x, to.y - from.y);

  return length > 0 ? (CeldPoint) { (to.x - from.x) / length, (to.y - from.y) / length } : (CeldPoint) { 0, 0 };
}

static double
forwards (const View *view, CeldPoint p)
{
  return (p.x - view->origin.x) * view->axis.x + (p.y - view->origin.y) * view->axis.y;
}

static double
sideways (const View *view, CeldPoint p)
{
  return (p.y - view->origin.y) * view->axis.x - (p.x - view->origin.x) * view->axis.y;
}

/* How far the view reaches between two values of s.  `right` is negative sideways. */
static Extent
extent_between (const CeldTrail *trail, const View *view, double from, double to)
{
  Extent e = { .least_s = INFINITY, .most_s = -INFINITY, .left = -INFINITY, .right = INFINITY };

  for (size_t i = 0; i < trail->n; i++)
    {
      CeldPoint p = celd_trail_point (trail, trail->pixel[i]);
      double    s = forwards (view, p), v = sideways (view, p);

      if (trail->distance[trail->pixel[i]] < view->from || s < from || s > to)
        continue;
      e.n++;
      e.least_s = fmin (e.least_s, s);
      e.most_s  = fmax (e.most_s, s);
      if (v > e.left)
        {
          e.left   = v;
          e.left_s = s;
        }
      if (v < e.right)
        {
          e.right   = v;
          e.right_s = s;
        }
    }
  return e;
}

static double
breadth_at (const CeldTrail *trail, const View *view, double s)
{
  Extent e = extent_between (trail, view, s - 0.75, s + 0.75);

  return e.n ? e.left - e.right + 1 : 0;
}

/* The middle of the foremost pixels. */
static CeldPoint
foremost (const CeldTrail *trail, const View *view, double most_s)
{
  CeldPoint sum = { 0, 0 };
  double    n   = 0;

  for (size_t i = 0; i < trail->n; i++)
    {
      CeldPoint p = celd_trail_point (trail, trail->pixel[i]);

      if (trail->distance[trail->pixel[i]] < view->from || forwards (view, p) < most_s - 0.5)
        continue;
      sum.x += p.x;
      sum.y += p.y;
      n++;
    }
  return (CeldPoint) { sum.x / n, sum.y / n };
}

/* The distance at which the stroke gets wider than its shaft and stays so; its length if it does not. */
static double
shaft_end (const CeldTrail *trail, double w)
{
  double length = celd_trail_length (trail), run = fmax (w, 4), wide = 1.3 * w + 0.8, d = w;

  while (d + run < length && (celd_trail_width (trail, d, d + run) < wide ||
                              celd_trail_width (trail, d, d + 0.5 * run) < wide))
    d += 0.5;
  return d + run < length ? d : length;
}

/* Does the part beyond the shaft reach out on both sides? */
static bool
reaches_out (const Extent *e, double w)
{
  double least = 0.5 * w + fmax (0.25 * w, 0.75), left = e->left, right = -e->right;

  return left > least && right > least && fmin (left, right) > 0.3 * fmax (left, right);
}

/* Does it fall back from its tip on both sides, and end there? */
static bool
falls_back (const Extent *e, double w)
{
  double left = e->most_s - e->left_s, right = e->most_s - e->right_s;

  return left > 0.25 * e->left && right > -0.25 * e->right && e->most_s - e->least_s < 0.8 * (left + right) + 1.5 * w;
}

/* The place s forwards and v sideways. */
static CeldPoint
place (const View *view, double s, double v)
{
  return (CeldPoint) { view->origin.x + s * view->axis.x - v * view->axis.y, view->origin.y + s * view->axis.y + v * view->axis.x };
}

static bool
is_painted (const CeldTrail *trail, CeldPoint p)
{
  const float *d = &trail->distance[(size_t) (p.y + 1) * trail->row + (size_t) (p.x + 1)];

  return isfinite (*d) || isfinite (d[-1]) || isfinite (d[1]) || isfinite (d[-(ptrdiff_t) trail->row]) || isfinite (d[trail->row]);
}

/* Is the straight way painted, all but a fifth of it? */
static bool
is_line (const CeldTrail *trail, CeldPoint from, CeldPoint to)
{
  int n = (int) hypot (to.x - from.x, to.y - from.y) + 1, painted = 0;

  for (int i = 0; i <= n; i++)
    painted += is_painted (trail, (CeldPoint) { from.x + (to.x - from.x) * i / n, from.y + (to.y - from.y) * i / n });
  return 5 * painted >= 4 * (n + 1);
}

/* Do the two lines of a head lead from its tip to its barbs, is it narrow near the tip and wider and wider behind, and is
 * nothing outside of the triangle?  That holds for open and for filled heads. */
static bool
is_arrowhead (const CeldTrail *trail, const View *view, const Extent *e, double w)
{
  double    breadth = e->left - e->right + 1, depth = e->most_s - 0.5 * (e->left_s + e->right_s);
  double    tip = e->most_s - fmin (0.6 * w, 0.3 * depth), slope = 0.5 * breadth / depth;
  CeldPoint foremost = place (view, tip, 0);
  size_t    outside = 0;

  if (breadth_at (trail, view, e->most_s - 0.25 * depth) > 0.68 * breadth ||
      breadth_at (trail, view, e->most_s - 0.5 * depth) > 0.82 * breadth ||
      breadth_at (trail, view, e->most_s - 0.5 * depth) < 0.35 * breadth)
    return false;
  if (!is_line (trail, foremost, place (view, e->left_s, e->left - 0.4 * w)) ||
      !is_line (trail, foremost, place (view, e->right_s, e->right + 0.4 * w)))
    return false;
  for (size_t i = 0; i < trail->n; i++)
    {
      CeldPoint p = celd_trail_point (trail, trail->pixel[i]);

      outside += trail->distance[trail->pixel[i]] >= view->from &&
                 fabs (sideways (view, p)) > slope * (e->most_s - forwards (view, p)) + 0.7 * w + 1;
    }
  return 20 * outside < e->n;
}

/* Is it a filled disc? */
static bool
is_dot (const Extent *e)
{
  double breadth = e->left - e->right + 1, depth = e->most_s - e->least_s + 1;

  return depth > 0.6 * breadth && depth < 1.6 * breadth && (double) e->n > 0.65 * breadth * depth;
}

/* Turns the axis to run from between the barbs to the tip: the shaft may be bent. */
static void
turn_to_tip (const CeldTrail *trail, View *view, const Extent *e)
{
  double    s = 0.5 * (e->left_s + e->right_s), v = 0.5 * (e->left + e->right);
  CeldPoint a = view->axis, o = view->origin;

  view->origin = place (view, s, v);
  view->axis   = direction (view->origin, foremost (trail, &(View) { o, a, view->from }, e->most_s));
}

static uint32_t
nearest_pixel (const CeldTrail *trail, CeldPoint p)
{
  uint32_t nearest = trail->pixel[0];
  double   least   = INFINITY;

  for (size_t i = 0; i < trail->n; i++)
    {
      CeldPoint q = celd_trail_point (trail, trail->pixel[i]);
      double    d = hypot (p.x - q.x, p.y - q.y);

      if (d < least)
        {
          least   = d;
          nearest = trail->pixel[i];
        }
    }
  return nearest;
}

/* If the stroke followed from `tail` ends in a head (or a dot): its ends. */
static bool
read_from_tail (CeldTrail *trail, uint32_t tail, CeldArrowStyle style, Ends *ends)
{
  View      view;
  Extent    e;
  double    length, w, end, back;
  CeldPoint shaft, tip, last;

  celd_trail_follow (trail, &tail, 1);
  length = celd_trail_length (trail);
  w      = celd_trail_width (trail, 1, 0.5 * length);
  end    = shaft_end (trail, w);
  if (length < 6 || end >= length || end < 1.5 * w)
    return false;
  back = fmin (fmax (2 * w, 6), 0.6 * end);
  view = (View) { .origin = celd_trail_centre (trail, end - 0.25 * back, end), .from = end };
  view.axis = direction (celd_trail_centre (trail, end - back, end - 0.75 * back), view.origin);
  e    = extent_between (trail, &view, -INFINITY, INFINITY);
  if (fmin (e.left, -e.right) < 0.4 * w)
    return false;
  shaft = view.axis;
  turn_to_tip (trail, &view, &e);
  if (shaft.x * view.axis.x + shaft.y * view.axis.y < LEAST_COSINE)
    return false;
  e = extent_between (trail, &view, -INFINITY, INFINITY);
  if (!reaches_out (&e, w) || (style == CELD_ARROW_DOT ? !is_dot (&e) : !falls_back (&e, w) || !is_arrowhead (trail, &view, &e, w)))
    return false;
  tip   = foremost (trail, &view, e.most_s);
  *ends = (Ends) { celd_trail_centre (trail, 0, fmax (1, w)), style == CELD_ARROW_DOT ? view.origin : tip };

  /* What is farthest from the tip is the tail, or else it was some place in the middle of the shaft. */
  tail = nearest_pixel (trail, tip);
  last = celd_trail_point (trail, celd_trail_follow (trail, &tail, 1));
  return hypot (last.x - ends->nearer.x, last.y - ends->nearer.y) < w + 2;
}

/* Reads the stroke from every extremity; true if all that see an arrow agree. */
static bool
read_head (CeldTrail *trail, CeldArrowStyle style, Ends *ends)
{
  uint32_t extremity[EXTREMITIES];
  bool     found = false;

  extremity[0] = celd_trail_follow (trail, trail->pixel, 1);
  for (size_t i = 1; i < EXTREMITIES; i++)
    extremity[i] = celd_trail_follow (trail, extremity, i);
  for (size_t i = 0; i < EXTREMITIES; i++)
    {
      Ends one;

      if (!read_from_tail (trail, extremity[i], style, &one))
        continue;
      if (found && hypot (one.farther.x - ends->farther.x, one.farther.y - ends->farther.y) > 3)
        return false;
      found = true;
      *ends = one;
    }
  return found;
}

/* Opacity of a layer's pixels: its alpha, or the contrast to the commonest colour of a layer without. */
typedef struct
{
  const CeldPaint *paint;
  bool             opaque;
  uint8_t          paper[3];
} Layer;

static int
opacity (const Layer *layer, int x, int y)
{
  const uint8_t *c = CELD_RGBA (layer->paint, x, y);
  int            contrast = 0;

  if (!layer->opaque)
    return c[3];
  for (int i = 0; i < 3; i++)
    if (abs (c[i] - layer->paper[i]) > contrast)
      contrast = abs (c[i] - layer->paper[i]);
  return contrast;
}

/* Mean opacity of a stroke between two distances, strong pixels first: soft edges say little. */
static double
strength (const CeldTrail *trail, const Layer *layer, double from, double to)
{
  double sum = 0, weights = 0;

  for (size_t i = 0; i < trail->n; i++)
    {
      uint32_t p = trail->pixel[i];
      double   a;

      if (trail->distance[p] < from || trail->distance[p] > to)
        continue;
      a = opacity (layer, (int) (p % trail->row) - 1, (int) (p / trail->row) - 1);
      sum     += a * a;
      weights += a;
    }
  return weights > 0 ? sum / weights : 0;
}

/* Which end is opaque, or thick? */
static bool
read_slope (CeldTrail *trail, const Layer *layer, CeldArrowStyle style, Ends *ends)
{
  uint32_t  start = celd_trail_follow (trail, trail->pixel, 1);
  double    third, value[3], w;
  CeldPoint first, last;

  celd_trail_follow (trail, &start, 1);
  third = celd_trail_length (trail) / 3;
  if (third < 2)
    return false;
  for (int i = 0; i < 3; i++)
    value[i] = style == CELD_ARROW_FADE ? strength (trail, layer, i * third, (i + 1) * third)
                                        : celd_trail_width (trail, i * third, (i + 1) * third);
  if (fabs (value[0] - value[2]) < LEAST_SIGNAL * fmax (value[0], value[2]))
    return false;
  if (value[1] < fmin (value[0], value[2]) || value[1] > fmax (value[0], value[2]))
    return false;
  w     = fmax (1, celd_trail_width (trail, 0, 3 * third));
  first = celd_trail_centre (trail, 0, w);
  last  = celd_trail_centre (trail, 3 * third - w, 3 * third);
  *ends = value[0] > value[2] ? (Ends) { first, last } : (Ends) { last, first };
  return true;
}

static bool
read_stroke (CeldTrail *trail, const Layer *layer, CeldArrowStyle style, Ends *ends)
{
  CeldPoint swap;

  if (style == CELD_ARROW_FADE || style == CELD_ARROW_TAPER)
    return read_slope (trail, layer, style, ends);
  if (!read_head (trail, style, ends))
    return false;
  if (style == CELD_ARROW_DOT)
    {
      swap = ends->nearer;
      ends->nearer  = ends->farther;
      ends->farther = swap;
    }
  return true;
}

/* The commonest colour of a layer without alpha, found by a vote on 5 bits a channel; else the layer has alpha. */
static CeldStatus
look_at_layer (const CeldPaint *paint, Layer *layer)
{
  uint32_t *votes = celd_alloc0 (1 << 15, sizeof *votes), best = 0;

  if (!votes)
    return CELD_NO_MEMORY;
  *layer = (Layer) { .paint = paint, .opaque = true };
  for (int y = 0; y < paint->height && layer->opaque; y++)
    for (int x = 0; x < paint->width; x++)
      {
        const uint8_t *c   = CELD_RGBA (paint, x, y);
        uint32_t       key = (uint32_t) ((c[0] >> 3) << 10 | (c[1] >> 3) << 5 | c[2] >> 3);

        layer->opaque &= c[3] == 255;
        if (++votes[key] > best)
          {
            best = votes[key];
            for (int i = 0; i < 3; i++)
              layer->paper[i] = c[i];
          }
      }
  celd_free (votes);
  return CELD_OK;
}

/* Strokes whose mean colour is blue are cracks: hue 195 to 265 degrees, not greyish. */
static bool
is_blue (const CeldTrail *trail, const Layer *layer)
{
  double red = 0, green = 0, blue = 0, most, least, hue;

  for (size_t i = 0; i < trail->n; i++)
    {
      int            x = (int) (trail->pixel[i] % trail->row) - 1, y = (int) (trail->pixel[i] / trail->row) - 1;
      const uint8_t *c = CELD_RGBA (layer->paint, x, y);
      int            a = opacity (layer, x, y);

      red   += c[0] * a;
      green += c[1] * a;
      blue  += c[2] * a;
    }
  most  = fmax (blue, fmax (red, green));
  least = fmin (blue, fmin (red, green));
  if (blue < most || most - least < 0.25 * most)
    return false;
  hue = 240 + 60 * (red - green) / (most - least);
  return hue >= 195 && hue <= 265;
}

static CeldStatus
add_arrow (const Ends *ends, bool crack, CeldRelations *relations)
{
  CeldRelation *item = celd_grow (relations->item, relations->n + 1, sizeof *item);

  if (!item)
    return CELD_NO_MEMORY;
  relations->item      = item;
  item[relations->n++] = (CeldRelation) {
    .nearer = { .x = ends->nearer.x, .y = ends->nearer.y }, .farther = { .x = ends->farther.x, .y = ends->farther.y },
    .crack = crack, .weight = 1, .gap = 1, .source = CELD_SOURCE_ARROW,
  };
  return CELD_OK;
}

/* What one pass over the strokes needs. */
typedef struct
{
  CeldLabels      strokes;   /* each pixel's stroke, from 1 */
  CeldComponent  *component; /* of each stroke */
  size_t          n;
  uint32_t       *pixel;     /* stroke by stroke, in reading order, numbered as in a trail */
  CeldTrail       trail;
} Strokes;

static void
strokes_end (Strokes *s)
{
  celd_free (s->strokes.data);
  celd_free (s->component);
  celd_free (s->pixel);
  celd_free (s->trail.distance);
  celd_free (s->trail.front);
}

static CeldStatus
find_strokes (const Layer *layer, CeldArrowStyle style, const CeldRun *run, Strokes *s)
{
  const CeldPaint *paint = layer->paint;
  int              least = layer->opaque ? CONTRAST : style == CELD_ARROW_FADE ? FADED_OPACITY : LEAST_OPACITY;
  CeldLabels       mask;
  CeldStatus       status = celd_labels_new (paint->width, paint->height, &mask);

  if (status != CELD_OK)
    return status;
  for (int y = 0; y < paint->height; y++)
    for (int x = 0; x < paint->width; x++)
      CELD_AT (&mask, x, y) = opacity (layer, x, y) >= least;
  status = celd_labels_new (paint->width, paint->height, &s->strokes);
  if (status == CELD_OK)
    status = celd_components (&mask, 0, true, run, &s->strokes, &s->component, &s->n);
  celd_free (mask.data);
  return status;
}

/* Sorts the pixels by stroke and makes room for trails. */
static CeldStatus
gather_pixels (Strokes *s)
{
  size_t  all = 0, most = 0, width = (size_t) s->strokes.width, plane = (width + 2) * ((size_t) s->strokes.height + 2);
  size_t *next = celd_alloc (s->n + 1, sizeof *next);

  for (size_t k = 0; next && k < s->n; k++)
    {
      next[k] = all;
      all += s->component[k].area;
      if (most < s->component[k].area)
        most = s->component[k].area;
    }
  s->pixel = celd_alloc (all, sizeof *s->pixel);
  s->trail = (CeldTrail) {
    .row = width + 2, .distance = celd_alloc (plane, sizeof (float)), .front = celd_alloc (most + most / 2 + 4, sizeof (CeldFront)),
  };
  if (!next || !s->pixel || !s->trail.distance || !s->trail.front)
    {
      celd_free (next);
      return CELD_NO_MEMORY;
    }
  for (size_t i = 0; i < plane; i++)
    s->trail.distance[i] = INFINITY;
  for (int y = 0; y < s->strokes.height; y++)
    for (int x = 0; x < s->strokes.width; x++)
      if (CELD_AT (&s->strokes, x, y))
        s->pixel[next[CELD_AT (&s->strokes, x, y) - 1]++] = (uint32_t) ((size_t) (y + 1) * (width + 2) + (size_t) x + 1);
  celd_free (next);
  return CELD_OK;
}

/* The pixel in the middle of a stroke. */
static CeldProblem
unclear_arrow (const CeldTrail *trail)
{
  CeldPoint p = celd_trail_point (trail, trail->pixel[trail->n / 2]);

  return (CeldProblem) { .kind = CELD_PROBLEM_ARROW_UNCLEAR, .x = (int) p.x, .y = (int) p.y, .relation = CELD_NO_INDEX };
}

static CeldStatus
read_strokes (Strokes *s, const Layer *layer, CeldArrowStyle style, const CeldRun *run,
              CeldRelations *relations, CeldProblems *problems)
{
  CeldStatus status = CELD_OK;
  size_t     done   = 0, all = 0;

  for (size_t k = 0; k < s->n; k++)
    all += s->component[k].area;
  for (size_t k = 0; k < s->n && status == CELD_OK; k++)
    {
      Ends ends = { { 0, 0 }, { 0, 0 } };

      s->trail.pixel = s->pixel + done;
      s->trail.n     = s->component[k].area;
      done += s->trail.n;
      if (s->trail.n < LEAST_STROKE)
        continue;
      if (read_stroke (&s->trail, layer, style, &ends))
        status = add_arrow (&ends, is_blue (&s->trail, layer), relations);
      else
        status = celd_problem_add (problems, unclear_arrow (&s->trail));
      if (status == CELD_OK)
        status = celd_step (run, (double) done / (double) all);
    }
  return status;
}

CeldStatus
celd_arrows_read (const CeldPaint *arrows, CeldArrowStyle style, const CeldRun *run,
                  CeldRelations *relations, CeldProblems *problems)
{
  Strokes    strokes = { 0 };
  Layer      layer;
  CeldPart   first, rest;
  CeldRun    finding = celd_run_part (&first, run, 0, 0.5), reading = celd_run_part (&rest, run, 0.5, 1);
  size_t     n_relations = relations->n, n_problems = problems ? problems->n : 0;
  CeldStatus status;

  if (!CELD_SAME_SIZE (arrows, arrows))
    return CELD_BAD_SIZE;
  status = look_at_layer (arrows, &layer);
  if (status == CELD_OK)
    status = find_strokes (&layer, style, &finding, &strokes);
  if (status == CELD_OK)
    status = gather_pixels (&strokes);
  if (status == CELD_OK)
    status = read_strokes (&strokes, &layer, style, &reading, relations, problems);
  strokes_end (&strokes);
  if (status != CELD_OK)
    {
      relations->n = n_relations;
      if (problems)
        problems->n = n_problems;
    }
  return status;
}
