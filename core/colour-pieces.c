/* A connected component of paint taken apart into pieces of one colour each.
 *
 * The mean colour round a pixel does not change along a stroke, though it does across: rims are soft, bleed, and echo in
 * lossy pictures.  Where it changes little on all sides is the inside of a piece; insides that touch are one piece,
 * so that a brush whose colour changes slowly leaves one.  From there pieces grow over pixels of like colour; those
 * that touch then in like colours are one, too.  Rims that are left go to the only piece near them.  What is left now
 * lies where strokes cross, and is of no clear colour.
 *
 * Costs about a hundred steps a pixel.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "arrow-colours.h"
#include "unions.h"

#include <math.h>

#define REACH       3    /* pixels, or a quarter of the lines' width: means are taken so far around, */
#define FLAT        0.35 /* and change by less than this inside a piece */
#define FAINT       24   /* opacity: what is less has no inside */
#define LEAST_PIECE 8    /* pixels of an inside, */
#define LEAST_SHARE 0.5  /* and of the square of the lines' width */
#define MOST_PIECES 64   /* more are no arrows */
#define RIMS        2    /* steps that rims are wide */
#define MIXED       0.8  /* the means of two insides that seem one differ by less */

/* Eight neighbours in the cutting. */
static size_t
beside (const CeldCutting *c, size_t p, int k)
{
  size_t w = (size_t) c->width;

  switch (k)
    {
    case 0:  return p - w - 1;
    case 1:  return p - w;
    case 2:  return p - w + 1;
    case 3:  return p - 1;
    case 4:  return p + 1;
    case 5:  return p + w - 1;
    case 6:  return p + w;
    default: return p + w + 1;
    }
}

/* Of a long straight line whose pixels lie so deep in the paint, in the mean of squares. */
static double
width_of (double squared)
{
  return fmax (1, sqrt (12 * squared) - 1);
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
  s->width = width_of (sum / (double) s->n_pixels);
  return CELD_OK;
}

static CeldTint
tint_of (const CeldPieces *s, const CeldArrowLayer *layer, size_t pixel)
{
  const CeldCutting *c = &s->cutting;

  return celd_tint_at (layer, c->left + (int) (s->place[pixel] % (size_t) c->width),
                       c->top + (int) (s->place[pixel] / (size_t) c->width));
}

/* Are there pixels, strong enough to tell, of a colour other than the strongest one's? */
static bool
may_have_two (const CeldPieces *s, const CeldArrowLayer *layer)
{
  CeldTint strongest = { .strength = -1 };

  for (size_t i = 0; i < s->n_pixels; i++)
    {
      CeldTint t = tint_of (s, layer, i);

      if (t.strength > strongest.strength)
        strongest = t;
    }
  for (size_t i = 0; i < s->n_pixels; i++)
    {
      CeldTint t = tint_of (s, layer, i);

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
  const CeldCutting *c = &s->cutting;
  int                reach = reach_of (s);
  int                px = (int) (s->place[pixel] % (size_t) c->width), py = (int) (s->place[pixel] / (size_t) c->width);

  if (s->tint[pixel].strength < FAINT)
    return false;
  for (int k = 0; k < 16; k++)
    {
      static const int dx[8] = { -1, 0, 1, -1, 1, -1, 0, 1 }, dy[8] = { -1, -1, -1, 0, 0, 1, 1, 1 };
      int              far = k < 8 ? reach : (reach + 1) / 2, x = px + far * dx[k % 8], y = py + far * dy[k % 8];
      uint32_t         other;

      if (x < 0 || y < 0 || x >= c->width || y >= c->height)
        continue;
      other = s->number[(size_t) y * (size_t) c->width + (size_t) x];
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

/* Takes in the neighbours of pixels in pieces, and theirs, that differ no more than `most` from where they came from.
 * The queue has room for all pixels. */
static void
grow_pieces (CeldPieces *s, const CeldArrowLayer *layer, double most, uint32_t *queue)
{
  size_t n = 0;

  for (size_t i = 0; i < s->n_pixels; i++)
    if (s->piece[i])
      queue[n++] = (uint32_t) i;
  for (size_t head = 0; head < n; head++)
    for (int k = 0; k < 8; k++)
      {
        uint32_t i = queue[head], other = s->number[beside (&s->cutting, s->place[i], k)];
        CeldTint t;

        if (!other || s->piece[other - 1])
          continue;
        t = tint_of (s, layer, other - 1);
        if (celd_tints_differ (layer, &t, &s->tint[s->like[i]], CELD_NOISE) > most)
          continue;
        s->piece[other - 1] = s->piece[i];
        s->like[other - 1]  = s->like[i];
        queue[n++] = other - 1;
      }
}

/* The mean tint of each piece. */
static CeldStatus
find_means (const CeldPieces *s, CeldTint **mean)
{
  double (*sum)[5] = celd_alloc0 (s->n + 1, sizeof *sum);

  *mean = celd_alloc0 (s->n + 1, sizeof **mean);
  for (size_t i = 0; sum && *mean && i < s->n_pixels; i++)
    {
      double *of = sum[s->piece[i]];

      for (int k = 0; k < 3; k++)
        of[k] += s->tint[i].c[k];
      of[3] += s->tint[i].strength;
      of[4]++;
    }
  for (size_t k = 1; sum && *mean && k <= s->n; k++)
    {
      for (int i = 0; i < 3; i++)
        (*mean)[k].c[i] = (float) (sum[k][i] / fmax (1, sum[k][4]));
      (*mean)[k].strength = (float) (sum[k][3] / fmax (1, sum[k][4]));
    }
  celd_free (sum);
  return sum && *mean ? CELD_OK : CELD_NO_MEMORY;
}

/* Joins pieces that touch in like colours, and numbers them anew.  *clear becomes false if somewhere it cannot be told
 * whether two colours are one. */
static CeldStatus
join_alike (CeldPieces *s, const CeldArrowLayer *layer, bool *clear)
{
  uint32_t  *parent = celd_alloc (s->n + 1, sizeof *parent), *name = celd_alloc0 (s->n + 1, sizeof *name);
  CeldTint  *mean = NULL;
  size_t     n = 0;
  CeldStatus status = parent && name ? find_means (s, &mean) : CELD_NO_MEMORY;

  for (uint32_t k = 0; status == CELD_OK && k <= s->n; k++)
    parent[k] = k;
  for (size_t i = 0; status == CELD_OK && i < s->n_pixels; i++)
    for (int k = 4; k < 8 && s->piece[i]; k++)
      {
        uint32_t other = s->number[beside (&s->cutting, s->place[i], k)], a = s->piece[i], b;
        double   differ;

        if (!other || !(b = s->piece[other - 1]) || a == b)
          continue;
        differ = celd_tints_differ (layer, &s->tint[s->like[i]], &s->tint[s->like[other - 1]], CELD_LESS_NOISE);
        if (differ >= CELD_ALIKE)
          continue;
        celd_join (parent, a, b);
        *clear &= celd_tints_differ (layer, &mean[a], &mean[b], CELD_LESS_NOISE) < MIXED;
      }
  for (uint32_t k = 1; status == CELD_OK && k <= s->n; k++)
    name[k] = celd_root (parent, k) == k ? (uint32_t) ++n : name[celd_root (parent, k)];
  for (size_t i = 0; status == CELD_OK && i < s->n_pixels; i++)
    s->piece[i] = name[s->piece[i]];
  s->n = n;
  celd_free (parent);
  celd_free (name);
  celd_free (mean);
  return status;
}

/* The widths of pieces, by their insides: there nothing else makes the paint wider. */
static CeldStatus
find_widths (CeldPieces *s)
{
  double *n = celd_alloc0 (s->n + 1, sizeof *n);

  s->widths = celd_alloc0 (s->n + 1, sizeof *s->widths);
  for (size_t i = 0; n && s->widths && i < s->n_pixels; i++)
    if (s->like[i] == i && s->piece[i])
      {
        s->widths[s->piece[i]] += s->cutting.squared[s->place[i]];
        n[s->piece[i]]++;
      }
  for (size_t k = 1; n && s->widths && k <= s->n; k++)
    s->widths[k] = width_of (s->widths[k] / fmax (1, n[k]));
  celd_free (n);
  return n && s->widths ? CELD_OK : CELD_NO_MEMORY;
}

/* A pixel of the only piece within two pixels; 0 if there is none or another one, too. */
static uint32_t
only_piece_near (const CeldPieces *s, size_t pixel)
{
  const CeldCutting *c = &s->cutting;
  int                px = (int) (s->place[pixel] % (size_t) c->width), py = (int) (s->place[pixel] / (size_t) c->width);
  uint32_t           found = 0;

  for (int y = py - 2; y <= py + 2; y++)
    for (int x = px - 2; x <= px + 2; x++)
      {
        uint32_t other = x >= 0 && y >= 0 && x < c->width && y < c->height
                           ? s->number[(size_t) y * (size_t) c->width + (size_t) x] : 0;

        if (!other || !s->piece[other - 1])
          continue;
        if (found && s->piece[found - 1] != s->piece[other - 1])
          return 0;
        if (!found || (x - px >= -1 && x - px <= 1 && y - py >= -1 && y - py <= 1))
          found = other;
      }
  return found;
}

/* One step of rims.  `taken` has room for all pixels. */
static void
take_rims (CeldPieces *s, uint32_t *taken)
{
  for (size_t i = 0; i < s->n_pixels; i++)
    {
      bool beside_one = false;

      for (int k = 0; k < 8 && !s->piece[i]; k++)
        {
          uint32_t other = s->number[beside (&s->cutting, s->place[i], k)];

          beside_one |= other && s->piece[other - 1];
        }
      taken[i] = beside_one ? only_piece_near (s, i) : 0;
    }
  for (size_t i = 0; i < s->n_pixels; i++)
    if (taken[i])
      {
        s->like[i]  = s->like[taken[i] - 1];
        taken[i]    = s->piece[taken[i] - 1];
      }
  for (size_t i = 0; i < s->n_pixels; i++)
    if (taken[i])
      s->piece[i] = taken[i];
}

CeldStatus
celd_colour_pieces_find (const CeldTrail *trail, const CeldArrowLayer *layer, CeldPieces *pieces)
{
  static const double steps[] = { 0.15, 0.3, 0.45, CELD_ALIKE };
  CeldPieces          made = { 0 };
  uint32_t           *queue = NULL;
  bool                many = false, clear = true;
  CeldStatus          status = celd_cutting_new (trail, &made.cutting);

  if (status == CELD_OK)
    status = number_pixels (&made, trail->n);
  if (status != CELD_OK || !may_have_two (&made, layer))
    goto done;
  for (size_t i = 0; i < made.n_pixels; i++)
    made.tint[i] = mean_round (&made, layer, i);
  status = find_insides (&made, layer, &many);
  if (status != CELD_OK || many || made.n < 2)
    goto done;
  queue = celd_alloc (made.n_pixels, sizeof *queue);
  if (!queue)
    {
      status = CELD_NO_MEMORY;
      goto done;
    }
  for (size_t i = 0; i < sizeof steps / sizeof *steps; i++)
    grow_pieces (&made, layer, steps[i], queue);
  status = join_alike (&made, layer, &clear);
  if (status == CELD_OK)
    status = find_widths (&made);
  for (int i = 0; i < RIMS && status == CELD_OK; i++)
    take_rims (&made, queue);

done:
  celd_free (queue);
  if (status == CELD_OK)
    {
      made.n = many || !clear ? 0 : made.n;
      *pieces = made;
    }
  else
    celd_colour_pieces_clear (&made);
  return status;
}

void
celd_colour_pieces_clear (CeldPieces *pieces)
{
  celd_cutting_clear (&pieces->cutting);
  celd_free (pieces->number);
  celd_free (pieces->place);
  celd_free (pieces->tint);
  celd_free (pieces->piece);
  celd_free (pieces->like);
  celd_free (pieces->widths);
  *pieces = (CeldPieces) { 0 };
}
