/* The module that on-demand.c loads.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "on-demand.h"

__attribute__ ((visibility ("default"))) extern const CeldIoFunctions celd_io_functions;

const CeldIoFunctions celd_io_functions = {
  .size          = sizeof celd_io_functions,
  .fork_reader   = celd_io_fork_reader,
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
  .set_keeper    = celd_io_set_keeper,
  .write         = celd_io_write,
  .write_depth   = celd_io_write_depth,
  .write_normals = celd_io_write_normals,
  .write_paint   = celd_io_write_paint,
  .write_colours = celd_io_write_colours,
  .write_light   = celd_io_write_light,
  .write_layers  = celd_io_write_layers,
  .write_heights = celd_io_write_heights,
  .mesh_files    = celd_io_mesh_files,
  .write_meshes  = celd_io_write_meshes,
  .write_frames  = celd_io_write_frames,
};
