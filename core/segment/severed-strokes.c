/* Strokes that other paint or ink cut in two: by what was painted later the artist still means one stroke.
 *
 * From the outline of each stroke rays run on in eight directions: over other paint as far as a stroke that crosses may
 * be wide, and over ink as far as a contour may.  Where a ray meets the same label, both sides are one stroke.
 *
 * Cost: the outlines of the strokes; rays end at once on unpainted paper, which is nearly everywhere.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "image/image.h"
#include "segment/basins.h"
#include "segment/task.h"

#define CROSSING 3 /* brush widths of other paint between the two sides, at most: the brush, aslant (chosen) */
#define CONTOUR  2 /* stroke widths of ink between them, at most (chosen) */

typedef struct
{
  const CeldSegmentTask *task;
  const CeldStrokes     *strokes;
  int                    most_paint, most_ink; /* pixels that a ray may pass */
  size_t                *row;                  /* of row y: its pieces are piece[row[y]] .. piece[row[y + 1] - 1] */
  uint32_t              *parent;               /* of each stroke: a disjoint-set forest (base/base.h) */
} StrokeJoiner;

/* The piece of the pixel (x,y); NULL: none. */
static const CeldStrokePiece *
piece_at (const StrokeJoiner *j, int x, int y)
{
  const CeldStrokePiece *piece = j->strokes->piece;
  size_t                 low = j->row[y], high = j->row[y + 1];

  while (low < high)
    {
      size_t middle = (low + high) / 2;

      if (piece[middle].end <= x)
        low = middle + 1;
      else
        high = middle;
    }
  return low < j->row[y + 1] && piece[low].x <= x ? &piece[low] : NULL;
}

/* Follows the ray from pixel (x,y) of the piece, and joins its stroke with the one of its label beyond. */
static void
follow_ray (StrokeJoiner *j, const CeldStrokePiece *piece, int x, int y, int dx, int dy)
{
  const CeldPlane *ink = j->task->ink;
  int              paint = 0, lines = 0;

  for (x += dx, y += dy; x >= 0 && x < ink->width && y < ink->height; x += dx, y += dy)
    {
      const CeldStrokePiece *here = piece_at (j, x, y);

      if (here && here->label == piece->label)
        {
          celd_join (j->parent, piece->stroke, here->stroke);
          return;
        }
      paint += here != NULL;
      lines += !here;
      if ((!here && celd_is_paper (CELD_AT (ink, x, y))) || paint > j->most_paint || lines > j->most_ink)
        return;
    }
}

/* Follows the rays that leave a piece to the right and downwards; the others leave the stroke beyond. */
static void
follow_piece (StrokeJoiner *j, const CeldStrokePiece *piece)
{
  follow_ray (j, piece, piece->end - 1, piece->y, 1, 0);
  if (piece->y + 1 == j->task->ink->height)
    return;
  for (int x = piece->x; x < piece->end; x++)
    {
      const CeldStrokePiece *below = piece_at (j, x, piece->y + 1);

      if (below && below->label == piece->label && x > below->x && x < below->end - 1) /* not at the outline */
        {
          x = below->end - 2;
          continue;
        }
      for (int dx = -1; dx <= 1; dx++)
        follow_ray (j, piece, x, piece->y, dx, 1);
    }
}

/* Renumbers the strokes from 0 in the order of their first pieces. */
static void
renumber (StrokeJoiner *j, CeldStrokes *strokes)
{
  size_t n = 0;

  for (uint32_t k = 0; k < strokes->n_strokes; k++)
    j->parent[k] = celd_root (j->parent, k);
  for (uint32_t k = 0; k < strokes->n_strokes; k++) /* a root is the least of its set and has its number already */
    j->parent[k] = j->parent[k] == k ? (uint32_t) n++ : j->parent[j->parent[k]];
  for (size_t i = 0; i < strokes->n_pieces; i++)
    strokes->piece[i].stroke = j->parent[strokes->piece[i].stroke];
  strokes->n_strokes = n;
  celd_strokes_sum (j->task->basins, strokes);
}

CeldStatus
celd_strokes_join_severed (const CeldSegmentTask *task, CeldStrokes *strokes)
{
  size_t       height = (size_t) task->ink->height;
  StrokeJoiner j = {
    .task = task, .strokes = strokes, .most_paint = (int) (CROSSING * task->brush),
    .most_ink = CONTOUR * task->basins->stroke, .row = celd_alloc0 (height + 1, sizeof *j.row),
    .parent = celd_alloc (strokes->n_strokes, sizeof *j.parent),
  };
  bool         enough = j.row && j.parent;

  if (enough)
    {
      celd_roots (j.parent, strokes->n_strokes);
      for (size_t i = 0; i < strokes->n_pieces; i++)
        j.row[strokes->piece[i].y + 1]++;
      for (size_t y = 1; y <= height; y++)
        j.row[y] += j.row[y - 1];
      for (size_t i = 0; i < strokes->n_pieces; i++)
        follow_piece (&j, &strokes->piece[i]);
      renumber (&j, strokes);
    }
  celd_free (j.row);
  celd_free (j.parent);
  return enough ? CELD_OK : CELD_NO_MEMORY;
}
