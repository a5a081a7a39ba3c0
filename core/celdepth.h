/* celdepth - depth for hand-drawn cartoons from scribbles and arrows.
 *
 * The method is D. Sykora et al., "Adding Depth to Cartoons Using Sparse Depth (In)equalities",
 * Eurographics 2010 ("the paper").  C11 and libm, no global state, no printing, no threads of its own.
 *
 * What to read first: CeldSession (the whole route, kept between edits), then the steps in the order of the route,
 * then the records that travel between them.
 *
 * Values that every function keeps:
 *   pixels    x to the right, y down; pixel (x,y) covers [x,x+1) x [y,y+1); sizes 1 .. CELD_MAX_SIDE
 *   luma      Y' of sRGB in [0,1]: encoded values, not linear light
 *   ink       line art after contrast normalisation: 0 = ink, 1 = paper, antialiased between
 *   labels    1 .. n, index + 1 into a CeldPalette; 0 = none
 *   levels    0 = farthest, larger = nearer
 *   depth     in the unit of the levels that it was made from, larger = nearer
 *   normals   x right, y UP, z to the viewer, unit length
 *
 * Ownership: views are borrowed, never kept beyond the call; records (palette, relations, ...) own their items, start
 * as all zero and end with their _clear function, which accepts a zeroed record.  A function that does not return
 * CELD_OK leaves its results as they were, unless it says otherwise.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELDEPTH_H
#define CELDEPTH_H

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
  CELD_CANCELLED,         /* CeldRun.progress returned false */
  CELD_NO_MEMORY,         /* an allocation failed, or a size would overflow */
  CELD_BAD_SIZE,          /* a picture is empty, too large, or sizes differ */
  CELD_BAD_VALUE,         /* a setting is outside its range */
  CELD_BAD_RELATION,      /* relations text or path data cannot be read: see CeldTextError */
  CELD_NOTHING_TO_GO_BY   /* neither a scribble nor an arrow */
} CeldStatus;

/* One plain English sentence for a status; static storage. */
CELD_API const char *celd_status_text (CeldStatus status);

/* What the host lends to a long call.  NULL instead of a CeldRun, or NULL members: quiet, serial, not to be cancelled.
 * Results do not depend on `each`. */
typedef struct
{
  bool (*progress) (void *host, double done);      /* done in [0,1], never falling; false cancels */
  void (*each) (void *host, int n, void (*body) (void *data, int i), void *data); /* body for 0 .. n-1 in any order; all
                                                                                  * are done when it returns */
  void *host;
} CeldRun;

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

/* ------------------------------------------------------------------ records between the steps */

typedef enum { CELD_FROM_SCRIBBLE, CELD_FROM_ARROW, CELD_FROM_BACKGROUND } CeldOrigin;

/* One label and what is known of it. */
typedef struct
{
  uint8_t    colour[4];         /* R'G'B'A of its scribbles; alpha 0 only for the background that celdepth added */
  CeldOrigin origin;
  bool       background;        /* weakly behind every other label */
  bool       hard;              /* its seeds are obeyed whatever the hardness (seeds of arrows) */
  int        x, y;              /* a pixel of it, well inside */
  size_t     seeds;             /* painted pixels */
  size_t     area;              /* pixels after segmentation */
} CeldRegion;

typedef struct { CeldRegion *item; size_t n; } CeldPalette;

CELD_API void celd_palette_clear (CeldPalette *palette);

/* One end of a relation: a point of the drawing, or every region of a colour. */
typedef struct { bool by_colour; uint8_t colour[3]; double x, y; } CeldTerm;

typedef enum { CELD_SOURCE_TEXT, CELD_SOURCE_ARROW, CELD_SOURCE_PATH, CELD_SOURCE_SUGGESTION } CeldSource;

/* `nearer` is in front of `farther`; or both have the same depth. */
typedef struct
{
  CeldTerm   nearer, farther;
  bool       equal;
  bool       crack;             /* registration may tear here (the paper's blue arrows) */
  bool       anchor;            /* both ends keep their level in smooth depth */
  double     weight;            /* > 0; in a contradiction the lighter relation gives way; 1 */
  double     gap;               /* least gap in levels, > 0; 1 */
  CeldSource source;
  int        line, column;      /* where it stands in the text or path, from 1; 0 for others */
  uint32_t   id;                /* the host's name for it; 0 unless set through a session */
} CeldRelation;

typedef struct { CeldRelation *item; size_t n; } CeldRelations;

CELD_API void celd_relations_clear (CeldRelations *relations);

/* Where relations text or path data could not be read. */
typedef struct { int line, column; char expected[48]; char found[24]; } CeldTextError;

/* Something the artist should know; none of these stops the work. */
typedef enum
{
  CELD_PROBLEM_STROKE_OVERRULED,   /* most of a colour's stroke at (x,y) went to region `other` */
  CELD_PROBLEM_REGION_UNREACHED,   /* no stroke reaches the closed region round (x,y) */
  CELD_PROBLEM_COLOUR_LOST,        /* a colour has no pixel left after segmentation */
  CELD_PROBLEM_ARROW_UNCLEAR,      /* the arrow at (x,y) does not say which end is nearer; left out */
  CELD_PROBLEM_OUTSIDE,            /* relation `relation` names a point outside the drawing; left out */
  CELD_PROBLEM_UNKNOWN_COLOUR,     /* relation `relation` names a colour that is no label; left out */
  CELD_PROBLEM_SAME_REGION,        /* both ends of relation `relation` lie in one region; left out */
  CELD_PROBLEM_CONTRADICTION,      /* relation `relation` contradicts the others of cycle `other`; left out */
  CELD_PROBLEM_NOT_CONVERGED,      /* smooth depth was delivered with a larger error than asked for */
  CELD_PROBLEM_REGION_SPLIT        /* label `other`, round (x,y), was split off `label` to resolve a contradiction */
} CeldProblemKind;

#define CELD_NO_INDEX SIZE_MAX

typedef struct
{
  CeldProblemKind kind;
  int             x, y;            /* where to look; -1 if nowhere */
  uint32_t        label, other;    /* labels concerned; 0 if none */
  size_t          relation;        /* index into the relations; CELD_NO_INDEX if none */
} CeldProblem;

typedef struct { CeldProblem *item; size_t n; } CeldProblems;

CELD_API void celd_problems_clear (CeldProblems *problems);

/* Marks the places of problems over whatever is in the picture: a red ring round each, with a dot at the place. */
CELD_API void celd_problems_paint (const CeldProblems *problems, CeldPaint *paint);

/* One English sentence, cut to `size` bytes with its final 0, saying what, where and what to do.
 * palette and relations may be NULL: then without colours and line numbers. */
CELD_API void celd_problem_text (const CeldProblem *problem, const CeldPalette *palette, const CeldRelations *relations,
                                 char *text, size_t size);

/* Relations that cannot hold together: item[0..n-1] are indices into the relations, in the order of the cycle
 * (each one's farther region is the next one's nearer region, the last leads back to the first). */
typedef struct
{
  size_t  *item;
  size_t   n;
  size_t   knot;                /* of CeldOrder */
  uint32_t label;               /* whose connected regions it takes to have one depth: without that, as with
                                 * same_colour = separate, there would be no such cycle; 0: none */
  uint8_t  colour[3];           /* of that label */
  int      x[2], y[2];          /* one place in each of two such regions */
} CeldCycle;

/* All relations that go round in circles with each other: those of a strongly connected component of regions, in the
 * order given; and a shortest cycle through the newest of them that is on one. */
typedef struct { size_t *item; size_t n; CeldCycle newest; } CeldKnot;

typedef struct
{
  uint32_t  *level;             /* of label k: level[k-1]; 0 = farthest */
  size_t     n;                 /* labels */
  uint32_t   levels;            /* one more than the largest level */
  double    *height;            /* of each level, in gaps of one relation; NULL where that is the level itself */
  CeldCycle *cycle;             /* contradictions; the first item of each is the relation that was left out */
  size_t     n_cycles;
  CeldKnot  *knot;
  size_t     n_knots;
} CeldOrder;

CELD_API void celd_order_clear (CeldOrder *order);

/* One English sentence that names the partners of the relation which a contradiction left out, cut to `size` bytes. */
CELD_API void celd_cycle_text (const CeldCycle *cycle, const CeldRelations *relations, char *text, size_t size);

/* A gap in a contour as the segmentation closed it: a line from one line's end to another's, between two labels. */
typedef struct { double x, y; } CeldPlace;
typedef struct { CeldPlace *place; size_t n; uint32_t label, other; } CeldClosure;
typedef struct { CeldClosure *item; size_t n; } CeldClosures;

CELD_API void celd_closures_clear (CeldClosures *closures);

/* How well an iterative solve went. */
typedef struct { bool converged; int iterations; double error; } CeldSolve; /* error: as a share of the range */

/* A node of the exact program: a scribble, or an end of a relation off every scribble. */
typedef struct
{
  uint32_t label;               /* of the scribble; 0 for the end of a relation */
  int      x, y;                /* a pixel of it; -1,-1 if other paint hides it all */
  double   depth;               /* in gaps of one relation; the least of all nodes is 0 */
} CeldNode;

/* What the exact program says beside the depth. */
typedef struct
{
  CeldNode  *node;
  size_t     n;
  double     sigma;             /* of eq. (1) */
  double     energy;            /* 1/2 d'Ld of eq. (2), where the depths of nodes have least gaps of 1 */
  double     gap;               /* how far that is above the least at most, for the bases as they were solved */
  double     violation;         /* how much the worst inequality misses; 0 if all hold */
  size_t     inequalities;      /* between nodes */
  size_t     active;            /* that hold with equality and push */
  int        steps;             /* of the active set */
  CeldSolve  solve;             /* of the harmonic bases */
  CeldCycle *cycle;             /* contradictions between nodes, as in CeldOrder */
  size_t     n_cycles;
  CeldKnot  *knot;
  size_t     n_knots;
} CeldExact;

CELD_API void celd_exact_clear (CeldExact *exact);

/* Whose each pixel is, with its ink.  The host gives three pictures of the drawing's size. */
typedef struct
{
  CeldLabels owner;             /* the label whose area or ink the pixel is; where it has parts of two labels, as at an
                                 * antialiased edge, the nearer one (of equal levels either) */
  CeldLabels under;             /* the other one, which is seen beside the owner; = owner where there is but one */
  CeldPlane  share;             /* how much of the pixel the owner covers, above 0; 1 where there is but one.
                                 * Ink in the pixel is the owner's or, where that has none, under's. */
} CeldOwnership;

/* A drawing cut into layers, one a region.  Layer 0 is the farthest; each over those before it, by the common `over`
 * on straight alpha, they are the drawing again. */
typedef struct CeldLayers CeldLayers;

typedef struct
{
  uint32_t label;
  uint32_t level;
  CeldRect box;                 /* outside it the layer is transparent; width 0: everywhere */
} CeldLayer;

/* What layers will be stored in, which counts for their composite. */
typedef enum
{
  CELD_STORE_FLOAT,
  CELD_STORE_8_BIT,             /* 255ths */
  CELD_STORE_8_BIT_SRGB         /* linear light, as 255ths of its encoding as sRGB */
} CeldStore;

CELD_API size_t           celd_layers_count (const CeldLayers *layers);
CELD_API const CeldLayer *celd_layers_item  (const CeldLayers *layers, size_t layer);
/* The layer's box as r,g,b,a with straight alpha: 4 x width x height numbers. */
CELD_API void             celd_layers_paint (const CeldLayers *layers, size_t layer, float *rgba);
CELD_API void             celd_layers_free  (CeldLayers *layers);            /* accepts NULL */

/* ------------------------------------------------------------------ the steps, in the order of the route */

/* Luma, and alpha if it is not NULL, of n pixels R'G'B'A with the values of sRGB: a drawing as every host reads it. */
CELD_API void celd_luma (const float *rgba, size_t n, float *luma, float *alpha);

/* Line art of a drawing: composited on paper, polarity resolved, contrast normalised against the paper around
 * (uneven paper and grey pencil become ink 0 and paper 1).  `ink` may not alias the drawing. */
CELD_API CeldStatus celd_ink (const CeldDrawing *drawing, CeldInkMode mode, const CeldRun *run, CeldPlane *ink);

/* Virtual contours (section 4): red strokes become ink, blue strokes ink for segmentation only, green strokes paper;
 * for `purpose`.  Works on the drawing before celd_ink, keeps its polarity and alpha; `out` may alias the drawing.
 * Where the drawing has no alpha, out->alpha is not touched. */
CELD_API CeldStatus celd_contours_bake (const CeldDrawing *drawing, const CeldPaint *contours, CeldPurpose purpose,
                                        CeldInkMode mode, const CeldRun *run, CeldDrawing *out);

/* Scribbles as an artist paints them -> seed labels (0 where nothing is painted) and the palette of their colours,
 * origin CELD_FROM_SCRIBBLE, by falling painted area.  Alpha below one half is none; in a picture without alpha the
 * commonest colour is none (not with settings->flats); mixed colours of fringes are no label.
 * No paint at all is CELD_OK with an empty palette. */
CELD_API CeldStatus celd_scribbles_read (const CeldPaint *scribbles, const CeldSettings *settings, const CeldRun *run,
                                         CeldLabels *seeds, CeldPalette *palette);

/* Reads the relations grammar of docs/relations.md and appends to `relations`; on CELD_BAD_RELATION nothing is added,
 * and *error (may be NULL) says where.  Locale-independent. */
CELD_API CeldStatus celd_relations_parse (const char *text, CeldRelations *relations, CeldTextError *error);

/* Arrows as SVG path data (docs/relations.md): each sub-path becomes one relation from its first to its last point,
 * appended; errors as above. */
CELD_API CeldStatus celd_arrow_path_parse (const char *path, CeldRelations *relations, CeldTextError *error);

/* Painted arrows: each connected stroke becomes one relation, appended; unclear ones become problems. */
CELD_API CeldStatus celd_arrows_read (const CeldPaint *arrows, CeldArrowStyle style, const CeldRun *run,
                                      CeldRelations *relations, CeldProblems *problems);

/* LazyBrush [SDC09b] (section 3.2): every pixel gets a label.  In: seed labels and their palette (both may be empty if
 * arrows make regions).  Out: labels; `palette` is replaced by one that has the regions that arrows made and the
 * background behind those given, with area, x, y filled in; `problems` are appended.  `labels` may alias `seeds`;
 * `relations` and `problems` may be NULL.
 * CELD_NOTHING_TO_GO_BY if there is neither a seed nor a relation to seed from. */
CELD_API CeldStatus celd_segment (const CeldPlane *ink, const CeldLabels *seeds, const CeldRelations *relations,
                                  const CeldSettings *settings, const CeldRun *run,
                                  CeldLabels *labels, CeldPalette *palette, CeldProblems *problems);

/* Draws the closures over whatever is in the picture: an opaque line about as wide as `width`, antialiased, in red. */
CELD_API void celd_closures_paint (const CeldClosures *closures, double width, CeldPaint *paint);

/* Makes each connected region of a label a label of its own, in place (same_colour = separate).  Specks smaller than
 * 16 pixels stay with the largest region of their colour. */
CELD_API CeldStatus celd_separate (const CeldRun *run, CeldLabels *labels, CeldPalette *palette);

/* Labels as colours, and back.  Reading: every distinct opaque colour is a label, in the order of falling area;
 * transparent pixels are the background that celdepth added. */
CELD_API CeldStatus celd_labels_paint (const CeldLabels *labels, const CeldPalette *palette, CeldPaint *paint);
CELD_API CeldStatus celd_labels_read (const CeldPaint *paint, CeldLabels *labels, CeldPalette *palette);

/* The scribble, if any, whose label owns most paper along the frame is the background (settings->background), marked in
 * the palette.  For label pictures read back by celd_labels_read; ink may be NULL. */
CELD_API CeldStatus celd_background_mark (const CeldLabels *labels, const CeldPlane *ink, const CeldSettings *settings,
                                          CeldPalette *palette);

/* Which of two regions that touch is in front, as far as the drawing tells: one relation a pair, appended, from a point
 * inside the nearer to one inside the farther, source CELD_SOURCE_SUGGESTION, its weight the confidence in (0,1): 0 =
 * as good as a guess, 1/2 = three times as likely as not.  Suggestions do not contradict each other: the weakest of a
 * cycle is not made.  `palette` has the areas and the background of the labels; ink may be NULL. */
CELD_API CeldStatus celd_suggest (const CeldLabels *labels, const CeldPalette *palette, const CeldPlane *ink,
                                  const CeldRun *run, CeldRelations *suggested);

/* The same from a picture of depth, such as a depth estimator makes, in any unit, larger = nearer; not a number is
 * unknown.  The confidence compares the difference of two regions' medians with the spread inside them. */
CELD_API CeldStatus celd_suggest_from_depth (const CeldLabels *labels, const CeldPalette *palette, const CeldPlane *ink,
                                             const CeldPlane *depth, const CeldRun *run, CeldRelations *suggested);

/* The artist's relations, and behind them in the list those suggestions that do not contradict them (as far as
 * settings->on_cycle keeps them) or heavier suggestions; with settings->suggest = CELD_SUGGEST_FILL_GAPS only where the
 * artist's relations do not decide, directly or by way of others.  Suggestions get weights below all of the artist's.
 * Replaces `both`, which may be `relations`. */
CELD_API CeldStatus celd_suggestions_join (const CeldLabels *labels, const CeldPalette *palette,
                                           const CeldRelations *relations, const CeldRelations *suggested,
                                           const CeldSettings *settings, const CeldPlane *ink, const CeldRun *run,
                                           CeldRelations *both);

/* Paints relations between points as arrows of the default style over whatever is in the picture, lines about as wide
 * as `width`: a layer that celd_arrows_read reads.  Green ones weigh 1, orange ones little.  Relations that name
 * colours, and equalities, are no arrows; of arrows that would touch only the heaviest is painted. */
CELD_API CeldStatus celd_relations_paint (const CeldRelations *relations, double width,
                                          CeldPaint *paint);

/* Topological sort (appendix, [Kah62]) with longest-path levels over the regions that the relations' ends lie in.
 * `ink` may be NULL; with it a point on ink means the nearest region within one stroke width.  Relations that
 * contradict are reported as cycles and left out by settings->on_cycle, the rest is ordered.  No other member of the
 * settings counts; NULL: the defaults.  Where gaps are whole numbers, so are heights, which are levels then; else
 * levels number the heights that there are. */
CELD_API CeldStatus celd_order (const CeldLabels *labels, const CeldPalette *palette, const CeldRelations *relations,
                                const CeldPlane *ink, const CeldSettings *settings, const CeldRun *run,
                                CeldOrder *order, CeldProblems *problems);

/* Levels as they leave, as settings->encoding says: a level's height in gaps of one relation, of `levels` in all (one
 * more than the largest height); and a level of an order. */
CELD_API float celd_encode_level (double level, double levels, const CeldSettings *settings);
CELD_API float celd_order_value (const CeldOrder *order, uint32_t level, const CeldSettings *settings);

/* Whose each pixel is, with its ink: paper is its label's, ink goes to the region that drew it.  Labels are 1 .. n,
 * level[k - 1] is that of label k.  `corrections` (NULL, or 0 where there is none) are strokes over ink: the piece of
 * line below each goes to its label.  With CELD_EXPANSION_OUTLINES each region has an outline of its own pen,
 * over what lies behind it; with CELD_EXPANSION_THICKNESS it is celd_expand.  `owner` may alias `labels`. */
CELD_API CeldStatus celd_own (const CeldPlane *ink, const CeldLabels *labels, const uint32_t *level, size_t n,
                              const CeldLabels *corrections, CeldExpansion method, const CeldRun *run,
                              CeldOwnership *ownership);

/* Strokes in the colours of regions, as corrections: opaque pixels are the label of their colour, the first of several;
 * 0 where nothing is painted, or a colour that no region has. */
CELD_API CeldStatus celd_corrections_read (const CeldPaint *paint, const CeldPalette *palette, CeldLabels *labels);

/* celd_own for levels before expansion, of any encoding, larger = nearer; not a number reads as 0.  Every level, or
 * with `regions` (may be NULL) every region of a level, is a label.  `corrections` (may be NULL) are labels of
 * `regions`; of a region with several levels they mean the level that has most of it.  CELD_BAD_VALUE for corrections
 * without regions.
 * `expanded` is the level that has more of each pixel and may alias `levels`. */
CELD_API CeldStatus celd_expand_levels (const CeldPlane *ink, const CeldPlane *levels, const CeldLabels *regions,
                                        const CeldLabels *corrections, CeldExpansion method, const CeldRun *run,
                                        CeldPlane *expanded);

/* The same as a matte: of each pixel's owner its level, its region (`region` may be NULL; 0 without regions) and how
 * much of the pixel it covers, above 0 (CeldOwnership).  `level` may alias `levels`, `region` may alias `regions`. */
CELD_API CeldStatus celd_matte_of_levels (const CeldPlane *ink, const CeldPlane *levels, const CeldLabels *regions,
                                          const CeldLabels *corrections, CeldExpansion method, const CeldRun *run,
                                          CeldPlane *level, CeldLabels *region, CeldPlane *share);

/* Depth expansion by the thickness of contours (section 3.3).  `ranks` may have any values, larger = nearer; `expanded`
 * holds the same values and may alias `ranks`. */
CELD_API CeldStatus celd_expand (const CeldPlane *ink, const CeldLabels *ranks, const CeldRun *run,
                                 CeldLabels *expanded);

/* Cuts the art, the drawing itself or colours for it, into one layer for each label that has pixels, in the order of
 * level[label - 1], labels being 1 .. n; of equal levels later labels are in front.  At antialiased edges both layers
 * get a share of the pixel, in colours of their own.
 * `art` is in [0,1] and in whatever the layers are to be composited in, encoded colours or linear light.  All numbers
 * are such as `store` has; in 8 bits the composite is right to one step.
 * `complete` adds what nearer layers hide: outlines run on smoothly, with the region's own line along them, holes are
 * closed, and of the label `background` (0: none) everything is there; never where it could be seen.
 * `ink` is the drawing's, for depth.  CELD_NOTHING_TO_GO_BY if n is 0, CELD_BAD_VALUE for labels beyond n. */
CELD_API CeldStatus celd_layers_cut (const CeldPlane *ink, const CeldOwnership *ownership, const uint32_t *level,
                                     size_t n, const CeldColours *art, uint32_t background, CeldStore store, bool complete,
                                     const CeldRun *run, CeldLayers **layers);

/* The same from levels before expansion, with the labels of celd_expand_levels: a layer's is its number from the
 * farthest, from 1.  The background is the farthest label if it has most of the frame. */
CELD_API CeldStatus celd_layers_of_levels (const CeldPlane *ink, const CeldPlane *levels, const CeldLabels *regions,
                                           const CeldLabels *corrections, const CeldColours *art,
                                           CeldExpansion method, CeldStore store, bool complete, const CeldRun *run,
                                           CeldLayers **layers);

/* Smooth depth, eq. (3).  Levels, expanded or not; `anchors` keep their level, with hold_rest (or NULL) the inner core
 * of each region without one, too; an edge is cut where levels differ and the least ink within half a stroke of its two
 * pixels is at or below ink_threshold, so virtual borders stay smooth; components without an anchor keep their level.
 * A result that misses the tolerance is delivered; *solve (may be NULL) says so.  `depth` may alias `levels`. */
CELD_API CeldStatus celd_smooth (const CeldPlane *ink, const CeldPlane *levels, const CeldMask *anchors,
                                 const CeldSettings *settings, const CeldRun *run, CeldPlane *depth, CeldSolve *solve);

/* The exact program, eq. (1) and (2): of all depths that keep the relations the one of least energy
 * sum w_pq (d_p - d_q)^2 with w_pq = max (weight_floor, exp (-(I_p - I_q)^2 / sigma)).  I_p - I_q is the
 * contrast in the 3 x 3 pixels round p or q, whichever is less, sigma is contrast times the mean of (I_p - I_q)^2;
 * `ink` is that for depth.
 * Each scribble moves as one (with same_colour = separate each of its strokes); an end of a relation off every scribble
 * is a pixel of its own, so that regions bend where relations go round in a circle between different points of them.
 * Equalities are exact, gaps may be fractions; a circle between the same nodes is reported, and its lightest and then
 * latest relation left out.  Scribbles that the palette marks as background lie behind every other scribble unless
 * relations say otherwise.
 * `depth` leaves as settings->encoding says; with CELD_ENCODING_RANK in gaps of one relation, least 0.  `problems` are
 * appended, *exact is replaced; these two and the relations may be NULL.  CELD_NOTHING_TO_GO_BY without seeds and
 * relations. */
CELD_API CeldStatus celd_depth_exact (const CeldPlane *ink, const CeldLabels *seeds, const CeldPalette *palette,
                                      const CeldRelations *relations, const CeldSettings *settings,
                                      const CeldRun *run, CeldPlane *depth, CeldExact *exact,
                                      CeldProblems *problems);

/* Lumo normals [Joh02] (section 5), over/under aware: at a depth discontinuity only the nearer side bends; a region
 * without an outline of its own, like the paper, faces the viewer.  `levels` are expanded. */
CELD_API CeldStatus celd_normals (const CeldPlane *ink, const CeldPlane *levels, const CeldSettings *settings,
                                  const CeldRun *run, CeldVectors *normals);

/* The same with what an artist adds; NULL: nothing.  Of a stroke inside a part the side that `depth` has higher bends,
 * if settings->quilt lets strokes bend at all; of strokes and outlines that paint in `hints` lies beside, white bends
 * its side, black does not, grey bends both. */
CELD_API CeldStatus celd_normals_hinted (const CeldPlane *ink, const CeldPlane *levels, const CeldPlane *depth,
                                         const CeldPaint *hints, const CeldSettings *settings, const CeldRun *run,
                                         CeldVectors *normals);

/* Light on normals by the settings, linear: `tone`, by which art is multiplied, and how much of what is then missing to
 * white the `gloss` of highlights and rims adds; what is `ink` (may be NULL) does not shine.  `matcap` is the picture
 * of a lit ball that fills it, of any size, and is needed by CELD_MODEL_MATCAP alone, which is CELD_BAD_VALUE
 * without. */
CELD_API CeldStatus celd_light (const CeldVectors *normals, const CeldPlane *ink, const CeldColours *matcap,
                                const CeldSettings *settings, const CeldRun *run, CeldColours *tone,
                                CeldPlane *gloss);
/* Such light on art; and the gloss as a white layer to put over the art multiplied by the tone. */
CELD_API CeldStatus celd_light_colours (const CeldColours *tone, const CeldPlane *gloss, CeldColours *colours);
CELD_API CeldStatus celd_light_layer   (const CeldPlane *gloss, CeldColours *layer);

/* The same light on white art without ink, in [0,1].  CELD_BAD_VALUE for CELD_MODEL_MATCAP. */
CELD_API CeldStatus celd_shade (const CeldVectors *normals, const CeldSettings *settings, CeldPlane *shading);

/* Under transparency, as far as `reach` pixels from what is opaque by half at least, the colour of the nearest such
 * pixel; farther away `blank` where the picture has no alpha at all.  Alpha stays: a game engine that blends
 * neighbours then finds no seam. */
CELD_API CeldStatus celd_pad_colours (int reach, const float blank[3], const CeldRun *run, CeldColours *picture);

/* Depth enhancement (section 5, Figures 1d and 5c): the share of light that is taken from the art, or added, from -1
 * (black) over 0 (nothing) to 1 (twice as bright), linear.  `levels` are expanded; for the stack at most 256 of them are
 * told apart.  Not a number reads as 0.  CELD_BAD_VALUE for bad settings. */
CELD_API CeldStatus celd_enhance (const CeldPlane *levels, const CeldSettings *settings, const CeldRun *run,
                                  CeldPlane *change);
/* Ambient occlusion: the share of light that the stack leaves, from 1 (all) down to 1 - shadow_strength, without an
 * offset whatever the settings say. */
CELD_API CeldStatus celd_occlusion (const CeldPlane *levels, const CeldSettings *settings, const CeldRun *run,
                                    CeldPlane *occlusion);
/* Such a change applied to art; what it takes, as a black layer to put over the art; and applied to a grey picture of
 * the levels, the nearest white: what an artist sees of depth while drawing (Figure 5c).  Linear light. */
CELD_API CeldStatus celd_enhance_colours (const CeldPlane *change, CeldColours *colours);
CELD_API CeldStatus celd_enhance_layer   (const CeldPlane *change, CeldColours *layer);
CELD_API CeldStatus celd_enhance_view    (const CeldPlane *levels, const CeldPlane *change, CeldPlane *view);

/* A drawing that can be seen from the side (section 5, Figure 1g).  Nothing that it was made from is kept. */
typedef struct CeldScene CeldScene;

/* Of layers, each of which moves by its own depth, which goes on where it is hidden: completed ones leave no holes.
 * `ownership` is what they were cut by.  Views are in the colours that the layers were cut in. */
CELD_API CeldStatus celd_scene_of_layers (const CeldLayers *layers, const CeldOwnership *ownership,
                                          const CeldPlane *depth, const CeldRun *run, CeldScene **scene);
/* The same from levels, expanded or not, each of which becomes a completed layer. */
CELD_API CeldStatus celd_scene_of_levels (const CeldPlane *ink, const CeldPlane *levels, const CeldPlane *depth,
                                          const CeldColours *art, CeldExpansion method, const CeldRun *run,
                                          CeldScene **scene);
/* Of depth alone, from wherever: what comes into sight is filled from its farther side, in the colour of the paper
 * there, without its ink.  For views from the sides, no further than settings->disparity. */
CELD_API CeldStatus celd_scene_of_depth (const CeldColours *art, const CeldPlane *ink, const CeldPlane *depth,
                                         const CeldSettings *settings, const CeldRun *run, CeldScene **scene);
CELD_API void       celd_scene_free     (CeldScene *scene);      /* accepts NULL */

/* Where it is seen from: x -1 the left eye, 1 the right one; y -1 as far above, 1 below; 0,0 the drawing as it is.
 * `squeeze` is how wide the picture looks, (0,1]: less than 1 when it is turned. */
typedef struct { double x, y, squeeze; } CeldCamera;
CELD_API CeldCamera celd_camera_eye (double eye);
/* `frame` of `frames` of a path that ends where it begins. */
CELD_API CeldCamera celd_camera_on_path (CeldPath path, int frame, int frames);

/* A point of depth d moves by disparity / 2 of the width times d's distance from the screen, away from the camera. */
CELD_API CeldStatus celd_scene_view (const CeldScene *scene, CeldCamera camera, const CeldSettings *settings,
                                     const CeldRun *run, CeldColours *view);

/* How strong that will be for two eyes: disparities in front of and behind the screen, in shares of the width; whether
 * something in front of the screen is cut by the frame at the left or right, which the eyes cannot put together; and
 * whether on a screen of settings->screen_width the eyes would have to look apart. */
typedef struct { double front, behind; bool cut_left, cut_right, diverges; } CeldComfort;
#define CELD_STEREO_COMFORT (1.0 / 30) /* of the width: more disparity from front to back strains the eyes */
#define CELD_EYE_DISTANCE   65.0       /* mm: more behind the screen, and the eyes look apart */
CELD_API CeldStatus celd_stereo_comfort (const CeldPlane *depth, const CeldSettings *settings, CeldComfort *comfort);
/* What strains the eyes, in English sentences that say what to do, one a line, cut to `size` bytes; "" if nothing. */
CELD_API void       celd_comfort_text   (const CeldComfort *comfort, const CeldSettings *settings, char *text,
                                         size_t size);
/* Black bars at the left of the left view and the right of the right one, as wide as it takes to bring the frame before
 * what it cuts: a floating window.  Nothing where nothing is cut. */
CELD_API CeldStatus celd_stereo_window (const CeldPlane *depth, const CeldSettings *settings, CeldColours *left,
                                        CeldColours *right);
/* Two views in one picture, whose size celd_stereo_size tells from theirs; anaglyphs for red glasses on the left and
 * cyan ones on the right, in linear light. */
CELD_API void       celd_stereo_size (CeldStereo format, int *width, int *height);
CELD_API CeldStatus celd_stereo_join (const CeldColours *left, const CeldColours *right, CeldStereo format,
                                      CeldColours *joined);

/* A surface over the picture, in pixels; larger = nearer, depth 0 is at 0. */
#define CELD_CUT_RIGHT  1
#define CELD_CUT_BELOW  2
#define CELD_NEAR_RIGHT 4
#define CELD_NEAR_BELOW 8
typedef struct
{
  int      width, height;
  float   *z;                   /* of each pixel */
  float   *outline;             /* and where the surface would end in front of something behind it */
  uint8_t *cut;                 /* of each pixel, towards which neighbours the surface does not go on, and which of them
                                 * it is in front of */
} CeldRelief;

/* Each part as round as the bulge says, as far in front as its depth says, and farther where it would run through
 * something behind it; cut only where depth is.  `depth` is smooth; NULL: celd_smooth makes it.  Replaces `relief`. */
CELD_API CeldStatus celd_relief (const CeldPlane *ink, const CeldPlane *levels, const CeldPlane *depth,
                                 const CeldSettings *settings, const CeldRun *run, CeldRelief *relief);
CELD_API void       celd_relief_clear (CeldRelief *relief);   /* accepts a zeroed one */

/* Triangles over the picture, which has its middle at x = y = 0, and depth 0 at z = 0. */
typedef struct
{
  size_t    vertices, triangles;
  float    *place;              /* of each vertex x, y, z: to the right, up, to the viewer, in millimetres */
  float    *normal;             /* as many, unit length */
  float    *art;                /* where it is in the picture: 0 .. 1 to the right and down */
  uint32_t *corner;             /* three vertices of each triangle, counter-clockwise seen from outside */
  double    error;              /* how far it is from the surface at most, in pixels */
} CeldReliefMesh;

/* CELD_BAD_VALUE also if settings->most_vertices are too few for the borders alone.  Replaces `mesh`. */
CELD_API CeldStatus celd_relief_mesh (const CeldRelief *relief, const CeldSettings *settings, const CeldRun *run,
                               CeldReliefMesh *mesh);
CELD_API void       celd_relief_mesh_clear (CeldReliefMesh *mesh);         /* accepts a zeroed one */

/* ------------------------------------------------------------------ the session: the route, kept between edits */

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
CELD_API CeldStatus celd_session_ink (CeldSession *session, const CeldRun *run, CeldPlane *ink, CeldRect *changed);
CELD_API CeldStatus celd_session_labels (CeldSession *session, const CeldRun *run, CeldLabels *labels,
                                         CeldRect *changed);
/* The gaps that these labels close; none with other methods than CELD_METHOD_BASINS. */
CELD_API CeldStatus celd_session_closures (CeldSession *session, const CeldRun *run, const CeldClosures **closures);
/* The same as red lines about as wide as the drawing's, on a transparent picture: a layer of virtual contours, in which
 * the artist may erase what was closed wrongly. */
CELD_API CeldStatus celd_session_paint_closures (CeldSession *session, const CeldRun *run, CeldPaint *paint);
/* What celd_suggest says of these labels, whether the settings apply it or not. */
CELD_API CeldStatus celd_session_suggestions (CeldSession *session, const CeldRun *run,
                                              const CeldRelations **suggested);
/* The same as arrows on a transparent picture: an arrows layer, in which the artist may erase what is wrong. */
CELD_API CeldStatus celd_session_paint_suggestions (CeldSession *session, const CeldRun *run, CeldPaint *paint);
CELD_API CeldStatus celd_session_order (CeldSession *session, const CeldRun *run, const CeldOrder **order);
CELD_API CeldStatus celd_session_flat (CeldSession *session, const CeldRun *run, CeldPlane *levels, CeldRect *changed);
/* Whose the pixels are, with their ink, in the labels above.  Where a pixel has two labels, `levels` have the one that
 * covers more of it. */
CELD_API CeldStatus celd_session_ownership (CeldSession *session, const CeldRun *run, CeldOwnership *ownership,
                                            CeldRect *changed);
/* The art cut into a layer for each label, with settings.complete, see celd_layers_cut; the host's own, to be freed. */
CELD_API CeldStatus celd_session_layers (CeldSession *session, const CeldColours *art, CeldStore store,
                                         const CeldRun *run, CeldLayers **layers);
CELD_API CeldStatus celd_session_levels (CeldSession *session, const CeldRun *run, CeldPlane *levels,
                                         CeldRect *changed);
/* After an edit only what it touched is solved again, from where it was; the rest stays bit by bit.  The preview is for
 * the eye while the full depth is made: a quarter of the width and height, rounded up, pixel (x,y) for those from
 * (4x,4y) on; *changed counts its own pixels.  It needs no expansion, so that its borders lie in the middle of
 * contours, and has gaps narrower than about eight pixels closed. */
CELD_API CeldStatus celd_session_depth_preview (CeldSession *session, const CeldRun *run, CeldPlane *quarter,
                                                CeldRect *changed);
CELD_API CeldStatus celd_session_depth (CeldSession *session, const CeldRun *run, CeldPlane *depth, CeldRect *changed);
CELD_API CeldStatus celd_session_normals (CeldSession *session, const CeldRun *run, CeldVectors *normals,
                                          CeldRect *changed);
CELD_API CeldStatus celd_session_shading (CeldSession *session, const CeldRun *run, CeldPlane *shading,
                                          CeldRect *changed);

/* The exact program, see celd_depth_exact, with the background of the settings.  A new relation is answered in
 * milliseconds if its ends are scribbles or known ends of others.  The preview is for the eye while the first full
 * depth is made: a half of the width and height, rounded up, in about a quarter of the time. */
CELD_API CeldStatus celd_session_exact (CeldSession *session, const CeldRun *run, CeldPlane *depth, CeldRect *changed);
CELD_API CeldStatus celd_session_exact_preview (CeldSession *session, const CeldRun *run, CeldPlane *half);
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
