/* Two labels against every possible labelling; what holds for any number of labels.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "solve/maxflow.h"

#define MOST 1600

typedef struct
{
  int      width, height;
  int32_t  east[MOST], south[MOST], vote[64];
  uint32_t seed[MOST], order[64];
  size_t   n_labels;
} Problem;

static CeldStatus
solve (const Problem *p, const CeldHost *host, uint32_t *label)
{
  CeldMultiway m = { p->width, p->height, p->east, p->south, p->seed, p->vote, p->order, p->n_labels };

  return celd_multiway (&m, host, label);
}

static Problem
random_problem (uint32_t *state, int width, int height, size_t n_labels, int32_t most_vote)
{
  Problem p = { .width = width, .height = height, .n_labels = n_labels };

  for (int i = 0; i < width * height; i++)
    {
      p.east[i]  = 1 + (int32_t) check_random (state, 20);
      p.south[i] = 1 + (int32_t) check_random (state, 20);
      p.seed[i]  = check_random (state, 3) ? 0 : 1 + check_random (state, (uint32_t) n_labels);
    }
  for (size_t k = 0; k < n_labels; k++)
    {
      p.vote[k]  = check_random (state, 5) ? 1 + (int32_t) check_random (state, (uint32_t) most_vote) : CELD_HARD;
      p.order[k] = (uint32_t) (n_labels - k);
    }
  return p;
}

/* The energy of multiway.c, -1 if a hard seed is not obeyed. */
static int64_t
energy (const Problem *p, const uint32_t *label)
{
  int64_t sum = 0;

  for (int i = 0; i < p->width * p->height; i++)
    {
      if (i % p->width + 1 < p->width && label[i] != label[i + 1])
        sum += p->east[i];
      if (i / p->width + 1 < p->height && label[i] != label[i + p->width])
        sum += p->south[i];
      if (!p->seed[i] || p->seed[i] == label[i])
        continue;
      if (p->vote[p->seed[i] - 1] == CELD_HARD)
        return -1;
      sum += p->vote[p->seed[i] - 1];
    }
  return sum;
}

static int64_t
least_energy_of_two (const Problem *p)
{
  int64_t least = INT64_MAX;
  int     n = p->width * p->height;

  for (uint32_t code = 0; code < UINT32_C (1) << n; code++)
    {
      uint32_t label[16];
      int64_t  e;

      for (int i = 0; i < n; i++)
        label[i] = 1 + (code >> i & 1);
      e = energy (p, label);
      if (e >= 0 && e < least)
        least = e;
    }
  return least;
}

static bool
any_seed (const Problem *p)
{
  for (int i = 0; i < p->width * p->height; i++)
    if (p->seed[i])
      return true;
  return false;
}

static void
two_labels_are_exact (void)
{
  static const int size[][2] = { { 3, 4 }, { 1, 9 }, { 7, 1 }, { 2, 5 }, { 4, 3 } };
  uint32_t         state = 5;

  for (int i = 0; i < 300; i++)
    {
      Problem  p = random_problem (&state, size[i % 5][0], size[i % 5][1], 2, i % 2 ? 12 : 60);
      uint32_t label[MOST] = { 0 };

      CHECK (solve (&p, NULL, label) == CELD_OK);
      if (any_seed (&p))
        CHECK (energy (&p, label) == least_energy_of_two (&p));
    }
}

/* Every pixel gets a label that exists, hard seeds theirs. */
static void
many_labels_keep_the_rules (void)
{
  uint32_t state = 11;

  for (int i = 0; i < 60; i++)
    {
      size_t          n_labels = 3 + (size_t) check_random (&state, i % 2 ? 4 : 50);
      Problem         p = random_problem (&state, 17, 13, n_labels, 100);
      static uint32_t label[MOST];
      int             bad = 0;

      memset (label, 0, sizeof label);
      CHECK (solve (&p, NULL, label) == CELD_OK);
      for (int k = 0; k < p.width * p.height; k++)
        bad += label[k] < 1 || label[k] > n_labels;
      CHECK (!bad);
      CHECK (energy (&p, label) >= 0);
    }
}

/* A board of 6 x 6 fields with dear borders inside and cheap ones between: every field gets its own label, also
 * when labels are so many that they are told apart in halves. */
static void
every_field_its_own_label (void)
{
  Problem         p = { .width = 36, .height = 36, .n_labels = 36 };
  static uint32_t label[MOST];
  int             bad = 0;

  for (int i = 0; i < 36 * 36; i++)
    {
      int x = i % 36, y = i / 36;

      p.east[i]  = x % 6 == 5 ? 1 : 100;
      p.south[i] = y % 6 == 5 ? 1 : 100;
      if (x % 6 == 3 && y % 6 == 2)
        p.seed[i] = (uint32_t) (y / 6 * 6 + x / 6 + 1);
    }
  for (int k = 0; k < 36; k++)
    {
      p.vote[k]  = 40;
      p.order[k] = (uint32_t) (k * 7 % 36 + 1);
    }
  memset (label, 0, sizeof label);
  CHECK (solve (&p, NULL, label) == CELD_OK);
  for (int i = 0; i < 36 * 36; i++)
    bad += label[i] != (uint32_t) (i / 36 / 6 * 6 + i % 36 / 6 + 1);
  CHECK (bad == 0);
}

static void
decided_pixels_keep_their_label (void)
{
  Problem  p = { .width = 5, .height = 1, .east = { 9, 9, 9, 9 }, .seed = { 1, 0, 0, 0, 2 }, .vote = { 5, 5 },
                 .order = { 1, 2 }, .n_labels = 2 };
  uint32_t label[5] = { 0, 0, 7, 0, 0 };

  CHECK (solve (&p, NULL, label) == CELD_OK);
  CHECK (label[0] == 1 && label[1] == 1 && label[2] == 7 && label[3] == 2 && label[4] == 2);
}

static void
cancel_stops_the_solver (void)
{
  uint32_t state = 3, label[MOST] = { 0 };
  Problem  p = random_problem (&state, 20, 20, 5, 100);
  int      left = 0;
  CeldHost host = { check_count_down, NULL, &left };

  CHECK (solve (&p, &host, label) == CELD_CANCELLED);
}

int
main (void)
{
  RUN (two_labels_are_exact);
  RUN (many_labels_keep_the_rules);
  RUN (every_field_its_own_label);
  RUN (decided_pixels_keep_their_label);
  RUN (cancel_stops_the_solver);
  return DONE;
}
