/* The rows of views: spans of layers are painted, and projected.
 *
 * A span becomes a polyline through its pixels' new places, so that stretching leaves no holes; where it folds over
 * itself, the nearest part wins.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "stereo/scanline.h"

size_t
celd_scanline_bytes (const CeldScene *scene)
{
  size_t align = sizeof (CeldSceneSpan *), pixel = 6 * sizeof (float) + sizeof (CeldSceneSpan *) + sizeof (int);
  size_t painted = scene->layers ? scene->most_spans * sizeof (CeldSceneSpan) + scene->most_pixels * 5 * sizeof (float)
                                 : 0;

  return ((size_t) scene->width * pixel + painted + align - 1) / align * align;
}

CeldScanline
celd_scanline_in (char *scratch, const CeldScene *scene)
{
  size_t       w = (size_t) scene->width, spans = scene->layers ? scene->most_spans : 0;
  CeldScanline line = { .width = scene->width, .first = scene->width };

  line.span    = (const CeldSceneSpan **) (void *) scratch;
  line.painted = (CeldSceneSpan *) (void *) (line.span + w);
  line.nearest = (float *) (void *) (line.painted + spans);
  line.t       = line.nearest + w;
  line.colour  = line.t + w;
  line.pixels  = line.colour + 4 * w;
  line.at      = (int *) (void *) (line.pixels + (scene->layers ? 5 * scene->most_pixels : 0));
  memset (line.span, 0, w * sizeof *line.span);
  return line;
}

/* ------------------------------------------------------------------ spans of a group */

/* Paints n spans of a layer in one row. */
static void
paint_spans (const CeldScene *scene, const CeldSceneSpan *span, size_t n, CeldScanline *line)
{
  float *colour = line->pixels, *depths = line->pixels + 4 * scene->most_pixels;

  for (size_t k = 0; k < n; k++)
    {
      CeldSceneSpan *painted = &line->painted[k];

      *painted = span[k];
      painted->colour = colour + 4 * CELD_SPAN_END;
      painted->depths = depths + CELD_SPAN_END;
      celd_scene_paint_layer (scene, painted, painted->colour, painted->depths);
      celd_scene_span_pad (painted, scene->width);
      colour += 4 * (painted->n + 2 * CELD_SPAN_END);
      depths += painted->n + 2 * CELD_SPAN_END;
    }
}

size_t
celd_scanline_take_group (const CeldScene *scene, size_t first, CeldScanline *line, const CeldSceneSpan **spans)
{
  const CeldSceneSpan *span = &scene->span[first];
  size_t               n = 1, most = scene->row[span->y + 1] - first;

  while (n < most && span[n].group == span->group)
    n++;
  if (scene->layers)
    paint_spans (scene, span, n, line);
  *spans = scene->layers ? line->painted : span;
  return n;
}

/* ------------------------------------------------------------------ projection of a span */

/* The first pixel whose centre is at or beyond a place, within 0 .. width. */
static inline int
pixel_from (double place, int width)
{
  double inside = place - 0.5 > 0 ? place - 0.5 < width ? place - 0.5 : width : 0;
  int    pixel = (int) inside;

  return pixel + (pixel < inside);
}

/* The projected centre of pixel i of a span. */
static inline double
place_of (const CeldProjection *m, const CeldSceneSpan *s, int i)
{
  return m->middle + m->squeeze * (s->x + i + 0.5 - m->middle) - m->shift * ((double) s->depths[i] - m->screen);
}

static inline void
put_sample (CeldScanline *line, const CeldSceneSpan *s, int i, int k, float t, float depths)
{
  if (line->span[k] && depths < line->nearest[k])
    return;
  line->span[k]    = s;
  line->nearest[k] = depths;
  line->at[k]      = i;
  line->t[k]       = t;
}

/* Beyond the frame a span continues with its last pixel. */
static void
put_beyond (CeldScanline *line, const CeldSceneSpan *s, int i, int first, int end)
{
  for (int k = first; k < end; k++)
    put_sample (line, s, i, k, 0, s->depths[i]);
}

/* Samples the pixels from k to before `end`, which lie between the projections of the pixels i and i + 1. */
static inline void
put_between (CeldScanline *line, const CeldSceneSpan *s, int i, int k, int end, double place, double next)
{
  float scale = 1 / (float) (next - place), rise = s->depths[i + 1] - s->depths[i];

  for (; k < end; k++)
    {
      float t = (float) (k + 0.5 - place) * scale;

      put_sample (line, s, i, k, t, s->depths[i] + t * rise);
    }
}

CELD_CLONES static void
project_span (const CeldProjection *m, const CeldSceneSpan *s, CeldScanline *line)
{
  bool   at_left = s->x == 0, at_right = s->x + s->n == line->width;
  int    i = at_left ? 0 : -1, last = at_right ? s->n - 1 : s->n;
  double place = place_of (m, s, i);
  int    k = pixel_from (place, line->width);

  if (at_left)
    put_beyond (line, s, 0, 0, k);
  line->first = at_left ? 0 : line->first < k ? line->first : k;
  for (; i < last; i++)
    {
      double next = place_of (m, s, i + 1);
      int    end = pixel_from (next, line->width);

      line->first = k < line->first ? k : line->first;
      line->end   = end > line->end ? end : line->end;
      if (k < end)
        put_between (line, s, i, k, end, place, next);
      place = next;
      k     = end;
    }
  if (at_right)
    {
      put_beyond (line, s, s->n - 1, k, line->width);
      line->first = k < line->first ? k : line->first;
      line->end   = line->width;
    }
}

void
celd_scanline_project (const CeldProjection *move, const CeldSceneSpan *span, CeldScanline *line)
{
  project_span (move, span, line);
}
