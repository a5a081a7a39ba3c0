/* Corrections by the artist: a stroke in a region's colour over ink gives that ink, and the whole piece of line, to the
 * region.
 *
 * A piece of line extends along the edges that see the stroke through the ink, up to corners.  Only ink with the same
 * owner as below the stroke is reassigned, so that lines which cross the piece keep their owners.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "image/image.h"
#include "ownership/ownership.h"

#include <math.h>

#define SEARCH_STEP      0.5f /* pixels between the samples of a ray; chosen */
#define MAX_PIECE_WIDTHS 3    /* pen widths; a piece of line is at most so thick; chosen */

typedef struct { uint32_t from, to; } Reassignment; /* ink of label `from` is given to `to`; 0: none */

typedef struct
{
  const CeldContourPens *pens;
  const CeldPlane       *ink;
  const CeldLabels      *corrections;
  CeldLabels            *owner;
  Reassignment          *change;           /* of each point */
  CeldTiles              strokes;          /* not 0 for tiles with strokes */
  CeldReassigned        *reassigned;
} Corrector;

static CeldStatus
reassign (const Corrector *c, int x, int y, uint32_t to)
{
  uint32_t  *owner = &CELD_AT (c->owner, x, y);
  CeldStatus status;

  if (*owner == to)
    return CELD_OK;
  status = celd_append (c->reassigned->item, c->reassigned->n, c->reassigned->capacity,
                        (CeldPixelOwner) { (int32_t) (y * c->ink->width + x), *owner });
  if (status == CELD_OK)
    *owner = to;
  return status;
}

/* Marks the tiles with strokes. */
static CeldStatus
find_strokes (Corrector *c)
{
  int        w = c->ink->width;
  CeldStatus status = celd_tiles_new (w, c->ink->height, &c->strokes);

  for (int y = 0; y < c->ink->height && status == CELD_OK; y++)
    for (int x = 0; x < w; x += CELD_TILE)
      {
        const uint32_t *label = &CELD_AT (c->corrections, x, y);
        int             n = w - x < CELD_TILE ? w - x : CELD_TILE;
        uint32_t        any = 0;

        for (int i = 0; i < n; i++)
          any |= label[i];
        if (any)
          *celd_tile_of (&c->strokes, x, y) = 1;
      }
  return status;
}

/* The pixel at distance s behind an edge; true if it is ink. */
static bool
ink_behind (const Corrector *c, const CeldEdgePoint *p, float s, int *x, int *y)
{
  *x = celd_floor (p->x + s * p->nx);
  *y = celd_floor (p->y + s * p->ny);
  return *x >= 0 && *y >= 0 && *x < c->ink->width && *y < c->ink->height && !celd_is_paper (CELD_AT (c->ink, *x, *y));
}

static float
search_depth (const Corrector *c, size_t i)
{
  return fminf (c->pens->edges->point[i].thickness, MAX_PIECE_WIDTHS * c->pens->pen[i].width + 2);
}

/* The reassignment by the first stroke that a point sees through the ink. */
static Reassignment
find_change (const Corrector *c, size_t i)
{
  const CeldEdgePoint *p = &c->pens->edges->point[i];
  float                length = search_depth (c, i), x = p->x + length * p->nx, y = p->y + length * p->ny;

  if (!celd_tiles_any (&c->strokes, celd_tile_span (&c->strokes, fminf (x, p->x) - 1, fminf (y, p->y) - 1,
                                                    fmaxf (x, p->x) + 1, fmaxf (y, p->y) + 1), 1))
    return (Reassignment) { 0, 0 };
  for (float s = SEARCH_STEP / 2; s < length; s += SEARCH_STEP)
    {
      int u, v;

      if (ink_behind (c, p, s, &u, &v) && CELD_AT (c->corrections, u, v))
        return (Reassignment) { CELD_AT (c->owner, u, v), CELD_AT (c->corrections, u, v) };
    }
  return (Reassignment) { 0, 0 };
}

/* Points without a reassignment take that of their neighbour, up to a corner. */
static void
propagate_changes (const Corrector *c, const CeldEdgeLoop *loop)
{
  const CeldEdgePoint *point = &c->pens->edges->point[loop->first];
  Reassignment        *change = &c->change[loop->first];
  size_t               n = loop->n, seen = 0;

  for (size_t i = 0; i < n; i++)
    seen += change[i].to != 0;
  for (int backwards = 0; backwards < 2 && seen; backwards++)
    for (size_t i = 1; i < 2 * n; i++)
      {
        size_t a = (backwards ? 2 * n - i : i - 1) % n, b = (backwards ? 2 * n - i - 1 : i) % n;

        if (change[a].to && !change[b].to && !point[a].corner && !point[b].corner)
          change[b] = change[a];
      }
}

static CeldStatus
reassign_behind (const Corrector *c, size_t i)
{
  const CeldEdgePoint *p = &c->pens->edges->point[i];
  float                length = search_depth (c, i);
  CeldStatus           status = CELD_OK;

  for (float s = SEARCH_STEP / 2; s < length && c->change[i].to && status == CELD_OK; s += SEARCH_STEP)
    {
      int x, y;

      if (ink_behind (c, p, s, &x, &y) && CELD_AT (c->owner, x, y) == c->change[i].from)
        status = reassign (c, x, y, c->change[i].to);
    }
  return status;
}

/* Reassigns the ink under the strokes within a tile. */
static CeldStatus
reassign_below (const Corrector *c, CeldRect tile)
{
  CeldStatus status = CELD_OK;

  if (!*celd_tile_of (&c->strokes, tile.x, tile.y))
    return CELD_OK;
  for (int y = tile.y; y < tile.y + tile.height && status == CELD_OK; y++)
    for (int x = tile.x; x < tile.x + tile.width && status == CELD_OK; x++)
      if (CELD_AT (c->corrections, x, y) && !celd_is_paper (CELD_AT (c->ink, x, y)))
        status = reassign (c, x, y, CELD_AT (c->corrections, x, y));
  return status;
}

CeldStatus
celd_corrections_apply (const CeldContourPens *pens, const CeldPlane *ink, const CeldLabels *corrections,
                        CeldLabels *owner, CeldReassigned *reassigned)
{
  size_t     n = pens->edges->n_points;
  Corrector  c = { pens, ink, corrections, owner, celd_alloc (n + 1, sizeof *c.change), { 0 }, reassigned };
  CeldStatus status = c.change ? find_strokes (&c) : CELD_NO_MEMORY;

  for (size_t i = 0; i < n && status == CELD_OK; i++)
    c.change[i] = find_change (&c, i);
  for (size_t k = 0; k < pens->edges->n_loops && status == CELD_OK; k++)
    propagate_changes (&c, &pens->edges->loop[k]);
  for (size_t i = 0; i < n && status == CELD_OK; i++)
    status = reassign_behind (&c, i);
  for (int ty = 0; ty < c.strokes.down && status == CELD_OK; ty++)
    for (int tx = 0; tx < c.strokes.across && status == CELD_OK; tx++)
      status = reassign_below (&c, celd_tile_rect (tx, ty, ink->width, ink->height));
  celd_free (c.change);
  celd_free (c.strokes.at);
  return status;
}

void
celd_reassigned_clear (CeldReassigned *reassigned)
{
  celd_free (reassigned->item);
  *reassigned = (CeldReassigned) { 0 };
}
