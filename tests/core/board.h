/* A picture to look at from the side, for the tests of scenes.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef BOARD_H
#define BOARD_H

#include "layer-scene.h"

enum { W = 80, H = 30 };

static inline bool
is_on_board (int x, int y)
{
  return x >= 30 && x < 50 && y >= 6 && y < 24;
}

/* A board (label 2, depth 1) from x = 30 to 49 with an outline, in front of paper of depth 0; random greys on both. */
static inline LayerScene
draw_board (void)
{
  LayerScene s = layer_scene (W, H);
  uint32_t   seed = 5;

  for (int y = 0; y < H; y++)
    for (int x = 0; x < W; x++)
      {
        bool  board = is_on_board (x, y), line = board && (x < 32 || x >= 48 || y < 8 || y >= 22);
        float grey = line ? 0 : (board ? 0.3f : 0.7f) + 0.25f * (float) check_random (&seed, 1000) / 1000;

        CELD_AT (&s.own.owner, x, y) = CELD_AT (&s.own.under, x, y) = board ? 2 : 1;
        CELD_AT (&s.ink, x, y) = !line;
        CELD_AT (&s.depth, x, y) = board;
        for (int c = 0; c < 3; c++)
          art_at (&s, x, y)[c] = grey;
      }
  return s;
}

static inline CeldColours
new_colours (int width, int height)
{
  size_t n = 4 * (size_t) width * (size_t) height;

  return (CeldColours) { width, height, (size_t) width, calloc (n, sizeof (float)) };
}

/* The view of a scene, which is freed. */
static inline CeldColours
view_of (CeldScene *scene, int width, int height, CeldCamera camera, const CeldSettings *settings, const CeldHost *host)
{
  CeldColours view = new_colours (width, height);

  CHECK (celd_scene_view (scene, camera, settings, host, &view) == CELD_OK);
  celd_scene_free (scene);
  return view;
}

#endif
