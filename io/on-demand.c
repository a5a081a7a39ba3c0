/* Loads the module with the functions of celdepth-io.h at the first call of one of them, and calls them in it.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#define _GNU_SOURCE /* dladdr */

#include "on-demand.h"

#include <dlfcn.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define MODULE "celdepth-io.module"

static _Atomic (const CeldIoFunctions *) loaded;

/* ------------------------------------------------------------------ loading */

/* Whether the module is beside a program or module; its path then. */
static bool
is_beside (const char *file, char *path, size_t size)
{
  const char *slash = strrchr (file, '/');
  int         n = slash ? snprintf (path, size, "%.*s/" MODULE, (int) (slash - file), file) : -1;

  return n > 0 && (size_t) n < size && !access (path, R_OK);
}

/* The path of the module: beside this code, where a build or a user puts it, or else where it is installed.  The path
 * of a program is what its caller says, perhaps a name without a folder, or that of a link. */
static void
find_module (char *path, size_t size)
{
  Dl_info here;
  char    program[4096];
  ssize_t n = readlink ("/proc/self/exe", program, sizeof program - 1);

  program[n < 0 ? 0 : n] = 0;
  if ((!dladdr ((const void *) find_module, &here) || !is_beside (here.dli_fname, path, size)) &&
      !is_beside (program, path, size))
    snprintf (path, size, "%s/" MODULE, CELD_LIBEXEC_FOLDER);
}

static bool
refuse (CeldIoError *error, const char *why)
{
  error->reason = 0;
  snprintf (error->text, sizeof error->text, "Files can be neither read nor written, because celdepth's module for "
            "them cannot be used: %s. Install all files of celdepth together.", why);
  return false;
}

/* Threads that call this at the same time load the same module. */
bool
celd_io_load (CeldIoError *error)
{
  char                   path[4096];
  void                  *module;
  const CeldIoFunctions *functions;

  if (atomic_load (&loaded))
    return true;
  find_module (path, sizeof path);
  module = dlopen (path, RTLD_LAZY | RTLD_LOCAL | RTLD_NODELETE);
  if (!module)
    return refuse (error, dlerror ());
  functions = dlsym (module, CELD_IO_FUNCTIONS);
  if (!functions || functions->size != sizeof *functions)
    return refuse (error, "it is of another version");
  atomic_store (&loaded, functions);
  return true;
}

/* ------------------------------------------------------------------ the functions */

#define FALLIBLE(type, name, failure, parameters, arguments) \
  type celd_io_##name parameters { return celd_io_load (error) ? atomic_load (&loaded)->name arguments : (failure); }

#define INFALLIBLE(type, name, parameters, arguments) \
  type celd_io_##name parameters { return atomic_load (&loaded)->name arguments; }

FALLIBLE (CeldIoFile *, open, NULL, (const char *path, CeldIoError *error), (path, error))
FALLIBLE (bool, read_colours, false, (CeldIoFile *file, size_t part, float *rgba, CeldIoError *error),
          (file, part, rgba, error))
FALLIBLE (bool, read_values, false, (CeldIoFile *file, size_t part, float *values, CeldIoError *error),
          (file, part, values, error))
FALLIBLE (bool, write, false,
          (const char *path, const CeldIoPicture *parts, size_t n_parts, const CeldIoNote *notes, size_t n_notes,
           CeldIoError *error),
          (path, parts, n_parts, notes, n_notes, error))
FALLIBLE (bool, write_depth, false,
          (const char *path, const CeldPlane *depth, float farthest, float nearest, CeldIoError *error),
          (path, depth, farthest, nearest, error))
FALLIBLE (bool, write_normals, false, (const char *path, const CeldVectors *normals, CeldIoError *error),
          (path, normals, error))
FALLIBLE (bool, write_paint, false, (const char *path, const CeldPaint *paint, CeldIoError *error),
          (path, paint, error))
FALLIBLE (bool, write_colours, false, (const char *path, const CeldColours *colours, CeldIoError *error),
          (path, colours, error))
FALLIBLE (bool, write_light, false, (const char *path, const CeldPlane *light, CeldIoError *error),
          (path, light, error))
FALLIBLE (bool, write_layers, false, (const char *path, const CeldIoStack *stack, CeldIoError *error),
          (path, stack, error))
FALLIBLE (bool, write_heights, false, (const char *path, const CeldPlane *heights, CeldIoError *error),
          (path, heights, error))
FALLIBLE (bool, write_meshes, false,
          (const char *path, const CeldIoMesh *mesh, size_t n, const CeldColours *art, CeldIoError *error),
          (path, mesh, n, art, error))
FALLIBLE (bool, write_frames, false, (const char *path, const CeldIoFrames *frames, CeldIoError *error),
          (path, frames, error))

INFALLIBLE (int, width, (const CeldIoFile *file), (file))
INFALLIBLE (int, height, (const CeldIoFile *file), (file))
INFALLIBLE (size_t, parts, (const CeldIoFile *file), (file))
INFALLIBLE (const CeldIoPart *, part, (const CeldIoFile *file, size_t part), (file, part))
INFALLIBLE (size_t, find, (const CeldIoFile *file, const char *name), (file, name))
INFALLIBLE (const char *, profile, (const CeldIoFile *file, size_t part, size_t *size), (file, part, size))

void
celd_io_close (CeldIoFile *file)
{
  if (file)
    atomic_load (&loaded)->close (file);
}

void
celd_io_fork_reader (void)
{
  CeldIoError later; /* what needs the module will say so */

  if (celd_io_load (&later))
    atomic_load (&loaded)->fork_reader ();
}

void
celd_io_set_keeper (const CeldIoKeeper *keeper)
{
  atomic_load (&loaded)->set_keeper (keeper);
}

void
celd_io_mesh_files (const char *path, void (*take) (void *host, const char *name), void *host)
{
  CeldIoError later;

  if (celd_io_load (&later))
    atomic_load (&loaded)->mesh_files (path, take, host);
  else
    take (host, path);
}
