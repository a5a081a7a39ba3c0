/* The route of the paper as a session makes it: each stage from earlier ones, only what is missing.
 *
 *   drawing, contours -> ink ------.--------------.---------------.
 *   scribbles -----------> labels -+-> order -> flat -> levels ---+-> depth
 *   arrows, text -> relations -----'                    levels -> normals -> shading
 *
 * A stage writes into new memory and replaces the old result only when it succeeded; the comparison of the two is
 * what the host is told to redraw.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "session.h"

#include <math.h>
#include <string.h>

#define END_RADIUS 2.0 /* pixels round a relation's end that keep its level */

/* ------------------------------------------------------------------ what changed */

static CeldRect
rect_union (CeldRect a, CeldRect b)
{
  int left, top, right, bottom;

  if (!a.width || !b.width)
    return a.width ? a : b;
  left   = a.x < b.x ? a.x : b.x;
  top    = a.y < b.y ? a.y : b.y;
  right  = a.x + a.width > b.x + b.width ? a.x + a.width : b.x + b.width;
  bottom = a.y + a.height > b.y + b.height ? a.y + a.height : b.y + b.height;
  return (CeldRect) { left, top, right - left, bottom - top };
}

/* Where two tight pictures differ; everywhere if there is no old one. */
static CeldRect
difference (const void *old, const void *new, int width, int height, size_t pixel)
{
  CeldRect      all = { 0, 0, width, height }, found = { 0 };
  const uint8_t *a = old, *b = new;
  size_t        row = (size_t) width * pixel;

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
        found  = rect_union (found, (CeldRect) { (int) first, y, (int) (last - first) + 1, 1 });
      }
  return found;
}

/* What the host is to be told the next time it asks. */
static void
see_changes (CeldSession *s, CeldStage stage, const void *old, const void *new, size_t pixel)
{
  CeldRect changed = difference (old, new, s->drawing.luma.width, s->drawing.luma.height, pixel);

  s->unseen[stage] = rect_union (s->unseen[stage], changed);
}

static void
replace_plane (CeldSession *s, CeldStage stage, CeldPlane *old, CeldPlane *new)
{
  see_changes (s, stage, old->data, new->data, sizeof (float));
  celd_free (old->data);
  *old = *new;
  new->data = NULL;
}

/* ------------------------------------------------------------------ the stages */

static CeldStatus
append_relations (CeldRelations *to, const CeldRelations *from)
{
  CeldStatus status = CELD_OK;

  for (size_t i = 0; i < from->n && status == CELD_OK; i++)
    status = celd_relation_add (to, from->item[i]);
  return status;
}

static CeldStatus
make_relations (CeldSession *s, const CeldRun *run)
{
  CeldRelations all = { 0 };
  CeldProblems  problems = { 0 };
  CeldStatus    status = append_relations (&all, &s->text);

  if (status == CELD_OK && s->arrows.data)
    status = celd_arrows_read (&s->arrows, s->settings.arrow_style, run, &all, &problems);
  if (status == CELD_OK)
    status = append_relations (&all, &s->single);
  if (status == CELD_OK)
    {
      celd_relations_clear (&s->relations);
      celd_problems_clear (&s->problems[STAGE_RELATIONS]);
      s->relations = all;
      s->problems[STAGE_RELATIONS] = problems;
      return CELD_OK;
    }
  celd_relations_clear (&all);
  celd_problems_clear (&problems);
  return status;
}

/* Ink for one purpose: the contours are baked into a copy of the drawing first. */
static CeldStatus
make_ink_for (CeldSession *s, CeldPurpose purpose, const CeldRun *run, CeldPlane *ink)
{
  const CeldDrawing *drawing = &s->drawing;
  int                w = drawing->luma.width, h = drawing->luma.height;
  CeldPart           part[2];
  CeldRun            bake = celd_run_part (&part[0], run, 0, 0.3);
  CeldRun            rest = celd_run_part (&part[1], run, s->contours.data ? 0.3 : 0, 1);
  CeldDrawing        baked = { 0 };
  CeldStatus         status = celd_plane_new (w, h, ink);

  if (status == CELD_OK && s->contours.data)
    {
      status = celd_plane_new (w, h, &baked.luma);
      if (status == CELD_OK && drawing->alpha.data)
        status = celd_plane_new (w, h, &baked.alpha);
      if (status == CELD_OK)
        status = celd_contours_bake (drawing, &s->contours, purpose, s->settings.ink, &bake, &baked);
      drawing = &baked;
    }
  if (status == CELD_OK)
    status = celd_ink (drawing, s->settings.ink, &rest, ink);
  celd_free (baked.luma.data);
  celd_free (baked.alpha.data);
  return status;
}

static CeldStatus
make_ink (CeldSession *s, const CeldRun *run)
{
  CeldPart   part;
  CeldRun    first = celd_run_part (&part, run, 0, s->contours.data ? 0.5 : 1);
  CeldPlane  ink = { 0 }, depth_ink = { 0 };
  CeldStatus status = make_ink_for (s, CELD_FOR_SEGMENTATION, &first, &ink);

  if (status == CELD_OK && s->contours.data)
    {
      CeldRun second = celd_run_part (&part, run, 0.5, 1);

      status = make_ink_for (s, CELD_FOR_DEPTH, &second, &depth_ink);
    }
  if (status == CELD_OK)
    {
      replace_plane (s, STAGE_INK, &s->ink, &ink);
      celd_free (s->depth_ink.data);
      s->depth_ink = depth_ink;
      depth_ink.data = NULL;
    }
  celd_free (ink.data);
  celd_free (depth_ink.data);
  return status;
}

static const CeldPlane *
depth_ink (const CeldSession *s)
{
  return s->depth_ink.data ? &s->depth_ink : &s->ink;
}

static void
stamp_stroke (const CeldStroke *stroke, CeldPaint *paint)
{
  for (int y = 0; y < stroke->mask.height; y++)
    for (int x = 0; x < stroke->mask.width; x++)
      {
        int64_t px = (int64_t) stroke->x + x, py = (int64_t) stroke->y + y;

        if (CELD_AT (&stroke->mask, x, y) && px >= 0 && py >= 0 && px < paint->width && py < paint->height)
          {
            memcpy (CELD_RGBA (paint, px, py), stroke->colour, 3);
            CELD_RGBA (paint, px, py)[3] = 255;
          }
      }
}

/* Seed labels and their palette from the scribbles layer and the strokes over it. */
static CeldStatus
read_scribbles (CeldSession *s, const CeldRun *run, CeldLabels *seeds, CeldPalette *palette)
{
  int        w = s->drawing.luma.width, h = s->drawing.luma.height;
  size_t     size = 4 * (size_t) w * (size_t) h;
  CeldPaint  paint = s->scribbles;
  CeldStatus status;

  if (!s->scribbles.data && !s->n_strokes)
    return CELD_OK;
  if (s->n_strokes)
    {
      paint = (CeldPaint) { w, h, (size_t) w, celd_alloc0 (size, 1) };
      if (!paint.data)
        return CELD_NO_MEMORY;
      if (s->scribbles.data)
        memcpy (paint.data, s->scribbles.data, size);
      for (size_t i = 0; i < s->n_strokes; i++)
        stamp_stroke (&s->stroke[i], &paint);
    }
  status = celd_scribbles_read (&paint, &s->settings, run, seeds, palette);
  if (paint.data != s->scribbles.data)
    celd_free (paint.data);
  return status;
}

static CeldStatus
make_labels (CeldSession *s, const CeldRun *run)
{
  int          w = s->drawing.luma.width, h = s->drawing.luma.height;
  CeldPart     part[3];
  CeldRun      read = celd_run_part (&part[0], run, 0, 0.1), segment = celd_run_part (&part[1], run, 0.1, 0.95);
  CeldRun      separate = celd_run_part (&part[2], run, 0.95, 1);
  CeldLabels   labels;
  CeldMask     painted = { 0 };
  CeldPalette  palette = { 0 };
  CeldProblems problems = { 0 };
  size_t       n_painted = 0;
  CeldStatus   status = celd_labels_new (w, h, &labels);

  if (status == CELD_OK)
    status = celd_mask_new (w, h, &painted);
  if (status == CELD_OK)
    status = read_scribbles (s, &read, &labels, &palette);
  if (status == CELD_OK)
    {
      for (size_t i = 0; i < (size_t) w * (size_t) h; i++)
        n_painted += painted.data[i] = labels.data[i] != 0;
      status = celd_segment (&s->ink, &labels, &s->relations, &s->settings, &segment, &labels, &palette, &problems);
    }
  if (status == CELD_OK && s->settings.same_colour == CELD_SAME_COLOUR_SEPARATE)
    status = celd_separate (&separate, &labels, &palette);
  if (status != CELD_OK)
    {
      celd_free (labels.data);
      celd_free (painted.data);
      celd_palette_clear (&palette);
      celd_problems_clear (&problems);
      return status;
    }
  see_changes (s, STAGE_LABELS, s->labels.data, labels.data, sizeof (uint32_t));
  celd_free (s->labels.data);
  celd_free (s->painted.data);
  celd_palette_clear (&s->palette);
  celd_problems_clear (&s->problems[STAGE_LABELS]);
  s->labels  = labels;
  s->painted = painted;
  s->n_painted = n_painted;
  s->palette = palette;
  s->problems[STAGE_LABELS] = problems;
  return CELD_OK;
}

static CeldStatus
make_order (CeldSession *s, const CeldRun *run)
{
  CeldOrder    order = { 0 };
  CeldProblems problems = { 0 };
  CeldStatus   status = celd_order (&s->labels, &s->palette, &s->relations, &s->ink, run, &order, &problems);

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

/* Levels of ranks as the settings encode them. */
static void
encode (const CeldSession *s, const CeldLabels *ranks, CeldPlane *levels)
{
  for (size_t i = 0; i < (size_t) ranks->width * (size_t) ranks->height; i++)
    levels->data[i] = celd_encode_level (ranks->data[i], s->order.levels, &s->settings);
}

/* The rank of each pixel's label. */
static CeldStatus
rank_labels (const CeldSession *s, CeldLabels *ranks)
{
  CeldStatus status = celd_labels_new (s->labels.width, s->labels.height, ranks);

  if (status == CELD_OK)
    for (size_t i = 0; i < (size_t) ranks->width * (size_t) ranks->height; i++)
      ranks->data[i] = s->order.level[s->labels.data[i] - 1];
  return status;
}

static CeldStatus
make_flat (CeldSession *s, const CeldRun *run)
{
  CeldLabels ranks;
  CeldPlane  flat = { 0 };
  CeldStatus status = rank_labels (s, &ranks);

  (void) run;
  if (status == CELD_OK)
    status = celd_plane_new (ranks.width, ranks.height, &flat);
  if (status == CELD_OK)
    {
      encode (s, &ranks, &flat);
      replace_plane (s, STAGE_FLAT, &s->flat, &flat);
    }
  celd_free (ranks.data);
  celd_free (flat.data);
  return status;
}

static CeldStatus
make_levels (CeldSession *s, const CeldRun *run)
{
  CeldLabels ranks;
  CeldPlane  levels = { 0 };
  CeldStatus status = rank_labels (s, &ranks);

  if (status == CELD_OK)
    status = celd_expand (depth_ink (s), &ranks, run, &ranks);
  if (status == CELD_OK)
    status = celd_plane_new (ranks.width, ranks.height, &levels);
  if (status == CELD_OK)
    {
      encode (s, &ranks, &levels);
      replace_plane (s, STAGE_LEVELS, &s->levels, &levels);
    }
  celd_free (ranks.data);
  celd_free (levels.data);
  return status;
}

static void
anchor_end (const CeldTerm *end, CeldMask *anchors)
{
  int reach = (int) END_RADIUS;

  if (end->by_colour || !(end->x >= 0 && end->y >= 0 && end->x < anchors->width && end->y < anchors->height))
    return;
  for (int y = (int) end->y - reach; y <= (int) end->y + reach; y++)
    for (int x = (int) end->x - reach; x <= (int) end->x + reach; x++)
      if (x >= 0 && y >= 0 && x < anchors->width && y < anchors->height &&
          hypot (x + 0.5 - end->x, y + 0.5 - end->y) <= END_RADIUS)
        CELD_AT (anchors, x, y) = 1;
}

/* The paper's U_o.  Asked-for scribbles that do not exist leave it to the inner core of each region. */
static CeldStatus
choose_anchors (const CeldSession *s, const CeldRun *run, CeldMask *anchors)
{
  CeldAnchors choice = s->settings.anchors;
  bool        scribbles = (choice == CELD_ANCHORS_SCRIBBLES || choice == CELD_ANCHORS_BOTH) && s->n_painted;
  bool        arrows = choice == CELD_ANCHORS_ARROWS || choice == CELD_ANCHORS_BOTH;
  CeldStatus  status = celd_mask_new (s->labels.width, s->labels.height, anchors);

  if (status == CELD_OK && scribbles)
    memcpy (anchors->data, s->painted.data, (size_t) anchors->width * (size_t) anchors->height);
  else if (status == CELD_OK && !arrows)
    status = celd_anchor_core (anchors->width, anchors->height, s->levels.data, run, anchors->data);
  for (size_t i = 0; status == CELD_OK && i < s->relations.n; i++)
    if (arrows || s->relations.item[i].anchor)
      {
        anchor_end (&s->relations.item[i].nearer, anchors);
        anchor_end (&s->relations.item[i].farther, anchors);
      }
  return status;
}

static CeldStatus
make_depth (CeldSession *s, const CeldRun *run)
{
  CeldMask   anchors;
  CeldPlane  depth = { 0 };
  CeldSolve  solve = { 0 };
  CeldPart   part[2];
  CeldRun    choose = celd_run_part (&part[0], run, 0, 0.1), smooth = celd_run_part (&part[1], run, 0.1, 1);
  CeldStatus status = choose_anchors (s, &choose, &anchors);

  if (status == CELD_OK)
    status = celd_plane_new (s->levels.width, s->levels.height, &depth);
  if (status == CELD_OK)
    status = celd_smooth (depth_ink (s), &s->levels, &anchors, &s->settings, &smooth, &depth, &solve);
  if (status == CELD_OK)
    {
      celd_problems_clear (&s->problems[STAGE_DEPTH]);
      if (!solve.converged)
        status = celd_problem_add (&s->problems[STAGE_DEPTH], (CeldProblem) {
          .kind = CELD_PROBLEM_NOT_CONVERGED, .x = -1, .y = -1, .relation = CELD_NO_INDEX });
      replace_plane (s, STAGE_DEPTH, &s->depth, &depth);
    }
  celd_free (anchors.data);
  celd_free (depth.data);
  return status;
}

static CeldStatus
make_normals (CeldSession *s, const CeldRun *run)
{
  int         w = s->levels.width, h = s->levels.height;
  CeldVectors normals = { w, h, (size_t) w, celd_alloc ((size_t) w * (size_t) h, 3 * sizeof (float)) };
  CeldStatus  status = CELD_NO_MEMORY;

  if (normals.data)
    status = celd_normals (depth_ink (s), &s->levels, &s->settings, run, &normals);
  if (status != CELD_OK)
    {
      celd_free (normals.data);
      return status;
    }
  see_changes (s, STAGE_NORMALS, s->normals.data, normals.data, 3 * sizeof (float));
  celd_free (s->normals.data);
  s->normals = normals;
  return CELD_OK;
}

static CeldStatus
make_shading (CeldSession *s, const CeldRun *run)
{
  CeldPlane  shading;
  CeldStatus status = celd_plane_new (s->normals.width, s->normals.height, &shading);

  (void) run;
  if (status == CELD_OK)
    status = celd_shade (&s->normals, &s->settings, &shading);
  if (status == CELD_OK)
    replace_plane (s, STAGE_SHADING, &s->shading, &shading);
  celd_free (shading.data);
  return status;
}

/* ------------------------------------------------------------------ which stages, in which order */

#define NEEDS(stage) (1u << STAGE_##stage)

static const struct
{
  CeldStatus (*make) (CeldSession *session, const CeldRun *run);
  unsigned   needs;
  double     share; /* of the time of the whole route, for progress */
} stages[N_STAGES] = {
  [STAGE_RELATIONS] = { make_relations, 0,                                  0.02 },
  [STAGE_INK]       = { make_ink,       0,                                  0.06 },
  [STAGE_LABELS]    = { make_labels,    NEEDS (INK) | NEEDS (RELATIONS),    0.40 },
  [STAGE_ORDER]     = { make_order,     NEEDS (LABELS),                     0.02 },
  [STAGE_FLAT]      = { make_flat,      NEEDS (ORDER),                      0.01 },
  [STAGE_LEVELS]    = { make_levels,    NEEDS (ORDER),                      0.15 },
  [STAGE_DEPTH]     = { make_depth,     NEEDS (LEVELS),                     0.15 },
  [STAGE_NORMALS]   = { make_normals,   NEEDS (LEVELS),                     0.18 },
  [STAGE_SHADING]   = { make_shading,   NEEDS (NORMALS),                    0.01 },
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

CeldStatus
celd_session_make (CeldSession *session, CeldStage stage, const CeldRun *run)
{
  unsigned   wanted = 1u << stage;
  double     total = 0, done = 0;
  CeldStatus status = CELD_OK;

  for (int s = N_STAGES - 1; s >= 0; s--)
    if (wanted & (1u << s))
      {
        wanted |= stages[s].needs;
        total += session->valid[s] ? 0 : stages[s].share;
      }
  for (int s = 0; s < N_STAGES && status == CELD_OK; s++)
    if ((wanted & (1u << s)) && !session->valid[s])
      {
        CeldPart part;
        CeldRun  step = celd_run_part (&part, run, done / total, (done + stages[s].share) / total);

        status = stages[s].make (session, &step);
        session->valid[s] = status == CELD_OK;
        done += stages[s].share;
      }
  return status;
}
