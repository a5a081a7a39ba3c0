/* Eq. (3) part by part: minimize  sum v_pq (d_p - d_q)^2  with d = level at the fixed pixels.
 *
 * A part is what v_pq > 0 joins without passing a fixed pixel.  Most parts see fixed pixels of one level only and take
 * that, and what no fixed pixel reaches keeps its level, the mean over its area if it has several: neither needs a
 * solver.  The others, where depth runs smoothly from one level to another, are solved in boxes, the rest of the box
 * masked; a part of which nothing changed keeps what it had.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "depth/depth.h"
#include "solve/laplace.h"

#include <math.h>

typedef struct
{
  size_t   area;
  double   sum;                 /* of its levels; only where no fixed pixel reaches it */
  float    low, high;           /* of the fixed levels that reach it; low > high: none does */
  float    least, most;         /* of its own levels, where none does */
  bool     changed;
  CeldRect box;
} Part;

typedef struct
{
  const CeldSystem *system;
  CeldParts         parts;
  Part             *part;
  uint32_t         *group;      /* of each part: which box it is solved in */
  float            *depth;
} Work;

/* The planes of one box. */
typedef struct { CeldRect box; uint32_t group; float *east, *south, *diagonal, *b, *x; } Box;

/* ------------------------------------------------------------------ what reaches a part */

static size_t
pixel_at (const CeldSystem *e, int x, int y)
{
  return (size_t) y * (size_t) e->width + (size_t) x;
}

/* The edge from the fixed pixel p into the part: that of pixel (x,y) and its right or lower neighbour. */
static inline void
reach (const CeldSystem *e, Part *part, size_t p, int x, int y, int right)
{
  float level = e->level[p];

  if (level >= part->low && level <= part->high)
    return;
  if (celd_edge_weight (&e->edges, e->level, x, y, right, !right) > 0)
    {
      part->low  = level < part->low ? level : part->low;
      part->high = level > part->high ? level : part->high;
    }
}

/* The fixed pixels round a stretch. */
static void
look_round (const CeldSystem *e, const CeldStretch *s, int y, Part *part)
{
  size_t w = (size_t) e->width, p = pixel_at (e, s->x, y);

  if (s->x > 0 && e->fixed[p - 1])
    reach (e, part, p - 1, s->x - 1, y, 1);
  if (s->end < e->width && e->fixed[pixel_at (e, s->end, y)])
    reach (e, part, pixel_at (e, s->end, y), s->end - 1, y, 1);
  for (int x = s->x; x < s->end && y > 0; x++, p++)
    if (e->fixed[p - w])
      reach (e, part, p - w, x, y - 1, 0);
  p = pixel_at (e, s->x, y);
  for (int x = s->x; x < s->end && y + 1 < e->height; x++, p++)
    if (e->fixed[p + w])
      reach (e, part, p + w, x, y, 0);
}

/* Calls for every stretch of rows y .. end - 1. */
#define EACH_STRETCH(work, from, end, y, s) \
  for (int y = (from); y < (end); y++) \
    for (const CeldStretch *s = (work)->parts.stretch + (work)->parts.row[y], \
         *end_ = (work)->parts.stretch + (work)->parts.row[y + 1]; s < end_; s++)

static void
look_at_parts (const Work *work)
{
  const CeldSystem *e = work->system;

  for (size_t k = 0; k < work->parts.n; k++)
    work->part[k] = (Part) { .low = INFINITY, .high = -INFINITY, .least = INFINITY, .most = -INFINITY,
                             .changed = !e->changed };
  if (e->changed)
    EACH_STRETCH (work, 0, e->height, y, s)
      if (!work->part[s->part].changed)
        work->part[s->part].changed = celd_stretch_marked (&work->parts, s, y, e->changed);
  EACH_STRETCH (work, 0, e->height, y, s)
    if (work->part[s->part].changed)
      look_round (e, s, y, &work->part[s->part]);
}

/* ------------------------------------------------------------------ parts of one depth */

static bool
floats (const Part *part)
{
  return part->low > part->high;
}

static bool
is_solved (const Part *part)
{
  return part->changed && part->low < part->high;
}

static void
add_levels (const Work *work)
{
  EACH_STRETCH (work, 0, work->system->height, y, s)
    {
      Part *part = &work->part[s->part];

      if (is_solved (part))
        celd_box_add (&part->box, s, y);
      if (!part->changed || !floats (part))
        continue;
      part->area += (size_t) (s->end - s->x);
      for (int x = s->x; x < s->end; x++)
        {
          float level = work->system->level[pixel_at (work->system, x, y)];

          part->sum  += (double) level;
          part->least = level < part->least ? level : part->least;
          part->most  = level > part->most ? level : part->most;
        }
    }
}

static float
constant_depth (const Part *part)
{
  return floats (part) ? fminf (fmaxf ((float) (part->sum / (double) part->area), part->least), part->most) : part->low;
}

/* Everything but what is to be solved. */
static void
fill_rest (const Work *work)
{
  const CeldSystem *e = work->system;
  size_t            n = (size_t) e->width * (size_t) e->height;

  memcpy (work->depth, e->level, n * sizeof *e->level);
  EACH_STRETCH (work, 0, e->height, y, s)
    {
      const Part *part = &work->part[s->part];
      size_t      p = pixel_at (e, s->x, y), end = pixel_at (e, s->end, y);

      if (!part->changed)
        memcpy (work->depth + p, e->last + p, (end - p) * sizeof *e->last);
      else if (!is_solved (part))
        for (float depth = constant_depth (part); p < end; p++)
          work->depth[p] = depth;
    }
}

/* ------------------------------------------------------------------ the others */

/* Pixel i of the box is drawn to the fixed pixel q across the edge of pixel (x,y) to its right or lower neighbour. */
static void
hold (const CeldSystem *e, const Box *box, size_t i, size_t q, int x, int y, int right)
{
  float weight = celd_edge_weight (&e->edges, e->level, x, y, right, !right);

  box->diagonal[i] += weight;
  box->b[i]        += weight * e->level[q];
}

/* The equations of a stretch of row y; its first pixel is i in the box. */
static void
write_equations (const CeldSystem *e, const CeldStretch *s, int y, size_t i, const Box *box)
{
  size_t w = (size_t) e->width, p = pixel_at (e, s->x, y);

  if (s->x > 0 && e->fixed[p - 1])
    hold (e, box, i, p - 1, s->x - 1, y, 1);
  for (int x = s->x; x < s->end; x++, i++, p++)
    {
      if (x + 1 < s->end)
        box->east[i] = celd_edge_weight (&e->edges, e->level, x, y, 1, 0);
      else if (s->end < e->width && e->fixed[p + 1])
        hold (e, box, i, p + 1, x, y, 1);
      if (y > 0 && e->fixed[p - w])
        hold (e, box, i, p - w, x, y - 1, 0);
      if (y + 1 < e->height && e->fixed[p + w])
        hold (e, box, i, p + w, x, y, 0);
      else if (y + 1 < e->height)
        box->south[i] = celd_edge_weight (&e->edges, e->level, x, y, 0, 1);
    }
}

/* Calls for every stretch of the parts that are solved in the box. */
#define EACH_OF_BOX(work, in, y, s) \
  EACH_STRETCH (work, (in)->box.y, (in)->box.y + (in)->box.height, y, s) \
    if ((work)->group[s->part] == (in)->group)

static size_t
in_box (const Box *box, int x, int y)
{
  return (size_t) (y - box->box.y) * (size_t) box->box.width + (size_t) (x - box->box.x);
}

/* The equations of a box and where to start from; what is masked has a value between the others.  Returns the range. */
static double
write_box (const Work *work, Box *box)
{
  const CeldSystem *e = work->system;
  size_t            n = (size_t) box->box.width * (size_t) box->box.height;
  float             low = INFINITY, high = -INFINITY;

  for (size_t k = 0; k < work->parts.n; k++)
    if (work->group[k] == box->group)
      {
        low  = fminf (low, work->part[k].low);
        high = fmaxf (high, work->part[k].high);
      }
  for (size_t i = 0; i < n; i++)
    {
      box->diagonal[i] = 1;
      box->b[i] = box->x[i] = low;
    }
  EACH_OF_BOX (work, box, y, s)
    {
      const Part *part = &work->part[s->part];

      for (int x = s->x; x < s->end; x++)
        {
          size_t i = in_box (box, x, y), p = pixel_at (e, x, y);

          box->diagonal[i] = box->b[i] = 0;
          box->x[i] = fminf (fmaxf (e->last ? e->last[p] : e->level[p], part->low), part->high);
        }
      write_equations (e, s, y, in_box (box, s->x, y), box);
    }
  return (double) high - (double) low;
}

/* Kept within what reaches the part: the solver's error must not carry it beyond. */
static void
read_box (const Work *work, const Box *box)
{
  EACH_OF_BOX (work, box, y, s)
    {
      const Part *part = &work->part[s->part];

      for (int x = s->x; x < s->end; x++)
        work->depth[pixel_at (work->system, x, y)] = fminf (fmaxf (box->x[in_box (box, x, y)], part->low), part->high);
    }
}

static CeldStatus
solve_box (const Work *work, Box *box, const CeldHost *host, CeldSolve *solve)
{
  const CeldSystem *e = work->system;
  int               w = box->box.width, h = box->box.height;
  size_t            n = (size_t) w * (size_t) h;
  CeldLaplace      *laplace = NULL;
  CeldHostPart          part[2];
  CeldHost          setting_up = celd_host_part (&part[0], host, 0, 0.2), solving = celd_host_part (&part[1], host, 0.2, 1);
  CeldStatus        status;
  double            range;

  box->east     = celd_alloc0 (n, sizeof *box->east);
  box->south    = celd_alloc0 (n, sizeof *box->south);
  box->diagonal = celd_alloc (n, sizeof *box->diagonal);
  box->b        = celd_alloc (n, sizeof *box->b);
  box->x        = celd_alloc (n, sizeof *box->x);
  status = box->east && box->south && box->diagonal && box->b && box->x ? CELD_OK : CELD_NO_MEMORY;
  if (status != CELD_OK)
    goto done;
  range  = write_box (work, box);
  status = celd_lap_setup (w, h, box->east, box->south, box->diagonal, NULL, &setting_up, &laplace);
  celd_free (box->east);
  celd_free (box->south);
  celd_free (box->diagonal);
  box->east = box->south = box->diagonal = NULL;
  if (status == CELD_OK)
    status = celd_lap_solve (laplace, 1, box->b, box->x, e->tolerance * e->range / range, &solving, solve);
  if (status == CELD_OK)
    {
      read_box (work, box);
      solve->error *= range / e->range;
    }

done:
  celd_lap_free (laplace);
  celd_free (box->east);
  celd_free (box->south);
  celd_free (box->diagonal);
  celd_free (box->b);
  celd_free (box->x);
  return status;
}

static CeldStatus
solve_parts (Work *work, const CeldHost *host, CeldSolve *solve)
{
  CeldRect   bounds[CELD_MOST_GROUPS], *box = celd_alloc (work->parts.n, sizeof *box);
  size_t     groups = 0;
  CeldStatus status;

  work->group = celd_alloc (work->parts.n, sizeof *work->group);
  status      = box && work->group ? CELD_OK : CELD_NO_MEMORY;
  if (status == CELD_OK)
    {
      for (size_t k = 0; k < work->parts.n; k++)
        box[k] = work->part[k].box;
      groups = celd_boxes_group (box, work->parts.n, work->group, bounds);
    }
  *solve = (CeldSolve) { .converged = true };
  for (size_t g = 0; g < groups && status == CELD_OK; g++)
    {
      CeldHostPart  part;
      CeldHost  share = celd_host_part (&part, host, (double) g / (double) groups, (double) (g + 1) / (double) groups);
      Box       one = { .box = bounds[g], .group = (uint32_t) g };
      CeldSolve how;

      status = solve_box (work, &one, &share, &how);
      if (status != CELD_OK)
        break;
      solve->converged  = solve->converged && how.converged;
      solve->iterations = how.iterations > solve->iterations ? how.iterations : solve->iterations;
      solve->error      = fmax (solve->error, how.error);
    }
  celd_free (box);
  return status;
}

CeldStatus
celd_system_solve (const CeldSystem *system, const CeldHost *host, float *depth, CeldSolve *solve)
{
  Work       work = { .system = system, .depth = depth };
  CeldHostPart   part[2];
  CeldHost   finding = celd_host_part (&part[0], host, 0, 0.2), solving = celd_host_part (&part[1], host, 0.2, 1);
  CeldStatus status = celd_parts_find (system->width, system->height, system->level, system->fixed, &system->edges,
                                       &finding, &work.parts);

  if (status != CELD_OK)
    return status;
  work.part = celd_alloc (work.parts.n + 1, sizeof *work.part);
  status    = work.part ? CELD_OK : CELD_NO_MEMORY;
  if (status == CELD_OK)
    {
      look_at_parts (&work);
      add_levels (&work);
      fill_rest (&work);
      status = solve_parts (&work, &solving, solve);
    }
  celd_parts_clear (&work.parts);
  celd_free (work.part);
  celd_free (work.group);
  return status;
}
