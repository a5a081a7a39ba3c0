/* The inside of a CeldSession, shared by session.c (what the host sets) and route.c (what is made from it).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_SESSION_H
#define CELD_SESSION_H

#include "private.h"

/* What can be made, each from earlier ones only. */
typedef enum
{
  STAGE_RELATIONS, /* the text's, the arrows layer's and the single ones, in one list */
  STAGE_INK,       /* for segmentation and for depth */
  STAGE_LABELS,
  STAGE_ORDER,
  STAGE_FLAT,
  STAGE_LEVELS,
  STAGE_DEPTH,
  STAGE_NORMALS,
  STAGE_SHADING,
  N_STAGES
} CeldStage;

/* A stroke of the host's over the scribbles layer. */
typedef struct { uint32_t id; int x, y; CeldMask mask; uint8_t colour[3]; } CeldStroke;

struct CeldSession
{
  /* what the host set */
  CeldSettings  settings;
  CeldDrawing   drawing;                       /* owned; luma.data NULL = none yet */
  CeldPaint     scribbles, arrows, contours;   /* owned; data NULL = none */
  CeldStroke   *stroke;                        /* in painting order */
  size_t        n_strokes;
  CeldRelations text, single;                  /* as set; painted ones are read in STAGE_RELATIONS */

  /* what was made of it; valid[s] says whether stage s still holds */
  bool          valid[N_STAGES];
  CeldRect      unseen[N_STAGES];              /* what the host has not asked for since it changed */
  CeldProblems  problems[N_STAGES];
  CeldRelations relations;
  CeldPlane     ink, depth_ink;                /* depth_ink.data NULL: the same as ink */
  CeldMask      painted;                       /* where the scribbles count as paint */
  size_t        n_painted;
  CeldLabels    labels;
  CeldPalette   palette;
  CeldOrder     order;
  CeldPlane     flat, levels, depth, shading;
  CeldVectors   normals;

  CeldProblems  all_problems;                  /* gathered for celd_session_problems */
};

/* Forgets a stage and all that is made from it. */
void celd_session_forget (CeldSession *session, CeldStage stage);

/* Makes what `stage` needs and does not hold, and the stage itself. */
CeldStatus celd_session_make (CeldSession *session, CeldStage stage, const CeldRun *run);

#endif
