/* Which basins a change of the drawing inside a rectangle R can affect.
 *
 * The distance of a pixel changes only if R is nearer to it than the ink or paper outside R that its distance is
 * measured to.  Such pixels are searched in a window round R, which grows until none of them touches its edge.  The
 * basins that contain them, with a margin of three pixels for their neighbours, are affected.  No other basin loses a
 * pixel, since neither its relief nor a step of its ascent changes.
 *
 * Cost: the area of the affected basins' box, and of a margin as wide as the distances in it.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "segment/basin-steps.h"
#include "segment/basins.h"

#include <math.h>

#define SPARE         3    /* pixels: more than two diagonal steps */
#define FIRST_MARGIN  0.75 /* of the largest radius of basins at R: the first margin (measured: most changes reach half
                            * as far) */
#define MOST_SEARCHED 0.2  /* of the picture, in windows searched: beyond this it is as fast to build anew (measured) */
#define MOST_UPDATED  0.6  /* of the picture, in the window of the update: likewise */

typedef struct
{
  const CeldPlane  *ink;
  const CeldBasins *old;
  CeldRect          changed;
  uint8_t          *affected; /* by old basin */
  double            farthest; /* lower bound of the largest distance in affected basins */
} ChangeSearch;

static CeldRect
grow_rect (CeldRect r, int margin, int width, int height)
{
  int left = r.x > margin ? r.x - margin : 0, top = r.y > margin ? r.y - margin : 0;
  int right = r.x + r.width < width - margin ? r.x + r.width + margin : width;
  int bottom = r.y + r.height < height - margin ? r.y + r.height + margin : height;

  return (CeldRect) { left, top, right - left, bottom - top };
}

/* The fraction of the drawing that lies in a rectangle. */
static double
fraction_of (const CeldPlane *ink, CeldRect r)
{
  return (double) r.width * r.height / ((double) ink->width * ink->height);
}

static inline bool
in_rect (CeldRect r, int x, int y)
{
  return x >= r.x && y >= r.y && x < r.x + r.width && y < r.y + r.height;
}

/* ------------------------------------------------------------------ affected basins */

/* Signed squared distances in a window, with all of `changed` set to `value`. */
static CeldStatus
measure_around (const ChangeSearch *r, CeldRect window, float value, const CeldHost *host, float *copy,
                int32_t *squared)
{
  CeldPlane plane = { window.width, window.height, (size_t) window.width, copy };

  for (int y = 0; y < window.height; y++)
    for (int x = 0; x < window.width; x++)
      CELD_AT (&plane, x, y) = in_rect (r->changed, window.x + x, window.y + y)
                             ? value : CELD_AT (r->ink, window.x + x, window.y + y);
  return celd_signed_distance (&plane, host, squared);
}

/* The distance from (x,y) to the nearest pixel of `changed`, in pixels. */
static inline double
distance_to (CeldRect changed, int x, int y)
{
  int dx = x < changed.x ? changed.x - x : x >= changed.x + changed.width ? x - changed.x - changed.width + 1 : 0;
  int dy = y < changed.y ? changed.y - y : y >= changed.y + changed.height ? y - changed.y - changed.height + 1 : 0;

  return sqrt ((double) dx * dx + (double) dy * dy);
}

/* Marks the basins of the pixels in a window that the change may affect. to_ink, to_paper: distances there to ink and
 * paper outside `changed`. Returns false if the affected pixels may continue outside the window. */
static bool
mark_affected (ChangeSearch *r, CeldRect window, const int32_t *to_ink, const int32_t *to_paper)
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
          r->affected[run->basin] = 1;
          r->farthest = distance > r->farthest ? distance : r->farthest;
        }
    }
  return true;
}

/* The margin of the first window, in pixels. */
static int
first_margin (const ChangeSearch *r)
{
  const CeldBasins *old = r->old;
  int32_t           widest = 0;

  for (int y = r->changed.y; y < r->changed.y + r->changed.height; y++)
    for (size_t i = old->row[y]; i < old->row[y + 1]; i++)
      if (old->run[i].x < r->changed.x + r->changed.width && old->basin[old->run[i].basin].squared > widest &&
          (i + 1 == old->row[y + 1] || old->run[i + 1].x > r->changed.x))
        widest = old->basin[old->run[i].basin].squared;
  return 4 * SPARE + (int) (FIRST_MARGIN * sqrt (widest));
}

/* Marks the affected basins; *worthwhile becomes false if that is much of the drawing. */
static CeldStatus
find_affected (ChangeSearch *r, const CeldHost *host, bool *worthwhile)
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

      looked_at += fraction_of (r->ink, window);
      *worthwhile = looked_at < MOST_SEARCHED;
      if (!*worthwhile)
        return CELD_OK;
      copy = celd_alloc (n, sizeof *copy);
      to_ink = celd_alloc (n, sizeof *to_ink);
      to_paper = celd_alloc (n, sizeof *to_paper);
      status = copy && to_ink && to_paper ? measure_around (r, window, 1, host, copy, to_ink) : CELD_NO_MEMORY;
      if (status == CELD_OK)
        status = measure_around (r, window, 0, host, copy, to_paper);
      if (status == CELD_OK)
        found = mark_affected (r, window, to_ink, to_paper);
      celd_free (copy);
      celd_free (to_ink);
      celd_free (to_paper);
    }
  return status;
}

/* Finds the box of the affected basins and the window that their distances depend on. */
static void
find_box (ChangeSearch *r, CeldBasinChange *change)
{
  const CeldBasins *old = r->old;
  int               left = old->width, top = old->height, right = 0, bottom = 0;

  for (int y = 0; y < old->height; y++)
    for (size_t i = old->row[y]; i < old->row[y + 1]; i++)
      if (r->affected[old->run[i].basin])
        {
          int end = celd_basin_run_end (old, i, y);

          left = old->run[i].x < left ? old->run[i].x : left;
          right = end > right ? end : right;
          top = y < top ? y : top;
          bottom = y + 1;
        }
  for (size_t k = 0; k < old->n; k++)
    if (r->affected[k] && sqrt (old->basin[k].squared) > r->farthest)
      r->farthest = sqrt (old->basin[k].squared);
  if (r->farthest < old->stroke + 4) /* ink around them ascends to paper from a stroke's width deep */
    r->farthest = old->stroke + 4;
  change->box = grow_rect ((CeldRect) { left, top, right - left, bottom - top }, 1, old->width, old->height);
  change->window = grow_rect (change->box, (int) r->farthest + SPARE, old->width, old->height);
}

CeldStatus
celd_basins_find_change (const CeldPlane *ink, const CeldBasins *old, const CeldRect *changed, const CeldHost *host,
                         CeldBasinChange *change)
{
  ChangeSearch r = { .ink = ink, .old = old, .changed = *changed, .affected = celd_alloc0 (old->n, 1) };
  CeldStatus   status = CELD_NO_MEMORY;

  *change = (CeldBasinChange) { .affected = r.affected, .worthwhile = true };
  if (r.affected)
    status = find_affected (&r, host, &change->worthwhile);
  if (status == CELD_OK && change->worthwhile)
    {
      find_box (&r, change);
      change->worthwhile = fraction_of (ink, change->window) < MOST_UPDATED;
    }
  return status;
}
