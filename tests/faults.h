/* Shared by faults.c (failing allocations, hosts that cancel) and faults-*.c (the steps and their input).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef FAULTS_H
#define FAULTS_H

#include "celdepth.h"

#define W 64
#define H 48

typedef struct
{
  float    plane[W * H], alpha[W * H], vectors[3 * W * H];
  uint32_t labels[W * H];
  uint8_t  paint[4 * W * H];
} Pixels;

/* Results of a step, or inputs of the next one. */
typedef struct
{
  Pixels        *pixels;
  CeldPalette    palette;
  CeldRelations  relations;
  CeldProblems   problems;
  CeldOrder      order;
} Results;

typedef struct
{
  const char        *name;
  CeldStatus       (*go) (const CeldHost *host, Results *r);
  const CeldPalette *palette;    /* that the results start from; NULL: an empty one */
  bool               reports;    /* progress */
} Step;

/* The inputs of the steps: painted pictures, and results of earlier steps. */
extern Pixels        drawing_pixels;                                                /* plane: luma, alpha */
extern Pixels        scribble_pixels, arrow_pixels, contour_pixels;                 /* paint */
extern Pixels        lossy_pixels, crossing_pixels, colour_pixels;
extern Pixels        ink_pixels, seed_pixels, label_pixels, level_pixels;           /* plane or labels */
extern Pixels        expanded_pixels, normal_pixels;                                /* both; vectors */
extern CeldPalette   seed_palette, label_palette;
extern CeldRelations scene_relations;
extern CeldSettings  scene_settings;

static inline CeldPlane   plane_of (Pixels *p)   { return (CeldPlane) { W, H, W, p->plane }; }
static inline CeldLabels  labels_of (Pixels *p)  { return (CeldLabels) { W, H, W, p->labels }; }
static inline CeldPaint   paint_of (Pixels *p)   { return (CeldPaint) { W, H, W, p->paint }; }
static inline CeldVectors vectors_of (Pixels *p) { return (CeldVectors) { W, H, W, p->vectors }; }
static inline CeldDrawing drawing_of (Pixels *p) { return (CeldDrawing) { plane_of (p), { W, H, W, p->alpha } }; }

/* Those of each subject, in the order of the pipeline; the one after the last has no name. */
extern const Step region_steps[], depth_steps[], use_steps[], motion_steps[], solver_steps[];

/* The i-th of all; NULL: there are no more. */
const Step *step_at (size_t i);

/* Draws the scene and makes the inputs of all steps; false if a step fails, or does not find what the scene has for
 * it. */
bool make_inputs (void);
void free_inputs (void);

#endif
