/* Whether levels belong to a drawing.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"

enum { SIDE = 120 };

static float level[SIDE * SIDE], line[SIDE * SIDE];

/* Three parts beside each other, each a little sloped, that end at these places; and lines at others. */
static double
share (int first, int second, int first_line, int second_line)
{
  CeldPlane levels = { SIDE, SIDE, SIDE, level }, lines = { SIDE, SIDE, SIDE, line };

  for (int i = 0; i < SIDE * SIDE; i++)
    {
      int x = i % SIDE;

      level[i] = 5 * (float) ((x >= first) + (x >= second)) + 0.01f * (float) x;
      line[i]  = x == first_line || x == second_line ? 0 : 1;
    }
  return celd_steps_on_lines (&levels, &lines);
}

static void
steps_are_at_their_lines (void)
{
  NEAR (share (40, 80, 40, 80), 1, 1e-9);
  NEAR (share (40, 80, 41, 77), 1, 1e-9); /* the last pixels before a step are at it, and two more */
  NEAR (share (40, 80, 42, 76), 0, 1e-9);
  NEAR (share (40, 80, 39, 20), 0.5, 1e-9);
  NEAR (share (40, 80, 10, 20), 0, 1e-9);
}

/* A slope has no steps, and a page with hardly any tells nothing. */
static void
few_steps_tell_nothing (void)
{
  NEAR (share (SIDE, SIDE, 10, 20), 1, 1e-9);
  CHECK (share (40, SIDE, 10, 20) < 0.5);
  {
    CeldPlane levels = { SIDE, SIDE, SIDE, level }, lines = { SIDE, SIDE, SIDE, line };

    for (int i = 0; i < SIDE * SIDE; i++)
      level[i] = i % SIDE < 7 && i / SIDE < 7;
    NEAR (celd_steps_on_lines (&levels, &lines), 1, 1e-9);
  }
}

/* Where there are many, some of them are looked at. */
static void
large_pages (void)
{
  enum { LARGE = 400 };
  static float values[LARGE * LARGE], drawn[LARGE * LARGE];
  CeldPlane    levels = { LARGE, LARGE, LARGE, values }, lines = { LARGE, LARGE, LARGE, drawn };

  for (int i = 0; i < LARGE * LARGE; i++)
    {
      values[i] = (float) (i % LARGE / 4 % 2);
      drawn[i]  = i % LARGE < LARGE / 2 ? 0 : 1;
    }
  NEAR (celd_steps_on_lines (&levels, &lines), 0.5, 0.02);
}

int
main (void)
{
  RUN (steps_are_at_their_lines);
  RUN (few_steps_tell_nothing);
  RUN (large_pages);
  return DONE;
}
