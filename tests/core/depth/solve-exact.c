/* Solves the scenes on stdin for test-exact-program.py.  A scene is width, height, weight floor, the ink, the label of
 * each pixel, and relations as "x y x y gap" after their number, a gap of 0 for an equality.  Its answer is a line:
 * status, energy, gap, violation, the weights to the right and down of each pixel, the number of nodes with x, y and
 * depth of each, and the depth of each pixel.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"

#include <stdio.h>
#include <stdlib.h>

static void
print_plane (const float *value, int n)
{
  for (int i = 0; i < n; i++)
    printf (" %.9g", (double) value[i]);
}

/* Solves and prints; labels 1 .. most. */
static void
answer (const CeldPlane *ink, const CeldLabels *seeds, size_t most, const CeldRelations *relations, float floor)
{
  int          w = ink->width, h = ink->height;
  float       *plane = calloc ((size_t) (3 * w * h), sizeof *plane);
  CeldPlane    depth = { w, h, (size_t) w, plane };
  CeldPalette  palette = { calloc (most + 1, sizeof (CeldRegion)), most };
  CeldSettings settings = celd_settings ();
  CeldExact    exact = { 0 };
  double       mean;
  int          status;

  settings.encoding     = CELD_ENCODING_RANK;
  settings.tolerance    = 1e-7f;
  settings.weight_floor = floor;
  status = (int) celd_depth_exact (ink, seeds, &palette, relations, &settings, NULL, &depth, &exact, NULL);
  celd_affinities (ink, settings.contrast, floor, NULL, plane + w * h, plane + 2 * w * h, &mean);
  printf ("%d %.17g %.17g %.17g", status, exact.energy, exact.gap, exact.violation);
  print_plane (plane + w * h, 2 * w * h);
  printf (" %zu", exact.n);
  for (size_t k = 0; k < exact.n; k++)
    printf (" %d %d %.17g", exact.node[k].x, exact.node[k].y, exact.node[k].depth);
  print_plane (plane, w * h);
  printf ("\n");
  celd_exact_clear (&exact);
  celd_palette_clear (&palette);
  free (plane);
}

/* False at the end of the input. */
static bool
answer_one (void)
{
  int           w, h;
  float         floor;
  size_t        n, m, most = 0;
  CeldRelations relations = { 0 };
  float        *ink;
  uint32_t     *label;
  bool          read = scanf ("%d %d %f", &w, &h, &floor) == 3;

  if (!read)
    return false;
  n     = (size_t) (w * h);
  ink   = malloc (n * sizeof *ink);
  label = malloc (n * sizeof *label);
  for (size_t i = 0; i < n; i++)
    read = read && scanf ("%f", &ink[i]) == 1;
  for (size_t i = 0; i < n; i++)
    {
      read = read && scanf ("%u", &label[i]) == 1;
      most = read && label[i] > most ? label[i] : most;
    }
  read = read && scanf ("%zu", &m) == 1;
  for (size_t i = 0; read && i < m; i++)
    {
      CeldRelation r = { .weight = 1 };

      read = scanf ("%lf %lf %lf %lf %lf", &r.nearer.x, &r.nearer.y, &r.farther.x, &r.farther.y, &r.gap) == 5;
      r.equal = r.gap == 0;
      read = read && celd_relation_add (&relations, r) == CELD_OK;
    }
  if (read)
    answer (&(CeldPlane) { w, h, (size_t) w, ink }, &(CeldLabels) { w, h, (size_t) w, label }, most, &relations, floor);
  celd_relations_clear (&relations);
  free (ink);
  free (label);
  return read;
}

int
main (void)
{
  while (answer_one ())
    ;
  return 0;
}
