/* The table of presets.
 *
 * Values were chosen by looking at drawings in black and white and at flat-coloured ones.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "presets.h"

#include <glib/gi18n.h>
#include <math.h>
#include <string.h>

const CeldPreset celd_presets[CELD_N_PRESETS] = {
  { "everyday", N_ ("Everyday"), N_ ("Soft light on round parts: the defaults"), NULL, { { NULL, 0 } } },
  { "cel", N_ ("Cel animation"), N_ ("Two flat tones, with a sharp edge between light and shade"), NULL,
    { { "light-model", CELD_MODEL_TOON }, { "toon-steps", 2 }, { "ambient", 0.5 } } },
  { "balloon", N_ ("Shiny balloons"), N_ ("Round parts with highlights and bright rims, best on coloured art"), NULL,
    { { "light-model", CELD_MODEL_HALF_LAMBERT }, { "ambient", 0.2 }, { "specular", 0.6 }, { "rim-light", 0.3 } } },
  { "relief", N_ ("Toy relief"), N_ ("Parts that are flat inside, with thick rounded edges"), NULL,
    { { "bevel", 0.03 }, { "bulge", 2 }, { "ambient", 0.2 }, { "specular", 0.3 } } },
  { "paper", N_ ("Cut paper"), N_ ("Flat sheets that cast shadows away from the light, in the drawing with shadows"),
    "enhanced",
    { { "bulge", 0 }, { "ambient", 0.5 }, { "shadow-strength", 0.8 }, { "shadow-size", 0.008 },
      { "shadow-offset", 0.01 } } },
};

const char *const celd_own_settings_label = N_ ("Own settings");

const CeldPreset *
celd_preset_find (const char *name)
{
  for (int i = 0; i < CELD_N_PRESETS; i++)
    if (!strcmp (name, celd_presets[i].name))
      return &celd_presets[i];
  return NULL;
}

static gboolean
has_setting (const CeldPreset *preset, const char *setting)
{
  for (const CeldPresetValue *v = preset->value; v->setting; v++)
    if (!strcmp (v->setting, setting))
      return TRUE;
  return FALSE;
}

gboolean
celd_preset_covers (const char *setting)
{
  for (int i = 0; i < CELD_N_PRESETS; i++)
    if (has_setting (&celd_presets[i], setting))
      return TRUE;
  return FALSE;
}

/* Whether a setting has a value, as far as a dialog shows its digits. */
static gboolean
is_same (const CeldSettingInfo *row, double value, const CeldSettings *settings)
{
  return fabs (celd_setting_get (row, settings) - value) < 0.5 * pow (10, -row->shown.digits);
}

void
celd_preset_fill (const CeldPreset *preset, CeldSettings *settings)
{
  for (const CeldPresetValue *v = preset->value; v->setting; v++)
    {
      const CeldSettingInfo *row = celd_setting_find (v->setting);

      if (is_same (row, row->usual, settings))
        celd_setting_set (row, v->value, settings);
    }
}

void
celd_preset_choose (const CeldPreset *preset, CeldSettings *settings)
{
  size_t                 n;
  const CeldSettingInfo *row = celd_setting_infos (&n);

  for (size_t i = 0; i < n; i++)
    if (celd_preset_covers (row[i].name))
      celd_setting_set (&row[i], row[i].usual, settings);
  celd_preset_fill (preset, settings);
}

const CeldPreset *
celd_preset_of (const CeldSettings *settings)
{
  size_t                 n;
  const CeldSettingInfo *row = celd_setting_infos (&n);

  for (int i = 0; i < CELD_N_PRESETS; i++)
    {
      CeldSettings wanted = *settings;
      gboolean     same = TRUE;

      celd_preset_choose (&celd_presets[i], &wanted);
      for (size_t j = 0; j < n && same; j++)
        same = !celd_preset_covers (row[j].name) || is_same (&row[j], celd_setting_get (&row[j], &wanted), settings);
      if (same)
        return &celd_presets[i];
    }
  return NULL;
}
