/* Distances against brute force over all pairs of pixels.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "image/image.h"

static int32_t
square_between (int width, int p, int q)
{
  int dx = p % width - q % width, dy = p / width - q / width;

  return dx * dx + dy * dy;
}

/* Least squared distance of p to an inside pixel, by trying them all. */
static int32_t
try_all (int width, int height, const uint8_t *inside, int p)
{
  int32_t least = INT32_MAX;

  for (int q = 0; q < width * height; q++)
    if (inside[q] && square_between (width, p, q) < least)
      least = square_between (width, p, q);
  return least;
}

static void
compare (int width, int height, const uint8_t *inside)
{
  size_t   n = (size_t) width * (size_t) height;
  int32_t *plain = malloc (n * sizeof *plain);
  int32_t *squared = malloc (n * sizeof *squared);
  int32_t *nearest = malloc (n * sizeof *nearest);
  int      wrong = 0, not_nearest = 0;

  CHECK (celd_distance (width, height, inside, NULL, plain) == CELD_OK);
  CHECK (celd_nearest (width, height, inside, NULL, squared, nearest) == CELD_OK);
  CHECK (memcmp (plain, squared, n * sizeof *plain) == 0);
  for (int p = 0; p < width * height; p++)
    {
      int32_t wanted = try_all (width, height, inside, p);

      wrong += squared[p] != wanted;
      if (wanted == INT32_MAX)
        not_nearest += nearest[p] != -1;
      else
        not_nearest += nearest[p] < 0 || !inside[nearest[p]] || square_between (width, p, nearest[p]) != wanted;
    }
  CHECK (wrong == 0);
  CHECK (not_nearest == 0);
  free (plain);
  free (squared);
  free (nearest);
}

static void
random_masks (void)
{
  static const int size[][2] = { { 1, 1 }, { 2, 1 }, { 1, 2 }, { 1, 40 }, { 40, 1 }, { 17, 23 }, { 300, 3 }, { 3, 300 },
                                 { 64, 40 } };
  static uint8_t   inside[64 * 64];
  uint32_t         state = 1;

  for (size_t k = 0; k < sizeof size / sizeof *size; k++)
    for (uint32_t rarity = 1; rarity <= 1000; rarity *= 3) /* from all inside to nearly empty */
      {
        for (int p = 0; p < size[k][0] * size[k][1]; p++)
          inside[p] = check_random (&state, rarity) == 0;
        compare (size[k][0], size[k][1], inside);
      }
}

/* Paper and ink at once are the two plain transforms, in a view of a wider plane. */
static void
signed_distances (void)
{
  static const int size[][2] = { { 1, 1 }, { 1, 40 }, { 40, 1 }, { 17, 23 }, { 300, 3 }, { 3, 300 }, { 64, 40 } };
  static float     value[67 * 300];
  static uint8_t   paper[64 * 64], inked[64 * 64];
  static int32_t   squared[64 * 64], to_ink[64 * 64], to_paper[64 * 64];
  uint32_t         state = 2;

  for (size_t k = 0; k < sizeof size / sizeof *size; k++)
    for (uint32_t rarity = 0; rarity <= 1000; rarity = 3 * rarity + 1) /* from all ink to nearly all paper */
      {
        int       w = size[k][0], h = size[k][1], wrong = 0;
        CeldPlane ink = { w, h, (size_t) w + 3, value };

        for (int y = 0; y < h; y++)
          for (int x = 0; x < w; x++)
            {
              bool is_ink = rarity < 1000 && (rarity == 0 || check_random (&state, rarity) == 0);

              CELD_AT (&ink, x, y) = is_ink ? 0.49f : x & 1 ? 0.5f : NAN;
              inked[y * w + x] = is_ink;
              paper[y * w + x] = !is_ink;
            }
        CHECK (celd_signed_distance (&ink, NULL, squared) == CELD_OK);
        CHECK (celd_distance (w, h, inked, NULL, to_ink) == CELD_OK);
        CHECK (celd_distance (w, h, paper, NULL, to_paper) == CELD_OK);
        for (int p = 0; p < w * h; p++)
          wrong += squared[p] != (paper[p] ? to_ink[p] : -to_paper[p]);
        CHECK (wrong == 0);
      }
}

static void
empty_and_full (void)
{
  uint8_t inside[7 * 5] = { 0 };

  compare (7, 5, inside);
  memset (inside, 255, sizeof inside);
  compare (7, 5, inside);
}

/* The longest distances that there are must not overflow: a strip of the largest size, seen from its end. */
static void
longest_side (void)
{
  uint8_t *inside = calloc (CELD_MAX_SIDE, 2);
  int32_t *squared = malloc (2 * CELD_MAX_SIDE * sizeof *squared);

  inside[0] = 1;
  CHECK (celd_distance (CELD_MAX_SIDE, 2, inside, NULL, squared) == CELD_OK);
  CHECK (squared[CELD_MAX_SIDE - 1] == (CELD_MAX_SIDE - 1) * (CELD_MAX_SIDE - 1));
  CHECK (squared[2 * CELD_MAX_SIDE - 1] == (CELD_MAX_SIDE - 1) * (CELD_MAX_SIDE - 1) + 1);
  CHECK (celd_distance (2, CELD_MAX_SIDE, inside, NULL, squared) == CELD_OK);
  CHECK (squared[2 * CELD_MAX_SIDE - 1] == (CELD_MAX_SIDE - 1) * (CELD_MAX_SIDE - 1) + 1);
  free (inside);
  free (squared);
}

static void
bad_sizes (void)
{
  uint8_t inside[1] = { 1 };
  int32_t squared[1] = { 7 };

  CHECK (celd_distance (0, 1, inside, NULL, squared) == CELD_BAD_SIZE);
  CHECK (celd_distance (1, CELD_MAX_SIDE + 1, inside, NULL, squared) == CELD_BAD_SIZE);
  CHECK (squared[0] == 7);
}

static void
jobs_in_any_order_and_cancel (void)
{
  static uint8_t inside[600 * 70];
  static float   value[600 * 70];
  static int32_t squared[600 * 70], other[600 * 70];
  CeldPlane      ink = { 600, 70, 600, value };
  CeldHost       backwards = { NULL, check_backwards, NULL }, stop = { check_refuse, NULL, NULL };
  uint32_t       state = 5;

  for (int p = 0; p < 600 * 70; p++)
    value[p] = inside[p] = check_random (&state, 50) == 0;
  CHECK (celd_distance (600, 70, inside, NULL, squared) == CELD_OK);
  CHECK (celd_distance (600, 70, inside, &backwards, other) == CELD_OK);
  CHECK (memcmp (squared, other, sizeof squared) == 0);
  CHECK (celd_distance (600, 70, inside, &stop, other) == CELD_CANCELLED);
  CHECK (celd_signed_distance (&ink, NULL, squared) == CELD_OK);
  CHECK (celd_signed_distance (&ink, &backwards, other) == CELD_OK);
  CHECK (memcmp (squared, other, sizeof squared) == 0);
  CHECK (celd_signed_distance (&ink, &stop, other) == CELD_CANCELLED);
}

int
main (void)
{
  RUN (random_masks);
  RUN (signed_distances);
  RUN (empty_and_full);
  RUN (longest_side);
  RUN (bad_sizes);
  RUN (jobs_in_any_order_and_cancel);
  return DONE;
}
