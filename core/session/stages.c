/* The stages of the paper's method as a session makes them: each from earlier ones, and only what is missing.
 *
 *   drawing, contours ----> ink ------.--------------.----------------.
 *   scribbles, strokes -> seeds -> labels -> order -> unexpanded levels, levels -+-> preview of depth, depth
 *   arrows, text ---> relations ------'                                   levels -> normals -> shading
 *
 *   ink -> weights -> nodes (of the seeds) -> exact depth (with the relations)
 *
 * What a stage needs stands in state.c; how it is made in the file stage-*.c that this table names.  A stage writes
 * into new memory and replaces the old result only when it succeeds.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "session/session.h"

static const struct
{
  CeldStatus (*make) (CeldSession *session, const CeldHost *host);
  double     share; /* of the time of all stages on a typical drawing, for progress */
} stages[N_STAGES] = {
  [STAGE_RELATIONS]   = { celd_make_relations,   0.02 },
  [STAGE_INK]         = { celd_make_ink,         0.09 },
  [STAGE_SCRIBBLES]   = { celd_make_scribbles,   0.09 },
  [STAGE_SEEDS]       = { celd_make_seeds,       0.01 },
  [STAGE_LABELS]      = { celd_make_labels,      0.09 },
  [STAGE_SUGGESTIONS] = { celd_make_suggestions, 0.05 },
  [STAGE_ORDER]       = { celd_make_order,       0.02 },
  [STAGE_UNEXPANDED]  = { celd_make_unexpanded,  0.01 },
  [STAGE_OWNERSHIP]   = { celd_make_ownership,   0.20 },
  [STAGE_LEVELS]      = { celd_make_levels,      0.01 },
  [STAGE_PREVIEW]     = { celd_make_preview,     0.02 },
  [STAGE_DEPTH]       = { celd_make_depth,       0.05 },
  [STAGE_NORMALS]     = { celd_make_normals,     0.24 },
  [STAGE_SHADING]     = { celd_make_shading,     0.01 },
  [STAGE_WEIGHTS]     = { celd_make_weights,     0.02 },
  [STAGE_NODES]       = { celd_make_nodes,       0.10 },
  [STAGE_EXACT]       = { celd_make_exact,       2.00 },
};

/* What has to be made before a stage, although not every change of it makes the stage invalid: relations forget the
 * labels themselves where these depend on them, and the order is made from suggestions if the settings say so. */
static unsigned
precedes (const CeldSession *session, CeldStage stage)
{
  unsigned before = celd_stage_needs (stage);

  if (stage == STAGE_LABELS)
    before |= 1u << STAGE_RELATIONS;
  if (stage == STAGE_ORDER && session->settings.suggest != CELD_SUGGEST_OFF)
    before |= 1u << STAGE_SUGGESTIONS;
  return before;
}

/* The stages that are to be made, or may turn out to be. */
static unsigned
open_stages (const CeldSession *session)
{
  unsigned open = 0;

  for (int s = 0; s < N_STAGES; s++)
    if (!session->valid[s] || (precedes (session, (CeldStage) s) & open))
      open |= 1u << s;
  return open;
}

/* A stage is preceded by earlier ones only, so one pass backwards finds all that are wanted. */
CeldStatus
celd_session_make (CeldSession *session, CeldStage stage, const CeldHost *host)
{
  unsigned   wanted = 1u << stage, open = open_stages (session);
  double     total = 0, done = 0;
  CeldStatus status = CELD_OK;

  for (int s = N_STAGES - 1; s >= 0; s--)
    if (wanted & (1u << s))
      {
        wanted |= precedes (session, (CeldStage) s);
        total += open & (1u << s) ? stages[s].share : 0;
      }
  for (int s = 0; s < N_STAGES && status == CELD_OK; s++)
    if ((wanted & (1u << s)) && !session->valid[s])
      {
        CeldHostPart part;
        CeldHost     step = celd_host_part (&part, host, done / total, (done + stages[s].share) / total);

        status = stages[s].make (session, &step);
        session->valid[s] = status == CELD_OK;
        done += stages[s].share;
      }
  return status;
}
