/* A connected component of paint taken apart into pieces of one colour each.
 *
 * Pieces grow from their insides (colour-insides.c) over pixels of like colour; those that touch then in like colours
 * are one, too.  Rims that are left go to the only piece near them.  What is left now lies where strokes cross, and is
 * of no clear colour.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/unions.h"
#include "input/arrow-colours.h"
#include "input/arrows.h"
#include "input/trail.h"

#include <math.h>

#define RIMS  2   /* steps that rims are wide */
#define MIXED 0.8 /* the means of two insides that seem one differ by less */

/* The eight neighbours of a pixel, counted from 1; 0 = not painted. */
static uint32_t
beside (const CeldPieces *s, size_t pixel, int k)
{
  static const int dx[8] = { -1, 0, 1, -1, 1, -1, 0, 1 }, dy[8] = { -1, -1, -1, 0, 0, 1, 1, 1 };

  return celd_pieces_near (s, pixel, dx[k], dy[k]);
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
        uint32_t i = queue[head], other = beside (s, i, k);
        CeldTint t;

        if (!other || s->piece[other - 1])
          continue;
        t = celd_pieces_tint (s, layer, other - 1);
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
        uint32_t other = beside (s, i, k), a = s->piece[i], b;
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
    s->widths[k] = celd_lines_width (s->widths[k] / fmax (1, n[k]));
  celd_free (n);
  return n && s->widths ? CELD_OK : CELD_NO_MEMORY;
}

/* A pixel of the only piece within two pixels, counted from 1; 0 if there is none or another one, too. */
static uint32_t
only_piece_near (const CeldPieces *s, size_t pixel)
{
  uint32_t found = 0;

  for (int k = 0; k < 25; k++)
    {
      int      dx = k % 5 - 2, dy = k / 5 - 2;
      uint32_t other = celd_pieces_near (s, pixel, dx, dy);

      if (!other || !s->piece[other - 1])
        continue;
      if (found && s->piece[found - 1] != s->piece[other - 1])
        return 0;
      if (!found || (dx >= -1 && dx <= 1 && dy >= -1 && dy <= 1))
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
          uint32_t other = beside (s, i, k);

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
  bool                clear = true;
  CeldStatus          status = celd_colour_insides_find (trail, layer, &made);

  if (status != CELD_OK || made.n < 2)
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
      made.n  = clear ? made.n : 0;
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
