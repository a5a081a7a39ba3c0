/* Boundaries of lower energy: the energy never rises, no segment of a boundary is left that would gain, hard strokes
 * are obeyed, and two labels across a gap cost what exact cuts of all pixels do.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "image/image.h"
#include "segment/basins.h"
#include "segment/task.h"
#include "solve/maxflow.h"

typedef struct
{
  CeldPlane       ink;
  CeldSettings    settings;
  CeldBasins      basins;       /* what the costs are, no more */
  CeldSegmentTask task;
  int32_t        *depth;
} Scene;

/* ------------------------------------------------------------------ scenes */

static void
scene_open (Scene *s, CeldPlane ink, const CeldLabels *painted, size_t n, float hardness)
{
  size_t   pixels = (size_t) ink.width * (size_t) ink.height;
  uint8_t *paper = malloc (pixels);
  uint32_t label;

  *s = (Scene) { .ink = ink, .settings = celd_settings () };
  s->settings.hardness = hardness;
  s->basins = (CeldBasins) { .width = ink.width, .height = ink.height, .stroke = 2 };
  celd_smoothness_costs_new (ink.width, ink.height, s->settings.ink_threshold, &s->basins.costs);
  s->task = (CeldSegmentTask) { .settings = &s->settings, .ink = &s->ink, .basins = &s->basins };
  CHECK (celd_seed_rows_read (painted, &s->task.seeds) == CELD_OK);
  for (size_t k = 0; k < n; k++)
    celd_task_add_label (&s->task, (CeldRegion) { .colour = { (uint8_t) (40 * k), 0, 200, 255 } }, &label);
  celd_task_set_soft_cost (&s->task);
  s->depth = malloc (pixels * sizeof *s->depth);
  for (size_t p = 0; p < pixels; p++)
    paper[p] = celd_is_paper (ink.data[p]);
  CHECK (celd_distance (ink.width, ink.height, paper, NULL, s->depth) == CELD_OK);
  free (paper);
}

static void
scene_close (Scene *s)
{
  free (s->ink.data);
  free (s->depth);
  celd_seed_rows_clear (&s->task.seeds);
  celd_palette_clear (&s->task.palette);
}

/* The paper's energy; of hard seeds what no boundary can cost. */
static int64_t
energy (const Scene *s, const CeldLabels *l)
{
  int64_t sum = 0;
  int     w = l->width, h = l->height;

  for (int y = 0; y < h; y++)
    for (int x = 0; x < w; x++)
      {
        float    ink = CELD_AT (&s->ink, x, y);
        int32_t  depth = s->depth[y * w + x];
        uint32_t seed = celd_seed_rows_at (&s->task.seeds, x, y), label = CELD_AT (l, x, y);

        if (seed && seed != label)
          {
            int32_t vote = celd_task_data_cost (&s->task, seed);

            sum += vote == CELD_HARD ? INT64_C (1) << 40 : vote;
          }
        if (x + 1 < w && label != CELD_AT (l, x + 1, y))
          sum += celd_smoothness_cost (&s->basins.costs, ink, CELD_AT (&s->ink, x + 1, y), depth,
                                       s->depth[y * w + x + 1],
                                       y == 0 || y + 1 == h);
        if (y + 1 < h && label != CELD_AT (l, x, y + 1))
          sum += celd_smoothness_cost (&s->basins.costs, ink, CELD_AT (&s->ink, x, y + 1), depth,
                                       s->depth[(y + 1) * w + x],
                                       x == 0 || x + 1 == w);
      }
  return sum;
}

/* ------------------------------------------------------------------ random pictures */

static uint32_t
next_random (uint32_t *state)
{
  *state = *state * 1664525u + 1013904223u;  /* Numerical Recipes */
  return *state >> 16;
}

/* Lines here and there, rectangles of labels, and seeds. */
static void
random_scene (Scene *s, uint32_t *state, CeldLabels *l, float hardness)
{
  int        w = 5 + (int) (next_random (state) % 14), h = 5 + (int) (next_random (state) % 14);
  size_t     n = (size_t) w * (size_t) h;
  CeldPlane  ink = { w, h, (size_t) w, malloc (n * sizeof (float)) };
  CeldLabels painted = { w, h, (size_t) w, calloc (n, sizeof (uint32_t)) };

  *l = (CeldLabels) { w, h, (size_t) w, malloc (n * sizeof (uint32_t)) };
  for (size_t p = 0; p < n; p++)
    {
      ink.data[p] = next_random (state) % 3 ? 1 : (float) (next_random (state) % 5) / 8;
      l->data[p]  = 1;
      painted.data[p] = next_random (state) % 9 ? 0 : 1 + next_random (state) % 3;
    }
  for (int i = 0; i < 4; i++)
    {
      int      x = (int) next_random (state) % w, y = (int) next_random (state) % h;
      uint32_t label = 1 + next_random (state) % 3;

      for (int v = y; v < h && v < y + 6; v++)
        for (int u = x; u < w && u < x + 8; u++)
          CELD_AT (l, u, v) = label;
    }
  scene_open (s, ink, &painted, 3, hardness);
  free (painted.data);
}

/* Would some run gain by a step to either side?  Tried one by one, with the energy of the whole picture. */
static bool
some_run_gains (const Scene *s, CeldLabels *l)
{
  int64_t least = energy (s, l);
  int     w = l->width, h = l->height;
  bool    gains = false;

  for (int south = 0; south < 2; south++)
    for (int y = 0; y + south < h; y++)
      for (int x = 0; x + !south < w; x++)
        {
          uint32_t a = CELD_AT (l, x, y), b = CELD_AT (l, x + !south, y + south);
          int      n = 0;

          while (x + n * south + !south < w && y + n * !south + south < h && a != b &&
                 CELD_AT (l, x + n * south, y + n * !south) == a &&
                 CELD_AT (l, x + n * south + !south, y + n * !south + south) == b)
            n++;
          if (south ? x > 0 && CELD_AT (l, x - 1, y) == a && CELD_AT (l, x - 1, y + 1) == b
              : y > 0 && CELD_AT (l, x, y - 1) == a && CELD_AT (l, x + 1, y - 1) == b)
            n = 0;              /* not the first edge of its run */
          for (int side = 0; n && side < 2; side++)
            {
              int dx = side * !south, dy = side * south;

              for (int i = 0; i < n; i++)
                CELD_AT (l, x + dx + i * south, y + dy + i * !south) = side ? a : b;
              gains |= energy (s, l) < least;
              for (int i = 0; i < n; i++)
                CELD_AT (l, x + dx + i * south, y + dy + i * !south) = side ? b : a;
            }
        }
  return gains;
}

static void
random_boundaries_end_where_no_segment_gains (void)
{
  uint32_t state = 7;

  for (int round = 0; round < 60; round++)
    {
      Scene       s;
      CeldLabels  before, after;
      CeldPatches patches = { 0 };
      size_t      n;

      random_scene (&s, &state, &before, round % 3 ? 0.05f : 1);
      n     = (size_t) before.width * (size_t) before.height;
      after = before;
      after.data = malloc (n * sizeof *after.data);
      memcpy (after.data, before.data, n * sizeof *after.data);
      CHECK (celd_boundaries_refine (&s.task, NULL, &after, &patches) == CELD_OK);
      CHECK (energy (&s, &after) <= energy (&s, &before));
      CHECK (!some_run_gains (&s, &after));
      for (size_t i = 0; i < patches.n; i++)
        for (int x = patches.item[i].x; x < patches.item[i].end; x++)
          CELD_AT (&before, x, patches.item[i].y) = patches.item[i].label;
      CHECK (!memcmp (before.data, after.data, n * sizeof *after.data));
      celd_patches_clear (&patches);
      free (before.data);
      free (after.data);
      scene_close (&s);
    }
}

/* ------------------------------------------------------------------ gaps */

/* A ring with a gap on its right at some angle, one label inside, the other outside; parted by a vertical line far
 * from where the gap is narrowest. */
static void
a_boundary_across_a_gap_costs_what_the_exact_cut_does (void)
{
  for (int degrees = 0; degrees < 90; degrees += 15)
    {
      int         w = 80, h = 80;
      size_t      n = (size_t) w * (size_t) h;
      CeldPlane   ink = { w, h, (size_t) w, malloc (n * sizeof (float)) };
      CeldLabels  painted = { w, h, (size_t) w, calloc (n, sizeof (uint32_t)) };
      CeldLabels  l = { w, h, (size_t) w, malloc (n * sizeof (uint32_t)) };
      CeldLabels  exact = { w, h, (size_t) w, calloc (n, sizeof (uint32_t)) };
      CeldPatches patches = { 0 };
      Scene       s;

      for (int y = 0; y < h; y++)
        for (int x = 0; x < w; x++)
          {
            double dx = x + 0.5 - 40, dy = y + 0.5 - 40, radius = hypot (dx, dy);
            double angle = fabs (remainder (atan2 (dy, dx) - degrees * 3.14159265358979 / 180, 6.28318530717959));

            CELD_AT (&ink, x, y) = fabs (radius - 25) < 2 && angle > 0.25 ? 0 : 1;
            CELD_AT (&painted, x, y) = radius < 15 ? 1 : radius > 36 ? 2 : 0;
            CELD_AT (&l, x, y) = radius < (angle > 0.4 ? 25 : 19) ? 1 : 2;
          }
      scene_open (&s, ink, &painted, 2, 1);
      CHECK (celd_lazybrush_solve (&s.task, NULL, &exact) == CELD_OK);
      CHECK (energy (&s, &l) > energy (&s, &exact));
      CHECK (celd_boundaries_refine (&s.task, NULL, &l, &patches) == CELD_OK);
      NEAR ((double) energy (&s, &l) / (double) energy (&s, &exact), 1, 0.01);
      celd_patches_clear (&patches);
      free (painted.data);
      free (l.data);
      free (exact.data);
      scene_close (&s);
    }
}

int
main (void)
{
  RUN (random_boundaries_end_where_no_segment_gains);
  RUN (a_boundary_across_a_gap_costs_what_the_exact_cut_does);
  return DONE;
}
