/* One frame of a clip: labels carried from the frame before, levels, depth; and what is kept of it on the disk, so that
 * an interrupted run goes on where it ended.
 *
 * The state of a frame, a small JSON file, is written last.  It has a fingerprint of everything that the frame was made
 * from, up to its key; as long as that is right the frame is not made again.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "json.h"
#include "propagate.h"

#include <math.h>
#include <string.h>

#define NOTED     0.75  /* a region below this certainty is named; chosen */
#define PAPER     0.5f  /* ink above this is paper; chosen */
#define NOTED_AREA 5e-4 /* of the page: smaller regions are not named; chosen */

void
cli_frame_clear (CliFrameState *state)
{
  g_free (state->ink.data);
  g_free (state->labels.data);
  g_free (state->fingerprint);
  g_free (state->sure);
  if (state->notes)
    g_array_free (state->notes, TRUE);
  *state = (CliFrameState) { 0 };
}

char *
cli_frame_path (const CliMotion *motion, const char *result, size_t frame)
{
  bool  is_depth = !strcmp (result, "depth"), is_state = !strcmp (result, "state");
  char *name = g_strdup_printf ("%s%s_%03d.%s", is_state ? "." : "", result, motion->frames.frame[frame].number,
                                is_state ? "json" : strcmp (result, "labels") ? "exr" : "png");
  char *path = g_build_filename (is_depth ? motion->options->depth_dir : motion->options->labels_dir, name, NULL);

  g_free (name);
  return path;
}

/* ------------------------------------------------------------------ notes */

/* Sums over the pixels of a label, which are certain on paper alone. */
typedef struct { size_t n, paper, unsure; double certainty, x, y; } LabelSums;

static LabelSums *
sum_labels (const CliMotion *motion, const CeldPlane *ink, const CeldLabels *labels, const CeldPlane *certainty)
{
  LabelSums *sums = g_new0 (LabelSums, motion->palette.n + 1);

  for (int y = 0; y < labels->height; y++)
    for (int x = 0; x < labels->width; x++)
      {
        size_t     at = (size_t) y * labels->stride + (size_t) x;
        LabelSums *s = &sums[labels->data[at]];
        double     sure = certainty ? (double) certainty->data[at] : 1;
        bool       paper = !ink || ink->data[(size_t) y * ink->stride + (size_t) x] > PAPER;

        s->n++;
        s->paper     += paper;
        s->certainty += sure;
        if (certainty && (!paper || sure >= NOTED))
          continue;
        s->unsure++;
        s->x += x;
        s->y += y;
      }
  return sums;
}

/* The pixel of a label nearest to a place. */
static void
nearest_of (const CeldLabels *labels, uint32_t label, double to_x, double to_y, CliRegionNote *note)
{
  double nearest = INFINITY;

  for (int y = 0; y < labels->height; y++)
    for (int x = 0; x < labels->width; x++)
      {
        double distance;

        if (labels->data[(size_t) y * labels->stride + (size_t) x] != label ||
            (distance = hypot (x - to_x, y - to_y)) >= nearest)
          continue;
        nearest = distance;
        note->x = x;
        note->y = y;
      }
}

void
cli_frame_take_notes (const CliMotion *motion, const CeldLabels *before, const CeldLabels *labels,
                      const CeldPlane *certainty, CliFrameState *state)
{
  LabelSums *old = sum_labels (motion, NULL, before, NULL), *new = sum_labels (motion, &state->ink, labels, certainty);
  double     least = NOTED_AREA * motion->width * motion->height, sum = 0, area = 0;

  for (uint32_t l = 1; l <= motion->palette.n; l++)
    {
      CliRegionNote note = { l, CLI_REGION_UNSURE, new[l].paper ? new[l].certainty / (double) new[l].paper : 0, -1,
                             -1 };
      bool          gone = !new[l].n && (double) old[l].n >= least, appears = !old[l].n && (double) new[l].n >= least;
      bool          unsure = (double) new[l].unsure >= least && new[l].unsure > new[l].paper / 4;
      bool          doubtful = state->sure && l != motion->background && state->sure[l] < CLI_REGION_SURE;

      sum  += new[l].certainty;
      area += (double) new[l].n;
      if (!gone && !appears && !unsure && !doubtful &&
          !(l == motion->background && (double) new[l].unsure >= least))
        continue;
      note.change = !new[l].n ? CLI_REGION_GONE : appears ? CLI_REGION_NEW : CLI_REGION_UNSURE;
      note.certainty = MIN (note.certainty, doubtful ? state->sure[l] : 1);
      if (old[l].n && (!new[l].n || !new[l].unsure))
        nearest_of (new[l].n ? labels : before, l, old[l].x / (double) old[l].n, old[l].y / (double) old[l].n, &note);
      else if (new[l].unsure)
        nearest_of (labels, l, new[l].x / (double) new[l].unsure, new[l].y / (double) new[l].unsure, &note);
      g_array_append_val (state->notes, note);
    }
  state->certainty = MIN (state->certainty, area > 0 ? sum / area : 0);
  g_free (old);
  g_free (new);
}

/* ------------------------------------------------------------------ the state on the disk */

static const char *const changes[] = { "unsure", "gone", "new" };

static bool
write_state (const CliMotion *motion, const CliFrameState *state)
{
  char        *path = cli_frame_path (motion, "state", state->frame);
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
      const CliRegionNote *note = &g_array_index (state->notes, CliRegionNote, i);

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
  CliRegionNote note = { 0 };
  const char   *change;

  if (!values || json_array_get_length (values) != 5)
    return;
  for (guint k = 0; k < 5; k++)
    if (!JSON_NODE_HOLDS_VALUE (json_array_get_element (values, k)))
      return;
  change = json_array_get_string_element (values, 1);
  for (size_t c = 0; change && c < G_N_ELEMENTS (changes); c++)
    if (!strcmp (change, changes[c]))
      note.change = (CliRegionChange) c;
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

/* Reads what was written for this fingerprint (NULL: for any).  For a review, what was written without is not
 * enough. */
static bool
read_object (const CliMotion *motion, JsonObject *object, const char *fingerprint, CliFrameState *state)
{
  const char *found = json_object_get_string_member_with_default (object, "fingerprint", NULL);
  JsonNode   *notes = json_object_get_member (object, "notes");

  if (!found || (fingerprint && strcmp (found, fingerprint)) ||
      (motion->options->review && !read_sure (motion, json_object_get_member (object, "sure"), state)))
    return false;
  state->certainty = json_object_get_double_member_with_default (object, "certainty", 0);
  if (notes && JSON_NODE_HOLDS_ARRAY (notes))
    for (guint i = 0; i < json_array_get_length (json_node_get_array (notes)); i++)
      read_note (motion, json_array_get_element (json_node_get_array (notes), i), state->notes);
  return true;
}

bool
cli_frame_read_state (const CliMotion *motion, size_t frame, const char *fingerprint, CliFrameState *state)
{
  char       *path = cli_frame_path (motion, "state", frame);
  JsonParser *parser = json_parser_new_immutable ();
  JsonNode   *root = json_parser_load_from_file (parser, path, NULL) ? json_parser_get_root (parser) : NULL;
  bool        good = root && JSON_NODE_HOLDS_OBJECT (root) &&
                     read_object (motion, json_node_get_object (root), fingerprint, state);

  g_object_unref (parser);
  g_free (path);
  return good;
}

/* Reads the labels that an earlier run has written. */
static bool
read_labels (const CliMotion *motion, size_t frame, CeldLabels *labels)
{
  char     *path = cli_frame_path (motion, "labels", frame);
  CliLayers layers = { .width = motion->width, .height = motion->height };
  CeldPaint paint = { 0 };
  bool      good = g_file_test (path, G_FILE_TEST_EXISTS) && cli_layer_read (path, "labels", &layers, &paint) &&
                   cli_labels_new (paint.width, paint.height, labels) &&
                   cli_check (celd_corrections_read (&paint, &motion->palette, labels));

  for (size_t i = 0; good && i < (size_t) labels->width * (size_t) labels->height; i++)
    if (!labels->data[i])
      labels->data[i] = motion->background;
  g_free (paint.data);
  g_free (path);
  return good;
}

/* ------------------------------------------------------------------ ink */

bool
cli_frame_ink (const CliMotion *motion, const CeldHost *host, size_t frame, CeldPlane *ink)
{
  CliOptions none = { .settings.ink = motion->options->settings.ink };
  CliLayers  layers = { .width = motion->width, .height = motion->height };
  bool       good = cli_layers_read (motion->frames.frame[frame].path, &none, 0, &layers) &&
                    cli_plane_new (motion->width, motion->height, ink) &&
                    cli_check (celd_ink (&layers.drawing, motion->options->settings.ink, host, ink));

  cli_layers_clear (&layers);
  return good;
}

/* ------------------------------------------------------------------ propagation */

CeldStatus
cli_frame_carry (const CliMotion *motion, const CeldHost *host, const CeldPlane *ink, const CeldLabels *from,
                 const CeldPlane *next, CeldLabels *labels, CeldPlane *certainty)
{
  CeldSettings settings = motion->options->settings;
  CeldPalette  palette = { g_memdup2 (motion->palette.item, motion->palette.n * sizeof (CeldRegion)),
                           motion->palette.n };
  CeldStatus   status = celd_propagate (ink, from, motion->order.level, motion->background, next, host, labels,
                                        certainty);

  settings.background = CELD_BACKGROUND_NONE; /* it has a label already */
  settings.same_colour = CELD_SAME_COLOUR_ONE;
  if (status == CELD_OK)
    status = celd_segment (next, labels, NULL, &settings, host, labels, &palette, NULL);
  celd_palette_clear (&palette);
  return status;
}

static bool
propagate (const CliMotion *motion, const CeldHost *host, size_t frame, char *fingerprint, CliFrameState *state)
{
  CliFrameState next = { .frame = frame, .certainty = state->certainty, .fingerprint = fingerprint,
                         .notes = g_array_new (FALSE, FALSE, sizeof (CliRegionNote)) };
  CeldPlane     certainty = { 0 };
  bool          good = cli_frame_ink (motion, host, frame, &next.ink) &&
                       cli_labels_new (motion->width, motion->height, &next.labels) &&
                       cli_plane_new (motion->width, motion->height, &certainty) &&
                       cli_check (cli_frame_carry (motion, host, &state->ink, &state->labels, &next.ink, &next.labels,
                                                  &certainty)) &&
                       (!motion->options->review || cli_frame_doubt (motion, host, state, &next));

  if (good)
    cli_frame_take_notes (motion, &state->labels, &next.labels, &certainty, &next);
  g_free (certainty.data);
  cli_frame_clear (state);
  *state = next;
  return good;
}

static bool
is_written (const CliMotion *motion, const char *result, size_t frame)
{
  char *path = cli_frame_path (motion, result, frame);
  bool  found = g_file_test (path, G_FILE_TEST_IS_REGULAR);

  g_free (path);
  return found;
}

/* The fingerprint of a frame that is made from one with another fingerprint; NULL with a message. */
static char *
fingerprint_of (const CliMotion *motion, const char *before, size_t frame)
{
  const char *path = motion->frames.frame[frame].path;
  GChecksum  *sum = g_checksum_new (G_CHECKSUM_SHA256);
  GError     *error = NULL;
  char       *data = NULL, *fingerprint = NULL;
  gsize       size = 0;

  if (g_file_get_contents (path, &data, &size, &error))
    {
      g_checksum_update (sum, (const guchar *) before, -1);
      g_checksum_update (sum, (const guchar *) data, (gssize) size);
      fingerprint = g_strdup (g_checksum_get_string (sum));
    }
  else
    cli_say ("Cannot read \"%s\": %s.", path, error->message);
  g_clear_error (&error);
  g_free (data);
  g_checksum_free (sum);
  return fingerprint;
}

bool
cli_frame_next (const CliMotion *motion, const CeldHost *host, size_t frame, CliFrameState *state, bool *made)
{
  char         *fingerprint = fingerprint_of (motion, state->fingerprint, frame);
  CliFrameState kept = { .frame = frame, .certainty = 1, .fingerprint = fingerprint,
                         .notes = g_array_new (FALSE, FALSE, sizeof (CliRegionNote)) };

  *made = true;
  if (!fingerprint)
    {
      cli_frame_clear (&kept);
      return false;
    }
  if (!cli_frame_read_state (motion, frame, fingerprint, &kept) || !read_labels (motion, frame, &kept.labels) ||
      !is_written (motion, "levels", frame) || (motion->options->depth_dir && !is_written (motion, "depth", frame)))
    {
      kept.fingerprint = NULL;
      cli_frame_clear (&kept);
      return propagate (motion, host, frame, fingerprint, state);
    }
  *made = false;
  cli_frame_clear (state);
  *state = kept;
  return cli_frame_ink (motion, host, frame, &state->ink);
}

bool
cli_frame_of_key (const CliMotion *motion, const CliKey *key, CliFrameState *state)
{
  size_t n = (size_t) motion->width * (size_t) motion->height;

  *state = (CliFrameState) { .frame = key->frame, .certainty = 1, .fingerprint = g_strdup (key->fingerprint),
                             .notes = g_array_new (FALSE, FALSE, sizeof (CliRegionNote)) };
  if (!cli_plane_new (motion->width, motion->height, &state->ink) ||
      !cli_labels_new (motion->width, motion->height, &state->labels))
    return false;
  memcpy (state->ink.data, key->ink.data, n * sizeof *key->ink.data);
  memcpy (state->labels.data, key->labels.data, n * sizeof *key->labels.data);
  state->sure = motion->options->review ? g_new0 (double, motion->palette.n + 1) : NULL;
  for (size_t l = 1; l <= motion->palette.n && state->sure; l++)
    state->sure[l] = 1;
  return true;
}

/* ------------------------------------------------------------------ results */

static bool
write_levels_and_depth (const CliMotion *motion, const CeldHost *host, const CliFrameState *state)
{
  const CeldSettings *settings = &motion->options->settings;
  const CeldOrder    *order = &motion->order;
  CeldPlane           levels = { 0 };
  char               *path = cli_frame_path (motion, "levels", state->frame), *depth;
  float               nearest = celd_order_value (order, order->levels - 1, settings);
  bool                good = cli_plane_new (motion->width, motion->height, &levels);

  for (size_t i = 0; good && i < (size_t) motion->width * (size_t) motion->height; i++)
    levels.data[i] = celd_order_value (order, order->level[state->labels.data[i] - 1], settings);
  good = good && cli_check (celd_expand_levels (&state->ink, &levels, &state->labels, NULL, settings->expansion, host,
                                                &levels)) &&
         cli_write_depth (path, &levels, nearest);
  g_free (path);
  if (good && motion->options->depth_dir)
    {
      depth = cli_frame_path (motion, "depth", state->frame);
      good  = cli_check (celd_smooth (&state->ink, NULL, &levels, NULL, settings, host, &levels, NULL)) &&
              cli_write_depth (depth, &levels, nearest);
      g_free (depth);
    }
  g_free (levels.data);
  return good;
}

bool
cli_frame_write (const CliMotion *motion, const CeldHost *host, const CliFrameState *state)
{
  char *path = cli_frame_path (motion, "labels", state->frame);
  bool  good = cli_write_labels (path, &state->labels, &motion->palette) &&
               write_levels_and_depth (motion, host, state) && write_state (motion, state);

  g_free (path);
  return good;
}
