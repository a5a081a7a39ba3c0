/* Reading arrows: their strokes, where these cross or meet, and which of their ends is nearer.
 *
 *   arrow-layer.c        how opaque the pixels of an arrows layer are; relations painted as one
 *   stroke-distance.c    geodesic distances along a stroke, its width and middle at a distance
 *   arrowhead.c          which end of a stroke has an arrowhead or a dot
 *   arrow-profile.c      which end of a stroke is more opaque or wider
 *   crossings.c          where strokes cross
 *   crossing-strokes.c   the strokes of a connected component in which some cross
 *   arrow-problems.c     why an arrow is unclear, and its paint
 *   arrow-strokes.c      the arrow of paint of one colour, or those of strokes that cross in it
 *   thinning.c           thins paint to lines of one pixel
 *   stroke-trace.c       the lines of thinned paint, and where they meet
 *   stroke-lines.c       length and corners of lines, and the point where several meet
 *   stroke-graph.c       the long lines of paint
 *   joined-lines.c       where the long lines of several arrows meet
 *   explained-paint.c    the paint of lines that meet, and of their heads and dots
 *   paint-window.c       samples of the paint round a node
 *   head-fits.c          what heads at the ends of lines cost
 *   dot-fits.c           what dots there cost
 *   head-choice.c        which of them cost least in all
 *   joined-heads.c       which end of each of several lines that meet has its head or dot
 *   line-values.c        the opacity or width of a line along its points
 *   monotone-pieces.c    values that only fall or rise, and pieces of others that do
 *   line-profiles.c      which way a line fades or tapers, and where two arrows meet in it
 *   joined-passes.c      where arrows that fade or taper go on from line to line
 *   joined-places.c      where the ends of such lines are
 *   joined-profiles.c    the arrows of lines that fade or taper
 *   search-places.c      where arrows that share ends may begin or end
 *   search-shafts.c      lines inside the paint between such places
 *   search-heads.c       heads and dots that fit there
 *   search-cover.c       the paint that each such arrow explains
 *   search-divisions.c   where lines with a head at either end are two arrows
 *   search-choice.c      what a choice of arrows costs
 *   search-moves.c       the choice that costs least
 *   search-margins.c     how much better its arrows are than others
 *   search-shown.c       what shows that they end where they do
 *   search-arrows.c      arrows that share ends, read by that choice
 *   joined-paint.c       which paint belongs to which of such arrows
 *   joined-arrows.c      arrows of one colour that share ends
 *   arrow-colours.c      the paint of each colour of a component
 *   hidden-ends.c        where arrows end whose ends are hidden below others
 *   coloured-arrows.c    the arrows of a component of several colours
 *   arrows.c             all arrows of a layer
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_ARROWS_H
#define CELD_ARROWS_H

#include "image/image.h"

#include <math.h>

typedef struct { double x, y; } CeldPoint;

/* The search for arrows asks for it so often that hypot, which minds overflow, would be an eighth of all its time. */
static inline double
celd_points_apart (CeldPoint a, CeldPoint b)
{
  return sqrt ((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y));
}

/* ------------------------------------------------------------------ arrow-layer.c */

#define CELD_PAPER_CONTRAST 32 /* least difference of paint from paper, 0 .. 255, in a layer without alpha; chosen */

typedef struct
{
  const CeldPaint *paint;    /* borrowed */
  bool             opaque;   /* all alpha is 255: paint is what differs from paper */
  uint8_t          paper[3]; /* the commonest colour of an opaque layer */
  int              strongest; /* the alpha of the most opaque pixel of others; 255 if it is hardly visible */
} CeldArrowLayer;

/* Finds out whether a layer is opaque, its paper, and how opaque its paint is.  CELD_NO_MEMORY is the only failure. */
CeldStatus celd_arrow_layer_new (const CeldPaint *paint, CeldArrowLayer *layer);

/* Alpha by that of the most opaque paint, or the largest difference from paper in any channel: 0 .. 255.  (x,y) must be in
 * the picture. */
int celd_arrow_opacity (const CeldArrowLayer *layer, int x, int y);

/* ------------------------------------------------------------------ stroke-distance.c */

/* Sums over all pixels nearer to the start than one distance: their number and their places. */
typedef struct { double count, x, y; } CeldStrokeSums;

/* A connected stroke, followed from one or more of its pixels.  Pixels are indices into planes that have a border of
 * one pixel, (width + 2) x (height + 2), so that each has eight neighbours. */
typedef struct
{
  int             width, height; /* of the picture */
  float          *distance;      /* such a plane: geodesic distance from the start in pixels; infinite elsewhere */
  const uint32_t *pixel;         /* of the stroke, which is connected */
  size_t          n;
  CeldStrokeSums *sums;          /* sums[i]: pixels with distance < i; room for 3 n / 2 + 4 */
  size_t          n_sums;
  float          *earlier;       /* room for n distances from an earlier start */
  uint32_t       *rings;         /* room for 3 n pixels */
} CeldArrowStroke;

int       celd_stroke_x (const CeldArrowStroke *stroke, uint32_t pixel);     /* column in the picture */
int       celd_stroke_y (const CeldArrowStroke *stroke, uint32_t pixel);     /* row in the picture */
CeldPoint celd_stroke_point (const CeldArrowStroke *stroke, uint32_t pixel); /* centre of a pixel, in the picture */

/* Is the pixel at a point, or one of its four neighbours, part of a stroke? */
bool celd_stroke_painted (const CeldArrowStroke *stroke, CeldPoint p);

/* Fills in the distances from the nearest of n starts, and the sums.  Returns the farthest pixel. */
uint32_t celd_stroke_follow (CeldArrowStroke *stroke, const uint32_t *start, size_t n);

/* Distance of the farthest pixel, rounded up, after celd_stroke_follow. */
double celd_stroke_length (const CeldArrowStroke *stroke);

/* Between two distances: pixels per unit of length, which is the mean width; and the centroid of the pixels. */
double    celd_stroke_mean_width (const CeldArrowStroke *stroke, double from, double to);
CeldPoint celd_stroke_centroid (const CeldArrowStroke *stroke, double from, double to);

/* ------------------------------------------------------------------ arrowhead.c, arrow-profile.c */

/* The tail of an arrow is at the nearer region, its tip at the farther one. */
typedef struct { CeldPoint tail, tip; } CeldArrowEnds;

/* CELD_REASON_NONE, or why the stroke has no clear arrowhead; with `dot`, no clear dot, whose centre is then the
 * tip. */
CeldArrowReason celd_arrowhead (CeldArrowStroke *stroke, bool dot, CeldArrowEnds *ends);

/* Sums over some paint, weighted by opacity, for its mean colour; in a layer without alpha, that less the colour of the
 * paper.  To begin with, all are 0. */
typedef struct { double red, green, blue, opacity, weights; } CeldPaintColour;

void celd_paint_colour_add (CeldPaintColour *sum, const CeldArrowLayer *layer, int x, int y);

/* Is paint opaque enough for its colour to be known?  May both be of one stroke? */
bool celd_paint_colour_known (CeldPaintColour sum);
bool celd_same_paint (const CeldArrowLayer *layer, CeldPaintColour one, CeldPaintColour other);

/* Do the first two pieces of sufficient opacity of a stroke that is followed from an end differ in colour from the last
 * two? */
bool celd_stroke_changes_colour (const CeldArrowStroke *stroke, const CeldArrowLayer *layer);

/* The more opaque (CELD_ARROW_FADE) or the wider (CELD_ARROW_TAPER) end of a stroke is the tail.  CELD_REASON_NONE, or
 * why neither end clearly is. */
CeldArrowReason celd_arrow_profile (CeldArrowStroke *stroke, const CeldArrowLayer *layer, CeldArrowStyle style,
                                    CeldArrowEnds *ends);

/* ------------------------------------------------------------------ crossings.c */

/* Where two strokes cross: arms 0 and 2 are one of them, 1 and 3 the other, on a circle round the crossing. */
typedef struct { CeldPoint centre, arm[4]; double radius, breadth[4]; } CeldStrokeCrossing;

/* A stroke cut out of its picture, with a border of one pixel that is not painted.  squared: of each pixel the squared
 * distance to the nearest one that is not painted. */
typedef struct { int left, top, width, height; uint8_t *painted; int32_t *squared; } CeldStrokeMask;

CeldStatus celd_stroke_mask_new (const CeldArrowStroke *stroke, CeldStrokeMask *mask);
void       celd_stroke_mask_clear (CeldStrokeMask *mask);

/* The crossings in a mask; *list is the caller's to free. */
CeldStatus celd_stroke_crossings_find (const CeldStrokeMask *mask, CeldStrokeCrossing **list, size_t *n);

/* ------------------------------------------------------------------ crossing-strokes.c */

/* Stroke k of a component has the pixels from first[k] to first[k + 1], numbered as in CeldArrowStroke. */
typedef struct { uint32_t *pixel; size_t *first, n; size_t pixel_capacity; } CeldCrossingStrokes;

/* Takes a connected component apart where strokes cross; n = 0 if none do.  To be cleared by the caller. */
CeldStatus celd_crossing_strokes_find (const CeldArrowStroke *component, CeldCrossingStrokes *strokes);
void       celd_crossing_strokes_clear (CeldCrossingStrokes *strokes);

/* Makes `stroke` the one with index k. */
void celd_stroke_select (const CeldCrossingStrokes *strokes, size_t k, CeldArrowStroke *stroke);

/* ------------------------------------------------------------------ arrow-problems.c */

/* What hides some of a colour: the paint of all colours; and of the n pixels of that colour, in reading order, whether
 * it is seen there. */
typedef struct { const CeldStrokeMask *component; const uint32_t *pixel; size_t n; const bool *seen; } CeldStrokeCover;

/* Appends a problem of a stroke, whose pixels are in reading order, at a place; cover: of its colour, NULL if nothing
 * hides some of it. */
CeldStatus celd_arrow_problem_add (CeldProblems *problems, CeldArrowReason reason, CeldPoint at,
                                   const CeldArrowStroke *stroke, const CeldStrokeCover *cover);

/* Some pixel of a stroke. */
CeldPoint celd_stroke_middle (const CeldArrowStroke *stroke);

/* ------------------------------------------------------------------ arrow-strokes.c */

#define CELD_LEAST_STROKE 6 /* pixels; a smaller component is a speck and ignored; chosen */

/* Is the mean colour of a stroke blue?  Such an arrow marks a crack. */
bool celd_arrow_is_blue (const CeldArrowStroke *stroke, const CeldArrowLayer *layer);

/* Appends the arrow of connected paint, or those of the strokes that cross in it; *clear becomes false if neither is
 * clear.  *strokes: those that cross, to be cleared by the caller. */
CeldStatus celd_arrow_strokes_read (CeldArrowStroke *stroke, const CeldArrowLayer *layer, CeldArrowStyle style,
                                    CeldRelations *relations, CeldCrossingStrokes *strokes, bool *clear);

/* Appends a problem for each stroke of connected paint that was not clear, with its own reason.  reason: that of those
 * that are clear alone, or look alike at both ends; CELD_REASON_NONE = there is none, but that strokes cross. */
CeldStatus celd_arrow_strokes_report (const CeldArrowStroke *paint, const CeldCrossingStrokes *strokes,
                                      const CeldStrokeCover *cover, const CeldArrowLayer *layer, CeldArrowStyle style,
                                      CeldArrowReason reason, CeldProblems *problems);

/* ------------------------------------------------------------------ thinning.c */

/* Thins a mask to lines of one pixel.  Its border must be 0. */
CeldStatus celd_thin (uint8_t *on, int width, int height);

/* The eight neighbours of a pixel that is not on the border, clockwise from the one above. */
void celd_thin_neighbours (const uint8_t *on, size_t width, size_t pixel, bool around[8]);

/* ------------------------------------------------------------------ stroke-trace.c, stroke-lines.c, stroke-graph.c */

/* A line of thinned paint between two nodes, in coordinates of its mask.  Its points are at most 1.5 pixels apart, so
 * that a number of points is about a length. */
typedef struct { CeldPoint *at; size_t n, capacity; int node[2]; } CeldStrokeLine;

/* Lines that should meet in a point: the sums of their normal equations, from which it follows by least squares. */
typedef struct { double xx, xy, yy, x, y; } CeldLineSums;

/* Where lines end or meet, and the short branches that were there.  tip: `at` is the end of paint that its lines share;
 * vague: a line was divided there, but perhaps not at the right place. */
typedef struct { CeldPoint at; bool branched, tip, vague; CeldLineSums branches; } CeldStrokeNode;

typedef struct
{
  CeldStrokeLine *line;
  CeldStrokeNode *node;
  size_t          n_lines, n_nodes, capacity, node_capacity;
  double          width; /* of the lines, in pixels, at least 1 */
} CeldStrokeGraph;

/* All lines of the thinned paint of a mask, but for closed ones that meet no other.  To be cleared by the caller. */
CeldStatus celd_stroke_trace (const CeldStrokeMask *mask, CeldStrokeGraph *graph);

/* The long ones of these lines.  With `heads` arrows have heads or dots: short branches are parts of heads, and lines end
 * also at corners, and where the paint is much wider than elsewhere.  None if there are more than 2000 lines, which are
 * no arrows.  To be cleared by the caller. */
CeldStatus celd_stroke_graph_new (const CeldStrokeMask *mask, bool heads, CeldStrokeGraph *graph);
void       celd_stroke_graph_clear (CeldStrokeGraph *graph);

/* Leads a line on straight to a point. */
CeldStatus celd_stroke_line_append (CeldStrokeLine *line, CeldPoint p);

/* Joins the two lines of a node, if it has two, into one. */
CeldStatus celd_stroke_graph_join (CeldStrokeGraph *graph, int node);

/* Divides a line at one of its points, which becomes a node. */
CeldStatus celd_stroke_graph_divide (CeldStrokeGraph *graph, size_t line, size_t at);

double celd_stroke_line_length (const CeldStrokeLine *line);

/* The sharpest corner of a line: where its sides meet; false if it has none. */
bool celd_stroke_line_corner (const CeldStrokeGraph *graph, size_t line, CeldPoint *place);

/* The number of the point of a line that is nearest to a place. */
size_t celd_stroke_line_nearest (const CeldStrokeLine *line, CeldPoint place);

/* Adds a line through a point, in a direction of length 1.  The point nearest to all lines; `prior` decides if they are
 * parallel or none. */
void      celd_line_sums_add (CeldLineSums *sums, CeldPoint p, CeldPoint way, double weight);
CeldPoint celd_line_sums_point (const CeldLineSums *sums, CeldPoint prior);

/* ------------------------------------------------------------------ joined-arrows.c */

#define CELD_MARK_HIDDEN 0.4 /* part of a head or dot that others may hide; chosen */

/* What was found.  width: of the lines; 0 = there are no such arrows, or only one and no cover, and nothing is
 * appended; branched: lines meet that are no single stroke; crossed: some may just cross. */
typedef struct { double width; bool branched, crossed; } CeldJoinedFound;

/* Why there are no arrows in paint, of which some strokes cross, if it is of more than one. */
static inline CeldArrowReason
celd_joined_reason (const CeldJoinedFound *found, const CeldCrossingStrokes *strokes)
{
  return found->branched || (found->crossed && !strokes->n) ? CELD_REASON_MEETING : CELD_REASON_NONE;
}

/* Appends the arrows of connected paint of one colour whose ends meet, and a problem for each long line that is
 * unclear; and to `doubts`, of each arrow, what its problem would be.  cover: NULL if there are no other colours. */
CeldStatus celd_joined_arrows_read (CeldArrowStroke *stroke, const CeldStrokeCover *cover, const CeldArrowLayer *layer,
                                    CeldArrowStyle style, CeldRelations *relations, CeldProblems *problems,
                                    CeldProblems *doubts, CeldJoinedFound *found);

/* ------------------------------------------------------------------ arrow-colours.c */

#define CELD_LEAST_PART 100 /* pixels of a part of a colour that is no edge of another stroke; chosen */
#define CELD_MOST_BREAK 40  /* pixels between parts that may be one stroke, hidden by others in between; chosen */

/* Connected paint of each colour of a component, also what is too small to be a stroke; colour: that of each, from 0;
 * remnant: it may be what others leave of the side or head of another one; covered: most of its edge is beside other
 * paint; seen: of each pixel, that it has that colour, and not one
 * that hides it. */
typedef struct
{
  CeldCrossingStrokes strokes;
  int                *colour;
  bool               *remnant, *covered, *seen;
  size_t              first_capacity, colour_capacity, remnant_capacity, covered_capacity, seen_capacity;
} CeldColourStrokes;

/* strokes.n = 0 if the component has one colour.  To be cleared by the caller. */
CeldStatus celd_arrow_colours_split (const CeldArrowStroke *component, const CeldArrowLayer *layer,
                                     CeldColourStrokes *strokes);
void       celd_colour_strokes_clear (CeldColourStrokes *strokes);

/* ------------------------------------------------------------------ hidden-ends.c */

/* An end of an arrow, which is a stroke of a colour: where its paint ends, the direction in which it does, and its
 * mean width.  visible: it ends there, else other paint of the component goes on in its direction and may hide its
 * end; broken: so does paint of its own colour farther on, which may be more of it (beyond: the stroke of that,
 * SIZE_MAX = of several); is_near: that other paint is so short that its end is near `middle` in any case; is_about:
 * it hides all the width of the arrow only for a few widths, in whose middle, `about`, its end is if others end
 * there; lean: its width there, without a head or dot; bare: its arrow has its head or dot at the other end; dotted:
 * it has a dot there; known: it ends at `place`. */
typedef struct
{
  size_t    stroke, beyond;
  CeldPoint at, way, middle, about, place;
  double    width, lean;
  bool      visible, broken, is_near, is_about, bare, dotted, known;
} CeldArrowEnd;

/* A component of several colours, and its strokes. */
typedef struct
{
  const CeldStrokeMask    *component;
  const CeldArrowLayer    *layer;
  const CeldColourStrokes *colours;
} CeldColouredPaint;

/* What is known of an end: a head or dot is there, beyond which no arrow goes on; or it is the nearer end of one that
 * fades or tapers, which is stronger than what follows. */
typedef enum { CELD_SIGHT_NONE, CELD_SIGHT_MARKED, CELD_SIGHT_STRONG } CeldEndSight;

/* The end at `at` of an arrow of a mean width from or to `other`, whose paint is stroke k of a component. */
CeldArrowEnd celd_arrow_end (const CeldColouredPaint *paint, const CeldArrowStroke *stroke, size_t k, CeldPoint at,
                             CeldPoint other, double width, CeldEndSight sight);

/* Finds out which of n ends are known, and their places.  Arrow k has the ends 2 k and 2 k + 1.  Arrows lead below
 * others; those that are graded, which fade or taper, at their tips alone. */
void celd_arrow_ends_find (const CeldStrokeMask *component, bool graded, CeldArrowEnd *ends, size_t n);

/* ------------------------------------------------------------------ coloured-arrows.c */

/* Appends the arrows of a component, which has the strokes of several colours, or problems. */
CeldStatus celd_coloured_arrows_read (const CeldColourStrokes *colours, const CeldArrowStroke *component,
                                      const CeldArrowLayer *layer, CeldArrowStyle style, CeldRelations *relations,
                                      CeldProblems *problems);

#endif
