/* Measures the exact program on one drawing; and writes it down for other solvers.
 *
 *   bench-program DRAWING SCRIBBLES RELATIONS RUNS TOLERANCE [PREFIX]
 *
 * Prints one JSON object.  DRAWING has the size that is measured; SCRIBBLES are enlarged to it, RELATIONS is a file
 * with points of that size.  Times are medians of RUNS, in seconds of processor time.  PREFIX: weights (east, south),
 * the nodes of the pixels and the depth are kept in files, as plain numbers of four bytes.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "bench.h"
#include "depth/depth.h"

#include <stdio.h>
#include <stdlib.h>

#define MOST_RUNS 99

typedef struct
{
  CeldPlane     ink, depth;
  CeldLabels    seeds;
  CeldPalette   palette;
  CeldRelations relations;
  CeldSettings  settings;
} Page;

static Page
read_page (const char *drawing, const char *scribbles, const char *relations)
{
  CeldPlane   luma = read_grey (drawing);
  CeldPaint   paint = read_colours (scribbles, luma.width, luma.height);
  CeldDrawing whole = { .luma = luma };
  Page        page = { .settings = celd_settings () };
  char       *text = read_text (relations);

  page.settings.encoding = CELD_ENCODING_RANK;
  must (celd_plane_new (luma.width, luma.height, &page.ink));
  must (celd_plane_new (luma.width, luma.height, &page.depth));
  must (celd_labels_new (luma.width, luma.height, &page.seeds));
  must (celd_ink (&whole, CELD_INK_AUTO, NULL, &page.ink));
  must (celd_scribbles_read (&paint, &page.settings, NULL, &page.seeds, &page.palette));
  must (celd_relations_parse (text, &page.relations, NULL));
  celd_free (luma.data);
  free (paint.data);
  free (text);
  return page;
}

static void
page_clear (Page *page)
{
  celd_free (page->ink.data);
  celd_free (page->depth.data);
  celd_free (page->seeds.data);
  celd_palette_clear (&page->palette);
  celd_relations_clear (&page->relations);
}

/* ------------------------------------------------------------------ figures */

static CeldProgram *
open_program (const Page *page)
{
  CeldProgram *program = celd_program_new ();

  if (!program)
    must (CELD_NO_MEMORY);
  must (celd_program_set_ink (program, &page->ink, &page->settings, NULL));
  must (celd_program_set_seeds (program, &page->seeds, &page->palette, CELD_SAME_COLOUR_ONE, NULL));
  return program;
}

static void
solve (const Page *page, CeldProgram *program, CeldExact *exact)
{
  CeldPlane depth = page->depth;

  must (celd_program_solve (program, &page->relations, &page->settings, NULL, &depth, exact, NULL));
}

/* From the line art to the depth. */
static CeldProgram *
measure_cold (const Page *page, int runs, CeldExact *exact)
{
  CeldProgram *program = NULL;
  double       time[MOST_RUNS];

  for (int i = 0; i < runs; i++)
    {
      double start;

      celd_program_free (program);
      start   = seconds ();
      program = open_program (page);
      solve (page, program, exact);
      time[i] = seconds () - start;
    }
  print_number ("cold", median (time, runs));
  return program;
}

/* Another gap for one relation after the other. */
static void
measure_edits (Page *page, CeldProgram *program, CeldExact *exact)
{
  double time[MOST_RUNS];
  int    n = 0;

  for (size_t i = 0; i < page->relations.n && n < MOST_RUNS; i++, n++)
    {
      double start = seconds ();

      page->relations.item[i].gap = 2;
      solve (page, program, exact);
      time[n] = seconds () - start;
      page->relations.item[i].gap = 1;
    }
  if (n)
    print_number ("edit", median (time, n));
  solve (page, program, exact);
}

static uint32_t
node_at (CeldProgram *program, const CeldTerm *term)
{
  size_t pixel;

  return celd_program_find (program, term->x, term->y, &pixel) ? program->bases.node[pixel] : 0;
}

static void
print_inequalities (const Page *page, CeldProgram *program)
{
  const char *comma = "";

  printf (",\n  \"inequalities\": [");
  for (size_t i = 0; i < page->relations.n; i++)
    {
      uint32_t a = node_at (program, &page->relations.item[i].nearer),
               b = node_at (program, &page->relations.item[i].farther);

      if (a && b && a != b)
        {
          printf ("%s[%u, %u, %g]", comma, a, b, page->relations.item[i].gap);
          comma = ", ";
        }
    }
  printf ("]");
}

static void
keep (const char *prefix, const char *name, const void *data, size_t n)
{
  char  path[4096];
  FILE *file;

  snprintf (path, sizeof path, "%s%s", prefix, name);
  file = fopen (path, "wb");
  if (!file || fwrite (data, 4, n, file) != n || fclose (file))
    {
      fprintf (stderr, "%s: cannot be written\n", path);
      exit (1);
    }
}

int
main (int argc, char **argv)
{
  if (argc < 6)
    {
      fprintf (stderr, "usage: bench-program DRAWING SCRIBBLES RELATIONS RUNS TOLERANCE [PREFIX]\n");
      return 2;
    }

  Page         page = read_page (argv[1], argv[2], argv[3]);
  size_t       n = (size_t) page.ink.width * (size_t) page.ink.height;
  int          runs = atoi (argv[4]) < 1 ? 1 : atoi (argv[4]) > MOST_RUNS ? MOST_RUNS : atoi (argv[4]);
  CeldExact    exact = { 0 };
  CeldProgram *program;

  page.settings.tolerance = (float) atof (argv[5]);
  printf ("{\n  \"width\": %d,\n  \"height\": %d", page.ink.width, page.ink.height);
  program = measure_cold (&page, runs, &exact);
  measure_edits (&page, program, &exact);
  print_number ("nodes", program->bases.n);
  print_number ("energy", exact.energy);
  print_number ("violation", exact.violation);
  print_number ("rounds", exact.solve.iterations);
  print_number ("error", exact.solve.error);
  print_inequalities (&page, program);
  if (argc > 6)
    {
      keep (argv[6], "east", program->east, n);
      keep (argv[6], "south", program->south, n);
      keep (argv[6], "node", program->bases.node, n);
      keep (argv[6], "depth", page.depth.data, n);
    }
  printf ("\n}\n");
  celd_exact_clear (&exact);
  celd_program_free (program);
  page_clear (&page);
  return 0;
}
