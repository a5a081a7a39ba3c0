/* Gaps closed as a person would close them.
 *
 * Where labels meet on paper the cut of a 4-connected grid makes staircases, and borders of basins wobble.  Each such
 * border is drawn again as a curve from line end to line end; if anything stands against it, as a straight line; else
 * it stays as it is.
 *
 * Cost: the length of the borders, and the ink a few stroke widths round their ends.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "segment/canvas.h"
#include "segment/closures.h"
#include "segment/patches.h"

#define SHORTEST 0.75 /* pixels */

static CeldStatus
add_closure (const CeldChain *chain, const CeldPlace *place, size_t n, CeldClosures *closures)
{
  CeldClosure *item = celd_grow (closures->item, closures->n + 1, sizeof *item);
  CeldPlace   *copy = celd_alloc (n, sizeof *copy);

  if (item)
    closures->item = item;
  if (!item || !copy)
    {
      celd_free (copy);
      return CELD_NO_MEMORY;
    }
  for (size_t i = 0; i < n; i++)
    copy[i] = place[i];
  item[closures->n++] = (CeldClosure) { copy, n, chain->left, chain->right };
  return CELD_OK;
}

/* The old border, as it is; only its bends. */
static CeldStatus
add_old (const CeldChain *chain, const CeldCorner *corner, CeldClosures *closures)
{
  CeldPlace *place = celd_alloc (chain->n, sizeof *place);
  size_t     n = 0;
  CeldStatus status = place ? CELD_OK : CELD_NO_MEMORY;

  for (size_t i = 0; i < chain->n && place; i++)
    if (i == 0 || i + 1 == chain->n || corner[i + 1].x - corner[i].x != corner[i].x - corner[i - 1].x ||
        corner[i + 1].y - corner[i].y != corner[i].y - corner[i - 1].y)
      place[n++] = (CeldPlace) { corner[i].x, corner[i].y };
  if (status == CELD_OK)
    status = add_closure (chain, place, n, closures);
  celd_free (place);
  return status;
}

/* Looks at both ends of a border and decides where the curve starts and ends. */
static void
find_ends (CeldRedrawing *r, const CeldChain *chain, const CeldCorner *corner)
{
  CeldLineEnd *a = &r->end[0], *b = &r->end[1];

  for (int k = 0; k < 2; k++)
    if (chain->end[k] == CELD_CHAIN_INK)
      celd_line_end_look (r->canvas->ink, chain->ink[k], &r->end[k]);
    else
      celd_line_end_none (corner[k ? chain->n - 1 : 0], &r->end[k]);
  if (b->n && !b->tip)
    celd_line_end_face (r->canvas->ink, a, b);
  if (a->n && !a->tip)
    celd_line_end_face (r->canvas->ink, b, a);
  if (b->n && !b->tip && !a->tip)
    celd_line_end_face (r->canvas->ink, a, b); /* once more: the narrowest place between two sides */
  if (!a->n || !b->n)
    a->tip = b->tip = false;   /* nothing says with which direction a border meets the frame */
}

/* Does the border cross white paper, rather than follow a faint line? */
static bool
is_white (const CeldPlane *ink, const CeldChain *chain, const CeldCorner *corner)
{
  for (size_t i = 0; i + 1 < chain->n; i++)
    {
      int  x = corner[i].x < corner[i + 1].x ? corner[i].x : corner[i + 1].x;
      int  y = corner[i].y < corner[i + 1].y ? corner[i].y : corner[i + 1].y;
      bool south = corner[i].y == corner[i + 1].y;

      if (!(CELD_AT (ink, x, y) < CELD_FAINT) && !(CELD_AT (ink, x - !south, y - south) < CELD_FAINT))
        return true;
    }
  return false;
}

/* Tries the curve, a straight line between the same ends, and one between those of the old border. */
static CeldStatus
close_chain (CeldRedrawing *r, const CeldChain *chain, CeldClosures *closures)
{
  const CeldCorner *corner = &r->chains->corner[chain->first];
  CeldBorderCurve           way = { .n = 0 };
  bool              done = false;
  CeldStatus        status = CELD_OK;

  if (chain->end[0] == CELD_CHAIN_LOOP || !is_white (r->canvas->ink, chain, corner))
    return CELD_OK;
  find_ends (r, chain, corner);
  way.n = celd_curve_draw (&r->end[0], &r->end[1], way.place);
  for (int attempt = 0; attempt < 3 && !done && status == CELD_OK; attempt++)
    {
      if (attempt)
        {
          way.place[1] = way.place[way.n - 1];
          way.n        = 2;
          way.straight = attempt == 2;
        }
      for (int k = 0; k < 2 && way.straight; k++)
        {
          CeldCorner end = corner[k ? chain->n - 1 : 0];

          way.place[k] = (CeldPlace) { end.x, end.y };
        }
      status = celd_redraw (r, chain, &way, &done);
    }
  if (status != CELD_OK)
    return status;
  if (!done)
    return add_old (chain, corner, closures);
  if (celd_distance_between (way.place[0], way.place[way.n - 1]) < SHORTEST)
    return CELD_OK; /* from a tip to the same tip */
  return add_closure (chain, way.place, way.n, closures);
}

CeldStatus
celd_closures_find (const CeldCanvas *canvas, const uint32_t *label, const CeldLabels *labels,
                    const CeldPatches *windows, const CeldHost *host, CeldClosures *closures, CeldPatches *patches)
{
  CeldChains    chains;
  CeldRedrawing redrawing = { .canvas = canvas, .labels = labels, .chains = &chains };
  CeldClosures  found = { 0 };
  CeldStatus    status = celd_chains_find (canvas, label, labels, windows, &chains);

  for (int k = 0; k < 2 && status == CELD_OK; k++)
    status = celd_line_end_new (canvas->basins->stroke, &redrawing.end[k]);
  for (size_t i = 0; i < chains.n && status == CELD_OK; i++)
    {
      status = celd_progress (host, (double) i / (double) chains.n);
      if (status == CELD_OK)
        status = close_chain (&redrawing, &chains.item[i], &found);
    }
  if (status == CELD_OK)
    {
      *closures = found;
      *patches  = redrawing.patches;
      redrawing.patches = (CeldPatches) { 0 };
    }
  else
    celd_closures_clear (&found);
  celd_redrawing_clear (&redrawing);
  celd_chains_clear (&chains);
  return status;
}
