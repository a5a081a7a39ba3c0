/* The steps that faults.c tries, on a small scene that gives each of them something to do.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "faults.h"
#include "order.h"
#include "ownership.h"
#include "partition.h"
#include "program.h"
#include "segment.h"

/* ------------------------------------------------------------------ the scene */

Pixels drawing_pixels, scribble_pixels, arrow_pixels, contour_pixels, label_pixels, lossy_pixels, crossing_pixels;
Pixels colour_pixels;

static Pixels        ink_pixels, seed_pixels, level_pixels, expanded_pixels, normal_pixels;
static CeldPalette   seed_palette, label_palette;
static CeldRelations relations;
static CeldSettings  settings;

static void
fill_box (Pixels *p, int left, int top, int right, int bottom, float luma, uint32_t rgba)
{
  for (int y = top; y < bottom; y++)
    for (int x = left; x < right; x++)
      {
        p->plane[y * W + x] = luma;
        for (int c = 0; c < 4; c++)
          p->paint[4 * (y * W + x) + c] = (uint8_t) (rgba >> (24 - 8 * c));
      }
}

/* Two overlapping sheets with outlines; a stroke in each and behind them; an arrow; a virtual contour of each kind;
 * arrows that cross in one colour, and in two; a pale, uneven stroke in a tinted block of white paper, as loss leaves
 * it. */
static void
draw_scene (void)
{
  Pixels *d = &drawing_pixels, *s = &scribble_pixels, *a = &arrow_pixels, *c = &contour_pixels;
  Pixels *l = &lossy_pixels;

  for (int p = 0; p < W * H; p++)
    d->plane[p] = d->alpha[p] = 1;
  fill_box (d, 6, 6, 34, 36, 0, 0);
  fill_box (d, 9, 9, 31, 33, 1, 0);
  fill_box (d, 24, 16, 58, 42, 0, 0);
  fill_box (d, 27, 19, 55, 39, 1, 0);
  fill_box (d, 40, 24, 41, 30, 0, 0);
  fill_box (s, 12, 12, 20, 16, 0, 0xe02020ff);
  fill_box (s, 32, 22, 50, 26, 0, 0x2040e0ff);
  fill_box (s, 2, 1, 60, 4, 0, 0x20c040ff);
  fill_box (a, 14, 24, 36, 26, 0, 0x202020ff);
  for (int k = 0; k < 6; k++)
    fill_box (a, 36 - k, 24 - k, 37 - k, 26 + k, 0, 0x202020ff);
  fill_box (&crossing_pixels, 4, 20, 50, 22, 0, 0x202020ff);
  fill_box (&crossing_pixels, 20, 4, 22, 40, 0, 0x202020ff);
  for (int k = 0; k < 6; k++)
    {
      fill_box (&crossing_pixels, 52 - k, 20 - k, 53 - k, 22 + k, 0, 0x202020ff);
      fill_box (&crossing_pixels, 20 - k, 42 - k, 22 + k, 43 - k, 0, 0x202020ff);
    }
  fill_box (&colour_pixels, 4, 12, 56, 16, 0, 0x202020ff); /* this one begins where a bar ends */
  fill_box (&colour_pixels, 2, 6, 6, 26, 0, 0xe02020ff);
  fill_box (&colour_pixels, 28, 0, 31, 38, 0, 0xe08020ff);
  for (int k = 0; k < 8; k++)
    {
      fill_box (&colour_pixels, 60 - k, 14 - k, 61 - k, 14 + k, 0, 0x202020ff);
      fill_box (&colour_pixels, 29 - k, 41 - k, 30 + k, 42 - k, 0, 0xe08020ff);
    }
  fill_box (l, 0, 0, W, H, 0, 0xffffffff);
  fill_box (l, 0, 16, 32, 32, 0, 0xfff0f0ff);
  fill_box (l, 2, 20, 30, 24, 0, 0xd07080ff);
  for (int x = 4; x < 30; x += 4)
    fill_box (l, x, 20, x + 2, 24, 0, 0xe08090ff);
  fill_box (c, 20, 28, 23, 33, 0, 0xff0000ff);
  fill_box (c, 44, 33, 48, 36, 0, 0x0000ffff);
  fill_box (c, 40, 24, 42, 30, 0, 0x00ff00ff);
}

/* ------------------------------------------------------------------ the steps */

static CeldStatus
ink_step (const CeldRun *run, Results *r)
{
  CeldDrawing drawing = drawing_of (&drawing_pixels);
  CeldPlane   ink = plane_of (r->pixels);

  return celd_ink (&drawing, CELD_INK_AUTO, run, &ink);
}

static CeldStatus
contours_step (const CeldRun *run, Results *r)
{
  CeldDrawing drawing = drawing_of (&drawing_pixels), baked = drawing_of (r->pixels);
  CeldPaint   contours = paint_of (&contour_pixels);

  return celd_contours_bake (&drawing, &contours, CELD_FOR_DEPTH, CELD_INK_AUTO, run, &baked);
}

static CeldStatus
scribbles_step (const CeldRun *run, Results *r)
{
  CeldPaint  scribbles = paint_of (&scribble_pixels);
  CeldLabels seeds = labels_of (r->pixels);

  return celd_scribbles_read (&scribbles, &settings, run, &seeds, &r->palette);
}

static CeldStatus
lossy_step (const CeldRun *run, Results *r)
{
  CeldPaint  scribbles = paint_of (&lossy_pixels);
  CeldLabels seeds = labels_of (r->pixels);

  return celd_scribbles_read (&scribbles, &settings, run, &seeds, &r->palette);
}

static CeldStatus
relations_step (const CeldRun *run, Results *r)
{
  (void) run;
  return celd_relations_parse ("14,30 > 40,35 @2; #2040e0 > #e02020; 1,1 < 14,30; #e02020 = 14,14 !anchor\n"
                               "3,3 < 4,30 < 40,30; 5,5 = 6,6; 7,7 = 8,8; 9,9 = 10,10", &r->relations, NULL);
}

static CeldStatus
path_step (const CeldRun *run, Results *r)
{
  (void) run;
  return celd_arrow_path_parse ("M14,30 40,35 M1 1h13v29m3 3q9-9 1 27z l5 5M5 5 6 6M7 7 8 8M9 9 10 10M1 1 2 2M3 3 4 4",
                                &r->relations, NULL);
}

static CeldStatus
arrows_step (const CeldRun *run, Results *r)
{
  CeldPaint arrows = paint_of (&arrow_pixels);

  return celd_arrows_read (&arrows, CELD_ARROW_HEAD, run, &r->relations, &r->problems);
}

static CeldStatus
crossing_step (const CeldRun *run, Results *r)
{
  CeldPaint arrows = paint_of (&crossing_pixels);

  return celd_arrows_read (&arrows, CELD_ARROW_HEAD, run, &r->relations, &r->problems);
}

static CeldStatus
coloured_step (const CeldRun *run, Results *r)
{
  CeldPaint arrows = paint_of (&colour_pixels);

  return celd_arrows_read (&arrows, CELD_ARROW_HEAD, run, &r->relations, &r->problems);
}

static CeldStatus
segment_step (const CeldRun *run, Results *r)
{
  CeldPlane  ink = plane_of (&ink_pixels);
  CeldLabels seeds = labels_of (&seed_pixels), labels = labels_of (r->pixels);

  return celd_segment (&ink, &seeds, &relations, &settings, run, &labels, &r->palette, &r->problems);
}

/* The same paint as a flat colouring. */
static CeldStatus
flats_step (const CeldRun *run, Results *r)
{
  CeldPlane    ink = plane_of (&ink_pixels);
  CeldLabels   seeds = labels_of (&seed_pixels), labels = labels_of (r->pixels);
  CeldSettings flats = settings;

  flats.flats = true;
  return celd_segment (&ink, &seeds, &relations, &flats, run, &labels, &r->palette, &r->problems);
}

static CeldStatus
walker_step (const CeldRun *run, Results *r)
{
  CeldPlane    ink = plane_of (&ink_pixels);
  CeldLabels   seeds = labels_of (&seed_pixels), labels = labels_of (r->pixels);
  CeldSettings walker = settings;

  walker.method = CELD_METHOD_WALKER;
  return celd_segment (&ink, &seeds, &relations, &walker, run, &labels, &r->palette, &r->problems);
}

/* An empty page of one label, and two hard bars of another close to each other: the window is large enough to be cut in
 * blocks first, and the border between the bars is looked at again. */
static CeldStatus
windows_step (const CeldRun *run, Results *r)
{
  static float   page[4 * W * H];
  CeldPlane      ink = { 2 * W, 2 * H, 2 * W, page };
  CeldSettings   hard = settings;
  CeldBasins     basins = { 0 };
  CeldCanvas     canvas = { .settings = &hard, .ink = &ink, .basins = &basins };
  CeldPatches    patches = { 0 };
  uint32_t       label[2];
  CeldStatus     status;

  (void) r;
  hard.hardness = 1;
  for (int p = 0; p < 4 * W * H; p++)
    page[p] = 1;
  status = celd_basins_new (&ink, settings.ink_threshold, NULL, &basins);
  if (status == CELD_OK)
    status = celd_seed_rows_new (2 * W, 2 * H, &canvas.seeds);
  for (int y = 30; y < 70 && status == CELD_OK; y++)
    {
      status = celd_seed_rows_paint (&canvas.seeds, y, 40, 48, 2);
      if (status == CELD_OK)
        status = celd_seed_rows_paint (&canvas.seeds, y, 54, 62, 2);
    }
  for (int k = 0; k < 2 && status == CELD_OK; k++)
    status = celd_canvas_add (&canvas, (CeldRegion) { .colour = { 0, 0, 0, 255 } }, &label[k]);
  if (status == CELD_OK && basins.n == 1)
    status = celd_windows_solve (&canvas, label, run, &patches);
  if (status == CELD_OK && !patches.n)
    status = CELD_BAD_VALUE; /* nothing to do: the test would say nothing */
  celd_basins_clear (&basins);
  celd_seed_rows_clear (&canvas.seeds);
  celd_palette_clear (&canvas.palette);
  celd_patches_clear (&patches);
  return status;
}

/* A line with a gap, between basins above it and below. */
static CeldStatus
closures_step (const CeldRun *run, Results *r)
{
  static float    page[4 * W * H];
  static uint32_t painted[4 * W * H];
  CeldPlane       ink = { 2 * W, 2 * H, 2 * W, page };
  CeldLabels      labels = { 2 * W, 2 * H, 2 * W, painted };
  CeldBasins      basins = { 0 };
  CeldCanvas      canvas = { .settings = &settings, .ink = &ink, .basins = &basins };
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
  status = celd_basins_new (&ink, settings.ink_threshold, NULL, &basins);
  if (status == CELD_OK)
    status = celd_seed_rows_new (2 * W, 2 * H, &canvas.seeds);
  if (status == CELD_OK && basins.n > 64)
    status = CELD_BAD_VALUE;
  for (size_t k = 0; k < basins.n && status == CELD_OK; k++)
    label[k] = basins.basin[k].y < H ? 1 : 2;
  for (int p = 0; p < 4 * W * H && status == CELD_OK; p++)
    painted[p] = label[celd_basin_at (&basins, p % (2 * W), p / (2 * W))];
  if (status == CELD_OK)
    status = celd_closures_find (&canvas, label, &labels, &windows, run, &closures, &patches);
  if (status == CELD_OK && (!closures.n || !patches.n))
    status = CELD_BAD_VALUE; /* nothing to do: the test would say nothing */
  celd_basins_clear (&basins);
  celd_seed_rows_clear (&canvas.seeds);
  celd_patches_clear (&patches);
  celd_closures_clear (&closures);
  return status;
}

/* A wall of cells is broken in one place: most of the basins are kept. */
static CeldStatus
basins_step (const CeldRun *run, Results *r)
{
  static float page[16 * W * H];
  CeldPlane    ink = { 4 * W, 4 * H, 4 * W, page };
  CeldBasins   basins = { 0 };
  CeldRect     changed = { 58, 70, 6, 4 };
  CeldPart     parts[2];
  CeldRun      building = celd_run_part (&parts[0], run, 0, 0.9), renewing = celd_run_part (&parts[1], run, 0.9, 1);
  CeldStatus   status;

  (void) r;
  for (int y = 0; y < 4 * H; y++)
    for (int x = 0; x < 4 * W; x++)
      CELD_AT (&ink, x, y) = x % 20 > 2 && y % 20 > 2;
  status = celd_basins_new (&ink, settings.ink_threshold, &building, &basins);
  for (int y = 70; y < 74; y++)
    for (int x = 58; x < 64; x++)
      CELD_AT (&ink, x, y) = 1;
  if (status == CELD_OK)
    status = celd_basins_renew (&ink, &changed, &renewing, &basins);
  celd_basins_clear (&basins);
  return status;
}

static CeldStatus
separate_step (const CeldRun *run, Results *r)
{
  CeldLabels labels = labels_of (r->pixels);

  return celd_separate (run, &labels, &r->palette);
}

static CeldStatus
labels_step (const CeldRun *run, Results *r)
{
  CeldPaint  scribbles = paint_of (&scribble_pixels);
  CeldLabels labels = labels_of (r->pixels);

  (void) run;
  return celd_labels_read (&scribbles, &labels, &r->palette);
}

static CeldStatus
background_step (const CeldRun *run, Results *r)
{
  CeldPlane  ink = plane_of (&ink_pixels);
  CeldLabels labels = labels_of (&label_pixels);

  (void) run;
  return celd_background_mark (&labels, &ink, &settings, &r->palette);
}

static CeldStatus
order_step (const CeldRun *run, Results *r)
{
  CeldPlane  ink = plane_of (&ink_pixels);
  CeldLabels labels = labels_of (&label_pixels);

  return celd_order (&labels, &label_palette, &relations, &ink, &settings, run, &r->order, &r->problems);
}

/* A knot of three labels and one of twenty, which is too large to be solved exactly. */
static CeldStatus
knots_step (const CeldRun *run, Results *r)
{
  enum { SMALL = 3, N = 23 };
  uint32_t      pixel[N];
  CeldRegion    region[N] = { 0 };
  CeldRelation  item[2 * N] = { 0 };
  CeldSettings  weakest = settings;
  CeldLabels    labels = { N, 1, N, pixel };
  CeldPalette   palette = { region, N };
  CeldRelations circles = { item, 2 * N };

  weakest.on_cycle = CELD_ON_CYCLE_DROP_WEAKEST;
  for (int k = 0; k < N; k++)
    {
      int first = k < SMALL ? 0 : SMALL, n = k < SMALL ? SMALL : N - SMALL;

      pixel[k] = (uint32_t) k + 1;
      for (int i = 0; i < 2; i++)
        {
          item[2 * k + i] = (CeldRelation) { .weight = 1 + k % 3, .gap = 1, .equal = i && k == SMALL };
          item[2 * k + i].nearer.x  = k;
          item[2 * k + i].farther.x = first + (k - first + 1 + 7 * i) % n;
        }
    }
  return celd_order (&labels, &palette, &circles, NULL, &weakest, run, &r->order, &r->problems);
}

/* From the lines and from a picture of depth, and beside the relations; some of it painted. */
static CeldStatus
suggest_step (const CeldRun *run, Results *r)
{
  CeldLabels    labels = labels_of (&label_pixels);
  CeldPlane     ink = plane_of (&ink_pixels), depth = plane_of (&drawing_pixels);
  CeldPaint     paint = paint_of (r->pixels);
  CeldRelations suggested = { 0 }, both = { 0 };
  CeldSettings  gaps = settings;
  CeldPart      parts[3];
  CeldRun       first = celd_run_part (&parts[0], run, 0, 0.4), second = celd_run_part (&parts[1], run, 0.4, 0.8);
  CeldRun       third = celd_run_part (&parts[2], run, 0.8, 1);
  CeldStatus    status = celd_suggest (&labels, &label_palette, &ink, &first, &suggested);

  gaps.suggest = CELD_SUGGEST_FILL_GAPS;
  if (status == CELD_OK && !suggested.n)
    status = CELD_BAD_VALUE; /* nothing to do: the test would say nothing */
  if (status == CELD_OK)
    status = celd_suggest_from_depth (&labels, &label_palette, &ink, &depth, &second, &suggested);
  if (status == CELD_OK)
    status = celd_suggestions_join (&labels, &label_palette, &relations, &suggested, &gaps, &ink, &third, &both);
  if (status == CELD_OK)
    status = celd_relations_paint (&suggested, 2, &paint);
  if (status == CELD_OK)
    r->relations = both;
  else
    celd_relations_clear (&both);
  celd_relations_clear (&suggested);
  return status;
}

/* The two sheets before each other: one of them is split. */
static CeldStatus
split_step (const CeldRun *run, Results *r)
{
  CeldPlane     ink = plane_of (&ink_pixels), bent = plane_of (r->pixels);
  CeldLabels    known = labels_of (&label_pixels), labels = { 0 };
  CeldRelations circle = { 0 };
  CeldSplits    splits = { 0 };
  CeldStatus    status = celd_relations_parse ("12,12 > 52,36; 28,36 > 12,30", &circle, NULL);

  if (status == CELD_OK)
    status = celd_palette_copy (&label_palette, &r->palette);
  if (status == CELD_OK)
    status = celd_labels_new (W, H, &labels);
  for (int y = 0; y < H && status == CELD_OK; y++)
    memcpy (&CELD_AT (&labels, 0, y), &CELD_AT (&known, 0, y), W * sizeof (uint32_t));
  if (status == CELD_OK)
    status = celd_cycles_split (&circle, &ink, &settings, run, &labels, &r->palette, &splits);
  if (status == CELD_OK && splits.n != 1)
    status = CELD_BAD_VALUE; /* the test would say nothing */
  if (status == CELD_OK)
    celd_splits_erase (&splits, &labels, 3, &bent);
  if (status != CELD_OK)
    celd_palette_clear (&r->palette);
  celd_relations_clear (&circle);
  celd_free (labels.data);
  celd_free (splits.item);
  return status;
}

static CeldStatus
expand_step (const CeldRun *run, Results *r)
{
  CeldPlane  ink = plane_of (&ink_pixels);
  CeldLabels ranks = labels_of (&label_pixels), expanded = labels_of (r->pixels);

  return celd_expand (&ink, &ranks, run, &expanded);
}

/* The label picture cut up, as if the left part of each shared pixel were the label's and the right part the next one's:
 * gaps, holes and lines to complete. */
static CeldStatus
layers_step (const CeldRun *run, Results *r)
{
  static uint32_t under[W * H];
  static float    share[W * H], art[4 * W * H];
  CeldPlane       ink = plane_of (&ink_pixels);
  CeldOwnership   own = { labels_of (&expanded_pixels), { W, H, W, under }, { W, H, W, share } };
  CeldColours     colours = { W, H, W, art };
  uint32_t        level[8] = { 1, 2, 0, 3, 4, 5, 6, 7 };
  CeldLayers     *layers = NULL;
  CeldStatus      status;

  for (int p = 0; p < W * H; p++)
    {
      under[p] = expanded_pixels.labels[(p + 1) % (W * H)];
      share[p] = under[p] == expanded_pixels.labels[p] ? 1 : 0.5f;
      for (int c = 0; c < 4; c++)
        art[4 * p + c] = c == 3 ? 1 : ink_pixels.plane[p] * (float) (p % W) / W;
    }
  status = celd_layers_cut (&ink, &own, level, label_palette.n, &colours, 3, CELD_STORE_8_BIT_SRGB, true, run, &layers);
  for (size_t k = 0; status == CELD_OK && k < celd_layers_count (layers); k++)
    r->pixels->labels[k] = (uint32_t) celd_layers_item (layers, k)->box.width;
  celd_layers_free (layers);
  return status;
}

static CeldStatus
layers_of_levels_step (const CeldRun *run, Results *r)
{
  static float art[4 * W * H];
  CeldPlane    ink = plane_of (&ink_pixels), levels = plane_of (&level_pixels);
  CeldLabels   regions = labels_of (&label_pixels);
  CeldColours  colours = { W, H, W, art };
  CeldLayers  *layers = NULL;
  CeldStatus   status = celd_layers_of_levels (&ink, &levels, &regions, &regions, &colours,
                                               CELD_EXPANSION_THICKNESS, CELD_STORE_FLOAT, false, run, &layers);

  if (status == CELD_OK)
    r->pixels->labels[0] = (uint32_t) celd_layers_count (layers);
  celd_layers_free (layers);
  return status;
}

static CeldStatus
expand_levels_step (const CeldRun *run, Results *r)
{
  CeldPlane ink = plane_of (&ink_pixels), levels = plane_of (&level_pixels), expanded = plane_of (r->pixels);

  return celd_expand_levels (&ink, &levels, NULL, NULL, CELD_EXPANSION_OUTLINES, run, &expanded);
}

static CeldStatus
matte_step (const CeldRun *run, Results *r)
{
  static float level[W * H];
  CeldPlane    ink = plane_of (&ink_pixels), levels = plane_of (&level_pixels), share = plane_of (r->pixels);
  CeldLabels   regions = labels_of (&label_pixels);

  return celd_matte_of_levels (&ink, &levels, &regions, &regions, CELD_EXPANSION_OUTLINES, run,
                               &(CeldPlane) { W, H, W, level }, NULL, &share);
}

static CeldStatus
own_step (const CeldRun *run, Results *r)
{
  CeldPlane      ink = plane_of (&ink_pixels);
  CeldLabels     labels = labels_of (&label_pixels), owner = labels_of (r->pixels);
  CeldOwnership  own = { 0 };
  const uint32_t level[8] = { 0, 1, 2, 3, 4, 5, 6, 7 };
  CeldStatus     status = celd_ownership_new (W, H, &own);

  if (status == CELD_OK)
    status = celd_own (&ink, &labels, level, 8, NULL, CELD_EXPANSION_OUTLINES, run, &own);
  for (int p = 0; status == CELD_OK && p < W * H; p++)
    owner.data[p] = own.owner.data[p];
  celd_ownership_clear (&own);
  return status;
}

/* From the beginning, and after an edit of everything at once. */
static CeldStatus
owners_step (const CeldRun *run, Results *r)
{
  CeldPart        part[2];
  CeldRun         first = celd_run_part (&part[0], run, 0, 0.5), second = celd_run_part (&part[1], run, 0.5, 1);
  CeldPlane       ink = plane_of (&ink_pixels);
  CeldLabels      labels = labels_of (&label_pixels), all = { 0 };
  uint32_t        level[8] = { 0, 1, 2, 3, 4, 5, 6, 7 };
  CeldOwnersInput input = { &ink, &labels, NULL, level, 8 };
  CeldOwnersKept  kept = { 0 };
  CeldOwnership   own = { 0 };
  CeldRect        changed;
  CeldStatus      status = celd_ownership_new (W, H, &own);

  if (status == CELD_OK)
    status = celd_owners_make (&input, &first, &kept, &own);
  if (status == CELD_OK)
    status = celd_labels_new (W, H, &all);
  for (int p = 0; status == CELD_OK && p < W * H; p++)
    all.data[p] = 1 + labels.data[p] % 3;
  level[0] = 9;
  input.labels = input.corrections = &all;
  if (status == CELD_OK)
    status = celd_owners_renew (&input, (CeldRect) { 0, 0, W, H }, &second, &kept, &own, &changed);
  if (status == CELD_OK)
    memcpy (r->pixels->labels, own.owner.data, W * H * sizeof (uint32_t));
  celd_free (all.data);
  celd_owners_clear (&kept);
  celd_ownership_clear (&own);
  return status;
}

static CeldStatus
smooth_step (const CeldRun *run, Results *r)
{
  CeldPlane ink = plane_of (&ink_pixels), levels = plane_of (&level_pixels), depth = plane_of (r->pixels);

  return celd_smooth (&ink, &levels, NULL, &settings, run, &depth, NULL);
}

/* The relations of the scene, and one between points off every scribble. */
static CeldStatus
exact_depth_step (const CeldRun *run, Results *r)
{
  CeldPlane     ink = plane_of (&ink_pixels), depth = plane_of (r->pixels);
  CeldLabels    seeds = labels_of (&seed_pixels);
  CeldRelations all = { 0 };
  CeldSettings  apart = settings;
  CeldStatus    status = celd_relations_parse ("10,30 > 50,35; 4,4 = 60,40", &all, NULL);

  apart.same_colour = CELD_SAME_COLOUR_SEPARATE;
  for (size_t i = 0; i < relations.n && status == CELD_OK; i++)
    status = celd_relation_add (&all, relations.item[i]);
  if (status == CELD_OK)
    status = celd_depth_exact (&ink, &seeds, &seed_palette, &all, &apart, run, &depth, NULL, &r->problems);
  celd_relations_clear (&all);
  return status;
}

/* A program that is kept: one more point, and a scribble more. */
static CeldStatus
program_step (const CeldRun *run, Results *r)
{
  CeldPlane     ink = plane_of (&ink_pixels), depth = plane_of (r->pixels);
  CeldLabels    seeds = labels_of (&seed_pixels);
  CeldRelations one = { 0 };
  CeldProgram  *program = celd_program_new ();
  CeldExact     exact = { 0 };
  CeldStatus    status = program ? celd_relations_parse ("10,30 > 50,35", &one, NULL) : CELD_NO_MEMORY;
  CeldPlane     scratch = { W, H, W, celd_alloc (W * H, sizeof (float)) };
  CeldPart      part[2];
  CeldRun       first = celd_run_part (&part[0], run, 0, 0.5), second = celd_run_part (&part[1], run, 0.5, 1);

  if (status == CELD_OK)
    status = scratch.data ? celd_program_set_ink (program, &ink, &settings, NULL) : CELD_NO_MEMORY;
  if (status == CELD_OK)
    status = celd_program_set_seeds (program, &seeds, &seed_palette, CELD_SAME_COLOUR_ONE, NULL);
  if (status == CELD_OK)
    status = celd_program_solve (program, &relations, &settings, &first, &scratch, &exact, NULL);
  if (status == CELD_OK)
    status = celd_program_solve (program, &one, &settings, &second, &depth, &exact, NULL);
  celd_relations_clear (&one);
  celd_exact_clear (&exact);
  celd_program_free (program);
  celd_free (scratch.data);
  return status;
}

static CeldStatus
normals_step (const CeldRun *run, Results *r)
{
  CeldPlane   ink = plane_of (&ink_pixels), levels = plane_of (&expanded_pixels);
  CeldVectors normals = vectors_of (r->pixels);

  return celd_normals (&ink, &levels, &settings, run, &normals);
}

/* With strokes that fold, a bevel, hints at a border, and the frame. */
static CeldStatus
hints_step (const CeldRun *run, Results *r)
{
  static uint8_t paint[4 * W * H];
  CeldPlane      ink = plane_of (&ink_pixels), levels = plane_of (&expanded_pixels);
  CeldVectors    normals = vectors_of (r->pixels);
  CeldPaint      hints = { W, H, W, paint };
  CeldSettings   all = settings;

  for (int i = 0; i < W * H; i++)
    paint[4 * i + 3] = i % W < W / 2 ? 255 : 0;
  all.quilt = 1;
  all.bevel = 0.1f;
  all.frame_outline = true;
  return celd_normals_hinted (&ink, &levels, &levels, &hints, &all, run, &normals);
}

static CeldStatus
occlusion_step (const CeldRun *run, Results *r)
{
  CeldPlane levels = plane_of (&expanded_pixels), occlusion = plane_of (r->pixels);

  return celd_occlusion (&levels, &settings, run, &occlusion);
}

static CeldStatus
padding_step (const CeldRun *run, Results *r)
{
  static const float blank[3] = { 0, 0, 0 };
  static float       data[4 * W * H];
  CeldColours        picture = { W, H, W, data };

  (void) r;
  for (int i = 0; i < W * H; i++)
    data[4 * i + 3] = i % 7 == 0;
  return celd_pad_colours (4, blank, run, &picture);
}

static CeldStatus
shade_step (const CeldRun *run, Results *r)
{
  CeldVectors normals = vectors_of (&normal_pixels);
  CeldPlane   shading = plane_of (r->pixels);

  (void) run;
  return celd_shade (&normals, &settings, &shading);
}

/* A sheet before paper, cut beforehand. */
static CeldStatus
stereo_step (const CeldRun *run, Results *r)
{
  static uint32_t owner[W * H];
  static float    art[4 * W * H], view[4 * W * H], whole[W * H];
  CeldPlane       ink = plane_of (&ink_pixels), depth = plane_of (&expanded_pixels);
  CeldOwnership   own = { { W, H, W, owner }, { W, H, W, owner }, { W, H, W, whole } };
  CeldColours     colours = { W, H, W, art }, to = { W, H, W, view };
  uint32_t        level[2] = { 0, 1 };
  CeldLayers     *layers = NULL;
  CeldScene      *scene = NULL;
  CeldPart        part[2];
  CeldRun         first = celd_run_part (&part[0], run, 0, 0.5), second = celd_run_part (&part[1], run, 0.5, 1);
  CeldStatus      status;

  for (int p = 0; p < W * H; p++)
    {
      owner[p] = p % W > 20 && p % W < 40 ? 2 : 1;
      whole[p] = art[4 * p] = art[4 * p + 1] = art[4 * p + 2] = art[4 * p + 3] = 1;
    }
  status = celd_layers_cut (&ink, &own, level, 2, &colours, 1, 0, false, NULL, &layers);
  if (status == CELD_OK)
    status = celd_scene_of_layers (layers, &own, &depth, &first, &scene);
  if (status == CELD_OK)
    status = celd_scene_view (scene, (CeldCamera) { 0.7, -0.3, 1 }, &settings, &second, &to);
  if (status == CELD_OK)
    memcpy (r->pixels->vectors, view, sizeof r->pixels->vectors);
  celd_scene_free (scene);
  celd_layers_free (layers);
  return status;
}

/* The same of levels. */
static CeldStatus
levels_scene_step (const CeldRun *run, Results *r)
{
  static float art[4 * W * H];
  CeldPlane    ink = plane_of (&ink_pixels), levels = plane_of (&expanded_pixels);
  CeldColours  colours = { W, H, W, art };
  CeldScene   *scene = NULL;
  CeldStatus   status;

  for (int i = 0; i < 4 * W * H; i++)
    art[i] = 1;
  status = celd_scene_of_levels (&ink, &levels, &levels, &colours, CELD_EXPANSION_OUTLINES, run, &scene);
  if (status == CELD_OK)
    r->pixels->vectors[0] = 1;
  celd_scene_free (scene);
  return status;
}

/* The same of depth alone. */
static CeldStatus
scene_step (const CeldRun *run, Results *r)
{
  static float art[4 * W * H], view[4 * W * H];
  CeldPlane    ink = plane_of (&ink_pixels), depth = plane_of (&expanded_pixels);
  CeldColours  colours = { W, H, W, art }, to = { W, H, W, view };
  CeldScene   *scene = NULL;
  CeldPart     part[2];
  CeldRun      first = celd_run_part (&part[0], run, 0, 0.5), second = celd_run_part (&part[1], run, 0.5, 1);
  CeldStatus   status;

  for (int i = 0; i < 4 * W * H; i++)
    art[i] = 1;
  status = celd_scene_of_depth (&colours, &ink, &depth, &settings, &first, &scene);
  if (status == CELD_OK)
    status = celd_scene_view (scene, celd_camera_eye (-1), &settings, &second, &to);
  if (status == CELD_OK)
    memcpy (r->pixels->vectors, view, sizeof r->pixels->vectors);
  celd_scene_free (scene);
  return status;
}

static CeldStatus
enhance_step (const CeldRun *run, Results *r)
{
  CeldPlane levels = plane_of (&expanded_pixels), change = plane_of (r->pixels);

  return celd_enhance (&levels, &settings, run, &change);
}

static CeldStatus
unsharp_step (const CeldRun *run, Results *r)
{
  CeldPlane    levels = plane_of (&expanded_pixels), change = plane_of (r->pixels);
  CeldSettings unsharp = settings;

  unsharp.enhance = CELD_ENHANCE_CONTRAST;
  return celd_enhance (&levels, &unsharp, run, &change);
}

/* All of a relief as its heights. */
static CeldStatus
make_relief (const CeldSettings *how, const CeldRun *run, Results *r)
{
  CeldPlane  ink = plane_of (&ink_pixels), levels = plane_of (&expanded_pixels);
  CeldRelief relief = { 0 };
  CeldStatus status = celd_relief (&ink, &levels, NULL, how, run, &relief);

  if (status == CELD_OK)
    memcpy (r->pixels->plane, relief.z, sizeof r->pixels->plane);
  celd_relief_clear (&relief);
  return status;
}

static CeldStatus
relief_step (const CeldRun *run, Results *r)
{
  return make_relief (&settings, run, r);
}

static CeldStatus
relief_of_normals_step (const CeldRun *run, Results *r)
{
  CeldSettings of_normals = settings;

  of_normals.relief_from = CELD_RELIEF_NORMALS;
  return make_relief (&of_normals, run, r);
}

/* A body of two levels, of which the pixels' own heights are the first. */
static CeldStatus
relief_mesh_step (const CeldRun *run, Results *r)
{
  static float   z[W * H];
  static uint8_t cut[W * H];
  CeldRelief     relief = { W, H, z, z, cut };
  CeldSettings   solid = settings;
  CeldReliefMesh mesh = { 0 };
  CeldStatus     status;

  solid.mesh = CELD_MESH_SOLID;
  for (int p = 0; p < W * H; p++)
    {
      z[p]   = p % W > 20 ? (float) (p / W) : 0;
      cut[p] = p % W == 20 ? CELD_CUT_RIGHT : 0;
    }
  status = celd_relief_mesh (&relief, &solid, run, &mesh);
  if (status == CELD_OK)
    for (int p = 0; p < W * H; p++)
      r->pixels->plane[p] = mesh.place[(size_t) p % (3 * mesh.vertices)];
  celd_relief_mesh_clear (&mesh);
  return status;
}

/* A grid of 8 x 6 nodes, of which four labels hold the corners and quarrel about the rest. */
static size_t
draw_graph (CeldLink *link, CeldVote *vote)
{
  size_t n_links = 0;

  for (uint32_t p = 0; p < 48; p++)
    {
      vote[p] = (CeldVote) { p, 1 + (p % 8 > 3) + 2 * (p > 23), 1 + p * 5 % 7 + 30 * (p % 7 == 0) };
      if (p % 5 == 0)
        vote[p].label = 1 + p % 4;
      if (p % 8 < 7)
        link[n_links++] = (CeldLink) { p, p + 1, 2 + p * 7 % 11 };
      if (p < 40)
        link[n_links++] = (CeldLink) { p, p + 8, 2 + p * 3 % 13 };
    }
  return n_links;
}

static CeldStatus
flow_step (const CeldRun *run, Results *r)
{
  CeldLink link[96];
  CeldVote vote[48];
  size_t   n_links = draw_graph (link, vote);
  int64_t  terminal[48];

  for (size_t p = 0; p < 48; p++)
    terminal[p] = vote[p].label == 1 ? vote[p].cost : -vote[p].cost;
  return celd_flow (48, link, n_links, terminal, run, r->pixels->paint, NULL);
}

static CeldStatus
partition_step (const CeldRun *run, Results *r)
{
  const uint32_t order[4] = { 3, 1, 4, 2 }, fixed[48] = { [20] = 2, [27] = 2 };
  CeldLink       link[96];
  CeldVote       vote[48];
  size_t         n_links = draw_graph (link, vote);
  CeldPartition  problem = { 48, link, n_links, vote, 48, fixed, order, 4 };

  return celd_partition (&problem, run, r->pixels->labels, NULL, NULL);
}

/* Two springs in a row, held apart by more than they like, and a loose node in front. */
static CeldStatus
quadratic_step (const CeldRun *run, Results *r)
{
  const double         k[16] = { 2, -2, 0, 0, -2, 3, -1, 0, 0, -1, 1, 0, 0, 0, 0, 0 };
  const CeldInequality one[3] = { { 0, 1, 1 }, { 1, 2, 1 }, { 3, 0, 1 } };
  double               u[4] = { 0 };
  CeldCertificate      certificate;
  CeldStatus           status = celd_quadratic (4, k, 3, one, u, NULL, false, &certificate);

  (void) run;
  for (int i = 0; status == CELD_OK && i < 4; i++)
    r->pixels->plane[i] = (float) u[i];
  return status;
}

const Step steps[] = {
  { "ink", ink_step, NULL, true },
  { "contours", contours_step, NULL, true },
  { "scribbles", scribbles_step, NULL, true },
  { "lossy scribbles", lossy_step, NULL, true },
  { "relations", relations_step, NULL, false },
  { "arrow-path", path_step, NULL, false },
  { "arrows", arrows_step, NULL, true },
  { "crossing arrows", crossing_step, NULL, true },
  { "arrows of two colours", coloured_step, NULL, true },
  { "basins", basins_step, NULL, true },
  { "segment", segment_step, &seed_palette, true },
  { "flats", flats_step, &seed_palette, true },
  { "walker", walker_step, &seed_palette, true },
  { "windows", windows_step, NULL, true },
  { "closures", closures_step, NULL, true },
  { "separate", separate_step, &label_palette, true },
  { "labels", labels_step, NULL, false },
  { "background", background_step, &label_palette, false },
  { "order", order_step, NULL, true },
  { "suggest", suggest_step, NULL, true },
  { "knots", knots_step, NULL, true },
  { "split-cycles", split_step, NULL, true },
  { "expand", expand_step, NULL, true },
  { "expand levels", expand_levels_step, NULL, true },
  { "matte", matte_step, NULL, true },
  { "ownership", own_step, NULL, true },
  { "ownership kept", owners_step, NULL, true },
  { "layers", layers_step, NULL, true },
  { "layers of levels", layers_of_levels_step, NULL, true },
  { "smooth", smooth_step, NULL, true },
  { "exact depth", exact_depth_step, NULL, true },
  { "program", program_step, NULL, true },
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
  { "flow", flow_step, NULL, true },
  { "partition", partition_step, NULL, true },
  { "quadratic", quadratic_step, NULL, false },
};

const size_t n_steps = sizeof steps / sizeof *steps;

/* ------------------------------------------------------------------ inputs of the later steps */

bool
make_inputs (void)
{
  Results ink = { .pixels = &ink_pixels }, seeds = { .pixels = &seed_pixels }, all = { .pixels = &label_pixels };
  Results expanded = { .pixels = &expanded_pixels }, normals = { .pixels = &normal_pixels };
  bool    good;

  settings = celd_settings ();
  draw_scene ();
  good = ink_step (NULL, &ink) == CELD_OK &&
         scribbles_step (NULL, &seeds) == CELD_OK && seeds.palette.n == 3 &&
         scribbles_step (NULL, &all) == CELD_OK &&
         arrows_step (NULL, &all) == CELD_OK && all.relations.n == 1 &&
         celd_relations_parse ("#e02020 < #2040e0; #e02020 > 1,1", &all.relations, NULL) == CELD_OK; /* a circle */
  seed_palette = seeds.palette;
  relations = all.relations;
  good = good && segment_step (NULL, &all) == CELD_OK && expand_step (NULL, &expanded) == CELD_OK;
  label_palette = all.palette;
  celd_problems_clear (&all.problems);
  for (int p = 0; p < W * H; p++)
    {
      level_pixels.plane[p] = (float) label_pixels.labels[p];
      expanded_pixels.plane[p] = (float) expanded_pixels.labels[p];
    }
  return good && normals_step (NULL, &normals) == CELD_OK;
}

void
free_inputs (void)
{
  celd_palette_clear (&seed_palette);
  celd_palette_clear (&label_palette);
  celd_relations_clear (&relations);
}
