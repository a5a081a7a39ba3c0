/* Pieces of strokes in a layer stored with loss: what is connected within a block.
 *
 * Strokes are found by luma, which loss keeps: their contrast exceeds that of the ripple which compression leaves
 * around strong strokes in the same block.  Where strokes of several colours touch, their darkest pixels still have
 * these colours, though less of each, by which the pixels of a piece are divided in two (k-means of [Lloyd82]), as
 * often as two are found that are clearly apart; else the piece would have a mixture, which looks like one more label.
 *
 * Cost: O(pixels); in blocks where strokes of several colours touch, the square of their pixels.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/input.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define LUMA_BLOCK      8       /* pixels, side of the blocks of luma; JPEG */
/* Contrast of pixels in steps of 1/255; all chosen. */
#define RIPPLE_CONTRAST 40      /* ripple of compression has no more, ... */
#define RIPPLE_FRACTION 0.35    /* ... and no more than this fraction of the largest contrast in the luma block */
#define CORE_DISTANCE   30      /* of the two colours in a piece of two strokes, at least, ... */
#define CORE_SPREAD     2.5     /* ... and by this factor farther than pixels are from their own colour */
#define CORE_ROUNDS     5       /* of k-means; chosen */

/* ------------------------------------------------------------------ strokes, by luma */

/* Fills in the contrast of one row: luma, and a quarter of chroma. */
static void
measure_row (void *data, int y)
{
  CeldScribbleLayer *r = data;

  for (int x = 0; x < r->width; x++)
    {
      int d[3], luma, chroma;

      celd_loss_deficit (r, x, y, d);
      luma = celd_loss_luma (d);
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
      limit = fmax (CELD_FAINT_CONTRAST, fmin (RIPPLE_CONTRAST, RIPPLE_FRACTION * most));
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
  int                left = x / CELD_BLOCK * CELD_BLOCK, top = y / CELD_BLOCK * CELD_BLOCK;
  int                stack[CELD_BLOCK * CELD_BLOCK], n = 0;

  if (celd_append (s->piece, s->n, s->piece_capacity,
                   (CeldLossPiece) { .block = (uint32_t) (y / CELD_BLOCK * s->columns + x / CELD_BLOCK) }) != CELD_OK)
    return CELD_NO_MEMORY;
  r->label[(size_t) y * (size_t) r->width + (size_t) x] = (uint32_t) s->n;
  stack[n++] = (y - top) * CELD_BLOCK + x - left;
  while (n)
    {
      int at = stack[--n], u = left + at % CELD_BLOCK, v = top + at / CELD_BLOCK;

      for (int b = v > top ? v - 1 : top; b <= v + 1 && b < top + CELD_BLOCK && b < r->height; b++)
        for (int a = u > left ? u - 1 : left; a <= u + 1 && a < left + CELD_BLOCK && a < r->width; a++)
          if (r->label[(size_t) b * (size_t) r->width + (size_t) a] == CELD_QUEUED)
            {
              r->label[(size_t) b * (size_t) r->width + (size_t) a] = (uint32_t) s->n;
              stack[n++] = (b - top) * CELD_BLOCK + a - left;
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

bool
celd_loss_is_core (const CeldScribbleLayer *r, int x, int y)
{
  int most = 0;

  for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < r->height; v++)
    for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < r->width; u++)
      if (r->kind[(size_t) v * (size_t) r->width + (size_t) u] > most)
        most = r->kind[(size_t) v * (size_t) r->width + (size_t) u];
  return 10 * r->kind[(size_t) y * (size_t) r->width + (size_t) x] >= 9 * most;
}

/* ------------------------------------------------------------------ pieces of two strokes */

/* The pixels of a piece; the second colour has the core pixels that are `second`. */
typedef struct
{
  int  x[CELD_BLOCK * CELD_BLOCK], y[CELD_BLOCK * CELD_BLOCK], d[CELD_BLOCK * CELD_BLOCK][3], n;
  bool core[CELD_BLOCK * CELD_BLOCK], second[CELD_BLOCK * CELD_BLOCK];
} PiecePixels;

static void
gather_pixels (const CeldLossStrokes *s, uint32_t k, PiecePixels *p)
{
  const CeldScribbleLayer *r = s->r;
  int                      left = (int) s->piece[k].block % s->columns * CELD_BLOCK;
  int                      top = (int) s->piece[k].block / s->columns * CELD_BLOCK;

  p->n = 0;
  for (int y = top; y < top + CELD_BLOCK && y < r->height; y++)
    for (int x = left; x < left + CELD_BLOCK && x < r->width; x++)
      if (r->label[(size_t) y * (size_t) r->width + (size_t) x] == k + 1)
        {
          p->x[p->n] = x;
          p->y[p->n] = y;
          p->core[p->n] = celd_loss_is_core (r, x, y);
          p->second[p->n] = false;
          celd_loss_deficit (r, x, y, p->d[p->n++]);
        }
}

/* The core pixel whose colour is farthest from a colour; -1: there is no core. */
static int
farthest_core (const PiecePixels *p, const int *from)
{
  int found = -1, most = -1;

  for (int i = 0; i < p->n; i++)
    if (p->core[i] && celd_colour_distance (p->d[i], from) > most)
      {
        most = celd_colour_distance (p->d[i], from);
        found = i;
      }
  return found;
}

/* Assigns each core pixel to the nearer of two colours, and makes these the means of theirs; false if one of them is
 * left with less than a dot. */
static bool
assign_core (PiecePixels *p, int mean[2][3])
{
  int sum[2][3] = { { 0 } }, n[2] = { 0 };

  for (int i = 0; i < p->n; i++)
    if (p->core[i])
      {
        p->second[i] = celd_colour_distance (p->d[i], mean[1]) < celd_colour_distance (p->d[i], mean[0]);
        n[p->second[i]]++;
        for (int k = 0; k < 3; k++)
          sum[p->second[i]][k] += p->d[i][k];
      }
  for (int j = 0; j < 2; j++)
    for (int k = 0; k < 3 && n[j]; k++)
      mean[j][k] = sum[j][k] / n[j];
  return n[0] >= CELD_LEAST_DOT && n[1] >= CELD_LEAST_DOT;
}

/* Has the core two colours, clearly apart?  Fills in `second` if it has. */
static bool
has_two_colours (PiecePixels *p)
{
  int    mean[2][3], a = farthest_core (p, (int[3]) { 0 }), n = 0;
  double spread = 0, apart;

  if (a < 0)
    return false;
  memcpy (mean[1], p->d[farthest_core (p, p->d[a])], sizeof mean[1]);
  memcpy (mean[0], p->d[farthest_core (p, mean[1])], sizeof mean[0]);
  for (int round = 0; round < CORE_ROUNDS; round++)
    if (!assign_core (p, mean))
      return false;
  for (int i = 0; i < p->n; i++)
    if (p->core[i])
      {
        spread += celd_colour_distance (p->d[i], mean[p->second[i]]);
        n++;
      }
  apart = celd_colour_distance (mean[0], mean[1]);
  return apart > CORE_DISTANCE * CORE_DISTANCE && apart * n > CORE_SPREAD * CORE_SPREAD * spread;
}

/* Gives all other pixels the colour of the nearest core pixel. */
static void
assign_rest (PiecePixels *p)
{
  for (int i = 0; i < p->n; i++)
    {
      int least = 2 * CELD_BLOCK * CELD_BLOCK;

      for (int j = 0; j < p->n && !p->core[i]; j++)
        {
          int u = p->x[j] - p->x[i], v = p->y[j] - p->y[i];

          if (p->core[j] && u * u + v * v < least)
            {
              least = u * u + v * v;
              p->second[i] = p->second[j];
            }
        }
    }
}

/* Makes pieces of one colour of those that strokes of several share. */
static CeldStatus
split_pieces (CeldLossStrokes *s)
{
  CeldScribbleLayer *r = s->r;
  PiecePixels        p;

  for (uint32_t k = 0; k < s->n; k++)
    for (gather_pixels (s, k, &p); has_two_colours (&p); gather_pixels (s, k, &p))
      {
        assign_rest (&p);
        if (celd_append (s->piece, s->n, s->piece_capacity, (CeldLossPiece) { .block = s->piece[k].block }) != CELD_OK)
          return CELD_NO_MEMORY;
        for (int i = 0; i < p.n; i++)
          if (p.second[i])
            r->label[(size_t) p.y[i] * (size_t) r->width + (size_t) p.x[i]] = (uint32_t) s->n;
      }
  return CELD_OK;
}

/* ------------------------------------------------------------------ contacts, and measuring pieces and blocks */

/* Lists the pieces that touch. */
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

/* ------------------------------------------------------------------ all steps */

CeldStatus
celd_scribble_pieces (CeldLossStrokes *s, const CeldHost *host)
{
  CeldScribbleLayer *r = s->r;
  CeldStatus         status;

  celd_parallel_for (host, r->height, measure_row, r);
  celd_parallel_for (host, (r->height + LUMA_BLOCK - 1) / LUMA_BLOCK, mark_blocks, r);
  status = celd_progress (host, 0.1);
  if (status == CELD_OK)
    status = find_pieces (s);
  if (status == CELD_OK)
    status = split_pieces (s);
  if (status == CELD_OK)
    status = find_contacts (s);
  if (status == CELD_OK)
    status = celd_progress (host, 0.2);
  return status;
}
