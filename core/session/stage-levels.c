/* Levels in a session: those of the regions, whose the ink is, and the levels that come of it.
 *
 * Most strokes and relations only say what is so already: then labels, ink and ranks are as they were, and so is
 * whose the ink is.  Otherwise, with outlines, only what an edit touches is looked at again (ownership-cache.c).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "ownership/ownership.h"
#include "session/session.h"

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
celd_make_unexpanded (CeldSession *s, const CeldHost *host)
{
  const CeldLabels *labels = celd_session_current_labels (s);
  float            *value = NULL;
  CeldPlane         unexpanded = { 0 };
  CeldStatus        status = list_values (s, &value);

  (void) host;
  if (status == CELD_OK)
    status = celd_plane_new (labels->width, labels->height, &unexpanded);
  if (status == CELD_OK)
    {
      for (size_t p = 0; p < (size_t) unexpanded.width * (size_t) unexpanded.height; p++)
        unexpanded.data[p] = value[labels->data[p] - 1];
      celd_session_replace_plane (s, STAGE_UNEXPANDED, &s->unexpanded, &unexpanded);
    }
  celd_free (value);
  celd_free (unexpanded.data);
  return status;
}

/* ------------------------------------------------------------------ whose the ink is */

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
  CeldRect             owner = celd_changed_rect (old->owner.data, new->owner.data, w, h, sizeof (uint32_t));
  CeldRect             under = celd_changed_rect (old->under.data, new->under.data, w, h, sizeof (uint32_t));
  CeldRect             share = celd_changed_rect (old->coverage.data, new->coverage.data, w, h, sizeof (float));

  celd_session_add_change (s, STAGE_OWNERSHIP, celd_rect_union (celd_rect_union (owner, under), share));
  celd_session_forget_values (s);
  celd_ownership_clear (&s->ownership);
  s->ownership = *new;
  *new = (CeldOwnership) { 0 };
}

/* From the beginning. */
static CeldStatus
make_anew (CeldSession *s, const CeldOwnershipInput *input, const CeldHost *host)
{
  CeldOwnership own = { 0 };
  CeldStatus    status = celd_ownership_new (input->ink->width, input->ink->height, &own);

  if (status == CELD_OK && s->settings.expansion == CELD_EXPANSION_OUTLINES)
    status = celd_ownership_cache_make (input, host, &s->owners, &own);
  else if (status == CELD_OK)
    status = celd_own (input->ink, input->labels, input->level, input->n, input->corrections, s->settings.expansion,
                       host, &own);
  if (status == CELD_OK)
    replace_ownership (s, &own);
  celd_ownership_clear (&own);
  return status;
}

static CeldStatus
renew (CeldSession *s, const CeldOwnershipInput *input, const CeldHost *host)
{
  CeldRect   changed;
  CeldStatus status = celd_ownership_cache_update (input, s->new_labels, host, &s->owners, &s->ownership, &changed);

  if (status == CELD_OK)
    {
      celd_session_add_change (s, STAGE_OWNERSHIP, changed);
      s->new_owners = celd_rect_union (s->new_owners, changed);
    }
  return status;
}

/* The ranks that the ownership has now. */
static void
keep_ranks (CeldSession *s, uint32_t *rank)
{
  memcpy (rank, s->order.level, s->order.n * sizeof *rank);
  celd_free (s->owned_level);
  s->owned_level    = rank;
  s->n_owned = s->order.n;
  s->new_labels      = (CeldRect) { 0 };
  s->new_corrections = false;
}

CeldStatus
celd_make_ownership (CeldSession *s, const CeldHost *host)
{
  CeldLabels      corrections = { 0 };
  CeldOwnershipInput input = { celd_session_split_ink (s), celd_session_current_labels (s), NULL, s->order.level,
                            s->order.n };
  uint32_t       *rank;
  CeldStatus      status;

  if (s->owned_level && s->n_owned == s->order.n &&
      !memcmp (s->owned_level, s->order.level, s->order.n * sizeof *s->owned_level) && !s->new_labels.width &&
      !s->new_corrections)
    return CELD_OK;
  rank   = celd_alloc (s->order.n, sizeof *rank);
  status = rank ? read_corrections (s, &corrections) : CELD_NO_MEMORY;
  if (corrections.data)
    input.corrections = &corrections;
  if (status == CELD_OK)
    status = s->owned_level && s->owners.level ? renew (s, &input, host) : make_anew (s, &input, host);
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

/* That of the label which covers more of the pixel. */
static float
level_at (const CeldOwnership *own, const float *value, int x, int y)
{
  return value[CELD_AT (CELD_AT (&own->coverage, x, y) >= 0.5f ? &own->owner : &own->under, x, y) - 1];
}

static CeldStatus
make_all_levels (CeldSession *s, const float *value, const CeldHost *host)
{
  CeldPlane  levels;
  CeldStatus status = celd_plane_new (s->ownership.owner.width, s->ownership.owner.height, &levels);

  for (int y = 0; status == CELD_OK && y < levels.height; y++)
    for (int x = 0; x < levels.width; x++)
      CELD_AT (&levels, x, y) = level_at (&s->ownership, value, x, y);
  if (status == CELD_OK)
    status = celd_progress (host, 1);
  if (status == CELD_OK)
    celd_session_replace_plane (s, STAGE_LEVELS, &s->levels, &levels);
  celd_free (levels.data);
  return status;
}

/* Where owners are new. */
static void
renew_levels (CeldSession *s, const float *value)
{
  CeldRect r = s->new_owners, changed = { 0 };

  for (int y = r.y; y < r.y + r.height; y++)
    for (int x = r.x; x < r.x + r.width; x++)
      {
        float level = level_at (&s->ownership, value, x, y);

        if (CELD_AT (&s->levels, x, y) != level)
          changed = celd_rect_union (changed, (CeldRect) { x, y, 1, 1 });
        CELD_AT (&s->levels, x, y) = level;
      }
  celd_session_add_change (s, STAGE_LEVELS, changed);
}

/* Labels that were not there before, or are not there any more, have new owners. */
CeldStatus
celd_make_levels (CeldSession *s, const CeldHost *host)
{
  size_t     both = s->order.n < s->n_values ? s->order.n : s->n_values;
  float     *value = NULL;
  CeldStatus status = list_values (s, &value);

  if (status != CELD_OK)
    return status;
  if (s->value && !memcmp (s->value, value, both * sizeof *value))
    renew_levels (s, value);
  else
    status = make_all_levels (s, value, host);
  if (status == CELD_OK)
    {
      celd_free (s->value);
      s->value      = value;
      s->n_values   = s->order.n;
      s->new_owners = (CeldRect) { 0 };
      value         = NULL;
    }
  celd_free (value);
  return status;
}
