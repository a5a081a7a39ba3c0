/* Allocation: no size overflows, lists grow without losing anything, records end twice without harm.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "base/base.h"

static void
sizes_do_not_overflow (void)
{
  CHECK (!celd_alloc (SIZE_MAX / 2, 3));
  CHECK (!celd_alloc0 (SIZE_MAX / 2, 3));
}

static void
empty_allocations_are_not_null (void)
{
  void *none = celd_alloc (0, 4), *cleared = celd_alloc0 (0, 0);

  CHECK (none && cleared && none != cleared);
  celd_free (none);
  celd_free (cleared);
  celd_free (NULL);
}

static void
refused_growth_changes_nothing (void)
{
  uint32_t *item = NULL;
  size_t    n = 0, capacity = 0;

  CHECK (celd_append (item, n, capacity, 5) == CELD_OK && n == 1 && capacity >= 1);
  CHECK (!celd_reserve (&item, SIZE_MAX / 2, &capacity, sizeof *item));
  CHECK (!celd_reserve (&item, SIZE_MAX, &capacity, 1));
  CHECK (item[0] == 5 && n == 1 && capacity < 100);
  celd_free (item);
}

/* Also where a list got shorter in between, as lists of strokes and relations do. */
static void
lists_keep_what_they_hold (void)
{
  uint32_t random = 5, *item = NULL;
  size_t   n = 0, capacity = 0;

  for (int step = 0; step < 20000; step++)
    if (n && check_random (&random, 3) == 0)
      n -= check_random (&random, (uint32_t) n);
    else
      {
        uint32_t value = (uint32_t) n * 7;

        CHECK (celd_append (item, n, capacity, value) == CELD_OK);
        CHECK (item[0] == 0 && item[n / 2] == n / 2 * 7);
      }
  celd_free (item);
}

static void
new_pictures (void)
{
  CeldMask   mask;
  CeldLabels labels;
  bool       clear = true;

  CHECK (celd_mask_new (7, 5, &mask) == CELD_OK && mask.stride == 7);
  CHECK (celd_labels_new (7, 5, &labels) == CELD_OK && labels.height == 5);
  for (int i = 0; i < 35; i++)
    clear = clear && !mask.data[i] && !labels.data[i];
  CHECK (clear);
  celd_free (mask.data);
  celd_free (labels.data);
}

static void
records_can_be_cleared_twice (void)
{
  CeldPalette   palette = { 0 };
  CeldRelations relations = { 0 };
  CeldProblems  problems = { 0 };
  CeldOrder     order = { 0 };

  CHECK (celd_relation_add (&relations, (CeldRelation) { .weight = 3 }) == CELD_OK);
  CHECK (relations.n == 1 && relations.item[0].weight > 2);
  CHECK (celd_problem_add (&problems, (CeldProblem) { .x = 4 }) == CELD_OK && problems.item[0].x == 4);
  CHECK (celd_problem_add (NULL, (CeldProblem) { 0 }) == CELD_OK); /* nobody wants to know */
  for (int i = 0; i < 2; i++)
    {
      celd_palette_clear (&palette);
      celd_relations_clear (&relations);
      celd_problems_clear (&problems);
      celd_order_clear (&order);
    }
  CHECK (!relations.item && !relations.n && !problems.item);
}

/* A problem takes its own paint with it, and no other's. */
static void
problems_are_copied_with_their_paint (void)
{
  CeldProblem  item[2] = { { .x = 1, .first = 0, .runs = 2 }, { .x = 2, .first = 2, .runs = 1 } };
  CeldPaintRun run[3] = { { 1, 1, 4 }, { 2, 2, 5 }, { 3, 3, 6 } };
  CeldProblems from = { .item = item, .n = 2, .run = run, .n_runs = 3 }, to = { 0 };

  CHECK (celd_problem_copy (&from, 1, &to) == CELD_OK && celd_problem_copy (&from, 0, &to) == CELD_OK);
  CHECK (celd_problem_copy (&from, 0, NULL) == CELD_OK);
  CHECK (to.n == 2 && to.item[0].x == 2 && to.item[1].x == 1 && to.n_runs == 3);
  CHECK (to.item[0].first == 0 && to.item[0].runs == 1 && to.run[0].n == 6);
  CHECK (to.item[1].first == 1 && to.item[1].runs == 2 && to.run[1].n == 4 && to.run[2].n == 5);
  celd_problems_clear (&to);
  CHECK (!to.run && !to.n_runs);
}

int
main (void)
{
  RUN (sizes_do_not_overflow);
  RUN (empty_allocations_are_not_null);
  RUN (refused_growth_changes_nothing);
  RUN (lists_keep_what_they_hold);
  RUN (new_pictures);
  RUN (records_can_be_cleared_twice);
  RUN (problems_are_copied_with_their_paint);
  return DONE;
}
