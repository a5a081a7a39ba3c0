/* The settings of all steps, and a table that describes them.
 *
 * Part of celdepth.h.  The table, core/base/settings-table.c, defines the range, default, choices, label and help of
 * each setting; the GEGL operations, the command and the reference (docs/settings.md) are made from it.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELDEPTH_SETTINGS_H
#define CELDEPTH_SETTINGS_H

#include "celdepth/values.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum { CELD_INK_AUTO, CELD_INK_DARK, CELD_INK_LIGHT, CELD_INK_ALPHA, CELD_INK_LINES } CeldInkMode;
typedef enum { CELD_METHOD_BASINS, CELD_METHOD_EXACT, CELD_METHOD_WALKER } CeldMethod;
typedef enum { CELD_BACKGROUND_AUTO, CELD_BACKGROUND_NONE, CELD_BACKGROUND_COLOUR } CeldBackground;
typedef enum { CELD_SEEDS_AUTO, CELD_SEEDS_SCRIBBLES } CeldSeeds;
typedef enum { CELD_SAME_COLOUR_ONE, CELD_SAME_COLOUR_SEPARATE } CeldSameColour;
typedef enum { CELD_ON_CYCLE_REPORT, CELD_ON_CYCLE_DROP_WEAKEST, CELD_ON_CYCLE_SPLIT } CeldOnCycle;
typedef enum { CELD_ARROW_HEAD, CELD_ARROW_DOT, CELD_ARROW_FADE, CELD_ARROW_TAPER } CeldArrowStyle;
typedef enum { CELD_ANCHORS_SCRIBBLES, CELD_ANCHORS_ARROWS, CELD_ANCHORS_BOTH, CELD_ANCHORS_CORE } CeldAnchors;
typedef enum { CELD_ENCODING_NORMALIZED, CELD_ENCODING_RANK, CELD_ENCODING_FIXED } CeldEncoding;
typedef enum { CELD_SUGGEST_OFF, CELD_SUGGEST_FILL_GAPS, CELD_SUGGEST_ALL } CeldSuggest;
typedef enum { CELD_EXPANSION_OUTLINES, CELD_EXPANSION_THICKNESS } CeldExpansion;
typedef enum { CELD_LIGHT_DIRECTION, CELD_LIGHT_POINT } CeldLight;
typedef enum { CELD_MODEL_LAMBERT, CELD_MODEL_HALF_LAMBERT, CELD_MODEL_TOON, CELD_MODEL_MATCAP } CeldLightModel;
typedef enum { CELD_ENHANCE_STACK, CELD_ENHANCE_DARKEN, CELD_ENHANCE_CONTRAST } CeldEnhance;
typedef enum
{
  CELD_STEREO_LEFT, CELD_STEREO_RIGHT, CELD_STEREO_SIDE_BY_SIDE, CELD_STEREO_HALF_SIDE_BY_SIDE, CELD_STEREO_CROSSED,
  CELD_STEREO_OVER_UNDER, CELD_STEREO_HALF_OVER_UNDER, CELD_STEREO_INTERLACED, CELD_STEREO_COLUMNS, CELD_STEREO_GREY,
  CELD_STEREO_COLOUR, CELD_STEREO_HALF_COLOUR, CELD_STEREO_DUBOIS
} CeldStereo;
typedef enum { CELD_RELIEF_INFLATION, CELD_RELIEF_NORMALS } CeldReliefFrom;
typedef enum { CELD_MESH_AUTO, CELD_MESH_SURFACE, CELD_MESH_SOLID, CELD_MESH_HEIGHTFIELD } CeldMeshKind;
typedef enum { CELD_PATH_SWAY, CELD_PATH_CIRCLE, CELD_PATH_TURNTABLE } CeldPath;

/* docs/settings.md explains each member, with its range and default, under its name with hyphens (ink-threshold). */
typedef struct
{
  /* drawing */
  CeldInkMode ink;
  float       ink_threshold;

  /* scribbles and segmentation */
  CeldMethod     method;
  bool           close_gaps, keep_necks;
  float          hardness;
  bool           flats;
  CeldBackground background;
  uint8_t        background_colour[3]; /* sRGB */
  CeldSeeds      seeds;
  CeldSameColour same_colour;

  /* order and levels */
  CeldSuggest    suggest;
  CeldOnCycle    on_cycle;
  CeldArrowStyle arrow_style;
  CeldEncoding   encoding;
  float          near_level, far_level;

  /* contour ownership, and layers */
  CeldExpansion expansion;
  bool          complete;
  float         margin;

  /* smooth depth */
  CeldAnchors anchors;                 /* the paper's U_o */
  bool        hold_rest, hold_gaps;
  float       tolerance;

  /* exact depth, and the random walker */
  float contrast, weight_floor;

  /* normals */
  float bulge, bevel, creases;
  bool  frame_outline;

  /* shading */
  CeldLightModel light_model;
  bool           light_background;
  CeldLight      light;
  float          light_azimuth, light_elevation;
  float          light_x, light_y, light_height;
  float          ambient;
  int            toon_steps;
  float          specular, shininess, rim_light, rim_power;

  /* depth enhancement */
  CeldEnhance enhance;
  float       shadow_size, shadow_strength, shadow_offset, shadow_range;

  /* stereo */
  float      disparity;
  CeldStereo stereo;
  float      convergence;
  bool       floating_window;
  float      screen_width;
  CeldPath   path;

  /* relief */
  CeldReliefFrom relief_from;
  float          relief_bulge, relief_depth;

  /* mesh */
  CeldMeshKind mesh_kind;
  float        mesh_size, mesh_plate, mesh_error, most_vertices;

  /* registration */
  int cell_size, stiffness;
} CeldSettings;

/* The defaults. */
CELD_API CeldSettings celd_settings (void);
/* CELD_BAD_VALUE if a member is outside its range (NaN included), or the near level of a fixed encoding is not above
 * the far level. */
CELD_API CeldStatus celd_settings_check (const CeldSettings *settings);

/* ------------------------------------------------------------------ the table */

typedef enum
{
  CELD_SETTING_NUMBER,          /* float */
  CELD_SETTING_INTEGER,         /* int */
  CELD_SETTING_SWITCH,          /* bool */
  CELD_SETTING_CHOICE,          /* an enumeration that counts from 0 */
  CELD_SETTING_COLOUR,          /* uint8_t[3], sRGB; as a number 0xRRGGBB */
  CELD_SETTING_TEXT             /* const char *; in tables of hosts only */
} CeldSettingType;

typedef struct { const char *nick, *label; } CeldSettingChoice;

typedef struct
{
  const char              *name;          /* of properties and options: "ink-threshold" */
  const char              *label;         /* in dialogs */
  const char              *help;          /* sentences, the last one without full stop; the first one is a summary */
  const char              *theme;         /* name of the theme that starts with this row; NULL: as the row before */
  CeldSettingType          type;
  size_t                   offset;        /* of the member in CeldSettings */
  double                   usual;         /* the default */
  double                   least, most;
  struct
  {
    double                 least, most;   /* of a slider */
    double                 step, page;    /* small and large */
    double                 gamma;         /* above 1: finer for small values; 0: even */
    int                    digits;        /* after the decimal point */
  } shown;
  const char              *unit;          /* "degree", "mm", "relative-coordinate"; NULL: none */
  const char              *axis;          /* along which it is measured: "x", "y", "ccw"; NULL: none */
  const char              *when;          /* "light {point}": used only with that choice; NULL: always */
  const char              *choice_type;   /* name of the enumeration */
  const CeldSettingChoice *choice;        /* by the enumeration's numbers */
  size_t                   choices;
  unsigned                 stages;        /* of a session that read it, as bits */
} CeldSettingInfo;

/* All rows, by theme; *n (may be NULL) is their number. */
CELD_API const CeldSettingInfo *celd_setting_infos (size_t *n);
/* The row of a name such as "ink-threshold"; NULL: there is none. */
CELD_API const CeldSettingInfo *celd_setting_find (const char *name);

/* Gets and sets a value as a number: a switch as 0 or 1, a choice as its enumeration, a colour as 0xRRGGBB.  `record`
 * is a CeldSettings, or the record that the offsets of a host's own rows refer to. */
CELD_API double celd_setting_get (const CeldSettingInfo *info, const void *record);
CELD_API void   celd_setting_set (const CeldSettingInfo *info, double value, void *record);
/* Whether the value is within the range of the setting; NaN is not. */
CELD_API bool   celd_setting_allows (const CeldSettingInfo *info, double value);

#ifdef __cplusplus
}
#endif

#endif
