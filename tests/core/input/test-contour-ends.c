/* Which open ends of virtual contours are joined, to what, and by which pixels.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "input/input.h"

enum { SIDE = 40 }; /* ends are joined over up to five pixels */

typedef struct { CeldContourBake bake; float breadth[4]; } Picture;

/* A picture without ink and strokes. */
static Picture *
picture_new (int width, int height)
{
  size_t   n = (size_t) width * (size_t) height, stride = (size_t) width;
  Picture *p = calloc (1, sizeof *p);

  p->bake = (CeldContourBake) {
    .width = width, .height = height, .pixels = n, .ink = { width, height, stride, malloc (n * sizeof (float)) },
    .wall = { width, height, stride, calloc (n, 1) },
    .component = { width, height, stride, calloc (n, sizeof (uint32_t)) }, .n = 3, .breadth = p->breadth,
  };
  for (size_t k = 0; k < n; k++)
    p->bake.ink.data[k] = 1;
  return p;
}

static void
picture_free (Picture *p)
{
  free (p->bake.ink.data);
  free (p->bake.wall.data);
  free (p->bake.component.data);
  free (p);
}

/* A rectangle of a stroke, or of ink for stroke 0; the last column and row included. */
static void
draw (Picture *p, uint32_t stroke, int left, int top, int right, int bottom)
{
  int width = right - left, height = bottom - top;

  for (int y = top; y <= bottom; y++)
    for (int x = left; x <= right; x++)
      if (stroke)
        CELD_AT (&p->bake.component, x, y) = stroke;
      else
        CELD_AT (&p->bake.ink, x, y) = 0;
  p->breadth[stroke] = (float) (width < height ? width : height) + 1;
}

/* The columns in which walls were made, as a bit set, among the rows top .. bottom; none may be elsewhere. */
static uint64_t
join (Picture *p, int top, int bottom)
{
  uint64_t columns = 0;

  CHECK (celd_contour_join (&p->bake, NULL) == CELD_OK);
  for (int y = 0; y < p->bake.height; y++)
    for (int x = 0; x < p->bake.width; x++)
      if (CELD_AT (&p->bake.wall, x, y))
        {
          CHECK (y >= top && y <= bottom);
          columns |= (uint64_t) 1 << x;
        }
  return columns;
}

/* Are the walls exactly these rectangles, given as left, top, right, bottom? */
static bool
walls_are (Picture *p, const int (*rectangle)[4], size_t n)
{
  bool same = celd_contour_join (&p->bake, NULL) == CELD_OK;

  for (int y = 0; y < p->bake.height; y++)
    for (int x = 0; x < p->bake.width; x++)
      {
        bool wanted = false;

        for (size_t k = 0; k < n; k++)
          wanted = wanted || (x >= rectangle[k][0] && y >= rectangle[k][1] && x <= rectangle[k][2] &&
                              y <= rectangle[k][3]);
        same = same && CELD_AT (&p->bake.wall, x, y) == wanted;
      }
  return same;
}

static uint64_t
span (int first, int last)
{
  return (((uint64_t) 1 << (last + 1)) - 1) & ~(((uint64_t) 1 << first) - 1);
}

static void
an_end_is_joined_over_five_pixels_at_most (void)
{
  for (int gap = 2; gap <= 8; gap++)
    {
      Picture *p = picture_new (SIDE, SIDE);
      uint64_t columns;

      draw (p, 1, 10, 18, 20, 19);
      draw (p, 0, 20 + gap, 0, 20 + gap, SIDE - 1);
      columns = join (p, 17, 21);
      if (gap <= 5)
        {
          CHECK ((columns & span (21, 19 + gap)) == span (21, 19 + gap));
          CHECK (!(columns & span (0, 15)));
        }
      else
        CHECK (!columns);
      picture_free (p);
    }
}

static void
the_side_of_a_stroke_is_no_end (void)
{
  Picture *p = picture_new (SIDE, SIDE);

  draw (p, 1, 6, 18, 33, 19);
  draw (p, 0, 17, 22, 22, 22);
  CHECK (!join (p, 0, SIDE - 1));
  picture_free (p);
}

static void
ends_are_joined_to_the_frame_and_to_other_strokes (void)
{
  Picture *p = picture_new (SIDE, SIDE);
  uint64_t columns;

  draw (p, 1, 3, 18, 15, 19);
  draw (p, 2, 19, 18, 30, 19);
  columns = join (p, 17, 21);
  CHECK ((columns & span (0, 2)) == span (0, 2));
  CHECK ((columns & span (16, 18)) == span (16, 18));
  CHECK (!(columns & span (32, SIDE - 1)));
  picture_free (p);
}

static void
a_dab_closes_a_gap_on_both_sides (void)
{
  Picture *p = picture_new (SIDE, SIDE);
  uint64_t columns;

  draw (p, 0, 0, 18, 14, 20);
  draw (p, 1, 18, 18, 20, 20);
  draw (p, 0, 24, 18, SIDE - 1, 20);
  columns = join (p, 17, 22);
  CHECK ((columns & span (15, 17)) == span (15, 17));
  CHECK ((columns & span (21, 23)) == span (21, 23));
  picture_free (p);
}

static void
nothing_is_joined_when_cancelled_or_without_strokes (void)
{
  Picture *p = picture_new (SIDE, SIDE);
  CeldHost host = { .progress = check_refuse };

  draw (p, 0, 20, 0, 20, SIDE - 1);
  CHECK (!join (p, 0, SIDE - 1));
  draw (p, 1, 10, 18, 17, 19);
  CHECK (celd_contour_join (&p->bake, &host) == CELD_CANCELLED);
  CHECK (!memchr (p->bake.wall.data, 1, p->bake.pixels));
  picture_free (p);
}

/* The stroke's lowest pixel on the right, (20,19), is joined to one pixel of ink at a distance of five pixels, by
 * blocks of 2 x 2; a pixel of ink a little farther away is not near enough. */
static void
a_joint_is_two_pixels_wide (void)
{
  static const int slanted[][4] = { { 21, 20, 22, 21 }, { 22, 21, 24, 22 }, { 24, 22, 25, 23 } };
  static const int straight[][4] = { { 21, 18, 25, 19 } };
  Picture         *p = picture_new (SIDE, SIDE);

  draw (p, 1, 10, 18, 20, 19);
  draw (p, 0, 24, 22, 24, 22);
  CHECK (walls_are (p, slanted, 3));
  picture_free (p);
  p = picture_new (SIDE, SIDE);
  draw (p, 1, 10, 18, 20, 19);
  draw (p, 0, 24, 23, 24, 23);
  CHECK (walls_are (p, NULL, 0));
  draw (p, 0, 24, 0, 24, SIDE - 1);
  CHECK (walls_are (p, straight, 1));
  picture_free (p);
}

/* Five pixels, and one more for each 256 of the shorter side. */
static void
large_pictures_have_longer_joints (void)
{
  static const struct { int width, height, gap; bool joined; } given[] = {
    { 255, 300, 5, true },  { 255, 300, 6, false }, { 300, 255, 6, false },
    { 256, 300, 6, true },  { 300, 256, 6, true },  { 300, 256, 7, false },
  };

  for (size_t k = 0; k < sizeof given / sizeof *given; k++)
    {
      Picture *p = picture_new (given[k].width, given[k].height);

      draw (p, 1, 100, 118, 120, 119);
      draw (p, 0, 120 + given[k].gap, 100, 120 + given[k].gap, 140);
      CHECK (celd_contour_join (&p->bake, NULL) == CELD_OK);
      CHECK (!memchr (p->bake.wall.data, 1, p->bake.pixels) == !given[k].joined);
      picture_free (p);
    }
}

static void
ink_is_at_most_one_half (void)
{
  for (int k = 0; k < 2; k++)
    {
      Picture *p = picture_new (SIDE, SIDE);

      draw (p, 1, 10, 18, 20, 19);
      for (int y = 0; y < SIDE; y++)
        CELD_AT (&p->bake.ink, 24, y) = k ? 0.51f : 0.5f;
      CHECK (k ? !join (p, 0, SIDE - 1) : join (p, 18, 19) == span (21, 25));
      picture_free (p);
    }
}

/* One end touches ink on its right, so that it is not joined to the ink above it as well; the other end is. */
static void
an_end_that_touches_ink_needs_no_other_joint (void)
{
  static const int touching[][4] = { { 31, 18, 32, 19 } };
  static const int both[][4] = { { 31, 18, 32, 19 }, { 10, 14, 11, 18 } };
  Picture         *p = picture_new (SIDE, SIDE);

  draw (p, 1, 10, 18, 30, 19);
  draw (p, 0, 31, 16, 31, 21);
  draw (p, 0, 26, 14, 30, 14);
  CHECK (walls_are (p, touching, 1));
  draw (p, 0, 10, 14, 10, 14);
  CHECK (walls_are (p, both, 2));
  picture_free (p);
}

/* A dab is, though: it may have been painted into a gap. */
static void
a_dab_that_touches_ink_is_joined_on_the_other_side (void)
{
  static const int walls[][4] = { { 17, 19, 18, 20 }, { 21, 18, 23, 19 } };
  Picture         *p = picture_new (SIDE, SIDE);

  draw (p, 0, 17, 19, 17, 19);
  draw (p, 1, 18, 18, 20, 20);
  draw (p, 0, 22, 18, 22, 20);
  CHECK (walls_are (p, walls, 2));
  picture_free (p);
}

/* Ends of a stroke two pixels wide that is parallel to ink four pixels above: the leftmost pixel is joined, and of the
 * right end the first that is more than ten pixels away from it, twice the half side of the square round an end. */
static void
joints_in_one_direction_keep_a_distance (void)
{
  for (int length = 11; length <= 12; length++)
    {
      Picture *p = picture_new (SIDE, SIDE);

      draw (p, 1, 12, 18, 11 + length, 19);
      draw (p, 0, 0, 14, SIDE - 1, 14);
      CHECK (join (p, 14, 18) == (length == 11 ? span (12, 13) : span (12, 13) | span (23, 24)));
      picture_free (p);
    }
}

/* The end with the nearest target comes first: the joint to the right makes the longer one in that direction, from the
 * pixel above, needless. */
static void
the_shortest_joint_is_made_first (void)
{
  static const int walls[][4] = { { 21, 19, 24, 20 } };
  Picture         *p = picture_new (SIDE, SIDE);

  draw (p, 1, 10, 18, 20, 19);
  draw (p, 0, 24, 18, 24, 18);
  draw (p, 0, 23, 19, 23, 19);
  CHECK (walls_are (p, walls, 1));
  picture_free (p);
}

/* A stroke along the frame is joined to it without a gap, which changes nothing outside of the stroke. */
static void
strokes_that_reach_the_frame_stay (void)
{
  Picture *p = picture_new (SIDE, SIDE);

  draw (p, 1, 0, 18, 15, 19);
  draw (p, 2, SIDE - 16, 0, SIDE - 1, 1);
  draw (p, 3, 18, SIDE - 12, 19, SIDE - 1);
  CHECK (celd_contour_join (&p->bake, NULL) == CELD_OK);
  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      CHECK (!CELD_AT (&p->bake.wall, x, y) || CELD_AT (&p->bake.component, x, y));
  picture_free (p);
}

/* Of targets at one distance the upper one is taken. */
static void
of_two_targets_the_upper_one_is_joined (void)
{
  static const int walls[][4] = { { 21, 18, 23, 19 }, { 23, 17, 25, 18 } };
  Picture         *p = picture_new (SIDE, SIDE);

  draw (p, 1, 10, 19, 20, 19);
  draw (p, 0, 24, 17, 24, 17);
  draw (p, 0, 24, 21, 24, 21);
  CHECK (walls_are (p, walls, 2));
  picture_free (p);
}

/* The square round a pixel in the middle meets the stroke in two corners. */
static void
the_side_of_a_diagonal_stroke_is_no_end (void)
{
  for (int k = 0; k < 2; k++)
    {
      Picture *p = picture_new (SIDE, SIDE);

      for (int x = 8; x <= 31; x++)
        draw (p, 1, x, k ? SIDE - 1 - x : x, x, k ? SIDE - 1 - x : x);
      draw (p, 0, 20, 16, 20, 16);
      draw (p, 0, 20, 23, 20, 23);
      CHECK (!join (p, 0, SIDE - 1));
      picture_free (p);
    }
}

/* The square round the end (16,16) of a stroke meets it in its upper left corner and the pixel below: one place. */
static void
a_diagonal_end_is_joined (void)
{
  static const int walls[][4] = { { 17, 16, 21, 17 } };
  Picture         *p = picture_new (SIDE, SIDE);

  for (int x = 6; x <= 16; x++)
    draw (p, 1, x, x, x, x + (x < 16));
  p->breadth[1] = 1;
  draw (p, 0, 20, 16, 20, 16);
  CHECK (walls_are (p, walls, 1));
  picture_free (p);
}

/* The square round (20,20) meets the stroke on its left, just below the corner, and on its right. */
static void
two_places_at_a_corner_and_opposite_are_two (void)
{
  Picture *p = picture_new (SIDE, SIDE);

  draw (p, 1, 16, 17, 16, 17);
  draw (p, 1, 20, 20, 20, 20);
  draw (p, 1, 24, 20, 24, 20);
  draw (p, 0, 20, 24, 20, 24);
  CHECK (!join (p, 0, SIDE - 1));
  picture_free (p);
}

/* Ink at a corner of the end is touched, too: the ink four pixels above is not joined. */
static void
an_end_that_touches_ink_diagonally_needs_no_other_joint (void)
{
  static const int walls[][4] = { { 31, 20, 32, 21 } };
  Picture         *p = picture_new (SIDE, SIDE);

  draw (p, 1, 10, 18, 30, 19);
  draw (p, 0, 31, 20, 31, 20);
  draw (p, 0, 28, 14, 30, 14);
  CHECK (walls_are (p, walls, 1));
  picture_free (p);
}

/* The end is up to four pixels away from the edge of the picture, in each direction; one pixel more is too far. */
static void
all_sides_of_the_frame_are_joined (void)
{
  for (int k = 0; k < 8; k++)
    {
      Picture *p = picture_new (SIDE, SIDE);
      int      from = 4 + k / 4, to = SIDE - 1 - from;

      switch (k % 4)
        {
        case 0:  draw (p, 1, from, 18, 20, 19); break;
        case 1:  draw (p, 1, 20, 18, to, 19); break;
        case 2:  draw (p, 1, 18, from, 19, 20); break;
        default: draw (p, 1, 18, 20, 19, to);
        }
      CHECK (celd_contour_join (&p->bake, NULL) == CELD_OK);
      CHECK (!memchr (p->bake.wall.data, 1, p->bake.pixels) == (from == 5));
      picture_free (p);
    }
}

/* Ink to the right and ink above, from the column 17 on: joints at a right angle do not replace each other. */
static void
one_end_is_joined_to_two_sides (void)
{
  static const int walls[][4] = { { 21, 18, 24, 19 }, { 17, 14, 18, 18 } };
  Picture         *p = picture_new (SIDE, SIDE);

  draw (p, 1, 10, 18, 20, 19);
  draw (p, 0, 23, 18, 23, 19);
  draw (p, 0, 17, 14, 20, 14);
  CHECK (walls_are (p, walls, 2));
  picture_free (p);
}

int
main (void)
{
  RUN (an_end_is_joined_over_five_pixels_at_most);
  RUN (the_side_of_a_stroke_is_no_end);
  RUN (ends_are_joined_to_the_frame_and_to_other_strokes);
  RUN (a_dab_closes_a_gap_on_both_sides);
  RUN (nothing_is_joined_when_cancelled_or_without_strokes);
  RUN (a_joint_is_two_pixels_wide);
  RUN (large_pictures_have_longer_joints);
  RUN (ink_is_at_most_one_half);
  RUN (an_end_that_touches_ink_needs_no_other_joint);
  RUN (a_dab_that_touches_ink_is_joined_on_the_other_side);
  RUN (joints_in_one_direction_keep_a_distance);
  RUN (the_shortest_joint_is_made_first);
  RUN (strokes_that_reach_the_frame_stay);
  RUN (of_two_targets_the_upper_one_is_joined);
  RUN (the_side_of_a_diagonal_stroke_is_no_end);
  RUN (a_diagonal_end_is_joined);
  RUN (two_places_at_a_corner_and_opposite_are_two);
  RUN (an_end_that_touches_ink_diagonally_needs_no_other_joint);
  RUN (all_sides_of_the_frame_are_joined);
  RUN (one_end_is_joined_to_two_sides);
  return DONE;
}
