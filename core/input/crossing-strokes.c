/* Separates a connected component of paint into the strokes that cross in it.
 *
 * Without the discs around its crossings the component falls into pieces.  Pieces on opposite sides of a crossing are
 * one stroke, together with the straight band between them, so that the paint of a crossing belongs to both strokes.
 *
 * Cost: a distance transform of the component's box, and a pass over it for each stroke.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/arrows.h"

#include <math.h>

typedef struct
{
  const CeldArrowStroke *stroke;     /* the component */
  CeldStrokeMask         mask;
  CeldStrokeCrossing    *crossing;
  size_t                 n_crossings, n_pieces;
  CeldLabels             pieces;     /* of the mask, from 1; 0 = not painted, or in a crossing */
  CeldLabels             discs;      /* of the mask: the crossing that a painted pixel is in, from 1; they are disjoint */
  CeldComponent         *piece;
  uint32_t              *parent;     /* of piece k - 1: union-find of strokes */
} Pieces;

static void
pieces_clear (Pieces *p)
{
  celd_stroke_mask_clear (&p->mask);
  celd_free (p->crossing);
  celd_free (p->pieces.data);
  celd_free (p->discs.data);
  celd_free (p->piece);
  celd_free (p->parent);
}

CeldStatus
celd_stroke_mask_new (const CeldArrowStroke *stroke, CeldStrokeMask *mask)
{
  CeldStrokeMask c = { .left = stroke->width, .top = stroke->height };
  int            right = 0, bottom = 0;
  uint8_t       *bare;
  size_t         n;
  CeldStatus     status = CELD_NO_MEMORY;

  for (size_t i = 0; i < stroke->n; i++)
    {
      int x = celd_stroke_x (stroke, stroke->pixel[i]), y = celd_stroke_y (stroke, stroke->pixel[i]);

      c.left = x < c.left ? x : c.left;
      c.top  = y < c.top ? y : c.top;
      right  = x > right ? x : right;
      bottom = y > bottom ? y : bottom;
    }
  c.left--;
  c.top--;
  c.width   = right - c.left + 2;
  c.height  = bottom - c.top + 2;
  n         = (size_t) c.width * (size_t) c.height;
  c.painted = celd_alloc0 (n, 1);
  c.squared = celd_alloc (n, sizeof *c.squared);
  bare      = celd_alloc (n, 1);
  if (c.painted && c.squared && bare)
    {
      memset (bare, 1, n);
      for (size_t i = 0; i < stroke->n; i++)
        {
          int    x = celd_stroke_x (stroke, stroke->pixel[i]) - c.left;
          int    y = celd_stroke_y (stroke, stroke->pixel[i]) - c.top;
          size_t p = (size_t) y * (size_t) c.width + (size_t) x;

          c.painted[p] = 1;
          bare[p]      = 0;
        }
      status = celd_distance (c.width, c.height, bare, NULL, c.squared);
    }
  celd_free (bare);
  if (status == CELD_OK)
    *mask = c;
  else
    celd_stroke_mask_clear (&c);
  return status;
}

void
celd_stroke_mask_clear (CeldStrokeMask *mask)
{
  celd_free (mask->painted);
  celd_free (mask->squared);
  *mask = (CeldStrokeMask) { 0 };
}

static bool
in_disc (const CeldStrokeCrossing *x, CeldPoint p)
{
  return hypot (p.x - x->centre.x, p.y - x->centre.y) <= x->radius;
}

/* The connected components of the paint without the discs of crossings. */
static CeldStatus
find_pieces (Pieces *p)
{
  const CeldStrokeMask *c = &p->mask;
  CeldStatus            status = celd_labels_new (c->width, c->height, &p->pieces);

  if (status == CELD_OK)
    status = celd_labels_new (c->width, c->height, &p->discs);
  if (status != CELD_OK)
    return status;
  for (size_t i = 0; i < (size_t) c->width * (size_t) c->height; i++)
    p->pieces.data[i] = c->painted[i];
  for (size_t i = 0; i < p->n_crossings; i++)
    {
      const CeldStrokeCrossing *crossing = &p->crossing[i];
      CeldPoint                 o = crossing->centre;
      double                    radius = crossing->radius;

      for (int y = (int) fmax (0, o.y - radius - 1); y < c->height && y <= o.y + radius; y++)
        for (int x = (int) fmax (0, o.x - radius - 1); x < c->width && x <= o.x + radius; x++)
          if (CELD_AT (&p->pieces, x, y) && in_disc (crossing, (CeldPoint) { x + 0.5, y + 0.5 }))
            {
              CELD_AT (&p->pieces, x, y) = 0;
              CELD_AT (&p->discs, x, y)  = (uint32_t) i + 1;
            }
    }
  status = celd_components (&p->pieces, 0, true, NULL, &p->pieces, &p->piece, &p->n_pieces);
  if (status == CELD_OK && !(p->parent = celd_alloc (p->n_pieces + 1, sizeof *p->parent)))
    status = CELD_NO_MEMORY;
  for (uint32_t i = 0; status == CELD_OK && i < p->n_pieces; i++)
    p->parent[i] = i;
  return status;
}

/* The piece beyond an arm, within half a radius of the circle; 0 if there is none. */
static uint32_t
piece_at (const Pieces *p, const CeldStrokeCrossing *x, int arm)
{
  for (double s = 1; s < 1.5; s += 0.5 / x->radius)
    {
      double px = x->centre.x + s * (x->arm[arm].x - x->centre.x), py = x->centre.y + s * (x->arm[arm].y - x->centre.y);

      if (px >= 0 && py >= 0 && px < p->mask.width && py < p->mask.height &&
          CELD_AT (&p->pieces, (int) px, (int) py))
        return CELD_AT (&p->pieces, (int) px, (int) py);
    }
  return 0;
}

/* Joins pieces that are opposite each other at a crossing. */
static void
join_pieces (Pieces *p)
{
  for (size_t i = 0; i < p->n_crossings; i++)
    for (int arm = 0; arm < 2; arm++)
      {
        uint32_t a = piece_at (p, &p->crossing[i], arm), b = piece_at (p, &p->crossing[i], arm + 2);

        if (a && b)
          celd_join (p->parent, celd_root (p->parent, a - 1), celd_root (p->parent, b - 1));
      }
}

/* Does the band from an arm to the opposite one cover a pixel? */
static bool
in_band (const CeldStrokeCrossing *x, int arm, CeldPoint p)
{
  CeldPoint a = x->arm[arm], b = x->arm[arm + 2];
  double    length = hypot (b.x - a.x, b.y - a.y), half = 0.25 * (x->breadth[arm] + x->breadth[arm + 2]) + 0.5;

  return fabs ((p.x - a.x) * (b.y - a.y) - (p.y - a.y) * (b.x - a.x)) <= half * length;
}

/* Is a pixel in a crossing, on the band of the stroke whose pieces have this root? */
static bool
crosses_at (Pieces *p, uint32_t root, int x, int y)
{
  const CeldStrokeCrossing *crossing = &p->crossing[CELD_AT (&p->discs, x, y) - 1];

  for (int arm = 0; arm < 2; arm++)
    {
      uint32_t piece = piece_at (p, crossing, arm);

      if (piece && celd_root (p->parent, piece - 1) == root && in_band (crossing, arm, (CeldPoint) { x + 0.5, y + 0.5 }))
        return true;
    }
  return false;
}

/* Appends the pixels of the stroke whose pieces have this root, in reading order. */
static CeldStatus
add_stroke (Pieces *p, uint32_t root, CeldCrossingStrokes *to)
{
  const CeldStrokeMask *c = &p->mask;
  size_t                n = to->first[to->n], row = (size_t) p->stroke->width + 2;

  for (int y = 0; y < c->height; y++)
    for (int x = 0; x < c->width; x++)
      {
        uint32_t piece = CELD_AT (&p->pieces, x, y);

        if (piece ? celd_root (p->parent, piece - 1) != root
                  : !CELD_AT (&p->discs, x, y) || !crosses_at (p, root, x, y))
          continue;
        if (celd_append (to->pixel, n, to->pixel_capacity,
                         (uint32_t) ((size_t) (y + c->top + 1) * row + (size_t) (x + c->left + 1))) != CELD_OK)
          return CELD_NO_MEMORY;
      }
  to->first[++to->n] = n;
  return CELD_OK;
}

CeldStatus
celd_crossing_strokes_find (const CeldArrowStroke *component, CeldCrossingStrokes *strokes)
{
  Pieces              pieces = { .stroke = component };
  CeldCrossingStrokes made = { 0 };
  CeldStatus          status = celd_stroke_mask_new (component, &pieces.mask);

  if (status == CELD_OK)
    status = celd_stroke_crossings_find (&pieces.mask, &pieces.crossing, &pieces.n_crossings);
  if (status == CELD_OK && pieces.n_crossings)
    {
      status = find_pieces (&pieces);
      if (status == CELD_OK && !(made.first = celd_alloc0 (pieces.n_pieces + 1, sizeof *made.first)))
        status = CELD_NO_MEMORY;
      if (status == CELD_OK)
        join_pieces (&pieces);
      for (uint32_t i = 0; status == CELD_OK && i < pieces.n_pieces; i++)
        if (celd_root (pieces.parent, i) == i)
          status = add_stroke (&pieces, i, &made);
    }
  pieces_clear (&pieces);
  if (status == CELD_OK)
    *strokes = made;
  else
    celd_crossing_strokes_clear (&made);
  return status;
}

void
celd_crossing_strokes_clear (CeldCrossingStrokes *strokes)
{
  celd_free (strokes->pixel);
  celd_free (strokes->first);
  *strokes = (CeldCrossingStrokes) { 0 };
}
