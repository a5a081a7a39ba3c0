/* Fingerprints of what a result is made from.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CLI_FINGERPRINT_H
#define CLI_FINGERPRINT_H

#include "cli.h"

/* Begins one with the version of the program and the settings. */
GChecksum *cli_fingerprint_new      (const CeldSettings *settings);
/* Adds the bytes of a file (NULL: none); false with a message. */
bool       cli_fingerprint_add_file (GChecksum *sum, const char *path);
/* Frees the sum; its text, or NULL if what was added was not `good`. */
char      *cli_fingerprint_end      (GChecksum *sum, bool good);

#endif
