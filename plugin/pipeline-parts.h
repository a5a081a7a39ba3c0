/* What the files of the pipeline share.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_PIPELINE_PARTS_H
#define CELD_PIPELINE_PARTS_H

#include "pipeline.h"
#include "translate.h"

struct CeldPipeline
{
  CeldSession     *session;
  CeldSettings     settings;
  int              width, height;
  CeldColours      art;               /* the drawing in linear light */
  CeldColours      lit, enhanced;     /* data NULL: not made */
  const CeldOrder *order;             /* of the session; NULL: not made */
  CeldLayers      *layers;            /* NULL: not cut */
  CeldColours      view[2];           /* of the left and the right eye; data NULL: not made */
  CeldLayers      *relief_layers;     /* of the relief: lit and completed; NULL: not made */
  CeldPlane        relief_depth;      /* of the relief: its heights as depth in [0,1] */
  CeldScene       *relief;            /* of these two; NULL: not made */
  double           relief_height;     /* pixels from its farthest point to its nearest */
  gboolean         unsure;            /* whether the drawing may be a photograph */
  char            *note;              /* for the artist, beside the problems of the session; NULL: nothing */
};

#define OF(picture) (1u << CELD_PICTURE_##picture)

/* Sets *error to a sentence for the artist; FALSE. */
gboolean celd_pipeline_fail (GError **error, const char *format, ...) G_GNUC_PRINTF (2, 3);
/* TRUE if the status is CELD_OK; else *error has its text. */
gboolean celd_pipeline_try (CeldStatus status, GError **error);

/* Memory for so many components a pixel, `size` bytes each, and pictures, not cleared; data NULL if there is none. */
gpointer    celd_pipeline_new_picture (const CeldPipeline *p, gsize components, gsize size);
CeldPlane   celd_pipeline_new_plane   (const CeldPipeline *p);
CeldPaint   celd_pipeline_new_paint   (const CeldPipeline *p);
CeldColours celd_pipeline_new_colours (const CeldPipeline *p);

/* An image of this size, in coordinates of the layer's buffer. */
GeglRectangle celd_pipeline_rectangle (const CeldPipelineLayer *layer, int width, int height);

/* Progress of one step, which begins at `from`, as that of all; a CeldHost.progress for it. */
typedef struct
{
  CeldPipelineProgress progress;
  gpointer             data;
  const char          *name;
  double               from, part;
} CeldPipelineReport;
bool celd_pipeline_report (void *report, double done);
/* The same for steps that have progress of their own; a CeldPipelineProgress. */
gboolean celd_pipeline_report_steps (gpointer report, double done, const char *step);

/* TRUE unless scribbles or the drawing are a photograph, or exchanged; else *error has a sentence for the artist.  Of
 * these two, those are examined that are among `layers`, as bits.  Sets p->unsure. */
gboolean celd_pipeline_check_layers (CeldPipeline *p, const CeldPipelineInput *input, guint layers, GError **error);
/* TRUE if the drawing, which the session has, has lines, and no other layer has them, too; else *error has a sentence for
 * the artist.  Those layers are examined that are among `layers`, as bits. */
gboolean celd_pipeline_check_lines (CeldPipeline *p, const CeldPipelineInput *input, guint layers, GError **error);
/* TRUE if a layer can be depth or levels, which are grey. */
gboolean celd_pipeline_check_grey (const CeldPipelineLayer *layer, GError **error);

/* The numbers of CELD_PICTURE_LEVELS or CELD_PICTURE_DEPTH, which was made; the session's. */
CeldStatus celd_pipeline_ask_depth (CeldPipeline *p, CeldPicture picture, CeldPlane *numbers);

/* Gives `numbers`, those of a layer in an image, the precision that the layer has no bits for: where the layer has what
 * the picture, which was made, is in its format, they become those of the picture.  Says how many. */
CeldStatus celd_pipeline_refine (CeldPipeline *p, CeldPicture picture, const CeldPipelineLayer *layer,
                                 CeldPlane *numbers, gsize *refined);

/* Replaces a picture (data may be NULL) by a copy of the art. */
CeldStatus celd_pipeline_copy_art (const CeldPipeline *p, CeldColours *copy);

/* Has layers completed, or again as the settings say. */
CeldStatus celd_pipeline_complete_layers (CeldPipeline *p, bool complete);
/* Cuts colours of the image's size, which are limited to [0,1] in place.  Replaces *layers (may be NULL). */
CeldStatus celd_pipeline_cut_colours (CeldPipeline *p, CeldColours *colours, CeldStore store, const CeldHost *host,
                                      CeldLayers **layers);

/* Frees what celd_pipeline_make_relief has made. */
void celd_pipeline_drop_relief (CeldPipeline *p);

#endif
