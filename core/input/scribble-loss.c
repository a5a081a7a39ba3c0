/* Restores thin strokes on white paper whose chroma a codec (JPEG) has stored at half size.
 *
 * Luma is kept, but chroma is smeared over blocks of 16 pixels, so that thin strokes lose colour and paper beside them
 * is tinted.  Strokes are therefore found by luma: their contrast exceeds that of the ripple which compression leaves
 * around strong strokes in the same block.  The sum of chroma over a block is kept, too; it is divided among the
 * strokes of the block (scribble-unmix.c).  Colours are deficits here: by how much each channel is below that of paper.
 *
 * Cost: O(pixels), and a few records for each block that has strokes.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/input.h"

#include <math.h>
#include <stdlib.h>

#define LUMA_BLOCK      8       /* pixels, side of the blocks of luma; JPEG */
#define BLOCK           16      /* pixels, side of the blocks of chroma at half size; JPEG */
#define WHITE_PAPER     240     /* of 255, least channel of paper: on other paper the sums differ; chosen */
/* Contrast of pixels in steps of 1/255; all chosen. */
#define FAINT_CONTRAST  12      /* paper has no more */
#define RIPPLE_CONTRAST 40      /* ripple of compression has no more, ... */
#define RIPPLE_FRACTION 0.35    /* ... and no more than this fraction of the largest contrast in the luma block */
#define PALE_LUMA       16      /* deficit of luma: paper, or nearly */
#define VIVID_CHROMA    25      /* mean chroma of strokes that show whether it is smeared */
#define SMEARED         0.04    /* least part of all chroma beside the strokes, if it is smeared; chosen */
#define TINT            3       /* largest deficit of a pixel that is not paper, at least */
#define MIXTURE_ERROR   2.5     /* from a tint to the nearest mixture of stroke and paper, at most: rounding */
#define SOFT            0.75    /* part of tints that are mixtures, from which on brushes were soft; chosen: it was at
                                   least 0.96 for soft brushes, and at most 0.4 for JPEG */

static inline void
deficit (const CeldScribbleLayer *r, int x, int y, int *d)
{
  const uint8_t *p = CELD_RGBA (r->paint, x, y);

  for (int i = 0; i < 3; i++)
    d[i] = r->colour[r->paper].channel[i] - p[i];
}

static inline int
luma_of (const int *d)
{
  return (77 * d[0] + 150 * d[1] + 29 * d[2] + 128) >> 8;
}

/* ------------------------------------------------------------------ is chroma smeared? */

/* What add_smear sums up over blocks. */
typedef struct
{
  double beside, all;   /* chroma on paper, and all chroma */
  size_t tints, mixed;  /* pale pixels that are not paper, and those of them that are mixtures of stroke and paper */
} Smear;

/* Is the deficit a fraction of that of a stroke? */
static bool
is_mixed (const int *d, const double *stroke)
{
  double dot = 0, length2 = 0, error2 = 0;

  for (int i = 0; i < 3; i++)
    {
      dot += d[i] * stroke[i];
      length2 += stroke[i] * stroke[i];
      error2 += d[i] * d[i];
    }
  if (length2 > 0)
    error2 -= dot * dot / length2;
  return error2 <= MIXTURE_ERROR * MIXTURE_ERROR;
}

/* Counts the tints of a block whose strokes have the given deficit. */
static void
count_tints (const CeldScribbleLayer *r, int left, int top, const double *stroke, Smear *smear)
{
  for (int y = top; y < top + BLOCK && y < r->height; y++)
    for (int x = left; x < left + BLOCK && x < r->width; x++)
      {
        int d[3];

        deficit (r, x, y, d);
        if (luma_of (d) > PALE_LUMA || (abs (d[0]) < TINT && abs (d[1]) < TINT && abs (d[2]) < TINT))
          continue;
        smear->tints++;
        smear->mixed += is_mixed (d, stroke);
      }
}

/* Adds the chroma of a block's paper, as far as it has the direction of the chroma of its strokes, and that of both.
 * Chroma is red and blue less luma. */
static void
add_smear (const CeldScribbleLayer *r, int left, int top, Smear *smear)
{
  double paper[2] = { 0 }, stroke[2] = { 0 }, full[3] = { 0 }, length;
  int    n = 0;

  for (int y = top; y < top + BLOCK && y < r->height; y++)
    for (int x = left; x < left + BLOCK && x < r->width; x++)
      {
        int     d[3], luma;
        double *sum;

        deficit (r, x, y, d);
        luma = luma_of (d);
        n += luma > PALE_LUMA;
        sum = luma > PALE_LUMA ? stroke : paper;
        sum[0] += d[0] - luma;
        sum[1] += d[2] - luma;
        for (int i = 0; i < 3 && luma > PALE_LUMA; i++)
          full[i] += d[i];
      }
  length = hypot (stroke[0], stroke[1]);
  if (n < LUMA_BLOCK || length < VIVID_CHROMA * n)
    return;
  smear->beside += (paper[0] * stroke[0] + paper[1] * stroke[1]) / length;
  smear->all += (paper[0] * stroke[0] + paper[1] * stroke[1]) / length + length;
  count_tints (r, left, top, full, smear);
}

/* The tails of soft brushes have chroma, too, but are exact mixtures of stroke and paper, while loss moves luma and
 * chroma apart. */
bool
celd_scribble_smeared (const CeldScribbleLayer *r)
{
  Smear smear = { .all = 0 };

  for (int i = 0; i < 3; i++)
    if (!r->paper || r->colour[r->paper].channel[i] < WHITE_PAPER)
      return false;
  for (int y = 0; y < r->height; y += BLOCK)
    for (int x = 0; x < r->width; x += BLOCK)
      add_smear (r, x, y, &smear);
  return smear.beside > SMEARED * smear.all && (double) smear.mixed < SOFT * (double) smear.tints;
}

/* ------------------------------------------------------------------ strokes, by luma */

/* Fills in the contrast of one row: luma, and a quarter of chroma. */
static void
measure_row (void *data, int y)
{
  CeldScribbleLayer *r = data;

  for (int x = 0; x < r->width; x++)
    {
      int d[3], luma, chroma;

      deficit (r, x, y, d);
      luma = luma_of (d);
      chroma = (abs (d[0] - luma) + abs (d[2] - luma)) / 2;
      luma = abs (luma) + chroma / 4;
      r->kind[(size_t) y * (size_t) r->width + (size_t) x] = (uint8_t) (luma < 255 ? luma : 255);
    }
}

/* Marks one row of luma blocks in label: CELD_QUEUED = of a stroke, 0 = paper. */
static void
mark_blocks (void *data, int row)
{
  CeldScribbleLayer *r = data;
  int                bottom = (row + 1) * LUMA_BLOCK < r->height ? (row + 1) * LUMA_BLOCK : r->height;

  for (int left = 0; left < r->width; left += LUMA_BLOCK)
    {
      int    right = left + LUMA_BLOCK < r->width ? left + LUMA_BLOCK : r->width, most = 0;
      double limit;

      for (int y = row * LUMA_BLOCK; y < bottom; y++)
        for (int x = left; x < right; x++)
          most = most > r->kind[(size_t) y * (size_t) r->width + (size_t) x]
                   ? most
                   : r->kind[(size_t) y * (size_t) r->width + (size_t) x];
      limit = fmax (FAINT_CONTRAST, fmin (RIPPLE_CONTRAST, RIPPLE_FRACTION * most));
      for (int y = row * LUMA_BLOCK; y < bottom; y++)
        for (int x = left; x < right; x++)
          {
            size_t i = (size_t) y * (size_t) r->width + (size_t) x;

            r->label[i] = r->kind[i] > limit ? CELD_QUEUED : 0;
          }
    }
}

/* Makes a piece of the pixels connected to (x,y) within its block. */
static CeldStatus
add_piece (CeldLossStrokes *s, int x, int y)
{
  CeldScribbleLayer *r = s->r;
  int                left = x / BLOCK * BLOCK, top = y / BLOCK * BLOCK, stack[BLOCK * BLOCK], n = 0;

  if (celd_append (s->piece, s->n, s->piece_capacity,
                   (CeldLossPiece) { .block = (uint32_t) (y / BLOCK * s->columns + x / BLOCK) }) != CELD_OK)
    return CELD_NO_MEMORY;
  r->label[(size_t) y * (size_t) r->width + (size_t) x] = (uint32_t) s->n;
  stack[n++] = (y - top) * BLOCK + x - left;
  while (n)
    {
      int at = stack[--n], u = left + at % BLOCK, v = top + at / BLOCK;

      for (int b = v > top ? v - 1 : top; b <= v + 1 && b < top + BLOCK && b < r->height; b++)
        for (int a = u > left ? u - 1 : left; a <= u + 1 && a < left + BLOCK && a < r->width; a++)
          if (r->label[(size_t) b * (size_t) r->width + (size_t) a] == CELD_QUEUED)
            {
              r->label[(size_t) b * (size_t) r->width + (size_t) a] = (uint32_t) s->n;
              stack[n++] = (b - top) * BLOCK + a - left;
            }
    }
  return CELD_OK;
}

static CeldStatus
find_pieces (CeldLossStrokes *s)
{
  CeldStatus status = CELD_OK;

  for (int y = 0; y < s->r->height && status == CELD_OK; y++)
    for (int x = 0; x < s->r->width && status == CELD_OK; x++)
      if (s->r->label[(size_t) y * (size_t) s->r->width + (size_t) x] == CELD_QUEUED)
        status = add_piece (s, x, y);
  return status;
}

/* Lists the pieces that touch across the boundary of a block. */
static CeldStatus
find_contacts (CeldLossStrokes *s)
{
  static const int         step[4][2] = { { 1, 0 }, { 1, 1 }, { 0, 1 }, { -1, 1 } };
  const CeldScribbleLayer *r = s->r;

  for (int y = 0; y < r->height; y++)
    for (int x = 0; x < r->width; x++)
      for (int k = 0; k < 4; k++)
        {
          int      u = x + step[k][0], v = y + step[k][1];
          uint32_t a = r->label[(size_t) y * (size_t) r->width + (size_t) x], b;

          if (!a || u < 0 || u >= r->width || v >= r->height)
            continue;
          b = r->label[(size_t) v * (size_t) r->width + (size_t) u];
          if (!b || a == b)
            continue;
          if (celd_append (s->contact, s->n_contacts, s->contact_capacity, (CeldLossContact) { a - 1, b - 1, 0 }) !=
              CELD_OK)
            return CELD_NO_MEMORY;
        }
  return CELD_OK;
}

/* ------------------------------------------------------------------ measuring pieces and blocks */

/* Does none of the eight neighbours have clearly more contrast? */
static bool
is_core (const CeldScribbleLayer *r, int x, int y)
{
  int most = 0;

  for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < r->height; v++)
    for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < r->width; u++)
      if (r->kind[(size_t) v * (size_t) r->width + (size_t) u] > most)
        most = r->kind[(size_t) v * (size_t) r->width + (size_t) u];
  return 10 * r->kind[(size_t) y * (size_t) r->width + (size_t) x] >= 9 * most;
}

/* The mean deficit of each piece's core; of all its pixels if the core is in another block. */
static void
measure_cores (CeldLossStrokes *s)
{
  const CeldScribbleLayer *r = s->r;

  for (int y = 0; y < r->height; y++)
    for (int x = 0; x < r->width; x++)
      {
        uint32_t l = r->label[(size_t) y * (size_t) r->width + (size_t) x];
        double   weight;
        int      d[3];

        if (!l)
          continue;
        weight = is_core (r, x, y) ? 1 : 1e-3;
        deficit (r, x, y, d);
        for (int i = 0; i < 3; i++)
          s->piece[l - 1].core[i] += weight * d[i];
        s->piece[l - 1].all += weight;
      }
  for (size_t k = 0; k < s->n; k++)
    {
      CeldLossPiece *p = &s->piece[k];

      for (int i = 0; i < 3; i++)
        p->core[i] /= p->all;
      p->luma = celd_deficit_luma (p->core);
    }
}

/* The piece of a pixel, or one that it touches in its block, as pixels at an antialiased edge do; NULL = paper. */
static CeldLossPiece *
piece_near (const CeldLossStrokes *s, int x, int y)
{
  static const int         step[5][2] = { { 0, 0 }, { -1, 0 }, { 1, 0 }, { 0, -1 }, { 0, 1 } };
  const CeldScribbleLayer *r = s->r;

  for (int k = 0; k < 5; k++)
    {
      int u = x + step[k][0], v = y + step[k][1];

      if (u >= 0 && v >= 0 && u < r->width && v < r->height && u / BLOCK == x / BLOCK && v / BLOCK == y / BLOCK &&
          r->label[(size_t) v * (size_t) r->width + (size_t) u])
        return &s->piece[r->label[(size_t) v * (size_t) r->width + (size_t) u] - 1];
    }
  return NULL;
}

/* The coverage of each piece, and the sum of each block.  Of paper only the tint counts, where it is not clipped,
 * because ripple is grey. */
static void
measure_sums (CeldLossStrokes *s)
{
  const CeldScribbleLayer *r = s->r;

  for (int y = 0; y < r->height; y++)
    for (int x = 0; x < r->width; x++)
      {
        CeldLossBlock *block = &s->block[y / BLOCK * s->columns + x / BLOCK];
        CeldLossPiece *p = piece_near (s, x, y);
        int            d[3], grey;

        deficit (r, x, y, d);
        grey = d[0] > 0 && d[1] > 0 && d[2] > 0 ? luma_of (d) : 0;
        if (p)
          {
            if (p->luma >= FAINT_CONTRAST)
              p->coverage += fmin (fmax (luma_of (d) / p->luma, 0), 1.2);
            else
              p->coverage += r->label[(size_t) y * (size_t) r->width + (size_t) x] != 0;
            grey = 0;
          }
        for (int i = 0; i < 3; i++)
          block->sum[i] += d[i] - grey;
      }
}

/* ------------------------------------------------------------------ all steps */

static void
paint_strokes (const CeldLossStrokes *s, CeldPaint *out)
{
  const int *paper = s->r->colour[s->r->paper].channel;

  for (int y = 0; y < out->height; y++)
    for (int x = 0; x < out->width; x++)
      {
        uint32_t             l = s->r->label[(size_t) y * (size_t) out->width + (size_t) x];
        const CeldLossPiece *stroke = l ? &s->piece[s->piece[l - 1].stroke] : NULL;
        uint8_t             *rgba = CELD_RGBA (out, x, y);

        for (int i = 0; i < 3; i++)
          {
            double value = paper[i] - (stroke ? stroke->colour[i] : 0);

            rgba[i] = (uint8_t) (fmin (fmax (value, 0), 255) + 0.5);
          }
        rgba[3] = 255;
      }
}

CeldStatus
celd_scribble_restore (CeldScribbleLayer *r, const CeldHost *host, CeldPaint *out)
{
  CeldLossStrokes s = { .r = r, .columns = (r->width + BLOCK - 1) / BLOCK };
  CeldStatus      status = CELD_NO_MEMORY;

  s.n_blocks = (size_t) s.columns * (size_t) ((r->height + BLOCK - 1) / BLOCK);
  s.block = celd_alloc0 (s.n_blocks, sizeof *s.block);
  if (!s.block)
    goto done;
  celd_parallel_for (host, r->height, measure_row, r);
  celd_parallel_for (host, (r->height + LUMA_BLOCK - 1) / LUMA_BLOCK, mark_blocks, r);
  status = celd_progress (host, 0.1);
  if (status == CELD_OK)
    status = find_pieces (&s);
  if (status == CELD_OK)
    status = find_contacts (&s);
  if (status == CELD_OK)
    status = celd_progress (host, 0.2);
  if (status != CELD_OK)
    goto done;
  measure_cores (&s);
  measure_sums (&s);
  status = celd_progress (host, 0.4);
  if (status == CELD_OK)
    status = celd_scribble_unmix (&s, host);
  if (status == CELD_OK)
    paint_strokes (&s, out);

done:
  celd_free (s.contact);
  celd_free (s.piece);
  celd_free (s.block);
  return status;
}
