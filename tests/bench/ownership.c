/* Measures contour ownership of one drawing: from scratch, and in a session after single edits.
 *
 *   bench-ownership DRAWING SCRIBBLES RELATIONS RUNS EDITS
 *
 * Prints one JSON object.  DRAWING has the size that is measured; SCRIBBLES are enlarged to it, RELATIONS is a file
 * with points of that size.  Times are medians of RUNS, and median and worst of EDITS, in seconds of processor time;
 * labels, order and reading a layer are made before the clock starts.  Memory: bytes a pixel.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "bench.h"
#include "image/image.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MOST_RUNS 999

typedef struct
{
  CeldSession  *session;
  CeldSettings  settings;
  CeldPlane     ink;
  CeldPaint     scribbles, corrections;
  CeldLabels    labels;
  CeldPalette   palette;
  CeldRelations relations;
  size_t        pixels;
} Page;

static Page
read_page (const char *drawing, const char *scribbles, const char *relations)
{
  Page      page = { .session = celd_session_new (), .settings = celd_settings () };
  CeldPlane luma = read_grey (drawing);
  char     *text = read_text (relations);

  if (!page.session)
    must (CELD_NO_MEMORY);
  page.scribbles   = read_colours (scribbles, luma.width, luma.height);
  page.corrections = (CeldPaint) { luma.width, luma.height, (size_t) luma.width,
                                   calloc ((size_t) luma.width * (size_t) luma.height, 4) };
  if (!page.corrections.data)
    must (CELD_NO_MEMORY);
  must (celd_session_set_drawing (page.session, &(CeldDrawing) { .luma = luma }));
  must (celd_session_set_scribbles (page.session, &page.scribbles));
  must (celd_relations_parse (text, &page.relations, NULL));
  for (size_t i = 0; i < page.relations.n; i++)
    {
      CeldRelation *r = &page.relations.item[i];
      char          line[200];

      snprintf (line, sizeof line, "%.17g,%.17g > %.17g,%.17g", r->nearer.x, r->nearer.y, r->farther.x, r->farther.y);
      must (celd_session_put_relation (page.session, (uint32_t) i + 1, line, NULL));
    }
  must (celd_session_ink (page.session, NULL, &page.ink, NULL));
  page.pixels = (size_t) luma.width * (size_t) luma.height;
  celd_free (luma.data);
  free (text);
  return page;
}

static void
page_clear (Page *page)
{
  celd_session_free (page->session);
  celd_relations_clear (&page->relations);
  free (page->scribbles.data);
  free (page->corrections.data);
}

/* ------------------------------------------------------------------ from scratch */

static void
measure_whole (const Page *page, const char *name, CeldExpansion method, int runs)
{
  const CeldOrder *order;
  CeldLabels       labels;
  CeldOwnership    own;
  double           time[MOST_RUNS];
  Memory           before, after;
  char             text[80];

  must (celd_session_labels (page->session, NULL, &labels, NULL));
  must (celd_session_order (page->session, NULL, &order));
  before = memory_now ();
  memory_mark ();
  must (celd_ownership_new (labels.width, labels.height, &own));
  for (int i = 0; i < runs; i++)
    {
      double start = seconds ();

      must (celd_own (&page->ink, NULL, &labels, order->level, order->n, NULL, method, NULL, &own));
      time[i] = seconds () - start;
    }
  after = memory_now ();
  print_number (name, median (time, runs));
  snprintf (text, sizeof text, "%s peak", name);
  print_number (text, (double) (after.peak - before.live) / (double) page->pixels);
  celd_ownership_clear (&own);
}

/* ------------------------------------------------------------------ in a session */

/* Whether the session's ownership equals one made from scratch. */
static void
compare_with_whole (const Page *page, const CeldLabels *corrections)
{
  const CeldOrder *order;
  CeldLabels       labels;
  CeldOwnership    own, whole;
  size_t           size = page->pixels * sizeof (uint32_t);

  must (celd_session_ownership (page->session, NULL, &own, NULL));
  must (celd_session_labels (page->session, NULL, &labels, NULL));
  must (celd_session_order (page->session, NULL, &order));
  must (celd_ownership_new (labels.width, labels.height, &whole));
  must (celd_own (&page->ink, NULL, &labels, order->level, order->n, corrections, page->settings.expansion, NULL, &whole));
  if (memcmp (own.owner.data, whole.owner.data, size) || memcmp (own.under.data, whole.under.data, size) ||
      memcmp (own.coverage.data, whole.coverage.data, size))
    {
      fprintf (stderr, "after an edit the session has other owners than from the beginning\n");
      exit (1);
    }
  celd_ownership_clear (&whole);
}

/* Of ownership alone, after an edit. */
static double
time_edit (const Page *page)
{
  const CeldOrder *order;
  CeldOwnership    own;
  double           start;

  must (celd_session_order (page->session, NULL, &order));
  start = seconds ();
  must (celd_session_ownership (page->session, NULL, &own, NULL));
  return seconds () - start;
}

static void
print_edits (const char *name, double *time, int n)
{
  double middle = median (time, n); /* sorts */
  char   text[80];

  print_number (name, middle);
  snprintf (text, sizeof text, "%s worst", name);
  print_number (text, time[n - 1]);
}

static void
measure_strokes (const Page *page, int edits)
{
  const CeldPalette *palette = celd_session_palette (page->session);
  double             time[2 * MOST_RUNS], brush = brush_width (&page->scribbles);

  random_start ();
  for (int i = 0; i < edits; i++)
    {
      Stroke stroke = random_stroke (page->ink.width, page->ink.height, palette, brush);

      must (celd_session_put_stroke (page->session, 1, stroke.x, stroke.y, &stroke.mask, stroke.colour));
      time[2 * i] = time_edit (page);
      compare_with_whole (page, NULL);
      must (celd_session_remove_stroke (page->session, 1));
      time[2 * i + 1] = time_edit (page);
      celd_free (stroke.mask.data);
    }
  compare_with_whole (page, NULL);
  print_edits ("stroke", time, 2 * edits);
}

/* Each relation taken away, and back. */
static void
measure_relations (const Page *page, int edits)
{
  double time[2 * MOST_RUNS];
  int    n = 0;

  for (size_t i = 0; i < page->relations.n && n < 2 * edits; i++)
    {
      const CeldRelation *r = &page->relations.item[i];
      char                line[200];

      snprintf (line, sizeof line, "%.17g,%.17g > %.17g,%.17g", r->nearer.x, r->nearer.y, r->farther.x, r->farther.y);
      must (celd_session_remove_relation (page->session, (uint32_t) i + 1));
      time[n++] = time_edit (page);
      compare_with_whole (page, NULL);
      must (celd_session_put_relation (page->session, (uint32_t) i + 1, line, NULL));
      time[n++] = time_edit (page);
    }
  compare_with_whole (page, NULL);
  if (n)
    print_edits ("relation", time, n);
}

/* A dot of a region's colour on ink, one more each time. */
static void
measure_corrections (Page *page, int edits)
{
  const CeldPalette *palette = celd_session_palette (page->session);
  CeldLabels         read;
  double             time[MOST_RUNS];
  uint32_t           place = 12345;

  must (celd_labels_new (page->ink.width, page->ink.height, &read));
  for (int i = 0; i < edits; i++)
    {
      size_t p;

      do
        {
          place = place * 1664525 + 1013904223;
          p     = (size_t) ((uint64_t) place * page->pixels >> 32);
        }
      while (celd_is_paper (page->ink.data[p]));
      memcpy (page->corrections.data + 4 * p, palette->item[(size_t) i % palette->n].colour, 3);
      page->corrections.data[4 * p + 3] = 255;
      must (celd_session_set_corrections (page->session, &page->corrections));
      time[i] = time_edit (page);
    }
  must (celd_corrections_read (&page->corrections, palette, &read));
  compare_with_whole (page, &read);
  print_edits ("correction", time, edits);
  must (celd_session_set_corrections (page->session, NULL));
  celd_free (read.data);
}

int
main (int argc, char **argv)
{
  Page page;
  int  runs, edits;

  if (argc != 6)
    {
      fprintf (stderr, "usage: bench-ownership DRAWING SCRIBBLES RELATIONS RUNS EDITS\n");
      return 2;
    }
  runs  = atoi (argv[4]) < 1 ? 1 : atoi (argv[4]) > MOST_RUNS ? MOST_RUNS : atoi (argv[4]);
  edits = atoi (argv[5]) > MOST_RUNS ? MOST_RUNS : atoi (argv[5]);
  page  = read_page (argv[1], argv[2], argv[3]);
  printf ("{\n  \"pixels\": %zu", page.pixels);
  measure_whole (&page, "outlines", CELD_EXPANSION_OUTLINES, runs);
  measure_whole (&page, "thickness", CELD_EXPANSION_THICKNESS, runs);
  print_number ("regions", (double) celd_session_palette (page.session)->n);
  if (edits > 0)
    {
      Memory before = memory_now (), after;

      memory_mark ();
      compare_with_whole (&page, NULL);
      after = memory_now ();
      print_number ("kept", (double) (after.live - before.live) / (double) page.pixels);
      print_number ("peak", (double) (after.peak - before.live) / (double) page.pixels);
      measure_strokes (&page, edits);
      measure_relations (&page, edits);
      measure_corrections (&page, edits);
    }
  printf ("\n}\n");
  page_clear (&page);
  return 0;
}
