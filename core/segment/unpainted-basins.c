/* Basins without paint: which label they get.
 *
 * The energy gives a node without paint to the label with the longest border, through a thick outline rather than a
 * pinch.  So these are cut once more, with the labels of all others given: they go over the weakest barrier, or, if a
 * pinch has cut them off in a drawing with lines of a pixel, to the region that they are part of (pinches.c).  Where
 * no paper leads to paint, a bridge is a weaker barrier than any ink: nobody drew it (bridge-joins.c).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "segment/basins.h"
#include "segment/bridges.h"
#include "segment/task.h"
#include "solve/partition.h"

#include <stdlib.h>

#define OUTLINE_SHARE    16 /* an outline towards the background counts 1 / so much as a barrier (chosen) */
#define PASSAGE_WEAKNESS (1 << 20) /* of a pixel of a bridge as a barrier: as 1024 of the thinnest line, and far less
                                    * than paper without a bridge (chosen) */
#define NARROW_WEAKNESS  (1 << 12) /* the same in a narrow gap: as 4 of the thinnest line (chosen) */

typedef struct
{
  const CeldSegmentTask *task;
  const uint32_t        *node;    /* of basin k */
  const uint32_t        *fixed;   /* of node k: its label if it has paint, or 0 */
  CeldPinch             *pinch;
  CeldPassage           *passage;
  bool                  *mouth;   /* of boundary i: a passage in it is the mouth of a bay */
  size_t                 n_pinches, n_passages;
} Barriers;

/* ------------------------------------------------------------------ ways besides boundaries */

/* Marks the boundaries in which bays open. */
static CeldStatus
mark_mouths (Barriers *g)
{
  const CeldBasins *basins = g->task->basins;

  g->mouth = celd_alloc0 (basins->n_boundaries, sizeof *g->mouth);
  if (!g->mouth)
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < g->n_passages; i++)
    {
      const CeldPassage       *p = &g->passage[i];
      CeldBasinBoundary        key = { .a = p->a < p->b ? p->a : p->b, .b = p->a < p->b ? p->b : p->a };
      const CeldBasinBoundary *found;

      if (!p->mouth)
        continue;
      found = bsearch (&key, basins->boundary, basins->n_boundaries, sizeof key, celd_basin_boundary_compare);
      if (found)
        g->mouth[found - basins->boundary] = true;
    }
  return CELD_OK;
}

/* Finds the pinches of nodes that are not fixed, and the passages of all. */
static CeldStatus
find_ways (Barriers *g)
{
  const CeldBasins *basins = g->task->basins;
  bool             *wanted = celd_alloc (basins->n, sizeof *wanted);
  CeldStatus        status = wanted ? CELD_OK : CELD_NO_MEMORY;

  for (size_t k = 0; k < basins->n && wanted; k++)
    wanted[k] = !g->fixed[g->node[k]];
  if (status == CELD_OK)
    status = celd_pinches_find (g->task->ink, basins, wanted, &g->pinch, &g->n_pinches);
  celd_free (wanted);
  if (status == CELD_OK && g->task->bridges)
    status = celd_bridges_find_passages (g->task->bridges, g->task->ink, basins, &g->passage, &g->n_passages);
  return status == CELD_OK && g->n_passages ? mark_mouths (g) : status;
}

/* ------------------------------------------------------------------ how weak barriers are */

/* Is the background on one side? */
static bool
meets_background (const Barriers *g, uint32_t a, uint32_t b)
{
  uint32_t p = g->fixed[g->node[a]], q = g->fixed[g->node[b]];

  return (p && g->task->palette.item[p - 1].background) || (q && g->task->palette.item[q - 1].background);
}

/* How weak boundary i is as a barrier.  Closed lines towards the background are taken to be outlines: an unpainted part
 * inside one is rather a piece of the figure that the artist forgot. */
static int64_t
barrier_weakness (const Barriers *g, size_t i)
{
  const CeldBasinBoundary *b = &g->task->basins->boundary[i];
  bool                     open = b->opening || (g->mouth && g->mouth[i]);

  return meets_background (g, b->a, b->b) && !open ? b->weakness / OUTLINE_SHARE : b->weakness;
}

/* How much weaker a boundary is by a passage.  What opens to the background by more than a narrow gap may still be a
 * gap in an outline, unless it is the mouth of a bay; over a narrow gap between two other parts the line goes on. */
static int64_t
passage_weakness (const Barriers *g, const CeldPassage *passage)
{
  if (meets_background (g, passage->a, passage->b) && !passage->mouth)
    return passage->narrow ? 0 : PASSAGE_WEAKNESS / OUTLINE_SHARE;
  return passage->narrow ? NARROW_WEAKNESS : PASSAGE_WEAKNESS;
}

/* Lists all of them between nodes: boundaries, pinches and passages; returns their number. */
static size_t
list_barriers (const Barriers *g, CeldLink *link)
{
  const CeldBasins *basins = g->task->basins;
  size_t            n = 0;

  for (size_t i = 0; i < basins->n_boundaries; i++)
    link[n++] = (CeldLink) { g->node[basins->boundary[i].a], g->node[basins->boundary[i].b], barrier_weakness (g, i) };
  for (size_t i = 0; i < g->n_pinches; i++)
    link[n++] = (CeldLink) { g->node[g->pinch[i].a], g->node[g->pinch[i].b], g->pinch[i].weakness };
  for (size_t i = 0; i < g->n_passages; i++)
    link[n++] = (CeldLink) { g->node[g->passage[i].a], g->node[g->passage[i].b],
                             passage_weakness (g, &g->passage[i]) };
  return n;
}

/* ------------------------------------------------------------------ the whole */

CeldStatus
celd_unpainted_solve (const CeldSegmentTask *task, const uint32_t *node, size_t n, const uint32_t *fixed,
                      const uint32_t *order, const CeldHost *host, uint32_t *label)
{
  Barriers   g = { .task = task, .node = node, .fixed = fixed };
  CeldStatus status = find_ways (&g);
  size_t     most = task->basins->n_boundaries + g.n_pinches + g.n_passages;
  CeldLink  *listed = celd_alloc (most, sizeof *listed), *link = celd_alloc (most, sizeof *link);

  if (!listed || !link)
    status = CELD_NO_MEMORY;
  if (status == CELD_OK)
    {
      CeldPartition problem = { .n = n, .link = link, .fixed = fixed, .order = order, .n_labels = task->palette.n };

      status = celd_links_sum (n, listed, list_barriers (&g, listed), link, &problem.n_links);
      if (status == CELD_OK)
        status = celd_partition (&problem, host, label, NULL, NULL);
    }
  celd_free (listed);
  celd_free (link);
  celd_free (g.pinch);
  celd_free (g.passage);
  celd_free (g.mouth);
  return status;
}
