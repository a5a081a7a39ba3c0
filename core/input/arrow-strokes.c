/* The arrow of connected paint of one colour, or those of the strokes that cross in it.
 *
 * The form of a stroke decides which end is nearer; its colour also says whether registration may tear there (blue).
 * Strokes that cross are each followed straight on (crossing-strokes.c).
 *
 * Cost: a few passes over the pixels of each stroke.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/arrows.h"

#include <math.h>

/* All chosen. */
#define LEAST_HUE    195  /* degrees: the range of blue */
#define LARGEST_HUE  265
#define LEAST_CHROMA 0.25 /* of blue: its largest channel less its smallest, as a fraction of the largest */

/* ------------------------------------------------------------------ one stroke */

/* Is there an arrowhead nearer to the tail than to the tip? */
static bool
head_disagrees (CeldArrowStroke *stroke, const CeldArrowEnds *ends)
{
  CeldArrowEnds found;

  return !celd_arrowhead (stroke, false, &found) && hypot (found.tip.x - ends->tail.x, found.tip.y - ends->tail.y) <
                                                   hypot (found.tip.x - ends->tip.x, found.tip.y - ends->tip.y);
}

/* CELD_REASON_NONE, or why the stroke is no clear arrow. */
static CeldArrowReason
read_marks (CeldArrowStroke *stroke, const CeldArrowLayer *layer, CeldArrowStyle style, CeldArrowEnds *ends)
{
  CeldArrowEnds   found;
  CeldArrowReason reason;

  if (style == CELD_ARROW_FADE || style == CELD_ARROW_TAPER)
    {
      reason = celd_arrow_profile (stroke, layer, style, ends);
      return !reason && head_disagrees (stroke, ends) ? CELD_REASON_HEAD : reason;
    }
  reason = celd_arrowhead (stroke, style == CELD_ARROW_DOT, &found);
  if (!reason)
    *ends = style == CELD_ARROW_DOT ? (CeldArrowEnds) { found.tip, found.tail } : found;
  return reason;
}

/* The same; resets the distances of the stroke's pixels, because crossing strokes share some. */
static CeldArrowReason
read_stroke (CeldArrowStroke *stroke, const CeldArrowLayer *layer, CeldArrowStyle style, CeldArrowEnds *ends)
{
  CeldArrowReason reason = read_marks (stroke, layer, style, ends);

  for (size_t i = 0; i < stroke->n; i++)
    stroke->distance[stroke->pixel[i]] = INFINITY;
  return reason;
}

bool
celd_arrow_is_blue (const CeldArrowStroke *stroke, const CeldArrowLayer *layer)
{
  double red = 0, green = 0, blue = 0, most, least, hue;

  for (size_t i = 0; i < stroke->n; i++)
    {
      int            x = celd_stroke_x (stroke, stroke->pixel[i]), y = celd_stroke_y (stroke, stroke->pixel[i]);
      const uint8_t *c = CELD_RGBA (layer->paint, x, y);
      int            a = celd_arrow_opacity (layer, x, y);

      red   += c[0] * a;
      green += c[1] * a;
      blue  += c[2] * a;
    }
  most  = fmax (blue, fmax (red, green));
  least = fmin (blue, fmin (red, green));
  if (blue < most || most - least < LEAST_CHROMA * most)
    return false;
  hue = 240 + 60 * (red - green) / (most - least);
  return hue >= LEAST_HUE && hue <= LARGEST_HUE;
}

static CeldStatus
add_arrow (const CeldArrowEnds *ends, bool crack, CeldRelations *relations)
{
  return celd_relation_add (relations, (CeldRelation) {
    .nearer = { .x = ends->tail.x, .y = ends->tail.y }, .farther = { .x = ends->tip.x, .y = ends->tip.y },
    .crack = crack, .weight = 1, .gap = 1, .source = CELD_SOURCE_ARROW,
  });
}

/* Appends the relation of a stroke; *clear becomes false if it is no clear arrow. */
static CeldStatus
read_one (CeldArrowStroke *stroke, const CeldArrowLayer *layer, CeldArrowStyle style, CeldRelations *relations,
          bool *clear)
{
  CeldArrowEnds ends = { { 0, 0 }, { 0, 0 } };

  if (!read_stroke (stroke, layer, style, &ends))
    return add_arrow (&ends, celd_arrow_is_blue (stroke, layer), relations);
  *clear = false;
  return CELD_OK;
}

/* ------------------------------------------------------------------ strokes that cross */

void
celd_stroke_select (const CeldCrossingStrokes *strokes, size_t k, CeldArrowStroke *stroke)
{
  stroke->pixel = strokes->pixel + strokes->first[k];
  stroke->n     = strokes->first[k + 1] - strokes->first[k];
}

/* Has a stroke two colours, one at each end?  Then it is two strokes that meet. */
static bool
has_two_colours (CeldArrowStroke *stroke, const CeldArrowLayer *layer)
{
  uint32_t start = celd_stroke_follow (stroke, stroke->pixel, 1);

  celd_stroke_follow (stroke, &start, 1);
  return celd_stroke_changes_colour (stroke, layer);
}

/* Appends the relations of all strokes.  If one of them is no clear arrow of one colour, none is appended and *clear
 * becomes false, because what looks like a crossing may be part of another figure. */
static CeldStatus
read_crossing (CeldArrowStroke *stroke, const CeldCrossingStrokes *strokes, const CeldArrowLayer *layer,
               CeldArrowStyle style, CeldRelations *relations, bool *clear)
{
  size_t     before = relations->n;
  CeldStatus status = CELD_OK;

  for (size_t k = 0; k < strokes->n && status == CELD_OK && *clear; k++)
    {
      bool one_colour;

      celd_stroke_select (strokes, k, stroke);
      one_colour = !has_two_colours (stroke, layer);
      status     = read_one (stroke, layer, style, relations, clear);
      *clear &= one_colour;
    }
  if (!*clear)
    relations->n = before;
  return status;
}

CeldStatus
celd_arrow_strokes_read (CeldArrowStroke *stroke, const CeldArrowLayer *layer, CeldArrowStyle style,
                         CeldRelations *relations, CeldCrossingStrokes *strokes, bool *clear)
{
  CeldArrowStroke whole = *stroke;
  CeldStatus      status = celd_crossing_strokes_find (stroke, strokes);

  *clear = strokes->n;
  if (status == CELD_OK && strokes->n)
    status = read_crossing (stroke, strokes, layer, style, relations, clear);
  if (status == CELD_OK && !*clear)
    {
      *stroke = whole;
      *clear  = true;
      status  = read_one (stroke, layer, style, relations, clear);
    }
  *stroke = whole;
  return status;
}

/* Has a stroke a head that the style does not ask for? */
static bool
has_other_head (CeldArrowStroke *stroke, const CeldArrowLayer *layer, CeldArrowStyle style)
{
  CeldArrowEnds ends;

  return (style == CELD_ARROW_FADE || style == CELD_ARROW_TAPER) &&
         !read_stroke (stroke, layer, CELD_ARROW_HEAD, &ends);
}

/* Why a stroke is left out that was not read: its own reason; or `reason` if it is clear alone, or just has none of the
 * marks of an arrow. */
static CeldArrowReason
why_unclear (CeldArrowStroke *stroke, const CeldArrowLayer *layer, CeldArrowStyle style, CeldArrowReason reason)
{
  CeldArrowEnds   ends;
  CeldArrowReason own = read_stroke (stroke, layer, style, &ends);

  if (own && has_other_head (stroke, layer, style))
    return CELD_REASON_HEAD;
  return !own || (own == CELD_REASON_ALIKE && reason) ? reason : own;
}

/* The same for one of several strokes that cross, of which others may be unclear. */
static CeldArrowReason
why_crossing_unclear (CeldArrowStroke *stroke, const CeldArrowLayer *layer, CeldArrowStyle style,
                      CeldArrowReason reason)
{
  bool            two = has_two_colours (stroke, layer);
  CeldArrowReason why = why_unclear (stroke, layer, style, reason);

  return two ? CELD_REASON_UNEVEN : why ? why : CELD_REASON_MEETING;
}

/* The first stroke from k on that is large enough to be reported; strokes->n = none. */
static size_t
next_told (const CeldCrossingStrokes *strokes, size_t k)
{
  while (k < strokes->n && strokes->first[k + 1] - strokes->first[k] < CELD_LEAST_STROKE)
    k++;
  return k;
}

/* Makes `stroke` the first one that is reported, k, with what belongs to none of those reported. */
static void
add_rest (const CeldArrowStroke *paint, const CeldCrossingStrokes *strokes, size_t k, CeldArrowStroke *stroke,
          uint32_t *pixel)
{
  float *mark = paint->distance;

  for (size_t j = next_told (strokes, k + 1); j < strokes->n; j = next_told (strokes, j + 1))
    for (size_t i = strokes->first[j]; i < strokes->first[j + 1]; i++)
      mark[strokes->pixel[i]] = 0;
  for (size_t i = strokes->first[k]; i < strokes->first[k + 1]; i++)
    mark[strokes->pixel[i]] = INFINITY;
  stroke->pixel = pixel;
  stroke->n     = 0;
  for (size_t i = 0; i < paint->n; i++)
    if (mark[paint->pixel[i]] > 0)
      pixel[stroke->n++] = paint->pixel[i];
  for (size_t i = 0; i < paint->n; i++)
    mark[paint->pixel[i]] = INFINITY;
}

CeldStatus
celd_arrow_strokes_report (const CeldArrowStroke *paint, const CeldCrossingStrokes *strokes,
                           const CeldStrokeCover *cover, const CeldArrowLayer *layer, CeldArrowStyle style,
                           CeldArrowReason reason, CeldProblems *problems)
{
  CeldArrowStroke stroke = *paint;
  size_t          first = next_told (strokes, 0);
  uint32_t       *pixel = celd_alloc (paint->n, sizeof *pixel);
  CeldStatus      status = pixel ? CELD_OK : CELD_NO_MEMORY;

  if (status == CELD_OK && first == strokes->n)
    status = celd_arrow_problem_add (problems, why_unclear (&stroke, layer, style, reason), celd_stroke_middle (paint),
                                     paint, cover);
  for (size_t k = first; k < strokes->n && status == CELD_OK; k = next_told (strokes, k + 1))
    {
      CeldArrowReason why;
      CeldPoint       middle;

      celd_stroke_select (strokes, k, &stroke);
      why    = why_crossing_unclear (&stroke, layer, style, reason);
      middle = celd_stroke_middle (&stroke);
      if (k == first)
        add_rest (paint, strokes, k, &stroke, pixel);
      status = celd_arrow_problem_add (problems, why, middle, &stroke, cover);
    }
  celd_free (pixel);
  return status;
}
