/* Which ends of lines that meet at a node have heads or dots there: the cost of every choice.
 *
 * A head is two barbs that leave a tip at some angle to the line, or the two halves of a filled triangle; a dot is a
 * disc.  At places round the node each end gets the head that agrees best with the paint that belongs to no line.  A
 * choice costs the paint that none of its heads explains and the parts of its heads that are not painted, in square
 * widths of the lines.  What other colours hide is neither.
 *
 * Cost: some hundred thousand samples for each end of a line, whatever its width.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/joined-arrows.h"

#include <math.h>
#include <string.h>

/* All chosen; lengths are widths of the paint. */
#define WIDTH_SAMPLES 8      /* in a width, at most one a pixel */
#define TIP_STEP     0.5  /* between places for the tip, ... */
#define TIP_STEPS    4    /* ... on either side of where the lines meet, ... */
#define TIP_OFF      0.05 /* ... and what the square of that distance costs */
#define AS_GOOD      0.15 /* of the cost: places of which the middle is taken */
#define LEAST_SPLAY  0.3  /* radians between the line and a barb, ... */
#define MOST_SPLAY   1.05
#define SPLAY_STEP   0.1 
#define BARB_FROM    0.5  /* from the tip to where a barb begins, ... */
#define LEAST_BARB   2    /* ... to where it ends at least; at most at CELD_HEAD_REACH */
#define BARB_HALF    0.4  /* of its width is looked at on either side, ... */
#define BARB_BODY    0.65 /* ... and so much, and a pixel more, is explained */
#define LEAST_HEAD   1.5  /* square widths of paint beside its line that a head has at least */
#define LEAD_HALF    0.3  /* on either side of a line's last part, which should be painted */
#define DOT_FREE     3    /* from a free end to the middle of its dot, at most, ... */
#define DOT_HUB      1.5  /* ... and from where lines meet */
#define DOT_LEAST    0.95 /* radius of a dot */
#define NO_DOT       0.8  /* radius of the paint where there is none */
#define DOT_SLACK    0.5  /* pixels more than the width of a line, which is known no better */
#define DOT_COST     3    /* of a dot that is not there, or of none where there is one */
#define DOT_HIDDEN   2    /* from an end without a dot to where paint of other colours may hide one */
#define MOST_HIDDEN  0.5  /* part of a dot; of one of which more is hidden, ... */
#define LEAST_RING   1    /* ... so many square widths beside its line are seen */
#define DOT_EDGE     1.5  /* pixels beyond the radius of a dot that belong to it */

/* What a sample of the paint shows. */
enum { SAMPLE_UNKNOWN = -1, SAMPLE_BARE = 0, SAMPLE_PAINT = 1 }; /* SAMPLE_UNKNOWN: hidden, or of a line */

/* The samples round a node, from `corner` on, `step` pixels apart; own: is no other node nearer? */
typedef struct
{
  CeldPoint corner;
  double    step, area; /* area: of a sample, in square widths */
  int       side;
  int8_t   *far, *at;   /* far: without the last parts of the lines of the node */
  bool     *own;
} PaintWindow;

/* A half of a head: what lies from its tip along a barb, up to a length. */
typedef struct { CeldPoint along; double angle, length, gain, missed, seen; } Barb;

typedef struct { Barb barb[2]; bool filled; double gain, missed, seen; } Head;

/* ------------------------------------------------------------------ samples */

static CeldPoint
sample_point (const PaintWindow *w, int x, int y)
{
  return (CeldPoint) { w->corner.x + (x + 0.5) * w->step, w->corner.y + (y + 0.5) * w->step };
}

static int
sample_at (const PaintWindow *w, CeldPoint p)
{
  int x = (int) floor ((p.x - w->corner.x) / w->step), y = (int) floor ((p.y - w->corner.y) / w->step);

  return x >= 0 && y >= 0 && x < w->side && y < w->side ? w->at[y * w->side + x] : SAMPLE_UNKNOWN;
}

static bool
is_nearest_node (const CeldJoinedLines *s, size_t node, const CeldPoint *meeting, CeldPoint p)
{
  for (size_t k = 0; k < s->graph.n_nodes; k++)
    if (k != node && !isnan (meeting[k].x) && celd_points_apart (meeting[k], p) < celd_points_apart (meeting[node], p))
      return false;
  return true;
}

static CeldStatus
window_new (const CeldJoinedLines *s, size_t node, const CeldPoint *meeting, PaintWindow *w)
{
  double width = s->graph.width;
  size_t n;

  w->step   = fmax (1, width / WIDTH_SAMPLES);
  w->area   = w->step * w->step / (width * width);
  w->side   = (int) ceil (2 * CELD_NODE_REACH * width / w->step);
  w->corner = (CeldPoint) { meeting[node].x - 0.5 * w->side * w->step, meeting[node].y - 0.5 * w->side * w->step };
  n         = (size_t) w->side * (size_t) w->side;
  w->far    = celd_alloc (n, 3);
  if (!w->far)
    return CELD_NO_MEMORY;
  w->at  = w->far + n;
  w->own = (bool *) (w->at + n);
  for (int y = 0, i = 0; y < w->side; y++)
    for (int x = 0; x < w->side; x++, i++)
      {
        CeldPoint p = sample_point (w, x, y);

        w->far[i] = (int8_t) celd_joined_paint_at (s, p);
        w->own[i] = w->far[i] > 0 && celd_points_apart (p, meeting[node]) <= CELD_NODE_REACH * width &&
                    is_nearest_node (s, node, meeting, p);
      }
  return CELD_OK;
}

static double
distance_to_part (CeldPoint p, CeldPoint a, CeldPoint b)
{
  double dx = b.x - a.x, dy = b.y - a.y, length = fmax (1e-9, dx * dx + dy * dy);
  double t = fmin (1, fmax (0, ((p.x - a.x) * dx + (p.y - a.y) * dy) / length));

  return hypot (p.x - a.x - t * dx, p.y - a.y - t * dy);
}

/* Leads the lines of a node to a tip: their paint is explained.  Returns the part of them that is bare. */
static double
lead_lines (const CeldJoinedLines *s, const CeldNodeMarks *node, CeldPoint tip, PaintWindow *w)
{
  double missed = 0, width = s->graph.width;

  memcpy (w->at, w->far, (size_t) w->side * (size_t) w->side);
  for (int e = 0; e < node->n; e++)
    {
      CeldPoint from = celd_joined_led_from (s, node->end[e]);
      double    reach = CELD_LINE_BODY * width + 1;
      int       left = (int) floor ((fmin (from.x, tip.x) - reach - w->corner.x) / w->step);
      int       right = (int) ceil ((fmax (from.x, tip.x) + reach - w->corner.x) / w->step);
      int       top = (int) floor ((fmin (from.y, tip.y) - reach - w->corner.y) / w->step);
      int       bottom = (int) ceil ((fmax (from.y, tip.y) + reach - w->corner.y) / w->step);

      for (int y = top > 0 ? top : 0; y < bottom && y < w->side; y++)
        for (int x = left > 0 ? left : 0; x < right && x < w->side; x++)
          {
            double d = distance_to_part (sample_point (w, x, y), from, tip);
            int8_t *at = &w->at[y * w->side + x];

            if (d > reach)
              continue;
            missed += *at == SAMPLE_BARE && d <= LEAD_HALF * width ? w->area : 0;
            *at = SAMPLE_UNKNOWN;
          }
    }
  return missed;
}

/* ------------------------------------------------------------------ heads */

static CeldPoint
turned (CeldPoint d, double angle)
{
  return (CeldPoint) { d.x * cos (angle) - d.y * sin (angle), d.x * sin (angle) + d.y * cos (angle) };
}

/* The best length of a barb at an angle to `way`, on the side with that sign.  Of a filled head it reaches to the
 * line. */
static Barb
fit_length (const CeldJoinedLines *s, const PaintWindow *w, CeldPoint tip, CeldPoint way, double angle, bool filled)
{
  CeldPoint along = turned (way, angle), inward = turned (way, angle > 0 ? -CELD_PI / 2 : CELD_PI / 2);
  CeldPoint across = filled ? inward : turned (along, CELD_PI / 2);
  Barb      barb = { .along = along, .angle = angle, .gain = -INFINITY };
  double    gain = 0, missed = 0, seen = 0, width = s->graph.width, body = CELD_LINE_BODY * width + 1;

  for (double r = BARB_FROM * width; r <= CELD_HEAD_REACH * width; r += w->step)
    {
      CeldPoint p = celd_moved (tip, along, r);
      double    from = filled ? 0 : -BARB_HALF * width, to = filled ? r * fabs (sin (angle)) : BARB_HALF * width;

      for (double o = from; o <= to; o += w->step)
        {
          int at = sample_at (w, celd_moved (p, across, o));

          gain   += at == SAMPLE_PAINT ? w->area : at == SAMPLE_BARE ? -w->area : 0;
          missed += at == SAMPLE_BARE ? w->area : 0;
          if (at == SAMPLE_PAINT || (at == SAMPLE_UNKNOWN && fabs (r * sin (angle)) - fabs (o) > body))
            seen += w->area;
        }
      if (r >= LEAST_BARB * width && gain > barb.gain)
        {
          barb.gain   = gain;
          barb.missed = missed;
          barb.seen   = seen;
          barb.length = r;
        }
    }
  return barb;
}

static Head
fit_head (const CeldJoinedLines *s, const PaintWindow *w, CeldPoint tip, CeldPoint way)
{
  Head best = { .gain = -INFINITY };

  for (int filled = 0; filled < 2; filled++)
    {
      Head head = { .filled = filled };

      for (int side = 0; side < 2; side++)
        {
          head.barb[side].gain = -INFINITY;
          for (double angle = LEAST_SPLAY; angle <= MOST_SPLAY; angle += SPLAY_STEP)
            {
              Barb barb = fit_length (s, w, tip, way, side ? angle : -angle, filled);

              if (barb.gain > head.barb[side].gain)
                head.barb[side] = barb;
            }
          head.gain   += head.barb[side].gain;
          head.missed += head.barb[side].missed;
          head.seen   += head.barb[side].seen;
        }
      if (head.gain > best.gain)
        best = head;
    }
  return best;
}

/* Does a head explain the paint at a point? */
static bool
head_explains (const CeldJoinedLines *s, const Head *head, CeldPoint tip, CeldPoint way, CeldPoint p)
{
  double body = BARB_BODY * s->graph.width + 1;

  for (int side = 0; side < 2; side++)
    {
      const Barb *b = &head->barb[side];
      CeldPoint   end = celd_moved (tip, b->along, b->length);
      double      forwards = (p.x - tip.x) * way.x + (p.y - tip.y) * way.y;
      double      aside = (p.y - tip.y) * way.x - (p.x - tip.x) * way.y;

      if (distance_to_part (p, tip, end) <= body)
        return true;
      if (head->filled && forwards >= 0 && forwards <= b->length * cos (b->angle) + body && aside * b->angle >= 0 &&
          fabs (aside) <= forwards * tan (fabs (b->angle)))
        return true;
    }
  return false;
}

/* ------------------------------------------------------------------ choices at a node */

/* The costs of all choices with their tips at one place.  rest: of each set of ends, the paint that the heads of these
 * explain, and no others. */
static void
costs_at (const CeldJoinedLines *s, const CeldNodeMarks *node, CeldPoint tip, PaintWindow *w, double *cost)
{
  double    lead = lead_lines (s, node, tip, w), rest[1 << CELD_MOST_MARKS] = { 0 };
  Head      head[CELD_MOST_MARKS];
  CeldPoint way[CELD_MOST_MARKS];
  int       n = s->style == CELD_ARROW_DOT ? 0 : node->n; /* heads */

  for (int e = 0; e < n; e++)
    {
      way[e]  = celd_joined_way (s, node->end[e]);
      head[e] = fit_head (s, w, tip, way[e]);
    }
  for (int y = 0, i = 0; y < w->side; y++)
    for (int x = 0; x < w->side; x++, i++)
      if (w->own[i] && w->at[i] == SAMPLE_PAINT)
        {
          CeldPoint p = sample_point (w, x, y);
          unsigned  by = 0;

          for (int e = 0; e < n; e++)
            by |= head_explains (s, &head[e], tip, way[e], p) ? 1u << e : 0;
          rest[by] += w->area;
        }
  for (unsigned set = 0; set < 1u << node->n; set++)
    {
      cost[set] = lead;
      for (unsigned by = 0; by < 1u << node->n; by++)
        cost[set] += by & set ? 0 : rest[by];
      for (int e = 0; e < n; e++)
        cost[set] += set >> e & 1 ? head[e].missed + fmax (0, LEAST_HEAD - head[e].seen) : 0;
    }
}

/* The mean width of the middle half of a line. */
static double
line_width (const CeldJoinedLines *s, size_t k)
{
  const CeldStrokeLine *line = &s->graph.line[k];
  double                sum = 0;
  size_t                from = line->n / 4, to = line->n - from;

  for (size_t i = from; i < to; i++)
    sum += 2 * sqrt (s->mask.squared[celd_joined_pixel (s, line->at[i])]) - 1;
  return sum / (double) (to - from);
}

/* The widest place of the paint within `reach` pixels of a point; *radius: of the paint there. */
static CeldPoint
widest_place (const CeldJoinedLines *s, CeldPoint near, double reach, double *radius)
{
  CeldPoint widest = near;

  *radius = 0;
  for (double y = near.y - reach; y <= near.y + reach; y++)
    for (double x = near.x - reach; x <= near.x + reach; x++)
      {
        CeldPoint p = { x, y };
        double    r = celd_joined_inside (s, p) ? sqrt (s->mask.squared[celd_joined_pixel (s, p)]) - 0.5 : 0;

        if (r > *radius && celd_points_apart (p, near) <= reach)
          {
            *radius = r;
            widest  = p;
          }
      }
  return widest;
}

/* The paint that belongs to no line between two distances from a place. */
static double
rest_between (const PaintWindow *w, CeldPoint place, double from, double to)
{
  double rest = 0;

  for (int y = 0, i = 0; y < w->side; y++)
    for (int x = 0; x < w->side; x++, i++)
      if (w->own[i] && w->at[i] == SAMPLE_PAINT)
        {
          double d = celd_points_apart (sample_point (w, x, y), place);

          rest += d > from && d <= to ? w->area : 0;
        }
  return rest;
}

/* The costs of a dot, which is the same for all ends of a node.  It is where the paint is widest, or if other colours
 * hide that, where there is paint beside the line.  Else one that is hidden may be there or not. */
static void
find_dot (const CeldJoinedLines *s, CeldPoint meeting, PaintWindow *w, CeldNodeMarks *marks)
{
  double    width = 0, radius, seen, hidden, weight = DOT_COST;
  CeldPoint middle = widest_place (s, meeting, (marks->n == 1 ? DOT_FREE : DOT_HUB) * s->graph.width, &radius);

  for (int e = 0; e < marks->n; e++)
    width = fmax (width, line_width (s, marks->end[e] / 2) + DOT_SLACK);
  seen = fmin (1, fmax (0, (radius / width - NO_DOT) / (DOT_LEAST - NO_DOT)));
  if (seen < 0.5)
    middle = marks->tip[0];
  lead_lines (s, marks, middle, w);
  hidden = celd_joined_hidden_share (s, middle, seen < 0.5 ? DOT_HIDDEN * s->graph.width : radius);
  if (hidden > (seen < 0.5 ? 0 : MOST_HIDDEN))
    {
      if (rest_between (w, middle, 0, DOT_FREE * s->graph.width) >= LEAST_RING)
        {
          seen   = 1;
          radius = DOT_FREE * s->graph.width;
        }
      else
        weight = 0;
    }
  for (unsigned set = 0; set < 1u << marks->n; set++)
    {
      marks->cost[set] = weight * (set ? 1 - seen : seen) + rest_between (w, middle, radius + DOT_EDGE, INFINITY);
      marks->tip[set]  = middle;
    }
}

/* The costs of all choices, with their tips at the place that is best for them. */
static CeldStatus
find_places (const CeldJoinedLines *s, CeldPoint meeting, PaintWindow *w, CeldNodeMarks *marks)
{
  enum { SIDE = 2 * TIP_STEPS + 1, PLACES = SIDE * SIDE };
  size_t  sets = (size_t) 1 << marks->n;
  double *all = celd_alloc (PLACES * sets, sizeof *all), width = s->graph.width;

  if (!all)
    return CELD_NO_MEMORY;
  for (int k = 0; k < PLACES; k++)
    {
      double    x = TIP_STEP * (k % SIDE - TIP_STEPS), y = TIP_STEP * (k / SIDE - TIP_STEPS);
      CeldPoint tip = { meeting.x + x * width, meeting.y + y * width };

      costs_at (s, marks, tip, w, &all[(size_t) k * sets]);
      for (size_t set = 0; set < sets; set++)
        all[(size_t) k * sets + set] += TIP_OFF * (x * x + y * y);
    }
  for (size_t set = 0; set < sets; set++)
    {
      double n = 0, x = 0, y = 0;

      marks->cost[set] = INFINITY;
      for (size_t k = 0; k < PLACES; k++)
        marks->cost[set] = fmin (marks->cost[set], all[k * sets + set]);
      for (int k = 0; k < PLACES; k++)
        if (all[(size_t) k * sets + set] <= marks->cost[set] + AS_GOOD)
          {
            double dx = TIP_STEP * (k % SIDE - TIP_STEPS), dy = TIP_STEP * (k / SIDE - TIP_STEPS);

            n++;
            x += dx;
            y += dy;
          }
      marks->tip[set] = (CeldPoint) { meeting.x + x / n * width, meeting.y + y / n * width };
    }
  celd_free (all);
  return CELD_OK;
}

CeldStatus
celd_node_marks_find (const CeldJoinedLines *s, size_t node, const CeldPoint *meeting, CeldNodeMarks *marks)
{
  PaintWindow w = { .far = NULL };
  CeldStatus  status = window_new (s, node, meeting, &w);

  if (status == CELD_OK)
    status = find_places (s, meeting[node], &w, marks);
  if (status == CELD_OK && s->style == CELD_ARROW_DOT)
    find_dot (s, meeting[node], &w, marks);
  celd_free (w.far);
  return status;
}
