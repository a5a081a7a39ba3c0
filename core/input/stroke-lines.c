/* Lines of paint: their points, length and corner, and the point where several of them meet.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/arrows.h"

#include <math.h>

/* All chosen; lengths are widths of the paint. */
#define TURN        0.5  /* radians of a corner, ... */
#define CORNER_TURN 0.35 /* ... or of one that is sharp: ... */
#define SHARP       0.75 /* ... of that turn half as far round it */
#define TURN_REACH  4    /* ... between the directions this far before and behind it, ... */
#define TURN_MARGIN 6    /* ... this far from the ends of the line, which may belong to heads */
#define CORNER_OFF  1.5  /* between a corner of the thinned paint and where its lines meet */
#define PRIOR       0.05 /* weight of a given point beside those of lines that should meet */
#define MOST_STEP   1.5  /* pixels between points of a line that follow each other: more than a diagonal */

CeldStatus
celd_stroke_line_append (CeldStrokeLine *line, CeldPoint p)
{
  CeldPoint  last = line->n ? line->at[line->n - 1] : p;
  int        n = line->n ? (int) ceil (hypot (p.x - last.x, p.y - last.y) / MOST_STEP) : 1;
  CeldStatus status = CELD_OK;

  for (int i = 1; i <= n && status == CELD_OK; i++)
    {
      CeldPoint between = { last.x + (p.x - last.x) * i / n, last.y + (p.y - last.y) * i / n };

      status = celd_append (line->at, line->n, line->capacity, between);
    }
  return status;
}

double
celd_stroke_line_length (const CeldStrokeLine *line)
{
  double length = 0;

  for (size_t i = 1; i < line->n; i++)
    length += hypot (line->at[i].x - line->at[i - 1].x, line->at[i].y - line->at[i - 1].y);
  return length;
}

void
celd_line_sums_add (CeldLineSums *sums, CeldPoint p, CeldPoint way, double weight)
{
  double off = p.x * -way.y + p.y * way.x; /* of the line from the origin */

  sums->xx += weight * way.y * way.y;
  sums->xy -= weight * way.x * way.y;
  sums->yy += weight * way.x * way.x;
  sums->x  -= weight * off * way.y;
  sums->y  += weight * off * way.x;
}

CeldPoint
celd_line_sums_point (const CeldLineSums *sums, CeldPoint prior)
{
  double xx = sums->xx + PRIOR, yy = sums->yy + PRIOR, x = sums->x + PRIOR * prior.x, y = sums->y + PRIOR * prior.y;
  double det = xx * yy - sums->xy * sums->xy;

  return (CeldPoint) { (yy * x - sums->xy * y) / det, (xx * y - sums->xy * x) / det };
}

size_t
celd_stroke_line_nearest (const CeldStrokeLine *line, CeldPoint place)
{
  size_t at = 0;

  for (size_t i = 1; i < line->n; i++)
    if (celd_points_apart (line->at[i], place) < celd_points_apart (line->at[at], place))
      at = i;
  return at;
}

/* The angle by which a line turns at its point i; 0 near its ends. */
static double
turn_at (const CeldStrokeLine *line, size_t i, size_t reach)
{
  CeldPoint a, b, c;

  if (i < reach || i + reach >= line->n)
    return 0;
  a = line->at[i - reach];
  b = line->at[i];
  c = line->at[i + reach];
  return fabs (atan2 ((b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x),
                      (b.x - a.x) * (c.x - b.x) + (b.y - a.y) * (c.y - b.y)));
}

/* The same if it is large enough for a corner, else 0: bent arrows turn, too, but not as sharply. */
static double
corner_at (const CeldStrokeLine *line, size_t i, size_t reach)
{
  double turn = turn_at (line, i, reach);

  return turn > TURN || (turn > CORNER_TURN && turn_at (line, i, reach / 2) > SHARP * turn) ? turn : 0;
}

/* Adds the direction of a line between two of its points. */
static void
add_part (CeldLineSums *sums, const CeldStrokeLine *line, size_t from, size_t to)
{
  CeldPoint a = line->at[from], b = line->at[to];
  double    length = hypot (b.x - a.x, b.y - a.y);

  if (length > 0)
    celd_line_sums_add (sums, a, (CeldPoint) { (b.x - a.x) / length, (b.y - a.y) / length }, 1);
}

bool
celd_stroke_line_corner (const CeldStrokeGraph *g, size_t k, CeldPoint *place)
{
  const CeldStrokeLine *line = &g->line[k];
  size_t                reach = (size_t) (TURN_REACH * g->width + 3), best = 0;
  size_t                margin = (size_t) (TURN_MARGIN * g->width);
  double                most = 0;
  CeldLineSums          sums = { 0 };

  for (size_t i = margin; i + margin < line->n; i++)
    {
      double turn = corner_at (line, i, reach);

      if (turn > most)
        {
          most = turn;
          best = i;
        }
    }
  if (!best)
    return false;
  add_part (&sums, line, best - reach, best - reach / 4);
  add_part (&sums, line, best + reach / 4, best + reach);
  *place = celd_line_sums_point (&sums, line->at[best]);
  return hypot (place->x - line->at[best].x, place->y - line->at[best].y) < CORNER_OFF * g->width;
}
