/* The table of all settings: the one home of each one's default, range, choices, label and help.
 *
 * A new setting is a member of CeldSettings (celdepth/settings.h) and a row here; whoever offers it names it: an
 * operation in its list of properties, a sub-command in its list of settings.  `ninja settings-reference` then
 * writes docs/settings.md anew.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "celdepth/settings.h"
#include "base/base.h"

/* ------------------------------------------------------------------ choices, by their numbers */

static const CeldSettingChoice ink_modes[] = {
  [CELD_INK_AUTO]  = { "auto", "Automatic" },
  [CELD_INK_DARK]  = { "dark", "Dark lines" },
  [CELD_INK_LIGHT] = { "light", "Light lines" },
  [CELD_INK_ALPHA] = { "alpha", "Opaque pixels" },
  [CELD_INK_LINES] = { "lines", "Lines of a coloured drawing" },
};

static const CeldSettingChoice methods[] = {
  [CELD_METHOD_BASINS] = { "basins", "Basins" },
  [CELD_METHOD_EXACT]  = { "exact", "Exact" },
  [CELD_METHOD_WALKER] = { "walker", "Random walker" },
};

static const CeldSettingChoice backgrounds[] = {
  [CELD_BACKGROUND_AUTO]   = { "auto", "Along the frame" },
  [CELD_BACKGROUND_NONE]   = { "none", "None" },
  [CELD_BACKGROUND_COLOUR] = { "colour", "By colour" },
};

static const CeldSettingChoice seed_sources[] = {
  [CELD_SEEDS_AUTO]      = { "auto", "Where there is no scribble" },
  [CELD_SEEDS_SCRIBBLES] = { "scribbles", "Never" },
};

static const CeldSettingChoice same_colours[] = {
  [CELD_SAME_COLOUR_ONE]      = { "one", "One depth" },
  [CELD_SAME_COLOUR_SEPARATE] = { "separate", "Separate depths" },
};

static const CeldSettingChoice on_cycles[] = {
  [CELD_ON_CYCLE_REPORT]       = { "report", "Leave out lighter and later relations" },
  [CELD_ON_CYCLE_DROP_WEAKEST] = { "drop-weakest", "Leave out the smallest total weight" },
  [CELD_ON_CYCLE_SPLIT]        = { "split", "Split regions, so that they bend" },
};

static const CeldSettingChoice arrow_styles[] = {
  [CELD_ARROW_HEAD]  = { "head", "The arrowhead points at the farther part" },
  [CELD_ARROW_DOT]   = { "dot", "A dot marks the nearer end" },
  [CELD_ARROW_FADE]  = { "fade", "The opaque end is nearer" },
  [CELD_ARROW_TAPER] = { "taper", "The thick end is nearer" },
};

static const CeldSettingChoice suggestions[] = {
  [CELD_SUGGEST_OFF]       = { "off", "Off" },
  [CELD_SUGGEST_FILL_GAPS] = { "fill-gaps", "Where arrows leave it open" },
  [CELD_SUGGEST_ALL]       = { "all", "All" },
};

static const CeldSettingChoice encodings[] = {
  [CELD_ENCODING_NORMALIZED] = { "normalized", "From 0 to 1" },
  [CELD_ENCODING_RANK]       = { "rank", "Ranks" },
  [CELD_ENCODING_FIXED]      = { "fixed", "Fixed scale" },
};

static const CeldSettingChoice expansions[] = {
  [CELD_EXPANSION_OUTLINES]  = { "outlines", "Outlines" },
  [CELD_EXPANSION_THICKNESS] = { "thickness", "Thickness of contours" },
};

static const CeldSettingChoice anchors[] = {
  [CELD_ANCHORS_SCRIBBLES] = { "scribbles", "Scribbles" },
  [CELD_ANCHORS_ARROWS]    = { "arrows", "Ends of arrows" },
  [CELD_ANCHORS_BOTH]      = { "both", "Scribbles and arrows" },
  [CELD_ANCHORS_CORE]      = { "core", "The core of each region" },
};

static const CeldSettingChoice light_models[] = {
  [CELD_MODEL_LAMBERT]      = { "lambert", "Soft" },
  [CELD_MODEL_HALF_LAMBERT] = { "half-lambert", "Softer" },
  [CELD_MODEL_TOON]         = { "toon", "In steps" },
  [CELD_MODEL_MATCAP]       = { "matcap", "Like a lit ball" },
};

static const CeldSettingChoice lights[] = {
  [CELD_LIGHT_DIRECTION] = { "direction", "From far away" },
  [CELD_LIGHT_POINT]     = { "point", "From a point" },
};

static const CeldSettingChoice enhancements[] = {
  [CELD_ENHANCE_STACK]    = { "stack", "Shadows on what is behind" },
  [CELD_ENHANCE_DARKEN]   = { "darken", "Darker behind depth boundaries" },
  [CELD_ENHANCE_CONTRAST] = { "contrast", "Also lighter in front of them" },
};

static const CeldSettingChoice stereos[] = {
  [CELD_STEREO_LEFT]              = { "left", "Left view" },
  [CELD_STEREO_RIGHT]             = { "right", "Right view" },
  [CELD_STEREO_SIDE_BY_SIDE]      = { "side-by-side", "Side by side" },
  [CELD_STEREO_HALF_SIDE_BY_SIDE] = { "half-side-by-side", "Side by side, half width" },
  [CELD_STEREO_CROSSED]           = { "crossed", "Side by side, for crossed eyes" },
  [CELD_STEREO_OVER_UNDER]        = { "over-under", "One above the other" },
  [CELD_STEREO_HALF_OVER_UNDER]   = { "half-over-under", "One above the other, half height" },
  [CELD_STEREO_INTERLACED]        = { "interlaced", "Alternating rows" },
  [CELD_STEREO_COLUMNS]           = { "columns", "Alternating columns" },
  [CELD_STEREO_GREY]              = { "grey", "Red and cyan glasses, grey" },
  [CELD_STEREO_COLOUR]            = { "colour", "Red and cyan glasses, colour" },
  [CELD_STEREO_HALF_COLOUR]       = { "half-colour", "Red and cyan glasses, half colour" },
  [CELD_STEREO_DUBOIS]            = { "dubois", "Red and cyan glasses, Dubois" },
};

static const CeldSettingChoice camera_paths[] = {
  [CELD_PATH_SWAY]      = { "sway", "From side to side" },
  [CELD_PATH_CIRCLE]    = { "circle", "In a circle" },
  [CELD_PATH_TURNTABLE] = { "turntable", "As if the drawing turned" },
};

static const CeldSettingChoice relief_sources[] = {
  [CELD_RELIEF_INFLATION] = { "inflation", "Inflation" },
  [CELD_RELIEF_NORMALS]   = { "normals", "Normals" },
};

static const CeldSettingChoice mesh_kinds[] = {
  [CELD_MESH_AUTO]        = { "auto", "Parts, solid for STL" },
  [CELD_MESH_SURFACE]     = { "surface", "Surfaces of parts" },
  [CELD_MESH_SOLID]       = { "solid", "Solid parts, on a plate" },
  [CELD_MESH_HEIGHTFIELD] = { "heightfield", "One surface" },
};

/* ------------------------------------------------------------------ the table */

/* The type and place of a member; does not compile if the member is of another type. */
#define MEMBER(member, ctype) _Generic (((CeldSettings *) 0)->member, ctype : offsetof (CeldSettings, member))

#define NUMBER(member)         .type = CELD_SETTING_NUMBER, .offset = MEMBER (member, float)
#define INTEGER(member)        .type = CELD_SETTING_INTEGER, .offset = MEMBER (member, int)
#define SWITCH(member)         .type = CELD_SETTING_SWITCH, .offset = MEMBER (member, bool), .most = 1
#define COLOUR(member)         .type = CELD_SETTING_COLOUR, .offset = offsetof (CeldSettings, member), .most = 0xffffff
#define CHOICE(member, kind, list) \
  .type = CELD_SETTING_CHOICE, .offset = MEMBER (member, kind), .choice_type = #kind, .choice = (list), \
  .choices = sizeof (list) / sizeof *(list), .most = sizeof (list) / sizeof *(list) - 1

#define READ_BY(stage) (1u << STAGE_##stage)

static const CeldSettingInfo infos[] = {

  { .theme = "Drawing",
    .name = "ink", .label = "Ink", CHOICE (ink, CeldInkMode, ink_modes),
    .help = "What counts as ink in the drawing. Lines may be darker than the paper, lighter than the paper (chalk), or "
            "whatever is opaque on a transparent layer. In a coloured drawing they are what is darker, or lighter, than the "
            "fills on both sides of it",
    .stages = READ_BY (INK) },

  { .name = "ink-threshold", .label = "Ink threshold", NUMBER (ink_threshold),
    .help = "Ink at or below this value counts as fully inked (0 is ink, 1 is paper). Raise it if depth leaks through "
            "pale contours",
    .usual = 0.25, .least = 0, .most = 0.99, .shown = { 0, 0.6, 0.01, 0.05, .digits = 2 },
    .stages = READ_BY (LABELS) | READ_BY (NODES) | READ_BY (PREVIEW) | READ_BY (DEPTH) | READ_BY (NORMALS) },

  { .theme = "Regions",
    .name = "method", .label = "Method", CHOICE (method, CeldMethod, methods),
    .help = "How the regions are found. 'basins' works on the basins of the drawing and keeps up with the brush; "
            "'exact' cuts between all pixels and 'walker' is a random walker, which both take a second or more",
    .stages = READ_BY (LABELS) },

  { .name = "close-gaps", .label = "Close gaps", SWITCH (close_gaps),
    .help = "Closes gaps in contours from line end to line end, as a person would draw them",
    .usual = true, .when = "method {basins}", .stages = READ_BY (LABELS) | READ_BY (NODES) },

  { .name = "keep-necks", .label = "Keep necks", SWITCH (keep_necks),
    .help = "Lets a part keep the one colour scribbled in it, however narrow its neck. Otherwise the shorter boundary "
            "wins",
    .usual = true, .when = "method {basins}", .stages = READ_BY (LABELS) | READ_BY (NODES) },

  { .name = "hardness", .label = "Hardness", NUMBER (hardness),
    .help = "How strictly scribbles are obeyed. Soft scribbles may be sloppy, because the majority of the paint wins; "
            "at 1 every painted pixel is obeyed",
    .usual = 0.05, .least = 0.01, .most = 1, .shown = { 0.01, 1, 0.001, 0.1, .gamma = 2, .digits = 2 },
    .stages = READ_BY (LABELS) | READ_BY (NODES) },

  { .name = "flats", .label = "Scribbles are flat colours", SWITCH (flats),
    .help = "The scribbles layer is a finished flat colouring, in which each colour is a region. Without that layer a "
            "coloured drawing is its own",
    .stages = READ_BY (SCRIBBLES) },

  { .name = "background", .label = "Background", CHOICE (background, CeldBackground, backgrounds),
    .help = "Which region lies behind all others. It can be the one along the frame, none, or the one scribbled in the "
            "background colour",
    .stages = READ_BY (LABELS) | READ_BY (NODES) },

  { .name = "background-colour", .label = "Background colour", COLOUR (background_colour),
    .help = "The scribble colour of the background",
    .usual = 0xffffff, .when = "background {colour}", .stages = READ_BY (LABELS) | READ_BY (NODES) },

  { .name = "seeds", .label = "Regions from arrows", CHOICE (seeds, CeldSeeds, seed_sources),
    .help = "Whether the end of an arrow makes a region of its own where there is no scribble",
    .stages = READ_BY (LABELS) },

  { .name = "same-colour", .label = "Same colour", CHOICE (same_colour, CeldSameColour, same_colours),
    .help = "Whether all regions of one colour share one depth, or each has a depth of its own",
    .stages = READ_BY (LABELS) | READ_BY (NODES) },

  { .theme = "Order and levels",
    .name = "arrow-style", .label = "Arrow style", CHOICE (arrow_style, CeldArrowStyle, arrow_styles),
    .help = "How a painted arrow shows which of its ends is nearer",
    .stages = READ_BY (RELATIONS) },

  { .name = "on-cycle", .label = "Contradictions", CHOICE (on_cycle, CeldOnCycle, on_cycles),
    .help = "What gives way when relations contradict each other. 'report' leaves out lighter and later relations one "
            "by one, 'drop-weakest' those with the smallest total weight. 'split' splits regions where that is "
            "cheapest, so that they bend; only Pop-up can do that, other operations then act as with 'drop-weakest'. "
            "Whatever is left out or split is reported",
    .stages = READ_BY (ORDER) | READ_BY (EXACT) },

  { .name = "suggest", .label = "Suggestions", CHOICE (suggest, CeldSuggest, suggestions),
    .help = "Whether the order may also follow from the drawing itself, by its T-junctions and shapes. This can be "
            "never, only where arrows and relations leave the order open, or everywhere; arrows and relations always "
            "take precedence",
    .stages = READ_BY (ORDER) },

  { .name = "encoding", .label = "Encoding", CHOICE (encoding, CeldEncoding, encodings),
    .help = "How levels become numbers. They run from 0 to 1, are ranks (0, 1, 2, ...), or lie on a fixed scale that "
            "does not change with a new arrow",
    .stages = READ_BY (UNEXPANDED) | READ_BY (LEVELS) | READ_BY (PREVIEW) | READ_BY (EXACT) },

  { .name = "near-level", .label = "Near level", NUMBER (near_level),
    .help = "The level that becomes 1; it must be above the far level",
    .usual = 1, .least = -1e6, .most = 1e6, .shown = { 0, 20, 0.01, 1, .digits = 3 }, .when = "encoding {fixed}",
    .stages = READ_BY (UNEXPANDED) | READ_BY (LEVELS) | READ_BY (PREVIEW) | READ_BY (EXACT) },

  { .name = "far-level", .label = "Far level", NUMBER (far_level),
    .help = "The level that becomes 0; it must be below the near level",
    .usual = 0, .least = -1e6, .most = 1e6, .shown = { 0, 20, 0.01, 1, .digits = 3 }, .when = "encoding {fixed}",
    .stages = READ_BY (UNEXPANDED) | READ_BY (LEVELS) | READ_BY (PREVIEW) | READ_BY (EXACT) },

  { .theme = "Contour ownership and layers",
    .name = "expansion", .label = "Contour ownership", CHOICE (expansion, CeldExpansion, expansions),
    .help = "How contours are given to the part that they belong to. 'outlines' follows the outline that one pen drew "
            "around each part, in front of what is behind it; 'thickness' goes by the local thickness of the contours, "
            "as in the paper",
    .stages = READ_BY (OWNERSHIP) },

  { .name = "complete", .label = "Complete", SWITCH (complete),
    .help = "Draws in layers also what nearer layers hide" },

  { .name = "margin", .label = "Margin", NUMBER (margin),
    .help = "How far each part goes on under nearer ones at least, as a fraction of the width, so that views and models "
            "show no cracks",
    .usual = 0.05, .least = 0, .most = 0.5, .shown = { 0, 0.1, 0.005, 0.01, .digits = 3 }, .stages = READ_BY (SHEETS) },

  { .theme = "Smooth depth",
    .name = "anchors", .label = "Anchors", CHOICE (anchors, CeldAnchors, anchors),
    .help = "Which pixels keep their level in smooth depth",
    .stages = READ_BY (PREVIEW) | READ_BY (DEPTH) },

  { .name = "hold-rest", .label = "Hold the rest", SWITCH (hold_rest),
    .help = "Regions without an anchor keep their level in their core. Otherwise they take the depth that flows in "
            "through gaps in their contours",
    .usual = true, .stages = READ_BY (PREVIEW) | READ_BY (DEPTH) },

  { .name = "hold-gaps", .label = "Hold at gaps", SWITCH (hold_gaps),
    .help = "Depth changes abruptly, and shading ends, also where a contour between two levels is broken, for up to "
            "about seven stroke widths. Wider openings, and blue virtual contours, stay smooth; without it every gap "
            "is smooth, as in the paper",
    .usual = true, .stages = READ_BY (PREVIEW) | READ_BY (DEPTH) | READ_BY (NORMALS) | READ_BY (NODES) },

  { .name = "tolerance", .label = "Tolerance", NUMBER (tolerance),
    .help = "The largest error of smooth depth, as a fraction of its range",
    .usual = 1e-4, .least = 1e-7, .most = 0.1, .shown = { 1e-5, 1e-2, 0.001, 0.1, .gamma = 3, .digits = 5 },
    .stages = READ_BY (PREVIEW) | READ_BY (DEPTH) | READ_BY (EXACT) },

  { .theme = "Exact depth and random walker",
    .name = "contrast", .label = "Contrast", NUMBER (contrast),
    .help = "How large a step of the ink must be to separate depths, as a factor of the mean step in the drawing. At "
            "smaller values pale lines separate depths too; at larger ones depth leaks through them",
    .usual = 1, .least = 0.01, .most = 100, .shown = { 0.1, 10, 0.01, 1, .gamma = 3, .digits = 2 },
    .stages = READ_BY (WEIGHTS) },

  { .name = "weight-floor", .label = "Weight floor", NUMBER (weight_floor),
    .help = "How strongly neighbouring pixels are linked at least, even across the blackest line",
    .usual = 1e-6, .least = 1e-6, .most = 1, .shown = { 1e-6, 0.1, 0.001, 0.1, .gamma = 5, .digits = 6 },
    .stages = READ_BY (WEIGHTS) },

  { .theme = "Shape",
    .name = "bulge", .label = "Bulge", NUMBER (bulge),
    .help = "How round the parts look: flat at 0, like balls at 1",
    .usual = 1, .least = 0, .most = 4, .shown = { 0, 2, 0.001, 0.1, .digits = 2 },
    .stages = READ_BY (NORMALS) },

  { .name = "bevel", .label = "Bevel", NUMBER (bevel),
    .help = "How wide the rounded edge of each part is, as a fraction of the picture's diagonal. The inside is flat; "
            "at 0 parts are round all over",
    .usual = 0, .least = 0, .most = 0.5, .shown = { 0, 0.1, 0.001, 0.01, .digits = 4 },
    .stages = READ_BY (NORMALS) },

  { .name = "creases", .label = "Creases", NUMBER (creases),
    .help = "How much parts bend at strokes inside them, such as wrinkles and folds. They bend on both sides of a "
            "stroke, or on the higher side where smooth depth is given",
    .usual = 0, .least = 0, .most = 1, .shown = { 0, 1, 0.001, 0.1, .digits = 2 },
    .stages = READ_BY (NORMALS) },

  { .name = "frame-outline", .label = "Frame is an outline", SWITCH (frame_outline),
    .help = "Parts that are cut off by the frame of the picture bend there, too",
    .stages = READ_BY (NORMALS) },

  { .theme = "Light",
    .name = "light-model", .label = "Shading", CHOICE (light_model, CeldLightModel, light_models),
    .help = "How surfaces are lit. Light is soft, softer so that it reaches around the parts, in steps, or taken from "
            "the picture of a lit ball (matcap)",
    .stages = READ_BY (SHADING) },

  { .name = "toon-steps", .label = "Steps", INTEGER (toon_steps),
    .help = "The number of steps in toon shading, from darkness to the light on what faces the viewer",
    .usual = 3, .least = 2, .most = 5, .shown = { 2, 5, 1, 2, .digits = 0 }, .when = "light-model {toon}",
    .stages = READ_BY (SHADING) },

  { .name = "light-background", .label = "Light on the background", SWITCH (light_background),
    .help = "Whether the background takes light, too. It is the farthest level, if that has half of the picture's frame "
            "or more" },

  { .name = "light", .label = "Light", CHOICE (light, CeldLight, lights),
    .help = "Whether the light comes from far away, or from a point in front of the picture",
    .stages = READ_BY (SHADING) },

  { .name = "light-azimuth", .label = "Light azimuth", NUMBER (light_azimuth),
    .help = "Where the light comes from, in degrees: 0 from the right, 90 from above, 180 from the left",
    .usual = 135, .least = -360, .most = 360, .shown = { 0, 360, 1, 15, .digits = 2 },
    .unit = "degree", .axis = "ccw", .stages = READ_BY (SHADING) },

  { .name = "light-elevation", .label = "Light elevation", NUMBER (light_elevation),
    .help = "How high the light stands, in degrees: 0 beside the picture, 90 in front of it",
    .usual = 45, .least = -90, .most = 90, .shown = { 0, 90, 1, 15, .digits = 2 },
    .unit = "degree", .stages = READ_BY (SHADING) },

  { .name = "ambient", .label = "Ambient light", NUMBER (ambient),
    .help = "The fraction of the light that reaches every pixel",
    .usual = 0.25, .least = 0, .most = 1, .shown = { 0, 1, 0.001, 0.1, .digits = 2 },
    .stages = READ_BY (SHADING) },

  { .name = "light-x", .label = "Light X", NUMBER (light_x),
    .help = "Where the point light is: 0 at the left edge, 1 at the right edge",
    .usual = 0.3, .least = -10, .most = 10, .shown = { 0, 1, 0.001, 0.1, .digits = 3 },
    .unit = "relative-coordinate", .axis = "x", .when = "light {point}", .stages = READ_BY (SHADING) },

  { .name = "light-y", .label = "Light Y", NUMBER (light_y),
    .help = "Where the point light is: 0 at the upper edge, 1 at the lower edge",
    .usual = 0.2, .least = -10, .most = 10, .shown = { 0, 1, 0.001, 0.1, .digits = 3 },
    .unit = "relative-coordinate", .axis = "y", .when = "light {point}", .stages = READ_BY (SHADING) },

  { .name = "light-height", .label = "Light height", NUMBER (light_height),
    .help = "How far in front of the picture the point light is, as a fraction of the picture's diagonal",
    .usual = 0.3, .least = 0.001, .most = 10, .shown = { 0.05, 1, 0.001, 0.1, .digits = 3 },
    .when = "light {point}", .stages = READ_BY (SHADING) },

  { .name = "specular", .label = "Highlights", NUMBER (specular),
    .help = "How bright highlights are",
    .usual = 0, .least = 0, .most = 1, .shown = { 0, 1, 0.001, 0.1, .digits = 2 },
    .stages = READ_BY (SHADING) },

  { .name = "shininess", .label = "Shininess", NUMBER (shininess),
    .help = "How small highlights are",
    .usual = 30, .least = 1, .most = 1000, .shown = { 1, 200, 1, 10, .gamma = 2, .digits = 1 },
    .stages = READ_BY (SHADING) },

  { .name = "rim-light", .label = "Rim light", NUMBER (rim_light),
    .help = "How bright the rims are, where parts turn away from the viewer",
    .usual = 0, .least = 0, .most = 1, .shown = { 0, 1, 0.001, 0.1, .digits = 2 },
    .stages = READ_BY (SHADING) },

  { .name = "rim-power", .label = "Rim narrowness", NUMBER (rim_power),
    .help = "How narrow the rims are",
    .usual = 3, .least = 0.1, .most = 20, .shown = { 0.5, 10, 0.01, 1, .gamma = 2, .digits = 1 },
    .stages = READ_BY (SHADING) },

  { .theme = "Depth enhancement",
    .name = "enhance", .label = "Method", CHOICE (enhance, CeldEnhance, enhancements),
    .help = "How depth is emphasized. Parts cast soft shadows on those behind them, or depth is sharpened: darker "
            "behind a depth boundary, or also lighter in front of it" },

  { .name = "shadow-size", .label = "Size", NUMBER (shadow_size),
    .help = "How far shadows spread, as a fraction of the picture's diagonal",
    .usual = 0.012, .least = 0.0005, .most = 0.2, .shown = { 0.002, 0.05, 0.001, 0.01, .digits = 4 } },

  { .name = "shadow-strength", .label = "Strength", NUMBER (shadow_strength),
    .help = "How dark shadows are, from 0 (none) to 1 (black)",
    .usual = 0.6, .least = 0, .most = 1, .shown = { 0, 1, 0.001, 0.1, .digits = 2 } },

  { .name = "shadow-offset", .label = "Offset", NUMBER (shadow_offset),
    .help = "How far shadows are shifted away from the light, as a fraction of the picture's diagonal",
    .usual = 0, .least = 0, .most = 0.2, .shown = { 0, 0.05, 0.001, 0.01, .digits = 4 }, .when = "enhance {stack}" },

  { .name = "shadow-range", .label = "Full from", NUMBER (shadow_range),
    .help = "The difference of depth from which shadows have full strength, as a fraction of all depth. Smaller "
            "differences give fainter shadows; at 0 all shadows are full",
    .usual = 0, .least = 0, .most = 1, .shown = { 0, 1, 0.001, 0.1, .digits = 2 }, .when = "enhance {stack}" },

  { .theme = "Stereo",
    .name = "stereo", .label = "Arrangement", CHOICE (stereo, CeldStereo, stereos),
    .help = "How the two views are combined in one picture. They are mixed for red and cyan glasses, placed beside or "
            "above each other, or alternate by rows or columns for a screen that separates them; or there is only one "
            "view. Whole views beside or above each other make the picture larger",
    .usual = CELD_STEREO_DUBOIS },

  { .name = "disparity", .label = "Disparity", NUMBER (disparity),
    .help = "How far the nearest and the farthest depth are displaced between the views, as a fraction of the width. "
            "More than 0.033 strains the eyes",
    .usual = 0.02, .least = 0, .most = 0.2, .shown = { 0, 0.05, 0.001, 0.005, .digits = 3 } },

  { .name = "convergence", .label = "Convergence", NUMBER (convergence),
    .help = "Which depth lies on the screen. At 0 it is the farthest, so that everything else stands out in front of "
            "the screen; at 1 it is the nearest, so that everything else lies behind it",
    .usual = 0.5, .least = 0, .most = 1, .shown = { 0, 1, 0.001, 0.1, .digits = 2 } },

  { .name = "floating-window", .label = "Floating window", SWITCH (floating_window),
    .help = "Adds black bars at the sides where the frame cuts off something in front of the screen. They bring the "
            "frame in front of it" },

  { .name = "screen-width", .label = "Screen width", NUMBER (screen_width),
    .help = "How wide the picture will be shown, in mm, to warn where the eyes would have to turn outwards; 0 gives no "
            "warning",
    .usual = 0, .least = 0, .most = 1e6, .shown = { 0, 3000, 1, 100, .digits = 1 }, .unit = "mm" },

  { .name = "path", .label = "Path", CHOICE (path, CeldPath, camera_paths),
    .help = "How the camera moves" },

  { .theme = "Relief and mesh",
    .name = "relief-from", .label = "Round from", CHOICE (relief_from, CeldReliefFrom, relief_sources),
    .help = "Whether parts bulge as if inflated, or follow their normals" },

  { .name = "relief-bulge", .label = "Bulge", NUMBER (relief_bulge),
    .help = "How round the parts are: flat at 0, discs become hemispheres at 1",
    .usual = 0.6, .least = 0, .most = 4, .shown = { 0, 2, 0.001, 0.1, .digits = 2 } },

  { .name = "relief-depth", .label = "Depth", NUMBER (relief_depth),
    .help = "How far the nearest level stands in front of the farthest, as a fraction of the picture's diagonal",
    .usual = 0.06, .least = 0, .most = 1, .shown = { 0, 0.5, 0.01, 0.05, .digits = 3 } },

  { .name = "mesh-kind", .label = "Mesh", CHOICE (mesh_kind, CeldMeshKind, mesh_kinds),
    .help = "Whether each part is a surface of its own, or a closed solid on a plate, or all of the picture is one "
            "surface with cracks where depth jumps. 'auto' makes solids for STL files only" },

  { .name = "mesh-size", .label = "Size", NUMBER (mesh_size),
    .help = "The length of the picture's longer side, in mm",
    .usual = 100, .least = 1, .most = 10000, .shown = { 10, 1000, 1, 10, .digits = 1 }, .unit = "mm" },

  { .name = "mesh-plate", .label = "Plate", NUMBER (mesh_plate),
    .help = "The thickness of the plate under solids, in mm",
    .usual = 2, .least = 0.1, .most = 1000, .shown = { 0.1, 10, 0.1, 1, .digits = 1 }, .unit = "mm" },

  { .name = "mesh-error", .label = "Error", NUMBER (mesh_error),
    .help = "How far the mesh may lie from the heights, in pixels",
    .usual = 0.5, .least = 0.01, .most = 100, .shown = { 0.1, 10, 0.1, 1, .digits = 2 } },

  { .name = "most-vertices", .label = "Vertices", NUMBER (most_vertices),
    .help = "The largest number of vertices. The mesh becomes coarser rather than have more",
    .usual = 1e6, .least = 1000, .most = 16e6, .shown = { 1000, 2e6, 1000, 1e5, .digits = 0 } },

  { .theme = "Registration",
    .name = "cell-size", .label = "Cell size", INTEGER (cell_size),
    .help = "The side of the squares that a drawing is embedded into, in pixels; 0 chooses one by the size of the picture. "
            "Smaller squares follow smaller bends",
    .usual = 0, .least = 0, .most = 1000, .shown = { 0, 100, 1, 10, .digits = 0 } },

  { .name = "stiffness", .label = "Stiffness", INTEGER (stiffness),
    .help = "How rigid parts are. Stiffer parts bend less where lines of the two drawings differ",
    .usual = 20, .least = 1, .most = 200, .shown = { 1, 50, 1, 5, .digits = 0 } },
};

const CeldSettingInfo *
celd_setting_infos (size_t *n)
{
  if (n)
    *n = sizeof infos / sizeof *infos;
  return infos;
}
