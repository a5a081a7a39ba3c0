/* Samples of the paint round a node, from which heads and dots are found.
 *
 * The lines of the node explain what lies on the straight way from them to its place.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/joined-arrows.h"

#include <math.h>
#include <string.h>

#define WIDTH_SAMPLES 8   /* in a width of the paint, at most one a pixel; chosen */
#define LEAD_HALF     0.3 /* widths on either side of a line's last part, which should be painted; chosen */

CeldPoint
celd_window_point (const CeldPaintWindow *w, int x, int y)
{
  return (CeldPoint) { w->corner.x + (x + 0.5) * w->step, w->corner.y + (y + 0.5) * w->step };
}

int
celd_window_at (const CeldPaintWindow *w, CeldPoint p)
{
  int x = (int) floor ((p.x - w->corner.x) / w->step), y = (int) floor ((p.y - w->corner.y) / w->step);

  return x >= 0 && y >= 0 && x < w->side && y < w->side ? w->at[y * w->side + x] : CELD_SAMPLE_UNKNOWN;
}

static bool
is_nearest_node (const CeldJoinedLines *s, size_t node, const CeldPoint *meeting, CeldPoint p)
{
  for (size_t k = 0; k < s->graph.n_nodes; k++)
    if (k != node && !isnan (meeting[k].x) && celd_points_apart (meeting[k], p) < celd_points_apart (meeting[node], p))
      return false;
  return true;
}

CeldStatus
celd_window_new (const CeldJoinedLines *s, size_t node, const CeldPoint *meeting, CeldPaintWindow *w)
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
        CeldPoint p = celd_window_point (w, x, y);

        w->far[i] = (int8_t) celd_joined_paint_at (s, p);
        w->own[i] = w->far[i] > 0 && celd_points_apart (p, meeting[node]) <= CELD_NODE_REACH * width &&
                    is_nearest_node (s, node, meeting, p);
      }
  return CELD_OK;
}

double
celd_distance_to_part (CeldPoint p, CeldPoint a, CeldPoint b)
{
  double dx = b.x - a.x, dy = b.y - a.y, length = fmax (1e-9, dx * dx + dy * dy);
  double t = fmin (1, fmax (0, ((p.x - a.x) * dx + (p.y - a.y) * dy) / length));

  return hypot (p.x - a.x - t * dx, p.y - a.y - t * dy);
}

double
celd_window_lead (const CeldJoinedLines *s, const CeldNodeMarks *node, CeldPoint tip, CeldPaintWindow *w)
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
            double d = celd_distance_to_part (celd_window_point (w, x, y), from, tip);
            int8_t *at = &w->at[y * w->side + x];

            if (d > reach)
              continue;
            missed += *at == CELD_SAMPLE_BARE && d <= LEAD_HALF * width ? w->area : 0;
            *at = CELD_SAMPLE_UNKNOWN;
          }
    }
  return missed;
}

double
celd_window_rest (const CeldPaintWindow *w, CeldPoint place, double from, double to)
{
  double rest = 0;

  for (int y = 0, i = 0; y < w->side; y++)
    for (int x = 0; x < w->side; x++, i++)
      if (w->own[i] && w->at[i] == CELD_SAMPLE_PAINT)
        {
          double d = celd_points_apart (celd_window_point (w, x, y), place);

          rest += d > from && d <= to ? w->area : 0;
        }
  return rest;
}
