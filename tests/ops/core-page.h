/* Results of core for the page of page.h, which those of the operations are compared with.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CORE_PAGE_H
#define CORE_PAGE_H

#include "page.h"

/* Without threads. */
static CeldPlane     ink = { WIDTH, HEIGHT, WIDTH, (float[PIXELS]) { 0 } };
static CeldLabels    labels = { WIDTH, HEIGHT, WIDTH, (uint32_t[PIXELS]) { 0 } };
static CeldPaint     colours = { WIDTH, HEIGHT, WIDTH, (uint8_t[4 * PIXELS]) { 0 } };
static CeldPlane     flat = { WIDTH, HEIGHT, WIDTH, (float[PIXELS]) { 0 } };
static CeldPlane     levels = { WIDTH, HEIGHT, WIDTH, (float[PIXELS]) { 0 } };
static CeldPlane     depth = { WIDTH, HEIGHT, WIDTH, (float[PIXELS]) { 0 } };
static CeldVectors   normals = { WIDTH, HEIGHT, WIDTH, (float[3 * PIXELS]) { 0 } };
static CeldPlane     shading = { WIDTH, HEIGHT, WIDTH, (float[PIXELS]) { 0 } };
static CeldPalette   palette;
static CeldRelations relations;

static float result[4 * PIXELS];

/* ------------------------------------------------------------------ core */

static CeldStatus
make_order (const CeldSettings *settings)
{
  CeldOrder  order = { 0 };
  CeldStatus status = celd_order (&labels, &palette, &relations, &ink, NULL, NULL, &order, NULL);

  for (int i = 0; status == CELD_OK && i < PIXELS; i++)
    flat.data[i] = celd_encode_level (order.level[labels.data[i] - 1], order.levels, settings);
  if (status == CELD_OK)
    status = celd_expand_levels (&ink, NULL, &flat, NULL, NULL, CELD_EXPANSION_OUTLINES, NULL, &levels);
  celd_order_clear (&order);
  return status;
}

static void
core_makes_all_results_of_the_page (void)
{
  CeldSettings settings = celd_settings ();
  CeldMask     anchors = { WIDTH, HEIGHT, WIDTH, malloc (PIXELS) };

  CHECK (celd_ink (&page_drawing, CELD_INK_AUTO, NULL, &ink) == CELD_OK);
  CHECK (celd_scribbles_read (&scribbles_paint, &settings, NULL, &labels, &palette) == CELD_OK);
  for (int i = 0; i < PIXELS; i++)
    anchors.data[i] = labels.data[i] != 0;
  CHECK (celd_arrows_read (&arrows_paint, CELD_ARROW_HEAD, NULL, &relations, NULL) == CELD_OK);
  CHECK (relations.n == 1);
  CHECK (celd_segment (&ink, &labels, &relations, &settings, NULL, &labels, &palette, NULL) == CELD_OK);
  CHECK (palette.n == 3);
  CHECK (celd_labels_paint (&labels, &palette, &colours) == CELD_OK);
  CHECK (make_order (&settings) == CELD_OK);
  CHECK (celd_smooth (&ink, NULL, &levels, &anchors, &settings, NULL, &depth, NULL) == CELD_OK);
  CHECK (celd_normals (&ink, &levels, &settings, NULL, &normals) == CELD_OK);
  CHECK (celd_shade (&normals, &settings, &shading) == CELD_OK);
  NEAR (range (flat.data, PIXELS), 1, 0);
  free (anchors.data);
}

/* ------------------------------------------------------------------ comparing */

/* Normals as they are stored. */
static inline const float *
stored_normals (bool directx)
{
  static float stored[3 * PIXELS];

  for (int i = 0; i < 3 * PIXELS; i++)
    stored[i] = 0.5f + (directx && i % 3 == 1 ? -0.5f : 0.5f) * normals.data[i];
  return stored;
}

#define SAME(wanted, channels) NEAR (difference (result, wanted, (size_t) (channels) * PIXELS), 0, 1e-5)

#endif
