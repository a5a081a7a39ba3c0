/* Whether a painted layer was stored with loss (JPEG), and its noise.
 *
 * Neighbouring pixels of one stroke have one colour in an ordinary layer; loss makes them differ by small amounts of
 * either sign.  Broad hard strokes may keep their colours, but then paper beside them has tints that no brush makes:
 * those of a brush are mixtures of paper and its paint.
 *
 * Cost: O(pixels).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/input.h"

#include <math.h>

/* Distances of colours, in steps of 1/255; all chosen but where measured. */
#define CLEAN_RADIUS  3    /* colours are equal in a picture without loss: rounding of premultiplied colours */
#define SOFT_RADIUS   5    /* clean soft strokes on paper have no more; measured: 4, and 5 or more from JPEGs */
#define MOST_NOISE    20   /* larger noise counts as this */
#define LEAST_SINE    0.25 /* of the angle between tints and grey, from which on they show noise */
#define TINT_LEAST    3    /* from paper to a tint of it, ... */
#define TINT_MOST     32   /* ... at most */
#define TINT_OFF      2    /* from the mixtures of paper and paint to a tint that loss made */
#define TINTING_PAINT 64   /* from paper to paint that tints it, at least */
#define TINT_REACH    8    /* pixels from paint to its tints: a block of JPEG */
#define TINTS_SHARE   5    /* one in so many tints is odd in a lossy picture; measured: one in 11 at most with clean soft
                              brushes that cross, one in 4 and more in JPEGs up to quality 95 */
#define LEAST_TINTS   50   /* odd tints: fewer tell nothing */

/* ------------------------------------------------------------------ noise of strokes */

/* How far a pixel is from the mean of its left and right neighbours. */
static double
distance_from_mean (const CeldScribbleLayer *r, const uint32_t *id)
{
  const int *a = r->colour[id[-1]].channel, *b = r->colour[id[1]].channel;
  int        mean[3];

  for (int i = 0; i < 3; i++)
    mean[i] = (a[i] + b[i] + 1) / 2;
  return sqrt (celd_colour_distance (mean, r->colour[id[0]].channel));
}

/* The noise of luma by which a pixel and its left and right neighbours leave the line from paper to the strongest of
 * their colours.  Mixtures of one colour with paper are on this line, whatever the profile of the brush, and noise that
 * is the same in all channels leaves it by the sine of the line's angle with grey. */
static double
noise_off_mixtures (const CeldScribbleLayer *r, const uint32_t *id)
{
  const int *paper = r->colour[r->paper].channel, *strongest = paper;
  double     most = 0, off2 = 0, grey = 0, sine;
  bool       ahead;

  for (int k = -1; k <= 1; k++)
    if (celd_colour_distance (r->colour[id[k]].channel, paper) > most)
      {
        strongest = r->colour[id[k]].channel;
        most      = celd_colour_distance (strongest, paper);
      }
  for (int i = 0; i < 3; i++)
    grey += strongest[i] - paper[i];
  sine = sqrt (fmax (1 - grey * grey / (3 * most), 0));
  for (int k = -1; k <= 1; k++)
    off2 = fmax (off2, celd_distance_to_mixtures (paper, strongest, r->colour[id[k]].channel, &ahead));
  return sine > LEAST_SINE ? sqrt (off2) / sine : MOST_NOISE;
}

/* The noise at a pixel, by its left and right neighbours in the same stroke; negative if they are of other ones. */
static int
noise_at (const CeldScribbleLayer *r, const uint32_t *id)
{
  const int *c = r->colour[id[0]].channel;
  double     noise;

  if (id[-1] == id[0] && id[1] == id[0])
    return 0;
  if (celd_colour_distance (r->colour[id[-1]].channel, c) > CELD_SIMILAR * CELD_SIMILAR ||
      celd_colour_distance (r->colour[id[1]].channel, c) > CELD_SIMILAR * CELD_SIMILAR)
    return -1;
  noise = distance_from_mean (r, id);
  return (int) (r->paper ? fmin (noise, noise_off_mixtures (r, id)) : noise);
}

/* Sets the radius to the noise and a margin.  Noise is the distance of a pixel from the mean of its left and right
 * neighbours, which is not exceeded in nine of ten places where the three are of one stroke; so ramps are no noise, and
 * neither is the middle of a soft stroke on paper. */
static void
measure_noise (CeldScribbleLayer *r)
{
  size_t places[MOST_NOISE + 1] = { 0 }, all = 0, below = 0;
  int    noise = 0;

  for (int y = 0; y < r->height; y++)
    for (int x = 1; x < r->width - 1; x++)
      {
        const uint32_t *id = r->id + (size_t) y * (size_t) r->width + (size_t) x;
        int             d;

        if (!id[-1] || !id[0] || !id[1] || id[0] == r->paper || (d = noise_at (r, id)) < 0)
          continue;
        places[d < MOST_NOISE ? d : MOST_NOISE]++;
        all++;
      }
  while (noise < MOST_NOISE && 10 * (below += places[noise]) < 9 * all)
    noise++;
  r->radius = noise + CLEAN_RADIUS < MOST_NOISE ? noise + CLEAN_RADIUS : MOST_NOISE;
}

/* ------------------------------------------------------------------ tints of paper */

/* The colour farthest from paper within reach of pixel (x,y) in its row and column. */
static uint32_t
paint_near (const CeldScribbleLayer *r, int x, int y)
{
  const int *paper = r->colour[r->paper].channel;
  uint32_t   found = r->paper;
  int        most = 0;

  for (int k = -TINT_REACH; k <= TINT_REACH; k++)
    for (int i = 0; i < 2; i++)
      {
        int      u = i ? x : x + k, v = i ? y + k : y, d;
        uint32_t id;

        if (u < 0 || v < 0 || u >= r->width || v >= r->height)
          continue;
        id = r->id[(size_t) v * (size_t) r->width + (size_t) u];
        d  = celd_colour_distance (r->colour[id].channel, paper);
        if (d > most)
          {
            most  = d;
            found = id;
          }
      }
  return found;
}

/* Does paper have tints that no brush makes? */
static bool
has_odd_tints (const CeldScribbleLayer *r)
{
  const int *paper = r->colour[r->paper].channel;
  size_t     tints = 0, odd = 0;
  bool       ahead;

  for (int y = 0; y < r->height && r->paper; y++)
    for (int x = 0; x < r->width; x++)
      {
        uint32_t   id = r->id[(size_t) y * (size_t) r->width + (size_t) x];
        const int *c = r->colour[id].channel, *paint;
        int        d = id == r->paper ? 0 : celd_colour_distance (c, paper);

        if (d < TINT_LEAST * TINT_LEAST || d > TINT_MOST * TINT_MOST)
          continue;
        paint = r->colour[paint_near (r, x, y)].channel;
        if (celd_colour_distance (paint, paper) < TINTING_PAINT * TINTING_PAINT)
          continue;
        tints++;
        odd += celd_distance_to_mixtures (paper, paint, c, &ahead) >= TINT_OFF * TINT_OFF;
      }
  return odd >= LEAST_TINTS && TINTS_SHARE * odd >= tints;
}

bool
celd_scribble_noise (CeldScribbleLayer *r)
{
  measure_noise (r);
  return r->radius > (r->paper ? SOFT_RADIUS : 2 * CLEAN_RADIUS) || has_odd_tints (r);
}
