/* The name that was probably meant: the nearest one by Damerau-Levenshtein distance (optimal string alignment), or the
 * only one that ends in the word, after a hyphen.
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

/* The only name that is longer than the word by parts before it; NULL if there is none, or several. */
static const char *
longer_name (const char *word, const char *const *names)
{
  g_autofree char *end = g_strconcat ("-", word, NULL);
  const char      *found = NULL;

  for (; word[0] && *names; names++)
    if (g_str_has_suffix (*names, end))
      {
        if (found)
          return NULL;
        found = *names;
      }
  return found;
}

const char *
cli_nearest_name (const char *word, const char *const *names)
{
  const char *nearest = NULL;
  size_t      least = strlen (word) / 3 + 1; /* up to a third of the characters may be wrong */

  for (size_t i = 0; names[i]; i++)
    {
      size_t away = distance (word, names[i]);

      if (away < least)
        {
          least   = away;
          nearest = names[i];
        }
    }
  return nearest ? nearest : longer_name (word, names);
}
