/* Gaps that hold depth: what is a gap, what stays smooth, against an independent search for pieces of boundaries.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "depth/depth.h"

enum { WIDTH = 200, HEIGHT = 120, PIXELS = WIDTH * HEIGHT };

typedef struct { float ink[PIXELS], level[PIXELS], borders[PIXELS], depth[PIXELS]; } Page;

static CeldPlane
view (float *data)
{
  return (CeldPlane) { WIDTH, HEIGHT, WIDTH, data };
}

/* A wall of this width down the middle, with a gap `open` pixels high; left is level 0, right level 1. */
static void
draw_wall (Page *page, int stroke, int open)
{
  for (int i = 0; i < PIXELS; i++)
    {
      int  x = i % WIDTH - 100, y = i / WIDTH - 60;
      bool wall = 2 * x >= -stroke && 2 * x < stroke;

      page->level[i]   = x >= 0;
      page->ink[i]     = wall && (y < -open / 2 || y >= open - open / 2) ? 0 : 1;
      page->borders[i] = page->ink[i];
    }
}

/* The step of smooth depth in the middle of the gap. */
static double
step_at_gap (Page *page, bool hold, bool with_borders)
{
  CeldSettings settings = celd_settings ();
  CeldPlane    ink = view (page->ink), level = view (page->level), borders = view (page->borders);
  CeldPlane    depth = view (page->depth);

  settings.hold_gaps = hold;
  CHECK (celd_smooth (&ink, with_borders ? &borders : NULL, &level, NULL, &settings, NULL, &depth, NULL) == CELD_OK);
  return (double) CELD_AT (&depth, 100, 60) - (double) CELD_AT (&depth, 99, 60);
}

/* At any scale a gap of up to five stroke widths holds, and an opening of ten does not. */
static void
a_gap_holds_and_an_opening_does_not (void)
{
  static Page page;

  for (int stroke = 2; stroke <= 10; stroke += 2)
    for (int widths = 2; widths <= 10; widths += widths < 5 ? 1 : 5)
      {
        draw_wall (&page, stroke, widths * stroke);
        NEAR (step_at_gap (&page, true, false), widths <= 5, widths <= 5 ? 1e-6 : 0.2);
        CHECK (step_at_gap (&page, false, false) < 0.5);
      }
}

/* A line of a pixel or two is a poor measure: breaks of 16 pixels hold. */
static void
gaps_of_hairlines_hold (void)
{
  static Page page;

  for (int stroke = 1; stroke <= 2; stroke++)
    {
      draw_wall (&page, stroke, 16);
      NEAR (step_at_gap (&page, true, false), 1, 1e-6);
    }
}

/* In a larger picture more of them do; lines of three pixels need not be looked at for that. */
static void
gaps_of_hairlines_grow_with_the_picture (void)
{
  for (int stroke = 1; stroke <= 2; stroke++)
    {
      NEAR (celd_longest_gap (stroke, 128, 96).usual, 16, 0);
      NEAR (celd_longest_gap (stroke, 600, 840).usual, 20, 0);
      NEAR (celd_longest_gap (stroke, 1024, 768).usual, celd_longest_gap (3, 1024, 768).usual, 0.5);
      NEAR (celd_longest_gap (stroke, 9000, 9000).usual, celd_longest_gap (3, 9000, 9000).usual, 0);
    }
}

/* A blue contour is ink for segmentation only.  It keeps what it covers smooth, and the rest of the wall cuts. */
static void
a_contour_for_segmentation_keeps_a_gap_smooth (void)
{
  static Page page;

  draw_wall (&page, 4, 16);
  NEAR (step_at_gap (&page, true, true), 1, 1e-6);
  for (int y = 45; y < 75; y++)
    page.borders[y * WIDTH + 99] = page.borders[y * WIDTH + 100] = 0;
  CHECK (step_at_gap (&page, true, true) < 0.2);
  CHECK (page.depth[10 * WIDTH + 100] - page.depth[10 * WIDTH + 99] > 0.5);
}

/* ------------------------------------------------------------------ an independent search */

enum { SIDE = 24, CORNERS = (SIDE + 1) * (SIDE + 1) };

typedef struct { float ink[SIDE * SIDE], level[SIDE * SIDE]; int piece[CORNERS]; } Patch;

/* Whether the edge from corner (x,y) to the right (down 0) or downwards lies between two levels; *least is then the
 * least ink of the two pixels' surroundings. */
static bool
is_boundary (const Patch *p, int x, int y, int down, float *least)
{
  int u = down ? x - 1 : x, v = down ? y : y - 1; /* the pixels are (u,v) and (x,y) */

  if (u < 0 || v < 0 || x >= SIDE || y >= SIDE || p->level[v * SIDE + u] == p->level[y * SIDE + x])
    return false;
  *least = 1;
  for (int b = v - 1; b <= y + 1; b++)
    for (int a = u - 1; a <= x + 1; a++)
      if (a >= 0 && b >= 0 && a < SIDE && b < SIDE)
        *least = fminf (*least, p->ink[b * SIDE + a]);
  return true;
}

/* Numbers the pieces of boundaries on paper by their smallest corner; corners elsewhere keep their own number. */
static void
number_pieces (Patch *p)
{
  bool  grown = true;
  float least;

  for (int c = 0; c < CORNERS; c++)
    p->piece[c] = c;
  while (grown)
    {
      grown = false;
      for (int y = 0; y <= SIDE; y++)
        for (int x = 0; x <= SIDE; x++)
          for (int down = 0; down < 2; down++)
            if (is_boundary (p, x, y, down, &least) && least > 0)
              {
                int *a = &p->piece[y * (SIDE + 1) + x], *b = a + (down ? SIDE + 1 : 1);

                grown = grown || *a != *b;
                *a = *b = *a < *b ? *a : *b;
              }
    }
}

/* Whether a piece is a gap: it spans at most `longest`, and one of its corners is at an edge that ink cuts. */
static bool
is_gap (const Patch *p, int piece, double longest)
{
  int   left = SIDE, top = SIDE, right = 0, bottom = 0;
  bool  meets = false;
  float least;

  for (int y = 0; y <= SIDE; y++)
    for (int x = 0; x <= SIDE; x++)
      if (p->piece[y * (SIDE + 1) + x] == piece)
        {
          left   = x < left ? x : left;
          top    = y < top ? y : top;
          right  = x > right ? x : right;
          bottom = y > bottom ? y : bottom;
          meets  = meets || (is_boundary (p, x, y, 0, &least) && least == 0) ||
                   (is_boundary (p, x, y, 1, &least) && least == 0) ||
                   (x > 0 && is_boundary (p, x - 1, y, 0, &least) && least == 0) ||
                   (y > 0 && is_boundary (p, x, y - 1, 1, &least) && least == 0);
        }
  return meets && hypot (right - left, bottom - top) <= longest;
}

/* Blocks of random levels, with much, little or no ink along their boundaries. */
static void
draw_blocks (Patch *p, uint32_t *r)
{
  float    level[16];
  uint32_t inked = check_random (r, 3);

  for (int k = 0; k < 16; k++)
    level[k] = (float) check_random (r, 3);
  for (int i = 0; i < SIDE * SIDE; i++)
    {
      int x = i % SIDE, y = i / SIDE;

      p->level[i] = level[x / 6 + 4 * (y / 6)];
      p->ink[i]   = (x % 6 == 0 || y % 6 == 0) && check_random (r, 9) < inked ? 0 : 1;
    }
}

static void
gaps_are_those_of_an_independent_search (void)
{
  static Patch p;
  int          held = 0, open = 0;

  for (uint32_t round = 0, r = 3; round < 200; round++)
    {
      double         longest = check_random (&r, 12);
      CeldPlane      ink = { SIDE, SIDE, SIDE, p.ink };
      CeldDepthEdges edges = { &ink, 0, 1, NULL };
      uint8_t        cut[SIDE * SIDE];
      float          least;

      draw_blocks (&p, &r);
      number_pieces (&p);
      CHECK (celd_gaps_hold (&edges, NULL, p.level, (CeldGapLength) { longest, longest }, NULL, cut) == CELD_OK);
      for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
          for (int down = 0; down < 2; down++)
            {
              int  u = x + !down, v = y + down; /* the edge between pixels (x,y) and (u,v) starts in corner (u,v) */
              bool differs = u < SIDE && v < SIDE && is_boundary (&p, u, v, !down, &least);
              bool gap = differs && least > 0 && is_gap (&p, p.piece[v * (SIDE + 1) + u], longest);

              CHECK (!(cut[y * SIDE + x] & CELD_CUT (down)) == !(differs && (least <= 0 || gap)));
              held += gap;
              open += differs && least > 0 && !gap;
            }
    }
  CHECK (held > 1000 && open > 1000);
}

/* A page with a horizontal line of this width, interrupted for so many pixels in the middle of the page; below it
 * other lines of a third of the width.  Levels are 0 and 1 above and below the middle of the line. */
static double
step_in_gap (int width, int gap, bool others, bool area)
{
  int          w = gap + 8 * width, h = 16 * width, y = 5 * width / 2;
  CeldPlane    ink = { 0 }, levels = { 0 }, depth = { 0 };
  CeldSettings settings = celd_settings ();
  double       step;

  CHECK (celd_plane_new (w, h, &ink) == CELD_OK && celd_plane_new (w, h, &levels) == CELD_OK);
  CHECK (celd_plane_new (w, h, &depth) == CELD_OK);
  for (int v = 0; v < h; v++)
    for (int u = 0; u < w; u++)
      {
        bool paper = abs (2 * (v - y) + 1) > (area ? 4 : 1) * width || abs (2 * u + 1 - w) < gap;

        CELD_AT (&ink, u, v) = paper && !(others && v > 6 * width && (v - 6 * width) % width < width / 3);
        CELD_AT (&levels, u, v) = v >= y;
      }
  CHECK (celd_smooth (&ink, NULL, &levels, NULL, &settings, NULL, &depth, NULL) == CELD_OK);
  step = CELD_AT (&depth, w / 2, y) - CELD_AT (&depth, w / 2, y - 1);
  celd_free (ink.data);
  celd_free (levels.data);
  celd_free (depth.data);
  return step;
}

/* Six stroke widths are as short in a drawing of broad lines as in one of thin ones. */
static void
gaps_of_broad_lines_hold (void)
{
  for (int width = 8; width <= 64; width *= 2)
    {
      CHECK (step_in_gap (width, 4 * width, false, false) > 0.9);
      CHECK (step_in_gap (width, 8 * width, false, false) < 0.5);
    }
}

/* Of broad lines in a drawing of thin ones too, but not between areas. */
static void
gaps_of_the_broadest_lines_hold (void)
{
  for (int width = 12; width <= 48; width *= 2)
    {
      CHECK (step_in_gap (width, 4 * width, true, false) > 0.9);
      CHECK (step_in_gap (width, 8 * width, true, false) < 0.5);
      CHECK (step_in_gap (width, 4 * width, true, true) < 0.5);
    }
}

/* ------------------------------------------------------------------ after edits */

/* Smooth depth of the patch; with a state that of the last call is `last`, and becomes the new one. */
static void
smooth_patch (Patch *p, CeldSmoothState *state, const CeldMask *anchors, CeldPlane *last)
{
  CeldSettings    settings = celd_settings ();
  CeldPlane       ink = { SIDE, SIDE, SIDE, p->ink }, level = { SIDE, SIDE, SIDE, p->level }, depth = { 0 };
  CeldSmoothInput input = { .ink = &ink, .levels = &level, .anchors = anchors, .settings = &settings, .radius = 1,
                            .gap = { 7, 7 }, .speck = 4, .last = last->data };
  CeldSolve       how;

  settings.ink_threshold = 0;
  settings.tolerance     = 1e-5f;
  CHECK (celd_smooth_update (state, &input, NULL, &depth, &how) == CELD_OK && how.converged);
  free (last->data);
  *last = depth;
}

/* Pixels of ink that appear and vanish open and close gaps whose other end is far from them. */
static void
edited_gaps_equal_new_ones (void)
{
  static Patch    p;
  static uint8_t  on[SIDE * SIDE];
  CeldMask        anchors = { SIDE, SIDE, SIDE, on };
  CeldSmoothState state = { 0 };
  CeldPlane       edited = { 0 };
  uint32_t        r = 11;

  for (int i = 0; i < SIDE * SIDE; i++)
    on[i] = i % SIDE % 6 == 3 && i / SIDE % 6 == 3;
  draw_blocks (&p, &r);
  for (int step = 0; step < 300; step++)
    {
      CeldPlane fresh = { 0 };
      int       x = (int) check_random (&r, SIDE), y = 6 * (int) check_random (&r, 4);

      smooth_patch (&p, &state, &anchors, &edited);
      smooth_patch (&p, NULL, &anchors, &fresh);
      for (int i = 0; i < SIDE * SIDE; i++)
        NEAR (edited.data[i], fresh.data[i], 1e-4);
      free (fresh.data);
      p.ink[y * SIDE + x] = 1 - p.ink[y * SIDE + x];
      state.new_ink = (CeldRect) { x, y, 1, 1 };
      if (step % 20 == 19)
        p.level[y * SIDE + x] = (float) check_random (&r, 3);
    }
  free (edited.data);
  celd_smooth_state_clear (&state);
}

int
main (void)
{
  RUN (a_gap_holds_and_an_opening_does_not);
  RUN (gaps_of_hairlines_hold);
  RUN (gaps_of_hairlines_grow_with_the_picture);
  RUN (gaps_of_broad_lines_hold);
  RUN (gaps_of_the_broadest_lines_hold);
  RUN (a_contour_for_segmentation_keeps_a_gap_smooth);
  RUN (gaps_are_those_of_an_independent_search);
  RUN (edited_gaps_equal_new_ones);
  return DONE;
}
