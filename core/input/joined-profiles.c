/* Which way each of several lines that meet fades or tapers.
 *
 * The paint of each line is read alone (arrow-profile.c), without that round places where it meets others, which is of
 * several.  A line that is unclear as a whole may be two arrows that meet at its corner.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/joined-arrows.h"

#include <math.h>
#include <string.h>

#define CORNER_REACH 6   /* widths from a corner to where the directions of its sides are measured; chosen */

/* A part of a line, from a point to another.  Of its ends: the place where others meet it, and the widths round there
 * where the paint is theirs, too; 0 = none meet it. */
typedef struct { size_t line, from, to; CeldPoint place[2]; double apart[2]; } LinePart;

static double
distance (CeldPoint a, CeldPoint b)
{
  return hypot (a.x - b.x, a.y - b.y);
}

static bool
is_apart (const CeldJoinedLines *s, const LinePart *part, CeldPoint p)
{
  for (int i = 0; i < 2; i++)
    if (distance (p, part->place[i]) < part->apart[i] * s->graph.width)
      return false;
  return true;
}

/* Marks the paint round a point of a part, as far as it is wide there. */
static void
mark_paint (CeldJoinedLines *s, const LinePart *part, CeldPoint c)
{
  double r = sqrt (s->mask.squared[celd_joined_pixel (s, c)]) + 1;

  for (int y = (int) fmax (0, c.y - r); y <= c.y + r && y < s->mask.height; y++)
    for (int x = (int) fmax (0, c.x - r); x <= c.x + r && x < s->mask.width; x++)
      {
        CeldPoint p = { x + 0.5, y + 0.5 };
        size_t    i = celd_joined_pixel (s, p);

        if (s->mask.painted[i] && distance (c, p) <= r && is_apart (s, part, p))
          s->explained[i] = 1;
      }
}

/* Collects the marked paint that is connected with a pixel of the mask: circles also reach over narrow gaps. */
static CeldStatus
collect_paint (CeldJoinedLines *s, size_t start, CeldCrossingStrokes *paint, size_t *n)
{
  size_t     width = (size_t) s->mask.width, row = (size_t) s->stroke->width + 2;
  CeldStatus status = CELD_OK;

  if (s->explained[start])
    status = celd_append (paint->pixel, *n, paint->pixel_capacity, (uint32_t) start);
  s->explained[start] = 0;
  for (size_t done = 0; done < *n && status == CELD_OK; done++)
    {
      size_t p = paint->pixel[done], beside[4] = { p - width, p + 1, p + width, p - 1 }; /* no paint is on the border */

      for (int i = 0; i < 4 && status == CELD_OK; i++)
        if (s->explained[beside[i]])
          {
            s->explained[beside[i]] = 0;
            status = celd_append (paint->pixel, *n, paint->pixel_capacity, (uint32_t) beside[i]);
          }
    }
  for (size_t i = 0; i < *n; i++)
    paint->pixel[i] = (uint32_t) ((paint->pixel[i] / width + (size_t) s->mask.top + 1) * row +
                                  paint->pixel[i] % width + (size_t) s->mask.left + 1);
  return status;
}

/* The arrow of a part.  *tail: the end of the part that is nearer; -1 if its opacity or width does not say. */
static CeldStatus
read_part (CeldJoinedLines *s, const LinePart *part, const CeldArrowLayer *layer, CeldLineArrows *to, int *tail)
{
  const CeldStrokeLine *line = &s->graph.line[part->line];
  CeldArrowStroke       stroke = *s->stroke;
  CeldCrossingStrokes   paint = { 0 };
  CeldArrowEnds         ends;
  CeldStatus            status;

  *tail    = -1;
  stroke.n = 0;
  memset (s->explained, 0, (size_t) s->mask.width * (size_t) s->mask.height);
  for (size_t i = part->from; i <= part->to; i++)
    mark_paint (s, part, line->at[i]);
  status = collect_paint (s, celd_joined_pixel (s, line->at[(part->from + part->to) / 2]), &paint, &stroke.n);
  stroke.pixel = paint.pixel;
  if (status == CELD_OK && stroke.n >= CELD_LEAST_STROKE && celd_arrow_profile (&stroke, layer, s->style, &ends))
    {
      CeldPoint end[2] = { { ends.tail.x - s->mask.left, ends.tail.y - s->mask.top },
                           { ends.tip.x - s->mask.left, ends.tip.y - s->mask.top } };

      *tail = distance (end[0], line->at[part->from]) > distance (end[0], line->at[part->to]);
      to->nearer[to->n]    = part->apart[*tail] > 0 ? part->place[*tail] : end[0];
      to->farther[to->n++] = part->apart[!*tail] > 0 ? part->place[!*tail] : end[1];
    }
  for (size_t i = 0; i < stroke.n; i++)
    stroke.distance[stroke.pixel[i]] = INFINITY;
  celd_free (paint.pixel);
  return status;
}

/* From a point of a line to one that is so many points on. */
static CeldPoint
from_corner (const CeldStrokeLine *line, size_t at, double steps)
{
  size_t to = (size_t) fmin (fmax (0, (double) at + steps), (double) (line->n - 1));

  return (CeldPoint) { line->at[to].x - line->at[at].x, line->at[to].y - line->at[at].y };
}

/* The two arrows that meet at the corner of a line. */
static CeldStatus
read_corner (CeldJoinedLines *s, const LinePart *whole, const CeldArrowLayer *layer, CeldLineArrows *to)
{
  const CeldStrokeLine *line = &s->graph.line[whole->line];
  LinePart              part[2] = { *whole, *whole };
  CeldPoint             corner;
  size_t                at = 0;
  double                reach = CORNER_REACH * s->graph.width;
  int                   tail[2] = { -1, -1 };
  CeldStatus            status = CELD_OK;

  if (!celd_stroke_line_corner (&s->graph, whole->line, &corner))
    return CELD_OK;
  for (size_t i = 1; i < line->n; i++)
    if (distance (line->at[i], corner) < distance (line->at[at], corner))
      at = i;
  part[0].to       = part[1].from     = at;
  part[0].place[1] = part[1].place[0] = corner;
  part[0].apart[1] = part[1].apart[0] = celd_widths_apart (from_corner (line, at, -reach), from_corner (line, at, reach));
  for (int i = 0; i < 2 && status == CELD_OK && part[0].apart[1] <= CELD_MOST_APART; i++)
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
      if (whole.apart[i] > CELD_MOST_APART ||
          (whole.apart[i] > 0 && !celd_joined_is_led_to (s, s->graph.line[k].node[i], whole.place[i])))
        return CELD_OK;
    }
  status = read_part (s, &whole, layer, to, &tail);
  if (status == CELD_OK && tail < 0)
    return read_corner (s, &whole, layer, to);
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
