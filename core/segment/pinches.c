/* Where the two lines of a narrow region touch, so that its paper falls into parts.
 *
 * In a drawing with lines one pixel wide, like a sprite, a narrow region is a row of parts of a few pixels, and the
 * artist's stroke lies in some of them.  From part to part the way leads lengthwise through the ink, not across a line:
 * there the region's two lines are one, they part again on both sides, and beyond each of them is paper.
 *
 * Parts that touch at a corner of 2 x 2 pixels are connected if paper is, and separate if ink is [Kopf and Lischinski
 * 2011, Depixelizing Pixel Art].  They are taken to be one region if a line passes by at both pixels of ink, and
 * separate if one line goes on from one to the other.
 *
 * Cost: the area of the basins that are asked for.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "image/image.h"
#include "segment/basins.h"
#include "segment/task.h"

#define THICKEST_LINE 2 /* stroke width, in pixels: thicker lines leave their regions in one piece (chosen) */
#define MOST_MERGED   6 /* pixels over which two lines are one, at most (chosen, as the next one) */
#define WIDEST        5 /* pixels: their width there, at most */

/* Coordinates about the pixel (x,y): i along (dx,dy), and j to the side, along (-dy,dx). */
typedef struct { int x, y, dx, dy; } PixelView;

typedef struct
{
  const CeldPlane  *ink;
  const CeldBasins *basins;
  PixelView         view;
  CeldPinch        *pinch;
  size_t            n, capacity;
} PinchSearch;

static int
column_of (PixelView v, int i, int j)
{
  return v.x + i * v.dx - j * v.dy;
}

static int
row_of (PixelView v, int i, int j)
{
  return v.y + i * v.dy + j * v.dx;
}

static bool
is_inside (const PinchSearch *s, int i, int j)
{
  int x = column_of (s->view, i, j), y = row_of (s->view, i, j);

  return x >= 0 && y >= 0 && x < s->ink->width && y < s->ink->height;
}

static bool
is_ink (const PinchSearch *s, int i, int j)
{
  return is_inside (s, i, j) && !celd_is_paper (CELD_AT (s->ink, column_of (s->view, i, j), row_of (s->view, i, j)));
}

static bool
is_paper (const PinchSearch *s, int i, int j)
{
  return is_inside (s, i, j) && !is_ink (s, i, j);
}

/* Adds the pinch between the pixel in the middle and another one, unless their paper is connected. */
static CeldStatus
add_pinch (PinchSearch *s, int i, int j, int64_t weakness)
{
  const CeldBasins *basins = s->basins;
  uint32_t          a = celd_basin_at (basins, s->view.x, s->view.y);
  uint32_t          b = celd_basin_at (basins, column_of (s->view, i, j), row_of (s->view, i, j));

  if (basins->component[a] == basins->component[b])
    return CELD_OK;
  return celd_append (s->pinch, s->n, s->capacity, (CeldPinch) { a, b, weakness });
}

/* Tries the paper that touches the one in the middle at a corner: lines pass by at the ink to the side and ahead. */
static CeldStatus
try_corner (PinchSearch *s)
{
  if (!is_ink (s, 0, 1) || !is_ink (s, 1, 0) || !is_paper (s, 1, 1) || !is_paper (s, -1, 2) || !is_paper (s, 2, -1))
    return CELD_OK;
  if (!(is_ink (s, 1, 2) || is_ink (s, 0, 2)) || !(is_ink (s, -1, 0) || is_ink (s, -1, 1)))
    return CELD_OK;
  if (!(is_ink (s, 2, 1) || is_ink (s, 2, 0)) || !(is_ink (s, 0, -1) || is_ink (s, 1, -1)))
    return CELD_OK;
  return add_pinch (s, 1, 1, CELD_PINCH_CORNER);
}

/* ------------------------------------------------------------------ lines that are one over some pixels */

/* Is that paper between two lines? */
static bool
is_tip (const PinchSearch *s, int i, int j)
{
  return is_paper (s, i, j) && is_ink (s, i, j - 1) && is_ink (s, i, j + 1);
}

/* From the ink at i - 1, *left .. *right, goes on to the ink at i that touches it.  False if that is no narrow line
 * with paper on both sides. */
static bool
follow_line (const PinchSearch *s, int i, int *left, int *right)
{
  int from = *left, to = *right;

  while (from <= to && !is_ink (s, i, from))
    from++;
  for (int k = 0; k < WIDEST && is_ink (s, i, from - 1); k++)
    from--;
  for (to = from; to < from + WIDEST && is_ink (s, i, to + 1);)
    to++;
  for (int j = to + 1; j <= *right; j++)
    if (is_ink (s, i, j))
      return false;
  if (!is_ink (s, i, from) || to - from >= WIDEST)
    return false;
  *left  = from;
  *right = to;
  return is_paper (s, i, from - 1) && is_paper (s, i, to + 1);
}

/* Follows the line ahead of the paper in the middle to where it parts again. */
static CeldStatus
try_ahead (PinchSearch *s)
{
  int left = 0, right = 0;

  if (!is_tip (s, 0, 0))
    return CELD_OK;
  for (int i = 1; i <= MOST_MERGED && follow_line (s, i, &left, &right); i++)
    for (int j = left; j <= right; j++)
      if (is_tip (s, i + 1, j))
        return add_pinch (s, i + 1, j, CELD_PINCH_MERGED);
  return CELD_OK;
}

/* ------------------------------------------------------------------ the whole */

static CeldStatus
search_pixel (PinchSearch *s, int x, int y)
{
  static const int step[4][2] = { { 1, 0 }, { 0, 1 }, { -1, 0 }, { 0, -1 } };
  CeldStatus       status = CELD_OK;

  s->view = (PixelView) { x, y, 1, 0 };
  if (!is_paper (s, 0, 0) || !(is_ink (s, -1, 0) || is_ink (s, 1, 0)) || !(is_ink (s, 0, -1) || is_ink (s, 0, 1)))
    return CELD_OK;
  for (int k = 0; k < 4 && status == CELD_OK; k++)
    {
      s->view = (PixelView) { x, y, step[k][0], step[k][1] };
      status  = try_corner (s);
      if (status == CELD_OK)
        status = try_ahead (s);
    }
  return status;
}

CeldStatus
celd_pinches_find (const CeldPlane *ink, const CeldBasins *basins, const bool *wanted, CeldPinch **pinch, size_t *n)
{
  PinchSearch s = { .ink = ink, .basins = basins };
  CeldStatus  status = CELD_OK;

  for (int y = 0; y < ink->height && basins->stroke <= THICKEST_LINE; y++)
    for (size_t k = basins->row[y]; k < basins->row[y + 1]; k++)
      if (wanted[basins->run[k].basin])
        for (int x = basins->run[k].x; x < celd_basin_run_end (basins, k, y) && status == CELD_OK; x++)
          status = search_pixel (&s, x, y);
  if (status != CELD_OK)
    {
      celd_free (s.pinch);
      return status;
    }
  *pinch = s.pinch;
  *n     = s.n;
  return CELD_OK;
}
