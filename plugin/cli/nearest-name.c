/* The name that was probably meant: the nearest one by Damerau-Levenshtein distance (optimal string alignment).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

#include <string.h>

#define LONGEST 40 /* characters; longer words are like no name */

/* How many characters must be inserted, removed, replaced or exchanged with the next one. */
static size_t
distance (const char *a, const char *b)
{
  size_t n = strlen (a), m = strlen (b), d[LONGEST + 1][LONGEST + 1];

  if (n > LONGEST || m > LONGEST)
    return G_MAXSIZE;
  for (size_t i = 0; i <= n; i++)
    for (size_t k = 0; k <= m; k++)
      {
        d[i][k] = MAX (i, k);
        if (!i || !k)
          continue;
        d[i][k] = MIN (MIN (d[i - 1][k], d[i][k - 1]) + 1, d[i - 1][k - 1] + (a[i - 1] != b[k - 1]));
        if (i > 1 && k > 1 && a[i - 1] == b[k - 2] && a[i - 2] == b[k - 1])
          d[i][k] = MIN (d[i][k], d[i - 2][k - 2] + 1);
      }
  return d[n][m];
}

const char *
cli_nearest_name (const char *word, const char *const *names)
{
  const char *nearest = NULL;
  size_t      least = strlen (word) / 3 + 1; /* up to a third of the characters may be wrong */

  for (; *names; names++)
    {
      size_t away = distance (word, *names);

      if (away < least)
        {
          least   = away;
          nearest = *names;
        }
    }
  return nearest;
}
