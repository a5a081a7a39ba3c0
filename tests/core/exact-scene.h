/* Small scenes for the tests of the exact program: a picture, scribbles and relations as text.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef EXACT_SCENE_H
#define EXACT_SCENE_H

#include "base/base.h"
#include "check.h"

typedef struct
{
  CeldPlane     ink, depth;
  CeldLabels    seeds;
  CeldPalette   palette;
  CeldRelations relations;
  CeldSettings  settings;
  CeldExact     exact;
  CeldProblems  problems;
} Scene;

/* Colours: label 1 is #010000, label 2 #020000, ... */
static inline void
scene_palette (Scene *s, size_t n)
{
  celd_palette_clear (&s->palette);
  s->palette = (CeldPalette) { calloc (n + 1, sizeof (CeldRegion)), n };
  for (size_t k = 0; k < n; k++)
    s->palette.item[k] = (CeldRegion) { .colour = { (uint8_t) (k + 1), 0, 0, 255 } };
}

static inline void
scene_relate (Scene *s, const char *text)
{
  celd_relations_clear (&s->relations);
  CHECK (celd_relations_parse (text, &s->relations, NULL) == CELD_OK);
}

/* In one picture: '#' is ink, a capital the scribble of that label on paper, anything else paper. */
static inline Scene
scene_new (const char *const *rows, const char *relations)
{
  Scene    s = { .ink = art_plane (rows), .seeds = art_labels (rows), .settings = celd_settings () };
  int      w = s.ink.width, h = s.ink.height;
  uint32_t n = 0;

  s.depth = (CeldPlane) { w, h, (size_t) w, calloc ((size_t) (w * h), sizeof (float)) };
  for (int i = 0; i < w * h; i++)
    n = s.seeds.data[i] > n ? s.seeds.data[i] : n;
  scene_palette (&s, n);
  scene_relate (&s, relations);
  s.settings.encoding  = CELD_ENCODING_RANK;
  s.settings.tolerance = 1e-6f;
  return s;
}

static inline void
scene_free (Scene *s)
{
  free (s->ink.data);
  free (s->depth.data);
  free (s->seeds.data);
  celd_palette_clear (&s->palette);
  celd_relations_clear (&s->relations);
  celd_exact_clear (&s->exact);
  celd_problems_clear (&s->problems);
}

static inline CeldStatus
scene_solve (Scene *s, const CeldHost *host)
{
  s->problems.n = 0;
  return celd_depth_exact (&s->ink, &s->seeds, &s->palette, &s->relations, &s->settings, host, &s->depth, &s->exact,
                           &s->problems);
}

static inline double
depth_at (const Scene *s, int x, int y)
{
  return (double) CELD_AT (&s->depth, x, y);
}

#endif
