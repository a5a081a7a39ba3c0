/* The files that each sub-command reads and writes.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "outputs.h"

#include <stddef.h>
#include <string.h>

typedef struct
{
  const char *name;
  int         steps;       /* CliSteps with this option */
  int         required;    /* CliSteps that need it */
  CliFileKind kind;
  size_t      offset;      /* in CliOptions */
  const char *value, *help;
} FileOption;

#define MEMBER(name) offsetof (CliOptions, name)

#define FORMAT \
  "the format of a result that is written to standard output (-), by the ending that its file would have (default: "

static const FileOption files[] = {
  { "clip", CLI_SHADE | CLI_ENHANCE | CLI_LAYERS | FROM_THE_SIDE | CLI_RELIEF, 0, TEXT, MEMBER (clip), "FOLDER",
    "work on each frame of a clip that propagate has written (--labels-dir), instead of one input; outputs get the "
    "frame's number, and a # in a name stands for a digit of it" },
  { "labels-dir", CLI_PROPAGATE, CLI_PROPAGATE, HOW, MEMBER (labels_dir), "FOLDER",
    "write labels_NNN.png and levels_NNN.exr of each frame, clip.json for --clip, and relations.txt" },
  { "depth-dir", CLI_PROPAGATE, 0, HOW, MEMBER (depth_dir), "FOLDER", "write depth_NNN.exr of each frame" },
  { "emit-slurm", CLI_PROPAGATE, 0, REPORT, MEMBER (emit_slurm), "OUT",
    "write a script that runs this command as an array job of Slurm, and do nothing else" },
  { "output-dir", CLI_POPUP, 0, HOW, MEMBER (output_dir), "FOLDER",
    "write the results of many pages, such as pages/*.psd, as FOLDER/PAGE-depth.png; results are then given without "
    "names, or with a format, such as --depth=exr (default: depth and shaded); finished pages are kept" },
  { "drawing", CLI_ORDER | OF_LEVELS | CLI_RELIEF, OF_LEVELS, INPUT, MEMBER (drawing), "DRAWING",
    "the line drawing; relief then reads levels" },
  { "scribbles", WITH_PARTS | CLI_SMOOTH | CLI_INBETWEEN, 0, INPUT, MEMBER (scribbles), "PICTURE",
    "scribbles, a colour of its own for each region; in smooth depth their pixels keep their level" },
  { "contours", WITH_INK, 0, INPUT, MEMBER (contours), "PICTURE",
    "virtual contours: red ones separate regions and depth, blue ones regions only, green ones erase ink" },
  { "corrections", CLI_POPUP | CLI_LAYERS | FROM_THE_SIDE | CLI_RELIEF | CLI_REGISTER | CLI_DEFORM, 0, INPUT,
    MEMBER (corrections), "PICTURE",
    "strokes over ink, each of which gives the line below it to the region of its colour" },
  { "hidden", CLI_POPUP | CLI_LAYERS | FROM_THE_SIDE | CLI_RELIEF | CLI_DEFORM, 0, INPUT, MEMBER (hidden), "PICTURE",
    "what is hidden: strokes in the colour of a region add to it behind nearer ones, black strokes take away" },
  { "arrows", WITH_PARTS | CLI_ORDER | CLI_INBETWEEN, 0, INPUT, MEMBER (arrows), "PICTURE",
    "arrows from nearer to farther parts" },
  { "relations", WITH_PARTS | CLI_ORDER | CLI_PROPAGATE | CLI_INBETWEEN, 0, TEXT, MEMBER (relations), "TEXT",
    "relations such as '120,80 > 300,90; #ff0000 = #00ff00'" },
  { "relations-file", WITH_PARTS | CLI_ORDER | CLI_PROPAGATE | CLI_INBETWEEN, 0, INPUT, MEMBER (relations_file), "FILE",
    "a text file with relations" },
  { "arrow-path", WITH_PARTS | CLI_ORDER, 0, TEXT, MEMBER (arrow_path), "PATH",
    "arrows as SVG path data such as 'M 120,80 L 300,90', each from its nearer end" },
  { "depth-hint", GIVES_LABELS | CLI_ORDER, 0, INPUT, MEMBER (depth_hint), "PICTURE",
    "a depth picture from another source, near = white, for suggestions" },
  { "labels", GIVES_LABELS, 0, OUTPUT, MEMBER (labels), "OUT", "write regions in the colours of their scribbles" },
  { "closures", GIVES_LABELS, 0, OUTPUT, MEMBER (closures), "OUT",
    "write the gaps in contours that were closed, in red on a transparent layer" },
  { "suggestions", GIVES_LABELS | CLI_ORDER, 0, REPORT, MEMBER (suggestions), "OUT",
    "write suggestions, which say what seems to be in front, as relations with their confidence" },
  { "suggested-arrows", GIVES_LABELS, 0, OUTPUT, MEMBER (suggested_arrows), "OUT",
    "write suggestions as arrows on a transparent layer" },
  { "unexpanded-levels", CLI_POPUP | CLI_ORDER, CLI_ORDER, OUTPUT, MEMBER (unexpanded), "OUT",
    "write levels before contours are given to the regions that they outline: they change in the middle of contours" },
  { "levels", CLI_POPUP | CLI_EXPAND | CLI_COMPOSE | CLI_DEFORM, CLI_EXPAND, OUTPUT, MEMBER (levels), "OUT",
    "write levels: the place of each pixel's part in the order of depth" },
  { "depth", CLI_POPUP | CLI_SMOOTH | CLI_EXACT, CLI_SMOOTH | CLI_EXACT, OUTPUT, MEMBER (depth), "OUT",
    "write smooth depth" },
  { "source-levels", CLI_REGISTER, 0, INPUT, MEMBER (source_levels), "LEVELS",
    "levels of the first drawing, instead of its scribbles and arrows: parts of different levels move on their own" },
  { "regions", CLI_EXPAND | CLI_RELIEF | CLI_REGISTER, 0, INPUT, MEMBER (regions), "PICTURE",
    "the regions that segment has written, to distinguish those of the same level" },
  { "smooth-depth", CLI_SHADE | CLI_RELIEF, 0, INPUT, MEMBER (smooth_depth), "DEPTH",
    "smooth depth that popup or smooth has written: the depth of the parts of a relief (default: computed from the "
    "levels); shade bends the nearer side of strokes inside a part (see --creases)" },
  { "hints", CLI_SHADE, 0, INPUT, MEMBER (hints), "PICTURE",
    "paint beside lines: parts bend on a white side, do not bend on a black side, bend on both sides at grey" },
  { "matcap", CLI_SHADE, 0, INPUT, MEMBER (matcap), "PICTURE",
    "the picture of a lit ball, from which parts take their shading" },
  { "grid", CLI_SHADE, 0, TEXT, MEMBER (grid), "COLUMNSxROWS",
    "the input is a sheet of sprites, which are shaded one by one" },
  { "enhanced", CLI_POPUP | CLI_ENHANCE, 0, OUTPUT, MEMBER (enhanced), "OUT", "write the art with shadows" },
  { "shadow", CLI_POPUP | CLI_ENHANCE, 0, OUTPUT, MEMBER (shadow), "OUT", "write the shadows alone, as a black layer" },
  { "view", CLI_POPUP | CLI_ENHANCE, 0, OUTPUT, MEMBER (view), "OUT", "write a grey picture of depth with shadows" },
  { "normals", CLI_POPUP | CLI_SHADE, 0, OUTPUT, MEMBER (normals), "OUT", "write normals" },
  { "shading", CLI_POPUP | CLI_SHADE, 0, OUTPUT, MEMBER (shading), "OUT", "write shading" },
  { "shaded", CLI_POPUP | CLI_SHADE, 0, OUTPUT, MEMBER (shaded), "OUT", "write the lit drawing, or other lit art" },
  { "tone", CLI_POPUP | CLI_SHADE, 0, OUTPUT, MEMBER (tone), "OUT", "write a layer to multiply the art by" },
  { "rim", CLI_POPUP | CLI_SHADE, 0, OUTPUT, MEMBER (rim), "OUT",
    "write a white layer of highlights and rims, to put over the product" },
  { "occlusion", CLI_POPUP | CLI_SHADE, 0, OUTPUT, MEMBER (occlusion), "OUT",
    "write ambient occlusion: the fraction of light that nearer parts let through" },
  { "maps", CLI_POPUP | CLI_SHADE, 0, MAPS, MEMBER (maps), "NAME.png",
    "write maps for game engines: NAME_n.png (normals), NAME_o.png (occlusion), NAME_s.png (specular)" },
  { "padding", CLI_POPUP | CLI_SHADE, 0, HOW, MEMBER (padding_text), "0-64",
    "the number of transparent pixels around a sprite that maps fill (default: 4)" },
  { "left", CLI_POPUP | CLI_STEREO, 0, OUTPUT, MEMBER (left), "OUT", "write the view of the left eye" },
  { "right", CLI_POPUP | CLI_STEREO, 0, OUTPUT, MEMBER (right), "OUT", "write the view of the right eye" },
  { "joined", CLI_POPUP | CLI_STEREO, 0, JOINED, MEMBER (stereo), "OUT",
    "write both views in one picture (see --stereo), or in one .mpo file" },
  { "quilt", CLI_POPUP | CLI_STEREO, 0, OUTPUT, MEMBER (quilt), "OUT",
    "write all --views as tiles of one picture (see --columns)" },
  { "sequence", CLI_POPUP | CLI_STEREO, 0, FRAMES, MEMBER (sequence), "OUT",
    "write all --views in a file or folder: .mpo, .gif, or a folder of PNG files" },
  { "wiggle", CLI_POPUP, 0, FRAMES, MEMBER (wiggle), "OUT",
    "write an animation of a camera that moves: .gif, .mpo, or a folder of PNG files; for it --disparity is 0.05 if not "
    "given" },
  { "output", CLI_WIGGLE, CLI_WIGGLE, FRAMES, MEMBER (wiggle), "OUT",
    "write the animation: .gif, .mpo, or a folder of PNG files" },
  { "colours", COLOURED, 0, INPUT, MEMBER (colours), "PICTURE",
    "a coloured version of the drawing, used instead of it for light, shadows, layers, views, meshes and motion" },
  { "compositing", CLI_POPUP | CLI_LAYERS | CLI_COMPOSE | CLI_DEFORM, 0, HOW, MEMBER (compositing), "encoded|linear",
    "the colours in which layers will be composited: encoded (Krita) or linear light (GIMP 3) (default: encoded, but "
    "linear for .exr)" },
  { "output", CLI_LAYERS, CLI_LAYERS, STACK, MEMBER (output), "OUT",
    "write layers: .ora (OpenRaster), .psd, .exr (one part per layer), or a folder of PNG files" },
  { "layers", CLI_POPUP, 0, STACK, MEMBER (layers), "OUT",
    "write layers: .ora (OpenRaster), .psd, .exr (one part per layer), or a folder of PNG files" },
  { "output", CLI_COMPOSE, 0, COMPOSED, MEMBER (composed), "OUT",
    "write the picture: .png, .tif, .npy; or its layers: .ora (OpenRaster), .psd, .exr (one part per layer), or a "
    "folder of PNG files" },
  { "height", CLI_POPUP | CLI_RELIEF, 0, OUTPUT, MEMBER (height), "OUT",
    "write heights in pixels; in .png from 0, the lowest, to 1, the highest" },
  { "mesh", CLI_POPUP | CLI_RELIEF, 0, MESH, MEMBER (mesh), "OUT",
    "write a mesh: .glb, .obj, .ply, or .stl for printing" },
  { "displacement", CLI_REGISTER, 0, OUTPUT, MEMBER (displacement), "OUT",
    "write how far each pixel of the first drawing moves, in pixels to the right and down: .npy, .exr or .tif" },
  { "warped", CLI_REGISTER, 0, OUTPUT, MEMBER (warped), "OUT",
    "write the first drawing, or its --colours, moved to where the second one has it" },
  { "confidence", CLI_REGISTER, 0, OUTPUT, MEMBER (confidence), "OUT",
    "write how well the lines around each pixel fit, from 0 to 1" },
  { "handles", CLI_DEFORM, 0, TEXT, MEMBER (handles), "TEXT",
    "handles such as '120,80 -> 200,60; 300,400; 310,90 -> 320,95 ^1': places that are taken elsewhere, pins, and by "
    "how many levels what is near moves forward" },
  { "handles-file", CLI_DEFORM, 0, INPUT, MEMBER (handles_file), "FILE", "a text file with handles" },
  { "handles-layer", CLI_DEFORM, 0, INPUT, MEMBER (handles_layer), "PICTURE",
    "painted handles: dots are pins, arrows take what is at their tail to their tip" },
  { "keys", CLI_DEFORM, 0, INPUT, MEMBER (handle_keys), "FILE",
    "a JSON file with the handles of some frames of an animation; those of the others are interpolated" },
  { "output", CLI_DEFORM, CLI_DEFORM, DEFORMED, MEMBER (deformed), "OUT",
    "write the deformed drawing: .png, .exr, .tif or .npy; its layers: .ora (OpenRaster) or .psd; or its motion: .gif, "
    "or a folder of PNG files" },
  { "scribbles-b", CLI_INBETWEEN, 0, INPUT, MEMBER (second_scribbles), "PICTURE",
    "scribbles of the second drawing, in the colours of those of the first (default: regions are found by propagation)" },
  { "arrows-b", CLI_INBETWEEN, 0, INPUT, MEMBER (second_arrows), "PICTURE",
    "arrows of the second drawing, for parts that the first one does not show; with --scribbles-b" },
  { "colours-b", CLI_INBETWEEN, 0, INPUT, MEMBER (second_colours), "PICTURE", "a coloured version of the second drawing" },
  { "output", CLI_INBETWEEN, CLI_INBETWEEN, MOVING, MEMBER (between), "OUT",
    "write the drawings between: .png, .exr, .tif or .npy, with a # for each digit of the number; or with the keys: .gif, "
    "or a folder of PNG files" },
  { "format", CLI_POPUP, 0, HOW, MEMBER (format), "ENDING", FORMAT "png, but ora for layers and glb for meshes)" },
  { "format", CLI_LAYERS, 0, HOW, MEMBER (format), "ENDING", FORMAT "ora)" },
  { "format", CLI_STEREO, 0, HOW, MEMBER (format), "ENDING", FORMAT "png, but gif for a sequence)" },
  { "format", CLI_WIGGLE, 0, HOW, MEMBER (format), "ENDING", FORMAT "gif)" },
  { "format", CLI_RELIEF, 0, HOW, MEMBER (format), "ENDING", FORMAT "png, but glb for meshes)" },
  { "format", CLI_REGISTER, 0, HOW, MEMBER (format), "ENDING", FORMAT "png, but npy for displacements)" },
  { "format", ~(CLI_POPUP | CLI_LAYERS | FROM_THE_SIDE | CLI_RELIEF | CLI_REGISTER | CLI_PROPAGATE), 0, HOW,
    MEMBER (format), "ENDING", FORMAT "png)" },
  { "report", WITH_LAYERS | CLI_ORDER, 0, REPORT, MEMBER (report), "OUT",
    "write a report of regions, relations and problems, as JSON" },
  { "report", CLI_PROPAGATE, 0, REPORT, MEMBER (review), "OUT",
    "write a report of the frames and regions to look at, as JSON, and beside it a picture of them" },
};

static char **
file_name (CliOptions *options, const FileOption *file)
{
  return (char **) ((char *) options + file->offset);
}

static bool
is_text (CliFileKind kind)
{
  return kind == TEXT || kind == HOW;
}

/* Appends relations below those of the same option before. */
static gboolean
take_relations (const char *name, const char *text, gpointer data, GError **error)
{
  CliOptions *options = data;
  char       *before = options->relations;

  (void) name;
  (void) error;
  options->relations = before ? g_strconcat (before, "\n", text, NULL) : g_strdup (text);
  g_free (before);
  return TRUE;
}

static GOptionEntry
entry_of (CliOptions *options, const FileOption *file)
{
  GOptionEntry entry = { file->name, 0, 0, is_text (file->kind) ? G_OPTION_ARG_STRING : G_OPTION_ARG_FILENAME,
                         file_name (options, file), file->help, file->value };

  if (file->offset == MEMBER (relations))
    {
      entry.arg      = G_OPTION_ARG_CALLBACK;
      entry.arg_data = (gpointer) take_relations;
    }
  return entry;
}

void
cli_files_append (const CliCommand *command, CliOptions *options, CliOptionList *list)
{
  for (int output = 0; output < 2; output++)
    for (size_t i = 0; i < G_N_ELEMENTS (files); i++)
      if (files[i].steps & (int) command->step && (files[i].kind >= HOW) == output)
        cli_list_add (list, output ? "Output" : "Input", entry_of (options, &files[i]));
}

const char *
cli_files_ending (const CliCommand *command, const char *option)
{
  for (size_t i = 0; i < G_N_ELEMENTS (files); i++)
    if (files[i].steps & (int) command->step && files[i].kind >= MAPS && !strcmp (files[i].name, option))
      return files[i].kind == STACK                  ? "ora"
             : files[i].kind == FRAMES               ? "gif"
             : files[i].kind == MESH                 ? "glb"
             : files[i].kind != REPORT               ? "png"
             : files[i].offset == MEMBER (report)    ? "json"
                                                     : "txt";
  return NULL;
}

/* Is the file an output that this command names in another way? */
static bool
is_of_other_command (const FileOption *file, CliSteps step)
{
  if (file->steps & (int) step)
    return false;
  for (size_t i = 0; i < G_N_ELEMENTS (files); i++)
    if (files[i].offset == file->offset && files[i].steps & (int) step)
      return true;
  return false;
}

void
cli_files_given (const CliOptions *options, GArray *given)
{
  for (size_t i = 0; i < G_N_ELEMENTS (files); i++)
    {
      char *path = *file_name ((CliOptions *) options, &files[i]);

      if (path && !is_text (files[i].kind) && !is_of_other_command (&files[i], options->step))
        g_array_append_val (given, ((CliFile) { files[i].name, files[i].kind, path }));
    }
}

void
cli_files_inputs (const CliOptions *options, GPtrArray *names)
{
  GArray *given = g_array_new (FALSE, FALSE, sizeof (CliFile));

  g_ptr_array_add (names, options->input);
  cli_files_given (options, given);
  for (guint i = 0; i < given->len; i++)
    if (g_array_index (given, CliFile, i).kind == INPUT)
      g_ptr_array_add (names, (gpointer) g_array_index (given, CliFile, i).path);
  g_array_free (given, TRUE);
}

/* ------------------------------------------------------------------ frames */

char *
cli_file_numbered (const char *name, int number)
{
  const char *first = strchr (name, '#'), *base = strrchr (name, G_DIR_SEPARATOR);
  const char *dot = strrchr (base ? base + 1 : name, '.'), *end = dot && dot != name ? dot : name + strlen (name);

  if (!first)
    return g_strdup_printf ("%.*s_%03d%s", (int) (end - name), name, number, end);
  end = first + strspn (first, "#");
  return g_strdup_printf ("%.*s%0*d%s", (int) (first - name), name, (int) (end - first), number, end);
}

void
cli_files_number (const CliOptions *all, int number, CliOptions *frame)
{
  for (size_t i = 0; i < G_N_ELEMENTS (files); i++)
    {
      const char *name = *file_name ((CliOptions *) all, &files[i]);
      bool        copied = *file_name (frame, &files[i]) != name; /* some rows share one */
      bool        counts = name && !is_text (files[i].kind) && (files[i].kind != INPUT || strchr (name, '#'));

      if (!copied)
        *file_name (frame, &files[i]) = counts ? cli_file_numbered (name, number) : g_strdup (name);
    }
}

/* ------------------------------------------------------------------ standard input and output */

/* The ending of what an option writes to standard output; NULL: none. */
static const char *
ending_of (const FileOption *file, const char *format)
{
  if (file->kind == REPORT)
    return NULL;
  if (format)
    return format;
  if (file->offset == MEMBER (displacement)) /* a PNG cannot have it */
    return "npy";
  return file->kind == STACK ? "ora" : file->kind == MESH ? "glb" : file->kind == FRAMES ? "gif" : "png";
}

/* Has a file in place of the name "-" of an option. */
static bool
stream_file (const FileOption *file, CliOptions *options)
{
  char **name = file_name (options, file);
  char  *what = g_strconcat ("--", file->name, NULL);
  bool   good = true;

  if (*name && !**name && file->kind != TEXT)
    good = cli_error ("%s needs a value: %s %s.", what, what, file->value);
  else if (!*name || strcmp (*name, "-") != 0 || file->kind == TEXT)
    good = true;
  else if (options->watch)
    good = cli_error ("%s cannot be \"-\" with --watch, which waits for files to be saved.", what);
  else if (options->clip || options->output_dir || file->kind == HOW || file->kind == MAPS)
    good = cli_error ("%s cannot be \"-\": it stands for more than one file.", what);
  else if (file->kind == INPUT)
    good = cli_stream_input (&options->streams, what, name);
  else
    good = cli_stream_output (&options->streams, what, ending_of (file, options->format), file->kind == REPORT, name);
  g_free (what);
  return good;
}

bool
cli_files_stream (const CliCommand *command, CliOptions *options)
{
  bool many = command->step & (CLI_PROPAGATE | CLI_COMPOSE) || options->output_dir, good = true;

  if (options->input && !strcmp (options->input, "-"))
    good = options->watch ? cli_error ("--watch needs a file that is saved, not \"-\".")
         : many           ? cli_error ("%s cannot be \"-\": it names other files.", command->input)
                          : cli_stream_input (&options->streams, command->input, &options->input);
  if (good && options->target && !many && !strcmp (options->target, "-"))
    good = cli_stream_input (&options->streams, command->second, &options->target);
  for (size_t i = 0; good && i < G_N_ELEMENTS (files); i++)
    if (files[i].steps & (int) command->step)
      good = stream_file (&files[i], options);
  return good && (!options->format || options->streams.output ||
                  cli_error ("--format is for standard output: give an output the name \"-\"."));
}

/* ------------------------------------------------------------------ checks */

bool
cli_files_check (const CliCommand *command, CliOptions *options)
{
  int outputs = 0;

  for (size_t i = 0; i < G_N_ELEMENTS (files); i++)
    {
      const char *name = *file_name (options, &files[i]);

      if (!name && files[i].required & (int) command->step)
        return cli_error ("--%s is missing.", files[i].name);
      if (!name || files[i].kind < OUTPUT || !(files[i].steps & (int) command->step))
        continue;
      outputs++;
      if (!cli_ending_check (options, &(CliFile) { files[i].name, files[i].kind, name }))
        return false;
    }
  if (!outputs && !options->maps && !options->labels_dir)
    return cli_error ("There is nothing to write: give at least one output, such as --%s.", command->output);
  return cli_outputs_check (options);
}

void
cli_files_clear (CliOptions *options)
{
  for (size_t i = 0; i < G_N_ELEMENTS (files); i++)
    g_clear_pointer (file_name (options, &files[i]), g_free); /* some rows share one */
}
