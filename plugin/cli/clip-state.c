/* What is kept of a frame on the disk, so that an interrupted run goes on where it ended.
 *
 * The state of a frame, a small JSON file, is written last.  It has a fingerprint of everything that the frame was made
 * from, up to its key; as long as that is right the frame is not made again.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "json.h"
#include "propagate.h"

#include <string.h>

/* ------------------------------------------------------------------ files */

char *
cli_frame_path (const CliMotion *motion, const char *result, size_t frame, const CliKey *side)
{
  bool  is_depth = !strcmp (result, "depth"), is_state = !strcmp (result, "state");
  char *from = side ? g_strdup_printf ("_from_%03d", motion->frames.frame[side->frame].number) : g_strdup ("");
  char *name = g_strdup_printf ("%s%s_%03d%s.%s", side || is_state ? "." : "", result,
                                motion->frames.frame[frame].number, from,
                                is_state ? "json" : is_depth || !strcmp (result, "levels") ? "exr" : "png");
  char *path = g_build_filename (is_depth ? motion->options->depth_dir : motion->options->labels_dir, name, NULL);

  g_free (from);
  g_free (name);
  return path;
}

/* The results of a frame, or of a side of it; the state is the last.  With a NULL behind them. */
static const char *const *
results_of (const CliMotion *motion, const CliKey *side)
{
  static const char *const of_side[] = { "labels", "certainty", "state", NULL };
  static const char *const of_frame[] = { "labels", "levels", "state", NULL };
  static const char *const with_depth[] = { "labels", "levels", "depth", "state", NULL };

  return side ? of_side : motion->options->depth_dir ? with_depth : of_frame;
}

void
cli_frame_remove_unfinished (const CliMotion *motion, size_t frame, const CliKey *side)
{
  for (const char *const *result = results_of (motion, side); *result; result++)
    {
      char *path = cli_frame_path (motion, *result, frame, side);

      cli_remove_unfinished (path);
      g_free (path);
    }
}

bool
cli_frame_touches (const CliMotion *motion, size_t frame, CliTouched *touched)
{
  bool good = true;

  for (const char *const *result = results_of (motion, NULL); *result && good; result++)
    {
      char *path = cli_frame_path (motion, *result, frame, NULL);

      good = cli_touched_writes (touched, strcmp (*result, "depth") ? "labels-dir" : "depth-dir", path);
      g_free (path);
    }
  return good;
}

bool
cli_frame_is_complete (const CliMotion *motion, size_t frame, const CliKey *side)
{
  bool complete = true;

  for (const char *const *result = results_of (motion, side); *result && complete; result++)
    {
      char *path = cli_frame_path (motion, *result, frame, side);

      complete = g_file_test (path, G_FILE_TEST_IS_REGULAR);
      g_free (path);
    }
  return complete;
}

/* ------------------------------------------------------------------ the state */

static const char *const changes[] = { "unsure", "gone", "new" };

bool
cli_frame_write_state (const CliMotion *motion, const CliFrameState *state)
{
  char        *path = cli_frame_path (motion, "state", state->frame, state->side);
  JsonBuilder *json = json_builder_new ();
  bool         good;

  json_builder_begin_object (json);
  json_builder_set_member_name (json, "fingerprint");
  json_builder_add_string_value (json, state->fingerprint);
  json_builder_set_member_name (json, "certainty");
  json_builder_add_double_value (json, state->certainty);
  json_builder_set_member_name (json, "notes");
  json_builder_begin_array (json);
  for (guint i = 0; i < state->notes->len; i++)
    {
      const CeldRegionNote *note = &g_array_index (state->notes, CeldRegionNote, i);

      json_builder_begin_array (json);
      json_builder_add_int_value (json, note->label);
      json_builder_add_string_value (json, changes[note->change]);
      json_builder_add_double_value (json, note->certainty);
      json_builder_add_int_value (json, note->x);
      json_builder_add_int_value (json, note->y);
      json_builder_end_array (json);
    }
  json_builder_end_array (json);
  if (state->sure)
    {
      json_builder_set_member_name (json, "sure");
      json_builder_begin_array (json);
      for (size_t l = 1; l <= motion->palette.n; l++)
        json_builder_add_double_value (json, state->sure[l]);
      json_builder_end_array (json);
    }
  json_builder_end_object (json);
  good = cli_write_json (path, json);
  g_free (path);
  return good;
}

/* Reads one note; one that is damaged is left out. */
static void
read_note (const CliMotion *motion, JsonNode *node, GArray *notes)
{
  JsonArray    *values = JSON_NODE_HOLDS_ARRAY (node) ? json_node_get_array (node) : NULL;
  CeldRegionNote note = { 0 };
  const char   *change;

  if (!values || json_array_get_length (values) != 5)
    return;
  for (guint k = 0; k < 5; k++)
    if (!JSON_NODE_HOLDS_VALUE (json_array_get_element (values, k)))
      return;
  change = json_array_get_string_element (values, 1);
  for (size_t c = 0; change && c < G_N_ELEMENTS (changes); c++)
    if (!strcmp (change, changes[c]))
      note.change = (CeldRegionChange) c;
  note.label     = (uint32_t) CLAMP (json_array_get_int_element (values, 0), 1, (gint64) motion->palette.n);
  note.certainty = json_array_get_double_element (values, 2);
  note.x         = (int) CLAMP (json_array_get_int_element (values, 3), -1, motion->width - 1);
  note.y         = (int) CLAMP (json_array_get_int_element (values, 4), -1, motion->height - 1);
  g_array_append_val (notes, note);
}

/* Reads how sure each label is; false if that was not found, or is damaged. */
static bool
read_sure (const CliMotion *motion, JsonNode *node, CliFrameState *state)
{
  JsonArray *values = node && JSON_NODE_HOLDS_ARRAY (node) ? json_node_get_array (node) : NULL;

  if (!values || json_array_get_length (values) != motion->palette.n)
    return false;
  state->sure = g_new0 (double, motion->palette.n + 1);
  for (guint l = 1; l <= motion->palette.n; l++)
    {
      if (!JSON_NODE_HOLDS_VALUE (json_array_get_element (values, l - 1)))
        return false;
      state->sure[l] = json_array_get_double_element (values, l - 1);
    }
  return true;
}

/* Reads what was written for this fingerprint; NULL: for any, which the state gets.  For a review, what was written
 * without is not enough. */
static bool
read_object (const CliMotion *motion, JsonObject *object, const char *fingerprint, CliFrameState *state)
{
  const char *found = json_object_get_string_member_with_default (object, "fingerprint", NULL);
  JsonNode   *notes = json_object_get_member (object, "notes");

  if (!found || (fingerprint && strcmp (found, fingerprint)) ||
      (motion->options->review && !read_sure (motion, json_object_get_member (object, "sure"), state)))
    return false;
  if (!fingerprint)
    state->fingerprint = g_strdup (found);
  state->certainty = json_object_get_double_member_with_default (object, "certainty", 0);
  if (notes && JSON_NODE_HOLDS_ARRAY (notes))
    for (guint i = 0; i < json_array_get_length (json_node_get_array (notes)); i++)
      read_note (motion, json_array_get_element (json_node_get_array (notes), i), state->notes);
  return true;
}

bool
cli_frame_read_state (const CliMotion *motion, size_t frame, const char *fingerprint, CliFrameState *state)
{
  char       *path = cli_frame_path (motion, "state", frame, state->side);
  JsonParser *parser = json_parser_new_immutable ();
  JsonNode   *root = cli_json_read (parser, path, true) ? json_parser_get_root (parser) : NULL;
  bool        good = root && JSON_NODE_HOLDS_OBJECT (root) &&
                     read_object (motion, json_node_get_object (root), fingerprint, state);

  g_object_unref (parser);
  g_free (path);
  return good;
}

/* ------------------------------------------------------------------ pictures */

bool
cli_frame_read_labels (const CliMotion *motion, size_t frame, const CliKey *side, CeldLabels *labels)
{
  char     *path = cli_frame_path (motion, "labels", frame, side);
  CliLayers layers = { .width = motion->width, .height = motion->height };
  CeldPaint paint = { 0 };
  bool      good = cli_layer_read (path, "labels", &layers, &paint) &&
                   cli_labels_new (paint.width, paint.height, labels) &&
                   cli_check (celd_corrections_read (&paint, &motion->palette, labels));

  for (size_t i = 0; good && i < (size_t) labels->width * (size_t) labels->height; i++)
    if (!labels->data[i])
      labels->data[i] = motion->background;
  g_free (paint.data);
  g_free (path);
  return good;
}

/* The certainty of pixels is grey, 0 black and 1 white. */
bool
cli_frame_write_certainty (const CliMotion *motion, const CliFrameState *state)
{
  char     *path = cli_frame_path (motion, "certainty", state->frame, state->side);
  size_t    n = (size_t) motion->width * (size_t) motion->height;
  CeldPaint paint = { motion->width, motion->height, (size_t) motion->width, g_try_new (uint8_t, 4 * n) };
  bool      good = cli_check (paint.data ? CELD_OK : CELD_NO_MEMORY);

  for (size_t i = 0; good && i < 4 * n; i++)
    paint.data[i] = i % 4 == 3 ? 255 : (uint8_t) (255 * state->pixel_certainty.data[i / 4] + 0.5f);
  good = good && cli_write_layer (path, &paint);
  g_free (paint.data);
  g_free (path);
  return good;
}

bool
cli_frame_read_certainty (const CliMotion *motion, size_t frame, const CliKey *side, CeldPlane *certainty)
{
  char     *path = cli_frame_path (motion, "certainty", frame, side);
  CliLayers layers = { .width = motion->width, .height = motion->height };
  CeldPaint paint = { 0 };
  bool      good = cli_layer_read (path, "certainty", &layers, &paint) &&
                   cli_plane_new (paint.width, paint.height, certainty);

  for (size_t i = 0; good && i < (size_t) paint.width * (size_t) paint.height; i++)
    certainty->data[i] = (float) paint.data[4 * i] / 255;
  g_free (paint.data);
  g_free (path);
  return good;
}
