/* Edges of a coloured drawing where two fills meet without a line, also at an area in the colour of lines that is a
 * fill because it is too wide for one.
 *
 * There some channel changes by several times the least contrast of a line from one pixel to the second next one.
 * Gradients and soft texture change less.  Of the pixels side by side that do, those with most of the change are the
 * edge.  Lines have such steps on both sides: one with a line beside it, in its own direction, does not count, so edges
 * go on up to the ends of lines.  Nor do the edges of shadows and highlights, which are parts of a fill: there all
 * channels change in proportion, seen from black or from white.
 *
 * Cost: O(pixels).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/coloured-steps.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define LINE_EDGE      3     /* pixels from the ink of a line to where its edge ends; chosen */
#define CLEAR_STEP     3     /* times the least contrast of a line; chosen */
#define DARKEST_SHADOW 0.35f /* light in a shadow as a share of that beside it, at least; chosen */
#define HUE_CHANGE     24    /* of 255 in full light: how far a channel in a shadow may be from proportion; chosen */

/* Raises steps, of n pixels, to those of a channel from the pixel before to the one after each. */
CELD_CLONES static void
raise_steps (const uint8_t *restrict before, const uint8_t *restrict after, size_t n, uint8_t *restrict step)
{
  for (size_t i = 0; i < n; i++)
    {
      uint8_t change = before[i] > after[i] ? (uint8_t) (before[i] - after[i]) : (uint8_t) (after[i] - before[i]);

      step[i] = change > step[i] ? change : step[i];
    }
}

/* Whether a line is on one side of a pixel, dx,dy from one to the next: its ink, and up to there its paler edge. */
static bool
is_line_beside (const CeldMask *strength, const CeldPlane *luma, int x, int y, int dx, int dy)
{
  for (int i = 0; i <= LINE_EDGE; i++, x += dx, y += dy)
    {
      if (x < 0 || y < 0 || x >= luma->width || y >= luma->height)
        return false;
      if (!celd_is_paper (CELD_AT (luma, x, y)))
        return true;
      if (i > 1 && !CELD_AT (strength, x, y))
        return false;
    }
  return false;
}

/* Whether a colour is another one in shadow; `invert` has the bits that are inverted first. */
static bool
is_shadow (const uint8_t dark[3], const uint8_t light[3], uint8_t invert)
{
  float squares = 0, products = 0, share, most = 0;

  for (int c = 0; c < 3; c++)
    {
      float d = dark[c] ^ invert, l = light[c] ^ invert;

      squares += l * l;
      products += d * l;
    }
  share = products / celd_most (squares, 1);
  for (int c = 0; c < 3; c++)
    most = celd_most (most, fabsf ((float) (dark[c] ^ invert) - share * (float) (light[c] ^ invert)));
  return share >= DARKEST_SHADOW && share <= 1 && most <= share * HUE_CHANGE;
}

/* Whether there is an edge between fills across pixel (x,y), from dx,dy before to dx,dy after it. */
static bool
is_edge (const CeldMask channel[3], const CeldMask *strength, const CeldPlane *luma, int x, int y, int dx, int dy,
         int least)
{
  uint8_t a[3], b[3];
  int     most = 0;

  for (int c = 0; c < 3; c++)
    {
      a[c] = CELD_AT (&channel[c], x - dx, y - dy);
      b[c] = CELD_AT (&channel[c], x + dx, y + dy);
      most = abs (a[c] - b[c]) > most ? abs (a[c] - b[c]) : most;
    }
  return most >= least && !is_line_beside (strength, luma, x, y, dx, dy) &&
         !is_line_beside (strength, luma, x, y, -dx, -dy) && !is_shadow (a, b, 0) && !is_shadow (b, a, 0) &&
         !is_shadow (a, b, 255) && !is_shadow (b, a, 255);
}

/* Sets `step` to the largest change of a channel across each pixel; to 0 at the frame, at lines, and where there is no
 * edge between fills. */
static void
measure_steps (const CeldMask channel[3], const CeldMask *strength, const CeldPlane *luma, int least, CeldMask *step)
{
  int width = step->width, height = step->height;

  memset (step->data, 0, (size_t) width * (size_t) height);
  for (int y = 1; y < height - 1 && width > 2; y++)
    {
      uint8_t *row = &CELD_AT (step, 1, y);

      for (int c = 0; c < 3; c++)
        {
          raise_steps (&CELD_AT (&channel[c], 0, y), &CELD_AT (&channel[c], 2, y), (size_t) width - 2, row);
          raise_steps (&CELD_AT (&channel[c], 1, y - 1), &CELD_AT (&channel[c], 1, y + 1), (size_t) width - 2, row);
        }
      for (int left = 1, n; left < width - 1; left += n)
        {
          n = celd_piece_at (left, width - 1);
          if (!celd_any_byte_reaches (&CELD_AT (step, left, y), (size_t) n, least)) /* few do */
            memset (&CELD_AT (step, left, y), 0, (size_t) n);
          else
            for (int x = left; x < left + n; x++)
              if (CELD_AT (step, x, y) < least || !(is_edge (channel, strength, luma, x, y, 1, 0, least) ||
                                                    is_edge (channel, strength, luma, x, y, 0, 1, least)))
                CELD_AT (step, x, y) = 0;
        }
    }
}

/* Whether none of the pixels around one that is not outermost has a much larger step. */
static bool
is_largest (const CeldMask *step, int x, int y)
{
  int most = 0;

  for (int v = y - 1; v <= y + 1; v++)
    for (int u = x - 1; u <= x + 1; u++)
      most = CELD_AT (step, u, v) > most ? CELD_AT (step, u, v) : most;
  return 5 * CELD_AT (step, x, y) >= 4 * most;
}

void
celd_draw_fill_edges (const CeldMask channel[3], const CeldMask *strength, int faintest, CeldMask *step,
                      CeldPlane *luma)
{
  int least = CLEAR_STEP * faintest < 255 ? CLEAR_STEP * faintest : 255;

  measure_steps (channel, strength, luma, least, step);
  for (int y = 0; y < luma->height; y++)
    for (int left = 0, n; left < luma->width; left += n)
      {
        n = celd_piece_at (left, luma->width);
        if (celd_any_byte_reaches (&CELD_AT (step, left, y), (size_t) n, 1)) /* few do */
          for (int x = left; x < left + n; x++)
            if (CELD_AT (step, x, y) && is_largest (step, x, y))
              CELD_AT (luma, x, y) = 0;
      }
}
