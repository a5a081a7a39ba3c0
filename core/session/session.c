/* The results that a host asks a session for.  session-input.c has what it sets, stages.c how results are made.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "order/order.h"
#include "segment/segment.h"
#include "session/session.h"

#include <math.h>
#include <string.h>

#define LEAST_WIDTH 2   /* pixels, of painted closures and arrows: visible, and tight as a virtual contour (chosen) */
#define ARROW_WIDTH 0.6 /* stroke widths, of painted arrows: thinner than the drawing's lines (chosen) */

/* Makes a stage and reports where its result has changed since the host last got it. */
static CeldStatus
get_stage (CeldSession *s, CeldStage stage, const CeldHost *host, CeldRect *changed)
{
  CeldStatus status;

  if (!s->drawing.luma.data)
    return CELD_BAD_SIZE;
  status = celd_session_make (s, stage, host);
  if (status == CELD_OK)
    {
      if (changed)
        *changed = s->unreported[stage];
      s->unreported[stage] = (CeldRect) { 0 };
    }
  return status;
}

/* Makes a stage whose result is a plane of the session, and reports changes. */
static CeldStatus
get_plane (CeldSession *s, CeldStage stage, const CeldHost *host, const CeldPlane *result, CeldPlane *plane,
           CeldRect *changed)
{
  CeldStatus status = get_stage (s, stage, host, changed);

  if (status == CELD_OK)
    *plane = *result;
  return status;
}

CeldStatus
celd_session_ink (CeldSession *session, const CeldHost *host, CeldPlane *ink, CeldRect *changed)
{
  return get_plane (session, STAGE_INK, host, &session->ink, ink, changed);
}

CeldStatus
celd_session_labels (CeldSession *session, const CeldHost *host, CeldLabels *labels, CeldRect *changed)
{
  CeldStatus status = get_stage (session, STAGE_LABELS, host, changed);

  if (status == CELD_OK)
    *labels = *celd_session_current_labels (session);
  return status;
}

/* Does not report changes of the labels: celd_session_labels still will. */
CeldStatus
celd_session_closures (CeldSession *session, const CeldHost *host, const CeldClosures **closures)
{
  CeldStatus status = session->drawing.luma.data ? celd_session_make (session, STAGE_LABELS, host) : CELD_BAD_SIZE;

  if (status == CELD_OK)
    *closures = celd_segmenter_closures (session->segmenter);
  return status;
}

static void
make_transparent (CeldPaint *paint)
{
  for (int y = 0; y < paint->height; y++)
    memset (CELD_RGBA (paint, 0, y), 0, 4 * (size_t) paint->width);
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
  make_transparent (paint);
  width = celd_stroke_width (&session->ink);
  celd_closures_paint (closures, width < LEAST_WIDTH ? LEAST_WIDTH : width, paint);
  return CELD_OK;
}

CeldStatus
celd_session_suggestions (CeldSession *session, const CeldHost *host, const CeldRelations **suggested)
{
  CeldStatus status = get_stage (session, STAGE_SUGGESTIONS, host, NULL);

  if (status == CELD_OK)
    *suggested = &session->suggested;
  return status;
}

/* The suggestions but those about the background, which is behind all other regions anyway. */
static CeldStatus
select_arrows (const CeldSession *session, CeldRelations *arrows)
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
  double               width;
  CeldStatus           status;

  if (!CELD_SAME_SIZE (&session->drawing.luma, paint))
    return CELD_BAD_SIZE;
  status = celd_session_suggestions (session, host, &suggested);
  if (status == CELD_OK)
    status = select_arrows (session, &arrows);
  if (status == CELD_OK)
    {
      make_transparent (paint);
      width  = fmax (LEAST_WIDTH, ARROW_WIDTH * celd_stroke_width (&session->ink));
      status = celd_relations_paint (&arrows, width, paint);
    }
  celd_relations_clear (&arrows);
  return status;
}

CeldStatus
celd_session_order (CeldSession *session, const CeldHost *host, const CeldOrder **order)
{
  CeldStatus status = get_stage (session, STAGE_ORDER, host, NULL);

  if (status == CELD_OK)
    *order = &session->order;
  return status;
}

CeldStatus
celd_session_unexpanded_levels (CeldSession *session, const CeldHost *host, CeldPlane *levels, CeldRect *changed)
{
  return get_plane (session, STAGE_UNEXPANDED, host, &session->unexpanded, levels, changed);
}

CeldStatus
celd_session_ownership (CeldSession *session, const CeldHost *host, CeldOwnership *ownership, CeldRect *changed)
{
  CeldStatus status = get_stage (session, STAGE_OWNERSHIP, host, changed);

  if (status == CELD_OK)
    *ownership = session->ownership;
  return status;
}

CeldStatus
celd_session_sheets (CeldSession *session, const CeldHost *host, const CeldSheets **sheets)
{
  CeldStatus status = celd_session_make (session, STAGE_SHEETS, host);

  if (status == CELD_OK)
    *sheets = session->sheets;
  return status;
}

/* Layers are large and rarely needed, so the session does not keep them. */
static CeldStatus
cut_layers (CeldSession *s, const CeldColours *art, CeldStore store, bool complete, const CeldHost *host,
            CeldLayers **layers)
{
  CeldHostPart part[2];
  CeldHost     first = celd_host_part (&part[0], host, 0, 0.6), second = celd_host_part (&part[1], host, 0.6, 1);
  CeldStatus   status = celd_session_make (s, complete ? STAGE_SHEETS : STAGE_OWNERSHIP, &first);

  if (status == CELD_OK)
    status = celd_layers_cut (celd_session_depth_ink (s), &s->ownership, s->order.level, s->order.n, art,
                              complete ? s->sheets : NULL, store, &second, layers);
  return status;
}

CeldStatus
celd_session_layers (CeldSession *s, const CeldColours *art, CeldStore store, const CeldHost *host,
                     CeldLayers **layers)
{
  return cut_layers (s, art, store, s->settings.complete, host, layers);
}

CeldStatus
celd_session_model (CeldSession *s, const CeldColours *art, const CeldHost *host, CeldModel *model)
{
  CeldHostPart part[2];
  CeldHost     cutting = celd_host_part (&part[0], host, 0, 0.5), making = celd_host_part (&part[1], host, 0.5, 1);
  CeldLayers  *layers = NULL;
  CeldPlane    drawn = { 0 };
  CeldStatus   status = cut_layers (s, art, CELD_STORE_FLOAT, true, &cutting, &layers);
  const CeldPlane *borders = NULL;

  if (status == CELD_OK)
    status = celd_session_borders (s, &drawn, &borders);
  if (status == CELD_OK)
    status = celd_model (s->sheets, &s->ownership, layers, celd_session_split_ink (s), borders, &s->settings, &making,
                         model);
  celd_layers_free (layers);
  celd_free (drawn.data);
  return status;
}

CeldStatus
celd_session_puppet (CeldSession *s, const CeldColours *art, const CeldHost *host, CeldPuppet **puppet)
{
  CeldHostPart part[2];
  CeldHost     cutting = celd_host_part (&part[0], host, 0, 0.6), making = celd_host_part (&part[1], host, 0.6, 1);
  CeldLayers  *layers = NULL;
  CeldCracks   cracks = { 0 };
  CeldPlane    drawn = { 0 };
  uint32_t     background = 0;
  const CeldPlane *borders = NULL;
  CeldStatus   status = cut_layers (s, art, CELD_STORE_FLOAT, true, &cutting, &layers);

  for (uint32_t k = 0; k < s->palette.n && status == CELD_OK; k++)
    if (s->palette.item[k].background)
      background = k + 1;
  if (status == CELD_OK)
    status = celd_cracks_find (celd_session_current_labels (s), &s->palette, celd_session_relations (s),
                               celd_session_depth_ink (s), &cracks);
  if (status == CELD_OK)
    status = celd_session_borders (s, &drawn, &borders);
  if (status == CELD_OK)
    status = celd_puppet_new (layers, celd_session_split_ink (s), borders, background, &cracks, &s->settings, &making,
                              puppet);
  celd_free (drawn.data);
  celd_cracks_clear (&cracks);
  celd_layers_free (layers);
  return status;
}

CeldStatus
celd_session_relief (CeldSession *s, const CeldHost *host, CeldRelief *relief)
{
  CeldHostPart part[3];
  CeldHost     ordering = celd_host_part (&part[0], host, 0, 0.5), smoothing = celd_host_part (&part[1], host, 0.5, 0.6);
  CeldHost     making = celd_host_part (&part[2], host, 0.6, 1);
  CeldPlane    levels, depth, drawn = { 0 };
  CeldStatus   status = celd_session_levels (s, &ordering, &levels, NULL);
  const CeldPlane *borders = NULL;

  if (status == CELD_OK)
    status = celd_session_depth (s, &smoothing, &depth, NULL);
  if (status == CELD_OK)
    status = celd_session_borders (s, &drawn, &borders);
  if (status == CELD_OK)
    status = celd_relief (celd_session_split_ink (s), borders, &levels, &depth, &s->settings, &making, relief);
  celd_free (drawn.data);
  return status;
}

CeldStatus
celd_session_levels (CeldSession *session, const CeldHost *host, CeldPlane *levels, CeldRect *changed)
{
  return get_plane (session, STAGE_LEVELS, host, &session->levels, levels, changed);
}

CeldStatus
celd_session_depth_preview (CeldSession *session, const CeldHost *host, CeldPlane *quarter, CeldRect *changed)
{
  return get_plane (session, STAGE_PREVIEW, host, &session->preview, quarter, changed);
}

CeldStatus
celd_session_depth (CeldSession *session, const CeldHost *host, CeldPlane *depth, CeldRect *changed)
{
  return get_plane (session, STAGE_DEPTH, host, &session->depth, depth, changed);
}

CeldStatus
celd_session_normals (CeldSession *session, const CeldHost *host, CeldVectors *normals, CeldRect *changed)
{
  CeldStatus status = get_stage (session, STAGE_NORMALS, host, changed);

  if (status == CELD_OK)
    *normals = session->normals;
  return status;
}

CeldStatus
celd_session_shading (CeldSession *session, const CeldHost *host, CeldPlane *shading, CeldRect *changed)
{
  return get_plane (session, STAGE_SHADING, host, &session->shading, shading, changed);
}

CeldStatus
celd_session_exact (CeldSession *session, const CeldHost *host, CeldPlane *depth, CeldRect *changed)
{
  return get_plane (session, STAGE_EXACT, host, &session->exact_depth, depth, changed);
}

CeldStatus
celd_session_exact_preview (CeldSession *session, const CeldHost *host, CeldPlane *half)
{
  static const CeldStage before[] = { STAGE_RELATIONS, STAGE_INK, STAGE_SEEDS };
  const int              n = sizeof before / sizeof *before;
  CeldHostPart           share;
  CeldHost               solving = celd_host_part (&share, host, 0.2, 1);
  CeldStatus             status = CELD_OK;

  if (!session->drawing.luma.data)
    return CELD_BAD_SIZE;
  for (int i = 0; i < n && status == CELD_OK; i++)
    {
      CeldHostPart part;
      CeldHost     making = celd_host_part (&part, host, 0.2 * i / n, 0.2 * (i + 1) / n);

      status = celd_session_make (session, before[i], &making);
    }
  if (status == CELD_OK)
    status = celd_make_exact_preview (session, &solving);
  if (status == CELD_OK)
    *half = session->exact_preview;
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
  session->all_problems.n = session->all_problems.n_runs = 0;
  for (int stage = 0; stage < N_STAGES; stage++)
    for (size_t i = 0; session->valid[stage] && i < session->problems[stage].n; i++)
      if (celd_problem_copy (&session->problems[stage], i, &session->all_problems) != CELD_OK)
        return NULL;
  return &session->all_problems;
}
