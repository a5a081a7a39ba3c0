/* Where paint lies in a basin of another label: the places that solve-windows.c solves on pixels.
 *
 * Runs of such misplaced paint that touch form a cluster.  A cluster's window is its bounding box with a margin: a
 * stroke gets only the part of a basin that lies near it, or it would have got the basin.  Windows that overlap become
 * one, unless only ink lies between their basins.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "image/image.h"
#include "segment/basins.h"
#include "segment/pixel-graph.h"
#include "segment/task.h"
#include "solve/maxflow.h"

#include <stdlib.h>
#include <string.h>

#define CLUSTER_MARGIN 8 /* pixels round a cluster, besides a stroke width and half its longer side (chosen) */

/* A run of seeds in a basin of another label. */
typedef struct { int32_t y, x, end; uint32_t label, basin; } MisplacedRun;

typedef struct { CeldWindow box; bool wanted; } PaintCluster;

typedef struct
{
  const CeldSegmentTask *task;
  const uint32_t        *label;      /* of each basin */
  size_t                 hint;
  MisplacedRun          *run;        /* in reading order */
  size_t                 n_runs;
  uint32_t              *cluster_of; /* of each run: a disjoint-set forest (base/base.h), in the end its cluster */
  PaintCluster          *cluster;
  size_t                 n_clusters;
  uint32_t              *group;      /* of each basin: a disjoint-set forest of groups */
  size_t                 run_capacity;
} WindowSearch;

/* ------------------------------------------------------------------ misplaced paint */

size_t
celd_basin_run_at (const CeldBasins *basins, int y, int x, size_t *hint)
{
  size_t first = basins->row[y], last = basins->row[y + 1] - 1;
  size_t i = first + *hint < last ? first + *hint : last;

  while (basins->run[i].x > x)
    i--;
  while (i < last && basins->run[i + 1].x <= x)
    i++;
  *hint = i - first;
  return i;
}

static CeldStatus
add_run (WindowSearch *search, MisplacedRun run)
{
  return celd_append (search->run, search->n_runs, search->run_capacity, run);
}

static CeldStatus
compare_seeds (WindowSearch *search, int y, const CeldSeedRun *seeds)
{
  const CeldBasins *basins = search->task->basins;
  CeldStatus        status = CELD_OK;
  size_t            i = celd_basin_run_at (basins, y, seeds->x, &search->hint);

  for (int x = seeds->x, end; x < seeds->end && status == CELD_OK; x = end, i++)
    {
      uint32_t basin = basins->run[i].basin;

      end = i + 1 < basins->row[y + 1] ? basins->run[i + 1].x : basins->width;
      end = end < seeds->end ? end : seeds->end;
      if (search->label[basin] != seeds->label)
        status = add_run (search, (MisplacedRun) { y, x, end, seeds->label, basin });
    }
  return status;
}

static CeldStatus
find_runs (WindowSearch *search)
{
  const CeldSeedRows *seeds = &search->task->seeds;
  CeldStatus          status = CELD_OK;

  for (int y = 0; y < seeds->height && status == CELD_OK; y++)
    for (size_t i = 0; i < seeds->row[y].n && status == CELD_OK; i++)
      status = compare_seeds (search, y, &seeds->row[y].run[i]);
  return status;
}

/* ------------------------------------------------------------------ clusters */

/* Joins runs that touch, in one row or in two, also by a corner. */
static void
join_runs (WindowSearch *search)
{
  const MisplacedRun *run = search->run;
  size_t              above = 0; /* no run before it touches run i, or a later one */

  celd_roots (search->cluster_of, search->n_runs);
  for (size_t i = 1; i < search->n_runs; i++)
    {
      if (run[i - 1].y == run[i].y && run[i - 1].end == run[i].x)
        celd_join (search->cluster_of, (uint32_t) i - 1, (uint32_t) i);
      while (run[above].y < run[i].y - 1 || (run[above].y == run[i].y - 1 && run[above].end < run[i].x))
        above++;
      for (size_t k = above; run[k].y < run[i].y && run[k].x <= run[i].end; k++)
        celd_join (search->cluster_of, (uint32_t) k, (uint32_t) i);
    }
}

static void
widen (CeldWindow *box, const CeldWindow *other)
{
  box->left   = box->left < other->left ? box->left : other->left;
  box->top    = box->top < other->top ? box->top : other->top;
  box->right  = box->right > other->right ? box->right : other->right;
  box->bottom = box->bottom > other->bottom ? box->bottom : other->bottom;
}

/* Numbers the clusters by their first runs, which are their roots. */
static CeldStatus
number_clusters (WindowSearch *search)
{
  const MisplacedRun *run = search->run;
  uint32_t           *cluster_of;

  search->cluster    = celd_alloc (search->n_runs, sizeof *search->cluster);
  search->cluster_of = cluster_of = celd_alloc (search->n_runs, sizeof *cluster_of);
  if (!search->cluster || !cluster_of)
    return CELD_NO_MEMORY;
  join_runs (search);
  for (size_t i = 0; i < search->n_runs; i++)
    {
      CeldWindow box = { run[i].x, run[i].y, run[i].end - 1, run[i].y, 0, 0, 0 };
      bool       root = cluster_of[i] == i;

      cluster_of[i] = root ? (uint32_t) search->n_clusters : cluster_of[cluster_of[i]];
      if (root)
        search->cluster[search->n_clusters++] = (PaintCluster) { box, false };
      widen (&search->cluster[cluster_of[i]].box, &box);
    }
  return CELD_OK;
}

/* ------------------------------------------------------------------ which clusters need a window */

/* Hard seeds are obeyed wherever they lie; soft seeds on ink alone would change nothing visible. */
static void
select_clusters (WindowSearch *search)
{
  for (size_t i = 0; i < search->n_runs; i++)
    {
      const MisplacedRun *run = &search->run[i];
      bool               *wanted = &search->cluster[search->cluster_of[i]].wanted;

      *wanted = *wanted || celd_task_data_cost (search->task, run->label) == CELD_HARD;
      for (int x = run->x; x < run->end && !*wanted; x++)
        *wanted = celd_is_paper (CELD_AT (search->task->ink, x, run->y));
    }
}

/* ------------------------------------------------------------------ groups of basins */

/* Groups the basins with misplaced paint: those joined by paper or by a cluster.  With only ink between them they can
 * be solved independently. */
static CeldStatus
group_basins (WindowSearch *search)
{
  const CeldBasins *basins = search->task->basins;
  bool             *foreign = celd_alloc0 (basins->n, sizeof *foreign);
  uint32_t         *first = celd_alloc (search->n_clusters, sizeof *first); /* a basin of each cluster */

  search->group = celd_alloc (basins->n, sizeof *search->group);
  if (!foreign || !first || !search->group)
    {
      celd_free (foreign);
      celd_free (first);
      return CELD_NO_MEMORY;
    }
  celd_roots (search->group, basins->n);
  for (size_t i = search->n_runs; i-- > 0;)
    first[search->cluster_of[i]] = search->run[i].basin;
  for (size_t i = 0; i < search->n_runs; i++)
    {
      foreign[search->run[i].basin] = true;
      celd_join (search->group, first[search->cluster_of[i]], search->run[i].basin);
    }
  for (size_t i = 0; i < basins->n_boundaries; i++)
    if (basins->boundary[i].opening && foreign[basins->boundary[i].a] && foreign[basins->boundary[i].b])
      celd_join (search->group, basins->boundary[i].a, basins->boundary[i].b);
  celd_free (foreign);
  celd_free (first);
  return CELD_OK;
}

/* ------------------------------------------------------------------ windows */

static void
add_margin (const CeldBasins *basins, CeldWindow *box)
{
  int w = box->right - box->left, h = box->bottom - box->top;
  int margin = CLUSTER_MARGIN + basins->stroke + (w > h ? w : h) / 2;

  box->left   = box->left > margin ? box->left - margin : 0;
  box->top    = box->top > margin ? box->top - margin : 0;
  box->right  = box->right < basins->width - 1 - margin ? box->right + margin : basins->width - 1;
  box->bottom = box->bottom < basins->height - 1 - margin ? box->bottom + margin : basins->height - 1;
}

static bool
overlap (const CeldWindow *a, const CeldWindow *b)
{
  return a->left <= b->right && b->left <= a->right && a->top <= b->bottom && b->top <= a->bottom;
}

static int
compare_windows (const void *a, const void *b)
{
  const CeldWindow *p = a, *q = b;

  if (p->group != q->group)
    return p->group < q->group ? -1 : 1;
  if (p->top != q->top)
    return p->top < q->top ? -1 : 1;
  return p->left < q->left ? -1 : p->left > q->left;
}

/* In this order of windows: can q, or one after it, overlap p? */
static bool
may_overlap (const CeldWindow *p, const CeldWindow *q)
{
  return q->group == p->group && q->top <= p->bottom;
}

/* Unites overlapping windows of a group until none overlap; united windows are larger and may overlap others. */
static void
merge (CeldWindows *windows)
{
  CeldWindow *item = windows->item;

  for (bool again = true; again;)
    {
      size_t n = 0;

      again = false;
      qsort (item, windows->n, sizeof *item, compare_windows);
      for (size_t i = 0; i < windows->n; i++)
        {
          if (item[i].left > item[i].right)
            continue; /* is part of another one */
          for (size_t j = i + 1; j < windows->n && may_overlap (&item[i], &item[j]); j++)
            if (item[j].left <= item[j].right && overlap (&item[i], &item[j]))
              {
                widen (&item[i], &item[j]);
                item[j].left = INT32_MAX;
                item[j].right = 0;
                again = true;
              }
          item[n++] = item[i];
        }
      windows->n = n;
    }
}

/* The index of the window of a run's group that contains it; windows->n: none. */
static size_t
window_of (const WindowSearch *search, const CeldWindows *windows, const MisplacedRun *run)
{
  uint32_t group = celd_root (search->group, run->basin);
  size_t   low = 0, high = windows->n;

  while (low < high)
    {
      size_t middle = low + (high - low) / 2;

      if (windows->item[middle].group < group)
        low = middle + 1;
      else
        high = middle;
    }
  for (; low < windows->n && windows->item[low].group == group; low++)
    if (windows->item[low].left <= run->x && run->x <= windows->item[low].right && windows->item[low].top <= run->y
        && run->y <= windows->item[low].bottom)
      return low;
  return windows->n;
}

/* Lists the basins with misplaced paint by window. */
static CeldStatus
list_basins (WindowSearch *search, CeldWindows *windows)
{
  uint32_t *last = celd_alloc0 (search->task->basins->n, sizeof *last); /* of each basin: its last window, from 1 */
  size_t   *begin = celd_alloc0 (windows->n + 1, sizeof *begin);
  size_t    n = 0;

  windows->basin = celd_alloc (search->n_runs, sizeof *windows->basin);
  if (!last || !begin || !windows->basin)
    {
      celd_free (last);
      celd_free (begin);
      return CELD_NO_MEMORY;
    }
  for (size_t i = 0; i < search->n_runs; i++)
    {
      search->cluster_of[i] = (uint32_t) window_of (search, windows, &search->run[i]); /* clusters */
      begin[search->cluster_of[i]]++;
    }
  for (size_t k = 0; k < windows->n; k++)
    {
      size_t runs = begin[k];

      begin[k] = n;
      n += runs;
    }
  for (size_t i = 0; i < search->n_runs; i++)
    if (search->cluster_of[i] < windows->n)
      windows->basin[begin[search->cluster_of[i]]++] = search->run[i].basin;
  n = 0;
  for (size_t k = 0, i = 0; k < windows->n; k++)
    {
      windows->item[k].first = n;
      for (; i < begin[k]; i++)
        if (last[windows->basin[i]] != k + 1)
          {
            last[windows->basin[i]] = (uint32_t) k + 1;
            windows->basin[n++] = windows->basin[i];
          }
      windows->item[k].n = n - windows->item[k].first;
    }
  celd_free (last);
  celd_free (begin);
  return CELD_OK;
}

static CeldStatus
make_windows (WindowSearch *search, CeldWindows *windows)
{
  windows->item = celd_alloc (search->n_clusters, sizeof *windows->item);
  if (!windows->item)
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < search->n_runs; i++)
    {
      PaintCluster *cluster = &search->cluster[search->cluster_of[i]];

      if (!cluster->wanted)
        continue;
      windows->item[windows->n] = cluster->box;
      windows->item[windows->n].group = celd_root (search->group, search->run[i].basin);
      add_margin (search->task->basins, &windows->item[windows->n++]);
      cluster->wanted = false;
    }
  merge (windows);
  return list_basins (search, windows);
}

/* ------------------------------------------------------------------ the whole */

void
celd_windows_clear (CeldWindows *windows)
{
  celd_free (windows->item);
  celd_free (windows->basin);
  *windows = (CeldWindows) { 0 };
}

CeldStatus
celd_windows_find (const CeldSegmentTask *task, const uint32_t *label, const CeldHost *host, CeldWindows *windows)
{
  WindowSearch search = { .task = task, .label = label };
  CeldWindows  found = { 0 };
  CeldStatus   status = find_runs (&search);

  if (status == CELD_OK && search.n_runs)
    status = number_clusters (&search);
  if (status == CELD_OK && search.n_runs)
    {
      select_clusters (&search);
      status = group_basins (&search);
    }
  if (status == CELD_OK && search.n_runs)
    status = make_windows (&search, &found);
  if (status == CELD_OK)
    status = celd_progress (host, 0);
  if (status == CELD_OK)
    *windows = found;
  else
    celd_windows_clear (&found);
  celd_free (search.run);
  celd_free (search.cluster);
  celd_free (search.cluster_of);
  celd_free (search.group);
  return status;
}
