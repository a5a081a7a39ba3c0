/* Arrows of several colours that share ends or lie on each other: those of each colour are read alone.
 *
 * The paint of a colour is one stroke, or lines that meet (joined-arrows.c); what other colours hide is unknown there,
 * so that one end that is seen tells where the head or dot is.  An arrow is left out if an end of it is hidden below others
 * and its place unknown (hidden-ends.c).  Two arrows of one colour with heads or dots may look like one where these are
 * hidden, so that on an arrow with a hidden end no other one may end; what a much larger piece of the same colour is
 * near to may be a part of that.
 *
 * Cost: some passes over the paint of each arrow.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/input.h"

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

/* Reads a part of a colour: as a stroke, or several that cross, else as lines that meet. */
static CeldStatus
read_part (ColouredArrows *s, CeldArrowStroke *stroke, size_t k, CeldRelations *relations, CeldProblems *problems)
{
  const CeldColourStrokes *colours = s->paint.colours;
  CeldCrossingStrokes      strokes = { 0 };
  CeldStrokeCover          cover = { s->paint.component, &colours->seen[colours->strokes.first[k]] };
  size_t                   before = relations->n;
  double                   width = 0;
  bool                     clear = false, readable = s->graded || !colours->remnant[k];
  CeldStatus               status;

  status = readable ? celd_arrow_strokes_read (stroke, s->paint.layer, s->style, relations, &strokes, &clear)
                    : celd_crossing_strokes_find (stroke, &strokes);
  if (clear && !marks_are_seen (s, stroke, cover.seen, relations, before))
    {
      relations->n = before;
      clear        = false;
    }
  if (status == CELD_OK && readable && !clear)
    status = celd_joined_arrows_read (stroke, &cover, s->paint.layer, s->style, relations, problems, &width);
  if (status == CELD_OK)
    status = clear || width > 0 ? add_ends (s, stroke, k, relations, before, width)
                                : celd_arrow_strokes_report (stroke, &strokes, problems);
  celd_crossing_strokes_clear (&strokes);
  return status;
}

/* Does another arrow end on an arrow, away from its ends?  Then two of its colour may meet there. */
static bool
may_be_two (const ColouredArrows *s, const CeldArrowStroke *component, size_t relation)
{
  const CeldColourStrokes *colours = s->paint.colours;
  const CeldArrowEnd      *own = &s->end[2 * relation];
  const size_t            *first = &colours->strokes.first[own->stroke];

  for (size_t i = 0; i < s->n; i++)
    {
      CeldPoint p = s->end[i].place;

      if (i / 2 == relation ||
          fmin (celd_points_apart (own[0].place, p), celd_points_apart (own[1].place, p)) < AWAY * own->width)
        continue;
      for (size_t k = first[0]; k < first[1]; k++)
        if (celd_points_apart (celd_stroke_point (component, colours->strokes.pixel[k]), p) <= own->width)
          return true;
    }
  return false;
}

/* Is an arrow clear in all?  One with both ends in sight needs not be looked at any more. */
static bool
is_clear (const ColouredArrows *s, const CeldArrowStroke *component, size_t relation)
{
  const CeldArrowEnd *end = &s->end[2 * relation];

  return end[0].known && end[1].known && celd_points_apart (end[0].place, end[1].place) >= LEAST_ARROW * end->width &&
         (s->graded || (end[0].visible && end[1].visible) || !may_be_two (s, component, relation));
}

/* Gives relations the places of their ends, and removes and reports those that have none, or are too short. */
static CeldStatus
settle (const ColouredArrows *s, const CeldArrowStroke *component, CeldRelations *relations, CeldProblems *problems)
{
  size_t     kept = s->first;
  CeldStatus status = CELD_OK;

  for (size_t i = 0; i < s->n / 2 && status == CELD_OK; i++)
    {
      CeldRelation r = relations->item[s->first + i];
      CeldPoint    from = s->end[2 * i].place, to = s->end[2 * i + 1].place;

      r.nearer.x  = from.x;
      r.nearer.y  = from.y;
      r.farther.x = to.x;
      r.farther.y = to.y;
      if (is_clear (s, component, i))
        relations->item[kept++] = r;
      else
        status = celd_problem_add (problems, (CeldProblem) {
          .kind = CELD_PROBLEM_ARROW_UNCLEAR, .relation = CELD_NO_INDEX, .x = (int) from.x, .y = (int) from.y,
        });
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
      status = settle (&s, component, relations, problems);
    }
  celd_free (s.end);
  celd_stroke_mask_clear (&mask);
  return status;
}
