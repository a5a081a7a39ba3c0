/* Measures views from the side on one drawing: see README.md.
 *
 *   bench-stereo DRAWING SCRIBBLES RELATIONS RUNS
 *
 * Prints one JSON object.  DRAWING has the size that is measured; SCRIBBLES are enlarged to it, RELATIONS is a file
 * with points of that size.  Times are medians of RUNS, in seconds of processor time.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "bench.h"
#include "base/base.h"

#include <stdio.h>
#include <stdlib.h>

#define MOST_RUNS 99

typedef struct
{
  CeldPlane     ink, depth;
  CeldOwnership own;
  CeldColours   art, view[2];
  CeldLayers   *layers;
  CeldSettings  settings;
} Page;

static CeldColours
new_colours (const CeldPlane *like)
{
  size_t      n = (size_t) like->width * (size_t) like->height;
  CeldColours colours = { like->width, like->height, (size_t) like->width, celd_alloc (n, 4 * sizeof (float)) };

  must (colours.data ? CELD_OK : CELD_NO_MEMORY);
  return colours;
}

/* The drawing as white paper and black ink. */
static CeldColours
art_of (const CeldPlane *luma)
{
  CeldColours art = new_colours (luma);

  for (size_t i = 0; i < 4 * (size_t) luma->width * (size_t) luma->height; i++)
    art.data[i] = i % 4 == 3 ? 1 : luma->data[i / 4];
  return art;
}

/* The session stays, because it lends depth and owners. */
static CeldSession *
open_page (char **files, Page *page)
{
  CeldPlane    luma = read_grey (files[0]);
  CeldPaint    scribbles = read_colours (files[1], luma.width, luma.height);
  CeldDrawing  drawing = { .luma = luma };
  CeldSession *session = celd_session_new ();
  char        *text = read_text (files[2]);
  double       start;

  must (session ? CELD_OK : CELD_NO_MEMORY);
  *page = (Page) { .settings = celd_settings () };
  page->settings.complete = true;
  must (celd_session_set_settings (session, &page->settings));
  must (celd_session_set_drawing (session, &drawing));
  must (celd_session_set_scribbles (session, &scribbles));
  must (celd_session_set_relations (session, text, NULL));
  must (celd_session_ink (session, NULL, &page->ink, NULL));
  must (celd_session_depth (session, NULL, &page->depth, NULL));
  must (celd_session_ownership (session, NULL, &page->own, NULL));
  page->art     = art_of (&luma);
  page->view[0] = new_colours (&luma);
  page->view[1] = new_colours (&luma);
  start = seconds ();
  must (celd_session_layers (session, &page->art, CELD_STORE_FLOAT, NULL, &page->layers));
  printf ("{\n  \"pixels\": %zu", (size_t) luma.width * (size_t) luma.height);
  print_number ("layers", (double) celd_layers_count (page->layers));
  print_number ("cut", seconds () - start);
  celd_free (luma.data);
  free (scribbles.data);
  free (text);
  return session;
}

/* Makes a scene, of depth alone or of layers, and looks at it with both eyes; then once from elsewhere. */
static void
measure (Page *page, bool alone, int runs)
{
  double time[3][MOST_RUNS];

  for (int i = 0; i < runs; i++)
    {
      CeldScene *scene = NULL;
      double     start = seconds ();

      must (alone ? celd_scene_of_depth (&page->art, &page->ink, &page->depth, &page->settings, NULL, &scene)
                  : celd_scene_of_layers (page->layers, &page->own, &page->depth, NULL, &scene));
      time[0][i] = seconds () - start;
      start      = seconds ();
      for (int eye = 0; eye < 2; eye++)
        must (celd_scene_view (scene, celd_camera_eye (2 * eye - 1), &page->settings, NULL, &page->view[eye]));
      time[1][i] = seconds () - start;
      start      = seconds ();
      if (!alone)
        must (celd_scene_view (scene, (CeldCamera) { 0.6, 0.5, 1 }, &page->settings, NULL, &page->view[0]));
      time[2][i] = seconds () - start;
      celd_scene_free (scene);
    }
  print_number (alone ? "alone, scene" : "scene", median (time[0], runs));
  print_number (alone ? "alone, pair" : "pair", median (time[1], runs));
  if (!alone)
    print_number ("both ways", median (time[2], runs));
}

static void
measure_glasses (Page *page, int runs)
{
  CeldColours joined = new_colours (&page->depth);
  double      time[MOST_RUNS];

  for (int i = 0; i < runs; i++)
    {
      double start = seconds ();

      must (celd_stereo_join (&page->view[0], &page->view[1], CELD_STEREO_DUBOIS, &joined));
      time[i] = seconds () - start;
    }
  print_number ("glasses", median (time, runs));
  celd_free (joined.data);
}

int
main (int argc, char **argv)
{
  if (argc != 5)
    {
      fprintf (stderr, "usage: bench-stereo DRAWING SCRIBBLES RELATIONS RUNS\n");
      return 2;
    }

  Page         page;
  CeldSession *session = open_page (argv + 1, &page);
  int          runs = atoi (argv[4]) < 1 ? 1 : atoi (argv[4]) > MOST_RUNS ? MOST_RUNS : atoi (argv[4]);

  measure (&page, false, runs);
  measure (&page, true, runs);
  measure_glasses (&page, runs);
  printf ("\n}\n");
  celd_layers_free (page.layers);
  celd_session_free (session);
  celd_free (page.art.data);
  celd_free (page.view[0].data);
  celd_free (page.view[1].data);
  return 0;
}
