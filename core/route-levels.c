/* Levels in a session: those of the regions, whose the ink is, and the levels that come of it.
 *
 * Most strokes and relations only say what is so already: then labels, ink and ranks are as they were, and so is
 * whose the ink is.  Otherwise, with outlines, only what an edit touches is looked at again (ownership-kept.c).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "session.h"

/* The level of each label as it leaves. */
static CeldStatus
list_values (const CeldSession *s, float **list)
{
  float *value = celd_alloc (s->order.n, sizeof *value);

  if (!value)
    return CELD_NO_MEMORY;
  for (size_t k = 0; k < s->order.n; k++)
    value[k] = celd_order_value (&s->order, s->order.level[k], &s->settings);
  *list = value;
  return CELD_OK;
}

CeldStatus
celd_make_flat (CeldSession *s, const CeldRun *run)
{
  const CeldLabels *labels = celd_session_current_labels (s);
  float            *value = NULL;
  CeldPlane         flat = { 0 };
  CeldStatus        status = list_values (s, &value);

  (void) run;
  if (status == CELD_OK)
    status = celd_plane_new (labels->width, labels->height, &flat);
  if (status == CELD_OK)
    {
      for (size_t p = 0; p < (size_t) flat.width * (size_t) flat.height; p++)
        flat.data[p] = value[labels->data[p] - 1];
      celd_session_replace (s, STAGE_FLAT, &s->flat, &flat);
    }
  celd_free (value);
  celd_free (flat.data);
  return status;
}

/* ------------------------------------------------------------------ whose the ink is */

void
celd_session_forget_ownership (CeldSession *session)
{
  celd_free (session->rank);
  session->rank = NULL;
  celd_owners_clear (&session->owners);
}

void
celd_session_clear_ownership (CeldSession *session)
{
  celd_session_forget_ownership (session);
  celd_ownership_clear (&session->ownership);
  celd_free (session->value);
  session->value = NULL;
}

/* The labels of the artist's strokes over ink; none without such a layer. */
static CeldStatus
read_corrections (const CeldSession *s, CeldLabels *labels)
{
  const CeldPaint *paint = &s->corrections;
  CeldStatus       status = CELD_OK;

  if (paint->data)
    status = celd_labels_new (paint->width, paint->height, labels);
  if (status == CELD_OK && paint->data)
    status = celd_corrections_read (paint, &s->palette, labels);
  return status;
}

/* Takes the new one, and says where it differs from the old. */
static void
replace_ownership (CeldSession *s, CeldOwnership *new)
{
  const CeldOwnership *old = &s->ownership;
  int                  w = new->owner.width, h = new->owner.height;

  celd_session_see (s, STAGE_OWNERSHIP, celd_difference (old->owner.data, new->owner.data, w, h, sizeof (uint32_t)));
  celd_session_see (s, STAGE_OWNERSHIP, celd_difference (old->under.data, new->under.data, w, h, sizeof (uint32_t)));
  celd_session_see (s, STAGE_OWNERSHIP, celd_difference (old->share.data, new->share.data, w, h, sizeof (float)));
  celd_ownership_clear (&s->ownership);
  s->ownership = *new;
  *new = (CeldOwnership) { 0 };
}

/* From the beginning. */
static CeldStatus
make_anew (CeldSession *s, const CeldOwnersInput *input, const CeldRun *run)
{
  CeldOwnership own = { 0 };
  CeldStatus    status = celd_ownership_new (input->ink->width, input->ink->height, &own);

  if (status == CELD_OK && s->settings.expansion == CELD_EXPANSION_OUTLINES)
    status = celd_owners_make (input, run, &s->owners, &own);
  else if (status == CELD_OK)
    status = celd_own (input->ink, input->labels, input->level, input->n, input->corrections, s->settings.expansion,
                       run, &own);
  if (status == CELD_OK)
    replace_ownership (s, &own);
  celd_ownership_clear (&own);
  return status;
}

static CeldStatus
renew (CeldSession *s, const CeldOwnersInput *input, const CeldRun *run)
{
  CeldRect   changed;
  CeldStatus status = celd_owners_renew (input, s->new_labels, run, &s->owners, &s->ownership, &changed);

  if (status == CELD_OK)
    celd_session_see (s, STAGE_OWNERSHIP, changed);
  return status;
}

/* The ranks that the ownership has now. */
static void
keep_ranks (CeldSession *s, uint32_t *rank)
{
  memcpy (rank, s->order.level, s->order.n * sizeof *rank);
  celd_free (s->rank);
  celd_free (s->value);
  s->rank    = rank;
  s->n_ranks = s->order.n;
  s->value   = NULL;
  s->new_labels      = (CeldRect) { 0 };
  s->new_corrections = false;
}

CeldStatus
celd_make_ownership (CeldSession *s, const CeldRun *run)
{
  CeldLabels      corrections = { 0 };
  CeldOwnersInput input = { celd_session_bent_ink (s), celd_session_current_labels (s), NULL, s->order.level,
                            s->order.n };
  uint32_t       *rank;
  CeldStatus      status;

  if (s->rank && s->n_ranks == s->order.n && !memcmp (s->rank, s->order.level, s->order.n * sizeof *s->rank) &&
      !s->new_labels.width && !s->new_corrections)
    return CELD_OK;
  rank   = celd_alloc (s->order.n, sizeof *rank);
  status = rank ? read_corrections (s, &corrections) : CELD_NO_MEMORY;
  if (corrections.data)
    input.corrections = &corrections;
  if (status == CELD_OK)
    status = s->rank && s->owners.level ? renew (s, &input, run) : make_anew (s, &input, run);
  if (status == CELD_OK)
    keep_ranks (s, rank);
  else
    {
      celd_session_forget_ownership (s);
      celd_free (rank);
    }
  celd_free (corrections.data);
  return status;
}

/* ------------------------------------------------------------------ after it */

/* Those of the label that covers more of each pixel. */
static CeldStatus
choose_levels (const CeldOwnership *own, const float *value, CeldPlane *levels)
{
  CeldStatus status = celd_plane_new (own->owner.width, own->owner.height, levels);

  for (size_t p = 0; status == CELD_OK && p < (size_t) levels->width * (size_t) levels->height; p++)
    levels->data[p] = value[(own->share.data[p] >= 0.5f ? own->owner : own->under).data[p] - 1];
  return status;
}

CeldStatus
celd_make_levels (CeldSession *s, const CeldRun *run)
{
  float     *value = NULL;
  CeldPlane  levels = { 0 };
  CeldStatus status = list_values (s, &value);

  if (status == CELD_OK && !(s->value && !memcmp (s->value, value, s->order.n * sizeof *value)))
    {
      status = choose_levels (&s->ownership, value, &levels);
      if (status == CELD_OK)
        status = celd_step (run, 1);
      if (status == CELD_OK)
        {
          celd_session_replace (s, STAGE_LEVELS, &s->levels, &levels);
          celd_free (s->value);
          s->value = value;
          value    = NULL;
        }
    }
  celd_free (value);
  celd_free (levels.data);
  return status;
}
