/* The GEGL module of the operations that use OpenImageIO.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "oiio.h"

void gegl_op_celdepth_oiio_load_register_type (GTypeModule *module);
void gegl_op_celdepth_oiio_save_register_type (GTypeModule *module);

G_MODULE_EXPORT const GeglModuleInfo *gegl_module_query (GTypeModule *module);
G_MODULE_EXPORT gboolean gegl_module_register (GTypeModule *module);

GType
celd_load_content_get_type (void)
{
  static const GEnumValue values[] = {
    { CELD_LOAD_COLOURS, "Colours", "colours" },
    { CELD_LOAD_DEPTH, "Depth or levels", "depth" },
    { 0, NULL, NULL }
  };
  static GType            type;

  if (!type)
    type = g_enum_register_static ("CeldLoadContent", values);
  return type;
}

GType
celd_save_content_get_type (void)
{
  static const GEnumValue values[] = {
    { CELD_SAVE_COLOURS, "Colours", "colours" },
    { CELD_SAVE_DEPTH, "Depth or levels", "depth" },
    { CELD_SAVE_NORMALS, "Normals", "normals" },
    { CELD_SAVE_LIGHT, "Linear light", "light" },
    { 0, NULL, NULL }
  };
  static GType            type;

  if (!type)
    type = g_enum_register_static ("CeldSaveContent", values);
  return type;
}

const GeglModuleInfo *
gegl_module_query (GTypeModule *module)
{
  static const GeglModuleInfo info = { GEGL_MODULE_ABI_VERSION };

  return &info;
}

gboolean
gegl_module_register (GTypeModule *module)
{
  gegl_op_celdepth_oiio_load_register_type (module);
  gegl_op_celdepth_oiio_save_register_type (module);
  return TRUE;
}
