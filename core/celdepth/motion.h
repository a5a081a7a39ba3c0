/* Drawings that move, and several together: registration (section 3.4 of the paper), composition (section 5), the clips
 * that labels are carried through, and deformation by handles.
 *
 * Part of celdepth.h, which states the conventions of values, ownership and errors.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELDEPTH_MOTION_H
#define CELDEPTH_MOTION_H

#include "celdepth/records.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Embeds a drawing into a square lattice at rest [SDC09a] (section 3.4).  Without parts (NULL) what moves is all that
 * paper along the frame does not reach, in one part.  Of the settings, cell_size counts.
 * CELD_NOTHING_TO_GO_BY if nothing moves, CELD_BAD_VALUE for labels beyond n. */
CELD_API CeldStatus celd_lattice_new (const CeldPlane *ink, const CeldMovingParts *parts, const CeldSettings *settings,
                                      const CeldHost *host, CeldLattice **lattice);

/* The lattice of levels, expanded or not, with the labels of celd_expand_levels; `regions` may be NULL.  The farthest
 * label does not move if it has most of the frame. */
CELD_API CeldStatus celd_lattice_of_levels (const CeldPlane *ink, const CeldPlane *levels, const CeldLabels *regions,
                                            const CeldSettings *settings, const CeldHost *host,
                                            CeldLattice **lattice);

/* Finds the labels of all relations marked `crack`, the only ones between which a lattice then tears.  Points on ink,
 * if that is not NULL, mean what they mean to celd_order.  Replaces `cracks`. */
CELD_API CeldStatus celd_cracks_find (const CeldLabels *labels, const CeldPalette *palette,
                                      const CeldRelations *relations, const CeldPlane *ink, CeldCracks *cracks);

/* Registers the drawing of a lattice to another one of its size: moves the vertices so that its lines lie on lines of
 * the target, each part as rigidly as possible.  It starts from where the lattice lies, so that one registered to a
 * frame goes on to the next; first all of it is aligned, then each part that is torn off the others.  `confidence`
 * (may be NULL) says how well the lines around each pixel of the source fit, 0 .. 1; 0 outside, and where nearer parts
 * hide it.  CELD_NOTHING_TO_GO_BY if one of the drawings is blank; after a failure the lattice is as before. */
CELD_API CeldStatus celd_register (const CeldPlane *source, const CeldPlane *target, const CeldSettings *settings,
                                   const CeldHost *host, CeldLattice *lattice, CeldPlane *confidence);

/* How far each pixel of the drawing is from its place; 0 outside the silhouette. */
CELD_API CeldStatus celd_lattice_displacement (const CeldLattice *lattice, CeldShifts *shifts);

/* Draws art of the lattice's size, such as the drawing, where the lattice has carried it, nearer parts over farther
 * ones; all else becomes transparent. */
CELD_API CeldStatus celd_lattice_warp (const CeldLattice *lattice, const CeldColours *art, CeldColours *warped);

/* Puts n drawings into a picture of width x height pixels (section 5, Figure 1c, [SBv05]).  Each keeps its own order;
 * relations between them (`relations` may be NULL) put a region of one between two of another.  Where drawings overlap
 * and no relation says otherwise, directly or by others, the later one is in front.  Pages are left out but that of the
 * first drawing, and strokes that hang on parts.  Relations that contradict heavier or earlier ones, or the order of a
 * drawing, are left out and reported as cycles; problems (may be NULL) are appended.  The composition reads the
 * layers, which must outlive it and have colours of one space.  CELD_NOTHING_TO_GO_BY if n is 0, CELD_BAD_VALUE for a
 * placement that is not finite, far outside or out of range. */
CELD_API CeldStatus celd_compose (const CeldFragment *fragment, size_t n, const CeldRelations *relations, int width,
                                  int height, const CeldHost *host, CeldProblems *problems,
                                  CeldComposition **composition);
/* The picture, straight alpha.  A drawing shows as it is, resampled as a whole, wherever nothing else covers it. */
CELD_API CeldStatus celd_composition_flatten (const CeldComposition *composition, const CeldHost *host,
                                              CeldColours *picture);
/* The level of what covers most of each pixel, from 0; 0 also where nothing does. */
CELD_API CeldStatus celd_composition_levels (const CeldComposition *composition, const CeldHost *host,
                                             CeldPlane *levels);
/* Writes the box of a layer as r, g, b, a with straight alpha.  The layers, composited from 0 on, are the picture
 * again; where others hide it completely, a layer has the hidden part that it has in its drawing. */
CELD_API CeldStatus celd_composition_paint (const CeldComposition *composition, size_t layer, const CeldHost *host,
                                            float *rgba);
/* Puts the second picture over the first one, behind those of its parts whose level is above `between`.  If the second
 * one has several levels, the farthest is its page and left out.  `picture` and `levels`, of the size of the first
 * picture, may be NULL; levels are in [0,1]. */
CELD_API CeldStatus celd_compose_levels (const CeldLevelArt piece[2], const CeldPlacement *placement, float between,
                                         const CeldHost *host, CeldColours *picture, CeldPlane *levels);
/* Where a point of a drawing is in the composition. */
CELD_API void       celd_composition_map (const CeldComposition *composition, size_t fragment, double x, double y,
                                          double place[2]);

/* Gives the labels of a key drawing the numbers that its regions have in the palette of all keys of a clip, to which
 * new ones are added: regions of one colour are one, and all backgrounds are.  `joined` may be `labels`.
 * CELD_BAD_VALUE for labels beyond the palette. */
CELD_API CeldStatus celd_join_labels (const CeldLabels *labels, const CeldPalette *palette, CeldPalette *all,
                                      CeldLabels *joined);
/* Names the ends of a relation by the colours of the regions at their places, so that it holds in the other keys,
 * too.  False, and the relation as it was, if an end is outside or in a transparent background, or if both have one
 * colour. */
CELD_API bool       celd_relation_by_colour (const CeldLabels *labels, const CeldPalette *palette,
                                             CeldRelation *relation);

/* Carries the labels of a frame of an animation to another frame of the same size, in which parts have moved; section
 * 3.4 of the paper.  `source` has the labels of all pixels of the frame whose ink is `ink`; `background` (0: none) is
 * the label that does not move where it touches the edge of the picture.  `labels` gets seeds for celd_segment of the
 * frame whose ink is `next`; 0 on ink and close to it.  `certainty` gets how far moved parts and labels agree in each
 * closed shape there, [0,1]; 0 on ink. */
CELD_API CeldStatus celd_propagate (const CeldPlane *ink, const CeldLabels *source, const uint32_t *level,
                                    uint32_t background, const CeldPlane *next, const CeldHost *host,
                                    CeldLabels *labels, CeldPlane *certainty);
/* How sure each label is that was carried from the frame `before`, of all of whose pixels it has labels, to the frame
 * `after`; `back` has those of `after` as celd_propagate carries them back to `before`, where 0 does not count.
 * sure[1] to sure[n] get the share of pixels that came back, or the ratio of both areas if that is less: from 0,
 * nothing agrees, to 1; also 1 for a label that neither frame has.  sure[0] is left alone.  CELD_BAD_VALUE for labels
 * beyond n. */
CELD_API CeldStatus celd_rate_returned (const CeldLabels *before, const CeldLabels *after, const CeldLabels *back,
                                        size_t n, double *sure);

/* Notes which regions of the frame `after` are unsure, vanish or appear beside the frame `before`: item[0] to
 * item[*n_items - 1] in the order of labels, of which there are at most n.  `certainty` is that of celd_propagate, 0 on
 * ink; sure[1] to sure[n] (may be NULL) are those of celd_rate_returned.  Regions smaller than 1 / 2000 of the page are
 * left out unless they are not sure.  *mean gets the mean certainty of all regions, [0,1]; 0 if there are none.
 * CELD_BAD_VALUE for labels beyond n. */
CELD_API CeldStatus celd_note_regions (const CeldPlane *ink, const CeldLabels *before, const CeldLabels *after,
                                       const CeldPlane *certainty, size_t n, uint32_t background, const double *sure,
                                       CeldRegionNote *item, size_t *n_items, double *mean);
/* Whether a person should look at a frame with these notes.  `certainty` is the mean over all its regions, or the least
 * of such means since the key if that is less. */
CELD_API bool       celd_wants_review (const CeldRegionNote *note, size_t n, double certainty);

/* Makes one picture of labels that were propagated to a frame from two keys, one on either side.  Where they differ a
 * connected area takes the label with the higher confidence, certainty times nearness; the nearer key's if both have
 * the same, the first one's if both are as near.  `certainty` gets that of the label, the higher one where both agree;
 * where they differ it is the less the closer the confidence of both is.  `labels` and `certainty` may be those of a
 * side.
 * CELD_BAD_VALUE if there are more than 65534 labels. */
CELD_API CeldStatus celd_blend_propagated (const CeldPropagated side[2], const CeldHost *host, CeldLabels *labels,
                                           CeldPlane *certainty);
/* How sure each of these blended labels is, from side_sure[k][1] to side_sure[k][n] of celd_rate_returned on each side:
 * sure[1] to sure[n] get the better of both, times the share of the label's pixels that this side has, but no more than
 * the intersection over union of the label's areas on both sides; sure[0] is left alone.  CELD_BAD_VALUE for labels
 * beyond n. */
CELD_API CeldStatus celd_rate_blended (const CeldLabels *const side[2], const double *const side_sure[2],
                                       const CeldLabels *labels, size_t n, double *sure);

/* Reads handles for celd_puppet_pose and appends them:  handles = handle { (";" | newline) handle },  handle = x "," y
 * [ "->" x "," y ] [ "^" levels ].  Without an arrow a handle is a pin, which stays where it is.  On CELD_BAD_RELATION
 * nothing is added, and *error (may be NULL) says where.  Locale-independent. */
CELD_API CeldStatus celd_handles_parse (const char *text, CeldHandles *handles, CeldTextError *error);

/* Reads painted handles and appends them: a dot is a pin, and any other stroke an arrow of celd_arrows_read from the
 * place that is taken to where it is taken.  `problems` (may be NULL) gets those of celd_arrows_read. */
CELD_API CeldStatus celd_handles_read (const CeldPaint *paint, CeldArrowStyle style, const CeldHost *host,
                                       CeldHandles *handles, CeldProblems *problems);

/* The handles of a frame from those of n keys, which are in the order of frames and have the same handles: between two
 * keys each goes straight, starting and stopping gently; before the first and after the last key it rests.  `handles`
 * is replaced.  CELD_BAD_VALUE if n is 0, or if the keys around the frame have different numbers of handles. */
CELD_API CeldStatus celd_handles_between (const CeldHandleKey *key, size_t n, int frame, CeldHandles *handles);

/* Makes a puppet of completed layers at rest: a square lattice for each, joined to others where depth is continuous,
 * that is, where levels are equal or no ink of the drawing lies between them, nor with settings->hold_gaps a gap in a
 * contour, unless `borders` (may be NULL) has ink there and `ink` has not; with any cracks of celd_cracks_find
 * (`cracks` may be NULL) wherever layers touch except there.  The layer of label `background` (0: none) does not move.
 * Of the settings cell_size, ink_threshold and hold_gaps count.  The puppet has copies of its input. */
CELD_API CeldStatus celd_puppet_new (const CeldLayers *layers, const CeldPlane *ink, const CeldPlane *borders,
                                     uint32_t background, const CeldCracks *cracks, const CeldSettings *settings,
                                     const CeldHost *host, CeldPuppet **puppet);
/* A puppet of levels, expanded or not, each of which becomes a completed layer of `art`; the farthest does not move if
 * it has most of the frame.  celd_puppet_draw then writes levels as numbers of that picture. */
CELD_API CeldStatus celd_puppet_of_levels (const CeldPlane *ink, const CeldPlane *levels, const CeldColours *art,
                                           const CeldSettings *settings, const CeldHost *host, CeldPuppet **puppet);

/* Poses a puppet [WXXC08]: takes the handles to where they are to be, and all else along as rigidly as possible, always
 * from the rest pose, so that the result does not depend on earlier poses.  A handle holds the nearest part at its
 * place; one outside all parts holds the nearest pixel of any.  Parts that touch move apart if both are held, and a
 * part without a handle goes with the one that it has the longest contact with.  `report` may be NULL.  CELD_BAD_VALUE
 * for numbers that are not finite or beyond 1e6; the pose is then as before. */
CELD_API CeldStatus celd_puppet_pose (CeldPuppet *puppet, const CeldHandle *handle, size_t n, const CeldHost *host,
                                      CeldPoseReport *report);
/* Says what is wrong with a pose and what to do, one sentence on each line, cut to `size` bytes; "" if nothing is.
 * Stretching is reported from twice the length on.  `translate` may be NULL. */
CELD_API void       celd_pose_text   (const CeldPoseReport *report, CeldTranslate translate, char *text, size_t size);
/* Puts what is worse in one report into another, which then tells the worst of several poses. */
CELD_API void       celd_pose_worst  (const CeldPoseReport *report, CeldPoseReport *worst);

/* Draws a puppet in its pose, with straight alpha in the colour space of the layers: parts from back to front by their
 * levels, changed by the depth of handles near them.  `levels` (may be NULL) gets the level of the nearest part that
 * covers half of a pixel.  A puppet at rest gives its drawing back. */
CELD_API CeldStatus celd_puppet_draw (CeldPuppet *puppet, const CeldHost *host, CeldColours *picture,
                                      CeldPlane *levels);

/* The layers of a puppet, those that it was made of: their number, and each as it lies in the pose. */
CELD_API size_t celd_puppet_count (const CeldPuppet *puppet);
CELD_API void   celd_puppet_layer (const CeldPuppet *puppet, size_t layer, CeldPosedLayer *posed);

/* Draws one of the layers alone. */
CELD_API CeldStatus celd_puppet_draw_layer (CeldPuppet *puppet, size_t layer, const CeldHost *host,
                                            CeldColours *picture);

/* Cuts the puppet in its pose into layers, for celd_compose: of the drawing's size, so that what is taken beyond it is
 * cut off; with `complete` each with what others hide of it.  CELD_BAD_VALUE if handles move parts forward or back,
 * since layers have one place in the order.  *layers is freed by the caller with celd_layers_free. */
CELD_API CeldStatus celd_puppet_layers (CeldPuppet *puppet, bool complete, const CeldHost *host, CeldLayers **layers);

/* Finds how the parts of one key drawing move to those of another one of its size [SDC09a, ACOL00; section 3.4].
 * Layers of one label are one part, and are completed.  Each is registered to its lines in the other key as rigidly as
 * possible.  A part that only one key has moves with the part that it is attached to, and in the other key behind what
 * is in front of it, if there is room near it.  Of the settings cell_size, stiffness and ink_threshold count.  Copies
 * of all input are kept.  CELD_BAD_SIZE for keys of different sizes. */
CELD_API CeldStatus celd_inbetween_new (const CeldKey key[2], const CeldSettings *settings, const CeldHost *host,
                                        CeldInbetween **inbetween);

/* Draws what is between the keys at t, from 0, the first key, to 1, the second one: with straight alpha in the colour
 * space of the layers.  Parts are interpolated as rigidly as possible, and drawn from back to front in the order of the
 * first key while t < 0.5, then in that of the second.  Each pixel of a part is drawn from one key: the nearer one, or
 * the other one where only that shows it.  CELD_BAD_VALUE for t outside [0,1]. */
CELD_API CeldStatus celd_inbetween_draw (CeldInbetween *inbetween, double t, const CeldHost *host,
                                         CeldColours *picture);

#ifdef __cplusplus
}
#endif

#endif
