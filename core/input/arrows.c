/* Painted arrows: which end of a stroke is nearer.
 *
 * Each connected stroke of the layer (alpha at least one half; in a layer without alpha, what differs from the
 * commonest colour) is one arrow; where strokes cross, they are told apart by colour (strand-colours.c), or followed
 * straight on (strands.c).  Its form decides, its colour only says whether registration may tear there (blue).
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
#include "image/image.h"
#include "input/arrows.h"
#include "input/trail.h"

#include <math.h>
#include <stdlib.h>

#define LEAST_OPACITY 128  /* of paint */
#define THIN_OPACITY  48   /* the thin end of a taper covers its pixels in part; */
#define FADED_OPACITY 16   /* a fading stroke reaches on to this */

const uint8_t *
celd_arrow_pixel (const CeldArrowLayer *layer, int x, int y)
{
  int u = x - layer->left, v = y - layer->top;

  if (layer->other.data && u >= 0 && v >= 0 && u < layer->other.width && v < layer->other.height)
    return CELD_RGBA (&layer->other, u, v);
  return CELD_RGBA (layer->paint, x, y);
}

int
celd_arrow_opacity (const CeldArrowLayer *layer, int x, int y)
{
  const uint8_t *c = celd_arrow_pixel (layer, x, y);
  int            contrast = 0;

  if (!layer->opaque)
    return c[3];
  for (int i = 0; i < 3; i++)
    if (abs (c[i] - layer->paper[i]) > contrast)
      contrast = abs (c[i] - layer->paper[i]);
  return contrast;
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
find_strokes (const CeldArrowLayer *layer, CeldArrowStyle style, const CeldHost *host, Strokes *s)
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
  status = celd_labels_new (paint->width, paint->height, &s->strokes);
  if (status == CELD_OK)
    status = celd_components (&mask, 0, true, host, &s->strokes, &s->component, &s->n);
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

static CeldStatus
read_components (Strokes *s, CeldArrowLayer *layer, CeldArrowStyle style, const CeldHost *host,
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
      status = celd_arrow_strokes_read (&s->trail, layer, style, relations, problems);
      if (status == CELD_OK)
        status = celd_progress (host, (double) done / (double) all);
    }
  return status;
}

CeldStatus
celd_arrows_read (const CeldPaint *arrows, CeldArrowStyle style, const CeldHost *host,
                  CeldRelations *relations, CeldProblems *problems)
{
  Strokes    strokes = { 0 };
  CeldArrowLayer layer;
  CeldHostPart   first, rest;
  CeldHost   finding = celd_host_part (&first, host, 0, 0.5), reading = celd_host_part (&rest, host, 0.5, 1);
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
