/* The endings that the names of outputs may have.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "outputs.h"

#include <string.h>

/* The endings of a kind of files, and whether a name without ending is a folder; NULL: any. */
static const struct { const char *endings; bool folder; } kinds[] = {
  [OUTPUT]   = { ".png, .exr, .tif or .npy", false },
  [JOINED]   = { ".png, .exr, .tif, .npy or .mpo", false },
  [FRAMES]   = { ".gif or .mpo", true },
  [MOVING]   = { ".png, .exr, .tif, .npy or .gif", true },
  [DEFORMED] = { ".png, .exr, .tif, .npy, .ora, .psd or .gif", true },
  [STACK]    = { ".ora, .psd or .exr", true },
  [COMPOSED] = { ".png, .tif, .npy, .ora, .psd or .exr", true },
  [MESH]     = { ".glb, .obj, .ply or .stl", false },
};

static bool
is_possible (CliFileKind kind, const char *name)
{
  switch (kind)
    {
    case OUTPUT:   return cli_can_write (name);
    case JOINED:   return cli_can_write (name) || celd_io_frames_kind (name) == CELD_IO_MPO;
    case FRAMES:   return celd_io_frames_kind (name) != CELD_IO_NO_FRAMES;
    case MOVING:   return cli_can_write (name) || cli_is_motion (name);
    case DEFORMED: return cli_can_write (name) || cli_is_motion (name) || celd_io_stack_kind (name);
    case STACK:    return celd_io_stack_kind (name) != CELD_IO_NO_STACK;
    case COMPOSED: return cli_can_write (name) || celd_io_stack_kind (name);
    case MESH:     return celd_io_mesh_kind (name) != CELD_IO_NO_MESH;
    default:       return true;
    }
}

/* Whether a text has the name of a picture, layers, an animation or a mesh, which no program could open then. */
static bool
is_no_text (const char *name)
{
  CeldIoStackKind  stack = celd_io_stack_kind (name);
  CeldIoFramesKind frames = celd_io_frames_kind (name);

  return cli_can_write (name) || (stack && stack != CELD_IO_FOLDER) || (frames && frames != CELD_IO_PNG_FRAMES) ||
         celd_io_mesh_kind (name);
}

bool
cli_ending_check (const CliOptions *options, const CliFile *file)
{
  const char *endings = file->kind < G_N_ELEMENTS (kinds) ? kinds[file->kind].endings : NULL;
  bool        json = file->path == options->report || file->path == options->review;

  if (file->kind == REPORT && is_no_text (file->path))
    return cli_error ("--%s %s: it is text, so the name must not be that of a picture. Let it end in %s.", file->option,
                      file->path, json ? ".json" : file->path == options->emit_slurm ? ".sh" : ".txt");
  if (is_possible (file->kind, file->path))
    return true;
  if (!g_strcmp0 (file->path, options->streams.output))
    return cli_error ("--format %s: for --%s it must be %s.", options->format, file->option, endings);
  return cli_error ("--%s %s: the name must end in %s%s.", file->option, file->path, endings,
                    kinds[file->kind].folder ? ", or have no ending for a folder" : "");
}
