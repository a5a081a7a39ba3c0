/* Failing allocations and cancelling in motion: registration, clips, deformation, in-betweens, composition.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "faults.h"
#include "base/base.h"
#include "layers/layers.h"

/* The labels, registered to the drawing shifted by three pixels. */
static CeldStatus
register_step (const CeldHost *host, Results *r)
{
  static float    shifted[W * H];
  CeldPlane       ink = plane_of (&ink_pixels), target = { W, H, W, shifted }, confidence = plane_of (r->pixels);
  CeldLabels      labels = labels_of (&label_pixels);
  uint32_t        level[8] = { 1, 2, 0, 3, 4, 5, 6, 7 };
  CeldMovingParts parts = { .labels = &labels, .level = level, .n = label_palette.n, .background = 3 };
  CeldLattice    *lattice = NULL;
  CeldHostPart    part[2];
  CeldHost        first = celd_host_part (&part[0], host, 0, 0.5), second = celd_host_part (&part[1], host, 0.5, 1);
  CeldStatus      status = celd_lattice_new (&ink, &parts, &scene_settings, &first, &lattice);

  for (int p = 0; p < W * H; p++)
    shifted[p] = ink_pixels.plane[p % W < W - 3 ? p + 3 : p];
  if (status == CELD_OK)
    status = celd_register (&ink, &target, &scene_settings, &second, lattice, &confidence);
  celd_lattice_free (lattice);
  return status;
}

/* The labels, carried to the drawing shifted by three pixels, with the levels of a picture. */
static CeldStatus
propagate_step (const CeldHost *host, Results *r)
{
  static float shifted[W * H], value[8];
  CeldPlane    ink = plane_of (&ink_pixels), next = { W, H, W, shifted }, certainty = plane_of (r->pixels);
  CeldLabels   labels = labels_of (&label_pixels), seeds = labels_of (r->pixels);
  CeldPlane    levels = plane_of (&level_pixels);
  uint32_t     level[8];
  CeldStatus   status = celd_label_levels (&labels, label_palette.n, &levels, value, level);

  for (int p = 0; p < W * H; p++)
    shifted[p] = ink_pixels.plane[p % W < W - 3 ? p + 3 : p];
  return status == CELD_OK ? celd_propagate (&ink, &labels, level, 3, &next, host, &seeds, &certainty) : status;
}

/* The labels, blended with what they are a row higher. */
static CeldStatus
blend_step (const CeldHost *host, Results *r)
{
  CeldLabels     one = { W, H - 1, W, label_pixels.labels + W }, other = { W, H - 1, W, label_pixels.labels };
  CeldLabels     labels = { W, H - 1, W, r->pixels->labels };
  CeldPlane      sure = { W, H - 1, W, ink_pixels.plane }, certainty = { W, H - 1, W, r->pixels->plane };
  CeldPropagated side[2] = { { &one, &sure, 0.4 }, { &other, &sure, 0.6 } };

  return celd_blend_propagated (side, host, &labels, &certainty);
}

/* The labels, rated as if they had come back a row higher. */
static CeldStatus
returned_step (const CeldHost *host, Results *r)
{
  CeldLabels before = { W, H - 1, W, label_pixels.labels + W }, back = { W, H - 1, W, label_pixels.labels };
  double     sure[9];
  CeldStatus status = celd_rate_returned (&before, &before, &back, label_palette.n, sure);

  (void) host;
  for (size_t l = 1; status == CELD_OK && l <= label_palette.n; l++)
    r->pixels->plane[l] = (float) sure[l];
  return status;
}

/* The labels, rated as if the second side had them a row higher. */
static CeldStatus
rate_blended_step (const CeldHost *host, Results *r)
{
  CeldLabels              one = { W, H - 1, W, label_pixels.labels + W }, other = { W, H - 1, W, label_pixels.labels };
  const CeldLabels *const side[2] = { &one, &other };
  double                  half[9], sure[9];
  const double *const     side_sure[2] = { half, half };
  CeldStatus              status;

  (void) host;
  for (int l = 0; l < 9; l++)
    half[l] = 0.5;
  status = celd_rate_blended (side, side_sure, &one, label_palette.n, sure);
  for (size_t l = 1; status == CELD_OK && l <= label_palette.n; l++)
    r->pixels->plane[l] = (float) sure[l];
  return status;
}

/* The labels in a palette that has no background yet. */
static CeldStatus
join_step (const CeldHost *host, Results *r)
{
  CeldLabels labels = labels_of (&label_pixels), joined = labels_of (r->pixels);

  (void) host;
  return celd_join_labels (&labels, &label_palette, &r->palette, &joined);
}

/* Labels that all moved a row up, and what is noted of them. */
static CeldStatus
notes_step (const CeldHost *host, Results *r)
{
  CeldLabels     before = { W, H - 1, W, label_pixels.labels + W }, after = { W, H - 1, W, label_pixels.labels };
  CeldPlane      ink = { W, H - 1, W, ink_pixels.plane };
  CeldRegionNote note[9];
  size_t         n = 0;
  double         mean = 0;
  CeldStatus     status = celd_note_regions (&ink, &before, &after, &ink, label_palette.n, 0, NULL, note, &n, &mean);

  (void) host;
  if (status == CELD_OK)
    r->pixels->plane[0] = (float) mean;
  for (size_t i = 0; status == CELD_OK && i < n; i++)
    r->pixels->plane[i + 1] = (float) note[i].certainty;
  return status;
}

/* The silhouette of all, found without labels. */
static CeldStatus
lattice_step (const CeldHost *host, Results *r)
{
  CeldPlane    ink = plane_of (&ink_pixels);
  CeldLattice *lattice = NULL;
  CeldShifts   shifts = { W, H, W, r->pixels->vectors };
  CeldStatus   status = celd_lattice_new (&ink, NULL, &scene_settings, host, &lattice);

  if (status == CELD_OK)
    status = celd_lattice_displacement (lattice, &shifts);
  celd_lattice_free (lattice);
  return status;
}

/* The lattice of the level picture, and a picture that it carries. */
static CeldStatus
levels_lattice_step (const CeldHost *host, Results *r)
{
  static float art[4 * W * H], warped[4 * W * H];
  CeldPlane    ink = plane_of (&ink_pixels), levels = plane_of (&level_pixels);
  CeldLattice *lattice = NULL;
  CeldStatus   status = celd_lattice_of_levels (&ink, &levels, NULL, &scene_settings, host, &lattice);

  for (int i = 0; i < 4 * W * H; i++)
    art[i] = ink_pixels.plane[i / 4];
  if (status == CELD_OK)
    status = celd_lattice_warp (lattice, &(CeldColours) { W, H, W, art }, &(CeldColours) { W, H, W, warped });
  if (status == CELD_OK)
    memcpy (r->pixels->plane, warped, sizeof r->pixels->plane);
  celd_lattice_free (lattice);
  return status;
}

/* A handle between two keys. */
static CeldStatus
handle_keys_step (const CeldHost *host, Results *r)
{
  CeldHandle    item[2] = { { 10, 10, 10, 10, 0 }, { 10, 10, 20, 12, 1 } };
  CeldHandleKey key[2] = { { 0, { &item[0], 1 } }, { 3, { &item[1], 1 } } };
  CeldHandles   handles = { 0 };
  CeldStatus    status = celd_handles_between (key, 2, 1, &handles);

  (void) host;
  if (status == CELD_OK)
    r->pixels->plane[0] = (float) handles.item[0].to_x;
  celd_handles_clear (&handles);
  return status;
}

/* A puppet of the levels, with handles as text and as paint, in a pose. */
static CeldStatus
deform_step (const CeldHost *host, Results *r)
{
  static float   art[4 * W * H], view[4 * W * H];
  static uint8_t dots[4 * W * H];
  CeldPlane      ink = plane_of (&ink_pixels), levels = plane_of (&level_pixels), out = plane_of (r->pixels);
  CeldColours    colours = { W, H, W, art }, to = { W, H, W, view };
  CeldPaint      paint = { W, H, W, dots };
  CeldHandles    handles = { 0 };
  CeldLayers    *layers = NULL;
  CeldPuppet    *puppet = NULL;
  CeldHostPart   part[3];
  CeldHost       first = celd_host_part (&part[0], host, 0, 0.4), second = celd_host_part (&part[1], host, 0.4, 0.6);
  CeldHost       third = celd_host_part (&part[2], host, 0.6, 0.6);
  CeldStatus     status;

  for (int i = 0; i < 4 * W * H; i++)
    {
      art[i]  = i % 4 == 3 ? 1 : ink_pixels.plane[i / 4];
      dots[i] = i % 4 == 3 && i / 4 % W < 8 && i / 4 / W < 8 ? 255 : 0;
    }
  status = celd_layers_of_levels (&ink, NULL, &levels, NULL, NULL, &colours, CELD_STORE_FLOAT, &scene_settings, &first, &layers);
  if (status == CELD_OK)
    status = celd_puppet_new (layers, &ink, NULL, 1, NULL, &scene_settings, &second, &puppet);
  if (status == CELD_OK)
    status = celd_handles_parse ("10,10 -> 20,12; 30,30 ^1", &handles, NULL);
  if (status == CELD_OK)
    status = celd_handles_read (&paint, scene_settings.arrow_style, &third, &handles, &r->problems);
  if (status == CELD_OK)
    status = celd_puppet_pose (puppet, handles.item, handles.n, &third, NULL);
  if (status == CELD_OK)
    status = celd_puppet_draw (puppet, &third, &to, &out);
  celd_handles_clear (&handles);
  celd_puppet_free (puppet);
  celd_layers_free (layers);
  return status;
}

/* A puppet of the levels in one step, whose levels are numbers of the picture. */
static CeldStatus
deform_levels_step (const CeldHost *host, Results *r)
{
  static float art[4 * W * H], view[4 * W * H];
  CeldPlane    ink = plane_of (&ink_pixels), levels = plane_of (&level_pixels), out = plane_of (r->pixels);
  CeldColours  colours = { W, H, W, art }, to = { W, H, W, view };
  CeldHandle   handle = { 10, 10, 20, 12, 1 };
  CeldPuppet  *puppet = NULL;
  CeldHostPart part[2];
  CeldHost     first = celd_host_part (&part[0], host, 0, 0.6), second = celd_host_part (&part[1], host, 0.6, 0.6);
  CeldStatus   status;

  for (int i = 0; i < 4 * W * H; i++)
    art[i] = i % 4 == 3 ? 1 : ink_pixels.plane[i / 4];
  status = celd_puppet_of_levels (&ink, &levels, &colours, &scene_settings, &first, &puppet);
  if (status == CELD_OK)
    status = celd_puppet_pose (puppet, &handle, 1, &second, NULL);
  if (status == CELD_OK)
    status = celd_puppet_draw (puppet, &second, &to, &out);
  celd_puppet_free (puppet);
  return status;
}

/* The layers of a pose. */
static CeldStatus
posed_layers_step (const CeldHost *host, Results *r)
{
  static float art[4 * W * H], own[4 * W * H];
  CeldPlane    ink = plane_of (&ink_pixels), levels = plane_of (&level_pixels);
  CeldColours  colours = { W, H, W, art };
  CeldHandle   handle = { 10, 10, 20, 12, 0 };
  CeldPuppet  *puppet = NULL;
  CeldLayers  *layers = NULL;
  CeldHostPart part[2];
  CeldHost     first = celd_host_part (&part[0], host, 0, 0.6), second = celd_host_part (&part[1], host, 0.6, 1);
  CeldStatus   status;

  for (int i = 0; i < 4 * W * H; i++)
    art[i] = i % 4 == 3 ? 1 : ink_pixels.plane[i / 4];
  status = celd_puppet_of_levels (&ink, &levels, &colours, &scene_settings, &first, &puppet);
  if (status == CELD_OK)
    status = celd_puppet_pose (puppet, &handle, 1, NULL, NULL);
  if (status == CELD_OK)
    status = celd_puppet_layers (puppet, true, &second, &layers);
  if (status == CELD_OK)
    {
      celd_layers_paint (layers, 0, own);
      memcpy (r->pixels->plane, own, sizeof r->pixels->plane);
    }
  celd_layers_free (layers);
  celd_puppet_free (puppet);
  return status;
}

/* Two keys: the levels of the drawing, and of it shifted by three pixels, where a part is missing; and what is
 * between. */
static CeldStatus
inbetween_step (const CeldHost *host, Results *r)
{
  static float  pixels[2][2][W * H], art[2][4 * W * H], view[4 * W * H];
  CeldPlane     ink[2], levels[2];
  CeldColours   colours[2], to = { W, H, W, view };
  CeldLayers   *layers[2] = { NULL, NULL };
  CeldKey       key[2];
  CeldInbetween *between = NULL;
  CeldHostPart  part[4];
  CeldStatus    status = CELD_OK;

  for (int s = 0; s < 2 && status == CELD_OK; s++)
    {
      CeldHost cutting = celd_host_part (&part[s], host, 0.2 * s, 0.2 * (s + 1));

      ink[s]     = (CeldPlane) { W, H, W, pixels[s][0] };
      levels[s]  = (CeldPlane) { W, H, W, pixels[s][1] };
      colours[s] = (CeldColours) { W, H, W, art[s] };
      for (int p = 0; p < W * H; p++)
        {
          int from = s && p % W < W - 3 ? p + 3 : p;

          pixels[s][0][p] = ink_pixels.plane[from];
          pixels[s][1][p] = level_pixels.plane[from];
          for (int c = 0; c < 4; c++)
            art[s][4 * p + c] = c == 3 ? 1 : ink_pixels.plane[from];
        }
      status = celd_layers_of_levels (&ink[s], NULL, &levels[s], NULL, NULL, &colours[s], CELD_STORE_FLOAT, &scene_settings,
                                      &cutting, &layers[s]);
      if (status == CELD_OK && s)
        layers[s]->item[layers[s]->n - 1].label = 100;
      key[s] = (CeldKey) { layers[s], &ink[s], 1 };
    }
  if (status == CELD_OK)
    {
      CeldHost making = celd_host_part (&part[2], host, 0.4, 0.9);

      status = celd_inbetween_new (key, &scene_settings, &making, &between);
    }
  if (status == CELD_OK)
    {
      CeldHost drawing = celd_host_part (&part[3], host, 0.9, 1);

      status = celd_inbetween_draw (between, 0.5, &drawing, &to);
    }
  if (status == CELD_OK)
    for (int p = 0; p < W * H; p++)
      r->pixels->plane[p] = view[4 * p];
  celd_inbetween_free (between);
  celd_layers_free (layers[0]);
  celd_layers_free (layers[1]);
  return status;
}

/* Two halves of a page, twice, with a relation that holds, one that contradicts it, and one that names nothing. */
static CeldStatus
compose_step (const CeldHost *host, Results *r)
{
  static uint32_t  owner[W * H];
  static float     art[4 * W * H], whole[W * H], view[4 * W * H];
  CeldPlane        ink = plane_of (&ink_pixels);
  CeldOwnership    own = { { W, H, W, owner }, { W, H, W, owner }, { W, H, W, whole } };
  CeldColours      colours = { W, H, W, art }, to = { W, H, W, view };
  uint32_t         level[2] = { 0, 1 };
  CeldOrder        order = { .level = level, .n = 2, .levels = 2 };
  CeldRelation     item[3] = {
    { .nearer = { .x = 1, .y = 1 }, .farther = { .fragment = 1, .whole = true }, .weight = 2 },
    { .nearer = { .fragment = 1, .whole = true }, .farther = { .x = 1, .y = 1 }, .weight = 1 },
    { .nearer = { .by_colour = true, .colour = { 1, 2, 3 } }, .farther = { .x = 1, .y = 1 }, .weight = 1 } };
  CeldRelations    relations = { item, 3 };
  CeldLayers      *layers = NULL;
  CeldComposition *composition = NULL;
  CeldHostPart     part[2];
  CeldHost         first = celd_host_part (&part[0], host, 0, 0.5), second = celd_host_part (&part[1], host, 0.5, 1);
  CeldStatus       status;

  for (int p = 0; p < W * H; p++)
    {
      owner[p] = p % W < 20 ? 2 : 1;
      whole[p] = art[4 * p] = art[4 * p + 1] = art[4 * p + 2] = art[4 * p + 3] = 1;
    }
  status = celd_layers_cut (&ink, &own, level, 2, &colours, NULL, CELD_STORE_FLOAT, NULL, &layers);
  if (status == CELD_OK)
    {
      CeldPalette  palette = { label_palette.item, 2 };
      CeldFragment fragment[2] = {
        { layers, &order, 0, { 0, 0, 1, 0, false }, &own.owner, &palette, &ink },
        { layers, &order, 1, { 9, 5, 0.7, 33, true }, NULL, NULL, NULL } };

      status = celd_compose (fragment, 2, &relations, W, H, &first, &r->problems, &composition);
    }
  if (status == CELD_OK)
    status = celd_composition_flatten (composition, &second, &to);
  for (size_t k = 0; status == CELD_OK && k < celd_composition_count (composition); k++)
    status = celd_composition_paint (composition, k, NULL, view);
  if (status == CELD_OK)
    memcpy (r->pixels->vectors, view, sizeof r->pixels->vectors);
  else
    r->problems.n = 0;
  celd_composition_free (composition);
  celd_layers_free (layers);
  return status;
}

const Step motion_steps[] = {
  { "register", register_step, NULL, true },
  { "propagate", propagate_step, NULL, true },
  { "blend of two keys", blend_step, NULL, true },
  { "labels that came back", returned_step, NULL, false },
  { "ratings of blended labels", rate_blended_step, NULL, false },
  { "labels of two keys", join_step, &seed_palette, false },
  { "notes of regions", notes_step, NULL, false },
  { "lattice", lattice_step, NULL, true },
  { "lattice of levels", levels_lattice_step, NULL, true },
  { "compose", compose_step, NULL, true },
  { "handles between keys", handle_keys_step, NULL, false },
  { "deform", deform_step, NULL, true },
  { "deform levels", deform_levels_step, NULL, true },
  { "layers of a pose", posed_layers_step, NULL, true },
  { "inbetween", inbetween_step, NULL, true },
  { NULL, NULL, NULL, false },
};
