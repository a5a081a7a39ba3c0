/* The scene between the two passes of a view from above or below.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "stereo/scanline.h"

/* A group of the scene after horizontal projection, with rows and columns exchanged: premultiplied colours, and
 * depth. */
typedef struct { const CeldScene *scene; CeldProjection move; float *colour, *depths; } Transposition;

/* Writes the samples of one row to a column of the transposed picture. */
static void
transpose_row (const Transposition *t, int y, CeldScanline *line)
{
  size_t height = (size_t) t->scene->height;

  for (int k = line->first; k < line->end; k++)
    {
      const CeldSceneSpan *s = line->span[k];
      size_t               to = (size_t) k * height + (size_t) y;

      if (!s)
        continue;
      celd_scanline_blend (s->colour + 4 * line->at[k], line->t[k], t->colour + 4 * to);
      t->depths[to]   = line->nearest[k];
      line->span[k] = NULL;
    }
  line->first = line->width;
  line->end   = 0;
}

/* Projects a group horizontally and makes a part of the transposed scene of it. */
static CeldStatus
transpose_group (Transposition *t, uint32_t group, CeldScanline *line, const CeldHost *host, CeldSceneSpans *to)
{
  const CeldScene *scene = t->scene;
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
      count = celd_scanline_take_group (scene, i, line, &spans);
      for (size_t k = 0; k < count; k++)
        celd_scanline_project (&t->move, &spans[k], line);
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

CeldStatus
celd_scene_transpose (const CeldScene *scene, CeldProjection move, const CeldHost *host, CeldScene **result)
{
  size_t        n = (size_t) scene->width * (size_t) scene->height;
  uint32_t      groups = count_groups (scene);
  char         *scratch = celd_alloc (1, celd_scanline_bytes (scene));
  Transposition t = { scene, move, celd_alloc (n, 4 * sizeof (float)), celd_alloc (n, sizeof (float)) };
  CeldScene    *made = NULL;
  CeldStatus    status = celd_scene_new (scene->height, scene->width, groups, &made);

  if (!scratch || !t.colour || !t.depths)
    status = CELD_NO_MEMORY;
  if (status == CELD_OK)
    {
      CeldScanline line = celd_scanline_in (scratch, scene);

      made->opaque = scene->opaque;
      for (uint32_t k = 0; k < groups && status == CELD_OK; k++)
        {
          status = transpose_group (&t, k, &line, host, &made->part[k]);
          if (status == CELD_OK)
            status = celd_progress (host, 0.8 * (k + 1) / groups);
        }
    }
  if (status == CELD_OK)
    status = celd_scene_sort (made);
  celd_free (scratch);
  celd_free (t.colour);
  celd_free (t.depths);
  if (status == CELD_OK)
    *result = made;
  else
    celd_scene_free (made);
  return status;
}
