/* Strokes of different colours that cross: each on its own.
 *
 * Pieces of one colour whose contacts face each other (colour-contacts.c) are one strand; the straight band between
 * them is part of it, and gets what its ends have.  Where a contact faces none and the stroke does not pass by, part of
 * it may be hidden: the strand is cut.  A piece that lies in bands of other strands is where two translucent ones
 * overlap.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/unions.h"
#include "image/image.h"
#include "input/arrow-colours.h"
#include "input/arrows.h"
#include "input/trail.h"

#include <math.h>

#define COVERED      0.8 /* share of a piece in bands of others that makes it a place where they overlap */
#define LEAST_JOINED 0.9 /* of a strand's pixels are connected */

static void
joints_end (CeldJoints *j)
{
  celd_colour_pieces_clear (&j->pieces);
  celd_free (j->contact_of);
  celd_free (j->contact);
  celd_free (j->parent);
  celd_free (j->dropped);
  celd_free (j->bands);
}

/* Is a place in the band between two contacts?  *t is how far it is from the arm of `a` to that of `b`. */
static bool
in_band (const CeldContact *a, const CeldContact *b, CeldPoint p, double *t)
{
  double dx = b->back.x - a->back.x, dy = b->back.y - a->back.y, square = dx * dx + dy * dy;
  double length = sqrt (square), from, to, along, half;

  if (!(length > 0))
    return false;
  along = ((p.x - a->back.x) * dx + (p.y - a->back.y) * dy) / length;
  from  = ((a->at.x - a->back.x) * dx + (a->at.y - a->back.y) * dy) / length - a->reach - 3;
  to    = ((b->at.x - a->back.x) * dx + (b->at.y - a->back.y) * dy) / length + b->reach + 3;
  *t    = fmax (0, fmin (1, along / length));
  half  = 0.5 * (a->width + *t * (b->width - a->width)) + 0.25;
  return along >= from && along <= to && fabs ((p.x - a->back.x) * dy - (p.y - a->back.y) * dx) <= half * length;
}

/* One bit of each pixel for every band that it is in. */
static CeldStatus
find_bands (CeldJoints *j)
{
  const CeldPieces *s = &j->pieces;

  j->bands = celd_alloc0 (s->n_pixels, sizeof *j->bands);
  if (!j->bands)
    return CELD_NO_MEMORY;
  for (size_t k = 0; k < j->n_contacts; k++)
    {
      const CeldContact *a = &j->contact[k];

      if (a->mate == CELD_NO_INDEX || a->mate < k)
        continue;
      for (size_t i = 0; i < s->n_pixels; i++)
        {
          double t;

          if (in_band (a, &j->contact[a->mate], celd_pieces_middle (s, i), &t))
            j->bands[i] |= (uint64_t) 1 << j->n_bands;
        }
      j->band[j->n_bands++] = k;
    }
  return CELD_OK;
}

/* The bits of a strand's bands. */
static uint64_t
bands_of (const CeldJoints *j, uint32_t strand)
{
  uint64_t bits = 0;

  for (size_t k = 0; k < j->n_bands; k++)
    if (celd_root (j->parent, j->contact[j->band[k]].piece) == strand)
      bits |= (uint64_t) 1 << k;
  return bits;
}

/* What a strand has in the first of some bands. */
static CeldTint
tint_in (const CeldJoints *j, uint64_t bits, CeldPoint p)
{
  const CeldContact *a, *b;
  size_t             k = 0;
  double             t = 0;

  while (!(bits >> k & 1))
    k++;
  a = &j->contact[j->band[k]];
  b = &j->contact[a->mate];
  in_band (a, b, p, &t);
  return celd_tint_between (&a->tint, &b->tint, t);
}

/* Drops strands that lie in bands of others: they are what two translucent strokes have in common. */
static CeldStatus
drop_overlaps (CeldJoints *j)
{
  const CeldPieces *s = &j->pieces;
  size_t           *all = celd_alloc0 (s->n + 1, sizeof *all), *covered = celd_alloc0 (s->n + 1, sizeof *covered);
  uint64_t         *own = celd_alloc0 (s->n + 1, sizeof *own);
  CeldStatus        status = all && covered && own ? CELD_OK : CELD_NO_MEMORY;

  for (uint32_t k = 1; k <= s->n && status == CELD_OK; k++)
    own[k] = bands_of (j, k);
  for (size_t i = 0; i < s->n_pixels && status == CELD_OK; i++)
    {
      uint32_t strand = celd_root (j->parent, s->piece[i]);

      all[strand]++;
      covered[strand] += (j->bands[i] & ~own[strand]) != 0;
    }
  for (size_t k = 1; k <= s->n && status == CELD_OK; k++)
    j->dropped[k] = (double) covered[k] >= COVERED * (double) all[k];
  celd_free (all);
  celd_free (covered);
  celd_free (own);
  return status;
}

/* Are strands that touch clearly of different colours? */
static bool
colours_are_clear (const CeldJoints *j)
{
  for (size_t i = 0; i < j->pieces.n_pixels; i++)
    for (int k = 0; k < CELD_SQUARE * CELD_SQUARE && j->contact_of[i]; k++)
      {
        int                dx = k % CELD_SQUARE - CELD_GATHERED, dy = k / CELD_SQUARE - CELD_GATHERED;
        uint32_t           other = celd_pieces_near (&j->pieces, i, dx, dy), s, u;
        const CeldContact *a, *b;

        if (!other || !j->contact_of[other - 1])
          continue;
        a = &j->contact[j->contact_of[i] - 1];
        b = &j->contact[j->contact_of[other - 1] - 1];
        s = celd_root (j->parent, a->piece);
        u = celd_root (j->parent, b->piece);
        if (s != u && !j->dropped[s] && !j->dropped[u] && a->tint.strength > 0 && b->tint.strength > 0 &&
            celd_tints_differ (j->layer, &a->tint, &b->tint, CELD_LESS_NOISE) < CELD_UNLIKE)
          return false;
      }
  return true;
}

/* ------------------------------------------------------------------ strands */

/* The strand that a pixel of no clear colour, at the rim of some, is most like; 0 if there is none. */
static uint32_t
rim_of (const CeldJoints *j, size_t pixel)
{
  const CeldPieces *s = &j->pieces;
  CeldTint          t = celd_pieces_tint (s, j->layer, pixel);
  double            least = INFINITY;
  uint32_t          strand = 0;

  for (int k = 0; k < 9; k++)
    {
      uint32_t other = celd_pieces_near (s, pixel, k % 3 - 1, k / 3 - 1);
      double   differ;

      if (!other || !s->piece[other - 1])
        continue;
      differ = celd_tints_differ (j->layer, &t, &s->tint[s->like[other - 1]], CELD_LESS_NOISE);
      if (differ < least)
        {
          least  = differ;
          strand = celd_root (j->parent, s->piece[other - 1]);
        }
    }
  return strand;
}

/* The largest connected part of what is marked with 1 stays. */
static CeldStatus
keep_largest (CeldLabels *marks, bool *most_of_it)
{
  CeldComponent *list = NULL;
  size_t         n = 0, all = 0, largest = 0;
  CeldStatus     status = celd_components (marks, 0, true, NULL, marks, &list, &n);

  if (status != CELD_OK)
    return status;
  for (size_t k = 0; k < n; k++)
    {
      all += list[k].area;
      largest = list[k].area > list[largest].area ? k : largest;
    }
  *most_of_it = n && (double) list[largest].area >= LEAST_JOINED * (double) all;
  for (size_t p = 0; p < marks->stride * (size_t) marks->height; p++)
    marks->data[p] = marks->data[p] == largest + 1;
  celd_free (list);
  return CELD_OK;
}

/* Appends the marked pixels, in the strand's own colours, and where others touch it. */
static CeldStatus
append (const CeldJoints *j, const CeldTrail *trail, uint32_t strand, const CeldLabels *marks, CeldColourStrands *to)
{
  const uint64_t     bits = bands_of (j, strand);
  const CeldPieces  *s = &j->pieces;
  const CeldCutting *c = &s->cutting;
  CeldStrands       *all = &to->strands;
  size_t             n = all->first[all->n], n_touch = to->first_touch[all->n], row = (size_t) trail->width + 2;

  for (size_t i = 0; i < s->n_pixels; i++)
    {
      CeldPoint p = celd_pieces_middle (s, i);
      int       x = c->left + (int) p.x, y = c->top + (int) p.y;
      uint32_t *pixel;
      uint8_t  *rgba;

      if (!marks->data[s->place[i]])
        continue;
      pixel        = celd_grow (all->pixel, n + 1, sizeof *pixel);
      all->pixel   = pixel ? pixel : all->pixel;
      rgba         = pixel ? celd_grow (to->rgba, n + 1, 4) : NULL;
      to->rgba     = rgba ? rgba : to->rgba;
      if (!rgba)
        return CELD_NO_MEMORY;
      pixel[n] = (uint32_t) ((size_t) (y + 1) * row + (size_t) x + 1);
      if (j->bands[i] & bits)
        {
          CeldTint tint = tint_in (j, j->bands[i] & bits, p);

          celd_tint_paint (j->layer, &tint, rgba + 4 * n);
        }
      else
        memcpy (rgba + 4 * n, celd_arrow_pixel (j->layer, x, y), 4);
      n++;
      if (j->contact_of[i] && celd_root (j->parent, s->piece[i]) == strand &&
          j->contact[j->contact_of[i] - 1].mate == CELD_NO_INDEX)
        {
          CeldPoint *touch = celd_grow (to->touch, n_touch + 1, sizeof *touch);

          if (!touch)
            return CELD_NO_MEMORY;
          to->is_cut[all->n] |= !j->contact[j->contact_of[i] - 1].passes;
          to->touch        = touch;
          touch[n_touch++] = (CeldPoint) { x + 0.5, y + 0.5 };
        }
    }
  all->first[++all->n]      = n;
  to->first_touch[all->n] = n_touch;
  return CELD_OK;
}

static CeldStatus
add_strand (CeldJoints *j, const CeldTrail *trail, uint32_t strand, CeldColourStrands *to, bool *clear)
{
  const CeldPieces *s = &j->pieces;
  const uint64_t    bits = bands_of (j, strand);
  CeldLabels        marks = { 0 };
  CeldStatus        status = celd_labels_new (s->cutting.width, s->cutting.height, &marks);

  for (size_t i = 0; i < s->n_pixels && status == CELD_OK; i++)
    {
      uint32_t own = s->piece[i] ? celd_root (j->parent, s->piece[i]) : rim_of (j, i);

      marks.data[s->place[i]] = own == strand || j->bands[i] & bits;
    }
  if (status == CELD_OK)
    status = keep_largest (&marks, clear);
  if (status == CELD_OK && *clear)
    status = append (j, trail, strand, &marks, to);
  celd_free (marks.data);
  return status;
}

static CeldStatus
add_strands (CeldJoints *j, const CeldTrail *trail, CeldColourStrands *to)
{
  bool       clear = true;
  CeldStatus status = CELD_OK;

  to->strands.first = celd_alloc0 (j->pieces.n + 1, sizeof *to->strands.first);
  to->first_touch   = celd_alloc0 (j->pieces.n + 1, sizeof *to->first_touch);
  to->is_cut          = celd_alloc0 (j->pieces.n + 1, sizeof *to->is_cut);
  if (!to->strands.first || !to->first_touch || !to->is_cut)
    return CELD_NO_MEMORY;
  for (uint32_t k = 1; k <= j->pieces.n && status == CELD_OK && clear; k++)
    if (celd_root (j->parent, k) == k && !j->dropped[k])
      status = add_strand (j, trail, k, to, &clear);
  if (!clear || to->strands.n < 2)
    to->strands.n = 0;
  return status;
}

CeldStatus
celd_strand_colours_find (const CeldTrail *trail, const CeldArrowLayer *layer, CeldColourStrands *found)
{
  CeldJoints            j = { .layer = layer };
  CeldColourStrands made = { 0 };
  bool              many = false;
  CeldStatus        status = celd_colour_pieces_find (trail, layer, &j.pieces);

  if (status != CELD_OK || j.pieces.n < 2)
    goto done;
  j.parent  = celd_alloc (j.pieces.n + 1, sizeof *j.parent);
  j.dropped = celd_alloc0 (j.pieces.n + 1, sizeof *j.dropped);
  if (!j.parent || !j.dropped)
    {
      status = CELD_NO_MEMORY;
      goto done;
    }
  celd_roots (j.parent, j.pieces.n + 1);
  status = celd_colour_contacts_find (&j, &many);
  if (status != CELD_OK || many)
    goto done;
  status = find_bands (&j);
  if (status == CELD_OK)
    status = drop_overlaps (&j);
  if (status == CELD_OK && colours_are_clear (&j))
    status = add_strands (&j, trail, &made);

done:
  joints_end (&j);
  if (status == CELD_OK)
    *found = made;
  else
    celd_strand_colours_clear (&made);
  return status;
}

void
celd_strand_colours_clear (CeldColourStrands *found)
{
  celd_strands_clear (&found->strands);
  celd_free (found->rgba);
  celd_free (found->touch);
  celd_free (found->first_touch);
  celd_free (found->is_cut);
  *found = (CeldColourStrands) { 0 };
}
