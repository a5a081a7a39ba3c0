/* Restores thin strokes on white paper whose chroma a codec (JPEG) has stored at half size.
 *
 * Luma is kept, but chroma is smeared over blocks of 16 pixels, so that thin strokes lose colour and paper beside them
 * is tinted.  The sum of chroma over a block is kept, too; it is divided among the strokes of the block
 * (scribble-unmix.c), which are found by luma (scribble-pieces.c).  Colours are deficits here: by how much each channel
 * is below that of paper.
 *
 * Cost: O(pixels), and a few records for each block that has strokes.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/input.h"

#include <math.h>

#define THIN_STROKE 8   /* pixels, mean width of strokes: in broader ones the filter finds enough chroma that was not
                           smeared; measured on strokes of 2 to 16 pixels */
#define WHITE_PAPER 240 /* of 255, least channel of paper: on other paper the sums differ; chosen */

/* ------------------------------------------------------------------ which layers are restored */

/* Is the pixel paint, by more than the noise?  Its colour differs from paper by twice the radius. */
static bool
is_painted (const CeldScribbleLayer *r, size_t i)
{
  return r->id[i] != r->paper &&
         celd_colour_distance (r->colour[r->id[i]].channel, r->colour[r->paper].channel) > 4 * r->radius * r->radius;
}

/* The mean width of strokes is twice their area by the length of their outline, and that by Crofton's formula pi / 4 of
 * the crossings of all rows and columns. */
bool
celd_scribble_thin (const CeldScribbleLayer *r)
{
  const double quarter_turn = acos (0);
  double       area = 0, crossings = 0;

  for (int i = 0; i < 3; i++)
    if (!r->paper || r->colour[r->paper].channel[i] < WHITE_PAPER)
      return false;
  for (int y = 0; y < r->height; y++)
    for (int x = 0; x < r->width; x++)
      {
        size_t i = (size_t) y * (size_t) r->width + (size_t) x;
        bool   painted = is_painted (r, i);

        area += painted;
        crossings += x && painted != is_painted (r, i - 1);
        crossings += y && painted != is_painted (r, i - (size_t) r->width);
      }
  return 2 * area < THIN_STROKE * quarter_turn / 2 * crossings;
}

/* ------------------------------------------------------------------ measuring pieces and blocks */

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
        weight = celd_loss_is_core (r, x, y) ? 1 : 1e-3;
        celd_loss_deficit (r, x, y, d);
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

      if (u >= 0 && v >= 0 && u < r->width && v < r->height && u / CELD_BLOCK == x / CELD_BLOCK &&
          v / CELD_BLOCK == y / CELD_BLOCK &&
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
        CeldLossBlock *block = &s->block[y / CELD_BLOCK * s->columns + x / CELD_BLOCK];
        CeldLossPiece *p = piece_near (s, x, y);
        int            d[3], grey;

        celd_loss_deficit (r, x, y, d);
        grey = d[0] > 0 && d[1] > 0 && d[2] > 0 ? celd_loss_luma (d) : 0;
        if (p)
          {
            if (p->luma >= CELD_FAINT_CONTRAST)
              p->coverage += fmin (fmax (celd_loss_luma (d) / p->luma, 0), 1.2);
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
  CeldLossStrokes s = { .r = r, .columns = (r->width + CELD_BLOCK - 1) / CELD_BLOCK };
  CeldStatus      status = CELD_NO_MEMORY;

  s.n_blocks = (size_t) s.columns * (size_t) ((r->height + CELD_BLOCK - 1) / CELD_BLOCK);
  s.block = celd_alloc0 (s.n_blocks, sizeof *s.block);
  if (!s.block)
    goto done;
  status = celd_scribble_pieces (&s, host);
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
