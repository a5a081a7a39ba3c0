/* The dialog: what to make, then how.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "gimp2.h"

#include <libgimp/gimpui.h>
#include <string.h>

#define SPACE 6 /* pixels; chosen */
#define SCALE 150
#define NO_LAYER (-1)

/* ------------------------------------------------------------------ what changes choices */

static void
picture_toggled (GtkToggleButton *button, gpointer data)
{
  CeldChoices *choices = data;
  guint        bit = GPOINTER_TO_UINT (g_object_get_data (G_OBJECT (button), "bit"));

  choices->wanted = gtk_toggle_button_get_active (button) ? choices->wanted | bit : choices->wanted & ~bit;
}

static const CeldSettingInfo *
row_of (gpointer widget)
{
  return g_object_get_data (G_OBJECT (widget), "row");
}

static void
number_changed (GtkAdjustment *adjustment, gpointer data)
{
  CeldChoices *choices = data;

  celd_setting_set (row_of (adjustment), gtk_adjustment_get_value (adjustment), &choices->settings);
}

static void
switch_toggled (GtkToggleButton *button, gpointer data)
{
  CeldChoices *choices = data;

  celd_setting_set (row_of (button), gtk_toggle_button_get_active (button), &choices->settings);
}

static void
choice_changed (GtkWidget *combo, gpointer data)
{
  CeldChoices *choices = data;
  int          value;

  if (gimp_int_combo_box_get_active (GIMP_INT_COMBO_BOX (combo), &value))
    celd_setting_set (row_of (combo), value, &choices->settings);
}

static void
layer_chosen (GtkWidget *combo, gpointer data)
{
  gint32 *layer = data;

  gimp_int_combo_box_get_active (GIMP_INT_COMBO_BOX (combo), layer);
}

static void
relations_changed (GtkEntry *entry, gpointer data)
{
  CeldChoices *choices = data;

  g_free (choices->relations);
  choices->relations = g_strdup (gtk_entry_get_text (entry));
}

/* ------------------------------------------------------------------ widgets */

static GtkWidget *
pictures_frame (CeldChoices *choices)
{
  GtkWidget *frame = gimp_frame_new (_ ("Make")), *table = gtk_table_new ((CELD_POPUP_PICTURES + 1) / 2, 2, TRUE);

  for (guint i = 0; i < CELD_POPUP_PICTURES; i++)
    {
      CeldPicture            picture = celd_pictures_stacked[i];
      const CeldPictureInfo *info = &celd_pictures[picture];
      GtkWidget             *button = gtk_check_button_new_with_mnemonic (_ (info->label));

      gimp_help_set_help_data (button, _ (info->help), NULL);
      gtk_toggle_button_set_active (GTK_TOGGLE_BUTTON (button), (choices->wanted & 1u << picture) != 0);
      g_object_set_data (G_OBJECT (button), "bit", GUINT_TO_POINTER (1u << picture));
      g_signal_connect (button, "toggled", G_CALLBACK (picture_toggled), choices);
      gtk_table_attach_defaults (GTK_TABLE (table), button, i % 2, i % 2 + 1, i / 2, i / 2 + 1);
    }
  gtk_container_add (GTK_CONTAINER (frame), table);
  return frame;
}

static void
add_number (GtkTable *table, int line, const CeldSettingInfo *row, CeldChoices *choices)
{
  GtkObject *adjustment = gimp_scale_entry_new (table, 0, line, _ (row->label), SCALE, 6,
                                                celd_setting_get (row, &choices->settings), row->shown.least,
                                                row->shown.most, row->shown.step, row->shown.page,
                                                (guint) row->shown.digits, TRUE, 0, 0, _ (row->help), NULL);

  g_object_set_data (G_OBJECT (adjustment), "row", (gpointer) row);
  g_signal_connect (adjustment, "value-changed", G_CALLBACK (number_changed), choices);
}

static void
add_choice (GtkTable *table, int line, const CeldSettingInfo *row, int n, CeldChoices *choices)
{
  GtkWidget *combo = g_object_new (GIMP_TYPE_INT_COMBO_BOX, NULL);

  for (int i = 0; i < n; i++)
    gimp_int_combo_box_append (GIMP_INT_COMBO_BOX (combo), GIMP_INT_STORE_VALUE, i, GIMP_INT_STORE_LABEL,
                               _ (row->choice[i].label), -1);
  g_object_set_data (G_OBJECT (combo), "row", (gpointer) row);
  gimp_int_combo_box_connect (GIMP_INT_COMBO_BOX (combo), (int) celd_setting_get (row, &choices->settings),
                              G_CALLBACK (choice_changed), choices);
  gimp_help_set_help_data (combo, _ (row->help), NULL);
  gimp_table_attach_aligned (table, 0, line, _ (row->label), 0, 0.5, combo, 2, FALSE);
}

static void
add_switch (GtkTable *table, int line, const CeldSettingInfo *row, CeldChoices *choices)
{
  GtkWidget *button = gtk_check_button_new_with_label (_ (row->label));

  g_object_set_data (G_OBJECT (button), "row", (gpointer) row);
  gtk_toggle_button_set_active (GTK_TOGGLE_BUTTON (button), celd_setting_get (row, &choices->settings) != 0);
  g_signal_connect (button, "toggled", G_CALLBACK (switch_toggled), choices);
  gimp_help_set_help_data (button, _ (row->help), NULL);
  gtk_table_attach_defaults (table, button, 0, 3, (guint) line, (guint) line + 1);
}

/* A frame with the settings of one heading, which begin at *i. */
static GtkWidget *
settings_frame (int *i, CeldChoices *choices)
{
  const char *heading = celd_main_settings[*i].heading;
  GtkWidget  *frame = gimp_frame_new (_ (heading)), *table = gtk_table_new (1, 3, FALSE);

  gtk_table_set_col_spacings (GTK_TABLE (table), SPACE);
  gtk_table_set_row_spacings (GTK_TABLE (table), SPACE / 2);
  for (int line = 0; *i < CELD_N_MAIN_SETTINGS && !strcmp (celd_main_settings[*i].heading, heading); ++*i, line++)
    {
      const CeldSettingInfo *row = celd_setting_find (celd_main_settings[*i].name);

      if (row->type == CELD_SETTING_CHOICE)
        add_choice (GTK_TABLE (table), line, row,
                    celd_main_settings[*i].choices ? celd_main_settings[*i].choices : (int) row->choices, choices);
      else if (row->type == CELD_SETTING_SWITCH)
        add_switch (GTK_TABLE (table), line, row, choices);
      else
        add_number (GTK_TABLE (table), line, row, choices);
    }
  gtk_container_add (GTK_CONTAINER (frame), table);
  return frame;
}

static GtkWidget *
relations_frame (CeldChoices *choices)
{
  GtkWidget *frame = gimp_frame_new (_ ("Relations")), *entry = gtk_entry_new ();

  gtk_entry_set_text (GTK_ENTRY (entry), choices->relations);
  gimp_help_set_help_data (entry, _ ("Relations as text, beside arrows: 120,80 > 300,95 or #ff0000 > #0000ff"),
                           NULL);
  g_signal_connect (entry, "changed", G_CALLBACK (relations_changed), choices);
  gtk_container_add (GTK_CONTAINER (frame), entry);
  return frame;
}

/* All layers of the image, for a role. */
static GtkWidget *
layer_combo (const GArray *listed, int role, CeldChoices *choices)
{
  GtkWidget *combo = gimp_int_combo_box_new (_ ("(none)"), NO_LAYER, NULL);

  for (guint i = 0; i < listed->len; i++)
    {
      gint32 layer = g_array_index (listed, gint32, i);
      char  *name = gimp_item_get_name (layer);

      gimp_int_combo_box_append (GIMP_INT_COMBO_BOX (combo), GIMP_INT_STORE_VALUE, layer, GIMP_INT_STORE_LABEL, name,
                                 -1);
      g_free (name);
    }
  gimp_int_combo_box_connect (GIMP_INT_COMBO_BOX (combo), choices->layer[role], G_CALLBACK (layer_chosen),
                              &choices->layer[role]);
  gimp_help_set_help_data (combo, _ (celd_layer_help[role]), NULL);
  return combo;
}

/* Which layers are read: those with the names, or others. */
static GtkWidget *
layers_frame (gint32 image, CeldChoices *choices)
{
  GArray    *listed = celd_layers_list (image);
  GtkWidget *frame = gimp_frame_new (_ ("Layers")), *table = gtk_table_new ((CELD_N_LAYERS + 1) / 2, 4, FALSE);

  gtk_table_set_col_spacings (GTK_TABLE (table), SPACE);
  gtk_table_set_row_spacings (GTK_TABLE (table), SPACE / 2);
  for (int role = 0; role < CELD_N_LAYERS; role++)
    gimp_table_attach_aligned (GTK_TABLE (table), role % 2 * 2, role / 2, _ (celd_layer_role_name ((CeldLayerRole) role)),
                               0, 0.5, layer_combo (listed, role, choices), 1, FALSE);
  gtk_container_add (GTK_CONTAINER (frame), table);
  g_array_unref (listed);
  return frame;
}

gboolean
celd_dialog_run (gint32 image, CeldChoices *choices)
{
  GtkWidget *dialog, *box = gtk_vbox_new (FALSE, 2 * SPACE);
  gboolean   go;

  gimp_ui_init ("celdepth", FALSE);
  dialog = gimp_dialog_new (_ ("Pop-up"), "celdepth", NULL, 0, gimp_standard_help_func, "plug-in-celdepth-popup",
                            _ ("_Cancel"), GTK_RESPONSE_CANCEL, _ ("_Make"), GTK_RESPONSE_OK, NULL);
  gtk_dialog_set_default_response (GTK_DIALOG (dialog), GTK_RESPONSE_OK);
  gtk_container_set_border_width (GTK_CONTAINER (box), 2 * SPACE);
  gtk_box_pack_start (GTK_BOX (box), layers_frame (image, choices), FALSE, FALSE, 0);
  gtk_box_pack_start (GTK_BOX (box), pictures_frame (choices), FALSE, FALSE, 0);
  for (int i = 0; i < CELD_N_MAIN_SETTINGS;)
    gtk_box_pack_start (GTK_BOX (box), settings_frame (&i, choices), FALSE, FALSE, 0);
  gtk_box_pack_start (GTK_BOX (box), relations_frame (choices), FALSE, FALSE, 0);
  gtk_container_add (GTK_CONTAINER (gtk_dialog_get_content_area (GTK_DIALOG (dialog))), box);
  gtk_widget_show_all (dialog);
  /* Return makes what is ticked; the first choice of a layer would have the focus, and open. */
  gtk_widget_grab_focus (gtk_dialog_get_widget_for_response (GTK_DIALOG (dialog), GTK_RESPONSE_OK));
  go = gimp_dialog_run (GIMP_DIALOG (dialog)) == GTK_RESPONSE_OK;
  gtk_widget_destroy (dialog);
  return go;
}
