/* Normals and light: what the files of this theme share.
 *
 *   normals.c        the step of Lumo normals [Joh02], and bevels
 *   lumo-creases.c   strokes inside a region, along which it may bend
 *   lumo-outlines.c  what outlines constrain normals to
 *   shade.c          light on normals
 *   enhance.c        depth enhancement
 *   shadows.c        its soft shadows
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_LIGHT_H
#define CELD_LIGHT_H

#include "depth/depth.h"

#include <math.h>

/* ------------------------------------------------------------------ Lumo normals */

/* What n_x and n_y of a pixel beside an outline are drawn to; y up. */
typedef struct { size_t pixel; float x, y; } CeldNormalConstraint;

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

/* The step's inputs and intermediate results.  Planes are tight and of the size of the ink. */
typedef struct
{
  const CeldPlane      *ink;
  const CeldPlane      *depth;        /* may be NULL */
  const CeldPaint      *hints;        /* may be NULL */
  const CeldSettings   *settings;
  int                   width, height;
  int                   stroke;       /* width of the drawing's strokes in pixels */
  CeldDepthEdges        edges;
  float                *level;
  float                *east, *south; /* weights; 0 where the surface is cut */
  CeldCrease           *crease;
  size_t                n_creases;
  CeldRunComponents     regions;      /* connected regions of one level */
  uint8_t              *flat;         /* of each region, 1: without an outline of its own, it faces the viewer */
  CeldNormalConstraint *constraint;   /* in any order; several of one pixel add up */
  size_t                n_constraints;
  float                *tilt;         /* n_x and n_y of each pixel, y up */
  size_t                crease_capacity, constraint_capacity;
} CeldLumo;

static inline size_t
celd_lumo_pixel (const CeldLumo *lumo, int x, int y)
{
  return (size_t) y * (size_t) lumo->width + (size_t) x;
}

/* The component of a pixel. */
static inline uint32_t
celd_lumo_component (const CeldLumo *lumo, const CeldRunComponents *components, size_t pixel)
{
  return celd_run_component_at (components, (int) (pixel % (size_t) lumo->width), (int) (pixel / (size_t) lumo->width));
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

/* lumo-outlines.c: finds the regions, which of them are flat, and all constraints. */
CeldStatus celd_lumo_outlines (CeldLumo *lumo, const CeldHost *host);

/* ------------------------------------------------------------------ depth enhancement */

/* The level or depth of a pixel; NaN and infinity read as 0. */
static inline float
celd_level_at (const CeldPlane *levels, int x, int y)
{
  float level = CELD_AT (levels, x, y);

  return isfinite (level) ? level : 0;
}

/* The least and largest of these levels. */
static inline void
celd_level_range (const CeldPlane *levels, float *least, float *most)
{
  *least = *most = celd_level_at (levels, 0, 0);
  for (int y = 0; y < levels->height; y++)
    for (int x = 0; x < levels->width; x++)
      {
        *least = fminf (*least, celd_level_at (levels, x, y));
        *most  = fmaxf (*most, celd_level_at (levels, x, y));
      }
}

/* Soft shadows of nearer levels on farther ones: change = - the fraction of light that they take, in [-1,0].
 * `deviation` of the blur in pixels, > 0; `change` has the size of `levels`. */
CeldStatus celd_shadows (const CeldPlane *levels, double deviation, const CeldSettings *settings, const CeldHost *host,
                         CeldPlane *change);

#endif
