/* Reads and writes pictures, layers and meshes in files, for the command and the GEGL operations: a C interface to
 * OpenImageIO and libzip.
 *
 * Reading: open a file, look at its parts (layers of a PSD, OpenRaster or Krita file, parts of an EXR, pages of a TIFF;
 * an ordinary picture has one), and read those that are wanted.  Every part has the size of the canvas, and is
 * transparent where it has no pixels.  Alpha is always straight.  Files are decoded in a process of its own, because
 * damaged ones can crash a decoder or make it ask for any amount of memory.
 * Writing: a file appears complete or not at all, because it is written under a temporary name and then renamed.
 *
 * Colours are not converted: they are encoded by the embedded profile (sRGB if there is none), or linear light.  No
 * function throws or prints.  All may be called from any thread, with one file from one thread at a time.  The only
 * global state is the connection to the reading process, and who completes files (celd_io_set_keeper).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELDEPTH_IO_H
#define CELDEPTH_IO_H

#include "celdepth.h"

#ifdef __cplusplus
extern "C" {
#endif

/* An English sentence that names the file and says what is wrong; set when a function fails.  What is wrong begins at
 * text + reason, for hosts that say the rest in another language. */
typedef struct { char text[1024]; size_t reason; } CeldIoError;

/* ------------------------------------------------------------------ reading */

typedef struct CeldIoFile CeldIoFile;

typedef struct
{
  const char *name;      /* of the layer or part; "" if it has none, like the merged picture, part 0 of PSD, ORA, KRA */
  bool        alpha;     /* the part has alpha, or does not cover the canvas */
  bool        grey;      /* red, green and blue are the same */
  bool        linear;    /* linear light (EXR, HDR); else encoded */
  int         bits;      /* of a channel: 8, 16, 32 */
  bool        frame;     /* the first of several frames or pages of a size, which may be no parts */
} CeldIoPart;

/* Forks the reading process off this program, in 2 ms; the program must have a single thread when it calls this.
 * Otherwise the first file that is opened starts the program celdepth-read, in 0.2 s, from the folder of the module or
 * program that contains this library, or else from where it is installed. */
void celd_io_fork_reader (void);

CeldIoFile *celd_io_open  (const char *path, CeldIoError *error);        /* NULL: see error */
void        celd_io_close (CeldIoFile *file);                            /* accepts NULL */

/* The canvas, the same for all parts: 1 .. CELD_MAX_SIDE. */
int celd_io_width  (const CeldIoFile *file);
int celd_io_height (const CeldIoFile *file);

size_t            celd_io_parts (const CeldIoFile *file);                /* at least one */
const CeldIoPart *celd_io_part  (const CeldIoFile *file, size_t part);   /* lives as long as the file */

/* The first part of that name, ignoring case; CELD_NO_INDEX if there is none. */
size_t celd_io_find (const CeldIoFile *file, const char *name);

/* The embedded ICC profile; NULL if there is none.  Lives as long as the file. */
const char *celd_io_profile (const CeldIoFile *file, size_t part, size_t *size);

/* Colours: width x height x R,G,B,A, straight alpha, opaque where the file has no alpha. */
bool celd_io_read_colours (CeldIoFile *file, size_t part, float *rgba, CeldIoError *error);

/* Values (levels, depth): width x height numbers, as they were given to celd_io_write_depth; of other pictures the
 * first channel as it is stored (integers as [0,1]).  0 outside the part. */
bool celd_io_read_values (CeldIoFile *file, size_t part, float *values, CeldIoError *error);

/* ------------------------------------------------------------------ writing */

/* Who completes what was written, so that several results can appear together: `complete` gives a file or folder its
 * name, at once or later; false: that failed, for the reason in errno.  `owns` says whether a folder that is not empty
 * may be written again.  Without a keeper, files get their names at once, and such a folder is refused. */
typedef struct
{
  bool (*complete) (const char *unfinished, const char *path);
  bool (*owns)     (const char *folder);
} CeldIoKeeper;

/* To be called while nothing is being written; the record is not copied. */
void celd_io_set_keeper (const CeldIoKeeper *keeper);

typedef enum { CELD_IO_8_BIT, CELD_IO_16_BIT, CELD_IO_FLOAT } CeldIoSample;

/* One channel; integers are written from [0,1]. */
typedef struct
{
  const char  *name;     /* "R", "A", "Z", "N.X", ...; kept by EXR, elsewhere the order counts */
  const float *data;
  size_t       column, row; /* floats from one pixel to the next, and from one row to the next */
} CeldIoChannel;

/* One part of a file. */
typedef struct
{
  const char          *name;     /* NULL: none; in a file of several parts all need names */
  int                  width, height;
  CeldIoSample         sample;
  bool                 srgb;     /* colours, tagged as sRGB; else numbers without a tag */
  const CeldIoChannel *channel;
  int                  channels; /* alpha is named "A", and straight */
} CeldIoPicture;

/* An attribute of the file's header: a text, or a number if text is NULL. */
typedef struct { const char *name; const char *text; float number; } CeldIoNote;

/* Whether celd_io_write can write this file name: it ends in .exr, .png, .tif or .tiff, in any case. */
bool celd_io_can_write (const char *path);

/* Writes any picture.  Only EXR files can have several parts. */
bool celd_io_write (const char *path, const CeldIoPicture *parts, size_t n_parts,
                    const CeldIoNote *notes, size_t n_notes, CeldIoError *error);

/* Writes depth or levels, larger = nearer.  `farthest` and `nearest` (0 and 1 for normalised levels, 0 and levels - 1
 * for CELD_ENCODING_RANK) are the values at the far and near end of the format's range:
 *   .exr   Z = distance: far - d (far - near), with near = 1 and far = 2, and depth.V = d in [0,1]; floats
 *   .png   d in 16 bits, near = white, no colour tag
 *   .tif   the values as they are, floats
 * with d = (value - farthest) / (nearest - farthest).  From attributes in the header celd_io_read_values computes the
 * original values. */
bool celd_io_write_depth (const char *path, const CeldPlane *depth, float farthest, float nearest, CeldIoError *error);

/* Writes normals: .exr as signed floats in N.X, N.Y, N.Z; .png and .tif as 0.5 + 0.5 n in 16 bits, y up (OpenGL). */
bool celd_io_write_normals (const char *path, const CeldVectors *normals, CeldIoError *error);

/* Writes sRGB colours of 8 bits with straight alpha; in .exr as linear light. */
bool celd_io_write_paint (const char *path, const CeldPaint *paint, CeldIoError *error);

/* Writes colours in linear light with straight alpha: .exr and .tif as floats; .png in 16 bits, encoded as sRGB. */
bool celd_io_write_colours (const char *path, const CeldColours *colours, CeldIoError *error);

/* Writes linear light in [0,1]: .exr and .tif as floats; .png in 16 bits, encoded as sRGB. */
bool celd_io_write_light (const char *path, const CeldPlane *light, CeldIoError *error);

/* ------------------------------------------------------------------ layers */

/* Names may have any characters; EXR needs different names.  A box of width 0 is written as one transparent pixel.  The
 * members after the box are written in the description of a folder alone. */
typedef struct
{
  const char *name;
  CeldRect    box;
  uint8_t     colour[4];               /* of the region: r, g, b, a; a 0: none */
  uint32_t    label, level;
  bool        background;
  CeldJoint   joint;
} CeldIoLayer;

typedef struct
{
  int                width, height;    /* of the canvas */
  const CeldIoLayer *layer;            /* from back to front, boxes within the canvas */
  size_t             layers;
  const float       *merged;           /* the composite of all layers: width x height x R,G,B,A, straight alpha */
  /* Paints the box of a layer, straight alpha; returns false to stop the writing. */
  bool             (*paint) (void *host, size_t layer, float *rgba);
  void              *host;
} CeldIoStack;

/* The kind of file, by the ending of its name:
 *   .ora    OpenRaster 0.0.5: zip, PNG and XML; 8 bits, sRGB
 *   .psd    Photoshop document, 8 bits; only in builds with ImageMagick
 *   .exr    a part for each layer, in this order, floats in linear light, with data windows
 *   none    a folder, empty or new, with a PNG of the whole canvas for each layer, numbered from the back; 8 bits,
 *           sRGB; and layers.json, which describes them (docs/layers.md) */
typedef enum { CELD_IO_NO_STACK, CELD_IO_OPEN_RASTER, CELD_IO_PSD, CELD_IO_EXR_PARTS, CELD_IO_FOLDER } CeldIoStackKind;
CeldIoStackKind celd_io_stack_kind (const char *path);

/* Calls paint once for each layer.  If it returns false, nothing is written, and the error is empty. */
bool celd_io_write_layers (const char *path, const CeldIoStack *stack, CeldIoError *error);

/* ------------------------------------------------------------------ meshes and heights */

/* Writes heights in any unit: .exr (channel Y) and .tif as floats; .png in 16 bits, the lowest black, the highest
 * white, which attributes of the header give as "celdepth:farthest" and "celdepth:nearest". */
bool celd_io_write_heights (const char *path, const CeldPlane *heights, CeldIoError *error);

/* The kind of file, by the ending of its name:
 *   .glb   glTF 2.0, binary, metres; the art is its texture
 *   .obj   Wavefront, millimetres; with NAME.mtl, and the art as NAME-texture.png, beside it
 *   .ply   binary, millimetres; each vertex has the colour of the art there
 *   .stl   binary, millimetres, without the art */
typedef enum { CELD_IO_NO_MESH, CELD_IO_GLB, CELD_IO_OBJ, CELD_IO_PLY, CELD_IO_STL } CeldIoMeshKind;
CeldIoMeshKind celd_io_mesh_kind (const char *path);

/* Calls `take` with the name of each file that writing a mesh makes: its own, and those beside it. */
void celd_io_mesh_files (const char *path, void (*take) (void *host, const char *name), void *host);

/* Writes n meshes: .glb and .obj keep them apart, by their names.  The art of all of them is sRGB with straight alpha,
 * and is composited on white; NULL: none. */
typedef struct { const char *name; const CeldReliefMesh *mesh; } CeldIoMesh;
bool celd_io_write_meshes (const char *path, const CeldIoMesh *mesh, size_t n, const CeldColours *art,
                           CeldIoError *error);

/* ------------------------------------------------------------------ several pictures of one size */

typedef struct
{
  int          width, height;
  size_t       frames;
  double       per_second;             /* frames of a GIF */
  int          most_side;              /* larger GIFs are scaled down to this width or height; 0: no limit */
  /* Paints a frame in linear light, straight alpha; returns false to stop the writing. */
  bool       (*paint) (void *host, size_t frame, float *rgba);
  void        *host;
} CeldIoFrames;

/* The kind of file, by the ending of its name:
 *   .gif    an animation that repeats, on white paper; 256 colours, of which each that fills a thousandth of a frame
 * is exact
 *   .mpo    views from left to right (CIPA DC-007), as JPEG on white paper
 *   none    a folder, empty or new, with 000.png, 001.png, ...; 8 bits, sRGB, with alpha */
typedef enum { CELD_IO_NO_FRAMES, CELD_IO_GIF, CELD_IO_MPO, CELD_IO_PNG_FRAMES } CeldIoFramesKind;
CeldIoFramesKind celd_io_frames_kind (const char *path);

/* Calls paint once for each frame.  If it returns false, nothing is written, and the error is empty. */
bool celd_io_write_frames (const char *path, const CeldIoFrames *frames, CeldIoError *error);

#ifdef __cplusplus
}
#endif

#endif
