/* The depth order in a session: what the drawing suggests, and the order of the relations.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "order/order.h"
#include "session/session.h"

CeldStatus
celd_make_suggestions (CeldSession *s, const CeldHost *host)
{
  const CeldLabels *labels = celd_session_current_labels (s);
  CeldRelations     suggested = { 0 };
  CeldHostPart      part[2];
  CeldHost          first = celd_host_part (&part[0], host, 0, s->hint.data ? 0.5 : 1);
  CeldHost          second = celd_host_part (&part[1], host, 0.5, 1);
  CeldStatus        status = celd_suggest (labels, &s->palette, &s->ink, &first, &suggested);

  if (status == CELD_OK && s->hint.data)
    status = celd_suggest_from_depth (labels, &s->palette, &s->ink, &s->hint, &second, &suggested);
  if (status != CELD_OK)
    {
      celd_relations_clear (&suggested);
      return status;
    }
  celd_relations_clear (&s->suggested);
  s->suggested = suggested;
  return CELD_OK;
}

CeldStatus
celd_make_order (CeldSession *s, const CeldHost *host)
{
  const CeldLabels *labels = celd_session_current_labels (s);
  bool              suggest = s->settings.suggest != CELD_SUGGEST_OFF;
  CeldOrder         order = { 0 };
  CeldProblems      problems = { 0 };
  CeldStatus        status = CELD_OK;

  if (suggest)
    status = celd_suggestions_join (labels, &s->palette, &s->relations, &s->suggested, &s->settings, &s->ink, NULL,
                                    &s->joined);
  if (status == CELD_OK)
    status = celd_order (labels, &s->palette, suggest ? &s->joined : &s->relations, &s->ink, &s->settings, host, &order,
                         &problems);
  if (status != CELD_OK)
    {
      celd_order_clear (&order);
      celd_problems_clear (&problems);
      return status;
    }
  celd_order_clear (&s->order);
  celd_problems_clear (&s->problems[STAGE_ORDER]);
  s->order = order;
  s->problems[STAGE_ORDER] = problems;
  return CELD_OK;
}
