/* Arrows of several colours that share ends or lie on each other: those of each colour are read alone.
 *
 * The paint of a colour is one stroke, or lines that meet (joined-arrows.c); what other colours hide is unknown there,
 * so that one end that is seen tells where the head or dot is.  An arrow is left out if an end of it is hidden below others
 * and its place unknown (hidden-ends.c).  Two arrows of one colour with heads or dots may look like one where these are
 * hidden, so that on the paint of an arrow with a hidden end no other one may end; what a much larger piece of the same
 * colour is near to may be a part of that.
 *
 * Cost: some passes over the paint of each arrow.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/joined-arrows.h"

#include <math.h>

/* All chosen; lengths are mean widths of an arrow, with its head or dot. */
#define LEAST_ARROW 3 /* what is shorter may be a piece of one */
#define AWAY        3 /* from the ends of an arrow */
#define MARK_AREA   2 /* from the tip of a head, or the middle of a dot, to what belongs to it */

typedef struct
{
  CeldColouredPaint paint;
  CeldArrowStyle    style;
  bool              graded; /* the arrows fade or taper */
  CeldArrowEnd     *end;    /* two for each relation from `first` on */
  size_t            n, capacity, first;
  CeldProblems      doubts; /* of each of these relations, the problem that it is if its ends are unclear */
} ColouredArrows;

/* The mean width of an arrow that is all of a stroke, with its head or dot. */
static double
mean_width (const CeldArrowStroke *stroke, CeldPoint tail, CeldPoint tip)
{
  return (double) stroke->n / fmax (1, celd_points_apart (tip, tail));
}

static CeldEndSight
sight_of (const ColouredArrows *s, double width, bool nearer)
{
  if (s->graded)
    return nearer ? CELD_SIGHT_STRONG : CELD_SIGHT_NONE;
  return !(width > 0) && nearer == (s->style == CELD_ARROW_DOT) ? CELD_SIGHT_MARKED : CELD_SIGHT_NONE;
}

/* Appends the ends of the relations from `before` on, which are those of part k.  width: of its lines; 0 = it is one
 * line. */
static CeldStatus
add_ends (ColouredArrows *s, const CeldArrowStroke *stroke, size_t k, const CeldRelations *relations, size_t before,
          double width)
{
  CeldStatus status = CELD_OK;

  for (size_t i = before; i < relations->n && status == CELD_OK; i++)
    {
      const CeldRelation *r = &relations->item[i];
      CeldPoint           tail = { r->nearer.x, r->nearer.y }, tip = { r->farther.x, r->farther.y };
      double              mean = width > 0 ? width : mean_width (stroke, tail, tip);
      CeldArrowEnd        from = celd_arrow_end (&s->paint, stroke, k, tail, tip, mean, sight_of (s, width, true));
      CeldArrowEnd        to = celd_arrow_end (&s->paint, stroke, k, tip, tail, mean, sight_of (s, width, false));

      from.bare = s->style == CELD_ARROW_HEAD;
      to.bare   = to.dotted = s->style == CELD_ARROW_DOT;
      if (s->style == CELD_ARROW_DOT) /* what is so broad may hide an end anywhere */
        from.is_about = to.is_about = false;
      status = celd_append (s->end, s->n, s->capacity, from);
      if (status == CELD_OK)
        status = celd_append (s->end, s->n, s->capacity, to);
    }
  return status;
}

/* Is most of the head or dot of each relation from `before` on seen?  Else what looks like one may be other paint. */
static bool
marks_are_seen (const ColouredArrows *s, const CeldArrowStroke *stroke, const bool *seen, const CeldRelations *relations,
                size_t before)
{
  for (size_t i = before; i < relations->n && !s->graded; i++)
    {
      const CeldRelation *r = &relations->item[i];
      CeldPoint           tail = { r->nearer.x, r->nearer.y }, tip = { r->farther.x, r->farther.y };
      CeldPoint           mark = s->style == CELD_ARROW_DOT ? tail : tip;
      double              reach = MARK_AREA * mean_width (stroke, tail, tip), all = 0, hidden = 0;

      for (size_t k = 0; k < stroke->n; k++)
        if (celd_points_apart (celd_stroke_point (stroke, stroke->pixel[k]), mark) <= reach)
          {
            all++;
            hidden += !seen[k];
          }
      if (hidden > CELD_MARK_HIDDEN * all)
        return false;
    }
  return true;
}

/* Appends the doubts of the relations from `before` on, which are those of all strokes that cross, or of the whole. */
static CeldStatus
add_doubts (ColouredArrows *s, const CeldArrowStroke *whole, const CeldCrossingStrokes *strokes,
            const CeldStrokeCover *cover, const CeldRelations *relations, size_t before)
{
  CeldArrowStroke stroke = *whole;
  CeldStatus      status = CELD_OK;

  for (size_t k = 0; k < relations->n - before && status == CELD_OK; k++)
    {
      if (relations->n - before > 1)
        celd_stroke_select (strokes, k, &stroke);
      status = celd_arrow_problem_add (&s->doubts, CELD_REASON_NONE, celd_stroke_middle (&stroke), &stroke, cover);
    }
  return status;
}

/* Reads a part of a colour: as a stroke, or several that cross, else as lines that meet. */
static CeldStatus
read_part (ColouredArrows *s, CeldArrowStroke *stroke, size_t k, CeldRelations *relations, CeldProblems *problems)
{
  const CeldColourStrokes *colours = s->paint.colours;
  CeldCrossingStrokes      strokes = { 0 };
  CeldStrokeCover          cover = {
    s->paint.component, stroke->pixel, stroke->n, &colours->seen[colours->strokes.first[k]] };
  CeldJoinedFound          found = { 0 };
  size_t                   before = relations->n;
  bool                     clear = false, readable = s->graded || !colours->remnant[k], marked = true;
  CeldStatus               status;

  status = readable ? celd_arrow_strokes_read (stroke, s->paint.layer, s->style, relations, &strokes, &clear)
                    : celd_crossing_strokes_find (stroke, &strokes);
  if (clear && !marks_are_seen (s, stroke, cover.seen, relations, before))
    {
      relations->n = before;
      clear = marked = false;
    }
  if (status == CELD_OK && clear)
    status = add_doubts (s, stroke, &strokes, &cover, relations, before);
  else if (status == CELD_OK && readable)
    status = celd_joined_arrows_read (stroke, &cover, s->paint.layer, s->style, relations, problems, &s->doubts,
                                      &found);
  if (status == CELD_OK && (clear || found.width > 0))
    status = add_ends (s, stroke, k, relations, before, found.width);
  else if (status == CELD_OK)
    status = celd_arrow_strokes_report (stroke, &strokes, &cover, s->paint.layer, s->style,
                                        readable && marked ? celd_joined_reason (&found, &strokes) : CELD_REASON_HIDDEN,
                                        problems);
  celd_crossing_strokes_clear (&strokes);
  return status;
}

/* Is a place on the paint of a relation, or beside it up to a distance? */
static bool
is_on (const ColouredArrows *s, size_t relation, CeldPoint p, double distance)
{
  const CeldProblem *paint = &s->doubts.item[relation];

  for (size_t i = paint->first; i < paint->first + paint->runs; i++)
    {
      const CeldPaintRun *run = &s->doubts.run[i];
      CeldPoint           a = { run->x + 0.5, run->y + 0.5 }, b = { run->x + run->n - 0.5, run->y + 0.5 };

      if (celd_distance_to_part (p, a, b) <= distance)
        return true;
    }
  return false;
}

/* Does another arrow end on an arrow, away from its ends?  Then two of its colour may meet there. */
static bool
may_be_two (const ColouredArrows *s, size_t relation)
{
  const CeldArrowEnd *own = &s->end[2 * relation];

  for (size_t i = 0; i < s->n; i++)
    {
      CeldPoint p = s->end[i].place;

      if (i / 2 != relation &&
          fmin (celd_points_apart (own[0].place, p), celd_points_apart (own[1].place, p)) >= AWAY * own->width &&
          is_on (s, relation, p, own->width))
        return true;
    }
  return false;
}

/* Why an arrow is not clear in all, if so.  One with both ends in sight needs not be looked at any more. */
static CeldArrowReason
why_unclear (const ColouredArrows *s, size_t relation)
{
  const CeldArrowEnd *end = &s->end[2 * relation];

  if (!end[0].known || !end[1].known)
    return CELD_REASON_HIDDEN;
  if (celd_points_apart (end[0].place, end[1].place) < LEAST_ARROW * end->width)
    return CELD_REASON_SHORT;
  if (!s->graded && !(end[0].visible && end[1].visible) && may_be_two (s, relation))
    return CELD_REASON_MEETING;
  return CELD_REASON_NONE;
}

/* Gives relations the places of their ends, and removes and reports those that have none, or are too short. */
static CeldStatus
settle (ColouredArrows *s, CeldRelations *relations, CeldProblems *problems)
{
  size_t     kept = s->first;
  CeldStatus status = CELD_OK;

  for (size_t i = 0; i < s->n / 2 && status == CELD_OK; i++)
    {
      const CeldArrowEnd *end = &s->end[2 * i];
      CeldProblem        *doubt = &s->doubts.item[i];
      CeldRelation        r = relations->item[s->first + i];

      r.nearer.x    = end[0].place.x;
      r.nearer.y    = end[0].place.y;
      r.farther.x   = end[1].place.x;
      r.farther.y   = end[1].place.y;
      doubt->x      = (int) end[0].place.x;
      doubt->y      = (int) end[0].place.y;
      doubt->reason = why_unclear (s, i);
      if (doubt->reason)
        status = celd_problem_copy (&s->doubts, i, problems);
      else
        relations->item[kept++] = r;
    }
  relations->n = kept;
  return status;
}

CeldStatus
celd_coloured_arrows_read (const CeldColourStrokes *colours, const CeldArrowStroke *component,
                           const CeldArrowLayer *layer, CeldArrowStyle style, CeldRelations *relations,
                           CeldProblems *problems)
{
  CeldStrokeMask mask;
  ColouredArrows s = {
    .paint = { &mask, layer, colours }, .style = style, .graded = style == CELD_ARROW_FADE || style == CELD_ARROW_TAPER,
    .first = relations->n,
  };
  CeldArrowStroke stroke = *component;
  CeldStatus      status = celd_stroke_mask_new (component, &mask);

  if (status != CELD_OK)
    return status;
  for (size_t k = 0; k < colours->strokes.n && status == CELD_OK; k++)
    {
      celd_stroke_select (&colours->strokes, k, &stroke);
      if (stroke.n >= CELD_LEAST_PART)
        status = read_part (&s, &stroke, k, relations, problems);
    }
  if (status == CELD_OK)
    {
      celd_arrow_ends_find (&mask, s.graded, s.end, s.n);
      status = settle (&s, relations, problems);
    }
  celd_free (s.end);
  celd_problems_clear (&s.doubts);
  celd_stroke_mask_clear (&mask);
  return status;
}
