/* The review of a clip: frames and regions that a person should look at, as JSON and as a picture.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "json.h"
#include "propagate.h"

#include <string.h>

#define THUMBNAIL 320 /* pixels of the longer side of a frame in the picture; chosen */
#define ACROSS    4   /* frames in a row; chosen */

/* ------------------------------------------------------------------ JSON */

static void
add_note (JsonBuilder *json, const CliMotion *motion, const CeldRegionNote *note)
{
  static const char *const changes[] = {
    [CELD_REGION_UNSURE] = "unsure", [CELD_REGION_GONE] = "gone", [CELD_REGION_NEW] = "new"
  };
  const uint8_t *colour = motion->palette.item[note->label - 1].colour;
  char          *text = g_strdup_printf ("#%02x%02x%02x", colour[0], colour[1], colour[2]);

  json_builder_begin_object (json);
  json_builder_set_member_name (json, "colour");
  if (colour[3])
    json_builder_add_string_value (json, text);
  else
    json_builder_add_null_value (json);
  json_builder_set_member_name (json, "background");
  json_builder_add_boolean_value (json, note->label == motion->background);
  json_builder_set_member_name (json, "change");
  json_builder_add_string_value (json, changes[note->change]);
  json_builder_set_member_name (json, "certainty");
  json_builder_add_double_value (json, note->certainty);
  json_builder_set_member_name (json, "at");
  json_builder_begin_array (json);
  json_builder_add_int_value (json, note->x);
  json_builder_add_int_value (json, note->y);
  json_builder_end_array (json);
  json_builder_end_object (json);
  g_free (text);
}

static bool
wants_review (const CliFrameState *state)
{
  return celd_wants_review ((const CeldRegionNote *) state->notes->data, state->notes->len, state->certainty);
}

static void
add_frame (JsonBuilder *json, const CliMotion *motion, const CliFrameState *state)
{
  json_builder_begin_object (json);
  json_builder_set_member_name (json, "frame");
  json_builder_add_int_value (json, motion->frames.frame[state->frame].number);
  json_builder_set_member_name (json, "certainty");
  json_builder_add_double_value (json, state->certainty);
  json_builder_set_member_name (json, "review");
  json_builder_add_boolean_value (json, wants_review (state));
  json_builder_set_member_name (json, "regions");
  json_builder_begin_array (json);
  for (guint i = 0; i < state->notes->len; i++)
    add_note (json, motion, &g_array_index (state->notes, CeldRegionNote, i));
  json_builder_end_array (json);
  json_builder_end_object (json);
}

/* The relations of each contradiction, the one that was left out first. */
static void
add_contradictions (JsonBuilder *json, const CliMotion *motion)
{
  json_builder_set_member_name (json, "contradictions");
  json_builder_begin_array (json);
  for (size_t i = 0; i < motion->order.n_cycles; i++)
    {
      const CeldCycle *cycle = &motion->order.cycle[i];

      json_builder_begin_array (json);
      for (size_t k = 0; k < cycle->n; k++)
        {
          char *text = cli_relation_text (&motion->list.item[cycle->item[k]], NULL);

          json_builder_add_string_value (json, text);
          g_free (text);
        }
      json_builder_end_array (json);
    }
  json_builder_end_array (json);
}

static bool
write_json (const char *path, const CliMotion *motion, const CliFrameState *state)
{
  JsonBuilder *json = json_builder_new ();

  json_builder_begin_object (json);
  json_builder_set_member_name (json, "frames");
  json_builder_begin_array (json);
  for (size_t i = 0; i < motion->frames.n; i++)
    add_frame (json, motion, &state[i]);
  json_builder_end_array (json);
  add_contradictions (json, motion);
  json_builder_end_object (json);
  return cli_write_json (path, json);
}

/* ------------------------------------------------------------------ the picture */

/* The regions of a frame in their colours, under its lines, with a ring round each noted place. */
static bool
paint_frame (const CliMotion *motion, const CliFrameState *state, CeldPaint *paint)
{
  CeldProblems problems = { .item = g_new0 (CeldProblem, state->notes->len + 1) };
  CliLayers    drawing = { .width = motion->width, .height = motion->height };
  CliLayers    labels = { .width = motion->width, .height = motion->height };
  CliOptions   none = { 0 };
  char        *path = cli_frame_path (motion, "labels", state->frame, NULL);
  bool         good = cli_layers_read (motion->frames.frame[state->frame].path, &none, 0, &drawing) &&
                      cli_layer_read (path, "labels", &labels, paint);

  for (size_t i = 0; good && i < (size_t) motion->width * (size_t) motion->height; i++)
    {
      float light = CLAMP (drawing.drawing.luma.data[i], 0, 1);

      for (size_t k = 0; k < 3; k++)
        {
          float colour = paint->data[4 * i + 3] ? 0.5f + 0.5f * (float) paint->data[4 * i + k] / 255 : 1;

          paint->data[4 * i + k] = (uint8_t) (255 * colour * light + 0.5f);
        }
      paint->data[4 * i + 3] = 255;
    }
  for (guint i = 0; i < state->notes->len; i++)
    {
      const CeldRegionNote *note = &g_array_index (state->notes, CeldRegionNote, i);

      if (note->x >= 0)
        problems.item[problems.n++] = (CeldProblem) { .x = note->x, .y = note->y };
    }
  if (good)
    celd_problems_paint (&problems, paint);
  g_free (problems.item);
  cli_layers_clear (&drawing);
  g_free (path);
  return good;
}

/* Puts a picture, made smaller by the mean of its pixels, at a place of the sheet. */
static void
put_small (const CeldPaint *paint, int shrink, int left, int top, CeldPaint *sheet)
{
  for (int y = 0; y < paint->height / shrink; y++)
    for (int x = 0; x < paint->width / shrink; x++)
      for (size_t k = 0; k < 3; k++)
        {
          int sum = 0;

          for (int v = 0; v < shrink; v++)
            for (int u = 0; u < shrink; u++)
              sum += paint->data[4 * ((size_t) (y * shrink + v) * paint->stride + (size_t) (x * shrink + u)) + k];
          sheet->data[4 * ((size_t) (top + y) * sheet->stride + (size_t) (left + x)) + k] =
            (uint8_t) (sum / (shrink * shrink));
        }
}

static bool
write_sheet (const char *path, const CliMotion *motion, const CliFrameState *state, size_t n)
{
  int       shrink = MAX (1, (MAX (motion->width, motion->height) + THUMBNAIL - 1) / THUMBNAIL);
  int       across = (int) MIN (n, ACROSS), down = (int) ((n + ACROSS - 1) / ACROSS);
  int       wide = motion->width / shrink + 4, high = motion->height / shrink + 4, at = 0;
  CeldPaint sheet = { across * wide, down * high, (size_t) (across * wide), NULL };
  gsize     bytes = 4 * (gsize) sheet.width * (gsize) sheet.height;
  bool      good = cli_check ((sheet.data = g_try_malloc (bytes)) ? CELD_OK : CELD_NO_MEMORY);

  if (good)
    memset (sheet.data, 255, bytes);
  for (size_t i = 0; i < motion->frames.n && good; i++)
    {
      CeldPaint paint = { 0 };

      if (!wants_review (&state[i]))
        continue;
      good = paint_frame (motion, &state[i], &paint);
      if (good)
        put_small (&paint, shrink, at % ACROSS * wide + 2, at / ACROSS * high + 2, &sheet);
      at++;
      g_free (paint.data);
    }
  good = good && cli_write_layer (path, &sheet);
  g_free (sheet.data);
  return good;
}

/* ------------------------------------------------------------------ */

char *
cli_review_sheet_name (const char *path)
{
  char *stem = g_str_has_suffix (path, ".json") ? g_strndup (path, strlen (path) - 5) : g_strdup (path);
  char *name = g_strconcat (stem, ".png", NULL);

  g_free (stem);
  return name;
}

static void
say (const CliMotion *motion, const CliFrameState *state, size_t n, const char *sheet)
{
  GString *numbers = g_string_new (NULL);

  for (size_t i = 0; i < motion->frames.n; i++)
    if (wants_review (&state[i]))
      g_string_append_printf (numbers, "%s%d", numbers->len ? ", " : "", motion->frames.frame[i].number);
  cli_say ("Look at %zu of %zu frames: %s. \"%s\" shows what is unsure. Where it is wrong, paint scribbles for that "
           "frame and add it as a --key.", n, motion->frames.n, numbers->str, sheet);
  g_string_free (numbers, TRUE);
}

bool
cli_review_write (const char *path, const CliMotion *motion)
{
  CliFrameState *state = g_new0 (CliFrameState, motion->frames.n);
  char          *sheet = cli_review_sheet_name (path);
  size_t         n = 0;
  bool           good;

  for (size_t i = 0; i < motion->frames.n; i++)
    {
      state[i] = (CliFrameState) { .frame = i, .notes = cli_notes_new () };
      cli_frame_read_state (motion, i, NULL, &state[i]);
      n += wants_review (&state[i]);
    }
  good = write_json (path, motion, state) && (!n || cli_is_device (path) || write_sheet (sheet, motion, state, n));
  if (good && n && !motion->options->quiet)
    say (motion, state, n, sheet);
  for (size_t i = 0; i < motion->frames.n; i++)
    cli_frame_clear (&state[i]);
  g_free (state);
  g_free (sheet);
  return good;
}
