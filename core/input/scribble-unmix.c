/* The colours that strokes had before a codec smeared their chroma.
 *
 * A codec smears chroma within a block, but keeps its sum.  The sums over all blocks of a stroke therefore give the
 * amount of chroma that it had, and its core gives luma and hue.  Where strokes share blocks, each sum is divided among
 * them in proportion to what they are expected to contribute, iteratively (the multiplicative update of [Richardson72]
 * and [Lucy74]).  Pieces that touch and have nearly the same colour are one stroke; small fragments are joined to the
 * stroke that they touch; strokes of nearly the same colour have one label.
 *
 * Cost: O(contacts log contacts + strokes * labels).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/input.h"

#include <math.h>
#include <stdlib.h>

/* Distances of colours are in steps of 1/255; all chosen. */
#define UNMIX_ROUNDS      12    /* iterations */
#define MOST_GAIN         4     /* factor by which smear has reduced chroma, at most */
#define PIECE_DISTANCE    30    /* of colours of pieces of one stroke, at most */
#define FRAGMENT_PIXELS   80    /* smaller pieces may be fragments of a stroke that they touch, ... */
#define FRAGMENT_DISTANCE 130   /* ... with this additional distance for an empty one, less for a larger one */
#define LABEL_DISTANCE    24    /* of colours of one label, at most; up to twice as much ... */
#define SMALL_STROKE      60    /* ... for strokes of fewer pixels, by their number */
#define MOST_STARTERS     4096  /* strokes, from the largest on, that may start a label */

/* ------------------------------------------------------------------ unmixing */

/* One iteration: scales `full` of each stroke by what its blocks have, relative to what they were expected to have. */
static void
unmix_once (CeldLossStrokes *s, double (*received)[3])
{
  for (size_t b = 0; b < s->n_blocks; b++)
    for (int i = 0; i < 3; i++)
      s->block[b].expected[i] = 0;
  for (size_t k = 0; k < s->n; k++)
    for (int i = 0; i < 3; i++)
      {
        s->block[s->piece[k].block].expected[i] += s->piece[k].coverage * s->piece[s->piece[k].stroke].full[i];
        received[k][i] = 0;
      }
  for (size_t k = 0; k < s->n; k++)
    for (int i = 0; i < 3; i++)
      {
        const CeldLossBlock *b = &s->block[s->piece[k].block];

        if (b->expected[i] > 0)
          received[s->piece[k].stroke][i] += s->piece[k].coverage * fmax (b->sum[i], 0) / b->expected[i];
      }
  for (size_t k = 0; k < s->n; k++)
    for (int i = 0; i < 3; i++)
      if (s->piece[k].stroke == k && s->piece[k].all > 0)
        s->piece[k].full[i] *= received[k][i] / s->piece[k].all;
}

/* Sets the colour of a stroke: luma and hue of its core, with chroma scaled by a gain.  The gain comes from channels
 * darker than luma, because the smear of the others is brighter than paper and so was clipped. */
static void
find_colour (const CeldScribbleLayer *r, CeldLossPiece *p)
{
  const int *paper = r->colour[r->paper].channel;
  double     core = 0, full = 0, gain = 1;
  bool       darker[3];

  for (int i = 0; i < 3; i++)
    {
      darker[i] = p->core[i] > p->luma && p->full[i] > p->luma;
      core += darker[i] ? p->core[i] - p->luma : 0;
      full += darker[i] ? p->full[i] - p->luma : 0;
    }
  if (core > 3)
    gain = fmin (fmax (full / core, 1), MOST_GAIN);
  for (int i = 0; i < 3; i++)
    {
      double d = core > 3 && darker[i] ? p->full[i] : p->luma + gain * (p->core[i] - p->luma);

      p->colour[i] = fmin (fmax (d, paper[i] - 255), paper[i]);
    }
}

/* ------------------------------------------------------------------ strokes and labels */

static double
distance (const CeldLossPiece *p, const CeldLossPiece *q)
{
  double d = 0;

  for (int i = 0; i < 3; i++)
    d += (p->colour[i] - q->colour[i]) * (p->colour[i] - q->colour[i]);
  return sqrt (d);
}

static uint32_t
stroke_of (CeldLossStrokes *s, uint32_t k)
{
  while (s->piece[k].stroke != k)
    k = s->piece[k].stroke = s->piece[s->piece[k].stroke].stroke;
  return k;
}

/* Makes stroke b a part of stroke a: colours become means weighted by coverage. */
static void
unite (CeldLossStrokes *s, uint32_t a, uint32_t b)
{
  CeldLossPiece *p = &s->piece[a], *q = &s->piece[b];
  double         all = p->all + q->all, share = all > 0 ? q->all / all : 0.5;

  for (int i = 0; i < 3; i++)
    {
      p->core[i] += share * (q->core[i] - p->core[i]);
      p->full[i] += share * (q->full[i] - p->full[i]);
      p->colour[i] += share * (q->colour[i] - p->colour[i]);
    }
  p->luma = celd_deficit_luma (p->core);
  p->all = all;
  q->stroke = a;
}

static int
by_distance (const void *a, const void *b)
{
  const CeldLossContact *p = a, *q = b;

  if (p->distance < q->distance || p->distance > q->distance)
    return p->distance > q->distance ? 1 : -1;
  if (p->a != q->a)
    return p->a > q->a ? 1 : -1;
  return (p->b > q->b) - (p->b < q->b);
}

/* Joins pieces that touch, the most similar first; in a second pass fragments, too, and in a third fragments that
 * touched only fragments. */
static void
join_pieces (CeldLossStrokes *s)
{
  for (size_t i = 0; i < s->n_contacts; i++)
    s->contact[i].distance = (float) distance (&s->piece[s->contact[i].a], &s->piece[s->contact[i].b]);
  qsort (s->contact, s->n_contacts, sizeof *s->contact, by_distance);
  for (int pass = 0; pass < 3; pass++)
    for (size_t i = 0; i < s->n_contacts; i++)
      {
        uint32_t a = stroke_of (s, s->contact[i].a), b = stroke_of (s, s->contact[i].b);
        double   least = fmin (s->piece[a].all, s->piece[b].all);
        double   limit = PIECE_DISTANCE +
                          (pass && least < FRAGMENT_PIXELS ? FRAGMENT_DISTANCE * (1 - least / FRAGMENT_PIXELS) : 0);

        if (a != b && distance (&s->piece[a], &s->piece[b]) <= limit)
          unite (s, a, b);
      }
  for (uint32_t k = 0; k < s->n; k++)
    s->piece[k].stroke = stroke_of (s, k);
}

typedef struct { double all; uint32_t stroke; } LabelCandidate;

static int
by_falling_coverage (const void *a, const void *b)
{
  const LabelCandidate *p = a, *q = b;

  if (p->all < q->all || p->all > q->all)
    return p->all < q->all ? 1 : -1;
  return (p->stroke > q->stroke) - (p->stroke < q->stroke);
}

/* Assigns strokes to labels, the largest first: each joins the nearest label of nearly its colour, or starts one. */
static void
gather_labels (CeldLossStrokes *s, LabelCandidate *candidate, uint32_t *label)
{
  size_t n = 0, n_labels = 0;

  for (uint32_t k = 0; k < s->n; k++)
    if (s->piece[k].stroke == k)
      {
        find_colour (s->r, &s->piece[k]);
        candidate[n++] = (LabelCandidate) { s->piece[k].all, k };
      }
  qsort (candidate, n, sizeof *candidate, by_falling_coverage);
  for (size_t i = 0; i < n; i++)
    {
      uint32_t k = candidate[i].stroke, found = k;
      double   small = candidate[i].all < SMALL_STROKE ? 1 - candidate[i].all / SMALL_STROKE : 0;
      double   least = LABEL_DISTANCE * (1 + small);

      for (size_t j = 0; j < n_labels; j++)
        if (distance (&s->piece[k], &s->piece[label[j]]) < least)
          {
            found = label[j];
            least = distance (&s->piece[k], &s->piece[found]);
          }
      if (found != k)
        unite (s, found, k);
      else if (i < MOST_STARTERS)
        label[n_labels++] = k;
    }
  for (uint32_t k = 0; k < s->n; k++)
    s->piece[k].stroke = stroke_of (s, k);
}

CeldStatus
celd_scribble_unmix (CeldLossStrokes *s, const CeldHost *host)
{
  double          (*received)[3] = celd_alloc (s->n, sizeof *received);
  LabelCandidate *candidate = celd_alloc (s->n, sizeof *candidate);
  uint32_t       *label = celd_alloc (s->n, sizeof *label);
  CeldStatus      status = received && candidate && label ? CELD_OK : CELD_NO_MEMORY;

  if (status != CELD_OK)
    goto done;
  for (uint32_t k = 0; k < s->n; k++)
    {
      CeldLossPiece *p = &s->piece[k];

      p->stroke = k;
      p->all = p->coverage;
      for (int i = 0; i < 3; i++)
        p->full[i] = p->core[i];
    }
  unmix_once (s, received);
  for (size_t k = 0; k < s->n; k++)
    find_colour (s->r, &s->piece[k]);
  join_pieces (s);
  for (int i = 0; i < UNMIX_ROUNDS && status == CELD_OK; i++)
    {
      unmix_once (s, received);
      status = celd_progress (host, 0.4 + 0.2 * i / UNMIX_ROUNDS);
    }
  gather_labels (s, candidate, label);

done:
  celd_free (label);
  celd_free (candidate);
  celd_free (received);
  return status;
}
