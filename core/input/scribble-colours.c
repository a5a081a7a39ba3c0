/* The exact colours of a painted layer, after noise has been removed.
 *
 * Colours are counted in a hash table.  A picture that was stored with loss (scribble-noise.c) is restored if its strokes
 * are thin, else filtered, and its colours are counted again.  In a picture without alpha the commonest colour is paper.
 *
 * Cost: O(pixels); for a lossy picture 8 bytes a pixel more while it is filtered.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/input.h"

#include <string.h>

#define LOSSY_RADIUS  14 /* of 255: colours are equal in a filtered picture; chosen */
#define FILTER_PASSES 3  /* chosen */

/* ------------------------------------------------------------------ exact colours */

static uint32_t
packed_colour (const CeldScribbleColour *c)
{
  return (uint32_t) c->channel[0] << 16 | (uint32_t) c->channel[1] << 8 | (uint32_t) c->channel[2];
}

/* The slot that has a colour, or the free one for it. */
static size_t
slot_of (const CeldScribbleLayer *r, uint32_t rgb)
{
  size_t s = (size_t) ((rgb * 2654435761u) >> 7) & (r->slots - 1);

  while (r->slot[s] && packed_colour (&r->colour[r->slot[s]]) != rgb)
    s = (s + 1) & (r->slots - 1);
  return s;
}

static CeldStatus
grow_slots (CeldScribbleLayer *r)
{
  uint32_t *old = r->slot;
  size_t    slots = r->slots ? 2 * r->slots : 1024;

  r->slot = celd_alloc0 (slots, sizeof *r->slot);
  if (!r->slot)
    {
      r->slot = old;
      return CELD_NO_MEMORY;
    }
  r->slots = slots;
  celd_free (old);
  for (size_t i = 1; i < r->n; i++)
    r->slot[slot_of (r, packed_colour (&r->colour[i]))] = (uint32_t) i;
  return CELD_OK;
}

/* The index of a colour, which is added if it is new; 0: no memory. */
static uint32_t
colour_index (CeldScribbleLayer *r, const uint8_t *rgba)
{
  uint32_t rgb = ((uint32_t) rgba[0] << 16) | ((uint32_t) rgba[1] << 8) | rgba[2];
  size_t   s;

  if (2 * (r->n + 1) > r->slots && grow_slots (r) != CELD_OK)
    return 0;
  s = slot_of (r, rgb);
  if (r->slot[s])
    return r->slot[s];
  if (!celd_reserve_one (r->colour, r->n, r->colour_capacity))
    return 0;
  r->colour[r->n] = (CeldScribbleColour) { { rgba[0], rgba[1], rgba[2] }, 0, 0, 0, 0, CELD_NO_CLUSTER, false };
  r->slot[s] = (uint32_t) r->n;
  return (uint32_t) r->n++;
}

/* Counts all colours, fills in id, and finds the paper of an opaque layer. */
static CeldStatus
count_colours (CeldScribbleLayer *r, bool flats, const CeldHost *host)
{
  bool       opaque = true, hard = true;
  CeldStatus status = celd_scribble_paint (r);

  if (status != CELD_OK)
    return status;
  for (int y = 0; y < r->height; y++)
    {
      const uint8_t *p = CELD_RGBA (r->paint, 0, y);
      uint32_t      *id = r->id + (size_t) y * (size_t) r->width;

      if (celd_progress (host, (double) y / r->height) != CELD_OK)
        return CELD_CANCELLED;
      for (int x = 0; x < r->width; x++, p += 4)
        {
          opaque = opaque && p[3] == 255;
          hard = hard && (!p[3] || p[3] == 255);
          if (!r->kind[(size_t) y * (size_t) r->width + (size_t) x])
            id[x] = 0;
          else if (x && id[x - 1] && !memcmp (p, p - 4, 3))
            id[x] = id[x - 1];
          else if (!(id[x] = colour_index (r, p)))
            return CELD_NO_MEMORY;
          r->colour[id[x]].pixels++;
          r->colour[id[x]].opacity += p[3];
        }
    }
  hard = hard && !opaque;
  r->hard = hard && r->n <= CELD_HARD_COLOURS + 1;
  r->pixel_art = hard && r->width <= CELD_PIXEL_ART && r->height <= CELD_PIXEL_ART;
  if (opaque && !flats)
    for (size_t i = 1; i < r->n; i++)
      if (r->colour[i].pixels > r->colour[r->paper].pixels || !r->paper)
        r->paper = (uint32_t) i;
  return CELD_OK;
}

/* ------------------------------------------------------------------ filtering */

/* paper is transparent if transparent pixels are paper. */
typedef struct { const CeldPaint *from; CeldPaint to; uint8_t paper[4]; } Filter;

/* A sigma filter [Lee83] of one row: each pixel becomes the mean of those of the 5 x 5 pixels around it that have
 * nearly its colour, which removes blocks and ripple of compression, but keeps edges. */
static void
filter_row (void *data, int y)
{
  Filter *f = data;

  memcpy (CELD_RGBA (&f->to, 0, y), CELD_RGBA (f->from, 0, y), 4 * (size_t) f->to.width);
  for (int x = 0; x < f->to.width; x++)
    {
      const uint8_t *c = CELD_RGBA (f->from, x, y);
      int            sum[3] = { 0 }, n = 0;

      if (!memcmp (c, f->paper, 4) || c[3] < 128)
        continue;
      for (int v = y > 2 ? y - 2 : 0; v <= y + 2 && v < f->to.height; v++)
        for (int u = x > 2 ? x - 2 : 0; u <= x + 2 && u < f->to.width; u++)
          {
            const uint8_t *q = CELD_RGBA (f->from, u, v);
            int            d0 = q[0] - c[0], d1 = q[1] - c[1], d2 = q[2] - c[2];

            if (q[3] < 128 || d0 * d0 + d1 * d1 + d2 * d2 > CELD_SIMILAR * CELD_SIMILAR)
              continue;
            sum[0] += q[0];
            sum[1] += q[1];
            sum[2] += q[2];
            n++;
          }
      for (int i = 0; i < 3; i++)
        CELD_RGBA (&f->to, x, y)[i] = (uint8_t) ((2 * sum[i] + n) / (2 * n));
    }
}

static void
forget_colours (CeldScribbleLayer *r)
{
  r->n = 1;
  r->paper = 0;
  r->colour[0].pixels = 0;
  r->colour[0].opacity = 0;
  memset (r->slot, 0, r->slots * sizeof *r->slot);
}

/* Filters into buffer[0]; buffer[1] is work space. */
static CeldStatus
filter (const CeldScribbleLayer *r, CeldPaint *buffer, const CeldHost *host)
{
  const int *paper = r->colour[r->paper].channel;
  CeldStatus status = CELD_OK;

  for (int i = 0; i < FILTER_PASSES && status == CELD_OK; i++)
    {
      Filter f = { i ? &buffer[(i + 1) % 2] : r->paint, buffer[i % 2],
                   { (uint8_t) paper[0], (uint8_t) paper[1], (uint8_t) paper[2], r->paper ? 255 : 0 } };

      celd_parallel_for (host, r->height, filter_row, &f);
      status = celd_progress (host, 0.2 * (i + 1));
    }
  return status;
}

/* Counts the colours again, in a restored (if strokes are thin) or filtered copy. */
static CeldStatus
clean (CeldScribbleLayer *r, bool thin, bool flats, const CeldHost *host)
{
  CeldHostPart part;
  CeldHost     again = celd_host_part (&part, host, 0.8, 1);
  CeldPaint    buffer[2] = { { r->width, r->height, (size_t) r->width, celd_alloc (r->pixels, 4) },
                             { r->width, r->height, (size_t) r->width, thin ? NULL : celd_alloc (r->pixels, 4) } };
  CeldStatus   status = buffer[0].data && (thin || buffer[1].data) ? CELD_OK : CELD_NO_MEMORY;

  if (status == CELD_OK)
    status = thin ? celd_scribble_restore (r, host, &buffer[0]) : filter (r, buffer, host);
  if (status == CELD_OK)
    {
      const CeldPaint *stored = r->paint;

      forget_colours (r);
      r->paint = &buffer[0];
      status = count_colours (r, flats, &again);
      r->paint = stored;
      r->radius = LOSSY_RADIUS;
      r->lossy = true;
    }
  celd_free (buffer[0].data);
  celd_free (buffer[1].data);
  return status;
}

CeldStatus
celd_scribble_colours (CeldScribbleLayer *r, bool flats, const CeldHost *host)
{
  CeldHostPart part[2];
  CeldHost     count = celd_host_part (&part[0], host, 0, 0.3), rest = celd_host_part (&part[1], host, 0.3, 1);
  CeldStatus   status;

  if (!celd_reserve (&r->colour, 1, &r->colour_capacity, sizeof *r->colour))
    return CELD_NO_MEMORY;
  r->colour[0] = (CeldScribbleColour) { { 0, 0, 0 }, 0, 0, 0, 0, 0, false };
  r->n = 1;
  status = count_colours (r, flats, &count);
  if (status != CELD_OK)
    return status;
  return celd_scribble_noise (r) ? clean (r, celd_scribble_thin (r), flats, &rest) : CELD_OK;
}
