/* Padding: under transparency lies the colour of the nearest opaque pixel, as far as asked for.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "base/base.h"

#define W 40
#define H 30

static const float blank[3] = { 0.5f, 0.5f, 1 };

/* Two opaque blots of their own colours, with a half transparent rim of another one. */
static void
draw (CeldColours *picture)
{
  for (int y = 0; y < H; y++)
    for (int x = 0; x < W; x++)
      {
        double one = hypot (x - 10, y - 15), other = hypot (x - 28, y - 15), r = fmin (one, other);
        float *rgba = CELD_RGBA (picture, x, y);

        rgba[0] = r < 5 ? (one < other ? 0.1f : 0.9f) : 7;
        rgba[1] = rgba[2] = r < 5 ? 0.3f : 7;
        rgba[3] = r < 5 ? 1 : r < 6 ? 0.3f : 0;
      }
}

static void
the_nearest_colour_runs_on (void)
{
  float      *data = malloc (4 * (W + 3) * H * sizeof *data);
  CeldColours picture = { W, H, W + 3, data };

  for (int reach = 0; reach < 12; reach += 3)
    {
      draw (&picture);
      CHECK (celd_pad_colours (reach, blank, NULL, &picture) == CELD_OK);
      for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++)
          {
            double       one = hypot (x - 10, y - 15), other = hypot (x - 28, y - 15), r = fmin (one, other);
            const float *rgba = CELD_RGBA (&picture, x, y);

            NEAR (rgba[3], r < 5 ? 1 : r < 6 ? 0.3 : 0, 1e-6);
            if (r < 5 || (r < 4 + reach && fabs (one - other) > 3))
              NEAR (rgba[0], one < other ? 0.1 : 0.9, 1e-6);
            if (r > 6 + reach)
              NEAR (rgba[2], 1, 0);
          }
    }
  free (data);
}

static void
what_is_opaque_or_half_seen_stays (void)
{
  float       data[4 * 3] = { 1, 2, 3, 1, 4, 5, 6, 0.5f, 7, 8, 9, 0.4f };
  CeldColours picture = { 3, 1, 3, data };

  CHECK (celd_pad_colours (0, blank, NULL, &picture) == CELD_OK);
  NEAR (data[8], 7, 0);
  NEAR (data[4], 4, 0);
  CHECK (celd_pad_colours (1, blank, NULL, &picture) == CELD_OK);
  NEAR (data[8], 4, 0);
  NEAR (data[4], 4, 0);
  NEAR (data[0], 1, 0);
}

static void
bad_input_does_no_harm (void)
{
  float       data[8] = { 1, 1, 1, NAN, 2, 2, 2, 0 };
  CeldColours picture = { 2, 1, 2, data };

  CHECK (celd_pad_colours (4, blank, NULL, &(CeldColours) { 2, 0, 2, data }) == CELD_BAD_SIZE);
  CHECK (celd_pad_colours (-1, blank, NULL, &picture) == CELD_BAD_VALUE);
  CHECK (celd_pad_colours (INT32_MAX, blank, NULL, &picture) == CELD_OK); /* nothing is opaque */
  NEAR (data[4], 0.5, 0);
}

int
main (void)
{
  RUN (the_nearest_colour_runs_on);
  RUN (what_is_opaque_or_half_seen_stays);
  RUN (bad_input_does_no_harm);
  return DONE;
}
