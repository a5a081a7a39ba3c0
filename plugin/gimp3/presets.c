/* Presets: the argument of scripts, and the choice at the top of the dialog.
 *
 * What is kept with an image are the settings themselves; which preset they are follows from them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "gimp3.h"

#include <string.h>

#define ARGUMENT "preset"

void
celd_preset_add_argument (GimpProcedure *procedure)
{
  GimpChoice *choice = gimp_choice_new ();

  for (int i = 0; i < CELD_N_PRESETS; i++)
    gimp_choice_add (choice, celd_presets[i].name, i, _ (celd_presets[i].label), _ (celd_presets[i].help));
  gimp_choice_add (choice, CELD_OWN_SETTINGS, CELD_N_PRESETS, _ (celd_own_settings_label), NULL);
  gimp_procedure_add_choice_argument (procedure, ARGUMENT, _ ("Loo_k"),
                                      _ ("Settings of light and shadows that go together, and may be changed below. "
                                         "For scripts: those that do not have their default count more"),
                                      choice, celd_presets[0].name, G_PARAM_READWRITE);
}

/* NULL: own settings. */
static const CeldPreset *
chosen_preset (GimpProcedureConfig *config)
{
  int i = gimp_procedure_config_get_choice_id (config, ARGUMENT);

  return i < CELD_N_PRESETS ? &celd_presets[i] : NULL;
}

static void
make_picture (GimpProcedureConfig *config, const CeldPreset *preset)
{
  if (preset->picture)
    g_object_set (config, preset->picture, TRUE, NULL);
}

void
celd_preset_apply (GimpProcedureConfig *config)
{
  const CeldPreset *preset = chosen_preset (config);
  CeldSettings      settings = celd_settings_chosen (config);

  if (!preset)
    return;
  celd_preset_fill (preset, &settings);
  celd_settings_put (config, &settings);
  make_picture (config, preset);
}

/* ------------------------------------------------------------------ the dialog */

static void
show_preset (GimpProcedureConfig *config)
{
  CeldSettings      settings = celd_settings_chosen (config);
  const CeldPreset *preset = celd_preset_of (&settings);

  g_object_set (config, ARGUMENT, preset ? preset->name : CELD_OWN_SETTINGS, NULL);
}

/* While a preset is put into the arguments, one by one, they are those of no preset. */
static void
argument_changed (GObject *object, GParamSpec *spec, gpointer data)
{
  GimpProcedureConfig *config = GIMP_PROCEDURE_CONFIG (object);
  const CeldPreset    *preset = chosen_preset (config);
  CeldSettings         settings = celd_settings_chosen (config);

  (void) data;
  g_signal_handlers_block_by_func (object, (gpointer) argument_changed, NULL);
  if (celd_preset_covers (spec->name))
    show_preset (config);
  else if (!strcmp (spec->name, ARGUMENT) && preset)
    {
      celd_preset_choose (preset, &settings);
      celd_settings_put (config, &settings);
      make_picture (config, preset);
    }
  g_signal_handlers_unblock_by_func (object, (gpointer) argument_changed, NULL);
}

void
celd_preset_follow (GimpProcedureConfig *config)
{
  show_preset (config);
  g_signal_connect (config, "notify", G_CALLBACK (argument_changed), NULL);
}
