/* Which open ends of virtual contours are joined, and to what.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "input/input.h"

enum { SIDE = 40 }; /* ends are joined over up to five pixels */

typedef struct
{
  CeldContourBake     bake;
  float    ink[SIDE * SIDE], breadth[4];
  uint8_t  wall[SIDE * SIDE];
  uint32_t part[SIDE * SIDE];
} Sheet;

static Sheet *
sheet_new (void)
{
  Sheet *s = calloc (1, sizeof *s);

  s->bake = (CeldContourBake) {
    .width = SIDE, .height = SIDE, .pixels = SIDE * SIDE, .ink = { SIDE, SIDE, SIDE, s->ink },
    .wall = { SIDE, SIDE, SIDE, s->wall }, .component = { SIDE, SIDE, SIDE, s->part }, .n = 3, .breadth = s->breadth,
  };
  for (int i = 0; i < SIDE * SIDE; i++)
    s->ink[i] = 1;
  return s;
}

/* A rectangle of a stroke, or of ink for stroke 0; the last column and row included. */
static void
draw (Sheet *s, uint32_t stroke, int left, int top, int right, int bottom)
{
  int width = right - left, height = bottom - top;

  for (int y = top; y <= bottom; y++)
    for (int x = left; x <= right; x++)
      if (stroke)
        s->part[y * SIDE + x] = stroke;
      else
        s->ink[y * SIDE + x] = 0;
  s->breadth[stroke] = (float) (width < height ? width : height) + 1;
}

/* The columns in which walls were made, as a bit set, among the rows top .. bottom; none may be elsewhere. */
static uint64_t
join (Sheet *s, int top, int bottom)
{
  uint64_t columns = 0;

  CHECK (celd_contour_join (&s->bake, NULL) == CELD_OK);
  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      if (s->wall[y * SIDE + x])
        {
          CHECK (y >= top && y <= bottom);
          columns |= (uint64_t) 1 << x;
        }
  return columns;
}

static uint64_t
span (int first, int last)
{
  return (((uint64_t) 1 << (last + 1)) - 1) & ~(((uint64_t) 1 << first) - 1);
}

static void
an_end_is_joined_within_reach (void)
{
  for (int gap = 2; gap <= 8; gap++)
    {
      Sheet   *s = sheet_new ();
      uint64_t columns;

      draw (s, 1, 10, 18, 20, 19);
      draw (s, 0, 20 + gap, 0, 20 + gap, SIDE - 1);
      columns = join (s, 17, 21);
      if (gap <= 5)
        {
          CHECK ((columns & span (21, 19 + gap)) == span (21, 19 + gap));
          CHECK (!(columns & span (0, 15)));
        }
      else
        CHECK (!columns);
      free (s);
    }
}

static void
the_side_of_a_stroke_is_no_end (void)
{
  Sheet *s = sheet_new ();

  draw (s, 1, 6, 18, 33, 19);
  draw (s, 0, 17, 22, 22, 22);
  CHECK (!join (s, 0, SIDE - 1));
  free (s);
}

static void
ends_are_joined_to_the_frame_and_to_other_strokes (void)
{
  Sheet   *s = sheet_new ();
  uint64_t columns;

  draw (s, 1, 3, 18, 15, 19);
  draw (s, 2, 19, 18, 30, 19);
  columns = join (s, 17, 21);
  CHECK ((columns & span (0, 2)) == span (0, 2));
  CHECK ((columns & span (16, 18)) == span (16, 18));
  CHECK (!(columns & span (32, SIDE - 1)));
  free (s);
}

static void
a_dab_closes_a_gap_on_both_sides (void)
{
  Sheet   *s = sheet_new ();
  uint64_t columns;

  draw (s, 0, 0, 18, 14, 20);
  draw (s, 1, 18, 18, 20, 20);
  draw (s, 0, 24, 18, SIDE - 1, 20);
  columns = join (s, 17, 22);
  CHECK ((columns & span (15, 17)) == span (15, 17));
  CHECK ((columns & span (21, 23)) == span (21, 23));
  free (s);
}

static void
nothing_is_joined_when_cancelled_or_without_strokes (void)
{
  Sheet  *s = sheet_new ();
  CeldHost host = { .progress = check_refuse };

  draw (s, 0, 20, 0, 20, SIDE - 1);
  CHECK (!join (s, 0, SIDE - 1));
  draw (s, 1, 10, 18, 17, 19);
  CHECK (celd_contour_join (&s->bake, &host) == CELD_CANCELLED);
  CHECK (!memchr (s->wall, 1, sizeof s->wall));
  free (s);
}

int
main (void)
{
  RUN (an_end_is_joined_within_reach);
  RUN (the_side_of_a_stroke_is_no_end);
  RUN (ends_are_joined_to_the_frame_and_to_other_strokes);
  RUN (a_dab_closes_a_gap_on_both_sides);
  RUN (nothing_is_joined_when_cancelled_or_without_strokes);
  return DONE;
}
