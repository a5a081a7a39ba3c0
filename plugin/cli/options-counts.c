/* Options with whole numbers: the number of pictures, their size, their rate.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "options.h"

#include <stddef.h>
#include <string.h>

typedef struct
{
  const char *name;
  char        letter;      /* 0: none */
  int         steps;
  size_t      offset;      /* in CliOptions */
  int         least, most, usual;
  const char *section, *value, *help;
} CountOption;

#define MEMBER(name) offsetof (CliOptions, name)

static const CountOption counts[] = {
  { "views", 0, CLI_POPUP | CLI_STEREO, MEMBER (views), 2, 1000, 8, "Output", "2-1000",
    "the number of views from the left eye to the right eye, for --quilt and --sequence (default: 8)" },
  { "columns", 0, CLI_POPUP | CLI_STEREO, MEMBER (columns), 1, 1000, 0, "Output", "1-1000",
    "the number of tiles in a row of a quilt (default: as many as rows)" },
  { "frames", 0, CLI_POPUP | CLI_WIGGLE, MEMBER (frames), 2, 10000, 24, "Output", "2-10000",
    "the number of pictures in one round of the camera (default: 24)" },
  { "frames", 0, CLI_DEFORM, MEMBER (frames), 2, 10000, 24, "Output", "2-10000",
    "the number of pictures of a motion (default: 24)" },
  { "frames", 'n', CLI_INBETWEEN, MEMBER (frames), 1, 10000, 1, "Output", "1-10000",
    "the number of pictures between the two drawings (default: 1)" },
  { "size", 0, CLI_POPUP | CLI_STEREO | CLI_WIGGLE | CLI_DEFORM | CLI_INBETWEEN, MEMBER (size), 16, CELD_MAX_SIDE, 640,
    "Output", "16-20000",
    "the longest side of a .gif in pixels; larger ones are scaled down (default: 640)" },
  { "fps", 0, CLI_POPUP | CLI_STEREO | CLI_WIGGLE | CLI_DEFORM | CLI_INBETWEEN, MEMBER (fps), 1, 50, 12, "Output", "1-50",
    "pictures per second of a .gif (default: 12)" },
  { "jobs", 0, CLI_PROPAGATE, MEMBER (jobs), 1, 1024, 0, "Other", "1-1024",
    "the number of chains of frames to make at the same time (default: the number of processors)" },
  { "jobs", 0, CLI_POPUP, MEMBER (jobs), 1, 1024, 0, "Other", "1-1024",
    "with --output-dir, the number of pages to make at the same time (default: the number of processors)" },
  { "part", 0, CLI_PROPAGATE, MEMBER (part), 1, CELD_MAX_SIDE, 0, "Other", "1-20000",
    "make one chain only: those of the first key come first; run the command without --part when all are made" },
};

static bool
counts_for (const CountOption *count, const CliOptions *options)
{
  return (count->steps & (int) options->step) != 0;
}

static int *
count_of (CliOptions *options, const CountOption *count)
{
  return (int *) (void *) ((char *) options + count->offset);
}

/* Whether a word such as "--frames" or "-n" is an option of this command. */
static bool
is_named (const CountOption *count, const CliOptions *options, const char *word)
{
  return counts_for (count, options) && (word[1] == '-' ? !strcmp (count->name, word + 2) : count->letter == word[1]);
}

static gboolean
take_count (const char *name, const char *value, gpointer data, GError **error)
{
  const CountOption *count = counts;
  gint64             number;

  while (!is_named (count, data, name))
    count++;
  if (g_ascii_string_to_signed (value, 10, count->least, count->most, &number, NULL))
    {
      *count_of (data, count) = (int) number;
      return TRUE;
    }
  g_set_error (error, G_OPTION_ERROR, G_OPTION_ERROR_BAD_VALUE, "%s must be a whole number between %d and %d, "
               "not '%s'.", name, count->least, count->most, value);
  return FALSE;
}

void
cli_counts_append (const CliCommand *command, CliOptionList *list)
{
  for (size_t i = 0; i < G_N_ELEMENTS (counts); i++)
    if (counts[i].steps & (int) command->step)
      cli_list_add (list, counts[i].section, (GOptionEntry) {
        counts[i].name, counts[i].letter, 0, G_OPTION_ARG_CALLBACK, (gpointer) take_count, counts[i].help,
        counts[i].value });
}

void
cli_counts_complete (CliOptions *options)
{
  for (size_t i = 0; i < G_N_ELEMENTS (counts); i++)
    if (counts_for (&counts[i], options) && !*count_of (options, &counts[i]))
      *count_of (options, &counts[i]) = counts[i].usual;
  for (int i = 1; !options->columns; i++) /* the smallest square */
    if (i * i >= options->views)
      options->columns = i;
}
