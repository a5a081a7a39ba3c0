/* The inequalities of a quadratic program as an order of its nodes.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "solve/quadratic-private.h"
#include "solve/quadratic.h"

bool
celd_ranks_sort (CeldTopologicalOrder *l, size_t n, size_t m, const CeldInequality *inequality, uint32_t *waits)
{
  size_t done = 0;

  for (size_t i = 0; i <= n; i++)
    l->first[i] = 0;
  for (size_t i = 0; i < n; i++)
    waits[i] = 0;
  for (size_t i = 0; i < m; i++)
    {
      l->first[inequality[i].b]++;
      waits[inequality[i].a]++;
    }
  for (size_t i = 0; i < n; i++)
    l->first[i + 1] += l->first[i];
  for (size_t i = m; i-- > 0;)
    l->item[--l->first[inequality[i].b]] = (uint32_t) i;
  for (uint32_t i = 0; i < n; i++)
    if (!waits[i])
      l->sorted[done++] = i;
  for (size_t at = 0; at < done; at++)
    for (uint32_t e = l->first[l->sorted[at]]; e < l->first[l->sorted[at] + 1]; e++)
      if (!--waits[inequality[l->item[e]].a])
        l->sorted[done++] = inequality[l->item[e]].a;
  return done == n;
}

void
celd_ranks_raise (const CeldTopologicalOrder *l, size_t n, const CeldInequality *inequality, double *u)
{
  for (size_t at = 0; at < n; at++)
    {
      uint32_t b = l->sorted[at];

      for (uint32_t e = l->first[b]; e < l->first[b + 1]; e++)
        {
          const CeldInequality *one = &inequality[l->item[e]];

          if (u[one->a] < u[b] + one->gap)
            u[one->a] = u[b] + one->gap;
        }
    }
}
