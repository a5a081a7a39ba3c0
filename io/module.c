/* The module that on-demand.c loads.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "on-demand.h"

__attribute__ ((visibility ("default"))) extern const CeldIoFunctions celd_io_functions;

const CeldIoFunctions celd_io_functions = {
  .size          = sizeof celd_io_functions,
  .open          = celd_io_open,
  .close         = celd_io_close,
  .width         = celd_io_width,
  .height        = celd_io_height,
  .parts         = celd_io_parts,
  .part          = celd_io_part,
  .find          = celd_io_find,
  .profile       = celd_io_profile,
  .read_colours  = celd_io_read_colours,
  .read_values   = celd_io_read_values,
  .can_write     = celd_io_can_write,
  .write_depth   = celd_io_write_depth,
  .write_normals = celd_io_write_normals,
  .write_paint   = celd_io_write_paint,
  .write_light   = celd_io_write_light,
  .mesh_kind     = celd_io_mesh_kind,
  .write_meshes  = celd_io_write_meshes,
};
