/* The kinds of files that are written, by the endings of their names; without OpenImageIO, so that a program can check
 * names before it loads that.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "file-kinds.h"

#include <string.h>
#include <strings.h>

/* The ending of a file name with its dot, "" if it has none.  A dot that begins a name does not begin an ending. */
static const char *
ending_of (const char *path)
{
  const char *slash = strrchr (path, '/'), *name = slash ? slash + 1 : path, *dot = strrchr (name, '.');

  return !dot || dot == name || !strcmp (name, "..") ? "" : dot;
}

static bool
ends_in (const char *path, const char *ending)
{
  return !strcasecmp (ending_of (path), ending);
}

CeldIoFormat
celd_io_format (const char *path)
{
  return ends_in (path, ".exr") ? CELD_IO_EXR :
         ends_in (path, ".png") ? CELD_IO_PNG :
         ends_in (path, ".tif") || ends_in (path, ".tiff") ? CELD_IO_TIFF : CELD_IO_NO_FORMAT;
}

bool
celd_io_can_write (const char *path)
{
  return celd_io_format (path) != CELD_IO_NO_FORMAT;
}

CeldIoStackKind
celd_io_stack_kind (const char *path)
{
  return ends_in (path, "") ? CELD_IO_FOLDER :
         ends_in (path, ".ora") ? CELD_IO_OPEN_RASTER :
         ends_in (path, ".psd") ? CELD_IO_PSD :
         ends_in (path, ".exr") ? CELD_IO_EXR_PARTS : CELD_IO_NO_STACK;
}

CeldIoMeshKind
celd_io_mesh_kind (const char *path)
{
  return ends_in (path, ".glb") ? CELD_IO_GLB :
         ends_in (path, ".obj") ? CELD_IO_OBJ :
         ends_in (path, ".ply") ? CELD_IO_PLY :
         ends_in (path, ".stl") ? CELD_IO_STL : CELD_IO_NO_MESH;
}

CeldIoFramesKind
celd_io_frames_kind (const char *path)
{
  return ends_in (path, "") ? CELD_IO_PNG_FRAMES :
         ends_in (path, ".gif") ? CELD_IO_GIF :
         ends_in (path, ".mpo") ? CELD_IO_MPO : CELD_IO_NO_FRAMES;
}
