/* The base class of all operations: regions, and the classes of the operations themselves.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "op-parts.h"

#include <libintl.h>
#include <string.h>

G_DEFINE_DYNAMIC_TYPE_EXTENDED (CeldOperation, celd_operation, GEGL_TYPE_OPERATION, G_TYPE_FLAG_ABSTRACT, {})

const CeldSettings *
celd_operation_settings (GeglOperation *operation)
{
  return &((CeldOperation *) operation)->settings;
}

const CeldOwnValues *
celd_operation_own (GeglOperation *operation)
{
  return &((CeldOperation *) operation)->own;
}

/* ------------------------------------------------------------------ regions */

GeglRectangle
celd_operation_input (GeglOperation *operation)
{
  const GeglRectangle *input = gegl_operation_source_get_bounding_box (operation, "input");

  return input ? *input : (GeglRectangle) { 0, 0, 0, 0 };
}

/* The whole input, whatever part of it the host asks for, since every result depends on every pixel.  Of an infinite
 * input, which render refuses, the part that the host asks for. */
static GeglRectangle
finite_picture (GeglOperation *operation, const GeglRectangle *asked)
{
  GeglRectangle whole = celd_operation_input (operation);

  return gegl_rectangle_is_infinite_plane (&whole) ? *asked : whole;
}

static GeglRectangle
get_cached_region (GeglOperation *operation, const GeglRectangle *roi)
{
  return finite_picture (operation, roi);
}

/* Of a sample, whose place has no meaning, all pixels are needed. */
static GeglRectangle
get_required_for_output (GeglOperation *operation, const gchar *name, const GeglRectangle *roi)
{
  for (const CeldPad *pad = CELD_OPERATION_CLASS_OF (operation)->info->pads; pad->name; pad++)
    if (pad->required == CELD_PAD_SAMPLE && !strcmp (pad->name, name))
      {
        const GeglRectangle *whole = gegl_operation_source_get_bounding_box (operation, name);

        return whole && !gegl_rectangle_is_infinite_plane (whole) ? *whole : *roi;
      }
  return finite_picture (operation, roi);
}

static GeglRectangle
get_invalidated_by_change (GeglOperation *operation, const gchar *pad, const GeglRectangle *changed)
{
  return finite_picture (operation, changed);
}

static void
prepare (GeglOperation *operation)
{
  gegl_operation_set_format (operation, "output", babl_format (CELD_OPERATION_CLASS_OF (operation)->info->format));
}

/* ------------------------------------------------------------------ the base class */

static void
finalize (GObject *object)
{
  CeldOperation *self = (CeldOperation *) object;

  celd_session_free (self->session);
  if (self->kept.result)
    self->kept.destroy (self->kept.result);
  g_free (self->last_message);
  celd_operation_clear_values (self);
  g_rec_mutex_clear (&self->busy);
  G_OBJECT_CLASS (celd_operation_parent_class)->finalize (object);
}

static void
celd_operation_init (CeldOperation *self)
{
  g_rec_mutex_init (&self->busy);
  self->settings = celd_settings ();
}

static void
celd_operation_class_init (CeldOperationClass *klass)
{
  GeglOperationClass *operation_class = GEGL_OPERATION_CLASS (klass);

  G_OBJECT_CLASS (klass)->finalize           = finalize;
  operation_class->attach                    = celd_operation_attach;
  operation_class->prepare                   = prepare;
  operation_class->get_bounding_box          = celd_operation_input;
  operation_class->get_cached_region         = get_cached_region;
  operation_class->get_required_for_output   = get_required_for_output;
  operation_class->get_invalidated_by_change = get_invalidated_by_change;
  operation_class->process                   = celd_operation_process;
  operation_class->threaded                  = FALSE;
}

static void
celd_operation_class_finalize (CeldOperationClass *klass)
{
}

/* ------------------------------------------------------------------ the operations */

/* In GIMP's menu of filters. */
static void
list_in_menu (GeglOperationClass *klass, const CeldOperationInfo *info)
{
  char *label = g_strdup_printf ("%s...", _ (info->title));

  gegl_operation_class_set_keys (klass, "gimp:menu-path", "<Image>/Filters/Cartoon Depth", "gimp:menu-label", label,
                                 NULL);
  g_free (label);
}

/* Makes the class of an operation from its CeldOperationInfo. */
static void
init_operation (gpointer g_class, gpointer data)
{
  CeldOperationClass      *klass = g_class;
  GeglOperationClass      *operation_class = g_class;
  const CeldOperationInfo *info = data;

  klass->info = info;
  G_OBJECT_CLASS (klass)->set_property = celd_operation_set_property; /* not inherited */
  G_OBJECT_CLASS (klass)->get_property = celd_operation_get_property;
  celd_operation_install (klass);
  if (info->prepare)
    operation_class->prepare = info->prepare;
  if (info->adjust)
    info->adjust (operation_class);
  gegl_operation_class_set_keys (operation_class,
    "name",            info->name,
    "title",           _ (info->title),
    "categories",      info->categories,
    "description",     _ (info->description),
    "reference",       info->reference,
    NULL);
  if (!info->unlisted)
    list_in_menu (operation_class, info);
}

static void
finalize_operation (gpointer g_class, gpointer data)
{
  g_free (((CeldOperationClass *) g_class)->row);
}

void
celd_operations_register (GTypeModule *module, const CeldOperationInfo *const *infos, gsize n)
{
  bindtextdomain ("celdepth", CELD_LOCALE_FOLDER);
  bind_textdomain_codeset ("celdepth", "UTF-8");
  celd_operation_register_type (module);
  for (gsize i = 0; i < n; i++)
    {
      const GTypeInfo type = {
        .class_size     = sizeof (CeldOperationClass),
        .class_init     = init_operation,
        .class_finalize = finalize_operation,
        .class_data     = infos[i],
        .instance_size  = sizeof (CeldOperation),
      };
      char           *name = g_strdup_printf ("CeldOperation-%s", strchr (infos[i]->name, ':') + 1);

      g_type_module_register_type (module, CELD_TYPE_OPERATION, name, &type, (GTypeFlags) 0);
      g_free (name);
    }
}
