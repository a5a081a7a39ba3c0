/* Arrows of one colour that share ends, as lines of a graph: what joined-*.c, head-*.c and explained-paint.c share.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_JOINED_ARROWS_H
#define CELD_JOINED_ARROWS_H

#include "input/input.h"

#include <math.h>

#define CELD_LEAST_LINE 5   /* widths of the paint: a shorter line is part of something else; chosen */
#define CELD_MOST_APART 2.4 /* widths for which lines that meet may lie side by side; chosen: 30 degrees */
#define CELD_MOST_MOVED 1.8 /* widths from a node to where its lines would meet, at most; chosen */
#define CELD_HEAD_REACH 5.5 /* widths from the tip to the end of a barb, at most; chosen */
#define CELD_LINE_BODY  0.6 /* widths from the middle of a line to the edge of its paint, and a pixel more; chosen */
#define CELD_NODE_REACH 7   /* widths from a node up to which paint belongs to it; chosen */
#define CELD_MOST_MARKS 7   /* lines that meet at a node, of which more are unclear; chosen */

/* All points are in coordinates of the mask; end i of line k is number 2 k + i. */
typedef struct
{
  CeldArrowStyle   style;
  CeldArrowStroke *stroke;    /* the connected paint; borrowed */
  CeldStrokeMask   mask;
  CeldStrokeGraph  graph;
  uint8_t         *hidden;    /* of each pixel of the mask: has it paint of other colours?  NULL: there are none */
  uint8_t         *explained; /* the same size: is it hidden, or does it belong to a line? */
  uint8_t         *may_take;  /* the same size: may a piece have that pixel? */
} CeldJoinedLines;

/* The arrows of a line: none if it is unclear, or one, or two that meet at its corner.  part: the line belongs to the
 * arrow of another one.  role: of each end of a line that fades or tapers, 1 = an arrow ends there, -1 = one begins
 * there, 0 = not known. */
typedef struct { CeldPoint nearer[2], farther[2]; int n, role[2]; bool part; } CeldLineArrows;

/* ------------------------------------------------------------------ joined-lines.c */

bool      celd_joined_is_free (const CeldJoinedLines *lines, size_t end); /* does no other line end there? */
CeldPoint celd_joined_way (const CeldJoinedLines *lines, size_t end);     /* the direction into the line */

/* The angle by which an arrow would turn that comes along the line of one end and goes on along that of another one. */
double celd_joined_turn (const CeldJoinedLines *lines, size_t a, size_t b);

/* The point of the line of an end that is so many points from there. */
CeldPoint celd_joined_point (const CeldJoinedLines *lines, size_t end, double steps);

/* From where a line is led on straight to its node, because the thinned paint follows heads there: the number of points
 * from the end, and the place. */
size_t    celd_joined_lead (const CeldJoinedLines *lines, size_t end);
CeldPoint celd_joined_led_from (const CeldJoinedLines *lines, size_t end);

/* The point nearest to the lines and branches that meet at a node, led on straight. */
CeldPoint celd_joined_meeting_point (const CeldJoinedLines *lines, int node);

/* The widths of the paint from where lines of two directions meet to where each is alone; the same for an end and all
 * other lines that end there, 0 = there are none.  Lines that lie side by side for longer than CELD_MOST_APART are
 * unclear. */
double celd_widths_apart (CeldPoint u, CeldPoint v);
double celd_joined_widths_apart (const CeldJoinedLines *lines, size_t end);

/* Is most of the way from each line of a node to a place painted? */
bool celd_joined_is_led_to (const CeldJoinedLines *lines, int node, CeldPoint place);

static inline int
celd_joined_node (const CeldJoinedLines *lines, size_t end)
{
  return lines->graph.line[end / 2].node[end % 2];
}

static inline bool
celd_joined_inside (const CeldJoinedLines *lines, CeldPoint p)
{
  return p.x >= 0 && p.y >= 0 && p.x < lines->mask.width && p.y < lines->mask.height;
}

/* The index of the pixel at a point inside. */
static inline size_t
celd_joined_pixel (const CeldJoinedLines *lines, CeldPoint p)
{
  return (size_t) p.y * (size_t) lines->mask.width + (size_t) p.x;
}

static inline bool
celd_joined_painted (const CeldJoinedLines *lines, CeldPoint p)
{
  return celd_joined_inside (lines, p) && lines->mask.painted[celd_joined_pixel (lines, p)];
}

/* A point of the picture in coordinates of the mask. */
static inline CeldPoint
celd_joined_in_mask (const CeldJoinedLines *lines, CeldPoint p)
{
  return (CeldPoint) { p.x - lines->mask.left, p.y - lines->mask.top };
}

static inline CeldPoint
celd_moved (CeldPoint p, CeldPoint way, double distance)
{
  return (CeldPoint) { p.x + distance * way.x, p.y + distance * way.y };
}

/* ------------------------------------------------------------------ joined-pieces.c */

typedef struct { CeldArrowStroke stroke; uint32_t *pixel; size_t capacity; } CeldJoinedPiece;

/* The paint that may be taken and is connected with a point, as a stroke of its own; it may not be taken again.  To be
 * released by the caller in any case. */
CeldStatus celd_joined_take (const CeldJoinedLines *lines, CeldPoint start, CeldJoinedPiece *piece);
void       celd_joined_release (CeldJoinedPiece *piece);

/* Sets the pixels of a disc in `pixels`, which is `explained` or `may_take`. */
void celd_joined_fill_disc (const CeldJoinedLines *lines, CeldPoint centre, double radius, uint8_t value,
                            uint8_t *pixels);

/* ------------------------------------------------------------------ explained-paint.c */

/* Marks as explained the paint of all lines but for that near nodes, and what is hidden; nothing else is. */
void celd_joined_explain_lines (const CeldJoinedLines *lines);

/* Marks as explained the paint of all lines, as wide as they are everywhere, and what is hidden; nothing else is. */
void celd_joined_explain_wide_lines (const CeldJoinedLines *lines);

/* What is at a point: paint (1) or none (0); -1 = it is explained. */
int celd_joined_paint_at (const CeldJoinedLines *lines, CeldPoint p);

/* Is all paint beside a line explained, but for `margin` points at its ends? */
bool celd_joined_is_alone (const CeldJoinedLines *lines, size_t line, size_t margin);

/* The part of a disc, from 0 to 1, in which other colours hide what is there. */
double celd_joined_hidden_share (const CeldJoinedLines *lines, CeldPoint centre, double radius);

/* ------------------------------------------------------------------ head-fits.c */

/* The n ends at a node, and of each set of them (bit i: end i has a head or dot there) what that costs, in square widths
 * of paint, and where the node is then.  cost is NULL if nothing is known. */
typedef struct { size_t end[CELD_MOST_MARKS]; int n; double *cost; CeldPoint *tip; } CeldNodeMarks;

/* Finds costs and places, for which there is room, of the ends that are given.  The paint of all lines is explained
 * (celd_joined_explain_lines).  meeting: where the lines of each node meet, NAN = it has none. */
CeldStatus celd_node_marks_find (const CeldJoinedLines *lines, size_t node, const CeldPoint *meeting,
                                 CeldNodeMarks *marks);

/* ------------------------------------------------------------------ head-choice.c */

/* Two ends at a node whose lines may be one arrow that passes there, what that costs, and whether it does. */
typedef struct { size_t end[2]; double cost; bool on; } CeldArrowPass;

/* Which ends have heads or dots, and where arrows pass.  Found are, of each line: the first line of its arrow; of that
 * line the heads of the arrow; and what the best other choice for the line costs more. */
typedef struct
{
  const CeldJoinedLines *lines;
  CeldNodeMarks         *node;
  CeldArrowPass         *pass;
  size_t                 n_passes, pass_capacity;
  bool                  *marked;     /* of each end */
  bool                  *passed;     /* of each end: does an arrow pass its node? */
  bool                  *short_line; /* of each line: may it be the barb of a head? */
  size_t                *chain;
  int                   *heads;
  double                *margin;
  /* Of the search: the passes that are on, n_on of them; the lines that are tried now, and in the next round. */
  size_t                *on, n_on;
  bool                  *tried, *tried_next;
} CeldHeadChoice;

/* Finds the choice that costs least, from one without heads and passes. */
CeldStatus celd_head_choice_find (CeldHeadChoice *choice);

/* The set of ends of a node that have heads. */
unsigned celd_head_choice_at (const CeldHeadChoice *choice, int node);

/* ------------------------------------------------------------------ joined-heads.c, joined-profiles.c */

/* The arrows of all lines, whose ends have heads or dots; or whose opacity or width changes.  Places are those of nodes
 * where lines meet. */
CeldStatus celd_joined_heads_read (CeldJoinedLines *lines, CeldLineArrows *arrows);
CeldStatus celd_joined_profiles_read (CeldJoinedLines *lines, const CeldArrowLayer *layer, CeldLineArrows *arrows);

#endif
