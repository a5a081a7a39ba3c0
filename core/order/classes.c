/* Labels that equalities have given one depth: union-find, and a ring through the labels of each class.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/unions.h"
#include "order/order.h"

CeldStatus
celd_classes_new (size_t n, CeldClasses *classes)
{
  *classes = (CeldClasses) { celd_alloc (n, sizeof (uint32_t)), celd_alloc (n, sizeof (uint32_t)) };
  if (!classes->parent || !classes->next)
    return CELD_NO_MEMORY;
  celd_roots (classes->parent, n);
  celd_roots (classes->next, n);
  return CELD_OK;
}

void
celd_classes_clear (CeldClasses *classes)
{
  celd_free (classes->parent);
  celd_free (classes->next);
  *classes = (CeldClasses) { 0 };
}

void
celd_classes_join (CeldClasses *classes, uint32_t a, uint32_t b)
{
  uint32_t next;

  a = celd_class_of (classes, a);
  b = celd_class_of (classes, b);
  if (a == b)
    return;
  celd_join (classes->parent, a, b);
  next             = classes->next[a]; /* two rings become one */
  classes->next[a] = classes->next[b];
  classes->next[b] = next;
}
