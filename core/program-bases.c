/* Harmonic bases of the nodes: all the Laplacian solutions that the exact program needs.
 *
 * One set-up and n - 1 solutions, CELD_LANES at a time, for n nodes.  After that values, inequalities and equalities
 * of nodes change without a solution.  A single pixel p becomes a node of its own with one solution g of  L g = 1 at
 * p, 0 on the nodes:  h_p = g / g(p), and every other basis gives up its share, h_k - h_k(p) h_p.  It stops being one
 * with none: its basis goes to the others in the proportion of their stiffness, so that the result is harmonic at p
 * again.
 *
 * Memory: 4 bytes a pixel for each node but one, in steps of CELD_LANES, and 4 for the node of each pixel; the solver's
 * own is given back as soon as the bases are made.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "program.h"

#define BAND 16 /* rows that one thread composes at once */

/* ------------------------------------------------------------------ lanes */

static float *
lane_of (const CeldBases *b, uint32_t node)
{
  return b->group[(node - 2) / CELD_LANES] + (node - 2) % CELD_LANES;
}

static size_t
groups_for (uint32_t n)
{
  return n > 1 ? (n - 2) / CELD_LANES + 1 : 0;
}

/* At least so many groups; new ones are zero. */
static CeldStatus
grow_groups (CeldBases *b, size_t n_groups)
{
  while (b->n_groups < n_groups)
    {
      float **group = celd_grow (b->group, b->n_groups + 1, sizeof *group);

      if (!group)
        return CELD_NO_MEMORY;
      b->group = group;
      group[b->n_groups] = celd_alloc0 ((size_t) b->width * (size_t) b->height, CELD_LANES * sizeof (float));
      if (!group[b->n_groups])
        return CELD_NO_MEMORY;
      b->n_groups++;
    }
  return CELD_OK;
}

static void
shrink_groups (CeldBases *b, size_t n_groups)
{
  while (b->n_groups > n_groups)
    celd_free (b->group[--b->n_groups]);
}

void
celd_bases_clear (CeldBases *bases)
{
  shrink_groups (bases, 0);
  celd_free (bases->group);
  celd_free (bases->node);
  celd_free (bases->pixel);
  celd_free (bases->stiffness);
  *bases = (CeldBases) {
    .width = bases->width, .height = bases->height, .east = bases->east, .south = bases->south
  };
}

/* ------------------------------------------------------------------ all nodes at once */

/* From which old node each new one starts: the one that had its first pixel of any; 0 = none. */
static void
find_starts (const CeldBases *b, const uint32_t *node, uint32_t n_sets, const size_t *point, size_t n_points,
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
  CeldBases      *bases;
  const uint32_t *start;        /* of each new node */
  uint32_t        n_old, n_new;
  float          *work;         /* of each row: the old bases of a pixel */
} Start;

/* Bases that are exact on the nodes and the old ones elsewhere, in the order of the new ones. */
static void
start_row (void *data, int y)
{
  Start     *s = data;
  CeldBases *b = s->bases;
  size_t     w = (size_t) b->width, first = (size_t) y * w;
  float     *old = s->work + (size_t) y * ((size_t) s->n_old + 1);

  for (size_t p = first; p < first + w; p++)
    {
      uint32_t here = b->node[p];

      old[0] = 0;
      if (s->n_old)
        old[1] = 1;
      for (uint32_t k = 2; k <= s->n_old; k++)
        {
          old[k] = lane_of (b, k)[p * CELD_LANES];
          old[1] -= old[k];
        }
      for (size_t k = 0; k < b->n_groups * CELD_LANES; k++)
        b->group[k / CELD_LANES][p * CELD_LANES + k % CELD_LANES] =
          here || k + 2 > s->n_new ? here == k + 2 : old[s->start[k + 2]];
    }
}

/* Takes over the nodes; the bases are what a solution starts from. */
static CeldStatus
place_nodes (CeldBases *b, const uint32_t *node, uint32_t n_sets, const size_t *point, size_t n_points,
             const CeldRun *run)
{
  size_t     pixels = (size_t) b->width * (size_t) b->height;
  uint32_t   n = n_sets + (uint32_t) n_points, n_old = b->n;
  uint32_t  *start = celd_alloc0 ((size_t) n + 1, sizeof *start), *own = celd_alloc (pixels, sizeof *own);
  size_t    *pixel = celd_grow (NULL, n_points, sizeof *pixel);
  Start      s = { b, start, n_old, n, celd_alloc ((size_t) b->height, ((size_t) n_old + 1) * sizeof (float)) };
  CeldStatus status = start && own && pixel && s.work ? grow_groups (b, groups_for (n)) : CELD_NO_MEMORY;

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
      b->n      = n;
      b->n_sets = n_sets;
      celd_each (run, b->height, start_row, &s);
      shrink_groups (b, groups_for (n));
      own   = NULL;
      pixel = NULL;
    }
  celd_free (start);
  celd_free (own);
  celd_free (pixel);
  celd_free (s.work);
  return status;
}

static CeldStatus
set_up (const CeldBases *b, const CeldRun *run, CeldLaplace **laplace)
{
  size_t     pixels = (size_t) b->width * (size_t) b->height;
  uint8_t   *fixed = celd_alloc (pixels, 1);
  CeldStatus status = CELD_NO_MEMORY;

  for (size_t p = 0; fixed && p < pixels; p++)
    fixed[p] = b->node[p] != 0;
  if (fixed)
    status = celd_lap_setup (b->width, b->height, b->east, b->south, NULL, fixed, run, laplace);
  celd_free (fixed);
  return status;
}

/* What a solution leaves a little outside [0,1] goes back; nodes are exact. */
static void
clean_group (const CeldBases *b, size_t group)
{
  float *h = b->group[group];

  for (size_t p = 0; p < (size_t) b->width * (size_t) b->height; p++)
    for (size_t k = 0; k < CELD_LANES; k++, h++)
      *h = b->node[p] ? b->node[p] == group * CELD_LANES + k + 2 : *h > 0 ? *h < 1 ? *h : 1 : 0;
}

static void
take_worst (CeldSolve *worst, const CeldSolve *one)
{
  worst->converged  = worst->converged && one->converged;
  worst->iterations = one->iterations > worst->iterations ? one->iterations : worst->iterations;
  worst->error      = one->error > worst->error ? one->error : worst->error;
}

CeldStatus
celd_bases_make (CeldBases *bases, const uint32_t *node, uint32_t n_sets, const size_t *point, size_t n_points,
                 double tolerance, const CeldRun *run, CeldSolve *solve)
{
  CeldBases   *b = bases;
  CeldLaplace *laplace = NULL;
  CeldSolve    worst = { .converged = true };
  CeldPart     part[2];
  CeldRun      setting_up = celd_run_part (&part[0], run, 0, 0.1), summing = celd_run_part (&part[1], run, 0.95, 1);
  CeldStatus   status = place_nodes (b, node, n_sets, point, n_points, run);

  if (status == CELD_OK && b->n_groups)
    status = set_up (b, &setting_up, &laplace);
  for (size_t g = 0; g < b->n_groups && status == CELD_OK; g++)
    {
      double    from = 0.1 + 0.85 * (double) g / (double) b->n_groups;
      CeldPart  share;
      CeldRun   solving = celd_run_part (&share, run, from, from + 0.85 / (double) b->n_groups);
      CeldSolve one = { 0 };

      status = celd_lap_solve_lanes (laplace, NULL, b->group[g], tolerance, 0, &solving, &one);
      if (status == CELD_OK)
        clean_group (b, g);
      take_worst (&worst, &one);
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

/* ------------------------------------------------------------------ one more node */

/* The basis of node n + 1 at pixel p from g, the answer to a source there that knows the nodes of the set-up: those
 * that were added since have what it takes to make it 0 on them, too. */
static void
make_basis (const CeldBases *b, size_t p, float *g)
{
  size_t pixels = (size_t) b->width * (size_t) b->height;

  for (uint32_t k = b->n; k > b->n_sets && k > 1; k--)
    {
      float        share = g[b->pixel[k - b->n_sets - 1]];
      const float *h     = lane_of (b, k);

      for (size_t q = 0; q < pixels && share != 0; q++)
        g[q] -= share * h[q * CELD_LANES];
    }

  float scale = g[p] > 0 ? 1 / g[p] : 0;

  for (size_t q = 0; q < pixels; q++)
    g[q] = b->node[q] ? 0 : g[q] > 0 ? g[q] * scale < 1 ? g[q] * scale : 1 : 0;
  g[p] = 1;
}

/* K' of the bases h_k - a_k h and h, from the energies of h with the others and its own; a_k = h_k (p). */
static void
extend_stiffness (const CeldBases *b, const double *a, const double *with, double own, double *k)
{
  size_t n = b->n, m = n + 1;

  for (size_t i = 0; i < n; i++)
    for (size_t j = 0; j < n; j++)
      k[i * m + j] = b->stiffness[i * n + j] - a[i] * with[j] - a[j] * with[i] + a[i] * a[j] * own;
  for (size_t i = 0; i < n; i++)
    k[i * m + n] = k[n * m + i] = with[i] - a[i] * own;
  k[n * m + n] = own;
}

/* The other bases give up their share, and the new one takes its lane. */
static void
give_up_shares (const CeldBases *b, const double *a, const float *basis)
{
  size_t pixels = (size_t) b->width * (size_t) b->height;

  for (size_t g = 0; g < b->n_groups; g++)
    {
      float *h = b->group[g], share[CELD_LANES];

      for (size_t k = 0; k < CELD_LANES; k++)
        {
          size_t node = g * CELD_LANES + k + 2;

          share[k] = node <= b->n ? (float) a[node - 1] : node == (size_t) b->n + 1 ? -1 : 0;
        }
      for (size_t p = 0; p < pixels; p++, h += CELD_LANES)
        if (basis[p] != 0)
          for (size_t k = 0; k < CELD_LANES; k++)
            h[k] -= share[k] * basis[p];
    }
}

/* Memory for more nodes, so that nothing fails while they are put in. */
typedef struct
{
  float  *basis;                /* a plane for each */
  double *stiffness;            /* the matrices one after the other */
  double *share, *with, *work;
} Room;

static void
room_clear (Room *room)
{
  celd_free (room->basis);
  celd_free (room->stiffness);
  celd_free (room->share);
}

static CeldStatus
room_new (CeldBases *b, size_t n_points, Room *room)
{
  size_t pixels = (size_t) b->width * (size_t) b->height, n = b->n + n_points;

  *room = (Room) {
    celd_alloc (pixels, n_points * sizeof (float)), celd_alloc (n * n, n_points * sizeof (double)),
    celd_alloc (2 * n + celd_stiffness_room (n), sizeof (double)), NULL, NULL
  };
  if (!room->basis || !room->stiffness || !room->share)
    return CELD_NO_MEMORY;
  for (size_t i = b->n - b->n_sets + 1; i <= n - b->n_sets; i++)
    {
      size_t *pixel = celd_grow (b->pixel, i, sizeof *pixel);

      if (!pixel)
        return CELD_NO_MEMORY;
      b->pixel = pixel;
    }
  room->with = room->share + n;
  room->work = room->with + n;
  return grow_groups (b, groups_for ((uint32_t) n));
}

/* Node n + 1 at pixel p, with the basis in g; k: for its stiffness. */
static void
insert (CeldBases *b, size_t p, const float *g, const CeldRun *run, Room *room, double *k)
{
  size_t  n = b->n;
  double *a = room->share, own;

  celd_stiffness_of (b, g, run, room->work, room->with, &own);
  a[0] = 1;
  for (uint32_t i = 2; i <= n; i++)
    {
      a[i - 1] = (double) lane_of (b, i)[p * CELD_LANES];
      a[0]    -= a[i - 1];
    }
  extend_stiffness (b, a, room->with, own, k);
  give_up_shares (b, a, g);
  b->stiffness = k;
  b->pixel[n - b->n_sets] = p;
  b->node[p] = ++b->n;
}

/* The answers to sources at the points. */
static CeldStatus
solve_points (const CeldBases *b, const size_t *point, size_t n_points, double tolerance, const CeldRun *run,
              float *g, CeldSolve *solve)
{
  size_t       pixels = (size_t) b->width * (size_t) b->height;
  float       *source = celd_alloc0 (pixels, sizeof *source);
  CeldLaplace *laplace = NULL;
  CeldPart     part;
  CeldRun      setting_up = celd_run_part (&part, run, 0, 0.3);
  CeldStatus   status = source ? set_up (b, &setting_up, &laplace) : CELD_NO_MEMORY;

  for (size_t i = 0; i < n_points && status == CELD_OK; i++, g += pixels)
    {
      CeldPart  share;
      CeldRun   solving = celd_run_part (&share, run, 0.3 + 0.7 * (double) i / (double) n_points,
                                         0.3 + 0.7 * (double) (i + 1) / (double) n_points);
      CeldSolve one = { 0 };

      memset (g, 0, pixels * sizeof *g);
      source[point[i]] = 1;
      status = celd_lap_solve (laplace, 1, source, g, tolerance, &solving, &one);
      source[point[i]] = 0;
      take_worst (solve, &one);
    }
  celd_lap_free (laplace);
  celd_free (source);
  return status;
}

CeldStatus
celd_bases_add (CeldBases *bases, const size_t *point, size_t n_points, double tolerance, const CeldRun *run,
                CeldSolve *solve)
{
  CeldBases *b = bases;
  size_t     pixels = (size_t) b->width * (size_t) b->height, n = b->n + n_points;
  Room       room;
  double    *k, *old = b->stiffness;
  CeldStatus status = room_new (b, n_points, &room);

  solve->converged = true;
  if (status == CELD_OK)
    status = solve_points (b, point, n_points, tolerance, run, room.basis, solve);
  k = status == CELD_OK ? celd_alloc (n * n, sizeof *k) : NULL;
  if (k)
    {
      for (size_t i = 0; i < n_points; i++)
        {
          float *g = room.basis + i * pixels;

          make_basis (b, point[i], g);
          insert (b, point[i], g, run, &room, i + 1 < n_points ? room.stiffness + i * n * n : k);
        }
      celd_free (old);
    }
  else
    {
      shrink_groups (b, groups_for (b->n));
      status = status == CELD_OK ? CELD_NO_MEMORY : status;
    }
  room_clear (&room);
  return status;
}

/* ------------------------------------------------------------------ one node less */

/* Its basis goes to the others: the sum of their values that makes it harmonic there. */
static void
hand_over_basis (const CeldBases *b, uint32_t node)
{
  size_t        n = b->n, pixels = (size_t) b->width * (size_t) b->height;
  const double *row  = b->stiffness + (node - 1) * n;
  const float  *from = lane_of (b, node);

  for (size_t g = 0; g < b->n_groups; g++)
    {
      float share[CELD_LANES] = { 0 };

      for (size_t k = g * CELD_LANES + 2; k <= n && k < (g + 1) * CELD_LANES + 2; k++)
        if (k != node && row[node - 1] > 0)
          share[k - g * CELD_LANES - 2] = (float) (-row[k - 1] / row[node - 1]);
      for (size_t p = 0; p < pixels; p++)
        {
          float *h = b->group[g] + p * CELD_LANES, basis = from[p * CELD_LANES];

          for (size_t k = 0; k < CELD_LANES && basis != 0; k++)
            h[k] += share[k] * basis;
        }
    }
}

/* K without the node, whose value is what costs least; row and column of the last node move to its place. */
static void
reduce_stiffness (CeldBases *b, uint32_t node)
{
  size_t  n = b->n, at = node - 1;
  double *k = b->stiffness, own = k[at * n + at];

  for (size_t i = 0; i < n; i++)
    for (size_t j = 0; j < n && own > 0; j++)
      if (i != at && j != at)
        k[i * n + j] -= k[i * n + at] * k[at * n + j] / own;
  for (size_t i = 0; i < n; i++)
    k[i * n + at] = k[i * n + n - 1];
  for (size_t j = 0; j < n; j++)
    k[at * n + j] = k[(n - 1) * n + j];
  for (size_t i = 0; i + 1 < n; i++)
    memmove (k + i * (n - 1), k + i * n, (n - 1) * sizeof *k);
}

void
celd_bases_drop (CeldBases *bases, uint32_t node)
{
  CeldBases *b = bases;
  size_t     pixels = (size_t) b->width * (size_t) b->height, *pixel = &b->pixel[node - b->n_sets - 1];
  float     *to = lane_of (b, node), *last = lane_of (b, b->n);

  hand_over_basis (b, node);
  reduce_stiffness (b, node);
  for (size_t p = 0; p < pixels * CELD_LANES; p += CELD_LANES)
    {
      to[p]   = last[p];
      last[p] = 0;
    }
  b->node[b->pixel[b->n - b->n_sets - 1]] = node;
  b->node[*pixel] = 0;
  *pixel = b->pixel[b->n - b->n_sets - 1];
  b->n--;
  shrink_groups (b, groups_for (b->n));
}

/* ------------------------------------------------------------------ depth */

typedef struct
{
  const CeldBases *bases;
  CeldPlane       *depth;
  float           *value;       /* of each lane: u_k - u_1 */
  float            base, low, high;
} Composition;

/* row[x] += sum over the lanes of a group. */
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
  const Composition *c = data;
  const CeldBases   *b = c->bases;

  for (int y = band * BAND; y < b->height && y < (band + 1) * BAND; y++)
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
celd_bases_compose (const CeldBases *bases, const double *u, const CeldRun *run, CeldPlane *depth)
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
  celd_each (run, (bases->height + BAND - 1) / BAND, compose_band, &c);
  celd_free (c.value);
  return CELD_OK;
}
