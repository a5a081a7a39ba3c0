/* The task of a segmentation, written as text art, for the tests of its single steps.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef SKETCH_H
#define SKETCH_H

#include "check.h"
#include "image/image.h"
#include "segment/basins.h"
#include "segment/task.h"

typedef struct { CeldPlane ink; CeldSettings settings; CeldBasins basins; CeldSegmentTask task; } Sketch;

/* The basin of each pixel: of digit d it is d - 1, of '0' the last; ink goes with what stands left of it in its row, or
 * else with the first to the right, or else with basin 0. */
static inline uint32_t
sketch_basin (const char *row, int x, uint32_t solid)
{
  int at = x;

  while (at > 0 && row[at] == '#')
    at--;
  while (row[at] == '#')
    at++;
  return row[at] == '0' ? solid : row[at] ? (uint32_t) (row[at] - '1') : 0;
}

/* One basin a digit; without their borders. */
static inline void
sketch_basins (const char *const *paper, const CeldPlane *ink, float threshold, CeldBasins *b)
{
  int      w = ink->width, h = ink->height;
  size_t   n_pixels = (size_t) w * (size_t) h, n_runs = 0;
  uint32_t digits = 0, solid = 0;
  int32_t *squared = malloc (n_pixels * sizeof *squared);
  uint8_t *inked = malloc (n_pixels);

  for (int y = 0; y < h; y++)
    for (int x = 0; x < w; x++)
      {
        solid |= paper[y][x] == '0';
        digits = paper[y][x] > '0' && (uint32_t) (paper[y][x] - '0') > digits ? (uint32_t) (paper[y][x] - '0') : digits;
        inked[y * w + x] = ink->data[y * w + x] < 0.5f;
      }
  if (!digits && !solid)
    solid = 1;
  CHECK (celd_distance (w, h, inked, NULL, squared) == CELD_OK);
  *b = (CeldBasins) { .width = w, .height = h, .stroke = 1, .n = digits + solid,
                      .n_merged = digits + solid, .n_enclosures = digits, .n_components = digits };
  celd_smoothness_costs_new (w, h, threshold, &b->costs);
  b->basin = calloc (b->n, sizeof *b->basin);
  b->merged = calloc (b->n, sizeof *b->merged);
  b->enclosure  = calloc (b->n, sizeof *b->enclosure);
  b->component = calloc (b->n, sizeof *b->component);
  b->row   = calloc ((size_t) h + 1, sizeof *b->row);
  b->run   = calloc (n_pixels, sizeof *b->run);
  CHECK (celd_paper_new (ink, NULL, &b->paper) == CELD_OK);
  for (uint32_t k = 0; k < b->n; k++)
    {
      b->merged[k] = k + 1;
      b->enclosure[k]  = b->component[k] = k < digits ? k + 1 : 0;
      b->basin[k] = (CeldBasin) { .squared = -1, .solid = k >= digits };
    }
  for (int y = 0; y < h; y++)
    {
      b->row[y] = n_runs;
      for (int x = 0; x < w; x++)
        {
          uint32_t   k = sketch_basin (paper[y], x, digits);
          CeldBasin *basin = &b->basin[k];
          bool       own = basin->solid == (inked[y * w + x] != 0);

          basin->area++;
          if (own && squared[y * w + x] > basin->squared)
            {
              basin->squared = squared[y * w + x];
              basin->x = x;
              basin->y = y;
            }
          if (!x || b->run[n_runs - 1].basin != k)
            b->run[n_runs++] = (CeldBasinRun) { x, k };
        }
    }
  b->row[h] = n_runs;
  free (squared);
  free (inked);
}

/* `paper`: '#' is ink; a digit is paper and tells its basin, block, room and piece; '0' is ink too, of a solid basin.
 * `painted`: 'A' is a seed of label 1 and so on, of n labels with one opaque colour each.  Strokes of the drawing are
 * one pixel wide.  The sketch must not move. */
static inline void
sketch_open (Sketch *s, const char *const *paper, const char *const *painted, size_t n)
{
  CeldLabels seeds = art_labels (painted);
  uint32_t   label;

  *s = (Sketch) { .ink = art_plane (paper), .settings = celd_settings () };
  for (int p = 0; p < s->ink.width * s->ink.height; p++)
    s->ink.data[p] = s->ink.data[p] > 0;
  sketch_basins (paper, &s->ink, s->settings.ink_threshold, &s->basins);
  s->task = (CeldSegmentTask) { .settings = &s->settings, .ink = &s->ink, .basins = &s->basins };
  CHECK (celd_seed_rows_read (&seeds, &s->task.seeds) == CELD_OK);
  for (size_t k = 0; k < n; k++)
    celd_task_add_label (&s->task, (CeldRegion) { .colour = { (uint8_t) (40 * k), 0, 200, 255 } }, &label);
  for (int p = 0; p < seeds.width * seeds.height; p++)
    if (seeds.data[p])
      s->task.palette.item[seeds.data[p] - 1].seeds++;
  free (seeds.data);
}

static inline void
sketch_close (Sketch *s)
{
  free (s->ink.data);
  free (s->basins.basin);
  free (s->basins.merged);
  free (s->basins.enclosure);
  free (s->basins.component);
  free (s->basins.row);
  free (s->basins.run);
  free (s->basins.paper);
  celd_task_clear (&s->task);
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

/* The same of seeds. */
static inline int
seeds_differing (const CeldSeedRows *seeds, const char *const *art)
{
  CeldLabels labels = art_labels (art);
  int        n;

  celd_seed_rows_write (seeds, &labels);
  n = differing (&labels, art);
  free (labels.data);
  return n;
}

#endif
