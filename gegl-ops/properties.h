/* The settings of core as properties, one wording for all operations that have them.
 *
 * For the property list of an operation, which gegl-op.h reads several times with other meanings of property_double ()
 * and its kin; hence macros.  The enumerations are core's own where it has them; their types are in properties.c.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_PROPERTIES_H
#define CELD_PROPERTIES_H

#include "op.h"

GType celd_ink_mode_get_type    (void);
GType celd_method_get_type      (void);
GType celd_background_get_type  (void);
GType celd_seeds_get_type       (void);
GType celd_same_colour_get_type (void);
GType celd_on_cycle_get_type (void);
GType celd_arrow_style_get_type (void);
GType celd_anchors_get_type     (void);
GType celd_encoding_get_type    (void);
GType celd_purpose_get_type     (void);
GType celd_suggest_get_type     (void);
GType celd_enhance_get_type     (void);
GType celd_expansion_get_type   (void);
GType celd_relief_from_get_type (void);
GType celd_light_model_get_type     (void);
GType celd_light_get_type       (void);
GType celd_stereo_get_type      (void);

typedef enum
{
  CELD_LUMO_ART, CELD_LUMO_SHADING, CELD_LUMO_NORMALS, CELD_LUMO_TONE, CELD_LUMO_RIM, CELD_LUMO_OCCLUSION
} CeldLumoResult;
typedef enum { CELD_ENHANCED_ART, CELD_ENHANCED_LAYER, CELD_ENHANCED_VIEW } CeldEnhanceResult;
typedef enum { CELD_RELIEF_RELATIVE, CELD_RELIEF_PIXELS } CeldReliefUnit;
typedef enum { CELD_EXPAND_LEVELS, CELD_EXPAND_LAYER, CELD_EXPAND_MATTE } CeldExpandResult;
typedef enum { CELD_SEGMENT_LABELS, CELD_SEGMENT_CLOSURES, CELD_SEGMENT_PROBLEMS } CeldSegmentResult;
typedef enum
{
  CELD_POPUP_LABELS, CELD_POPUP_ORDER, CELD_POPUP_LEVELS, CELD_POPUP_DEPTH, CELD_POPUP_NORMALS, CELD_POPUP_SHADING,
  CELD_POPUP_PROBLEMS, CELD_POPUP_SUGGESTIONS
} CeldPopupResult;

GType celd_lumo_result_get_type    (void);
GType celd_enhance_result_get_type (void);
GType celd_relief_unit_get_type    (void);
GType celd_expand_result_get_type  (void);
GType celd_segment_result_get_type (void);
GType celd_popup_result_get_type   (void);

/* ------------------------------------------------------------------ the drawing */

#define CELD_PROPERTY_INK \
  property_enum (ink, "Ink", CeldInkMode, celd_ink_mode, CELD_INK_AUTO) \
    description ("What is ink: lines darker than the paper, lighter than the paper (chalk), or whatever is " \
                 "painted on a transparent layer")

#define CELD_PROPERTY_INK_THRESHOLD \
  property_double (ink_threshold, "Ink threshold", 0.25) \
    description ("Ink at or below this value counts as fully inked: 0 is ink, 1 is paper. Raise it if depth leaks " \
                 "through pale contours") \
    value_range (0.0, 0.99) \
    ui_range (0.0, 0.6) \
    ui_steps (0.01, 0.05) \
    ui_digits (2)

/* ------------------------------------------------------------------ scribbles and regions */

#define CELD_PROPERTY_METHOD \
  property_enum (method, "Method", CeldMethod, celd_method, CELD_METHOD_BASINS) \
    description ("How regions are found: on the basins of the drawing, at the speed of the brush, by exact cuts of " \
                 "all its pixels, or by a random walker, which both take a second or more") \
  property_boolean (close_gaps, "Close gaps", TRUE) \
    description ("Borders across paper run from line end to line end, as a person would draw them") \
    ui_meta ("visible", "method {basins}") \
  property_boolean (keep_necks, "Keep necks", TRUE) \
    description ("A part with strokes of one colour keeps it, however narrow its neck; without, the shorter border " \
                 "wins") \
    ui_meta ("visible", "method {basins}")

#define CELD_PROPERTY_HARDNESS \
  property_double (hardness, "Hardness", 0.05) \
    description ("Soft strokes may be sloppy: the majority of paint wins. At 1 every painted pixel is obeyed") \
    value_range (0.01, 1.0) \
    ui_range (0.01, 1.0) \
    ui_gamma (2.0) \
    ui_digits (2)

#define CELD_PROPERTY_FLATS \
  property_boolean (flats, "Scribbles are flat colours", FALSE) \
    description ("The scribbles layer is a finished flat colouring: each of its colours is a region")

#define CELD_PROPERTY_BACKGROUND \
  property_enum (background, "Background", CeldBackground, celd_background, CELD_BACKGROUND_AUTO) \
    description ("Which region lies behind all others: the one along the frame, none, or the one of a colour") \
  property_color (background_colour, "Background colour", "white") \
    description ("The scribble colour of the background") \
    ui_meta ("visible", "background {colour}")

#define CELD_PROPERTY_SEEDS \
  property_enum (seeds, "Regions from arrows", CeldSeeds, celd_seeds, CELD_SEEDS_AUTO) \
    description ("May the end of an arrow in a region without a scribble make that region one of its own?")

#define CELD_PROPERTY_SAME_COLOUR \
  property_enum (same_colour, "Same colour", CeldSameColour, celd_same_colour, CELD_SAME_COLOUR_ONE) \
    description ("Do all regions of one colour have one depth, or has each of them its own?")

/* ------------------------------------------------------------------ relations and levels */

#define CELD_PROPERTY_RELATIONS \
  property_string (relations, "Relations", "") \
    description ("What is nearer than what, in words: 120,80 > 300,95 compares two points, #ff0000 > #00ff00 two " \
                 "colours, = means equal. One a line, or with ; between") \
    ui_meta ("multiline", "true")

#define CELD_PROPERTY_ON_CYCLE \
  property_enum (on_cycle, "Contradictions", CeldOnCycle, celd_on_cycle, CELD_ON_CYCLE_REPORT) \
    description ("Of relations that go round in a circle, which are left out: lighter and later ones, each by " \
                 "itself, or those that weigh least together; or regions are split where that is cheapest, and " \
                 "bend: by popup, where regions are made; depth-order leaves out what weighs least, then. " \
                 "All that is left out is named, and each split")

#define CELD_PROPERTY_ARROW_PATH \
  property_string (arrow_path, "Arrow path", "") \
    description ("Arrows as SVG path data, each from the nearer to the farther part: M 120,80 L 300,95") \
    ui_meta ("multiline", "true")

#define CELD_PROPERTY_ARROW_STYLE \
  property_enum (arrow_style, "Arrow style", CeldArrowStyle, celd_arrow_style, CELD_ARROW_HEAD) \
    description ("How a painted arrow says which of its ends is nearer")

#define CELD_PROPERTY_SUGGEST \
  property_enum (suggest, "Suggestions", CeldSuggest, celd_suggest, CELD_SUGGEST_OFF) \
    description ("May the drawing itself say what is in front, by its T-junctions and shapes: never, only where " \
                 "arrows and relations leave it open, or everywhere? Arrows and relations always win")

#define CELD_PROPERTY_ENCODING \
  property_enum (encoding, "Encoding", CeldEncoding, celd_encoding, CELD_ENCODING_NORMALIZED) \
    description ("How levels leave: from 0 to 1, as ranks 0, 1, 2, ..., or on a fixed scale that a new arrow does " \
                 "not change") \
  property_double (near_level, "Near level", 1.0) \
    description ("This level becomes 1") \
    value_range (-1e6, 1e6) \
    ui_range (0.0, 20.0) \
    ui_meta ("visible", "encoding {fixed}") \
  property_double (far_level, "Far level", 0.0) \
    description ("This level becomes 0; it must be less than the near level") \
    value_range (-1e6, 1e6) \
    ui_range (0.0, 20.0) \
    ui_meta ("visible", "encoding {fixed}")

#define CELD_EXPANSION_WORDS \
  "Who gets the ink: each part has outlines of its own pen, over what is behind it, or by the local thickness of " \
  "the contours, as published"

#define CELD_PROPERTY_EXPANSION \
  property_enum (expansion, "Ink owners", CeldExpansion, celd_expansion, CELD_EXPANSION_OUTLINES) \
    description (CELD_EXPANSION_WORDS)

/* ------------------------------------------------------------------ smooth depth */

#define CELD_PROPERTY_HOLD_REST \
  property_boolean (hold_rest, "Hold the rest", TRUE) \
    description ("Regions without an anchor keep their level in their core; without, they take the depth that flows " \
                 "in through gaps in their contours")

#define CELD_PROPERTY_TOLERANCE \
  property_double (tolerance, "Tolerance", 1e-4) \
    description ("Largest error of smooth depth, as a share of its range") \
    value_range (1e-7, 0.1) \
    ui_range (1e-5, 1e-2) \
    ui_gamma (3.0) \
    ui_digits (5)

/* ------------------------------------------------------------------ normals and light */

#define CELD_PROPERTY_BULGE \
  property_double (bulge, "Bulge", 1.0) \
    description ("How round the parts look: 0 is flat, 1 like balls") \
    value_range (0.0, 4.0) \
    ui_range (0.0, 2.0) \
    ui_digits (2)

#define CELD_PROPERTY_AZIMUTH \
  property_double (light_azimuth, "Light azimuth", 135.0) \
    description ("Where the light comes from: 0 from the right, 90 from above, 180 from the left") \
    value_range (-360.0, 360.0) \
    ui_range (0.0, 360.0) \
    ui_meta ("unit", "degree") \
    ui_meta ("direction", "ccw")

#define CELD_PROPERTY_LIGHT \
  CELD_PROPERTY_AZIMUTH \
  property_double (light_elevation, "Light elevation", 45.0) \
    description ("How high the light stands: 0 beside the picture, 90 before it") \
    value_range (-90.0, 90.0) \
    ui_range (0.0, 90.0) \
    ui_meta ("unit", "degree") \
  property_double (ambient, "Ambient light", 0.25) \
    description ("The share of light that reaches every pixel") \
    value_range (0.0, 1.0) \
    ui_digits (2)

#define CELD_PROPERTY_SHAPE \
  property_double (bevel, "Bevel", 0.0) \
    description ("How far parts bend from their outlines, as a share of the picture's diagonal; beyond that they are " \
                 "flat. At 0 they are round all over") \
    value_range (0.0, 0.5) \
    ui_range (0.0, 0.1) \
    ui_steps (0.001, 0.01) \
    ui_digits (4) \
  property_double (quilt, "Quilting", 0.0) \
    description ("How much parts bend on both sides of strokes inside them, such as wrinkles and folds; where smooth " \
                 "depth is given, on the higher side") \
    value_range (0.0, 1.0) \
    ui_digits (2) \
  property_boolean (frame_outline, "Frame is an outline", FALSE) \
    description ("Parts that run out of the picture bend at its frame")

#define CELD_PROPERTY_SHADING \
  property_enum (light_model, "Shading", CeldLightModel, celd_light_model, CELD_MODEL_LAMBERT) \
    description ("Soft light, softer light that reaches round the parts, light in steps, or the picture of a lit " \
                 "ball (matcap) on pad aux5") \
  property_int (toon_steps, "Steps", 3) \
    description ("How many steps toon shading has") \
    value_range (2, 5) \
    ui_meta ("visible", "light-model {toon}") \
  property_enum (light, "Light", CeldLight, celd_light, CELD_LIGHT_DIRECTION) \
    description ("Light from far away, or from a point before the picture")

#define CELD_PROPERTY_POINT_LIGHT \
  property_double (light_x, "Light X", 0.3) \
    description ("Where the point of light is: 0 is the left edge, 1 the right one") \
    value_range (-10.0, 10.0) \
    ui_range (0.0, 1.0) \
    ui_meta ("unit", "relative-coordinate") \
    ui_meta ("axis", "x") \
    ui_meta ("visible", "light {point}") \
  property_double (light_y, "Light Y", 0.2) \
    description ("Where the point of light is: 0 is the upper edge, 1 the lower one") \
    value_range (-10.0, 10.0) \
    ui_range (0.0, 1.0) \
    ui_meta ("unit", "relative-coordinate") \
    ui_meta ("axis", "y") \
    ui_meta ("visible", "light {point}") \
  property_double (light_height, "Light height", 0.3) \
    description ("How far before the picture the point of light is, as a share of the picture's diagonal") \
    value_range (0.001, 10.0) \
    ui_range (0.05, 1.0) \
    ui_meta ("visible", "light {point}")

#define CELD_PROPERTY_GLOSS \
  property_double (specular, "Highlights", 0.0) \
    description ("How bright highlights are") \
    value_range (0.0, 1.0) \
    ui_digits (2) \
  property_double (shininess, "Shininess", 30.0) \
    description ("How small highlights are") \
    value_range (1.0, 1000.0) \
    ui_range (1.0, 200.0) \
    ui_gamma (2.0) \
    ui_digits (1) \
  property_double (rim_light, "Rim light", 0.0) \
    description ("How bright rims are, where parts turn away from the viewer") \
    value_range (0.0, 1.0) \
    ui_digits (2) \
  property_double (rim_power, "Rim narrowness", 3.0) \
    description ("How narrow rims are") \
    value_range (0.1, 20.0) \
    ui_range (0.5, 10.0) \
    ui_gamma (2.0) \
    ui_digits (1)

#define CELD_PROPERTY_OCCLUSION \
  property_double (shadow_size, "Occlusion size", 0.012) \
    description ("How far parts keep light from those behind them, as a share of the picture's diagonal") \
    value_range (0.0005, 0.2) \
    ui_range (0.002, 0.05) \
    ui_steps (0.001, 0.01) \
    ui_digits (4) \
    ui_meta ("visible", "result {occlusion}") \
  property_double (shadow_strength, "Occlusion strength", 0.6) \
    description ("How much light they keep away at most") \
    value_range (0.0, 1.0) \
    ui_digits (2) \
    ui_meta ("visible", "result {occlusion}")

#define CELD_PROPERTY_DIRECTX \
  property_boolean (directx, "DirectX normals", FALSE) \
    description ("Green points down, as DirectX wants it, and not up as in OpenGL") \
    ui_meta ("visible", "result {normals}")

/* ------------------------------------------------------------------ depth enhancement */

#define CELD_PROPERTY_SHADOWS \
  property_enum (enhance, "Method", CeldEnhance, celd_enhance, CELD_ENHANCE_STACK) \
    description ("Parts cast soft shadows on those behind them; or depth is sharpened: darker behind a border of " \
                 "depth, or also lighter before it") \
  property_double (shadow_size, "Size", 0.012) \
    description ("How far shadows spread, as a share of the picture's diagonal") \
    value_range (0.0005, 0.2) \
    ui_range (0.002, 0.05) \
    ui_steps (0.001, 0.01) \
    ui_digits (4) \
  property_double (shadow_strength, "Strength", 0.6) \
    description ("How dark shadows are: 0 leaves the art as it is, 1 reaches black") \
    value_range (0.0, 1.0) \
    ui_digits (2) \
  property_double (shadow_offset, "Offset", 0.0) \
    description ("How far shadows fall away from the light, as a share of the picture's diagonal") \
    value_range (0.0, 0.2) \
    ui_range (0.0, 0.05) \
    ui_steps (0.001, 0.01) \
    ui_digits (4) \
    ui_meta ("visible", "enhance {stack}") \
  CELD_PROPERTY_AZIMUTH \
    ui_meta ("visible", "enhance {stack}") \
  property_double (shadow_range, "Full from", 0.0) \
    description ("From this difference of depth on a shadow is full, as a share of all depth; nearer parts cast " \
                 "fainter ones. At 0 all are full") \
    value_range (0.0, 1.0) \
    ui_digits (2) \
    ui_meta ("visible", "enhance {stack}")

/* ------------------------------------------------------------------ stereo */

#define CELD_PROPERTY_DISPARITY \
  property_enum (stereo, "Arrangement", CeldStereo, celd_stereo, CELD_STEREO_DUBOIS) \
    description ("How two views come in one picture: for red and cyan glasses, beside or over each other, in turns " \
                 "of rows or columns for a screen that parts them, or one view alone. Whole views beside or over " \
                 "each other make the picture larger") \
  property_double (disparity, "Disparity", 0.02) \
    description ("How far depths 1 and 0 lie apart for two eyes, as a share of the width. More than 0.033 strains " \
                 "the eyes") \
    value_range (0.0, 0.2) \
    ui_range (0.0, 0.05) \
    ui_steps (0.001, 0.005) \
    ui_digits (3) \
  property_double (convergence, "Convergence", 0.5) \
    description ("Which depth lies on the screen: at 0 the farthest, so that all the rest comes out of it, at 1 the " \
                 "nearest, so that all the rest lies behind it") \
    value_range (0.0, 1.0) \
    ui_digits (2) \
  property_boolean (floating_window, "Floating window", FALSE) \
    description ("Black bars at the sides, where the frame cuts something in front of the screen: they bring the " \
                 "frame before it") \
  property_double (screen_width, "Screen width", 0.0) \
    description ("How wide the picture will be shown, in mm, to warn where the eyes would have to look apart; 0 does " \
                 "not warn") \
    value_range (0.0, 1e6) \
    ui_range (0.0, 3000.0) \
    ui_meta ("unit", "mm")

#endif
