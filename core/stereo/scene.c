/* A scene: spans of pixels with their depth, sorted by rows.
 *
 * Spans hold only pixels that are not transparent, so that the cost of views is proportional to their number.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "stereo/scene.h"

void
celd_depth_range (const CeldPlane *depth, double *least, double *most)
{
  float low = FLT_MAX, high = -FLT_MAX;

  for (int y = 0; y < depth->height; y++)
    for (int x = 0; x < depth->width; x++)
      {
        float value = CELD_AT (depth, x, y);

        if (!(fabsf (value) <= FLT_MAX))
          continue;
        low  = value < low ? value : low;
        high = value > high ? value : high;
      }
  *least = low <= high ? (double) celd_scene_depth (low) : 0;
  *most  = low <= high ? (double) celd_scene_depth (high) : 0;
}

/* ------------------------------------------------------------------ spans */

CeldStatus
celd_scene_spans_new (size_t n, size_t pixels, CeldSceneSpans *spans)
{
  size_t all = pixels + 2 * CELD_SPAN_END * n;

  *spans = (CeldSceneSpans) {
    .span   = celd_alloc (n, sizeof *spans->span),
    .colour = celd_alloc (all, 4 * sizeof *spans->colour),
    .depths = celd_alloc (all, sizeof *spans->depths),
  };
  return spans->span && spans->colour && spans->depths ? CELD_OK : CELD_NO_MEMORY;
}

CeldSceneSpan *
celd_scene_spans_add (CeldSceneSpans *spans, int x, int y, int n, uint32_t group)
{
  CeldSceneSpan *span = &spans->span[spans->n++];
  size_t         first = spans->pixels + CELD_SPAN_END;

  *span = (CeldSceneSpan) { .x = x, .y = y, .n = n, .group = group, .colour = spans->colour + 4 * first,
                            .depths = spans->depths + first };
  spans->pixels += (size_t) n + 2 * CELD_SPAN_END;
  return span;
}

void
celd_scene_span_pad (CeldSceneSpan *span, int width)
{
  for (int k = 1; k <= CELD_SPAN_END; k++)
    {
      float *before = span->colour - 4 * k, *behind = span->colour + 4 * (span->n + k - 1);

      memset (before, 0, 4 * sizeof *before);
      memset (behind, 0, 4 * sizeof *behind);
      if (span->x == 0)
        memcpy (before, span->colour, 4 * sizeof *before);
      if (span->x + span->n == width)
        memcpy (behind, span->colour + 4 * (span->n - 1), 4 * sizeof *behind);
      span->depths[-k]              = span->depths[0];
      span->depths[span->n + k - 1] = span->depths[span->n - 1];
    }
}

/* Finds the next run of pixels that are not transparent, from x on: returns its end, *first is its beginning, and
 * both are n if there is none. */
static int
next_run (const float *rgba, int n, int x, int *first)
{
  while (x < n && !(rgba[4 * x + 3] > 0))
    x++;
  *first = x;
  while (x < n && rgba[4 * x + 3] > 0)
    x++;
  return x;
}

CeldStatus
celd_scene_spans_of_picture (CeldRect box, int width, const float *rgba, const float *depths, uint32_t group,
                             const CeldHost *host, CeldSceneSpans *spans)
{
  size_t     w = (size_t) box.width, n = 0, pixels = 0;
  CeldStatus status;

  for (int y = 0, first; y < box.height; y++)
    for (int x = 0; (x = next_run (rgba + 4 * (size_t) y * w, box.width, x, &first)) > first;)
      {
        n++;
        pixels += (size_t) (x - first);
      }
  status = celd_scene_spans_new (n, pixels, spans);
  for (int y = 0, first; y < box.height && status == CELD_OK; y++)
    {
      const float *row = rgba + 4 * (size_t) y * w;

      for (int x = 0; (x = next_run (row, box.width, x, &first)) > first;)
        {
          CeldSceneSpan *span = celd_scene_spans_add (spans, box.x + first, box.y + y, x - first, group);

          memcpy (span->colour, row + 4 * first, 4 * (size_t) span->n * sizeof *row);
          memcpy (span->depths, depths + (size_t) y * w + first, (size_t) span->n * sizeof *depths);
          celd_scene_span_pad (span, width);
        }
      if (y % 256 == 255)
        status = celd_progress (host, 0);
    }
  return status;
}

/* ------------------------------------------------------------------ the object */

CeldStatus
celd_scene_new (int width, int height, size_t parts, CeldScene **made)
{
  CeldScene *scene = celd_alloc0 (1, sizeof *scene);

  *made = scene;
  if (!scene)
    return CELD_NO_MEMORY;
  scene->width   = width;
  scene->height  = height;
  scene->row     = celd_alloc0 ((size_t) height + 2, sizeof *scene->row);
  scene->part    = celd_alloc0 (parts, sizeof *scene->part);
  scene->n_parts = scene->part ? parts : 0;
  return scene->row && scene->part ? CELD_OK : CELD_NO_MEMORY;
}

void
celd_scene_free (CeldScene *scene)
{
  if (!scene)
    return;
  for (size_t k = 0; k < scene->n_parts; k++)
    {
      celd_free (scene->part[k].span);
      celd_free (scene->part[k].colour);
      celd_free (scene->part[k].depths);
    }
  for (size_t k = 0; scene->extended && k < scene->n_parts; k++)
    celd_free (scene->extended[k].value);
  celd_free (scene->extended);
  celd_layers_free (scene->own_layers);
  celd_free (scene->part);
  celd_free (scene->span);
  celd_free (scene->row);
  celd_free (scene);
}

/* Counting sort: row[y + 2] first has the number of spans of row y, then row[y + 1] is the index of the next one. */
static void
sort_rows (CeldScene *scene)
{
  for (size_t k = 0; k < scene->n_parts; k++)
    for (size_t i = 0; i < scene->part[k].n; i++)
      scene->row[scene->part[k].span[i].y + 2]++;
  for (int y = 0; y < scene->height; y++)
    scene->row[y + 2] += scene->row[y + 1];
  for (size_t k = 0; k < scene->n_parts; k++)
    for (size_t i = 0; i < scene->part[k].n; i++)
      scene->span[scene->row[scene->part[k].span[i].y + 1]++] = scene->part[k].span[i];
}

static void
measure_groups (CeldScene *scene)
{
  const CeldSceneSpan *before = NULL;
  size_t               spans = 0, pixels = 0;

  for (size_t i = 0; i < scene->row[scene->height]; i++)
    {
      const CeldSceneSpan *span = &scene->span[i];
      bool                 goes_on = before && before->y == span->y && before->group == span->group;

      spans  = (goes_on ? spans : 0) + 1;
      pixels = (goes_on ? pixels : 0) + (size_t) span->n + 2 * CELD_SPAN_END;
      scene->most_spans  = spans > scene->most_spans ? spans : scene->most_spans;
      scene->most_pixels = pixels > scene->most_pixels ? pixels : scene->most_pixels;
      before = span;
    }
}

CeldStatus
celd_scene_sort (CeldScene *scene)
{
  size_t n = 0;

  for (size_t k = 0; k < scene->n_parts; k++)
    n += scene->part[k].n;
  scene->span = celd_alloc (n, sizeof *scene->span);
  if (!scene->span)
    return CELD_NO_MEMORY;
  sort_rows (scene);
  measure_groups (scene);
  for (size_t k = 0; k < scene->n_parts; k++)
    {
      celd_free (scene->part[k].span);
      scene->part[k].span = NULL;
    }
  return CELD_OK;
}
