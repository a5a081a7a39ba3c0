/* The colours of two layers that share a pixel.
 *
 * Of the pixel P, premultiplied, and the front one's share: front + (1 - alpha of front) back = P has one solution for
 * each colour that one assumes for the other.  Both are looked up: each layer's colour is that of the pixels round it
 * that are the layer's alone, ink first for the one whose ink is in the pixel, paper first for the other.  What misses
 * P then is divided between the two by least squares, nearly all to the one with the ink where it covers more than a
 * tenth of the pixel: paper keeps its colour, and a line too thin for a pixel of its own still becomes dark.  What
 * would be beyond black or white goes to the other one; that both have P's own colour is always a solution.
 *
 * The share was measured on the ink.  Where the colours say how much of the pixel each covers, they say it better: a
 * pixel between black and white that is darker than its share allows would leave a dark speck on the back one.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "layers/layers.h"

#include <math.h>

#define NEAR_REACH 2
#define FAR_REACH  5
#define STIFFNESS  100.f /* how much rather the one with ink changes than the other */
#define CONTRAST   0.2f  /* a distance of colours that tells shares */
#define CORRECTION 0.3f  /* of a share, at most */

/* ------------------------------------------------------------------ what is around */

/* Colours near a pixel that are one layer's alone. */
typedef struct
{
  float ink[4], paper[4];      /* means, the first three premultiplied; weighed towards ink, and towards paper */
  float ink_weight, paper_weight;
  bool  inked;                 /* is one of them more ink than paper? */
} Around;

static void
add_colour (const float *art, float weight, float *sum, float *total)
{
  for (int c = 0; c < 3; c++)
    sum[c] += weight * art[3] * art[c];
  sum[3] += weight * art[3];
  *total += weight;
}

static void
look_around (const CeldLayers *layers, const CeldPlane *ink, const CeldBlend *blend, uint32_t layer, int reach,
             Around *around)
{
  int left = blend->x > reach ? blend->x - reach : 0, top = blend->y > reach ? blend->y - reach : 0;
  int right = blend->x + reach < layers->width ? blend->x + reach : layers->width - 1;
  int bottom = blend->y + reach < layers->height ? blend->y + reach : layers->height - 1;

  *around = (Around) { 0 };
  for (int y = top; y <= bottom; y++)
    for (int x = left; x <= right; x++)
      {
        size_t p = (size_t) y * (size_t) layers->width + (size_t) x;

        if (layers->place[p] == layer)
          {
            int   dx = x - blend->x, dy = y - blend->y;
            float i = CELD_AT (ink, x, y), paper, dark, near = 1.f / (float) (dx * dx + dy * dy);

            i     = i > 0 ? i < 1 ? i : 1 : 0;
            paper = i * i * i * i + 1e-6f;
            dark  = (1 - i) * (1 - i) * (1 - i) * (1 - i) + 1e-6f;
            add_colour (layers->art + 4 * p, near * dark, around->ink, &around->ink_weight);
            add_colour (layers->art + 4 * p, near * paper, around->paper, &around->paper_weight);
            around->inked = around->inked || !celd_is_paper (CELD_AT (ink, x, y));
          }
      }
}

/* The mean as a straight colour; that of the pixel itself if there is none. */
static void
mean_colour (const float *sum, float total, const float *pixel, float *colour)
{
  for (int c = 0; c < 4; c++)
    colour[c] = pixel[c];
  if (total > 0)
    colour[3] = sum[3] / total;
  for (int c = 0; c < 3 && total > 0 && sum[3] > 0; c++)
    colour[c] = sum[c] / sum[3];
}

/* ------------------------------------------------------------------ telling apart */

static float
clamp (float value)
{
  return value > 0 ? value < 1 ? value : 1 : 0;
}

/* Moves the share of an opaque pixel towards the one that mixes both colours to the pixel's. */
static void
correct_share (const float *pixel, CeldBlend *blend)
{
  const float *front = blend->colour[0], *back = blend->colour[1];
  float        along = 0, square = 0, correction;

  for (int c = 0; c < 3; c++)
    {
      along  += (pixel[c] - back[c]) * (front[c] - back[c]);
      square += (front[c] - back[c]) * (front[c] - back[c]);
    }
  if (square < CONTRAST * CONTRAST || pixel[3] < 1 || front[3] < 0.999f || back[3] < 0.999f)
    return;
  correction   = clamp (along / square) - blend->share;
  blend->share = clamp (blend->share + fminf (fmaxf (correction, -CORRECTION), CORRECTION));
}

/* The alpha of both, so that a = front + (1 - front) back.  Where the back one is not opaque and the front one has the
 * ink, the back one stays as it is as far as that is possible. */
static void
split_alpha (const CeldLayers *layers, float a, bool back_inked, CeldBlend *blend)
{
  float front = blend->share * blend->colour[0][3], back = blend->colour[1][3];

  if (!back_inked && back < 1)
    front = clamp ((a - back) / (1 - back));
  front = front < blend->share ? front : blend->share;
  front = celd_store_alpha (layers, front < a ? front : a);
  front = front < a ? front : a;
  if (front < 1)
    back = celd_store_alpha (layers, clamp ((a - front) / (1 - front)));
  blend->colour[0][3] = front;
  blend->colour[1][3] = back;
}

/* One channel, of which the colours are expected: wanted = of[0] front + of[1] back. */
static void
split_channel (const CeldLayers *layers, int c, float wanted, const float of[2], int inked, CeldBlend *blend)
{
  float *front = &blend->colour[0][c], *back = &blend->colour[1][c];
  float  ease[2] = { inked == 0 ? STIFFNESS : 1, inked == 1 ? STIFFNESS : 1 };
  float  miss = wanted - of[0] * *front - of[1] * *back;
  float  sum = ease[0] * of[0] * of[0] + ease[1] * of[1] * of[1];

  if (sum > 0)
    {
      *front = clamp (*front + miss * ease[0] * of[0] / sum);
      *back  = clamp (*back + miss * ease[1] * of[1] / sum);
    }
  miss = wanted - of[0] * *front - of[1] * *back;
  if (fabsf (miss) > 1e-6f && of[1] > 0)
    *back = clamp (*back + miss / of[1]);
  miss = wanted - of[0] * *front - of[1] * *back;
  if (fabsf (miss) > 1e-6f && of[0] > 0)
    *front = clamp (*front + miss / of[0]);
  *front = celd_store_colour (layers, *front);
  *back  = celd_store_colour (layers, *back);
}

static void
find_colours (const CeldLayers *layers, const CeldPlane *ink, CeldBlend *blend)
{
  const float *pixel = layers->art + 4 * ((size_t) blend->y * (size_t) layers->width + (size_t) blend->x);
  Around       around[2];
  int          inked;
  float        of[2];

  for (int side = 0; side < 2; side++)
    {
      look_around (layers, ink, blend, blend->layer[side], NEAR_REACH, &around[side]);
      if (!(around[side].paper_weight > 0))
        look_around (layers, ink, blend, blend->layer[side], FAR_REACH, &around[side]);
    }
  inked = around[1].inked && !around[0].inked;
  for (int side = 0; side < 2; side++)
    if (side == inked)
      mean_colour (around[side].ink, around[side].ink_weight, pixel, blend->colour[side]);
    else
      mean_colour (around[side].paper, around[side].paper_weight, pixel, blend->colour[side]);
  correct_share (pixel, blend);
  split_alpha (layers, pixel[3], inked == 1, blend);
  of[0] = blend->colour[0][3];
  of[1] = (1 - of[0]) * blend->colour[1][3];
  for (int c = 0; c < 3; c++)
    split_channel (layers, c, pixel[3] * pixel[c], of, inked, blend);
}

/* ------------------------------------------------------------------ all of them */

#define PORTION 4096

typedef struct { CeldLayers *layers; const CeldPlane *ink; } Work;

static void
find_portion (void *data, int i)
{
  const Work *work = data;
  size_t      end = ((size_t) i + 1) * PORTION;

  end = end < work->layers->n_blends ? end : work->layers->n_blends;
  for (size_t b = (size_t) i * PORTION; b < end; b++)
    find_colours (work->layers, work->ink, &work->layers->blend[b]);
}

CeldStatus
celd_layer_colours (CeldLayers *layers, const CeldPlane *ink, const CeldHost *host)
{
  Work work = { layers, ink };

  celd_parallel_for (host, (int) ((layers->n_blends + PORTION - 1) / PORTION), find_portion, &work);
  return celd_progress (host, 1);
}

static float
decode (double encoded)
{
  return (float) (encoded <= 0.04045 ? encoded / 12.92 : pow ((encoded + 0.055) / 1.055, 2.4));
}

void
celd_store_prepare (CeldLayers *layers)
{
  for (int k = 0; k < 256; k++)
    {
      layers->shade[k] = decode (k / 255.0);
      layers->limit[k] = decode ((k + 0.5) / 255);
    }
}

float
celd_store_alpha (const CeldLayers *layers, float alpha)
{
  return layers->store == CELD_STORE_FLOAT ? alpha : (float) (int) (alpha * 255 + 0.5f) / 255;
}

float
celd_store_colour (const CeldLayers *layers, float value)
{
  int least = 0, most = 255;

  if (layers->store != CELD_STORE_8_BIT_SRGB)
    return celd_store_alpha (layers, value);
  while (least < most)
    {
      int middle = (least + most) / 2;

      if (value < layers->limit[middle])
        most = middle;
      else
        least = middle + 1;
    }
  return layers->shade[least];
}
