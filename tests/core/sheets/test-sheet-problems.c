/* Sheets whose hidden part is hardly more than a guess are named, at the place where a stroke tells most.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "layer-scene.h"
#include "sheets/sheets.h"

/* ------------------------------------------------------------------ sheets by hand */

enum { SIDE = 100 }; /* of a page, of which 100 pixels are one percent */

/* One sheet of label 7, whose hidden pixels are those with a cover of 0 .. 255; -1 where there is none. */
typedef struct { int cover[SIDE * SIDE]; uint8_t sure[SIDE * SIDE]; } Hidden;

static Hidden
nothing_hidden (void)
{
  Hidden h;

  for (int p = 0; p < SIDE * SIDE; p++)
    h.cover[p] = -1;
  memset (h.sure, 0, sizeof h.sure);
  return h;
}

static void
hide (Hidden *h, int x, int y, int width, int height, int cover, uint8_t sure)
{
  for (int v = y; v < y + height; v++)
    for (int u = x; u < x + width; u++)
      {
        h->cover[v * SIDE + u] = cover;
        h->sure[v * SIDE + u]  = sure;
      }
}

static CeldProblems
problems_of (const Hidden *h)
{
  static uint8_t cover[SIDE * SIDE], sure[SIDE * SIDE];
  CeldSheet      sheet = { .label = 7, .coverage = cover, .confidence = sure };
  CeldSheets     sheets = { .width = SIDE, .height = SIDE, .item = &sheet, .n = 1 };
  CeldProblems   problems = { 0 };
  size_t         capacity = 0;

  for (int p = 0; p < SIDE * SIDE; p++)
    if (h->cover[p] >= 0)
      {
        cover[sheet.n_hidden] = (uint8_t) h->cover[p];
        sure[sheet.n_hidden]  = h->sure[p];
        CHECK (celd_sheet_run_add (&sheet.run, &sheet.n_runs, &capacity, p % SIDE, p / SIDE, sheet.n_hidden) ==
               CELD_OK);
        sheet.n_hidden++;
      }
  CHECK (celd_sheet_problems (&sheets, &problems) == CELD_OK);
  celd_free (sheet.run);
  return problems;
}

static bool
is_named (const Hidden *h)
{
  CeldProblems problems = problems_of (h);
  size_t       n = problems.n;

  celd_problems_clear (&problems);
  return n == 1;
}

static bool
is_named_at (const Hidden *h, int x, int y)
{
  CeldProblems problems = problems_of (h);
  bool         named = problems.n == 1;

  if (named)
    {
      CeldProblem p = problems.item[0];

      named = p.kind == CELD_PROBLEM_HIDDEN_UNSURE && p.label == 7 && !p.other && p.relation == CELD_NO_INDEX &&
              p.x == x && p.y == y;
    }
  celd_problems_clear (&problems);
  return named;
}

/* One percent of the page, and a mean confidence of 0.35, 89.25 of 255. */
static void
what_is_small_or_sure_is_not_named (void)
{
  Hidden h = nothing_hidden ();

  CHECK (!is_named (&h));
  hide (&h, 30, 30, 10, 10, 255, 89);
  CHECK (is_named (&h));
  h.cover[30 * SIDE + 30] = -1;
  CHECK (!is_named (&h));
  hide (&h, 30, 30, 10, 10, 255, 90);
  CHECK (!is_named (&h));
  hide (&h, 60, 60, 10, 10, 255, 88);
  CHECK (is_named (&h)); /* the mean of both halves is 89 */
}

/* The margin is no part of the silhouette, and a pixel counts for the mean as much as it is covered. */
static void
only_the_silhouette_counts (void)
{
  Hidden h = nothing_hidden ();

  hide (&h, 0, 50, 100, 50, 0, 0);
  CHECK (!is_named (&h));
  hide (&h, 10, 60, 11, 11, 255, 50);
  hide (&h, 0, 0, 100, 30, 0, 255);
  CHECK (is_named_at (&h, 15, 65));
  hide (&h, 40, 60, 11, 11, 51, 255); /* a fifth: (50 + 255 / 5) / 1.2 = 84 */
  CHECK (is_named (&h));
  hide (&h, 40, 60, 11, 11, 102, 255); /* two fifths: (50 + 255 * 0.4) / 1.4 = 109 */
  CHECK (!is_named (&h));
}

static void
the_place_is_deep_in_what_is_unsure (void)
{
  Hidden h = nothing_hidden ();

  hide (&h, 0, 0, 25, 25, 255, 10); /* the page's edge is no place for a mark */
  CHECK (is_named_at (&h, 12, 12));
  hide (&h, 60, 20, 31, 31, 255, 20);
  CHECK (is_named_at (&h, 75, 35)); /* where more is unsure */
  hide (&h, 62, 20, 31, 31, 255, 90);
  CHECK (is_named_at (&h, 12, 12)); /* that is sure */
  hide (&h, 10, 10, 1, 1, 0, 0);
  hide (&h, 40, 70, 21, 25, 255, 60);
  CHECK (is_named_at (&h, 50, 80)); /* a hole in the corner; the first in reading order of all that are as deep */
}

/* Of random spots: the place is unsure, and no unsure pixel is farther from all that is not. */
static void
no_unsure_pixel_is_deeper (void)
{
  static int depth[SIDE * SIDE];
  uint32_t   r = 3;

  for (int round = 0; round < 10; round++)
    {
      Hidden       h = nothing_hidden ();
      CeldProblems problems;
      int          most = 0;

      for (int i = 0; i < 12; i++)
        {
          int x = (int) check_random (&r, SIDE - 30), y = (int) check_random (&r, SIDE - 30);
          int w = 5 + (int) check_random (&r, 25), height = 5 + (int) check_random (&r, 25);

          hide (&h, x, y, w, height, check_random (&r, 5) ? 255 : 0, (uint8_t) check_random (&r, 110));
        }
      for (int p = 0; p < SIDE * SIDE; p++)
        {
          depth[p] = h.cover[p] > 0 && h.sure[p] <= 89 ? INT32_MAX : 0;
          for (int q = 0; q < SIDE * SIDE && depth[p]; q++)
            if (!(h.cover[q] > 0 && h.sure[q] <= 89))
              {
                int dx = q % SIDE - p % SIDE, dy = q / SIDE - p / SIDE, d = dx * dx + dy * dy;

                depth[p] = d < depth[p] ? d : depth[p];
              }
          for (int edge = 0; edge < 4 && depth[p]; edge++)
            {
              int d = (edge < 2 ? p % SIDE : p / SIDE);

              d = edge % 2 ? SIDE - d : d + 1;
              depth[p] = d * d < depth[p] ? d * d : depth[p];
            }
          most = depth[p] > most ? depth[p] : most;
        }
      problems = problems_of (&h);
      CHECK (problems.n == 1);
      if (problems.n)
        CHECK (depth[problems.item[0].y * SIDE + problems.item[0].x] == most);
      celd_problems_clear (&problems);
    }
}

/* ------------------------------------------------------------------ sheets of a scene */

enum { WIDTH = 300, HEIGHT = 100, PAGE = 1, BAR = 2, BOARD = 3, LABELS = 3 };

static const float black[3] = { 0, 0, 0 };
static double      left_end, right_end; /* of the board */

static double
box (double x, double y, double left, double top, double right, double bottom)
{
  return fmin (fmax (fmin (fmin (x - left, right - x), fmin (y - top, bottom - y)) + 0.5, 0), 1);
}

/* A board over a bar, which is seen on both sides of it. */
static double bar (double x, double y) { return box (x, y, 5, 20, 295, 80); }
static double board (double x, double y) { return box (x, y, left_end, 5, right_end, 95); }

/* The problems of the scene; a stroke of the bar covers columns from .. to, where it is hidden. */
static CeldProblems
scene_problems (double left, double right, int from, int to)
{
  LayerScene   s = layer_scene (WIDTH, HEIGHT);
  CeldOrder    order = { .level = s.level, .n = LABELS };
  CeldSettings settings = celd_settings ();
  CeldSheets  *sheets = NULL;
  CeldLabels   hints;
  CeldProblems problems = { 0 };

  left_end  = left;
  right_end = right;
  layer_scene_paint (&s, BAR, black, bar, NULL);
  layer_scene_paint (&s, BOARD, black, board, NULL);
  CHECK (celd_labels_new (WIDTH, HEIGHT, &hints) == CELD_OK);
  for (int y = 0; y < HEIGHT; y++)
    for (int x = 0; x < WIDTH; x++)
      CELD_AT (&hints, x, y) = x >= from && x < to && y >= 25 && y < 75 ? BAR : 0;
  CHECK (celd_sheets (&s.ink, &s.own, &hints, &order, PAGE, &settings, NULL, &sheets) == CELD_OK);
  CHECK (celd_sheet_problems (sheets, &problems) == CELD_OK);
  celd_sheets_free (sheets);
  free (hints.data);
  layer_scene_close (&s);
  return problems;
}

/* Behind a narrow board the bar is sure to go on.  Behind a wide one it is not, until a stroke says so.  The place is
 * hidden, of the bar, and far from both ends. */
static void
a_bar_behind_a_board (void)
{
  CeldProblems narrow = scene_problems (140, 160, 0, 0), wide = scene_problems (60, 240, 0, 0);
  CeldProblems painted = scene_problems (60, 240, 65, 235), page = scene_problems (300, 301, 0, 0);

  CHECK (narrow.n == 0 && painted.n == 0 && page.n == 0);
  CHECK (wide.n == 1 && wide.item[0].kind == CELD_PROBLEM_HIDDEN_UNSURE && wide.item[0].label == BAR);
  if (wide.n)
    CHECK (wide.item[0].x > 100 && wide.item[0].x < 200 && wide.item[0].y > 20 && wide.item[0].y < 80);
  celd_problems_clear (&narrow);
  celd_problems_clear (&wide);
  celd_problems_clear (&painted);
  celd_problems_clear (&page);
}

int
main (void)
{
  RUN (what_is_small_or_sure_is_not_named);
  RUN (only_the_silhouette_counts);
  RUN (the_place_is_deep_in_what_is_unsure);
  RUN (no_unsure_pixel_is_deeper);
  RUN (a_bar_behind_a_board);
  return DONE;
}
