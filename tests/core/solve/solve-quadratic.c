/* Solves the quadratic programs on stdin for test-quadratic.py.  A program is n, m, the n x n numbers of K and m times
 * a, b, gap; its answer is a line: status, energy, gap, violation, and u.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "solve/quadratic.h"

#include <stdio.h>
#include <stdlib.h>

/* False at the end of the input. */
static bool
answer_one (void)
{
  size_t          n, m;
  double         *k, *u;
  CeldInequality *one;
  CeldCertificate c = { 0 };
  bool            read = scanf ("%zu %zu", &n, &m) == 2;

  if (!read)
    return false;
  k = malloc ((n * n + 1) * sizeof *k);
  u = calloc (n + 1, sizeof *u);
  one = malloc ((m + 1) * sizeof *one);
  for (size_t i = 0; i < n * n; i++)
    read = read && scanf ("%lf", &k[i]) == 1;
  for (size_t i = 0; i < m; i++)
    read = read && scanf ("%u %u %lf", &one[i].a, &one[i].b, &one[i].gap) == 3;
  if (read)
    {
      CeldStatus status = celd_quadratic (n, k, m, one, u, NULL, &c);

      printf ("%d %.17g %.17g %.17g", (int) status, c.energy, c.gap, c.violation);
      for (size_t i = 0; i < n; i++)
        printf (" %.17g", u[i]);
      printf ("\n");
    }
  free (k);
  free (u);
  free (one);
  return read;
}

int
main (void)
{
  while (answer_one ())
    ;
  return 0;
}
