/* celdepth popup PAGES... --output-dir FOLDER: the same results of many pages.
 *
 * Results are named after their pages: FOLDER/PAGE-depth.exr.  Each page is made by a process of its own, several at a
 * time, so that one that crashes or needs too much memory does not end the others.  When a page is complete, a small
 * JSON file with a fingerprint of all that it was made from is written; as long as that is right, and all results are
 * there, the page is not made again.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "fingerprint.h"
#include "json.h"
#include "options.h"
#include "pages.h"

#include <gio/gio.h>
#include <string.h>

#define LOOK_AFTER 100 /* milliseconds between looks whether the run was cancelled (chosen) */

/* A kind of result, such as "depth" and "exr". */
typedef struct { char *option, *ending; } Result;

typedef struct Book Book;

typedef struct
{
  Book        *book;
  char        *path, *name;    /* as it was given, and without folder and ending */
  char        *fingerprint;
  GSubprocess *process;        /* while it is made */
} Page;

struct Book
{
  CliOptions options;
  GArray    *results;          /* Result */
  GPtrArray *common;           /* words of the command line that hold for all pages, borrowed */
  char      *folder, *program;
  Page      *page;
  size_t     n, next;          /* pages; the next one to be looked at */
  int        jobs, running;
  size_t     made, kept, failed, contradicted;
  bool       stopped;
  CliRun     run;
};

/* ------------------------------------------------------------------ the command line */

static bool
is_option (const char *word, const char *name)
{
  size_t n = strlen (name);

  return !strncmp (word, name, n) && (!word[n] || word[n] == '=');
}

bool
cli_pages_asked (const CliCommand *command, int argc, char **argv)
{
  bool asked = false;

  for (int i = 1; i < argc && strcmp (argv[i], "--"); i++)
    asked = asked || is_option (argv[i], "--output-dir");
  return asked && command->step == CLI_POPUP;
}

static void
add_result (Book *book, const char *option, const char *ending)
{
  g_array_append_val (book->results, ((Result) { g_strdup (option), g_strdup (ending + (ending[0] == '.')) }));
}

/* Takes a word such as --depth or --depth=png, which may not have a name after it; false with a message.  *taken says
 * whether it is one. */
static bool
take_result (Book *book, const CliCommand *command, const char *word, const char *next, bool *taken)
{
  const char *value = strchr (word, '='), *ending;
  char       *option = g_strndup (word + 2, value ? (size_t) (value - word) - 2 : strlen (word) - 2);
  bool        good = true;

  ending = cli_files_ending (command, option);
  *taken = ending != NULL;
  if (ending && value && (strchr (value, G_DIR_SEPARATOR) || strchr (value + 2, '.')))
    good = cli_error ("With --output-dir, results are named after their pages: give --%s, or its format, such as "
                      "--%s=%s.", option, option, ending);
  else if (ending && !value && next && next[0] != '-' && !g_file_test (next, G_FILE_TEST_EXISTS))
    good = cli_error ("There is no page \"%s\". With --output-dir, results are named after their pages: give --%s "
                      "without a name.", next, option);
  else if (ending)
    add_result (book, option, value ? value + 1 : ending);
  g_free (option);
  return good;
}

/* Sorts the words into results, those that the parser gets, and of the latter those that hold for all pages. */
static bool
sort_words (Book *book, const CliCommand *command, int argc, char **argv, GPtrArray *words)
{
  bool good = true, taken;

  for (int i = 1; i < argc && good; i++)
    {
      const char *next = i + 1 < argc ? argv[i + 1] : NULL;

      taken = false;
      if (!strcmp (argv[i], "--"))
        {
          while (i < argc)
            g_ptr_array_add (words, argv[i++]);
          break;
        }
      if (is_option (argv[i], "--output-dir") || is_option (argv[i], "--jobs"))
        {
          const char *value = strchr (argv[i], '=');

          if (is_option (argv[i], "--output-dir"))
            book->folder = g_strdup (value ? value + 1 : next ? next : ".");
          g_ptr_array_add (words, argv[i]);
          if (!value && next)
            g_ptr_array_add (words, argv[++i]);
          continue;
        }
      if (g_str_has_prefix (argv[i], "--"))
        good = take_result (book, command, argv[i], next, &taken);
      if (!taken)
        {
          g_ptr_array_add (words, argv[i]);
          g_ptr_array_add (book->common, argv[i]);
        }
    }
  return good;
}

/* The file of a result; free with g_free. */
static char *
result_path (const Book *book, const char *page, const Result *result)
{
  char *name = g_strdup_printf ("%s-%s.%s", page, result->option, result->ending);
  char *path = g_build_filename (book->folder, name, NULL);

  g_free (name);
  return path;
}

/* Appends options that name the results of a page; free them with g_free. */
static void
name_results (const Book *book, const char *page, GPtrArray *words)
{
  for (guint i = 0; i < book->results->len; i++)
    {
      const Result *result = &g_array_index (book->results, Result, i);
      char         *path = result_path (book, page, result);

      g_ptr_array_add (words, g_strdup_printf ("--%s=%s", result->option, path));
      g_free (path);
    }
}

/* Parses the command line as that of a page whose name cannot be a real one's.  Leaves in `words` the command and the
 * pages alone. */
static int
parse (Book *book, const CliCommand *command, GPtrArray *words)
{
  GPtrArray *named = g_ptr_array_new_with_free_func (g_free);
  int        code;

  name_results (book, ".page", named);
  for (guint i = 0; i < named->len; i++)
    g_ptr_array_insert (words, 1, named->pdata[i]);
  code = cli_options_parse (command, (int) words->len, (char **) words->pdata, &book->options);
  g_ptr_array_free (named, TRUE);
  return code;
}

/* ------------------------------------------------------------------ pages */

static char *
page_name (const char *path)
{
  char *name = g_path_get_basename (path), *dot = strrchr (name, '.');

  if (dot && dot != name)
    *dot = 0;
  return name;
}

/* Whether results are those of one page each, and no page. */
static bool
check_names (const Book *book)
{
  GHashTable *pages = g_hash_table_new_full (g_str_hash, g_str_equal, g_free, NULL);
  GHashTable *names = g_hash_table_new (g_str_hash, g_str_equal);
  bool        good = true;

  for (size_t i = 0; i < book->n; i++)
    g_hash_table_add (pages, g_canonicalize_filename (book->page[i].path, NULL));
  for (size_t i = 0; i < book->n && good; i++)
    {
      const Page *page = &book->page[i], *other = g_hash_table_lookup (names, page->name);

      if (other)
        good = cli_error ("\"%s\" and \"%s\" would have results of the same name: use a folder for each.", other->path,
                          page->path);
      g_hash_table_insert (names, page->name, (gpointer) page);
      for (guint k = 0; k < book->results->len && good; k++)
        {
          char *path = result_path (book, page->name, &g_array_index (book->results, Result, k));
          char *full = g_canonicalize_filename (path, NULL);

          if (g_hash_table_contains (pages, full))
            good = cli_error ("\"%s\" would be overwritten by a result of \"%s\": give another --output-dir.", path,
                              page->path);
          g_free (full);
          g_free (path);
        }
    }
  g_hash_table_destroy (names);
  g_hash_table_destroy (pages);
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
take_pages (Book *book, const GPtrArray *words)
{
  book->n       = g_strv_length (book->options.inputs);
  book->page    = g_new0 (Page, book->n);
  book->program = g_file_read_link ("/proc/self/exe", NULL);
  book->jobs    = book->options.jobs ? book->options.jobs : (int) g_get_num_processors ();
  book->jobs    = (int) MIN ((size_t) book->jobs, book->n);
  for (size_t i = 0; i < book->n; i++)
    {
      char *word = words->pdata[i + 1];

      book->page[i] = (Page) { .book = book, .path = g_strdup (word), .name = page_name (word) };
      g_ptr_array_remove (book->common, word);
    }
  return check_layers (&book->options) && check_names (book) &&
         (book->program || cli_error ("Cannot find the program itself in /proc."));
}

/* ------------------------------------------------------------------ what is there */

static char *
state_path (const Page *page)
{
  char *name = g_strdup_printf (".%s.state.json", page->name);
  char *path = g_build_filename (page->book->folder, name, NULL);

  g_free (name);
  return path;
}

/* Of the program, settings, options, relations and the page; false with a message. */
static bool
take_fingerprint (Page *page)
{
  const Book *book = page->book;
  GChecksum  *sum = cli_fingerprint_new (&book->options.settings);

  for (guint i = 0; i < book->common->len; i++)
    if (strcmp (book->common->pdata[i], "--quiet") && strcmp (book->common->pdata[i], "-q"))
      g_checksum_update (sum, book->common->pdata[i], (gssize) strlen (book->common->pdata[i]) + 1);
  for (guint i = 0; i < book->results->len; i++)
    {
      const Result *result = &g_array_index (book->results, Result, i);

      g_checksum_update (sum, (const guchar *) result->option, -1);
      g_checksum_update (sum, (const guchar *) result->ending, (gssize) strlen (result->ending) + 1);
    }
  page->fingerprint = cli_fingerprint_end (sum, cli_fingerprint_add_file (sum, book->options.relations_file) &&
                                                cli_fingerprint_add_file (sum, page->path));
  return page->fingerprint != NULL;
}

/* Whether an earlier run has made the page of the same; *contradicted says whether its relations contradict. */
static bool
is_made (const Page *page, bool *contradicted)
{
  const Book *book = page->book;
  char       *path = state_path (page);
  JsonParser *parser = json_parser_new_immutable ();
  JsonNode   *root = json_parser_load_from_file (parser, path, NULL) ? json_parser_get_root (parser) : NULL;
  JsonObject *state = root && JSON_NODE_HOLDS_OBJECT (root) ? json_node_get_object (root) : NULL;
  bool        made = state && !g_strcmp0 (json_object_get_string_member_with_default (state, "fingerprint", NULL),
                                          page->fingerprint);

  *contradicted = made && json_object_get_boolean_member_with_default (state, "contradicted", FALSE);
  for (guint i = 0; i < book->results->len && made; i++)
    {
      char *result = result_path (book, page->name, &g_array_index (book->results, Result, i));

      made = g_file_test (result, G_FILE_TEST_IS_REGULAR);
      g_free (result);
    }
  g_object_unref (parser);
  g_free (path);
  return made;
}

static bool
write_state (const Page *page, bool contradicted)
{
  char        *path = state_path (page);
  JsonBuilder *json = json_builder_new ();
  bool         good;

  json_builder_begin_object (json);
  json_builder_set_member_name (json, "fingerprint");
  json_builder_add_string_value (json, page->fingerprint);
  json_builder_set_member_name (json, "contradicted");
  json_builder_add_boolean_value (json, contradicted);
  json_builder_end_object (json);
  good = cli_write_json (path, json);
  g_free (path);
  return good;
}

/* Removes what a run that was killed left of a page. */
static void
remove_unfinished (const Page *page)
{
  const Book *book = page->book;
  char       *state = state_path (page);

  cli_remove_unfinished (state);
  for (guint i = 0; i < book->results->len; i++)
    {
      char *path = result_path (book, page->name, &g_array_index (book->results, Result, i));

      cli_remove_unfinished (path);
      g_free (path);
    }
  g_free (state);
}

/* ------------------------------------------------------------------ making pages */

static void look_at_pages (Book *book);

static void
count_page (Book *book)
{
  book->run.host.progress (&book->run, (double) (book->made + book->kept + book->failed) / (double) book->n);
}

/* Prints what the process of a page printed, with the name of the page in front. */
static void
say_of_page (const Page *page, char *text)
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
  Page *page = data;
  Book *book = page->book;
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
      if ((code == CLI_DONE || code == CLI_CONTRADICTED) && write_state (page, code == CLI_CONTRADICTED))
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
begin_page (Page *page)
{
  Book                *book = page->book;
  GPtrArray           *words = g_ptr_array_new_with_free_func (g_free);
  GSubprocessLauncher *launcher = g_subprocess_launcher_new (G_SUBPROCESS_FLAGS_STDOUT_SILENCE |
                                                             G_SUBPROCESS_FLAGS_STDERR_PIPE);
  char                *threads = g_strdup_printf ("%d", MAX ((int) g_get_num_processors () / book->jobs, 1));
  GError              *error = NULL;

  remove_unfinished (page);
  g_ptr_array_add (words, g_strdup (book->program));
  g_ptr_array_add (words, g_strdup ("popup"));
  for (guint i = 0; i < book->common->len; i++)
    g_ptr_array_add (words, g_strdup (book->common->pdata[i]));
  name_results (book, page->name, words);
  g_ptr_array_add (words, g_strdup ("--"));
  g_ptr_array_add (words, g_strdup (page->path));
  g_ptr_array_add (words, NULL);
  g_subprocess_launcher_setenv (launcher, CLI_THREADS_VARIABLE, threads, TRUE);
  page->process = g_subprocess_launcher_spawnv (launcher, (const char *const *) words->pdata, &error);
  if (page->process)
    {
      book->running++;
      g_subprocess_communicate_utf8_async (page->process, NULL, NULL, end_page, page);
    }
  else
    cli_say ("%s: %s.", page->path, error->message);
  g_clear_error (&error);
  g_object_unref (launcher);
  g_ptr_array_free (words, TRUE);
  g_free (threads);
  return page->process != NULL;
}

/* Begins pages that have to be made, as many as there are jobs. */
static void
look_at_pages (Book *book)
{
  while (book->next < book->n && book->running < book->jobs && !book->stopped)
    {
      Page *page = &book->page[book->next++];
      bool  contradicted = false, known = take_fingerprint (page), made = known && is_made (page, &contradicted);

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
  Book *book = data;

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
make_pages (Book *book)
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

static void
clear_book (Book *book)
{
  for (size_t i = 0; i < book->n; i++)
    {
      g_free (book->page[i].path);
      g_free (book->page[i].name);
      g_free (book->page[i].fingerprint);
    }
  for (guint i = 0; i < book->results->len; i++)
    {
      g_free (g_array_index (book->results, Result, i).option);
      g_free (g_array_index (book->results, Result, i).ending);
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
  Book       book = { .results = g_array_new (FALSE, FALSE, sizeof (Result)), .common = g_ptr_array_new () };
  GPtrArray *words = g_ptr_array_new ();
  int        code = CLI_USAGE;

  g_ptr_array_add (words, argv[0]);
  if (sort_words (&book, command, argc, argv, words))
    {
      if (!book.results->len)
        {
          add_result (&book, "depth", "png");
          add_result (&book, "shaded", "png");
        }
      code = parse (&book, command, words);
      if (code == CLI_DONE)
        code = take_pages (&book, words) ? make_pages (&book) : CLI_USAGE;
      cli_options_clear (&book.options);
    }
  clear_book (&book);
  g_ptr_array_free (words, TRUE);
  return code;
}
