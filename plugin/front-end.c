/* Tables of what plug-ins offer, and how scripts name it.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "front-end.h"
#include "translate.h"

#include <math.h>
#include <string.h>

const char *const celd_layer_arguments[CELD_N_LAYERS] = {
  [CELD_LAYER_DRAWING]  = "drawing",  [CELD_LAYER_SCRIBBLES]   = "scribbles",   [CELD_LAYER_ARROWS] = "arrows",
  [CELD_LAYER_CONTOURS] = "contours", [CELD_LAYER_CORRECTIONS] = "corrections", [CELD_LAYER_HIDDEN] = "hidden",
};

const char *const celd_layer_help[CELD_N_LAYERS] = {
  [CELD_LAYER_DRAWING]     = N_ ("The line drawing; in colours it is also the art that is lit"),
  [CELD_LAYER_SCRIBBLES]   = N_ ("One stroke over each part, in a colour of its own"),
  [CELD_LAYER_ARROWS]      = N_ ("Arrows that point from nearer to farther parts"),
  [CELD_LAYER_CONTOURS]    = N_ ("Virtual contours. Red: a boundary of regions and depth; blue: a boundary of regions "
                                 "across which depth stays smooth; green: ink that is not a boundary"),
  [CELD_LAYER_CORRECTIONS] = N_ ("Strokes over lines, in the colour of the part that a line belongs to"),
  [CELD_LAYER_HIDDEN]      = N_ ("What is hidden: strokes in a part's colour where it goes on behind nearer ones, "
                                 "black where it does not"),
};

const CeldPictureInfo celd_pictures[CELD_POPUP_PICTURES] = {
  [CELD_PICTURE_REGIONS]  = { "regions", "labels", N_ ("_Regions"), N_ ("The parts as flat colours"),
                              N_ ("Regions"), TRUE, TRUE },
  [CELD_PICTURE_LEVELS]   = { "levels", "levels", N_ ("Le_vels"),
                              N_ ("The depth of each part, in steps; nearer is lighter"), N_ ("Levels"), FALSE, FALSE },
  [CELD_PICTURE_DEPTH]    = { "depth", "depth", N_ ("_Depth"), N_ ("Smooth depth; nearer is lighter"), N_ ("Depth"),
                              FALSE, TRUE },
  [CELD_PICTURE_NORMALS]  = { "normals", "normals", N_ ("_Normal map"),
                              N_ ("Which way the rounded parts face, for lighting elsewhere"), N_ ("Normal map"),
                              FALSE, FALSE },
  [CELD_PICTURE_SHADING]  = { "shading", "shading", N_ ("S_hading"), N_ ("The light alone, as greys"), N_ ("Shading"),
                              FALSE, FALSE },
  [CELD_PICTURE_LIT]      = { "lit", "shaded", N_ ("_Lit drawing"), N_ ("The drawing with light on rounded parts"),
                              N_ ("Lit drawing"), TRUE, TRUE },
  [CELD_PICTURE_ENHANCED] = { "enhanced", "enhanced", N_ ("Drawing with sha_dows"),
                              N_ ("The drawing with soft shadows behind nearer parts"), N_ ("Drawing with shadows"),
                              TRUE, FALSE },
};

const CeldPicture celd_pictures_stacked[CELD_POPUP_PICTURES] = {
  CELD_PICTURE_ENHANCED, CELD_PICTURE_LIT, CELD_PICTURE_SHADING, CELD_PICTURE_NORMALS, CELD_PICTURE_DEPTH,
  CELD_PICTURE_LEVELS, CELD_PICTURE_REGIONS,
};

/* Matcaps need a picture, which these dialogs do not ask for. */
const CeldMainSetting celd_main_settings[CELD_N_MAIN_SETTINGS] = {
  { "light-model", N_ ("Light"), CELD_MODEL_MATCAP }, { "toon-steps", "Light", 0 }, { "light-azimuth", "Light", 0 },
  { "light-elevation", "Light", 0 }, { "ambient", "Light", 0 }, { "specular", "Light", 0 },
  { "rim-light", "Light", 0 }, { "bulge", "Light", 0 }, { "bevel", "Light", 0 },
  { "shadow-strength", "Shadows", 0 }, { "shadow-size", "Shadows", 0 }, { "shadow-offset", "Shadows", 0 },
  { "ink", N_ ("How layers are read"), 0 }, { "arrow-style", "How layers are read", 0 },
  { "close-gaps", "How layers are read", 0 }, { "flats", "How layers are read", 0 },
  { "expansion", "How layers are read", 0 }, { "suggest", "How layers are read", 0 },
};

/* ------------------------------------------------------------------ numbers in dialogs */

CeldShownNumber
celd_shown_number (const CeldSettingInfo *row)
{
  if (row->unit && !strcmp (row->unit, "degree"))
    return (CeldShownNumber) { 1, 0, "°" };
  if (row->type == CELD_SETTING_NUMBER && row->shown.most <= 1)
    return (CeldShownNumber) { 100, MAX (row->shown.digits - 2, 0), "%" };
  return (CeldShownNumber) { 1, MIN (row->shown.digits, 2), row->unit };
}

/* ------------------------------------------------------------------ texts of scripts */

static gboolean
fail (GError **error, const char *format, const char *one, const char *two)
{
  g_set_error (error, CELD_PIPELINE_ERROR, CELD_PIPELINE_FAILED, format, one, two);
  return FALSE;
}

static int
find_picture (const char *argument)
{
  for (int i = 0; i < CELD_POPUP_PICTURES; i++)
    if (!strcmp (argument, celd_pictures[i].argument))
      return i;
  return -1;
}

gboolean
celd_pictures_read (const char *text, guint *wanted, GError **error)
{
  char   **name = g_strsplit_set (text ? text : "", ", ", 0);
  guint    bits = 0;
  gboolean good = TRUE;

  for (int i = 0; name[i] && good; i++)
    if (*name[i])
      {
        int picture = find_picture (name[i]);

        good  = picture >= 0 || fail (error, _ ("There is no picture \"%s\". They are regions, levels, depth, "
                                                "normals, shading, lit and enhanced.%s"), name[i], "");
        bits |= good ? 1u << picture : 0;
      }
  if (good && bits)
    *wanted = bits;
  g_strfreev (name);
  return good;
}

/* The text as a number, a choice as its place; NAN if it is none. */
static double
parse (const CeldSettingInfo *row, const char *value)
{
  char  *end;
  double number;

  if (row->type == CELD_SETTING_SWITCH && (!strcmp (value, "yes") || !strcmp (value, "true")))
    return 1;
  if (row->type == CELD_SETTING_SWITCH && (!strcmp (value, "no") || !strcmp (value, "false")))
    return 0;
  for (size_t i = 0; row->type == CELD_SETTING_CHOICE && i < row->choices; i++)
    if (!strcmp (value, row->choice[i].nick))
      return (double) i;
  number = g_ascii_strtod (value, &end);
  if (end == value || *end || (row->type == CELD_SETTING_INTEGER && number != floor (number)))
    return NAN;
  return row->type == CELD_SETTING_NUMBER || row->type == CELD_SETTING_INTEGER ? number : NAN;
}

gboolean
celd_setting_read (const char *name, const char *value, CeldSettings *settings, GError **error)
{
  const CeldSettingInfo *row = celd_setting_find (name);
  double                 number;

  if (!row)
    return fail (error, _ ("There is no setting \"%s\".%s"), name, "");
  number = parse (row, value);
  if (!celd_setting_allows (row, number))
    return fail (error, _ ("The setting %s cannot be \"%s\"."), name, value);
  celd_setting_set (row, number, settings);
  return TRUE;
}

static gboolean
read_preset (const char *name, CeldSettings *settings, GError **error)
{
  const CeldPreset *preset = celd_preset_find (name);

  if (!preset)
    return fail (error, _ ("There is no preset \"%s\".%s"), name, "");
  celd_preset_fill (preset, settings);
  return TRUE;
}

/* NAME=VALUE, which is cut into its parts. */
static gboolean
read_word (char *word, CeldSettings *settings, GError **error)
{
  char *value = strchr (word, '=');

  if (!value)
    return fail (error, _ ("\"%s\" is no setting: settings are NAME=VALUE.%s"), word, "");
  *value = 0;
  return celd_setting_read (word, value + 1, settings, error);
}

gboolean
celd_settings_read (const char *text, CeldSettings *settings, GError **error)
{
  static const char preset[] = "preset=";
  const size_t      length = sizeof preset - 1;
  char            **word = g_strsplit_set (text ? text : "", " ,\n", 0);
  gboolean          good = TRUE;

  for (int i = 0; word[i] && good; i++) /* first, since other settings count more, wherever they are */
    if (g_str_has_prefix (word[i], preset))
      good = read_preset (word[i] + length, settings, error);
  for (int i = 0; word[i] && good; i++)
    if (*word[i] && !g_str_has_prefix (word[i], preset))
      good = read_word (word[i], settings, error);
  g_strfreev (word);
  return good;
}
