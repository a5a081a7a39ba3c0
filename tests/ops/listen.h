/* Catches messages to the artist.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef LISTEN_H
#define LISTEN_H

#include <glib.h>
#include <stdio.h>
#include <string.h>

static GString *said;
static int      times_said, warnings;

/* Counts g_message without a domain as a message to the artist; any other log is a failure. */
static inline void
listen (const gchar *domain, GLogLevelFlags level, const gchar *message, gpointer data)
{
  if (!domain && (level & G_LOG_LEVEL_MESSAGE))
    {
      g_string_append (said, message);
      times_said++;
    }
  else
    {
      fprintf (stderr, "%s: %s\n", domain ? domain : "", message);
      warnings++;
    }
}

static inline void
start_to_listen (void)
{
  said = g_string_new (NULL);
  g_log_set_default_handler (listen, NULL);
}

static inline void
stop_to_listen (void)
{
  g_log_set_default_handler (g_log_default_handler, NULL);
  g_string_free (said, TRUE);
}

static inline void
be_quiet (void)
{
  g_string_truncate (said, 0);
  times_said = 0;
  warnings   = 0;
}

#define SAYS(words) (strstr (said->str, words) != NULL)

#endif
