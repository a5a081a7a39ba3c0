/* Which colours of a painted layer are labels.
 *
 * The colours with most solid pixels come first; each takes in the colours within the radius of rounding, or of loss.
 * A cluster needs solid pixels of its own; in a lossy picture it needs an inside, too, for there a fringe may look
 * like a pencil line.  Rims and ends of strokes, left in a colour of their own by loss and resampling, are given back
 * to the stroke that they keep touching.
 * Cost: a sort of the colours; clusters are found through cells of colour space, O(1) each.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/vector.h"
#include "input/scribbles.h"

#include <stdlib.h>

#define SATELLITE 40    /* a rim is no farther than this from the colour of its stroke */
#define MANY_CLUSTERS 4096 /* clusters: more than these are a photograph, where nothing has a rim */

typedef struct { uint32_t solid, id; } ClusterCandidate;

static int
by_falling_solid (const void *a, const void *b)
{
  const ClusterCandidate *p = a, *q = b;

  if (p->solid != q->solid)
    return p->solid < q->solid ? 1 : -1;
  return (p->id > q->id) - (p->id < q->id);
}

/* Cells are a radius wide, so that whatever is near lies in one of the 27 cells round about. */
static int
cell_side (const CeldScribbleLayer *r)
{
  return 255 / r->radius + 1;
}

/* The nearest cluster within the radius, CELD_NO_CLUSTER if there is none. */
static uint32_t
nearest_cluster (const CeldScribbleLayer *r, const int *channel)
{
  int      side = cell_side (r), least = r->radius * r->radius + 1;
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
  int        side = cell_side (r);
  size_t     cell = (size_t) ((c[0] / r->radius * side + c[1] / r->radius) * side + c[2] / r->radius);

  if (!celd_reserve_one (r->cluster, r->n_clusters, r->cluster_capacity))
    return CELD_NO_MEMORY;
  r->cluster[r->n_clusters] = (CeldScribbleCluster) { { c[0], c[1], c[2] }, id, CELD_NO_CLUSTER, 0, 0, 0, 0, false };
  if (id) /* transparent is near nothing */
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
      r->cluster[k].pixels = r->cluster[k].solid = r->cluster[k].core = 0;
      r->cluster[k].opacity = 0;
    }
  for (size_t i = 1; i < r->n; i++)
    if (r->colour[i].cluster != CELD_NO_CLUSTER)
      {
        const CeldScribbleColour *c = &r->colour[i];
        CeldScribbleCluster      *k = &r->cluster[c->cluster];

        k->pixels += c->pixels;
        k->solid += c->solid;
        k->core += c->core;
        k->opacity += c->opacity;
      }
}

/* Is an eighth of the cluster inside strokes, as it is not for the rims of strokes? */
static bool
has_core (const CeldScribbleCluster *k)
{
  return k->core >= CELD_LEAST_DOT && 8 * (size_t) k->core >= k->pixels;
}

/* Could cluster k be a part of cluster j, larger than it and of nearly its colour? */
static bool
may_belong (const CeldScribbleLayer *r, uint32_t k, uint32_t j)
{
  const CeldScribbleCluster *c = &r->cluster[k], *l = &r->cluster[j];

  return k && l->colour && (l->pixels > c->pixels || (l->pixels == c->pixels && j < k)) &&
         celd_colour_distance (c->channel, l->channel) <= SATELLITE * SATELLITE;
}

typedef struct { uint32_t of, votes, touch; } Parent;

/* One vote of cluster k for j: what most vote for remains. */
static void
vote (const CeldScribbleLayer *r, Parent *parent, uint32_t k, uint32_t j)
{
  if (!may_belong (r, k, j))
    return;
  if (!parent[k].votes)
    parent[k].of = j;
  parent[k].votes = parent[k].of == j ? parent[k].votes + 1 : parent[k].votes - 1;
}

/* Lets every two pixels of unlike clusters that touch vote for each other's, or counts those that touch a parent. */
static void
visit_touches (const CeldScribbleLayer *r, Parent *parent, bool count)
{
  for (int y = 0; y < r->height; y++)
    for (int x = 0; x < r->width; x++)
      for (int i = 0; i < 2; i++)
        if (x + !i < r->width && y + i < r->height)
          {
            size_t   p = (size_t) y * (size_t) r->width + (size_t) x, q = i ? p + (size_t) r->width : p + 1;
            uint32_t a = r->colour[r->id[p]].cluster, b = r->colour[r->id[q]].cluster;

            if (a == b || a == CELD_NO_CLUSTER || b == CELD_NO_CLUSTER)
              continue;
            if (count)
              {
                parent[a].touch += parent[a].of == b;
                parent[b].touch += parent[b].of == a;
                continue;
              }
            vote (r, parent, a, b);
            vote (r, parent, b, a);
          }
}

/* Is the cluster the tinge that loss leaves on paper? */
static bool
is_tinge (const CeldScribbleLayer *r, const CeldScribbleCluster *c)
{
  return r->paper && celd_colour_distance (c->channel, r->colour[r->paper].channel) <= SATELLITE * SATELLITE;
}

/* The rims and ends of strokes make clusters of their own: a cluster that keeps touching a larger one of nearly its
 * colour is a part of that, unless the picture is clean and the cluster has an inside. */
static CeldStatus
absorb_satellites (CeldScribbleLayer *r)
{
  Parent *parent = celd_alloc0 (r->n_clusters, sizeof *parent);

  if (!parent)
    return CELD_NO_MEMORY;
  for (uint32_t k = 0; k < r->n_clusters; k++)
    parent[k].of = k;
  visit_touches (r, parent, false);
  visit_touches (r, parent, true);
  for (uint32_t k = 1; k < r->n_clusters; k++)
    {
      const CeldScribbleCluster *c = &r->cluster[k];
      bool           touching = parent[k].touch >= CELD_LEAST_DOT && 10 * (size_t) parent[k].touch >= c->pixels;

      if (r->lossy && is_tinge (r, c))
        parent[k].of = 0;
      else if (!touching || (!r->lossy && has_core (c)))
        parent[k].of = k;
    }
  for (size_t i = 1; i < r->n; i++)
    while (r->colour[i].cluster != CELD_NO_CLUSTER && parent[r->colour[i].cluster].of != r->colour[i].cluster)
      r->colour[i].cluster = parent[r->colour[i].cluster].of;
  celd_free (parent);
  return CELD_OK;
}

/* Solid enough to be a label?  The fringes of other strokes may pass through its colour, but have no inside, except
 * for the tails of soft brushes on paper.  In a lossy picture a fringe may pass for a pencil line: there it needs an
 * inside. */
static bool
is_label (const CeldScribbleLayer *r, const CeldScribbleCluster *k)
{
  if (k->solid < CELD_LEAST_DOT || (r->lossy && !has_core (k)))
    return false;
  return 3 * (size_t) k->solid >= k->pixels ||
         (2 * (size_t) k->core >= k->solid && has_core (k) && !is_tinge (r, k));
}

/* Equal to paper: the tail of a soft brush, though it may be nearer to what lies beyond. */
static bool
is_paper (const CeldScribbleLayer *r, const CeldScribbleColour *c)
{
  return r->paper && celd_colour_distance (c->channel, r->colour[r->paper].channel) <= r->radius * r->radius;
}

/* The colours with most solid pixels first; each takes in what lies within the radius. */
CeldStatus
celd_scribble_clusters (CeldScribbleLayer *r, const CeldHost *host)
{
  ClusterCandidate *candidate = celd_alloc (r->n, sizeof *candidate);
  size_t     cells = (size_t) cell_side (r) * (size_t) cell_side (r) * (size_t) cell_side (r), n = 0;
  CeldStatus status = CELD_NO_MEMORY;

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
    tally_clusters (r);
  if (status == CELD_OK && r->n_clusters <= MANY_CLUSTERS)
    {
      status = absorb_satellites (r);
      tally_clusters (r);
    }
  if (status == CELD_OK)
    status = celd_progress (host, 0.7);
  for (size_t k = 1; k < r->n_clusters && status == CELD_OK; k++)
    r->cluster[k].is_label = is_label (r, &r->cluster[k]);

done:
  celd_free (candidate);
  return status;
}

