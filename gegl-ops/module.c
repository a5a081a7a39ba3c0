/* The GEGL module of all operations that do not use OpenImageIO.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "op.h"

extern const CeldOperationInfo celd_virtual_contours_operation, celd_lazybrush_segment_operation,
  celd_depth_order_operation, celd_depth_expand_operation, celd_depth_smooth_operation, celd_depth_exact_operation,
  celd_lumo_shade_operation, celd_depth_enhance_operation, celd_relief_operation, celd_stereo_operation,
  celd_arap_register_operation, celd_depth_propagate_operation, celd_arap_deform_operation,
  celd_compose_operation, celd_popup_operation, celd_live_popup_operation;

const CeldOperationInfo *const celd_operations[] = {
  &celd_virtual_contours_operation, &celd_lazybrush_segment_operation, &celd_depth_order_operation,
  &celd_depth_expand_operation,     &celd_depth_smooth_operation,      &celd_depth_exact_operation,
  &celd_lumo_shade_operation,       &celd_depth_enhance_operation,     &celd_relief_operation,
  &celd_stereo_operation,           &celd_arap_register_operation,     &celd_depth_propagate_operation,
  &celd_arap_deform_operation,      &celd_compose_operation,           &celd_popup_operation,
  &celd_live_popup_operation,
  NULL
};

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
  celd_operations_register (module, celd_operations, G_N_ELEMENTS (celd_operations) - 1);
  return TRUE;
}
