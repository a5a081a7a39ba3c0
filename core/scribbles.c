/* Scribbles as an artist paints them -> one label a colour.
 *
 * A pixel is FRINGE when it lies in a thin run, or on a ramp, between two other colours, and its own colour lies
 * between theirs too: that is what soft brushes, antialiasing, overlaps and resampling make, while a pencil line one
 * pixel wide has the same colour on both its sides.  Colours with honest pixels are labels (scribble-clusters.c);
 * every other pixel goes to the label nearby whose colour is nearest.  A line on opaque paper that is too thin to have
 * a pixel of its full colour is taken by its strongest one.
 *
 * Transparent counts as a colour that is unlike every other.
 * Cost: O(pixels); 9 bytes a pixel, and 8 more for each pixel that has to be handed to a neighbour.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "scribbles.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

#define THIN 3          /* pixels: a run of a colour at most this long can be a fringe */
#define RAMP 8          /* pixels on either side over which a soft edge is recognised */
#define TINT 30         /* how far a thinned colour may be off */
#define STRONG 60       /* a line differs from paper at least as much */

/* ------------------------------------------------------------------ fringes */

static bool
differ (const Reading *r, uint32_t a, uint32_t b)
{
  if (a == b)
    return false;
  return !a || !b || celd_colour_distance (r->colour[a].channel, r->colour[b].channel) > r->radius * r->radius;
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

      if (!*p || (r->paper && !differ (r, *p, r->paper)))
        r->kind[i] = CORE;
      else if (in_fringe (r, p, left, right, 1) || in_fringe (r, p, above, below, (ptrdiff_t) width))
        r->kind[i] = FRINGE;
      else
        {
          bool rim = (left && differ (r, p[-1], *p)) || (right && differ (r, p[1], *p)) ||
                     (above && differ (r, p[-(ptrdiff_t) width], *p)) || (below && differ (r, p[width], *p));

          r->kind[i] = rim ? HONEST : CORE;
        }
    }
}

static void
count_honest (Reading *r)
{
  for (size_t i = 0; i < r->pixels; i++)
    {
      r->colour[r->id[i]].honest += r->kind[i] != FRINGE;
      r->colour[r->id[i]].core += r->kind[i] == CORE;
    }
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

  return k == 0 || (k != CELD_NO_CLUSTER && r->cluster[k].is_label) ? k : UNDECIDED;
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
  int        least = r->paper ? celd_colour_distance (c, r->colour[r->paper].channel) : INT_MAX;
  uint32_t   found = 0;

  for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < r->height; v++)
    for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < r->width; u++)
      {
        uint32_t label = r->label[(size_t) v * (size_t) r->width + (size_t) u];
        int      d;

        if (!label || label >= QUEUED)
          continue;
        d = celd_colour_distance (c, r->cluster[label].channel);
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
  size_t     undecided = 0, ring = 0, end = 0, decided;
  uint32_t  *queue, *taken;
  CeldStatus status = CELD_NO_MEMORY;

  for (size_t i = 0; i < r->pixels; i++)
    undecided += r->label[i] == UNDECIDED;
  queue = celd_alloc (undecided, sizeof *queue);
  taken = celd_alloc (undecided, sizeof *taken);
  if (!queue || !taken)
    goto done;

  for (size_t i = 0; i < r->pixels; i++)
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

/* ------------------------------------------------------------------ lines too thin to have a colour of their own */

/* Paint, unlike paper, that no label took. */
static bool
is_lost (const Reading *r, size_t i)
{
  return (r->label[i] == 0 || r->label[i] == UNDECIDED) && r->id[i] && r->id[i] != r->paper &&
         celd_colour_distance (r->colour[r->id[i]].channel, r->colour[r->paper].channel) > STRONG * STRONG;
}

/* Gathers the lost pixels connected to pixel i, marks them QUEUED, and finds the strongest colour among them, 0 if a
 * label touches them: then they are what is left of its rim. */
static size_t
gather_line (Reading *r, uint32_t i, uint32_t *line, uint32_t *strongest)
{
  const int *paper = r->colour[r->paper].channel;
  size_t     n = 0;
  bool       rim = false;

  *strongest = r->id[i];
  r->label[i] = QUEUED;
  line[n++] = i;
  for (size_t k = 0; k < n; k++)
    {
      int x = (int) (line[k] % (size_t) r->width), y = (int) (line[k] / (size_t) r->width);

      if (celd_colour_distance (r->colour[r->id[line[k]]].channel, paper) >
          celd_colour_distance (r->colour[*strongest].channel, paper))
        *strongest = r->id[line[k]];
      for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < r->height; v++)
        for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < r->width; u++)
          {
            size_t j = (size_t) v * (size_t) r->width + (size_t) u;

            rim = rim || (r->label[j] && r->label[j] < QUEUED);
            if (!is_lost (r, j))
              continue;
            r->label[j] = QUEUED;
            line[n++] = (uint32_t) j;
          }
    }
  if (rim)
    *strongest = 0;
  return n;
}

/* Is the lost line broader than THIN round a pixel?  Then what is strongest there is hardly thinned by paper. */
static bool
is_broad (const Reading *r, uint32_t i)
{
  int x = (int) (i % (size_t) r->width), y = (int) (i / (size_t) r->width), reach = THIN / 2 + 1;

  for (int v = y - reach; v <= y + reach; v++)
    for (int u = x - reach; u <= x + reach; u++)
      if (u < 0 || v < 0 || u >= r->width || v >= r->height ||
          r->label[(size_t) v * (size_t) r->width + (size_t) u] != QUEUED)
        return false;
  return true;
}

/* The strongest colour among the pixels where a gathered line is broad; 0 if it is broad nowhere. */
static uint32_t
strongest_of_broad (const Reading *r, const uint32_t *line, size_t n)
{
  const int *paper = r->colour[r->paper].channel;
  uint32_t   strongest = 0;

  for (size_t k = 0; k < n; k++)
    if (is_broad (r, line[k]))
      {
        uint32_t id = r->id[line[k]];

        if (!strongest || celd_colour_distance (r->colour[id].channel, paper) >
                            celd_colour_distance (r->colour[strongest].channel, paper))
          strongest = id;
      }
  return strongest;
}

/* The label whose colour, thinned with paper, comes nearest to the colour given; 0 if none is near. */
static uint32_t
label_of_tint (const Reading *r, uint32_t id)
{
  const int *paper = r->colour[r->paper].channel, *c = r->colour[id].channel;
  uint32_t   found = 0;
  int        least = TINT * TINT;

  for (uint32_t k = 1; k < r->n_clusters; k++)
    {
      double full = 0, share = 0;
      int    tint[3], d;

      if (!r->cluster[k].is_label)
        continue;
      for (int i = 0; i < 3; i++)
        {
          full += (r->cluster[k].channel[i] - paper[i]) * (r->cluster[k].channel[i] - paper[i]);
          share += (r->cluster[k].channel[i] - paper[i]) * (c[i] - paper[i]);
        }
      share = full > 0 ? share / full : 0;
      for (int i = 0; i < 3; i++)
        tint[i] = (int) (paper[i] + share * (r->cluster[k].channel[i] - paper[i]));
      d = celd_colour_distance (tint, c);
      if (share > 0.3 && d < least)
        {
          least = d;
          found = k;
        }
    }
  return found;
}

/* The label of nearly this colour; 0 if there is none. */
static uint32_t
label_of_colour (const Reading *r, uint32_t id)
{
  uint32_t found = 0;
  int      least = TINT * TINT;

  for (uint32_t k = 1; k < r->n_clusters; k++)
    {
      int d = celd_colour_distance (r->cluster[k].channel, r->colour[id].channel);

      if (r->cluster[k].is_label && d < least)
        {
          least = d;
          found = k;
        }
    }
  return found;
}

static CeldStatus
rescue_lines (Reading *r)
{
  size_t     lost = 0;
  uint32_t  *line;
  CeldStatus status = CELD_OK;

  for (size_t i = 0; i < r->pixels; i++)
    lost += is_lost (r, i);
  line = celd_alloc (lost, sizeof *line);
  if (!line)
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < r->pixels && status == CELD_OK; i++)
    {
      uint32_t strongest, broad, k;
      size_t   n;

      if (!is_lost (r, i))
        continue;
      n = gather_line (r, (uint32_t) i, line, &strongest);
      if (!strongest || n < CELD_LEAST_DOT)
        continue;
      broad = strongest_of_broad (r, line, n);
      k = broad ? label_of_colour (r, broad) : label_of_tint (r, strongest);
      if (!k)
        {
          status = celd_scribble_cluster_add (r, broad ? broad : strongest);
          k = (uint32_t) r->n_clusters - 1;
          r->cluster[k].is_label = true;
        }
      for (size_t j = 0; j < n && status == CELD_OK; j++)
        r->label[line[j]] = k;
    }
  celd_free (line);
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
  CeldPart   part;
  CeldRun    begin = celd_run_part (&part, run, 0, 0.5);
  Reading    r = { .paint = scribbles, .width = scribbles->width, .height = scribbles->height };
  CeldStatus status;

  if (!CELD_SAME_SIZE (scribbles, seeds))
    return CELD_BAD_SIZE;
  r.pixels = (size_t) r.width * (size_t) r.height;
  r.id = celd_alloc (r.pixels, sizeof *r.id);
  r.label = celd_alloc (r.pixels, sizeof *r.label);
  r.kind = celd_alloc (r.pixels, 1);
  status = r.id && r.label && r.kind ? celd_scribble_colours (&r, settings->flats, &begin) : CELD_NO_MEMORY;
  if (status != CELD_OK)
    goto done;

  celd_each (run, r.height, judge_row, &r);
  count_honest (&r);
  status = celd_step (run, 0.6);
  if (status == CELD_OK)
    status = celd_scribble_clusters (&r, run);
  if (status == CELD_OK && !settings->flats)
    status = celd_scribble_overlaps (&r);
  if (status != CELD_OK)
    goto done;

  celd_each (run, r.height, place_row, &r);
  status = celd_step (run, 0.8);
  if (status == CELD_OK)
    status = place_rest (&r, run);
  if (status == CELD_OK && r.paper)
    status = rescue_lines (&r);
  if (status == CELD_OK)
    status = deliver (&r, seeds, palette);

done:
  free_reading (&r);
  return status;
}
