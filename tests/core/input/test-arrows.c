/* Painted arrows: the styles, layers with and without alpha, blue strokes, bad input.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "draw-arrows.h"

static void
dots_are_nearer (void)
{
  for (int degrees = 0; degrees < 360; degrees += 15)
    {
      Arrow dot = straight (degrees, 4, DOT, 7), head = straight (degrees, 4, FILLED, 16);
      Arrow line = straight (degrees, 4, BARE, 0);

      CHECK (judge_arrow (&dot, 100, CELD_ARROW_DOT, true) == 1);
      CHECK (judge_arrow (&head, 100, CELD_ARROW_DOT, true) == 0);
      CHECK (judge_arrow (&line, 100, CELD_ARROW_DOT, true) == 0);
    }
}

static void
thick_ends_are_nearer (void)
{
  for (int degrees = 0; degrees < 360; degrees += 15)
    {
      Arrow taper = straight (degrees, 10, BARE, 0), line = straight (degrees, 6, BARE, 0);
      Arrow head = straight (degrees, 4, FILLED, 22); /* thick at its tip, which is farther */

      taper.last_width = 3;
      CHECK (judge_arrow (&taper, 100, CELD_ARROW_TAPER, false) == 1);
      CHECK (judge_arrow (&taper, 100, CELD_ARROW_HEAD, false) == 0);
      CHECK (judge_arrow (&line, 100, CELD_ARROW_TAPER, false) == 0);
      CHECK (judge_arrow (&head, 100, CELD_ARROW_TAPER, false) == 0);
    }
}

static void
opaque_ends_are_nearer (void)
{
  for (int degrees = 0; degrees < 360; degrees += 15)
    {
      Arrow fade = straight (degrees, 6, BARE, 0), even = fade, faint = fade, late = fade;

      fade.last_alpha = 0.1; /* far below one half: still its end */
      even.last_alpha = 0.9;
      faint.alpha     = 0.1;
      late.alpha      = 2; /* opaque for half of the way */
      late.last_alpha = 0.1;
      CHECK (judge_arrow (&fade, 100, CELD_ARROW_FADE, false) == 1);
      CHECK (judge_arrow (&late, 100, CELD_ARROW_FADE, false) == 1);
      CHECK (judge_arrow (&even, 100, CELD_ARROW_FADE, false) == 0);
      CHECK (judge_arrow (&faint, 100, CELD_ARROW_FADE, true) == 1);
    }
}

/* A short arrow leads straight to a long one: from end to end opacity or width falls, but they are two. */
static void
short_ones_lead_to_long_ones (void)
{
  for (int degrees = 0; degrees < 360; degrees += 15)
    for (size_t s = 2; s < 4; s++)
      {
        double    angle = degrees * 0.0174532925, w = 5;
        Arrow     first = through ((Point) { 200, 200 }, angle, 45, 4.6, w, STYLES[s], false);
        Arrow     next = through (first.tip, angle, 300, 0, w, STYLES[s], false);
        CeldPaint paint = blank (400, 400);
        Answer    answer;

        draw_arrow (&paint, &first, GREEN);
        draw_arrow (&paint, &next, GREEN);
        answer = read_paint (&paint, STYLES[s]);
        CHECK (answer.relations.n ==
               (size_t) is_read (&answer, &first, STYLES[s]) + is_read (&answer, &next, STYLES[s]));
        CHECK (answer.relations.n + answer.problems.n >= 1);
        forget (&answer);
        free (paint.data);
      }
}

static void
layers_without_alpha (void)
{
  for (int paper = 0; paper < 256; paper += 255)
    {
      Arrow     head = straight (30, 4, FILLED, 16), fade = straight (70, 6, BARE, 0);
      CeldPaint paint = blank (100, 100), faded = blank (100, 100);
      Answer    answer;

      draw_arrow (&paint, &head, GREEN);
      flatten (&paint, (uint8_t) paper);
      answer = read_paint (&paint, CELD_ARROW_HEAD);
      CHECK (judge (&answer, head.point[0], head.tip, 4) == 1);
      forget (&answer);
      fade.last_alpha = 0.15;
      draw_arrow (&faded, &fade, GREEN);
      flatten (&faded, (uint8_t) paper);
      answer = read_paint (&faded, CELD_ARROW_FADE);
      CHECK (judge (&answer, fade.point[0], fade.tip, 12) == 1);
      forget (&answer);
      free (paint.data);
      free (faded.data);
    }
}

static void
blue_arrows_crack (void)
{
  static const struct { uint8_t colour[3]; bool crack; } KNOWN[] = {
    { { 0, 0, 255 }, true }, { { 30, 80, 230 }, true }, { { 60, 130, 255 }, true }, { { 10, 10, 60 }, true },
    { { 255, 0, 0 }, false }, { { 0, 255, 0 }, false }, { { 0, 255, 255 }, false }, { { 160, 0, 200 }, false },
    { { 0, 0, 0 }, false }, { { 120, 120, 130 }, false }, { { 255, 105, 180 }, false },
  };

  for (size_t i = 0; i < sizeof KNOWN / sizeof *KNOWN; i++)
    {
      Arrow     a = straight (200, 4, OPEN, 16);
      CeldPaint paint = blank (100, 100);
      Answer    answer;

      draw_arrow (&paint, &a, KNOWN[i].colour);
      answer = read_paint (&paint, CELD_ARROW_HEAD);
      CHECK (answer.relations.n == 1 && answer.relations.item[0].crack == KNOWN[i].crack);
      CHECK (answer.relations.item[0].source == CELD_SOURCE_ARROW && answer.relations.item[0].weight == 1 &&
             answer.relations.item[0].gap == 1 && !answer.relations.item[0].equal);
      forget (&answer);
      free (paint.data);
    }
}

/* Several strokes in one layer, appended behind what is there; specks are nothing. */
static void
several_strokes (void)
{
  CeldPaint paint = blank (300, 100);
  Arrow     one = straight (0, 4, FILLED, 16), two = arrow_at ((Point) { 130, 20 }, 1, 60, 5, 0.3, 0, OPEN, 18);
  Arrow     line = arrow_at ((Point) { 220, 20 }, 0.5, 50, 4, 0, 0, BARE, 0);
  Answer    answer = { { 0 }, { 0 } };

  draw_arrow (&paint, &one, GREEN);
  draw_arrow (&paint, &two, BLUE);
  draw_arrow (&paint, &line, GREEN);
  memset (paint.data + 4 * (90 * paint.stride + 280), 255, 4 * 4); /* four pixels */
  CHECK (celd_relations_parse ("1,1>2,2", &answer.relations, NULL) == CELD_OK);
  CHECK (celd_arrows_read (&paint, CELD_ARROW_HEAD, NULL, &answer.relations, &answer.problems) == CELD_OK);
  CHECK (answer.relations.n == 3 && answer.relations.item[0].nearer.x == 1);
  CHECK (answer.problems.n == 1 && answer.problems.item[0].x > 215);
  CHECK (answer.problems.item[0].relation == CELD_NO_INDEX);
  forget (&answer);
  CHECK (celd_arrows_read (&paint, CELD_ARROW_HEAD, NULL, &answer.relations, NULL) == CELD_OK);
  CHECK (answer.relations.n == 2);
  forget (&answer);
  free (paint.data);
}

static bool
stop (void *host, double done)
{
  double *last = host;

  CHECK (done >= *last && done <= 1);
  *last = done;
  return done < 0.7;
}

static void
bad_input (void)
{
  uint8_t   one[4] = { 255, 0, 0, 255 };
  CeldPaint dot = { 1, 1, 1, one }, none = { 0, 3, 1, one };
  CeldPaint empty = blank (40, 3), full = blank (60, 40), paint = blank (100, 100);
  Arrow     a = straight (0, 4, FILLED, 16);
  double    last = 0;
  CeldHost  host = { stop, NULL, &last };
  Answer    answer;

  for (int style = CELD_ARROW_HEAD; style <= CELD_ARROW_TAPER; style++)
    {
      answer = read_paint (&dot, (CeldArrowStyle) style);
      CHECK (answer.relations.n == 0 && answer.problems.n == 0);
      forget (&answer);
      answer = read_paint (&empty, (CeldArrowStyle) style);
      CHECK (answer.relations.n == 0 && answer.problems.n == 0);
      forget (&answer);
      memset (full.data, 200, full.stride * 40 * 4);
      full.data[3] = 0; /* all painted but a corner */
      answer = read_paint (&full, (CeldArrowStyle) style);
      CHECK (answer.relations.n == 0 && answer.problems.n == 1);
      forget (&answer);
    }
  CHECK (celd_arrows_read (&none, CELD_ARROW_HEAD, NULL, &answer.relations, NULL) == CELD_BAD_SIZE);
  draw_arrow (&paint, &a, GREEN);
  CHECK (celd_arrows_read (&paint, CELD_ARROW_HEAD, &host, &answer.relations, &answer.problems) == CELD_CANCELLED);
  CHECK (answer.relations.n == 0 && answer.problems.n == 0 && last > 0.7);
  forget (&answer);
  free (empty.data);
  free (full.data);
  free (paint.data);
}

/* Layers of arrows with heads are told from strokes, of which some may look like arrows, and from a single one. */
static void
layers_of_arrows (void)
{
  for (int arrows = 0; arrows <= 4; arrows++)
    {
      CeldPaint paint = blank (400, 400);
      bool      are = false;

      for (int i = 0; i < 4; i++)
        {
          CeldArrowStyle style = i < arrows ? CELD_ARROW_HEAD : CELD_ARROW_TAPER;
          Arrow          arrow = through ((Point) { 200, 50 + 100.0 * i }, 0, 120, 0.5, 5, style, false);

          draw_arrow (&paint, &arrow, GREEN);
        }
      CHECK (celd_are_arrows (&paint, NULL, &are) == CELD_OK);
      CHECK (are == (arrows >= 3));
      free (paint.data);
    }
  for (int arrows = 0; arrows <= 2; arrows++)
    {
      CeldPaint paint = blank (400, 400);
      bool      are = true;

      for (int i = 0; i < arrows; i++)
        {
          Arrow arrow = through ((Point) { 200, 50 + 100.0 * i }, 0, 120, 0.5, 5, CELD_ARROW_HEAD, false);

          draw_arrow (&paint, &arrow, GREEN);
        }
      CHECK (celd_are_arrows (&paint, NULL, &are) == CELD_OK);
      CHECK (are == (arrows == 2));
      free (paint.data);
    }
}

int
main (void)
{
  RUN (dots_are_nearer);
  RUN (thick_ends_are_nearer);
  RUN (opaque_ends_are_nearer);
  RUN (short_ones_lead_to_long_ones);
  RUN (layers_without_alpha);
  RUN (blue_arrows_crack);
  RUN (several_strokes);
  RUN (bad_input);
  RUN (layers_of_arrows);
  return DONE;
}
