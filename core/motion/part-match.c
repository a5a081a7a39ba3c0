/* Where each vertex of a key's lattice is in the other key.
 *
 * Parts that both keys have are matched one by one, those first of which most is seen.  A part first moves rigidly;
 * then its lattice in the key that shows less of it is registered to the lines of the other one (register.c).  The
 * other key's lattice gets the inverse of that motion.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/inbetween.h"

#include <stdlib.h>

#define WINDOW_BORDER 2    /* cells around a part where it is looked for; chosen */
#define LEAST_LINES  12    /* pixels of lines that are seen; with fewer a part moves rigidly; chosen */
#define LESS_SEEN    0.8f  /* of the lines of the first key: with fewer seen in the second one this is registered; chosen */

typedef struct
{
  CeldInbetween      *between;
  const CeldKey      *key;
  const CeldSettings *settings;
  float              *sum[2];   /* of each vertex: x, y of its ends in all layers, and their number */
} Matching;

typedef struct { size_t part, seen; } PartOrder;

/* ------------------------------------------------------------------ vertices by their places */

static int
compare_rest (const void *a, const void *b)
{
  const CeldRestVertex *p = a, *q = b;

  if (p->y != q->y)
    return p->y < q->y ? -1 : 1;
  if (p->x != q->x)
    return p->x < q->x ? -1 : 1;
  if (p->layer != q->layer)
    return p->layer < q->layer ? -1 : 1;
  return p->vertex < q->vertex ? -1 : p->vertex > q->vertex;
}

/* Lists the vertices of all layers of the first key that move. */
static CeldStatus
list_rest (CeldInbetween *between)
{
  const CeldPuppet  *puppet = between->key[0];
  const CeldLattice *lattice = &puppet->lattice;
  size_t             n = 0;

  between->rest = celd_alloc (4 * lattice->n_cells, sizeof *between->rest);
  if (!between->rest)
    return CELD_NO_MEMORY;
  for (size_t k = 0; k < puppet->n; k++)
    for (size_t i = 4 * puppet->layer[k].first; i < 4 * (puppet->layer[k].first + puppet->layer[k].n_cells); i++)
      {
        uint32_t v = lattice->corner[i];

        between->rest[n++] = (CeldRestVertex) { lattice->rest[2 * (size_t) v], lattice->rest[2 * (size_t) v + 1], v,
                                                k };
      }
  if (n)
    qsort (between->rest, n, sizeof *between->rest, compare_rest);
  for (size_t i = 0; i < n; i++)
    if (!between->n_rest || compare_rest (&between->rest[between->n_rest - 1], &between->rest[i]))
      between->rest[between->n_rest++] = between->rest[i];
  return CELD_OK;
}

static int
compare_bonds (const void *a, const void *b)
{
  const CeldPartBond *p = a, *q = b;

  return p->layer < q->layer ? -1 : p->layer > q->layer;
}

/* The places where a layer of the first key touches layers that are matched already. */
static CeldStatus
find_bonds (const Matching *m, size_t layer, CeldRect window, CeldPartBond **bond, size_t *n)
{
  const CeldRestVertex *rest = m->between->rest;
  size_t                capacity = 0, all = m->between->n_rest;
  CeldStatus            status = CELD_OK;

  for (size_t i = 0, end; i < all; i = end)
    {
      bool here = false;

      for (end = i; end < all && rest[end].x == rest[i].x && rest[end].y == rest[i].y; end++)
        here |= rest[end].layer == layer;
      for (size_t j = i; j < end && here && status == CELD_OK; j++)
        {
          const float *sum = m->sum[0] + 3 * (size_t) rest[j].vertex;

          if (rest[j].layer != layer && sum[2] > 0)
            status = celd_append (*bond, *n, capacity, (CeldPartBond) {
              rest[j].layer, { rest[j].x - (float) window.x, rest[j].y - (float) window.y },
              { sum[0] / sum[2] - (float) window.x, sum[1] / sum[2] - (float) window.y } });
        }
    }
  if (*n)
    qsort (*bond, *n, sizeof **bond, compare_bonds);
  return status;
}

/* ------------------------------------------------------------------ one part */

/* Registers the lattice of a part, of key s in the window, to the lines of the other key. */
static CeldStatus
register_part (const Matching *m, const CeldPartLines lines[2], int s, const CeldPartPose *pose, const CeldHost *host,
               CeldLattice *lattice)
{
  CeldPartPose own = s ? celd_part_pose_back (pose) : *pose;
  float       *fit = celd_alloc (lattice->n_vertices, sizeof *fit);
  CeldStatus   status = fit ? CELD_OK : CELD_NO_MEMORY;

  for (size_t v = 0; v < lattice->n_vertices; v++)
    celd_part_pose_map (&own, lattice->rest[2 * v], lattice->rest[2 * v + 1], lattice->place + 2 * v);
  if (status == CELD_OK && lines[s].n_seen >= LEAST_LINES && lines[!s].n_seen >= LEAST_LINES)
    status = celd_register_lines ((CeldLineMarks) { lines[s].seen, lines[s].hidden },
                                  (CeldLineMarks) { lines[!s].seen, lines[!s].hidden }, true, m->settings, host,
                                  lattice, fit);
  celd_free (fit);
  return status;
}

static void
add_end (float *sum, float x, float y)
{
  sum[0] += x;
  sum[1] += y;
  sum[2] += 1;
}

/* Adds the ends of the vertices of a part: of key s as its lattice lies, of the other one by the inverse motion. */
static CeldStatus
add_ends (Matching *m, const CeldBetweenPart *part, int s, CeldRect window, const CeldLattice *lattice)
{
  const CeldPuppet *own = m->between->key[s], *other = m->between->key[!s];
  CeldAffine       *back = celd_alloc (lattice->n_cells, sizeof *back);
  const CeldPuppetLayer *layer = &other->layer[part->layer[!s]];
  size_t            first = own->layer[part->layer[s]].first;
  float             left = (float) window.x, top = (float) window.y;

  if (!back)
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < 4 * lattice->n_cells; i++)
    {
      const float *place = lattice->place + 2 * (size_t) lattice->corner[i];

      add_end (m->sum[s] + 3 * (size_t) own->lattice.corner[4 * first + i], place[0] + left, place[1] + top);
    }
  for (size_t c = 0; c < lattice->n_cells; c++)
    back[c] = celd_cell_motion (lattice, c, lattice->place, lattice->rest);
  for (size_t i = 4 * layer->first; i < 4 * (layer->first + layer->n_cells); i++)
    {
      const float *rest = other->lattice.rest + 2 * (size_t) other->lattice.corner[i];
      CeldCarriers carriers = celd_carriers_at (back, lattice->n_cells, (float) lattice->side, rest[0] - left,
                                             rest[1] - top);
      float        at[2];

      celd_carry (&carriers, back, rest[0] - left, rest[1] - top, at);
      add_end (m->sum[!s] + 3 * (size_t) other->lattice.corner[i], at[0] + left, at[1] + top);
    }
  celd_free (back);
  return CELD_OK;
}

/* Adds cells around a box, as far as the drawing goes. */
static CeldRect
window_of (const CeldPuppet *puppet, CeldRect box)
{
  int border = WINDOW_BORDER * puppet->lattice.side;
  int left = box.x > border ? box.x - border : 0, top = box.y > border ? box.y - border : 0;
  int right = box.x + box.width + border, bottom = box.y + box.height + border;

  right  = right < puppet->width ? right : puppet->width;
  bottom = bottom < puppet->height ? bottom : puppet->height;
  return (CeldRect) { left, top, right - left, bottom - top };
}

static CeldStatus
match_part (Matching *m, const CeldBetweenPart *part, const CeldHost *host)
{
  const CeldPuppet *a = m->between->key[0], *b = m->between->key[1];
  CeldRect          window = window_of (a, celd_rect_union (a->layer[part->layer[0]].box,
                                                            b->layer[part->layer[1]].box));
  CeldPartLines     lines[2] = { { .n_seen = 0 }, { .n_seen = 0 } };
  CeldLattice      *lattice = NULL;
  CeldPartBond     *bond = NULL;
  size_t            n_bonds = 0;
  float             scale = (float) (a->width > a->height ? a->width : a->height) / CELD_KEY_SIDE;
  CeldStatus        status = celd_part_lines_new (a, part->layer[0], m->key[0].ink, window, host, &lines[0]);

  if (status == CELD_OK)
    status = celd_part_lines_new (b, part->layer[1], m->key[1].ink, window, host, &lines[1]);
  if (status == CELD_OK)
    status = find_bonds (m, part->layer[0], window, &bond, &n_bonds);
  if (status == CELD_OK)
    {
      int          s = (float) lines[1].n_seen < LESS_SEEN * (float) lines[0].n_seen;
      CeldPartPose pose;

      celd_part_pose_find (lines, scale, bond, n_bonds, host, &pose);
      status = celd_puppet_layer_lattice (&m->between->key[s]->layer[part->layer[s]], window, m->key[s].ink,
                                          m->settings, host, &lattice);
      if (status == CELD_OK && lattice)
        status = register_part (m, lines, s, &pose, host, lattice);
      if (status == CELD_OK && lattice)
        status = add_ends (m, part, s, window, lattice);
    }
  celd_lattice_free (lattice);
  celd_free (bond);
  celd_part_lines_clear (&lines[0]);
  celd_part_lines_clear (&lines[1]);
  return status;
}

/* ------------------------------------------------------------------ all parts */

static int
by_seen (const void *a, const void *b)
{
  const PartOrder *p = a, *q = b;

  if (p->seen != q->seen)
    return p->seen > q->seen ? -1 : 1;
  return p->part < q->part ? -1 : p->part > q->part;
}

/* Matches the parts of both keys, most visible ones first. */
static CeldStatus
match_parts (Matching *m, const CeldHost *host)
{
  CeldInbetween *between = m->between;
  const CeldPuppet *puppet = between->key[0];
  PartOrder     *order = celd_alloc0 (between->n, sizeof *order);
  size_t        *seen = celd_alloc0 (puppet->n, sizeof *seen);
  CeldStatus     status = order && seen ? CELD_OK : CELD_NO_MEMORY;

  for (size_t p = 0; p < (size_t) puppet->width * (size_t) puppet->height && status == CELD_OK; p++)
    seen[puppet->front[p]]++;
  for (size_t i = 0; i < between->n && status == CELD_OK; i++)
    order[i] = (PartOrder) { i, between->part[i].layer[0] == CELD_NO_INDEX ? 0 : seen[between->part[i].layer[0]] };
  if (status == CELD_OK && between->n)
    qsort (order, between->n, sizeof *order, by_seen);
  for (size_t i = 0; i < between->n && status == CELD_OK; i++)
    {
      const CeldBetweenPart *part = &between->part[order[i].part];
      CeldHostPart           one;
      CeldHost               quiet = celd_host_part (&one, host, (double) i / (double) between->n,
                                                     (double) i / (double) between->n);

      if (celd_between_both (between, part))
        status = match_part (m, part, &quiet);
      if (status == CELD_OK)
        status = celd_progress (host, (double) (i + 1) / (double) between->n);
    }
  celd_free (order);
  celd_free (seen);
  return status;
}

static void
take_ends (const Matching *m)
{
  for (int s = 0; s < 2; s++)
    {
      const CeldLattice *lattice = &m->between->key[s]->lattice;

      for (size_t v = 0; v < lattice->n_vertices; v++)
        {
          const float *sum = m->sum[s] + 3 * v;

          m->between->known[s][v] = sum[2] > 0;
          for (size_t c = 0; c < 2; c++)
            m->between->end[s][2 * v + c] = sum[2] > 0 ? sum[c] / sum[2] : lattice->rest[2 * v + c];
        }
    }
}

/* Finds the cells of the first key that carry the second key's vertices. */
static CeldStatus
carry_second (CeldInbetween *between)
{
  const CeldLattice *a = &between->key[0]->lattice, *b = &between->key[1]->lattice;
  CeldAffine        *motion = celd_alloc (a->n_cells, sizeof *motion);

  if (!motion)
    return CELD_NO_MEMORY;
  for (size_t c = 0; c < a->n_cells; c++)
    motion[c] = celd_cell_motion (a, c, between->end[0], a->rest);
  for (size_t i = between->n; i--;)
    {
      const CeldBetweenPart *part = &between->part[i];
      const CeldPuppetLayer *from, *to;

      if (!celd_between_both (between, part))
        continue;
      from = &between->key[0]->layer[part->layer[0]];
      to   = &between->key[1]->layer[part->layer[1]];
      for (size_t k = 4 * to->first; k < 4 * (to->first + to->n_cells); k++)
        {
          size_t       v = b->corner[k];
          CeldCarriers found = celd_carriers_at (motion + from->first, from->n_cells, (float) a->side, b->rest[2 * v],
                                              b->rest[2 * v + 1]);

          for (int c = 0; c < CELD_CARRIERS; c++)
            found.cell[c] += (uint32_t) from->first;
          between->carrier[v] = found;
        }
    }
  celd_free (motion);
  return CELD_OK;
}

CeldStatus
celd_parts_match (CeldInbetween *between, const CeldKey key[2], const CeldSettings *settings, const CeldHost *host)
{
  Matching     m = { .between = between, .key = key };
  CeldSettings own = *settings;
  CeldStatus   status = list_rest (between);

  own.cell_size = between->key[0]->lattice.side;
  m.settings    = &own;
  for (int s = 0; s < 2 && status == CELD_OK; s++)
    {
      m.sum[s] = celd_alloc0 (between->key[s]->lattice.n_vertices, 3 * sizeof *m.sum[s]);
      status   = m.sum[s] ? CELD_OK : CELD_NO_MEMORY;
    }
  if (status == CELD_OK)
    status = match_parts (&m, host);
  if (status == CELD_OK)
    {
      take_ends (&m);
      status = carry_second (between);
    }
  celd_free (m.sum[0]);
  celd_free (m.sum[1]);
  return status;
}
