/* A drawing of lines with gaps and a labelling of it made by hand, for the tests of closures.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef SCENE_H
#define SCENE_H

#include "check.h"
#include "image/image.h"
#include "segment/basins.h"
#include "segment/task.h"

#define MOST_LABELS 8

/* Basin k is label k + 1, in however many places it is. */
typedef struct
{
  CeldPlane       ink;
  CeldLabels      labels;
  CeldBasins      basins;
  CeldSegmentTask task;
  uint32_t        label[MOST_LABELS];
  CeldClosures    closures;
  CeldPatches     patches;
} Scene;

/* Paper, all of label 1. */
static inline void
scene_open (int width, int height, Scene *s)
{
  *s = (Scene) { 0 };
  CHECK (celd_plane_new (width, height, &s->ink) == CELD_OK);
  CHECK (celd_labels_new (width, height, &s->labels) == CELD_OK);
  CHECK (celd_seed_rows_new (width, height, &s->task.seeds) == CELD_OK);
  for (int p = 0; p < width * height; p++)
    {
      s->ink.data[p]    = 1;
      s->labels.data[p] = 1;
    }
}

/* '#' is ink of label 1, a letter paper. */
static inline void
scene_read (const char *const *art, Scene *s)
{
  CeldPlane  ink = art_plane (art);
  CeldLabels labels = art_labels (art);

  scene_open (ink.width, ink.height, s);
  for (int p = 0; p < ink.width * ink.height; p++)
    {
      s->ink.data[p]    = ink.data[p];
      s->labels.data[p] = labels.data[p] ? labels.data[p] : 1;
    }
  free (ink.data);
  free (labels.data);
}

/* An antialiased line, arc by arc: everything nearer than width / 2 to a piece. */
static inline void
scene_line (Scene *s, CeldPlace p, CeldPlace q, double width)
{
  double x = q.x - p.x, y = q.y - p.y;

  for (int v = 0; v < s->ink.height; v++)
    for (int u = 0; u < s->ink.width; u++)
      {
        double t = ((u + 0.5 - p.x) * x + (v + 0.5 - p.y) * y) / (x * x + y * y), k = fmin (fmax (t, 0), 1);
        double ink = hypot (u + 0.5 - p.x - k * x, v + 0.5 - p.y - k * y) - width / 2 + 0.5;

        CELD_AT (&s->ink, u, v) = fminf (CELD_AT (&s->ink, u, v), (float) fmin (fmax (ink, 0), 1));
      }
}

static inline void
scene_boundary (Scene *s, int x, int y, bool south)
{
  uint32_t           a = CELD_AT (&s->labels, x, y) - 1, b = CELD_AT (&s->labels, x + !south, y + south) - 1, i;
  CeldBasinBoundary *boundary = s->basins.boundary;

  if (a == b || CELD_AT (&s->ink, x, y) < 0.5f || CELD_AT (&s->ink, x + !south, y + south) < 0.5f)
    return;
  i = a < b ? a * MOST_LABELS + b : b * MOST_LABELS + a; /* the table is filled without gaps only by scene_find */
  if (!boundary[i].opening++)
    boundary[i] = (CeldBasinBoundary) { .a = i / MOST_LABELS, .b = i % MOST_LABELS, .opening = 1, .saddle = 1,
                                          .south = south, .x = x, .y = y, .cost = 1 };
}

/* The basins, each border with the first of its passes in reading order as the pair of its saddle.  Basins meet in as
 * many gaps as labels do. */
static inline void
scene_basins (Scene *s)
{
  int         w = s->ink.width, h = s->ink.height;
  size_t      n = 0;
  CeldBasins *b = &s->basins;

  *b = (CeldBasins) { .width = w, .height = h, .n = MOST_LABELS, .stroke = celd_stroke_width (&s->ink) };
  b->row    = malloc (((size_t) h + 1) * sizeof *b->row);
  b->run    = malloc ((size_t) w * (size_t) h * sizeof *b->run);
  b->boundary = calloc (MOST_LABELS * MOST_LABELS, sizeof *b->boundary);
  for (int y = 0; y < h; y++)
    {
      b->row[y] = n;
      for (int x = 0; x < w; x++)
        {
          uint32_t label = CELD_AT (&s->labels, x, y);

          if (!x || label != CELD_AT (&s->labels, x - 1, y))
            b->run[n++] = (CeldBasinRun) { x, label - 1 };
          if (x + 1 < w)
            scene_boundary (s, x, y, false);
          if (y + 1 < h)
            scene_boundary (s, x, y, true);
        }
    }
  b->row[h] = n;
  for (size_t i = 0; i < MOST_LABELS * MOST_LABELS; i++)
    if (b->boundary[i].opening)
      b->boundary[b->n_boundaries++] = b->boundary[i];
  for (uint32_t k = 0; k < MOST_LABELS; k++)
    s->label[k] = k + 1;
  s->task.ink    = &s->ink;
  s->task.basins = b;
}

static inline CeldStatus
scene_find (Scene *s, const CeldPatches *windows)
{
  static const CeldPatches none = { 0 };

  scene_basins (s);
  return celd_closures_find (&s->task, s->label, &s->labels, windows ? windows : &none, NULL, &s->closures,
                             &s->patches);
}

/* Patches keep their promise: paper only, between labels that meet on paper, no pixel twice, no seed. */
static inline void
scene_apply (Scene *s)
{
  int      w = s->ink.width, h = s->ink.height, bad = 0;
  uint8_t *seen = calloc ((size_t) w * (size_t) h, 1);

  for (size_t i = 0; i < s->patches.n; i++)
    for (int x = s->patches.item[i].x; x < s->patches.item[i].end; x++)
      {
        int      y = s->patches.item[i].y;
        uint32_t new = s->patches.item[i].label, *label = &CELD_AT (&s->labels, x, y);
        uint32_t seed = celd_seed_rows_at (&s->task.seeds, x, y);
        bool     pair = false;

        for (size_t k = 0; k < s->basins.n_boundaries; k++)
          pair |= s->basins.boundary[k].a + 1 == (*label < new ? *label : new) &&
                  s->basins.boundary[k].b + 1 == (*label < new ? new : *label);
        bad += x < 0 || y < 0 || x >= w || y >= h || seen[y * w + x]++ || CELD_AT (&s->ink, x, y) < 0.5f || !pair ||
               (seed && seed != new);
        *label = new;
      }
  CHECK (bad == 0);
  free (seen);
}

static inline void
scene_close (Scene *s)
{
  free (s->ink.data);
  free (s->labels.data);
  free (s->basins.row);
  free (s->basins.run);
  free (s->basins.boundary);
  celd_seed_rows_clear (&s->task.seeds);
  celd_closures_clear (&s->closures);
  celd_patches_clear (&s->patches);
}

/* How far the places of a closure are from the line through two others, at most. */
static inline double
scene_deviation (const CeldClosure *closure, CeldPlace p, CeldPlace q)
{
  double most = 0;

  for (size_t i = 0; i < closure->n; i++)
    most = fmax (most, fabs ((closure->place[i].x - p.x) * (q.y - p.y) - (closure->place[i].y - p.y) * (q.x - p.x)) /
                 hypot (q.x - p.x, q.y - p.y));
  return most;
}

#endif
