/* The texts by which scripts name pictures and settings, and the tables that dialogs are made from.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "front-end.h"

#include <string.h>

static void
pictures_by_name (void)
{
  guint   wanted = 5;
  GError *error = NULL;

  CHECK (celd_pictures_read (NULL, &wanted, NULL) && celd_pictures_read (" ,", &wanted, NULL) && wanted == 5);
  CHECK (celd_pictures_read ("lit, depth", &wanted, NULL));
  NEAR (wanted, 1u << CELD_PICTURE_LIT | 1u << CELD_PICTURE_DEPTH, 0);
  CHECK (!celd_pictures_read ("lit,light", &wanted, &error));
  CHECK (error && strstr (error->message, "\"light\""));
  NEAR (wanted, 1u << CELD_PICTURE_LIT | 1u << CELD_PICTURE_DEPTH, 0);
  g_clear_error (&error);
}

static void
settings_by_name (void)
{
  CeldSettings settings = celd_settings ();

  CHECK (celd_settings_read (NULL, &settings, NULL));
  CHECK (celd_settings_read ("light-azimuth=-30 bulge=0.5, close-gaps=no\nflats=true toon-steps=4 light-model=toon",
                             &settings, NULL));
  NEAR (settings.light_azimuth, -30, 0);
  NEAR (settings.bulge, 0.5, 0);
  CHECK (!settings.close_gaps && settings.flats);
  NEAR (settings.toon_steps, 4, 0);
  NEAR (settings.light_model, CELD_MODEL_TOON, 0);
}

static void
numbers_have_units (void)
{
  static const struct { const char *name; CeldShownNumber shown; } expected[] = {
    { "ambient", { 100, 0, "%" } },  { "shadow-size", { 100, 2, "%" } }, { "light-azimuth", { 1, 0, "°" } },
    { "bulge", { 1, 2, NULL } },     { "toon-steps", { 1, 0, NULL } },   { "mesh-size", { 1, 1, "mm" } },
  };

  for (size_t i = 0; i < G_N_ELEMENTS (expected); i++)
    {
      CeldShownNumber found = celd_shown_number (celd_setting_find (expected[i].name));

      NEAR (found.factor, expected[i].shown.factor, 0);
      NEAR (found.digits, expected[i].shown.digits, 0);
      CHECK (!g_strcmp0 (found.unit, expected[i].shown.unit));
    }
}

static void
nonsense_is_refused (void)
{
  static const char *const wrong[] = {
    "bulge", "bulge=", "bulge=much", "bulge=0.5x", "bulge=-1", "bulge=nan", "toon-steps=2.5", "toon-steps=1",
    "light-model=2", "light-model=Toon", "flats=1", "nonsense=1", "=1", "background-colour=#ff0000",
  };

  for (size_t i = 0; i < G_N_ELEMENTS (wrong); i++)
    {
      CeldSettings settings = celd_settings (), usual = settings;
      GError      *error = NULL;

      CHECK (!celd_settings_read (wrong[i], &settings, &error));
      CHECK (error && error->domain == CELD_PIPELINE_ERROR);
      NEAR (memcmp (&settings, &usual, sizeof usual), 0, 0);
      g_clear_error (&error);
    }
}

/* Each picture has a layer, once; each main setting is one of core. */
static void
tables_are_whole (void)
{
  guint stacked = 0;

  for (int i = 0; i < CELD_POPUP_PICTURES; i++)
    {
      stacked |= 1u << celd_pictures_stacked[i];
      CHECK (celd_pictures[i].argument && celd_pictures[i].option && celd_pictures[i].layer);
    }
  NEAR (stacked, (1u << CELD_POPUP_PICTURES) - 1, 0);
  for (int i = 0; i < CELD_N_MAIN_SETTINGS; i++)
    {
      const CeldSettingInfo *row = celd_setting_find (celd_main_settings[i].name);

      CHECK (row && celd_main_settings[i].choices <= (int) row->choices);
    }
}

int
main (void)
{
  RUN (pictures_by_name);
  RUN (settings_by_name);
  RUN (numbers_have_units);
  RUN (nonsense_is_refused);
  RUN (tables_are_whole);
  return DONE;
}
