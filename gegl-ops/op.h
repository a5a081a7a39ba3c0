/* What every operation of the suite is made of: a base class, and the steps that read pads and write the output.
 *
 * CeldOperation is a GeglOperation over the whole picture.  An operation of the suite is a CeldOperationInfo: its
 * names, its pads, its properties, and `render`, a chain of steps that each say TRUE or FALSE:
 *
 *     return celd_op_read_plane (op, "input", &levels) &&
 *            celd_op_read_ink (op, "aux", &ink) &&
 *            celd_op_try (op, celd_expand (...)) &&
 *            celd_op_write (op, levels.data);
 *
 * On FALSE the input passes through unchanged, and the artist is told why: one g_message, not repeated while it stays
 * the same (hosts render again and again).  Everything that hangs on a CeldOp is freed when render is done.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_OP_H
#define CELD_OP_H

#include <gegl-plugin.h>

#include "celdepth.h"

#define CELD_TYPE_OPERATION (celd_operation_get_type ())

#define CELD_REFERENCE \
  "D. Sýkora, D. Sedlacek, S. Jinchao, J. Dingliana, S. Collins: Adding Depth to Cartoons Using Sparse Depth " \
  "(In)equalities. Computer Graphics Forum 29(2), Eurographics 2010."

typedef struct _CeldOp CeldOp;

/* ------------------------------------------------------------------ what an operation says of itself */

/* CeldPad.required, beside TRUE (the operation cannot do without) and FALSE.  A sample may be missing, has a size of
 * its own, and lies nowhere. */
enum { CELD_PAD_SAMPLE = 2 };

/* An input pad as the host shows it. */
typedef struct
{
  const char *name;                /* "input", "aux", "aux2", ... */
  const char *label, *description;
  gboolean    required;
} CeldPad;

/* A property: a setting of core by its name, a shared property of properties.c by its name, or one of this operation
 * alone.  What is NULL here is as its row says. */
typedef struct
{
  const char            *name;
  const CeldSettingInfo *own;      /* of this operation alone: a row over CeldOwnValues, in place of a name */
  const char            *as;       /* the name that hosts know it by */
  const char            *label, *help, *when;
} CeldProperty;

/* The values of properties that are no settings of core. */
typedef struct
{
  int         result;              /* what comes out: an enumeration of properties.h */
  int         unit, layer;
  bool        directx;
  const char *relations, *arrow_path;
} CeldOwnValues;

typedef struct
{
  const char         *name;        /* "celdepth:stereo" */
  const char         *title;       /* "Stereo"; GIMP's menu entry has dots behind it */
  const char         *categories, *description, *reference;
  const CeldPad      *pads;        /* "input" first, ended by a NULL name */
  const CeldProperty *properties;  /* in the order of dialogs, ended by one without name and row */
  const char         *format;      /* of the output; NULL: `prepare` sets it */
  void              (*prepare) (GeglOperation *operation);
  void              (*adjust) (GeglOperationClass *klass); /* what differs from the base class; NULL: nothing */
  gboolean          (*render) (CeldOp *op);
} CeldOperationInfo;

/* ------------------------------------------------------------------ the class */

typedef struct
{
  GeglOperation parent_instance;
  CeldSettings  settings;          /* of the properties, and so are these: */
  CeldOwnValues own;
  GValue       *value;             /* of each property, as the host set it */
  GRecMutex     busy;              /* over the members below, and over render */
  gboolean      rendering;
  char         *said;              /* the last message; NULL if all was well */
  CeldSession  *session;           /* of operations that keep the route between calls; made by celd_op_set_session */
} CeldOperation;

typedef struct
{
  GeglOperationClass        parent_class;
  const CeldOperationInfo  *info;
  const CeldSettingInfo   **row;   /* of each property, by its number */
  guint                     n;
} CeldOperationClass;

#define CELD_OPERATION_CLASS_OF(operation) \
  G_TYPE_INSTANCE_GET_CLASS (operation, CELD_TYPE_OPERATION, CeldOperationClass)

GType celd_operation_get_type (void);

/* Makes the base class known to GEGL, and each of these operations. */
void celd_operations_register (GTypeModule *module, const CeldOperationInfo *const *infos, gsize n);

/* What the properties of an operation say now: for `prepare` and its kin.  A render has a copy of its own. */
const CeldSettings  *celd_operation_settings (GeglOperation *operation);
const CeldOwnValues *celd_operation_own (GeglOperation *operation);

/* The bounding box of the pad "input"; empty without one. */
GeglRectangle celd_operation_input (GeglOperation *operation);

/* One call of render. */
struct _CeldOp
{
  CeldOperation        *operation;
  GeglOperationContext *context;
  GeglRectangle         picture;   /* what is read from every pad, and written */
  CeldHost              host;      /* the host's progress and threads: for the longest step */
  CeldHost              quiet;     /* threads only: for the others */
  CeldSettings          settings;
  CeldOwnValues         own;

  CeldPalette           palette;
  CeldRelations         relations;
  CeldProblems          problems;
  CeldOrder             order;

  /* for op*.c and pixels.c alone */
  GPtrArray            *scratch;
  GString              *message;
  double                progress;
  gboolean              choosing;  /* the host's dialog still has a picker without a layer */
};

/* ------------------------------------------------------------------ op-messages.c */

/* Adds to the message of this call; always FALSE. */
gboolean celd_op_fail (CeldOp *op, const char *format, ...) G_GNUC_PRINTF (2, 3);
/* TRUE if a step of core went well; else its reason becomes the message. */
gboolean celd_op_try (CeldOp *op, CeldStatus status);
/* As celd_op_try, for steps that read the relations text, or an arrow path. */
gboolean celd_op_try_text (CeldOp *op, CeldStatus status, const CeldTextError *error);
gboolean celd_op_try_path (CeldOp *op, CeldStatus status, const CeldTextError *error);
/* Tells the artist; the result is delivered all the same, so always TRUE.  `order` has the circles of contradictions;
 * NULL before there is one. */
gboolean celd_op_tell (CeldOp *op, const CeldProblems *problems, const CeldPalette *palette,
                       const CeldRelations *relations, const CeldOrder *order);

/* A remark of one operation's own, likewise. */
gboolean celd_op_remark (CeldOp *op, const char *text);

/* The same for a solve that was less exact than asked for. */
gboolean celd_op_tell_solve (CeldOp *op, const CeldSolve *solve);

/* ------------------------------------------------------------------ op-pads.c, op-host.c */

/* Does something come in on this pad? */
gboolean celd_op_has (CeldOp *op, const char *pad);

/* Memory that lasts as long as the call; NULL: no memory (and said so). */
gpointer celd_op_alloc (CeldOp *op, gsize size);

/* ------------------------------------------------------------------ pixels.c */

gboolean celd_op_read_plane   (CeldOp *op, const char *pad, CeldPlane *plane);      /* linear values */
gboolean celd_op_read_paint   (CeldOp *op, const char *pad, CeldPaint *paint);      /* R'G'B'A, sRGB */
gboolean celd_op_read_drawing (CeldOp *op, const char *pad, CeldDrawing *drawing);
gboolean celd_op_read_colours (CeldOp *op, const char *pad, CeldColours *colours);  /* linear */
gboolean celd_op_read_ink     (CeldOp *op, const char *pad, CeldPlane *ink);
gboolean celd_op_read_sample  (CeldOp *op, const char *pad, CeldColours *colours);  /* linear, its own size */

/* Pictures of the size of the call; not cleared. */
gboolean celd_op_new_plane   (CeldOp *op, CeldPlane *plane);
gboolean celd_op_new_labels  (CeldOp *op, CeldLabels *labels);
gboolean celd_op_new_mask    (CeldOp *op, CeldMask *mask);
gboolean celd_op_new_paint   (CeldOp *op, CeldPaint *paint);
gboolean celd_op_new_vectors (CeldOp *op, CeldVectors *vectors);
gboolean celd_op_new_colours (CeldOp *op, CeldColours *colours);

/* The relations of the properties (text, then arrow path) and of a painted layer (a pad that may be missing), to
 * op->relations; unclear arrows to op->problems. */
gboolean celd_op_read_relations (CeldOp *op, const char *pad);

/* Seed labels and op->palette from painted strokes. */
gboolean celd_op_read_scribbles (CeldOp *op, const char *pad, CeldLabels *seeds);

/* The output, in the format that prepare set for it. */
gboolean celd_op_write         (CeldOp *op, const void *pixels);
gboolean celd_op_write_drawing (CeldOp *op, const CeldDrawing *drawing);
gboolean celd_op_write_paint   (CeldOp *op, const CeldLabels *labels, const CeldPalette *palette);
gboolean celd_op_write_normals (CeldOp *op, const CeldVectors *normals); /* 0.5 + 0.5 n, up as `directx` says */

/* ------------------------------------------------------------------ session.c */

/* Settings, drawing (input), scribbles (aux), arrows (aux2), relations and arrow path, to the session of this
 * operation, which from now on it has. */
gboolean celd_op_set_session (CeldOp *op);

/* A further layer, from a pad that may be missing. */
gboolean celd_op_set_layer (CeldOp *op, const char *pad, CeldStatus (*set) (CeldSession *session,
                                                                          const CeldPaint *layer));
/* What the session knows to tell. */
gboolean celd_op_tell_session (CeldOp *op, const CeldOrder *order);

gboolean celd_op_write_labels   (CeldOp *op);                    /* the session's labels as colours */
gboolean celd_op_write_problems (CeldOp *op);                    /* marks over the input, of the stages made so far */

#endif
