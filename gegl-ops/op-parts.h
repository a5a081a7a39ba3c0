/* What the parts of the base class (op*.c) know of each other.
 *
 *   op.c             the frame round render
 *   op-class.c       the class: regions, and the classes of the operations
 *   op-properties.c  its properties and their values
 *   op-specs.c       what hosts know of a property, by its row of the table of settings
 *   op-pads.c        its pads, and checks of what comes in
 *   op-messages.c    what the artist is told
 *   op-host.c        progress, threads and memory that last as long as a call
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

/* A new specification: name, range, default, label and help for hosts. */
GParamSpec *celd_operation_specify (const CeldProperty *property, const CeldSettingInfo *row);

/* ------------------------------------------------------------------ op-pads.c */

void celd_operation_attach (GeglOperation *operation);

/* Is each pad as it must be, and the input neither endless nor too large?  Otherwise the message says what is not. */
gboolean celd_op_check_pads (CeldOp *op);

/* ------------------------------------------------------------------ op-messages.c */

/* A line more for the message of this call. */
void celd_op_add (CeldOp *op, const char *text);

/* Says the message of this call, unless the last call said the same. */
void celd_op_speak (CeldOp *op);

/* ------------------------------------------------------------------ op-host.c */

/* What the host lends: progress and threads. */
void celd_op_borrow_host (CeldOp *op);

#endif
