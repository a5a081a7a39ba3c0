/* Puppets: where parts come apart.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "layer-scene.h"
#include "motion/puppet.h"

#define SIDE 240

static const float RED[3] = { 1, 0, 0 }, BLUE[3] = { 0, 0, 1 };

static double body (double x, double y) { return box_share (x, y, 40.3, 60, 120, 200.6); }
static double body_line (double x, double y) { return frame_share (x, y, 40.3, 60, 120, 200.6); }
static double badge (double x, double y) { return box_share (x, y, 60, 120, 100, 160); }
static double badge_line (double x, double y) { return frame_share (x, y, 60, 120, 100, 160); }
static double broken_line (double x, double y) { return fabs (x - 80) < 6 ? 0 : badge_line (x, y); }

/* A badge on a body, with a line around it: it tears off unless cracks are marked elsewhere only. */
static void
marked_cracks_are_the_only_ones (void)
{
  static const CeldCrack  crack[3] = { { 2, 1 }, { 3, 2 }, { 2, 3 } };
  static const struct { size_t first, n; bool torn; } ways[] = { { 0, 0, true }, { 0, 1, false }, { 1, 1, true },
                                                                 { 2, 1, true }, { 0, 2, true } };
  LayerScene   s = layer_scene (SIDE, SIDE);
  CeldLayers  *layers;
  CeldSettings settings = celd_settings ();

  layer_scene_paint (&s, 2, RED, body, body_line);
  layer_scene_paint (&s, 3, BLUE, badge, badge_line);
  layers = layer_scene_cut (&s, 3, CELD_STORE_FLOAT, true);
  for (size_t way = 0; way < 5; way++)
    {
      CeldCrack   marked[3];
      CeldCracks  cracks = { marked, ways[way].n };
      CeldPuppet *puppet = NULL;

      memcpy (marked, crack, sizeof marked);
      cracks.item += ways[way].first;
      CHECK (celd_puppet_new (layers, &s.ink, NULL, 1, &cracks, &settings, NULL, &puppet) == CELD_OK);
      CHECK ((puppet->lattice.piece[celd_puppet_front_cell (puppet, 80, 80) - 1] !=
              puppet->lattice.piece[celd_puppet_front_cell (puppet, 80, 140) - 1]) == ways[way].torn);
      celd_puppet_free (puppet);
    }
  celd_layers_free (layers);
  layer_scene_close (&s);
}

/* A badge whose line has two gaps of four stroke widths tears off where gaps hold depth, unless a contour for
 * segmentation only goes over them. */
static void
gaps_tear (void)
{
  static const struct { bool hold, bordered, torn; } ways[] = { { true, false, true }, { false, false, false },
                                                                { true, true, false } };
  LayerScene  s = layer_scene (SIDE, SIDE), whole = layer_scene (SIDE, SIDE);
  CeldLayers *layers;

  layer_scene_paint (&s, 2, RED, body, body_line);
  layer_scene_paint (&whole, 2, RED, body, body_line);
  layer_scene_paint (&s, 3, BLUE, badge, broken_line);
  layer_scene_paint (&whole, 3, BLUE, badge, badge_line);
  layers = layer_scene_cut (&s, 3, CELD_STORE_FLOAT, true);
  for (size_t way = 0; way < 3; way++)
    {
      CeldSettings settings = celd_settings ();
      CeldPuppet  *puppet = NULL;

      settings.hold_gaps = ways[way].hold;
      CHECK (celd_puppet_new (layers, &s.ink, ways[way].bordered ? &whole.ink : NULL, 1, NULL, &settings, NULL,
                              &puppet) == CELD_OK);
      CHECK ((puppet->lattice.piece[celd_puppet_front_cell (puppet, 80, 80) - 1] !=
              puppet->lattice.piece[celd_puppet_front_cell (puppet, 80, 140) - 1]) == ways[way].torn);
      celd_puppet_free (puppet);
    }
  celd_layers_free (layers);
  layer_scene_close (&s);
  layer_scene_close (&whole);
}

int
main (void)
{
  RUN (marked_cracks_are_the_only_ones);
  RUN (gaps_tear);
  return DONE;
}
