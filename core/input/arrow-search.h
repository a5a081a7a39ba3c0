/* Arrows that share ends, as the choice of shafts and heads that explains their paint best: what search-*.c share.
 *
 * Lengths are pixels of the mask unless something else is said; costs are square widths of paint.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_ARROW_SEARCH_H
#define CELD_ARROW_SEARCH_H

#include "input/joined-arrows.h"

#include <math.h>

#define CELD_MOST_CHOSEN 250 /* arrows of connected paint, at most; chosen */
#define CELD_SAME_COST   3   /* of two arrows along one line; chosen */
#define CELD_ARM_LONG    5   /* length of a line that is no barb, in widths; chosen */
#define CELD_ARM_BEGIN   1.5 /* widths from the end of a line to where its direction is measured; chosen */
#define CELD_ARM_LED     8   /* widths by which lines are led on to the tips of heads; chosen */
#define CELD_NEAR_ENDS   1.5 /* widths, and a pixel: ends of two arrows that are at one place, at most; chosen */
#define CELD_SOFT_EDGE   0.5 /* pixels that a soft edge adds on either side of lines, and all round dots; chosen */
#define CELD_ONE_PLACE   2   /* widths between ends of chosen arrows that are at one place, at most; chosen */

/* A line inside the paint from one place to another.  cost: for how it bends and for paint that is narrow; bow: how far
 * it is from its chord at most, by the length of that; whole: the shaft that is divided if this is a part of one. */
typedef struct { size_t place[2]; CeldPoint *at; size_t n; double length, cost, bow; size_t whole; } CeldShaft;

#define CELD_NO_SHAFT SIZE_MAX

/* Cells of paint. */
typedef struct { uint32_t *cell; size_t n; } CeldPaintPiece;

/* An arrow that may be chosen: a shaft with a head, filled or open, or a dot, at one of its ends, or one that fades or
 * tapers towards it.  cost: without what it explains; mark_cost: the part of that for what is not painted of the head or
 * dot, or for a weak tail or strong tip; value: of a shaft that fades or tapers, at its tail and tip. */
typedef struct
{
  size_t shaft;
  int    end;
  bool   filled;
  double cost, mark_cost;
  size_t body, mark;
  double value[2];
} CeldArrowOption;

/* The chosen options, and what that costs. */
typedef struct { size_t item[CELD_MOST_CHOSEN], n; double cost; } CeldArrowChoice;

typedef struct
{
  const CeldJoinedLines *lines;
  const CeldArrowLayer *layer;
  const CeldStrokeMask *mask;
  double                width;   /* of the paint */
  CeldArrowStyle        style;
  float                *room;    /* of each pixel of the mask: the distance to the edge of the paint */

  CeldPoint            *place;   /* where arrows may begin or end */
  size_t                n_places, place_capacity;
  size_t                n_undivided; /* of the places: behind those are divisions of lines with two heads */
  CeldShaft            *shaft;
  size_t                n_shafts, shaft_capacity;

  /* Cells are squares of `step` pixels, `cell` in square widths, and `area` in costs; of arrows that fade, too, one for
   * each of some levels of opacity, and of those with dots some for paint as wide as a dot.  stamp: of each cell the
   * last outline that has it. */
  double                step, per_pixel, cell, area; /* per_pixel: 1 / step */
  int                   columns, rows, levels;
  uint8_t              *painted;
  uint16_t             *covers;  /* of each cell: how many pieces that are chosen have it */
  uint32_t             *stamp, tick;
  uint32_t             *first, *piece_at; /* the pieces of cell c: piece_at[first[c] .. first[c + 1]] */
  CeldPaintPiece       *piece;
  size_t                n_pieces, piece_capacity;
  uint32_t             *bare;    /* of each piece: how many of its cells nothing that is chosen covers */

  CeldArrowOption      *option;
  size_t                n_options, option_capacity;
  bool                 *chosen;  /* of each option */
  uint16_t             *banned;  /* of each option: for how many reasons it may not be chosen now */
  CeldArrowChoice       choice;

  uint8_t              *passes;  /* of each shaft and place: does the shaft pass it closely?  By shaft, then place */
  size_t               *arrows_at; /* of each place: chosen arrows that end there */
  double               *place_cost; /* of each place: what it costs if an arrow ends there */
  size_t               *passed;  /* of each shaft: places that it passes where arrows end */
  size_t               *uses;    /* of each shaft: options with it that are chosen */
} CeldArrowSearch;

static inline double
celd_search_room (const CeldArrowSearch *s, CeldPoint p)
{
  return p.x >= 0 && p.y >= 0 && p.x < s->mask->width && p.y < s->mask->height
           ? (double) s->room[(size_t) p.y * (size_t) s->mask->width + (size_t) p.x] : 0;
}

/* The cell at a point; SIZE_MAX outside. */
static inline size_t
celd_search_cell (const CeldArrowSearch *s, CeldPoint p)
{
  double x = p.x * s->per_pixel, y = p.y * s->per_pixel;

  return x >= 0 && y >= 0 && x < s->columns && y < s->rows ? (size_t) y * (size_t) s->columns + (size_t) x : SIZE_MAX;
}

/* Do arrows fade or taper, without a head or dot? */
static inline bool
celd_search_has_profiles (const CeldArrowSearch *s)
{
  return s->style == CELD_ARROW_FADE || s->style == CELD_ARROW_TAPER;
}

/* The radius, in pixels, of the paint of a dot which is so many widths of its line without their soft edges. */
static inline double
celd_search_dot_radius (const CeldArrowSearch *s, double widths)
{
  return widths * fmax (0, s->width - 2 * CELD_SOFT_EDGE) + CELD_SOFT_EDGE;
}

/* How many cells there are in all levels, and in one. */
static inline size_t
celd_search_plane (const CeldArrowSearch *s)
{
  return (size_t) s->columns * (size_t) s->rows;
}

static inline size_t
celd_search_cells (const CeldArrowSearch *s)
{
  return (size_t) s->levels * celd_search_plane (s);
}

static inline CeldPoint
celd_search_between (CeldPoint a, CeldPoint b, double t)
{
  return (CeldPoint) { a.x + t * (b.x - a.x), a.y + t * (b.y - a.y) };
}

/* The shaft of chosen arrow k. */
static inline const CeldShaft *
celd_chosen_shaft (const CeldArrowSearch *s, size_t k)
{
  return &s->shaft[s->option[s->choice.item[k]].shaft];
}

/* The place where an option has its head or dot (marked), or its other end. */
static inline CeldPoint
celd_option_place (const CeldArrowSearch *s, const CeldArrowOption *o, bool marked)
{
  return s->place[s->shaft[o->shaft].place[(o->end == 1) == marked]];
}

/* ------------------------------------------------------------------ search-places.c */

/* An end of a traced line, and its direction outwards. */
typedef struct { CeldPoint at, way; double length; size_t line; int end; } CeldStrokeArm;

CeldStatus celd_search_places_find (CeldArrowSearch *search);

/* ------------------------------------------------------------------ search-votes.c */

/* The places where lines meet that are led on from their ends, and where heads fit, the most certain first.  *place is
 * to be freed by the caller in any case. */
CeldStatus celd_search_votes_count (const CeldArrowSearch *search, const CeldStrokeArm *arm, size_t n_arms,
                                    CeldPoint **place, size_t *n);

/* ------------------------------------------------------------------ search-turns.c */

typedef enum { CELD_TURN_ROUND, CELD_TURN_CORNER } CeldTurnKind;

/* The round ends, or the corners, of a traced line.  *place is to be freed by the caller in any case. */
CeldStatus celd_search_turns_list (const CeldArrowSearch *search, const CeldStrokeLine *line, CeldTurnKind kind,
                                   CeldPoint **place, size_t *n);

/* ------------------------------------------------------------------ search-shafts.c */

CeldStatus celd_search_shafts_find (CeldArrowSearch *search);

/* The direction of a shaft into one of its ends, measured from a distance. */
CeldPoint celd_shaft_way (const CeldShaft *shaft, int end, double from);

double celd_distance_to_shaft (const CeldShaft *shaft, CeldPoint p);

/* ------------------------------------------------------------------ search-profiles.c */

/* How strong the paint is at a point, about 1 where arrows begin: its opacity, or the distance to its edge. */
double celd_search_strength (const CeldArrowSearch *search, CeldPoint p);

/* A point of a shaft; fall: how strong the paint is there at most of an arrow that only gets weaker towards either
 * end. */
typedef struct { CeldPoint at; double fall[2]; } CeldShaftSample;

/* *sample is to be freed by the caller. */
CeldStatus celd_shaft_samples_new (const CeldArrowSearch *search, const CeldShaft *shaft, CeldShaftSample **sample,
                                   int *n);

/* ------------------------------------------------------------------ search-heads.c */

/* The outline of a head or dot: the tip, or the centre, and the ends of barbs; `filled` heads have the tip a little
 * ahead. */
typedef enum { CELD_OUTLINE_OPEN, CELD_OUTLINE_FILLED, CELD_OUTLINE_DOT } CeldOutlineKind;
typedef struct { CeldOutlineKind kind; CeldPoint tip, barb[2]; double radius, cost; } CeldHeadOutline;

#define CELD_MOST_HEADS 4 /* open heads of a narrow or a wide barb on either side */

/* The heads that fit the paint near a place where a line in direction `way` ends, the best one first: how many there
 * are.  `shaft` (of each cell: is it of that line?): only paint beside that shows a head; NULL: it is not known. */
int             celd_search_heads_fit (const CeldArrowSearch *search, CeldOutlineKind kind, CeldPoint place,
                                       CeldPoint way, const uint8_t *shaft, CeldHeadOutline *heads);
CeldHeadOutline celd_search_dot_fit (const CeldArrowSearch *search, CeldPoint place);

/* ------------------------------------------------------------------ search-cover.c */

CeldStatus celd_search_cells_new (CeldArrowSearch *search);

/* Makes the options of all shafts. */
CeldStatus celd_search_options_new (CeldArrowSearch *search);

/* Makes the piece of paint that a shaft explains. */
CeldStatus celd_search_shaft_piece (CeldArrowSearch *search, const CeldShaft *shaft, size_t *piece);

/* Adds an option, whose cost is found. */
CeldStatus celd_search_option_add (CeldArrowSearch *search, CeldArrowOption option);

/* Lists the pieces of each cell, when all options are there; all of them are bare. */
CeldStatus celd_search_pieces_index (CeldArrowSearch *search);

/* ------------------------------------------------------------------ search-divisions.c */

/* Adds the places where lines with a head at either end are divided, and the shafts and options of both parts. */
CeldStatus celd_search_divisions_add (CeldArrowSearch *search);

/* ------------------------------------------------------------------ search-choice.c */

CeldStatus celd_search_choice_new (CeldArrowSearch *search);

/* What choosing an option adds to the cost; it is not chosen yet. */
double celd_search_change (CeldArrowSearch *search, size_t option);
void   celd_search_choose (CeldArrowSearch *search, size_t option);
void   celd_search_leave (CeldArrowSearch *search, size_t option);
void   celd_search_restore (CeldArrowSearch *search, const CeldArrowChoice *choice);

/* Chooses what lowers the cost most, up to `most` times. */
void   celd_search_add (CeldArrowSearch *search, size_t most);

static inline bool
celd_shaft_passes (const CeldArrowSearch *s, size_t shaft, size_t place)
{
  return s->passes[shaft * s->n_places + place];
}

/* ------------------------------------------------------------------ search-moves.c */

/* Finds a choice that costs less than all that are near it.  All its heads are filled, or all are open, because whoever
 * paints arrows that share ends paints them alike; options with other heads stay banned. */
CeldStatus celd_search_best (CeldArrowSearch *search);

/* Improves what is near an option, without pairs. */
void celd_search_improve_near (CeldArrowSearch *search, size_t option);

/* Chooses again without arrows that end at a place (drop), or that pass it, and with bans of those meanwhile; false if
 * there are none. */
bool celd_search_force (CeldArrowSearch *search, size_t place, bool drop);

/* Are the ends of two options at the same places, in the same direction? */
bool celd_options_alike (const CeldArrowSearch *search, size_t a, size_t b);

/* ------------------------------------------------------------------ search-margins.c */

/* Of each chosen option: what the best choice without it costs more.  The choice may become better.  `margin` has room
 * for CELD_MOST_CHOSEN. */
void celd_search_margins_find (CeldArrowSearch *search, double *margin);

/* ------------------------------------------------------------------ search-rest.c */

/* Of each chosen arrow, in square widths: the area of its head or dot that no line explains (seen), and of that what no
 * other head does (own), or none at another place (of_place: in all levels); arrows share dots.  rest: the unexplained
 * paint that is nearer to it than to others. */
typedef struct
{
  double seen[CELD_MOST_CHOSEN], own[CELD_MOST_CHOSEN], of_place[CELD_MOST_CHOSEN], rest[CELD_MOST_CHOSEN];
} CeldChoicePaint;

CeldStatus celd_choice_paint_measure (CeldArrowSearch *search, CeldChoicePaint *paint);

/* The area of unexplained paint round a shaft, in square widths. */
double celd_rest_round (CeldArrowSearch *search, const CeldShaft *shaft);

/* ------------------------------------------------------------------ search-meetings.c */

/* Of arrows that fade or taper: does something show that arrows end at a place?  One of them cannot go on straight
 * there, or values jump from weak to strong, or two weak ends meet. */
bool celd_search_shows_end (const CeldArrowSearch *search, size_t place);

/* Does no arrow end near a place, but not at it? */
bool celd_search_is_apart (const CeldArrowSearch *search, size_t place);

/* Does chosen arrow i pass a place where others end so closely that it may end there, too? */
bool celd_chosen_passes_end (const CeldArrowSearch *search, size_t i);

/* Does a chosen arrow pass a place so closely? */
bool celd_search_is_passed (const CeldArrowSearch *search, size_t place);

/* Does arrow i lead through a place where two others do, too?  Three that cross in one place more likely end there. */
bool celd_chosen_is_crossed_twice (const CeldArrowSearch *search, size_t i);

/* ------------------------------------------------------------------ search-shown.c */

#define CELD_LEAST_OWN 0.8 /* area of the paint of a head or dot that no line explains, in square widths; chosen */

/* The chosen arrows, and of each: its margin, whether the graph gives it, too, and whether it is clear if others do not
 * count. */
typedef struct
{
  CeldArrowSearch       *s;
  const CeldJoinedLines *lines;
  const double          *margin;
  CeldChoicePaint        paint;
  bool                   agreed[CELD_MOST_CHOSEN], clear[CELD_MOST_CHOSEN];
} CeldClearness;

/* Does something show that arrows end at a place: a head or dot, or that none of them can go on straight there?  Of
 * arrows with dots, one that cannot is enough. */
bool celd_clear_is_shown (const CeldClearness *r, size_t place);

/* May arrow i and another one be one arrow that passes the place between them? */
bool celd_clear_may_pass (const CeldClearness *r, size_t i);

/* Does arrow i end with others, without a head or dot, where a third one passes, or where four ends look like a
 * crossing?  Then it may be part of one that crosses there. */
bool celd_clear_may_cross (const CeldClearness *r, size_t i);

/* ------------------------------------------------------------------ search-clear.c */

/* Of each chosen option: why its arrow is unclear.  margin is that of celd_search_margins_find; `unclear` has room for
 * CELD_MOST_CHOSEN.  other: the arrows of the lines, of which some become unclear. */
CeldStatus celd_search_clear_find (CeldArrowSearch *search, const CeldJoinedLines *lines, CeldLineArrow *other,
                                   const double *margin, CeldArrowReason *unclear);

/* ------------------------------------------------------------------ search-arrows.c */

/* The arrows of lines->mask, whose paint is in a layer, and a graph whose lines they are; the caller clears and frees
 * both in any case.  other: the arrows of the lines as they are read one by one, of which some become unclear.  *arrows
 * is NULL if there may be too many. */
CeldStatus celd_search_arrows_read (const CeldJoinedLines *lines, const CeldArrowLayer *layer, CeldLineArrow *other,
                                    CeldStrokeGraph *graph, CeldLineArrow **arrows);

#endif
