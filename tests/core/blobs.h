/* Cartoons with known owners: blobs drawn back to front, each with a pen of its own over what lies behind it.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef BLOBS_H
#define BLOBS_H

#include "base/base.h"
#include "check.h"

#include <math.h>

enum { BLOB_CORNERS = 96, BLOB_MOST = 12 };

/* Label 1 is the page, blob k is label k + 1, the last is nearest. */
typedef struct
{
  CeldPlane  ink;
  CeldLabels labels;            /* of ink: of what lies behind it, as if the segmentation had cut at its near side */
  CeldLabels owner;
  uint32_t   level[BLOB_MOST + 1];
  size_t     n;                 /* labels */
} Blobs;

typedef struct { double x[BLOB_CORNERS], y[BLOB_CORNERS], width[BLOB_CORNERS]; } Blob;

static inline void
blobs_new (int width, int height, Blobs *b)
{
  *b = (Blobs) { .n = 1 };
  CHECK (celd_plane_new (width, height, &b->ink) == CELD_OK);
  CHECK (celd_labels_new (width, height, &b->labels) == CELD_OK);
  CHECK (celd_labels_new (width, height, &b->owner) == CELD_OK);
  for (int i = 0; i < width * height; i++)
    {
      b->ink.data[i]    = 1;
      b->labels.data[i] = b->owner.data[i] = 1;
    }
}

static inline void
blobs_free (Blobs *b)
{
  celd_free (b->ink.data);
  celd_free (b->labels.data);
  celd_free (b->owner.data);
}

/* How far (x,y) is outside the blob, < 0 inside, and how wide its pen is at the nearest place. */
static inline double
blob_distance (const Blob *blob, double x, double y, double *width)
{
  double nearest = INFINITY;
  bool   inside = false;

  *width = blob->width[0];

  for (int i = 0, j = BLOB_CORNERS - 1; i < BLOB_CORNERS; j = i++)
    {
      double ux = blob->x[i] - blob->x[j], uy = blob->y[i] - blob->y[j], px = x - blob->x[j], py = y - blob->y[j];
      double s = (px * ux + py * uy) / (ux * ux + uy * uy), t = s < 0 ? 0 : s > 1 ? 1 : s;
      double vx = px - t * ux, vy = py - t * uy, d = vx * vx + vy * vy;

      if (d < nearest)
        {
          nearest = d;
          *width  = blob->width[j] + t * (blob->width[i] - blob->width[j]);
        }
      if ((blob->y[i] > y) != (blob->y[j] > y) && x < blob->x[j] + (y - blob->y[j]) / uy * ux)
        inside = !inside;
    }
  return inside ? -sqrt (nearest) : sqrt (nearest);
}

/* Draws it over what there is, antialiased. */
static inline void
blobs_draw (Blobs *b, const Blob *blob)
{
  uint32_t label = (uint32_t) ++b->n;
  double   left = INFINITY, top = INFINITY, right = -INFINITY, bottom = -INFINITY;

  b->level[label - 1] = label - 1;
  for (int i = 0; i < BLOB_CORNERS; i++)
    {
      left   = fmin (left, blob->x[i] - blob->width[i]);
      top    = fmin (top, blob->y[i] - blob->width[i]);
      right  = fmax (right, blob->x[i] + blob->width[i]);
      bottom = fmax (bottom, blob->y[i] + blob->width[i]);
    }
  for (int y = (int) fmax (top - 1, 0); y < b->ink.height && y < bottom + 1; y++)
    for (int x = (int) fmax (left - 1, 0); x < b->ink.width && x < right + 1; x++)
      {
        double width, away = blob_distance (blob, x + 0.5, y + 0.5, &width);
        double ink = fmin (fmax (width / 2 - fabs (away) + 0.5, 0), 1), fill = fmin (fmax (0.5 - away, 0), 1);
        float *value = &CELD_AT (&b->ink, x, y);

        *value = (float) (((double) *value * (1 - fill) + fill) * (1 - ink));
        if (away < width / 2)
          CELD_AT (&b->owner, x, y) = label;
        if (away < -width / 2)
          CELD_AT (&b->labels, x, y) = label;
      }
}

/* A blob somewhere on the page whose pen varies by the share `vary`. */
static inline void
blobs_add (Blobs *b, uint32_t *seed, double pen, double vary)
{
  Blob   blob;
  double size = fmin (b->ink.width, b->ink.height), radius = size * (0.15 + 0.001 * check_random (seed, 130)) + pen;
  double x = b->ink.width * (0.1 + 0.001 * check_random (seed, 800));
  double y = b->ink.height * (0.1 + 0.001 * check_random (seed, 800)), swing[3], phase[4];

  for (int k = 0; k < 3; k++)
    swing[k] = 0.001 * check_random (seed, 200);
  for (int k = 0; k < 4; k++)
    phase[k] = 0.01 * check_random (seed, 628);
  for (int i = 0; i < BLOB_CORNERS; i++)
    {
      double t = 2 * 3.14159265358979 * i / BLOB_CORNERS, r = radius;

      for (int k = 0; k < 3; k++)
        r += radius * swing[k] * cos ((k + 2) * t + phase[k]);
      blob.x[i]     = x + r * cos (t);
      blob.y[i]     = y + r * sin (t);
      blob.width[i] = pen * (1 + vary * cos (2 * t + phase[3]));
    }
  blobs_draw (b, &blob);
}

/* A colour for the paper of a label, 0 .. 255. */
static inline void
blobs_fill (uint32_t label, double colour[3])
{
  static const uint8_t fills[][3] = { { 240, 240, 245 }, { 220, 90, 80 }, { 90, 190, 90 }, { 90, 110, 220 },
                                      { 220, 190, 70 }, { 200, 90, 210 }, { 80, 200, 210 } };

  for (int c = 0; c < 3; c++)
    colour[c] = fills[(label - 1) % 7][c];
}

/* Lines are darker shades of their owner's paper. */
static inline void
blobs_shade (uint32_t label, double colour[3])
{
  blobs_fill (label, colour);
  for (int c = 0; c < 3; c++)
    colour[c] *= 0.4;
}

/* The page in colours, by labels on paper and by owners in ink; free its data with celd_free. */
static inline CeldPaint
blobs_paint (const Blobs *b, void (*fill_of) (uint32_t label, double colour[3]),
             void (*line_of) (uint32_t label, double colour[3]))
{
  int       w = b->ink.width, h = b->ink.height;
  CeldPaint art = { w, h, (size_t) w, celd_alloc ((size_t) w * (size_t) h, 4) };

  for (int p = 0; art.data && p < w * h; p++)
    {
      double fill[3], line[3], ink = 1 - (double) b->ink.data[p];

      fill_of (b->labels.data[p], fill);
      line_of (b->owner.data[p], line);
      for (int c = 0; c < 3; c++)
        art.data[4 * p + c] = (uint8_t) (fill[c] * (1 - ink) + line[c] * ink + 0.5);
      art.data[4 * p + 3] = 255;
    }
  CHECK (art.data);
  return art;
}

/* The share of ink pixels that are given to their owner. */
static inline double
blobs_score (const Blobs *b, const CeldOwnership *own)
{
  size_t ink = 0, right = 0;

  for (int y = 0; y < b->ink.height; y++)
    for (int x = 0; x < b->ink.width; x++)
      if (CELD_AT (&b->ink, x, y) < 0.5f)
        {
          bool more = CELD_AT (&own->coverage, x, y) >= 0.5f;

          ink++;
          right += CELD_AT (more ? &own->owner : &own->under, x, y) == CELD_AT (&b->owner, x, y);
        }
  return (double) right / (double) (ink ? ink : 1);
}

#endif
