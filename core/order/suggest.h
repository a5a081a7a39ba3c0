/* What the files that suggest an order from the drawing share.
 *
 *   outlines.c           the outlines of all regions' surfaces
 *   t-junctions.c    where three regions meet, and which outline runs on there without a corner: the bar of a T
 *   suggest-cues.c   what the drawing says of each pair of regions that touch
 *   suggest.c        a direction and a confidence for each, without contradictions
 *   suggest-depth.c  the same from a depth picture
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_SUGGEST_H
#define CELD_SUGGEST_H

#include "base/base.h"

/* ------------------------------------------------------------------ outlines.c */

#define CELD_FACES_FRAME   UINT32_MAX
#define CELD_SHORTEST_MARK 6 /* stroke widths along a line inside a surface, there and back */

/* A place on the outline of a surface, between two pixels; where ink begins, as exact as its antialiasing. */
typedef struct { float x, y; uint32_t faces; } CeldOutlinePoint; /* the label behind the ink there; 0 = none, only ink */

/* Closed, the surface on the right hand of who follows it. */
typedef struct { size_t first, n; uint32_t label; double length; } CeldOutlineLoop;

/* A region's surface is its paper; of a region that is hardly anything but ink, all of it. */
typedef struct
{
  int           width, height, stroke;
  uint32_t     *surface;        /* of each pixel: the label whose surface it is, 0 = contour; with a margin of 1 */
  size_t        stride;
  CeldOutlinePoint *point;
  size_t        n_points;
  CeldOutlineLoop  *loop;
  size_t        n_loops;
  size_t        point_capacity, loop_capacity;
} CeldRegionOutlines;

/* Labels above n_labels count as none.  ink may be NULL: then all is paper. */
CeldStatus celd_region_outlines_new (const CeldLabels *labels, size_t n_labels, const CeldPlane *ink, const CeldHost *host,
                          CeldRegionOutlines *outlines);
void       celd_region_outlines_clear (CeldRegionOutlines *outlines);                    /* accepts a zeroed record */

/* The label whose surface this pixel is, 0 off the picture. */
static inline uint32_t
celd_surface_at (const CeldRegionOutlines *outlines, int x, int y)
{
  return x < 0 || y < 0 || x >= outlines->width || y >= outlines->height
         ? 0 : outlines->surface[(size_t) (y + 1) * outlines->stride + (size_t) (x + 1)];
}

/* ------------------------------------------------------------------ t-junctions.c */

/* Where three regions meet, and how sharply the outline of each trials there: radians, > 0 = its corner is convex;
 * NaN if that cannot be told. */
typedef struct { float x, y; uint32_t label[3]; float turn[3]; } CeldJunction;

CeldStatus celd_junctions_find (const CeldLabels *labels, size_t n_labels, const CeldRegionOutlines *outlines, const CeldHost *host,
                                  CeldJunction **corners, size_t *n);

/* ------------------------------------------------------------------ suggest-cues.c */

/* What speaks for a, > 0, or for b, < 0, being in front. */
typedef enum
{
  CELD_CUE_BAR,         /* at junctions: a's outline runs on and b's has a corner; sum of log-odds */
  CELD_CUE_ENCLOSED,    /* share of a's outline that faces b, less that of b's that faces a */
  CELD_CUE_CONVEX,      /* 1: a bulges into b, 0: their border is straight */
  CELD_CUE_COMPACT,     /* of a less that of b; a disc has 1 */
  CELD_CUE_MARKS,       /* lines in b that end at the border with a, less those in a */
  CELD_CUE_FRAME,       /* 1: b has all of the frame, 0: neither has more than half of it */
  CELD_N_CUES
} CeldCue;

typedef struct
{
  uint32_t a, b;                /* labels, a < b */
  double   length;              /* of their border, pixels */
  double   cue[CELD_N_CUES];
  double   ax, ay, bx, by;      /* a place of each, well inside, near their border */
} CeldPairCues;

CeldStatus celd_cues_gather (const CeldLabels *labels, const CeldPalette *palette, const CeldPlane *ink,
                             const CeldHost *host, CeldPairCues **pairs, size_t *n);

/* ------------------------------------------------------------------ suggest-depth.c */

/* Log-odds of pairs[i].a being in front of pairs[i].b by a depth picture of the size of `labels`; 0 where it has no
 * depth of one of them.  ink may be NULL. */
CeldStatus celd_depth_odds (const CeldLabels *labels, const CeldPalette *palette, const CeldPlane *ink,
                            const CeldPlane *depth, const CeldPairCues *pairs, size_t n, double *odds);

/* ------------------------------------------------------------------ suggest.c */

/* The artist's relations, and behind them in the list those suggestions that do not contradict them (as far as
 * settings->on_cycle keeps them) or heavier suggestions; with settings->suggest = CELD_SUGGEST_FILL_GAPS only where the
 * artist's relations do not decide, directly or through others; with CELD_SUGGEST_OFF none.  Suggestions get weights
 * below all of the artist's.  Replaces `both`, which may be `relations`. */
CeldStatus celd_suggestions_join (const CeldLabels *labels, const CeldPalette *palette, const CeldRelations *relations,
                                  const CeldRelations *suggested, const CeldSettings *settings, const CeldPlane *ink,
                                  const CeldHost *host, CeldRelations *both);

#endif
