/* The options of each sub-command: files, and every member of CeldSettings that the sub-command uses, under the name
 * that the property of the GEGL operations has.  Numbers have a point in every language.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

#include <errno.h>
#include <glib/gstdio.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define WIGGLE_DISPARITY 0.05f /* for one eye, which needs more to see it */

#define GIVES_LABELS   (CLI_POPUP | CLI_SEGMENT)
#define FROM_THE_SIDE  (CLI_STEREO | CLI_WIGGLE)
#define MADE_OF_LABELS (GIVES_LABELS | CLI_LAYERS | FROM_THE_SIDE)
#define WITH_LAYERS    (MADE_OF_LABELS | CLI_EXACT)
#define OF_LEVELS      (CLI_EXPAND | CLI_SMOOTH | CLI_SHADE | CLI_RELIEF)
#define WITH_INK       (WITH_LAYERS | CLI_ORDER | OF_LEVELS)

/* ------------------------------------------------------------------ files */

/* From OUTPUT on they are written; a joined picture may also be an MPO. */
typedef enum { INPUT, TEXT, OUTPUT, JOINED, REPORT, STACK, FRAMES, MESH } FileKind;

typedef struct
{
  const char *name;
  int         steps;       /* CliSteps that have this option */
  int         required;    /* CliSteps that cannot do without */
  FileKind    kind;
  size_t      offset;      /* in CliOptions */
  const char *value, *help;
} FileOption;

#define MEMBER(name) offsetof (CliOptions, name)

static const FileOption files[] = {
  { "drawing", CLI_ORDER | OF_LEVELS, OF_LEVELS, INPUT, MEMBER (drawing), "DRAWING",
    "the drawing that belongs to it" },
  { "scribbles", WITH_LAYERS, 0, INPUT, MEMBER (scribbles), "PICTURE", "scribbles, one colour a region" },
  { "contours", WITH_INK, 0, INPUT, MEMBER (contours), "PICTURE",
    "virtual contours: red cuts, blue cuts regions only, green erases ink" },
  { "corrections", CLI_POPUP | CLI_LAYERS, 0, INPUT, MEMBER (corrections), "PICTURE",
    "strokes over ink that give it to the region of their colour" },
  { "arrows", WITH_LAYERS | CLI_ORDER, 0, INPUT, MEMBER (arrows), "PICTURE", "arrows from nearer to farther parts" },
  { "anchors", CLI_SMOOTH, 0, INPUT, MEMBER (anchors), "PICTURE",
    "painted pixels keep their level; without: the inner core of each region" },
  { "relations", WITH_LAYERS | CLI_ORDER, 0, TEXT, MEMBER (relations), "TEXT",
    "relations such as '120,80 > 300,90; #ff0000 = #00ff00'" },
  { "relations-file", WITH_LAYERS | CLI_ORDER, 0, INPUT, MEMBER (relations_file), "FILE", "a file with such text" },
  { "arrow-path", WITH_LAYERS | CLI_ORDER, 0, TEXT, MEMBER (arrow_path), "PATH",
    "arrows as SVG path data such as 'M 120,80 L 300,90', the nearer end first" },
  { "depth-hint", GIVES_LABELS | CLI_ORDER, 0, INPUT, MEMBER (depth_hint), "PICTURE",
    "depth from elsewhere, near = white: suggestions come from it, too" },
  { "labels", GIVES_LABELS, 0, OUTPUT, MEMBER (labels), "OUT", "write regions in the colours of their scribbles" },
  { "closures", GIVES_LABELS, 0, OUTPUT, MEMBER (closures), "OUT",
    "write the gaps that were closed, as red contours on a transparent layer" },
  { "suggestions", GIVES_LABELS | CLI_ORDER, 0, REPORT, MEMBER (suggestions), "OUT",
    "write which part seems to be in front, as relations with a confidence" },
  { "suggested-arrows", GIVES_LABELS, 0, OUTPUT, MEMBER (suggested_arrows), "OUT",
    "write the same as arrows on a transparent layer" },
  { "order", CLI_POPUP, 0, OUTPUT, MEMBER (order), "OUT", "write levels before contours are given to their owners" },
  { "levels", CLI_POPUP | CLI_ORDER | CLI_EXPAND, CLI_ORDER | CLI_EXPAND, OUTPUT, MEMBER (levels), "OUT",
    "write levels" },
  { "depth", CLI_POPUP | CLI_SMOOTH | CLI_EXACT, CLI_SMOOTH | CLI_EXACT, OUTPUT, MEMBER (depth), "OUT",
    "write smooth depth" },
  { "regions", CLI_EXPAND, 0, INPUT, MEMBER (regions), "PICTURE",
    "regions as segment wrote them: tells parts of one level apart" },
  { "art", CLI_ENHANCE | CLI_SHADE, 0, INPUT, MEMBER (art), "PICTURE", "the picture that shadows or light fall on" },
  { "depth", CLI_SHADE | CLI_RELIEF, 0, INPUT, MEMBER (smooth_depth), "DEPTH",
    "smooth depth, as popup or smooth wrote it: where relief has the parts (without, it is made of the levels), which "
    "side of strokes inside a part shade bends (see --quilt)" },
  { "hints", CLI_SHADE, 0, INPUT, MEMBER (hints), "PICTURE",
    "paint beside lines: a white side bends, a black one does not, at grey both do" },
  { "matcap", CLI_SHADE, 0, INPUT, MEMBER (matcap), "PICTURE", "the picture of a lit ball, to shade like it" },
  { "grid", CLI_SHADE, 0, TEXT, MEMBER (grid), "COLUMNSxROWS",
    "a sheet of sprites, each of which is shaded by itself" },
  { "enhanced", CLI_ENHANCE, 0, OUTPUT, MEMBER (enhanced), "OUT", "write the art with its shadows" },
  { "shadow", CLI_ENHANCE, 0, OUTPUT, MEMBER (shadow), "OUT", "write the shadows alone, as a black layer" },
  { "view", CLI_ENHANCE, 0, OUTPUT, MEMBER (view), "OUT", "write a grey picture of depth with shadows" },
  { "normals", CLI_POPUP | CLI_SHADE, 0, OUTPUT, MEMBER (normals), "OUT", "write normals" },
  { "shading", CLI_POPUP | CLI_SHADE, 0, OUTPUT, MEMBER (shading), "OUT", "write shading" },
  { "shaded", CLI_SHADE, 0, OUTPUT, MEMBER (shaded), "OUT", "write the art, or the drawing, as the light falls on it" },
  { "tone", CLI_SHADE, 0, OUTPUT, MEMBER (tone), "OUT", "write the layer that art is multiplied by" },
  { "rim", CLI_SHADE, 0, OUTPUT, MEMBER (rim), "OUT", "write highlights and rims, as a white layer to put over that" },
  { "occlusion", CLI_SHADE, 0, OUTPUT, MEMBER (occlusion), "OUT", "write how much light parts leave to those behind" },
  { "maps", CLI_SHADE, 0, TEXT, MEMBER (maps), "NAME.png",
    "write maps for game engines: NAME_n.png (normals), NAME_o.png (occlusion), NAME_s.png (specular)" },
  { "padding", CLI_SHADE, 0, TEXT, MEMBER (padding_text), "0-64",
    "how many transparent pixels round a sprite its maps fill; 4" },
  { "left", CLI_STEREO, 0, OUTPUT, MEMBER (left), "OUT", "write what the left eye sees" },
  { "right", CLI_STEREO, 0, OUTPUT, MEMBER (right), "OUT", "write what the right eye sees" },
  { "joined", CLI_STEREO, 0, JOINED, MEMBER (stereo), "OUT",
    "write both in one picture, see --stereo; or in one .mpo file" },
  { "quilt", CLI_STEREO, 0, OUTPUT, MEMBER (quilt), "OUT", "write --views as tiles of one picture, see --columns" },
  { "sequence", CLI_STEREO, 0, FRAMES, MEMBER (sequence), "OUT",
    "write --views one by one: .mpo, .gif, or a folder of PNG files" },
  { "output", CLI_WIGGLE, CLI_WIGGLE, FRAMES, MEMBER (wiggle), "OUT",
    "write the moving picture: .gif, or a folder of PNG files" },
  { "colours", CLI_LAYERS | FROM_THE_SIDE | CLI_RELIEF, 0, INPUT, MEMBER (colours), "PICTURE",
    "what is cut, or laid over the mesh, instead of the drawing" },
  { "light", CLI_LAYERS, 0, TEXT, MEMBER (light), "encoded|linear",
    "what the layers are composited in: encoded colours (Krita), linear light (GIMP 3); encoded, but for .exr" },
  { "output", CLI_LAYERS, CLI_LAYERS, STACK, MEMBER (output), "OUT",
    "write layers: .ora (OpenRaster), .exr (a part each), or a folder of PNG files" },
  { "height", CLI_RELIEF, 0, OUTPUT, MEMBER (height), "OUT", "write heights, in pixels; .png from least to largest" },
  { "mesh", CLI_RELIEF, 0, MESH, MEMBER (mesh), "OUT", "write a mesh: .glb, .obj, .ply, or .stl for printing" },
  { "report", WITH_LAYERS | CLI_ORDER, 0, REPORT, MEMBER (report), "OUT", "write what was found, as JSON" },
};

static char **
file_name (CliOptions *options, const FileOption *file)
{
  return (char **) ((char *) options + file->offset);
}

/* ------------------------------------------------------------------ settings */

typedef enum { CHOICE, NUMBER, INTEGER, SWITCH, TRUTH, COLOUR } SettingKind; /* a switch is on when it is there */

typedef struct
{
  const char *name;
  int         steps;
  SettingKind kind;
  size_t      offset;      /* in CeldSettings */
  const char *value;       /* of a choice: its words in the order of the enumeration; of a truth: no|yes */
  const char *help;
} SettingOption;

#undef MEMBER
#define MEMBER(name) offsetof (CeldSettings, name)

static const SettingOption settings[] = {
  { "ink", WITH_INK, CHOICE, MEMBER (ink), "auto|dark|light|alpha", "what is ink" },
  { "ink-threshold", MADE_OF_LABELS | CLI_SMOOTH | CLI_SHADE | CLI_RELIEF, NUMBER, MEMBER (ink_threshold), "0-0.99",
    "ink at or below this is full ink; 0.25" },
  { "method", MADE_OF_LABELS, CHOICE, MEMBER (method), "basins|exact|walker",
    "find regions at the speed of the brush, by slow exact cuts, or a random walker" },
  { "close-gaps", MADE_OF_LABELS, TRUTH, MEMBER (close_gaps), "no|yes",
    "borders across paper run from line end to line end; yes" },
  { "keep-necks", MADE_OF_LABELS, TRUTH, MEMBER (keep_necks), "no|yes",
    "parts with strokes of one colour keep it behind narrow necks; yes" },
  { "hardness", MADE_OF_LABELS, NUMBER, MEMBER (hardness), "0.01-1",
    "1 obeys every stroke, less lets the majority win; 0.05" },
  { "flats", WITH_LAYERS, SWITCH, MEMBER (flats), NULL, "the scribbles are a flat colouring" },
  { "background", WITH_LAYERS | CLI_ORDER, CHOICE, MEMBER (background), "auto|none|colour",
    "which region is the background" },
  { "background-colour", WITH_LAYERS | CLI_ORDER, COLOUR, MEMBER (background_colour), "#RRGGBB",
    "the scribble colour that is the background" },
  { "seeds", MADE_OF_LABELS, CHOICE, MEMBER (seeds), "auto|scribbles", "may arrows make regions of their own?" },
  { "same-colour", WITH_LAYERS | CLI_ORDER, CHOICE, MEMBER (same_colour), "one|separate",
    "regions of one colour have one depth, or each its own" },
  { "on-cycle", CLI_POPUP | CLI_LAYERS | FROM_THE_SIDE | CLI_ORDER | CLI_EXACT, CHOICE, MEMBER (on_cycle),
    "report|drop-weakest|split",
    "of relations that contradict, leave out lighter and later ones, or the least weight in sum; or split regions" },
  { "suggest", CLI_POPUP | CLI_LAYERS | FROM_THE_SIDE | CLI_ORDER, CHOICE, MEMBER (suggest), "off|fill-gaps|all",
    "order by suggestions, too: none, where relations leave it open, all; off" },
  { "arrow-style", WITH_LAYERS | CLI_ORDER, CHOICE, MEMBER (arrow_style), "head|dot|fade|taper",
    "how arrows are painted" },
  { "encoding", CLI_POPUP | CLI_ORDER | CLI_EXACT, CHOICE, MEMBER (encoding), "normalized|rank|fixed",
    "how levels become numbers" },
  { "near-level", CLI_POPUP | CLI_ORDER | CLI_EXACT, NUMBER, MEMBER (near_level), "N",
    "with fixed encoding, the level that becomes 1" },
  { "far-level", CLI_POPUP | CLI_ORDER | CLI_EXACT, NUMBER, MEMBER (far_level), "N",
    "with fixed encoding, the level that becomes 0" },
  { "complete", CLI_LAYERS, TRUTH, MEMBER (complete), "no|yes", "layers have what nearer ones hide, too; no" },
  { "expansion", CLI_POPUP | CLI_LAYERS | FROM_THE_SIDE, CHOICE, MEMBER (expansion), "outlines|thickness",
    "who gets the ink: outlines of one pen each, or by the thickness of contours" },
  { "method", CLI_EXPAND, CHOICE, MEMBER (expansion), "outlines|thickness",
    "outlines of one pen each, or by the thickness of contours" },
  { "anchors", CLI_POPUP | FROM_THE_SIDE, CHOICE, MEMBER (anchors), "scribbles|arrows|both|core",
    "which pixels keep their level in smooth depth" },
  { "hold-rest", CLI_POPUP | FROM_THE_SIDE | CLI_SMOOTH, TRUTH, MEMBER (hold_rest), "no|yes",
    "regions without an anchor keep their level in their core; yes" },
  { "tolerance", CLI_POPUP | CLI_SMOOTH | CLI_EXACT | CLI_RELIEF, NUMBER, MEMBER (tolerance), "0-0.1",
    "largest error of smooth depth; 0.0001" },
  { "contrast", CLI_EXACT, NUMBER, MEMBER (contrast), "0.01-100",
    "how large a step of the ink parts depths, as a factor of the mean; 1" },
  { "weight-floor", CLI_EXACT, NUMBER, MEMBER (weight_floor), "0.000001-1",
    "how strongly neighbours hold together at least; 0.000001" },
  { "bulge", CLI_POPUP | CLI_SHADE | CLI_RELIEF, NUMBER, MEMBER (bulge), "0-4", "0 flat, 1 round" },
  { "bevel", CLI_SHADE, NUMBER, MEMBER (bevel), "0-0.5",
    "how far parts bend from their outlines, as a share of the diagonal; 0: they are round all over" },
  { "quilt", CLI_SHADE, NUMBER, MEMBER (quilt), "0-1", "how much parts bend at strokes inside them; 0" },
  { "frame-outline", CLI_SHADE, TRUTH, MEMBER (frame_outline), "no|yes",
    "parts that run out of the picture bend at its frame; no" },
  { "light-model", CLI_SHADE, CHOICE, MEMBER (light_model), "lambert|half-lambert|toon|matcap",
    "soft, softer, in steps, or like the ball of --matcap; lambert" },
  { "toon-steps", CLI_SHADE, INTEGER, MEMBER (toon_steps), "2-5", "steps of toon shading; 3" },
  { "light", CLI_SHADE, CHOICE, MEMBER (light), "direction|point", "light from far away, or from a point; direction" },
  { "light-x", CLI_SHADE, NUMBER, MEMBER (light_x), "-10..10", "of a point of light: 0 left, 1 right edge; 0.3" },
  { "light-y", CLI_SHADE, NUMBER, MEMBER (light_y), "-10..10", "of a point of light: 0 upper, 1 lower edge; 0.2" },
  { "light-height", CLI_SHADE, NUMBER, MEMBER (light_height), "0.001-10",
    "how far a point of light is before the picture, as a share of the diagonal; 0.3" },
  { "specular", CLI_SHADE, NUMBER, MEMBER (specular), "0-1", "how bright highlights are; 0" },
  { "shininess", CLI_SHADE, NUMBER, MEMBER (shininess), "1-1000", "how small highlights are; 30" },
  { "rim-light", CLI_SHADE, NUMBER, MEMBER (rim_light), "0-1", "how bright rims are; 0" },
  { "rim-power", CLI_SHADE, NUMBER, MEMBER (rim_power), "0.1-20", "how narrow rims are; 3" },
  { "light-azimuth", CLI_POPUP | CLI_SHADE | CLI_ENHANCE, NUMBER, MEMBER (light_azimuth), "DEGREES",
    "0 from the right, 90 from above; 135" },
  { "light-elevation", CLI_POPUP | CLI_SHADE, NUMBER, MEMBER (light_elevation), "DEGREES", "90 from the viewer; 45" },
  { "ambient", CLI_POPUP | CLI_SHADE, NUMBER, MEMBER (ambient), "0-1", "light that reaches every pixel; 0.25" },
  { "disparity", CLI_STEREO, NUMBER, MEMBER (disparity), "0-0.2",
    "how far the nearest and the farthest lie apart for two eyes, as a share of the width; 0.02" },
  { "disparity", CLI_WIGGLE, NUMBER, MEMBER (disparity), "0-0.2",
    "how far the nearest moves before the farthest, as a share of the width; 0.05" },
  { "convergence", FROM_THE_SIDE, NUMBER, MEMBER (convergence), "0-1",
    "which depth lies on the screen, and stays where it is: 1 the nearest; 0.5" },
  { "floating-window", CLI_STEREO, TRUTH, MEMBER (floating_window), "no|yes",
    "bars at the sides before what the frame cuts in front of the screen; no" },
  { "screen-width", CLI_STEREO, NUMBER, MEMBER (screen_width), "MM",
    "how wide the picture will be shown: warns where eyes would have to look apart" },
  { "stereo", CLI_STEREO, CHOICE, MEMBER (stereo),
    "left|right|side-by-side|half-side-by-side|crossed|over-under|half-over-under|interlaced|columns|"
    "grey|colour|half-colour|dubois",
    "how --joined has both views; the last four are for red and cyan glasses; side-by-side" },
  { "path", CLI_WIGGLE, CHOICE, MEMBER (path), "sway|circle|turntable",
    "how the camera moves: from side to side, in a circle, or as if the drawing turned; sway" },
  { "enhance", CLI_ENHANCE, CHOICE, MEMBER (enhance), "stack|darken|contrast",
    "soft shadows on what is behind; or darker behind borders of depth, or also lighter before them" },
  { "shadow-size", CLI_ENHANCE | CLI_SHADE, NUMBER, MEMBER (shadow_size), "0.0005-0.2",
    "how far shadows spread, as a share of the diagonal; 0.012" },
  { "shadow-strength", CLI_ENHANCE | CLI_SHADE, NUMBER, MEMBER (shadow_strength), "0-1", "how dark shadows are; 0.6" },
  { "shadow-offset", CLI_ENHANCE, NUMBER, MEMBER (shadow_offset), "0-0.2",
    "how far shadows fall away from the light, as a share of the diagonal; 0" },
  { "shadow-range", CLI_ENHANCE, NUMBER, MEMBER (shadow_range), "0-1",
    "from this share of all depth on shadows are full; 0" },
  { "from", CLI_RELIEF, CHOICE, MEMBER (relief_from), "inflation|normals",
    "parts bulge by inflation, or as their normals say; inflation" },
  { "relief-depth", CLI_RELIEF, NUMBER, MEMBER (relief_depth), "0-1",
    "how far the nearest level stands before the farthest, as a share of the diagonal; 0.1" },
  { "mesh-kind", CLI_RELIEF, CHOICE, MEMBER (mesh), "auto|surface|solid",
    "a surface with cracks where depth jumps, or closed, on a plate; auto: solid for .stl" },
  { "mesh-size", CLI_RELIEF, NUMBER, MEMBER (mesh_size), "1-10000",
    "length of the picture's longer side in millimetres; 100" },
  { "mesh-plate", CLI_RELIEF, NUMBER, MEMBER (mesh_plate), "0.1-1000", "thickness of the plate in millimetres; 2" },
  { "mesh-error", CLI_RELIEF, NUMBER, MEMBER (mesh_error), "0.01-100",
    "how far the mesh may be from the heights, in pixels; 0.5" },
  { "most-vertices", CLI_RELIEF, NUMBER, MEMBER (most_vertices), "1000-16000000",
    "with more, the mesh is made coarser; 1000000" },
};

/* ------------------------------------------------------------------ words and values */

/* The place of a word in "a|b|c"; -1 if it is not there. */
static int
find_word (const char *words, const char *word)
{
  char **list = g_strsplit (words, "|", 0);
  int    found = -1;

  for (int i = 0; list[i] && found < 0; i++)
    if (!strcmp (list[i], word))
      found = i;
  g_strfreev (list);
  return found;
}

static bool
set_colour (CeldSettings *to, const char *value)
{
  unsigned colour = 0;
  int      n = 0;

  value += value[0] == '#';
  while (g_ascii_isxdigit (value[n]) && n < 7)
    colour = colour * 16 + (unsigned) g_ascii_xdigit_value (value[n++]);
  for (int i = 0; i < 3; i++)
    to->background_colour[i] = (uint8_t) (colour >> (16 - 8 * i));
  to->background = CELD_BACKGROUND_COLOUR;
  return n == 6 && !value[n];
}

static bool
set_setting (const SettingOption *setting, const char *value, CeldSettings *to)
{
  char  *place = (char *) to + setting->offset;
  char  *end;
  int    word;
  double number;

  switch (setting->kind)
    {
    case CHOICE:
      /* Every enumeration of CeldSettings is as large as any other. */
      word = find_word (setting->value, value);
      if (word >= 0)
        memcpy (place, &word, sizeof word);
      return word >= 0;
    case NUMBER:
      number = g_ascii_strtod (value, &end);
      *(float *) place = (float) number;
      return end != value && !*end;
    case INTEGER:
      *(int *) place = (int) CLAMP (g_ascii_strtoll (value, &end, 10), -9999, 9999);
      return end != value && !*end;
    case SWITCH:
      *(bool *) place = true;
      return true;
    case TRUTH:
      word = find_word (setting->value, value);
      *(bool *) place = word == 1;
      return word >= 0;
    case COLOUR:
      return set_colour (to, value);
    }
  return false;
}

/* One setting of the command line: right by itself? */
static gboolean
take_setting (const char *name, const char *value, gpointer data, GError **error)
{
  CliOptions          *options = data;
  const SettingOption *setting = settings;
  CeldSettings         alone = celd_settings ();

  while (strcmp (setting->name, name + 2) || !(setting->steps & (int) options->step))
    setting++;
  if (set_setting (setting, value, &alone) && celd_settings_check (&alone) == CELD_OK)
    {
      options->background_colour = options->background_colour || setting->kind == COLOUR;
      return set_setting (setting, value, &options->settings);
    }
  g_set_error (error, G_OPTION_ERROR, G_OPTION_ERROR_BAD_VALUE, "%s cannot be '%s'; it takes %s.", name, value,
               setting->value);
  return FALSE;
}

/* ------------------------------------------------------------------ parsing */

static void
append_entries (const CliCommand *command, CliOptions *options, GArray *entries)
{
  for (size_t i = 0; i < G_N_ELEMENTS (files); i++)
    if (files[i].steps & (int) command->step)
      g_array_append_val (entries, ((GOptionEntry) {
        files[i].name, 0, 0, files[i].kind == TEXT ? G_OPTION_ARG_STRING : G_OPTION_ARG_FILENAME,
        file_name (options, &files[i]), files[i].help, files[i].value }));
  for (size_t i = 0; i < G_N_ELEMENTS (settings); i++)
    if (settings[i].steps & (int) command->step)
      g_array_append_val (entries, ((GOptionEntry) {
        settings[i].name, 0, settings[i].kind == SWITCH ? G_OPTION_FLAG_NO_ARG : 0, G_OPTION_ARG_CALLBACK,
        (gpointer) take_setting, settings[i].help, settings[i].value }));
  cli_counts_append (command, entries);
}

/* GOption's part. */
static bool
parse (const CliCommand *command, int *argc, char ***argv, CliOptions *options)
{
  GArray         *entries = g_array_new (TRUE, TRUE, sizeof (GOptionEntry));
  GOptionContext *context = g_option_context_new (command->input);
  GOptionGroup   *group = g_option_group_new ("main", "", "", options, NULL);
  char           *description = g_strdup_printf ("Examples:\n%s\n", command->examples);
  char           *program = g_strdup_printf ("celdepth %s", command->name);
  gboolean        quiet = FALSE, directx = FALSE;
  GError         *error = NULL;
  bool            good;

  append_entries (command, options, entries);
  if (command->step == CLI_SHADE)
    g_array_append_val (entries, ((GOptionEntry) {
      "directx", 0, 0, G_OPTION_ARG_NONE, &directx, "green of normals points down, as DirectX wants it", NULL }));
  g_array_append_val (entries, ((GOptionEntry) {
    "quiet", 'q', 0, G_OPTION_ARG_NONE, &quiet, "neither progress nor remarks", NULL }));
  g_option_group_add_entries (group, (const GOptionEntry *) (void *) entries->data);
  g_option_context_set_main_group (context, group);
  g_option_context_set_summary (context, command->summary);
  g_option_context_set_description (context, description);
  g_set_prgname (program);
  good = g_option_context_parse (context, argc, argv, &error);
  options->quiet   = quiet;
  options->directx = directx;
  if (!good)
    cli_say ("%s", error->message);
  g_clear_error (&error);
  g_option_context_free (context);
  g_array_free (entries, TRUE);
  g_free (description);
  g_free (program);
  return good;
}

static bool
same_file (const char *a, const char *b)
{
  char *full_a = g_canonicalize_filename (a, NULL), *full_b = g_canonicalize_filename (b, NULL);
  bool  same = !strcmp (full_a, full_b);

  g_free (full_a);
  g_free (full_b);
  return same;
}

/* Each output has a name of its own, and an ending that can be written. */
static bool
check_files (const CliCommand *command, CliOptions *options)
{
  int outputs = 0;

  for (size_t i = 0; i < G_N_ELEMENTS (files); i++)
    {
      const char *name = *file_name (options, &files[i]);

      if (!name && files[i].required & (int) command->step)
        return cli_error ("--%s is missing.", files[i].name);
      if (!name || files[i].kind < OUTPUT)
        continue;
      outputs++;
      if (files[i].kind == OUTPUT && !cli_can_write (name))
        return cli_error ("--%s %s: the ending must be .png, .exr, .tif or .npy.", files[i].name, name);
      if (files[i].kind == JOINED && !cli_can_write (name) && celd_io_frames_kind (name) != CELD_IO_MPO)
        return cli_error ("--%s %s: the ending must be .png, .exr, .tif, .npy or .mpo.", files[i].name, name);
      if (files[i].kind == FRAMES && !celd_io_frames_kind (name))
        return cli_error ("--%s %s: the ending must be .gif or .mpo, or none for a folder.", files[i].name, name);
      if (files[i].kind == STACK && !celd_io_stack_kind (name))
        return cli_error ("--%s %s: the ending must be .ora or .exr, or none for a folder.", files[i].name, name);
      if (files[i].kind == MESH && !celd_io_mesh_kind (name))
        return cli_error ("--%s %s: the ending must be .glb, .obj, .ply or .stl.", files[i].name, name);
      if (same_file (name, options->input))
        return cli_error ("--%s would overwrite %s.", files[i].name, options->input);
      for (size_t k = 0; k < G_N_ELEMENTS (files); k++)
        {
          const char *other = *file_name (options, &files[k]);

          if (k != i && other && files[k].kind != TEXT && same_file (name, other))
            return cli_error ("--%s and --%s name the same file.", files[i].name, files[k].name);
        }
    }
  if (options->enhanced && !options->art)
    return cli_error ("--enhanced needs --art.");
  return outputs || options->maps || cli_error ("Nothing to write: name at least one output, such as --%s.",
                               command->step == CLI_SHADE ? "shading"
                               : command->step == CLI_ENHANCE ? "enhanced"
                               : command->step == CLI_STEREO ? "joined"
                               : command->step == CLI_RELIEF ? "mesh"
                               : command->step == CLI_SEGMENT ? "labels" : "depth");
}

bool
cli_is_device (const char *path)
{
  return g_file_test (path, G_FILE_TEST_EXISTS) && !g_file_test (path, G_FILE_TEST_IS_REGULAR) &&
         !g_file_test (path, G_FILE_TEST_IS_DIR);
}

static bool
is_empty (const char *folder)
{
  GDir *open = g_dir_open (folder, 0, NULL);
  bool  empty = open && !g_dir_read_name (open);

  if (open)
    g_dir_close (open);
  return empty;
}

/* Pictures and layers are written beside their name and moved there; a report may go to a device. */
static bool
check_place (const char *name, FileKind kind)
{
  char *plain = g_canonicalize_filename (name, NULL), *folder = g_path_get_dirname (plain); /* without a last slash */
  bool  device = cli_is_device (name), good = true;

  if (g_file_test (name, G_FILE_TEST_IS_DIR) &&
      ((kind == STACK && celd_io_stack_kind (name) == CELD_IO_FOLDER) ||
       (kind == FRAMES && celd_io_frames_kind (name) == CELD_IO_PNG_FRAMES)))
    good = is_empty (name) || cli_error ("Cannot write \"%s\": it is a folder that is not empty.", name);
  else if (g_file_test (name, G_FILE_TEST_IS_DIR))
    good = cli_error ("Cannot write \"%s\": it is a folder.", name);
  else if (device && kind != REPORT)
    good = cli_error ("Cannot write \"%s\": it is not an ordinary file.", name);
  else if (!device && g_access (folder, W_OK))
    good = cli_error ("Cannot write \"%s\": its folder: %s.", name, g_strerror (errno));
  g_free (folder);
  g_free (plain);
  return good;
}

/* Maps are named after another file than those that they are written to. */
static bool
check_maps (const CliOptions *options)
{
  bool good = true;

  for (int map = 0; good && options->maps && map < CLI_MAPS; map++)
    {
      char *name = cli_map_name (options->maps, map);

      if (same_file (name, options->input) || same_file (name, options->drawing))
        good = cli_error ("--maps would overwrite %s.", name);
      good = good && check_place (name, OUTPUT);
      g_free (name);
    }
  return good;
}

/* Before the work rather than after it. */
static bool
check_places (CliOptions *options)
{
  bool good = true;

  for (size_t i = 0; good && i < G_N_ELEMENTS (files); i++)
    {
      const char *name = *file_name (options, &files[i]);

      good = !name || files[i].kind < OUTPUT || check_place (name, files[i].kind);
    }
  return good && check_maps (options);
}

static bool
check (const CliCommand *command, int argc, char **argv, CliOptions *options)
{
  if (argc != 2)
    return cli_error (argc < 2 ? "%s is missing." : "More than one %s was given.", command->input);
  options->input = g_strdup (argv[1]);
  cli_counts_complete (options);
  if (options->light && find_word ("encoded|linear", options->light) < 0)
    return cli_error ("--light cannot be '%s'; it takes encoded|linear.", options->light);
  if (options->light && !strcmp (options->light, "encoded") && options->output &&
      celd_io_stack_kind (options->output) == CELD_IO_EXR_PARTS)
    return cli_error ("--light encoded is not for .exr, whose colours are linear light.");
  if (options->relations && options->relations_file)
    return cli_error ("Give --relations or --relations-file, not both.");
  if (options->settings.background == CELD_BACKGROUND_COLOUR && !options->background_colour)
    return cli_error ("--background colour needs --background-colour.");
  if (celd_settings_check (&options->settings) != CELD_OK)
    return cli_error ("--near-level must be above --far-level.");
  return (command->step != CLI_SHADE || cli_shade_check (options)) && check_files (command, options);
}

int
cli_options_parse (const CliCommand *command, int argc, char **argv, CliOptions *options)
{
  *options = (CliOptions) { .step = command->step, .settings = celd_settings () };
  if (command->step == CLI_WIGGLE)
    options->settings.disparity = WIGGLE_DISPARITY;
  if (parse (command, &argc, &argv, options) && check (command, argc, argv, options))
    return check_places (options) ? CLI_DONE : CLI_FAILED;
  fprintf (stderr, "'celdepth %s --help' shows how it is used.\n", command->name);
  return CLI_USAGE;
}

void
cli_options_clear (CliOptions *options)
{
  for (size_t i = 0; i < G_N_ELEMENTS (files); i++)
    g_free (*file_name (options, &files[i]));
  g_free (options->input);
}
