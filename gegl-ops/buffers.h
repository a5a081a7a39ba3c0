/* Pictures of core from GeglBuffers, and GEGL's threads for core: what the operations and the plug-ins of GIMP share.
 *
 * A rectangle is in the coordinates of its buffer.  Where it reaches beyond the buffer, pixels are paper: transparent,
 * or white if the buffer has no alpha.  All pictures have the size of the rectangle, and no space between rows.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_BUFFERS_H
#define CELD_BUFFERS_H

#include <gegl.h>

#include "celdepth.h"

gboolean celd_buffer_has_alpha (GeglBuffer *buffer);

/* Fill pictures that the caller provides: linear values (0 beyond the buffer), R'G'B'A of sRGB, linear colours. */
void celd_buffer_read_plane   (GeglBuffer *buffer, const GeglRectangle *rect, CeldPlane *plane);
void celd_buffer_read_paint   (GeglBuffer *buffer, const GeglRectangle *rect, CeldPaint *paint);
void celd_buffer_read_colours (GeglBuffer *buffer, const GeglRectangle *rect, CeldColours *colours);

/* Fills a drawing: of a coloured one its lines (celd_coloured_lines).  The caller provides the luma, and the alpha if
 * the buffer has one.  CELD_NO_MEMORY, CELD_CANCELLED. */
CeldStatus celd_buffer_read_drawing (GeglBuffer *buffer, const GeglRectangle *rect, CeldInkMode ink,
                                     const CeldHost *host, CeldDrawing *drawing);

/* Whether more than a hundredth of the buffer is in colour. */
gboolean celd_buffer_is_coloured (GeglBuffer *buffer);

/* Whether all values are numbers and finite, where alpha is above 0; also if there is no memory to find out, which
 * whoever reads the buffer is told. */
gboolean celd_buffer_has_numbers (GeglBuffer *buffer);

/* Normals as they are stored: 0.5 + 0.5 n, x to the right, y up, or down with `directx`.  `stored` has three numbers a
 * pixel. */
void celd_normals_store (const CeldVectors *normals, gboolean directx, float *stored);

/* CeldHost.each on the threads of GEGL. */
void celd_gegl_each (void *host, int n, void (*body) (void *data, int i), void *data);

#endif
