/* Shared by the two operations that use OpenImageIO.  OpenImageIO is loaded when one of them first reads or
 * writes a file.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_OIIO_H
#define CELD_OIIO_H

#include <gegl-plugin.h>

#include "on-demand.h"

typedef enum { CELD_LOAD_COLOURS, CELD_LOAD_DEPTH } CeldLoadContent;
typedef enum { CELD_SAVE_COLOURS, CELD_SAVE_DEPTH, CELD_SAVE_NORMALS, CELD_SAVE_LIGHT } CeldSaveContent;

GType celd_load_content_get_type (void);
GType celd_save_content_get_type (void);

#endif
