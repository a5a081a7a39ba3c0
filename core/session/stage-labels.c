/* The stages of a session up to the labels.
 *
 * What is slow happens once a drawing: the segmenter keeps its basins.  What happens once a layer: reading scribbles.
 * A single stroke costs the runs of seeds, and what the segmenter repaints.
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

/* Do two relations say the same of the labels? */
static bool
same_ends (const CeldRelation *a, const CeldRelation *b)
{
  return a->equal == b->equal && celd_term_same (&a->nearer, &b->nearer) && celd_term_same (&a->farther, &b->farther);
}

/* No relation contradicts others, on labels that none has split. */
static CeldStatus
agree (const CeldSession *s, const CeldRelations *relations, bool *agreed)
{
  CeldGraph  graph = { 0 };
  CeldSccs  sccs = { 0 };
  CeldStatus status = celd_graph_new (celd_session_current_labels (s), &s->palette, relations, &s->ink, &graph, NULL);

  if (status == CELD_OK)
    status = celd_sccs_find (&graph, &sccs);
  *agreed = status == CELD_OK && !sccs.n;
  celd_sccs_clear (&sccs);
  celd_graph_clear (&graph);
  return status;
}

/* Would the labels be as they are with these relations in place of the present ones?  They say something of labels
 * where they make regions or split them: few do. */
static CeldStatus
keep_labels (const CeldSession *s, const CeldRelations *relations, bool *kept)
{
  const CeldRelations *old = &s->relations;
  bool                 bend = s->settings.on_cycle == CELD_ON_CYCLE_SPLIT;
  size_t               same = 0;

  *kept = false;
  while (same < old->n && same < relations->n && same_ends (&old->item[same], &relations->item[same]))
    same++;
  if (same < celd_segmenter_effective_relations (s->segmenter) || (bend && s->splits.n))
    return CELD_OK;
  for (size_t i = same; i < relations->n; i++)
    if (!celd_session_relation_keeps_labels (s, &relations->item[i]))
      return CELD_OK;
  *kept = true;
  return bend ? agree (s, relations, kept) : CELD_OK;
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
        celd_session_forget (s, STAGE_LABELS);
      return CELD_OK;
    }
  celd_relations_clear (&all);
  celd_problems_clear (&problems);
  return status;
}

/* ------------------------------------------------------------------ ink */

/* Ink for one purpose: the contours are baked into a copy of the drawing first. */
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

/* The old ink stays with the segmenter until that has had the new one; ink that is as it was makes no work at all. */
static void
take_ink (CeldSession *s, CeldPlane *ink)
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
      celd_session_note_depth_ink (s, depth_ink.data ? &depth_ink : &ink);
      take_ink (s, &ink);
      celd_free (s->depth_ink.data);
      s->depth_ink = depth_ink;
      depth_ink.data = NULL;
    }
  celd_free (ink.data);
  celd_free (depth_ink.data);
  return status;
}

/* ------------------------------------------------------------------ seeds */

CeldStatus
celd_make_scribbles (CeldSession *s, const CeldHost *host)
{
  int          w = s->drawing.luma.width, h = s->drawing.luma.height;
  CeldLabels   labels = { 0 };
  CeldSeedRows seeds = { 0 };
  CeldPalette  palette = { 0 };
  CeldStatus   status;

  if (s->scribbles.data)
    {
      status = celd_labels_new (w, h, &labels);
      if (status == CELD_OK)
        status = celd_scribbles_read (&s->scribbles, &s->settings, host, &labels, &palette);
      if (status == CELD_OK)
        status = celd_seed_rows_read (&labels, &seeds);
    }
  else
    status = celd_seed_rows_new (w, h, &seeds);
  celd_free (labels.data);
  if (status != CELD_OK)
    {
      celd_palette_clear (&palette);
      return status;
    }
  celd_seed_rows_clear (&s->layer_seeds);
  celd_palette_clear (&s->layer_palette);
  s->layer_seeds   = seeds;
  s->layer_palette = palette;
  return CELD_OK;
}

CeldStatus
celd_make_seeds (CeldSession *s, const CeldHost *host)
{
  CeldSeedRows seeds = { 0 };
  CeldPalette  palette = { 0 };
  CeldStatus   status = celd_seed_rows_copy (&s->layer_seeds, &seeds);

  if (status == CELD_OK)
    status = celd_palette_copy (&s->layer_palette, &palette);
  if (status == CELD_OK && s->n_strokes)
    status = celd_strokes_compose (s->stroke, s->n_strokes, &seeds, &palette);
  if (status == CELD_OK)
    status = celd_progress (host, 1);
  if (status != CELD_OK)
    {
      celd_seed_rows_clear (&seeds);
      celd_palette_clear (&palette);
      return status;
    }
  celd_seed_rows_clear (&s->seeds);
  celd_palette_clear (&s->seed_palette);
  s->seeds        = seeds;
  s->seed_palette = palette;
  return CELD_OK;
}

/* ------------------------------------------------------------------ labels */

/* Tells the segmenter where the ink differs from what it knows.  What it knows after a failure, nobody knows. */
static CeldStatus
tell_ink (CeldSession *s, const CeldHost *host)
{
  bool       renew = s->segmenter_ink.data && s->segmenter_threshold == s->settings.ink_threshold &&
                     s->segmenter_bridged == s->settings.close_gaps;
  CeldRect   changed = { 0 };
  CeldStatus status;

  if (renew && s->segmenter_ink.data == s->ink.data)
    return CELD_OK;
  if (renew)
    changed = celd_changed_rect (s->segmenter_ink.data, s->ink.data, s->ink.width, s->ink.height, sizeof (float));
  status = celd_segmenter_set_ink (s->segmenter, &s->ink, renew ? &changed : NULL, &s->settings, host);
  if (s->segmenter_ink.data != s->ink.data)
    celd_free (s->segmenter_ink.data);
  s->segmenter_ink = status == CELD_OK ? s->ink : (CeldPlane) { 0 };
  s->segmenter_threshold = s->settings.ink_threshold;
  s->segmenter_bridged   = s->settings.close_gaps;
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
  return tell_ink (s, host);
}

/* What the segmenter does not do of its own: labels NULL where the settings ask for nothing of it, or where no
 * contradiction needs it. */
typedef struct { CeldLabels labels; CeldSplits splits; CeldPlane split_ink; } Parted;

static void
parted_clear (Parted *parted)
{
  celd_free (parted->labels.data);
  celd_free (parted->splits.item);
  celd_free (parted->split_ink.data);
}

/* Splits regions where relations contradict, and takes the ink off the new borders. */
static CeldStatus
split (const CeldSession *s, const CeldHost *host, CeldPalette *palette, Parted *parted)
{
  const CeldPlane *ink = celd_session_depth_ink (s);
  CeldStatus       status = celd_cycles_split (&s->relations, &s->ink, &s->settings, host, &parted->labels, palette,
                                               &parted->splits);

  if (status == CELD_OK && parted->splits.n)
    status = celd_plane_new (ink->width, ink->height, &parted->split_ink);
  if (status == CELD_OK && parted->splits.n)
    {
      memcpy (parted->split_ink.data, ink->data, (size_t) ink->width * (size_t) ink->height * sizeof *ink->data);
      celd_splits_erase (&parted->splits, &parted->labels, celd_stroke_width (ink), &parted->split_ink);
    }
  return status;
}

/* The labels of the segmenter with each region on its own, or with regions split where relations contradict. */
static CeldStatus
part (const CeldSession *s, const CeldHost *host, CeldPalette *palette, Parted *parted)
{
  bool         apart = s->settings.same_colour == CELD_SAME_COLOUR_SEPARATE;
  bool         bend = s->settings.on_cycle == CELD_ON_CYCLE_SPLIT && s->relations.n;
  CeldLabels  *labels = &parted->labels;
  CeldHostPart halves[2];
  CeldHost     first = celd_host_part (&halves[0], host, 0, bend ? 0.5 : 1);
  CeldHost     second = celd_host_part (&halves[1], host, apart ? 0.5 : 0, 1);
  CeldStatus   status;

  if (!apart && !bend)
    return CELD_OK;
  status = celd_labels_new (s->segmented.width, s->segmented.height, labels);
  if (status != CELD_OK)
    return status;
  memcpy (labels->data, s->segmented.data, (size_t) labels->width * (size_t) labels->height * sizeof *labels->data);
  if (apart)
    status = celd_separate (&first, labels, palette);
  if (status == CELD_OK && bend)
    status = split (s, &second, palette, parted);
  if (status == CELD_OK && !apart && !parted->splits.n)
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
      CELD_PROBLEM_REGION_SPLIT, splits->item[i].x[1], splits->item[i].y[1], splits->item[i].label,
      splits->item[i].other, CELD_NO_INDEX });
  return status;
}

static void
see_labels (CeldSession *s, CeldRect changed)
{
  celd_session_add_change (s, STAGE_LABELS, changed);
  s->new_labels = celd_rect_union (s->new_labels, changed);
}

/* The segmenter paints in place and says where; only where regions stand or stood on their own, pictures have to be
 * compared. */
CeldStatus
celd_make_labels (CeldSession *s, const CeldHost *host)
{
  CeldHostPart parts[3];
  CeldHost     tell = celd_host_part (&parts[0], host, 0, 0.5), solve = celd_host_part (&parts[1], host, 0.5, 0.9);
  CeldHost     last = celd_host_part (&parts[2], host, 0.9, 1);
  Parted       parted = { 0 };
  CeldPalette  palette = { 0 };
  CeldProblems problems = { 0 };
  CeldRect     changed = { 0 };
  CeldStatus   status = prepare_segmenter (s, &tell);

  if (status == CELD_OK)
    status = celd_palette_copy (&s->seed_palette, &palette);
  if (status == CELD_OK)
    status = celd_segmenter_solve (s->segmenter, &s->seeds, &s->relations, &s->settings, &solve, &palette, &problems,
                                   &s->segmented, &changed);
  if (status == CELD_OK && !s->separated.data)
    see_labels (s, changed);
  if (status == CELD_OK)
    status = part (s, &last, &palette, &parted);
  if (status == CELD_OK)
    status = report_splits (&parted.splits, &problems);
  if (status != CELD_OK)
    {
      celd_session_forget_ownership (s); /* what was painted before it failed, nobody knows */
      parted_clear (&parted);
      celd_palette_clear (&palette);
      celd_problems_clear (&problems);
      return status;
    }
  if (parted.labels.data || s->separated.data)
    see_labels (s, celd_changed_rect (celd_session_current_labels (s)->data,
                                    parted.labels.data ? parted.labels.data : s->segmented.data,
                                    s->segmented.width, s->segmented.height, sizeof (uint32_t)));
  celd_session_set_split_ink (s, &parted.split_ink);
  celd_free (s->separated.data);
  celd_free (s->splits.item);
  celd_palette_clear (&s->palette);
  celd_problems_clear (&s->problems[STAGE_LABELS]);
  s->new_corrections |= s->corrections.data != NULL; /* they are read by the palette */
  s->separated = parted.labels;
  s->splits    = parted.splits;
  s->palette   = palette;
  s->problems[STAGE_LABELS] = problems;
  return CELD_OK;
}
