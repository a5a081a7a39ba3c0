/* Functions that the files of the base class (op*.c) share.
 *
 *   op.c             a call of an operation: checks, render, message
 *   op-class.c       the class: regions, and the classes of the operations
 *   op-properties.c  properties and their values
 *   op-specs.c       GParamSpecs of properties, made from rows of the table of settings
 *   op-pads.c        pads, and checks of the pictures on them
 *   checks.c         checks of what the pictures show
 *   op-messages.c    messages to the artist
 *   op-host.c        progress, threads, and memory for the time of a call
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_OP_PARTS_H
#define CELD_OP_PARTS_H

#include "op.h"

/* ------------------------------------------------------------------ op.c */

/* GeglOperationClass.process */
gboolean celd_operation_process (GeglOperation *operation, GeglOperationContext *context, const gchar *output_pad,
                                 const GeglRectangle *roi, gint level);

/* ------------------------------------------------------------------ op-properties.c */

/* Installs the properties of klass->info. */
void celd_operation_install (CeldOperationClass *klass);
void celd_operation_set_property (GObject *object, guint id, const GValue *value, GParamSpec *pspec);
void celd_operation_get_property (GObject *object, guint id, GValue *value, GParamSpec *pspec);
void celd_operation_clear_values (CeldOperation *self);

/* ------------------------------------------------------------------ op-specs.c */

/* A new GParamSpec: name, range, default, label and help for hosts. */
GParamSpec *celd_operation_specify (const CeldProperty *property, const CeldSettingInfo *row);

/* ------------------------------------------------------------------ op-pads.c */

void celd_operation_attach (GeglOperation *operation);

/* Whether the input has a finite size up to CELD_MAX_SIDE, and each pad a picture that can be used; if not, with a
 * message. */
gboolean celd_op_check_pads (CeldOp *op);

/* The place of a pad of this name, which there has to be, among those of the operation. */
guint       celd_op_pad_index (CeldOp *op, const char *name);
/* The label of a pad, as hosts show it. */
const char *celd_op_pad_label (CeldOp *op, const char *name);

/* ------------------------------------------------------------------ checks.c, for pixels.c and session.c */

/* Refuses a photograph, a painting without lines, and a blank page: the drawing of this pad, which the session has. */
gboolean celd_op_check_drawing   (CeldOp *op, const char *pad, const CeldDrawing *drawing);
/* Refuses a photograph or a painting without lines, for single steps: these have an answer for a blank page, too. */
gboolean celd_op_check_lines     (CeldOp *op, const char *pad, const CeldDrawing *drawing);
/* Refuses a photograph, and scribbles that were exchanged with the drawing of that pad, or are a copy of it. */
gboolean celd_op_check_scribbles (CeldOp *op, const char *drawing_pad, const CeldPaint *scribbles);
/* Refuses strokes that have the lines of the drawing, which the session has; scribbles only without colours. */
gboolean celd_op_check_strokes   (CeldOp *op, const char *pad, const CeldPaint *strokes, gboolean scribbles);
/* Refuses colours where there has to be depth or levels. */
gboolean celd_op_check_grey      (CeldOp *op, const char *pad);
/* Refuses values that are infinite or no number where they are seen. */
gboolean celd_op_check_numbers   (CeldOp *op, const char *pad);

/* ------------------------------------------------------------------ pixels.c */

/* What is connected to a pad; borrowed. */
GeglBuffer *celd_op_buffer (CeldOp *op, const char *pad);

/* ------------------------------------------------------------------ op-messages.c */

/* Adds a line to the message of this call. */
void celd_op_add_line (CeldOp *op, const char *text);

/* Shows the message of this call, unless it is that of the last call. */
void celd_op_show_message (CeldOp *op);

/* ------------------------------------------------------------------ op-host.c */

/* Sets op->host and op->quiet. */
void celd_op_set_host (CeldOp *op);

#endif
