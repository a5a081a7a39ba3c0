/* Values that are extended: constants and ramps go on, what is known stays, and results lie in the range of it.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "image/image.h"

#define MOST_SIDE 70
#define PIXELS    (MOST_SIDE * MOST_SIDE)

typedef struct { int width, height, lanes; uint8_t known[PIXELS]; float value[4 * PIXELS]; } Picture;

static float
random_value (uint32_t *state)
{
  return (float) check_random (state, 10001) / 10000 - 0.3f;
}

/* Known in so many of a thousand pixels, but for a box where nothing is; values elsewhere are not numbers. */
static void
make_random (uint32_t *state, Picture *p)
{
  uint32_t share = 1 + check_random (state, 1000);
  bool     long_and_thin = !check_random (state, 4);
  int      left, top, right, bottom;

  p->width  = 1 + (int) check_random (state, MOST_SIDE);
  p->height = long_and_thin ? 1 : 1 + (int) check_random (state, MOST_SIDE);
  p->lanes  = 1 + (int) check_random (state, 4);
  left      = (int) check_random (state, (uint32_t) p->width);
  top       = (int) check_random (state, (uint32_t) p->height);
  right     = left + (int) check_random (state, (uint32_t) p->width);
  bottom    = top + (int) check_random (state, (uint32_t) p->height);
  for (int i = 0; i < p->width * p->height; i++)
    {
      int x = i % p->width, y = i / p->width;

      p->known[i] = check_random (state, 1000) < share && !(x >= left && x < right && y >= top && y < bottom);
      for (int c = 0; c < p->lanes; c++)
        p->value[p->lanes * i + c] = p->known[i] ? random_value (state) : NAN;
    }
}

/* What is known stays; what is not lies in the range of what is, and is 0 if nothing is. */
static void
random_values_stay_in_range (void)
{
  static Picture p, before;
  uint32_t       state = 1;

  for (int round = 0; round < 2000; round++)
    {
      float least[4] = { INFINITY, INFINITY, INFINITY, INFINITY };
      float most[4] = { -INFINITY, -INFINITY, -INFINITY, -INFINITY };
      bool  any = false;

      make_random (&state, &p);
      before = p;
      CHECK (celd_extend (p.width, p.height, p.lanes, p.known, p.value) == CELD_OK);
      CHECK (!memcmp (p.known, before.known, sizeof p.known));
      for (int i = 0; i < p.width * p.height; i++)
        for (int c = 0; c < p.lanes && p.known[i]; c++)
          {
            float value = before.value[p.lanes * i + c];

            any = true;
            least[c] = fminf (least[c], value);
            most[c] = fmaxf (most[c], value);
            CHECK (p.value[p.lanes * i + c] == value);
          }
      for (int i = 0; i < p.width * p.height; i++)
        for (int c = 0; c < p.lanes; c++)
          {
            float value = p.value[p.lanes * i + c];

            if (any)
              CHECK (value >= least[c] - 1e-6f && value <= most[c] + 1e-6f);
            else
              CHECK (value >= 0 && value <= 0);
          }
    }
}

/* To the last bit, also where most of the picture is unknown. */
static void
constants_stay_constant (void)
{
  static Picture p;
  uint32_t       state = 2;

  for (int round = 0; round < 1000; round++)
    {
      float colour[4];
      bool  any = false;

      for (int c = 0; c < 4; c++)
        colour[c] = (float) check_random (&state, 1 << 24) / 3e5f;
      make_random (&state, &p);
      for (int i = 0; i < p.width * p.height; i++)
        for (int c = 0; c < p.lanes; c++)
          {
            any |= p.known[i];
            p.value[p.lanes * i + c] = p.known[i] ? colour[c] : NAN;
          }
      CHECK (celd_extend (p.width, p.height, p.lanes, p.known, p.value) == CELD_OK);
      for (int i = 0; i < p.width * p.height && any; i++)
        CHECK (!memcmp (p.value + p.lanes * i, colour, (size_t) p.lanes * sizeof *colour));
    }
}

/* Lanes do not mix. */
static void
lanes_are_independent (void)
{
  static Picture p, one;
  uint32_t       state = 3;

  for (int round = 0; round < 200; round++)
    {
      make_random (&state, &p);
      for (int lane = 0; lane < p.lanes; lane++)
        {
          one = p;
          for (int i = 0; i < p.width * p.height; i++)
            one.value[i] = p.value[p.lanes * i + lane];
          CHECK (celd_extend (p.width, p.height, 1, one.known, one.value) == CELD_OK);
          if (lane == 0)
            CHECK (celd_extend (p.width, p.height, p.lanes, p.known, p.value) == CELD_OK);
          for (int i = 0; i < p.width * p.height; i++)
            CHECK (one.value[i] == p.value[p.lanes * i + lane]);
        }
    }
}

/* Of a ramp in any direction, inside a hole of a size; the error as a share of the range of the picture. */
static double
ramp_error (int side, double dx, double dy, double radius)
{
  static Picture p;
  double         worst = 0, range = (fabs (dx) + fabs (dy)) * side;

  p.width = p.height = side;
  for (int i = 0; i < side * side; i++)
    {
      int x = i % side, y = i / side;

      p.known[i] = hypot (x - (side - 1) / 2.0, y - (side - 1) / 2.0) > radius;
      p.value[i] = p.known[i] ? (float) (dx * x + dy * y) : NAN;
    }
  CHECK (celd_extend (side, side, 1, p.known, p.value) == CELD_OK);
  for (int i = 0; i < side * side; i++)
    worst = fmax (worst, fabs ((double) p.value[i] - dx * (i % side) - dy * (i / side)) / range);
  return worst;
}

static void
ramps_go_on_across_a_hole (void)
{
  for (int side = 16; side <= MOST_SIDE; side += 9)
    for (double angle = 0; angle < 6; angle += 0.37)
      CHECK (ramp_error (side, cos (angle), sin (angle), 0.35 * side) < 0.02);
}

/* Between two colours side by side there is one smooth step, not beyond either. */
static void
one_row_goes_from_one_colour_to_the_other (void)
{
  float   value[40] = { 0 };
  uint8_t known[40] = { 0 };

  for (int x = 0; x < 40; x++)
    value[x] = NAN;
  known[4] = known[35] = 1;
  value[4] = 2;
  value[35] = 5;
  CHECK (celd_extend (40, 1, 1, known, value) == CELD_OK);
  for (int x = 1; x < 40; x++)
    CHECK (value[x] >= value[x - 1] - 0.1f && value[x] >= 2 && value[x] <= 5);
  CHECK (value[0] < 2.5f && value[39] > 4.5f);
}

static void
single_pixels (void)
{
  uint8_t known = 1;
  float   value[4] = { 1, 2, 3, 4 };

  CHECK (celd_extend (1, 1, 4, &known, value) == CELD_OK);
  CHECK (value[0] == 1 && value[1] == 2 && value[2] == 3 && value[3] == 4);
  known = 0;
  CHECK (celd_extend (1, 1, 4, &known, value) == CELD_OK);
  CHECK (value[0] == 0 && value[1] == 0 && value[2] == 0 && value[3] == 0);
}

int
main (void)
{
  RUN (random_values_stay_in_range);
  RUN (constants_stay_constant);
  RUN (lanes_are_independent);
  RUN (ramps_go_on_across_a_hole);
  RUN (one_row_goes_from_one_colour_to_the_other);
  RUN (single_pixels);
  return DONE;
}
