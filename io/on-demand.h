/* The functions of celdepth-io.h for programs and modules that rarely need them.  They are in a module of their own,
 * celdepth-io.module, which the first call loads: loading OpenImageIO takes a third of a second, which would otherwise
 * be added to every program that uses GEGL.  The ending is not that of a library, since hosts load all of those that
 * they find in their folders of plug-ins.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELDEPTH_IO_ON_DEMAND_H
#define CELDEPTH_IO_ON_DEMAND_H

#include "celdepth-io.h"

/* Loads the module from the folder of the program or module that this is linked into, or else from where it is
 * installed.  Functions that cannot fail may be called after it, or after another function that did not fail. */
bool celd_io_load (CeldIoError *error);

/* What the module exports, under this name. */
#define CELD_IO_FUNCTIONS "celd_io_functions"

typedef struct
{
  size_t            size;             /* of this record, which tells a module of another version */
  CeldIoFile     *(*open)             (const char *path, CeldIoError *error);
  void            (*close)            (CeldIoFile *file);
  int             (*width)            (const CeldIoFile *file);
  int             (*height)           (const CeldIoFile *file);
  size_t          (*parts)            (const CeldIoFile *file);
  const CeldIoPart *(*part)           (const CeldIoFile *file, size_t part);
  size_t          (*find)             (const CeldIoFile *file, const char *name);
  const char     *(*profile)          (const CeldIoFile *file, size_t part, size_t *size);
  bool            (*read_colours)     (CeldIoFile *file, size_t part, float *rgba, CeldIoError *error);
  bool            (*read_values)      (CeldIoFile *file, size_t part, float *values, CeldIoError *error);
  bool            (*can_write)        (const char *path);
  bool            (*write_depth)      (const char *path, const CeldPlane *depth, float farthest, float nearest,
                                       CeldIoError *error);
  bool            (*write_normals)    (const char *path, const CeldVectors *normals, CeldIoError *error);
  bool            (*write_paint)      (const char *path, const CeldPaint *paint, CeldIoError *error);
  bool            (*write_light)      (const char *path, const CeldPlane *light, CeldIoError *error);
  CeldIoMeshKind  (*mesh_kind)        (const char *path);
  bool            (*write_meshes)     (const char *path, const CeldIoMesh *mesh, size_t n, const CeldColours *art,
                                       CeldIoError *error);
} CeldIoFunctions;

#endif
