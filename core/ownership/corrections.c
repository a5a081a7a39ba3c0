/* What the artist corrects: a stroke in a region's colour over ink gives that ink, the whole piece of line, to the
 * region.
 *
 * A piece of line lies beside the edges that see the stroke through the ink, on as far as they run without a corner.
 * Only ink of the owner below the stroke changes hands, so that lines which cross the piece stay whose they are.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/tiles.h"
#include "image/image.h"
#include "ownership/contours.h"

#include <math.h>

#define STEP  0.5f  /* pixels between the places of a ray */
#define LINES 3     /* pen widths that a piece of line may be thick */

typedef struct { uint32_t from, to; } Gift; /* ink of label `from` goes to `to`; 0: none */

typedef struct
{
  const CeldPens   *pens;
  const CeldPlane  *ink;
  const CeldLabels *corrections;
  CeldLabels       *owner;
  Gift             *gift;        /* of each place */
  CeldTiles         strokes;     /* not 0 where there are any */
  CeldGiven        *given;
} Hand;

static CeldStatus
give (const Hand *h, int x, int y, uint32_t to)
{
  uint32_t  *owner = &CELD_AT (h->owner, x, y);
  CeldOwned *item;

  if (*owner == to)
    return CELD_OK;
  item = celd_grow (h->given->item, h->given->n + 1, sizeof *item);
  if (!item)
    return CELD_NO_MEMORY;
  h->given->item = item;
  item[h->given->n++] = (CeldOwned) { (int32_t) (y * h->ink->width + x), *owner };
  *owner = to;
  return CELD_OK;
}

/* Where the strokes are. */
static CeldStatus
find_strokes (Hand *h)
{
  int        w = h->ink->width;
  CeldStatus status = celd_tiles_new (w, h->ink->height, &h->strokes);

  for (int y = 0; y < h->ink->height && !status; y++)
    for (int x = 0; x < w; x += CELD_TILE)
      {
        const uint32_t *label = &CELD_AT (h->corrections, x, y);
        int             n = w - x < CELD_TILE ? w - x : CELD_TILE;
        uint32_t        any = 0;

        for (int i = 0; i < n; i++)
          any |= label[i];
        if (any)
          *celd_tile_of (&h->strokes, x, y) = 1;
      }
  return status;
}

/* The pixel so far behind an edge.  Is it ink? */
static bool
ink_behind (const Hand *h, const CeldEdgePoint *p, float depth, int *x, int *y)
{
  *x = celd_round_down (p->x + depth * p->nx);
  *y = celd_round_down (p->y + depth * p->ny);
  return *x >= 0 && *y >= 0 && *x < h->ink->width && *y < h->ink->height && !celd_is_paper (CELD_AT (h->ink, *x, *y));
}

static float
reach_of (const Hand *h, size_t i)
{
  return fminf (h->pens->edges->point[i].through, LINES * h->pens->pen[i].width + 2);
}

/* What the place sees of a stroke. */
static Gift
look_for_stroke (const Hand *h, size_t i)
{
  const CeldEdgePoint *p = &h->pens->edges->point[i];
  float                reach = reach_of (h, i), x = p->x + reach * p->nx, y = p->y + reach * p->ny;

  if (!celd_tiles_any (&h->strokes, celd_tile_span (&h->strokes, fminf (x, p->x) - 1, fminf (y, p->y) - 1,
                                                    fmaxf (x, p->x) + 1, fmaxf (y, p->y) + 1), 1))
    return (Gift) { 0, 0 };
  for (float depth = STEP / 2; depth < reach; depth += STEP)
    {
      int u, v;

      if (ink_behind (h, p, depth, &u, &v) && CELD_AT (h->corrections, u, v))
        return (Gift) { CELD_AT (h->owner, u, v), CELD_AT (h->corrections, u, v) };
    }
  return (Gift) { 0, 0 };
}

/* Places without a gift take that of their neighbour, up to a corner. */
static void
hand_on (const Hand *h, const CeldEdgeLoop *loop)
{
  const CeldEdgePoint *point = &h->pens->edges->point[loop->first];
  Gift                *gift = &h->gift[loop->first];
  size_t               n = loop->n, seen = 0;

  for (size_t i = 0; i < n; i++)
    seen += gift[i].to != 0;
  for (int back = 0; back < 2 && seen; back++)
    for (size_t i = 1; i < 2 * n; i++)
      {
        size_t a = (back ? 2 * n - i : i - 1) % n, b = (back ? 2 * n - i - 1 : i) % n;

        if (gift[a].to && !gift[b].to && !point[a].corner && !point[b].corner)
          gift[b] = gift[a];
      }
}

static CeldStatus
give_behind (const Hand *h, size_t i)
{
  const CeldEdgePoint *p = &h->pens->edges->point[i];
  float                reach = reach_of (h, i);
  CeldStatus           status = CELD_OK;

  for (float depth = STEP / 2; depth < reach && h->gift[i].to && !status; depth += STEP)
    {
      int x, y;

      if (ink_behind (h, p, depth, &x, &y) && CELD_AT (h->owner, x, y) == h->gift[i].from)
        status = give (h, x, y, h->gift[i].to);
    }
  return status;
}

/* The ink below the strokes themselves, within a tile. */
static CeldStatus
give_below (const Hand *h, CeldRect tile)
{
  CeldStatus status = CELD_OK;

  if (!*celd_tile_of (&h->strokes, tile.x, tile.y))
    return CELD_OK;
  for (int y = tile.y; y < tile.y + tile.height && !status; y++)
    for (int x = tile.x; x < tile.x + tile.width && !status; x++)
      if (CELD_AT (h->corrections, x, y) && !celd_is_paper (CELD_AT (h->ink, x, y)))
        status = give (h, x, y, CELD_AT (h->corrections, x, y));
  return status;
}

CeldStatus
celd_pens_correct (const CeldPens *pens, const CeldPlane *ink, const CeldLabels *corrections, CeldLabels *owner,
                   CeldGiven *given)
{
  size_t     n = pens->edges->n_points;
  Hand       h = { pens, ink, corrections, owner, celd_alloc (n + 1, sizeof *h.gift), { 0 }, given };
  CeldStatus status = h.gift ? find_strokes (&h) : CELD_NO_MEMORY;

  for (size_t i = 0; i < n && !status; i++)
    h.gift[i] = look_for_stroke (&h, i);
  for (size_t k = 0; k < pens->edges->n_loops && !status; k++)
    hand_on (&h, &pens->edges->loop[k]);
  for (size_t i = 0; i < n && !status; i++)
    status = give_behind (&h, i);
  for (int ty = 0; ty < h.strokes.down && !status; ty++)
    for (int tx = 0; tx < h.strokes.across && !status; tx++)
      status = give_below (&h, celd_tile_rect (tx, ty, ink->width, ink->height));
  celd_free (h.gift);
  celd_free (h.strokes.at);
  return status;
}

void
celd_given_clear (CeldGiven *given)
{
  celd_free (given->item);
  *given = (CeldGiven) { 0 };
}
