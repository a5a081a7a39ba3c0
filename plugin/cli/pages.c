/* celdepth popup PAGES... --output-dir FOLDER: the same results of many pages.
 *
 * Results are named after their pages: FOLDER/PAGE-depth.exr.  Each page is made by a process of its own, several at a
 * time, so that one that crashes or needs too much memory does not end the others.  When a page is complete, a small
 * JSON file with a fingerprint of all that it was made from is written; as long as that is right, and all results are
 * there, the page is not made again.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "book.h"
#include "outputs.h"
#include "pages.h"

#include <string.h>

#define LOOK_AFTER 100 /* milliseconds between looks whether the run was cancelled (chosen) */

/* ------------------------------------------------------------------ pages */

static char *
page_name (const char *path)
{
  char *name = g_path_get_basename (path), *dot = strrchr (name, '.');

  if (dot && dot != name)
    *dot = 0;
  return name;
}

/* Whether a file that belongs to a page would replace one that is read; the caller gives up the name. */
static bool
check_result (const GHashTable *read, const CliPage *page, char *path)
{
  char *identity = cli_file_identity (path);
  bool  good = !g_hash_table_contains ((GHashTable *) read, identity) ||
               cli_error ("\"%s\" would be overwritten by a result of \"%s\": give another --output-dir.", path,
                          page->path);

  g_free (identity);
  g_free (path);
  return good;
}

/* Whether results are those of one page each, and neither a page nor the relations. */
static bool
check_names (const CliBook *book)
{
  GHashTable *read = g_hash_table_new_full (g_str_hash, g_str_equal, g_free, NULL);
  GHashTable *names = g_hash_table_new (g_str_hash, g_str_equal);
  bool        good = true;

  for (size_t i = 0; i < book->n; i++)
    g_hash_table_add (read, cli_file_identity (book->page[i].path));
  if (book->options.relations_file)
    g_hash_table_add (read, cli_file_identity (book->options.relations_file));
  for (size_t i = 0; i < book->n && good; i++)
    {
      const CliPage *page = &book->page[i], *other = g_hash_table_lookup (names, page->name);

      if (other)
        good = cli_error ("\"%s\" and \"%s\" would have results of the same name: use a folder for each.", other->path,
                          page->path);
      g_hash_table_insert (names, page->name, (gpointer) page);
      for (guint k = 0; k < book->results->len && good; k++)
        good = check_result (read, page, cli_book_result_path (book, page->name,
                                                               &g_array_index (book->results, CliResult, k)));
      good = good && check_result (read, page, cli_page_state_path (page));
    }
  g_hash_table_destroy (names);
  g_hash_table_destroy (read);
  return good;
}

static bool
check_layers (const CliOptions *o)
{
  return !(o->scribbles || o->arrows || o->contours || o->corrections || o->hidden || o->depth_hint || o->colours) ||
         cli_error ("With --output-dir each page is a layered file (PSD, ORA, KRA, EXR) or, with --flats, a coloured "
                    "drawing: leave out options that name layers.");
}

/* Takes over the pages that the parser left in `words`. */
static bool
take_pages (CliBook *book, const GPtrArray *words)
{
  book->n       = g_strv_length (book->options.inputs);
  book->page    = g_new0 (CliPage, book->n);
  book->program = g_file_read_link ("/proc/self/exe", NULL);
  book->jobs    = book->options.jobs ? book->options.jobs : (int) g_get_num_processors ();
  book->jobs    = (int) MIN ((size_t) book->jobs, book->n);
  for (size_t i = 0; i < book->n; i++)
    {
      char *word = words->pdata[i + 1];

      book->page[i] = (CliPage) { .book = book, .path = g_strdup (word), .name = page_name (word) };
      g_ptr_array_remove (book->common, word);
    }
  return check_layers (&book->options) && check_names (book) &&
         (book->program || cli_error ("Cannot find the program itself in /proc."));
}

/* ------------------------------------------------------------------ making pages */

static void look_at_pages (CliBook *book);

static void
count_page (CliBook *book)
{
  book->run.host.progress (&book->run, (double) (book->made + book->kept + book->failed) / (double) book->n);
}

/* Prints what the process of a page printed, with the name of the page in front. */
static void
say_of_page (const CliPage *page, char *text)
{
  char **lines = g_strsplit (text ? text : "", "\n", 0);

  for (char **line = lines; *line; line++)
    if (**line)
      cli_say ("%s: %s", page->path, *line + (g_str_has_prefix (*line, "celdepth: ") ? strlen ("celdepth: ") : 0));
  g_strfreev (lines);
}

static void
end_page (GObject *process, GAsyncResult *result, gpointer data)
{
  CliPage *page = data;
  CliBook *book = page->book;
  char *text = NULL;
  int   code;

  g_subprocess_communicate_utf8_finish (G_SUBPROCESS (process), result, NULL, &text, NULL);
  code = g_subprocess_get_if_exited (page->process) ? g_subprocess_get_exit_status (page->process) : -1;
  g_clear_object (&page->process);
  book->running--;
  if (!book->stopped)
    {
      say_of_page (page, text);
      if (code == -1)
        cli_say ("%s: the program crashed, or was killed because memory was short.", page->path);
      if ((code == CLI_DONE || code == CLI_CONTRADICTED) && cli_page_write_state (page, code == CLI_CONTRADICTED))
        book->made++;
      else
        book->failed++;
      book->contradicted += code == CLI_CONTRADICTED;
      count_page (book);
    }
  g_free (text);
  look_at_pages (book);
}

static bool
begin_page (CliPage *page)
{
  CliBook                *book = page->book;
  GPtrArray           *words = g_ptr_array_new_with_free_func (g_free);
  GSubprocessLauncher *launcher = g_subprocess_launcher_new (G_SUBPROCESS_FLAGS_STDOUT_SILENCE |
                                                             G_SUBPROCESS_FLAGS_STDERR_PIPE);
  char                *threads = g_strdup_printf ("%d", MAX ((int) g_get_num_processors () / book->jobs, 1));

  cli_page_remove_unfinished (page);
  g_ptr_array_add (words, g_strdup (book->program));
  g_ptr_array_add (words, g_strdup ("popup"));
  for (guint i = 0; i < book->common->len; i++)
    g_ptr_array_add (words, g_strdup (book->common->pdata[i]));
  cli_book_name_results (book, page->name, words);
  g_ptr_array_add (words, g_strdup ("--"));
  g_ptr_array_add (words, g_strdup (page->path));
  g_ptr_array_add (words, NULL);
  g_subprocess_launcher_setenv (launcher, CLI_THREADS_VARIABLE, threads, TRUE);
  page->process = g_subprocess_launcher_spawnv (launcher, (const char *const *) words->pdata, NULL);
  if (page->process)
    {
      book->running++;
      g_subprocess_communicate_utf8_async (page->process, NULL, NULL, end_page, page);
    }
  else
    cli_say ("%s: no process could be started for it.", page->path);
  g_object_unref (launcher);
  g_ptr_array_free (words, TRUE);
  g_free (threads);
  return page->process != NULL;
}

/* Begins pages that have to be made, as many as there are jobs. */
static void
look_at_pages (CliBook *book)
{
  while (book->next < book->n && book->running < book->jobs && !book->stopped)
    {
      CliPage *page = &book->page[book->next++];
      bool     contradicted = false, known = cli_page_take_fingerprint (page);
      bool     made = known && cli_page_is_made (page, &contradicted);

      book->kept         += made;
      book->contradicted += contradicted;
      book->failed       += !known || (!made && !begin_page (page));
      count_page (book);
    }
}

/* Ends the processes of the pages if the run is cancelled. */
static gboolean
look_for_end (gpointer data)
{
  CliBook *book = data;

  if (cli_run_cancelled () && !book->stopped)
    {
      book->stopped = true;
      for (size_t i = 0; i < book->n; i++)
        if (book->page[i].process)
          g_subprocess_send_signal (book->page[i].process, SIGTERM);
    }
  return G_SOURCE_CONTINUE;
}

/* Makes all pages; the exit code. */
static int
make_pages (CliBook *book)
{
  guint timer = g_timeout_add (LOOK_AFTER, look_for_end, book);
  bool  good;

  cli_run_begin (&book->run, &book->options, "pages");
  cli_run_stage (&book->run, "pages");
  look_at_pages (book);
  while (book->running > 0)
    g_main_context_iteration (NULL, TRUE);
  g_source_remove (timer);
  good = cli_run_finish (&book->run, CELD_OK);
  cli_run_end (&book->run);
  if (good && (book->failed || !book->options.quiet))
    cli_say ("%zu page%s: %zu made, %zu kept from an earlier run, %zu failed.", book->n, book->n == 1 ? "" : "s",
             book->made, book->kept, book->failed);
  return !good || book->failed ? CLI_FAILED : book->contradicted ? CLI_CONTRADICTED : CLI_DONE;
}

/* ------------------------------------------------------------------ the command */

/* The exit code; a new folder in which no page was made is not left. */
static int
make_in_folder (CliBook *book)
{
  const char *folder = book->options.output_dir;
  int         made = 0, code = CLI_FAILED;

  if (cli_outputs_make_folder (folder, &made))
    code = make_pages (book);
  cli_outputs_unmake_folder (folder, made);
  return code;
}

static void
clear_book (CliBook *book)
{
  for (size_t i = 0; i < book->n; i++)
    {
      g_free (book->page[i].path);
      g_free (book->page[i].name);
      g_free (book->page[i].fingerprint);
    }
  for (guint i = 0; i < book->results->len; i++)
    {
      g_free (g_array_index (book->results, CliResult, i).option);
      g_free (g_array_index (book->results, CliResult, i).ending);
    }
  g_array_free (book->results, TRUE);
  g_ptr_array_free (book->common, TRUE);
  g_free (book->page);
  g_free (book->folder);
  g_free (book->program);
}

int
cli_pages_run (const CliCommand *command, int argc, char **argv)
{
  CliBook       book = { .results = g_array_new (FALSE, FALSE, sizeof (CliResult)), .common = g_ptr_array_new () };
  GPtrArray *words = g_ptr_array_new ();
  int        code = CLI_USAGE;

  g_ptr_array_add (words, argv[0]);
  if (cli_book_sort_words (&book, command, argc, argv, words))
    {
      if (!book.results->len)
        {
          cli_book_add_result (&book, "depth", "png");
          cli_book_add_result (&book, "shaded", "png");
        }
      code = cli_book_parse (&book, command, words);
      if (code == CLI_DONE)
        code = take_pages (&book, words) ? CLI_DONE : CLI_USAGE;
      if (code == CLI_DONE)
        code = make_in_folder (&book);
      cli_options_clear (&book.options);
    }
  clear_book (&book);
  g_ptr_array_free (words, TRUE);
  return code;
}
