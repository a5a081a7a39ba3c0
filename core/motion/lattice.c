/* Embedding of a drawing into a lattice of squares [SDC09a, section 3.3] that is torn at cracks, as section 3.4 of the
 * paper asks.
 *
 * The pixels of each square of a grid form a cell for each of their connected components; connection does not cross a
 * crack.  Neighbouring cells share the vertices of their common side if pixels are connected across it.  So parts that
 * merely touch in the picture have vertices of their own, and can move apart.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/motion.h"

#include <stdlib.h>

#define CELL_SPECK      4  /* pixels: smaller components join a larger one of their square; chosen */
#define CELL_LEAST_SIDE 8  /* pixels; chosen */
#define CELL_SIDES      48 /* of a cell along the diagonal of the picture; chosen */

typedef struct
{
  const CeldMovingParts *parts;
  CeldLabels       label;
  int              side;
  uint32_t        *cell;       /* of each pixel inside */
  size_t           n_cells;
  uint32_t        *area;       /* of each cell */
  uint32_t        *vertex;     /* of each corner of each cell, as disjoint sets; then its number */
  uint32_t       (*seam)[2];   /* corners of two cells torn apart */
  size_t           n_seams, seam_capacity;
} Embedding;

/* ------------------------------------------------------------------ cracks */

/* Whether there is a crack between two neighbouring pixels inside. */
static bool
is_cracked (const Embedding *e, size_t p, size_t q)
{
  uint32_t         a = e->label.data[p], b = e->label.data[q];
  const CeldMovingParts *parts = e->parts;

  if (a == b || !parts)
    return false;
  if (parts->n_cracks)
    return celd_is_crack (parts->crack, parts->n_cracks, a, b);
  return parts->level && parts->level[a - 1] != parts->level[b - 1];
}

/* Calls visit for each pair of neighbouring pixels inside: p, q to the right (way 0) or below (way 1), and whether they
 * are in one square. */
static CeldStatus
visit_pairs (Embedding *e, CeldStatus (*visit) (Embedding *e, size_t p, size_t q, int way, bool same_square))
{
  size_t     w = (size_t) e->label.width;
  CeldStatus status = CELD_OK;

  for (int y = 0; y < e->label.height; y++)
    for (int x = 0; x < e->label.width && status == CELD_OK; x++)
      {
        size_t p = (size_t) y * w + (size_t) x;

        if (!e->label.data[p])
          continue;
        if (x + 1 < e->label.width && e->label.data[p + 1])
          status = visit (e, p, p + 1, 0, (x + 1) % e->side != 0);
        if (y + 1 < e->label.height && e->label.data[p + w] && status == CELD_OK)
          status = visit (e, p, p + w, 1, (y + 1) % e->side != 0);
      }
  return status;
}

/* ------------------------------------------------------------------ cells */

static CeldStatus
join_pixels (Embedding *e, size_t p, size_t q, int way, bool same_square)
{
  (void) way;
  if (same_square && !is_cracked (e, p, q))
    celd_join (e->cell, (uint32_t) p, (uint32_t) q);
  return CELD_OK;
}

/* Replaces disjoint sets of pixels by the numbers of cells, in reading order of their first pixels. */
static void
number_cells (Embedding *e)
{
  size_t n = (size_t) e->label.width * (size_t) e->label.height;

  for (size_t p = 0; p < n; p++)
    e->cell[p] = celd_root (e->cell, (uint32_t) p);
  for (size_t p = 0; p < n; p++)
    if (e->label.data[p])
      e->cell[p] = e->cell[p] == p ? (uint32_t) e->n_cells++ : e->cell[e->cell[p]];
}

static CeldStatus
make_cells (Embedding *e)
{
  size_t n = (size_t) e->label.width * (size_t) e->label.height;

  e->cell = celd_alloc (n, sizeof *e->cell);
  if (!e->cell)
    return CELD_NO_MEMORY;
  celd_roots (e->cell, n);
  visit_pairs (e, join_pixels);
  number_cells (e);
  e->area = celd_alloc0 (e->n_cells, sizeof *e->area);
  if (!e->area)
    return CELD_NO_MEMORY;
  for (size_t p = 0; p < n; p++)
    if (e->label.data[p])
      e->area[e->cell[p]]++;
  return CELD_OK;
}

/* ------------------------------------------------------------------ vertices */

static CeldStatus
add_seam (Embedding *e, uint32_t a, uint32_t b)
{
  size_t n = e->n_seams;

  if (n && e->seam[n - 1][0] == a && e->seam[n - 1][1] == b)
    return CELD_OK;
  if (!celd_reserve_one (e->seam, e->n_seams, e->seam_capacity))
    return CELD_NO_MEMORY;
  e->seam[n][0] = a;
  e->seam[n][1] = b;
  e->n_seams++;
  return CELD_OK;
}

/* Joins the corners of two cells that are connected across a side, and lists those torn apart.  Specks connect
 * nothing. */
static CeldStatus
join_corners (Embedding *e, size_t p, size_t q, int way, bool same_square)
{
  uint32_t   a = e->cell[p], b = e->cell[q];
  bool       cracked = is_cracked (e, p, q);
  CeldStatus status = CELD_OK;

  if ((same_square && !cracked) || e->area[a] < CELL_SPECK || e->area[b] < CELL_SPECK)
    return CELD_OK;
  for (uint32_t k = 0; k < 4 && status == CELD_OK; k++)
    {
      uint32_t step = way ? 2 : 1;

      if (same_square)
        status = add_seam (e, 4 * a + k, 4 * b + k);
      else if (!(k & step) && cracked)
        status = add_seam (e, 4 * a + k + step, 4 * b + k);
      else if (!(k & step))
        celd_join (e->vertex, 4 * a + k + step, 4 * b + k);
    }
  return status;
}

/* ------------------------------------------------------------------ specks */

/* Finds for each speck the largest cell of its square that it touches. */
static CeldStatus
adopt_speck (Embedding *e, size_t p, size_t q, int way, bool same_square)
{
  (void) way;
  for (int i = 0; i < 2 && same_square; i++)
    {
      uint32_t speck = e->cell[i ? q : p], other = e->cell[i ? p : q], *to = &e->vertex[speck];

      if (speck != other && e->area[speck] < CELL_SPECK && e->area[other] >= CELL_SPECK &&
          (*to == speck || e->area[*to] < e->area[other]))
        *to = other;
    }
  return CELD_OK;
}

/* Gives the pixels of specks to other cells, and numbers the cells that are left. */
static CeldStatus
drop_specks (Embedding *e, uint32_t *kept)
{
  size_t    n = (size_t) e->label.width * (size_t) e->label.height, left = 0;
  uint32_t *to = celd_alloc (e->n_cells, sizeof *to), *corners = e->vertex;

  if (!to)
    return CELD_NO_MEMORY;
  celd_roots (to, e->n_cells);
  e->vertex = to;
  visit_pairs (e, adopt_speck);
  e->vertex = corners;
  for (uint32_t c = 0; c < e->n_cells; c++)
    kept[c] = to[c] == c ? (uint32_t) left++ : UINT32_MAX;
  for (size_t p = 0; p < n; p++)
    e->cell[p] = e->label.data[p] ? kept[to[e->cell[p]]] + 1 : 0;
  celd_free (to);
  return CELD_OK;
}

/* ------------------------------------------------------------------ the lattice */

/* Numbers the vertices of the cells that were kept, and finds the places of cells by their pixels. */
static CeldStatus
fill_vertices (Embedding *e, const uint32_t *kept, CeldLattice *lattice)
{
  size_t    corners = 4 * e->n_cells;
  uint32_t *number = celd_alloc (corners, sizeof *number);

  if (!number)
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < corners; i++)
    number[i] = UINT32_MAX;
  for (uint32_t i = 0; i < corners; i++)
    if (kept[i / 4] != UINT32_MAX)
      {
        uint32_t root = celd_root (e->vertex, i);

        if (number[root] == UINT32_MAX)
          number[root] = (uint32_t) lattice->n_vertices++;
        lattice->corner[4 * kept[i / 4] + i % 4] = number[root];
      }
  for (size_t s = 0; s < e->n_seams; s++)
    for (int i = 0; i < 2; i++)
      e->seam[s][i] = number[celd_root (e->vertex, e->seam[s][i])];
  celd_free (number);
  return CELD_OK;
}

static int
compare_seams (const void *a, const void *b)
{
  const uint32_t *p = a, *q = b;

  return p[0] != q[0] ? (p[0] < q[0] ? -1 : 1) : p[1] != q[1] ? (p[1] < q[1] ? -1 : 1) : 0;
}

/* Copies the seams, each once.  Vertices may be torn at one place and joined around it. */
static CeldStatus
fill_seams (Embedding *e, CeldLattice *lattice)
{
  for (size_t s = 0; s < e->n_seams; s++)
    if (e->seam[s][0] > e->seam[s][1])
      {
        uint32_t first = e->seam[s][1];

        e->seam[s][1] = e->seam[s][0];
        e->seam[s][0] = first;
      }
  if (e->n_seams)
    qsort (e->seam, e->n_seams, sizeof *e->seam, compare_seams);
  lattice->seam = celd_alloc (e->n_seams ? e->n_seams : 1, sizeof *e->seam);
  if (!lattice->seam)
    return CELD_NO_MEMORY;
  for (size_t s = 0; s < e->n_seams; s++)
    if (e->seam[s][0] != e->seam[s][1] && (!s || compare_seams (e->seam[s - 1], e->seam[s])))
      memcpy (lattice->seam + 2 * lattice->n_seams++, e->seam[s], sizeof *e->seam);
  return CELD_OK;
}

/* Makes the lattice of an embedding whose cells and corners are known. */
static CeldStatus
finish (Embedding *e, CeldLattice *lattice)
{
  uint32_t  *kept = celd_alloc (e->n_cells, sizeof *kept);
  CeldStatus status = kept ? drop_specks (e, kept) : CELD_NO_MEMORY;

  if (status == CELD_OK)
    {
      for (size_t c = 0; c < e->n_cells; c++)
        lattice->n_cells += kept[c] != UINT32_MAX;
      lattice->cell   = e->cell;
      e->cell         = NULL;
      lattice->corner = celd_alloc (4 * lattice->n_cells, sizeof *lattice->corner);
      lattice->label  = celd_alloc (lattice->n_cells, sizeof *lattice->label);
      lattice->level  = celd_alloc (lattice->n_cells, sizeof *lattice->level);
      lattice->piece  = celd_alloc (lattice->n_cells, sizeof *lattice->piece);
      status = lattice->corner && lattice->label && lattice->level && lattice->piece
                 ? fill_vertices (e, kept, lattice) : CELD_NO_MEMORY;
    }
  if (status == CELD_OK)
    status = fill_seams (e, lattice);
  if (status == CELD_OK)
    {
      lattice->rest  = celd_alloc (2 * lattice->n_vertices, sizeof *lattice->rest);
      lattice->place = celd_alloc (2 * lattice->n_vertices, sizeof *lattice->place);
      status = lattice->rest && lattice->place ? celd_lattice_describe (&e->label, e->parts, lattice) : CELD_NO_MEMORY;
    }
  if (status == CELD_OK)
    {
      memcpy (lattice->place, lattice->rest, 2 * lattice->n_vertices * sizeof *lattice->rest);
      status = celd_lattice_pieces (lattice);
    }
  celd_free (kept);
  return status;
}

int
celd_cell_side (int width, int height, const CeldSettings *settings)
{
  if (settings->cell_size > 0)
    return settings->cell_size;
  return (int) fmax (CELL_LEAST_SIDE, round (hypot (width, height) / CELL_SIDES));
}

CeldStatus
celd_lattice_new (const CeldPlane *ink, const CeldMovingParts *parts, const CeldSettings *settings,
                  const CeldHost *host, CeldLattice **result)
{
  Embedding    e = { .parts = parts };
  CeldLattice *lattice;
  CeldStatus   status;

  if (!CELD_SAME_SIZE (ink, ink) || (parts && !CELD_SAME_SIZE (ink, parts->labels)))
    return CELD_BAD_SIZE;
  if (celd_settings_check (settings) != CELD_OK)
    return CELD_BAD_VALUE;
  e.side  = celd_cell_side (ink->width, ink->height, settings);
  lattice = celd_alloc0 (1, sizeof *lattice);
  status  = lattice ? celd_silhouette (ink, parts, e.side, host, &e.label) : CELD_NO_MEMORY;
  if (status == CELD_OK)
    {
      lattice->width  = ink->width;
      lattice->height = ink->height;
      lattice->side   = e.side;
      status = make_cells (&e);
    }
  if (status == CELD_OK)
    {
      e.vertex = celd_alloc (4 * e.n_cells, sizeof *e.vertex);
      if (e.vertex)
        celd_roots (e.vertex, 4 * e.n_cells);
      status = e.vertex ? visit_pairs (&e, join_corners) : CELD_NO_MEMORY;
    }
  if (status == CELD_OK)
    status = finish (&e, lattice);
  if (status == CELD_OK)
    status = celd_progress (host, 1);
  celd_free (e.label.data);
  celd_free (e.cell);
  celd_free (e.area);
  celd_free (e.vertex);
  celd_free (e.seam);
  if (status == CELD_OK)
    *result = lattice;
  else
    celd_lattice_free (lattice);
  return status;
}

void
celd_lattice_free (CeldLattice *lattice)
{
  if (!lattice)
    return;
  celd_free (lattice->rest);
  celd_free (lattice->place);
  celd_free (lattice->corner);
  celd_free (lattice->label);
  celd_free (lattice->level);
  celd_free (lattice->piece);
  celd_free (lattice->seam);
  celd_free (lattice->cell);
  celd_free (lattice);
}
