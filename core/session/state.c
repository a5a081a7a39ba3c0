/* The state of a session: creating, clearing and freeing it, which results are valid, and where they have changed
 * since the host last got them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "session/session.h"

#include <string.h>

/* ------------------------------------------------------------------ validity */

#define NEEDS(stage) (1u << STAGE_##stage)

/* The results that a stage is made from.  A stage names earlier stages only. */
static const unsigned needs[N_STAGES] = {
  [STAGE_SEEDS]       = NEEDS (SCRIBBLES),
  [STAGE_LABELS]      = NEEDS (INK) | NEEDS (SEEDS),
  [STAGE_SUGGESTIONS] = NEEDS (LABELS),
  [STAGE_ORDER]       = NEEDS (LABELS) | NEEDS (RELATIONS),
  [STAGE_UNEXPANDED]  = NEEDS (ORDER),
  [STAGE_OWNERSHIP]   = NEEDS (ORDER),
  [STAGE_SHEETS]      = NEEDS (OWNERSHIP),
  [STAGE_LEVELS]      = NEEDS (OWNERSHIP),
  [STAGE_PREVIEW]     = NEEDS (ORDER),
  [STAGE_DEPTH]       = NEEDS (LEVELS),
  [STAGE_NORMALS]     = NEEDS (LEVELS) | NEEDS (SHEETS),
  [STAGE_SHADING]     = NEEDS (NORMALS),
  [STAGE_WEIGHTS]     = NEEDS (INK),
  [STAGE_NODES]       = NEEDS (SEEDS) | NEEDS (WEIGHTS),
  [STAGE_EXACT]       = NEEDS (NODES) | NEEDS (RELATIONS),
};

unsigned
celd_stage_needs (CeldStage stage)
{
  return needs[stage];
}

void
celd_session_invalidate (CeldSession *session, CeldStage stage)
{
  unsigned invalid = 1u << stage;

  for (int s = 0; s < N_STAGES; s++)
    {
      if (needs[s] & invalid)
        invalid |= 1u << s;
      if (invalid & (1u << s))
        session->valid[s] = false;
    }
}

void
celd_session_discard_ownership (CeldSession *session)
{
  celd_free (session->ownership_level);
  session->ownership_level = NULL;
  celd_ownership_cache_clear (&session->ownership_cache);
}

void
celd_session_discard_label_levels (CeldSession *session)
{
  celd_free (session->label_level);
  session->label_level = NULL;
}

/* ------------------------------------------------------------------ changes */

CeldRect
celd_changed_rect (const void *old, const void *new, int width, int height, size_t pixel)
{
  CeldRect       all = { 0, 0, width, height }, found = { 0 };
  const uint8_t *a = old, *b = new;
  size_t         row = (size_t) width * pixel;

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
celd_session_add_change (CeldSession *session, CeldStage stage, CeldRect changed)
{
  session->unreported[stage] = celd_rect_union (session->unreported[stage], changed);
}

void
celd_session_replace_plane (CeldSession *session, CeldStage stage, CeldPlane *old, CeldPlane *new)
{
  celd_session_add_change (session, stage,
                           celd_changed_rect (old->data, new->data, new->width, new->height, sizeof (float)));
  celd_free (old->data);
  *old = *new;
  new->data = NULL;
}

/* ------------------------------------------------------------------ current results */

const CeldLabels *
celd_session_current_labels (const CeldSession *session)
{
  return session->separated.data ? &session->separated : &session->segmented;
}

const CeldPlane *
celd_session_depth_ink (const CeldSession *session)
{
  return session->depth_ink.data ? &session->depth_ink : &session->ink;
}

const CeldPlane *
celd_session_split_ink (const CeldSession *session)
{
  return session->split_ink.data ? &session->split_ink : celd_session_depth_ink (session);
}

bool
celd_session_relation_keeps_labels (const CeldSession *session, const CeldRelation *relation)
{
  return celd_segmenter_is_redundant (session->segmenter, relation, &session->settings, &session->segmented);
}

/* ------------------------------------------------------------------ creating and freeing */

CeldSession *
celd_session_new (void)
{
  CeldSession *s = celd_alloc0 (1, sizeof *s);

  if (s)
    s->settings = celd_settings ();
  return s;
}

/* Frees all pictures that were made. */
static void
clear_made (CeldSession *s)
{
  CeldPlane *plane[] = { &s->ink, &s->depth_ink, &s->split_ink, &s->segmenter_ink, &s->unexpanded, &s->levels,
                         &s->preview, &s->preview_ink, &s->depth, &s->shading, &s->exact_preview, &s->exact_depth };

  celd_session_invalidate (s, STAGE_RELATIONS);
  celd_session_invalidate (s, STAGE_INK);
  celd_session_invalidate (s, STAGE_SCRIBBLES);
  for (int i = 0; i < N_STAGES; i++)
    s->unreported[i] = (CeldRect) { 0 };
  celd_seed_rows_clear (&s->layer_seeds);
  celd_seed_rows_clear (&s->seeds);
  celd_smooth_state_clear (&s->smooth_state);
  celd_smooth_state_clear (&s->preview_state);
  celd_session_discard_ownership (s);
  celd_session_discard_label_levels (s);
  celd_ownership_clear (&s->ownership);
  celd_sheets_free (s->sheets);
  celd_segmenter_free (s->segmenter);
  celd_program_free (s->program);
  celd_free (s->splits.item);
  celd_free (s->segmented.data);
  celd_free (s->separated.data);
  celd_free (s->sheet_hints.data);
  celd_free (s->normals.data);
  if (s->segmenter_ink.data == s->ink.data)
    s->segmenter_ink = (CeldPlane) { 0 };
  for (size_t i = 0; i < sizeof plane / sizeof *plane; i++)
    {
      celd_free (plane[i]->data);
      *plane[i] = (CeldPlane) { 0 };
    }
  s->sheets      = NULL;
  s->segmenter   = NULL;
  s->program     = NULL;
  s->stroke_width = 0;
  s->splits      = (CeldSplits) { 0 };
  s->segmented = s->separated = s->sheet_hints = (CeldLabels) { 0 };
  s->normals = (CeldVectors) { 0 };
}

void
celd_session_clear_results (CeldSession *s)
{
  clear_made (s);
  for (int i = 0; i < N_STAGES; i++)
    celd_problems_clear (&s->problems[i]);
  celd_relations_clear (&s->relations);
  celd_relations_clear (&s->suggested);
  celd_relations_clear (&s->joined);
  celd_palette_clear (&s->layer_palette);
  celd_palette_clear (&s->seed_palette);
  celd_palette_clear (&s->palette);
  celd_order_clear (&s->order);
  celd_palette_clear (&s->exact_palette);
  celd_exact_clear (&s->exact);
}

void
celd_session_drop_pictures (CeldSession *s)
{
  CeldPaint *paint[] = { &s->colours, &s->scribbles, &s->arrows, &s->contours, &s->corrections, &s->hidden };
  CeldPlane *plane[] = { &s->hint, &s->drawing.luma, &s->drawing.alpha };

  clear_made (s);
  for (size_t i = 0; i < sizeof paint / sizeof *paint; i++)
    {
      celd_free (paint[i]->data);
      *paint[i] = (CeldPaint) { 0 };
    }
  for (size_t i = 0; i < sizeof plane / sizeof *plane; i++)
    {
      celd_free (plane[i]->data);
      *plane[i] = (CeldPlane) { 0 };
    }
}

void
celd_session_free (CeldSession *session)
{
  if (!session)
    return;
  celd_session_clear_results (session);
  celd_problems_clear (&session->all_problems);
  celd_relations_clear (&session->text);
  celd_relations_clear (&session->path);
  celd_relations_clear (&session->single);
  for (size_t i = 0; i < session->n_strokes; i++)
    celd_free (session->stroke[i].span);
  celd_free (session->stroke);
  celd_session_drop_pictures (session);
  celd_free (session);
}
