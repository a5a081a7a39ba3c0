/* Failing allocations and cancelling in the steps from a drawing to regions: ink, contours, scribbles, relations,
 * arrows, segmentation.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "faults.h"
#include "image/image.h"
#include "segment/basins.h"
#include "segment/task.h"

#include <stdlib.h>

static CeldStatus
ink_step (const CeldHost *host, Results *r)
{
  CeldDrawing drawing = drawing_of (&drawing_pixels);
  CeldPlane   ink = plane_of (r->pixels);

  return celd_ink (&drawing, CELD_INK_AUTO, host, &ink);
}

/* Two lines in grain, with a dark grey band between them, from top to bottom. */
static CeldStatus
noisy_ink_step (const CeldHost *host, Results *r)
{
  static Pixels page;
  CeldDrawing   drawing = drawing_of (&page);
  CeldPlane     ink = plane_of (r->pixels);

  for (int i = 0; i < W * H; i++)
    {
      int   from_band = abs (i % W - W / 2);
      float value = from_band == 0 ? 0.4f : from_band <= 3 ? 0 : 0.95f;

      page.plane[i] = value + 0.0004f * (float) (i * i % 101);
      page.alpha[i] = 1;
    }
  return celd_ink (&drawing, CELD_INK_AUTO, host, &ink);
}

static CeldStatus
sprite_lines_step (const CeldHost *host, Results *r)
{
  CeldPaint   art = paint_of (&lossy_pixels);
  CeldDrawing drawing = drawing_of (r->pixels);

  return celd_coloured_lines (&art, CELD_INK_LINES, host, &drawing);
}

/* The same with grain in 40 shades, so that it is no sprite and is smoothed first. */
static CeldStatus
coloured_lines_step (const CeldHost *host, Results *r)
{
  Pixels      grainy = lossy_pixels;
  CeldPaint   art = paint_of (&grainy);
  CeldDrawing drawing = drawing_of (r->pixels);

  for (int y = 0; y < art.height; y++)
    for (int x = 0; x < art.width; x++)
      CELD_RGBA (&art, x, y)[1] = (uint8_t) (CELD_RGBA (&art, x, y)[1] - (29 * x + 17 * y) % 40);
  return celd_coloured_lines (&art, CELD_INK_LINES, host, &drawing);
}

/* Without clear lines all closings are tried. */
static CeldStatus
clarity_step (const CeldHost *host, Results *r)
{
  enum { SIDE = 64 };
  static float luma[SIDE * SIDE];
  CeldDrawing     drawing = { .luma = { SIDE, SIDE, SIDE, luma } };
  CeldLineClarity clarity;

  (void) r;
  for (int i = 0; i < SIDE * SIDE; i++)
    luma[i] = (float) (i * i % 97) / 97;
  return celd_line_clarity (&drawing, host, &clarity);
}

/* Four rooms in a coloured drawing, and strokes. */
static CeldStatus
mix_up_step (const CeldHost *host, Results *r)
{
  enum { SIDE = 64 };
  static uint8_t drawn[4 * SIDE * SIDE], strokes[4 * SIDE * SIDE];
  CeldPaint      drawing = { SIDE, SIDE, SIDE, drawn }, scribbles = { SIDE, SIDE, SIDE, strokes };
  CeldMixUp      mix_up;
  bool           may_be;
  CeldStatus     status;

  (void) host;
  (void) r;
  for (int i = 0; i < 4 * SIDE * SIDE; i++)
    {
      int x = i / 4 % SIDE, y = i / 4 / SIDE;

      drawn[i] = i % 4 == 3 ? 255 : x % 32 == 16 || y % 32 == 16 ? 0 : i % 4 ? 220 : 120;
      strokes[i] = i % 4 == 3 || (i % 4 == 0 && y % 16 < 6) ? 255 : 0;
    }
  status = celd_may_be_drawing (&drawing, &may_be);
  return status == CELD_OK ? celd_mix_up (&scribbles, &drawing, &mix_up) : status;
}

/* The lines of four rooms in a layer, in levels, a copy of the layer, and it as strokes. */
static CeldStatus
lines_step (const CeldHost *host, Results *r)
{
  enum { SIDE = 64 };
  static uint8_t drawn[4 * SIDE * SIDE];
  static float   levels[SIDE * SIDE];
  CeldPaint      layer = { SIDE, SIDE, SIDE, drawn };
  CeldPlane      plane = { SIDE, SIDE, SIDE, levels };
  CeldLayerLines lines;
  bool           found;
  CeldStatus     status;

  (void) host;
  (void) r;
  for (int i = 0; i < SIDE * SIDE; i++)
    {
      levels[i] = i % SIDE % 32 == 16 || i / SIDE % 32 == 16 ? 0 : 1;
      for (int k = 0; k < 4; k++)
        drawn[4 * i + k] = k == 3 || levels[i] > 0 ? 255 : 0;
    }
  status = celd_layer_lines (&layer, &plane, &lines);
  if (status == CELD_OK)
    status = celd_levels_have_lines (&plane, &plane, &found);
  if (status == CELD_OK)
    status = celd_levels_are_exchanged (&plane, &plane, &found);
  if (status == CELD_OK)
    status = celd_levels_are_drawing (&plane, &found);
  if (status == CELD_OK)
    status = celd_is_copy (&layer, &layer, &found);
  return status == CELD_OK ? celd_is_flattened (&layer, &layer, &found) : status;
}

static CeldStatus
contours_step (const CeldHost *host, Results *r)
{
  CeldDrawing drawing = drawing_of (&drawing_pixels), baked = drawing_of (r->pixels);
  CeldPaint   contours = paint_of (&contour_pixels);

  return celd_contours_bake (&drawing, &contours, CELD_FOR_DEPTH, CELD_INK_AUTO, host, &baked);
}

static CeldStatus
scribbles_step (const CeldHost *host, Results *r)
{
  CeldPaint  scribbles = paint_of (&scribble_pixels);
  CeldLabels seeds = labels_of (r->pixels);

  return celd_scribbles_read (&scribbles, &scene_settings, host, &seeds, &r->palette);
}

static CeldStatus
lossy_step (const CeldHost *host, Results *r)
{
  CeldPaint  scribbles = paint_of (&lossy_pixels);
  CeldLabels seeds = labels_of (r->pixels);

  return celd_scribbles_read (&scribbles, &scene_settings, host, &seeds, &r->palette);
}

/* The same strokes, faint ones. */
static CeldStatus
faint_step (const CeldHost *host, Results *r)
{
  Pixels     faint = scribble_pixels;
  CeldPaint  scribbles = paint_of (&faint);
  CeldLabels seeds = labels_of (r->pixels);

  for (int y = 0; y < scribbles.height; y++)
    for (int x = 0; x < scribbles.width; x++)
      CELD_RGBA (&scribbles, x, y)[3] /= 3;
  return celd_scribbles_read (&scribbles, &scene_settings, host, &seeds, &r->palette);
}

static CeldStatus
relations_step (const CeldHost *host, Results *r)
{
  (void) host;
  return celd_relations_parse ("14,30 > 40,35 @2; #2040e0 > #e02020; 1,1 < 14,30; #e02020 = 14,14 !anchor\n"
                               "3,3 < 4,30 < 40,30; 5,5 = 6,6; 7,7 = 8,8; 9,9 = 10,10", &r->relations, NULL);
}

static CeldStatus
path_step (const CeldHost *host, Results *r)
{
  (void) host;
  return celd_arrow_path_parse ("M14,30 40,35 M1 1h13v29m3 3q9-9 1 27z l5 5M5 5 6 6M7 7 8 8M9 9 10 10M1 1 2 2M3 3 4 4",
                                &r->relations, NULL);
}

static CeldStatus
arrows_step (const CeldHost *host, Results *r)
{
  CeldPaint arrows = paint_of (&arrow_pixels);

  return celd_arrows_read (&arrows, CELD_ARROW_HEAD, host, &r->relations, &r->problems);
}

static CeldStatus
are_arrows_step (const CeldHost *host, Results *r)
{
  CeldPaint arrows = paint_of (&arrow_pixels);
  bool      are;

  (void) r;
  return celd_are_arrows (&arrows, host, &are);
}

static CeldStatus
crossing_step (const CeldHost *host, Results *r)
{
  CeldPaint arrows = paint_of (&crossing_pixels);

  return celd_arrows_read (&arrows, CELD_ARROW_HEAD, host, &r->relations, &r->problems);
}

static CeldStatus
coloured_step (const CeldHost *host, Results *r)
{
  CeldPaint arrows = paint_of (&colour_pixels);

  return celd_arrows_read (&arrows, CELD_ARROW_HEAD, host, &r->relations, &r->problems);
}

/* Three of one colour that begin in one place, of which the one to the upper left does not fade. */
static CeldStatus
joined_step (const CeldHost *host, Results *r)
{
  static Pixels page;
  CeldPaint     arrows = paint_of (&page);

  for (int y = 0; y < H; y++)
    for (int x = 0; x < W; x++)
      {
        bool across = y > 22 && y < 26 && x >= 32 && x < 60, down = x > 30 && x < 34 && y > 22 && y < 46;
        bool bare = x > 10 && x < 32 && y < 24 && abs (x - 32 - (y - 24)) < 2;
        int  alpha = across ? 255 - 8 * (x - 32) : down ? 255 - 10 * (y - 23) : bare ? 255 : 0;

        CELD_RGBA (&arrows, x, y)[3] = (uint8_t) alpha;
      }
  return celd_arrows_read (&arrows, CELD_ARROW_FADE, host, &r->relations, &r->problems);
}

static CeldStatus
segment_step (const CeldHost *host, Results *r)
{
  CeldPlane  ink = plane_of (&ink_pixels);
  CeldLabels seeds = labels_of (&seed_pixels), labels = labels_of (r->pixels);

  return celd_segment (&ink, &seeds, &scene_relations, &scene_settings, host, &labels, &r->palette, &r->problems);
}

/* The same paint as a flat colouring. */
static CeldStatus
flats_step (const CeldHost *host, Results *r)
{
  CeldPlane    ink = plane_of (&ink_pixels);
  CeldLabels   seeds = labels_of (&seed_pixels), labels = labels_of (r->pixels);
  CeldSettings flats = scene_settings;

  flats.flats = true;
  return celd_segment (&ink, &seeds, &scene_relations, &flats, host, &labels, &r->palette, &r->problems);
}

static CeldStatus
walker_step (const CeldHost *host, Results *r)
{
  CeldPlane    ink = plane_of (&ink_pixels);
  CeldLabels   seeds = labels_of (&seed_pixels), labels = labels_of (r->pixels);
  CeldSettings walker = scene_settings;

  walker.method = CELD_METHOD_WALKER;
  return celd_segment (&ink, &seeds, &scene_relations, &walker, host, &labels, &r->palette, &r->problems);
}

/* An empty page of one label, with two hard bars of another close to each other: a window that is so large that it is
 * first cut in blocks, and then refined between the bars. */
static CeldStatus
windows_step (const CeldHost *host, Results *r)
{
  static float    page[4 * W * H];
  CeldPlane       ink = { 2 * W, 2 * H, 2 * W, page };
  CeldSettings    hard = scene_settings;
  CeldBasins      basins = { 0 };
  CeldSegmentTask task = { .settings = &hard, .ink = &ink, .basins = &basins };
  CeldPatches     patches = { 0 };
  uint32_t        label[2];
  CeldStatus      status;

  (void) r;
  hard.hardness = 1;
  for (int p = 0; p < 4 * W * H; p++)
    page[p] = 1;
  status = celd_basins_new (&ink, scene_settings.ink_threshold, NULL, &basins);
  if (status == CELD_OK)
    status = celd_seed_rows_new (2 * W, 2 * H, &task.seeds);
  for (int y = 30; y < 70 && status == CELD_OK; y++)
    {
      status = celd_seed_rows_paint (&task.seeds, y, 40, 48, 2);
      if (status == CELD_OK)
        status = celd_seed_rows_paint (&task.seeds, y, 54, 62, 2);
    }
  for (int k = 0; k < 2 && status == CELD_OK; k++)
    status = celd_task_add_label (&task, (CeldRegion) { .colour = { 0, 0, 0, 255 } }, &label[k]);
  if (status == CELD_OK && basins.n == 1)
    status = celd_windows_solve (&task, label, host, &patches);
  if (status == CELD_OK && !patches.n)
    status = CELD_BAD_VALUE; /* nothing to do: the test would say nothing */
  celd_basins_clear (&basins);
  celd_seed_rows_clear (&task.seeds);
  celd_palette_clear (&task.palette);
  celd_patches_clear (&patches);
  return status;
}

/* A strip of single pixels between two lines, with paint in one of them. */
static CeldStatus
pinches_step (const CeldHost *host, Results *r)
{
  static float    page[H * H];
  static uint32_t label[H * H];
  CeldPlane       ink = { H, H, H, page };
  CeldBasins      basins = { 0 };
  CeldSegmentTask task = { .settings = &scene_settings, .ink = &ink, .basins = &basins };
  uint32_t        added;
  CeldStatus      status;

  (void) r;
  for (int y = 0; y < H; y++)
    for (int x = 0; x < H; x++)
      CELD_AT (&ink, x, y) = abs (x - y) != 1;
  status = celd_basins_new (&ink, scene_settings.ink_threshold, NULL, &basins);
  if (status == CELD_OK)
    status = celd_seed_rows_new (H, H, &task.seeds);
  if (status == CELD_OK)
    status = celd_seed_rows_paint (&task.seeds, 0, 2, H, 1);
  if (status == CELD_OK)
    status = celd_seed_rows_paint (&task.seeds, 4, 4, 5, 2);
  for (int k = 0; k < 2 && status == CELD_OK; k++)
    status = celd_task_add_label (&task, (CeldRegion) { .colour = { 0, 0, 0, 255 } }, &added);
  if (status == CELD_OK)
    {
      celd_task_set_soft_cost (&task);
      status = celd_basin_graph_solve (&task, host, label);
    }
  if (status == CELD_OK && label[celd_basin_at (&basins, H - 4, H - 4)] != 2)
    status = CELD_BAD_VALUE; /* there is no pinch: the test would say nothing */
  celd_basins_clear (&basins);
  celd_seed_rows_clear (&task.seeds);
  celd_palette_clear (&task.palette);
  return status;
}

/* A line with a gap, between basins above it and below. */
static CeldStatus
closures_step (const CeldHost *host, Results *r)
{
  static float    page[4 * W * H];
  static uint32_t painted[4 * W * H];
  CeldPlane       ink = { 2 * W, 2 * H, 2 * W, page };
  CeldLabels      labels = { 2 * W, 2 * H, 2 * W, painted };
  CeldBasins      basins = { 0 };
  CeldSegmentTask task = { .settings = &scene_settings, .ink = &ink, .basins = &basins };
  CeldPatches     windows = { 0 }, patches = { 0 };
  CeldClosures    closures = { 0 };
  uint32_t        label[64] = { 0 };
  CeldStatus      status;

  (void) r;
  for (int y = 0; y < 2 * H; y++)
    for (int x = 0; x < 2 * W; x++)
      {
        int line = H + x / 4 - W / 4;

        CELD_AT (&ink, x, y) = y < line || y > line + 3 || (x > W - 9 && x < W + 9);
      }
  status = celd_basins_new (&ink, scene_settings.ink_threshold, NULL, &basins);
  if (status == CELD_OK)
    status = celd_seed_rows_new (2 * W, 2 * H, &task.seeds);
  if (status == CELD_OK && basins.n > 64)
    status = CELD_BAD_VALUE;
  for (size_t k = 0; k < basins.n && status == CELD_OK; k++)
    label[k] = basins.basin[k].y < H ? 1 : 2;
  for (int p = 0; p < 4 * W * H && status == CELD_OK; p++)
    painted[p] = label[celd_basin_at (&basins, p % (2 * W), p / (2 * W))];
  if (status == CELD_OK)
    status = celd_closures_find (&task, label, &labels, &windows, host, &closures, &patches);
  if (status == CELD_OK && (!closures.n || !patches.n))
    status = CELD_BAD_VALUE; /* nothing to do: the test would say nothing */
  celd_basins_clear (&basins);
  celd_seed_rows_clear (&task.seeds);
  celd_patches_clear (&patches);
  celd_closures_clear (&closures);
  return status;
}

/* A wall of cells is broken in one place: most of the basins are kept. */
static CeldStatus
basins_step (const CeldHost *host, Results *r)
{
  static float page[16 * W * H];
  CeldPlane    ink = { 4 * W, 4 * H, 4 * W, page };
  CeldBasins   basins = { 0 };
  CeldRect     changed = { 58, 70, 6, 4 };
  CeldHostPart parts[2];
  CeldHost     building = celd_host_part (&parts[0], host, 0, 0.9), renewing = celd_host_part (&parts[1], host, 0.9, 1);
  CeldStatus   status;

  (void) r;
  for (int y = 0; y < 4 * H; y++)
    for (int x = 0; x < 4 * W; x++)
      CELD_AT (&ink, x, y) = x % 20 > 2 && y % 20 > 2;
  status = celd_basins_new (&ink, scene_settings.ink_threshold, &building, &basins);
  for (int y = 70; y < 74; y++)
    for (int x = 58; x < 64; x++)
      CELD_AT (&ink, x, y) = 1;
  if (status == CELD_OK)
    status = celd_basins_update (&ink, &changed, &renewing, &basins);
  celd_basins_clear (&basins);
  return status;
}

static CeldStatus
separate_step (const CeldHost *host, Results *r)
{
  CeldLabels labels = labels_of (r->pixels);

  return celd_separate (host, &labels, &r->palette);
}

static CeldStatus
labels_step (const CeldHost *host, Results *r)
{
  CeldPaint  scribbles = paint_of (&scribble_pixels);
  CeldLabels labels = labels_of (r->pixels);

  (void) host;
  return celd_labels_read (&scribbles, &labels, &r->palette);
}

static CeldStatus
background_step (const CeldHost *host, Results *r)
{
  CeldPlane  ink = plane_of (&ink_pixels);
  CeldLabels labels = labels_of (&label_pixels);

  (void) host;
  return celd_background_mark (&labels, &ink, &scene_settings, &r->palette);
}

const Step region_steps[] = {
  { "ink", ink_step, NULL, true },
  { "noisy ink", noisy_ink_step, NULL, true },
  { "coloured lines", coloured_lines_step, NULL, true },
  { "lines of a sprite", sprite_lines_step, NULL, true },
  { "clarity of lines", clarity_step, NULL, true },
  { "mixed-up layers", mix_up_step, NULL, false },
  { "lines in a layer", lines_step, NULL, false },
  { "contours", contours_step, NULL, true },
  { "scribbles", scribbles_step, NULL, true },
  { "lossy scribbles", lossy_step, NULL, true },
  { "faint scribbles", faint_step, NULL, true },
  { "relations", relations_step, NULL, false },
  { "arrow-path", path_step, NULL, false },
  { "arrows", arrows_step, NULL, true },
  { "layer of arrows", are_arrows_step, NULL, true },
  { "crossing arrows", crossing_step, NULL, true },
  { "arrows of two colours", coloured_step, NULL, true },
  { "arrows that share an end", joined_step, NULL, true },
  { "basins", basins_step, NULL, true },
  { "segment", segment_step, &seed_palette, true },
  { "flats", flats_step, &seed_palette, true },
  { "walker", walker_step, &seed_palette, true },
  { "windows", windows_step, NULL, true },
  { "pinches", pinches_step, NULL, true },
  { "closures", closures_step, NULL, true },
  { "separate", separate_step, &label_palette, true },
  { "labels", labels_step, NULL, false },
  { "background", background_step, &label_palette, false },
  { NULL, NULL, NULL, false },
};
