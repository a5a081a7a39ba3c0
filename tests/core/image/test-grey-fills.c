/* Drawings with flat fills in greys or pale colours are coloured ones; line art, uneven light and grain are not.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "discs.h"

static void
line_art_stays (void)
{
  const Tone cream = { 1, 0.95f, 0.8f };

  draw (white, white, white, (Tone) { 0, 0, 0 });
  CHECK (find (CELD_INK_AUTO, NULL) == CELD_OK && unchanged ());
  draw (cream, cream, cream, brown);
  CHECK (find (CELD_INK_AUTO, NULL) == CELD_OK && unchanged ());
  draw (white, yellow, blue, brown);
  CHECK (find (CELD_INK_DARK, NULL) == CELD_OK && unchanged ());
  CHECK (find (CELD_INK_LIGHT, NULL) == CELD_OK && unchanged ());
  for (int i = 0; i < SIDE * SIDE; i++)
    art_of[4 * i + 3] = (uint8_t) (255 * line_at (i % SIDE, i / SIDE)); /* lines on a transparent layer */
  CHECK (find (CELD_INK_AUTO, NULL) == CELD_OK && unchanged ());
}

/* Flat greys are fills; uneven light and grain are none. */
static void
grey_fills_are_paper (void)
{
  const Tone black = { 0.05f, 0.05f, 0.05f }, light = { 0.8f, 0.8f, 0.8f }, dark = { 0.55f, 0.55f, 0.55f };
  uint32_t   state = 1;

  draw (white, light, dark, black);
  CHECK (find (CELD_INK_AUTO, NULL) == CELD_OK && worst () < 0.35f);
  draw (dark, white, light, black);
  CHECK (find (CELD_INK_AUTO, NULL) == CELD_OK && worst () < 0.35f);
  for (int turn = 0; turn < 2; turn++)
    {
      for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
          {
            float shade = turn ? 1 - 0.4f * (float) x / SIDE : inside (x, y, 100, 100, 80) ? 0.7f : 1;

            state = state * 1664525u + 1013904223u;
            shade -= turn ? 0 : 0.05f * (float) (state >> 16) / 65536;
            put (x, y, mixed (black, (Tone) { shade, shade, shade }, 1 - line_at (x, y)));
          }
      CHECK (find (CELD_INK_AUTO, NULL) == CELD_OK && unchanged ());
    }
}

/* A small drawing in pale colours on a large page; the second is pale in red and blue only. */
static void
few_fills_are_paper (void)
{
  static const Tone pale[2] = { { 0.85f, 0.88f, 1 }, { 0.85f, 0.96f, 0.8f } };
  const Tone        black = { 0.05f, 0.05f, 0.05f };

  for (int turn = 0; turn < 2; turn++)
    {
      int dark = 0;

      for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
          put (x, y, mixed (inside (x, y, 100, 100, 20) ? pale[turn] : white, black, ring (x, y, 100, 100, 20)));
      CHECK (find (CELD_INK_AUTO, NULL) == CELD_OK);
      for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
          dark += inside (x, y, 100, 100, 15) && luma_of[y * SIDE + x] < 0.95f;
      NEAR (dark, 0, 0);
      CHECK (luma_of[100 * SIDE + 80] < 0.1f);
    }
}

int
main (void)
{
  RUN (line_art_stays);
  RUN (grey_fills_are_paper);
  RUN (few_fills_are_paper);
  return DONE;
}
