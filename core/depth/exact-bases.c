/* Harmonic bases of the nodes: all the Laplacian solutions that the exact program needs.
 *
 * For n nodes: one set-up and n - 1 solutions, CELD_LANES at a time.  After that the values of nodes, inequalities and
 * equalities can change without another solution.  A single pixel becomes a node with one solution and stops being one
 * with none (exact-nodes.c).
 *
 * Memory: 4 bytes per pixel for each node but one, in steps of CELD_LANES, and 4 for the node of each pixel; the memory
 * of the solver is freed as soon as the bases are made.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "depth/depth.h"
#include "solve/laplace.h"

#define COMPOSED_ROWS 16 /* rows of a job when depth is composed */

/* ------------------------------------------------------------------ lanes */

CeldStatus
celd_bases_grow (CeldHarmonicBases *b, size_t n_groups)
{
  while (b->n_groups < n_groups)
    {
      float *lanes = celd_alloc0 ((size_t) b->width * (size_t) b->height, CELD_LANES * sizeof *lanes);

      if (!lanes || celd_append (b->group, b->n_groups, b->group_capacity, lanes) != CELD_OK)
        {
          celd_free (lanes);
          return CELD_NO_MEMORY;
        }
    }
  return CELD_OK;
}

void
celd_bases_shrink (CeldHarmonicBases *b, size_t n_groups)
{
  while (b->n_groups > n_groups)
    celd_free (b->group[--b->n_groups]);
}

void
celd_bases_clear (CeldHarmonicBases *bases)
{
  celd_bases_shrink (bases, 0);
  celd_free (bases->group);
  celd_free (bases->node);
  celd_free (bases->pixel);
  celd_free (bases->stiffness);
  *bases = (CeldHarmonicBases) {
    .width = bases->width, .height = bases->height, .east = bases->east, .south = bases->south
  };
}

/* ------------------------------------------------------------------ all nodes at once */

/* Chooses the old node that each new one starts from: that of the first pixel that was in one; 0 if there is none. */
static void
find_starts (const CeldHarmonicBases *b, const uint32_t *node, uint32_t n_sets, const size_t *point, size_t n_points,
             uint32_t *start)
{
  for (size_t p = 0; b->node && p < (size_t) b->width * (size_t) b->height; p++)
    if (node[p] && !start[node[p]])
      start[node[p]] = b->node[p];
  for (size_t i = 0; b->node && i < n_points; i++)
    start[n_sets + 1 + i] = b->node[point[i]];
}

typedef struct
{
  CeldHarmonicBases *bases;
  const uint32_t    *start;        /* of each new node */
  uint32_t           n_old, n_new;
  float             *work;         /* of each row: room for the old bases of a pixel */
} Start;

/* Fills in the start: exact on the nodes, elsewhere the old bases in the order of the new nodes. */
static void
start_row (void *data, int y)
{
  Start             *s = data;
  CeldHarmonicBases *b = s->bases;
  size_t             w = (size_t) b->width, first = (size_t) y * w;
  float             *old = s->work + (size_t) y * ((size_t) s->n_old + 1);

  for (size_t p = first; p < first + w; p++)
    {
      uint32_t here = b->node[p];

      old[0] = 0;
      if (s->n_old)
        old[1] = 1;
      for (uint32_t k = 2; k <= s->n_old; k++)
        {
          old[k] = celd_bases_lane (b, k)[p * CELD_LANES];
          old[1] -= old[k];
        }
      for (size_t k = 0; k < b->n_groups * CELD_LANES; k++)
        b->group[k / CELD_LANES][p * CELD_LANES + k % CELD_LANES] =
          here || k + 2 > s->n_new ? here == k + 2 : old[s->start[k + 2]];
    }
}

/* Sets the nodes; bases become the start of the solutions. */
static CeldStatus
place_nodes (CeldHarmonicBases *b, const uint32_t *node, uint32_t n_sets, const size_t *point, size_t n_points,
             const CeldHost *host)
{
  size_t     pixels = (size_t) b->width * (size_t) b->height;
  uint32_t   n = n_sets + (uint32_t) n_points, n_old = b->n;
  uint32_t  *start = celd_alloc0 ((size_t) n + 1, sizeof *start), *own = celd_alloc (pixels, sizeof *own);
  size_t    *pixel = celd_alloc (n_points, sizeof *pixel);
  Start      s = { b, start, n_old, n, celd_alloc ((size_t) b->height, ((size_t) n_old + 1) * sizeof (float)) };
  CeldStatus status = start && own && pixel && s.work ? celd_bases_grow (b, celd_bases_groups (n)) : CELD_NO_MEMORY;

  if (status == CELD_OK)
    {
      find_starts (b, node, n_sets, point, n_points, start);
      memcpy (own, node, pixels * sizeof *own);
      for (size_t i = 0; i < n_points; i++)
        own[pixel[i] = point[i]] = n_sets + 1 + (uint32_t) i;
      celd_free (b->node);
      celd_free (b->pixel);
      b->node   = own;
      b->pixel  = pixel;
      b->pixel_capacity = n_points;
      b->n      = n;
      b->n_sets = n_sets;
      celd_parallel_for (host, b->height, start_row, &s);
      celd_bases_shrink (b, celd_bases_groups (n));
      own   = NULL;
      pixel = NULL;
    }
  celd_free (start);
  celd_free (own);
  celd_free (pixel);
  celd_free (s.work);
  return status;
}

CeldStatus
celd_bases_set_up (const CeldHarmonicBases *b, const CeldHost *host, CeldLaplace **laplace)
{
  size_t     pixels = (size_t) b->width * (size_t) b->height;
  uint8_t   *fixed = celd_alloc (pixels, 1);
  CeldStatus status = CELD_NO_MEMORY;

  for (size_t p = 0; fixed && p < pixels; p++)
    fixed[p] = b->node[p] != 0;
  if (fixed)
    status = celd_lap_setup (b->width, b->height, b->east, b->south, NULL, fixed, host, laplace);
  celd_free (fixed);
  return status;
}

/* Clamps the solutions to [0,1], and makes them exact on the nodes. */
static void
clean_group (const CeldHarmonicBases *b, size_t group)
{
  float *h = b->group[group];

  for (size_t p = 0; p < (size_t) b->width * (size_t) b->height; p++)
    for (size_t k = 0; k < CELD_LANES; k++, h++)
      *h = b->node[p] ? b->node[p] == group * CELD_LANES + k + 2 : *h > 0 ? *h < 1 ? *h : 1 : 0;
}

CeldStatus
celd_bases_make (CeldHarmonicBases *bases, const uint32_t *node, uint32_t n_sets, const size_t *point, size_t n_points,
                 double tolerance, const CeldHost *host, CeldSolve *solve)
{
  CeldHarmonicBases *b = bases;
  CeldLaplace       *laplace = NULL;
  CeldSolve          worst = { .converged = true };
  CeldHostPart       part[2];
  CeldHost           setting_up = celd_host_part (&part[0], host, 0, 0.1);
  CeldHost           summing = celd_host_part (&part[1], host, 0.95, 1);
  CeldStatus         status = place_nodes (b, node, n_sets, point, n_points, host);

  if (status == CELD_OK && b->n_groups)
    status = celd_bases_set_up (b, &setting_up, &laplace);
  for (size_t g = 0; g < b->n_groups && status == CELD_OK; g++)
    {
      double       from = 0.1 + 0.85 * (double) g / (double) b->n_groups;
      CeldHostPart share;
      CeldHost     solving = celd_host_part (&share, host, from, from + 0.85 / (double) b->n_groups);
      CeldSolve    one = { 0 };

      status = celd_lap_solve_lanes (laplace, NULL, b->group[g], tolerance, &solving, &one);
      if (status == CELD_OK)
        clean_group (b, g);
      celd_solve_join (&worst, &one);
    }
  celd_lap_free (laplace);
  if (status == CELD_OK)
    status = celd_stiffness (b, &summing);
  if (status == CELD_OK)
    *solve = worst;
  else
    celd_bases_clear (b);
  return status;
}

/* ------------------------------------------------------------------ depth */

typedef struct
{
  const CeldHarmonicBases *bases;
  CeldPlane               *depth;
  float                   *value;       /* of each lane: u_k - u_1 */
  float                    base, low, high;
} Composition;

/* row[x] += sum over the lanes of a group of basis times value. */
CELD_CLONES static void
add_group (int n, const float *restrict h, const float *restrict value, float *restrict row)
{
  float v[CELD_LANES];

  memcpy (v, value, sizeof v);
  for (int x = 0; x < n; x++, h += CELD_LANES)
    row[x] += ((h[0] * v[0] + h[4] * v[4]) + (h[2] * v[2] + h[6] * v[6])) +
              ((h[1] * v[1] + h[5] * v[5]) + (h[3] * v[3] + h[7] * v[7]));
}

static void
compose_band (void *data, int band)
{
  const Composition       *c = data;
  const CeldHarmonicBases *b = c->bases;

  for (int y = band * COMPOSED_ROWS; y < b->height && y < (band + 1) * COMPOSED_ROWS; y++)
    {
      float *row = &CELD_AT (c->depth, 0, y);

      for (int x = 0; x < b->width; x++)
        row[x] = c->base;
      for (size_t g = 0; g < b->n_groups; g++)
        add_group (b->width, b->group[g] + (size_t) y * (size_t) b->width * CELD_LANES, c->value + g * CELD_LANES, row);
      for (int x = 0; x < b->width; x++)
        row[x] = row[x] > c->low ? row[x] < c->high ? row[x] : c->high : c->low;
    }
}

CeldStatus
celd_bases_compose (const CeldHarmonicBases *bases, const double *u, const CeldHost *host, CeldPlane *depth)
{
  Composition c = {
    bases, depth, celd_alloc0 (bases->n_groups, CELD_LANES * sizeof (float)), (float) u[0], (float) u[0], (float) u[0]
  };

  if (!c.value)
    return CELD_NO_MEMORY;
  for (uint32_t k = 1; k < bases->n; k++)
    {
      c.value[k - 1] = (float) (u[k] - u[0]);
      c.low  = (float) u[k] < c.low ? (float) u[k] : c.low;
      c.high = (float) u[k] > c.high ? (float) u[k] : c.high;
    }
  celd_parallel_for (host, (bases->height + COMPOSED_ROWS - 1) / COMPOSED_ROWS, compose_band, &c);
  celd_free (c.value);
  return CELD_OK;
}
