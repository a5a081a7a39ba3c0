/* Bridges over gaps in contours: which ends they join, that basins part there, and that paper stays one component.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "scene.h"
#include "segment/basins.h"
#include "segment/bridges.h"

#define SIDE 320
#define PI   3.14159265358979

static CeldBridges
find (const Scene *s)
{
  CeldBridges bridges = { 0 };

  CHECK (celd_bridges_find (&s->ink, celd_stroke_width (&s->ink), NULL, &bridges) == CELD_OK);
  return bridges;
}

/* How many bridges join two ends (or go on ahead from a single one). */
static size_t
count (const Scene *s, bool ahead)
{
  CeldBridges bridges = find (s);
  size_t      n = 0;

  for (size_t i = 0; i < bridges.n; i++)
    n += bridges.item[i].ahead == ahead;
  celd_bridges_clear (&bridges);
  return n;
}

/* A circle round the middle with a gap of so many radians at an angle. */
static void
draw_circle (Scene *s, double radius, double at, double gap, double width)
{
  double end = at + 2 * PI - gap / 2;

  for (double a = at + gap / 2; a < end - 1e-9; a += 0.05)
    {
      double b = fmin (a + 0.05, end);

      scene_line (s, (CeldPlace) { SIDE / 2 + radius * cos (a), SIDE / 2 + radius * sin (a) },
                  (CeldPlace) { SIDE / 2 + radius * cos (b), SIDE / 2 + radius * sin (b) }, width);
    }
}

/* A round eraser. */
static void
erase (Scene *s, CeldPlace at, double radius)
{
  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      if (hypot (x + 0.5 - at.x, y + 0.5 - at.y) < radius)
        CELD_AT (&s->ink, x, y) = 1;
}

static CeldBasins
basins_of (const CeldPlane *ink)
{
  CeldBasins basins = { 0 };

  CHECK (celd_basins_new (ink, 0.25f, NULL, &basins) == CELD_OK);
  return basins;
}

/* ------------------------------------------------------------------ circles */

/* The radius is 120 and the line 6 wide; the gap is 60 pixels from tip to tip. */
static void
a_gap_in_a_circle_is_bridged (void)
{
  for (int angle = 0; angle < 360; angle += 30)
    {
      double      at = angle * PI / 180, half = asin ((60 + 6) / 2. / 120); /* tips are round */
      double      chord = 120 * cos (half);
      CeldBridges bridges;
      Scene       s;

      scene_open (SIDE, SIDE, &s);
      draw_circle (&s, 120, at, 2 * half, 6);
      bridges = find (&s);
      NEAR (bridges.n, 1, 0);
      for (size_t i = 0; i < bridges.n_pixels; i++)
        {
          double x = bridges.pixel[i].x + 0.5 - SIDE / 2, y = bridges.pixel[i].y + 0.5 - SIDE / 2;

          NEAR (x * cos (at) + y * sin (at), chord + 1.5, 3);
          CHECK (celd_is_paper (CELD_AT (&s.ink, bridges.pixel[i].x, bridges.pixel[i].y)));
        }
      celd_bridges_clear (&bridges);
      scene_close (&s);
    }
}

/* Rubbed out with a round eraser: the pieces of the thick line have hollow ends, and those between two gaps are less
 * than three times as long as the line is wide. */
static void
gaps_of_a_thick_line_are_bridged (void)
{
  for (int angle = 0; angle < 360; angle += 40)
    {
      Scene s;

      scene_open (SIDE, SIDE, &s);
      draw_circle (&s, 120, 0, 0, 24);
      for (int k = 0; k < 3; k++)
        {
          double at = angle * PI / 180 + k * 0.9;

          erase (&s, (CeldPlace) { SIDE / 2 + 120 * cos (at), SIDE / 2 + 120 * sin (at) }, 18);
        }
      NEAR (count (&s, false), 3, 0);
      scene_close (&s);
    }
}

/* Most lines of the drawing are a fifth as thick. */
static void
a_gap_of_the_thickest_line_is_bridged (void)
{
  Scene s;

  scene_open (SIDE, SIDE, &s);
  for (int radius = 40; radius < 100; radius += 20)
    draw_circle (&s, radius, 0, 0, 6);
  scene_line (&s, (CeldPlace) { 30, 290 }, (CeldPlace) { 290, 290 }, 30);
  for (int y = 270; y < 310; y++)
    for (int x = 140; x < 180; x++)
      CELD_AT (&s.ink, x, y) = 1;
  NEAR (count (&s, false), 1, 0);
  scene_close (&s);
}

/* Beside the gap in a line ends a bar three times as broad, nearer to one end than the other end is. */
static void
a_line_goes_on_as_wide_as_it_is (void)
{
  for (int shift = 0; shift < 8; shift++)
    {
      double      x = 0.375 * shift;
      CeldBridges bridges;
      size_t      n = 0;
      Scene       s;

      scene_open (SIDE, SIDE, &s);
      scene_line (&s, (CeldPlace) { 20 + x, 100 }, (CeldPlace) { 140 + x, 100 }, 6);
      scene_line (&s, (CeldPlace) { 172 + x, 100 }, (CeldPlace) { 300 + x, 100 }, 6);
      scene_line (&s, (CeldPlace) { 210 + x, 208 }, (CeldPlace) { 159.5 + x, 121 }, 18);
      bridges = find (&s);
      for (size_t i = 0; i < bridges.n; i++)
        for (size_t k = 0; k < bridges.item[i].n && !bridges.item[i].ahead; k++, n++)
          NEAR (bridges.pixel[bridges.item[i].first + k].y + 0.5, 100, 2);
      CHECK (n > 20);
      celd_bridges_clear (&bridges);
      scene_close (&s);
    }
}

/* A third of the circle is missing: no narrow place of the paper says where it was.  Basins part all the same, but
 * components and enclosures do not. */
static void
basins_meet_at_a_bridge (void)
{
  CeldBasins  plain, bridged;
  CeldBridges bridges;
  uint32_t    inside, outside, *bridged_component = NULL;
  Scene       s;

  scene_open (SIDE, SIDE, &s);
  draw_circle (&s, 50, 0.3, PI / 2, 6);
  bridges = find (&s);
  NEAR (bridges.n, 1, 0);
  plain = basins_of (&s.ink);
  celd_bridges_draw (&bridges, &s.ink);
  bridged = basins_of (&s.ink);
  inside  = celd_basin_at (&bridged, SIDE / 2, SIDE / 2);
  outside = celd_basin_at (&bridged, 5, 5);
  CHECK (bridged.merged[inside] != bridged.merged[outside] && bridged.component[inside] != bridged.component[outside]);
  CHECK (bridged.n_components == plain.n_components + 1);
  for (size_t i = 0; i < bridges.n_pixels; i++)
    CELD_AT (&s.ink, bridges.pixel[i].x, bridges.pixel[i].y) = 1;
  CHECK (celd_bridges_join (&bridges, &s.ink, &bridged, &bridged_component) == CELD_OK);
  CHECK (bridged.n_components == plain.n_components && bridged.n_enclosures == plain.n_enclosures);
  CHECK (bridged.component[inside] == bridged.component[outside] &&
         bridged.enclosure[inside] == bridged.enclosure[outside]);
  CHECK (bridged.merged[inside] != bridged.merged[outside] &&
         bridged_component[inside] != bridged_component[outside]);
  celd_free (bridged_component);
  celd_basins_clear (&plain);
  celd_basins_clear (&bridged);
  celd_bridges_clear (&bridges);
  scene_close (&s);
}

/* ------------------------------------------------------------------ which ends are joined */

static void
the_straightest_pair_is_joined (void)
{
  CeldBridges bridges;
  Scene       s;

  scene_open (SIDE, SIDE, &s);
  scene_line (&s, (CeldPlace) { 20, 100 }, (CeldPlace) { 100, 100 }, 5);
  scene_line (&s, (CeldPlace) { 130, 100 }, (CeldPlace) { 220, 100 }, 5);
  scene_line (&s, (CeldPlace) { 115, 125 }, (CeldPlace) { 115, 220 }, 5);
  bridges = find (&s);
  NEAR (bridges.n, 1, 0);
  for (size_t i = 0; i < bridges.n_pixels; i++)
    NEAR (bridges.pixel[i].y + 0.5, 100, 1.5);
  celd_bridges_clear (&bridges);
  scene_close (&s);
}

static void
nothing_is_joined_through_ink (void)
{
  Scene s;

  scene_open (SIDE, SIDE, &s);
  scene_line (&s, (CeldPlace) { 20, 100 }, (CeldPlace) { 100, 100 }, 5);
  scene_line (&s, (CeldPlace) { 140, 100 }, (CeldPlace) { 220, 100 }, 5);
  NEAR (count (&s, false), 1, 0);
  scene_line (&s, (CeldPlace) { 120, -5 }, (CeldPlace) { 120, SIDE + 5 }, 5);
  NEAR (count (&s, false), 0, 0);
  scene_close (&s);
}

/* Ends up to six stroke widths from a wall have a faint bridge to it, which holds neither paint nor enclosures. */
static void
a_single_end_goes_on_to_the_ink_ahead (void)
{
  for (int gap = 8; gap <= 40; gap += 8)
    {
      uint32_t   *bridged_component = NULL;
      CeldBasins  bridged;
      CeldBridges bridges;
      Scene       s;

      scene_open (SIDE, SIDE, &s);
      scene_line (&s, (CeldPlace) { -9, 100 }, (CeldPlace) { 200 - gap, 100 }, 5);
      scene_line (&s, (CeldPlace) { 205, -9 }, (CeldPlace) { 205, SIDE + 9 }, 5);
      NEAR (count (&s, false), 0, 0);
      bridges = find (&s);
      NEAR (bridges.n, gap < 24, 0);
      for (size_t i = 0; i < bridges.n_pixels; i++)
        {
          NEAR (bridges.pixel[i].y + 0.5, 100, 1);
          NEAR (bridges.pixel[i].ink, 0.499, 0.001);
        }
      celd_bridges_draw (&bridges, &s.ink);
      bridged = basins_of (&s.ink);
      for (size_t i = 0; i < bridges.n_pixels; i++)
        CELD_AT (&s.ink, bridges.pixel[i].x, bridges.pixel[i].y) = 1;
      CHECK (celd_bridges_join (&bridges, &s.ink, &bridged, &bridged_component) == CELD_OK);
      CHECK (bridged_component[celd_basin_at (&bridged, 20, 50)] == bridged_component[celd_basin_at (&bridged, 20, 150)]);
      CHECK (bridged.enclosure[celd_basin_at (&bridged, 20, 50)] == bridged.enclosure[celd_basin_at (&bridged, 20, 150)]);
      celd_free (bridged_component);
      celd_basins_clear (&bridged);
      celd_bridges_clear (&bridges);
      scene_close (&s);
    }
}

/* Ends that point away from each other, and parallel lines far apart. */
static void
unrelated_ends_stay_apart (void)
{
  Scene s;

  scene_open (SIDE, SIDE, &s);
  scene_line (&s, (CeldPlace) { 100, 60 }, (CeldPlace) { 220, 60 }, 5);
  scene_line (&s, (CeldPlace) { 100, 160 }, (CeldPlace) { 220, 160 }, 5);
  NEAR (count (&s, false), 0, 0);
  scene_close (&s);
}

static void
empty_pages_have_none (void)
{
  Scene s;

  scene_open (40, 30, &s);
  NEAR (count (&s, false), 0, 0);
  scene_close (&s);
}

/* ------------------------------------------------------------------ comparing */

static void
the_changed_rectangle_holds_what_two_records_do_not_share (void)
{
  CeldBridgePixel a[] = { { 3, 1, 0 }, { 4, 1, 0 }, { 9, 7, 0 } }, b[] = { { 4, 1, 0 }, { 3, 1, 0 }, { 2, 5, 0 } };
  CeldBridges     old = { .pixel = a, .n_pixels = 3 }, new = { .pixel = b, .n_pixels = 3 };
  CeldRect        rect = { 0 };

  CHECK (celd_bridges_compare (&old, &old, &rect) == CELD_OK && rect.width == 0);
  CHECK (celd_bridges_compare (&old, &new, &rect) == CELD_OK);
  CHECK (rect.x == 2 && rect.y == 5 && rect.width == 8 && rect.height == 3);
  rect = (CeldRect) { 0, 0, 1, 1 };
  CHECK (celd_bridges_compare (&old, &new, &rect) == CELD_OK);
  CHECK (rect.x == 0 && rect.y == 0 && rect.width == 10 && rect.height == 8);
  b[1].ink = 0.4f;
  rect = (CeldRect) { 0 };
  new.n_pixels = old.n_pixels = 2;
  CHECK (celd_bridges_compare (&old, &new, &rect) == CELD_OK);
  CHECK (rect.x == 3 && rect.y == 1 && rect.width == 1 && rect.height == 1);
}

/* ------------------------------------------------------------------ certainty */

/* The ink of the only bridge between the end of a line at (100,100), which comes from the left, and that of one at
 * (100 + gap, 100), which comes from the right. */
static float
ink_of_bridge (double gap)
{
  CeldBridges bridges;
  CeldPlane   drawn;
  float       ink = 2;
  Scene       s;

  scene_open (SIDE, 200, &s);
  scene_line (&s, (CeldPlace) { 30, 100 }, (CeldPlace) { 100, 100 }, 6);
  scene_line (&s, (CeldPlace) { 100 + gap, 100 }, (CeldPlace) { 170 + gap, 100 }, 6);
  bridges = find (&s);
  NEAR (bridges.n, 1, 0);
  CHECK (celd_plane_new (SIDE, 200, &drawn) == CELD_OK);
  for (int k = 0; k < SIDE * 200; k++)
    drawn.data[k] = 1;
  celd_bridges_draw (&bridges, &drawn);
  for (int k = 0; k < SIDE * 200; k++)
    ink = fminf (ink, drawn.data[k]);
  celd_free (drawn.data);
  celd_bridges_clear (&bridges);
  scene_close (&s);
  return ink;
}

/* Over up to six stroke widths a bridge is ink; farther off it is the fainter, but never paper. */
static void
the_shorter_a_bridge_the_darker_it_is (void)
{
  NEAR (ink_of_bridge (20), 0, 0.02);
  NEAR (ink_of_bridge (36), 0, 0.02);
  CHECK (ink_of_bridge (50) > 0.05 && ink_of_bridge (60) > ink_of_bridge (50));
  NEAR (ink_of_bridge (90), 0.499, 0.001);
  CHECK (!celd_is_paper (ink_of_bridge (90)));
}

int
main (void)
{
  RUN (a_gap_in_a_circle_is_bridged);
  RUN (the_shorter_a_bridge_the_darker_it_is);
  RUN (gaps_of_a_thick_line_are_bridged);
  RUN (a_gap_of_the_thickest_line_is_bridged);
  RUN (a_line_goes_on_as_wide_as_it_is);
  RUN (basins_meet_at_a_bridge);
  RUN (the_straightest_pair_is_joined);
  RUN (nothing_is_joined_through_ink);
  RUN (a_single_end_goes_on_to_the_ink_ahead);
  RUN (unrelated_ends_stay_apart);
  RUN (empty_pages_have_none);
  RUN (the_changed_rectangle_holds_what_two_records_do_not_share);
  return DONE;
}
