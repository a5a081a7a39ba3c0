/* What a run writes: kinds of files, and whether one would replace a file that is read, or another result.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CLI_OUTPUTS_H
#define CLI_OUTPUTS_H

#include "options.h"

/* HOW is a text about the output; kinds from OUTPUT on are written.  MAPS stands for the names of several pictures,
 * JOINED is a picture or an MPO file,
 * COMPOSED a picture or layers, MOVING a picture or frames, DEFORMED any of these. */
typedef enum
{
  INPUT, TEXT, HOW, MAPS, OUTPUT, JOINED, REPORT, STACK, FRAMES, MESH, COMPOSED, MOVING, DEFORMED
} CliFileKind;

typedef struct { const char *option; CliFileKind kind; const char *path; } CliFile;

/* options-files.c: appends the files that are given, CliFile; their names stay those of the options. */
void cli_files_given (const CliOptions *options, GArray *given);

/* endings.c: whether the name of an output has an ending that it can have; if not, prints which ones it can. */
bool cli_ending_check (const CliOptions *options, const CliFile *file);

/* A text that is the same for all names of a file, also those by links; free with g_free. */
char *cli_file_identity (const char *path);

/* Files that a run reads and writes, by what they are on the disk: links and other ways to write a name do not matter. */
typedef struct { GHashTable *read, *written; } CliTouched;

void cli_touched_begin  (CliTouched *touched);
void cli_touched_end    (CliTouched *touched);
/* Notes a file that is read; `option` is NULL if it is no option's. */
void cli_touched_reads  (CliTouched *touched, const char *option, const char *path);
/* Notes a file that will be written; false with a message if it is read, or written by another option. */
bool cli_touched_writes (CliTouched *touched, const char *option, const char *path);
/* The same for all files of the options; the latter also those that are written beside others, and numbered ones. */
void cli_touched_reads_all  (CliTouched *touched, const CliOptions *options);
bool cli_touched_writes_all (CliTouched *touched, const CliOptions *options);

#endif
