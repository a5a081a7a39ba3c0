/* What the files of core share among themselves.  Nothing here is exported.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_PRIVATE_H
#define CELD_PRIVATE_H

#include "celdepth.h"

#include <string.h>

/* ------------------------------------------------------------------ memory.c */

/* All allocation in core goes through these two; NULL when count x size overflows or is refused. */
void *celd_alloc (size_t count, size_t size);                 /* not cleared */
void *celd_alloc0 (size_t count, size_t size);                /* cleared */
void *celd_grow (void *items, size_t count, size_t size);     /* to `count` items, one more than before; doubles */
void  celd_free (void *memory);                               /* accepts NULL */

CeldStatus celd_plane_new (int width, int height, CeldPlane *plane);     /* not cleared; end with celd_free (data) */
CeldStatus celd_labels_new (int width, int height, CeldLabels *labels);  /* cleared */
CeldStatus celd_mask_new (int width, int height, CeldMask *mask);        /* cleared */

CeldStatus celd_ownership_new (int width, int height, CeldOwnership *own); /* labels cleared, shares not */
void       celd_ownership_clear (CeldOwnership *own);                     /* also what was made by half */

CeldStatus celd_problem_add (CeldProblems *problems, CeldProblem problem); /* problems NULL: nothing to do */
CeldStatus celd_relation_add (CeldRelations *relations, CeldRelation relation);

static inline bool
celd_term_same (const CeldTerm *a, const CeldTerm *b)
{
  return a->by_colour == b->by_colour && !memcmp (a->colour, b->colour, 3) && a->x == b->x && a->y == b->y;
}


/* ------------------------------------------------------------------ views */

/* The pixel (x,y) of any view that has one element a pixel. */
#define CELD_AT(view, x, y) ((view)->data[(size_t) (y) * (view)->stride + (size_t) (x)])

/* First byte or float of the pixel (x,y) of a CeldPaint or CeldColours. */
#define CELD_RGBA(view, x, y) ((view)->data + 4 * ((size_t) (y) * (view)->stride + (size_t) (x)))

/* First float of the pixel (x,y) of a CeldVectors. */
#define CELD_XYZ(view, x, y) ((view)->data + 3 * ((size_t) (y) * (view)->stride + (size_t) (x)))

/* Are both views present, of a legal size, and equally large? */
#define CELD_SAME_SIZE(a, b) \
  ((a)->data && (b)->data && (a)->width == (b)->width && (a)->height == (b)->height && \
   (a)->width > 0 && (a)->height > 0 && (a)->width <= CELD_MAX_SIDE && (a)->height <= CELD_MAX_SIDE)

/* The smallest rectangle round both; one of width 0 is none. */
static inline CeldRect
celd_rect_union (CeldRect a, CeldRect b)
{
  int left, top, right, bottom;

  if (!a.width || !b.width)
    return a.width ? a : b;
  left   = a.x < b.x ? a.x : b.x;
  top    = a.y < b.y ? a.y : b.y;
  right  = a.x + a.width > b.x + b.width ? a.x + a.width : b.x + b.width;
  bottom = a.y + a.height > b.y + b.height ? a.y + a.height : b.y + b.height;
  return (CeldRect) { left, top, right - left, bottom - top };
}

/* ------------------------------------------------------------------ vectors */

/* Before a static function, a plain loop over pixels: compiled for wider vectors too, and chosen when the library is
 * loaded.  Its name is unique in core, and it is called in its own file: clang makes the chosen one global under
 * another name.  The resolver runs before sanitizers are ready. */
#if defined __has_feature
#if __has_feature (address_sanitizer) || __has_feature (undefined_behavior_sanitizer) \
  || __has_feature (thread_sanitizer)
#define CELD_CLONES
#endif
#endif
#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__
#define CELD_CLONES
#endif
#ifndef CELD_CLONES
#if defined __x86_64__ && defined __ELF__ && defined __GNUC__
#define CELD_CLONES __attribute__ ((target_clones ("avx2", "default")))
#else
#define CELD_CLONES
#endif
#endif

/* Fetches what will be read soon. */
#if defined __GNUC__
#define CELD_PREFETCH(address) __builtin_prefetch (address)
#else
#define CELD_PREFETCH(address) ((void) (address))
#endif

/* The first of the bytes x .. n - 1 that has its top bit set; n if none has. */
static inline int
celd_next_marked (int n, const uint8_t *byte, int x)
{
  uint64_t eight;

  for (; x + 8 <= n; x += 8)
    {
      memcpy (&eight, byte + x, sizeof eight);
      eight &= 0x8080808080808080;
      if (!eight)
        continue;
#if defined __GNUC__ && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
      return x + __builtin_ctzll (eight) / 8;
#else
      break;
#endif
    }
  while (x < n && byte[x] < 0x80)
    x++;
  return x;
}

/* ------------------------------------------------------------------ progress and threads (run.c) */

/* The part [from,to] of a longer run, as a run of its own: `part` must outlive it.  With from = to it reports no
 * progress, but cancels and lends threads: for short steps, of which several may share it. */
typedef struct { const CeldRun *whole; double from, to; } CeldPart;
CeldRun celd_run_part (CeldPart *part, const CeldRun *whole, double from, double to);

/* Reports progress; CELD_CANCELLED when the host wants to stop. */
CeldStatus celd_step (const CeldRun *run, double done);

/* body (data, 0 .. n-1), on the host's threads if it lends any. */
void celd_each (const CeldRun *run, int n, void (*body) (void *data, int i), void *data);

/* n jobs in rounds of at most `at_once`, which is the part [from,to] of the run: body (data, i) is job *first + i. */
CeldStatus celd_rounds (const CeldRun *run, int n, int at_once, void (*body) (void *data, int i), void *data,
                        int *first, double from, double to);

/* ------------------------------------------------------------------ paper.c: what a drawing was made with */

/* The mode that CELD_INK_AUTO stands for; any other mode itself, but for CELD_INK_ALPHA of an opaque picture. */
CeldInkMode celd_ink_mode (const CeldDrawing *drawing, CeldInkMode mode);

/* One value a pixel, 1 = bright paper, 0 = full ink, in a mode that is not CELD_INK_AUTO; of the drawing's size. */
void celd_ink_values (const CeldDrawing *drawing, CeldInkMode mode, CeldPlane *value);

/* The level of the paper round each pixel, on the scale of the values, > 0. */
CeldStatus celd_paper_levels (const CeldPlane *value, CeldPlane *paper);

/* ------------------------------------------------------------------ maxflow.c: grid max-flow */

/* Minimum cut of a 4-connected grid, exact.  Knows nothing of pictures: nodes are pixels of the grid, capacities
 * symmetric.  east[i]: between node i and its right neighbour (last column ignored); south[i]: below (last row too).
 * terminal[i] > 0: capacity from the source; < 0: capacity to the sink.  side[i] becomes 1 where the node is reachable
 * from the source in the residual graph, 0 elsewhere.  *flow (may be NULL) is the cut's value. */
CeldStatus celd_maxflow (int width, int height, const int32_t *east, const int32_t *south, const int32_t *terminal,
                         const CeldRun *run, uint8_t *side, int64_t *flow);

/* ------------------------------------------------------------------ ink as the regions see it */

/* Is this value of ink paper rather than ink?  NaN is. */
static inline bool
celd_is_paper (float ink)
{
  return !(ink < 0.5f);
}

/* stroke.c: the median length of the runs of ink along rows and columns, in pixels; 0 without ink, at most 256.
 * Solid black areas hardly count. */
int celd_stroke_width (const CeldPlane *ink);

/* Moves (*x,*y) to the nearest paper, itself if it is paper; false if there is none within `reach` pixels. */
bool celd_paper_near (const CeldPlane *ink, int reach, int *x, int *y);

/* frame.c: the paper pixels along the frame, as y * width + x (ink NULL: all outermost pixels); corners may come twice.
 * `stroke` is the width of the drawing's strokes; 0: it is measured if need be.  End with celd_free. */
CeldStatus celd_frame (const CeldPlane *ink, int width, int height, int stroke, size_t **pixel, size_t *n);

/* ------------------------------------------------------------------ labels.c */

/* Fills in the area of each label and a pixel of it as far as can be from ink (may be NULL) and other labels; -1,-1 for
 * labels without a pixel. */
CeldStatus celd_palette_measure (const CeldLabels *labels, const CeldPlane *ink, const CeldRun *run,
                                 CeldPalette *palette);

/* A copy that celd_grow can make larger; makes the record. */
CeldStatus celd_palette_copy (const CeldPalette *palette, CeldPalette *copy);

/* The first opaque label of this colour, or of the nearest one that colour management may have made of it (2 of 255 a
 * channel); 0 if there is none. */
uint32_t celd_palette_find (const CeldPalette *palette, const uint8_t colour[3]);

/* ------------------------------------------------------------------ multiway.c: many labels on a grid */

#define CELD_HARD INT32_MAX /* a vote that is always obeyed */

typedef struct
{
  int             width, height;
  const int32_t  *east, *south; /* V_pq > 0, as in celd_maxflow */
  const uint32_t *seed;         /* painted label of each pixel, 0 = none */
  const int32_t  *vote;         /* of label l: vote[l - 1], what one of its painted pixels costs with another label */
  const uint32_t *order;        /* all labels, in the order in which they are told apart from the rest */
  size_t          n_labels;     /* at least 1 */
} CeldMultiway;

/* Gives every pixel with label[p] == 0 a label.  Others keep theirs; of these only hard seeds matter to the rest. */
CeldStatus celd_multiway (const CeldMultiway *problem, const CeldRun *run, uint32_t *label);

/* ------------------------------------------------------------------ laplace.c: the one Laplacian solver */

/* The system  A x = b  on the 4-grid, with  (A x)_p = diagonal_p x_p + sum over neighbours q of w_pq (x_p - x_q).
 * east, south: edge weights (last column / last row ignored), 1e-6 .. 1 of the largest or 0; what is not a positive
 * number is 0, in the diagonal, too.  b, starts and fixed values are finite.  Zero weights make walls and masks, and
 * edges over the frame do not exist (Neumann).  Components without any diagonal or fixed pixel are floating: they
 * keep the mean of their start. */
typedef struct CeldLaplace CeldLaplace;

/* Prescribes x_p = value_p where fixed_p: folds their couplings into diagonal and b and cuts the edges.
 * b and value hold nrhs planes one behind the other. */
void celd_lap_pin (int width, int height, const uint8_t *fixed, int nrhs, const float *value,
                   float *east, float *south, float *diagonal, float *b);

/* Set-up once per weights; nothing is borrowed beyond it.  fixed (may be NULL): pixels whose x is prescribed
 * (Dirichlet), by the x that each solution starts from; there b and diagonal are not read.  diagonal may be NULL: 0. */
CeldStatus celd_lap_setup (int width, int height, const float *east, const float *south, const float *diagonal,
                           const uint8_t *fixed, const CeldRun *run, CeldLaplace **laplace);
/* Solves for nrhs right-hand sides, planes one behind the other.  x: start in, result out (also when cancelled).
 * tolerance: largest error |x - x*| as a share of the range of x, estimated from the preconditioned residual. */
CeldStatus celd_lap_solve (CeldLaplace *laplace, int nrhs, const float *b, float *x, double tolerance,
                           const CeldRun *run, CeldSolve *solve);
/* Solves for CELD_LANES right-hand sides at once, much faster than one by one: lane k of pixel p is at
 * p * CELD_LANES + k, in b (NULL: 0 everywhere) as in x; lanes that are 0 everywhere are done at once.
 * Stops when every lane is within the tolerance, or after `most` rounds (0: no limit), for a preview; solve (may be
 * NULL) has the worst lane. */
#define CELD_LANES 8
CeldStatus celd_lap_solve_lanes (CeldLaplace *laplace, const float *b, float *x, double tolerance, int most,
                                 const CeldRun *run, CeldSolve *solve);
void celd_lap_free (CeldLaplace *laplace);                    /* accepts NULL */

/* ------------------------------------------------------------------ distance.c: exact Euclidean distance transform */

/* squared[p] = squared distance from the centre of p to the centre of the nearest pixel q with inside (q) != 0;
 * INT32_MAX if there is none.  Tight planes of width x height; their content is undefined after a cancel. */
CeldStatus celd_distance (int width, int height, const uint8_t *inside, const CeldRun *run, int32_t *squared);
/* The same, and the index y * width + x of that nearest pixel (ties: any, but always the same one); -1 if none. */
CeldStatus celd_nearest (int width, int height, const uint8_t *inside, const CeldRun *run, int32_t *squared,
                         int32_t *nearest);
/* signed-distance.c: of paper the squared distance to the nearest ink, of ink minus that to the nearest paper.  One
 * tight plane of the size of the ink, which decides by celd_is_paper; INT32_MAX and -INT32_MAX where there is none. */
CeldStatus celd_signed_distance (const CeldPlane *ink, const CeldRun *run, int32_t *squared);

/* ------------------------------------------------------------------ components.c: connected components */

typedef struct
{
  uint32_t label;                    /* of its pixels in the input */
  int      x, y;                     /* its first pixel in reading order */
  int      left, top, right, bottom; /* inclusive */
  size_t   area;
} CeldComponent;

/* 4- or 8-connected components of equal labels.  Pixels of label `none` (pass UINT32_MAX for no such label) get
 * component 0; others 1 .. n in reading order of their first pixel.  *list has n items, item k-1 is component k;
 * end it with celd_free.  `components` may alias `labels`. */
CeldStatus celd_components (const CeldLabels *labels, uint32_t none, bool diagonal, const CeldRun *run,
                            CeldLabels *components, CeldComponent **list, size_t *n);

/* ------------------------------------------------------------------ smooth.c, depth-weights.c: where depth is cut */

/* Levels as a tight plane; what is not finite reads as the farthest level. */
void celd_depth_levels (const CeldPlane *levels, float *level);

/* Connected regions of one level, as celd_components gives them. */
CeldStatus celd_depth_regions (int width, int height, const float *level, const CeldRun *run, CeldLabels *regions,
                               CeldComponent **list, size_t *n);

/* Edge weights v_pq of eq. (3) for celd_lap_setup: 1 where levels are equal, 0 across a depth discontinuity, else the
 * least ink around.  `level` is a tight plane of the size of the ink. */
CeldStatus celd_depth_weights (const CeldPlane *ink, const float *level, float threshold, const CeldRun *run,
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
