/* Arrows for tests: drawn with antialiasing, and judged as they are read.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef DRAW_ARROWS_H
#define DRAW_ARROWS_H

#include "check.h"

#define MOST_POINTS 16

typedef struct { double x, y; } Point;
typedef enum { BARE, OPEN, FILLED, BAR, DOT } Head;

/* A stroke from point[0] on, with a head at the tip, and for BARE ones a width and opacity that change on the way. */
typedef struct
{
  Point  point[MOST_POINTS], tip, barb[2];
  int    n;
  double width, last_width, alpha, last_alpha, size;
  Head   head;
} Arrow;

static inline double
random_between (uint32_t *state, double a, double b)
{
  return a + (b - a) * check_random (state, 1 << 20) / (1 << 20);
}

/* Along a circle of the given total turning, with unsteady hand. */
static inline Arrow
arrow_at (Point tail, double angle, double length, double width, double turning, double jitter, Head head, double size)
{
  Arrow a = { .n = MOST_POINTS, .width = width, .last_width = width, .alpha = 1, .last_alpha = 1, .head = head };
  Point p = tail;
  int   k = MOST_POINTS - 1;

  for (int i = 0; i < a.n; i++)
    {
      double t = i / (a.n - 1.), way = angle + turning * (t - 0.5), off = jitter * sin (21 * t + length);

      a.point[i] = (Point) { p.x - off * sin (angle), p.y + off * cos (angle) };
      p.x += length / (a.n - 1) * cos (way);
      p.y += length / (a.n - 1) * sin (way);
    }
  a.tip = a.point[k];
  while (k > 0 && hypot (a.point[k].x - a.tip.x, a.point[k].y - a.tip.y) < size)
    k--;
  angle = atan2 (a.tip.y - a.point[k].y, a.tip.x - a.point[k].x);
  for (int side = 0; side < 2; side++)
    {
      double spread = head == BAR ? 1.57 : 0.55;

      a.barb[side].x = a.tip.x - size * cos (angle + (side ? spread : -spread));
      a.barb[side].y = a.tip.y - size * sin (angle + (side ? spread : -spread));
    }
  while (head == FILLED && a.n > 2 && hypot (a.point[a.n - 1].x - a.tip.x, a.point[a.n - 1].y - a.tip.y) < 0.6 * size)
    a.n--; /* the shaft must not blunt the tip, */
  if (head == FILLED)
    a.point[a.n++] = (Point) { 0.4 * a.tip.x + 0.3 * (a.barb[0].x + a.barb[1].x),
                               0.4 * a.tip.y + 0.3 * (a.barb[0].y + a.barb[1].y) }; /* so it ends inside the head */
  a.size = size;
  return a;
}

static inline double
from_segment (Point p, Point a, Point b, double *t)
{
  double dx = b.x - a.x, dy = b.y - a.y, l = dx * dx + dy * dy;
  double way = l > 0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / l : 0;

  *t = way < 0 ? 0 : way > 1 ? 1 : way;
  dx = p.x - a.x - *t * dx;
  dy = p.y - a.y - *t * dy;
  return sqrt (dx * dx + dy * dy); /* hypot takes half of the time of the tests that draw arrows */
}

static inline double
side_of (Point p, Point a, Point b)
{
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/* Opacity of an arrow at a point. */
static inline double
opacity_at (const Arrow *a, Point p)
{
  double t, opacity = 0;

  for (int i = 0; i + 1 < a->n; i++)
    {
      double d = from_segment (p, a->point[i], a->point[i + 1], &t), way = (i + t) / (a->n - 1);

      if (d <= 0.5 * (a->width + way * (a->last_width - a->width)))
        opacity = fmax (opacity, fmin (1, a->alpha + way * (a->last_alpha - a->alpha)));
    }
  for (int side = 0; side < 2 && (a->head == OPEN || a->head == BAR); side++)
    if (from_segment (p, a->tip, a->barb[side], &t) <= 0.5 * a->width)
      opacity = 1;
  if (a->head == FILLED)
    {
      double s = side_of (p, a->tip, a->barb[0]), u = side_of (p, a->barb[0], a->barb[1]);
      double v = side_of (p, a->barb[1], a->tip);

      if ((s >= 0 && u >= 0 && v >= 0) || (s <= 0 && u <= 0 && v <= 0))
        opacity = 1;
    }
  if (a->head == DOT && hypot (p.x - a->tip.x, p.y - a->tip.y) <= a->size)
    opacity = 1;
  return opacity;
}

static inline CeldPaint
blank (int width, int height)
{
  size_t stride = (size_t) width + 5;

  return (CeldPaint) { width, height, stride, calloc (stride * (size_t) height, 4) };
}

/* Marks the box of two points, with a margin. */
static inline void
mark_box (const CeldPaint *paint, uint8_t *near, Point a, Point b, double margin)
{
  int left = (int) fmax (0, fmin (a.x, b.x) - margin), right = (int) fmin (paint->width - 1, fmax (a.x, b.x) + margin);
  int top = (int) fmax (0, fmin (a.y, b.y) - margin), bottom = (int) fmin (paint->height - 1, fmax (a.y, b.y) + margin);

  for (int y = top; y <= bottom; y++)
    for (int x = left; x <= right; x++)
      near[y * paint->width + x] = 1;
}

/* Paints over what is fainter: 3 x 3 samples a pixel, only near the arrow. */
static inline void
draw_arrow (CeldPaint *paint, const Arrow *a, const uint8_t colour[3])
{
  uint8_t *near = calloc ((size_t) paint->width * (size_t) paint->height, 1);

  for (int i = 0; i + 1 < a->n; i++)
    mark_box (paint, near, a->point[i], a->point[i + 1], 0.5 * fmax (a->width, a->last_width) + 1);
  if (a->head != BARE)
    mark_box (paint, near, a->tip, a->tip, 1.2 * a->size + a->width + 1);
  for (int i = 0; i < paint->width * paint->height; i++)
    if (near[i])
      {
        int      x = i % paint->width, y = i / paint->width;
        uint8_t *c = paint->data + 4 * ((size_t) y * paint->stride + (size_t) x);
        double   sum = 0;

        for (int s = 0; s < 9; s++)
          sum += opacity_at (a, (Point) { x + (s % 3 + 0.5) / 3, y + (s / 3 + 0.5) / 3 }) / 9;
        if (sum * 255 > c[3])
          {
            memcpy (c, colour, 3);
            c[3] = (uint8_t) (255 * sum + 0.5);
          }
      }
  free (near);
}

static const uint8_t GREEN[3] = { 20, 160, 60 }, BLUE[3] = { 30, 80, 230 };

typedef struct { CeldRelations relations; CeldProblems problems; } Answer;

static inline Answer
read_paint (const CeldPaint *paint, CeldArrowStyle style)
{
  Answer a = { { 0 }, { 0 } };

  CHECK (celd_arrows_read (paint, style, NULL, &a.relations, &a.problems) == CELD_OK);
  return a;
}

static inline void
forget (Answer *a)
{
  celd_relations_clear (&a->relations);
  celd_problems_clear (&a->problems);
}

/* Right: 1, unclear: 0, wrong: -1; within 2 pixels and one stroke width. */
static inline int
judge (const Answer *a, Point nearer, Point farther, double width)
{
  const CeldRelation *r = a->relations.item;

  if (a->relations.n == 0)
    return a->problems.n == 1 && a->problems.item[0].kind == CELD_PROBLEM_ARROW_UNCLEAR ? 0 : -1;
  return a->relations.n == 1 && hypot (r->nearer.x - nearer.x, r->nearer.y - nearer.y) < 2 + width &&
         hypot (r->farther.x - farther.x, r->farther.y - farther.y) < 2 + width ? 1 : -1;
}

/* Draws one arrow alone and judges how it is read. */
static inline int
judge_arrow (const Arrow *a, int size, CeldArrowStyle style, bool tip_is_nearer)
{
  CeldPaint paint = blank (size, size);
  Answer    answer;
  int       verdict;

  draw_arrow (&paint, a, GREEN);
  answer  = read_paint (&paint, style);
  verdict = tip_is_nearer ? judge (&answer, a->tip, a->point[0], a->width + a->size / 2)
                          : judge (&answer, a->point[0], a->tip, a->width);
  for (size_t i = 0; i < answer.problems.n; i++) /* a problem lies on its stroke */
    {
      const CeldProblem *p = &answer.problems.item[i];

      CHECK (paint.data[4 * ((size_t) p->y * paint.stride + (size_t) p->x) + 3] > 0);
    }
  forget (&answer);
  free (paint.data);
  return verdict;
}

static inline Arrow
straight (double degrees, double width, Head head, double size)
{
  double angle = degrees * 0.0174532925;

  return arrow_at ((Point) { 50 - 32 * cos (angle), 50 - 32 * sin (angle) }, angle, 64, width, 0, 0, head, size);
}

static const CeldArrowStyle STYLES[] = { CELD_ARROW_HEAD, CELD_ARROW_DOT, CELD_ARROW_FADE, CELD_ARROW_TAPER };

/* A stroke through a place, part `share` of its way behind it, in a style. */
static inline Arrow
through (Point p, double angle, double length, double share, double width, CeldArrowStyle style, bool open)
{
  Head  head = style == CELD_ARROW_HEAD ? (open ? OPEN : FILLED) : style == CELD_ARROW_DOT ? DOT : BARE;
  Point tail = { p.x - share * length * cos (angle), p.y - share * length * sin (angle) };
  Arrow a = arrow_at (tail, angle, length, width, 0.1, 0, head, style == CELD_ARROW_DOT ? 1.6 * width : 3.8 * width);

  if (style == CELD_ARROW_FADE)
    a.last_alpha = 0.15;
  if (style == CELD_ARROW_TAPER)
    a.last_width = 0.3 * width;
  return a;
}

/* Is one of the relations this arrow, the right way round? */
static inline bool
is_read (const Answer *answer, const Arrow *a, CeldArrowStyle style)
{
  Point  first = style == CELD_ARROW_DOT ? a->tip : a->point[0], last = style == CELD_ARROW_DOT ? a->point[0] : a->tip;
  double near = 3 + 1.5 * a->width;

  for (size_t i = 0; i < answer->relations.n; i++)
    {
      const CeldRelation *r = &answer->relations.item[i];

      if (hypot (r->nearer.x - first.x, r->nearer.y - first.y) < near &&
          hypot (r->farther.x - last.x, r->farther.y - last.y) < near)
        return true;
    }
  return false;
}

/* How many of n arrows are read the right way round. */
static inline size_t
count_read (const Answer *answer, const Arrow *arrows, int n, CeldArrowStyle style)
{
  size_t found = 0;

  for (int k = 0; k < n; k++)
    found += is_read (answer, &arrows[k], style);
  return found;
}

/* Composites paint on a colour: a layer without alpha. */
static inline void
flatten (CeldPaint *paint, uint8_t paper)
{
  for (size_t i = 0; i < paint->stride * (size_t) paint->height; i++)
    {
      uint8_t *c = paint->data + 4 * i;

      for (int k = 0; k < 3; k++)
        c[k] = (uint8_t) ((c[k] * c[3] + paper * (255 - c[3]) + 127) / 255);
      c[3] = 255;
    }
}

#endif
