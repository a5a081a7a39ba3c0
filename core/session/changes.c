/* Where two results of a session differ: what the host is told to redraw.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "session/session.h"

#include <string.h>

CeldRect
celd_difference (const void *old, const void *new, int width, int height, size_t pixel)
{
  CeldRect      all = { 0, 0, width, height }, found = { 0 };
  const uint8_t *a = old, *b = new;
  size_t        row = (size_t) width * pixel;

  if (!old)
    return all;
  for (int y = 0; y < height; y++, a += row, b += row)
    if (memcmp (a, b, row))
      {
        size_t first = 0, last = row - 1;

        while (a[first] == b[first])
          first++;
        while (a[last] == b[last])
          last--;
        first /= pixel;
        last  /= pixel;
        found  = celd_rect_union (found, (CeldRect) { (int) first, y, (int) (last - first) + 1, 1 });
      }
  return found;
}

void
celd_session_see (CeldSession *session, CeldStage stage, CeldRect changed)
{
  session->unseen[stage] = celd_rect_union (session->unseen[stage], changed);
}

void
celd_session_replace (CeldSession *session, CeldStage stage, CeldPlane *old, CeldPlane *new)
{
  celd_session_see (session, stage, celd_difference (old->data, new->data, new->width, new->height, sizeof (float)));
  celd_free (old->data);
  *old = *new;
  new->data = NULL;
}
