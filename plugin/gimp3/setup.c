/* Set up layers: makes the layers that are missing, locks the drawing, and offers colours for scribbles.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "gimp3.h"

#include <libgimp/gimpui.h>

#define PALETTE "Cartoon Depth"

/* Those that a drawing needs; others are made on demand.  From the bottom to the top. */
static const struct { CeldLayerRole role; gboolean usual; } made[] = {
  { CELD_LAYER_SCRIBBLES, TRUE }, { CELD_LAYER_CONTOURS, TRUE }, { CELD_LAYER_ARROWS, TRUE },
  { CELD_LAYER_CORRECTIONS, FALSE }, { CELD_LAYER_HIDDEN, FALSE },
};

/* ------------------------------------------------------------------ colours */

static GeglColor *
label_colour (int i)
{
  GeglColor    *colour = gegl_color_new (NULL);
  guint32       rgb = celd_label_colours[i].rgb;
  const guint8  pixel[3] = { (guint8) (rgb >> 16), (guint8) (rgb >> 8), (guint8) rgb };

  gegl_color_set_pixel (colour, babl_format ("R'G'B' u8"), pixel);
  return colour;
}

/* A palette of this name that is there already stays as the artist left it. */
static GimpPalette *
get_palette (void)
{
  GimpPalette *palette = gimp_palette_get_by_name (PALETTE);

  if (palette)
    return palette;
  palette = gimp_palette_new (PALETTE);
  gimp_palette_set_columns (palette, 8);
  for (int i = 0; i < CELD_N_LABEL_COLOURS; i++)
    {
      GeglColor *colour = label_colour (i);
      int        entry;

      gimp_palette_add_entry (palette, _ (celd_label_colours[i].name), colour, &entry);
      g_object_unref (colour);
    }
  return palette;
}

static void
offer_colours (void)
{
  GeglColor *first = label_colour (0);

  gimp_context_set_palette (get_palette ());
  gimp_context_set_foreground (first);
  g_object_unref (first);
}

/* ------------------------------------------------------------------ layers */

/* Locked, so that no stroke lands on it. */
static void
prepare_drawing (GimpLayer *drawing)
{
  char *name = gimp_item_get_name (GIMP_ITEM (drawing));

  if (celd_layer_role_of_name (name) != CELD_LAYER_DRAWING)
    gimp_item_set_name (GIMP_ITEM (drawing), _ (celd_layer_role_name (CELD_LAYER_DRAWING)));
  gimp_item_set_lock_content (GIMP_ITEM (drawing), TRUE);
  gimp_item_set_lock_position (GIMP_ITEM (drawing), TRUE);
  g_free (name);
}

/* A new layer above another one, in the same group. */
static GimpLayer *
add_layer (GimpImage *image, CeldLayerRole role, GimpLayer *below)
{
  GimpLayer *layer = gimp_layer_new (image, _ (celd_layer_role_name (role)), gimp_image_get_width (image),
                                     gimp_image_get_height (image), GIMP_RGBA_IMAGE, 100, GIMP_LAYER_MODE_NORMAL);
  GimpItem  *parent = gimp_item_get_parent (GIMP_ITEM (below));

  gimp_image_insert_layer (image, layer, parent ? GIMP_LAYER (parent) : NULL,
                           gimp_image_get_item_position (image, GIMP_ITEM (below)));
  return layer;
}

static void
add_layers (GimpImage *image, GimpProcedureConfig *config, GimpLayer *layer[CELD_N_LAYERS])
{
  GimpLayer *below = layer[CELD_LAYER_DRAWING];

  for (gsize i = 0; i < G_N_ELEMENTS (made); i++)
    {
      CeldLayerRole role = made[i].role;
      gboolean      wanted;

      g_object_get (config, celd_layer_arguments[role], &wanted, NULL);
      if (wanted && !layer[role])
        layer[role] = below = add_layer (image, role, below);
    }
}

static gboolean
set_up (GimpImage *image, GimpProcedureConfig *config, GError **error)
{
  GimpLayer *layer[CELD_N_LAYERS];

  celd_layers_find (image, layer);
  if (!layer[CELD_LAYER_DRAWING])
    layer[CELD_LAYER_DRAWING] = celd_layers_lowest (image, layer);
  if (!layer[CELD_LAYER_DRAWING])
    {
      g_set_error_literal (error, CELD_PIPELINE_ERROR, CELD_PIPELINE_FAILED,
                           _ ("The image has no layer with a drawing. Put the drawing on a layer of it first."));
      return FALSE;
    }
  gimp_image_undo_group_start (image);
  if (gimp_image_get_base_type (image) != GIMP_RGB)
    gimp_image_convert_rgb (image);
  add_layers (image, config, layer);
  prepare_drawing (layer[CELD_LAYER_DRAWING]);
  if (layer[CELD_LAYER_SCRIBBLES])
    gimp_image_set_selected_layers (image, (const GimpLayer *[]) { layer[CELD_LAYER_SCRIBBLES], NULL });
  gimp_image_undo_group_end (image);
  offer_colours ();
  gimp_displays_flush ();
  return TRUE;
}

/* ------------------------------------------------------------------ the procedure */

/* FALSE: cancelled. */
static gboolean
ask (GimpProcedure *procedure, GimpProcedureConfig *config)
{
  GtkWidget           *window;
  GimpProcedureDialog *dialog;
  gboolean             go;

  gimp_ui_init ("celdepth");
  window = gimp_procedure_dialog_new (procedure, config, _ ("Set up layers"));
  dialog = GIMP_PROCEDURE_DIALOG (window);
  gimp_procedure_dialog_set_ok_label (dialog, _ ("_Make"));
  gimp_procedure_dialog_get_label (dialog, "layers-title", _ ("Layers to make if they are missing"), FALSE, FALSE);
  gimp_procedure_dialog_fill_box (dialog, "layers-box", "scribbles", "contours", "arrows", "corrections", "hidden",
                                  NULL);
  gimp_procedure_dialog_fill_frame (dialog, "layers", "layers-title", FALSE, "layers-box");
  gimp_procedure_dialog_fill (dialog, "layers", NULL);
  go = gimp_procedure_dialog_run (dialog);
  gtk_widget_destroy (window);
  return go;
}

static GimpValueArray *
run (GimpProcedure *procedure, GimpRunMode run_mode, GimpImage *image, GimpDrawable **drawables,
     GimpProcedureConfig *config, gpointer run_data)
{
  GError  *error = NULL;
  gboolean good;

  (void) drawables;
  (void) run_data;
  gegl_init (NULL, NULL);
  if (!celd_floating_check (image, &error))
    return gimp_procedure_new_return_values (procedure, GIMP_PDB_CALLING_ERROR, error);
  if (run_mode == GIMP_RUN_INTERACTIVE && !ask (procedure, config))
    return gimp_procedure_new_return_values (procedure, GIMP_PDB_CANCEL, NULL);
  good = set_up (image, config, &error);
  return gimp_procedure_new_return_values (procedure, good ? GIMP_PDB_SUCCESS : GIMP_PDB_EXECUTION_ERROR, error);
}

static void
add_arguments (GimpProcedure *procedure)
{
  for (gsize i = 0; i < G_N_ELEMENTS (made); i++)
    gimp_procedure_add_boolean_argument (procedure, celd_layer_arguments[made[i].role],
                                         _ (celd_layer_role_name (made[i].role)),
                                         _ (celd_layer_help[made[i].role]), made[i].usual,
                                         G_PARAM_READWRITE);
}

const CeldProcedure celd_setup_procedure = {
  .name          = "plug-in-celdepth-set-up-layers",
  .menu_label    = N_ ("_Set up layers..."),
  .blurb         = N_ ("Makes layers for scribbles, arrows and contours, locks the drawing, and offers 24 colours to "
                       "scribble with"),
  .help          = N_ ("Layers that are there already stay as they are. The lowest layer is the drawing if none has "
                       "that name. An image without colours becomes an RGB image."),
  .add_arguments = add_arguments,
  .run           = run,
};
