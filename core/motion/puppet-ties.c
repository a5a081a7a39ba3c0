/* Ties of a puppet: which pieces go with each other when one of them is not held, as an eye goes with its head.
 *
 * Ties are those contacts between pieces that form a maximum spanning forest, where a contact that is seen counts more
 * than one of a piece that is hidden by the other.  Which of them hold depends on the handles.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/puppet.h"

#include <stdlib.h>

#define SEEN_CONTACT 1000   /* times that a contact that is seen outweighs a hidden one; chosen */

/* Two cells of different pieces that touch. */
typedef struct { uint32_t cell[2], piece[2]; double weight; } PieceContact;

typedef struct
{
  CeldPuppet *puppet;
  PieceContact    *contact;
  size_t      n_contacts, capacity;
  CeldStatus  status;
} Ties;

static void
add_contact (Ties *t, uint32_t a, uint32_t b, double weight)
{
  const uint32_t *piece = t->puppet->lattice.piece;
  bool            turned = piece[a] > piece[b];
  PieceContact         one = { { turned ? b : a, turned ? a : b }, { 0, 0 }, weight };
  PieceContact        *last = t->n_contacts ? &t->contact[t->n_contacts - 1] : NULL;

  if (piece[a] == piece[b] || t->status != CELD_OK)
    return;
  for (int i = 0; i < 2; i++)
    one.piece[i] = piece[one.cell[i]];
  if (last && !memcmp (last->cell, one.cell, sizeof one.cell))
    last->weight += weight;
  else
    t->status = celd_append (t->contact, t->n_contacts, t->capacity, one);
}

static void
add_seen_contact (void *data, uint32_t a, uint32_t b, int x, int y, int right)
{
  (void) x;
  (void) y;
  (void) right;
  add_contact (data, a, b, SEEN_CONTACT);
}

/* Adds contacts of what is hidden with what hides it. */
static void
add_hidden_contacts (Ties *t)
{
  const CeldPuppet *puppet = t->puppet;

  for (size_t k = 0; k < puppet->n; k++)
    {
      const CeldPuppetLayer *layer = &puppet->layer[k];

      for (int y = layer->box.y; layer->cell && y < layer->box.y + layer->box.height; y++)
        for (int x = layer->box.x; x < layer->box.x + layer->box.width; x++)
          {
            uint32_t a = layer->cell[celd_puppet_pixel (layer, x, y)], b = celd_puppet_front_cell (puppet, x, y);

            if (a && b)
              add_contact (t, a - 1, b - 1, 1);
          }
    }
}

static int
by_pieces (const void *a, const void *b)
{
  const PieceContact *p = a, *q = b;

  for (int i = 0; i < 2; i++)
    if (p->piece[i] != q->piece[i])
      return p->piece[i] < q->piece[i] ? -1 : 1;
  for (int i = 0; i < 2; i++)
    if (p->cell[i] != q->cell[i])
      return p->cell[i] < q->cell[i] ? -1 : 1;
  return 0;
}

static int
by_weight (const void *a, const void *b)
{
  const PieceContact *p = a, *q = b;

  return p->weight != q->weight ? (p->weight > q->weight ? -1 : 1) : by_pieces (a, b);
}

/* Keeps, of the contacts sorted by pieces, those of the maximum spanning forest: kept[i] is the rank of its pair of
 * pieces by length of contact, from 1; 0: it is left out. */
static CeldStatus
span (Ties *t, uint32_t *kept)
{
  size_t    pieces = t->puppet->lattice.n_pieces, n = 0;
  uint32_t *set = celd_alloc (pieces, sizeof *set);
  PieceContact  *pair = celd_alloc (t->n_contacts, sizeof *pair);

  if (set && pair)
    {
      celd_roots (set, pieces);
      for (size_t i = 0; i < t->n_contacts; i++)
        if (n && !memcmp (pair[n - 1].piece, t->contact[i].piece, sizeof pair->piece))
          pair[n - 1].weight += t->contact[i].weight;
        else
          {
            pair[n] = t->contact[i];
            pair[n++].cell[0] = (uint32_t) i; /* the first contact of this pair */
          }
      qsort (pair, n, sizeof *pair, by_weight);
      for (size_t k = 0; k < n; k++)
        if (celd_root (set, pair[k].piece[0]) != celd_root (set, pair[k].piece[1]))
          {
            celd_join (set, pair[k].piece[0], pair[k].piece[1]);
            for (size_t i = pair[k].cell[0]; i < t->n_contacts &&
                 !memcmp (pair[k].piece, t->contact[i].piece, sizeof pair->piece); i++)
              kept[i] = (uint32_t) k + 1;
          }
    }
  celd_free (set);
  celd_free (pair);
  return set && pair ? CELD_OK : CELD_NO_MEMORY;
}

static int
compare_ties (const void *a, const void *b)
{
  const CeldPuppetTie *p = a, *q = b;

  if (p->contact != q->contact)
    return p->contact < q->contact ? -1 : 1;
  for (int i = 0; i < 2; i++)
    if (p->vertex[i] != q->vertex[i])
      return p->vertex[i] < q->vertex[i] ? -1 : 1;
  return 0;
}

/* Makes ties of the vertices of those contacts, each once. */
static CeldStatus
fill_ties (Ties *t, const uint32_t *kept)
{
  CeldPuppet        *puppet = t->puppet;
  const CeldLattice *lattice = &puppet->lattice;
  size_t             capacity = 0, n = 0;
  CeldStatus         status = CELD_OK;

  for (size_t c = 0; c < t->n_contacts; c++)
    for (size_t i = 0; i < 16 && kept[c] && status == CELD_OK; i++)
      {
        const uint32_t *cell = t->contact[c].cell;

        if (celd_puppet_same_place (lattice, cell[0], (int) i / 4, cell[1], (int) i % 4))
          status = celd_append (puppet->tie, n, capacity,
                                (CeldPuppetTie) { kept[c], { lattice->corner[4 * (size_t) cell[0] + i / 4],
                                                             lattice->corner[4 * (size_t) cell[1] + i % 4] } });
      }
  puppet->lattice.seam = celd_alloc (n, 2 * sizeof *puppet->lattice.seam);
  if (!puppet->lattice.seam)
    status = CELD_NO_MEMORY;
  if (n)
    qsort (puppet->tie, n, sizeof *puppet->tie, compare_ties);
  for (size_t i = 0; i < n; i++)
    if (!i || compare_ties (&puppet->tie[puppet->n_ties - 1], &puppet->tie[i]))
      puppet->tie[puppet->n_ties++] = puppet->tie[i];
  return status;
}

CeldStatus
celd_puppet_tie (CeldPuppet *puppet)
{
  Ties       t = { .puppet = puppet };
  uint32_t  *kept = NULL;
  CeldStatus status;

  celd_puppet_contacts (puppet, add_seen_contact, &t);
  add_hidden_contacts (&t);
  if (t.n_contacts)
    qsort (t.contact, t.n_contacts, sizeof *t.contact, by_pieces);
  kept   = celd_alloc0 (t.n_contacts, sizeof *kept);
  status = kept ? t.status : CELD_NO_MEMORY;
  if (status == CELD_OK)
    status = span (&t, kept);
  if (status == CELD_OK)
    status = fill_ties (&t, kept);
  celd_free (kept);
  celd_free (t.contact);
  return status;
}
