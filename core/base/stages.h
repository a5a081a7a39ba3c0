/* The stages of a session, each made from earlier ones only.
 *
 * The table of settings names the stages that a setting invalidates; session/stages.c makes them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_STAGES_H
#define CELD_STAGES_H

typedef enum
{
  STAGE_RELATIONS,   /* all of the artist's in one list: text, path, painted arrows, single ones */
  STAGE_INK,         /* for segmentation, and for depth */
  STAGE_SCRIBBLES,   /* the seeds of the scribbles layer */
  STAGE_SEEDS,       /* with the single strokes over them */
  STAGE_LABELS,
  STAGE_SUGGESTIONS,
  STAGE_ORDER,
  STAGE_UNEXPANDED,  /* levels before expansion */
  STAGE_OWNERSHIP,
  STAGE_LEVELS,      /* after expansion */
  STAGE_PREVIEW,     /* of smooth depth */
  STAGE_DEPTH,
  STAGE_NORMALS,
  STAGE_SHADING,
  STAGE_WEIGHTS,     /* of the exact program */
  STAGE_NODES,       /* of the exact program: the scribbles */
  STAGE_EXACT,
  N_STAGES
} CeldStage;

#endif
