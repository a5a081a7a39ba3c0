/* Links of a graph that are listed several times, summed up.
 *
 * Cost: O(nodes + links).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "solve/partition.h"

static uint32_t
lesser_node (const CeldLink *link)
{
  return link->a < link->b ? link->a : link->b;
}

CeldStatus
celd_links_sum (size_t n, const CeldLink *listed, size_t n_listed, CeldLink *link, size_t *n_links)
{
  size_t    *first = celd_alloc0 (n + 2, sizeof *first);          /* of node k's links, as the lesser node */
  uint32_t  *sorted = celd_alloc (n_listed, sizeof *sorted);
  size_t    *found = celd_alloc (n, sizeof *found);               /* by node: its link with the current one */
  CeldStatus status = first && sorted && found ? CELD_OK : CELD_NO_MEMORY;

  if (status != CELD_OK)
    goto done;
  *n_links = 0;
  for (size_t k = 0; k < n; k++)
    found[k] = SIZE_MAX;
  for (size_t i = 0; i < n_listed; i++)
    first[lesser_node (&listed[i]) + 2]++;
  for (size_t k = 2; k < n + 2; k++)
    first[k] += first[k - 1];
  for (size_t i = 0; i < n_listed; i++)
    sorted[first[lesser_node (&listed[i]) + 1]++] = (uint32_t) i;
  for (size_t k = 0; k < n; k++)
    {
      size_t begin = *n_links;

      for (size_t i = first[k]; i < first[k + 1]; i++)
        {
          const CeldLink *one = &listed[sorted[i]];
          uint32_t        other = one->a == k ? one->b : one->a;

          if (other == k)
            continue;
          if (found[other] == SIZE_MAX || found[other] < begin)
            {
              found[other] = *n_links;
              link[(*n_links)++] = (CeldLink) { (uint32_t) k, other, 0 };
            }
          link[found[other]].cost += one->cost;
        }
    }

done:
  celd_free (first);
  celd_free (sorted);
  celd_free (found);
  return status;
}
