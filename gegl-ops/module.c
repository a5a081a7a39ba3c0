/* The module that GEGL loads: every operation of the suite.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "op.h"

#define OPERATIONS(_) \
  _ (celdepth_virtual_contours) \
  _ (celdepth_lazybrush_segment) \
  _ (celdepth_depth_order) \
  _ (celdepth_depth_expand) \
  _ (celdepth_depth_smooth) \
  _ (celdepth_depth_exact) \
  _ (celdepth_lumo_shade) \
  _ (celdepth_depth_enhance) \
  _ (celdepth_relief) \
  _ (celdepth_stereo) \
  _ (celdepth_popup)

#define DECLARE(name) void gegl_op_ ## name ## _register_type (GTypeModule *module);
OPERATIONS (DECLARE)

G_MODULE_EXPORT const GeglModuleInfo *gegl_module_query (GTypeModule *module);
G_MODULE_EXPORT gboolean gegl_module_register (GTypeModule *module);

const GeglModuleInfo *
gegl_module_query (GTypeModule *module)
{
  static const GeglModuleInfo info = { GEGL_MODULE_ABI_VERSION };

  return &info;
}

gboolean
gegl_module_register (GTypeModule *module)
{
  celd_operation_register (module);
#define REGISTER(name) gegl_op_ ## name ## _register_type (module);
  OPERATIONS (REGISTER)
  return TRUE;
}
