/* The tiles in which an edit may change contour ownership.
 *
 * Pens are measured everywhere, which is cheap, and compared: tiles are marked that a claim touches which is new or
 * does not exist any more, in which labels settle other pixels without claims than before, and in which labels have
 * claims that have changed their order in depth.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "ownership/ownership.h"

#include <math.h>

#define CLAIM_AND_COVERAGE (CELD_TILE_CLAIM | CELD_TILE_COVERAGE)
#define NARROW_COSINE      0.9f  /* cosine between the sides of a band that hardly widens; chosen */
#define NARROW_MARGIN      0.03f /* relative to its length, how far such a band may extend beyond its sides; chosen */

static float
min (float a, float b)
{
  return a < b ? a : b;
}

static float
max (float a, float b)
{
  return a > b ? a : b;
}

/* The tiles round two rays of this length. */
static CeldTileSpan
span_of (const CeldTiles *tiles, const CeldRay *a, const CeldRay *b, float length, float margin)
{
  float ax = a->x + length * a->nx, ay = a->y + length * a->ny, bx = b->x + length * b->nx, by = b->y + length * b->ny;

  return celd_tile_span (tiles, min (min (a->x, b->x), min (ax, bx)) - margin,
                         min (min (a->y, b->y), min (ay, by)) - margin,
                         max (max (a->x, b->x), max (ax, bx)) + margin,
                         max (max (a->y, b->y), max (ay, by)) + margin);
}

/* Splits long lines, so that a slanting line does not mark a large square. */
static int
line_tiles (const CeldPlane *ink, const CeldTiles *tiles, const CeldClaim *line,
            CeldTileSpan span[CELD_MAX_CLAIM_SPANS])
{
  float length = celd_claim_line_length (ink, line), piece = max (CELD_TILE, length / (CELD_MAX_CLAIM_SPANS - 1)),
                 from = 0;
  int   n = 0;

  for (; from < length && n < CELD_MAX_CLAIM_SPANS; from += piece)
    {
      CeldRay a = celd_claim_line_at (line, from), b = celd_claim_line_at (line, min (from + piece, length));

      span[n++] = span_of (tiles, &a, &b, line->width, 1);
    }
  return n;
}

int
celd_claim_tiles (const CeldPlane *ink, const CeldTiles *tiles, const CeldClaim *claim,
                  CeldTileSpan span[CELD_MAX_CLAIM_SPANS])
{
  const CeldRay *a = &claim->from, *b = &claim->to;
  bool           narrow = a->nx * b->nx + a->ny * b->ny > NARROW_COSINE;

  if (claim->shape == CELD_CLAIM_LINE)
    return line_tiles (ink, tiles, claim, span);
  if (claim->shape == CELD_CLAIM_BAND)
    span[0] = span_of (tiles, a, b, claim->length, 1 + (narrow ? NARROW_MARGIN : 1) * claim->length);
  else
    span[0] = span_of (tiles, a, a, 0, claim->width + 1);
  return 1;
}

/* ------------------------------------------------------------------ pixels that are settled without claims */

static void
compare_pixels (const CeldOwnershipCache *kept, const CeldOwnershipInput *in, CeldRect rect, const bool *solid,
                CeldTiles *tiles)
{
  for (int y = rect.y; y < rect.y + rect.height; y++)
    for (int x = rect.x; x < rect.x + rect.width; x++)
      {
        uint32_t label = CELD_AT (in->labels, x, y);
        bool     was_settled = CELD_AT (&kept->excess, x, y) == -INFINITY;
        bool     settled = celd_is_paper (CELD_AT (in->ink, x, y)) || solid[label - 1];

        if (settled != was_settled || (settled && CELD_AT (&kept->owner, x, y) != label))
          *celd_tile_of (tiles, x, y) |= CLAIM_AND_COVERAGE;
      }
}

/* The whole picture if a label has become solid or has ceased to be solid. */
static CeldRect
changed_labels (const CeldOwnershipCache *kept, const CeldOwnershipInput *in, CeldRect new_labels, const bool *solid)
{
  for (size_t k = 0; k < in->n; k++)
    if (solid[k] != (k < kept->pens.n && kept->solid[k]))
      return (CeldRect) { 0, 0, in->ink->width, in->ink->height };
  return new_labels;
}

/* ------------------------------------------------------------------ claims */

static void
mark_claims (const CeldPlane *ink, const CeldClaim *claim, size_t n, CeldTiles *tiles)
{
  for (size_t i = 0; i < n; i++)
    {
      CeldTileSpan span[CELD_MAX_CLAIM_SPANS];
      int          m = celd_claim_tiles (ink, tiles, &claim[i], span);

      for (int j = 0; j < m; j++)
        celd_tiles_mark (tiles, span[j], CLAIM_AND_COVERAGE);
    }
}

static void
compare_claims (const CeldPlane *ink, const CeldContourPens *old, const CeldContourPens *new, CeldTiles *tiles)
{
  for (size_t k = 0; k < new->edges->n_loops; k++)
    {
      const CeldEdgeLoop *loop = &new->edges->loop[k];

      if (!memcmp (old->pen + loop->first, new->pen + loop->first, loop->n * sizeof *new->pen))
        continue;
      for (size_t i = 0; i < loop->n; i++)
        {
          CeldClaim before[CELD_MAX_CLAIMS], after[CELD_MAX_CLAIMS];
          size_t    n = celd_claims_at_point (old, loop, i, before), m = celd_claims_at_point (new, loop, i, after);

          if (n == m && !memcmp (before, after, n * sizeof *after))
            continue;
          mark_claims (ink, before, n, tiles);
          mark_claims (ink, after, m, tiles);
        }
    }
}

/* ------------------------------------------------------------------ labels that change their order */

/* Lists the labels with claims in each tile. */
static void
list_claim (const CeldPlane *ink, const CeldTiles *tiles, const CeldClaim *claim, CeldLabelList *list)
{
  CeldTileSpan span[CELD_MAX_CLAIM_SPANS];
  int          n = celd_claim_tiles (ink, tiles, claim, span);

  for (int i = 0; i < n; i++)
    for (int y = span[i].top; y <= span[i].bottom; y++)
      for (int x = span[i].left; x <= span[i].right; x++)
        celd_label_list_add (claim->label, &list[(size_t) y * (size_t) tiles->across + (size_t) x]);
}

static void
list_claimants (const CeldPlane *ink, const CeldContourPens *pens, const CeldTiles *tiles, CeldLabelList *list)
{
  for (size_t k = 0; k < pens->edges->n_loops; k++)
    for (size_t i = 0; i < pens->edges->loop[k].n; i++)
      {
        CeldClaim claim[CELD_MAX_CLAIMS];
        size_t    n = celd_claims_at_point (pens, &pens->edges->loop[k], i, claim);

        for (size_t j = 0; j < n; j++)
          list_claim (ink, tiles, &claim[j], list);
      }
}

static CeldStatus
compare_orders (const CeldPlane *ink, const CeldContourPens *old, const CeldContourPens *new, CeldTiles *tiles)
{
  size_t         n = (size_t) tiles->across * (size_t) tiles->down;
  CeldLabelList *list;

  if (old->n == new->n && !memcmp (old->level, new->level, new->n * sizeof *new->level))
    return CELD_OK;
  list = celd_alloc0 (n, sizeof *list);
  if (!list)
    return CELD_NO_MEMORY;
  list_claimants (ink, new, tiles, list);
  for (size_t i = 0; i < n; i++)
    if (celd_label_order_changed (&list[i], old, new))
      tiles->at[i] |= CLAIM_AND_COVERAGE;
  celd_free (list);
  return CELD_OK;
}

CeldStatus
celd_ownership_mark_changes (const CeldOwnershipCache *kept, const CeldOwnershipInput *input, CeldRect new_labels,
                             const CeldContourPens *pens, const bool *solid, CeldTiles *tiles)
{
  compare_pixels (kept, input, changed_labels (kept, input, new_labels, solid), solid, tiles);
  compare_claims (input->ink, &kept->pens, pens, tiles);
  return compare_orders (input->ink, &kept->pens, pens, tiles);
}
