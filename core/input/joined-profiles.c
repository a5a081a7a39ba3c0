/* Which way each of several lines that meet fades or tapers.
 *
 * The paint of each line is read alone (arrow-profile.c), without that round places where it meets others, which is of
 * several.  A line that is unclear as a whole may be two arrows that meet at its corner, or where its opacity or width
 * turns (profile-turn.c).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/joined-arrows.h"

#include <math.h>
#include <string.h>

#define CORNER_REACH 6 /* widths from a corner to where the directions of its sides are measured; chosen */

/* A part of a line, from a point to another.  Of its ends: the place where others meet it, and the widths round there
 * where the paint is theirs, too; 0 = none meet it. */
typedef struct { size_t line, from, to; CeldPoint place[2]; double apart[2]; } LinePart;

static bool
is_apart (const CeldJoinedLines *s, const LinePart *part, CeldPoint p)
{
  for (int i = 0; i < 2; i++)
    if (celd_points_apart (p, part->place[i]) < part->apart[i] * s->graph.width)
      return false;
  return true;
}

/* Lets the paint of a part be taken, as far as the part is wide, and as it is apart from others. */
static void
allow_paint (CeldJoinedLines *s, const LinePart *part)
{
  const CeldStrokeLine *line = &s->graph.line[part->line];
  size_t                p = 0;

  memset (s->may_take, 0, (size_t) s->mask.width * (size_t) s->mask.height);
  for (size_t i = part->from; i <= part->to; i++)
    {
      double r = sqrt (s->mask.squared[celd_joined_pixel (s, line->at[i])]) + 1;

      celd_joined_fill_disc (s, line->at[i], r, 1, s->may_take);
    }
  for (int y = 0; y < s->mask.height; y++)
    for (int x = 0; x < s->mask.width; x++, p++)
      s->may_take[p] = s->may_take[p] && s->mask.painted[p] && is_apart (s, part, (CeldPoint) { x + 0.5, y + 0.5 });
}

/* The arrow of a part.  *tail: the end of the part that is nearer; -1 if its opacity or width does not say. */
static CeldStatus
read_part (CeldJoinedLines *s, const LinePart *part, const CeldArrowLayer *layer, CeldLineArrows *to, int *tail)
{
  const CeldStrokeLine *line = &s->graph.line[part->line];
  CeldJoinedPiece       piece;
  CeldArrowEnds         ends;
  CeldStatus            status;

  *tail = -1;
  allow_paint (s, part);
  status = celd_joined_take (s, line->at[(part->from + part->to) / 2], &piece);
  if (status == CELD_OK && piece.stroke.n >= CELD_LEAST_STROKE &&
      celd_arrow_profile (&piece.stroke, layer, s->style, &ends))
    {
      CeldPoint end[2] = { celd_joined_in_mask (s, ends.tail), celd_joined_in_mask (s, ends.tip) };

      *tail = celd_points_apart (end[0], line->at[part->from]) > celd_points_apart (end[0], line->at[part->to]);
      to->nearer[to->n]    = part->apart[*tail] > 0 ? part->place[*tail] : end[0];
      to->farther[to->n++] = part->apart[!*tail] > 0 ? part->place[!*tail] : end[1];
    }
  celd_joined_release (&piece);
  return status;
}

/* From a point of a line to one that is so many points on. */
static CeldPoint
from_corner (const CeldStrokeLine *line, size_t at, double steps)
{
  size_t to = (size_t) fmin (fmax (0, (double) at + steps), (double) (line->n - 1));

  return (CeldPoint) { line->at[to].x - line->at[at].x, line->at[to].y - line->at[at].y };
}

/* The two arrows that meet at a place of a line. */
static CeldStatus
read_two (CeldJoinedLines *s, const LinePart *whole, CeldPoint place, const CeldArrowLayer *layer, CeldLineArrows *to)
{
  const CeldStrokeLine *line = &s->graph.line[whole->line];
  size_t                at = celd_stroke_line_nearest (line, place);
  LinePart              part[2] = { *whole, *whole };
  double                reach = CORNER_REACH * s->graph.width;
  double                apart = celd_widths_apart (from_corner (line, at, -reach), from_corner (line, at, reach));
  int                   tail[2] = { -1, -1 };
  CeldStatus            status = CELD_OK;

  part[0].to       = part[1].from     = at;
  part[0].place[1] = part[1].place[0] = place;
  part[0].apart[1] = part[1].apart[0] = apart;
  for (int i = 0; i < 2 && status == CELD_OK && apart <= CELD_MOST_APART; i++)
    status = read_part (s, &part[i], layer, to, &tail[i]);
  if (tail[0] < 0 || tail[1] < 0)
    to->n = 0;
  else
    {
      to->role[0] = tail[0] == 0 ? -1 : 1;
      to->role[1] = tail[1] == 1 ? -1 : 1;
    }
  return status;
}

/* The two arrows that meet at the corner of a line. */
static CeldStatus
read_corner (CeldJoinedLines *s, const LinePart *whole, const CeldArrowLayer *layer, CeldLineArrows *to)
{
  CeldPoint corner;

  if (!celd_stroke_line_corner (&s->graph, whole->line, &corner))
    return CELD_OK;
  return read_two (s, whole, corner, layer, to);
}

/* The two arrows that meet where the opacity or width of a line turns. */
static CeldStatus
read_turn (CeldJoinedLines *s, const LinePart *whole, const CeldArrowLayer *layer, CeldLineArrows *to)
{
  const CeldStrokeLine *line = &s->graph.line[whole->line];
  CeldJoinedPiece       piece;
  CeldPoint             place = { 0, 0 };
  double                turn = 0;
  CeldStatus            status;

  allow_paint (s, whole);
  status = celd_joined_take (s, line->at[line->n / 2], &piece);
  if (status == CELD_OK && piece.stroke.n >= CELD_LEAST_STROKE)
    {
      uint32_t start = celd_stroke_follow (&piece.stroke, piece.stroke.pixel, 1);

      celd_stroke_follow (&piece.stroke, &start, 1);
      status = celd_stroke_turn_find (&piece.stroke, layer, s->style, s->graph.width, &turn);
      place  = celd_joined_in_mask (s, celd_stroke_centroid (&piece.stroke, turn - 1, turn + 1));
    }
  celd_joined_release (&piece);
  return turn > 0 ? read_two (s, whole, place, layer, to) : status;
}

static bool
is_moved (const CeldJoinedLines *s, int node, CeldPoint place)
{
  return celd_points_apart (s->graph.node[node].at, place) > CELD_MOST_MOVED * s->graph.width;
}

static CeldStatus
read_line (CeldJoinedLines *s, size_t k, bool alone, const CeldArrowLayer *layer, CeldLineArrows *to)
{
  LinePart   whole = { .line = k, .to = s->graph.line[k].n - 1 };
  int        tail;
  CeldStatus status;

  if (!alone)
    return CELD_OK;
  for (size_t i = 0; i < 2; i++)
    {
      whole.apart[i] = celd_joined_widths_apart (s, 2 * k + i);
      whole.place[i] = celd_joined_meeting_point (s, s->graph.line[k].node[i]);
      if (whole.apart[i] > CELD_MOST_APART || (s->hidden && s->graph.node[s->graph.line[k].node[i]].branched) ||
          (whole.apart[i] > 0 && (!celd_joined_is_led_to (s, s->graph.line[k].node[i], whole.place[i]) ||
                                  is_moved (s, s->graph.line[k].node[i], whole.place[i]))))
        return CELD_OK;
    }
  status = read_part (s, &whole, layer, to, &tail);
  if (status == CELD_OK && tail < 0)
    {
      status = read_corner (s, &whole, layer, to);
      return status == CELD_OK && !to->n && !s->hidden ? read_turn (s, &whole, layer, to) : status;
    }
  for (int i = 0; i < 2; i++)
    to->role[i] = i == tail ? -1 : 1;
  return status;
}

CeldStatus
celd_joined_profiles_read (CeldJoinedLines *lines, const CeldArrowLayer *layer, CeldLineArrows *arrows)
{
  bool      *alone = celd_alloc (lines->graph.n_lines, sizeof *alone);
  CeldStatus status = alone ? CELD_OK : CELD_NO_MEMORY;

  celd_joined_explain_wide_lines (lines);
  for (size_t k = 0; alone && k < lines->graph.n_lines; k++)
    alone[k] = celd_joined_is_alone (lines, k, 0);
  for (size_t k = 0; k < lines->graph.n_lines && status == CELD_OK; k++)
    {
      arrows[k] = (CeldLineArrows) { .n = 0 };
      status    = read_line (lines, k, alone[k], layer, &arrows[k]);
    }
  celd_free (alone);
  return status;
}
