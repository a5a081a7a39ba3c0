/* Connected components of a picture as runs of pixels, and Laplacian systems of components, solved in their bounding
 * boxes.
 *
 * A picture has few runs, so what is done once per run costs next to nothing.  One pass over the pixels finds the runs;
 * runs of neighbouring rows are joined where they overlap, which is mostly decided by looking at one pixel.
 *
 * Boxes that overlap or lie close are solved as one; what is not of the components in a box is masked.
 *
 * Cost: O(pixels) to find components; to solve, that of the Laplacian solver on the boxes.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "depth/depth.h"
#include "solve/laplace.h"

#define BOX_SLACK 4096 /* pixels that merging two boxes may waste: setting up a box costs about as much (chosen) */

/* ------------------------------------------------------------------ components: runs of a row */

typedef struct { const float *level; const uint8_t *fixed; const CeldDepthEdges *edges; } Joins;

CELD_CLONES static void
mark_levels (const float *restrict level, int n, uint8_t *restrict mark)
{
  for (int x = 1; x < n; x++)
    mark[x] = level[x] == level[x - 1] ? 0 : 0x80;
}

CELD_CLONES static void
mark_fixed (const uint8_t *restrict fixed, int n, uint8_t *restrict mark)
{
  for (int x = 1; x < n; x++)
    mark[x] = (uint8_t) (mark[x] | (!fixed[x] == !fixed[x - 1] ? 0 : 0x80));
}

static bool
is_free (const Joins *j, size_t pixel)
{
  return !j->fixed || !j->fixed[pixel];
}

static CeldStatus
add_run (CeldRunComponents *components, size_t *n, int x, int end)
{
  return celd_append (components->run, *n, components->run_capacity, (CeldPixelRun) { x, end, 0 });
}

/* Ends a run where fixed pixels begin or end, and where an edge between levels is cut. */
static CeldStatus
find_row_runs (const Joins *j, CeldRunComponents *components, int y, uint8_t *mark, size_t *n)
{
  int        w = components->width;
  size_t     first = (size_t) y * (size_t) w;
  CeldStatus status = CELD_OK;

  mark[0] = 0;
  mark_levels (j->level + first, w, mark);
  if (j->fixed)
    mark_fixed (j->fixed + first, w, mark);
  for (int x = 0, end; x < w && status == CELD_OK; x = end)
    {
      bool open = is_free (j, first + (size_t) x);

      end = celd_next_marked (w, mark, x + 1);
      while (open && j->edges && end < w && is_free (j, first + (size_t) end) &&
             celd_edge_weight (j->edges, j->level, end - 1, y, 1, 0) > 0)
        end = celd_next_marked (w, mark, end + 1);
      if (open)
        status = add_run (components, n, x, end);
    }
  return status;
}

/* ------------------------------------------------------------------ components: rows */

/* Whether any of the pixels x .. end - 1 of row y is connected to the one above it. */
static bool
meet (const Joins *j, int width, int y, int x, int end)
{
  const float *here = j->level + (size_t) y * (size_t) width, *above = here - width;

  for (int u = x; u < end; u++)
    if (here[u] == above[u] || (j->edges && celd_edge_weight (j->edges, j->level, u, y - 1, 0, 1) > 0))
      return true;
  return false;
}

static void
join_row (const Joins *j, const CeldRunComponents *components, int y, uint32_t *parent)
{
  const CeldPixelRun *s = components->run;
  size_t              a = components->row[y - 1], b = components->row[y];

  while (a < components->row[y] && b < components->row[y + 1])
    {
      int x = s[a].x > s[b].x ? s[a].x : s[b].x, end = s[a].end < s[b].end ? s[a].end : s[b].end;

      if (x < end && celd_root (parent, (uint32_t) a) != celd_root (parent, (uint32_t) b) &&
          meet (j, components->width, y, x, end))
        celd_join (parent, (uint32_t) a, (uint32_t) b);
      if (s[a].end < s[b].end)
        a++;
      else
        b++;
    }
}

/* In the order of the runs: a root comes before its members. */
static void
number_components (CeldRunComponents *components, uint32_t *parent)
{
  for (size_t i = 0; i < components->row[components->height]; i++)
    {
      uint32_t root = celd_root (parent, (uint32_t) i);

      components->run[i].component = root == i ? (uint32_t) components->n++ : components->run[root].component;
    }
}

CeldStatus
celd_run_components_find (int width, int height, const float *level, const uint8_t *fixed, const CeldDepthEdges *edges,
                          const CeldHost *host, CeldRunComponents *components)
{
  Joins             j = { level, fixed, edges };
  CeldRunComponents found = {
    .width = width, .height = height, .row = celd_alloc0 ((size_t) height + 1, sizeof (size_t))
  };
  uint8_t          *mark = celd_alloc ((size_t) width, 1);
  uint32_t         *parent = NULL;
  size_t            n = 0;
  CeldStatus        status;

  /* A pointer even where all pixels are fixed. */
  status = celd_reserve (&found.run, 1, &found.run_capacity, sizeof *found.run) && found.row && mark ? CELD_OK
                                                                                                      : CELD_NO_MEMORY;
  for (int y = 0; y < height && status == CELD_OK; y++)
    {
      status = y % 64 ? CELD_OK : celd_progress (host, (double) y / height);
      if (status == CELD_OK)
        status = find_row_runs (&j, &found, y, mark, &n);
      found.row[y + 1] = n;
    }
  if (status == CELD_OK)
    {
      parent = celd_alloc (n + 1, sizeof *parent);
      status = parent && n < UINT32_MAX ? CELD_OK : CELD_NO_MEMORY;
    }
  if (status == CELD_OK)
    {
      celd_roots (parent, n);
      for (int y = 1; y < height; y++)
        join_row (&j, &found, y, parent);
      number_components (&found, parent);
      *components = found;
    }
  else
    celd_run_components_clear (&found);
  celd_free (mark);
  celd_free (parent);
  return status;
}

void
celd_run_components_clear (CeldRunComponents *components)
{
  celd_free (components->row);
  celd_free (components->run);
  *components = (CeldRunComponents) { 0 };
}

uint32_t
celd_run_component_at (const CeldRunComponents *components, int x, int y)
{
  size_t low = components->row[y], high = components->row[y + 1];

  while (high - low > 1)
    {
      size_t middle = low + (high - low) / 2;

      if (components->run[middle].x <= x)
        low = middle;
      else
        high = middle;
    }
  return components->run[low].component;
}

bool
celd_run_marked (const CeldRunComponents *components, const CeldPixelRun *run, int y, const uint8_t *mark)
{
  return memchr (mark + (size_t) y * (size_t) components->width + (size_t) run->x, 1,
                 (size_t) (run->end - run->x)) != NULL;
}

/* ------------------------------------------------------------------ groups of boxes */

void
celd_box_add_run (CeldRect *box, const CeldPixelRun *run, int y)
{
  *box = celd_rect_union (*box, (CeldRect) { run->x, y, run->end - run->x, 1 });
}

static int64_t
area (CeldRect box)
{
  return (int64_t) box.width * box.height;
}

/* How many pixels of the common bounding box are in neither; negative where the boxes overlap. */
static int64_t
waste (CeldRect a, CeldRect b)
{
  return area (celd_rect_union (a, b)) - area (a) - area (b);
}

/* Merges two groups that have come to overlap or lie close; false if there are no such groups. */
static bool
merge_groups (size_t n_boxes, uint32_t *group, CeldRect *bounds, size_t *n)
{
  for (size_t a = 0; a < *n; a++)
    for (size_t b = a + 1; b < *n; b++)
      if (waste (bounds[a], bounds[b]) <= BOX_SLACK)
        {
          bounds[a] = celd_rect_union (bounds[a], bounds[b]);
          bounds[b] = bounds[--*n];
          for (size_t k = 0; k < n_boxes; k++)
            group[k] = group[k] == b ? (uint32_t) a : group[k] == *n ? (uint32_t) b : group[k];
          return true;
        }
  return false;
}

size_t
celd_boxes_group (const CeldRect *box, size_t n, uint32_t *group, CeldRect bounds[CELD_MOST_GROUPS])
{
  size_t groups = 0;

  for (size_t k = 0; k < n; k++)
    {
      size_t best = 0;

      group[k] = CELD_NO_GROUP;
      if (!box[k].width)
        continue;
      for (size_t g = 1; g < groups; g++)
        if (waste (bounds[g], box[k]) < waste (bounds[best], box[k]))
          best = g;
      if (groups < CELD_MOST_GROUPS && (!groups || waste (bounds[best], box[k]) > BOX_SLACK))
        bounds[best = groups++] = box[k];
      bounds[best] = celd_rect_union (bounds[best], box[k]);
      group[k]     = (uint32_t) best;
    }
  while (merge_groups (n, group, bounds, &groups))
    ;
  return groups;
}

/* ------------------------------------------------------------------ one box */

static void
free_weights (CeldBox *box)
{
  celd_free (box->east);
  celd_free (box->south);
  celd_free (box->diagonal);
  box->east = box->south = box->diagonal = NULL;
}

static CeldStatus
solve_box (const CeldBoxedSystem *system, CeldBox *box, const CeldHost *host, CeldSolve *solve)
{
  double       tolerance = 0;
  CeldLaplace *laplace = NULL;
  CeldHostPart part[2];
  CeldHost     setting_up = celd_host_part (&part[0], host, 0, 0.2), solving = celd_host_part (&part[1], host, 0.2, 1);
  CeldStatus   status;

  box->n        = (size_t) box->rect.width * (size_t) box->rect.height;
  box->east     = celd_alloc0 (box->n, sizeof *box->east);
  box->south    = celd_alloc0 (box->n, sizeof *box->south);
  box->diagonal = celd_alloc0 (box->n, sizeof *box->diagonal);
  box->b        = celd_alloc0 (box->n, sizeof *box->b);
  box->x        = celd_alloc0 (box->n, sizeof *box->x);
  status = box->east && box->south && box->diagonal && box->b && box->x ? CELD_OK : CELD_NO_MEMORY;
  if (status == CELD_OK)
    {
      tolerance = system->write (system->data, box);
      status    = celd_lap_setup (box->rect.width, box->rect.height, box->east, box->south, box->diagonal, NULL,
                                  &setting_up, &laplace);
      free_weights (box); /* before the solution, which needs memory of its own */
    }
  if (status == CELD_OK)
    status = celd_lap_solve (laplace, 1, box->b, box->x, tolerance, &solving, solve);
  if (status == CELD_OK)
    system->read (system->data, box, solve);
  celd_lap_free (laplace);
  free_weights (box);
  celd_free (box->b);
  celd_free (box->x);
  return status;
}

/* ------------------------------------------------------------------ all boxes */

void
celd_solve_join (CeldSolve *worst, const CeldSolve *one)
{
  worst->converged  = worst->converged && one->converged;
  worst->iterations = one->iterations > worst->iterations ? one->iterations : worst->iterations;
  worst->error      = one->error > worst->error ? one->error : worst->error;
}

CeldStatus
celd_boxed_solve (const CeldBoxedSystem *system, const CeldHost *host, CeldSolve *solve)
{
  CeldRect   rect[CELD_MOST_GROUPS];
  size_t     n = system->components->n, groups = 0;
  uint32_t  *group_of = celd_alloc (n, sizeof *group_of);
  CeldStatus status = group_of ? CELD_OK : CELD_NO_MEMORY;

  if (status == CELD_OK)
    groups = celd_boxes_group (system->bounds, n, group_of, rect);
  *solve = (CeldSolve) { .converged = true };
  for (size_t g = 0; g < groups && status == CELD_OK; g++)
    {
      CeldHostPart part;
      double       from = (double) g / (double) groups, to = (double) (g + 1) / (double) groups;
      CeldHost     share = celd_host_part (&part, host, from, to);
      CeldBox      box = { rect[g], system->components, group_of, (uint32_t) g, 0, NULL, NULL, NULL, NULL, NULL };
      CeldSolve    how;

      status = solve_box (system, &box, &share, &how);
      if (status == CELD_OK)
        celd_solve_join (solve, &how);
    }
  celd_free (group_of);
  return status;
}
