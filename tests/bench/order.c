/* Time to order 2,000 regions by 10,000 relations: see README.md.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "celdepth.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#define LABELS    2000
#define RELATIONS 10000
#define RUNS      21

static double
now (void)
{
  struct timespec t;

  clock_gettime (CLOCK_PROCESS_CPUTIME_ID, &t);
  return (double) t.tv_sec * 1e3 + (double) t.tv_nsec * 1e-6;
}

static uint32_t
random_below (uint32_t *state, uint32_t n)
{
  *state = *state * 1664525 + 1013904223;
  return (uint32_t) (((uint64_t) (*state >> 8) * n) >> 24);
}

static int
compare (const void *one, const void *two)
{
  double a = *(const double *) one, b = *(const double *) two;

  return a < b ? -1 : a > b;
}

/* Relations between random regions; so many of a hundred point anywhere, the others follow a hidden order. */
static void
make_relations (uint32_t astray, uint32_t equal, CeldRelation *item)
{
  uint32_t state = 5;

  for (int i = 0; i < RELATIONS; i++)
    {
      uint32_t a = random_below (&state, LABELS), b = (a + 1 + random_below (&state, LABELS - 1)) % LABELS;
      bool     turn = random_below (&state, 1000) >= astray && a < b;

      item[i] = (CeldRelation) { .weight = 1, .gap = 1 };
      item[i].nearer.x  = turn ? b : a;
      item[i].farther.x = turn ? a : b;
      if (random_below (&state, 1000) < equal)
        {
          item[i].equal = true;
          item[i].farther.x = a + (a % 2 ? -1. : 1.);
        }
    }
}

static void
measure (const char *name, uint32_t astray, uint32_t equal, CeldOnCycle on_cycle)
{
  static uint32_t     pixel[LABELS];
  static CeldRegion   region[LABELS];
  static CeldRelation item[RELATIONS];
  CeldLabels          labels = { LABELS, 1, LABELS, pixel };
  CeldPalette         palette = { region, LABELS };
  CeldRelations       relations = { item, RELATIONS };
  CeldOrder           order = { 0 };
  CeldSettings        settings = celd_settings ();
  double              taken[RUNS];

  for (uint32_t k = 0; k < LABELS; k++)
    pixel[k] = k + 1;
  make_relations (astray, equal, item);
  settings.on_cycle = on_cycle;
  for (int run = 0; run < RUNS; run++)
    {
      double start = now ();

      if (celd_order (&labels, &palette, &relations, NULL, &settings, NULL, &order, NULL) != CELD_OK)
        exit (1);
      taken[run] = now () - start;
    }
  qsort (taken, RUNS, sizeof *taken, compare);
  printf ("%-34s %7.2f ms   levels %4u   sccs %3zu   left out %5zu\n", name, taken[RUNS / 2], (unsigned) order.levels,
          order.n_sccs, order.n_cycles);
  celd_order_clear (&order);
}

int
main (void)
{
  printf ("%d regions, %d relations, medians of %d\n", LABELS, RELATIONS, RUNS);
  measure ("no contradiction", 0, 0, CELD_ON_CYCLE_REPORT);
  measure ("the same, 5 % equalities", 0, 50, CELD_ON_CYCLE_REPORT);
  measure ("1 of 1000 astray, report", 1, 0, CELD_ON_CYCLE_REPORT);
  measure ("1 of 1000 astray, drop-weakest", 1, 0, CELD_ON_CYCLE_DROP_WEAKEST);
  measure ("1 of 100 astray, report", 10, 0, CELD_ON_CYCLE_REPORT);
  measure ("1 of 100 astray, drop-weakest", 10, 0, CELD_ON_CYCLE_DROP_WEAKEST);
  measure ("all at random, report", 1000, 0, CELD_ON_CYCLE_REPORT);
  measure ("the same, 5 % equalities", 1000, 50, CELD_ON_CYCLE_REPORT);
  measure ("all at random, drop-weakest", 1000, 0, CELD_ON_CYCLE_DROP_WEAKEST);
  return 0;
}
