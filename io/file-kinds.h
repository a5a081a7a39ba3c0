/* The formats of pictures, for the files of this folder.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELDEPTH_FILE_KINDS_H
#define CELDEPTH_FILE_KINDS_H

#include "celdepth-io.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum { CELD_IO_NO_FORMAT, CELD_IO_EXR, CELD_IO_PNG, CELD_IO_TIFF } CeldIoFormat;

/* By the ending of the name, in any case. */
CeldIoFormat celd_io_format (const char *path);

#ifdef __cplusplus
}
#endif

#endif
