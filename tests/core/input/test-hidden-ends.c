/* Where arrows end whose ends are hidden below others: in a square of paint, known only where others tell.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "input/arrows.h"

#include <math.h>

#define SIZE 120

/* All of it is painted, but for the columns from `gap` on, three of them. */
static CeldStrokeMask
square (int gap)
{
  CeldStrokeMask mask = { .width = SIZE, .height = SIZE, .painted = malloc (SIZE * SIZE) };

  for (int i = 0; i < SIZE * SIZE; i++)
    mask.painted[i] = i % SIZE < gap || i % SIZE >= gap + 3;
  return mask;
}

/* An end at a place that is reached in a direction, in radians. */
static CeldArrowEnd
end_at (double x, double y, double angle, bool visible)
{
  return (CeldArrowEnd) { .at = { x, y }, .place = { x, y }, .way = { cos (angle), sin (angle) }, .width = 6,
                          .lean = 6, .visible = visible };
}

/* An end of an arrow, the farther one or the nearer one, beside the nearer one of another arrow, which is another
 * stroke; the other ends are far away and seen. */
static CeldArrowEnd
put_beside (CeldArrowEnd one, bool farther, CeldArrowEnd two, int gap, bool graded)
{
  CeldStrokeMask mask = square (gap);
  CeldArrowEnd   ends[4] = { end_at (5, 5, 0, true), end_at (5, 5, 0, true), two, end_at (5, 110, 0, true) };

  ends[farther] = one;
  ends[2].stroke = ends[3].stroke = 1;
  celd_arrow_ends_find (&mask, graded, ends, 4);
  CHECK (ends[!farther].known && ends[3].known);
  free (mask.painted);
  return ends[farther];
}

static CeldArrowEnd
beside (CeldArrowEnd one, CeldArrowEnd two, int gap, bool graded)
{
  return put_beside (one, true, two, gap, graded);
}

static bool
is_at (CeldArrowEnd end, double x, double y)
{
  return end.known && hypot (end.place.x - x, end.place.y - y) < 1e-6;
}

static void
leads_below_others (void)
{
  CeldArrowEnd hidden = end_at (50, 60, 0, false), seen = end_at (70, 61, 2, true);

  CHECK (is_at (beside (hidden, seen, SIZE, true), 70, 61));
  CHECK (is_at (beside (hidden, seen, SIZE, false), 70, 61));
  CHECK (is_at (put_beside (hidden, false, seen, SIZE, false), 70, 61));
  CHECK (!beside (hidden, seen, 60, true).known);                         /* no paint on the way */
  CHECK (!beside (hidden, end_at (70, 75, 2, true), SIZE, true).known);   /* aside */
  CHECK (!beside (hidden, end_at (40, 61, 2, true), SIZE, true).known);   /* behind */
  CHECK (!beside (hidden, end_at (100, 61, 2, true), SIZE, true).known);  /* too far */
}

static void
more_of_it_may_follow (void)
{
  CeldArrowEnd hidden = end_at (50, 60, 0, false);

  hidden.broken = true;
  CHECK (!beside (hidden, end_at (70, 61, 2, true), SIZE, true).known);
  CHECK (!beside (hidden, end_at (51, 61, 2, true), SIZE, true).known);
}

/* What follows is another arrow, if that has a head in sight, or a dot at its other end. */
static void
another_arrow_may_follow (void)
{
  CeldArrowEnd hidden = end_at (50, 60, 0, false), head = end_at (70, 61, 2, true), tip = end_at (52, 61, 2, false);

  hidden.broken = hidden.bare = true;
  hidden.beyond = 1;
  CHECK (is_at (beside (hidden, head, SIZE, false), 70, 61));
  CHECK (!beside (hidden, tip, SIZE, false).known);
  tip.bare = true;
  CHECK (!beside (hidden, tip, SIZE, false).known);
  tip.dotted = true;
  CHECK (beside (hidden, tip, SIZE, false).known);
  hidden.bare = false; /* what looks like its head may be another one's */
  CHECK (!beside (hidden, head, SIZE, false).known);
  hidden.bare   = true;
  hidden.beyond = SIZE_MAX;
  CHECK (!beside (hidden, head, SIZE, false).known);
}

/* A third arrow that hides two side by side does so at one place, which is the end of neither. */
static void
both_are_hidden (void)
{
  CeldArrowEnd hidden = end_at (50, 60, 0, false);

  CHECK (!beside (hidden, end_at (50, 64, 0.3, false), SIZE, true).known);
  CHECK (!beside (hidden, end_at (50, 64, 0.6, false), SIZE, false).known);
  CHECK (beside (hidden, end_at (50, 64, -1.2, false), SIZE, true).known);
  CHECK (beside (hidden, end_at (50, 60, 3, false), SIZE, true).known); /* head to tail */
  CHECK (is_at (beside (hidden, end_at (65, 75, -CELD_PI / 2, false), SIZE, true), 65, 60));
  CHECK (!beside (hidden, end_at (65, 75, CELD_PI / 2, false), SIZE, true).known);  /* leads away */
  CHECK (!beside (hidden, end_at (60, 66, -0.5, false), SIZE, true).known);         /* too sharp an angle to tell */
}

/* Where an arrow that fades or tapers begins, it is strong: others that hide more of it go on as it does. */
static void
nearer_ends_do_not_lead (void)
{
  CeldArrowEnd hidden = end_at (50, 60, 0, false);

  CHECK (!put_beside (hidden, false, end_at (70, 61, 2, true), SIZE, true).known);
  CHECK (!put_beside (hidden, false, end_at (50, 60, 3, true), SIZE, true).known);
  CHECK (put_beside (hidden, false, end_at (50, 60, 3, true), SIZE, false).known);
  CHECK (put_beside (hidden, false, end_at (50, 60, 2, true), SIZE, true).known);
}

/* Ends in sight tell first, also where they are farther than one that is hidden. */
static void
ends_in_sight_tell_first (void)
{
  CeldStrokeMask mask = square (SIZE);
  CeldArrowEnd   ends[6] = {
    end_at (5, 5, 0, true), end_at (50, 60, 0, false), end_at (52, 60, 2, false), end_at (5, 110, 0, true),
    end_at (70, 61, 2, true), end_at (110, 110, 0, true),
  };

  ends[2].stroke = ends[3].stroke = 1;
  celd_arrow_ends_find (&mask, false, ends, 6);
  CHECK (is_at (ends[1], 70, 61));
  free (mask.painted);
}

/* An arrow that others hide for a short way ends in the middle of that, or where another one does beside it. */
static void
short_ways_are_known (void)
{
  CeldArrowEnd hidden = end_at (50, 60, 0, false), seen = end_at (56, 71, 2, true);

  CHECK (!beside (hidden, end_at (5, 110, 0, true), SIZE, false).known);
  hidden.is_near = true;
  hidden.middle  = (CeldPoint) { 54, 60 };
  CHECK (is_at (beside (hidden, end_at (5, 110, 0, true), SIZE, false), 54, 60));
  CHECK (is_at (beside (hidden, seen, SIZE, false), 56, 71));
  hidden.lean = 3;
  CHECK (is_at (beside (hidden, seen, SIZE, false), 54, 60)); /* its head is wide, but not its line */
  hidden.broken = true;
  CHECK (!beside (hidden, seen, SIZE, false).known);
}

/* Two arrows of one stroke were read together: where both ends are hidden, neither shows that the other is right. */
static void
hidden_ends_of_one_stroke_tell_nothing (void)
{
  for (int visible = 0; visible < 2; visible++)
    {
      CeldStrokeMask mask = square (SIZE);
      CeldArrowEnd   ends[4] = {
        end_at (5, 5, 0, true), end_at (50, 60, 0, false), end_at (50, 60, 3, visible), end_at (5, 110, 0, true),
      };

      celd_arrow_ends_find (&mask, false, ends, 4);
      CHECK (ends[1].known == visible);
      free (mask.painted);
    }
}

/* An arrow that others may hide for a few widths ends there if others do, at their place if that is known. */
static void
ends_about_others (void)
{
  CeldArrowEnd hidden = end_at (50, 60, 0, false), other = end_at (62, 71, 0.5, false);

  hidden.about = (CeldPoint) { 56, 60 };
  CHECK (!beside (hidden, other, SIZE, true).known);
  hidden.is_about = true;
  CHECK (is_at (beside (hidden, other, SIZE, true), 56, 60));
  other.visible = true;
  CHECK (is_at (beside (hidden, other, SIZE, true), 62, 71));
  CHECK (!beside (hidden, end_at (62, 76, 0.5, true), SIZE, true).known);
  hidden.lean = 3;
  CHECK (!beside (hidden, other, SIZE, true).known);
  hidden.lean   = 6;
  hidden.broken = true;
  CHECK (!beside (hidden, other, SIZE, true).known);
  hidden.broken = false;
  hidden.stroke = 1;
  CHECK (!beside (hidden, other, SIZE, true).known);
}

/* An arrow whose paint ends beside another one does not go on below all of that. */
static void
never_below_a_whole_arrow (void)
{
  CeldStrokeMask mask = square (SIZE);
  CeldArrowEnd   ends[4] = {
    end_at (5, 60, CELD_PI, true), end_at (50, 60, 0, false), end_at (75, 60, 0, true), end_at (45, 60, CELD_PI, true),
  };

  celd_arrow_ends_find (&mask, false, ends, 4);
  CHECK (is_at (ends[1], 45, 60));
  free (mask.painted);
}

static void
own_ends_do_not_count (void)
{
  CeldStrokeMask mask = square (SIZE);
  CeldArrowEnd   ends[2] = { end_at (60, 60, CELD_PI, true), end_at (50, 60, 0, false) };

  celd_arrow_ends_find (&mask, true, ends, 2);
  CHECK (ends[0].known && !ends[1].known);
  free (mask.painted);
}

/* Paint in a square: that of an arrow, and what else hides it or lies beside it. */
typedef struct { int left, top, right, bottom; bool own; } Box;

/* The end at (50,60) of an arrow of width 5 that comes from the left, among some paint. */
static CeldArrowEnd
end_among (const Box *box, int n)
{
  CeldStrokeMask    mask = { .width = SIZE, .height = SIZE, .painted = calloc (SIZE, SIZE) };
  CeldPaint         paint = { SIZE, SIZE, SIZE, malloc (4 * SIZE * SIZE) };
  CeldArrowLayer    layer = { .paint = &paint, .strongest = 255 };
  CeldArrowStroke   stroke = { .width = SIZE, .height = SIZE };
  uint32_t         *pixel = malloc (SIZE * SIZE * sizeof *pixel);
  bool             *seen = malloc (SIZE * SIZE), never = false;
  size_t            first[2] = { 0, 0 };
  int               colour = 0;
  CeldColourStrokes colours = { { pixel, first, 1, 0 }, &colour, &never, &never, seen, 0, 0, 0, 0, 0 };
  CeldColouredPaint coloured = { &mask, &layer, &colours };
  CeldArrowEnd      end;

  memset (paint.data, 255, 4 * SIZE * SIZE);
  for (int k = 0; k < n; k++)
    for (int y = box[k].top; y < box[k].bottom; y++)
      for (int x = box[k].left; x < box[k].right; x++)
        {
          mask.painted[y * SIZE + x] = 1;
          if (box[k].own)
            {
              seen[stroke.n]    = true;
              pixel[stroke.n++] = (uint32_t) ((y + 1) * (SIZE + 2) + x + 1);
            }
        }
  stroke.pixel = pixel;
  first[1]     = stroke.n;
  end = celd_arrow_end (&coloured, &stroke, 0, (CeldPoint) { 50, 60 }, (CeldPoint) { 10, 60 }, 5, CELD_SIGHT_NONE);
  free (mask.painted);
  free (paint.data);
  free (pixel);
  free (seen);
  return end;
}

static const Box LINE = { 10, 58, 50, 62, true };

/* Its own paint farther on, where nothing leads to it, does not count as a part of the end. */
static void
what_follows_after_a_break (void)
{
  CHECK (end_among ((Box[]) { LINE }, 1).visible);
  CHECK (!end_among ((Box[]) { LINE, { 50, 30, 62, 90, false } }, 2).visible);
  CHECK (end_among ((Box[]) { LINE, { 80, 30, 85, 90, true }, { 85, 30, 110, 90, false } }, 3).visible);
}

/* Only what is as wide as an arrow hides it. */
static void
what_hides_all_the_width (void)
{
  CeldArrowEnd broad = end_among ((Box[]) { LINE, { 50, 30, 61, 90, false } }, 2);
  CeldArrowEnd thin = end_among ((Box[]) { LINE, { 50, 59, 110, 61, false } }, 2);

  CHECK (!broad.visible && !broad.is_near && broad.is_about && hypot (broad.about.x - 56, broad.about.y - 60) < 2);
  CHECK (!thin.visible && !thin.is_near && thin.is_about && hypot (thin.about.x - 51, thin.about.y - 60) < 2);
  CHECK (!end_among ((Box[]) { LINE, { 50, 30, 70, 90, false } }, 2).is_about);
  CHECK (fabs (broad.lean - 4) < 1);
}

int
main (void)
{
  RUN (leads_below_others);
  RUN (more_of_it_may_follow);
  RUN (another_arrow_may_follow);
  RUN (both_are_hidden);
  RUN (nearer_ends_do_not_lead);
  RUN (ends_in_sight_tell_first);
  RUN (short_ways_are_known);
  RUN (hidden_ends_of_one_stroke_tell_nothing);
  RUN (ends_about_others);
  RUN (what_follows_after_a_break);
  RUN (what_hides_all_the_width);
  RUN (never_below_a_whole_arrow);
  RUN (own_ends_do_not_count);
  return DONE;
}
