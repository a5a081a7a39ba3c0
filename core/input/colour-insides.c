/* The insides of pieces of one colour in a connected component of paint.
 *
 * The mean colour round a pixel does not change along a stroke, though it does across: rims are soft, bleed, and echo
 * in lossy pictures.  Where it changes little on all sides is the inside of a piece; insides that touch are one piece,
 * so that a brush whose colour changes slowly leaves one.
 *
 * Costs about a hundred steps a pixel.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "input/arrow-colours.h"
#include "input/arrows.h"
#include "input/trail.h"

#include <math.h>

#define REACH       3    /* pixels, or a quarter of the lines' width: means are taken so far around, */
#define FLAT        0.35 /* and change by less than this inside a piece */
#define FAINT       24   /* opacity: what is less has no inside */
#define LEAST_PIECE 8    /* pixels of an inside, */
#define LEAST_SHARE 0.5  /* and of the square of the lines' width */
#define MOST_PIECES 64   /* more are no arrows */

/* Of long straight lines whose pixels lie so deep in the paint, in the mean of squares. */
double
celd_lines_width (double squared)
{
  return fmax (1, sqrt (12 * squared) - 1);
}

CeldPoint
celd_pieces_middle (const CeldPieces *s, size_t pixel)
{
  size_t width = (size_t) s->cutting.width;

  return (CeldPoint) { (double) (s->place[pixel] % width) + 0.5, (double) (s->place[pixel] / width) + 0.5 };
}

uint32_t
celd_pieces_near (const CeldPieces *s, size_t pixel, int dx, int dy)
{
  int x = (int) (s->place[pixel] % (size_t) s->cutting.width) + dx;
  int y = (int) (s->place[pixel] / (size_t) s->cutting.width) + dy;

  if (x < 0 || y < 0 || x >= s->cutting.width || y >= s->cutting.height)
    return 0;
  return s->number[(size_t) y * (size_t) s->cutting.width + (size_t) x];
}

CeldTint
celd_pieces_tint (const CeldPieces *s, const CeldArrowLayer *layer, size_t pixel)
{
  CeldPoint p = celd_pieces_middle (s, pixel);

  return celd_tint_at (layer, s->cutting.left + (int) p.x, s->cutting.top + (int) p.y);
}

static CeldStatus
number_pixels (CeldPieces *s, size_t n)
{
  const CeldCutting *c = &s->cutting;
  size_t             all = (size_t) c->width * (size_t) c->height;
  double             sum = 0;

  s->number = celd_alloc0 (all, sizeof *s->number);
  s->place  = celd_alloc (n, sizeof *s->place);
  s->tint   = celd_alloc (n, sizeof *s->tint);
  s->piece  = celd_alloc0 (n, sizeof *s->piece);
  s->like   = celd_alloc (n, sizeof *s->like);
  if (!s->number || !s->place || !s->tint || !s->piece || !s->like)
    return CELD_NO_MEMORY;
  for (size_t p = 0; p < all; p++)
    if (c->painted[p])
      {
        sum += c->squared[p];
        s->place[s->n_pixels++] = (uint32_t) p;
        s->number[p] = (uint32_t) s->n_pixels;
      }
  s->width = celd_lines_width (sum / (double) s->n_pixels);
  return CELD_OK;
}

/* Are there pixels, strong enough to tell, of a colour other than the strongest one's? */
static bool
may_have_two (const CeldPieces *s, const CeldArrowLayer *layer)
{
  CeldTint strongest = { .strength = -1 };

  for (size_t i = 0; i < s->n_pixels; i++)
    {
      CeldTint t = celd_pieces_tint (s, layer, i);

      if (t.strength > strongest.strength)
        strongest = t;
    }
  for (size_t i = 0; i < s->n_pixels; i++)
    {
      CeldTint t = celd_pieces_tint (s, layer, i);

      if (t.strength >= FAINT && celd_tints_differ (layer, &t, &strongest, 0) > FLAT)
        return true;
    }
  return false;
}

/* Pixels that means are taken over, each way. */
static int
reach_of (const CeldPieces *s)
{
  return (int) fmax (REACH, s->width / 4);
}

/* Without alpha the paper counts, too: a codec spreads a stroke's colour over it. */
static CeldTint
mean_round (const CeldPieces *s, const CeldArrowLayer *layer, size_t pixel)
{
  const CeldCutting *c = &s->cutting;
  int                reach = reach_of (s), step = reach / REACH;
  int                px = (int) (s->place[pixel] % (size_t) c->width), py = (int) (s->place[pixel] / (size_t) c->width);
  double             sum[3] = { 0 }, weights = 0, squares = 0, painted = 0;
  CeldTint           mean;

  for (int y = py - reach; y <= py + reach; y += step)
    for (int x = px - reach; x <= px + reach; x += step)
      {
        bool     on = x >= 0 && y >= 0 && x < c->width && y < c->height &&
                      c->painted[(size_t) y * (size_t) c->width + (size_t) x];
        int      u = c->left + x, v = c->top + y;
        double   weight;
        CeldTint t;

        if (u < 0 || v < 0 || u >= layer->paint->width || v >= layer->paint->height || (!on && !layer->opaque))
          continue;
        t = celd_tint_at (layer, u, v);
        if (!on && t.strength >= CELD_PAPER_CONTRAST) /* of another component */
          continue;
        weight = layer->opaque ? 1 : t.strength;
        for (int i = 0; i < 3; i++)
          sum[i] += weight * t.c[i];
        weights += weight;
        painted += on ? t.strength : 0;
        squares += on ? (double) t.strength * t.strength : 0;
      }
  if (layer->opaque) /* as strong as the paint is, in the direction of the sum */
    weights = fmax (1, fmax (fabs (sum[0]), fmax (fabs (sum[1]), fabs (sum[2])))) * painted / fmax (1, squares);
  for (int i = 0; i < 3; i++)
    mean.c[i] = (float) (sum[i] / fmax (weights, 1e-6));
  mean.strength = (float) (squares / fmax (1, painted));
  return mean;
}

/* Does the mean change little on all sides? */
static bool
is_inside (const CeldPieces *s, const CeldArrowLayer *layer, size_t pixel)
{
  int reach = reach_of (s);

  if (s->tint[pixel].strength < FAINT)
    return false;
  for (int k = 0; k < 18; k++)
    {
      int      far   = k < 9 ? reach : (reach + 1) / 2;
      uint32_t other = celd_pieces_near (s, pixel, far * (k % 3 - 1), far * (k % 9 / 3 - 1));

      if (other && celd_tints_differ (layer, &s->tint[pixel], &s->tint[other - 1], CELD_LESS_NOISE) > FLAT)
        return false;
    }
  return true;
}

/* Numbers connected insides, but the smallest; *many is true if there are too many. */
static CeldStatus
find_insides (CeldPieces *s, const CeldArrowLayer *layer, bool *many)
{
  const CeldCutting *c = &s->cutting;
  CeldLabels         inside = { 0 };
  CeldComponent     *list = NULL;
  size_t             n = 0;
  uint32_t          *name = NULL;
  CeldStatus         status = celd_labels_new (c->width, c->height, &inside);

  if (status != CELD_OK)
    return status;
  for (size_t i = 0; i < s->n_pixels; i++)
    inside.data[s->place[i]] = is_inside (s, layer, i);
  status = celd_components (&inside, 0, true, NULL, &inside, &list, &n);
  if (status == CELD_OK && !(name = celd_alloc0 (n + 1, sizeof *name)))
    status = CELD_NO_MEMORY;
  for (size_t k = 0; status == CELD_OK && k < n; k++)
    if ((double) list[k].area >= fmax (LEAST_PIECE, LEAST_SHARE * s->width * s->width))
      name[k + 1] = (uint32_t) ++s->n;
  *many = s->n > MOST_PIECES;
  for (size_t i = 0; status == CELD_OK && i < s->n_pixels; i++)
    {
      s->piece[i] = name[inside.data[s->place[i]]];
      s->like[i]  = (uint32_t) i;
    }
  celd_free (inside.data);
  celd_free (list);
  celd_free (name);
  return status;
}

CeldStatus
celd_colour_insides_find (const CeldTrail *trail, const CeldArrowLayer *layer, CeldPieces *s)
{
  bool       many   = false;
  CeldStatus status = celd_cutting_new (trail, &s->cutting);

  if (status == CELD_OK)
    status = number_pixels (s, trail->n);
  if (status != CELD_OK || !may_have_two (s, layer))
    return status;
  for (size_t i = 0; i < s->n_pixels; i++)
    s->tint[i] = mean_round (s, layer, i);
  status = find_insides (s, layer, &many);
  s->n = many ? 0 : s->n;
  return status;
}
