/* depth-expand has the contour ownership, layers and corrections of core.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "core-page.h"

#include <locale.h>

/* Each layer over the one before, in linear light: the drawing again, complete or not. */
static void
layers_composite_to_the_drawing (void)
{
  static float  wanted[4 * PIXELS];
  static double sum[4 * PIXELS];
  GeglBuffer   *input = page_buffer ("Y float", "Y float", flat.data);
  GeglBuffer   *regions = page_buffer ("R'G'B'A u8", "R'G'B'A u8", colours.data);

  babl_process (babl_fish (babl_format ("Y' float"), babl_format ("RGBA float")), page_luma, wanted, PIXELS);
  for (int complete = 0; complete < 2; complete++)
    for (int parted = 0; parted < 2; parted++)
      {
        int filled = 0;

        memset (sum, 0, sizeof sum);
        for (int layer = 0; layer < 5; layer++)
          {
            operate ("celdepth:depth-expand", (Pads) { { input, drawing, parted ? regions : NULL } }, "RGBA float",
                     result, "result", 1, "layer", layer, "complete", complete, NULL);
            filled += result[0] > 0 || range (result, 4 * PIXELS) > 0;
            for (int i = 0; i < 4 * PIXELS; i++)
              {
                double alpha = (double) result[i / 4 * 4 + 3];

                sum[i] = (i % 4 < 3 ? alpha * (double) result[i] : alpha) + (1 - alpha) * sum[i];
              }
          }
        CHECK (filled == 3);
        for (int i = 0; i < 4 * PIXELS; i++)
          result[i] = (float) sum[i];
        SAME (wanted, 4);
      }
  g_object_unref (input);
  g_object_unref (regions);
}

/* The contour ownership of the page's labels, by core. */
static void
own_the_page (const CeldLabels *strokes, CeldOwnership *own)
{
  CeldOrder order = { 0 };

  own->owner = (CeldLabels) { WIDTH, HEIGHT, WIDTH, malloc (PIXELS * sizeof (uint32_t)) };
  own->under = (CeldLabels) { WIDTH, HEIGHT, WIDTH, malloc (PIXELS * sizeof (uint32_t)) };
  own->coverage = (CeldPlane) { WIDTH, HEIGHT, WIDTH, malloc (PIXELS * sizeof (float)) };
  CHECK (celd_order (&labels, &palette, &relations, &ink, NULL, NULL, &order, NULL) == CELD_OK);
  CHECK (celd_own (&ink, NULL, &labels, order.level, order.n, strokes, CELD_EXPANSION_OUTLINES, NULL, own) == CELD_OK);
  celd_order_clear (&order);
}

static void
drop_ownership (CeldOwnership *own)
{
  free (own->owner.data);
  free (own->under.data);
  free (own->coverage.data);
}

/* The owners' colours, as opaque as they cover the pixel. */
static const float *
matte_of (const CeldOwnership *own)
{
  static float matte[4 * PIXELS];
  CeldPaint    paint = { WIDTH, HEIGHT, WIDTH, malloc (4 * PIXELS) };

  CHECK (celd_labels_paint (&own->owner, &palette, &paint) == CELD_OK);
  babl_process (babl_fish (babl_format ("R'G'B'A u8"), babl_format ("RGBA float")), paint.data, matte, PIXELS);
  for (int i = 0; i < PIXELS; i++)
    matte[4 * i + 3] = own->coverage.data[i];
  free (paint.data);
  return matte;
}

/* By a table of each label's level on the page. */
static const float *
levels_of (const CeldOwnership *own, bool of_owner)
{
  static float owned[PIXELS], level[4];

  for (int i = 0; i < PIXELS; i++)
    level[labels.data[i]] = flat.data[i];
  for (int i = 0; i < PIXELS; i++)
    owned[i] = level[(of_owner || own->coverage.data[i] >= 0.5f ? own->owner : own->under).data[i]];
  return owned;
}

/* Owner and alpha: in colours, or without regions the levels as greys, which part the page no less. */
static void
the_matte_has_owner_and_coverage (void)
{
  GeglBuffer   *input = page_buffer ("Y float", "Y float", flat.data);
  GeglBuffer   *regions = page_buffer ("R'G'B'A u8", "R'G'B'A u8", colours.data);
  CeldOwnership own;
  int           soft = 0;
  const float  *level;

  own_the_page (NULL, &own);
  operate ("celdepth:depth-expand", (Pads) { { input, drawing, regions } }, "RGBA float", result, "result", 2, NULL);
  SAME (matte_of (&own), 4);
  operate ("celdepth:depth-expand", (Pads) { { input, drawing } }, "RGBA float", result, "result", 2, NULL);
  level = levels_of (&own, true);
  for (int i = 0; i < PIXELS; i++)
    {
      result[4 * i] -= level[i];
      result[4 * i + 1] -= level[i];
      result[4 * i + 2] -= level[i];
      result[4 * i + 3] -= own.coverage.data[i];
      soft += own.coverage.data[i] < 1;
    }
  NEAR (range (result, 4 * PIXELS), 0, 1e-5);
  CHECK (soft > 100); /* the outlines are antialiased */
  drop_ownership (&own);
  g_object_unref (input);
  g_object_unref (regions);
}

/* A stroke in the background's colour over the outline of the left disc. */
static void
corrections_give_ink_to_their_region (void)
{
  static uint8_t  stroke[4 * PIXELS];
  static uint32_t given[PIXELS];
  CeldLabels      strokes = { WIDTH, HEIGHT, WIDTH, given };
  GeglBuffer     *input = page_buffer ("Y float", "Y float", flat.data), *corrections;
  GeglBuffer     *regions = page_buffer ("R'G'B'A u8", "R'G'B'A u8", colours.data);
  CeldOwnership   before, after;
  Pads            pads;

  paint_line (stroke, 20, 38, 20, 42, 2, 0x0000ff);
  for (int i = 0; i < PIXELS; i++)
    given[i] = stroke[4 * i + 3] ? labels.data[0] : 0;
  own_the_page (NULL, &before);
  own_the_page (&strokes, &after);
  CHECK (before.owner.data[40 * WIDTH + 21] == labels.data[40 * WIDTH + 45]);
  CHECK (after.owner.data[40 * WIDTH + 21] == labels.data[0]);
  corrections = page_buffer ("R'G'B'A u8", "R'G'B'A u8", stroke);
  pads = (Pads) { { input, drawing, regions, corrections } };
  operate ("celdepth:depth-expand", pads, "RGBA float", result, "result", 2, NULL);
  SAME (matte_of (&after), 4);
  operate ("celdepth:depth-expand", pads, "Y float", result, NULL);
  SAME (levels_of (&after, false), 1);
  operate ("celdepth:depth-expand", pads, "RGBA float", result, "result", 1, "layer", 2, NULL);
  CHECK (result[4 * (40 * WIDTH + 21) + 3] < 0.5f && result[4 * (40 * WIDTH + 45) + 3] > 0.5f);
  drop_ownership (&before);
  drop_ownership (&after);
  g_object_unref (input);
  g_object_unref (regions);
  g_object_unref (corrections);
}

int
main (int argc, char **argv)
{
  setlocale (LC_ALL, "");
  gegl_init (&argc, &argv);
  make_page ();
  RUN (core_makes_all_results_of_the_page);
  RUN (layers_composite_to_the_drawing);
  RUN (the_matte_has_owner_and_coverage);
  RUN (corrections_give_ink_to_their_region);
  celd_palette_clear (&palette);
  celd_relations_clear (&relations);
  drop_page ();
  gegl_exit ();
  return DONE;
}
