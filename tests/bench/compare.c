/* Compares labels by basins with those of exact cuts, and both with the truth.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "bench.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The costs of the exact method, computed independently. */
void
compare_costs (const Costs *costs)
{
  size_t n = (size_t) problem.width * (size_t) problem.height;

  if (memcmp (costs->east, problem.east, n * sizeof *costs->east) ||
      memcmp (costs->south, problem.south, n * sizeof *costs->south))
    fprintf (stderr, "warning: the exact method has other costs than smoothness-costs.c\n");
}

static bool
same_colour (const uint8_t *a, const uint8_t *b)
{
  for (int i = 0; i < 3; i++)
    if (abs (a[i] - b[i]) > 2)
      return false;
  return true;
}

void
compare_print (const Case *c, const char *name, const CeldPlane *ink, const Costs *costs, const Answer *engine,
               const Answer *exact)
{
  size_t  white = 0, agree = 0, scored = 0, right = 0, exact_right = 0, disputed = 0, won = 0, lost = 0, disobeyed;
  size_t  exact_disobeyed;
  int64_t energy = energy_of (costs, &problem, engine->label, &disobeyed);
  int64_t least = energy_of (costs, &problem, exact->label, &exact_disobeyed);

  if (engine->palette.n != exact->palette.n)
    fprintf (stderr, "warning: %s: the methods have %zu and %zu labels\n", name, engine->palette.n, exact->palette.n);
  for (size_t p = 0; p < c->n; p++)
    {
      const uint8_t *a = engine->palette.item[engine->label[p] - 1].colour;
      const uint8_t *b = exact->palette.item[exact->label[p] - 1].colour, *truth = c->truth.data + 4 * p;
      bool           is_white = ink->data[p] > 0.5f, same = !memcmp (a, b, 4), known = truth[3] > 127;
      bool           a_right = known && same_colour (a, truth), b_right = known && same_colour (b, truth);

      white       += is_white;
      agree       += is_white && same;
      scored      += known;
      right       += a_right;
      exact_right += b_right;
      disputed    += known && !same;
      won         += a_right && !b_right;
      lost        += b_right && !a_right;
    }
  printf (",\n  \"%s\": { \"energy\": %.0f, \"exact energy\": %.0f, \"ratio\": %.6f, \"disobeyed\": %zu, "
          "\"exact disobeyed\": %zu, \"agreement\": %.6f, \"segment\": %.6f, \"exact segment\": %.6f, "
          "\"disputed\": %zu, \"engine right\": %zu, \"exact right\": %zu }", name, (double) energy, (double) least,
          (double) energy / (double) least, disobeyed, exact_disobeyed, (double) agree / (double) white,
          (double) right / (double) scored, (double) exact_right / (double) scored, disputed, won, lost);
}

void
answer_keep (const Case *c, const char *name, const Answer *answer)
{
  char  path[1024];
  FILE *file;

  if (!c->prefix)
    return;
  snprintf (path, sizeof path, "%s%s.pam", c->prefix, name);
  file = fopen (path, "wb");
  if (!file)
    must (CELD_NO_MEMORY);
  fprintf (file, "P7\nWIDTH %d\nHEIGHT %d\nDEPTH 4\nMAXVAL 255\nTUPLTYPE RGB_ALPHA\nENDHDR\n", c->width, c->height);
  for (size_t p = 0; p < c->n; p++)
    fwrite (answer->palette.item[answer->label[p] - 1].colour, 1, 4, file);
  fclose (file);
}

void
answer_clear (Answer *answer)
{
  free (answer->label);
  free (answer->palette.item);
  *answer = (Answer) { 0 };
}
