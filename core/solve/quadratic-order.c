/* The topological order of a quadratic program's nodes by its inequalities u_a - u_b >= gap: every b before its a.
 *
 * Cost: O(nodes + inequalities).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "solve/quadratic-private.h"
#include "solve/quadratic.h"

bool
celd_topological_sort (CeldTopologicalOrder *o, size_t n, size_t m, const CeldInequality *inequality, uint32_t *waits)
{
  size_t done = 0;

  for (size_t i = 0; i <= n; i++)
    o->first[i] = 0;
  for (size_t i = 0; i < n; i++)
    waits[i] = 0;
  for (size_t i = 0; i < m; i++)
    {
      o->first[inequality[i].b]++;
      waits[inequality[i].a]++;
    }
  for (size_t i = 0; i < n; i++)
    o->first[i + 1] += o->first[i];
  for (size_t i = m; i-- > 0;)
    o->item[--o->first[inequality[i].b]] = (uint32_t) i;
  for (uint32_t i = 0; i < n; i++)
    if (!waits[i])
      o->sorted[done++] = i;
  for (size_t at = 0; at < done; at++)
    for (uint32_t e = o->first[o->sorted[at]]; e < o->first[o->sorted[at] + 1]; e++)
      if (!--waits[inequality[o->item[e]].a])
        o->sorted[done++] = inequality[o->item[e]].a;
  return done == n;
}

void
celd_raise_to_levels (const CeldTopologicalOrder *o, size_t n, const CeldInequality *inequality, double *u)
{
  for (size_t at = 0; at < n; at++)
    {
      uint32_t b = o->sorted[at];

      for (uint32_t e = o->first[b]; e < o->first[b + 1]; e++)
        {
          const CeldInequality *one = &inequality[o->item[e]];

          if (u[one->a] < u[b] + one->gap)
            u[one->a] = u[b] + one->gap;
        }
    }
}
