/* Solid areas of a coloured drawing in the colour of its lines, as a black wing.  They are fills, and so are their
 * narrow parts, which would be thick strokes by themselves.
 *
 * What is too wide for a stroke is an area.  So is all that hangs on one, but thin lines.
 *
 * Cost: O(pixels), for each bend of the narrow parts at most.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/coloured-steps.h"

#include <stdlib.h>

#define LINE_FROM 128 /* of 255: the least strength of a thin line, from which on it is ink */
#define ALIKE     8   /* of 255: how far channels of one colour differ; chosen */
#define DEEP      4   /* pixels of the side of a square that an area has at least; chosen */

enum { NONE, STROKE, AREA }; /* what a pixel of `thick` is */

typedef struct
{
  const CeldMask      *channel; /* red, green, blue */
  const CeldLineTones *tones;
  const CeldMask      *strength;
  CeldMask            *thick;
} Strokes;

static bool
is_inside (const Strokes *s, int x, int y)
{
  return x >= 0 && y >= 0 && x < s->thick->width && y < s->thick->height;
}

/* Is (u,v) of no line, with the colour that (x,y) has? */
static bool
is_alike (const Strokes *s, int x, int y, int u, int v)
{
  bool alike = is_inside (s, u, v) && !CELD_AT (s->thick, u, v) && CELD_AT (s->strength, u, v) < LINE_FROM;

  for (int c = 0; c < 3 && alike; c++)
    alike = abs (CELD_AT (&s->channel[c], x, y) - CELD_AT (&s->channel[c], u, v)) <= ALIKE;
  return alike;
}

/* Whether an area begins next to a pixel of a thick stroke, in direction dx,dy: a square of pixels that are of no line and
 * have its colour.  A row of them may be antialiased pixels along an edge. */
static bool
is_area (const Strokes *s, int x, int y, int dx, int dy)
{
  for (int i = 1; i <= DEEP; i++)
    for (int k = 1; k <= DEEP; k++)
      if (!is_alike (s, x, y, x + (dx ? dx * i : i - DEEP / 2), y + (dy ? dy * k : k - DEEP / 2)))
        return false;
  return true;
}

/* Takes pixels out of thick strokes that have not the tone of lines. */
static void
keep_strokes (const Strokes *s)
{
  size_t n = (size_t) s->thick->width * (size_t) s->thick->height;

  for (size_t i = 0, piece; i < n; i += piece)
    {
      piece = n - i < CELD_PIECE ? n - i : CELD_PIECE;
      if (celd_any_byte_reaches (s->thick->data + i, piece, STROKE)) /* few do */
        for (size_t k = i; k < i + piece; k++)
          if (s->thick->data[k] && !celd_is_line_tone (s->tones, s->channel, k))
            s->thick->data[k] = NONE;
    }
}

static bool
is_marked (const Strokes *s, int x, int y)
{
  return is_inside (s, x, y) && CELD_AT (s->thick, x, y) == AREA;
}

/* Whether a pixel touches an area; with `all` also one that is not marked. */
static bool
touches_area (const Strokes *s, int x, int y, bool all)
{
  for (int dy = -1; dy <= 1; dy++)
    for (int dx = -1; dx <= 1; dx++)
      if (is_marked (s, x + dx, y + dy) || (all && is_area (s, x, y, dx, dy)))
        return true;
  return false;
}

/* Marks pixels of strokes, and not of thin lines, that touch an area, in reading order or from the last to the first;
 * whether there are any. */
static bool
mark_areas (const Strokes *s, bool all, bool backwards)
{
  int  width = s->thick->width, height = s->thick->height;
  bool any = false;

  for (int row = 0; row < height; row++)
    for (int first = 0, n; first < width; first += n)
      {
        int y = backwards ? height - 1 - row : row, left;

        n = celd_piece_at (first, width);
        left = backwards ? width - first - n : first;
        if (celd_any_byte_reaches (&CELD_AT (s->thick, left, y), (size_t) n, STROKE)) /* few do */
          for (int i = 0; i < n; i++)
            {
              int x = backwards ? left + n - 1 - i : left + i;

              if (CELD_AT (s->thick, x, y) == STROKE && CELD_AT (s->strength, x, y) < LINE_FROM &&
                  touches_area (s, x, y, all))
                {
                  CELD_AT (s->thick, x, y) = AREA;
                  any = true;
                }
            }
      }
  return any;
}

void
celd_leave_solid_areas (const CeldMask channel[3], const CeldLineTones *tones, const CeldMask *strength,
                        CeldMask *thick)
{
  Strokes s = { channel, tones, strength, thick };
  size_t  n = (size_t) thick->width * (size_t) thick->height;
  bool    backwards = true;

  keep_strokes (&s);
  for (bool more = mark_areas (&s, true, false); more; backwards = !backwards)
    more = mark_areas (&s, false, backwards);
  for (size_t i = 0; i < n; i++)
    thick->data[i] = thick->data[i] == STROKE;
}
