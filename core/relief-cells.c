/* A surface in cells: blocks of the picture, parted further where the surface is cut.
 *
 * What is smooth over the surface, as is a shift that keeps the order, needs no more than a value a cell.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "relief.h"
#include "unions.h"

#include <math.h>

#define BLOCKS 96 /* along the diagonal */
#define LEAST  4  /* pixels of a block's side */

static int
end_of (int from, int side, int size)
{
  return from + side < size ? from + side : size;
}

/* ------------------------------------------------------------------ cells */

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
number_cells (const CeldSurface *s, CeldCells *cells)
{
  size_t    n = (size_t) s->width * (size_t) s->height;
  uint32_t *cell = cells->cell;

  celd_roots (cell, n);
  for (int y = 0; y < s->height; y += cells->side)
    for (int x = 0; x < s->width; x += cells->side)
      join_block (s, x, y, end_of (x, cells->side, s->width), end_of (y, cells->side, s->height), cell);
  for (size_t p = 0; p < n; p++) /* the parent comes before its child, so it has its number */
    cell[p] = cell[p] == p ? cells->n++ : cell[cell[p]];
}

static CeldStatus
measure_cells (const CeldSurface *s, CeldCells *cells)
{
  const uint32_t *cell = cells->cell;

  cells->area = celd_alloc0 (cells->n, sizeof *cells->area);
  cells->flat = celd_alloc0 (cells->n, sizeof *cells->flat);
  cells->x    = celd_alloc0 (cells->n, sizeof *cells->x);
  cells->y    = celd_alloc0 (cells->n, sizeof *cells->y);
  if (!cells->area || !cells->flat || !cells->x || !cells->y)
    return CELD_NO_MEMORY;
  for (int y = 0; y < s->height; y++)
    for (int x = 0; x < s->width; x++, cell++)
      {
        cells->area[*cell] += 1;
        cells->flat[*cell] += s->flat[cell - cells->cell];
        cells->x[*cell]    += (float) x;
        cells->y[*cell]    += (float) y;
      }
  for (uint32_t k = 0; k < cells->n; k++)
    {
      cells->x[k] /= cells->area[k];
      cells->y[k] /= cells->area[k];
    }
  return CELD_OK;
}

/* ------------------------------------------------------------------ what is between them */

/* One more edge between two cells; it may belong to the pair before. */
static CeldStatus
add_edge (CeldCellPair **list, size_t *n, uint32_t a, uint32_t b)
{
  CeldCellPair *pair;

  if (*n && (*list)[*n - 1].a == a && (*list)[*n - 1].b == b)
    {
      (*list)[*n - 1].edges += 1;
      return CELD_OK;
    }
  pair = celd_grow (*list, *n + 1, sizeof *pair);
  if (!pair)
    return CELD_NO_MEMORY;
  pair[(*n)++] = (CeldCellPair) { a, b, 1, 0 };
  *list        = pair;
  return CELD_OK;
}

/* Links of the block x .. end_x - 1, y .. end_y - 1 to the next ones. */
static CeldStatus
link_block (const CeldSurface *s, int x, int y, int end_x, int end_y, CeldCells *cells)
{
  size_t     w = (size_t) s->width;
  CeldStatus status = CELD_OK;

  for (int v = y; v < end_y && end_x < s->width && status == CELD_OK; v++)
    {
      size_t p = (size_t) v * w + (size_t) end_x - 1;

      if (s->east[p] > 0)
        status = add_edge (&cells->link, &cells->links, cells->cell[p], cells->cell[p + 1]);
    }
  for (int u = x; u < end_x && end_y < s->height && status == CELD_OK; u++)
    {
      size_t p = (size_t) (end_y - 1) * w + (size_t) u;

      if (s->south[p] > 0)
        status = add_edge (&cells->link, &cells->links, cells->cell[p], cells->cell[p + w]);
    }
  return status;
}

CeldStatus
celd_cells_new (const CeldSurface *s, CeldCells *cells)
{
  double     side = hypot (s->width, s->height) / BLOCKS;
  CeldStatus status;

  *cells      = (CeldCells) { .side = side > LEAST ? (int) side : LEAST };
  cells->cell = celd_alloc ((size_t) s->width * (size_t) s->height, sizeof *cells->cell);
  if (!cells->cell)
    return CELD_NO_MEMORY;
  number_cells (s, cells);
  status = measure_cells (s, cells);
  for (int y = 0; y < s->height && status == CELD_OK; y += cells->side)
    for (int x = 0; x < s->width && status == CELD_OK; x += cells->side)
      status = link_block (s, x, y, end_of (x, cells->side, s->width), end_of (y, cells->side, s->height), cells);
  return status;
}

void
celd_cells_clear (CeldCells *cells)
{
  celd_free (cells->cell);
  celd_free (cells->area);
  celd_free (cells->flat);
  celd_free (cells->x);
  celd_free (cells->y);
  celd_free (cells->link);
  *cells = (CeldCells) { .side = 0 };
}
