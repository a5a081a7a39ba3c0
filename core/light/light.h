/* Normals and light: what the files of this theme share.
 *
 *   normals.c        the step of Lumo normals [Joh02]
 *   lumo-creases.c   strokes inside a region, along which it may bend
 *   lumo-bodies.c    surfaces of visible and hidden pixels
 *   lumo-outlines.c  what outlines constrain normals to
 *   lumo-solve.c     normals between outlines
 *   lumo-bevel.c     bevels
 *   reflection.c     how a surface reflects light
 *   matcap.c         light from the picture of a lit ball
 *   shade.c          light on pictures
 *   enhance.c        depth enhancement
 *   shadows.c        its soft shadows
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_LIGHT_H
#define CELD_LIGHT_H

#include "depth/depth.h"
#include "sheets/sheets.h"

#include <math.h>

/* ------------------------------------------------------------------ Lumo normals */

/* What n_x and n_y of a pixel beside an outline are drawn to; y up. */
typedef struct { size_t pixel; float x, y; } CeldNormalConstraint;

typedef struct { CeldNormalConstraint *item; size_t n, capacity; } CeldNormalConstraints;

/* A hint that the artist painted on one side of a line: nothing, black, grey or white. */
typedef enum { CELD_UNPAINTED, CELD_UNDER, CELD_BOTH, CELD_OVER } CeldLumoHint;

/* An edge between a pixel and its right or lower neighbour, in the middle of a stroke inside a region: the surface is
 * cut there, and bends on one side or both. */
typedef struct
{
  uint32_t pixel;
  bool     down;                /* to the lower neighbour */
  bool     painted;             /* because of a hint */
  float    x, y;                /* unit vector across the stroke, from the pixel to its neighbour; y down */
  float    strength[2];         /* how much the pixel and its neighbour bend, 0 .. 1 */
} CeldCrease;

/* Hidden pixels x .. end - 1 of row y of a body. */
typedef struct { int x, y, end; uint32_t body; } CeldHiddenRun;

/* Bodies: the surfaces that are solved one by one.  A body has the visible pixels of components that what is hidden of
 * their sheets connects, and these hidden pixels. */
typedef struct
{
  size_t         n;
  uint32_t      *of_component;  /* the body of each component */
  CeldRect      *box;           /* of each body */
  bool          *bends;         /* whether it has to be solved: the background alone has not */
  CeldHiddenRun *hidden;        /* those of body b are hidden[first[b]] .. hidden[first[b + 1] - 1] */
  size_t        *first;
} CeldBodies;

/* The step's inputs and intermediate results.  Planes are tight and of the size of the ink. */
typedef struct
{
  const CeldPlane      *ink;
  const CeldOwnership  *own;
  const CeldSheets     *sheets;
  const CeldPlane      *depth;        /* may be NULL */
  const CeldPaint      *hints;        /* may be NULL */
  const CeldSettings   *settings;
  int                   width, height;
  int                   stroke;       /* width of the drawing's strokes in pixels */
  uint32_t              page;         /* the label of the background; 0: there is none, or nothing else */
  CeldDepthEdges        edges;
  uint8_t              *cut;          /* of the edges */
  float                *level;
  float                *east, *south; /* weights; 0 where the surface is cut */
  CeldCrease           *crease;
  size_t                n_creases;
  CeldRunComponents     components;   /* of what the edges connect */
  CeldBodies            bodies;
  CeldPixelLinks        links;
  CeldNormalConstraints constraints;  /* of visible pixels, in any order; several of one pixel add up */
  float                *tilt;         /* n_x and n_y of each pixel, y up */
  size_t                crease_capacity;
} CeldLumo;

static inline size_t
celd_lumo_pixel (const CeldLumo *lumo, int x, int y)
{
  return (size_t) y * (size_t) lumo->width + (size_t) x;
}

/* Whether two pixels have the same level. */
static inline bool
celd_lumo_same_level (const CeldLumo *lumo, size_t p, size_t q)
{
  return lumo->level[p] >= lumo->level[q] && lumo->level[p] <= lumo->level[q];
}

/* lumo-creases.c: the first hint along the unit vector (dx,dy) from the place (x,y), y down, within about 1.5 stroke
 * widths; lumo->hints must not be NULL. */
CeldLumoHint celd_lumo_hint (const CeldLumo *lumo, double x, double y, double dx, double dy);

/* lumo-creases.c: finds the creases, and cuts the weights along them. */
CeldStatus celd_lumo_creases (CeldLumo *lumo, const CeldHost *host);

/* lumo-bodies.c: finds components and bodies. */
CeldStatus celd_lumo_bodies (CeldLumo *lumo, const CeldHost *host);
void       celd_lumo_bodies_clear (CeldBodies *bodies);       /* accepts a zeroed record */

/* One body, while it is solved. */
typedef enum { CELD_ELSEWHERE, CELD_SEEN, CELD_HIDDEN_PART } CeldBodyKind;

typedef struct
{
  const CeldLumo *lumo;
  CeldRect        box;
  size_t          stride;       /* of its planes, which have the size of the box */
  uint8_t        *kind;         /* CeldBodyKind of each pixel */
  float          *east, *south; /* weights; 0 at first */
  bool            page_bends;   /* whether hints bend the background */
} CeldBody;

/* The kind of a pixel of the picture. */
static inline uint8_t
celd_body_kind (const CeldBody *body, int x, int y)
{
  int u = x - body->box.x, v = y - body->box.y;

  return u >= 0 && v >= 0 && u < body->box.width && v < body->box.height
           ? body->kind[(size_t) v * body->stride + (size_t) u] : CELD_ELSEWHERE;
}

/* lumo-outlines.c: makes the weights of a body, and appends constraints of visible and of hidden pixels. */
CeldStatus celd_body_outlines (CeldBody *body, CeldNormalConstraints *seen, CeldNormalConstraints *hidden);

/* lumo-solve.c: makes the tilt. */
CeldStatus celd_lumo_solve (CeldLumo *lumo, const CeldHost *host);

/* lumo-bevel.c: fades the tilt out with the distance from the constraints, to nothing at settings->bevel times the
 * picture's diagonal; does nothing for a bevel of 0. */
CeldStatus celd_lumo_bevel (CeldLumo *lumo, const CeldHost *host);

/* normals.c: the step, for callers that have the ownership of the levels and its sheets.  `depth` and `hints` may be
 * NULL. */
CeldStatus celd_normals_of_sheets (const CeldPlane *ink, const CeldPlane *borders, const CeldPlane *levels,
                                   const CeldOwnership *own,
                                   const CeldSheets *sheets, const CeldPlane *depth, const CeldPaint *hints,
                                   const CeldSettings *settings, const CeldHost *host, CeldVectors *normals);

/* ------------------------------------------------------------------ light on one pixel */

#define CELD_MOST_TONE 2.0 /* chosen */

typedef struct { double x, y, z; } CeldVector;

/* Normals, and the light that falls on them. */
typedef struct
{
  const CeldVectors  *normals;
  const CeldSettings *settings;
  const CeldColours  *matcap;      /* for CELD_MODEL_MATCAP alone */
  CeldVector          light, half; /* unit vectors, of a distant light */
  CeldVector          place;       /* of a near light, in pixels */
  double              base, dull;  /* of a distant light: the light on a surface that faces the viewer, and how much of
                                    * a highlight is there */
} CeldLamp;

/* Without a matcap. */
CeldLamp celd_lamp (const CeldVectors *normals, const CeldSettings *settings);

/* Of all light models but the matcap: the light on the pixel, in [0,1]; and its quotient by that on a surface that
 * faces the viewer, in [0,CELD_MOST_TONE] and 1 if the pixel does. */
double celd_light_at (const CeldLamp *lamp, int x, int y);
double celd_tone_at  (const CeldLamp *lamp, int x, int y);

/* Highlights and rims, in [0,1]; 0 on a surface that faces the viewer. */
double celd_gloss_at (const CeldLamp *lamp, int x, int y);

/* matcap.c: tone and gloss of the matcap, as above. */
void celd_matcap_at (const CeldLamp *lamp, int x, int y, double tone[3], double *gloss);

/* ------------------------------------------------------------------ depth enhancement */

/* Soft shadows of nearer levels on farther ones: change = - the fraction of light that they take, in [-1,0].
 * `deviation` of the blur in pixels, > 0; `change` has the size of `levels`. */
CeldStatus celd_shadows (const CeldPlane *levels, double deviation, const CeldSettings *settings, const CeldHost *host,
                         CeldPlane *change);

#endif
