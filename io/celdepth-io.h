/* Pictures in and out of files, for the command line and the GEGL operations; a C face for OpenImageIO, which is C++.
 *
 * Files are read in a process of its own: damaged ones can crash a reader, or make it ask for any amount of memory.
 * Reading: open a file, look at its parts (the layers of a PSD, the parts of an EXR, the pages of a TIFF; one part in
 * an ordinary picture), read the parts that are wanted.  Every part comes as large as the canvas, at its place on it,
 * transparent around.  Alpha is straight, whatever the file does.
 * Writing: a picture appears complete or not at all: it is written beside its name and then moved there.  So does a
 * stack of layers.
 *
 * Colour stays as it is in the file: encoded by the embedded profile (sRGB if there is none), or linear light; the
 * caller converts.  No function of this file throws or prints; all may be called from any thread, a file from one at a
 * time.  The only global state is the process that reads.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELDEPTH_IO_H
#define CELDEPTH_IO_H

#include "celdepth.h"

#ifdef __cplusplus
extern "C" {
#endif

/* One English sentence that names the file and says what is wrong with it; set whenever a function fails. */
typedef struct { char text[1024]; } CeldIoError;

/* ------------------------------------------------------------------ reading */

typedef struct CeldIoFile CeldIoFile;

typedef struct
{
  const char *name;      /* of the layer or part; "" if it has none (as part 0 of a PSD, the merged picture) */
  bool        alpha;     /* has alpha, or does not cover the canvas */
  bool        grey;      /* red, green and blue are the same */
  bool        linear;    /* linear light (EXR, HDR); else encoded */
  int         bits;      /* of a channel: 8, 16, 32 */
} CeldIoPart;

/* For programs that have one thread when they call this: copies this program to be the process that reads, which costs
 * 2 ms.  Without it the first file that is opened starts the program celdepth-read, in 0.2 s: it lies beside the module
 * or program that this library is part of, or where it is installed. */
void celd_io_fork_reader (void);

CeldIoFile *celd_io_open  (const char *path, CeldIoError *error);        /* NULL: see error */
void        celd_io_close (CeldIoFile *file);                            /* accepts NULL */

/* The canvas, the same for all parts: 1 .. CELD_MAX_SIDE. */
int celd_io_width  (const CeldIoFile *file);
int celd_io_height (const CeldIoFile *file);

size_t            celd_io_parts (const CeldIoFile *file);                /* at least one */
const CeldIoPart *celd_io_part  (const CeldIoFile *file, size_t part);   /* lives as long as the file */

/* The first part of that name, upper or lower case; CELD_NO_INDEX if there is none. */
size_t celd_io_find (const CeldIoFile *file, const char *name);

/* The embedded ICC profile; NULL if there is none.  Lives as long as the file. */
const char *celd_io_profile (const CeldIoFile *file, size_t part, size_t *size);

/* Colours: width x height x R,G,B,A, straight alpha, opaque where the file has no alpha. */
bool celd_io_read_colours (CeldIoFile *file, size_t part, float *rgba, CeldIoError *error);

/* Values (levels, depth): width x height numbers as they were given to celd_io_write_depth; of other pictures the first
 * channel as it is stored (integers as [0,1]).  0 outside the part. */
bool celd_io_read_values (CeldIoFile *file, size_t part, float *values, CeldIoError *error);

/* ------------------------------------------------------------------ writing */

typedef enum { CELD_IO_8_BIT, CELD_IO_16_BIT, CELD_IO_FLOAT } CeldIoSample;

/* One channel; integers are written from [0,1]. */
typedef struct
{
  const char  *name;     /* "R", "A", "Z", "N.X", ...; kept by EXR, elsewhere the order counts */
  const float *data;
  size_t       column, row; /* floats from a pixel to the next, from a row to the next */
} CeldIoChannel;

/* One part of a file. */
typedef struct
{
  const char          *name;     /* NULL: none; a file of several parts must name all */
  int                  width, height;
  CeldIoSample         sample;
  bool                 srgb;     /* colours that are tagged sRGB; else numbers without a tag */
  const CeldIoChannel *channel;
  int                  channels; /* alpha is named "A" and comes straight */
} CeldIoPicture;

/* A remark in the header: a text, or where text is NULL a number. */
typedef struct { const char *name; const char *text; float number; } CeldIoNote;

/* Can this file name be written?  By its ending: .exr .png .tif .tiff (upper or lower case). */
bool celd_io_can_write (const char *path);

/* Any picture.  Only EXR holds several parts. */
bool celd_io_write (const char *path, const CeldIoPicture *parts, size_t n_parts,
                    const CeldIoNote *notes, size_t n_notes, CeldIoError *error);

/* Depth or levels, larger = nearer.  `farthest` and `nearest` (0 and 1; 0 and levels - 1 for ranks) are the values that
 * the format shows as its far and near end:
 *   .exr   Z = distance: far - d (far - near), with near = 1 and far = 2, and depth.V = d in [0,1]; floats
 *   .png   d in 16 bits, near = white, no colour tag
 *   .tif   the values as they are, floats
 * with d = (value - farthest) / (nearest - farthest).  Header notes let celd_io_read_values give the values back. */
bool celd_io_write_depth (const char *path, const CeldPlane *depth, float farthest, float nearest, CeldIoError *error);

/* Normals: .exr N.X N.Y N.Z signed floats; .png and .tif 0.5 + 0.5 n in 16 bits, green up (OpenGL). */
bool celd_io_write_normals (const char *path, const CeldVectors *normals, CeldIoError *error);

/* Colours of 8 bits with straight alpha, sRGB; in .exr linear light. */
bool celd_io_write_paint (const char *path, const CeldPaint *paint, CeldIoError *error);

/* Colours in linear light with straight alpha: .exr and .tif floats; .png 16 bits, encoded and tagged as sRGB. */
bool celd_io_write_colours (const char *path, const CeldColours *colours, CeldIoError *error);

/* Linear light in [0,1]: .exr and .tif floats; .png 16 bits, encoded and tagged as sRGB. */
bool celd_io_write_light (const char *path, const CeldPlane *light, CeldIoError *error);

/* ------------------------------------------------------------------ layers */

/* A name may have any characters; EXR wants each only once.  A box of width 0 is one transparent pixel. */
typedef struct { const char *name; CeldRect box; } CeldIoLayer;

typedef struct
{
  int                width, height;    /* of the canvas */
  const CeldIoLayer *layer;            /* from back to front, boxes within the canvas */
  size_t             layers;
  const float       *merged;           /* the picture that the layers make: as wide and high, r,g,b,a, straight alpha */
  bool             (*paint) (void *host, size_t layer, float *rgba); /* a layer's box, straight alpha; false: give up */
  void              *host;
} CeldIoStack;

/* By the ending of the name:
 *   .ora    OpenRaster 0.0.5: zip, PNG and XML; 8 bits, sRGB
 *   .exr    a part for each layer, in this order, floats in linear light, with data windows
 *   none    a folder that is empty or does not exist: a PNG of the canvas for each layer, numbered from the back;
 *           8 bits, sRGB */
typedef enum { CELD_IO_NO_STACK, CELD_IO_OPEN_RASTER, CELD_IO_EXR_PARTS, CELD_IO_FOLDER } CeldIoStackKind;
CeldIoStackKind celd_io_stack_kind (const char *path);

/* Layers are asked for one by one, each once.  If paint gives up, nothing is written and the error is empty. */
bool celd_io_write_layers (const char *path, const CeldIoStack *stack, CeldIoError *error);

/* ------------------------------------------------------------------ meshes and heights */

/* Heights in any unit: .exr (channel Y) and .tif as they are, floats; .png in 16 bits from the least, black, to
 * the largest, white, which the header has as notes "celdepth:farthest" and "celdepth:nearest". */
bool celd_io_write_heights (const char *path, const CeldPlane *heights, CeldIoError *error);

/* By the ending of the name:
 *   .glb   glTF 2.0, binary, metres; the art is its texture
 *   .obj   Wavefront, millimetres; with NAME.mtl and the art as NAME-texture.png beside it
 *   .ply   binary, millimetres; each vertex has the colour of the art there
 *   .stl   binary, millimetres, without the art */
typedef enum { CELD_IO_NO_MESH, CELD_IO_GLB, CELD_IO_OBJ, CELD_IO_PLY, CELD_IO_STL } CeldIoMeshKind;
CeldIoMeshKind celd_io_mesh_kind (const char *path);

/* The art is encoded as sRGB, straight alpha, and comes over white; NULL: none. */
bool celd_io_write_mesh (const char *path, const CeldReliefMesh *mesh, const CeldColours *art, CeldIoError *error);

/* ------------------------------------------------------------------ several pictures of one size */

typedef struct
{
  int          width, height;
  size_t       frames;
  double       per_second;             /* how fast a GIF moves */
  int          most_side;              /* a larger GIF is reduced; 0: none is */
  bool       (*paint) (void *host, size_t frame, float *rgba); /* linear light, straight alpha; false: give up */
  void        *host;
} CeldIoFrames;

/* By the ending of the name:
 *   .gif    moves, again and again; 256 colours a picture, on white paper
 *   .mpo    views from left to right (CIPA DC-007), JPEGs on white paper
 *   none    a folder that is empty or does not exist: 000.png, 001.png, ...; 8 bits, sRGB, with alpha */
typedef enum { CELD_IO_NO_FRAMES, CELD_IO_GIF, CELD_IO_MPO, CELD_IO_PNG_FRAMES } CeldIoFramesKind;
CeldIoFramesKind celd_io_frames_kind (const char *path);

/* Frames are asked for one by one, each once.  If paint gives up, nothing is written and the error is empty. */
bool celd_io_write_frames (const char *path, const CeldIoFrames *frames, CeldIoError *error);

#ifdef __cplusplus
}
#endif

#endif
