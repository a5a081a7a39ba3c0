/* Gaps in contours, bridged before the basins are found.
 *
 * Where a gap is as wide as the region behind it, or wider, no narrow place of the paper shows where the contour would
 * have been; but the lines do.  Line ends that point to each other are joined, the closest and straightest pair first,
 * by the curve of closures.c; basins then meet along it.  A bridge only offers a boundary: it is used where the labels
 * on both sides differ.  Over a short gap a bridge is nearly ink; the farther apart its ends are, the fainter it is
 * drawn, and the more a boundary on it costs.
 *
 * An end without a partner may have reached as far as the line that it points at.  That is a mere guess: strokes that
 * only adorn a part end in the same way.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "image/image.h"
#include "segment/basins.h"
#include "segment/bridges.h"
#include "segment/closures.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define CERTAIN_LENGTH  6      /* stroke widths: up to here a bridge is certain (chosen) */
#define DOUBTFUL_LENGTH 12     /* from here on it is a guess (chosen) */
#define THINNEST_SIDE   0.4    /* of the ink ahead, in the line's direction: a line this wide may be a room's side (chosen) */
#define BROADEST_SIDE   2      /* stroke widths: nor is a broader one (chosen) */
#define MOST_AHEAD      6      /* stroke widths from a single end to the ink that it points at, at most (chosen) */

typedef struct
{
  const CeldPlane *ink;
  int              stroke;
  CeldTip         *tip;
  size_t           n;
  bool            *taken;       /* of each line end: has it a bridge? */
  float            faintness;   /* ink of the bridge being built */
  CeldBridges     *bridges;
} BridgeBuilder;

/* ------------------------------------------------------------------ bridges */

/* How doubtful it is that the contour went on from one line end to the other: 0 .. 1. */
static double
doubt (const CeldTip *p, const CeldTip *q)
{
  double strokes = hypot (q->x - p->x, q->y - p->y) / celd_finer_stroke (p, q);

  return fmax (0, fmin (1, (strokes - CERTAIN_LENGTH) / (DOUBTFUL_LENGTH - CERTAIN_LENGTH)));
}

/* Adds a pixel to the last bridge, unless it is the previous one or ink. */
static CeldStatus
add_pixel (BridgeBuilder *b, CeldBridge *bridge, int x, int y)
{
  CeldBridges *all = b->bridges;

  if (x < 0 || y < 0 || x >= b->ink->width || y >= b->ink->height || !celd_is_paper (CELD_AT (b->ink, x, y)))
    return CELD_OK;
  if (bridge->n && all->pixel[all->n_pixels - 1].x == x && all->pixel[all->n_pixels - 1].y == y)
    return CELD_OK;
  if (celd_append (all->pixel, all->n_pixels, all->pixel_capacity, (CeldBridgePixel) { x, y, b->faintness }) != CELD_OK)
    return CELD_NO_MEMORY;
  bridge->n++;
  return CELD_OK;
}

/* Follows the curve in steps of half a pixel.  *open becomes false where it meets ink away from its ends. */
static CeldStatus
walk (BridgeBuilder *b, const CeldPlace *place, size_t n, double clear, CeldBridge *bridge, bool *open)
{
  CeldPlace  first = place[0], last = place[n - 1];
  CeldStatus status = CELD_OK;

  for (size_t i = 0; i + 1 < n && status == CELD_OK && *open; i++)
    {
      double length = celd_distance_between (place[i], place[i + 1]), steps = ceil (2 * length) + 1;

      bridge->length += length;
      for (double k = 0; k <= steps && status == CELD_OK && *open; k++)
        {
          CeldPlace at = { place[i].x + k / steps * (place[i + 1].x - place[i].x),
                           place[i].y + k / steps * (place[i + 1].y - place[i].y) };
          int       x = (int) floor (at.x), y = (int) floor (at.y);

          if (x < 0 || y < 0 || x >= b->ink->width || y >= b->ink->height)
            *open = false;
          else if (!celd_is_paper (CELD_AT (b->ink, x, y)))
            *open = celd_distance_between (at, first) < clear || celd_distance_between (at, last) < clear;
          else
            status = add_pixel (b, bridge, x, y);
        }
    }
  return status;
}

/* Adds a bridge along the curve unless something stands in its way; *built says whether it did. */
static CeldStatus
build (BridgeBuilder *b, CeldBridge bridge, const CeldPlace *place, size_t n, double stroke, bool *built)
{
  bool       open = true;
  CeldStatus status;

  bridge.first = b->bridges->n_pixels;
  status       = walk (b, place, n, fmax (stroke, 2), &bridge, &open);
  *built = status == CELD_OK && open && bridge.n;
  if (*built)
    return celd_append (b->bridges->item, b->bridges->n, b->bridges->item_capacity, bridge);
  b->bridges->n_pixels = bridge.first;
  return status;
}

static CeldStatus
build_between (BridgeBuilder *b, const CeldTipPair *pair)
{
  const CeldTip *p = &b->tip[pair->a], *q = &b->tip[pair->b];
  CeldLineEnd    from = { 0 }, to = { 0 };
  CeldPlace      place[CELD_CURVE_PLACES];
  size_t         n;
  bool           built;
  CeldStatus     status;

  celd_line_end_set_tip (p, &from);
  celd_line_end_set_tip (q, &to);
  n = celd_curve_draw (&from, &to, place);
  b->faintness = CELD_FAINTEST_INK * (float) doubt (p, q);
  status       = build (b, (CeldBridge) { .end = { *p, *q } }, place, n, celd_finer_stroke (p, q), &built);
  if (built)
    b->taken[pair->a] = b->taken[pair->b] = true;
  return status;
}

/* Finds where a line, continued straight from its end, meets ink; false if it does not within MOST_AHEAD. */
static bool
find_ink_ahead (const BridgeBuilder *b, const CeldTip *tip, CeldPlace *place)
{
  bool left = false; /* the line's own ink, in which a tip may lie */

  for (double t = 0; t <= MOST_AHEAD * tip->stroke; t += 0.5)
    {
      int x, y;

      *place = (CeldPlace) { tip->x + t * tip->dx, tip->y + t * tip->dy };
      x      = (int) floor (place->x);
      y      = (int) floor (place->y);
      if (x < 0 || y < 0 || x >= b->ink->width || y >= b->ink->height)
        return false;
      if (celd_is_paper (CELD_AT (b->ink, x, y)))
        left = true;
      else if (left)
        return true;
    }
  return false;
}

/* May the line that ends here be the side of a room?  Thin lines in a part with a broad outline, which is at that place
 * ahead, only adorn it, as veins do a leaf; what is much broader than lines is a shape of its own, as a mouth. */
static bool
is_side (const BridgeBuilder *b, const CeldTip *tip, CeldPlace place)
{
  double t = 0, most = tip->width / THINNEST_SIDE;

  if (tip->width <= 0 || tip->width > BROADEST_SIDE * b->stroke)
    return false;
  for (; t <= most; t += 0.5)
    {
      int x = (int) floor (place.x + t * tip->dx), y = (int) floor (place.y + t * tip->dy);

      if (x < 0 || y < 0 || x >= b->ink->width || y >= b->ink->height || celd_is_paper (CELD_AT (b->ink, x, y)))
        return true;
    }
  return false;
}

static CeldStatus
build_ahead (BridgeBuilder *b, const CeldTip *tip)
{
  CeldPlace place[2] = { { tip->x, tip->y } };
  bool      built;

  b->faintness = CELD_FAINTEST_INK;
  if (!find_ink_ahead (b, tip, &place[1]))
    return CELD_OK;
  return build (b, (CeldBridge) { .ahead = true, .line = is_side (b, tip, place[1]) }, place, 2, tip->stroke,
                &built);
}

/* Joins line ends, the cheapest pair first, and then single ends with what lies ahead of them. */
static CeldStatus
build_all (BridgeBuilder *b, const CeldHost *host)
{
  CeldTipPairs      *pairs = celd_tip_pairs_new (b->tip, b->n, b->stroke);
  const CeldTipPair *pair = NULL;
  CeldStatus         status = pairs ? CELD_OK : CELD_NO_MEMORY;

  while (status == CELD_OK)
    {
      status = celd_tip_pairs_next (pairs, b->taken, host, &pair);
      if (status != CELD_OK || !pair)
        break;
      status = build_between (b, pair);
    }
  celd_tip_pairs_free (pairs);
  for (size_t i = 0; i < b->n && status == CELD_OK; i++)
    if (!b->taken[i])
      status = build_ahead (b, &b->tip[i]);
  return status;
}

void
celd_bridges_clear (CeldBridges *bridges)
{
  celd_free (bridges->item);
  celd_free (bridges->pixel);
  *bridges = (CeldBridges) { 0 };
}

CeldStatus
celd_bridges_find (const CeldPlane *ink, int stroke, const CeldHost *host, CeldBridges *bridges)
{
  CeldHostPart  part[2];
  CeldHost      ends = celd_host_part (&part[0], host, 0, 0.5), join = celd_host_part (&part[1], host, 0.5, 1);
  CeldBridges   found = { 0 };
  BridgeBuilder b = { .ink = ink, .stroke = stroke, .bridges = &found };
  CeldStatus    status = celd_line_ends_find (ink, stroke, &ends, &b.tip, &b.n);

  if (status != CELD_OK)
    return status;
  b.taken = celd_alloc0 (b.n, sizeof *b.taken);
  status  = b.taken ? build_all (&b, &join) : CELD_NO_MEMORY;
  celd_free (b.tip);
  celd_free (b.taken);
  if (status == CELD_OK)
    *bridges = found;
  else
    celd_bridges_clear (&found);
  return status;
}

static int
compare_pixels (const void *a, const void *b)
{
  const CeldBridgePixel *p = a, *q = b;

  if (p->y != q->y)
    return p->y < q->y ? -1 : 1;
  if (p->x != q->x)
    return p->x < q->x ? -1 : 1;
  return p->ink < q->ink ? -1 : p->ink > q->ink;
}

/* All pixels in reading order, to be freed; NULL: no memory. */
static CeldBridgePixel *
sort_pixels (const CeldBridges *bridges)
{
  CeldBridgePixel *pixel = celd_alloc (bridges->n_pixels, sizeof *pixel);

  for (size_t i = 0; i < bridges->n_pixels && pixel; i++)
    pixel[i] = bridges->pixel[i];
  if (pixel && bridges->n_pixels)
    qsort (pixel, bridges->n_pixels, sizeof *pixel, compare_pixels);
  return pixel;
}

CeldStatus
celd_bridges_compare (const CeldBridges *old, const CeldBridges *new, CeldRect *changed)
{
  CeldBridgePixel *a = sort_pixels (old), *b = sort_pixels (new);
  bool             enough = a && b;

  for (size_t i = 0, j = 0; enough && (i < old->n_pixels || j < new->n_pixels);)
    {
      int                    order = i == old->n_pixels ? 1 : j == new->n_pixels ? -1 : compare_pixels (&a[i], &b[j]);
      const CeldBridgePixel *p = order < 0 ? &a[i] : &b[j];

      if (order)
        *changed = celd_rect_union (*changed, (CeldRect) { p->x, p->y, 1, 1 });
      i += order <= 0;
      j += order >= 0;
    }
  celd_free (a);
  celd_free (b);
  return enough ? CELD_OK : CELD_NO_MEMORY;
}

void
celd_bridges_draw (const CeldBridges *bridges, CeldPlane *ink)
{
  for (size_t i = 0; i < bridges->n_pixels; i++)
    {
      float *at = &CELD_AT (ink, bridges->pixel[i].x, bridges->pixel[i].y);

      *at = fminf (*at, bridges->pixel[i].ink); /* where two cross: the more certain one */
    }
}

/* ------------------------------------------------------------------ basins of a drawing with bridges */

CeldStatus
celd_bridges_make_basins (const CeldPlane *ink, CeldRect *changed, float threshold, const CeldHost *host,
                          CeldBridges *bridges, CeldBasins *basins, uint32_t **bridged_component)
{
  CeldHostPart part[2];
  CeldHost     find = celd_host_part (&part[0], host, 0, 0.2), make = celd_host_part (&part[1], host, 0.2, 1);
  CeldBridges  made = { 0 };
  CeldPlane    copy = { 0 };
  CeldStatus   status = celd_bridges_find (ink, celd_stroke_width (ink), &find, &made);

  if (status == CELD_OK && changed)
    status = celd_bridges_compare (bridges, &made, changed);
  if (status == CELD_OK && made.n)
    status = celd_plane_new (ink->width, ink->height, &copy);
  for (int y = 0; y < ink->height && copy.data; y++)
    memcpy (&CELD_AT (&copy, 0, y), &CELD_AT (ink, 0, y), (size_t) ink->width * sizeof *copy.data);
  if (status == CELD_OK && made.n)
    celd_bridges_draw (&made, &copy);
  if (status == CELD_OK)
    status = celd_basins_make (made.n ? &copy : ink, changed, threshold, &make, basins);
  if (status == CELD_OK && made.n)
    status = celd_bridges_join (&made, ink, basins, bridged_component);
  celd_free (copy.data);
  if (status != CELD_OK)
    {
      celd_bridges_clear (&made);
      return status;
    }
  celd_bridges_clear (bridges);
  *bridges = made;
  return CELD_OK;
}
