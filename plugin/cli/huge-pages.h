/* Huge pages for the pictures of the command.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELDEPTH_CLI_HUGE_PAGES_H
#define CELDEPTH_CLI_HUGE_PAGES_H

/* Starts the program once more, which takes some milliseconds, with the setting by which glibc (2.35 or later) asks Linux
 * for huge pages: it is read when a program starts, from the environment alone.  Each page costs a fault when it is first
 * used, and pictures have thousands of small ones: a pop-up of several megapixels took about twice as long (measured in a
 * virtual machine).  Where that is not possible, as without /proc, it returns, and the command is slower. */
void cli_use_huge_pages (char **argv);

#endif
