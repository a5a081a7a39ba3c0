/* How shafts fade or taper.
 *
 * From the tail of an arrow on, opacity or width only fall.  Where other arrows cross it or lie on it, there is more
 * paint, never less.  So of what is seen along a shaft the least value up to each point is what an arrow from that end
 * on may have there, and explains.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/arrow-search.h"

#include <math.h>

/* All chosen; lengths are widths of the paint. */
#define PART_OF_ONE   1.2 /* parts of the width that a value of 1 is: the thick ends are wider than most paint */
#define PROFILE_STEP  0.4 /* between samples of a shaft */
#define ACROSS        0.3 /* to either side of a shaft where the most is taken, ... */
#define ACROSS_STEPS  2   /* ... of so many points */
#define ROUND_END     2   /* samples at an end, which is round or thin and says nothing */
#define PROFILE_REACH 3   /* samples to either side of one of which the mean is taken */

double
celd_search_strength (const CeldArrowSearch *s, CeldPoint p)
{
  double room = celd_search_room (s, p);

  if (s->style != CELD_ARROW_FADE)
    return PART_OF_ONE * room / s->width;
  return room > 0 ? celd_arrow_opacity (s->layer, (int) p.x + s->mask->left, (int) p.y + s->mask->top) / 255.0 : 0;
}

/* The most across a shaft, which may be a little off the middle of the paint. */
static double
most_across (const CeldArrowSearch *s, CeldPoint p, CeldPoint way)
{
  CeldPoint across = { -way.y, way.x };
  double    most = 0;

  for (int k = -ACROSS_STEPS; k <= ACROSS_STEPS; k++)
    most = fmax (most, celd_search_strength (s, celd_moved (p, across, k * ACROSS / ACROSS_STEPS * s->width)));
  return most;
}

/* Appends the samples between two points of a shaft; their values are in fall[0]. */
static void
sample_part (const CeldArrowSearch *s, CeldPoint a, CeldPoint b, int n, CeldShaftSample *sample)
{
  double    d = celd_points_apart (a, b);
  CeldPoint way = { (b.x - a.x) / d, (b.y - a.y) / d };

  for (int i = 0; i < n; i++)
    {
      sample[i].at      = celd_search_between (a, b, (i + 0.5) / n);
      sample[i].fall[0] = most_across (s, sample[i].at, way);
    }
}

/* Replaces values by means of those around them; fall[1] has room for the former. */
static void
smooth (CeldShaftSample *sample, int n)
{
  for (int i = 0; i < n; i++)
    sample[i].fall[1] = sample[i < ROUND_END ? ROUND_END : i >= n - ROUND_END ? n - ROUND_END - 1 : i].fall[0];
  for (int i = 0; i < n; i++)
    {
      int from = i > PROFILE_REACH ? i - PROFILE_REACH : 0, to = i + PROFILE_REACH < n ? i + PROFILE_REACH + 1 : n;

      sample[i].fall[0] = 0;
      for (int k = from; k < to; k++)
        sample[i].fall[0] += sample[k].fall[1] / (to - from);
    }
}

/* Replaces values by the least ones from either end on. */
static void
find_falls (CeldShaftSample *sample, int n)
{
  for (int i = 0; i < n; i++)
    sample[i].fall[1] = i ? fmin (sample[i - 1].fall[1], sample[i].fall[0]) : sample[i].fall[0];
  for (int i = n - 2; i >= 0; i--)
    sample[i].fall[0] = fmin (sample[i + 1].fall[0], sample[i].fall[0]);
}

CeldStatus
celd_shaft_samples_new (const CeldArrowSearch *s, const CeldShaft *shaft, CeldShaftSample **sample, int *n)
{
  int each = (int) ceil (shaft->length / (double) (shaft->n - 1) / (PROFILE_STEP * s->width));

  *n      = each * (int) (shaft->n - 1);
  *sample = celd_alloc ((size_t) *n, sizeof **sample);
  if (!*sample)
    return CELD_NO_MEMORY;
  for (size_t i = 1; i < shaft->n; i++)
    sample_part (s, shaft->at[i - 1], shaft->at[i], each, *sample + (int) (i - 1) * each);
  smooth (*sample, *n);
  find_falls (*sample, *n);
  return CELD_OK;
}
