/* Gaps that hold depth in the exact program: pixel edges at which a gap in the ink lies between two regions get the
 * least weight, as if there were ink.
 *
 * Regions are those of a segmentation by the scribbles.  Which of their boundaries are gaps, held-gaps.c decides.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "depth/depth.h"
#include "image/image.h"

/* The gaps that are being found. */
typedef struct
{
  CeldDepthEdges edges;
  float         *level;         /* the regions, as numbers that differ */
  uint8_t       *cut;
  CeldHeldEdge  *item;
  size_t         n, capacity;
} ExactGaps;

/* Lists the edges that are cut though neither of their pixels is ink. */
static CeldStatus
list_gaps (ExactGaps *g)
{
  size_t         w = (size_t) g->edges.ink->width, n = w * (size_t) g->edges.ink->height;
  CeldDepthEdges inked = { g->edges.ink, g->edges.threshold, 0, NULL };
  CeldStatus     status = CELD_OK;

  for (size_t p = 0; p < n && status == CELD_OK; p++)
    for (int down = 0; g->cut[p] && down < 2 && status == CELD_OK; down++)
      if (g->cut[p] & CELD_CUT (down) &&
          celd_discontinuity_weight (&inked, (int) (p % w), (int) (p / w), !down, down) > 0)
        status = celd_append (g->item, g->n, g->capacity, ((CeldHeldEdge) { p, down, 0 }));
  return status;
}

static CeldStatus
find_gaps (ExactGaps *g, const CeldLabels *regions, const CeldPlane *borders, CeldGapLength longest, const CeldHost *host)
{
  size_t     n = (size_t) regions->width * (size_t) regions->height;
  CeldStatus status;

  g->level = celd_alloc (n, sizeof *g->level);
  g->cut   = celd_alloc (n, sizeof *g->cut);
  if (!g->level || !g->cut)
    return CELD_NO_MEMORY;
  for (size_t p = 0; p < n; p++)
    g->level[p] = (float) regions->data[p];
  status = celd_gaps_hold (&g->edges, borders, g->level, longest, host, g->cut);
  return status == CELD_OK ? list_gaps (g) : status;
}

static float *
weight_of (const CeldProgram *p, const CeldHeldEdge *edge)
{
  return (edge->down ? p->south : p->east) + edge->pixel;
}

/* Replaces the gaps of the program; those before get back their weights. */
static void
exchange_gaps (CeldProgram *p, ExactGaps *g, float least)
{
  bool same = p->n_held == g->n;

  for (size_t i = 0; i < p->n_held; i++)
    *weight_of (p, &p->held[i]) = p->held[i].weight;
  for (size_t i = 0; i < g->n; i++)
    {
      float *weight = weight_of (p, &g->item[i]);

      same = same && p->held[i].pixel == g->item[i].pixel && p->held[i].down == g->item[i].down;
      g->item[i].weight = *weight;
      *weight = least;
    }
  celd_free (p->held);
  p->stale  = p->stale || !same;
  p->held   = g->item;
  p->n_held = g->n;
  g->item   = NULL;
}

CeldStatus
celd_program_hold_gaps (CeldProgram *program, const CeldLabels *regions, const CeldPlane *borders,
                        const CeldSettings *settings, const CeldHost *host)
{
  ExactGaps  gaps = { .edges = { program->ink, settings->ink_threshold, 0, NULL } };
  CeldStatus status = CELD_OK;

  if (program->stroke < 0)
    program->stroke = celd_stroke_width (program->ink);
  gaps.edges.radius = celd_edge_radius (program->stroke);
  if (regions)
    status = find_gaps (&gaps, regions, borders,
                        celd_longest_gap (program->stroke, program->ink->width, program->ink->height), host);
  if (status == CELD_OK)
    exchange_gaps (program, &gaps, settings->weight_floor);
  celd_free (gaps.level);
  celd_free (gaps.cut);
  celd_free (gaps.item);
  return status;
}
