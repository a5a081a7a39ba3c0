/* Scribbles as an artist paints them -> one label a colour.
 *
 * Exact colours are counted first.  A pixel is FRINGE when it lies in a thin run, or on a ramp, between two other
 * colours and its own colour lies between theirs too: that is what soft brushes, antialiasing, overlaps and resampling
 * make, while a pencil line one pixel wide has the same colour on both its sides.  Colours with honest pixels become
 * labels; honest colours nearer to each other than the measured noise (none for an ordinary layer, JPEG, dither) are one.
 * Every other pixel goes to the label nearby whose colour is nearest.
 *
 * Transparent counts as a colour that is unlike every other.  Cost: O(pixels) and a sort of the colours;
 * 5 bytes a pixel, and 4 more for each pixel that has to be handed to a neighbour.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "private.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <stdio.h>

#define THIN 3          /* pixels: a run of a colour at most this long can be a fringe */
#define RAMP 8          /* pixels on either side over which a soft edge is recognised */
#define LEAST 4         /* honest pixels that make a label: a dot of 2 x 2 */
#define CLEAN 3         /* rounding of un-premultiplied colours: as near as this is equal */
#define NOISY 20        /* colours farther apart than this are never one label */

#define LOSSY 14
#define SATELLITE 40
#define PASSES 3
#define SIMILAR 36      /* colours this near may be one colour in a lossy picture */

#define NO_CLUSTER UINT32_MAX

typedef enum { FRINGE, HONEST, CORE } PixelKind;

/* One exact colour of the layer. */
typedef struct
{
  int      channel[3];
  uint32_t pixels, honest, core;
  uint32_t cluster;
} Colour;

/* Colours that mean one label; cluster 0 is none. */
typedef struct { int channel[3]; uint32_t colour, next, pixels, honest, core; bool is_label; } Cluster;

typedef struct
{
  const CeldPaint *paint;
  int              width, height;
  uint32_t        *id;          /* of each pixel: index into colour; 0 = transparent */
  uint8_t         *kind;        /* PixelKind of each pixel */
  uint32_t        *label;       /* of each pixel: its cluster */
  Colour          *colour;
  size_t           n;
  uint32_t        *slot;        /* hash table of colour indices; 0 = free */
  size_t           slots;       /* a power of two */
  uint32_t         paper;       /* the colour that means none in a picture without alpha; 0 = transparent does */
  int              radius;      /* colours as near as this are equal */
  bool             lossy;       /* there was noise to be filtered */
  Cluster         *cluster;
  size_t           n_clusters;
  uint32_t        *head;        /* first cluster in each cell of colour space */
} Reading;

/* ------------------------------------------------------------------ exact colours */

static size_t
slot_of (const Reading *r, uint32_t rgb)
{
  size_t s = (size_t) ((rgb * 2654435761u) >> 7) & (r->slots - 1);

  while (r->slot[s])
    {
      const int *c = r->colour[r->slot[s]].channel;

      if ((((uint32_t) c[0] << 16) | ((uint32_t) c[1] << 8) | (uint32_t) c[2]) == rgb)
        break;
      s = (s + 1) & (r->slots - 1);
    }
  return s;
}

static CeldStatus
grow_slots (Reading *r)
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
    {
      const int *c = r->colour[i].channel;

      r->slot[slot_of (r, ((uint32_t) c[0] << 16) | ((uint32_t) c[1] << 8) | (uint32_t) c[2])] = (uint32_t) i;
    }
  return CELD_OK;
}

/* The index of a colour, made when it is new; 0 = no memory. */
static uint32_t
colour_index (Reading *r, const uint8_t *rgba)
{
  uint32_t rgb = ((uint32_t) rgba[0] << 16) | ((uint32_t) rgba[1] << 8) | rgba[2];
  size_t   s;
  Colour  *grown;

  if (2 * (r->n + 1) > r->slots && grow_slots (r) != CELD_OK)
    return 0;
  s = slot_of (r, rgb);
  if (r->slot[s])
    return r->slot[s];
  grown = celd_grow (r->colour, r->n + 1, sizeof *grown);
  if (!grown)
    return 0;
  r->colour = grown;
  grown[r->n] = (Colour) { { rgba[0], rgba[1], rgba[2] }, 0, 0, 0, NO_CLUSTER };
  r->slot[s] = (uint32_t) r->n;
  return (uint32_t) r->n++;
}

static CeldStatus
count_colours (Reading *r, bool flats, const CeldRun *run)
{
  bool opaque = true;

  for (int y = 0; y < r->height; y++)
    {
      const uint8_t *p = CELD_RGBA (r->paint, 0, y);
      uint32_t      *id = r->id + (size_t) y * (size_t) r->width;

      if (celd_step (run, 0.3 * y / r->height) != CELD_OK)
        return CELD_CANCELLED;
      for (int x = 0; x < r->width; x++, p += 4)
        {
          opaque = opaque && p[3] == 255;
          if (p[3] < 128)
            id[x] = 0;
          else if (x && id[x - 1] && !memcmp (p, p - 4, 3))
            id[x] = id[x - 1];
          else if (!(id[x] = colour_index (r, p)))
            return CELD_NO_MEMORY;
          r->colour[id[x]].pixels++;
        }
    }
  if (opaque && !flats)
    for (size_t i = 1; i < r->n; i++)
      if (r->colour[i].pixels > r->colour[r->paper].pixels || !r->paper)
        r->paper = (uint32_t) i;
  return CELD_OK;
}

static int
distance_squared (const int *a, const int *b)
{
  int d0 = a[0] - b[0], d1 = a[1] - b[1], d2 = a[2] - b[2];

  return d0 * d0 + d1 * d1 + d2 * d2;
}

/* How far a pixel is from the mean of those beside it, in nine of ten places where the three are of one stroke; a ramp
 * is no noise. */
static void
measure_noise (Reading *r)
{
  size_t places[NOISY + 1] = { 0 }, all = 0, below = 0;
  int    noise = 0;

  for (int y = 0; y < r->height; y++)
    for (int x = 1; x < r->width - 1; x++)
      {
        const uint32_t *id = r->id + (size_t) y * (size_t) r->width + (size_t) x;
        const int      *a, *b, *c;
        int             mean[3], d = 0;

        if (!id[-1] || !id[0] || !id[1] || id[0] == r->paper)
          continue;
        a = r->colour[id[-1]].channel;
        b = r->colour[id[1]].channel;
        c = r->colour[id[0]].channel;
        if (id[-1] != id[0] || id[1] != id[0])
          {
            if (distance_squared (a, c) > SIMILAR * SIMILAR || distance_squared (b, c) > SIMILAR * SIMILAR)
              continue;
            for (int i = 0; i < 3; i++)
              mean[i] = (a[i] + b[i] + 1) / 2;
            d = (int) sqrt (distance_squared (mean, c));
          }
        places[d < NOISY ? d : NOISY]++;
        all++;
      }
  while (noise < NOISY && 10 * (below += places[noise]) < 9 * all)
    noise++;
  r->radius = noise + CLEAN < NOISY ? noise + CLEAN : NOISY;
  if (getenv ("DBG")) fprintf (stderr, "radius %d\n", r->radius);
}

/* ------------------------------------------------------------------ noise */

typedef struct { const CeldPaint *from; CeldPaint to; const Colour *paper; } Filter; /* paper NULL: transparent */

static bool
is_none (const Filter *f, const uint8_t *rgba)
{
  const int *p = f->paper ? f->paper->channel : NULL;

  return rgba[3] < 128 || (p && rgba[0] == p[0] && rgba[1] == p[1] && rgba[2] == p[2]);
}

/* Each pixel becomes the mean of those among the 5x5 round it that have nearly its colour (a sigma filter, [Lee83]):
 * the blocks and echoes of lossy pictures go, edges stay. */
static void
filter_row (void *data, int y)
{
  Filter *f = data;

  for (int x = 0; x < f->to.width; x++)
    {
      const uint8_t *c = CELD_RGBA (f->from, x, y);
      int            sum[3] = { 0 }, n = 0;

      memcpy (CELD_RGBA (&f->to, x, y), c, 4);
      if (is_none (f, c))
        continue;
      for (int v = y > 2 ? y - 2 : 0; v <= y + 2 && v < f->to.height; v++)
        for (int u = x > 2 ? x - 2 : 0; u <= x + 2 && u < f->to.width; u++)
          {
            const uint8_t *q = CELD_RGBA (f->from, u, v);
            int            d0 = q[0] - c[0], d1 = q[1] - c[1], d2 = q[2] - c[2];

            if (q[3] < 128 || d0 * d0 + d1 * d1 + d2 * d2 > SIMILAR * SIMILAR)
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

static CeldStatus
filter (Reading *r, bool flats, const CeldRun *run)
{
  size_t     pixels = (size_t) r->width * (size_t) r->height;
  CeldPaint  buffer[2] = { { r->width, r->height, (size_t) r->width, celd_alloc (pixels, 4) },
                           { r->width, r->height, (size_t) r->width, celd_alloc (pixels, 4) } };
  CeldStatus status = buffer[0].data && buffer[1].data ? CELD_OK : CELD_NO_MEMORY;

  for (int i = 0; i < PASSES && status == CELD_OK; i++)
    {
      Filter f = { i ? &buffer[(i + 1) % 2] : r->paint, buffer[i % 2], r->paper ? &r->colour[r->paper] : NULL };

      celd_each (run, r->height, filter_row, &f);
      status = celd_step (run, 0);
    }
  if (status == CELD_OK)
    {
      const CeldPaint *unfiltered = r->paint;

      r->n = 1;
      r->paper = 0;
      memset (r->slot, 0, r->slots * sizeof *r->slot);
      r->colour[0].pixels = 0;
      r->paint = &buffer[(PASSES + 1) % 2];
      status = count_colours (r, flats, run);
      r->paint = unfiltered;
      r->radius = LOSSY;
      r->lossy = true;
    }
  celd_free (buffer[0].data);
  celd_free (buffer[1].data);
  return status;
}

/* ------------------------------------------------------------------ fringes */

static bool
differ (const Reading *r, uint32_t a, uint32_t b)
{
  if (a == b)
    return false;
  return !a || !b || distance_squared (r->colour[a].channel, r->colour[b].channel) > r->radius * r->radius;
}

/* Is the colour c, unlike both, a step from a to b?  (The angle at c is obtuse.) */
static bool
between (const Reading *r, uint32_t a, uint32_t c, uint32_t b)
{
  const int *ca = r->colour[a].channel, *cb = r->colour[b].channel, *cc = r->colour[c].channel;
  int        dot = 0;

  if (!a || !b)
    return a || b;
  for (int i = 0; i < 3; i++)
    dot += (cc[i] - ca[i]) * (cb[i] - cc[i]);
  return dot > 0;
}

/* The pixel at p has `before` pixels before it and `after` behind it on a line of the picture, `step` apart. */
static bool
in_fringe (const Reading *r, const uint32_t *p, int before, int after, ptrdiff_t step)
{
  int a = 1, b = 1;

  while (a <= before && a <= THIN && !differ (r, p[-a * step], *p))
    a++;
  while (b <= after && b <= THIN && !differ (r, p[b * step], *p))
    b++;
  if (a <= before && b <= after && a + b - 1 <= THIN)
    return between (r, p[-a * step], *p, p[b * step]);
  if (before < RAMP || after < RAMP || !p[-RAMP * step] || !p[RAMP * step] || !p[-2 * step] || !p[2 * step])
    return false;
  return p[-2 * step] != *p && p[2 * step] != *p && between (r, p[-2 * step], *p, p[2 * step]) &&
         differ (r, p[-RAMP * step], *p) && differ (r, p[RAMP * step], *p) &&
         between (r, p[-RAMP * step], *p, p[RAMP * step]);
}

static void
judge_row (void *data, int y)
{
  Reading *r = data;
  size_t   width = (size_t) r->width;

  for (int x = 0; x < r->width; x++)
    {
      size_t          i = (size_t) y * width + (size_t) x;
      const uint32_t *p = r->id + i;
      int             left = x, right = r->width - 1 - x, above = y, below = r->height - 1 - y;

      if (!*p || *p == r->paper)
        r->kind[i] = CORE;
      else if (in_fringe (r, p, left, right, 1) || in_fringe (r, p, above, below, (ptrdiff_t) width))
        r->kind[i] = FRINGE;
      else
        r->kind[i] = (left && differ (r, p[-1], *p)) || (right && differ (r, p[1], *p)) ||
                     (above && differ (r, p[-(ptrdiff_t) width], *p)) || (below && differ (r, p[width], *p)) ? HONEST : CORE;
    }
}

static void
count_honest (Reading *r)
{
  size_t pixels = (size_t) r->width * (size_t) r->height;

  for (size_t i = 0; i < pixels; i++)
    {
      r->colour[r->id[i]].honest += r->kind[i] != FRINGE;
      r->colour[r->id[i]].core += r->kind[i] == CORE;
    }
}

/* ------------------------------------------------------------------ clusters of colours */

typedef struct { uint32_t honest, id; } Candidate;

static int
by_falling_honesty (const void *a, const void *b)
{
  const Candidate *p = a, *q = b;

  if (p->honest != q->honest)
    return p->honest < q->honest ? 1 : -1;
  return (p->id > q->id) - (p->id < q->id);
}

/* Cells are a radius wide, so that whatever is near lies in one of the 27 cells round about. */
static int
cell_side (const Reading *r)
{
  return 255 / r->radius + 1;
}

/* The nearest cluster within the radius, NO_CLUSTER if there is none. */
static uint32_t
nearest_cluster (const Reading *r, const int *channel)
{
  int      side = cell_side (r), least = r->radius * r->radius + 1;
  int      low[3], high[3];
  uint32_t found = NO_CLUSTER;

  for (int i = 0; i < 3; i++)
    {
      low[i] = channel[i] / r->radius > 0 ? channel[i] / r->radius - 1 : 0;
      high[i] = channel[i] / r->radius + 1 < side ? channel[i] / r->radius + 1 : side - 1;
    }
  for (int u = low[0]; u <= high[0]; u++)
    for (int v = low[1]; v <= high[1]; v++)
      for (int w = low[2]; w <= high[2]; w++)
        for (uint32_t k = r->head[(u * side + v) * side + w]; k != NO_CLUSTER; k = r->cluster[k].next)
          {
            int d = distance_squared (r->cluster[k].channel, channel);

            if (d < least)
              {
                least = d;
                found = k;
              }
          }
  return found;
}

static CeldStatus
add_cluster (Reading *r, uint32_t id)
{
  Cluster   *grown = celd_grow (r->cluster, r->n_clusters + 1, sizeof *grown);
  const int *c = r->colour[id].channel;
  int        side = cell_side (r);
  size_t     cell = (size_t) ((c[0] / r->radius * side + c[1] / r->radius) * side + c[2] / r->radius);

  if (!grown)
    return CELD_NO_MEMORY;
  r->cluster = grown;
  grown[r->n_clusters] = (Cluster) { { c[0], c[1], c[2] }, id, NO_CLUSTER, 0, 0, 0, false };
  if (id) /* transparent is near nothing */
    {
      grown[r->n_clusters].next = r->head[cell];
      r->head[cell] = (uint32_t) r->n_clusters;
    }
  r->n_clusters++;
  return CELD_OK;
}

static void
tally_clusters (Reading *r)
{
  for (size_t k = 0; k < r->n_clusters; k++)
    r->cluster[k].pixels = r->cluster[k].honest = r->cluster[k].core = 0;
  for (size_t i = 1; i < r->n; i++)
    if (r->colour[i].cluster != NO_CLUSTER)
      {
        const Colour *c = &r->colour[i];
        Cluster      *k = &r->cluster[c->cluster];

        k->pixels += c->pixels;
        k->honest += c->honest;
        k->core += c->core;
      }
}

/* Is an eighth of the cluster inside strokes, as it is not for the rims of strokes? */
static bool
has_core (const Cluster *k)
{
  return k->core >= LEAST && 8 * (size_t) k->core >= k->pixels;
}

/* The nearest larger cluster of nearly the same colour; the cluster itself if there is none. */
static uint32_t
larger_cluster (const Reading *r, uint32_t k)
{
  const Cluster *c = &r->cluster[k];
  int            least = SATELLITE * SATELLITE + 1;
  uint32_t       found = k;

  for (uint32_t j = 0; j < r->n_clusters && k; j++)
    {
      const Cluster *l = &r->cluster[j];
      int            d = distance_squared (c->channel, l->channel);

      if (d < least && l->colour && (l->pixels > c->pixels || (l->pixels == c->pixels && j < k)))
        {
          least = d;
          found = j;
        }
    }
  return found;
}

/* In a lossy picture the rim and the ends of strokes make clusters of their own: a cluster that keeps touching a larger
 * one of nearly its colour is a part of that. */
static CeldStatus
absorb_satellites (Reading *r)
{
  uint32_t *parent = celd_alloc (r->n_clusters, sizeof *parent), *touch = celd_alloc0 (r->n_clusters, sizeof *touch);

  if (!parent || !touch)
    {
      celd_free (touch);
      celd_free (parent);
      return CELD_NO_MEMORY;
    }
  for (uint32_t k = 0; k < r->n_clusters; k++)
    parent[k] = larger_cluster (r, k);
  for (int y = 0; y < r->height; y++)
    for (int x = 0; x < r->width; x++)
      for (int i = 0; i < 2; i++)
        if (x + !i < r->width && y + i < r->height)
          {
            size_t   p = (size_t) y * (size_t) r->width + (size_t) x, q = i ? p + (size_t) r->width : p + 1;
            uint32_t a = r->colour[r->id[p]].cluster, b = r->colour[r->id[q]].cluster;

            if (a == b || a == NO_CLUSTER || b == NO_CLUSTER)
              continue;
            touch[a] += parent[a] == b;
            touch[b] += parent[b] == a;
          }
  for (uint32_t k = 0; k < r->n_clusters; k++)
    if (touch[k] < LEAST || 10 * (size_t) touch[k] < r->cluster[k].pixels || (!r->lossy && has_core (&r->cluster[k])))
      parent[k] = k;
  for (size_t i = 1; i < r->n; i++)
    while (r->colour[i].cluster != NO_CLUSTER && parent[r->colour[i].cluster] != r->colour[i].cluster)
      r->colour[i].cluster = parent[r->colour[i].cluster];
  celd_free (touch);
  celd_free (parent);
  return CELD_OK;
}

/* Honest enough to be a label?  In a noisy picture a fringe may pass for a pencil line, so there a label needs an inside. */
static bool
is_label (const Reading *r, const Cluster *k)
{
  if (k->honest < LEAST || 3 * (size_t) k->honest < k->pixels)
    return false;
  return !r->lossy || has_core (k);
}

/* The colours with most honest pixels first; each takes in what lies within the radius. */
static CeldStatus
cluster_colours (Reading *r)
{
  Candidate *candidate = celd_alloc (r->n, sizeof *candidate);
  size_t     cells = (size_t) cell_side (r) * (size_t) cell_side (r) * (size_t) cell_side (r), n = 0;
  CeldStatus status = CELD_NO_MEMORY;

  r->head = celd_alloc (cells, sizeof *r->head);
  if (!candidate || !r->head)
    goto done;
  for (size_t i = 0; i < cells; i++)
    r->head[i] = NO_CLUSTER;
  for (size_t i = 1; i < r->n; i++)
    if (r->colour[i].honest)
      candidate[n++] = (Candidate) { r->colour[i].honest, (uint32_t) i };
  qsort (candidate, n, sizeof *candidate, by_falling_honesty);

  status = add_cluster (r, r->paper);
  for (size_t i = 0; i < n && status == CELD_OK; i++)
    if (nearest_cluster (r, r->colour[candidate[i].id].channel) == NO_CLUSTER)
      status = add_cluster (r, candidate[i].id);
  for (size_t i = 1; i < r->n && status == CELD_OK; i++)
    r->colour[i].cluster = nearest_cluster (r, r->colour[i].channel);
  if (status == CELD_OK)
    tally_clusters (r);
  if (status == CELD_OK)
    {
      status = absorb_satellites (r);
      tally_clusters (r);
    }
  for (size_t k = 1; k < r->n_clusters && status == CELD_OK; k++)
    r->cluster[k].is_label = is_label (r, &r->cluster[k]);

done:
  celd_free (candidate);
  return status;
}

/* ------------------------------------------------------------------ pixels to labels */

/* Until the palette is made, a pixel's label is its cluster, or one of these. */
#define UNDECIDED UINT32_MAX
#define QUEUED (UINT32_MAX - 1)

/* The label of a pixel's own colour; UNDECIDED if its colour is no label's. */
static uint32_t
own_label (const Reading *r, size_t i)
{
  uint32_t k = r->id[i] ? r->colour[r->id[i]].cluster : 0;

  return k == 0 || (k != NO_CLUSTER && r->cluster[k].is_label) ? k : UNDECIDED;
}

/* Does an honest pixel of the same label touch the pixel (x,y)? */
static bool
is_rim (const Reading *r, int x, int y, uint32_t label)
{
  for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < r->height; v++)
    for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < r->width; u++)
      {
        size_t i = (size_t) v * (size_t) r->width + (size_t) u;

        if (r->kind[i] != FRINGE && own_label (r, i) == label)
          return true;
      }
  return false;
}

static void
place_row (void *data, int y)
{
  Reading  *r = data;
  uint32_t *label = r->label + (size_t) y * (size_t) r->width;

  for (int x = 0; x < r->width; x++)
    {
      size_t i = (size_t) y * (size_t) r->width + (size_t) x;

      label[x] = own_label (r, i);
      if (label[x] && label[x] != UNDECIDED && r->kind[i] == FRINGE && !is_rim (r, x, y, label[x]))
        label[x] = UNDECIDED;
    }
}

/* Among the labels that touch the pixel, the one of the nearest colour; none where paper is nearer still. */
static uint32_t
nearest_neighbour (const Reading *r, size_t i)
{
  const int *c = r->colour[r->id[i]].channel;
  int        x = (int) (i % (size_t) r->width), y = (int) (i / (size_t) r->width);
  int        least = r->paper ? distance_squared (c, r->colour[r->paper].channel) : INT_MAX;
  uint32_t   found = 0;

  for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < r->height; v++)
    for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < r->width; u++)
      {
        uint32_t label = r->label[(size_t) v * (size_t) r->width + (size_t) u];
        int      d;

        if (!label || label >= QUEUED)
          continue;
        d = distance_squared (c, r->cluster[label].channel);
        if (d < least || (d == least && label < found))
          {
            least = d;
            found = label;
          }
      }
  return found;
}

/* Queues the undecided pixels that touch pixel i. */
static size_t
queue_neighbours (Reading *r, size_t i, uint32_t *queue, size_t n)
{
  int x = (int) (i % (size_t) r->width), y = (int) (i / (size_t) r->width);

  for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < r->height; v++)
    for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < r->width; u++)
      {
        size_t j = (size_t) v * (size_t) r->width + (size_t) u;

        if (r->label[j] == UNDECIDED)
          {
            r->label[j] = QUEUED;
            queue[n++] = (uint32_t) j;
          }
      }
  return n;
}

/* Undecided pixels take a label from their neighbours, ring by ring; what no label reaches is none. */
static CeldStatus
place_rest (Reading *r, const CeldRun *run)
{
  size_t     pixels = (size_t) r->width * (size_t) r->height, undecided = 0, ring = 0, end = 0, decided;
  uint32_t  *queue, *taken;
  CeldStatus status = CELD_NO_MEMORY;

  for (size_t i = 0; i < pixels; i++)
    undecided += r->label[i] == UNDECIDED;
  queue = celd_alloc (undecided, sizeof *queue);
  taken = celd_alloc (undecided, sizeof *taken);
  if (!queue || !taken)
    goto done;

  for (size_t i = 0; i < pixels; i++)
    if (r->label[i] && r->label[i] < QUEUED)
      end = queue_neighbours (r, i, queue, end);
  while (ring < end)
    {
      status = celd_step (run, 0.8 + 0.2 * (double) ring / (double) undecided);
      if (status != CELD_OK)
        goto done;
      for (size_t i = ring; i < end; i++)
        taken[i] = nearest_neighbour (r, queue[i]);
      for (size_t i = ring; i < end; i++)
        r->label[queue[i]] = taken[i];
      decided = end;
      for (size_t i = ring; i < decided; i++)
        if (taken[i])
          end = queue_neighbours (r, queue[i], queue, end);
      ring = decided;
    }
  status = CELD_OK;

done:
  celd_free (taken);
  celd_free (queue);
  return status;
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

/* Counts each cluster's pixels; (x,y) is the middle of its longest row of pixels, whose length goes to area. */
static void
survey_labels (const Reading *r, CeldRegion *of)
{
  for (int y = 0; y < r->height; y++)
    for (int x = 0, end; x < r->width; x = end)
      {
        const uint32_t *label = r->label + (size_t) y * (size_t) r->width;
        size_t          length;

        for (end = x + 1; end < r->width && label[end] == label[x]; end++)
          ;
        if (!label[x] || label[x] >= QUEUED)
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

/* Palette and seeds at once, so that neither changes when memory is short. */
static CeldStatus
deliver (const Reading *r, CeldLabels *seeds, CeldPalette *palette)
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
  survey_labels (r, of);
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

        CELD_AT (seeds, x, y) = label >= QUEUED ? 0 : number[label];
      }
  celd_palette_clear (palette);
  *palette = (CeldPalette) { item, n };
  celd_free (number);
  celd_free (of);
  return CELD_OK;
}

/* ------------------------------------------------------------------ the whole reading */

static void
free_reading (Reading *r)
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
celd_scribbles_read (const CeldPaint *scribbles, const CeldSettings *settings, const CeldRun *run,
                     CeldLabels *seeds, CeldPalette *palette)
{
  Reading    r = { .paint = scribbles, .width = scribbles->width, .height = scribbles->height, .n = 1 };
  size_t     pixels;
  CeldStatus status;

  if (!CELD_SAME_SIZE (scribbles, seeds))
    return CELD_BAD_SIZE;
  pixels = (size_t) r.width * (size_t) r.height;
  r.id = celd_alloc (pixels, sizeof *r.id);
  r.label = celd_alloc (pixels, sizeof *r.label);
  r.kind = celd_alloc (pixels, 1);
  r.colour = celd_grow (NULL, 1, sizeof *r.colour);
  status = r.id && r.label && r.kind && r.colour ? CELD_OK : CELD_NO_MEMORY;
  if (status == CELD_OK)
    {
      r.colour[0] = (Colour) { { 0, 0, 0 }, 0, 0, 0, 0 };
      status = count_colours (&r, settings->flats, run);
    }
  if (status == CELD_OK)
    {
      measure_noise (&r);
      if (r.radius > 2 * CLEAN)
        status = filter (&r, settings->flats, run);
    }
  if (status == CELD_OK)
    {
      celd_each (run, r.height, judge_row, &r);
      count_honest (&r);
      status = celd_step (run, 0.6);
    }
  if (status == CELD_OK)
    status = cluster_colours (&r);
  if (status == CELD_OK)
    {
      celd_each (run, r.height, place_row, &r);
      status = celd_step (run, 0.8);
    }
  if (status == CELD_OK)
    status = place_rest (&r, run);
  if (status == CELD_OK)
    status = deliver (&r, seeds, palette);
  free_reading (&r);
  return status;
}
