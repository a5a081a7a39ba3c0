/* Which colours of a painted layer are labels.
 *
 * Colours are clustered greedily, by falling number of solid pixels; a cluster has the colours within the radius of
 * rounding or of loss.  A cluster is a label if it has enough solid pixels, and in a lossy picture on paper interior
 * pixels as well, because there a fringe may look like a pencil line.  Loss and resampling leave the rims and ends of
 * strokes in clusters of their own, which are merged with the cluster that they touch most.
 *
 * Cost: a sort of the colours, O(1) for each through a grid of cells in colour space.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/input.h"

#include <math.h>
#include <stdlib.h>

#define RIM_DISTANCE     40   /* of 255, from the colour of a rim to that of its stroke, at most; chosen */
#define TINT_SHARE       0.15 /* of the strongest contrast, that loss leaves on paper, at most: ripple; chosen */
#define SIDE_ERROR       3    /* of 255, from the side of a soft stroke to the nearest mixture, at most: rounding */
#define MOST_VARIETY     1.25 /* times the interior pixels of the commonest colour: all of a stroke, at most; chosen */
#define MANY_CLUSTERS    4096 /* more are a photograph, where rims are not looked for; chosen */

typedef struct { uint32_t solid, id; } ClusterCandidate;

static int
by_falling_solid (const void *a, const void *b)
{
  const ClusterCandidate *p = a, *q = b;

  if (p->solid != q->solid)
    return p->solid < q->solid ? 1 : -1;
  return (p->id > q->id) - (p->id < q->id);
}

/* The number of cells along each axis of colour space.  Cells are a radius wide, so that all clusters within the radius
 * of a colour are in the 27 cells around it. */
static int
cells_per_axis (const CeldScribbleLayer *r)
{
  return 255 / r->radius + 1;
}

/* The nearest cluster within the radius; CELD_NO_CLUSTER if there is none. */
static uint32_t
nearest_cluster (const CeldScribbleLayer *r, const int *channel)
{
  int      side = cells_per_axis (r), least = r->radius * r->radius + 1;
  int      low[3], high[3];
  uint32_t found = CELD_NO_CLUSTER;

  for (int i = 0; i < 3; i++)
    {
      low[i] = channel[i] / r->radius > 0 ? channel[i] / r->radius - 1 : 0;
      high[i] = channel[i] / r->radius + 1 < side ? channel[i] / r->radius + 1 : side - 1;
    }
  for (int u = low[0]; u <= high[0]; u++)
    for (int v = low[1]; v <= high[1]; v++)
      for (int w = low[2]; w <= high[2]; w++)
        for (uint32_t k = r->head[(u * side + v) * side + w]; k != CELD_NO_CLUSTER; k = r->cluster[k].next)
          {
            int d = celd_colour_distance (r->cluster[k].channel, channel);

            if (d < least)
              {
                least = d;
                found = k;
              }
          }
  return found;
}

CeldStatus
celd_scribble_cluster_add (CeldScribbleLayer *r, uint32_t id)
{
  const int *c = r->colour[id].channel;
  int        side = cells_per_axis (r);
  size_t     cell = (size_t) ((c[0] / r->radius * side + c[1] / r->radius) * side + c[2] / r->radius);

  if (!celd_reserve_one (r->cluster, r->n_clusters, r->cluster_capacity))
    return CELD_NO_MEMORY;
  r->cluster[r->n_clusters] = (CeldScribbleCluster) { .channel = { c[0], c[1], c[2] }, .colour = id,
                                                      .next = CELD_NO_CLUSTER };
  if (id) /* transparent is near no colour */
    {
      r->cluster[r->n_clusters].next = r->head[cell];
      r->head[cell] = (uint32_t) r->n_clusters;
    }
  r->n_clusters++;
  return CELD_OK;
}

static void
tally_clusters (CeldScribbleLayer *r)
{
  for (size_t k = 0; k < r->n_clusters; k++)
    {
      r->cluster[k].pixels = r->cluster[k].solid = r->cluster[k].interior = r->cluster[k].commonest = 0;
      r->cluster[k].opacity = 0;
    }
  for (size_t i = 1; i < r->n; i++)
    if (r->colour[i].cluster != CELD_NO_CLUSTER)
      {
        const CeldScribbleColour *c = &r->colour[i];
        CeldScribbleCluster      *k = &r->cluster[c->cluster];

        k->pixels += c->pixels;
        k->solid += c->solid;
        k->interior += c->interior;
        k->commonest = c->interior > k->commonest ? c->interior : k->commonest;
        k->opacity += c->opacity;
      }
}

/* Is an eighth of the cluster interior pixels?  Rims of strokes have less. */
static bool
has_interior (const CeldScribbleCluster *k)
{
  return k->interior >= CELD_LEAST_DOT && 8 * (size_t) k->interior >= k->pixels;
}

/* Are four fifths of its interior pixels of exactly one colour?  Those of a stroke are; mixtures vary, and so does what
 * loss makes of the colours of a layer whose alpha is kept, such as WebP's. */
static bool
has_one_colour (const CeldScribbleCluster *k)
{
  return MOST_VARIETY * k->commonest >= k->interior;
}

/* Is cluster j larger than cluster k and of nearly its colour, so that k may be a rim of it?  A rim of paper has no
 * interior pixels: a pale stroke has. */
static bool
may_be_rim (const CeldScribbleLayer *r, uint32_t k, uint32_t j)
{
  const CeldScribbleCluster *c = &r->cluster[k], *l = &r->cluster[j];

  return k && l->colour && (j || !has_interior (c)) &&
         (l->pixels > c->pixels || (l->pixels == c->pixels && j < k)) &&
         celd_colour_distance (c->channel, l->channel) <= RIM_DISTANCE * RIM_DISTANCE;
}

/* Is cluster k cluster j mixed with paper, as the sides of soft strokes are? */
static bool
may_be_side (const CeldScribbleLayer *r, uint32_t k, uint32_t j)
{
  const int *paper = r->colour[r->paper].channel, *c = r->cluster[k].channel, *full = r->cluster[j].channel;
  bool       ahead = false;

  return k && j && celd_colour_distance (c, paper) < celd_colour_distance (full, paper) &&
         celd_colour_distance (c, full) <= RIM_DISTANCE * RIM_DISTANCE &&
         celd_distance_to_mixtures (paper, full, c, &ahead) <= SIDE_ERROR * SIDE_ERROR && ahead;
}

/* What a cluster may be a part of: the candidate of a majority vote, its votes, and how often the two touch. */
typedef struct { uint32_t of, votes, touch; } Parent;

/* May cluster k be a part of cluster j?  No cycles of parts are possible. */
typedef bool (*MayBePart) (const CeldScribbleLayer *r, uint32_t k, uint32_t j);

/* One vote of cluster k for j, by the majority vote of Boyer and Moore. */
static void
vote (const CeldScribbleLayer *r, MayBePart may_be_part, Parent *parent, uint32_t k, uint32_t j)
{
  if (!may_be_part (r, k, j))
    return;
  if (!parent[k].votes)
    parent[k].of = j;
  parent[k].votes = parent[k].of == j ? parent[k].votes + 1 : parent[k].votes - 1;
}

/* For each pair of neighbouring pixels of different clusters: both vote, or, with `count`, contacts with the parent are
 * counted. */
static void
visit_touches (const CeldScribbleLayer *r, MayBePart may_be_part, Parent *parent, bool count)
{
  for (int y = 0; y < r->height; y++)
    for (int x = 0; x < r->width; x++)
      for (int i = 0; i < 2; i++)
        if (x + !i < r->width && y + i < r->height)
          {
            size_t   p = (size_t) y * (size_t) r->width + (size_t) x, q = i ? p + (size_t) r->width : p + 1;
            uint32_t a, b;

            if (r->id[p] == r->id[q])
              continue;
            a = r->colour[r->id[p]].cluster;
            b = r->colour[r->id[q]].cluster;
            if (a == b || a == CELD_NO_CLUSTER || b == CELD_NO_CLUSTER)
              continue;
            if (count)
              {
                parent[a].touch += parent[a].of == b;
                parent[b].touch += parent[b].of == a;
                continue;
              }
            vote (r, may_be_part, parent, a, b);
            vote (r, may_be_part, parent, b, a);
          }
}

/* Is the cluster the tint that loss leaves on paper? */
static bool
is_tint (const CeldScribbleLayer *r, const CeldScribbleCluster *c)
{
  return r->paper && celd_colour_distance (c->channel, r->colour[r->paper].channel) <= r->tint2;
}

/* Finds how strong tints can be, by the strongest colour; all strokes may be pale. */
static void
measure_tints (CeldScribbleLayer *r)
{
  int most2 = 0;

  for (size_t k = 1; k < r->n_clusters; k++)
    {
      int contrast2 = celd_colour_distance (r->cluster[k].channel, r->colour[r->paper].channel);

      if (r->cluster[k].interior >= CELD_LEAST_DOT && contrast2 > most2)
        most2 = contrast2;
    }
  r->tint2 = (int) fmin (TINT_SHARE * TINT_SHARE * most2, RIM_DISTANCE * RIM_DISTANCE);
}

/* Merges clusters with those that they often touch and may be a part of, unless the picture is clean and the cluster
 * has interior pixels of one colour. */
static CeldStatus
merge_parts (CeldScribbleLayer *r, MayBePart may_be_part)
{
  Parent *parent = celd_alloc0 (r->n_clusters, sizeof *parent);

  if (!parent)
    return CELD_NO_MEMORY;
  for (uint32_t k = 0; k < r->n_clusters; k++)
    parent[k].of = k;
  visit_touches (r, may_be_part, parent, false);
  visit_touches (r, may_be_part, parent, true);
  for (uint32_t k = 1; k < r->n_clusters; k++)
    {
      const CeldScribbleCluster *c = &r->cluster[k];
      size_t                     touch = parent[k].touch;

      if (r->lossy && is_tint (r, c))
        parent[k].of = 0;
      else if (touch < CELD_LEAST_DOT || 10 * touch < c->pixels ||
               (!r->lossy && has_interior (c) && has_one_colour (c)))
        parent[k].of = k;
    }
  for (size_t i = 1; i < r->n; i++)
    while (r->colour[i].cluster != CELD_NO_CLUSTER && parent[r->colour[i].cluster].of != r->colour[i].cluster)
      r->colour[i].cluster = parent[r->colour[i].cluster].of;
  celd_free (parent);
  return CELD_OK;
}

/* The cluster at a pixel; 0 for none, and outside the layer. */
static uint32_t
cluster_at (const CeldScribbleLayer *r, int x, int y)
{
  uint32_t k;

  if (x < 0 || y < 0 || x >= r->width || y >= r->height)
    return 0;
  k = r->colour[r->id[(size_t) y * (size_t) r->width + (size_t) x]].cluster;
  return k == CELD_NO_CLUSTER ? 0 : k;
}

/* Finds the clusters that touch no other one. */
static void
find_apart (CeldScribbleLayer *r)
{
  for (size_t k = 1; k < r->n_clusters; k++)
    r->cluster[k].apart = true;
  for (int y = 0; y < r->height; y++)
    for (int x = 0; x < r->width; x++)
      {
        uint32_t k = cluster_at (r, x, y);

        for (int i = 0; i < 4 && k; i++)
          {
            uint32_t other = cluster_at (r, x + (i < 3 ? i - 1 : -1), y + (i < 3));

            if (other && other != k)
              r->cluster[k].apart = r->cluster[other].apart = false;
          }
      }
}

/* Is the cluster a label?  Fringes of other strokes may have its colour, but hardly two thirds of it.  In a lossy
 * picture on paper a fringe may look like a pencil line, so that a label needs interior pixels there.  In pixel art,
 * where a stray pixel would be seen, a dot of one pixel is a label if strokes are hard, or if it touches no other
 * colour, as a fringe would. */
static bool
is_label (const CeldScribbleLayer *r, const CeldScribbleCluster *k)
{
  if (r->pixel_art && !r->lossy && (k->apart || r->hard))
    return true;
  if (k->solid < CELD_LEAST_DOT || (r->lossy && r->paper && !has_interior (k)))
    return false;
  return 3 * (size_t) k->solid >= k->pixels;
}

/* Does the colour equal paper?  It may be nearer to a cluster all the same: the soft end of a brush. */
static bool
is_paper (const CeldScribbleLayer *r, const CeldScribbleColour *c)
{
  return r->paper && celd_colour_distance (c->channel, r->colour[r->paper].channel) <= r->radius * r->radius;
}

CeldStatus
celd_scribble_clusters (CeldScribbleLayer *r, const CeldHost *host)
{
  ClusterCandidate *candidate = celd_alloc (r->n, sizeof *candidate);
  size_t            side = (size_t) cells_per_axis (r), cells = side * side * side, n = 0;
  CeldStatus        status = CELD_NO_MEMORY;

  r->head = celd_alloc (cells, sizeof *r->head);
  if (!candidate || !r->head)
    goto done;
  for (size_t i = 0; i < cells; i++)
    r->head[i] = CELD_NO_CLUSTER;
  for (size_t i = 1; i < r->n; i++)
    if (r->colour[i].solid)
      candidate[n++] = (ClusterCandidate) { r->colour[i].solid, (uint32_t) i };
  qsort (candidate, n, sizeof *candidate, by_falling_solid);

  status = celd_scribble_cluster_add (r, r->paper);
  for (size_t i = 0; i < n && status == CELD_OK; i++)
    if (nearest_cluster (r, r->colour[candidate[i].id].channel) == CELD_NO_CLUSTER)
      status = celd_scribble_cluster_add (r, candidate[i].id);
  for (size_t i = 1; i < r->n && status == CELD_OK; i++)
    r->colour[i].cluster = is_paper (r, &r->colour[i]) ? 0 : nearest_cluster (r, r->colour[i].channel);
  if (status == CELD_OK)
    {
      tally_clusters (r);
      measure_tints (r);
    }
  if (status == CELD_OK && r->n_clusters <= MANY_CLUSTERS)
    {
      if (r->paper && !r->lossy)
        status = merge_parts (r, may_be_side);
      tally_clusters (r);
      if (status == CELD_OK)
        status = merge_parts (r, may_be_rim);
      tally_clusters (r);
    }
  if (status == CELD_OK)
    status = celd_progress (host, 0.7);
  if (status == CELD_OK && r->pixel_art)
    find_apart (r);
  for (size_t k = 1; k < r->n_clusters && status == CELD_OK; k++)
    r->cluster[k].is_label = is_label (r, &r->cluster[k]);

done:
  celd_free (candidate);
  return status;
}
