/* Functions that the files of the options share.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CLI_OPTIONS_H
#define CLI_OPTIONS_H

#include "cli.h"

#define GIVES_LABELS   (CLI_POPUP | CLI_SEGMENT)
#define FROM_THE_SIDE  (CLI_STEREO | CLI_WIGGLE)
#define MADE_OF_LABELS (GIVES_LABELS | CLI_LAYERS | FROM_THE_SIDE | CLI_DEFORM)
#define WITH_LAYERS    (MADE_OF_LABELS | CLI_EXACT | CLI_RELIEF)
#define OF_LEVELS      (CLI_EXPAND | CLI_SMOOTH | CLI_SHADE)
#define WITH_PARTS     (WITH_LAYERS | CLI_REGISTER)
#define COLOURED       (MADE_OF_LABELS - CLI_SEGMENT + (CLI_ENHANCE | CLI_SHADE | CLI_RELIEF | CLI_REGISTER | CLI_INBETWEEN))
#define WITH_INK       (WITH_PARTS | CLI_ORDER | OF_LEVELS)

/* ------------------------------------------------------------------ help.c */

/* The options of a command: GOptionEntry, and the heading that each has in --help. */
typedef struct { GArray *entries; GPtrArray *sections; } CliOptionList;

void cli_list_add   (CliOptionList *list, const char *section, GOptionEntry entry);
void cli_help_print (const CliCommand *command, const CliOptionList *list);

/* ------------------------------------------------------------------ options-files.c */

/* Adds each file of a command. */
void cli_files_append (const CliCommand *command, CliOptions *options, CliOptionList *list);
/* Whether required files are given, and outputs have names with endings that can be written, and are no inputs. */
bool cli_files_check (const CliCommand *command, CliOptions *options);
void cli_files_clear (CliOptions *options);
/* Copies all names for one frame of a clip: those of outputs with its number, and those of inputs if they have a #. */
void cli_files_number (const CliOptions *all, int number, CliOptions *frame);

/* The settings of sub-commands that make regions, and in addition of those that make views. */
#define CLI_SETTINGS_OF_LABELS \
  "ink ink-threshold method close-gaps keep-necks hardness flats background background-colour seeds same-colour " \
  "arrow-style"
#define CLI_SETTINGS_OF_SCENES " on-cycle suggest expansion margin anchors hold-rest hold-gaps"

/* Has files in place of all names "-". */
bool cli_files_stream (const CliCommand *command, CliOptions *options);

/* ------------------------------------------------------------------ outputs.c */

/* Whether no output would replace an input or another output; if not, prints which one. */
bool cli_outputs_check        (const CliOptions *options);
/* Whether the outputs can be written there, which is checked before the work begins. */
bool cli_outputs_check_places (const CliOptions *options);
/* Makes a folder that gets files of their own names, when there are some; NULL: none.  *made is how many were missing,
 * those above it with it.  False with a message. */
bool cli_outputs_make_folder  (const char *path, int *made);
/* Removes so many folders again, as far as they are empty. */
void cli_outputs_unmake_folder (const char *path, int made);

/* ------------------------------------------------------------------ streams.c */

/* Reads standard input into a file, whose name replaces *name.  `what` is the option that wants it, for messages. */
bool cli_stream_input  (CliStreams *streams, const char *what, char **name);
/* Replaces *name by that of a file that is to be copied to standard output; ending NULL: none. */
bool cli_stream_output (CliStreams *streams, const char *what, const char *ending, bool text, char **name);

/* ------------------------------------------------------------------ options-settings.c */

/* Adds each setting of a command; the data of its entry are the CliOptions. */
void cli_settings_append (const CliCommand *command, CliOptions *options, CliOptionList *list);
/* After parsing: sets what the chosen preset says of settings that were not given. */
void cli_settings_complete (CliOptions *options);
/* Whether a setting was given by the command line. */
bool cli_setting_given (const CliOptions *options, const char *name);
void cli_settings_clear (CliOptions *options);
/* Reads yes, no, true or false; false: it is none of these, and *on stays as it is. */
bool cli_switch_read (const char *text, bool *on);

/* ------------------------------------------------------------------ effects.c */

/* Whether no option is in vain; if not, prints what is missing.  To be called before those that were not given get their
 * values; and for settings, after it. */
bool cli_effects_check         (const CliOptions *options);
bool cli_setting_effects_check (const CliOptions *options);

/* ------------------------------------------------------------------ options-clip.c */

/* Adds the options of propagate that may be repeated. */
void cli_clip_options_append (CliOptions *options, CliOptionList *list);
/* Keeps the command line for scripts, before it is parsed. */
void cli_command_line_keep   (int argc, char **argv, CliOptions *options);
void cli_clip_options_clear  (CliOptions *options);

/* ------------------------------------------------------------------ options-counts.c */

/* Adds each whole number of a command; the data of its entry are the CliOptions. */
void cli_counts_append   (const CliCommand *command, CliOptionList *list);
/* Sets those that were not given. */
void cli_counts_complete (CliOptions *options);

#endif
