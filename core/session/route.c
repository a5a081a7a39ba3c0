/* The route of the paper as a session makes it: each stage from earlier ones, only what is missing.
 *
 *   drawing, contours ----> ink ------.--------------.---------------.
 *   scribbles, strokes -> seeds -> labels -> order -> flat, levels --+-> preview of depth, depth
 *   arrows, text ---> relations ------'                 levels -> normals -> shading
 *
 *   ink -> weights -> nodes (of the seeds) -> exact depth (with the relations)
 *
 * The stages up to the labels are in route-labels.c, levels in route-levels.c, depth is in route-depth.c, the exact
 * program in route-exact.c.  Each of the others writes into new memory and replaces the old result only when it
 * succeeded; the comparison of the two is what the host is told to redraw.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "order/order.h"
#include "session/session.h"

/* ------------------------------------------------------------------ the stages */

static CeldStatus
make_suggestions (CeldSession *s, const CeldHost *host)
{
  const CeldLabels *labels = celd_session_current_labels (s);
  CeldRelations     suggested = { 0 };
  CeldHostPart          part[2];
  CeldHost          first = celd_host_part (&part[0], host, 0, s->hint.data ? 0.5 : 1);
  CeldHost          second = celd_host_part (&part[1], host, 0.5, 1);
  CeldStatus        status = celd_suggest (labels, &s->palette, &s->ink, &first, &suggested);

  if (status == CELD_OK && s->hint.data)
    status = celd_suggest_from_depth (labels, &s->palette, &s->ink, &s->hint, &second, &suggested);
  if (status != CELD_OK)
    {
      celd_relations_clear (&suggested);
      return status;
    }
  celd_relations_clear (&s->suggested);
  s->suggested = suggested;
  return CELD_OK;
}

/* The relations that make the order: the artist's, or those and suggestions. */
static CeldStatus
join_suggestions (CeldSession *s, const CeldHost *host, const CeldRelations **relations)
{
  CeldStatus status;

  *relations = &s->relations;
  if (s->settings.suggest == CELD_SUGGEST_OFF)
    return CELD_OK;
  *relations = &s->joined;
  status = celd_session_make (s, STAGE_SUGGESTIONS, host);
  if (status != CELD_OK)
    return status;
  return celd_suggestions_join (celd_session_current_labels (s), &s->palette, &s->relations, &s->suggested,
                                &s->settings, &s->ink, NULL, &s->joined);
}

static CeldStatus
make_order (CeldSession *s, const CeldHost *host)
{
  const CeldRelations *relations;
  CeldHostPart             part[2];
  CeldHost             first = celd_host_part (&part[0], host, 0, 0.5), second = celd_host_part (&part[1], host, 0.5, 1);
  CeldOrder            order = { 0 };
  CeldProblems         problems = { 0 };
  CeldStatus           status = join_suggestions (s, &first, &relations);

  if (status == CELD_OK)
    status = celd_order_keep (celd_session_current_labels (s), &s->palette, relations, &s->ink, &s->settings, &second,
                              &order, &problems, &s->ranks);
  if (status != CELD_OK)
    {
      celd_order_clear (&order);
      celd_problems_clear (&problems);
      return status;
    }
  celd_order_clear (&s->order);
  celd_problems_clear (&s->problems[STAGE_ORDER]);
  s->order = order;
  s->problems[STAGE_ORDER] = problems;
  return CELD_OK;
}

static CeldStatus
make_normals (CeldSession *s, const CeldHost *host)
{
  int         w = s->levels.width, h = s->levels.height;
  CeldVectors normals = { w, h, (size_t) w, celd_alloc ((size_t) w * (size_t) h, 3 * sizeof (float)) };
  CeldStatus  status = CELD_NO_MEMORY;

  if (normals.data)
    status = celd_normals (celd_session_bent_ink (s), &s->levels, &s->settings, host, &normals);
  if (status != CELD_OK)
    {
      celd_free (normals.data);
      return status;
    }
  celd_session_see (s, STAGE_NORMALS, celd_difference (s->normals.data, normals.data, w, h, 3 * sizeof (float)));
  celd_free (s->normals.data);
  s->normals = normals;
  return CELD_OK;
}

static CeldStatus
make_shading (CeldSession *s, const CeldHost *host)
{
  CeldPlane  shading;
  CeldStatus status = celd_plane_new (s->normals.width, s->normals.height, &shading);

  (void) host;
  if (status == CELD_OK)
    status = celd_shade (&s->normals, &s->settings, &shading);
  if (status == CELD_OK)
    celd_session_replace (s, STAGE_SHADING, &s->shading, &shading);
  celd_free (shading.data);
  return status;
}

/* ------------------------------------------------------------------ which stages, in which order */

#define NEEDS(stage) (1u << STAGE_##stage)

static const struct
{
  CeldStatus (*make) (CeldSession *session, const CeldHost *host);
  unsigned   needs;   /* what has to be made before; when that is forgotten, so is the stage */
  unsigned   follows; /* what has to be made before, and forgets the stage itself if need be */
  double     share; /* of the time of the whole route, for progress */
} stages[N_STAGES] = {
  [STAGE_RELATIONS]   = { celd_make_relations, 0,                                  0,                 0.02 },
  [STAGE_INK]         = { celd_make_ink,       0,                                  0,                 0.09 },
  [STAGE_SCRIBBLES]   = { celd_make_scribbles, 0,                                  0,                 0.09 },
  [STAGE_SEEDS]       = { celd_make_seeds,     NEEDS (SCRIBBLES),                  0,                 0.01 },
  [STAGE_LABELS]      = { celd_make_labels,    NEEDS (INK) | NEEDS (SEEDS),        NEEDS (RELATIONS), 0.09 },
  [STAGE_SUGGESTIONS] = { make_suggestions,    NEEDS (LABELS),                     0,                 0.05 },
  [STAGE_ORDER]       = { make_order,          NEEDS (LABELS) | NEEDS (RELATIONS), 0,                 0.02 },
  [STAGE_FLAT]        = { celd_make_flat,      NEEDS (ORDER),                      0,                 0.01 },
  [STAGE_OWNERSHIP]   = { celd_make_ownership, NEEDS (ORDER),                      0,                 0.20 },
  [STAGE_LEVELS]      = { celd_make_levels,    NEEDS (OWNERSHIP),                  0,                 0.01 },
  [STAGE_PREVIEW]     = { celd_make_preview,   NEEDS (ORDER),                      0,                 0.02 },
  [STAGE_DEPTH]       = { celd_make_depth,     NEEDS (LEVELS),                     0,                 0.05 },
  [STAGE_NORMALS]     = { make_normals,        NEEDS (LEVELS),                     0,                 0.24 },
  [STAGE_WEIGHTS]     = { celd_make_weights,   NEEDS (INK),                        0,                 0.02 },
  [STAGE_NODES]       = { celd_make_nodes,     NEEDS (SEEDS) | NEEDS (WEIGHTS),    0,                 0.10 },
  [STAGE_EXACT]       = { celd_make_exact,     NEEDS (NODES) | NEEDS (RELATIONS),  0,                 2.00 },
  [STAGE_SHADING]     = { make_shading,        NEEDS (NORMALS),                    0,                 0.01 },
};

/* Needs name earlier stages only, so one pass in each direction finds all. */

void
celd_session_forget (CeldSession *session, CeldStage stage)
{
  unsigned gone = 1u << stage;

  for (int s = 0; s < N_STAGES; s++)
    {
      if (stages[s].needs & gone)
        gone |= 1u << s;
      if (gone & (1u << s))
        session->valid[s] = false;
    }
}

/* The stages that are to be made, or may be: what follows another knows when that is made. */
static unsigned
open_stages (const CeldSession *session)
{
  unsigned open = 0;

  for (int s = 0; s < N_STAGES; s++)
    if (!session->valid[s] || ((stages[s].needs | stages[s].follows) & open))
      open |= 1u << s;
  return open;
}

CeldStatus
celd_session_make (CeldSession *session, CeldStage stage, const CeldHost *host)
{
  unsigned   wanted = 1u << stage, open = open_stages (session);
  double     total = 0, done = 0;
  CeldStatus status = CELD_OK;

  for (int s = N_STAGES - 1; s >= 0; s--)
    if (wanted & (1u << s))
      {
        wanted |= stages[s].needs | stages[s].follows;
        total += open & (1u << s) ? stages[s].share : 0;
      }
  for (int s = 0; s < N_STAGES && status == CELD_OK; s++)
    if ((wanted & (1u << s)) && !session->valid[s])
      {
        CeldHostPart part;
        CeldHost step = celd_host_part (&part, host, done / total, (done + stages[s].share) / total);

        status = stages[s].make (session, &step);
        session->valid[s] = status == CELD_OK;
        done += stages[s].share;
      }
  return status;
}
