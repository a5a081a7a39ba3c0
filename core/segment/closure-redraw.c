/* Which pixels change sides when the boundary across a gap is redrawn.
 *
 * The pixels between the old boundary and the new one, by winding number at pixel centres, change sides: to the left of
 * the old boundary they had the left label and get the right one.  The new boundary is rejected if anything else is
 * found there: a third label, another new boundary, ink that is not part of the two lines, faint lines, a seed.
 *
 * Cost: the length of both boundaries times its logarithm, and the area between them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "image/image.h"
#include "segment/closures.h"
#include "segment/task.h"

#include <stdlib.h>

#define TIP_MARGIN      1.5 /* pixels, plus half a line: so near its ends the new boundary may cross ink (chosen) */

/* ------------------------------------------------------------------ does anything stand in the way? */

static bool
is_inside (const CeldRedrawing *r, int x, int y)
{
  return x >= 0 && y >= 0 && x < r->labels->width && y < r->labels->height;
}

/* Is ink so near that this pixel may be on its antialiased edge? */
static bool
near_ink (const CeldRedrawing *r, int x, int y)
{
  for (int v = y - 1; v <= y + 1; v++)
    for (int u = x - 1; u <= x + 1; u++)
      if (is_inside (r, u, v) && !celd_is_paper (CELD_AT (r->task->ink, u, v)))
        return true;
  return false;
}

static double
length_of (const CeldClosureCurve *curve)
{
  return celd_distance_between (curve->place[0], curve->place[curve->n - 1]);
}

static double
line_width (const CeldRedrawing *r)
{
  return fmax (r->end[0].width, r->end[1].width);
}

/* May the new boundary pass here?  On paper of the two labels; on ink only near its ends. */
static bool
is_allowed (const CeldRedrawing *r, const CeldChain *chain, const CeldClosureCurve *curve, CeldPlace place)
{
  int      x = (int) floor (place.x), y = (int) floor (place.y);
  double   tip = TIP_MARGIN + line_width (r) / 2;
  bool     at_end = celd_distance_between (place, curve->place[0]) <= tip ||
                    celd_distance_between (place, curve->place[curve->n - 1]) <= tip;
  float    ink;
  uint32_t label;

  if (!is_inside (r, x, y))
    return at_end;
  ink   = CELD_AT (r->task->ink, x, y);
  label = CELD_AT (r->labels, x, y);
  if (!celd_is_paper (ink))
    return at_end && (celd_line_end_contains (&r->end[0], x, y) || celd_line_end_contains (&r->end[1], x, y));
  return (label == chain->left || label == chain->right) && (!(ink < CELD_FAINT_INK) || near_ink (r, x, y));
}

static bool
is_free (const CeldRedrawing *r, const CeldChain *chain, const CeldClosureCurve *curve)
{
  for (size_t i = 0; i + 1 < curve->n; i++)
    {
      CeldPlace p = curve->place[i], q = curve->place[i + 1];
      int       steps = (int) ceil (2 * celd_distance_between (p, q));

      for (int k = 0; k < steps; k++)
        {
          double t = (k + 0.5) / steps;

          if (!is_allowed (r, chain, curve, (CeldPlace) { p.x + t * (q.x - p.x), p.y + t * (q.y - p.y) }))
            return false;
        }
    }
  return true;
}

/* ------------------------------------------------------------------ what lies between old and new */

static CeldStatus
add_crossings (CeldRedrawing *r, CeldPlace p, CeldPlace q)
{
  double top = fmin (p.y, q.y), bottom = fmax (p.y, q.y);

  for (int y = (int) ceil (top - 0.5); y + 0.5 < bottom; y++)
    {
      double           x = p.x + (y + 0.5 - p.y) * (q.x - p.x) / (q.y - p.y);

      if (celd_append (r->crossing, r->n_crossings, r->crossing_capacity,
                       (CeldRowCrossing) { y, p.y < q.y ? 1 : -1, x }) != CELD_OK)
        return CELD_NO_MEMORY;
    }
  return CELD_OK;
}

static int
compare_crossings (const void *a, const void *b)
{
  const CeldRowCrossing *p = a, *q = b;

  if (p->y != q->y)
    return p->y < q->y ? -1 : 1;
  return p->x < q->x ? -1 : p->x > q->x;
}

static CeldPlace
centre (CeldCorner pixel)
{
  return (CeldPlace) { pixel.x + 0.5, pixel.y + 0.5 };
}

/* The index of the pixel of connected ink nearest to a place; there must be one. */
static size_t
nearest_pixel (const CeldLineEnd *end, CeldPlace place)
{
  double least = INFINITY;
  size_t nearest = 0;

  for (size_t i = 0; i < end->n; i++)
    {
      double dx = end->pixel[i].x + 0.5 - place.x, dy = end->pixel[i].y + 0.5 - place.y;

      if (dx * dx + dy * dy >= least)
        continue;
      least   = dx * dx + dy * dy;
      nearest = i;
    }
  return nearest;
}

/* Adds the path from the last corner of the old boundary through the ink at its end to the new one; or, if `back`, in
 * the opposite direction. */
static CeldStatus
add_ink (CeldRedrawing *r, const CeldLineEnd *end, CeldCorner corner, CeldPlace to, bool back)
{
  CeldPlace  place[2] = { to, end->inside };
  CeldStatus status = add_crossings (r, place[!back], place[back]);

  for (size_t i = nearest_pixel (end, end->inside); status == CELD_OK; i = end->from[i])
    {
      place[0] = place[1];
      place[1] = centre (end->pixel[i]);
      status   = add_crossings (r, place[!back], place[back]);
      if (!i)
        break;
    }
  place[0] = place[1];
  place[1] = (CeldPlace) { corner.x, corner.y };
  return status == CELD_OK ? add_crossings (r, place[!back], place[back]) : status;
}

/* The outline: the old boundary, and the new one backwards. */
static CeldStatus
outline (CeldRedrawing *r, const CeldChain *chain, const CeldClosureCurve *curve)
{
  const CeldCorner *corner = &r->chains->corner[chain->first];
  CeldStatus        status = CELD_OK;

  r->n_crossings = 0;
  for (size_t i = 0; i + 1 < chain->n && status == CELD_OK; i++)
    status = add_crossings (r, (CeldPlace) { corner[i].x, corner[i].y },
                            (CeldPlace) { corner[i + 1].x, corner[i + 1].y });
  if (status == CELD_OK && !curve->straight && r->end[1].n)
    status = add_ink (r, &r->end[1], corner[chain->n - 1], curve->place[curve->n - 1], false);
  for (size_t i = curve->n - 1; i > 0 && status == CELD_OK; i--)
    status = add_crossings (r, curve->place[i], curve->place[i - 1]);
  if (status == CELD_OK && !curve->straight && r->end[0].n)
    status = add_ink (r, &r->end[0], corner[0], curve->place[0], true);
  if (r->n_crossings)
    qsort (r->crossing, r->n_crossings, sizeof *r->crossing, compare_crossings);
  return status;
}

/* Is there a seed of another label in pixels x .. end - 1 of row y? */
static bool
has_seed (const CeldRedrawing *r, int y, int x, int end, uint32_t label)
{
  const CeldSeedRow *row = &r->task->seeds.row[y];

  for (size_t i = 0; i < row->n && row->run[i].x < end; i++)
    if (row->run[i].end > x && row->run[i].label != label)
      return true;
  return false;
}

static bool
is_relabelled (const CeldRedrawing *r, int y, int x, int end)
{
  for (size_t k = 0; k < r->n_done; k++)
    if (y >= r->done[k].least.y && y <= r->done[k].most.y && end > r->done[k].least.x && x <= r->done[k].most.x)
      for (size_t i = r->done[k].first; i < r->done[k].last; i++)
        if (r->patches.item[i].y == y && r->patches.item[i].x < end && r->patches.item[i].end > x)
          return true;
  return false;
}

/* Gives the paper in pixels x .. end - 1 of row y to `label`; *allowed becomes false if that is not possible. */
static CeldStatus
relabel (CeldRedrawing *r, int y, int x, int end, uint32_t old, uint32_t label, bool *allowed)
{
  CeldStatus status = CELD_OK;

  x   = x < 0 ? 0 : x;
  end = end < r->labels->width ? end : r->labels->width;
  if (x >= end || y < 0 || y >= r->labels->height)
    return CELD_OK;
  *allowed = !has_seed (r, y, x, end, label) && !is_relabelled (r, y, x, end);
  for (; x < end && *allowed && status == CELD_OK; x++)
    {
      float    ink = CELD_AT (r->task->ink, x, y);
      uint32_t now = CELD_AT (r->labels, x, y);

      if (!celd_is_paper (ink))
        *allowed = celd_line_end_contains (&r->end[0], x, y) || celd_line_end_contains (&r->end[1], x, y);
      else if ((now != old && now != label) || ((ink < CELD_FAINT_INK || now != old) && !near_ink (r, x, y)))
        *allowed = false; /* antialiased edges may be faint, and may already have the new label */
      else if (now == old)
        status = celd_patch_add (&r->relabelled, (CeldPatch) { y, x, x + 1, label });
    }
  return status;
}

/* Relabels all pixels that the outline encloses. */
static CeldStatus
relabel_enclosed (CeldRedrawing *r, const CeldChain *chain, const CeldClosureCurve *curve, bool *allowed)
{
  double     length = length_of (curve), most = length * (length / 2 + line_width (r)) + 4, area = 0;
  int        winding = 0;
  CeldStatus status = CELD_OK;

  for (size_t i = 0; i + 1 < r->n_crossings && *allowed && status == CELD_OK; i++)
    {
      const CeldRowCrossing *left = &r->crossing[i], *right = left + 1;
      int                    x = (int) ceil (left->x - 0.5), end = (int) ceil (right->x - 0.5);

      winding += left->sign;
      if (!winding || x >= end)
        continue;
      area += end - x;
      *allowed  = winding >= -1 && winding <= 1 && area <= most;
      if (*allowed && winding > 0)
        status = relabel (r, left->y, x, end, chain->left, chain->right, allowed);
      else if (*allowed)
        status = relabel (r, left->y, x, end, chain->right, chain->left, allowed);
    }
  return status;
}

/* Appends the relabelled pixels to the patches. */
static CeldStatus
keep_relabelled (CeldRedrawing *r)
{
  CeldClosurePatches  done = { r->patches.n, r->patches.n, { INT32_MAX, INT32_MAX }, { 0, 0 } };

  for (size_t i = 0; i < r->relabelled.n; i++)
    {
      const CeldPatch *patch = &r->relabelled.item[i];

      if (celd_append (r->patches.item, r->patches.n, r->patches.item_capacity, *patch) != CELD_OK)
        return CELD_NO_MEMORY;
      done.least.x = patch->x < done.least.x ? patch->x : done.least.x;
      done.least.y = patch->y < done.least.y ? patch->y : done.least.y;
      done.most.x  = patch->end > done.most.x ? patch->end : done.most.x;
      done.most.y  = patch->y > done.most.y ? patch->y : done.most.y;
    }
  done.last = r->patches.n;
  return celd_append (r->done, r->n_done, r->done_capacity, done);
}

CeldStatus
celd_boundary_redraw (CeldRedrawing *r, const CeldChain *chain, const CeldClosureCurve *curve, bool *allowed)
{
  CeldStatus status = CELD_OK;

  r->relabelled.n = 0;
  *allowed = is_free (r, chain, curve);
  if (*allowed)
    status = outline (r, chain, curve);
  if (*allowed && status == CELD_OK)
    status = relabel_enclosed (r, chain, curve, allowed);
  if (*allowed && status == CELD_OK)
    status = keep_relabelled (r);
  return status;
}

void
celd_redrawing_clear (CeldRedrawing *redrawing)
{
  for (int k = 0; k < 2; k++)
    celd_line_end_clear (&redrawing->end[k]);
  celd_patches_clear (&redrawing->relabelled);
  celd_patches_clear (&redrawing->patches);
  celd_free (redrawing->crossing);
  celd_free (redrawing->done);
  *redrawing = (CeldRedrawing) { 0 };
}
