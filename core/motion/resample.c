/* What a pixel of a composition shows of each drawing.
 *
 * A pixel shows the mean of a square of the drawing: of one pixel of it, which is bilinear interpolation, or where the
 * drawing is made smaller of one pixel of the composition, so that thin lines do not break.
 *
 * If the layers of a drawing were resampled one by one and composited afterwards, the page would shine through between
 * regions that touch: a border pixel that both half cover would be a quarter empty.  Therefore the visible picture is
 * divided: each layer gets what it contributes to a pixel of the drawing, these shares are resampled, and their sum is
 * the drawing, resampled as a whole.  Between drawings, whose outlines have nothing to do with each other, coverage
 * multiplies as usual: a share is what the regions of all other drawings in front leave of it.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/compose.h"

CeldStatus
celd_shares_new (const CeldComposition *c, CeldShares *shares)
{
  *shares = (CeldShares) {
    .share = celd_alloc (c->n_items, sizeof *shares->share), .slot = celd_alloc0 (c->n_items, sizeof *shares->slot),
    .covered = celd_alloc0 (c->n, sizeof *shares->covered), .front = celd_alloc (c->n, sizeof *shares->front)
  };
  return shares->share && shares->slot && shares->covered && shares->front ? CELD_OK : CELD_NO_MEMORY;
}

void
celd_shares_clear (CeldShares *shares)
{
  celd_free (shares->share);
  celd_free (shares->slot);
  celd_free (shares->covered);
  celd_free (shares->front);
  *shares = (CeldShares) { 0 };
}

/* ------------------------------------------------------------------ the square that a pixel shows */

/* Pixels first .. last of a row or column of the drawing, and the place and size of the square on it. */
typedef struct { int first, last; double from, to; } Window;

static Window
window_at (double centre, double reach, int begin, int size)
{
  Window w = { .from = centre - reach, .to = centre + reach };

  w.first = (int) fmin (fmax (floor (w.from), begin), begin + size);
  w.last  = (int) fmin (fmax (ceil (w.to) - 1, begin - 1), begin + size - 1);
  return w;
}

/* The fraction of the square that is in row or column i. */
static double
weight_of (const Window *w, int i)
{
  double from = i > w->from ? i : w->from, to = i + 1 < w->to ? i + 1 : w->to;

  return (to - from) / (w->to - w->from);
}

/* ------------------------------------------------------------------ shares of one drawing */

static void
add_share (CeldShares *shares, uint32_t fragment, uint32_t item, const float straight[4], float weight)
{
  CeldShare *share;

  if (item == CELD_NO_ITEM || !(straight[3] * weight > 0))
    return;
  if (!shares->slot[item])
    {
      shares->share[shares->n] = (CeldShare) { item, fragment, { 0 } };
      shares->slot[item] = (uint32_t) ++shares->n;
    }
  share = &shares->share[shares->slot[item] - 1];
  for (int i = 0; i < 4; i++)
    share->colour[i] += weight * straight[3] * (i < 3 ? straight[i] : 1);
}

/* Divides a pixel of the drawing between its layers. */
static void
add_pixel (const CeldPlacedFragment *f, uint32_t number, size_t p, float weight, CeldShares *shares)
{
  const CeldLayers *layers = f->layers;
  const CeldBlend  *blend;
  size_t            place = layers->place[p];
  uint32_t          stroke = celd_page_strokes_at (&f->strokes, p);

  if (stroke)
    {
      add_share (shares, number, f->item[stroke - 1], f->strokes.colour + 4 * p, weight);
      return;
    }
  if (place < layers->n)
    {
      add_share (shares, number, f->item[place], layers->art + 4 * p, weight);
      return;
    }
  blend = &layers->blend[place - layers->n];
  add_share (shares, number, f->item[blend->layer[0]], blend->colour[0], weight);
  add_share (shares, number, f->item[blend->layer[1]], blend->colour[1], weight * (1 - blend->colour[0][3]));
}

static void
gather_fragment (const CeldPlacedFragment *f, uint32_t number, int x, int y, CeldShares *shares)
{
  Window across, down;
  double place[2];

  celd_similarity_map (&f->back, x + 0.5, y + 0.5, place);
  across = window_at (place[0], f->reach, 0, f->layers->width);
  down   = window_at (place[1], f->reach, 0, f->layers->height);
  for (int v = down.first; v <= down.last; v++)
    for (int u = across.first; u <= across.last; u++)
      add_pixel (f, number, (size_t) v * (size_t) f->layers->width + (size_t) u,
                 (float) (weight_of (&across, u) * weight_of (&down, v)), shares);
}

void
celd_shares_gather (const CeldComposition *c, int x, int y, CeldShares *shares)
{
  shares->n = 0;
  for (size_t f = 0; f < c->n; f++)
    {
      const CeldRect *box = &c->fragment[f].box;

      if (x >= box->x && y >= box->y && x < box->x + box->width && y < box->y + box->height)
        gather_fragment (&c->fragment[f], (uint32_t) f, x, y, shares);
    }
  for (size_t i = 0; i < shares->n; i++)
    shares->slot[shares->share[i].item] = 0;
}

/* ------------------------------------------------------------------ shares of the composition */

static void
sort_shares (CeldShares *shares)
{
  for (size_t i = 1; i < shares->n; i++)
    {
      CeldShare share = shares->share[i];
      size_t    k = i;

      for (; k > 0 && shares->share[k - 1].item < share.item; k--)
        shares->share[k] = shares->share[k - 1];
      shares->share[k] = share;
    }
}

/* What is left of a pixel of a drawing behind all other drawings in front. */
static float
left_by_others (const CeldShares *shares, size_t fronts, uint32_t fragment)
{
  float left = 1;

  for (size_t k = 0; k < fronts; k++)
    if (shares->front[k] != fragment)
      left *= 1 - shares->covered[shares->front[k]];
  return left;
}

void
celd_shares_combine (CeldShares *shares)
{
  size_t fronts = 0;

  sort_shares (shares);
  for (size_t i = 0; i < shares->n; i++)
    {
      CeldShare *share = &shares->share[i];
      float      left = left_by_others (shares, fronts, share->fragment), *covered = &shares->covered[share->fragment];

      if (!(*covered > 0))
        shares->front[fronts++] = share->fragment;
      *covered = fminf (*covered + share->colour[3], 1);
      for (int k = 0; k < 4; k++)
        share->colour[k] *= left;
    }
  for (size_t k = 0; k < fronts; k++)
    shares->covered[shares->front[k]] = 0;
}

void
celd_resample (const CeldPlacedFragment *f, CeldRect box, const float *rgba, int x, int y, float colour[4])
{
  Window across, down;
  double place[2];

  celd_similarity_map (&f->back, x + 0.5, y + 0.5, place);
  across = window_at (place[0], f->reach, box.x, box.width);
  down   = window_at (place[1], f->reach, box.y, box.height);
  memset (colour, 0, 4 * sizeof *colour);
  for (int v = down.first; v <= down.last; v++)
    for (int u = across.first; u <= across.last; u++)
      {
        const float *straight = rgba + 4 * ((size_t) (v - box.y) * (size_t) box.width + (size_t) (u - box.x));
        float        weight = (float) (weight_of (&across, u) * weight_of (&down, v)) * straight[3];

        for (int i = 0; i < 4; i++)
          colour[i] += weight * (i < 3 ? straight[i] : 1);
      }
}
