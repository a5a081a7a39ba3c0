/* Pixels without claims: those that are settled before any claim, and those that are left after all claims.
 *
 * Paper belongs to its label, and so do all pixels of a label that is almost wholly ink, like a black shoe with a
 * scribble of its own.  Ink beyond all claims, like areas filled with black, goes to the nearest pixel that has an
 * owner, by breadth-first search over 4-neighbours; ties go to the first neighbour in reading order, so that the order
 * of the list has no influence.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "ownership/ownership.h"

#include <math.h>

#define MIN_INK_RATIO  10 /* a label is solid if less than 1/10 of its pixels are paper; chosen */
#define CORNER_SQUARES 4  /* squared line widths of ink that a label may have about the corners of its paper; chosen */

/* ------------------------------------------------------------------ before claims */

/* Numbers of pixels, of pixels of paper, and of edge points at its paper, of label k at k - 1. */
typedef struct { size_t *all, *paper, *edge_points; } Counts;

static void
count_pixels (const CeldPlane *ink, const CeldLabels *labels, Counts *counts)
{
  for (int y = 0; y < ink->height; y++)
    for (int x = 0, end; x < ink->width; x = end)
      {
        const uint32_t *label = &CELD_AT (labels, 0, y);
        const float    *value = &CELD_AT (ink, 0, y);
        size_t          bright = 0;

        for (end = x; end < ink->width && label[end] == label[x]; end++)
          bright += celd_is_paper (value[end]);
        counts->all[label[x] - 1]   += (size_t) (end - x);
        counts->paper[label[x] - 1] += bright;
      }
}

/* Between thick lines a small piece of paper has far more ink than paper, too, but not more than fits along its
 * edges and about its corners. */
static bool
is_solid (size_t all, size_t paper, size_t edge_points, size_t stroke)
{
  return MIN_INK_RATIO * paper < all && all - paper > stroke * edge_points + CORNER_SQUARES * stroke * stroke
    * (edge_points > 0);
}

CeldStatus
celd_solid_labels_find (const CeldContourPens *pens, const CeldPlane *ink, const CeldLabels *labels, bool *solid)
{
  size_t     n = pens->n, stroke = (size_t) pens->edges->stroke;
  Counts     counts = { celd_alloc0 (n, sizeof *counts.all), celd_alloc0 (n, sizeof *counts.paper),
                       celd_alloc0 (n, sizeof *counts.edge_points) };
  CeldStatus status = counts.all && counts.paper && counts.edge_points ? CELD_OK : CELD_NO_MEMORY;

  if (status == CELD_OK)
    count_pixels (ink, labels, &counts);
  for (size_t i = 0; status == CELD_OK && i < pens->edges->n_points; i++)
    if (pens->pen[i].near)
      counts.edge_points[pens->pen[i].near - 1]++;
  for (size_t k = 0; status == CELD_OK && k < n; k++)
    solid[k] = is_solid (counts.all[k], counts.paper[k], counts.edge_points[k], stroke);
  celd_free (counts.all);
  celd_free (counts.paper);
  celd_free (counts.edge_points);
  return status;
}

void
celd_claims_reset (const CeldClaimMap *c, const CeldLabels *labels, const bool *solid, CeldRect rect)
{
  for (int y = rect.y; y < rect.y + rect.height; y++)
    for (int x = rect.x; x < rect.x + rect.width; x++)
      {
        uint32_t label = CELD_AT (labels, x, y);
        bool     settled = celd_is_paper (CELD_AT (c->ink, x, y)) || solid[label - 1];

        CELD_AT (c->excess, x, y)  = settled ? -INFINITY : INFINITY;
        CELD_AT (c->owner, x, y) = settled ? label : 0;
      }
}

/* ------------------------------------------------------------------ after claims */

int
celd_pixel_neighbours (const CeldPlane *ink, int32_t pixel, int near[4][2])
{
  static const int step[4][2] = { { 0, -1 }, { -1, 0 }, { 1, 0 }, { 0, 1 } };
  int              x = pixel % ink->width, y = pixel / ink->width, n = 0;

  for (int k = 0; k < 4; k++)
    {
      int u = x + step[k][0], v = y + step[k][1];

      if (u >= 0 && v >= 0 && u < ink->width && v < ink->height)
        {
          near[n][0]   = u;
          near[n++][1] = v;
        }
    }
  return n;
}

/* The owner of the first neighbour that has one; 0 if none has. */
static uint32_t
owner_beside (const CeldClaimMap *c, int32_t pixel)
{
  int near[4][2], n = celd_pixel_neighbours (c->ink, pixel, near);

  for (int k = 0; k < n; k++)
    {
      uint32_t owner = CELD_AT (c->owner, near[k][0], near[k][1]);

      if (owner && owner != CELD_OWNER_PENDING)
        return owner;
    }
  return 0;
}

/* Moves the pixels beside an owner to the front of the list, with that owner; returns their number. */
static size_t
owners_first (const CeldClaimMap *c, CeldPixelOwner *rest, size_t n)
{
  size_t first = 0;

  for (size_t i = 0; i < n; i++)
    {
      CeldPixelOwner here = { rest[i].pixel, owner_beside (c, rest[i].pixel) };

      if (here.owner)
        {
          rest[i]       = rest[first];
          rest[first++] = here;
        }
    }
  return first;
}

void
celd_claims_spread (const CeldClaimMap *c, CeldPixelOwner *rest, size_t n)
{
  size_t from = 0, end = owners_first (c, rest, n);

  while (from < end)
    {
      size_t next = end;

      for (size_t i = from; i < end; i++)
        CELD_AT (c->owner, rest[i].pixel % c->ink->width, rest[i].pixel / c->ink->width) = rest[i].owner;
      for (size_t i = from; i < end; i++)
        {
          int near[4][2], k = celd_pixel_neighbours (c->ink, rest[i].pixel, near);

          for (int j = 0; j < k; j++)
            if (!CELD_AT (c->owner, near[j][0], near[j][1]))
              {
                CELD_AT (c->owner, near[j][0], near[j][1]) = CELD_OWNER_PENDING;
                rest[next++].pixel = (int32_t) (near[j][1] * c->ink->width + near[j][0]);
              }
        }
      for (size_t i = end; i < next; i++)
        rest[i].owner = owner_beside (c, rest[i].pixel);
      from = end;
      end  = next;
    }
}

CeldStatus
celd_claims_finish (const CeldClaimMap *c)
{
  size_t          n = 0, room = 0;
  CeldPixelOwner *rest;

  for (int y = 0; y < c->ink->height; y++)
    for (int x = 0; x < c->ink->width; x++)
      room += !CELD_AT (c->owner, x, y);
  rest = celd_alloc (room, sizeof *rest);
  if (!rest)
    return CELD_NO_MEMORY;
  for (int y = 0; y < c->ink->height && n < room; y++)
    for (int x = 0; x < c->ink->width; x++)
      if (!CELD_AT (c->owner, x, y))
        rest[n++].pixel = (int32_t) (y * c->ink->width + x);
  celd_claims_spread (c, rest, n);
  celd_free (rest);
  return CELD_OK;
}
