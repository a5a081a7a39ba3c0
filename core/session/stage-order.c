/* Suggestions and the depth order in a session.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "session/session.h"

CeldStatus
celd_make_suggestions (CeldSession *s, const CeldHost *host)
{
  CeldRelations suggested = { 0 };
  CeldStatus    status = celd_suggest (celd_session_current_labels (s), &s->palette, &s->ink,
                                       s->hint.data ? &s->hint : NULL, host, &suggested);

  if (status == CELD_OK)
    {
      celd_relations_clear (&s->suggested);
      s->suggested = suggested;
    }
  else
    celd_relations_clear (&suggested);
  return status;
}

CeldStatus
celd_make_order (CeldSession *s, const CeldHost *host)
{
  CeldProblems problems = { 0 };
  CeldStatus   status = celd_order_suggested (celd_session_current_labels (s), &s->palette, &s->relations,
                                              &s->suggested, &s->ink, &s->settings, host, &s->joined, &s->order,
                                              &problems);

  if (status == CELD_OK)
    {
      celd_problems_clear (&s->problems[STAGE_ORDER]);
      s->problems[STAGE_ORDER] = problems;
    }
  else
    celd_problems_clear (&problems);
  return status;
}
