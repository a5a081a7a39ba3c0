/* The lattice of a puppet.
 *
 * Each layer, what is hidden of it included, is embedded into squares by itself.  Layers have common vertices where
 * depth is continuous: where they touch, and their levels are equal or neither ink nor a gap that holds depth lies
 * between them; or if the artist has marked cracks, wherever they touch except there.  What is connected so is a piece;
 * pieces touch along cracks.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "depth/depth.h"
#include "motion/puppet.h"

#define SPECK        4      /* pixels: cells with fewer are not connected, so their pixels go with a cell beside them */
#define LEAST_ALPHA  0.02f  /* of a pixel that is embedded itself; fainter ones go with the cell beside them; chosen */

typedef struct
{
  CeldPuppet       *puppet;
  const CeldCracks *cracks;    /* may be NULL */
  CeldDepthEdges    edges;     /* of the levels in front */
  uint8_t          *cut;       /* of the edges */
  uint32_t         *joined;    /* disjoint sets of vertices */
} LayerEmbedding;

/* ------------------------------------------------------------------ one layer */

/* Lets pixels beside the layer go with the cell of a neighbour. */
static CeldStatus
bleed_cells (const CeldPuppetLayer *layer)
{
  size_t    w = celd_puppet_stride (layer), h = (size_t) layer->box.height + 2 * CELD_PUPPET_PAD;
  uint32_t *before = celd_alloc (w * h, sizeof *before);

  for (int step = 0; step < CELD_PUPPET_BLEED && before; step++)
    {
      memcpy (before, layer->cell, w * h * sizeof *before);
      for (size_t p = 0; p < w * h; p++)
        {
          size_t   x = p % w, y = p / w;
          uint32_t left = x ? before[p - 1] : 0, right = x + 1 < w ? before[p + 1] : 0;
          uint32_t above = y ? before[p - w] : 0, below = y + 1 < h ? before[p + w] : 0;

          if (!before[p])
            layer->cell[p] = left ? left : right ? right : above ? above : below;
        }
    }
  celd_free (before);
  return before ? CELD_OK : CELD_NO_MEMORY;
}

CeldStatus
celd_puppet_layer_lattice (const CeldPuppetLayer *layer, CeldRect window, const CeldPlane *ink,
                           const CeldSettings *settings, const CeldHost *host, CeldLattice **lattice)
{
  CeldPlane       below = { window.width, window.height, ink->stride,
                            ink->data + (size_t) window.y * ink->stride + (size_t) window.x };
  CeldLabels      mask = { 0 };
  CeldMovingParts parts = { .labels = &mask, .n = 2, .background = 2 };
  CeldStatus      status = celd_labels_new (window.width, window.height, &mask);

  for (int y = 0; y < window.height && status == CELD_OK; y++)
    for (int x = 0; x < window.width; x++)
      CELD_AT (&mask, x, y) = celd_puppet_alpha (layer, window.x + x, window.y + y) >= LEAST_ALPHA ? 1 : 2;
  if (status == CELD_OK)
    status = celd_lattice_new (&below, &parts, settings, host, lattice);
  if (status == CELD_NOTHING_TO_GO_BY)
    status = CELD_OK;
  celd_free (mask.data);
  return status;
}

/* Embeds one layer: its own lattice, whose rest pose is that in the drawing; NULL if it has no pixels. */
static CeldStatus
embed_layer (const CeldPuppetLayer *layer, const CeldPlane *ink, const CeldSettings *settings, const CeldHost *host,
             CeldLattice **lattice)
{
  CeldStatus status = celd_puppet_layer_lattice (layer, layer->box, ink, settings, host, lattice);

  for (size_t v = 0; v < (*lattice ? (*lattice)->n_vertices : 0); v++)
    {
      (*lattice)->rest[2 * v]     += (float) layer->box.x;
      (*lattice)->rest[2 * v + 1] += (float) layer->box.y;
    }
  return status;
}

/* Notes the cells of a layer's pixels, and of those around. */
static CeldStatus
note_cells (CeldPuppetLayer *layer, const CeldLattice *one)
{
  CeldRect  box = layer->box;
  uint32_t *area = celd_alloc0 (one->n_cells + 1, sizeof *area);
  CeldStatus status;

  if (!area)
    return CELD_NO_MEMORY;
  for (size_t p = 0; p < (size_t) box.width * (size_t) box.height; p++)
    area[one->cell[p]]++;
  for (int pass = 0; pass < 2; pass++)
    {
      for (int y = 0; y < box.height; y++)
        for (int x = 0; x < box.width; x++)
          {
            uint32_t  c = celd_lattice_cell (one, x, y);
            uint32_t *to = &layer->cell[celd_puppet_pixel (layer, box.x + x, box.y + y)];

            if (c && !*to && (pass || area[c] >= SPECK)) /* specks that lie alone keep their cell */
              *to = (uint32_t) layer->first + c;
          }
      status = bleed_cells (layer);
      if (status != CELD_OK)
        break;
    }
  celd_free (area);
  return status;
}

/* Appends a layer's lattice to that of the puppet, whose memory is there. */
static CeldStatus
append_lattice (CeldPuppetLayer *layer, const CeldLattice *one, CeldLattice *all)
{
  layer->first   = all->n_cells;
  layer->n_cells = one->n_cells;
  for (size_t i = 0; i < 4 * one->n_cells; i++)
    all->corner[4 * all->n_cells + i] = (uint32_t) all->n_vertices + one->corner[i];
  memcpy (all->rest + 2 * all->n_vertices, one->rest, 2 * one->n_vertices * sizeof *one->rest);
  all->n_cells    += one->n_cells;
  all->n_vertices += one->n_vertices;
  return note_cells (layer, one);
}

static bool
allocate_lattice (CeldLattice *const *one, size_t n, CeldLattice *all)
{
  size_t cells = 0, vertices = 0;

  for (size_t k = 0; k < n; k++)
    {
      cells    += one[k] ? one[k]->n_cells : 0;
      vertices += one[k] ? one[k]->n_vertices : 0;
    }
  all->corner = celd_alloc (cells, 4 * sizeof *all->corner);
  all->piece  = celd_alloc (cells, sizeof *all->piece);
  all->rest   = celd_alloc (vertices, 2 * sizeof *all->rest);
  all->place  = celd_alloc (vertices, 2 * sizeof *all->place);
  return all->corner && all->piece && all->rest && all->place;
}

/* Marks the cells that have pixels outside their own square. */
static void
mark_bleeding (CeldPuppet *puppet, const CeldPuppetLayer *layer)
{
  const CeldLattice *lattice = &puppet->lattice;

  for (int y = -CELD_PUPPET_PAD; layer->cell && y < layer->box.height + CELD_PUPPET_PAD; y++)
    for (int x = -CELD_PUPPET_PAD; x < layer->box.width + CELD_PUPPET_PAD; x++)
      {
        uint32_t     c = layer->cell[celd_puppet_pixel (layer, layer->box.x + x, layer->box.y + y)];
        const float *rest = lattice->rest + (c ? 2 * (size_t) lattice->corner[4 * (size_t) (c - 1)] : 0);
        float        u = (float) (layer->box.x + x) - rest[0], v = (float) (layer->box.y + y) - rest[1];

        if (c && !(u >= 0 && v >= 0 && u < (float) lattice->side && v < (float) lattice->side))
          puppet->bleeds[c - 1] = 1;
      }
}

static CeldStatus
embed_layers (CeldPuppet *puppet, const CeldPlane *ink, const CeldSettings *settings, const CeldHost *host)
{
  CeldLattice **one = celd_alloc0 (puppet->n, sizeof *one);
  CeldStatus    status = one ? CELD_OK : CELD_NO_MEMORY;

  for (size_t k = 0; k < puppet->n && status == CELD_OK; k++)
    if (puppet->layer[k].cell)
      status = embed_layer (&puppet->layer[k], ink, settings, host, &one[k]);
  if (status == CELD_OK && !allocate_lattice (one, puppet->n, &puppet->lattice))
    status = CELD_NO_MEMORY;
  for (size_t k = 0; k < puppet->n && status == CELD_OK; k++)
    if (one[k])
      status = append_lattice (&puppet->layer[k], one[k], &puppet->lattice);
  puppet->bleeds = celd_alloc0 (puppet->lattice.n_cells, 1);
  if (!puppet->bleeds)
    status = CELD_NO_MEMORY;
  for (size_t k = 0; k < puppet->n && status == CELD_OK; k++)
    mark_bleeding (puppet, &puppet->layer[k]);
  for (size_t k = 0; one && k < puppet->n; k++)
    celd_lattice_free (one[k]);
  celd_free (one);
  return status;
}

/* ------------------------------------------------------------------ where layers touch */

/* Finds where ink and gaps cut the levels in front. */
static CeldStatus
find_edges (LayerEmbedding *e, const CeldPlane *ink, const CeldPlane *borders, const CeldSettings *settings,
            const CeldHost *host)
{
  const CeldPuppet *puppet = e->puppet;
  size_t            n = (size_t) puppet->width * (size_t) puppet->height;
  float            *level = celd_alloc (n, sizeof *level);
  CeldStatus        status = CELD_NO_MEMORY;

  for (size_t p = 0; p < n && level; p++)
    level[p] = (float) puppet->layer[puppet->front[p]].level;
  if (level)
    status = celd_depth_edges (ink, borders, level, celd_stroke_width (ink), settings, host, &e->edges, &e->cut);
  celd_free (level);
  return status;
}

void
celd_puppet_contacts (const CeldPuppet *puppet, CeldContactVisit visit, void *data)
{
  size_t w = (size_t) puppet->width;

  for (int y = 0; y < puppet->height; y++)
    for (int x = 0; x < puppet->width; x++)
      for (int right = 0; right < 2; right++)
        {
          const uint32_t *here = puppet->front + (size_t) y * w + (size_t) x;
          int             ox = x + right, oy = y + !right;
          uint32_t        a, b;

          if (ox == puppet->width || oy == puppet->height || here[0] == here[right ? 1 : w])
            continue;
          a = celd_puppet_front_cell (puppet, x, y);
          b = celd_puppet_front_cell (puppet, ox, oy);
          if (a && b)
            visit (data, a - 1, b - 1, x, y, right);
        }
}

/* Whether there is a crack between two pixels with different front layers. */
static bool
is_torn (const LayerEmbedding *e, int x, int y, int right)
{
  const CeldPuppet      *puppet = e->puppet;
  const uint32_t        *here = puppet->front + (size_t) y * (size_t) puppet->width + (size_t) x;
  const CeldPuppetLayer *a = &puppet->layer[*here], *b = &puppet->layer[here[right ? 1 : puppet->width]];

  if (e->cracks && e->cracks->n)
    return celd_is_crack (e->cracks->item, e->cracks->n, a->label, b->label);
  return a->level != b->level && celd_discontinuity_weight (&e->edges, x, y, right, !right) <= 0;
}

/* Joins cells between which there is no crack. */
static void
join_cells (void *data, uint32_t a, uint32_t b, int x, int y, int right)
{
  LayerEmbedding   *e = data;
  const CeldPuppet *puppet = e->puppet;

  if (is_torn (e, x, y, right))
    return;
  for (int i = 0; i < 4; i++)
    for (int k = 0; k < 4; k++)
      if (celd_puppet_same_place (&puppet->lattice, a, i, b, k))
        celd_join (e->joined, puppet->lattice.corner[4 * a + (uint32_t) i],
                   puppet->lattice.corner[4 * b + (uint32_t) k]);
}

/* Gives joined vertices one number. */
static CeldStatus
merge_vertices (LayerEmbedding *e)
{
  CeldLattice *lattice = &e->puppet->lattice;
  uint32_t    *number = celd_alloc (lattice->n_vertices, sizeof *number);
  size_t       left = 0;

  if (!number)
    return CELD_NO_MEMORY;
  for (uint32_t v = 0; v < lattice->n_vertices; v++)
    {
      uint32_t root = celd_root (e->joined, v);

      number[v] = root == v ? (uint32_t) left++ : number[root];
      memmove (lattice->rest + 2 * (size_t) number[v], lattice->rest + 2 * (size_t) v, 2 * sizeof *lattice->rest);
    }
  for (size_t i = 0; i < 4 * lattice->n_cells; i++)
    lattice->corner[i] = number[lattice->corner[i]];
  lattice->n_vertices = left;
  celd_free (number);
  return CELD_OK;
}

/* Finds the pieces that cells and vertices belong to. */
static CeldStatus
find_pieces (CeldPuppet *puppet)
{
  CeldLattice *lattice = &puppet->lattice;
  CeldStatus   status = celd_lattice_pieces (lattice);

  puppet->piece = celd_alloc (lattice->n_vertices, sizeof *puppet->piece);
  if (!puppet->piece)
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < 4 * lattice->n_cells && status == CELD_OK; i++)
    puppet->piece[lattice->corner[i]] = lattice->piece[i / 4];
  return status;
}

static CeldStatus
join_layers (LayerEmbedding *e)
{
  CeldLattice *lattice = &e->puppet->lattice;
  CeldStatus   status;

  e->joined = celd_alloc (lattice->n_vertices, sizeof *e->joined);
  if (!e->joined)
    return CELD_NO_MEMORY;
  celd_roots (e->joined, lattice->n_vertices);
  celd_puppet_contacts (e->puppet, join_cells, e);
  status = merge_vertices (e);
  return status == CELD_OK ? find_pieces (e->puppet) : status;
}

CeldStatus
celd_puppet_embed (CeldPuppet *puppet, const CeldPlane *ink, const CeldPlane *borders, const CeldCracks *cracks,
                   const CeldSettings *settings, const CeldHost *host)
{
  CeldLattice   *lattice = &puppet->lattice;
  LayerEmbedding e = { .puppet = puppet, .cracks = cracks };
  CeldStatus     status = embed_layers (puppet, ink, settings, host);

  if (status == CELD_OK)
    status = find_edges (&e, ink, borders, settings, host);
  if (status == CELD_OK)
    status = join_layers (&e);
  if (status == CELD_OK)
    memcpy (lattice->place, lattice->rest, 2 * lattice->n_vertices * sizeof *lattice->rest);
  celd_free (e.cut);
  celd_free (e.joined);
  return status;
}
