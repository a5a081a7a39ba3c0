/* Ends of lines: where they are, which way they point, and what is none.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "scene.h"
#include "segment/bridges.h"

#define SIDE 160
#define PI   3.14159265358979

static size_t
find (const Scene *s, CeldTip **tip)
{
  size_t n = 0;

  CHECK (celd_line_ends_find (&s->ink, celd_stroke_width (&s->ink), NULL, tip, &n) == CELD_OK);
  return n;
}

static size_t
count (const Scene *s)
{
  CeldTip *tip = NULL;
  size_t   n = find (s, &tip);

  celd_free (tip);
  return n;
}

static void
draw_arc (Scene *s, double radius, double from, double to, double width)
{
  for (double a = from; a < to - 1e-9; a += 0.05)
    {
      double b = fmin (a + 0.05, to);

      scene_line (s, (CeldPlace) { SIDE / 2 + radius * cos (a), SIDE / 2 + radius * sin (a) },
                  (CeldPlace) { SIDE / 2 + radius * cos (b), SIDE / 2 + radius * sin (b) }, width);
    }
}

/* Draws a line of half that length both ways from the middle, and checks that both of its ends are found, at most `off`
 * pixels away: the tip is half a width behind what a round brush leaves.  Returns how many there are; the caller frees
 * *tip with celd_free. */
static size_t
check_two_ends (Scene *s, int angle, double half, double width, double off, CeldTip **tip)
{
  double    dx = cos (angle * PI / 180), dy = sin (angle * PI / 180);
  CeldPlace end[2] = { { SIDE / 2 - half * dx, SIDE / 2 - half * dy }, { SIDE / 2 + half * dx, SIDE / 2 + half * dy } };
  size_t    n;

  *tip = NULL;
  scene_line (s, end[0], end[1], width);
  n = find (s, tip);
  NEAR (n, 2, 0);
  for (size_t i = 0; i < n; i++)
    {
      const CeldTip *t = &(*tip)[i];
      int            k = hypot (t->x - end[0].x, t->y - end[0].y) > half;
      double         out = k ? 1 : -1;

      NEAR (hypot (t->x - end[k].x, t->y - end[k].y), 0, off);
      CHECK (out * (t->dx * dx + t->dy * dy) > cos (12 * PI / 180));
      NEAR (hypot (t->dx, t->dy), 1, 1e-6);
    }
  return n;
}

static void
a_line_has_two_ends (void)
{
  for (int width = 2; width <= 10; width += 4)
    for (int angle = 0; angle < 180; angle += 15)
      {
        CeldTip *tip;
        Scene    s;

        scene_open (SIDE, SIDE, &s);
        check_two_ends (&s, angle, 50, width, 0.5 * width + 1.5, &tip);
        celd_free (tip);
        scene_close (&s);
      }
}

/* A short hairline in a ring of a pen that is ten times as broad: both ends, as exact as without the ring. */
static void
a_hairline_among_broad_strokes_has_two_ends (void)
{
  for (int angle = 0; angle < 180; angle += 10)
    {
      CeldTip *tip;
      Scene    s;
      size_t   n;

      scene_open (SIDE, SIDE, &s);
      draw_arc (&s, 60, 0, 2 * PI, 24);
      n = check_two_ends (&s, angle, 22, 2.4, 2.5, &tip);
      for (size_t i = 0; i < n; i++)
        {
          NEAR (tip[i].width, 2.4, 1.2);
          CHECK (tip[i].stroke < 0.5 * celd_stroke_width (&s.ink));
        }
      celd_free (tip);
      scene_close (&s);
    }
}

/* Spikes at the edge of a broad pen, as of a dry brush: they get broader from their tips on, unlike lines. */
static void
spikes_of_broad_strokes_are_no_lines (void)
{
  Scene s;

  scene_open (SIDE, SIDE, &s);
  draw_arc (&s, 45, 0, 2 * PI, 26);
  for (int k = 0; k < 12; k++)
    for (double out = 0; out < 12; out += 0.5)
      {
        double    a = k * PI / 6 + 0.1;
        CeldPlace at = { SIDE / 2 + (56 + out) * cos (a), SIDE / 2 + (56 + out) * sin (a) };

        scene_line (&s, at, (CeldPlace) { at.x + 0.5 * cos (a), at.y + 0.5 * sin (a) }, 8 - 0.6 * out);
      }
  NEAR (celd_stroke_width (&s.ink), 26, 3);
  NEAR (count (&s), 0, 0);
  scene_close (&s);
}

static void
closed_lines_have_none (void)
{
  Scene s;

  for (int radius = 20; radius <= 60; radius += 20)
    {
      scene_open (SIDE, SIDE, &s);
      draw_arc (&s, radius, 0, 2 * PI, 5);
      NEAR (count (&s), 0, 0);
      scene_close (&s);
    }
  scene_open (SIDE, SIDE, &s);
  for (int k = 0; k < 4; k++)
    scene_line (&s, (CeldPlace) { k == 1 || k == 2 ? 130 : 30, k > 1 ? 130 : 30 },
                (CeldPlace) { k < 2 ? 130 : 30, k == 1 || k == 2 ? 130 : 30 }, 4);
  NEAR (count (&s), 0, 0);
  scene_close (&s);
}

static void
crossing_lines_have_four (void)
{
  Scene s;

  scene_open (SIDE, SIDE, &s);
  scene_line (&s, (CeldPlace) { 20, 40 }, (CeldPlace) { 140, 110 }, 4);
  scene_line (&s, (CeldPlace) { 70, 140 }, (CeldPlace) { 90, 15 }, 4);
  NEAR (count (&s), 4, 0);
  scene_close (&s);
}

/* The two ends at a gap look at each other, however narrow it is. */
static void
both_ends_at_a_gap_are_found (void)
{
  for (int gap = 8; gap <= 60; gap += 4)
    {
      CeldTip *tip = NULL;
      Scene    s;
      size_t   n;

      scene_open (SIDE, SIDE, &s);
      draw_arc (&s, 55, gap / 110., 2 * PI - gap / 110., 4);
      n = find (&s, &tip);
      NEAR (n, 2, 0);
      if (n == 2)
        CHECK (tip[0].dx * tip[1].dx + tip[0].dy * tip[1].dy < 0.2);
      celd_free (tip);
      scene_close (&s);
    }
}

/* Rubs a disc out of the drawing. */
static void
rub_out (Scene *s, double x, double y, double radius)
{
  for (int v = 0; v < s->ink.height; v++)
    for (int u = 0; u < s->ink.width; u++)
      {
        float *ink = &CELD_AT (&s->ink, u, v);

        *ink = fmaxf (*ink, (float) fmin (1, fmax (0, radius + 0.5 - hypot (u + 0.5 - x, v + 0.5 - y))));
      }
}

/* A ring from which the lines at both sides of a short piece are rubbed out has four hollow ends, however they lie on
 * the grid of pixels. */
static void
ends_that_were_rubbed_out_are_found (void)
{
  for (int width = 6; width <= 16; width += 2)
    for (int angle = 0; angle < 180; angle += 3)
      {
        double radius = 55, apart = (1.5 + 0.75) * width / radius;
        Scene  s;

        scene_open (SIDE, SIDE, &s);
        draw_arc (&s, radius, 0, 2 * PI, width);
        for (int side = -1; side <= 1; side += 2)
          {
            double a = angle * PI / 180 + side * apart;

            rub_out (&s, SIDE / 2 + radius * cos (a), SIDE / 2 + radius * sin (a), 0.75 * width);
          }
        CHECK (count (&s) >= 4);
        scene_close (&s);
      }
}

/* All that is left of a line beside a bar is a stub shorter than it is wide, whose end is hollow: it still shows where the
 * line went. */
static void
a_stub_has_the_direction_of_its_line (void)
{
  for (int angle = 0; angle < 360; angle += 10)
    {
      double   dx = cos (angle * PI / 180), dy = sin (angle * PI / 180), width = 22, out = 27, radius = 30;
      CeldTip *tip = NULL;
      Scene    s;
      size_t   n, found = 0;

      scene_open (SIDE, SIDE, &s);
      scene_line (&s, (CeldPlace) { SIDE / 2, SIDE / 2 }, (CeldPlace) { SIDE / 2 + 50 * dx, SIDE / 2 + 50 * dy }, width);
      rub_out (&s, SIDE / 2 + (out + radius) * dx, SIDE / 2 + (out + radius) * dy, radius);
      scene_line (&s, (CeldPlace) { SIDE / 2 + 50 * dy, SIDE / 2 - 50 * dx },
                  (CeldPlace) { SIDE / 2 - 50 * dy, SIDE / 2 + 50 * dx }, width);
      n = find (&s, &tip);
      for (size_t i = 0; i < n; i++)
        if (hypot (tip[i].x - SIDE / 2 - out * dx, tip[i].y - SIDE / 2 - out * dy) < 4)
          {
            CHECK (tip[i].dx * dx + tip[i].dy * dy > cos (8 * PI / 180));
            NEAR (tip[i].width, width, 2);
            found++;
          }
      NEAR (found, 1, 0);
      celd_free (tip);
      scene_close (&s);
    }
}

/* A broad ring of which a disc was rubbed out is a crescent: its horns are cut off aslant, between sides that bend, but
 * lead round the ring to each other. */
static void
horns_of_a_ring_lead_round_it (void)
{
  for (int angle = 0; angle < 360; angle += 20)
    {
      double   a = angle * PI / 180, radius = 74, width = 42, middle = 120;
      CeldTip *tip = NULL;
      Scene    s;
      size_t   n, side[2] = { 0, 0 };

      scene_open (240, 240, &s);
      scene_line (&s, (CeldPlace) { middle, middle }, (CeldPlace) { middle, middle }, 2 * radius + width);
      rub_out (&s, middle, middle, radius - width / 2);
      rub_out (&s, middle + radius * cos (a), middle + radius * sin (a), 72);
      n = find (&s, &tip);
      for (size_t i = 0; i < n; i++)
        {
          double x = tip[i].x - middle, y = tip[i].y - middle, off = x * sin (a) - y * cos (a);
          double round = (y * tip[i].dx - x * tip[i].dy) / hypot (x, y);

          side[off > 0]++;
          CHECK ((off > 0 ? -round : round) > cos (15 * PI / 180));
          NEAR (tip[i].width, width, 6);
        }
      NEAR (side[0], 1, 0);
      NEAR (side[1], 1, 0);
      celd_free (tip);
      scene_close (&s);
    }
}

static void
blots_and_areas_have_none (void)
{
  Scene s;

  scene_open (SIDE, SIDE, &s);
  draw_arc (&s, 60, 0, 2 * PI, 4);
  scene_line (&s, (CeldPlace) { 80, 80 }, (CeldPlace) { 81, 80 }, 30);
  scene_line (&s, (CeldPlace) { 50, 60 }, (CeldPlace) { 51, 60 }, 4);
  NEAR (count (&s), 0, 0);
  scene_close (&s);
  scene_open (SIDE, SIDE, &s);
  NEAR (count (&s), 0, 0);
  for (int p = 0; p < SIDE * SIDE; p++)
    s.ink.data[p] = 0;
  NEAR (count (&s), 0, 0);
  scene_close (&s);
}

/* A limb of paper with a thin outline, on a bold line: between its sides there is no ink. */
static void
an_outlined_limb_is_no_line (void)
{
  for (int height = 50; height <= 70; height += 10)
    {
      CeldTip  *tip = NULL;
      CeldPlace corner[4] = { { 72.5, 120 }, { 72.5, 119.5 - height }, { 88.5, 119.5 - height }, { 88.5, 120 } };
      Scene     s;
      size_t    n;

      scene_open (SIDE, SIDE, &s);
      scene_line (&s, (CeldPlace) { 10, 130 }, (CeldPlace) { 150, 130 }, 21);
      for (int i = 0; i < 3; i++)
        scene_line (&s, corner[i], corner[i + 1], 1.2);
      n = find (&s, &tip);
      CHECK (n >= 2);
      for (size_t i = 0; i < n; i++)
        CHECK (tip[i].y > 115);
      celd_free (tip);
      scene_close (&s);
    }
}

/* Pages too small for any line, and lines of one pixel. */
/* The width of the line that ends near a place; there must be an end within 12 pixels. */
static double
width_at (const Scene *s, double x, double y)
{
  CeldTip *tip = NULL;
  size_t   n = find (s, &tip), best = 0;
  double   width;

  for (size_t i = 1; i < n; i++)
    if (hypot (tip[i].x - x, tip[i].y - y) < hypot (tip[best].x - x, tip[best].y - y))
      best = i;
  CHECK (n && hypot (tip[best].x - x, tip[best].y - y) < 12);
  width = n ? tip[best].width : -1;
  celd_free (tip);
  return width;
}

/* A bar three times as wide as the lines, and the corner of two that meet at 11 degrees, have none; all ink is moved by
 * parts of a pixel. */
static void
ends_have_the_width_of_their_line (void)
{
  for (int k = 0; k < 8; k++)
    {
      double u = 0.125 * k, v = 0.375 * k;
      Scene  s;

      scene_open (SIDE, SIDE, &s);
      for (int y = 20; y <= 60; y += 20)
        scene_line (&s, (CeldPlace) { 20 + u, y + v }, (CeldPlace) { 140 + u, y + v }, 6);
      scene_line (&s, (CeldPlace) { 20 + u, 80 + v }, (CeldPlace) { 140 + u, 80 + v }, 3);
      scene_line (&s, (CeldPlace) { 40 + u, 103 + v }, (CeldPlace) { 140 + u, 103 + v }, 18);
      scene_line (&s, (CeldPlace) { 20 + u, 135 + v }, (CeldPlace) { 140 + u, 123 + v }, 6);
      scene_line (&s, (CeldPlace) { 20 + u, 135 + v }, (CeldPlace) { 140 + u, 147 + v }, 6);
      NEAR (width_at (&s, 20 + u, 20 + v), 6, 2);
      NEAR (width_at (&s, 140 + u, 60 + v), 6, 2);
      NEAR (width_at (&s, 20 + u, 80 + v), 3, 1);
      NEAR (width_at (&s, 140 + u, 103 + v), 0, 0);
      NEAR (width_at (&s, 20 + u, 135 + v), 0, 0);
      scene_close (&s);
    }
}

static void
pages_of_a_few_pixels_have_no_ends (void)
{
  static const char *const art[] = {
    "..............", "..............", "..############", "..............", "......#.......", "..............", NULL
  };
  CeldTip                 *tip = NULL;
  CeldPlane                ink = art_plane (art), one = { 1, 1, 1, (float[]) { 0 } };
  size_t                   n = 0;

  CHECK (celd_line_ends_find (&one, 1, NULL, &tip, &n) == CELD_OK && n == 0);
  celd_free (tip);
  tip = NULL;
  CHECK (celd_line_ends_find (&ink, celd_stroke_width (&ink), NULL, &tip, &n) == CELD_OK && n >= 1 && n <= 2);
  CHECK (n && fabs (tip[0].x - 2) < 1.5 && fabs (tip[0].y - 2.5) < 1 && tip[0].dx < -0.9);
  celd_free (tip);
  free (ink.data);
}

int
main (void)
{
  RUN (a_line_has_two_ends);
  RUN (a_hairline_among_broad_strokes_has_two_ends);
  RUN (spikes_of_broad_strokes_are_no_lines);
  RUN (closed_lines_have_none);
  RUN (crossing_lines_have_four);
  RUN (both_ends_at_a_gap_are_found);
  RUN (ends_that_were_rubbed_out_are_found);
  RUN (a_stub_has_the_direction_of_its_line);
  RUN (horns_of_a_ring_lead_round_it);
  RUN (blots_and_areas_have_none);
  RUN (an_outlined_limb_is_no_line);
  RUN (ends_have_the_width_of_their_line);
  RUN (pages_of_a_few_pixels_have_no_ends);
  return DONE;
}
