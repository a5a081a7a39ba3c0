/* Composition of fragments of several drawings (section 5, Figure 1c, [SBv05]).
 *
 * Each pixel is found by itself, from the layers of the drawings: resample.c says what it shows of each region, the
 * order of the regions which of these are in front.
 *
 * The layers of a composition, from the front, get as their alpha the fraction that they cover of what those in front
 * leave of a pixel.  So they are the picture again when they are composited, and the last one of an antialiased pixel
 * is opaque, as the layers of a drawing are.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/compose.h"

/* A layer in a pixel of which those in front leave less than this, half a step of 8 bits, shows what is hidden. */
#define ALMOST_HIDDEN (1 / 512.0f)

/* ------------------------------------------------------------------ the object */

static void
free_cycles (CeldComposition *c)
{
  for (size_t i = 0; i < c->n_cycles; i++)
    celd_free (c->cycle[i].item);
  celd_free (c->cycle);
}

void
celd_composition_free (CeldComposition *c)
{
  if (!c)
    return;
  for (size_t f = 0; f < c->n && c->fragment; f++)
    {
      celd_free (c->fragment[f].item);
      celd_page_strokes_clear (&c->fragment[f].strokes);
    }
  celd_free (c->fragment);
  celd_free (c->item);
  free_cycles (c);
  celd_free (c);
}

size_t
celd_composition_count (const CeldComposition *c)
{
  return c->n_items;
}

const CeldComposedLayer *
celd_composition_item (const CeldComposition *c, size_t layer)
{
  return &c->item[layer];
}

const CeldCycle *
celd_composition_cycles (const CeldComposition *c, size_t *n)
{
  *n = c->n_cycles;
  return c->cycle;
}

void
celd_composition_map (const CeldComposition *c, size_t fragment, double x, double y, double place[2])
{
  celd_similarity_map (&c->fragment[fragment].there, x, y, place);
}

/* ------------------------------------------------------------------ making it */

/* Whether labels fit together. */
static bool
fragment_fits (const CeldFragment *fragment)
{
  const CeldLayers *layers = fragment->layers;

  for (size_t k = 0; k < layers->n; k++)
    if (layers->item[k].label - 1 >= fragment->order->n)
      return false;
  return !fragment->palette || fragment->palette->n <= fragment->order->n;
}

/* Finds the strokes on a page that is left out: what hangs on parts comes with them. */
static CeldStatus
find_strokes (const CeldFragment *fragment, CeldPlacedFragment *placed)
{
  const CeldLayers *layers = fragment->layers;

  for (size_t k = 0; k < layers->n && fragment->ink; k++)
    if (layers->item[k].label == fragment->page)
      return fragment->ink->data && fragment->ink->width == layers->width && fragment->ink->height == layers->height
               ? celd_page_strokes_find (layers, (uint32_t) k, fragment->ink, true, NULL, &placed->strokes)
               : CELD_BAD_SIZE;
  return CELD_OK;
}

/* Replaces the boxes that layers from item `first` on have in their drawing by the pixels of the composition that depend
 * on these layers, their strokes on a page that is left out included. */
static void
place_boxes (const CeldPlacedFragment *placed, size_t first, CeldComposition *c)
{
  const CeldLabels *stroke = &placed->strokes.component;
  size_t            p = 0;

  for (int y = 0; stroke->data && y < stroke->height; y++)
    for (int x = 0; x < stroke->width; x++, p++)
      {
        uint32_t layer = celd_page_strokes_at (&placed->strokes, p);
        CeldRect *box = layer ? &c->item[placed->item[layer - 1]].box : NULL;

        if (box)
          *box = celd_rect_union (*box, (CeldRect) { x, y, 1, 1 });
      }
  for (size_t i = first; i < c->n_items; i++)
    c->item[i].box = celd_similarity_box (&placed->there, placed->reach, c->item[i].box, c->width, c->height);
}

static CeldStatus
place_fragment (const CeldFragment *fragment, size_t f, CeldComposition *c)
{
  CeldPlacedFragment *placed = &c->fragment[f];
  const CeldLayers   *layers = fragment->layers;
  double              scale = fragment->placement.scale;
  size_t              first = c->n_items;
  CeldStatus          status = celd_placement_read (&fragment->placement, layers->width, layers->height,
                                                    &placed->there, &placed->back);

  if (status != CELD_OK)
    return status;
  placed->layers = layers;
  placed->reach  = 0.5 / (scale < 1 ? scale : 1);
  placed->box    = celd_similarity_box (&placed->there, placed->reach, (CeldRect) { 0, 0, layers->width,
                                        layers->height }, c->width, c->height);
  placed->item   = celd_alloc (layers->n, sizeof *placed->item);
  if (!placed->item)
    return CELD_NO_MEMORY;
  status = f ? find_strokes (fragment, placed) : CELD_OK;
  for (size_t k = 0; k < layers->n && status == CELD_OK; k++)
    if (f && layers->item[k].label == fragment->page)
      placed->item[k] = CELD_NO_ITEM;
    else
      {
        placed->item[k] = (uint32_t) c->n_items;
        c->item[c->n_items++] = (CeldComposedLayer) {
          .fragment = f, .layer = k, .label = layers->item[k].label, .box = layers->item[k].box };
      }
  if (status == CELD_OK)
    place_boxes (placed, first, c);
  return status;
}

static CeldStatus
place_fragments (const CeldFragment *fragment, CeldComposition *c)
{
  size_t     layers = 0;
  CeldStatus status = CELD_OK;

  for (size_t f = 0; f < c->n; f++)
    {
      if (!fragment_fits (&fragment[f]))
        return CELD_BAD_VALUE;
      layers += fragment[f].layers->n;
    }
  if (layers >= CELD_NO_ITEM)
    return CELD_BAD_SIZE;
  c->item     = celd_alloc (layers, sizeof *c->item);
  c->fragment = celd_alloc0 (c->n, sizeof *c->fragment);
  if (!c->item || !c->fragment)
    return CELD_NO_MEMORY;
  for (size_t f = 0; f < c->n && status == CELD_OK; f++)
    status = place_fragment (&fragment[f], f, c);
  return status;
}

/* Puts the items in their order. */
static CeldStatus
order_fragments (const CeldFragment *fragment, const CeldRelations *relations, const CeldHost *host,
                 CeldProblems *problems, CeldComposition *c)
{
  CeldOverlaps overlaps = { 0 };
  CeldStatus   status = celd_overlaps_find (c, host, &overlaps);

  if (status == CELD_OK)
    status = celd_fragments_order (fragment, relations, &overlaps, problems, c);
  celd_free (overlaps.item);
  for (size_t i = 0; i < c->n_items && status == CELD_OK; i++)
    c->fragment[c->item[i].fragment].item[c->item[i].layer] = (uint32_t) i;
  return status;
}

CeldStatus
celd_compose (const CeldFragment *fragment, size_t n, const CeldRelations *relations, int width, int height,
              const CeldHost *host, CeldProblems *problems, CeldComposition **composition)
{
  size_t           before = problems ? problems->n : 0;
  CeldComposition *c;
  CeldStatus       status;

  if (!n)
    return CELD_NOTHING_TO_GO_BY;
  if (width < 1 || height < 1 || width > CELD_MAX_SIDE || height > CELD_MAX_SIDE)
    return CELD_BAD_SIZE;
  c = celd_alloc0 (1, sizeof *c);
  if (!c)
    return CELD_NO_MEMORY;
  *c = (CeldComposition) { .width = width, .height = height, .n = n };
  status = place_fragments (fragment, c);
  if (status == CELD_OK)
    status = order_fragments (fragment, relations, host, problems, c);
  if (status == CELD_OK)
    {
      *composition = c;
      return CELD_OK;
    }
  celd_composition_free (c);
  if (problems)
    problems->n = before;
  return status;
}

/* ------------------------------------------------------------------ rows of pixels */

typedef struct Painting Painting;

/* Paints all pixels by a function, band by band. */
struct Painting
{
  const CeldComposition *composition;
  void                 (*paint) (const Painting *painting, int x, int y, CeldShares *shares);
  CeldRect               box;
  int                    first;          /* band of this round */
  CeldShares             shares[CELD_COMPOSE_TASKS];
  CeldColours           *picture;        /* of celd_composition_flatten */
  CeldPlane             *levels;         /* of celd_composition_levels */
  uint32_t               item;           /* of celd_composition_paint, with its layer in the drawing, and the result */
  const float           *layer;
  float                 *rgba;
};

static void
paint_band (void *data, int i)
{
  Painting *p = data;
  int       end = p->box.y + p->box.height, y = p->box.y + (p->first + i) * CELD_COMPOSE_BAND;

  for (int last = y + CELD_COMPOSE_BAND; y < last && y < end; y++)
    for (int x = p->box.x; x < p->box.x + p->box.width; x++)
      {
        celd_shares_gather (p->composition, x, y, &p->shares[i]);
        celd_shares_combine (&p->shares[i]);
        p->paint (p, x, y, &p->shares[i]);
      }
}

static CeldStatus
paint_all (Painting *p, const CeldHost *host)
{
  int        bands = (p->box.height + CELD_COMPOSE_BAND - 1) / CELD_COMPOSE_BAND;
  CeldStatus status = CELD_OK;

  for (int i = 0; i < CELD_COMPOSE_TASKS && i < bands && status == CELD_OK; i++)
    status = celd_shares_new (p->composition, &p->shares[i]);
  if (status == CELD_OK)
    status = celd_parallel_rounds (host, bands, CELD_COMPOSE_TASKS, paint_band, p, &p->first, 0, 1);
  for (int i = 0; i < CELD_COMPOSE_TASKS; i++)
    celd_shares_clear (&p->shares[i]);
  return status;
}

/* A premultiplied colour with straight alpha. */
static void
write_straight (const float premultiplied[4], float alpha, float *rgba)
{
  for (int i = 0; i < 3; i++)
    rgba[i] = premultiplied[3] > 0 ? fminf (premultiplied[i] / premultiplied[3], 1) : 0;
  rgba[3] = fminf (alpha, 1);
}

/* ------------------------------------------------------------------ the picture */

static void
flatten_pixel (const Painting *p, int x, int y, CeldShares *shares)
{
  float sum[4] = { 0 };

  for (size_t i = 0; i < shares->n; i++)
    for (int k = 0; k < 4; k++)
      sum[k] += shares->share[i].colour[k];
  write_straight (sum, sum[3], CELD_RGBA (p->picture, x, y));
}

CeldStatus
celd_composition_flatten (const CeldComposition *c, const CeldHost *host, CeldColours *picture)
{
  Painting p = { .composition = c, .paint = flatten_pixel, .box = { 0, 0, c->width, c->height }, .picture = picture };

  if (!picture->data || picture->width != c->width || picture->height != c->height)
    return CELD_BAD_SIZE;
  return paint_all (&p, host);
}

static void
level_of_pixel (const Painting *p, int x, int y, CeldShares *shares)
{
  const CeldShare *most = NULL;
  float            sum = 0;

  for (size_t i = 0; i < shares->n; i++)
    {
      most = !most || shares->share[i].colour[3] > most->colour[3] ? &shares->share[i] : most;
      sum += shares->share[i].colour[3];
    }
  CELD_AT (p->levels, x, y) = sum >= 0.5f ? (float) p->composition->item[most->item].level : 0;
}

CeldStatus
celd_composition_levels (const CeldComposition *c, const CeldHost *host, CeldPlane *levels)
{
  Painting p = { .composition = c, .paint = level_of_pixel, .box = { 0, 0, c->width, c->height }, .levels = levels };

  if (!levels->data || levels->width != c->width || levels->height != c->height)
    return CELD_BAD_SIZE;
  return paint_all (&p, host);
}

/* ------------------------------------------------------------------ its layers */

static void
paint_pixel (const Painting *p, int x, int y, CeldShares *shares)
{
  const CeldComposedLayer *item = &p->composition->item[p->item];
  const CeldShare         *share = NULL;
  float                    left = 1, colour[4];
  float *to = p->rgba + 4 * ((size_t) (y - p->box.y) * (size_t) p->box.width + (size_t) (x - p->box.x));

  for (size_t i = 0; i < shares->n && !share && shares->share[i].item >= p->item; i++)
    if (shares->share[i].item == p->item)
      share = &shares->share[i];
    else
      left -= shares->share[i].colour[3];
  if (left > ALMOST_HIDDEN)
    {
      static const float nothing[4] = { 0 };

      write_straight (share ? share->colour : nothing, share ? share->colour[3] / left : 0, to);
      return;
    }
  celd_resample (&p->composition->fragment[item->fragment],
                 p->composition->fragment[item->fragment].layers->item[item->layer].box, p->layer, x, y, colour);
  write_straight (colour, colour[3], to);
}

CeldStatus
celd_composition_paint (const CeldComposition *c, size_t layer, const CeldHost *host, float *rgba)
{
  const CeldComposedLayer *item = &c->item[layer];
  const CeldLayers        *layers = c->fragment[item->fragment].layers;
  const CeldRect          *box = &layers->item[item->layer].box;
  float                   *whole;
  Painting                 p = { .composition = c, .paint = paint_pixel, .box = item->box, .item = (uint32_t) layer,
                                 .rgba = rgba };
  CeldStatus               status;

  if (!item->box.width)
    return CELD_OK;
  whole = celd_alloc ((size_t) box->width * (size_t) box->height, 4 * sizeof *whole);
  if (!whole)
    return CELD_NO_MEMORY;
  celd_layers_paint (layers, item->layer, whole);
  p.layer = whole;
  status  = paint_all (&p, host);
  celd_free (whole);
  return status;
}
