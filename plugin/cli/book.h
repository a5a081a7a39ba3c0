/* Many pages of one command, as its parts see them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CLI_BOOK_H
#define CLI_BOOK_H

#include "options.h"

#include <gio/gio.h>

/* A kind of result, such as "depth" and "exr". */
typedef struct { char *option, *ending; } CliResult;

typedef struct CliBook CliBook;

typedef struct
{
  CliBook     *book;
  char        *path, *name;    /* as it was given, and without folder and ending */
  char        *fingerprint;
  GSubprocess *process;        /* while it is made */
} CliPage;

struct CliBook
{
  CliOptions options;
  GArray    *results;          /* CliResult */
  GPtrArray *common;           /* words of the command line that hold for all pages, borrowed */
  char      *folder, *program;
  CliPage   *page;
  size_t     n, next;          /* pages; the next one to be looked at */
  int        jobs, running;
  size_t     made, kept, failed, contradicted;
  bool       stopped;
  CliRun     run;
};

/* Sorts the words into results, those that the parser gets, and of the latter those that hold for all pages.  False
 * with a message. */
bool  cli_book_sort_words   (CliBook *book, const CliCommand *command, int argc, char **argv, GPtrArray *words);
void  cli_book_add_result   (CliBook *book, const char *option, const char *ending);
/* Parses the command line as that of a page called PAGE; the exit code.  Leaves the command and the pages at the front
 * of `words`. */
int   cli_book_parse        (CliBook *book, const CliCommand *command, GPtrArray *words);
/* The file of a result of the page of this name; free with g_free. */
char *cli_book_result_path  (const CliBook *book, const char *page, const CliResult *result);
/* Appends options that name the results of a page; free them with g_free. */
void  cli_book_name_results (const CliBook *book, const char *page, GPtrArray *words);

/* Takes the fingerprint of the program, settings, options, relations and the page; false with a message. */
bool  cli_page_take_fingerprint  (CliPage *page);
/* The file that says from what the page was made; free with g_free. */
char *cli_page_state_path        (const CliPage *page);
/* Whether an earlier run has made the page of the same; *contradicted says whether its relations contradict. */
bool  cli_page_is_made           (const CliPage *page, bool *contradicted);
bool  cli_page_write_state       (const CliPage *page, bool contradicted);
/* Removes what a run that was killed left of a page. */
void  cli_page_remove_unfinished (const CliPage *page);

#endif
