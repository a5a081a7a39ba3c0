/* Unions of basins, coarser and coarser: merged basins, enclosures, components.
 *
 * The region that a person sees has many maxima, so it is many basins.  Passages between basins are visited from the
 * widest on.  Basins are merged over a passage unless both sides are clearly wider than it: corners and corridors join
 * their region, while a small region behind a gap stays separate, however large the picture.  A passage along the frame
 * separates nothing, as the page continues there.  Enclosures are merged basins joined over every passage wider than
 * two stroke widths, which is no gap in a contour.  Components are joined over any passage: connected paper.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/unions.h"
#include "segment/basin-steps.h"
#include "segment/basins.h"

#include <math.h>
#include <stdlib.h>

#define WIDER 1.25 /* times as wide as the passage, plus a pixel: clearly wider (chosen) */

/* The unions so far (unions.h), and the largest squared distance in each, by root. */
typedef struct { uint32_t *parent; int32_t *widest; } Unions;

static void
join (Unions *unions, uint32_t a, uint32_t b)
{
  int32_t *widest = unions->widest;

  a = celd_root (unions->parent, a);
  b = celd_root (unions->parent, b);
  widest[a] = widest[b] = widest[a] > widest[b] ? widest[a] : widest[b];
  celd_join (unions->parent, a, b);
}

static int32_t
width_of (const CeldBasinBoundary *boundary)
{
  return boundary->frame ? INT32_MAX : boundary->saddle;
}

/* The widest first; ties by number. */
static int
compare_widths (const void *a, const void *b)
{
  const CeldBasinBoundary *p = *(const CeldBasinBoundary *const *) a, *q = *(const CeldBasinBoundary *const *) b;

  if (width_of (p) != width_of (q))
    return width_of (p) > width_of (q) ? -1 : 1;
  if (p->a != q->a)
    return p->a < q->a ? -1 : 1;
  return p->b < q->b ? -1 : p->b > q->b;
}

static bool
separates (Unions *unions, const CeldBasinBoundary *boundary)
{
  int32_t a = unions->widest[celd_root (unions->parent, boundary->a)];
  int32_t b = unions->widest[celd_root (unions->parent, boundary->b)];

  return !boundary->frame && sqrt (a < b ? a : b) > WIDER * sqrt (boundary->saddle) + 1;
}

/* Numbers the unions from 1 by their first basins; unless `all`, solid ones get 0.  Returns how many there are. */
static size_t
number_unions (const CeldBasins *basins, Unions *unions, bool all, uint32_t *number)
{
  uint32_t n = 0;

  for (uint32_t k = 0; k < basins->n; k++)
    {
      uint32_t first = celd_root (unions->parent, k);

      number[k] = !all && basins->basin[k].solid ? 0 : first == k ? ++n : number[first];
    }
  return n;
}

/* Lists the boundaries over which basins may be merged, the widest first; returns their number. */
static size_t
find_passages (const CeldBasins *basins, const CeldBasinBoundary **passage)
{
  size_t n = 0;

  for (size_t i = 0; i < basins->n_boundaries; i++)
    {
      const CeldBasinBoundary *boundary = &basins->boundary[i];

      if (boundary->opening || (basins->basin[boundary->a].solid && basins->basin[boundary->b].solid))
        passage[n++] = boundary;
    }
  if (n)
    qsort (passage, n, sizeof *passage, compare_widths);
  return n;
}

CeldStatus
celd_basins_merge (CeldBasins *basins)
{
  Unions                    unions = { celd_alloc (basins->n, sizeof (uint32_t)),
                                       celd_alloc (basins->n, sizeof (int32_t)) };
  const CeldBasinBoundary **passage = celd_alloc (basins->n_boundaries, sizeof *passage);
  int32_t                   open = basins->stroke * basins->stroke;
  CeldStatus                status = CELD_NO_MEMORY;
  size_t                    n;

  basins->merged = celd_alloc (basins->n, sizeof *basins->merged);
  basins->enclosure = celd_alloc (basins->n, sizeof *basins->enclosure);
  basins->component = celd_alloc (basins->n, sizeof *basins->component);
  if (!unions.parent || !unions.widest || !passage || !basins->merged || !basins->enclosure || !basins->component)
    goto done;
  celd_roots (unions.parent, basins->n);
  for (uint32_t k = 0; k < basins->n; k++)
    unions.widest[k] = basins->basin[k].squared;
  n = find_passages (basins, passage);
  for (size_t i = 0; i < n; i++)
    if (!separates (&unions, passage[i]))
      join (&unions, passage[i]->a, passage[i]->b);
  basins->n_merged = number_unions (basins, &unions, true, basins->merged);
  for (size_t i = 0; i < n; i++)
    if (passage[i]->opening && width_of (passage[i]) > open)
      join (&unions, passage[i]->a, passage[i]->b);
  basins->n_enclosures = number_unions (basins, &unions, false, basins->enclosure);
  for (size_t i = 0; i < n; i++)
    if (passage[i]->opening)
      join (&unions, passage[i]->a, passage[i]->b);
  basins->n_components = number_unions (basins, &unions, false, basins->component);
  status = CELD_OK;

done:
  celd_free (unions.parent);
  celd_free (unions.widest);
  celd_free (passage);
  return status;
}
