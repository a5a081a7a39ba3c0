/* The session object: what the host sets, and what it asks for.  How results are made is in route.c.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "session.h"

#include <string.h>

CeldSession *
celd_session_new (void)
{
  CeldSession *s = celd_alloc0 (1, sizeof *s);

  if (s)
    s->settings = celd_settings ();
  return s;
}

/* Everything made: for a new drawing and at the end. */
static void
clear_results (CeldSession *s)
{
  celd_session_forget (s, STAGE_RELATIONS);
  celd_session_forget (s, STAGE_INK);
  for (int i = 0; i < N_STAGES; i++)
    {
      celd_problems_clear (&s->problems[i]);
      s->unseen[i] = (CeldRect) { 0 };
    }
  celd_relations_clear (&s->relations);
  celd_palette_clear (&s->palette);
  celd_order_clear (&s->order);
  celd_free (s->ink.data);
  celd_free (s->depth_ink.data);
  celd_free (s->painted.data);
  celd_free (s->labels.data);
  celd_free (s->flat.data);
  celd_free (s->levels.data);
  celd_free (s->depth.data);
  celd_free (s->shading.data);
  celd_free (s->normals.data);
  s->ink = s->depth_ink = s->flat = s->levels = s->depth = s->shading = (CeldPlane) { 0 };
  s->labels  = (CeldLabels) { 0 };
  s->painted = (CeldMask) { 0 };
  s->normals = (CeldVectors) { 0 };
}

/* The layers have the drawing's size, so they go when another size comes. */
static void
clear_layers (CeldSession *s)
{
  celd_free (s->scribbles.data);
  celd_free (s->arrows.data);
  celd_free (s->contours.data);
  s->scribbles = s->arrows = s->contours = (CeldPaint) { 0 };
}

void
celd_session_free (CeldSession *session)
{
  if (!session)
    return;
  clear_results (session);
  clear_layers (session);
  celd_problems_clear (&session->all_problems);
  celd_relations_clear (&session->text);
  celd_relations_clear (&session->single);
  for (size_t i = 0; i < session->n_strokes; i++)
    celd_free (session->stroke[i].mask.data);
  celd_free (session->stroke);
  celd_free (session->drawing.luma.data);
  celd_free (session->drawing.alpha.data);
  celd_free (session);
}

/* ------------------------------------------------------------------ setting: hosts set all again at each preview */

/* Do the rows of two pictures hold the same?  No picture is the same as no picture. */
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
same_term (const CeldTerm *a, const CeldTerm *b)
{
  return a->by_colour == b->by_colour && !memcmp (a->colour, b->colour, 3) && a->x == b->x && a->y == b->y;
}

static bool
same_relations (const CeldRelations *a, const CeldRelations *b)
{
  for (size_t i = 0; i < a->n && a->n == b->n; i++)
    {
      const CeldRelation *p = &a->item[i], *q = &b->item[i];

      if (!same_term (&p->nearer, &q->nearer) || !same_term (&p->farther, &q->farther) || p->equal != q->equal ||
          p->crack != q->crack || p->anchor != q->anchor || p->weight != q->weight || p->gap != q->gap ||
          p->line != q->line || p->column != q->column)
        return false;
    }
  return a->n == b->n;
}

CeldStatus
celd_session_set_settings (CeldSession *session, const CeldSettings *settings)
{
  const CeldSettings *a = &session->settings, *b = settings;
  CeldStatus          status = celd_settings_check (settings);

  if (status != CELD_OK)
    return status;
  if (a->ink != b->ink)
    celd_session_forget (session, STAGE_INK);
  if (a->arrow_style != b->arrow_style)
    celd_session_forget (session, STAGE_RELATIONS);
  if (a->method != b->method || a->hardness != b->hardness || a->flats != b->flats || a->background != b->background ||
      memcmp (a->background_colour, b->background_colour, 3) || a->seeds != b->seeds ||
      a->same_colour != b->same_colour || a->ink_threshold != b->ink_threshold)
    celd_session_forget (session, STAGE_LABELS);
  if (a->encoding != b->encoding || a->near_level != b->near_level || a->far_level != b->far_level)
    celd_session_forget (session, STAGE_ORDER);
  if (a->anchors != b->anchors || a->tolerance != b->tolerance)
    celd_session_forget (session, STAGE_DEPTH);
  if (a->bulge != b->bulge)
    celd_session_forget (session, STAGE_NORMALS);
  if (a->light_azimuth != b->light_azimuth || a->light_elevation != b->light_elevation || a->ambient != b->ambient)
    celd_session_forget (session, STAGE_SHADING);
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
      clear_results (session);
      clear_layers (session);
    }
  celd_free (session->drawing.luma.data);
  celd_free (session->drawing.alpha.data);
  session->drawing = copy;
  celd_session_forget (session, STAGE_INK);
  return CELD_OK;
}

static CeldStatus
set_layer (CeldSession *s, const CeldPaint *from, CeldPaint *layer, CeldStage first_touched)
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
  celd_session_forget (s, first_touched);
  return CELD_OK;
}

CeldStatus
celd_session_set_scribbles (CeldSession *session, const CeldPaint *scribbles)
{
  return set_layer (session, scribbles, &session->scribbles, STAGE_LABELS);
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
celd_session_set_relations (CeldSession *session, const char *text, CeldTextError *error)
{
  CeldRelations relations = { 0 };
  CeldStatus    status = celd_relations_parse (text ? text : "", &relations, error);

  if (status != CELD_OK || same_relations (&relations, &session->text))
    {
      celd_relations_clear (&relations);
      return status;
    }
  celd_relations_clear (&session->text);
  session->text = relations;
  celd_session_forget (session, STAGE_RELATIONS);
  return CELD_OK;
}

static CeldStroke *
find_stroke (CeldSession *s, uint32_t id)
{
  for (size_t i = 0; i < s->n_strokes; i++)
    if (s->stroke[i].id == id)
      return &s->stroke[i];
  return NULL;
}

CeldStatus
celd_session_put_stroke (CeldSession *session, uint32_t id, int x, int y, const CeldMask *mask, const uint8_t colour[3])
{
  CeldStroke *stroke = find_stroke (session, id);
  CeldMask    copy;
  CeldStatus  status;

  if (!id)
    return CELD_BAD_VALUE;
  if (!CELD_SAME_SIZE (mask, mask))
    return CELD_BAD_SIZE;
  status = celd_mask_new (mask->width, mask->height, &copy);
  if (status != CELD_OK)
    return status;
  for (int row = 0; row < mask->height; row++)
    memcpy (&CELD_AT (&copy, 0, row), &CELD_AT (mask, 0, row), (size_t) mask->width);
  if (!stroke)
    {
      CeldStroke *grown = celd_grow (session->stroke, session->n_strokes + 1, sizeof *grown);

      if (!grown)
        {
          celd_free (copy.data);
          return CELD_NO_MEMORY;
        }
      session->stroke = grown;
      stroke = &grown[session->n_strokes++];
      stroke->mask.data = NULL;
    }
  celd_free (stroke->mask.data);
  *stroke = (CeldStroke) { id, x, y, copy, { colour[0], colour[1], colour[2] } };
  celd_session_forget (session, STAGE_LABELS);
  return CELD_OK;
}

CeldStatus
celd_session_remove_stroke (CeldSession *session, uint32_t id)
{
  CeldStroke *stroke = find_stroke (session, id);
  size_t      behind;

  if (!stroke)
    return CELD_BAD_VALUE;
  behind = (size_t) (session->stroke + session->n_strokes - (stroke + 1));
  celd_free (stroke->mask.data);
  memmove (stroke, stroke + 1, behind * sizeof *stroke);
  session->n_strokes--;
  celd_session_forget (session, STAGE_LABELS);
  return CELD_OK;
}

/* Without the relations of one id; how many there were. */
static size_t
drop_relations (CeldRelations *relations, uint32_t id)
{
  size_t kept = 0, n = relations->n;

  for (size_t i = 0; i < n; i++)
    if (relations->item[i].id != id)
      relations->item[kept++] = relations->item[i];
  relations->n = kept;
  return n - kept;
}

CeldStatus
celd_session_put_relation (CeldSession *session, uint32_t id, const char *text, CeldTextError *error)
{
  CeldRelations all = { 0 };
  CeldStatus    status = CELD_OK;

  if (!id || !text)
    return CELD_BAD_VALUE;
  for (size_t i = 0; i < session->single.n && status == CELD_OK; i++)
    if (session->single.item[i].id != id)
      status = celd_relation_add (&all, session->single.item[i]);
  if (status == CELD_OK)
    {
      size_t others = all.n;

      status = celd_relations_parse (text, &all, error);
      for (size_t i = others; i < all.n; i++)
        all.item[i].id = id;
    }
  if (status != CELD_OK)
    {
      celd_relations_clear (&all);
      return status;
    }
  celd_relations_clear (&session->single);
  session->single = all;
  celd_session_forget (session, STAGE_RELATIONS);
  return CELD_OK;
}

CeldStatus
celd_session_remove_relation (CeldSession *session, uint32_t id)
{
  if (!drop_relations (&session->single, id))
    return CELD_BAD_VALUE;
  celd_session_forget (session, STAGE_RELATIONS);
  return CELD_OK;
}

/* ------------------------------------------------------------------ asking */

/* Makes a stage and hands over what the host has not seen of it. */
static CeldStatus
ask (CeldSession *s, CeldStage stage, const CeldRun *run, CeldRect *changed)
{
  CeldStatus status;

  if (!s->drawing.luma.data)
    return CELD_BAD_SIZE;
  status = celd_session_make (s, stage, run);
  if (status == CELD_OK)
    {
      if (changed)
        *changed = s->unseen[stage];
      s->unseen[stage] = (CeldRect) { 0 };
    }
  return status;
}

CeldStatus
celd_session_ink (CeldSession *session, const CeldRun *run, CeldPlane *ink, CeldRect *changed)
{
  CeldStatus status = ask (session, STAGE_INK, run, changed);

  if (status == CELD_OK)
    *ink = session->ink;
  return status;
}

CeldStatus
celd_session_labels (CeldSession *session, const CeldRun *run, CeldLabels *labels, CeldRect *changed)
{
  CeldStatus status = ask (session, STAGE_LABELS, run, changed);

  if (status == CELD_OK)
    *labels = session->labels;
  return status;
}

CeldStatus
celd_session_order (CeldSession *session, const CeldRun *run, const CeldOrder **order)
{
  CeldStatus status = ask (session, STAGE_ORDER, run, NULL);

  if (status == CELD_OK)
    *order = &session->order;
  return status;
}

CeldStatus
celd_session_flat (CeldSession *session, const CeldRun *run, CeldPlane *levels, CeldRect *changed)
{
  CeldStatus status = ask (session, STAGE_FLAT, run, changed);

  if (status == CELD_OK)
    *levels = session->flat;
  return status;
}

CeldStatus
celd_session_levels (CeldSession *session, const CeldRun *run, CeldPlane *levels, CeldRect *changed)
{
  CeldStatus status = ask (session, STAGE_LEVELS, run, changed);

  if (status == CELD_OK)
    *levels = session->levels;
  return status;
}

CeldStatus
celd_session_depth (CeldSession *session, const CeldRun *run, CeldPlane *depth, CeldRect *changed)
{
  CeldStatus status = ask (session, STAGE_DEPTH, run, changed);

  if (status == CELD_OK)
    *depth = session->depth;
  return status;
}

CeldStatus
celd_session_normals (CeldSession *session, const CeldRun *run, CeldVectors *normals, CeldRect *changed)
{
  CeldStatus status = ask (session, STAGE_NORMALS, run, changed);

  if (status == CELD_OK)
    *normals = session->normals;
  return status;
}

CeldStatus
celd_session_shading (CeldSession *session, const CeldRun *run, CeldPlane *shading, CeldRect *changed)
{
  CeldStatus status = ask (session, STAGE_SHADING, run, changed);

  if (status == CELD_OK)
    *shading = session->shading;
  return status;
}

const CeldPalette *
celd_session_palette (const CeldSession *session)
{
  return &session->palette;
}

const CeldRelations *
celd_session_relations (const CeldSession *session)
{
  return &session->relations;
}

const CeldProblems *
celd_session_problems (CeldSession *session)
{
  session->all_problems.n = 0;
  for (int stage = 0; stage < N_STAGES; stage++)
    for (size_t i = 0; session->valid[stage] && i < session->problems[stage].n; i++)
      if (celd_problem_add (&session->all_problems, session->problems[stage].item[i]) != CELD_OK)
        return NULL;
  return &session->all_problems;
}
