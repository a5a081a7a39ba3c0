/* The inside of a CeldSession.
 *
 *   session.c         the object, and what the host asks for
 *   session-input.c   what the host sets
 *   strokes.c         single strokes over the scribbles layer
 *   route.c           which stages there are, and what is made from the labels
 *   route-labels.c    the stages up to the labels
 *   route-levels.c    whose the ink is, and the levels that come of it
 *   route-depth.c     smooth depth and its preview
 *   route-layers.c    the drawing cut into layers
 *   route-exact.c     the stages of the exact program, and its preview
 *   changes.c         where two results differ
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_SESSION_H
#define CELD_SESSION_H

#include "depth/depth.h"
#include "depth/program.h"
#include "image/image.h"
#include "order/order.h"
#include "ownership/ownership.h"
#include "segment/segment.h"

/* What can be made, each from earlier ones only. */
typedef enum
{
  STAGE_RELATIONS, /* the text's, the path's, the layer's and the single ones, in one list */
  STAGE_INK,       /* for segmentation and for depth */
  STAGE_SCRIBBLES, /* the layer's seeds */
  STAGE_SEEDS,     /* the same under the single strokes */
  STAGE_LABELS,
  STAGE_SUGGESTIONS,
  STAGE_ORDER,
  STAGE_FLAT,
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

/* Pixels x .. end - 1 of row y, counted from the stroke's place. */
typedef struct { int y, x, end; } CeldStrokeSpan;

/* A stroke of the host's over the scribbles layer. */
typedef struct { uint32_t id; int x, y; uint8_t colour[3]; CeldStrokeSpan *span; size_t n; } CeldStroke;

struct CeldSession
{
  /* what the host set */
  CeldSettings  settings;
  CeldDrawing   drawing;                       /* owned; luma.data NULL = none yet */
  CeldPaint     scribbles, arrows, contours, corrections; /* owned; data NULL = none */
  CeldPlane     hint;                          /* depth from elsewhere; owned; data NULL = none */
  CeldStroke   *stroke;                        /* in painting order */
  size_t        n_strokes;
  CeldRelations text, path, single;            /* as set; painted ones are read in STAGE_RELATIONS */

  /* what was made of it; valid[s] says whether stage s still holds */
  bool           valid[N_STAGES];
  CeldRect       unseen[N_STAGES];             /* what the host has not asked for since it changed */
  CeldProblems   problems[N_STAGES];
  CeldRelations  relations;                    /* the artist's */
  CeldRelations  suggested, joined;            /* and what the order was made from, with settings.suggest */
  CeldPlane      ink, depth_ink;               /* depth_ink.data NULL: the same as ink */
  CeldSplits     splits;                       /* regions that contradictions have split */
  CeldPlane      bent_ink;                     /* depth_ink without ink along their new borders; NULL: the same */
  CeldSeedRows   layer_seeds, seeds;
  CeldPalette    layer_palette, seed_palette;
  CeldSegmenter *segmenter;                    /* NULL: none yet */
  CeldPlane      known_ink;                    /* what the segmenter has: a view of ink, or owned if that is newer;
                                                * data NULL: nothing that can be relied on */
  float          known_threshold;
  bool           known_bridged;   /* and whether gaps were bridged */
  CeldLabels     solved;                       /* the segmenter's */
  CeldLabels     separated;                    /* the same with regions on their own, or split; data NULL: not needed */
  CeldPalette    palette;
  CeldOrder      order;
  CeldRanks      ranks;                        /* of the order, for one more relation */
  CeldPlane      flat, levels, preview, depth, shading;
  CeldOwnership  ownership;                    /* owned */
  uint32_t      *rank;                         /* of each label as the ownership has it; NULL: it is of other ink for
                                                * depth or made in another way, or nobody knows of which labels */
  size_t         n_ranks;
  CeldOwnersKept owners;                       /* what it was made from, while rank is known */
  CeldRect       new_labels;                   /* where labels may have changed since then */
  bool           new_corrections;              /* or what corrections say */
  float         *value;                        /* of each label in the levels; NULL: not known */
  size_t         n_values;
  CeldRect       new_owners;                   /* where the ownership is newer than the levels */
  CeldSmoother   smoother, preview_smoother;   /* what depth and its preview were made from */
  int            reach;                        /* celd_edge_reach of the ink for depth; 0: not known */
  CeldPlane      block_ink;                    /* of the preview; data NULL: to be made */
  CeldVectors    normals;
  CeldProgram   *program;                      /* NULL: none yet */
  CeldPalette    exact_palette;                /* of the scribbles, with the background */
  CeldPlane      exact_preview, exact_depth;
  CeldExact      exact;

  CeldProblems   all_problems;                 /* gathered for celd_session_problems */
};

/* Forgets a stage and all that is made from it. */
void celd_session_forget (CeldSession *session, CeldStage stage);

/* Makes what `stage` needs and does not hold, and the stage itself. */
CeldStatus celd_session_make (CeldSession *session, CeldStage stage, const CeldHost *host);

/* Everything made: for a drawing of another size, and at the end. */
void celd_session_clear_results (CeldSession *session);

/* The labels as the host sees them. */
const CeldLabels *celd_session_current_labels (const CeldSession *session);

/* ------------------------------------------------------------------ strokes.c */

void celd_strokes_clear (CeldStroke *stroke, size_t n);

/* Paints the strokes over the seeds and extends their palette, which must have grown item by item.  Both are undefined
 * after a failure, but can be cleared. */
CeldStatus celd_strokes_compose (const CeldStroke *stroke, size_t n, CeldSeedRows *seeds, CeldPalette *palette);

/* ------------------------------------------------------------------ route-labels.c */

/* Relations forget the labels if these change with them. */
CeldStatus celd_make_relations (CeldSession *session, const CeldHost *host);
CeldStatus celd_make_ink       (CeldSession *session, const CeldHost *host);
CeldStatus celd_make_scribbles (CeldSession *session, const CeldHost *host);
CeldStatus celd_make_seeds     (CeldSession *session, const CeldHost *host);
CeldStatus celd_make_labels    (CeldSession *session, const CeldHost *host);

/* ------------------------------------------------------------------ route-levels.c */

CeldStatus celd_make_flat      (CeldSession *session, const CeldHost *host);
CeldStatus celd_make_ownership (CeldSession *session, const CeldHost *host);
CeldStatus celd_make_levels    (CeldSession *session, const CeldHost *host);

/* Would relation i, behind all others, leave the labels as they are?  For as long as these hold. */
bool celd_session_spares (const CeldSession *session, const CeldRelation *relation);

/* Says that the ink for depth or the method change, or that labels may have changed anywhere. */
void celd_session_forget_ownership (CeldSession *session);
void celd_session_clear_ownership (CeldSession *session);

/* ------------------------------------------------------------------ route-depth.c */

CeldStatus celd_make_preview (CeldSession *session, const CeldHost *host);
CeldStatus celd_make_depth   (CeldSession *session, const CeldHost *host);

/* The ink for depth, and the same without what lies along the borders of splits: what depth is cut by. */
const CeldPlane *celd_session_depth_ink (const CeldSession *session);
const CeldPlane *celd_session_bent_ink (const CeldSession *session);

/* Takes the plane in place of that of earlier splits; without data there are none. */
void celd_session_bend (CeldSession *session, CeldPlane *bent);

/* Says that this ink, of the same size, will take its place. */
void celd_session_new_depth_ink (CeldSession *session, const CeldPlane *ink);
/* ------------------------------------------------------------------ route-exact.c */

CeldStatus celd_make_weights (CeldSession *session, const CeldHost *host);
CeldStatus celd_make_nodes   (CeldSession *session, const CeldHost *host);
CeldStatus celd_make_exact   (CeldSession *session, const CeldHost *host);

/* ------------------------------------------------------------------ changes.c */

/* Where two tight pictures of so many bytes a pixel differ; everywhere if there is no old one. */
CeldRect celd_difference (const void *old, const void *new, int width, int height, size_t pixel);

/* What the host is to be told the next time it asks. */
void celd_session_see (CeldSession *session, CeldStage stage, CeldRect changed);

/* The same for a plane, which takes the place of the old one. */
void celd_session_replace (CeldSession *session, CeldStage stage, CeldPlane *old, CeldPlane *new);

#endif
