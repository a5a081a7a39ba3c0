/* Measures a session: the results that artists wait for, at first and after edits.
 *
 *   bench-session DRAWING SCRIBBLES RELATIONS STROKES
 *
 * Prints one JSON object.  DRAWING has the size that is measured; SCRIBBLES are enlarged to it, RELATIONS is a file
 * with points of that size.  STROKES random ones are painted and taken away again one after the other, then one
 * relation is added after the other.  Times are seconds of processor time, medians and the worst.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "bench.h"
#include "base/base.h"

#include <stdio.h>
#include <stdlib.h>

#define MOST 99
#define ID   1                  /* of the stroke or relation that comes and goes */

/* What is asked for, in this order: a preview, and the same in full. */
typedef CeldStatus Ask (CeldSession *session, const CeldHost *host, CeldPlane *plane);

static CeldStatus
ask_depth_preview (CeldSession *session, const CeldHost *host, CeldPlane *plane)
{
  return celd_session_depth_preview (session, host, plane, NULL);
}

static CeldStatus
ask_depth (CeldSession *session, const CeldHost *host, CeldPlane *plane)
{
  return celd_session_depth (session, host, plane, NULL);
}

static CeldStatus
ask_exact (CeldSession *session, const CeldHost *host, CeldPlane *plane)
{
  return celd_session_exact (session, host, plane, NULL);
}

static double
time_of (Ask *ask, CeldSession *session)
{
  double    start = seconds ();
  CeldPlane plane;

  must (ask (session, NULL, &plane));
  return seconds () - start;
}

/* Median and worst, as `name` and `name, worst`. */
static void
print_times (const char *name, double *time, int n)
{
  char worst[80];

  snprintf (worst, sizeof worst, "%s, worst", name);
  print_number (name, median (time, n));
  print_number (worst, time[n - 1]);
}

static CeldSession *
open_session (const CeldDrawing *drawing, const CeldPaint *scribbles, const char *relations)
{
  CeldSession *session = celd_session_new ();
  CeldSettings settings = celd_settings ();

  if (!session)
    must (CELD_NO_MEMORY);
  settings.tolerance = 1e-3f;
  must (celd_session_set_settings (session, &settings));
  must (celd_session_set_drawing (session, drawing));
  must (celd_session_set_scribbles (session, scribbles));
  must (celd_session_set_relations (session, relations, NULL));
  return session;
}

/* One stroke more, and the same one less; each is an edit. */
static void
measure_strokes (CeldSession *session, const CeldPaint *scribbles, int width, int height, int strokes)
{
  double brush = brush_width (scribbles), preview[MOST], full[MOST];
  int    n = 0;

  random_start ();
  time_of (ask_depth_preview, session);
  time_of (ask_depth, session);
  while (n + 1 < 2 * strokes && n + 1 < MOST)
    {
      Stroke s = random_stroke (width, height, celd_session_palette (session), brush);

      for (int painting = 1; painting >= 0; painting--, n++)
        {
          must (painting ? celd_session_put_stroke (session, ID, s.x, s.y, &s.mask, s.colour)
                         : celd_session_remove_stroke (session, ID));
          preview[n] = time_of (ask_depth_preview, session);
          full[n]    = time_of (ask_depth, session);
        }
      celd_free (s.mask.data);
    }
  if (n)
    {
      print_times ("depth preview", preview, n);
      print_times ("depth", full, n);
    }
}

/* The exact program from the start, and with a new gap for one relation after the other. */
static void
measure_exact (CeldSession *session, const char *relations)
{
  double        time[MOST], start = seconds ();
  int           n = 0;
  CeldPlane     half;
  CeldRelations all = { 0 };

  must (celd_session_exact_preview (session, NULL, &half));
  print_number ("exact preview", seconds () - start);
  print_number ("exact, after it", time_of (ask_exact, session));
  must (celd_relations_parse (relations, &all, NULL));
  for (size_t i = 0; i < all.n && n < MOST; i++, n++)
    {
      const CeldRelation *r = &all.item[i];
      char                text[200];

      snprintf (text, sizeof text, "%.3f,%.3f > %.3f,%.3f +2", r->nearer.x, r->nearer.y, r->farther.x, r->farther.y);
      start = seconds ();
      must (celd_session_put_relation (session, ID, text, NULL));
      time_of (ask_exact, session);
      time[n] = seconds () - start;
    }
  if (n)
    print_times ("exact edit", time, n);
  celd_relations_clear (&all);
}

int
main (int argc, char **argv)
{
  if (argc != 5)
    {
      fprintf (stderr, "usage: bench-session DRAWING SCRIBBLES RELATIONS STROKES\n");
      return 2;
    }

  CeldDrawing  drawing = { .luma = read_grey (argv[1]) };
  int          width = drawing.luma.width, height = drawing.luma.height;
  CeldPaint    scribbles = read_colours (argv[2], width, height);
  char        *relations = read_text (argv[3]);
  CeldSession *session = open_session (&drawing, &scribbles, relations);

  printf ("{\n  \"width\": %d,\n  \"height\": %d", width, height);
  measure_strokes (session, &scribbles, width, height, atoi (argv[4]));
  celd_session_free (session);
  session = open_session (&drawing, &scribbles, relations);
  measure_exact (session, relations);
  printf ("\n}\n");
  celd_session_free (session);
  celd_free (drawing.luma.data);
  free (scribbles.data);
  free (relations);
  return 0;
}
