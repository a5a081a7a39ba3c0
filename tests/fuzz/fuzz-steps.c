/* The steps called directly with values that nobody expects: infinite, not a number, huge, tiny.  They answer, and
 * what is finite stays so.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "fuzz.h"
#include "sheets/sheets.h"

#define MOST_SIDE 24
#define PIXELS    (MOST_SIDE * MOST_SIDE)
#define LABELS    5

typedef struct
{
  int          width, height;
  float        ink[PIXELS], levels[PIXELS], depth[PIXELS], made[PIXELS], art[4 * PIXELS], view[4 * PIXELS];
  float        normals[3 * PIXELS];
  uint8_t      paint[4 * PIXELS], anchors[PIXELS];
  uint32_t     labels[PIXELS], owner[PIXELS], under[PIXELS];
  CeldSettings settings;
} Page;

static CeldPlane
plane (const Page *page, float *data)
{
  return (CeldPlane) { page->width, page->height, (size_t) page->width, data };
}

static CeldLabels
labels (const Page *page, uint32_t *data)
{
  return (CeldLabels) { page->width, page->height, (size_t) page->width, data };
}

static bool
are_finite (const float *values, size_t n)
{
  for (size_t i = 0; i < n; i++)
    if (!isfinite (values[i]))
      return false;
  return true;
}

/* A status that is no answer to good pictures of one size. */
static void
check_status (CeldStatus status)
{
  FUZZ_CHECK (status == CELD_OK || status == CELD_BAD_VALUE || status == CELD_NOTHING_TO_GO_BY);
}

/* ------------------------------------------------------------------ input */

static void
fill_boxes (FuzzInput *input, const Page *page, float *values, float rest)
{
  for (int p = 0; p < page->width * page->height; p++)
    values[p] = rest;
  for (int boxes = fuzz_below (input, 5); boxes > 0; boxes--)
    {
      int   x0 = fuzz_below (input, page->width), y0 = fuzz_below (input, page->height);
      int   x1 = x0 + fuzz_below (input, 16), y1 = y0 + fuzz_below (input, 16);
      float value = fuzz_odd (input);

      for (int y = y0; y <= y1 && y < page->height; y++)
        for (int x = x0; x <= x1 && x < page->width; x++)
          values[y * page->width + x] = value;
    }
}

static void
make_settings (FuzzInput *input, CeldSettings *s)
{
  float *const numbers[] = {
    &s->ink_threshold, &s->hardness, &s->near_level, &s->far_level, &s->tolerance, &s->contrast, &s->weight_floor,
    &s->bulge, &s->relief_bulge, &s->bevel, &s->creases, &s->light_azimuth, &s->light_elevation, &s->light_x, &s->light_y,
    &s->light_height, &s->ambient, &s->specular, &s->shininess, &s->rim_light, &s->rim_power, &s->shadow_size,
    &s->shadow_strength, &s->shadow_offset, &s->shadow_range, &s->disparity, &s->convergence, &s->relief_depth,
    &s->mesh_size, &s->mesh_plate, &s->mesh_error, &s->margin,
  };

  *s = celd_settings ();
  s->method        = (CeldMethod) fuzz_below (input, 3);
  s->encoding      = (CeldEncoding) fuzz_below (input, 3);
  s->expansion     = (CeldExpansion) fuzz_below (input, 2);
  s->anchors       = (CeldAnchors) fuzz_below (input, 4);
  s->hold_rest     = fuzz_below (input, 2);
  s->hold_gaps     = fuzz_below (input, 2);
  s->enhance       = (CeldEnhance) fuzz_below (input, 3);
  s->light_model   = (CeldLightModel) fuzz_below (input, 4);
  s->light         = (CeldLight) fuzz_below (input, 2);
  s->relief_from   = (CeldReliefFrom) fuzz_below (input, 2);
  s->mesh_kind        = (CeldMeshKind) fuzz_below (input, 4);
  s->stereo        = (CeldStereo) fuzz_below (input, 13);
  s->same_colour   = (CeldSameColour) fuzz_below (input, 2);
  s->on_cycle      = (CeldOnCycle) fuzz_below (input, 3);
  s->suggest       = (CeldSuggest) fuzz_below (input, 3);
  s->frame_outline = fuzz_below (input, 2);
  for (int changes = fuzz_below (input, 4); changes > 0; changes--)
    *numbers[fuzz_below (input, 32)] = fuzz_odd (input);
}

static void
make_page (FuzzInput *input, Page *page)
{
  page->width  = 1 + fuzz_below (input, MOST_SIDE);
  page->height = 1 + fuzz_below (input, MOST_SIDE);
  make_settings (input, &page->settings);
  fill_boxes (input, page, page->ink, 1);
  fill_boxes (input, page, page->levels, 0);
  fill_boxes (input, page, page->depth, 0);
  for (int p = 0; p < page->width * page->height; p++)
    {
      page->labels[p] = 1 + (uint32_t) (page->levels[p] > 0) + 2 * (uint32_t) (page->depth[p] > 0);
      page->anchors[p] = p % 11 == 0;
      for (int k = 0; k < 4; k++)
        page->art[4 * p + k] = (float) ((p + k) % 5) / 4;
    }
  for (int odd = fuzz_below (input, 6); odd > 0; odd--)
    page->art[fuzz_below (input, 4 * page->width * page->height)] = fuzz_odd (input);
}

static void
make_relations (FuzzInput *input, CeldRelations *relations, CeldRelation *item)
{
  *relations = (CeldRelations) { item, (size_t) fuzz_below (input, 8) };
  for (size_t i = 0; i < relations->n; i++)
    {
      item[i] = (CeldRelation) { .weight = 1, .gap = 1, .source = CELD_SOURCE_TEXT, .line = 1, .column = 1 };
      item[i].equal = fuzz_below (input, 5) == 0;
      item[i].nearer = (CeldTerm) { .x = fuzz_below (input, 30) - 2, .y = fuzz_below (input, 30) - 2 };
      item[i].farther = (CeldTerm) { .x = fuzz_below (input, 30) - 2, .y = fuzz_below (input, 30) - 2 };
      if (fuzz_below (input, 3) == 0)
        item[i].nearer.x = (double) fuzz_odd (input);
      if (fuzz_below (input, 4) == 0)
        item[i].weight = fmax (fabs ((double) fuzz_odd (input)), 1e-9);
      if (fuzz_below (input, 4) == 0)
        item[i].gap = fmax (fabs ((double) fuzz_odd (input)), 1e-9);
      if (!isfinite (item[i].weight) || !isfinite (item[i].gap))
        item[i].weight = item[i].gap = 1e6;
    }
}

/* ------------------------------------------------------------------ steps */

static void
try_regions (FuzzInput *input, Page *page)
{
  CeldPlane     ink = plane (page, page->ink), hint = plane (page, page->depth), made = plane (page, page->made);
  CeldDrawing   drawing = { ink, { 0, 0, 0, NULL } };
  CeldLabels    seeds = labels (page, page->labels), owner = labels (page, page->owner);
  CeldRegion    regions[LABELS - 1];
  CeldPalette   palette = { regions, 4 };
  CeldRelation  item[8];
  CeldRelations relations, suggested = { 0 };
  CeldOrder     order = { 0 };
  CeldProblems  problems = { 0 };
  CeldExact     exact = { 0 };
  CeldStatus    status;

  for (uint32_t k = 0; k < 4; k++)
    regions[k] = (CeldRegion) { .colour = { (uint8_t) (k * 60), 9, 9, 255 }, .seeds = 1, .area = 1 };
  make_relations (input, &relations, item);
  check_status (celd_ink (&drawing, (CeldInkMode) fuzz_below (input, 4), NULL, &made));
  FUZZ_CHECK (are_finite (page->made, (size_t) (page->width * page->height)));
  check_status (celd_order (&seeds, &palette, &relations, &ink, &page->settings, NULL, &order, &problems));
  check_status (celd_suggest (&seeds, &palette, &ink, &hint, NULL, &suggested));
  for (size_t i = 0; i < suggested.n; i++)
    FUZZ_CHECK (suggested.item[i].weight > 0 && suggested.item[i].weight < 1);
  status = celd_depth_exact (&ink, &seeds, &palette, &relations, &page->settings, NULL, &made, &exact, &problems);
  check_status (status);
  FUZZ_CHECK (status != CELD_OK || are_finite (page->made, (size_t) (page->width * page->height)));
  check_status (celd_expand_levels (&ink, NULL, &hint, &seeds, NULL, page->settings.expansion, NULL, &made));
  check_status (celd_expand (&ink, &seeds, NULL, &owner));
  celd_relations_clear (&suggested);
  celd_order_clear (&order);
  celd_problems_clear (&problems);
  celd_exact_clear (&exact);
}

static void
try_light (Page *page)
{
  size_t      n = (size_t) (page->width * page->height);
  CeldPlane   ink = plane (page, page->ink), levels = plane (page, page->levels), made = plane (page, page->made);
  CeldMask    anchors = { page->width, page->height, (size_t) page->width, page->anchors };
  CeldVectors normals = { page->width, page->height, (size_t) page->width, page->normals };
  CeldStatus  status;

  check_status (celd_smooth (&ink, NULL, &levels, &anchors, &page->settings, NULL, &made, NULL));
  status = celd_normals (&ink, &levels, &page->settings, NULL, &normals);
  check_status (status);
  FUZZ_CHECK (status != CELD_OK || are_finite (page->normals, 3 * n));
  if (status == CELD_OK)
    {
      status = celd_shade (&normals, &page->settings, &made);
      check_status (status);
      FUZZ_CHECK (status != CELD_OK || are_finite (page->made, n));
    }
  status = celd_enhance (&levels, &page->settings, NULL, &made);
  check_status (status);
  FUZZ_CHECK (status != CELD_OK || are_finite (page->made, n));
  check_status (celd_occlusion (&levels, &page->settings, NULL, &made));
}

static void
check_mesh (const CeldReliefMesh *mesh)
{
  FUZZ_CHECK (are_finite (mesh->place, 3 * mesh->vertices) && are_finite (mesh->normal, 3 * mesh->vertices) &&
              are_finite (mesh->art, 2 * mesh->vertices));
  for (size_t i = 0; i < 3 * mesh->triangles; i++)
    FUZZ_CHECK (mesh->corner[i] < mesh->vertices);
}

/* What is made of finite depth is finite. */
static void
try_relief (Page *page)
{
  size_t         n = (size_t) (page->width * page->height);
  CeldPlane      ink = plane (page, page->ink), levels = plane (page, page->levels), depth = plane (page, page->depth);
  CeldRelief     relief = { 0 };
  CeldReliefMesh mesh = { 0 };
  CeldStatus     status = celd_relief (&ink, NULL, &levels, &depth, &page->settings, NULL, &relief);

  check_status (status);
  if (status == CELD_OK && are_finite (page->levels, n) && are_finite (page->depth, n))
    {
      FUZZ_CHECK (are_finite (relief.z, n) && are_finite (relief.outline, n));
      status = celd_relief_mesh (&relief, &page->settings, NULL, &mesh);
      check_status (status);
      if (status == CELD_OK)
        check_mesh (&mesh);
    }
  celd_relief_mesh_clear (&mesh);
  celd_relief_clear (&relief);
}

/* Hidden pixels lie in the picture, under later sheets. */
static void
check_sheets (const CeldSheets *sheets, const CeldOwnership *own)
{
  for (size_t k = 0; k < sheets->n; k++)
    for (size_t i = 0; i < sheets->item[k].n_runs; i++)
      {
        const CeldSheetRun *run = &sheets->item[k].run[i];

        FUZZ_CHECK (run->n > 0 && run->x >= 0 && run->x + run->n <= sheets->width && run->y < sheets->height);
        for (int x = run->x; x < run->x + run->n; x++)
          {
            bool mixed = CELD_AT (&own->coverage, x, run->y) < 1;

            FUZZ_CHECK (sheets->of_label[CELD_AT (&own->owner, x, run->y) - 1] > k);
            FUZZ_CHECK (!mixed || sheets->of_label[CELD_AT (&own->under, x, run->y) - 1] > k);
          }
      }
}

/* By relations, and cut into layers. */
static void
try_sheets (FuzzInput *input, Page *page)
{
  CeldPlane     ink = plane (page, page->ink);
  CeldOwnership own = { labels (page, page->labels), labels (page, page->under), plane (page, page->depth) };
  CeldColours   art = { page->width, page->height, (size_t) page->width, page->art };
  CeldRegion    regions[LABELS - 1];
  CeldPalette   palette = { regions, 4 };
  CeldRelation  item[8];
  CeldRelations relations;
  CeldOrder     order = { 0 };
  CeldSheets   *sheets = NULL;
  CeldLayers   *layers = NULL;
  CeldStatus    status;

  for (uint32_t k = 0; k < 4; k++)
    regions[k] = (CeldRegion) { .colour = { (uint8_t) (k * 60), 9, 9, 255 }, .seeds = 1, .area = 1 };
  make_relations (input, &relations, item);
  for (int p = 0; p < page->width * page->height; p++)
    page->under[p] = page->labels[p < 3 ? 0 : p - 3];
  status = celd_order (&own.owner, &palette, &relations, &ink, &page->settings, NULL, &order, NULL);
  check_status (status);
  if (status == CELD_OK)
    {
      status = celd_sheets (&ink, &own, NULL, &order, (uint32_t) fuzz_below (input, LABELS), &page->settings, NULL,
                            &sheets);
      check_status (status);
    }
  if (status == CELD_OK)
    {
      check_sheets (sheets, &own);
      check_status (celd_layers_cut (&ink, &own, order.level, order.n, &art, sheets, CELD_STORE_8_BIT, NULL, &layers));
    }
  celd_layers_free (layers);
  celd_sheets_free (sheets);
  celd_order_clear (&order);
}

static void
try_model (Page *page)
{
  CeldPlane   ink = plane (page, page->ink), levels = plane (page, page->levels);
  CeldColours art = { page->width, page->height, (size_t) page->width, page->art };
  CeldModel   model = { 0 };

  check_status (celd_model_of_levels (&ink, NULL, &levels, NULL, &art, &page->settings, NULL, &model));
  for (size_t k = 0; k < model.n; k++)
    check_mesh (&model.part[k].mesh);
  celd_model_clear (&model);
}

static void
try_views (Page *page)
{
  CeldPlane   ink = plane (page, page->ink), levels = plane (page, page->levels), depth = plane (page, page->depth);
  CeldColours art = { page->width, page->height, (size_t) page->width, page->art };
  CeldColours view = { page->width, page->height, (size_t) page->width, page->view };
  CeldScene  *scene = NULL;
  CeldComfort comfort;
  CeldStatus  status = celd_scene_of_depth (&art, &ink, &depth, &page->settings, NULL, &scene);

  check_status (status);
  if (status == CELD_OK)
    check_status (celd_scene_view (scene, celd_camera_eye (1), &page->settings, NULL, &view));
  celd_scene_free (scene);
  scene = NULL;
  status = celd_scene_of_levels (&ink, &levels, &depth, &art, &page->settings, NULL, &scene);
  check_status (status);
  if (status == CELD_OK)
    check_status (celd_scene_view (scene, celd_camera_on_path (page->settings.path, 1, 7), &page->settings, NULL,
                                   &view));
  celd_scene_free (scene);
  check_status (celd_stereo_comfort (&depth, &page->settings, &comfort));
}

int
LLVMFuzzerTestOneInput (const uint8_t *data, size_t size)
{
  static Page page;
  FuzzInput   input = { data, data + size };

  make_page (&input, &page);
  switch (fuzz_below (&input, 6))
    {
    case 0: try_regions (&input, &page); break;
    case 1: try_light (&page); break;
    case 2: try_relief (&page); break;
    case 3: try_views (&page); break;
    case 4: try_model (&page); break;
    case 5: try_sheets (&input, &page); break;
    }
  return 0;
}
