/* The functions of celdepth-io.h for programs and modules that do not always need them.  They are in a module of their
 * own, celdepth-io.module, which the first call loads: loading OpenImageIO takes a third of a second, which would
 * otherwise be added to every program that uses GEGL, and to every answer of the command about its options.  The ending
 * is not that of a library, since hosts load all of those that they find in their folders of plug-ins.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELDEPTH_IO_ON_DEMAND_H
#define CELDEPTH_IO_ON_DEMAND_H

#include "celdepth-io.h"

/* Loads the module from the folder of the program or module that this is linked into, or else from where it is
 * installed.  Functions that cannot fail may be called after it, or after another function that did not fail; those
 * that tell the kind of a file by its name, at any time. */
bool celd_io_load (CeldIoError *error);

/* What the module exports, under this name. */
#define CELD_IO_FUNCTIONS "celd_io_functions"

typedef struct
{
  size_t            size;             /* of this record, which tells a module of another version */
  void            (*fork_reader)      (void);
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
  void            (*set_keeper)       (const CeldIoKeeper *keeper);
  bool            (*write)            (const char *path, const CeldIoPicture *parts, size_t n_parts,
                                       const CeldIoNote *notes, size_t n_notes, CeldIoError *error);
  bool            (*write_depth)      (const char *path, const CeldPlane *depth, float farthest, float nearest,
                                       CeldIoError *error);
  bool            (*write_normals)    (const char *path, const CeldVectors *normals, CeldIoError *error);
  bool            (*write_paint)      (const char *path, const CeldPaint *paint, CeldIoError *error);
  bool            (*write_colours)    (const char *path, const CeldColours *colours, CeldIoError *error);
  bool            (*write_light)      (const char *path, const CeldPlane *light, CeldIoError *error);
  bool            (*write_layers)     (const char *path, const CeldIoStack *stack, CeldIoError *error);
  bool            (*write_heights)    (const char *path, const CeldPlane *heights, CeldIoError *error);
  void            (*mesh_files)       (const char *path, void (*take) (void *host, const char *name), void *host);
  bool            (*write_meshes)     (const char *path, const CeldIoMesh *mesh, size_t n, const CeldColours *art,
                                       CeldIoError *error);
  bool            (*write_frames)     (const char *path, const CeldIoFrames *frames, CeldIoError *error);
} CeldIoFunctions;

#endif
