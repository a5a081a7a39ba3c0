/* A layer of scribbles whose colours are counted, written as text art.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef READING_H
#define READING_H

#include "input/input.h"
#include "check.h"

/* 'A' is colour 1, which has the channels rgb[0], and so on; '.' is colour 0, transparent.  All pixels count as core
 * and opaque. */
static inline CeldScribbleLayer
reading_new (const char *const *art, int (*rgb)[3], size_t n)
{
  CeldLabels        ids = art_labels (art);
  CeldScribbleLayer r = {
    .width = ids.width, .height = ids.height, .pixels = (size_t) ids.width * (size_t) ids.height, .id = ids.data,
    .colour = calloc (n + 1, sizeof (CeldScribbleColour)), .n = n + 1, .radius = 3,
  };

  for (size_t k = 1; k <= n; k++)
    memcpy (r.colour[k].channel, rgb[k - 1], sizeof *rgb);
  for (size_t p = 0; p < r.pixels; p++)
    {
      CeldScribbleColour *c = &r.colour[r.id[p]];

      c->interior = c->solid = ++c->pixels;
      c->opacity += 255;
    }
  return r;
}

static inline void
reading_clear (CeldScribbleLayer *r)
{
  free (r->id);
  free (r->colour);
  celd_free (r->cluster);
  celd_free (r->head);
}

#endif
