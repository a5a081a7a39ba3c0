/* The paper along the edge of a picture, by which the background is recognised.
 *
 * That is the paper among the outermost pixels.  If less than a tenth of them is paper, the artist has drawn a frame
 * there, and it is the paper just inside that frame.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"

typedef struct { int x, y, dx, dy; } Step; /* an outermost pixel, and the direction inwards */

static Step
outermost (int width, int height, size_t i)
{
  size_t w = (size_t) width, h = (size_t) height;

  if (i < w)
    return (Step) { (int) i, 0, 0, 1 };
  if (i < 2 * w)
    return (Step) { (int) (i - w), height - 1, 0, -1 };
  if (i < 2 * w + h)
    return (Step) { 0, (int) (i - 2 * w), 1, 0 };
  return (Step) { width - 1, (int) (i - 2 * w - h), -1, 0 };
}

/* Lists the first paper inwards from each outermost pixel, at most `reach` pixels away; returns how many there are. */
static size_t
look_inwards (const CeldPlane *ink, int width, int height, int reach, size_t *pixel)
{
  size_t n = 0, all = 2 * ((size_t) width + (size_t) height);

  for (size_t i = 0; i < all; i++)
    {
      Step s = outermost (width, height, i);

      for (int k = 0; k <= reach && s.x >= 0 && s.y >= 0 && s.x < width && s.y < height; k++, s.x += s.dx, s.y += s.dy)
        if (!ink || celd_is_paper (CELD_AT (ink, s.x, s.y)))
          {
            pixel[n++] = (size_t) s.y * (size_t) width + (size_t) s.x;
            break;
          }
    }
  return n;
}

CeldStatus
celd_frame (const CeldPlane *ink, int width, int height, int stroke, size_t **pixel, size_t *n)
{
  size_t all = 2 * ((size_t) width + (size_t) height);

  *pixel = celd_alloc (all, sizeof **pixel);
  if (!*pixel)
    return CELD_NO_MEMORY;
  *n = look_inwards (ink, width, height, 0, *pixel);
  if (ink && *n < all / 10)
    *n = look_inwards (ink, width, height, 4 * (stroke ? stroke : celd_stroke_width (ink)) + 2, *pixel);
  return CELD_OK;
}
