/* Deformation: a drawing as a puppet of layers that are embedded into one lattice.
 *
 *   handles.c           handles as text and as paint
 *   puppet-embedding.c  the lattice: layers joined where depth is continuous
 *   page-strokes.c      strokes on the page that go with parts
 *   puppet-lines.c      lines that go on below nearer layers
 *   puppet-ties.c       which pieces of it go with which
 *   puppet.c            the puppet at rest
 *   puppet-of-levels.c  the puppet of a picture of levels
 *   puppet-line-width.c how far pixels are from the middle of lines, whose width is kept
 *   puppet-pose.c       a pose, and what its handles hold
 *   puppet-guess.c      where handles take everything at first
 *   puppet-settle.c     as rigid as possible between handles
 *   puppet-report.c     what an artist should know of a pose
 *   puppet-sampling.c   a deformed square, pixel by pixel
 *   puppet-draw.c       squares and layers from back to front
 *   puppet-layers.c     the pose as layers
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_PUPPET_H
#define CELD_PUPPET_H

#include "layers/layers.h"
#include "motion/motion.h"

#define CELD_PUPPET_BLEED 4 /* pixels around a layer that go with its nearest cell, for antialiasing */
#define CELD_PUPPET_PAD   5 /* pixels around its box in a layer's pictures, so that interpolation stays in them */

/* A layer. */
typedef struct
{
  CeldRect  box;               /* in the drawing; its left and top lie on the grid of cells.  Width 0: empty */
  uint32_t  label, level;
  float    *rgba;              /* premultiplied */
  uint32_t *cell;              /* of each pixel, + 1; 0: none.  NULL if the layer does not move */
  size_t    first, n_cells;    /* its cells in the lattice */
} CeldPuppetLayer;

/* Vertices that hold together where two pieces touch, if one of these goes with the other; longer contacts first. */
typedef struct { uint32_t contact, vertex[2]; } CeldPuppetTie;

struct CeldPuppet
{
  int              width, height;
  size_t           n;
  CeldPuppetLayer *layer;
  uint32_t        *front;      /* of each pixel of the drawing: its layer; the nearer one of two */
  size_t           n_base;     /* layers at the back that do not move */
  float           *base;       /* these layers, premultiplied */
  CeldLattice      lattice;    /* its seams are the ties that hold in this pose */
  CeldPuppetTie   *tie;        /* in the order of contacts */
  size_t           n_ties;
  uint32_t        *piece;      /* of each vertex */
  float           *line;       /* of each pixel of the drawing: x, y from the middle of the line near it; 0, 0: none */
  uint8_t         *bleeds;     /* of each cell: have pixels beside it to go with it? */
  float           *value;      /* of each level, in the picture that it comes from; NULL: its number */
  size_t           n_values;
  float           *depth;      /* of each cell: how many levels it is moved forward */
  uint32_t        *drawn;      /* of each pixel: mark and source of what was drawn there last, for puppet-sampling.c */
  uint32_t         mark;
};

/* The number of pixels in a row of a layer's pictures, and the index of a pixel of the drawing in them. */
static inline size_t
celd_puppet_stride (const CeldPuppetLayer *layer)
{
  return (size_t) layer->box.width + 2 * CELD_PUPPET_PAD;
}

static inline size_t
celd_puppet_pixel (const CeldPuppetLayer *layer, int x, int y)
{
  return (size_t) (y - layer->box.y + CELD_PUPPET_PAD) * celd_puppet_stride (layer) +
         (size_t) (x - layer->box.x + CELD_PUPPET_PAD);
}

/* How much of a pixel of the drawing a layer covers, 0 outside of its box. */
static inline float
celd_puppet_alpha (const CeldPuppetLayer *layer, int x, int y)
{
  bool inside = x >= layer->box.x && y >= layer->box.y && x < layer->box.x + layer->box.width &&
                y < layer->box.y + layer->box.height;

  return inside ? layer->rgba[4 * celd_puppet_pixel (layer, x, y) + 3] : 0;
}

/* The cell of the front layer at a pixel, + 1; 0 if that does not move. */
static inline uint32_t
celd_puppet_front_cell (const CeldPuppet *puppet, int x, int y)
{
  const CeldPuppetLayer *layer = &puppet->layer[puppet->front[(size_t) y * (size_t) puppet->width + (size_t) x]];

  return layer->cell ? layer->cell[celd_puppet_pixel (layer, x, y)] : 0;
}

/* ------------------------------------------------------------------ puppet-lines.c */

/* Lets the lines of layers go on below those of nearer ones that they run into. */
CeldStatus celd_puppet_continue_lines (CeldPuppet *puppet, const CeldPlane *ink);

/* ------------------------------------------------------------------ puppet-embedding.c */

/* The lattice of one layer alone, in a window of the drawing whose left and top lie on the grid of cells and which
 * contains the layer: cells are those of the puppet, from layer->first on.  NULL if the layer has no pixels. */
CeldStatus celd_puppet_layer_lattice (const CeldPuppetLayer *layer, CeldRect window, const CeldPlane *ink,
                                      const CeldSettings *settings, const CeldHost *host, CeldLattice **lattice);

/* Makes the lattice of a puppet whose layers have their pictures, and the cells of their pixels.  `borders` and
 * `cracks` are as for celd_puppet_new. */
CeldStatus celd_puppet_embed (CeldPuppet *puppet, const CeldPlane *ink, const CeldPlane *borders,
                              const CeldCracks *cracks, const CeldSettings *settings, const CeldHost *host);

/* Calls `visit` for each pair of neighbouring pixels whose front layers differ and move, with the cells in front; (x,y)
 * is the left or upper pixel, `right` is 1 for its right neighbour, 0 for its lower one. */
typedef void (*CeldContactVisit) (void *data, uint32_t a, uint32_t b, int x, int y, int right);
void celd_puppet_contacts (const CeldPuppet *puppet, CeldContactVisit visit, void *data);

/* Whether corner i of cell a lies where corner k of cell b does, at rest. */
static inline bool
celd_puppet_same_place (const CeldLattice *lattice, uint32_t a, int i, uint32_t b, int k)
{
  const float *p = lattice->rest + 2 * (size_t) lattice->corner[4 * (size_t) a + (size_t) i];
  const float *q = lattice->rest + 2 * (size_t) lattice->corner[4 * (size_t) b + (size_t) k];

  return p[0] == q[0] && p[1] == q[1];
}

/* ------------------------------------------------------------------ puppet-ties.c */

/* Finds the ties of a puppet that has its lattice. */
CeldStatus celd_puppet_tie (CeldPuppet *puppet);

/* ------------------------------------------------------------------ puppet-guess.c, puppet-settle.c */

/* A handle with the cell that it holds; its place is of one of the cell's pixels, in the drawing. */
typedef struct { size_t cell; float x, y, to_x, to_y, depth; } CeldHeld;

/* A pose that is being made. */
typedef struct
{
  CeldPuppet *puppet;
  CeldHeld   *held;
  size_t      n;
  bool       *holds;      /* of each piece: is there a handle? */
  float      *distance;   /* of handle i to vertex v along the lattice: [i x n_vertices + v] */
  float      *scratch;    /* three numbers for each vertex */
  float      *before;     /* places after the last sweep */
  float      *start;      /* places from which a sweep starts */
} CeldPuppetPose;

/* Measures distances, and moves all vertices from rest to a first guess of their places. */
void celd_pose_guess (CeldPuppetPose *pose);
/* Moves vertices until all cells are as rigid as possible. */
CeldStatus celd_pose_settle (CeldPuppetPose *pose, const CeldHost *host);
/* Finds how many levels each cell is moved forward: what the handles say, near ones most, in whole levels. */
void celd_pose_move_forward (CeldPuppetPose *pose);

/* ------------------------------------------------------------------ puppet-report.c */

/* Adds where cells are folded and how far they are stretched. */
void celd_pose_describe (const CeldLattice *lattice, CeldPoseReport *report);

/* ------------------------------------------------------------------ puppet-line-width.c */

/* Finds how far pixels are from lines, for a puppet that has the size of its pictures. */
CeldStatus celd_puppet_measure_lines (CeldPuppet *puppet, const CeldPlane *ink, const CeldHost *host);

/* ------------------------------------------------------------------ puppet-sampling.c */

/* The rows from `top` to `bottom` - 1 of a picture of the size of the drawing. */
typedef struct
{
  CeldPuppet        *puppet;
  const CeldColours *picture;  /* premultiplied */
  const CeldPlane   *levels;   /* may be NULL */
  int                top, bottom;
} CeldPuppetCanvas;

/* Draws the pixels in the square of one cell over what is there, or those beside it that go with it; those of other
 * cells of the layer come first.  `mark` tells drawings of layers apart. */
void celd_puppet_draw_cell (const CeldPuppetCanvas *canvas, const CeldPuppetLayer *layer, size_t cell, float level,
                            uint32_t mark, bool beside);

/* Draws a whole layer as it is at rest. */
void celd_puppet_draw_rest (const CeldPuppetCanvas *canvas, const CeldPuppetLayer *layer);

#endif
