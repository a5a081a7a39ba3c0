/* Smooth depth, eq. (3): minimize  sum v_pq (d_p - d_q)^2  with d = level at the anchors, the Dirichlet constraints
 * (the paper's U_o).
 *
 * The weights v_pq are in discontinuities.c and held-gaps.c, constraints for regions without an anchor in cores.c, the
 * solution in smooth-equations.c.  This file is the step, and finds what an edit changed: a pixel's equation is new if
 * its level, a neighbour's level, whether one of them is fixed, or the ink around them has changed, or if a gap there
 * holds that did not, or the reverse.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "depth/depth.h"
#include "image/image.h"

#include <math.h>

/* ------------------------------------------------------------------ levels */

void
celd_depth_levels (const CeldPlane *levels, float *level)
{
  float least = INFINITY;

  for (int y = 0; y < levels->height; y++)
    for (int x = 0; x < levels->width; x++)
      if (isfinite (CELD_AT (levels, x, y)) && CELD_AT (levels, x, y) < least)
        least = CELD_AT (levels, x, y);
  for (int y = 0; y < levels->height; y++)
    for (int x = 0; x < levels->width; x++)
      {
        float d = CELD_AT (levels, x, y);

        *level++ = isfinite (d) ? d + 0.f : isfinite (least) ? least : 0; /* + 0 turns -0 into 0 */
      }
}

/* ------------------------------------------------------------------ changed equations */

/* Marks the pixel and its four neighbours. */
static void
mark_round (int width, int height, int x, int y, uint8_t *changed)
{
  uint8_t *here = changed + (size_t) y * (size_t) width + (size_t) x;

  here[0] = 1;
  if (x > 0)
    here[-1] = 1;
  if (x + 1 < width)
    here[1] = 1;
  if (y > 0)
    here[-width] = 1;
  if (y + 1 < height)
    here[width] = 1;
}

static void
mark_levels (const CeldSmoothState *old, const float *level, uint8_t *changed)
{
  size_t w = (size_t) old->width;

  for (int y = 0; y < old->height; y++)
    {
      const float *now = level + (size_t) y * w, *before = old->level + (size_t) y * w;

      if (memcmp (now, before, w * sizeof *now))
        for (int x = 0; x < old->width; x++)
          if (now[x] != before[x])
            mark_round (old->width, old->height, x, y, changed);
    }
}

static void
mark_fixed (const CeldSmoothState *old, const uint8_t *fixed, uint8_t *changed)
{
  size_t w = (size_t) old->width;

  for (int y = 0; y < old->height; y++)
    {
      const uint8_t *now = fixed + (size_t) y * w, *before = old->fixed + (size_t) y * w;

      if (memcmp (now, before, w))
        for (int x = 0; x < old->width; x++)
          if (!now[x] != !before[x])
            mark_round (old->width, old->height, x, y, changed);
    }
}

/* Marks the pixels at edges that are cut now and were not before, or the reverse. */
static void
mark_cuts (const CeldSmoothState *old, const uint8_t *cut, uint8_t *changed)
{
  size_t w = (size_t) old->width;

  for (int y = 0; cut && y < old->height; y++)
    {
      const uint8_t *now = cut + (size_t) y * w, *before = old->cut + (size_t) y * w;

      if (memcmp (now, before, w))
        for (int x = 0; x < old->width; x++)
          if (now[x] != before[x])
            mark_round (old->width, old->height, x, y, changed);
    }
}

/* Marks all pixels whose weights may depend on new ink. */
static void
mark_ink (const CeldSmoothState *old, uint8_t *changed)
{
  CeldRect ink = old->new_ink;
  int      far = (old->radius > CELD_THIN_LINE_REACH ? old->radius : CELD_THIN_LINE_REACH) + 1;

  for (int y = ink.y - far; ink.width && y < ink.y + ink.height + far; y++)
    for (int x = ink.x - far; y >= 0 && y < old->height && x < ink.x + ink.width + far; x++)
      if (x >= 0 && x < old->width)
        changed[(size_t) y * (size_t) old->width + (size_t) x] = 1;
}

/* ------------------------------------------------------------------ the step */

/* The planes of the step. */
typedef struct
{
  int      width, height;
  float   *level, *depth;
  uint8_t *fixed, *changed;     /* changed NULL: all equations are new */
  uint8_t *cut;                 /* NULL: gaps do not hold */
  double   range;
} SmoothPlanes;

static void
read_anchors (const CeldMask *anchors, uint8_t *fixed)
{
  for (int y = 0; y < anchors->height; y++)
    for (int x = 0; x < anchors->width; x++)
      *fixed++ = CELD_AT (anchors, x, y) ? CELD_ANCHOR : CELD_FREE;
}

static double
range_of (const float *level, size_t n)
{
  float low = level[0], high = level[0];

  for (size_t i = 1; i < n; i++)
    {
      low  = level[i] < low ? level[i] : low;
      high = level[i] > high ? level[i] : high;
    }
  return (double) high - (double) low;
}

/* Whether the last depth can be used: not if it was solved less exactly, or with other weights. */
static bool
is_of_use (const CeldSmoothState *old, const CeldSmoothInput *s, const SmoothPlanes *p)
{
  return old && old->level && s->last && old->width == p->width && old->height == p->height &&
         old->threshold == s->settings->ink_threshold && old->radius == s->radius && !old->cut == !p->cut &&
         old->error <= (double) s->settings->tolerance * p->range;
}

static CeldStatus
planes_new (const CeldSmoothState *old, const CeldSmoothInput *s, SmoothPlanes *p)
{
  size_t n;

  *p = (SmoothPlanes) { .width = s->levels->width, .height = s->levels->height };
  n  = (size_t) p->width * (size_t) p->height;
  p->level = celd_alloc (n, sizeof *p->level);
  p->depth = celd_alloc (n, sizeof *p->depth);
  p->fixed = celd_alloc0 (n, sizeof *p->fixed);
  p->cut   = s->settings->hold_gaps ? celd_alloc (n, sizeof *p->cut) : NULL;
  if (!p->level || !p->depth || !p->fixed || !p->cut != !s->settings->hold_gaps)
    return CELD_NO_MEMORY;
  celd_depth_levels (s->levels, p->level);
  if (s->anchors)
    read_anchors (s->anchors, p->fixed);
  p->range = range_of (p->level, n);
  if (!is_of_use (old, s, p))
    return CELD_OK;
  p->changed = celd_alloc0 (n, sizeof *p->changed);
  if (!p->changed)
    return CELD_NO_MEMORY;
  mark_levels (old, p->level, p->changed);
  return CELD_OK;
}

/* Moves the planes to keep into the state. */
static void
remember (CeldSmoothState *smoother, const CeldSmoothInput *s, const CeldSolve *solve, SmoothPlanes *p)
{
  celd_smooth_state_clear (smoother);
  *smoother = (CeldSmoothState) { p->width, p->height, p->level, p->fixed, p->cut, s->settings->ink_threshold,
                               solve->converged ? (double) s->settings->tolerance * p->range : INFINITY, s->radius,
                               { 0 } };
  p->level = NULL;
  p->fixed = NULL;
  p->cut   = NULL;
}

CeldStatus
celd_smooth_update (CeldSmoothState *smoother, const CeldSmoothInput *s, const CeldHost *host, CeldPlane *depth,
                    CeldSolve *solve)
{
  CeldHostPart part[3];
  CeldHost     cutting = celd_host_part (&part[0], host, 0, 0.1), holding = celd_host_part (&part[1], host, 0.1, 0.2);
  CeldHost     solving = celd_host_part (&part[2], host, 0.2, 1);
  SmoothPlanes p;
  CeldStatus   status = planes_new (smoother, s, &p);

  if (status == CELD_OK && p.cut)
    {
      CeldDepthEdges edges = { s->ink, s->settings->ink_threshold, s->radius, NULL };

      status = celd_gaps_hold (&edges, s->borders, p.level, s->gap, &cutting, p.cut);
    }
  if (status == CELD_OK && (!s->anchors || s->settings->hold_rest))
    status = celd_cores_mark (p.width, p.height, p.level, s->speck, p.changed, p.changed ? smoother->fixed : NULL,
                              &holding, p.fixed);
  if (status == CELD_OK)
    {
      CeldSmoothEquations system = { p.width, p.height, p.level, p.fixed,
                            { s->ink, s->settings->ink_threshold, s->radius, p.cut }, p.changed, s->last,
                            (double) s->settings->tolerance, p.range };

      if (p.changed)
        {
          mark_fixed (smoother, p.fixed, p.changed);
          mark_cuts (smoother, p.cut, p.changed);
          mark_ink (smoother, p.changed);
        }
      status = celd_smooth_equations_solve (&system, &solving, p.depth, solve);
    }
  if (status == CELD_OK)
    {
      *depth  = (CeldPlane) { p.width, p.height, (size_t) p.width, p.depth };
      p.depth = NULL;
      if (smoother)
        remember (smoother, s, solve, &p);
    }
  celd_free (p.level);
  celd_free (p.depth);
  celd_free (p.fixed);
  celd_free (p.changed);
  celd_free (p.cut);
  return status;
}

void
celd_smooth_state_clear (CeldSmoothState *smoother)
{
  celd_free (smoother->level);
  celd_free (smoother->fixed);
  celd_free (smoother->cut);
  *smoother = (CeldSmoothState) { 0 };
}

CeldStatus
celd_smooth (const CeldPlane *ink, const CeldPlane *borders, const CeldPlane *levels, const CeldMask *anchors,
             const CeldSettings *settings, const CeldHost *host, CeldPlane *depth, CeldSolve *solve)
{
  CeldSmoothInput smoothing = { ink, levels, borders, anchors, settings, 0, { 0, 0 }, CELD_SPECK, NULL };
  CeldPlane       made = { 0 };
  CeldSolve       how;
  int             stroke;
  CeldStatus      status;

  if (!CELD_SAME_SIZE (ink, levels) || !CELD_SAME_SIZE (ink, depth) || (anchors && !CELD_SAME_SIZE (ink, anchors)) ||
      (borders && !CELD_SAME_SIZE (ink, borders)))
    return CELD_BAD_SIZE;
  if (celd_settings_check (settings) != CELD_OK)
    return CELD_BAD_VALUE;
  stroke           = celd_stroke_width (ink);
  smoothing.radius = celd_edge_radius (stroke);
  smoothing.gap    = celd_longest_gap (stroke, ink->width, ink->height);
  status = celd_smooth_update (NULL, &smoothing, host, &made, &how);
  for (int y = 0; y < depth->height && status == CELD_OK; y++)
    memcpy (&CELD_AT (depth, 0, y), &CELD_AT (&made, 0, y), (size_t) depth->width * sizeof *depth->data);
  if (status == CELD_OK && solve)
    *solve = how;
  celd_free (made.data);
  return status;
}
