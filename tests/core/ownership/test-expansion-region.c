/* Expansion of one region into the ink of known contours.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "ownership/ownership.h"
#include "sketch.h"

/* Digits are levels, '#' is free ink. */
static CeldExpansionState
open_picture (const CeldLabels *levels)
{
  int                w = levels->width, h = levels->height;
  size_t             n = (size_t) w * (size_t) h;
  uint8_t           *known = malloc (n);
  CeldExpansionState s = { w, h, n, levels->data, malloc (n * sizeof (int32_t)), NULL, calloc (9, sizeof (CeldRect)),
                           9 };

  for (size_t p = 0; p < n; p++)
    {
      int       x = (int) p % w, y = (int) p / w;
      CeldRect *box = &s.box[levels->data[p] ? levels->data[p] - 1 : 0];

      known[p] = levels->data[p] != 0;
      if (!known[p])
        continue;
      if (!box->width)
        *box = (CeldRect) { x, y, 1, 1 };
      box->width = x >= box->x + box->width ? x - box->x + 1 : box->width;
      box->height = y - box->y + 1;
      box->width += x < box->x ? box->x - x : 0;
      box->x = x < box->x ? x : box->x;
    }
  CHECK (celd_distance (w, h, known, NULL, s.distance_in_ink) == CELD_OK);
  free (known);
  return s;
}

/* Expands level k and compares the picture with `wanted`. */
static void
expand (const char *const *picture, uint32_t k, const char *const *wanted)
{
  CeldLabels         levels = art_labels (picture);
  CeldExpansionState s = open_picture (&levels);

  CHECK (celd_expand_region (&s, k, NULL) == CELD_OK);
  NEAR (differing (&levels, wanted), 0, 0);
  free (levels.data);
  free (s.distance_in_ink);
  free (s.box);
}

static void
the_whole_line_goes_to_the_nearer_region (void)
{
  static const char *const picture[] = { "222####111", "222####111", "222####111", "222####111", NULL };
  static const char *const wanted[] = { "2222222111", "2222222111", "2222222111", "2222222111", NULL };

  expand (picture, 2, wanted);
}

/* The line between two farther regions that ends at the region's outline stays free. */
static void
a_line_that_branches_off_stays_free (void)
{
  static const char *const picture[] = {
    "333333333333", "333333333333", "############", "############", "11111##22222", "11111##22222", "11111##22222", NULL
  };
  static const char *const wanted[] = {
    "333333333333", "333333333333", "333333333333", "333333333333", "11111##22222", "11111##22222", "11111##22222", NULL
  };

  expand (picture, 3, wanted);
}

/* So does what a nearer region, which is expanded already, has left over. */
static void
a_detail_without_a_farther_region_is_taken_whole (void)
{
  static const char *const picture[] = { "1111111", "1222221", "122##21", "122##21", "1222221", "1111111", NULL };
  static const char *const wanted[] = { "1111111", "1222221", "1222221", "1222221", "1222221", "1111111", NULL };
  static const char *const nearer[] = { "333##22", "333##22", NULL };
  static const char *const taken[] = { "3332222", "3332222", NULL };

  expand (picture, 2, wanted);
  expand (nearer, 2, taken);
}

/* Where all other regions are expanded already, the whole contour is taken. */
static void
nearer_regions_are_ignored (void)
{
  static const char *const picture[] = { "22222222", "########", "########", "333##333", NULL };
  static const char *const wanted[] = { "22222222", "22222222", "22222222", "33322333", NULL };

  expand (picture, 2, wanted);
}

/* The inside of the blot is farther from the region than the line below is thick, but touches no other region. */
static void
a_small_gap_is_filled (void)
{
  static const char *const picture[] = {
    "222222222222222222222222222222", "222#######22222222222222222222", "222#######22222222222222222222",
    "222#######222222##############", "222#######222222##############", "222#######222222##############",
    "222#######222222##############", "222#######222222##############", "222222#222222222##############",
    "222222#222222222##############", "222222#222222222##############", "##############################",
    "##############################", "111111111111111111111111111111", "111111111111111111111111111111",
    "111111111111111111111111111111", NULL
  };
  CeldLabels         levels = art_labels (picture);
  CeldExpansionState s = open_picture (&levels);
  int                free_pixels = 0;

  CHECK (celd_expand_region (&s, 2, NULL) == CELD_OK);
  for (int y = 1; y < 8; y++)
    for (int x = 3; x < 10; x++)
      free_pixels += CELD_AT (&levels, x, y) != 2;
  NEAR (free_pixels, 0, 0);
  free (levels.data);
  free (s.distance_in_ink);
  free (s.box);
}

static void
ink_that_is_not_connected_stays_free (void)
{
  static const char *const picture[] = { "22##11##11", "22##11##11", "22##11##11", NULL };
  static const char *const wanted[] = { "222211##11", "222211##11", "222211##11", NULL };

  expand (picture, 2, wanted);
  expand (wanted, 3, wanted); /* a level without pixels */
}

/* Other contents of the picture, and the region's place in it, have no influence. */
static void
only_the_region_s_surroundings_matter (void)
{
  enum { SIDE = 40, AT = 13 };
  static const char *const picture[] = {
    "1111111111", "11#####111", "1#22222#11", "1#22222#11", "1#22222#11", "11#####111", "1111111111", NULL
  };
  CeldLabels small = art_labels (picture), large = { SIDE, SIDE, SIDE, malloc (SIDE * SIDE * sizeof (uint32_t)) };
  int        wrong = 0, taken = 0;

  for (int i = 0; i < SIDE * SIDE; i++)
    large.data[i] = i % SIDE > 30 && i % SIDE < 38 ? 0 : 1;
  for (int y = 0; y < small.height; y++)
    for (int x = 0; x < small.width; x++)
      CELD_AT (&large, AT + x, AT + y) = CELD_AT (&small, x, y);
  for (int i = 0; i < 2; i++)
    {
      CeldExpansionState s = open_picture (i ? &large : &small);

      CHECK (celd_expand_region (&s, 2, NULL) == CELD_OK);
      free (s.distance_in_ink);
      free (s.box);
    }
  for (int y = 0; y < small.height; y++)
    for (int x = 0; x < small.width; x++)
      {
        wrong += CELD_AT (&large, AT + x, AT + y) != CELD_AT (&small, x, y);
        taken += CELD_AT (&small, x, y) == 2;
      }
  NEAR (wrong, 0, 0);
  NEAR (taken, 15 + 16, 0);
  NEAR (CELD_AT (&large, 33, 0), 0, 0);
  free (small.data);
  free (large.data);
}

static void
a_cancelled_region_takes_nothing (void)
{
  static const char *const picture[] = { "222####111", "222####111", NULL };
  CeldLabels         levels = art_labels (picture);
  CeldExpansionState s = open_picture (&levels);
  CeldHost           host = { .progress = check_refuse };

  CHECK (celd_expand_region (&s, 2, &host) == CELD_CANCELLED);
  NEAR (differing (&levels, picture), 0, 0);
  free (levels.data);
  free (s.distance_in_ink);
  free (s.box);
}

int
main (void)
{
  RUN (the_whole_line_goes_to_the_nearer_region);
  RUN (a_line_that_branches_off_stays_free);
  RUN (a_detail_without_a_farther_region_is_taken_whole);
  RUN (nearer_regions_are_ignored);
  RUN (a_small_gap_is_filled);
  RUN (ink_that_is_not_connected_stays_free);
  RUN (only_the_region_s_surroundings_matter);
  RUN (a_cancelled_region_takes_nothing);
  return DONE;
}
