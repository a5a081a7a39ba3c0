/* Pairs of line ends: the same ones in the same order as comparing all with all, whatever is taken on the way.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "segment/bridges.h"

#define MOST 90

static uint32_t state = 1;

/* ------------------------------------------------------------------ an oracle */

/* The rule as bridges.h and bridge-pairs.c state it; negative: they may not be joined. */
static double
cost_of (const CeldTip *p, const CeldTip *q)
{
  double x = q->x - p->x, y = q->y - p->y, length = hypot (x, y), stroke = fmin (p->stroke, q->stroke);
  double turn = (x * p->dx + y * p->dy) / length, other = -(x * q->dx + y * q->dy) / length;
  double least = length <= 6 * stroke ? -0.34 : length <= 12 * stroke ? 0.5 : 0.94;
  bool   bow   = turn < 0.8 && other < 0.8;
  double ratio = 1, bend = 1 - fmin (turn, other);

  if (length < 1 || turn < least || other < least)
    return -1;
  if (bow && (x * p->dy - y * p->dx) * (x * q->dy - y * q->dx) < 0)
    return -1;
  if (p->width && q->width && p->width > q->width + 1)
    ratio = p->width / (q->width + 1);
  else if (p->width && q->width && q->width > p->width + 1)
    ratio = q->width / (p->width + 1);
  return length * (1 + bend + 2 * bend * bend) * ratio * (p->outline == q->outline ? 0.5 : 1);
}

/* The cheapest pair that is free and has not been given out; false: there is none. */
static bool
cheapest (const CeldTip *tip, size_t n, const bool *taken, const uint8_t *given, uint32_t *a, uint32_t *b)
{
  double least = INFINITY;

  for (uint32_t i = 0; i < n; i++)
    for (uint32_t j = i + 1; j < n; j++)
      if (!taken[i] && !taken[j] && !given[i * MOST + j])
        {
          double cost = cost_of (&tip[i], &tip[j]);

          if (cost >= 0 && cost < least)
            {
              least = cost;
              *a    = i;
              *b    = j;
            }
        }
  return least < INFINITY;
}

/* Takes one in `every` pairs and compares all that are given out. */
static void
compare_with_oracle (const CeldTip *tip, size_t n, int stroke, uint32_t every)
{
  static uint8_t given[MOST * MOST];
  static bool    taken[MOST];
  CeldTipPairs  *pairs = celd_tip_pairs_new (tip, n, stroke);
  uint32_t       a, b;

  memset (given, 0, sizeof given);
  memset (taken, 0, sizeof taken);
  CHECK (pairs != NULL);
  for (size_t count = 0;; count++)
    {
      const CeldTipPair *pair = NULL;
      bool               one  = cheapest (tip, n, taken, given, &a, &b);

      CHECK (celd_tip_pairs_next (pairs, taken, NULL, &pair) == CELD_OK && (pair != NULL) == one);
      if (!pair || !one)
        break;
      CHECK (pair->a == a && pair->b == b && fabs (pair->cost - cost_of (&tip[a], &tip[b])) < 1e-9);
      given[a * MOST + b] = 1;
      taken[a] = taken[b] = check_random (&state, every) == 0;
    }
  celd_tip_pairs_free (pairs);
}

/* ------------------------------------------------------------------ tests */

/* One in three ends of lines is finer than the drawing's strokes. */
static CeldTip
random_tip (double width, double height, uint32_t outlines, int stroke)
{
  double angle = check_random (&state, 3600) * 0.1 * 3.14159265358979 / 180;

  double x = check_random (&state, 1000) * 0.001 * width, y = check_random (&state, 1000) * 0.001 * height;

  return (CeldTip){ x, y, cos (angle), sin (angle), check_random (&state, outlines),
                    4 * check_random (&state, 4), check_random (&state, 3) ? stroke : 0.25 * stroke };
}

/* From pages on which all ends are near to pages of hundreds of strokes. */
static void
pairs_of_random_ends_come_in_the_order_of_an_exhaustive_search (void)
{
  CeldTip tip[MOST];

  for (int trial = 0; trial < 240; trial++)
    {
      size_t n     = check_random (&state, 90);
      double width = 1 << check_random (&state, 14), height = 1 << check_random (&state, 14);
      int    stroke = 1 + (int)check_random (&state, 12);

      for (size_t i = 0; i < n; i++)
        tip[i] = random_tip (width, height, 1 + check_random (&state, 20), stroke);
      compare_with_oracle (tip, n, stroke, 1 + check_random (&state, 8));
    }
}

/* Hatching: rows of dashes, of which many pairs cost the same; numbers decide. */
static void
pairs_of_hatching_come_in_the_order_of_an_exhaustive_search (void)
{
  CeldTip tip[MOST];
  size_t  n = 0;

  for (int y = 0; y < 6; y++)
    for (int x = 0; x < 6; x++)
      {
        tip[n++] = (CeldTip){ 40 * x, 10 * y, -1, 0, (uint32_t)(6 * y + x), 4, 2 };
        tip[n++] = (CeldTip){ 40 * x + 20, 10 * y, 1, 0, (uint32_t)(6 * y + x), 4, 2 };
      }
  compare_with_oracle (tip, n, 2, 1);
  compare_with_oracle (tip, n, 2, 3);
}

/* Nothing is too far away: two lines that point to each other over a whole page of the largest size. */
static void
no_gap_is_too_wide (void)
{
  CeldTip            tip[2]   = { { 0, 0, 1, 0, 0, 4, 1 }, { CELD_MAX_SIDE, 0, -1, 0, 1, 4, 1 } };
  bool               taken[2] = { false, false };
  CeldTipPairs      *pairs    = celd_tip_pairs_new (tip, 2, 1);
  const CeldTipPair *pair     = NULL;

  CHECK (celd_tip_pairs_next (pairs, taken, NULL, &pair) == CELD_OK && pair && pair->a == 0 && pair->b == 1);
  CHECK (celd_tip_pairs_next (pairs, taken, NULL, &pair) == CELD_OK && !pair);
  celd_tip_pairs_free (pairs);
}

static void
many_ends_in_one_place_are_paired (void)
{
  CeldTip tip[40];

  for (uint32_t i = 0; i < 40; i++)
    tip[i] = (CeldTip){ 7, 7, cos (i), sin (i), i, 4, 3 };
  compare_with_oracle (tip, 40, 3, 2);
  compare_with_oracle (tip, 1, 3, 2);
  compare_with_oracle (tip, 0, 3, 2);
}

int
main (void)
{
  RUN (pairs_of_random_ends_come_in_the_order_of_an_exhaustive_search);
  RUN (pairs_of_hatching_come_in_the_order_of_an_exhaustive_search);
  RUN (no_gap_is_too_wide);
  RUN (many_ends_in_one_place_are_paired);
  return DONE;
}
