/* Odds for suggestions from a depth picture that comes from elsewhere, such as a depth estimator.
 *
 * Such pictures are unreliable near lines, so each region is reduced to one number, the median over its surface, with
 * the median absolute deviation (MAD) as its spread.  The difference of two medians relative to the sum of both spreads
 * gives log-odds; where they are equal, one region is in front with a confidence of one half.  An estimator can be
 * wrong about whole regions, so that confidence is limited by MOST_ODDS.
 *
 * Cost: a sort of all pixels by region and depth; 16 bytes a pixel of work space.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "order/order.h"

#include <math.h>
#include <stdlib.h>

#define ODDS_PER_SPREAD 1.0986  /* log-odds of a difference as large as both spreads: log 3, a confidence of 1/2 */
#define MOST_ODDS       2.2     /* log-odds, about log 9; chosen */
#define LEAST_SPREAD    0.01    /* of both regions together, as a fraction of the range of medians; chosen */

typedef struct { uint32_t label; float depth; } Sample;
typedef struct { double median, spread; size_t n; } Summary;

static int
compare_samples (const void *one, const void *two)
{
  const Sample *a = one, *b = two;

  if (a->label != b->label)
    return a->label < b->label ? -1 : 1;
  return (a->depth > b->depth) - (a->depth < b->depth);
}

/* The pixels of paper with a label and a finite depth; returns their number. */
static size_t
take_samples (const CeldLabels *labels, size_t n_labels, const CeldPlane *ink, const CeldPlane *depth, Sample *sample)
{
  size_t n = 0;

  for (int y = 0; y < labels->height; y++)
    for (int x = 0; x < labels->width; x++)
      {
        uint32_t label = CELD_AT (labels, x, y);
        float    d = CELD_AT (depth, x, y);

        if (label && label <= n_labels && isfinite (d) && (!ink || celd_is_paper (CELD_AT (ink, x, y))))
          sample[n++] = (Sample) { label, d };
      }
  return n;
}

/* Median and spread of n samples of one label, sorted by depth.  Overwrites the depths. */
static Summary
summarize (Sample *sample, size_t n)
{
  Summary s = { .median = (double) sample[n / 2].depth, .n = n };

  for (size_t i = 0; i < n; i++)
    sample[i].depth = (float) fabs ((double) sample[i].depth - s.median);
  qsort (sample, n, sizeof *sample, compare_samples);
  s.spread = (double) sample[n / 2].depth;
  return s;
}

/* Fills summary[label] for all labels that have samples; returns the range of their medians. */
static double
summarize_all (Sample *sample, size_t n, Summary *summary)
{
  double least = INFINITY, most = -INFINITY;

  qsort (sample, n, sizeof *sample, compare_samples);
  for (size_t i = 0, end; i < n; i = end)
    {
      Summary *s = &summary[sample[i].label];

      for (end = i; end < n && sample[end].label == sample[i].label;)
        end++;
      *s    = summarize (sample + i, end - i);
      least = fmin (least, s->median);
      most  = fmax (most, s->median);
    }
  return most - least;
}

/* Log-odds of a being in front of b; 0 if a depth is unknown. */
static double
odds_of (const Summary *a, const Summary *b, double range)
{
  double odds;

  if (!a->n || !b->n || !(range > 0))
    return 0;
  odds = ODDS_PER_SPREAD * (a->median - b->median) / (a->spread + b->spread + LEAST_SPREAD * range);
  return fmax (-MOST_ODDS, fmin (MOST_ODDS, odds));
}

CeldStatus
celd_depth_odds (const CeldLabels *labels, const CeldPalette *palette, const CeldPlane *ink, const CeldPlane *depth,
                 const CeldPairCues *pairs, size_t n, double *odds)
{
  Sample  *sample = celd_alloc ((size_t) labels->width * (size_t) labels->height, sizeof *sample);
  Summary *summary = celd_alloc0 (palette->n + 1, sizeof *summary);

  if (sample && summary)
    {
      double range = summarize_all (sample, take_samples (labels, palette->n, ink, depth, sample), summary);

      for (size_t i = 0; i < n; i++)
        odds[i] = odds_of (&summary[pairs[i].a], &summary[pairs[i].b], range);
    }
  celd_free (sample);
  celd_free (summary);
  return sample && summary ? CELD_OK : CELD_NO_MEMORY;
}
