/* Tables of what plug-ins offer.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "front-end.h"

const char *const celd_layer_arguments[CELD_N_LAYERS] = {
  [CELD_LAYER_DRAWING]  = "drawing",  [CELD_LAYER_SCRIBBLES]   = "scribbles",   [CELD_LAYER_ARROWS] = "arrows",
  [CELD_LAYER_CONTOURS] = "contours", [CELD_LAYER_CORRECTIONS] = "corrections", [CELD_LAYER_HIDDEN] = "hidden",
};

const char *const celd_layer_help[CELD_N_LAYERS] = {
  [CELD_LAYER_DRAWING]     = "The line drawing; in colours it is also the art that is lit",
  [CELD_LAYER_SCRIBBLES]   = "One stroke over each part, in a colour of its own",
  [CELD_LAYER_ARROWS]      = "Arrows that point from nearer to farther parts",
  [CELD_LAYER_CONTOURS]    = "Virtual contours. Red: a boundary of regions and depth; blue: a boundary of regions "
                             "across which depth stays smooth; green: ink that is not a boundary",
  [CELD_LAYER_CORRECTIONS] = "Strokes over lines, in the colour of the part that a line belongs to",
  [CELD_LAYER_HIDDEN]      = "What is hidden: strokes in a part's colour where it goes on behind nearer ones, black "
                             "where it does not",
};

const CeldPictureInfo celd_pictures[CELD_POPUP_PICTURES] = {
  [CELD_PICTURE_REGIONS]  = { "regions", "labels", "_Regions", "The parts as flat colours", "Regions", TRUE, TRUE },
  [CELD_PICTURE_LEVELS]   = { "levels", "levels", "Le_vels",
                              "The depth of each part, in steps; nearer is lighter", "Levels", FALSE, FALSE },
  [CELD_PICTURE_DEPTH]    = { "depth", "depth", "_Depth", "Smooth depth; nearer is lighter", "Depth", FALSE, TRUE },
  [CELD_PICTURE_NORMALS]  = { "normals", "normals", "_Normal map",
                              "Which way the rounded parts face, for lighting elsewhere", "Normal map", FALSE, FALSE },
  [CELD_PICTURE_SHADING]  = { "shading", "shading", "S_hading", "The light alone, as greys", "Shading", FALSE, FALSE },
  [CELD_PICTURE_LIT]      = { "lit", "shaded", "_Lit drawing", "The drawing with light on rounded parts",
                              "Lit drawing", TRUE, TRUE },
  [CELD_PICTURE_ENHANCED] = { "enhanced", "enhanced", "Drawing with sha_dows",
                              "The drawing with soft shadows behind nearer parts", "Drawing with shadows", TRUE,
                              FALSE },
};

const CeldPicture celd_pictures_stacked[CELD_POPUP_PICTURES] = {
  CELD_PICTURE_ENHANCED, CELD_PICTURE_LIT, CELD_PICTURE_SHADING, CELD_PICTURE_NORMALS, CELD_PICTURE_DEPTH,
  CELD_PICTURE_LEVELS, CELD_PICTURE_REGIONS,
};

/* Matcaps need a picture, which these dialogs do not ask for. */
const CeldMainSetting celd_main_settings[CELD_N_MAIN_SETTINGS] = {
  { "light-model", CELD_MODEL_MATCAP }, { "light-azimuth", 0 }, { "light-elevation", 0 }, { "ambient", 0 },
  { "specular", 0 }, { "rim-light", 0 }, { "bulge", 0 }, { "shadow-strength", 0 }, { "shadow-size", 0 },
  { "ink", 0 }, { "close-gaps", 0 }, { "flats", 0 }, { "expansion", 0 }, { "suggest", 0 },
};
