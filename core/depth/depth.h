/* Smooth depth, eq. (3), and what normals and relief share with it; the exact program, eq. (1) and (2).
 *
 *   smooth.c            the step: smooth depth from levels, and what an edit changed
 *   smooth-equations.c  its equations, solved component by component
 *   cores.c             which pixels hold a region that has no anchor
 *   discontinuities.c   the weights v_pq: where depth is cut, and whether a cut ends nearby
 *   held-gaps.c         gaps in the ink at which depth is cut too
 *   boxed-solver.c      connected components, and Laplacian systems solved in their bounding boxes
 *   exact-program.c     the exact program: relations to inequalities, its solution, depth
 *   exact-kept.c        what is kept of it between edits
 *   exact-gaps.c        its weights at gaps in the ink
 *   exact-bases.c       harmonic bases of its nodes
 *   exact-nodes.c       adding and removing single nodes
 *   exact-stiffness.c   the stiffness matrix
 *
 * All planes here are tight (stride = width) unless they are CeldPlane or CeldMask.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_DEPTH_H
#define CELD_DEPTH_H

#include "image/image.h"
#include "solve/laplace.h"

/* ------------------------------------------------------------------ discontinuities.c */

/* Edges of a pixel that are cut, in one byte: the right one (down 0) and the lower one (down 1). */
#define CELD_CUT(down) (uint8_t) (1u << (down))

/* How far to both sides of an edge a line is looked for that is too thin to be full ink anywhere, in pixels (chosen).
 * */
#define CELD_THIN_LINE_REACH 2

/* What decides v_pq where levels differ: the least ink within `radius` pixels of both pixels; at or below the threshold
 * it counts as 0, and so does a thin line along the edge, but not with radius 0.  Edges that are marked in `cut` (NULL:
 * none), of the size of the ink, have v_pq = 0 in any case. */
typedef struct { const CeldPlane *ink; float threshold; int radius; const uint8_t *cut; } CeldDepthEdges;

/* The radius for a drawing with strokes of this width, in pixels: half of it, 1 .. 12. */
int celd_edge_radius (int stroke);

/* v_pq of pixel (x,y) and its right (right 1, down 0) or lower neighbour (right 0, down 1), which must lie in the
 * picture.  The first function is for levels that differ; the second for any, and gives 1 where they are equal. */
float celd_discontinuity_weight (const CeldDepthEdges *edges, int x, int y, int right, int down);

static inline float
celd_edge_weight (const CeldDepthEdges *edges, const float *level, int x, int y, int right, int down)
{
  const float *here = level + (size_t) y * (size_t) edges->ink->width + (size_t) x;

  return here[0] == here[right ? 1 : edges->ink->width] ? 1 : celd_discontinuity_weight (edges, x, y, right, down);
}

/* v_pq of all edges, for celd_lap_setup: in [0,1], 0 across a depth discontinuity and where the picture ends.  `level`,
 * east and south have the size of the ink. */
CeldStatus celd_depth_weights (const CeldDepthEdges *edges, const float *level, const CeldHost *host, float *east,
                               float *south);

/* Which pixels are connected to their right and lower neighbours: one bit each, in rows of `words` words. */
typedef struct { int height; size_t words; uint64_t *east, *south; } CeldPixelLinks;

/* From weights as for celd_lap_setup: connected where they are above 0.  To be cleared even after a failure. */
CeldStatus celd_pixel_links_new   (int width, int height, const float *east, const float *south, CeldPixelLinks *links);
void       celd_pixel_links_clear (CeldPixelLinks *links);

/* Whether pixel (x,y) is connected to its right neighbour, or `down` to its lower one. */
static inline bool
celd_are_linked (const CeldPixelLinks *links, int x, int y, bool down)
{
  return (down ? links->south : links->east)[(size_t) y * links->words + (size_t) x / 64] >> (x % 64) & 1;
}

/* Whether a path connects pixel (x,y) with its right neighbour (`down`: its lower one) within the square of 15 pixels
 * around it: then a cut between the two ends nearby, and separates nothing. */
bool       celd_has_detour (const CeldPixelLinks *links, int x, int y, bool down);

/* ------------------------------------------------------------------ held-gaps.c */

/* Pixels that a gap may be long, ink at its ends not counted, and if it interrupts broader lines than most. */
typedef struct { double usual, most; } CeldGapLength;

/* For a drawing with strokes of this width: about 6 stroke widths, hence 7 from one end of the line to the other; or as
 * many widths of the lines that it interrupts, if they are up to 4 times as broad.  Hairlines: 16 pixels, in a picture
 * of this size 24 from 1 megapixel on. */
CeldGapLength celd_longest_gap (int stroke, int width, int height);

/* Fills in `cut`: the edges at which ink cuts depth, and the gaps that hold it.  A gap is a boundary of levels on paper
 * that meets ink and has no more than this length.  Where `borders` (NULL: nowhere), the ink for segmentation, is ink
 * within the radius, but that of `edges` is not, depth stays smooth.  cut of `edges` must be NULL. */
CeldStatus celd_gaps_hold (const CeldDepthEdges *edges, const CeldPlane *borders, const float *level,
                           CeldGapLength longest, const CeldHost *host, uint8_t *cut);

/* The edges of levels for a drawing with strokes of this width, with the threshold of the settings.  With
 * settings->hold_gaps gaps are cut, too: `cut` is then allocated, and has to be freed even after a failure; else it is
 * NULL.  `borders` is as for celd_gaps_hold. */
CeldStatus celd_depth_edges (const CeldPlane *ink, const CeldPlane *borders, const float *level, int stroke,
                             const CeldSettings *settings, const CeldHost *host, CeldDepthEdges *edges, uint8_t **cut);

/* ------------------------------------------------------------------ levels: smooth.c */

/* Copies levels to a tight plane of finite numbers: NaN and infinity read as the farthest level, -0 as 0. */
void celd_depth_levels (const CeldPlane *levels, float *level);

/* ------------------------------------------------------------------ boxed-solver.c: components */

/* Pixels x .. end - 1 of a row, each connected to the next. */
typedef struct { int x, end; uint32_t component; } CeldPixelRun;

/* Connected components 0 .. n-1, in reading order of their first pixels. */
typedef struct
{
  int           width, height;
  size_t       *row;            /* the runs of row y are run[row[y]] .. run[row[y+1] - 1], from left to right */
  CeldPixelRun *run;
  size_t        n;
  size_t        run_capacity;
} CeldRunComponents;

/* Finds the components of the pixels that are not fixed (`fixed` NULL: of all), 4-connected across edges with v_pq > 0;
 * with `edges` NULL across those where levels are equal.  Makes the record. */
CeldStatus celd_run_components_find (int width, int height, const float *level, const uint8_t *fixed,
                                     const CeldDepthEdges *edges, const CeldHost *host, CeldRunComponents *components);
void celd_run_components_clear (CeldRunComponents *components); /* accepts a zeroed record */

/* The component of pixel (x,y), which must be in one. */
uint32_t celd_run_component_at (const CeldRunComponents *components, int x, int y);

/* Whether any pixel of this run of row y is 1 in `mark`, of the size of the picture. */
bool celd_run_marked (const CeldRunComponents *components, const CeldPixelRun *run, int y, const uint8_t *mark);

/* Loops over every run `s` of the rows y = from .. end - 1. */
#define CELD_EACH_RUN(components, from, end, y, s) \
  for (int y = (from); y < (end); y++) \
    for (const CeldPixelRun *s = (components)->run + (components)->row[y], \
         *end_ = (components)->run + (components)->row[y + 1]; s < end_; s++)

/* ------------------------------------------------------------------ boxed-solver.c: systems of components */

/* Extends a bounding box by a run of row y; a box of width 0 is empty. */
void celd_box_add_run (CeldRect *box, const CeldPixelRun *run, int y);

/* Groups n boxes, such that boxes in one group are cheaper to process together; an empty one gets CELD_NO_GROUP.
 * bounds[g] is the bounding box of group g; returns the number of groups. */
#define CELD_NO_GROUP    UINT32_MAX
#define CELD_MOST_GROUPS 32
size_t celd_boxes_group (const CeldRect *box, size_t n, uint32_t *group, CeldRect bounds[CELD_MOST_GROUPS]);

/* The Laplacian system of one group's components in their bounding box, zero before it is written.  Planes have
 * rect.width x rect.height pixels. */
typedef struct
{
  CeldRect                 rect;
  const CeldRunComponents *components;
  const uint32_t          *group_of;     /* of each component */
  uint32_t                 group;
  size_t                   n;            /* pixels */
  float                   *east, *south, *diagonal, *b, *x;
} CeldBox;

/* The index of pixel (x,y) of the picture in the planes of the box. */
static inline size_t
celd_box_pixel (const CeldBox *box, int x, int y)
{
  return (size_t) (y - box->rect.y) * (size_t) box->rect.width + (size_t) (x - box->rect.x);
}

/* Loops over every run `s` of the components that are solved in the box. */
#define CELD_EACH_BOX_RUN(box, y, s) \
  CELD_EACH_RUN ((box)->components, (box)->rect.y, (box)->rect.y + (box)->rect.height, y, s) \
    if ((box)->group_of[s->component] == (box)->group)

/* What to solve: the components whose bounds are not empty. */
typedef struct
{
  const CeldRunComponents *components;
  const CeldRect          *bounds;       /* of each component */
  double (*write) (const void *data, CeldBox *box); /* fills in the system and the start x; returns the tolerance */
  void   (*read)  (void *data, const CeldBox *box, CeldSolve *solve); /* takes x; may rescale solve->error */
  void    *data;
} CeldBoxedSystem;

/* Lowers *worst to the worse of two results, member by member; start it as converged. */
void celd_solve_join (CeldSolve *worst, const CeldSolve *one);

/* Solves all groups one after the other; *solve is the worst of their results. */
CeldStatus celd_boxed_solve (const CeldBoxedSystem *system, const CeldHost *host, CeldSolve *solve);

/* ------------------------------------------------------------------ cores.c */

enum { CELD_FREE, CELD_ANCHOR, CELD_CORE };                   /* values of `fixed` */

/* Marks the cores of regions without an anchor in `fixed`.  Regions of fewer pixels than `speck` get none.  `changed`
 * (NULL: everything) marks the pixels whose level, or a neighbour's, is not what it was when `last` was made; cores of
 * regions without such a pixel are copied from there. */
CeldStatus celd_cores_mark (int width, int height, const float *level, size_t speck, const uint8_t *changed,
                            const uint8_t *last, const CeldHost *host, uint8_t *fixed);

/* ------------------------------------------------------------------ smooth-equations.c */

/* Minimize  sum v_pq (d_p - d_q)^2  with d = level at the fixed pixels. */
typedef struct
{
  int            width, height;
  const float   *level;         /* of every pixel, finite */
  const uint8_t *fixed;         /* not 0: depth is the level there */
  CeldDepthEdges edges;
  const uint8_t *changed;       /* marks the pixels whose equation is new; NULL: all are */
  const float   *last;          /* the solution before; where to start from if `changed` is NULL (NULL: from levels) */
  double         tolerance;     /* largest error of depth as a share of `range` */
  double         range;         /* largest minus least level */
} CeldSmoothEquations;

/* Fills in `depth`, which is undefined after a failure.  Components without a new equation keep the last solution. */
CeldStatus celd_smooth_equations_solve (const CeldSmoothEquations *equations, const CeldHost *host, float *depth,
                                        CeldSolve *solve);

/* ------------------------------------------------------------------ smooth.c */

/* What smooth depth was last made from; 6 bytes a pixel.  Starts as zero. */
typedef struct
{
  int      width, height;
  float   *level;               /* NULL: nothing is kept */
  uint8_t *fixed;
  uint8_t *cut;                 /* as in CeldDepthEdges; NULL: gaps did not hold */
  float    threshold;
  double   error;               /* largest error that depth was allowed, in the unit of the levels */
  int      radius;
  CeldRect new_ink;             /* where the ink has changed since then: set by the caller */
} CeldSmoothState;

typedef struct
{
  const CeldPlane    *ink, *levels;
  const CeldPlane    *borders;  /* as for celd_gaps_hold */
  const CeldMask     *anchors;  /* NULL: none */
  const CeldSettings *settings;
  int                 radius;   /* celd_edge_radius of the ink */
  CeldGapLength       gap;      /* of the longest that holds depth */
  size_t              speck;    /* least pixels of a region that is held by its core, as CELD_SPECK */
  const float        *last;     /* the depth that the state belongs to; NULL: none */
} CeldSmoothInput;

/* Smooth depth as celd_smooth; makes the plane.  `state` (may be NULL) remembers what it was made from: the next time,
 * depth stays bit by bit the same in components that nothing changed, and starts from the last depth elsewhere. */
CeldStatus celd_smooth_update (CeldSmoothState *state, const CeldSmoothInput *input, const CeldHost *host,
                               CeldPlane *depth, CeldSolve *solve);
void celd_smooth_state_clear (CeldSmoothState *state);        /* accepts a zeroed record */

/* ------------------------------------------------------------------ exact-bases.c: one basis for each node */

/* A node is a set of pixels of equal depth: a scribble, or the single pixel of a relation's end off every scribble.
 * The harmonic basis h_k of node k is 1 on its pixels, 0 on those of other nodes, and harmonic elsewhere: the
 * probability that a random walker from there reaches node k first.  The bases add up to 1, so that of node 1 is not
 * stored.  d = sum of u_k h_k is the depth of least energy with the value u_k on each node k. */
typedef struct
{
  int          width, height;
  const float *east, *south;    /* weights, borrowed */
  uint32_t    *node;            /* of each pixel, from 1; 0 in none */
  uint32_t     n, n_sets;       /* nodes; the first n_sets may have many pixels, the others have one */
  size_t      *pixel;           /* of node n_sets + 1 + i; grown one by one */
  float      **group;           /* of CELD_LANES bases each, interleaved: h_k (p), k > 1, is lane
                                 * (k - 2) % CELD_LANES of pixel p in group[(k - 2) / CELD_LANES] */
  size_t       n_groups;
  double      *stiffness;       /* n x n: K_kl = sum over edges of w_pq (h_k(p) - h_k(q)) (h_l(p) - h_l(q)) */
  size_t       pixel_capacity, group_capacity;
} CeldHarmonicBases;

/* Makes bases and stiffness for the nodes given by `node`, a tight plane of 0 .. n_sets, and the pixels point[i], which
 * must be distinct and in no node; at least one node must have a pixel.  Bases are exactly 1 and 0 on the nodes,
 * elsewhere within the tolerance.  The solver starts from the present bases, if any; before the first call `bases`
 * needs width, height and weights.  After a failure there are no nodes. */
CeldStatus celd_bases_make (CeldHarmonicBases *bases, const uint32_t *node, uint32_t n_sets, const size_t *point,
                            size_t n_points, double tolerance, const CeldHost *host, CeldSolve *solve);

/* Removes all nodes; size and weights stay. */
void       celd_bases_clear (CeldHarmonicBases *bases);

/* depth = sum of u_k h_k, clamped to the least and largest u_k; u has n numbers, depth the size of the bases. */
CeldStatus celd_bases_compose (const CeldHarmonicBases *bases, const double *u, const CeldHost *host, CeldPlane *depth);

/* For exact-nodes.c: the first lane of the basis of a node other than 1; the groups that n nodes need. */
static inline float *
celd_bases_lane (const CeldHarmonicBases *b, uint32_t node)
{
  return b->group[(node - 2) / CELD_LANES] + (node - 2) % CELD_LANES;
}

static inline size_t
celd_bases_groups (uint32_t n)
{
  return n > 1 ? (n - 2) / CELD_LANES + 1 : 0;
}

/* Adds groups, with bases of 0, until there are n_groups; removes groups until there are n_groups. */
CeldStatus celd_bases_grow (CeldHarmonicBases *b, size_t n_groups);
void       celd_bases_shrink (CeldHarmonicBases *b, size_t n_groups);

/* Sets up a solver with the pixels of all nodes fixed; freed with celd_lap_free. */
CeldStatus celd_bases_set_up (const CeldHarmonicBases *b, const CeldHost *host, CeldLaplace **laplace);

/* ------------------------------------------------------------------ exact-nodes.c */

/* Adds a node for each of these pixels, which must be in none: one solution each.  After a failure the nodes are as
 * before. */
CeldStatus celd_bases_add (CeldHarmonicBases *bases, const size_t *point, size_t n_points, double tolerance,
                           const CeldHost *host, CeldSolve *solve);

/* Removes a node of one pixel, other than node 1, without a solution.  The last node takes its number. */
void       celd_bases_drop (CeldHarmonicBases *bases, uint32_t node);

/* ------------------------------------------------------------------ exact-stiffness.c */

/* Fills in the stiffness matrix: the energies of pairs of bases as they are.  So an inexact basis raises the energy of
 * the result to second order, but never violates a constraint. */
CeldStatus celd_stiffness (CeldHarmonicBases *bases, const CeldHost *host);

/* The energies of another basis, a tight plane, with each of the n bases and with itself.  `room` is work space of
 * celd_stiffness_room (n) numbers. */
void       celd_stiffness_of (const CeldHarmonicBases *bases, const float *basis, const CeldHost *host, double *room,
                              double *with, double *own);
size_t     celd_stiffness_room (size_t n);

/* ------------------------------------------------------------------ exact-kept.c, exact-program.c */

/* The right (down 0) or lower edge of a pixel that a gap holds, and its weight by the ink. */
typedef struct { size_t pixel; int down; float weight; } CeldHeldEdge;

/* A drawing, its scribbles, and what was solved for them, for reuse after edits. */
typedef struct
{
  const CeldPlane  *ink;         /* borrowed */
  float            *east, *south;
  CeldHeldEdge     *held;        /* where these are not those of the ink, because a gap holds depth */
  size_t            n_held;
  double            sigma;
  int               stroke;      /* width of the strokes of the ink; -1: not measured yet */
  CeldLabels        nodes;       /* the scribbles; data NULL: none yet */
  CeldPalette       palette;     /* of the nodes */
  uint32_t         *label;       /* of each node: its label as the caller numbers them */
  bool              stale;       /* the nodes are not those of the bases */
  CeldHarmonicBases bases;
  double            tolerance;   /* that the bases were made to */
  CeldSolve         solve;       /* how that went */
} CeldProgram;

CeldProgram *celd_program_new (void);                      /* NULL: no memory */
void         celd_program_free (CeldProgram *program);     /* accepts NULL */

/* Sets the drawing, and discards what was solved.  The ink is borrowed: it must stay as it is until this function is
 * called again or the program is freed.  After a failure there is no drawing. */
CeldStatus celd_program_set_ink (CeldProgram *program, const CeldPlane *ink, const CeldSettings *settings,
                                 const CeldHost *host);

/* Sets the scribbles, which have the size of the ink and are copied; the ink must be set.  The next solution starts
 * from what was solved before. */
CeldStatus celd_program_set_seeds (CeldProgram *program, const CeldLabels *seeds, const CeldPalette *palette,
                                   CeldSameColour same_colour, const CeldHost *host);

/* Gives the least weight to edges where a gap in the ink lies between two of these regions (tight, of the size of the
 * ink; NULL: to none), and all others the weight of the ink.  `borders` is as for celd_gaps_hold.  The ink and the
 * scribbles must be set.  After a failure the weights are as before. */
CeldStatus celd_program_hold_gaps (CeldProgram *program, const CeldLabels *regions, const CeldPlane *borders,
                                   const CeldSettings *settings, const CeldHost *host);

/* Finds the pixel for the end of a relation at (x,y): the pixel there or, on ink, the nearest paper within one stroke
 * width; *pixel = y * width + x.  False if the point is outside the drawing. */
bool celd_program_find (CeldProgram *program, double x, double y, size_t *pixel);

/* Makes each of these pixels a node, unless it is on a scribble, and updates bases and stiffness with as few solutions
 * as possible. */
CeldStatus celd_program_place (CeldProgram *program, const size_t *point, size_t n_points, double tolerance,
                               const CeldHost *host);

/* As celd_depth_exact; of the settings only encoding, tolerance and on_cycle matter. */
CeldStatus celd_program_solve (CeldProgram *program, const CeldRelations *relations, const CeldSettings *settings,
                               const CeldHost *host, CeldPlane *depth, CeldExact *exact, CeldProblems *problems);

#endif
