/* A drawing as its lattice carries it: cells are drawn from far to near, each as two triangles.
 *
 * A place shows the pixels of the drawing around where it comes from, but only those of the cell's own piece, so that
 * the edges of pieces are antialiased and nothing of another piece shows beside a crack.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/motion.h"

#include <stdlib.h>

typedef struct { uint32_t level, cell; } DrawnCell;

/* From places to the drawing: x = at[0] + at[1] u + at[2] v, of u, v from the first corner. */
typedef struct { float first[2], x[3], y[3]; } FromPlace;

typedef struct
{
  const CeldLattice *lattice;
  const CeldColours *art;
  CeldColours       *warped;   /* premultiplied */
} Warp;

/* The colour of the drawing at a place, of one piece; premultiplied. */
static void
sample (const Warp *w, uint32_t piece, float x, float y, float colour[4])
{
  const CeldLattice *lattice = w->lattice;
  int                left = (int) floorf (x - 0.5f), top = (int) floorf (y - 0.5f);
  float              u = x - 0.5f - (float) left, v = y - 0.5f - (float) top;

  memset (colour, 0, 4 * sizeof *colour);
  for (int k = 0; k < 4; k++)
    {
      int      px = left + k % 2, py = top + k / 2;
      float    weight = (k % 2 ? u : 1 - u) * (k / 2 ? v : 1 - v);
      uint32_t cell;

      if (px < 0 || py < 0 || px >= lattice->width || py >= lattice->height)
        continue;
      cell = celd_lattice_cell (lattice, px, py);
      if (!cell || lattice->piece[cell - 1] != piece)
        continue;
      weight *= CELD_RGBA (w->art, px, py)[3];
      for (int c = 0; c < 3; c++)
        colour[c] += weight * CELD_RGBA (w->art, px, py)[c];
      colour[3] += weight;
    }
}

/* The affine map of a triangle of corners of a cell; false if it has no area. */
static bool
triangle_map (const CeldLattice *lattice, const uint32_t *corner[3], FromPlace *from)
{
  const float *p[3], *r[3];
  float        u[2], v[2], area;

  for (int i = 0; i < 3; i++)
    {
      p[i] = lattice->place + 2 * (size_t) *corner[i];
      r[i] = lattice->rest + 2 * (size_t) *corner[i];
    }
  for (int i = 0; i < 2; i++)
    {
      u[i] = p[1][i] - p[0][i];
      v[i] = p[2][i] - p[0][i];
    }
  area = u[0] * v[1] - u[1] * v[0];
  if (!(fabsf (area) > 1e-6f))
    return false;
  memcpy (from->first, p[0], sizeof from->first);
  for (int i = 0; i < 2; i++)
    {
      float *to = i ? from->y : from->x, du = r[1][i] - r[0][i], dv = r[2][i] - r[0][i];

      to[0] = r[0][i];
      to[1] = (du * v[1] - dv * u[1]) / area;
      to[2] = (dv * u[0] - du * v[0]) / area;
    }
  return true;
}

/* The pixels from floor (least) to floor (most), as far as they are in the frame. */
static void
clip (float least, float most, int size, int *first, int *last)
{
  *first = least > 0 ? (int) fminf (least, (float) size) : 0;
  *last  = most < (float) size ? (int) fmaxf (most, -1) : size - 1;
}

static void
draw_triangle (const Warp *w, size_t cell, const uint32_t *corner[3], bool lower)
{
  const CeldLattice *lattice = w->lattice;
  const float       *rest = lattice->rest + 2 * (size_t) lattice->corner[4 * cell], *p[3];
  float              side = (float) lattice->side;
  int                left, right, top, bottom;
  FromPlace          from;

  if (!triangle_map (lattice, corner, &from))
    return;
  for (int i = 0; i < 3; i++)
    p[i] = lattice->place + 2 * (size_t) *corner[i];
  clip (fminf (p[0][0], fminf (p[1][0], p[2][0])), fmaxf (p[0][0], fmaxf (p[1][0], p[2][0])), lattice->width, &left,
        &right);
  clip (fminf (p[0][1], fminf (p[1][1], p[2][1])), fmaxf (p[0][1], fmaxf (p[1][1], p[2][1])), lattice->height, &top,
        &bottom);
  for (int y = top; y <= bottom; y++)
    for (int x = left; x <= right; x++)
      {
        float dx = (float) x + 0.5f - from.first[0], dy = (float) y + 0.5f - from.first[1], colour[4];
        float u = from.x[0] + from.x[1] * dx + from.x[2] * dy, v = from.y[0] + from.y[1] * dx + from.y[2] * dy;
        float a = (u - rest[0]) / side, b = (v - rest[1]) / side, *to = CELD_RGBA (w->warped, x, y);

        if (a < 0 || b < 0 || a > 1 || b > 1 || (lower ? a + b <= 1 : a + b > 1))
          continue;
        sample (w, lattice->piece[cell], u, v, colour);
        for (int c = 0; c < 4; c++)
          to[c] = colour[c] + (1 - colour[3]) * to[c];
      }
}

static int
compare_drawn (const void *a, const void *b)
{
  const DrawnCell *p = a, *q = b;

  return p->level != q->level ? (p->level < q->level ? -1 : 1) : (p->cell > q->cell) - (p->cell < q->cell);
}

static void
draw_cells (const Warp *w, const DrawnCell *order)
{
  for (size_t k = 0; k < w->lattice->n_cells; k++)
    {
      const uint32_t *corner = w->lattice->corner + 4 * (size_t) order[k].cell;

      draw_triangle (w, order[k].cell, (const uint32_t *[]) { corner, corner + 1, corner + 2 }, false);
      draw_triangle (w, order[k].cell, (const uint32_t *[]) { corner + 1, corner + 3, corner + 2 }, true);
    }
}

/* Clears the picture, or divides its colours by their alpha. */
static void
prepare (CeldColours *picture, bool clear)
{
  for (int y = 0; y < picture->height; y++)
    for (int x = 0; x < picture->width; x++)
      {
        float *to = CELD_RGBA (picture, x, y);

        for (int c = 0; c < 4; c++)
          to[c] = clear ? 0 : c < 3 && to[3] > 0 ? to[c] / to[3] : to[c];
      }
}

CeldStatus
celd_lattice_warp (const CeldLattice *lattice, const CeldColours *art, CeldColours *warped)
{
  Warp       w = { lattice, art, warped };
  DrawnCell *order;

  if (!CELD_SAME_SIZE (art, warped) || art->width != lattice->width || art->height != lattice->height)
    return CELD_BAD_SIZE;
  order = celd_alloc (lattice->n_cells, sizeof *order);
  if (!order)
    return CELD_NO_MEMORY;
  for (size_t c = 0; c < lattice->n_cells; c++)
    order[c] = (DrawnCell) { lattice->level[c], (uint32_t) c };
  qsort (order, lattice->n_cells, sizeof *order, compare_drawn);
  prepare (warped, true);
  draw_cells (&w, order);
  prepare (warped, false);
  celd_free (order);
  return CELD_OK;
}
