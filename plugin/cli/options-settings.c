/* Every member of CeldSettings that a sub-command uses, under the name that the property of the GEGL operations has.
 * Numbers have a point in every language.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "options.h"

#include <stddef.h>
#include <string.h>

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

int
cli_find_word (const char *words, const char *word)
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
      word = cli_find_word (setting->value, value);
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
      word = cli_find_word (setting->value, value);
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

void
cli_settings_append (const CliCommand *command, GArray *entries)
{
  for (size_t i = 0; i < G_N_ELEMENTS (settings); i++)
    if (settings[i].steps & (int) command->step)
      g_array_append_val (entries, ((GOptionEntry) {
        settings[i].name, 0, settings[i].kind == SWITCH ? G_OPTION_FLAG_NO_ARG : 0, G_OPTION_ARG_CALLBACK,
        (gpointer) take_setting, settings[i].help, settings[i].value }));
}
