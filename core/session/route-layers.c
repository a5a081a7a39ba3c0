/* The layers of a session's drawing.  They are large and seldom asked for: the session does not keep them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "session/session.h"

/* The label behind all others; 0: there is none, or relations say that something is behind it. */
static uint32_t
background_label (const CeldSession *s)
{
  for (size_t k = 0; k < s->palette.n; k++)
    if (s->palette.item[k].background)
      return s->order.level[k] == 0 ? (uint32_t) k + 1 : 0;
  return 0;
}

CeldStatus
celd_session_layers (CeldSession *s, const CeldColours *art, CeldStore store, const CeldHost *host,
                     CeldLayers **layers)
{
  CeldHostPart      part[2];
  CeldHost      first = celd_host_part (&part[0], host, 0, 0.6), second = celd_host_part (&part[1], host, 0.6, 1);
  CeldOwnership own;
  CeldStatus    status = celd_session_ownership (s, &first, &own, NULL);

  if (status == CELD_OK)
    status = celd_layers_cut (celd_session_depth_ink (s), &own, s->order.level, s->order.n, art, background_label (s),
                              store, s->settings.complete, &second, layers);
  return status;
}
