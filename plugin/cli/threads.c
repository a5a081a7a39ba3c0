/* Threads for the loops of core, one for each processor if the environment does not limit them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

struct CliThreads
{
  GThreadPool *pool;
  int          helpers;    /* threads besides the caller's */
  GMutex       mutex;
  GCond        finished;
  int          busy;       /* helpers that have not finished the loop */
};

/* One loop. */
typedef struct
{
  int    n;
  int    next;
  void (*body) (void *data, int i);
  void  *data;
} Loop;

static void
work (Loop *loop)
{
  for (int i = g_atomic_int_add (&loop->next, 1); i < loop->n; i = g_atomic_int_add (&loop->next, 1))
    loop->body (loop->data, i);
}

static void
help (gpointer item, gpointer data)
{
  Loop       *loop = item;
  CliThreads *threads = data;

  work (loop);
  g_mutex_lock (&threads->mutex);
  if (--threads->busy == 0)
    g_cond_signal (&threads->finished);
  g_mutex_unlock (&threads->mutex);
}

CliThreads *
cli_threads_new (void)
{
  const char *limit = g_getenv (CLI_THREADS_VARIABLE);
  int         most = limit ? (int) g_ascii_strtoll (limit, NULL, 10) : (int) g_get_num_processors ();
  int         helpers = MIN (most, 64) - 1;
  CliThreads *threads;

  if (helpers < 1)
    return NULL;
  threads = g_new0 (CliThreads, 1);
  g_mutex_init (&threads->mutex);
  g_cond_init (&threads->finished);
  threads->helpers = helpers;
  threads->pool = g_thread_pool_new (help, threads, helpers, FALSE, NULL);
  return threads;
}

void
cli_threads_free (CliThreads *threads)
{
  if (!threads)
    return;
  g_thread_pool_free (threads->pool, FALSE, TRUE);
  g_mutex_clear (&threads->mutex);
  g_cond_clear (&threads->finished);
  g_free (threads);
}

void
cli_threads_each (CliThreads *threads, int n, void (*body) (void *data, int i), void *data)
{
  Loop loop = { n, 0, body, data };

  if (threads && n > 1)
    {
      threads->busy = MIN (threads->helpers, n - 1);
      for (int i = threads->busy; i > 0; i--)
        g_thread_pool_push (threads->pool, &loop, NULL);
    }
  work (&loop);
  if (threads && n > 1)
    {
      g_mutex_lock (&threads->mutex);
      while (threads->busy > 0)
        g_cond_wait (&threads->finished, &threads->mutex);
      g_mutex_unlock (&threads->mutex);
    }
}
