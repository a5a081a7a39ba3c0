/* Painted arrows: which end of a stroke is nearer.
 *
 * Each connected stroke of the layer (alpha at least half of the largest; in a layer without alpha, what differs from the
 * commonest colour) is one arrow; where strokes cross, each is followed straight on (arrow-strokes.c).  Strokes of
 * different colours may touch as they like: each colour is read alone (coloured-arrows.c), if the places of its ends
 * are known.  The form of a stroke decides; its colour also says whether registration may tear there (blue).
 *
 *   head   an arrowhead, open or filled, is the farther end (arrowhead.c)
 *   dot    a blob is the nearer end (arrowhead.c)
 *   fade   opacity falls from the nearer end on (arrow-profile.c).  Such a stroke is read down to an alpha of
 *          FADED_OPACITY, since its faint end is the farther end
 *   taper  the thick end is nearer (arrow-profile.c)
 *
 * Strokes that are unclear, or whose arrowhead contradicts their fade or taper, are reported and never guessed.
 *
 * Cost: a few passes over the pixels of each stroke.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/input.h"

#include <math.h>

/* All chosen; opacities are 0 .. 255. */
#define LEAST_OPACITY 128  /* of paint */
#define THIN_OPACITY  48   /* of a taper's paint: its thin end covers pixels only in part */
#define FADED_OPACITY 16   /* of a fading stroke's paint */
#define MOST_REMNANT  150  /* pixels of a piece of a thin or faint end, ... */
#define BREAK         7    /* ... and how far it may be from the rest */
#define FEW_ARROWS    2    /* at least, in a layer of arrows; a single stroke tells too little */
#define NOT_ARROWS    4    /* of their strokes at most 1 / this are none (measured: of scribbles all are none) */

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
  celd_free (s->stroke.rings);
}

/* Of paint. */
static int
least_opacity (const CeldArrowLayer *layer, CeldArrowStyle style)
{
  return layer->opaque ? CELD_PAPER_CONTRAST : style == CELD_ARROW_FADE ? FADED_OPACITY
         : style == CELD_ARROW_TAPER ? THIN_OPACITY : LEAST_OPACITY;
}

static CeldStatus
find_components (const CeldArrowLayer *layer, CeldArrowStyle style, const CeldHost *host, Components *s)
{
  const CeldPaint *paint = layer->paint;
  int              least = least_opacity (layer, style);
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
    .earlier = celd_alloc (most, sizeof (float)), .rings = celd_alloc (3 * most, sizeof (uint32_t)),
  };
  if (!next || !s->pixel || !s->stroke.distance || !s->stroke.sums || !s->stroke.earlier || !s->stroke.rings)
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

  if (stroke->n < CELD_LEAST_STROKE || stroke->n > MOST_REMNANT)
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

/* Appends the arrows of a component, or problems: of what is no clear arrow as a whole, each colour is read alone. */
static CeldStatus
read_component (CeldArrowStroke *stroke, const CeldArrowLayer *layer, CeldArrowStyle style, CeldRelations *relations,
                CeldProblems *problems)
{
  CeldCrossingStrokes strokes = { 0 };
  CeldColourStrokes   colours = { 0 };
  bool                clear = false;
  CeldStatus          status;

  if (stroke->n < CELD_LEAST_STROKE)
    return CELD_OK;
  status = celd_arrow_strokes_read (stroke, layer, style, relations, &strokes, &clear);
  if (status == CELD_OK && !clear)
    status = celd_arrow_colours_split (stroke, layer, &colours);
  if (status == CELD_OK && !clear && colours.strokes.n)
    status = celd_coloured_arrows_read (&colours, stroke, layer, style, relations, problems);
  else if (status == CELD_OK && !clear)
    {
      CeldJoinedFound found = { 0 };

      status = celd_joined_arrows_read (stroke, NULL, layer, style, relations, problems, NULL, &found);
      if (status == CELD_OK && !(found.width > 0))
        status = celd_arrow_strokes_report (stroke, &strokes, NULL, layer, style, celd_joined_reason (&found, &strokes),
                                            problems);
    }
  celd_crossing_strokes_clear (&strokes);
  celd_colour_strokes_clear (&colours);
  return status;
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
        status = celd_arrow_problem_add (problems, CELD_REASON_PIECE, celd_stroke_middle (&s->stroke), &s->stroke,
                                         NULL);
      else
        status = read_component (&s->stroke, layer, style, relations, problems);
      if (status == CELD_OK)
        status = celd_progress (host, (double) done / (double) all);
    }
  return status;
}

/* Of the components that are strokes counts those that are arrows with heads, until it is plain that too few are.  Those
 * that cross are counted as none, since looking for crossings takes far longer. */
static CeldStatus
count_arrows (Components *s, const CeldHost *host, size_t *arrows, size_t *strokes)
{
  CeldStatus status = CELD_OK;
  size_t     done = 0, other = 0;

  *arrows = *strokes = 0;
  for (size_t k = 0; k < s->n; k++)
    *strokes += s->component[k].area >= CELD_LEAST_STROKE;
  for (size_t k = 0; k < s->n && status == CELD_OK && NOT_ARROWS * other <= *strokes; k++)
    {
      CeldArrowEnds ends;
      bool          headed;

      s->stroke.pixel = s->pixel + done;
      s->stroke.n     = s->component[k].area;
      done += s->stroke.n;
      if (s->stroke.n < CELD_LEAST_STROKE)
        continue;
      headed = celd_arrowhead (&s->stroke, false, &ends) == CELD_REASON_NONE;
      *arrows += headed;
      other += !headed;
      status = celd_progress (host, (double) (k + 1) / (double) s->n);
    }
  return status;
}

CeldStatus
celd_are_arrows (const CeldPaint *paint, const CeldHost *host, bool *are)
{
  Components     components = { 0 };
  CeldArrowLayer layer;
  size_t         arrows = 0, strokes = 0;
  CeldStatus     status = CELD_SAME_SIZE (paint, paint) ? celd_arrow_layer_new (paint, &layer) : CELD_BAD_SIZE;

  if (status == CELD_OK)
    status = find_components (&layer, CELD_ARROW_HEAD, host, &components);
  if (status == CELD_OK)
    status = gather_pixels (&components);
  if (status == CELD_OK)
    status = count_arrows (&components, host, &arrows, &strokes);
  components_clear (&components);
  if (status == CELD_OK)
    *are = arrows >= FEW_ARROWS && NOT_ARROWS * (strokes - arrows) <= strokes;
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
  size_t         n_runs = problems ? problems->n_runs : 0;
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
  if (status == CELD_OK && !layer.opaque && problems)
    status = celd_faint_strokes_find (arrows, (least_opacity (&layer, style) * layer.strongest + 254) / 255,
                                      problems);
  components_clear (&components);
  if (status != CELD_OK)
    {
      relations->n = n_relations;
      if (problems)
        {
          problems->n      = n_problems;
          problems->n_runs = n_runs;
        }
    }
  return status;
}
