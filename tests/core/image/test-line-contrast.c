/* Contrast and strength of lines, as bytes, against their definitions by fractions of whole numbers.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "image/coloured-steps.h"

enum { MOST = 200 };

static uint8_t
next (uint32_t *seed)
{
  *seed = *seed * 1664525u + 1013904223u;
  return (uint8_t) (*seed >> 24);
}

/* Rounded to the nearest, halves up; the other contrast is kept where it is larger. */
static void
contrast_against_closing (void)
{
  uint8_t  value[MOST] = { 0 }, closed[MOST] = { 0 }, contrast[MOST] = { 0 }, before[MOST];
  uint32_t seed = 3;

  for (size_t n = 0; n <= MOST; n++)
    {
      int wrong = 0;

      for (size_t i = 0; i < n; i++)
        {
          closed[i] = next (&seed);
          value[i] = (uint8_t) (n % 3 && i % 64 < 40 ? closed[i] : closed[i] * next (&seed) / 255);
          contrast[i] = before[i] = next (&seed);
        }
      celd_raise_contrast (value, closed, n, contrast);
      for (size_t i = 0; i < n; i++)
        {
          int paper = closed[i] > 64 ? closed[i] : 64, own = (510 * (closed[i] - value[i]) + paper) / (2 * paper);

          wrong += contrast[i] != (own > before[i] ? own : before[i]);
        }
      CHECK (wrong == 0);
    }
}

/* A share of the core's contrast, rounded down; without a core only what has half of the contrast of black stays. */
static void
strength_by_core (void)
{
  uint8_t  contrast[MOST] = { 0 }, level[MOST] = { 0 }, core[MOST];
  uint32_t seed = 5;

  for (size_t n = 0; n <= MOST; n++)
    {
      int wrong = 0, faintest = 20 + (int) n;

      for (size_t i = 0; i < n; i++)
        {
          contrast[i] = i % 100 < 50 ? 0 : next (&seed);
          level[i] = core[i] = i % 3 ? next (&seed) : 0;
        }
      celd_line_strengths (contrast, faintest, n, level);
      for (size_t i = 0; i < n; i++)
        {
          int c = contrast[i], least = faintest > 128 ? faintest : 128;
          int right = core[i] ? c < core[i] ? 255 * c / core[i] : 255 : c < least ? 0 : c;

          wrong += level[i] != right;
        }
      CHECK (wrong == 0);
    }
}

static void
largest_byte (void)
{
  uint8_t value[MOST] = { 0 };

  CHECK (!celd_any_byte_reaches (value, 0, 1) && !celd_any_byte_reaches (value, MOST, 1));
  for (size_t i = 0; i < MOST; i++)
    {
      value[i] = 200;
      CHECK (celd_any_byte_reaches (value, i + 1, 200) && !celd_any_byte_reaches (value, i + 1, 201));
      CHECK (!celd_any_byte_reaches (value, i, 1));
      value[i] = 0;
    }
}

int
main (void)
{
  RUN (contrast_against_closing);
  RUN (strength_by_core);
  RUN (largest_byte);
  return DONE;
}
