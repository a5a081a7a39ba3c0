/* Grey bands between two lines become paper; edges, ends, even lines and grain within strokes stay ink.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "image/ink-steps.h"

#include <string.h>

enum { SIDE = 64 };

static float   ink_of[SIDE * SIDE];
static uint8_t between_of[SIDE * SIDE];

/* Ink values of the signs of a picture: # ink, % nearly black, o dark grey, + just paper, . paper. */
static float
value_of (char sign)
{
  return sign == '#' ? 0 : sign == '%' ? 0.1f : sign == 'o' ? 0.3f : sign == '+' ? 0.5f : 1;
}

/* The sign of a row at a pixel that is moved by `shift`; paper beyond. */
static char
sign_at (const char *row, int x, int shift)
{
  int at = x - shift;

  return at >= 0 && at < (int) strlen (row) ? row[at] : '.';
}

/* Whether lines are parted so that a row, repeated so often and moved by `slant` each time, becomes another one. */
static bool
becomes (const char *row, const char *expected, int rows, int slant)
{
  int       width = (int) strlen (row) + rows * slant, wrong = 0;
  CeldPlane ink = { width, rows, (size_t) width, ink_of };
  CeldMask  between = { width, rows, (size_t) width, between_of };

  for (int y = 0; y < rows; y++)
    for (int x = 0; x < width; x++)
      CELD_AT (&ink, x, y) = value_of (sign_at (row, x, y * slant));
  CHECK (celd_ink_part_lines (&ink, &between) == CELD_OK);
  for (int y = 0; y < rows; y++)
    for (int x = 0; x < width; x++)
      wrong += CELD_AT (&ink, x, y) != value_of (sign_at (expected, x, y * slant));
  return wrong == 0;
}

static void
grey_bands_become_paper (void)
{
  for (int slant = 0; slant < 2; slant++)
    {
      CHECK (becomes (".#o#.", ".#+#.", 20, slant));
      CHECK (becomes (".o##oo##o.", ".o##++##o.", 20, slant));
    }
}

/* Grain of chalk has light spots within a stroke. */
static void
short_bands_stay_ink (void)
{
  CHECK (becomes (".#o#.", ".#o#.", 8, 0));
  CHECK (becomes (".##o##.", ".##o##.", 3, 1));
}

static void
lines_stay_ink (void)
{
  for (int slant = 0; slant < 2; slant++)
    {
      CHECK (becomes (".o#o.", ".o#o.", 20, slant));
      CHECK (becomes (".##o.", ".##o.", 20, slant));
      CHECK (becomes (".#%#.", ".#%#.", 20, slant));
      CHECK (becomes (".#ooooooooo", ".#ooooooooo", 20, slant));
    }
}

int
main (void)
{
  RUN (grey_bands_become_paper);
  RUN (short_bands_stay_ink);
  RUN (lines_stay_ink);
  return DONE;
}
