/* Arrows as strokes: regions that no stroke reaches, regions that an arrow splits, Figure 2 of the paper.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "image/image.h"
#include "segment/basins.h"
#include "segment/task.h"

typedef struct
{
  CeldPlane     ink;
  CeldLabels    seeds, labels;
  CeldPalette   palette;
  CeldRelations relations;
  CeldStatus    status;
} Case;

static CeldMethod method; /* of all that follows */

/* Scribbles 'A', 'B', ... may stand on paper in the drawing itself. */
static Case
segment (const char *const *drawing, const char *relations, CeldSettings settings)
{
  Case     c = { .ink = art_plane (drawing), .seeds = art_labels (drawing), .labels = art_labels (drawing) };
  uint32_t n = 0;

  settings.method = method;
  for (int i = 0; i < c.ink.width * c.ink.height; i++)
    n = c.seeds.data[i] > n ? c.seeds.data[i] : n;
  c.palette = (CeldPalette) { calloc (n ? n : 1, sizeof (CeldRegion)), n };
  for (uint32_t k = 0; k < n; k++)
    c.palette.item[k] = (CeldRegion) { .colour = { (uint8_t) (60 * k), 200, 0, 255 } };
  CHECK (celd_relations_parse (relations, &c.relations, NULL) == CELD_OK);
  c.status = celd_segment (&c.ink, &c.seeds, &c.relations, &settings, NULL, &c.labels, &c.palette, NULL);
  return c;
}

static void
case_clear (Case *c)
{
  free (c->ink.data), free (c->seeds.data), free (c->labels.data);
  celd_palette_clear (&c->palette);
  celd_relations_clear (&c->relations);
}

#define LABEL(x, y) CELD_AT (&c.labels, x, y)

static const char *const enclosures[] = {
  "........................",
  ".######################.",
  ".#.......#......#.....#.",
  ".#.......#......#.....#.",
  ".#.......#......#.....#.",
  ".#.......#......#.....#.",
  ".#.......#......#.....#.",
  ".######################.",
  "........................", NULL };

static void
ends_of_arrows_on_unpainted_paper_make_two_regions (void)
{
  Case c = segment (enclosures, "4.5,4.5 > 12.5,4.5", celd_settings ());

  CHECK (c.status == CELD_OK && c.palette.n == 3); /* it goes with one of them, or the background */
  CHECK (LABEL (4, 4) == 1 && LABEL (2, 2) == 1 && LABEL (8, 6) == 1);
  CHECK (LABEL (12, 4) == 2 && LABEL (10, 6) == 2);
  CHECK (LABEL (0, 0) == 3 && c.palette.item[2].background && c.palette.item[2].colour[3] == 0);
  CHECK (c.palette.item[0].origin == CELD_FROM_ARROW && c.palette.item[0].hard && c.palette.item[0].colour[3] == 255);
  CHECK (c.palette.item[0].seeds > 1 && c.palette.item[0].seeds <= 35);
  case_clear (&c);
}

static void
ends_of_an_equality_make_one_region (void)
{
  Case c = segment (enclosures, "4.5,4.5 = 19.5,4.5", celd_settings ());

  CHECK (c.palette.n == 2);
  CHECK (LABEL (4, 4) == 1 && LABEL (19, 4) == 1 && LABEL (0, 0) == 2);
  case_clear (&c);
}

/* An end on ink means the paper beside it; ends outside are left to others. */
static void
ends_on_ink_move_to_paper_and_ends_outside_are_ignored (void)
{
  Case c = segment (enclosures, "1.5,4.5 > 12.5,4.5; 19.5,4.5 > 900,3", celd_settings ());

  CHECK (c.status == CELD_OK && c.palette.n == 3);
  CHECK (LABEL (12, 4) == 2 && LABEL (19, 4) == 3);
  case_clear (&c);
}

static void
ends_in_painted_regions_add_no_seeds (void)
{
  const char *const drawing[] = {
    "...CCC..................",
    ".######################.",
    ".#.......#......#.....#.",
    ".#.AAAA..#.BBB..#.....#.",
    ".#.......#......#.....#.",
    ".#.......#......#.....#.",
    ".#.......#......#.....#.",
    ".######################.",
    "........................", NULL };
  CeldSettings      settings = celd_settings ();
  Case              c = segment (drawing, "4,5 > 12,5; 12,5 > 19,4", settings);

  CHECK (c.palette.n == 4 && LABEL (4, 5) == 1 && LABEL (12, 5) == 2 && LABEL (19, 4) == 4 && LABEL (0, 8) == 3);
  case_clear (&c);
  settings.seeds = CELD_SEEDS_SCRIBBLES;
  c = segment (drawing, "4,5 > 12,5; 12,5 > 19,4", settings);
  CHECK (c.palette.n == 3 && LABEL (4, 5) == 1 && LABEL (12, 5) == 2);
  case_clear (&c);
  settings.seeds = CELD_SEEDS_SCRIBBLES;
  c = segment (enclosures, "4,5 > 12,5", settings);
  CHECK (c.status == CELD_NOTHING_TO_GO_BY);
  case_clear (&c);
}

/* New colours are opaque and differ clearly from each other and from the scribbles. */
static void
labels_of_arrows_get_colours_that_differ (void)
{
  Case c = segment (enclosures, "4,4 > 12,4; 12,4 > 19,4; 19,4 > 0,0", celd_settings ());

  CHECK (c.palette.n == 4);
  for (size_t i = 0; i < c.palette.n; i++)
    for (size_t j = 0; j < i; j++)
      {
        const uint8_t *p = c.palette.item[i].colour, *q = c.palette.item[j].colour;

        CHECK (p[3] == 255 && abs (p[0] - q[0]) + abs (p[1] - q[1]) + abs (p[2] - q[2]) > 60);
      }
  CHECK (c.palette.item[LABEL (0, 0) - 1].background); /* the arrow's own region, nothing is added */
  case_clear (&c);
}

/* ------------------------------------------------------------------ splitting */

/* A body with two legs that are open to it. */
static const char *const figure2[] = {
  "........................................",
  "......############################......",
  "......#..........................#......",
  "......#..........................#......",
  "......#..........................#......",
  "......#..........................#......",
  "......#..........................#......",
  "......#..........................#......",
  "......#..........................#......",
  "......#......##############......#......",
  "......#......#............#......#......",
  "......#......#............#......#......",
  "......#......#............#......#......",
  "......#......#............#......#......",
  "......#......#............#......#......",
  "......#......#............#......#......",
  "......#......#............#......#......",
  "......########............########......",
  "........................................", NULL };

static void
figure_2_of_the_paper (void)
{
  Case     c = segment (figure2, "9.5,14.5 > 20.5,5.5; 29.5,14.5 > 20.5,5.5", celd_settings ());
  uint32_t left = LABEL (9, 14), body = LABEL (20, 5), right = LABEL (29, 14), back = LABEL (0, 0);

  CHECK (c.status == CELD_OK && c.palette.n == 4);
  CHECK (left != body && right != body && left != right && back != left && back != right && back != body);
  CHECK (LABEL (8, 16) == left && LABEL (11, 11) == left);
  CHECK (LABEL (31, 16) == right && LABEL (28, 11) == right);
  CHECK (LABEL (8, 3) == body && LABEL (31, 3) == body && LABEL (20, 7) == body);
  CHECK (LABEL (20, 14) == back && c.palette.item[back - 1].background);
  case_clear (&c);
}

/* The end nearer to the region's scribble keeps its label, whichever way the arrow points; equalities split nothing. */
static void
a_painted_region_with_both_ends_is_split (void)
{
  const char *const drawing[] = {
    "........................................",
    ".######################################.",
    ".#.................#..................#.",
    ".#.AAAAAAA.........#..................#.",
    ".#....................................#.",
    ".#....................................#.",
    ".#....................................#.",
    ".#....................................#.",
    ".#....................................#.",
    ".#.................#..................#.",
    ".######################################.",
    "........................................", NULL };
  const char *const arrow[] = { "9.5,6.5 > 30.5,6.5", "30.5,6.5 > 9.5,6.5" };
  Case              c;

  for (int i = 0; i < 2; i++)
    {
      c = segment (drawing, arrow[i], celd_settings ());
      CHECK (c.palette.n == 3 && LABEL (9, 6) == 1 && LABEL (3, 3) == 1 && LABEL (18, 9) == 1);
      CHECK (LABEL (30, 6) == 3 && LABEL (21, 3) == 3 && LABEL (36, 9) == 3);
      CHECK (c.palette.item[2].origin == CELD_FROM_ARROW && c.palette.item[2].area > 100);
      case_clear (&c);
    }
  c = segment (drawing, "9.5,6.5 = 30.5,6.5", celd_settings ());
  CHECK (c.palette.n == 2 && LABEL (30, 6) == 1);
  case_clear (&c);
}

/* Ends so close that no disc has room: still a result. */
static void
ends_next_to_each_other_are_separated (void)
{
  const char *const blank[] = { "........", "........", "........", "........", NULL };
  Case              c = segment (blank, "3,1 > 4,1; 3,1 > 3.4,1.2", celd_settings ());

  CHECK (c.status == CELD_OK && LABEL (3, 1) != LABEL (4, 1));
  case_clear (&c);
}

/* Two chambers with a narrow place between them, and nothing but an arrow: each is a region up to there. */
static void
an_hourglass_is_split_at_its_waist (void)
{
  const char *const drawing[] = {
    "....................................",
    ".##################################.",
    ".#................................#.",
    ".#..............###...............#.",
    ".#..............###...............#.",
    ".#..............###...............#.",
    ".#..............###...............#.",
    ".#................................#.",
    ".#................................#.",
    ".#..............###...............#.",
    ".#..............###...............#.",
    ".#..............###...............#.",
    ".#..............###...............#.",
    ".##################################.",
    "....................................", NULL };
  Case              c = segment (drawing, "4,10 > 31,4", celd_settings ());

  CHECK (c.palette.n == 3 && LABEL (4, 10) != LABEL (31, 4));
  for (int y = 2; y < 13; y++)
    for (int x = 2; x < 34; x++)
      if ((x < 16 || x > 18) && drawing[y][x] == '.')
        CHECK (LABEL (x, y) == LABEL (x < 16 ? 4 : 31, x < 16 ? 10 : 4));
  case_clear (&c);
}

/* In a corridor any straight cut across is least: there is one, between the ends. */
static void
a_corridor_is_cut_straight_across (void)
{
  const char *const drawing[] = {
    "##############################################",
    "#............................................#",
    "#............................................#",
    "#............................................#",
    "#............................................#",
    "#............................................#",
    "##############################################", NULL };
  Case              c = segment (drawing, "8,3 > 37,3", celd_settings ());
  int               first = 1;

  CHECK (c.palette.n >= 2 && LABEL (8, 3) != LABEL (37, 3));
  while (first < 45 && LABEL (first, 1) == LABEL (8, 3))
    first++;
  CHECK (first > 8 && first <= 37);
  for (int y = 1; y < 6; y++)
    for (int x = 1; x < 45; x++)
      CHECK (LABEL (x, y) == LABEL (x < first ? 8 : 37, 3));
  case_clear (&c);
}

/* The second relation splits what the first has left. */
static void
each_relation_splits_what_earlier_ones_left (void)
{
  const char *const drawing[] = {
    "##############################################",
    "#..............#..............#..............#",
    "#..............#..............#..............#",
    "#..............#..............#..............#",
    "#............................................#",
    "#...................AAAAAA...................#",
    "#............................................#",
    "#..............#..............#..............#",
    "#..............#..............#..............#",
    "#..............#..............#..............#",
    "##############################################", NULL };
  Case              c = segment (drawing, "23,2 > 4,4; 40,6 > 23,8; 4,8 > 23,2", celd_settings ());

  CHECK (LABEL (23, 5) == 1 && LABEL (17, 2) == 1 && LABEL (28, 8) == 1);
  CHECK (LABEL (4, 5) != 1 && LABEL (13, 8) == LABEL (4, 5) && LABEL (1, 1) == LABEL (4, 5));
  CHECK (LABEL (40, 5) != 1 && LABEL (32, 8) == LABEL (40, 5) && LABEL (40, 5) != LABEL (4, 5));
  case_clear (&c);
}

/* On paper without a line each end keeps the paper round it. */
static void
blank_paper_is_split_between_the_ends (void)
{
  enum { SIDE = 160 };
  const char *rows[SIDE + 1] = { NULL };
  char        row[SIDE + 1];
  Case        c;

  memset (row, '.', SIDE);
  row[SIDE] = 0;
  for (int y = 0; y < SIDE; y++)
    rows[y] = row;
  c = segment (rows, "40,80 > 120,80", celd_settings ());
  CHECK (c.status == CELD_OK && c.palette.n == 2);
  for (int y = 70; y <= 90; y++)
    for (int x = -10; x <= 10; x++)
      CHECK (LABEL (40 + x, y) == LABEL (40, 80) && LABEL (120 + x, y) == LABEL (120, 80));
  CHECK (LABEL (40, 80) != LABEL (120, 80));
  case_clear (&c);
}

/* Whatever is asked for at one place, no region holds both ends of an inequality, as long as they are two pixels. */
static void
no_region_holds_both_ends_of_thousands_of_relations (void)
{
  enum { SIDE = 48, N = 3000, LONGEST = 24 };
  const char *rows[SIDE + 1] = { NULL };
  char        row[SIDE + 1], *text = malloc (N * LONGEST), *end = text;
  int         place[N][4];
  uint32_t    random = 3;
  Case        c;
  size_t      n;

  CeldComponent *list;

  memset (row, '.', SIDE);
  row[SIDE] = 0;
  for (int y = 0; y < SIDE; y++)
    rows[y] = row;
  for (int i = 0; i < N; i++)
    {
      for (int k = 0; k < 4; k++)
        place[i][k] = 20 + (int) check_random (&random, 8);
      end += sprintf (end, "%d,%d>%d,%d;", place[i][0], place[i][1], place[i][2], place[i][3]);
    }
  c = segment (rows, text, celd_settings ());
  CHECK (c.status == CELD_OK && c.palette.n > 10 && c.palette.n <= 65);
  CHECK (celd_components (&c.labels, 0, false, NULL, &c.labels, &list, &n) == CELD_OK);
  for (int i = 0; i < N; i++)
    if (place[i][0] != place[i][2] || place[i][1] != place[i][3])
      CHECK (LABEL (place[i][0], place[i][1]) != LABEL (place[i][2], place[i][3]));
  free (list);
  free (text);
  case_clear (&c);
}

/* ------------------------------------------------------------------ random pages */

enum { PAGE = 72, RELATIONS = 12 };

/* Random strokes of ink, and labels that know nothing of them: bands across the page. */
static void
random_page (uint32_t *random, CeldPlane *ink, CeldLabels *labels, uint32_t n)
{
  for (int p = 0; p < PAGE * PAGE; p++)
    ink->data[p] = 1;
  for (int i = (int) check_random (random, 12); i > 0; i--)
    {
      int x = (int) check_random (random, PAGE), y = (int) check_random (random, PAGE);
      int u = (int) check_random (random, 3) - 1, v = (int) check_random (random, 3) - 1;

      for (int k = 0; k < 50; k++, x += u, y += v)
        for (int j = 0; j < 2; j++)
          if (x + j >= 0 && x + j < PAGE && y >= 0 && y < PAGE)
            CELD_AT (ink, x + j, y) = 0;
    }
  for (int y = 0; y < PAGE; y++)
    for (int x = 0; x < PAGE; x++)
      CELD_AT (labels, x, y) = 1 + (uint32_t) (x + y / 3) / 30 % n;
}

static void
add_random_relations (uint32_t *random, CeldRelations *relations)
{
  for (int i = 0; i < RELATIONS; i++)
    {
      CeldRelation r = { .equal = !check_random (random, 6), .weight = 1, .gap = 1 };

      r.nearer.x  = (int) check_random (random, PAGE + 10) - 5;
      r.nearer.y  = (int) check_random (random, PAGE + 10) - 5;
      r.farther.x = r.nearer.x + (int) check_random (random, 41) - 20;
      r.farther.y = r.nearer.y + (int) check_random (random, 41) - 20;
      CHECK (celd_relation_add (relations, r) == CELD_OK);
    }
}

/* Is a pixel under a hard stroke of its label? */
static bool
is_kept (const CeldSegmentTask *task, const CeldLabels *labels, int x, int y)
{
  uint32_t label = celd_seed_rows_at (&task->seeds, x, y);

  return label && task->palette.item[label - 1].hard && CELD_AT (labels, x, y) == label;
}

/* What changes, changes to a new label, no pixel twice, none under a hard stroke; no connected region keeps both ends
 * of an inequality, unless hard strokes keep both. */
static void
check_split (CeldSegmentTask *task, const CeldRelations *relations, CeldLabels *labels)
{
  static bool    changed[PAGE][PAGE], kept[PAGE][PAGE];
  size_t         before = task->palette.n, n;
  CeldPatches    patches = { 0 };
  CeldComponent *list = NULL;

  memset (changed, 0, sizeof changed);
  for (int y = 0; y < PAGE; y++)
    for (int x = 0; x < PAGE; x++)
      kept[y][x] = is_kept (task, labels, x, y);
  CHECK (celd_regions_split (relations, NULL, labels, task, &patches) == CELD_OK);
  for (size_t i = 0; i < patches.n; i++)
    {
      CeldPatch patch = patches.item[i];

      CHECK (patch.label > before && patch.label <= task->palette.n && patch.x < patch.end);
      for (int x = patch.x; x < patch.end; x++)
        {
          CHECK (!changed[patch.y][x] && !kept[patch.y][x]);
          changed[patch.y][x] = true;
          CELD_AT (labels, x, patch.y) = patch.label;
        }
    }
  CHECK (celd_components (labels, 0, false, NULL, labels, &list, &n) == CELD_OK);
  for (size_t i = 0; i < relations->n; i++)
    {
      const CeldTerm *a = &relations->item[i].nearer, *b = &relations->item[i].farther;
      int             x = (int) a->x, y = (int) a->y, u = (int) b->x, v = (int) b->y;

      if (relations->item[i].equal || x < 0 || y < 0 || x >= PAGE || y >= PAGE)
        continue;
      if (u < 0 || v < 0 || u >= PAGE || v >= PAGE)
        continue;
      if (kept[y][x] && kept[v][u])
        continue;
      if ((x != u || y != v) && CELD_AT (task->ink, x, y) > 0.5f && CELD_AT (task->ink, u, v) > 0.5f)
        CHECK (CELD_AT (labels, x, y) != CELD_AT (labels, u, v));
    }
  celd_patches_clear (&patches);
  free (list);
}

/* Two bands of one label are two regions; a basin may lie in two bands. */
static void
ends_in_random_regions_get_two_labels (void)
{
  static float    ink_data[PAGE * PAGE];
  static uint32_t label_data[PAGE * PAGE];
  uint32_t        random = 11;

  for (int i = 0; i < 150; i++)
    {
      CeldPlane       ink = { PAGE, PAGE, PAGE, ink_data };
      CeldLabels      labels = { PAGE, PAGE, PAGE, label_data };
      CeldSettings    settings = celd_settings ();
      CeldBasins      basins = { 0 };
      CeldRelations   relations = { 0 };
      CeldSegmentTask task = { .settings = &settings, .ink = &ink, .basins = &basins, .soft_cost = 500 };
      uint32_t        label, n = 1 + check_random (&random, 3);

      random_page (&random, &ink, &labels, n);
      add_random_relations (&random, &relations);
      CHECK (celd_basins_new (&ink, settings.ink_threshold, NULL, &basins) == CELD_OK);
      CHECK (celd_seed_rows_new (PAGE, PAGE, &task.seeds) == CELD_OK);
      for (uint32_t k = 0; k < n; k++)
        celd_task_add_label (&task, (CeldRegion) { .colour = { (uint8_t) (99 * k), 7, 7, 255 }, .hard = k == 1 },
                             &label);
      for (int k = (int) check_random (&random, 9); k > 0; k--)
        {
          int x = (int) check_random (&random, PAGE), y = (int) check_random (&random, PAGE);

          celd_seed_rows_paint (&task.seeds, y, x, x + 9, CELD_AT (&labels, x, y));
        }
      check_split (&task, &relations, &labels);
      celd_basins_clear (&basins);
      celd_relations_clear (&relations);
      celd_seed_rows_clear (&task.seeds);
      celd_palette_clear (&task.palette);
    }
}

int
main (void)
{
  for (method = CELD_METHOD_BASINS; method <= CELD_METHOD_EXACT; method++)
    {
      RUN (ends_of_arrows_on_unpainted_paper_make_two_regions);
      RUN (ends_of_an_equality_make_one_region);
      RUN (ends_on_ink_move_to_paper_and_ends_outside_are_ignored);
      RUN (ends_in_painted_regions_add_no_seeds);
      RUN (labels_of_arrows_get_colours_that_differ);
      RUN (figure_2_of_the_paper);
      RUN (a_painted_region_with_both_ends_is_split);
      RUN (ends_next_to_each_other_are_separated);
      RUN (an_hourglass_is_split_at_its_waist);
      RUN (a_corridor_is_cut_straight_across);
      RUN (each_relation_splits_what_earlier_ones_left);
      RUN (blank_paper_is_split_between_the_ends);
      RUN (no_region_holds_both_ends_of_thousands_of_relations);
    }
  RUN (ends_in_random_regions_get_two_labels);
  return DONE;
}
