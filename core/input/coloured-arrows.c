/* Arrows of several colours that share ends or lie on each other: those of each colour are read alone.
 *
 * The paint of a colour is one stroke, or lines that meet (joined-arrows.c); what other colours hide is unknown there, so
 * that one end that is seen tells where the head or dot is.  An arrow is left out if an end of it is hidden below others
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

/* Both chosen; lengths are mean widths of an arrow, with its head or dot. */
#define LEAST_ARROW 3 /* what is shorter may be a piece of one */
#define AWAY        3 /* from the ends of an arrow */

typedef struct
{
  CeldColouredPaint paint;
  CeldArrowStyle    style;
  bool              graded; /* the arrows fade or taper */
  CeldArrowEnd     *end;    /* two for each relation from `first` on */
  size_t            n, capacity, first;
} ColouredArrows;

static double
distance_to (CeldPoint a, CeldPoint b)
{
  return hypot (a.x - b.x, a.y - b.y);
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
      double              mean = width > 0 ? width : (double) stroke->n / fmax (1, distance_to (tip, tail));
      bool                whole = !(width > 0);
      CeldArrowEnd        from = celd_arrow_end (&s->paint, stroke, k, tail, tip, mean, whole && s->style == CELD_ARROW_DOT);
      CeldArrowEnd        to = celd_arrow_end (&s->paint, stroke, k, tip, tail, mean, whole && s->style == CELD_ARROW_HEAD);

      status = celd_append (s->end, s->n, s->capacity, from);
      if (status == CELD_OK)
        status = celd_append (s->end, s->n, s->capacity, to);
    }
  return status;
}

/* Reads each part of a colour, as far as it is clear. */
static CeldStatus
read_parts (ColouredArrows *s, CeldArrowStroke *stroke, CeldRelations *relations, CeldProblems *problems)
{
  CeldStatus status = CELD_OK;

  for (size_t k = 0; k < s->paint.colours->strokes.n && status == CELD_OK; k++)
    {
      CeldCrossingStrokes strokes = { 0 };
      CeldStrokeCover     cover = { s->paint.component, &s->paint.colours->seen[s->paint.colours->strokes.first[k]] };
      size_t              before = relations->n;
      double              width = 0;
      bool                clear = false, readable;

      celd_stroke_select (&s->paint.colours->strokes, k, stroke);
      if (stroke->n < CELD_LEAST_PART)
        continue;
      readable = s->graded || !s->paint.colours->remnant[k];
      status   = readable ? celd_arrow_strokes_read (stroke, s->paint.layer, s->style, relations, &strokes, &clear)
                          : celd_crossing_strokes_find (stroke, &strokes);
      if (status == CELD_OK && readable && !clear)
        status = celd_joined_arrows_read (stroke, &cover, s->paint.layer, s->style, relations, problems, &width);
      if (status == CELD_OK)
        status = clear || width > 0 ? add_ends (s, stroke, k, relations, before, width)
                                    : celd_arrow_strokes_report (stroke, &strokes, problems);
      celd_crossing_strokes_clear (&strokes);
    }
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

      if (i / 2 == relation || distance_to (own[0].place, p) < AWAY * own->width || distance_to (own[1].place, p) < AWAY * own->width)
        continue;
      for (size_t k = first[0]; k < first[1]; k++)
        if (distance_to (celd_stroke_point (component, colours->strokes.pixel[k]), p) <= own->width)
          return true;
    }
  return false;
}

/* Is an arrow clear in all?  One with both ends in sight needs not be looked at any more. */
static bool
is_clear (const ColouredArrows *s, const CeldArrowStroke *component, size_t relation)
{
  const CeldArrowEnd *end = &s->end[2 * relation];

  return end[0].known && end[1].known && distance_to (end[0].place, end[1].place) >= LEAST_ARROW * end->width &&
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
  status = read_parts (&s, &stroke, relations, problems);
  if (status == CELD_OK)
    {
      celd_arrow_ends_find (&mask, s.graded, s.end, s.n);
      status = settle (&s, component, relations, problems);
    }
  celd_free (s.end);
  celd_stroke_mask_clear (&mask);
  return status;
}
