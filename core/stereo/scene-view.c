/* Views of a scene from other places (section 5, Figure 1g).
 *
 * A pixel of depth d at x is projected to  c + q (x - c) - s (d - d_0),  where c is the middle of the picture, q its
 * horizontal compression, d_0 the depth on the screen and 2 s the disparity of both eyes in pixels for each unit of
 * depth (scanline.c).  Groups of spans are composited in their order.
 *
 * A camera that moves vertically as well is handled in two passes: rows first, then columns of the result
 * (scene-transpose.c), for each group separately with its depth.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "stereo/scanline.h"

#define VIEW_BAND_ROWS 32 /* rows of one task */

typedef struct
{
  const CeldScene *scene;
  CeldProjection   move;
  CeldColours     *view;       /* straight alpha */
  char            *scratch;    /* of each band */
} SceneView;

/* ------------------------------------------------------------------ rows */

/* Composites a group over the row, and clears the samples for the next group. */
CELD_CLONES static void
composite_group (CeldScanline *line)
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
          celd_scanline_blend (from, line->t[k], colour);
          from = colour;
        }
      for (int c = 0; c < 4; c++)
        to[c] = from[c] + (1 - from[3]) * to[c];
    }
  line->first = line->width;
  line->end   = 0;
}

static void
draw_row (const SceneView *v, int y, CeldScanline *line)
{
  const CeldScene *scene = v->scene;
  size_t           end = scene->row[y + 1];

  memset (line->colour, 0, 4 * (size_t) line->width * sizeof *line->colour);
  for (size_t i = scene->row[y], n; i < end; i += n)
    {
      const CeldSceneSpan *spans;

      n = celd_scanline_take_group (scene, i, line, &spans);
      for (size_t k = 0; k < n; k++)
        {
          celd_scanline_project (&v->move, &spans[k], line);
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
  CeldScanline         line = celd_scanline_in (v->scratch + (size_t) band * celd_scanline_bytes (v->scene), v->scene);

  for (int y = band * VIEW_BAND_ROWS; y < end && y < v->scene->height; y++)
    {
      draw_row (v, y, &line);
      unpremultiply (line.colour, width, v->scene->opaque, CELD_RGBA (v->view, 0, y));
    }
}

static CeldStatus
draw (const CeldScene *scene, CeldProjection move, const CeldHost *host, CeldColours *view)
{
  int       bands = (scene->height + VIEW_BAND_ROWS - 1) / VIEW_BAND_ROWS;
  SceneView v = { scene, move, view, celd_alloc ((size_t) bands, celd_scanline_bytes (scene)) };

  if (!v.scratch)
    return CELD_NO_MEMORY;
  celd_parallel_for (host, bands, draw_band, &v);
  celd_free (v.scratch);
  return CELD_OK;
}

/* ------------------------------------------------------------------ */

/* Horizontally, and then vertically. */
static CeldStatus
draw_two_axes (const CeldScene *scene, CeldProjection across, CeldProjection along, const CeldHost *host,
               CeldColours *view)
{
  CeldColours tall = { scene->height, scene->width, (size_t) scene->height, NULL };
  CeldScene  *transposed = NULL;
  CeldStatus  status = celd_scene_transpose (scene, across, host, &transposed);

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

CeldStatus
celd_scene_view (const CeldScene *scene, CeldCamera camera, const CeldSettings *settings, const CeldHost *host,
                 CeldColours *view)
{
  double         half, screen;
  CeldProjection across, along;
  CeldStatus     status;

  if (!view->data || view->width != scene->width || view->height != scene->height)
    return CELD_BAD_SIZE;
  if (celd_settings_check (settings) != CELD_OK || !(fabs (camera.x) <= 1) || !(fabs (camera.y) <= 1) ||
      !(camera.squeeze > 0 && camera.squeeze <= 1))
    return CELD_BAD_VALUE;
  half   = (double) settings->disparity * scene->width / 2;
  screen = scene->least + (double) settings->convergence * (scene->most - scene->least);
  across = (CeldProjection) { camera.squeeze, scene->width / 2.0, camera.x * half, screen };
  along  = (CeldProjection) { 1, scene->height / 2.0, camera.y * half, screen };
  status = camera.y != 0 ? draw_two_axes (scene, across, along, host, view) : draw (scene, across, host, view);
  return status != CELD_OK ? status : celd_progress (host, 1);
}
