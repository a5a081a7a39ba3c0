/* Fits the line that ends where a boundary meets ink: does a line end there, where exactly, and in which direction
 * would it go on?
 *
 * The ink connected to the pixel that the boundary meets is gathered by distance.  Its principal axis is the coordinate
 * system in which the middle of the line is fitted as a parabola through all pixels.  It is a line end if the ink is
 * longer than wide, as even in width as a line is, and if the boundary meets it near one end: along the side of a line,
 * ink continues both ways.  Where four stroke widths are too far, as in a hook or near a fork, two may do.
 *
 * Of thick strokes only every second, third ... pixel both ways is sampled.
 *
 * Cost: some hundred pixels of ink.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "segment/closures.h"

#include <math.h>
#include <string.h>

#define FIT_RADIUS        4    /* stroke widths (chosen, as all of these) */
#define LEAST_FIT_RADIUS  16   /* pixels: shorter ends have no reliable direction */
#define FINE_STROKE       7    /* pixels across a stroke are enough */
#define LEAST_LENGTH      1.5  /* line widths: length of a line end, at least */
#define SHORTEST_LINE_END 6    /* pixels: dots and specks have no direction */
#define MOST_UNEVEN       0.33 /* widths: standard deviation from the middle; across a straight line it is 1 / sqrt
                                * 12 */
#define MOST_ASLANT       1.5  /* line widths between a tip and where the boundary meets the ink */
#define LAG               0.25 /* of the length: the direction is taken so far behind the end, where a parabola is
                                * more certain */
#define CUT_OFF           0.15 /* of the length: left out at the far side, which the radius cuts off aslant */

CeldStatus
celd_line_end_new (int stroke, CeldLineEnd *end)
{
  int    step = stroke / FINE_STROKE > 1 ? stroke / FINE_STROKE : 1, radius = FIT_RADIUS * stroke / step;
  size_t n;

  radius = radius < LEAST_FIT_RADIUS ? LEAST_FIT_RADIUS : radius;
  n     = (size_t) (2 * radius + 1) * (size_t) (2 * radius + 1);
  *end  = (CeldLineEnd) {
    .step  = step,
    .radius = radius,
    .member  = celd_alloc0 (n, 1),
    .pixel = celd_alloc (n, sizeof *end->pixel),
    .from  = celd_alloc (n, sizeof *end->from),
  };
  if (end->member && end->pixel && end->from)
    return CELD_OK;
  celd_line_end_clear (end);
  return CELD_NO_MEMORY;
}

void
celd_line_end_clear (CeldLineEnd *end)
{
  celd_free (end->member);
  celd_free (end->pixel);
  celd_free (end->from);
  *end = (CeldLineEnd) { 0 };
}

/* ------------------------------------------------------------------ connected ink */

/* The number of sampling steps from the middle pixel, rounded. */
static int
sampling_steps (const CeldLineEnd *end, int pixel)
{
  int from = pixel + end->step / 2;

  return from < 0 ? -((end->step - 1 - from) / end->step) : from / end->step;
}

/* The entry of (u,v) in the square; NULL outside. */
static uint8_t *
place_of (const CeldLineEnd *end, int u, int v)
{
  int side = 2 * end->radius + 1;

  u += end->radius;
  v += end->radius;
  return u < 0 || v < 0 || u >= side || v >= side ? NULL : &end->member[v * side + u];
}

bool
celd_line_end_contains (const CeldLineEnd *end, int x, int y)
{
  int u = sampling_steps (end, x - end->middle.x), v = sampling_steps (end, y - end->middle.y), around = end->step > 1;

  for (int dv = -around; dv <= around && end->n; dv++)
    for (int du = -around; du <= around; du++)
      {
        const uint8_t *place = place_of (end, u + du, v + dv);

        if (place && *place)
          return true;
      }
  return false;
}

static void
clear_ink (CeldLineEnd *end)
{
  for (size_t i = 0; i < end->n; i++)
    *place_of (end, (end->pixel[i].x - end->middle.x) / end->step, (end->pixel[i].y - end->middle.y) / end->step) = 0;
  end->n = 0;
}

static void
add_pixel (const CeldPlane *ink, int u, int v, size_t from, CeldLineEnd *end)
{
  uint8_t *place = place_of (end, u, v);
  int      x = end->middle.x + u * end->step, y = end->middle.y + v * end->step;

  if (!place || *place || x < 0 || y < 0 || x >= ink->width || y >= ink->height || celd_is_paper (CELD_AT (ink, x, y)))
    return;
  *place = 1;
  end->from[end->n]    = (uint32_t) from;
  end->pixel[end->n++] = (CeldCorner) { x, y };
}

/* The first n pixels of the list; those from `rim` on are the farthest. */
typedef struct { size_t rim, n; } Part;

/* Gathers connected ink by steps to 4 and 8 neighbours in turn, which approximates circles.  *near is what lies within
 * half the radius. */
static void
gather (const CeldPlane *ink, CeldCorner pixel, CeldLineEnd *end, Part *near, Part *far)
{
  size_t from = 0;

  clear_ink (end);
  end->middle = pixel;
  add_pixel (ink, 0, 0, 0, end);
  for (int distance = 1; distance <= end->radius; distance++)
    {
      size_t to = end->n;

      for (; from < to; from++)
        {
          int u = (end->pixel[from].x - pixel.x) / end->step, v = (end->pixel[from].y - pixel.y) / end->step;

          for (int dv = -1; dv <= 1; dv++)
            for (int du = -1; du <= 1; du++)
              if (!(distance & 1) || !du || !dv)
                add_pixel (ink, u + du, v + dv, from, end);
        }
      *far = (Part) { to, end->n };
      if (2 * distance <= end->radius)
        *near = *far;
    }
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

/* Finds centre and principal axis of the first n pixels; the axis points to where the boundary meets them. */
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

/* Does a pixel count for the middle of the line?  Those at the far side, cut off aslant, do not. */
static bool
counts (const Line *line, double u)
{
  return u >= line->least + CUT_OFF * (line->most - line->least);
}

/* Fits a parabola by least squares over all pixels that count: the normal equations by Cramer's rule. */
static void
fit_middle (const CeldLineEnd *end, size_t n, Line *line)
{
  double s[5] = { 0 }, t[3] = { 0 }, d, square = 0;

  line->least = line->most = 0;
  for (size_t i = 0; i < n; i++)
    {
      double u = along (line, end->pixel[i].x + 0.5, end->pixel[i].y + 0.5);

      line->least = fmin (line->least, u);
      line->most  = fmax (line->most, u);
    }
  for (size_t i = 0; i < n; i++)
    {
      double x = end->pixel[i].x + 0.5, y = end->pixel[i].y + 0.5;
      double u = along (line, x, y), v = across (line, x, y), power = 1;

      for (int k = 0; k < 5 && counts (line, u); k++, power *= u)
        {
          s[k] += power;
          t[k < 3 ? k : 0] += k < 3 ? power * v : 0;
        }
    }
  d = s[0] * (s[2] * s[4] - s[3] * s[3]) - s[1] * (s[1] * s[4] - s[2] * s[3]) + s[2] * (s[1] * s[3] - s[2] * s[2]);
  if (fabs (d) > 1e-6)
    {
      line->a = (t[0] * (s[2] * s[4] - s[3] * s[3]) - t[1] * (s[1] * s[4] - s[2] * s[3]) +
                 t[2] * (s[1] * s[3] - s[2] * s[2])) / d;
      line->b = (t[1] * (s[0] * s[4] - s[2] * s[2]) - t[0] * (s[1] * s[4] - s[2] * s[3]) -
                 t[2] * (s[0] * s[3] - s[1] * s[2])) / d;
      line->c = (t[0] * (s[1] * s[3] - s[2] * s[2]) - t[1] * (s[0] * s[3] - s[1] * s[2]) +
                 t[2] * (s[0] * s[2] - s[1] * s[1])) / d;
    }
  line->width = (double) n * end->step * end->step / (line->most - line->least + end->step);
  for (size_t i = 0; i < n; i++)
    {
      double x = end->pixel[i].x + 0.5, y = end->pixel[i].y + 0.5, u = along (line, x, y);
      double off = across (line, x, y) - middle (line, u);

      square += counts (line, u) ? off * off : 0;
    }
  line->uneven = sqrt (square / s[0]);
}

static bool
is_line_end (const CeldLineEnd *end, Part part, const Line *line)
{
  double landing = along (line, end->middle.x + 0.5, end->middle.y + 0.5);

  for (size_t i = part.rim; i < part.n; i++)
    if (along (line, end->pixel[i].x + 0.5, end->pixel[i].y + 0.5) > landing)
      return false; /* the ink continues there */
  return line->most - line->least + end->step >= fmax (LEAST_LENGTH * line->width, SHORTEST_LINE_END) &&
         line->most - landing <= MOST_ASLANT * line->width + 1.5 * end->step &&
         line->uneven <= MOST_UNEVEN * line->width + 0.3 * end->step;
}

static CeldPlace
place_on (const Line *line, double u)
{
  double v = middle (line, u);

  return (CeldPlace) { line->x + u * line->along_x - v * line->along_y,
                       line->y + u * line->along_y + v * line->along_x };
}

static bool
is_member (const CeldPlane *ink, const CeldLineEnd *end, CeldPlace place)
{
  int x = (int) floor (place.x), y = (int) floor (place.y);

  return x >= 0 && y >= 0 && x < ink->width && y < ink->height && !celd_is_paper (CELD_AT (ink, x, y)) &&
         celd_line_end_contains (end, x, y);
}

/* Finds where the middle of the line leaves the ink; a line that was rubbed out may have a hollow end. */
static void
find_tip (const CeldPlane *ink, const Line *line, CeldLineEnd *end)
{
  double u = line->most + end->step, back = fmax (line->width / 2, 1);

  do
    {
      u      -= 0.25;
      end->at = place_on (line, u);
    }
  while (u > line->least && !is_member (ink, end, end->at));
  end->inside = place_on (line, u - back);
  end->width  = line->width;
}

static void
find_direction (const Line *line, CeldLineEnd *end)
{
  double u = along (line, end->at.x, end->at.y) - LAG * (line->most - line->least);
  double slope = line->b + 2 * line->c * u, length = sqrt (1 + slope * slope);

  end->dx = (line->along_x - slope * line->along_y) / length;
  end->dy = (line->along_y + slope * line->along_x) / length;
}

/* The nearer ink determines the tip best, the farther ink the direction. */
void
celd_line_end_fit (const CeldPlane *ink, CeldCorner pixel, CeldLineEnd *end)
{
  Part part[2] = { { 0, 0 }, { 0, 0 } };

  gather (ink, pixel, end, &part[0], &part[1]);
  end->tip    = false;
  end->width  = 0;
  end->at     = end->inside = (CeldPlace) { pixel.x + 0.5, pixel.y + 0.5 };
  end->dx     = end->dy = 0;
  for (int i = 0; i < 2; i++)
    {
      Line line = { 0 };

      find_axis (end, part[i].n, &line);
      fit_middle (end, part[i].n, &line);
      if (!is_line_end (end, part[i], &line))
        continue;
      if (!end->tip)
        find_tip (ink, &line, end);
      find_direction (&line, end);
      end->tip = true;
    }
}

void
celd_line_end_set_tip (const CeldTip *tip, CeldLineEnd *end)
{
  end->tip    = true;
  end->width  = tip->width > 0 ? tip->width : tip->stroke;
  end->at     = (CeldPlace) { tip->x, tip->y };
  end->inside = (CeldPlace) { tip->x - tip->dx, tip->y - tip->dy };
  end->dx     = tip->dx;
  end->dy     = tip->dy;
}

void
celd_line_end_set_corner (CeldCorner corner, CeldLineEnd *end)
{
  clear_ink (end);
  end->tip   = false;
  end->width = 0;
  end->at    = end->inside = (CeldPlace) { corner.x, corner.y };
}

/* ------------------------------------------------------------------ the side of a line */

/* The ink that a boundary from the other end should go to.  A path of length l that turns by the angle a from a line's
 * direction costs l (1 + 2 (1 - cos a)): it goes straight on unless the shortest path is less than half as long. */
static CeldPlace
aimed_place (const CeldLineEnd *from, const CeldLineEnd *end)
{
  double    least = INFINITY;
  CeldPlace place = end->at;

  for (size_t i = 0; i < end->n; i++)
    {
      double x = end->pixel[i].x + 0.5 - from->at.x, y = end->pixel[i].y + 0.5 - from->at.y;
      double length = sqrt (x * x + y * y), cost = from->tip ? 3 * length - 2 * (x * from->dx + y * from->dy) : length;

      if (cost >= least)
        continue;
      least = cost;
      place = (CeldPlace) { from->at.x + x, from->at.y + y };
    }
  return place;
}

void
celd_line_end_aim (const CeldPlane *ink, const CeldLineEnd *from, CeldLineEnd *end)
{
  CeldPlace place = aimed_place (from, end);
  double    length = celd_distance_between (from->at, place);
  double    x = length > 0 ? (place.x - from->at.x) / length : 0, y = length > 0 ? (place.y - from->at.y) / length : 0;

  end->at = end->inside = place;
  for (double t = 0; t < length; t += 0.25) /* find the edge of that ink */
    {
      place = (CeldPlace) { from->at.x + t * x, from->at.y + t * y };
      if (!is_member (ink, end, place))
        continue;
      end->at     = place;
      end->inside = (CeldPlace) { place.x + x, place.y + y };
      break;
    }
}
