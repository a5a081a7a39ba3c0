/* Does a free end of joined lines have a head or dot?
 *
 * The paint from the end to a cut through its line is a stroke of its own, which is read as any other (arrowhead.c).  Cuts
 * at several distances are tried, because a head may be long and the line bend behind it.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/joined-arrows.h"

#include <math.h>

/* All chosen; lengths are widths of the paint. */
#define TIP_CUT    4 /* of a line from its end to a cut, beyond which the end is the farthest paint */
#define HOOK       1 /* radians of a sharp turn near a free end, ... */
#define HOOK_REACH 2 /* ... measured so far before and behind it, ... */
#define HOOK_TO    7 /* ... no farther from the end */

/* Connected paint up to a cut; pixels of the mask. */
typedef struct { uint32_t *pixel; size_t n, capacity; } Piece;

/* Fills `piece` from a pixel on, up to a disc round a cut, which is as large as the line is wide. */
static CeldStatus
fill_piece (const CeldJoinedLines *s, size_t start, CeldPoint cut, Piece *piece)
{
  size_t     width = (size_t) s->mask.width;
  uint8_t   *seen = celd_alloc0 (width * (size_t) s->mask.height, 1);
  CeldStatus status = seen ? celd_append (piece->pixel, piece->n, piece->capacity, (uint32_t) start) : CELD_NO_MEMORY;

  if (seen)
    seen[start] = 1;
  for (size_t done = 0; status == CELD_OK && done < piece->n; done++)
    {
      size_t p = piece->pixel[done], beside[4] = { p - width, p + 1, p + width, p - 1 };

      for (int i = 0; i < 4 && status == CELD_OK; i++)
        {
          double x = (double) (beside[i] % width) + 0.5, y = (double) (beside[i] / width) + 0.5;

          if (seen[beside[i]] || !s->mask.painted[beside[i]] || hypot (x - cut.x, y - cut.y) < s->graph.width + 1)
            continue;
          seen[beside[i]] = 1;
          status = celd_append (piece->pixel, piece->n, piece->capacity, (uint32_t) beside[i]);
        }
    }
  celd_free (seen);
  return status;
}

/* The paint between a free end and a cut as a stroke of its own, to be released by the caller. */
static CeldStatus
take_piece (const CeldJoinedLines *s, size_t end, CeldPoint cut, Piece *piece, CeldArrowStroke *stroke)
{
  size_t     row = (size_t) s->stroke->width + 2, width = (size_t) s->mask.width;
  CeldStatus status = fill_piece (s, celd_joined_pixel (s, celd_joined_point (s, end, 1)), cut, piece);

  for (size_t i = 0; i < piece->n; i++)
    piece->pixel[i] = (uint32_t) ((piece->pixel[i] / width + (size_t) s->mask.top + 1) * row +
                                  piece->pixel[i] % width + (size_t) s->mask.left + 1);
  *stroke       = *s->stroke;
  stroke->pixel = piece->pixel;
  stroke->n     = piece->n;
  return status;
}

static void
release_piece (Piece *piece, CeldArrowStroke *stroke)
{
  for (size_t i = 0; i < stroke->n; i++)
    stroke->distance[stroke->pixel[i]] = INFINITY;
  celd_free (piece->pixel);
}

/* A point of the picture in coordinates of the mask. */
static CeldPoint
in_mask (const CeldJoinedLines *s, CeldPoint p)
{
  return (CeldPoint) { p.x - s->mask.left, p.y - s->mask.top };
}

static double
distance (CeldPoint a, CeldPoint b)
{
  return hypot (a.x - b.x, a.y - b.y);
}

CeldStatus
celd_joined_free_tip (const CeldJoinedLines *s, size_t end, CeldPoint *tip)
{
  double          n = (double) s->graph.line[end / 2].n, width = s->graph.width;
  CeldPoint       cut = celd_joined_point (s, end, fmin (TIP_CUT * width, 0.5 * n));
  CeldArrowStroke stroke;
  Piece           piece = { 0 };
  CeldStatus      status = take_piece (s, end, cut, &piece, &stroke);

  *tip = celd_joined_point (s, end, 0);
  if (status == CELD_OK && stroke.n)
    {
      uint32_t  start = celd_stroke_follow (&stroke, stroke.pixel, 1), last = celd_stroke_follow (&stroke, &start, 1);
      CeldPoint a = in_mask (s, celd_stroke_point (&stroke, start)), b = in_mask (s, celd_stroke_point (&stroke, last));

      *tip = distance (a, cut) > distance (b, cut) ? a : b;
    }
  release_piece (&piece, &stroke);
  return status;
}

/* Reads the paint between a free end and a cut.  *found: it is a stroke that leads from the cut to a head or dot, which
 * becomes the tip. */
static CeldStatus
read_to_cut (const CeldJoinedLines *s, size_t end, CeldPoint cut, bool *found, CeldPoint *tip)
{
  CeldArrowStroke stroke;
  CeldArrowEnds   ends;
  Piece           piece = { 0 };
  CeldStatus      status = take_piece (s, end, cut, &piece, &stroke);

  *found = status == CELD_OK && stroke.n >= CELD_LEAST_STROKE &&
           celd_arrowhead (&stroke, s->style == CELD_ARROW_DOT, &ends);
  *found = *found && distance (in_mask (s, ends.tail), cut) < distance (in_mask (s, ends.tip), cut);
  if (*found)
    *tip = in_mask (s, ends.tip);
  release_piece (&piece, &stroke);
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

      if (dot < cos (HOOK) * distance (a, b) * distance (b, c))
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
  bool                found = false;
  CeldStatus          status = CELD_OK;

  for (size_t i = 0; i < sizeof cuts / sizeof *cuts && status == CELD_OK && !found; i++)
    {
      double steps = cuts[i] * s->graph.width;

      if (!i || steps < 0.7 * n)
        status = read_to_cut (s, end, celd_joined_point (s, end, fmin (steps, 0.5 * n)), &found, &e->tip);
    }
  if (found)
    {
      e->mark = CELD_END_MARKED;
      return status;
    }
  celd_joined_find_mark (s, &tried, true);
  if (s->style == CELD_ARROW_DOT)
    *e = tried;
  else
    e->mark = tried.mark == CELD_END_BARE && !has_hook (s, end) && !s->graph.node[celd_joined_node (s, end)].branched
                ? CELD_END_BARE : CELD_END_UNKNOWN;
  if (e->mark == CELD_END_BARE && is_at_frame (s, e->tip))
    e->mark = CELD_END_UNKNOWN;
  return status;
}
