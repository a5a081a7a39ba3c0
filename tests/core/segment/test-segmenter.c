/* A drawing whose strokes change one by one: every answer is that of a segmenter that never saw the earlier strokes,
 * and the rectangle of changes holds every change.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "image/image.h"
#include "segment/segment.h"

#define WIDTH  61
#define HEIGHT 47
#define LABELS 5

typedef struct
{
  CeldPlane      ink;
  CeldSegmenter *segmenter;
  CeldSeedRows   seeds;
  CeldLabels     labels;
  CeldPalette    palette;
  CeldProblems   problems;
  CeldRect       changed;
  uint32_t       state;
} Page;

static CeldPalette
colours (void)
{
  CeldPalette p = { calloc (LABELS, sizeof (CeldRegion)), LABELS };

  for (int k = 0; k < LABELS; k++)
    p.item[k] = (CeldRegion) { .colour = { (uint8_t) (50 * k), 10, 200, 255 } };
  return p;
}

/* Walls with gaps, two pixels thick. */
static void
draw_wall (Page *page)
{
  bool across = check_random (&page->state, 2);
  int  length = across ? WIDTH : HEIGHT, other = across ? HEIGHT : WIDTH;
  int  at = 3 + (int) check_random (&page->state, (uint32_t) other - 6);
  int  gap = (int) check_random (&page->state, (uint32_t) length), wide = (int) check_random (&page->state, 6);

  for (int i = 0; i < length; i++)
    for (int k = 0; k < 2; k++)
      if (i < gap || i >= gap + wide)
        CELD_AT (&page->ink, across ? i : at + k, across ? at + k : i) = 0;
}

static void
paint_stroke (Page *page, uint32_t label)
{
  int x = (int) check_random (&page->state, WIDTH), y = (int) check_random (&page->state, HEIGHT);
  int w = 2 + (int) check_random (&page->state, 12), h = 2 + (int) check_random (&page->state, 5);

  for (int v = y; v < y + h && v < HEIGHT; v++)
    CHECK (celd_seed_rows_paint (&page->seeds, v, x, x + w < WIDTH ? x + w : WIDTH, label) == CELD_OK);
}

/* With strokes of so many labels. */
static void
page_open (Page *page, uint32_t seed, uint32_t strokes, const CeldSettings *settings)
{
  *page = (Page) { .segmenter = celd_segmenter_new (), .state = seed };
  CHECK (celd_plane_new (WIDTH, HEIGHT, &page->ink) == CELD_OK);
  CHECK (celd_labels_new (WIDTH, HEIGHT, &page->labels) == CELD_OK);
  CHECK (celd_seed_rows_new (WIDTH, HEIGHT, &page->seeds) == CELD_OK);
  for (int i = 0; i < WIDTH * HEIGHT; i++)
    page->ink.data[i] = 1;
  for (int i = 0; i < 4; i++)
    draw_wall (page);
  CHECK (celd_segmenter_set_ink (page->segmenter, &page->ink, NULL, settings, NULL) == CELD_OK);
  for (uint32_t k = 1; k <= strokes; k++)
    paint_stroke (page, k);
}

static void
page_close (Page *page)
{
  celd_segmenter_free (page->segmenter);
  celd_free (page->ink.data);
  celd_free (page->labels.data);
  celd_seed_rows_clear (&page->seeds);
  celd_palette_clear (&page->palette);
  celd_problems_clear (&page->problems);
}

static void
solve (Page *page, const CeldRelations *relations, const CeldSettings *settings)
{
  celd_palette_clear (&page->palette);
  celd_problems_clear (&page->problems);
  page->palette = colours ();
  CHECK (celd_segmenter_solve (page->segmenter, &page->seeds, relations, settings, NULL, &page->palette,
                               &page->problems, &page->labels, &page->changed) == CELD_OK);
}

/* What a new segmenter makes of the page. */
static Page
solve_anew (const Page *page, const CeldRelations *relations, const CeldSettings *settings)
{
  Page fresh = { .ink = page->ink, .segmenter = celd_segmenter_new (), .seeds = page->seeds };

  CHECK (celd_labels_new (WIDTH, HEIGHT, &fresh.labels) == CELD_OK);
  CHECK (celd_segmenter_set_ink (fresh.segmenter, &page->ink, NULL, settings, NULL) == CELD_OK);
  solve (&fresh, relations, settings);
  celd_segmenter_free (fresh.segmenter);
  return fresh;
}

static void
compare (const Page *page, const uint32_t *before, const CeldRelations *relations, const CeldSettings *settings)
{
  Page fresh = solve_anew (page, relations, settings);
  bool same = page->palette.n == fresh.palette.n && page->problems.n == fresh.problems.n;

  CHECK (memcmp (page->labels.data, fresh.labels.data, WIDTH * HEIGHT * sizeof (uint32_t)) == 0);
  CHECK (same);
  for (size_t k = 0; k < page->palette.n && same; k++)
    {
      const CeldRegion *a = &page->palette.item[k], *b = &fresh.palette.item[k];
      size_t            area = 0;

      for (int p = 0; p < WIDTH * HEIGHT; p++)
        area += page->labels.data[p] == k + 1;
      CHECK (a->area == area && b->area == area && a->x == b->x && a->y == b->y && a->seeds == b->seeds);
      CHECK (a->area ? CELD_AT (&page->labels, a->x, a->y) == k + 1 : a->x == -1);
      CHECK (a->background == b->background);
    }
  for (int y = 0; y < HEIGHT && before; y++)
    for (int x = 0; x < WIDTH; x++)
      CHECK (before[y * WIDTH + x] == CELD_AT (&page->labels, x, y) ||
             (x >= page->changed.x && y >= page->changed.y && x < page->changed.x + page->changed.width &&
              y < page->changed.y + page->changed.height));
  celd_free (fresh.labels.data);
  celd_palette_clear (&fresh.palette);
  celd_problems_clear (&fresh.problems);
}

/* ------------------------------------------------------------------ strokes */

static void
edit_strokes (CeldSettings settings, uint32_t seed)
{
  uint32_t before[WIDTH * HEIGHT];
  Page     page;

  page_open (&page, seed, 1, &settings);
  solve (&page, NULL, &settings);
  CHECK (page.changed.x == 0 && page.changed.y == 0 && page.changed.width == WIDTH && page.changed.height == HEIGHT);
  for (int i = 0; i < 12; i++)
    {
      memcpy (before, page.labels.data, sizeof before);
      paint_stroke (&page, check_random (&page.state, LABELS + 1));
      solve (&page, NULL, &settings);
      compare (&page, before, NULL, &settings);
      solve (&page, NULL, &settings);
      CHECK (page.changed.width == 0);
    }
  page_close (&page);
}

static void
an_edited_drawing_gets_the_labels_of_a_fresh_one (void)
{
  CeldSettings soft = celd_settings (), hard = soft, plain = soft, exact = soft;

  hard.hardness = 1;
  plain.close_gaps = plain.keep_necks = false;
  exact.method = CELD_METHOD_EXACT;
  for (uint32_t seed = 1; seed <= 20; seed++)
    {
      edit_strokes (soft, seed);
      edit_strokes (hard, seed);
      edit_strokes (plain, seed);
    }
  edit_strokes (exact, 1);
}

/* ------------------------------------------------------------------ settings, drawing, relations */

static void
methods_in_turn_give_what_each_gives_alone (void)
{
  uint32_t     before[WIDTH * HEIGHT];
  CeldSettings settings = celd_settings ();
  Page         page;

  page_open (&page, 3, LABELS, &settings);
  for (int i = 0; i < 6; i++)
    {
      memcpy (before, page.labels.data, sizeof before);
      settings.method   = i % 3 == 1 ? CELD_METHOD_EXACT : CELD_METHOD_BASINS;
      settings.hardness = i < 3 ? 0.05f : 1;
      solve (&page, NULL, &settings);
      compare (&page, before, NULL, &settings);
    }
  page_close (&page);
}

static void
a_changed_drawing_gets_the_labels_of_a_fresh_one (void)
{
  uint32_t     before[WIDTH * HEIGHT];
  CeldSettings settings = celd_settings ();
  Page         page;

  page_open (&page, 5, LABELS, &settings);
  solve (&page, NULL, &settings);
  for (int i = 0; i < 20; i++)
    {
      int      x = (int) check_random (&page.state, WIDTH - 9), y = (int) check_random (&page.state, HEIGHT - 9);
      CeldRect rect = { x, y, 9, 4 };
      float    ink = (float) check_random (&page.state, 2);

      for (int y = rect.y; y < rect.y + rect.height; y++)
        for (int x = rect.x; x < rect.x + rect.width; x++)
          CELD_AT (&page.ink, x, y) = ink;
      memcpy (before, page.labels.data, sizeof before);
      CHECK (celd_segmenter_set_ink (page.segmenter, &page.ink, &rect, &settings, NULL) == CELD_OK);
      solve (&page, NULL, &settings);
      compare (&page, before, NULL, &settings);
    }
  page_close (&page);
}

/* One pixel wide. */
static void
paint_along_frame (Page *page, uint32_t label)
{
  int y = (int) check_random (&page->state, HEIGHT);

  for (int v = y; v < y + 4 && v < HEIGHT; v++)
    CHECK (celd_seed_rows_paint (&page->seeds, v, WIDTH - 1, WIDTH, label) == CELD_OK);
}

/* Between two places anywhere on the page. */
static void
add_random_relation (Page *page, CeldRelations *relations)
{
  CeldRelation r = { .weight = 1, .gap = 1 };

  r.nearer.x  = check_random (&page->state, WIDTH);
  r.nearer.y  = check_random (&page->state, HEIGHT);
  r.farther.x = check_random (&page->state, WIDTH);
  r.farther.y = check_random (&page->state, HEIGHT);
  CHECK (celd_relation_add (relations, r) == CELD_OK);
}

static void
relations_make_and_split_regions (void)
{
  uint32_t     before[WIDTH * HEIGHT];
  CeldSettings settings = celd_settings ();
  Page         page;

  page_open (&page, 7, 2, &settings);
  for (int i = 0; i < 12; i++)
    {
      CeldRelations relations = { 0 };

      add_random_relation (&page, &relations);
      add_random_relation (&page, &relations);
      memcpy (before, page.labels.data, sizeof before);
      solve (&page, &relations, &settings);
      compare (&page, before, &relations, &settings);
      celd_relations_clear (&relations);
    }
  page_close (&page);
}

/* Arrows are obeyed as far as that leaves hard strokes alone, wherever their ends lie; the background leaves them alone
 * even in a gap between a wall and the frame. */
static void
arrows_leave_hard_strokes_alone (void)
{
  CeldSettings settings = celd_settings ();

  settings.hardness = 1;
  for (uint32_t seed = 1; seed <= 80; seed++)
    {
      CeldRelations relations = { 0 };
      int           bad = 0;
      Page          page;

      settings.method     = seed % 2 ? CELD_METHOD_BASINS : CELD_METHOD_EXACT;
      settings.close_gaps = seed % 3 != 0;
      page_open (&page, seed, LABELS, &settings);
      paint_along_frame (&page, 1);
      for (int i = 0; i < 6; i++)
        add_random_relation (&page, &relations);
      solve (&page, &relations, &settings);
      for (int y = 0; y < HEIGHT; y++)
        for (size_t i = 0; i < page.seeds.row[y].n; i++)
          for (int x = page.seeds.row[y].run[i].x; x < page.seeds.row[y].run[i].end; x++)
            bad += CELD_AT (&page.labels, x, y) != page.seeds.row[y].run[i].label;
      CHECK (bad == 0);
      celd_relations_clear (&relations);
      page_close (&page);
    }
}

/* ------------------------------------------------------------------ failures */

/* Cancelled at every report of progress in turn: the next answer is as if nothing had been. */
static void
cancel_everywhere (CeldSettings settings, uint32_t seed)
{
  CeldStatus status = CELD_CANCELLED;
  Page       page;
  int        steps = 0;

  page_open (&page, seed, 2, &settings);
  solve (&page, NULL, &settings);
  for (; status == CELD_CANCELLED && steps < 1000; steps++)
    {
      int      left = steps;
      CeldHost host = { check_count_down, NULL, &left };

      paint_stroke (&page, 1 + check_random (&page.state, LABELS));
      celd_palette_clear (&page.palette);
      page.palette = colours ();
      status = celd_segmenter_solve (page.segmenter, &page.seeds, NULL, &settings, &host, &page.palette, NULL,
                                     &page.labels, &page.changed);
      CHECK (status == CELD_OK || status == CELD_CANCELLED);
      paint_stroke (&page, 0);
      solve (&page, NULL, &settings);
      compare (&page, NULL, NULL, &settings);
    }
  CHECK (status == CELD_OK && steps > 4); /* there were places to stop at */
  page_close (&page);
}

static void
a_cancelled_solve_does_not_change_the_next_one (void)
{
  CeldSettings settings = celd_settings (), plain = settings;

  plain.close_gaps = plain.keep_necks = false;
  for (uint32_t seed = 1; seed <= 2; seed++)
    {
      cancel_everywhere (settings, seed);
      cancel_everywhere (plain, seed);
    }
}

static void
without_seed_or_relation_there_is_nothing_to_go_by (void)
{
  CeldSettings settings = celd_settings ();
  CeldPalette  palette = { 0 };
  Page         page;

  page_open (&page, 11, 0, &settings);
  CHECK (celd_segmenter_solve (page.segmenter, &page.seeds, NULL, &settings, NULL, &palette, NULL, &page.labels,
                               &page.changed) == CELD_NOTHING_TO_GO_BY);
  settings.hardness = NAN;
  CHECK (celd_segmenter_solve (page.segmenter, &page.seeds, NULL, &settings, NULL, &palette, NULL, &page.labels,
                               &page.changed) == CELD_BAD_VALUE);
  celd_segmenter_free (NULL);
  page_close (&page);
}

int
main (void)
{
  RUN (an_edited_drawing_gets_the_labels_of_a_fresh_one);
  RUN (methods_in_turn_give_what_each_gives_alone);
  RUN (a_changed_drawing_gets_the_labels_of_a_fresh_one);
  RUN (relations_make_and_split_regions);
  RUN (arrows_leave_hard_strokes_alone);
  RUN (a_cancelled_solve_does_not_change_the_next_one);
  RUN (without_seed_or_relation_there_is_nothing_to_go_by);
  return DONE;
}
