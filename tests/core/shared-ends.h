/* Arrows that begin or end in the middle of a picture, for tests.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef SHARED_ENDS_H
#define SHARED_ENDS_H

#include "draw-arrows.h"

#define SIZE 300

static const uint8_t COLOURS[4][3] = { { 20, 160, 60 }, { 230, 90, 0 }, { 120, 40, 160 }, { 0, 0, 0 } };

/* How arrows share the place in the middle. */
typedef enum { FAN_OUT, FAN_IN, CHAIN, STAR, OVERLAP } Sharing;

/* An arrow from the middle to a place around it, or the other way. */
static inline Arrow
spoke (double angle, double length, double width, CeldArrowStyle style, bool inwards, bool open)
{
  bool  nearer_is_tip = style == CELD_ARROW_DOT; /* `through` draws a dot at the last point */
  Point middle = { SIZE / 2., SIZE / 2. };

  return inwards != nearer_is_tip ? through (middle, angle + 3.14159265, length, 1, width, style, open)
                                  : through (middle, angle, length, 0, width, style, open);
}

static inline Arrow
shared_arrow (Sharing sharing, int k, double angle, double length, double width, CeldArrowStyle style, bool open)
{
  bool inwards = sharing == FAN_IN || (sharing == CHAIN && k == 0) || (sharing == STAR && k % 2 == 0);

  return spoke (sharing == OVERLAP ? angle * 0.1 : angle, length * (sharing == OVERLAP ? 1 + 0.3 * k : 1), width, style,
                inwards, open);
}

/* Draws some that share the middle, in styles, widths and angles at random; at least so many are read, and no other. */
static inline void
read_shared (Sharing sharing, int arrows, int pictures, const uint8_t colours[4][3], double least)
{
  uint32_t state = 5 + (uint32_t) sharing;
  int      right = 0, all = 0;

  for (int i = 0; i < pictures; i++)
    {
      CeldArrowStyle style = STYLES[i % 4];
      double         start = random_between (&state, 0, 6.28), w = random_between (&state, 3, 7);
      double         length = random_between (&state, 14, 16) * w;
      CeldPaint      paint = blank (SIZE, SIZE);
      Arrow          a[4];
      Answer         answer;
      size_t         found;

      for (int k = 0; k < arrows; k++)
        {
          double angle = start + (k + random_between (&state, -0.25, 0.25)) * 6.2832 / arrows;

          a[k] = shared_arrow (sharing, k, angle, length, w * random_between (&state, 0.9, 1.1), style, i % 8 < 4);
          draw_arrow (&paint, &a[k], colours[k]);
        }
      answer = read_paint (&paint, style);
      found  = count_read (&answer, a, arrows, style);
      CHECK (answer.relations.n == found); /* no other */
      CHECK (answer.relations.n + answer.problems.n >= 1);
      right += (int) found;
      all   += arrows;
      forget (&answer);
      free (paint.data);
    }
  if (right < least * all)
    printf ("sharing %d: %d of %d read\n", (int) sharing, right, all);
  CHECK (right >= least * all);
}

/* Four that begin or end in the middle, half a radian apart or more: opposite ones may look like one stroke. */
static inline void
read_at_any_angles (int pictures, const uint8_t colours[4][3], double least)
{
  uint32_t state = 3;
  int      right = 0, all = 0;

  for (int i = 0; i < pictures; i++)
    {
      CeldArrowStyle style = STYLES[i % 4];
      double         w = random_between (&state, 3, 7);
      CeldPaint      paint = blank (SIZE, SIZE);
      Arrow          a[4];
      Answer         answer;
      size_t         found;
      double         angle = random_between (&state, 0, 6.28);

      for (int k = 0; k < 4; k++)
        {
          angle += 0.5 + random_between (&state, 0, 1);
          a[k] = spoke (angle, random_between (&state, 10, 16) * w, w, style,
                        check_random (&state, 2), i % 8 < 4);
          draw_arrow (&paint, &a[k], colours[k]);
        }
      answer = read_paint (&paint, style);
      found  = count_read (&answer, a, 4, style);
      CHECK (answer.relations.n == found);
      right += (int) found;
      all   += 4;
      forget (&answer);
      free (paint.data);
    }
  CHECK (right >= least * all);
}

/* Draws arrows of one colour and counts those that are read; no other one is. */
static inline int
read_green (const Arrow *a, int n, CeldArrowStyle style)
{
  CeldPaint paint = blank (SIZE, SIZE);
  Answer    answer;
  int       found;

  for (int k = 0; k < n; k++)
    draw_arrow (&paint, &a[k], GREEN);
  answer = read_paint (&paint, style);
  found  = (int) count_read (&answer, a, n, style);
  CHECK ((int) answer.relations.n == found);
  forget (&answer);
  free (paint.data);
  return found;
}

#endif
