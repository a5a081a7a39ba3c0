/* The canvas of a segmentation, written as text art, for the tests of its single steps.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CANVAS_H
#define CANVAS_H

#include "check.h"
#include "segment.h"

typedef struct { CeldPlane ink; CeldSettings settings; CeldCanvas canvas; } Sketch;

/* `paper`: '#' is ink, a digit the piece of paper, and the room too.  `painted`: 'A' is a seed of label 1 and so on, of
 * n labels with one opaque colour each.  Strokes of the drawing are one pixel wide.  The sketch must not move. */
static inline void
sketch_open (Sketch *s, const char *const *paper, const char *const *painted, size_t n)
{
  CeldLabels rooms = art_labels (paper);
  int        w = rooms.width, h = rooms.height;
  uint32_t   label;

  *s = (Sketch) { .ink = art_plane (paper), .settings = celd_settings () };
  s->canvas = (CeldCanvas) {
    .settings = &s->settings, .ink = &s->ink, .width = w, .height = h, .n = (size_t) w * (size_t) h, .stroke = 1,
    .seeds = art_labels (painted), .labels = art_labels (painted), .pieces = art_labels (paper), .rooms = rooms,
  };
  for (size_t k = 0; k < n; k++)
    celd_canvas_add (&s->canvas, (CeldRegion) { .colour = { (uint8_t) (40 * k), 0, 200, 255 } }, &label);
  for (size_t p = 0; p < s->canvas.n; p++)
    {
      s->ink.data[p] = rooms.data[p] > 0;
      if (rooms.data[p] > s->canvas.n_rooms)
        s->canvas.n_rooms = s->canvas.n_pieces = rooms.data[p];
      if (s->canvas.seeds.data[p])
        s->canvas.palette.item[s->canvas.seeds.data[p] - 1].seeds++;
    }
}

static inline void
sketch_close (Sketch *s)
{
  free (s->ink.data);
  free (s->canvas.seeds.data);
  free (s->canvas.labels.data);
  free (s->canvas.pieces.data);
  free (s->canvas.rooms.data);
  celd_palette_clear (&s->canvas.palette);
}

/* Pixels that are not as the art says. */
static inline int
differing (const CeldLabels *labels, const char *const *art)
{
  CeldLabels wanted = art_labels (art);
  int        n = 0;

  for (int y = 0; y < wanted.height; y++)
    for (int x = 0; x < wanted.width; x++)
      n += CELD_AT (labels, x, y) != CELD_AT (&wanted, x, y);
  free (wanted.data);
  return n;
}

#endif
