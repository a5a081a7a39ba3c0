/* The ends of outlines under an occluder: places, directions and curvatures of straight and round shapes, which are
 * known.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "layer-scene.h"
#include "sheets/sheets.h"

#define DEGREES (3.14159265358979 / 180)
#define PLACE   2.7 /* pixels: a place is the middle of four sides of pixels, that is two before the end */

/* The shape that is painted, and what lies over it: all places right of a line. */
static double middle_x, middle_y, size, turned, edge;

static double
share_of (double depth)
{
  return fmin (fmax (depth + 0.5, 0), 1);
}

static double
disc (double x, double y)
{
  return share_of (size - hypot (x - middle_x, y - middle_y));
}

/* A bar from the left, turned round the middle; `size` is half its width. */
static double
bar (double x, double y)
{
  return share_of (size - fabs ((y - middle_y) * cos (turned) - (x - middle_x) * sin (turned)));
}

/* A square that stands on a corner turned to the right. */
static double
corner (double x, double y)
{
  return share_of ((size - fabs (x - middle_x) - fabs (y - middle_y)) / sqrt (2));
}

static double
curtain (double x, double y)
{
  (void) y;
  return share_of (x - edge);
}

/* The ends of label 2, which a curtain of label 3 hides; label 1 is behind both. */
static CeldOutlineEnds
ends_of (LayerShare shape, double *pen)
{
  static const float black[3] = { 0, 0, 0 };
  LayerScene         s = layer_scene (200, 160);
  uint8_t            standing[3] = { CELD_BEHIND, CELD_LEVEL, CELD_HIDING };
  CeldSheetView      view = { &s.ink, &s.own, NULL, 2, { 0 }, { 0 }, standing };
  CeldOutlineEnds    ends = { 0 };

  layer_scene_paint (&s, 2, black, shape, NULL);
  layer_scene_paint (&s, 3, black, curtain, NULL);
  for (int y = 0; y < s.height; y++)
    for (int x = 0; x < s.width; x++)
      if (CELD_AT (&s.own.owner, x, y) == 2 || CELD_AT (&s.own.under, x, y) == 2)
        view.seen = celd_rect_union (view.seen, (CeldRect) { x, y, 1, 1 });
  CHECK (celd_outline_ends_find (&view, &ends, pen) == CELD_OK);
  layer_scene_close (&s);
  return ends;
}

/* The end nearest to a place. */
static const CeldOutlineEnd *
end_near (const CeldOutlineEnds *ends, double x, double y)
{
  static const CeldOutlineEnd none = { NAN, NAN, NAN, NAN, NAN };
  const CeldOutlineEnd       *best = &none;

  for (size_t i = 0; i < ends->n; i++)
    if (best == &none || hypot (ends->item[i].x - x, ends->item[i].y - y) < hypot (best->x - x, best->y - y))
      best = &ends->item[i];
  return best;
}

static void
check_end (const CeldOutlineEnds *ends, double x, double y, double direction, double degrees)
{
  const CeldOutlineEnd *end = end_near (ends, x, y);

  CHECK (hypot (end->x - x, end->y - y) <= PLACE);
  CHECK (fabs (remainder (end->direction - direction, 360 * DEGREES)) <= degrees * DEGREES);
}

static void
a_bar_goes_on_straight (void)
{
  edge = 120;
  middle_x = 120;
  middle_y = 80;
  for (size = 5; size < 30; size += 6)
    for (turned = -0.6; turned < 0.7; turned += 0.15)
      {
        double          pen, half = size / cos (turned);
        CeldOutlineEnds ends = ends_of (bar, &pen);

        check_end (&ends, edge, middle_y - half, turned, 4);
        check_end (&ends, edge, middle_y + half, turned, 4);
        NEAR (end_near (&ends, edge, middle_y - half)->curvature, 0, 0.01);
        NEAR (end_near (&ends, edge, middle_y + half)->curvature, 0, 0.01);
        NEAR (end_near (&ends, edge, middle_y - half)->gap, 2 * half, 3);
        NEAR (pen, 0, 0.6);
        celd_free (ends.item);
      }
}

/* The upper end turns clockwise, the lower one the other way.  A parabola is less curved than a small disc of which it
 * has to follow a third. */
static void
a_disc_goes_on_round (void)
{
  middle_x = 90;
  middle_y = 80;
  for (size = 20; size <= 60; size += 10)
    for (double angle = 40; angle <= 140; angle += 20)
      {
        double                pen, dx = size * cos (angle * DEGREES), dy = size * sin (angle * DEGREES);
        CeldOutlineEnds       ends;
        const CeldOutlineEnd *upper, *lower;

        edge = middle_x + dx;
        ends = ends_of (disc, &pen);
        CHECK (ends.n == 2);
        check_end (&ends, edge, middle_y - dy, 90 * DEGREES - angle * DEGREES, size < 30 ? 11 : 9);
        check_end (&ends, edge, middle_y + dy, angle * DEGREES - 90 * DEGREES, size < 30 ? 11 : 9);
        upper = end_near (&ends, edge, middle_y - dy);
        lower = end_near (&ends, edge, middle_y + dy);
        NEAR (upper->curvature * size, 1, size < 40 ? 0.35 : 0.27);
        NEAR (lower->curvature * size, -1, size < 40 ? 0.35 : 0.27);
        celd_free (ends.item);
      }
}

/* Where enough of them is visible. */
static void
sides_of_a_corner_go_on_straight (void)
{
  middle_x = 80;
  middle_y = 80;
  for (size = 40; size <= 70; size += 10)
    for (edge = middle_x + 20; edge < middle_x + size - 8; edge += 7)
      {
        double          pen, half = size - (edge - middle_x);
        CeldOutlineEnds ends = ends_of (corner, &pen);

        CHECK (ends.n == 2);
        check_end (&ends, edge, middle_y - half, 45 * DEGREES, 6);
        check_end (&ends, edge, middle_y + half, -45 * DEGREES, 6);
        celd_free (ends.item);
      }
}

/* Nothing vanishes where nothing hides it. */
static void
a_whole_outline_has_no_ends (void)
{
  double          pen;
  CeldOutlineEnds ends;

  middle_x = middle_y = 80;
  size = 30;
  edge = 150;
  ends = ends_of (disc, &pen);
  CHECK (ends.n == 0);
  celd_free (ends.item);
}

/* ------------------------------------------------------------------ the line */

static double line_width;

static double
line_of_disc (double x, double y)
{
  return share_of (hypot (x - middle_x, y - middle_y) - (size - line_width));
}

static void
the_line_has_its_width (void)
{
  static const float white[3] = { 1, 1, 1 };

  middle_x = middle_y = 80;
  size = 60;
  for (line_width = 1; line_width < 9; line_width += 1.5)
    {
      LayerScene      s = layer_scene (200, 160);
      uint8_t         standing[2] = { CELD_BEHIND, CELD_LEVEL };
      CeldSheetView   view = { &s.ink, &s.own, NULL, 2, { 18, 18, 124, 124 }, { 0 }, standing };
      CeldOutlineEnds ends = { 0 };
      double          pen;

      layer_scene_paint (&s, 2, white, disc, line_of_disc);
      CHECK (celd_outline_ends_find (&view, &ends, &pen) == CELD_OK);
      CHECK (ends.n == 0);
      NEAR (pen, line_width, 0.6);
      celd_free (ends.item);
      layer_scene_close (&s);
    }
}

int
main (void)
{
  RUN (a_bar_goes_on_straight);
  RUN (a_disc_goes_on_round);
  RUN (sides_of_a_corner_go_on_straight);
  RUN (a_whole_outline_has_no_ends);
  RUN (the_line_has_its_width);
  return DONE;
}
