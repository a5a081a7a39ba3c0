/* What every function takes: answers, progress, pictures, settings.
 *
 * Part of celdepth.h, which says what values and who owns what.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELDEPTH_VALUES_H
#define CELDEPTH_VALUES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined __GNUC__
#define CELD_API __attribute__ ((visibility ("default")))
#else
#define CELD_API
#endif

#define CELD_MAX_SIDE 20000 /* squared distances stay exact in int32_t up to here */

/* ------------------------------------------------------------------ answers, progress, threads */

typedef enum
{
  CELD_OK = 0,
  CELD_CANCELLED,         /* CeldHost.progress returned false */
  CELD_NO_MEMORY,         /* an allocation failed, or a size would overflow */
  CELD_BAD_SIZE,          /* a picture is empty, too large, or sizes differ */
  CELD_BAD_VALUE,         /* a setting is outside its range */
  CELD_BAD_RELATION,      /* relations text or path data cannot be read: see CeldTextError */
  CELD_NOTHING_TO_GO_BY   /* neither a scribble nor an arrow */
} CeldStatus;

/* One plain English sentence for a status; static storage. */
CELD_API const char *celd_status_text (CeldStatus status);

/* What the host lends to a long call: progress, a way to cancel, and threads.  NULL instead of a CeldHost, or NULL
 * members: no progress, not to be cancelled, one thread.  Results do not depend on `each`. */
typedef struct
{
  bool (*progress) (void *data, double done);      /* done in [0,1], never falling; false cancels */
  void (*each) (void *data, int n, void (*body) (void *body_data, int i), void *body_data); /* body for 0 .. n-1 in any
                                                                                             * order, all before it returns */
  void *data;                                      /* for the two functions */
} CeldHost;

/* ------------------------------------------------------------------ borrowed pictures; the stride counts pixels */

typedef struct { int width, height; size_t stride; float    *data; } CeldPlane;   /* one float a pixel */
typedef struct { int width, height; size_t stride; uint32_t *data; } CeldLabels;  /* one label or rank a pixel */
typedef struct { int width, height; size_t stride; uint8_t  *data; } CeldMask;    /* one byte a pixel, 0 = no */
typedef struct { int width, height; size_t stride; uint8_t  *data; } CeldPaint;   /* R'G'B'A, straight alpha */
typedef struct { int width, height; size_t stride; float    *data; } CeldVectors; /* x,y,z a pixel */
typedef struct { int width, height; size_t stride; float    *data; } CeldColours; /* R,G,B,A, straight alpha */

typedef struct { int x, y, width, height; } CeldRect;

/* A drawing: luma, and alpha where it has one (data NULL = opaque).  NaN reads as paper. */
typedef struct { CeldPlane luma, alpha; } CeldDrawing;

/* ------------------------------------------------------------------ settings; celd_settings () gives the defaults */

typedef enum { CELD_INK_AUTO, CELD_INK_DARK, CELD_INK_LIGHT, CELD_INK_ALPHA } CeldInkMode;
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
typedef enum { CELD_MESH_AUTO, CELD_MESH_SURFACE, CELD_MESH_SOLID } CeldMeshKind;
typedef enum { CELD_PATH_SWAY, CELD_PATH_CIRCLE, CELD_PATH_TURNTABLE } CeldPath;
typedef enum { CELD_FOR_SEGMENTATION, CELD_FOR_DEPTH } CeldPurpose;

typedef struct
{
  /* drawing */
  CeldInkMode ink;              /* what is ink */
  float       ink_threshold;    /* ink at or below this counts as fully inked, [0,0.99]; 0.25 */

  /* scribbles and segmentation */
  CeldMethod     method;        /* on the drawing's basins, by exact cuts of all pixels, or a random walker */
  bool           close_gaps;    /* basins: borders across paper run from line end to line end */
  bool           keep_necks;    /* basins: a part with strokes of one label alone keeps it, whatever a cut would save */
  float          hardness;      /* 0.01 soft (a majority of paint wins) .. 1 hard (every stroke is obeyed); 0.05 */
  bool           flats;         /* the scribbles are a flat colouring: every colour of it is a region */
  CeldBackground background;
  uint8_t        background_colour[3]; /* for CELD_BACKGROUND_COLOUR: the scribble colour that is background */
  CeldSeeds      seeds;         /* may an arrow make a region of its own? */
  CeldSameColour same_colour;   /* is a colour one node, or is each of its connected regions? */

  /* order */
  CeldSuggest    suggest;       /* suggestions join the artist's relations: none, where those leave a pair open, all */
  CeldOnCycle    on_cycle;      /* of relations that contradict: lighter and later ones give way one by one, or those
                                 * of the least weight in sum; or a session splits regions, and only what that cannot
                                 * resolve gives way, by weight in sum */
  CeldArrowStyle arrow_style;
  CeldEncoding   encoding;      /* how levels leave */
  float          near_level, far_level; /* for CELD_ENCODING_FIXED: these levels become 1 and 0 */

  /* whose the ink is */
  CeldExpansion  expansion;     /* outlines of one pen each, or the paper's thickness of contours */

  bool           complete;      /* layers: also what nearer ones hide; false */

  /* smooth depth */
  CeldAnchors anchors;          /* which pixels keep their level (the paper's U_o) */
  bool        hold_rest;        /* regions without such a pixel keep their level, too, in their core; true */
  float       tolerance;        /* largest error of smooth depth, as a share of its range, (0,0.1]; 1e-4 */

  /* exact depth, and the random walker */
  float contrast;               /* how large a step of the ink parts depths, as a factor of the mean, [0.01,100]; 1 */
  float weight_floor;           /* how strongly neighbours hold together at least, [1e-6,1]; 1e-6 */

  /* normals */
  float bulge;                  /* 0 flat .. 1 hemisphere .. 4 */
  float bevel;                  /* parts bend so far from their outlines, as a share of the diagonal, [0,0.5]; 0: they
                                 * are round all over */
  float quilt;                  /* how much both sides of a stroke inside a part bend, [0,1]; 0 */
  bool  frame_outline;          /* is the frame of the picture an outline, too? false */

  /* shading */
  CeldLightModel light_model;   /* how surfaces take light */
  CeldLight      light;
  float light_azimuth;          /* degrees, 0 = from the right, 90 = from above */
  float light_elevation;        /* degrees above the picture, 90 = from the viewer */
  float light_x, light_y;       /* of a point of light, in shares of the width and height, [-10,10]; 0.3, 0.2 */
  float light_height;           /* how far before the picture it is, as a share of the diagonal, (0,10]; 0.3 */
  float ambient;                /* share of light that reaches every pixel, [0,1] */
  int   toon_steps;             /* 2 .. 5; 3 */
  float specular;               /* how bright highlights are, [0,1]; 0 */
  float shininess;              /* how small they are, [1,1000]; 30 */
  float rim_light;              /* how bright rims are, [0,1]; 0 */
  float rim_power;              /* how narrow they are, [0.1,20]; 3 */

  /* depth enhancement */
  CeldEnhance enhance;          /* regions cast shadows on those behind them, or unsharp masking of depth, which darkens
                                 * what is behind a border, or also lightens what is before it */
  float shadow_size;            /* deviation of the blur as a share of the diagonal, [0.0005,0.2]; 0.012 */
  float shadow_strength;        /* 0 none .. 1 black; 0.6 */
  float shadow_offset;          /* stack: how far shadows lie from the light, as a share of the diagonal, [0,0.2]; 0 */
  float shadow_range;           /* stack: from this difference on a shadow is full, as a share of all depth, [0,1]; 0 */

  /* stereo */
  float disparity;              /* between depth 1 and 0, of both eyes, as a share of the width, [0,0.2]; 0.02 */
  CeldStereo stereo;            /* how two views come in one picture; side by side */
  float convergence;            /* which depth lies on the screen, from 0 farthest to 1 nearest; 0.5 */
  bool  floating_window;        /* bars at the sides bring the frame before what it cuts in front of the screen */
  float screen_width;           /* of the whole picture as it is shown, in mm, [0,1e6]; 0: not known */
  CeldPath path;                /* of the camera: from side to side, in a circle, or as if the drawing turned */

  /* relief, which also has the bulge */
  CeldReliefFrom relief_from;   /* parts bulge by inflation, or as their normals say */
  float relief_depth;           /* how far the nearest part stands before the farthest, as a share of the diagonal,
                                 * [0,1]; 0.1 */

  /* mesh */
  CeldMeshKind mesh;            /* a surface with cracks (so is automatic in core), or a closed body on a plate */
  float mesh_size;              /* of the picture's longer side, in millimetres, [1,10000]; 100 */
  float mesh_plate;             /* thickness of the plate, in millimetres, [0.1,1000]; 2 */
  float mesh_error;             /* how far the mesh may be from the surface, in pixels, [0.01,100]; 0.5 */
  float most_vertices;          /* at most; else the error grows; [1000,16000000]; 1000000 */
} CeldSettings;

CELD_API CeldSettings celd_settings (void);
/* CELD_BAD_VALUE if a member is outside its range (NaN included). */
CELD_API CeldStatus celd_settings_check (const CeldSettings *settings);

#ifdef __cplusplus
}
#endif

#endif
