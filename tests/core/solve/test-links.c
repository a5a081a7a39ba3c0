/* Links summed up, against a table of all pairs of nodes.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "solve/partition.h"

#define NODES 12
#define LISTED 80

static void
links_are_those_of_a_table (void)
{
  uint32_t state = 5;

  for (int round = 0; round < 200; round++)
    {
      CeldLink listed[LISTED], link[LISTED];
      int64_t  sum[NODES][NODES] = { { 0 } };
      bool     seen[NODES][NODES] = { { false } };
      size_t   n_listed = (size_t) (round % LISTED), pairs = 0, n;

      for (size_t i = 0; i < n_listed; i++)
        {
          uint32_t a = check_random (&state, NODES), b = check_random (&state, NODES);
          int64_t  cost = check_random (&state, 1000000);

          listed[i] = (CeldLink) { a, b, cost };
          if (a == b)
            continue;
          pairs += !seen[a][b];
          seen[a][b] = seen[b][a] = true;
          sum[a][b] += cost;
          sum[b][a] = sum[a][b];
        }
      CHECK (celd_links_sum (NODES, listed, n_listed, link, &n) == CELD_OK);
      CHECK (n == pairs);
      for (size_t i = 0; i < n; i++)
        {
          CHECK (seen[link[i].a][link[i].b] && link[i].cost == sum[link[i].a][link[i].b]);
          seen[link[i].a][link[i].b] = seen[link[i].b][link[i].a] = false; /* each pair once */
        }
    }
}

int
main (void)
{
  RUN (links_are_those_of_a_table);
  return DONE;
}
