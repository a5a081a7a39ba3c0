/* Marks: seen on any ground, where the problem is, and nowhere else.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "base/base.h"

#define W 80
#define H 60

static uint8_t   pixels[4 * W * H];
static CeldPaint paint = { W, H, W, pixels };

static void
fill (uint8_t grey, uint8_t alpha)
{
  for (int i = 0; i < W * H; i++)
    memcpy (pixels + 4 * i, (uint8_t[]) { grey, grey, grey, alpha }, 4);
}

static void
mark (int x, int y)
{
  CeldProblem problem = { .kind = CELD_PROBLEM_REGION_UNREACHED, .x = x, .y = y, .relation = CELD_NO_INDEX };

  celd_problems_paint (&(CeldProblems) { .item = &problem, .n = 1 }, &paint);
}

static bool
is_red (int x, int y)
{
  const uint8_t *p = CELD_RGBA (&paint, x, y);

  return p[0] > 200 && p[1] < 60 && p[2] < 60 && p[3] == 255;
}

/* From the place to the right: a red dot, something else, red again, white, the ground. */
static void
a_ring_round_a_dot (void)
{
  static const uint8_t grounds[] = { 0, 128, 255 };

  for (size_t i = 0; i < 3; i++)
    {
      int x = 40, ring;

      fill (grounds[i], 255);
      mark (40, 30);
      CHECK (is_red (40, 30));
      while (x < W && is_red (x, 30))
        x++;
      while (x < W && !is_red (x, 30))
        x++;
      ring = x - 40;
      CHECK (ring >= 3 && ring <= 8);
      CHECK (is_red (40 - ring, 30) && is_red (40, 30 - ring) && is_red (40, 30 + ring));
      while (x < W && is_red (x, 30))
        x++;
      CHECK (CELD_RGBA (&paint, x, 30)[0] > 180 && CELD_RGBA (&paint, x, 30)[1] > 120); /* into white */
      CHECK (CELD_RGBA (&paint, 55, 30)[1] == grounds[i] && CELD_RGBA (&paint, 40, 48)[1] == grounds[i]);
    }
}

static void
on_transparent_ground (void)
{
  fill (0, 0);
  mark (40, 30);
  CHECK (is_red (40, 30));
  CHECK (CELD_RGBA (&paint, 60, 30)[3] == 0);
}

static void
cut_at_the_frame (void)
{
  fill (255, 255);
  mark (0, 0);
  mark (W - 1, H - 1);
  CHECK (is_red (0, 0) && is_red (W - 1, H - 1));
  CHECK (CELD_RGBA (&paint, 40, 30)[1] == 255);
}

static void
nothing_without_a_place (void)
{
  fill (255, 255);
  mark (-1, -1);
  celd_problems_paint (&(CeldProblems) { 0 }, &paint);
  for (int i = 0; i < 4 * W * H; i++)
    CHECK (pixels[i] == 255);
}

/* The paint of an unclear arrow in place of a ring, whatever was there, as far as it lies in the picture. */
static void
paint_in_place_of_a_ring (void)
{
  CeldProblem  item[2] = { { .kind = CELD_PROBLEM_ARROW_UNCLEAR, .x = 41, .y = 30, .first = 0, .runs = 3 },
                           { .kind = CELD_PROBLEM_ARROW_UNCLEAR, .x = 70, .y = 9, .first = 3, .runs = 1 } };
  CeldPaintRun run[4] = { { 40, 30, 3 }, { 41, 31, 1 }, { W - 2, 32, 5 }, { 70, 9, 1 } };

  fill (128, 128);
  celd_problems_paint (&(CeldProblems) { .item = item, .n = 2, .run = run, .n_runs = 4 }, &paint);
  for (int y = 0; y < H; y++)
    for (int x = 0; x < W; x++)
      {
        bool painted = (y == 30 && x >= 40 && x < 43) || (y == 31 && x == 41) || (y == 32 && x >= W - 2) ||
                       (y == 9 && x == 70);

        CHECK (is_red (x, y) == painted);
        CHECK (painted || !memcmp (CELD_RGBA (&paint, x, y), (uint8_t[]) { 128, 128, 128, 128 }, 4));
      }
}

int
main (void)
{
  RUN (a_ring_round_a_dot);
  RUN (on_transparent_ground);
  RUN (cut_at_the_frame);
  RUN (nothing_without_a_place);
  RUN (paint_in_place_of_a_ring);
  return DONE;
}
