/* The dialog of the procedures: which layers, what to make of them, then how; what is rarely needed is folded.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include <libgimp/gimpui.h>

#include "gimp3.h"

#define THUMBNAIL 24 /* pixels; chosen */
#define INDENT    3  /* spaces for each group that a layer lies in; chosen */
#define ROOM      6  /* pixels above and below the look; chosen */

/* ------------------------------------------------------------------ layers */

/* A combo box with the layers of an image, for one argument. */
typedef struct { GimpProcedureConfig *config; const char *argument; } Choice;

static void
layer_chosen (GtkWidget *combo, gpointer data)
{
  Choice *choice = data;
  int     id = 0;

  if (gimp_int_combo_box_get_active (GIMP_INT_COMBO_BOX (combo), &id))
    g_object_set (choice->config, choice->argument, id ? gimp_layer_get_by_id (id) : NULL, NULL);
}

static GtkWidget *
layer_combo (GArray *listed, GimpProcedureConfig *config, int role)
{
  GtkWidget *combo = gimp_int_combo_box_new (_ ("(none)"), 0, NULL);
  Choice    *choice = g_new (Choice, 1);
  GimpLayer *chosen[CELD_N_LAYERS];

  for (guint i = 0; i < listed->len; i++)
    {
      const CeldListedLayer *l = &g_array_index (listed, CeldListedLayer, i);
      char                  *name = gimp_item_get_name (GIMP_ITEM (l->layer));
      char                  *label = g_strdup_printf ("%*s%s", INDENT * l->depth, "", name);
      GdkPixbuf             *thumbnail = gimp_drawable_get_thumbnail (GIMP_DRAWABLE (l->layer), THUMBNAIL, THUMBNAIL,
                                                                      GIMP_PIXBUF_SMALL_CHECKS);

      gimp_int_combo_box_append (GIMP_INT_COMBO_BOX (combo), GIMP_INT_STORE_VALUE,
                                 gimp_item_get_id (GIMP_ITEM (l->layer)), GIMP_INT_STORE_LABEL, label,
                                 GIMP_INT_STORE_PIXBUF, thumbnail, -1);
      g_clear_object (&thumbnail);
      g_free (label);
      g_free (name);
    }
  *choice = (Choice) { config, celd_layer_arguments[role] };
  celd_layers_chosen (config, chosen);
  gimp_int_combo_box_set_active (GIMP_INT_COMBO_BOX (combo),
                                 chosen[role] ? gimp_item_get_id (GIMP_ITEM (chosen[role])) : 0);
  g_object_set_data_full (G_OBJECT (combo), "choice", choice, g_free);
  g_signal_connect (combo, "changed", G_CALLBACK (layer_chosen), choice);
  return combo;
}

/* A grid with the layers of the roles first .. last. */
static GtkWidget *
layer_grid (GArray *listed, GimpProcedureConfig *config, int first, int last)
{
  GtkWidget *grid = gtk_grid_new ();

  gtk_grid_set_row_spacing (GTK_GRID (grid), 4);
  gtk_grid_set_column_spacing (GTK_GRID (grid), 12);
  for (int role = first; role <= last; role++)
    {
      const GParamSpec *spec = g_object_class_find_property (G_OBJECT_GET_CLASS (config), celd_layer_arguments[role]);
      GtkWidget        *label = gtk_label_new (_ (celd_layer_role_name ((CeldLayerRole) role)));
      GtkWidget        *combo = layer_combo (listed, config, role);

      gtk_label_set_xalign (GTK_LABEL (label), 0);
      gtk_label_set_width_chars (GTK_LABEL (label), 11);
      gtk_widget_set_hexpand (combo, TRUE);
      gimp_help_set_help_data (combo, g_param_spec_get_blurb ((GParamSpec *) spec), NULL);
      gtk_grid_attach (GTK_GRID (grid), label, 0, role - first, 1, 1);
      gtk_grid_attach (GTK_GRID (grid), combo, 1, role - first, 1, 1);
    }
  return grid;
}

/* Says that paths are read, too; NULL: there are none. */
static GtkWidget *
paths_label (GimpImage *image)
{
  CeldPathArrows paths = celd_paths_read (image);
  char          *text = g_strdup_printf (ngettext ("and %d arrow of the path Arrows",
                                                    "and %d arrows of the path Arrows", (gulong) paths.n),
                                          paths.n);
  GtkWidget     *label = paths.n ? gtk_label_new (text) : NULL;

  if (label)
    gtk_label_set_xalign (GTK_LABEL (label), 0);
  g_free (text);
  g_free (paths.data);
  return label;
}

/* Contours, corrections and hidden are folded, unless one of them is there. */
static GtkWidget *
layers_frame (GimpImage *image, GimpProcedureConfig *config)
{
  GArray    *listed = celd_layers_list (image);
  GtkWidget *frame = gimp_frame_new (_ ("Layers")), *box = gtk_box_new (GTK_ORIENTATION_VERTICAL, 6);
  GtkWidget *more = gtk_expander_new_with_mnemonic (_ ("More la_yers"));
  GtkWidget *rest = layer_grid (listed, config, CELD_LAYER_CONTOURS, CELD_LAYER_HIDDEN);
  GtkWidget *paths = paths_label (image);
  GimpLayer *chosen[CELD_N_LAYERS];

  celd_layers_chosen (config, chosen);
  gtk_widget_set_margin_top (rest, 6);
  gtk_container_add (GTK_CONTAINER (more), rest);
  gtk_expander_set_expanded (GTK_EXPANDER (more), chosen[CELD_LAYER_CONTOURS] || chosen[CELD_LAYER_CORRECTIONS] ||
                                                    chosen[CELD_LAYER_HIDDEN]);
  gtk_container_add (GTK_CONTAINER (box), layer_grid (listed, config, CELD_LAYER_DRAWING, CELD_LAYER_ARROWS));
  if (paths)
    gtk_container_add (GTK_CONTAINER (box), paths);
  gtk_container_add (GTK_CONTAINER (box), more);
  gtk_container_add (GTK_CONTAINER (frame), box);
  gtk_widget_set_margin_bottom (frame, 12);
  gtk_widget_show_all (frame);
  g_array_unref (listed);
  return frame;
}

/* ------------------------------------------------------------------ pictures */

/* Eight bits are few for depth. */
static void
fill_pictures (GimpProcedureDialog *dialog, GimpImage *image)
{
  GtkWidget *flow = gimp_procedure_dialog_fill_flowbox (dialog, "pictures-flow", "lit", "enhanced", "regions", "depth",
                                                        "levels", "normals", "shading", NULL);

  gtk_orientable_set_orientation (GTK_ORIENTABLE (flow), GTK_ORIENTATION_HORIZONTAL);
  gtk_flow_box_set_min_children_per_line (GTK_FLOW_BOX (flow), 2);
  gtk_flow_box_set_max_children_per_line (GTK_FLOW_BOX (flow), 2);
  gtk_flow_box_set_homogeneous (GTK_FLOW_BOX (flow), TRUE);
  gimp_procedure_dialog_get_label (dialog, "pictures-title", _ ("Make"), FALSE, FALSE);
  gimp_procedure_dialog_get_label (dialog, "few-bits", _ ("<small>The image has 8 bits, so that its layer of depth has "
                                                          "at most 256 steps.\nFor more: Export depth, or Image &gt; "
                                                          "Encoding, 32-bit floating point.</small>"), TRUE,
                                   FALSE);
  if (celd_image_has_few_bits (image))
    gimp_procedure_dialog_fill_box (dialog, "pictures", "pictures-flow", "few-bits", NULL);
  else
    gimp_procedure_dialog_fill_box (dialog, "pictures", "pictures-flow", NULL);
  gimp_procedure_dialog_fill_frame (dialog, "pictures-frame", "pictures-title", FALSE, "pictures");
}

/* ------------------------------------------------------------------ settings */

/* Labels name units. */
static void
use_slider (GimpProcedureDialog *dialog, GimpProcedureConfig *config, const char *name)
{
  const CeldSettingInfo *row = celd_setting_find (name);
  const GParamSpec      *spec = g_object_class_find_property (G_OBJECT_GET_CLASS (config), name);
  CeldShownNumber        shown = celd_shown_number (row);
  GtkWidget             *entry = gimp_procedure_dialog_get_scale_entry (dialog, name, shown.factor);
  char                  *text = g_strdup_printf (shown.unit ? "%s (%s)" : "%s",
                                                 g_param_spec_get_nick ((GParamSpec *) spec), shown.unit);

  gtk_label_set_text_with_mnemonic (GTK_LABEL (gimp_labeled_get_label (GIMP_LABELED (entry))), text);
  gimp_label_spin_set_digits (GIMP_LABEL_SPIN (entry), shown.digits);
  g_free (text);
}

static void
use_sliders (GimpProcedureDialog *dialog, GimpProcedureConfig *config, const char *const *names)
{
  for (; *names; names++)
    if (celd_has_argument (config, *names))
      use_slider (dialog, config, *names);
}

static void
fill_light (GimpProcedureDialog *dialog, GimpProcedureConfig *config)
{
  static const char *const sliders[] = { "light-azimuth", "light-elevation", "ambient", "specular", "rim-light",
                                         "bulge", "bevel", NULL };

  use_sliders (dialog, config, sliders);
  gimp_procedure_dialog_get_label (dialog, "light-title", _ ("Light"), FALSE, FALSE);
  gimp_procedure_dialog_get_label (dialog, "more-light-title", _ ("_More light and shape"), FALSE, TRUE);
  gimp_procedure_dialog_fill_box (dialog, "more-light-box", "ambient", "toon-steps", "specular", "rim-light", "bulge",
                                  "bevel", NULL);
  gimp_procedure_dialog_fill_expander (dialog, "more-light", "more-light-title", FALSE, "more-light-box");
  gimp_procedure_dialog_fill_box (dialog, "light-box", "light-model", "light-azimuth", "light-elevation", "more-light",
                                  NULL);
  gimp_procedure_dialog_fill_frame (dialog, "light", "light-title", FALSE, "light-box");
}

static void
fill_shadows (GimpProcedureDialog *dialog, GimpProcedureConfig *config)
{
  static const char *const sliders[] = { "shadow-strength", "shadow-size", "shadow-offset", NULL };

  use_sliders (dialog, config, sliders);
  gimp_procedure_dialog_get_label (dialog, "shadows-title", _ ("Shadows"), FALSE, FALSE);
  gimp_procedure_dialog_fill_box (dialog, "shadows-box", "shadow-strength", "shadow-size", "shadow-offset", NULL);
  gtk_widget_set_margin_top (gimp_procedure_dialog_fill_frame (dialog, "shadows", "shadows-title", FALSE, "shadows-box"),
                             ROOM);
}

/* Suggest order needs no order. */
static void
fill_reading (GimpProcedureDialog *dialog, GimpProcedureConfig *config)
{
  static const char *const sliders[] = { "ink-threshold", "hardness", NULL };

  use_sliders (dialog, config, sliders);
  gimp_procedure_dialog_get_label (dialog, "reading-title", _ ("_How layers are read"), FALSE, TRUE);
  if (celd_has_argument (config, "suggest"))
    gimp_procedure_dialog_fill_box (dialog, "reading-box", "ink", "ink-threshold", "arrow-style", "hardness",
                                    "close-gaps", "flats", "same-colour", "suggest", "on-cycle", "expansion",
                                    "relations", NULL);
  else
    gimp_procedure_dialog_fill_box (dialog, "reading-box", "ink", "ink-threshold", "arrow-style", "hardness",
                                    "close-gaps", "flats", "same-colour", "relations", NULL);
  gimp_procedure_dialog_fill_expander (dialog, "reading", "reading-title", FALSE, "reading-box");
}

/* Shadows are set only for a picture that has them.  Light has more than one such picture, and stays. */
static void
set_sensitivity (GimpProcedureDialog *dialog, GimpProcedureConfig *config)
{
  static const char *const shadow[] = { "shadow-strength", "shadow-size", "shadow-offset" };

  for (gsize i = 0; i < G_N_ELEMENTS (shadow); i++)
    gimp_procedure_dialog_set_sensitive (dialog, shadow[i], TRUE, G_OBJECT (config), "enhanced", FALSE);
}

/* ------------------------------------------------------------------ the dialogs */

static void
fill_popup (GimpProcedureDialog *dialog, GimpProcedureConfig *config, GimpImage *image)
{
  GtkWidget *look;

  fill_pictures (dialog, image);
  fill_light (dialog, config);
  fill_shadows (dialog, config);
  set_sensitivity (dialog, config);
  celd_preset_follow (config);
  look = gimp_procedure_dialog_get_widget (dialog, "preset", G_TYPE_NONE);
  gtk_widget_set_margin_top (look, ROOM);
  gtk_widget_set_margin_bottom (look, ROOM);
  gimp_procedure_dialog_fill (dialog, "pictures-frame", "preset", "light", "shadows", "reading", NULL);
}

static void
fill_split (GimpProcedureDialog *dialog)
{
  gtk_button_set_label (GTK_BUTTON (gimp_procedure_dialog_get_widget (dialog, "complete", G_TYPE_NONE)),
                        _ ("Complete what nearer parts hide"));
  gimp_procedure_dialog_fill (dialog, "complete", "reading", NULL);
}

static void
fill_stereo (GimpProcedureDialog *dialog, GimpProcedureConfig *config)
{
  static const char *const sliders[] = { "disparity", "convergence", "screen-width", NULL };

  use_sliders (dialog, config, sliders);
  gimp_procedure_dialog_get_label (dialog, "view-title", _ ("Views"), FALSE, FALSE);
  gimp_procedure_dialog_get_label (dialog, "more-views-title", _ ("_More for screens"), FALSE, TRUE);
  gimp_procedure_dialog_fill_box (dialog, "more-views-box", "floating-window", "screen-width", NULL);
  gimp_procedure_dialog_fill_expander (dialog, "more-views", "more-views-title", FALSE, "more-views-box");
  gimp_procedure_dialog_fill_box (dialog, "view-box", "stereo", "new-image", "disparity", "convergence", "more-views",
                                  NULL);
  gimp_procedure_dialog_fill_frame (dialog, "view", "view-title", FALSE, "view-box");
  gimp_procedure_dialog_fill (dialog, "view", "reading", NULL);
}

/* Where the depth comes from is asked only if there is a choice. */
static void
fill_export (GimpProcedureDialog *dialog, GimpImage *image)
{
  gboolean layers = celd_results_find (image, celd_pictures[CELD_PICTURE_DEPTH].argument) ||
                    celd_results_find (image, celd_pictures[CELD_PICTURE_LEVELS].argument);

  gimp_procedure_dialog_get_label (dialog, "depth-title", _ ("Export"), FALSE, FALSE);
  if (layers)
    gimp_procedure_dialog_fill_box (dialog, "depth-box", "picture", "source", "file", NULL);
  else
    gimp_procedure_dialog_fill_box (dialog, "depth-box", "picture", "file", NULL);
  gimp_procedure_dialog_fill_frame (dialog, "depth-frame", "depth-title", FALSE, "depth-box");
  gimp_procedure_dialog_fill (dialog, "depth-frame", "reading", NULL);
}

static void
fill_mesh (GimpProcedureDialog *dialog, GimpProcedureConfig *config)
{
  static const char *const sliders[] = { "mesh-size", "relief-bulge", "relief-depth", "mesh-plate", "mesh-error",
                                         "most-vertices", NULL };

  use_sliders (dialog, config, sliders);
  gimp_procedure_dialog_get_label (dialog, "shape-title", _ ("Shape"), FALSE, FALSE);
  gimp_procedure_dialog_get_label (dialog, "more-shape-title", _ ("_More about the mesh"), FALSE, TRUE);
  gimp_procedure_dialog_fill_box (dialog, "more-shape-box", "mesh-kind", "mesh-plate", "relief-from", "mesh-error",
                                  "most-vertices", NULL);
  gimp_procedure_dialog_fill_expander (dialog, "more-shape", "more-shape-title", FALSE, "more-shape-box");
  gimp_procedure_dialog_fill_box (dialog, "shape-box", "relief-bulge", "relief-depth", "mesh-size", "more-shape", NULL);
  gimp_procedure_dialog_fill_frame (dialog, "shape", "shape-title", FALSE, "shape-box");
  gimp_procedure_dialog_fill (dialog, "file", "shape", "reading", NULL);
}

static void
fill (GimpProcedureDialog *dialog, GimpProcedureConfig *config, GimpImage *image)
{
  fill_reading (dialog, config);
  if (celd_has_argument (config, "lit"))
    fill_popup (dialog, config, image);
  else if (celd_has_argument (config, "complete"))
    fill_split (dialog);
  else if (celd_has_argument (config, "stereo"))
    fill_stereo (dialog, config);
  else if (celd_has_argument (config, "source"))
    fill_export (dialog, image);
  else if (celd_has_argument (config, "mesh-kind"))
    fill_mesh (dialog, config);
  else
    gimp_procedure_dialog_fill (dialog, "reading", NULL);
}

gboolean
celd_dialog_run (GimpProcedure *procedure, GimpProcedureConfig *config, GimpImage *image, const CeldProcedure *p)
{
  GtkWidget           *window;
  GimpProcedureDialog *dialog;
  gboolean             go;

  gimp_ui_init ("celdepth");
  window = gimp_procedure_dialog_new (procedure, config, _ (p->title));
  dialog = GIMP_PROCEDURE_DIALOG (window);
  gimp_procedure_dialog_set_ok_label (dialog, p->file_ending ? _ ("_Export") : _ ("_Make"));
  gtk_box_pack_start (GTK_BOX (gtk_dialog_get_content_area (GTK_DIALOG (window))), layers_frame (image, config), FALSE,
                      FALSE, 0);
  fill (dialog, config, image);
  go = gimp_procedure_dialog_run (dialog);
  gtk_widget_destroy (window);
  return go;
}
