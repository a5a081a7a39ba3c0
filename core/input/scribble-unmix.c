/* The colours that strokes had before a codec smeared their chroma.
 *
 * What a block holds of a colour, the strokes in it have given: a codec moves chroma about, but keeps its sum.  So the
 * sums of all blocks that a stroke runs through tell how much chroma it had, and its core tells luma and hue.  Where
 * several strokes share blocks, each gets of a sum in proportion to what it is expected to have given, again and again
 * (the multiplicative update of [Richardson72] and [Lucy74]).  Pieces that touch and have nearly one colour are one
 * stroke; scraps belong to the stroke that they touch; strokes of nearly one colour have one label.
 * Cost: O(contacts log contacts + strokes * labels).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/scribble-loss.h"
#include "input/scribbles.h"

#include <math.h>
#include <stdlib.h>

#define ROUNDS 12       /* of unmixing */
#define GAIN 4          /* chroma is not smeared more than this */
#define ALIKE 30        /* pieces as near as this are of one stroke */
#define SCRAP 80        /* pixels: a smaller piece that touches a stroke may be a scrap of it, ... */
#define SCRAP_OFF 130   /* ... the farther off in colour the smaller it is */
#define SAME_COLOUR 24 /* strokes as near as this have one label, ... */
#define SPECK 60        /* ... those of fewer pixels as far off as this, too, in part */
#define MANY 4096       /* strokes that may found a label: the others are specks */

/* ------------------------------------------------------------------ unmixing */

/* One round: what each stroke has in full, from what its blocks hold and what they were expected to. */
static void
unmix_once (CeldLossStrokes *s, double (*given)[3])
{
  for (size_t b = 0; b < s->n_blocks; b++)
    for (int i = 0; i < 3; i++)
      s->block[b].expected[i] = 0;
  for (size_t k = 0; k < s->n; k++)
    for (int i = 0; i < 3; i++)
      {
        s->block[s->piece[k].block].expected[i] += s->piece[k].cover * s->piece[s->piece[k].stroke].full[i];
        given[k][i] = 0;
      }
  for (size_t k = 0; k < s->n; k++)
    for (int i = 0; i < 3; i++)
      {
        const CeldLossBlock *b = &s->block[s->piece[k].block];

        if (b->expected[i] > 0)
          given[s->piece[k].stroke][i] += s->piece[k].cover * fmax (b->sum[i], 0) / b->expected[i];
      }
  for (size_t k = 0; k < s->n; k++)
    for (int i = 0; i < 3; i++)
      if (s->piece[k].stroke == k && s->piece[k].all > 0)
        s->piece[k].full[i] *= given[k][i] / s->piece[k].all;
}

/* Luma and hue are those of the core.  How much stronger chroma is in full, the channels tell that are darker than
 * luma: the smear of others is brighter than paper, where it is clipped. */
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
    gain = fmin (fmax (full / core, 1), GAIN);
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

/* Stroke b becomes a part of stroke a: means by cover. */
static void
unite (CeldLossStrokes *s, uint32_t a, uint32_t b)
{
  CeldLossPiece *p = &s->piece[a], *q = &s->piece[b];
  double all = p->all + q->all, share = all > 0 ? q->all / all : 0.5;

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

/* The likest pieces first; then once more, with scraps, and again for scraps that touched nothing but scraps. */
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
        double   limit = ALIKE + (pass && least < SCRAP ? SCRAP_OFF * (1 - least / SCRAP) : 0);

        if (a != b && distance (&s->piece[a], &s->piece[b]) <= limit)
          unite (s, a, b);
      }
  for (uint32_t k = 0; k < s->n; k++)
    s->piece[k].stroke = stroke_of (s, k);
}

typedef struct { double all; uint32_t stroke; } Candidate;

static int
by_falling_cover (const void *a, const void *b)
{
  const Candidate *p = a, *q = b;

  if (p->all < q->all || p->all > q->all)
    return p->all < q->all ? 1 : -1;
  return (p->stroke > q->stroke) - (p->stroke < q->stroke);
}

/* The largest strokes come first; each joins the nearest label of nearly its colour, or founds one. */
static void
gather_labels (CeldLossStrokes *s, Candidate *candidate, uint32_t *label)
{
  size_t n = 0, n_labels = 0;

  for (uint32_t k = 0; k < s->n; k++)
    if (s->piece[k].stroke == k)
      {
        find_colour (s->r, &s->piece[k]);
        candidate[n++] = (Candidate) { s->piece[k].all, k };
      }
  qsort (candidate, n, sizeof *candidate, by_falling_cover);
  for (size_t i = 0; i < n; i++)
    {
      uint32_t k = candidate[i].stroke, found = k;
      double   small = candidate[i].all < SPECK ? 1 - candidate[i].all / SPECK : 0, least = SAME_COLOUR * (1 + small);

      for (size_t j = 0; j < n_labels; j++)
        if (distance (&s->piece[k], &s->piece[label[j]]) < least)
          {
            found = label[j];
            least = distance (&s->piece[k], &s->piece[found]);
          }
      if (found != k)
        unite (s, found, k);
      else if (i < MANY)
        label[n_labels++] = k;
    }
  for (uint32_t k = 0; k < s->n; k++)
    s->piece[k].stroke = stroke_of (s, k);
}

CeldStatus
celd_scribble_unmix (CeldLossStrokes *s, const CeldHost *host)
{
  double   (*given)[3] = celd_alloc (s->n, sizeof *given);
  Candidate *candidate = celd_alloc (s->n, sizeof *candidate);
  uint32_t  *label = celd_alloc (s->n, sizeof *label);
  CeldStatus status = given && candidate && label ? CELD_OK : CELD_NO_MEMORY;

  if (status != CELD_OK)
    goto done;
  for (uint32_t k = 0; k < s->n; k++)
    {
      CeldLossPiece *p = &s->piece[k];

      p->stroke = k;
      p->all = p->cover;
      for (int i = 0; i < 3; i++)
        p->full[i] = p->core[i];
    }
  unmix_once (s, given);
  for (size_t k = 0; k < s->n; k++)
    find_colour (s->r, &s->piece[k]);
  join_pieces (s);
  for (int i = 0; i < ROUNDS && status == CELD_OK; i++)
    {
      unmix_once (s, given);
      status = celd_progress (host, 0.4 + 0.2 * i / ROUNDS);
    }
  gather_labels (s, candidate, label);

done:
  celd_free (label);
  celd_free (candidate);
  celd_free (given);
  return status;
}
