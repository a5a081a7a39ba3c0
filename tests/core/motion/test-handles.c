/* Handles as text and as paint.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"

#define SIDE 160

static void
text_is_read (void)
{
  CeldHandles h = { 0 };

  CHECK (celd_handles_parse ("\xef\xbb\xbf 120,80 -> 200, -60.5;300 ,400\n\n; 310,90->320,95 ^1\r\n5,6 ^ -2.5;", &h,
                             NULL) == CELD_OK);
  CHECK (h.n == 4);
  NEAR (h.item[0].x, 120, 0);
  NEAR (h.item[0].to_x, 200, 0);
  NEAR (h.item[0].to_y, -60.5, 0);
  NEAR (h.item[1].to_x, 300, 0);
  NEAR (h.item[1].to_y, 400, 0);
  NEAR (h.item[2].depth, 1, 0);
  NEAR (h.item[3].depth, -2.5, 0);
  NEAR (h.item[3].to_y, 6, 0);
  celd_handles_clear (&h);
  CHECK (celd_handles_parse (" \n;", &h, NULL) == CELD_OK && h.n == 0);
}

static void
wrong_text_says_where (void)
{
  static const struct { const char *text; int line, column; } wrong[] = {
    { "x", 1, 1 },           { "1 2", 1, 3 },       { "1,", 1, 3 },           { "1,2 -", 1, 6 },
    { "1,2 -> ", 1, 8 },     { "1,2 > 3,4", 1, 5 }, { "1,2\n3,4 -> 5", 2, 9 }, { "1,2 ^", 1, 6 },
    { "1,2 ^x", 1, 6 },      { "1,2 3,4", 1, 5 },   { "nan,2", 1, 1 },        { "1,2;\r\n\r\n9e9,1", 3, 2 },
    { "9999999999,1", 1, 1 },
  };
  CeldHandles h = { 0 };

  CHECK (celd_handles_parse ("7,8", &h, NULL) == CELD_OK && h.n == 1);
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
    {
      CeldTextError error = { 0 };

      CHECK (celd_handles_parse (wrong[i].text, &h, &error) == CELD_BAD_RELATION);
      if (error.line != wrong[i].line || error.column != wrong[i].column)
        fprintf (stderr, "%s: line %d, column %d\n", wrong[i].text, error.line, error.column);
      CHECK (error.line == wrong[i].line && error.column == wrong[i].column);
      CHECK (h.n == 1);
    }
  celd_handles_clear (&h);
}

/* A dot and an arrow from (30,120) to (120,40), on a transparent layer or on white paper. */
static void
paint_is_read (void)
{
  static uint8_t data[4 * SIDE * SIDE];
  CeldPaint      paint = { SIDE, SIDE, SIDE, data };

  for (int opaque = 0; opaque < 2; opaque++)
    {
      CeldRelation  arrow = { .nearer = { .x = 30, .y = 120 }, .farther = { .x = 120, .y = 40 }, .weight = 1, .gap = 1 };
      CeldRelations one = { &arrow, 1 };
      CeldHandles   h = { 0 };
      CeldProblems  problems = { 0 };

      memset (data, opaque ? 255 : 0, sizeof data);
      CHECK (celd_relations_paint (&one, 4, &paint) == CELD_OK);
      for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
          if (hypot (x + 0.5 - 25, y + 0.5 - 30) < 6)
            memcpy (data + 4 * (y * SIDE + x), (uint8_t[4]) { 0, 0, 0, 255 }, 4);
      CHECK (celd_handles_read (&paint, celd_settings ().arrow_style, NULL, &h, &problems) == CELD_OK);
      CHECK (h.n == 2 && !problems.n);
      for (size_t i = 0; h.n == 2 && i < 2; i++)
        {
          bool pin = h.item[i].x == h.item[i].to_x;

          NEAR (h.item[i].x, pin ? 25 : 30, 5);
          NEAR (h.item[i].y, pin ? 30 : 120, 5);
          NEAR (h.item[i].to_x, pin ? 25 : 120, 5);
          NEAR (h.item[i].to_y, pin ? 30 : 40, 5);
        }
      celd_handles_clear (&h);
      celd_problems_clear (&problems);
    }
}

static void
blank_paint_has_no_handles (void)
{
  static uint8_t data[4 * SIDE * SIDE];
  CeldPaint      paint = { SIDE, SIDE, SIDE, data }, none = { 0 };
  CeldHandles    h = { 0 };

  CHECK (celd_handles_read (&paint, celd_settings ().arrow_style, NULL, &h, NULL) == CELD_OK && h.n == 0);
  CHECK (celd_handles_read (&none, celd_settings ().arrow_style, NULL, &h, NULL) == CELD_BAD_SIZE);
  celd_handles_clear (&h);
}

/* A handle and a pin in three keys, the last of which follows at once: where they are in frames between. */
static void
handles_go_gently_from_key_to_key (void)
{
  CeldHandle    item[3][2] = { { { 10, 20, 10, 20, 0 }, { 1, 2, 1, 2, 0 } },
                               { { 10, 20, 50, 100, 2 }, { 1, 2, 1, 2, 0 } },
                               { { 10, 20, 0, 0, -1 }, { 1, 2, 1, 2, 0 } } };
  CeldHandleKey key[3] = { { 4, { item[0], 2 } }, { 8, { item[1], 2 } }, { 9, { item[2], 2 } } };
  CeldHandles   h = { 0 };
  struct { int frame; double x, y, depth; } expected[] = {
    { 0, 10, 20, 0 }, { 4, 10, 20, 0 }, { 5, 16.25, 32.5, 0.3125 }, { 6, 30, 60, 1 }, { 7, 43.75, 87.5, 1.6875 },
    { 8, 50, 100, 2 }, { 9, 0, 0, -1 }, { 99, 0, 0, -1 },
  };

  for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) /* those of one frame are replaced by the next one's */
    {
      CHECK (celd_handles_between (key, 3, expected[i].frame, &h) == CELD_OK && h.n == 2);
      NEAR (h.item[0].x, 10, 0);
      NEAR (h.item[0].y, 20, 0);
      NEAR (h.item[0].to_x, expected[i].x, 0);
      NEAR (h.item[0].to_y, expected[i].y, 0);
      NEAR (h.item[0].depth, expected[i].depth, 0);
      CHECK (!memcmp (&h.item[1], &item[0][1], sizeof (CeldHandle)));
    }
  celd_handles_clear (&h);
}

static void
keys_that_do_not_fit_are_refused (void)
{
  CeldHandle    item[2] = { { 10, 20, 10, 20, 0 }, { 1, 2, 1, 2, 0 } };
  CeldHandleKey key[2] = { { 0, { item, 2 } }, { 4, { item, 1 } } };
  CeldHandles   h = { 0 };

  CHECK (celd_handles_between (key, 0, 0, &h) == CELD_BAD_VALUE && !h.item);
  CHECK (celd_handles_between (key, 2, 1, &h) == CELD_BAD_VALUE && !h.item);
  key[0].handles.n = key[1].handles.n = 0;
  CHECK (celd_handles_between (key, 2, 1, &h) == CELD_OK && h.n == 0);
  celd_handles_clear (&h);
}

int
main (void)
{
  RUN (text_is_read);
  RUN (wrong_text_says_where);
  RUN (paint_is_read);
  RUN (blank_paint_has_no_handles);
  RUN (handles_go_gently_from_key_to_key);
  RUN (keys_that_do_not_fit_are_refused);
  return DONE;
}
