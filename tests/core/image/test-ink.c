/* Line art of drawings: what must stay as it is, what must become ink or paper, and bad input.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "celdepth.h"


enum { SIDE = 160 };

static float ink_of[SIDE * SIDE], luma_of[SIDE * SIDE], alpha_of[SIDE * SIDE];

static CeldPlane
square (float *data)
{
  return (CeldPlane) { SIDE, SIDE, SIDE, data };
}

/* How much of a pixel a ring of radius 50 round the middle, and a slanting stroke through it, cover; antialiased. */
static float
coverage (int x, int y, float breadth)
{
  float u = (float) x - 79.5f, v = (float) y - 79.5f;
  float ring = fabsf (sqrtf (u * u + v * v) - 50), line = fabsf (0.8f * u - 0.6f * v);
  float distance = ring < line ? ring : line;

  return fminf (fmaxf (0.5f * breadth + 0.5f - distance, 0), 1);
}

static CeldStatus
make_ink (CeldInkMode mode, bool transparent)
{
  CeldDrawing drawing = { .luma = square (luma_of) };
  CeldPlane   ink = square (ink_of);

  if (transparent)
    drawing.alpha = square (alpha_of);
  return celd_ink (&drawing, mode, NULL, &ink);
}

/* The darkest pixel within two of the pixel's place: ink along a contour. */
static float
darkest_near (int x, int y)
{
  float least = 1;

  for (int v = y - 2; v <= y + 2; v++)
    for (int u = x - 2; u <= x + 2; u++)
      least = fminf (least, ink_of[v * SIDE + u]);
  return least;
}

/* The largest over the ring of the darkest ink near it: a hole in the contour would show. */
static float
palest_of_ring (void)
{
  float worst = 0;

  for (int i = 0; i < 360; i++)
    {
      int x = (int) (79.5 + 50 * cos (i * 0.01745329) + 0.5), y = (int) (79.5 + 50 * sin (i * 0.01745329) + 0.5);

      worst = fmaxf (worst, darkest_near (x, y));
    }
  return worst;
}

/* The mean, and the least in *least, of the ink four pixels and more away from the strokes. */
static float
paper_mean (float *least)
{
  double sum = 0;
  int    n = 0;

  *least = 1;
  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      if (coverage (x, y, 16) <= 0)
        {
          sum += ink_of[y * SIDE + x];
          n++;
          *least = fminf (*least, ink_of[y * SIDE + x]);
        }
  return (float) (sum / n);
}

static void
clean_art_stays (void)
{
  for (int breadth = 2; breadth <= 9; breadth++)
    {
      float worst = 0;

      for (int i = 0; i < SIDE * SIDE; i++)
        luma_of[i] = 1 - coverage (i % SIDE, i / SIDE, (float) breadth);
      CHECK (make_ink (CELD_INK_AUTO, false) == CELD_OK);
      for (int i = 0; i < SIDE * SIDE; i++)
        worst = fmaxf (worst, fabsf (ink_of[i] - luma_of[i]));
      NEAR (worst, 0, 1e-3);
    }
}

static void
clean_art_with_solid_black_stays (void)
{
  float worst = 0;

  for (int i = 0; i < SIDE * SIDE; i++)
    luma_of[i] = i % SIDE > 20 && i % SIDE < 140 && i / SIDE > 20 && i / SIDE < 150 ? 0 : 1;
  CHECK (make_ink (CELD_INK_AUTO, false) == CELD_OK);
  for (int i = 0; i < SIDE * SIDE; i++)
    worst = fmaxf (worst, fabsf (ink_of[i] - luma_of[i]));
  NEAR (worst, 0, 1e-3);
}

static void
white_stays_white (void)
{
  uint32_t seed = 5;
  float    least;

  for (int i = 0; i < SIDE * SIDE; i++)
    luma_of[i] = 1;
  CHECK (make_ink (CELD_INK_AUTO, false) == CELD_OK);
  for (int i = 0; i < SIDE * SIDE; i++)
    CHECK (ink_of[i] == 1);
  for (int i = 0; i < SIDE * SIDE; i++)
    luma_of[i] = 0.93f + 0.012f * check_noise (&seed);
  CHECK (make_ink (CELD_INK_AUTO, false) == CELD_OK);
  CHECK (paper_mean (&least) > 0.98f && least > 0.75f);
}

/* Pencil of changing pressure with grain, on grainy paper that darkens to one side. */
static void
pencil_becomes_ink (void)
{
  uint32_t seed = 7;
  float    least;

  for (int i = 0; i < SIDE * SIDE; i++)
    {
      int   x = i % SIDE, y = i / SIDE;
      float paper = 0.95f - 0.3f * (float) x / SIDE + 0.012f * check_noise (&seed);
      float press = 0.55f + 0.2f * sinf ((float) (x + y) / 15), pores = 1 - 0.2f * fabsf (check_noise (&seed));

      luma_of[i] = paper * (1 - press * pores * coverage (x, y, 5));
    }
  CHECK (make_ink (CELD_INK_AUTO, false) == CELD_OK);
  CHECK (palest_of_ring () <= 0.3f);
  CHECK (paper_mean (&least) >= 0.95f && least > 0.6f);
}

/* How much of a pixel a ring covers. */
static float
ring_coverage (int x, int y, float radius, float breadth)
{
  float u = (float) x - 79.5f, v = (float) y - 79.5f;

  return fminf (fmaxf (0.5f * breadth + 0.5f - fabsf (sqrtf (u * u + v * v) - radius), 0), 1);
}

/* The palest ink at these distances from the middle. */
static float
palest_between (float least, float most)
{
  float worst = 0;

  for (int i = 0; i < SIDE * SIDE; i++)
    {
      float away = hypotf ((float) (i % SIDE) - 79.5f, (float) (i / SIDE) - 79.5f);

      if (away >= least && away <= most)
        worst = fmaxf (worst, ink_of[i]);
    }
  return worst;
}

/* A pencil of 40 pixels is broader than strokes usually are, and much paler in places.  A disc that is filled with such
 * a grey, with an outline of 4 pixels, is an area. */
static void
broad_pencil_becomes_ink (void)
{
  for (uint32_t k = 0; k < 8; k++)
    {
      uint32_t seed = 23 + k;

      for (int i = 0; i < SIDE * SIDE; i++)
        {
          float pale = powf (sinf ((float) (i % SIDE + i / SIDE) / 16 + (float) k), 4), pores = check_noise (&seed);
          float pressure = (0.85f - 0.5f * pale) * (1 - 0.1f * fabsf (pores));

          luma_of[i] = 0.95f * (1 - pressure * ring_coverage (i % SIDE, i / SIDE, 45, 40)) + 0.01f * check_noise (&seed);
        }
      CHECK (make_ink (CELD_INK_AUTO, false) == CELD_OK);
      CHECK (palest_between (28, 62) < 0.5f);
      for (int i = 0; i < SIDE * SIDE; i++)
        luma_of[i] = 0.95f - 0.5f * ring_coverage (i % SIDE, i / SIDE, 40, 4) -
                     0.3f * ring_coverage (i % SIDE, i / SIDE, 0, 80) + 0.01f * check_noise (&seed);
      CHECK (make_ink (CELD_INK_AUTO, false) == CELD_OK);
      CHECK (palest_between (0, 5) > 0.5f);
    }
}

/* A line of light blue in a grain of an eighth of its contrast: smoothing quietens that, so no part of it is lost. */
static void
pale_lines_in_grain_stay_whole (void)
{
  uint32_t seed = 11;
  float    least;

  for (int i = 0; i < SIDE * SIDE; i++)
    luma_of[i] = 0.94f * (1 - 0.23f * coverage (i % SIDE, i / SIDE, 4)) + 0.025f * check_noise (&seed);
  CHECK (make_ink (CELD_INK_AUTO, false) == CELD_OK);
  CHECK (palest_of_ring () <= 0.2f);
  CHECK (paper_mean (&least) >= 0.95f && least > 0.6f);
}

/* A stroke of a third of the contrast beside black ones is a contour as they are; a yellow drawing, too. */
static void
pale_strokes_are_contours (void)
{
  float least;

  for (int i = 0; i < SIDE * SIDE; i++)
    luma_of[i] = 1 - (i % SIDE > 90 ? 0.3f : 1) * coverage (i % SIDE, i / SIDE, 5);
  CHECK (make_ink (CELD_INK_AUTO, false) == CELD_OK);
  CHECK (palest_of_ring () <= 0.25f && paper_mean (&least) > 0.999f);
  for (int i = 0; i < SIDE * SIDE; i++)
    luma_of[i] = 1 - 0.0722f * coverage (i % SIDE, i / SIDE, 5);
  CHECK (make_ink (CELD_INK_AUTO, false) == CELD_OK);
  CHECK (palest_of_ring () <= 0.25f && paper_mean (&least) > 0.999f);
}

/* Does a way through ink of at least `paper` lead from the middle of the picture to its edge?  To 4-neighbours. */
static bool
ring_leaks (float paper)
{
  static int  queue[SIDE * SIDE];
  static bool seen[SIDE * SIDE];
  int         n = 0;

  memset (seen, 0, sizeof seen);
  seen[queue[n++] = 79 * SIDE + 90] = true;
  for (int k = 0; k < n; k++)
    {
      int x = queue[k] % SIDE, y = queue[k] / SIDE, next[4] = { -1, 1, -SIDE, SIDE };

      if (x == 0 || y == 0 || x == SIDE - 1 || y == SIDE - 1)
        return true;
      for (int i = 0; i < 4; i++)
        if (!seen[queue[k] + next[i]] && ink_of[queue[k] + next[i]] >= paper)
          {
            seen[queue[k] + next[i]] = true;
            queue[n++] = queue[k] + next[i];
          }
    }
  return false;
}

/* A hard pencil beside black ink on grainy paper. */
static void
faint_lines_beside_dark_ones_stay_closed (void)
{
  static const int grey[] = { 165, 178, 190 };

  for (uint32_t k = 0; k < 6; k++)
    {
      float    pale = 1 - (float) grey[k % 3] / 255, noise = k < 3 ? 0.0075f : 0.01f, least;
      uint32_t seed = 17 + k;

      for (int i = 0; i < SIDE * SIDE; i++)
        {
          float faint = pale * ring_coverage (i % SIDE, i / SIDE, 50, 1.2f);
          float dark = 0.9f * ring_coverage (i % SIDE, i / SIDE, 70, 4);

          luma_of[i] = fminf (0.96f * (1 - faint - dark) + noise * check_noise (&seed), 1);
        }
      CHECK (make_ink (CELD_INK_AUTO, false) == CELD_OK);
      for (int i = 0; i < SIDE * SIDE; i++) /* the dark ring is a wall, too: look at the faint one alone */
        if (ring_coverage (i % SIDE, i / SIDE, 70, 12) > 0)
          ink_of[i] = 1;
      CHECK (!ring_leaks (0.5f));
      for (int i = 0; i < SIDE * SIDE; i++)
        if (ring_coverage (i % SIDE, i / SIDE, 50, 12) > 0)
          ink_of[i] = 1;
      least = 1;
      for (int i = 0; i < SIDE * SIDE; i++)
        least = fminf (least, ink_of[i]);
      CHECK (least > 0.6f);
    }
}

/* Chalk leaves holes of a pixel or two in a line of two pixels; depth leaks through what is not nearly ink. */
static void
chalk_with_holes_stays_closed (void)
{
  for (uint32_t seed = 1; seed <= 8; seed++)
    {
      uint32_t state = seed;

      for (int i = 0; i < SIDE * SIDE; i++)
        alpha_of[i] = check_noise (&state);
      for (int i = 0; i < SIDE * SIDE; i++)
        {
          int   right = i % SIDE < SIDE - 1, below = i / SIDE < SIDE - 1 ? SIDE : 0;
          float holes = 0.5f * (alpha_of[i] + alpha_of[i + right] + alpha_of[i + below] + alpha_of[i + right + below]);
          float chalk = fminf (fmaxf (0.75f + 0.22f * holes, 0.15f), 1);

          luma_of[i] = 0.16f + 0.01f * check_noise (&state) + 0.7f * chalk * ring_coverage (i % SIDE, i / SIDE, 50, 2);
        }
      CHECK (make_ink (CELD_INK_AUTO, false) == CELD_OK);
      CHECK (!ring_leaks (0.25f));
    }
}

/* Two thick lines with so many pixels of paper between them, out of focus, scanned with noise. */
static void
check_neck (float breadth)
{
  float edge[] = { -breadth / 2 - 10, -breadth / 2, breadth / 2, breadth / 2 + 10 };

  for (uint32_t seed = 1; seed <= 4; seed++)
    {
      uint32_t state = seed;
      int      dark = 0;

      for (int i = 0; i < SIDE * SIDE; i++)
        {
          float u = 0.96f * ((float) (i % SIDE) - 79.5f) + 0.28f * ((float) (i / SIDE) - 79.5f), edges = 0;

          for (int k = 0; k < 4; k++) /* steps up and down, after a Gaussian of 1.2 pixels */
            edges += (k % 2 ? -0.5f : 0.5f) * erff ((u - edge[k]) / (1.2f * 1.41421f));
          luma_of[i] = 0.96f - 0.86f * edges + 0.016f * check_noise (&state);
        }
      CHECK (make_ink (CELD_INK_AUTO, false) == CELD_OK);
      for (int y = 20; y < SIDE - 20; y++)
        {
          float lightest = 0;

          for (int x = 0; x < SIDE; x++)
            if (fabsf (0.96f * ((float) x - 79.5f) + 0.28f * ((float) y - 79.5f)) < 0.75f)
              lightest = fmaxf (lightest, ink_of[y * SIDE + x]);
          dark += lightest < 0.5f;
        }
      CHECK (dark == 0);
    }
}

static void
blur_fills_no_neck (void)
{
  check_neck (2.5f);
  check_neck (1.75f);
}

/* A line of a third of a pixel to nearly a pixel, also where it lies between two columns of pixels, is ink along all of
 * its length in a drawing with a black stroke, and paper beside it stays paper. */
static void
hairlines_are_ink (void)
{
  for (float breadth = 0.3f; breadth < 0.98f; breadth += 0.05f)
    {
      int gaps = 0, stains = 0;

      for (int i = 0; i < SIDE * SIDE; i++)
        {
          float line = fabsf ((float) (i % SIDE) - 100.3f + 0.07f * (float) (i / SIDE));
          float covered = i % SIDE > 20 && i % SIDE < 30 ? 1 : fminf (fmaxf (0.5f * breadth + 0.5f - line, 0), breadth);

          luma_of[i] = 1 - covered;
        }
      CHECK (make_ink (CELD_INK_AUTO, false) == CELD_OK);
      for (int y = 0; y < SIDE; y++)
        {
          float darkest = 1;

          for (int x = 40; x < SIDE; x++)
            if (fabsf ((float) x - 100.3f + 0.07f * (float) y) < 1)
              darkest = fminf (darkest, ink_of[y * SIDE + x]);
            else
              stains += ink_of[y * SIDE + x] < 1;
          gaps += darkest > 0.51f; /* two pixels with one half each */
        }
      CHECK (gaps == 0 && stains == 0);
    }
}

/* Ends of black strokes are pale where they taper, and ink where they are hairlines of about a pixel; that makes no ink
 * beside them, and changes nothing where they are clearly wider. */
static void
tapering_strokes_stay (void)
{
  float worst = 0;

  for (int i = 0; i < SIDE * SIDE; i++)
    {
      float half = 0.04f * ((float) (i % SIDE) - 20), line = fabsf ((float) (i / SIDE) - 80.4f);

      luma_of[i] = 1 - fminf (fmaxf (half + 0.5f - line, 0), fminf (fmaxf (2 * half, 0), 1));
    }
  CHECK (make_ink (CELD_INK_AUTO, false) == CELD_OK);
  for (int i = 0; i < SIDE * SIDE; i++)
    if (luma_of[i] == 1 || 0.08f * (float) (i % SIDE - 20) > 1.4f)
      worst = fmaxf (worst, fabsf (ink_of[i] - luma_of[i]));
  NEAR (worst, 0, 1e-3);
}

/* A flat grey area is no stroke: it stays grey. */
static void
grey_areas_stay_grey (void)
{
  for (int i = 0; i < SIDE * SIDE; i++)
    luma_of[i] = i % SIDE > 20 && i % SIDE < 100 && i / SIDE > 20 && i / SIDE < 100 ? 0.7f : i / SIDE == 130 ? 0 : 1;
  CHECK (make_ink (CELD_INK_DARK, false) == CELD_OK);
  NEAR (ink_of[60 * SIDE + 60], 0.7, 0.05);
}

static void
light_is_dark_inverted (void)
{
  static float dark[SIDE * SIDE];
  uint32_t     seed = 3;

  for (int i = 0; i < SIDE * SIDE; i++)
    luma_of[i] = fminf (1 - 0.8f * coverage (i % SIDE, i / SIDE, 4) - 0.05f + 0.01f * check_noise (&seed), 1);
  CHECK (make_ink (CELD_INK_DARK, false) == CELD_OK);
  memcpy (dark, ink_of, sizeof dark);
  for (int i = 0; i < SIDE * SIDE; i++)
    luma_of[i] = 1 - luma_of[i];
  CHECK (make_ink (CELD_INK_LIGHT, false) == CELD_OK);
  for (int i = 0; i < SIDE * SIDE; i++)
    NEAR (ink_of[i], dark[i], 1e-4);
  CHECK (make_ink (CELD_INK_AUTO, false) == CELD_OK);
  for (int i = 0; i < SIDE * SIDE; i++)
    NEAR (ink_of[i], dark[i], 1e-4);
}

/* Lines on a transparent layer are ink whatever their colour; an outlined sprite is not. */
static void
alpha_is_ink (void)
{
  for (int step = 0; step <= 4; step++)
    {
      for (int i = 0; i < SIDE * SIDE; i++)
        {
          luma_of[i] = 0.25f * (float) step;
          alpha_of[i] = coverage (i % SIDE, i / SIDE, 4);
        }
      CHECK (make_ink (step % 2 ? CELD_INK_AUTO : CELD_INK_ALPHA, true) == CELD_OK);
      for (int i = 0; i < SIDE * SIDE; i++)
        NEAR (ink_of[i], 1 - alpha_of[i], 1e-3);
    }
  for (int i = 0; i < SIDE * SIDE; i++)
    {
      float u = (float) (i % SIDE) - 79.5f, v = (float) (i / SIDE) - 79.5f;

      luma_of[i] = 1 - coverage (i % SIDE, i / SIDE, 4);
      alpha_of[i] = fminf (fmaxf (52.5f - sqrtf (u * u + v * v), 0), 1);
    }
  CHECK (make_ink (CELD_INK_AUTO, true) == CELD_OK);
  NEAR (ink_of[79 * SIDE + 50], 1, 1e-3);
  CHECK (palest_of_ring () <= 0.25f);
}

static void
not_a_number_is_paper (void)
{
  for (int i = 0; i < SIDE * SIDE; i++)
    luma_of[i] = i % 7 == 0 ? NAN : i % SIDE == 80 ? -INFINITY : i % SIDE == 60 ? INFINITY : 1;
  CHECK (make_ink (CELD_INK_AUTO, false) == CELD_OK);
  for (int i = 0; i < SIDE * SIDE; i++)
    CHECK (ink_of[i] == (i % 7 && i % SIDE == 80 ? 0 : 1));
}

/* Every size and stride; sizes that differ; nothing is written beside the picture. */
static void
sizes (void)
{
  static const int size[][2] = { { 1, 1 }, { 1, 40 }, { 40, 1 }, { 2, 2 }, { 3, 17 }, { 37, 50 } };

  for (size_t k = 0; k < sizeof size / sizeof *size; k++)
    {
      int         w = size[k][0], h = size[k][1];
      CeldDrawing drawing = { .luma = { w, h, (size_t) w + 3, luma_of } };
      CeldPlane   ink = { w, h, (size_t) w + 5, ink_of }, other = { w + 1, h, (size_t) w + 5, ink_of };

      for (int i = 0; i < SIDE * SIDE; i++)
        {
          luma_of[i] = i % (w + 3) < w ? 1 : 0;
          ink_of[i] = -7;
        }
      CHECK (celd_ink (&drawing, CELD_INK_DARK, NULL, &other) == CELD_BAD_SIZE && ink_of[0] == -7);
      CHECK (celd_ink (&drawing, CELD_INK_DARK, NULL, &ink) == CELD_OK);
      for (int y = 0; y < h; y++)
        for (int x = 0; x < w + 5; x++)
          CHECK (ink_of[y * (w + 5) + x] == (x < w ? 1 : -7));
    }
}

static void
lines_are_ink_beside_paper (void)
{
  static const char *const paper[] = { "...", "...", NULL }, *const line[] = { "...", "..#", NULL },
                    *const black[] = { "###", "###", NULL };
  CeldPlane blank = art_plane (paper), drawn = art_plane (line), full = art_plane (black);

  CHECK (!celd_ink_has_lines (&blank));
  CHECK (!celd_ink_has_lines (&full));
  CHECK (celd_ink_has_lines (&drawn));
  free (blank.data);
  free (drawn.data);
  free (full.data);
}

int
main (void)
{
  RUN (clean_art_stays);
  RUN (clean_art_with_solid_black_stays);
  RUN (white_stays_white);
  RUN (pencil_becomes_ink);
  RUN (broad_pencil_becomes_ink);
  RUN (pale_lines_in_grain_stay_whole);
  RUN (pale_strokes_are_contours);
  RUN (faint_lines_beside_dark_ones_stay_closed);
  RUN (chalk_with_holes_stays_closed);
  RUN (blur_fills_no_neck);
  RUN (hairlines_are_ink);
  RUN (tapering_strokes_stay);
  RUN (grey_areas_stay_grey);
  RUN (light_is_dark_inverted);
  RUN (alpha_is_ink);
  RUN (not_a_number_is_paper);
  RUN (lines_are_ink_beside_paper);
  RUN (sizes);
  return DONE;
}
