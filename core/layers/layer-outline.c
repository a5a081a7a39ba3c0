/* The outline of a layer, traced along crack edges, and its gaps, where a nearer layer occludes it.
 *
 * A gap begins and ends at T-junctions, where the layer's outline disappears under the nearer one.  Lines merge right
 * there, so the direction is that of a parabola fitted to the outline from a stroke's width before the junction on.
 * The width of the layer's own line is measured at the same places, inwards from the outline.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "image/image.h"
#include "layers/layers.h"

#include <math.h>
#include <stdlib.h>

#define MIN_HIDDEN           3  /* crack edges; a shorter occluded piece is an effect of antialiasing; chosen */
#define MIN_VISIBLE          4  /* crack edges; so is a shorter visible piece, and one below a stroke's width: a
                                 * corner between lines; chosen */
#define MIN_RELIABLE_STROKES 3  /* stroke widths; a shorter piece has no reliable direction; chosen */
#define WIDTH_SAMPLES        9  /* places at which the line's width is measured; chosen */
#define MAX_LINE_WIDTH       64 /* pixels; thicker ink is no line; chosen */

/* ------------------------------------------------------------------ tracing */

/* Directions: 0 right, 1 down, 2 left, 3 up. */
static const int step_x[4] = { 1, 0, -1, 0 }, step_y[4] = { 0, 1, 0, -1 };
/* Offsets from corner (x,y) to the pixels on the right and on the left of a step. */
static const int right_x[4] = { 0, -1, -1, 0 }, right_y[4] = { 0, 0, -1, -1 };
static const int left_x[4] = { 0, 0, -1, -1 }, left_y[4] = { -1, 0, 0, -1 };

typedef struct
{
  const CeldLayers *layers;
  size_t            layer;
  CeldRect          box;       /* of the visible part of the layer */
  uint8_t          *traced;    /* is the upper side of a pixel of the box traced? */
  CeldOutline      *outline;
} Tracing;

static bool
is_visible (const Tracing *t, int x, int y)
{
  return celd_layer_visibility (t->layers, t->layer, x, y) == CELD_LAYER_VISIBLE;
}

static uint8_t *
upper_side (const Tracing *t, int x, int y)
{
  return &t->traced[(size_t) (y - t->box.y) * (size_t) t->box.width + (size_t) (x - t->box.x)];
}

/* Traces the loop that includes the upper side of pixel (x,y). */
static CeldStatus
trace_loop (Tracing *t, int x, int y)
{
  CeldOutline *o = t->outline;
  int          from_x = x, from_y = y, d = 0;

  do
    {
      CeldVisibility beyond = celd_layer_visibility (t->layers, t->layer, x + left_x[d], y + left_y[d]);

      if (celd_append (o->crack, o->n, o->crack_capacity, (CeldCrackEdge) { x, y, beyond
                                                                            == CELD_LAYER_OCCLUDED }) != CELD_OK)
        return CELD_NO_MEMORY;
      if (d == 0)
        *upper_side (t, x, y) = 1;
      x += step_x[d];
      y += step_y[d];
      if (!is_visible (t, x + right_x[d], y + right_y[d]))
        d = (d + 1) % 4;
      else if (is_visible (t, x + left_x[d], y + left_y[d]))
        d = (d + 3) % 4;
    }
  while (x != from_x || y != from_y || d != 0);
  return CELD_OK;
}

/* Records the end of the last loop. */
static CeldStatus
end_loop (CeldOutline *outline)
{
  if (!celd_reserve (&outline->loop, outline->n_loops + 2, &outline->loop_capacity, sizeof *outline->loop))
    return CELD_NO_MEMORY;
  outline->loop[++outline->n_loops] = outline->n;
  return CELD_OK;
}

static CeldStatus
trace_all (Tracing *t)
{
  CeldStatus status = CELD_OK;

  if (!celd_reserve (&t->outline->loop, 1, &t->outline->loop_capacity, sizeof *t->outline->loop))
    return CELD_NO_MEMORY;
  t->outline->loop[0] = 0;
  for (int y = t->box.y; y < t->box.y + t->box.height && status == CELD_OK; y++)
    for (int x = t->box.x; x < t->box.x + t->box.width && status == CELD_OK; x++)
      if (is_visible (t, x, y) && !is_visible (t, x, y - 1) && !*upper_side (t, x, y))
        {
          status = trace_loop (t, x, y);
          if (status == CELD_OK)
            status = end_loop (t->outline);
        }
  return status;
}

/* ------------------------------------------------------------------ pieces of a loop */

typedef struct { CeldCrackEdge *crack; size_t n; } Loop;

static CeldCrackEdge *
crack_at (const Loop *loop, size_t i)
{
  return &loop->crack[i % loop->n];
}

/* Index of a crack edge where a piece begins; n if the loop is all of one kind. */
static size_t
find_change (const Loop *loop)
{
  for (size_t i = 0; i < loop->n; i++)
    if (loop->crack[i].hidden != crack_at (loop, i + loop->n - 1)->hidden)
      return i;
  return loop->n;
}

static size_t
piece_length (const Loop *loop, size_t from)
{
  size_t length = 1;

  while (length < loop->n && crack_at (loop, from + length)->hidden == crack_at (loop, from)->hidden)
    length++;
  return length;
}

/* Changes pieces of that kind below the least length to the other kind. */
static void
merge_short_pieces (const Loop *loop, bool hidden, size_t least)
{
  size_t start = find_change (loop);

  for (size_t i = 0, length; start < loop->n && i < loop->n; i += length)
    {
      length = piece_length (loop, start + i);
      if (crack_at (loop, start + i)->hidden == hidden && length < least)
        for (size_t k = 0; k < length; k++)
          crack_at (loop, start + i + k)->hidden = !hidden;
    }
}

/* Twice the area to the right of the loop; negative for a hole. */
static int64_t
loop_area (const Loop *loop)
{
  int64_t area = 0;

  for (size_t i = 0; i < loop->n; i++)
    {
      const CeldCrackEdge *a = crack_at (loop, i), *b = crack_at (loop, i + 1);

      area += (int64_t) a->x * b->y - (int64_t) b->x * a->y;
    }
  return area;
}

/* ------------------------------------------------------------------ measurements at the ends of a gap */

/* The crack edge s steps from the junction at crack edge i, backwards (direction -1) or forwards. */
static const CeldCrackEdge *
walk (const Loop *loop, size_t i, int direction, size_t s)
{
  return crack_at (loop, direction < 0 ? i + loop->n - s % loop->n : i + s);
}

/* A point of the smoothed outline, at arc length s. */
typedef struct { double x, y, s; } Point;

static void
list_points (const Loop *loop, size_t i, int direction, size_t from, size_t to, Point *point)
{
  for (size_t k = from; k <= to; k++)
    {
      Point *p = &point[k - from];

      *p = (Point) { 0 };
      for (size_t w = 0; w < 5; w++)
        {
          const CeldCrackEdge *crack = walk (loop, i, direction, k + w > 2 ? k + w - 2 : 0);

          p->x += crack->x / 5.0;
          p->y += crack->y / 5.0;
        }
      p->s = k == from ? (double) from : p[-1].s + hypot (p->x - p[-1].x, p->y - p[-1].y);
    }
}

/* The slope at s = 0 of a parabola, or with few points of a straight line, fitted to value (s) by least squares.
 * `value` is the offset of the member of Point. */
static double
slope_at_junction (const Point *point, size_t n, size_t value)
{
  double centre = 0, s2 = 0, s3 = 0, s4 = 0, v0 = 0, v1 = 0, v2 = 0, determinant, curve;

  for (size_t k = 0; k < n; k++)
    centre += point[k].s / (double) n;
  for (size_t k = 0; k < n; k++)
    {
      double u = point[k].s - centre, v = *(const double *) (const void *) ((const char *) &point[k] + value);

      s2 += u * u;
      s3 += u * u * u;
      s4 += u * u * u * u;
      v0 += v;
      v1 += v * u;
      v2 += v * u * u;
    }
  if (!(s2 > 0))
    return 0;
  determinant = s4 - s2 * s2 / (double) n - s3 * s3 / s2;
  if (n < 8 || !(determinant > 1e-9 * s4))
    return v1 / s2;
  curve = (v2 - s2 * v0 / (double) n - s3 * v1 / s2) / determinant;
  return (v1 - curve * s3) / s2 - 2 * curve * centre;
}

/* Amount of ink inwards from a crack edge along (nx,ny), in pixels; also the colour of the darkest pixel. */
static double
line_width (const CeldLayers *layers, size_t layer, const CeldPlane *ink, double x, double y, double nx, double ny,
            float colour[4])
{
  double width = 0;
  float  least = 2;

  for (double s = 0.25; s < MAX_LINE_WIDTH; s += 0.5)
    {
      int   px = (int) floor (x + nx * s), py = (int) floor (y + ny * s);
      float value;

      if (celd_layer_visibility (layers, layer, px, py) != CELD_LAYER_VISIBLE)
        break;
      value = CELD_AT (ink, px, py);
      if (celd_is_paper (value) && s > 1.5)
        break;
      value = value > 0 ? value < 1 ? value : 1 : 0;
      width += 0.5 * (1 - (double) value);
      if (value < least)
        {
          least = value;
          memcpy (colour, layers->art + 4 * ((size_t) py * (size_t) layers->width + (size_t) px), 4 * sizeof *colour);
        }
    }
  return width;
}

static int
compare_widths (const void *a, const void *b)
{
  double one = *(const double *) a, other = *(const double *) b;

  return (one > other) - (one < other);
}

/* The median of the line widths from s = from to `to`, and the colour in the middle of them. */
static void
measure_line (const CeldLayers *layers, size_t layer, const CeldPlane *ink, const Loop *loop, size_t i, int direction,
              size_t from, size_t to, CeldGapEnd *end)
{
  double width[WIDTH_SAMPLES];
  float  colour[4] = { 0 };

  memset (end->colour, 0, sizeof end->colour);
  for (size_t k = 0; k < WIDTH_SAMPLES; k++)
    {
      size_t           s = from + (to - from) * k / (WIDTH_SAMPLES - 1);
      const CeldCrackEdge *here = walk (loop, i, direction, s), *back = walk (loop, i, direction, s > 3 ? s - 3 : 0);
      const CeldCrackEdge *on = walk (loop, i, direction, s + 3);
      double           dx = direction * (on->x - back->x), dy = direction * (on->y - back->y), length = hypot (dx, dy);

      width[k] = length > 0 ? line_width (layers, layer, ink, here->x, here->y, -dy / length, dx / length, colour) : 0;
      if (k == WIDTH_SAMPLES / 2 && width[k] > 0)
        memcpy (end->colour, colour, sizeof colour);
    }
  qsort (width, WIDTH_SAMPLES, sizeof *width, compare_widths);
  end->width = end->colour[3] > 0 ? width[WIDTH_SAMPLES / 2] : 0;
}

/* Measures the end at the first corner of crack edge i; the visible piece lies in `direction` and has `length` crack
 * edges. */
static CeldStatus
describe_end (const CeldLayers *layers, size_t layer, const CeldPlane *ink, int stroke, const Loop *loop, size_t i,
              int direction, size_t length, CeldGapEnd *end)
{
  size_t length_limit = (size_t) (5 * stroke < 16 ? 16 : 5 * stroke > 64 ? 64 : 5 * stroke), from = (size_t) stroke
                        + 1, to;
  Point *point;
  double tx, ty, norm;

  to   = from + length_limit < length ? from + length_limit : length;
  from = from < to / 2 ? from : to / 2;
  point = celd_alloc (to - from + 1, sizeof *point);
  if (!point)
    return CELD_NO_MEMORY;
  list_points (loop, i, direction, from, to, point);
  tx = direction * slope_at_junction (point, to - from + 1, offsetof (Point, x));
  ty = direction * slope_at_junction (point, to - from + 1, offsetof (Point, y));
  celd_free (point);
  norm = hypot (tx, ty);
  *end = (CeldGapEnd) { .x = crack_at (loop, i)->x, .y = crack_at (loop, i)->y,
                     .tx = norm > 0 ? tx / norm : 0, .ty = norm > 0 ? ty / norm : 0,
                     .reliable = norm > 0 && length > MIN_RELIABLE_STROKES * (size_t) stroke };
  measure_line (layers, layer, ink, loop, i, direction, from, to, end);
  return CELD_OK;
}

/* ------------------------------------------------------------------ gaps */

static CeldStatus
add_gap (const CeldLayers *layers, size_t layer, const CeldPlane *ink, int stroke, const Loop *loop, size_t from,
         size_t length, CeldOutline *outline)
{
  CeldOutlineGap *gap;
  size_t          before = 1, after;
  CeldStatus      status;

  if (!celd_reserve_one (outline->gap, outline->n_gaps, outline->gap_capacity))
    return CELD_NO_MEMORY;
  gap = &outline->gap[outline->n_gaps];
  while (!crack_at (loop, from + loop->n - before - 1)->hidden)
    before++;
  after = piece_length (loop, from + length);
  status = describe_end (layers, layer, ink, stroke, loop, from, -1, before, &gap->in);
  if (status == CELD_OK)
    status = describe_end (layers, layer, ink, stroke, loop, from + length, 1, after, &gap->out);
  outline->n_gaps += status == CELD_OK;
  return status;
}

static void
set_hidden (const Loop *loop, bool hidden)
{
  for (size_t i = 0; i < loop->n; i++)
    loop->crack[i].hidden = hidden;
}

static CeldStatus
find_gaps (const CeldLayers *layers, size_t layer, const CeldPlane *ink, int stroke, CeldOutline *outline)
{
  CeldStatus status = CELD_OK;

  for (size_t l = 0; l < outline->n_loops && status == CELD_OK; l++)
    {
      Loop   loop = { outline->crack + outline->loop[l], outline->loop[l + 1] - outline->loop[l] };
      size_t start;

      merge_short_pieces (&loop, true, MIN_HIDDEN);
      merge_short_pieces (&loop, false, (size_t) (stroke > MIN_VISIBLE ? stroke : MIN_VISIBLE));
      start = find_change (&loop);
      if (start == loop.n)
        set_hidden (&loop, loop.crack->hidden && loop_area (&loop) < 0);
      for (size_t i = 0, length; start < loop.n && i < loop.n && status == CELD_OK; i += length)
        {
          length = piece_length (&loop, start + i);
          if (crack_at (&loop, start + i)->hidden)
            status = add_gap (layers, layer, ink, stroke, &loop, start + i, length, outline);
        }
    }
  return status;
}

void
celd_outline_clear (CeldOutline *outline)
{
  celd_free (outline->crack);
  celd_free (outline->loop);
  celd_free (outline->gap);
  *outline = (CeldOutline) { 0 };
}

CeldStatus
celd_layer_outline (const CeldLayers *layers, size_t layer, const CeldPlane *ink, int stroke, CeldOutline *outline)
{
  Tracing    t = { layers, layer, layers->seen[layer], NULL, outline };
  CeldStatus status;

  *outline = (CeldOutline) { 0 };
  t.traced = celd_alloc0 ((size_t) t.box.width * (size_t) t.box.height, 1);
  status = t.traced ? trace_all (&t) : CELD_NO_MEMORY;
  celd_free (t.traced);
  if (status == CELD_OK)
    status = find_gaps (layers, layer, ink, stroke, outline);
  if (status != CELD_OK)
    celd_outline_clear (outline);
  return status;
}
