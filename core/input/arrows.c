/* Painted arrows: which end of a stroke is nearer.
 *
 * Each connected stroke of the layer (alpha at least one half; in a layer without alpha, what differs from the
 * commonest colour) is one arrow; where strokes cross, each is followed straight on (crossing-strokes.c).  Strokes of
 * different colours may touch as they like: each colour is read alone (arrow-colours.c), if its ends are not hidden
 * (hidden-ends.c).  The form of a stroke decides; its colour also says whether registration may tear there (blue).
 *
 *   head   an arrowhead, open or filled, is the farther end (arrowhead.c)
 *   dot    a blob is the nearer end (arrowhead.c)
 *   fade   opacity falls from the nearer end on (arrow-profile.c).  Such a stroke is read down to an alpha of
 *          FADED_OPACITY, since its faint end is the farther end
 *   taper  the thick end is nearer (arrow-profile.c)
 *
 * Strokes that are unclear, or whose arrowhead contradicts their fade or taper, are reported and never guessed.
 *
 * Cost: a few sweeps over the pixels of each stroke.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/input.h"

#include <math.h>

/* All chosen; opacities are 0 .. 255. */
#define LEAST_OPACITY 128  /* of paint */
#define THIN_OPACITY  48   /* of a taper's paint: its thin end covers pixels only in part */
#define FADED_OPACITY 16   /* of a fading stroke's paint */
#define LEAST_STROKE  6    /* pixels; a smaller component is a speck and ignored */
#define MOST_REMNANT  150  /* pixels of a piece of a thin or faint end, ... */
#define BREAK         7    /* ... and how far it may be from the rest */
#define LEAST_HUE     195  /* degrees: the range of blue */
#define LARGEST_HUE   265
#define LEAST_CHROMA  0.25 /* of blue: its largest channel less its smallest, as a fraction of the largest */

/* ------------------------------------------------------------------ one stroke */

/* Is there an arrowhead nearer to the tail than to the tip? */
static bool
head_disagrees (CeldArrowStroke *stroke, const CeldArrowEnds *ends)
{
  CeldArrowEnds found;

  return celd_arrowhead (stroke, false, &found) && hypot (found.tip.x - ends->tail.x, found.tip.y - ends->tail.y) <
                                                  hypot (found.tip.x - ends->tip.x, found.tip.y - ends->tip.y);
}

static bool
read_stroke (CeldArrowStroke *stroke, const CeldArrowLayer *layer, CeldArrowStyle style, CeldArrowEnds *ends)
{
  CeldArrowEnds found;

  if (style == CELD_ARROW_FADE || style == CELD_ARROW_TAPER)
    return celd_arrow_profile (stroke, layer, style, ends) && !head_disagrees (stroke, ends);
  if (!celd_arrowhead (stroke, style == CELD_ARROW_DOT, &found))
    return false;
  *ends = style == CELD_ARROW_DOT ? (CeldArrowEnds) { found.tip, found.tail } : found;
  return true;
}

/* Is the mean colour blue?  Such an arrow marks a crack. */
static bool
is_blue (const CeldArrowStroke *stroke, const CeldArrowLayer *layer)
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

/* A problem at some pixel of a stroke. */
static CeldProblem
unclear_arrow (const CeldArrowStroke *stroke)
{
  uint32_t middle = stroke->pixel[stroke->n / 2];

  return (CeldProblem) {
    .kind = CELD_PROBLEM_ARROW_UNCLEAR, .relation = CELD_NO_INDEX,
    .x = celd_stroke_x (stroke, middle), .y = celd_stroke_y (stroke, middle),
  };
}

/* Appends the relation of a stroke; *clear becomes false if it is no clear arrow.  Resets the distances of its pixels,
 * because crossing strokes share some. */
static CeldStatus
read_one (CeldArrowStroke *stroke, const CeldArrowLayer *layer, CeldArrowStyle style, CeldRelations *relations,
          bool *clear)
{
  CeldArrowEnds ends = { { 0, 0 }, { 0, 0 } };
  CeldStatus    status = CELD_OK;

  if (read_stroke (stroke, layer, style, &ends))
    status = add_arrow (&ends, is_blue (stroke, layer), relations);
  else
    *clear = false;
  for (size_t i = 0; i < stroke->n; i++)
    stroke->distance[stroke->pixel[i]] = INFINITY;
  return status;
}

/* ------------------------------------------------------------------ strokes that cross */

/* Makes `stroke` the one with index k. */
static void
select_stroke (const CeldCrossingStrokes *strokes, size_t k, CeldArrowStroke *stroke)
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

      select_stroke (strokes, k, stroke);
      one_colour = !has_two_colours (stroke, layer);
      status     = read_one (stroke, layer, style, relations, clear);
      *clear &= one_colour;
    }
  if (!*clear)
    relations->n = before;
  return status;
}

/* Appends the arrow of connected paint, or those of the strokes that cross in it; *clear becomes false if neither is
 * clear. */
static CeldStatus
read_strokes (CeldArrowStroke *stroke, const CeldArrowLayer *layer, CeldArrowStyle style, CeldRelations *relations,
              bool *clear)
{
  CeldArrowStroke     whole = *stroke;
  CeldCrossingStrokes strokes = { 0 };
  CeldStatus          status = celd_crossing_strokes_find (stroke, &strokes);

  *clear = strokes.n;
  if (status == CELD_OK && strokes.n)
    status = read_crossing (stroke, &strokes, layer, style, relations, clear);
  if (status == CELD_OK && !*clear)
    {
      *stroke = whole;
      *clear  = true;
      status  = read_one (stroke, layer, style, relations, clear);
    }
  celd_crossing_strokes_clear (&strokes);
  *stroke = whole;
  return status;
}

/* Appends a problem for each stroke of connected paint. */
static CeldStatus
report_strokes (const CeldArrowStroke *paint, CeldProblems *problems)
{
  CeldArrowStroke     stroke = *paint;
  CeldCrossingStrokes strokes = { 0 };
  CeldStatus          status = celd_crossing_strokes_find (paint, &strokes);

  if (status == CELD_OK && !strokes.n)
    status = celd_problem_add (problems, unclear_arrow (paint));
  for (size_t k = 0; k < strokes.n && status == CELD_OK; k++)
    {
      select_stroke (&strokes, k, &stroke);
      if (stroke.n >= LEAST_STROKE)
        status = celd_problem_add (problems, unclear_arrow (&stroke));
    }
  celd_crossing_strokes_clear (&strokes);
  return status;
}

/* ------------------------------------------------------------------ strokes of several colours */

typedef struct { CeldArrowEnd *item; size_t n, capacity; } Ends; /* two for each relation */

/* Appends the ends of the relations from `first` on, which are those of a stroke. */
static CeldStatus
add_ends (const CeldStrokeMask *component, const CeldArrowStroke *stroke, const bool *seen,
          const CeldRelations *relations, size_t first, Ends *ends)
{
  CeldStatus status = CELD_OK;

  for (size_t i = first; i < relations->n && status == CELD_OK; i++)
    {
      const CeldRelation *r = &relations->item[i];
      CeldPoint           tail = { r->nearer.x, r->nearer.y }, tip = { r->farther.x, r->farther.y };
      CeldArrowEnd        from = celd_arrow_end (component, stroke, seen, tail, tip);
      CeldArrowEnd        to = celd_arrow_end (component, stroke, seen, tip, tail);

      status = celd_append (ends->item, ends->n, ends->capacity, from);
      if (status == CELD_OK)
        status = celd_append (ends->item, ends->n, ends->capacity, to);
    }
  return status;
}

/* Removes the relations from `first` on that have an end below others at an unknown place, and reports them. */
static CeldStatus
remove_hidden (const Ends *ends, CeldRelations *relations, size_t first, CeldProblems *problems)
{
  size_t     kept = first;
  CeldStatus status = CELD_OK;

  for (size_t i = first; i < relations->n && status == CELD_OK; i++)
    {
      size_t       k = 2 * (i - first);
      CeldRelation r = relations->item[i];

      if (celd_arrow_end_known (ends->item, ends->n, k) && celd_arrow_end_known (ends->item, ends->n, k + 1))
        relations->item[kept++] = r;
      else
        status = celd_problem_add (problems, (CeldProblem) {
          .kind = CELD_PROBLEM_ARROW_UNCLEAR, .relation = CELD_NO_INDEX,
          .x = (int) r.nearer.x, .y = (int) r.nearer.y,
        });
    }
  relations->n = kept;
  return status;
}

/* Appends the arrows of each colour of a component, or problems. */
static CeldStatus
read_colours (const CeldColourStrokes *colours, CeldArrowStroke *stroke, const CeldArrowLayer *layer,
              CeldArrowStyle style, CeldRelations *relations, CeldProblems *problems)
{
  CeldStrokeMask component;
  Ends           ends = { 0 };
  size_t         first = relations->n;
  CeldStatus     status = celd_stroke_mask_new (stroke, &component);

  if (status != CELD_OK)
    return status;
  for (size_t k = 0; k < colours->strokes.n && status == CELD_OK; k++)
    {
      size_t before = relations->n;
      bool   clear = false;

      select_stroke (&colours->strokes, k, stroke);
      if (!colours->doubtful[k])
        status = read_strokes (stroke, layer, style, relations, &clear);
      if (status == CELD_OK)
        status = clear ? add_ends (&component, stroke, &colours->seen[colours->strokes.first[k]], relations, before,
                                   &ends)
                       : report_strokes (stroke, problems);
    }
  if (status == CELD_OK)
    status = remove_hidden (&ends, relations, first, problems);
  celd_free (ends.item);
  celd_stroke_mask_clear (&component);
  return status;
}

/* Appends the arrows of a component, or problems: of what is no clear arrow as a whole, each colour is read alone. */
static CeldStatus
read_component (CeldArrowStroke *stroke, const CeldArrowLayer *layer, CeldArrowStyle style, CeldRelations *relations,
                CeldProblems *problems)
{
  CeldColourStrokes colours = { 0 };
  bool              clear = false;
  CeldStatus        status;

  if (stroke->n < LEAST_STROKE)
    return CELD_OK;
  status = read_strokes (stroke, layer, style, relations, &clear);
  if (status == CELD_OK && !clear)
    status = celd_arrow_colours_split (stroke, layer, &colours);
  if (status == CELD_OK && !clear)
    status = colours.strokes.n ? read_colours (&colours, stroke, layer, style, relations, problems)
                               : report_strokes (stroke, problems);
  celd_colour_strokes_clear (&colours);
  return status;
}

/* ------------------------------------------------------------------ all components */

typedef struct
{
  CeldLabels      label;      /* each pixel's component, from 1 */
  CeldComponent  *component;
  size_t          n;
  uint32_t       *pixel;      /* component by component, in reading order, numbered as in CeldArrowStroke */
  CeldArrowStroke stroke;
} Components;

static void
components_clear (Components *s)
{
  celd_free (s->label.data);
  celd_free (s->component);
  celd_free (s->pixel);
  celd_free (s->stroke.distance);
  celd_free (s->stroke.sums);
  celd_free (s->stroke.earlier);
}

static CeldStatus
find_components (const CeldArrowLayer *layer, CeldArrowStyle style, const CeldHost *host, Components *s)
{
  const CeldPaint *paint = layer->paint;
  int              least = layer->opaque ? CELD_PAPER_CONTRAST : style == CELD_ARROW_FADE ? FADED_OPACITY
                                          : style == CELD_ARROW_TAPER ? THIN_OPACITY : LEAST_OPACITY;
  CeldLabels       mask;
  CeldStatus       status = celd_labels_new (paint->width, paint->height, &mask);

  if (status != CELD_OK)
    return status;
  for (int y = 0; y < paint->height; y++)
    for (int x = 0; x < paint->width; x++)
      CELD_AT (&mask, x, y) = celd_arrow_opacity (layer, x, y) >= least;
  status = celd_labels_new (paint->width, paint->height, &s->label);
  if (status == CELD_OK)
    status = celd_components (&mask, 0, true, host, &s->label, &s->component, &s->n);
  celd_free (mask.data);
  return status;
}

/* Sorts the pixels by component, and makes room for following the largest one. */
static CeldStatus
gather_pixels (Components *s)
{
  size_t  all = 0, most = 0, width = (size_t) s->label.width, plane = (width + 2) * ((size_t) s->label.height + 2);
  size_t *next = celd_alloc (s->n + 1, sizeof *next);

  for (size_t k = 0; next && k < s->n; k++)
    {
      next[k] = all;
      all += s->component[k].area;
      if (most < s->component[k].area)
        most = s->component[k].area;
    }
  s->pixel = celd_alloc (all, sizeof *s->pixel);
  s->stroke = (CeldArrowStroke) {
    .width = s->label.width, .height = s->label.height,
    .distance = celd_alloc (plane, sizeof (float)), .sums = celd_alloc (most + most / 2 + 4, sizeof (CeldStrokeSums)),
    .earlier = celd_alloc (most, sizeof (float)),
  };
  if (!next || !s->pixel || !s->stroke.distance || !s->stroke.sums || !s->stroke.earlier)
    {
      celd_free (next);
      return CELD_NO_MEMORY;
    }
  for (size_t i = 0; i < plane; i++)
    s->stroke.distance[i] = INFINITY;
  for (int y = 0; y < s->label.height; y++)
    for (int x = 0; x < s->label.width; x++)
      {
        uint32_t k = CELD_AT (&s->label, x, y);

        if (k)
          s->pixel[next[k - 1]++] = (uint32_t) ((size_t) (y + 1) * (width + 2) + (size_t) x + 1);
      }
  celd_free (next);
  return CELD_OK;
}

/* Is the selected component small, with another one close to it?  Then it may be a piece of that one: thin and faint
 * ends of strokes fall to pieces. */
static bool
is_remnant (const Components *s)
{
  const CeldArrowStroke *stroke = &s->stroke;
  uint32_t               own;

  if (stroke->n < LEAST_STROKE || stroke->n > MOST_REMNANT)
    return false;
  own = CELD_AT (&s->label, celd_stroke_x (stroke, stroke->pixel[0]), celd_stroke_y (stroke, stroke->pixel[0]));
  for (size_t i = 0; i < stroke->n; i++)
    {
      int x = celd_stroke_x (stroke, stroke->pixel[i]), y = celd_stroke_y (stroke, stroke->pixel[i]);

      for (int v = y > BREAK ? y - BREAK : 0; v <= y + BREAK && v < s->label.height; v++)
        for (int u = x > BREAK ? x - BREAK : 0; u <= x + BREAK && u < s->label.width; u++)
          if (CELD_AT (&s->label, u, v) && CELD_AT (&s->label, u, v) != own)
            return true;
    }
  return false;
}

static CeldStatus
read_components (Components *s, const CeldArrowLayer *layer, CeldArrowStyle style, const CeldHost *host,
                 CeldRelations *relations, CeldProblems *problems)
{
  CeldStatus status = CELD_OK;
  size_t     done   = 0, all = 0;

  for (size_t k = 0; k < s->n; k++)
    all += s->component[k].area;
  for (size_t k = 0; k < s->n && status == CELD_OK; k++)
    {
      s->stroke.pixel = s->pixel + done;
      s->stroke.n     = s->component[k].area;
      done += s->stroke.n;
      if ((style == CELD_ARROW_FADE || style == CELD_ARROW_TAPER) && is_remnant (s))
        status = celd_problem_add (problems, unclear_arrow (&s->stroke));
      else
        status = read_component (&s->stroke, layer, style, relations, problems);
      if (status == CELD_OK)
        status = celd_progress (host, (double) done / (double) all);
    }
  return status;
}

CeldStatus
celd_arrows_read (const CeldPaint *arrows, CeldArrowStyle style, const CeldHost *host,
                  CeldRelations *relations, CeldProblems *problems)
{
  Components     components = { 0 };
  CeldArrowLayer layer;
  CeldHostPart   first, rest;
  CeldHost       finding = celd_host_part (&first, host, 0, 0.5), reading = celd_host_part (&rest, host, 0.5, 1);
  size_t         n_relations = relations->n, n_problems = problems ? problems->n : 0;
  CeldStatus     status;

  if (!CELD_SAME_SIZE (arrows, arrows))
    return CELD_BAD_SIZE;
  status = celd_arrow_layer_new (arrows, &layer);
  if (status == CELD_OK)
    status = find_components (&layer, style, &finding, &components);
  if (status == CELD_OK)
    status = gather_pixels (&components);
  if (status == CELD_OK)
    status = read_components (&components, &layer, style, &reading, relations, problems);
  components_clear (&components);
  if (status != CELD_OK)
    {
      relations->n = n_relations;
      if (problems)
        problems->n = n_problems;
    }
  return status;
}
