/* Measures the segmentation of one drawing: line art, basins, first labels, further strokes, exact cuts, Boost's cuts.
 *
 *   bench-segmentation DRAWING SCRIBBLES TRUTH RUNS STROKES EXACT-STROKES BOOST [PREFIX]
 *
 * Prints one JSON object.  DRAWING has the size that is measured; SCRIBBLES and TRUTH are enlarged to it.  TRUTH has
 * the right colours, and no alpha where these are unknown.  Times are medians of RUNS, in seconds of processor
 * time.  EXACT-STROKES -1: without exact cuts.  BOOST 1: the problem that the exact method solved is solved again with
 * Boost.  PREFIX: labels are kept in files.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "bench.h"
#include "segment/basins.h"
#include "solve/maxflow.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MOST_RUNS  99
#define MESS       8        /* random strokes in addition to those of the case (chosen) */
#define MOST_MESSY 2000000  /* pixels: larger pictures are not measured with them (chosen) */

/* ------------------------------------------------------------------ sessions */

static CeldSession *
open_session (const Case *c, const CeldSettings *settings)
{
  CeldSession *session = celd_session_new ();
  CeldPlane    ink;

  if (!session)
    must (CELD_NO_MEMORY);
  must (celd_session_set_settings (session, settings));
  must (celd_session_set_drawing (session, &c->drawing));
  must (celd_session_set_scribbles (session, &c->scribbles));
  must (celd_session_ink (session, NULL, &ink, NULL));
  return session;
}

static double
time_labels (CeldSession *session)
{
  CeldLabels labels;
  CeldRect   changed;
  double     start = seconds ();

  must (celd_session_labels (session, NULL, &labels, &changed));
  return seconds () - start;
}

static Answer
answer_of (const Case *c, CeldSession *session)
{
  const CeldPalette *palette;
  CeldLabels         labels;
  Answer             answer = { malloc (c->n * sizeof *answer.label), { 0 } };

  must (celd_session_labels (session, NULL, &labels, NULL));
  palette             = celd_session_palette (session);
  answer.palette.n    = palette->n;
  answer.palette.item = malloc (palette->n * sizeof *palette->item);
  if (!answer.label || !answer.palette.item)
    must (CELD_NO_MEMORY);
  memcpy (answer.label, labels.data, c->n * sizeof *answer.label);
  memcpy (answer.palette.item, palette->item, palette->n * sizeof *palette->item);
  return answer;
}

/* ------------------------------------------------------------------ line art and basins */

static void
measure_ink (const Case *c)
{
  double time[MOST_RUNS];

  for (int i = 0; i < c->runs; i++)
    {
      CeldSession *session = celd_session_new ();
      CeldPlane    ink;
      double       start;

      must (celd_session_set_drawing (session, &c->drawing));
      start = seconds ();
      must (celd_session_ink (session, NULL, &ink, NULL));
      time[i] = seconds () - start;
      celd_session_free (session);
    }
  print_number ("ink", median (time, c->runs));
}

/* The drawing over fills in the colours of the truth; white where these are unknown. */
static CeldPaint
coloured_page (const Case *c)
{
  CeldPaint art = { c->width, c->height, (size_t) c->width, malloc (4 * c->n) };

  if (!art.data)
    must (CELD_NO_MEMORY);
  for (size_t i = 0; i < c->n; i++)
    {
      const uint8_t *fill = c->truth.data + 4 * i;

      for (size_t k = 0; k < 3; k++)
        art.data[4 * i + k] = (uint8_t) ((fill[3] ? fill[k] : 255) * c->drawing.luma.data[i] + 0.5f);
      art.data[4 * i + 3] = 255;
    }
  return art;
}

/* The lines of a coloured page and their ink. */
static void
measure_coloured_ink (const Case *c)
{
  CeldPaint art = coloured_page (c);
  CeldPlane luma, ink;
  double    time[MOST_RUNS];

  must (celd_plane_new (c->width, c->height, &luma));
  must (celd_plane_new (c->width, c->height, &ink));
  for (int i = 0; i < c->runs; i++)
    {
      CeldDrawing drawing = { .luma = luma };
      double      start = seconds ();

      must (celd_coloured_lines (&art, CELD_INK_LINES, NULL, &drawing));
      must (celd_ink (&drawing, CELD_INK_LINES, NULL, &ink));
      time[i] = seconds () - start;
    }
  print_number ("coloured ink", median (time, c->runs));
  celd_free (luma.data);
  celd_free (ink.data);
  free (art.data);
}

static void
measure_basins (const Case *c, const CeldPlane *ink)
{
  double time[MOST_RUNS];

  for (int i = 0; i < c->runs; i++)
    {
      CeldBasins basins = { 0 };
      Memory     before = memory_now (), after;
      double     start = seconds ();

      memory_mark ();
      must (celd_basins_new (ink, celd_settings ().ink_threshold, NULL, &basins));
      time[i] = seconds () - start;
      after = memory_now ();
      if (i == 0)
        {
          print_number ("basins", (double) basins.n);
          print_number ("borders", (double) basins.n_boundaries);
          print_number ("blocks", (double) basins.n_merged);
          print_number ("stroke width", basins.stroke);
          print_number ("basins kept", (double) (after.live - before.live) / (double) c->n);
          print_number ("basins peak", (double) (after.peak - before.live) / (double) c->n);
        }
      celd_basins_clear (&basins);
    }
  print_number ("build", median (time, c->runs));
}

/* Puts and removes strokes, one by one. */
static void
measure_strokes (const Case *c, const char *method, int n, CeldSession *session)
{
  Answer  before = answer_of (c, session), after;
  double *time = calloc ((size_t) n, sizeof *time), *removed = calloc ((size_t) n, sizeof *removed);
  double  width = brush_width (&c->scribbles), worst = -1, parts[N_PARTS] = { 0 };
  Stroke  slowest = { 0 };
  size_t  peak = 0;
  char    text[80];

  random_start ();
  for (int i = 0; i < n; i++)
    {
      Stroke s = random_stroke (c->width, c->height, &before.palette, width);
      Memory at = memory_now ();
      double start = seconds ();

      memory_mark ();
      parts_reset ();
      must (celd_session_put_stroke (session, 1000, s.x, s.y, &s.mask, s.colour));
      time_labels (session);
      time[i] = seconds () - start;
      if (memory_now ().peak - at.live > peak)
        peak = memory_now ().peak - at.live;
      if (time[i] > worst)
        {
          worst   = time[i];
          slowest = s;
          memcpy (parts, part_seconds, sizeof parts);
        }
      start = seconds ();
      must (celd_session_remove_stroke (session, 1000));
      time_labels (session);
      removed[i] = seconds () - start;
      celd_free (s.mask.data);
    }
  after = answer_of (c, session);
  if (memcmp (before.label, after.label, c->n * sizeof *before.label))
    fprintf (stderr, "warning: %s: strokes that were put and removed left a mark\n", method);
  snprintf (text, sizeof text, "%s stroke", method);
  print_number (text, median (time, n));
  snprintf (text, sizeof text, "%s stroke removed", method);
  print_number (text, median (removed, n));
  printf (",\n  \"%s worst stroke\": { \"seconds\": %.9g, \"x\": %d, \"y\": %d, \"length\": %.0f", method, worst,
          slowest.x, slowest.y, slowest.length);
  for (int i = 0; i < N_PARTS; i++)
    printf (", \"%s\": %.9g", part_name[i], parts[i]);
  printf (" }");
  snprintf (text, sizeof text, "%s stroke peak", method);
  print_number (text, (double) peak / (double) c->n);
  answer_clear (&before);
  answer_clear (&after);
  free (time);
  free (removed);
}

/* ------------------------------------------------------------------ the two methods */

/* First labels of a drawing of which there is only the line art, the reading of the scribbles apart, and memory; the
 * last session. */
static CeldSession *
measure_first (const Case *c, const char *method, const CeldSettings *settings, int runs)
{
  double       time[MOST_RUNS], read[MOST_RUNS];
  char         text[80];
  CeldSession *session = NULL;

  for (int i = 0; i < runs; i++)
    {
      Memory before;

      celd_session_free (session);
      session = open_session (c, settings);
      before  = memory_now ();
      memory_mark ();
      parts_reset ();
      time[i] = time_labels (session);
      read[i] = part_seconds[PART_READ];
      time[i] -= read[i];
      if (i == 0)
        print_memory (method, c, before, memory_now ());
    }
  snprintf (text, sizeof text, "%s first", method);
  print_number (text, median (time, runs));
  snprintf (text, sizeof text, "%s read", method);
  print_number (text, median (read, runs));
  return session;
}

/* All scribbles again for a drawing whose basins are there, the reading of them left out. */
static void
measure_again (const Case *c, CeldSession *session)
{
  CeldPaint  empty = { c->width, c->height, (size_t) c->width, calloc (4, c->n) };
  CeldLabels labels;
  double     time[MOST_RUNS], parts[N_PARTS][MOST_RUNS];

  if (!empty.data)
    must (CELD_NO_MEMORY);
  for (int i = 0; i < c->runs; i++)
    {
      must (celd_session_set_scribbles (session, &empty));
      (void) celd_session_labels (session, NULL, &labels, NULL);
      must (celd_session_set_scribbles (session, &c->scribbles));
      parts_reset ();
      time[i] = time_labels (session) - part_seconds[PART_READ];
      for (int k = 0; k < N_PARTS; k++)
        parts[k][i] = part_seconds[k];
    }
  print_number ("engine again", median (time, c->runs));
  for (int k = 0; k < N_PARTS; k++)
    {
      char text[80];

      snprintf (text, sizeof text, "engine again, %s", part_name[k]);
      print_number (text, median (parts[k], c->runs));
    }
  free (empty.data);
}

/* The problem that the exact method solved, with Boost. */
static void
measure_boost (const Case *c, const Costs *costs, const Answer *exact)
{
  CeldMultiway m = { problem.width, problem.height, problem.east, problem.south, problem.seed, problem.vote,
                     problem.order, problem.n_labels };
  uint32_t    *label = calloc (c->n, sizeof *label);
  Memory       before = memory_now ();
  double       start = seconds ();
  size_t       disobeyed;

  if (!label)
    must (CELD_NO_MEMORY);
  use_boost = true;
  memory_mark ();
  must (celd_multiway (&m, NULL, label));
  print_number ("boost first", seconds () - start);
  print_number ("boost peak", (double) (memory_now ().peak - before.live) / (double) c->n);
  use_boost = false;
  if (energy_of (costs, &problem, label, &disobeyed) != energy_of (costs, &problem, exact->label, &disobeyed))
    fprintf (stderr, "warning: Boost finds another energy than the exact method\n");
  if (memcmp (label, exact->label, c->n * sizeof *label))
    fprintf (stderr, "warning: Boost finds other labels than the exact method\n");
  free (label);
}

/* ------------------------------------------------------------------ all measurements */

/* The engine with all settings as they come: times, and its labels. */
static Answer
measure_engine (const Case *c)
{
  CeldSettings settings = celd_settings ();
  CeldSession *session = measure_first (c, "engine", &settings, c->runs);
  Answer       answer;

  measure_again (c, session);
  if (c->strokes)
    measure_strokes (c, "engine", c->strokes, session);
  answer = answer_of (c, session);
  celd_session_free (session);
  answer_keep (c, "default", &answer);
  return answer;
}

/* Labels, after n random strokes. */
static Answer
solve (const Case *c, const CeldSettings *settings, int n)
{
  CeldSession *session = open_session (c, settings);
  double       brush = brush_width (&c->scribbles);
  Answer       answer = answer_of (c, session);

  keep_problem = settings->method == CELD_METHOD_EXACT;
  for (int i = 0; i < n; i++)
    {
      Stroke s = random_stroke (c->width, c->height, &answer.palette, brush);

      must (celd_session_put_stroke (session, (uint32_t) i + 1, s.x, s.y, &s.mask, s.colour));
      celd_free (s.mask.data);
    }
  if (n)
    {
      answer_clear (&answer);
      answer = answer_of (c, session);
    }
  keep_problem = false;
  celd_session_free (session);
  return answer;
}

/* Exact cuts with soft strokes: times, and labels.  Keeps the problem. */
static Answer
measure_exact (const Case *c, const CeldSettings *settings, const Costs *costs)
{
  CeldSession *session;
  Answer       answer;

  keep_problem = true;
  session = measure_first (c, "exact", settings, 1);
  keep_problem = false;
  answer = answer_of (c, session);
  compare_costs (costs);
  if (c->exact_strokes)
    measure_strokes (c, "exact", c->exact_strokes, session);
  celd_session_free (session);
  if (c->boost)
    measure_boost (c, costs, &answer);
  answer_keep (c, "exact", &answer);
  return answer;
}

/* The engine and exact cuts with the same settings, after n random strokes. */
static void
compare_settings (const Case *c, const char *name, CeldSettings settings, int n, const CeldPlane *ink,
                  const Costs *costs)
{
  Answer engine, exact;
  char   text[80];

  settings.method = CELD_METHOD_BASINS;
  random_start ();
  engine = solve (c, &settings, n);
  settings.method = CELD_METHOD_EXACT;
  random_start ();
  exact = solve (c, &settings, n);
  compare_print (c, name, ink, costs, &engine, &exact);
  answer_keep (c, name, &engine);
  snprintf (text, sizeof text, "exact-%s", name);
  answer_keep (c, text, &exact);
  answer_clear (&engine);
  answer_clear (&exact);
}

/* Soft and hard strokes with what raises the energy by design turned off, also with random strokes among them; and soft
 * strokes with all of it. */
static void
compare_methods (const Case *c, const CeldPlane *ink, const Answer *engine)
{
  CeldSettings settings = celd_settings ();
  Costs        costs = costs_of (ink, settings.ink_threshold);
  Answer       plain, exact;

  settings.close_gaps = settings.keep_necks = false;
  plain = solve (c, &settings, 0);
  settings.method = CELD_METHOD_EXACT;
  exact = measure_exact (c, &settings, &costs);
  compare_print (c, "soft", ink, &costs, &plain, &exact);
  compare_print (c, "default", ink, &costs, engine, &exact);
  answer_keep (c, "soft", &plain);
  answer_clear (&plain);
  answer_clear (&exact);
  if (c->n <= MOST_MESSY)
    compare_settings (c, "messy", settings, MESS, ink, &costs);
  settings.hardness = 1;
  compare_settings (c, "hard", settings, 0, ink, &costs);
  if (c->n <= MOST_MESSY)
    compare_settings (c, "messy-hard", settings, MESS, ink, &costs);
  problem_clear ();
  free (costs.east);
  free (costs.south);
}

int
main (int argc, char **argv)
{
  Case         c = { 0 };
  CeldSettings settings = celd_settings ();
  CeldSession *session;
  CeldPlane    ink;
  Answer       engine;

  if (argc < 8)
    {
      fprintf (stderr, "usage: %s DRAWING SCRIBBLES TRUTH RUNS STROKES EXACT-STROKES BOOST [PREFIX]\n", argv[0]);
      return 2;
    }
  c.drawing.luma  = read_grey (argv[1]);
  c.width         = c.drawing.luma.width;
  c.height        = c.drawing.luma.height;
  c.n             = (size_t) c.width * (size_t) c.height;
  c.scribbles     = read_colours (argv[2], c.width, c.height);
  c.truth         = read_colours (argv[3], c.width, c.height);
  c.runs          = atoi (argv[4]) < 1 ? 1 : atoi (argv[4]) > MOST_RUNS ? MOST_RUNS : atoi (argv[4]);
  c.strokes       = atoi (argv[5]);
  c.exact_strokes = atoi (argv[6]);
  c.boost         = atoi (argv[7]) > 0;
  c.prefix        = argv[8];

  printf ("{ \"width\": %d, \"height\": %d", c.width, c.height);
  print_number ("brush", brush_width (&c.scribbles));
  measure_ink (&c);
  measure_coloured_ink (&c);
  session = open_session (&c, &settings);
  must (celd_session_ink (session, NULL, &ink, NULL));
  measure_basins (&c, &ink);
  engine = measure_engine (&c);
  if (c.exact_strokes >= 0)
    compare_methods (&c, &ink, &engine);
  answer_clear (&engine);
  printf (" }\n");
  celd_session_free (session);
  celd_free (c.drawing.luma.data);
  free (c.scribbles.data);
  free (c.truth.data);
  return 0;
}
