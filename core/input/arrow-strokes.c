/* A connected component of an arrows layer: the arrow that it is, or those whose strokes cross in it.
 *
 * Strokes of different colours are told apart by them (strand-colours.c), others by following them straight on
 * (strands.c).  A stroke of which another one may hide a part is not clear.  Where some stroke is not, the colours may
 * have been those of one stroke: if the component as a whole is an arrow it is that, unless a part of it is another one
 * by its form.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/arrow-colours.h"
#include "input/arrows.h"
#include "input/trail.h"

#include <math.h>

#define LEAST_STROKE 6   /* pixels; fewer are a speck */
#define ROUND_END    1.2 /* of a stroke's width: what touches it nearer to its end than this may hide it, */
#define NEAR_END     2   /* and pixels */
#define SAME_END     0.1 /* of an arrow's length, and NEAR_END: ends of the same arrow are no farther apart */

/* Is there an arrowhead, and at the nearer end? */
static bool
head_disagrees (CeldTrail *trail, const CeldEnds *ends)
{
  CeldEnds found;

  return celd_arrowhead (trail, false, &found) && hypot (found.tip.x - ends->tail.x, found.tip.y - ends->tail.y) <
                                                  hypot (found.tip.x - ends->tip.x, found.tip.y - ends->tip.y);
}

static bool
read_stroke (CeldTrail *trail, const CeldArrowLayer *layer, CeldArrowStyle style, CeldEnds *ends)
{
  CeldEnds found;

  if (style == CELD_ARROW_FADE || style == CELD_ARROW_TAPER)
    return celd_arrow_slope (trail, layer, style, ends) && !head_disagrees (trail, ends);
  if (!celd_arrowhead (trail, style == CELD_ARROW_DOT, &found))
    return false;
  *ends = style == CELD_ARROW_DOT ? (CeldEnds) { found.tip, found.tail } : found;
  return true;
}

/* Strokes whose mean colour is blue are cracks: hue 195 to 265 degrees, not greyish. */
static bool
is_blue (const CeldTrail *trail, const CeldArrowLayer *layer)
{
  double red = 0, green = 0, blue = 0, most, least, hue;

  for (size_t i = 0; i < trail->n; i++)
    {
      int            x = celd_trail_x (trail, trail->pixel[i]), y = celd_trail_y (trail, trail->pixel[i]);
      const uint8_t *c = CELD_RGBA (layer->paint, x, y);
      int            a = celd_arrow_opacity (layer, x, y);

      red   += c[0] * a;
      green += c[1] * a;
      blue  += c[2] * a;
    }
  most  = fmax (blue, fmax (red, green));
  least = fmin (blue, fmin (red, green));
  if (blue < most || most - least < 0.25 * most)
    return false;
  hue = 240 + 60 * (red - green) / (most - least);
  return hue >= 195 && hue <= 265;
}

static CeldStatus
add_arrow (const CeldEnds *ends, bool crack, CeldRelations *relations)
{
  return celd_relation_add (relations, (CeldRelation) {
    .nearer = { .x = ends->tail.x, .y = ends->tail.y }, .farther = { .x = ends->tip.x, .y = ends->tip.y },
    .crack = crack, .weight = 1, .gap = 1, .source = CELD_SOURCE_ARROW,
  });
}

/* The pixel in the middle of a stroke. */
static CeldProblem
unclear_arrow (const CeldTrail *trail)
{
  uint32_t middle = trail->pixel[trail->n / 2];

  return (CeldProblem) {
    .kind = CELD_PROBLEM_ARROW_UNCLEAR, .relation = CELD_NO_INDEX,
    .x = celd_trail_x (trail, middle), .y = celd_trail_y (trail, middle),
  };
}

/* Appends the arrow that a stroke is; *clear becomes false if it is none.  What it leaves in the plane of distances is
 * wiped off: strands share pixels. */
static CeldStatus
read_one (CeldTrail *trail, const CeldArrowLayer *layer, CeldArrowStyle style, CeldRelations *relations, bool *clear)
{
  CeldEnds   ends = { { 0, 0 }, { 0, 0 } };
  CeldStatus status = CELD_OK;

  if (read_stroke (trail, layer, style, &ends))
    status = add_arrow (&ends, is_blue (trail, layer), relations);
  else
    *clear = false;
  for (size_t i = 0; i < trail->n; i++)
    trail->distance[trail->pixel[i]] = INFINITY;
  return status;
}

/* The strand k, as a stroke of its own. */
static void
take_strand (const CeldStrands *strands, size_t k, CeldTrail *trail)
{
  trail->pixel = strands->pixel + strands->first[k];
  trail->n     = strands->first[k + 1] - strands->first[k];
}

/* Strokes that cross: all of them are arrows, or none counts.  What looks like a crossing may be part of a figure that
 * is none, and then some strand of it is no arrow. */
static CeldStatus
read_strands (CeldTrail *trail, const CeldStrands *strands, const CeldArrowLayer *layer, CeldArrowStyle style,
              CeldRelations *relations, bool *clear)
{
  size_t     before = relations->n;
  CeldStatus status = CELD_OK;

  for (size_t k = 0; k < strands->n && status == CELD_OK && *clear; k++)
    {
      take_strand (strands, k, trail);
      status = read_one (trail, layer, style, relations, clear);
    }
  if (!*clear)
    relations->n = before;
  return status;
}

/* One stroke, or several of any colour that cross.  If it is not clear nothing but problems is appended. */
static CeldStatus
read_by_form (CeldTrail *trail, const CeldArrowLayer *layer, CeldArrowStyle style, CeldRelations *relations,
              CeldProblems *problems, bool *clear)
{
  CeldTrail   whole = *trail;
  CeldStrands strands = { 0 };
  CeldStatus  status;

  *clear = true;
  if (trail->n < LEAST_STROKE)
    return CELD_OK;
  status = celd_strands_find (trail, &strands);
  if (status == CELD_OK && strands.n)
    status = read_strands (trail, &strands, layer, style, relations, clear);
  if (status == CELD_OK && (!strands.n || !*clear))
    {
      *trail = whole;
      *clear = true;
      status = read_one (trail, layer, style, relations, clear);
    }
  if (status == CELD_OK && !*clear && !strands.n)
    status = celd_problem_add (problems, unclear_arrow (trail));
  for (size_t k = 0; k < strands.n && status == CELD_OK && !*clear; k++)
    {
      take_strand (&strands, k, trail);
      if (trail->n >= LEAST_STROKE)
        status = celd_problem_add (problems, unclear_arrow (trail));
    }
  celd_strands_clear (&strands);
  return status;
}

/* Does anything touch the stroke k at an end of the arrow? */
static bool
end_is_touched (const CeldColourStrands *found, size_t k, const CeldRelation *arrow)
{
  double length = hypot (arrow->farther.x - arrow->nearer.x, arrow->farther.y - arrow->nearer.y);
  double width  = (double) (found->strands.first[k + 1] - found->strands.first[k]) / fmax (1, length);

  for (size_t i = found->first_touch[k]; i < found->first_touch[k + 1]; i++)
    {
      CeldPoint p = found->touch[i];

      if (fmin (hypot (p.x - arrow->nearer.x, p.y - arrow->nearer.y),
                hypot (p.x - arrow->farther.x, p.y - arrow->farther.y)) <= ROUND_END * width + NEAR_END)
        return true;
    }
  return false;
}

/* The stroke k of those told apart by colour, as if it were alone in the layer.  What it would be but for what touches
 * it is appended to `doubtful`. */
static CeldStatus
read_coloured (CeldTrail *trail, CeldArrowLayer *layer, CeldArrowStyle style, const CeldColourStrands *found, size_t k,
               CeldRelations *relations, CeldRelations *doubtful, CeldProblems *problems, bool *clear)
{
  size_t     before = relations->n, n_problems = problems ? problems->n : 0;
  CeldStatus status;

  take_strand (&found->strands, k, trail);
  for (size_t i = 0; i < trail->n; i++)
    memcpy (CELD_RGBA (&layer->other, celd_trail_x (trail, trail->pixel[i]) - layer->left,
                       celd_trail_y (trail, trail->pixel[i]) - layer->top),
            found->rgba + 4 * (found->strands.first[k] + i), 4);
  status = read_by_form (trail, layer, style, relations, problems, clear);
  *clear &= !found->is_cut[k];
  for (size_t i = before; i < relations->n && status == CELD_OK && *clear; i++)
    *clear = !end_is_touched (found, k, &relations->item[i]);
  if (status != CELD_OK || *clear)
    return status;
  for (size_t i = before; i < relations->n && status == CELD_OK; i++)
    status = celd_relation_add (doubtful, relations->item[i]);
  relations->n = before;
  take_strand (&found->strands, k, trail);
  if (status == CELD_OK && problems && problems->n == n_problems)
    status = celd_problem_add (problems, unclear_arrow (trail));
  return status;
}

/* A picture of the size of the component, to lay strokes of it into. */
static CeldStatus
lay_above (const CeldTrail *trail, CeldArrowLayer *layer)
{
  int right = 0, bottom = 0;

  layer->left = trail->width;
  layer->top  = trail->height;
  for (size_t i = 0; i < trail->n; i++)
    {
      int x = celd_trail_x (trail, trail->pixel[i]), y = celd_trail_y (trail, trail->pixel[i]);

      layer->left = x < layer->left ? x : layer->left;
      layer->top  = y < layer->top ? y : layer->top;
      right  = x > right ? x : right;
      bottom = y > bottom ? y : bottom;
    }
  layer->other.width  = right - layer->left + 1;
  layer->other.height = bottom - layer->top + 1;
  layer->other.stride = (size_t) layer->other.width;
  layer->other.data   = celd_alloc0 (layer->other.stride * (size_t) layer->other.height, 4);
  return layer->other.data ? CELD_OK : CELD_NO_MEMORY;
}

/* All strokes that are told apart by colour. */
static CeldStatus
read_colours (CeldTrail *trail, CeldArrowLayer *layer, CeldArrowStyle style, const CeldColourStrands *found,
              CeldRelations *relations, CeldRelations *doubtful, CeldProblems *problems, bool *clear)
{
  CeldTrail  whole = *trail;
  CeldStatus status = lay_above (trail, layer);

  *clear = true;
  for (size_t k = 0; k < found->strands.n && status == CELD_OK; k++)
    {
      bool one = true;

      status = read_coloured (trail, layer, style, found, k, relations, doubtful, problems, &one);
      *clear &= one;
    }
  celd_free (layer->other.data);
  layer->other = (CeldPaint) { 0 };
  *trail = whole;
  return status;
}

/* Are some arrows among others? */
static bool
are_among (const CeldRelation *some, size_t n_some, const CeldRelation *others, size_t n_others)
{
  for (size_t i = 0; i < n_some; i++)
    {
      const CeldRelation *a = &some[i];
      double near  = SAME_END * hypot (a->farther.x - a->nearer.x, a->farther.y - a->nearer.y) + NEAR_END;
      bool   found = false;

      for (size_t k = 0; k < n_others; k++)
        found |= hypot (others[k].nearer.x - a->nearer.x, others[k].nearer.y - a->nearer.y) <= near &&
                 hypot (others[k].farther.x - a->farther.x, others[k].farther.y - a->farther.y) <= near;
      if (!found)
        return false;
    }
  return true;
}

/* Strokes that are told apart by colour, or all of it in one if that is more. */
static CeldStatus
read_apart (CeldTrail *trail, CeldArrowLayer *layer, CeldArrowStyle style, const CeldColourStrands *found,
            CeldRelations *relations, CeldProblems *problems)
{
  CeldRelations doubtful = { 0 };
  size_t        before = relations->n, n_problems = problems ? problems->n : 0, n, more;
  bool          clear = false, whole = false;
  CeldStatus    status = read_colours (trail, layer, style, found, relations, &doubtful, problems, &clear);

  n = relations->n;
  if (status == CELD_OK && !clear)
    status = read_by_form (trail, layer, style, relations, NULL, &whole);
  more = relations->n - n;
  whole &= are_among (relations->item + before, n - before, relations->item + n, more);
  if (style == CELD_ARROW_HEAD || style == CELD_ARROW_DOT) /* the other styles look at the colours of the whole */
    whole &= are_among (doubtful.item, doubtful.n, relations->item + n, more);
  if (status == CELD_OK && whole)
    {
      memmove (relations->item + before, relations->item + n, more * sizeof *relations->item);
      relations->n = before + more;
      if (problems)
        problems->n = n_problems;
    }
  else
    relations->n = n;
  celd_relations_clear (&doubtful);
  return status;
}

CeldStatus
celd_arrow_strokes_read (CeldTrail *trail, CeldArrowLayer *layer, CeldArrowStyle style, CeldRelations *relations,
                         CeldProblems *problems)
{
  CeldColourStrands found = { 0 };
  bool              clear;
  CeldStatus        status = trail->n < LEAST_STROKE ? CELD_OK : celd_strand_colours_find (trail, layer, &found);

  if (status == CELD_OK && found.strands.n)
    status = read_apart (trail, layer, style, &found, relations, problems);
  else if (status == CELD_OK)
    status = read_by_form (trail, layer, style, relations, problems, &clear);
  celd_strand_colours_clear (&found);
  return status;
}
