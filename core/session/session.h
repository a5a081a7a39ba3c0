/* The members of a CeldSession, and the functions that the files of this folder share.
 *
 *   session.c        the results that the host asks for
 *   session-input.c  the settings, pictures and relations that the host sets
 *   stages.c         the stages in their order: makes a stage, and those that it needs, where they are not valid
 *   stage-seeds.c    seeds of the scribbles layer and of single strokes over it
 *   stage-labels.c   relations, ink and labels
 *   stage-order.c    suggestions and the depth order
 *   stage-sheets.c   whole silhouettes of all regions
 *   stage-levels.c   levels before expansion, contour ownership, expanded levels
 *   stage-depth.c    smooth depth and its preview; normals and shading
 *   stage-exact.c    the exact program and its preview
 *   state.c          creating and freeing a session, which results are valid, and where they have changed
 *
 * A file calls only files further down in this list; only stages.c and session.c call stage-*.c.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_SESSION_H
#define CELD_SESSION_H

#include "base/base.h"
#include "depth/depth.h"
#include "image/image.h"
#include "order/order.h"
#include "ownership/ownership.h"
#include "segment/segment.h"

#define CELD_PREVIEW_TOLERANCE 1e-3f /* least tolerance of previews, a fraction of the depth range; such errors are
                                      * hardly visible (chosen) */

/* Pixels x .. end - 1 of row y, relative to the stroke's position. */
typedef struct { int y, x, end; } CeldStrokeSpan;

/* A stroke that the host put over the scribbles layer, with its upper left corner at (x,y); owns its spans. */
typedef struct { uint32_t id; int x, y; uint8_t colour[3]; CeldStrokeSpan *span; size_t n, span_capacity; } CeldStroke;

/* The session owns all planes, labels and records, unless noted; planes and labels are tight (stride = width). */
struct CeldSession
{
  /* set by the host */
  CeldSettings  settings;
  CeldDrawing   drawing;                          /* luma.data NULL: none yet */
  CeldPaint     colours;                          /* that it was painted in; data NULL: grey, or unknown */
  CeldPaint     scribbles, arrows, contours, corrections, hidden; /* data NULL: none */
  CeldPlane     hint;                             /* depth picture for suggestions; data NULL: none */
  CeldStroke   *stroke;                           /* in painting order */
  size_t        n_strokes, stroke_capacity;
  CeldRelations text, path, single;               /* as parsed; STAGE_RELATIONS reads the painted arrows */

  /* for all stages */
  bool         valid[N_STAGES];                   /* false: has to be made before its result is used */
  CeldRect     unreported[N_STAGES];              /* where the result has changed since the host last got it */
  CeldProblems problems[N_STAGES];
  CeldProblems all_problems;                      /* of all valid stages, gathered by celd_session_problems */

  /* relations, ink and seeds */
  CeldRelations relations;                        /* all of the artist's: text, path, painted, single */
  CeldRelations suggested;
  CeldRelations joined;                           /* relations and suggestions; the order is made from these unless
                                                   * settings.suggest is CELD_SUGGEST_OFF */
  CeldPlane     ink, depth_ink;                   /* for segmentation; for depth, data NULL: equal to ink */
  CeldSeedRows  layer_seeds, seeds;               /* of the scribbles layer alone; with the strokes over it */
  CeldPalette   layer_palette, seed_palette;      /* of these two */

  /* labels */
  CeldSegmenter *segmenter;                       /* NULL: none yet */
  CeldPlane      segmenter_ink;                   /* the ink that the segmenter has: a view of ink, or owned if ink is
                                                   * newer; data NULL: it has to be given all of the ink */
  float          segmenter_threshold;             /* settings.ink_threshold and close_gaps of that time */
  bool           segmenter_close_gaps;
  CeldLabels     segmented;                       /* the segmenter's labels */
  CeldLabels     separated;                       /* `segmented` with regions separated or split; data NULL: none is */
  CeldSplits     splits;                          /* regions divided because relations contradict each other */
  CeldPlane      split_ink;                       /* depth_ink without the ink along the boundaries of splits; data
                                                   * NULL: equal to depth_ink */
  CeldPalette    palette;
  CeldOrder      order;

  /* contour ownership and levels */
  CeldOwnership      ownership;
  uint32_t          *ownership_level;             /* order level of each label when the ownership was made; NULL: the
                                                   * ownership has to be made from scratch */
  size_t             n_ownership_levels;
  CeldOwnershipCache ownership_cache;             /* valid while ownership_level is not NULL */
  CeldSheets        *sheets;
  CeldRect           changed_sheets;              /* where the ownership is newer than the sheets */
  CeldLabels         sheet_hints;                 /* `hidden` as the sheets have it; data NULL: none */
  CeldRect           changed_labels;              /* where labels may have changed since the ownership was made */
  bool               changed_corrections;         /* whether corrections may have */
  CeldPlane          unexpanded, levels;
  float             *label_level;                 /* encoded level of each label in `levels`; NULL: these have to be
                                                   * made from scratch */
  size_t             n_label_levels;
  CeldRect           changed_ownership;           /* where the ownership is newer than `levels` */

  /* smooth depth, normals, shading */
  CeldPlane       preview, depth, shading;
  CeldSmoothState smooth_state, preview_state;    /* what depth and its preview were made from */
  int             stroke_width;                   /* celd_stroke_width of split_ink; 0: not measured */
  CeldPlane       preview_ink;                    /* of blocks of pixels; data NULL: not made */
  CeldVectors     normals;

  /* exact depth */
  CeldProgram *program;                           /* NULL: none yet */
  CeldPalette  exact_palette;                     /* of the seeds, with the background */
  CeldPlane    exact_preview, exact_depth;
  CeldExact    exact;
};

/* ------------------------------------------------------------------ state.c */

/* The stages that `stage` is made from, as bits 1 << CeldStage. */
unsigned celd_stage_needs (CeldStage stage);

/* Marks a stage, and all that are made from it, as invalid.  Results stay until they are replaced. */
void celd_session_invalidate (CeldSession *session, CeldStage stage);

/* Frees what an update of the ownership, or of `levels`, needs: the next one is made from scratch. */
void celd_session_discard_ownership (CeldSession *session);
void celd_session_discard_label_levels (CeldSession *session);

/* Frees all results and marks all stages as invalid: for a drawing of another size, and at the end. */
void celd_session_clear_results (CeldSession *session);

/* The bounding box of the pixels that differ in two tight pictures of `pixel` bytes a pixel; with old NULL the whole
 * picture. */
CeldRect celd_changed_rect (const void *old, const void *new, int width, int height, size_t pixel);

/* Adds a rectangle to what is reported with the next result of this stage. */
void celd_session_add_change (CeldSession *session, CeldStage stage, CeldRect changed);

/* Moves `new` into `old`, and adds the rectangle in which they differ to what is reported. */
void celd_session_replace_plane (CeldSession *session, CeldStage stage, CeldPlane *old, CeldPlane *new);

/* The labels that the host gets: `separated`, or else `segmented`. */
const CeldLabels *celd_session_current_labels (const CeldSession *session);

/* The ink for depth; and that without the boundaries of splits, which decides where depth is discontinuous. */
const CeldPlane *celd_session_depth_ink (const CeldSession *session);
const CeldPlane *celd_session_split_ink (const CeldSession *session);

/* stage-depth.c: the ink of boundaries across which depth stays smooth, among others: that for segmentation, and the
 * boundaries of splits.  `drawn` is an own copy if there are any, and has to be freed; NULL: there is no such
 * boundary. */
CeldStatus celd_session_borders (const CeldSession *session, CeldPlane *drawn, const CeldPlane **borders);

/* Whether the current labels would stay as they are with this relation after all others. */
bool celd_session_relation_keeps_labels (const CeldSession *session, const CeldRelation *relation);

/* ------------------------------------------------------------------ stages.c */

/* Makes a stage if it is not valid, and before it the invalid ones that it needs. */
CeldStatus celd_session_make (CeldSession *session, CeldStage stage, const CeldHost *host);

/* ------------------------------------------------------------------ stage-*.c
 *
 * One function for each stage, called by stages.c.  It makes its result from stages that are valid, and replaces the
 * old result only when it succeeds. */

/* stage-seeds.c */
CeldStatus celd_make_scribbles (CeldSession *session, const CeldHost *host);
CeldStatus celd_make_seeds     (CeldSession *session, const CeldHost *host);

/* Paints strokes over the seeds and adds their colours to the palette.
 * After a failure the contents of both are undefined, but can be cleared. */
CeldStatus celd_strokes_compose (const CeldStroke *stroke, size_t n, CeldSeedRows *seeds, CeldPalette *palette);

/* stage-labels.c; celd_make_relations marks the labels as invalid if the relations change them */
CeldStatus celd_make_relations (CeldSession *session, const CeldHost *host);
CeldStatus celd_make_ink       (CeldSession *session, const CeldHost *host);
CeldStatus celd_make_labels    (CeldSession *session, const CeldHost *host);

/* stage-sheets.c */
CeldStatus celd_make_sheets     (CeldSession *session, const CeldHost *host);

/* stage-order.c */
CeldStatus celd_make_suggestions (CeldSession *session, const CeldHost *host);
CeldStatus celd_make_order       (CeldSession *session, const CeldHost *host);

/* stage-levels.c */
CeldStatus celd_make_unexpanded (CeldSession *session, const CeldHost *host);
CeldStatus celd_make_ownership  (CeldSession *session, const CeldHost *host);
CeldStatus celd_make_levels     (CeldSession *session, const CeldHost *host);

/* stage-depth.c */
CeldStatus celd_make_preview (CeldSession *session, const CeldHost *host);
CeldStatus celd_make_depth   (CeldSession *session, const CeldHost *host);
CeldStatus celd_make_normals (CeldSession *session, const CeldHost *host);
CeldStatus celd_make_shading (CeldSession *session, const CeldHost *host);

/* Discards what updates would reuse of the ink for depth, wherever `ink`, which is about to replace it, differs. */
void celd_session_invalidate_depth_ink (CeldSession *session, const CeldPlane *ink);

/* Replaces split_ink and takes over the plane (data NULL: there are no splits); discards as above. */
void celd_session_set_split_ink (CeldSession *session, CeldPlane *split_ink);

/* stage-exact.c */
CeldStatus celd_make_weights (CeldSession *session, const CeldHost *host);
CeldStatus celd_make_nodes   (CeldSession *session, const CeldHost *host);
CeldStatus celd_make_exact   (CeldSession *session, const CeldHost *host);

/* Makes session->exact_preview, exact depth at half the width and height, from valid relations, ink and seeds. */
CeldStatus celd_make_exact_preview (CeldSession *session, const CeldHost *host);

#endif
