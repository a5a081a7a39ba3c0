/* Scribbles as an artist paints them: each of their colours is a label.
 *
 * A pixel is a fringe if it lies in a thin run, or on a ramp, between two other colours, and its own colour lies
 * between theirs, too.  Soft brushes, antialiasing, overlaps and resampling make fringes; a pencil line one pixel wide
 * is none, because it has the same colour on both of its sides.  A layer of few colours without translucent pixels has
 * hard strokes and no fringes: what is left of a stroke beside another one is a label, however thin.  Colours with
 * solid pixels are labels (scribble-clusters.c); every other pixel is assigned to one of them (scribble-places.c).
 * Transparent counts as a colour unlike all others.
 *
 * Cost: O(pixels); 9 bytes a pixel, and 8 more for each pixel whose label comes from a neighbour.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/input.h"

#include <stdlib.h>
#include <string.h>

#define RAMP 8 /* pixels on either side within which a soft edge is recognised; chosen */

/* ------------------------------------------------------------------ fringes */

static bool
differ (const CeldScribbleLayer *r, uint32_t a, uint32_t b)
{
  if (a == b)
    return false;
  return !a || !b || celd_colour_distance (r->colour[a].channel, r->colour[b].channel) > r->radius * r->radius;
}

/* Is colour c, which differs from both, between a and b?  That is, is the angle at c obtuse? */
static bool
between (const CeldScribbleLayer *r, uint32_t a, uint32_t c, uint32_t b)
{
  const int *ca = r->colour[a].channel, *cb = r->colour[b].channel, *cc = r->colour[c].channel;
  int        dot = 0;

  if (!a || !b)
    return a || b;
  for (int i = 0; i < 3; i++)
    dot += (cc[i] - ca[i]) * (cb[i] - cc[i]);
  return dot > 0;
}

/* Is the pixel at p in a fringe along a row or column? There are `before` pixels before it and `after` pixels after it,
 * `step` apart. */
static bool
in_fringe (const CeldScribbleLayer *r, const uint32_t *p, int before, int after, ptrdiff_t step)
{
  int a = 1, b = 1;

  while (a <= before && a <= CELD_THIN && !differ (r, p[-a * step], *p))
    a++;
  while (b <= after && b <= CELD_THIN && !differ (r, p[b * step], *p))
    b++;
  if (a <= before && b <= after && a + b - 1 <= CELD_THIN)
    return between (r, p[-a * step], *p, p[b * step]);
  if (before < 2 || after < 2)
    return false;
  before = before < RAMP ? before : RAMP;
  after = after < RAMP ? after : RAMP;
  if (!p[-before * step] || !p[after * step] || !p[-2 * step] || !p[2 * step])
    return false;
  return p[-2 * step] != *p && p[2 * step] != *p && between (r, p[-2 * step], *p, p[2 * step]) &&
         differ (r, p[-before * step], *p) && differ (r, p[after * step], *p) &&
         between (r, p[-before * step], *p, p[after * step]);
}

/* Fills in the kinds of one row. */
static void
classify_row (void *data, int y)
{
  CeldScribbleLayer *r = data;
  size_t             width = (size_t) r->width;

  for (int x = 0; x < r->width; x++)
    {
      size_t          i = (size_t) y * width + (size_t) x;
      const uint32_t *p = r->id + i;
      int             left = x, right = r->width - 1 - x, above = y, below = r->height - 1 - y;

      if (!*p)
        r->kind[i] = CELD_INTERIOR;
      else if (!r->hard && (in_fringe (r, p, left, right, 1) || in_fringe (r, p, above, below, (ptrdiff_t) width)))
        r->kind[i] = CELD_FRINGE;
      else
        {
          bool rim = (left && differ (r, p[-1], *p)) || (right && differ (r, p[1], *p)) ||
                     (above && differ (r, p[-(ptrdiff_t) width], *p)) || (below && differ (r, p[width], *p));

          r->kind[i] = rim ? CELD_SOLID : CELD_INTERIOR;
        }
    }
}

static void
count_kinds (CeldScribbleLayer *r)
{
  for (size_t i = 0; i < r->pixels; i++)
    {
      r->colour[r->id[i]].solid += r->kind[i] != CELD_FRINGE;
      r->colour[r->id[i]].interior += r->kind[i] == CELD_INTERIOR;
    }
}

/* ------------------------------------------------------------------ palette */

static int
by_falling_seeds (const void *a, const void *b)
{
  const CeldRegion *p = a, *q = b;

  if (p->seeds != q->seeds)
    return p->seeds < q->seeds ? 1 : -1;
  return memcmp (p->colour, q->colour, sizeof p->colour);
}

/* Counts each cluster's pixels in seeds; (x,y) is the middle of its longest run, and area the length of that. */
static void
measure_labels (const CeldScribbleLayer *r, CeldRegion *of)
{
  for (int y = 0; y < r->height; y++)
    for (int x = 0, end; x < r->width; x = end)
      {
        const uint32_t *label = r->label + (size_t) y * (size_t) r->width;
        size_t          length;

        for (end = x + 1; end < r->width && label[end] == label[x]; end++)
          ;
        if (!label[x] || label[x] >= CELD_QUEUED)
          continue;
        length = (size_t) (end - x);
        of[label[x]].seeds += length;
        if (length > of[label[x]].area)
          {
            of[label[x]].area = length;
            of[label[x]].x = (x + end - 1) / 2;
            of[label[x]].y = y;
          }
      }
}

/* Writes palette and seeds; neither changes if it fails. */
static CeldStatus
write_result (const CeldScribbleLayer *r, CeldLabels *seeds, CeldPalette *palette)
{
  CeldRegion *of = celd_alloc0 (r->n_clusters, sizeof *of);      /* by cluster */
  CeldRegion *item = celd_alloc (r->n_clusters, sizeof *item);   /* those with pixels, sorted */
  uint32_t   *number = celd_alloc0 (r->n_clusters, sizeof *number);
  size_t      n = 0;

  if (!of || !item || !number)
    {
      celd_free (number);
      celd_free (item);
      celd_free (of);
      return CELD_NO_MEMORY;
    }
  measure_labels (r, of);
  for (size_t k = 1; k < r->n_clusters; k++)
    if (of[k].seeds)
      {
        const int *c = r->cluster[k].channel;

        item[n] = of[k];
        memcpy (item[n].colour, (uint8_t[4]) { (uint8_t) c[0], (uint8_t) c[1], (uint8_t) c[2], 255 }, 4);
        item[n].origin = CELD_FROM_SCRIBBLE;
        item[n++].area = k;
      }
  qsort (item, n, sizeof *item, by_falling_seeds);
  for (size_t i = 0; i < n; i++)
    {
      number[item[i].area] = (uint32_t) i + 1;
      item[i].area = 0;
    }
  for (int y = 0; y < r->height; y++)
    for (int x = 0; x < r->width; x++)
      {
        uint32_t label = r->label[(size_t) y * (size_t) r->width + (size_t) x];

        CELD_AT (seeds, x, y) = label >= CELD_QUEUED ? 0 : number[label];
      }
  celd_palette_clear (palette);
  *palette = (CeldPalette) { item, n };
  celd_free (number);
  celd_free (of);
  return CELD_OK;
}

/* ------------------------------------------------------------------ all steps */

static void
layer_clear (CeldScribbleLayer *r)
{
  celd_free (r->id);
  celd_free (r->kind);
  celd_free (r->label);
  celd_free (r->colour);
  celd_free (r->slot);
  celd_free (r->cluster);
  celd_free (r->head);
}

CeldStatus
celd_scribbles_read (const CeldPaint *scribbles, const CeldSettings *settings, const CeldHost *host,
                     CeldLabels *seeds, CeldPalette *palette)
{
  CeldHostPart      part;
  CeldHost          begin = celd_host_part (&part, host, 0, 0.5);
  CeldScribbleLayer r = { .paint = scribbles, .width = scribbles->width, .height = scribbles->height };
  CeldStatus        status;

  if (!CELD_SAME_SIZE (scribbles, seeds))
    return CELD_BAD_SIZE;
  r.pixels = (size_t) r.width * (size_t) r.height;
  r.id = celd_alloc (r.pixels, sizeof *r.id);
  r.label = celd_alloc (r.pixels, sizeof *r.label);
  r.kind = celd_alloc (r.pixels, 1);
  status = r.id && r.label && r.kind ? celd_scribble_colours (&r, settings->flats, &begin) : CELD_NO_MEMORY;
  if (status == CELD_OK && settings->flats)
    status = celd_scribble_gradients (&r);
  else if (status == CELD_OK && r.paper)
    status = celd_scribble_tints (&r);
  if (status != CELD_OK)
    goto done;

  celd_parallel_for (host, r.height, classify_row, &r);
  count_kinds (&r);
  status = celd_progress (host, 0.6);
  if (status == CELD_OK)
    status = celd_scribble_clusters (&r, host);
  if (status == CELD_OK && !settings->flats)
    status = celd_scribble_overlaps (&r);
  if (status == CELD_OK)
    status = celd_scribble_places (&r, host);
  if (status == CELD_OK)
    status = write_result (&r, seeds, palette);

done:
  layer_clear (&r);
  return status;
}
