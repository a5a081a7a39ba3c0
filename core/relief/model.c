/* A drawing as a model: one mesh for each region, on its whole silhouette, with one texture (section 5, Figure 1h).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "relief/parts.h"

#include <math.h>

/* Below all parts by the thickness of the plate, in pixels. */
static double
find_bottom (const CeldParts *parts, double thickness)
{
  double least = 0;

  for (size_t k = 0; k < parts->n; k++)
    {
      const CeldPart *part = &parts->item[k];

      for (int y = 0; y < part->box.height && !part->page; y++)
        for (int x = 0; x < part->box.width; x++)
          if (celd_part_has (part, x, y))
            least = fmin (least, (double) part->z[celd_part_at (part, x, y)]);
    }
  return least - thickness;
}

/* Where the flat back of a part lies.  Each has its own place in the plate, so that no two bodies share an edge. */
static double
back_of (const CeldParts *parts, size_t k, double bottom, double thickness)
{
  return parts->item[k].page ? bottom : bottom + thickness * (0.25 + 0.5 * (double) k / (double) parts->n);
}

static void
clear_meshes (CeldModel *model)
{
  for (size_t k = 0; k < model->n; k++)
    celd_relief_mesh_clear (&model->part[k].mesh);
  model->n = 0;
}

/* What the meshes of a model are made of, and the model. */
typedef struct
{
  const CeldParts      *parts;
  const CeldAtlasPlace *place;
  const CeldSettings   *settings;
  CeldModel            *model;
} ModelWork;

/* Makes all meshes with one error; *n is the number of vertices. */
static CeldStatus
make_meshes (void *data, double error, const CeldHost *host, size_t *n)
{
  const ModelWork    *w = data;
  const CeldParts    *parts = w->parts;
  const CeldSettings *settings = w->settings;
  CeldModel          *model = w->model;
  double     scale = (double) settings->mesh_size / (parts->width > parts->height ? parts->width : parts->height);
  double     thickness = (double) settings->mesh_plate / scale, bottom = find_bottom (parts, thickness);
  CeldStatus status = CELD_OK;

  clear_meshes (model);
  model->error = error;
  *n           = 0;
  for (size_t k = 0; k < parts->n && status == CELD_OK; k++)
    {
      CeldModelPart *part = &model->part[model->n];
      CeldHostPart   share;
      CeldHost       turn = celd_host_part (&share, host, 0, 0);

      *part  = (CeldModelPart) { .label = parts->sheets->item[k].label, .page = parts->item[k].page };
      status = celd_part_mesh (parts, k, &w->place[k], error, back_of (parts, k, bottom, thickness), settings, &turn,
                               &part->mesh);
      *n += part->mesh.vertices;
      if (part->mesh.triangles)
        model->n++;
      else
        celd_relief_mesh_clear (&part->mesh);
    }
  return status;
}

CeldStatus
celd_model (const CeldSheets *sheets, const CeldOwnership *own, const CeldLayers *layers, const CeldPlane *ink,
            const CeldPlane *borders, const CeldSettings *settings, const CeldHost *host, CeldModel *model)
{
  if ((borders && !CELD_SAME_SIZE (ink, borders)) || !CELD_SAME_SIZE (ink, &own->owner) ||
      !CELD_SAME_SIZE (ink, &own->under) || !CELD_SAME_SIZE (ink, &own->coverage) ||
      ink->width != layers->width || ink->height != layers->height ||
      ink->width != sheets->width || ink->height != sheets->height)
    return CELD_BAD_SIZE;
  if (celd_settings_check (settings) != CELD_OK || layers->n != sheets->n)
    return CELD_BAD_VALUE;

  CeldParts       parts = { 0 };
  CeldModel       made = { .part = celd_alloc0 (sheets->n, sizeof *made.part) };
  CeldAtlasPlace *place = celd_alloc (sheets->n, sizeof *place);
  CeldHostPart    share[3];
  CeldHost        shaping = celd_host_part (&share[0], host, 0, 0.5);
  CeldHost        meshing = celd_host_part (&share[1], host, 0.5, 0.8);
  CeldHost        painting = celd_host_part (&share[2], host, 0.8, 1);
  CeldStatus      status = made.part && place ? celd_parts_new (sheets, own, ink, borders, settings, &shaping, &parts)
                                              : CELD_NO_MEMORY;

  if (status == CELD_OK)
    status = celd_atlas_pack (&parts, place);
  if (status == CELD_OK)
    status = celd_mesh_least_error (settings, &meshing, make_meshes,
                                    &(ModelWork) { &parts, place, settings, &made });
  if (status == CELD_OK)
    status = celd_atlas_paint (&parts, place, layers, &painting, &made.atlas);
  if (status == CELD_OK)
    {
      celd_model_clear (model);
      *model = made;
    }
  else
    celd_model_clear (&made);
  celd_parts_clear (&parts);
  celd_free (place);
  return status;
}

CeldStatus
celd_model_of_levels (const CeldPlane *ink, const CeldPlane *borders, const CeldPlane *levels,
                      const CeldLabels *regions, const CeldColours *art, const CeldSettings *settings,
                      const CeldHost *host, CeldModel *model)
{
  CeldLevelOwnership made;
  CeldSheets        *sheets = NULL;
  CeldLayers        *layers = NULL;
  CeldHostPart       share[4];
  CeldHost           owning = celd_host_part (&share[0], host, 0, 0.2);
  CeldHost           hiding = celd_host_part (&share[1], host, 0.2, 0.3);
  CeldHost           cutting = celd_host_part (&share[2], host, 0.3, 0.4);
  CeldHost           rest = celd_host_part (&share[3], host, 0.4, 1);
  CeldStatus         status = celd_settings_check (settings);

  if (status != CELD_OK)
    return status;
  status = celd_level_ownership_new (ink, NULL, levels, regions, NULL, settings->expansion, &owning, &made);
  if (status == CELD_OK)
    status = celd_level_sheets (&made, ink, settings, &hiding, &sheets);
  if (status == CELD_OK)
    status = celd_layers_cut (ink, &made.own, made.order, made.n, art, sheets, CELD_STORE_FLOAT, &cutting, &layers);
  if (status == CELD_OK)
    status = celd_model (sheets, &made.own, layers, ink, borders, settings, &rest, model);
  celd_layers_free (layers);
  celd_sheets_free (sheets);
  celd_level_ownership_clear (&made);
  return status;
}

void
celd_model_clear (CeldModel *model)
{
  clear_meshes (model);
  celd_free (model->part);
  celd_free (model->atlas.data);
  *model = (CeldModel) { .n = 0 };
}
