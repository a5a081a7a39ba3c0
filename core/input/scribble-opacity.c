/* Which pixels of a painted layer are opaque enough to be paint.
 *
 * Half opaque ones are.  Where connected paint has faint strokes, of a translucent brush, a third of the opacity of its
 * strongest pixel is enough: where strokes cross, this is stronger than each of them.  So rims and the tails of soft
 * brushes are none, and no stroke that can be seen is lost.
 *
 * Cost: O(pixels); paint is only connected in layers that have faint strokes.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/input.h"

#define OPAQUE   128 /* of 255: paint from here on, whatever is beside it; chosen */
#define SHARE    3   /* a pixel is paint from one third of the strongest on; chosen */

/* Connected paint: the alpha of its strongest pixel, and has it a faint stroke? */
typedef struct { uint8_t strongest; bool faint; } ConnectedPaint;

static uint8_t
alpha_at (const CeldScribbleLayer *r, int x, int y)
{
  return CELD_RGBA (r->paint, x, y)[3];
}

/* Can the pixel be seen, although it is not opaque nor at the rim of opaque paint? */
static bool
is_faint (const CeldScribbleLayer *r, int x, int y)
{
  return celd_paint_is_faint (r->paint, CELD_SCRIBBLE_ALPHA, OPAQUE, x, y);
}

/* Marks opaque pixels; is there a faint one? */
static bool
mark_opaque (CeldScribbleLayer *r)
{
  bool faint = false;

  for (int y = 0; y < r->height; y++)
    {
      const uint8_t *rgba = CELD_RGBA (r->paint, 0, y);
      uint8_t       *kind = r->kind + (size_t) y * (size_t) r->width;

      for (int x = 0; x < r->width; x++)
        kind[x] = rgba[4 * x + 3] >= OPAQUE;
      for (int x = 0; x < r->width && !faint; x++)
        faint = !kind[x] && rgba[4 * x + 3] >= CELD_SCRIBBLE_ALPHA && is_faint (r, x, y);
    }
  return faint;
}

/* Fills in paint[k] of the pixels whose component is k; paint[0] stays 0. */
static void
measure (const CeldScribbleLayer *r, const CeldLabels *component, ConnectedPaint *paint)
{
  for (int y = 0; y < r->height; y++)
    for (int x = 0; x < r->width; x++)
      {
        uint32_t k = CELD_AT (component, x, y);

        if (!k)
          continue;
        paint[k].strongest = alpha_at (r, x, y) > paint[k].strongest ? alpha_at (r, x, y) : paint[k].strongest;
        paint[k].faint = paint[k].faint || is_faint (r, x, y);
      }
}

CeldStatus
celd_scribble_paint (CeldScribbleLayer *r)
{
  CeldLabels      component = { r->width, r->height, (size_t) r->width, r->label };
  CeldComponent  *list = NULL;
  ConnectedPaint *paint = NULL;
  size_t          n = 0;
  CeldStatus      status;

  if (!mark_opaque (r))
    return CELD_OK;
  for (int y = 0; y < r->height; y++)
    for (int x = 0; x < r->width; x++)
      CELD_AT (&component, x, y) = alpha_at (r, x, y) >= CELD_CONNECTED_ALPHA;
  status = celd_components (&component, 0, true, NULL, &component, &list, &n);
  if (status == CELD_OK && !(paint = celd_alloc0 (n + 1, sizeof *paint)))
    status = CELD_NO_MEMORY;
  if (status == CELD_OK)
    measure (r, &component, paint);
  for (int y = 0; y < r->height && status == CELD_OK; y++)
    for (int x = 0; x < r->width; x++)
      {
        const ConnectedPaint *of = &paint[CELD_AT (&component, x, y)];

        if (of->faint && SHARE * alpha_at (r, x, y) >= of->strongest)
          r->kind[(size_t) y * (size_t) r->width + (size_t) x] = 1;
      }
  celd_free (paint);
  celd_free (list);
  return status;
}
