/* Failing allocations and cancelling in the steps that use depth: layers, shading, views, enhancement, reliefs.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "faults.h"
#include "base/base.h"
#include "layers/layers.h"

/* The label picture cut up, as if the left part of each shared pixel were the label's and the right part the next
 * one's: gaps, holes and lines to complete. */
static CeldStatus
layers_step (const CeldHost *host, Results *r)
{
  static uint32_t under[W * H];
  static float    share[W * H], art[4 * W * H];
  CeldPlane       ink = plane_of (&ink_pixels);
  CeldOwnership   own = { labels_of (&expanded_pixels), { W, H, W, under }, { W, H, W, share } };
  CeldLabels      hints = labels_of (&label_pixels);
  CeldColours     colours = { W, H, W, art };
  uint32_t        level[8] = { 1, 2, 0, 3, 4, 5, 6, 7 };
  CeldOrder       order = { .level = level, .n = label_palette.n };
  CeldSheets     *sheets = NULL;
  CeldLayers     *layers = NULL;
  CeldJoint       joint[8];
  CeldHostPart    part[2];
  CeldHost        first = celd_host_part (&part[0], host, 0, 0.5), second = celd_host_part (&part[1], host, 0.5, 1);
  CeldStatus      status;

  for (int p = 0; p < W * H; p++)
    {
      under[p] = expanded_pixels.labels[(p + 1) % (W * H)];
      share[p] = under[p] == expanded_pixels.labels[p] ? 1 : 0.5f;
      for (int c = 0; c < 4; c++)
        art[4 * p + c] = c == 3 ? 1 : ink_pixels.plane[p] * (float) (p % W) / W;
    }
  status = celd_sheets (&ink, &own, &hints, &order, 3, &scene_settings, &first, &sheets);
  if (status == CELD_OK)
    status = celd_layers_cut (&ink, &own, level, label_palette.n, &colours, sheets, CELD_STORE_8_BIT_SRGB, &second,
                              &layers);
  if (status == CELD_OK)
    status = celd_layers_joints (layers, 3, joint);
  for (size_t k = 0; status == CELD_OK && k < celd_layers_count (layers); k++)
    r->pixels->labels[k] = (uint32_t) celd_layers_item (layers, k)->box.width + (uint32_t) joint[k].parent;
  celd_sheets_free (sheets);
  celd_layers_free (layers);
  return status;
}

/* Two sheets with a row of hidden pixels each, of which nothing is known. */
static CeldStatus
sheet_problems_step (const CeldHost *host, Results *r)
{
  static uint8_t coverage[W], confidence[W];
  CeldSheetRun   run[2] = { { 0, 5, W, 0 }, { 0, 9, W, 0 } };
  CeldSheet      sheet[2];
  CeldSheets     sheets = { .width = W, .height = H, .item = sheet, .n = 2 };

  (void) host;
  memset (coverage, 255, sizeof coverage);
  for (int k = 0; k < 2; k++)
    sheet[k] = (CeldSheet) {
      .run = &run[k], .n_runs = 1, .n_hidden = W, .coverage = coverage, .confidence = confidence };
  return celd_sheet_problems (&sheets, &r->problems);
}

static CeldStatus
layers_of_levels_step (const CeldHost *host, Results *r)
{
  static float art[4 * W * H];
  CeldPlane    ink = plane_of (&ink_pixels), levels = plane_of (&level_pixels);
  CeldLabels   regions = labels_of (&label_pixels);
  CeldColours  colours = { W, H, W, art };
  CeldLayers  *layers = NULL;
  CeldStatus   status = celd_layers_of_levels (&ink, NULL, &levels, &regions, &regions, &colours,
                                               CELD_STORE_FLOAT, &scene_settings, host, &layers);

  if (status == CELD_OK)
    r->pixels->labels[0] = (uint32_t) celd_layers_count (layers);
  celd_layers_free (layers);
  return status;
}

static CeldStatus
normals_step (const CeldHost *host, Results *r)
{
  CeldPlane   ink = plane_of (&ink_pixels), levels = plane_of (&expanded_pixels);
  CeldVectors normals = vectors_of (r->pixels);

  return celd_normals (&ink, &levels, &scene_settings, host, &normals);
}

/* With strokes that fold, a bevel, hints at a border, and the frame. */
static CeldStatus
hints_step (const CeldHost *host, Results *r)
{
  static uint8_t paint[4 * W * H];
  CeldPlane      ink = plane_of (&ink_pixels), levels = plane_of (&expanded_pixels);
  CeldVectors    normals = vectors_of (r->pixels);
  CeldPaint      hints = { W, H, W, paint };
  CeldSettings   all = scene_settings;

  for (int i = 0; i < W * H; i++)
    paint[4 * i + 3] = i % W < W / 2 ? 255 : 0;
  all.creases = 1;
  all.bevel = 0.1f;
  all.frame_outline = true;
  return celd_normals_hinted (&ink, NULL, &levels, &levels, &hints, &all, host, &normals);
}

static CeldStatus
occlusion_step (const CeldHost *host, Results *r)
{
  CeldPlane levels = plane_of (&expanded_pixels), occlusion = plane_of (r->pixels);

  return celd_occlusion (&levels, &scene_settings, host, &occlusion);
}

static CeldStatus
padding_step (const CeldHost *host, Results *r)
{
  static const float blank[3] = { 0, 0, 0 };
  static float       data[4 * W * H];
  CeldColours        picture = { W, H, W, data };

  (void) r;
  for (int i = 0; i < W * H; i++)
    data[4 * i + 3] = i % 7 == 0;
  return celd_pad_colours (4, blank, host, &picture);
}

static CeldStatus
shade_step (const CeldHost *host, Results *r)
{
  CeldVectors normals = vectors_of (&normal_pixels);
  CeldPlane   shading = plane_of (r->pixels);

  (void) host;
  return celd_shade (&normals, &scene_settings, &shading);
}

/* A sheet before paper, cut beforehand. */
static CeldStatus
stereo_step (const CeldHost *host, Results *r)
{
  static uint32_t owner[W * H];
  static float    art[4 * W * H], view[4 * W * H], whole[W * H];
  CeldPlane       ink = plane_of (&ink_pixels), depth = plane_of (&expanded_pixels);
  CeldOwnership   own = { { W, H, W, owner }, { W, H, W, owner }, { W, H, W, whole } };
  CeldColours     colours = { W, H, W, art }, to = { W, H, W, view };
  uint32_t        level[2] = { 0, 1 };
  CeldLayers     *layers = NULL;
  CeldScene      *scene = NULL;
  CeldHostPart    part[2];
  CeldHost        first = celd_host_part (&part[0], host, 0, 0.5), second = celd_host_part (&part[1], host, 0.5, 1);
  CeldStatus      status;

  for (int p = 0; p < W * H; p++)
    {
      owner[p] = p % W > 20 && p % W < 40 ? 2 : 1;
      whole[p] = art[4 * p] = art[4 * p + 1] = art[4 * p + 2] = art[4 * p + 3] = 1;
    }
  status = celd_layers_cut (&ink, &own, level, 2, &colours, NULL, 0, NULL, &layers);
  if (status == CELD_OK)
    status = celd_scene_of_layers (layers, &own, &depth, &first, &scene);
  if (status == CELD_OK)
    status = celd_scene_view (scene, (CeldCamera) { 0.7, -0.3, 1 }, &scene_settings, &second, &to);
  if (status == CELD_OK)
    memcpy (r->pixels->vectors, view, sizeof r->pixels->vectors);
  celd_scene_free (scene);
  celd_layers_free (layers);
  return status;
}

/* A scene of levels. */
static CeldStatus
levels_scene_step (const CeldHost *host, Results *r)
{
  static float art[4 * W * H];
  CeldPlane    ink = plane_of (&ink_pixels), levels = plane_of (&expanded_pixels);
  CeldColours  colours = { W, H, W, art };
  CeldScene   *scene = NULL;
  CeldStatus   status;

  for (int i = 0; i < 4 * W * H; i++)
    art[i] = 1;
  status = celd_scene_of_levels (&ink, &levels, &levels, &colours, &scene_settings, host, &scene);
  if (status == CELD_OK)
    r->pixels->vectors[0] = 1;
  celd_scene_free (scene);
  return status;
}

/* A scene of depth alone. */
static CeldStatus
scene_step (const CeldHost *host, Results *r)
{
  static float art[4 * W * H], view[4 * W * H];
  CeldPlane    ink = plane_of (&ink_pixels), depth = plane_of (&expanded_pixels);
  CeldColours  colours = { W, H, W, art }, to = { W, H, W, view };
  CeldScene   *scene = NULL;
  CeldHostPart part[2];
  CeldHost     first = celd_host_part (&part[0], host, 0, 0.5), second = celd_host_part (&part[1], host, 0.5, 1);
  CeldStatus   status;

  for (int i = 0; i < 4 * W * H; i++)
    art[i] = 1;
  status = celd_scene_of_depth (&colours, &ink, &depth, &scene_settings, &first, &scene);
  if (status == CELD_OK)
    status = celd_scene_view (scene, celd_camera_eye (-1), &scene_settings, &second, &to);
  if (status == CELD_OK)
    memcpy (r->pixels->vectors, view, sizeof r->pixels->vectors);
  celd_scene_free (scene);
  return status;
}

static CeldStatus
enhance_step (const CeldHost *host, Results *r)
{
  CeldPlane levels = plane_of (&expanded_pixels), change = plane_of (r->pixels);

  return celd_enhance (&levels, &scene_settings, host, &change);
}

static CeldStatus
unsharp_step (const CeldHost *host, Results *r)
{
  CeldPlane    levels = plane_of (&expanded_pixels), change = plane_of (r->pixels);
  CeldSettings unsharp = scene_settings;

  unsharp.enhance = CELD_ENHANCE_CONTRAST;
  return celd_enhance (&levels, &unsharp, host, &change);
}

/* The heights of a relief. */
static CeldStatus
make_relief (const CeldSettings *how, const CeldHost *host, Results *r)
{
  CeldPlane  ink = plane_of (&ink_pixels), levels = plane_of (&expanded_pixels);
  CeldRelief relief = { 0 };
  CeldStatus status = celd_relief (&ink, NULL, &levels, NULL, how, host, &relief);

  if (status == CELD_OK)
    memcpy (r->pixels->plane, relief.z, sizeof r->pixels->plane);
  celd_relief_clear (&relief);
  return status;
}

static CeldStatus
relief_step (const CeldHost *host, Results *r)
{
  return make_relief (&scene_settings, host, r);
}

static CeldStatus
relief_of_normals_step (const CeldHost *host, Results *r)
{
  CeldSettings of_normals = scene_settings;

  of_normals.relief_from = CELD_RELIEF_NORMALS;
  return make_relief (&of_normals, host, r);
}

/* A body of two levels, of which the pixels' own heights are the first. */
static CeldStatus
relief_mesh_step (const CeldHost *host, Results *r)
{
  static float   z[W * H];
  static uint8_t cut[W * H];
  CeldRelief     relief = { W, H, z, z, cut };
  CeldSettings   solid = scene_settings;
  CeldReliefMesh mesh = { 0 };
  CeldStatus     status;

  solid.mesh_kind = CELD_MESH_SOLID;
  for (int p = 0; p < W * H; p++)
    {
      z[p]   = p % W > 20 ? (float) (p / W) : 0;
      cut[p] = p % W == 20 ? CELD_CUT_RIGHT : 0;
    }
  status = celd_relief_mesh (&relief, &solid, host, &mesh);
  if (status == CELD_OK)
    for (int p = 0; p < W * H; p++)
      r->pixels->plane[p] = mesh.place[(size_t) p % (3 * mesh.vertices)];
  celd_relief_mesh_clear (&mesh);
  return status;
}

/* The levels, one for each label. */
static CeldStatus
flatten_step (const CeldHost *host, Results *r)
{
  static Pixels copy;
  CeldLabels    labels = labels_of (&label_pixels);
  CeldPlane     levels = plane_of (&copy);
  CeldStatus    status;

  (void) host;
  memcpy (copy.plane, ink_pixels.plane, sizeof copy.plane);
  status = celd_flatten_levels (&labels, label_palette.n, &levels);
  if (status == CELD_OK)
    memcpy (r->pixels->plane, copy.plane, sizeof copy.plane);
  return status;
}

/* A model of the level picture, as solids. */
static CeldStatus
model_step (const CeldHost *host, Results *r)
{
  static float art[4 * W * H];
  CeldPlane    ink = plane_of (&ink_pixels), levels = plane_of (&level_pixels);
  CeldColours  colours = { W, H, W, art };
  CeldSettings solid = scene_settings;
  CeldModel    model = { 0 };
  CeldStatus   status;

  solid.mesh_kind = CELD_MESH_SOLID;
  status     = celd_model_of_levels (&ink, NULL, &levels, NULL, &colours, &solid, host, &model);
  for (size_t k = 0; status == CELD_OK && k < model.n; k++)
    r->pixels->labels[k] = (uint32_t) model.part[k].mesh.triangles;
  celd_model_clear (&model);
  return status;
}

const Step use_steps[] = {
  { "layers", layers_step, NULL, true },
  { "sheet problems", sheet_problems_step, NULL, false },
  { "layers of levels", layers_of_levels_step, NULL, true },
  { "normals", normals_step, NULL, true },
  { "hints", hints_step, NULL, true },
  { "occlusion", occlusion_step, NULL, true },
  { "padding", padding_step, NULL, true },
  { "shade", shade_step, NULL, false },
  { "stereo", stereo_step, NULL, true },
  { "scene of levels", levels_scene_step, NULL, true },
  { "scene", scene_step, NULL, true },
  { "enhance", enhance_step, NULL, true },
  { "unsharp", unsharp_step, NULL, true },
  { "relief", relief_step, NULL, true },
  { "relief of normals", relief_of_normals_step, NULL, true },
  { "relief mesh", relief_mesh_step, NULL, true },
  { "levels of regions", flatten_step, NULL, false },
  { "model", model_step, NULL, true },
  { NULL, NULL, NULL, false },
};
