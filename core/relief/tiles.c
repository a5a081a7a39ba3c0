/* A surface in tiles: blocks of the picture, parted further where the surface is cut.
 *
 * What is smooth over the surface, as is a shift that keeps the order, needs no more than a value a tile.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/unions.h"
#include "relief/relief.h"

#include <math.h>

#define BLOCKS 96 /* along the diagonal */
#define LEAST  4  /* pixels of a block's side */

static int
end_of (int from, int side, int size)
{
  return from + side < size ? from + side : size;
}

/* ------------------------------------------------------------------ tiles */

/* Does the surface go on everywhere in the block x .. end_x - 1, y .. end_y - 1? */
static bool
is_whole (const CeldSurface *s, int x, int y, int end_x, int end_y)
{
  for (int v = y; v < end_y; v++)
    {
      const float *east = s->east + (size_t) v * (size_t) s->width, *south = s->south + (size_t) v * (size_t) s->width;

      for (int u = x; u < end_x; u++)
        if ((u + 1 < end_x && east[u] <= 0) || (v + 1 < end_y && south[u] <= 0))
          return false;
    }
  return true;
}

/* Joins the pixels of a block: `parent` goes by pixels. */
static void
join_block (const CeldSurface *s, int x, int y, int end_x, int end_y, uint32_t *parent)
{
  uint32_t w = (uint32_t) s->width;
  bool     whole = is_whole (s, x, y, end_x, end_y);

  for (int v = y; v < end_y; v++)
    for (int u = x; u < end_x; u++)
      {
        uint32_t p = (uint32_t) v * w + (uint32_t) u;

        if (whole)
          parent[p] = (uint32_t) y * w + (uint32_t) x;
        else
          {
            if (u + 1 < end_x && s->east[p] > 0)
              celd_join (parent, p, p + 1);
            if (v + 1 < end_y && s->south[p] > 0)
              celd_join (parent, p, p + w);
          }
      }
}

static void
number_tiles (const CeldSurface *s, CeldReliefTiles *tiles)
{
  size_t    n = (size_t) s->width * (size_t) s->height;
  uint32_t *tile = tiles->tile;

  celd_roots (tile, n);
  for (int y = 0; y < s->height; y += tiles->side)
    for (int x = 0; x < s->width; x += tiles->side)
      join_block (s, x, y, end_of (x, tiles->side, s->width), end_of (y, tiles->side, s->height), tile);
  for (size_t p = 0; p < n; p++) /* the parent comes before its child, so it has its number */
    tile[p] = tile[p] == p ? tiles->n++ : tile[tile[p]];
}

static CeldStatus
measure_tiles (const CeldSurface *s, CeldReliefTiles *tiles)
{
  const uint32_t *tile = tiles->tile;

  tiles->area = celd_alloc0 (tiles->n, sizeof *tiles->area);
  tiles->flat = celd_alloc0 (tiles->n, sizeof *tiles->flat);
  tiles->x    = celd_alloc0 (tiles->n, sizeof *tiles->x);
  tiles->y    = celd_alloc0 (tiles->n, sizeof *tiles->y);
  if (!tiles->area || !tiles->flat || !tiles->x || !tiles->y)
    return CELD_NO_MEMORY;
  for (int y = 0; y < s->height; y++)
    for (int x = 0; x < s->width; x++, tile++)
      {
        tiles->area[*tile] += 1;
        tiles->flat[*tile] += s->flat[tile - tiles->tile];
        tiles->x[*tile]    += (float) x;
        tiles->y[*tile]    += (float) y;
      }
  for (uint32_t k = 0; k < tiles->n; k++)
    {
      tiles->x[k] /= tiles->area[k];
      tiles->y[k] /= tiles->area[k];
    }
  return CELD_OK;
}

/* ------------------------------------------------------------------ what is between them */

/* One more edge between two tiles; it may belong to the pair before. */
static CeldStatus
add_edge (CeldTilePair **list, size_t *n, uint32_t a, uint32_t b)
{
  CeldTilePair *pair;

  if (*n && (*list)[*n - 1].a == a && (*list)[*n - 1].b == b)
    {
      (*list)[*n - 1].edges += 1;
      return CELD_OK;
    }
  pair = celd_grow (*list, *n + 1, sizeof *pair);
  if (!pair)
    return CELD_NO_MEMORY;
  pair[(*n)++] = (CeldTilePair) { .a = a, .b = b, .edges = 1 };
  *list        = pair;
  return CELD_OK;
}

/* Links of the block x .. end_x - 1, y .. end_y - 1 to the next ones. */
static CeldStatus
link_block (const CeldSurface *s, int x, int y, int end_x, int end_y, CeldReliefTiles *tiles)
{
  size_t     w = (size_t) s->width;
  CeldStatus status = CELD_OK;

  for (int v = y; v < end_y && end_x < s->width && status == CELD_OK; v++)
    {
      size_t p = (size_t) v * w + (size_t) end_x - 1;

      if (s->east[p] > 0)
        status = add_edge (&tiles->link, &tiles->links, tiles->tile[p], tiles->tile[p + 1]);
    }
  for (int u = x; u < end_x && end_y < s->height && status == CELD_OK; u++)
    {
      size_t p = (size_t) (end_y - 1) * w + (size_t) u;

      if (s->south[p] > 0)
        status = add_edge (&tiles->link, &tiles->links, tiles->tile[p], tiles->tile[p + w]);
    }
  return status;
}

CeldStatus
celd_relief_tiles_new (const CeldSurface *s, CeldReliefTiles *tiles)
{
  double     side = hypot (s->width, s->height) / BLOCKS;
  CeldStatus status;

  *tiles      = (CeldReliefTiles) { .side = side > LEAST ? (int) side : LEAST };
  tiles->tile = celd_alloc ((size_t) s->width * (size_t) s->height, sizeof *tiles->tile);
  if (!tiles->tile)
    return CELD_NO_MEMORY;
  number_tiles (s, tiles);
  status = measure_tiles (s, tiles);
  for (int y = 0; y < s->height && status == CELD_OK; y += tiles->side)
    for (int x = 0; x < s->width && status == CELD_OK; x += tiles->side)
      status = link_block (s, x, y, end_of (x, tiles->side, s->width), end_of (y, tiles->side, s->height), tiles);
  return status;
}

void
celd_relief_tiles_clear (CeldReliefTiles *tiles)
{
  celd_free (tiles->tile);
  celd_free (tiles->area);
  celd_free (tiles->flat);
  celd_free (tiles->x);
  celd_free (tiles->y);
  celd_free (tiles->link);
  *tiles = (CeldReliefTiles) { .side = 0 };
}
