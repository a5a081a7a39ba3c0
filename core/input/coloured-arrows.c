/* Arrows of several colours that share ends or lie on each other: those of each colour are read alone.
 *
 * An arrow is left out if an end of it is hidden below others and its place unknown (hidden-ends.c).  Opacity and width
 * show how far an arrow goes, so that one that fades or tapers may lead below others.  Two arrows of one colour with
 * heads or dots may look like one where these are hidden, so that such arrows must end in sight or beside another end,
 * and no other paint of their colour may be near.
 *
 * Cost: some passes over the paint of each arrow.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/input.h"

#include <math.h>

#define LEAST_LENGTH 3 /* mean widths of an arrow, with its head or dot: what is shorter may be a piece of one; chosen */

typedef struct
{
  CeldColouredPaint paint;
  bool              graded; /* the arrows fade or taper */
  CeldArrowEnd     *end;    /* two for each relation from `first` on */
  size_t            n, capacity, first;
} ColouredArrows;

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
      double              mean = width > 0 ? width : (double) stroke->n / fmax (1, hypot (tip.x - tail.x, tip.y - tail.y));
      CeldArrowEnd        from = celd_arrow_end (&s->paint, stroke, k, tail, tip, mean);
      CeldArrowEnd        to = celd_arrow_end (&s->paint, stroke, k, tip, tail, mean);

      status = celd_append (s->end, s->n, s->capacity, from);
      if (status == CELD_OK)
        status = celd_append (s->end, s->n, s->capacity, to);
    }
  return status;
}

/* Reads each part of a colour, as far as it is clear. */
static CeldStatus
read_parts (ColouredArrows *s, CeldArrowStroke *stroke, CeldArrowStyle style, CeldRelations *relations,
            CeldProblems *problems)
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
      status   = readable ? celd_arrow_strokes_read (stroke, s->paint.layer, style, relations, &strokes, &clear)
                          : celd_crossing_strokes_find (stroke, &strokes);
      if (status == CELD_OK && readable && !clear)
        status = celd_joined_arrows_read (stroke, &cover, s->paint.layer, style, relations, problems, &width);
      if (status == CELD_OK)
        status = clear || width > 0 ? add_ends (s, stroke, k, relations, before, width)
                                    : celd_arrow_strokes_report (stroke, &strokes, problems);
      celd_crossing_strokes_clear (&strokes);
    }
  return status;
}

/* Gives relations the places of their ends, and removes and reports those that have none, or are too short. */
static CeldStatus
settle (const ColouredArrows *s, CeldRelations *relations, CeldProblems *problems)
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
      if (s->end[2 * i].known && s->end[2 * i + 1].known &&
          hypot (to.x - from.x, to.y - from.y) >= LEAST_LENGTH * s->end[2 * i].width)
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
    .paint = { &mask, layer, colours }, .graded = style == CELD_ARROW_FADE || style == CELD_ARROW_TAPER,
    .first = relations->n,
  };
  CeldArrowStroke stroke = *component;
  CeldStatus      status = celd_stroke_mask_new (component, &mask);

  if (status != CELD_OK)
    return status;
  status = read_parts (&s, &stroke, style, relations, problems);
  if (status == CELD_OK)
    {
      celd_arrow_ends_find (&mask, s.graded, s.end, s.n);
      status = settle (&s, relations, problems);
    }
  celd_free (s.end);
  celd_stroke_mask_clear (&mask);
  return status;
}
