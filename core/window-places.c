/* Where paint lies in a basin of another label: the places that windows.c looks at pixel by pixel.
 *
 * Runs of such foreign paint that touch are a clump.  A clump's window is its box with room around: an artist's stroke
 * gets no more of a basin than lies near it, or it would have got the basin.  Windows that overlap are one.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "window.h"

#include <stdlib.h>
#include <string.h>

#define ROOM 8                  /* pixels round the foreign paint, besides a stroke's width and half the longer side */

/* A run of paint in a basin of another label. */
typedef struct { int32_t y, x, end; uint32_t label, basin; size_t clump; } Run;

typedef struct { CeldWindow box; bool open; } Clump;

typedef struct
{
  const CeldCanvas *canvas;
  const uint32_t   *label;      /* of each basin */
  size_t            hint;
  Run              *run;        /* in reading order; `clump`: first another run of it, in the end its number */
  size_t            n_runs;
  Clump            *clump;
  size_t            n_clumps;
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
  run.clump   = places->n_runs;
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
        status = add_run (places, (Run) { y, x, end, seeds->label, basin, 0 });
    }
  return status;
}

/* ------------------------------------------------------------------ clumps */

static size_t
find_root (Run *run, size_t i)
{
  while (run[i].clump != i)
    i = run[i].clump = run[run[i].clump].clump;
  return i;
}

static void
unite (Run *run, size_t i, size_t j)
{
  i = find_root (run, i);
  j = find_root (run, j);
  if (i < j)
    run[j].clump = i;
  else
    run[i].clump = j;
}

/* Joins the runs of row y, from `begin` on, with each other and with those of the row above, `above` .. begin - 1. */
static void
join_rows (Places *places, size_t above, size_t begin)
{
  Run *run = places->run;

  for (size_t i = begin; i < places->n_runs; i++)
    {
      if (i > begin && run[i - 1].end == run[i].x)
        unite (run, i - 1, i);
      while (above < begin && run[above].end < run[i].x)
        above++;
      for (size_t k = above; k < begin && run[k].x <= run[i].end; k++)
        unite (run, k, i);
    }
}

static CeldStatus
find_runs (Places *places)
{
  const CeldSeedRows *seeds = &places->canvas->seeds;
  size_t              above = 0, begin = 0; /* first runs of this row and the one before */
  CeldStatus          status = CELD_OK;

  for (int y = 0; y < seeds->height && status == CELD_OK; y++)
    {
      for (size_t i = 0; i < seeds->row[y].n && status == CELD_OK; i++)
        status = compare_seeds (places, y, &seeds->row[y].run[i]);
      join_rows (places, above, begin);
      above = begin;
      begin = places->n_runs;
    }
  return status;
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
  Run *run = places->run;

  places->clump = celd_alloc (places->n_runs, sizeof *places->clump);
  if (!places->clump)
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < places->n_runs; i++)
    {
      CeldWindow box = { run[i].x, run[i].y, run[i].end - 1, run[i].y, 0, 0 };
      bool       root = run[i].clump == i;

      run[i].clump = root ? places->n_clumps : run[run[i].clump].clump;
      if (root)
        places->clump[places->n_clumps++] = (Clump) { box, false };
      widen (&places->clump[run[i].clump].box, &box);
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
      bool      *open = &places->clump[run->clump].open;

      *open = *open || celd_canvas_vote (places->canvas, run->label) == CELD_HARD;
      for (int x = run->x; x < run->end && !*open; x++)
        *open = celd_is_paper (CELD_AT (places->canvas->ink, x, run->y));
    }
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
compare_tops (const void *a, const void *b)
{
  const CeldWindow *p = a, *q = b;

  if (p->top != q->top)
    return p->top < q->top ? -1 : 1;
  return p->left < q->left ? -1 : p->left > q->left;
}

/* Unites windows that overlap until none do; the united ones are larger and may overlap others. */
static void
merge (CeldWindows *windows)
{
  CeldWindow *item = windows->item;

  for (bool again = true; again;)
    {
      size_t n = 0;

      again = false;
      qsort (item, windows->n, sizeof *item, compare_tops);
      for (size_t i = 0; i < windows->n; i++)
        {
          if (item[i].left > item[i].right)
            continue; /* is part of another one */
          for (size_t j = i + 1; j < windows->n && item[j].top <= item[i].bottom; j++)
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

/* The window that holds a run; they do not overlap. */
static size_t
window_of (const CeldWindows *windows, const Run *run)
{
  size_t k = 0;

  while (k < windows->n && !(windows->item[k].left <= run->x && run->x <= windows->item[k].right &&
                             windows->item[k].top <= run->y && run->y <= windows->item[k].bottom))
    k++;
  return k;
}

/* The basins in which foreign paint lies, by window. */
static CeldStatus
list_basins (const Places *places, CeldWindows *windows)
{
  size_t   *of_clump = celd_alloc (places->n_clumps, sizeof *of_clump);
  uint32_t *last = celd_alloc0 (places->canvas->basins->n, sizeof *last); /* by basin: its last window, from 1 */
  size_t    n = 0;

  windows->basin = celd_alloc (places->n_runs, sizeof *windows->basin);
  if (!of_clump || !last || !windows->basin)
    {
      celd_free (of_clump);
      celd_free (last);
      return CELD_NO_MEMORY;
    }
  for (size_t i = places->n_runs; i-- > 0;)
    of_clump[places->run[i].clump] = i;
  for (size_t c = 0; c < places->n_clumps; c++)
    of_clump[c] = window_of (windows, &places->run[of_clump[c]]);
  for (size_t k = 0; k < windows->n; k++)
    {
      windows->item[k].first = n;
      for (size_t i = 0; i < places->n_runs; i++)
        {
          const Run *run = &places->run[i];

          if (of_clump[run->clump] != k || last[run->basin] == k + 1)
            continue;
          last[run->basin] = (uint32_t) k + 1;
          windows->basin[n++] = run->basin;
        }
      windows->item[k].n = n - windows->item[k].first;
    }
  celd_free (of_clump);
  celd_free (last);
  return CELD_OK;
}

static CeldStatus
make_windows (const Places *places, CeldWindows *windows)
{
  windows->item = celd_alloc (places->n_clumps, sizeof *windows->item);
  if (!windows->item)
    return CELD_NO_MEMORY;
  for (size_t c = 0; c < places->n_clumps; c++)
    if (places->clump[c].open)
      {
        windows->item[windows->n] = places->clump[c].box;
        make_room (places->canvas->basins, &windows->item[windows->n++]);
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
celd_windows_find (const CeldCanvas *canvas, const uint32_t *label, const CeldRun *run, CeldWindows *windows)
{
  Places      places = { .canvas = canvas, .label = label };
  CeldWindows found = { 0 };
  CeldStatus  status = find_runs (&places);

  if (status == CELD_OK && places.n_runs)
    status = number_clumps (&places);
  if (status == CELD_OK && places.n_runs)
    {
      open_clumps (&places);
      status = make_windows (&places, &found);
    }
  if (status == CELD_OK)
    status = celd_step (run, 0);
  if (status == CELD_OK)
    *windows = found;
  else
    celd_windows_clear (&found);
  celd_free (places.run);
  celd_free (places.clump);
  return status;
}
