/* The description of a composition, for the sub-command compose (docs/command-line.md).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CLI_COMPOSITION_H
#define CLI_COMPOSITION_H

#include "cli.h"

/* One drawing.  The options are those of the command, with the files of this drawing. */
typedef struct
{
  char         *name;
  CeldPlacement placement;
  CliOptions    options;
} CliFragment;

typedef struct
{
  const char  *path;           /* borrowed */
  int          width, height;  /* 0: those of the first drawing */
  char        *relations;      /* one on each line */
  CliFragment *fragment;
  guint        n;
} CliComposition;

/* Reads a description; false with a message.  The caller clears it in either case. */
bool cli_composition_read  (const char *path, const CliOptions *options, CliComposition *composition);
void cli_composition_clear (CliComposition *composition);

#endif
