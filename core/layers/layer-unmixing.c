/* Unmixing of pixels that two layers share, and rounding to what layers can store.
 *
 * A pixel P, premultiplied, is  front + (1 - alpha of front) back.  The expected colour of each layer is the mean of
 * neighbouring pixels that belong to it alone, weighted towards ink for the layer that has the ink in the pixel, and
 * towards paper for the other one.  The remaining difference to P is distributed by least squares, nearly all of it to
 * the layer with ink if that covers more than a tenth of the pixel: paper keeps its colour, and a line thinner than a
 * pixel still becomes dark.  What exceeds the range [0,1] goes to the other layer; a solution always exists, both
 * layers with P's own colour.
 *
 * Coverage comes from the ink, but is corrected where the colours tell it better: a pixel between black and white that
 * is darker than its coverage allows would leave a dark speck on the layer behind.  What the layer behind can still not
 * explain with its own paper, such as the front layer's paint on the far side of its line, belongs to the front layer.
 *
 * Layers in 8 bits as linear light encoded by sRGB (IEC 61966-2-1) have 256 values; a colour is rounded to the value
 * with the nearest code, so that the limits between values lie half a code away.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "layers/layers.h"

#include <math.h>

#define NEAR_RADIUS    2
#define FAR_RADIUS     5
#define INK_MOBILITY   100.f /* weight of changes to the layer with ink, relative to the other one; chosen */
#define MIN_CONTRAST   0.2f  /* colour distance of the layers from which coverage is corrected; chosen */
#define MAX_CORRECTION 0.3f  /* of coverage, at most; chosen */
#define SAME_COLOUR    0.05f /* difference of channels up to which paper has kept its colour; chosen */

/* ------------------------------------------------------------------ expected colours */

/* Colours near a pixel that belong to one layer alone. */
typedef struct
{
  float ink[4], paper[4];      /* weighted means towards ink and towards paper; r, g, b premultiplied */
  float ink_weight, paper_weight;
  bool  inked;                 /* is any of the pixels more ink than paper? */
} Neighbours;

static void
add_colour (const float *art, float weight, float *sum, float *total)
{
  for (int c = 0; c < 3; c++)
    sum[c] += weight * art[3] * art[c];
  sum[3] += weight * art[3];
  *total += weight;
}

static void
sample_neighbours (const CeldLayers *layers, const CeldPlane *ink, const CeldBlend *blend, uint32_t layer, int radius,
                   Neighbours *neighbours)
{
  int left = blend->x > radius ? blend->x - radius : 0, top = blend->y > radius ? blend->y - radius : 0;
  int right = blend->x + radius < layers->width ? blend->x + radius : layers->width - 1;
  int bottom = blend->y + radius < layers->height ? blend->y + radius : layers->height - 1;

  *neighbours = (Neighbours) { 0 };
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
            add_colour (layers->art + 4 * p, near * dark, neighbours->ink, &neighbours->ink_weight);
            add_colour (layers->art + 4 * p, near * paper, neighbours->paper, &neighbours->paper_weight);
            neighbours->inked = neighbours->inked || !celd_is_paper (CELD_AT (ink, x, y));
          }
      }
}

/* The mean with straight alpha; the colour of the pixel itself if there is none. */
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

/* ------------------------------------------------------------------ unmixing */

static float
clamp (float value)
{
  return value > 0 ? value < 1 ? value : 1 : 0;
}

/* Moves the coverage of an opaque pixel towards the one with which both colours mix to the pixel's. */
static void
correct_coverage (const float *pixel, CeldBlend *blend)
{
  const float *front = blend->colour[0], *back = blend->colour[1];
  float        along = 0, square = 0, correction;

  for (int c = 0; c < 3; c++)
    {
      along  += (pixel[c] - back[c]) * (front[c] - back[c]);
      square += (front[c] - back[c]) * (front[c] - back[c]);
    }
  if (square < MIN_CONTRAST * MIN_CONTRAST || pixel[3] < 1 || front[3] < 0.999f || back[3] < 0.999f)
    return;
  correction   = clamp (along / square) - blend->coverage;
  blend->coverage = clamp (blend->coverage + fminf (fmaxf (correction, -MAX_CORRECTION), MAX_CORRECTION));
}

/* Finds both alphas, with a = front + (1 - front) back.  If the back layer is not opaque and the front layer has the
 * ink, the back layer's alpha is kept as far as possible. */
static void
split_alpha (const CeldLayers *layers, float a, bool back_inked, CeldBlend *blend)
{
  float front = blend->coverage * blend->colour[0][3], back = blend->colour[1][3];

  if (!back_inked && back < 1)
    front = clamp ((a - back) / (1 - back));
  front = front < blend->coverage ? front : blend->coverage;
  front = celd_quantize_alpha (layers, front < a ? front : a);
  front = front < a ? front : a;
  if (front < 1)
    back = celd_quantize_alpha (layers, clamp ((a - front) / (1 - front)));
  blend->colour[0][3] = front;
  blend->colour[1][3] = back;
}

/* Finds one channel of both layers near their expected values, with wanted = of[0] front + of[1] back. */
static void
split_channel (const CeldLayers *layers, int c, float wanted, const float of[2], int inked, CeldBlend *blend)
{
  float *front = &blend->colour[0][c], *back = &blend->colour[1][c];
  float  mobility[2] = { inked == 0 ? INK_MOBILITY : 1, inked == 1 ? INK_MOBILITY : 1 };
  float  residual = wanted - of[0] * *front - of[1] * *back;
  float  sum = mobility[0] * of[0] * of[0] + mobility[1] * of[1] * of[1];

  if (sum > 0)
    {
      *front = clamp (*front + residual * mobility[0] * of[0] / sum);
      *back  = clamp (*back + residual * mobility[1] * of[1] / sum);
    }
  residual = wanted - of[0] * *front - of[1] * *back;
  if (fabsf (residual) > 1e-6f && of[1] > 0)
    *back = clamp (*back + residual / of[1]);
  residual = wanted - of[0] * *front - of[1] * *back;
  if (fabsf (residual) > 1e-6f && of[0] > 0)
    *front = clamp (*front + residual / of[0]);
  *front = celd_quantize_colour (layers, *front);
  *back  = celd_quantize_colour (layers, *back);
}

/* The least coverage by the front layer with which the back layer can have a colour of its own and the front layer some
 * colour, as it can be stored. */
static float
least_coverage (const CeldLayers *layers, const float *pixel, const float *back)
{
  float most = 1, stored;       /* share of the back layer */

  for (int c = 0; c < 3; c++)
    {
      if (back[c] > pixel[c])
        most = fminf (most, pixel[c] / back[c]);
      if (back[c] < pixel[c])
        most = fminf (most, (1 - pixel[c]) / (1 - back[c]));
    }
  stored = celd_quantize_alpha (layers, 1 - most);
  return stored < 1 - most && layers->store != CELD_STORE_FLOAT ? fminf (stored + 1 / 255.f, 1) : stored;
}

static bool
keeps_colour (const float *one, const float *other)
{
  for (int c = 0; c < 3; c++)
    if (fabsf (one[c] - other[c]) > SAME_COLOUR)
      return false;
  return true;
}

static void
split (const CeldLayers *layers, const float *pixel, int inked, CeldBlend *blend)
{
  float of[2];

  split_alpha (layers, pixel[3], inked == 1, blend);
  of[0] = blend->colour[0][3];
  of[1] = (1 - of[0]) * blend->colour[1][3];
  for (int c = 0; c < 3; c++)
    split_channel (layers, c, pixel[3] * pixel[c], of, inked, blend);
}

static void
unmix (const CeldLayers *layers, const CeldPlane *ink, CeldBlend *blend)
{
  const float *pixel = layers->art + 4 * ((size_t) blend->y * (size_t) layers->width + (size_t) blend->x);
  Neighbours   neighbours[2];
  CeldBlend    expected;
  int          inked;

  for (int side = 0; side < 2; side++)
    {
      sample_neighbours (layers, ink, blend, blend->layer[side], NEAR_RADIUS, &neighbours[side]);
      if (!(neighbours[side].paper_weight > 0))
        sample_neighbours (layers, ink, blend, blend->layer[side], FAR_RADIUS, &neighbours[side]);
    }
  inked = neighbours[1].inked && !neighbours[0].inked;
  for (int side = 0; side < 2; side++)
    if (side == inked)
      mean_colour (neighbours[side].ink, neighbours[side].ink_weight, pixel, blend->colour[side]);
    else
      mean_colour (neighbours[side].paper, neighbours[side].paper_weight, pixel, blend->colour[side]);
  correct_coverage (pixel, blend);
  expected = *blend;
  split (layers, pixel, inked, blend);
  if (inked == 0 && pixel[3] >= 1 && expected.colour[0][3] >= 0.999f && expected.colour[1][3] >= 0.999f &&
      neighbours[1].paper_weight > 0 && !keeps_colour (blend->colour[1], expected.colour[1]))
    {
      *blend = expected;
      blend->coverage = fmaxf (expected.coverage, least_coverage (layers, pixel, expected.colour[1]));
      split (layers, pixel, inked, blend);
    }
}

/* ------------------------------------------------------------------ all pixels */

#define CHUNK 4096

typedef struct { CeldLayers *layers; const CeldPlane *ink; } UnmixWork;

static void
unmix_chunk (void *data, int i)
{
  const UnmixWork *work = data;
  size_t           end = ((size_t) i + 1) * CHUNK;

  end = end < work->layers->n_blends ? end : work->layers->n_blends;
  for (size_t b = (size_t) i * CHUNK; b < end; b++)
    unmix (work->layers, work->ink, &work->layers->blend[b]);
}

CeldStatus
celd_layers_unmix (CeldLayers *layers, const CeldPlane *ink, const CeldHost *host)
{
  UnmixWork work = { layers, ink };

  celd_parallel_for (host, (int) ((layers->n_blends + CHUNK - 1) / CHUNK), unmix_chunk, &work);
  return celd_progress (host, 1);
}

static float
decode (double encoded)
{
  return (float) (encoded <= 0.04045 ? encoded / 12.92 : pow ((encoded + 0.055) / 1.055, 2.4));
}

void
celd_quantizer_prepare (CeldLayers *layers)
{
  for (int k = 0; k < 256; k++)
    {
      layers->code_value[k] = decode (k / 255.0);
      layers->code_limit[k] = decode ((k + 0.5) / 255);
    }
}

float
celd_quantize_alpha (const CeldLayers *layers, float alpha)
{
  return layers->store == CELD_STORE_FLOAT ? alpha : (float) (int) (alpha * 255 + 0.5f) / 255;
}

float
celd_quantize_colour (const CeldLayers *layers, float value)
{
  int least = 0, most = 255;

  if (layers->store != CELD_STORE_8_BIT_SRGB)
    return celd_quantize_alpha (layers, value);
  while (least < most)
    {
      int middle = (least + most) / 2;

      if (value < layers->code_limit[middle])
        most = middle;
      else
        least = middle + 1;
    }
  return layers->code_value[least];
}
