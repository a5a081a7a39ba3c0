/* A clip, as propagate writes it: reading and writing its description, and running a sub-command for each frame.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "json.h"
#include "outputs.h"
#include "sequence.h"

/* ------------------------------------------------------------------ reading */

/* A member that is a name of a file, as a path from here; NULL if it is missing. */
static char *
read_name (JsonObject *object, const char *member, const char *folder)
{
  JsonNode *node = json_object_get_member (object, member);

  if (!node || !JSON_NODE_HOLDS_VALUE (node) || json_node_get_value_type (node) != G_TYPE_STRING)
    return NULL;
  return g_canonicalize_filename (json_node_get_string (node), folder);
}

static bool
read_frame (JsonNode *node, const char *folder, const char *path, CliClipFrame *frame)
{
  JsonObject *object = JSON_NODE_HOLDS_OBJECT (node) ? json_node_get_object (node) : NULL;
  JsonNode   *number = object ? json_object_get_member (object, "number") : NULL;

  if (!number || !JSON_NODE_HOLDS_VALUE (number) || json_node_get_value_type (number) != G_TYPE_INT64)
    return cli_error ("\"%s\" is damaged: a frame has no number. Run 'celdepth propagate' again.", path);
  frame->number  = (int) CLAMP (json_node_get_int (number), 0, G_MAXINT);
  frame->drawing = read_name (object, "drawing", folder);
  frame->labels  = read_name (object, "labels", folder);
  frame->levels  = read_name (object, "levels", folder);
  frame->depth   = read_name (object, "depth", folder);
  return (frame->drawing && frame->labels && frame->levels) ||
         cli_error ("\"%s\" is damaged: frame %d has no drawing, labels or levels. Run 'celdepth propagate' again.",
                    path, frame->number);
}

static bool
read_description (JsonNode *root, const char *folder, const char *path, CliClip *clip)
{
  JsonObject *object = root && JSON_NODE_HOLDS_OBJECT (root) ? json_node_get_object (root) : NULL;
  JsonNode   *node = object ? json_object_get_member (object, "frames") : NULL;
  JsonArray  *frames = node && JSON_NODE_HOLDS_ARRAY (node) ? json_node_get_array (node) : NULL;

  if (!frames || !json_array_get_length (frames))
    return cli_error ("\"%s\" describes no frames. Run 'celdepth propagate' again.", path);
  clip->relations = read_name (object, "relations", folder);
  clip->frame     = g_new0 (CliClipFrame, json_array_get_length (frames));
  for (guint i = 0; i < json_array_get_length (frames); i++)
    if (!read_frame (json_array_get_element (frames, i), folder, path, &clip->frame[clip->n++]))
      return false;
  return true;
}

/* Reads clip.json of a folder; names in it are relative to the folder.  False with a message.  The caller clears the
 * clip in either case. */
static bool
read_clip (const char *folder, CliClip *clip)
{
  char       *path = g_build_filename (folder, CLI_CLIP_FILE, NULL), *full = g_canonicalize_filename (folder, NULL);
  JsonParser *parser = json_parser_new_immutable ();
  bool        good;

  *clip = (CliClip) { 0 };
  if (!g_file_test (path, G_FILE_TEST_EXISTS))
    good = cli_error ("\"%s\" is no clip: it has no %s, which 'celdepth propagate --labels-dir %s' writes.", folder,
                      CLI_CLIP_FILE, folder);
  else
    good = cli_json_read (parser, path, false) && read_description (json_parser_get_root (parser), full, path, clip);
  g_object_unref (parser);
  g_free (path);
  g_free (full);
  return good;
}

void
cli_clip_clear (CliClip *clip)
{
  for (size_t i = 0; i < clip->n; i++)
    {
      g_free (clip->frame[i].drawing);
      g_free (clip->frame[i].labels);
      g_free (clip->frame[i].levels);
      g_free (clip->frame[i].depth);
    }
  g_free (clip->frame);
  g_free (clip->relations);
  *clip = (CliClip) { 0 };
}

/* ------------------------------------------------------------------ writing */

static void
add_name (JsonBuilder *json, const char *member, const char *path, const char *folder)
{
  char  *full;
  size_t n = strlen (folder);

  if (!path)
    return;
  full = g_canonicalize_filename (path, NULL);
  json_builder_set_member_name (json, member);
  json_builder_add_string_value (json, g_str_has_prefix (full, folder) && full[n] == G_DIR_SEPARATOR ? full + n + 1
                                                                                                     : full);
  g_free (full);
}

bool
cli_clip_write (const char *folder, const CliClip *clip)
{
  char        *path = g_build_filename (folder, CLI_CLIP_FILE, NULL), *full = g_canonicalize_filename (folder, NULL);
  JsonBuilder *json = json_builder_new ();
  bool         good;

  json_builder_begin_object (json);
  add_name (json, "relations", clip->relations, full);
  json_builder_set_member_name (json, "frames");
  json_builder_begin_array (json);
  for (size_t i = 0; i < clip->n; i++)
    {
      json_builder_begin_object (json);
      json_builder_set_member_name (json, "number");
      json_builder_add_int_value (json, clip->frame[i].number);
      add_name (json, "drawing", clip->frame[i].drawing, full);
      add_name (json, "labels", clip->frame[i].labels, full);
      add_name (json, "levels", clip->frame[i].levels, full);
      add_name (json, "depth", clip->frame[i].depth, full);
      json_builder_end_object (json);
    }
  json_builder_end_array (json);
  json_builder_end_object (json);
  cli_remove_unfinished (path);
  good = cli_write_json (path, json);
  g_free (path);
  g_free (full);
  return good;
}

/* ------------------------------------------------------------------ running a sub-command */

static void
replace (char **name, const char *with)
{
  g_free (*name);
  *name = g_strdup (with);
}

/* The options for one frame: the files of the clip, and all other names with the frame's number. */
static void
options_of_frame (const CliOptions *all, const CliClip *clip, const CliClipFrame *frame, CliOptions *options)
{
  *options = *all;
  cli_files_number (all, frame->number, options);
  if (all->step & (CLI_SHADE | CLI_ENHANCE))
    {
      options->input = g_strdup (frame->levels);
      if (all->step == CLI_SHADE)
        replace (&options->drawing, frame->drawing);
      if (!options->colours)
        replace (&options->colours, frame->drawing);
    }
  else
    {
      options->input = g_strdup (frame->drawing);
      replace (&options->scribbles, frame->labels);
      options->settings.flats = true;
      if (!options->relations && !options->relations_file)
        replace (&options->relations_file, clip->relations);
    }
}

static int
run_frame (const CliCommand *command, const CliOptions *all, const CliClip *clip, const CliClipFrame *frame)
{
  CliOptions options;
  int        code = CLI_USAGE;

  options_of_frame (all, clip, frame, &options);
  options.done_frames   = (int) (frame - clip->frame);
  options.frames_in_all = (int) clip->n;
  if ((!command->check || command->check (&options)) && cli_files_check (command, &options) &&
      cli_texts_check (&options))
    {
      cli_files_hold ();
      code = cli_files_end (cli_outputs_check_places (&options) ? command->run (&options) : CLI_FAILED);
    }
  cli_files_clear (&options);
  g_free (options.input);
  return code;
}

/* Whether a result of any frame would replace a file of the clip. */
static bool
check_outputs (const CliOptions *all, const CliClip *clip)
{
  char      *description = g_build_filename (all->clip, CLI_CLIP_FILE, NULL);
  CliTouched touched;
  bool       good = true;

  cli_touched_begin (&touched);
  cli_touched_reads (&touched, NULL, description);
  cli_touched_reads (&touched, NULL, clip->relations);
  for (int writes = 0; writes < 2; writes++)
    for (size_t i = 0; i < clip->n && good; i++)
      {
        const CliClipFrame *frame = &clip->frame[i];
        CliOptions          options;

        options_of_frame (all, clip, frame, &options);
        if (writes)
          good = cli_touched_writes_all (&touched, &options);
        else
          {
            cli_touched_reads_all (&touched, &options);
            cli_touched_reads (&touched, NULL, frame->drawing);
            cli_touched_reads (&touched, NULL, frame->labels);
            cli_touched_reads (&touched, NULL, frame->levels);
            cli_touched_reads (&touched, NULL, frame->depth);
          }
        cli_files_clear (&options);
        g_free (options.input);
      }
  cli_touched_end (&touched);
  g_free (description);
  return good;
}

int
cli_clip_run (const CliCommand *command, const CliOptions *options)
{
  CliClip clip = { 0 };
  int     code = CLI_DONE;
  bool    good = read_clip (options->clip, &clip);

  if (good && !check_outputs (options, &clip))
    {
      good = false;
      code = CLI_USAGE;
    }
  for (size_t i = 0; i < clip.n && good; i++)
    {
      int this;

      if (cli_progress_wanted (options))
        cli_say ("Frame %d, %zu of %zu.", clip.frame[i].number, i + 1, clip.n);
      this = run_frame (command, options, &clip, &clip.frame[i]);
      good = (this == CLI_DONE || this == CLI_CONTRADICTED) && !cli_run_cancelled ();
      code = this == CLI_DONE ? code : this;
    }
  cli_clip_clear (&clip);
  return good || code ? code : CLI_FAILED;
}
