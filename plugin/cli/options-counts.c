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
  int         steps;
  size_t      offset;      /* in CliOptions */
  int         least, most, usual;
  const char *value, *help;
} CountOption;

#define MEMBER(name) offsetof (CliOptions, name)

static const CountOption counts[] = {
  { "views", CLI_STEREO, MEMBER (views), 2, 1000, 8, "2-1000",
    "the number of views from the left eye to the right eye (default: 8)" },
  { "columns", CLI_STEREO, MEMBER (columns), 1, 1000, 0, "1-1000",
    "the number of tiles in a row of a quilt (default: as many as rows)" },
  { "frames", CLI_WIGGLE, MEMBER (frames), 2, 10000, 24, "2-10000",
    "the number of pictures in one round of the camera (default: 24)" },
  { "size", CLI_STEREO | CLI_WIGGLE, MEMBER (size), 16, CELD_MAX_SIDE, 640, "16-20000",
    "the longest side of a .gif in pixels; larger ones are scaled down (default: 640)" },
  { "fps", CLI_STEREO | CLI_WIGGLE, MEMBER (fps), 1, 50, 12, "1-50", "pictures per second of a .gif (default: 12)" },
};

static int *
count_of (CliOptions *options, const CountOption *count)
{
  return (int *) (void *) ((char *) options + count->offset);
}

static gboolean
take_count (const char *name, const char *value, gpointer data, GError **error)
{
  const CountOption *count = counts;
  gint64             number;

  while (strcmp (count->name, name + 2))
    count++;
  if (g_ascii_string_to_signed (value, 10, count->least, count->most, &number, NULL))
    {
      *count_of (data, count) = (int) number;
      return TRUE;
    }
  g_set_error (error, G_OPTION_ERROR, G_OPTION_ERROR_BAD_VALUE, "%s cannot be '%s': the value must be %s.", name, value,
               count->value);
  return FALSE;
}

void
cli_counts_append (const CliCommand *command, GArray *entries)
{
  for (size_t i = 0; i < G_N_ELEMENTS (counts); i++)
    if (counts[i].steps & (int) command->step)
      g_array_append_val (entries, ((GOptionEntry) {
        counts[i].name, 0, 0, G_OPTION_ARG_CALLBACK, (gpointer) take_count, counts[i].help, counts[i].value }));
}

void
cli_counts_complete (CliOptions *options)
{
  for (size_t i = 0; i < G_N_ELEMENTS (counts); i++)
    if (!*count_of (options, &counts[i]))
      *count_of (options, &counts[i]) = counts[i].usual;
  for (int i = 1; !options->columns; i++) /* the smallest square */
    if (i * i >= options->views)
      options->columns = i;
}
