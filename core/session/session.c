/* The session object, and what the host asks for.  What it sets is in session-input.c, how results are made in route.c.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "depth/depth.h"
#include "depth/program.h"
#include "image/image.h"
#include "order/order.h"
#include "segment/segment.h"
#include "session/session.h"

#include <math.h>
#include <string.h>

#define THINNEST 2 /* pixels: a closure that can be seen, and that nothing leaks past when it is a virtual contour */
#define SLENDER  0.6 /* stroke widths: an arrow beside the drawing's lines */

CeldSession *
celd_session_new (void)
{
  CeldSession *s = celd_alloc0 (1, sizeof *s);

  if (s)
    s->settings = celd_settings ();
  return s;
}

void
celd_session_clear_results (CeldSession *session)
{
  CeldSession *s = session;

  celd_session_forget (s, STAGE_RELATIONS);
  celd_session_forget (s, STAGE_INK);
  celd_session_forget (s, STAGE_SCRIBBLES);
  for (int i = 0; i < N_STAGES; i++)
    {
      celd_problems_clear (&s->problems[i]);
      s->unseen[i] = (CeldRect) { 0 };
    }
  celd_relations_clear (&s->relations);
  celd_relations_clear (&s->suggested);
  celd_relations_clear (&s->joined);
  celd_palette_clear (&s->layer_palette);
  celd_palette_clear (&s->seed_palette);
  celd_palette_clear (&s->palette);
  celd_seed_rows_clear (&s->layer_seeds);
  celd_seed_rows_clear (&s->seeds);
  celd_order_clear (&s->order);
  celd_ranks_clear (&s->ranks);
  celd_segmenter_free (s->segmenter);
  celd_program_free (s->program);
  celd_palette_clear (&s->exact_palette);
  celd_exact_clear (&s->exact);
  if (s->known_ink.data != s->ink.data)
    celd_free (s->known_ink.data);
  celd_free (s->ink.data);
  celd_free (s->depth_ink.data);
  celd_free (s->solved.data);
  celd_free (s->separated.data);
  celd_free (s->flat.data);
  celd_free (s->levels.data);
  celd_session_clear_ownership (s);
  celd_free (s->preview.data);
  celd_free (s->depth.data);
  celd_free (s->block_ink.data);
  celd_free (s->bent_ink.data);
  celd_free (s->splits.item);
  celd_smoother_clear (&s->smoother);
  celd_smoother_clear (&s->preview_smoother);
  celd_free (s->shading.data);
  celd_free (s->exact_preview.data);
  celd_free (s->exact_depth.data);
  celd_free (s->normals.data);
  s->segmenter = NULL;
  s->program   = NULL;
  s->reach     = 0;
  s->known_ink = s->ink = s->depth_ink = s->block_ink = s->bent_ink = (CeldPlane) { 0 };
  s->splits = (CeldSplits) { 0 };
  s->flat = s->levels = s->preview = s->depth = s->shading = (CeldPlane) { 0 };
  s->solved  = s->separated = (CeldLabels) { 0 };
  s->normals = (CeldVectors) { 0 };
  s->exact_preview = s->exact_depth = (CeldPlane) { 0 };
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
  celd_strokes_clear (session->stroke, session->n_strokes);
  celd_free (session->stroke);
  celd_free (session->scribbles.data);
  celd_free (session->corrections.data);
  celd_free (session->arrows.data);
  celd_free (session->contours.data);
  celd_free (session->hint.data);
  celd_free (session->drawing.luma.data);
  celd_free (session->drawing.alpha.data);
  celd_free (session);
}

/* ------------------------------------------------------------------ asking */

/* Makes a stage and hands over what the host has not seen of it. */
static CeldStatus
ask (CeldSession *s, CeldStage stage, const CeldHost *host, CeldRect *changed)
{
  CeldStatus status;

  if (!s->drawing.luma.data)
    return CELD_BAD_SIZE;
  status = celd_session_make (s, stage, host);
  if (status == CELD_OK)
    {
      if (changed)
        *changed = s->unseen[stage];
      s->unseen[stage] = (CeldRect) { 0 };
    }
  return status;
}

CeldStatus
celd_session_ink (CeldSession *session, const CeldHost *host, CeldPlane *ink, CeldRect *changed)
{
  CeldStatus status = ask (session, STAGE_INK, host, changed);

  if (status == CELD_OK)
    *ink = session->ink;
  return status;
}

CeldStatus
celd_session_labels (CeldSession *session, const CeldHost *host, CeldLabels *labels, CeldRect *changed)
{
  CeldStatus status = ask (session, STAGE_LABELS, host, changed);

  if (status == CELD_OK)
    *labels = *celd_session_current_labels (session);
  return status;
}

/* The rectangle of the labels stays to be asked for. */
CeldStatus
celd_session_closures (CeldSession *session, const CeldHost *host, const CeldClosures **closures)
{
  CeldStatus status = session->drawing.luma.data ? celd_session_make (session, STAGE_LABELS, host) : CELD_BAD_SIZE;

  if (status == CELD_OK)
    *closures = celd_segmenter_closures (session->segmenter);
  return status;
}

CeldStatus
celd_session_paint_closures (CeldSession *session, const CeldHost *host, CeldPaint *paint)
{
  const CeldClosures *closures;
  int                 width;
  CeldStatus          status;

  if (!CELD_SAME_SIZE (&session->drawing.luma, paint))
    return CELD_BAD_SIZE;
  status = celd_session_closures (session, host, &closures);
  if (status != CELD_OK)
    return status;
  for (int y = 0; y < paint->height; y++)
    memset (CELD_RGBA (paint, 0, y), 0, 4 * (size_t) paint->width);
  width = celd_stroke_width (&session->ink);
  celd_closures_paint (closures, width < THINNEST ? THINNEST : width, paint);
  return CELD_OK;
}

CeldStatus
celd_session_suggestions (CeldSession *session, const CeldHost *host, const CeldRelations **suggested)
{
  CeldStatus status = ask (session, STAGE_SUGGESTIONS, host, NULL);

  if (status == CELD_OK)
    *suggested = &session->suggested;
  return status;
}

/* Without those about the background, which is behind everything as it is. */
static CeldStatus
choose_arrows (const CeldSession *session, CeldRelations *arrows)
{
  const CeldLabels *labels = celd_session_current_labels (session);
  CeldStatus        status = CELD_OK;

  for (size_t i = 0; i < session->suggested.n && status == CELD_OK; i++)
    {
      const CeldRelation *relation = &session->suggested.item[i];
      uint32_t            farther = CELD_AT (labels, (int) relation->farther.x, (int) relation->farther.y);

      if (!session->palette.item[farther - 1].background)
        status = celd_relation_add (arrows, *relation);
    }
  return status;
}

CeldStatus
celd_session_paint_suggestions (CeldSession *session, const CeldHost *host, CeldPaint *paint)
{
  const CeldRelations *suggested;
  CeldRelations        arrows = { 0 };
  CeldStatus           status;

  if (!CELD_SAME_SIZE (&session->drawing.luma, paint))
    return CELD_BAD_SIZE;
  status = celd_session_suggestions (session, host, &suggested);
  if (status == CELD_OK)
    status = choose_arrows (session, &arrows);
  if (status == CELD_OK)
    {
      for (int y = 0; y < paint->height; y++)
        memset (CELD_RGBA (paint, 0, y), 0, 4 * (size_t) paint->width);
      status = celd_relations_paint (&arrows, fmax (THINNEST, SLENDER * celd_stroke_width (&session->ink)), paint);
    }
  celd_relations_clear (&arrows);
  return status;
}

CeldStatus
celd_session_order (CeldSession *session, const CeldHost *host, const CeldOrder **order)
{
  CeldStatus status = ask (session, STAGE_ORDER, host, NULL);

  if (status == CELD_OK)
    *order = &session->order;
  return status;
}

CeldStatus
celd_session_flat (CeldSession *session, const CeldHost *host, CeldPlane *levels, CeldRect *changed)
{
  CeldStatus status = ask (session, STAGE_FLAT, host, changed);

  if (status == CELD_OK)
    *levels = session->flat;
  return status;
}

CeldStatus
celd_session_ownership (CeldSession *session, const CeldHost *host, CeldOwnership *ownership, CeldRect *changed)
{
  CeldStatus status = ask (session, STAGE_OWNERSHIP, host, changed);

  if (status == CELD_OK)
    *ownership = session->ownership;
  return status;
}

CeldStatus
celd_session_levels (CeldSession *session, const CeldHost *host, CeldPlane *levels, CeldRect *changed)
{
  CeldStatus status = ask (session, STAGE_LEVELS, host, changed);

  if (status == CELD_OK)
    *levels = session->levels;
  return status;
}

CeldStatus
celd_session_depth_preview (CeldSession *session, const CeldHost *host, CeldPlane *quarter, CeldRect *changed)
{
  CeldStatus status = ask (session, STAGE_PREVIEW, host, changed);

  if (status == CELD_OK)
    *quarter = session->preview;
  return status;
}

CeldStatus
celd_session_depth (CeldSession *session, const CeldHost *host, CeldPlane *depth, CeldRect *changed)
{
  CeldStatus status = ask (session, STAGE_DEPTH, host, changed);

  if (status == CELD_OK)
    *depth = session->depth;
  return status;
}

CeldStatus
celd_session_normals (CeldSession *session, const CeldHost *host, CeldVectors *normals, CeldRect *changed)
{
  CeldStatus status = ask (session, STAGE_NORMALS, host, changed);

  if (status == CELD_OK)
    *normals = session->normals;
  return status;
}

CeldStatus
celd_session_shading (CeldSession *session, const CeldHost *host, CeldPlane *shading, CeldRect *changed)
{
  CeldStatus status = ask (session, STAGE_SHADING, host, changed);

  if (status == CELD_OK)
    *shading = session->shading;
  return status;
}

CeldStatus
celd_session_exact (CeldSession *session, const CeldHost *host, CeldPlane *depth, CeldRect *changed)
{
  CeldStatus status = ask (session, STAGE_EXACT, host, changed);

  if (status == CELD_OK)
    *depth = session->exact_depth;
  return status;
}

const CeldExact *
celd_session_exact_report (const CeldSession *session)
{
  return session->valid[STAGE_EXACT] ? &session->exact : NULL;
}

const CeldPalette *
celd_session_exact_palette (const CeldSession *session)
{
  return &session->exact_palette;
}

const CeldPalette *
celd_session_palette (const CeldSession *session)
{
  return &session->palette;
}

const CeldRelations *
celd_session_relations (const CeldSession *session)
{
  return session->settings.suggest && session->valid[STAGE_ORDER] ? &session->joined : &session->relations;
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
