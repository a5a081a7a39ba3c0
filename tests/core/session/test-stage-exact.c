/* The exact program in a session: the background, edits, invalidated stages, the preview.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "session/session.h"

#define W 61
#define H 40

static float luma[W * H];

/* Two sheets side by side, outlined two pixels wide, a scribble in each and perhaps one on the page. */
static CeldSession *
scene (bool page)
{
  CeldSession *s = celd_session_new ();
  CeldSettings settings = celd_settings ();
  CeldDrawing  drawing = { .luma = { W, H, W, luma } };
  uint8_t      on[24];
  CeldMask     mask = { 12, 2, 12, on };

  for (int y = 0; y < H; y++)
    for (int x = 0; x < W; x++)
      {
        int  left = x < W / 2 ? 6 : 34;
        bool inside = x >= left && x < left + 22 && y >= 8 && y < 32;
        bool core = x >= left + 2 && x < left + 20 && y >= 10 && y < 30;

        luma[y * W + x] = inside && !core ? 0.f : 1.f;
      }
  memset (on, 1, sizeof on);
  settings.encoding = CELD_ENCODING_RANK;
  CHECK (celd_session_set_settings (s, &settings) == CELD_OK);
  CHECK (celd_session_set_drawing (s, &drawing) == CELD_OK);
  CHECK (celd_session_put_stroke (s, 1, 10, 20, &mask, (const uint8_t[3]) { 255, 0, 0 }) == CELD_OK);
  CHECK (celd_session_put_stroke (s, 2, 40, 20, &mask, (const uint8_t[3]) { 0, 255, 0 }) == CELD_OK);
  if (page)
    CHECK (celd_session_put_stroke (s, 3, 10, 3, &mask, (const uint8_t[3]) { 0, 0, 255 }) == CELD_OK);
  return s;
}

static double
ask (CeldSession *s, int x, int y)
{
  CeldPlane depth = { 0 };

  CHECK (celd_session_exact (s, NULL, &depth, NULL) == CELD_OK);
  return depth.data ? (double) CELD_AT (&depth, x, y) : NAN;
}

static void
set (CeldSession *s, CeldBackground background, CeldSameColour same_colour)
{
  CeldSettings settings = s->settings;

  settings.background  = background;
  settings.same_colour = same_colour;
  CHECK (celd_session_set_settings (s, &settings) == CELD_OK);
}

/* ------------------------------------------------------------------ the background */

static void
the_page_is_the_farthest (void)
{
  CeldSession *s = scene (true);

  NEAR (ask (s, 10, 20), 1, 1e-6);
  NEAR (ask (s, 40, 20), 1, 1e-6);
  NEAR (ask (s, 1, 38), 0, 0.01);
  CHECK (celd_session_exact_palette (s)->item[2].background);
  set (s, CELD_BACKGROUND_NONE, CELD_SAME_COLOUR_ONE);
  NEAR (ask (s, 10, 20), 0, 0);
  CHECK (!celd_session_exact_palette (s)->item[2].background);
  celd_session_free (s);
}

static void
a_page_without_scribble_becomes_a_node (void)
{
  CeldSession *s = scene (false);

  NEAR (ask (s, 10, 20), 1, 1e-6);
  NEAR (ask (s, 0, 38), 0, 0);
  CHECK (celd_session_exact_report (s)->n == 3 && celd_session_exact_palette (s)->n == 3);
  CHECK (celd_session_put_relation (s, 7, "3,3 > #ff0000", NULL) == CELD_OK); /* a point of the page before a sheet */
  CHECK (ask (s, 3, 3) - ask (s, 10, 20) > 1 - 1e-5 && ask (s, 10, 20) - ask (s, 0, 39) > 1 - 1e-5);
  celd_session_free (s);
}

static void
both_scribbles_of_the_page_are_the_farthest (void)
{
  CeldSession *s = scene (true);
  uint8_t      on[4] = { 1, 1, 1, 1 };
  CeldMask     mask = { 1, 4, 1, on };

  for (uint32_t i = 0; i < 20; i++)
    CHECK (celd_session_put_stroke (s, 10 + i, 20 + (int) i, 36, &mask, (const uint8_t[3]) { 0, 0, 255 }) == CELD_OK);
  set (s, CELD_BACKGROUND_AUTO, CELD_SAME_COLOUR_SEPARATE);
  CHECK (ask (s, 10, 20) >= 1 && ask (s, 40, 20) >= 1 && ask (s, 30, 38) < 0.1 && ask (s, 12, 4) < 0.1);
  CHECK (celd_session_exact_report (s)->n == 4);
  celd_session_free (s);
}

/* ------------------------------------------------------------------ edits */

/* Depth and energy equal those of a new session in the same state. */
static void
check_fresh (CeldSession *s)
{
  CeldSession *fresh = celd_session_new ();
  CeldPlane    depth = { 0 }, wanted = { 0 };

  CHECK (celd_session_set_settings (fresh, &s->settings) == CELD_OK);
  CHECK (celd_session_set_drawing (fresh, &s->drawing) == CELD_OK);
  for (size_t i = 0; i < s->n_strokes; i++)
    {
      const CeldStroke *stroke = &s->stroke[i];

      for (size_t k = 0; k < stroke->n; k++)
        {
          uint8_t  on[W];
          CeldMask mask = { stroke->span[k].end - stroke->span[k].x, 1, W, on };

          memset (on, 1, sizeof on);
          CHECK (celd_session_put_stroke (fresh, (uint32_t) (1000 * i + k + 1), stroke->x + stroke->span[k].x,
                                          stroke->y + stroke->span[k].y, &mask, stroke->colour) == CELD_OK);
        }
    }
  for (size_t i = 0; i < s->single.n; i++)
    CHECK (celd_relation_add (&fresh->single, s->single.item[i]) == CELD_OK);
  CHECK (celd_session_exact (s, NULL, &depth, NULL) == CELD_OK);
  CHECK (celd_session_exact (fresh, NULL, &wanted, NULL) == CELD_OK);
  for (int i = 0; i < W * H && depth.data && wanted.data; i++)
    NEAR (depth.data[i], wanted.data[i], 1e-3);
  celd_session_free (fresh);
}

static void
an_edited_session_equals_a_new_one (void)
{
  CeldSession *s = scene (true);
  uint8_t      on[30];
  CeldMask     mask = { 6, 5, 6, on };
  uint32_t     seed = 9;

  memset (on, 1, sizeof on);
  for (int edit = 0; edit < 24 && !check_bad; edit++)
    {
      uint32_t id = 20 + check_random (&seed, 4);
      char     text[80];

      if (edit % 4 == 0)
        CHECK (celd_session_put_stroke (s, id, (int) check_random (&seed, W - 6), (int) check_random (&seed, H - 5),
                                        &mask, (const uint8_t[3]) { 255, (uint8_t) (50 * (id - 20)), 0 }) == CELD_OK);
      else if (edit % 4 == 3)
        celd_session_remove_relation (s, id);
      else
        {
          snprintf (text, sizeof text, "%u,%u > %u,%u", check_random (&seed, W), check_random (&seed, H),
                    check_random (&seed, W), check_random (&seed, H));
          CHECK (celd_session_put_relation (s, id, text, NULL) == CELD_OK);
        }
      check_fresh (s);
    }
  celd_session_free (s);
}

#define MADE(stage) s->valid[STAGE_##stage]

static void
an_edit_invalidates_the_stages_that_read_it (void)
{
  CeldSession *s = scene (true);
  CeldSettings settings;
  CeldRect     changed;
  CeldPlane    depth;

  CHECK (!celd_session_exact_report (s));
  CHECK (celd_session_exact (s, NULL, &depth, &changed) == CELD_OK && changed.width == W && changed.height == H);
  CHECK (celd_session_exact (s, NULL, &depth, &changed) == CELD_OK && changed.width == 0);
  CHECK (celd_session_put_relation (s, 1, "#ff0000 > #00ff00", NULL) == CELD_OK);
  CHECK (MADE (NODES) && !MADE (EXACT) && !celd_session_exact_report (s));
  CHECK (celd_session_exact (s, NULL, &depth, &changed) == CELD_OK && changed.width > 10);
  CHECK (!MADE (LABELS)); /* exact depth needs no labels */
  settings = s->settings;
  settings.encoding = CELD_ENCODING_NORMALIZED;
  CHECK (celd_session_set_settings (s, &settings) == CELD_OK && MADE (NODES) && !MADE (EXACT));
  NEAR (ask (s, 10, 20), 1, 0);
  settings.bulge = 2;
  CHECK (celd_session_set_settings (s, &settings) == CELD_OK && MADE (EXACT));
  settings.background = CELD_BACKGROUND_NONE;
  CHECK (celd_session_set_settings (s, &settings) == CELD_OK && MADE (WEIGHTS) && !MADE (NODES) && !MADE (EXACT));
  settings.contrast = 2;
  CHECK (celd_session_set_settings (s, &settings) == CELD_OK && MADE (INK) && !MADE (WEIGHTS));
  NEAR (ask (s, 10, 20), 1, 0);
  CHECK (celd_session_exact_report (s)->sigma > 0);
  celd_session_free (s);
}

/* A segmentation finds the background scribble, so settings of regions may change it. */
static void
settings_of_regions_may_change_the_background (void)
{
  CeldSession *s = scene (true);
  CeldSettings settings = s->settings;

  for (int k = 0; k < 4; k++)
    {
      ask (s, 10, 20);
      CHECK (MADE (NODES) && MADE (EXACT));
      settings.hardness      = k == 0 ? 1 : settings.hardness;
      settings.close_gaps    = k != 1 && settings.close_gaps;
      settings.keep_necks    = k != 2 && settings.keep_necks;
      settings.ink_threshold = k == 3 ? 0.5f : settings.ink_threshold;
      CHECK (celd_session_set_settings (s, &settings) == CELD_OK && !MADE (NODES) && !MADE (EXACT));
      check_fresh (s);
    }
  celd_session_free (s);
}

/* ------------------------------------------------------------------ contours and contradictions */

static void
virtual_contours_separate_depth (void)
{
  CeldSession *s = scene (true);
  uint8_t      paint[4 * W * H] = { 0 };
  CeldPaint    contours = { W, H, W, paint };

  CHECK (celd_session_put_relation (s, 1, "10,12 > 22,28", NULL) == CELD_OK);
  CHECK (ask (s, 9, 28) - ask (s, 25, 28) < 0.5); /* the sheet bends */
  for (int y = 8; y < 32; y++)
    for (int x = 16; x < 18; x++)
      memcpy (paint + 4 * (y * W + x), (const uint8_t[4]) { 255, 0, 0, 255 }, 4);
  CHECK (celd_session_remove_stroke (s, 1) == CELD_OK);
  CHECK (celd_session_set_contours (s, &contours) == CELD_OK);
  CHECK (ask (s, 9, 28) - ask (s, 25, 28) > 0.95); /* and is cut */
  celd_session_free (s);
}

/* A sheet whose outline is broken keeps its depth, unless gaps do not hold or a blue contour lies there. */
static void
gaps_hold_depth (void)
{
  CeldSession *s = scene (true);
  CeldDrawing  drawing = { .luma = { W, H, W, luma } };
  uint8_t      paint[4 * W * H] = { 0 };
  CeldPaint    contours = { W, H, W, paint };
  CeldSettings settings = s->settings;
  CeldPlane    half;

  for (int y = 16; y < 24; y++)
    {
      luma[y * W + 26] = luma[y * W + 27] = 1;
      memcpy (paint + 4 * (y * W + 26), (const uint8_t[8]) { 0, 0, 255, 255, 0, 0, 255, 255 }, 8);
    }
  CHECK (celd_session_set_drawing (s, &drawing) == CELD_OK);
  CHECK (celd_session_put_relation (s, 1, "#ff0000 > #0000ff", NULL) == CELD_OK);
  for (int round = 0; round < 2; round++) /* again after edits that open the gap */
    {
      NEAR (ask (s, 25, 20), 1, 0.02);
      NEAR (ask (s, 29, 20), 0, 0.02);
      CHECK (celd_session_exact_preview (s, NULL, &half) == CELD_OK);
      CHECK (CELD_AT (&half, 11, 10) - CELD_AT (&half, 15, 10) > 0.9f);
      settings.hold_gaps = false;
      CHECK (celd_session_set_settings (s, &settings) == CELD_OK && MADE (WEIGHTS) && !MADE (NODES));
      CHECK (ask (s, 25, 20) - ask (s, 29, 20) < 0.3);
      check_fresh (s);
      settings.hold_gaps = true;
      CHECK (celd_session_set_settings (s, &settings) == CELD_OK);
      check_fresh (s);
      CHECK (celd_session_set_contours (s, &contours) == CELD_OK);
      CHECK (ask (s, 25, 20) - ask (s, 29, 20) < 0.3);
      CHECK (celd_session_set_contours (s, NULL) == CELD_OK);
    }
  celd_session_free (s);
}

static void
contradictions_are_reported (void)
{
  CeldSession        *s = scene (true);
  const CeldProblems *problems;
  char                text[400];

  CHECK (celd_session_put_relation (s, 1, "#ff0000 > #00ff00", NULL) == CELD_OK);
  CHECK (celd_session_put_relation (s, 2, "#00ff00 > 12,20", NULL) == CELD_OK);
  NEAR (ask (s, 10, 20) - ask (s, 40, 20), 1, 1e-5);
  problems = celd_session_problems (s);
  CHECK (problems->n == 1 && problems->item[0].kind == CELD_PROBLEM_CONTRADICTION && problems->item[0].relation == 1);
  CHECK (celd_session_exact_report (s)->n_cycles == 1);
  celd_problem_text (&problems->item[0], celd_session_exact_palette (s), celd_session_relations (s), NULL, text,
                     sizeof text);
  CHECK (strstr (text, "contradicts"));
  celd_session_free (s);
}

/* ------------------------------------------------------------------ preview */

static void
the_preview_is_close_to_depth (void)
{
  CeldSession *s = scene (true);
  CeldPlane    half, depth;
  float        off = 0;

  CHECK (celd_session_put_relation (s, 1, "#ff0000 > #00ff00; 20,28 > 15,15 +0.5", NULL) == CELD_OK);
  CHECK (celd_session_exact (s, NULL, &depth, NULL) == CELD_OK);
  CHECK (celd_session_exact_preview (s, NULL, &half) == CELD_OK);
  CHECK (half.width == (W + 1) / 2 && half.height == (H + 1) / 2);
  for (int y = 0; y < H; y++)
    for (int x = 0; x < W; x++)
      if ((x > 10 && x < 22 && y > 12 && y < 28) || (x > 38 && x < 50 && y > 12 && y < 28) || y < 5)
        off = fmaxf (off, fabsf (CELD_AT (&half, x / 2, y / 2) - CELD_AT (&depth, x, y)));
  CHECK (off < 0.3);
  celd_session_free (s);
}

/* Reading a painted layer, which may take as long as what follows, can be cancelled, too. */
static void
the_preview_can_be_cancelled_while_scribbles_are_read (void)
{
  CeldSession *s = scene (true);
  uint8_t      paint[4 * W * H] = { 0 };
  CeldPaint    scribbles = { W, H, W, paint };
  CeldHost     refuse = { .progress = check_refuse };
  CeldPlane    ink, half;

  for (int i = 0; i < 12; i++)
    memcpy (paint + 4 * (20 * W + 40 + i), (const uint8_t[4]) { 255, 255, 0, 255 }, 4);
  CHECK (celd_session_set_scribbles (s, &scribbles) == CELD_OK);
  CHECK (celd_session_ink (s, NULL, &ink, NULL) == CELD_OK);
  CHECK (celd_session_exact_preview (s, &refuse, &half) == CELD_CANCELLED);
  CHECK (!s->valid[STAGE_SCRIBBLES]);
  CHECK (celd_session_exact_preview (s, NULL, &half) == CELD_OK);
  celd_session_free (s);
}

int
main (void)
{
  RUN (the_page_is_the_farthest);
  RUN (a_page_without_scribble_becomes_a_node);
  RUN (both_scribbles_of_the_page_are_the_farthest);
  RUN (an_edited_session_equals_a_new_one);
  RUN (an_edit_invalidates_the_stages_that_read_it);
  RUN (settings_of_regions_may_change_the_background);
  RUN (virtual_contours_separate_depth);
  RUN (gaps_hold_depth);
  RUN (contradictions_are_reported);
  RUN (the_preview_is_close_to_depth);
  RUN (the_preview_can_be_cancelled_while_scribbles_are_read);
  return DONE;
}
