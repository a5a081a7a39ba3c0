/* How the opacity or width of the lines of a graph changes, and where two arrows meet in one line.
 *
 * From the strong end of an arrow to its weak one values only fall, however fast.  So the direction of a line is that
 * in which its values fall (monotone-pieces.c).  If they also rise, the line is divided into the fewest pieces in which
 * they do not, and two arrows meet between them: where values jump from weak to strong, head to tail; where they turn,
 * two begin or two end.
 *
 * Cost: a few passes over the points of a line, or the square of its length if it is divided.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/joined-arrows.h"

#include <math.h>

/* All chosen; lengths are widths of the paint, values are parts of the largest one of the connected paint. */
#define LEAST_ALONE  1    /* of a line that is of no other one, too, and 4 pixels */
#define MISFIT       0.05 /* root of the mean square between values and those that only fall, at most */
#define MOST_RISEN   0.15 /* of values the wrong way, ... */
#define THIN_RISEN   0.3  /* ... and more of them of a line that is one pixel wide */
#define LEAST_FALL   0.1  /* of values that fall, ... */
#define CLEAR_FALL   4    /* ... and in misfits */
#define LED_ON       0.33 /* part of the values from which those at the ends follow */
#define MOST_LED     1.4  /* of a value at an end: where it is larger, the line is too short or uneven to tell */
#define LEAST_PART   2    /* of a line on either side of a turn */
#define BETTER       0.5  /* part of the squares that is left if a line is divided, at most */
#define MOST_VALUES  800  /* by which pieces are found; of a longer line not all values are taken */
#define AS_WELL      0.02 /* misfit more than the least one of a turn that may be there as well */
#define VAGUE        1.5  /* along which a turn may be, if nothing else shows where */
#define BESIDE       8    /* of a line that fades, beside such a range, for straight lines that meet there; ... */
#define TOO_THIN     4.5  /* ... and pixels of the width of a line that tapers, of which they do not show it */
#define ROUNDED      0.05 /* from values to such lines near where they meet, if two arrows begin there, at most */
#define CORNER_REACH 3    /* to either side of a corner, and 3 pixels */
#define LEAST_CORNER 0.35 /* radians by which a line turns where two arrows meet */
#define THIN_CORNER  0.5  /* the same for a thin line */
#define SHARPEST     0.9  /* radians by which no arrow turns */

/* The angle by which a line turns at its point i. */
static double
turn_at (const CeldJoinedLines *s, const CeldStrokeLine *line, size_t i)
{
  size_t    reach = (size_t) (CORNER_REACH * s->graph.width + 3);
  CeldPoint a = line->at[i > reach ? i - reach : 0], b = line->at[i];
  CeldPoint c = line->at[i + reach < line->n ? i + reach : line->n - 1];

  return fabs (atan2 ((b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x),
                      (b.x - a.x) * (c.x - b.x) + (b.y - a.y) * (c.y - b.y)));
}

/* Values between the turns before and behind one, which may be from the first to the last of a range. */
typedef struct { size_t before, first, last, behind; } TurnRange;

/* The least number of values of a part of a line. */
static size_t
least_part (const CeldLineValues *v)
{
  return (size_t) ceil (LEAST_PART * v->lines->graph.width);
}

/* The value at a point before the first or behind the last value, by a straight line through a third of them. */
static double
led_on (const CeldLineValues *v, bool last, double point)
{
  size_t n = (size_t) ceil (LED_ON * (double) v->n);
  double level, slope;

  celd_line_values_fit (v, last ? v->n - n : 0, last ? v->n : n, &level, &slope);
  return level + slope * (point - (double) v->first);
}

/* Is a line that tapers so thin that whole pixels blur where it turns? */
static bool
is_thin (const CeldJoinedLines *s)
{
  return s->style == CELD_ARROW_TAPER && s->graph.width < TOO_THIN;
}

/* Are values within a width of a place about those of straight lines that meet there?  Where an arrow fades only from
 * some distance on, or one stroke is pressed harder in between, they are not. */
static bool
is_sharp (const CeldLineValues *v, double at, const double *level, const double *slope)
{
  size_t reach = (size_t) ceil (v->lines->graph.width), middle = (size_t) at;
  size_t from = middle > reach ? middle - reach : 0, to = middle + reach < v->n ? middle + reach : v->n;
  double off = 0;

  for (size_t i = from; i < to; i++)
    off += v->value[i] - (level[(double) i > at] + slope[(double) i > at] * (double) i);
  return fabs (off) <= ROUNDED * (double) (to - from);
}

/* Where the straight lines meet that values are on both sides of a range; NAN if they do not show where arrows meet. */
static double
where_lines_meet (const CeldLineValues *v, const TurnRange *t)
{
  size_t reach = (size_t) ceil (BESIDE * v->lines->graph.width), first = t->first, last = t->last;
  bool   fades = v->lines->style == CELD_ARROW_FADE;
  size_t from = fades && first > t->before + reach ? first - reach : t->before;
  size_t to = fades && last + reach < t->behind ? last + reach : t->behind;
  double level[2], slope[2], at;

  if (first < from + 3 || to < last + 3 || is_thin (v->lines))
    return NAN;
  celd_line_values_fit (v, from, first, &level[0], &slope[0]);
  celd_line_values_fit (v, last, to, &level[1], &slope[1]);
  at = (level[1] - level[0]) / (slope[0] - slope[1]);
  if (!(at >= (double) first && at <= (double) last) || (slope[0] > slope[1] && !is_sharp (v, at, level, slope)))
    return NAN;
  return at;
}

/* The turn in a range of values: its middle, or if that is long, the sharpest corner, or where straight lines meet. */
static CeldLineTurn
turn_in (const CeldLineValues *v, const TurnRange *t)
{
  const CeldJoinedLines *s = v->lines;
  size_t                 first = t->first, last = t->last, sharpest = first;
  double                 meeting;

  if ((double) (last - first) <= VAGUE * s->graph.width)
    return (CeldLineTurn) { v->first + (first + last) / 2, false };
  for (size_t i = first; i <= last; i++)
    if (turn_at (s, v->line, v->first + i) > turn_at (s, v->line, v->first + sharpest))
      sharpest = i;
  if (turn_at (s, v->line, v->first + sharpest) >= (is_thin (s) ? THIN_CORNER : LEAST_CORNER))
    return (CeldLineTurn) { v->first + sharpest, false };
  meeting = where_lines_meet (v, t);
  return (CeldLineTurn) { v->first + (isnan (meeting) ? (first + last) / 2 : (size_t) meeting), isnan (meeting) };
}

/* Finds where a line turns that neither falls nor rises: with the fewest pieces that do. */
static CeldStatus
find_turns (const CeldLineValues *v, double error, CeldLineProfile *p)
{
  size_t     step = 1 + v->n / MOST_VALUES, n = v->n / step, cut[CELD_MOST_PIECES + 1], pieces = 0;
  double    *value = celd_alloc (n, sizeof *value);
  double     most = fmin (BETTER * error / (double) step, (double) n * MISFIT * MISFIT);
  CeldStatus status = value ? CELD_OK : CELD_NO_MEMORY;

  for (size_t i = 0; i < n && value; i++)
    value[i] = v->value[i * step];
  if (status == CELD_OK)
    status = celd_monotone_divide (value, n, 1 + least_part (v) / step, most, cut, &pieces);
  for (size_t i = 1; i < pieces && status == CELD_OK; i++)
    {
      TurnRange t = { .before = cut[i - 1] * step, .behind = cut[i + 1] * step };
      size_t    length = t.behind - t.before, range[2];

      status  = celd_monotone_range (v->value + t.before, length, least_part (v),
                                     (double) length * AS_WELL * AS_WELL, range);
      t.first = t.before + range[0];
      t.last  = t.before + range[1];
      p->turn[p->n_turns++] = turn_in (v, &t);
    }
  celd_free (value);
  return status;
}

/* By how much values rise above an earlier one, at most; with `rises`, fall below one. */
static double
largest_change (const CeldLineValues *v, bool rises)
{
  double sign = rises ? -1 : 1, least = INFINITY, change = 0;

  for (size_t i = 0; i < v->n; i++)
    {
      least  = fmin (least, sign * v->value[i]);
      change = fmax (change, sign * v->value[i] - least);
    }
  return change;
}

/* Has a line a corner that is no end of an arrow? */
static bool
has_sharp_corner (const CeldLineValues *v)
{
  for (size_t i = 0; i < v->n; i++)
    if (turn_at (v->lines, v->line, v->first + i) > SHARPEST)
      return true;
  return false;
}

/* Fills in the profile of a line that has values. */
static CeldStatus
find_profile (const CeldLineValues *v, const CeldArrowLayer *layer, CeldLineProfile *p)
{
  bool       rises = false;
  double     error = 0, misfit, range;
  CeldStatus status = celd_monotone_error (v->value, v->n, &rises, &error);

  misfit = sqrt (error / (double) v->n);
  p->value[0] = led_on (v, false, 0);
  p->value[1] = led_on (v, true, (double) (v->line->n - 1));
  range = rises ? p->value[1] - p->value[0] : p->value[0] - p->value[1];
  celd_line_colours (v, layer, p->colour);
  p->known = misfit <= MISFIT && largest_change (v, rises) <= MOST_RISEN + THIN_RISEN / v->lines->graph.width;
  if (status == CELD_OK && !p->known)
    status = find_turns (v, error, p);
  p->known &= fmax (p->value[0], p->value[1]) < MOST_LED && !has_sharp_corner (v);
  if (p->known && range >= fmax (LEAST_FALL, CLEAR_FALL * misfit))
    p->tail = rises;
  return status;
}

CeldStatus
celd_line_profile_find (const CeldJoinedLines *s, const CeldArrowLayer *layer, size_t k, double most,
                        CeldLineProfile *p)
{
  CeldLineValues v;
  CeldStatus     status = celd_line_values_new (s, layer, k, most, &v);

  *p = (CeldLineProfile) { .tail = -1 };
  p->seen = status == CELD_OK && (double) v.n >= LEAST_ALONE * s->graph.width + 4;
  if (p->seen)
    status = find_profile (&v, layer, p);
  celd_free (v.value);
  return status;
}
