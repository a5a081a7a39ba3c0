/* Which ends of lines that meet at a node have heads or dots there: the cost of every choice.
 *
 * A head is two barbs that leave a tip at some angle to the line, or the two halves of a filled triangle; dot-fits.c
 * finds dots.  At places round the node each end gets the head that agrees best with the paint that belongs to no line.  A
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
#define TIP_STEP     0.5  /* between places for the tip, ... */
#define TIP_STEPS    4    /* ... on either side of where the lines meet, ... */
#define TIP_OFF      0.05 /* ... and what the square of that distance costs */
#define PAIR_TURN    0.6  /* radians by which two lines turn that go about straight on, ... */
#define LONGER_STEP  2    /* ... and how many times as far the places along them are */
#define AS_GOOD      0.15 /* of the cost: places of which the middle is taken */
#define LEAST_SPLAY  0.3  /* radians between the line and a barb, ... */
#define MOST_SPLAY   1.05
#define SPLAY_STEP   0.1
#define BARB_FROM    0.5  /* from the tip to where a barb begins, ... */
#define LEAST_BARB   2    /* ... to where it ends at least; at most at CELD_HEAD_REACH */
#define BARB_HALF    0.4  /* of its width is looked at on either side, ... */
#define BARB_BODY    0.65 /* ... and so much, and a pixel more, is explained */
#define LEAST_HEAD   1.5  /* square widths of paint beside its line that a head has at least */

/* A half of a head: what lies from its tip along a barb, up to a length. */
typedef struct { CeldPoint along; double angle, length, gain, missed, seen; } Barb;

typedef struct { Barb barb[2]; bool filled; double gain, missed, seen; } Head;

/* ------------------------------------------------------------------ heads */

static CeldPoint
turned (CeldPoint d, double angle)
{
  return (CeldPoint) { d.x * cos (angle) - d.y * sin (angle), d.x * sin (angle) + d.y * cos (angle) };
}

/* The best length of a barb at an angle to `way`, on the side with that sign.  Of a filled head it reaches to the
 * line. */
static Barb
fit_length (const CeldJoinedLines *s, const CeldPaintWindow *w, CeldPoint tip, CeldPoint way, double angle, bool filled)
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
          int at = celd_window_at (w, celd_moved (p, across, o));

          gain   += at == CELD_SAMPLE_PAINT ? w->area : at == CELD_SAMPLE_BARE ? -w->area : 0;
          missed += at == CELD_SAMPLE_BARE ? w->area : 0;
          if (at == CELD_SAMPLE_PAINT || (at == CELD_SAMPLE_UNKNOWN && fabs (r * sin (angle)) - fabs (o) > body))
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
fit_head (const CeldJoinedLines *s, const CeldPaintWindow *w, CeldPoint tip, CeldPoint way)
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

      if (celd_distance_to_part (p, tip, end) <= body)
        return true;
      if (head->filled && forwards >= 0 && forwards <= b->length * cos (b->angle) + body && aside * b->angle >= 0 &&
          fabs (aside) <= forwards * tan (fabs (b->angle)))
        return true;
    }
  return false;
}

/* ------------------------------------------------------------------ choices at a node */

/* Replaces the value of each set of n ends by the sum over its subsets. */
static void
sum_subsets (double *value, int n)
{
  for (int e = 0; e < n; e++)
    for (unsigned set = 0; set < 1u << n; set++)
      value[set] += set >> e & 1 ? value[set ^ 1u << e] : 0;
}

/* The costs of all choices with their tips at one place.  rest: of each set of ends, the paint that the heads of these
 * explain, and no others. */
static void
costs_at (const CeldJoinedLines *s, const CeldNodeMarks *node, CeldPoint tip, CeldPaintWindow *w, double *cost)
{
  double    lead = celd_window_lead (s, node, tip, w), rest[1 << CELD_MOST_MARKS] = { 0 };
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
      if (w->own[i] && w->at[i] == CELD_SAMPLE_PAINT)
        {
          CeldPoint p = celd_window_point (w, x, y);
          unsigned  by = 0;

          for (int e = 0; e < n; e++)
            by |= head_explains (s, &head[e], tip, way[e], p) ? 1u << e : 0;
          rest[by] += w->area;
        }
  sum_subsets (rest, node->n);
  for (unsigned set = 0; set < 1u << node->n; set++)
    {
      cost[set] = lead + rest[((1u << node->n) - 1) & ~set];
      for (int e = 0; e < n; e++)
        cost[set] += set >> e & 1 ? head[e].missed + fmax (0, LEAST_HEAD - head[e].seen) : 0;
    }
}

/* The steps between places for the tip: those along two lines that go straight on are longer, because where these meet
 * says little. */
static void
find_steps (const CeldJoinedLines *s, const CeldNodeMarks *marks, CeldPoint step[2])
{
  double    length = TIP_STEP * s->graph.width;
  CeldPoint along = { 1, 0 };

  if (marks->n == 2 && s->style == CELD_ARROW_HEAD &&
      celd_joined_turn (s, marks->end[0], marks->end[1]) < PAIR_TURN)
    {
      along   = celd_joined_way (s, marks->end[0]);
      step[0] = (CeldPoint) { LONGER_STEP * length * along.x, LONGER_STEP * length * along.y };
    }
  else
    step[0] = (CeldPoint) { length, 0 };
  step[1] = (CeldPoint) { -length * along.y, length * along.x };
}

/* The costs of all choices, with their tips at the place that is best for them. */
static CeldStatus
find_places (const CeldJoinedLines *s, CeldPoint meeting, CeldPaintWindow *w, CeldNodeMarks *marks)
{
  enum { SIDE = 2 * TIP_STEPS + 1, PLACES = SIDE * SIDE };
  size_t  sets = (size_t) 1 << marks->n;
  double *all = celd_alloc (PLACES * sets, sizeof *all);
  CeldPoint step[2];

  if (!all)
    return CELD_NO_MEMORY;
  find_steps (s, marks, step);
  for (int k = 0; k < PLACES; k++)
    {
      double    x = k % SIDE - TIP_STEPS, y = k / SIDE - TIP_STEPS;
      CeldPoint tip = celd_moved (celd_moved (meeting, step[0], x), step[1], y);

      costs_at (s, marks, tip, w, &all[(size_t) k * sets]);
      for (size_t set = 0; set < sets; set++)
        all[(size_t) k * sets + set] += TIP_OFF * TIP_STEP * TIP_STEP * (x * x + y * y);
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
            n++;
            x += k % SIDE - TIP_STEPS;
            y += k / SIDE - TIP_STEPS;
          }
      n *= marks->n > 2 ? 2 : 1; /* where many meet, their lines tell as much as heads that lie on each other */
      marks->tip[set] = celd_moved (celd_moved (meeting, step[0], x / n), step[1], y / n);
    }
  celd_free (all);
  return CELD_OK;
}

CeldStatus
celd_node_marks_find (const CeldJoinedLines *s, size_t node, const CeldPoint *meeting, CeldNodeMarks *marks)
{
  CeldPaintWindow w = { .far = NULL };
  CeldStatus  status = celd_window_new (s, node, meeting, &w);

  if (status == CELD_OK)
    status = find_places (s, meeting[node], &w, marks);
  if (status == CELD_OK && s->style == CELD_ARROW_DOT)
    status = celd_dot_find (s, meeting[node], &w, marks);
  celd_free (w.far);
  return status;
}
