/* The enumerations of the properties as GEGL knows them: a name for dialogs, a nick for the command line.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "properties.h"

#define ENUM_TYPE(function, Name, ...)                                \
  GType                                                               \
  function (void)                                                     \
  {                                                                   \
    static const GEnumValue values[] = { __VA_ARGS__, { 0, NULL, NULL } }; \
    static GType            type;                                     \
                                                                      \
    if (!type)                                                        \
      type = g_enum_register_static (Name, values);                   \
    return type;                                                      \
  }

ENUM_TYPE (celd_ink_mode_get_type, "CeldInkMode",
           { CELD_INK_AUTO, "Automatic", "auto" },
           { CELD_INK_DARK, "Dark lines", "dark" },
           { CELD_INK_LIGHT, "Light lines", "light" },
           { CELD_INK_ALPHA, "What is opaque", "alpha" })

ENUM_TYPE (celd_method_get_type, "CeldMethod",
           { CELD_METHOD_BASINS, "Basins", "basins" },
           { CELD_METHOD_EXACT, "Exact", "exact" },
           { CELD_METHOD_WALKER, "Random walker", "walker" })

ENUM_TYPE (celd_background_get_type, "CeldBackground",
           { CELD_BACKGROUND_AUTO, "Along the frame", "auto" },
           { CELD_BACKGROUND_NONE, "None", "none" },
           { CELD_BACKGROUND_COLOUR, "Of a colour", "colour" })

ENUM_TYPE (celd_seeds_get_type, "CeldSeeds",
           { CELD_SEEDS_AUTO, "Where no scribble is", "auto" },
           { CELD_SEEDS_SCRIBBLES, "Never", "scribbles" })

ENUM_TYPE (celd_same_colour_get_type, "CeldSameColour",
           { CELD_SAME_COLOUR_ONE, "One depth", "one" },
           { CELD_SAME_COLOUR_SEPARATE, "Separate", "separate" })

ENUM_TYPE (celd_on_cycle_get_type, "CeldOnCycle",
           { CELD_ON_CYCLE_REPORT, "Leave out lighter and later relations", "report" },
           { CELD_ON_CYCLE_DROP_WEAKEST, "Leave out the least weight in sum", "drop-weakest" },
           { CELD_ON_CYCLE_SPLIT, "Split regions, so that they bend", "split" })

ENUM_TYPE (celd_arrow_style_get_type, "CeldArrowStyle",
           { CELD_ARROW_HEAD, "The arrowhead points at the farther part", "head" },
           { CELD_ARROW_DOT, "A dot marks the nearer end", "dot" },
           { CELD_ARROW_FADE, "The opaque end is nearer", "fade" },
           { CELD_ARROW_TAPER, "The thick end is nearer", "taper" })

ENUM_TYPE (celd_anchors_get_type, "CeldAnchors",
           { CELD_ANCHORS_SCRIBBLES, "Scribbles", "scribbles" },
           { CELD_ANCHORS_ARROWS, "Ends of arrows", "arrows" },
           { CELD_ANCHORS_BOTH, "Scribbles and arrows", "both" },
           { CELD_ANCHORS_CORE, "The core of each region", "core" })

ENUM_TYPE (celd_expansion_get_type, "CeldExpansion",
           { CELD_EXPANSION_OUTLINES, "Outlines", "outlines" },
           { CELD_EXPANSION_THICKNESS, "Thickness of contours", "thickness" })

ENUM_TYPE (celd_encoding_get_type, "CeldEncoding",
           { CELD_ENCODING_NORMALIZED, "From 0 to 1", "normalized" },
           { CELD_ENCODING_RANK, "Ranks", "rank" },
           { CELD_ENCODING_FIXED, "Fixed scale", "fixed" })

ENUM_TYPE (celd_purpose_get_type, "CeldPurpose",
           { CELD_FOR_SEGMENTATION, "For segmentation", "segmentation" },
           { CELD_FOR_DEPTH, "For depth", "depth" })

ENUM_TYPE (celd_suggest_get_type, "CeldSuggest",
           { CELD_SUGGEST_OFF, "Off", "off" },
           { CELD_SUGGEST_FILL_GAPS, "Where arrows leave it open", "fill-gaps" },
           { CELD_SUGGEST_ALL, "All", "all" })

ENUM_TYPE (celd_enhance_get_type, "CeldEnhance",
           { CELD_ENHANCE_STACK, "Shadows on what is behind", "stack" },
           { CELD_ENHANCE_DARKEN, "Darker behind borders of depth", "darken" },
           { CELD_ENHANCE_CONTRAST, "Also lighter before them", "contrast" })

ENUM_TYPE (celd_stereo_get_type, "CeldStereo",
           { CELD_STEREO_LEFT, "Left view", "left" },
           { CELD_STEREO_RIGHT, "Right view", "right" },
           { CELD_STEREO_SIDE_BY_SIDE, "Side by side", "side-by-side" },
           { CELD_STEREO_HALF_SIDE_BY_SIDE, "Side by side, half as wide", "half-side-by-side" },
           { CELD_STEREO_CROSSED, "Side by side, for crossed eyes", "crossed" },
           { CELD_STEREO_OVER_UNDER, "One over the other", "over-under" },
           { CELD_STEREO_HALF_OVER_UNDER, "One over the other, half as high", "half-over-under" },
           { CELD_STEREO_INTERLACED, "In turns of rows", "interlaced" },
           { CELD_STEREO_COLUMNS, "In turns of columns", "columns" },
           { CELD_STEREO_GREY, "Red and cyan glasses, grey", "grey" },
           { CELD_STEREO_COLOUR, "Red and cyan glasses, colours", "colour" },
           { CELD_STEREO_HALF_COLOUR, "Red and cyan glasses, half colours", "half-colour" },
           { CELD_STEREO_DUBOIS, "Red and cyan glasses, by Dubois", "dubois" })

ENUM_TYPE (celd_enhance_result_get_type, "CeldEnhanceResult",
           { CELD_ENHANCED_ART, "Art", "art" },
           { CELD_ENHANCED_LAYER, "Shadow layer alone", "layer" },
           { CELD_ENHANCED_VIEW, "View of depth", "view" })

ENUM_TYPE (celd_lumo_result_get_type, "CeldLumoResult",
           { CELD_LUMO_ART, "Shaded art", "art" },
           { CELD_LUMO_SHADING, "Shading", "shading" },
           { CELD_LUMO_NORMALS, "Normals", "normals" },
           { CELD_LUMO_TONE, "Tone: to multiply art by", "tone" },
           { CELD_LUMO_RIM, "Rim: highlights and rims, to put over that", "rim" },
           { CELD_LUMO_OCCLUSION, "Occlusion", "occlusion" })

ENUM_TYPE (celd_light_model_get_type, "CeldLightModel",
           { CELD_MODEL_LAMBERT, "Soft", "lambert" },
           { CELD_MODEL_HALF_LAMBERT, "Softer", "half-lambert" },
           { CELD_MODEL_TOON, "In steps", "toon" },
           { CELD_MODEL_MATCAP, "Like a lit ball", "matcap" })

ENUM_TYPE (celd_light_get_type, "CeldLight",
           { CELD_LIGHT_DIRECTION, "From far away", "direction" },
           { CELD_LIGHT_POINT, "From a point", "point" })

ENUM_TYPE (celd_relief_from_get_type, "CeldReliefFrom",
           { CELD_RELIEF_INFLATION, "Inflation", "inflation" },
           { CELD_RELIEF_NORMALS, "Normals", "normals" })

ENUM_TYPE (celd_relief_unit_get_type, "CeldReliefUnit",
           { CELD_RELIEF_RELATIVE, "From 0 to 1", "relative" },
           { CELD_RELIEF_PIXELS, "In pixels", "pixels" })

ENUM_TYPE (celd_expand_result_get_type, "CeldExpandResult",
           { CELD_EXPAND_LEVELS, "Levels: ink given to its owner", "levels" },
           { CELD_EXPAND_LAYER, "Layer: the drawing cut up, one layer of it", "layer" },
           { CELD_EXPAND_MATTE, "Matte: owner and alpha", "matte" })

ENUM_TYPE (celd_segment_result_get_type, "CeldSegmentResult",
           { CELD_SEGMENT_LABELS, "Labels: the regions as flat colours", "labels" },
           { CELD_SEGMENT_CLOSURES, "Closures: the gaps that were closed, as red contours", "closures" },
           { CELD_SEGMENT_PROBLEMS, "Problems: marks over the drawing where something should be looked at",
             "problems" })

ENUM_TYPE (celd_popup_result_get_type, "CeldPopupResult",
           { CELD_POPUP_LABELS, "Labels: the regions as flat colours", "labels" },
           { CELD_POPUP_ORDER, "Order: the level of each region", "order" },
           { CELD_POPUP_LEVELS, "Levels: ink given to its owner", "levels" },
           { CELD_POPUP_DEPTH, "Depth: smooth", "depth" },
           { CELD_POPUP_NORMALS, "Normals", "normals" },
           { CELD_POPUP_SHADING, "Shading", "shading" },
           { CELD_POPUP_PROBLEMS, "Problems: marks over the drawing where something should be looked at", "problems" },
           { CELD_POPUP_SUGGESTIONS, "Suggestions: which part seems to be in front, as arrows", "suggestions" })
