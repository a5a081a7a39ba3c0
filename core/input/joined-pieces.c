/* Pieces of connected paint of joined lines, as strokes of their own.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/joined-arrows.h"

#include <math.h>
#include <string.h>

/* Collects the paint that may be taken and is connected with a pixel of the mask.  Pixels have eight neighbours, as
 * those of all strokes do; no paint is on the border. */
static CeldStatus
collect (const CeldJoinedLines *s, size_t start, CeldJoinedPiece *piece)
{
  size_t     w = (size_t) s->mask.width;
  CeldStatus status = CELD_OK;

  if (s->may_take[start])
    status = celd_append (piece->pixel, piece->stroke.n, piece->capacity, (uint32_t) start);
  s->may_take[start] = 0;
  for (size_t done = 0; done < piece->stroke.n && status == CELD_OK; done++)
    {
      size_t p = piece->pixel[done];
      size_t around[8] = { p - w, p + 1, p + w, p - 1, p - w + 1, p + w + 1, p + w - 1, p - w - 1 };

      for (int i = 0; i < 8 && status == CELD_OK; i++)
        if (s->may_take[around[i]])
          {
            s->may_take[around[i]] = 0;
            status = celd_append (piece->pixel, piece->stroke.n, piece->capacity, (uint32_t) around[i]);
          }
    }
  return status;
}

CeldStatus
celd_joined_take (const CeldJoinedLines *s, CeldPoint start, CeldJoinedPiece *piece)
{
  size_t     width = (size_t) s->mask.width, row = (size_t) s->stroke->width + 2;
  CeldStatus status;

  *piece = (CeldJoinedPiece) { .stroke = *s->stroke };
  piece->stroke.n = 0;
  status = collect (s, celd_joined_pixel (s, start), piece);
  for (size_t i = 0; i < piece->stroke.n; i++)
    piece->pixel[i] = (uint32_t) ((piece->pixel[i] / width + (size_t) s->mask.top + 1) * row +
                                  piece->pixel[i] % width + (size_t) s->mask.left + 1);
  piece->stroke.pixel = piece->pixel;
  return status;
}

void
celd_joined_release (CeldJoinedPiece *piece)
{
  for (size_t i = 0; i < piece->stroke.n; i++)
    piece->stroke.distance[piece->pixel[i]] = INFINITY;
  celd_free (piece->pixel);
}

/* Row by row: discs along a broad line are many and large. */
void
celd_joined_fill_disc (const CeldJoinedLines *s, CeldPoint c, double r, uint8_t value, uint8_t *pixels)
{
  for (int y = (int) fmax (0, ceil (c.y - r - 0.5)); y + 0.5 <= c.y + r && y < s->mask.height; y++)
    {
      double half = sqrt (fmax (0, r * r - (y + 0.5 - c.y) * (y + 0.5 - c.y)));
      int    left = (int) fmax (0, ceil (c.x - half - 0.5)), end = (int) fmin (s->mask.width, floor (c.x + half + 0.5));

      if (left < end)
        memset (pixels + (size_t) y * (size_t) s->mask.width + left, value, (size_t) (end - left));
    }
}
