/* Flat colourings whose fills have gradients, and those that have none.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "celdepth.h"

enum { SIDE = 140 };

static uint8_t  art_of[SIDE * SIDE * 4];
static uint32_t seed_of[SIDE * SIDE];

static CeldPalette palette;

static void
put (int x, int y, float red, float green, float blue)
{
  uint8_t *pixel = art_of + 4 * (y * SIDE + x);

  pixel[0] = (uint8_t) (red + 0.5f);
  pixel[1] = (uint8_t) (green + 0.5f);
  pixel[2] = (uint8_t) (blue + 0.5f);
  pixel[3] = 255;
}

static void
read_flats (void)
{
  CeldPaint    art = { SIDE, SIDE, SIDE, art_of };
  CeldLabels   seeds = { SIDE, SIDE, SIDE, seed_of };
  CeldSettings settings = celd_settings ();

  settings.flats = true;
  palette = (CeldPalette) { 0 };
  CHECK (celd_scribbles_read (&art, &settings, NULL, &seeds, &palette) == CELD_OK);
}

static float
share (float distance)
{
  return fminf (fmaxf (0.5f - distance, 0), 1);
}

/* A disc with a black line around it on white; its fill goes from one colour to another, along a direction or
 * outwards. */
static void
draw_disc (float dx, float dy, bool radial)
{
  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      {
        float u = (float) x - 69.7f, v = (float) y - 70.2f, r = hypotf (u, v);
        float t = radial ? r / 50 : 0.5f + (u * dx + v * dy) / 100, line = share (fabsf (r - 50) - 2);
        float fill = share (r - 50), tone[3];

        t = fminf (fmaxf (t, 0), 1);
        tone[0] = fill * (255 - 55 * t) + (1 - fill) * 255;
        tone[1] = fill * (240 - 140 * t) + (1 - fill) * 255;
        tone[2] = fill * (200 - 170 * t) + (1 - fill) * 255;
        put (x, y, (1 - line) * tone[0], (1 - line) * tone[1], (1 - line) * tone[2]);
      }
}

static void
gradients_are_one_label (void)
{
  static const float way[][2] = { { 1, 0 }, { 0, 1 }, { 0.6f, 0.8f }, { -0.8f, 0.6f } };

  for (int i = 0; i < 5; i++)
    {
      uint32_t inside, page;
      int      wrong = 0;

      draw_disc (way[i % 4][0], way[i % 4][1], i == 4);
      read_flats ();
      inside = seed_of[70 * SIDE + 70];
      page = seed_of[5 * SIDE + 5];
      for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
          {
            float r = hypotf ((float) x - 69.7f, (float) y - 70.2f);

            wrong += (r < 45 && seed_of[y * SIDE + x] != inside) || (r > 55 && seed_of[y * SIDE + x] != page);
          }
      CHECK (inside && page && inside != page && wrong == 0);
      CHECK (palette.n == 3); /* with the line */
      celd_palette_clear (&palette);
    }
}

static void
fills_side_by_side_stay_two (void)
{
  for (int tilt = 0; tilt <= 10; tilt++)
    {
      float    dx = cosf (0.15f * (float) tilt), dy = sinf (0.15f * (float) tilt);
      uint32_t left, right;
      int      wrong = 0;

      for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
          {
            float part = share (((float) x - 70.3f) * dx + ((float) y - 69.6f) * dy);

            put (x, y, 200 - 30 * part, 120 + 20 * part, 90 + 10 * part);
          }
      read_flats ();
      left = seed_of[0];
      right = seed_of[SIDE * SIDE - 1];
      for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
          {
            float    beyond = ((float) x - 70.3f) * dx + ((float) y - 69.6f) * dy;
            uint32_t label = seed_of[y * SIDE + x];

            wrong += (beyond < -1 && label != left) || (beyond > 1 && label != right);
          }
      CHECK (left && right && left != right && wrong == 0 && palette.n == 2);
      celd_palette_clear (&palette);
    }
}

/* A picture of labels keeps them all, also near colours and small pieces. */
static void
labels_stay (void)
{
  int wrong = 0;

  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      put (x, y, x / 3 == 10 && y / 3 == 10 ? 0 : 100 + 5 * (float) (x / 20), 80, 200 - 6 * (float) (y / 20));
  read_flats ();
  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      {
        uint32_t label = seed_of[y * SIDE + x];

        wrong += !label || memcmp (palette.item[label - 1].colour, art_of + 4 * (y * SIDE + x), 3);
      }
  CHECK (palette.n == 50 && wrong == 0);
  celd_palette_clear (&palette);
}

int
main (void)
{
  RUN (gradients_are_one_label);
  RUN (fills_side_by_side_stay_two);
  RUN (labels_stay);
  return DONE;
}
