/* Drawings exchanged with their scribbles, and copies of them given as scribbles.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "celdepth.h"

#include <string.h>

enum { SIDE = 120 };

static uint8_t drawn[4 * SIDE * SIDE], strokes[4 * SIDE * SIDE];

static CeldPaint
page (uint8_t *rgba)
{
  return (CeldPaint) { SIDE, SIDE, SIDE, rgba };
}

static void
put (uint8_t *rgba, int x, int y, const uint8_t colour[4])
{
  memcpy (rgba + 4 * (y * SIDE + x), colour, 4);
}

static const uint8_t black[4] = { 20, 15, 10, 255 }, white[4] = { 255, 255, 255, 255 }, nothing[4] = { 0 },
                     red[4] = { 230, 30, 30, 255 }, dark_red[4] = { 120, 20, 20, 255 },
                     blue[4] = { 30, 60, 220, 255 }, green[4] = { 40, 120, 60, 255 },
                     chalk[4] = { 245, 255, 245, 255 }, yellow[4] = { 250, 240, 120, 255 },
                     pink[4] = { 250, 180, 190, 255 };

/* Lines of two pixels part the page into nine rooms, with these two colours by turns. */
static void
draw_rooms (uint8_t *rgba, const uint8_t line[4], const uint8_t first[4], const uint8_t second[4])
{
  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      put (rgba, x, y, (x + 1) % 40 < 2 || (y + 1) % 40 < 2 ? line : (x / 40 + y / 40) % 2 ? first : second);
}

/* A stroke in the middle of each room. */
static void
draw_strokes (uint8_t *rgba, const uint8_t paper[4], const uint8_t first[4], const uint8_t second[4])
{
  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      put (rgba, x, y, x % 40 < 10 || x % 40 > 30 || y % 40 < 16 || y % 40 > 22 ? paper
                       : (x / 40 + y / 40) % 2 ? first : second);
}

static CeldMixUp
mix_up (uint8_t *drawing, uint8_t *scribbles)
{
  CeldPaint a = page (drawing), b = page (scribbles);
  CeldMixUp found = CELD_LAYERS_APART;
  bool      may_be = false;

  CHECK (celd_may_be_drawing (&b, &may_be) == CELD_OK);
  if (may_be)
    CHECK (celd_mix_up (&a, &b, &found) == CELD_OK);
  return found;
}

/* Whether drawing and scribbles are told apart, and noticed when they are exchanged. */
static bool
are_told (void)
{
  return mix_up (drawn, strokes) == CELD_LAYERS_APART && mix_up (strokes, drawn) == CELD_LAYERS_EXCHANGED;
}

static void
exchanged_layers_are_noticed (void)
{
  draw_rooms (drawn, black, yellow, pink);
  draw_strokes (strokes, nothing, red, blue);
  CHECK (are_told ());
  draw_strokes (strokes, white, red, red);
  CHECK (are_told ());
  draw_rooms (strokes, red, red, blue); /* fills without lines of their own */
  CHECK (are_told ());
  draw_rooms (drawn, chalk, green, green);
  draw_strokes (strokes, black, red, yellow);
  CHECK (are_told ());
  draw_rooms (drawn, black, white, white);
  draw_strokes (strokes, nothing, red, blue);
  CHECK (are_told ());
}

/* Loops of dark strokes are no drawing where the other layer is one, be it grey or drawn with a red pencil. */
static void
drawings_are_no_scribbles (void)
{
  draw_rooms (strokes, black, yellow, pink);
  draw_rooms (drawn, red, white, yellow);
  CHECK (mix_up (drawn, strokes) == CELD_LAYERS_APART);
  draw_strokes (drawn, white, black, black);
  CHECK (mix_up (drawn, strokes) == CELD_LAYERS_APART);
  draw_strokes (strokes, nothing, black, black); /* scribbles in grey, and a drawing in clear colours */
  draw_rooms (drawn, red, white, white);
  CHECK (mix_up (drawn, strokes) == CELD_LAYERS_APART);
  draw_rooms (strokes, white, black, black); /* fills with gaps between */
  CHECK (mix_up (drawn, strokes) == CELD_LAYERS_APART);
  draw_strokes (strokes, nothing, black, black);
  draw_rooms (drawn, dark_red, white, white);
  for (int y = 90; y < 100; y++)
    for (int x = 90; x < 110; x++)
      put (drawn, x, y, blue);
  CHECK (mix_up (drawn, strokes) == CELD_LAYERS_APART);
}

/* Such as that of the next frame. */
static void
other_drawings_are_noticed (void)
{
  draw_rooms (strokes, black, white, nothing);
  draw_strokes (drawn, white, black, black);
  CHECK (mix_up (drawn, strokes) == CELD_LAYERS_DRAWN);
  draw_rooms (drawn, black, yellow, pink);
  put (drawn, 60, 60, blue);
  for (int y = 0; y < SIDE; y++)
    for (int x = 70; x < 90; x++)
      put (drawn, x, y, white);
  CHECK (mix_up (drawn, strokes) == CELD_LAYERS_DRAWN);
  for (int y = 70; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      put (strokes, x, y, white);
  CHECK (mix_up (drawn, strokes) == CELD_LAYERS_APART); /* three rooms, and the rest of the page */
}

/* Also one that was stored with loss; not one with strokes on it. */
static void
copies_are_noticed (void)
{
  draw_rooms (drawn, black, yellow, pink);
  for (int i = 0; i < 4 * SIDE * SIDE; i++)
    strokes[i] = (uint8_t) (i % 4 < 3 ? drawn[i] + (drawn[i] < 128 ? i % 30 : -i % 30) : 255);
  CHECK (mix_up (drawn, drawn) == CELD_LAYERS_SAME);
  CHECK (mix_up (drawn, strokes) == CELD_LAYERS_SAME);
  for (int x = 50; x < 70; x++)
    put (strokes, x, 60, red);
  CHECK (mix_up (drawn, strokes) == CELD_LAYERS_APART);
}

/* What is white in both, or nearly so, is no copy. */
static void
blank_pages_are_no_copies (void)
{
  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      {
        put (drawn, x, y, white);
        put (strokes, x, y, white);
      }
  CHECK (mix_up (drawn, strokes) == CELD_LAYERS_APART);
  for (int x = 20; x < 30; x++)
    put (drawn, x, 20, black);
  CHECK (mix_up (drawn, strokes) == CELD_LAYERS_APART);
  CHECK (mix_up (drawn, drawn) == CELD_LAYERS_SAME);
}

static bool
is_flattened (void)
{
  CeldPaint a = page (drawn), b = page (strokes);
  bool      flattened = false;

  CHECK (celd_is_flattened (&a, &b, &flattened) == CELD_OK);
  return flattened;
}

/* Strokes on white paper in place of a drawing, also soft ones; not strokes elsewhere, and no fills. */
static void
flattened_strokes_are_noticed (void)
{
  const uint8_t soft[4] = { 230, 30, 30, 100 }, tint[4] = { 245, 167, 167, 255 };

  draw_strokes (drawn, white, red, blue);
  draw_strokes (strokes, nothing, red, blue);
  CHECK (is_flattened ());
  put (drawn, 2, 2, black);
  CHECK (is_flattened ());
  draw_strokes (drawn, white, tint, blue);
  draw_strokes (strokes, nothing, soft, blue);
  CHECK (is_flattened ());
  draw_strokes (strokes, nothing, nothing, blue);
  CHECK (!is_flattened ());
  draw_strokes (strokes, nothing, nothing, nothing);
  CHECK (!is_flattened ());
  draw_strokes (drawn, white, white, white);
  CHECK (!is_flattened ());
  draw_rooms (drawn, red, red, blue);
  draw_rooms (strokes, red, red, blue);
  CHECK (!is_flattened ());
  draw_rooms (drawn, blue, white, white);
  draw_strokes (strokes, nothing, red, red);
  CHECK (!is_flattened ());
}

/* Strokes of another size, and pages so small that a line of text on them has rooms. */
static void
pages_of_any_size (void)
{
  CeldPaint a = page (drawn), b = page (strokes);
  CeldMixUp found;
  bool      may_be;

  draw_rooms (drawn, black, yellow, pink);
  draw_rooms (strokes, black, yellow, pink);
  a.width = 100;
  CHECK (celd_mix_up (&a, &b, &found) == CELD_OK && found == CELD_LAYERS_APART);
  b.width = 63;
  CHECK (celd_may_be_drawing (&b, &may_be) == CELD_OK && !may_be);
  b.width = 64;
  CHECK (celd_may_be_drawing (&b, &may_be) == CELD_OK && may_be);
}

/* What a layer has of the lines of a drawing. */
static CeldLayerLines
lines_of (uint8_t *layer)
{
  static float   ink[SIDE * SIDE];
  CeldPaint      paint = page (layer);
  CeldPlane      plane = { SIDE, SIDE, SIDE, ink };
  CeldLayerLines lines = CELD_LAYER_WITHOUT_LINES;

  for (int i = 0; i < SIDE * SIDE; i++)
    ink[i] = (i % SIDE + 1) % 40 < 2 || (i / SIDE + 1) % 40 < 2 ? 0 : 1;
  CHECK (celd_layer_lines (&paint, &plane, &lines) == CELD_OK);
  return lines;
}

static void
layers_with_lines_are_noticed (void)
{
  draw_rooms (drawn, black, white, white);
  CHECK (lines_of (drawn) == CELD_LAYER_OF_LINES);
  for (int i = 0; i < 4; i++)
    drawn[i] = red[i]; /* one pixel in a clear colour is seen */
  CHECK (lines_of (drawn) == CELD_LAYER_COLOURED);
  draw_rooms (drawn, black, yellow, pink);
  CHECK (lines_of (drawn) == CELD_LAYER_COLOURED);
  draw_rooms (drawn, red, white, white); /* contours may be traced */
  CHECK (lines_of (drawn) == CELD_LAYER_WITHOUT_LINES);
  draw_rooms (drawn, red, nothing, nothing);
  CHECK (lines_of (drawn) == CELD_LAYER_WITHOUT_LINES);
  draw_rooms (drawn, blue, blue, green); /* fills */
  CHECK (lines_of (drawn) == CELD_LAYER_WITHOUT_LINES);
  draw_strokes (drawn, nothing, black, dark_red);
  CHECK (lines_of (drawn) == CELD_LAYER_WITHOUT_LINES);
  draw_strokes (drawn, white, black, black);
  CHECK (lines_of (drawn) == CELD_LAYER_WITHOUT_LINES);
}

int
main (void)
{
  RUN (exchanged_layers_are_noticed);
  RUN (drawings_are_no_scribbles);
  RUN (other_drawings_are_noticed);
  RUN (copies_are_noticed);
  RUN (blank_pages_are_no_copies);
  RUN (flattened_strokes_are_noticed);
  RUN (pages_of_any_size);
  RUN (layers_with_lines_are_noticed);
  return DONE;
}
