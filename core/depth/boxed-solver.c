/* Laplacian systems of connected components, solved in their bounding boxes: the rest of each box is masked.
 *
 * Boxes that overlap or lie close are solved as one.  Cost: that of the Laplacian solver on the boxes.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "depth/depth.h"
#include "solve/laplace.h"

#define BOX_SLACK 4096 /* pixels that merging two boxes may waste: setting up a box costs about as much (chosen) */

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
  size_t       rhs = (size_t) system->n_rhs;
  double       tolerance = 0;
  CeldLaplace *laplace = NULL;
  CeldHostPart part[2];
  CeldHost     setting_up = celd_host_part (&part[0], host, 0, 0.2), solving = celd_host_part (&part[1], host, 0.2, 1);
  CeldStatus   status;

  box->n        = (size_t) box->rect.width * (size_t) box->rect.height;
  box->east     = celd_alloc0 (box->n, sizeof *box->east);
  box->south    = celd_alloc0 (box->n, sizeof *box->south);
  box->diagonal = celd_alloc0 (box->n, sizeof *box->diagonal);
  box->b        = celd_alloc0 (box->n, rhs * sizeof *box->b);
  box->x        = celd_alloc0 (box->n, rhs * sizeof *box->x);
  status = box->east && box->south && box->diagonal && box->b && box->x ? CELD_OK : CELD_NO_MEMORY;
  if (status == CELD_OK)
    {
      tolerance = system->write (system->data, box);
      status    = celd_lap_setup (box->rect.width, box->rect.height, box->east, box->south, box->diagonal, NULL,
                                  &setting_up, &laplace);
      free_weights (box); /* before the solution, which needs memory of its own */
    }
  if (status == CELD_OK)
    status = celd_lap_solve (laplace, system->n_rhs, box->b, box->x, tolerance, &solving, solve);
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
