/* Sets of numbered things that are joined: union-find with path halving.
 *
 * parent[k] = k to begin with.  Of two sets that join, the smaller root stays one, so that a root comes before all of
 * its members; parents always come before their children.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_UNIONS_H
#define CELD_UNIONS_H

#include "base/base.h"

#include <stddef.h>
#include <stdint.h>

/* n sets of one. */
static inline void
celd_roots (uint32_t *parent, size_t n)
{
  for (size_t k = 0; k < n; k++)
    parent[k] = (uint32_t) k;
}

/* The representative of the set in which k is. */
static inline uint32_t
celd_root (uint32_t *parent, uint32_t k)
{
  while (parent[k] != k)
    k = parent[k] = parent[parent[k]];
  return k;
}

/* Joins the sets of a and b. */
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
