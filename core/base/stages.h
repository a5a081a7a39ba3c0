/* The stages of a session: what can be made, each from earlier ones only.
 *
 * Settings name the stages that read them; how a stage is made is the session's business.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_STAGES_H
#define CELD_STAGES_H

typedef enum
{
  STAGE_RELATIONS, /* the text's, the path's, the layer's and the single ones, in one list */
  STAGE_INK,       /* for segmentation and for depth */
  STAGE_SCRIBBLES, /* the layer's seeds */
  STAGE_SEEDS,     /* the same under the single strokes */
  STAGE_LABELS,
  STAGE_SUGGESTIONS,
  STAGE_ORDER,
  STAGE_UNEXPANDED,
  STAGE_OWNERSHIP, /* whose the ink is */
  STAGE_LEVELS,
  STAGE_PREVIEW,   /* of depth */
  STAGE_DEPTH,
  STAGE_NORMALS,
  STAGE_SHADING,
  STAGE_WEIGHTS,   /* of the exact program */
  STAGE_NODES,     /* the scribbles as it has them */
  STAGE_EXACT,
  N_STAGES
} CeldStage;

#endif
