/* Arrows of one colour that share ends, as lines of a graph: what joined-*.c, head-*.c and explained-paint.c share.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_JOINED_ARROWS_H
#define CELD_JOINED_ARROWS_H

#include "input/arrows.h"

#include <math.h>

#define CELD_LEAST_LINE 5   /* widths of the paint: a shorter line is part of something else; chosen */
#define CELD_MOST_APART 3   /* widths for which lines that meet may lie side by side; chosen: 23 degrees */
#define CELD_MOST_SHARED 6   /* the same for lines that fade or taper: 10 degrees (measured: with 7 fewer are read) */
#define CELD_HEAD_REACH 5.5 /* widths from the tip to the end of a barb, at most; chosen */
#define CELD_LINE_BODY  0.6 /* widths from the middle of a line to the edge of its paint, and a pixel more; chosen */
#define CELD_NODE_REACH 7   /* widths from a node up to which paint belongs to it; chosen */
#define CELD_MOST_MARKS 10  /* lines that meet at a node, of which more are unclear; chosen */

/* All points are in coordinates of the mask; end i of line k is number 2 k + i. */
typedef struct
{
  CeldArrowStyle   style;
  CeldArrowStroke *stroke;    /* the connected paint; borrowed */
  CeldStrokeMask   mask;
  CeldStrokeGraph  graph;
  const CeldStrokeCover *cover; /* NULL: there are no other colours; borrowed */
  uint8_t         *hidden;    /* of each pixel of the mask: has it paint of other colours?  NULL: there are none */
  uint8_t         *explained; /* the same size: is it hidden, or does it belong to a line? */
  size_t          *lead;      /* of each end: from where its line is alone; NULL: a width or two from the node */
} CeldJoinedLines;

/* The arrow of a line.  unclear: why it has no ends; first: the line whose arrow this one is a part of, most often
 * itself. */
typedef struct { CeldPoint nearer, farther; CeldArrowReason unclear; size_t first; } CeldLineArrow;

/* ------------------------------------------------------------------ joined-lines.c */

bool      celd_joined_is_free (const CeldJoinedLines *lines, size_t end); /* does no other line end there? */
CeldPoint celd_joined_way (const CeldJoinedLines *lines, size_t end);     /* the direction into the line */

/* The angle by which an arrow would turn that comes along the line of one end and goes on along that of another one. */
double celd_joined_turn (const CeldJoinedLines *lines, size_t a, size_t b);

/* The point of the line of an end that is so many points from there. */
CeldPoint celd_joined_point (const CeldJoinedLines *lines, size_t end, double steps);

/* Finds for all ends from where their lines are alone: before that, those beside them and heads draw the thinned paint
 * aside. */
CeldStatus celd_joined_leads_find (CeldJoinedLines *lines);

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

/* The mean width of the middle half of a line, in pixels; and is it much wider than most of the lines?  Then two may lie
 * on each other. */
double celd_joined_width (const CeldJoinedLines *lines, size_t line);
bool   celd_joined_is_wide (const CeldJoinedLines *lines, size_t line);

/* How many lines end at the node of an end. */
size_t    celd_joined_lines_at (const CeldJoinedLines *lines, size_t end);

/* May two lines just cross at the node of an end, so that none ends there? */
bool      celd_joined_cross_at (const CeldJoinedLines *lines, size_t end);

/* Do all other lines at the node of an end, at least two, go on from it about straight?  Then they lie on each other
 * along its line, and part there. */
bool      celd_joined_part_from (const CeldJoinedLines *lines, size_t end);

/* Is a place so near the frame of the picture that paint may go on beyond? */
bool      celd_joined_is_at_frame (const CeldJoinedLines *lines, CeldPoint place);

/* Is most of the way from the line of an end to a place painted? */
bool celd_joined_is_led_to (const CeldJoinedLines *lines, size_t end, CeldPoint place);

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

/* ------------------------------------------------------------------ monotone-pieces.c */

#define CELD_MOST_PIECES 6 /* into which values are divided; chosen */

/* The sum of squares between n values and the nearest ones that only rise, or only fall, whichever is less. */
CeldStatus celd_monotone_error (const double *value, size_t n, bool *rises, double *error);

/* Where n values may be divided into two pieces of at least `part` values that each only rise or only fall: from
 * range[0] to range[1] values before it, with an error at most `slack` more than the least one. */
CeldStatus celd_monotone_range (const double *value, size_t n, size_t part, double slack, size_t range[2]);

/* Divides n values into the fewest pieces, of at least `part` values that each only rise or only fall, with an error of
 * at most `most`: piece i has the values from cut[i] up to cut[i + 1].  cut has room for CELD_MOST_PIECES + 1 of them.
 * *n_pieces = 0: more would be needed. */
CeldStatus celd_monotone_divide (const double *value, size_t n, size_t part, double most, size_t *cut,
                                 size_t *n_pieces);

/* ------------------------------------------------------------------ line-values.c */

/* Values of the points of a line from `first` on, without those that say nothing. */
typedef struct
{
  const CeldJoinedLines *lines;
  const CeldStrokeLine  *line;
  size_t                 first, n;
  double                *value;
} CeldLineValues;

/* The opacity (0 to 255) or width (in pixels, times the opacity of the paint) of line k at its point i; NAN = others
 * hide it. */
double celd_line_value (const CeldJoinedLines *lines, const CeldArrowLayer *layer, size_t k, size_t i);

/* The values of line k, of which `most` is 1: means of those around each point; where others hide the line, those
 * before go on.  None if much is hidden.  value is the caller's to free in any case. */
CeldStatus celd_line_values_new (const CeldJoinedLines *lines, const CeldArrowLayer *layer, size_t k, double most,
                                 CeldLineValues *values);

/* The colours of the first third of a line and of the last one. */
void celd_line_colours (const CeldLineValues *values, const CeldArrowLayer *layer, CeldPaintColour colour[2]);

/* A straight line, level + slope i, through the values from `from` up to, not with, `to`, by least squares. */
void celd_line_values_fit (const CeldLineValues *values, size_t from, size_t to, double *level, double *slope);

/* ------------------------------------------------------------------ line-profiles.c */

#define CELD_MOST_TURNS (CELD_MOST_PIECES - 1)

/* A point of a line where two arrows meet; vague: they may meet elsewhere. */
typedef struct { size_t at; bool vague; } CeldLineTurn;

/* How the opacity or width of a line changes.  seen: there is enough of the line; known: then values only fall or only
 * rise; value: at its ends, led on to their nodes; tail: the end that is nearer, -1 = they hardly change; colour: of a
 * third of the line at each end; turn: where arrows meet in a line that is not known, in their order. */
typedef struct
{
  bool            seen, known;
  double          value[2];
  int             tail;
  CeldPaintColour colour[2];
  CeldLineTurn    turn[CELD_MOST_TURNS];
  size_t          n_turns;
} CeldLineProfile;

/* most: the value that is 1 in the profile of line k. */
CeldStatus celd_line_profile_find (const CeldJoinedLines *lines, const CeldArrowLayer *layer, size_t k, double most,
                                   CeldLineProfile *profile);

/* ------------------------------------------------------------------ joined-passes.c */

#define CELD_NO_END     SIZE_MAX
#define CELD_SAME_VALUE 0.12 /* between values of an arrow on both sides of a node, at most; chosen */

/* Lines that fade or taper while they are read. */
typedef struct
{
  CeldJoinedLines      *lines;
  const CeldArrowLayer *layer;
  double                most;    /* the value that is 1 in profiles */
  CeldLineProfile      *profile; /* of each line */
  bool                 *alone;   /* of each line: is no other paint beside it? */
  size_t               *next;    /* of each end: the end of another line where its arrow goes on; CELD_NO_END = none */
  bool                 *doubt;   /* of each end: is it unclear whether its arrow goes on? */
} CeldProfileReading;

static inline bool
celd_is_tail (const CeldProfileReading *r, size_t end)
{
  return r->profile[end / 2].tail == (int) (end % 2);
}

static inline bool
celd_is_tip (const CeldProfileReading *r, size_t end)
{
  return r->profile[end / 2].tail >= 0 && !celd_is_tail (r, end);
}

static inline double
celd_value_at (const CeldProfileReading *r, size_t end)
{
  return r->profile[end / 2].value[end % 2];
}

/* Fills in next and doubt, whose profiles are known. */
CeldStatus celd_joined_passes_find (CeldProfileReading *reading);

/* Is an end straight on from one that is in doubt, and may be of the same arrow? */
bool celd_joined_meets_doubt (const CeldProfileReading *reading, size_t end);

/* ------------------------------------------------------------------ joined-places.c */

/* Finds the place of an end; false if it is not clear. */
bool celd_joined_place (const CeldJoinedLines *lines, size_t end, CeldPoint *place);

/* Is more of a line at the frame of the picture than its end? */
bool celd_joined_runs_along_frame (const CeldJoinedLines *lines, size_t line);

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

/* ------------------------------------------------------------------ paint-window.c, head-fits.c, dot-fits.c */

/* The n ends at a node, and of each set of them (bit i: end i has a head or dot there) what that costs, in square
 * widths of paint, and where the node is then.  cost is NULL if nothing is known. */
typedef struct { size_t end[CELD_MOST_MARKS]; int n; double *cost; CeldPoint *tip; } CeldNodeMarks;

/* What a sample of the paint shows; CELD_SAMPLE_UNKNOWN: it is hidden, or of a line. */
enum { CELD_SAMPLE_UNKNOWN = -1, CELD_SAMPLE_BARE = 0, CELD_SAMPLE_PAINT = 1 };

/* Samples round a node, side x side of them, from `corner` on, `step` pixels apart; own: is no other node nearer? */
typedef struct
{
  CeldPoint corner;
  double    step, area; /* area: of a sample, in square widths */
  int       side;
  int8_t   *far, *at;   /* far: without the last parts of the lines of the node; at: after celd_window_lead */
  bool     *own;
} CeldPaintWindow;

/* `far` is to be freed by the caller.  meeting: where the lines of each node meet, NAN = it has none. */
CeldStatus celd_window_new (const CeldJoinedLines *lines, size_t node, const CeldPoint *meeting,
                            CeldPaintWindow *window);
CeldPoint  celd_window_point (const CeldPaintWindow *window, int x, int y);
int        celd_window_at (const CeldPaintWindow *window, CeldPoint p);

/* Leads the lines of a node to a place: their paint is explained.  Returns the part of them that is bare, in square
 * widths. */
double celd_window_lead (const CeldJoinedLines *lines, const CeldNodeMarks *node, CeldPoint place,
                         CeldPaintWindow *window);

/* The paint of the node that belongs to no line, between two distances from a place, in square widths. */
double celd_window_rest (const CeldPaintWindow *window, CeldPoint place, double from, double to);

/* How far a point is from the straight line from a to b. */
double celd_distance_to_part (CeldPoint p, CeldPoint a, CeldPoint b);

/* Finds the costs of a dot, which is the same for all ends of a node, and its place. */
CeldStatus celd_dot_find (const CeldJoinedLines *lines, CeldPoint meeting, CeldPaintWindow *window,
                          CeldNodeMarks *marks);

/* Finds costs and places, for which there is room, of the ends that are given.  The paint of all lines is explained
 * (celd_joined_explain_lines). */
CeldStatus celd_node_marks_find (const CeldJoinedLines *lines, size_t node, const CeldPoint *meeting,
                                 CeldNodeMarks *marks);

/* ------------------------------------------------------------------ head-choice.c */

/* Two ends at a node whose lines may be one arrow that passes there, what that costs, and whether it does. */
typedef struct { size_t end[2]; double cost; bool on; } CeldArrowPass;

/* Which ends have heads or dots, and where arrows pass.  Found are, of each line: the first line of its arrow; of that
 * line the heads of the arrow; and what the best choice costs more in which the line has other heads (margin), and in
 * which one pass at its ends is on that is off, or off that is on (pass_margin). */
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
  double                *margin, *pass_margin;
  /* Of the search: the passes that are on, n_on of them; the lines that are tried now, and in the next round. */
  size_t                *on, n_on;
  bool                  *tried, *tried_next;
} CeldHeadChoice;

/* Finds the choice that costs least, from one without heads and passes. */
CeldStatus celd_head_choice_find (CeldHeadChoice *choice);

/* The set of ends of a node that have heads. */
unsigned celd_head_choice_at (const CeldHeadChoice *choice, int node);

/* ------------------------------------------------------------------ joined-paint.c */

/* Of each pixel of the stroke: the first line of the arrow that it belongs to, of those of which is told. */
CeldStatus celd_joined_paint_divide (const CeldJoinedLines *lines, const CeldLineArrow *arrows, const bool *told,
                                     uint32_t *owner);

/* ------------------------------------------------------------------ joined-heads.c, joined-profiles.c */

/* The arrows of all lines, whose ends have heads or dots; or whose opacity or width changes, for which lines are
 * divided where two arrows meet.  *arrows is to be freed by the caller in any case.  Places are those of nodes where
 * lines meet. */
CeldStatus celd_joined_heads_read (CeldJoinedLines *lines, CeldLineArrow **arrows);
CeldStatus celd_joined_profiles_read (CeldJoinedLines *lines, const CeldArrowLayer *layer, CeldLineArrow **arrows);

#endif
