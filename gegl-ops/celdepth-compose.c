/* celdepth:compose: a picture put between the levels of another one (section 5 of the paper, Figure 1c).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "properties.h"

static const CeldSettingChoice results[] = {
  [CELD_COMPOSED_ART]    = { "art", "Art" },
  [CELD_COMPOSED_LEVELS] = { "levels", "Levels" },
};

static const CeldSettingInfo result_row = {
  .name = "result", .label = "Result", CELD_OWN_CHOICE (result, CeldComposeResult, results),
  .help = "The picture, or its depth levels"
};

static const CeldSettingInfo x_row = {
  .name = "x", .label = "X", .type = CELD_SETTING_NUMBER, .offset = offsetof (CeldOwnValues, x),
  .least = -100000, .most = 100000, .shown = { -2000, 2000, 1, 100, .digits = 1 },
  .help = "Where the left side of the second picture comes, in pixels"
};

static const CeldSettingInfo y_row = {
  .name = "y", .label = "Y", .type = CELD_SETTING_NUMBER, .offset = offsetof (CeldOwnValues, y),
  .least = -100000, .most = 100000, .shown = { -2000, 2000, 1, 100, .digits = 1 },
  .help = "Where the upper side of the second picture comes, in pixels"
};

static const CeldSettingInfo scale_row = {
  .name = "scale", .label = "Scale", .type = CELD_SETTING_NUMBER, .offset = offsetof (CeldOwnValues, scale),
  .usual = 1, .least = CELD_LEAST_SCALE, .most = CELD_LARGEST_SCALE,
  .shown = { 0.1, 10, 0.01, 0.1, .gamma = 3, .digits = 3 }, .help = "By how much the second picture is enlarged"
};

static const CeldSettingInfo turn_row = {
  .name = "turn", .label = "Turn", .type = CELD_SETTING_NUMBER, .offset = offsetof (CeldOwnValues, turn),
  .least = -360, .most = 360, .shown = { -180, 180, 1, 15, .digits = 1 }, .unit = "degree", .axis = "cw",
  .help = "By how much the second picture is turned clockwise round its middle"
};

static const CeldSettingInfo flip_row = {
  .name = "flip", .label = "Flip", .type = CELD_SETTING_SWITCH, .most = 1, .offset = offsetof (CeldOwnValues, flip),
  .help = "Mirrors the second picture, left to right, before it is turned"
};

static const CeldSettingInfo between_row = {
  .name = "between", .label = "Behind levels above", .type = CELD_SETTING_NUMBER,
  .offset = offsetof (CeldOwnValues, between), .usual = 1, .most = 1, .shown = { 0, 1, 0.01, 0.1, .digits = 3 },
  .help = "The second picture lies behind the parts of the first one whose level is above this, and in front of all "
          "others"
};

static const CeldProperty properties[] = {
  { .own = &result_row }, { .own = &between_row }, { .own = &x_row }, { .own = &y_row }, { .own = &scale_row },
  { .own = &turn_row }, { .own = &flip_row }, { .name = "ink" },
  { 0 }
};

static const CeldPad pads[] = {
  { "input", "Art", "The first picture", TRUE },
  { "aux", "Levels", "The expanded depth levels of the first picture", TRUE },
  { "aux2", "Second art", "The picture to put between the levels of the first one", CELD_PAD_SAMPLE },
  { "aux3", "Second levels", "The expanded depth levels of the second picture, of which the farthest is left out as "
                             "its page. Without them all of it is one part", CELD_PAD_SAMPLE },
  { NULL, NULL, NULL, FALSE }
};

static void
prepare (GeglOperation *operation)
{
  gboolean art = celd_operation_own (operation)->result == CELD_COMPOSED_ART;

  gegl_operation_set_format (operation, "output", babl_format (art ? "RGBA float" : "Y float"));
}

/* ------------------------------------------------------------------ input */

typedef struct { CeldColours art; CeldPlane ink, levels; } Piece;

static gboolean
read_piece (CeldOp *op, const char *art, const char *levels, Piece *piece)
{
  if (!celd_op_read_colours (op, art, &piece->art) || !celd_op_read_ink_of_art (op, art, &piece->ink))
    return FALSE;
  if (celd_op_has_input (op, levels))
    return celd_op_read_plane (op, levels, &piece->levels);
  if (!celd_op_new_plane (op, &piece->levels))
    return FALSE;
  for (gsize p = 0; p < (gsize) piece->levels.width * (gsize) piece->levels.height; p++)
    piece->levels.data[p] = 0;
  return TRUE;
}

/* Whether the second levels have the rectangle of the second art. */
static gboolean
check_levels (CeldOp *op, const GeglRectangle *art)
{
  const GeglRectangle *r = gegl_operation_source_get_bounding_box (GEGL_OPERATION (op->operation), "aux3");

  return !celd_op_has_input (op, "aux3") || !r || gegl_rectangle_equal (r, art) ||
         celd_op_fail (op, _ ("'Second levels' (pad aux3, %d x %d pixels at %d, %d) must have the size and place of "
                              "'Second art' (%d x %d at %d, %d)."),
                       r->width, r->height, r->x, r->y, art->width, art->height, art->x, art->y);
}

/* The second picture has a rectangle of its own. */
static gboolean
read_second (CeldOp *op, Piece *piece)
{
  const GeglRectangle *r = gegl_operation_source_get_bounding_box (GEGL_OPERATION (op->operation), "aux2");
  GeglRectangle        whole = op->picture;
  gboolean             good;

  if (!celd_op_has_input (op, "aux2") || !r)
    return op->choosing ? FALSE : celd_op_fail (op, _ ("There is no picture for 'Second art' (pad aux2). Choose a "
                                                       "layer."));
  if (!check_levels (op, r))
    return FALSE;
  op->picture = *r;
  good        = read_piece (op, "aux2", "aux3", piece);
  op->picture = whole;
  return good;
}

/* ------------------------------------------------------------------ output */

static gboolean
write_result (CeldOp *op, const CeldLevelArt piece[2])
{
  const CeldOwnValues *own = &op->own;
  CeldPlacement        placement = { (double) own->x, (double) own->y, (double) own->scale, (double) own->turn,
                                     own->flip };
  CeldColours          picture;
  CeldPlane            levels;

  if (own->result == CELD_COMPOSED_LEVELS)
    return celd_op_new_plane (op, &levels) &&
           celd_op_try (op, celd_compose_levels (piece, &placement, own->between, &op->host, NULL, &levels)) &&
           celd_op_write (op, levels.data);
  return celd_op_new_colours (op, &picture) &&
         celd_op_try (op, celd_compose_levels (piece, &placement, own->between, &op->host, &picture, NULL)) &&
         celd_op_write (op, picture.data);
}

static gboolean
render (CeldOp *op)
{
  Piece        first, second;
  CeldLevelArt piece[2] = { { &first.art, &first.ink, &first.levels }, { &second.art, &second.ink, &second.levels } };

  return read_piece (op, "input", "aux", &first) &&
         read_second (op, &second) &&
         write_result (op, piece);
}

const CeldOperationInfo celd_compose_operation = {
  .name        = "celdepth:compose",
  .title       = "Compose",
  .categories  = "artistic",
  .description = "Puts a picture behind the near parts of another one and in front of its far parts",
  .reference   = CELD_REFERENCE,
  .pads        = pads,
  .properties  = properties,
  .prepare     = prepare,
  .render      = render,
};
