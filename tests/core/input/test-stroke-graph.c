/* Thinned paint and its long lines: known strokes give the lines that they were painted with.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "input/arrows.h"

#include <math.h>
#include <stdlib.h>

#define SIZE 200

typedef struct { uint8_t on[SIZE * SIZE]; } Canvas;

static void
paint_line (Canvas *c, CeldPoint a, CeldPoint b, double width)
{
  double dx = b.x - a.x, dy = b.y - a.y, l = dx * dx + dy * dy;

  for (int y = 0; y < SIZE; y++)
    for (int x = 0; x < SIZE; x++)
      {
        double px = x + 0.5 - a.x, py = y + 0.5 - a.y, t = fmax (0, fmin (1, (px * dx + py * dy) / l));

        if (hypot (px - t * dx, py - t * dy) <= width / 2)
          c->on[y * SIZE + x] = 1;
      }
}

static CeldPoint
at (double x, double y)
{
  return (CeldPoint) { x, y };
}

/* At an angle in degrees from the middle of the canvas. */
static CeldPoint
round_middle (double degrees, double r)
{
  return at (SIZE / 2. + r * cos (degrees * 0.0174532925), SIZE / 2. + r * sin (degrees * 0.0174532925));
}

static int
neighbours (const uint8_t *on, size_t p)
{
  bool a[8];
  int  n = 0;

  celd_thin_neighbours (on, SIZE, p, a);
  for (int i = 0; i < 8; i++)
    n += a[i];
  return n;
}

/* The ends of thinned paint, and the distance of the two that are farthest from each other. */
static int
ends_of (const Canvas *c, double *apart)
{
  CeldPoint end[SIZE];
  int       n = 0;

  *apart = 0;
  for (size_t p = 0; p < SIZE * SIZE; p++)
    if (c->on[p] && neighbours (c->on, p) == 1 && n < SIZE)
      end[n++] = at ((double) (p % SIZE), (double) (p / SIZE));
  for (int i = 0; i < n; i++)
    for (int k = 0; k < i; k++)
      *apart = fmax (*apart, hypot (end[i].x - end[k].x, end[i].y - end[k].y));
  return n;
}

/* A stroke at any angle becomes a line in its middle, hardly shorter than it is: also one of two pixels on a
 * diagonal. */
static void
strokes_become_lines (void)
{
  for (int degrees = 0; degrees < 180; degrees += 5)
    for (int width = 1; width <= 9; width++)
      {
        Canvas c = { { 0 } }, thin;
        double apart, sine = sin (degrees * 0.0174532925), cosine = cos (degrees * 0.0174532925);

        paint_line (&c, round_middle (degrees, 60), round_middle (degrees + 180, 60), width);
        thin = c;
        CHECK (celd_thin (thin.on, SIZE, SIZE) == CELD_OK);
        ends_of (&thin, &apart);
        CHECK (apart >= 119 - width && apart <= 122 + width);
        for (size_t p = 0; p < SIZE * SIZE; p++)
          if (thin.on[p])
            CHECK (c.on[p] && fabs (((double) (p % SIZE) - SIZE / 2.) * sine -
                                    ((double) (p / SIZE) - SIZE / 2.) * cosine) < 2.5 + width / 4.);
      }
}

/* A ring stays closed. */
static void
rings_stay (void)
{
  for (int width = 3; width <= 9; width += 2)
    {
      Canvas c = { { 0 } };
      double apart;
      int    n = 0;

      for (int k = 0; k < 90; k++)
        paint_line (&c, round_middle (4 * k, 50), round_middle (4 * k + 4, 50), width);
      CHECK (celd_thin (c.on, SIZE, SIZE) == CELD_OK);
      CHECK (ends_of (&c, &apart) == 0);
      for (size_t p = 0; p < SIZE * SIZE; p++)
        n += c.on[p];
      CHECK (n > 2 * 50 * 4 * 0.7 && n < 2 * 3.1416 * 50 * 1.2);
    }
}

/* The lines of a canvas; ends with celd_stroke_graph_clear. */
static CeldStrokeGraph
graph_of (const Canvas *c)
{
  uint32_t       *pixel = malloc (SIZE * SIZE * sizeof *pixel);
  CeldArrowStroke stroke = { .width = SIZE, .height = SIZE, .pixel = pixel };
  CeldStrokeMask  mask;
  CeldStrokeGraph graph = { 0 };

  for (size_t p = 0; p < SIZE * SIZE; p++)
    if (c->on[p])
      pixel[stroke.n++] = (uint32_t) ((p / SIZE + 1) * (SIZE + 2) + p % SIZE + 1);
  CHECK (celd_stroke_mask_new (&stroke, &mask) == CELD_OK);
  CHECK (celd_stroke_graph_new (&mask, true, &graph) == CELD_OK);
  for (size_t k = 0; k < graph.n_lines; k++)
    for (size_t i = 0; i < graph.line[k].n; i++)
      graph.line[k].at[i] = at (graph.line[k].at[i].x + mask.left, graph.line[k].at[i].y + mask.top);
  for (size_t k = 0; k < graph.n_nodes; k++)
    graph.node[k].at = at (graph.node[k].at.x + mask.left, graph.node[k].at.y + mask.top);
  celd_stroke_mask_clear (&mask);
  free (pixel);
  return graph;
}

static int
ends_at (const CeldStrokeGraph *g, int node)
{
  int n = 0;

  for (size_t k = 0; k < 2 * g->n_lines; k++)
    n += g->line[k / 2].node[k % 2] == node;
  return n;
}

static void
stars_have_one_node (void)
{
  for (int arms = 3; arms <= 5; arms++)
    for (int turn = 0; turn < 90; turn += 15)
      {
        Canvas          c = { { 0 } };
        CeldStrokeGraph g;
        int             hubs = 0;

        for (int k = 0; k < arms; k++)
          paint_line (&c, round_middle (0, 0), round_middle (turn + k * 360. / arms, 80), 5);
        g = graph_of (&c);
        CHECK (g.n_lines == (size_t) arms && fabs (g.width - 5) < 1);
        for (size_t node = 0; node < g.n_nodes; node++)
          if (ends_at (&g, (int) node) == arms)
            {
              hubs++;
              CHECK (hypot (g.node[node].at.x - SIZE / 2., g.node[node].at.y - SIZE / 2.) < 4);
            }
        CHECK (hubs == 1);
        for (size_t k = 0; k < g.n_lines; k++)
          CHECK (fabs (celd_stroke_line_length (&g.line[k]) - 80) < 12);
        celd_stroke_graph_clear (&g);
      }
}

static void
triangles_have_three (void)
{
  for (int turn = 0; turn < 120; turn += 20)
    {
      Canvas          c = { { 0 } };
      CeldStrokeGraph g;
      int             met = 0;

      for (int k = 0; k < 3; k++)
        {
          paint_line (&c, round_middle (turn + k * 120, 60), round_middle (turn + k * 120 + 120, 60), 4);
          paint_line (&c, round_middle (turn + k * 120, 60), round_middle (turn + k * 120, 95), 4);
        }
      g = graph_of (&c);
      CHECK (g.n_lines == 6);
      for (size_t node = 0; node < g.n_nodes; node++)
        met += ends_at (&g, (int) node) == 3;
      CHECK (met == 3);
      celd_stroke_graph_clear (&g);
    }
}

/* The barbs of a head are no lines; a corner is a node, where the sides meet. */
static void
heads_and_corners (void)
{
  for (int turn = 0; turn < 360; turn += 15)
    {
      Canvas          arrow = { { 0 } }, angle = { { 0 } };
      CeldPoint       tip = round_middle (turn, 80), corner;
      CeldStrokeGraph g;

      paint_line (&arrow, round_middle (turn + 180, 80), tip, 5);
      paint_line (&arrow, tip, round_middle (turn + 13, 68), 5);
      paint_line (&arrow, tip, round_middle (turn - 13, 68), 5);
      g = graph_of (&arrow);
      CHECK (g.n_lines == 1 && !celd_stroke_line_corner (&g, 0, &corner));
      celd_stroke_graph_clear (&g);
      paint_line (&angle, round_middle (turn, 80), round_middle (0, 0), 5);
      paint_line (&angle, round_middle (turn + 100, 80), round_middle (0, 0), 5);
      g = graph_of (&angle);
      CHECK (g.n_lines == 2);
      if (g.n_lines == 2)
        {
          const int *a = g.line[0].node, *b = g.line[1].node;
          int        shared = a[0] == b[0] || a[0] == b[1] ? a[0] : a[1];

          CHECK (shared == b[0] || shared == b[1]);
          CHECK (hypot (g.node[shared].at.x - SIZE / 2., g.node[shared].at.y - SIZE / 2.) < 4);
        }
      celd_stroke_graph_clear (&g);
    }
}

/* Also where rough edges and merged nodes were left out of them. */
static void
lines_have_no_gaps (void)
{
  uint32_t state = 11;

  for (int i = 0; i < 60; i++)
    {
      Canvas          c = { { 0 } };
      CeldStrokeGraph g;
      int             turn = (int) check_random (&state, 360), w = 4 + (int) check_random (&state, 3);

      paint_line (&c, round_middle (turn, 85), round_middle (turn + 180, 85), w);
      for (int k = -2; k <= 2; k++) /* short spurs, on both sides, some widths apart */
        {
          CeldPoint from = round_middle (turn, (2 + 0.2 * check_random (&state, 10)) * w * k);
          double    angle = (turn + (k % 2 ? 90 : 270)) * 0.0174532925, r = w * (1.2 + 0.1 * check_random (&state, 12));

          paint_line (&c, from, at (from.x + r * cos (angle), from.y + r * sin (angle)), w - 2);
        }
      g = graph_of (&c);
      for (size_t k = 0; k < g.n_lines; k++)
        for (size_t p = 1; p < g.line[k].n; p++)
          CHECK (hypot (g.line[k].at[p].x - g.line[k].at[p - 1].x, g.line[k].at[p].y - g.line[k].at[p - 1].y) <= 1.51);
      celd_stroke_graph_clear (&g);
    }
}

/* Thousands of lines are a drawing or noise: none is followed. */
static void
too_many (void)
{
  Canvas          c = { { 0 } };
  CeldStrokeGraph g;

  for (int y = 1; y < SIZE - 1; y++)
    for (int x = 1; x < SIZE - 1; x++)
      c.on[y * SIZE + x] = y % 4 == 1 || x % 4 == 1;
  g = graph_of (&c);
  CHECK (g.n_lines == 0);
  celd_stroke_graph_clear (&g);
}

static void
nothing_long (void)
{
  Canvas          dot = { { 0 } };
  CeldStrokeGraph g;

  paint_line (&dot, at (50, 50), at (50.1, 50), 3);
  g = graph_of (&dot);
  CHECK (g.n_lines == 0);
  celd_stroke_graph_clear (&g);
}

int
main (void)
{
  RUN (strokes_become_lines);
  RUN (rings_stay);
  RUN (stars_have_one_node);
  RUN (triangles_have_three);
  RUN (heads_and_corners);
  RUN (lines_have_no_gaps);
  RUN (too_many);
  RUN (nothing_long);
  return DONE;
}
