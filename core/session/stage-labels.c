/* Relations, ink and labels in a session.
 *
 * The segmenter keeps the basins of a drawing; after an edit it labels only those again that the edit concerns.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "order/order.h"
#include "segment/segment.h"
#include "session/session.h"

#include <string.h>

/* ------------------------------------------------------------------ relations */

static CeldStatus
append_relations (CeldRelations *to, const CeldRelations *from)
{
  CeldStatus status = CELD_OK;

  for (size_t i = 0; i < from->n && status == CELD_OK; i++)
    status = celd_relation_add (to, from->item[i]);
  return status;
}

/* Whether two relations mean the same for labels and order; their weights, gaps and sources may differ. */
static bool
same_meaning (const CeldRelation *a, const CeldRelation *b)
{
  return a->equal == b->equal && celd_term_same (&a->nearer, &b->nearer) && celd_term_same (&a->farther, &b->farther);
}

/* Finds out whether the relations contradict each other on the current labels, of which none is split. */
static CeldStatus
check_cycles (const CeldSession *s, const CeldRelations *relations, bool *acyclic)
{
  CeldGraph  graph = { 0 };
  CeldSccs   sccs = { 0 };
  CeldStatus status = celd_graph_new (celd_session_current_labels (s), &s->palette, relations, &s->ink, &graph, NULL);

  if (status == CELD_OK)
    status = celd_sccs_find (&graph, &sccs);
  *acyclic = status == CELD_OK && !sccs.n;
  celd_sccs_clear (&sccs);
  celd_graph_clear (&graph);
  return status;
}

/* Finds out whether the labels would stay as they are with these relations instead of the current ones: only relations
 * that seed regions or split them change labels. */
static CeldStatus
keep_labels (const CeldSession *s, const CeldRelations *relations, bool *kept)
{
  const CeldRelations *old = &s->relations;
  bool                 split = s->settings.on_cycle == CELD_ON_CYCLE_SPLIT;
  size_t               same = 0;

  *kept = false;
  while (same < old->n && same < relations->n && same_meaning (&old->item[same], &relations->item[same]))
    same++;
  if (same < celd_segmenter_effective_relations (s->segmenter) || (split && s->splits.n))
    return CELD_OK;
  for (size_t i = same; i < relations->n; i++)
    if (!celd_session_relation_keeps_labels (s, &relations->item[i]))
      return CELD_OK;
  *kept = true;
  return split ? check_cycles (s, relations, kept) : CELD_OK;
}

CeldStatus
celd_make_relations (CeldSession *s, const CeldHost *host)
{
  CeldRelations all = { 0 };
  CeldProblems  problems = { 0 };
  bool          kept = false;
  CeldStatus    status = append_relations (&all, &s->text);

  if (status == CELD_OK)
    status = append_relations (&all, &s->path);
  if (status == CELD_OK && s->arrows.data)
    status = celd_arrows_read (&s->arrows, s->settings.arrow_style, host, &all, &problems);
  if (status == CELD_OK)
    status = append_relations (&all, &s->single);
  if (status == CELD_OK && s->valid[STAGE_LABELS])
    status = keep_labels (s, &all, &kept);
  if (status == CELD_OK)
    {
      celd_relations_clear (&s->relations);
      celd_problems_clear (&s->problems[STAGE_RELATIONS]);
      s->relations = all;
      s->problems[STAGE_RELATIONS] = problems;
      if (!kept)
        celd_session_invalidate (s, STAGE_LABELS);
      return CELD_OK;
    }
  celd_relations_clear (&all);
  celd_problems_clear (&problems);
  return status;
}

/* ------------------------------------------------------------------ ink */

/* Makes the ink for one purpose, with the virtual contours drawn into a copy of the drawing. */
static CeldStatus
make_ink_for (CeldSession *s, CeldPurpose purpose, const CeldHost *host, CeldPlane *ink)
{
  const CeldDrawing *drawing = &s->drawing;
  int                w = drawing->luma.width, h = drawing->luma.height;
  CeldHostPart       part[2];
  CeldHost           bake = celd_host_part (&part[0], host, 0, 0.3);
  CeldHost           rest = celd_host_part (&part[1], host, s->contours.data ? 0.3 : 0, 1);
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

/* Replaces the ink, unless the new one equals it.  The old ink remains as segmenter_ink if the segmenter uses it. */
static void
replace_ink (CeldSession *s, CeldPlane *ink)
{
  CeldRect changed = celd_changed_rect (s->ink.data, ink->data, ink->width, ink->height, sizeof (float));

  if (!changed.width)
    return;
  celd_session_add_change (s, STAGE_INK, changed);
  if (s->ink.data != s->segmenter_ink.data)
    celd_free (s->ink.data);
  s->ink = *ink;
  ink->data = NULL;
}

CeldStatus
celd_make_ink (CeldSession *s, const CeldHost *host)
{
  CeldHostPart part;
  CeldHost     first = celd_host_part (&part, host, 0, s->contours.data ? 0.5 : 1);
  CeldPlane    ink = { 0 }, depth_ink = { 0 };
  CeldStatus   status = make_ink_for (s, CELD_FOR_SEGMENTATION, &first, &ink);

  if (status == CELD_OK && s->contours.data)
    {
      CeldHost second = celd_host_part (&part, host, 0.5, 1);

      status = make_ink_for (s, CELD_FOR_DEPTH, &second, &depth_ink);
    }
  if (status == CELD_OK)
    {
      celd_session_invalidate_depth_ink (s, depth_ink.data ? &depth_ink : &ink);
      replace_ink (s, &ink);
      celd_free (s->depth_ink.data);
      s->depth_ink = depth_ink;
      depth_ink.data = NULL;
    }
  celd_free (ink.data);
  celd_free (depth_ink.data);
  return status;
}

/* ------------------------------------------------------------------ labels */

/* Gives the segmenter the ink, and where this differs from its last ink.  After a failure the segmenter has to be given
 * all of it again. */
static CeldStatus
update_segmenter_ink (CeldSession *s, const CeldHost *host)
{
  bool       update = s->segmenter_ink.data && s->segmenter_threshold == s->settings.ink_threshold &&
                     s->segmenter_close_gaps == s->settings.close_gaps;
  CeldRect   changed = { 0 };
  CeldStatus status;

  if (update && s->segmenter_ink.data == s->ink.data)
    return CELD_OK;
  if (update)
    changed = celd_changed_rect (s->segmenter_ink.data, s->ink.data, s->ink.width, s->ink.height, sizeof (float));
  status = celd_segmenter_set_ink (s->segmenter, &s->ink, update ? &changed : NULL, &s->settings, host);
  if (s->segmenter_ink.data != s->ink.data)
    celd_free (s->segmenter_ink.data);
  s->segmenter_ink = status == CELD_OK ? s->ink : (CeldPlane) { 0 };
  s->segmenter_threshold = s->settings.ink_threshold;
  s->segmenter_close_gaps   = s->settings.close_gaps;
  return status;
}

static CeldStatus
prepare_segmenter (CeldSession *s, const CeldHost *host)
{
  if (!s->segmenter)
    s->segmenter = celd_segmenter_new ();
  if (!s->segmenter)
    return CELD_NO_MEMORY;
  if (!s->segmented.data)
    {
      CeldStatus status = celd_labels_new (s->ink.width, s->ink.height, &s->segmented);

      if (status != CELD_OK)
        return status;
    }
  return update_segmenter_ink (s, host);
}

/* Labels after regions were separated (same_colour) and split (on_cycle), with the splits and the ink for depth without
 * their boundaries.  data NULL: equal to the segmenter's labels, and to the ink for depth. */
typedef struct { CeldLabels labels; CeldSplits splits; CeldPlane split_ink; } Divided;

static void
divided_clear (Divided *divided)
{
  celd_free (divided->labels.data);
  celd_free (divided->splits.item);
  celd_free (divided->split_ink.data);
}

/* Splits regions where relations contradict each other, and erases the ink along the new boundaries. */
static CeldStatus
split_regions (const CeldSession *s, const CeldHost *host, CeldPalette *palette, Divided *divided)
{
  const CeldPlane *ink = celd_session_depth_ink (s);
  CeldStatus       status = celd_cycles_split (&s->relations, &s->ink, &s->settings, host, &divided->labels, palette,
                                               &divided->splits);

  if (status == CELD_OK && divided->splits.n)
    status = celd_plane_new (ink->width, ink->height, &divided->split_ink);
  if (status == CELD_OK && divided->splits.n)
    {
      memcpy (divided->split_ink.data, ink->data, (size_t) ink->width * (size_t) ink->height * sizeof *ink->data);
      celd_splits_erase (&divided->splits, &divided->labels, celd_stroke_width (ink), &divided->split_ink);
    }
  return status;
}

/* Separates and splits regions of the segmenter's labels, as the settings say. */
static CeldStatus
divide_regions (const CeldSession *s, const CeldHost *host, CeldPalette *palette, Divided *divided)
{
  bool         separate = s->settings.same_colour == CELD_SAME_COLOUR_SEPARATE;
  bool         split = s->settings.on_cycle == CELD_ON_CYCLE_SPLIT && s->relations.n;
  CeldLabels  *labels = &divided->labels;
  CeldHostPart halves[2];
  CeldHost     first = celd_host_part (&halves[0], host, 0, split ? 0.5 : 1);
  CeldHost     second = celd_host_part (&halves[1], host, separate ? 0.5 : 0, 1);
  CeldStatus   status;

  if (!separate && !split)
    return CELD_OK;
  status = celd_labels_new (s->segmented.width, s->segmented.height, labels);
  if (status != CELD_OK)
    return status;
  memcpy (labels->data, s->segmented.data, (size_t) labels->width * (size_t) labels->height * sizeof *labels->data);
  if (separate)
    status = celd_separate (&first, labels, palette);
  if (status == CELD_OK && split)
    status = split_regions (s, &second, palette, divided);
  if (status == CELD_OK && !separate && !divided->splits.n)
    {
      celd_free (labels->data);
      *labels = (CeldLabels) { 0 };
    }
  return status;
}

static CeldStatus
report_splits (const CeldSplits *splits, CeldProblems *problems)
{
  CeldStatus status = CELD_OK;

  for (size_t i = 0; i < splits->n && status == CELD_OK; i++)
    status = celd_problem_add (problems, (CeldProblem) {
      .kind = CELD_PROBLEM_REGION_SPLIT, .x = splits->item[i].x[1], .y = splits->item[i].y[1],
      .label = splits->item[i].label, .other = splits->item[i].other, .relation = CELD_NO_INDEX });
  return status;
}

static void
add_label_change (CeldSession *s, CeldRect changed)
{
  celd_session_add_change (s, STAGE_LABELS, changed);
  s->changed_labels = celd_rect_union (s->changed_labels, changed);
}

/* The segmenter changes its labels in place and reports where.  Where regions are, or were, separated or split, the old
 * labels are compared with the new ones. */
CeldStatus
celd_make_labels (CeldSession *s, const CeldHost *host)
{
  CeldHostPart parts[3];
  CeldHost     update = celd_host_part (&parts[0], host, 0, 0.5), solve = celd_host_part (&parts[1], host, 0.5, 0.9);
  CeldHost     last = celd_host_part (&parts[2], host, 0.9, 1);
  Divided      divided = { 0 };
  CeldPalette  palette = { 0 };
  CeldProblems problems = { 0 };
  CeldRect     changed = { 0 };
  CeldStatus   status = prepare_segmenter (s, &update);

  if (status == CELD_OK)
    status = celd_palette_copy (&s->seed_palette, &palette);
  if (status == CELD_OK)
    status = celd_segmenter_solve (s->segmenter, &s->seeds, &s->relations, &s->settings, &solve, &palette, &problems,
                                   &s->segmented, &changed);
  if (status == CELD_OK && !s->separated.data)
    add_label_change (s, changed);
  if (status == CELD_OK)
    status = divide_regions (s, &last, &palette, &divided);
  if (status == CELD_OK)
    status = report_splits (&divided.splits, &problems);
  if (status != CELD_OK)
    {
      celd_session_discard_ownership (s); /* the segmenter may have changed labels before it failed */
      divided_clear (&divided);
      celd_palette_clear (&palette);
      celd_problems_clear (&problems);
      return status;
    }
  if (divided.labels.data || s->separated.data)
    add_label_change (s, celd_changed_rect (celd_session_current_labels (s)->data,
                                    divided.labels.data ? divided.labels.data : s->segmented.data,
                                    s->segmented.width, s->segmented.height, sizeof (uint32_t)));
  celd_session_set_split_ink (s, &divided.split_ink);
  celd_free (s->separated.data);
  celd_free (s->splits.item);
  celd_palette_clear (&s->palette);
  celd_problems_clear (&s->problems[STAGE_LABELS]);
  s->changed_corrections |= s->corrections.data != NULL; /* they are read by the palette */
  s->separated = divided.labels;
  s->splits    = divided.splits;
  s->palette   = palette;
  s->problems[STAGE_LABELS] = problems;
  return CELD_OK;
}
