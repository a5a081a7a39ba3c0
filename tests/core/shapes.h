/* Scenes of shapes laid over each other, each with its outline: what is in front is known.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef SHAPES_H
#define SHAPES_H

#include "image/image.h"
#include "check.h"

#define MOST_SHAPES 32

/* Everything within `radius` of the piece from (x0,y0) to (x1,y1): a disc, a limb; an infinite radius is the page. */
typedef struct { double x0, y0, x1, y1, radius; } Shape;

/* Shape k has label k + 1; the first one is the background. */
typedef struct
{
  CeldPlane   ink;
  CeldLabels  labels;
  CeldPalette palette;
  CeldRegion  region[MOST_SHAPES];
} Scene;

static inline double
shape_outside (const Shape *s, double x, double y)
{
  double dx = s->x1 - s->x0, dy = s->y1 - s->y0, square = dx * dx + dy * dy;
  double t = square > 0 ? fmax (0, fmin (1, ((x - s->x0) * dx + (y - s->y0) * dy) / square)) : 0;

  return hypot (x - s->x0 - t * dx, y - s->y0 - t * dy) - s->radius;
}

/* Labels meet in the middle of the ink, as those of a segmentation do; without a pixel of paper a shape has none. */
static inline void
scene_label (Scene *s, const uint32_t *owner)
{
  size_t   pixels = (size_t) s->ink.width * (size_t) s->ink.height;
  uint8_t *paper = malloc (pixels);
  int32_t *squared = malloc (pixels * sizeof *squared), *nearest = malloc (pixels * sizeof *nearest);

  for (size_t p = 0; p < pixels; p++)
    paper[p] = s->ink.data[p] >= 0.5f;
  CHECK (celd_nearest (s->ink.width, s->ink.height, paper, NULL, squared, nearest) == CELD_OK);
  for (size_t p = 0; p < pixels; p++)
    {
      s->labels.data[p] = owner[nearest[p]];
      s->region[s->labels.data[p] - 1].area++;
    }
  free (paper);
  free (squared);
  free (nearest);
}

/* Back to front, lines of this width. */
static inline void
scene_open (int width, int height, const Shape *shape, size_t n, double line, Scene *s)
{
  uint32_t *owner = malloc ((size_t) width * (size_t) height * sizeof *owner);

  memset (s, 0, sizeof *s);
  CHECK (celd_plane_new (width, height, &s->ink) == CELD_OK);
  CHECK (celd_labels_new (width, height, &s->labels) == CELD_OK);
  s->palette = (CeldPalette) { s->region, n };
  for (int p = 0; p < width * height; p++)
    {
      s->ink.data[p] = 1;
      owner[p]       = 1;
      for (size_t k = 0; k < n; k++)
        {
          double out = shape_outside (&shape[k], p % width + 0.5, p / width + 0.5);
          double inside = fmin (1, fmax (0, 0.5 - line / 2 - out)), ink = fmin (1, fmax (0, out - line / 2 + 0.5));

          s->ink.data[p] = (float) fmin (1, fmax (inside, ink * (double) s->ink.data[p]));
          if (out < 0)
            owner[p] = (uint32_t) k + 1;
        }
    }
  for (size_t k = 0; k < n; k++)
    s->region[k] = (CeldRegion) { .colour = { (uint8_t) (k * 7 + 1), 0, 0, 255 }, .background = k == 0 };
  scene_label (s, owner);
  free (owner);
}

static inline void
scene_close (Scene *s)
{
  free (s->ink.data);
  free (s->labels.data);
}

static const Shape page = { 0, 0, 0, 0, INFINITY };

/* The label at an end of a relation. */
static inline uint32_t
scene_at (const Scene *s, const CeldTerm *term)
{
  return CELD_AT (&s->labels, (int) term->x, (int) term->y);
}

/* The confidence with which a is said to be in front of b; negative if b is in front of a, 0 if nothing is said. */
static inline double
scene_confidence (const Scene *s, const CeldRelations *suggested, uint32_t a, uint32_t b)
{
  double confidence = 0;

  for (size_t i = 0; i < suggested->n; i++)
    {
      uint32_t nearer = scene_at (s, &suggested->item[i].nearer), farther = scene_at (s, &suggested->item[i].farther);

      if (nearer == a && farther == b)
        confidence = suggested->item[i].weight;
      if (nearer == b && farther == a)
        confidence = -suggested->item[i].weight;
    }
  return confidence;
}

#endif
