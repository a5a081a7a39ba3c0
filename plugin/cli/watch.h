/* Results that are made again whenever an input is saved.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CLI_WATCH_H
#define CLI_WATCH_H

#include "cli.h"

/* Calls `run`, which returns an exit code, now and whenever an input that the options name is saved, until SIGINT,
 * SIGTERM or SIGHUP arrives.  The exit code. */
int cli_watch (const CliOptions *options, int (*run) (void *data), void *data);

#endif
