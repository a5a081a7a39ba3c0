/* Measures the Laplacian solver on eq. (3) of one drawing, against CHOLMOD and conjugate gradients with IC(0).
 *
 *   bench-laplace DRAWING SCRIBBLES RELATIONS RUNS CHOLMOD ICCG-SECONDS
 *
 * Prints one JSON object.  DRAWING has the size that is measured; SCRIBBLES are enlarged to it, RELATIONS is a file
 * with points of that size.  Times are medians of RUNS, in seconds of processor time, those on two threads of the
 * clock.
 * CHOLMOD 1: errors are true ones, against CHOLMOD's refined solution; 0: against our own, to a tenth of the tolerance.
 * ICCG-SECONDS: when conjugate gradients give up; 0: not at all.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "rivals.h"
#include "depth/depth.h"
#include "solve/laplace.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#define MOST_RUNS 99

static const struct { const char *name; double error; } wanted[] = { { "1e-3", 1e-3 }, { "1/65535", 1. / 65535 } };

/* ------------------------------------------------------------------ the system */

/* Levels of the whole route, cut as smooth depth cuts them, held at the scribbles and in the cores of the rest. */
static System
system_of (const char *drawing, const char *scribbles, const char *relations)
{
  CeldSession *session = celd_session_new ();
  CeldSettings settings = celd_settings ();
  CeldPlane    luma = read_grey (drawing), ink, levels;
  CeldPaint    paint = read_colours (scribbles, luma.width, luma.height);
  CeldLabels   seeds;
  CeldPalette  palette = { 0 };
  CeldDepthEdges edges;
  System       s = { luma.width, luma.height, (size_t) luma.width * (size_t) luma.height, NULL, NULL, NULL, NULL };

  s.east  = celd_alloc (s.n, sizeof *s.east);
  s.south = celd_alloc (s.n, sizeof *s.south);
  s.value = celd_alloc (s.n, sizeof *s.value);
  s.fixed = celd_alloc0 (s.n, 1);
  if (!session || !s.east || !s.south || !s.value || !s.fixed)
    must (CELD_NO_MEMORY);
  must (celd_session_set_drawing (session, &(CeldDrawing) { .luma = luma }));
  must (celd_session_set_scribbles (session, &paint));
  must (celd_session_set_relations (session, relations, NULL));
  must (celd_session_ink (session, NULL, &ink, NULL));
  must (celd_session_levels (session, NULL, &levels, NULL));
  must (celd_labels_new (s.width, s.height, &seeds));
  must (celd_scribbles_read (&paint, &settings, NULL, &seeds, &palette));
  celd_depth_levels (&levels, s.value);
  for (size_t p = 0; p < s.n; p++)
    s.fixed[p] = seeds.data[p] != 0;
  must (celd_cores_mark (s.width, s.height, s.value, CELD_SPECK, NULL, NULL, NULL, s.fixed));
  edges = (CeldDepthEdges) { &ink, settings.ink_threshold, celd_edge_radius (celd_stroke_width (&ink)), NULL };
  must (celd_depth_weights (&edges, s.value, NULL, s.east, s.south));
  celd_session_free (session);
  celd_palette_clear (&palette);
  celd_free (seeds.data);
  celd_free (luma.data);
  free (paint.data);
  return s;
}

static double
range_of (const System *s)
{
  float low = INFINITY, high = -INFINITY;

  for (size_t p = 0; p < s->n; p++)
    if (s->fixed[p])
      {
        low  = fminf (low, s->value[p]);
        high = fmaxf (high, s->value[p]);
      }
  return (double) high - (double) low;
}

/* ------------------------------------------------------------------ two threads */

typedef struct { int n, next; void (*body) (void *data, int i); void *data; } Loop;

static void *
work (void *data)
{
  Loop *loop = data;

  for (int i; (i = __atomic_fetch_add (&loop->next, 1, __ATOMIC_SEQ_CST)) < loop->n;)
    loop->body (loop->data, i);
  return NULL;
}

/* The helper sleeps in `gate` between the loops. */
static struct { pthread_t thread; pthread_barrier_t gate; Loop *loop; } helper;

static void *
help (void *nothing)
{
  for (;;)
    {
      pthread_barrier_wait (&helper.gate);
      if (!helper.loop)
        return nothing;
      work (helper.loop);
      pthread_barrier_wait (&helper.gate);
    }
}

static void
each_on_two (void *host, int n, void (*body) (void *data, int i), void *data)
{
  Loop loop = { n, 0, body, data };

  (void) host;
  helper.loop = &loop;
  pthread_barrier_wait (&helper.gate);
  work (&loop);
  pthread_barrier_wait (&helper.gate);
}

static double
clock_seconds (void)
{
  struct timespec t;

  clock_gettime (CLOCK_MONOTONIC, &t);
  return (double) t.tv_sec + 1e-9 * (double) t.tv_nsec;
}

/* ------------------------------------------------------------------ figures */

typedef struct { double set_up, solve; CeldSolve how; } Timed;

/* From nothing: free pixels start at 0. */
static Timed
solve (const System *s, double error, const CeldHost *host, double (*clock) (void), float *x)
{
  static float *none;
  CeldLaplace  *laplace = NULL;
  Timed         answer;
  double        start;

  none = none ? none : celd_alloc0 (s->n, sizeof *none);
  for (size_t p = 0; p < s->n; p++)
    x[p] = s->fixed[p] ? s->value[p] : 0;
  start = clock ();
  must (celd_lap_setup (s->width, s->height, s->east, s->south, NULL, s->fixed, host, &laplace));
  answer.set_up = clock () - start;
  start = clock ();
  must (celd_lap_solve (laplace, 1, none, x, error, host, &answer.how));
  answer.solve = clock () - start;
  celd_lap_free (laplace);
  return answer;
}

static void
print_named (const char *kind, const char *name, double value)
{
  char text[80];

  snprintf (text, sizeof text, "%s %s", kind, name);
  print_number (text, value);
}

static void
measure_ours (const System *s, const Matrix *m, const double *truth, double range, int runs)
{
  float *x = celd_alloc (s->n, sizeof *x);

  for (size_t k = 0; k < sizeof wanted / sizeof *wanted; k++)
    {
      double set_up[MOST_RUNS], whole[MOST_RUNS], worst = 0;
      Timed  answer = { 0 };

      for (int i = 0; i < runs; i++)
        {
          answer    = solve (s, wanted[k].error, NULL, seconds, x);
          set_up[i] = answer.set_up;
          whole[i]  = answer.set_up + answer.solve;
        }
      for (size_t i = 0; i < m->n; i++)
        worst = fmax (worst, fabs ((double) x[m->pixel[i]] - truth[i]));
      print_named ("set-up", wanted[k].name, median (set_up, runs));
      print_named ("ours", wanted[k].name, median (whole, runs));
      print_named ("iterations", wanted[k].name, answer.how.iterations);
      print_named ("error", wanted[k].name, worst / range);
    }
  celd_free (x);
}

/* By the clock, alternately: the machine's other work then disturbs both. */
static void
measure_threads (const System *s, int runs)
{
  float   *x = celd_alloc (s->n, sizeof *x);
  double   one[MOST_RUNS], two[MOST_RUNS];
  CeldHost host = { NULL, each_on_two, NULL };

  pthread_barrier_init (&helper.gate, NULL, 2);
  if (pthread_create (&helper.thread, NULL, help, NULL))
    must (CELD_NO_MEMORY);
  for (int i = 0; i < runs; i++)
    {
      Timed alone = solve (s, 1e-3, NULL, clock_seconds, x), both = solve (s, 1e-3, &host, clock_seconds, x);

      one[i] = alone.set_up + alone.solve;
      two[i] = both.set_up + both.solve;
    }
  helper.loop = NULL;
  pthread_barrier_wait (&helper.gate);
  pthread_join (helper.thread, NULL);
  print_number ("one thread", median (one, runs));
  print_number ("two threads", median (two, runs));
  celd_free (x);
}

static void
measure_iccg (const Matrix *m, const double *truth, double range, double limit)
{
  for (size_t k = 0; k < sizeof wanted / sizeof *wanted; k++)
    {
      int    iterations;
      double time = iccg_seconds (m, truth, range, wanted[k].error, limit, &iterations);

      print_named ("iccg iterations", wanted[k].name, iterations);
      if (isfinite (time))
        print_named ("iccg", wanted[k].name, time);
    }
}

/* The solution that errors are counted from. */
static double *
truth_of (const System *s, const Matrix *m, bool cholmod)
{
  double *truth = celd_alloc (m->n, sizeof *truth);
  float  *x;

  if (cholmod)
    {
      Cholmod time = cholmod_of (m, truth);

      print_number ("cholmod", time.analyse + time.factorize + time.solve);
      print_number ("cholmod solve", time.solve);
      return truth;
    }
  x = celd_alloc (s->n, sizeof *x);
  solve (s, 1e-6, NULL, seconds, x);
  for (size_t i = 0; i < m->n; i++)
    truth[i] = (double) x[m->pixel[i]];
  celd_free (x);
  return truth;
}

int
main (int argc, char **argv)
{
  if (argc != 7)
    {
      fprintf (stderr, "usage: bench-laplace DRAWING SCRIBBLES RELATIONS RUNS CHOLMOD ICCG-SECONDS\n");
      return 2;
    }

  char   *relations = read_text (argv[3]);
  System  s = system_of (argv[1], argv[2], relations);
  Matrix  m = matrix_of (&s);
  double  range = range_of (&s);
  int     runs = atoi (argv[4]) < 1 ? 1 : atoi (argv[4]) > MOST_RUNS ? MOST_RUNS : atoi (argv[4]);
  double *truth;

  printf ("{\n  \"pixels\": %zu", s.n);
  print_number ("unknown", (double) m.n);
  truth = truth_of (&s, &m, atoi (argv[5]) != 0);
  measure_ours (&s, &m, truth, range, runs);
  if (atof (argv[6]) > 0)
    measure_iccg (&m, truth, range, atof (argv[6]));
  measure_threads (&s, runs);
  printf ("\n}\n");
  free (relations);
  celd_free (truth);
  matrix_clear (&m);
  celd_free (s.east);
  celd_free (s.south);
  celd_free (s.value);
  celd_free (s.fixed);
  return 0;
}
