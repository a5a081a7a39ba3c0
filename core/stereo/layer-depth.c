/* The depth of a layer of a scene where it is occluded: it goes on smoothly from where the layer is visible.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "stereo/scene.h"

#define FLAT_DEPTH  1e-4 /* of the range: a layer whose depth varies less has one depth; chosen */
#define KNOWN_APRON 8    /* pixels round what is occluded from which depth goes on; chosen */

typedef struct
{
  CeldScene           *scene;
  const CeldOwnership *own;
  uint32_t             layer;
  CeldRect             box;      /* of the layer, margin included; later of what is occluded, with an apron */
  bool                 thin;     /* does the layer cover no pixel by half? */
  double               least, most; /* range of its depth */
  uint8_t             *known;    /* of the box */
  float               *depths;
} DepthExtension;

/* The depth of a pixel is that of the label that covers most of it. */
static bool
is_own (const DepthExtension *e, int x, int y)
{
  uint32_t label = e->scene->layers->item[e->layer].label;

  return celd_larger_label (e->own, x, y) == label ||
         (e->thin && (CELD_AT (&e->own->owner, x, y) == label || CELD_AT (&e->own->under, x, y) == label));
}

/* Measures the range of the layer's own depth; false if it has none. */
static bool
measure_depth (DepthExtension *e)
{
  e->least = DBL_MAX;
  e->most  = -DBL_MAX;
  for (int y = e->box.y; y < e->box.y + e->box.height; y++)
    for (int x = e->box.x; x < e->box.x + e->box.width; x++)
      if (is_own (e, x, y))
        {
          double depth = (double) celd_scene_depth (CELD_AT (&e->scene->depth, x, y));

          e->least = fmin (e->least, depth);
          e->most  = fmax (e->most, depth);
        }
  return e->least <= e->most;
}

/* Calls a function for each pixel of the layer that is not its alone, in the order of its spans. */
static void
visit_extended (DepthExtension *e, uint32_t group, void (*visit) (DepthExtension *e, int x, int y, float *value))
{
  const CeldSceneSpans *spans = &e->scene->part[group];
  float                *value = e->scene->extended[group].value;

  for (size_t k = 0; k < spans->n; k++)
    for (int x = spans->span[k].x, y = spans->span[k].y; x < spans->span[k].x + spans->span[k].n; x++)
      if (celd_scene_is_margin (e->scene, group) || !celd_scene_is_whole (e->scene->layers, e->layer, x, y))
        visit (e, x, y, value++);
}

static void
add_to_box (DepthExtension *e, int x, int y, float *value)
{
  (void) value;
  e->box = celd_rect_union (e->box, (CeldRect) { x, y, 1, 1 });
}

static void
keep_depth (DepthExtension *e, int x, int y, float *value)
{
  *value = e->depths[(size_t) (y - e->box.y) * (size_t) e->box.width + (size_t) (x - e->box.x)];
}

/* Extends depth over a box that has known pixels. */
static CeldStatus
fill_box (DepthExtension *e)
{
  size_t n = (size_t) e->box.width * (size_t) e->box.height, i = 0;

  e->known  = celd_alloc (n, 1);
  e->depths = celd_alloc (n, sizeof *e->depths);
  if (!e->known || !e->depths)
    return CELD_NO_MEMORY;
  for (int y = e->box.y; y < e->box.y + e->box.height; y++)
    for (int x = e->box.x; x < e->box.x + e->box.width; x++, i++)
      {
        e->known[i]  = is_own (e, x, y);
        e->depths[i] = e->known[i] ? celd_scene_depth (CELD_AT (&e->scene->depth, x, y)) : 0;
      }
  return celd_extend (e->box.width, e->box.height, 1, e->known, e->depths);
}

static CeldRect
grown (CeldRect box, int by, int width, int height)
{
  int left = box.x - by > 0 ? box.x - by : 0, top = box.y - by > 0 ? box.y - by : 0;
  int right = box.x + box.width + by, bottom = box.y + box.height + by;

  return (CeldRect) { left, top, (right < width ? right : width) - left, (bottom < height ? bottom : height) - top };
}

/* Extends the depth of a layer over the n[0] pixels of its spans that are not its alone, and over the n[1] pixels of
 * its margin. */
static CeldStatus
extend_depth (DepthExtension *e, const size_t n[2])
{
  CeldScene *scene = e->scene;
  uint32_t   group[2] = { celd_scene_group_of_layer (scene, e->layer), e->layer + 1 };
  CeldStatus status = CELD_OK;

  e->box = (CeldRect) { 0 };
  for (int k = 0; k < 2 && status == CELD_OK; k++)
    {
      scene->extended[group[k]].value = celd_alloc (n[k], sizeof (float));
      status = scene->extended[group[k]].value ? CELD_OK : CELD_NO_MEMORY;
      if (status == CELD_OK)
        visit_extended (e, group[k], add_to_box);
    }
  if (status == CELD_OK && e->box.width)
    {
      e->box = grown (e->box, KNOWN_APRON, scene->width, scene->height);
      status = fill_box (e);
    }
  for (int k = 0; k < 2 && status == CELD_OK; k++)
    visit_extended (e, group[k], keep_depth);
  celd_free (e->known);
  celd_free (e->depths);
  return status;
}

static CeldRect
whole_box (const CeldLayers *layers, uint32_t layer)
{
  const CeldHiddenPart *margin = &layers->margin[layer];
  CeldRect              box = layers->item[layer].box;

  for (size_t r = 0; r < margin->n_runs; r++)
    box = celd_rect_union (box, (CeldRect) { margin->run[r].x, margin->run[r].y, margin->run[r].n, 1 });
  return box;
}

/* A layer of one depth, as nearly every one is, keeps that alone. */
CeldStatus
celd_scene_layer_depth (CeldScene *scene, const CeldOwnership *own, uint32_t layer, const size_t n[2])
{
  DepthExtension e = { .scene = scene, .own = own, .layer = layer, .box = whole_box (scene->layers, layer) };
  float          flat;

  if (!measure_depth (&e))
    {
      e.thin = true;
      if (!measure_depth (&e))
        e.least = e.most = scene->least;
    }
  flat = (float) e.least + (float) (e.most - e.least) / 2;
  scene->extended[celd_scene_group_of_layer (scene, layer)].flat = scene->extended[layer + 1].flat = flat;
  return e.most - e.least <= FLAT_DEPTH * (scene->most - scene->least) ? CELD_OK : extend_depth (&e, n);
}
