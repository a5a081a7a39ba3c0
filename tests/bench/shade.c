/* Measures normals and shading, in milliseconds of processor time per megapixel, from ink and levels of a drawing.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "bench.h"
#include "base/base.h"

#include <stdio.h>
#include <stdlib.h>

#define MOST_RUNS 99

/* The expanded levels; owned by the session, which is left open until the program ends. */
static void
make_levels (const char *const *path, CeldPlane *ink, CeldPlane *levels)
{
  CeldDrawing  drawing = { .luma = read_grey (path[0]) };
  CeldPaint    scribbles = read_colours (path[1], drawing.luma.width, drawing.luma.height);
  char        *relations = read_text (path[2]);
  CeldSession *session = celd_session_new ();

  must (session ? CELD_OK : CELD_NO_MEMORY);
  must (celd_session_set_drawing (session, &drawing));
  must (celd_session_set_scribbles (session, &scribbles));
  must (celd_session_set_relations (session, relations, NULL));
  must (celd_session_ink (session, NULL, ink, NULL));
  must (celd_session_levels (session, NULL, levels, NULL));
  free (relations);
  celd_free (scribbles.data);
  celd_free (drawing.luma.data);
}

int
main (int argc, char **argv)
{
  if (argc != 5)
    {
      fprintf (stderr, "usage: bench-shade DRAWING SCRIBBLES RELATIONS RUNS\n");
      return 2;
    }

  CeldPlane    ink, levels, shading;
  CeldVectors  normals;
  CeldSettings settings = celd_settings ();
  double       time[2][MOST_RUNS], start, megapixels;
  int          runs = atoi (argv[4]) < 1 ? 1 : atoi (argv[4]) > MOST_RUNS ? MOST_RUNS : atoi (argv[4]);

  make_levels ((const char *const *) argv + 1, &ink, &levels);
  megapixels = (double) ink.width * (double) ink.height / 1e6;
  normals    = (CeldVectors) { ink.width, ink.height, (size_t) ink.width,
                               celd_alloc ((size_t) ink.width * (size_t) ink.height, 3 * sizeof (float)) };
  must (normals.data ? celd_plane_new (ink.width, ink.height, &shading) : CELD_NO_MEMORY);
  for (int run = 0; run < runs; run++)
    {
      start = seconds ();
      must (celd_normals (&ink, &levels, &settings, NULL, &normals));
      time[0][run] = seconds () - start;
      start        = seconds ();
      must (celd_shade (&normals, &settings, &shading));
      time[1][run] = seconds () - start;
    }
  printf ("{\n  \"pixels\": %.0f", 1e6 * megapixels);
  print_number ("normals", 1000 * median (time[0], runs) / megapixels);
  print_number ("shading", 1000 * median (time[1], runs) / megapixels);
  printf ("\n}\n");
  celd_free (shading.data);
  celd_free (normals.data);
  return 0;
}
