/* Labels of a painted layer that are only the overlap of two translucent strokes.
 *
 * Their mixture is a flat colour, but no label.  On a transparent layer it lies between the two colours and is more
 * opaque than either.  On opaque paper P a stroke of opacity a shows
 * A' = P + a (A - P); painted over B' it shows a A + (1 - a) B' = A' + (1 - a) (B' - P).  A colour like this that
 * touches both strokes, and them more than anything else, is taken for their mixture.
 *
 * Cost: O(pixels + labels^2).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/input.h"

#define OVERLAP_DISTANCE 3    /* pixels, across which strokes touch in spite of an antialiased rim; chosen */
#define OVERLAP_ERROR    6    /* of 255, from the colour of an overlap to the expected one, at most; chosen */
#define MANY_LABELS      1024 /* overlaps of more labels are not looked for; chosen */

/* The label at a pixel, counted from 1; 0 for anything else. */
static uint32_t
label_at (const CeldScribbleLayer *r, const uint32_t *number, size_t i)
{
  uint32_t k = r->colour[r->id[i]].cluster;

  return k == CELD_NO_CLUSTER ? 0 : number[k];
}

/* touch[a * n + b]: how often labels a and b face each other across OVERLAP_DISTANCE pixels. */
static void
count_touches (const CeldScribbleLayer *r, const uint32_t *number, uint32_t *touch, size_t n)
{
  for (int y = 0; y < r->height; y++)
    for (int x = 0; x < r->width; x++)
      for (int i = 0; i < 2; i++)
        if (x + (i ? 0 : OVERLAP_DISTANCE) < r->width && y + (i ? OVERLAP_DISTANCE : 0) < r->height)
          {
            size_t   p = (size_t) y * (size_t) r->width + (size_t) x;
            size_t   q = p + (i ? OVERLAP_DISTANCE * (size_t) r->width : OVERLAP_DISTANCE);
            uint32_t a = label_at (r, number, p), b = label_at (r, number, q);

            touch[a * n + b] += a != b;
            touch[b * n + a] += a != b;
          }
}

/* Is  c = from + s (to - origin)  for some s in (0.04,0.96)? */
static bool
is_mixture (const int *c, const int *from, const int *to, const int *origin)
{
  double along = 0, length = 0, share;
  int    wanted[3];

  for (int i = 0; i < 3; i++)
    {
      along += (c[i] - from[i]) * (to[i] - origin[i]);
      length += (to[i] - origin[i]) * (to[i] - origin[i]);
    }
  share = length > 0 ? along / length : 0;
  for (int i = 0; i < 3; i++)
    wanted[i] = (int) (from[i] + share * (to[i] - origin[i]) + 0.5);
  return share > 0.04 && share < 0.96 && celd_colour_distance (c, wanted) <= OVERLAP_ERROR * OVERLAP_ERROR;
}

static double
mean_opacity (const CeldScribbleCluster *c)
{
  return (double) c->opacity / c->pixels;
}

/* Is c the mixture of a over b, or of b over a? */
static bool
is_overlap (const CeldScribbleLayer *r, const CeldScribbleCluster *c, const CeldScribbleCluster *a,
            const CeldScribbleCluster *b)
{
  const int *paper = r->colour[r->paper].channel;

  if (r->paper)
    return is_mixture (c->channel, a->channel, b->channel, paper) ||
           is_mixture (c->channel, b->channel, a->channel, paper);
  return mean_opacity (a) < 250 && mean_opacity (c) > mean_opacity (a) + 4 && mean_opacity (c) > mean_opacity (b) + 4 &&
         is_mixture (c->channel, a->channel, b->channel, a->channel);
}

/* The two labels that label k touches most, if it touches them more than all else together; else 0. */
static void
find_partners (const uint32_t *touch, size_t n, size_t k, size_t *first, size_t *second)
{
  size_t all = touch[k * n];

  *first = *second = 0;
  for (size_t j = 1; j < n; j++)
    {
      all += touch[k * n + j];
      if (touch[k * n + j] >= CELD_LEAST_DOT && (!*first || touch[k * n + j] > touch[k * n + *first]))
        {
          *second = *first;
          *first = j;
        }
      else if (touch[k * n + j] >= CELD_LEAST_DOT && (!*second || touch[k * n + j] > touch[k * n + *second]))
        *second = j;
    }
  if (2 * ((size_t) touch[k * n + *first] + touch[k * n + *second]) <= all)
    *first = *second = 0;
}

CeldStatus
celd_scribble_overlaps (CeldScribbleLayer *r)
{
  uint32_t  *number = celd_alloc0 (r->n_clusters, sizeof *number), *touch = NULL;
  size_t    *cluster = celd_alloc0 (r->n_clusters + 1, sizeof *cluster), n = 1;
  CeldStatus status = CELD_NO_MEMORY;

  if (!number || !cluster)
    goto done;
  for (size_t k = 1; k < r->n_clusters; k++)
    if (r->cluster[k].is_label)
      {
        cluster[n] = k;
        number[k] = (uint32_t) n++;
      }
  status = CELD_OK;
  if (n <= 3 || n > MANY_LABELS)
    goto done;
  touch = celd_alloc0 (n * n, sizeof *touch);
  if (!touch)
    {
      status = CELD_NO_MEMORY;
      goto done;
    }
  count_touches (r, number, touch, n);
  for (size_t k = 1; k < n; k++)
    {
      size_t a, b;

      find_partners (touch, n, k, &a, &b);
      if (b && is_overlap (r, &r->cluster[cluster[k]], &r->cluster[cluster[a]], &r->cluster[cluster[b]]))
        r->cluster[cluster[k]].is_label = false;
    }

done:
  celd_free (touch);
  celd_free (cluster);
  celd_free (number);
  return status;
}
