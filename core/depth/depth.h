/* What the files of smooth depth share: eq. (3) taken apart, and what is kept of it between edits.
 *
 *   depth-weights.c   where depth is cut
 *   depth-parts.c     what hangs together
 *   depth-cores.c     which pixels hold a region that has no anchor
 *   depth-solve.c     the parts in which depth is not constant
 *   smooth.c          the step
 *   session/stage-depth.c  a session's depth and its preview
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_DEPTH_H
#define CELD_DEPTH_H

#include "image/image.h"

/* ------------------------------------------------------------------ depth-weights.c */

/* What decides v_pq where levels differ: the least ink as far as `reach` round both pixels, which counts as 0 at or
 * below the threshold. */
typedef struct { const CeldPlane *ink; float threshold; int reach; } CeldEdges;

/* How far ink matters in a drawing with strokes of this width. */
int celd_edge_reach (int stroke);

/* v_pq of the pixel (x,y) and its right (right 1, down 0) or lower neighbour (0, 1), which lies in the picture; the
 * first function is for levels that differ. */
float celd_edge_across (const CeldEdges *edges, int x, int y, int right, int down);

static inline float
celd_edge_weight (const CeldEdges *edges, const float *level, int x, int y, int right, int down)
{
  const float *here = level + (size_t) y * (size_t) edges->ink->width + (size_t) x;

  return here[0] == here[right ? 1 : edges->ink->width] ? 1 : celd_edge_across (edges, x, y, right, down);
}

/* ------------------------------------------------------------------ depth-parts.c */

/* Pixels x .. end - 1 of a row, each joined to the next. */
typedef struct { int x, end; uint32_t part; } CeldStretch;

/* Connected parts, 0 .. n-1 in reading order of their first pixels. */
typedef struct
{
  int          width, height;
  size_t      *row;             /* the stretches of row y are stretch[row[y]] .. stretch[row[y+1] - 1] */
  CeldStretch *stretch;
  size_t       n;
} CeldParts;

/* What is joined: pixels that are not fixed (NULL: none is), across edges where v_pq > 0; with edges NULL where levels
 * are equal.  Tight planes. */
CeldStatus celd_parts_find (int width, int height, const float *level, const uint8_t *fixed, const CeldEdges *edges,
                            const CeldHost *host, CeldParts *parts);
void celd_parts_clear (CeldParts *parts);                     /* accepts a zeroed record */

/* Is any pixel of the stretch of row y marked? */
bool celd_stretch_marked (const CeldParts *parts, const CeldStretch *stretch, int y, const uint8_t *mark);

/* The smallest box of boxes[k] and the stretch; width 0: nothing yet. */
void celd_box_add (CeldRect *box, const CeldStretch *stretch, int y);

/* Puts n boxes into groups of such as are cheaper gone through together; a box of width 0 gets CELD_NO_GROUP.
 * bounds[g] is the box of group g; returns how many there are. */
#define CELD_NO_GROUP   UINT32_MAX
#define CELD_MOST_GROUPS 32
size_t celd_boxes_group (const CeldRect *box, size_t n, uint32_t *group, CeldRect bounds[CELD_MOST_GROUPS]);

/* ------------------------------------------------------------------ depth-cores.c */

enum { CELD_FREE, CELD_ANCHOR, CELD_CORE };                   /* what a pixel of `fixed` may be */

/* Marks the cores of regions without an anchor in `fixed`.  Regions of fewer pixels than `speck` have none.  `changed`
 * (NULL: everything) are the pixels whose level or whose neighbour's level is not what it was when `last` was made:
 * cores that lie elsewhere are taken from there. */
CeldStatus celd_cores_mark (int width, int height, const float *level, size_t speck, const uint8_t *changed,
                            const uint8_t *last, const CeldHost *host, uint8_t *fixed);

/* ------------------------------------------------------------------ depth-solve.c */

typedef struct
{
  int            width, height;
  const float   *level;         /* of every pixel, finite */
  const uint8_t *fixed;         /* which keep theirs */
  CeldEdges      edges;
  const uint8_t *changed;       /* pixels of whose equation anything is new; NULL: of all */
  const float   *last;          /* depth before, where `changed` is not NULL; else a start, or NULL */
  double         tolerance, range; /* largest error of depth, as a share of that range */
} CeldSystem;

/* All of `depth`, which is tight.  On failure it is undefined. */
CeldStatus celd_system_solve (const CeldSystem *system, const CeldHost *host, float *depth, CeldSolve *solve);

/* ------------------------------------------------------------------ smooth.c */

/* What smooth depth was made from last; 5 bytes a pixel. */
typedef struct
{
  int      width, height;
  float   *level;               /* NULL: nothing is known */
  uint8_t *fixed;
  float    threshold;
  double   error;               /* within which it was made, in the unit of the levels */
  int      reach;
  CeldRect new_ink;             /* where the ink has changed since; the owner of the ink says so */
} CeldSmoother;

typedef struct
{
  const CeldPlane    *ink, *levels;
  const CeldMask     *anchors;  /* NULL: none */
  const CeldSettings *settings;
  int                 reach;    /* as celd_edge_reach has it */
  size_t              speck;    /* smaller regions hold nothing */
  const float        *last;     /* tight; the depth that `smoother` tells of; NULL if there is none */
} CeldSmoothing;

/* As celd_smooth; makes the plane.  `smoother` (NULL: nothing is kept) remembers it: where nothing changed since, depth
 * is the last one bit by bit, elsewhere it starts from that. */
CeldStatus celd_smooth_again (CeldSmoother *smoother, const CeldSmoothing *smoothing, const CeldHost *host,
                              CeldPlane *depth, CeldSolve *solve);
void celd_smoother_clear (CeldSmoother *smoother);            /* accepts a zeroed record */

#define CELD_SPECK 16           /* pixels of a region that is not held, as in celd_separate */

/* ------------------------------------------------------------------ smooth.c, depth-weights.c: where depth is cut */

/* Levels as a tight plane; what is not finite reads as the farthest level. */
void celd_depth_levels (const CeldPlane *levels, float *level);

/* Connected regions of one level, as celd_components gives them. */
CeldStatus celd_depth_regions (int width, int height, const float *level, const CeldHost *host, CeldLabels *regions,
                               CeldComponent **list, size_t *n);

/* Edge weights v_pq of eq. (3) for celd_lap_setup: 1 where levels are equal, 0 across a depth discontinuity, else the
 * least ink around.  `level` is a tight plane of the size of the ink. */
CeldStatus celd_depth_weights (const CeldPlane *ink, const float *level, float threshold, const CeldHost *host,
                               float *east, float *south);

/* ------------------------------------------------------------------ way-round.c */

/* Which pixels are joined to their right and lower neighbours: a bit each, rows of so many words. */
typedef struct { int height; size_t words; uint64_t *east, *south; } CeldJoined;

/* By weights above 0, as in celd_lap_setup. */
CeldStatus celd_joined_new   (int width, int height, const float *east, const float *south, CeldJoined *joined);
void       celd_joined_clear (CeldJoined *joined);           /* also what was made by half */

/* Is there a short way from the pixel (x,y) to its right, or else its lower neighbour? */
bool       celd_way_round    (const CeldJoined *joined, int x, int y, bool down);

#endif
