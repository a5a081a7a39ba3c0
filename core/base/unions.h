/* Disjoint sets of the numbers 0 .. n-1: union-find with path halving.
 *
 * The sets are stored as one array, parent[k].  Of two joined sets the smaller root becomes the root of both, so a root
 * is the smallest number of its set, and parent[k] <= k.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_UNIONS_H
#define CELD_UNIONS_H

#include "base/base.h"

#include <stddef.h>
#include <stdint.h>

/* n sets of one number each. */
static inline void
celd_roots (uint32_t *parent, size_t n)
{
  for (size_t k = 0; k < n; k++)
    parent[k] = (uint32_t) k;
}

/* The root of the set that k is in; shortens paths on the way. */
static inline uint32_t
celd_root (uint32_t *parent, uint32_t k)
{
  while (parent[k] != k)
    k = parent[k] = parent[parent[k]];
  return k;
}

/* Makes one set of those of a and b. */
static inline void
celd_join (uint32_t *parent, uint32_t a, uint32_t b)
{
  a = celd_root (parent, a);
  b = celd_root (parent, b);
  if (a < b)
    parent[b] = a;
  else
    parent[a] = b;
}

#endif
