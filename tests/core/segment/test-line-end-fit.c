/* Line ends: what is one, where its tip is, and where the line would go on.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "scene.h"
#include "segment/closures.h"

static const double pi = 3.14159265358979;

/* The end that ink near a place is; the pixel is the ink pixel that is nearest to it. */
static void
look (const Scene *s, int stroke, double x, double y, CeldLineEnd *end)
{
  CeldCorner nearest = { -1, -1 };
  double     least = INFINITY;

  for (int v = 0; v < s->ink.height; v++)
    for (int u = 0; u < s->ink.width; u++)
      if (CELD_AT (&s->ink, u, v) < 0.5f && hypot (u + 0.5 - x, v + 0.5 - y) < least)
        {
          least   = hypot (u + 0.5 - x, v + 0.5 - y);
          nearest = (CeldCorner) { u, v };
        }
  CHECK (celd_line_end_new (stroke, end) == CELD_OK);
  celd_line_end_fit (&s->ink, nearest, end);
}

/* From the corner of the tip as well as from its middle, thin lines and thick ones, at any angle. */
static void
tips_of_lines_are_found_with_their_direction (void)
{
  static const double widths[] = { 1.6, 2, 3, 6, 14, 30 };

  for (int k = 0; k < 16; k++)
    for (int i = 0; i < 18; i++)
      {
        double      width = widths[i / 3], side = (i % 3 - 1) * width / 2;
        double      a = k * pi / 8 + 0.1, x = cos (a), y = sin (a);
        CeldPlace   tip = { 150 + x * width / 2, 150 + y * width / 2 };
        Scene       s;
        CeldLineEnd end;

        scene_open (300, 300, &s);
        scene_line (&s, (CeldPlace) { 150, 150 }, (CeldPlace) { 150 - 400 * x, 150 - 400 * y }, width);
        look (&s, (int) width, tip.x - side * y, tip.y + side * x, &end);
        CHECK (end.tip);
        NEAR (end.width, width, 0.15 * width + 0.8);
        NEAR (hypot (end.at.x - tip.x, end.at.y - tip.y), 0, 0.05 * width + 1);
        NEAR (acos (fmin (end.dx * x + end.dy * y, 1)), 0, 0.1 + 0.15 / width);
        celd_line_end_clear (&end);
        scene_close (&s);
      }
}

static void
sides_of_lines_and_blots_are_no_tips (void)
{
  Scene       s;
  CeldLineEnd end;

  scene_open (120, 120, &s);
  scene_line (&s, (CeldPlace) { -5, 20 }, (CeldPlace) { 125, 50 }, 5);
  scene_line (&s, (CeldPlace) { 60, 90 }, (CeldPlace) { 60.1, 90 }, 21);
  look (&s, 5, 60, 40, &end);
  CHECK (!end.tip);
  celd_line_end_clear (&end);
  look (&s, 5, 60, 78, &end);
  CHECK (!end.tip);
  celd_line_end_clear (&end);
  scene_close (&s);
}

/* A fork three widths behind the tip: it is a tip all the same, by the look at half the reach. */
static void
forks_do_not_hide_a_tip (void)
{
  Scene       s;
  CeldLineEnd end;

  scene_open (120, 120, &s);
  scene_line (&s, (CeldPlace) { 60, 60 }, (CeldPlace) { 60, 85 }, 6);
  scene_line (&s, (CeldPlace) { -5, 85 }, (CeldPlace) { 125, 85 }, 6);
  look (&s, 6, 60, 50, &end);
  CHECK (end.tip);
  NEAR (end.at.x, 60, 1);
  NEAR (end.at.y, 57, 1);
  CHECK (end.dy < -0.97);
  celd_line_end_clear (&end);
  scene_close (&s);
}

/* A line that was rubbed out with a round rubber: the tip is at the bottom of the hollow. */
static void
the_tip_of_a_hollow_line_is_at_its_ink (void)
{
  Scene       s;
  CeldLineEnd end;

  scene_open (120, 80, &s);
  scene_line (&s, (CeldPlace) { -5, 40 }, (CeldPlace) { 70, 40 }, 12);
  for (int y = 0; y < 80; y++)
    for (int x = 0; x < 120; x++)
      if (hypot (x + 0.5 - 70, y + 0.5 - 40) < 9)
        CELD_AT (&s.ink, x, y) = 1;
  look (&s, 12, 66, 50, &end);
  CHECK (end.tip);
  NEAR (end.at.x, 61, 1);
  NEAR (end.at.y, 40, 1);
  celd_line_end_clear (&end);
  scene_close (&s);
}

/* From a tip that heads for another line's side the boundary goes on ahead, not along the shortest way. */
static void
a_boundary_meets_a_side_straight_ahead_of_the_tip (void)
{
  Scene       s;
  CeldLineEnd from, end;

  scene_open (120, 120, &s);
  scene_line (&s, (CeldPlace) { -5, 100 }, (CeldPlace) { 125, 100 }, 4);
  scene_line (&s, (CeldPlace) { 20, 30 }, (CeldPlace) { 50, 80 }, 4);
  look (&s, 4, 52, 83, &from);
  look (&s, 4, 53, 98, &end);
  CHECK (from.tip && !end.tip);
  celd_line_end_aim (&s.ink, &from, &end);
  NEAR (end.at.y, 98, 0.6);
  NEAR (end.at.x, 59, 2.5);             /* straight on it would be 60.8, the shortest way about 51 */
  from.tip = false;
  celd_line_end_aim (&s.ink, &from, &end);
  NEAR (end.at.x, from.at.x, 1);
  celd_line_end_clear (&from);
  celd_line_end_clear (&end);
  scene_close (&s);
}

int
main (void)
{
  RUN (tips_of_lines_are_found_with_their_direction);
  RUN (sides_of_lines_and_blots_are_no_tips);
  RUN (forks_do_not_hide_a_tip);
  RUN (the_tip_of_a_hollow_line_is_at_its_ink);
  RUN (a_boundary_meets_a_side_straight_ahead_of_the_tip);
  return DONE;
}
