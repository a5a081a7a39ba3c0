/* Adding single pixels to the nodes, and removing them, without making all bases anew (exact-bases.c).
 *
 * To add pixel p takes one solution g of  L g = 1 at p, 0 on the nodes.  Then  h_p = g / g(p)  and every other basis
 * becomes  h_k - h_k(p) h_p.  To remove it takes none: its basis is distributed to the others in proportion to their
 * stiffness, so that they are harmonic at p again.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "depth/depth.h"
#include "solve/laplace.h"

/* ------------------------------------------------------------------ adding a node */

/* Turns g, the solution for a source at p, into the basis of node n + 1.  g is 0 on the nodes of the set-up; the bases
 * of nodes that were added since are used to make it 0 there, too. */
static void
make_basis (const CeldHarmonicBases *b, size_t p, float *g)
{
  size_t pixels = (size_t) b->width * (size_t) b->height;

  for (uint32_t k = b->n; k > b->n_sets && k > 1; k--)
    {
      float        share = g[b->pixel[k - b->n_sets - 1]];
      const float *h     = celd_bases_lane (b, k);

      for (size_t q = 0; q < pixels && share != 0; q++)
        g[q] -= share * h[q * CELD_LANES];
    }

  float scale = g[p] > 0 ? 1 / g[p] : 0;

  for (size_t q = 0; q < pixels; q++)
    g[q] = b->node[q] ? 0 : g[q] > 0 ? g[q] * scale < 1 ? g[q] * scale : 1 : 0;
  g[p] = 1;
}

/* The stiffness of the bases h_k - a_k h and h, a_k = h_k (p), from the energies of h with the others and with
 * itself. */
static void
extend_stiffness (const CeldHarmonicBases *b, const double *a, const double *with, double own, double *k)
{
  size_t n = b->n, m = n + 1;

  for (size_t i = 0; i < n; i++)
    for (size_t j = 0; j < n; j++)
      k[i * m + j] = b->stiffness[i * n + j] - a[i] * with[j] - a[j] * with[i] + a[i] * a[j] * own;
  for (size_t i = 0; i < n; i++)
    k[i * m + n] = k[n * m + i] = with[i] - a[i] * own;
  k[n * m + n] = own;
}

/* Subtracts a_k times the new basis from the others, and stores it in its lane. */
static void
give_up_shares (const CeldHarmonicBases *b, const double *a, const float *basis)
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

/* Memory for all new nodes, so that nothing can fail once the first is inserted. */
typedef struct
{
  float  *basis;                /* a plane for each */
  double *stiffness;            /* one matrix after the other */
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
room_new (CeldHarmonicBases *b, size_t n_points, Room *room)
{
  size_t pixels = (size_t) b->width * (size_t) b->height, n = b->n + n_points;

  *room = (Room) {
    celd_alloc (pixels, n_points * sizeof (float)), celd_alloc (n * n, n_points * sizeof (double)),
    celd_alloc (2 * n + celd_stiffness_room (n), sizeof (double)), NULL, NULL
  };
  if (!room->basis || !room->stiffness || !room->share)
    return CELD_NO_MEMORY;
  if (!celd_reserve (&b->pixel, n - b->n_sets, &b->pixel_capacity, sizeof *b->pixel))
    return CELD_NO_MEMORY;
  room->with = room->share + n;
  room->work = room->with + n;
  return celd_bases_grow (b, celd_bases_groups ((uint32_t) n));
}

/* Inserts node n + 1 at pixel p with the basis g; k is room for the new stiffness matrix. */
static void
insert (CeldHarmonicBases *b, size_t p, const float *g, const CeldHost *host, Room *room, double *k)
{
  size_t  n = b->n;
  double *a = room->share, own;

  celd_stiffness_of (b, g, host, room->work, room->with, &own);
  a[0] = 1;
  for (uint32_t i = 2; i <= n; i++)
    {
      a[i - 1] = (double) celd_bases_lane (b, i)[p * CELD_LANES];
      a[0]    -= a[i - 1];
    }
  extend_stiffness (b, a, room->with, own, k);
  give_up_shares (b, a, g);
  b->stiffness = k;
  b->pixel[n - b->n_sets] = p;
  b->node[p] = ++b->n;
}

/* Solves for a source at each of the points. */
static CeldStatus
solve_points (const CeldHarmonicBases *b, const size_t *point, size_t n_points, double tolerance, const CeldHost *host,
              float *g, CeldSolve *solve)
{
  size_t       pixels = (size_t) b->width * (size_t) b->height;
  float       *source = celd_alloc0 (pixels, sizeof *source);
  CeldLaplace *laplace = NULL;
  CeldHostPart part;
  CeldHost     setting_up = celd_host_part (&part, host, 0, 0.3);
  CeldStatus   status = source ? celd_bases_set_up (b, &setting_up, &laplace) : CELD_NO_MEMORY;

  for (size_t i = 0; i < n_points && status == CELD_OK; i++, g += pixels)
    {
      CeldHostPart share;
      CeldHost     solving = celd_host_part (&share, host, 0.3 + 0.7 * (double) i / (double) n_points,
                                            0.3 + 0.7 * (double) (i + 1) / (double) n_points);
      CeldSolve    one = { 0 };

      memset (g, 0, pixels * sizeof *g);
      source[point[i]] = 1;
      status = celd_lap_solve (laplace, 1, source, g, tolerance, &solving, &one);
      source[point[i]] = 0;
      celd_solve_join (solve, &one);
    }
  celd_lap_free (laplace);
  celd_free (source);
  return status;
}

CeldStatus
celd_bases_add (CeldHarmonicBases *bases, const size_t *point, size_t n_points, double tolerance, const CeldHost *host,
                CeldSolve *solve)
{
  CeldHarmonicBases *b = bases;
  size_t             pixels = (size_t) b->width * (size_t) b->height, n = b->n + n_points;
  Room               room;
  double            *k, *old = b->stiffness;
  CeldStatus         status = room_new (b, n_points, &room);

  solve->converged = true;
  if (status == CELD_OK)
    status = solve_points (b, point, n_points, tolerance, host, room.basis, solve);
  k = status == CELD_OK ? celd_alloc (n * n, sizeof *k) : NULL;
  if (k)
    {
      for (size_t i = 0; i < n_points; i++)
        {
          float *g = room.basis + i * pixels;

          make_basis (b, point[i], g);
          insert (b, point[i], g, host, &room, i + 1 < n_points ? room.stiffness + i * n * n : k);
        }
      celd_free (old);
    }
  else
    {
      celd_bases_shrink (b, celd_bases_groups (b->n));
      status = status == CELD_OK ? CELD_NO_MEMORY : status;
    }
  room_clear (&room);
  return status;
}

/* ------------------------------------------------------------------ removing a node */

/* Distributes the basis of a node to the others, in the proportions that make the result harmonic there. */
static void
hand_over_basis (const CeldHarmonicBases *b, uint32_t node)
{
  size_t        n = b->n, pixels = (size_t) b->width * (size_t) b->height;
  const double *row  = b->stiffness + (node - 1) * n;
  const float  *from = celd_bases_lane (b, node);

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

/* Eliminates the node from the stiffness matrix (its value minimises the energy); the last row and column take its
 * place. */
static void
reduce_stiffness (CeldHarmonicBases *b, uint32_t node)
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
celd_bases_drop (CeldHarmonicBases *bases, uint32_t node)
{
  CeldHarmonicBases *b = bases;
  size_t             pixels = (size_t) b->width * (size_t) b->height, *pixel = &b->pixel[node - b->n_sets - 1];
  float             *to = celd_bases_lane (b, node), *last = celd_bases_lane (b, b->n);

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
  celd_bases_shrink (b, celd_bases_groups (b->n));
}
