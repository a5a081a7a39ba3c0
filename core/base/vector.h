/* Growable arrays: items, their number and their capacity, which are members of one record or variables side by side.
 *
 * All zero is an empty array; the items end with celd_free.  Growth doubles the capacity, so that n appended items cost
 * O(n).  Where a capacity is not known, 0 is valid for an array of any length: the next item reallocates it then.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_VECTOR_H
#define CELD_VECTOR_H

#include "base/base.h"

/* Makes room for `count` items of a size; `items` is the address of the pointer to them.  False if memory is refused or
 * the size overflows: then all is as before. */
bool celd_reserve (void *items, size_t count, size_t *capacity, size_t size);

/* Makes room for one item more than n, of the type of the items. */
#define celd_reserve_one(items, n, capacity) \
  ((n) < (capacity) || celd_reserve (&(items), (n) + 1, &(capacity), sizeof *(items)))

/* Appends a value of the items' type and counts it: CELD_OK, or CELD_NO_MEMORY with all as before.  Evaluates its
 * arguments several times. */
#define celd_append(items, n, capacity, ...) \
  (celd_reserve_one (items, n, capacity) ? ((items)[(n)++] = __VA_ARGS__, CELD_OK) : CELD_NO_MEMORY)

/* For records that do not keep a capacity, as those of celdepth.h: each item reallocates them, so it is for rare
 * additions.  Never for an array whose capacity is kept, because it may shrink. */
#define celd_append_uncounted(items, n, ...) celd_append (items, n, (size_t) { 0 }, __VA_ARGS__)

#endif
