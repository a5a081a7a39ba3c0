/* Normals and shading in a session.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "session/session.h"

CeldStatus
celd_make_normals (CeldSession *s, const CeldHost *host)
{
  int         w = s->levels.width, h = s->levels.height;
  CeldVectors normals = { w, h, (size_t) w, celd_alloc ((size_t) w * (size_t) h, 3 * sizeof (float)) };
  CeldStatus  status = CELD_NO_MEMORY;

  if (normals.data)
    status = celd_normals (celd_session_split_ink (s), &s->levels, &s->settings, host, &normals);
  if (status != CELD_OK)
    {
      celd_free (normals.data);
      return status;
    }
  celd_session_add_change (s, STAGE_NORMALS,
                           celd_changed_rect (s->normals.data, normals.data, w, h, 3 * sizeof (float)));
  celd_free (s->normals.data);
  s->normals = normals;
  return CELD_OK;
}

CeldStatus
celd_make_shading (CeldSession *s, const CeldHost *host)
{
  CeldPlane  shading;
  CeldStatus status = celd_plane_new (s->normals.width, s->normals.height, &shading);

  (void) host;
  if (status == CELD_OK)
    status = celd_shade (&s->normals, &s->settings, &shading);
  if (status == CELD_OK)
    celd_session_replace_plane (s, STAGE_SHADING, &s->shading, &shading);
  celd_free (shading.data);
  return status;
}

