/* Does a free end of joined lines have a head or dot?
 *
 * The paint from the end to a cut through its line is a stroke of its own, which is read as any other (arrowhead.c).
 * Cuts at several distances are tried, because a head may be long and the line bend behind it.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/joined-arrows.h"

#include <math.h>
#include <string.h>

/* All chosen; lengths are widths of the paint. */
#define TIP_CUT    4 /* of a line from its end to a cut, beyond which the end is the farthest paint */
#define MARK_REACH 3.5 /* from the tip of a head, or the middle of a dot, to what belongs to it */
#define OTHERS     1.5 /* from a free end to paint of other colours that may hide a head */
#define HOOK       1 /* radians of a sharp turn near a free end, ... */
#define HOOK_REACH 2 /* ... measured so far before and behind it, ... */
#define HOOK_TO    7 /* ... no farther from the end */

/* The paint between a free end and a cut as a stroke of its own, to be released by the caller.  The cut is a disc as
 * wide as the line. */
static CeldStatus
take_to_cut (const CeldJoinedLines *s, size_t end, CeldPoint cut, CeldJoinedPiece *piece)
{
  memcpy (s->may_take, s->mask.painted, (size_t) s->mask.width * (size_t) s->mask.height);
  celd_joined_fill_disc (s, cut, s->graph.width + 1, 0, s->may_take);
  return celd_joined_take (s, celd_joined_point (s, end, 1), piece);
}

CeldStatus
celd_joined_free_tip (const CeldJoinedLines *s, size_t end, CeldPoint *tip)
{
  double          n = (double) s->graph.line[end / 2].n, width = s->graph.width;
  CeldPoint       cut = celd_joined_point (s, end, fmin (TIP_CUT * width, 0.5 * n));
  CeldJoinedPiece piece;
  CeldStatus      status = take_to_cut (s, end, cut, &piece);

  *tip = celd_joined_point (s, end, 0);
  if (status == CELD_OK && piece.stroke.n)
    {
      uint32_t  start = celd_stroke_follow (&piece.stroke, piece.pixel, 1);
      uint32_t  last = celd_stroke_follow (&piece.stroke, &start, 1);
      CeldPoint a = celd_joined_in_mask (s, celd_stroke_point (&piece.stroke, start));
      CeldPoint b = celd_joined_in_mask (s, celd_stroke_point (&piece.stroke, last));

      *tip = celd_points_apart (a, cut) > celd_points_apart (b, cut) ? a : b;
    }
  celd_joined_release (&piece);
  return status;
}

/* Is most of the head or dot of a piece seen?  Else what looks like one may be the form of other paint. */
static bool
is_mark_seen (const CeldJoinedLines *s, const CeldArrowStroke *piece, CeldPoint tip)
{
  double hidden = 0, all = 0;

  for (size_t i = 0; i < piece->n && s->hidden; i++)
    {
      CeldPoint p = celd_joined_in_mask (s, celd_stroke_point (piece, piece->pixel[i]));

      if (celd_points_apart (p, tip) > MARK_REACH * s->graph.width)
        continue;
      all++;
      hidden += s->hidden[celd_joined_pixel (s, p)];
    }
  return hidden <= CELD_MARK_HIDDEN * all;
}

/* Reads the paint between a free end and a cut.  *found: it is a stroke that leads from the cut to a head or dot, which
 * becomes the tip. */
static CeldStatus
read_to_cut (const CeldJoinedLines *s, size_t end, CeldPoint cut, bool *found, CeldPoint *tip)
{
  CeldArrowEnds   ends;
  CeldJoinedPiece piece;
  CeldStatus      status = take_to_cut (s, end, cut, &piece);

  *found = status == CELD_OK && piece.stroke.n >= CELD_LEAST_STROKE &&
           celd_arrowhead (&piece.stroke, s->style == CELD_ARROW_DOT, &ends);
  *found = *found && celd_points_apart (celd_joined_in_mask (s, ends.tail), cut) <
                       celd_points_apart (celd_joined_in_mask (s, ends.tip), cut) &&
           is_mark_seen (s, &piece.stroke, celd_joined_in_mask (s, ends.tip));
  if (*found)
    *tip = celd_joined_in_mask (s, ends.tip);
  celd_joined_release (&piece);
  return status;
}

/* Does a line turn sharply near its end?  Then what looks like a bare end may be a barb of a head with only one. */
static bool
has_hook (const CeldJoinedLines *s, size_t end)
{
  double w = s->graph.width, reach = fmax (4, HOOK_REACH * w);

  for (double at = reach; at <= HOOK_TO * w; at++)
    {
      CeldPoint a = celd_joined_point (s, end, at - reach), b = celd_joined_point (s, end, at);
      CeldPoint c = celd_joined_point (s, end, at + reach);
      double    dot = (b.x - a.x) * (c.x - b.x) + (b.y - a.y) * (c.y - b.y);

      if (dot < cos (HOOK) * celd_points_apart (a, b) * celd_points_apart (b, c))
        return true;
    }
  return false;
}

/* Does the paint of a tip reach the frame of the picture?  Then a head or dot may lie beyond it. */
static bool
is_at_frame (const CeldJoinedLines *s, CeldPoint tip)
{
  double x = tip.x + s->mask.left, y = tip.y + s->mask.top, reach = s->graph.width + 1;

  return fmin (x, y) < reach || x > s->stroke->width - reach || y > s->stroke->height - reach;
}

CeldStatus
celd_joined_read_free_end (CeldJoinedLines *s, size_t end)
{
  static const double cuts[] = { 8, 11, 15, 20 }; /* widths from the end; chosen */
  double              n = (double) s->graph.line[end / 2].n;
  CeldJoinedEnd      *e = &s->end[end], tried = *e;
  bool                found = false, straight = !has_hook (s, end) && !s->graph.node[celd_joined_node (s, end)].branched;
  CeldStatus          status = CELD_OK;

  for (size_t i = 0; i < sizeof cuts / sizeof *cuts && status == CELD_OK && !found; i++)
    {
      double steps = cuts[i] * s->graph.width;

      if (!i || steps < 0.7 * n)
        status = read_to_cut (s, end, celd_joined_point (s, end, fmin (steps, 0.5 * n)), &found, &e->tip);
    }
  e->covered = straight && celd_joined_hidden_share (s, e->tip, OTHERS * s->graph.width) > 0;
  if (found)
    {
      e->mark = s->hidden && is_at_frame (s, e->tip) ? CELD_END_UNKNOWN : CELD_END_MARKED;
      return status;
    }
  celd_joined_find_mark (s, &tried, true);
  if (s->style == CELD_ARROW_DOT || tried.mark == CELD_END_HIDDEN)
    *e = tried;
  else
    e->mark = tried.mark == CELD_END_BARE && straight ? CELD_END_BARE : CELD_END_UNKNOWN;
  if ((e->mark == CELD_END_BARE || s->hidden) && is_at_frame (s, e->tip))
    e->mark = CELD_END_UNKNOWN;
  return status;
}
