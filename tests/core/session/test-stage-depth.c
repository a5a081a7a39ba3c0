/* Smooth depth of a session that is edited step by step, and its preview.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "random-session.h"
#include "session/session.h"

/* ------------------------------------------------------------------ edits against a fresh session */

/* Depth and preview of a new session in this state, with the smallest tolerance. */
static CeldStatus
make_fresh (const State *state, float depth[W * H], float preview[W * H / 16])
{
  CeldSession *s = celd_session_new ();
  CeldSettings settings = state->settings;
  CeldPlane    made;
  CeldStatus   status;

  apply (s, state);
  status = celd_session_depth_preview (s, NULL, &made, NULL);
  if (status == CELD_OK)
    memcpy (preview, made.data, W * H / 16 * sizeof *preview);
  settings.tolerance = 1e-6f;
  CHECK (celd_session_set_settings (s, &settings) == CELD_OK);
  CHECK (celd_session_depth (s, NULL, &made, NULL) == status);
  if (status == CELD_OK)
    memcpy (depth, made.data, W * H * sizeof *depth);
  celd_session_free (s);
  return status;
}

/* Updates the host's picture within the reported rectangle. */
static void
see (const CeldPlane *depth, CeldRect changed, float seen[W * H])
{
  for (int y = changed.y; y < changed.y + changed.height; y++)
    memcpy (seen + y * W + changed.x, &CELD_AT (depth, changed.x, y), (size_t) changed.width * sizeof *seen);
}

/* Checks that the edited session has the depth, or the error, of a new one.  Returns whether there is depth. */
static bool
agree (CeldSession *edited, const State *state, float seen[W * H])
{
  static float wanted[W * H], wanted_preview[W * H / 16];
  CeldPlane    depth, preview;
  CeldRect     changed;
  CeldStatus   status = make_fresh (state, wanted, wanted_preview);

  CHECK (status == CELD_OK || status == CELD_NOTHING_TO_GO_BY);
  CHECK (celd_session_depth_preview (edited, NULL, &preview, NULL) == status);
  if (status != CELD_OK)
    {
      CHECK (celd_session_depth (edited, NULL, &depth, &changed) == status);
      return false;
    }
  CHECK (preview.width == W / 4 && preview.height == H / 4);
  for (int i = 0; i < W * H / 16; i++)
    NEAR (preview.data[i], wanted_preview[i], 2e-3);
  CHECK (celd_session_depth (edited, NULL, &depth, &changed) == CELD_OK);
  for (int i = 0; i < W * H; i++)
    NEAR (depth.data[i], wanted[i], 1.02e-4);
  see (&depth, changed, seen);
  CHECK (!memcmp (depth.data, seen, W * H * sizeof *seen));
  return true;
}

static void
change_anchors (State *s, uint32_t *r)
{
  s->settings.anchors   = (CeldAnchors) pick (r, 4);
  s->settings.hold_rest = pick (r, 3) != 0;
  s->settings.hold_gaps = pick (r, 3) != 0;
  s->settings.encoding  = CELD_ENCODING_NORMALIZED;
}

/* Some edits are cancelled half way. */
static void
cancel_some (CeldSession *edited, uint32_t *r, float seen[W * H])
{
  int       left = (int) pick (r, 60);
  CeldHost  host = { check_count_down, NULL, &left };
  CeldPlane depth;
  CeldRect  changed;

  if (pick (r, 3) == 0 && celd_session_depth (edited, &host, &depth, &changed) == CELD_OK)
    see (&depth, changed, seen);
}

static void
an_edited_session_equals_a_new_one (void)
{
  int compared = 0;

  for (uint32_t seed = 1; seed <= 10 && !check_bad; seed++)
    {
      static float seen[W * H];
      State        state;
      CeldSession *edited = celd_session_new ();
      uint32_t     r = 131 * seed;

      start (&state, &r);
      state.text = texts[1 + seed % 3];
      apply (edited, &state);
      for (int step = 0; step < 25 && !check_bad; step++)
        {
          compared += agree (edited, &state, seen);
          if (check_bad)
            fprintf (stderr, "  seed %u, step %d\n", (unsigned) seed, step);
          edit (&state, &r);
          if (pick (&r, 4) == 0)
            change_anchors (&state, &r);
          apply (edited, &state);
          cancel_some (edited, &r, seen);
        }
      celd_session_free (edited);
    }
  CHECK (compared >= 200); /* of 250 */
}

/* ------------------------------------------------------------------ the preview */

enum { WIDE = 330, HIGH = 227, STROKE = 3 }; /* no multiples of four */

typedef struct { float luma[WIDE * HIGH]; uint8_t paint[4 * WIDE * HIGH]; } Page;

static void
paint_square (Page *page, int x, int y, const uint8_t colour[3])
{
  for (int v = y; v < y + 6; v++)
    for (int u = x; u < x + 6; u++)
      {
        memcpy (page->paint + 4 * (v * WIDE + u), colour, 3);
        page->paint[4 * (v * WIDE + u) + 3] = 255;
      }
}

/* Six discs, each outlined and scribbled; with `gap` a piece of each outline is missing. */
static CeldSession *
draw_discs (Page *page, uint32_t *r, double gap)
{
  CeldSession *s = celd_session_new ();
  CeldDrawing  drawing = { .luma = { WIDE, HIGH, WIDE, page->luma } };
  CeldPaint    scribbles = { WIDE, HIGH, WIDE, page->paint };

  memset (page->paint, 0, sizeof page->paint);
  for (int i = 0; i < WIDE * HIGH; i++)
    page->luma[i] = 1;
  paint_square (page, 2, 2, colours[3]);
  for (int k = 0; k < 6; k++)
    {
      double radius = 22 + check_random (r, 20), x = 55 + 108 * (k % 3) + check_random (r, 10);
      double y = 55 + 110 * (k / 3) + check_random (r, 10), open = check_random (r, 600) / 100.;

      for (int i = 0; i < WIDE * HIGH; i++)
        {
          double u = i % WIDE + 0.5 - x, v = i / WIDE + 0.5 - y;
          double turn = fmod (atan2 (v, u) - open + 12.566371, 6.2831853);

          if (fabs (hypot (u, v) - radius) < STROKE / 2. && turn * radius >= gap)
            page->luma[i] = 0;
        }
      paint_square (page, (int) x, (int) y, colours[k % 3]);
    }
  CHECK (celd_session_set_drawing (s, &drawing) == CELD_OK);
  CHECK (celd_session_set_scribbles (s, &scribbles) == CELD_OK);
  CHECK (celd_session_set_relations (s, "#e60000 > #0000e6 > #00a000 > #c8c800", NULL) == CELD_OK);
  return s;
}

/* Mean depth of the pixels of a block. */
static double
block_mean (const CeldPlane *depth, int x, int y)
{
  double sum = 0, n = 0;

  for (int v = 4 * y; v < 4 * y + 4 && v < depth->height; v++)
    for (int u = 4 * x; u < 4 * x + 4 && u < depth->width; u++, n++)
      sum += (double) CELD_AT (depth, u, v);
  return sum / n;
}

/* Correlation of the preview with the means of depth over its blocks, and their mean difference. */
static double
correlate (const CeldPlane *preview, const CeldPlane *depth, double *difference)
{
  double n = preview->width * preview->height, a = 0, b = 0, aa = 0, bb = 0, ab = 0;

  *difference = 0;
  for (int y = 0; y < preview->height; y++)
    for (int x = 0; x < preview->width; x++)
      {
        double p = (double) CELD_AT (preview, x, y), d = block_mean (depth, x, y);

        a  += p;
        b  += d;
        aa += p * p;
        bb += d * d;
        ab += p * d;
        *difference += fabs (p - d) / n;
      }
  return (n * ab - a * b) / sqrt ((n * aa - a * a) * (n * bb - b * b));
}

static void
the_preview_resembles_depth (void)
{
  static Page page;

  for (uint32_t round = 0, r = 17; round < 12; round++)
    {
      double       gap = round % 2 ? 16 + check_random (&r, 20) : 0, difference;
      CeldSession *s = draw_discs (&page, &r, gap);
      CeldPlane    preview, depth;

      CHECK (celd_session_depth_preview (s, NULL, &preview, NULL) == CELD_OK);
      CHECK (preview.width == (WIDE + 3) / 4 && preview.height == (HIGH + 3) / 4);
      CHECK (!s->valid[STAGE_LEVELS]); /* without expansion */
      CHECK (celd_session_depth (s, NULL, &depth, NULL) == CELD_OK);
      CHECK (correlate (&preview, &depth, &difference) > 0.95);
      CHECK (difference < 0.025);
      celd_session_free (s);
    }
}

/* The largest step of a plane between 4-neighbours within `radius` of (x,y). */
static double
largest_step (const CeldPlane *p, int x, int y, int radius)
{
  double most = 0;

  for (int v = y - radius; v <= y + radius; v++)
    for (int u = x - radius; u <= x + radius; u++)
      if (u >= 0 && v >= 0 && u + 1 < p->width && v + 1 < p->height)
        {
          most = fmax (most, fabs ((double) CELD_AT (p, u, v) - (double) CELD_AT (p, u + 1, v)));
          most = fmax (most, fabs ((double) CELD_AT (p, u, v) - (double) CELD_AT (p, u, v + 1)));
        }
  return most;
}

/* With closed contours the discontinuities of each are at most a block and a stroke from those of the other. */
static void
preview_and_depth_have_the_same_discontinuities (void)
{
  static Page page;

  for (uint32_t round = 0, r = 4; round < 6; round++)
    {
      CeldSession *s = draw_discs (&page, &r, 0);
      CeldPlane    preview, depth;
      int          steps = 0;

      CHECK (celd_session_depth_preview (s, NULL, &preview, NULL) == CELD_OK);
      CHECK (celd_session_depth (s, NULL, &depth, NULL) == CELD_OK);
      for (int y = 0; y + 1 < preview.height; y++)
        for (int x = 0; x + 1 < preview.width; x++)
          if (largest_step (&preview, x, y, 0) > 0.01)
            {
              NEAR (largest_step (&depth, 4 * x + 4, 4 * y + 4, 4 + STROKE), largest_step (&preview, x, y, 0), 1e-2);
              steps++;
            }
      CHECK (steps > 100);
      for (int y = 0; y + 1 < HIGH; y++)
        for (int x = 0; x + 1 < WIDE; x++)
          if (largest_step (&depth, x, y, 0) > 0.01)
            NEAR (largest_step (&preview, x / 4, y / 4, 1), largest_step (&depth, x, y, 0), 1e-2);
      celd_session_free (s);
    }
}

/* A line one pixel wide, straight, slanting or round, is closed in the preview, too. */
static void
thin_contours_stay_closed_in_the_preview (void)
{
  static Page page;

  for (int round = 0; round < 8; round++)
    {
      CeldSession *s = celd_session_new ();
      CeldDrawing  drawing = { .luma = { WIDE, HIGH, WIDE, page.luma } };
      CeldPaint    scribbles = { WIDE, HIGH, WIDE, page.paint };
      CeldPlane    preview;

      memset (page.paint, 0, sizeof page.paint);
      for (int y = 0; y < HIGH; y++)
        for (int x = 0; x < WIDE; x++)
          {
            double u = x - 160 - round / 2., v = y - 110 - round / 3., tilted = fabs (u) + (round % 4) * fabs (v) / 2;
            double out = round < 4 ? tilted - 80 : hypot (u, v) - 70 - round;
            double slope = round < 4 ? 1 + round % 4 / 2. : 1.5;

            page.luma[y * WIDE + x] = out >= 0 && out < slope ? 0 : 1; /* 4-connected */
          }
      paint_square (&page, 160, 110, colours[0]);
      paint_square (&page, 4, 4, colours[1]);
      paint_square (&page, 320, 4, colours[1]);
      CHECK (celd_session_set_drawing (s, &drawing) == CELD_OK);
      CHECK (celd_session_set_scribbles (s, &scribbles) == CELD_OK);
      CHECK (celd_session_set_relations (s, "#e60000 > #0000e6", NULL) == CELD_OK);
      CHECK (celd_session_depth_preview (s, NULL, &preview, NULL) == CELD_OK);
      for (int i = 0; i < preview.width * preview.height; i++)
        CHECK (preview.data[i] == 0 || preview.data[i] == 1);
      CHECK (CELD_AT (&preview, 40, 27) == 1 && CELD_AT (&preview, 1, 1) == 0);
      celd_session_free (s);
    }
}

static void
changes_of_depth_are_reported (void)
{
  static Page  page;
  uint32_t     r = 8;
  CeldSession *s = draw_discs (&page, &r, 0);
  CeldPlane    preview;
  CeldRect     changed;

  CHECK (celd_session_depth_preview (s, NULL, &preview, &changed) == CELD_OK);
  CHECK (changed.x == 0 && changed.y == 0 && changed.width == (WIDE + 3) / 4 && changed.height == (HIGH + 3) / 4);
  CHECK (celd_session_depth_preview (s, NULL, &preview, &changed) == CELD_OK && changed.width == 0);
  CHECK (celd_session_set_relations (s, "#e60000 > #0000e6 > #c8c800; #e60000 > #00a000 > #c8c800", NULL) == CELD_OK);
  CHECK (celd_session_depth_preview (s, NULL, &preview, &changed) == CELD_OK);
  CHECK (changed.width > 20 && changed.width < (WIDE + 3) / 4);
  celd_session_free (s);
}

/* A redundant relation and a redundant stroke leave levels valid, which are not expanded again. */
static void
redundant_edits_keep_expanded_levels (void)
{
  static Page      page;
  uint32_t         r = 6;
  CeldSession     *s = draw_discs (&page, &r, 0);
  CeldHost         refuse = { .progress = check_refuse };
  uint8_t          on[16];
  CeldMask         mask = { 4, 4, 4, on };
  CeldSettings     settings = celd_settings ();
  const CeldOrder *order;
  CeldPlane        levels;
  CeldRect         changed;

  memset (on, 1, sizeof on);
  CHECK (celd_session_levels (s, NULL, &levels, NULL) == CELD_OK);
  CHECK (celd_session_put_relation (s, 1, "#e60000 > #c8c800", NULL) == CELD_OK);
  CHECK (celd_session_put_stroke (s, 1, 10, 4, &mask, colours[3]) == CELD_OK);
  CHECK (celd_session_order (s, NULL, &order) == CELD_OK);
  CHECK (celd_session_levels (s, &refuse, &levels, &changed) == CELD_OK && changed.width == 0);
  CHECK (celd_session_put_relation (s, 1, "#c8c800 > #e60000 @ 9", NULL) == CELD_OK);
  CHECK (celd_session_order (s, NULL, &order) == CELD_OK);
  CHECK (celd_session_levels (s, &refuse, &levels, NULL) == CELD_CANCELLED);
  CHECK (celd_session_levels (s, NULL, &levels, NULL) == CELD_OK);
  settings.encoding = CELD_ENCODING_RANK;
  CHECK (celd_session_set_settings (s, &settings) == CELD_OK);
  CHECK (celd_session_levels (s, &refuse, &levels, NULL) == CELD_CANCELLED);
  celd_session_free (s);
}

/* ------------------------------------------------------------------ anchors */

/* Two halves of a page, separated by a wall with a gap, each with a stroke: the places that keep their level. */
enum { STROKE_LEFT = 1, END_LEFT = 2, CORE_LEFT = 4, CORE_RIGHT = 8 };
static const int held_place[4][2] = { { 242, 22 }, { 255, 110 }, { 20, 110 }, { 325, 110 } };

static int
what_holds (CeldAnchors anchors, bool hold_rest, const char *relations)
{
  static Page  page;
  CeldSession *s = celd_session_new ();
  CeldSettings settings = celd_settings ();
  CeldDrawing  drawing = { .luma = { WIDE, HIGH, WIDE, page.luma } };
  CeldPaint    scribbles = { WIDE, HIGH, WIDE, page.paint };
  CeldPlane    depth;
  int          held = 0;

  memset (page.paint, 0, sizeof page.paint);
  for (int i = 0; i < WIDE * HIGH; i++)
    page.luma[i] = i % WIDE >= 270 && i % WIDE < 274 && abs (i / WIDE - 110) > 15 ? 0 : 1;
  paint_square (&page, 240, 20, colours[0]);
  paint_square (&page, 290, 200, colours[1]);
  settings.anchors   = anchors;
  settings.hold_rest = hold_rest;
  CHECK (celd_session_set_drawing (s, &drawing) == CELD_OK);
  CHECK (celd_session_set_scribbles (s, &scribbles) == CELD_OK);
  CHECK (celd_session_set_settings (s, &settings) == CELD_OK);
  CHECK (celd_session_set_relations (s, relations, NULL) == CELD_OK);
  CHECK (celd_session_depth (s, NULL, &depth, NULL) == CELD_OK);
  for (int k = 0; k < 4; k++)
    held |= CELD_AT (&depth, held_place[k][0], held_place[k][1]) == (k < 3 ? 1.f : 0.f) ? 1 << k : 0;
  celd_session_free (s);
  return held;
}

static void
anchors_are_those_of_the_settings (void)
{
  const char *colour = "#e60000 > #0000e6", *points = "255,110 > 290,110", *one = "255,110 > #0000e6";
  const char *marked = "255,110 > 290,110 !anchor";

  CHECK (what_holds (CELD_ANCHORS_SCRIBBLES, true, points) == STROKE_LEFT);
  CHECK (what_holds (CELD_ANCHORS_ARROWS, true, points) == END_LEFT);
  CHECK (what_holds (CELD_ANCHORS_BOTH, true, points) == (STROKE_LEFT | END_LEFT));
  CHECK (what_holds (CELD_ANCHORS_CORE, true, points) == (CORE_LEFT | CORE_RIGHT));
  CHECK (what_holds (CELD_ANCHORS_ARROWS, true, colour) == (CORE_LEFT | CORE_RIGHT)); /* there are none */
  CHECK (what_holds (CELD_ANCHORS_SCRIBBLES, false, marked) == (STROKE_LEFT | END_LEFT));
  CHECK (what_holds (CELD_ANCHORS_CORE, true, marked) == END_LEFT);
  CHECK (what_holds (CELD_ANCHORS_ARROWS, true, one) == (END_LEFT | CORE_RIGHT));
  /* Everything connected to the relation's end has its level. */
  CHECK (what_holds (CELD_ANCHORS_ARROWS, false, one) == (STROKE_LEFT | END_LEFT | CORE_LEFT));
}

int
main (void)
{
  RUN (an_edited_session_equals_a_new_one);
  RUN (the_preview_resembles_depth);
  RUN (preview_and_depth_have_the_same_discontinuities);
  RUN (thin_contours_stay_closed_in_the_preview);
  RUN (changes_of_depth_are_reported);
  RUN (redundant_edits_keep_expanded_levels);
  RUN (anchors_are_those_of_the_settings);
  return DONE;
}
