/* Arrows of one colour that share ends, as lines of a graph: what joined-*.c, explained-paint.c and free-ends.c share.
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

typedef enum { CELD_END_UNKNOWN, CELD_END_BARE, CELD_END_MARKED, CELD_END_HIDDEN } CeldEndMark;

/* An end of a line.  tip: where it is, or would be; way: from there into the line.  Of a head: the directions of its
 * barbs from the tip, right and left of the line; how well each agrees with the paint, from 0 to 1 or -1 = it cannot be
 * seen; and how well the head does.  mark: is there a head or dot, or would paint of other colours hide it?  covered:
 * there is such paint near a free end, up to which the line is straight. */
typedef struct
{
  CeldPoint   tip, way, barb[2];
  double      barb_score[2], score;
  CeldEndMark mark;
  bool        covered;
} CeldJoinedEnd;

/* All points are in coordinates of the mask. */
typedef struct
{
  CeldArrowStyle   style;
  CeldArrowStroke *stroke;    /* the connected paint; borrowed */
  CeldStrokeMask   mask;
  CeldStrokeGraph  graph;
  uint8_t         *hidden;    /* of each pixel of the mask: has it paint of other colours?  NULL: there are none */
  uint8_t         *explained; /* the same size: is it hidden, or does it belong to a line, or to a head that was found? */
  uint8_t         *may_take;  /* the same size: may a piece have that pixel? */
  CeldJoinedEnd   *end;       /* two for each line: end i of line k is 2 k + i */
} CeldJoinedLines;

/* The arrows of a line: none if it is unclear, or one, or two that meet at its corner.  role: of each end, 1 = an arrow
 * ends there, -1 = one begins there, 0 = not known; seen: a head there is beyond doubt.  A dot always is, if the line
 * has one at either end. */
typedef struct { CeldPoint nearer[2], farther[2]; int n, role[2]; bool seen[2]; } CeldLineArrows;

/* ------------------------------------------------------------------ joined-lines.c */

bool      celd_joined_is_free (const CeldJoinedLines *lines, size_t end); /* does no other line end there? */
CeldPoint celd_joined_way (const CeldJoinedLines *lines, size_t end);     /* the direction into the line */

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

/* Marks as explained the paint of all lines, with their ends led to the tips, and what is hidden; nothing else is. */
void celd_joined_explain_lines (CeldJoinedLines *lines);

/* Marks as explained the paint of all lines, as wide as they are everywhere, and what is hidden; nothing else is. */
void celd_joined_explain_wide_lines (CeldJoinedLines *lines);

/* Marks the paint of the head or dot at an end as explained. */
void celd_joined_explain_head (CeldJoinedLines *lines, const CeldJoinedEnd *end);
void celd_joined_explain_dot (CeldJoinedLines *lines, const CeldJoinedEnd *end);

/* What is at a point: paint (1) or none (0); -1 = it is explained. */
int celd_joined_paint_at (const CeldJoinedLines *lines, CeldPoint p);

/* The paint that is not explained within `reach` widths of a place, in square widths. */
double celd_joined_rest (const CeldJoinedLines *lines, CeldPoint place, double reach);

/* Is all paint beside a line explained, but for `margin` points at its ends? */
bool celd_joined_is_alone (const CeldJoinedLines *lines, size_t line, size_t margin);

/* ------------------------------------------------------------------ joined-marks.c */

/* The barbs and the score of a head at an end whose tip is given. */
void celd_joined_find_barbs (const CeldJoinedLines *lines, CeldJoinedEnd *end);

/* The part of a disc, from 0 to 1, in which other colours hide what is there. */
double celd_joined_hidden_share (const CeldJoinedLines *lines, CeldPoint centre, double radius);

/* Looks for a head or dot near the tip of an end, which moves there if one is found. */
void celd_joined_find_mark (const CeldJoinedLines *lines, CeldJoinedEnd *end, bool is_free);

/* The place near `start` where the heads of n ends agree best with the paint if all have their tips there. */
CeldPoint celd_joined_common_tip (const CeldJoinedLines *lines, const size_t *head, size_t n, CeldPoint start);

/* ------------------------------------------------------------------ free-ends.c */

/* Where the paint of a line ends at its free end. */
CeldStatus celd_joined_free_tip (const CeldJoinedLines *lines, size_t end, CeldPoint *tip);

/* Looks for a head or dot at a free end. */
CeldStatus celd_joined_read_free_end (CeldJoinedLines *lines, size_t end);

/* ------------------------------------------------------------------ joined-heads.c, joined-profiles.c */

/* The arrows of all lines, whose ends have heads or dots; or whose opacity or width changes.  Places are those of nodes
 * where lines meet. */
CeldStatus celd_joined_heads_read (CeldJoinedLines *lines, CeldLineArrows *arrows);
CeldStatus celd_joined_profiles_read (CeldJoinedLines *lines, const CeldArrowLayer *layer, CeldLineArrows *arrows);

#endif
