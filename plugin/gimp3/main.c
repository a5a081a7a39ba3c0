/* The plug-in and its procedures.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "gimp3.h"

#define MENU "<Image>/Cartoon Depth"

static const CeldProcedure *const procedures[] = {
  &celd_setup_procedure, &celd_popup_procedure, &celd_split_procedure, &celd_suggest_procedure, &celd_stereo_procedure,
  &celd_group_procedure, &celd_export_procedure, &celd_mesh_procedure, &celd_live_procedure,
};

/* Procedures without an entry in the menu. */
static const struct
{
  const char      *name;
  GimpProcedure *(*create) (GimpPlugIn *plug_in);
} parts[] = { { CELD_LIVE_WINDOW, celd_live_window_create }, { CELD_LIVE_SEND, celd_live_send_create } };

typedef struct { GimpPlugIn parent_instance; } CeldPlugIn;
typedef struct { GimpPlugInClass parent_class; } CeldPlugInClass;

GType celd_plug_in_get_type (void);
G_DEFINE_TYPE (CeldPlugIn, celd_plug_in, GIMP_TYPE_PLUG_IN)

static GList *
query_procedures (GimpPlugIn *plug_in)
{
  GList *names = NULL;

  (void) plug_in;
  celd_filters_write_presets ();
  for (gsize i = 0; i < G_N_ELEMENTS (procedures); i++)
    names = g_list_append (names, g_strdup (procedures[i]->name));
  for (gsize i = 0; i < G_N_ELEMENTS (parts); i++)
    names = g_list_append (names, g_strdup (parts[i].name));
  return names;
}

/* By its file: themes find a name only in folders that they know, and in the system only when their caches are new. */
static void
set_icon (GimpProcedure *procedure)
{
  GFile *file = g_file_new_for_path (CELD_ICON_FILE);

  gimp_procedure_set_icon_file (procedure, file);
  g_object_unref (file);
}

static GimpProcedure *
create_procedure (GimpPlugIn *plug_in, const char *name)
{
  for (gsize i = 0; i < G_N_ELEMENTS (parts); i++)
    if (!g_strcmp0 (parts[i].name, name))
      return parts[i].create (plug_in);
  for (gsize i = 0; i < G_N_ELEMENTS (procedures); i++)
    if (!g_strcmp0 (procedures[i]->name, name))
      {
        const CeldProcedure *p = procedures[i];
        GimpProcedure       *procedure = gimp_image_procedure_new (plug_in, name, GIMP_PDB_PROC_TYPE_PLUGIN, p->run,
                                                                   (gpointer) p, NULL);

        gimp_procedure_set_image_types (procedure, "*");
        gimp_procedure_set_sensitivity_mask (procedure, GIMP_PROCEDURE_SENSITIVE_DRAWABLE |
                                                          GIMP_PROCEDURE_SENSITIVE_DRAWABLES |
                                                          GIMP_PROCEDURE_SENSITIVE_NO_DRAWABLES);
        gimp_procedure_set_menu_label (procedure, _ (p->menu_label));
        gimp_procedure_add_menu_path (procedure, MENU);
        set_icon (procedure);
        gimp_procedure_set_documentation (procedure, _ (p->blurb), _ (p->help), NULL);
        gimp_procedure_set_attribution (procedure, "The authors of celdepth", "LGPL-3.0-or-later", "2026");
        if (p->add_arguments)
          p->add_arguments (procedure);
        return procedure;
      }
  return NULL;
}

/* The plug-in binds its texts by itself: GIMP would look for them in the folder of the plug-in. */
static gboolean
set_i18n (GimpPlugIn *plug_in, const char *procedure_name, char **gettext_domain, char **catalog_dir)
{
  (void) plug_in;
  (void) procedure_name;
  (void) gettext_domain;
  (void) catalog_dir;
  return FALSE;
}

static void
celd_plug_in_class_init (CeldPlugInClass *klass)
{
  GimpPlugInClass *plug_in_class = GIMP_PLUG_IN_CLASS (klass);

  plug_in_class->query_procedures = query_procedures;
  plug_in_class->create_procedure = create_procedure;
  plug_in_class->set_i18n         = set_i18n;
  bindtextdomain ("celdepth", CELD_LOCALE_FOLDER);
  bind_textdomain_codeset ("celdepth", "UTF-8");
  textdomain ("celdepth");
}

static void
celd_plug_in_init (CeldPlugIn *plug_in)
{
  (void) plug_in;
}

GIMP_MAIN (celd_plug_in_get_type ())
