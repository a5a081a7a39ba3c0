/* Many pages in one command.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CLI_PAGES_H
#define CLI_PAGES_H

#include "cli.h"

/* Whether the words of a command ask for the results of many pages: --output-dir. */
bool cli_pages_asked (const CliCommand *command, int argc, char **argv);
/* Makes them; the exit code. */
int  cli_pages_run   (const CliCommand *command, int argc, char **argv);

#endif
