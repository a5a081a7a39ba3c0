/* From the layers of an image to depth: GeglBuffers in, GeglBuffers out.  What the plug-ins of GIMP share; all of the
 * method is in core.
 *
 *     CeldPipeline *pipeline = celd_pipeline_new (&input, &error);
 *
 *     if (pipeline && celd_pipeline_make (pipeline, 1u << CELD_PICTURE_DEPTH, progress, data, &error))
 *       celd_pipeline_write (pipeline, CELD_PICTURE_DEPTH, buffer);
 *     celd_pipeline_free (pipeline);
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_PIPELINE_H
#define CELD_PIPELINE_H

#include <gegl.h>

#include "celdepth.h"
#include "layer-names.h"

typedef enum
{
  CELD_PICTURE_REGIONS,           /* flat colours, transparent where celdepth added the background */
  CELD_PICTURE_LEVELS,            /* expanded levels, in [0,1], linear */
  CELD_PICTURE_DEPTH,             /* smooth depth, in [0,1], linear */
  CELD_PICTURE_NORMALS,           /* 0.5 + 0.5 n as the numbers that the buffer stores, encoded or linear */
  CELD_PICTURE_SHADING,           /* the light alone */
  CELD_PICTURE_LIT,               /* the drawing with light */
  CELD_PICTURE_ENHANCED,          /* the drawing with shadows */
  CELD_PICTURE_SUGGESTIONS,       /* suggested arrows on a transparent layer */
  CELD_N_PICTURES
} CeldPicture;

/* A layer, with the place of its upper left corner in the image; buffer NULL: there is none.  The host's number of the
 * layer tells whether another one is the same, whose buffer may be another; 0: unknown. */
typedef struct { GeglBuffer *buffer; int x, y, id; } CeldPipelineLayer;

typedef struct
{
  int               width, height;                /* of the image */
  CeldPipelineLayer layer[CELD_N_LAYERS];         /* of any size; borrowed until celd_pipeline_new returns */
  CeldSettings      settings;                     /* levels are in [0,1] whatever their encoding says */
  const char       *relations;                    /* may be NULL */
  const char       *arrow_path;                   /* SVG path data, arrows beside those of the layer; may be NULL */
} CeldPipelineInput;

#define CELD_PIPELINE_ERROR celd_pipeline_error_quark ()
typedef enum { CELD_PIPELINE_FAILED, CELD_PIPELINE_CANCELLED } CeldPipelineError;
GQuark celd_pipeline_error_quark (void);

typedef struct CeldPipeline CeldPipeline;

/* Reads all input.  NULL and *error, a sentence for the artist, if it makes no sense. */
CeldPipeline *celd_pipeline_new  (const CeldPipelineInput *input, GError **error);
void          celd_pipeline_free (CeldPipeline *pipeline); /* accepts NULL */

/* Reads an image of the same size again: all but the layers, and of these the ones whose bits 1 << CELD_LAYER_... are
 * in `layers`.  What has been made is kept as far as nothing that it depends on is another.  After a failure the
 * pipeline can only be freed. */
gboolean celd_pipeline_update (CeldPipeline *pipeline, const CeldPipelineInput *input, guint layers, GError **error);

/* Is called with the fraction that is done, which never decreases, and a name of the step; FALSE cancels. */
typedef gboolean (*CeldPipelineProgress) (gpointer data, double done, const char *step);

/* Makes pictures: the bits 1 << CELD_PICTURE_... of `wanted`.  progress may be NULL. */
gboolean celd_pipeline_make (CeldPipeline *pipeline, guint wanted, CeldPipelineProgress progress, gpointer data,
                             GError **error);

/* Writes a picture that was made into a buffer, from its pixel 0,0 on, in whatever format that has. */
gboolean celd_pipeline_write (CeldPipeline *pipeline, CeldPicture picture, GeglBuffer *buffer, GError **error);

/* Makes a preview of depth, which takes less time than depth, and writes it into a buffer of (width + 3) / 4 x (height
 * + 3) / 4 pixels, each of which stands for 4 x 4 pixels of the image; see celd_session_depth_preview. */
gboolean celd_pipeline_write_preview (CeldPipeline *pipeline, CeldPipelineProgress progress, gpointer data,
                                      GeglBuffer *buffer, GError **error);

/* Cuts the drawing into a layer for each region, from the back to the front, composited in linear light.  With
 * settings.complete layers have what nearer ones hide.  `bits` of 8 or less round colours so that 8 bits are exact. */
gboolean celd_pipeline_cut (CeldPipeline *pipeline, int bits, CeldPipelineProgress progress, gpointer data,
                            GError **error);
/* The layers that were cut; those of regions that have no pixel have no width.  The name is to be freed. */
gsize         celd_pipeline_n_layers    (const CeldPipeline *pipeline);
GeglRectangle celd_pipeline_layer_box   (const CeldPipeline *pipeline, gsize layer);
char         *celd_pipeline_layer_name  (const CeldPipeline *pipeline, gsize layer);
gboolean      celd_pipeline_write_layer (CeldPipeline *pipeline, gsize layer, GeglBuffer *buffer, GError **error);

/* Makes the views of both eyes, in linear light, of layers that are completed whatever the settings say. */
gboolean celd_pipeline_view (CeldPipeline *pipeline, CeldPipelineProgress progress, gpointer data, GError **error);
/* Writes the views in this arrangement into a buffer of the size that celd_stereo_size computes, from 0,0 on. */
gboolean celd_pipeline_write_views (CeldPipeline *pipeline, CeldStereo arrangement, GeglBuffer *buffer, GError **error);

/* Makes a relief: the lit drawing on rounded parts at their depth, with layers that are completed whatever the settings
 * say. */
gboolean celd_pipeline_make_relief (CeldPipeline *pipeline, CeldPipelineProgress progress, gpointer data,
                                    GError **error);
/* Writes a view of the relief, as it turns to and fro: from its left side in frame 0, from its right side in the last
 * of `frames`, which are 2 at least.  The view is scaled to the size of the buffer, which must not be larger than the
 * image, in pixels from 0,0 on. */
gboolean celd_pipeline_write_turned (CeldPipeline *pipeline, int frame, int frames, CeldPipelineProgress progress,
                                     gpointer data, GeglBuffer *buffer, GError **error);

/* Writes CELD_PICTURE_LEVELS or CELD_PICTURE_DEPTH that was made to a file, as celd_io_write_depth does. */
gboolean celd_pipeline_save (CeldPipeline *pipeline, CeldPicture picture, const char *path, GError **error);
/* Writes a layer with levels or depth, farthest outside it, as celd_io_write_depth does.  Of a layer with few bits the
 * numbers get the precision of the picture, which was made, wherever they are rounded from it; pipeline NULL: none
 * do. */
gboolean celd_pipeline_save_layer (CeldPipeline *pipeline, CeldPicture picture, const CeldPipelineLayer *layer,
                                   int width, int height, const char *path, GError **error);
/* Makes a model, or with CELD_MESH_HEIGHTFIELD one surface, and writes it to a file, as celd_io_write_meshes does.
 * With CELD_MESH_AUTO parts are solid in .stl, and else surfaces. */
gboolean celd_pipeline_save_model (CeldPipeline *pipeline, const char *path, CeldPipelineProgress progress,
                                   gpointer data, GError **error);

/* What the artist should know of what was made, a line for each problem; NULL: nothing.  Free it. */
char *celd_pipeline_problems (CeldPipeline *pipeline);

/* The same one by one, all of them, with places: CeldPipelineProblem, whose texts are freed with the array. */
typedef struct { char *text; int x, y; } CeldPipelineProblem; /* x -1: it has no place */
GArray *celd_pipeline_problem_list (CeldPipeline *pipeline);

#endif
