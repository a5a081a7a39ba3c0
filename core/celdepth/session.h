/* The session: the route, kept between edits.
 *
 * Part of celdepth.h, which says what values and who owns what.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELDEPTH_SESSION_H
#define CELDEPTH_SESSION_H

#include "celdepth/records.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Holds a drawing, its strokes and relations, and every result made so far.  Set or change anything in any order, then
 * ask: what an edit did not touch is not made again.  One thread at a time.  Pictures given are copied; pictures
 * returned are views that stay valid until the next call that sets something. */
typedef struct CeldSession CeldSession;

CELD_API CeldSession *celd_session_new (void);                    /* NULL: no memory */
CELD_API void         celd_session_free (CeldSession *session);   /* accepts NULL */

CELD_API CeldStatus celd_session_set_settings  (CeldSession *session, const CeldSettings *settings);
CELD_API CeldStatus celd_session_set_drawing   (CeldSession *session, const CeldDrawing *drawing);
/* Layers; NULL removes one.  CELD_BAD_SIZE if the size is not the drawing's.  A drawing of another size removes all. */
CELD_API CeldStatus celd_session_set_scribbles (CeldSession *session, const CeldPaint *scribbles);
CELD_API CeldStatus celd_session_set_arrows    (CeldSession *session, const CeldPaint *arrows);
CELD_API CeldStatus celd_session_set_contours  (CeldSession *session, const CeldPaint *contours);
/* A picture of depth for suggestions, as celd_suggest_from_depth has it, in the same way. */
CELD_API CeldStatus celd_session_set_depth_hint (CeldSession *session, const CeldPlane *depth);
/* Strokes over ink in the colours of regions: each gives the piece of line below it to its region. */
CELD_API CeldStatus celd_session_set_corrections (CeldSession *session, const CeldPaint *corrections);
CELD_API CeldStatus celd_session_set_relations (CeldSession *session, const char *text, CeldTextError *error);
CELD_API CeldStatus celd_session_set_arrow_path (CeldSession *session, const char *path, CeldTextError *error);

/* Single strokes over the scribble layer, by the host's id (not 0): the mask's pixels from (x,y) on take the colour.
 * The same id again replaces the stroke; strokes painted later lie above earlier ones. */
CELD_API CeldStatus celd_session_put_stroke    (CeldSession *session, uint32_t id, int x, int y, const CeldMask *mask,
                                                const uint8_t colour[3]);
CELD_API CeldStatus celd_session_remove_stroke (CeldSession *session, uint32_t id);
/* Single relations beside the text, by the host's id (not 0): one relation in the grammar of the text. */
CELD_API CeldStatus celd_session_put_relation    (CeldSession *session, uint32_t id, const char *text,
                                                  CeldTextError *error);
CELD_API CeldStatus celd_session_remove_relation (CeldSession *session, uint32_t id);

/* Results; each makes what is missing first.  *changed (may be NULL) is the rectangle that differs from the last time
 * this result was asked for: everything the first time, width 0 when nothing does.  `flat` are levels before expansion,
 * `levels` expanded ones.  Where labels stay, their colours in the palette may still have changed. */
CELD_API CeldStatus celd_session_ink (CeldSession *session, const CeldHost *host, CeldPlane *ink, CeldRect *changed);
CELD_API CeldStatus celd_session_labels (CeldSession *session, const CeldHost *host, CeldLabels *labels,
                                         CeldRect *changed);
/* The gaps that these labels close; none with other methods than CELD_METHOD_BASINS. */
CELD_API CeldStatus celd_session_closures (CeldSession *session, const CeldHost *host, const CeldClosures **closures);
/* The same as red lines about as wide as the drawing's, on a transparent picture: a layer of virtual contours, in which
 * the artist may erase what was closed wrongly. */
CELD_API CeldStatus celd_session_paint_closures (CeldSession *session, const CeldHost *host, CeldPaint *paint);
/* What celd_suggest says of these labels, whether the settings apply it or not. */
CELD_API CeldStatus celd_session_suggestions (CeldSession *session, const CeldHost *host,
                                              const CeldRelations **suggested);
/* The same as arrows on a transparent picture: an arrows layer, in which the artist may erase what is wrong. */
CELD_API CeldStatus celd_session_paint_suggestions (CeldSession *session, const CeldHost *host, CeldPaint *paint);
CELD_API CeldStatus celd_session_order (CeldSession *session, const CeldHost *host, const CeldOrder **order);
CELD_API CeldStatus celd_session_unexpanded_levels (CeldSession *session, const CeldHost *host, CeldPlane *levels, CeldRect *changed);
/* Whose the pixels are, with their ink, in the labels above.  Where a pixel has two labels, `levels` have the one that
 * covers more of it. */
CELD_API CeldStatus celd_session_ownership (CeldSession *session, const CeldHost *host, CeldOwnership *ownership,
                                            CeldRect *changed);
/* The art cut into a layer for each label, with settings.complete, see celd_layers_cut; the host's own, to be freed. */
CELD_API CeldStatus celd_session_layers (CeldSession *session, const CeldColours *art, CeldStore store,
                                         const CeldHost *host, CeldLayers **layers);
CELD_API CeldStatus celd_session_levels (CeldSession *session, const CeldHost *host, CeldPlane *levels,
                                         CeldRect *changed);
/* After an edit only what it touched is solved again, from where it was; the rest stays bit by bit.  The preview is for
 * the eye while the full depth is made: a quarter of the width and height, rounded up, pixel (x,y) for those from
 * (4x,4y) on; *changed counts its own pixels.  It needs no expansion, so that its borders lie in the middle of
 * contours, and has gaps narrower than about eight pixels closed. */
CELD_API CeldStatus celd_session_depth_preview (CeldSession *session, const CeldHost *host, CeldPlane *quarter,
                                                CeldRect *changed);
CELD_API CeldStatus celd_session_depth (CeldSession *session, const CeldHost *host, CeldPlane *depth, CeldRect *changed);
CELD_API CeldStatus celd_session_normals (CeldSession *session, const CeldHost *host, CeldVectors *normals,
                                          CeldRect *changed);
CELD_API CeldStatus celd_session_shading (CeldSession *session, const CeldHost *host, CeldPlane *shading,
                                          CeldRect *changed);

/* The exact program, see celd_depth_exact, with the background of the settings.  A new relation is answered in
 * milliseconds if its ends are scribbles or known ends of others.  The preview is for the eye while the first full
 * depth is made: a half of the width and height, rounded up, in about a quarter of the time. */
CELD_API CeldStatus celd_session_exact (CeldSession *session, const CeldHost *host, CeldPlane *depth, CeldRect *changed);
CELD_API CeldStatus celd_session_exact_preview (CeldSession *session, const CeldHost *host, CeldPlane *half);
/* What it says of the depth (NULL if that was not asked for since the last change), and the palette that its labels and
 * those of its problems are in; both borrowed like the palette below. */
CELD_API const CeldExact   *celd_session_exact_report  (const CeldSession *session);
CELD_API const CeldPalette *celd_session_exact_palette (const CeldSession *session);

/* What is known so far; borrowed, valid until the next call on the session.  The problems are NULL if there is no
 * memory to gather them. */
CELD_API const CeldPalette   *celd_session_palette   (const CeldSession *session);
/* With settings.suggest, suggestions stand behind the artist's relations once the order is made. */
CELD_API const CeldRelations *celd_session_relations (const CeldSession *session);
CELD_API const CeldProblems  *celd_session_problems  (CeldSession *session);

#ifdef __cplusplus
}
#endif

#endif
