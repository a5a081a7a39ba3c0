/* Stages made from levels: smooth depth, its preview at a quarter of the width and height, normals, shading.
 *
 * The preview needs no expansion: it uses unexpanded levels, one for each block of pixels, and the minimum of the ink
 * in each block, so that thin contours stay closed.  Depth and preview keep what they were made from, and solve again
 * only the connected components that an edit touched.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "depth/depth.h"
#include "light/light.h"
#include "image/image.h"
#include "order/order.h"
#include "session/session.h"

#include <math.h>
#include <string.h>

#define BLOCK_SIDE 4   /* pixels: width and height of a block of the preview (chosen: 1/16 of the work) */
#define END_RADIUS 2.0 /* pixels round a relation's end that are anchors (chosen) */

#define BLOCKS(pixels) (((pixels) + BLOCK_SIDE - 1) / BLOCK_SIDE)

/* Discards what depends on the ink for depth, and marks for both states of smooth depth where the new ink differs. */
static void
note_ink_change (CeldSession *s, const CeldPlane *old, const CeldPlane *new)
{
  CeldRect changed = celd_changed_rect (old->data, new->data, new->width, new->height, sizeof *new->data);
  CeldRect blocks = { changed.x / BLOCK_SIDE, changed.y / BLOCK_SIDE, BLOCKS (changed.x + changed.width),
                      BLOCKS (changed.y + changed.height) };

  if (!changed.width)
    return;
  blocks.width  -= blocks.x;
  blocks.height -= blocks.y;
  celd_free (s->preview_ink.data);
  s->preview_ink = (CeldPlane) { 0 };
  s->stroke_width = 0;
  celd_session_discard_ownership (s);
  s->smooth_state.new_ink  = celd_rect_union (s->smooth_state.new_ink, changed);
  s->preview_state.new_ink = celd_rect_union (s->preview_state.new_ink, blocks);
}

void
celd_session_invalidate_depth_ink (CeldSession *s, const CeldPlane *ink)
{
  note_ink_change (s, celd_session_depth_ink (s), ink);
}

void
celd_session_set_split_ink (CeldSession *s, CeldPlane *split_ink)
{
  if (!s->split_ink.data && !split_ink->data)
    return;
  note_ink_change (s, celd_session_split_ink (s), split_ink->data ? split_ink : celd_session_depth_ink (s));
  celd_free (s->split_ink.data);
  s->split_ink = *split_ink;
  *split_ink = (CeldPlane) { 0 };
}

/* ------------------------------------------------------------------ anchors */

/* Collects anchors, in a mask of blocks of side x side pixels.  With side above 1, a block's entry of `levels` becomes
 * the level of the anchor in it.  n counts anchors. */
typedef struct { const CeldSession *session; int side; CeldMask mask; CeldPlane *levels; size_t n; } Anchors;

/* The level of a pixel before expansion. */
static float
unexpanded_level (const CeldSession *s, int x, int y)
{
  const CeldLabels *labels = celd_session_current_labels (s);

  return celd_order_value (&s->order, s->order.level[CELD_AT (labels, x, y) - 1], &s->settings);
}

static void
mark (Anchors *a, int x, int y)
{
  uint8_t *here = &CELD_AT (&a->mask, x / a->side, y / a->side);

  a->n++;
  if (a->side > 1 && !*here)
    CELD_AT (a->levels, x / a->side, y / a->side) = unexpanded_level (a->session, x, y);
  *here = 1;
}

/* Marks the pixels within END_RADIUS of a relation's end, if this is a point of the picture. */
static void
mark_end (Anchors *a, const CeldTerm *end)
{
  int radius = (int) END_RADIUS, width = a->session->ink.width, height = a->session->ink.height;

  if (end->by_colour || !(end->x >= 0 && end->y >= 0 && end->x < width && end->y < height))
    return;
  for (int y = (int) end->y - radius; y <= (int) end->y + radius; y++)
    for (int x = (int) end->x - radius; x <= (int) end->x + radius; x++)
      if (x >= 0 && y >= 0 && x < width && y < height && hypot (x + 0.5 - end->x, y + 0.5 - end->y) <= END_RADIUS)
        mark (a, x, y);
}

/* Whether the pixel's region was split.  Its strokes, which may lie on both sides of the new boundary, are no
 * anchors. */
static bool
in_split_region (const CeldSession *s, int x, int y)
{
  return s->splits.n && celd_splits_have (&s->splits, CELD_AT (celd_session_current_labels (s), x, y));
}

/* Marks the seeds of regions that are not split; with side above 1 one pixel for each block. */
static void
mark_seeds (Anchors *a, const CeldSeedRows *seeds)
{
  for (int y = 0; y < seeds->height; y++)
    for (size_t i = 0; i < seeds->row[y].n; i++)
      for (int x = seeds->row[y].run[i].x; x < seeds->row[y].run[i].end; x = (x / a->side + 1) * a->side)
        if (!in_split_region (a->session, x, y))
          mark (a, x, y);
}

/* Marks the two places between which the depth of a split region changes. */
static void
mark_splits (Anchors *a, const CeldSplits *splits)
{
  for (size_t i = 0; i < splits->n; i++)
    for (int k = 0; k < 2; k++)
      mark_end (a, &(CeldTerm) { .x = splits->item[i].x[k] + 0.5, .y = splits->item[i].y[k] + 0.5 });
}

/* Marks the anchors that the settings ask for, the paper's U_o; none for CELD_ANCHORS_CORE. */
static void
choose_anchors (Anchors *a)
{
  const CeldSession *s = a->session;
  CeldAnchors        choice = s->settings.anchors;
  bool               arrows = choice == CELD_ANCHORS_ARROWS || choice == CELD_ANCHORS_BOTH;

  if (choice == CELD_ANCHORS_SCRIBBLES || choice == CELD_ANCHORS_BOTH)
    {
      mark_seeds (a, &s->seeds);
      mark_splits (a, &s->splits);
    }
  for (size_t i = 0; i < s->relations.n; i++)
    if (arrows || s->relations.item[i].anchor)
      {
        mark_end (a, &s->relations.item[i].nearer);
        mark_end (a, &s->relations.item[i].farther);
      }
}

/* ------------------------------------------------------------------ smooth depth */

/* Makes the plane of a stage and its state; a failure leaves both as they were. */
static CeldStatus
smooth (CeldSession *s, CeldStage stage, const Anchors *anchors, CeldSmoothInput *smoothing, const CeldHost *host,
        CeldSmoothState *state, CeldPlane *plane)
{
  CeldPlane  depth = { 0 };
  CeldSolve  solve;
  CeldStatus status;

  smoothing->anchors = anchors->n ? &anchors->mask : NULL;
  smoothing->last    = plane->data;
  status = celd_smooth_update (state, smoothing, host, &depth, &solve);
  if (status != CELD_OK)
    return status;
  celd_session_replace_plane (s, stage, plane, &depth);
  celd_problems_clear (&s->problems[stage]);
  if (stage == STAGE_DEPTH && !solve.converged)
    status = celd_problem_add (&s->problems[stage], (CeldProblem) {
      .kind = CELD_PROBLEM_NOT_CONVERGED, .x = -1, .y = -1, .relation = CELD_NO_INDEX });
  return status;
}

CeldStatus
celd_session_borders (const CeldSession *s, CeldPlane *drawn, const CeldPlane **borders)
{
  const CeldPlane *ink = &s->ink;
  CeldStatus       status;

  *borders = s->depth_ink.data ? ink : NULL;
  if (!s->splits.n || !s->settings.hold_gaps)
    return CELD_OK;
  status = celd_plane_new (ink->width, ink->height, drawn);
  if (status != CELD_OK)
    return status;
  memcpy (drawn->data, ink->data, (size_t) ink->width * (size_t) ink->height * sizeof *ink->data);
  celd_splits_draw (&s->splits, celd_session_current_labels (s), drawn);
  *borders = drawn;
  return CELD_OK;
}

static void
measure_stroke_width (CeldSession *s)
{
  if (!s->stroke_width)
    s->stroke_width = celd_stroke_width (celd_session_split_ink (s));
}

CeldStatus
celd_make_depth (CeldSession *s, const CeldHost *host)
{
  Anchors         anchors = { .session = s, .side = 1 };
  CeldSmoothInput smoothing = { .ink = celd_session_split_ink (s), .levels = &s->levels, .settings = &s->settings,
                              .speck = CELD_SPECK };
  CeldPlane       drawn = { 0 };
  CeldStatus      status = celd_session_borders (s, &drawn, &smoothing.borders);

  if (status == CELD_OK)
    status = celd_mask_new (s->levels.width, s->levels.height, &anchors.mask);
  if (status == CELD_OK)
    {
      measure_stroke_width (s);
      smoothing.radius = celd_edge_radius (s->stroke_width);
      smoothing.gap    = celd_longest_gap (s->stroke_width, s->levels.width, s->levels.height);
      choose_anchors (&anchors);
      status = smooth (s, STAGE_DEPTH, &anchors, &smoothing, host, &s->smooth_state, &s->depth);
    }
  celd_free (drawn.data);
  celd_free (anchors.mask.data);
  return status;
}

/* ------------------------------------------------------------------ preview */

CELD_CLONES static void
take_minimum (const float *restrict ink, int n, float *restrict least)
{
  for (int x = 0; x < n; x++)
    least[x] = ink[x] < least[x] ? ink[x] : least[x];
}

/* The minimum of the ink in each block; NaN reads as paper. */
static CeldStatus
reduce_ink (const CeldPlane *ink, CeldPlane *blocks)
{
  float     *least = celd_alloc ((size_t) ink->width, sizeof *least);
  CeldPlane  made = { 0 };
  CeldStatus status = least ? celd_plane_new (BLOCKS (ink->width), BLOCKS (ink->height), &made) : CELD_NO_MEMORY;

  for (int y = 0; y < made.height && status == CELD_OK; y++)
    {
      float *out = &CELD_AT (&made, 0, y);

      for (int x = 0; x < ink->width; x++)
        least[x] = 1;
      for (int v = y * BLOCK_SIDE; v < ink->height && v < (y + 1) * BLOCK_SIDE; v++)
        take_minimum (&CELD_AT (ink, 0, v), ink->width, least);
      for (int x = 0; x < made.width; x++)
        out[x] = 1;
      for (int x = 0; x < ink->width; x++)
        out[x / BLOCK_SIDE] = least[x] < out[x / BLOCK_SIDE] ? least[x] : out[x / BLOCK_SIDE];
    }
  celd_free (least);
  if (status == CELD_OK)
    *blocks = made;
  return status;
}

/* The borders of celd_session_borders by blocks; data NULL: there are none. */
static CeldStatus
reduce_borders (const CeldSession *s, CeldPlane *blocks)
{
  CeldPlane        drawn = { 0 };
  const CeldPlane *borders;
  CeldStatus       status = celd_session_borders (s, &drawn, &borders);

  if (status == CELD_OK && borders)
    status = reduce_ink (borders, blocks);
  celd_free (drawn.data);
  return status;
}

/* The unexpanded level of each block's central pixel. */
static void
sample_levels (const CeldSession *s, CeldPlane *levels)
{
  const CeldLabels *labels = celd_session_current_labels (s);

  for (int y = 0; y < levels->height; y++)
    for (int x = 0; x < levels->width; x++)
      {
        int u = x * BLOCK_SIDE + BLOCK_SIDE / 2, v = y * BLOCK_SIDE + BLOCK_SIDE / 2;

        CELD_AT (levels, x, y) = unexpanded_level (s, u < labels->width ? u : labels->width - 1,
                                             v < labels->height ? v : labels->height - 1);
      }
}

CeldStatus
celd_make_preview (CeldSession *s, const CeldHost *host)
{
  CeldPlane       levels = { 0 }, borders = { 0 };
  Anchors         anchors = { .session = s, .side = BLOCK_SIDE, .levels = &levels };
  CeldSettings    settings = s->settings;
  CeldSmoothInput smoothing = { .ink = &s->preview_ink, .levels = &levels, .settings = &settings,
                              .speck = CELD_SPECK / (BLOCK_SIDE * BLOCK_SIDE) };
  CeldStatus      status = s->preview_ink.data ? CELD_OK : reduce_ink (celd_session_split_ink (s), &s->preview_ink);

  if (status == CELD_OK)
    status = reduce_borders (s, &borders);
  if (status == CELD_OK)
    status = celd_plane_new (s->preview_ink.width, s->preview_ink.height, &levels);
  if (status == CELD_OK)
    status = celd_mask_new (levels.width, levels.height, &anchors.mask);
  if (status == CELD_OK)
    {
      measure_stroke_width (s);
      smoothing.radius   = celd_edge_radius (s->stroke_width) / BLOCK_SIDE;
      smoothing.gap      = celd_longest_gap (s->stroke_width, s->levels.width, s->levels.height);
      smoothing.gap.usual /= BLOCK_SIDE;
      smoothing.gap.most /= BLOCK_SIDE;
      smoothing.borders  = borders.data ? &borders : NULL;
      settings.tolerance = fmaxf (settings.tolerance, CELD_PREVIEW_TOLERANCE);
      sample_levels (s, &levels);
      choose_anchors (&anchors);
      status = smooth (s, STAGE_PREVIEW, &anchors, &smoothing, host, &s->preview_state, &s->preview);
    }
  celd_free (levels.data);
  celd_free (borders.data);
  celd_free (anchors.mask.data);
  return status;
}

/* ------------------------------------------------------------------ normals and shading */

CeldStatus
celd_make_normals (CeldSession *s, const CeldHost *host)
{
  int              w = s->levels.width, h = s->levels.height;
  CeldVectors      normals = { w, h, (size_t) w, celd_alloc ((size_t) w * (size_t) h, 3 * sizeof (float)) };
  CeldPlane        drawn = { 0 };
  const CeldPlane *borders;
  CeldStatus       status = normals.data ? celd_session_borders (s, &drawn, &borders) : CELD_NO_MEMORY;

  if (status == CELD_OK)
    status = celd_normals_of_sheets (celd_session_split_ink (s), borders, &s->levels, &s->ownership, s->sheets, NULL,
                                     NULL, &s->settings, host, &normals);
  celd_free (drawn.data);
  if (status != CELD_OK)
    {
      celd_free (normals.data);
      return status;
    }
  celd_session_add_change (s, STAGE_NORMALS,
                           celd_changed_rect (s->normals.data, normals.data, w, h, 3 * sizeof (float)));
  celd_free (s->normals.data);
  s->normals = normals;
  return CELD_OK;
}

CeldStatus
celd_make_shading (CeldSession *s, const CeldHost *host)
{
  CeldPlane  shading;
  CeldStatus status = celd_plane_new (s->normals.width, s->normals.height, &shading);

  (void) host;
  if (status == CELD_OK)
    status = celd_shade (&s->normals, &s->settings, &shading);
  if (status == CELD_OK)
    celd_session_replace_plane (s, STAGE_SHADING, &s->shading, &shading);
  celd_free (shading.data);
  return status;
}
