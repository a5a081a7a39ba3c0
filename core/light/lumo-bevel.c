/* Bevels: surfaces that bend only along their outlines.
 *
 * Each pixel takes the nearest constraint of its neighbours [Dan80], but not across cuts, so that outlines of nearer
 * regions do not bend what continues behind them.  Rows are swept down and up until nothing changes.
 *
 *   [Dan80]  P.-E. Danielsson: Euclidean Distance Mapping.  Computer Graphics and Image Processing 14, 1980.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "light/light.h"

#define MOST_SWEEPS   16   /* down and up (chosen: only spirals of more turns need more) */
#define NO_CONSTRAINT UINT32_MAX

typedef struct { CeldLumo *lumo; uint32_t *nearest; int64_t far; bool changed; } Bevel;

static int64_t
squared (const Bevel *b, size_t pixel, uint32_t constraint)
{
  size_t  w = (size_t) b->lumo->width;
  int64_t dx = (int64_t) (pixel % w) - (int64_t) (constraint % w);
  int64_t dy = (int64_t) (pixel / w) - (int64_t) (constraint / w);

  return dx * dx + dy * dy;
}

/* Takes over the constraint of the neighbour `from` if it is nearer than the present one, and near enough to matter. */
static void
take (Bevel *b, size_t pixel, size_t from, float weight)
{
  uint32_t constraint = b->nearest[from];
  int64_t  distance;

  if (!(weight > 0) || constraint == NO_CONSTRAINT || constraint == b->nearest[pixel])
    return;
  distance = squared (b, pixel, constraint);
  if (distance > b->far || (b->nearest[pixel] != NO_CONSTRAINT && distance >= squared (b, pixel, b->nearest[pixel])))
    return;
  b->nearest[pixel] = constraint;
  b->changed        = true;
}

static void
pass_row (Bevel *b, int y, int from)
{
  const CeldLumo *l = b->lumo;
  size_t          w = (size_t) l->width, row = (size_t) y * w;

  if (from >= 0 && from < l->height)
    for (size_t x = 0; x < w; x++)
      take (b, row + x, (size_t) from * w + x, l->south[(size_t) (from < y ? from : y) * w + x]);
  for (size_t x = 1; x < w; x++)
    take (b, row + x, row + x - 1, l->east[row + x - 1]);
  for (size_t x = w - 1; x > 0; x--)
    take (b, row + x - 1, row + x, l->east[row + x - 1]);
}

static CeldStatus
spread (Bevel *b, const CeldHost *host)
{
  int        height = b->lumo->height;
  CeldStatus status = CELD_OK;

  b->changed = true;
  for (int round = 0; b->changed && round < MOST_SWEEPS && status == CELD_OK; round++)
    {
      b->changed = false;
      for (int y = 0; y < height; y++)
        pass_row (b, y, y - 1);
      for (int y = height - 1; y >= 0; y--)
        pass_row (b, y, y + 1);
      status = celd_progress (host, 1 - 1. / (round + 2));
    }
  return status;
}

static void
flatten (const Bevel *b, double width)
{
  size_t n = (size_t) b->lumo->width * (size_t) b->lumo->height;

  for (size_t i = 0; i < n; i++)
    {
      double t = 1, tilt;

      if (b->nearest[i] != NO_CONSTRAINT)
        t = fmin (1, (sqrt ((double) squared (b, i, b->nearest[i])) + 0.5) / width);
      tilt = 1 - t * t * (3 - 2 * t);
      b->lumo->tilt[2 * i]     *= (float) tilt;
      b->lumo->tilt[2 * i + 1] *= (float) tilt;
    }
}

CeldStatus
celd_lumo_bevel (CeldLumo *l, const CeldHost *host)
{
  double     width = (double) l->settings->bevel * hypot (l->width, l->height);
  size_t     n = (size_t) l->width * (size_t) l->height;
  Bevel      b = { .lumo = l };
  CeldStatus status;

  if (!(l->settings->bevel > 0))
    return CELD_OK;
  b.nearest = celd_alloc (n, sizeof *b.nearest);
  if (!b.nearest)
    return CELD_NO_MEMORY;
  width = fmax (width, 1);
  b.far = (int64_t) (width * width) + 1;
  for (size_t i = 0; i < n; i++)
    b.nearest[i] = NO_CONSTRAINT;
  for (size_t k = 0; k < l->constraints.n; k++)
    b.nearest[l->constraints.item[k].pixel] = (uint32_t) l->constraints.item[k].pixel;
  status = spread (&b, host);
  if (status == CELD_OK)
    flatten (&b, width);
  celd_free (b.nearest);
  return status;
}
