/* The frames of a clip, and the folder of results that propagate writes for them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CLI_SEQUENCE_H
#define CLI_SEQUENCE_H

#include "cli.h"

/* ------------------------------------------------------------------ sequence.c */

typedef struct { char *path; int number, blank; } CliFrame; /* blank: it was read, and has no lines */

/* By rising numbers, all different. */
typedef struct { CliFrame *frame; size_t n; } CliSequence;

/* The frames that names stand for: files; folders, with all numbered pictures in them; and patterns with a # for each
 * digit.  False with a message.  The caller clears the sequence in either case. */
bool   cli_sequence_find  (char *const *names, size_t n, CliSequence *sequence);
void   cli_sequence_clear (CliSequence *sequence);
/* The index of a frame's number; SIZE_MAX if there is none. */
size_t cli_sequence_index (const CliSequence *sequence, int number);

/* ------------------------------------------------------------------ clip.c */

#define CLI_CLIP_FILE "clip.json" /* in the folder of a clip */

/* The files of one frame; depth may be NULL. */
typedef struct { int number; char *drawing, *labels, *levels, *depth; } CliClipFrame;

typedef struct
{
  CliClipFrame *frame;      /* by rising numbers */
  size_t        n;
  char         *relations;  /* a text file of relations that hold in all frames; NULL: none */
} CliClip;

/* Writes clip.json; names in or below the folder become relative to it. */
bool cli_clip_write (const char *folder, const CliClip *clip);
void cli_clip_clear (CliClip *clip);

/* Runs a sub-command for each frame of options->clip; the exit code. */
int  cli_clip_run   (const CliCommand *command, const CliOptions *options);

#endif
