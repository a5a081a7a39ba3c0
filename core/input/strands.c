/* A connected component of paint taken apart into the strokes that cross in it.
 *
 * The disc of each crossing is cut out; what is left falls into pieces.  Pieces on opposite sides of a crossing are one
 * strand, together with the straight band between them.  So paint of a crossing belongs to both strands.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/unions.h"
#include "image/image.h"
#include "input/arrows.h"
#include "input/trail.h"

#include <math.h>

typedef struct
{
  const CeldTrail *trail;
  CeldCutting      cutting;
  CeldCrossing    *crossing;
  size_t           n_crossings, n_pieces;
  CeldLabels       pieces;     /* of the cutting, from 1; 0 = not painted, or in a crossing */
  CeldComponent   *piece;
  uint32_t        *parent;     /* of piece k - 1: union-find of strands */
} Knot;

static void
knot_end (Knot *k)
{
  celd_cutting_clear (&k->cutting);
  celd_free (k->crossing);
  celd_free (k->pieces.data);
  celd_free (k->piece);
  celd_free (k->parent);
}

CeldStatus
celd_cutting_new (const CeldTrail *trail, CeldCutting *cutting)
{
  CeldCutting c = { .left = trail->width, .top = trail->height };
  int         right = 0, bottom = 0;
  uint8_t    *bare;
  size_t      n;
  CeldStatus  status = CELD_NO_MEMORY;

  for (size_t i = 0; i < trail->n; i++)
    {
      int x = celd_trail_x (trail, trail->pixel[i]), y = celd_trail_y (trail, trail->pixel[i]);

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
      for (size_t i = 0; i < trail->n; i++)
        {
          int    x = celd_trail_x (trail, trail->pixel[i]) - c.left;
          int    y = celd_trail_y (trail, trail->pixel[i]) - c.top;
          size_t p = (size_t) y * (size_t) c.width + (size_t) x;

          c.painted[p] = 1;
          bare[p]      = 0;
        }
      status = celd_distance (c.width, c.height, bare, NULL, c.squared);
    }
  celd_free (bare);
  if (status == CELD_OK)
    *cutting = c;
  else
    celd_cutting_clear (&c);
  return status;
}

void
celd_cutting_clear (CeldCutting *cutting)
{
  celd_free (cutting->painted);
  celd_free (cutting->squared);
  *cutting = (CeldCutting) { 0 };
}

static bool
in_disc (const CeldCrossing *x, CeldPoint p)
{
  return hypot (p.x - x->centre.x, p.y - x->centre.y) <= x->radius;
}

/* The paint without the discs of crossings. */
static CeldStatus
find_pieces (Knot *k)
{
  CeldCutting *c = &k->cutting;
  CeldStatus   status = celd_labels_new (c->width, c->height, &k->pieces);

  if (status != CELD_OK)
    return status;
  for (size_t p = 0; p < (size_t) c->width * (size_t) c->height; p++)
    k->pieces.data[p] = c->painted[p];
  for (size_t i = 0; i < k->n_crossings; i++)
    {
      const CeldCrossing *x = &k->crossing[i];

      for (int y = (int) fmax (0, x->centre.y - x->radius - 1); y < c->height && y <= x->centre.y + x->radius; y++)
        for (int px = (int) fmax (0, x->centre.x - x->radius - 1); px < c->width && px <= x->centre.x + x->radius; px++)
          if (in_disc (x, (CeldPoint) { px + 0.5, y + 0.5 }))
            CELD_AT (&k->pieces, px, y) = 0;
    }
  status = celd_components (&k->pieces, 0, true, NULL, &k->pieces, &k->piece, &k->n_pieces);
  if (status == CELD_OK && !(k->parent = celd_alloc (k->n_pieces + 1, sizeof *k->parent)))
    status = CELD_NO_MEMORY;
  for (uint32_t i = 0; status == CELD_OK && i < k->n_pieces; i++)
    k->parent[i] = i;
  return status;
}

/* The piece just beyond an arm; 0 if there is none. */
static uint32_t
piece_at (const Knot *k, const CeldCrossing *x, int arm)
{
  for (double s = 1; s < 1.5; s += 0.5 / x->radius)
    {
      double px = x->centre.x + s * (x->arm[arm].x - x->centre.x), py = x->centre.y + s * (x->arm[arm].y - x->centre.y);

      if (px >= 0 && py >= 0 && px < k->cutting.width && py < k->cutting.height &&
          CELD_AT (&k->pieces, (int) px, (int) py))
        return CELD_AT (&k->pieces, (int) px, (int) py);
    }
  return 0;
}

/* Joins the pieces that cross over each other. */
static void
join_pieces (Knot *k)
{
  for (size_t i = 0; i < k->n_crossings; i++)
    for (int arm = 0; arm < 2; arm++)
      {
        uint32_t a = piece_at (k, &k->crossing[i], arm), b = piece_at (k, &k->crossing[i], arm + 2);

        if (a && b)
          celd_join (k->parent, celd_root (k->parent, a - 1), celd_root (k->parent, b - 1));
      }
}

/* Does the band from an arm to the opposite one cover a pixel? */
static bool
in_band (const CeldCrossing *x, int arm, CeldPoint p)
{
  CeldPoint a = x->arm[arm], b = x->arm[arm + 2];
  double    length = hypot (b.x - a.x, b.y - a.y), half = 0.25 * (x->breadth[arm] + x->breadth[arm + 2]) + 0.5;

  return fabs ((p.x - a.x) * (b.y - a.y) - (p.y - a.y) * (b.x - a.x)) <= half * length;
}

/* Is a pixel of the strand in a crossing of it? */
static bool
crosses_at (Knot *k, uint32_t strand, CeldPoint p)
{
  for (size_t i = 0; i < k->n_crossings; i++)
    for (int arm = 0; arm < 2 && in_disc (&k->crossing[i], p); arm++)
      {
        uint32_t piece = piece_at (k, &k->crossing[i], arm);

        if (piece && celd_root (k->parent, piece - 1) == strand && in_band (&k->crossing[i], arm, p))
          return true;
      }
  return false;
}

/* Appends the pixels of a strand, in reading order. */
static CeldStatus
add_strand (Knot *k, uint32_t strand, CeldStrands *to)
{
  const CeldCutting *c = &k->cutting;
  size_t             n = to->first[to->n], row = (size_t) k->trail->width + 2;

  for (int y = 0; y < c->height; y++)
    for (int x = 0; x < c->width; x++)
      {
        uint32_t  piece = CELD_AT (&k->pieces, x, y);
        uint32_t *item;

        if (piece ? celd_root (k->parent, piece - 1) != strand
                  : !c->painted[(size_t) y * (size_t) c->width + (size_t) x] ||
                    !crosses_at (k, strand, (CeldPoint) { x + 0.5, y + 0.5 }))
          continue;
        item = celd_grow (to->pixel, n + 1, sizeof *item);
        if (!item)
          return CELD_NO_MEMORY;
        to->pixel = item;
        item[n++] = (uint32_t) ((size_t) (y + c->top + 1) * row + (size_t) (x + c->left + 1));
      }
  to->first[++to->n] = n;
  return CELD_OK;
}

CeldStatus
celd_strands_find (const CeldTrail *trail, CeldStrands *strands)
{
  Knot        knot = { .trail = trail };
  CeldStrands made = { 0 };
  CeldStatus  status = celd_cutting_new (trail, &knot.cutting);

  if (status == CELD_OK)
    status = celd_crossings_find (&knot.cutting, &knot.crossing, &knot.n_crossings);
  if (status == CELD_OK && knot.n_crossings)
    {
      status = find_pieces (&knot);
      if (status == CELD_OK && !(made.first = celd_alloc0 (knot.n_pieces + 1, sizeof *made.first)))
        status = CELD_NO_MEMORY;
      if (status == CELD_OK)
        join_pieces (&knot);
      for (uint32_t i = 0; status == CELD_OK && i < knot.n_pieces; i++)
        if (celd_root (knot.parent, i) == i)
          status = add_strand (&knot, i, &made);
    }
  knot_end (&knot);
  if (status == CELD_OK)
    *strands = made;
  else
    celd_strands_clear (&made);
  return status;
}

void
celd_strands_clear (CeldStrands *strands)
{
  celd_free (strands->pixel);
  celd_free (strands->first);
  *strands = (CeldStrands) { 0 };
}
