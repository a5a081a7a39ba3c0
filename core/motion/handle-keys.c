/* Handles of frames between keys of an animation.
 *
 * Each handle goes straight from key to key.  It starts and stops gently: s = t^2 (3 - 2 t), the cubic whose speed is 0
 * at both ends, for t from 0 to 1 between two keys.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"

/* Exactly a and b at both ends. */
static double
mix (double a, double b, double t)
{
  return t > 0 ? t < 1 ? a + t * (b - a) : b : a;
}

CeldStatus
celd_handles_between (const CeldHandleKey *key, size_t n, int frame, CeldHandles *handles)
{
  const CeldHandleKey *a = key, *b;
  CeldHandle          *item;
  double               t;

  if (!n)
    return CELD_BAD_VALUE;
  while (a + 1 < key + n && a[1].frame <= frame)
    a++;
  b = a + 1 < key + n ? a + 1 : a;
  if (a->handles.n != b->handles.n)
    return CELD_BAD_VALUE;
  t = a == b || frame <= a->frame ? 0 : (double) (frame - a->frame) / (b->frame - a->frame);
  t = t * t * (3 - 2 * t);
  item = celd_alloc (a->handles.n, sizeof *item);
  if (!item)
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < a->handles.n; i++)
    {
      const CeldHandle *p = &a->handles.item[i], *q = &b->handles.item[i];

      item[i] = (CeldHandle) { p->x, p->y, mix (p->to_x, q->to_x, t), mix (p->to_y, q->to_y, t),
                               mix (p->depth, q->depth, t) };
    }
  celd_handles_clear (handles);
  *handles = (CeldHandles) { item, a->handles.n };
  return CELD_OK;
}
