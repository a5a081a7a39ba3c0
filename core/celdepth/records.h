/* Records that the steps take and make: palette, relations, problems, orders, reports, layers, meshes.
 *
 * Part of celdepth.h, which states the conventions of values, ownership and errors.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELDEPTH_RECORDS_H
#define CELDEPTH_RECORDS_H

#include "celdepth/settings.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum { CELD_FROM_SCRIBBLE, CELD_FROM_ARROW, CELD_FROM_BACKGROUND } CeldOrigin;

/* One label, and what is known about it. */
typedef struct
{
  uint8_t    colour[4];         /* R'G'B'A of its scribbles; alpha 0 only for the background that celdepth added */
  CeldOrigin origin;
  bool       background;        /* weakly behind every other label */
  bool       hard;              /* its seeds keep their label at any hardness (seeds of arrows) */
  int        x, y;              /* a pixel of the region, far from its outline */
  size_t     seeds;             /* painted pixels */
  size_t     area;              /* pixels after segmentation */
} CeldRegion;

typedef struct { CeldRegion *item; size_t n; } CeldPalette;

CELD_API void celd_palette_clear (CeldPalette *palette);

/* Writes the name of a label's layer, cut to `size` bytes with the final 0: "#rrggbb", with " label N" if other labels
 * have the same colour, or "background" for the transparent one. */
CELD_API void celd_label_name (const CeldPalette *palette, uint32_t label, char *name, size_t size);

/* One end of a relation: a point of the drawing, or every region of a colour.  In a composition the drawing is one of
 * its fragments, of which `whole` means every region but the page. */
typedef struct { bool by_colour; uint8_t colour[3]; double x, y; size_t fragment; bool whole; } CeldTerm;

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

/* Where relations text or path data could not be read, with texts in English. */
typedef struct { int line, column; char expected[48]; char found[24]; } CeldTextError;

/* A problem that the artist should know of; there is a result all the same. */
typedef enum
{
  CELD_PROBLEM_STROKE_OVERRULED,   /* most of a colour's stroke at (x,y) went to region `other` */
  CELD_PROBLEM_REGION_UNREACHED,   /* no stroke reaches the region round (x,y), closed but for gaps */
  CELD_PROBLEM_COLOUR_LOST,        /* a colour has no pixel left after segmentation */
  CELD_PROBLEM_ARROW_UNCLEAR,      /* the painted arrow at (x,y) was left out, for `reason` */
  CELD_PROBLEM_OUTSIDE,            /* relation `relation` has an end outside the drawing; left out */
  CELD_PROBLEM_UNKNOWN_COLOUR,     /* relation `relation`, left out, or the background has a colour that is no label;
                                    * that of `label` is nearest */
  CELD_PROBLEM_SAME_REGION,        /* both ends of relation `relation` lie in one region; left out */
  CELD_PROBLEM_CONTRADICTION,      /* relation `relation` contradicts the others of cycle `other`; left out */
  CELD_PROBLEM_NOT_CONVERGED,      /* the error of smooth depth is larger than the tolerance */
  CELD_PROBLEM_REGION_SPLIT,       /* label `other`, round (x,y), was split off `label` to resolve a contradiction */
  CELD_PROBLEM_HIDDEN_UNSURE,      /* what is hidden of `label`, round (x,y), is hardly more than a guess */
  CELD_PROBLEM_STROKE_FAINT,       /* the scribble or arrow at (x,y) is too faint to be read; left out */
  CELD_PROBLEM_STROKE_UNMATCHED    /* hardly any stroke of its layer, corrections or what is hidden, has the colour of a
                                    * region: the one at (x,y) has none */
} CeldProblemKind;

/* Why a painted arrow is unclear. */
typedef enum
{
  CELD_REASON_NONE,                /* it is clear, or the problem is no arrow */
  CELD_REASON_SHORT,               /* too short for its width */
  CELD_REASON_ALIKE,               /* neither of its ends, or each, is what the style says of the nearer one */
  CELD_REASON_HEAD,                /* it should fade or taper, and has a head that does not agree with that */
  CELD_REASON_UNEVEN,              /* it turns sharply, changes colour, or fades or tapers in parts only */
  CELD_REASON_MEETING,             /* it meets strokes, and which way it goes on there cannot be told */
  CELD_REASON_PIECE,               /* small, and so near to another stroke that it may be a piece of it */
  CELD_REASON_HIDDEN,              /* an end of it, or its head or dot, may lie below other strokes */
  CELD_REASON_FRAME                /* it may go on beyond the edge of the picture */
} CeldArrowReason;

#define CELD_NO_INDEX SIZE_MAX

typedef struct
{
  CeldProblemKind kind;
  int             x, y;            /* the place in the picture; -1 if there is none */
  uint32_t        label, other;    /* labels concerned; 0 if none */
  size_t          relation;        /* index into the relations; CELD_NO_INDEX if none */
  CeldArrowReason reason;          /* of an unclear arrow */
  size_t          first, runs;     /* the paint of an unclear arrow: so many runs from this one on */
} CeldProblem;

typedef struct { int x, y, n; } CeldPaintRun; /* n pixels of a row, from (x,y) on */

typedef struct
{
  CeldProblem  *item;
  size_t        n;
  CeldPaintRun *run;               /* of all items */
  size_t        n_runs;
} CeldProblems;

CELD_API void celd_problems_clear (CeldProblems *problems);

/* Over what the picture contains, paints unclear arrows again in red, and draws a red ring with a dot at its centre
 * round the place of each other problem. */
CELD_API void celd_problems_paint (const CeldProblems *problems, CeldPaint *paint);

/* Writes what is wrong, where, and what to do; cut to `size` bytes with the final 0.  palette and relations may be
 * NULL: the sentence then has no colours and no line numbers. */
CELD_API void celd_problem_text (const CeldProblem *problem, const CeldPalette *palette, const CeldRelations *relations,
                                 CeldTranslate translate, char *text, size_t size);

typedef enum
{
  CELD_REGION_UNSURE,
  CELD_REGION_GONE, /* it has no pixel any more */
  CELD_REGION_NEW   /* it had none before */
} CeldRegionChange;

/* What a person should know of a region that was carried to a frame. */
typedef struct
{
  uint32_t         label;
  CeldRegionChange change;
  double           certainty; /* [0,1] */
  int              x, y;      /* where to look: a pixel of it, of the frame before if it is gone; -1 if there is none */
} CeldRegionNote;

/* Relations that contradict each other: item[0..n-1] are indices into the relations, in the order of the cycle (the
 * farther region of each is the nearer region of the next, and that of the last the nearer region of the first). */
typedef struct
{
  size_t  *item;
  size_t   n;
  size_t   scc;                 /* index of its strongly connected component in CeldOrder or CeldExact */
  uint32_t label;               /* the cycle leads through two connected regions of this label, and would not exist
                                 * with same_colour = separate; 0: there is no such label */
  uint8_t  colour[3];           /* of that label */
  int      x[2], y[2];          /* a place in each of the two regions */
} CeldCycle;

/* The relations between the regions of one strongly connected component, as indices in the order given; and a shortest
 * cycle through the latest of them that lies on a cycle. */
typedef struct { size_t *item; size_t n; CeldCycle newest; } CeldScc;

/* The relations that hold, as labels: link i puts the labels end[first[2i]] + 1 .. behind the labels end[first[2i+1]]
 * + 1 .., which end before first[2i+2], or gives all of them one depth if equal[i]. */
typedef struct { size_t n, *first; uint32_t *end; bool *equal; } CeldOrderLinks;

typedef struct
{
  uint32_t  *level;             /* of label k: level[k-1]; 0 = farthest */
  size_t     n;                 /* labels */
  uint32_t   levels;            /* one more than the largest level */
  double    *height;            /* of each level, in gaps of one relation; NULL if heights equal levels */
  CeldCycle *cycle;             /* contradictions; the first item of each is the relation that was left out */
  size_t     n_cycles;
  CeldScc   *scc;
  size_t     n_sccs;
  CeldOrderLinks links;         /* n is 0 where only levels are known */
} CeldOrder;

CELD_API void celd_order_clear (CeldOrder *order);

/* Writes a sentence that names the other relations of the cycle, those that contradict the one left out; cut to `size`
 * bytes with the final 0. */
CELD_API void celd_cycle_text (const CeldCycle *cycle, const CeldRelations *relations, CeldTranslate translate,
                               char *text, size_t size);

/* A gap in a contour that the segmentation closed: a polyline from one line end to another, between two labels. */
typedef struct { double x, y; } CeldPlace;
typedef struct { CeldPlace *place; size_t n; uint32_t label, other; } CeldClosure;
typedef struct { CeldClosure *item; size_t n; } CeldClosures;

CELD_API void celd_closures_clear (CeldClosures *closures);

/* How an iterative solver ended; the error is a fraction of the range of the solution. */
typedef struct { bool converged; int iterations; double error; } CeldSolve;

/* A node of the exact program: a scribble, or an end of a relation off every scribble. */
typedef struct
{
  uint32_t label;               /* of the scribble; 0 for the end of a relation */
  int      x, y;                /* a pixel of it; -1,-1 if other paint covers it completely */
  double   depth;               /* in gaps of one relation; 0 for the farthest node */
} CeldNode;

/* What the exact program reports in addition to the depth. */
typedef struct
{
  CeldNode  *node;
  size_t     n;
  double     sigma;             /* of eq. (1) */
  double     energy;            /* 1/2 d'Ld of eq. (2), with the depths of nodes in gaps of one relation */
  double     gap;               /* duality gap: the energy is at most this far above its minimum, for the harmonic
                                 * bases as they were solved */
  double     violation;         /* of the most violated inequality, in gaps; 0 if all hold */
  size_t     inequalities;      /* between nodes */
  size_t     active;            /* inequalities with a positive multiplier, which hold with equality */
  int        steps;             /* changes of the active set */
  CeldSolve  solve;             /* of the harmonic bases */
  CeldCycle *cycle;             /* contradictions between nodes, as in CeldOrder */
  size_t     n_cycles;
  CeldScc   *scc;
  size_t     n_sccs;
} CeldExact;

CELD_API void celd_exact_clear (CeldExact *exact);

/* Contour ownership: which label each pixel belongs to, ink included, in three pictures of the drawing's size.
 * Ink in a pixel of two labels belongs to the owner if that has ink there, and else to `under`. */
typedef struct
{
  CeldLabels owner;             /* the pixel's label; in an antialiased pixel of two labels the nearer one (either one
                                 * if their levels are equal) */
  CeldLabels under;             /* the other one of two labels; equal to owner where there is only one */
  CeldPlane  coverage;          /* how much of the pixel the owner covers, (0,1]; 1 where there is only one label */
} CeldOwnership;

/* The sheets of a drawing: the whole silhouette of each region, what others hide of it included. */
typedef struct CeldSheets CeldSheets;

CELD_API void celd_sheets_free (CeldSheets *sheets);          /* accepts NULL */

/* A drawing cut into one layer for each region.  Layer 0 is the farthest; the layers, composited in their order by
 * `over` with straight alpha, are the drawing again. */
typedef struct CeldLayers CeldLayers;

typedef struct
{
  uint32_t label;
  uint32_t level;
  CeldRect box;                 /* the layer is transparent outside it; width 0: everywhere */
} CeldLayer;

/* The numbers that layers will be stored as; colours are rounded so that the composite of the layers is exact. */
typedef enum
{
  CELD_STORE_FLOAT,
  CELD_STORE_8_BIT,             /* 1/255 steps */
  CELD_STORE_8_BIT_SRGB         /* linear light in 1/255 steps of its sRGB encoding */
} CeldStore;

CELD_API size_t           celd_layers_count (const CeldLayers *layers);
CELD_API const CeldLayer *celd_layers_item  (const CeldLayers *layers, size_t layer);
/* Writes the layer's box as r, g, b, a with straight alpha: 4 x width x height numbers. */
CELD_API void             celd_layers_paint (const CeldLayers *layers, size_t layer, float *rgba);
CELD_API void             celd_layers_free  (CeldLayers *layers);            /* accepts NULL */

/* Where a layer is most plausibly attached to another, as a start for rigging: of all layers that touch it, usually the
 * one along which it has the longest contact.  Layers that touch, directly or through others, form a tree, whose root
 * is the one with the most visible pixels. */
typedef struct
{
  size_t parent;                /* index of a layer; CELD_NO_INDEX: the root of a tree, or the page */
  double x, y;                  /* the middle of the contact with the parent, or of what is visible of a root; corners of
                                 * pixels are whole numbers */
} CeldJoint;

/* Two labels that may move apart when a drawing is registered. */
typedef struct { uint32_t nearer, farther; } CeldCrack;
typedef struct { CeldCrack *item; size_t n; } CeldCracks;

CELD_API void celd_cracks_clear (CeldCracks *cracks);         /* accepts a zeroed one */

/* The parts of a drawing, for its registration.  Labels are 1 .. n, level[k - 1] is the level of label k.  Parts of
 * different levels move apart, or with n_cracks > 0 only the parts that these name; and nearer ones hide farther
 * ones. */
typedef struct
{
  const CeldLabels *labels;     /* of each pixel, ink included: the owner of CeldOwnership; 0: does not move */
  const uint32_t   *level;      /* NULL: all are equal */
  size_t            n;
  uint32_t          background; /* the label that does not move; 0: all do */
  const CeldCrack  *crack;      /* of celd_cracks_find */
  size_t            n_cracks;
} CeldMovingParts;

/* A square lattice that a drawing is embedded into, torn where parts move apart.  It carries the drawing from its rest
 * pose to where its vertices are. */
typedef struct CeldLattice CeldLattice;

CELD_API void celd_lattice_free (CeldLattice *lattice);       /* accepts NULL */

/* Where a drawing is put into another picture: it is mirrored if `flip` and enlarged by `scale`, with its upper left
 * corner at (x,y), and then turned clockwise round its middle. */
typedef struct
{
  double x, y;                  /* pixels, up to CELD_FARTHEST_PLACE to either side, where nothing is seen */
  double scale;                 /* CELD_LEAST_SCALE .. CELD_LARGEST_SCALE */
  double turn;                  /* degrees, up to CELD_FARTHEST_PLACE either way */
  bool   flip;
} CeldPlacement;
#define CELD_FARTHEST_PLACE 1e6
#define CELD_LEAST_SCALE   0.001
#define CELD_LARGEST_SCALE 1000.0

/* One drawing of a composition, cut into layers.  All of it is borrowed. */
typedef struct
{
  const CeldLayers  *layers;
  const CeldOrder   *order;     /* of their labels */
  uint32_t           page;      /* the label of its page; 0: none */
  CeldPlacement      placement;
  const CeldLabels  *labels;    /* of each pixel, and their palette, for ends of relations; NULL: no relation has an end
                                 * in this drawing */
  const CeldPalette *palette;
  const CeldPlane   *ink;       /* for ends on ink, and for strokes on a page that is left out; may be NULL */
} CeldFragment;

/* Labels of all pixels of a frame that were propagated from a key, the certainty that celd_propagate gives, and how
 * near the key is, (0,1). */
typedef struct { const CeldLabels *labels; const CeldPlane *certainty; double nearness; } CeldPropagated;

/* A picture with its ink and its expanded levels, all of one size. */
typedef struct { const CeldColours *art; const CeldPlane *ink, *levels; } CeldLevelArt;

/* Drawings put together in one picture, each of their regions with a place in one order. */
typedef struct CeldComposition CeldComposition;

/* One region of one drawing in a composition. */
typedef struct
{
  size_t   fragment, layer;     /* index into its layers */
  uint32_t label, level;        /* of the drawing; of the composition, 0 = farthest */
  CeldRect box;                 /* in the composition; the layer is transparent outside it, width 0: everywhere */
} CeldComposedLayer;

CELD_API size_t                   celd_composition_count (const CeldComposition *composition);
CELD_API const CeldComposedLayer *celd_composition_item  (const CeldComposition *composition, size_t layer);
/* The relations that were left out, as cycles of indices into the relations of the composition: each begins with the
 * one that was left out, and the others contradict it, together with the orders of the drawings. */
CELD_API const CeldCycle         *celd_composition_cycles (const CeldComposition *composition, size_t *n);
CELD_API void                     celd_composition_free  (CeldComposition *composition);     /* accepts NULL */

/* A handle of a drawing that is deformed: takes the place (x,y) to (to_x,to_y), and what is near it `depth` levels
 * forward.  Pixels have their centres at half numbers. */
typedef struct { double x, y, to_x, to_y, depth; } CeldHandle;
typedef struct { CeldHandle *item; size_t n; } CeldHandles;

CELD_API void celd_handles_clear (CeldHandles *handles);

/* A frame of an animation whose handles are given. */
typedef struct { int frame; CeldHandles handles; } CeldHandleKey;

/* A drawing that can be deformed: its layers, embedded into one lattice. */
typedef struct CeldPuppet CeldPuppet;

CELD_API void celd_puppet_free (CeldPuppet *puppet);          /* accepts NULL */

/* A layer of a puppet in its pose. */
typedef struct
{
  uint32_t label;
  double   level;               /* the mean over the layer, -infinity for what lies still behind all; larger = nearer */
  double   elsewhere;           /* the share of the layer that has another level, when rounded; 0 .. 1 */
} CeldPosedLayer;

/* What an artist should know of a pose; places are in the drawing. */
typedef struct
{
  size_t outside;               /* handles that lay outside all parts */
  size_t folded;                /* squares of the lattice that are folded over */
  double stretch;               /* the largest length of a side of a square, relative to its rest pose */
  double outside_x, outside_y;  /* the first of these handles */
  double folded_x, folded_y;    /* the square that is folded most */
  double stretch_x, stretch_y;  /* the one that is stretched most */
} CeldPoseReport;

/* A key drawing: its completed layers, its ink, and the label of its background, which does not move (0: none). */
typedef struct { const CeldLayers *layers; const CeldPlane *ink; uint32_t background; } CeldKey;

/* Two keys, and how the parts of the one move to the other. */
typedef struct CeldInbetween CeldInbetween;

CELD_API void celd_inbetween_free (CeldInbetween *inbetween); /* accepts NULL */

/* A surface over the picture: heights in pixels, larger = nearer; depth 0 has height 0. */
#define CELD_CUT_RIGHT  1
#define CELD_CUT_BELOW  2
#define CELD_NEAR_RIGHT 4
#define CELD_NEAR_BELOW 8
typedef struct
{
  int      width, height;
  float   *z;                   /* of each pixel */
  float   *outline;             /* of each pixel; the height of the outline where the surface ends in front of
                                 * another one */
  uint8_t *cut;                 /* of each pixel, bits: CELD_CUT towards neighbours that the surface does not continue
                                 * to, CELD_NEAR towards those that it is in front of */
} CeldRelief;

/* A triangle mesh over the picture, whose centre is at x = y = 0; depth 0 is at z = 0. */
typedef struct
{
  size_t    vertices, triangles;
  float    *place;              /* of each vertex x, y, z: to the right, up, to the viewer, in millimetres */
  float    *normal;             /* as many, unit length */
  float    *art;                /* of each vertex, its place in the picture: 0 .. 1 to the right and down */
  uint32_t *corner;             /* three vertices of each triangle, counter-clockwise seen from outside */
  double    error;              /* largest distance to the surface, in pixels */
} CeldReliefMesh;

/* A model: one mesh for each region that has pixels, on its whole silhouette, from back to front, and their texture. */
typedef struct
{
  uint32_t       label;
  bool           page;          /* a plane, or with CELD_MESH_SOLID the plate, of the size of the picture */
  CeldReliefMesh mesh;          /* its art is a place in the atlas */
} CeldModelPart;

typedef struct
{
  CeldModelPart *part;
  size_t         n;
  CeldColours    atlas;         /* the layers of all parts, on white; their colours go on beyond their outlines */
  double         error;         /* largest distance of meshes to the surfaces, in pixels */
} CeldModel;

#ifdef __cplusplus
}
#endif

#endif
