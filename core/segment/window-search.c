/* Where paint lies in a basin of another label: the places that windows.c looks at pixel by pixel.
 *
 * Runs of such foreign paint that touch are a clump.  A clump's window is its box with room around: an artist's stroke
 * gets no more of a basin than lies near it, or it would have got the basin.  Windows that overlap are one, unless only
 * ink is between their basins.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/unions.h"
#include "image/image.h"
#include "segment/basins.h"
#include "segment/canvas.h"
#include "segment/windows.h"
#include "solve/maxflow.h"

#include <stdlib.h>
#include <string.h>

#define ROOM 8                  /* pixels round the foreign paint, besides a stroke's width and half the longer side */

/* A run of paint in a basin of another label. */
typedef struct { int32_t y, x, end; uint32_t label, basin; } Run;

typedef struct { CeldWindow box; bool open; } Clump;

typedef struct
{
  const CeldCanvas *canvas;
  const uint32_t   *label;      /* of each basin */
  size_t            hint;
  Run              *run;        /* in reading order */
  size_t            n_runs;
  uint32_t         *clump_of;   /* of each run: a set of unions.h, in the end its number */
  Clump            *clump;
  size_t            n_clumps;
  uint32_t         *family;     /* of each basin: another one of its family, or itself */
} Places;

/* ------------------------------------------------------------------ foreign paint */

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
add_run (Places *places, Run run)
{
  Run *runs = celd_grow (places->run, places->n_runs + 1, sizeof *runs);

  if (!runs)
    return CELD_NO_MEMORY;
  places->run = runs;
  runs[places->n_runs++] = run;
  return CELD_OK;
}

static CeldStatus
compare_seeds (Places *places, int y, const CeldSeedRun *seeds)
{
  const CeldBasins *basins = places->canvas->basins;
  CeldStatus        status = CELD_OK;
  size_t            i = celd_basin_run_at (basins, y, seeds->x, &places->hint);

  for (int x = seeds->x, end; x < seeds->end && status == CELD_OK; x = end, i++)
    {
      uint32_t basin = basins->run[i].basin;

      end = i + 1 < basins->row[y + 1] ? basins->run[i + 1].x : basins->width;
      end = end < seeds->end ? end : seeds->end;
      if (places->label[basin] != seeds->label)
        status = add_run (places, (Run) { y, x, end, seeds->label, basin });
    }
  return status;
}

static CeldStatus
find_runs (Places *places)
{
  const CeldSeedRows *seeds = &places->canvas->seeds;
  CeldStatus          status = CELD_OK;

  for (int y = 0; y < seeds->height && status == CELD_OK; y++)
    for (size_t i = 0; i < seeds->row[y].n && status == CELD_OK; i++)
      status = compare_seeds (places, y, &seeds->row[y].run[i]);
  return status;
}

/* ------------------------------------------------------------------ clumps */

/* Joins runs that touch, in one row or in two, be it by a corner. */
static void
join_runs (Places *places)
{
  const Run *run = places->run;
  size_t     above = 0;         /* no run before it touches run i, or one behind that */

  celd_roots (places->clump_of, places->n_runs);
  for (size_t i = 1; i < places->n_runs; i++)
    {
      if (run[i - 1].y == run[i].y && run[i - 1].end == run[i].x)
        celd_join (places->clump_of, (uint32_t) i - 1, (uint32_t) i);
      while (run[above].y < run[i].y - 1 || (run[above].y == run[i].y - 1 && run[above].end < run[i].x))
        above++;
      for (size_t k = above; run[k].y < run[i].y && run[k].x <= run[i].end; k++)
        celd_join (places->clump_of, (uint32_t) k, (uint32_t) i);
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

/* Roots come first among the runs of a clump, so numbers go by first runs. */
static CeldStatus
number_clumps (Places *places)
{
  const Run *run = places->run;
  uint32_t  *clump_of;

  places->clump    = celd_alloc (places->n_runs, sizeof *places->clump);
  places->clump_of = clump_of = celd_alloc (places->n_runs, sizeof *clump_of);
  if (!places->clump || !clump_of)
    return CELD_NO_MEMORY;
  join_runs (places);
  for (size_t i = 0; i < places->n_runs; i++)
    {
      CeldWindow box = { run[i].x, run[i].y, run[i].end - 1, run[i].y, 0, 0, 0 };
      bool       root = clump_of[i] == i;

      clump_of[i] = root ? (uint32_t) places->n_clumps : clump_of[clump_of[i]];
      if (root)
        places->clump[places->n_clumps++] = (Clump) { box, false };
      widen (&places->clump[clump_of[i]].box, &box);
    }
  return CELD_OK;
}

/* ------------------------------------------------------------------ which are worth a look */

/* Hard paint is obeyed wherever it lies; soft paint on ink alone asks for nothing that shows. */
static void
open_clumps (Places *places)
{
  for (size_t i = 0; i < places->n_runs; i++)
    {
      const Run *run = &places->run[i];
      bool      *open = &places->clump[places->clump_of[i]].open;

      *open = *open || celd_canvas_vote (places->canvas, run->label) == CELD_HARD;
      for (int x = run->x; x < run->end && !*open; x++)
        *open = celd_is_paper (CELD_AT (places->canvas->ink, x, run->y));
    }
}

/* ------------------------------------------------------------------ which belong together */

/* Basins with foreign paint are of a family if paper joins them, or a clump.  Ink between two of them is worth nothing:
 * they may as well be looked at one by one. */
static CeldStatus
find_families (Places *places)
{
  const CeldBasins *basins = places->canvas->basins;
  bool             *foreign = celd_alloc0 (basins->n, sizeof *foreign);
  uint32_t         *first = celd_alloc (places->n_clumps, sizeof *first); /* a basin of each clump */

  places->family = celd_alloc (basins->n, sizeof *places->family);
  if (!foreign || !first || !places->family)
    {
      celd_free (foreign);
      celd_free (first);
      return CELD_NO_MEMORY;
    }
  celd_roots (places->family, basins->n);
  for (size_t i = places->n_runs; i-- > 0;)
    first[places->clump_of[i]] = places->run[i].basin;
  for (size_t i = 0; i < places->n_runs; i++)
    {
      foreign[places->run[i].basin] = true;
      celd_join (places->family, first[places->clump_of[i]], places->run[i].basin);
    }
  for (size_t i = 0; i < basins->n_borders; i++)
    if (basins->border[i].passes && foreign[basins->border[i].a] && foreign[basins->border[i].b])
      celd_join (places->family, basins->border[i].a, basins->border[i].b);
  celd_free (foreign);
  celd_free (first);
  return CELD_OK;
}

/* ------------------------------------------------------------------ windows */

static void
make_room (const CeldBasins *basins, CeldWindow *box)
{
  int w = box->right - box->left, h = box->bottom - box->top;
  int room = ROOM + basins->stroke + (w > h ? w : h) / 2;

  box->left   = box->left > room ? box->left - room : 0;
  box->top    = box->top > room ? box->top - room : 0;
  box->right  = box->right < basins->width - 1 - room ? box->right + room : basins->width - 1;
  box->bottom = box->bottom < basins->height - 1 - room ? box->bottom + room : basins->height - 1;
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

  if (p->family != q->family)
    return p->family < q->family ? -1 : 1;
  if (p->top != q->top)
    return p->top < q->top ? -1 : 1;
  return p->left < q->left ? -1 : p->left > q->left;
}

/* Of windows in this order: could q, or one after it, overlap p? */
static bool
may_overlap (const CeldWindow *p, const CeldWindow *q)
{
  return q->family == p->family && q->top <= p->bottom;
}

/* Unites windows of a family that overlap until none do; the united ones are larger and may overlap others. */
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

/* The window of a run's family that holds it; windows->n if there is none.  Windows of a family do not overlap. */
static size_t
window_of (const Places *places, const CeldWindows *windows, const Run *run)
{
  uint32_t family = celd_root (places->family, run->basin);
  size_t   low = 0, high = windows->n;

  while (low < high)
    {
      size_t middle = low + (high - low) / 2;

      if (windows->item[middle].family < family)
        low = middle + 1;
      else
        high = middle;
    }
  for (; low < windows->n && windows->item[low].family == family; low++)
    if (windows->item[low].left <= run->x && run->x <= windows->item[low].right && windows->item[low].top <= run->y
        && run->y <= windows->item[low].bottom)
      return low;
  return windows->n;
}

/* The basins in which foreign paint lies, by window. */
static CeldStatus
list_basins (Places *places, CeldWindows *windows)
{
  uint32_t *last = celd_alloc0 (places->canvas->basins->n, sizeof *last); /* by basin: its last window, from 1 */
  size_t   *begin = celd_alloc0 (windows->n + 1, sizeof *begin);
  size_t    n = 0;

  windows->basin = celd_alloc (places->n_runs, sizeof *windows->basin);
  if (!last || !begin || !windows->basin)
    {
      celd_free (last);
      celd_free (begin);
      return CELD_NO_MEMORY;
    }
  for (size_t i = 0; i < places->n_runs; i++)
    {
      places->clump_of[i] = (uint32_t) window_of (places, windows, &places->run[i]); /* clumps are of no more use */
      begin[places->clump_of[i]]++;
    }
  for (size_t k = 0; k < windows->n; k++)
    {
      size_t runs = begin[k];

      begin[k] = n;
      n += runs;
    }
  for (size_t i = 0; i < places->n_runs; i++)
    if (places->clump_of[i] < windows->n)
      windows->basin[begin[places->clump_of[i]]++] = places->run[i].basin;
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
make_windows (Places *places, CeldWindows *windows)
{
  windows->item = celd_alloc (places->n_clumps, sizeof *windows->item);
  if (!windows->item)
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < places->n_runs; i++)
    {
      Clump *clump = &places->clump[places->clump_of[i]];

      if (!clump->open)
        continue;
      windows->item[windows->n] = clump->box;
      windows->item[windows->n].family = celd_root (places->family, places->run[i].basin);
      make_room (places->canvas->basins, &windows->item[windows->n++]);
      clump->open = false;
    }
  merge (windows);
  return list_basins (places, windows);
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
celd_windows_find (const CeldCanvas *canvas, const uint32_t *label, const CeldHost *host, CeldWindows *windows)
{
  Places      places = { .canvas = canvas, .label = label };
  CeldWindows found = { 0 };
  CeldStatus  status = find_runs (&places);

  if (status == CELD_OK && places.n_runs)
    status = number_clumps (&places);
  if (status == CELD_OK && places.n_runs)
    {
      open_clumps (&places);
      status = find_families (&places);
    }
  if (status == CELD_OK && places.n_runs)
    status = make_windows (&places, &found);
  if (status == CELD_OK)
    status = celd_progress (host, 0);
  if (status == CELD_OK)
    *windows = found;
  else
    celd_windows_clear (&found);
  celd_free (places.run);
  celd_free (places.clump);
  celd_free (places.clump_of);
  celd_free (places.family);
  return status;
}
