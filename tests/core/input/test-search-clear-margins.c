/* How much better than others a chosen arrow must be to be clear, by what speaks against it: of arrows on a page whose
 * paint they all explain, unless something else is said.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "input/arrow-search.h"

#define SIZE   200
#define WIDTH  5
#define MOST   4  /* arrows */
#define POINTS 21 /* of a shaft */

/* Arrow k leads from place 2 k to place 2 k + 1, where it has its dot if it has one; cells are as wide as lines. */
typedef struct
{
  CeldArrowSearch s;
  CeldPoint       place[2 * MOST], at[MOST][POINTS];
  CeldShaft       shaft[MOST];
  CeldArrowOption option[MOST];
  CeldPaintPiece  piece[MOST];
  uint32_t        mark[MOST];
  size_t          arrows_at[2 * MOST], passed[MOST];
  CeldStrokeMask  mask;
  float           room[SIZE * SIZE];
  uint8_t         painted[SIZE * SIZE / WIDTH / WIDTH];
  uint16_t        covers[SIZE * SIZE / WIDTH / WIDTH];
  uint32_t        stamp[SIZE * SIZE / WIDTH / WIDTH];
} Page;

static Page *
page_new (CeldArrowStyle style)
{
  Page *p = calloc (1, sizeof *p);

  p->mask = (CeldStrokeMask) { .width = SIZE, .height = SIZE };
  p->s    = (CeldArrowSearch) {
    .mask = &p->mask, .width = WIDTH, .style = style, .room = p->room, .place = p->place, .shaft = p->shaft,
    .option = p->option, .piece = p->piece, .arrows_at = p->arrows_at, .passed = p->passed, .painted = p->painted,
    .covers = p->covers, .stamp = p->stamp, .step = WIDTH, .per_pixel = 1. / WIDTH, .cell = 1, .area = 1,
    .columns = SIZE / WIDTH, .rows = SIZE / WIDTH, .levels = 1,
  };
  return p;
}

static void
add_arrow (Page *p, double x, double y, double to_x, double to_y)
{
  size_t k = p->s.choice.n++;

  p->place[2 * k]     = (CeldPoint) { x, y };
  p->place[2 * k + 1] = (CeldPoint) { to_x, to_y };
  p->s.n_places       = p->s.n_undivided = 2 * k + 2;
  p->arrows_at[2 * k] = p->arrows_at[2 * k + 1] = 1;
  for (int i = 0; i < POINTS; i++)
    p->at[k][i] = celd_search_between (p->place[2 * k], p->place[2 * k + 1], i / (POINTS - 1.));
  p->shaft[k]  = (CeldShaft) { .place = { 2 * k, 2 * k + 1 }, .at = p->at[k], .n = POINTS,
                               .length = celd_points_apart (p->place[2 * k], p->place[2 * k + 1]),
                               .whole = CELD_NO_SHAFT };
  p->mark[k]   = (uint32_t) ((int) to_y / WIDTH * (SIZE / WIDTH) + (int) to_x / WIDTH);
  p->piece[k]  = (CeldPaintPiece) { &p->mark[k], p->s.style == CELD_ARROW_DOT };
  p->option[k] = (CeldArrowOption) { .shaft = k, .end = 1, .body = k, .mark = k };
  p->covers[p->mark[k]] = 1;
  p->s.choice.item[k] = k;
}

/* Why the first arrow is unclear if it has some margin, and the others a large one; frees the page if `last`. */
static CeldArrowReason
reason_with (Page *p, double margin, bool last)
{
  double          margins[MOST] = { margin, 50, 50, 50 };
  CeldArrowStroke stroke = { .width = SIZE, .height = SIZE };
  CeldJoinedLines lines = { .stroke = &stroke, .graph = { .width = WIDTH } };
  CeldArrowReason unclear[CELD_MOST_CHOSEN];

  CHECK (celd_search_clear_find (&p->s, &lines, NULL, margins, unclear) == CELD_OK);
  if (last)
    free (p);
  return unclear[0];
}

/* Checks that the first arrow is clear from a margin on, and what it is below that. */
static void
check_needs (Page *p, double margin, CeldArrowReason below)
{
  CHECK (reason_with (p, margin - 0.05, false) == below);
  CHECK (reason_with (p, margin + 0.05, true) == CELD_REASON_NONE);
}

static void
by_style (void)
{
  static const struct { CeldArrowStyle style; double margin; } NEEDS[] = {
    { CELD_ARROW_FADE, 2 }, { CELD_ARROW_TAPER, 2 }, { CELD_ARROW_DOT, 0.5 },
  };

  for (int i = 0; i < 3; i++)
    {
      Page *p = page_new (NEEDS[i].style);

      add_arrow (p, 30, 30, 130, 30);
      check_needs (p, NEEDS[i].margin, CELD_REASON_MEETING);
    }
}

/* Others end near it, but not at its place; or at its place. */
static void
ends_near_others (void)
{
  for (int here = 0; here < 2; here++)
    {
      Page *p = page_new (CELD_ARROW_FADE);

      add_arrow (p, 30, 30, 130, 30);
      add_arrow (p, 30, 130, 130 + (here ? 0 : 2), 30 + (here ? 5 : 12));
      check_needs (p, here ? 2 : 6, CELD_REASON_MEETING);
    }
  for (int near = 0; near < 2; near++)
    {
      Page *p = page_new (CELD_ARROW_DOT);

      add_arrow (p, 30, 30, 130, 30);
      add_arrow (p, 30, 130, 130 + 2, 30 + (near ? 12 : 40));
      check_needs (p, near ? 2 : 0.5, CELD_REASON_MEETING);
    }
}

/* Two others lead through a place on its way, which may be one where all of them end. */
static void
crosses_two_in_one_place (void)
{
  Page *p = page_new (CELD_ARROW_TAPER);

  add_arrow (p, 30, 80, 130, 80);
  add_arrow (p, 40, 40, 120, 120);
  add_arrow (p, 40, 120, 120, 40);
  p->place[p->s.n_places++] = (CeldPoint) { 80, 80 };
  check_needs (p, 6, CELD_REASON_MEETING);
}

/* There is unexplained paint beside it, some or more. */
static void
has_paint_beside_it (void)
{
  for (int cells = 1; cells <= 4; cells++)
    {
      Page *p = page_new (CELD_ARROW_TAPER);

      add_arrow (p, 30, 30, 130, 30);
      for (int i = 0; i < cells; i++)
        {
          int c = 10 * (SIZE / WIDTH) + 12 + i;

          p->painted[c] = 1;
          p->room[(10 * WIDTH + WIDTH / 2) * SIZE + (12 + i) * WIDTH + WIDTH / 2] = WIDTH;
        }
      if (cells < 4)
        check_needs (p, cells < 2 ? 2 : 6, CELD_REASON_MEETING);
      else
        CHECK (reason_with (p, 50, true) == CELD_REASON_MEETING);
    }
}

int
main (void)
{
  RUN (by_style);
  RUN (ends_near_others);
  RUN (crosses_two_in_one_place);
  RUN (has_paint_beside_it);
  return DONE;
}
