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

/* The choices, and the widgets of settings and pictures, which a preset changes. */
typedef struct { CeldChoices *choices; GPtrArray *widgets; GtkWidget *presets; gboolean busy; } Dialog;

/* ------------------------------------------------------------------ what changes choices */

static void
picture_toggled (GtkToggleButton *button, gpointer data)
{
  CeldChoices *choices = ((Dialog *) data)->choices;
  guint        bit = GPOINTER_TO_UINT (g_object_get_data (G_OBJECT (button), "bit"));

  choices->wanted = gtk_toggle_button_get_active (button) ? choices->wanted | bit : choices->wanted & ~bit;
}

static const CeldSettingInfo *
row_of (gpointer widget)
{
  return g_object_get_data (G_OBJECT (widget), "row");
}

/* Shows which preset the settings are. */
static void
show_preset (Dialog *dialog)
{
  const CeldPreset *preset = celd_preset_of (&dialog->choices->settings);

  dialog->busy = TRUE;
  gimp_int_combo_box_set_active (GIMP_INT_COMBO_BOX (dialog->presets),
                                 preset ? (int) (preset - celd_presets) : CELD_N_PRESETS);
  dialog->busy = FALSE;
}

/* Unless a preset is being shown, widget by widget. */
static void
set_setting (gpointer widget, double value, Dialog *dialog)
{
  if (dialog->busy)
    return;
  celd_setting_set (row_of (widget), value, &dialog->choices->settings);
  show_preset (dialog);
}

static void
number_changed (GtkAdjustment *adjustment, gpointer data)
{
  set_setting (adjustment, gtk_adjustment_get_value (adjustment) / celd_shown_number (row_of (adjustment)).factor, data);
}

static void
switch_toggled (GtkToggleButton *button, gpointer data)
{
  set_setting (button, gtk_toggle_button_get_active (button), data);
}

static void
choice_changed (GtkWidget *combo, gpointer data)
{
  int value;

  if (gimp_int_combo_box_get_active (GIMP_INT_COMBO_BOX (combo), &value))
    set_setting (combo, value, data);
}

/* Shows a setting, or a picture that is made. */
static void
show_widget (gpointer widget, gpointer data)
{
  const CeldChoices     *choices = ((Dialog *) data)->choices;
  const CeldSettingInfo *row = row_of (widget);
  double                 value = row ? celd_setting_get (row, &choices->settings) : 0;
  guint                  bit = GPOINTER_TO_UINT (g_object_get_data (G_OBJECT (widget), "bit"));

  if (GTK_IS_ADJUSTMENT (widget))
    gtk_adjustment_set_value (GTK_ADJUSTMENT (widget), value * celd_shown_number (row).factor);
  else if (GIMP_IS_INT_COMBO_BOX (widget))
    gimp_int_combo_box_set_active (GIMP_INT_COMBO_BOX (widget), (int) value);
  else
    gtk_toggle_button_set_active (GTK_TOGGLE_BUTTON (widget), row ? value != 0 : (choices->wanted & bit) != 0);
}

static void
preset_chosen (GtkWidget *combo, gpointer data)
{
  Dialog *dialog = data;
  guint   shown = 0;
  int     i;

  if (dialog->busy || !gimp_int_combo_box_get_active (GIMP_INT_COMBO_BOX (combo), &i) || i == CELD_N_PRESETS)
    return;
  celd_preset_choose (&celd_presets[i], &dialog->choices->settings);
  celd_pictures_read (celd_presets[i].picture, &shown, NULL);
  dialog->choices->wanted |= shown;
  dialog->busy = TRUE;
  g_ptr_array_foreach (dialog->widgets, show_widget, dialog);
  dialog->busy = FALSE;
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
pictures_frame (Dialog *dialog)
{
  GtkWidget *frame = gimp_frame_new (_ ("Make")), *table = gtk_table_new ((CELD_POPUP_PICTURES + 1) / 2, 2, TRUE);

  for (guint i = 0; i < CELD_POPUP_PICTURES; i++)
    {
      CeldPicture            picture = celd_pictures_stacked[i];
      const CeldPictureInfo *info = &celd_pictures[picture];
      GtkWidget             *button = gtk_check_button_new_with_mnemonic (_ (info->label));

      gimp_help_set_help_data (button, _ (info->help), NULL);
      gtk_toggle_button_set_active (GTK_TOGGLE_BUTTON (button), (dialog->choices->wanted & 1u << picture) != 0);
      g_object_set_data (G_OBJECT (button), "bit", GUINT_TO_POINTER (1u << picture));
      g_signal_connect (button, "toggled", G_CALLBACK (picture_toggled), dialog);
      g_ptr_array_add (dialog->widgets, button);
      gtk_table_attach_defaults (GTK_TABLE (table), button, i % 2, i % 2 + 1, i / 2, i / 2 + 1);
    }
  gtk_container_add (GTK_CONTAINER (frame), table);
  return frame;
}

/* The label names the unit. */
static void
add_number (GtkTable *table, int line, const CeldSettingInfo *row, Dialog *dialog)
{
  CeldShownNumber shown = celd_shown_number (row);
  char           *label = g_strdup_printf (shown.unit ? "%s (%s)" : "%s", _ (row->label), shown.unit);
  GtkObject      *adjustment = gimp_scale_entry_new (table, 0, line, label, SCALE, 6,
                                                     celd_setting_get (row, &dialog->choices->settings) * shown.factor,
                                                     row->shown.least * shown.factor, row->shown.most * shown.factor,
                                                     row->shown.step * shown.factor, row->shown.page * shown.factor,
                                                     (guint) shown.digits, TRUE, 0, 0, _ (row->help), NULL);

  g_free (label);
  g_object_set_data (G_OBJECT (adjustment), "row", (gpointer) row);
  g_signal_connect (adjustment, "value-changed", G_CALLBACK (number_changed), dialog);
  g_ptr_array_add (dialog->widgets, adjustment);
}

static void
add_choice (GtkTable *table, int line, const CeldSettingInfo *row, int n, Dialog *dialog)
{
  GtkWidget *combo = g_object_new (GIMP_TYPE_INT_COMBO_BOX, NULL);

  for (int i = 0; i < n; i++)
    gimp_int_combo_box_append (GIMP_INT_COMBO_BOX (combo), GIMP_INT_STORE_VALUE, i, GIMP_INT_STORE_LABEL,
                               _ (row->choice[i].label), -1);
  g_object_set_data (G_OBJECT (combo), "row", (gpointer) row);
  gimp_int_combo_box_connect (GIMP_INT_COMBO_BOX (combo), (int) celd_setting_get (row, &dialog->choices->settings),
                              G_CALLBACK (choice_changed), dialog);
  g_ptr_array_add (dialog->widgets, combo);
  gimp_help_set_help_data (combo, _ (row->help), NULL);
  gimp_table_attach_aligned (table, 0, line, _ (row->label), 0, 0.5, combo, 2, FALSE);
}

static void
add_switch (GtkTable *table, int line, const CeldSettingInfo *row, Dialog *dialog)
{
  GtkWidget *button = gtk_check_button_new_with_label (_ (row->label));

  g_object_set_data (G_OBJECT (button), "row", (gpointer) row);
  gtk_toggle_button_set_active (GTK_TOGGLE_BUTTON (button), celd_setting_get (row, &dialog->choices->settings) != 0);
  g_signal_connect (button, "toggled", G_CALLBACK (switch_toggled), dialog);
  g_ptr_array_add (dialog->widgets, button);
  gimp_help_set_help_data (button, _ (row->help), NULL);
  gtk_table_attach_defaults (table, button, 0, 3, (guint) line, (guint) line + 1);
}

/* A frame with the settings of one heading, which begin at *i. */
static GtkWidget *
settings_frame (int *i, Dialog *dialog)
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
                    celd_main_settings[*i].choices ? celd_main_settings[*i].choices : (int) row->choices, dialog);
      else if (row->type == CELD_SETTING_SWITCH)
        add_switch (GTK_TABLE (table), line, row, dialog);
      else
        add_number (GTK_TABLE (table), line, row, dialog);
    }
  gtk_container_add (GTK_CONTAINER (frame), table);
  return frame;
}

static GtkWidget *
presets_frame (Dialog *dialog)
{
  GtkWidget *frame = gimp_frame_new (_ ("Look")), *combo = dialog->presets;

  for (int i = 0; i < CELD_N_PRESETS; i++)
    gimp_int_combo_box_append (GIMP_INT_COMBO_BOX (combo), GIMP_INT_STORE_VALUE, i, GIMP_INT_STORE_LABEL,
                               _ (celd_presets[i].label), -1);
  gimp_int_combo_box_append (GIMP_INT_COMBO_BOX (combo), GIMP_INT_STORE_VALUE, CELD_N_PRESETS, GIMP_INT_STORE_LABEL,
                             _ (celd_own_settings_label), -1);
  gimp_help_set_help_data (combo, _ ("Settings of light and shadows that go together, and may be changed below"), NULL);
  show_preset (dialog);
  g_signal_connect (combo, "changed", G_CALLBACK (preset_chosen), dialog);
  gtk_container_add (GTK_CONTAINER (frame), combo);
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

/* Two columns, what and how: one would be too high for small screens. */
static GtkWidget *
columns (gint32 image, Dialog *dialog)
{
  GtkWidget *box = gtk_hbox_new (FALSE, 3 * SPACE), *what = gtk_vbox_new (FALSE, 2 * SPACE);
  GtkWidget *how = gtk_vbox_new (FALSE, 2 * SPACE);

  gtk_container_set_border_width (GTK_CONTAINER (box), 2 * SPACE);
  gtk_box_pack_start (GTK_BOX (what), layers_frame (image, dialog->choices), FALSE, FALSE, 0);
  gtk_box_pack_start (GTK_BOX (what), pictures_frame (dialog), FALSE, FALSE, 0);
  gtk_box_pack_start (GTK_BOX (what), presets_frame (dialog), FALSE, FALSE, 0);
  gtk_box_pack_start (GTK_BOX (what), relations_frame (dialog->choices), FALSE, FALSE, 0);
  for (int i = 0; i < CELD_N_MAIN_SETTINGS;)
    gtk_box_pack_start (GTK_BOX (how), settings_frame (&i, dialog), FALSE, FALSE, 0);
  gtk_box_pack_start (GTK_BOX (box), what, TRUE, TRUE, 0);
  gtk_box_pack_start (GTK_BOX (box), how, TRUE, TRUE, 0);
  return box;
}

gboolean
celd_dialog_run (gint32 image, CeldChoices *choices)
{
  Dialog     widgets = { choices, g_ptr_array_new (), NULL, FALSE };
  GtkWidget *dialog;
  gboolean   go;

  gimp_ui_init ("celdepth", FALSE);
  widgets.presets = g_object_new (GIMP_TYPE_INT_COMBO_BOX, NULL);
  dialog          = gimp_dialog_new (_ ("Pop-up"), "celdepth", NULL, 0, NULL,
                                     "plug-in-celdepth-popup", _ ("_Cancel"), GTK_RESPONSE_CANCEL, _ ("_Make"),
                                     GTK_RESPONSE_OK, NULL);
  gtk_dialog_set_default_response (GTK_DIALOG (dialog), GTK_RESPONSE_OK);
  gtk_container_add (GTK_CONTAINER (gtk_dialog_get_content_area (GTK_DIALOG (dialog))), columns (image, &widgets));
  gtk_widget_show_all (dialog);
  /* Return makes what is ticked; the first choice of a layer would have the focus, and open. */
  gtk_widget_grab_focus (gtk_dialog_get_widget_for_response (GTK_DIALOG (dialog), GTK_RESPONSE_OK));
  go = gimp_dialog_run (GIMP_DIALOG (dialog)) == GTK_RESPONSE_OK;
  gtk_widget_destroy (dialog);
  g_ptr_array_free (widgets.widgets, TRUE);
  return go;
}
