/* The inside of a CeldSession, for the files of this folder.
 *
 *   session.c        what the host asks for
 *   session-input.c  what the host sets
 *   strokes.c        single strokes over the scribbles layer
 *   stages.c         the stages of the method in their order: makes what is missing for one of them
 *   stage-labels.c   relations, ink, seeds and labels
 *   stage-order.c    suggestions and the depth order
 *   stage-levels.c   levels before expansion, contour ownership, expanded levels
 *   stage-depth.c    smooth depth and its preview
 *   stage-light.c    normals and shading
 *   stage-exact.c    the exact program and its preview
 *   state.c          the object, which results are valid, and where they have changed
 *
 * Files call only those below them, and only stages.c and session.c call stage-*.c.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_SESSION_H
#define CELD_SESSION_H

#include "base/stages.h"
#include "depth/depth.h"
#include "depth/exact.h"
#include "image/image.h"
#include "order/order.h"
#include "ownership/ownership.h"
#include "segment/segment.h"

#define CELD_PREVIEW_TOLERANCE 1e-3f /* of a preview's depth, as a share of its range: hardly visible (chosen) */

/* Pixels x .. end - 1 of row y, relative to the stroke's position. */
typedef struct { int y, x, end; } CeldStrokeSpan;

/* One stroke that the host put over the scribbles layer; its spans are owned. */
typedef struct { uint32_t id; int x, y; uint8_t colour[3]; CeldStrokeSpan *span; size_t n, span_capacity; } CeldStroke;

/* All planes, labels and records are owned by the session unless noted, and tight (stride = width). */
struct CeldSession
{
  /* what the host has set */
  CeldSettings  settings;
  CeldDrawing   drawing;                       /* luma.data NULL: none yet */
  CeldPaint     scribbles, arrows, contours, corrections; /* data NULL: none */
  CeldPlane     hint;                          /* depth from elsewhere; data NULL: none */
  CeldStroke   *stroke;                        /* in painting order */
  size_t        n_strokes;
  CeldRelations text, path, single;            /* as set; painted ones are read in STAGE_RELATIONS */

  /* what was made of it */
  bool           valid[N_STAGES];              /* false: the stage has to be made again */
  CeldRect       unreported[N_STAGES];         /* where the result has changed since the host last asked for it */
  CeldProblems   problems[N_STAGES];
  CeldRelations  relations;                    /* all of the artist's */
  CeldRelations  suggested;
  CeldRelations  joined;                       /* both; the order is made from these with settings.suggest */
  CeldPlane      ink, depth_ink;               /* depth_ink.data NULL: it equals ink */
  CeldSplits     splits;                       /* regions divided because relations contradict each other */
  CeldPlane      split_ink;                    /* depth_ink with the ink along the borders of splits erased;
                                                * data NULL: it equals depth_ink */
  CeldSeedRows   layer_seeds, seeds;           /* of the scribbles layer; with the single strokes over it */
  CeldPalette    layer_palette, seed_palette;
  CeldSegmenter *segmenter;                    /* NULL: none yet */
  CeldPlane      segmenter_ink;                /* what the segmenter was last given: a view of ink, or owned if ink is
                                                * newer; data NULL: the segmenter has to start anew */
  float          segmenter_threshold;          /* settings.ink_threshold and close_gaps at that time */
  bool           segmenter_bridged;
  CeldLabels     segmented;                    /* the segmenter's result */
  CeldLabels     separated;                    /* the same with regions separated or split; data NULL: not needed */
  CeldPalette    palette;
  CeldOrder      order;
  CeldPlane      unexpanded, levels, preview, depth, shading;
  CeldOwnership  ownership;
  uint32_t      *owned_level;                  /* order level of each label when the ownership was made; NULL: the
                                                * ownership has to be made from scratch */
  size_t         n_owned;
  CeldOwnershipCache owners;                       /* its intermediate results; valid while owned_level is not NULL */
  CeldRect       new_labels;                   /* where labels may have changed since the ownership was made */
  bool           new_corrections;              /* whether corrections have */
  float         *value;                        /* encoded level of each label in `levels`; NULL: make all levels anew */
  size_t         n_values;
  CeldRect       new_owners;                   /* where the ownership is newer than `levels` */
  CeldSmoothState smooth_state, preview_state; /* what depth and its preview were made from */
  int            edge_radius;                  /* celd_edge_radius of split_ink; 0: not measured */
  CeldPlane      preview_ink;                  /* of blocks of pixels; data NULL: to be made */
  CeldVectors    normals;
  CeldProgram   *program;                      /* NULL: none yet */
  CeldPalette    exact_palette;                /* of the scribbles, with the background */
  CeldPlane      exact_preview, exact_depth;
  CeldExact      exact;

  CeldProblems   all_problems;                 /* gathered by celd_session_problems */
  size_t         stroke_capacity;
};

/* ------------------------------------------------------------------ state.c */

/* The stages that `stage` is made from, as bits 1 << CeldStage. */
unsigned celd_stage_needs (CeldStage stage);

/* Marks a stage as invalid, and all that are made from it.  Results stay until they are replaced. */
void celd_session_forget (CeldSession *session, CeldStage stage);

/* The ownership cannot be updated any more, and has to be made from scratch; or the same for `levels`. */
void celd_session_forget_ownership (CeldSession *session);
void celd_session_forget_values (CeldSession *session);

/* Frees all results and marks all stages as invalid: for a drawing of another size, and at the end. */
void celd_session_clear_results (CeldSession *session);

/* The bounding box of what differs between two tight pictures of `pixel` bytes per pixel; everything if old is NULL. */
CeldRect celd_changed_rect (const void *old, const void *new, int width, int height, size_t pixel);

/* Adds to what the host is told the next time it asks for this result. */
void celd_session_add_change (CeldSession *session, CeldStage stage, CeldRect changed);

/* Moves `new` into `old`, and adds where they differ to what the host is told. */
void celd_session_replace_plane (CeldSession *session, CeldStage stage, CeldPlane *old, CeldPlane *new);

/* The labels that the host sees. */
const CeldLabels *celd_session_current_labels (const CeldSession *session);

/* The ink for depth; and the same with the borders of splits erased, which decides where depth is cut. */
const CeldPlane *celd_session_depth_ink (const CeldSession *session);
const CeldPlane *celd_session_split_ink (const CeldSession *session);

/* Whether adding this relation behind all others would leave the current labels as they are. */
bool celd_session_relation_keeps_labels (const CeldSession *session, const CeldRelation *relation);

/* ------------------------------------------------------------------ strokes.c */

/* Paints the strokes over the seeds and adds their colours to the palette.
 * After a failure the contents of both are undefined, but they can be cleared. */
CeldStatus celd_strokes_compose (const CeldStroke *stroke, size_t n, CeldSeedRows *seeds, CeldPalette *palette);

/* ------------------------------------------------------------------ stages.c */

/* Makes a stage, if it is not valid, and first what it needs. */
CeldStatus celd_session_make (CeldSession *session, CeldStage stage, const CeldHost *host);

/* ------------------------------------------------------------------ stage-*.c: one function each for stages.c
 *
 * Each makes its result from valid ones.  After a failure the old result is still there. */

/* stage-labels.c; relations mark the labels as invalid if these change with them */
CeldStatus celd_make_relations (CeldSession *session, const CeldHost *host);
CeldStatus celd_make_ink       (CeldSession *session, const CeldHost *host);
CeldStatus celd_make_scribbles (CeldSession *session, const CeldHost *host);
CeldStatus celd_make_seeds     (CeldSession *session, const CeldHost *host);
CeldStatus celd_make_labels    (CeldSession *session, const CeldHost *host);

/* stage-order.c */
CeldStatus celd_make_suggestions (CeldSession *session, const CeldHost *host);
CeldStatus celd_make_order       (CeldSession *session, const CeldHost *host);

/* stage-levels.c */
CeldStatus celd_make_unexpanded (CeldSession *session, const CeldHost *host);
CeldStatus celd_make_ownership (CeldSession *session, const CeldHost *host);
CeldStatus celd_make_levels    (CeldSession *session, const CeldHost *host);

/* stage-depth.c */
CeldStatus celd_make_preview (CeldSession *session, const CeldHost *host);
CeldStatus celd_make_depth   (CeldSession *session, const CeldHost *host);

/* Forgets what was made from the present ink for depth wherever `ink`, which will replace it, differs. */
void celd_session_note_depth_ink (CeldSession *session, const CeldPlane *ink);

/* Replaces split_ink, taking over the plane; data NULL: there are no splits.  Forgets in the same way. */
void celd_session_set_split_ink (CeldSession *session, CeldPlane *split_ink);

/* stage-light.c */
CeldStatus celd_make_normals (CeldSession *session, const CeldHost *host);
CeldStatus celd_make_shading (CeldSession *session, const CeldHost *host);

/* stage-exact.c */
CeldStatus celd_make_weights (CeldSession *session, const CeldHost *host);
CeldStatus celd_make_nodes   (CeldSession *session, const CeldHost *host);
CeldStatus celd_make_exact   (CeldSession *session, const CeldHost *host);

/* The exact depth of a picture of half the size, from valid relations, ink and seeds; takes the place of
 * session->exact_preview. */
CeldStatus celd_make_exact_preview (CeldSession *session, const CeldHost *host);

#endif
