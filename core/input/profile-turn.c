/* Where two arrows meet that fade or taper and look like one stroke: its opacity or width turns there.
 *
 * The values along the stroke are fitted by two straight lines that meet anywhere, by least squares.  Where the end of
 * one arrow meets the beginning of another one, values jump.  Where two begin or two end, they turn; that must be sharp,
 * because a single stroke may be thicker or stronger in its middle.
 *
 * Cost: a pass over the pixels.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/input.h"

#include <math.h>

/* All chosen; lengths are widths of the paint. */
#define ARROW_LONG   4    /* on either side of the turn, at least */
#define END          1    /* at each end of the stroke, which is round, and says nothing */
#define MISFIT       0.35 /* of two straight lines, as a part of that of one, at most */
#define JUMP         0.35 /* where lines meet, as a part of the largest value */
#define SWELL        0.7  /* of the misfit of a parabola, which a stroke that swells is like */
#define WEAK_ENDS    0.45 /* of the largest value, at most, where two end */
#define LEAST_WIDEST 6    /* pixels where a stroke is widest: of a thinner one whole pixels do not show where it turns */
#define TURN_ROUND   0.75 /* to either side of a turn, values ... */
#define ROUNDED      0.07 /* ... are off the straight lines by this part of the largest value, at most */

/* Sums over some values of 1, x, x x, v, x v and v v; x: distance in pixels, v: value there. */
typedef struct { double n, x, xx, v, xv, vv; } ValueSums;

/* v = level + slope x by least squares; misfit: the sum of squared errors. */
typedef struct { double level, slope, misfit; } ValueLine;

/* The opacity or width for each pixel of distance along a stroke, and the sums of those before each of them. */
typedef struct { size_t n; double *value, most; ValueSums *before; } Profile;

/* Opacity is weighted by opacity, so that soft edges count little. */
static void
measure_opacity (const CeldArrowStroke *stroke, const CeldArrowLayer *layer, Profile *p)
{
  for (size_t i = 0; i < p->n; i++)
    p->before[i] = (ValueSums) { 0 };
  for (size_t i = 0; i < stroke->n; i++)
    {
      uint32_t   pixel = stroke->pixel[i];
      double     a = celd_arrow_opacity (layer, celd_stroke_x (stroke, pixel), celd_stroke_y (stroke, pixel));
      ValueSums *at = &p->before[(size_t) stroke->distance[pixel]];

      at->v += a * a;
      at->n += a;
    }
  for (size_t i = 0; i < p->n; i++)
    p->value[i] = p->before[i].n > 0 ? p->before[i].v / p->before[i].n : 0;
}

static void
measure (const CeldArrowStroke *stroke, const CeldArrowLayer *layer, CeldArrowStyle style, Profile *p)
{
  if (style == CELD_ARROW_FADE)
    measure_opacity (stroke, layer, p);
  else
    for (size_t i = 0; i < p->n; i++)
      p->value[i] = celd_stroke_mean_width (stroke, (double) i, (double) i + 1);
  p->before[0] = (ValueSums) { 0 };
  for (size_t i = 0; i < p->n; i++)
    {
      double    x = (double) i + 0.5, v = p->value[i];
      ValueSums b = p->before[i];

      p->most          = fmax (p->most, v);
      p->before[i + 1] = (ValueSums) { b.n + 1, b.x + x, b.xx + x * x, b.v + v, b.xv + x * v, b.vv + v * v };
    }
}

/* The fit of values from `from` up to, not with, `to`. */
static ValueLine
fit (const Profile *p, size_t from, size_t to)
{
  ValueSums a = p->before[from], b = p->before[to];
  double    n = b.n - a.n, x = (b.x - a.x) / n, v = (b.v - a.v) / n;
  double    xx = b.xx - a.xx - n * x * x, xv = b.xv - a.xv - n * x * v, vv = b.vv - a.vv - n * v * v;
  double    slope = xx > 0 ? xv / xx : 0;

  return (ValueLine) { v - slope * x, slope, fmax (0, vv - slope * xv) };
}

static double
line_at (ValueLine f, size_t x)
{
  return f.level + f.slope * (double) x;
}

static bool
jumps (const Profile *p, size_t at, ValueLine left, ValueLine right)
{
  return fabs (line_at (left, at) - line_at (right, at)) >= JUMP * p->most;
}

/* Are the values near a turn about those of the straight lines? */
static bool
is_sharp (const Profile *p, size_t at, size_t reach, ValueLine left, ValueLine right)
{
  double off = 0;

  for (size_t i = at - reach; i <= at + reach; i++)
    off += p->value[i] - line_at (i < at ? left : right, i);
  return fabs (off) <= ROUNDED * p->most * (double) (2 * reach + 1);
}

/* The misfit of a parabola through values from `from` up to, not with, `to`: of a polynomial of Legendre's first three,
 * which are orthogonal on such points, but for little. */
static double
misfit_of_parabola (const Profile *p, size_t from, size_t to)
{
  double n = (double) (to - from), c[3] = { 0 }, misfit = 0;

  for (size_t i = from; i < to; i++)
    {
      double t = 2 * ((double) (i - from) + 0.5) / n - 1, v = p->value[i] / n;

      c[0] += v;
      c[1] += 3 * t * v;
      c[2] += 5 * (1.5 * t * t - 0.5) * v;
    }
  for (size_t i = from; i < to; i++)
    {
      double t = 2 * ((double) (i - from) + 0.5) / n - 1;

      misfit += pow (p->value[i] - c[0] - c[1] * t - c[2] * (1.5 * t * t - 0.5), 2);
    }
  return misfit;
}

/* Does a stroke swell and shrink again smoothly, as a brush makes it? */
static bool
swells (const Profile *p, size_t from, size_t to, ValueLine left, ValueLine right)
{
  return left.slope > 0 && right.slope < 0 && left.misfit + right.misfit > SWELL * misfit_of_parabola (p, from, to);
}

/* Do two that end there meet at their weak ends?  Two that lie on each other in opposite directions are stronger. */
static bool
ends_are_weak (const Profile *p, size_t at, ValueLine left, ValueLine right)
{
  return left.slope > right.slope || fmin (line_at (left, at), line_at (right, at)) <= WEAK_ENDS * p->most;
}

/* Is it clear that two arrows meet at the turn, and where? */
static bool
is_clear (const Profile *p, CeldArrowStyle style, size_t end, size_t at, double width)
{
  ValueLine left = fit (p, end, at), right = fit (p, at, p->n - end);

  if (jumps (p, at, left, right))
    return true;
  return (style == CELD_ARROW_FADE || p->most >= LEAST_WIDEST) && ends_are_weak (p, at, left, right) &&
         !swells (p, end, p->n - end, left, right) && is_sharp (p, at, (size_t) (TURN_ROUND * width), left, right);
}

/* The distance at which values turn; 0 if they do not, or it is not clear where. */
static size_t
find_turn (const Profile *p, CeldArrowStyle style, double width)
{
  size_t end = (size_t) (END * width), side = (size_t) (ARROW_LONG * width), at = 0;
  double least = INFINITY;

  if (p->n < 2 * (end + side) + 1)
    return 0;
  for (size_t i = end + side; i + side + end < p->n; i++)
    {
      double misfit = fit (p, end, i).misfit + fit (p, i, p->n - end).misfit;

      if (misfit < least)
        {
          least = misfit;
          at    = i;
        }
    }
  return least <= MISFIT * fit (p, end, p->n - end).misfit && is_clear (p, style, end, at, width) ? at : 0;
}

CeldStatus
celd_stroke_turn_find (const CeldArrowStroke *stroke, const CeldArrowLayer *layer, CeldArrowStyle style, double width,
                       double *distance)
{
  size_t  n = (size_t) celd_stroke_length (stroke);
  Profile p = { .n = n, .value = celd_alloc (n, sizeof *p.value), .before = celd_alloc (n + 1, sizeof *p.before) };
  bool    enough = p.value && p.before;

  *distance = 0;
  if (enough)
    {
      measure (stroke, layer, style, &p);
      *distance = (double) find_turn (&p, style, width);
    }
  celd_free (p.value);
  celd_free (p.before);
  return enough ? CELD_OK : CELD_NO_MEMORY;
}
