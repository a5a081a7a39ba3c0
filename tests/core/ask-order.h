/* Orders in short, for tests: text art, relations with letters for points, levels as digits.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef ASK_ORDER_H
#define ASK_ORDER_H

#include "check.h"

static const char *const PARTS[] = { /* six regions, the last one is the background where a test says so */
  "AABBCCDDEEFF",
  "AABBCCDDEEFF",
  NULL
};

/* A palette of n labels of the colours #010101 .. , the last one background if `background`. */
static inline CeldPalette
palette_of (size_t n, bool background)
{
  CeldPalette palette = { calloc (n, sizeof (CeldRegion)), n };

  for (size_t k = 0; k < n; k++)
    palette.item[k] = (CeldRegion) { .colour = { (uint8_t) (10 * k + 10), 0, 0, 255 }, .x = (int) (2 * k), .y = 1 };
  palette.item[n - 1].background = background;
  return palette;
}

typedef struct { CeldOrder order; CeldProblems problems; CeldRelations relations; CeldStatus status; } Answer;

/* Orders `rows` by relations in short: capital letters stand for points in the regions of PARTS. */
static inline Answer
ask (const char *const *rows, const CeldPalette *palette, const char *relations, const CeldPlane *ink)
{
  CeldLabels labels = art_labels (rows);
  Answer     a      = { .status = CELD_OK };
  char       text[2000], *end = text;

  for (const char *c = relations; *c; c++)
    if (*c >= 'A' && *c <= 'Z')
      end += sprintf (end, "%d.5,0.5", 2 * (*c - 'A'));
    else
      *end++ = *c;
  *end = 0;
  CHECK (celd_relations_parse (text, &a.relations, NULL) == CELD_OK);
  a.status = celd_order (&labels, palette, &a.relations, ink, NULL, NULL, &a.order, &a.problems);
  CHECK (a.status == CELD_OK && a.order.n == palette->n);
  free (labels.data);
  return a;
}

static inline void
forget (Answer *a)
{
  celd_order_clear (&a->order);
  celd_problems_clear (&a->problems);
  celd_relations_clear (&a->relations);
}

/* The levels of all labels as digits. */
static inline bool
levels_are (const Answer *a, const char *wanted)
{
  char     got[64] = "";
  uint32_t most    = 0;

  for (size_t k = 0; k < a->order.n; k++)
    {
      got[k] = (char) ('0' + a->order.level[k]);
      if (a->order.level[k] > most)
        most = a->order.level[k];
    }
  if (strcmp (got, wanted) != 0 || a->order.levels != most + 1)
    fprintf (stderr, "levels %s (%u), wanted %s\n", got, a->order.levels, wanted);
  return strcmp (got, wanted) == 0 && a->order.levels == most + 1;
}

/* Is contradiction i this cycle of n relations? */
static inline bool
cycle_is (const Answer *a, size_t i, size_t n, const size_t *wanted)
{
  return i < a->order.n_cycles && a->order.cycle[i].n == n &&
         memcmp (a->order.cycle[i].item, wanted, n * sizeof *wanted) == 0;
}

#endif
