/* Thin strokes whose colours vary, as where a filter has made a layer smaller, and lines that are too thin.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "reading.h"
#include "scribble-page.h"

enum { STROKES = 6 };

static const uint8_t pure[STROKES][3] = { { 200, 30, 40 }, { 30, 60, 220 },  { 20, 160, 60 },
                                          { 150, 60, 180 }, { 240, 180, 40 }, { 90, 90, 90 } };

/* Slanting strokes, each of one colour, shaken by so much in each pixel. */
static void
draw (double width, int most)
{
  uint32_t state = 3;

  clear_paint (false);
  for (int k = 0; k < STROKES; k++)
    for (int x = 20; x < 380; x++)
      for (int y = 40 * k + 10; y < 40 * k + 90 && y < HEIGHT; y++)
        {
          double  away = fabs (y - 40 * k - 20 - 0.1 * x);
          uint8_t colour[3];

          for (int i = 0; i < 3; i++)
            colour[i] = (uint8_t) (pure[k][i] + (int) check_random (&state, 2 * (uint32_t) most + 1) - most);
          lay (x, y, colour, fmin (fmax (width / 2 + 0.5 - away, 0), 1));
        }
}

static uint32_t
label_at (int k, int x)
{
  return seed_of[(40 * k + 20 + (int) floor (0.1 * x + 0.5)) * WIDTH + x];
}

/* Is each stroke read, all of it as one label of its own in its colour? */
static void
strokes_are_read (int error)
{
  CHECK (read_size (WIDTH, HEIGHT) == CELD_OK);
  NEAR (palette.n, STROKES, 0);
  for (int k = 0; k < STROKES; k++)
    {
      int wrong = 0;

      for (int x = 30; x < 370; x++)
        wrong += !label_at (k, x) || label_at (k, x) != label_at (k, 200);
      NEAR (wrong, 0, 4);
      CHECK (in_palette (pure[k], error));
    }
}

/* They have no pixels whose neighbours all have their colour. */
static void
thin_strokes_have_no_interior (void)
{
  draw (2, 8);
  strokes_are_read (10);
}

/* A short hairline that changes its colour all along: each pixel lies between its neighbours, as in a fringe. */
static void
a_hairline_that_looks_like_a_fringe (void)
{
  clear_paint (false);
  for (int x = 0; x < 24; x++)
    lay (100 + x, 100, (uint8_t[3]) { 200, 40, (uint8_t) (40 + 5 * x) }, 1);
  CHECK (read_size (WIDTH, HEIGHT) == CELD_OK);
  NEAR (palette.n, 1, 0);
  for (int x = 0; x < 24; x++)
    CHECK (seed_of[100 * WIDTH + 100 + x] == 1);
}

/* Has a line in colour B, which is no label, the label of colour A?  paper: colour C, or 0 if that is transparent. */
static bool
line_is_of_label (const char *const *art, int (*rgb)[3], uint32_t paper)
{
  const size_t      cells = 86 * 86 * 86; /* of colour space, each a radius of 3 wide */
  CeldScribbleLayer r = reading_new (art, rgb, 3);
  bool              same;

  r.paper = paper;
  r.kind = malloc (r.pixels);
  r.label = malloc (r.pixels * sizeof *r.label);
  r.head = celd_alloc (cells, sizeof *r.head);
  for (size_t p = 0; p < r.pixels; p++)
    r.kind[p] = r.id[p] == 2 ? CELD_FRINGE : CELD_SOLID;
  for (size_t k = 0; k < cells; k++)
    r.head[k] = CELD_NO_CLUSTER;
  CHECK (celd_scribble_cluster_add (&r, paper) == CELD_OK && celd_scribble_cluster_add (&r, 1) == CELD_OK);
  r.cluster[1].is_label = true;
  r.colour[1].cluster = 1;
  r.colour[2].cluster = CELD_NO_CLUSTER;
  CHECK (celd_scribble_places (&r, NULL) == CELD_OK);
  CHECK (r.label[25] && r.label[25] < CELD_QUEUED && !r.label[3]);
  same = r.label[25] == 1;
  free (r.kind);
  free (r.label);
  reading_clear (&r);
  return same;
}

/* A line too thin to show its full colour has that of a label if it is a tint of it, but not if it is 20 off these. */
static void
a_thin_line_of_a_near_colour (void)
{
  static const char *const art[] = { "AACCCCCCCC", "AACCCCCCCC", "AACCBBBBBB", "AACCCCCCCC", NULL };
  int                      pink[3][3] = { { 200, 30, 40 }, { 231, 158, 163 }, { 255, 255, 255 } };
  int                      orange[3][3] = { { 200, 30, 40 }, { 237, 172, 147 }, { 255, 255, 255 } };

  CHECK (line_is_of_label (art, pink, 3));
  CHECK (!line_is_of_label (art, orange, 3));
}

/* On transparency it may differ by twice the radius of one label, which is 3. */
static void
a_lost_stroke_of_a_near_colour (void)
{
  static const char *const art[] = { "AA........", "AA........", "AA..BBBBBB", "AA........", NULL };

  for (int d = 4; d < 8; d++)
    {
      int rgb[3][3] = { { 200, 30, 40 }, { 200 + d, 30, 40 }, { 255, 255, 255 } };

      CHECK (line_is_of_label (art, rgb, 0) == (d < 6));
    }
}

int
main (void)
{
  RUN (thin_strokes_have_no_interior);
  RUN (a_hairline_that_looks_like_a_fringe);
  RUN (a_thin_line_of_a_near_colour);
  RUN (a_lost_stroke_of_a_near_colour);
  celd_palette_clear (&palette);
  return DONE;
}
