/* Antialiased lines of one pixel are closed wherever they lie between the pixels.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "celdepth.h"
#include "image/ink-steps.h"

enum { SIDE = 48 };

static float    value[SIDE * SIDE];
static uint32_t inside[SIDE * SIDE];

static CeldPlane
plane (void)
{
  return (CeldPlane) { SIDE, SIDE, SIDE, value };
}

/* Draws a ring of about one pixel on paper, in which ink is `dark`, in 8 bits. */
static void
draw_ring (double x, double y, double radius, double breadth, double dark)
{
  for (int i = 0; i < SIDE * SIDE; i++)
    {
      double distance = fabs (hypot (i % SIDE - x, i / SIDE - y) - radius);
      double cover = fmin (fmax ((breadth + 1) / 2 - distance, 0), breadth);

      value[i] = (float) (round (255 * (1 - (1 - dark) * cover)) / 255);
    }
}

/* Does paper that shares sides lead out of the ring? */
static bool
is_open (void)
{
  int grown = 1;

  for (int i = 0; i < SIDE * SIDE; i++)
    inside[i] = i == SIDE * (SIDE / 2) + SIDE / 2;
  while (grown)
    {
      grown = 0;
      for (int i = SIDE; i < SIDE * (SIDE - 1); i++)
        if (!inside[i] && value[i] >= 0.5f && (inside[i - 1] || inside[i + 1] || inside[i - SIDE] || inside[i + SIDE]))
          inside[i] = grown = 1;
    }
  return inside[SIDE + 1];
}

/* 0 .. most. */
static double
random_in (uint32_t *state, double most)
{
  return most * check_random (state, 10001) / 10000;
}

static void
rings_are_closed (void)
{
  uint32_t state = 3;
  int      open = 0;

  for (int round = 0; round < 200; round++)
    {
      double      x = random_in (&state, 2), y = random_in (&state, 2), radius = 12 + random_in (&state, 8);
      double      breadth = 0.8 + random_in (&state, 0.2), dark = 0.25 * check_random (&state, 3);
      CeldPlane   ink = plane ();
      CeldDrawing page = { .luma = plane () };

      draw_ring (SIDE / 2 + x, SIDE / 2 + y, radius, breadth, dark);
      CHECK (celd_ink (&page, CELD_INK_AUTO, NULL, &ink) == CELD_OK);
      open += is_open ();
    }
  NEAR (open, 0, 0);
}

/* Halves of ink with paper on both sides are joined in the darker pixel; less ink, or ink beside it, stays. */
static void
only_whole_lines_are_joined (void)
{
  static const float row[][8] = {
    { 1, 1, 0.52f, 0.5f, 1, 1, 1, 1 },
    { 1, 1, 0.65f, 0.65f, 1, 1, 1, 1 },
    { 1, 0.8f, 0.52f, 0.5f, 1, 1, 1, 1 },
    { 1, 0.5f, 0.5f, 0.5f, 0.5f, 1, 1, 1 },
    { 0.5f, 0.5f, 1, 1, 1, 1, 0.5f, 0.5f },
    { 1, 1, 0.7f, 0.3f, 1, 1, 1, 1 },
  };

  for (int turned = 0; turned < 2; turned++)
    for (size_t k = 0; k < sizeof row / sizeof *row; k++)
      {
        CeldPlane ink = plane ();

        for (int i = 0; i < SIDE * SIDE; i++)
          value[i] = 1;
        ink.width = turned ? 1 : 8;
        ink.height = turned ? 8 : 1;
        for (int i = 0; i < 8; i++)
          value[turned ? i * SIDE : i] = row[k][i];
        celd_ink_join_hairlines (&ink);
        for (int i = 0; i < 8; i++)
          NEAR (value[turned ? i * SIDE : i], k == 0 && i == 3 ? 0.02f : row[k][i], 1e-6);
      }
}

int
main (void)
{
  RUN (rings_are_closed);
  RUN (only_whole_lines_are_joined);
  return DONE;
}
