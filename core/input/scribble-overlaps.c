/* Labels of a painted layer that are only mixtures of two strokes, where these cross or touch.
 *
 * On opaque paper P a stroke of opacity a shows A = P + a (A0 - P); painted over B it shows A + (1 - a) (B - P).  So
 * the deficits of mixtures, colours less that of paper, are those of both strokes times factors up to 1.  On a
 * transparent layer a mixture lies between both colours.  Where the mixture is flat, both strokes are translucent, and
 * it is stronger than either: the factors add up to more than 1, or it is more opaque.  Soft brushes also leave all
 * steps from one stroke to the other and to paper; none of these is flat, or it is by chance, because such strokes are
 * less opaque in places.  Where a stroke on paper crosses itself, or another of its colour, it shows its own deficit
 * times 2 - a.
 *
 * A pixel is taken for a mixture if a stroke that it may be mixed of is seen from it, across its own colour no farther
 * than this is wide there, and a few pixels of other paint beyond; and the other stroke from any pixel of this colour,
 * as it may be seen from the ends only where the strokes lie along each other.  Instead it may see on two opposite
 * sides the one that crosses itself.
 *
 * Cost: O(pixels), and rays in eight directions from some hundred pixels of each label, twice.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/input.h"

#include <math.h>

#define SEARCHED      32   /* pixels of other paint beyond its own colour that are searched for strokes; chosen */
#define MIXING_ERROR  6    /* of 255, from the colour of a mixture to the expected one, at most; chosen */
#define ONE_STEP      3    /* squared distance of flat colours, at most: one step in each channel */
#define SMALLEST_PART 0.04 /* of a stroke in a mixture; chosen */
#define MOST_SEEN     12   /* labels seen from a pixel; more are not looked at */
#define BROADEST      64   /* pixels, of mixtures that are looked for; chosen */
#define LOOKED_AT     512  /* pixels of a label that are looked at, nearly; chosen */
#define MIXED_SHARE   0.6  /* of these, at least, are mixtures if the label is none; chosen */

/* Labels that are seen. */
typedef struct
{
  uint32_t label[MOST_SEEN];
  size_t   n;
} SeenLabels;

/* What is known of a cluster: its pixels that are no fringe, how many of these were looked at, how many of those are
 * mixtures, and what is seen from any of them. */
typedef struct
{
  uint32_t   solid, looked_at, mixed;
  SeenLabels seen;
} MixtureSample;

static void
add_seen (SeenLabels *seen, uint32_t label)
{
  for (size_t i = 0; i < seen->n; i++)
    if (seen->label[i] == label)
      return;
  if (seen->n < MOST_SEEN)
    seen->label[seen->n++] = label;
}

/* The cluster at a pixel; 0 for transparent, paper and colours without a cluster. */
static uint32_t
cluster_at (const CeldScribbleLayer *r, size_t i)
{
  uint32_t k = r->colour[r->id[i]].cluster;

  return k == CELD_NO_CLUSTER ? 0 : k;
}

static double
mean_opacity (const CeldScribbleCluster *c)
{
  return (double) c->opacity / c->pixels;
}

/* On paper: is the deficit of c that of a and b times factors up to 1, and if it is flat, of a sum above 1? */
static bool
is_mixed_on_paper (const int *paper, const int *c, const int *a, const int *b, bool flat)
{
  double aa = 0, ab = 0, bb = 0, ac = 0, bc = 0, error2 = 0, s, t, determinant;

  for (int i = 0; i < 3; i++)
    {
      double u = a[i] - paper[i], v = b[i] - paper[i], w = c[i] - paper[i];

      aa += u * u;
      ab += u * v;
      bb += v * v;
      ac += u * w;
      bc += v * w;
    }
  determinant = aa * bb - ab * ab;
  if (determinant <= 0.01 * aa * bb)
    return false;
  s = (ac * bb - bc * ab) / determinant;
  t = (bc * aa - ac * ab) / determinant;
  if (s < SMALLEST_PART || t < SMALLEST_PART || s > 1 + SMALLEST_PART || t > 1 + SMALLEST_PART ||
      (flat && s + t < 1 + SMALLEST_PART))
    return false;
  for (int i = 0; i < 3; i++)
    {
      double e = c[i] - paper[i] - s * (a[i] - paper[i]) - t * (b[i] - paper[i]);

      error2 += e * e;
    }
  return error2 <= MIXING_ERROR * MIXING_ERROR;
}

/* On paper: does a stroke that shows a on paper show c where it crosses itself?  Its paint has the deficit of a divided
 * by its opacity, at most that of black. */
static bool
is_repeated_on_paper (const int *paper, const int *c, const int *a)
{
  double aa = 0, ac = 0, cc = 0, s;

  for (int i = 0; i < 3; i++)
    {
      double u = a[i] - paper[i], w = c[i] - paper[i];

      aa += u * u;
      ac += u * w;
      cc += w * w;
    }
  s = aa > 0 ? ac / aa : 0;
  if (s < 1 + SMALLEST_PART || s > 2 - SMALLEST_PART || cc - s * ac > MIXING_ERROR * MIXING_ERROR)
    return false;
  for (int i = 0; i < 3; i++)
    if (paper[i] - a[i] > (2 - s) * paper[i] + MIXING_ERROR)
      return false;
  return true;
}

/* On a transparent layer: does c lie between a and b? */
static bool
is_between (const int *c, const int *a, const int *b)
{
  double along = 0, length2 = celd_colour_distance (a, b), share;

  for (int i = 0; i < 3; i++)
    along += (c[i] - a[i]) * (b[i] - a[i]);
  share = length2 > 0 ? along / length2 : 0;
  return share > SMALLEST_PART && share < 1 - SMALLEST_PART &&
         celd_colour_distance (c, a) - along * share <= MIXING_ERROR * MIXING_ERROR;
}

/* May colour `id`, of cluster k, be mixed of the clusters a and b? */
static bool
is_mixture (const CeldScribbleLayer *r, uint32_t id, uint32_t k, uint32_t a, uint32_t b, bool flat)
{
  const CeldScribbleCluster *of = &r->cluster[a], *and = &r->cluster[b];
  const int                 *c = r->colour[id].channel;

  flat = flat && !r->colour[of->colour].is_soft && !r->colour[and->colour].is_soft;
  if (r->paper)
    return is_mixed_on_paper (r->colour[r->paper].channel, c, of->channel, and->channel, flat);
  return is_between (c, of->channel, and->channel) &&
         (!flat || mean_opacity (&r->cluster[k]) > fmax (mean_opacity (of), mean_opacity (and)) + 4);
}

/* Opposite directions are neighbours in the list. */
static const int direction[8][2] = { { 1, 0 }, { -1, 0 }, { 0, 1 }, { 0, -1 }, { 1, 1 }, { -1, -1 }, { 1, -1 },
                                     { -1, 1 } };

/* The pixel `steps` away in a direction; SIZE_MAX outside the layer. */
static size_t
pixel_at (const CeldScribbleLayer *r, int x, int y, int d, int steps)
{
  x += steps * direction[d][0];
  y += steps * direction[d][1];
  return x < 0 || y < 0 || x >= r->width || y >= r->height ? SIZE_MAX : (size_t) y * (size_t) r->width + (size_t) x;
}

/* How many pixels of cluster k are beside (x,y) in a direction, `most` at most. */
static int
reach (const CeldScribbleLayer *r, int x, int y, uint32_t k, int d, int most)
{
  int    n = 0;
  size_t at;

  while (n < most && (at = pixel_at (r, x, y, d, n + 1)) != SIZE_MAX && cluster_at (r, at) == k)
    n++;
  return n;
}

/* Adds the labels but `of` that are seen in a direction, beyond `own` pixels of that, up to the end of the paint. */
static void
look (const CeldScribbleLayer *r, int x, int y, int d, int own, uint32_t of, SeenLabels *seen)
{
  for (int i = own + 1; i <= own + SEARCHED; i++)
    {
      size_t   at = pixel_at (r, x, y, d, i);
      uint32_t k;

      if (at == SIZE_MAX || !r->id[at] || !r->colour[r->id[at]].cluster)
        break;
      k = cluster_at (r, at);
      if (k != of && r->cluster[k].is_label && r->kind[at] != CELD_FRINGE)
        add_seen (seen, k);
    }
}

/* Has the pixel the colour of three neighbours?  Between soft strokes only those along a step have it. */
static bool
is_flat (const CeldScribbleLayer *r, int x, int y)
{
  const int *c = r->colour[r->id[(size_t) y * (size_t) r->width + (size_t) x]].channel;
  int        most2 = r->lossy ? r->radius * r->radius / 4 : ONE_STEP, same = 0;

  for (int d = 0; d < 8; d++)
    {
      size_t at = pixel_at (r, x, y, d, 1);

      same += at != SIZE_MAX && r->id[at] && celd_colour_distance (r->colour[r->id[at]].channel, c) <= most2;
    }
  return same >= 3;
}

/* How many pixels of cluster k are beside (x,y) in each direction; returns twice the width of k there. */
static int
measure_reach (const CeldScribbleLayer *r, int x, int y, uint32_t k, int *own)
{
  int width = BROADEST;

  for (int d = 0; d < 8; d += 2)
    {
      int chord;

      own[d] = reach (r, x, y, k, d, 2 * width + 1);
      own[d + 1] = reach (r, x, y, k, d + 1, 2 * width + 1);
      chord = own[d] + own[d + 1] + 1;
      width = chord < width ? chord : width;
    }
  return 2 * width;
}

/* What is seen from the pixel (x,y) of cluster k, past its own pixels, own[] of them, `farthest` at most. */
static SeenLabels
look_around (const CeldScribbleLayer *r, int x, int y, uint32_t k, const int *own, int farthest)
{
  SeenLabels seen = { .n = 0 };

  for (int d = 0; d < 8; d++)
    if (own[d] <= farthest)
      look (r, x, y, d, own[d], k, &seen);
  return seen;
}

/* Is a stroke seen on two opposite sides of the pixel (x,y) of cluster k that shows its colour where it crosses
 * itself? */
static bool
is_repeated (const CeldScribbleLayer *r, int x, int y, uint32_t k, const int *own, int farthest)
{
  const int *paper = r->colour[r->paper].channel;
  const int *c = r->colour[r->id[(size_t) y * (size_t) r->width + (size_t) x]].channel;

  for (int d = 0; d < 8; d += 2)
    {
      SeenLabels one = { .n = 0 }, other = { .n = 0 };

      if (own[d] > farthest || own[d + 1] > farthest)
        continue;
      look (r, x, y, d, own[d], k, &one);
      look (r, x, y, d + 1, own[d + 1], k, &other);
      for (size_t i = 0; i < one.n; i++)
        for (size_t j = 0; j < other.n; j++)
          if (one.label[i] == other.label[j] && is_repeated_on_paper (paper, c, r->cluster[one.label[i]].channel))
            return true;
    }
  return false;
}

/* May the pixel (x,y) of cluster k be mixed of strokes seen from it and from the cluster, or show one twice? */
static bool
is_mixed (const CeldScribbleLayer *r, int x, int y, uint32_t k, const SeenLabels *from_cluster)
{
  uint32_t   id = r->id[(size_t) y * (size_t) r->width + (size_t) x];
  int        own[8], farthest = measure_reach (r, x, y, k, own);
  SeenLabels seen = look_around (r, x, y, k, own, farthest);
  bool       flat;

  if (!seen.n)
    return false;
  flat = is_flat (r, x, y);
  for (size_t i = 0; i < seen.n; i++)
    for (size_t j = 0; j < from_cluster->n; j++)
      if (seen.label[i] != from_cluster->label[j] &&
          is_mixture (r, id, k, seen.label[i], from_cluster->label[j], flat))
        return true;
  return r->paper && flat && is_repeated (r, x, y, k, own, farthest);
}

static size_t
count_labels (const CeldScribbleLayer *r)
{
  size_t n = 0;

  for (size_t k = 1; k < r->n_clusters; k++)
    n += r->cluster[k].is_label;
  return n;
}

/* Notes what is seen from pixels of each label, or, if `judge`, how many of these are mixtures. */
static void
look_at_labels (const CeldScribbleLayer *r, MixtureSample *of, bool judge)
{
  for (size_t k = 1; k < r->n_clusters; k++)
    of[k].solid = of[k].looked_at = of[k].mixed = 0;
  for (int y = 0; y < r->height; y++)
    for (int x = 0; x < r->width; x++)
      {
        size_t   i = (size_t) y * (size_t) r->width + (size_t) x;
        uint32_t k = r->id[i] ? cluster_at (r, i) : 0;

        if (!k || r->kind[i] == CELD_FRINGE || !r->cluster[k].is_label ||
            of[k].solid++ % (1 + r->cluster[k].solid / LOOKED_AT))
          continue;
        of[k].looked_at++;
        if (judge)
          of[k].mixed += is_mixed (r, x, y, k, &of[k].seen);
        else
          {
            int        own[8], farthest = measure_reach (r, x, y, k, own);
            SeenLabels seen = look_around (r, x, y, k, own, farthest);

            for (size_t j = 0; j < seen.n; j++)
              add_seen (&of[k].seen, seen.label[j]);
          }
      }
}

CeldStatus
celd_scribble_overlaps (CeldScribbleLayer *r)
{
  MixtureSample *of; /* of each cluster */

  if (r->hard || count_labels (r) < 2)
    return CELD_OK;
  of = celd_alloc0 (r->n_clusters, sizeof *of);
  if (!of)
    return CELD_NO_MEMORY;
  look_at_labels (r, of, false);
  look_at_labels (r, of, true);
  for (size_t k = 1; k < r->n_clusters; k++)
    if (of[k].looked_at && of[k].mixed >= MIXED_SHARE * of[k].looked_at)
      r->cluster[k].is_label = false;
  celd_free (of);
  return CELD_OK;
}
