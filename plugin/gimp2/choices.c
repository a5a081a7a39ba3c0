/* What was chosen, from texts and from the image, where it is kept as a parasite, a key file.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "gimp2.h"

#include <string.h>

#define PARASITE "celdepth-popup"
#define GROUP    "pop-up"

CeldChoices
celd_choices (gint32 image)
{
  CeldChoices choices = { 0, celd_settings (), g_strdup (""), { 0 } };

  celd_layers_find (image, choices.layer);
  for (int i = 0; i < CELD_POPUP_PICTURES; i++)
    choices.wanted |= celd_pictures[i].usual ? 1u << i : 0;
  return choices;
}

void
celd_choices_clear (CeldChoices *choices)
{
  g_free (choices->relations);
  choices->relations = NULL;
}

gboolean
celd_choices_read (const char *pictures, const char *settings, const char *relations, CeldChoices *choices,
                   GError **error)
{
  if (relations && *relations)
    {
      g_free (choices->relations);
      choices->relations = g_strdup (relations);
    }
  return celd_pictures_read (pictures, &choices->wanted, error) &&
         celd_settings_read (settings, &choices->settings, error);
}

/* ------------------------------------------------------------------ remembering */

/* What is kept with the image already, or an empty file. */
static GKeyFile *
kept_file (gint32 image)
{
  GKeyFile     *file = g_key_file_new ();
  GimpParasite *parasite = gimp_image_get_parasite (image, PARASITE);
  glong         size = parasite ? gimp_parasite_data_size (parasite) : 0;

  if (size > 1)
    g_key_file_load_from_data (file, gimp_parasite_data (parasite), (gsize) size - 1, G_KEY_FILE_NONE, NULL);
  if (parasite)
    gimp_parasite_free (parasite);
  return file;
}

static void
keep_setting (GKeyFile *file, const CeldSettingInfo *row, double value)
{
  switch (row->type)
    {
    case CELD_SETTING_NUMBER:  g_key_file_set_double (file, GROUP, row->name, value); break;
    case CELD_SETTING_INTEGER: g_key_file_set_integer (file, GROUP, row->name, (int) value); break;
    case CELD_SETTING_SWITCH:  g_key_file_set_boolean (file, GROUP, row->name, value != 0); break;
    case CELD_SETTING_CHOICE:  g_key_file_set_string (file, GROUP, row->name, row->choice[(int) value].nick); break;
    case CELD_SETTING_COLOUR:
    case CELD_SETTING_TEXT:    break; /* none is offered */
    }
}

/* The layers that were chosen although their names say something else: by tattoos, which stay the same in files. */
static void
keep_layers (GKeyFile *file, gint32 image, const gint32 layer[CELD_N_LAYERS])
{
  gint32 named[CELD_N_LAYERS];

  celd_layers_find (image, named);
  for (int role = 0; role < CELD_N_LAYERS; role++)
    if (layer[role] != named[role])
      g_key_file_set_integer (file, GROUP, celd_layer_arguments[role],
                              layer[role] < 0 ? 0 : gimp_item_get_tattoo (layer[role]));
    else
      g_key_file_remove_key (file, GROUP, celd_layer_arguments[role], NULL);
}

/* A layer that is gone gives way to the name. */
static void
recall_layers (GKeyFile *file, gint32 image, gint32 layer[CELD_N_LAYERS])
{
  for (int role = 0; role < CELD_N_LAYERS; role++)
    if (g_key_file_has_key (file, GROUP, celd_layer_arguments[role], NULL))
      {
        int    tattoo = g_key_file_get_integer (file, GROUP, celd_layer_arguments[role], NULL);
        gint32 kept = tattoo > 0 ? gimp_image_get_layer_by_tattoo (image, tattoo) : -1;

        if (kept >= 0 || !tattoo)
          layer[role] = kept;
      }
}

void
celd_choices_remember (gint32 image, const CeldChoices *choices)
{
  GKeyFile     *file = kept_file (image);
  char         *text;
  gsize         length;
  GimpParasite *parasite;

  for (int i = 0; i < CELD_POPUP_PICTURES; i++)
    g_key_file_set_boolean (file, GROUP, celd_pictures[i].argument, (choices->wanted & 1u << i) != 0);
  for (int i = 0; i < CELD_N_MAIN_SETTINGS; i++)
    {
      const CeldSettingInfo *row = celd_setting_find (celd_main_settings[i].name);

      keep_setting (file, row, celd_setting_get (row, &choices->settings));
    }
  g_key_file_set_string (file, GROUP, "relations", choices->relations);
  keep_layers (file, image, choices->layer);
  text     = g_key_file_to_data (file, &length, NULL);
  parasite = gimp_parasite_new (PARASITE, GIMP_PARASITE_PERSISTENT | GIMP_PARASITE_UNDOABLE, (guint32) length + 1,
                                text);
  gimp_image_attach_parasite (image, parasite);
  gimp_parasite_free (parasite);
  g_free (text);
  g_key_file_unref (file);
}

/* What is missing or damaged stays as it is. */
void
celd_choices_recall (gint32 image, CeldChoices *choices)
{
  GKeyFile *file = kept_file (image);
  char     *relations = g_key_file_get_string (file, GROUP, "relations", NULL);

  for (int i = 0; i < CELD_POPUP_PICTURES; i++)
    if (g_key_file_has_key (file, GROUP, celd_pictures[i].argument, NULL))
      {
        guint bit = 1u << i;

        choices->wanted &= ~bit;
        choices->wanted |= g_key_file_get_boolean (file, GROUP, celd_pictures[i].argument, NULL) ? bit : 0;
      }
  for (int i = 0; i < CELD_N_MAIN_SETTINGS; i++)
    {
      char *value = g_key_file_get_value (file, GROUP, celd_main_settings[i].name, NULL);

      if (value)
        celd_setting_read (celd_main_settings[i].name, value, &choices->settings, NULL);
      g_free (value);
    }
  if (relations)
    {
      g_free (choices->relations);
      choices->relations = relations;
    }
  recall_layers (file, image, choices->layer);
  g_key_file_unref (file);
}
