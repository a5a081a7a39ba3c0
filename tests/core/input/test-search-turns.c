/* Round ends and corners of painted lines, and arrows that are read because they begin or end there.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/arrow-search.h"
#include "shared-ends.h"

#define WIDTH 10
#define MOST  8

/* The paint of a picture as it is traced. */
typedef struct { CeldArrowSearch s; CeldStrokeMask mask; CeldStrokeGraph raw; float *room; uint32_t *pixel; } Traced;

static Traced
trace (const CeldPaint *paint)
{
  size_t          n = (size_t) paint->width * (size_t) paint->height;
  Traced          t = { .room = calloc (n, sizeof *t.room), .pixel = calloc (n, sizeof *t.pixel) };
  CeldArrowStroke stroke = { .width = paint->width, .height = paint->height, .pixel = t.pixel };

  for (size_t y = 0; y < (size_t) paint->height; y++)
    for (size_t x = 0; x < (size_t) paint->width; x++)
      if (paint->data[4 * (y * paint->stride + x) + 3] > 127)
        t.pixel[stroke.n++] = (uint32_t) ((y + 1) * ((size_t) paint->width + 2) + x + 1);
  CHECK (celd_stroke_mask_new (&stroke, &t.mask) == CELD_OK);
  CHECK (celd_stroke_trace (&t.mask, &t.raw) == CELD_OK);
  for (int i = 0; i < t.mask.width * t.mask.height; i++)
    t.room[i] = t.mask.painted[i] ? (float) (sqrt (t.mask.squared[i]) - 0.5) : 0;
  t.s = (CeldArrowSearch) { .width = WIDTH, .room = t.room };
  return t;
}

static void
clear (Traced *t)
{
  celd_stroke_graph_clear (&t->raw);
  celd_stroke_mask_clear (&t->mask);
  free (t->room);
  free (t->pixel);
}

/* Lists the round ends or corners of all lines, as points of the picture; those of one place count once. */
static int
list (Traced *t, CeldTurnKind kind, Point *found)
{
  int n = 0;

  t->s.mask = &t->mask;
  for (size_t k = 0; k < t->raw.n_lines; k++)
    {
      CeldPoint *place;
      size_t     all;

      CHECK (celd_search_turns_list (&t->s, &t->raw.line[k], kind, &place, &all) == CELD_OK);
      for (size_t i = 0; i < all; i++)
        {
          Point p = { place[i].x + t->mask.left, place[i].y + t->mask.top };
          bool  known = false;

          for (int m = 0; m < n; m++)
            known |= hypot (p.x - found[m].x, p.y - found[m].y) < 1.5 * WIDTH;
          if (!known && n < MOST)
            found[n++] = p;
        }
      celd_free (place);
    }
  return n;
}

static bool
is_listed (const Point *found, int n, Point p)
{
  bool any = false;

  for (int i = 0; i < n; i++)
    any |= hypot (p.x - found[i].x, p.y - found[i].y) < WIDTH;
  return any;
}

static Arrow
bare_line (Point from, Point to, double width)
{
  return arrow_at (from, atan2 (to.y - from.y, to.x - from.x), hypot (to.x - from.x, to.y - from.y), width, 0, 0, BARE, 0);
}

/* Two lines that cross, one of them just before it ends: four round ends, and none on the way. */
static void
short_behind_a_crossing (void)
{
  for (int i = 0; i < 12; i++)
    {
      double    angle = 0.5 * i, length = (1.2 + 0.2 * (i % 4)) * WIDTH;
      Point     middle = { SIZE / 2., SIZE / 2. }, end[4], found[MOST];
      CeldPaint paint = blank (SIZE, SIZE);
      Traced    t;
      int       n;

      for (int k = 0; k < 4; k++)
        {
          double r = k == 1 ? length : 80, way = angle + (k < 2 ? 0 : 1.5) + 3.14159265 * (k % 2);

          end[k] = (Point) { middle.x + r * cos (way), middle.y + r * sin (way) };
        }
      for (int k = 0; k < 4; k += 2)
        {
          Arrow a = bare_line (end[k], end[k + 1], WIDTH);

          draw_arrow (&paint, &a, GREEN);
        }
      t = trace (&paint);
      n = list (&t, CELD_TURN_ROUND, found);
      CHECK (n == 4);
      for (int k = 0; k < 4; k++)
        CHECK (is_listed (found, n, end[k]));
      clear (&t);
      free (paint.data);
    }
}

/* A line with a filled head: its tail is round, most corners of heads are not. */
static void
corners_of_a_head (void)
{
  int corners = 0;

  for (int i = 0; i < 12; i++)
    {
      Point     tail = { SIZE / 2., SIZE / 2. }, found[MOST];
      Arrow     a = arrow_at (tail, 0.5 * i, 100, WIDTH, 0, 0, FILLED, 4 * WIDTH);
      CeldPaint paint = blank (SIZE, SIZE);
      Traced    t;
      int       n;

      draw_arrow (&paint, &a, GREEN);
      t = trace (&paint);
      n = list (&t, CELD_TURN_ROUND, found);
      CHECK (is_listed (found, n, tail));
      for (int k = 0; k < 2; k++)
        corners += is_listed (found, n, a.barb[k]);
      clear (&t);
      free (paint.data);
    }
  CHECK (corners <= 8);
}

/* A line that turns just before it meets another one: the corner is found though one of its sides is short. */
static void
short_side_of_a_corner (void)
{
  for (int i = 0; i < 12; i++)
    {
      double    angle = 0.5 * i, side = 1.8 * WIDTH;
      Point     corner = { SIZE / 2., SIZE / 2. }, found[MOST];
      Point     far = { corner.x + 90 * cos (angle), corner.y + 90 * sin (angle) };
      Point     near = { corner.x + side * cos (angle + 1.7), corner.y + side * sin (angle + 1.7) };
      Arrow     a[] = { bare_line (corner, far, WIDTH), bare_line (corner, near, WIDTH),
                        bare_line ((Point) { near.x - 70 * cos (angle), near.y - 70 * sin (angle) },
                                   (Point) { near.x + 70 * cos (angle), near.y + 70 * sin (angle) }, WIDTH) };
      CeldPaint paint = blank (SIZE, SIZE);
      Traced    t;

      for (int k = 0; k < 3; k++)
        draw_arrow (&paint, &a[k], GREEN);
      t = trace (&paint);
      CHECK (is_listed (found, list (&t, CELD_TURN_CORNER, found), corner));
      clear (&t);
      free (paint.data);
    }
}

/* Three that end at one place, and one that begins just behind one of them, which it crosses. */
static void
tails_behind_a_line (void)
{
  uint32_t state = 71;
  int      right = 0;

  for (int i = 0; i < 40; i++)
    {
      double w = random_between (&state, 4, 7), angle = random_between (&state, 0, 6.28);
      Point  middle = { SIZE / 2., SIZE / 2. }, tail;
      Arrow  a[4];

      for (int k = 0; k < 3; k++)
        a[k] = through (middle, angle + 3.14159265 + 2 * k, 18 * w, 1, w, CELD_ARROW_HEAD, i % 2);
      tail = (Point) { middle.x + 9 * w * cos (angle + 0.2), middle.y + 9 * w * sin (angle + 0.2) };
      a[3] = through (tail, angle - 1.3, 11 * w, 0, w, CELD_ARROW_HEAD, i % 2);
      right += read_green (a, 4, CELD_ARROW_HEAD);
    }
  CHECK (right >= 0.75 * 160);
}

int
main (void)
{
  RUN (short_behind_a_crossing);
  RUN (corners_of_a_head);
  RUN (short_side_of_a_corner);
  RUN (tails_behind_a_line);
  return DONE;
}
