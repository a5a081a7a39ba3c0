/* The session: results, edits, relations, strokes, settings, cancelling and errors, on a sheet on a page.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "base/base.h"

#define W 48
#define H 32

static const uint8_t red[3] = { 255, 0, 0 }, blue[3] = { 0, 0, 255 };

/* A sheet in the middle of the page, outlined two pixels wide. */
static CeldDrawing
sheet (float *luma)
{
  for (int y = 0; y < H; y++)
    for (int x = 0; x < W; x++)
      {
        bool inside = x >= 12 && x < 36 && y >= 8 && y < 24, core = x >= 14 && x < 34 && y >= 10 && y < 22;

        luma[y * W + x] = inside && !core ? 0.f : 1.f;
      }
  return (CeldDrawing) { .luma = { W, H, W, luma } };
}

static void
put_box (CeldSession *s, uint32_t id, int x, int y, int width, int height, const uint8_t colour[3])
{
  uint8_t  on[W * H];
  CeldMask mask = { width, height, (size_t) width, on };

  memset (on, 1, sizeof on);
  CHECK (celd_session_put_stroke (s, id, x, y, &mask, colour) == CELD_OK);
}

/* The sheet with a red stroke in it and a blue one outside. */
static CeldSession *
scene (void)
{
  static float luma[W * H];
  CeldDrawing  drawing = sheet (luma);
  CeldSession *s = celd_session_new ();

  CHECK (celd_session_set_drawing (s, &drawing) == CELD_OK);
  put_box (s, 1, 18, 14, 10, 3, red);
  put_box (s, 2, 2, 2, 40, 3, blue);
  CHECK (celd_session_set_relations (s, "#ff0000 > #0000ff", NULL) == CELD_OK);
  return s;
}

/* A correction in the page's colour gives the outline to the page; without it, it is the sheet's again. */
static void
corrections_give_ink_to_their_region (void)
{
  CeldSession   *s = scene ();
  uint8_t        on[4 * W * H] = { 0 };
  CeldPaint      paint = { W, H, W, on };
  CeldOwnership  own;
  CeldPlane      levels;
  CeldRect       changed;
  const uint8_t  stroke[4] = { 0, 0, 255, 255 };

  CHECK (celd_session_ownership (s, NULL, &own, &changed) == CELD_OK && changed.width == W);
  CHECK (CELD_AT (&own.owner, 12, 16) == CELD_AT (&own.owner, 24, 16));
  memcpy (CELD_RGBA (&paint, 12, 16), stroke, 4);
  CHECK (celd_session_set_corrections (s, &paint) == CELD_OK);
  CHECK (celd_session_ownership (s, NULL, &own, &changed) == CELD_OK && changed.width > 0 && changed.width < W);
  CHECK (CELD_AT (&own.owner, 12, 16) == CELD_AT (&own.owner, 2, 28));
  CHECK (CELD_AT (&own.owner, 13, 18) == CELD_AT (&own.owner, 2, 28)); /* the piece of line, not the pixel */
  CHECK (celd_session_levels (s, NULL, &levels, NULL) == CELD_OK && CELD_AT (&levels, 12, 18) == 0);
  CHECK (celd_session_set_corrections (s, &paint) == CELD_OK);
  CHECK (celd_session_ownership (s, NULL, &own, &changed) == CELD_OK && changed.width == 0);
  CHECK (celd_session_set_corrections (s, NULL) == CELD_OK);
  CHECK (celd_session_ownership (s, NULL, &own, &changed) == CELD_OK && changed.width > 0);
  CHECK (CELD_AT (&own.owner, 12, 16) == CELD_AT (&own.owner, 24, 16));
  celd_session_free (s);
}

static void
results_of_a_sheet_on_a_page (void)
{
  CeldSession     *s = scene ();
  CeldLabels       labels;
  CeldPlane        levels, depth, shading;
  CeldVectors      normals;
  const CeldOrder *order;
  CeldRect         changed;

  CHECK (celd_session_labels (s, NULL, &labels, &changed) == CELD_OK);
  CHECK (changed.x == 0 && changed.y == 0 && changed.width == W && changed.height == H);
  CHECK (celd_session_palette (s)->n == 2);
  CHECK (CELD_AT (&labels, 24, 12) != CELD_AT (&labels, 2, 28));
  CHECK (celd_session_order (s, NULL, &order) == CELD_OK && order->levels == 2 && order->n_cycles == 0);
  CHECK (celd_session_levels (s, NULL, &levels, NULL) == CELD_OK);
  CHECK (CELD_AT (&levels, 24, 12) == 1 && CELD_AT (&levels, 2, 28) == 0);
  CHECK (CELD_AT (&levels, 12, 16) == 1 && CELD_AT (&levels, 35, 16) == 1); /* the outline is the sheet's */
  CHECK (celd_session_depth (s, NULL, &depth, NULL) == CELD_OK);
  NEAR (CELD_AT (&depth, 24, 12), 1, 1e-4);
  NEAR (CELD_AT (&depth, 2, 28), 0, 1e-4);
  CHECK (celd_session_normals (s, NULL, &normals, NULL) == CELD_OK);
  CHECK (CELD_XYZ (&normals, 13, 16)[0] < -0.5f && CELD_XYZ (&normals, 34, 16)[0] > 0.5f);
  CHECK (CELD_XYZ (&normals, 24, 9)[1] > 0.5f); /* y up */
  CHECK (celd_session_shading (s, NULL, &shading, NULL) == CELD_OK);
  CHECK (celd_session_problems (s)->n == 0);
  celd_session_free (s);
}

static void
edits_report_the_rectangle_that_changed (void)
{
  CeldSession *s = scene ();
  CeldLabels   labels;
  CeldPlane    levels;
  CeldRect     changed;

  CHECK (celd_session_labels (s, NULL, &labels, NULL) == CELD_OK);
  CHECK (celd_session_labels (s, NULL, &labels, &changed) == CELD_OK && changed.width == 0);
  CHECK (celd_session_levels (s, NULL, &levels, NULL) == CELD_OK);
  CHECK (celd_session_set_relations (s, "#ff0000 < #0000ff", NULL) == CELD_OK);
  CHECK (celd_session_labels (s, NULL, &labels, &changed) == CELD_OK && changed.width == 0);
  CHECK (celd_session_levels (s, NULL, &levels, &changed) == CELD_OK);
  CHECK (CELD_AT (&levels, 24, 12) == 0 && CELD_AT (&levels, 2, 28) == 1);
  CHECK (changed.width == W && changed.height == H);

  put_box (s, 1, 18, 14, 10, 3, blue); /* the same stroke in the other colour: the sheet joins the page */
  CHECK (celd_session_set_relations (s, "", NULL) == CELD_OK);
  CHECK (celd_session_labels (s, NULL, &labels, &changed) == CELD_OK);
  CHECK (celd_session_palette (s)->n == 1);
  CHECK (CELD_AT (&labels, 24, 12) == CELD_AT (&labels, 2, 28));
  CHECK (celd_session_remove_stroke (s, 1) == CELD_OK);
  CHECK (celd_session_remove_stroke (s, 1) == CELD_BAD_VALUE);
  CHECK (celd_session_labels (s, NULL, &labels, NULL) == CELD_OK);
  celd_session_free (s);
}

static void
single_relations_add_to_the_text (void)
{
  CeldSession     *s = scene ();
  const CeldOrder *order;
  CeldTextError    error;

  CHECK (celd_session_put_relation (s, 7, "#0000ff > #ff0000", NULL) == CELD_OK); /* against the text */
  CHECK (celd_session_order (s, NULL, &order) == CELD_OK && order->n_cycles == 1);
  CHECK (celd_session_relations (s)->item[order->cycle[0].item[0]].id == 7); /* the later one gives way */
  CHECK (celd_session_put_relation (s, 7, "#0000ff > #ff0000 @ 2", NULL) == CELD_OK); /* replaced by a heavier one */
  CHECK (celd_session_order (s, NULL, &order) == CELD_OK && order->n_cycles == 1);
  CHECK (celd_session_relations (s)->item[order->cycle[0].item[0]].id == 0);
  CHECK (celd_session_put_relation (s, 7, "#0000ff >", &error) == CELD_BAD_RELATION && error.line == 1);
  CHECK (celd_session_relations (s)->n == 2); /* as it was */
  CHECK (celd_session_remove_relation (s, 7) == CELD_OK);
  CHECK (celd_session_remove_relation (s, 7) == CELD_BAD_VALUE);
  CHECK (celd_session_order (s, NULL, &order) == CELD_OK && order->n_cycles == 0);
  celd_session_free (s);
}

static void
anchors_keep_their_level (void)
{
  static float luma[W * H];
  CeldDrawing  drawing = sheet (luma);
  CeldSession *s = scene ();
  CeldSettings settings = celd_settings ();
  CeldPlane    depth;

  settings.hold_gaps = false;
  for (int y = 13; y < 19; y++) /* open the sheet to the right */
    luma[y * W + 34] = luma[y * W + 35] = 1;
  CHECK (celd_session_set_drawing (s, &drawing) == CELD_OK);
  CHECK (celd_session_set_settings (s, &settings) == CELD_OK);
  CHECK (celd_session_set_relations (s, "#ff0000 > #0000ff; 40,16 = 44,30 !anchor", NULL) == CELD_OK);
  CHECK (celd_session_depth (s, NULL, &depth, NULL) == CELD_OK);
  NEAR (CELD_AT (&depth, 22, 15), 1, 1e-6);  /* the stroke */
  NEAR (CELD_AT (&depth, 40, 16), 0, 1e-6);  /* the relation's end */
  CHECK (CELD_AT (&depth, 33, 16) < 0.9f);   /* in between depth runs smoothly through the gap */
  CHECK (CELD_AT (&depth, 33, 16) > CELD_AT (&depth, 36, 16));
  celd_session_free (s);
}

/* Differences across the gap of the sheet that is open to the right: depth, the normals' x, heights. */
static void
measure_gap (CeldSession *s, double step[3])
{
  CeldPlane   depth;
  CeldVectors normals;
  CeldRelief  relief = { 0 };

  CHECK (celd_session_depth (s, NULL, &depth, NULL) == CELD_OK);
  CHECK (celd_session_normals (s, NULL, &normals, NULL) == CELD_OK);
  CHECK (celd_session_relief (s, NULL, &relief) == CELD_OK);
  step[0] = 0;
  for (int x = 32; x < 38; x++)
    step[0] = fmax (step[0], (double) (CELD_AT (&depth, x, 16) - CELD_AT (&depth, x + 1, 16)));
  step[1] = (double) CELD_XYZ (&normals, 33, 16)[0];
  step[2] = 0;
  for (int x = 32; x < 38; x++)
    step[2] += relief.cut[16 * W + x] & CELD_CUT_RIGHT ? 1 : 0;
  celd_relief_clear (&relief);
}

/* Whether gaps hold is one answer for depth, normals and relief, also after it was changed. */
static void
all_surfaces_end_at_gaps_that_hold (void)
{
  static float luma[W * H];
  CeldDrawing  drawing = sheet (luma);
  CeldSession *s = scene ();
  CeldSettings settings = celd_settings ();

  for (int y = 13; y < 19; y++)
    luma[y * W + 34] = luma[y * W + 35] = 1;
  CHECK (celd_session_set_drawing (s, &drawing) == CELD_OK);
  for (int turn = 0; turn < 4; turn++)
    {
      double step[3];

      settings.hold_gaps = turn % 2 == 0;
      CHECK (celd_session_set_settings (s, &settings) == CELD_OK);
      measure_gap (s, step);
      CHECK (settings.hold_gaps ? step[0] > 0.99 : step[0] < 0.5);
      CHECK (settings.hold_gaps ? step[1] > 0.6 : step[1] < 0.3);
      CHECK (settings.hold_gaps ? step[2] == 1 : step[2] == 0);
    }
  celd_session_free (s);
}

/* No stage is made again, so a host that cancels at the first report is not called. */
static void
equal_input_invalidates_nothing (void)
{
  static float   luma[W * H];
  static uint8_t pixels[4 * W * H];
  CeldDrawing    drawing = sheet (luma);
  CeldPaint      layer = { W, H, W, pixels };
  CeldSession   *s = scene ();
  CeldPlane      shading;
  int            left = 0;
  CeldHost       none = { .progress = check_count_down, .data = &left };

  CHECK (celd_session_set_contours (s, &layer) == CELD_OK);
  CHECK (celd_session_shading (s, NULL, &shading, NULL) == CELD_OK);
  CHECK (celd_session_set_drawing (s, &drawing) == CELD_OK);
  CHECK (celd_session_set_contours (s, &layer) == CELD_OK);
  CHECK (celd_session_set_arrows (s, NULL) == CELD_OK);
  CHECK (celd_session_set_relations (s, "#ff0000 > #0000ff", NULL) == CELD_OK);
  CHECK (celd_session_shading (s, &none, &shading, NULL) == CELD_OK);
  pixels[3] = 255;
  CHECK (celd_session_set_contours (s, &layer) == CELD_OK);
  CHECK (celd_session_shading (s, &none, &shading, NULL) == CELD_CANCELLED);
  celd_session_free (s);
}

/* Left of a straight grey line, two pixels wide, is red, right of a jagged black one is blue.  What lies between is
 * red's while grey ink costs more than black, and blue's when both cost the same, because the grey line is the shorter
 * one. */
static void
a_new_ink_threshold_changes_the_labels (void)
{
  static float luma[W * H];
  CeldDrawing  drawing = { .luma = { W, H, W, luma } };
  CeldSettings settings = celd_settings ();
  CeldSession *s = celd_session_new ();
  CeldLabels   labels;

  for (int i = 0; i < W * H; i++)
    luma[i] = i % W == 12 || i % W == 13 ? 0.4f : 1.f;
  for (int y = 0; y < H; y++)
    for (int x = 28; x <= 32; x++)
      if (y % 4 == 0 || x == (y / 4 % 2 ? 28 : 32))
        luma[y * W + x] = 0;
  CHECK (celd_session_set_drawing (s, &drawing) == CELD_OK);
  put_box (s, 1, 4, 8, 3, 16, red);
  put_box (s, 2, 40, 8, 3, 16, blue);
  settings.background = CELD_BACKGROUND_NONE;
  CHECK (celd_session_set_settings (s, &settings) == CELD_OK);
  CHECK (celd_session_labels (s, NULL, &labels, NULL) == CELD_OK);
  CHECK (CELD_AT (&labels, 20, 16) == CELD_AT (&labels, 5, 16));
  settings.ink_threshold = 0.9f;
  CHECK (celd_session_set_settings (s, &settings) == CELD_OK);
  CHECK (celd_session_labels (s, NULL, &labels, NULL) == CELD_OK);
  CHECK (CELD_AT (&labels, 20, 16) == CELD_AT (&labels, 41, 16));
  celd_session_free (s);
}

static void
a_cancelled_session_can_be_used (void)
{
  CeldPlane depth;

  for (int k = 0; k < 1000; k++)
    {
      CeldSession *s = scene ();
      int          left = k;
      CeldHost     host = { check_count_down, NULL, &left };
      CeldStatus   status = celd_session_depth (s, &host, &depth, NULL);

      CHECK (status == CELD_OK || status == CELD_CANCELLED);
      CHECK (celd_session_depth (s, NULL, &depth, NULL) == CELD_OK);
      NEAR (CELD_AT (&depth, 24, 12), 1, 1e-4);
      celd_session_free (s);
      if (status == CELD_OK)
        {
          CHECK (k > 5); /* reports */
          return;
        }
    }
  CHECK (!"ends within 1000 reports");
}

static void
wrong_input_is_an_error (void)
{
  static float   luma[W * H];
  static uint8_t rgba[4 * 16];
  CeldDrawing    drawing = sheet (luma), none = { 0 };
  CeldPaint      small = { 4, 4, 4, rgba };
  CeldSettings   wrong = celd_settings ();
  CeldSession   *s = celd_session_new ();
  CeldTextError  error = { 0 };
  CeldLabels     labels;

  CHECK (celd_session_labels (s, NULL, &labels, NULL) == CELD_BAD_SIZE); /* no drawing yet */
  CHECK (celd_session_set_drawing (s, &none) == CELD_BAD_SIZE);
  CHECK (celd_session_set_drawing (s, &drawing) == CELD_OK);
  CHECK (celd_session_labels (s, NULL, &labels, NULL) == CELD_NOTHING_TO_GO_BY);
  CHECK (celd_session_set_scribbles (s, &small) == CELD_BAD_SIZE);
  CHECK (celd_session_set_relations (s, "1,1 > 2,2\n2", &error) == CELD_BAD_RELATION && error.line == 2);
  wrong.tolerance = NAN;
  CHECK (celd_session_set_settings (s, &wrong) == CELD_BAD_VALUE);
  CHECK (celd_session_put_stroke (s, 0, 0, 0, &(CeldMask) { 4, 4, 4, rgba }, red) == CELD_BAD_VALUE);
  celd_session_free (s);
  celd_session_free (NULL);
}

static void
strokes_far_outside_change_nothing (void)
{
  CeldSession *s = scene ();
  CeldLabels   labels;
  uint32_t     middle;

  CHECK (celd_session_labels (s, NULL, &labels, NULL) == CELD_OK);
  middle = CELD_AT (&labels, 24, 12);
  put_box (s, 9, INT32_MAX - 2, INT32_MIN, 4, 4, blue);
  CHECK (celd_session_labels (s, NULL, &labels, NULL) == CELD_OK);
  CHECK (CELD_AT (&labels, 24, 12) == middle);
  celd_session_free (s);
}

static void
a_drawing_of_another_size_makes_new_labels (void)
{
  static float luma[20 * 20];
  CeldDrawing  small = { .luma = { 20, 20, 20, luma } };
  CeldSession *s = scene ();
  CeldLabels   labels;
  CeldRect     changed;

  for (int i = 0; i < 400; i++)
    luma[i] = 1;
  CHECK (celd_session_labels (s, NULL, &labels, NULL) == CELD_OK);
  CHECK (celd_session_set_drawing (s, &small) == CELD_OK);
  CHECK (celd_session_labels (s, NULL, &labels, &changed) == CELD_OK);
  CHECK (labels.width == 20 && changed.width == 20 && changed.height == 20);
  celd_session_free (s);
}

/* A blue sheet over a red one: suggestions_are_used_only_on_demand count only with settings.suggest, and never against
 * a relation. */
static void
suggestions_are_used_only_on_demand (void)
{
  static const uint8_t green[3] = { 0, 255, 0 };
  static float         luma[W * H];
  static uint8_t       pixels[4 * W * H];
  CeldDrawing          drawing = { .luma = { W, H, W, luma } };
  CeldPaint            paint = { W, H, W, pixels };
  CeldSession         *s = celd_session_new ();
  CeldSettings         settings = celd_settings ();
  const CeldRelations *suggested;
  CeldPlane            flat;
  int                  painted = 0;

  for (int y = 0; y < H; y++)
    for (int x = 0; x < W; x++)
      {
        bool red_sheet = x >= 3 && x < 28 && y >= 3 && y < 22, red_paper = x >= 5 && x < 26 && y >= 5 && y < 20;
        bool blue_sheet = x >= 18 && x < 45 && y >= 10 && y < 29, blue_paper = x >= 20 && x < 43 && y >= 12 && y < 27;

        luma[y * W + x] = blue_sheet ? blue_paper : red_sheet ? red_paper : 1;
      }
  CHECK (celd_session_set_drawing (s, &drawing) == CELD_OK);
  put_box (s, 1, 7, 7, 10, 3, red);
  put_box (s, 2, 24, 16, 14, 3, blue);
  put_box (s, 3, 1, 0, 44, 2, green);
  CHECK (celd_session_unexpanded_levels (s, NULL, &flat, NULL) == CELD_OK);
  CHECK (CELD_AT (&flat, 8, 8) == CELD_AT (&flat, 30, 17) && celd_session_relations (s)->n == 0);
  CHECK (celd_session_suggestions (s, NULL, &suggested) == CELD_OK && suggested->n == 3);
  CHECK (celd_session_paint_suggestions (s, NULL, &paint) == CELD_OK);
  for (int p = 0; p < W * H; p++)
    painted += pixels[4 * p + 3] > 127;
  CHECK (painted > 10 && painted < 150); /* one arrow: those to the page are left out */
  for (int k = CELD_SUGGEST_FILL_GAPS; k <= CELD_SUGGEST_ALL; k++)
    {
      settings.suggest = (CeldSuggest) k;
      CHECK (celd_session_set_settings (s, &settings) == CELD_OK);
      CHECK (celd_session_set_relations (s, "", NULL) == CELD_OK);
      CHECK (celd_session_unexpanded_levels (s, NULL, &flat, NULL) == CELD_OK && celd_session_relations (s)->n == 3);
      CHECK (CELD_AT (&flat, 8, 8) < CELD_AT (&flat, 30, 17) && CELD_AT (&flat, 8, 8) > CELD_AT (&flat, 46, 2));
      CHECK (celd_session_set_relations (s, "#ff0000 > #0000ff @0.01", NULL) == CELD_OK);
      CHECK (celd_session_unexpanded_levels (s, NULL, &flat, NULL) == CELD_OK && celd_session_problems (s)->n == 0);
      CHECK (CELD_AT (&flat, 8, 8) > CELD_AT (&flat, 30, 17));
    }
  celd_session_free (s);
}

/* What a report says stays when pictures are dropped; nothing can be made until there is another drawing. */
static void
records_outlive_pictures (void)
{
  static float           luma[W * H];
  CeldDrawing            drawing = sheet (luma);
  CeldSession           *s = scene ();
  const CeldOrder       *order;
  const CeldRelations   *relations;
  const CeldProblems    *problems;
  CeldPlane              depth;
  CeldLabels             labels;
  size_t                 n;

  CHECK (celd_session_order (s, NULL, &order) == CELD_OK);
  CHECK (celd_session_depth (s, NULL, &depth, NULL) == CELD_OK);
  relations = celd_session_relations (s);
  problems  = celd_session_problems (s);
  n         = problems->n;
  celd_session_drop_pictures (s);
  CHECK (order->n == 2 && order->level[0] == 1 && order->level[1] == 0);
  CHECK (relations->n == 1 && problems->n == n && celd_session_palette (s)->n == 2);
  CHECK (celd_session_labels (s, NULL, &labels, NULL) != CELD_OK);
  CHECK (celd_session_depth (s, NULL, &depth, NULL) != CELD_OK);
  CHECK (celd_session_set_drawing (s, &drawing) == CELD_OK);
  CHECK (celd_session_labels (s, NULL, &labels, NULL) == CELD_OK);
  celd_session_free (s);
}

int
main (void)
{
  RUN (results_of_a_sheet_on_a_page);
  RUN (corrections_give_ink_to_their_region);
  RUN (edits_report_the_rectangle_that_changed);
  RUN (single_relations_add_to_the_text);
  RUN (anchors_keep_their_level);
  RUN (all_surfaces_end_at_gaps_that_hold);
  RUN (equal_input_invalidates_nothing);
  RUN (a_new_ink_threshold_changes_the_labels);
  RUN (suggestions_are_used_only_on_demand);
  RUN (a_cancelled_session_can_be_used);
  RUN (records_outlive_pictures);
  RUN (wrong_input_is_an_error);
  RUN (strokes_far_outside_change_nothing);
  RUN (a_drawing_of_another_size_makes_new_labels);
  return DONE;
}
