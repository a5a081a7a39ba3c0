/* The settings, pictures and relations that a host sets in a session.  Hosts set all of them again for each preview, so
 * values equal to the current ones leave all results valid.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "order/order.h"
#include "session/session.h"

#include <string.h>

/* Whether `height` rows of `row` bytes are equal; NULL is equal to NULL alone.  Strides in bytes. */
static bool
same_rows (const void *a, size_t a_stride, const void *b, size_t b_stride, int height, size_t row)
{
  const uint8_t *p = a, *q = b;

  for (int y = 0; p && q && y < height; y++, p += a_stride, q += b_stride)
    if (memcmp (p, q, row))
      return false;
  return !p == !q;
}

static bool
same_plane (const CeldPlane *a, const CeldPlane *b)
{
  return a->width == b->width && a->height == b->height &&
         same_rows (a->data, a->stride * sizeof (float), b->data, b->stride * sizeof (float), a->height,
                    (size_t) a->width * sizeof (float));
}

static bool
same_paint (const CeldPaint *a, const CeldPaint *b)
{
  return a->width == b->width && a->height == b->height &&
         same_rows (a->data, 4 * a->stride, b->data, 4 * b->stride, a->height, 4 * (size_t) a->width);
}

static bool
same_relations (const CeldRelations *a, const CeldRelations *b)
{
  for (size_t i = 0; i < a->n && a->n == b->n; i++)
    {
      const CeldRelation *p = &a->item[i], *q = &b->item[i];

      if (!celd_term_same (&p->nearer, &q->nearer) || !celd_term_same (&p->farther, &q->farther) ||
          p->equal != q->equal || p->crack != q->crack || p->anchor != q->anchor || p->weight != q->weight ||
          p->gap != q->gap || p->line != q->line || p->column != q->column)
        return false;
    }
  return a->n == b->n;
}

/* The stages that a change of settings from a to b invalidates, as bits: by the table of settings, and two cases that
 * depend on values.  Only splitting on contradictions concerns the labels; the random walker reads the settings of the
 * weights. */
static unsigned
changed_stages (const CeldSettings *a, const CeldSettings *b)
{
  unsigned               stages = 0;
  size_t                 n;
  const CeldSettingInfo *info = celd_setting_infos (&n);

  for (size_t i = 0; i < n; i++)
    if (celd_setting_get (&info[i], a) != celd_setting_get (&info[i], b))
      stages |= info[i].stages;
  if ((a->on_cycle == CELD_ON_CYCLE_SPLIT) != (b->on_cycle == CELD_ON_CYCLE_SPLIT))
    stages |= 1u << STAGE_LABELS;
  if (b->method == CELD_METHOD_WALKER && stages & 1u << STAGE_WEIGHTS)
    stages |= 1u << STAGE_LABELS;
  return stages;
}

CeldStatus
celd_session_set_settings (CeldSession *session, const CeldSettings *settings)
{
  CeldStatus status = celd_settings_check (settings);
  unsigned   stages;

  if (status != CELD_OK)
    return status;
  stages = changed_stages (&session->settings, settings);
  for (int stage = 0; stage < N_STAGES; stage++)
    if (stages & 1u << stage)
      celd_session_invalidate (session, (CeldStage) stage);
  if (stages & 1u << STAGE_OWNERSHIP)
    celd_session_discard_ownership (session);
  session->settings = *settings;
  return CELD_OK;
}

static CeldStatus
copy_plane (const CeldPlane *from, CeldPlane *to)
{
  CeldStatus status = celd_plane_new (from->width, from->height, to);

  for (int y = 0; status == CELD_OK && y < from->height; y++)
    memcpy (&CELD_AT (to, 0, y), &CELD_AT (from, 0, y), (size_t) from->width * sizeof (float));
  return status;
}

/* Frees the layers, which must have the drawing's size. */
static void
clear_layers (CeldSession *s)
{
  celd_free (s->colours.data);
  celd_free (s->scribbles.data);
  celd_free (s->arrows.data);
  celd_free (s->contours.data);
  celd_free (s->hint.data);
  celd_free (s->corrections.data);
  celd_free (s->hidden.data);
  s->colours = s->scribbles = s->arrows = s->contours = s->corrections = s->hidden = (CeldPaint) { 0 };
  s->hint = (CeldPlane) { 0 };
}

CeldStatus
celd_session_set_drawing (CeldSession *session, const CeldDrawing *drawing)
{
  const CeldPlane *luma = &drawing->luma, *alpha = &drawing->alpha, *old = &session->drawing.luma;
  CeldDrawing      copy = { 0 };
  CeldStatus       status;

  if (!CELD_SAME_SIZE (luma, luma) || (alpha->data && !CELD_SAME_SIZE (luma, alpha)))
    return CELD_BAD_SIZE;
  if (same_plane (luma, old) && same_plane (alpha, &session->drawing.alpha))
    return CELD_OK;
  status = copy_plane (luma, &copy.luma);
  if (status == CELD_OK && alpha->data)
    status = copy_plane (alpha, &copy.alpha);
  if (status != CELD_OK)
    {
      celd_free (copy.luma.data);
      return status;
    }
  if (old->width != luma->width || old->height != luma->height)
    {
      celd_session_clear_results (session);
      clear_layers (session);
    }
  celd_free (session->drawing.luma.data);
  celd_free (session->drawing.alpha.data);
  session->drawing = copy;
  celd_session_invalidate (session, STAGE_INK);
  return CELD_OK;
}

static CeldStatus
set_layer (CeldSession *s, const CeldPaint *from, CeldPaint *layer, CeldStage stage)
{
  CeldPaint copy = { 0 };

  if (from)
    {
      size_t row = 4 * (size_t) from->width;

      if (!CELD_SAME_SIZE (&s->drawing.luma, from))
        return CELD_BAD_SIZE;
      if (same_paint (from, layer))
        return CELD_OK;
      copy = (CeldPaint) { from->width, from->height, (size_t) from->width, celd_alloc ((size_t) from->height, row) };
      if (!copy.data)
        return CELD_NO_MEMORY;
      for (int y = 0; y < from->height; y++)
        memcpy (CELD_RGBA (&copy, 0, y), CELD_RGBA (from, 0, y), row);
    }
  else if (!layer->data)
    return CELD_OK;
  celd_free (layer->data);
  *layer = copy;
  celd_session_invalidate (s, stage);
  return CELD_OK;
}

CeldStatus
celd_session_set_colours (CeldSession *session, const CeldPaint *colours)
{
  const uint8_t *old = session->colours.data;
  CeldStatus     status;

  if (colours && !CELD_SAME_SIZE (&session->drawing.luma, colours))
    return CELD_BAD_SIZE;
  if (colours && !celd_paint_is_coloured (colours))
    colours = NULL;
  status = set_layer (session, colours, &session->colours, STAGE_OWNERSHIP);
  if (session->colours.data != old)
    celd_session_discard_ownership (session);
  return status;
}

CeldStatus
celd_session_set_scribbles (CeldSession *session, const CeldPaint *scribbles)
{
  return set_layer (session, scribbles, &session->scribbles, STAGE_SCRIBBLES);
}

CeldStatus
celd_session_set_arrows (CeldSession *session, const CeldPaint *arrows)
{
  return set_layer (session, arrows, &session->arrows, STAGE_RELATIONS);
}

CeldStatus
celd_session_set_contours (CeldSession *session, const CeldPaint *contours)
{
  return set_layer (session, contours, &session->contours, STAGE_INK);
}

CeldStatus
celd_session_set_depth_hint (CeldSession *session, const CeldPlane *depth)
{
  CeldPlane  copy = { 0 };
  CeldStatus status = CELD_OK;

  if (depth && !CELD_SAME_SIZE (&session->drawing.luma, depth))
    return CELD_BAD_SIZE;
  if (same_plane (depth ? depth : &copy, &session->hint))
    return CELD_OK;
  if (depth)
    status = copy_plane (depth, &copy);
  if (status != CELD_OK)
    return status;
  celd_free (session->hint.data);
  session->hint = copy;
  celd_session_invalidate (session, STAGE_SUGGESTIONS);
  if (session->settings.suggest != CELD_SUGGEST_OFF)
    celd_session_invalidate (session, STAGE_ORDER);
  return CELD_OK;
}

/* Replaces `current` by the relations parsed from a text; NULL is an empty text. */
static CeldStatus
set_text (CeldSession *session, CeldStatus (*parse) (const char *text, CeldRelations *relations, CeldTextError *error),
          const char *text, CeldRelations *current, CeldTextError *error)
{
  CeldRelations relations = { 0 };
  CeldStatus    status = parse (text ? text : "", &relations, error);

  if (status != CELD_OK || same_relations (&relations, current))
    {
      celd_relations_clear (&relations);
      return status;
    }
  celd_relations_clear (current);
  *current = relations;
  celd_session_invalidate (session, STAGE_RELATIONS);
  return CELD_OK;
}

CeldStatus
celd_session_set_corrections (CeldSession *session, const CeldPaint *corrections)
{
  const uint8_t *old = session->corrections.data;
  CeldStatus     status = set_layer (session, corrections, &session->corrections, STAGE_OWNERSHIP);

  session->changed_corrections |= session->corrections.data != old;
  return status;
}

CeldStatus
celd_session_set_hidden (CeldSession *session, const CeldPaint *hidden)
{
  return set_layer (session, hidden, &session->hidden, STAGE_SHEETS);
}

CeldStatus
celd_session_set_relations (CeldSession *session, const char *text, CeldTextError *error)
{
  return set_text (session, celd_relations_parse, text, &session->text, error);
}

CeldStatus
celd_session_set_arrow_path (CeldSession *session, const char *path, CeldTextError *error)
{
  return set_text (session, celd_arrow_path_parse, path, &session->path, error);
}

/* Removes the relations of one id among the first `end`, and returns their number. */
static size_t
drop_relations (CeldRelations *relations, uint32_t id, size_t end)
{
  size_t kept = 0, n = relations->n;

  while (kept < end && relations->item[kept].id != id)
    kept++;
  if (kept == end)
    return 0;
  for (size_t i = kept; i < n; i++)
    if (i >= end || relations->item[i].id != id)
      relations->item[kept++] = relations->item[i];
  relations->n = kept;
  return n - kept;
}

/* Appends `added`, all of this id, and removes earlier relations of the id. */
static CeldStatus
append_single (CeldSession *s, uint32_t id, const CeldRelations *added)
{
  size_t     before = s->single.n;
  CeldStatus status = CELD_OK;

  for (size_t i = 0; i < added->n && status == CELD_OK; i++)
    status = celd_relation_add (&s->single, added->item[i]);
  if (status != CELD_OK)
    {
      s->single.n = before;
      return status;
    }
  drop_relations (&s->single, id, before);
  celd_session_invalidate (s, STAGE_RELATIONS);
  return CELD_OK;
}

CeldStatus
celd_session_put_relation (CeldSession *session, uint32_t id, const char *text, CeldTextError *error)
{
  CeldRelations added = { 0 };
  CeldStatus    status;

  if (!id || !text)
    return CELD_BAD_VALUE;
  status = celd_relations_parse (text, &added, error);
  for (size_t i = 0; i < added.n; i++)
    added.item[i].id = id;
  if (status == CELD_OK)
    status = append_single (session, id, &added);
  celd_relations_clear (&added);
  return status;
}

CeldStatus
celd_session_remove_relation (CeldSession *session, uint32_t id)
{
  if (!drop_relations (&session->single, id, session->single.n))
    return CELD_BAD_VALUE;
  celd_session_invalidate (session, STAGE_RELATIONS);
  return CELD_OK;
}
