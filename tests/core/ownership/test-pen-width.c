/* Widths of pens: how far a pen varies, as its own outline shows.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "blobs.h"
#include "ownership/ownership.h"

/* A disc whose pen varies by the share `vary` round it. */
static void
add_disc (Blobs *b, double x, double y, double radius, double pen, double vary)
{
  Blob disc;

  for (int i = 0; i < BLOB_CORNERS; i++)
    {
      double turn = 8 * atan (1) * i / BLOB_CORNERS;

      disc.x[i]     = x + radius * cos (turn);
      disc.y[i]     = y + radius * sin (turn);
      disc.width[i] = pen * (1 + vary * cos (turn));
    }
  blobs_draw (b, &disc);
}

/* The largest width of a label's pen; frees b. */
static double
max_width (Blobs *b, size_t label)
{
  CeldContourEdges edges = { 0 };
  CeldContourPens  pens = { 0 };
  double           width;

  CHECK (celd_contour_edges_new (&b->ink, NULL, &edges) == CELD_OK);
  CHECK (celd_contour_pens_new (&edges, &b->labels, b->level, b->n, &pens) == CELD_OK);
  width = pens.max_width[label - 1];
  celd_contour_pens_clear (&pens);
  celd_contour_edges_clear (&edges);
  blobs_free (b);
  return width;
}

/* Where a brush is widest its line is still its own, but for a twentieth of the width and the half pixel by which
 * measures may be off. */
static void
a_brush_is_known_where_it_is_widest (void)
{
  for (double pen = 8; pen <= 16; pen += 4)
    {
      Blobs b;

      blobs_new (260, 260, &b);
      add_disc (&b, 130.3, 130.2, 80, pen, 0.25);
      CHECK (1.05 * max_width (&b, 2) + 0.5 >= 1.25 * pen);
      blobs_new (260, 260, &b);
      add_disc (&b, 130.3, 130.2, 80, pen, 0);
      CHECK (max_width (&b, 2) <= 1.1 * pen);
    }
}

/* Along the outline of a small disc on the line of another one, the ink is mostly thicker than its pen, where both
 * lines meet, which says nothing of how its pen varies. */
static void
a_small_patch_shows_no_brush (void)
{
  for (int within = -24; within <= 24; within++)
    {
      Blobs b;

      blobs_new (260, 260, &b);
      add_disc (&b, 130.3, 130.2, 80, 24, 0);
      add_disc (&b, 210.3 - within, 130.2, 8, 10, 0);
      CHECK (max_width (&b, 3) <= 1.1 * 10);
    }
}

int
main (void)
{
  RUN (a_brush_is_known_where_it_is_widest);
  RUN (a_small_patch_shows_no_brush);
  return DONE;
}
