/* Pieces of lines in one colour, and whose they are: of the label of whose paper nearly all points along a piece find it
 * to be a shade (line-shades.c).
 *
 * A piece is drawn with one pen without a change of colour, so it has one owner, also where it has no paper of that
 * beside it, as between two other lines.
 *
 * Cost: O(pixels), 8 bytes a pixel, of which 4 are kept.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "ownership/ownership.h"

#include <math.h>
#include <stdlib.h>

#define ONE_COLOUR  4 /* of 255: what a channel may differ between neighbours in a piece; chosen */
#define EDGE_STEP   0.5f /* pixels between looks at the edge of a piece; chosen: no pixel is missed */
#define LEAST_SAYING 8 /* points for an owner; chosen */

/* ------------------------------------------------------------------ pieces */

static bool
are_alike (const uint8_t *a, const uint8_t *b)
{
  return abs (a[0] - b[0]) <= ONE_COLOUR && abs (a[1] - b[1]) <= ONE_COLOUR && abs (a[2] - b[2]) <= ONE_COLOUR;
}

/* Joins neighbours of ink that are alike: sets of pixels, each numbered y * width + x. */
static void
join_alike (const CeldPaint *colours, const CeldPlane *ink, uint32_t *set)
{
  uint32_t width = (uint32_t) ink->width, p = 0;

  celd_roots (set, (size_t) ink->width * (size_t) ink->height);
  for (int y = 0; y < ink->height; y++)
    for (int x = 0; x < ink->width; x++, p++)
      {
        const uint8_t *here = CELD_RGBA (colours, x, y);

        if (celd_is_paper (CELD_AT (ink, x, y)))
          continue;
        if (x > 0 && !celd_is_paper (CELD_AT (ink, x - 1, y)) && are_alike (here, CELD_RGBA (colours, x - 1, y)))
          celd_join (set, p, p - 1);
        if (y > 0 && !celd_is_paper (CELD_AT (ink, x, y - 1)) && are_alike (here, CELD_RGBA (colours, x, y - 1)))
          celd_join (set, p, p - width);
      }
}

/* Numbers the pieces with a point whose shade is known, from 1, in edges->piece; that of all other pixels becomes 0. */
static CeldStatus
number_pieces (uint32_t *set, CeldContourEdges *edges)
{
  size_t    pixels = (size_t) edges->width * (size_t) edges->height;
  uint32_t *number = celd_alloc0 (pixels, sizeof *number);

  if (!number)
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < edges->n_points; i++)
    {
      CeldEdgePoint *p = &edges->point[i];
      uint32_t      *of_set;

      if (p->shade == CELD_SHADE_UNKNOWN)
        continue;
      of_set = &number[celd_root (set, celd_shade_pixel (edges, p))];
      if (!*of_set)
        *of_set = ++edges->n_pieces;
      p->piece = *of_set;
    }
  for (size_t i = pixels; i-- > 0;) /* a root is the smallest pixel of its set, and numbered last */
    number[i] = number[celd_root (set, (uint32_t) i)];
  edges->piece = number;
  return CELD_OK;
}

/* Adds the antialiased pixels between the paper beside a piece and the piece, which have colours of their own. */
static void
add_edges (const CeldPlane *ink, CeldContourEdges *edges)
{
  for (size_t i = 0; i < edges->n_points; i++)
    {
      const CeldEdgePoint *p = &edges->point[i];

      for (float along = EDGE_STEP / 2; p->piece && along < CELD_INK_FADES; along += EDGE_STEP)
        {
          int       x = celd_floor (p->x + along * p->nx), y = celd_floor (p->y + along * p->ny);
          uint32_t *piece = &edges->piece[(size_t) y * (size_t) edges->width + (size_t) x];

          if (!*piece && !celd_is_paper (CELD_AT (ink, x, y)))
            *piece = p->piece;
        }
    }
}

CeldStatus
celd_line_pieces_find (const CeldPaint *colours, const CeldPlane *ink, CeldContourEdges *edges)
{
  uint32_t  *set = celd_alloc ((size_t) ink->width * (size_t) ink->height, sizeof *set);
  CeldStatus status = CELD_NO_MEMORY;

  if (set)
    {
      join_alike (colours, ink, set);
      status = number_pieces (set, edges);
      if (status == CELD_OK)
        add_edges (ink, edges);
    }
  celd_free (set);
  return status;
}

/* ------------------------------------------------------------------ owners */

typedef struct { uint32_t piece, label; } Vote;

static int
compare_votes (const void *a, const void *b)
{
  const Vote *u = a, *v = b;

  return u->piece != v->piece ? (u->piece > v->piece) - (u->piece < v->piece)
                              : (u->label > v->label) - (u->label < v->label);
}

/* Lists the votes of all points, sorted; returns their number. */
static size_t
list_votes (const CeldContourPens *pens, Vote *vote)
{
  size_t n = 0;

  for (size_t i = 0; i < pens->edges->n_points; i++)
    {
      const CeldEdgePoint *p = &pens->edges->point[i];
      const CeldEdgePen   *pen = &pens->pen[i];

      if (p->piece && pen->near && pen->far)
        vote[n++] = (Vote) { p->piece, p->shade == CELD_SHADE_NEAR ? pen->near : pen->far };
    }
  qsort (vote, n, sizeof *vote, compare_votes);
  return n;
}

/* owner[k] becomes the label for which three of four votes for piece k are, if these are enough; else it stays 0. */
static void
count_votes (const Vote *vote, size_t n, uint32_t *owner)
{
  for (size_t first = 0, end; first < n; first = end)
    {
      size_t   most = 0, same = 0;
      uint32_t best = 0;

      for (end = first; end < n && vote[end].piece == vote[first].piece; end++)
        {
          same = end > first && vote[end].label == vote[end - 1].label ? same + 1 : 1;
          if (same > most)
            {
              most = same;
              best = vote[end].label;
            }
        }
      if (most >= LEAST_SAYING && 4 * most >= 3 * (end - first))
        owner[vote[first].piece] = best;
    }
}

/* Gives the pixels of pieces to their owners. */
static CeldStatus
give_pieces (const CeldContourEdges *edges, const uint32_t *of_piece, const CeldPlane *excess, CeldLabels *owner,
             CeldReassigned *reassigned)
{
  CeldStatus status = CELD_OK;
  int32_t    p = 0;

  for (int y = 0; y < owner->height; y++)
    for (int x = 0; x < owner->width && status == CELD_OK; x++, p++)
      {
        uint32_t  label = of_piece[edges->piece[p]];
        uint32_t *own = &CELD_AT (owner, x, y);

        if (!label || label == *own || CELD_AT (excess, x, y) == -INFINITY)
          continue;
        status = celd_append (reassigned->item, reassigned->n, reassigned->capacity, ((CeldPixelOwner) { p, *own }));
        if (status == CELD_OK)
          *own = label;
      }
  return status;
}

CeldStatus
celd_line_pieces_give (const CeldContourPens *pens, const CeldPlane *excess, CeldLabels *owner,
                       CeldReassigned *reassigned)
{
  const CeldContourEdges *edges = pens->edges;
  Vote                   *vote;
  uint32_t               *of_piece;
  CeldStatus              status = CELD_NO_MEMORY;

  if (!edges->piece)
    return CELD_OK;
  vote     = celd_alloc (edges->n_points, sizeof *vote);
  of_piece = celd_alloc0 (edges->n_pieces + 1, sizeof *of_piece);
  if (vote && of_piece)
    {
      count_votes (vote, list_votes (pens, vote), of_piece);
      status = give_pieces (edges, of_piece, excess, owner, reassigned);
    }
  celd_free (vote);
  celd_free (of_piece);
  return status;
}
