/* Edges of fills without a line between them get one; those of shadows and highlights do not.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "discs.h"

/* Fills with an edge between them that has no line get one there, at most three pixels wide; a steep gradient and
 * grain do not. */
static void
edges_without_lines_are_drawn (void)
{
  static const Tone of[3][2] = {
    { { 1, 0.7f, 0.75f }, { 0.25f, 0.12f, 0.08f } },
    { { 1, 0.7f, 0.75f }, { 0.2f, 0.6f, 0.3f } },
    { { 0.26f, 0.39f, 0.82f }, { 0.18f, 0.17f, 0.35f } }, /* nearly as dark all over as a shadow */
  };
  uint32_t          seed = 11;

  for (int turn = 0; turn < 3; turn++)
    {
      int stray = 0;

      draw (blue, yellow, of[turn][0], brown);
      for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
          {
            seed = seed * 1664525u + 1013904223u;
            if (inside (x, y, 125, 100, 42) && x + y > 225)
              put (x, y, of[turn][1]);
            if (y >= 155) /* 10 of 255 a pixel, and grain */
              {
                float slope = (float) (x < 60 ? 0 : x < 78 ? x - 60 : 18) / 20;

                put (x, y, mixed (blue, yellow, slope + (float) (seed >> 29) / 255));
              }
          }
      CHECK (find (CELD_INK_LINES, NULL) == CELD_OK);
      for (int y = 95; y < 110; y++) /* across the edge at x = 225 - y, far from tips, which are lines */
        {
          int ink = 0;

          for (int x = 225 - y - 8; x <= 225 - y + 8; x++)
            ink += luma_of[y * SIDE + x] < 0.5f;
          CHECK (ink > 0 && ink <= 3);
          CHECK (luma_of[y * SIDE + 225 - y] < 0.5f || luma_of[y * SIDE + 226 - y] < 0.5f);
        }
      for (int y = 159; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
          stray += luma_of[y * SIDE + x] < 0.5f;
      CHECK (stray == 0);
    }
}

/* The edge of a shadow, and of a highlight, is none between fills. */
static void
shadows_have_no_lines (void)
{
  for (int turn = 0; turn < 2; turn++)
    {
      int stray = 0;

      draw (blue, yellow, pink, brown);
      for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
          if (inside (x, y, 125, 100, 42) && x + y > 225)
            put (x, y, mixed (turn ? white : (Tone) { 0, 0, 0 }, turn ? blue : pink, 0.5f));
          else if (turn && inside (x, y, 125, 100, 42))
            put (x, y, blue);
      CHECK (find (CELD_INK_LINES, NULL) == CELD_OK);
      for (int y = 95; y < 110; y++)
        for (int x = 225 - y - 8; x <= 225 - y + 8; x++)
          stray += luma_of[y * SIDE + x] < 0.5f;
      CHECK (stray == 0);
    }
}

int
main (void)
{
  RUN (edges_without_lines_are_drawn);
  RUN (shadows_have_no_lines);
  return DONE;
}
