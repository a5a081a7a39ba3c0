/* Levels in a session: before expansion, contour ownership, and levels after expansion.
 *
 * Many strokes and relations leave labels, ink and order levels as they were; then the ownership stays, too.  Otherwise
 * ownership by outlines is updated where the edit matters (ownership/ownership-cache.c), and by thickness made again.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/input.h"
#include "ownership/ownership.h"
#include "session/session.h"

/* The level of each label in the encoding of the settings.  The caller frees the list. */
static CeldStatus
list_label_levels (const CeldSession *s, float **list)
{
  float *label_level = celd_alloc (s->order.n, sizeof *label_level);

  if (!label_level)
    return CELD_NO_MEMORY;
  for (size_t k = 0; k < s->order.n; k++)
    label_level[k] = celd_order_value (&s->order, s->order.level[k], &s->settings);
  *list = label_level;
  return CELD_OK;
}

CeldStatus
celd_make_unexpanded (CeldSession *s, const CeldHost *host)
{
  const CeldLabels *labels = celd_session_current_labels (s);
  float            *label_level = NULL;
  CeldPlane         unexpanded = { 0 };
  CeldStatus        status = list_label_levels (s, &label_level);

  (void) host;
  if (status == CELD_OK)
    status = celd_plane_new (labels->width, labels->height, &unexpanded);
  if (status == CELD_OK)
    {
      for (size_t p = 0; p < (size_t) unexpanded.width * (size_t) unexpanded.height; p++)
        unexpanded.data[p] = label_level[labels->data[p] - 1];
      celd_session_replace_plane (s, STAGE_UNEXPANDED, &s->unexpanded, &unexpanded);
    }
  celd_free (label_level);
  celd_free (unexpanded.data);
  return status;
}

/* ------------------------------------------------------------------ contour ownership */

/* Reads the labels of the corrections layer; labels->data stays NULL without such a layer. */
static CeldStatus
read_corrections (CeldSession *s, CeldLabels *labels)
{
  const CeldPaint *paint = &s->corrections;
  CeldStatus       status = CELD_OK;

  if (paint->data)
    status = celd_labels_new (paint->width, paint->height, labels);
  if (status == CELD_OK && paint->data)
    status = celd_corrections_read (paint, &s->palette, labels);
  celd_problems_clear (&s->problems[STAGE_OWNERSHIP]);
  if (status == CELD_OK && paint->data)
    status = celd_unmatched_strokes_find (paint, labels, &s->problems[STAGE_OWNERSHIP]);
  return status;
}

/* Replaces the ownership, taking over the new one, and reports where it differs from the old one. */
static void
replace_ownership (CeldSession *s, CeldOwnership *new)
{
  const CeldOwnership *old = &s->ownership;
  int                  w = new->owner.width, h = new->owner.height;
  CeldRect             owner = celd_changed_rect (old->owner.data, new->owner.data, w, h, sizeof (uint32_t));
  CeldRect             under = celd_changed_rect (old->under.data, new->under.data, w, h, sizeof (uint32_t));
  CeldRect             coverage = celd_changed_rect (old->coverage.data, new->coverage.data, w, h, sizeof (float));

  celd_session_add_change (s, STAGE_OWNERSHIP, celd_rect_union (celd_rect_union (owner, under), coverage));
  celd_session_discard_label_levels (s);
  s->changed_sheets = (CeldRect) { 0, 0, w, h };
  celd_ownership_clear (&s->ownership);
  s->ownership = *new;
  *new = (CeldOwnership) { 0 };
}

/* Makes the ownership from scratch. */
static CeldStatus
make_ownership (CeldSession *s, const CeldOwnershipInput *input, const CeldHost *host)
{
  CeldOwnership own = { 0 };
  CeldStatus    status = celd_ownership_new (input->ink->width, input->ink->height, &own);

  if (status == CELD_OK && s->settings.expansion == CELD_EXPANSION_OUTLINES)
    status = celd_ownership_cache_make (input, host, &s->ownership_cache, &own);
  else if (status == CELD_OK)
    status = celd_own (input->ink, input->colours, input->labels, input->level, input->n, input->corrections,
                       s->settings.expansion, host, &own);
  if (status == CELD_OK)
    replace_ownership (s, &own);
  celd_ownership_clear (&own);
  return status;
}

static CeldStatus
update_ownership (CeldSession *s, const CeldOwnershipInput *input, const CeldHost *host)
{
  CeldRect   changed;
  CeldStatus status = celd_ownership_cache_update (input, s->changed_labels, host, &s->ownership_cache, &s->ownership,
                                                   &changed);

  if (status == CELD_OK)
    {
      celd_session_add_change (s, STAGE_OWNERSHIP, changed);
      s->changed_ownership = celd_rect_union (s->changed_ownership, changed);
      s->changed_sheets    = celd_rect_union (s->changed_sheets, changed);
    }
  return status;
}

/* Records what the ownership was made from; takes over the list of levels. */
static void
record_levels (CeldSession *s, uint32_t *level)
{
  memcpy (level, s->order.level, s->order.n * sizeof *level);
  celd_free (s->ownership_level);
  s->ownership_level     = level;
  s->n_ownership_levels  = s->order.n;
  s->changed_labels      = (CeldRect) { 0 };
  s->changed_corrections = false;
}

CeldStatus
celd_make_ownership (CeldSession *s, const CeldHost *host)
{
  CeldLabels         corrections = { 0 };
  CeldOwnershipInput input = { .ink = celd_session_split_ink (s), .labels = celd_session_current_labels (s),
                               .level = s->order.level, .n = s->order.n };
  uint32_t          *level;
  CeldStatus         status;

  if (!s->changed_labels.width && !s->changed_corrections && s->ownership_level &&
      s->n_ownership_levels == s->order.n &&
      !memcmp (s->ownership_level, s->order.level, s->order.n * sizeof *s->ownership_level))
    return CELD_OK;
  level  = celd_alloc (s->order.n, sizeof *level);
  status = level ? read_corrections (s, &corrections) : CELD_NO_MEMORY;
  if (s->colours.data)
    input.colours = &s->colours;
  if (corrections.data)
    input.corrections = &corrections;
  if (status == CELD_OK)
    status = s->ownership_level && s->ownership_cache.level ? update_ownership (s, &input, host)
                                                            : make_ownership (s, &input, host);
  if (status == CELD_OK)
    record_levels (s, level);
  else
    {
      celd_session_discard_ownership (s);
      celd_free (level);
    }
  celd_free (corrections.data);
  return status;
}

/* ------------------------------------------------------------------ levels after expansion */

static CeldStatus
make_all_levels (CeldSession *s, const float *label_level, const CeldHost *host)
{
  CeldPlane  levels;
  CeldStatus status = celd_plane_new (s->ownership.owner.width, s->ownership.owner.height, &levels);

  for (int y = 0; status == CELD_OK && y < levels.height; y++)
    for (int x = 0; x < levels.width; x++)
      CELD_AT (&levels, x, y) = label_level[celd_larger_label (&s->ownership, x, y) - 1];
  if (status == CELD_OK)
    status = celd_progress (host, 1);
  if (status == CELD_OK)
    celd_session_replace_plane (s, STAGE_LEVELS, &s->levels, &levels);
  celd_free (levels.data);
  return status;
}

/* Updates levels where the ownership has changed. */
static void
update_levels (CeldSession *s, const float *label_level)
{
  CeldRect r = s->changed_ownership, changed = { 0 };

  for (int y = r.y; y < r.y + r.height; y++)
    for (int x = r.x; x < r.x + r.width; x++)
      {
        float level = label_level[celd_larger_label (&s->ownership, x, y) - 1];

        if (CELD_AT (&s->levels, x, y) != level)
          changed = celd_rect_union (changed, (CeldRect) { x, y, 1, 1 });
        CELD_AT (&s->levels, x, y) = level;
      }
  celd_session_add_change (s, STAGE_LEVELS, changed);
}

/* An update needs equal levels of the labels that were there before and still are; where labels were added or removed,
 * the ownership has changed. */
CeldStatus
celd_make_levels (CeldSession *s, const CeldHost *host)
{
  size_t     both = s->order.n < s->n_label_levels ? s->order.n : s->n_label_levels;
  float     *label_level = NULL;
  CeldStatus status = list_label_levels (s, &label_level);

  if (status != CELD_OK)
    return status;
  if (s->label_level && !memcmp (s->label_level, label_level, both * sizeof *label_level))
    update_levels (s, label_level);
  else
    status = make_all_levels (s, label_level, host);
  if (status == CELD_OK)
    {
      celd_free (s->label_level);
      s->label_level       = label_level;
      s->n_label_levels    = s->order.n;
      s->changed_ownership = (CeldRect) { 0 };
      label_level          = NULL;
    }
  celd_free (label_level);
  return status;
}
