/* All results of a session are equal, bit by bit, for any number of the host's threads.
 *
 * Built with -fsanitize=thread as well, where a data race fails the test.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"

#include <pthread.h>
#include <stdatomic.h>

#define WIDTH  240
#define HEIGHT 180
#define MOST   7

/* ------------------------------------------------------------------ a host that lends threads */

typedef struct
{
  int        n;
  atomic_int next;
  void     (*body) (void *data, int i);
  void      *data;
} Job;

static void *
work (void *argument)
{
  Job *job = argument;
  int  i;

  while ((i = atomic_fetch_add (&job->next, 1)) < job->n)
    job->body (job->data, i);
  return NULL;
}

static void
each (void *host, int n, void (*body) (void *data, int i), void *data)
{
  int       threads = *(const int *) host;
  Job       job = { .n = n, .body = body, .data = data };
  pthread_t thread[MOST];

  for (int i = 0; i < threads; i++)
    if (pthread_create (&thread[i], NULL, work, &job))
      abort ();
  for (int i = 0; i < threads; i++)
    pthread_join (thread[i], NULL);
}

/* ------------------------------------------------------------------ a drawing: three rings, one over the other */

typedef struct { float luma[WIDTH * HEIGHT]; uint8_t scribbles[4 * WIDTH * HEIGHT]; } Page;

/* x, y, radius; farthest first */
static const double ring[3][3] = { { 80, 80, 55 }, { 140, 70, 50 }, { 115, 125, 45 } };

static void
draw (Page *page)
{
  static const uint8_t colour[4][4] = {
    { 255, 0, 0, 255 }, { 0, 255, 0, 255 }, { 0, 0, 255, 255 }, { 255, 255, 0, 255 }
  };

  memset (page->scribbles, 0, sizeof page->scribbles);
  for (int y = 0; y < HEIGHT; y++)
    for (int x = 0; x < WIDTH; x++)
      {
        float *luma = &page->luma[y * WIDTH + x];
        int    over = 3; /* the background */

        *luma = 1;
        for (int i = 0; i < 3; i++)
          {
            double d = hypot (x - ring[i][0], y - ring[i][1]) - ring[i][2];

            if (d < 3)
              *luma = (float) fmin (1, fmax (0, fabs (d) - 2));
            if (d < 0)
              over = i;
          }
        if (x % 24 < 3 && y % 24 < 16 && *luma > 0.99f)
          memcpy (&page->scribbles[4 * (y * WIDTH + x)], colour[over], 4);
      }
}

/* ------------------------------------------------------------------ the test */

typedef struct
{
  uint32_t labels[WIDTH * HEIGHT];
  float    levels[WIDTH * HEIGHT], depth[WIDTH * HEIGHT], shading[WIDTH * HEIGHT];
} Results;

static bool
run_route (Page *page, const CeldHost *host, Results *results)
{
  CeldSession *session = celd_session_new ();
  CeldDrawing  drawing = { .luma = { WIDTH, HEIGHT, WIDTH, page->luma } };
  CeldPaint    scribbles = { WIDTH, HEIGHT, WIDTH, page->scribbles };
  CeldLabels   labels;
  CeldPlane    levels, depth, shading;
  bool         good = session &&
                      celd_session_set_drawing (session, &drawing) == CELD_OK &&
                      celd_session_set_scribbles (session, &scribbles) == CELD_OK &&
                      celd_session_set_relations (session, "#0000ff > #00ff00 > #ff0000", NULL) == CELD_OK &&
                      celd_session_labels (session, host, &labels, NULL) == CELD_OK;

  if (good)
    memcpy (results->labels, labels.data, sizeof results->labels);
  good = good && celd_session_levels (session, host, &levels, NULL) == CELD_OK;
  if (good)
    memcpy (results->levels, levels.data, sizeof results->levels);
  good = good && celd_session_depth (session, host, &depth, NULL) == CELD_OK;
  if (good)
    memcpy (results->depth, depth.data, sizeof results->depth);
  good = good && celd_session_shading (session, host, &shading, NULL) == CELD_OK;
  if (good)
    memcpy (results->shading, shading.data, sizeof results->shading);
  celd_session_free (session);
  return good;
}

static void
any_number_of_threads_gives_the_same (void)
{
  static Page    page;
  static Results serial, threaded;

  draw (&page);
  CHECK (run_route (&page, NULL, &serial));
  CHECK (serial.levels[0] == 0.f && serial.levels[125 * WIDTH + 115] == 1.f); /* background, and the ring in front */
  for (int threads = 1; threads <= MOST; threads += 2)
    {
      CeldHost host = { .each = each, .data = &threads };

      memset (&threaded, 0xff, sizeof threaded);
      CHECK (run_route (&page, &host, &threaded));
      CHECK (memcmp (serial.labels, threaded.labels, sizeof serial.labels) == 0);
      CHECK (memcmp (serial.levels, threaded.levels, sizeof serial.levels) == 0);
      CHECK (memcmp (serial.depth, threaded.depth, sizeof serial.depth) == 0);
      CHECK (memcmp (serial.shading, threaded.shading, sizeof serial.shading) == 0);
    }
}

int
main (void)
{
  RUN (any_number_of_threads_gives_the_same);
  return DONE;
}
