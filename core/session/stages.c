/* The stages of the paper's method in a session: each is made from earlier ones, and only when it is not valid.
 *
 *   drawing, contours ----> ink ------.--------------.----------------.
 *   scribbles, strokes -> seeds -> labels -> order -> unexpanded levels, levels -+-> preview of depth, depth
 *   arrows, text ---> relations ------'                  ownership -> sheets      levels -> normals -> shading
 *
 *   ink -> weights -> nodes (of the seeds) -> exact depth (with the relations)
 *
 * The table in state.c says which stages one needs; the table below names the function that makes it, in a file
 * stage-*.c.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "session/session.h"

static const struct
{
  CeldStatus (*make) (CeldSession *session, const CeldHost *host);
  double     share; /* of the time of all stages but STAGE_EXACT on a typical drawing, for progress (tests/bench) */
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
  [STAGE_SHEETS]      = { celd_make_sheets,      0.06 },
  [STAGE_LEVELS]      = { celd_make_levels,      0.01 },
  [STAGE_PREVIEW]     = { celd_make_preview,     0.02 },
  [STAGE_DEPTH]       = { celd_make_depth,       0.05 },
  [STAGE_NORMALS]     = { celd_make_normals,     0.24 },
  [STAGE_SHADING]     = { celd_make_shading,     0.01 },
  [STAGE_WEIGHTS]     = { celd_make_weights,     0.02 },
  [STAGE_NODES]       = { celd_make_nodes,       0.10 },
  [STAGE_EXACT]       = { celd_make_exact,       2.00 },
};

/* The stages that have to be valid before `stage` is made, as bits.  They are those that it is made from, and two more
 * that do not always make it invalid: celd_make_relations decides whether new relations change the labels, and the
 * order uses suggestions only if the settings say so. */
static unsigned
prerequisites (const CeldSession *session, CeldStage stage)
{
  unsigned before = celd_stage_needs (stage);

  if (stage == STAGE_LABELS)
    before |= 1u << STAGE_RELATIONS;
  if (stage == STAGE_ORDER && session->settings.suggest != CELD_SUGGEST_OFF)
    before |= 1u << STAGE_SUGGESTIONS;
  return before;
}

/* The stages that are invalid, or may become so when their prerequisites are made. */
static unsigned
outdated_stages (const CeldSession *session)
{
  unsigned outdated = 0;

  for (int s = 0; s < N_STAGES; s++)
    if (!session->valid[s] || (prerequisites (session, (CeldStage) s) & outdated))
      outdated |= 1u << s;
  return outdated;
}

/* Prerequisites are earlier stages, so one pass backwards finds all stages that are wanted. */
CeldStatus
celd_session_make (CeldSession *session, CeldStage stage, const CeldHost *host)
{
  unsigned   wanted = 1u << stage, outdated = outdated_stages (session);
  double     total = 0, done = 0;
  CeldStatus status = CELD_OK;

  for (int s = N_STAGES - 1; s >= 0; s--)
    if (wanted & (1u << s))
      {
        wanted |= prerequisites (session, (CeldStage) s);
        total += outdated & (1u << s) ? stages[s].share : 0;
      }
  for (int s = 0; s < N_STAGES && status == CELD_OK; s++)
    if ((wanted & (1u << s)) && !session->valid[s])
      {
        CeldHostPart part;
        double       end = (done + stages[s].share) / total;
        CeldHost     step = celd_host_part (&part, host, done / total, end < 1 ? end : 1); /* rounding can exceed 1 */

        status = stages[s].make (session, &step);
        session->valid[s] = status == CELD_OK;
        done += stages[s].share;
      }
  return status;
}
