/* The active inequalities of a quadratic program on a graph Laplacian, as a forest.
 *
 * An active inequality u_a = u_b + gap is a rigid link.  Linearly independent links make a forest, so that dependence
 * is read off a graph and never decided by rounding, and multipliers are flows through the trees, from the leaves to
 * the roots.  One link more or less changes H (quadratic-matrix.c) by a matrix of rank one; such an update subtracts,
 * so its accuracy is checked, and H is computed anew where digits have been lost.
 *
 * Cost: O(n) for trees and flows, O(n^2) for an update of H.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "solve/quadratic-private.h"
#include "solve/quadratic.h"

#include <math.h>

#define MAX_DISAGREEMENT 1e-6 /* relative difference of two curvatures, beyond which H is inaccurate; chosen */

/* ------------------------------------------------------------------ trees */

/* The links at node i are entry[start[i]] .. before start[i + 1], as places in `active`. */
static void
list_links (const CeldForest *f, uint32_t *start, uint32_t *entry)
{
  for (size_t i = 0; i <= f->n; i++)
    start[i] = 0;
  for (size_t l = 0; l < f->n_active; l++)
    {
      start[f->inequality[f->active[l]].a]++;
      start[f->inequality[f->active[l]].b]++;
    }
  for (size_t i = 0; i < f->n; i++)
    start[i + 1] += start[i];
  for (size_t l = f->n_active; l-- > 0;)
    {
      entry[--start[f->inequality[f->active[l]].a]] = (uint32_t) l;
      entry[--start[f->inequality[f->active[l]].b]] = (uint32_t) l;
    }
}

/* Adds the tree of `root` to the order, breadth first, behind the `done` nodes that are in it. */
static size_t
walk_tree (CeldForest *f, const uint32_t *start, const uint32_t *entry, uint32_t root, size_t done)
{
  size_t at = done;

  f->order[done++] = root;
  f->link[root] = CELD_NO_LINK;
  f->parent[root] = root;
  f->offset[root] = 0;
  f->tree[root] = (uint32_t) f->n_trees;
  for (; at < done; at++)
    {
      uint32_t i = f->order[at];

      for (uint32_t e = start[i]; e < start[i + 1]; e++)
        if (entry[e] != f->link[i])
          {
            const CeldInequality *link = &f->inequality[f->active[entry[e]]];
            uint32_t              j    = link->a == i ? link->b : link->a;

            f->order[done++] = j;
            f->link[j] = entry[e];
            f->parent[j] = i;
            f->offset[j] = f->offset[i] + (link->a == j ? link->gap : -link->gap);
            f->tree[j] = f->tree[i];
          }
    }
  return done;
}

void
celd_forest_walk (CeldForest *f)
{
  uint32_t *start = f->entry, *entry = f->entry + f->n + 1;
  size_t    done = 0;

  list_links (f, start, entry);
  for (size_t i = 0; i < f->n; i++)
    f->tree[i] = UINT32_MAX;
  f->n_trees = 0;
  for (uint32_t i = 0; i < f->n; i++)
    if (f->tree[i] == UINT32_MAX)
      {
        done = walk_tree (f, start, entry, i, done);
        f->n_trees++;
      }
  celd_roots (f->body, f->n_components);
  for (size_t l = 0; f->n_components > 1 && l < f->n_active; l++)
    celd_join (f->body, f->component[f->inequality[f->active[l]].a], f->component[f->inequality[f->active[l]].b]);
  for (uint32_t c = 0; c < f->n_components; c++)
    f->body[c] = celd_root (f->body, c);
}

/* ------------------------------------------------------------------ flow */

void
celd_forest_flow (const CeldForest *f, double *force, double *r)
{
  for (size_t at = f->n; at-- > 0;)
    {
      uint32_t i = f->order[at], l = f->link[i];

      if (l == CELD_NO_LINK)
        continue;
      r[l] = f->inequality[f->active[l]].a == i ? force[i] : -force[i];
      force[f->parent[i]] += force[i];
    }
}

/* ------------------------------------------------------------------ one link more, one link less */

CELD_CLONES static void
add_square (size_t n, const double *restrict x, double factor, double *restrict matrix)
{
  for (size_t i = 0; i < n; i++)
    {
      double part = factor * x[i];

      if (part != 0)
        for (size_t j = 0; j < n; j++)
          matrix[i * n + j] += part * x[j];
    }
}

void
celd_forest_add (CeldForest *f, uint32_t p, const double *z, double curvature)
{
  f->active[f->n_active++] = p;
  celd_forest_walk (f);
  add_square (f->n, z, -1 / curvature, f->inverse);
  f->fresh = false;
}

/* Holds the body of node `end` at that node: H then has motions of that body alone in its rows. */
static void
hold_at (CeldForest *f, uint32_t end)
{
  const double *held = f->inverse + end * f->n;
  uint32_t      body = f->body[f->component[end]];

  memcpy (f->row, held, f->n * sizeof *held);
  for (size_t i = 0; i < f->n; i++)
    for (size_t j = 0; j < f->n && f->body[f->component[i]] == body; j++)
      {
        double *h = &f->inverse[i * f->n + j];

        *h = f->body[f->component[j]] == body ? *h - f->row[i] - f->row[j] + f->row[end] : 0;
      }
}

void
celd_forest_join (CeldForest *f, uint32_t p)
{
  uint32_t a = f->inequality[p].a, b = f->inequality[p].b, body = f->body[f->component[a]];

  hold_at (f, a);
  memcpy (f->row, f->inverse + b * f->n, f->n * sizeof *f->row);
  for (size_t i = 0; i < f->n; i++)
    for (size_t j = 0; j < f->n && f->body[f->component[i]] == body; j++)
      if (f->body[f->component[j]] == body)
        f->inverse[i * f->n + j] += f->row[b];
      else
        f->inverse[i * f->n + j] = f->inverse[j * f->n + i] = f->row[j];
  f->active[f->n_active++] = p;
  celd_forest_walk (f);
  f->fresh = false;
}

/* 1 for all nodes below the link in this place, else 0. */
static void
mark_branch (const CeldForest *f, size_t place, double *mark)
{
  for (size_t at = 0; at < f->n; at++)
    {
      uint32_t i = f->order[at];

      mark[i] = f->link[i] == place ? 1 : f->link[i] == CELD_NO_LINK ? 0 : mark[f->parent[i]];
    }
}

bool
celd_forest_is_inaccurate (const CeldForest *f, double curvature, const double *x, const double *force)
{
  double energy = 0;

  for (size_t i = 0; i < f->n; i++)
    energy += x[i] * force[i];
  return !f->fresh && !(fabs (energy - curvature) <= MAX_DISAGREEMENT * energy);
}

bool
celd_forest_drop (CeldForest *f, size_t place, double *way, double *force, double *curvature)
{
  const CeldInequality *link = &f->inequality[f->active[place]];

  mark_branch (f, place, f->row);
  f->active[place] = f->active[--f->n_active];
  celd_forest_walk (f);
  *curvature = 0;
  f->fresh = false;
  if (f->body[f->component[link->a]] != f->body[f->component[link->b]])
    {
      hold_at (f, link->a);
      hold_at (f, link->b);
      return true;
    }
  celd_forest_force (f, f->row, force);
  celd_forest_motion (f, force, way);
  for (size_t i = 0; i < f->n; i++)
    {
      way[i] = f->row[i] - way[i];
      *curvature += way[i] * force[i];
    }
  celd_forest_force (f, way, force);
  if (!(*curvature > 0) || celd_forest_is_inaccurate (f, *curvature, way, force))
    {
      *curvature = 0;
      return celd_forest_set_up (f);
    }
  add_square (f->n, way, 1 / *curvature, f->inverse);
  return true;
}
