/* Matcaps: read by the normal, never beside the ball, with the middle of the ball in place of the art's colour.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "light/light.h"

typedef struct { double tone[3], gloss; } Lit;

static Lit
light_one (const CeldColours *matcap, float x, float y, float z)
{
  CeldSettings settings = celd_settings ();
  CeldVectors  normals = { 1, 1, 1, (float[3]) { x, y, z } };
  CeldLamp     lamp = celd_lamp (&normals, &settings);
  Lit          lit;

  lamp.matcap = matcap;
  celd_matcap_at (&lamp, 0, 0, lit.tone, &lit.gloss);
  return lit;
}

/* What art of the colour in the middle of the ball looks like. */
static double
like_the_ball (const Lit *lit, int c, double middle)
{
  return (1 - lit->gloss) * middle * lit->tone[c] + lit->gloss;
}

/* A ball that is red at the right, green at the top and dark blue; beside it any colour, that is, magenta. */
static CeldColours
coloured_ball (int side)
{
  CeldColours ball = { side, side, (size_t) side, malloc ((size_t) (4 * side * side) * sizeof (float)) };

  for (int y = 0; y < side; y++)
    for (int x = 0; x < side; x++)
      {
        double u = (x + 0.5) / side, v = (y + 0.5) / side;
        bool   inside = hypot (fabs (x + 0.5 - 0.5 * side) + 0.5, fabs (y + 0.5 - 0.5 * side) + 0.5) <= 0.5 * side;
        float  in[4] = { (float) u, (float) (1 - v), 0.25f, 1 }, beside[4] = { 50, 0, 50, 1 };

        memcpy (CELD_RGBA (&ball, x, y), inside ? in : beside, sizeof in);
      }
  return ball;
}

static void
a_ball_is_read_by_the_normal (void)
{
  CeldColours ball = coloured_ball (64);

  for (int k = 0; k < 50; k++)
    {
      float x = 0.9f * cosf ((float) k), y = 0.9f * sinf ((float) k);
      Lit   lit = light_one (&ball, x, y, sqrtf (1 - x * x - y * y));

      NEAR (like_the_ball (&lit, 0, 0.5), 0.5 + 0.5 * (double) x, 2e-3);
      NEAR (like_the_ball (&lit, 1, 0.5), 0.5 + 0.5 * (double) y, 2e-3);
      NEAR (like_the_ball (&lit, 2, 0.25), 0.25, 1e-6);
    }
  free (ball.data);
}

/* Nor what is mixed with it along the outline: each pixel that counts lies wholly within the ball. */
static void
what_is_beside_the_ball_is_not_read (void)
{
  for (int side = 1; side <= 200; side += side < 20 ? 1 : 45)
    {
      CeldColours ball = coloured_ball (side);

      for (int k = 0; k < 720; k++)
        {
          float angle = (float) k * CELD_PI / 360;
          Lit   lit = light_one (&ball, cosf (angle), sinf (angle), 0);

          NEAR (lit.tone[2], 1, 1e-6); /* magenta would be brighter */
          CHECK (side < 40 || k != 0 || lit.tone[0] > 1.8);
        }
      free (ball.data);
    }
}

/* Any colour in the middle, black and white, too. */
static void
what_faces_the_viewer_keeps_its_colour (void)
{
  for (int k = 0; k < 125; k++)
    {
      float       colour[4 * 16];
      CeldColours ball = { 4, 4, 4, colour };
      Lit         lit;

      for (int i = 0; i < 16; i++)
        memcpy (colour + 4 * i, (float[4]) { (float) (k % 5) / 4, (float) (k / 5 % 5) / 4, (float) (k / 25) / 4, 1 },
                4 * sizeof (float));
      lit = light_one (&ball, 0, 0, 1);
      CHECK (lit.tone[0] == 1 && lit.tone[1] == 1 && lit.tone[2] == 1 && lit.gloss == 0);
      lit = light_one (&ball, NAN, INFINITY, 0);
      CHECK (lit.tone[0] == 1 && lit.gloss == 0);
    }
}

/* A red ball with a white highlight at the right and a dark left side. */
static void
highlights_are_gloss_and_shadows_tone (void)
{
  static const float colours[3][4] = { { 0.2f, 0.01f, 0.01f, 1 }, { 0.8f, 0.05f, 0.05f, 1 }, { 1, 0.9f, 0.9f, 1 } };
  float              colour[4 * 30 * 30];
  CeldColours        ball = { 30, 30, 30, colour };
  Lit                lit;

  for (int i = 0; i < 900; i++)
    memcpy (colour + 4 * i, colours[i % 30 / 10], sizeof colours[0]);
  lit = light_one (&ball, -0.8f, 0, 0.6f);
  NEAR (lit.gloss, 0, 0);
  NEAR (lit.tone[0], 0.25, 1e-2);
  NEAR (lit.tone[1], 0.2, 2e-2);
  lit = light_one (&ball, 0.8f, 0, 0.6f);
  CHECK (lit.gloss > 0.8);
  for (int c = 0; c < 3; c++)
    {
      CHECK (lit.tone[c] >= 1 && lit.tone[c] <= CELD_MOST_TONE);
      NEAR (like_the_ball (&lit, c, (double) colours[1][c]), colours[2][c], 1e-2);
    }
}

int
main (void)
{
  RUN (a_ball_is_read_by_the_normal);
  RUN (what_is_beside_the_ball_is_not_read);
  RUN (what_faces_the_viewer_keeps_its_colour);
  RUN (highlights_are_gloss_and_shadows_tone);
  return DONE;
}
