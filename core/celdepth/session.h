/* The session: from a drawing and its layers to every result, kept between edits.
 *
 * Part of celdepth.h, which states the conventions of values, ownership and errors.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELDEPTH_SESSION_H
#define CELDEPTH_SESSION_H

#include "celdepth/records.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Holds a drawing, its layers and relations, and all results made so far.  Set or change them in any order, then ask
 * for a result: only what an edit affects is made again.  Use a session from one thread at a time.  Pictures that are
 * set are copied; pictures returned are views that stay valid until the next call that sets something. */
typedef struct CeldSession CeldSession;

CELD_API CeldSession *celd_session_new (void);                    /* NULL: no memory */
CELD_API void         celd_session_free (CeldSession *session);   /* accepts NULL */
/* Frees all pictures, those that the host set and those that were made, when only a report is left to be written: the
 * palette, relations, order and problems that the session lent stay until it is freed or gets another drawing. */
CELD_API void         celd_session_drop_pictures (CeldSession *session);

/* Settings or a drawing that equal the present ones make no result invalid, and after a failure all stays as it was.
 * Settings out of range are CELD_BAD_VALUE; a drawing without pixels, with more than CELD_MAX_SIDE a side, or with alpha
 * of another size is CELD_BAD_SIZE.  A drawing of another size than the one before removes all layers and results, but
 * no strokes and no relations. */
CELD_API CeldStatus celd_session_set_settings  (CeldSession *session, const CeldSettings *settings);
CELD_API CeldStatus celd_session_set_drawing   (CeldSession *session, const CeldDrawing *drawing);
/* Layers of the drawing's size, else CELD_BAD_SIZE; NULL removes one. */
/* The colours that the drawing was painted in, for the ownership of its lines (celd_own). */
CELD_API CeldStatus celd_session_set_colours   (CeldSession *session, const CeldPaint *colours);
CELD_API CeldStatus celd_session_set_scribbles (CeldSession *session, const CeldPaint *scribbles);
CELD_API CeldStatus celd_session_set_arrows    (CeldSession *session, const CeldPaint *arrows);
CELD_API CeldStatus celd_session_set_contours  (CeldSession *session, const CeldPaint *contours);
/* A depth picture for suggestions, the hint of celd_suggest; a layer like the others. */
CELD_API CeldStatus celd_session_set_depth_hint (CeldSession *session, const CeldPlane *depth);
/* Corrections of contour ownership: strokes over ink, each of which gives the piece of line below it to the region of
 * its colour. */
CELD_API CeldStatus celd_session_set_corrections (CeldSession *session, const CeldPaint *corrections);
/* What is hidden: strokes in a region's colour add to its sheet wherever nearer sheets hide them, black ones take away
 * from all sheets (celd_hidden_read, celd_sheets). */
CELD_API CeldStatus celd_session_set_hidden (CeldSession *session, const CeldPaint *hidden);
/* Relations as text (docs/relations.md), and arrows as SVG path data.  On CELD_BAD_RELATION *error (may be NULL) says
 * where the text cannot be read, and the previous relations stay.  NULL or "" removes them. */
CELD_API CeldStatus celd_session_set_relations (CeldSession *session, const char *text, CeldTextError *error);
CELD_API CeldStatus celd_session_set_arrow_path (CeldSession *session, const char *path, CeldTextError *error);

/* Single strokes over the scribbles layer, with ids (not 0) that the host chooses.  Pixel (u,v) of the mask, if not 0,
 * paints pixel (x+u,y+v) of the drawing; strokes may extend beyond it.  A stroke of a known id replaces the old one at
 * its place in the painting order; new strokes lie above all others.  CELD_BAD_VALUE for id 0, and for removing an
 * unknown id. */
CELD_API CeldStatus celd_session_put_stroke    (CeldSession *session, uint32_t id, int x, int y, const CeldMask *mask,
                                                const uint8_t colour[3]);
CELD_API CeldStatus celd_session_remove_stroke (CeldSession *session, uint32_t id);
/* Single relations in addition to the text and in its grammar, with ids (not 0) that the host chooses.  A text of a
 * known id replaces the old one.  CELD_BAD_VALUE for id 0, text NULL, and for removing an unknown id. */
CELD_API CeldStatus celd_session_put_relation    (CeldSession *session, uint32_t id, const char *text,
                                                  CeldTextError *error);
CELD_API CeldStatus celd_session_remove_relation (CeldSession *session, uint32_t id);

/* Results.  Each function first makes the results that it needs.  It returns CELD_BAD_SIZE without a drawing, and
 * CELD_NOTHING_TO_GO_BY if it needs labels and there are neither scribbles nor arrows.  *changed (may be NULL) is a
 * rectangle outside which the result equals the one that the function returned last: the whole picture the first time
 * and after a drawing of another size, width 0 if nothing differs.  Colours of unchanged labels may differ in the
 * palette. */
CELD_API CeldStatus celd_session_ink (CeldSession *session, const CeldHost *host, CeldPlane *ink, CeldRect *changed);
CELD_API CeldStatus celd_session_labels (CeldSession *session, const CeldHost *host, CeldLabels *labels,
                                         CeldRect *changed);
/* The gaps in contours that the segmentation closed; none with methods other than CELD_METHOD_BASINS. */
CELD_API CeldStatus celd_session_closures (CeldSession *session, const CeldHost *host, const CeldClosures **closures);
/* Paints the closures on a transparent picture, as red lines about as wide as those of the drawing: a layer of virtual
 * contours in which the artist can erase wrong closures.  `paint` has the drawing's size and is overwritten. */
CELD_API CeldStatus celd_session_paint_closures (CeldSession *session, const CeldHost *host, CeldPaint *paint);
/* The suggestions of celd_suggest for the current labels, also if the settings do not use them. */
CELD_API CeldStatus celd_session_suggestions (CeldSession *session, const CeldHost *host,
                                              const CeldRelations **suggested);
/* Paints the suggestions on a transparent picture, as arrows: a layer of arrows in which the artist can erase wrong
 * ones.  Those about the background are left out.  `paint` has the drawing's size and is overwritten. */
CELD_API CeldStatus celd_session_paint_suggestions (CeldSession *session, const CeldHost *host, CeldPaint *paint);
CELD_API CeldStatus celd_session_order (CeldSession *session, const CeldHost *host, const CeldOrder **order);
/* Levels before expansion, in the encoding of the settings: those of the labels. */
CELD_API CeldStatus celd_session_unexpanded_levels (CeldSession *session, const CeldHost *host, CeldPlane *levels,
                                                    CeldRect *changed);
/* Contour ownership: the label that each pixel belongs to, ink included. */
CELD_API CeldStatus celd_session_ownership (CeldSession *session, const CeldHost *host, CeldOwnership *ownership,
                                            CeldRect *changed);
/* The sheets of all regions; borrowed, valid until the next call on the session. */
CELD_API CeldStatus celd_session_sheets (CeldSession *session, const CeldHost *host, const CeldSheets **sheets);
/* Cuts art into a layer for each label, completed with settings->complete: see celd_layers_cut.  The caller owns
 * *layers and frees it with celd_layers_free. */
CELD_API CeldStatus celd_session_layers (CeldSession *session, const CeldColours *art, CeldStore store,
                                         const CeldHost *host, CeldLayers **layers);
/* Makes a model of the sheets with layers of art, see celd_model. */
CELD_API CeldStatus celd_session_model (CeldSession *session, const CeldColours *art, const CeldHost *host,
                                        CeldModel *model);
/* Makes a puppet of completed layers of art, see celd_puppet_new, which tears at relations marked `crack` if there are
 * any.  The caller owns *puppet. */
CELD_API CeldStatus celd_session_puppet (CeldSession *session, const CeldColours *art, const CeldHost *host,
                                         CeldPuppet **puppet);
/* Levels after expansion, in the encoding of the settings: of the label that covers more of each pixel. */
CELD_API CeldStatus celd_session_levels (CeldSession *session, const CeldHost *host, CeldPlane *levels,
                                         CeldRect *changed);
/* Smooth depth, eq. (3).  After an edit only the affected components are solved again, starting from their last depth;
 * all others keep their values exactly.  The preview, to be shown while full depth is made, has a quarter of the width
 * and height, rounded up: its pixel (x,y) stands for the 4 x 4 pixels from (4x,4y) on, and *changed counts in its
 * pixels.  It is made without expansion, so depth changes in the middle of contours, and gaps narrower than about eight
 * pixels are closed. */
CELD_API CeldStatus celd_session_depth_preview (CeldSession *session, const CeldHost *host, CeldPlane *quarter,
                                                CeldRect *changed);
CELD_API CeldStatus celd_session_depth (CeldSession *session, const CeldHost *host, CeldPlane *depth,
                                        CeldRect *changed);
/* Makes the relief of levels and smooth depth, see celd_relief. */
CELD_API CeldStatus celd_session_relief (CeldSession *session, const CeldHost *host, CeldRelief *relief);
CELD_API CeldStatus celd_session_normals (CeldSession *session, const CeldHost *host, CeldVectors *normals,
                                          CeldRect *changed);
CELD_API CeldStatus celd_session_shading (CeldSession *session, const CeldHost *host, CeldPlane *shading,
                                          CeldRect *changed);

/* Exact depth, eq. (1) and (2), see celd_depth_exact, with the background of the settings.  A new relation takes
 * milliseconds if its ends lie on scribbles or are ends of earlier relations.  The preview, to be shown while the first
 * full depth is made, has half the width and height, rounded up, and takes about a quarter of the time. */
CELD_API CeldStatus celd_session_exact (CeldSession *session, const CeldHost *host, CeldPlane *depth,
                                        CeldRect *changed);
CELD_API CeldStatus celd_session_exact_preview (CeldSession *session, const CeldHost *host, CeldPlane *half);
/* The report of exact depth, NULL if that is not valid; and the palette that labels in the report and in its problems
 * refer to.  Borrowed like the palette below. */
CELD_API const CeldExact   *celd_session_exact_report  (const CeldSession *session);
CELD_API const CeldPalette *celd_session_exact_palette (const CeldSession *session);

/* The palette, relations and problems of the results made so far; borrowed, valid until the next call on the session.
 * celd_session_problems returns NULL if there is no memory. */
CELD_API const CeldPalette   *celd_session_palette   (const CeldSession *session);
/* If settings.suggest is not off and the order is valid, suggestions follow the artist's relations. */
CELD_API const CeldRelations *celd_session_relations (const CeldSession *session);
CELD_API const CeldProblems  *celd_session_problems  (CeldSession *session);

#ifdef __cplusplus
}
#endif

#endif
