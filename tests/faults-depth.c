/* Failing allocations and cancelling in the steps from regions to depth: order, suggestions, cycles, expansion, contour
 * ownership, smooth depth, exact depth.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "faults.h"
#include "depth/depth.h"
#include "image/image.h"
#include "order/order.h"
#include "ownership/ownership.h"

static CeldStatus
order_step (const CeldHost *host, Results *r)
{
  CeldPlane  ink = plane_of (&ink_pixels);
  CeldLabels labels = labels_of (&label_pixels);

  return celd_order (&labels, &label_palette, &scene_relations, &ink, &scene_settings, host, &r->order, &r->problems);
}

/* A component of three labels and one of twenty, which is too large to be solved exactly. */
static CeldStatus
cycles_step (const CeldHost *host, Results *r)
{
  enum { SMALL = 3, N = 23 };
  uint32_t      pixel[N];
  CeldRegion    region[N] = { 0 };
  CeldRelation  item[2 * N] = { 0 };
  CeldSettings  weakest = scene_settings;
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
  return celd_order (&labels, &palette, &circles, NULL, &weakest, host, &r->order, &r->problems);
}

/* Suggestions from the lines and from a depth picture, painted, and the order that they and scene_relations make. */
static CeldStatus
suggest_step (const CeldHost *host, Results *r)
{
  CeldLabels    labels = labels_of (&label_pixels);
  CeldPlane     ink = plane_of (&ink_pixels), depth = plane_of (&drawing_pixels);
  CeldPaint     paint = paint_of (r->pixels);
  CeldRelations suggested = { 0 }, both = { 0 };
  CeldSettings  gaps = scene_settings;
  CeldOrder     order = { 0 };
  CeldHostPart  parts[2];
  CeldHost      first = celd_host_part (&parts[0], host, 0, 0.6), second = celd_host_part (&parts[1], host, 0.6, 1);
  CeldStatus    status = celd_suggest (&labels, &label_palette, &ink, &depth, &first, &suggested);

  gaps.suggest = CELD_SUGGEST_FILL_GAPS;
  if (status == CELD_OK && !suggested.n)
    status = CELD_BAD_VALUE; /* nothing to do: the test would say nothing */
  if (status == CELD_OK)
    status = celd_order_suggested (&labels, &label_palette, &scene_relations, &suggested, &ink, &gaps, &second, &both,
                                   &order, NULL);
  if (status == CELD_OK)
    status = celd_relations_paint (&suggested, 2, &paint);
  if (status == CELD_OK)
    {
      r->relations = both;
      r->order     = order;
    }
  else
    {
      celd_relations_clear (&both);
      celd_order_clear (&order);
    }
  celd_relations_clear (&suggested);
  return status;
}

/* Two sheets, each in front of the other: one of them is split. */
static CeldStatus
split_step (const CeldHost *host, Results *r)
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
    status = celd_cycles_split (&circle, &ink, &scene_settings, host, &labels, &r->palette, &splits);
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
expand_step (const CeldHost *host, Results *r)
{
  CeldPlane  ink = plane_of (&ink_pixels);
  CeldLabels ranks = labels_of (&label_pixels), expanded = labels_of (r->pixels);

  return celd_expand (&ink, &ranks, host, &expanded);
}

static CeldStatus
expand_levels_step (const CeldHost *host, Results *r)
{
  CeldPlane ink = plane_of (&ink_pixels), levels = plane_of (&level_pixels), expanded = plane_of (r->pixels);

  return celd_expand_levels (&ink, NULL, &levels, NULL, NULL, CELD_EXPANSION_OUTLINES, host, &expanded);
}

static CeldStatus
matte_step (const CeldHost *host, Results *r)
{
  static float level[W * H];
  CeldPlane    ink = plane_of (&ink_pixels), levels = plane_of (&level_pixels), share = plane_of (r->pixels);
  CeldLabels   regions = labels_of (&label_pixels);

  return celd_matte_of_levels (&ink, NULL, &levels, &regions, &regions, CELD_EXPANSION_OUTLINES, host,
                               &(CeldPlane) { W, H, W, level }, NULL, &share);
}

static CeldStatus
own_step (const CeldHost *host, Results *r)
{
  CeldPlane      ink = plane_of (&ink_pixels);
  CeldLabels     labels = labels_of (&label_pixels), owner = labels_of (r->pixels);
  CeldOwnership  own = { 0 };
  const uint32_t level[8] = { 0, 1, 2, 3, 4, 5, 6, 7 };
  CeldStatus     status = celd_ownership_new (W, H, &own);

  if (status == CELD_OK)
    status = celd_own (&ink, NULL, &labels, level, 8, NULL, CELD_EXPANSION_OUTLINES, host, &own);
  for (int p = 0; status == CELD_OK && p < W * H; p++)
    owner.data[p] = own.owner.data[p];
  celd_ownership_clear (&own);
  return status;
}

/* Two boxes behind the page, whose outlines are darker shades of them. */
static CeldStatus
shades_step (const CeldHost *host, Results *r)
{
  enum { SIDE = 64 };
  static const uint8_t fill[][3] = { { 240, 240, 245 }, { 220, 90, 80 }, { 90, 110, 220 } };
  static float         ink_of[SIDE * SIDE];
  static uint32_t      label_of[SIDE * SIDE];
  static uint8_t       colour_of[4 * SIDE * SIDE];
  CeldPlane            ink = { SIDE, SIDE, SIDE, ink_of };
  CeldLabels           labels = { SIDE, SIDE, SIDE, label_of };
  CeldPaint            colours = { SIDE, SIDE, SIDE, colour_of };
  CeldOwnership        own = { 0 };
  const uint32_t       level[] = { 2, 1, 0 };
  CeldStatus           status = celd_ownership_new (SIDE, SIDE, &own);

  (void) r;
  for (int i = 0; i < SIDE * SIDE; i++)
    {
      int  x = i % SIDE, y = i / SIDE, in = x % 32;
      bool box = in >= 4 && in < 28 && y >= 6 && y < 58, core = in >= 8 && in < 24 && y >= 10 && y < 54;

      ink_of[i]   = box && !core ? 0.f : 1.f;
      label_of[i] = box ? 2 + (uint32_t) x / 32 : 1;
      for (int c = 0; c < 3; c++)
        colour_of[4 * i + c] = (uint8_t) (fill[label_of[i] - 1][c] * (box && !core ? 2 : 5) / 5);
      colour_of[4 * i + 3] = 255;
    }
  if (status == CELD_OK)
    status = celd_own (&ink, &colours, &labels, level, 3, NULL, CELD_EXPANSION_OUTLINES, host, &own);
  if (status == CELD_OK && (CELD_AT (&own.owner, 5, 30) != 2 || CELD_AT (&own.owner, 58, 30) != 3))
    status = CELD_BAD_VALUE; /* the test would say nothing: by levels the page owns both */
  celd_ownership_clear (&own);
  return status;
}

/* Made from scratch, and updated after an edit of everything. */
static CeldStatus
owners_step (const CeldHost *host, Results *r)
{
  CeldHostPart       part[2];
  CeldHost           first = celd_host_part (&part[0], host, 0, 0.5), second = celd_host_part (&part[1], host, 0.5, 1);
  CeldPlane          ink = plane_of (&ink_pixels);
  CeldLabels         labels = labels_of (&label_pixels), all = { 0 };
  uint32_t           level[8] = { 0, 1, 2, 3, 4, 5, 6, 7 };
  CeldOwnershipInput input = { .ink = &ink, .labels = &labels, .level = level, .n = 8 };
  CeldOwnershipCache kept = { 0 };
  CeldOwnership      own = { 0 };
  CeldRect           changed;
  CeldStatus         status = celd_ownership_new (W, H, &own);

  if (status == CELD_OK)
    status = celd_ownership_cache_make (&input, &first, &kept, &own);
  if (status == CELD_OK)
    status = celd_labels_new (W, H, &all);
  for (int p = 0; status == CELD_OK && p < W * H; p++)
    all.data[p] = 1 + labels.data[p] % 3;
  level[0] = 9;
  input.labels = input.corrections = &all;
  if (status == CELD_OK)
    status = celd_ownership_cache_update (&input, (CeldRect) { 0, 0, W, H }, &second, &kept, &own, &changed);
  if (status == CELD_OK)
    memcpy (r->pixels->labels, own.owner.data, W * H * sizeof (uint32_t));
  celd_free (all.data);
  celd_ownership_cache_clear (&kept);
  celd_ownership_clear (&own);
  return status;
}

static CeldStatus
smooth_step (const CeldHost *host, Results *r)
{
  CeldPlane ink = plane_of (&ink_pixels), levels = plane_of (&level_pixels), depth = plane_of (r->pixels);

  return celd_smooth (&ink, NULL, &levels, NULL, &scene_settings, host, &depth, NULL);
}

/* The relations of the scene, and one between points off every scribble. */
static CeldStatus
exact_depth_step (const CeldHost *host, Results *r)
{
  CeldPlane     ink = plane_of (&ink_pixels), depth = plane_of (r->pixels);
  CeldLabels    seeds = labels_of (&seed_pixels);
  CeldRelations all = { 0 };
  CeldSettings  apart = scene_settings;
  CeldStatus    status = celd_relations_parse ("10,30 > 50,35; 4,4 = 60,40", &all, NULL);

  apart.same_colour = CELD_SAME_COLOUR_SEPARATE;
  for (size_t i = 0; i < scene_relations.n && status == CELD_OK; i++)
    status = celd_relation_add (&all, scene_relations.item[i]);
  if (status == CELD_OK)
    status = celd_depth_exact (&ink, &seeds, &seed_palette, &all, &apart, host, &depth, NULL, &r->problems);
  celd_relations_clear (&all);
  return status;
}

/* A program that is kept, with one more point, and then one more scribble. */
static CeldStatus
program_step (const CeldHost *host, Results *r)
{
  CeldPlane     ink = plane_of (&ink_pixels), depth = plane_of (r->pixels);
  CeldLabels    seeds = labels_of (&seed_pixels);
  CeldRelations one = { 0 };
  CeldProgram  *program = celd_program_new ();
  CeldExact     exact = { 0 };
  CeldStatus    status = program ? celd_relations_parse ("10,30 > 50,35", &one, NULL) : CELD_NO_MEMORY;
  CeldPlane     scratch = { W, H, W, celd_alloc (W * H, sizeof (float)) };
  CeldHostPart  part[2];
  CeldHost      first = celd_host_part (&part[0], host, 0, 0.5), second = celd_host_part (&part[1], host, 0.5, 1);

  if (status == CELD_OK)
    status = scratch.data ? celd_program_set_ink (program, &ink, &scene_settings, NULL) : CELD_NO_MEMORY;
  if (status == CELD_OK)
    status = celd_program_set_seeds (program, &seeds, &seed_palette, CELD_SAME_COLOUR_ONE, NULL);
  if (status == CELD_OK)
    status = celd_program_solve (program, &scene_relations, &scene_settings, &first, &scratch, &exact, NULL);
  if (status == CELD_OK)
    status = celd_program_solve (program, &one, &scene_settings, &second, &depth, &exact, NULL);
  celd_relations_clear (&one);
  celd_exact_clear (&exact);
  celd_program_free (program);
  celd_free (scratch.data);
  return status;
}

const Step depth_steps[] = {
  { "order", order_step, NULL, true },
  { "suggest", suggest_step, NULL, true },
  { "strong-components", cycles_step, NULL, true },
  { "split-cycles", split_step, NULL, true },
  { "expand", expand_step, NULL, true },
  { "expand levels", expand_levels_step, NULL, true },
  { "matte", matte_step, NULL, true },
  { "ownership", own_step, NULL, true },
  { "ownership by colours", shades_step, NULL, true },
  { "ownership kept", owners_step, NULL, true },
  { "smooth", smooth_step, NULL, true },
  { "exact depth", exact_depth_step, NULL, true },
  { "program", program_step, NULL, true },
  { NULL, NULL, NULL, false },
};
