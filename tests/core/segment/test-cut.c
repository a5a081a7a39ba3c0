/* Cuts of a region between two points, against the exact max-flow of all its pixels.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "image/image.h"
#include "segment/basins.h"
#include "segment/splits.h"
#include "segment/task.h"
#include "solve/maxflow.h"

enum { SIDE = 120, PIXELS = SIDE * SIDE };

typedef struct
{
  CeldPlane       ink;
  CeldSettings    settings;
  CeldBasins      basins;
  CeldSegmentTask task;
  uint32_t        basin[PIXELS], at[PIXELS];
  uint8_t         mark[PIXELS];
  CeldCut         cut;
} Page;

/* The whole page is one region of label 1. */
static void
page_open (Page *page, CeldPlane ink, int x, int y, int u, int v)
{
  uint32_t label;
  double   reach;

  memset (page, 0, sizeof *page);
  page->ink      = ink;
  page->settings = celd_settings ();
  CHECK (celd_basins_new (&page->ink, page->settings.ink_threshold, NULL, &page->basins) == CELD_OK);
  page->task = (CeldSegmentTask) {
    .settings = &page->settings, .ink = &page->ink, .basins = &page->basins, .soft_cost = 1,
  };
  CHECK (celd_seed_rows_new (ink.width, ink.height, &page->task.seeds) == CELD_OK);
  celd_task_add_label (&page->task, (CeldRegion) { .colour = { 1, 2, 3, 255 } }, &label);
  page->cut = (CeldCut) {
    .task = &page->task, .label = 1, .right = ink.width - 1, .bottom = ink.height - 1,
    .end = { { true, x, y }, { true, u, v } }, .basin = page->basin, .n = page->basins.n, .at = page->at,
    .mark = page->mark,
  };
  reach = CELD_DISC_RANGE * celd_relation_end_distance (page->cut.end[0], page->cut.end[1]);
  for (int i = 0; i < 2; i++)
    page->cut.discs[i] = celd_seed_discs_find (&page->task, page->cut.end[i], reach, INFINITY);
  for (uint32_t k = 0; k < page->basins.n; k++)
    {
      page->basin[k] = k;
      page->at[k]    = k + 1;
    }
  memset (page->mark, CELD_INSIDE, sizeof page->mark);
}

static void
page_close (Page *page)
{
  free (page->ink.data);
  celd_basins_clear (&page->basins);
  celd_seed_rows_clear (&page->task.seeds);
  celd_palette_clear (&page->task.palette);
}

#define MARK(x, y) page.mark[(y) * page.ink.width + (x)]

/* V of all edges, as exact.c has it. */
static void
weigh (const Page *page, int32_t *east, int32_t *south)
{
  int      w = page->ink.width, h = page->ink.height;
  uint8_t *paper = malloc ((size_t) (w * h));
  int32_t *depth = malloc ((size_t) (w * h) * sizeof *depth);

  for (int p = 0; p < w * h; p++)
    paper[p] = page->ink.data[p] >= 0.5f;
  celd_distance (w, h, paper, NULL, depth);
  for (int y = 0, p = 0; y < h; y++)
    for (int x = 0; x < w; x++, p++)
      {
        const float *ink = page->ink.data + p;

        east[p] = x + 1 < w
                ? celd_smoothness_cost (&page->basins.costs, ink[0], ink[1], depth[p], depth[p + 1],
                                        y == 0 || y == h - 1) : 0;
        south[p] = y + 1 < h
                 ? celd_smoothness_cost (&page->basins.costs, ink[0], ink[w], depth[p], depth[p + w],
                                        x == 0 || x == w - 1) : 0;
      }
  free (paper);
  free (depth);
}

static int64_t
energy (const Page *page, const int32_t *east, const int32_t *south)
{
  int     w = page->ink.width, h = page->ink.height;
  int64_t sum = 0;

  for (int y = 0, p = 0; y < h; y++)
    for (int x = 0; x < w; x++, p++)
      {
        if (x + 1 < w && page->mark[p] != page->mark[p + 1])
          sum += east[p];
        if (y + 1 < h && page->mark[p] != page->mark[p + w])
          sum += south[p];
      }
  return sum;
}

/* The least energy there is with these discs. */
static int64_t
least_energy (const Page *page, const int32_t *east, const int32_t *south)
{
  int      w = page->ink.width, h = page->ink.height, x, end;
  int32_t *terminal = calloc ((size_t) (w * h), sizeof *terminal);
  uint8_t *side = malloc ((size_t) (w * h));
  int64_t  flow = 0;

  for (int k = 0; k < 4; k++)
    for (int y = 0; y < h; y++)
      if (celd_seed_disc_row (&page->cut.discs[k / 2].disc[k % 2], y, &x, &end))
        for (x = x < 0 ? 0 : x; x < end && x < w; x++)
          terminal[y * w + x] = k < 2 ? (1 << 30) - 1 : 1 - (1 << 30);
  CHECK (celd_maxflow (w, h, east, south, terminal, NULL, side, &flow) == CELD_OK);
  free (terminal);
  free (side);
  return flow;
}

/* A page with random open lines, some of them grey. */
static CeldPlane
scrawl (uint32_t *random, int lines)
{
  CeldPlane ink = { SIDE, SIDE, SIDE, malloc (PIXELS * sizeof (float)) };

  for (int p = 0; p < PIXELS; p++)
    ink.data[p] = 1;
  for (int i = 0; i < lines; i++)
    {
      double x = check_random (random, SIDE), y = check_random (random, SIDE), a = check_random (random, 628) / 100.0;
      float  value = check_random (random, 4) ? 0 : 0.3f;

      for (int k = (int) check_random (random, 100); k > 0; k--)
        {
          for (int v = 0; v < 3; v++)
            for (int u = 0; u < 3; u++)
              if (x + u >= 0 && x + u < SIDE && y + v >= 0 && y + v < SIDE)
                CELD_AT (&ink, (int) x + u, (int) y + v) = value;
          x += cos (a);
          y += sin (a);
          a += ((int) check_random (random, 21) - 10) / 50.0;
          if (x < 0 || y < 0)
            break;
        }
    }
  return ink;
}

/* The cut on squares and bands costs hardly more than the least one, and both ends have their discs. */
static void
a_cut_costs_little_more_than_the_exact_one (void)
{
  static Page    page;
  static int32_t east[PIXELS], south[PIXELS];
  uint32_t       random = 7;
  double         sum = 0, least_sum = 0;

  for (int i = 0; i < 60; i++)
    {
      CeldPlane ink = scrawl (&random, 2 + i % 12);
      int       x = (int) check_random (&random, SIDE), y = (int) check_random (&random, SIDE), kept = -2;
      int       u = (int) check_random (&random, SIDE), v = (int) check_random (&random, SIDE);
      int64_t   found, least;

      if (!celd_paper_near (&ink, 4, &x, &y) || !celd_paper_near (&ink, 4, &u, &v) || hypot (x - u, y - v) < 4)
        {
          free (ink.data);
          continue;
        }
      page_open (&page, ink, x, y, u, v);
      weigh (&page, east, south);
      least = least_energy (&page, east, south);
      CHECK (celd_cut_pixels (&page.cut, NULL, &kept) == CELD_OK && kept >= 0);
      found = energy (&page, east, south);
      CHECK (MARK (x, y) == CELD_NEAR_FIRST && MARK (u, v) == CELD_NEAR_SECOND);
      CHECK (found >= least && (double) found <= 1.25 * (double) least);
      for (int p = 0; p < PIXELS; p++)
        CHECK (page.mark[p] == CELD_NEAR_FIRST || page.mark[p] == CELD_NEAR_SECOND);
      sum += (double) found;
      least_sum += (double) least;
      page_close (&page);
    }
  CHECK (least_sum > 0 && sum <= 1.02 * least_sum);
}

/* What the region does not hold stays outside; what does not join the ends is outside afterwards. */
static void
pixels_outside_the_region_stay_outside (void)
{
  static Page              page;
  static const char *const art[] = {
    "...........................", "...........................", "...........................",
    "...........................", "...........................", NULL };
  int                      kept = -2;

  page_open (&page, art_plane (art), 2, 2, 10, 2);
  for (int y = 0; y < 5; y++)
    {
      MARK (15, y) = MARK (16, y) = CELD_OUTSIDE;
      MARK (6, y) = y == 2 ? CELD_INSIDE : CELD_OUTSIDE;
    }
  CHECK (celd_cut_pixels (&page.cut, NULL, &kept) == CELD_OK && kept == 1); /* no seed: the second end */
  for (int y = 0; y < 5; y++)
    for (int x = 0; x < 27; x++)
      CHECK (MARK (x, y) == (x > 14 || (x == 6 && y != 2) ? CELD_OUTSIDE : x < 6 ? CELD_NEAR_FIRST
                             : x > 6 ? CELD_NEAR_SECOND : MARK (6, 2)));
  memset (page.mark, CELD_INSIDE, 27 * 5);
  for (int y = 0; y < 5; y++)
    MARK (6, y) = CELD_OUTSIDE;
  CHECK (celd_cut_pixels (&page.cut, NULL, &kept) == CELD_OK && kept == -1);
  CHECK (MARK (2, 2) == CELD_INSIDE && MARK (10, 2) == CELD_INSIDE);
  page_close (&page);
}

/* Seeds decide which end is kept, along ways that go round lines. */
static void
the_end_nearer_to_the_seeds_keeps_the_label (void)
{
  static Page              page;
  static const char *const art[] = {
    "...........................", "...........................", "...........................",
    "...........................", "...........................", "#########################..",
    "#########################..", "...........................", "...........................",
    "...........................", "...........................", "...........................", NULL };
  int                      kept = -2;

  for (int i = 0; i < 2; i++)
    {
      page_open (&page, art_plane (art), i ? 2 : 23, i ? 9 : 2, i ? 23 : 2, i ? 2 : 9);
      CHECK (celd_seed_rows_paint (&page.task.seeds, 3, 2, 5, 1) == CELD_OK); /* above the line, on the left */
      CHECK (celd_cut_pixels (&page.cut, NULL, &kept) == CELD_OK && kept == i);
      CHECK (MARK (3, 3) == (i ? CELD_NEAR_SECOND : CELD_NEAR_FIRST));
      page_close (&page);
    }
}

/* Between whole basins: at the narrow place, seeds on either side of it. */
static void
whole_basins_are_cut_at_the_waist (void)
{
  static Page              page;
  static uint8_t           side[PIXELS];
  static const char *const art[] = {
    "#########################", "#...........#...........#", "#...........#...........#", "#...........#...........#",
    "#...........#...........#", "#.......................#", "#.......................#", "#...........#...........#",
    "#...........#...........#", "#...........#...........#", "#...........#...........#", "#########################",
    NULL };
  int                      kept = -2;

  page_open (&page, art_plane (art), 5, 5, 19, 5);
  CHECK (celd_seed_rows_paint (&page.task.seeds, 3, 18, 20, 1) == CELD_OK);
  CHECK (celd_cut_basins (&page.cut, NULL, side, &kept) == CELD_OK && kept == 1);
  for (int y = 1; y < 11; y++)
    for (int x = 1; x < 24; x++)
      if (x != 12 && art[y][x] == '.')
        CHECK (side[celd_basin_at (&page.basins, x, y)] == (x < 12 ? CELD_NEAR_FIRST : CELD_NEAR_SECOND));
  page_close (&page);
}

int
main (void)
{
  RUN (a_cut_costs_little_more_than_the_exact_one);
  RUN (pixels_outside_the_region_stay_outside);
  RUN (the_end_nearer_to_the_seeds_keeps_the_label);
  RUN (whole_basins_are_cut_at_the_waist);
  return DONE;
}
