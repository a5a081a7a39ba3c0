/* The base class of all operations, and functions that read their pads and write their output.
 *
 * CeldOperation is a GeglOperation that needs the whole picture.  Each operation is a CeldOperationInfo: its names, its
 * pads, its properties, and `render`, a chain of functions that return TRUE or FALSE:
 *
 *     return celd_op_read_plane (op, "input", &levels) &&
 *            celd_op_read_ink (op, "aux", &ink) &&
 *            celd_op_try (op, celd_expand (...)) &&
 *            celd_op_write (op, levels.data);
 *
 * On FALSE the input becomes the output, and one g_message tells the artist why; it is not repeated while it stays the
 * same, since hosts render again and again.  All that belongs to a CeldOp is freed after render.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_OP_H
#define CELD_OP_H

#include <gegl-plugin.h>

#include "celdepth.h"
#include "translate.h"

#define CELD_TYPE_OPERATION (celd_operation_get_type ())

#define CELD_REFERENCE \
  "D. Sýkora, D. Sedlacek, S. Jinchao, J. Dingliana, S. Collins: Adding Depth to Cartoons Using Sparse Depth " \
  "(In)equalities. Computer Graphics Forum 29(2), Eurographics 2010."

typedef struct _CeldOp CeldOp;

/* ------------------------------------------------------------------ the description of an operation */

/* A value of CeldPad.required beside TRUE (nothing can be done without it) and FALSE: an optional picture of any size,
 * at any place. */
enum { CELD_PAD_SAMPLE = 2 };

/* An input pad, as hosts show it. */
typedef struct
{
  const char *name;                /* "input", "aux", "aux2", ... */
  const char *label, *description;
  gboolean    required;
} CeldPad;

/* A property: the name of a setting of core or of a property in properties.c, or a row for this operation alone.
 * Members that are NULL are those of the row.  What is made comes first, then how, and rare properties last, after
 * "more". */
typedef struct
{
  const char            *name;
  const CeldSettingInfo *own;      /* instead of a name: a row of this operation, over CeldOwnValues */
  const char            *label, *help, *when;
  gboolean               rare;     /* shown only when the property "more" is on */
} CeldProperty;

/* The values of properties that are no settings of core. */
typedef struct
{
  int         result;              /* the kind of output: an enumeration of properties.h */
  int         unit, layer;
  bool        directx, flip;
  bool        more;                /* shows rare properties, and changes nothing */
  float       x, y, scale, turn, between; /* of celdepth:compose */
  const char *relations, *arrow_path;
  const char *handles;             /* of celdepth:arap-deform */
} CeldOwnValues;

typedef struct
{
  const char         *name;        /* "celdepth:stereo" */
  const char         *title;       /* "Stereo"; followed by "..." in GIMP's menu */
  const char         *categories, *description, *reference;
  const CeldPad      *pads;        /* "input" first, ended by a NULL name */
  const CeldProperty *properties;  /* in the order of dialogs; the last one has neither name nor row */
  gboolean            unlisted;    /* not in GIMP's menu of filters */
  const char         *size_help;   /* what to do when a layer has another size than the picture; NULL: as in a dialog */
  const char         *format;      /* of the output; NULL: `prepare` sets it */
  void              (*prepare) (GeglOperation *operation);
  void              (*adjust) (GeglOperationClass *klass); /* changes functions of the base class; may be NULL */
  gboolean          (*render) (CeldOp *op);
} CeldOperationInfo;

/* ------------------------------------------------------------------ the class */

/* A result that an operation keeps between calls, and the fingerprint of what it was made of. */
typedef struct { gpointer result; GDestroyNotify destroy; guint64 input; } CeldKept;

/* The fingerprint of the last drawing that was not refused, 0 if there is none, and whether it may be a photograph. */
typedef struct { guint64 input; gboolean unsure; } CeldGoodDrawing;

#define CELD_MAX_PADS 8 /* that an operation has */

typedef struct
{
  GeglOperation parent_instance;
  CeldSettings  settings;          /* the properties that are settings of core */
  CeldOwnValues own;               /* the other properties */
  GValue       *value;             /* of each property, as the host set it */
  GRecMutex     busy;              /* protects the members below, and render */
  gboolean      rendering;
  char         *last_message;              /* of the last call; NULL if it had none */
  CeldSession  *session;           /* of operations that keep results between calls; made by celd_op_set_session */
  CeldKept      kept;
  CeldGoodDrawing good[2];         /* of pad "input", and of another pad */
  guint64       good_strokes[CELD_MAX_PADS]; /* the fingerprint of the last strokes of each that were not refused */
} CeldOperation;

typedef struct
{
  GeglOperationClass        parent_class;
  const CeldOperationInfo  *info;
  const CeldSettingInfo   **row;   /* of each property */
  guint                     n;
} CeldOperationClass;

#define CELD_OPERATION_CLASS_OF(operation) \
  G_TYPE_INSTANCE_GET_CLASS (operation, CELD_TYPE_OPERATION, CeldOperationClass)

GType celd_operation_get_type (void);

/* The operations of module.c, ended by NULL. */
extern const CeldOperationInfo *const celd_operations[];

/* Registers the base class and n operations with GEGL. */
void celd_operations_register (GTypeModule *module, const CeldOperationInfo *const *infos, gsize n);

/* The current values of the properties, for `prepare` and other functions of the class; render has a copy of its
 * own. */
const CeldSettings  *celd_operation_settings (GeglOperation *operation);
const CeldOwnValues *celd_operation_own (GeglOperation *operation);

/* The bounding box of the pad "input"; empty without one. */
GeglRectangle celd_operation_input (GeglOperation *operation);

/* One call of render. */
struct _CeldOp
{
  CeldOperation        *operation;
  GeglOperationContext *context;
  GeglRectangle         picture;   /* the rectangle that is read from every pad, and written */
  CeldHost              host;      /* progress and threads, for the longest step */
  CeldHost              quiet;     /* threads only, for the other steps */
  CeldSettings          settings;
  CeldOwnValues         own;

  CeldPalette           palette;
  CeldRelations         relations;
  CeldProblems          problems;
  CeldOrder             order;
  gboolean              choosing;  /* nothing is said of missing scribbles and arrows: they are still to come */

  /* used by op*.c and pixels.c only */
  GPtrArray            *scratch;
  GString              *message;
  double                progress;
};

/* ------------------------------------------------------------------ op-messages.c */

/* Adds a line to the message of this call; always FALSE. */
gboolean celd_op_fail (CeldOp *op, const char *format, ...) G_GNUC_PRINTF (2, 3);
/* TRUE if the status of a step is CELD_OK; else its text is added to the message. */
gboolean celd_op_try (CeldOp *op, CeldStatus status);
/* As celd_op_try, for steps that read the relations text, an arrow path, or handles. */
gboolean celd_op_try_text (CeldOp *op, CeldStatus status, const CeldTextError *error);
gboolean celd_op_try_path (CeldOp *op, CeldStatus status, const CeldTextError *error);
gboolean celd_op_try_handles (CeldOp *op, CeldStatus status, const CeldTextError *error);
/* Add problems to the message; always TRUE, since there is a result all the same.  `order` has the cycles of
 * contradictions; NULL before there is an order. */
gboolean celd_op_report (CeldOp *op, const CeldProblems *problems, const CeldPalette *palette,
                       const CeldRelations *relations, const CeldOrder *order);

gboolean celd_op_report_text (CeldOp *op, const char *text);

gboolean celd_op_report_solve (CeldOp *op, const CeldSolve *solve);

/* ------------------------------------------------------------------ op-pads.c, op-host.c */

/* Whether the pad has a picture. */
gboolean celd_op_has_input (CeldOp *op, const char *pad);

/* Memory that is freed after the call; NULL, with a message, if there is none. */
gpointer celd_op_alloc (CeldOp *op, gsize size);

/* ------------------------------------------------------------------ pixels.c */

gboolean celd_op_read_plane   (CeldOp *op, const char *pad, CeldPlane *plane);      /* linear values */
gboolean celd_op_read_paint   (CeldOp *op, const char *pad, CeldPaint *paint);      /* R'G'B'A, sRGB */
gboolean celd_op_read_drawing (CeldOp *op, const char *pad, CeldDrawing *drawing);
gboolean celd_op_read_painted (CeldOp *op, const char *pad, CeldPaint *paint);      /* a drawing's colours, as paint */
gboolean celd_op_read_colours (CeldOp *op, const char *pad, CeldColours *colours);  /* linear */
gboolean celd_op_read_ink     (CeldOp *op, const char *pad, CeldPlane *ink);        /* of a drawing, no photograph */
gboolean celd_op_read_sample  (CeldOp *op, const char *pad, CeldColours *colours);  /* linear, its own size */
/* Of art, which may be a painting. */
gboolean celd_op_read_ink_of_art (CeldOp *op, const char *pad, CeldPlane *ink);

/* Pictures of the size of op->picture, not cleared; freed after the call. */
gboolean celd_op_new_plane   (CeldOp *op, CeldPlane *plane);
gboolean celd_op_new_labels  (CeldOp *op, CeldLabels *labels);
gboolean celd_op_new_mask    (CeldOp *op, CeldMask *mask);
gboolean celd_op_new_paint   (CeldOp *op, CeldPaint *paint);
gboolean celd_op_new_vectors (CeldOp *op, CeldVectors *vectors);
gboolean celd_op_new_colours (CeldOp *op, CeldColours *colours);

/* Reads the relations of the properties (text, then arrow path) and of painted arrows (an optional pad) to
 * op->relations; unclear arrows become op->problems. */
gboolean celd_op_read_relations (CeldOp *op, const char *pad);

/* Reads painted scribbles to seed labels and op->palette. */
gboolean celd_op_read_scribbles (CeldOp *op, const char *pad, CeldLabels *seeds);

/* Write the output, with pixels in the format that prepare has set. */
gboolean celd_op_write         (CeldOp *op, const void *pixels);
gboolean celd_op_write_drawing (CeldOp *op, const CeldDrawing *drawing);
gboolean celd_op_write_paint   (CeldOp *op, const CeldLabels *labels, const CeldPalette *palette);
gboolean celd_op_write_normals (CeldOp *op, const CeldVectors *normals); /* 0.5 + 0.5 n, up as `directx` says */

/* ------------------------------------------------------------------ session.c */

/* Sets the settings, the drawing and the layers of these pads, relations and arrow path in the operation's session,
 * which it makes at the first call. */
gboolean celd_op_set_session (CeldOp *op, const char *drawing_pad, const char *scribbles_pad, const char *arrows_pad);

/* Sets one more layer, from an optional pad. */
gboolean celd_op_set_layer (CeldOp *op, const char *pad, CeldStatus (*set) (CeldSession *session,
                                                                          const CeldPaint *layer));
/* Adds the problems of the session to the message. */
gboolean celd_op_report_session (CeldOp *op, const CeldOrder *order);

/* Write the session's labels as colours; and the input with marks for the problems of all valid stages. */
gboolean celd_op_write_labels   (CeldOp *op);
gboolean celd_op_write_problems (CeldOp *op, const char *drawing_pad);

/* ------------------------------------------------------------------ kept.c */

/* A fingerprint of what a result is made of: of the settings and the rectangle of the picture, with more input
 * added. */
guint64 celd_op_settings_input (CeldOp *op);
guint64 celd_op_add_input      (guint64 fingerprint, const void *data, gsize size); /* data NULL: there is none */
guint64 celd_op_add_text       (guint64 fingerprint, const char *text);             /* may be NULL */

/* The result that was kept, if it was made of the same input; else that is freed, and NULL. */
gpointer celd_op_kept (CeldOp *op, guint64 input);
/* Keeps a result where there is none; `destroy` frees it. */
void     celd_op_keep (CeldOp *op, guint64 input, gpointer result, GDestroyNotify destroy);

#endif
