/* The contrast of the lines of a coloured drawing, and their strength: contrast as a share of that of the core of the
 * line.  Pieces where there are no lines, most of them, are passed over.
 *
 * Choices are made apart from divisions: compilers make branches of both together, and no vectors.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/coloured-steps.h"

#include <string.h>

CELD_CLONES static uint8_t
largest_byte (const uint8_t *value, size_t n)
{
  uint8_t most = 0;

  for (size_t i = 0; i < n; i++)
    most = value[i] > most ? value[i] : most;
  return most;
}

bool
celd_any_byte_reaches (const uint8_t *value, size_t n, int least)
{
  return largest_byte (value, n) >= least;
}

CELD_CLONES static void
raise_contrast_of_piece (const uint8_t *restrict value, const uint8_t *restrict closed, size_t n,
                         uint8_t *restrict contrast)
{
  uint8_t paper[CELD_PIECE];

  for (size_t i = 0; i < n; i++)
    paper[i] = closed[i] > CELD_DARKEST_FILL ? closed[i] : CELD_DARKEST_FILL;
  for (size_t i = 0; i < n; i++)
    {
      uint8_t c = (uint8_t) (int) (255 * (float) (closed[i] - value[i]) / (float) paper[i] + 0.5f);

      contrast[i] = c > contrast[i] ? c : contrast[i];
    }
}

void
celd_raise_contrast (const uint8_t *value, const uint8_t *closed, size_t n, uint8_t *contrast)
{
  for (size_t i = 0; i < n; i += CELD_PIECE)
    {
      size_t piece = n - i < CELD_PIECE ? n - i : CELD_PIECE;

      if (memcmp (value + i, closed + i, piece))
        raise_contrast_of_piece (value + i, closed + i, piece, contrast + i);
    }
}

CELD_CLONES static void
find_strengths_of_piece (const uint8_t *restrict contrast, int faintest, size_t n, uint8_t *restrict level)
{
  int     least = faintest > 128 ? faintest : 128;
  uint8_t part[CELD_PIECE], whole[CELD_PIECE];

  for (size_t i = 0; i < n; i++)
    {
      whole[i] = level[i] ? level[i] : 255;
      part[i] = !level[i] && contrast[i] < least ? 0 : contrast[i] < whole[i] ? contrast[i] : whole[i];
    }
  for (size_t i = 0; i < n; i++)
    level[i] = (uint8_t) (int) (255.0f * (float) part[i] / (float) whole[i]);
}

void
celd_line_strengths (const uint8_t *contrast, int faintest, size_t n, uint8_t *level)
{
  for (size_t i = 0; i < n; i += CELD_PIECE)
    {
      size_t piece = n - i < CELD_PIECE ? n - i : CELD_PIECE;

      if (celd_any_byte_reaches (contrast + i, piece, 1))
        find_strengths_of_piece (contrast + i, faintest, piece, level + i);
      else
        memset (level + i, 0, piece);
    }
}
