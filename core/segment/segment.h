/* What other themes use of the segmentation: a drawing segmented again as strokes change, and the smoothness cost.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_SEGMENT_H
#define CELD_SEGMENT_H

#include "image/image.h"

/* ------------------------------------------------------------------ segmenter.c: one drawing, kept between strokes */

typedef struct CeldSegmenter CeldSegmenter;

CeldSegmenter *celd_segmenter_new (void);                       /* NULL: no memory */
void           celd_segmenter_free (CeldSegmenter *segmenter);  /* accepts NULL */

/* Sets the drawing: line art (paper 1, ink 0) that the caller must keep unchanged until the next call of this function.
 * `changed` is where it differs from the previous drawing of the same size; NULL: everywhere.  Of the settings,
 * ink_threshold and close_gaps count, and must be the same in celd_segmenter_solve.  After a failure the segmenter has
 * no drawing: the next call starts from the beginning whatever `changed` says.  CELD_NO_MEMORY, CELD_CANCELLED,
 * CELD_BAD_SIZE. */
CeldStatus celd_segmenter_set_ink (CeldSegmenter *segmenter, const CeldPlane *ink, const CeldRect *changed,
                                   const CeldSettings *settings, const CeldHost *host);

/* Labels the drawing by these seeds (LazyBrush, section 3.2).  `palette`: in, that of the seeds; out, with the regions
 * that arrows made and the background behind them.  `labels` is a tight picture of the drawing's size, the caller's,
 * unchanged since the last call for this drawing (of any content the first time); *changed is where the call altered
 * it.  Problems are appended; NULL: not wanted.  The result depends on the drawing, the seeds, the relations and the
 * settings only, not on earlier calls.  CELD_NOTHING_TO_GO_BY if there is no seed.  After a failure the palette and the
 * problems are as before. */
CeldStatus celd_segmenter_solve (CeldSegmenter *segmenter, const CeldSeedRows *seeds, const CeldRelations *relations,
                                 const CeldSettings *settings, const CeldHost *host, CeldPalette *palette,
                                 CeldProblems *problems, CeldLabels *labels, CeldRect *changed);

/* The number of relations, counted from the first, that the last solve depends on: those after them changed nothing. */
size_t celd_segmenter_effective_relations (const CeldSegmenter *segmenter);

/* Would this relation, added after those of the last solve, change nothing (redundant-relations.c)?  `settings` and
 * `labels` are those of the last solve.  Also false where that is not known without solving. */
bool celd_segmenter_is_redundant (const CeldSegmenter *segmenter, const CeldRelation *relation,
                                  const CeldSettings *settings, const CeldLabels *labels);

/* The gaps that the last solve closed; borrowed, and valid until the next solve. */
const CeldClosures *celd_segmenter_closures (const CeldSegmenter *segmenter);

/* ------------------------------------------------------------------ smoothness-costs.c */

#define CELD_COST_UNIT     16   /* cost of a pair of pixels inside ink: energies are integers */
#define CELD_LEAK_UNIT     4096 /* weakness of a barrier per unit of cost beyond that of ink (chosen) */
#define CELD_INK_STEPS     1024 /* steps of the table by ink */
#define CELD_MOST_TO_PAPER 100  /* squared pixels: the discount grows no more from here on */

typedef struct
{
  int     width, height;
  double  paper_cost;                       /* K: what a pair of paper costs more than one inside ink */
  int32_t by_ink[CELD_INK_STEPS + 1];       /* by the darker pixel of a pair, from ink (0) to paper */
  int32_t discount[CELD_MOST_TO_PAPER + 1]; /* for ink at this squared distance to paper */
  int32_t weakness[CELD_MOST_TO_PAPER + 1]; /* as a barrier, of solid ink at this squared distance to paper */
  int32_t margin;                           /* factor for pairs of paper along the frame */
} CeldSmoothnessCosts;

/* V_pq of LazyBrush [SDC09b] (section 3.2): fills in *costs for a picture of this size.  `threshold` is
 * settings->ink_threshold, 0 .. 1. */
void celd_smoothness_costs_new (int width, int height, float threshold, CeldSmoothnessCosts *costs);

/* V_pq of two neighbouring pixels: their ink, their squared distances to paper (0 or less on paper), and whether both
 * are outermost pixels on the same side of the picture. */
int32_t celd_smoothness_cost (const CeldSmoothnessCosts *costs, float ink, float other_ink, int32_t to_paper,
                              int32_t other_to_paper,
                              bool along_frame);

/* How weak the barrier between two neighbouring pixels of this smoothness cost is, whose smaller squared distance to
 * paper is `to_paper` (0 or less on paper): leaks count first, whatever the length of the line; then how thin it is. */
static inline int64_t
celd_barrier_weakness (const CeldSmoothnessCosts *costs, int32_t cost, int32_t to_paper)
{
  int32_t d = to_paper < 0 ? 0 : to_paper < CELD_MOST_TO_PAPER ? to_paper : CELD_MOST_TO_PAPER;

  return (int64_t) (cost + costs->discount[d] - CELD_COST_UNIT) * CELD_LEAK_UNIT + costs->weakness[d];
}

/* The squared distance of every pixel to the nearest paper, 0 on paper: a tight plane of the picture's size. */
CeldStatus celd_distance_to_paper (const CeldPlane *ink, const CeldHost *host, int32_t *to_paper);

/* The squared distance of a pixel of ink to the nearest paper, at most `most`. */
int32_t celd_squared_to_paper (const CeldPlane *ink, int x, int y, int32_t most);

/* closed-shapes.c: the shapes that a person sees in a drawing without scribbles.  Paper gets the number of its shape,
 * which ends at narrow openings, and that of the connected paper that this is part of, both from 1; ink gets 0.  The
 * caller provides both pictures, of the size of the ink. */
CeldStatus celd_closed_shapes (const CeldPlane *ink, float threshold, const CeldHost *host, CeldLabels *shape,
                               CeldLabels *component);

#endif
