/* A drawing between the keys: parts from back to front, each from one key.
 *
 * In the first half of the way parts are those of the first key, and in the order of that; in the second half those of
 * the second.  What the nearer key does not show of a part is taken from the other one if that shows it, pixel by
 * pixel; nothing is ever drawn from both.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/inbetween.h"

#define PART_ROWS   64    /* rows of a job; chosen */
#define HOLE        0.05f /* of a pixel that is covered, at most, if it may be filled; chosen */
#define BESIDE_HOLE 0.5f  /* of pixels around that; chosen */

enum { NEAR_COLOURS, NEAR_FLAGS, FAR_COLOURS, FAR_FLAGS, CANVASES };

/* A part that is drawn: from its layer in the nearer key, completed by the other key's (may be NULL), or alone. */
typedef struct
{
  const CeldPuppetLayer *layer[2];   /* from the key that it is drawn from, and from the other one */
  CeldPuppet            *puppet[2];
  const float           *flags[2];
  uint32_t               mark[2];    /* each layer has two: colours and flags */
  CeldRect               box;        /* where it is drawn */
} DrawnPart;

typedef struct
{
  CeldInbetween *between;
  DrawnPart     *part;               /* from back to front */
  size_t         n;
  CeldColours    canvas[CANVASES];
  CeldColours   *picture;
  bool           exact;              /* it is a key */
} BetweenDrawing;

/* ------------------------------------------------------------------ boxes */

/* The box in the picture that the layer of a posed puppet is drawn in. */
static CeldRect
box_of (const CeldPuppet *puppet, const CeldPuppetLayer *layer)
{
  const CeldLattice *lattice = &puppet->lattice;
  float              left = INFINITY, top = INFINITY, right = -INFINITY, bottom = -INFINITY;
  int                x, y, end_x, end_y;

  if (!layer->cell)
    return layer->box;
  for (size_t c = layer->first; c < layer->first + layer->n_cells; c++)
    for (int k = 0; k < 4; k++)
      {
        const float *rest = lattice->rest + 2 * (size_t) lattice->corner[4 * c];
        float        extent = CELD_PUPPET_BLEED, side = (float) lattice->side, at[2];

        celd_cell_map (lattice, c, rest[0] + (k % 2 ? side + extent : -extent),
                       rest[1] + (k / 2 ? side + extent : -extent), at);
        left   = fminf (left, at[0]);
        right  = fmaxf (right, at[0]);
        top    = fminf (top, at[1]);
        bottom = fmaxf (bottom, at[1]);
      }
  x     = (int) fmaxf (0, fminf (floorf (left), (float) puppet->width));
  y     = (int) fmaxf (0, fminf (floorf (top), (float) puppet->height));
  end_x = (int) fminf ((float) puppet->width, fmaxf (ceilf (right), 0));
  end_y = (int) fminf ((float) puppet->height, fmaxf (ceilf (bottom), 0));
  return end_x > x && end_y > y ? (CeldRect) { x, y, end_x - x, end_y - y } : (CeldRect) { 0 };
}

/* ------------------------------------------------------------------ what is drawn */

/* Adds a part that is drawn from key s; `alone` without what the other key knows. */
static void
add_part (BetweenDrawing *d, const CeldBetweenPart *part, int s, bool alone)
{
  DrawnPart *drawn = &d->part[d->n++];

  *drawn = (DrawnPart) { .layer = { NULL, NULL } };
  for (int i = 0; i < (alone || part->layer[!s] == CELD_NO_INDEX || !part->mixed[s] ? 1 : 2); i++)
    {
      int key = i ? !s : s;

      drawn->puppet[i] = d->between->key[key];
      drawn->layer[i]  = &drawn->puppet[i]->layer[part->layer[key]];
      drawn->flags[i]  = d->between->flags[key][part->layer[key]];
      drawn->mark[i]   = drawn->puppet[i]->mark + 1;
      drawn->puppet[i]->mark += 2;
      drawn->box = celd_rect_union (drawn->box, box_of (drawn->puppet[i], drawn->layer[i]));
    }
}

/* Lists what is drawn at a share of the way.  A part of the farther key alone comes before the first one that is in
 * front of it there. */
static void
list_parts (BetweenDrawing *d, double t)
{
  CeldInbetween    *between = d->between;
  int               s = t >= CELD_SECOND_KEY;
  const CeldPuppet *near = between->key[s];
  size_t            next = 0;          /* layer of the farther key */

  for (size_t k = 0; k <= near->n; k++)
    {
      const CeldBetweenPart *part = k < near->n ? between->of_layer[s][k] : NULL;
      size_t                 before = !part ? between->key[!s]->n : part->layer[!s];

      for (; next < before && before != CELD_NO_INDEX; next++)
        {
          const CeldBetweenPart *other = between->of_layer[!s][next];

          if (other->layer[s] == CELD_NO_INDEX && other->hides && !d->exact)
            add_part (d, other, !s, true);
        }
      if (part)
        add_part (d, part, s, d->exact);
    }
}

/* Makes room for marks of all layers; those of earlier drawings are forgotten before they are used up. */
static void
reserve_marks (CeldPuppet *puppet)
{
  if (puppet->mark < UINT32_MAX - 4 * ((uint32_t) puppet->n + 1))
    return;
  memset (puppet->drawn, 0, 2 * (size_t) puppet->width * (size_t) puppet->height * sizeof *puppet->drawn);
  puppet->mark = 0;
}

/* ------------------------------------------------------------------ one part */

/* Fills single pixels that bent squares have left out: those with covered pixels on all sides but one. */
static void
fill_holes (const CeldPuppetCanvas *canvas, CeldRect box)
{
  for (int y = canvas->top; y < canvas->bottom; y++)
    for (int x = box.x; x < box.x + box.width; x++)
      {
        static const int side[4][2] = { { -1, 0 }, { 1, 0 }, { 0, -1 }, { 0, 1 } };
        float           *pixel = CELD_RGBA (canvas->picture, x, y), sum[4] = { 0, 0, 0, 0 };
        int              covered = 0;

        for (int k = 0; k < 4 && pixel[3] < HOLE; k++)
          {
            int          u = x + side[k][0], v = y + side[k][1];
            const float *beside;

            if (u < box.x || v < canvas->top || u >= box.x + box.width || v >= canvas->bottom)
              continue;
            beside = CELD_RGBA (canvas->picture, u, v);
            if (beside[3] < BESIDE_HOLE)
              continue;
            covered++;
            for (int c = 0; c < 4; c++)
              sum[c] += beside[c];
          }
        for (int c = 0; c < 4 && covered >= 3; c++)
          pixel[c] = sum[c] / (float) covered;
      }
}

/* Draws a layer, with its colours or flags. */
static void
draw_layer (const CeldPuppetCanvas *canvas, const CeldPuppetLayer *layer, uint32_t mark)
{
  if (!layer->cell)
    celd_puppet_draw_rest (canvas, layer);
  for (int beside = 0; beside < 2; beside++)
    for (size_t c = layer->first; c < layer->first + layer->n_cells; c++)
      celd_puppet_draw_cell (canvas, layer, c, 0, mark, beside);
}

/* Chooses the colour of a pixel: what the key that the part is drawn from shows, else what the other one shows where
 * that one is hidden, else the guess, but not where the other key knows better. */
static const float *
choose_colour (const float *near, const float *near_flags, const float *far, const float *far_flags)
{
  bool far_counts = far[3] > 0 && 2 * far_flags[CELD_KEY_SEEN] > far_flags[3] &&
                    2 * far_flags[CELD_KEY_UNKNOWN] > far_flags[3];

  if (near[3] > 0 && 2 * near_flags[CELD_KEY_SEEN] > near_flags[3])
    return near;
  if (far_counts)
    return far;
  return near[3] > 0 && (2 * near_flags[CELD_KEY_UNKNOWN] > near_flags[3] || 2 * far[3] > 1) ? near : NULL;
}

/* Draws a part over the picture, in some of its rows. */
static void
draw_part (const BetweenDrawing *d, const DrawnPart *part, int top, int bottom)
{
  for (int i = 0; i < (part->layer[1] ? CANVASES : 1); i++)
    {
      CeldPuppetCanvas canvas = { part->puppet[i / 2], &d->canvas[i], NULL, top, bottom };
      CeldPuppetLayer  layer = *part->layer[i / 2];

      for (int y = top; y < bottom; y++)
        memset (CELD_RGBA (&d->canvas[i], part->box.x, y), 0, 4 * (size_t) part->box.width * sizeof (float));
      if (i % 2)
        layer.rgba = (float *) (uintptr_t) part->flags[i / 2];
      draw_layer (&canvas, &layer, part->mark[i / 2] + (uint32_t) (i % 2));
      if (layer.cell && !d->exact)
        fill_holes (&canvas, part->box);
    }
  for (int y = top; y < bottom; y++)
    for (int x = part->box.x; x < part->box.x + part->box.width; x++)
      {
        const float *colour = CELD_RGBA (&d->canvas[NEAR_COLOURS], x, y);
        float       *to = CELD_RGBA (d->picture, x, y);

        if (part->layer[1])
          colour = choose_colour (colour, CELD_RGBA (&d->canvas[NEAR_FLAGS], x, y),
                                  CELD_RGBA (&d->canvas[FAR_COLOURS], x, y), CELD_RGBA (&d->canvas[FAR_FLAGS], x, y));
        for (int c = 0; c < 4 && colour; c++)
          to[c] = colour[c] + (1 - colour[3]) * to[c];
      }
}

/* ------------------------------------------------------------------ bands of rows */

static void
draw_rows (void *data, int band)
{
  const BetweenDrawing *d = data;
  int                   top = band * PART_ROWS, end = top + PART_ROWS;

  end = end < d->picture->height ? end : d->picture->height;
  for (int y = top; y < end; y++)
    memset (CELD_RGBA (d->picture, 0, y), 0, 4 * (size_t) d->picture->width * sizeof (float));
  for (size_t i = 0; i < d->n; i++)
    {
      const CeldRect *box = &d->part[i].box;
      int             from = box->y > top ? box->y : top, to = box->y + box->height < end ? box->y + box->height : end;

      if (box->width && from < to)
        draw_part (d, &d->part[i], from, to);
    }
  for (int y = top; y < end; y++)
    for (int x = 0; x < d->picture->width; x++)
      {
        float *pixel = CELD_RGBA (d->picture, x, y), alpha = pixel[3];

        for (int c = 0; c < 3 && alpha > 0 && alpha < 1; c++)
          pixel[c] = fminf (pixel[c] / alpha, 1);
      }
}

CeldStatus
celd_inbetween_draw (CeldInbetween *between, double t, const CeldHost *host, CeldColours *picture)
{
  BetweenDrawing d = { .between = between, .picture = picture, .exact = t <= 0 || t >= 1 };
  size_t         pixels = (size_t) between->width * (size_t) between->height;
  CeldStatus     status = CELD_OK;

  if (!picture->data || picture->width != between->width || picture->height != between->height)
    return CELD_BAD_SIZE;
  if (!(t >= 0 && t <= 1))
    return CELD_BAD_VALUE;
  d.part = celd_alloc (between->key[0]->n + between->key[1]->n, sizeof *d.part);
  for (int i = 0; i < CANVASES; i++)
    {
      d.canvas[i] = (CeldColours) { between->width, between->height, (size_t) between->width,
                                    celd_alloc (pixels, 4 * sizeof (float)) };
      if (!d.part || !d.canvas[i].data)
        status = CELD_NO_MEMORY;
    }
  if (status == CELD_OK)
    {
      celd_between_shape (between, t);
      status = celd_progress (host, 1); /* before anything is drawn, since a picture stays as it was if this fails */
    }
  if (status == CELD_OK)
    {
      reserve_marks (between->key[0]);
      reserve_marks (between->key[1]);
      list_parts (&d, t);
      celd_parallel_for (host, (between->height + PART_ROWS - 1) / PART_ROWS, draw_rows, &d);
    }
  celd_free (d.part);
  for (int i = 0; i < CANVASES; i++)
    celd_free (d.canvas[i].data);
  return status;
}
