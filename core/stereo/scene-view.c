/* Views of a scene from other places (section 5, Figure 1g).
 *
 * A pixel of depth d at x is projected to  c + q (x - c) - s (d - d_0),  where c is the middle of the picture, q its
 * horizontal compression, d_0 the depth on the screen and 2 s the disparity of both eyes in pixels for each unit of
 * depth.  A span becomes a polyline through its pixels' new places, so that stretching leaves no holes; where it folds
 * over itself, the nearest part wins.  Groups of spans are composited in their order.
 *
 * A camera that moves vertically as well is handled in two passes: rows first, then columns of the result, for each
 * group separately with its depth.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "stereo/scene.h"

#define VIEW_BAND_ROWS 32 /* rows of one task */

/* new x = middle + squeeze (x - middle) - shift (depth - screen) */
typedef struct { double squeeze, middle, shift, screen; } Projection;

typedef struct
{
  const CeldScene *scene;
  Projection       move;
  CeldColours     *view;       /* straight alpha */
  char            *scratch;    /* of each band */
} SceneView;

/* The nearest sample of a group at each pixel of a row: `t` of the way from pixel `at` of the span to the next. */
typedef struct
{
  float                *nearest, *t;
  const CeldSceneSpan **span;              /* NULL: no sample */
  int                  *at;
  float                *colour;            /* composite of the row so far, premultiplied */
  int                   width, first, end; /* pixels that the group may have reached */
  CeldSceneSpan        *painted;           /* spans of a group of layers, with their pixels */
  float                *pixels;
} Scanline;

/* Memory of a scanline, rounded up for alignment. */
static size_t
scanline_bytes (const CeldScene *scene)
{
  size_t align = sizeof (CeldSceneSpan *), pixel = 6 * sizeof (float) + sizeof (CeldSceneSpan *) + sizeof (int);
  size_t painted = scene->layers ? scene->most_spans * sizeof (CeldSceneSpan) + scene->most_pixels * 5 * sizeof (float)
                                 : 0;

  return ((size_t) scene->width * pixel + painted + align - 1) / align * align;
}

static Scanline
scanline_in (char *scratch, const CeldScene *scene)
{
  size_t   w = (size_t) scene->width, spans = scene->layers ? scene->most_spans : 0;
  Scanline line = { .width = scene->width, .first = scene->width };

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
paint_spans (const CeldScene *scene, const CeldSceneSpan *span, size_t n, Scanline *line)
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

/* The next spans of one group in a row, from number `first` of the scene on; returns how many they are. */
static size_t
take_group (const CeldScene *scene, size_t first, Scanline *line, const CeldSceneSpan **spans)
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
place_of (const Projection *m, const CeldSceneSpan *s, int i)
{
  return m->middle + m->squeeze * (s->x + i + 0.5 - m->middle) - m->shift * ((double) s->depths[i] - m->screen);
}

static inline void
put_sample (Scanline *line, const CeldSceneSpan *s, int i, int k, float t, float depths)
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
put_beyond (Scanline *line, const CeldSceneSpan *s, int i, int first, int end)
{
  for (int k = first; k < end; k++)
    put_sample (line, s, i, k, 0, s->depths[i]);
}

/* Samples the pixels from k to before `end`, which lie between the projections of the pixels i and i + 1. */
static inline void
put_between (Scanline *line, const CeldSceneSpan *s, int i, int k, int end, double place, double next)
{
  float scale = 1 / (float) (next - place), rise = s->depths[i + 1] - s->depths[i];

  for (; k < end; k++)
    {
      float t = (float) (k + 0.5 - place) * scale;

      put_sample (line, s, i, k, t, s->depths[i] + t * rise);
    }
}

CELD_CLONES static void
project_span (const Projection *m, const CeldSceneSpan *s, Scanline *line)
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

/* Interpolates between two pixels by a Catmull-Rom spline clamped to their range; linearly where their alphas
 * differ, so that premultiplied colours stay consistent. */
static inline void
blend (const float *a, float t, float colour[4])
{
  if (a[3] != a[7])
    {
      for (int c = 0; c < 4; c++)
        colour[c] = a[c] + t * (a[4 + c] - a[c]);
      return;
    }
  for (int c = 0; c < 4; c++)
    {
      float from = a[c], to = a[4 + c], rise = to - from, low = from < to ? from : to, high = from < to ? to : from;
      float slope = 0.5f * (to - a[c - 4]), end = 0.5f * (a[8 + c] - from);
      float value = from + t * (slope + t * (3 * rise - 2 * slope - end + t * (slope + end - 2 * rise)));

      value     = value < low ? low : value;
      colour[c] = value > high ? high : value;
    }
}

/* Composites a group over the row, and clears the samples for the next group. */
CELD_CLONES static void
composite_group (Scanline *line)
{
  for (int k = line->first; k < line->end; k++)
    {
      const CeldSceneSpan *s = line->span[k];
      const float         *from;
      float               *to = line->colour + 4 * k, colour[4];

      if (!s)
        continue;
      line->span[k] = NULL;
      from = s->colour + 4 * line->at[k];
      if (memcmp (from, from + 4, sizeof colour)) /* most neighbours in drawings are equal */
        {
          blend (from, line->t[k], colour);
          from = colour;
        }
      for (int c = 0; c < 4; c++)
        to[c] = from[c] + (1 - from[3]) * to[c];
    }
  line->first = line->width;
  line->end   = 0;
}

/* ------------------------------------------------------------------ rows */

static void
draw_row (const SceneView *v, int y, Scanline *line)
{
  const CeldScene *scene = v->scene;
  size_t           end = scene->row[y + 1];

  memset (line->colour, 0, 4 * (size_t) line->width * sizeof *line->colour);
  for (size_t i = scene->row[y], n; i < end; i += n)
    {
      const CeldSceneSpan *spans;

      n = take_group (scene, i, line, &spans);
      for (size_t k = 0; k < n; k++)
        {
          project_span (&v->move, &spans[k], line);
          if (scene->separate || k + 1 == n)
            composite_group (line);
        }
    }
}

/* Writes straight alpha.  In an opaque scene a few hundredths of a pixel may be left open between two antialiased ends
 * of spans; their colours share it. */
static void
unpremultiply (const float *from, int n, bool opaque, float *to)
{
  for (int x = 0; x < n; x++, from += 4, to += 4)
    {
      memcpy (to, from, 4 * sizeof *to);
      for (int c = 0; c < 3 && from[3] > 0 && from[3] < 1; c++)
        to[c] /= from[3];
      if (opaque && from[3] > 0)
        to[3] = 1;
    }
}

static void
draw_band (void *data, int band)
{
  const SceneView *v = data;
  int              width = v->scene->width, end = (band + 1) * VIEW_BAND_ROWS;
  Scanline         line = scanline_in (v->scratch + (size_t) band * scanline_bytes (v->scene), v->scene);

  for (int y = band * VIEW_BAND_ROWS; y < end && y < v->scene->height; y++)
    {
      draw_row (v, y, &line);
      unpremultiply (line.colour, width, v->scene->opaque, CELD_RGBA (v->view, 0, y));
    }
}

static CeldStatus
draw (const CeldScene *scene, Projection move, const CeldHost *host, CeldColours *view)
{
  int       bands = (scene->height + VIEW_BAND_ROWS - 1) / VIEW_BAND_ROWS;
  SceneView v = { scene, move, view, celd_alloc ((size_t) bands, scanline_bytes (scene)) };

  if (!v.scratch)
    return CELD_NO_MEMORY;
  celd_parallel_for (host, bands, draw_band, &v);
  celd_free (v.scratch);
  return CELD_OK;
}

/* ------------------------------------------------------------------ vertical movement */

/* A part of the scene after horizontal projection, with rows and columns exchanged: premultiplied colours, and
 * depth. */
typedef struct { const SceneView *view; const CeldSceneSpans *part; float *colour, *depths; } Transposition;

/* Writes the samples of one row to a column of the transposed picture. */
static void
transpose_row (const Transposition *t, int y, Scanline *line)
{
  size_t height = (size_t) t->view->scene->height;

  for (int k = line->first; k < line->end; k++)
    {
      const CeldSceneSpan *s = line->span[k];
      size_t               to = (size_t) k * height + (size_t) y;

      if (!s)
        continue;
      blend (s->colour + 4 * line->at[k], line->t[k], t->colour + 4 * to);
      t->depths[to]   = line->nearest[k];
      line->span[k] = NULL;
    }
  line->first = line->width;
  line->end   = 0;
}

/* Projects a group horizontally and makes a part of the transposed scene of it. */
static CeldStatus
transpose_group (Transposition *t, uint32_t group, Scanline *line, const CeldHost *host, CeldSceneSpans *to)
{
  const CeldScene *scene = t->view->scene;
  size_t           n = (size_t) scene->width * (size_t) scene->height;

  memset (t->colour, 0, 4 * n * sizeof *t->colour);
  for (size_t i = 0; i < n; i++)
    t->depths[i] = 0;
  for (int y = 0; y < scene->height; y++)
    {
      const CeldSceneSpan *spans;
      size_t               i = scene->row[y], count;

      while (i < scene->row[y + 1] && scene->span[i].group < group)
        i++;
      if (i == scene->row[y + 1] || scene->span[i].group > group)
        continue;
      count = take_group (scene, i, line, &spans);
      for (size_t k = 0; k < count; k++)
        project_span (&t->view->move, &spans[k], line);
      transpose_row (t, y, line);
    }
  return celd_scene_spans_of_picture ((CeldRect) { 0, 0, scene->height, scene->width }, scene->height, t->colour,
                                      t->depths, group, host, to);
}

static uint32_t
count_groups (const CeldScene *scene)
{
  uint32_t n = 0;

  for (size_t i = 0; i < scene->row[scene->height]; i++)
    n = scene->span[i].group >= n ? scene->span[i].group + 1 : n;
  return n;
}

static CeldStatus
transpose_scene (const CeldScene *scene, Projection move, const CeldHost *host, CeldScene **transposed)
{
  size_t        n = (size_t) scene->width * (size_t) scene->height;
  uint32_t      groups = count_groups (scene);
  char         *scratch = celd_alloc (1, scanline_bytes (scene));
  SceneView     v = { scene, move, NULL, scratch };
  Transposition t = { &v, NULL, celd_alloc (n, 4 * sizeof (float)), celd_alloc (n, sizeof (float)) };
  CeldStatus    status = celd_scene_new (scene->height, scene->width, groups, transposed);

  if (!scratch || !t.colour || !t.depths)
    status = CELD_NO_MEMORY;
  if (status == CELD_OK)
    {
      Scanline line = scanline_in (scratch, scene);

      (*transposed)->opaque = scene->opaque;

      for (uint32_t k = 0; k < groups && status == CELD_OK; k++)
        {
          status = transpose_group (&t, k, &line, host, &(*transposed)->part[k]);
          if (status == CELD_OK)
            status = celd_progress (host, 0.8 * (k + 1) / groups);
        }
    }
  if (status == CELD_OK)
    status = celd_scene_sort (*transposed);
  celd_free (scratch);
  celd_free (t.colour);
  celd_free (t.depths);
  return status;
}

/* Horizontally, and then vertically. */
static CeldStatus
draw_two_axes (const CeldScene *scene, Projection across, Projection along, const CeldHost *host, CeldColours *view)
{
  CeldColours tall = { scene->height, scene->width, (size_t) scene->height, NULL };
  CeldScene  *transposed = NULL;
  CeldStatus  status = transpose_scene (scene, across, host, &transposed);

  if (status == CELD_OK)
    tall.data = celd_alloc ((size_t) scene->width * (size_t) scene->height, 4 * sizeof *tall.data);
  if (status == CELD_OK)
    status = tall.data ? draw (transposed, along, host, &tall) : CELD_NO_MEMORY;
  for (int y = 0; y < view->height && status == CELD_OK; y++)
    for (int x = 0; x < view->width; x++)
      memcpy (CELD_RGBA (view, x, y), CELD_RGBA (&tall, y, x), 4 * sizeof *view->data);
  celd_scene_free (transposed);
  celd_free (tall.data);
  return status;
}

/* ------------------------------------------------------------------ */

CeldStatus
celd_scene_view (const CeldScene *scene, CeldCamera camera, const CeldSettings *settings, const CeldHost *host,
                 CeldColours *view)
{
  double     half, screen;
  Projection across, along;
  CeldStatus status;

  if (!view->data || view->width != scene->width || view->height != scene->height)
    return CELD_BAD_SIZE;
  if (celd_settings_check (settings) != CELD_OK || !(fabs (camera.x) <= 1) || !(fabs (camera.y) <= 1) ||
      !(camera.squeeze > 0 && camera.squeeze <= 1))
    return CELD_BAD_VALUE;
  half   = (double) settings->disparity * scene->width / 2;
  screen = scene->least + (double) settings->convergence * (scene->most - scene->least);
  across = (Projection) { camera.squeeze, scene->width / 2.0, camera.x * half, screen };
  along  = (Projection) { 1, scene->height / 2.0, camera.y * half, screen };
  status = camera.y != 0 ? draw_two_axes (scene, across, along, host, view) : draw (scene, across, host, view);
  return status != CELD_OK ? status : celd_progress (host, 1);
}
