/* Takes and prints measurements.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "bench.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

double
seconds (void)
{
  struct timespec t;

  clock_gettime (CLOCK_PROCESS_CPUTIME_ID, &t);
  return (double) t.tv_sec + 1e-9 * (double) t.tv_nsec;
}

void
must (CeldStatus status)
{
  if (status == CELD_OK)
    return;
  fprintf (stderr, "%s\n", celd_status_text (status));
  exit (1);
}

static int
compare (const void *a, const void *b)
{
  double p = *(const double *) a, q = *(const double *) b;

  return p < q ? -1 : p > q;
}

double
median (double *value, int n)
{
  qsort (value, (size_t) n, sizeof *value, compare);
  return n % 2 ? value[n / 2] : (value[n / 2 - 1] + value[n / 2]) / 2;
}

void
print_number (const char *name, double value)
{
  printf (",\n  \"%s\": %.9g", name, value);
}

void
print_memory (const char *name, const Case *c, Memory before, Memory after)
{
  char   text[80];
  double labels = 4;            /* bytes a pixel of the result */

  snprintf (text, sizeof text, "%s kept", name);
  print_number (text, ((double) after.live - (double) before.live) / (double) c->n - labels);
  snprintf (text, sizeof text, "%s peak", name);
  print_number (text, ((double) after.peak - (double) before.live) / (double) c->n - labels);
}
