/* Unclear arrows: each has its reason, and its paint, no other, is shown in red.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "draw-arrows.h"

#define SIZE 200

static const uint8_t ORANGE[3] = { 230, 90, 0 };

/* ------------------------------------------------------------------ what is red */

static int
opacity (const CeldPaint *paint, int x, int y)
{
  return CELD_RGBA (paint, x, y)[3];
}

/* The opacity from which something is paint of an arrow. */
static int
least_opacity (CeldArrowStyle style)
{
  return style == CELD_ARROW_FADE ? 16 : style == CELD_ARROW_TAPER ? 48 : 128;
}

/* A page on which only problems are painted. */
static CeldPaint
paint_problems (const Answer *answer, int width, int height)
{
  CeldPaint page = blank (width, height);

  celd_problems_paint (&answer->problems, &page);
  return page;
}

static bool
is_red (const CeldPaint *page, int x, int y)
{
  const uint8_t *c = CELD_RGBA (page, x, y);

  return c[0] > 200 && c[1] < 60 && c[2] < 60 && c[3] == 255;
}

/* Is the paint of some arrows red, pixel by pixel, and nothing else? */
static bool
is_all_red (const Answer *answer, const CeldPaint *unclear, CeldArrowStyle style)
{
  CeldPaint page = paint_problems (answer, unclear->width, unclear->height);
  bool      same = true;

  for (int y = 0; y < page.height; y++)
    for (int x = 0; x < page.width; x++)
      same &= opacity (unclear, x, y) >= least_opacity (style) ? is_red (&page, x, y) : !opacity (&page, x, y);
  free (page.data);
  return same;
}

/* Something with a reason to be left out, and beside it an arrow that is read: just that is told, and red. */
static void
check_reason (const CeldPaint *unclear, CeldArrowStyle style, CeldArrowReason reason)
{
  Arrow     clear = through ((Point) { 20, 160 }, 0, 150, 0, 5, style, false);
  CeldPaint all = blank (unclear->width, unclear->height);
  Answer    answer;

  memcpy (all.data, unclear->data, 4 * all.stride * (size_t) all.height);
  draw_arrow (&all, &clear, GREEN);
  answer = read_paint (&all, style);
  CHECK (answer.relations.n == 1 && is_read (&answer, &clear, style));
  CHECK (answer.problems.n == 1 && answer.problems.item[0].kind == CELD_PROBLEM_ARROW_UNCLEAR);
  CHECK (answer.problems.n == 1 && answer.problems.item[0].reason == reason);
  CHECK (is_all_red (&answer, unclear, style));
  forget (&answer);
  free (all.data);
}

static void
check_arrow (const Arrow *a, CeldArrowStyle style, CeldArrowReason reason)
{
  CeldPaint paint = blank (SIZE, SIZE);

  draw_arrow (&paint, a, GREEN);
  check_reason (&paint, style, reason);
  free (paint.data);
}

/* ------------------------------------------------------------------ reasons */

static void
too_short (void)
{
  for (int i = 0; i < 4; i++)
    {
      Arrow dab = arrow_at ((Point) { 80, 80 }, 0.5, 3, 20, 0, 0, BARE, 0);

      check_arrow (&dab, STYLES[i], CELD_REASON_SHORT);
    }
}

static void
alike_at_both_ends (void)
{
  for (int degrees = 0; degrees < 180; degrees += 30)
    for (int i = 0; i < 4; i++)
      {
        Arrow bare = straight (degrees, 5, BARE, 0);

        check_arrow (&bare, STYLES[i], CELD_REASON_ALIKE);
      }
}

static void
two_heads (void)
{
  for (int i = 0; i < 2; i++)
    {
      Arrow     one = straight (20, 4, i ? DOT : FILLED, i ? 8 : 16), other = straight (200, 4, one.head, one.size);
      CeldPaint paint = blank (SIZE, SIZE);

      draw_arrow (&paint, &one, GREEN);
      draw_arrow (&paint, &other, GREEN);
      check_reason (&paint, STYLES[i], CELD_REASON_ALIKE);
      free (paint.data);
    }
}

/* With a shaft as for heads, or stronger towards the head. */
static void
heads_in_other_styles (void)
{
  for (int i = 2; i < 4; i++)
    for (int open = 0; open < 2; open++)
      for (int changes = 0; changes < 2; changes++)
        {
          Arrow a = straight (20, 5, open ? OPEN : FILLED, 18);

          a.alpha = i == 2 && changes ? 0.5 : 1;
          a.width = i == 3 && changes ? 4 : 5;
          check_arrow (&a, STYLES[i], CELD_REASON_HEAD);
        }
}

/* Weaker at both ends, but not as weak. */
static void
strong_in_the_middle (void)
{
  for (int i = 2; i < 4; i++)
    {
      CeldPaint paint = blank (SIZE, SIZE);

      for (int k = 0; k < 24; k++)
        {
          double from = 0.3 + 0.7 * sin (2.6 - 0.104 * k), to = 0.3 + 0.7 * sin (2.6 - 0.104 * (k + 1));
          Arrow  a = arrow_at ((Point) { 40 + 4 * k, 80 }, 0, 4, 8, 0, 0, BARE, 0);

          if (i == 2)
            a.alpha = from, a.last_alpha = to;
          else
            a.width = 8 * from, a.last_width = 8 * to;
          draw_arrow (&paint, &a, GREEN);
        }
      check_reason (&paint, STYLES[i], CELD_REASON_UNEVEN);
      free (paint.data);
    }
}

/* It fades or tapers all the way, but turns back. */
static void
sharp_corner (void)
{
  for (int i = 2; i < 4; i++)
    {
      CeldPaint paint = blank (SIZE, SIZE);
      Arrow     first = through ((Point) { 100, 80 }, 0, 60, 1, 8, STYLES[i], false);
      Arrow     last = through ((Point) { 100, 80 }, 1.9, 50, 0, 8, STYLES[i], false);

      first.last_alpha = last.alpha = i == 2 ? 0.55 : 1;
      first.last_width = last.width = i == 2 ? 8 : 5;
      draw_arrow (&paint, &first, GREEN);
      draw_arrow (&paint, &last, GREEN);
      check_reason (&paint, STYLES[i], CELD_REASON_UNEVEN);
      free (paint.data);
    }
}

static void
three_that_meet (void)
{
  for (int i = 0; i < 4; i++)
    {
      CeldPaint paint = blank (SIZE, SIZE);

      for (int k = 0; k < 3; k++)
        {
          Arrow a = arrow_at ((Point) { 80, 80 }, 0.3 + 2.1 * k, 60, 5, 0, 0, BARE, 0);

          draw_arrow (&paint, &a, GREEN);
        }
      check_reason (&paint, STYLES[i], CELD_REASON_MEETING);
      free (paint.data);
    }
}

/* Of two that cross one has no head: the other one is left out because of it, and all is red. */
static void
crossed_by_an_unclear_one (void)
{
  for (int degrees = 0; degrees < 180; degrees += 45)
    {
      CeldPaint paint = blank (SIZE, SIZE);
      double    angle = degrees * 0.0174532925;
      Arrow     head = through ((Point) { 90, 90 }, angle, 120, 0.5, 4, CELD_ARROW_HEAD, false);
      Arrow     bare = arrow_at ((Point) { 90 + 55 * sin (angle), 90 - 55 * cos (angle) }, angle + 1.5708, 110, 4, 0, 0,
                                 BARE, 0);
      Answer    answer;

      draw_arrow (&paint, &head, GREEN);
      draw_arrow (&paint, &bare, GREEN);
      answer = read_paint (&paint, CELD_ARROW_HEAD);
      CHECK (answer.relations.n == 0 && answer.problems.n == 2);
      for (size_t i = 0; i < answer.problems.n; i++)
        {
          const CeldPaintRun *run = &answer.problems.run[answer.problems.item[i].first];
          double              from_bare = fabs ((run->x - 90) * cos (angle) + (run->y - 90) * sin (angle));

          CHECK (answer.problems.item[i].reason == (from_bare < 6 ? CELD_REASON_ALIKE : CELD_REASON_MEETING));
        }
      CHECK (is_all_red (&answer, &paint, CELD_ARROW_HEAD));
      forget (&answer);
      free (paint.data);
    }
}

/* A crumb behind the end of an arrow that is read as if it were whole. */
static void
piece_of_another (void)
{
  for (int i = 2; i < 4; i++)
    {
      CeldPaint paint = blank (SIZE, SIZE), crumb = blank (SIZE, SIZE);
      Arrow     a = through ((Point) { 30, 80 }, 0, 100, 0, 8, STYLES[i], false);
      Arrow     b = arrow_at ((Point) { 137, 80 }, 0, 7, 3, 0, 0, BARE, 0);
      Answer    answer;

      draw_arrow (&paint, &a, GREEN);
      draw_arrow (&paint, &b, GREEN);
      draw_arrow (&crumb, &b, GREEN);
      answer = read_paint (&paint, STYLES[i]);
      CHECK (answer.relations.n == 1 && answer.problems.n == 1);
      CHECK (answer.problems.n == 1 && answer.problems.item[0].reason == CELD_REASON_PIECE);
      CHECK (is_all_red (&answer, &crumb, STYLES[i]));
      forget (&answer);
      free (paint.data);
      free (crumb.data);
    }
}

static void
along_the_edge (void)
{
  Arrow a = arrow_at ((Point) { 60, 0 }, 0, 100, 8, 0, 0, BARE, 0);

  a.last_width = 3;
  check_arrow (&a, CELD_ARROW_TAPER, CELD_REASON_FRAME);
}

/* Two of one colour lead below a wide stroke of another one, which is itself clear: nothing shows where they end. */
static void
below_another (void)
{
  CeldPaint paint = blank (SIZE, SIZE);
  Arrow     below[2] = { through ((Point) { 20, 60 }, 0.2, 110, 0, 5, CELD_ARROW_HEAD, false),
                         through ((Point) { 30, 120 }, -0.1, 100, 0, 5, CELD_ARROW_HEAD, false) };
  Arrow     above = through ((Point) { 125, 15 }, 1.57, 170, 0, 14, CELD_ARROW_HEAD, false);
  Answer    answer;
  CeldPaint page;
  int       red = 0;

  for (int k = 0; k < 2; k++)
    draw_arrow (&paint, &below[k], GREEN);
  for (int y = 0; y < SIZE; y++) /* hard paint covers what is below, which draw_arrow does only where it is stronger */
    for (int x = 0; x < SIZE; x++)
      if (opacity_at (&above, (Point) { x + 0.5, y + 0.5 }) > 0.5)
        memcpy (CELD_RGBA (&paint, x, y), (uint8_t[]) { ORANGE[0], ORANGE[1], ORANGE[2], 255 }, 4);
  answer = read_paint (&paint, CELD_ARROW_HEAD);
  page   = paint_problems (&answer, SIZE, SIZE);
  CHECK (is_read (&answer, &above, CELD_ARROW_HEAD));
  for (size_t i = 0; i < answer.problems.n; i++)
    CHECK (answer.problems.item[i].reason == CELD_REASON_HIDDEN);
  for (int y = 0; y < SIZE; y++)
    for (int x = 0; x < SIZE; x++)
      {
        bool orange = opacity (&paint, x, y) == 255 && CELD_RGBA (&paint, x, y)[0] > 200;

        CHECK (!(orange && is_red (&page, x, y)));
        red += is_red (&page, x, y);
      }
  CHECK (answer.problems.n > 0 && red > 500);
  forget (&answer);
  free (page.data);
  free (paint.data);
}

/* ------------------------------------------------------------------ what is joined, and any pages */

#define SEVERAL 5

/* Directions at random, each at least 18 degrees from all others. */
static void
choose_directions (uint32_t *state, double direction[SEVERAL])
{
  for (int k = 0; k < SEVERAL;)
    {
      bool apart = true;

      direction[k] = random_between (state, 0, 6.28);
      for (int i = 0; i < k; i++)
        apart &= cos (direction[k] - direction[i]) < 0.95;
      k += apart;
    }
}

/* Of arrows that share an end the middles of those that are read are not red, and those of all others are. */
static void
some_of_several (void)
{
  uint32_t state = 3;
  int      mixed = 0;

  for (int i = 0; i < 100; i++)
    {
      CeldArrowStyle style = STYLES[i % 4];
      CeldPaint      paint = blank (SIZE, SIZE), page;
      double         direction[SEVERAL];
      Arrow          a[SEVERAL];
      Answer         answer;
      size_t         found;

      choose_directions (&state, direction);
      for (int k = 0; k < SEVERAL; k++)
        {
          double length = random_between (&state, 55, 85);
          bool   ends_here = check_random (&state, 2);

          a[k] = through ((Point) { 100, 100 }, direction[k] + (ends_here ? 3.1416 : 0), length, ends_here, 4, style,
                          i % 8 < 4);
          draw_arrow (&paint, &a[k], GREEN);
        }
      answer = read_paint (&paint, style);
      page   = paint_problems (&answer, SIZE, SIZE);
      found  = count_read (&answer, a, SEVERAL, style);
      mixed += found > 0 && found < SEVERAL;
      for (int k = 0; k < SEVERAL; k++)
        for (int p = 6; p < 11; p++)
          CHECK (is_red (&page, (int) a[k].point[p].x, (int) a[k].point[p].y) == !is_read (&answer, &a[k], style));
      forget (&answer);
      free (page.data);
      free (paint.data);
    }
  CHECK (mixed >= 5);
}

/* Arrows at random, of one colour or two, at random places or from one. */
static CeldPaint
draw_page (uint32_t *state, CeldArrowStyle style, int colours)
{
  CeldPaint paint = blank (SIZE, SIZE);
  bool      shared = check_random (state, 2);
  int       n = 1 + (int) check_random (state, 6);

  for (int k = 0; k < n; k++)
    {
      double w = random_between (state, 2, 7), x = random_between (state, 0, SIZE), y = random_between (state, 0, SIZE);
      double angle = random_between (state, 0, 6.28), widths = random_between (state, 2, 18);
      double share = random_between (state, 0, 1);
      bool   open = check_random (state, 2);
      Arrow  a = through (shared ? (Point) { 100, 100 } : (Point) { x, y }, angle, widths * w, shared ? 0 : share, w,
                          style, open);

      if (!check_random (state, 3))
        {
          a.head       = BARE;
          a.last_alpha = 1;
          a.last_width = a.width;
        }
      draw_arrow (&paint, &a, check_random (state, (uint32_t) colours) ? ORANGE : GREEN);
    }
  return paint;
}

/* Each problem has a reason and paint, which lies on the layer; all of its pixels are red. */
static void
every_problem_is_seen (void)
{
  uint32_t state = 11;

  for (int i = 0; i < 160; i++)
    {
      CeldArrowStyle style = STYLES[i % 4];
      CeldPaint      paint = draw_page (&state, style, 1 + i % 2), page;
      Answer         answer = read_paint (&paint, style);

      page = paint_problems (&answer, SIZE, SIZE);
      for (size_t k = 0; k < answer.problems.n; k++)
        {
          const CeldProblem *p = &answer.problems.item[k];

          CHECK (p->reason != CELD_REASON_NONE && p->runs > 0 && p->first + p->runs <= answer.problems.n_runs);
          for (size_t r = p->first; r < p->first + p->runs; r++)
            {
              const CeldPaintRun *run = &answer.problems.run[r];

              CHECK (run->n > 0 && run->x >= 0 && run->x + run->n <= SIZE && run->y >= 0 && run->y < SIZE);
              for (int x = run->x; x < run->x + run->n; x++)
                CHECK (opacity (&paint, x, run->y) >= least_opacity (style) && is_red (&page, x, run->y));
            }
        }
      forget (&answer);
      free (page.data);
      free (paint.data);
    }
}

/* Where nothing is read of one colour, all paint but specks is red. */
static void
nothing_is_left_out (void)
{
  uint32_t state = 5;
  int      pages = 0;

  for (int i = 0; i < 160; i++)
    {
      CeldArrowStyle style = STYLES[i % 4];
      CeldPaint      paint = draw_page (&state, style, 1), page;
      Answer         answer = read_paint (&paint, style);
      int            missed = 0;

      page = paint_problems (&answer, SIZE, SIZE);
      for (int y = 0; y < SIZE && !answer.relations.n; y++)
        for (int x = 0; x < SIZE; x++)
          missed += opacity (&paint, x, y) >= least_opacity (style) && !is_red (&page, x, y);
      CHECK (missed < 6); /* a speck */
      pages += !answer.relations.n && answer.problems.n > 0;
      forget (&answer);
      free (page.data);
      free (paint.data);
    }
  CHECK (pages >= 30);
}

int
main (void)
{
  RUN (too_short);
  RUN (alike_at_both_ends);
  RUN (two_heads);
  RUN (heads_in_other_styles);
  RUN (strong_in_the_middle);
  RUN (sharp_corner);
  RUN (three_that_meet);
  RUN (crossed_by_an_unclear_one);
  RUN (piece_of_another);
  RUN (along_the_edge);
  RUN (below_another);
  RUN (some_of_several);
  RUN (every_problem_is_seen);
  RUN (nothing_is_left_out);
  return DONE;
}
