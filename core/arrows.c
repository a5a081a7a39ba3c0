/* Painted arrows: which end of a stroke is nearer.
 *
 * Each connected stroke of the layer (alpha at least one half; in a layer without alpha, what differs from the
 * commonest colour) is one arrow; where strokes cross, they are followed straight on (strands.c).  Its form decides,
 * its colour only says whether registration may tear there (blue).
 *
 *   head   an arrowhead, open or filled, is the farther end (arrowhead.c)
 *   dot    a blob is the nearer end (arrowhead.c)
 *   fade   opacity falls from the nearer end on (arrow-slope.c).  Such a stroke is read down to an alpha of
 *          FADED_OPACITY: its faint end is the farther end
 *   taper  the same with its width: the thick end is nearer
 *
 * Strokes that do not say clearly, or whose arrowhead says the opposite, are reported, never guessed.  Costs a few
 * sweeps over the pixels of each stroke.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "arrows.h"

#include <math.h>
#include <stdlib.h>

#define LEAST_STROKE  6    /* pixels; fewer are a speck */
#define LEAST_OPACITY 128  /* of paint */
#define THIN_OPACITY  48   /* the thin end of a taper covers its pixels in part; */
#define FADED_OPACITY 16   /* a fading stroke reaches on to this */
#define CONTRAST      32   /* least difference from the paper's colour, in a layer without alpha */

int
celd_arrow_opacity (const CeldArrowLayer *layer, int x, int y)
{
  const uint8_t *c = CELD_RGBA (layer->paint, x, y);
  int            contrast = 0;

  if (!layer->opaque)
    return c[3];
  for (int i = 0; i < 3; i++)
    if (abs (c[i] - layer->paper[i]) > contrast)
      contrast = abs (c[i] - layer->paper[i]);
  return contrast;
}

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

/* The commonest colour of a layer without alpha, found by a vote on 5 bits a channel; else the layer has alpha. */
static CeldStatus
look_at_layer (const CeldPaint *paint, CeldArrowLayer *layer)
{
  uint32_t *votes = celd_alloc0 (1 << 15, sizeof *votes), best = 0;

  if (!votes)
    return CELD_NO_MEMORY;
  *layer = (CeldArrowLayer) { .paint = paint, .opaque = true };
  for (int y = 0; y < paint->height && layer->opaque; y++)
    for (int x = 0; x < paint->width; x++)
      {
        const uint8_t *c   = CELD_RGBA (paint, x, y);
        uint32_t       key = (uint32_t) ((c[0] >> 3) << 10 | (c[1] >> 3) << 5 | c[2] >> 3);

        layer->opaque &= c[3] == 255;
        if (++votes[key] > best)
          {
            best = votes[key];
            for (int i = 0; i < 3; i++)
              layer->paper[i] = c[i];
          }
      }
  celd_free (votes);
  return CELD_OK;
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
  CeldRelation *item = celd_grow (relations->item, relations->n + 1, sizeof *item);

  if (!item)
    return CELD_NO_MEMORY;
  relations->item      = item;
  item[relations->n++] = (CeldRelation) {
    .nearer = { .x = ends->tail.x, .y = ends->tail.y }, .farther = { .x = ends->tip.x, .y = ends->tip.y },
    .crack = crack, .weight = 1, .gap = 1, .source = CELD_SOURCE_ARROW,
  };
  return CELD_OK;
}

/* What one pass over the strokes needs.  `strokes` are components: strokes that cross are one. */
typedef struct
{
  CeldLabels      strokes;   /* each pixel's stroke, from 1 */
  CeldComponent  *component; /* of each stroke */
  size_t          n;
  uint32_t       *pixel;     /* stroke by stroke, in reading order, numbered as in a trail */
  CeldTrail       trail;
} Strokes;

static void
strokes_end (Strokes *s)
{
  celd_free (s->strokes.data);
  celd_free (s->component);
  celd_free (s->pixel);
  celd_free (s->trail.distance);
  celd_free (s->trail.front);
  celd_free (s->trail.kept);
}

static CeldStatus
find_strokes (const CeldArrowLayer *layer, CeldArrowStyle style, const CeldRun *run, Strokes *s)
{
  const CeldPaint *paint = layer->paint;
  int              least = layer->opaque ? CONTRAST : style == CELD_ARROW_FADE ? FADED_OPACITY
                                          : style == CELD_ARROW_TAPER ? THIN_OPACITY : LEAST_OPACITY;
  CeldLabels       mask;
  CeldStatus       status = celd_labels_new (paint->width, paint->height, &mask);

  if (status != CELD_OK)
    return status;
  for (int y = 0; y < paint->height; y++)
    for (int x = 0; x < paint->width; x++)
      CELD_AT (&mask, x, y) = celd_arrow_opacity (layer, x, y) >= least;
  status = celd_labels_new (paint->width, paint->height, &s->strokes);
  if (status == CELD_OK)
    status = celd_components (&mask, 0, true, run, &s->strokes, &s->component, &s->n);
  celd_free (mask.data);
  return status;
}

/* Sorts the pixels by stroke and makes room for trails. */
static CeldStatus
gather_pixels (Strokes *s)
{
  size_t  all = 0, most = 0, width = (size_t) s->strokes.width, plane = (width + 2) * ((size_t) s->strokes.height + 2);
  size_t *next = celd_alloc (s->n + 1, sizeof *next);

  for (size_t k = 0; next && k < s->n; k++)
    {
      next[k] = all;
      all += s->component[k].area;
      if (most < s->component[k].area)
        most = s->component[k].area;
    }
  s->pixel = celd_alloc (all, sizeof *s->pixel);
  s->trail = (CeldTrail) {
    .width = s->strokes.width, .height = s->strokes.height,
    .distance = celd_alloc (plane, sizeof (float)), .front = celd_alloc (most + most / 2 + 4, sizeof (CeldFront)),
    .kept = celd_alloc (most, sizeof (float)),
  };
  if (!next || !s->pixel || !s->trail.distance || !s->trail.front || !s->trail.kept)
    {
      celd_free (next);
      return CELD_NO_MEMORY;
    }
  for (size_t i = 0; i < plane; i++)
    s->trail.distance[i] = INFINITY;
  for (int y = 0; y < s->strokes.height; y++)
    for (int x = 0; x < s->strokes.width; x++)
      {
        uint32_t k = CELD_AT (&s->strokes, x, y);

        if (k)
          s->pixel[next[k - 1]++] = (uint32_t) ((size_t) (y + 1) * (width + 2) + (size_t) x + 1);
      }
  celd_free (next);
  return CELD_OK;
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

/* A component: one stroke, or several that cross. */
static CeldStatus
read_component (CeldTrail *trail, const CeldArrowLayer *layer, CeldArrowStyle style, CeldRelations *relations,
                CeldProblems *problems)
{
  CeldTrail   whole = *trail;
  CeldStrands strands = { 0 };
  bool        clear = true;
  CeldStatus  status;

  if (trail->n < LEAST_STROKE)
    return CELD_OK;
  status = celd_strands_find (trail, &strands);
  if (status == CELD_OK && strands.n)
    status = read_strands (trail, &strands, layer, style, relations, &clear);
  if (status == CELD_OK && (!strands.n || !clear))
    {
      *trail = whole;
      clear  = true;
      status = read_one (trail, layer, style, relations, &clear);
    }
  if (status == CELD_OK && !clear && !strands.n)
    status = celd_problem_add (problems, unclear_arrow (trail));
  for (size_t k = 0; k < strands.n && status == CELD_OK && !clear; k++)
    {
      take_strand (&strands, k, trail);
      if (trail->n >= LEAST_STROKE)
        status = celd_problem_add (problems, unclear_arrow (trail));
    }
  celd_strands_clear (&strands);
  return status;
}

static CeldStatus
read_components (Strokes *s, const CeldArrowLayer *layer, CeldArrowStyle style, const CeldRun *run,
                 CeldRelations *relations, CeldProblems *problems)
{
  CeldStatus status = CELD_OK;
  size_t     done   = 0, all = 0;

  for (size_t k = 0; k < s->n; k++)
    all += s->component[k].area;
  for (size_t k = 0; k < s->n && status == CELD_OK; k++)
    {
      s->trail.pixel = s->pixel + done;
      s->trail.n     = s->component[k].area;
      done += s->trail.n;
      status = read_component (&s->trail, layer, style, relations, problems);
      if (status == CELD_OK)
        status = celd_step (run, (double) done / (double) all);
    }
  return status;
}

CeldStatus
celd_arrows_read (const CeldPaint *arrows, CeldArrowStyle style, const CeldRun *run,
                  CeldRelations *relations, CeldProblems *problems)
{
  Strokes    strokes = { 0 };
  CeldArrowLayer layer;
  CeldPart   first, rest;
  CeldRun    finding = celd_run_part (&first, run, 0, 0.5), reading = celd_run_part (&rest, run, 0.5, 1);
  size_t     n_relations = relations->n, n_problems = problems ? problems->n : 0;
  CeldStatus status;

  if (!CELD_SAME_SIZE (arrows, arrows))
    return CELD_BAD_SIZE;
  status = look_at_layer (arrows, &layer);
  if (status == CELD_OK)
    status = find_strokes (&layer, style, &finding, &strokes);
  if (status == CELD_OK)
    status = gather_pixels (&strokes);
  if (status == CELD_OK)
    status = read_components (&strokes, &layer, style, &reading, relations, problems);
  strokes_end (&strokes);
  if (status != CELD_OK)
    {
      relations->n = n_relations;
      if (problems)
        problems->n = n_problems;
    }
  return status;
}
