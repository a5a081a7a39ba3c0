/* Bridges: faint lines from one line end to another that nobody drew, added to the drawing before basins are found.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_BRIDGES_H
#define CELD_BRIDGES_H

#include "segment/basins.h"

/* ------------------------------------------------------------------ line-ends.c */

/* The end of a line: the middle of its tip, the unit direction in which it would go on, and the number of its ink
 * outline.  `width`: of the line; 0 if it is not of even width, as the corner of two lines.  `stroke`: the width of
 * strokes among which it was found: that of the drawing, or less for lines that are finer. */
typedef struct { double x, y, dx, dy; uint32_t outline; double width, stroke; } CeldTip;

/* The width of strokes that lengths between two line ends are measured by: that of the finer line. */
static inline double
celd_finer_stroke (const CeldTip *p, const CeldTip *q)
{
  return p->stroke < q->stroke ? p->stroke : q->stroke;
}

/* Finds all line ends, in the order of their first pixels; the caller frees *tip with celd_free.  `stroke`:
 * celd_stroke_width. */
CeldStatus celd_line_ends_find (const CeldPlane *ink, int stroke, const CeldHost *host, CeldTip **tip, size_t *n);

/* ------------------------------------------------------------------ bridge-pairs.c */

/* Two line ends by their numbers, a < b, and the cost of joining them. */
typedef struct { double cost; uint32_t a, b; } CeldTipPair;

typedef struct CeldTipPairs CeldTipPairs;

/* An iterator over all pairs of line ends that may be joined; `tip` must stay until it is freed.  NULL: no memory. */
CeldTipPairs *celd_tip_pairs_new (const CeldTip *tip, size_t n, int stroke);
void          celd_tip_pairs_free (CeldTipPairs *pairs);         /* accepts NULL */

/* The next pair by cost, then by numbers, of which neither end is taken; ends must not be released again.  *pair is
 * valid until the next call; NULL: there are no more. */
CeldStatus celd_tip_pairs_next (CeldTipPairs *pairs, const bool *taken, const CeldHost *host, const CeldTipPair **pair);

/* ------------------------------------------------------------------ bridges.c */

#define CELD_FAINTEST_INK 0.499f /* of a bridge that is a mere guess: just not paper */

/* A pixel of paper that a bridge passes over, and the ink that it gets there: 0 if the bridge is certain, up to just
 * not paper if it is a mere guess. */
typedef struct { int32_t x, y; float ink; } CeldBridgePixel;

/* Its pixels, from end to end; its length in pixels; does it go on from a single end to the ink ahead, and is that the
 * end of a line that may be the side of a room?  If not ahead, the line ends that it joins. */
typedef struct { size_t first, n; double length; bool ahead, line; CeldTip end[2]; } CeldBridge;

typedef struct
{
  CeldBridge      *item;
  size_t           n;
  CeldBridgePixel *pixel;       /* of all bridges, one after the other */
  size_t           n_pixels;
  size_t           item_capacity, pixel_capacity;
} CeldBridges;

/* Finds bridges between line ends that point to each other with nothing but paper between them; each end has one at
 * most.  A single end has a faint one to the ink that it points at nearby.  Makes the record. */
CeldStatus celd_bridges_find (const CeldPlane *ink, int stroke, const CeldHost *host, CeldBridges *bridges);
void       celd_bridges_clear (CeldBridges *bridges);            /* accepts a zeroed record */

/* Draws the bridges on the ink, dark enough to separate basins: a boundary on one costs as much as its certainty says,
 * between one inside ink and far less than one across paper. */
void celd_bridges_draw (const CeldBridges *bridges, CeldPlane *ink);

/* Enlarges *changed by the pixels that only one of the two records has, or that differ in ink. */
CeldStatus celd_bridges_compare (const CeldBridges *old, const CeldBridges *new, CeldRect *changed);

/* Finds the bridges of a drawing, and makes the basins of the drawing with its bridges.  `changed`: where the drawing
 * differs from that of *bridges and *basins; it is enlarged to where bridges differ.  NULL: both are made from the
 * beginning.  *bridged_component must be NULL; it is as by celd_bridges_join, or stays NULL without bridges.  After a
 * failure *bridges are the old ones, while *basins may be of the new drawing. */
CeldStatus celd_bridges_make_basins (const CeldPlane *ink, CeldRect *changed, float threshold, const CeldHost *host,
                                     CeldBridges *bridges, CeldBasins *basins, uint32_t **bridged_component);

/* ------------------------------------------------------------------ bridge-joins.c */

/* Joins components over bridges, and enclosures over bridges that are longer than two stroke widths or have one end
 * only.  `ink` is without bridges.  *bridged_component becomes each basin's component with bridges between two line
 * ends as lines, and with those that go on from a line's end and nearly shut a room; the caller frees it. */
CeldStatus celd_bridges_join (const CeldBridges *bridges, const CeldPlane *ink, CeldBasins *basins,
                              uint32_t **bridged_component);

/* Two basins that a bridge parts, and that are one paper without it.  `narrow`: it has two ends and is at most two
 * stroke widths long, like a gap in a contour.  `mouth`: it goes on from a single end, and the part on one of its sides
 * is no wider than it is, like a bay that opens there. */
typedef struct { uint32_t a, b; bool narrow, mouth; } CeldPassage;

/* Lists the passages, one for each pixel of a bridge and neighbour of it on paper in another basin; `ink` is without
 * bridges.  To be freed with celd_free; CELD_NO_MEMORY is the only failure. */
CeldStatus celd_bridges_find_passages (const CeldBridges *bridges, const CeldPlane *ink, const CeldBasins *basins,
                                       CeldPassage **passage, size_t *n);

#endif
