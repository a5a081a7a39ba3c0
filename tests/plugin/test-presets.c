/* Presets: each looks different, is shown by dialogs, and gives way to what is set besides.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "front-end.h"

#include <string.h>

static gboolean
is_main_setting (const char *name)
{
  for (int i = 0; i < CELD_N_MAIN_SETTINGS; i++)
    if (!strcmp (name, celd_main_settings[i].name))
      return TRUE;
  return FALSE;
}

/* Dialogs show all of their settings, within the range of their sliders. */
static void
table_is_whole (void)
{
  for (int i = 0; i < CELD_N_PRESETS; i++)
    {
      guint wanted = 0;

      CHECK (celd_preset_find (celd_presets[i].name) == &celd_presets[i]);
      CHECK (celd_pictures_read (celd_presets[i].picture, &wanted, NULL));
      for (const CeldPresetValue *v = celd_presets[i].value; v->setting; v++)
        {
          const CeldSettingInfo *row = celd_setting_find (v->setting);

          CHECK (row && is_main_setting (v->setting) && celd_preset_covers (v->setting));
          CHECK (celd_setting_allows (row, v->value) && v->value != row->usual);
          CHECK (row->type != CELD_SETTING_NUMBER || (v->value >= row->shown.least && v->value <= row->shown.most));
        }
    }
  CHECK (!celd_preset_find (CELD_OWN_SETTINGS) && !celd_preset_find (""));
  CHECK (!celd_preset_covers ("light-azimuth") && !celd_preset_covers ("flats"));
}

/* From each preset to each other one. */
static void
chosen_one_is_shown (void)
{
  CeldSettings settings = celd_settings ();

  CHECK (celd_preset_of (&settings) == &celd_presets[0]);
  settings.light_azimuth = 20;
  settings.flats         = true;
  for (int i = 0; i < CELD_N_PRESETS; i++)
    for (int j = 0; j < CELD_N_PRESETS; j++)
      {
        celd_preset_choose (&celd_presets[i], &settings);
        celd_preset_choose (&celd_presets[j], &settings);
        CHECK (celd_preset_of (&settings) == &celd_presets[j]);
      }
  NEAR (settings.light_azimuth, 20, 0);
  CHECK (settings.flats);
  settings.ambient += 0.01f;
  CHECK (!celd_preset_of (&settings));
}

/* Whether they come before the preset or after it. */
static void
other_settings_count_more (void)
{
  CeldSettings before = celd_settings (), after = before, wrong = before;
  GError      *error = NULL;

  CHECK (celd_settings_read ("ambient=0.4 preset=cel", &before, NULL));
  CHECK (celd_settings_read ("preset=cel ambient=0.4", &after, NULL));
  NEAR (memcmp (&before, &after, sizeof before), 0, 0);
  NEAR (before.light_model, CELD_MODEL_TOON, 0);
  NEAR (before.ambient, 0.4, 1e-6);
  before = celd_settings ();
  CHECK (celd_settings_read ("ambient=0.25 preset=cel", &before, NULL)); /* its default */
  NEAR (before.ambient, 0.25, 1e-6);
  CHECK (!celd_settings_read ("preset=nonsense", &wrong, &error));
  CHECK (error && strstr (error->message, "\"nonsense\""));
  CHECK (celd_preset_of (&wrong) == &celd_presets[0]);
  g_clear_error (&error);
}

int
main (void)
{
  RUN (table_is_whole);
  RUN (chosen_one_is_shown);
  RUN (other_settings_count_more);
  return DONE;
}
