/* The two methods that label every pixel without basins, and keep nothing between strokes.
 *
 * LazyBrush [SDC09b] (section 3.2) as published: the energy of multiway.c with the costs of smoothness-costs.c.
 *
 * Random walker [Gra06], with which the paper compares LazyBrush: a pixel gets the label that a random walker starting
 * there most likely reaches first.  The probabilities are the harmonic bases of the exact program, on the same weights
 * (affinity.c): one set-up of the Laplacian solver and one solution for each label but one, CELD_LANES at a time.  Only
 * the best label so far and the sum are kept.  Every seed is obeyed; across a gap in a contour the boundary lies where
 * walkers reach both sides with equal probability.
 *
 * Cost: LazyBrush takes a second per megapixel and more; a random walker a solution per label, seconds for a megapixel,
 * and 50 bytes a pixel besides the solver's.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "segment/task.h"
#include "solve/laplace.h"
#include "solve/maxflow.h"

#include <string.h>

#define WALKER_TOLERANCE 1e-3 /* of probabilities */

/* ------------------------------------------------------------------ LazyBrush on all pixels */

/* V_pq of all pairs, as celd_multiway needs them. */
static CeldStatus
weigh_edges (const CeldSegmentTask *task, const CeldHost *host, int32_t *east, int32_t *south)
{
  const CeldPlane           *ink = task->ink;
  const CeldSmoothnessCosts *costs = &task->basins->costs;
  int                        w = ink->width, h = ink->height;
  int32_t                   *to_paper = celd_alloc ((size_t) w * (size_t) h, sizeof *to_paper);
  size_t                     p = 0;
  CeldStatus                 status = to_paper ? celd_distance_to_paper (ink, host, to_paper) : CELD_NO_MEMORY;

  for (int y = 0; y < h && status == CELD_OK; y++)
    for (int x = 0; x < w; x++, p++)
      {
        float here = CELD_AT (ink, x, y);

        east[p] = south[p] = 0;
        if (x + 1 < w)
          east[p] = celd_smoothness_cost (costs, here, CELD_AT (ink, x + 1, y), to_paper[p], to_paper[p + 1], y == 0 ||
                                          y + 1 == h);
        if (y + 1 < h)
          south[p] = celd_smoothness_cost (costs, here, CELD_AT (ink, x, y + 1), to_paper[p], to_paper[p + (size_t) w],
                                           x == 0 || x + 1 == w);
      }
  celd_free (to_paper);
  return status;
}

CeldStatus
celd_lazybrush_solve (const CeldSegmentTask *task, const CeldHost *host, CeldLabels *labels)
{
  size_t       n = (size_t) labels->width * (size_t) labels->height, n_labels = task->palette.n;
  int32_t     *east = celd_alloc (n, sizeof *east), *south = celd_alloc (n, sizeof *south);
  int32_t     *cost = celd_alloc (n_labels, sizeof *cost);
  uint32_t    *order = celd_alloc (n_labels, sizeof *order);
  CeldLabels   seeds = { 0 };
  CeldHostPart part[2];
  CeldHost     weigh = celd_host_part (&part[0], host, 0, 0), cut = celd_host_part (&part[1], host, 0.1, 1);
  CeldStatus   status = east && south && cost && order ? CELD_OK : CELD_NO_MEMORY;

  if (status == CELD_OK)
    status = celd_labels_new (labels->width, labels->height, &seeds);
  if (status == CELD_OK)
    status = weigh_edges (task, &weigh, east, south);
  if (status == CELD_OK)
    status = celd_task_label_order (task, order);
  if (status == CELD_OK)
    {
      CeldMultiway m = { labels->width, labels->height, east, south, seeds.data, cost, order, n_labels };

      celd_seed_rows_write (&task->seeds, &seeds);
      for (size_t k = 0; k < n_labels; k++)
        cost[k] = celd_task_data_cost (task, (uint32_t) k + 1);
      memset (labels->data, 0, n * sizeof *labels->data);
      status = celd_multiway (&m, &cut, labels->data);
    }
  celd_free (east);
  celd_free (south);
  celd_free (cost);
  celd_free (order);
  celd_free (seeds.data);
  return status;
}

/* ------------------------------------------------------------------ random walker */

typedef struct
{
  size_t    n;                  /* pixels */
  uint32_t *seed;               /* label of each pixel; 0: none */
  uint32_t *label;              /* the labels that have seeds */
  size_t    n_labels;
  float    *east, *south;
  float    *lane;               /* CELD_LANES probabilities a pixel */
  float    *best, *sum;         /* largest probability and sum, over all but the first label */
} Walker;

static void
walker_clear (Walker *w)
{
  celd_free (w->seed);
  celd_free (w->label);
  celd_free (w->east);
  celd_free (w->south);
  celd_free (w->lane);
  celd_free (w->best);
  celd_free (w->sum);
}

/* Reads the seeds into a plane, and lists the labels that have any. */
static CeldStatus
read_seeds (const CeldSegmentTask *task, Walker *w)
{
  int        width = task->ink->width, height = task->ink->height;
  CeldLabels seeds = { 0 };
  bool      *used = celd_alloc0 (task->palette.n + 1, sizeof *used);
  CeldStatus status = celd_labels_new (width, height, &seeds);

  w->seed  = seeds.data;
  w->label = celd_alloc (task->palette.n, sizeof *w->label);
  if (status == CELD_OK && used && w->label)
    {
      celd_seed_rows_write (&task->seeds, &seeds);
      for (size_t p = 0; p < w->n; p++)
        used[w->seed[p]] = true;
      for (uint32_t k = 1; k <= task->palette.n; k++)
        if (used[k])
          w->label[w->n_labels++] = k;
      if (!w->n_labels)
        w->label[w->n_labels++] = 1;
    }
  else
    status = CELD_NO_MEMORY;
  celd_free (used);
  return status;
}

static CeldStatus
walker_new (const CeldSegmentTask *task, const CeldHost *host, Walker *w)
{
  const CeldSettings *settings = task->settings;
  double              mean;
  CeldStatus          status;

  *w        = (Walker) { .n = (size_t) task->ink->width * (size_t) task->ink->height };
  w->east  = celd_alloc (w->n, sizeof *w->east);
  w->south = celd_alloc (w->n, sizeof *w->south);
  w->lane  = celd_alloc (w->n, CELD_LANES * sizeof *w->lane);
  w->best  = celd_alloc0 (w->n, sizeof *w->best);
  w->sum   = celd_alloc0 (w->n, sizeof *w->sum);
  status   = w->east && w->south && w->lane && w->best && w->sum ? read_seeds (task, w) : CELD_NO_MEMORY;
  if (status == CELD_OK)
    status = celd_affinities (task->ink, settings->contrast, settings->weight_floor, host, w->east, w->south, &mean);
  if (status != CELD_OK)
    walker_clear (w);
  return status;
}

static CeldStatus
set_up (const CeldSegmentTask *task, const Walker *w, const CeldHost *host, CeldLaplace **laplace)
{
  uint8_t   *fixed = celd_alloc (w->n, 1);
  CeldStatus status = CELD_NO_MEMORY;

  for (size_t p = 0; fixed && p < w->n; p++)
    fixed[p] = w->seed[p] != 0;
  if (fixed)
    status = celd_lap_setup (task->ink->width, task->ink->height, w->east, w->south, NULL, fixed, host, laplace);
  celd_free (fixed);
  return status;
}

/* Starts the solutions of the labels from number `first` on with their seeds. */
static void
start_lanes (Walker *w, size_t first)
{
  for (size_t p = 0; p < w->n; p++)
    for (size_t k = 0; k < CELD_LANES; k++)
      w->lane[p * CELD_LANES + k] = first + k < w->n_labels && w->seed[p] == w->label[first + k];
}

static void
keep_best (Walker *w, size_t first, uint32_t *label)
{
  for (size_t p = 0; p < w->n; p++)
    for (size_t k = 0; k < CELD_LANES && first + k < w->n_labels; k++)
      {
        float likely = w->lane[p * CELD_LANES + k];

        w->sum[p] += likely;
        if (likely > w->best[p])
          {
            w->best[p] = likely;
            label[p]   = w->label[first + k];
          }
      }
}

CeldStatus
celd_random_walker_solve (const CeldSegmentTask *task, const CeldHost *host, CeldLabels *labels)
{
  Walker       w;
  CeldLaplace *laplace = NULL;
  CeldHostPart part;
  CeldHost     weighing = celd_host_part (&part, host, 0, 0.05);
  CeldStatus   status = walker_new (task, &weighing, &w);

  if (status != CELD_OK)
    return status;
  if (w.n_labels > 1)
    {
      CeldHost setting_up = celd_host_part (&part, host, 0.05, 0.15);

      status = set_up (task, &w, &setting_up, &laplace);
    }
  for (size_t p = 0; p < w.n; p++)
    labels->data[p] = w.label[0];
  for (size_t first = 1; first < w.n_labels && status == CELD_OK; first += CELD_LANES)
    {
      double   share = 0.85 / (double) (w.n_labels - 1), from = 0.15 + share * (double) (first - 1);
      double   to = from + share * CELD_LANES;
      CeldHost solving = celd_host_part (&part, host, from, to < 1 ? to : 1);

      start_lanes (&w, first);
      status = celd_lap_solve_lanes (laplace, NULL, w.lane, WALKER_TOLERANCE, &solving, NULL);
      keep_best (&w, first, labels->data);
    }
  for (size_t p = 0; p < w.n; p++)
    if (!w.seed[p] && 1 - w.sum[p] >= w.best[p])
      labels->data[p] = w.label[0];
  for (size_t p = 0; p < w.n; p++)
    if (w.seed[p])
      labels->data[p] = w.seed[p];
  celd_lap_free (laplace);
  walker_clear (&w);
  return status;
}
