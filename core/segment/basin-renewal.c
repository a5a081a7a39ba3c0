/* The basin graph of a drawing that has changed inside a rectangle R, from the graph before.
 *
 * What a change can reach: a pixel's distance is another one only if R is nearer to it than what lies outside R and
 * ends its paper or ink.  Such pixels, found in a window round R that is grown until they do not touch its edge, lie
 * in touched basins; with three pixels to spare, so do their neighbours.  No other basin loses a pixel, since neither
 * the relief nor a step is another one there.  The pixels of touched basins are led anew, to maxima among them or into
 * basins that are kept; borders are the old ones between kept basins, and all pairs with a pixel of touched basins.
 *
 * Cost: by the box of the touched basins and as much around it as distances in it are long; the list of runs is copied.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "segment/basin-steps.h"
#include "segment/basins.h"

#include <math.h>

#define SPARE       3      /* pixels: more than two diagonal steps */
#define FIRST_REACH 0.75   /* of how wide the basins at R are: most changes reach half as far */
#define LOOKED_AT   0.2    /* of all pixels, in windows; from there on, and */
#define MADE        0.6    /* from here on, it is as fast to build anew */

typedef struct
{
  const CeldPlane  *ink;
  const CeldBasins *old;
  CeldRect          changed;
  CeldRect          box;      /* of the touched basins, and a pixel more */
  CeldRect          window;   /* box and as much as its distances are long */
  uint8_t          *touched;  /* by old basin */
  double            deepest;  /* least bound known of the distances in touched basins */
  int32_t          *squared;  /* of the window */
  uint8_t          *anew;     /* of the box: lies in a touched basin */
} Renewal;

static CeldRect
grow_rect (CeldRect r, int margin, int width, int height)
{
  int left = r.x > margin ? r.x - margin : 0, top = r.y > margin ? r.y - margin : 0;
  int right = r.x + r.width < width - margin ? r.x + r.width + margin : width;
  int bottom = r.y + r.height < height - margin ? r.y + r.height + margin : height;

  return (CeldRect) { left, top, right - left, bottom - top };
}

/* The share of the drawing that lies in a rectangle. */
static double
share_of (const CeldPlane *ink, CeldRect r)
{
  return (double) r.width * r.height / ((double) ink->width * ink->height);
}

static inline bool
in_rect (CeldRect r, int x, int y)
{
  return x >= r.x && y >= r.y && x < r.x + r.width && y < r.y + r.height;
}

/* ------------------------------------------------------------------ which basins are touched */

/* Signed distances in a window to what lies outside `changed`, if all of that is `value`. */
static CeldStatus
measure_around (const Renewal *r, CeldRect window, float value, const CeldHost *host, float *copy, int32_t *squared)
{
  CeldPlane plane = { window.width, window.height, (size_t) window.width, copy };

  for (int y = 0; y < window.height; y++)
    for (int x = 0; x < window.width; x++)
      CELD_AT (&plane, x, y) = in_rect (r->changed, window.x + x, window.y + y)
                             ? value : CELD_AT (r->ink, window.x + x, window.y + y);
  return celd_signed_distance (&plane, host, squared);
}

/* From (x,y) to the nearest pixel of `changed`. */
static inline double
distance_to (CeldRect changed, int x, int y)
{
  int dx = x < changed.x ? changed.x - x : x >= changed.x + changed.width ? x - changed.x - changed.width + 1 : 0;
  int dy = y < changed.y ? changed.y - y : y >= changed.y + changed.height ? y - changed.y - changed.height + 1 : 0;

  return sqrt ((double) dx * dx + (double) dy * dy);
}

/* Marks the basins of the pixels of a window that the change may reach.  to_ink, to_paper: distances there to what lies
 * outside `changed`.  False if that goes on beyond the window. */
static bool
mark_reached (Renewal *r, CeldRect window, const int32_t *to_ink, const int32_t *to_paper)
{
  CeldRect inner = { window.x + (window.x > 0), window.y + (window.y > 0), 0, 0 };

  inner.width = window.x + window.width - (window.x + window.width < r->ink->width) - inner.x;
  inner.height = window.y + window.height - (window.y + window.height < r->ink->height) - inner.y;
  for (int y = window.y; y < window.y + window.height; y++)
    {
      const CeldBasinRun *run = r->old->run + r->old->row[y], *end = r->old->run + r->old->row[y + 1];

      for (int x = window.x; x < window.x + window.width; x++, to_ink++, to_paper++)
        {
          bool    within = in_rect (r->changed, x, y);
          int32_t squared = within ? (*to_ink > -*to_paper ? *to_ink : -*to_paper) : *to_ink > 0 ? *to_ink : -*to_paper;
          double  distance = sqrt (squared);

          if (!within && distance + SPARE <= distance_to (r->changed, x, y))
            continue;
          if (!in_rect (inner, x, y))
            return false;
          while (run + 1 < end && run[1].x <= x)
            run++;
          r->touched[run->basin] = 1;
          r->deepest = distance > r->deepest ? distance : r->deepest;
        }
    }
  return true;
}

/* How far to look for what the change reaches, to begin with. */
static int
first_margin (const Renewal *r)
{
  const CeldBasins *old = r->old;
  int32_t           widest = 0;

  for (int y = r->changed.y; y < r->changed.y + r->changed.height; y++)
    for (size_t i = old->row[y]; i < old->row[y + 1]; i++)
      if (old->run[i].x < r->changed.x + r->changed.width && old->basin[old->run[i].basin].squared > widest &&
          (i + 1 == old->row[y + 1] || old->run[i + 1].x > r->changed.x))
        widest = old->basin[old->run[i].basin].squared;
  return 4 * SPARE + (int) (FIRST_REACH * sqrt (widest));
}

/* Marks the basins that the change reaches; *worth becomes false if that is much of the drawing. */
static CeldStatus
find_touched (Renewal *r, const CeldHost *host, bool *worth)
{
  CeldStatus status = CELD_OK;
  double     looked_at = 0;
  bool       found = false;

  for (int margin = first_margin (r); !found && status == CELD_OK; margin += margin / 2)
    {
      CeldRect window = grow_rect (r->changed, margin, r->ink->width, r->ink->height);
      size_t   n = (size_t) window.width * (size_t) window.height;
      float   *copy;
      int32_t *to_ink, *to_paper;

      looked_at += share_of (r->ink, window);
      *worth = looked_at < LOOKED_AT;
      if (!*worth)
        return CELD_OK;
      copy = celd_alloc (n, sizeof *copy);
      to_ink = celd_alloc (n, sizeof *to_ink);
      to_paper = celd_alloc (n, sizeof *to_paper);
      status = copy && to_ink && to_paper ? measure_around (r, window, 1, host, copy, to_ink) : CELD_NO_MEMORY;
      if (status == CELD_OK)
        status = measure_around (r, window, 0, host, copy, to_paper);
      if (status == CELD_OK)
        found = mark_reached (r, window, to_ink, to_paper);
      celd_free (copy);
      celd_free (to_ink);
      celd_free (to_paper);
    }
  return status;
}

/* The box of the touched basins, and how deep they are. */
static void
find_box (Renewal *r)
{
  const CeldBasins *old = r->old;
  int               left = old->width, top = old->height, right = 0, bottom = 0;

  for (int y = 0; y < old->height; y++)
    for (size_t i = old->row[y]; i < old->row[y + 1]; i++)
      if (r->touched[old->run[i].basin])
        {
          int end = celd_basin_run_end (old, i, y);

          left = old->run[i].x < left ? old->run[i].x : left;
          right = end > right ? end : right;
          top = y < top ? y : top;
          bottom = y + 1;
        }
  for (size_t k = 0; k < old->n; k++)
    if (r->touched[k] && sqrt (old->basin[k].squared) > r->deepest)
      r->deepest = sqrt (old->basin[k].squared);
  if (r->deepest < old->stroke + 4) /* ink around leads to paper from a stroke's width deep */
    r->deepest = old->stroke + 4;
  r->box = grow_rect ((CeldRect) { left, top, right - left, bottom - top }, 1, old->width, old->height);
  r->window = grow_rect (r->box, (int) r->deepest + SPARE, old->width, old->height);
}

/* ------------------------------------------------------------------ new basins among kept ones */

static void
mark_anew (Renewal *r)
{
  const CeldBasins *old = r->old;
  uint8_t          *anew = r->anew;

  for (int y = r->box.y; y < r->box.y + r->box.height; y++)
    {
      const CeldBasinRun *run = old->run + old->row[y], *end = old->run + old->row[y + 1];

      for (int x = r->box.x; x < r->box.x + r->box.width; x++)
        {
          while (run + 1 < end && run[1].x <= x)
            run++;
          *anew++ = r->touched[run->basin];
        }
    }
}

/* The basins of both, in reading order; to[k] is the number of basin k of the new ones, kept[k] of the old ones. */
static CeldStatus
merge_basins (const Renewal *r, const CeldBasins *made, uint32_t *to, uint32_t *kept, CeldBasins *found)
{
  const CeldBasins *old = r->old;
  size_t            n = 0;

  found->basin = celd_alloc (old->n + made->n, sizeof *found->basin);
  if (!found->basin)
    return CELD_NO_MEMORY;
  for (size_t i = 0, j = 0; i < old->n || j < made->n; n++)
    {
      const CeldBasin *p = &old->basin[i], *q = &made->basin[j];

      if (i < old->n && r->touched[i])
        {
          i++;
          n--;
        }
      else if (j == made->n || (i < old->n && (p->y < q->y || (p->y == q->y && p->x < q->x))))
        {
          kept[i++] = (uint32_t) n;
          found->basin[n] = *p;
          found->basin[n].area = 0;
        }
      else
        {
          to[j++] = (uint32_t) n;
          found->basin[n] = *q;
        }
    }
  found->n = n;
  return CELD_OK;
}

/* Appends the runs of row `y` of a graph, as far as they lie between the columns from and end, with other numbers; the
 * row starts in column `left`. */
static void
copy_runs (const CeldBasins *from_graph, int y, int left, int from, int end, const uint32_t *to, const uint32_t *kept,
           size_t start, CeldBasins *found, size_t *n)
{
  const CeldBasinRun *run = from_graph->run + from_graph->row[y], *last = from_graph->run + from_graph->row[y + 1];

  for (; run < last && left + run->x < end && from < end; run++)
    {
      int      x = left + run->x > from ? left + run->x : from;
      uint32_t basin = run->basin & CELD_KEPT ? kept[run->basin - CELD_KEPT] : to[run->basin];

      if ((run + 1 < last && left + run[1].x <= from) || (*n > start && found->run[*n - 1].basin == basin))
        continue;
      found->run[(*n)++] = (CeldBasinRun) { x, basin };
    }
}

/* The old runs, and in the box those of `made`. */
static CeldStatus
merge_runs (const Renewal *r, const CeldBasins *made, const uint32_t *to, const uint32_t *kept, CeldBasins *found)
{
  const CeldBasins *old = r->old;
  CeldRect          box = r->box;
  size_t            n = 0, most = old->row[old->height] + made->row[made->height] + 2 * (size_t) box.height;

  found->row = celd_alloc ((size_t) old->height + 1, sizeof *found->row);
  found->run = celd_alloc (most, sizeof *found->run);
  if (!found->row || !found->run)
    return CELD_NO_MEMORY;
  for (int y = 0; y < old->height; y++)
    {
      bool   crosses = y >= box.y && y < box.y + box.height;
      size_t start = found->row[y] = n;

      copy_runs (old, y, 0, 0, crosses ? box.x : old->width, kept, kept, start, found, &n);
      if (!crosses)
        continue;
      copy_runs (made, y - box.y, box.x, box.x, box.x + box.width, to, kept, start, found, &n);
      copy_runs (old, y, 0, box.x + box.width, old->width, kept, kept, start, found, &n);
    }
  found->row[old->height] = n;
  return CELD_OK;
}

/* ------------------------------------------------------------------ borders */

static int
compare_borders (const CeldBorder *p, const CeldBorder *q)
{
  if (p->a != q->a)
    return p->a < q->a ? -1 : 1;
  return p->b < q->b ? -1 : p->b > q->b;
}

/* The borders between kept basins, and those that pixels made anew have; where they are the same, one. */
static CeldStatus
merge_borders (const Renewal *r, const uint32_t *kept, const CeldBorder *more, size_t n_more, CeldBasins *found)
{
  const CeldBasins *old = r->old;
  size_t            n = 0, j = 0;

  found->border = celd_alloc (old->n_borders + n_more, sizeof *found->border);
  if (!found->border)
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < old->n_borders; i++)
    {
      CeldBorder border = old->border[i];

      if (r->touched[border.a] || r->touched[border.b])
        continue;
      border.a = kept[border.a];
      border.b = kept[border.b];
      while (j < n_more && compare_borders (&more[j], &border) < 0)
        found->border[n++] = more[j++];
      if (j < n_more && compare_borders (&more[j], &border) == 0)
        celd_border_add (&border, &more[j++]);
      found->border[n++] = border;
    }
  while (j < n_more)
    found->border[n++] = more[j++];
  found->n_borders = n;
  return CELD_OK;
}

/* ------------------------------------------------------------------ all of it */

/* Makes the touched basins anew, and the graph of them and those that are kept. */
static CeldStatus
make_anew (Renewal *r, const CeldHost *host, CeldBasins *found)
{
  CeldRect    box = r->box, window = r->window;
  CeldPlane   view = { window.width, window.height, r->ink->stride, &CELD_AT (r->ink, window.x, window.y) };
  CeldPlot    plot = { box, r->squared + (size_t) (box.y - window.y) * (size_t) window.width + (box.x - window.x),
                       (size_t) window.width, r->old->stroke, r->anew, r->old };
  CeldBasins  made = { 0 };
  CeldBorder *border = NULL;
  uint32_t   *to = NULL, *kept = celd_alloc (r->old->n, sizeof *kept);
  size_t      n_borders = 0;
  CeldStatus  status = kept ? celd_signed_distance (&view, host, r->squared) : CELD_NO_MEMORY;

  made.width = box.width;
  made.height = box.height;
  mark_anew (r);
  if (status == CELD_OK)
    status = celd_basins_ascend (&plot, host, &made);
  if (status == CELD_OK && !(to = celd_alloc (made.n, sizeof *to)))
    status = CELD_NO_MEMORY;
  if (status == CELD_OK)
    status = merge_basins (r, &made, to, kept, found);
  if (status == CELD_OK)
    status = merge_runs (r, &made, to, kept, found);
  if (status == CELD_OK)
    {
      celd_basins_measure (found);
      status = celd_basins_touch (r->ink, &plot, found, host, &border, &n_borders);
    }
  if (status == CELD_OK)
    status = merge_borders (r, kept, border, n_borders, found);
  if (status == CELD_OK)
    status = celd_basins_unite (found);
  celd_free (border);
  celd_free (to);
  celd_free (kept);
  celd_basins_clear (&made);
  return status;
}

CeldStatus
celd_basins_revise (const CeldPlane *ink, const CeldRect *changed, const CeldBasins *old, const CeldHost *host,
                    CeldBasins *found)
{
  CeldHostPart   part;
  CeldHost   quiet = celd_host_part (&part, host, 0, 0);
  Renewal    r = { .ink = ink, .old = old, .changed = *changed };
  bool       worth = true;
  CeldStatus status;

  r.touched = celd_alloc0 (old->n, 1);
  status = r.touched ? find_touched (&r, &quiet, &worth) : CELD_NO_MEMORY;
  if (status == CELD_OK && worth)
    {
      find_box (&r);
      worth = share_of (ink, r.window) < MADE;
    }
  if (status == CELD_OK && worth)
    {
      r.squared = celd_alloc ((size_t) r.window.width * (size_t) r.window.height, sizeof *r.squared);
      r.anew = celd_alloc ((size_t) r.box.width * (size_t) r.box.height, 1);
      status = r.squared && r.anew ? make_anew (&r, &quiet, found) : CELD_NO_MEMORY;
    }
  celd_free (r.squared);
  celd_free (r.anew);
  celd_free (r.touched);
  return status;
}
