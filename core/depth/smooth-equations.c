/* The equations of smooth depth, eq. (3): minimize  sum v_pq (d_p - d_q)^2  with d = level at the fixed pixels.
 *
 * The other pixels fall into connected components: what edges with v_pq > 0 connect without passing a fixed pixel.
 * Most components border fixed pixels of a single level, and take that level.  A component that borders none keeps its
 * level, or the mean of its levels over its area if it has several.  Neither needs a solver.  Only the others, in which
 * depth runs smoothly from one level to another, are solved (boxed-solver.c).  A component in which no equation is new
 * keeps the last solution.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "depth/depth.h"

#include <math.h>

/* One component. */
typedef struct
{
  size_t area;                  /* pixels, and the sum of their levels; counted only if no fixed pixel borders it */
  double sum;
  float  least, most;           /* of these levels */
  float  low, high;             /* of the levels of the fixed pixels that border it; low > high: there are none */
  bool   changed;               /* some equation is new */
} ComponentExtent;

typedef struct
{
  const CeldSmoothEquations *equations;
  CeldRunComponents          components;
  ComponentExtent           *extent;
  CeldRect                  *bounds;    /* of each component that is to be solved; width 0: it is not */
  float                     *depth;
} SmoothWork;

static size_t
pixel_at (const CeldSmoothEquations *e, int x, int y)
{
  return (size_t) y * (size_t) e->width + (size_t) x;
}

/* ------------------------------------------------------------------ fixed levels that border a component */

/* Considers the edge between the fixed pixel p and the component: that of pixel (x,y) and its right or lower
 * neighbour. */
static inline void
add_fixed (const CeldSmoothEquations *e, ComponentExtent *extent, size_t p, int x, int y, int right)
{
  float level = e->level[p];

  if (level >= extent->low && level <= extent->high)
    return;
  if (celd_edge_weight (&e->edges, e->level, x, y, right, !right) > 0)
    {
      extent->low  = level < extent->low ? level : extent->low;
      extent->high = level > extent->high ? level : extent->high;
    }
}

/* Considers all fixed pixels around a run. */
static void
add_fixed_around (const CeldSmoothEquations *e, const CeldPixelRun *s, int y, ComponentExtent *extent)
{
  size_t w = (size_t) e->width, p = pixel_at (e, s->x, y);

  if (s->x > 0 && e->fixed[p - 1])
    add_fixed (e, extent, p - 1, s->x - 1, y, 1);
  if (s->end < e->width && e->fixed[pixel_at (e, s->end, y)])
    add_fixed (e, extent, pixel_at (e, s->end, y), s->end - 1, y, 1);
  for (int x = s->x; x < s->end && y > 0; x++, p++)
    if (e->fixed[p - w])
      add_fixed (e, extent, p - w, x, y - 1, 0);
  p = pixel_at (e, s->x, y);
  for (int x = s->x; x < s->end && y + 1 < e->height; x++, p++)
    if (e->fixed[p + w])
      add_fixed (e, extent, p + w, x, y, 0);
}

static void
find_fixed (const SmoothWork *work)
{
  const CeldSmoothEquations *e = work->equations;
  const CeldRunComponents   *c = &work->components;

  for (size_t k = 0; k < c->n; k++)
    work->extent[k] = (ComponentExtent) { .low = INFINITY, .high = -INFINITY, .least = INFINITY, .most = -INFINITY,
                                 .changed = !e->changed };
  if (e->changed)
    CELD_EACH_RUN (c, 0, e->height, y, s)
      if (!work->extent[s->component].changed)
        work->extent[s->component].changed = celd_run_marked (c, s, y, e->changed);
  CELD_EACH_RUN (c, 0, e->height, y, s)
    if (work->extent[s->component].changed)
      add_fixed_around (e, s, y, &work->extent[s->component]);
}

/* ------------------------------------------------------------------ components of one depth */

static bool
is_free (const ComponentExtent *extent)
{
  return extent->low > extent->high;
}

static bool
is_solved (const ComponentExtent *extent)
{
  return extent->changed && extent->low < extent->high;
}

static void
measure_components (const SmoothWork *work)
{
  CELD_EACH_RUN (&work->components, 0, work->equations->height, y, s)
    {
      ComponentExtent *extent = &work->extent[s->component];

      if (is_solved (extent))
        celd_box_add_run (&work->bounds[s->component], s, y);
      if (!extent->changed || !is_free (extent))
        continue;
      extent->area += (size_t) (s->end - s->x);
      for (int x = s->x; x < s->end; x++)
        {
          float level = work->equations->level[pixel_at (work->equations, x, y)];

          extent->sum  += (double) level;
          extent->least = level < extent->least ? level : extent->least;
          extent->most  = level > extent->most ? level : extent->most;
        }
    }
}

static float
constant_depth (const ComponentExtent *extent)
{
  if (!is_free (extent))
    return extent->low;
  return fminf (fmaxf ((float) (extent->sum / (double) extent->area), extent->least), extent->most);
}

/* Depth of the fixed pixels, and of the components that are not solved. */
static void
fill_constant (const SmoothWork *work)
{
  const CeldSmoothEquations *e = work->equations;
  size_t                     n = (size_t) e->width * (size_t) e->height;

  memcpy (work->depth, e->level, n * sizeof *e->level);
  CELD_EACH_RUN (&work->components, 0, e->height, y, s)
    {
      const ComponentExtent *extent = &work->extent[s->component];
      size_t                 p = pixel_at (e, s->x, y), end = pixel_at (e, s->end, y);

      if (!extent->changed)
        memcpy (work->depth + p, e->last + p, (end - p) * sizeof *e->last);
      else if (!is_solved (extent))
        for (float depth = constant_depth (extent); p < end; p++)
          work->depth[p] = depth;
    }
}

/* ------------------------------------------------------------------ the others */

/* Adds the edge from pixel i of the box to the fixed pixel q: that of pixel (x,y) and its right or lower neighbour. */
static void
constrain (const CeldSmoothEquations *e, const CeldBox *box, size_t i, size_t q, int x, int y, int right)
{
  float weight = celd_edge_weight (&e->edges, e->level, x, y, right, !right);

  box->diagonal[i] += weight;
  box->b[i]        += weight * e->level[q];
}

/* The equations of a run of row y, whose first pixel has index i in the box. */
static void
write_run (const CeldSmoothEquations *e, const CeldPixelRun *s, int y, size_t i, const CeldBox *box)
{
  size_t w = (size_t) e->width, p = pixel_at (e, s->x, y);

  if (s->x > 0 && e->fixed[p - 1])
    constrain (e, box, i, p - 1, s->x - 1, y, 1);
  for (int x = s->x; x < s->end; x++, i++, p++)
    {
      if (x + 1 < s->end)
        box->east[i] = celd_edge_weight (&e->edges, e->level, x, y, 1, 0);
      else if (s->end < e->width && e->fixed[p + 1])
        constrain (e, box, i, p + 1, x, y, 1);
      if (y > 0 && e->fixed[p - w])
        constrain (e, box, i, p - w, x, y - 1, 0);
      if (y + 1 < e->height && e->fixed[p + w])
        constrain (e, box, i, p + w, x, y, 0);
      else if (y + 1 < e->height)
        box->south[i] = celd_edge_weight (&e->edges, e->level, x, y, 0, 1);
    }
}

/* The least and largest level of the fixed pixels that border any component of the box. */
static void
find_range (const SmoothWork *work, const CeldBox *box, float *low, float *high)
{
  *low  = INFINITY;
  *high = -INFINITY;
  for (size_t k = 0; k < work->components.n; k++)
    if (box->group_of[k] == box->group)
      {
        *low  = fminf (*low, work->extent[k].low);
        *high = fmaxf (*high, work->extent[k].high);
      }
}

/* Masked pixels get an equation of their own, with the solution `low`. */
static double
write_box (const void *data, CeldBox *box)
{
  const SmoothWork          *work = data;
  const CeldSmoothEquations *e = work->equations;
  float                      low, high;

  find_range (work, box, &low, &high);
  for (size_t i = 0; i < box->n; i++)
    {
      box->diagonal[i] = 1;
      box->b[i] = box->x[i] = low;
    }
  CELD_EACH_BOX_RUN (box, y, s)
    {
      const ComponentExtent *extent = &work->extent[s->component];

      for (int x = s->x; x < s->end; x++)
        {
          size_t i = celd_box_pixel (box, x, y), p = pixel_at (e, x, y);

          box->diagonal[i] = box->b[i] = 0;
          box->x[i] = fminf (fmaxf (e->last ? e->last[p] : e->level[p], extent->low), extent->high);
        }
      write_run (e, s, y, celd_box_pixel (box, s->x, y), box);
    }
  return e->tolerance * e->range / ((double) high - (double) low);
}

/* Clamps to the levels that border the component: the solver's error must not carry depth beyond them. */
static void
read_box (void *data, const CeldBox *box, CeldSolve *solve)
{
  const SmoothWork          *work = data;
  const CeldSmoothEquations *e = work->equations;
  float                      low, high;

  CELD_EACH_BOX_RUN (box, y, s)
    {
      const ComponentExtent *extent = &work->extent[s->component];

      for (int x = s->x; x < s->end; x++)
        work->depth[pixel_at (e, x, y)] = fminf (fmaxf (box->x[celd_box_pixel (box, x, y)], extent->low), extent->high);
    }
  find_range (work, box, &low, &high);
  solve->error *= ((double) high - (double) low) / e->range;
}

/* ------------------------------------------------------------------ the step */

CeldStatus
celd_smooth_equations_solve (const CeldSmoothEquations *equations, const CeldHost *host, float *depth, CeldSolve *solve)
{
  SmoothWork   work = { .equations = equations, .depth = depth };
  CeldHostPart part[2];
  CeldHost     finding = celd_host_part (&part[0], host, 0, 0.2), solving = celd_host_part (&part[1], host, 0.2, 1);
  CeldStatus   status = celd_run_components_find (equations->width, equations->height, equations->level,
                                                  equations->fixed, &equations->edges, &finding, &work.components);

  if (status != CELD_OK)
    return status;
  work.extent = celd_alloc (work.components.n + 1, sizeof *work.extent);
  work.bounds = celd_alloc0 (work.components.n + 1, sizeof *work.bounds);
  status      = work.extent && work.bounds ? CELD_OK : CELD_NO_MEMORY;
  if (status == CELD_OK)
    {
      CeldBoxedSystem system = { &work.components, work.bounds, write_box, read_box, &work };

      find_fixed (&work);
      measure_components (&work);
      fill_constant (&work);
      status = celd_boxed_solve (&system, &solving, solve);
    }
  celd_run_components_clear (&work.components);
  celd_free (work.extent);
  celd_free (work.bounds);
  return status;
}
