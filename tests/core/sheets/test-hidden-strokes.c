/* The artist says what is hidden: strokes add to sheets, an eraser takes away from them, and none of it is visible.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "layer-scene.h"
#include "sheets/sheets.h"

enum { WIDTH = 200, HEIGHT = 160, PAGE = 1, BODY = 2, BOARD = 3, LABELS = 3 };

static const float black[3] = { 0, 0, 0 };
static double      scale = 1;   /* of all shapes: in large pictures a cell is several pixels */

/* ------------------------------------------------------------------ pictures */

static double
box (double x, double y, double left, double top, double right, double bottom)
{
  x /= scale;
  y /= scale;
  return fmin (fmax (scale * fmin (fmin (x - left, right - x), fmin (y - top, bottom - y)) + 0.5, 0), 1);
}

/* A board in front of a low body, so that nothing of the body is guessed to be high up behind the board. */
static double body (double x, double y) { return box (x, y, 60, 110, 140, 150); }
static double board (double x, double y) { return box (x, y, 40, 20, 160, 120); }

static LayerScene
board_and_body (void)
{
  LayerScene s = layer_scene ((int) (scale * WIDTH), (int) (scale * HEIGHT));

  layer_scene_paint (&s, BODY, black, body, NULL);
  layer_scene_paint (&s, BOARD, black, board, NULL);
  return s;
}

static CeldLabels
no_hints (const LayerScene *s)
{
  CeldLabels hints;

  CHECK (celd_labels_new (s->width, s->height, &hints) == CELD_OK);
  memset (hints.data, 0, (size_t) s->width * (size_t) s->height * sizeof *hints.data);
  return hints;
}

static void
stroke (CeldLabels *hints, uint32_t label, double left, double top, double right, double bottom)
{
  for (int y = 0; y < hints->height; y++)
    for (int x = 0; x < hints->width; x++)
      if (box (x + 0.5, y + 0.5, left, top, right, bottom) >= 0.5)
        CELD_AT (hints, x, y) = label;
}

static CeldSheets *
sheets_of (const LayerScene *s, const CeldLabels *hints)
{
  CeldOrder    order = { .level = (uint32_t *) s->level, .n = LABELS };
  CeldSettings settings = celd_settings ();
  CeldSheets  *sheets = NULL;

  CHECK (celd_sheets (&s->ink, &s->own, hints, &order, PAGE, &settings, NULL, &sheets) == CELD_OK);
  return sheets;
}

/* Coverage of the whole picture by the sheet of a label. */
static float *
cover_of (const LayerScene *s, const CeldSheets *sheets, uint32_t label)
{
  float *cover = malloc ((size_t) s->width * (size_t) s->height * sizeof *cover);

  celd_sheet_coverage (sheets, &s->own, sheets->of_label[label - 1], (CeldRect) { 0, 0, s->width, s->height }, cover);
  return cover;
}

/* The mean coverage within a box. */
static double
mean (const LayerScene *s, const float *cover, double left, double top, double right, double bottom)
{
  double sum = 0, n = 0;

  for (int y = 0; y < s->height; y++)
    for (int x = 0; x < s->width; x++)
      if (box (x + 0.5, y + 0.5, left, top, right, bottom) >= 0.5)
        {
          sum += (double) cover[y * s->width + x];
          n++;
        }
  return sum / n;
}

/* Whether a sheet has a pixel in its list, be it of its margin. */
static bool
has_pixel (const CeldSheet *sheet, int x, int y)
{
  for (size_t i = 0; i < sheet->n_runs; i++)
    if (sheet->run[i].y == y && x >= sheet->run[i].x && x < sheet->run[i].x + sheet->run[i].n)
      return true;
  return false;
}

/* ------------------------------------------------------------------ tests */

/* A finger up behind the board, 8 wide, where nothing was: all of the stroke is covered, and less than a few cells
 * beside it. */
static void
a_stroke_adds_a_finger (void)
{
  for (scale = 1; scale < 6; scale += 4)
    {
      LayerScene  s = board_and_body ();
      CeldLabels  hints = no_hints (&s);
      CeldSheets *before = sheets_of (&s, &hints), *after;
      float      *cover = cover_of (&s, before, BODY);

      CHECK (mean (&s, cover, 96, 40, 104, 70) < 0.01);
      free (cover);
      stroke (&hints, BODY, 96, 40, 104, 130);
      after = sheets_of (&s, &hints);
      cover = cover_of (&s, after, BODY);
      CHECK (mean (&s, cover, 96, 40, 104, 110) >= 1);
      CHECK (mean (&s, cover, 44, 24, 92, 80) < 0.01);
      CHECK (mean (&s, cover, 108, 24, 156, 80) < 0.01);
      CHECK (mean (&s, cover, 92, 24, 108, 36) < 0.01);
      free (cover);
      celd_sheets_free (before);
      celd_sheets_free (after);
      free (hints.data);
      layer_scene_close (&s);
    }
}

/* Also one pixel wide, in the cells of a large picture, and far from what is visible of the region. */
static void
a_thin_stroke_is_not_lost (void)
{
  LayerScene  s;
  CeldLabels  hints;
  CeldSheets *sheets;
  float      *cover;

  scale = 5;
  s     = board_and_body ();
  hints = no_hints (&s);
  for (int x = 300; x < 700; x++)
    CELD_AT (&hints, x, 161) = BODY;
  sheets = sheets_of (&s, &hints);
  cover  = cover_of (&s, sheets, BODY);
  for (int x = 300; x < 700; x++)
    CHECK (cover[161 * s.width + x] >= 1);
  CHECK (mean (&s, cover, 44, 35, 156, 60) < 0.01);
  free (cover);
  celd_sheets_free (sheets);
  free (hints.data);
  layer_scene_close (&s);
}

/* Where the body goes on behind the board, also in its margin. */
static void
an_eraser_takes_away (void)
{
  for (scale = 1; scale < 6; scale += 4)
    {
      LayerScene  s = board_and_body ();
      CeldLabels  hints = no_hints (&s);
      CeldSheets *before = sheets_of (&s, &hints), *after;
      float      *cover = cover_of (&s, before, BODY);

      CHECK (mean (&s, cover, 90, 112, 110, 118) > 0.9);
      free (cover);
      stroke (&hints, CELD_HIDDEN_ERASE, 90, 100, 110, 125);
      after = sheets_of (&s, &hints);
      cover = cover_of (&s, after, BODY);
      CHECK (mean (&s, cover, 90, 100, 110, 119) <= 0);
      CHECK (mean (&s, cover, 91, 122, 109, 149) >= 1);
      CHECK (has_pixel (&before->item[before->of_label[BODY - 1]], (int) (100 * scale), (int) (115 * scale)));
      CHECK (!has_pixel (&after->item[after->of_label[BODY - 1]], (int) (100 * scale), (int) (115 * scale)));
      free (cover);
      celd_sheets_free (before);
      celd_sheets_free (after);
      free (hints.data);
      layer_scene_close (&s);
    }
}

/* Strokes over all of the picture, in any colour: what is seen stays as it is, and only nearer sheets lie over hidden
 * pixels. */
static void
strokes_are_never_visible (void)
{
  uint32_t state = 5;

  scale = 1;
  for (int round = 0; round < 20; round++)
    {
      LayerScene  s = board_and_body ();
      CeldLabels  hints = no_hints (&s);
      CeldSheets *sheets;

      for (int i = 0; i < 6; i++)
        {
          double   x = check_random (&state, WIDTH), y = check_random (&state, HEIGHT);
          uint32_t label = check_random (&state, LABELS + 1);

          stroke (&hints, label ? label : CELD_HIDDEN_ERASE, x, y, x + check_random (&state, 90),
                  y + check_random (&state, 90));
        }
      sheets = sheets_of (&s, &hints);
      for (size_t k = 0; k < sheets->n; k++)
        for (size_t i = 0; i < sheets->item[k].n_runs; i++)
          for (int x = sheets->item[k].run[i].x; x < sheets->item[k].run[i].x + sheets->item[k].run[i].n; x++)
            {
              int y = sheets->item[k].run[i].y;

              CHECK (sheets->of_label[CELD_AT (&s.own.owner, x, y) - 1] > k);
              CHECK (CELD_AT (&s.own.coverage, x, y) >= 1 || sheets->of_label[CELD_AT (&s.own.under, x, y) - 1] > k);
              CHECK (CELD_AT (&hints, x, y) != CELD_HIDDEN_ERASE);
            }
      for (uint32_t label = 2; label <= LABELS; label++)
        {
          float *cover = cover_of (&s, sheets, label);

          for (int y = 0; y < s.height; y++)
            for (int x = 0; x < s.width; x++)
              if (CELD_AT (&hints, x, y) == label && sheets->of_label[CELD_AT (&s.own.owner, x, y) - 1] >
                  sheets->of_label[label - 1] && CELD_AT (&s.own.coverage, x, y) >= 1)
                CHECK (cover[y * s.width + x] >= 1);
          free (cover);
        }
      celd_sheets_free (sheets);
      free (hints.data);
      layer_scene_close (&s);
    }
}

static void
bad_hints_are_refused (void)
{
  LayerScene   s;
  CeldLabels   hints;
  CeldOrder    order = { .n = LABELS };
  CeldSettings settings = celd_settings ();
  CeldSheets  *sheets = NULL;

  scale = 1;
  s     = board_and_body ();
  hints = no_hints (&s);
  order.level = (uint32_t *) s.level;
  hints.data[7] = LABELS + 1;
  CHECK (celd_sheets (&s.ink, &s.own, &hints, &order, PAGE, &settings, NULL, &sheets) == CELD_BAD_VALUE);
  hints.data[7] = 0;
  hints.width--;
  CHECK (celd_sheets (&s.ink, &s.own, &hints, &order, PAGE, &settings, NULL, &sheets) == CELD_BAD_SIZE);
  CHECK (!sheets);
  free (hints.data);
  layer_scene_close (&s);
}

/* Colours of regions are their labels, black is the eraser even if a region is black, all others mean nothing: also
 * white, the paper of a layer without alpha. */
static void
colours_are_read (void)
{
  CeldRegion  region[2] = { { .colour = { 0, 0, 0, 255 } }, { .colour = { 90, 8, 7, 255 } } };
  CeldPalette palette = { region, 2 };
  uint8_t     paint[5][4] = { { 0, 0, 0, 255 }, { 90, 8, 7, 128 }, { 90, 8, 7, 127 }, { 255, 255, 255, 255 }, { 0 } };
  uint32_t    label[5];
  CeldPaint   layer = { 5, 1, 5, paint[0] };
  CeldLabels  labels = { 5, 1, 5, label }, small = { 4, 1, 4, label };

  CHECK (celd_hidden_read (&layer, &palette, &labels) == CELD_OK);
  CHECK (label[0] == CELD_HIDDEN_ERASE && label[1] == 2 && !label[2] && !label[3] && !label[4]);
  CHECK (celd_hidden_read (&layer, &palette, &small) == CELD_BAD_SIZE);
  CHECK (celd_corrections_read (&layer, &palette, &labels) == CELD_OK && label[0] == 1);
}

int
main (void)
{
  RUN (a_stroke_adds_a_finger);
  RUN (a_thin_stroke_is_not_lost);
  RUN (an_eraser_takes_away);
  RUN (strokes_are_never_visible);
  RUN (bad_hints_are_refused);
  RUN (colours_are_read);
  return DONE;
}
