/* One byte of marks for each square tile of a picture.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_TILES_H
#define CELD_TILES_H

#include "base/base.h"

#define CELD_TILE 16 /* pixels a side (chosen) */

typedef struct { int across, down; uint8_t *at; } CeldTiles;

/* Tiles that cover the picture, all marks 0; the caller frees `at` with celd_free. */
static inline CeldStatus
celd_tiles_new (int width, int height, CeldTiles *tiles)
{
  *tiles    = (CeldTiles) { (width + CELD_TILE - 1) / CELD_TILE, (height + CELD_TILE - 1) / CELD_TILE, NULL };
  tiles->at = celd_alloc0 ((size_t) tiles->across * (size_t) tiles->down, 1);
  return tiles->at ? CELD_OK : CELD_NO_MEMORY;
}

/* The marks of the tile of pixel (x,y). */
static inline uint8_t *
celd_tile_of (const CeldTiles *tiles, int x, int y)
{
  return &tiles->at[(size_t) (y / CELD_TILE) * (size_t) tiles->across + (size_t) (x / CELD_TILE)];
}

/* Tiles left .. right, top .. bottom, inclusive; none if right < left. */
typedef struct { int left, top, right, bottom; } CeldTileSpan;

/* The tiles that a box of places, in pixels, touches. */
static inline CeldTileSpan
celd_tile_span (const CeldTiles *tiles, float left, float top, float right, float bottom)
{
  float most_x = (float) (tiles->across * CELD_TILE - 1), most_y = (float) (tiles->down * CELD_TILE - 1);

  if (!(left <= most_x && top <= most_y && right >= 0 && bottom >= 0))
    return (CeldTileSpan) { 0, 0, -1, -1 };
  return (CeldTileSpan) {
    left > 0 ? (int) left / CELD_TILE : 0, top > 0 ? (int) top / CELD_TILE : 0,
    (int) (right < most_x ? right : most_x) / CELD_TILE, (int) (bottom < most_y ? bottom : most_y) / CELD_TILE
  };
}

/* Whether any tile of the span has any of these bits set. */
static inline bool
celd_tiles_any (const CeldTiles *tiles, CeldTileSpan span, uint8_t bits)
{
  for (int y = span.top; y <= span.bottom; y++)
    for (int x = span.left; x <= span.right; x++)
      if (tiles->at[(size_t) y * (size_t) tiles->across + (size_t) x] & bits)
        return true;
  return false;
}

/* Sets these bits in all tiles of the span. */
static inline void
celd_tiles_mark (CeldTiles *tiles, CeldTileSpan span, uint8_t bits)
{
  for (int y = span.top; y <= span.bottom; y++)
    for (int x = span.left; x <= span.right; x++)
      tiles->at[(size_t) y * (size_t) tiles->across + (size_t) x] |= bits;
}

/* The pixels of tile (tile_x,tile_y), cut to the picture of this size. */
static inline CeldRect
celd_tile_rect (int tile_x, int tile_y, int width, int height)
{
  int x = tile_x * CELD_TILE, y = tile_y * CELD_TILE, right = width - x, below = height - y;

  return (CeldRect) { x, y, right < CELD_TILE ? right : CELD_TILE, below < CELD_TILE ? below : CELD_TILE };
}

#endif
