/* Strokes of soft brushes, and of pens whose pressure changes their opacity, flattened on paper.
 *
 * Such a stroke has all tints of its paint, from the strongest to paper, and they change little from pixel to pixel.
 * It becomes flat, in the strongest colour that is found inside it, because sharp filters make rims stronger: a tint
 * that covers as much as one of a hard stroke would be a label of its own.  Pieces grow from their strongest pixels,
 * as in a watershed, over mixtures of paper and their colour, and become one where a tint joins them that is not much
 * paler than both.  Hard strokes in two tints that touch differ by more than a step, or much of the weaker one has one
 * colour.  What is paler than a third of its stroke is none, as on a transparent layer.  Mixtures of strokes that cross
 * are left to scribble-overlaps.c.
 *
 * Loss moves tints off the mixtures of paper and paint, so that more counts as one in a filtered picture.
 *
 * Cost: O(pixels), and O(strokes^2) of those that are soft; 4 bytes a pixel, and 40 a piece.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/input.h"

#include <math.h>
#include <string.h>

#define ALL_CONTRASTS 442  /* more than the distance of black from white */
#define SOFT_STEP     0.15 /* of the contrast of a stroke, from pixel to pixel in a soft one, at most; chosen */
#define LOSSY_STEP    0.25 /* the same with loss; measured: with less, strokes of changing pressure fall into pieces */
#define SADDLE        0.2  /* of the contrast of the weaker one, where two pieces join, at least; chosen */
#define MIXTURE_ERROR 3    /* of 255, from a tint to the mixtures of paper and paint, at most: rounding */
#define LOSSY_ERROR   8    /* the same with loss; measured: 6 and 10 lose more colours of soft strokes */
#define LOSSY_TINT    4    /* of 255: between what is one tint in a filtered picture, at most; measured as above */
#define FLAT_PAINT    8    /* a stroke has flat paint if more than an eighth is inside one tint; chosen */
#define SAME_PAINT    12   /* of 255: from the colour of a stroke to others that mean the same, at most; chosen */
#define PAINT_SHARE   3    /* a pixel is paint from one third of the contrast of its stroke on, as with alpha */
#define MANY_STROKES  4096 /* more are not compared; chosen */

/* A piece: its strongest colour, and that of pixels inside it (0: none); how many are paint, and paint inside another
 * colour; the colour that most of these have, if one has; its border, and how much of that is with other paint. */
typedef struct { uint32_t id, core, paint, inside, tint, votes, of_tint, border, foreign; } TintPiece;

static int
contrast_of (const CeldScribbleLayer *r, uint32_t id)
{
  return (int) sqrt (celd_colour_distance (r->colour[id].channel, r->colour[r->paper].channel));
}

/* Whether a colour is a mixture of paper and of another one. */
static bool
is_tint_of (const CeldScribbleLayer *r, uint32_t id, uint32_t of)
{
  bool ahead = true;
  int  error = r->lossy ? LOSSY_ERROR : MIXTURE_ERROR;

  return id == of || (celd_distance_to_mixtures (r->colour[r->paper].channel, r->colour[of].channel,
                                                 r->colour[id].channel, &ahead) <= error * error &&
                      ahead);
}

static bool
differ (const CeldScribbleLayer *r, uint32_t a, uint32_t b, int distance)
{
  return celd_colour_distance (r->colour[a].channel, r->colour[b].channel) > distance * distance;
}

/* ------------------------------------------------------------------ pieces: union-find in r->label */

/* Sorts pixels by falling contrast, and those of the same as they lie; returns how many have any. */
static size_t
sort_pixels (const CeldScribbleLayer *r, const uint16_t *contrast, uint32_t *order)
{
  size_t first[ALL_CONTRASTS + 1] = { 0 }, n = 0;

  for (size_t p = 0; p < r->pixels; p++)
    if (r->id[p] != r->paper)
      first[contrast[r->id[p]]]++;
  for (int c = ALL_CONTRASTS; c >= 0; c--)
    {
      size_t of = first[c];

      first[c] = n;
      n += of;
    }
  for (size_t p = 0; p < r->pixels; p++)
    if (r->id[p] != r->paper)
      order[first[contrast[r->id[p]]]++] = (uint32_t) p;
  return n;
}

/* Lets a pixel join the pieces of its neighbours that are done, and these each other. */
static void
join_pixel (CeldScribbleLayer *r, const uint16_t *contrast, uint32_t p)
{
  int      x = (int) (p % (size_t) r->width), y = (int) (p / (size_t) r->width);
  uint32_t root[8], best = p;
  size_t   n = 0;
  double   step = r->lossy ? LOSSY_STEP : SOFT_STEP;

  for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < r->height; v++)
    for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < r->width; u++)
      {
        size_t   q = (size_t) v * (size_t) r->width + (size_t) u;
        uint32_t k;

        if (!r->kind[q] || contrast[r->id[q]] < contrast[r->id[p]])
          continue;
        k = celd_root (r->label, (uint32_t) q);
        if (!differ (r, r->id[p], r->id[q], (int) (step * contrast[r->id[k]])) &&
            is_tint_of (r, r->id[p], r->id[k]))
          root[n++] = k;
      }
  for (size_t i = 0; i < n; i++)
    if (best == p || contrast[r->id[root[i]]] > contrast[r->id[best]] ||
        (contrast[r->id[root[i]]] == contrast[r->id[best]] && root[i] < best))
      best = root[i];
  r->label[p] = best;
  for (size_t i = 0; i < n; i++)
    {
      uint32_t k = celd_root (r->label, root[i]);

      if (k != best && contrast[r->id[p]] >= SADDLE * contrast[r->id[k]] && is_tint_of (r, r->id[k], r->id[best]))
        r->label[k] = best;
    }
}

/* Numbers the pieces from 1 in r->label, which is 0 for paper; returns how many there are. */
static size_t
number_pieces (CeldScribbleLayer *r, const uint32_t *order, size_t n)
{
  size_t pieces = 0;

  for (size_t i = 0; i < n; i++)
    r->label[order[i]] = celd_root (r->label, order[i]);
  for (size_t i = 0; i < n; i++) /* a root comes before all others of its piece */
    {
      uint32_t p = order[i];

      if (r->label[p] == p)
        r->label[p] = (uint32_t) ++pieces;
      else
        r->label[p] = r->label[r->label[p]];
    }
  return pieces;
}

/* ------------------------------------------------------------------ what is soft */

/* Whether the pixel has one colour with those beside it. */
static bool
is_inside (const CeldScribbleLayer *r, int x, int y)
{
  const uint32_t *id = r->id + (size_t) y * (size_t) r->width + (size_t) x;

  return (!x || !differ (r, id[0], id[-1], r->radius)) && (x + 1 == r->width || !differ (r, id[0], id[1], r->radius)) &&
         (!y || !differ (r, id[0], *(id - r->width), r->radius)) &&
         (y + 1 == r->height || !differ (r, id[0], id[r->width], r->radius));
}

/* Counts the border of a pixel of a piece with another pixel. */
static void
visit_border (const CeldScribbleLayer *r, TintPiece *piece, size_t p, size_t q)
{
  uint32_t a = r->label[p], b = r->label[q];

  if (a == b)
    return;
  piece[a].border++;
  piece[a].foreign += b && !is_tint_of (r, piece[a].id, piece[b].id) && !is_tint_of (r, piece[b].id, piece[a].id);
}

static bool
is_paint (const CeldScribbleLayer *r, const uint16_t *contrast, const TintPiece *k, size_t p)
{
  return PAINT_SHARE * contrast[r->id[p]] >= contrast[k->id];
}

/* How far colours of one tint differ at most. */
static int
tint_error (const CeldScribbleLayer *r)
{
  return r->lossy ? LOSSY_TINT : 0;
}

/* Adds a pixel of paint that is inside one colour; the majority is that of Boyer and Moore. */
static void
vote_for_tint (const CeldScribbleLayer *r, const uint16_t *contrast, TintPiece *k, uint32_t id)
{
  if (contrast[id] > contrast[k->core])
    k->core = id;
  if (!differ (r, id, k->id, r->radius))
    return;
  k->inside++;
  k->tint = k->votes ? k->tint : id;
  k->votes = differ (r, id, k->tint, tint_error (r)) ? k->votes - 1 : k->votes + 1;
}

/* Adds a pixel of a piece. */
static void
visit_pixel (const CeldScribbleLayer *r, const uint16_t *contrast, TintPiece *piece, int x, int y)
{
  size_t     w = (size_t) r->width, p = (size_t) y * w + (size_t) x;
  TintPiece *k = &piece[r->label[p]];

  if (is_paint (r, contrast, k, p))
    {
      k->paint++;
      if (is_inside (r, x, y))
        vote_for_tint (r, contrast, k, r->id[p]);
    }
  if (x > 0)
    visit_border (r, piece, p, p - 1);
  if (x + 1 < r->width)
    visit_border (r, piece, p, p + 1);
  if (y > 0)
    visit_border (r, piece, p, p - w);
  if (y + 1 < r->height)
    visit_border (r, piece, p, p + w);
}

/* Counts a pixel of a piece if it is inside paint of the tint that most votes were for. */
static void
count_tint (const CeldScribbleLayer *r, const uint16_t *contrast, TintPiece *piece, int x, int y)
{
  size_t     p = (size_t) y * (size_t) r->width + (size_t) x;
  TintPiece *k = &piece[r->label[p]];

  k->of_tint += is_paint (r, contrast, k, p) && differ (r, r->id[p], k->id, r->radius) &&
                !differ (r, r->id[p], k->tint, tint_error (r)) && is_inside (r, x, y);
}

/* Fills in what is known of the pieces but their colour. */
static void
measure_pieces (const CeldScribbleLayer *r, const uint16_t *contrast, TintPiece *piece)
{
  const uint32_t *label = r->label;

  for (int y = 0; y < r->height; y++)
    for (int x = 0; x < r->width; x++, label++)
      if (*label)
        visit_pixel (r, contrast, piece, x, y);
  label = r->label;
  for (int y = 0; y < r->height; y++)
    for (int x = 0; x < r->width; x++, label++)
      if (*label)
        count_tint (r, contrast, piece, x, y);
}

/* ------------------------------------------------------------------ one colour for each stroke */

/* The colour of a piece if it is a soft stroke, else 0: it has tints that would be labels, it is not the mixture of two
 * strokes, which lies between these, and if much of it is flat, this has its colour, or nearly so. */
static uint32_t
soft_colour (const CeldScribbleLayer *r, const TintPiece *k)
{
  bool flat = 2 * k->of_tint > k->inside && FLAT_PAINT * k->of_tint > k->paint;

  if (k->inside < CELD_LEAST_DOT || 2 * k->foreign > k->border || (flat && differ (r, k->tint, k->core, SAME_PAINT)))
    return 0;
  return flat ? k->tint : k->core;
}

/* Keeps the soft pieces in order, by falling contrast; returns how many there are. */
static size_t
keep_soft (const CeldScribbleLayer *r, TintPiece *piece, size_t n, uint32_t *soft)
{
  size_t n_soft = 0;

  for (size_t k = 1; k <= n; k++) /* pieces have the order of their strongest pixels */
    {
      piece[k].id = soft_colour (r, &piece[k]);
      if (piece[k].id)
        soft[n_soft++] = (uint32_t) k;
    }
  return n_soft;
}

/* Gives soft strokes in one paint, of which pressure made one paler, the strongest colour of them. */
static void
join_paints (const CeldScribbleLayer *r, TintPiece *piece, const uint32_t *soft, size_t n_soft)
{
  for (size_t i = 0; i < n_soft && n_soft <= MANY_STROKES; i++)
    for (size_t j = 0; j < i; j++)
      if (!differ (r, piece[soft[i]].id, piece[soft[j]].id, SAME_PAINT) &&
          is_tint_of (r, piece[soft[i]].id, piece[soft[j]].id))
        {
          piece[soft[i]].id = piece[soft[j]].id;
          break;
        }
}

static void
paint_pieces (CeldScribbleLayer *r, const uint16_t *contrast, const TintPiece *piece, const uint32_t *order, size_t n)
{
  for (size_t i = 0; i < n; i++)
    {
      size_t   p = order[i];
      uint32_t id = piece[r->label[p]].id;

      if (!id || id == r->id[p])
        continue;
      r->colour[id].is_soft = true;
      r->colour[r->id[p]].pixels--;
      r->colour[r->id[p]].opacity -= 255;
      r->id[p] = PAINT_SHARE * contrast[r->id[p]] >= contrast[id] ? id : r->paper;
      r->colour[r->id[p]].pixels++;
      r->colour[r->id[p]].opacity += 255;
    }
}

CeldStatus
celd_scribble_tints (CeldScribbleLayer *r)
{
  uint16_t  *contrast = celd_alloc (r->n, sizeof *contrast);
  uint32_t  *order = celd_alloc (r->pixels, sizeof *order), *soft = NULL;
  TintPiece *piece = NULL;
  size_t     n, n_pieces, n_soft;
  CeldStatus status = CELD_NO_MEMORY;

  if (!contrast || !order)
    goto done;
  for (size_t i = 0; i < r->n; i++)
    contrast[i] = (uint16_t) (i ? contrast_of (r, (uint32_t) i) : 0);
  n = sort_pixels (r, contrast, order);
  memset (r->kind, 0, r->pixels);
  memset (r->label, 0, r->pixels * sizeof *r->label);
  for (size_t i = 0; i < n; i++)
    {
      join_pixel (r, contrast, order[i]);
      r->kind[order[i]] = 1;
    }
  n_pieces = number_pieces (r, order, n);
  piece = celd_alloc0 (n_pieces + 1, sizeof *piece);
  soft = celd_alloc (n_pieces, sizeof *soft);
  if (!piece || !soft)
    goto done;
  for (size_t i = n; i-- > 0;) /* the first of a piece is its strongest */
    piece[r->label[order[i]]].id = r->id[order[i]];
  measure_pieces (r, contrast, piece);
  n_soft = keep_soft (r, piece, n_pieces, soft);
  join_paints (r, piece, soft, n_soft);
  paint_pieces (r, contrast, piece, order, n);
  status = CELD_OK;

done:
  celd_free (soft);
  celd_free (piece);
  celd_free (order);
  celd_free (contrast);
  return status;
}
