/* The ink at the end of a white border: does a line end there, where exactly, and where would it go on?
 *
 * The ink that is connected to the pixel where the border lands is gathered by distance.  Its principal axis gives a
 * frame; the middle of a line is fitted in it as a parabola through all pixels.  It is a line end if the ink is longer
 * than wide, as even in width as a line is, and if the border lands near one end of it: on the side of a line ink goes
 * on both ways.  Where four stroke widths are too much, as in a hook or near a fork, two may do.
 *
 * Cost: the pixels of ink within the reach.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "closures.h"

#include <math.h>
#include <string.h>

#define REACH         4         /* stroke widths */
#define LEAST_REACH   8         /* pixels; shorter ends say nothing about directions */
#define MOST_REACH    96
#define LEAST_LENGTH  1.5       /* of a line end, in its own widths */
#define DETOUR        2.0       /* a line goes on to another's side if that is at most so many times the shortest way */
#define MOST_UNEVEN   0.4       /* widths; across a straight line pixels deviate by 1 / sqrt 12 */

CeldStatus
celd_line_end_new (int stroke, CeldLineEnd *end)
{
  int    reach = REACH * stroke;
  size_t n;

  reach = reach < LEAST_REACH ? LEAST_REACH : reach > MOST_REACH ? MOST_REACH : reach;
  n     = (size_t) (2 * reach + 1) * (size_t) (2 * reach + 1);
  *end  = (CeldLineEnd) { .reach = reach, .mine = celd_alloc0 (n, 1), .pixel = celd_alloc (n, sizeof *end->pixel) };
  if (end->mine && end->pixel)
    return CELD_OK;
  celd_line_end_clear (end);
  return CELD_NO_MEMORY;
}

void
celd_line_end_clear (CeldLineEnd *end)
{
  celd_free (end->mine);
  celd_free (end->pixel);
  *end = (CeldLineEnd) { 0 };
}

/* ------------------------------------------------------------------ connected ink */

/* The pixel's place in the square; NULL outside. */
static uint8_t *
place_of (const CeldLineEnd *end, int x, int y)
{
  int u = x - end->middle.x + end->reach, v = y - end->middle.y + end->reach, side = 2 * end->reach + 1;

  return u < 0 || v < 0 || u >= side || v >= side ? NULL : &end->mine[v * side + u];
}

bool
celd_line_end_has (const CeldLineEnd *end, int x, int y)
{
  const uint8_t *place = place_of (end, x, y);

  return place && *place;
}

static void
forget (CeldLineEnd *end)
{
  for (size_t i = 0; i < end->n; i++)
    *place_of (end, end->pixel[i].x, end->pixel[i].y) = 0;
  end->n = 0;
}

static void
take (const CeldPlane *ink, int x, int y, CeldLineEnd *end)
{
  uint8_t *place = place_of (end, x, y);

  if (!place || *place || x < 0 || y < 0 || x >= ink->width || y >= ink->height || celd_is_paper (CELD_AT (ink, x, y)))
    return;
  *place = 1;
  end->pixel[end->n++] = (CeldCorner) { x, y };
}

/* Steps to 4 and to 8 neighbours in turn: distances grow nearly alike in all directions.  Returns how many of the
 * pixels are within half the reach. */
static size_t
gather (const CeldPlane *ink, CeldCorner pixel, CeldLineEnd *end)
{
  size_t near = 0, from = 0;

  forget (end);
  end->middle = pixel;
  take (ink, pixel.x, pixel.y, end);
  for (int distance = 1; distance <= end->reach; distance++)
    {
      size_t to = end->n;

      for (; from < to; from++)
        {
          CeldCorner p = end->pixel[from];

          for (int dy = -1; dy <= 1; dy++)
            for (int dx = -1; dx <= 1; dx++)
              if (!(distance & 1) || !dx || !dy)
                take (ink, p.x + dx, p.y + dy, end);
        }
      if (2 * distance <= end->reach)
        near = end->n;
    }
  return near;
}

/* ------------------------------------------------------------------ the line that ends */

/* A line along u: its middle is at v = a + b u + c u^2. */
typedef struct { double x, y, along_x, along_y, a, b, c, least, most, width, uneven; } Line;

static double
along (const Line *line, double x, double y)
{
  return (x - line->x) * line->along_x + (y - line->y) * line->along_y;
}

static double
across (const Line *line, double x, double y)
{
  return (y - line->y) * line->along_x - (x - line->x) * line->along_y;
}

static double
middle (const Line *line, double u)
{
  return line->a + (line->b + line->c * u) * u;
}

/* Centre and principal axis of the first n pixels, towards the landing. */
static void
find_axis (const CeldLineEnd *end, size_t n, Line *line)
{
  double xx = 0, xy = 0, yy = 0, angle;

  for (size_t i = 0; i < n; i++)
    {
      line->x += end->pixel[i].x + 0.5;
      line->y += end->pixel[i].y + 0.5;
    }
  line->x /= (double) n;
  line->y /= (double) n;
  for (size_t i = 0; i < n; i++)
    {
      double dx = end->pixel[i].x + 0.5 - line->x, dy = end->pixel[i].y + 0.5 - line->y;

      xx += dx * dx;
      xy += dx * dy;
      yy += dy * dy;
    }
  angle = 0.5 * atan2 (2 * xy, xx - yy);
  line->along_x = cos (angle);
  line->along_y = sin (angle);
  if (along (line, end->middle.x + 0.5, end->middle.y + 0.5) >= 0)
    return;
  line->along_x = -line->along_x;
  line->along_y = -line->along_y;
}

/* Least squares in the frame of the principal axis, where sums of u, v and u v vanish. */
static void
fit_middle (const CeldLineEnd *end, size_t n, Line *line)
{
  double count = (double) n, u2 = 0, u3 = 0, u4 = 0, u2v = 0, square = 0, divisor;

  line->least = line->most = 0;
  for (size_t i = 0; i < n; i++)
    {
      double x = end->pixel[i].x + 0.5, y = end->pixel[i].y + 0.5;
      double u = along (line, x, y), v = across (line, x, y);

      line->least = u < line->least ? u : line->least;
      line->most  = u > line->most ? u : line->most;
      u2  += u * u;
      u3  += u * u * u;
      u4  += u * u * u * u;
      u2v += u * u * v;
    }
  divisor = u2 > 0 ? u4 - u2 * u2 / count - u3 * u3 / u2 : 0;
  line->c = divisor > 0 ? u2v / divisor : 0;
  line->b = u2 > 0 ? -line->c * u3 / u2 : 0;
  line->a = -line->c * u2 / count;
  line->width = count / (line->most - line->least + 1);
  for (size_t i = 0; i < n; i++)
    {
      double x = end->pixel[i].x + 0.5, y = end->pixel[i].y + 0.5, u = along (line, x, y);
      double off = across (line, x, y) - middle (line, u);

      square += off * off;
    }
  line->uneven = sqrt (square / count);
}

static bool
is_line_end (const CeldLineEnd *end, const Line *line)
{
  double landing = along (line, end->middle.x + 0.5, end->middle.y + 0.5);

  return line->most - line->least + 1 >= LEAST_LENGTH * line->width && line->most - landing <= line->width + 1.5 &&
         line->uneven <= MOST_UNEVEN * line->width + 0.3;
}

static CeldPlace
place_on (const Line *line, double u)
{
  double v = middle (line, u);

  return (CeldPlace) { line->x + u * line->along_x - v * line->along_y,
                       line->y + u * line->along_y + v * line->along_x };
}

/* Where the middle of the line comes out of the ink. */
static void
find_tip (size_t n, const Line *line, CeldLineEnd *end)
{
  double tip = line->least, slope, length;

  for (size_t i = 0; i < n; i++)
    {
      double x = end->pixel[i].x + 0.5, y = end->pixel[i].y + 0.5, u = along (line, x, y);

      if (u > tip && fabs (across (line, x, y) - middle (line, u)) <= line->width / 4 + 0.5)
        tip = u;
    }
  tip   += 0.5;
  slope  = line->b + 2 * line->c * tip;
  length = sqrt (1 + slope * slope);
  end->width  = line->width;
  end->at     = place_on (line, tip);
  end->inside = place_on (line, tip - (line->width > 2 ? line->width / 2 : 1));
  end->dx     = (line->along_x - slope * line->along_y) / length;
  end->dy     = (line->along_y + slope * line->along_x) / length;
}

void
celd_line_end_look (const CeldPlane *ink, CeldCorner pixel, CeldLineEnd *end)
{
  size_t near = gather (ink, pixel, end), size[2] = { end->n, near };

  end->tip    = false;
  end->width  = 0;
  end->at     = end->inside = (CeldPlace) { pixel.x + 0.5, pixel.y + 0.5 };
  end->dx     = end->dy = 0;
  for (int i = 0; i < 2 && !end->tip; i++)
    {
      Line line = { 0 };

      find_axis (end, size[i], &line);
      fit_middle (end, size[i], &line);
      end->tip = is_line_end (end, &line);
      if (end->tip)
        find_tip (size[i], &line, end);
    }
}

void
celd_line_end_none (CeldCorner corner, CeldLineEnd *end)
{
  forget (end);
  end->tip   = false;
  end->width = 0;
  end->at    = end->inside = (CeldPlace) { corner.x, corner.y };
}

/* ------------------------------------------------------------------ the side of a line */

/* Puts the end on the edge of an ink pixel. */
static void
put_on (CeldPlace pixel, CeldPlace from, CeldLineEnd *end)
{
  double dx = from.x - pixel.x, dy = from.y - pixel.y, length = fmax (sqrt (dx * dx + dy * dy), 0.5);

  end->inside = pixel;
  end->at     = (CeldPlace) { pixel.x + 0.5 * dx / length, pixel.y + 0.5 * dy / length };
}

void
celd_line_end_face (const CeldLineEnd *from, CeldLineEnd *end)
{
  CeldPlace place = from->at, nearest = end->inside;
  double    least = INFINITY;

  for (size_t i = 0; i < end->n; i++)
    {
      CeldPlace pixel = { end->pixel[i].x + 0.5, end->pixel[i].y + 0.5 };
      double    dx = pixel.x - place.x, dy = pixel.y - place.y;

      if (dx * dx + dy * dy >= least)
        continue;
      least   = dx * dx + dy * dy;
      nearest = pixel;
    }
  for (double t = 0; from->tip && t <= DETOUR * sqrt (least); t += 0.5)
    {
      CeldPlace pixel = { floor (place.x + t * from->dx) + 0.5, floor (place.y + t * from->dy) + 0.5 };

      if (!celd_line_end_has (end, (int) pixel.x, (int) pixel.y))
        continue;
      nearest = pixel;
      break;
    }
  put_on (nearest, place, end);
}
