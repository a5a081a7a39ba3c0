/* Suggestions from a picture of depth that comes from elsewhere, such as a depth estimator's.
 *
 * Such pictures know little of lines, so that a region is one number, the median over its surface, and its spread is
 * the median distance from that (MAD).  The difference of two medians against both spreads gives log-odds; where it is
 * as large as the spreads together, one region is in front with a confidence of one half.  An estimator errs on whole
 * regions, too: nothing that it says is more certain than MOST.
 *
 * Cost: a sort of all pixels by region and depth; 16 bytes a pixel for a while.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "order/suggest.h"

#include <math.h>
#include <stdlib.h>

#define ODDS_OF_ONE 1.0986      /* log-odds of a difference as large as the spreads: log 3 */
#define MOST        2.2         /* log-odds: nine times as likely as not */
#define EVEN        0.01        /* least spread, as a share of the picture's range */

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

/* The surface of all labels: paper, as far as its depth is known. */
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

/* Of n samples of one label, by rising depth; trials them into distances from the median. */
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

/* The least and the largest median. */
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

static double
odds_of (const Summary *a, const Summary *b, double range)
{
  double odds;

  if (!a->n || !b->n || !(range > 0))
    return 0;
  odds = ODDS_OF_ONE * (a->median - b->median) / (a->spread + b->spread + EVEN * range);
  return fmax (-MOST, fmin (MOST, odds));
}

CeldStatus
celd_suggest_from_depth (const CeldLabels *labels, const CeldPalette *palette, const CeldPlane *ink,
                         const CeldPlane *depth, const CeldHost *host, CeldRelations *suggested)
{
  CeldPairCues *pairs = NULL;
  double       *odds = NULL, range;
  size_t        n = 0;
  Sample       *sample;
  Summary      *summary;
  CeldStatus    status;

  if (!CELD_SAME_SIZE (labels, depth) || (ink && !CELD_SAME_SIZE (labels, ink)))
    return CELD_BAD_SIZE;
  sample  = celd_alloc ((size_t) labels->width * (size_t) labels->height, sizeof *sample);
  summary = celd_alloc0 (palette->n + 1, sizeof *summary);
  status  = sample && summary ? celd_cues_gather (labels, palette, ink, host, &pairs, &n) : CELD_NO_MEMORY;
  if (status == CELD_OK && !(odds = celd_alloc (n, sizeof *odds)))
    status = CELD_NO_MEMORY;
  if (status == CELD_OK)
    {
      range = summarize_all (sample, take_samples (labels, palette->n, ink, depth, sample), summary);
      for (size_t i = 0; i < n; i++)
        odds[i] = odds_of (&summary[pairs[i].a], &summary[pairs[i].b], range);
      status = celd_suggestions_add (pairs, odds, n, palette->n, suggested);
    }
  celd_free (sample);
  celd_free (summary);
  celd_free (pairs);
  celd_free (odds);
  return status == CELD_OK ? celd_progress (host, 1) : status;
}
