/* The single steps of the method for one drawing, in their order: ink, scribbles and relations, segmentation, order,
 * contour ownership, depth, normals and light, enhancement, stereo, relief.
 *
 * Part of celdepth.h, which states the conventions of values, ownership and errors.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELDEPTH_STEPS_H
#define CELDEPTH_STEPS_H

#include "celdepth/records.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Computes luma (Rec. 709 weights), and alpha if it is not NULL, of n pixels R'G'B'A of sRGB in [0,1].  Hosts should
 * use this function, so that all of them read the same ink. */
CELD_API void celd_luma (const float *rgba, size_t n, float *luma, float *alpha);

/* Replaces a coloured drawing by its lines, black on white: what is darker, or lighter, than the fills on both sides of
 * it.  For hosts, before a drawing is used: `art` has the colours of `drawing`, in its size.  With CELD_INK_LINES
 * always, with CELD_INK_AUTO if there are fills in several hues or flat greys; otherwise, and after a failure, the
 * drawing stays as it is. */
CELD_API CeldStatus celd_coloured_lines (const CeldPaint *art, CeldInkMode mode, const CeldHost *host,
                                         CeldDrawing *drawing);

/* How clearly lines differ from paper: a blank page, and one that is too small to tell, counts as clear.  For hosts,
 * which refuse what has none, and warn of what is unsure.  `drawing` is as it was painted, before
 * celd_coloured_lines. */
typedef enum
{
  CELD_LINES_CLEAR,
  CELD_LINES_UNSURE, /* a photograph or a painting, or a drawing with faint lines on grain or with much soft shading */
  CELD_LINES_NONE,   /* a photograph, or a painting without lines */
} CeldLineClarity;

CELD_API CeldStatus celd_line_clarity (const CeldDrawing *drawing, const CeldHost *host, CeldLineClarity *clarity);

/* Makes the ink of a drawing: composites it on paper, finds its polarity (with CELD_INK_AUTO), and normalises contrast
 * by the paper around each pixel, so that uneven paper becomes 1 and grey pencil 0.  `ink` has the drawing's size and
 * must not alias it. */
CELD_API CeldStatus celd_ink (const CeldDrawing *drawing, CeldInkMode mode, const CeldHost *host, CeldPlane *ink);
/* Whether there are both ink and paper: a page without lines makes no sense. */
CELD_API bool celd_ink_has_lines (const CeldPlane *ink);

/* Draws virtual contours (section 4) into a drawing, before celd_ink: red strokes become ink, blue strokes ink for
 * segmentation alone, green strokes paper.  Polarity and alpha stay; without alpha in the drawing out->alpha is not
 * changed.  `out` may alias the drawing. */
CELD_API CeldStatus celd_contours_bake (const CeldDrawing *drawing, const CeldPaint *contours, CeldPurpose purpose,
                                        CeldInkMode mode, const CeldHost *host, CeldDrawing *out);

/* Whether a layer can be scribbles, or other strokes: in flat colours on a blank layer, or on scanned paper; no
 * photograph can. */
CELD_API bool celd_are_scribbles (const CeldPaint *paint);
/* Whether a picture is strokes in several clear colours on a blank page. */
CELD_API bool celd_is_coloured_strokes (const CeldPaint *paint);
/* Whether nearly all strokes of a layer are arrows with heads, at least two: scribbles are not. */
CELD_API CeldStatus celd_are_arrows (const CeldPaint *paint, const CeldHost *host, bool *are);
/* Whether scribbles may be a drawing, so that it makes sense to compare both: they are grey, or have lines that part
 * the page. */
CELD_API CeldStatus celd_may_be_drawing (const CeldPaint *scribbles, bool *may_be);

/* Whether a picture is flat parts without lines: in grey on black, as levels and depth are, or as regions.  Pictures of
 * less than three colours are neither. */
typedef enum { CELD_PARTS_NONE, CELD_PARTS_COLOURED, CELD_PARTS_LEVELS } CeldFlatParts;
CELD_API CeldFlatParts celd_flat_parts (const CeldPaint *paint);
/* Whether it is CELD_PARTS_LEVELS, which takes less time to tell. */
CELD_API bool celd_looks_like_levels (const CeldPaint *paint);
/* Whether such parts leave no page blank, so that they are no strokes. */
CELD_API bool celd_is_painted_over (const CeldPaint *paint);

/* Whether a layer has the lines of the drawing, by its ink, as the drawing itself has them, also shaded; and whether it
 * has colours beside them, be it a few thin strokes: as scribbles these can be meant.  Strokes in clear colours are no
 * lines. */
typedef enum { CELD_LAYER_WITHOUT_LINES, CELD_LAYER_COLOURED, CELD_LAYER_OF_LINES } CeldLayerLines;
CELD_API CeldStatus celd_layer_lines (const CeldPaint *layer, const CeldPlane *ink, CeldLayerLines *lines);

/* Whether a picture is a copy of another one, perhaps stored with loss. */
CELD_API CeldStatus celd_is_copy (const CeldPaint *a, const CeldPaint *b, bool *copy);
/* Whether a drawing is nothing but these strokes, on white paper, perhaps stored with loss. */
CELD_API CeldStatus celd_is_flattened (const CeldPaint *drawing, const CeldPaint *strokes, bool *flattened);

/* Whether the drawing and the scribbles, which may be a drawing, are what they were given for, or exchanged, or the
 * same picture, or the scribbles are another drawing. */
typedef enum { CELD_LAYERS_APART, CELD_LAYERS_EXCHANGED, CELD_LAYERS_SAME, CELD_LAYERS_DRAWN } CeldMixUp;
CELD_API CeldStatus celd_mix_up (const CeldPaint *drawing, const CeldPaint *scribbles, CeldMixUp *mix_up);

/* Whether more than a hundredth of a picture is in colour, by more than JPEG makes of grey: levels and depth are
 * not. */
CELD_API bool celd_paint_is_coloured (const CeldPaint *paint);

/* Whether labels of flat colours, and finite levels or depth, flat or smooth, can be such: no photograph with grain or
 * texture can.  For hosts, as those above. */
CELD_API bool celd_are_labels (const CeldLabels *labels, const CeldPalette *palette);
CELD_API bool celd_are_levels (const CeldPlane *levels);
/* Whether finite levels or depth have the lines of their drawing, its ink or its brightness, dark between both sides,
 * as the drawing itself has them, shaded or coloured.  Levels have them as parts of their sides. */
CELD_API CeldStatus celd_levels_have_lines (const CeldPlane *levels, const CeldPlane *drawing, bool *have);
/* Whether finite levels or depth are a drawing: nearly all that changes in it is lines, dark or light. */
CELD_API CeldStatus celd_levels_are_drawing (const CeldPlane *levels, bool *are);
/* Whether finite levels or depth are a drawing, and the drawing, by its brightness, is levels. */
CELD_API CeldStatus celd_levels_are_exchanged (const CeldPlane *levels, const CeldPlane *drawing, bool *exchanged);

/* The share of the steps of finite levels, or of the numbers of labels, that are at lines of a drawing of their size,
 * which are less than 0.5; 1 if there are too few steps to tell. */
CELD_API double celd_steps_on_lines (const CeldPlane *levels, const CeldPlane *lines);

/* Reads painted scribbles: seed labels (0 where nothing is painted), and the palette of their colours, of origin
 * CELD_FROM_SCRIBBLE, by decreasing painted area.  Pixels with alpha below one half count as not painted, and in a
 * picture without alpha those of the most frequent colour (unless settings->flats).  Mixed colours at the edges of
 * strokes make no labels.  A picture without paint gives CELD_OK and an empty palette. */
CELD_API CeldStatus celd_scribbles_read (const CeldPaint *scribbles, const CeldSettings *settings, const CeldHost *host,
                                         CeldLabels *seeds, CeldPalette *palette);

/* Reads the relations grammar of docs/relations.md and appends to `relations`; on CELD_BAD_RELATION nothing is added,
 * and *error (may be NULL) says where.  Locale-independent. */
CELD_API CeldStatus celd_relations_parse (const char *text, CeldRelations *relations, CeldTextError *error);

/* As celd_relations_parse, for relations across n drawings: a term is "NAME:" and then a term of that drawing, or "*"
 * for all of it but the page.  Names are letters, digits, "-", "_" and ".". */
CELD_API CeldStatus celd_fragment_relations_parse (const char *text, const char *const *name, size_t n,
                                                   CeldRelations *relations, CeldTextError *error);

/* Arrows as SVG path data (docs/relations.md): each sub-path becomes one relation from its first to its last point,
 * appended; errors as above. */
CELD_API CeldStatus celd_arrow_path_parse (const char *path, CeldRelations *relations, CeldTextError *error);

/* Reads painted arrows (section 3.1): appends a relation for each connected stroke, and a problem, with its reason and
 * its paint, for each that is unclear. */
CELD_API CeldStatus celd_arrows_read (const CeldPaint *arrows, CeldArrowStyle style, const CeldHost *host,
                                      CeldRelations *relations, CeldProblems *problems);

/* LazyBrush [SDC09b] (section 3.2): every pixel gets a label.  In: seed labels and their palette (both may be empty if
 * arrows make regions).  Out: labels; `palette` is replaced by one that has the regions that arrows made and the
 * background behind those given, with area, x, y filled in; `problems` are appended.  `labels` may alias `seeds`;
 * `relations` and `problems` may be NULL.
 * CELD_NOTHING_TO_GO_BY if there is neither a seed nor a relation to seed from. */
CELD_API CeldStatus celd_segment (const CeldPlane *ink, const CeldLabels *seeds, const CeldRelations *relations,
                                  const CeldSettings *settings, const CeldHost *host,
                                  CeldLabels *labels, CeldPalette *palette, CeldProblems *problems);

/* Draws closures over what the picture contains, as opaque, antialiased red lines about `width` pixels wide. */
CELD_API void celd_closures_paint (const CeldClosures *closures, double width, CeldPaint *paint);

/* Gives each connected region of a label a label of its own, in place (same_colour = separate); the largest region
 * keeps its label, and so do specks of fewer than 16 pixels.  The palette is extended, and area, x, y filled in. */
CELD_API CeldStatus celd_separate (const CeldHost *host, CeldLabels *labels, CeldPalette *palette);

/* Paints labels in their colours, and reads them back.  When reading, every distinct opaque colour is a label, in the
 * order of falling area; transparent pixels are the background that celdepth added. */
CELD_API CeldStatus celd_labels_paint (const CeldLabels *labels, const CeldPalette *palette, CeldPaint *paint);
CELD_API CeldStatus celd_labels_read (const CeldPaint *paint, CeldLabels *labels, CeldPalette *palette);

/* Marks the background in the palette as settings->background says; by default it is the label that has most of the
 * paper along the edge of the picture.  For label pictures read by celd_labels_read; ink may be NULL. */
CELD_API CeldStatus celd_background_mark (const CeldLabels *labels, const CeldPlane *ink, const CeldSettings *settings,
                                          CeldPalette *palette);

/* Suggests which of two touching regions is in front, from T-junctions and other cues of the drawing.  Appends at most
 * one relation for a pair, from a point inside the nearer region to one inside the farther; its source is
 * CELD_SOURCE_SUGGESTION, its weight the confidence in (0,1): 0 = a guess, 1/2 = three times as likely as not.  These
 * suggestions do not contradict each other: the weakest of a cycle is left out.
 * `hint` is a depth picture, for example of a depth estimator, in any unit, larger = nearer; NaN is unknown.  Its
 * suggestions are appended after those of the drawing, which they may contradict; their confidence compares the
 * difference between the medians of two regions with the spread within them.
 * `palette` has the areas and the background of the labels; ink and hint may be NULL. */
CELD_API CeldStatus celd_suggest (const CeldLabels *labels, const CeldPalette *palette, const CeldPlane *ink,
                                  const CeldPlane *hint, const CeldHost *host, CeldRelations *suggested);

/* Paints relations between points as arrows of the default style over what the picture contains, with lines about
 * `width` pixels wide: a layer that celd_arrows_read reads.  The hue goes from orange (weight 0) to green (weight 1).
 * Equalities and relations that name colours are left out; of arrows that would touch only the heaviest is painted. */
CELD_API CeldStatus celd_relations_paint (const CeldRelations *relations, double width, CeldPaint *paint);

/* Depth order: a topological sort (appendix, [Kah62]) of the regions that the relations' ends lie in, with levels by
 * longest paths.  `ink` may be NULL; with it a point on ink means the nearest region within one stroke width.
 * Contradictions are reported as cycles; settings->on_cycle, the only setting that counts (NULL: the default), says
 * which relations are left out.  If all gaps are whole numbers, levels are the heights; otherwise they number the
 * heights that occur. */
CELD_API CeldStatus celd_order (const CeldLabels *labels, const CeldPalette *palette, const CeldRelations *relations,
                                const CeldPlane *ink, const CeldSettings *settings, const CeldHost *host,
                                CeldOrder *order, CeldProblems *problems);

/* celd_order of the artist's relations, followed by those suggestions that contradict neither them (those that
 * settings->on_cycle keeps) nor heavier suggestions; with CELD_SUGGEST_FILL_GAPS only suggestions between regions whose
 * order does not follow from the relations, with CELD_SUGGEST_OFF none.  `joined` is replaced by all these relations
 * and may be `relations`; suggestions get weights below those of the artist's relations.  `suggested` and `ink` may
 * be NULL. */
CELD_API CeldStatus celd_order_suggested (const CeldLabels *labels, const CeldPalette *palette,
                                          const CeldRelations *relations, const CeldRelations *suggested,
                                          const CeldPlane *ink, const CeldSettings *settings, const CeldHost *host,
                                          CeldRelations *joined, CeldOrder *order, CeldProblems *problems);

/* A level in the encoding of the settings: of a height in gaps of one relation, with `levels` one more than the largest
 * height; and of a level of an order. */
CELD_API float celd_encode_level (double level, double levels, const CeldSettings *settings);
CELD_API float celd_order_value (const CeldOrder *order, uint32_t level, const CeldSettings *settings);

/* The levels of labels 1 .. n in a picture that has them already, in any encoding, expanded or not: value[k - 1] is the
 * level that most pixels of label k have (the farthest of all for one without pixels; NaN reads as 0), and level[k - 1]
 * the number of smaller values.  CELD_BAD_VALUE for labels beyond n. */
CELD_API CeldStatus celd_label_levels (const CeldLabels *labels, size_t n, const CeldPlane *levels, float *value,
                                       uint32_t *level);

/* Contour ownership: paper belongs to its label, and ink to the region whose outline it is.  Labels are 1 .. n,
 * level[k - 1] is the level of label k.  `colours` (may be NULL) are those that the drawing was painted in: with outlines,
 * a line that is a darker shade of a region's paper is that region's.  `corrections` (may be NULL; 0 where there is none) are strokes over ink, each
 * of which gives the piece of line below it to its label.  With CELD_EXPANSION_OUTLINES each region has an outline of
 * the width of its pen, over what lies behind it; CELD_EXPANSION_THICKNESS is celd_expand.  The caller provides the
 * pictures of `ownership`; its owner may alias `labels`. */
CELD_API CeldStatus celd_own (const CeldPlane *ink, const CeldPaint *colours, const CeldLabels *labels,
                              const uint32_t *level, size_t n, const CeldLabels *corrections, CeldExpansion method,
                              const CeldHost *host, CeldOwnership *ownership);

/* Reads corrections: opaque pixels get the label of their colour, the first if several have it; all others, and pixels
 * of a colour that no region has, get 0. */
CELD_API CeldStatus celd_corrections_read (const CeldPaint *paint, const CeldPalette *palette, CeldLabels *labels);

/* Reads a layer `hidden` for celd_sheets: as corrections, but that black is CELD_HIDDEN_ERASE, even if a region is
 * black. */
#define CELD_HIDDEN_ERASE UINT32_MAX
CELD_API CeldStatus celd_hidden_read (const CeldPaint *paint, const CeldPalette *palette, CeldLabels *labels);

/* Depth expansion by celd_own, from levels before expansion in any encoding, larger = nearer; NaN reads as 0.  Every
 * level, or with `regions` (may be NULL) every region of one level, is a label.  `corrections` (may be NULL) are labels
 * of `regions`; in a region with several levels they mean the most frequent one.  CELD_BAD_VALUE for corrections
 * without regions.  `expanded` gets the level that covers more of each pixel, and may alias `levels`. */
CELD_API CeldStatus celd_expand_levels (const CeldPlane *ink, const CeldPaint *colours, const CeldPlane *levels,
                                        const CeldLabels *regions, const CeldLabels *corrections, CeldExpansion method,
                                        const CeldHost *host, CeldPlane *expanded);

/* As celd_expand_levels, with the result as a matte: of each pixel's owner its level, its region (`region` may be NULL;
 * 0 without regions) and its coverage of the pixel, (0,1].  `level` may alias `levels`, `region` may alias
 * `regions`. */
CELD_API CeldStatus celd_matte_of_levels (const CeldPlane *ink, const CeldPaint *colours, const CeldPlane *levels,
                                          const CeldLabels *regions, const CeldLabels *corrections,
                                          CeldExpansion method, const CeldHost *host, CeldPlane *level,
                                          CeldLabels *region, CeldPlane *coverage);

/* Depth expansion by the thickness of contours (section 3.3).  Levels may be any numbers, larger = nearer; `expanded`
 * may alias `levels`. */
CELD_API CeldStatus celd_expand (const CeldPlane *ink, const CeldLabels *levels, const CeldHost *host,
                                 CeldLabels *expanded);

/* Sheets: the whole silhouette of each label that has pixels, what others hide of it included.  Labels are 1 .. n of
 * the order; with the order's links, regions that no relation compares may hide each other, without links only higher
 * levels hide lower ones.  The label `background` (0: none) covers the whole picture.  Nothing goes on where it would
 * be visible.  `hints` (may be NULL) are strokes, each of which adds what it covers to the sheet of its label, where
 * nearer sheets hide that, or with CELD_HIDDEN_ERASE takes it away from all; 0 where there is none.  `ink` is the ink
 * for depth.  CELD_NOTHING_TO_GO_BY if n is 0, CELD_BAD_VALUE for labels beyond n. */
CELD_API CeldStatus celd_sheets (const CeldPlane *ink, const CeldOwnership *ownership, const CeldLabels *hints,
                                 const CeldOrder *order, uint32_t background, const CeldSettings *settings,
                                 const CeldHost *host, CeldSheets **sheets);

/* Cuts art (the drawing, or a coloured version of it) into one layer for each label that has pixels, in the order of
 * the sheets, or without them (NULL) of level[label - 1], labels being 1 .. n; of equal levels later labels are in
 * front.  An antialiased pixel of two labels goes to both layers, unmixed into two colours.
 * `art` is in [0,1] and in the space in which the layers will be composited, encoded colours or linear light.  Colours
 * are rounded to what `store` can hold; in 8 bits the composite is exact to one step.
 * Sheets of this ownership add what nearer layers hide, in the colours of the region's own paper and with its own line
 * along its outline.  None of it is visible in the composite.
 * `ink` is the ink for depth.  CELD_NOTHING_TO_GO_BY if n is 0, CELD_BAD_VALUE for labels beyond n, and for sheets of
 * other labels. */
CELD_API CeldStatus celd_layers_cut (const CeldPlane *ink, const CeldOwnership *ownership, const uint32_t *level,
                                     size_t n, const CeldColours *art, const CeldSheets *sheets, CeldStore store,
                                     const CeldHost *host, CeldLayers **layers);

/* Finds the joint of each layer: joint[k], k from 0 to celd_layers_count - 1.  The layer of label `page` (0: none) has
 * no part in it. */
CELD_API CeldStatus celd_layers_joints (const CeldLayers *layers, uint32_t page, CeldJoint *joint);

/* Cuts layers from levels before expansion, with the labels of celd_expand_levels.  The label of a layer is its number,
 * 1 for the farthest.  The farthest label is the background if it covers most of the frame.  Of the settings,
 * expansion, complete and margin count. */
CELD_API CeldStatus celd_layers_of_levels (const CeldPlane *ink, const CeldPaint *colours, const CeldPlane *levels,
                                           const CeldLabels *regions, const CeldLabels *corrections,
                                           const CeldColours *art, CeldStore store, const CeldSettings *settings,
                                           const CeldHost *host, CeldLayers **layers);

/* Smooth depth, eq. (3), from levels, expanded or not.  Anchors, the pixels that `anchors` marks (the paper's U_o),
 * keep their level; with settings->hold_rest, or if `anchors` is NULL, so does the core of each region without one.
 * Depth is discontinuous where levels differ and the least ink within half a stroke width is at or below ink_threshold,
 * so it is smooth across virtual contours.  With settings->hold_gaps it is discontinuous also where such ink is
 * interrupted for no more than about seven stroke widths, but not at ink that is only in `borders` (NULL: there is
 * none), the ink for segmentation.  Components without an anchor keep their level.  A result that misses the
 * tolerance is delivered all the same, and *solve (may be NULL) says so.  `depth` may alias `levels`. */
CELD_API CeldStatus celd_smooth (const CeldPlane *ink, const CeldPlane *borders, const CeldPlane *levels,
                                 const CeldMask *anchors, const CeldSettings *settings, const CeldHost *host,
                                 CeldPlane *depth, CeldSolve *solve);

/* Exact depth, eq. (1) and (2): of all depths that satisfy the relations the one of least energy
 *   sum w_pq (d_p - d_q)^2   with   w_pq = max (weight_floor, exp (-(I_p - I_q)^2 / sigma)),
 * where I_p - I_q is the contrast within the 3 x 3 pixels around p or around q, whichever is smaller, and sigma is
 * settings->contrast times the mean of (I_p - I_q)^2.  `ink` is the ink for depth.  Gaps in it do not hold depth, for
 * which regions are needed: a session has them (settings->hold_gaps).
 * All pixels of a scribble (with same_colour = separate of each of its strokes) have one depth.  A relation's end off
 * every scribble is a node of one pixel, so depth varies within a region if relations form a cycle through different
 * points of it.  Equalities are exact, and gaps may be fractions.  Of a cycle between the same nodes the lightest
 * relation, of equal ones the latest, is left out and reported.  Scribbles that the palette marks as background lie
 * behind all others unless relations say otherwise.
 * `depth` has the encoding of the settings; CELD_ENCODING_RANK gives gaps of one relation, from 0.  `problems` are
 * appended, *exact is replaced; these two and the relations may be NULL.  CELD_NOTHING_TO_GO_BY without seeds and
 * relations. */
CELD_API CeldStatus celd_depth_exact (const CeldPlane *ink, const CeldLabels *seeds, const CeldPalette *palette,
                                      const CeldRelations *relations, const CeldSettings *settings,
                                      const CeldHost *host, CeldPlane *depth, CeldExact *exact,
                                      CeldProblems *problems);

/* Normals by Lumo [Joh02] (section 5) on whole sheets, which are made from the levels: what nearer levels hide of a
 * level is as round as what is seen of it, and the background, if it is the farthest level, faces the viewer.  `levels`
 * are expanded. */
CELD_API CeldStatus celd_normals (const CeldPlane *ink, const CeldPlane *levels, const CeldSettings *settings,
                                  const CeldHost *host, CeldVectors *normals);

/* celd_normals with further input, which may be NULL.  With settings->hold_gaps surfaces end at gaps in contours, too,
 * but not at ink that is only in `borders`, as for celd_smooth.  Strokes inside a region bend the surface as
 * settings->creases says, with `depth` only on their nearer side.  Painted `hints` beside strokes and outlines take
 * precedence: white bends that side, black does not, grey bends both. */
CELD_API CeldStatus celd_normals_hinted (const CeldPlane *ink, const CeldPlane *borders, const CeldPlane *levels,
                                         const CeldPlane *depth, const CeldPaint *hints, const CeldSettings *settings,
                                         const CeldHost *host, CeldVectors *normals);

/* Lights normals as the settings say, in linear light: `tone` is a factor for art, 0 .. 2 and 1 where the surface faces
 * the viewer, and `gloss`, of highlights and rims, blends the product towards white, 0 .. 1.  Ink (`ink` may be NULL)
 * has no gloss.  With the expanded `levels` (may be NULL) an antialiased pixel takes the light of the region whose
 * paper it shows, and the background none unless settings->light_background: it is the farthest of several levels, if
 * that has half of the frame or more.  `matcap`, used by CELD_MODEL_MATCAP alone, is a picture of any size that a lit
 * ball fills; CELD_BAD_VALUE if it is missing. */
CELD_API CeldStatus celd_light (const CeldVectors *normals, const CeldPlane *ink, const CeldPlane *levels,
                                const CeldColours *matcap, const CeldSettings *settings, const CeldHost *host,
                                CeldColours *tone, CeldPlane *gloss);
/* Applies tone and gloss to art in place, so that colours in [0,1] stay there; and makes a white layer of the gloss, to
 * put over art multiplied by the tone. */
CELD_API CeldStatus celd_light_colours (const CeldColours *tone, const CeldPlane *gloss, CeldColours *colours);
CELD_API CeldStatus celd_light_layer   (const CeldPlane *gloss, CeldColours *layer);

/* Shading: the light itself with its gloss, in [0,1], also on the background; a tone is its quotient by the light on a
 * surface that faces the viewer.  CELD_BAD_VALUE for CELD_MODEL_MATCAP. */
CELD_API CeldStatus celd_shade (const CeldVectors *normals, const CeldSettings *settings, CeldPlane *shading);

/* Replaces colours below transparent pixels, so that a game engine which blends neighbouring pixels shows no seams:
 * pixels with alpha below one half get the colour of the nearest other pixel within `radius` pixels; beyond it fully
 * transparent ones get `blank`.  Alpha stays. */
CELD_API CeldStatus celd_pad_colours (int radius, const float blank[3], const CeldHost *host, CeldColours *picture);

/* Depth enhancement (section 5, [LCD06], Figures 1d and 5c): a relative change of brightness in linear light, from -1
 * (black) over 0 (none) to 1 (twice as bright).  `levels` are expanded; NaN reads as 0.  Shadows of the stack
 * distinguish at most 256 levels. */
CELD_API CeldStatus celd_enhance (const CeldPlane *levels, const CeldSettings *settings, const CeldHost *host,
                                  CeldPlane *change);
/* Ambient occlusion: the fraction of light that the stack of shadows leaves, without its offset, from
 * 1 - shadow_strength to 1. */
CELD_API CeldStatus celd_occlusion (const CeldPlane *levels, const CeldSettings *settings, const CeldHost *host,
                                    CeldPlane *occlusion);
/* Applies a change of brightness to art in place; makes a black layer of its shadows, to put over art; and applies it
 * to a grey picture of the levels, the nearest white, which shows depth while drawing (Figure 5c).  All in linear
 * light. */
CELD_API CeldStatus celd_enhance_colours (const CeldPlane *change, CeldColours *colours);
CELD_API CeldStatus celd_enhance_layer   (const CeldPlane *change, CeldColours *layer);
CELD_API CeldStatus celd_enhance_view    (const CeldPlane *levels, const CeldPlane *change, CeldPlane *view);

/* A drawing that can be viewed from other places (section 5, Figure 1g). */
typedef struct CeldScene CeldScene;

/* A scene of layers; each moves by its own depth, which goes on smoothly where the layer is occluded.  Completed layers
 * leave no holes, since their margins are seen where they move apart.  `ownership` is the one that the layers were cut
 * by.  The scene reads the layers and the depth, which must outlive it.  Views have the colour space of the layers. */
CELD_API CeldStatus celd_scene_of_layers (const CeldLayers *layers, const CeldOwnership *ownership,
                                          const CeldPlane *depth, const CeldHost *host, CeldScene **scene);
/* A scene of levels, expanded or not, each of which becomes a completed layer of `art`.  The scene reads the depth,
 * which must outlive it. */
CELD_API CeldStatus celd_scene_of_levels (const CeldPlane *ink, const CeldPlane *levels, const CeldPlane *depth,
                                          const CeldColours *art, const CeldSettings *settings,
                                          const CeldHost *host, CeldScene **scene);
/* A scene of a depth map alone, of any origin: what comes into view is filled from its farther side, with the colour of
 * the paper there, without ink.  For horizontal views of at most settings->disparity.  The scene has copies of its
 * input. */
CELD_API CeldStatus celd_scene_of_depth (const CeldColours *art, const CeldPlane *ink, const CeldPlane *depth,
                                         const CeldSettings *settings, const CeldHost *host, CeldScene **scene);
CELD_API void       celd_scene_free     (CeldScene *scene);      /* accepts NULL */

/* A position of the camera: x is -1 for the left eye, 1 for the right eye; y is -1 as far above, 1 below; 0,0 shows the
 * drawing itself.  `squeeze` is the apparent width of the picture, (0,1], below 1 when it is turned. */
typedef struct { double x, y, squeeze; } CeldCamera;
CELD_API CeldCamera celd_camera_eye (double eye);
/* The camera for `frame` of `frames` on a closed path.  On CELD_PATH_TURNTABLE the picture turns by this angle to
 * either side, where x is 1 or -1. */
#define CELD_TURNTABLE_ANGLE 20.0 /* degrees; chosen */
CELD_API CeldCamera celd_camera_on_path (CeldPath path, int frame, int frames);

/* Renders a view: a point moves away from the camera by disparity / 2 of the width, times its depth in front of the
 * screen as a fraction of the range. */
CELD_API CeldStatus celd_scene_view (const CeldScene *scene, CeldCamera camera, const CeldSettings *settings,
                                     const CeldHost *host, CeldColours *view);

/* A relief on the turntable is a scene whose depth is its heights.  celd_turntable_depth makes these depth in [0,1],
 * with all 0 if the relief is level; `depth` has the size of the relief, or else CELD_BAD_SIZE.  `range` gets the
 * pixels from the farthest height to the nearest one.  Heights are finite, as those of celd_relief are. */
CELD_API CeldStatus celd_turntable_depth    (const CeldRelief *relief, CeldPlane *depth, double *range);
/* Sets disparity and convergence such that celd_scene_view of that scene shows what has turned about a vertical axis
 * through the middle of its heights; `width` is the scene's.  A disparity that the setting does not take becomes the
 * largest one that it does. */
CELD_API void       celd_turntable_settings (double range, int width, CeldSettings *settings);
/* The camera for `frame` of `frames` from one side of the turntable to the other, x from -1 to 1.  A single frame is
 * seen from the front. */
CELD_API CeldCamera celd_turntable_sweep    (int frame, int frames);

/* Limits of comfort: the disparity in front of and behind the screen, as fractions of the width; whether the left or
 * right side of the frame cuts off something in front of the screen, which the eyes cannot fuse; and whether the eyes
 * would have to diverge on a screen of settings->screen_width. */
typedef struct { double front, behind; bool cut_left, cut_right, diverges; } CeldComfort;
#define CELD_STEREO_COMFORT (1.0 / 30) /* fraction of the width: more disparity from front to back strains the eyes */
#define CELD_EYE_DISTANCE   65.0       /* mm: with more behind the screen the eyes diverge */
CELD_API CeldStatus celd_stereo_comfort (const CeldPlane *depth, const CeldSettings *settings, CeldComfort *comfort);
/* Describes what strains the eyes and how to avoid it, one sentence on each line, cut to `size` bytes; "" if nothing
 * does. */
CELD_API void       celd_comfort_text   (const CeldComfort *comfort, const CeldSettings *settings,
                                         CeldTranslate translate, char *text, size_t size);
/* Draws a floating window: black bars at the left of the left view and at the right of the right view, as narrow as
 * they can be for the frame to appear in front of what it cuts off. */
CELD_API CeldStatus celd_stereo_window (const CeldPlane *depth, const CeldSettings *settings, CeldColours *left,
                                        CeldColours *right);
/* Packs two views into one picture of the size that celd_stereo_size computes; anaglyphs are for glasses with red on
 * the left and cyan on the right, and in linear light.  `joined` may be the left view if it has its size. */
CELD_API void       celd_stereo_size (CeldStereo format, int *width, int *height);
CELD_API CeldStatus celd_stereo_join (const CeldColours *left, const CeldColours *right, CeldStereo format,
                                      CeldColours *joined);

/* Makes a relief: each region is inflated by settings->relief_bulge, placed at its depth, and moved forward where it would
 * intersect what is behind it.  The surface is cut at depth discontinuities only, those of celd_smooth with
 * `borders` (may be NULL).  `depth` is smooth depth; NULL: computed by celd_smooth.  Replaces `relief`. */
CELD_API CeldStatus celd_relief (const CeldPlane *ink, const CeldPlane *borders, const CeldPlane *levels,
                                 const CeldPlane *depth, const CeldSettings *settings, const CeldHost *host,
                                 CeldRelief *relief);
CELD_API void       celd_relief_clear (CeldRelief *relief);   /* accepts a zeroed one */

/* Makes a mesh.  CELD_BAD_VALUE also if settings->most_vertices is too small for the cuts alone, or if heights are not
 * finite or beyond CELD_MOST_HEIGHT, as those of celd_relief never are.  Replaces `mesh`. */
#define CELD_MOST_HEIGHT 1e12f /* pixels */
CELD_API CeldStatus celd_relief_mesh (const CeldRelief *relief, const CeldSettings *settings, const CeldHost *host,
                                      CeldReliefMesh *mesh);
CELD_API void       celd_relief_mesh_clear (CeldReliefMesh *mesh);         /* accepts a zeroed one */

/* Makes a model of sheets: each region is inflated by settings->relief_bulge on its whole silhouette, and lies on those
 * behind it, in front of all that it hides.  Where regions meet without a line their surfaces join, but
 * not at gaps that hold depth in celd_smooth.  Meshes are open at the back; with CELD_MESH_SOLID each is a closed body
 * that stands in the plate, and bodies overlap.
 * `ownership` and `layers` are those of the sheets; `ink` is the ink for depth, and `borders` (may be NULL) is as for
 * celd_smooth.  CELD_BAD_VALUE also if settings->most_vertices is too small for the outlines alone.  Replaces
 * `model`. */
CELD_API CeldStatus celd_model (const CeldSheets *sheets, const CeldOwnership *ownership, const CeldLayers *layers,
                                const CeldPlane *ink, const CeldPlane *borders, const CeldSettings *settings,
                                const CeldHost *host, CeldModel *model);
/* Gives each of n regions, and what has label 0, one level, in place: the median of its levels, of two the higher one.
 * NaN reads as 0.  Makes levels for a model of which regions are known better than from expanded levels, which differ
 * in ink.  CELD_BAD_VALUE for labels beyond n. */
CELD_API CeldStatus celd_flatten_levels (const CeldLabels *regions, size_t n, CeldPlane *levels);
/* A model of levels, expanded or not, with the labels of celd_expand_levels; `regions` may be NULL. */
CELD_API CeldStatus celd_model_of_levels (const CeldPlane *ink, const CeldPlane *borders, const CeldPlane *levels,
                                          const CeldLabels *regions, const CeldColours *art,
                                          const CeldSettings *settings, const CeldHost *host, CeldModel *model);
CELD_API void       celd_model_clear (CeldModel *model);      /* accepts a zeroed one */

#ifdef __cplusplus
}
#endif

#endif
