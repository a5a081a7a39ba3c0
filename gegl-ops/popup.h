/* What celdepth:popup and celdepth:live-popup share: they differ in the names of their pads.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_POPUP_H
#define CELD_POPUP_H

#include "op.h"

/* The pads by their roles; corrections NULL: there is no such pad. */
typedef struct { const char *drawing, *scribbles, *arrows, *contours, *hidden, *corrections; } CeldPopupPads;

extern const CeldProperty celd_popup_properties[];

/* Sets the format of the chosen result. */
void celd_popup_prepare (GeglOperation *operation);

/* Makes the chosen result of these pads. */
gboolean celd_popup_render (CeldOp *op, const CeldPopupPads *pads);

/* Descriptions of pads. */
#define CELD_HELP_SCRIBBLES "One stroke over each part, in a colour of its own"
#define CELD_HELP_ARROWS "Arrows that point from nearer to farther parts"
#define CELD_HELP_CONTOURS \
  "Red: a boundary of regions and depth; blue: a boundary of regions across which depth stays smooth; green: ink " \
  "that is not a boundary"
#define CELD_HELP_HIDDEN \
  "What is hidden: strokes in a region's colour where it goes on behind nearer ones, black where it does not"

#endif
